/* SPDX-License-Identifier: Apache-2.0
 * Compares the library's test of whether a segment meets a triangle with exact integer arithmetic. Segments are in general
 * position, pass through corners or sides, miss them by less than doubles can resolve, or lie in the triangle's plane. Units
 * vary. */
#include "crossing_oracle.h"
#include "internals.h"
#include "test_support.h"

static random_source rng;

static int64_t whole(int64_t largest) { return (int64_t)(random_bits(&rng) % (uint64_t)(2 * largest + 1)) - largest; }

typedef struct {
  int64_t a[3], b[3], abc[9];
} sample;

/* Returns the answer of the library for one order of ends and corners. Coordinates are in units of 2^exponent. */
static int answer(const sample *s, int exponent, int swapped, int turned) {
  double a[3], b[3], abc[9];
  for (int i = 0; i < 3; ++i) {
    a[i] = ldexp((double)s->a[i], exponent);
    b[i] = ldexp((double)s->b[i], exponent);
    for (int k = 0; k < 3; ++k) {
      const int from = turned < 3 ? (k + turned) % 3 : (turned - k) % 3;
      abc[3 * k + i] = ldexp((double)s->abc[3 * from + i], exponent);
    }
  }
  return swapped ? segment_triangle_meet(b, a, abc) : segment_triangle_meet(a, b, abc);
}

/* Checks that the library gives the oracle's answer for every order of ends and corners. */
static int check(const sample *s, int exponent) {
  const int expected = oracle_segment_meets_triangle(s->a, s->b, s->abc);
  for (int i = 0; i < 12; ++i)
    if (answer(s, exponent, i % 2, i / 2) != expected)
      fail_msg("%d instead of %d in order %d, unit 2^%d", !expected, expected, i, exponent);
  return expected;
}

static void random_triangle(sample *s, int64_t largest) {
  do
    for (int i = 0; i < 9; ++i) s->abc[i] = whole(largest);
  while (!has_area(s->abc));
}

/* Returns the exponent of a random unit 2^exponent. With the smallest exponent, coordinates are just large enough to count as
 * different from 0. With the largest exponent, coordinates reach 1e60. */
static int random_exponent(int bits) { return -298 + (int)(random_bits(&rng) % (uint64_t)(298 + 199 - bits)); }

TEST(small_numbers_meet_in_every_way) {
  int n_met = 0, n_in_plane = 0;
  const int n = trials(200000, 200000);
  for (int trial = 0; trial < n; ++trial) {
    sample s;
    random_triangle(&s, 3);
    for (int i = 0; i < 3; ++i) s.a[i] = whole(3), s.b[i] = whole(3);
    if (trial % 4 == 0) s.a[2] = s.b[2] = s.abc[2] = s.abc[5] = s.abc[8] = whole(3);
    if (!has_area(s.abc)) continue;
    n_met += check(&s, random_exponent(3));
    const wide3 normal = wide_cross(wide_difference(s.abc + 3, s.abc), wide_difference(s.abc + 6, s.abc));
    n_in_plane +=
        wide_dot(normal, wide_difference(s.a, s.abc)) == 0 && wide_dot(normal, wide_difference(s.b, s.abc)) == 0;
  }
  assert_true(n_met > n / 10 && n_met < n * 9 / 10 && n_in_plane > n / 10);
}

/* A segment passes through a corner, a point of a side, or an inner point of a triangle. The point through which the segment
 * passes is rounded to whole numbers, and one end of the segment is off by at most 1. */
TEST(numbers_of_38_bits_are_told_apart) {
  int n_met = 0;
  const int n = trials(300000, 300000);
  for (int trial = 0; trial < n; ++trial) {
    const int64_t largest = (int64_t)1 << (8 + random_bits(&rng) % 29);
    sample s;
    random_triangle(&s, largest);
    const int64_t steps = (int64_t)1 << (random_bits(&rng) % 8);
    int64_t of_b = 0, of_c = 0;
    if (trial % 4 > 0) of_b = (int64_t)(random_bits(&rng) % (uint64_t)(steps + 1));
    if (trial % 4 > 1)
      of_c = trial % 4 == 2 ? steps - of_b : (int64_t)(random_bits(&rng) % (uint64_t)(steps - of_b + 1));
    for (int i = 0; i < 3; ++i) {
      const int64_t along = whole(largest), off = trial % 3 ? 0 : whole(1);
      const int64_t at = s.abc[i] + (of_b * (s.abc[3 + i] - s.abc[i]) + of_c * (s.abc[6 + i] - s.abc[i])) / steps;
      s.a[i] = at - along * (1 + trial % 2) + off;
      s.b[i] = at + along;
    }
    n_met += check(&s, trial % 5 ? 0 : random_exponent(40));
  }
  assert_true(n_met > n / 5 && n_met < n * 4 / 5);
}

/* A fan of triangles around a corner has no hole. A segment through a point inside the fan therefore meets at least one
 * triangle. */
TEST(a_fan_has_no_hole) {
  enum { n_sides = 7 };
  for (int trial = 0; trial < trials_of(60000); ++trial) {
    double corners[n_sides][3], centre[3] = {0, 0, 0}, a[3], b[3];
    for (int k = 0; k < n_sides; ++k) {
      const double angle = (k + random_between(&rng, -0.3, 0.3)) * 2 * 3.141592653589793 / n_sides;
      corners[k][0] = cos(angle), corners[k][1] = sin(angle), corners[k][2] = random_between(&rng, -0.1, 0.1);
    }
    for (int i = 0; i < 3; ++i) centre[i] = random_between(&rng, -0.01, 0.01);
    /* One end of the segment is above the fan's centre or above a point of a spoke. Up to rounding, the other end is below the
       same point. */
    const int spoke = trial % n_sides;
    const double share = trial % 3 ? 0 : random_between(&rng, 0, 0.3), tilt = random_between(&rng, -0.1, 0.1);
    for (int i = 0; i < 3; ++i) {
      const double at = centre[i] + share * (corners[spoke][i] - centre[i]), along = i == 2 ? 1 : i == 1 ? tilt : 0;
      a[i] = at - along;
      b[i] = at + along * 0.7;
    }
    int n_met = 0;
    for (int k = 0; k < n_sides; ++k) {
      double abc[9];
      memcpy(abc, centre, sizeof centre);
      memcpy(abc + 3, corners[k], sizeof centre);
      memcpy(abc + 6, corners[(k + 1) % n_sides], sizeof centre);
      n_met += segment_triangle_meet(a, b, abc);
    }
    assert_true(n_met >= 1);
  }
}

/* riis.h says that coordinates below 1e-90 count as 0. */
TEST(negligible_coordinates_count_as_0) {
  const double abc[9] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
  const double above[3] = {0, 0, 1e-91}, higher[3] = {0, 0, 1}, touching[3] = {0, 1, 9e-91}, off[3] = {0, 1, 2e-90};
  assert_true(segment_triangle_meet(above, higher, abc));
  assert_true(segment_triangle_meet(touching, higher, abc));
  assert_false(segment_triangle_meet(off, higher, abc));
}

int main(void) {
  rng = random_start("test_crossing");
  return run_cases(NULL, NULL);
}
