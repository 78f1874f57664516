/* SPDX-License-Identifier: Apache-2.0
 * Makes the calls of test_calls.f90 from C. */
#include "c_twin.h"

#include "calls.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static riis_valve *valve, *thin_valve;
static riis_surface *surface, *plate, *mitral, *opening, *patches, *thin, *moving, *framed, *crossed;
static riis_mesh *mesh;
static riis_adjacency *of_cells, *of_faces, *of_grid;
static riis_marks *result, *leaking, *resisting;
static riis_leaks *leaks_found;
static riis_crossings *crossings_found;
static int64_t *region_labels;
static void *memory[24];
static int n_memory;

static void *allocate(int64_t n, size_t size) {
  void *block = malloc((size_t)n * size);
  if (!block) abort();
  memory[n_memory++] = block;
  return block;
}

#define TRY(call)                              \
  do {                                         \
    const riis_status status_of_call = call;   \
    if (status_of_call) return status_of_call; \
  } while (0)

static riis_status describe_parameters(twin_numbers *numbers) {
  TRY(riis_valve_get_n_parameters(valve, &numbers->n_parameters));
  riis_parameter *parameters = allocate(numbers->n_parameters, sizeof *parameters);
  for (int64_t i = 0; i < numbers->n_parameters; ++i)
    TRY(riis_valve_get_parameter(valve, i, &parameters[i], sizeof *parameters));
  numbers->parameters = parameters;
  return RIIS_OK;
}

static riis_status list_surface(const riis_surface *from, twin_surface *list) {
  TRY(riis_surface_get_info(from, &list->info, sizeof list->info));
  return riis_surface_get_triangles(from, &list->triangles, sizeof list->triangles);
}

