/* SPDX-License-Identifier: Apache-2.0
 * A mesh from axes gives, bit for bit, the results of a mesh that has these nodes as points. The results agree for all kinds of
 * surfaces, axes, strides, masks and limits. Some numbers of the grid belong to no node, and no result contains these numbers. */
#include <limits.h>
#include <math.h>
#include <riis/riis.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"
#include "shapes.h"

#include "flow_cases.h"
#include "leak_lists.h"

/* The axes of a grid, and its nodes as points in the order of their numbers. */
typedef struct {
  riis_grid grid;
  double *axis[3];
  int64_t n_numbers;
  riis_mesh *mesh, *points;
  int64_t n, *number, *node; /* the number of each node; the node of each number, or -1 */
} grid_case;

static riis_grid new_grid(int64_t ni, int64_t nj, int64_t nk) {
  riis_grid grid;
  CHECK_OK(riis_grid_init(&grid, sizeof grid));
  grid.ni = ni, grid.nj = nj, grid.nk = nk;
  return grid;
}
static riis_mesh *mesh_of_grid(const riis_grid *grid) {
  riis_mesh *mesh = NULL;
  CHECK_OK(riis_mesh_create_grid(grid, &mesh));
  return own(mesh);
}

/* Returns an ascending axis of n nodes. The steps between the axis's nodes differ by up to a factor of 10. */
static double *random_axis(int64_t n, double lower, double upper) {
  double *x = own(malloc((size_t)n * sizeof *x)), sum = 0;
  const int is_graded = any_of(2) == 0;
  for (int64_t i = 0; i < n; ++i) {
    x[i] = sum;
    sum += is_graded ? between(0.1, 1) : 1;
  }
  for (int64_t i = 0; i < n; ++i) x[i] = lower + (upper - lower) * (n == 1 ? between(0, 1) : x[i] / x[n - 1]);
  return x;
}

/* Makes two meshes with the same nodes, from the axes and from points. */
static void make_meshes(grid_case *of) {
  const int64_t n[3] = {of->grid.ni, of->grid.nj, of->grid.nk};
  int64_t stride[3], last = of->grid.first, n_pairs = 0;
  const int is_default = of->grid.stride[0] == 0;
  of->n = n[0] * n[1] * n[2];
  for (int c = 0; c < 3; ++c) {
    stride[c] = is_default ? (c == 0 ? 1 : c == 1 ? n[0] : n[0] * n[1]) : of->grid.stride[c];
    last += (n[c] - 1) * stride[c];
  }
  of->n_numbers = of->grid.n_nodes ? of->grid.n_nodes : last + 1;
  of->mesh = mesh_of_grid(&of->grid);
  test_mesh nodes = {.n = of->n, .xyz = own(malloc((size_t)of->n * 3 * sizeof(double)))};
  int64_t *pairs = own(malloc((size_t)of->n * 6 * sizeof *pairs)), t = 0;
  of->number = own(malloc((size_t)of->n * sizeof *of->number));
  of->node = own(malloc((size_t)of->n_numbers * sizeof *of->node));
  int64_t *place = own(malloc((size_t)of->n_numbers * sizeof *place));
  for (int64_t i = 0; i < of->n_numbers; ++i) place[i] = -1;
  for (int64_t i = 0; i < of->n; ++i)
    place[of->grid.first + i % n[0] * stride[0] + i / n[0] % n[1] * stride[1] + i / n[0] / n[1] * stride[2]] = i;
  for (int64_t i = 0; i < of->n_numbers; ++i) {
    of->node[i] = place[i] < 0 ? -1 : t;
    if (place[i] < 0) continue;
    const int64_t at[3] = {place[i] % n[0], place[i] / n[0] % n[1], place[i] / n[0] / n[1]};
    for (int c = 0; c < 3; ++c) nodes.xyz[3 * t + c] = of->axis[c][at[c]];
    of->number[t++] = i;
  }
  assert_int_equal(t, of->n);
  for (int64_t i = 0; i < of->n_numbers; ++i)
    for (int c = 0; c < 3 && place[i] >= 0; ++c) {
      const int64_t at = c == 0 ? place[i] % n[0] : c == 1 ? place[i] / n[0] % n[1] : place[i] / n[0] / n[1];
      if (at + 1 == n[c]) continue;
      pairs[2 * n_pairs] = of->node[i];
      pairs[2 * n_pairs++ + 1] = of->node[i + stride[c]];
    }
  set_rows(&nodes, n_pairs, pairs);
  of->points = mesh_with_rows(&nodes, nodes.n);
}

/* Gives random strides, with any order of the axes, with gaps and with halos. */
static void set_random_strides(riis_grid *grid) {
  const int64_t n[3] = {grid->ni, grid->nj, grid->nk};
  int order[3] = {0, 1, 2};
  for (int c = 2; c > 0; --c) {
    const int other = (int)any_of(c + 1), swap = order[c];
    order[c] = order[other], order[other] = swap;
  }
  int64_t way = 0;
  grid->first = any_of(3) * any_of(100);
  for (int c = 0; c < 3; ++c) {
    grid->stride[order[c]] = way + 1 + any_of(2) * any_of(4);
    way += (n[order[c]] - 1) * grid->stride[order[c]];
  }
  grid->n_nodes = grid->first + way + 1 + any_of(2) * any_of(100);
}

