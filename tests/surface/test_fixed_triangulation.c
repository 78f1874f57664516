/* SPDX-License-Identifier: Apache-2.0
 * Tests triangulations that stay fixed while a valve opens. Ids, neighbours and positions on the patches stay the same, and the
 * bound holds at every opening. A refusal does not change the surface. test_tolerance compares these triangulations with the
 * smooth mitral valve. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "shapes.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }

static riis_surface_options fixed_options(void) {
  riis_surface_options options = surface_options();
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  return options;
}

static void set_opening(riis_valve *valve, double opening) {
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
}

static riis_valve *opening_aortic(void) {
  riis_valve *valve = new_valve("aortic"), *open = new_valve("aortic");
  CHECK_OK(riis_valve_set_scalar(open, "leaflet_radius_in", 1));
  CHECK_OK(riis_valve_set_scalar(open, "bending_radius_in", 1.1));
  CHECK_OK(riis_valve_set_open_state(valve, open));
  free_one_owned(open);
  return valve;
}

/* A patch whose side u = 1 grows from a point to a curve. */
static riis_valve *fan(void) {
  shape made[2] = {{0}, {0}};
  for (int k = 0; k < 2; ++k) {
    const double bend[3][3] = {{0, 1, 0}, {0.5, 1, 0.25}, {1, k, 0.25 * k}};
    add_line(&made[k], 0, 0, 0, 1, 0, 0);
    add_curve(&made[k], 2, bend);
    add_line(&made[k], 0, 0, 0, 0, 1, 0);
    add_line(&made[k], 1, 0, 0, 1, k, 0.25 * k);
    add_patch(&made[k], 0, 1, 2, 3);
  }
  riis_valve *valve = valve_from(&made[0]), *open = valve_from(&made[1]);
  CHECK_OK(riis_valve_set_open_state(valve, open));
  free_one_owned(open);
  return valve;
}

/* A copy of the arrays that must stay constant, for a comparison after the next update. */
typedef struct topology {
  int64_t n_vertices, n_triangles;
  int64_t vertex_id[3 * 20000], triangle_id[20000];
  int32_t leaflet_id[20000], patch_id[20000];
} topology;
static topology first, now;

static void read_topology(const riis_surface *surface, topology *into) {
  into->n_vertices = triangles_of(surface).n_vertices;
  into->n_triangles = triangles_of(surface).n_triangles;
  const int64_t *vertex_id = triangles_of(surface).vertex_id;
  const int64_t *triangle_id = triangles_of(surface).triangle_id;
  const int32_t *leaflet_id = triangles_of(surface).leaflet_id;
  const int32_t *patch_id = triangles_of(surface).patch_id;
  if (into->n_triangles > 20000) fail_msg("%lld triangles", (long long)into->n_triangles);
  const size_t n = (size_t)into->n_triangles;
  memcpy(into->vertex_id, vertex_id, 3 * n * sizeof *vertex_id);
  memcpy(into->triangle_id, triangle_id, n * sizeof *triangle_id);
  memcpy(into->leaflet_id, leaflet_id, n * sizeof *leaflet_id);
  memcpy(into->patch_id, patch_id, n * sizeof *patch_id);
}

static void check_same_topology(const topology *a, const topology *b) {
  assert_int_equal(a->n_vertices, b->n_vertices);
  assert_int_equal(a->n_triangles, b->n_triangles);
  const size_t n = (size_t)a->n_triangles;
  assert_memory_equal(a->vertex_id, b->vertex_id, 3 * n * sizeof *a->vertex_id);
  assert_memory_equal(a->triangle_id, b->triangle_id, n * sizeof *a->triangle_id);
  assert_memory_equal(a->leaflet_id, b->leaflet_id, n * sizeof *a->leaflet_id);
  assert_memory_equal(a->patch_id, b->patch_id, n * sizeof *a->patch_id);
}

/* Checks 101 openings. Only some of the tested openings were used to choose the grid lines. The triangles stay the same, and stay
 * within the bound. The number of triangles is at most 1.5 times the largest number of adapted triangles. */
