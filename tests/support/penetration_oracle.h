/* SPDX-License-Identifier: Apache-2.0
 * Computes how deep two triangles penetrate, and their common segment, with 113 bits of precision. The depth is the distance from
 * the origin to the convex hull of the nine differences of corners. The oracle tries all planes through three of the nine
 * differences. An edge of one triangle may pass through the other triangle at a point. The two of these points that are farthest
 * apart are the ends of the segment. The library instead compares overlaps along normals, and clips. */
#ifndef RIIS_TEST_PENETRATION_ORACLE_H
#define RIIS_TEST_PENETRATION_ORACLE_H

#include <math.h>

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 quad;
#else
typedef long double quad; /* also has 113 bits on systems that lack __float128 */
#endif

typedef struct quad3 {
  quad x[3];
} quad3;

static inline quad3 quad_difference(quad3 a, quad3 b) {
  return (quad3){{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}};
}
static inline quad quad_dot(quad3 a, quad3 b) { return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2]; }
static inline quad3 quad_cross(quad3 a, quad3 b) {
  return (quad3){
      {a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}
static inline quad quad_root(quad x) {
  if (x <= 0) return 0;
  quad root = sqrt((double)x);
  for (int i = 0; i < 3; ++i) root = (root + x / root) / 2;
  return root;
}
static inline quad quad_length(quad3 a) { return quad_root(quad_dot(a, a)); }

/* The corners of both triangles, relative to the first corner of the first triangle. */
typedef struct quad_pair {
  quad3 a[3], b[3];
  quad longest;
} quad_pair;

static inline quad_pair quad_pair_of(const double *a, const double *b) {
  quad_pair pair = {.longest = 0};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      pair.a[k].x[i] = (quad)a[3 * k + i] - a[i];
      pair.b[k].x[i] = (quad)b[3 * k + i] - a[i];
    }
  for (int k = 0; k < 3; ++k) {
    const quad of_a = quad_length(quad_difference(pair.a[(k + 1) % 3], pair.a[k]));
    const quad of_b = quad_length(quad_difference(pair.b[(k + 1) % 3], pair.b[k]));
    if (of_a > pair.longest) pair.longest = of_a;
    if (of_b > pair.longest) pair.longest = of_b;
  }
  return pair;
}

/* Returns true if all points are on one side of the triangle's plane, or on the plane. */
static inline int is_beside(const quad3 *points, const quad3 *triangle) {
  const quad3 n = quad_cross(quad_difference(triangle[1], triangle[0]), quad_difference(triangle[2], triangle[0]));
  int n_above = 0, n_below = 0;
  for (int k = 0; k < 3; ++k) {
    const quad height = quad_dot(n, quad_difference(points[k], triangle[0]));
    n_above += height >= 0;
    n_below += height <= 0;
  }
  return n_above == 3 || n_below == 3;
}

/* Takes the plane through three points. If all points are on one side of this plane, lowers *depth to the plane's distance from
 * the origin. If the origin is on the other side, *depth becomes 0. */
static inline void try_plane(const quad3 *p, int i, int j, int k, quad size, quad *depth) {
  const quad3 n = quad_cross(quad_difference(p[j], p[i]), quad_difference(p[k], p[i]));
  const quad of_n = quad_length(n), tiny = (quad)1e-24 * of_n * size;
  if (of_n <= (quad)1e-20 * size * size) return;
  int n_above = 0, n_below = 0;
  for (int m = 0; m < 9; ++m) {
    const quad height = quad_dot(n, quad_difference(p[m], p[i]));
    n_above += height >= -tiny;
    n_below += height <= tiny;
  }
  const quad of_origin = -quad_dot(n, p[i]) / of_n;
  if (n_above == 9 && of_origin < *depth) *depth = of_origin;
  if (n_below == 9 && -of_origin < *depth) *depth = -of_origin;
  if (*depth < 0) *depth = 0;
}

static inline double oracle_depth(const double *a, const double *b) {
  const quad_pair pair = quad_pair_of(a, b);
  if (is_beside(pair.a, pair.b) || is_beside(pair.b, pair.a)) return 0;
  quad3 differences[9];
  quad size = 0;
  for (int k = 0; k < 9; ++k) {
    differences[k] = quad_difference(pair.a[k / 3], pair.b[k % 3]);
    if (quad_length(differences[k]) > size) size = quad_length(differences[k]);
  }
  quad depth = size;
  for (int i = 0; i < 9; ++i)
    for (int j = i + 1; j < 9; ++j)
      for (int k = j + 1; k < 9 && depth > 0; ++k) try_plane(differences, i, j, k, size, &depth);
  return (double)depth;
}

/* Adds the point at which the edge from p to q passes through the triangle. */
static inline int add_piercing(quad3 p, quad3 q, const quad3 *t, quad3 *points, int n) {
  const quad3 normal = quad_cross(quad_difference(t[1], t[0]), quad_difference(t[2], t[0]));
  const quad at_p = quad_dot(normal, quad_difference(p, t[0])), at_q = quad_dot(normal, quad_difference(q, t[0]));
  if ((at_p < 0) == (at_q < 0)) return n;
  quad3 at;
  for (int i = 0; i < 3; ++i) at.x[i] = p.x[i] + (q.x[i] - p.x[i]) * (at_p / (at_p - at_q));
  const quad margin = (quad)1e-25 * quad_dot(normal, normal);
  for (int k = 0; k < 3; ++k) {
    const quad3 side = quad_difference(t[(k + 1) % 3], t[k]);
    if (quad_dot(quad_cross(side, quad_difference(at, t[k])), normal) < -margin) return n;
  }
  points[n] = at;
  return n + 1;
}

/* Returns the length of the common segment of two triangles, and gives its middle. The triangles' depth must be above 0. */
static inline double oracle_segment(const double *a, const double *b, double *middle) {
  const quad_pair pair = quad_pair_of(a, b);
  quad3 points[6], first = {{0, 0, 0}}, last = first;
  int n = 0;
  for (int k = 0; k < 3; ++k) {
    n = add_piercing(pair.a[k], pair.a[(k + 1) % 3], pair.b, points, n);
    n = add_piercing(pair.b[k], pair.b[(k + 1) % 3], pair.a, points, n);
  }
  quad longest = -1;
  for (int i = 0; i < n; ++i)
    for (int j = i; j < n; ++j)
      if (quad_length(quad_difference(points[i], points[j])) > longest) {
        first = points[i];
        last = points[j];
        longest = quad_length(quad_difference(first, last));
      }
  for (int i = 0; i < 3; ++i) middle[i] = (double)((first.x[i] + last.x[i]) / 2 + a[i]);
  return (double)longest;
}

#endif