static grid_case random_grid(const riis_surface *surface, int64_t most, int has_strides) {
  const riis_surface_info info = info_of(surface);
  grid_case made = {.grid = new_grid(1 + any_of(most), 1 + any_of(most), 1 + any_of(most))};
  int64_t *const n[3] = {&made.grid.ni, &made.grid.nj, &made.grid.nk};
  const void **const axes[3] = {&made.grid.x, &made.grid.y, &made.grid.z};
  const int is_partial = any_of(3) == 0, has_thin_axis = any_of(8) == 0;
  for (int c = 0; c < 3; ++c) {
    const double size = info.upper[c] - info.lower[c] + 0.2;
    double lower = info.lower[c] - between(0, 0.4), upper = info.upper[c] + between(0, 0.4);
    if (is_partial) lower += size * between(-3, 0.6), upper = lower + size * between(0.3, 6);
    if (has_thin_axis && any_of(2) == 0) *n[c] = 1;
    made.axis[c] = random_axis(*n[c], lower, upper);
    *axes[c] = made.axis[c];
  }
  if (has_strides) set_random_strides(&made.grid);
  make_meshes(&made);
  return made;
}

/* --- Comparisons ----------------------------------------------------------------------------------------------------- */

static void check_array(const char *name, const void *got, const void *expected, int64_t n, size_t size) {
  if (!got != !expected) fail_msg("only one mesh has the array %s", name);
  if (got && memcmp(got, expected, (size_t)n * size) != 0) fail_msg("the array %s has other bits", name);
}

static int64_t n_leaks, n_passages, n_within, n_gradients;

static void check_lists(const grid_case *of, const riis_marks *got, const riis_marks *expected) {
  for (int32_t which = RIIS_LIST_MARKED; which <= RIIS_LIST_WITHIN_LIMIT; ++which) {
    riis_mark_list a, b;
    CHECK_OK(riis_marks_get_list(got, which, &a, sizeof a));
    CHECK_OK(riis_marks_get_list(expected, which, &b, sizeof b));
    assert_int_equal(a.n_nodes, b.n_nodes);
    for (int64_t i = 0; i < a.n_nodes; ++i) assert_int_equal(a.node_id[i], of->number[b.node_id[i]]);
#define ARRAY(name, per_node) check_array(#name, a.name, b.name, a.n_nodes *(per_node), sizeof *a.name)
    ARRAY(distance, 1), ARRAY(triangle_id, 1), ARRAY(leaflet_id, 1), ARRAY(K, 1), ARRAY(K_u_surface, 3);
    ARRAY(point, 3), ARRAY(normal, 3), ARRAY(barycentric, 3), ARRAY(uv, 2), ARRAY(velocity, 3);
    ARRAY(side, 1), ARRAY(rim, 1), ARRAY(patch_id, 1), ARRAY(height, 1);
    assert_int_equal(a.n_directions, b.n_directions);
    ARRAY(distance_gradient, a.n_directions), ARRAY(K_gradient, a.n_directions);
    if (a.n_nodes > 0) n_gradients += a.n_directions;
#undef ARRAY
  }
}

static void check_leaks(const grid_case *of, const riis_surface *surface, const riis_mark_options *options,
                        const riis_mark_options *of_points, const riis_marks *got, const riis_marks *expected) {
  const leak_list a = leaks_of(surface, of->mesh, options, got), b = leaks_of(surface, of->points, of_points, expected);
  assert_int_equal(a.sum.n_edges, b.sum.n_edges);
  for (int64_t i = 0; i < 2 * a.sum.n_edges; ++i) assert_int_equal(a.node_id[i], of->number[b.node_id[i]]);
  check_array("length", a.length, b.length, a.sum.n_edges, sizeof *a.length);
  check_array("distance", a.distance, b.distance, a.sum.n_edges, sizeof *a.distance);
  CHECK_SAME(a.sum.half_thickness, b.sum.half_thickness);
  CHECK_SAME(a.sum.longest_length, b.sum.longest_length);
  for (int c = 0; c < 3; ++c) CHECK_SAME(a.sum.longest_middle[c], b.sum.longest_middle[c]);
  n_leaks += a.sum.n_edges;
}

static void check_regions(const grid_case *of, const riis_mark_options *options, const riis_mark_options *of_points,
                          const riis_marks *got, const riis_marks *expected) {
  int64_t *a = own(malloc((size_t)of->n_numbers * sizeof *a)), *b = own(malloc((size_t)of->n * sizeof *b));
  int64_t n_regions = -1, n_expected = -1;
  CHECK_OK(riis_label_open_regions(of->mesh, got, options, of->n_numbers, a, &n_regions));
  CHECK_OK(riis_label_open_regions(of->points, expected, of_points, of->n, b, &n_expected));
  assert_int_equal(n_regions, n_expected);
  for (int64_t i = 0; i < of->n_numbers; ++i) {
    const int64_t node = of->node[i];
    assert_int_equal(a[i], node < 0 || b[node] < 0 ? -1 : of->number[b[node]]);
  }
}

