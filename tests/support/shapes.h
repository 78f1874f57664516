/* SPDX-License-Identifier: Apache-2.0
 * Provides patches that a test can change before it makes a valve and a surface from them. Include after handles.h. */
#ifndef RIIS_TEST_SHAPES_H
#define RIIS_TEST_SHAPES_H

/* Evaluates a Bezier curve by de Casteljau's method. */
static inline void evaluate(const double *control, int degree, double t, double *point) {
  double q[4][3];
  memcpy(q, control, (size_t)(degree + 1) * sizeof *q);
  for (int n = degree; n > 0; --n)
    for (int i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c) q[i][c] = (1 - t) * q[i][c] + t * q[i + 1][c];
  memcpy(point, q[0], sizeof q[0]);
}

enum { max_curves = 12, max_patches = 3 };

/* Patches with spare room for changes. */
typedef struct {
  int64_t n_curves, n_patches;
  int32_t degree[max_curves], curve_id[4 * max_patches], reversed[4 * max_patches], leaflet_id[max_patches];
  double control[max_curves][4][3];
} shape;

/* The arrays of a shape as the library takes them, without gaps between control points. */
typedef struct {
  riis_patches patches;
  double control[max_curves * 4 * 3];
} arrays_of_shape;

static inline void arrays_from(const shape *from, arrays_of_shape *to) {
  double *next = to->control;
  CHECK_OK(riis_patches_init(&to->patches, sizeof to->patches));
  for (int64_t i = 0; i < from->n_curves; ++i)
    for (int k = 0; k <= from->degree[i]; ++k, next += 3) memcpy(next, from->control[i][k], 3 * sizeof *next);
  to->patches.n_curves = from->n_curves;
  to->patches.degree = from->degree;
  to->patches.control = to->control;
  to->patches.n_patches = from->n_patches;
  to->patches.curve_id = from->curve_id;
  to->patches.reversed = from->reversed;
  to->patches.leaflet_id = from->leaflet_id;
}

static inline riis_valve *valve_from(const shape *from) {
  arrays_of_shape arrays;
  riis_valve *valve = NULL;
  arrays_from(from, &arrays);
  CHECK_OK(riis_valve_create_from_patches(&arrays.patches, &valve));
  own(valve);
  memset(&arrays, -1, sizeof arrays); /* the valve must not refer to the arrays any more */
  return valve;
}

static inline riis_surface *surface_of(const shape *from, const riis_surface_options *options) {
  riis_valve *valve = valve_from(from);
  riis_surface *surface = new_surface(valve, options);
  free_one_owned(valve);
  return surface;
}

static inline void add_curve(shape *to, int32_t degree, const double (*control)[3]) {
  const int64_t i = to->n_curves++;
  to->degree[i] = degree;
  memcpy(to->control[i], control, (size_t)(degree + 1) * sizeof *control);
}

static inline void add_line(shape *to, double x0, double y0, double z0, double x1, double y1, double z1) {
  const double control[2][3] = {{x0, y0, z0}, {x1, y1, z1}};
  add_curve(to, 1, control);
}

static inline void add_patch(shape *to, int32_t v0, int32_t v1, int32_t u0, int32_t u1) {
  int32_t *sides = to->curve_id + 4 * to->n_patches++;
  sides[0] = v0, sides[1] = v1, sides[2] = u0, sides[3] = u1;
}

/* Makes the unit square 0 <= x <= 1, 0 <= y <= 1 at z = 0. */
static inline shape unit_square(void) {
  shape square = {0};
  add_line(&square, 0, 0, 0, 1, 0, 0);
  add_line(&square, 0, 1, 0, 1, 1, 0);
  add_line(&square, 0, 0, 0, 0, 1, 0);
  add_line(&square, 1, 0, 0, 1, 1, 0);
  add_patch(&square, 0, 1, 2, 3);
  return square;
}

/* Compares the surfaces and destroys both. */
static inline void check_same_surfaces(riis_surface *a, riis_surface *b) {
  const int same = is_same_content(a, b);
  free_one_owned(a);
  free_one_owned(b);
  assert_true(same);
}

#endif
