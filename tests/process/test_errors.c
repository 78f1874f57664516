/* SPDX-License-Identifier: Apache-2.0
 * Every refusal of the public interface is tested by status and message. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

static const double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1};
static const int32_t ids[3] = {0, 1, 2};

TEST(statuses_have_names) {
  static const char *const names[] = {"RIIS_INTERNAL_ERROR",    "RIIS_OK",
                                      "RIIS_INVALID_ARGUMENT",  "RIIS_INVALID_STRUCT_SIZE",
                                      "RIIS_INVALID_PARAMETER", "RIIS_INVALID_SURFACE",
                                      "RIIS_INVALID_MESH",      "RIIS_LIMIT_EXCEEDED",
                                      "RIIS_OUT_OF_MEMORY",     "RIIS_FILE_ERROR",
                                      "RIIS_UNAVAILABLE"};
  for (int status = -1; status <= 9; ++status) assert_string_equal(riis_status_name(status), names[status + 1]);
  assert_string_equal(riis_status_name(10), "unknown status");
  assert_string_equal(riis_status_name(-2), "unknown status");
}

TEST(version_is_the_headers) {
  char text[32];
  snprintf(text, sizeof text, "%d.%d.%d", RIIS_VERSION_MAJOR, RIIS_VERSION_MINOR, RIIS_VERSION_PATCH);
  assert_string_equal(riis_version_string(), text);
}

TEST(null_arguments_are_named) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *result = NULL;
  riis_surface_arrays arrays = triangle_arrays(4, xyz, 1, ids);
  riis_closest_arrays out;
  riis_triangles triangles;
  riis_mark_list list;
  double values[3] = {0, 0, 0};
  int64_t n;
  int32_t is_set;
  CHECK_OK(riis_valve_create("aortic", &valve));
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  CHECK_OK(riis_mesh_create(4, xyz, xyz + 1, xyz + 2, 3, &mesh));
  CHECK_OK(riis_marks_create(&result));
  CHECK_OK(riis_closest_arrays_init(&out, sizeof out));
#define NULL_IS_NAMED(name, call) CHECK_REFUSED(RIIS_INVALID_ARGUMENT, name " is NULL", call)
  NULL_IS_NAMED("kind", riis_valve_create(NULL, &valve));
  NULL_IS_NAMED("valve", riis_valve_create("aortic", NULL));
  NULL_IS_NAMED("valve", riis_valve_set(NULL, "xq", 1, values));
  NULL_IS_NAMED("name", riis_valve_set(valve, NULL, 1, values));
  NULL_IS_NAMED("values", riis_valve_set(valve, "xq", 1, NULL));
  NULL_IS_NAMED("name", riis_valve_set_scalar(valve, NULL, 1));
  NULL_IS_NAMED("valve", riis_valve_get(NULL, "xq", 1, values));
  NULL_IS_NAMED("name", riis_valve_get(valve, NULL, 1, values));
  NULL_IS_NAMED("values", riis_valve_get(valve, "xq", 1, NULL));
  NULL_IS_NAMED("valve", riis_valve_unset(NULL, "xq"));
  NULL_IS_NAMED("name", riis_valve_unset(valve, NULL));
  NULL_IS_NAMED("valve", riis_valve_is_set(NULL, "xq", &is_set));
  NULL_IS_NAMED("name", riis_valve_is_set(valve, NULL, &is_set));
  NULL_IS_NAMED("is_set", riis_valve_is_set(valve, "xq", NULL));
  NULL_IS_NAMED("valve", riis_valve_get_n_parameters(NULL, &n));
  NULL_IS_NAMED("n_parameters", riis_valve_get_n_parameters(valve, NULL));
  NULL_IS_NAMED("valve", riis_valve_get_parameter(NULL, 0, NULL, 72));
  NULL_IS_NAMED("parameter", riis_valve_get_parameter(valve, 0, NULL, 72));
  NULL_IS_NAMED("options", riis_surface_options_init(NULL, 96));
  NULL_IS_NAMED("arrays", riis_surface_arrays_init(NULL, 88));
  NULL_IS_NAMED("options", riis_closest_options_init(NULL, 32));
  NULL_IS_NAMED("arrays", riis_closest_arrays_init(NULL, 64));
  NULL_IS_NAMED("options", riis_mark_options_init(NULL, 32));
  NULL_IS_NAMED("valve", riis_surface_create(NULL, NULL, &surface));
  NULL_IS_NAMED("surface", riis_surface_create(valve, NULL, NULL));
  NULL_IS_NAMED("arrays", riis_surface_create_from_arrays(NULL, NULL, &surface));
  NULL_IS_NAMED("surface", riis_surface_create_from_arrays(&arrays, NULL, NULL));
  NULL_IS_NAMED("surface", riis_surface_update(NULL, valve, NULL));
  NULL_IS_NAMED("valve", riis_surface_update(surface, NULL, NULL));
  NULL_IS_NAMED("surface", riis_surface_add_direction(NULL, valve, valve, 1, NULL, NULL));
  NULL_IS_NAMED("valve_after", riis_surface_add_direction(surface, NULL, valve, 1, NULL, NULL));
  NULL_IS_NAMED("valve_before", riis_surface_add_direction(surface, valve, NULL, 1, NULL, NULL));
  riis_direction direction;
  NULL_IS_NAMED("surface", riis_surface_get_direction(NULL, 0, &direction, sizeof direction));
  NULL_IS_NAMED("surface", riis_surface_update_from_arrays(NULL, &arrays, NULL));
  NULL_IS_NAMED("arrays", riis_surface_update_from_arrays(surface, NULL, NULL));
  NULL_IS_NAMED("surface", riis_surface_get_info(NULL, NULL, 104));
  NULL_IS_NAMED("info", riis_surface_get_info(surface, NULL, 104));
  NULL_IS_NAMED("surface", riis_surface_get_triangles(NULL, &triangles, sizeof triangles));
  NULL_IS_NAMED("triangles", riis_surface_get_triangles(surface, NULL, sizeof triangles));
  NULL_IS_NAMED("surface", riis_closest_point(NULL, values, NULL, 96));
  NULL_IS_NAMED("point", riis_closest_point(surface, NULL, NULL, 96));
  NULL_IS_NAMED("closest", riis_closest_point(surface, values, NULL, 96));
  NULL_IS_NAMED("surface", closest_points_of(NULL, 1, xyz, xyz, xyz, 1, NULL, &out));
  NULL_IS_NAMED("y", closest_points_of(surface, 1, xyz, NULL, xyz, 1, NULL, &out));
  NULL_IS_NAMED("arrays", closest_points_of(surface, 1, xyz, xyz, xyz, 1, NULL, NULL));
  NULL_IS_NAMED("x", riis_mesh_create(4, NULL, xyz, xyz, 1, &mesh));
  NULL_IS_NAMED("y", riis_mesh_create(4, xyz, NULL, xyz, 1, &mesh));
  NULL_IS_NAMED("z", riis_mesh_create(4, xyz, xyz, NULL, 1, &mesh));
  NULL_IS_NAMED("mesh", riis_mesh_create(4, xyz, xyz, xyz, 1, NULL));
  NULL_IS_NAMED("mesh", riis_mesh_update(NULL, 4, xyz, xyz, xyz, 1));
  NULL_IS_NAMED("marks", riis_marks_create(NULL));
  NULL_IS_NAMED("surface", riis_mark_nodes(NULL, mesh, NULL, result));
  NULL_IS_NAMED("mesh", riis_mark_nodes(surface, NULL, NULL, result));
  NULL_IS_NAMED("marks", riis_mark_nodes(surface, mesh, NULL, NULL));
  NULL_IS_NAMED("marks", riis_marks_get_list(NULL, RIIS_LIST_MARKED, &list, sizeof list));
  NULL_IS_NAMED("list", riis_marks_get_list(result, RIIS_LIST_MARKED, NULL, sizeof list));
  NULL_IS_NAMED("marks", dense_of(NULL, 4, 1e30, NULL, NULL, NULL, NULL));
  NULL_IS_NAMED("marks", riis_marks_get_stats(NULL, NULL, 56));
  NULL_IS_NAMED("stats", riis_marks_get_stats(result, NULL, 56));
  NULL_IS_NAMED("surface", find_leaks_in(NULL, mesh, result, NULL, NULL));
  NULL_IS_NAMED("mesh", find_leaks_in(surface, NULL, result, NULL, NULL));
  NULL_IS_NAMED("marks", find_leaks_in(surface, mesh, NULL, NULL, NULL));
  NULL_IS_NAMED("leaks", riis_find_leaks(surface, mesh, result, NULL, NULL));
  NULL_IS_NAMED("leaks", riis_leaks_create(NULL));
  NULL_IS_NAMED("leaks", riis_leaks_get_list(NULL, NULL, 112));
  NULL_IS_NAMED("crossings", riis_crossings_create(NULL));
  NULL_IS_NAMED("crossings", riis_crossings_get_list(NULL, NULL, 128));
  NULL_IS_NAMED("mesh", riis_label_open_regions(NULL, result, NULL, 4, &n, NULL));
  NULL_IS_NAMED("marks", riis_label_open_regions(mesh, NULL, NULL, 4, &n, NULL));
  NULL_IS_NAMED("surface", find_passage_between(NULL, mesh, NULL, 1, &n, 1, &n, NULL, 56));
  NULL_IS_NAMED("mesh", find_passage_between(surface, NULL, NULL, 1, &n, 1, &n, NULL, 56));
  NULL_IS_NAMED("passage", find_passage_between(surface, mesh, NULL, 1, &n, 1, &n, NULL, 56));
  /* A destroy function accepts NULL, a NULL handle, and a handle, which becomes NULL. */
  riis_valve_destroy(NULL);
  riis_surface_destroy(NULL);
  riis_mesh_destroy(NULL);
  riis_marks_destroy(NULL);
  for (int twice = 0; twice < 2; ++twice) {
    riis_valve_destroy(&valve);
    riis_surface_destroy(&surface);
    riis_mesh_destroy(&mesh);
    riis_marks_destroy(&result);
    assert_true(!valve && !surface && !mesh && !result);
  }
}