static riis_status make_surface(twin_numbers *numbers) {
  const double rotation[3] = {0, 0, 120}, translation[3] = {0.1, 0, -1};
  TRY(riis_valve_create("aortic", &valve));
  TRY(describe_parameters(numbers));
  TRY(riis_surface_create(valve, NULL, &surface));
  TRY(riis_valve_set_scalar(valve, "root_radius", 1.3));
  TRY(riis_valve_set(valve, "non_coronary.rotation", 3, rotation));
  TRY(riis_valve_set(valve, "translation", 3, translation));
  riis_surface_options options;
  TRY(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 1.1;
  options.tolerance = 0.1;
  options.scale = 10;
  options.rotation_axis[0] = 1;
  options.rotation_axis[1] = 2;
  options.rotation_axis[2] = 3;
  options.rotation_angle = 25;
  options.translation[0] = 1;
  options.translation[1] = -2;
  options.translation[2] = 3;
  TRY(riis_surface_update(surface, valve, &options));
  return list_surface(surface, &numbers->aortic);
}

/* Makes the surface of a valve and destroys the valve, which is not needed afterwards. */
static riis_status make_other_surface(riis_valve **of, riis_surface **made, twin_surface *list) {
  TRY(riis_surface_create(*of, NULL, made));
  riis_valve_destroy(of);
  return list_surface(*made, list);
}

static riis_status make_mitral(twin_numbers *numbers) {
  riis_valve *of = NULL;
  TRY(riis_valve_create("mitral", &of));
  TRY(riis_valve_set_scalar(of, "opening", 0.5));
  return make_other_surface(&of, &mitral, &numbers->mitral);
}

static riis_status make_opening(twin_numbers *numbers) {
  riis_valve *closed = NULL, *open = NULL;
  TRY(riis_valve_create("aortic", &closed));
  TRY(riis_valve_create("aortic", &open));
  TRY(riis_valve_set_scalar(open, "leaflet_radius_in", 1.1));
  TRY(riis_valve_set_open_state(closed, open));
  riis_valve_destroy(&open);
  TRY(riis_valve_set_scalar(closed, "opening", 0.3));
  return make_other_surface(&closed, &opening, &numbers->opening);
}

static riis_status make_patches(twin_numbers *numbers) {
  /* Two patches side by side share a curve. The last curve runs in the opposite direction. */
  const int32_t degree[7] = {2, 1, 1, 3, 2, 1, 1};
  const double control[3 * 18] = {-8, -8, 0, -4, -8, 4, 0, -8, 2, -8, 8, 0, 0, 8, 2, -8, -8, 0,
                                  -8, 8,  0, 0,  -8, 2, 1, -3, 1, -1, 3, 1, 0, 8, 2, 0,  -8, 2,
                                  4,  -8, 4, 8,  -8, 0, 0, 8,  2, 8,  8, 0, 8, 8, 0, 8,  -8, 0};
  const int32_t curve_id[8] = {1, 2, 3, 4, 5, 6, 4, 7}, reversed[8] = {0, 0, 0, 0, 0, 0, 0, 1}, leaflet_id[2] = {1, 7};
  riis_patches arrays;
  riis_valve *of = NULL;
  TRY(riis_patches_init(&arrays, sizeof arrays));
  arrays.n_curves = 7;
  arrays.degree = degree;
  arrays.control = control;
  arrays.n_patches = 2;
  arrays.curve_id = curve_id;
  arrays.reversed = reversed;
  arrays.leaflet_id = leaflet_id;
  arrays.index_base = 1;
  TRY(riis_valve_create_from_patches(&arrays, &of));
  return make_other_surface(&of, &patches, &numbers->patches);
}

static riis_status make_plate(void) {
  /* Two quads, then two of their triangles, one of them moved, and a third triangle without area. */
  const double x[6] = {-9, 0, 9, -9, 0, 9}, y[6] = {-9, -9, -9, 9, 9, 9}, z[6] = {0, 0.5, 0, 0, 0.5, 0};
  const int64_t quads[8] = {1, 2, 5, 4, 2, 3, 6, 5};
  const int32_t triangles[9] = {0, 1, 4, 1, 1, 2, 2, 5, 4}, leaflet_id[3] = {3, 4, 5};
  riis_surface_arrays arrays;
  TRY(riis_surface_arrays_init(&arrays, sizeof arrays));
  arrays.n_vertices = 6;
  arrays.x = x;
  arrays.y = y;
  arrays.z = z;
  arrays.n_faces = 2;
  arrays.vertex_ids = quads;
  arrays.id_bits = 64;
  arrays.index_base = 1;
  arrays.corners_per_face = 4;
  TRY(riis_surface_create_from_arrays(&arrays, NULL, &plate));

  riis_surface_options options;
  TRY(riis_surface_options_init(&options, sizeof options));
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  options.flip_normals = 1;
  arrays.n_faces = 3;
  arrays.vertex_ids = triangles;
  arrays.id_bits = 32;
  arrays.index_base = 0;
  arrays.corners_per_face = 3;
  arrays.leaflet_id = leaflet_id;
  return riis_surface_update_from_arrays(plate, &arrays, &options);
}

static riis_status find_closest(int64_t n_nodes, const double *xyz, twin_numbers *numbers) {
  TRY(riis_closest_point(surface, xyz, &numbers->closest, sizeof numbers->closest));
  riis_closest_arrays *all = &numbers->all;
  TRY(riis_closest_arrays_init(all, sizeof *all));
  all->distance = allocate(n_nodes, sizeof *all->distance);
  all->point = allocate(3 * n_nodes, sizeof *all->point);
  all->barycentric = allocate(3 * n_nodes, sizeof *all->barycentric);
  all->normal = allocate(3 * n_nodes, sizeof *all->normal);
  all->triangle_id = allocate(n_nodes, sizeof *all->triangle_id);
  all->leaflet_id = allocate(n_nodes, sizeof *all->leaflet_id);
  all->side = allocate(n_nodes, sizeof *all->side);
  riis_closest_options options;
  TRY(riis_closest_options_init(&options, sizeof options));
  options.distance_limit = 12;
  options.far_distance = -1;
  options.n_threads = 2;
  return closest_points_of(plate, n_nodes, xyz, xyz + 1, xyz + 2, 3, &options, all);
}

static const uint8_t *mask_every_seventh(int64_t n_nodes) {
  uint8_t *node_mask = allocate(n_nodes, sizeof *node_mask);
  for (int64_t i = 0; i < n_nodes; ++i) node_mask[i] = i % 7 != 0;
  return node_mask;
}

static riis_status mark(int64_t n_nodes, const double *xyz, twin_numbers *numbers) {
  TRY(riis_mesh_create(1, xyz, xyz + 1, xyz + 2, 3, &mesh));
  TRY(riis_mesh_update(mesh, n_nodes, xyz, xyz + 1, xyz + 2, 3));
  TRY(riis_mesh_prepare(mesh, 2));
  TRY(riis_marks_create(&result));
  TRY(riis_mark_nodes(surface, mesh, NULL, result));

  riis_mark_options options;
  TRY(riis_mark_options_init(&options, sizeof options));
  options.distance_limit = 2.5;
  options.node_mask = mask_every_seventh(n_nodes);
  options.search = RIIS_SEARCH_EXHAUSTIVE;
  options.n_threads = 2;
  TRY(riis_mark_nodes(surface, mesh, &options, result));

  TRY(riis_marks_get_list(result, RIIS_LIST_MARKED, &numbers->marked, sizeof numbers->marked));
  TRY(riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, &numbers->within_limit, sizeof numbers->within_limit));
  uint8_t *dense_mark = allocate(n_nodes, sizeof *dense_mark);
  double *distance = allocate(n_nodes, sizeof *distance);
  int64_t *triangle_id = allocate(n_nodes, sizeof *triangle_id);
  int32_t *leaflet_id = allocate(n_nodes, sizeof *leaflet_id);
  TRY(dense_of(result, n_nodes, RIIS_FAR_DISTANCE, dense_mark, distance, triangle_id, leaflet_id));
  numbers->dense_mark = dense_mark;
  numbers->dense_distance = distance;
  numbers->dense_triangle_id = triangle_id;
  numbers->dense_leaflet_id = leaflet_id;
  return riis_marks_get_stats(result, &numbers->stats, sizeof numbers->stats);
}

