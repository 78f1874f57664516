/* SPDX-License-Identifier: Apache-2.0 */
#include "internals.h"
#include "test_support.h"

TEST(parameter_is_the_share_of_the_length) {
  const double points[12] = {0, 0, 0, 3, 0, 0, 3, 1, 0, 3, 1, 6};
  double t[4], p[3];
  int64_t n;
  CHECK_NEAR(polyline_make(4, points, &n, t), 10, 0);
  assert_int_equal(n, 4);
  CHECK_NEAR(t[0], 0, 0);
  CHECK_NEAR(t[1], 0.3, 1e-16);
  CHECK_NEAR(t[2], 0.4, 1e-16);
  CHECK_NEAR(t[3], 1, 0);
  polyline_evaluate(4, points, 0.15, p);
  CHECK_NEAR(p[0], 1.5, 1e-15);
  polyline_evaluate(4, points, 0.7, p);
  CHECK_NEAR(p[0], 3, 0);
  CHECK_NEAR(p[1], 1, 0);
  CHECK_NEAR(p[2], 3, 1e-14);
}

TEST(ends_and_vertices_are_exact) {
  const double points[9] = {0.1, 0.2, 0.3, 1.7, -0.4, 0.9, -2.3, 0.6, 1.1};
  double t[3], p[3];
  int64_t n;
  polyline_make(3, points, &n, t);
  assert_int_equal(n, 3);
  for (int i = 0; i < 3; ++i) {
    polyline_evaluate(3, points, t[i], p);
    for (int c = 0; c < 3; ++c) CHECK_SAME(p[c], points[3 * i + c]);
  }
}

TEST(repeated_points_are_dropped) {
  const double points[15] = {0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 0, 0};
  double t[5];
  int64_t n;
  CHECK_NEAR(polyline_make(5, points, &n, t), 2, 0);
  assert_int_equal(n, 3);
  CHECK_NEAR(t[1], 0.5, 0);
}

TEST(a_point_is_a_polyline) {
  const double points[9] = {1, 2, 3, 1, 2, 3, 1, 2, 3};
  double t[3], p[3];
  int64_t n;
  CHECK_NEAR(polyline_make(3, points, &n, t), 0, 0);
  assert_int_equal(n, 1);
  for (int i = 0; i <= 4; ++i) {
    polyline_evaluate(3, points, i / 4.0, p);
    for (int c = 0; c < 3; ++c) CHECK_SAME(p[c], points[c]);
  }
}

int main(void) { return run_cases(NULL, NULL); }