/* In Fortran all handles have one type, so a program with swapped handles compiles. */
TEST(swapped_handles_are_refused) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *result = NULL;
  CHECK_OK(riis_valve_create("aortic", &valve));
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  CHECK_OK(riis_mesh_create(4, xyz, xyz + 1, xyz + 2, 3, &mesh));
  CHECK_OK(riis_marks_create(&result));
  riis_surface *no_surface = (void *)mesh;
  riis_mesh *no_mesh = (void *)surface;
  riis_valve *no_valve = (void *)surface;
  riis_marks *no_result = (void *)mesh;
#define IS_OF_ANOTHER_KIND(name, call) CHECK_REFUSED(RIIS_INVALID_ARGUMENT, name " is a handle of another kind", call)
  IS_OF_ANOTHER_KIND("surface", riis_mark_nodes(no_surface, no_mesh, NULL, result));
  IS_OF_ANOTHER_KIND("mesh", riis_mark_nodes(surface, no_mesh, NULL, result));
  IS_OF_ANOTHER_KIND("marks", riis_mark_nodes(surface, mesh, NULL, no_result));
  IS_OF_ANOTHER_KIND("surface", find_leaks_in(no_surface, no_mesh, result, NULL, NULL));
  IS_OF_ANOTHER_KIND("mesh", find_leaks_in(surface, no_mesh, result, NULL, NULL));
  IS_OF_ANOTHER_KIND("marks", find_leaks_in(surface, mesh, no_result, NULL, NULL));
  IS_OF_ANOTHER_KIND("leaks", riis_leaks_get_list((void *)mesh, NULL, 112));
  IS_OF_ANOTHER_KIND("crossings", riis_crossings_get_list((void *)mesh, NULL, 128));
  IS_OF_ANOTHER_KIND("crossings", riis_find_crossings(surface, NULL, (void *)mesh));
  IS_OF_ANOTHER_KIND("mesh", riis_label_open_regions(no_mesh, result, NULL, 4, NULL, NULL));
  IS_OF_ANOTHER_KIND("marks", riis_label_open_regions(mesh, no_result, NULL, 4, NULL, NULL));
  IS_OF_ANOTHER_KIND("surface", find_passage_between(no_surface, mesh, NULL, 1, NULL, 1, NULL, NULL, 56));
  IS_OF_ANOTHER_KIND("mesh", find_passage_between(surface, no_mesh, NULL, 1, NULL, 1, NULL, NULL, 56));
  IS_OF_ANOTHER_KIND("valve", riis_surface_create(no_valve, NULL, &no_surface));
  IS_OF_ANOTHER_KIND("valve", riis_valve_set_scalar(no_valve, "xq", 0));
  IS_OF_ANOTHER_KIND("surface", riis_surface_update(no_surface, valve, NULL));
  IS_OF_ANOTHER_KIND("surface", riis_surface_get_info(no_surface, NULL, 104));
  IS_OF_ANOTHER_KIND("marks", riis_marks_get_list(no_result, RIIS_LIST_MARKED, NULL, 120));
  IS_OF_ANOTHER_KIND("mesh", riis_mesh_update(no_mesh, 4, xyz, xyz, xyz, 1));
  uint64_t no_handle[16] = {0}; /* as memory that was a handle once */
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh is no handle, or it was destroyed",
                riis_mark_nodes(surface, (void *)no_handle, NULL, result));
  riis_surface_destroy(&no_surface);
  assert_true((void *)no_surface == (void *)mesh); /* the handle was not changed */
  riis_marks_destroy(&result);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

