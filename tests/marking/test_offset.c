/* SPDX-License-Identifier: Apache-2.0
 * Tests bands with an offset, for every kind of valve. Marks, K and its derivatives, passages and leaks are compared with an
 * oracle that loops over all triangles. Passages and leaks are also compared with flood fills. RIIS_TEST_LONG=1 tries many more
 * cases. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "band_oracle.h"
#include "random_meshes.h"

#include "flood_fill.h"

#include "band_floods.h"

static const char *const valve_kinds[] = {"aortic", "trileaflet", "coapting", "mitral", "bileaflet"};
enum { n_valve_kinds = 5 };

static double random_offset(void) { return random_between(&rng, -0.95, 0.95); }

static riis_valve *random_valve(const char *kind) {
  riis_valve *valve = new_valve(kind);
  const double opening = one_in(3) ? 0 : one_in(3) ? 1 : random_between(&rng, 0, 1), skirt = 0.2;
  CHECK_OK(riis_valve_set(valve, "opening", 1, &opening));
  if (strcmp(kind, "bileaflet") != 0 && one_in(2)) CHECK_OK(riis_valve_set(valve, "skirt_length", 1, &skirt));
  return valve;
}

/* Places the valve obliquely, with a random half thickness and tolerance. */
static riis_surface_options random_options(double offset) {
  riis_surface_options options = surface_options();
  options.scale = random_power_of_ten(&rng, -1, 1);
  for (int c = 0; c < 3; ++c) {
    options.rotation_axis[c] = random_between(&rng, 0.1, 1);
    options.translation[c] = options.scale * random_between(&rng, -3, 3);
  }
  options.rotation_angle = random_between(&rng, -180, 180);
  options.half_thickness = options.scale * random_between(&rng, 0.06, 0.25);
  options.tolerance = random_between(&rng, 0.1, 0.5);
  options.triangulation = one_in(2) ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
  options.offset = offset;
  return options;
}

/* Makes a mesh of any kind around the surface. */
static test_mesh mesh_around(const riis_surface *surface, int64_t n, double margin) {
  const riis_surface_info info = info_of(surface);
  double lower[3], upper[3], spacing;
  for (int c = 0; c < 3; ++c) lower[c] = info.lower[c] - margin, upper[c] = info.upper[c] + margin;
  return random_mesh((int)random_integer(0, n_kinds - 1), n, lower, upper, &spacing);
}

static riis_surface *with_offset(const riis_valve *valve, riis_surface_options options, double offset, int flips) {
  options.offset = offset;
  options.flip_normals = flips;
  return new_surface(valve, &options);
}

static const int32_t searches[] = {RIIS_SEARCH_AUTO, RIIS_SEARCH_EXHAUSTIVE, RIIS_SEARCH_NEIGHBOR,
                                   RIIS_SEARCH_CLUSTERS};

static void check_same_list(riis_mark_list a, riis_mark_list b) {
  assert_true(same_nodes(found_in(a), found_in(b)));
  for (int64_t i = 0; i < a.n_nodes; ++i) {
    CHECK_SAME(a.K[i], b.K[i]);
    assert_int_equal(a.rim[i], b.rim[i]);
    assert_int_equal(a.side[i], b.side[i]);
    for (int c = 0; c < 3; ++c) CHECK_SAME(a.point[3 * i + c], b.point[3 * i + c]);
  }
}

