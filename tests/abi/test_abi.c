/* SPDX-License-Identifier: Apache-2.0
 *
 * The layouts and values that programs compiled yesterday rely on. The numbers are literals, written down when the interface
 * was made. If one of them has to change, programs break: append instead. Appended fields, functions and values get new lines.
 * The sizes of structs that grew are the only old lines that may change. */
#include <riis/riis.h>
#include <riis/riis_vtk.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define SIZE(type, size) assert_int_equal(sizeof(type), size)
#define FIELD(type, field, offset, size)                \
  do {                                                  \
    assert_int_equal(offsetof(type, field), offset);    \
    assert_int_equal(sizeof(((type *)0)->field), size); \
  } while (0)
/* Checks the type of a function, including its arguments. Callers in other languages do not see the header and rely on it. */
#define SIGNATURE(function, result, arguments) assert_true(_Generic(&function, result(*) arguments : 1, default : 0))

static void test_structs(void **state) {
  (void)state;
  SIZE(riis_patches, 72);
  FIELD(riis_patches, struct_size, 0, 8);
  FIELD(riis_patches, n_curves, 8, 8);
  FIELD(riis_patches, degree, 16, 8);
  FIELD(riis_patches, control, 24, 8);
  FIELD(riis_patches, n_patches, 32, 8);
  FIELD(riis_patches, curve_id, 40, 8);
  FIELD(riis_patches, reversed, 48, 8);
  FIELD(riis_patches, leaflet_id, 56, 8);
  FIELD(riis_patches, index_base, 64, 4);
  FIELD(riis_patches, reserved, 68, 4);

  SIZE(riis_parameter, 72);
  FIELD(riis_parameter, name, 0, 8);
  FIELD(riis_parameter, unit, 8, 8);
  FIELD(riis_parameter, description, 16, 8);
  FIELD(riis_parameter, n_values, 24, 8);
  FIELD(riis_parameter, default_values, 32, 24);
  FIELD(riis_parameter, minimum, 56, 8);
  FIELD(riis_parameter, maximum, 64, 8);

  SIZE(riis_surface_options, 120);
  FIELD(riis_surface_options, struct_size, 0, 8);
  FIELD(riis_surface_options, half_thickness, 8, 8);
  FIELD(riis_surface_options, tolerance, 16, 8);
  FIELD(riis_surface_options, scale, 24, 8);
  FIELD(riis_surface_options, rotation_axis, 32, 24);
  FIELD(riis_surface_options, rotation_angle, 56, 8);
  FIELD(riis_surface_options, translation, 64, 24);
  FIELD(riis_surface_options, zero_area, 88, 4);
  FIELD(riis_surface_options, flip_normals, 92, 4);
  FIELD(riis_surface_options, distance, 96, 4);
  FIELD(riis_surface_options, n_threads, 100, 4);
  FIELD(riis_surface_options, distance_tolerance, 104, 8);
  FIELD(riis_surface_options, triangulation, 112, 4);
  FIELD(riis_surface_options, reserved, 116, 4);

  SIZE(riis_surface_arrays, 120);
  FIELD(riis_surface_arrays, struct_size, 0, 8);
  FIELD(riis_surface_arrays, n_vertices, 8, 8);
  FIELD(riis_surface_arrays, x, 16, 8);
  FIELD(riis_surface_arrays, y, 24, 8);
  FIELD(riis_surface_arrays, z, 32, 8);
  FIELD(riis_surface_arrays, stride, 40, 8);
  FIELD(riis_surface_arrays, n_faces, 48, 8);
  FIELD(riis_surface_arrays, vertex_ids, 56, 8);
  FIELD(riis_surface_arrays, vertex_id_bits, 64, 4);
  FIELD(riis_surface_arrays, index_base, 68, 4);
  FIELD(riis_surface_arrays, corners_per_face, 72, 4);
  FIELD(riis_surface_arrays, reserved, 76, 4);
  FIELD(riis_surface_arrays, leaflet_id, 80, 8);
  FIELD(riis_surface_arrays, vx, 88, 8);
  FIELD(riis_surface_arrays, vy, 96, 8);
  FIELD(riis_surface_arrays, vz, 104, 8);
  FIELD(riis_surface_arrays, velocity_stride, 112, 8);

  SIZE(riis_surface_info, 120);
  FIELD(riis_surface_info, n_vertices, 0, 8);
  FIELD(riis_surface_info, n_triangles, 8, 8);
  FIELD(riis_surface_info, n_zero_area, 16, 8);
  FIELD(riis_surface_info, half_thickness, 24, 8);
  FIELD(riis_surface_info, area, 32, 8);
  FIELD(riis_surface_info, lower, 40, 24);
  FIELD(riis_surface_info, upper, 64, 24);
  FIELD(riis_surface_info, seconds_triangles, 88, 8);
  FIELD(riis_surface_info, seconds_scene, 96, 8);
  FIELD(riis_surface_info, error_bound, 104, 8);
  FIELD(riis_surface_info, velocity_error_bound, 112, 8);

  SIZE(riis_closest, 96);
  FIELD(riis_closest, distance, 0, 8);
  FIELD(riis_closest, point, 8, 24);
  FIELD(riis_closest, barycentric, 32, 24);
  FIELD(riis_closest, normal, 56, 24);
  FIELD(riis_closest, triangle_id, 80, 8);
  FIELD(riis_closest, leaflet_id, 88, 4);
  FIELD(riis_closest, side, 92, 4);

  SIZE(riis_closest_options, 56);
  FIELD(riis_closest_options, struct_size, 0, 8);
  FIELD(riis_closest_options, distance_limit, 8, 8);
  FIELD(riis_closest_options, far_distance, 16, 8);
  FIELD(riis_closest_options, n_threads, 24, 4);
  FIELD(riis_closest_options, reserved, 28, 4);
  FIELD(riis_closest_options, point_mask, 32, 8);
  FIELD(riis_closest_options, n_point_ids, 40, 8);
  FIELD(riis_closest_options, point_ids, 48, 8);

  SIZE(riis_closest_arrays, 64);
  FIELD(riis_closest_arrays, struct_size, 0, 8);
  FIELD(riis_closest_arrays, distance, 8, 8);
  FIELD(riis_closest_arrays, point, 16, 8);
  FIELD(riis_closest_arrays, barycentric, 24, 8);
  FIELD(riis_closest_arrays, normal, 32, 8);
  FIELD(riis_closest_arrays, triangle_id, 40, 8);
  FIELD(riis_closest_arrays, leaflet_id, 48, 8);
  FIELD(riis_closest_arrays, side, 56, 8);

  SIZE(riis_csr, 56);
  FIELD(riis_csr, struct_size, 0, 8);
  FIELD(riis_csr, n_rows, 8, 8);
  FIELD(riis_csr, n_all, 16, 8);
  FIELD(riis_csr, offsets, 24, 8);
  FIELD(riis_csr, columns, 32, 8);
  FIELD(riis_csr, offset_bits, 40, 4);
  FIELD(riis_csr, column_bits, 44, 4);
  FIELD(riis_csr, index_base, 48, 4);
  FIELD(riis_csr, reserved, 52, 4);

  SIZE(riis_cells, 56);
  FIELD(riis_cells, struct_size, 0, 8);
  FIELD(riis_cells, n_nodes, 8, 8);
  FIELD(riis_cells, n_cells, 16, 8);
  FIELD(riis_cells, node_ids, 24, 8);
  FIELD(riis_cells, offsets, 32, 8);
  FIELD(riis_cells, nodes_per_cell, 40, 4);
  FIELD(riis_cells, id_bits, 44, 4);
  FIELD(riis_cells, index_base, 48, 4);
  FIELD(riis_cells, n_threads, 52, 4);

  SIZE(riis_faces, 64);
  FIELD(riis_faces, struct_size, 0, 8);
  FIELD(riis_faces, n_cells, 8, 8);
  FIELD(riis_faces, n_faces, 16, 8);
  FIELD(riis_faces, owner, 24, 8);
  FIELD(riis_faces, neighbor, 32, 8);
  FIELD(riis_faces, stride, 40, 8);
  FIELD(riis_faces, id_bits, 48, 4);
  FIELD(riis_faces, index_base, 52, 4);
  FIELD(riis_faces, n_threads, 56, 4);
  FIELD(riis_faces, reserved, 60, 4);

  SIZE(riis_mark_options, 48);
  FIELD(riis_mark_options, struct_size, 0, 8);
  FIELD(riis_mark_options, distance_limit, 8, 8);
  FIELD(riis_mark_options, node_mask, 16, 8);
  FIELD(riis_mark_options, search, 24, 4);
  FIELD(riis_mark_options, n_threads, 28, 4);
  FIELD(riis_mark_options, instructions, 32, 4);
  FIELD(riis_mark_options, reserved, 36, 4);
  FIELD(riis_mark_options, fields, 40, 4);
  FIELD(riis_mark_options, reserved2, 44, 4);

  SIZE(riis_mark_stats, 64);
  FIELD(riis_mark_stats, n_nodes, 0, 8);
  FIELD(riis_mark_stats, n_marked, 8, 8);
  FIELD(riis_mark_stats, n_within_limit, 16, 8);
  FIELD(riis_mark_stats, n_queries, 24, 8);
  FIELD(riis_mark_stats, seconds, 32, 8);
  FIELD(riis_mark_stats, search, 40, 4);
  FIELD(riis_mark_stats, n_threads, 44, 4);
  FIELD(riis_mark_stats, complete, 48, 4);
  FIELD(riis_mark_stats, instructions, 52, 4);
  FIELD(riis_mark_stats, n_unreached, 56, 8);

  SIZE(riis_crossing_options, 24);
  FIELD(riis_crossing_options, struct_size, 0, 8);
  FIELD(riis_crossing_options, depth, 8, 8);
  FIELD(riis_crossing_options, n_threads, 16, 4);
  FIELD(riis_crossing_options, reserved, 20, 4);

  SIZE(riis_crossings, 80);
  FIELD(riis_crossings, n_pairs, 0, 8);
  FIELD(riis_crossings, length, 8, 8);
  FIELD(riis_crossings, depth, 16, 8);
  FIELD(riis_crossings, point, 24, 24);
  FIELD(riis_crossings, triangle_id, 48, 16);
  FIELD(riis_crossings, leaflet_id, 64, 8);
  FIELD(riis_crossings, seconds, 72, 8);

  SIZE(riis_leaks, 72);
  FIELD(riis_leaks, n_edges, 0, 8);
  FIELD(riis_leaks, longest_node_id, 8, 16);
  FIELD(riis_leaks, longest_length, 24, 8);
  FIELD(riis_leaks, longest_middle, 32, 24);
  FIELD(riis_leaks, half_thickness, 56, 8);
  FIELD(riis_leaks, seconds, 64, 8);

  SIZE(riis_passage, 56);
  FIELD(riis_passage, node_id, 0, 8);
  FIELD(riis_passage, distance, 8, 8);
  FIELD(riis_passage, point, 16, 24);
  FIELD(riis_passage, seconds, 40, 8);
  FIELD(riis_passage, state, 48, 4);
  FIELD(riis_passage, reserved, 52, 4);

  SIZE(riis_mark_fields, 72);
  FIELD(riis_mark_fields, n_nodes, 0, 8);
  FIELD(riis_mark_fields, point, 8, 8);
  FIELD(riis_mark_fields, normal, 16, 8);
  FIELD(riis_mark_fields, barycentric, 24, 8);
  FIELD(riis_mark_fields, uv, 32, 8);
  FIELD(riis_mark_fields, velocity, 40, 8);
  FIELD(riis_mark_fields, side, 48, 8);
  FIELD(riis_mark_fields, rim, 56, 8);
  FIELD(riis_mark_fields, patch_id, 64, 8);

  SIZE(riis_resistance, 32);
  FIELD(riis_resistance, struct_size, 0, 8);
  FIELD(riis_resistance, resistance, 8, 8);
  FIELD(riis_resistance, half_thickness, 16, 8);
  FIELD(riis_resistance, rim, 24, 4);
  FIELD(riis_resistance, reserved, 28, 4);

  SIZE(riis_band_sums, 48);
  FIELD(riis_band_sums, sum, 0, 16);
  FIELD(riis_band_sums, weight, 16, 16);
  FIELD(riis_band_sums, n_nodes, 32, 16);

  SIZE(riis_opening_table, 48);
  FIELD(riis_opening_table, struct_size, 0, 8);
  FIELD(riis_opening_table, n_keys, 8, 8);
  FIELD(riis_opening_table, time, 16, 8);
  FIELD(riis_opening_table, opening, 24, 8);
  FIELD(riis_opening_table, period, 32, 8);
  FIELD(riis_opening_table, interpolation, 40, 4);
  FIELD(riis_opening_table, reserved, 44, 4);

  SIZE(riis_opening_times, 64);
  FIELD(riis_opening_times, struct_size, 0, 8);
  FIELD(riis_opening_times, opening_start, 8, 8);
  FIELD(riis_opening_times, opening_seconds, 16, 8);
  FIELD(riis_opening_times, closing_start, 24, 8);
  FIELD(riis_opening_times, closing_seconds, 32, 8);
  FIELD(riis_opening_times, closed, 40, 8);
  FIELD(riis_opening_times, open, 48, 8);
  FIELD(riis_opening_times, period, 56, 8);

  SIZE(riis_opening_switch, 56);
  FIELD(riis_opening_switch, struct_size, 0, 8);
  FIELD(riis_opening_switch, opening_seconds, 8, 8);
  FIELD(riis_opening_switch, closing_seconds, 16, 8);
  FIELD(riis_opening_switch, open_above, 24, 8);
  FIELD(riis_opening_switch, close_below, 32, 8);
  FIELD(riis_opening_switch, filter_seconds, 40, 8);
  FIELD(riis_opening_switch, dwell_seconds, 48, 8);

  SIZE(riis_opening_switch_state, 72);
  FIELD(riis_opening_switch_state, struct_size, 0, 8);
  FIELD(riis_opening_switch_state, time, 8, 8);
  FIELD(riis_opening_switch_state, opening, 16, 8);
  FIELD(riis_opening_switch_state, rate, 24, 8);
  FIELD(riis_opening_switch_state, progress, 32, 8);
  FIELD(riis_opening_switch_state, pressure_difference, 40, 8);
  FIELD(riis_opening_switch_state, flow, 48, 8);
  FIELD(riis_opening_switch_state, since, 56, 8);
  FIELD(riis_opening_switch_state, phase, 64, 4);
  FIELD(riis_opening_switch_state, reserved, 68, 4);

  SIZE(riis_opening_angle, 56);
  FIELD(riis_opening_angle, struct_size, 0, 8);
  FIELD(riis_opening_angle, pressure_gain, 8, 8);
  FIELD(riis_opening_angle, flow_gain, 16, 8);
  FIELD(riis_opening_angle, friction, 24, 8);
  FIELD(riis_opening_angle, vortex_gain, 32, 8);
  FIELD(riis_opening_angle, angle_min, 40, 8);
  FIELD(riis_opening_angle, angle_max, 48, 8);

  SIZE(riis_opening_angle_state, 64);
  FIELD(riis_opening_angle_state, struct_size, 0, 8);
  FIELD(riis_opening_angle_state, time, 8, 8);
  FIELD(riis_opening_angle_state, opening, 16, 8);
  FIELD(riis_opening_angle_state, rate, 24, 8);
  FIELD(riis_opening_angle_state, angle, 32, 8);
  FIELD(riis_opening_angle_state, angle_rate, 40, 8);
  FIELD(riis_opening_angle_state, pressure_difference, 48, 8);
  FIELD(riis_opening_angle_state, flow, 56, 8);

  SIZE(riis_keyframe_arrays, 56);
  FIELD(riis_keyframe_arrays, struct_size, 0, 8);
  FIELD(riis_keyframe_arrays, n_keys, 8, 8);
  FIELD(riis_keyframe_arrays, n_vertices, 16, 8);
  FIELD(riis_keyframe_arrays, time, 24, 8);
  FIELD(riis_keyframe_arrays, xyz, 32, 8);
  FIELD(riis_keyframe_arrays, period, 40, 8);
  FIELD(riis_keyframe_arrays, interpolation, 48, 4);
  FIELD(riis_keyframe_arrays, reserved, 52, 4);

  SIZE(riis_vtk_picture_options, 64);
  FIELD(riis_vtk_picture_options, struct_size, 0, 8);
  FIELD(riis_vtk_picture_options, view, 8, 4);
  FIELD(riis_vtk_picture_options, width, 12, 4);
  FIELD(riis_vtk_picture_options, height, 16, 4);
  FIELD(riis_vtk_picture_options, reserved, 20, 4);
  FIELD(riis_vtk_picture_options, title, 24, 8);
  FIELD(riis_vtk_picture_options, leaflet_names, 32, 8);
  FIELD(riis_vtk_picture_options, n_leaflet_names, 40, 8);
  FIELD(riis_vtk_picture_options, n_leaking_edges, 48, 8);
  FIELD(riis_vtk_picture_options, leaking_edges, 56, 8);
}