TEST(parameters_are_refused_by_name) {
  riis_valve *valve = NULL;
  double values[3] = {0, 0, NAN};
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'pulmonary'|aortic", riis_valve_create("pulmonary", &valve));
  assert_null(valve);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "''", riis_valve_create("", &valve));
  valve = new_valve("aortic");
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'root_radios'|aortic|riis_valve_get_parameter",
                riis_valve_set_scalar(valve, "root_radios", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'.leaflet_angle'", riis_valve_set_scalar(valve, ".leaflet_angle", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'right.'", riis_valve_set_scalar(valve, "right.", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'angle'", riis_valve_set_scalar(valve, "angle", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "''", riis_valve_set_scalar(valve, "", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'root_radius' is nan", riis_valve_set_scalar(valve, "root_radius", NAN));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'root_radius' is inf", riis_valve_set_scalar(valve, "root_radius", INFINITY));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'root_radius' is 0", riis_valve_set_scalar(valve, "root_radius", 0));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'root_radius' is -1.29", riis_valve_set_scalar(valve, "root_radius", -1.29));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'left.leaflet_angle' is 180|5 to 175",
                riis_valve_set_scalar(valve, "left.leaflet_angle", 180));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'leaflet_power' is 0.5|from 1",
                riis_valve_set_scalar(valve, "leaflet_power", 0.5));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'right.translation'|3 values, not 1",
                riis_valve_set_scalar(valve, "right.translation", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'xq'|1 value, not 3", riis_valve_set(valve, "xq", 3, values));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'translation' is nan", riis_valve_set(valve, "translation", 3, values));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'xq'|not -1", riis_valve_set(valve, "xq", -1, values));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'translation'|'right.translation'",
                riis_valve_get(valve, "translation", 3, values));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'xq'|not 2", riis_valve_get(valve, "xq", 2, values));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'nothing'", riis_valve_get(valve, "nothing", 1, values));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "parameter_id is -1|0 to 43", riis_valve_get_parameter(valve, -1, NULL, 72));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "parameter_id is 44", riis_valve_get_parameter(valve, 44, NULL, 72));
  /* The refused calls have not changed the valve. */
  CHECK_OK(riis_valve_get(valve, "root_radius", 1, values));
  CHECK_SAME(values[0], 1.29);
  CHECK_OK(riis_valve_get(valve, "right.translation", 3, values));
  CHECK_SAME(values[2], -1.0);
  /* A name may be longer than any message. */
  char long_name[5000];
  memset(long_name, 'x', sizeof long_name - 1);
  long_name[sizeof long_name - 1] = 0;
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "xxx|aortic", riis_valve_set_scalar(valve, long_name, 1));
}

