/* SPDX-License-Identifier: Apache-2.0
 * Valves from the caller's patches: every refusal by code and message, and surfaces compared with the patches. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

enum { max_curves = 12, max_patches = 3 };

/* Patches with room to change anything. */
typedef struct {
  int64_t n_curves, n_patches;
  int32_t degree[max_curves], curve_id[4 * max_patches], reversed[4 * max_patches], leaflet_id[max_patches];
  double control[max_curves][4][3];
} shape;

/* The arrays of a shape as the library takes them, with the control points stored without gaps. */
typedef struct {
  riis_patches patches;
  double control[max_curves * 4 * 3];
} arrays_of_shape;

static void arrays_from(const shape *from, arrays_of_shape *to) {
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

static riis_valve *valve_from(const shape *from) {
  arrays_of_shape arrays;
  riis_valve *valve = NULL;
  arrays_from(from, &arrays);
  CHECK_OK(riis_valve_create_from_patches(&arrays.patches, &valve));
  memset(&arrays, -1, sizeof arrays); /* the library must not keep borrowing the arrays */
  return valve;
}

static riis_surface *surface_of(const shape *from, const riis_surface_options *options) {
  riis_valve *valve = valve_from(from);
  riis_surface *surface = NULL;
  CHECK_OK(riis_surface_create(valve, options, &surface));
  riis_valve_destroy(&valve);
  return surface;
}

static void add_curve(shape *to, int32_t degree, const double (*control)[3]) {
  const int64_t i = to->n_curves++;
  to->degree[i] = degree;
  memcpy(to->control[i], control, (size_t)(degree + 1) * sizeof *control);
}

static void add_line(shape *to, double x0, double y0, double z0, double x1, double y1, double z1) {
  const double control[2][3] = {{x0, y0, z0}, {x1, y1, z1}};
  add_curve(to, 1, control);
}

static void add_patch(shape *to, int32_t v0, int32_t v1, int32_t u0, int32_t u1) {
  int32_t *sides = to->curve_id + 4 * to->n_patches++;
  sides[0] = v0, sides[1] = v1, sides[2] = u0, sides[3] = u1;
}

/* 0 <= x <= 1, 0 <= y <= 1 in z = 0. */
static shape unit_square(void) {
  shape square = {0};
  add_line(&square, 0, 0, 0, 1, 0, 0);
  add_line(&square, 0, 1, 0, 1, 1, 0);
  add_line(&square, 0, 0, 0, 0, 1, 0);
  add_line(&square, 1, 0, 0, 1, 1, 0);
  add_patch(&square, 0, 1, 2, 3);
  return square;
}

static int is_same(const riis_surface *a, const riis_surface *b) {
  const surface_content s = surface_content_of(a), t = surface_content_of(b);
  return s.n_vertices == t.n_vertices && s.n_triangles == t.n_triangles &&
         memcmp(s.xyz, t.xyz, (size_t)s.n_vertices * 3 * sizeof *s.xyz) == 0 &&
         memcmp(s.uv, t.uv, (size_t)s.n_vertices * 2 * sizeof *s.uv) == 0 &&
         memcmp(s.vertex_id, t.vertex_id, (size_t)s.n_triangles * 3 * sizeof *s.vertex_id) == 0 &&
         memcmp(s.leaflet_id, t.leaflet_id, (size_t)s.n_triangles * sizeof *s.leaflet_id) == 0 &&
         memcmp(s.patch_id, t.patch_id, (size_t)s.n_triangles * sizeof *s.patch_id) == 0;
}

/* Both surfaces are destroyed. */
static void check_same_surfaces(riis_surface *a, riis_surface *b) {
  const int same = is_same(a, b);
  riis_surface_destroy(&a);
  riis_surface_destroy(&b);
  assert_true(same);
}

/* ------------------------------------------------------------------------------------------------------------------ *
 * Refusals
 * ------------------------------------------------------------------------------------------------------------------ */

#define REFUSED(status, parts)                                                            \
  do {                                                                                    \
    riis_valve *made = NULL;                                                              \
    CHECK_REFUSED(status, parts, riis_valve_create_from_patches(&arrays.patches, &made)); \
    assert_null(made);                                                                    \
  } while (0)

/* Checks that the square is refused after the change. The next change is made to a new square. */
#define CHANGED_IS_REFUSED(change, status, parts) \
  do {                                            \
    shape square = unit_square();                 \
    arrays_of_shape arrays;                       \
    arrays_from(&square, &arrays);                \
    change;                                       \
    REFUSED(status, parts);                       \
  } while (0)

static void nulls_are_named(void **state) {
  (void)state;
  shape square = unit_square();
  arrays_of_shape arrays;
  riis_valve *valve = valve_from(&square), *none = NULL;
  arrays_from(&square, &arrays);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "patches is NULL", riis_patches_init(NULL, 72));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "patches is NULL", riis_valve_create_from_patches(NULL, &none));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL", riis_valve_create_from_patches(&arrays.patches, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL", riis_valve_set_open_state(NULL, valve));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "open is NULL", riis_valve_set_open_state(valve, NULL));
  assert_null(none);
  riis_surface *surface = NULL;
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "open is a handle of another kind",
                riis_valve_set_open_state(valve, (const void *)surface));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is a handle of another kind",
                riis_valve_set_open_state((void *)surface, valve));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

