/* SPDX-License-Identifier: Apache-2.0
 * Tests the open state that an aortic valve's own parameters define (docs/theory/aortic.md). */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "cusp_checks.h"

static const double turn[3] = {0, 119.5, -121.5}, half_angle[3] = {61, 58.5, 60.5};
static const char *const cusps[3] = {"right", "left", "non_coronary"};

static riis_surface_options fixed_options(void) {
  riis_surface_options options = surface_options();
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  return options;
}

static riis_valve *copy_of(const riis_valve *valve) {
  riis_valve *copy = NULL;
  CHECK_OK(riis_valve_copy(valve, &copy));
  return own(copy);
}

TEST(opens_at_once) {
  const double orifice = check_opening(new_valve("aortic"), 1.29, turn, half_angle, 0.1, "aortic");
  assert_true(orifice > 3 && orifice < 4);
}

static double own_value(const riis_valve *valve, const char *cusp, const char *name) {
  char full[64];
  double value;
  snprintf(full, sizeof full, "%s.%s", cusp, name);
  CHECK_OK(riis_valve_get(valve, full, 1, &value));
  return value;
}

static void set_own(riis_valve *valve, const char *cusp, const char *name, double value) {
  char full[64];
  snprintf(full, sizeof full, "%s.%s", cusp, name);
  CHECK_OK(riis_valve_set_scalar(valve, full, value));
}

/* Returns a second valve whose state is the first valve's open state, by the formulas of docs/theory/aortic.md. */
static riis_valve *state_by_hand(const riis_valve *valve, double radius_ratio, double expansion) {
  riis_valve *open = copy_of(valve);
  double R, h_l, h_b, third_leaflet[3], third_bending[3];
  CHECK_OK(riis_valve_get(valve, "root_radius", 1, &R));
  CHECK_OK(riis_valve_get(valve, "leaflet_height", 1, &h_l));
  CHECK_OK(riis_valve_get(valve, "bending_height", 1, &h_b));
  const double s = h_b / h_l, r = radius_ratio * R;
  for (int i = 0; i < 3; ++i) {
    const double r_leaflet = own_value(valve, cusps[i], "leaflet_radius_out") * (1 + expansion),
                 r_bending = own_value(valve, cusps[i], "bending_radius_out") * (1 + s * expansion);
    set_own(open, cusps[i], "leaflet_radius_out", r_leaflet);
    set_own(open, cusps[i], "bending_radius_out", r_bending);
    third_leaflet[i] = r_leaflet * sin(own_value(valve, cusps[i], "leaflet_angle") * cusp_degree) / 3;
    third_bending[i] = r_bending * sin(own_value(valve, cusps[i], "bending_angle") * cusp_degree) / 3;
  }
  CHECK_OK(riis_valve_set_scalar(open, "leaflet_radius_in", r));
  CHECK_OK(riis_valve_set_scalar(open, "bending_radius_in", (1 - s) * R + s * r));
  CHECK_OK(riis_valve_set_scalar(open, "leaflet_power", 2));
  CHECK_OK(riis_valve_set_scalar(open, "bending_power", 2));
  CHECK_OK(riis_valve_set(open, "t0_leaflet", 3, third_leaflet));
  CHECK_OK(riis_valve_set(open, "t3_leaflet", 3, third_leaflet));
  CHECK_OK(riis_valve_set(open, "t0_bending", 3, third_bending));
  CHECK_OK(riis_valve_set(open, "t3_bending", 3, third_bending));
  return open;
}

/* At any opening, the surface equals the surface of a valve that was given an open state of the same shape. */
TEST(state_is_the_one_of_the_formulas) {
  random_source random = random_start("test_aortic_opening");
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    double ratio = 0.75, expansion = 0.05;
    riis_valve *valve = new_valve("aortic");
    if (trial > 0) {
      ratio = random_between(&random, 0.6, 1), expansion = random_between(&random, 0, 0.2);
      CHECK_OK(riis_valve_set_scalar(valve, "open_radius_ratio", ratio));
      CHECK_OK(riis_valve_set_scalar(valve, "commissure_expansion", expansion));
      CHECK_OK(riis_valve_set_scalar(valve, "root_radius", random_between(&random, 1, 1.5)));
      CHECK_OK(riis_valve_set_scalar(valve, "leaflet_height", random_between(&random, 0.9, 1.4)));
      CHECK_OK(riis_valve_set_scalar(valve, "left.leaflet_angle", random_between(&random, 50, 60)));
    }
    riis_valve *given = copy_of(valve);
    CHECK_OK(riis_valve_set_open_state(given, state_by_hand(valve, ratio, expansion)));
    const double opening = trial < 3 ? 0.5 * trial : random_between(&random, 0, 1);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
    CHECK_OK(riis_valve_set_scalar(given, "opening", opening));
    const riis_triangles a = triangles_of(new_surface(valve, NULL)), b = triangles_of(new_surface(given, NULL));
    assert_int_equal(a.n_vertices, b.n_vertices);
    for (int64_t i = 0; i < 3 * a.n_vertices; ++i) CHECK_NEAR(a.xyz[i], b.xyz[i], 1e-12);
    free_owned_after(owned_before);
  }
}

