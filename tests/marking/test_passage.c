/* SPDX-License-Identifier: Apache-2.0
 * Compares the widest passage with a binary search over half thicknesses, which makes a flood fill for each half thickness. Also
 * compares the passage with holes of known position and size. RIIS_TEST_LONG=1 tries many more cases. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "random_meshes.h"

#include "flood_fill.h"

/* --- The serial search --------------------------------------------------------------------------------------------------- */

typedef struct near_node {
  double distance;
  int64_t node;
} near_node;

/* Compares two nodes. The nearer node comes first. At equal distances the node with the higher id comes first. */
static int nearer(const void *a, const void *b) {
  const near_node *p = a, *q = b;
  if (p->distance != q->distance) return p->distance < q->distance ? -1 : 1;
  return (p->node < q->node) - (p->node > q->node);
}

typedef struct ends {
  int64_t n_from, n_to, from[20], to[20];
} ends;

static int are_joined(const test_mesh *rows, const uint8_t *is_open, const ends *e, int64_t *label) {
  flood_fill(rows, is_open, label);
  for (int64_t i = 0; i < e->n_from; ++i)
    for (int64_t k = 0; k < e->n_to; ++k)
      if (label[e->from[i]] >= 0 && label[e->from[i]] == label[e->to[k]]) return 1;
  return 0;
}

static void open_nodes_of(const uint8_t *mask, int64_t n, uint8_t *is_open) {
  for (int64_t i = 0; i < n; ++i) is_open[i] = mask[i];
}

/* Nodes are closed in the order of their distances. Bisection finds the node whose closing separates the two ends. */
static riis_passage expected_passage(const test_mesh *rows, const riis_surface *surface, const uint8_t *mask,
                                     const ends *e) {
  const size_t n = (size_t)rows->n;
  near_node *order = malloc(n * sizeof *order);
  int64_t *label = malloc(n * sizeof *label), low = 0, high = rows->n;
  uint8_t *is_open = malloc(n);
  riis_passage made = {.node_id = -1, .state = RIIS_PASSAGE_NONE};
  for (int64_t i = 0; i < rows->n; ++i) {
    const double *p = rows->xyz + 3 * i;
    order[i] = (near_node){closest_to(surface, p[0], p[1], p[2]).distance, i};
  }
  qsort(order, n, sizeof *order, nearer);
  /* Closing the nodes before `low` leaves the ends joined. Closing the nodes up to `high` separates the ends. */
  while (low < high) {
    const int64_t middle = low + (high - low) / 2;
    open_nodes_of(mask, rows->n, is_open);
    for (int64_t i = 0; i <= middle; ++i) is_open[order[i].node] = 0;
    if (are_joined(rows, is_open, e, label))
      low = middle + 1;
    else
      high = middle;
  }
  open_nodes_of(mask, rows->n, is_open);
  for (int64_t i = 0; i < low; ++i) is_open[order[i].node] = 0;
  if (low < rows->n && are_joined(rows, is_open, e, label)) {
    made.node_id = order[low].node, made.distance = order[low].distance;
    memcpy(made.point, rows->xyz + 3 * made.node_id, sizeof made.point);
    made.state = made.distance > info_of(surface).half_thickness ? RIIS_PASSAGE_OPEN : RIIS_PASSAGE_CLOSED;
  }
  free(order), free(label), free(is_open);
  return made;
}

static riis_passage passage_of(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options *options,
                               const ends *e) {
  riis_passage found;
  memset(&found, 0x5a, sizeof found);
  CHECK_OK(find_passage_between(surface, mesh, options, e->n_from, e->from, e->n_to, e->to, &found, sizeof found));
  assert_true(found.seconds >= 0);
  return found;
}

static void check_same(riis_passage found, riis_passage expected) {
  found.seconds = expected.seconds = 0;
  if (memcmp(&found, &expected, sizeof found))
    fail_msg("state %d at node %lld, %.17g; expected %d at node %lld, %.17g", found.state, (long long)found.node_id,
             found.distance, expected.state, (long long)expected.node_id, expected.distance);
}

static int is_among(int64_t node, const int64_t *ids, int64_t n) {
  int64_t i = 0;
  while (i < n && ids[i] != node) ++i;
  return i < n;
}

