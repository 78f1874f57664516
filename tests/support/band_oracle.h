/* SPDX-License-Identifier: Apache-2.0
 * Computes where nodes lie relative to a band with an offset. The signs of the distances come from normals that are summed over
 * all triangles, in long double. Include after handles.h. */
#ifndef RIIS_TEST_BAND_ORACLE_H
#define RIIS_TEST_BAND_ORACLE_H

typedef long double real;

typedef struct band_place {
  real distance, height; /* the height over the closest point, along the surface's unit normal there */
  real normal[3], way[3];
  int is_on_rim;
} band_place;

static inline real dot3(const real *a, const real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static inline void cross3(const real *a, const real *b, real *c) {
  for (int i = 0; i < 3; ++i) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* The corners of a triangle by its position in the list. */
static inline void band_corners(const riis_triangles *all, int64_t triangle, real (*corner)[3]) {
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 3; ++c) corner[k][c] = all->xyz[3 * all->vertex_id[3 * triangle + k] + c];
}

static inline int64_t band_position(const riis_triangles *all, int64_t triangle_id) {
  int64_t i = triangle_id < all->n_triangles ? triangle_id : all->n_triangles - 1;
  while (all->triangle_id[i] > triangle_id) --i;
  return i;
}

/* Finds the closest point of a triangle. If a corner's weight is 0, the closest point does not depend on this corner. */
static inline void closest_weights(const real *p, real (*corner)[3], real *weight) {
  real least = INFINITY, ab[3], ac[3], ap[3], normal[3], to_b[3], to_c[3];
  for (int k = 0; k < 3; ++k) {
    const real *a = corner[k], *b = corner[(k + 1) % 3];
    real along[3], way[3], off = 0;
    for (int c = 0; c < 3; ++c) along[c] = b[c] - a[c], way[c] = p[c] - a[c];
    real t = dot3(way, along) / dot3(along, along);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    for (int c = 0; c < 3; ++c) off += (way[c] - t * along[c]) * (way[c] - t * along[c]);
    if (off >= least) continue;
    least = off;
    weight[k] = 1 - t, weight[(k + 1) % 3] = t, weight[(k + 2) % 3] = 0;
  }
  for (int c = 0; c < 3; ++c)
    ab[c] = corner[1][c] - corner[0][c], ac[c] = corner[2][c] - corner[0][c], ap[c] = p[c] - corner[0][c];
  cross3(ab, ac, normal);
  cross3(ap, ac, to_b), cross3(ab, ap, to_c);
  const real area = dot3(normal, normal), u = dot3(to_b, normal) / area, v = dot3(to_c, normal) / area;
  if (u > 0 && v > 0 && u + v < 1) weight[0] = 1 - u - v, weight[1] = u, weight[2] = v;
}

/* Sums the normals of all triangles that share the corners whose weights are positive. At a vertex, each normal is weighted by
 * the triangle's angle. */
static inline void sum_normals(const riis_triangles *all, real (*corner)[3], const real *weight, real *sum) {
  int n_wanted = 0;
  for (int k = 0; k < 3; ++k) n_wanted += weight[k] > 0;
  for (int c = 0; c < 3; ++c) sum[c] = 0;
  for (int64_t t = 0; t < all->n_triangles; ++t) {
    real other[3][3], angle = 1, n[3], e[2][3];
    int n_shared = 0;
    band_corners(all, t, other);
    for (int k = 0; k < 3; ++k)
      for (int m = 0; m < 3; ++m)
        if (weight[k] > 0 && corner[k][0] == other[m][0] && corner[k][1] == other[m][1] &&
            corner[k][2] == other[m][2]) {
          ++n_shared;
          if (n_wanted > 1) continue;
          for (int c = 0; c < 3; ++c)
            e[0][c] = other[(m + 1) % 3][c] - other[m][c], e[1][c] = other[(m + 2) % 3][c] - other[m][c];
          cross3(e[0], e[1], n);
          angle = atan2l(sqrtl(dot3(n, n)), dot3(e[0], e[1]));
        }
    if (n_shared < n_wanted) continue;
    for (int c = 0; c < 3; ++c) e[0][c] = other[1][c] - other[0][c], e[1][c] = other[2][c] - other[0][c];
    cross3(e[0], e[1], n);
    const real size = sqrtl(dot3(n, n));
    for (int c = 0; c < 3; ++c) sum[c] += angle * n[c] / size;
  }
}

/* Computes the place of a node from its closest triangle. The caller also says whether the closest point is on the rim. */
static inline band_place place_of(const riis_triangles *all, const double *node, int64_t triangle_id, int is_on_rim) {
  real p[3] = {node[0], node[1], node[2]}, corner[3][3], weight[3], size, at;
  band_place place = {.is_on_rim = is_on_rim};
  band_corners(all, band_position(all, triangle_id), corner);
  closest_weights(p, corner, weight);
  for (int c = 0; c < 3; ++c) {
    at = weight[0] * corner[0][c] + weight[1] * corner[1][c] + weight[2] * corner[2][c];
    place.way[c] = p[c] - at;
  }
  sum_normals(all, corner, weight, place.normal);
  size = sqrtl(dot3(place.normal, place.normal));
  for (int c = 0; c < 3; ++c) place.normal[c] /= size;
  place.distance = sqrtl(dot3(place.way, place.way));
  const real over = dot3(place.way, place.normal);
  place.height = is_on_rim ? over : over > 0 ? place.distance : over < 0 ? -place.distance : 0;
  return place;
}

/* Returns the distance of a node from the middle of the band. The band has the half thickness eps and the offset o. */
static inline real from_middle(const band_place *place, real eps, real o) {
  if (!place->is_on_rim) return fabsl(place->height - o * eps);
  real sum = 0;
  for (int c = 0; c < 3; ++c) {
    const real x = place->way[c] - o * eps * place->normal[c];
    sum += x * x;
  }
  return sqrtl(sum);
}

static inline double oracle_K(const band_place *place, double R, double eps, double o, int cuts) {
  const real d = from_middle(place, eps, o), pi = acosl(-1);
  if (d >= eps || (cuts && place->is_on_rim)) return 0;
  return (double)(R / eps * (1 + cosl(pi * d / eps)) / (2 * (real)eps));
}

#endif
