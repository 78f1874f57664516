/* SPDX-License-Identifier: Apache-2.0
 * Helps tests of moving surfaces with values at labels (patch, u, v), copies of vertices, and a valve's root that beats. Include
 * after handles.h. */
#ifndef RIIS_TEST_MOVING_SURFACES_H
#define RIIS_TEST_MOVING_SURFACES_H

/* Writes the value of a label, by linear interpolation in a triangle of labels. Vertex i has the label uv[2 i] and the value
 * values[3 i]. Returns 0 if no triangle contains the label. */
static inline int value_at_label(const riis_triangles *t, const double *uv, const double *values, int32_t patch,
                                 const double *label, double *value) {
  for (int64_t i = 0; i < t->n_triangles; ++i) {
    if (t->patch_id[i] != patch) continue;
    const int64_t *id = t->vertex_id + 3 * i;
    const double *a = uv + 2 * id[0], *b = uv + 2 * id[1], *c = uv + 2 * id[2];
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double of_b = ((label[0] - a[0]) * (c[1] - a[1]) - (label[1] - a[1]) * (c[0] - a[0])) / area;
    const double of_c = ((b[0] - a[0]) * (label[1] - a[1]) - (b[1] - a[1]) * (label[0] - a[0])) / area;
    if (!(of_b >= -1e-9 && of_c >= -1e-9 && of_b + of_c <= 1 + 1e-9)) continue;
    for (int k = 0; k < 3; ++k)
      value[k] =
          (1 - of_b - of_c) * values[3 * id[0] + k] + of_b * values[3 * id[1] + k] + of_c * values[3 * id[2] + k];
    return 1;
  }
  return 0;
}

/* A copy of a surface's vertices, for use after the surface has moved. The test owns the arrays. */
typedef struct kept_vertices {
  int64_t n;
  double *xyz, *uv;
} kept_vertices;

static inline kept_vertices vertices_of(const riis_surface *surface) {
  const riis_triangles t = triangles_of(surface);
  const size_t n = (size_t)t.n_vertices;
  kept_vertices made = {t.n_vertices, own(malloc(n * 3 * sizeof(double))), own(malloc(n * 2 * sizeof(double)))};
  memcpy(made.xyz, t.xyz, n * 3 * sizeof(double)), memcpy(made.uv, t.uv, n * 2 * sizeof(double));
  return made;
}

/* A valve's root that widens unevenly, tilts and shifts during a beat. `of` gives the sizes of the root's motions. */
static inline void beat(const double *x, double time, const double *of, double *y) {
  const double phase = 2 * acos(-1) * time, angle = atan2(x[1], x[0]), tilt = of[0] * sin(phase);
  const double wide = 1 + of[1] * sin(phase + 0.3) * (1 + 0.5 * cos(2 * angle));
  const double p[3] = {x[0] * wide, x[1] * wide, x[2] + of[2] * sin(phase) * cos(angle)};
  y[0] = cos(tilt) * p[0] + sin(tilt) * p[2] + of[3] * sin(phase);
  y[1] = p[1] + 0.5 * of[3] * cos(phase);
  y[2] = cos(tilt) * p[2] - sin(tilt) * p[0];
}

#endif
