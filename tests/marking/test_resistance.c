/* SPDX-License-Identifier: Apache-2.0
 * Tests resistance, reaction and band sums. Integrals over a grid are compared with the areas of discs, cylinders and spheres.
 * Sums are compared with plain loops. Refusals leave the arrays as they were. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "sanitized.h"
#include "searches.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }
static const double pi = 3.14159265358979323846;

static riis_resistance resistance_of(double r) {
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = r;
  return resistance;
}

/* Returns K by the formula in the header. */
static double coefficient_at(double r, double eps, double distance) {
  return distance < eps ? r / eps * (1 + cos(pi * distance / eps)) / (2 * eps) : 0;
}

/* --- Integrals ------------------------------------------------------------------------------------------------------- */

/* Makes a surface x(s, t), 0 <= s, t <= 1, of n * m quads, each of two triangles. */
typedef void (*shape)(double s, double t, double *p);
static const double disc_radius = 1, cylinder_radius = 1.3, sphere_radius = 0.8;
static double frame[3][3], origin[3]; /* the rotation and translation of all surfaces */

static void into_frame(double a, double b, double c, double *p) {
  for (int i = 0; i < 3; ++i) p[i] = origin[i] + a * frame[0][i] + b * frame[1][i] + c * frame[2][i];
}
static void disc(double s, double t, double *p) {
  into_frame(disc_radius * t * cos(2 * pi * s), disc_radius * t * sin(2 * pi * s), 0, p);
}
/* A cylinder. The cylinder's angle is slightly wider than half a radian. */
static void cylinder(double s, double t, double *p) {
  const double angle = 0.9 * (s - 0.5);
  into_frame(cylinder_radius * cos(angle), cylinder_radius * sin(angle), 0.7 * t, p);
}
/* A spherical cap with a polar angle up to 0.8. */
static void cap(double s, double t, double *p) {
  const double polar = 0.8 * t, angle = 2 * pi * s;
  into_frame(sphere_radius * sin(polar) * cos(angle), sphere_radius * sin(polar) * sin(angle),
             sphere_radius * cos(polar), p);
}

/* Makes a frame whose axes are far from the grid's directions. If an edge of the band ran along a direction of the grid, it would
 * pass a whole row of nodes at once. */
static void random_frame(void) {
  const double a = between(0.3, 0.6), b = between(0.3, 0.6);
  const double ca = cos(a), sa = sin(a), cb = cos(b), sb = sin(b);
  const double turned[3][3] = {{ca * cb, sa * cb, sb}, {-sa, ca, 0}, {-ca * sb, -sa * sb, cb}};
  memcpy(frame, turned, sizeof frame);
  for (int i = 0; i < 3; ++i) origin[i] = between(-1, 1);
}

static riis_surface *surface_of(shape at, int n, int m, double half_thickness) {
  double *xyz = own(malloc((size_t)((n + 1) * (m + 1)) * 3 * sizeof *xyz));
  int32_t *ids = own(malloc((size_t)(n * m) * 4 * sizeof *ids));
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) at((double)i / n, (double)j / m, xyz + 3 * (j * (n + 1) + i));
  /* In a closed shape, the two ends coincide bit for bit. */
  for (int j = 0; j <= m; ++j)
    if (at != cylinder) memcpy(xyz + 3 * (j * (n + 1) + n), xyz + 3 * j * (n + 1), 3 * sizeof *xyz);
  for (int i = 1; i <= n; ++i)
    if (at != cylinder) memcpy(xyz + 3 * i, xyz, 3 * sizeof *xyz);
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int32_t first = j * (n + 1) + i, corner[4] = {first, first + 1, first + n + 2, first + n + 1};
      memcpy(ids + 4 * (j * n + i), corner, sizeof corner);
    }
  riis_surface_arrays arrays = triangle_arrays((n + 1) * (m + 1), xyz, n * m, ids);
  arrays.corners_per_face = 4;
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness;
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  riis_surface *surface = surface_from(&arrays, &options);
  free_one_owned(xyz), free_one_owned(ids);
  return surface;
}