static void null_arrays_are_named(void **state) {
  (void)state;
  CHANGED_IS_REFUSED(arrays.patches.degree = NULL, RIIS_INVALID_ARGUMENT, "patches.degree is NULL");
  CHANGED_IS_REFUSED(arrays.patches.control = NULL, RIIS_INVALID_ARGUMENT, "patches.control is NULL");
  CHANGED_IS_REFUSED(arrays.patches.curve_id = NULL, RIIS_INVALID_ARGUMENT, "patches.curve_id is NULL");
}

static void struct_sizes_are_checked(void **state) {
  (void)state;
  static const int64_t sizes[] = {-72, 0, 8, 64, 71, 73, 80, INT64_MIN, INT64_MAX};
  shape square = unit_square();
  arrays_of_shape arrays;
  arrays_from(&square, &arrays);
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
    const riis_patches before = arrays.patches;
    char text[64];
    snprintf(text, sizeof text, "struct size of patches is %lld;", (long long)sizes[i]);
    CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, text, riis_patches_init(&arrays.patches, sizes[i]));
    assert_memory_equal(&before, &arrays.patches, sizeof before);
    arrays.patches.struct_size = sizes[i];
    REFUSED(RIIS_INVALID_STRUCT_SIZE, text);
    arrays.patches.struct_size = sizeof arrays.patches;
  }
}

static void counts_are_checked(void **state) {
  (void)state;
  CHANGED_IS_REFUSED(arrays.patches.n_curves = 0, RIIS_INVALID_ARGUMENT, "patches.n_curves is 0;|from 1 to 4000000");
  CHANGED_IS_REFUSED(arrays.patches.n_curves = -1, RIIS_INVALID_ARGUMENT, "patches.n_curves is -1;");
  CHANGED_IS_REFUSED(arrays.patches.n_curves = 4000001, RIIS_INVALID_ARGUMENT, "patches.n_curves is 4000001;");
  CHANGED_IS_REFUSED(arrays.patches.n_curves = INT64_MAX, RIIS_INVALID_ARGUMENT,
                     "patches.n_curves is 9223372036854775807");
  CHANGED_IS_REFUSED(arrays.patches.n_patches = 0, RIIS_INVALID_ARGUMENT, "patches.n_patches is 0;|from 1 to 1000000");
  CHANGED_IS_REFUSED(arrays.patches.n_patches = -1, RIIS_INVALID_ARGUMENT, "patches.n_patches is -1;");
  CHANGED_IS_REFUSED(arrays.patches.n_patches = 1000001, RIIS_INVALID_ARGUMENT, "patches.n_patches is 1000001;");
  CHANGED_IS_REFUSED(arrays.patches.n_patches = INT64_MIN, RIIS_INVALID_ARGUMENT,
                     "patches.n_patches is -9223372036854775808");
  CHANGED_IS_REFUSED(arrays.patches.index_base = 2, RIIS_INVALID_ARGUMENT,
                     "patches.index_base is 2; it must be 0 or 1");
  CHANGED_IS_REFUSED(arrays.patches.index_base = -1, RIIS_INVALID_ARGUMENT, "patches.index_base is -1;");
  CHANGED_IS_REFUSED(arrays.patches.reserved = 1, RIIS_INVALID_ARGUMENT, "patches.reserved is 1; it must be 0");
}

static void curves_are_checked(void **state) {
  (void)state;
  CHANGED_IS_REFUSED(square.degree[2] = 0, RIIS_INVALID_PARAMETER, "degree of curve 2 is 0; it must be 1, 2 or 3");
  CHANGED_IS_REFUSED(square.degree[2] = 4, RIIS_INVALID_PARAMETER, "degree of curve 2 is 4;");
  CHANGED_IS_REFUSED(square.degree[0] = -1, RIIS_INVALID_PARAMETER, "degree of curve 0 is -1;");
  CHANGED_IS_REFUSED(square.degree[3] = INT32_MAX, RIIS_INVALID_PARAMETER, "degree of curve 3 is 2147483647;");
  /* Each line has six numbers. */
  CHANGED_IS_REFUSED(arrays.control[23] = NAN, RIIS_INVALID_PARAMETER,
                     "z of control point 1 of curve 3 is nan;|at most 1e+30");
  CHANGED_IS_REFUSED(arrays.control[0] = -INFINITY, RIIS_INVALID_PARAMETER, "x of control point 0 of curve 0 is -inf;");
  CHANGED_IS_REFUSED(arrays.control[13] = 1e31, RIIS_INVALID_PARAMETER, "y of control point 0 of curve 2 is 1e+31;");
  CHANGED_IS_REFUSED(arrays.control[13] = -1.0000000000000002e30, RIIS_INVALID_PARAMETER,
                     "y of control point 0 of curve 2 is -1");
}

