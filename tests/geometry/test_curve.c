/* SPDX-License-Identifier: Apache-2.0
 * Tests curves of several Bézier spans, and polylines. The fraction of the length gives a point. */
#include "internals.h"
#include "test_support.h"

static random_source rng;

enum { max_pieces = 5 };

/* Makes cubics that continue each other's direction. The cubics' speeds differ, and the curvature jumps between the cubics. */
static int64_t random_chain(double *control) {
  const int64_t n = 1 + (int64_t)(random_bits(&rng) % max_pieces);
  double at[3] = {0, 0, 0}, along[3] = {1, 0, 0};
  for (int64_t i = 0; i < n; ++i) {
    double *q = control + 12 * i;
    const double speed = random_between(&rng, 0.2, 0.6);
    for (int c = 0; c < 3; ++c) {
      q[c] = at[c];
      q[3 + c] = at[c] + speed * along[c];
      q[6 + c] = q[3 + c] + 0.5 * along[c] + 0.4 * random_between(&rng, -1, 1);
      q[9 + c] = q[6 + c] + 0.5 * along[c] + 0.4 * random_between(&rng, -1, 1);
      at[c] = q[9 + c];
    }
    const double step = hypot(hypot(q[9] - q[6], q[10] - q[7]), q[11] - q[8]);
    for (int c = 0; c < 3; ++c) along[c] = (q[9 + c] - q[6 + c]) / step;
  }
  return n;
}

static double distance(const double *p, const double *q) { return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]); }

/* The number of small steps along the whole chain. */
enum { n_steps = 20000 };
static double (*walk(int64_t n, const double *control, double *length))[3] {
  double(*points)[3] = malloc((n_steps * (size_t)n + 1) * sizeof *points);
  *length = 0;
  for (int64_t i = 0; i <= n * n_steps; ++i) {
    const int64_t piece = i == n * n_steps ? n - 1 : i / n_steps;
    bezier_evaluate(3, control + 12 * piece, (double)(i - piece * n_steps) / n_steps, points[i]);
    if (i > 0) *length += distance(points[i - 1], points[i]);
  }
  return points;
}

TEST(points_are_where_the_length_says) {
  for (int trial = 0; trial < 30; ++trial) {
    double control[12 * max_pieces], length, behind = 0;
    const int64_t n = random_chain(control);
    double(*points)[3] = walk(n, control, &length);
    CHECK_NEAR(chain_length(n, control), length, 1e-7);
    for (int64_t i = 1; i <= n * n_steps; ++i) {
      behind += distance(points[i - 1], points[i]);
      if (i % 1777 != 0) continue;
      double point[3], tangent[3], step[3];
      chain_at(n, control, behind / length, point, tangent);
      CHECK_AT_MOST(distance(point, points[i]), 1e-7);
      for (int c = 0; c < 3; ++c) step[c] = (points[i][c] - points[i - 1][c]) / distance(points[i - 1], points[i]);
      CHECK_AT_MOST(distance(tangent, step), 1e-3);
    }
    free(points);
    double first[3], last[3], tangent[3];
    chain_at(n, control, 0, first, tangent);
    chain_at(n, control, 1, last, tangent);
    for (int c = 0; c < 3; ++c) {
      CHECK_SAME(first[c], control[c]);
      CHECK_SAME(last[c], control[12 * n - 3 + c]);
    }
  }
}

TEST(parts_are_parts) {
  for (int trial = 0; trial < 100; ++trial) {
    double control[12 * max_pieces], part[12 * max_pieces], tangent[3];
    const int64_t n = random_chain(control);
    const double a = trial % 5 == 0 ? 0 : random_between(&rng, 0, 0.6),
                 b = trial % 7 == 0 ? 1 : random_between(&rng, 0.65, 1);
    const int reversed = trial % 2;
    const int64_t n_part = chain_between(n, control, a, b, reversed, part);
    CHECK_NEAR(chain_length(n_part, part), (b - a) * chain_length(n, control), 1e-11);
    for (int k = 0; k <= 10; ++k) {
      double of_part[3], of_whole[3];
      chain_at(n_part, part, k / 10.0, of_part, tangent);
      const double share = reversed ? 1 - k / 10.0 : k / 10.0;
      chain_at(n, control, a + share * (b - a), of_whole, tangent);
      CHECK_AT_MOST(distance(of_part, of_whole), 1e-10);
    }
  }
  /* If a cut is at a joint, the part contains nothing of the next span. */
  double control[12 * max_pieces], part[12 * max_pieces], first = 0;
  int64_t n = 0;
  while (n < 3) n = random_chain(control);
  first = chain_length(1, control) / chain_length(n, control);
  assert_int_equal(chain_between(n, control, 0, first, 0, part), 1);
  assert_int_equal(chain_between(n, control, first, 1, 0, part), n - 1);
}

/* At binary fractions of the length, the points lie on the curve, as for one span (test_bezier). Even across joints, each point
 * of a chord is within the bound of the curve's point at the same fraction. */
TEST(flattening_stays_within_its_bound) {
  double sum_of_ratios = 0;
  int64_t n_chords = 0;
  for (int trial = 0; trial < 30; ++trial) {
    double control[12 * max_pieces], *points, *t, *errors, tangent[3];
    const int64_t n = random_chain(control);
    const double max_error = pow(10, random_between(&rng, -3.5, -1));
    int64_t n_points;
    CHECK_OK(chain_flatten(n, control, max_error, &n_points, &points, &t, &errors));
    for (int64_t i = 0; i + 1 < n_points; ++i) {
      double on_curve[3], largest = 0;
      chain_at(n, control, t[i], on_curve, tangent);
      CHECK_AT_MOST(distance(on_curve, points + 3 * i), 1e-11);
      CHECK_SAME(t[i] * 0x1p20, floor(t[i] * 0x1p20));
      CHECK_AT_MOST(errors[i], max_error);
      for (int k = 1; k < 16; ++k) {
        double on_chord[3];
        chain_at(n, control, t[i] + (t[i + 1] - t[i]) * k / 16, on_curve, tangent);
        for (int c = 0; c < 3; ++c) on_chord[c] = ((16 - k) * points[3 * i + c] + k * points[3 * i + 3 + c]) / 16;
        largest = fmax(largest, distance(on_curve, on_chord));
      }
      CHECK_AT_MOST(largest, errors[i] + 1e-10);
      sum_of_ratios += errors[i] > 0 ? largest / errors[i] : 1;
      ++n_chords;
    }
    CHECK_SAME(t[n_points - 1], 1.0);
    free(points), free(t), free(errors);
  }
  printf("%lld chords: error over its bound %.2f on the average\n", (long long)n_chords,
         sum_of_ratios / (double)n_chords);
  assert_true(sum_of_ratios > 0.5 * (double)n_chords);
}

/* The cases below test polylines. */

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

int main(void) {
  rng = random_start("test_curve");
  return run_cases(NULL, NULL);
}