static void check_passage(const grid_case *of, const riis_surface *surface, const riis_mark_options *options,
                          const riis_mark_options *of_points) {
  int64_t from[3], to[3], points_from[3], points_to[3];
  riis_passage_ends ends;
  riis_passage a, b;
  CHECK_OK(riis_passage_ends_init(&ends, sizeof ends));
  for (int i = 0; i < 3; ++i) {
    from[i] = of->number[points_from[i] = any_of(of->n)];
    to[i] = of->number[points_to[i] = any_of(of->n)];
  }
  ends.n_from = ends.n_to = 1 + any_of(3);
  ends.from = from, ends.to = to;
  const riis_status got = riis_find_passage(surface, of->mesh, &ends, options, &a, sizeof a);
  ends.from = points_from, ends.to = points_to;
  assert_int_equal(got, riis_find_passage(surface, of->points, &ends, of_points, &b, sizeof b));
  if (got != RIIS_OK) return;
  assert_int_equal(a.state, b.state);
  assert_int_equal(a.node_id, b.node_id < 0 ? -1 : of->number[b.node_id]);
  CHECK_SAME(a.distance, b.distance);
  for (int c = 0; c < 3; ++c) CHECK_SAME(a.point[c], b.point[c]);
  n_passages += a.state != RIIS_PASSAGE_NONE;
}

static void check_cells(const grid_case *of, const riis_marks *got, const riis_marks *expected) {
  riis_cells_across a, b;
  CHECK_OK(riis_marks_get_cells_across(got, of->mesh, &a, sizeof a));
  CHECK_OK(riis_marks_get_cells_across(expected, of->points, &b, sizeof b));
  assert_memory_equal(&a, &b, sizeof a);
}

/* Compares arrays over all numbers. The entries of numbers without a node must stay unchanged. */
static void check_node_arrays(const grid_case *of, const riis_marks *got, const riis_marks *expected) {
  const size_t n = (size_t)of->n_numbers;
  double *k[2], *u[2], *d[2], *velocity[2], *weight[2], force[2][3] = {{0, 0, 0}, {0, 0, 0}};
  const riis_resistance resistance = resistance_of(7);
  riis_band_sums sums[2];
  for (int p = 0; p < 2; ++p) {
    k[p] = own(malloc(n * sizeof(double))), u[p] = own(malloc(3 * n * sizeof(double)));
    d[p] = own(malloc(n * sizeof(double))), velocity[p] = own(malloc(3 * n * sizeof(double)));
    weight[p] = own(malloc(n * sizeof(double)));
  }
  for (size_t i = 0; i < 3 * n; ++i) u[0][i] = 1, velocity[0][i] = between(-1, 1);
  for (size_t i = 0; i < n; ++i) k[0][i] = 2, weight[0][i] = between(0, 1);
  for (int64_t i = 0; i < of->n; ++i) {
    const int64_t j = of->number[i];
    k[1][i] = k[0][j], weight[1][i] = weight[0][j];
    memcpy(u[1] + 3 * i, u[0] + 3 * j, 3 * sizeof(double));
    memcpy(velocity[1] + 3 * i, velocity[0] + 3 * j, 3 * sizeof(double));
  }
  const riis_marks *const marks[2] = {got, expected};
  for (int p = 0; p < 2; ++p) {
    const int64_t n_nodes = p == 0 ? of->n_numbers : of->n;
    CHECK_OK(add_resistance_to(marks[p], &resistance, n_nodes, k[p], u[p]));
    CHECK_OK(add_reaction_to(marks[p], &resistance, n_nodes, velocity[p], weight[p], force[p]));
    CHECK_OK(dense_of(marks[p], n_nodes, -1, NULL, d[p], NULL, NULL));
    riis_band band;
    CHECK_OK(riis_band_init(&band, sizeof band));
    band.n_nodes = n_nodes, band.outer = 0.01, band.value = k[p], band.weight = weight[p];
    CHECK_OK(riis_marks_get_band_sums(marks[p], &band, &sums[p], sizeof sums[p]));
  }
  assert_memory_equal(&sums[0], &sums[1], sizeof sums[0]);
  for (int c = 0; c < 3; ++c) CHECK_SAME(force[0][c], force[1][c]);
  for (int64_t i = 0; i < of->n_numbers; ++i) {
    const int64_t j = of->node[i];
    CHECK_SAME(k[0][i], j < 0 ? 2 : k[1][j]);
    CHECK_SAME(d[0][i], j < 0 ? -1 : d[1][j]);
    for (int c = 0; c < 3; ++c) CHECK_SAME(u[0][3 * i + c], j < 0 ? 1 : u[1][3 * j + c]);
  }
}

/* --- Random cases ---------------------------------------------------------------------------------------------------- */

static riis_surface *random_surface(int kind, int has_offset) {
  riis_surface_options options = surface_options();
  options.half_thickness = between(0.03, 0.2);
  options.tolerance = between(0.1, 1);
  options.offset = has_offset ? between(-0.9, 0.9) : 0;
  options.rotation_angle = between(-180, 180);
  for (int c = 0; c < 3; ++c) options.rotation_axis[c] = between(0.1, 1), options.translation[c] = between(-5, 5);
  if (kind < 6) {
    riis_valve *before = valve_of(kind, between(0.2, 0.5)), *now = valve_of(kind, between(0.5, 0.9));
    if (any_of(3) == 0) now = valve_of(kind, 0);
    riis_surface *surface = new_surface(before, &options);
    CHECK_OK(riis_surface_update_moving(surface, now, before, between(0.01, 1), NULL, NULL));
    if (any_of(3) != 0) return surface;
    riis_surface_options moved = options;
    moved.translation[0] += 1e-5;
    CHECK_OK(riis_surface_add_direction(surface, now, now, 1e-5, &moved, &options));
    return surface;
  }
  enum { n = 60 };
  double *xyz, *velocity = own(malloc(9 * n * sizeof *velocity));
  int32_t *ids;
  random_soup(&rng, n, 0.4, &xyz, &ids);
  for (int i = 0; i < 9 * n; ++i) velocity[i] = between(-1, 1);
  riis_surface_arrays arrays = triangle_arrays(3 * n, xyz, n, ids);
  arrays.vx = velocity, arrays.vy = velocity + 1, arrays.vz = velocity + 2;
  arrays.velocity_stride = 3;
  return surface_from(&arrays, &options);
}