/* Chooses two ends of a passage outside the band. Returns 0 if the mesh has too few nodes outside the band. */
static int random_ends(const test_mesh *rows, const riis_surface *surface, const uint8_t *mask, ends *e) {
  const double half_thickness = info_of(surface).half_thickness;
  e->n_from = e->n_to = 0;
  const int64_t n_wanted = one_in(2) ? 1 : random_integer(1, 20);
  for (int tries = 0; tries < 200; ++tries) {
    const int64_t node = random_integer(0, rows->n - 1);
    const double *p = rows->xyz + 3 * node;
    if (!mask[node] || !(closest_to(surface, p[0], p[1], p[2]).distance > half_thickness)) continue;
    if (tries % 2 && e->n_from < n_wanted) e->from[e->n_from++] = node;
    const int may_be_both = one_in(20);
    if (tries % 2 == 0 && e->n_to < n_wanted && (may_be_both || !is_among(node, e->from, e->n_from)))
      e->to[e->n_to++] = node;
  }
  return e->n_from > 0 && e->n_to > 0;
}

/* Checks one graph. Returns the passage's state, or -1 if there were no ends. */
static int check_graph(const test_mesh *graph, const riis_surface *surface) {
  const test_mesh rows = both_ways(graph);
  riis_mesh *mesh = mesh_of_graph(graph);
  riis_mark_options options = mark_options();
  uint8_t *mask = own(malloc((size_t)graph->n));
  memset(mask, 1, (size_t)graph->n);
  if (one_in(3)) {
    for (int64_t i = 0; i < graph->n; ++i) mask[i] = !one_in(10);
    options.node_mask = mask;
  }
  ends e;
  if (!random_ends(&rows, surface, mask, &e)) return -1;
  const riis_passage expected = expected_passage(&rows, surface, mask, &e);
  for (int t = 0; t < 3; ++t) {
    options.n_threads = 1 << t;
    check_same(passage_of(surface, mesh, &options, &e), expected);
  }
  return expected.state;
}

TEST(graphs_have_the_passage_of_the_serial_search) {
  int64_t n_of_state[3] = {0}, n = trials(200, 20000);
  for (int64_t trial = 0; trial < n; ++trial) {
    const int owned_before = n_owned();
    const test_mesh graph = random_graph(random_integer(2, 300), random_between(&rng, 0.5, 3));
    const int found = check_graph(&graph, random_surface());
    if (found >= 0) ++n_of_state[found];
    free_owned_after(owned_before);
  }
  printf("%d closed, %d open, %d without a path\n", (int)n_of_state[0], (int)n_of_state[1], (int)n_of_state[2]);
  CHECK_MET(n_of_state[RIIS_PASSAGE_OPEN] > 0 && n_of_state[RIIS_PASSAGE_NONE] > 0);
}

/* In lattices around a plate, many nodes are at equal distances. */
TEST(meshes_have_the_passage_of_the_serial_search) {
  int64_t n_of_state[3] = {0}, n = trials(100, 4000);
  for (int64_t trial = 0; trial < n; ++trial) {
    const int owned_before = n_owned();
    static const double lower[3] = {-1, -1, -1}, upper[3] = {1, 1, 1};
    static const double plate[12] = {-0.9, -2, 0, 2, -2, 0, 2, 2, 0, -0.9, 2, 0};
    static const int32_t ids[6] = {0, 1, 2, 0, 2, 3};
    double spacing;
    const riis_surface_arrays arrays = triangle_arrays(4, plate, 2, ids);
    riis_surface_options options = surface_options();
    options.half_thickness = random_between(&rng, 0.05, 0.4);
    const test_mesh mesh = random_mesh((int)(trial % n_kinds), 700, lower, upper, &spacing);
    const int found = check_graph(&mesh, one_in(4) ? random_surface() : surface_from(&arrays, &options));
    if (found >= 0) ++n_of_state[found];
    free_owned_after(owned_before);
  }
  printf("%d closed, %d open\n", (int)n_of_state[0], (int)n_of_state[1]);
  CHECK_MET(n_of_state[RIIS_PASSAGE_OPEN] > 0 && n_of_state[RIIS_PASSAGE_CLOSED] > 0);
}

/* At a half thickness equal to the passage's distance, nothing joins the ends. At a smaller half thickness, a path joins them.
 */