static void check_triangles_stay(riis_valve *valve, const char *name) {
  const riis_surface_options options = fixed_options();
  set_opening(valve, 0.5);
  riis_surface *fixed = new_surface(valve, &options), *adapted = new_surface(valve, NULL);
  int64_t most = 0;
  double largest = 0;
  read_topology(fixed, &first);
  for (int i = 0; i <= 100; i += is_short_test() ? 20 : 1) {
    set_opening(valve, i / 100.0);
    CHECK_OK(riis_surface_update(fixed, valve, NULL));
    CHECK_OK(riis_surface_update(adapted, valve, NULL));
    read_topology(fixed, &now);
    check_same_topology(&first, &now);
    largest = fmax(largest, info_of(fixed).error_bound);
    if (info_of(adapted).n_triangles > most) most = info_of(adapted).n_triangles;
  }
  printf("%s: %lld fixed triangles, %lld adapted ones at most\n", name, (long long)first.n_triangles, (long long)most);
  CHECK_AT_MOST(largest, 0.005);
  CHECK_MET(largest > 0.001); /* the bound must not be far too large */
  CHECK_MET(2 * first.n_triangles <= 3 * most);
}

TEST(triangles_stay_at_every_opening) {
  check_triangles_stay(new_valve("mitral"), "mitral");
  check_triangles_stay(opening_aortic(), "aortic");
  check_triangles_stay(new_valve("aortic"), "aortic, its own open state");
  check_triangles_stay(new_valve("trileaflet"), "trileaflet");
  check_triangles_stay(new_valve("coapting"), "coapting");
}

/* The distances to both triangulations differ by at most the sum of the two bounds. */
static void check_distances(riis_valve *valve) {
  riis_surface_options options = fixed_options();
  riis_surface *fixed = new_surface(valve, &options);
  options = surface_options();
  options.tolerance = 0.002;
  riis_surface *fine = new_surface(valve, &options);
  for (int i = 0; i < trials_of(60); ++i) {
    set_opening(valve, i < 2 ? i : between(0, 1));
    CHECK_OK(riis_surface_update(fixed, valve, NULL));
    CHECK_OK(riis_surface_update(fine, valve, NULL));
    for (int k = 0; k < 400; ++k) {
      const double x = between(-2, 2), y = between(-2, 2), z = between(-1.5, 2);
      const double off = closest_to(fixed, x, y, z).distance - closest_to(fine, x, y, z).distance;
      CHECK_AT_MOST(fabs(off), 0.005 + 0.0002);
    }
  }
}

TEST(distances_are_within_the_bound) {
  rng = random_start("test_fixed_triangulation");
  check_distances(new_valve("mitral"));
  check_distances(opening_aortic());
  check_distances(fan());
}

/* The triangles depend on the valve and on its present opening. The opening at which the surface was made has no effect, so a
 * restart gives the same bits. */
TEST(a_restart_has_the_same_bits) {
  riis_valve *valves[3] = {new_valve("mitral"), opening_aortic(), fan()};
  const riis_surface_options options = fixed_options();
  for (int k = 0; k < 3; ++k) {
    set_opening(valves[k], 0.9);
    riis_surface *moved = new_surface(valves[k], &options);
    set_opening(valves[k], 0.37);
    CHECK_OK(riis_surface_update(moved, valves[k], NULL));
    check_same_surfaces(moved, new_surface(valves[k], &options));
  }
}

/* If the curves have no joints, the grid lines stay. A vertex's velocity is then its displacement divided by the time. A small
 * difference occurs only on grid lines that end between two vertices of a side, because such lines end on chords. */