static void sides_are_checked(void **state) {
  (void)state;
  CHANGED_IS_REFUSED(square.curve_id[2] = -1, RIIS_INVALID_PARAMETER,
                     "side u = 0 of patch 0 is curve -1; there are curves 0 to 3");
  CHANGED_IS_REFUSED(square.curve_id[0] = 4, RIIS_INVALID_PARAMETER, "side v = 0 of patch 0 is curve 4;|0 to 3");
  CHANGED_IS_REFUSED(square.curve_id[1] = INT32_MAX, RIIS_INVALID_PARAMETER,
                     "side v = 1 of patch 0 is curve 2147483647");
  CHANGED_IS_REFUSED(arrays.patches.index_base = 1, RIIS_INVALID_PARAMETER,
                     "side v = 0 of patch 0 is curve 0; there are curves 1 to 4");
  CHANGED_IS_REFUSED((arrays.patches.index_base = 1, square.curve_id[0] = 1, square.curve_id[3] = 5),
                     RIIS_INVALID_PARAMETER, "side u = 1 of patch 0 is curve 5;|1 to 4");
  CHANGED_IS_REFUSED((arrays.patches.index_base = 1, square.curve_id[0] = INT32_MIN), RIIS_INVALID_PARAMETER,
                     "side v = 0 of patch 0 is curve -2147483648");
  CHANGED_IS_REFUSED(square.reversed[1] = 2, RIIS_INVALID_PARAMETER,
                     "reversed of side v = 1 of patch 0 is 2; it must be 0 or 1");
  CHANGED_IS_REFUSED(square.reversed[3] = -1, RIIS_INVALID_PARAMETER, "reversed of side u = 1 of patch 0 is -1;");
  CHANGED_IS_REFUSED(square.leaflet_id[0] = -1, RIIS_INVALID_PARAMETER,
                     "leaflet_id of patch 0 is -1; it must be at least 0");
  /* The message also names a later patch. */
  CHANGED_IS_REFUSED((add_patch(&square, 0, 1, 2, 7), arrays.patches.n_patches = 2), RIIS_INVALID_PARAMETER,
                     "side u = 1 of patch 1 is curve 7");
}

static void sides_have_to_meet(void **state) {
  (void)state;
  CHANGED_IS_REFUSED(
      arrays.control[3] = 1.5, RIIS_INVALID_PARAMETER,
      "patch 0 does not close: side v = 0 ends in (1.5, 0, 0), side u = 1 begins in (1, 0, 0);|reverse it");
  CHANGED_IS_REFUSED(arrays.control[2] = 0.25, RIIS_INVALID_PARAMETER,
                     "side v = 0 begins in (0, 0, 0.25), side u = 0 begins in (0, 0, 0)");
  CHANGED_IS_REFUSED(arrays.control[16] = 2, RIIS_INVALID_PARAMETER,
                     "side v = 1 begins in (0, 1, 0), side u = 0 ends in (0, 2, 0)");
  CHANGED_IS_REFUSED(arrays.control[21] = 3, RIIS_INVALID_PARAMETER,
                     "side v = 1 ends in (1, 1, 0), side u = 1 ends in (3, 1, 0)");
  CHANGED_IS_REFUSED(square.reversed[1] = 1, RIIS_INVALID_PARAMETER,
                     "side v = 1 begins in (1, 1, 0), side u = 0 ends in (0, 1, 0)");
  /* A gap of up to 1e-9 of the size, which is sqrt(2), counts as the caller's rounding. */
  CHANGED_IS_REFUSED(arrays.control[5] = 2e-9, RIIS_INVALID_PARAMETER, "patch 0 does not close");
  shape nearly = unit_square();
  nearly.control[0][1][2] = 1e-9;
  riis_surface *surface = surface_of(&nearly, NULL);
  CHECK_NEAR(info_of(surface).area, 1, 1e-8);
  riis_surface_destroy(&surface);
}

static void open_states_are_built_alike(void **state) {
  (void)state;
  const shape square = unit_square();
  shape raised = square;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 2; ++k) raised.control[i][k][2] = 1;
  riis_valve *valve = valve_from(&square), *good = valve_from(&raised), *aortic = NULL;
  riis_surface *surface = NULL;
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "opening is 1|one state only|riis_valve_set_open_state",
                riis_surface_create(valve, NULL, &surface));
  assert_null(surface);
  CHECK_OK(riis_valve_set_open_state(valve, good));
  CHECK_OK(riis_valve_create("aortic", &aortic));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "aortic", riis_valve_set_open_state(valve, aortic));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "aortic", riis_valve_set_open_state(aortic, valve));
#define OPEN_IS_REFUSED(change, parts)                                                   \
  do {                                                                                   \
    shape other = raised;                                                                \
    change;                                                                              \
    riis_valve *bad = valve_from(&other);                                                \
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, parts, riis_valve_set_open_state(valve, bad)); \
    riis_valve_destroy(&bad);                                                            \
  } while (0)
  OPEN_IS_REFUSED((add_line(&other, 0, 0, 1, 1, 0, 1), add_patch(&other, 4, 1, 2, 3)),
                  "open state has 5 curves and 2 patches, the valve 4 and 1");
  OPEN_IS_REFUSED(add_patch(&other, 0, 1, 2, 3), "open state has 4 curves and 2 patches");
  OPEN_IS_REFUSED((other.degree[1] = 3, memcpy(other.control[1][3], other.control[1][1], sizeof other.control[1][3])),
                  "curve 1 is cubic in the open state only");
  OPEN_IS_REFUSED((other.curve_id[0] = 2, other.curve_id[1] = 3, other.curve_id[2] = 0, other.curve_id[3] = 1),
                  "patch 0 has other sides in the open state");
  OPEN_IS_REFUSED((other.reversed[0] = 1, other.reversed[1] = 1, other.curve_id[2] = 3, other.curve_id[3] = 2),
                  "patch 0 has other sides in the open state");
#undef OPEN_IS_REFUSED
  /* The open state that it had is still there. */
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  CHECK_SAME(info_of(surface).lower[2], 1);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&aortic);
  riis_valve_destroy(&good);
  riis_valve_destroy(&valve);
}