TEST(surface_options_are_refused_by_name) {
  riis_surface *surface = NULL;
  riis_surface_options options;
  riis_valve *valve = new_valve("aortic");
#define OPTION_IS_REFUSED(field, value, text)                                                   \
  do {                                                                                          \
    options = surface_options();                                                                \
    options.field = value;                                                                      \
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, text, riis_surface_create(valve, &options, &surface)); \
    assert_null(surface);                                                                       \
  } while (0)
  OPTION_IS_REFUSED(half_thickness, 0, "half_thickness is 0");
  OPTION_IS_REFUSED(half_thickness, -0.1, "half_thickness is -0.1");
  OPTION_IS_REFUSED(half_thickness, NAN, "half_thickness is nan");
  OPTION_IS_REFUSED(half_thickness, INFINITY, "half_thickness is inf");
  OPTION_IS_REFUSED(tolerance, 0, "tolerance is 0|1e-06 to 1");
  OPTION_IS_REFUSED(tolerance, 1.5, "tolerance is 1.5");
  OPTION_IS_REFUSED(tolerance, NAN, "tolerance is nan");
  OPTION_IS_REFUSED(scale, 0, "scale is 0");
  OPTION_IS_REFUSED(scale, -1, "scale is -1");
  OPTION_IS_REFUSED(scale, INFINITY, "scale is inf");
  OPTION_IS_REFUSED(rotation_angle, NAN, "rotation_angle is nan");
  OPTION_IS_REFUSED(rotation_axis[1], NAN, "rotation_axis is nan");
  OPTION_IS_REFUSED(rotation_axis[2], 0, "rotation_axis is (0, 0, 0)");
  OPTION_IS_REFUSED(translation[0], -INFINITY, "translation is -inf");
  OPTION_IS_REFUSED(zero_area, 2, "zero_area is 2");
  OPTION_IS_REFUSED(flip_normals, -1, "flip_normals is -1");
  OPTION_IS_REFUSED(measure, -1, "options.measure is -1|RIIS_MEASURE_*");
  OPTION_IS_REFUSED(measure, 3, "options.measure is 3|RIIS_MEASURE_*");
  OPTION_IS_REFUSED(n_threads, -1, "options.n_threads is -1");
  OPTION_IS_REFUSED(n_threads, 1025, "options.n_threads is 1025|1024");
  OPTION_IS_REFUSED(measure_tolerance, 0, "measure_tolerance is 0|1e-06 to 1");
  OPTION_IS_REFUSED(measure_tolerance, 1.5, "measure_tolerance is 1.5");
  OPTION_IS_REFUSED(measure_tolerance, NAN, "measure_tolerance is nan");
  /* At a distance of 1e14 from the origin, rounding would flatten the valve. */
  OPTION_IS_REFUSED(translation[1], 1e14, "translation moves the valve by 1e+14|tolerance * half_thickness, 0.005");
  options = surface_options();
  options.tolerance = 1e-6;
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "16777216 triangles|tolerance", riis_surface_create(valve, &options, &surface));
  options.half_thickness = 1e-50; /* each value is in range, but together they make no sense */
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "tolerance", riis_surface_create(valve, &options, &surface));
}