/* Returns the sum of K over a grid, times the volume of its cells. */
static double integral_of(const riis_surface *surface, const riis_resistance *resistance, double spacing) {
  const int owned_before = n_owned();
  test_mesh nodes = lattice_around(surface, spacing, info_of(surface).half_thickness + spacing);
  double volume = 1, sum = 0;
  for (int c = 0; c < 3; ++c) { /* the step from one node to the next node */
    int64_t i = 1;
    while (nodes.xyz[3 * i + c] == nodes.xyz[c]) ++i;
    volume *= nodes.xyz[3 * i + c] - nodes.xyz[c];
  }
  const riis_mesh *mesh = mesh_of(nodes.n, nodes.xyz);
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  options.fields = RIIS_FIELD_RIM;
  options.search = RIIS_SEARCH_CLUSTERS;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  double *k = own(calloc((size_t)nodes.n, sizeof *k));
  CHECK_OK(add_resistance_to(result, resistance, nodes.n, k, NULL));
  for (int64_t i = 0; i < nodes.n; ++i) sum += k[i];
  free_owned_after(owned_before);
  return sum * volume;
}

/* Without the rim, the integral of K is the area times R / eps. The formula is exact for a plane. The formula is also exact for a
 * cylinder, because the excess outside balances the deficit inside. For a sphere, the integral has an additional factor 1 + c
 * eps^2 / r^2. The constant c = 1/3 - 2/pi^2 is the integral of x^2 (1 + cos pi x) from 0 to 1. */
TEST(the_integral_is_the_area) {
  const double c = 1.0 / 3 - 2 / (pi * pi);
  CHECK_NEAR(c, 0.1307, 1e-4);
  const struct {
    const char *name;
    shape at;
    int n, m;
    double radius_sq; /* square of the sphere's radius, or infinite */
  } shapes[] = {{"disc", disc, 300, 30, INFINITY},
                {"part of a cylinder", cylinder, 60, 1, INFINITY},
                {"part of a sphere", cap, 160, 60, sphere_radius * sphere_radius}};
  for (int i = 0; i < 3; ++i)
    for (int fine = 0; fine < (is_short_test() ? 1 : 2); ++fine) {
      const double eps = i == 2 ? 0.3 : 0.15, r = pow(10, between(-3, 3));
      random_frame();
      riis_surface *surface = surface_of(shapes[i].at, shapes[i].n, shapes[i].m, eps);
      riis_resistance resistance = resistance_of(r);
      resistance.rim = RIIS_RIM_CUT;
      const double expected = r / eps * info_of(surface).area * (1 + c * eps * eps / shapes[i].radius_sq);
      const double off = integral_of(surface, &resistance, eps / (fine ? 10 : 5)) / expected - 1;
      resistance.rim = RIIS_RIM_ROUND;
      const double round = integral_of(surface, &resistance, eps / (fine ? 10 : 5)) / expected - 1;
      printf("%s, %d nodes in eps: off by %.2g of the area with the rim cut, %.2g more with a round rim\n",
             shapes[i].name, fine ? 10 : 5, off, round - off);
      CHECK_AT_MOST(fabs(off), fine ? 2e-3 : 5e-3);
      assert_true(round > off + 0.02);
    }
}

/* --- Any surface, any nodes ------------------------------------------------------------------------------------------ */

/* A moving aortic valve and nodes around it. */
typedef struct flow {
  riis_surface *surface;
  test_mesh nodes;
  riis_mesh *mesh;
  riis_marks *result;
  double *velocity, *value, *weight;
} flow;

enum { all_fields = RIIS_FIELD_RIM | RIIS_FIELD_SIDE | RIIS_FIELD_VELOCITY };

static flow random_flow(int32_t fields, double limit) {
  flow f = {0};
  riis_valve *valve = new_valve("aortic"), *before = new_valve("aortic");
  CHECK_OK(riis_valve_set_scalar(before, "leaflet_angle", between(55, 62)));
  f.surface = new_surface(valve, NULL);
  CHECK_OK(riis_surface_update_moving(f.surface, valve, before, between(0.01, 1), NULL, NULL));
  f.nodes = lattice_around(f.surface, between(0.05, 0.09), 0.2);
  f.mesh = mesh_from(&f.nodes);
  f.result = new_result();
  riis_mark_options options = mark_options();
  options.fields = fields;
  if (limit > 0) options.distance_limit = limit;
  CHECK_OK(riis_mark_nodes(f.surface, f.mesh, &options, f.result));
  const size_t n = (size_t)f.nodes.n;
  f.velocity = own(malloc(3 * n * sizeof(double)));
  f.value = own(malloc(n * sizeof(double)));
  f.weight = own(malloc(n * sizeof(double)));
  for (size_t i = 0; i < 3 * n; ++i) f.velocity[i] = between(-1, 1);
  for (size_t i = 0; i < n; ++i) f.value[i] = between(-100, 100), f.weight[i] = between(0, 1);
  return f;
}

static riis_mark_list fields_of(const flow *f) {
  riis_mark_list fields;
  CHECK_OK(riis_marks_get_list(f->result, RIIS_LIST_WITHIN_LIMIT, &fields, sizeof fields));
  return fields;
}