/* Marks with a wide limit. Compares the marks with the oracle, and then with all other ways to mark. */
static void check_marking(const char *kind) {
  riis_valve *valve = random_valve(kind);
  const double offset = random_offset();
  const riis_surface_options options = random_options(offset);
  const double eps = options.half_thickness, reach = (1 + fabs(offset)) * eps;
  riis_surface *surface = new_surface(valve, &options), *plain = with_offset(valve, options, 0, 0),
               *turned = with_offset(valve, options, -offset, 1);
  const test_mesh nodes = mesh_around(surface, 3000, 1.5 * reach);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *marks = new_result(), *other = new_result();
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 100;
  resistance.rim = one_in(2) ? RIIS_RIM_CUT : RIIS_RIM_ROUND;
  riis_mark_options asked = mark_options();
  asked.fields = RIIS_FIELD_POINT | RIIS_FIELD_SIDE | RIIS_FIELD_RIM;
  asked.resistance = &resistance;
  asked.distance_limit = reach * random_between(&rng, 1.01, 1.6);
  CHECK_OK(riis_mark_nodes(surface, mesh, &asked, marks));
  const riis_mark_list within = within_list(marks), marked = marked_list(marks);
  const riis_triangles all = triangles_of(surface);
  assert_int_equal(stats_of(marks).n_marked, marked.n_nodes);
  assert_int_equal(stats_of(marks).n_within_limit, within.n_nodes);
  /* An offset does not change distances, sides, closest points and triangles, which all belong to the leaflet. */
  riis_mark_options plain_options = asked;
  CHECK_OK(riis_mark_nodes(plain, mesh, &plain_options, other));
  const riis_mark_list of_plain = within_list(other);
  assert_true(same_nodes(found_in(within), found_in(of_plain)));
  for (int64_t i = 0; i < within.n_nodes; ++i) {
    assert_int_equal(within.side[i], of_plain.side[i]);
    for (int c = 0; c < 3; ++c) CHECK_SAME(within.point[3 * i + c], of_plain.point[3 * i + c]);
  }
  /* The oracle. */
  const double most = resistance.R / (eps * eps);
  int64_t at = 0;
  for (int64_t i = 0; i < within.n_nodes; ++i) {
    const band_place place = place_of(&all, nodes.xyz + 3 * within.node_id[i], within.triangle_id[i], within.rim[i]);
    const double middle = (double)from_middle(&place, eps, offset);
    const int is_marked = at < marked.n_nodes && marked.node_id[at] == within.node_id[i];
    if (fabs(middle - eps) > 1e-9 * eps) assert_int_equal(is_marked, middle < eps);
    CHECK_NEAR(within.K[i], oracle_K(&place, resistance.R, eps, offset, resistance.rim == RIIS_RIM_CUT), 1e-12 * most);
    if (!is_marked) CHECK_SAME(within.K[i], 0.0);
    if (is_marked) CHECK_SAME(marked.K[at], within.K[i]);
    at += is_marked;
  }
  assert_int_equal(at, marked.n_nodes);
  /* Every search gives the same lists, with and without a limit, on any number of threads. The opposite offset with reversed
   * normals gives the same lists. */
  for (int k = 0; k < 4; ++k)
    for (int has_limit = 0; has_limit < 2; ++has_limit) {
      riis_mark_options again = asked;
      again.search = searches[k];
      again.n_threads = (int32_t)random_integer(1, 3);
      if (!has_limit) again.distance_limit = RIIS_AUTO;
      CHECK_OK(riis_mark_nodes(surface, mesh, &again, other));
      check_same_list(marked_list(other), marked);
      check_same_list(within_list(other), has_limit ? within : marked);
      assert_int_equal(stats_of(other).complete, 1);
    }
  CHECK_OK(riis_mark_nodes(turned, mesh, &asked, other));
  /* Reversed triangles have their corners in another order, so their distances are rounded differently. */
  const riis_mark_list of_turned = marked_list(other);
  assert_int_equal(of_turned.n_nodes, marked.n_nodes);
  for (int64_t i = 0; i < marked.n_nodes; ++i) {
    assert_int_equal(of_turned.node_id[i], marked.node_id[i]);
    CHECK_NEAR(of_turned.distance[i], marked.distance[i], 1e-12 * eps);
    CHECK_NEAR(of_turned.K[i], marked.K[i], 1e-11 * most);
  }
  /* A resistance may have a separate half thickness. */
  double *K = own(calloc((size_t)nodes.n, sizeof *K));
  resistance.half_thickness = eps * random_between(&rng, 0.3, 1);
  CHECK_OK(add_resistance_to(marks, &resistance, nodes.n, K, NULL));
  for (int64_t i = 0; i < within.n_nodes; ++i) {
    const band_place place = place_of(&all, nodes.xyz + 3 * within.node_id[i], within.triangle_id[i], within.rim[i]);
    const double own_eps = resistance.half_thickness;
    CHECK_NEAR(K[within.node_id[i]], oracle_K(&place, resistance.R, own_eps, offset, resistance.rim == RIIS_RIM_CUT),
               1e-12 * resistance.R / (own_eps * own_eps));
  }
  /* Sums near the surface. */
  double *ones = own(malloc((size_t)nodes.n * sizeof *ones));
  for (int64_t i = 0; i < nodes.n; ++i) ones[i] = 1;
  const double outer = eps * random_between(&rng, 0.4, 1), inner = outer * random_between(&rng, 0, 1);
  int64_t n[2] = {0, 0};
  riis_band_sums sums;
  for (int64_t i = 0; i < within.n_nodes; ++i) {
    const band_place place = place_of(&all, nodes.xyz + 3 * within.node_id[i], within.triangle_id[i], within.rim[i]);
    const double over = (double)(place.height - (real)offset * eps);
    if (!within.rim[i] && fabs(over) >= inner && fabs(over) <= outer) ++n[over > 0];
  }
  CHECK_OK(band_sums_of(marks, inner, outer, nodes.n, ones, ones, &sums, sizeof sums));
  for (int side = 0; side < 2; ++side) {
    assert_int_equal(sums.n_nodes[side], n[side]);
    CHECK_NEAR(sums.sum[side], (double)n[side], 1e-9);
  }
}