TEST(surface_arrays_are_refused_by_name) {
  riis_surface *surface = NULL;
  riis_surface_arrays arrays;
  double bad[12];
  int32_t bad_ids[3] = {0, 1, 4}, negative[1] = {-3};
#define ARRAYS_ARE_REFUSED(status, change, text)                                           \
  do {                                                                                     \
    arrays = triangle_arrays(4, xyz, 1, ids);                                              \
    change;                                                                                \
    CHECK_REFUSED(status, text, riis_surface_create_from_arrays(&arrays, NULL, &surface)); \
    assert_null(surface);                                                                  \
  } while (0)
  ARRAYS_ARE_REFUSED(RIIS_INVALID_ARGUMENT, arrays.x = NULL, "arrays.x is NULL");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_ARGUMENT, arrays.y = NULL, "arrays.y is NULL");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_ARGUMENT, arrays.z = NULL, "arrays.z is NULL");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_ARGUMENT, arrays.vertex_ids = NULL, "arrays.vertex_ids is NULL");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_ARGUMENT, arrays.stride = 0, "arrays.stride is 0");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_ARGUMENT, arrays.id_bits = 16, "arrays.id_bits is 16");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_ARGUMENT, arrays.index_base = 2, "arrays.index_base is 2");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_ARGUMENT, arrays.corners_per_face = 5, "arrays.corners_per_face is 5");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_ARGUMENT, arrays.real_bits = 16, "arrays.real_bits is 16|32 or 64");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_SURFACE, arrays.n_vertices = 0, "arrays.n_vertices is 0");
  ARRAYS_ARE_REFUSED(RIIS_LIMIT_EXCEEDED, arrays.n_vertices = INT64_C(1) << 40, "arrays.n_vertices is 1099511627776");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_SURFACE, arrays.n_faces = 0, "arrays.n_faces is 0");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_SURFACE, arrays.n_faces = -7, "arrays.n_faces is -7");
  ARRAYS_ARE_REFUSED(RIIS_LIMIT_EXCEEDED, arrays.n_faces = 16777217, "arrays.n_faces is 16777217|16777216");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_SURFACE, arrays.vertex_ids = bad_ids,
                     "corner 2 of face 0 is 4|0 to 3, counting from arrays.index_base = 0");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_SURFACE, arrays.index_base = 1, "corner 0 of face 0 is 0|1 to 4");
  ARRAYS_ARE_REFUSED(RIIS_INVALID_SURFACE, arrays.leaflet_id = negative, "leaflet_id of face 0 is -3");
  memcpy(bad, xyz, sizeof bad);
  bad[11] = INFINITY; /* refused although no face uses this vertex */
  ARRAYS_ARE_REFUSED(RIIS_INVALID_SURFACE, (arrays.x = bad, arrays.y = bad + 1, arrays.z = bad + 2),
                     "z of vertex 3 is inf");
  bad[11] = 1e61;
  ARRAYS_ARE_REFUSED(RIIS_INVALID_SURFACE, (arrays.x = bad, arrays.y = bad + 1, arrays.z = bad + 2),
                     "z of vertex 3 is 1e+61");
  /* The coordinate is in range until the surface is placed, and then out of range. */
  bad[11] = 1e59;
  riis_surface_options options = surface_options();
  options.scale = 100;
  arrays = triangle_arrays(4, bad, 1, ids);
  CHECK_REFUSED(RIIS_INVALID_SURFACE, "vertex 3, placed,|1e+61",
                riis_surface_create_from_arrays(&arrays, &options, &surface));
}

