/* SPDX-License-Identifier: Apache-2.0
 * The curves of the aortic valve: what the model says each must pass through. */
#include "internals.h"
#include "test_support.h"

static const double degree_in_radians = 3.14159265358979323846 / 180;

/* Positions of the curves of one cusp, in the order in which they are made. */
enum {
  root,
  symmetry_below,
  symmetry_above,
  bending,
  leaflet,
  sinus_below,
  sinus_above,
  bending_m,
  leaflet_m,
  sinus_below_m,
  sinus_above_m,
  n_of_cusp
};

static patch_set set;

static const double *control(int cusp, int curve) { return set.control + 12 * (n_of_cusp * cusp + curve); }
static const double *last(int cusp, int curve) {
  return control(cusp, curve) + 3 * set.degree[n_of_cusp * cusp + curve];
}

static void check_point(const double *p, double x, double y, double z) {
  CHECK_NEAR(p[0], x, 1e-14);
  CHECK_NEAR(p[1], y, 1e-14);
  CHECK_NEAR(p[2], z, 1e-14);
}

/* The right cusp stands in its own frame, but for the translation by -1. */
static void right_cusp_meets_the_table(void **state) {
  (void)state;
  const double a_l = 61 * degree_in_radians, a_b = 47.3 * degree_in_radians;
  const double L[3] = {1.365 * cos(a_l), 1.365 * sin(a_l), 0.02}, B[3] = {1.39 * cos(a_b), 1.39 * sin(a_b), 0.71 - 1};
  check_point(control(0, root), 1.29, 0, -1);
  check_point(control(0, leaflet), 0.24, 0, 0.02);
  check_point(last(0, leaflet), L[0], L[1], L[2]);
  check_point(control(0, bending), 0.4, 0, -0.29);
  check_point(last(0, bending), B[0], B[1], B[2]);
  check_point(control(0, symmetry_below), 1.29, 0, -1);
  check_point(last(0, symmetry_below), 0.4, 0, -0.29);
  check_point(last(0, symmetry_above), 0.24, 0, 0.02);
  check_point(last(0, sinus_below), B[0], B[1], B[2]);
  check_point(last(0, sinus_above), L[0], L[1], L[2]);
  /* Tangents of the free edge: t0 (0, 1, 0), and t3 (p (L_x - r_li) / L_y, 1, 0). */
  const double *q = control(0, leaflet);
  check_point(q + 3, 0.24, 0.025, 0.02);
  check_point(q + 6, L[0] - 0.5 * 1.58 * (L[0] - 0.24) / L[1], L[1] - 0.5, 0.02);
}

/* The two pieces of the symmetry curve are one cubic with the first inner control point where xq and zq say, through b
 * at s. */
static void symmetry_curve_is_one_cubic(void **state) {
  (void)state;
  const double s = 0.71 / 1.02;
  const double *below = control(0, symmetry_below), *above = control(0, symmetry_above);
  /* Splitting at s leaves (1-s) D0 + s D1 as the first part's second control point. */
  double d1[3];
  for (int c = 0; c < 3; ++c) d1[c] = (below[3 + c] - (1 - s) * below[c]) / s;
  check_point(d1, (1.29 + 0.4) / 2 - 0.2 * (1.29 - 0.4), 0, 0.71 / 2 - 0.2 * 0.71 - 1);
  /* Smooth there: the tangents are parallel, in the ratio of the parameters. */
  for (int c = 0; c < 3; ++c) CHECK_NEAR((below[9 + c] - below[6 + c]) / s, (above[3 + c] - above[c]) / (1 - s), 1e-13);
  for (int i = 0; i < 4; ++i) assert_true(below[3 * i + 1] == 0 && above[3 * i + 1] == 0);
}