/* At opening 1, the free edge is a parabola in the cusp's frame. */
TEST(open_free_edges_are_parabolas) {
  static const double radius_out[3] = {1.365, 1.495, 1.38};
  const riis_triangles all = triangles_of(new_surface(valve_at("aortic", 1), NULL));
  int n = 0;
  for (int64_t i = 0; i < 3 * all.n_triangles; ++i) {
    const int64_t v = all.vertex_id[i];
    const int cusp = all.leaflet_id[i / 3];
    if (all.patch_id[i / 3] % 2 == 0 || all.uv[2 * v + 1] != 1) continue;
    const double a = turn[cusp] * cusp_degree, *p = all.xyz + 3 * v;
    const double x = p[0] * cos(a) + p[1] * sin(a), y = p[1] * cos(a) - p[0] * sin(a);
    const double end_x = 1.05 * radius_out[cusp] * cos(half_angle[cusp] * cusp_degree),
                 end_y = 1.05 * radius_out[cusp] * sin(half_angle[cusp] * cusp_degree);
    /* A vertex may be off the curve, because vertices of split quads lie on the curve's chords. */
    CHECK_NEAR(x, 0.75 * 1.29 + (end_x - 0.75 * 1.29) * (y / end_y) * (y / end_y), 0.005);
    CHECK_NEAR(p[2], 0.02, 1e-14);
    ++n;
  }
  assert_true(n > 50);
}

/* Returns 1 if the vertices of each surface lie on the other surface, to within the sum of the error bounds. The triangles may
 * differ, because some vertices depend on the motion to the open state. */
static int have_same_shape(const riis_valve *a, const riis_valve *b) {
  riis_surface_options options = surface_options();
  options.tolerance = 0.005;
  const riis_surface *on[2] = {new_surface(a, &options), new_surface(b, &options)};
  for (int i = 0; i < 2; ++i) {
    const riis_triangles c = triangles_of(on[i]);
    const double bound = info_of(on[0]).error_bound + info_of(on[1]).error_bound;
    for (int64_t k = 0; k < 3 * c.n_triangles; ++k) {
      const double *p = c.xyz + 3 * c.vertex_id[k];
      if (!(closest_to(on[1 - i], p[0], p[1], p[2]).distance <= bound)) return 0;
    }
  }
  return 1;
}

TEST(opening_0_is_the_papers_state) {
  riis_valve *valve = new_valve("aortic"), *other = new_valve("aortic"), *given = new_valve("aortic");
  CHECK_OK(riis_valve_set_scalar(other, "open_radius_ratio", 0.9));
  CHECK_OK(riis_valve_set_scalar(other, "commissure_expansion", 0.3));
  CHECK_OK(riis_valve_set_open_state(given, valve)); /* both states are the paper's */
  assert_true(have_same_shape(valve, other));
  assert_true(have_same_shape(valve, given));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5));
  CHECK_OK(riis_valve_set_scalar(other, "opening", 0.5));
  assert_false(have_same_shape(valve, other));
}

/* The root radius and the heights affect both states. */
TEST(parameters_change_both_states) {
  static const char *const names[3] = {"root_radius", "leaflet_height", "bending_height"};
  for (int i = 0; i < 3; ++i)
    for (int opening = 0; opening <= 1; ++opening) {
      riis_valve *valve = valve_at("aortic", opening), *other = valve_at("aortic", opening);
      CHECK_OK(riis_valve_set_scalar(other, names[i], i == 0 ? 1.4 : i == 1 ? 1.1 : 0.6));
      const double area = info_of(new_surface(valve, NULL)).area, changed = info_of(new_surface(other, NULL)).area;
      assert_true(fabs(area - changed) > 0.01);
    }
}

