/* SPDX-License-Identifier: Apache-2.0
 * The curves of the aortic valve pass through the points that the model gives. */
#include "internals.h"
#include "test_support.h"

static const double degree_in_radians = 3.14159265358979323846 / 180;

/* The positions of the curves of half a cusp, in the library's order. */
enum { root, symmetry_below, symmetry_above, bending, leaflet, sinus_below, sinus_above, n_of_cusp };

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

TEST(right_cusp_meets_the_table) {
  const double a_l = 61 * degree_in_radians, a_b = 47.3 * degree_in_radians;
  const double L[3] = {1.365 * cos(a_l), 1.365 * sin(a_l), 1.02}, B[3] = {1.39 * cos(a_b), 1.39 * sin(a_b), 0.71};
  check_point(control(0, root), 1.29, 0, 0);
  check_point(last(0, root), 1.29, 0, 0);
  check_point(control(0, leaflet), 0.24, 0, 1.02);
  check_point(last(0, leaflet), L[0], L[1], L[2]);
  check_point(control(0, bending), 0.4, 0, 0.71);
  check_point(last(0, bending), B[0], B[1], B[2]);
  check_point(control(0, symmetry_below), 1.29, 0, 0);
  check_point(last(0, symmetry_below), 0.4, 0, 0.71);
  check_point(last(0, symmetry_above), 0.24, 0, 1.02);
  check_point(control(0, sinus_below), 1.29, 0, 0);
  check_point(last(0, sinus_below), B[0], B[1], B[2]);
  check_point(last(0, sinus_above), L[0], L[1], L[2]);
  /* The tangents at the ends of the free edge: t0 (0, 1, 0), and t3 (p (L_x - r_li) / L_y, 1, 0). */
  const double *q = control(0, leaflet);
  check_point(q + 3, 0.24, 0.025, 1.02);
  check_point(q + 6, L[0] - 0.5 * 1.58 * (L[0] - 0.24) / L[1], L[1] - 0.5, 1.02);
}

/* The two parts of the symmetry curve are one cubic, which passes through b at s. xq and zq give the cubic's first inner control
 * point. */
TEST(symmetry_curve_is_one_cubic) {
  const double s = 0.71 / 1.02;
  const double *below = control(0, symmetry_below), *above = control(0, symmetry_above);
  /* After a split at s, the first part's second control point is (1-s) D0 + s D1. */
  double d1[3];
  for (int c = 0; c < 3; ++c) d1[c] = (below[3 + c] - (1 - s) * below[c]) / s;
  check_point(d1, (1.29 + 0.4) / 2 - 0.2 * (1.29 - 0.4), 0, 0.71 / 2 - 0.2 * 0.71);
  /* The joint is smooth. The tangents are parallel, and the ratio of their lengths is the ratio of the parameters. */
  for (int c = 0; c < 3; ++c) CHECK_NEAR((below[9 + c] - below[6 + c]) / s, (above[3 + c] - above[c]) / (1 - s), 1e-13);
  for (int i = 0; i < 4; ++i) assert_true(below[3 * i + 1] == 0 && above[3 * i + 1] == 0);
}

TEST(cusps_are_mirror_images_and_turned) {
  const double angle[3] = {0, 119.5, -121.5}, radius[3] = {0.24, 0.49, 0.2};
  for (int64_t image = 0; image < set.n_images; ++image) {
    const int cusp = set.leaflet_id[image];
    const double turn = angle[cusp] * degree_in_radians;
    double middle[3], end[3];
    /* The middle of each free edge points along the cusp's rotation. The middle has the same bits in both halves of a cusp. */
    patch_image_place(&set, image, control(cusp, leaflet), middle);
    check_point(middle, radius[cusp] * cos(turn), radius[cusp] * sin(turn), 0.02);
    for (int64_t other = 0; other < image; ++other)
      if (set.leaflet_id[other] == cusp) {
        double same[3];
        patch_image_place(&set, other, control(cusp, leaflet), same);
        for (int c = 0; c < 3; ++c) CHECK_NEAR(same[c], middle[c], 0);
      }
    /* The ends of the edge are at the leaflet's angle on either side of the middle. */
    static const double leaflet_angle[3] = {61, 58.5, 60.5}, leaflet_radius_out[3] = {1.365, 1.495, 1.38};
    patch_image_place(&set, image, last(cusp, leaflet), end);
    const double to = (angle[cusp] + (set.mirrored[image] ? -1 : 1) * leaflet_angle[cusp]) * degree_in_radians;
    check_point(end, leaflet_radius_out[cusp] * cos(to), leaflet_radius_out[cusp] * sin(to), 0.02);
  }
}

