/* SPDX-License-Identifier: Apache-2.0
 * Tests the offset O(u) of patches made of arcs: its value, and the bound on its deviation from a linear function between two
 * values of u. */
#include "internals.h"
#include "test_support.h"

static random_source rng;

/* The base: half a circle of cubics in the plane z = 0, with radius 1, counter-clockwise. */
enum { n_base = 2 };
static const double k = 0.5522847498307933984;
static double base[12 * n_base];

static void make_base(void) {
  const double half[24] = {1, 0, 0, 1, k, 0, k, 1, 0, 0, 1, 0, 0, 1, 0, -k, 1, 0, -1, k, 0, -1, 0, 0};
  memcpy(base, half, sizeof base);
}

static double distance(const double *p, const double *q) { return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]); }

/* A cylinder hangs below a circle. For the cylinder, W = (0, 0, -2), and T is along the circle, so O = factor * 2 outwards. */
TEST(of_a_cylinder) {
  double edge[12 * n_base];
  memcpy(edge, base, sizeof edge);
  for (int i = 0; i < 4 * n_base; ++i) edge[3 * i + 2] = -2;
  for (double u = 0; u <= 1; u += 0.125) {
    double offset[3], on_base[3], tangent[3];
    bulge_at(n_base, base, n_base, edge, 0.25, u, offset);
    chain_at(n_base, base, u, on_base, tangent);
    CHECK_NEAR(offset[0], 0.5 * tangent[1], 1e-12);
    CHECK_NEAR(offset[1], -0.5 * tangent[0], 1e-12);
    CHECK_NEAR(offset[2], 0, 1e-12);
  }
  /* A negative factor reverses O. */
  double offset[3];
  bulge_at(n_base, base, n_base, edge, -0.25, 0.5, offset);
  CHECK_NEAR(offset[1], -0.5, 1e-12);
}

TEST(is_nothing_where_base_and_edge_touch) {
  const double point[12] = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0};
  double offset[3];
  bulge_at(n_base, base, 1, point, 0.25, 0, offset);
  for (int c = 0; c < 3; ++c) CHECK_NEAR(offset[c], 0, 0);
}

/* Edges have any shape, even single points, and bases have joints. Near some bases, W is parallel or nearly parallel to the base
 * in places. Units range from 1e-6 to 1e6. O never deviates from a linear function by more than the bound. If the edge is far
 * from the base, the bound on short ranges is not much too large. */
TEST(stays_within_the_bound) {
  double sum_of_ratios = 0, sum_without_points = 0;
  int n_ranges = 0, n_without_points = 0;
  for (int trial = 0; trial < 600; ++trial) {
    double edge[12], bent[12 * n_base];
    const double factor = random_between(&rng, -1, 1);
    const int is_near = trial >= 300;
    memcpy(bent, base, sizeof bent);
    /* The second span curves differently from the first span, and both leave the plane. */
    for (int i = 2; i < 8; ++i) {
      if (i < 5) continue;
      for (int c = 0; c < 3; ++c)
        bent[3 * i + c] += i == 5 ? (c == 0 ? random_between(&rng, -0.2, 0.2) : 0) : random_between(&rng, -0.4, 0.4);
    }
    for (int i = 0; i < 12; ++i) edge[i] = random_between(&rng, -0.7, 0.7) - (i % 3 == 2 ? 1 : 0);
    if (is_near) {
      const double off = random_power_of_ten(&rng, -8, 0);
      const int piece = (int)(random_bits(&rng) % n_base);
      for (int i = 0; i < 12; ++i) edge[i] = bent[12 * piece + i] + off * random_between(&rng, -1, 1);
    }
    if (trial % 5 == 0)
      for (int i = 3; i < 12; ++i) edge[i] = edge[i - 3];
    const double unit = random_power_of_ten(&rng, -6, 6);
    for (int i = 0; i < 12; ++i) edge[i] *= unit;
    for (int i = 0; i < 12 * n_base; ++i) bent[i] *= unit;
    const double du = pow(2, -1 - (double)(random_bits(&rng) % 5)), u0 = random_between(&rng, 0, 1 - du), u1 = u0 + du;
    const double bound = bulge_linear_error(n_base, bent, 1, edge, factor, u0, u1, trial % 2 ? 0 : INFINITY);
    double first[3], last[3], largest = 0;
    bulge_at(n_base, bent, 1, edge, factor, u0, first);
    bulge_at(n_base, bent, 1, edge, factor, u1, last);
    for (int i = 1; i < 100; ++i) {
      double offset[3], line[3];
      bulge_at(n_base, bent, 1, edge, factor, u0 + du * i / 100, offset);
      for (int c = 0; c < 3; ++c) line[c] = ((100 - i) * first[c] + i * last[c]) / 100;
      largest = fmax(largest, distance(offset, line));
    }
    if (!(largest <= bound + 1e-12 * unit))
      fail_msg("trial %d: O leaves its line by %.17g on %.3f .. %.3f, the bound is %.17g", trial, largest, u0, u1,
               bound);
    if (is_near) continue;
    if (trial % 2 && du < 0.1) sum_of_ratios += largest / bound, ++n_ranges;
    if (trial % 2 == 0 && du < 0.1) sum_without_points += largest / bound, ++n_without_points;
  }
  printf("%d short ranges: deviation over its bound %.2f on the average\n", n_ranges, sum_of_ratios / n_ranges);
  assert_true(sum_of_ratios > 0.5 * n_ranges);
  printf("%d more without points between: %.2f\n", n_without_points, sum_without_points / n_without_points);
  assert_true(sum_without_points > 0.13 * n_without_points); /* interval arithmetic gave less than 0.1 */
}

/* If W is parallel to T, O has no direction. The bound allows for any direction. */
TEST(has_no_direction_along_the_base) {
  const double straight[12] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}, ahead[12] = {5, 0, 0, 6, 0, 0, 7, 0, 0, 8, 0, 0};
  const double bound = bulge_linear_error(1, straight, 1, ahead, 0.5, 0.25, 0.5, 0);
  CHECK_AT_MOST(2 * 0.5 * 5 * 0.999, bound); /* twice the largest possible |O| */
}

int main(void) {
  make_base();
  rng = random_start("test_bulge");
  return run_cases(NULL, NULL);
}