static void check_case(int kind, int64_t most) {
  const riis_surface *surface = random_surface(kind, kind != 5 && any_of(4) == 0); /* kind 5 has opposite normals */
  const grid_case of = random_grid(surface, most, any_of(2) == 0);
  const riis_resistance resistance = resistance_of(3);
  riis_mark_options options = mark_options(), of_points;
  uint8_t *mask = own(malloc((size_t)of.n_numbers)), *points_mask = own(malloc((size_t)of.n));
  const int density = 1 + (int)any_of(20);
  for (int64_t i = 0; i < of.n_numbers; ++i) mask[i] = any_of(density) != 0;
  for (int64_t i = 0; i < of.n; ++i) points_mask[i] = mask[of.number[i]];
  static const double limits[] = {RIIS_AUTO, RIIS_AUTO, 0.5, 3, 1e60};
  options.distance_limit = limits[any_of(5)];
  options.n_threads = 1 + (int32_t)any_of(3);
  if (any_of(3)) options.resistance = &resistance;
  options.fields = RIIS_FIELD_POINT | RIIS_FIELD_VELOCITY | RIIS_FIELD_RIM | RIIS_FIELD_SIDE;
  if (any_of(2)) options.fields |= RIIS_FIELD_NORMAL | RIIS_FIELD_BARYCENTRIC | RIIS_FIELD_PATCH;
  if (any_of(2) && kind < 6) options.fields |= RIIS_FIELD_UV;
  riis_direction direction;
  if (riis_surface_get_direction(surface, 0, &direction, sizeof direction) == RIIS_OK)
    options.fields |= RIIS_FIELD_GRADIENT;
  if (any_of(3) == 0) options.instructions = RIIS_INSTRUCTIONS_BASELINE;
  of_points = options;
  if (any_of(3) == 0) options.node_mask = mask, of_points.node_mask = points_mask;
  if (any_of(4) == 0) options.search = RIIS_SEARCH_EXHAUSTIVE;
  of_points.search = any_of(2) ? RIIS_SEARCH_EXHAUSTIVE : RIIS_SEARCH_CLUSTERS;
  riis_marks *got = new_result(), *expected = new_result();
  for (int step = 0; step < 2; ++step) CHECK_OK(riis_mark_nodes(surface, of.mesh, &options, got));
  CHECK_OK(riis_mark_nodes(surface, of.points, &of_points, expected));
  assert_int_equal(stats_of(got).n_nodes, of.n_numbers);
  assert_int_equal(stats_of(got).n_within_limit, stats_of(expected).n_within_limit);
  n_within += stats_of(got).n_within_limit;
  check_lists(&of, got, expected);
  check_leaks(&of, surface, &options, &of_points, got, expected);
  check_regions(&of, &options, &of_points, got, expected);
  check_passage(&of, surface, &options, &of_points);
  check_cells(&of, got, expected);
  check_node_arrays(&of, got, expected);
}

TEST(grids_give_the_results_of_points) {
  n_leaks = n_passages = n_within = n_gradients = 0;
  for (int trial = 0; trial < trials(210, 3500); ++trial) {
    const int owned_before = n_owned();
    check_case(trial % n_kinds, trial % 10 == 0 ? 45 : 20);
    free_owned_after(owned_before);
  }
  CHECK_MET(n_leaks > 1000 && n_passages > 10 && n_within > 10000 && n_gradients > 20);
}

TEST(other_distances_and_far_grids) {
  for (int trial = 0; trial < trials(8, 80); ++trial) {
    const int owned_before = n_owned();
    riis_surface_options options = surface_options();
    options.measure = trial % 2 ? RIIS_MEASURE_SAMPLING : RIIS_MEASURE_MINIMIZATION;
    options.measure_tolerance = 0.5;
    const riis_surface *surface = surface_of_kind(kinds[trial % 5], &options);
    const grid_case of = random_grid(surface, 8, 1);
    riis_mark_options marking = mark_options();
    marking.fields = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_PATCH;
    if (trial % 3 == 0) marking.distance_limit = 1;
    riis_marks *got = new_result(), *expected = new_result();
    CHECK_OK(riis_mark_nodes(surface, of.mesh, &marking, got));
    CHECK_OK(riis_mark_nodes(surface, of.points, &marking, expected));
    check_lists(&of, got, expected);
    assert_int_equal(stats_of(got).search, RIIS_SEARCH_EXHAUSTIVE);
    free_owned_after(owned_before);
  }
  /* In a grid of this size, single precision does not separate a valve's triangles. */
  const riis_surface *surface = aortic_surface(NULL);
  grid_case of = {.grid = new_grid(6, 5, 4)};
  for (int c = 0; c < 3; ++c) of.axis[c] = random_axis(6, -1e9, 1e9);
  of.grid.x = of.axis[0], of.grid.y = of.axis[1], of.grid.z = of.axis[2];
  make_meshes(&of);
  riis_mark_options marking = mark_options();
  marking.distance_limit = 1e60;
  riis_marks *got = new_result(), *expected = new_result();
  CHECK_OK(riis_mark_nodes(surface, of.mesh, &marking, got));
  CHECK_OK(riis_mark_nodes(surface, of.points, &marking, expected));
  check_lists(&of, got, expected);
  assert_int_equal(stats_of(got).n_within_limit, of.n);
  assert_int_equal(stats_of(got).search, RIIS_SEARCH_EXHAUSTIVE);
}