TEST(velocity_is_that_of_the_vertices) {
  rng = random_start("test_fixed_triangulation");
  riis_valve *valves[2] = {opening_aortic(), fan()};
  const riis_surface_options options = fixed_options();
  for (int k = 0; k < 2; ++k) {
    const double before = between(0.1, 0.8), seconds = 0.01;
    riis_valve *valve_before = NULL;
    set_opening(valves[k], before);
    CHECK_OK(riis_valve_copy(valves[k], &valve_before));
    own(valve_before);
    riis_surface *surface = new_surface(valves[k], &options), *moved = new_surface(valves[k], &options);
    set_opening(valves[k], before + 0.05);
    CHECK_OK(riis_surface_update_moving(moved, valves[k], valve_before, seconds, NULL, NULL));
    const riis_triangles was = triangles_of(surface), is = triangles_of(moved);
    const double *velocity = triangles_of(moved).velocity;
    assert_non_null(velocity);
    double largest = 0;
    for (int64_t i = 0; i < 3 * is.n_vertices; ++i) {
      CHECK_NEAR(velocity[i], (is.xyz[i] - was.xyz[i]) / seconds, 0.02);
      largest = fmax(largest, fabs(velocity[i]));
    }
    assert_true(largest > 0.5);
    CHECK_OK(riis_surface_update(surface, valves[k], NULL));
    check_same_surfaces(surface, moved);
  }
}

/* The fan's last triangle has no area at opening 0. */
TEST(a_triangle_without_area_keeps_its_id) {
  riis_valve *valve = fan();
  const riis_surface_options options = fixed_options();
  set_opening(valve, 0.5);
  riis_surface *surface = new_surface(valve, &options);
  read_topology(surface, &first);
  set_opening(valve, 0);
  CHECK_OK(riis_surface_update(surface, valve, NULL));
  read_topology(surface, &now);
  const int64_t n_lost = first.n_triangles - now.n_triangles;
  assert_true(n_lost > 0);
  assert_int_equal(info_of(surface).n_zero_area, n_lost);
  int64_t k = 0;
  for (int64_t i = 0; i < now.n_triangles; ++i, ++k) {
    while (k < first.n_triangles && first.triangle_id[k] != now.triangle_id[i]) ++k;
    assert_true(k < first.n_triangles);
    assert_memory_equal(first.vertex_id + 3 * k, now.vertex_id + 3 * i, 3 * sizeof *now.vertex_id);
  }
  for (int i = 0; i < 200; ++i) { /* queries report these ids */
    const riis_closest closest = closest_to(surface, 0.005 * i, 0.4, 0.3);
    int64_t at = 0;
    while (at < now.n_triangles && now.triangle_id[at] != closest.triangle_id) ++at;
    assert_true(at < now.n_triangles);
  }
  set_opening(valve, 0.5);
  CHECK_OK(riis_surface_update(surface, valve, NULL));
  read_topology(surface, &now);
  check_same_topology(&first, &now);
}

/* If the surface angle is 0, the mitral leaflets are Coons patches, which share their edges only at opening 0. */
TEST(flat_mitral_leaflets_stay_within_the_bound) {
  rng = random_start("test_fixed_triangulation");
  riis_valve *valve = new_valve("mitral");
  CHECK_OK(riis_valve_set_scalar(valve, "surface_angle", 0));
  check_triangles_stay(valve, "flat mitral");
  check_distances(valve);
}

/* The patches have rough sides that differ between the two states. An opening at which the grid lines were chosen is never
 * refused. */