TEST(the_distance_is_what_just_closes) {
  static const int32_t ids[18] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17};
  double xyz[54];
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    static const double lower[3] = {-1, -1, -1}, upper[3] = {1, 1, 1};
    double spacing;
    for (int i = 0; i < 54; ++i) xyz[i] = random_between(&rng, -1, 1);
    const riis_surface_arrays arrays = triangle_arrays(18, xyz, 6, ids);
    riis_surface_options options = surface_options();
    options.half_thickness = 1e-3;
    riis_surface *surface = surface_from(&arrays, &options);
    const test_mesh nodes = random_mesh(jittered, 3000, lower, upper, &spacing);
    riis_mesh *mesh = mesh_from(&nodes);
    uint8_t *mask = own(malloc((size_t)nodes.n));
    memset(mask, 1, (size_t)nodes.n);
    ends e;
    assert_true(random_ends(&nodes, surface, mask, &e));
    const riis_passage found = passage_of(surface, mesh, NULL, &e);
    assert_int_equal(found.state, RIIS_PASSAGE_OPEN);
    for (int closes = 0; closes < 2; ++closes) {
      options.half_thickness = closes ? found.distance : nextafter(found.distance, 0);
      CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, &options));
      riis_marks *result = new_result();
      int64_t *label = own(malloc((size_t)nodes.n * sizeof *label));
      CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
      CHECK_OK(riis_label_open_regions(mesh, result, NULL, nodes.n, label, NULL));
      int joined = 0;
      for (int64_t i = 0; i < e.n_from; ++i)
        for (int64_t k = 0; k < e.n_to; ++k)
          joined = joined || (label[e.from[i]] >= 0 && label[e.from[i]] == label[e.to[k]]);
      assert_int_equal(joined, !closes);
    }
    free_owned_after(owned_before);
  }
}

/* --- Holes --------------------------------------------------------------------------------------------------------------- */

enum { n_sides = 24 };

/* Makes the square [-2, 2]^2 at z = 0 with a hole. The hole is a regular polygon of this radius around `place`. */
static riis_surface *plate_with_hole(const double *place, double radius, double half_thickness) {
  double xyz[6 * n_sides];
  int32_t ids[6 * n_sides];
  for (int32_t i = 0; i < n_sides; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / n_sides, c = cos(angle), s = sin(angle);
    const double out = 2 / fmax(fabs(c), fabs(s));
    const int32_t next = (i + 1) % n_sides,
                  corners[6] = {2 * i, 2 * i + 1, 2 * next + 1, 2 * i, 2 * next + 1, 2 * next};
    memcpy(ids + 6 * i, corners, sizeof corners);
    const double points[6] = {place[0] + radius * c, place[1] + radius * s, 0, out * c, out * s, 0};
    memcpy(xyz + 6 * i, points, sizeof points);
  }
  const riis_surface_arrays arrays = triangle_arrays(2 * n_sides, xyz, 2 * n_sides, ids);
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness;
  return surface_from(&arrays, &options);
}

/* One node is the middle of the hole. The distance of this node is the distance to the polygon's sides. */
TEST(a_hole_is_found_where_it_is) {
  const test_mesh nodes = tube(1.2, -1, 1, 0.05);
  riis_mesh *mesh = mesh_from(&nodes);
  const ends e = {1, 1, {node_at(&nodes, 0, 0, -1)}, {node_at(&nodes, 0, 0, 1)}};
  for (int trial = 0; trial < trials_of(24); ++trial) {
    const int owned_before = n_owned();
    const int64_t i = random_integer(-14, 14), k = random_integer(-14, 14);
    const double radius = random_between(&rng, 0.15, 0.4), place[2] = {0.05 * (double)i, 0.05 * (double)k};
    const int is_open = trial % 2;
    const double apothem = radius * cos(3.14159265358979323846 / n_sides);
    const double half_thickness = is_open ? 0.1 : fmin(0.49, 1.1 * apothem);
    const riis_passage found = passage_of(plate_with_hole(place, radius, half_thickness), mesh, NULL, &e);
    assert_int_equal(found.state, is_open ? RIIS_PASSAGE_OPEN : RIIS_PASSAGE_CLOSED);
    CHECK_NEAR(found.distance, apothem, 1e-14);
    assert_int_equal(found.node_id, node_at(&nodes, place[0], place[1], 0));
    CHECK_NEAR(hypot(found.point[0] - place[0], found.point[1] - place[1]), 0, 1e-14);
    CHECK_NEAR(found.point[2], 0, 1e-14);
    free_owned_after(owned_before);
  }
}

/* --- Valves -------------------------------------------------------------------------------------------------------------- */

static riis_valve *aortic_with_free_edges_at(double radius_in) {
  riis_valve *valve = new_valve("aortic");
  if (radius_in > 0) CHECK_OK(riis_valve_set_scalar(valve, "leaflet_radius_in", radius_in));
  return valve;
}

/* At opening 0, the paper's aortic valve has a hole along its axis that no usual half thickness closes. If the inner radii are
 * 0.02, the cusps nearly meet there. */
