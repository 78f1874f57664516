/* SPDX-License-Identifier: Apache-2.0
 * Defines scenarios that call every public function that allocates. Include after the digests. */
#ifndef RIIS_TEST_MEMORY_SCENARIOS_H
#define RIIS_TEST_MEMORY_SCENARIOS_H

/* The objects of a scenario. Objects that the scenario does not need are NULL. */
typedef struct world {
  riis_valve *valve, *open;
  riis_surface *surface;
  riis_mesh *mesh;
  riis_adjacency *adjacency;
  riis_marks *result;
  const struct scenario *scenario;
} world;

/* A scenario makes one call. Each run makes a new world, makes the call, and destroys the world. */
typedef struct scenario {
  const char *name;
  void (*make)(world *w);
  riis_status (*call)(world *w);
  int32_t n_threads;
  int32_t search;
  int flags;
} scenario;
enum {
  MAKES_A_SCENE = 1,
  ON_WORKERS = 2,     /* other threads than the caller also allocate */
  ALLOCATES_NONE = 4, /* the library's own code allocates nothing */
  IS_FIRST = 8,       /* the first such call in this process also makes data for later calls */
  MAY_GO_ON = 16,     /* without the memory, the call still succeeds */
  IS_SHORT = 32       /* on a busy machine, the calling thread may end the loop before other threads begin */
};

/* --- Objects that all scenarios share ------------------------------------------------------------------------------ */

static test_mesh nodes, fewer_nodes;
static uint8_t *mask, *marks; /* one entry per node */
static int64_t *labels;
static int32_t *side;

/* Makes a lattice of n * n * n nodes around the aortic valve. */
static test_mesh lattice_of(int64_t n) {
  const int64_t counts[3] = {n, n, n};
  const double lower[3] = {-1.5, -1.5, -1.2}, upper[3] = {1.5, 1.5, 1.6};
  return lattice(counts, lower, upper);
}

static void set_nodes(int64_t n) {
  nodes = lattice_of(n);
  keep_owned_for_group();
  mask = realloc(mask, (size_t)nodes.n);
  marks = realloc(marks, (size_t)nodes.n);
  labels = realloc(labels, (size_t)nodes.n * sizeof *labels);
  side = realloc(side, (size_t)nodes.n * sizeof *side);
  for (int64_t i = 0; i < nodes.n; ++i) mask[i] = i % 7 != 0;
}

