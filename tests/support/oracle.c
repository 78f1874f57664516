/* SPDX-License-Identifier: Apache-2.0 */
#include "oracle.h"

#include <math.h>

typedef long double real;

static void subtract(const double *a, const double *b, real *c) {
  for (int i = 0; i < 3; ++i) c[i] = (real)a[i] - b[i];
}
static real dot(const real *a, const real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static real length_minus(const real *r, real s, const real *e, real t, const real *f) {
  real sum = 0;
  for (int i = 0; i < 3; ++i) {
    const real d = r[i] - s * e[i] - t * f[i];
    sum += d * d;
  }
  return sqrtl(sum);
}

/* Finds the vertex, the edge or the interior of the triangle onto which p projects. The method is C. Ericson, "Real-Time
 * Collision Detection", 5.1.5. */
long double oracle_point_triangle(const double *p, const double *abc) {
  const double *a = abc, *b = abc + 3, *c = abc + 6;
  real ab[3], ac[3], bc[3], ap[3], bp[3], cp[3];
  subtract(b, a, ab), subtract(c, a, ac), subtract(c, b, bc);
  subtract(p, a, ap), subtract(p, b, bp), subtract(p, c, cp);
  const real d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return sqrtl(dot(ap, ap));
  if (d3 >= 0 && d4 <= d3) return sqrtl(dot(bp, bp));
  const real vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return length_minus(ap, d1 / (d1 - d3), ab, 0, ac);
  if (d6 >= 0 && d5 <= d6) return sqrtl(dot(cp, cp));
  const real vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return length_minus(ap, 0, ab, d2 / (d2 - d6), ac);
  const real va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return length_minus(bp, (d4 - d3) / ((d4 - d3) + (d5 - d6)), bc, 0, bc);
  const real sum = va + vb + vc;
  return length_minus(ap, vb / sum, ab, vc / sum, ac);
}

long double oracle_distance(const double *p, int64_t n, const int64_t *vertex_id, const double *xyz,
                            int64_t *triangle) {
  real smallest = INFINITY;
  for (int64_t i = 0; i < n; ++i) {
    double abc[9];
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c) abc[3 * k + c] = xyz[3 * vertex_id[3 * i + k] + c];
    const real distance = oracle_point_triangle(p, abc);
    if (distance < smallest) {
      smallest = distance;
      *triangle = i;
    }
  }
  return smallest;
}