/* --- Layouts --------------------------------------------------------------------------------------------------------- */

/* The numbers of nodes need 39 bits. The order of the nodes in the caller's arrays must not affect the search. */
TEST(numbers_beyond_32_bits) {
  for (int trial = 0; trial < trials(10, 100); ++trial) {
    const int owned_before = n_owned();
    const riis_surface *surface = random_surface(trial % n_kinds, 0);
    const grid_case of = random_grid(surface, 30, 0);
    riis_grid wide = of.grid;
    const int64_t n[3] = {wide.ni, wide.nj, wide.nk};
    wide.stride[0] = 1 + any_of(1000);
    for (int c = 1; c < 3; ++c) wide.stride[c] = n[c - 1] * wide.stride[c - 1] + any_of(INT64_C(1) << 15 << 7 * c);
    wide.first = any_of(INT64_C(1) << 38);
    riis_mesh *mesh = mesh_of_grid(&wide);
    riis_mark_options options = mark_options();
    options.fields = RIIS_FIELD_VELOCITY;
    if (any_of(2)) options.distance_limit = any_of(2) ? 0.5 : 1e60;
    riis_marks *got = new_result(), *expected = new_result();
    CHECK_OK(riis_mesh_prepare(mesh, 1));
    CHECK_OK(riis_mark_nodes(surface, mesh, &options, got));
    CHECK_OK(riis_mark_nodes(surface, of.points, &options, expected));
    const riis_mark_list a = within_list(got), b = within_list(expected);
    assert_int_equal(a.n_nodes, b.n_nodes);
    for (int64_t i = 0; i < a.n_nodes; ++i) {
      const int64_t j = b.node_id[i];
      const int64_t at[3] = {j % n[0], j / n[0] % n[1], j / n[0] / n[1]};
      assert_int_equal(a.node_id[i],
                       wide.first + at[0] * wide.stride[0] + at[1] * wide.stride[1] + at[2] * wide.stride[2]);
    }
    check_array("distance", a.distance, b.distance, a.n_nodes, sizeof *a.distance);
    check_array("velocity", a.velocity, b.velocity, 3 * a.n_nodes, sizeof *a.velocity);
    free_owned_after(owned_before);
  }
}

/* An axis may be given by its origin and spacing, or in single precision. */
TEST(axes_of_all_forms) {
  const riis_surface *surface = aortic_surface(NULL);
  enum { n = 20 };
  double x[n];
  float z[n];
  riis_grid by_spacing = new_grid(n, n, n), by_axes = by_spacing;
  for (int c = 0; c < 3; ++c) by_spacing.origin[c] = -1.3, by_spacing.spacing[c] = 0.14;
  for (int i = 0; i < n; ++i) {
    const double step = i * 0.14;
    x[i] = -1.3 + step;
    z[i] = (float)x[i];
  }
  by_axes.x = by_axes.y = by_axes.z = x;
  riis_marks *a = new_result(), *b = new_result();
  riis_mesh *mesh = mesh_of_grid(&by_spacing), *other = mesh_of_grid(&by_axes);
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, a));
  CHECK_OK(riis_mark_nodes(surface, other, NULL, b));
  assert_true(stats_of(a).n_marked > 0 && same_results(a, b));
  by_axes.real_bits = 32;
  by_axes.x = by_axes.y = by_axes.z = z;
  CHECK_OK(riis_mesh_update_grid(other, &by_axes));
  for (int i = 0; i < n; ++i) x[i] = (double)z[i];
  by_spacing.x = by_spacing.y = by_spacing.z = x;
  CHECK_OK(riis_mesh_update_grid(mesh, &by_spacing));
  x[3] = 7; /* the axes were copied */
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, a));
  CHECK_OK(riis_mark_nodes(surface, other, NULL, b));
  assert_true(stats_of(a).n_marked > 0 && same_results(a, b));
}

/* Updates turn a grid into another grid, a grid into points, and points into a grid. A refused update changes nothing. */
TEST(updates_of_axes) {
  const riis_surface *surface = aortic_surface(NULL);
  for (int trial = 0; trial < trials(6, 60); ++trial) {
    const int owned_before = n_owned();
    const grid_case of[2] = {random_grid(surface, 15, any_of(2) == 0), random_grid(surface, 15, any_of(2) == 0)};
    riis_mesh *mesh = any_of(2) ? mesh_of_grid(&of[1].grid) : mesh_of(0, NULL);
    riis_marks *got = new_result(), *expected = new_result();
    for (int k = 0; k < 2; ++k) {
      CHECK_OK(riis_mesh_update_grid(mesh, &of[k].grid));
      riis_grid bad = of[k].grid;
      bad.ni = 0;
      CHECK_REFUSED(RIIS_INVALID_MESH, "grid.ni is 0;", riis_mesh_update_grid(mesh, &bad));
      CHECK_OK(riis_mark_nodes(surface, mesh, NULL, got));
      CHECK_OK(riis_mark_nodes(surface, of[k].points, NULL, expected));
      check_lists(&of[k], got, expected);
      check_cells(&of[k], got, expected);
    }
    const double point[3] = {0, 0, 0};
    CHECK_OK(riis_mesh_update(mesh, 1, point, point + 1, point + 2, 3));
    CHECK_OK(riis_mark_nodes(surface, mesh, NULL, got));
    assert_int_equal(stats_of(got).n_nodes, 1);
    free_owned_after(owned_before);
  }
}

