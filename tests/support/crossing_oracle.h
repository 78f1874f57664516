/* SPDX-License-Identifier: Apache-2.0
 * Finds whether a segment and a triangle have a point in common. The oracle solves the equations exactly by Cramer's rule, with
 * integers of 128 bits. If the segment lies in the triangle's plane, the oracle clips it at the triangle's sides. The library
 * instead computes signs of volumes in floating point. */
#ifndef RIIS_TEST_CROSSING_ORACLE_H
#define RIIS_TEST_CROSSING_ORACLE_H

#include <stdint.h>

__extension__ typedef __int128 wide;

typedef struct wide3 {
  wide x[3];
} wide3;

static inline wide3 wide_difference(const int64_t *a, const int64_t *b) {
  return (wide3){{(wide)a[0] - b[0], (wide)a[1] - b[1], (wide)a[2] - b[2]}};
}
static inline wide3 wide_cross(wide3 a, wide3 b) {
  return (wide3){
      {a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}
static inline wide wide_dot(wide3 a, wide3 b) { return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2]; }

/* Returns the answer for a segment and a triangle in one plane. Segment and triangle are projected along a coordinate axis that
 * does not lie in the plane. */
static inline int oracle_meet_in_plane(const int64_t *a, const int64_t *b, const int64_t *abc, wide3 normal) {
  const int drop = normal.x[0] ? 0 : normal.x[1] ? 1 : 2, u = (drop + 1) % 3, v = (drop + 2) % 3;
  const int turn = normal.x[drop] > 0 ? 1 : -1;
  /* The part of the segment from t = low to t = high is inside the sides of the triangle that were tried so far. Both ends are
   * fractions with positive denominators. */
  wide low = 0, low_of = 1, high = 1, high_of = 1;
  for (int i = 0; i < 3; ++i) {
    const int64_t *from = abc + 3 * i, *to = abc + 3 * ((i + 1) % 3);
    const wide along_u = (wide)to[u] - from[u], along_v = (wide)to[v] - from[v];
    const wide at_a = turn * (along_u * ((wide)a[v] - from[v]) - along_v * ((wide)a[u] - from[u]));
    const wide at_b = turn * (along_u * ((wide)b[v] - from[v]) - along_v * ((wide)b[u] - from[u]));
    if (at_a < 0 && at_b < 0) return 0;
    if (at_a < 0 && -at_a * low_of > low * (at_b - at_a)) low = -at_a, low_of = at_b - at_a;
    if (at_b < 0 && at_a * high_of < high * (at_a - at_b)) high = at_a, high_of = at_a - at_b;
  }
  return low * high_of <= high * low_of;
}

/* Returns the answer for any segment and triangle. The coordinates in a[3], b[3] and abc[9] are at most 2^38 in magnitude, or
 * 2^28 if all points lie in one plane. The triangle's area must be positive. */
static inline int oracle_segment_meets_triangle(const int64_t *a, const int64_t *b, const int64_t *abc) {
  const wide3 e1 = wide_difference(abc + 3, abc), e2 = wide_difference(abc + 6, abc), along = wide_difference(b, a);
  const wide3 normal = wide_cross(e1, e2), from_corner = wide_difference(a, abc), p = wide_cross(along, e2),
              q = wide_cross(from_corner, e1);
  const wide determinant = wide_dot(e1, p);
  const int turn = determinant > 0 ? 1 : -1;
  const wide t = turn * wide_dot(e2, q), u = turn * wide_dot(from_corner, p), v = turn * wide_dot(along, q);
  if (determinant == 0) return wide_dot(normal, from_corner) == 0 && oracle_meet_in_plane(a, b, abc, normal);
  return t >= 0 && t <= turn * determinant && u >= 0 && v >= 0 && u + v <= turn * determinant;
}

static inline int has_area(const int64_t *abc) {
  const wide3 n = wide_cross(wide_difference(abc + 3, abc), wide_difference(abc + 6, abc));
  return n.x[0] || n.x[1] || n.x[2];
}

#endif