TEST(marks_and_K_are_those_of_the_oracle) {
  const int n = trials_of(8);
  for (int trial = 0; trial < n; ++trial)
    for (int kind = 0; kind < n_valve_kinds; kind += trial_step()) {
      const int n_before = n_owned();
      check_marking(valve_kinds[kind]);
      free_owned_after(n_before);
    }
}

/* Away from the rim, K equals the formula to 3e-16 of its maximum. */
TEST(a_flat_sheet_has_the_formula) {
  static const double corner[12] = {-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0};
  static const int32_t ids[6] = {0, 1, 2, 0, 2, 3};
  const riis_surface_arrays arrays = triangle_arrays(4, corner, 2, ids);
  riis_surface_options options = surface_options();
  options.half_thickness = 0.5, options.offset = 0.75;
  riis_surface *surface = surface_from(&arrays, &options);
  double xyz[3 * 400];
  for (int i = 0; i < 400; ++i) {
    xyz[3 * i] = random_between(&rng, -5, 5), xyz[3 * i + 1] = random_between(&rng, -5, 5);
    xyz[3 * i + 2] = random_between(&rng, -1, 1);
  }
  xyz[2] = 0, xyz[5] = 0.375, xyz[8] = 0.874999, xyz[11] = -0.124999;
  riis_mesh *mesh = mesh_of(400, xyz);
  riis_marks *marks = new_result();
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 3;
  riis_mark_options asked = mark_options();
  asked.resistance = &resistance;
  asked.fields = RIIS_FIELD_SIDE;
  CHECK_OK(riis_mark_nodes(surface, mesh, &asked, marks));
  const riis_mark_list list = within_list(marks);
  const double most = 3 / 0.25;
  int64_t at = 0;
  for (int64_t i = 0; i < 400; ++i) {
    if (fabs(xyz[3 * i + 2] - 0.375) > 0.5) continue;
    assert_int_equal(list.node_id[at], i);
    CHECK_NEAR(list.side[at] * list.distance[at], xyz[3 * i + 2], 1e-14);
    const double middle = fabs(list.side[at] * list.distance[at] - 0.375);
    CHECK_NEAR(list.K[at], 3 / 0.5 * (1 + cos(acos(-1) * (middle / 0.5))), 3e-16 * most);
    ++at;
  }
  assert_int_equal(at, list.n_nodes);
  CHECK_NEAR(list.K[1], most, 1e-13);
  CHECK_NEAR(list.K[2], 0, 1e-9);
}