/* The valve lies in a grid with a halo. The opening of the first passage is the same for the grid and for points, and the halo is
 * not an end. */
TEST(first_passage_with_a_halo) {
  const riis_valve *valve = new_valve("aortic");
  const riis_surface *surface = aortic_surface(NULL);
  const riis_surface_info info = info_of(surface);
  grid_case of = {.grid = new_grid(14, 13, 12)};
  const int64_t n[3] = {14, 13, 12}, width[3] = {16, 15, 14};
  for (int c = 0; c < 3; ++c) {
    const double out = c == 2 ? 1 : -0.05; /* the walls are inside the annulus */
    of.axis[c] = own(malloc((size_t)n[c] * sizeof(double)));
    for (int64_t i = 0; i < n[c]; ++i)
      of.axis[c][i] = info.lower[c] - out + (info.upper[c] - info.lower[c] + 2 * out) * (double)i / (double)(n[c] - 1);
  }
  of.grid.x = of.axis[0], of.grid.y = of.axis[1], of.grid.z = of.axis[2];
  of.grid.stride[0] = 1, of.grid.stride[1] = width[0], of.grid.stride[2] = width[0] * width[1];
  of.grid.first = 1 + width[0] + width[0] * width[1];
  of.grid.n_nodes = width[0] * width[1] * width[2];
  make_meshes(&of);
  riis_passage_ends ends;
  riis_first_passage a, b;
  CHECK_OK(riis_passage_ends_init(&ends, sizeof ends));
  int64_t from = of.number[7 + 14 * 6], to = of.number[7 + 14 * (6 + 13 * 11)], points_from = 7 + 14 * 6,
          points_to = 7 + 14 * (6 + 13 * 11), halo = 0;
  ends.n_from = ends.n_to = 1;
  ends.from = &from, ends.to = &to;
  CHECK_OK(riis_find_first_passage(valve, of.mesh, &ends, NULL, &a, sizeof a));
  ends.from = &points_from, ends.to = &points_to;
  CHECK_OK(riis_find_first_passage(valve, of.points, &ends, NULL, &b, sizeof b));
  assert_int_equal(a.state, b.state);
  assert_int_equal(a.node_id, of.number[b.node_id]);
  assert_int_equal(a.n_openings, b.n_openings);
  CHECK_SAME(a.opening, b.opening);
  CHECK_SAME(a.distance, b.distance);
  riis_passage passage;
  ends.from = &from, ends.to = &halo;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "ends.to[0] is 0, which is no node of the grid",
                riis_find_passage(surface, of.mesh, &ends, NULL, &passage, sizeof passage));
  ends.from = &halo, ends.to = &to;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "ends.from[0] is 0, which is no node of the grid",
                riis_find_first_passage(valve, of.mesh, &ends, NULL, &a, sizeof a));
}

/* The caller may replace a grid's edges, and the grid can get its original edges back. Edges to numbers without a node are
 * refused. */
TEST(other_edges_of_a_grid) {
  for (int trial = 0; trial < trials(6, 60); ++trial) {
    const int owned_before = n_owned();
    const riis_surface *surface = random_surface(trial % n_kinds, 0);
    const grid_case of = random_grid(surface, 12, 1);
    riis_mark_options options = mark_options();
    riis_marks *got = new_result(), *expected = new_result();
    CHECK_OK(riis_mark_nodes(surface, of.mesh, &options, got));
    CHECK_OK(riis_mark_nodes(surface, of.points, &options, expected));
    /* The rows join each node and the next one. */
    int64_t *offsets = own(calloc((size_t)of.n_numbers + 1, sizeof *offsets)), n_columns = 0;
    int64_t *columns = own(malloc((size_t)of.n * sizeof *columns));
    int64_t *pairs = own(malloc((size_t)of.n * 2 * sizeof *pairs));
    for (int64_t i = 0; i < of.n_numbers; ++i) {
      const int64_t node = of.node[i];
      if (node >= 0 && node + 1 < of.n) {
        pairs[2 * n_columns] = node, pairs[2 * n_columns + 1] = node + 1;
        columns[n_columns++] = of.number[node + 1];
      }
      offsets[i + 1] = n_columns;
    }
    riis_csr csr;
    CHECK_OK(riis_csr_init(&csr, sizeof csr));
    csr.n_rows = of.n_numbers;
    csr.offsets = offsets, csr.columns = columns;
    csr.offset_bits = csr.column_bits = 64;
    CHECK_OK(riis_mesh_set_adjacency(of.mesh, &csr));
    test_mesh rows = {.n = of.n};
    set_rows(&rows, n_columns, pairs);
    riis_csr of_points = csr;
    of_points.n_rows = of.n;
    of_points.offsets = rows.offsets, of_points.columns = rows.columns;
    CHECK_OK(riis_mesh_set_adjacency(of.points, &of_points));
    check_lists(&of, got, expected);
    check_leaks(&of, surface, &options, &options, got, expected);
    check_regions(&of, &options, &options, got, expected);
    check_passage(&of, surface, &options, &options);
    if (of.n < of.n_numbers && n_columns > 0) {
      int64_t halo = 0;
      while (of.node[halo] >= 0) ++halo;
      columns[0] = halo;
      CHECK_REFUSED(RIIS_INVALID_MESH, "is no node of the grid", riis_mesh_set_adjacency(of.mesh, &csr));
    }
    free_owned_after(owned_before);
  }
}

