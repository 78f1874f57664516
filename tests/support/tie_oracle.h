/* SPDX-License-Identifier: Apache-2.0
 * Computes the surface's velocity near a point p independently of the library. A loop goes over all triangles in extended
 * precision, leaflet by leaflet. Include after riis.h, test_support.h, handles.h and oracle.h. */
#ifndef RIIS_TEST_TIE_ORACLE_H
#define RIIS_TEST_TIE_ORACLE_H

enum { most_places = 16 };

/* The closest point of one patch. */
typedef struct tied_place {
  int32_t leaflet_id, patch_id;
  long double distance, point[3], velocity[3];
} tied_place;

typedef struct tied_velocity {
  int n_leaflets, n_places; /* number of equally near leaflets, and of equally near points */
  double mean[3];           /* mean velocity of the leaflets */
  int is_clear;             /* 0 if rounding decides which points count as equally near */
} tied_velocity;

/* Writes the weights of the closest point of the triangle a b c, and returns its distance. */
static inline long double closest_weights(const double *p, const double *abc, long double *weights) {
  long double best = INFINITY, r[3][3], of_ab = 0, of_ac = 0, ab_ab = 0, ab_ac = 0, ac_ac = 0;
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 3; ++c) r[k][c] = (long double)abc[3 * k + c] - p[c];
  for (int c = 0; c < 3; ++c) {
    const long double ab = r[1][c] - r[0][c], ac = r[2][c] - r[0][c];
    ab_ab += ab * ab, ab_ac += ab * ac, ac_ac += ac * ac, of_ab -= r[0][c] * ab, of_ac -= r[0][c] * ac;
  }
  const long double det = ab_ab * ac_ac - ab_ac * ab_ac, s = (ac_ac * of_ab - ab_ac * of_ac) / det,
                    t = (ab_ab * of_ac - ab_ac * of_ab) / det;
  for (int candidate = 0; candidate < 4; ++candidate) {
    long double w[3] = {1 - s - t, s, t}, at[3], distance_sq = 0;
    if (candidate < 3) {
      const long double *a = r[candidate], *b = r[(candidate + 1) % 3];
      long double along = 0, length_sq = 0;
      for (int c = 0; c < 3; ++c) along -= a[c] * (b[c] - a[c]), length_sq += (b[c] - a[c]) * (b[c] - a[c]);
      const long double share = fminl(fmaxl(along / length_sq, 0), 1);
      w[candidate] = 1 - share, w[(candidate + 1) % 3] = share, w[(candidate + 2) % 3] = 0;
    } else if (!(w[0] >= 0 && w[1] >= 0 && w[2] >= 0)) {
      continue;
    }
    for (int c = 0; c < 3; ++c) {
      at[c] = w[0] * r[0][c] + w[1] * r[1][c] + w[2] * r[2][c];
      distance_sq += at[c] * at[c];
    }
    if (!(distance_sq < best)) continue;
    best = distance_sq;
    memcpy(weights, w, sizeof w);
  }
  return sqrtl(best);
}

/* Returns the largest component of the velocities of all vertices. The velocities of a part at rest are only rounding errors. */
static inline double largest_velocity(const riis_triangles *s, const double *velocity) {
  double largest = 0;
  for (int64_t i = 0; i < 3 * s->n_vertices; ++i) largest = fmax(largest, fabs(velocity[i]));
  return largest;
}

/* Returns the rounding error of distances near p. If the distances of two points differ by less than the rounding error, rounding
 * decides which point is nearer. */
static inline long double rounding_near(const double *p, double half_thickness) {
  return 1e-13L * (half_thickness + fabs(p[0]) + fabs(p[1]) + fabs(p[2]));
}