/* Returns 1 if a component begins between two entries of another component, after that component's second entry. Also returns 1
 * if two components share a number. */
static int begin_inside(const int *begins, int n, int stride) {
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      int n_before = 0, n_equal = 0, n_after = 0;
      for (int i = 0; begins[a] < begins[b] && i < n; ++i) {
        const int entry = begins[a] + i * stride;
        ++*(entry < begins[b] ? &n_before : entry == begins[b] ? &n_equal : &n_after);
      }
      if (n_equal > 0 || (n_before > 1 && n_after > 0)) return 1;
    }
  return 0;
}

TEST(components_that_begin_inside_each_other_are_refused) {
  static double numbers[64];
  riis_mesh *mesh = NULL, *copy = NULL;
  int n_refused = 0, n_accepted = 0;
  for (int n = 0; n < 5; ++n)
    for (int stride = 1; stride < 5; ++stride)
      for (int y = 0; y < 10; ++y)
        for (int z = 0; z < 10; ++z) {
          const int begins[3] = {4, y, z};
          riis_points points;
          CHECK_OK(riis_points_init(&points, sizeof points));
          points.n_points = n, points.stride = stride, points.real_bits = 32;
          points.x = (float *)numbers + 4, points.y = (float *)numbers + y, points.z = (float *)numbers + z;
          const riis_status status = riis_mesh_create(n, numbers + 4, numbers + y, numbers + z, stride, &mesh);
          assert_int_equal(status, begin_inside(begins, n, stride) ? RIIS_INVALID_ARGUMENT : RIIS_OK);
          assert_int_equal(riis_mesh_create_copy(&points, &copy), status);
          ++*(status == RIIS_OK ? &n_accepted : &n_refused);
          riis_mesh_destroy(&mesh);
          riis_mesh_destroy(&copy);
        }
  assert_true(n_refused > 100 && n_accepted > 1000);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT,
                "y begins at number 1 of x, because stride is 1; the components of xyz(3,n) have the stride 3",
                riis_mesh_create(4, xyz, xyz + 1, xyz + 2, 1, &mesh));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT,
                "x begins at number 6 of z, because stride is 2; separate arrays have the stride 1",
                riis_mesh_create(4, numbers + 9, numbers + 20, numbers + 3, 2, &mesh));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT,
                "z begins at number 3 of x, because stride is 1; the components must not overlap",
                riis_mesh_create(5, numbers, numbers + 20, numbers + 3, 1, &mesh));
  CHECK_OK(riis_mesh_create(4, xyz, xyz + 1, xyz + 2, 3, &mesh));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "y begins at number 1 of x",
                riis_mesh_update(mesh, 4, xyz, xyz + 1, xyz + 2, 1));
  riis_mesh_destroy(&mesh);
  riis_surface *surface = NULL;
  riis_surface_arrays arrays = triangle_arrays(4, xyz, 1, ids);
  arrays.vx = xyz + 1, arrays.vy = xyz, arrays.vz = xyz + 7;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT,
                "arrays.vx begins at number 1 of arrays.vy, because arrays.velocity_stride is 1;|have the stride 3",
                riis_surface_create_from_arrays(&arrays, NULL, &surface));
  arrays.vx = arrays.vy = arrays.vz = NULL, arrays.stride = 1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.y begins at number 1 of arrays.x, because arrays.stride is 1",
                riis_surface_create_from_arrays(&arrays, NULL, &surface));
}