/* --- Passages and leaks ---------------------------------------------------------------------------------------------------- */

static void check_passage(const char *kind) {
  riis_valve *valve = new_valve(kind);
  const double opening = one_in(2) ? 0 : random_between(&rng, 0, 0.6), skirt = 0.3;
  CHECK_OK(riis_valve_set(valve, "opening", 1, &opening));
  if (strcmp(kind, "bileaflet") != 0) CHECK_OK(riis_valve_set(valve, "skirt_length", 1, &skirt));
  riis_surface_options options = surface_options();
  options.half_thickness = 0.1, options.tolerance = 0.3;
  riis_surface *made = new_surface(valve, &options);
  const double offset = one_in(3) ? 0.75 : random_offset();
  riis_surface *surface = same_triangles(made, 0.1, offset);
  const double radius = strcmp(kind, "mitral") == 0 ? 1.9 : 1.2;
  const test_mesh grid = tube(radius, -1.8, 1.8, random_between(&rng, 0.12, 0.2)), rows = both_ways(&grid);
  riis_mesh *mesh = mesh_from(&grid);
  const int64_t from = node_at(&grid, 0, 0, -1.8), to = node_at(&grid, 0, 0, 1.8);
  riis_passage passage;
  CHECK_OK(find_passage_between(surface, mesh, NULL, 1, &from, 1, &to, &passage, sizeof passage));
  if (passage.node_id < 0) return;
  uint8_t *is_open = own(malloc((size_t)grid.n));
  int64_t *label = own(malloc((size_t)grid.n * sizeof *label));
  assert_int_equal(passage.state, passage.distance > 0.1 ? RIIS_PASSAGE_OPEN : RIIS_PASSAGE_CLOSED);
  for (int sign = -1; sign <= 1; sign += 2) {
    const double eps = passage.distance * (1 + 0.01 * sign);
    if (!(eps > 1e-6)) continue;
    open_nodes(surface, &grid, eps, offset, is_open);
    flood_fill(&rows, is_open, label);
    const int is_joined = label[from] >= 0 && label[from] == label[to];
    if (is_joined != (sign < 0))
      fail_msg("%s, opening %g, offset %g: %d at %g times the half thickness %g", kind, opening, offset, is_joined,
               1 + 0.01 * sign, passage.distance);
  }
  /* The passage's half thickness marks the node, but the next smaller double does not. */
  for (int k = 0; k < 2 && passage.distance > 1e-6; ++k) {
    riis_surface *again = same_triangles(surface, k == 0 ? passage.distance : passage.distance * (1 - 4e-16), offset);
    riis_marks *marks = new_result();
    uint8_t *mark = own(malloc((size_t)grid.n));
    CHECK_OK(riis_mark_nodes(again, mesh, NULL, marks));
    CHECK_OK(dense_of(marks, grid.n, 1e30, mark, NULL, NULL, NULL));
    assert_int_equal(mark[passage.node_id], k == 0);
  }
}

TEST(passages_tell_the_half_thickness_that_closes_them) {
  const int n = trials_of(12);
  for (int trial = 0; trial < n; ++trial)
    for (int kind = 0; kind < n_valve_kinds; kind += trial_step()) {
      const int n_before = n_owned();
      check_passage(valve_kinds[kind]);
      free_owned_after(n_before);
    }
}

/* Returns whether a segment meets a triangle, in long double. With random nodes, rounding does not decide the answer. */
static int meets(const double *a, const double *b, real (*corner)[3]) {
  real ab[3], e1[3], e2[3], s[3], p[3], q[3];
  for (int c = 0; c < 3; ++c) {
    ab[c] = (real)b[c] - a[c], e1[c] = corner[1][c] - corner[0][c], e2[c] = corner[2][c] - corner[0][c];
    s[c] = a[c] - corner[0][c];
  }
  cross3(ab, e2, p), cross3(s, e1, q);
  const real det = dot3(e1, p), u = dot3(s, p) / det, v = dot3(ab, q) / det, t = dot3(e2, q) / det;
  return det != 0 && u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1;
}