/* Compares three results with a plain loop over all nodes: K, K times the surface's velocity, and the force. The marking keeps
 * any fields. */
TEST(sums_are_those_of_plain_loops) {
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned();
    const double limit = trial % 3 ? between(0.1, 0.25) : 0;
    flow f = random_flow(trial % 4 == 3 ? RIIS_FIELD_RIM : all_fields, limit);
    const int moves = trial % 4 != 3;
    riis_resistance resistance = resistance_of(trial == 5 ? 0 : pow(10, between(-5, 5)));
    if (trial % 2) resistance.rim = RIIS_RIM_CUT;
    if (trial % 3 == 2) resistance.half_thickness = between(0.02, limit);
    const double eps = resistance.half_thickness == RIIS_AUTO ? 0.1 : resistance.half_thickness;
    const int64_t n = f.nodes.n;
    double *k = own(malloc((size_t)n * 4 * sizeof *k)), *momentum = k + n;
    double *expected = own(malloc((size_t)n * 4 * sizeof *k));
    /* Initial values, to which the calls add. */
    for (int64_t i = 0; i < 4 * n; ++i) k[i] = expected[i] = between(-1, 1);
    double force[3], expected_force[3], scale = 0;
    for (int c = 0; c < 3; ++c) force[c] = expected_force[c] = between(-1, 1);
    const found_nodes within = within_in(f.result);
    const riis_mark_list fields = fields_of(&f);
    int64_t n_resisting = 0;
    for (int64_t j = 0; j < within.n; ++j) {
      const int64_t i = within.node_id[j];
      if (resistance.rim == RIIS_RIM_CUT && fields.rim[j]) continue;
      const double at = coefficient_at(resistance.R, eps, within.distance[j]);
      n_resisting += at > 0;
      expected[i] += at;
      for (int c = 0; c < 3; ++c) {
        const double u = moves ? fields.velocity[3 * j + c] : 0;
        expected[n + 3 * i + c] += at * u;
        expected_force[c] += f.weight[i] * at * (f.velocity[3 * i + c] - u);
        scale += f.weight[i] * at * (1 + fabs(u));
      }
    }
    assert_true(n_resisting > 50 || trial == 5);
    CHECK_OK(add_resistance_to(f.result, &resistance, n, k, moves ? momentum : NULL));
    if (!moves) memcpy(momentum, expected + n, (size_t)n * 3 * sizeof *k);
    const double largest = resistance.R / (eps * eps);
    for (int64_t i = 0; i < n; ++i) CHECK_NEAR(k[i], expected[i], 1e-14 * (1 + largest));
    for (int64_t i = 0; i < 3 * n; ++i)
      CHECK_NEAR(momentum[i], expected[n + i], 1e-14 * (1 + fabs(expected[n + i]) + largest));
    CHECK_OK(add_reaction_to(f.result, &resistance, n, f.velocity, f.weight, force));
    for (int c = 0; c < 3; ++c) CHECK_NEAR(force[c], expected_force[c], 1e-12 * (1 + scale));

    /* A call may add K alone, K u alone, or nothing. */
    double *alone = own(calloc((size_t)n * 3, sizeof *alone)), *both = own(calloc((size_t)n * 4, sizeof *both));
    CHECK_OK(add_resistance_to(f.result, &resistance, n, NULL, NULL));
    CHECK_OK(add_resistance_to(f.result, &resistance, n, both, moves ? both + n : NULL));
    CHECK_OK(add_resistance_to(f.result, &resistance, n, alone, NULL));
    assert_memory_equal(alone, both, (size_t)n * sizeof *alone);
    memset(alone, 0, (size_t)n * 3 * sizeof *alone);
    if (moves) CHECK_OK(add_resistance_to(f.result, &resistance, n, NULL, alone));
    assert_memory_equal(alone, both + n, (size_t)n * 3 * sizeof *alone);

    /* K u is K times the surface's velocity. */
    for (int64_t j = 0; j < within.n && moves; ++j)
      for (int c = 0; c < 3; ++c)
        CHECK_SAME(both[n + 3 * within.node_id[j] + c] + 0.0,
                   both[within.node_id[j]] * fields.velocity[3 * j + c] + 0.0);
    free_owned_after(owned_before);
  }
}

/* The result's lists and the arrays have the same K and K u, bit for bit. Arrays by component and arrays with gaps get the same
 * bits. The marking does not need the field of velocities for K u. */
