/* SPDX-License-Identifier: Apache-2.0
 * Tests the points of known distance that ./run bench accuracy uses. One surface is a parabolic cylinder, and one has two
 * parallel sheets: their distances are known in closed form. The benchmark's leaflets are also tested. */
#include "accuracy.h"
#include "test_support.h"

enum { n_points = 600 };
static const double half = 0.1; /* half thickness */

/* Returns n patches, each with four separate curves. The arrays are borrowed. */
static riis_patches sheets(int64_t n, const int32_t *degree, const double *control, const int32_t *curve_id) {
  riis_patches patches;
  CHECK_OK(riis_patches_init(&patches, sizeof patches));
  patches.n_curves = 4 * n;
  patches.degree = degree;
  patches.control = control;
  patches.n_patches = n;
  patches.curve_id = curve_id;
  return patches;
}

/* The parabolic cylinder z = x^2 / (4 focal), |x| <= 2 focal, 0 <= y <= 1. Curves of degree 2 represent a parabolic cylinder
 * exactly. */
static const double focal = 0.05;

static riis_patches parabola(void) {
  static const int32_t degree[4] = {2, 2, 1, 1}, curve_id[4] = {0, 1, 2, 3};
  static double control[30];
  const double x = 2 * focal, z = focal;
  const double points[10][3] = {{-x, 0, z}, {0, 0, -z}, {x, 0, z},  {-x, 1, z}, {0, 1, -z},
                                {x, 1, z},  {-x, 0, z}, {-x, 1, z}, {x, 0, z},  {x, 1, z}};
  memcpy(control, points, sizeof control);
  return sheets(1, degree, control, curve_id);
}

/* Returns the distance from (x, z) to the parabola. Newton's method starts from every local minimum among many points of the
 * parabola. The nearest of many points alone does not suffice, because it may be far from the true nearest point. */
static double distance_to_parabola(double x, double z) {
  enum { n = 2000 };
  double at[n + 1], best = INFINITY;
  for (int i = 0; i <= n; ++i) {
    const double t = 2 * focal * (2.0 * i / n - 1);
    at[i] = hypot(t - x, t * t / (4 * focal) - z);
  }
  for (int i = 0; i <= n; ++i) {
    if ((i > 0 && at[i - 1] < at[i]) || (i < n && at[i + 1] < at[i])) continue;
    double t = 2 * focal * (2.0 * i / n - 1);
    for (int step = 0; step < 20; ++step) {
      const double height = t * t / (4 * focal) - z, slope = t / (2 * focal);
      const double derivative = t - x + height * slope, second = 1 + slope * slope + height / (2 * focal);
      t = fmin(fmax(t - derivative / second, -2 * focal), 2 * focal);
    }
    best = fmin(best, fmin(at[i], hypot(t - x, t * t / (4 * focal) - z)));
  }
  return best;
}

static double curvature_of_parabola(double x) { return 1 / (2 * focal) / pow(1 + x * x / (4 * focal * focal), 1.5); }

TEST(points_normals_and_curvatures_of_a_parabola) {
  const riis_patches patches = parabola();
  random_source rng = random_start("test_accuracy");
  for (int trial = 0; trial < 100; ++trial) {
    double p[3], normal[3], curvature;
    assert_int_equal(smooth_point(&patches, random_between(&rng, 0.001, 0.999), random_between(&rng, 0.001, 0.999), p,
                                  normal, &curvature),
                     0);
    const double slope = p[0] / (2 * focal), size = hypot(1, slope);
    CHECK_NEAR(p[2], p[0] * p[0] / (4 * focal), 1e-12);
    CHECK_NEAR(normal[0], -slope / size, 1e-6);
    CHECK_NEAR(normal[1], 0, 1e-6);
    CHECK_NEAR(normal[2], 1 / size, 1e-6);
    CHECK_NEAR(curvature / curvature_of_parabola(p[0]), 1, 1e-3);
  }
}