/* The boxes around all triangles: the least and the largest x, y and z. */
static double *boxes_of(const riis_triangles *all) {
  double *boxes = own(malloc((size_t)all->n_triangles * 6 * sizeof *boxes));
  for (int64_t t = 0; t < all->n_triangles; ++t)
    for (int c = 0; c < 3; ++c) {
      double low = INFINITY, high = -INFINITY;
      for (int k = 0; k < 3; ++k) {
        const double at = all->xyz[3 * all->vertex_id[3 * t + k] + c];
        low = fmin(low, at), high = fmax(high, at);
      }
      boxes[6 * t + c] = low, boxes[6 * t + 3 + c] = high;
    }
  return boxes;
}

/* Returns whether a segment's box has no point in common with another box. */
static int is_apart(const double *a, const double *b, const double *box) {
  for (int c = 0; c < 3; ++c)
    if (fmax(a[c], b[c]) < box[c] || fmin(a[c], b[c]) > box[3 + c]) return 1;
  return 0;
}

static int n_fold_edges = 0;

static void check_leaks(const char *kind) {
  riis_valve *valve = random_valve(kind);
  riis_surface_options options = surface_options();
  options.half_thickness = random_between(&rng, 0.03, 0.1), options.tolerance = 0.5;
  options.offset = one_in(3) ? 0.75 : random_offset();
  options.rotation_axis[0] = 0.3, options.rotation_angle = random_between(&rng, 0, 180);
  riis_surface *surface = new_surface(valve, &options);
  const double eps = options.half_thickness, offset = options.offset;
  const test_mesh grid = mesh_around(surface, 2500, 2 * eps);
  riis_mesh *mesh = mesh_from(&grid);
  riis_marks *marks = new_result();
  riis_mark_options asked = mark_options();
  asked.n_threads = (int32_t)random_integer(1, 3);
  CHECK_OK(riis_mark_nodes(surface, mesh, &asked, marks));
  riis_leaks *leaks = NULL;
  CHECK_OK(riis_leaks_create(&leaks));
  own(leaks);
  CHECK_OK(riis_find_leaks(surface, mesh, marks, &asked, leaks));
  riis_leak_list list;
  CHECK_OK(riis_leaks_get_list(leaks, &list, sizeof list));
  /* The list has all nodes with their rims and triangles. */
  asked.fields = RIIS_FIELD_RIM;
  asked.distance_limit = 1e6;
  riis_marks *everywhere = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh, &asked, everywhere));
  const riis_mark_list everything = within_list(everywhere);
  const riis_triangles all = triangles_of(surface);
  assert_int_equal(everything.n_nodes, grid.n);
  const double *boxes = boxes_of(&all);
  band_place *place = own(malloc((size_t)grid.n * sizeof *place));
  for (int64_t i = 0; i < grid.n; ++i)
    place[i] = place_of(&all, grid.xyz + 3 * i, everything.triangle_id[i], everything.rim[i]);
  /* An edge may stand in the row of only one of its two nodes. */
  uint8_t *is_edge = own(calloc((size_t)(grid.n * grid.n), 1));
  for (int64_t i = 0; i < grid.n; ++i)
    for (int64_t k = grid.offsets[i]; k < grid.offsets[i + 1]; ++k) {
      const int64_t j = grid.columns[k];
      if (j < grid.n) is_edge[i < j ? i * grid.n + j : j * grid.n + i] = 1;
    }
  int64_t at = 0;
  for (int64_t i = 0; i < grid.n; ++i)
    for (int64_t j = i + 1; j < grid.n; ++j) {
      if (!is_edge[i * grid.n + j]) continue;
      int crosses = 0;
      if (from_middle(place + i, eps, offset) <= eps || from_middle(place + j, eps, offset) <= eps) continue;
      for (int64_t t = 0; t < all.n_triangles && !crosses; ++t) {
        real corner[3][3];
        if (is_apart(grid.xyz + 3 * i, grid.xyz + 3 * j, boxes + 6 * t)) continue;
        band_corners(&all, t, corner);
        crosses = meets(grid.xyz + 3 * i, grid.xyz + 3 * j, corner);
      }
      if (!crosses) continue;
      if (!place[i].is_on_rim && !place[j].is_on_rim && (place[i].height > 0) == (place[j].height > 0)) {
        ++n_fold_edges;
        continue;
      }
      assert_true(at < list.n_edges);
      assert_int_equal(list.node_id[2 * at], i);
      assert_int_equal(list.node_id[2 * at + 1], j);
      /* The half thickness that closes the edge marks one of the edge's nodes. A slightly smaller half thickness marks neither
       * node. */
      const double told = list.distance[at++];
      for (int sign = -1; sign <= 1; sign += 2) {
        const double e = told * (1 + 1e-9 * sign);
        assert_int_equal(from_middle(place + i, e, offset) <= e || from_middle(place + j, e, offset) <= e, sign > 0);
      }
    }
  assert_int_equal(at, list.n_edges);
  if (list.n_edges == 0) return;
  /* With exactly the list's half thickness, each edge has a marked node. */
  riis_surface_options thicker = options;
  thicker.half_thickness = list.half_thickness;
  thicker.tolerance = options.tolerance * eps / list.half_thickness; /* the same triangles */
  if (thicker.tolerance < 1e-6) return;
  riis_surface *closing = new_surface(valve, &thicker);
  if (triangles_of(closing).n_vertices != all.n_vertices ||
      memcmp(triangles_of(closing).xyz, all.xyz, (size_t)all.n_vertices * 3 * sizeof *all.xyz) != 0)
    return;
  riis_marks *closed = new_result();
  uint8_t *mark = own(malloc((size_t)grid.n));
  CHECK_OK(riis_mark_nodes(closing, mesh, NULL, closed));
  CHECK_OK(dense_of(closed, grid.n, 1e30, mark, NULL, NULL, NULL));
  for (int64_t i = 0; i < list.n_edges; ++i) assert_true(mark[list.node_id[2 * i]] || mark[list.node_id[2 * i + 1]]);
}