TEST(lists_and_layouts_have_the_same_bits) {
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned();
    const double limit = trial % 3 ? between(0.11, 0.25) : 0.1;
    const int moves = trial % 4 != 3;
    flow f = random_flow(all_fields, limit);
    if (!moves) {
      CHECK_OK(riis_surface_update(f.surface, new_valve(trial % 2 ? "mitral" : "trileaflet"), NULL));
      f.nodes = lattice_around(f.surface, between(0.05, 0.09), 0.2);
      f.mesh = mesh_from(&f.nodes);
    }
    riis_resistance resistance = resistance_of(pow(10, between(-5, 5)));
    if (trial % 2) resistance.rim = RIIS_RIM_CUT;
    if (trial % 3 == 2) resistance.half_thickness = between(0.02, limit);
    riis_mark_options options = mark_options();
    options.distance_limit = limit;
    options.resistance = &resistance;
    options.n_threads = 1 + trial % 2;
    riis_marks *listed = new_result();
    CHECK_OK(riis_mark_nodes(f.surface, f.mesh, &options, listed));
    options.resistance = NULL;
    options.fields = RIIS_FIELD_RIM | (moves ? RIIS_FIELD_VELOCITY : 0);
    CHECK_OK(riis_mark_nodes(f.surface, f.mesh, &options, f.result));
    const int64_t n = f.nodes.n;
    double *k = own(calloc((size_t)n * 4, sizeof *k)), *momentum = k + n;
    CHECK_OK(add_resistance_to(f.result, &resistance, n, k, moves ? momentum : NULL));
    for (int which = RIIS_LIST_MARKED; which <= RIIS_LIST_WITHIN_LIMIT; ++which) {
      const riis_mark_list list = list_of(listed, which), plain = list_of(f.result, which);
      assert_true(list.n_nodes == plain.n_nodes && list.n_nodes > 100 && list.K && !plain.K && !plain.K_u_surface);
      assert_true((list.K_u_surface != NULL) == moves && !list.velocity && !list.rim);
      for (int64_t j = 0; j < list.n_nodes; ++j) {
        CHECK_SAME(list.K[j], k[list.node_id[j]]);
        for (int c = 0; c < 3 && moves; ++c)
          CHECK_SAME(list.K_u_surface[3 * j + c] + 0.0, momentum[3 * list.node_id[j] + c] + 0.0);
      }
    }
    /* K fills every fifth number of its array. Each component of K u has a separate block, with a stride of two. */
    double *gaps = own(calloc((size_t)n * 11, sizeof *gaps));
    riis_resistance_arrays arrays;
    CHECK_OK(riis_resistance_arrays_init(&arrays, sizeof arrays));
    arrays.n_nodes = n;
    arrays.K = gaps;
    arrays.K_stride = 5;
    for (int c = 0; c < 3 && moves; ++c) arrays.K_u_surface[c] = gaps + (5 + 2 * c) * n;
    arrays.K_u_surface_stride = 2;
    CHECK_OK(riis_marks_add_resistance(f.result, &resistance, &arrays));
    for (int64_t i = 0; i < n; ++i) {
      CHECK_SAME(gaps[5 * i], k[i]);
      for (int gap = 1; gap < 5; ++gap) assert_true(gaps[5 * i + gap] == 0);
      for (int c = 0; c < 3 && moves; ++c) {
        CHECK_SAME(gaps[(5 + 2 * c) * n + 2 * i], momentum[3 * i + c]);
        assert_true(gaps[(5 + 2 * c) * n + 2 * i + 1] == 0);
      }
    }
    free_owned_after(owned_before);
  }
}

