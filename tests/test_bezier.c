/* SPDX-License-Identifier: Apache-2.0 */
#include "internals.h"
#include "test_support.h"

static random_source rng;

static void random_control(double *control) {
  for (int i = 0; i < 12; ++i) control[i] = random_between(&rng, -2, 2);
}

/* The definition: sum of binomial (1-t)^(n-i) t^i Q_i. */
static void bernstein(int degree, const double *control, double t, double *point) {
  static const double binomial[4][4] = {{0}, {0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
  for (int c = 0; c < 3; ++c) {
    point[c] = 0;
    for (int i = 0; i <= degree; ++i)
      point[c] += binomial[degree][i] * pow(1 - t, degree - i) * pow(t, i) * control[3 * i + c];
  }
}

static double distance(const double *a, const double *b) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static void evaluates_the_bernstein_sum(void **state) {
  (void)state;
  for (int trial = 0; trial < 200; ++trial) {
    double control[12], got[3], expected[3];
    const int degree = 2 + trial % 2;
    const double t = random_between(&rng, 0, 1);
    random_control(control);
    bezier_evaluate(degree, control, t, got);
    bernstein(degree, control, t, expected);
    CHECK_AT_MOST(distance(got, expected), 1e-14);
    bezier_evaluate(degree, control, 0, got);
    for (int c = 0; c < 3; ++c) CHECK_SAME(got[c], control[c]);
    bezier_evaluate(degree, control, 1, got);
    for (int c = 0; c < 3; ++c) CHECK_SAME(got[c], control[3 * degree + c]);
  }
}

static void derivative_is_the_limit_of_differences(void **state) {
  (void)state;
  for (int trial = 0; trial < 200; ++trial) {
    double control[12], got[3], before[3], after[3];
    const int degree = 2 + trial % 2;
    const double t = random_between(&rng, 0.01, 0.99), h = 1e-5;
    random_control(control);
    bezier_derivative(degree, control, t, got);
    bernstein(degree, control, t - h, before);
    bernstein(degree, control, t + h, after);
    for (int c = 0; c < 3; ++c) CHECK_NEAR(got[c], (after[c] - before[c]) / (2 * h), 1e-7);
  }
}

static void arc_length_of_known_curves(void **state) {
  (void)state;
  const double line[12] = {0, 0, 0, 1, 2, 2, 2, 4, 4, 3, 6, 6};
  CHECK_NEAR(bezier_arc_length(3, line, 0, 1), 9, 1e-12);
  CHECK_NEAR(bezier_arc_length(3, line, 0.25, 0.75), 4.5, 1e-12);
  /* y = x^2 on [0,1]: (2 sqrt 5 + asinh 2) / 4. */
  const double parabola[9] = {0, 0, 0, 0.5, 0, 0, 1, 1, 0};
  CHECK_NEAR(bezier_arc_length(2, parabola, 0, 1), (2 * sqrt(5.0) + asinh(2.0)) / 4, 1e-12);
  /* There and back: speed is zero at the turning point, length twice the reach. */
  const double there_and_back[9] = {0, 0, 0, 1, 0, 0, 0, 0, 0};
  CHECK_NEAR(bezier_arc_length(2, there_and_back, 0, 1), 1, 1e-11);
  const double point[9] = {1, 2, 3, 1, 2, 3, 1, 2, 3};
  CHECK_NEAR(bezier_arc_length(2, point, 0, 1), 0, 0);
}

static void arc_length_is_the_limit_of_chords(void **state) {
  (void)state;
  for (int trial = 0; trial < 20; ++trial) {
    double control[12], previous[3], next[3], sum[2] = {0, 0};
    random_control(control);
    for (int fine = 0; fine < 2; ++fine) {
      const int n = 20000 << fine;
      bernstein(3, control, 0, previous);
      for (int i = 1; i <= n; ++i) {
        bernstein(3, control, (double)i / n, next);
        sum[fine] += distance(previous, next);
        memcpy(previous, next, sizeof next);
      }
    }
    /* Chords err by h^2: extrapolated. */
    const double expected = sum[1] + (sum[1] - sum[0]) / 3;
    CHECK_NEAR(bezier_arc_length(3, control, 0, 1), expected, 1e-9 * expected);
    CHECK_NEAR(bezier_arc_length(3, control, 0, 0.3) + bezier_arc_length(3, control, 0.3, 1), expected,
               1e-9 * expected);
  }
}

static void split_gives_the_same_curve_in_two(void **state) {
  (void)state;
  for (int trial = 0; trial < 100; ++trial) {
    double control[12], left[12], right[12], got[3], expected[3];
    const int degree = 2 + trial % 2;
    const double t = random_between(&rng, 0, 1), s = random_between(&rng, 0, 1);
    random_control(control);
    bezier_split(degree, control, t, left, right);
    bezier_evaluate(degree, left, s, got);
    bernstein(degree, control, s * t, expected);
    CHECK_AT_MOST(distance(got, expected), 1e-14);
    bezier_evaluate(degree, right, s, got);
    bernstein(degree, control, t + s * (1 - t), expected);
    CHECK_AT_MOST(distance(got, expected), 1e-14);
    for (int c = 0; c < 3; ++c) CHECK_SAME(left[3 * degree + c], right[c]);
  }
}

static void flatness_is_measured_to_the_segment(void **state) {
  (void)state;
  const double beyond_the_end[9] = {0, 0, 0, 3, 0, 0, 1, 0, 0}; /* on the line, 2 beyond the segment */
  CHECK_NEAR(bezier_flatness(2, beyond_the_end), 2, 1e-15);
  const double closed[12] = {0, 0, 0, 0, 3, 0, 4, 0, 0, 0, 0, 0}; /* 0/0 in the paper's formula */
  CHECK_NEAR(bezier_flatness(3, closed), 4, 1e-15);
  const double arch[12] = {0, 0, 0, 1, 1, 0, 2, -2, 0, 3, 0, 0};
  CHECK_NEAR(bezier_flatness(3, arch), 2, 1e-15);
}

/* Distance of a point to the nearest chord. */
static double to_chords(const double *p, int64_t n, const double *points) {
  double smallest = INFINITY;
  for (int64_t i = 0; i + 1 < n; ++i) {
    const double *a = points + 3 * i, *b = a + 3;
    double ab[3], ap[3], q[3], t;
    for (int c = 0; c < 3; ++c) ab[c] = b[c] - a[c], ap[c] = p[c] - a[c];
    t = (ab[0] * ap[0] + ab[1] * ap[1] + ab[2] * ap[2]) / (ab[0] * ab[0] + ab[1] * ab[1] + ab[2] * ab[2]);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    for (int c = 0; c < 3; ++c) q[c] = a[c] + t * ab[c];
    smallest = fmin(smallest, distance(p, q));
  }
  return smallest;
}

static void flattening_stays_within_its_bound(void **state) {
  (void)state;
  for (int trial = 0; trial < 60; ++trial) {
    double control[12], point[3], *points, largest = 0;
    int64_t n;
    const int degree = 2 + trial % 2;
    const double phi = pow(10, random_between(&rng, -4, -1)), bound = (degree == 2 ? 0.5 : 0.75) * phi;
    random_control(control);
    if (trial % 10 == 0) memcpy(control + 3 * degree, control, 3 * sizeof *control); /* closed */
    CHECK_OK(bezier_flatten(degree, control, phi, &n, &points));
    assert_true(n >= 2);
    for (int c = 0; c < 3; ++c) {
      CHECK_SAME(points[c], control[c]);
      CHECK_SAME(points[3 * (n - 1) + c], control[3 * degree + c]);
    }
    for (int i = 0; i <= 1000; ++i) {
      bernstein(degree, control, i / 1000.0, point);
      largest = fmax(largest, to_chords(point, n, points));
    }
    for (int64_t i = 1; i < n; ++i)
      assert_true(distance(points + 3 * i, points + 3 * i - 3) > 0); /* shared middles once */
    free(points);
    CHECK_AT_MOST(largest, bound);
  }
}

static void flattening_takes_few_points(void **state) {
  (void)state;
  /* A parabola's flatness is 1/4 of its control triangle's height, falling by 4 a halving: height 1, phi 1/60 -> 3
   * halvings. */
  const double parabola[9] = {0, 0, 0, 1, 1, 0, 2, 0, 0};
  double *points;
  int64_t n;
  CHECK_OK(bezier_flatten(2, parabola, 1.0 / 60, &n, &points));
  free(points);
  assert_int_equal(n, 9);
  CHECK_OK(bezier_flatten(2, parabola, 1.0, &n, &points));
  free(points);
  assert_int_equal(n, 2);
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "1048576|tolerance", bezier_flatten(2, parabola, 1e-14, &n, &points));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(evaluates_the_bernstein_sum),       cmocka_unit_test(derivative_is_the_limit_of_differences),
      cmocka_unit_test(arc_length_of_known_curves),        cmocka_unit_test(arc_length_is_the_limit_of_chords),
      cmocka_unit_test(split_gives_the_same_curve_in_two), cmocka_unit_test(flatness_is_measured_to_the_segment),
      cmocka_unit_test(flattening_stays_within_its_bound), cmocka_unit_test(flattening_takes_few_points),
  };
  rng = random_start("test_bezier");
  return cmocka_run_group_tests(tests, NULL, NULL);
}