TEST(points_and_meshes_are_refused_by_name) {
  riis_surface *surface = aortic_surface(NULL);
  riis_mesh *mesh = NULL;
  riis_closest closest;
  riis_closest_options options;
  riis_closest_arrays out;
  double nodes[12], distance[4] = {-9, -9, -9, -9};
  memcpy(nodes, xyz, sizeof nodes);
  CHECK_OK(riis_closest_options_init(&options, sizeof options));
  CHECK_OK(riis_closest_arrays_init(&out, sizeof out));
  out.distance = distance;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "more than memory can hold",
                riis_mesh_create(INT64_C(1) << 40, xyz, xyz, xyz, INT64_C(1) << 20, &mesh));
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "n_nodes is 1099511627777|1099511627776",
                riis_mesh_create((INT64_C(1) << 40) + 1, xyz, xyz, xyz, 1, &mesh));
  CHECK_REFUSED(RIIS_INVALID_MESH, "n_nodes is -5", riis_mesh_create(-5, xyz, xyz, xyz, 1, &mesh));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "stride is 0", riis_mesh_create(4, xyz, xyz, xyz, 0, &mesh));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "stride is -3", riis_mesh_create(4, xyz, xyz, xyz, -3, &mesh));
  nodes[7] = NAN;
  nodes[11] = NAN;
  CHECK_REFUSED(RIIS_INVALID_MESH, "y of node 2 is nan", riis_mesh_create(4, nodes, nodes + 1, nodes + 2, 3, &mesh));
  nodes[7] = -INFINITY;
  CHECK_REFUSED(RIIS_INVALID_MESH, "y of node 2 is -inf", riis_mesh_create(4, nodes, nodes + 1, nodes + 2, 3, &mesh));
  nodes[7] = -2e60;
  CHECK_REFUSED(RIIS_INVALID_MESH, "y of node 2 is -2e+60", riis_mesh_create(4, nodes, nodes + 1, nodes + 2, 3, &mesh));
  assert_null(mesh);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "y of point 2 is -2e+60",
                closest_points_of(surface, 4, nodes, nodes + 1, nodes + 2, 3, NULL, &out));
  for (int i = 0; i < 4; ++i) CHECK_SAME(distance[i], -9);
  const double not_a_point[3] = {0, 0, NAN};
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "z of point 0 is nan",
                riis_closest_point(surface, not_a_point, &closest, sizeof closest));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_points is -1", closest_points_of(surface, -1, xyz, xyz, xyz, 1, NULL, &out));
  options.n_threads = 1025;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_threads is 1025",
                closest_points_of(surface, 1, xyz, xyz, xyz, 1, &options, &out));
  options.n_threads = 0;
  options.reserved = 7;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "reserved is 7",
                closest_points_of(surface, 1, xyz, xyz, xyz, 1, &options, &out));
  options.reserved = 0;
  options.distance_limit = -2;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "distance_limit is -2",
                closest_points_of(surface, 1, xyz, xyz, xyz, 1, &options, &out));
  options.distance_limit = NAN;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "distance_limit is nan",
                closest_points_of(surface, 1, xyz, xyz, xyz, 1, &options, &out));
  options.distance_limit = 5;
  options.far_distance = 5;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "far_distance is 5",
                closest_points_of(surface, 1, xyz, xyz, xyz, 1, &options, &out));
}