/* A grid of 10^9 nodes takes no memory before its first marking. Few nodes of the grid are near the surface. */
TEST(a_billion_nodes) {
  const riis_surface *surface = aortic_surface(NULL);
  riis_grid grid = new_grid(1000, 1000, 1000);
  for (int c = 0; c < 3; ++c) grid.origin[c] = -100, grid.spacing[c] = 0.2;
  riis_mesh *mesh = mesh_of_grid(&grid);
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  assert_int_equal(stats_of(result).n_nodes, 1000000000);
  assert_true(stats_of(result).n_marked > 10);
  riis_surface_options options = surface_options();
  options.measure = RIIS_MEASURE_SAMPLING;
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "sampling|at most 100000000 nodes; this grid has 1000000000",
                riis_mark_nodes(surface_of_kind("aortic", &options), mesh, NULL, result));
}

/* Marks the nodes of a grid of 10^9 nodes around the valve, which fills the grid. The half thickness is 1.5 steps of the axes. */
static void mark_a_billion(void) {
  riis_grid grid = new_grid(1000, 1000, 1000);
  riis_surface_info info = info_of(aortic_surface(NULL));
  double step = 0;
  for (int c = 0; c < 3; ++c) step = fmax(step, (info.upper[c] - info.lower[c]) / 999);
  for (int c = 0; c < 3; ++c) {
    grid.origin[c] = (info.lower[c] + info.upper[c] - 999 * step) / 2;
    grid.spacing[c] = step;
  }
  riis_surface_options options = surface_options();
  options.half_thickness = 1.5 * step;
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(aortic_surface(&options), mesh_of_grid(&grid), NULL, result));
  assert_int_equal(stats_of(result).n_nodes, 1000000000);
  assert_true(stats_of(result).n_marked > 500000);
}

static long peak_kilobytes(void) {
  struct rusage used;
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss;
}

/* Labels regions, finds a passage or counts cells across, in a grid with a halo of 24 million numbers. The caller's arrays are
 * written first, so their memory does not count. Fails if the call takes more memory than the given number of kilobytes. */
static void work_in_little_memory(const char *work) {
  enum { n = 286, numbers = (n + 2) * (n + 2) * (n + 2) };
  riis_grid grid = new_grid(n, n, n);
  grid.stride[0] = 1, grid.stride[1] = n + 2, grid.stride[2] = (n + 2) * (n + 2);
  grid.first = 1 + (n + 2) + (n + 2) * (n + 2);
  grid.n_nodes = numbers;
  const riis_surface *surface = aortic_surface(NULL);
  const riis_surface_info info = info_of(surface);
  const int are_cells = strcmp(work, "cells") == 0;
  /* The valve closes a long channel, so a passage has only few nodes near the valve. */
  for (int c = 0; c < 3; ++c) {
    const double out = are_cells ? 1 : c == 2 ? 300 : -0.05;
    grid.origin[c] = info.lower[c] - out;
    grid.spacing[c] = (info.upper[c] - info.lower[c] + 2 * out) / (n - 1);
  }
  riis_mesh *mesh = mesh_of_grid(&grid);
  riis_marks *marks = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, marks));
  int64_t *label = own(malloc(numbers * sizeof *label)), n_regions = 0;
  memset(label, 1, numbers * sizeof *label);
  const long before = peak_kilobytes(), few = 32 * 1024;
  long most = few;
  if (strcmp(work, "regions") == 0) {
    CHECK_OK(riis_label_open_regions(mesh, marks, NULL, numbers, label, &n_regions));
    assert_true(n_regions > 0 && label[0] == -1);
  } else if (strcmp(work, "passage") == 0) {
    most += 8 * (numbers / 1024);
    int64_t from = grid.first, to = grid.first + (n - 1) * (grid.stride[0] + grid.stride[1] + grid.stride[2]);
    riis_passage_ends ends;
    riis_passage passage;
    CHECK_OK(riis_passage_ends_init(&ends, sizeof ends));
    ends.n_from = ends.n_to = 1, ends.from = &from, ends.to = &to;
    CHECK_OK(riis_find_passage(surface, mesh, &ends, NULL, &passage, sizeof passage));
    assert_int_equal(passage.state, RIIS_PASSAGE_OPEN);
  } else {
    riis_cells_across across;
    CHECK_OK(riis_marks_get_cells_across(marks, mesh, &across, sizeof across));
    assert_true(across.n_edges > 1000);
  }
  const long taken = peak_kilobytes() - before;
  printf("%s: %ld MB\n", work, taken / 1024);
  assert_true(taken <= most);
}

/* Each task runs in a separate process, because other cases take memory. */
static void expect_fine_apart(const char *work, long most_kilobytes) {
  fflush(NULL);
  const pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    execl("/proc/self/exe", "test_grid", work, (char *)NULL);
    _exit(1);
  }
  int ended = 0;
  struct rusage used;
  assert_true(wait4(child, &ended, 0, &used) == child);
  if (ended != 0) fail_msg("%s: the process ends with %#x", work, (unsigned)ended);
  if (used.ru_maxrss > most_kilobytes) fail_msg("%s: %ld kB", work, used.ru_maxrss);
}