TEST(the_papers_aortic_valve_leaks_along_its_axis) {
  const test_mesh nodes = tube(1.2, -1, 1.5, 0.05);
  riis_mesh *mesh = mesh_from(&nodes);
  const ends e = {1, 1, {node_at(&nodes, 0, 0, -1)}, {node_at(&nodes, 0, 0, 1.5)}};
  static const double half_thicknesses[] = {0.1, 0.15, 0.2};
  for (int i = 0; i < 3; ++i) {
    riis_surface_options options = surface_options();
    options.half_thickness = half_thicknesses[i];
    const riis_passage open = passage_of(new_surface(aortic_with_free_edges_at(0), &options), mesh, NULL, &e);
    assert_int_equal(open.state, RIIS_PASSAGE_OPEN);
    assert_true(open.distance > 0.3 && open.distance < 0.33 && hypot(open.point[0], open.point[1]) < 0.2);
    const riis_passage closed = passage_of(new_surface(aortic_with_free_edges_at(0.02), &options), mesh, NULL, &e);
    assert_int_equal(closed.state, RIIS_PASSAGE_CLOSED);
    /* The expected distance lies between the distances of two places: a node on the axis, and the corners of three free edges. */
    CHECK_NEAR(closed.distance, 0.02 * sqrt(2), 1e-3);
    assert_true(hypot(closed.point[0], closed.point[1]) < 0.01);
  }
}

static double distance_of(const double *p, const double *q) {
  return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
}

/* Copies the surface without the triangles that have a vertex in the ball. *reach gets the largest distance of these triangles'
 * corners from the ball's centre. */
static riis_surface *without_ball(const riis_surface *surface, const double *centre, double radius, double *reach) {
  const riis_triangles all = triangles_of(surface);
  int32_t *ids = own(malloc((size_t)all.n_triangles * 3 * sizeof *ids));
  int64_t n = 0;
  *reach = radius;
  for (int64_t t = 0; t < all.n_triangles; ++t) {
    double nearest = INFINITY, farthest = 0;
    for (int k = 0; k < 3; ++k) {
      ids[3 * n + k] = (int32_t)all.vertex_id[3 * t + k];
      const double distance = distance_of(all.xyz + 3 * all.vertex_id[3 * t + k], centre);
      nearest = fmin(nearest, distance), farthest = fmax(farthest, distance);
    }
    if (nearest < radius)
      *reach = fmax(*reach, farthest);
    else
      ++n;
  }
  const riis_surface_arrays arrays = triangle_arrays(all.n_vertices, all.xyz, n, ids);
  riis_surface_options options = surface_options();
  options.half_thickness = info_of(surface).half_thickness;
  return surface_from(&arrays, &options);
}

/* A hole into the narrow gap between two leaflets may stay closed. The hole's centre is therefore far from other leaflets. */
static const double *centre_of_hole(const riis_triangles *all) {
  for (;;) {
    const int64_t t = random_integer(0, all->n_triangles - 1), leaflet = all->patch_id[t] / 4;
    const double *centre = all->xyz + 3 * all->vertex_id[3 * t];
    double to_others = INFINITY;
    for (int64_t k = 0; k < 3 * all->n_triangles; ++k)
      if (all->patch_id[k / 3] / 4 != leaflet)
        to_others = fmin(to_others, distance_of(all->xyz + 3 * all->vertex_id[k], centre));
    if (hypot(centre[0], centre[1]) <= 0.8 && to_others > 0.3) return centre;
  }
}

TEST(a_pierced_leaflet_is_found_where_it_is) {
  const test_mesh nodes = tube(1.2, -1, 1.5, 0.05);
  riis_mesh *mesh = mesh_from(&nodes);
  const ends e = {1, 1, {node_at(&nodes, 0, 0, -1)}, {node_at(&nodes, 0, 0, 1.5)}};
  riis_surface_options options = surface_options();
  options.tolerance = 0.01; /* the triangles are small, so the hole is hardly larger than the ball */
  riis_surface *valve = new_surface(aortic_with_free_edges_at(0.02), &options);
  const riis_triangles all = triangles_of(valve);
  for (int trial = 0; trial < trials_of(24); ++trial) {
    const int owned_before = n_owned();
    const double radius = random_between(&rng, 0.2, 0.3), *centre = centre_of_hole(&all);
    double reach;
    const riis_passage found = passage_of(without_ball(valve, centre, radius, &reach), mesh, NULL, &e);
    assert_int_equal(found.state, RIIS_PASSAGE_OPEN);
    CHECK_AT_MOST(distance_of(found.point, centre), reach);
    free_owned_after(owned_before);
  }
}

