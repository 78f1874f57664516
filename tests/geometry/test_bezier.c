/* SPDX-License-Identifier: Apache-2.0 */
#include "internals.h"
#include "test_support.h"

static random_source rng;

static void random_control(double *control) {
  for (int i = 0; i < 12; ++i) control[i] = random_between(&rng, -2, 2);
}

/* Evaluates the definition of a Bézier curve: the sum of binomial (1-t)^(n-i) t^i Q_i. */
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

TEST(evaluates_the_bernstein_sum) {
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

TEST(derivative_is_the_limit_of_differences) {
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

TEST(arc_length_of_known_curves) {
  const double line[12] = {0, 0, 0, 1, 2, 2, 2, 4, 4, 3, 6, 6};
  CHECK_NEAR(bezier_arc_length(3, line, 0, 1), 9, 1e-12);
  CHECK_NEAR(bezier_arc_length(3, line, 0.25, 0.75), 4.5, 1e-12);
  /* The length of y = x^2 on [0,1] is (2 sqrt 5 + asinh 2) / 4. */
  const double parabola[9] = {0, 0, 0, 0.5, 0, 0, 1, 1, 0};
  CHECK_NEAR(bezier_arc_length(2, parabola, 0, 1), (2 * sqrt(5.0) + asinh(2.0)) / 4, 1e-12);
  /* A curve goes out and back on a line. At the turning point the speed is zero, so the length is twice the distance to this
   * point. */
  const double there_and_back[9] = {0, 0, 0, 1, 0, 0, 0, 0, 0};
  CHECK_NEAR(bezier_arc_length(2, there_and_back, 0, 1), 1, 1e-11);
  const double point[9] = {1, 2, 3, 1, 2, 3, 1, 2, 3};
  CHECK_NEAR(bezier_arc_length(2, point, 0, 1), 0, 0);
}

TEST(arc_length_is_the_limit_of_chords) {
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
    /* The error of chords is proportional to h^2, so extrapolation removes it. */
    const double expected = sum[1] + (sum[1] - sum[0]) / 3;
    CHECK_NEAR(bezier_arc_length(3, control, 0, 1), expected, 1e-9 * expected);
    CHECK_NEAR(bezier_arc_length(3, control, 0, 0.3) + bezier_arc_length(3, control, 0.3, 1), expected,
               1e-9 * expected);
  }
}

TEST(split_gives_the_same_curve_in_two) {
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

TEST(flatness_is_measured_to_the_segment) {
  const double beyond_the_end[9] = {0, 0, 0, 3, 0, 0, 1, 0, 0}; /* the inner point is 2 beyond the segment */
  CHECK_NEAR(bezier_flatness(2, beyond_the_end), 2, 1e-15);
  const double closed[12] = {0, 0, 0, 0, 3, 0, 4, 0, 0, 0, 0, 0}; /* the paper's formula gives 0/0 here */
  CHECK_NEAR(bezier_flatness(3, closed), 4, 1e-15);
  const double arch[12] = {0, 0, 0, 1, 1, 0, 2, -2, 0, 3, 0, 0};
  CHECK_NEAR(bezier_flatness(3, arch), 2, 1e-15);
}

/* Compares every point of the curve with the point of its chord at the same fraction of the length. The promised bound holds for
 * every part, and on average it is not much too large. The parts begin and end at binary fractions of the length. */
TEST(flattening_stays_within_its_bound) {
  double sum_of_ratios = 0;
  int64_t n_pieces = 0;
  for (int trial = 0; trial < 60; ++trial) {
    double control[12], *points, *t, *errors;
    int64_t n;
    int piece = 0;
    const int degree = 2 + trial % 2;
    const double max_error = pow(10, random_between(&rng, -4, -1));
    random_control(control);
    if (trial % 10 == 0) memcpy(control + 3 * degree, control, 3 * sizeof *control); /* a closed curve */
    CHECK_OK(bezier_flatten(degree, control, max_error, &n, &points, &t, &errors));
    assert_true(n >= 2);
    for (int c = 0; c < 3; ++c) {
      CHECK_SAME(points[c], control[c]);
      CHECK_SAME(points[3 * (n - 1) + c], control[3 * degree + c]);
    }
    /* Walks along the curve in small steps. */
    enum { n_steps = 100000 };
    const double whole = bezier_arc_length(degree, control, 0, 1);
    double previous[3], next[3], at = 0, largest = 0;
    memcpy(previous, control, sizeof previous);
    for (int i = 1; i <= n_steps; ++i) {
      bernstein(degree, control, (double)i / n_steps, next);
      at += distance(previous, next) / whole;
      memcpy(previous, next, sizeof next);
      while (piece < n - 2 && at > t[piece + 1]) {
        CHECK_AT_MOST(largest, errors[piece] + 1e-7);
        if (errors[piece] > 1e-5) sum_of_ratios += largest / errors[piece], ++n_pieces;
        ++piece;
        largest = 0;
      }
      double on_chord[3];
      const double share = fmin((at - t[piece]) / (t[piece + 1] - t[piece]), 1);
      for (int c = 0; c < 3; ++c) on_chord[c] = (1 - share) * points[3 * piece + c] + share * points[3 * piece + 3 + c];
      largest = fmax(largest, distance(next, on_chord));
    }
    assert_int_equal(piece, n - 2);
    CHECK_AT_MOST(largest, errors[piece] + 1e-7);
    CHECK_SAME(t[0], 0.0);
    CHECK_SAME(t[n - 1], 1.0);
    for (int64_t i = 0; i + 1 < n; ++i) {
      assert_true(t[i + 1] > t[i]); /* a shared point appears once */
      CHECK_AT_MOST(errors[i], max_error);
      CHECK_SAME(t[i] * 0x1p20, floor(t[i] * 0x1p20));
    }
    free(points), free(t), free(errors);
  }
  printf("%lld pieces: error over its bound %.2f on the average\n", (long long)n_pieces,
         sum_of_ratios / (double)n_pieces);
  assert_true(sum_of_ratios > 0.5 * (double)n_pieces);
}

static int64_t n_flattened(int degree, const double *control, double max_error) {
  double *points, *t, *errors;
  int64_t n;
  CHECK_OK(bezier_flatten(degree, control, max_error, &n, &points, &t, &errors));
  free(points), free(t), free(errors);
  return n;
}

TEST(flattening_takes_few_points) {
  const double line[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, point[9] = {1, 2, 3, 1, 2, 3, 1, 2, 3};
  assert_int_equal(n_flattened(2, line, 1e-9), 2);
  assert_int_equal(n_flattened(2, point, 1e-9), 1);
  /* A quarter of a unit circle. If the arc is cut into n equal parts, the error is (pi / (2 n))^2 / 8. Curves are halved again
   * and again, so n is the next power of two. */
  const double k = 0.5522847498, quarter[12] = {1, 0, 0, 1, k, 0, k, 1, 0, 0, 1, 0};
  assert_int_equal(n_flattened(3, quarter, 0.0055), 9);
  assert_int_equal(n_flattened(3, quarter, 0.0014), 17);
  /* A curve may reverse its direction at a point, where its curvature gives no bound. */
  const double there_and_back[9] = {0, 0, 0, 1, 0, 0, 0, 0, 0};
  assert_true(n_flattened(2, there_and_back, 1e-3) < 100);
  double *points, *t, *errors;
  int64_t n;
  const double parabola[9] = {0, 0, 0, 1, 1, 0, 2, 0, 0};
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "1048576|tolerance", bezier_flatten(2, parabola, 1e-14, &n, &points, &t, &errors));
}

int main(void) {
  rng = random_start("test_bezier");
  return run_cases(NULL, NULL);
}
