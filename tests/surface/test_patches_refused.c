/* SPDX-License-Identifier: Apache-2.0
 * Tests each refusal of a valve from the caller's patches, by status and message. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "shapes.h"

#define REFUSED(status, parts)                                                            \
  do {                                                                                    \
    riis_valve *made = NULL;                                                              \
    CHECK_REFUSED(status, parts, riis_valve_create_from_patches(&arrays.patches, &made)); \
    assert_null(made);                                                                    \
  } while (0)

/* Changes a new square and checks that it is refused. */
#define CHANGED_IS_REFUSED(change, status, parts) \
  do {                                            \
    shape square = unit_square();                 \
    arrays_of_shape arrays;                       \
    arrays_from(&square, &arrays);                \
    change;                                       \
    REFUSED(status, parts);                       \
  } while (0)

TEST(nulls_are_named) {
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
  riis_surface *surface = new_surface(valve, NULL);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "open is a handle of another kind",
                riis_valve_set_open_state(valve, (const void *)surface));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is a handle of another kind",
                riis_valve_set_open_state((void *)surface, valve));
}

TEST(null_arrays_are_named) {
  CHANGED_IS_REFUSED(arrays.patches.degree = NULL, RIIS_INVALID_ARGUMENT, "patches.degree is NULL");
  CHANGED_IS_REFUSED(arrays.patches.control = NULL, RIIS_INVALID_ARGUMENT, "patches.control is NULL");
  CHANGED_IS_REFUSED(arrays.patches.curve_id = NULL, RIIS_INVALID_ARGUMENT, "patches.curve_id is NULL");
}

TEST(struct_sizes_are_checked) {
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

TEST(counts_are_checked) {
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

TEST(curves_are_checked) {
  CHANGED_IS_REFUSED(square.degree[2] = 0, RIIS_INVALID_PARAMETER, "degree of curve 2 is 0; it must be 1, 2 or 3");
  CHANGED_IS_REFUSED(square.degree[2] = 4, RIIS_INVALID_PARAMETER, "degree of curve 2 is 4;");
  CHANGED_IS_REFUSED(square.degree[0] = -1, RIIS_INVALID_PARAMETER, "degree of curve 0 is -1;");
  CHANGED_IS_REFUSED(square.degree[3] = INT32_MAX, RIIS_INVALID_PARAMETER, "degree of curve 3 is 2147483647;");
  /* The array `control` has six numbers for each straight curve. */
  CHANGED_IS_REFUSED(arrays.control[23] = NAN, RIIS_INVALID_PARAMETER,
                     "z of control point 1 of curve 3 is nan;|at most 1e+30");
  CHANGED_IS_REFUSED(arrays.control[0] = -INFINITY, RIIS_INVALID_PARAMETER, "x of control point 0 of curve 0 is -inf;");
  CHANGED_IS_REFUSED(arrays.control[13] = 1e31, RIIS_INVALID_PARAMETER, "y of control point 0 of curve 2 is 1e+31;");
  CHANGED_IS_REFUSED(arrays.control[13] = -1.0000000000000002e30, RIIS_INVALID_PARAMETER,
                     "y of control point 0 of curve 2 is -1");
}

TEST(sides_are_checked) {
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
  /* A fault in a later patch names that patch. */
  CHANGED_IS_REFUSED((add_patch(&square, 0, 1, 2, 7), arrays.patches.n_patches = 2), RIIS_INVALID_PARAMETER,
                     "side u = 1 of patch 1 is curve 7");
}

TEST(sides_have_to_meet) {
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
  /* A gap of up to 1e-9 of the valve's size counts as the caller's rounding error. The size is sqrt(2) here. */
  CHANGED_IS_REFUSED(arrays.control[5] = 2e-9, RIIS_INVALID_PARAMETER, "patch 0 does not close");
  shape nearly = unit_square();
  nearly.control[0][1][2] = 1e-9;
  riis_surface *surface = surface_of(&nearly, NULL);
  CHECK_NEAR(info_of(surface).area, 1, 1e-8);
}

TEST(open_states_are_built_alike) {
  const shape square = unit_square();
  shape raised = square;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 2; ++k) raised.control[i][k][2] = 1;
  riis_valve *valve = valve_from(&square), *good = valve_from(&raised), *aortic = new_valve("aortic");
  riis_surface *surface = NULL;
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "opening is 1|only one state|riis_valve_set_open_state",
                riis_surface_create(valve, NULL, &surface));
  assert_null(surface);
  CHECK_OK(riis_valve_set_open_state(valve, good));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "aortic", riis_valve_set_open_state(valve, aortic));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "aortic", riis_valve_set_open_state(aortic, valve));
#define OPEN_IS_REFUSED(change, parts)                                                   \
  do {                                                                                   \
    shape other = raised;                                                                \
    change;                                                                              \
    riis_valve *bad = valve_from(&other);                                                \
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, parts, riis_valve_set_open_state(valve, bad)); \
    free_one_owned(bad);                                                                 \
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
  /* After the refusals, the valve still has its earlier open state. */
  surface = new_surface(valve, NULL);
  CHECK_SAME(info_of(surface).lower[2], 1);
}

TEST(opening_and_skirt_are_the_parameters) {
  const shape square = unit_square();
  riis_valve *valve = valve_from(&square), *none = NULL;
  riis_parameter parameter;
  int64_t n = 0;
  double value = -1;
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'patches' is not a kind of valve", riis_valve_create("patches", &none));
  assert_null(none);
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  assert_int_equal(n, 2);
  CHECK_OK(riis_valve_get_parameter(valve, 1, &parameter, sizeof parameter));
  assert_string_equal(parameter.name, "skirt_length");
  CHECK_OK(riis_valve_get_parameter(valve, 0, &parameter, sizeof parameter));
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
}

TEST(patches_without_area_make_no_surface) {
  shape flat = unit_square(); /* each attempt shrinks the curve: to a line, to a point, or to nearly nothing */
  for (int attempt = 0; attempt < 3; ++attempt) {
    const int owned_before = n_owned();
    const double scale[3][2] = {{1, 0}, {0, 0}, {1e-200, 1e-200}};
    shape made = flat;
    riis_surface *surface = NULL;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 2; ++k)
        for (int c = 0; c < 2; ++c) made.control[i][k][c] *= scale[attempt][c];
    riis_valve *valve = valve_from(&made);
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, "has no area", riis_surface_create(valve, NULL, &surface));
    assert_null(surface);
    free_owned_after(owned_before);
  }
}

/* A crescent that is much thinner than the tolerance does not vanish, because its sides are refined until they differ. */
TEST(a_patch_thinner_than_the_tolerance_stays) {
  for (double sagitta = 0.04; sagitta > 1e-6; sagitta /= 10) {
    const int owned_before = n_owned();
    shape made = unit_square();
    const double y = 4; /* away from the unit square, whose triangles may be off by the whole tolerance */
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
    free_owned_after(owned_before);
  }
}

TEST(a_curve_without_a_patch_is_refused) {
  shape made = unit_square();
  add_line(&made, 0, 0, 0, 1e9, 0, 0);
  arrays_of_shape arrays;
  arrays_from(&made, &arrays);
  riis_valve *valve = NULL;
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "curve 4 is a side of no patch",
                riis_valve_create_from_patches(&arrays.patches, &valve));
}

int main(void) { return run_cases(NULL, NULL); }