/* A passage is also found if distances are measured to points of the patches, as the paper does. */
TEST(other_distances_have_passages) {
  const test_mesh nodes = tube(1.2, -1, 1.5, 0.15);
  riis_mesh *mesh = mesh_from(&nodes);
  const ends e = {1, 1, {node_at(&nodes, 0, 0, -1)}, {node_at(&nodes, 0, 0, 1.5)}};
  riis_surface_options options = surface_options();
  riis_passage by_triangles = {0};
  for (options.measure = RIIS_MEASURE_TRIANGLES; options.measure <= RIIS_MEASURE_MINIMIZATION; ++options.measure) {
    const riis_passage found = passage_of(new_surface(aortic_with_free_edges_at(0), &options), mesh, NULL, &e);
    if (options.measure == RIIS_MEASURE_TRIANGLES) by_triangles = found;
    assert_int_equal(found.state, RIIS_PASSAGE_OPEN);
    CHECK_NEAR(found.distance, by_triangles.distance, 0.01); /* the two methods differ by at most twice the tolerance */
  }
}

/* --- Refusals ------------------------------------------------------------------------------------------------------------ */

TEST(what_makes_no_sense_is_refused) {
  const test_mesh nodes = tube(1.2, -1, 1, 0.2);
  riis_mesh *mesh = mesh_from(&nodes), *bare = mesh_of(nodes.n, nodes.xyz);
  static const double place[2] = {0, 0};
  riis_surface *surface = plate_with_hole(place, 0.5, 0.15);
  const int64_t below = node_at(&nodes, 0, 0, -1), above = node_at(&nodes, 0, 0, 1);
  const int64_t good[2] = {below, above}, outside[2] = {above, nodes.n}, negative[1] = {-1};
  const int64_t in_band[3] = {above, above, node_at(&nodes, 0.8, 0, 0)};
  riis_passage found;
  memset(&found, 0x5a, sizeof found);
#define REFUSED(status, parts, mesh, options, n_from, from, n_to, to) \
  CHECK_REFUSED(status, parts,                                        \
                find_passage_between(surface, mesh, options, n_from, from, n_to, to, &found, sizeof found))
  REFUSED(RIIS_INVALID_ARGUMENT, "mesh has no adjacency|riis_mesh_set_adjacency", bare, NULL, 1, good, 1, good + 1);
  REFUSED(RIIS_INVALID_ARGUMENT, "n_from is 0|at least 1", mesh, NULL, 0, good, 1, good + 1);
  REFUSED(RIIS_INVALID_ARGUMENT, "n_to is -3|at least 1", mesh, NULL, 1, good, -3, good + 1);
  REFUSED(RIIS_INVALID_ARGUMENT, "from is NULL", mesh, NULL, 1, NULL, 1, good + 1);
  REFUSED(RIIS_INVALID_ARGUMENT, "to is NULL", mesh, NULL, 1, good, 1, NULL);
  REFUSED(RIIS_INVALID_ARGUMENT, "from[0] is -1", mesh, NULL, 1, negative, 1, good);
  REFUSED(RIIS_INVALID_ARGUMENT, "to[1] is|the mesh has", mesh, NULL, 1, good, 2, outside);
  REFUSED(RIIS_INVALID_ARGUMENT, "to[2] is node|in the band|half thickness, 0.15", mesh, NULL, 1, good, 3, in_band);
  riis_mark_options options = mark_options();
  uint8_t *mask = own(malloc((size_t)nodes.n));
  memset(mask, 1, (size_t)nodes.n);
  mask[above] = 0;
  options.node_mask = mask;
  REFUSED(RIIS_INVALID_ARGUMENT, "to[0] is node|options.node_mask leaves out", mesh, &options, 1, good, 1, good + 1);
  options = mark_options();
  options.n_threads = -1;
  REFUSED(RIIS_INVALID_ARGUMENT, "options.n_threads is -1", mesh, &options, 1, good, 1, good + 1);
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "passage is 48|56",
                find_passage_between(surface, mesh, NULL, 1, good, 1, good + 1, &found, 48));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "passage is 64|56",
                find_passage_between(surface, mesh, NULL, 1, good, 1, good + 1, &found, 64));
  nodes.xyz[20] = NAN;
  REFUSED(RIIS_INVALID_MESH, "z of node 6 is nan", mesh, NULL, 1, good, 1, good + 1);
  assert_int_equal(found.node_id, 0x5a5a5a5a5a5a5a5a);
}

int main(void) {
  rng = random_start("test_passage");
  return run_cases(NULL, NULL);
}