TEST(leaks_are_those_of_a_loop_over_all_edges) {
  const int n = trials_of(8);
  for (int trial = 0; trial < n; ++trial)
    for (int kind = 0; kind < n_valve_kinds; kind += trial_step()) {
      const int n_before = n_owned();
      check_leaks(valve_kinds[kind]);
      free_owned_after(n_before);
    }
  printf("edges that only cut off a fold: %d\n", n_fold_edges);
}

/* --- Derivatives ------------------------------------------------------------------------------------------------------------ */

/* Computes K at the nodes after the triangles have moved along the direction. */
static void K_of_moved(const riis_surface *surface, const riis_direction *direction, double step, const double *nodes,
                       int64_t n, const riis_mark_options *asked, double *K) {
  const riis_triangles all = triangles_of(surface);
  const riis_surface_info info = info_of(surface);
  double *xyz = own(malloc((size_t)all.n_vertices * 3 * sizeof *xyz));
  for (int64_t i = 0; i < 3 * all.n_vertices; ++i) xyz[i] = all.xyz[i] + step * direction->rate[i];
  riis_surface_arrays arrays = triangle_arrays(all.n_vertices, xyz, all.n_triangles, NULL);
  arrays.vertex_ids = all.vertex_id, arrays.id_bits = 64;
  riis_surface_options options = surface_options();
  options.half_thickness = info.half_thickness, options.offset = info.offset;
  riis_surface *moved = surface_from(&arrays, &options);
  riis_mesh *mesh = mesh_of(n, nodes);
  riis_marks *marks = new_result();
  riis_mark_options only_K = *asked;
  only_K.fields = 0;
  CHECK_OK(riis_mark_nodes(moved, mesh, &only_K, marks));
  memset(K, 0, (size_t)n * sizeof *K);
  const riis_mark_list list = within_list(marks);
  for (int64_t i = 0; i < list.n_nodes; ++i) K[list.node_id[i]] = list.K[i];
}