static void opening_is_the_only_parameter(void **state) {
  (void)state;
  const shape square = unit_square();
  riis_valve *valve = valve_from(&square), *none = NULL;
  riis_parameter parameter;
  int64_t n = 0;
  double value = -1;
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'patches' is not a kind of valve", riis_valve_create("patches", &none));
  assert_null(none);
  CHECK_OK(riis_valve_n_parameters(valve, &n));
  assert_int_equal(n, 1);
  CHECK_OK(riis_valve_parameter(valve, 0, &parameter, sizeof parameter));
  assert_string_equal(parameter.name, "opening");
  assert_int_equal(parameter.n_values, 1);
  CHECK_SAME(parameter.default_values[0], 0);
  CHECK_SAME(parameter.minimum, 0);
  CHECK_SAME(parameter.maximum, 1);
  CHECK_OK(riis_valve_get(valve, "opening", 1, &value));
  CHECK_SAME(value, 0);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "opening|1.5|0 to 1", riis_valve_set_scalar(valve, "opening", 1.5));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "opening|-0.1", riis_valve_set_scalar(valve, "opening", -0.1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "opening|nan", riis_valve_set_scalar(valve, "opening", NAN));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "root_radius", riis_valve_set_scalar(valve, "root_radius", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "root_radius", riis_valve_get(valve, "root_radius", 1, &value));
  riis_valve_destroy(&valve);
}

static void patches_without_area_make_no_surface(void **state) {
  (void)state;
  shape flat = unit_square(); /* flattened to a line, to a point, to nearly nothing */
  for (int attempt = 0; attempt < 3; ++attempt) {
    const double scale[3][2] = {{1, 0}, {0, 0}, {1e-200, 1e-200}};
    shape made = flat;
    riis_surface *surface = NULL;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 2; ++k)
        for (int c = 0; c < 2; ++c) made.control[i][k][c] *= scale[attempt][c];
    riis_valve *valve = valve_from(&made);
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, "has no area", riis_surface_create(valve, NULL, &surface));
    assert_null(surface);
    riis_valve_destroy(&valve);
  }
}

/* A crescent much thinner than the tolerance is still there, because its sides become finer instead of one common chord. */
static void a_patch_thinner_than_the_tolerance_stays(void **state) {
  (void)state;
  for (double sagitta = 0.04; sagitta > 1e-6; sagitta /= 10) {
    shape made = unit_square();
    const double y = 4; /* away from the square, which gets the tolerance alone */
    const int32_t straight = (int32_t)made.n_curves;
    add_line(&made, 0, y, 0, 1, y, 0);
    const int32_t bent = (int32_t)made.n_curves;
    add_line(&made, 0, y, 0, 1, y, 0);
    made.degree[bent] = 2;
    memcpy(made.control[bent][2], made.control[bent][1], sizeof made.control[bent][2]);
    made.control[bent][1][0] = 0.5;
    made.control[bent][1][1] = y + 2 * sagitta;
    const int32_t first = (int32_t)made.n_curves;
    add_line(&made, 0, y, 0, 0, y, 0);
    const int32_t last = (int32_t)made.n_curves;
    add_line(&made, 1, y, 0, 1, y, 0);
    add_patch(&made, straight, bent, first, last);
    riis_surface_options options = surface_options();
    options.tolerance = 1;
    riis_surface *surface = surface_of(&made, &options);
    for (double x = 0; x <= 1; x += 0.125)
      CHECK_AT_MOST(closest_to(surface, x, y + sagitta * 2 * x * (1 - x), 0).distance, 0.1 * options.tolerance);
    riis_surface_destroy(&surface);
  }
}

static void a_curve_without_a_patch_is_refused(void **state) {
  (void)state;
  shape made = unit_square();
  add_line(&made, 0, 0, 0, 1e9, 0, 0);
  arrays_of_shape arrays;
  arrays_from(&made, &arrays);
  riis_valve *valve = NULL;
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "curve 4 is a side of no patch",
                riis_valve_create_from_patches(&arrays.patches, &valve));
}

/* ------------------------------------------------------------------------------------------------------------------ *
 * Surfaces
 * ------------------------------------------------------------------------------------------------------------------ */

static void square_has_its_area_and_normal(void **state) {
  (void)state;
  shape square = unit_square();
  square.leaflet_id[0] = 5;
  riis_surface *surface = surface_of(&square, NULL);
  const riis_surface_info info = info_of(surface);
  CHECK_NEAR(info.area, 1, 1e-15);
  assert_int_equal(info.n_triangles, 2);
  assert_int_equal(info.n_vertices, 4);
  assert_int_equal(info.n_zero_area, 0);
  riis_closest above = closest_to(surface, 0.3, 0.6, 2);
  CHECK_NEAR(above.distance, 2, 1e-15);
  CHECK_NEAR(above.normal[2], 1, 1e-15);
  assert_int_equal(above.side, 1);
  assert_int_equal(above.leaflet_id, 5);
  const surface_content all = surface_content_of(surface);
  for (int64_t i = 0; i < all.n_vertices; ++i) /* u is x and v is y */
    for (int c = 0; c < 2; ++c) CHECK_SAME(all.uv[2 * i + c], all.xyz[3 * i + c]);
  riis_surface_destroy(&surface);

  square.n_patches = 0; /* u and v change places */
  add_patch(&square, 2, 3, 0, 1);
  surface = surface_of(&square, NULL);
  above = closest_to(surface, 0.3, 0.6, 2);
  CHECK_NEAR(above.normal[2], -1, 1e-15);
  assert_int_equal(above.side, -1);
  riis_surface_destroy(&surface);
}