/* The force on the surface is the momentum that the flow loses. The sums of ranks that share the nodes add up. */
TEST(ranks_add_up) {
  for (int trial = 0; trial < trials_of(24); ++trial) {
    const int owned_before = n_owned();
    flow f = random_flow(all_fields, 0.2);
    const int64_t n = f.nodes.n;
    riis_resistance resistance = resistance_of(3);
    double whole[3] = {0, 0, 0}, parts[3] = {0, 0, 0}, halves[3] = {0, 0, 0}, scale = 0;
    riis_band_sums all, of_rank[2];
    CHECK_OK(add_reaction_to(f.result, &resistance, n, f.velocity, f.weight, whole));
    CHECK_OK(band_sums_of(f.result, 0, 0.2, n, f.value, f.weight, &all, sizeof all));
    /* Nodes of the other rank have a weight of 0. */
    double *weight = own(malloc((size_t)n * sizeof *weight));
    uint8_t *rank = own(malloc((size_t)n));
    for (int64_t i = 0; i < n; ++i) rank[i] = random_bits(&rng) & 1, scale += 300 * f.weight[i];
    for (int r = 0; r < 2; ++r) {
      for (int64_t i = 0; i < n; ++i) weight[i] = rank[i] == r ? f.weight[i] : 0;
      CHECK_OK(add_reaction_to(f.result, &resistance, n, f.velocity, weight, parts));
      CHECK_OK(band_sums_of(f.result, 0, 0.2, n, f.value, weight, of_rank + r, sizeof all));
    }
    for (int c = 0; c < 3; ++c) CHECK_NEAR(parts[c], whole[c], 1e-13 * scale);
    for (int side = 0; side < 2; ++side) {
      CHECK_NEAR(of_rank[0].sum[side] + of_rank[1].sum[side], all.sum[side], 1e-13 * scale);
      CHECK_NEAR(of_rank[0].weight[side] + of_rank[1].weight[side], all.weight[side], 1e-13 * scale);
    }
    /* Each rank has a mesh of its own nodes. */
    for (int r = 0; r < 2; ++r) {
      double *of_mesh = own(malloc((size_t)n * 7 * sizeof *of_mesh)), *velocity = of_mesh + 3 * n,
             *own = of_mesh + 6 * n;
      int64_t m = 0;
      for (int64_t i = 0; i < n; ++i) {
        if (rank[i] != r) continue;
        memcpy(of_mesh + 3 * m, f.nodes.xyz + 3 * i, 24);
        memcpy(velocity + 3 * m, f.velocity + 3 * i, 24);
        own[m++] = f.weight[i];
      }
      riis_marks *result = new_result();
      riis_mark_options options = mark_options();
      options.fields = RIIS_FIELD_VELOCITY;
      CHECK_OK(riis_mark_nodes(f.surface, mesh_of(m, of_mesh), &options, result));
      CHECK_OK(add_reaction_to(result, &resistance, m, velocity, own, halves));
    }
    for (int c = 0; c < 3; ++c) CHECK_NEAR(halves[c], whole[c], 1e-13 * scale);
    free_owned_after(owned_before);
  }
}

TEST(two_surfaces_add_up) {
  flow f = random_flow(all_fields, 0);
  const int64_t n = f.nodes.n;
  riis_surface_options options = surface_options();
  options.rotation_angle = 90, options.rotation_axis[0] = 1;
  riis_surface *other = aortic_surface(&options);
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(other, f.mesh, NULL, result));
  double *sum = own(calloc((size_t)n * 12, sizeof *sum)), *one = sum + 4 * n, *two = sum + 8 * n;
  riis_resistance a = resistance_of(2), b = resistance_of(5);
  CHECK_OK(add_resistance_to(f.result, &a, n, one, one + n));
  CHECK_OK(add_resistance_to(result, &b, n, two, NULL)); /* the valve is at rest */
  CHECK_OK(add_resistance_to(f.result, &a, n, sum, sum + n));
  CHECK_OK(add_resistance_to(result, &b, n, sum, NULL));
  int64_t n_both = 0;
  for (int64_t i = 0; i < 4 * n; ++i) {
    CHECK_SAME(sum[i], one[i] + two[i]);
    n_both += i < n && one[i] > 0 && two[i] > 0;
  }
  assert_true(n_both > 10);
}

TEST(band_sums_are_those_of_a_plain_loop) {
  int64_t n_rim = 0;
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned();
    flow f = random_flow(all_fields, 0.25);
    const found_nodes within = within_in(f.result);
    const riis_mark_list fields = fields_of(&f);
    for (int i = 0; i < 5; ++i) {
      double inner = i ? between(0, 0.25) : 0, outer = i > 1 ? between(inner, 0.25) : 0.25;
      /* A band whose inner and outer distance are equal contains a node at exactly this distance. */
      if (i == 4) inner = outer = within.distance[random_bits(&rng) % (uint64_t)within.n];
      riis_band_sums expected = {{0, 0}, {0, 0}, {0, 0}}, sums;
      double scale = 0;
      for (int64_t j = 0; j < within.n; ++j) {
        const int64_t node = within.node_id[j];
        if (within.distance[j] < inner || within.distance[j] > outer) continue;
        n_rim += fields.rim[j];
        if (fields.rim[j] || fields.side[j] == 0) continue;
        const int band = fields.side[j] > 0;
        expected.sum[band] += f.weight[node] * f.value[node];
        expected.weight[band] += f.weight[node];
        ++expected.n_nodes[band];
        scale += 100 * f.weight[node];
      }
      memset(&sums, 0x55, sizeof sums);
      CHECK_OK(band_sums_of(f.result, inner, outer, f.nodes.n, f.value, f.weight, &sums, sizeof sums));
      for (int band = 0; band < 2; ++band) {
        assert_int_equal(sums.n_nodes[band], expected.n_nodes[band]);
        CHECK_NEAR(sums.sum[band], expected.sum[band], 1e-13 * scale);
        CHECK_NEAR(sums.weight[band], expected.weight[band], 1e-13 * scale);
      }
      if (i == 0) assert_true(sums.n_nodes[0] > 100 && sums.n_nodes[1] > 100);
    }
    free_owned_after(owned_before);
  }
  CHECK_MET(n_rim > 100);
}