static int64_t n_derivatives, n_on_surface, n_at_rim, n_far_off;

/* Makes nodes near the surface: over triangles, on both sides, and beside rims. */
static void check_gradients(const char *kind) {
  riis_valve *valve = new_valve(kind), *after = new_valve(kind), *before = new_valve(kind);
  const double opening = random_between(&rng, 0.3, 0.7), dp = 1e-5, R = 10;
  const double states[3] = {opening, opening + dp / 2, opening - dp / 2};
  CHECK_OK(riis_valve_set(valve, "opening", 1, &states[0]));
  CHECK_OK(riis_valve_set(after, "opening", 1, &states[1]));
  CHECK_OK(riis_valve_set(before, "opening", 1, &states[2]));
  riis_surface_options options = surface_options();
  options.half_thickness = 0.1, options.tolerance = 0.2, options.offset = random_offset();
  riis_surface *surface = new_surface(valve, &options);
  CHECK_OK(riis_surface_add_direction(surface, after, before, dp, NULL, NULL));
  riis_direction direction;
  CHECK_OK(riis_surface_get_direction(surface, 0, &direction, sizeof direction));
  const riis_triangles all = triangles_of(surface);
  enum { n = 1500 };
  double *xyz = own(malloc(3 * n * sizeof *xyz)), fastest = 0;
  for (int64_t i = 0; i < 3 * all.n_vertices; ++i) fastest = fmax(fastest, fabs(direction.rate[i]));
  for (int64_t i = 0; i < n; ++i) {
    real corner[3][3];
    band_corners(&all, random_integer(0, all.n_triangles - 1), corner);
    const double u = random_between(&rng, 0, 1), v = random_between(&rng, 0, 1 - u), far = i % 3 == 0 ? 0 : 0.15;
    for (int c = 0; c < 3; ++c)
      xyz[3 * i + c] = (double)(corner[0][c] + u * (corner[1][c] - corner[0][c]) + v * (corner[2][c] - corner[0][c])) +
                       random_between(&rng, -far, far);
  }
  riis_mesh *mesh = mesh_of(n, xyz);
  riis_marks *marks = new_result();
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = R;
  riis_mark_options asked = mark_options();
  asked.fields = RIIS_FIELD_GRADIENT | RIIS_FIELD_RIM | RIIS_FIELD_POINT | RIIS_FIELD_BARYCENTRIC;
  asked.resistance = &resistance;
  asked.distance_limit = 0.25;
  CHECK_OK(riis_mark_nodes(surface, mesh, &asked, marks));
  const riis_mark_list list = within_list(marks);
  double *K[4];
  const double steps[4] = {1e-5, -1e-5, 2e-5, -2e-5};
  for (int k = 0; k < 4; ++k) {
    K[k] = own(malloc(n * sizeof *K[k]));
    K_of_moved(surface, &direction, steps[k], xyz, n, &asked, K[k]);
  }
  const double most = R / 0.01 * 16 * fastest; /* larger than the largest derivative */
  for (int64_t i = 0; i < list.n_nodes; ++i) {
    const int64_t node = list.node_id[i];
    const double near = (K[0][node] - K[1][node]) / 2e-5, wide = (K[2][node] - K[3][node]) / 4e-5;
    const double second = (K[0][node] + K[1][node] - 2 * list.K[i]) / 1e-5;
    /* K has a kink at a node with a tie, or if the node's closest triangle changes between the states, so such nodes are left
       out. */
    if (fabs(near - wide) > 1e-5 * most || fabs(second) > 1e-3 * most) continue;
    ++n_derivatives, n_on_surface += list.distance[i] < 1e-12, n_at_rim += list.rim[i] && list.K[i] > 0;
    if (fabs(list.K_gradient[i] - near) > 1e-4 * most) {
      if (++n_far_off > 3)
        fail_msg("%s, offset %g: derivative %g, difference %g of %g, distance %g, rim %d", kind, options.offset,
                 list.K_gradient[i], near, most, list.distance[i], list.rim[i]);
    }
  }
}