/* Finds the closest point of each patch within `reach`. Sets *is_clear to 0 if a patch has two closest points. */
static inline int places_near(const riis_triangles *s, const double *velocity, const double *p, double reach,
                              double half_thickness, tied_place *places, int *is_clear) {
  const long double rounding = rounding_near(p, half_thickness);
  int n = 0;
  for (int64_t t = 0; t < s->n_triangles; ++t) {
    double abc[9];
    int is_beside = 0;
    for (int k = 0; k < 9; ++k) abc[k] = s->xyz[3 * s->vertex_id[3 * t + k / 3] + k % 3];
    for (int c = 0; c < 3; ++c) {
      const double lower = p[c] - reach - (double)rounding, upper = p[c] + reach + (double)rounding;
      is_beside |= (abc[c] < lower && abc[3 + c] < lower && abc[6 + c] < lower) ||
                   (abc[c] > upper && abc[3 + c] > upper && abc[6 + c] > upper);
    }
    if (is_beside) continue;
    tied_place place = {s->leaflet_id[t], s->patch_id[t], 0, {0}, {0}};
    long double w[3] = {0, 0, 0};
    place.distance = closest_weights(p, abc, w);
    if (!(place.distance <= reach + rounding)) continue;
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c) {
        const double v = velocity[3 * s->vertex_id[3 * t + k] + c];
        place.point[c] += w[k] * abc[3 * k + c];
        place.velocity[c] += w[k] * v;
      }
    int at = 0;
    while (at < n && (places[at].leaflet_id != place.leaflet_id || places[at].patch_id != place.patch_id)) ++at;
    if (at == n) {
      assert_true(n < most_places);
      places[n++] = place;
      continue;
    }
    long double apart = 0;
    for (int c = 0; c < 3; ++c) apart = fmaxl(apart, fabsl(places[at].point[c] - place.point[c]));
    if (fabsl(places[at].distance - place.distance) <= rounding && apart > 1e3L * rounding) *is_clear = 0;
    if (place.distance < places[at].distance) places[at] = place;
  }
  return n;
}

/* Returns the velocity of the surface near p. The argument `distance` is the distance of p from the surface. */
static inline tied_velocity tied_velocity_at(const riis_triangles *s, const double *velocity, const double *p,
                                             double distance, double half_thickness) {
  const long double rounding = rounding_near(p, half_thickness), of_leaflets = 1e-6L * half_thickness,
                    of_patches = 1e-9L * half_thickness;
  tied_place place[most_places];
  tied_velocity made = {0, 0, {0, 0, 0}, 1};
  long double sum[3] = {0, 0, 0}, closest = INFINITY;
  const int n = places_near(s, velocity, p, distance + 2e-6 * half_thickness, half_thickness, place, &made.is_clear);
  for (int i = 0; i < n; ++i) closest = fminl(closest, place[i].distance);
  for (int i = 0; i < n; ++i) {
    long double of_leaflet = INFINITY, mean[3] = {0, 0, 0};
    int n_places = 0, is_first = 1;
    for (int j = 0; j < n; ++j)
      if (place[j].leaflet_id == place[i].leaflet_id) {
        of_leaflet = fminl(of_leaflet, place[j].distance);
        if (j < i) is_first = 0;
      }
    if (!is_first) continue;
    if (fabsl(of_leaflet - closest - of_leaflets) <= rounding) made.is_clear = 0;
    if (of_leaflet > closest + of_leaflets) continue;
    for (int j = i; j < n; ++j) {
      if (place[j].leaflet_id != place[i].leaflet_id) continue;
      if (fabsl(place[j].distance - of_leaflet - of_patches) <= rounding) made.is_clear = 0;
      if (place[j].distance > of_leaflet + of_patches) continue;
      for (int c = 0; c < 3; ++c) mean[c] += place[j].velocity[c];
      ++n_places;
    }
    for (int c = 0; c < 3; ++c) sum[c] += mean[c] / n_places;
    ++made.n_leaflets;
    made.n_places += n_places;
  }
  for (int c = 0; c < 3; ++c) made.mean[c] = (double)(sum[c] / made.n_leaflets);
  return made;
}

#endif