/* The pressure jumps across the surface. On each side of the surface, the mean over the nodes is the pressure of the side. */
TEST(a_jump_of_pressure_is_measured) {
  random_frame();
  riis_surface *surface = surface_of(disc, 100, 10, 0.1);
  test_mesh nodes = lattice_around(surface, 0.05, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  options.fields = RIIS_FIELD_SIDE | RIIS_FIELD_RIM;
  options.distance_limit = 0.2;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  double *pressure = own(malloc((size_t)nodes.n * 2 * sizeof *pressure)), *weight = pressure + nodes.n;
  for (int64_t i = 0; i < nodes.n; ++i) {
    double height = 0;
    for (int c = 0; c < 3; ++c) height += frame[2][c] * (nodes.xyz[3 * i + c] - origin[c]);
    pressure[i] = height > 0 ? 7 : 12;
    weight[i] = between(0.5, 1);
  }
  riis_band_sums sums;
  CHECK_OK(band_sums_of(result, 0.1, 0.2, nodes.n, pressure, weight, &sums, sizeof sums));
  /* The disc's orientation is random: its normals point along the frame's third axis or against it. */
  const double mean[2] = {sums.sum[0] / sums.weight[0], sums.sum[1] / sums.weight[1]};
  const int turned = mean[0] < mean[1];
  CHECK_NEAR(mean[turned], 12, 1e-12);
  CHECK_NEAR(mean[1 - turned], 7, 1e-12);
}

/* --- Refusals -------------------------------------------------------------------------------------------------------- */

TEST(refusals_leave_the_arrays) {
  flow f = random_flow(all_fields, 0.2), bare = random_flow(0, 0);
  const int64_t n = f.nodes.n, m = bare.nodes.n;
  const size_t size = (size_t)(n > m ? n : m) * 4 * sizeof(double);
  double *k = own(malloc(size)), *before = own(malloc(size)), *momentum = k + n, force[3] = {1, 2, 3};
  for (size_t i = 0; i < size / sizeof *k; ++i) k[i] = before[i] = between(-1, 1);
  riis_resistance resistance;
  riis_band_sums sums, sums_before;
  memset(&sums, 0x33, sizeof sums);
  sums_before = sums;
#define UNCHANGED()                                               \
  do {                                                            \
    assert_memory_equal(k, before, size);                         \
    assert_true(force[0] == 1 && force[1] == 2 && force[2] == 3); \
    assert_memory_equal(&sums, &sums_before, sizeof sums);        \
  } while (0)
#define CALLS_REFUSED(status, parts)                                                                      \
  do {                                                                                                    \
    CHECK_REFUSED(status, parts, add_resistance_to(f.result, &resistance, n, k, momentum));               \
    UNCHANGED();                                                                                          \
    CHECK_REFUSED(status, parts, add_reaction_to(f.result, &resistance, n, f.velocity, f.weight, force)); \
    UNCHANGED();                                                                                          \
  } while (0)
#define CHANGED_IS_REFUSED(change, parts)        \
  do {                                           \
    resistance = resistance_of(1);               \
    resistance.change;                           \
    CALLS_REFUSED(RIIS_INVALID_ARGUMENT, parts); \
  } while (0)
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  assert_true(isnan(resistance.R) && resistance.half_thickness == RIIS_AUTO && resistance.rim == RIIS_RIM_ROUND &&
              resistance.reserved == 0);
  CALLS_REFUSED(RIIS_INVALID_ARGUMENT, "resistance.R is nan;|from 0 to 1e+60");
  CHANGED_IS_REFUSED(R = -1, "resistance.R is -1;");
  CHANGED_IS_REFUSED(R = -1e-300, "resistance.R is -1e-300;");
  CHANGED_IS_REFUSED(R = INFINITY, "resistance.R is inf;");
  CHANGED_IS_REFUSED(R = 0x1p-1050, "resistance.R is 8.289046e-317; it must be 0, or from 1e-300|a REAL*4 or a float?");
  CHANGED_IS_REFUSED(R = 0.99e-300, "resistance.R is 9.9e-301;");
  CHANGED_IS_REFUSED(R = 1.1e60, "resistance.R is 1.1e+60;");
  CHANGED_IS_REFUSED(half_thickness = 0.21,
                     "resistance.half_thickness is 0.21;|the distance limit of the marking, 0.2");
  CHANGED_IS_REFUSED(half_thickness = 0, "resistance.half_thickness is 0;|from 1e-50");
  CHANGED_IS_REFUSED(half_thickness = -0.1, "resistance.half_thickness is -0.1;");
  CHANGED_IS_REFUSED(half_thickness = NAN, "resistance.half_thickness is nan;");
  CHANGED_IS_REFUSED(rim = 2, "resistance.rim is 2;|RIIS_RIM_ROUND or RIIS_RIM_CUT");
  CHANGED_IS_REFUSED(rim = -1, "resistance.rim is -1;");
  CHANGED_IS_REFUSED(reserved = 5, "resistance.reserved is 5");
  static const int64_t sizes[] = {0, 8, 24, 40, -32};
  for (int i = 0; i < 5; ++i) {
    resistance = resistance_of(1);
    resistance.struct_size = sizes[i];
    CALLS_REFUSED(RIIS_INVALID_STRUCT_SIZE, "struct size of resistance");
    CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "struct size of resistance", riis_resistance_init(&resistance, sizes[i]));
  }
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "resistance is NULL", riis_resistance_init(NULL, sizeof resistance));

  resistance = resistance_of(1);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_nodes is 7;|a mesh with",
                add_resistance_to(f.result, &resistance, 7, k, momentum));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_nodes is -1;",
                add_reaction_to(f.result, &resistance, -1, f.velocity, f.weight, force));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_nodes is 0;",
                band_sums_of(f.result, 0, 0.1, 0, f.value, f.weight, &sums, sizeof sums));
  UNCHANGED();

  /* Wrong resistances in the options of a marking are refused, and the marks stay. Wrong layouts are also refused. */
  riis_mark_options with_resistance = mark_options();
  const riis_mark_list list_before = marked_list(f.result);
  with_resistance.resistance = &resistance;
  resistance.R = -2;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.resistance.R is -2;",
                riis_mark_nodes(f.surface, f.mesh, &with_resistance, f.result));
  resistance = resistance_of(1);
  resistance.half_thickness = 0.11;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.resistance.half_thickness is 0.11;",
                riis_mark_nodes(f.surface, f.mesh, &with_resistance, f.result));
  const riis_mark_list list_after = marked_list(f.result);
  assert_memory_equal(&list_before, &list_after, sizeof list_before);
  resistance = resistance_of(1);
  riis_resistance_arrays arrays;
  CHECK_OK(riis_resistance_arrays_init(&arrays, sizeof arrays));
  arrays.n_nodes = n;
  arrays.K = k;
  arrays.K_stride = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.K_stride is 0;",
                riis_marks_add_resistance(f.result, &resistance, &arrays));
  arrays.K_stride = 1;
  arrays.K_u_surface[0] = momentum;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.K_u_surface[1] is NULL",
                riis_marks_add_resistance(f.result, &resistance, &arrays));
  arrays.K_u_surface[1] = momentum + 1, arrays.K_u_surface[2] = momentum + 2;
  CHECK_REFUSED(
      RIIS_INVALID_ARGUMENT,
      "arrays.K_u_surface[1] begins at number 1 of arrays.K_u_surface[0]|arrays.K_u_surface_stride is 1;|stride 3",
      riis_marks_add_resistance(f.result, &resistance, &arrays));
  arrays.K_u_surface_stride = 3, arrays.K_u_surface[1] = momentum;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT,
                "arrays.K_u_surface[1] is the same array as arrays.K_u_surface[0]; each component",
                riis_marks_add_resistance(f.result, &resistance, &arrays));
  riis_flow_arrays of_flow;
  riis_reaction reaction;
  CHECK_OK(riis_flow_arrays_init(&of_flow, sizeof of_flow));
  CHECK_OK(riis_reaction_init(&reaction, sizeof reaction));
  of_flow.n_nodes = n, of_flow.weight = f.weight, reaction.force = force;
  for (int c = 0; c < 3; ++c) of_flow.velocity[c] = f.velocity + c;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT,
                "flow.velocity[1] begins at number 1 of flow.velocity[0]|flow.velocity_stride is 1;",
                riis_marks_add_reaction(f.result, &resistance, &of_flow, &reaction));
  UNCHANGED();

  /* A call is refused if the marks lack a field that it needs. */
  const char *lacks = "options.fields = 0";
  resistance.rim = RIIS_RIM_CUT;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "RIIS_RIM_CUT needs RIIS_FIELD_RIM|options.fields = 0",
                add_resistance_to(bare.result, &resistance, m, k, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "RIIS_FIELD_RIM",
                add_reaction_to(bare.result, &resistance, m, bare.velocity, bare.weight, force));
  resistance.rim = RIIS_RIM_ROUND;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.K_u_surface needs RIIS_FIELD_VELOCITY|options.fields = 0",
                add_resistance_to(bare.result, &resistance, m, k, momentum));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "needs RIIS_FIELD_SIDE",
                band_sums_of(bare.result, 0, 0.1, m, bare.value, bare.weight, &sums, sizeof sums));
  assert_non_null(strstr(riis_last_error(), lacks));
  riis_mark_options options = mark_options();
  options.fields = RIIS_FIELD_SIDE;
  CHECK_OK(riis_mark_nodes(bare.surface, bare.mesh, &options, bare.result));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "needs RIIS_FIELD_RIM|options.fields = 8",
                band_sums_of(bare.result, 0, 0.1, m, bare.value, bare.weight, &sums, sizeof sums));
  UNCHANGED();

  /* Wrong bands. */