/* A wavy patch with curves of every degree. Coordinates are small multiples of 1/8: blending does not round. */
static shape wavy(void) {
  static const double v0[4][3] = {{0, 0, 0}, {0.375, -0.25, 0.5}, {0.75, 0.25, -0.25}, {1.25, 0, 0.125}};
  static const double v1[3][3] = {{0, 1, 0.25}, {0.5, 1.5, 0.75}, {1, 1.25, 0}};
  static const double u0[4][3] = {{0, 0, 0}, {-0.25, 0.25, 0.25}, {0.125, 0.75, 0.5}, {0, 1, 0.25}};
  shape made = {0};
  add_curve(&made, 3, v0);
  add_curve(&made, 2, v1);
  add_curve(&made, 3, u0);
  add_line(&made, 1.25, 0, 0.125, 1, 1.25, 0);
  add_patch(&made, 0, 1, 2, 3);
  return made;
}

static void both_bases_and_no_optional_arrays_give_the_same(void **state) {
  (void)state;
  const shape from = wavy();
  shape one_based = from;
  arrays_of_shape arrays;
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  for (int i = 0; i < 4; ++i) ++one_based.curve_id[i];
  arrays_from(&one_based, &arrays);
  arrays.patches.index_base = 1;
  arrays.patches.reversed = NULL;
  arrays.patches.leaflet_id = NULL;
  CHECK_OK(riis_valve_create_from_patches(&arrays.patches, &valve));
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  riis_valve_destroy(&valve);
  check_same_surfaces(surface, surface_of(&from, NULL));
}

static void line_of_any_degree_gives_the_same_surface(void **state) {
  (void)state;
  const shape from = wavy();
  const double *a = from.control[3][0], *b = from.control[3][1];
  /* The degree, and the places of the inner control points on the line: even and uneven ones. */
  const struct {
    int32_t degree;
    double at[2];
  } other[4] = {{2, {0.5}}, {2, {0.125}}, {3, {1.0 / 3, 2.0 / 3}}, {3, {0.125, 0.25}}};
  for (int i = 0; i < 4; ++i) {
    shape changed = from;
    changed.degree[3] = other[i].degree;
    for (int k = 1; k < other[i].degree; ++k)
      for (int c = 0; c < 3; ++c) changed.control[3][k][c] = a[c] + other[i].at[k - 1] * (b[c] - a[c]);
    memcpy(changed.control[3][other[i].degree], b, sizeof changed.control[3][0]);
    check_same_surfaces(surface_of(&from, NULL), surface_of(&changed, NULL));
  }
}

/* A point of a Bezier curve by Bernstein polynomials. */
static void bezier_point(const shape *from, int64_t curve, double t, double *p) {
  static const double binomial[4][4] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
  const int n = from->degree[curve];
  for (int c = 0; c < 3; ++c) p[c] = 0;
  for (int k = 0; k <= n; ++k)
    for (int c = 0; c < 3; ++c) p[c] += binomial[n][k] * pow(t, k) * pow(1 - t, n - k) * from->control[curve][k][c];
}

enum { n_steps = 4000, n_dense = 120 };

/* Makes points at shares 0, 1 / n_dense, 2 / n_dense, ... of the curve's length, measured along n_steps chords. */
static void points_by_length(const shape *from, int side, double (*points)[3]) {
  static double fine[n_steps + 1][3], length[n_steps + 1];
  const int64_t curve = from->curve_id[side];
  for (int i = 0; i <= n_steps; ++i) {
    bezier_point(from, curve, (double)i / n_steps, fine[i]);
    length[i] = 0;
    if (i > 0) {
      for (int c = 0; c < 3; ++c) length[i] += (fine[i][c] - fine[i - 1][c]) * (fine[i][c] - fine[i - 1][c]);
      length[i] = length[i - 1] + sqrt(length[i]);
    }
  }
  for (int j = 0, i = 0; j <= n_dense; ++j) {
    const double wanted = length[n_steps] * j / n_dense;
    while (i + 1 < n_steps && length[i + 1] < wanted) ++i;
    const double step = length[i + 1] - length[i], rest = step > 0 ? (wanted - length[i]) / step : 0;
    const int to = from->reversed[side] ? n_dense - j : j;
    for (int c = 0; c < 3; ++c) points[to][c] = fine[i][c] + rest * (fine[i + 1][c] - fine[i][c]);
  }
}

/* Makes a surface from arrays: the first patch of the shape by Coons' formula. */
static riis_surface *dense_surface(const shape *from) {
  static double side[4][n_dense + 1][3], xyz[(n_dense + 1) * (n_dense + 1)][3];
  static int32_t quads[n_dense * n_dense][4];
  for (int k = 0; k < 4; ++k) points_by_length(from, k, side[k]);
  for (int j = 0; j <= n_dense; ++j)
    for (int i = 0; i <= n_dense; ++i) {
      const double u = (double)i / n_dense, v = (double)j / n_dense;
      for (int c = 0; c < 3; ++c)
        xyz[j * (n_dense + 1) + i][c] = (1 - v) * side[0][i][c] + v * side[1][i][c] + (1 - u) * side[2][j][c] +
                                        u * side[3][j][c] - (1 - u) * (1 - v) * side[0][0][c] -
                                        u * (1 - v) * side[0][n_dense][c] - (1 - u) * v * side[1][0][c] -
                                        u * v * side[1][n_dense][c];
    }
  for (int32_t j = 0; j < n_dense; ++j)
    for (int32_t i = 0; i < n_dense; ++i) {
      const int32_t first = j * (n_dense + 1) + i;
      int32_t *quad = quads[j * n_dense + i];
      quad[0] = first, quad[1] = first + 1, quad[2] = first + n_dense + 2, quad[3] = first + n_dense + 1;
    }
  riis_surface_arrays arrays = triangle_arrays((n_dense + 1) * (n_dense + 1), xyz[0], n_dense * n_dense, quads[0]);
  riis_surface_options options = surface_options();
  arrays.corners_per_face = 4;
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  return surface_from(&arrays, &options);
}