TEST(derivatives_of_K_are_those_of_differences) {
  const int n = trials_of(12);
  for (int trial = 0; trial < n; ++trial)
    for (int kind = 0; kind < n_valve_kinds; kind += trial_step()) {
      const int n_before = n_owned();
      check_gradients(valve_kinds[kind]);
      free_owned_after(n_before);
    }
  printf("%lld derivatives, %lld on the surface, %lld at rims, %lld kinks\n", (long long)n_derivatives,
         (long long)n_on_surface, (long long)n_at_rim, (long long)n_far_off);
  CHECK_MET(n_on_surface > n * 50 && n_at_rim > n * 20);
}

/* --- Refusals ------------------------------------------------------------------------------------------------------------ */

TEST(refusals) {
  riis_valve *valve = new_valve("trileaflet");
  riis_surface *surface = NULL;
  riis_surface_options options = surface_options();
  options.offset = 1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.offset is 1; it must be above -1 and below 1",
                riis_surface_create(valve, &options, &surface));
  options.offset = NAN;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.offset is nan", riis_surface_create(valve, &options, &surface));
  options.offset = 0.5, options.measure = RIIS_MEASURE_SAMPLING;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT,
                "options.offset is 0.5, but options.measure is 1, which does not tell the sides of a surface apart",
                riis_surface_create(valve, &options, &surface));
  options.measure = RIIS_MEASURE_TRIANGLES;
  /* Two triangles share an edge. The corners of both triangles run along the edge in the same direction, so the triangles'
   * normals are opposite. */
  static const double corner[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  static const int32_t turned[6] = {0, 1, 2, 0, 3, 2}, right[6] = {0, 1, 2, 0, 2, 3};
  riis_surface_arrays arrays = triangle_arrays(4, corner, 2, right);
  CHECK_OK(riis_surface_create_from_arrays(&arrays, &options, &surface));
  own(surface);
  arrays.vertex_ids = turned;
  CHECK_REFUSED(RIIS_INVALID_SURFACE, "options.offset is 0.5, but the triangles 0 and 1|same direction",
                riis_surface_update_from_arrays(surface, &arrays, &options));
  assert_true(info_of(surface).offset == 0.5); /* the surface stays */
  riis_surface *plain = NULL;
  CHECK_OK(riis_surface_create_from_arrays(&arrays, NULL, &plain));
  own(plain);
  static const double xyz[6] = {0.4, 0.4, 0.1, 5, 5, 5};
  riis_mesh *mesh = mesh_of(2, xyz);
  riis_marks *marks = new_result();
  riis_mark_options asked = mark_options();
  asked.distance_limit = 0.14;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT,
                "options.distance_limit is 0.14; it must be from the reach of the band with the offset 0.5",
                riis_mark_nodes(surface, mesh, &asked, marks));
  asked.distance_limit = 0.2;
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1, resistance.half_thickness = 0.14;
  asked.resistance = &resistance;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "half_thickness is 0.14, so with the offset 0.5 its band reaches",
                riis_mark_nodes(surface, mesh, &asked, marks));
  resistance.half_thickness = RIIS_AUTO;
  asked.fields = RIIS_FIELD_SIDE | RIIS_FIELD_RIM;
  CHECK_OK(riis_mark_nodes(surface, mesh, &asked, marks));
  riis_band_sums sums;
  static const double ones[2] = {1, 1};
  CHECK_OK(band_sums_of(marks, 0, 0.1, 2, ones, ones, &sums, sizeof sums));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "band.outer is 0.16; with the offset 0.5 it must be at most",
                band_sums_of(marks, 0, 0.16, 2, ones, ones, &sums, sizeof sums));
}

int main(void) {
  rng = random_start("test_offset");
  return run_cases(NULL, NULL);
}