#define BAND_REFUSED(inner, outer, parts)                                                          \
  do {                                                                                             \
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, parts,                                                    \
                  band_sums_of(f.result, inner, outer, n, f.value, f.weight, &sums, sizeof sums)); \
    UNCHANGED();                                                                                   \
  } while (0)
  BAND_REFUSED(0.15, 0.1, "inner is 0.15;|outer, which is 0.1");
  BAND_REFUSED(-0.01, 0.1, "inner is -0.01;");
  BAND_REFUSED(NAN, 0.1, "inner is nan;");
  BAND_REFUSED(0, NAN, "inner is 0;|nan");
  BAND_REFUSED(0, 0.3, "outer is 0.3;|the distance limit of the marking, 0.2");
  BAND_REFUSED(0, INFINITY, "outer is inf;");
  static const int64_t sum_sizes[] = {0, 40, 56};
  for (int i = 0; i < 3; ++i)
    CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "struct size of sums",
                  band_sums_of(f.result, 0, 0.1, n, f.value, f.weight, &sums, sum_sizes[i]));
  UNCHANGED();

  /* NULL arguments. */
  const void *no_result = f.mesh;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "marks is NULL", add_resistance_to(NULL, &resistance, n, k, momentum));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "marks is a handle of another kind",
                add_resistance_to(no_result, &resistance, n, k, momentum));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "resistance is NULL", add_resistance_to(f.result, NULL, n, k, momentum));