/* The largest distance to a surface from the vertices and middles of another surface's triangles. */
static double largest_distance(const riis_surface *to, const riis_surface *from) {
  const surface_content all = surface_content_of(from);
  double largest = 0;
  for (int64_t i = 0; i < all.n_triangles; ++i) {
    const double *a = all.xyz + 3 * all.vertex_id[3 * i], *b = all.xyz + 3 * all.vertex_id[3 * i + 1],
                 *c = all.xyz + 3 * all.vertex_id[3 * i + 2];
    static const double weight[7][3] = {
        {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {1. / 3, 1. / 3, 1. / 3}};
    for (int k = 0; k < 7; ++k) {
      double p[3];
      for (int x = 0; x < 3; ++x) p[x] = weight[k][0] * a[x] + weight[k][1] * b[x] + weight[k][2] * c[x];
      largest = fmax(largest, closest_to(to, p[0], p[1], p[2]).distance);
    }
  }
  return largest;
}

/* The dense surface is itself right to about 1e-4. */
static void check_against_dense(const shape *from, double tolerance) {
  riis_surface_options options = surface_options();
  options.tolerance = tolerance;
  riis_surface *dense = dense_surface(from), *surface = surface_of(from, &options);
  const double bound = tolerance * info_of(surface).half_thickness + 1e-4;
  const double there = largest_distance(surface, dense), back = largest_distance(dense, surface);
  riis_surface_destroy(&surface);
  riis_surface_destroy(&dense);
  CHECK_AT_MOST(there, bound);
  CHECK_AT_MOST(back, bound);
}

static void patch_is_the_coons_patch_of_its_sides(void **state) {
  (void)state;
  shape arcs = unit_square(); /* two sides nearly circular */
  const double arc0[4][3] = {{0, 0, 0}, {0, 0, 0.6667}, {1, 0, 0.6667}, {1, 0, 0}};
  const double arc1[4][3] = {{0, 0, 0}, {-0.2, 0.3, 0}, {-0.2, 0.7, 0}, {0, 1, 0}};
  arcs.degree[0] = arcs.degree[2] = 3;
  memcpy(arcs.control[0], arc0, sizeof arc0);
  memcpy(arcs.control[2], arc1, sizeof arc1);
  check_against_dense(&arcs, 0.05);
  const shape from = wavy();
  check_against_dense(&from, 0.2);
  check_against_dense(&from, 0.01);
}

static void random_patches_are_coons_patches(void **state) {
  (void)state;
  random_source rng = random_start("random_patches_are_coons_patches");
  for (int trial = 0; trial < 6; ++trial) {
    shape from = {0};
    const double corner[4][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    double p[4][3]; /* the corners, moved */
    const int ends[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 3; ++c) p[k][c] = (c < 2 ? corner[k][c] : 0) + random_between(&rng, -0.3, 0.3);
    for (int side = 0; side < 4; ++side) {
      const int degree = 1 + (int)(random_bits(&rng) % 3), turned = (int)(random_bits(&rng) % 2);
      const double *a = p[ends[side][turned]], *b = p[ends[side][1 - turned]];
      double control[4][3];
      for (int k = 0; k <= degree; ++k)
        for (int c = 0; c < 3; ++c)
          control[k][c] = k == 0        ? a[c]
                          : k == degree ? b[c]
                                        : a[c] + (b[c] - a[c]) * k / degree + random_between(&rng, -0.3, 0.3);
      add_curve(&from, degree, (const double(*)[3])control);
      from.reversed[side] = turned;
    }
    add_patch(&from, 0, 1, 2, 3);
    check_against_dense(&from, 0.05);
  }
}

/* Two patches on both sides of a shared curve from (0, 0, 0) to (0, 1, z), which is u = 1 of both. The second patch is turned by
 * half a circle, so its v runs backwards along the curve. */
static shape pair_of_patches(double z) {
  const double shared[4][3] = {{0, 0, 0}, {0.5, 0.25, z}, {-0.25, 0.75, 3 * z}, {0, 1, z}};
  const double far[3][3] = {{2, 1, 0}, {2.5, 0.5, 2 * z}, {2, 0, z}};
  shape pair = {0};
  add_curve(&pair, 3, shared);
  add_line(&pair, -1, 0, 0, 0, 0, 0);
  add_line(&pair, -1, 1, 0, 0, 1, z);
  add_line(&pair, -1, 0, 0, -1, 1, 0);
  add_line(&pair, 2, 1, 0, 0, 1, z);
  add_line(&pair, 0, 0, 0, 2, 0, z); /* also backwards */
  add_curve(&pair, 2, far);
  add_patch(&pair, 1, 2, 3, 0);
  add_patch(&pair, 4, 5, 6, 0);
  pair.reversed[4 + 1] = 1;
  pair.reversed[4 + 3] = 1;
  return pair;
}

/* The vertices at u = 1 of a patch in the order of v, each once. The second patch's v is reversed. */
typedef struct {
  double v, p[3];
} boundary_vertex;

static int by_v(const void *a, const void *b) {
  const double v = ((const boundary_vertex *)a)->v, w = ((const boundary_vertex *)b)->v;
  return (v > w) - (v < w);
}

static int boundary(const surface_content *all, int32_t patch, boundary_vertex *out, int most) {
  int n = 0, n_kept = 0;
  for (int64_t i = 0; i < 3 * all->n_triangles; ++i) {
    const int64_t id = all->vertex_id[i];
    if (all->patch_id[i / 3] != patch || all->uv[2 * id] != 1) continue;
    assert_true(n < most);
    out[n].v = patch ? 1 - all->uv[2 * id + 1] : all->uv[2 * id + 1];
    memcpy(out[n++].p, all->xyz + 3 * id, sizeof out->p);
  }
  qsort(out, (size_t)n, sizeof *out, by_v);
  for (int i = 0; i < n; ++i) {
    if (n_kept > 0 && out[n_kept - 1].v == out[i].v) {
      for (int c = 0; c < 3; ++c) CHECK_NEAR(out[i].p[c], out[n_kept - 1].p[c], 1e-15);
      continue;
    }
    out[n_kept++] = out[i];
  }
  return n_kept;
}

/* The distance of a vertex from a polyline. */
static double distance_to_polyline(const double *p, const boundary_vertex *line, int n) {
  double smallest = INFINITY;
  for (int i = 0; i + 1 < n; ++i) {
    double ab_ab = 0, ab_ap = 0, sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double ab = line[i + 1].p[c] - line[i].p[c];
      ab_ab += ab * ab, ab_ap += ab * (p[c] - line[i].p[c]);
    }
    const double t = fmin(fmax(ab_ap / ab_ab, 0), 1);
    for (int c = 0; c < 3; ++c) {
      const double d = p[c] - line[i].p[c] - t * (line[i + 1].p[c] - line[i].p[c]);
      sum += d * d;
    }
    smallest = fmin(smallest, sqrt(sum));
  }
  return smallest;
}

/* A patch with the shared curve at u = 1 and the same curve, moved, at u = 0. Its quads are plane and never split, so its
 * vertices at u = 1 are the curve's polyline. */
static shape strip_along_shared_curve(const shape *pair) {
  shape strip = {0};
  double moved[4][3];
  memcpy(moved, pair->control[0], sizeof moved);
  for (int k = 0; k < 4; ++k) moved[k][0] -= 1;
  add_curve(&strip, 3, (const double(*)[3])pair->control[0]);
  add_curve(&strip, 3, (const double(*)[3])moved);
  add_line(&strip, moved[0][0], moved[0][1], moved[0][2], 0, 0, 0);
  add_line(&strip, moved[3][0], moved[3][1], moved[3][2], 0, 1, moved[3][2]);
  add_patch(&strip, 2, 3, 1, 0);
  return strip;
}

static void check_holds(const boundary_vertex *some, int n, const boundary_vertex *vertex) {
  const boundary_vertex *found = bsearch(vertex, some, (size_t)n, sizeof *some, by_v);
  assert_non_null(found);
  for (int c = 0; c < 3; ++c) CHECK_SAME(found->p[c], vertex->p[c]);
}

static void shared_curves_leave_no_cracks(void **state) {
  (void)state;
  enum { most = 50000 };
  static boundary_vertex a[most], b[most], of_curve[most];
  for (int is_plane = 0; is_plane < 2; ++is_plane) {
    shape pair = pair_of_patches(is_plane ? 0 : 0.25);
    if (is_plane) { /* the far side is also straight, so all grid lines come from the shared curve */
      pair.degree[6] = 1;
      memcpy(pair.control[6][1], pair.control[6][2], sizeof pair.control[6][1]);
    }
    const shape strip = strip_along_shared_curve(&pair);
    riis_surface_options options = surface_options();
    options.tolerance = 0.01;
    riis_surface *surface = surface_of(&pair, &options), *alone = surface_of(&strip, &options);
    surface_content all = surface_content_of(surface);
    const int n_a = boundary(&all, 0, a, most), n_b = boundary(&all, 1, b, most);
    all = surface_content_of(alone);
    const int n_of_curve = boundary(&all, 0, of_curve, most);
    assert_true(n_of_curve > 10);
    if (is_plane) assert_true(n_a == n_of_curve && n_b == n_of_curve);
    for (int i = 0; i < n_of_curve; ++i) {
      check_holds(a, n_a, &of_curve[i]);
      check_holds(b, n_b, &of_curve[i]);
    }
    /* Vertices that only one patch has lie on the other's edges, to rounding. */
    for (int i = 0; i < n_a; ++i) CHECK_AT_MOST(distance_to_polyline(a[i].p, b, n_b), 1e-15);
    for (int i = 0; i < n_b; ++i) CHECK_AT_MOST(distance_to_polyline(b[i].p, a, n_a), 1e-15);
    /* The normals of both are along S_u x S_v. */
    assert_int_equal(closest_to(surface, -0.5, 0.5, 5).side, 1);
    assert_int_equal(closest_to(surface, 1.5, 0.5, 5).side, 1);
    riis_surface_destroy(&alone);
    riis_surface_destroy(&surface);
  }
}

static void collapsed_sides_leave_no_triangles_without_area(void **state) {
  (void)state;
  const double up[4][3] = {{0, 0, 0}, {0.25, 1, 0.5}, {0.75, 1, 0.5}, {1, 0, 0}};
  const double area[2] = {0.5, 0};
  for (int which = 0; which < 2; ++which) {
    shape from = {0};
    add_line(&from, 0, 0, 0, 1, 0, 0);
    if (which == 0) { /* a triangle: v = 1 is collapsed */
      add_line(&from, 0, 1, 0, 0, 1, 0);
      add_line(&from, 0, 0, 0, 0, 1, 0);
      add_line(&from, 1, 0, 0, 0, 1, 0);
    } else { /* a chord and an arc: u = 0 and u = 1 are collapsed */
      add_curve(&from, 3, up);
      add_line(&from, 0, 0, 0, 0, 0, 0);
      add_line(&from, 1, 0, 0, 1, 0, 0);
    }
    add_patch(&from, 0, 1, 2, 3);
    riis_surface *surface = surface_of(&from, NULL);
    const riis_surface_info info = info_of(surface);
    const surface_content all = surface_content_of(surface);
    assert_true(info.n_triangles > 0 && info.n_zero_area > 0);
    if (area[which] > 0) CHECK_NEAR(info.area, area[which], 1e-14);
    for (int64_t i = 0; i < all.n_triangles; ++i) {
      const double *a = all.xyz + 3 * all.vertex_id[3 * i], *b = all.xyz + 3 * all.vertex_id[3 * i + 1],
                   *c = all.xyz + 3 * all.vertex_id[3 * i + 2];
      double size = 0, longest = 0;
      for (int x = 0; x < 3; ++x) {
        const int y = (x + 1) % 3, z = (x + 2) % 3;
        const double n = (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
        size += n * n;
        longest = fmax(longest, fmax(fabs(b[x] - a[x]), fmax(fabs(c[x] - b[x]), fabs(a[x] - c[x]))));
      }
      assert_true(sqrt(size) > 1e-12 * longest * longest);
    }
    riis_surface_destroy(&surface);
    check_against_dense(&from, 0.05);
  }
}

static void opening_blends_control_points(void **state) {
  (void)state;
  const shape closed = wavy();
  shape open = closed, middle = closed;
  for (int64_t i = 0; i < closed.n_curves; ++i)
    for (int k = 0; k <= closed.degree[i]; ++k)
      for (int c = 0; c < 3; ++c) {
        /* A shear and a lift, so that corners stay corners. */
        open.control[i][k][c] += c == 2 ? 0.5 + closed.control[i][k][0] : 0.25 * closed.control[i][k][2];
        middle.control[i][k][c] = 0.5 * (closed.control[i][k][c] + open.control[i][k][c]);
      }
  const shape *expected[3] = {&closed, &middle, &open};
  riis_valve *valve = valve_from(&closed), *other = valve_from(&open);
  CHECK_OK(riis_valve_set_scalar(other, "opening", 0.25)); /* has no effect */
  CHECK_OK(riis_valve_set_open_state(valve, other));
  riis_valve_destroy(&other);
  for (int step = 0; step <= 2; ++step) {
    riis_surface *surface = NULL;
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5 * step));
    CHECK_OK(riis_surface_create(valve, NULL, &surface));
    check_same_surfaces(surface, surface_of(expected[step], NULL));
  }
  /* The valve may also be its own open state. */
  CHECK_OK(riis_valve_set_open_state(valve, valve));
  riis_surface *surface = NULL;
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  riis_valve_destroy(&valve);
  check_same_surfaces(surface, surface_of(&closed, NULL));
}

