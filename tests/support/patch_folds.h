/* SPDX-License-Identifier: Apache-2.0
 * Finds folds of a valve's smooth patches, from the curves that riis_valve_get_patches gives. Include after handles.h. */
#ifndef RIIS_TEST_PATCH_FOLDS_H
#define RIIS_TEST_PATCH_FOLDS_H

enum { fold_chords = 200, fold_places = 12 };

/* A side of a patch, with a table of the lengths along it. */
typedef struct fold_side {
  double control[4][3], behind[fold_chords + 1];
  int degree;
} fold_side;

static inline void fold_point(const fold_side *side, double t, double *point) {
  double q[4][3];
  memcpy(q, side->control, sizeof q);
  for (int n = side->degree; n > 0; --n)
    for (int k = 0; k < n; ++k)
      for (int c = 0; c < 3; ++c) q[k][c] += t * (q[k + 1][c] - q[k][c]);
  memcpy(point, q[0], sizeof q[0]);
}

static inline fold_side fold_side_of(const riis_valve_patches *patches, int64_t patch, int side) {
  fold_side made = {{{0}}, {0}, 0};
  const int64_t curve = patches->curve_id[4 * patch + side];
  const double *control = patches->control;
  double last[3], next[3];
  assert_int_equal(patches->n_pieces, patches->n_curves);
  for (int64_t i = 0; i < curve; ++i) control += 3 * (patches->degree[i] + 1);
  made.degree = patches->degree[curve];
  for (int k = 0; k <= made.degree; ++k)
    memcpy(made.control[k], control + 3 * (patches->reversed[4 * patch + side] ? made.degree - k : k), sizeof last);
  fold_point(&made, 0, last);
  for (int i = 1; i <= fold_chords; ++i) {
    fold_point(&made, (double)i / fold_chords, next);
    made.behind[i] = made.behind[i - 1] + hypot(hypot(next[0] - last[0], next[1] - last[1]), next[2] - last[2]);
    memcpy(last, next, sizeof last);
  }
  return made;
}

static inline void fold_point_at_share(const fold_side *side, double share, double *point) {
  const double wanted = share * side->behind[fold_chords];
  int low = 0, high = fold_chords;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    *(side->behind[middle] <= wanted ? &low : &high) = middle;
  }
  const double step = side->behind[high] - side->behind[low];
  fold_point(side, (low + (step > 0 ? (wanted - side->behind[low]) / step : 0)) / fold_chords, point);
}

/* The sides lie at v = 0, v = 1, u = 0 and u = 1. */
static inline void fold_point_of_patch(const fold_side *sides, double u, double v, double *point) {
  double at[4][3], corner[4][3];
  for (int side = 0; side < 4; ++side) fold_point_at_share(&sides[side], side < 2 ? u : v, at[side]);
  for (int k = 0; k < 4; ++k) fold_point(&sides[k / 2], k % 2, corner[k]);
  for (int c = 0; c < 3; ++c)
    point[c] = (1 - v) * at[0][c] + v * at[1][c] + (1 - u) * at[2][c] + u * at[3][c] -
               (1 - v) * ((1 - u) * corner[0][c] + u * corner[1][c]) - v * ((1 - u) * corner[2][c] + u * corner[3][c]);
}

/* Writes the unit normal of a patch. */
static inline void fold_normal(const fold_side *sides, double u, double v, double *normal) {
  static const double offset[4][2] = {{-1e-3, 0}, {1e-3, 0}, {0, -1e-3}, {0, 1e-3}};
  double p[4][3], along[2][3], size = 0;
  for (int k = 0; k < 4; ++k) fold_point_of_patch(sides, u + offset[k][0], v + offset[k][1], p[k]);
  for (int c = 0; c < 3; ++c) along[0][c] = p[1][c] - p[0][c], along[1][c] = p[3][c] - p[2][c];
  for (int c = 0; c < 3; ++c) {
    const int d = (c + 1) % 3, e = (c + 2) % 3;
    normal[c] = along[0][d] * along[1][e] - along[0][e] * along[1][d];
    size = hypot(size, normal[c]);
  }
  for (int c = 0; c < 3; ++c) normal[c] /= size;
}

/* Returns whether a patch that begins at the root folds. It folds if its normal turns over between neighbouring places. A patch
 * that begins at the root has an even id. The places are dense near the root. */
static inline int a_lower_patch_folds(riis_valve *valve) {
  riis_valve_patches patches;
  CHECK_OK(riis_valve_get_patches(valve, &patches, sizeof patches));
  for (int64_t i = 0; i < patches.n_patches; ++i) {
    if (patches.patch_id[i] % 2) continue;
    fold_side sides[4];
    double normal[fold_places][fold_places][3];
    for (int k = 0; k < 4; ++k) sides[k] = fold_side_of(&patches, i, k);
    for (int a = 0; a < fold_places; ++a)
      for (int b = 0; b < fold_places; ++b) {
        const double share = (b + 0.5) / fold_places, *here = normal[a][b];
        fold_normal(sides, (a + 0.5) / fold_places, share * share, normal[a][b]);
        for (int k = 0; k < 2; ++k) {
          if (k ? b == 0 : a == 0) continue;
          const double *before = k ? normal[a][b - 1] : normal[a - 1][b];
          if (here[0] * before[0] + here[1] * before[1] + here[2] * before[2] < 0) return 1;
        }
      }
  }
  return 0;
}

#endif