TEST(memory_apart_from_arrays) {
  if (is_short_test()) skip(); /* the memory of a sanitizer or an emulator also counts */
  expect_fine_apart("a billion", 200 * 1024);
  expect_fine_apart("regions", LONG_MAX);
  expect_fine_apart("passage", LONG_MAX);
  expect_fine_apart("cells", LONG_MAX);
}

/* --- Refusals -------------------------------------------------------------------------------------------------------- */

TEST(grids_are_refused_by_name) {
  double x[4] = {0, 1, 2, 3};
  const riis_surface *surface = aortic_surface(NULL);
  riis_mesh *mesh = NULL;
  riis_grid bad;
#define REFUSED(status, parts, ...)                                   \
  do {                                                                \
    bad = new_grid(4, 4, 4);                                          \
    bad.x = bad.y = bad.z = x;                                        \
    __VA_ARGS__;                                                      \
    CHECK_REFUSED(status, parts, riis_mesh_create_grid(&bad, &mesh)); \
    assert_null(mesh);                                                \
    x[0] = 0, x[1] = 1, x[2] = 2, x[3] = 3;                           \
  } while (0)
  REFUSED(RIIS_INVALID_MESH, "grid.ni is 0; it must be at least 1", bad.ni = 0);
  REFUSED(RIIS_INVALID_MESH, "grid.nj is -1;", bad.nj = -1);
  REFUSED(RIIS_INVALID_MESH, "grid.nk is 0;", bad.nk = 0);
  REFUSED(RIIS_INVALID_MESH, "grid.x[2] is nan;", x[2] = NAN);
  REFUSED(RIIS_INVALID_MESH, "grid.x[3] is inf;", x[3] = INFINITY);
  REFUSED(RIIS_INVALID_MESH, "grid.x[0] is -2e+60;", x[0] = -2e60);
  REFUSED(RIIS_INVALID_MESH, "grid.x[2] is 1, after 1; the axis must strictly ascend", x[2] = 1);
  REFUSED(RIIS_INVALID_MESH, "grid.y[1] is 0, after 0;", bad.y = NULL, bad.spacing[1] = 0);
  REFUSED(RIIS_INVALID_MESH, "grid.z[1] is 1e+20, after 1e+20;", bad.z = NULL, bad.origin[2] = 1e20);
  REFUSED(RIIS_INVALID_ARGUMENT, "grid.real_bits is 16", bad.real_bits = 16);
  REFUSED(RIIS_INVALID_ARGUMENT, "grid.reserved is 1", bad.reserved = 1);
  REFUSED(RIIS_INVALID_ARGUMENT, "grid.first is -1;", bad.first = -1);
  REFUSED(RIIS_LIMIT_EXCEEDED, "grid.first is 1099511627776;", bad.first = INT64_C(1) << 40);
  REFUSED(RIIS_INVALID_ARGUMENT, "grid.stride[1] is 0; it must be at least 1", bad.stride[0] = 1);
  REFUSED(RIIS_INVALID_ARGUMENT, "grid.stride[1] is 3; it must be above 3,", bad.stride[0] = 1, bad.stride[1] = 3,
          bad.stride[2] = 50);
  REFUSED(RIIS_LIMIT_EXCEEDED, "grid.stride[2] is 9223372036854775807, so 4 nodes", bad.stride[0] = 1,
          bad.stride[1] = 4, bad.stride[2] = INT64_MAX);
  REFUSED(RIIS_LIMIT_EXCEEDED, "grid.stride[0] is 1, so 9223372036854775807 nodes", bad.ni = INT64_MAX);
  REFUSED(RIIS_LIMIT_EXCEEDED, "grid.stride[1] is 1048576, so 1048577 nodes", bad.ni = 1 << 20, bad.nj = (1 << 20) + 1);
  REFUSED(RIIS_INVALID_ARGUMENT, "grid.n_nodes is 63; the last node has the number 63", bad.n_nodes = 63);
  REFUSED(RIIS_LIMIT_EXCEEDED, "grid.n_nodes is 1099511627777;", bad.n_nodes = (INT64_C(1) << 40) + 1);
  REFUSED(RIIS_INVALID_STRUCT_SIZE, "grid", bad.struct_size = 8);
#undef REFUSED
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "grid is NULL", riis_mesh_create_grid(NULL, &mesh));
  bad = new_grid(4, 4, 4);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh is NULL", riis_mesh_create_grid(&bad, NULL));
  mesh = mesh_of_grid(&bad);
  riis_mark_options options = mark_options();
  riis_marks *result = new_result();
  options.search = RIIS_SEARCH_NEIGHBOR;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.search is RIIS_SEARCH_NEIGHBOR,|grid",
                riis_mark_nodes(surface, mesh, &options, result));
  options.search = RIIS_SEARCH_PAPER;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.search is RIIS_SEARCH_PAPER,|grid",
                riis_mark_nodes(surface, mesh, &options, result));
}

int main(int argc, char **argv) {
  if (argc == 2) {
    if (strcmp(argv[1], "a billion") == 0)
      mark_a_billion();
    else
      work_in_little_memory(argv[1]);
    fflush(NULL);
    _exit(0); /* otherwise the program would run the cases */
  }
  rng = random_start("test_grid");
  return run_cases(NULL, NULL);
}