static void sizes_are_limited_by_precision_and_number(void **state) {
  (void)state;
  shape large = unit_square();
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 2; ++k)
      for (int c = 0; c < 3; ++c) large.control[i][k][c] *= 1e30;
  riis_surface_options options = surface_options();
  options.half_thickness = 1e29;
  riis_surface *surface = surface_of(&large, &options);
  CHECK_NEAR(info_of(surface).area, 1e60, 1e46);
  riis_surface_destroy(&surface);
  riis_valve *valve = valve_from(&large);
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "coordinates up to 1e+30", riis_surface_create(valve, NULL, &surface));
  riis_valve_destroy(&valve);

  const shape from = wavy();
  valve = valve_from(&from);
  options.half_thickness = 1e-3;
  options.tolerance = 1e-6;
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "more than 16777216 triangles", riis_surface_create(valve, &options, &surface));
  assert_null(surface);
  riis_valve_destroy(&valve);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nulls_are_named),
      cmocka_unit_test(null_arrays_are_named),
      cmocka_unit_test(struct_sizes_are_checked),
      cmocka_unit_test(counts_are_checked),
      cmocka_unit_test(curves_are_checked),
      cmocka_unit_test(sides_are_checked),
      cmocka_unit_test(sides_have_to_meet),
      cmocka_unit_test(open_states_are_built_alike),
      cmocka_unit_test(opening_is_the_only_parameter),
      cmocka_unit_test(patches_without_area_make_no_surface),
      cmocka_unit_test(a_patch_thinner_than_the_tolerance_stays),
      cmocka_unit_test(a_curve_without_a_patch_is_refused),
      cmocka_unit_test(square_has_its_area_and_normal),
      cmocka_unit_test(both_bases_and_no_optional_arrays_give_the_same),
      cmocka_unit_test(line_of_any_degree_gives_the_same_surface),
      cmocka_unit_test(patch_is_the_coons_patch_of_its_sides),
      cmocka_unit_test(random_patches_are_coons_patches),
      cmocka_unit_test(shared_curves_leave_no_cracks),
      cmocka_unit_test(collapsed_sides_leave_no_triangles_without_area),
      cmocka_unit_test(opening_blends_control_points),
      cmocka_unit_test(sizes_are_limited_by_precision_and_number),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