/* Before a call that creates an object, the handle points to no_object. Only a successful call may overwrite the handle. */
static char no_object;
#define MADE(type, handle, create)                                                                    \
  do {                                                                                                \
    type *made = (type *)(void *)&no_object;                                                          \
    const riis_status status = (create);                                                              \
    if (status && made != (type *)(void *)&no_object) fail_msg("written, though %s failed", #create); \
    if (!status) handle = made;                                                                       \
    return status;                                                                                    \
  } while (0)

/* --- Valves ---------------------------------------------------------------------------------------------------------- */

static riis_status make_aortic(world *w) { MADE(riis_valve, w->valve, riis_valve_create("aortic", &made)); }
static riis_status make_mitral(world *w) { MADE(riis_valve, w->valve, riis_valve_create("mitral", &made)); }

/* Makes a valve of two patches side by side, lifted by z in the middle. The valve has 7 straight and bent curves. */
static riis_status patches_valve(double z, riis_valve **valve) {
  static const int32_t degree[7] = {2, 2, 2, 2, 1, 1, 1}, curve_id[8] = {0, 1, 4, 5, 2, 3, 5, 6};
  double control[54];
  int n = 0;
  riis_patches patches;
  for (int i = 0; i < 7; ++i) {
    /* Curves 0 to 3 run along x from x = 0 or 1, at y = 0 or 1. Curves 4 to 6 run along y at x = 0, 1, 2. */
    for (int k = 0; k <= degree[i]; ++k) {
      control[n++] = i < 4 ? i / 2 + 0.5 * k : i - 4;
      control[n++] = i < 4 ? i % 2 : k;
      control[n++] = i < 4 && k == 1 ? z : 0;
    }
  }
  CHECK_OK(riis_patches_init(&patches, sizeof patches));
  patches.n_curves = 7;
  patches.degree = degree;
  patches.control = control;
  patches.n_patches = 2;
  patches.curve_id = curve_id;
  return riis_valve_create_from_patches(&patches, valve);
}

static riis_status make_patches(world *w) { MADE(riis_valve, w->valve, patches_valve(0.5, &made)); }

static riis_status open_valve(world *w) { return riis_valve_set_open_state(w->valve, w->open); }

static void aortic(world *w) { CHECK_OK(make_aortic(w)); }
static void mitral(world *w) { CHECK_OK(make_mitral(w)); }
static void aortic_and_open(world *w) {
  aortic(w);
  CHECK_OK(riis_valve_create("aortic", &w->open));
  CHECK_OK(riis_valve_set_scalar(w->open, "leaflet_angle", 70));
}
static void mitral_and_open(world *w) {
  mitral(w);
  CHECK_OK(riis_valve_create("mitral", &w->open));
}
static void patches_and_open(world *w) {
  CHECK_OK(make_patches(w));
  CHECK_OK(patches_valve(0.8, &w->open));
}
/* The valve already has an open state and gets a new one. */
static void patches_opened(world *w) {
  patches_and_open(w);
  CHECK_OK(open_valve(w));
  riis_valve_destroy(&w->open);
  CHECK_OK(patches_valve(-0.7, &w->open));
}

static riis_status set_and_get(world *w) {
  riis_parameter parameter;
  double value;
  int64_t n;
  const riis_status status = riis_valve_set_scalar(w->valve, "leaflet_angle", 70);
  return status ? status
                : riis_valve_get(w->valve, "right.leaflet_angle", 1, &value) ||
                      riis_valve_get_n_parameters(w->valve, &n) ||
                      riis_valve_get_parameter(w->valve, 0, &parameter, sizeof parameter);
}

/* --- Surfaces -------------------------------------------------------------------------------------------------------- */

static riis_status triangulate(world *w) {
  MADE(riis_surface, w->surface, riis_surface_create(w->valve, &coarse, &made));
}

static riis_status measure(world *w, int32_t distance) {
  riis_surface_options options = coarse;
  options.measure = distance;
  options.measure_tolerance = 1;
  if (w->surface) return riis_surface_update(w->surface, w->valve, &options);
  MADE(riis_surface, w->surface, riis_surface_create(w->valve, &options, &made));
}
static riis_status by_sampling(world *w) { return measure(w, RIIS_MEASURE_SAMPLING); }
static riis_status by_minimization(world *w) { return measure(w, RIIS_MEASURE_MINIMIZATION); }

/* The faces of a pyramid, with 64-bit ids. The base is a quad, and one face has no area. */
static const double corners[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
static const int32_t faces[15] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 0, 4};
static const int64_t quads[8] = {0, 1, 2, 3, 4, 4, 4, 4};

static riis_surface_arrays pyramid(int of_quads) {
  riis_surface_arrays arrays = triangle_arrays(5, corners[0], 5, faces);
  if (of_quads) {
    arrays.n_faces = 2;
    arrays.vertex_ids = quads;
    arrays.id_bits = 64;
    arrays.corners_per_face = 4;
  }
  return arrays;
}

static riis_surface_options skipping(void) {
  riis_surface_options options = surface_options();
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  return options;
}

static riis_status from_arrays(world *w, int of_quads) {
  const riis_surface_arrays arrays = pyramid(of_quads);
  const riis_surface_options options = skipping();
  MADE(riis_surface, w->surface, riis_surface_create_from_arrays(&arrays, &options, &made));
}
static riis_status from_triangles(world *w) { return from_arrays(w, 0); }
static riis_status from_quads(world *w) { return from_arrays(w, 1); }

static void aortic_made(world *w) {
  aortic(w);
  CHECK_OK(triangulate(w));
}
static void aortic_moved(world *w) {
  aortic_made(w);
  CHECK_OK(riis_valve_set_scalar(w->valve, "leaflet_angle", 60));
}
static void sampled(world *w) {
  aortic(w);
  CHECK_OK(by_sampling(w));
}
static void minimized(world *w) {
  aortic(w);
  CHECK_OK(by_minimization(w));
}
static riis_status update(world *w) { return riis_surface_update(w->surface, w->valve, NULL); }
static riis_status update_from_triangles(world *w) {
  const riis_surface_arrays arrays = pyramid(0);
  const riis_surface_options options = skipping();
  return riis_surface_update_from_arrays(w->surface, &arrays, &options);
}

/* Makes the first query of a surface that also requests the side of the point. */
static riis_status closest_point(world *w) {
  const double point[3] = {0.1, 0.2, 0.3};
  riis_closest closest, before;
  memset(&closest, 0x5a, sizeof closest);
  before = closest;
  const riis_status status = riis_closest_point(w->surface, point, &closest, sizeof closest);
  if (status && memcmp(&closest, &before, sizeof closest) != 0) fail_msg("closest was written, though the call failed");
  return status;
}

static riis_status closest_points(world *w) {
  riis_closest_options options;
  riis_closest_arrays arrays;
  CHECK_OK(riis_closest_options_init(&options, sizeof options));
  CHECK_OK(riis_closest_arrays_init(&arrays, sizeof arrays));
  options.n_threads = w->scenario->n_threads;
  arrays.side = side;
  for (int64_t i = 0; i < nodes.n; ++i) side[i] = 77;
  const riis_status status =
      closest_points_of(w->surface, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3, &options, &arrays);
  for (int64_t i = 0; i < nodes.n; ++i)
    if ((status != RIIS_OK) != (side[i] == 77)) fail_msg("side %lld is %d after %d", (long long)i, side[i], status);
  return status;
}

/* The right cusp is turned so far that it crosses the other cusps. */
static void crossing(world *w) {
  const double turned[3] = {0, 0, 60};
  aortic(w);
  CHECK_OK(riis_valve_set(w->valve, "right.rotation", 3, turned));
  CHECK_OK(triangulate(w));
}
static riis_status find_crossings(world *w) {
  riis_crossing_options options;
  riis_crossing_list crossings;
  CHECK_OK(riis_crossing_options_init(&options, sizeof options));
  options.n_threads = w->scenario->n_threads;
  const riis_status status = find_crossings_in(w->surface, &options, &crossings);
  if (!status) assert_true(crossings.n_pairs > 10);
  return status;
}
static void crossings_found(world *w) {
  crossing(w);
  CHECK_OK(find_crossings(w));
}

/* --- Meshes and adjacency -------------------------------------------------------------------------------------------- */

static riis_status make_mesh(world *w) {
  MADE(riis_mesh, w->mesh, riis_mesh_create(nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3, &made));
}
static void mesh_made(world *w) { CHECK_OK(make_mesh(w)); }
static riis_status update_mesh(world *w) {
  const test_mesh *to = &fewer_nodes;
  return riis_mesh_update(w->mesh, to->n, to->xyz, to->xyz + 1, to->xyz + 2, 3);
}
static riis_status prepare(world *w) { return riis_mesh_prepare(w->mesh, w->scenario->n_threads); }
static riis_status set_adjacency(world *w) {
  const riis_csr csr = csr_of(&nodes);
  return riis_mesh_set_adjacency(w->mesh, &csr);
}

static riis_status from_grid(world *w) {
  MADE(riis_adjacency, w->adjacency, riis_adjacency_create_from_grid(22, 22, 22, w->scenario->n_threads, &made));
}

/* A strip of tetrahedra. Cell i has the nodes i to i + 3. */
enum { n_cells = 9000 };
static int32_t *strip;
static riis_status from_cells(world *w) {
  riis_mesh_cells cells;
  CHECK_OK(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = n_cells + 3;
  cells.n_cells = n_cells;
  cells.node_ids = strip;
  cells.n_threads = w->scenario->n_threads;
  MADE(riis_adjacency, w->adjacency, riis_adjacency_create_from_cells(&cells, &made));
}
static riis_status from_faces(world *w) {
  riis_mesh_faces between;
  CHECK_OK(riis_mesh_faces_init(&between, sizeof between));
  between.n_cells = n_cells + 3;
  between.n_faces = n_cells;
  between.owner = strip;
  between.neighbor = strip + 1;
  between.stride = 4;
  between.n_threads = w->scenario->n_threads;
  MADE(riis_adjacency, w->adjacency, riis_adjacency_create_from_faces(&between, &made));
}

/* --- Marking --------------------------------------------------------------------------------------------------------- */

static riis_status make_result(world *w) { MADE(riis_marks, w->result, riis_marks_create(&made)); }

static void ready_to_mark(world *w) {
  aortic_made(w);
  mesh_made(w);
  CHECK_OK(set_adjacency(w));
  CHECK_OK(make_result(w));
}

static riis_mark_options options_of(const world *w, double limit) {
  riis_mark_options options = mark_options();
  options.search = w->scenario->search;
  options.n_threads = w->scenario->n_threads;
  options.distance_limit = limit;
  return options;
}

static riis_status mark(world *w) {
  const riis_mark_options options = options_of(w, RIIS_AUTO);
  return riis_mark_nodes(w->surface, w->mesh, &options, w->result);
}
static riis_status mark_masked_and_wide(world *w) {
  riis_mark_options options = options_of(w, 0.5);
  options.node_mask = mask;
  return riis_mark_nodes(w->surface, w->mesh, &options, w->result);
}
/* The following scenarios mark into a result that was used before. After one earlier marking, the result needs more memory. After
 * several markings, it has enough memory. */
static void marked_before(world *w) {
  ready_to_mark(w);
  CHECK_OK(mark(w));
}
static void marked_often(world *w) {
  ready_to_mark(w);
  for (int i = 0; i < 3; ++i) CHECK_OK(mark(w));
}
/* The leaflets of a closed valve touch, so a marking with velocities stores ties: points of several leaflets at one distance. */
static void tied_and_ready(world *w) {
  riis_valve *closed = NULL, *open = NULL;
  ready_to_mark(w);
  CHECK_OK(riis_valve_create("trileaflet", &closed));
  CHECK_OK(riis_valve_copy(closed, &open));
  CHECK_OK(riis_valve_set_scalar(open, "opening", 0.1));
  CHECK_OK(riis_surface_update_moving(w->surface, closed, open, 1, NULL, NULL));
  riis_valve_destroy(&closed);
  riis_valve_destroy(&open);
}
static riis_status mark_velocities(world *w) {
  riis_mark_options options = options_of(w, RIIS_AUTO);
  options.fields = RIIS_FIELD_VELOCITY;
  return riis_mark_nodes(w->surface, w->mesh, &options, w->result);
}
/* The surface measures distances by sampling. */
static void sampled_and_ready(world *w) {
  ready_to_mark(w);
  CHECK_OK(by_sampling(w));
}
static void minimized_and_ready(world *w) {
  ready_to_mark(w);
  CHECK_OK(by_minimization(w));
}
/* The mesh has balls or clusters of old positions, so the call must compute them again. */
static void marked_and_moved(world *w) {
  marked_often(w);
  CHECK_OK(riis_mesh_update(w->mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
}
/* The result has marked a smaller mesh, so its arrays with one entry per node are too short. */
static void marked_little(world *w) {
  const riis_csr fewer = csr_of(&fewer_nodes);
  ready_to_mark(w);
  CHECK_OK(update_mesh(w));
  CHECK_OK(riis_mesh_set_adjacency(w->mesh, &fewer));
  CHECK_OK(mark(w));
  CHECK_OK(riis_mesh_update(w->mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
  CHECK_OK(set_adjacency(w));
}
static riis_status dense(world *w) { return dense_of(w->result, nodes.n, RIIS_FAR_DISTANCE, marks, NULL, NULL, NULL); }

/* The surface is so thin that edges of the mesh cross it between unmarked nodes. */
static void thin_and_marked(world *w) {
  ready_to_mark(w);
  riis_surface_options thin = coarse;
  thin.half_thickness = 0.01;
  thin.tolerance = 1;
  CHECK_OK(riis_surface_update(w->surface, w->valve, &thin));
  CHECK_OK(mark(w));
}
static riis_status find_leaks(world *w) {
  const riis_mark_options options = options_of(w, RIIS_AUTO);
  riis_leak_list leaks;
  const riis_status status = find_leaks_in(w->surface, w->mesh, w->result, &options, &leaks);
  if (!status) assert_true(leaks.n_edges > 10);
  return status;
}
static void leaks_found(world *w) {
  thin_and_marked(w);
  CHECK_OK(find_leaks(w));
}
static riis_status label_regions(world *w) {
  const riis_mark_options options = options_of(w, RIIS_AUTO);
  return riis_label_open_regions(w->mesh, w->result, &options, nodes.n, labels, NULL);
}
/* The passage leads from the first node to the last node, which are corners of the lattice. */
static riis_status find_passage(world *w) {
  const riis_mark_options options = options_of(w, RIIS_AUTO);
  const int64_t from = 0, to = nodes.n - 1;
  riis_passage passage;
  const riis_status status =
      find_passage_between(w->surface, w->mesh, &options, 1, &from, 1, &to, &passage, sizeof passage);
  if (!status) assert_int_equal(passage.state, RIIS_PASSAGE_OPEN);
  return status;
}

/* Returns a digest of the world. The digest leaves out objects that the call only reads, because they would take most of the
 * time. */
static uint64_t digest_of(const world *w) {
  uint64_t digest = UINT64_C(0xcbf29ce484222325);
  const int which = (w->valve != NULL) + 2 * (w->surface != NULL) + 4 * (w->mesh != NULL) + 8 * (w->adjacency != NULL) +
                    16 * (w->result != NULL);
  digest = add_bytes(digest, &which, sizeof which);
  if (w->valve && !w->surface && !(w->scenario->flags & MAKES_A_SCENE)) digest = add_valve(digest, w->valve);
  if (w->surface && !w->result) digest = add_surface(digest, w->surface);
  if (w->mesh && !w->result) digest = add_mesh(digest, w->mesh);
  if (w->result) digest = add_result(digest, w->result);
  if (w->adjacency) {
    riis_csr csr;
    CHECK_OK(riis_adjacency_get_csr(w->adjacency, &csr, sizeof csr));
    const int64_t *offsets = csr.offsets;
    digest = add_bytes(digest, offsets, (size_t)(csr.n_rows + 1) * 8);
    digest = add_bytes(digest, csr.columns, (size_t)offsets[csr.n_rows] * (size_t)csr.column_bits / 8);
  }
  return digest;
}

static void destroy(world *w) {
  riis_valve_destroy(&w->open);
  riis_marks_destroy(&w->result);
  riis_mesh_destroy(&w->mesh);
  riis_adjacency_destroy(&w->adjacency);
  riis_surface_destroy(&w->surface);
  riis_valve_destroy(&w->valve);
}

/* --- The scenarios --------------------------------------------------------------------------------------------------- */

#define ALL_SEARCHES(name, make, call, n_threads, flags)                       \
  {name ", exhaustive", make, call, n_threads, RIIS_SEARCH_EXHAUSTIVE, flags}, \
      {name ", neighbor", make, call, n_threads, RIIS_SEARCH_NEIGHBOR, flags}, \
      {name ", paper", make, call, n_threads, RIIS_SEARCH_PAPER, flags}, {     \
    name ", clusters", make, call, n_threads, RIIS_SEARCH_CLUSTERS, flags      \
  }

static void nothing(world *w) { (void)w; }

static const scenario scenarios[] = {
    {"first aortic valve", nothing, make_aortic, 0, 0, IS_FIRST},
    {"first mitral valve", nothing, make_mitral, 0, 0, IS_FIRST},
    {"first valve from patches", nothing, make_patches, 0, 0, IS_FIRST},
    {"aortic valve", nothing, make_aortic, 0, 0, 0},
    {"mitral valve", nothing, make_mitral, 0, 0, 0},
    {"valve from patches", nothing, make_patches, 0, 0, 0},
    {"open state, aortic", aortic_and_open, open_valve, 0, 0, 0},
    {"open state, mitral", mitral_and_open, open_valve, 0, 0, 0},
    {"open state, patches", patches_and_open, open_valve, 0, 0, 0},
    {"another open state, patches", patches_opened, open_valve, 0, 0, 0},
    {"parameters", aortic, set_and_get, 0, 0, ALLOCATES_NONE},
    {"surface, aortic", aortic, triangulate, 0, 0, 0},
    {"surface, mitral", mitral, triangulate, 0, 0, 0},
    {"surface, patches", patches_opened, triangulate, 0, 0, 0},
    {"surface, triangles", nothing, from_triangles, 0, 0, 0},
    {"surface, quads", nothing, from_quads, 0, 0, 0},
    {"surface update, valve", aortic_moved, update, 0, 0, 0},
    {"surface update, triangles", aortic_made, update_from_triangles, 0, 0, 0},
    {"surface, sampling", mitral, by_sampling, 0, 0, 0},
    {"surface, minimization", mitral, by_minimization, 0, 0, 0},
    {"surface update, to sampling", aortic_moved, by_sampling, 0, 0, 0},
    {"closest point by sampling", sampled, closest_point, 0, 0, ALLOCATES_NONE},
    {"closest point by minimization", minimized, closest_point, 0, 0, ALLOCATES_NONE},
    {"closest point", aortic_made, closest_point, 0, 0, MAKES_A_SCENE},
    {"closest points, 1 thread", aortic_made, closest_points, 1, 0, MAY_GO_ON | MAKES_A_SCENE},
    {"closest points, 4 threads", aortic_made, closest_points, 4, 0, MAY_GO_ON | ON_WORKERS},
    {"crossings, 1 thread", crossing, find_crossings, 1, 0, 0},
    {"crossings, 4 threads", crossing, find_crossings, 4, 0, ON_WORKERS | IS_SHORT},
    {"crossings again", crossings_found, find_crossings, 1, 0, 0},
    {"mesh", nothing, make_mesh, 0, 0, 0},
    {"mesh update", mesh_made, update_mesh, 0, 0, ALLOCATES_NONE},
    {"mesh preparation, 1 thread", mesh_made, prepare, 1, 0, 0},
    {"mesh preparation, 4 threads", mesh_made, prepare, 4, 0, 0},
    {"mesh adjacency", mesh_made, set_adjacency, 0, 0, ALLOCATES_NONE},
    {"adjacency from grid, 1 thread", nothing, from_grid, 1, 0, 0},
    {"adjacency from grid, 4 threads", nothing, from_grid, 4, 0, ON_WORKERS},
    {"adjacency from cells, 1 thread", nothing, from_cells, 1, 0, 0},
    {"adjacency from cells, 4 threads", nothing, from_cells, 4, 0, ON_WORKERS},
    {"adjacency from faces, 1 thread", nothing, from_faces, 1, 0, 0},
    {"adjacency from faces, 4 threads", nothing, from_faces, 4, 0, ON_WORKERS},
    {"result", nothing, make_result, 0, 0, 0},
    ALL_SEARCHES("first marking, 1 thread", ready_to_mark, mark, 1, 0),
    ALL_SEARCHES("first marking, 4 threads", ready_to_mark, mark, 4, ON_WORKERS),
    ALL_SEARCHES("first marking, masked and wide, 1 thread", ready_to_mark, mark_masked_and_wide, 1, 0),
    ALL_SEARCHES("wider marking, 1 thread", marked_before, mark_masked_and_wide, 1, 0),
    ALL_SEARCHES("wider marking, 4 threads", marked_before, mark_masked_and_wide, 4, 0),
    ALL_SEARCHES("larger mesh, 1 thread", marked_little, mark, 1, 0),
    ALL_SEARCHES("larger mesh, 4 threads", marked_little, mark, 4, 0),
    ALL_SEARCHES("first marking with ties, 1 thread", tied_and_ready, mark_velocities, 1, 0),
    ALL_SEARCHES("first marking with ties, 4 threads", tied_and_ready, mark_velocities, 4, 0),
    {"first marking by sampling, exhaustive", sampled_and_ready, mark, 1, RIIS_SEARCH_EXHAUSTIVE, 0},
    {"first marking by minimization, neighbor", minimized_and_ready, mark, 1, RIIS_SEARCH_NEIGHBOR, 0},
    {"marking again", marked_often, mark, 1, RIIS_SEARCH_NEIGHBOR, ALLOCATES_NONE},
    {"marking of nodes that moved", marked_and_moved, mark, 1, RIIS_SEARCH_NEIGHBOR, ALLOCATES_NONE},
    {"marking again by clusters", marked_often, mark, 1, RIIS_SEARCH_CLUSTERS, ALLOCATES_NONE},
    {"marking of nodes that moved, by clusters", marked_and_moved, mark, 1, RIIS_SEARCH_CLUSTERS, ALLOCATES_NONE},
    {"leaks, 1 thread", thin_and_marked, find_leaks, 1, RIIS_SEARCH_EXHAUSTIVE, 0},
    {"leaks, 4 threads", thin_and_marked, find_leaks, 4, RIIS_SEARCH_EXHAUSTIVE, ON_WORKERS},
    {"leaks again", leaks_found, find_leaks, 1, RIIS_SEARCH_EXHAUSTIVE, 0},
    {"open regions, 1 thread", thin_and_marked, label_regions, 1, RIIS_SEARCH_EXHAUSTIVE, ALLOCATES_NONE},
    {"open regions, 4 threads", thin_and_marked, label_regions, 4, RIIS_SEARCH_EXHAUSTIVE, ALLOCATES_NONE},
    {"passage, 1 thread", thin_and_marked, find_passage, 1, RIIS_SEARCH_EXHAUSTIVE, 0},
    {"passage, 4 threads", thin_and_marked, find_passage, 4, RIIS_SEARCH_EXHAUSTIVE, ON_WORKERS},
    {"dense arrays, 1 thread", marked_before, dense, 1, RIIS_SEARCH_EXHAUSTIVE, ALLOCATES_NONE},
    {"dense arrays, 4 threads", marked_before, dense, 4, RIIS_SEARCH_EXHAUSTIVE, ALLOCATES_NONE},
};
enum { n_scenarios = sizeof scenarios / sizeof scenarios[0] };

#endif