TEST(openings_of_the_choice_are_never_refused) {
  rng = random_start("test_fixed_triangulation");
  const riis_surface_options defaults = fixed_options();
  for (int trial = 0; trial < trials_of(90); ++trial) {
    const int owned_before = n_owned();
    shape made[2] = {{0}, {0}};
    for (int k = 0; k < 2; ++k) {
      double q[4][4][3];
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          for (int c = 0; c < 3; ++c) q[i][j][c] = between(-0.2, 0.2) + (c == 0 ? i / 3.0 : c == 1 ? j / 3.0 : 0);
      const double sides[4][4][3] = {{{q[0][0][0], q[0][0][1], q[0][0][2]},
                                      {q[1][0][0], q[1][0][1], q[1][0][2]},
                                      {q[2][0][0], q[2][0][1], q[2][0][2]},
                                      {q[3][0][0], q[3][0][1], q[3][0][2]}},
                                     {{q[0][3][0], q[0][3][1], q[0][3][2]},
                                      {q[1][3][0], q[1][3][1], q[1][3][2]},
                                      {q[2][3][0], q[2][3][1], q[2][3][2]},
                                      {q[3][3][0], q[3][3][1], q[3][3][2]}},
                                     {{q[0][0][0], q[0][0][1], q[0][0][2]},
                                      {q[0][1][0], q[0][1][1], q[0][1][2]},
                                      {q[0][2][0], q[0][2][1], q[0][2][2]},
                                      {q[0][3][0], q[0][3][1], q[0][3][2]}},
                                     {{q[3][0][0], q[3][0][1], q[3][0][2]},
                                      {q[3][1][0], q[3][1][1], q[3][1][2]},
                                      {q[3][2][0], q[3][2][1], q[3][2][2]},
                                      {q[3][3][0], q[3][3][1], q[3][3][2]}}};
      for (int i = 0; i < 4; ++i) add_curve(&made[k], 3, sides[i]);
      add_patch(&made[k], 0, 1, 2, 3);
    }
    riis_valve *valve = valve_from(&made[0]), *open = valve_from(&made[1]);
    CHECK_OK(riis_valve_set_open_state(valve, open));
    riis_surface_options options = defaults;
    options.tolerance = pow(10, between(-2, 0));
    riis_surface *surface = new_surface(valve, &options);
    for (int i = 0; i <= 32; ++i) {
      set_opening(valve, i / 32.0);
      CHECK_OK(riis_surface_update(surface, valve, NULL));
      CHECK_AT_MOST(info_of(surface).error_bound, 0.1 * options.tolerance);
    }
    free_owned_after(owned_before);
  }
}

/* Coordinates so large that rounding errors matter are refused, with and without a fixed triangulation. */
TEST(coordinates_too_large_are_refused) {
  shape square = unit_square();
  for (int64_t i = 0; i < square.n_curves; ++i)
    for (int k = 0; k <= square.degree[i]; ++k) square.control[i][k][0] += 3.3e6;
  riis_valve *valve = valve_from(&square);
  riis_surface_options options = fixed_options();
  options.half_thickness = options.tolerance = 1e-6;
  riis_surface *surface = NULL;
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "coordinates up to|rounding exceeds",
                riis_surface_create(valve, &options, &surface));
  assert_null(surface);
}

TEST(a_surface_of_arrays_forgets_the_choice) {
  const double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int32_t ids[3] = {0, 1, 2};
  const riis_surface_arrays arrays = triangle_arrays(3, xyz, 1, ids);
  const riis_surface_options fixed = fixed_options(), adapted = surface_options();
  riis_surface *surface = new_surface(new_valve("mitral"), &fixed);
  CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, &adapted));
  CHECK_OK(riis_surface_update(surface, opening_aortic(), &fixed));
}

/* On one side of the patch, the curve's speed nearly vanishes. The whole patch moves by 1e-6 in 1e-6 seconds. */
TEST(near_cusps_move_with_their_valve) {
  shape made[2] = {{0}, {0}};
  for (int k = 0; k < 2; ++k) {
    const double dx = 1e-6 * k, cusp[4][3] = {{dx, 0, 0}, {1e-6 + dx, 0, 0}, {1 + dx, 0.2, 0}, {2 + dx, 1, 0.3}};
    add_curve(&made[k], 3, cusp);
    add_line(&made[k], dx, 2, 0, 2 + dx, 3, 0.3);
    add_line(&made[k], dx, 0, 0, dx, 2, 0);
    add_line(&made[k], 2 + dx, 1, 0.3, 2 + dx, 3, 0.3);
    add_patch(&made[k], 0, 1, 2, 3);
  }
  riis_valve *valve = valve_from(&made[0]), *before = valve_from(&made[0]), *open = valve_from(&made[1]);
  CHECK_OK(riis_valve_set_open_state(valve, open));
  CHECK_OK(riis_valve_set_open_state(before, open));
  riis_surface_options options = fixed_options();
  for (options.tolerance = 0.01; options.tolerance > 1e-4; options.tolerance *= 0.5) {
    set_opening(valve, 0);
    riis_surface *surface = new_surface(valve, &options);
    set_opening(valve, 1);
    CHECK_OK(riis_surface_update_moving(surface, valve, before, 1e-6, NULL, NULL));
    const double *velocity = velocity_of(surface);
    for (int64_t i = 0; i < info_of(surface).n_vertices; ++i) CHECK_NEAR(velocity[3 * i], 1, 1e-5);
    free_one_owned(surface);
  }
}