/* Cuts every cube of the grid into six tetrahedra, each along a path from its first corner to its last. */
static riis_status make_cells(int64_t n) {
  const int64_t nn = n * n, paths[6][2] = {{1, n}, {1, nn}, {n, 1}, {n, nn}, {nn, 1}, {nn, n}};
  const int64_t n_cells = 6 * (n - 1) * (n - 1) * (n - 1);
  int64_t *node_ids = allocate(4 * n_cells, sizeof *node_ids), *next = node_ids;
  for (int64_t k = 0; k < n - 1; ++k)
    for (int64_t j = 0; j < n - 1; ++j)
      for (int64_t i = 0; i < n - 1; ++i)
        for (int path = 0; path < 6; ++path) {
          *next++ = i + n * (j + n * k);
          for (int step = 0; step < 2; ++step, ++next) *next = next[-1] + paths[path][step];
          *next++ = (i + 1) + n * (j + 1 + n * (k + 1));
        }
  riis_mesh_cells cells;
  TRY(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = n * n * n;
  cells.n_cells = n_cells;
  cells.node_ids = node_ids;
  cells.id_bits = 64;
  return riis_adjacency_create_from_cells(&cells, &of_cells);
}

/* Makes a mesh of cell centres at the grid's nodes, with faces at one of its boundaries. */
static riis_status make_faces(int64_t n) {
  const int64_t steps[3] = {1, n, n * n};
  int64_t n_faces = 0, *owner = allocate(3 * n * n * n, sizeof *owner);
  int64_t *neighbor = allocate(3 * n * n * n, sizeof *neighbor);
  for (int64_t node = 0; node < n * n * n; ++node)
    for (int axis = 0; axis < 3; ++axis, ++n_faces) {
      const int is_last = node / steps[axis] % n == n - 1;
      owner[n_faces] = node;
      neighbor[n_faces] = is_last ? -1 : node + steps[axis];
    }
  riis_mesh_faces faces;
  TRY(riis_mesh_faces_init(&faces, sizeof faces));
  faces.n_cells = n * n * n;
  faces.n_faces = n_faces;
  faces.owner = owner;
  faces.neighbor = neighbor;
  faces.id_bits = 64;
  return riis_adjacency_create_from_faces(&faces, &of_faces);
}

/* Marks by walking along an adjacency, with a new result that holds no earlier marking. */
static riis_status walk(const riis_adjacency *along, int32_t search, const uint8_t *node_mask, riis_csr *csr,
                        riis_mark_stats *stats) {
  riis_mark_options options;
  riis_marks *walked = NULL;
  TRY(riis_adjacency_get_csr(along, csr, sizeof *csr));
  TRY(riis_mesh_set_adjacency(mesh, csr));
  TRY(riis_mark_options_init(&options, sizeof options));
  options.distance_limit = 2.5;
  options.node_mask = node_mask;
  options.search = search;
  options.n_threads = 2;
  TRY(riis_marks_create(&walked));
  TRY(riis_mark_nodes(surface, mesh, &options, walked));
  TRY(riis_marks_get_stats(walked, stats, sizeof *stats));
  riis_marks_destroy(&walked);
  return riis_mesh_set_adjacency(mesh, NULL);
}

/* Marks with a small half thickness, and finds the edges of the tetrahedra that leak. */
static riis_status find_leaks(twin_leaks *leaks) {
  riis_surface_options surface_options;
  riis_mark_options options;
  riis_csr csr;
  TRY(riis_surface_options_init(&surface_options, sizeof surface_options));
  surface_options.scale = 10;
  surface_options.half_thickness = 0.3;
  TRY(riis_valve_create("aortic", &thin_valve));
  TRY(riis_surface_create(thin_valve, &surface_options, &thin));
  TRY(riis_adjacency_get_csr(of_cells, &csr, sizeof csr));
  TRY(riis_mesh_set_adjacency(mesh, &csr));
  TRY(riis_marks_create(&leaking));
  TRY(riis_mark_nodes(thin, mesh, NULL, leaking));
  TRY(riis_mark_options_init(&options, sizeof options));
  options.n_threads = 2;
  TRY(riis_leaks_create(&leaks_found));
  TRY(riis_find_leaks(thin, mesh, leaking, &options, leaks_found));
  TRY(riis_leaks_get_list(leaks_found, &leaks->list, sizeof leaks->list));
  const int64_t from = 0, to = csr.n_rows - 1;
  free(region_labels);
  region_labels = malloc((size_t)csr.n_rows * sizeof *region_labels);
  TRY(riis_label_open_regions(mesh, leaking, &options, csr.n_rows, region_labels, &leaks->n_regions));
  leaks->label = region_labels;
  TRY(find_passage_between(thin, mesh, &options, 1, &from, 1, &to, &leaks->passage, sizeof leaks->passage));
  return riis_mesh_set_adjacency(mesh, NULL);
}

/* Finds the crossings of an aortic valve whose right cusp is turned into its neighbours. */
static riis_status find_crossings(riis_crossing_list *list) {
  const double turned[3] = {0, 0, 60};
  riis_valve *crossing_valve = NULL;
  riis_crossing_options options;
  TRY(riis_valve_create("aortic", &crossing_valve));
  TRY(riis_valve_set(crossing_valve, "right.rotation", 3, turned));
  TRY(riis_surface_create(crossing_valve, NULL, &crossed));
  riis_valve_destroy(&crossing_valve);
  TRY(riis_crossing_options_init(&options, sizeof options));
  options.depth = 1e-3;
  TRY(riis_crossings_create(&crossings_found));
  TRY(riis_find_crossings(crossed, &options, crossings_found));
  return riis_crossings_get_list(crossings_found, list, sizeof *list);
}

static riis_status walk_along_all(int64_t per_side, twin_numbers *numbers) {
  const int64_t n_nodes = per_side * per_side * per_side;
  const uint8_t *node_mask = mask_every_seventh(n_nodes);
  riis_csr csr;
  TRY(make_cells(per_side));
  TRY(make_faces(per_side));
  TRY(riis_adjacency_create_from_grid(per_side, per_side, per_side, 2, &of_grid));
  TRY(walk(of_cells, RIIS_SEARCH_NEIGHBOR, node_mask, &numbers->cells.csr, &numbers->cells.stats));
  TRY(walk(of_faces, RIIS_SEARCH_NEIGHBOR, node_mask, &numbers->faces.csr, &numbers->faces.stats));
  TRY(walk(of_grid, RIIS_SEARCH_NEIGHBOR, node_mask, &numbers->grid.csr, &numbers->grid.stats));
  TRY(walk(of_grid, RIIS_SEARCH_PAPER, node_mask, &csr, &numbers->paper));
  return find_leaks(&numbers->leaks);
}

/* The valve opens by 0.1 in 5 ms while it moves by 0.01 mm. It is marked with all fields, up to a limit beyond the half
 * thickness. */
static riis_status resist(int64_t n_nodes, const double *xyz, twin_motion *motion) {
  riis_valve *before = NULL, *now = NULL, *open = NULL;
  riis_surface_options options, options_before;
  TRY(riis_valve_create("aortic", &before));
  TRY(riis_valve_create("aortic", &open));
  TRY(riis_valve_set_scalar(open, "leaflet_radius_in", 1.1));
  TRY(riis_valve_set_open_state(before, open));
  TRY(riis_valve_copy(before, &now));
  TRY(riis_valve_set_scalar(before, "opening", 0.3));
  TRY(riis_valve_set_scalar(now, "opening", 0.4));
  TRY(riis_surface_options_init(&options, sizeof options));
  options.scale = 10;
  options_before = options;
  options_before.translation[2] = -0.01;
  TRY(riis_surface_create(before, &options_before, &moving));
  TRY(riis_surface_update_moving(moving, now, before, 0.005, &options, &options_before));
  TRY(riis_surface_add_direction(moving, now, before, 0.1, NULL, NULL));
  TRY(riis_surface_add_direction(moving, now, now, 0.01, &options, &options_before));
  TRY(riis_surface_get_direction(moving, 1, &motion->direction, sizeof motion->direction));
  riis_valve_destroy(&open);
  riis_valve_destroy(&now);
  riis_valve_destroy(&before);
  TRY(list_surface(moving, &motion->surface));

  riis_mark_options mark_options;
  TRY(riis_mark_options_init(&mark_options, sizeof mark_options));
  mark_options.distance_limit = 2.5;
  mark_options.n_threads = 2;
  mark_options.fields = 511;
  riis_resistance listed;
  TRY(riis_resistance_init(&listed, sizeof listed));
  listed.R = 3;
  mark_options.resistance = &listed;
  TRY(riis_marks_create(&resisting));
  TRY(riis_mark_nodes(moving, mesh, &mark_options, resisting));
  TRY(riis_marks_get_list(resisting, RIIS_LIST_MARKED, &motion->marked, sizeof motion->marked));
  TRY(riis_marks_get_list(resisting, RIIS_LIST_WITHIN_LIMIT, &motion->within_limit, sizeof motion->within_limit));

  riis_resistance resistance;
  TRY(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 7;
  resistance.half_thickness = 2;
  resistance.rim = RIIS_RIM_CUT;
  double *coefficient = allocate(n_nodes, sizeof *coefficient);
  double *momentum = allocate(3 * n_nodes, sizeof *momentum);
  for (int64_t i = 0; i < n_nodes; ++i) coefficient[i] = 0.25;
  for (int64_t i = 0; i < 3 * n_nodes; ++i) momentum[i] = -1;
  TRY(add_resistance_to(resisting, &resistance, n_nodes, coefficient, momentum));
  motion->coefficient = coefficient;
  motion->momentum = momentum;
  /* The flow's velocity equals the coordinates, and every node is weighted with its coefficient. */
  for (int c = 0; c < 30; ++c) motion->force[c] = c;
  riis_flow_arrays flow;
  TRY(riis_flow_arrays_init(&flow, sizeof flow));
  flow.n_nodes = n_nodes;
  for (int c = 0; c < 3; ++c) flow.velocity[c] = xyz + c;
  flow.velocity_stride = 3;
  flow.weight = coefficient;
  riis_attachment attachment;
  TRY(riis_surface_get_attachment(moving, &attachment, sizeof attachment));
  riis_reaction reaction;
  TRY(riis_reaction_init(&reaction, sizeof reaction));
  reaction.about[1] = 0.5;
  reaction.force = motion->force, reaction.moment = motion->force + 3;
  reaction.n_leaflets = 3;
  reaction.leaflet_force = motion->force + 6, reaction.leaflet_moment = motion->force + 15;
  reaction.n_edges = 1;
  reaction.edges = attachment.edges;
  reaction.edge_force = motion->force + 24, reaction.edge_moment = motion->force + 27;
  TRY(riis_marks_add_reaction(resisting, &resistance, &flow, &reaction));
  return band_sums_of(resisting, 0.5, 2, n_nodes, coefficient, coefficient, &motion->sums, sizeof motion->sums);
}

/* A square is lifted by 1 and bent. Its surface is made at the first frame, then updated. */
static riis_status move_by_frames(twin_motion *motion) {
  const int32_t quad[4] = {0, 1, 2, 3};
  const double time[2] = {0, 0.5};
  const double xyz[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1.25, 0, 1, 1};
  riis_surface_arrays faces;
  riis_keyframe_arrays frames;
  riis_keyframes *keyframes = NULL;
  TRY(riis_surface_arrays_init(&faces, sizeof faces));
  faces.n_vertices = 4;
  faces.n_faces = 1;
  faces.vertex_ids = quad;
  faces.corners_per_face = 4;
  TRY(riis_keyframe_arrays_init(&frames, sizeof frames));
  frames.n_keys = 2;
  frames.n_vertices = 4;
  frames.time = time;
  frames.xyz = xyz;
  TRY(riis_keyframes_create(&faces, &frames, &keyframes));
  TRY(riis_surface_create_from_keyframes(keyframes, 0, 0, NULL, &framed));
  TRY(riis_surface_update_from_keyframes(framed, keyframes, 0.25, 0.125, NULL));
  riis_keyframes_destroy(&keyframes);
  return list_surface(framed, &motion->framed);
}

static riis_status open_by_laws(twin_laws *laws) {
  const double time[3] = {0, 0.3, 0.5}, openings[3] = {0, 1, 0.2};
  riis_opening_table table;
  TRY(riis_opening_table_init(&table, sizeof table));
  table.n_keys = 3;
  table.time = time;
  table.opening = openings;
  table.interpolation = RIIS_INTERPOLATION_CUBIC;
  TRY(riis_opening_from_table(&table, 0.1, &laws->by_table[0], &laws->by_table[1]));
  riis_opening_times times;
  TRY(riis_opening_times_init(&times, sizeof times));
  times.opening_start = 0.45;
  times.opening_duration = 0.05;
  times.closing_start = 0.95;
  times.closing_duration = 0.05;
  TRY(riis_opening_from_times(&times, 0.47, &laws->by_times[0], &laws->by_times[1]));
  riis_opening_switch by_switch;
  TRY(riis_opening_switch_init(&by_switch, sizeof by_switch));
  TRY(riis_opening_switch_state_init(&laws->by_switch, sizeof laws->by_switch));
  by_switch.opening_duration = 0.04;
  by_switch.closing_duration = 0.05;
  riis_opening_angle by_angle;
  TRY(riis_opening_angle_init(&by_angle, sizeof by_angle));
  TRY(riis_opening_angle_state_init(&laws->by_angle, sizeof laws->by_angle));
  by_angle.pressure_gain = 5500;
  by_angle.flow_gain = 2;
  by_angle.friction = 50;
  by_angle.vortex_gain = 7;
  for (int step = 1; step <= 5; ++step) {
    TRY(riis_opening_switch_advance(&by_switch, &laws->by_switch, 0.003 * step, 2, 10 * step, &laws->by_switch));
    TRY(riis_opening_angle_advance(&by_angle, &laws->by_angle, 0.003 * step, 2, 10 * step, &laws->by_angle));
  }
  return RIIS_OK;
}

riis_status twin_run(int64_t per_side, const double *xyz, twin_numbers *numbers) {
  const int64_t n_nodes = per_side * per_side * per_side;
  TRY(make_surface(numbers));
  TRY(make_mitral(numbers));
  TRY(make_opening(numbers));
  TRY(make_patches(numbers));
  TRY(make_plate());
  TRY(find_closest(n_nodes, xyz, numbers));
  TRY(mark(n_nodes, xyz, numbers));
  TRY(resist(n_nodes, xyz, &numbers->motion));
  TRY(move_by_frames(&numbers->motion));
  TRY(find_crossings(&numbers->crossings));
  TRY(open_by_laws(&numbers->laws));
  return walk_along_all(per_side, numbers);
}

void twin_end(void) {
  riis_marks_destroy(&resisting);
  riis_surface_destroy(&moving);
  riis_surface_destroy(&framed);
  riis_surface_destroy(&crossed);
  riis_marks_destroy(&leaking);
  riis_leaks_destroy(&leaks_found);
  riis_crossings_destroy(&crossings_found);
  free(region_labels);
  region_labels = NULL;
  riis_surface_destroy(&thin);
  riis_valve_destroy(&thin_valve);
  riis_marks_destroy(&result);
  riis_mesh_destroy(&mesh);
  riis_adjacency_destroy(&of_grid);
  riis_adjacency_destroy(&of_faces);
  riis_adjacency_destroy(&of_cells);
  riis_surface_destroy(&patches);
  riis_surface_destroy(&opening);
  riis_surface_destroy(&mitral);
  riis_surface_destroy(&plate);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  while (n_memory > 0) free(memory[--n_memory]);
}

double twin_auto(void) { return RIIS_AUTO; }
double twin_far_distance(void) { return RIIS_FAR_DISTANCE; }