static void test_constants(void **state) {
  (void)state;
  assert_int_equal(RIIS_OK, 0);
  assert_int_equal(RIIS_INVALID_ARGUMENT, 1);
  assert_int_equal(RIIS_INVALID_STRUCT_SIZE, 2);
  assert_int_equal(RIIS_INVALID_PARAMETER, 3);
  assert_int_equal(RIIS_INVALID_SURFACE, 4);
  assert_int_equal(RIIS_INVALID_MESH, 5);
  assert_int_equal(RIIS_LIMIT_EXCEEDED, 6);
  assert_int_equal(RIIS_OUT_OF_MEMORY, 7);
  assert_int_equal(RIIS_FILE_ERROR, 8);
  assert_int_equal(RIIS_UNAVAILABLE, 9);
  assert_int_equal(RIIS_INTERNAL_ERROR, -1);
  assert_int_equal(RIIS_LOG_INFO, 0);
  assert_int_equal(RIIS_LOG_WARNING, 1);
  assert_int_equal(RIIS_LEAFLET_RIGHT, 0);
  assert_int_equal(RIIS_LEAFLET_LEFT, 1);
  assert_int_equal(RIIS_LEAFLET_NON_CORONARY, 2);
  assert_int_equal(RIIS_LEAFLET_ANTERIOR, 0);
  assert_int_equal(RIIS_LEAFLET_POSTERIOR, 1);
  assert_int_equal(RIIS_LEAFLET_POSITIVE, 0);
  assert_int_equal(RIIS_LEAFLET_NEGATIVE, 1);
  assert_int_equal(RIIS_LEAFLET_HOUSING, 2);
  assert_int_equal(RIIS_ZERO_AREA_REFUSE, 0);
  assert_int_equal(RIIS_ZERO_AREA_SKIP, 1);
  assert_int_equal(RIIS_DISTANCE_TRIANGLES, 0);
  assert_int_equal(RIIS_DISTANCE_SAMPLING, 1);
  assert_int_equal(RIIS_DISTANCE_MINIMIZATION, 2);
  assert_int_equal(RIIS_SEARCH_AUTO, 0);
  assert_int_equal(RIIS_SEARCH_EXHAUSTIVE, 1);
  assert_int_equal(RIIS_SEARCH_NEIGHBOR, 2);
  assert_int_equal(RIIS_SEARCH_PAPER, 3);
  assert_int_equal(RIIS_SEARCH_CLUSTERS, 4);
  assert_int_equal(RIIS_INSTRUCTIONS_AUTO, 0);
  assert_int_equal(RIIS_INSTRUCTIONS_BASELINE, 1);
  assert_int_equal(RIIS_INSTRUCTIONS_AVX2, 2);
  assert_int_equal(RIIS_INSTRUCTIONS_AVX512, 3);
  assert_int_equal(RIIS_FIELD_POINT, 1);
  assert_int_equal(RIIS_FIELD_NORMAL, 2);
  assert_int_equal(RIIS_FIELD_BARYCENTRIC, 4);
  assert_int_equal(RIIS_FIELD_SIDE, 8);
  assert_int_equal(RIIS_FIELD_RIM, 16);
  assert_int_equal(RIIS_FIELD_UV, 32);
  assert_int_equal(RIIS_FIELD_VELOCITY, 64);
  assert_int_equal(RIIS_FIELD_PATCH, 128);
  assert_int_equal(RIIS_RIM_ROUND, 0);
  assert_int_equal(RIIS_RIM_CUT, 1);
  assert_int_equal(RIIS_INTERPOLATION_LINEAR, 0);
  assert_int_equal(RIIS_INTERPOLATION_CUBIC, 1);
  assert_int_equal(RIIS_TRIANGULATION_ADAPTED, 0);
  assert_int_equal(RIIS_TRIANGULATION_FIXED, 1);
  assert_int_equal(RIIS_PASSAGE_CLOSED, 0);
  assert_int_equal(RIIS_PASSAGE_OPEN, 1);
  assert_int_equal(RIIS_PASSAGE_NONE, 2);
  assert_int_equal(RIIS_PHASE_CLOSING, 0);
  assert_int_equal(RIIS_PHASE_OPENING, 1);
  assert_int_equal(RIIS_VTK_VIEW_SIDE, 0);
  assert_int_equal(RIIS_VTK_VIEW_TOP, 1);
  assert_int_equal(RIIS_VTK_VIEW_OBLIQUE, 2);
  assert_true(RIIS_AUTO == -1.0);
  assert_true(RIIS_FAR_DISTANCE == 1.0e30);
}