TEST(distances_to_a_parabola_are_true) {
  const riis_patches patches = parabola();
  random_source rng = random_start("test_accuracy");
  const uint64_t seed = random_bits(&rng);
  known_truth truth;
  assert_int_equal(truth_of(&patches, NULL, n_points, seed, 1e-3, &truth), 0);
  assert_int_equal(truth.on.n, n_points);
  assert_int_equal(truth.off.n + truth.n_curved + truth.n_nearer, n_points);
  assert_true(truth.most_from_fine > 0 && truth.most_from_fine <= 1e-3);
  int64_t n_curved = 0;
  for (int64_t i = 0; i < truth.on.n; ++i) {
    const double *p = truth.on.xyz + 3 * i;
    CHECK_SAME(truth.on.distance[i], 0);
    CHECK_NEAR(p[2], p[0] * p[0] / (4 * focal), 1e-12);
    const double share = fabs(truth_offset(i)) * half * curvature_of_parabola(p[0]);
    n_curved += share > truth_largest_share_of_radius() * (1 + 1e-3);
  }
  assert_true(n_curved > n_points / 20); /* points at offset 1 near the vertex, where the radius of curvature is 0.1 */
  assert_true(truth.n_curved >= n_curved && truth.n_curved < n_curved + n_points / 20);
  for (int64_t i = 0; i < truth.off.n; ++i) {
    const double *p = truth.off.xyz + 3 * i;
    CHECK_NEAR(distance_to_parabola(p[0], p[2]), truth.off.distance[i], 1e-9);
  }
  truth_free(&truth);
}

/* Two unit squares lie at z = 0 and z = 0.15. A point may lie one half thickness from one square and be nearer to the other
 * square. */
TEST(points_nearer_to_another_sheet_are_left_out) {
  static const double gap = 0.15;
  int32_t degree[8], curve_id[8];
  double control[48], *at = control;
  for (int sheet = 0; sheet < 2; ++sheet)
    for (int side = 0; side < 4; ++side) {
      static const double ends[4][4] = {{0, 0, 1, 0}, {0, 1, 1, 1}, {0, 0, 0, 1}, {1, 0, 1, 1}};
      degree[4 * sheet + side] = 1;
      curve_id[4 * sheet + side] = 4 * sheet + side;
      for (int end = 0; end < 2; ++end) {
        *at++ = ends[side][2 * end];
        *at++ = ends[side][2 * end + 1];
        *at++ = sheet * gap;
      }
    }
  const riis_patches patches = sheets(2, degree, control, curve_id);
  random_source rng = random_start("test_accuracy");
  const uint64_t seed = random_bits(&rng);
  known_truth truth;
  assert_int_equal(truth_of(&patches, NULL, n_points, seed, 1e-3, &truth), 0);
  int64_t n_nearer = 0, n_upper = 0;
  for (int64_t i = 0; i < truth.on.n; ++i) {
    const int is_upper = truth.on.xyz[3 * i + 2] > 0.5 * gap;
    CHECK_NEAR(truth.on.xyz[3 * i + 2], is_upper * gap, 1e-15);
    n_nearer += truth_offset(i) == (is_upper ? -1 : 1);
    n_upper += is_upper;
  }
  assert_true((double)llabs(n_upper - n_points / 2) < 6 * sqrt(n_points) / 2);
  assert_int_equal(truth.n_curved, 0);
  assert_int_equal(truth.n_nearer, n_nearer);
  assert_int_equal(truth.off.n, n_points - n_nearer);
  for (int64_t i = 0; i < truth.off.n; ++i) {
    const double z = truth.off.xyz[3 * i + 2];
    CHECK_NEAR(fmin(fabs(z), fabs(z - gap)), truth.off.distance[i], 1e-12);
  }
  truth_free(&truth);
}

/* The smooth leaflets agree with their triangles: otherwise truth_of would fail. */
TEST(leaflets_agree_with_their_triangles) {
  static const char *const kinds[2] = {"aortic", "mitral"};
  for (int i = 0; i < 2; ++i) {
    known_truth truth;
    assert_int_equal(truth_of(NULL, kinds[i], n_points, 1, 2e-3, &truth), 0);
    assert_int_equal(truth.on.n, n_points);
    assert_int_equal(truth.off.n + truth.n_curved + truth.n_nearer, n_points);
    assert_true(truth.off.n > n_points * 9 / 10);
    assert_true(truth.most_from_fine > 0 && truth.most_from_fine <= 2e-3);
    truth_free(&truth);
  }
}

int main(void) { return run_cases(NULL, NULL); }