TEST(corners_meet_to_the_last_bit) {
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

TEST(twelve_patches_of_three_leaflets) {
  int seen[12] = {0};
  assert_int_equal(set.n_curves, 3 * n_of_cusp);
  assert_int_equal(set.n_patches, 6);
  assert_int_equal(set.n_images, 12);
  for (int64_t i = 0; i < set.n_images; ++i) {
    assert_true(set.patch_id[i] >= 0 && set.patch_id[i] < 12);
    ++seen[set.patch_id[i]];
    assert_int_equal(set.leaflet_id[i], set.patch_id[i] / 4);
    assert_int_equal(set.mirrored[i], set.patch_id[i] % 4 >= 2);
    assert_int_equal(set.patch[i], 2 * set.leaflet_id[i] + set.patch_id[i] % 2);
  }
  for (int i = 0; i < 12; ++i) assert_int_equal(seen[i], 1);
}

TEST(power_one_is_a_straight_profile) {
  patch_set straight;
  CHECK_OK(aortic_patches("right.leaflet_power", 1, &straight));
  const double *q = straight.control + 12 * leaflet;
  double out[3]; /* distance of the inner control points from the chord, in the curve's plane */
  const double dx = q[9] - q[0], dy = q[10] - q[1];
  for (int i = 1; i < 3; ++i) out[i] = (q[3 * i] - q[0]) * dy - (q[3 * i + 1] - q[1]) * dx;
  patch_set_free(&straight);
  CHECK_NEAR(out[1], 0, 1e-15);
  CHECK_NEAR(out[2], 0, 1e-15);
}

TEST(parameters_that_do_not_go_together_are_refused) {
  patch_set none;
#define IS_REFUSED(name, value, text) CHECK_REFUSED(RIIS_INVALID_PARAMETER, text, aortic_patches(name, value, &none))
  IS_REFUSED("bending_height", 1.02, "bending_height is 1.02|leaflet_height, which is 1.02");
  IS_REFUSED("bending_height", 0.0102, "bending_height is 0.0102");
  IS_REFUSED("leaflet_height", 0.7, "bending_height is 0.71|leaflet_height, which is 0.7");
  IS_REFUSED("right.leaflet_radius_out", 500, "right.leaflet_radius_out is 500|root_radius, which is 1.29");
  IS_REFUSED("right.leaflet_radius_out", 1e-9, "right.leaflet_radius_out is 1e-09|from 0.05");
  IS_REFUSED("leaflet_radius_in", 129, "right.leaflet_radius_in is 129");
  IS_REFUSED("root_radius", 200, "leaflet_height is 1.02|root_radius, which is 200");
  /* Each of the following values is valid alone, but absurd together with the other values. The message names the curve, its
   * extent and its parameters. */
  IS_REFUSED("leaflet_radius_in", 10, "right cusp's leaflet curve reaches 10|leaflet_angle|leaflet_radius_");
  IS_REFUSED("bending_height", 0.06, "right cusp's symmetry curve reaches|bending_height, leaflet_height, xq, zq");
  IS_REFUSED("non_coronary.bending_radius_out", 12, "non_coronary cusp's|reaches");
}

int main(void) {
  if (aortic_patches(NULL, 0, &set) != RIIS_OK) return 1;
  const int failed = run_cases(NULL, NULL);
  patch_set_free(&set);
  return failed;
}