TEST(marking_options_are_refused_by_name) {
  riis_surface *surface = aortic_surface(NULL);
  riis_mesh *mesh = mesh_of(4, xyz);
  riis_marks *result = new_result();
#define MARK_OPTION_IS_REFUSED(field, value, text)                                                \
  do {                                                                                            \
    riis_mark_options options = mark_options();                                                   \
    options.field = value;                                                                        \
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, text, riis_mark_nodes(surface, mesh, &options, result)); \
  } while (0)
  MARK_OPTION_IS_REFUSED(distance_limit, 0.05, "distance_limit is 0.05|half thickness, 0.1,");
  MARK_OPTION_IS_REFUSED(distance_limit, nextafter(0.1, 0), "distance_limit is 0.09999999999999999;");
  MARK_OPTION_IS_REFUSED(distance_limit, NAN, "distance_limit is nan");
  MARK_OPTION_IS_REFUSED(distance_limit, INFINITY, "distance_limit is inf");
  MARK_OPTION_IS_REFUSED(search, 2, "search is 2");
  MARK_OPTION_IS_REFUSED(search, -1, "search is -1");
  MARK_OPTION_IS_REFUSED(n_threads, -1, "n_threads is -1");
  MARK_OPTION_IS_REFUSED(n_threads, 4096, "n_threads is 4096");
}

/* A caller with an older header passes a smaller struct, and the call uses only its fields. A caller with a newer header is
 * refused. */
TEST(struct_sizes_are_checked) {
  riis_surface_options options;
  memset(&options, 0x5a, sizeof options);
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "options is 119|120", riis_surface_options_init(&options, 119));
  char parts[40];
  snprintf(parts, sizeof parts, "options is 136|riis %s ", riis_version_string());
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, parts, riis_surface_options_init(&options, 136));
  assert_int_equal(options.zero_area, 0x5a5a5a5a);    /* a field that the caller's struct lacks is untouched */
  CHECK_OK(riis_surface_options_init(&options, 120)); /* a caller that was compiled before the offset existed */
  double offset;
  memcpy(&offset, &options.offset, sizeof offset);
  assert_true(offset > 1); /* untouched (0x5a5a...) and never read, because struct_size is 120 */
  riis_surface *old = aortic_surface(&options);
  assert_true(info_of(old).offset == 0);
  riis_surface *surface = NULL;
  riis_valve *valve = new_valve("aortic");
  options.struct_size = 0; /* as if no init function had filled the struct */
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "options is 0|init function", riis_surface_create(valve, &options, &surface));
  options.struct_size = -8;
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "options is -8", riis_surface_create(valve, &options, &surface));
  options.struct_size = INT64_MAX;
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "options is 9223372036854775807",
                riis_surface_create(valve, &options, &surface));
  riis_closest closest;
  surface = aortic_surface(NULL);
  const double origin[3] = {0, 0, 0};
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "closest is 8", riis_closest_point(surface, origin, &closest, 8));
  riis_surface_arrays arrays = triangle_arrays(4, xyz, 1, ids);
  arrays.struct_size = 80;
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "arrays is 80", riis_surface_update_from_arrays(surface, &arrays, NULL));
}

int main(void) { return run_cases(NULL, NULL); }