TEST(a_valve_with_one_state_is_fixed_too) {
  const riis_surface_options options = fixed_options();
  const shape square = unit_square();
  riis_valve *valve = valve_from(&square);
  riis_surface *surface = new_surface(valve, &options);
  riis_surface_options moved = options;
  moved.translation[0] = 3;
  CHECK_OK(riis_surface_update(surface, valve, &moved));
  CHECK_NEAR(closest_to(surface, 3, 0, 0).distance, closest_to(new_surface(valve, &options), 0, 0, 0).distance, 1e-12);
}

TEST(other_changes_are_refused) {
  riis_valve *valve = new_valve("mitral"), *aortic = opening_aortic(), *other = NULL;
  riis_surface_options options = fixed_options();
  set_opening(valve, 0.25);
  riis_surface *surface = new_surface(valve, &options), *same = new_surface(valve, &options);
  CHECK_OK(riis_valve_copy(valve, &other));
  own(other);
  CHECK_OK(riis_valve_set_scalar(other, "AP_diameter", 3.25));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "AP_diameter is 3.25|fixed for 3|only opening and placement",
                riis_surface_update(surface, other, NULL));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "AP_diameter is 3.25",
                riis_surface_update_moving(surface, other, valve, 0.1, NULL, NULL));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "kind aortic|one of the kind mitral",
                riis_surface_update(surface, aortic, NULL));
  CHECK_OK(riis_valve_set_scalar(other, "AP_diameter", 3));
  CHECK_OK(riis_valve_set_open_state(other, valve));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "has an open state|fixed for none", riis_surface_update(surface, other, NULL));
  options.tolerance = 0.01;
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "patch |of the fixed triangulation may be off by |at most 0.001",
                riis_surface_update(surface, valve, &options));
  check_same_surfaces(surface, same); /* compares and frees both */
  surface = new_surface(valve, NULL);
  options = fixed_options();
  CHECK_OK(riis_surface_update(surface, valve, &options));
  options.tolerance = 0.01;
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "fixed triangulation", riis_surface_update(surface, valve, &options));
  /* An update without the option drops the fixed triangulation. A later update may make a new fixed triangulation. */
  options.triangulation = RIIS_TRIANGULATION_ADAPTED;
  CHECK_OK(riis_surface_update(surface, valve, &options));
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  CHECK_OK(riis_surface_update(surface, valve, &options));
  CHECK_AT_MOST(info_of(surface).error_bound, 0.001);
}

TEST(other_open_states_and_curves_are_refused) {
  riis_valve *valve = opening_aortic(), *other = opening_aortic(), *open = new_valve("aortic");
  const riis_surface_options options = fixed_options();
  riis_surface *surface = new_surface(valve, &options);
  CHECK_OK(riis_valve_set_scalar(open, "leaflet_angle", 31));
  CHECK_OK(riis_valve_set_open_state(other, open));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "in the open state is |fixed for ", riis_surface_update(surface, other, NULL));
  shape square = unit_square();
  riis_valve *flat = valve_from(&square);
  square.control[0][0][2] = square.control[2][0][2] = 0.5;
  surface = new_surface(flat, &options);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "curve 0|fixed for", riis_surface_update(surface, valve_from(&square), NULL));
}

TEST(bad_options_are_refused) {
  riis_surface_options options = fixed_options();
  riis_valve *valve = new_valve("aortic");
  riis_surface *surface = NULL;
  options.triangulation = 2;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.triangulation is 2", riis_surface_create(valve, &options, &surface));
  options = fixed_options();
  const double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int32_t ids[3] = {0, 1, 2};
  const riis_surface_arrays arrays = triangle_arrays(3, xyz, 1, ids);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.triangulation is 1|surface from arrays",
                riis_surface_create_from_arrays(&arrays, &options, &surface));
  assert_null(surface);
}

int main(void) { return run_cases(NULL, NULL); }