#define REACTION_REFUSED(parts, ...) CHECK_REFUSED(RIIS_INVALID_ARGUMENT, parts, add_reaction_to(__VA_ARGS__))
  REACTION_REFUSED("marks is NULL", NULL, &resistance, n, f.velocity, f.weight, force);
  REACTION_REFUSED("resistance is NULL", f.result, NULL, n, f.velocity, f.weight, force);
  REACTION_REFUSED("flow.velocity[0] is NULL", f.result, &resistance, n, NULL, f.weight, force);
  REACTION_REFUSED("flow.weight is NULL", f.result, &resistance, n, f.velocity, NULL, force);
  REACTION_REFUSED("reaction has no array to add to", f.result, &resistance, n, f.velocity, f.weight, NULL);
#define SUMS_REFUSED(parts, ...) CHECK_REFUSED(RIIS_INVALID_ARGUMENT, parts, band_sums_of(__VA_ARGS__))
  SUMS_REFUSED("marks is NULL", NULL, 0, 0.1, n, f.value, f.weight, &sums, sizeof sums);
  SUMS_REFUSED("band.value is NULL", f.result, 0, 0.1, n, NULL, f.weight, &sums, sizeof sums);
  SUMS_REFUSED("band.weight is NULL", f.result, 0, 0.1, n, f.value, NULL, &sums, sizeof sums);
  SUMS_REFUSED("sums is NULL", f.result, 0, 0.1, n, f.value, f.weight, NULL, sizeof sums);
  UNCHANGED();

  /* This result holds no marks. */
  riis_marks *empty = new_result();
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "marks are empty", add_resistance_to(empty, &resistance, 0, k, NULL));
  REACTION_REFUSED("marks are empty", empty, &resistance, 0, f.velocity, f.weight, force);
  SUMS_REFUSED("needs RIIS_FIELD_SIDE", empty, 0, 0, 0, f.value, f.weight, &sums, sizeof sums);
  UNCHANGED();
}

int main(void) {
  rng = random_start("test_resistance");
  return run_cases(NULL, NULL);
}