TEST(a_given_open_state_wins) {
  riis_valve *valve = valve_at("aortic", 1), *open = new_valve("aortic");
  CHECK_OK(riis_valve_set_scalar(open, "leaflet_radius_in", 1.1));
  CHECK_OK(riis_valve_set_open_state(valve, open));
  assert_true(have_same_shape(valve, open));
  riis_surface *surface = new_surface(valve, NULL);
  CHECK_OK(riis_valve_set_scalar(valve, "open_radius_ratio", 0.9)); /* has no effect if a state is given */
  assert_true(is_same_content(surface, new_surface(valve, NULL)));
}

TEST(copies_and_moving_updates) {
  riis_valve *valve = valve_at("aortic", 0.75), *before = copy_of(valve);
  CHECK_OK(riis_valve_set_scalar(before, "opening", 0.5));
  riis_surface *surface = new_surface(valve, NULL), *moving = new_surface(valve, NULL);
  assert_true(is_same_content(surface, new_surface(copy_of(valve), NULL)));
  CHECK_OK(riis_surface_update_moving(moving, valve, before, 0.5, NULL, NULL));
  assert_true(is_same_content(surface, moving));
  /* While the opening goes from 0 to 1, the middle of the right cusp's free edge moves from 0.24 to 0.75 root radii. */
  const riis_triangles all = triangles_of(moving);
  const double *velocity = velocity_of(moving);
  int n = 0;
  for (int64_t i = 0; i < 3 * all.n_triangles; ++i) {
    const int64_t v = all.vertex_id[i];
    if (all.patch_id[i / 3] != 1 || all.uv[2 * v] != 0 || all.uv[2 * v + 1] != 1) continue;
    CHECK_NEAR(velocity[3 * v], (0.75 * 1.29 - 0.24) / 2, 1e-13);
    ++n;
  }
  assert_true(n > 0);
}

/* With fixed triangles, a vertex's velocity is its displacement divided by the time. A small difference occurs only on grid lines
 * that end between two vertices of a side, because such lines end on chords. */
TEST(fixed_triangulations) {
  const riis_surface_options options = fixed_options();
  riis_valve *valve = valve_at("aortic", 0.75), *before = valve_at("aortic", 0.5), *other = valve_at("aortic", 0.75);
  riis_surface *surface = new_surface(valve, &options), *then = new_surface(before, &options);
  CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.5, NULL, NULL));
  const riis_triangles a = triangles_of(surface), b = triangles_of(then);
  const double *velocity = velocity_of(surface);
  assert_int_equal(a.n_triangles, b.n_triangles);
  assert_memory_equal(a.vertex_id, b.vertex_id, (size_t)a.n_triangles * 3 * sizeof *a.vertex_id);
  for (int64_t i = 0; i < 3 * a.n_vertices; ++i) CHECK_NEAR(velocity[i], (a.xyz[i] - b.xyz[i]) / 0.5, 2e-3);
  CHECK_OK(riis_valve_set_scalar(other, "open_radius_ratio", 0.8));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "open_radius_ratio is 0.8|fixed for 0.75",
                riis_surface_update(surface, other, NULL));
  CHECK_OK(riis_valve_set_scalar(other, "open_radius_ratio", 0.75));
  CHECK_OK(riis_valve_set_open_state(other, before));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "has an open state|fixed for none", riis_surface_update(surface, other, NULL));
}

/* Absurd values of the open state are refused. At opening 0, a valve with absurd values of the open state nevertheless has a
 * surface. */
TEST(absurd_open_states_are_refused) {
  riis_valve *valve = new_valve("aortic");
  riis_surface *surface = NULL;
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'open_radius_ratio' is 2|from 0.05 to 1.5",
                riis_valve_set_scalar(valve, "open_radius_ratio", 2));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'open_radius_ratio' is 0;",
                riis_valve_set_scalar(valve, "open_radius_ratio", 0));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'commissure_expansion' is 0.6|from 0 to 0.5",
                riis_valve_set_scalar(valve, "commissure_expansion", 0.6));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'commissure_expansion' is nan",
                riis_valve_set_scalar(valve, "commissure_expansion", (double)NAN));
  CHECK_OK(riis_valve_set_scalar(valve, "commissure_expansion", 0.5));
  CHECK_OK(riis_valve_set_scalar(valve, "left.leaflet_radius_out", 5));
  new_surface(valve, NULL);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.01));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER,
                "in the open state, the left cusp's leaflet curve reaches 7.|commissure_expansion",
                riis_surface_create(valve, NULL, &surface));
  assert_null(surface);
  CHECK_OK(riis_valve_set_scalar(valve, "commissure_expansion", 0.1));
  new_surface(valve, NULL);
}

int main(void) { return run_cases(NULL, NULL); }