static void cusps_are_mirror_images_and_turned(void **state) {
  (void)state;
  for (int i = 0; i < 4; ++i) {
    const double *half = control(0, leaflet) + 3 * i, *mirrored = control(0, leaflet_m) + 3 * i;
    CHECK_SAME(half[0], mirrored[0]);
    CHECK_SAME(half[1] + mirrored[1], 0.0);
    CHECK_SAME(half[2], mirrored[2]);
  }
  /* The middle of each free edge points along the cusp's rotation. */
  const double angle[3] = {0, 119.5, -121.5}, radius[3] = {0.24, 0.49, 0.2};
  for (int cusp = 0; cusp < 3; ++cusp)
    check_point(control(cusp, leaflet), radius[cusp] * cos(angle[cusp] * degree_in_radians),
                radius[cusp] * sin(angle[cusp] * degree_in_radians), 0.02);
  /* Cusps meet at the commissures in angle: right at 61, left from 119.5 - 58.5 = 61, ... */
  const double *right_end = last(0, leaflet), *left_end = last(1, leaflet_m);
  CHECK_NEAR(atan2(right_end[1], right_end[0]), atan2(left_end[1], left_end[0]), 1e-13);
}

static void corners_meet_to_the_last_bit(void **state) {
  (void)state;
  for (int64_t i = 0; i < set.n_patches; ++i) {
    const int64_t *side = set.sides + 4 * i;
    const double *ends[4][2];
    for (int k = 0; k < 4; ++k)
      ends[k][0] = set.control + 12 * side[k], ends[k][1] = ends[k][0] + 3 * set.degree[side[k]];
    /* v0(0) = u0(0), v0(1) = u1(0), v1(0) = u0(1), v1(1) = u1(1) */
    for (int c = 0; c < 3; ++c) {
      CHECK_NEAR(ends[0][0][c], ends[2][0][c], 0);
      CHECK_NEAR(ends[0][1][c], ends[3][0][c], 0);
      CHECK_NEAR(ends[1][0][c], ends[2][1][c], 0);
      CHECK_NEAR(ends[1][1][c], ends[3][1][c], 0);
    }
  }
}

static void twelve_patches_of_three_leaflets(void **state) {
  (void)state;
  assert_int_equal(set.n_curves, 3 * n_of_cusp);
  assert_int_equal(set.n_patches, 12);
  for (int i = 0; i < 12; ++i) {
    assert_int_equal(set.leaflet_id[i], i / 4);
    assert_int_equal(set.flip[i], i % 4 >= 2);
  }
}

static void power_one_is_a_straight_profile(void **state) {
  (void)state;
  patch_set straight;
  CHECK_OK(aortic_patches("right.leaflet_power", 1, &straight));
  const double *q = straight.control + 12 * leaflet;
  double out[3]; /* distance of the inner control points from the chord in the plane */
  const double dx = q[9] - q[0], dy = q[10] - q[1];
  for (int i = 1; i < 3; ++i) out[i] = (q[3 * i] - q[0]) * dy - (q[3 * i + 1] - q[1]) * dx;
  patch_set_free(&straight);
  CHECK_NEAR(out[1], 0, 1e-15);
  CHECK_NEAR(out[2], 0, 1e-15);
}

static void parameters_that_do_not_go_together_are_refused(void **state) {
  (void)state;
  patch_set none;
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "bending_height is 1.02|leaflet_height",
                aortic_patches("bending_height", 1.02, &none));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "bending_height is 0.71|leaflet_height, which is 0.7",
                aortic_patches("leaflet_height", 0.7, &none));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "right.leaflet_radius_out is 500|root_radius",
                aortic_patches("right.leaflet_radius_out", 500, &none));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "leaflet_height is 1.02|root_radius, which is 200",
                aortic_patches("root_radius", 200, &none));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(right_cusp_meets_the_table),
      cmocka_unit_test(symmetry_curve_is_one_cubic),
      cmocka_unit_test(cusps_are_mirror_images_and_turned),
      cmocka_unit_test(corners_meet_to_the_last_bit),
      cmocka_unit_test(twelve_patches_of_three_leaflets),
      cmocka_unit_test(power_one_is_a_straight_profile),
      cmocka_unit_test(parameters_that_do_not_go_together_are_refused),
  };
  if (aortic_patches(NULL, 0, &set) != RIIS_OK) return 1;
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  patch_set_free(&set);
  return failed;
}