static void test_signatures(void **state) {
  (void)state;
  SIZE(riis_status, 4);
  assert_true((riis_status)-1 < 0);
  assert_true(_Generic((riis_log_function)0, void (*)(void *, int32_t, const char *) : 1, default : 0));
  SIGNATURE(riis_status_name, const char *, (riis_status));
  SIGNATURE(riis_last_error, const char *, (void));
  SIGNATURE(riis_version, void, (int32_t *, int32_t *, int32_t *));
  SIGNATURE(riis_version_string, const char *, (void));
  SIGNATURE(riis_set_log, void, (riis_log_function, void *));
  SIGNATURE(riis_valve_create, int32_t, (const char *, riis_valve **));
  SIGNATURE(riis_valve_destroy, void, (riis_valve **));
  SIGNATURE(riis_valve_set, int32_t, (riis_valve *, const char *, int64_t, const double *));
  SIGNATURE(riis_valve_set_scalar, int32_t, (riis_valve *, const char *, double));
  SIGNATURE(riis_valve_get, int32_t, (const riis_valve *, const char *, int64_t, double *));
  SIGNATURE(riis_valve_set_open_state, int32_t, (riis_valve *, const riis_valve *));
  SIGNATURE(riis_patches_init, int32_t, (riis_patches *, int64_t));
  SIGNATURE(riis_valve_create_from_patches, int32_t, (const riis_patches *, riis_valve **));
  SIGNATURE(riis_valve_n_parameters, int32_t, (const riis_valve *, int64_t *));
  SIGNATURE(riis_valve_parameter, int32_t, (const riis_valve *, int64_t, riis_parameter *, int64_t));
  SIGNATURE(riis_surface_options_init, int32_t, (riis_surface_options *, int64_t));
  SIGNATURE(riis_surface_create, int32_t, (const riis_valve *, const riis_surface_options *, riis_surface **));
  SIGNATURE(riis_surface_arrays_init, int32_t, (riis_surface_arrays *, int64_t));
  SIGNATURE(riis_surface_create_from_arrays, int32_t,
            (const riis_surface_arrays *, const riis_surface_options *, riis_surface **));
  SIGNATURE(riis_surface_update, int32_t, (riis_surface *, const riis_valve *, const riis_surface_options *));
  SIGNATURE(riis_surface_update_from_arrays, int32_t,
            (riis_surface *, const riis_surface_arrays *, const riis_surface_options *));
  SIGNATURE(riis_surface_destroy, void, (riis_surface **));
  SIGNATURE(riis_surface_get_info, int32_t, (const riis_surface *, riis_surface_info *, int64_t));
  SIGNATURE(riis_surface_vertices, int32_t, (const riis_surface *, int64_t *, const double **));
  SIGNATURE(riis_surface_vertex_parameters, int32_t, (const riis_surface *, int64_t *, const double **));
  SIGNATURE(riis_surface_triangles, int32_t,
            (const riis_surface *, int64_t *, const int64_t **, const int64_t **, const int32_t **, const int32_t **));
  SIGNATURE(riis_closest_point, int32_t, (const riis_surface *, const double *, riis_closest *, int64_t));
  SIGNATURE(riis_closest_options_init, int32_t, (riis_closest_options *, int64_t));
  SIGNATURE(riis_closest_arrays_init, int32_t, (riis_closest_arrays *, int64_t));
  SIGNATURE(riis_closest_points, int32_t,
            (const riis_surface *, int64_t, const double *, const double *, const double *, int64_t,
             const riis_closest_options *, const riis_closest_arrays *));
  SIGNATURE(riis_mesh_create, int32_t,
            (int64_t, const double *, const double *, const double *, int64_t, riis_mesh **));
  SIGNATURE(riis_mesh_update, int32_t, (riis_mesh *, int64_t, const double *, const double *, const double *, int64_t));
  SIGNATURE(riis_mesh_prepare, int32_t, (riis_mesh *, int32_t));
  SIGNATURE(riis_mesh_destroy, void, (riis_mesh **));
  SIGNATURE(riis_csr_init, int32_t, (riis_csr *, int64_t));
  SIGNATURE(riis_mesh_set_adjacency, int32_t, (riis_mesh *, const riis_csr *));
  SIGNATURE(riis_cells_init, int32_t, (riis_cells *, int64_t));
  SIGNATURE(riis_adjacency_create_from_cells, int32_t, (const riis_cells *, riis_adjacency **));
  SIGNATURE(riis_faces_init, int32_t, (riis_faces *, int64_t));
  SIGNATURE(riis_adjacency_create_from_faces, int32_t, (const riis_faces *, riis_adjacency **));
  SIGNATURE(riis_adjacency_create_from_grid, int32_t, (int64_t, int64_t, int64_t, int32_t, riis_adjacency **));
  SIGNATURE(riis_adjacency_csr, int32_t, (const riis_adjacency *, riis_csr *, int64_t));
  SIGNATURE(riis_adjacency_destroy, void, (riis_adjacency **));
  SIGNATURE(riis_mark_result_create, int32_t, (riis_mark_result **));
  SIGNATURE(riis_mark_result_destroy, void, (riis_mark_result **));
  SIGNATURE(riis_mark_options_init, int32_t, (riis_mark_options *, int64_t));
  SIGNATURE(riis_mark_nodes, int32_t,
            (const riis_surface *, const riis_mesh *, const riis_mark_options *, riis_mark_result *));
  SIGNATURE(
      riis_mark_result_marked, int32_t,
      (const riis_mark_result *, int64_t *, const int64_t **, const double **, const int64_t **, const int32_t **));
  SIGNATURE(
      riis_mark_result_within_limit, int32_t,
      (const riis_mark_result *, int64_t *, const int64_t **, const double **, const int64_t **, const int32_t **));
  SIGNATURE(riis_mark_result_dense, int32_t,
            (const riis_mark_result *, int64_t, double, uint8_t *, double *, int64_t *, int32_t *));
  SIGNATURE(riis_mark_result_stats, int32_t, (const riis_mark_result *, riis_mark_stats *, int64_t));
  SIGNATURE(
      riis_find_leaks, int32_t,
      (const riis_surface *, const riis_mesh *, const riis_mark_options *, riis_mark_result *, riis_leaks *, int64_t));
  SIGNATURE(riis_mark_result_leaking_edges, int32_t,
            (const riis_mark_result *, int64_t *, const int64_t **, const double **, const double **));
  SIGNATURE(riis_crossing_options_init, int32_t, (riis_crossing_options *, int64_t));
  SIGNATURE(riis_find_crossings, int32_t, (riis_surface *, const riis_crossing_options *, riis_crossings *, int64_t));
  SIGNATURE(riis_surface_crossing_pairs, int32_t,
            (const riis_surface *, int64_t *, const int64_t **, const double **, const double **, const double **));
  SIGNATURE(riis_label_open_regions, int32_t,
            (const riis_mesh *, const riis_mark_options *, const riis_mark_result *, int64_t, int64_t *, int64_t *));
  SIGNATURE(riis_find_passage, int32_t,
            (const riis_surface *, const riis_mesh *, const riis_mark_options *, int64_t, const int64_t *, int64_t,
             const int64_t *, riis_passage *, int64_t));
  SIGNATURE(riis_valve_copy, int32_t, (const riis_valve *, riis_valve **));
  SIGNATURE(riis_surface_update_moving, int32_t,
            (riis_surface *, const riis_valve *, const riis_valve *, double, const riis_surface_options *,
             const riis_surface_options *));
  SIGNATURE(riis_surface_vertex_velocities, int32_t, (const riis_surface *, int64_t *, const double **));
  SIGNATURE(riis_mark_result_marked_fields, int32_t, (const riis_mark_result *, riis_mark_fields *, int64_t));
  SIGNATURE(riis_mark_result_within_limit_fields, int32_t, (const riis_mark_result *, riis_mark_fields *, int64_t));
  SIGNATURE(riis_resistance_init, int32_t, (riis_resistance *, int64_t));
  SIGNATURE(riis_mark_result_add_resistance, int32_t,
            (const riis_mark_result *, const riis_resistance *, int64_t, double *, double *));
  SIGNATURE(riis_mark_result_add_reaction, int32_t,
            (const riis_mark_result *, const riis_resistance *, int64_t, const double *, const double *, double *));
  SIGNATURE(
      riis_mark_result_band_sums, int32_t,
      (const riis_mark_result *, double, double, int64_t, const double *, const double *, riis_band_sums *, int64_t));
  SIGNATURE(riis_opening_table_init, int32_t, (riis_opening_table *, int64_t));
  SIGNATURE(riis_opening_from_table, int32_t, (const riis_opening_table *, double, double *, double *));
  SIGNATURE(riis_opening_times_init, int32_t, (riis_opening_times *, int64_t));
  SIGNATURE(riis_opening_from_times, int32_t, (const riis_opening_times *, double, double *, double *));
  SIGNATURE(riis_opening_switch_init, int32_t, (riis_opening_switch *, int64_t));
  SIGNATURE(riis_opening_switch_state_init, int32_t, (riis_opening_switch_state *, int64_t));
  SIGNATURE(riis_opening_switch_advance, int32_t,
            (const riis_opening_switch *, const riis_opening_switch_state *, double, double, double,
             riis_opening_switch_state *));
  SIGNATURE(riis_opening_angle_init, int32_t, (riis_opening_angle *, int64_t));
  SIGNATURE(riis_opening_angle_state_init, int32_t, (riis_opening_angle_state *, int64_t));
  SIGNATURE(riis_opening_angle_advance, int32_t,
            (const riis_opening_angle *, const riis_opening_angle_state *, double, double, double,
             riis_opening_angle_state *));
  SIGNATURE(riis_keyframe_arrays_init, int32_t, (riis_keyframe_arrays *, int64_t));
  SIGNATURE(riis_keyframes_create, int32_t,
            (const riis_surface_arrays *, const riis_keyframe_arrays *, riis_keyframes **));
  SIGNATURE(riis_keyframes_destroy, void, (riis_keyframes **));
  SIGNATURE(riis_surface_create_from_keyframes, int32_t,
            (const riis_keyframes *, double, double, const riis_surface_options *, riis_surface **));
  SIGNATURE(riis_surface_update_from_keyframes, int32_t,
            (riis_surface *, const riis_keyframes *, double, double, const riis_surface_options *));
  SIGNATURE(riis_vtk_mesh_read, int32_t, (const char *, riis_vtk_mesh **));
  SIGNATURE(riis_vtk_mesh_destroy, void, (riis_vtk_mesh **));
  SIGNATURE(riis_vtk_mesh_nodes, int32_t, (const riis_vtk_mesh *, int64_t *, int64_t *, const double **));
  SIGNATURE(riis_vtk_mesh_adjacency, int32_t, (const riis_vtk_mesh *, int32_t, riis_adjacency **));
  SIGNATURE(riis_vtk_mesh_long_edges, int32_t,
            (const riis_vtk_mesh *, const riis_surface *, double, int32_t, int64_t *, riis_adjacency **));
  SIGNATURE(riis_vtk_mesh_set_marks, int32_t, (riis_vtk_mesh *, const riis_mark_result *, double));
  SIGNATURE(riis_vtk_mesh_set_named_marks, int32_t, (riis_vtk_mesh *, const riis_mark_result *, double, const char *));
  SIGNATURE(riis_vtk_mesh_set_point_array, int32_t, (riis_vtk_mesh *, const char *, int64_t, int64_t, const double *));
  SIGNATURE(riis_vtk_mesh_set_fields, int32_t, (riis_vtk_mesh *, const riis_mark_result *, int32_t, const char *));
  SIGNATURE(riis_vtk_mesh_extract, int32_t, (const riis_vtk_mesh *, int64_t, const int64_t *, riis_vtk_mesh **));
  SIGNATURE(riis_vtk_mesh_file_size, int32_t, (const riis_vtk_mesh *, int64_t *));
  SIGNATURE(riis_vtk_mesh_has_point_array, int32_t, (const riis_vtk_mesh *, const char *, int32_t *));
  SIGNATURE(riis_vtk_mesh_median_edge, int32_t, (const riis_vtk_mesh *, double *));
  SIGNATURE(riis_vtk_mesh_write, int32_t, (const riis_vtk_mesh *, const char *));
  SIGNATURE(riis_vtk_surface_read, int32_t, (const char *, riis_vtk_surface **));
  SIGNATURE(riis_vtk_surface_read_with_leaflets, int32_t, (const char *, const char *, riis_vtk_surface **));
  SIGNATURE(riis_vtk_surface_number_pieces, int32_t, (riis_vtk_surface *));
  SIGNATURE(riis_vtk_surface_destroy, void, (riis_vtk_surface **));
  SIGNATURE(riis_vtk_surface_arrays, int32_t, (const riis_vtk_surface *, riis_surface_arrays *));
  SIGNATURE(riis_vtk_surface_write, int32_t, (const riis_surface *, const char *));
  SIGNATURE(riis_vtk_motion_read_pvd, int32_t, (const char *, const char *, riis_vtk_motion **));
  SIGNATURE(riis_vtk_motion_read_files, int32_t,
            (int64_t, const char *const *, const double *, const char *, riis_vtk_motion **));
  SIGNATURE(riis_vtk_motion_read_displacements, int32_t,
            (const char *, const char *, int64_t, const double *, const char *, riis_vtk_motion **));
  SIGNATURE(riis_vtk_motion_files, int32_t, (const riis_vtk_motion *, int64_t *, const char *const **));
  SIGNATURE(riis_vtk_motion_number_pieces, int32_t, (riis_vtk_motion *));
  SIGNATURE(riis_vtk_motion_destroy, void, (riis_vtk_motion **));
  SIGNATURE(riis_vtk_motion_arrays, int32_t, (const riis_vtk_motion *, riis_surface_arrays *, riis_keyframe_arrays *));
  SIGNATURE(riis_vtk_picture_options_init, int32_t, (riis_vtk_picture_options *, int64_t));
  SIGNATURE(
      riis_vtk_film_create, int32_t,
      (const riis_vtk_mesh *, const double *, const double *, const riis_vtk_picture_options *, riis_vtk_film **));
  SIGNATURE(riis_vtk_film_draw, int32_t, (riis_vtk_film *, const riis_surface *, const char *, const char *));
  SIGNATURE(riis_vtk_film_destroy, void, (riis_vtk_film **));
  SIGNATURE(riis_vtk_draw, int32_t,
            (const riis_surface *, const riis_vtk_mesh *, const riis_vtk_picture_options *, const char *));
  SIGNATURE(riis_vtk_draw_views, int32_t,
            (const riis_surface *, const riis_vtk_mesh *, const riis_vtk_picture_options *, int64_t, const int32_t *,
             const char *const *));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_structs),
      cmocka_unit_test(test_constants),
      cmocka_unit_test(test_signatures),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
