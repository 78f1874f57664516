/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests the layouts and values that compiled programs rely on. The numbers are literals, written when the interface was released.
 * A changed number breaks programs, so new fields, functions and values are only appended, with new lines here. Of the old lines,
 * only the size of a struct that grew may change. */
#include <riis/riis.h>
#include <riis/riis_vtk.h>

#include "test_cases.h"

#define SIZE(type, size) assert_int_equal(sizeof(type), size)
#define FIELD(type, field, offset, size)                \
  do {                                                  \
    assert_int_equal(offsetof(type, field), offset);    \
    assert_int_equal(sizeof(((type *)0)->field), size); \
  } while (0)
/* Checks the type of a function, including its arguments. Callers in other languages rely on these types, although they do not
 * see the header. */
#define SIGNATURE(function, result, arguments) assert_true(_Generic(&function, result(*) arguments : 1, default : 0))

TEST(test_structs) {
  SIZE(riis_points, 56);
  FIELD(riis_points, struct_size, 0, 8);
  FIELD(riis_points, n_points, 8, 8);
  FIELD(riis_points, x, 16, 8);
  FIELD(riis_points, y, 24, 8);
  FIELD(riis_points, z, 32, 8);
  FIELD(riis_points, stride, 40, 8);
  FIELD(riis_points, real_bits, 48, 4);
  FIELD(riis_points, reserved, 52, 4);

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

  SIZE(riis_parameter, 96);
  FIELD(riis_parameter, name, 0, 8);
  FIELD(riis_parameter, unit, 8, 8);
  FIELD(riis_parameter, description, 16, 8);
  FIELD(riis_parameter, n_values, 24, 8);
  FIELD(riis_parameter, default_values, 32, 24);
  FIELD(riis_parameter, minimum, 56, 8);
  FIELD(riis_parameter, maximum, 64, 8);
  FIELD(riis_parameter, rule, 72, 8);
  FIELD(riis_parameter, other_name, 80, 8);
  FIELD(riis_parameter, other_factor, 88, 8);

  SIZE(riis_surface_options, 128);
  FIELD(riis_surface_options, struct_size, 0, 8);
  FIELD(riis_surface_options, half_thickness, 8, 8);
  FIELD(riis_surface_options, tolerance, 16, 8);
  FIELD(riis_surface_options, scale, 24, 8);
  FIELD(riis_surface_options, rotation_axis, 32, 24);
  FIELD(riis_surface_options, rotation_angle, 56, 8);
  FIELD(riis_surface_options, translation, 64, 24);
  FIELD(riis_surface_options, measure_tolerance, 88, 8);
  FIELD(riis_surface_options, measure, 96, 4);
  FIELD(riis_surface_options, triangulation, 100, 4);
  FIELD(riis_surface_options, zero_area, 104, 4);
  FIELD(riis_surface_options, flip_normals, 108, 4);
  FIELD(riis_surface_options, n_threads, 112, 4);
  FIELD(riis_surface_options, reserved, 116, 4);
  FIELD(riis_surface_options, offset, 120, 8);

  SIZE(riis_surface_arrays, 144);
  FIELD(riis_surface_arrays, struct_size, 0, 8);
  FIELD(riis_surface_arrays, n_vertices, 8, 8);
  FIELD(riis_surface_arrays, x, 16, 8);
  FIELD(riis_surface_arrays, y, 24, 8);
  FIELD(riis_surface_arrays, z, 32, 8);
  FIELD(riis_surface_arrays, stride, 40, 8);
  FIELD(riis_surface_arrays, vx, 48, 8);
  FIELD(riis_surface_arrays, vy, 56, 8);
  FIELD(riis_surface_arrays, vz, 64, 8);
  FIELD(riis_surface_arrays, velocity_stride, 72, 8);
  FIELD(riis_surface_arrays, n_faces, 80, 8);
  FIELD(riis_surface_arrays, vertex_ids, 88, 8);
  FIELD(riis_surface_arrays, leaflet_id, 96, 8);
  FIELD(riis_surface_arrays, corners_per_face, 104, 4);
  FIELD(riis_surface_arrays, id_bits, 108, 4);
  FIELD(riis_surface_arrays, index_base, 112, 4);
  FIELD(riis_surface_arrays, real_bits, 116, 4);
  FIELD(riis_surface_arrays, skirt_length, 120, 8);
  FIELD(riis_surface_arrays, attached, 128, 8);
  FIELD(riis_surface_arrays, skirt_lengths, 136, 8);

  SIZE(riis_keyframe_arrays, 56);
  FIELD(riis_keyframe_arrays, struct_size, 0, 8);
  FIELD(riis_keyframe_arrays, n_keys, 8, 8);
  FIELD(riis_keyframe_arrays, n_vertices, 16, 8);
  FIELD(riis_keyframe_arrays, time, 24, 8);
  FIELD(riis_keyframe_arrays, xyz, 32, 8);
  FIELD(riis_keyframe_arrays, period, 40, 8);
  FIELD(riis_keyframe_arrays, interpolation, 48, 4);
  FIELD(riis_keyframe_arrays, real_bits, 52, 4);

  SIZE(riis_surface_info, 144);
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
  FIELD(riis_surface_info, largest_leaflet_id, 112, 8);
  FIELD(riis_surface_info, offset, 120, 8);
  FIELD(riis_surface_info, contact_depth, 128, 8);
  FIELD(riis_surface_info, skirt_leaflet_id, 136, 4);
  FIELD(riis_surface_info, housing_leaflet_id, 140, 4);

  SIZE(riis_attachment, 40);
  FIELD(riis_attachment, n_edges, 0, 8);
  FIELD(riis_attachment, edges, 8, 8);
  FIELD(riis_attachment, vertex_id, 16, 8);
  FIELD(riis_attachment, leaflet_id, 24, 8);
  FIELD(riis_attachment, patch_id, 32, 8);

  SIZE(riis_direction, 24);
  FIELD(riis_direction, n_vertices, 0, 8);
  FIELD(riis_direction, rate, 8, 8);
  FIELD(riis_direction, area_rate, 16, 8);

  SIZE(riis_warp_options, 24);
  FIELD(riis_warp_options, struct_size, 0, 8);
  FIELD(riis_warp_options, noise, 8, 8);
  FIELD(riis_warp_options, placement, 16, 8);

  SIZE(riis_warp_info, 80);
  FIELD(riis_warp_info, n_landmarks, 0, 8);
  FIELD(riis_warp_info, rms_residual, 8, 8);
  FIELD(riis_warp_info, largest_residual, 16, 8);
  FIELD(riis_warp_info, largest_landmark_id, 24, 8);
  FIELD(riis_warp_info, smoothing, 32, 8);
  FIELD(riis_warp_info, least_determinant, 40, 8);
  FIELD(riis_warp_info, least_point, 48, 24);
  FIELD(riis_warp_info, is_planar, 72, 4);
  FIELD(riis_warp_info, reserved, 76, 4);

  SIZE(riis_valve_patches, 96);
  FIELD(riis_valve_patches, n_curves, 0, 8);
  FIELD(riis_valve_patches, n_pieces, 8, 8);
  FIELD(riis_valve_patches, first_piece, 16, 8);
  FIELD(riis_valve_patches, degree, 24, 8);
  FIELD(riis_valve_patches, control, 32, 8);
  FIELD(riis_valve_patches, n_patches, 40, 8);
  FIELD(riis_valve_patches, curve_id, 48, 8);
  FIELD(riis_valve_patches, reversed, 56, 8);
  FIELD(riis_valve_patches, leaflet_id, 64, 8);
  FIELD(riis_valve_patches, patch_id, 72, 8);
  FIELD(riis_valve_patches, attached, 80, 8);
  FIELD(riis_valve_patches, bulge, 88, 8);

  SIZE(riis_triangles, 72);
  FIELD(riis_triangles, n_vertices, 0, 8);
  FIELD(riis_triangles, xyz, 8, 8);
  FIELD(riis_triangles, uv, 16, 8);
  FIELD(riis_triangles, velocity, 24, 8);
  FIELD(riis_triangles, n_triangles, 32, 8);
  FIELD(riis_triangles, vertex_id, 40, 8);
  FIELD(riis_triangles, triangle_id, 48, 8);
  FIELD(riis_triangles, leaflet_id, 56, 8);
  FIELD(riis_triangles, patch_id, 64, 8);

  SIZE(riis_crossing_options, 24);
  FIELD(riis_crossing_options, struct_size, 0, 8);
  FIELD(riis_crossing_options, depth, 8, 8);
  FIELD(riis_crossing_options, n_threads, 16, 4);
  FIELD(riis_crossing_options, reserved, 20, 4);

  SIZE(riis_crossing_list, 112);
  FIELD(riis_crossing_list, n_pairs, 0, 8);
  FIELD(riis_crossing_list, triangle_id, 8, 8);
  FIELD(riis_crossing_list, point, 16, 8);
  FIELD(riis_crossing_list, depth, 24, 8);
  FIELD(riis_crossing_list, length, 32, 8);
  FIELD(riis_crossing_list, total_length, 40, 8);
  FIELD(riis_crossing_list, deepest_depth, 48, 8);
  FIELD(riis_crossing_list, deepest_point, 56, 24);
  FIELD(riis_crossing_list, deepest_triangle_id, 80, 16);
  FIELD(riis_crossing_list, deepest_leaflet_id, 96, 8);
  FIELD(riis_crossing_list, seconds, 104, 8);

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
  FIELD(riis_closest_options, point_mask, 24, 8);
  FIELD(riis_closest_options, n_point_ids, 32, 8);
  FIELD(riis_closest_options, point_ids, 40, 8);
  FIELD(riis_closest_options, n_threads, 48, 4);
  FIELD(riis_closest_options, reserved, 52, 4);

  SIZE(riis_closest_arrays, 64);
  FIELD(riis_closest_arrays, struct_size, 0, 8);
  FIELD(riis_closest_arrays, distance, 8, 8);
  FIELD(riis_closest_arrays, point, 16, 8);
  FIELD(riis_closest_arrays, barycentric, 24, 8);
  FIELD(riis_closest_arrays, normal, 32, 8);
  FIELD(riis_closest_arrays, triangle_id, 40, 8);
  FIELD(riis_closest_arrays, leaflet_id, 48, 8);
  FIELD(riis_closest_arrays, side, 56, 8);

  SIZE(riis_grid, 152);
  FIELD(riis_grid, struct_size, 0, 8);
  FIELD(riis_grid, ni, 8, 8);
  FIELD(riis_grid, nj, 16, 8);
  FIELD(riis_grid, nk, 24, 8);
  FIELD(riis_grid, x, 32, 8);
  FIELD(riis_grid, y, 40, 8);
  FIELD(riis_grid, z, 48, 8);
  FIELD(riis_grid, origin, 56, 24);
  FIELD(riis_grid, spacing, 80, 24);
  FIELD(riis_grid, first, 104, 8);
  FIELD(riis_grid, stride, 112, 24);
  FIELD(riis_grid, n_nodes, 136, 8);
  FIELD(riis_grid, real_bits, 144, 4);
  FIELD(riis_grid, reserved, 148, 4);

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

  SIZE(riis_mesh_cells, 56);
  FIELD(riis_mesh_cells, struct_size, 0, 8);
  FIELD(riis_mesh_cells, n_nodes, 8, 8);
  FIELD(riis_mesh_cells, n_cells, 16, 8);
  FIELD(riis_mesh_cells, node_ids, 24, 8);
  FIELD(riis_mesh_cells, offsets, 32, 8);
  FIELD(riis_mesh_cells, nodes_per_cell, 40, 4);
  FIELD(riis_mesh_cells, id_bits, 44, 4);
  FIELD(riis_mesh_cells, index_base, 48, 4);
  FIELD(riis_mesh_cells, n_threads, 52, 4);

  SIZE(riis_mesh_faces, 64);
  FIELD(riis_mesh_faces, struct_size, 0, 8);
  FIELD(riis_mesh_faces, n_cells, 8, 8);
  FIELD(riis_mesh_faces, n_faces, 16, 8);
  FIELD(riis_mesh_faces, owner, 24, 8);
  FIELD(riis_mesh_faces, neighbor, 32, 8);
  FIELD(riis_mesh_faces, stride, 40, 8);
  FIELD(riis_mesh_faces, id_bits, 48, 4);
  FIELD(riis_mesh_faces, index_base, 52, 4);
  FIELD(riis_mesh_faces, n_threads, 56, 4);
  FIELD(riis_mesh_faces, reserved, 60, 4);

  SIZE(riis_resistance, 32);
  FIELD(riis_resistance, struct_size, 0, 8);
  FIELD(riis_resistance, R, 8, 8);
  FIELD(riis_resistance, half_thickness, 16, 8);
  FIELD(riis_resistance, rim, 24, 4);
  FIELD(riis_resistance, reserved, 28, 4);

  SIZE(riis_mark_options, 48);
  FIELD(riis_mark_options, struct_size, 0, 8);
  FIELD(riis_mark_options, distance_limit, 8, 8);
  FIELD(riis_mark_options, node_mask, 16, 8);
  FIELD(riis_mark_options, resistance, 24, 8);
  FIELD(riis_mark_options, fields, 32, 4);
  FIELD(riis_mark_options, search, 36, 4);
  FIELD(riis_mark_options, n_threads, 40, 4);
  FIELD(riis_mark_options, instructions, 44, 4);

  SIZE(riis_mark_list, 152);
  FIELD(riis_mark_list, n_nodes, 0, 8);
  FIELD(riis_mark_list, node_id, 8, 8);
  FIELD(riis_mark_list, distance, 16, 8);
  FIELD(riis_mark_list, triangle_id, 24, 8);
  FIELD(riis_mark_list, leaflet_id, 32, 8);
  FIELD(riis_mark_list, K, 40, 8);
  FIELD(riis_mark_list, K_u_surface, 48, 8);
  FIELD(riis_mark_list, point, 56, 8);
  FIELD(riis_mark_list, normal, 64, 8);
  FIELD(riis_mark_list, barycentric, 72, 8);
  FIELD(riis_mark_list, uv, 80, 8);
  FIELD(riis_mark_list, velocity, 88, 8);
  FIELD(riis_mark_list, side, 96, 8);
  FIELD(riis_mark_list, rim, 104, 8);
  FIELD(riis_mark_list, patch_id, 112, 8);
  FIELD(riis_mark_list, n_directions, 120, 8);
  FIELD(riis_mark_list, distance_gradient, 128, 8);
  FIELD(riis_mark_list, K_gradient, 136, 8);
  FIELD(riis_mark_list, height, 144, 8);

  SIZE(riis_dense_arrays, 56);
  FIELD(riis_dense_arrays, struct_size, 0, 8);
  FIELD(riis_dense_arrays, n_nodes, 8, 8);
  FIELD(riis_dense_arrays, far_distance, 16, 8);
  FIELD(riis_dense_arrays, mark, 24, 8);
  FIELD(riis_dense_arrays, distance, 32, 8);
  FIELD(riis_dense_arrays, triangle_id, 40, 8);
  FIELD(riis_dense_arrays, leaflet_id, 48, 8);

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

  SIZE(riis_resistance_arrays, 64);
  FIELD(riis_resistance_arrays, struct_size, 0, 8);
  FIELD(riis_resistance_arrays, n_nodes, 8, 8);
  FIELD(riis_resistance_arrays, K, 16, 8);
  FIELD(riis_resistance_arrays, K_stride, 24, 8);
  FIELD(riis_resistance_arrays, K_u_surface, 32, 24);
  FIELD(riis_resistance_arrays, K_u_surface_stride, 56, 8);

  SIZE(riis_flow_arrays, 56);
  FIELD(riis_flow_arrays, struct_size, 0, 8);
  FIELD(riis_flow_arrays, n_nodes, 8, 8);
  FIELD(riis_flow_arrays, velocity, 16, 24);
  FIELD(riis_flow_arrays, velocity_stride, 40, 8);
  FIELD(riis_flow_arrays, weight, 48, 8);

  SIZE(riis_reaction, 112);
  FIELD(riis_reaction, struct_size, 0, 8);
  FIELD(riis_reaction, about, 8, 24);
  FIELD(riis_reaction, force, 32, 8);
  FIELD(riis_reaction, moment, 40, 8);
  FIELD(riis_reaction, n_leaflets, 48, 8);
  FIELD(riis_reaction, leaflet_force, 56, 8);
  FIELD(riis_reaction, leaflet_moment, 64, 8);
  FIELD(riis_reaction, n_edges, 72, 8);
  FIELD(riis_reaction, edges, 80, 8);
  FIELD(riis_reaction, edge_leaflet_id, 88, 8);
  FIELD(riis_reaction, edge_force, 96, 8);
  FIELD(riis_reaction, edge_moment, 104, 8);
  SIZE(riis_loads, 96);
  FIELD(riis_loads, struct_size, 0, 8);
  FIELD(riis_loads, radius, 8, 8);
  FIELD(riis_loads, about, 16, 24);
  FIELD(riis_loads, n_leaflets, 40, 8);
  FIELD(riis_loads, leaflet_force, 48, 8);
  FIELD(riis_loads, leaflet_moment, 56, 8);
  FIELD(riis_loads, n_edges, 64, 8);
  FIELD(riis_loads, edges, 72, 8);
  FIELD(riis_loads, edge_leaflet_id, 80, 8);
  FIELD(riis_loads, n_threads, 88, 4);
  FIELD(riis_loads, reserved, 92, 4);

  SIZE(riis_band_sums, 48);
  FIELD(riis_band_sums, sum, 0, 16);
  FIELD(riis_band_sums, weight, 16, 16);
  FIELD(riis_band_sums, n_nodes, 32, 16);

  SIZE(riis_band, 48);
  FIELD(riis_band, struct_size, 0, 8);
  FIELD(riis_band, inner, 8, 8);
  FIELD(riis_band, outer, 16, 8);
  FIELD(riis_band, n_nodes, 24, 8);
  FIELD(riis_band, value, 32, 8);
  FIELD(riis_band, weight, 40, 8);

  SIZE(riis_leak_list, 96);
  FIELD(riis_leak_list, n_edges, 0, 8);
  FIELD(riis_leak_list, node_id, 8, 8);
  FIELD(riis_leak_list, length, 16, 8);
  FIELD(riis_leak_list, distance, 24, 8);
  FIELD(riis_leak_list, half_thickness, 32, 8);
  FIELD(riis_leak_list, longest_node_id, 40, 16);
  FIELD(riis_leak_list, longest_length, 56, 8);
  FIELD(riis_leak_list, longest_middle, 64, 24);
  FIELD(riis_leak_list, seconds, 88, 8);

  SIZE(riis_passage, 56);
  FIELD(riis_passage, node_id, 0, 8);
  FIELD(riis_passage, distance, 8, 8);
  FIELD(riis_passage, point, 16, 24);
  FIELD(riis_passage, seconds, 40, 8);
  FIELD(riis_passage, state, 48, 4);
  FIELD(riis_passage, reserved, 52, 4);

  SIZE(riis_passage_ends, 40);
  FIELD(riis_passage_ends, struct_size, 0, 8);
  FIELD(riis_passage_ends, n_from, 8, 8);
  FIELD(riis_passage_ends, from, 16, 8);
  FIELD(riis_passage_ends, n_to, 24, 8);
  FIELD(riis_passage_ends, to, 32, 8);

  SIZE(riis_leaflet, 32);
  FIELD(riis_leaflet, n_triangles, 0, 8);
  FIELD(riis_leaflet, area, 8, 8);
  FIELD(riis_leaflet, free_edge, 16, 8);
  FIELD(riis_leaflet, leaflet_id, 24, 4);
  FIELD(riis_leaflet, reserved, 28, 4);

  SIZE(riis_orifice, 88);
  FIELD(riis_orifice, area, 0, 8);
  FIELD(riis_orifice, outline_area, 8, 8);
  FIELD(riis_orifice, perimeter, 16, 8);
  FIELD(riis_orifice, effective_area, 24, 8);
  FIELD(riis_orifice, rim_reach, 32, 8);
  FIELD(riis_orifice, half_thickness, 40, 8);
  FIELD(riis_orifice, radius, 48, 8);
  FIELD(riis_orifice, axis, 56, 24);
  FIELD(riis_orifice, outline, 80, 4);
  FIELD(riis_orifice, reserved, 84, 4);

  SIZE(riis_coaptation, 24);
  FIELD(riis_coaptation, area, 0, 8);
  FIELD(riis_coaptation, edge, 8, 8);
  FIELD(riis_coaptation, reach, 16, 8);

  SIZE(riis_gap, 64);
  FIELD(riis_gap, least, 0, 8);
  FIELD(riis_gap, mean, 8, 8);
  FIELD(riis_gap, most, 16, 8);
  FIELD(riis_gap, widest_point, 24, 24);
  FIELD(riis_gap, n_ends, 48, 8);
  FIELD(riis_gap, n_without_wall, 56, 8);

  SIZE(riis_area_search, 56);
  FIELD(riis_area_search, struct_size, 0, 8);
  FIELD(riis_area_search, surface, 8, 8);
  FIELD(riis_area_search, resistance, 16, 8);
  FIELD(riis_area_search, from, 24, 8);
  FIELD(riis_area_search, to, 32, 8);
  FIELD(riis_area_search, tolerance, 40, 8);
  FIELD(riis_area_search, n_samples, 48, 4);
  FIELD(riis_area_search, area, 52, 4);

  SIZE(riis_area_range, 112);
  FIELD(riis_area_range, from, 0, 8);
  FIELD(riis_area_range, to, 8, 8);
  FIELD(riis_area_range, least, 16, 8);
  FIELD(riis_area_range, most, 24, 8);
  FIELD(riis_area_range, least_at, 32, 8);
  FIELD(riis_area_range, most_at, 40, 8);
  FIELD(riis_area_range, turns, 48, 32);
  FIELD(riis_area_range, seconds, 80, 8);
  FIELD(riis_area_range, n_turns, 88, 8);
  FIELD(riis_area_range, n_surfaces, 96, 8);
  FIELD(riis_area_range, n_refused, 104, 8);

  SIZE(riis_first_passage_options, 32);
  FIELD(riis_first_passage_options, struct_size, 0, 8);
  FIELD(riis_first_passage_options, surface, 8, 8);
  FIELD(riis_first_passage_options, marking, 16, 8);
  FIELD(riis_first_passage_options, tolerance, 24, 8);

  SIZE(riis_first_passage, 72);
  FIELD(riis_first_passage, opening, 0, 8);
  FIELD(riis_first_passage, closed_opening, 8, 8);
  FIELD(riis_first_passage, node_id, 16, 8);
  FIELD(riis_first_passage, distance, 24, 8);
  FIELD(riis_first_passage, point, 32, 24);
  FIELD(riis_first_passage, seconds, 56, 8);
  FIELD(riis_first_passage, n_openings, 64, 4);
  FIELD(riis_first_passage, state, 68, 4);

  SIZE(riis_cells_across, 64);
  FIELD(riis_cells_across, least, 0, 8);
  FIELD(riis_cells_across, mean, 8, 8);
  FIELD(riis_cells_across, most, 16, 8);
  FIELD(riis_cells_across, shortest_edge, 24, 8);
  FIELD(riis_cells_across, mean_edge, 32, 8);
  FIELD(riis_cells_across, longest_edge, 40, 8);
  FIELD(riis_cells_across, half_thickness, 48, 8);
  FIELD(riis_cells_across, n_edges, 56, 8);

  SIZE(riis_landmarks, 112);
  FIELD(riis_landmarks, struct_size, 0, 8);
  FIELD(riis_landmarks, n_landmarks, 8, 8);
  FIELD(riis_landmarks, x, 16, 8);
  FIELD(riis_landmarks, y, 24, 8);
  FIELD(riis_landmarks, z, 32, 8);
  FIELD(riis_landmarks, stride, 40, 8);
  FIELD(riis_landmarks, role, 48, 8);
  FIELD(riis_landmarks, leaflet_id, 56, 8);
  FIELD(riis_landmarks, scale, 64, 8);
  FIELD(riis_landmarks, noise, 72, 8);
  FIELD(riis_landmarks, flow, 80, 24);
  FIELD(riis_landmarks, real_bits, 104, 4);
  FIELD(riis_landmarks, reserved, 108, 4);

  SIZE(riis_placement, 120);
  FIELD(riis_placement, scale, 0, 8);
  FIELD(riis_placement, rotation_axis, 8, 24);
  FIELD(riis_placement, rotation_angle, 32, 8);
  FIELD(riis_placement, translation, 40, 24);
  FIELD(riis_placement, rms, 64, 8);
  FIELD(riis_placement, worst, 72, 8);
  FIELD(riis_placement, noise, 80, 8);
  FIELD(riis_placement, rotation_error, 88, 8);
  FIELD(riis_placement, position_error, 96, 8);
  FIELD(riis_placement, worst_landmark_id, 104, 8);
  FIELD(riis_placement, n_undetermined, 112, 4);
  FIELD(riis_placement, n_as_annulus, 116, 4);

  SIZE(riis_placement_arrays, 40);
  FIELD(riis_placement_arrays, struct_size, 0, 8);
  FIELD(riis_placement_arrays, residual, 8, 8);
  FIELD(riis_placement_arrays, standard_error, 16, 8);
  FIELD(riis_placement_arrays, size_state, 24, 8);
  FIELD(riis_placement_arrays, place, 32, 8);

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
  FIELD(riis_opening_times, opening_duration, 16, 8);
  FIELD(riis_opening_times, closing_start, 24, 8);
  FIELD(riis_opening_times, closing_duration, 32, 8);
  FIELD(riis_opening_times, closed, 40, 8);
  FIELD(riis_opening_times, open, 48, 8);
  FIELD(riis_opening_times, period, 56, 8);

  SIZE(riis_opening_switch, 56);
  FIELD(riis_opening_switch, struct_size, 0, 8);
  FIELD(riis_opening_switch, opening_duration, 8, 8);
  FIELD(riis_opening_switch, closing_duration, 16, 8);
  FIELD(riis_opening_switch, open_above, 24, 8);
  FIELD(riis_opening_switch, close_below, 32, 8);
  FIELD(riis_opening_switch, filter_time, 40, 8);
  FIELD(riis_opening_switch, dwell_time, 48, 8);

  SIZE(riis_opening_switch_state, 72);
  FIELD(riis_opening_switch_state, struct_size, 0, 8);
  FIELD(riis_opening_switch_state, time, 8, 8);
  FIELD(riis_opening_switch_state, opening, 16, 8);
  FIELD(riis_opening_switch_state, rate, 24, 8);
  FIELD(riis_opening_switch_state, progress, 32, 8);
  FIELD(riis_opening_switch_state, pressure_difference, 40, 8);
  FIELD(riis_opening_switch_state, flow, 48, 8);
  FIELD(riis_opening_switch_state, turn_time, 56, 8);
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

  SIZE(riis_vtk_sharing, 32);
  FIELD(riis_vtk_sharing, n_cells, 0, 8);
  FIELD(riis_vtk_sharing, n_volume_cells, 8, 8);
  FIELD(riis_vtk_sharing, n_cells_left_out, 16, 8);
  FIELD(riis_vtk_sharing, has_global_ids, 24, 4);
  FIELD(riis_vtk_sharing, reserved, 28, 4);
  SIZE(riis_vtk_picture_options, 160);
  FIELD(riis_vtk_picture_options, struct_size, 0, 8);
  FIELD(riis_vtk_picture_options, title, 8, 8);
  FIELD(riis_vtk_picture_options, unit, 16, 8);
  FIELD(riis_vtk_picture_options, n_leaflet_names, 24, 8);
  FIELD(riis_vtk_picture_options, leaflet_names, 32, 8);
  FIELD(riis_vtk_picture_options, n_leaking_edges, 40, 8);
  FIELD(riis_vtk_picture_options, leaking_edges, 48, 8);
  FIELD(riis_vtk_picture_options, view, 56, 4);
  FIELD(riis_vtk_picture_options, width, 60, 4);
  FIELD(riis_vtk_picture_options, height, 64, 4);
  FIELD(riis_vtk_picture_options, reserved, 68, 4);
  FIELD(riis_vtk_picture_options, rotation_axis, 72, 24);
  FIELD(riis_vtk_picture_options, rotation_angle, 96, 8);
  FIELD(riis_vtk_picture_options, wall, 104, 8);
  FIELD(riis_vtk_picture_options, background, 112, 32);
  FIELD(riis_vtk_picture_options, captions, 144, 4);
  FIELD(riis_vtk_picture_options, panels, 148, 4);
  FIELD(riis_vtk_picture_options, velocity, 152, 8);
}

TEST(test_constants) {
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
  assert_int_equal(RIIS_LEAFLET_SKIRT, 3);
  assert_int_equal(RIIS_ZERO_AREA_REFUSE, 0);
  assert_int_equal(RIIS_ZERO_AREA_SKIP, 1);
  assert_int_equal(RIIS_MEASURE_TRIANGLES, 0);
  assert_int_equal(RIIS_MEASURE_SAMPLING, 1);
  assert_int_equal(RIIS_MEASURE_MINIMIZATION, 2);
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
  assert_int_equal(RIIS_FIELD_GRADIENT, 256);
  assert_int_equal(RIIS_LIST_MARKED, 0);
  assert_int_equal(RIIS_LIST_WITHIN_LIMIT, 1);
  assert_int_equal(RIIS_RIM_ROUND, 0);
  assert_int_equal(RIIS_RIM_CUT, 1);
  assert_int_equal(RIIS_INTERPOLATION_LINEAR, 0);
  assert_int_equal(RIIS_INTERPOLATION_CUBIC, 1);
  assert_int_equal(RIIS_TRIANGULATION_ADAPTED, 0);
  assert_int_equal(RIIS_TRIANGULATION_FIXED, 1);
  assert_int_equal(RIIS_PASSAGE_CLOSED, 0);
  assert_int_equal(RIIS_PASSAGE_OPEN, 1);
  assert_int_equal(RIIS_PASSAGE_NONE, 2);
  assert_int_equal(RIIS_LANDMARK_COMMISSURE, 0);
  assert_int_equal(RIIS_LANDMARK_NADIR, 1);
  assert_int_equal(RIIS_LANDMARK_COAPTATION, 2);
  assert_int_equal(RIIS_LANDMARK_ANNULUS, 3);
  assert_int_equal(RIIS_LANDMARK_ANTERIOR_HORN, 4);
  assert_int_equal(RIIS_LANDMARK_POSTERIOR_HORN, 5);
  assert_int_equal(RIIS_LANDMARK_TRIGONE, 6);
  assert_int_equal(RIIS_LANDMARK_POSTEROMEDIAL, 7);
  assert_int_equal(RIIS_LANDMARK_ANTEROLATERAL, 8);
  assert_int_equal(RIIS_LANDMARK_HINGE, 9);
  assert_int_equal(RIIS_LANDMARK_ATTACHMENT, 10);
  assert_int_equal(RIIS_SIZE_KEPT, 0);
  assert_int_equal(RIIS_SIZE_DETERMINED, 1);
  assert_int_equal(RIIS_SIZE_TIED, 2);
  assert_int_equal(RIIS_SIZE_UNDETERMINED, 3);
  assert_int_equal(RIIS_OUTLINE_NONE, 0);
  assert_int_equal(RIIS_OUTLINE_DISC, 1);
  assert_int_equal(RIIS_OUTLINE_ATTACHMENT, 2);
  assert_int_equal(RIIS_OUTLINE_BOUNDARY, 3);
  assert_int_equal(RIIS_OUTLINE_WALL, 4);
  assert_int_equal(RIIS_FIRST_PASSAGE_FOUND, 0);
  assert_int_equal(RIIS_FIRST_PASSAGE_ALWAYS, 1);
  assert_int_equal(RIIS_FIRST_PASSAGE_NEVER, 2);
  assert_int_equal(RIIS_FIRST_PASSAGE_NONE, 3);
  assert_int_equal(RIIS_ALL_LEAFLETS, -1);
  assert_int_equal(RIIS_AREA_GEOMETRIC, 0);
  assert_int_equal(RIIS_AREA_EFFECTIVE, 1);
  assert_int_equal(RIIS_PHASE_CLOSING, 0);
  assert_int_equal(RIIS_PHASE_OPENING, 1);
  assert_int_equal(RIIS_VTK_NODE_INSIDE, 0);
  assert_int_equal(RIIS_VTK_NODE_SHARED, 1);
  assert_int_equal(RIIS_VTK_NODE_GHOST, 2);
  assert_int_equal(RIIS_VTK_NODE_LOOSE, 3);
  assert_int_equal(RIIS_VTK_VIEW_SIDE, 0);
  assert_int_equal(RIIS_VTK_VIEW_TOP, 1);
  assert_int_equal(RIIS_VTK_VIEW_OBLIQUE, 2);
  assert_int_equal(RIIS_VTK_VIEW_THREE, 3);
  assert_int_equal(RIIS_VTK_VIEW_VALVE_SIDE, 4);
  assert_int_equal(RIIS_VTK_VIEW_VALVE_TOP, 5);
  assert_int_equal(RIIS_VTK_VIEW_VALVE_OBLIQUE, 6);
  assert_int_equal(RIIS_VTK_VIEW_VALVE_THREE, 7);
  assert_int_equal(RIIS_VTK_VIEW_VALVE_LONG, 8);
  assert_int_equal(RIIS_VTK_CAPTIONS_ALL, 0);
  assert_int_equal(RIIS_VTK_CAPTIONS_SCALE, 1);
  assert_int_equal(RIIS_VTK_CAPTIONS_NONE, 2);
  assert_int_equal(RIIS_VTK_PANELS_BOTH, 0);
  assert_int_equal(RIIS_VTK_PANELS_VALVE, 1);
  assert_int_equal(RIIS_VTK_PANELS_MARKS, 2);
  assert_true(RIIS_AUTO == -1.0);
  assert_true(RIIS_FAR_DISTANCE == 1.0e30);
}

TEST(test_signatures) {
  SIZE(riis_status, 4);
  assert_true((riis_status)-1 < 0);
  assert_true(_Generic((riis_log_function)0, void (*)(void *, int32_t, const char *) : 1, default : 0));
  SIGNATURE(riis_status_name, const char *, (int32_t));
  SIGNATURE(riis_last_error, const char *, (void));
  SIGNATURE(riis_version_string, const char *, (void));
  SIGNATURE(riis_set_log, void, (riis_log_function, void *));
  SIGNATURE(riis_points_init, int32_t, (riis_points *, int64_t));
  SIGNATURE(riis_valve_create, int32_t, (const char *, riis_valve **));
  SIGNATURE(riis_valve_copy, int32_t, (const riis_valve *, riis_valve **));
  SIGNATURE(riis_valve_destroy, void, (riis_valve **));
  SIGNATURE(riis_valve_set, int32_t, (riis_valve *, const char *, int64_t, const double *));
  SIGNATURE(riis_valve_set_scalar, int32_t, (riis_valve *, const char *, double));
  SIGNATURE(riis_valve_get, int32_t, (const riis_valve *, const char *, int64_t, double *));
  SIGNATURE(riis_valve_unset, int32_t, (riis_valve *, const char *));
  SIGNATURE(riis_valve_is_set, int32_t, (const riis_valve *, const char *, int32_t *));
  SIGNATURE(riis_valve_set_open_state, int32_t, (riis_valve *, const riis_valve *));
  SIGNATURE(riis_patches_init, int32_t, (riis_patches *, int64_t));
  SIGNATURE(riis_valve_create_from_patches, int32_t, (const riis_patches *, riis_valve **));
  SIGNATURE(riis_valve_get_n_parameters, int32_t, (const riis_valve *, int64_t *));
  SIGNATURE(riis_valve_get_parameter, int32_t, (const riis_valve *, int64_t, riis_parameter *, int64_t));
  SIGNATURE(riis_surface_options_init, int32_t, (riis_surface_options *, int64_t));
  SIGNATURE(riis_surface_create, int32_t, (const riis_valve *, const riis_surface_options *, riis_surface **));
  SIGNATURE(riis_surface_arrays_init, int32_t, (riis_surface_arrays *, int64_t));
  SIGNATURE(riis_surface_create_from_arrays, int32_t,
            (const riis_surface_arrays *, const riis_surface_options *, riis_surface **));
  SIGNATURE(riis_surface_update, int32_t, (riis_surface *, const riis_valve *, const riis_surface_options *));
  SIGNATURE(riis_surface_update_moving, int32_t,
            (riis_surface *, const riis_valve *, const riis_valve *, double, const riis_surface_options *,
             const riis_surface_options *));
  SIGNATURE(riis_surface_update_from_arrays, int32_t,
            (riis_surface *, const riis_surface_arrays *, const riis_surface_options *));
  SIGNATURE(riis_keyframe_arrays_init, int32_t, (riis_keyframe_arrays *, int64_t));
  SIGNATURE(riis_keyframes_create, int32_t,
            (const riis_surface_arrays *, const riis_keyframe_arrays *, riis_keyframes **));
  SIGNATURE(riis_keyframes_destroy, void, (riis_keyframes **));
  SIGNATURE(riis_surface_create_from_keyframes, int32_t,
            (const riis_keyframes *, double, double, const riis_surface_options *, riis_surface **));
  SIGNATURE(riis_surface_update_from_keyframes, int32_t,
            (riis_surface *, const riis_keyframes *, double, double, const riis_surface_options *));
  SIGNATURE(riis_surface_add_direction, int32_t,
            (riis_surface *, const riis_valve *, const riis_valve *, double, const riis_surface_options *,
             const riis_surface_options *));
  SIGNATURE(riis_surface_get_direction, int32_t, (const riis_surface *, int64_t, riis_direction *, int64_t));
  SIGNATURE(riis_surface_destroy, void, (riis_surface **));
  SIGNATURE(riis_surface_get_gap, int32_t, (const riis_surface *, const riis_surface *, double *, riis_gap *, int64_t));
  SIGNATURE(riis_valve_set_skirt_to_wall, int32_t,
            (riis_valve *, const riis_surface *, double, const riis_surface_options *));
  SIGNATURE(riis_surface_get_coaptation, int32_t, (const riis_surface *, double, int32_t, riis_coaptation *, int64_t));
  SIGNATURE(riis_surface_get_attachment, int32_t, (const riis_surface *, riis_attachment *, int64_t));
  SIGNATURE(riis_surface_get_info, int32_t, (const riis_surface *, riis_surface_info *, int64_t));
  SIGNATURE(riis_surface_get_triangles, int32_t, (const riis_surface *, riis_triangles *, int64_t));
  SIGNATURE(riis_warp_options_init, int32_t, (riis_warp_options *, int64_t));
  SIGNATURE(riis_warp_create, int32_t, (const riis_points *, const riis_warp_options *, riis_warp **));
  SIGNATURE(riis_warp_destroy, void, (riis_warp **));
  SIGNATURE(riis_warp_set_targets, int32_t, (riis_warp *, const riis_points *));
  SIGNATURE(riis_warp_set_targets_at, int32_t, (riis_warp *, const riis_keyframe_arrays *, double));
  SIGNATURE(riis_warp_get_info, int32_t, (const riis_warp *, riis_warp_info *, int64_t));
  SIGNATURE(riis_warp_map, int32_t, (const riis_warp *, const riis_points *, double *));
  SIGNATURE(riis_valve_set_warp, int32_t, (riis_valve *, const riis_warp *, const riis_warp *));
  SIGNATURE(riis_valve_get_patches, int32_t, (riis_valve *, riis_valve_patches *, int64_t));
  SIGNATURE(riis_crossing_options_init, int32_t, (riis_crossing_options *, int64_t));
  SIGNATURE(riis_crossings_create, int32_t, (riis_crossings **));
  SIGNATURE(riis_crossings_destroy, void, (riis_crossings **));
  SIGNATURE(riis_find_crossings, int32_t, (const riis_surface *, const riis_crossing_options *, riis_crossings *));
  SIGNATURE(riis_crossings_get_list, int32_t, (const riis_crossings *, riis_crossing_list *, int64_t));
  SIGNATURE(riis_closest_point, int32_t, (const riis_surface *, const double *, riis_closest *, int64_t));
  SIGNATURE(riis_closest_options_init, int32_t, (riis_closest_options *, int64_t));
  SIGNATURE(riis_closest_arrays_init, int32_t, (riis_closest_arrays *, int64_t));
  SIGNATURE(riis_closest_points, int32_t,
            (const riis_surface *, const riis_points *, const riis_closest_options *, const riis_closest_arrays *));
  SIGNATURE(riis_mesh_create, int32_t,
            (int64_t, const double *, const double *, const double *, int64_t, riis_mesh **));
  SIGNATURE(riis_mesh_update, int32_t, (riis_mesh *, int64_t, const double *, const double *, const double *, int64_t));
  SIGNATURE(riis_mesh_create_copy, int32_t, (const riis_points *, riis_mesh **));
  SIGNATURE(riis_mesh_update_copy, int32_t, (riis_mesh *, const riis_points *));
  SIGNATURE(riis_mesh_destroy, void, (riis_mesh **));
  SIGNATURE(riis_mesh_prepare, int32_t, (riis_mesh *, int32_t));
  SIGNATURE(riis_grid_init, int32_t, (riis_grid *, int64_t));
  SIGNATURE(riis_mesh_create_grid, int32_t, (const riis_grid *, riis_mesh **));
  SIGNATURE(riis_mesh_update_grid, int32_t, (riis_mesh *, const riis_grid *));
  SIGNATURE(riis_csr_init, int32_t, (riis_csr *, int64_t));
  SIGNATURE(riis_mesh_set_adjacency, int32_t, (riis_mesh *, const riis_csr *));
  SIGNATURE(riis_mesh_cells_init, int32_t, (riis_mesh_cells *, int64_t));
  SIGNATURE(riis_adjacency_create_from_cells, int32_t, (const riis_mesh_cells *, riis_adjacency **));
  SIGNATURE(riis_mesh_faces_init, int32_t, (riis_mesh_faces *, int64_t));
  SIGNATURE(riis_adjacency_create_from_faces, int32_t, (const riis_mesh_faces *, riis_adjacency **));
  SIGNATURE(riis_adjacency_create_from_grid, int32_t, (int64_t, int64_t, int64_t, int32_t, riis_adjacency **));
  SIGNATURE(riis_adjacency_get_csr, int32_t, (const riis_adjacency *, riis_csr *, int64_t));
  SIGNATURE(riis_adjacency_destroy, void, (riis_adjacency **));
  SIGNATURE(riis_marks_create, int32_t, (riis_marks **));
  SIGNATURE(riis_marks_destroy, void, (riis_marks **));
  SIGNATURE(riis_resistance_init, int32_t, (riis_resistance *, int64_t));
  SIGNATURE(riis_mark_options_init, int32_t, (riis_mark_options *, int64_t));
  SIGNATURE(riis_mark_nodes, int32_t,
            (const riis_surface *, const riis_mesh *, const riis_mark_options *, riis_marks *));
  SIGNATURE(riis_marks_get_list, int32_t, (const riis_marks *, int32_t, riis_mark_list *, int64_t));
  SIGNATURE(riis_dense_arrays_init, int32_t, (riis_dense_arrays *, int64_t));
  SIGNATURE(riis_marks_get_dense, int32_t, (const riis_marks *, const riis_dense_arrays *));
  SIGNATURE(riis_marks_get_stats, int32_t, (const riis_marks *, riis_mark_stats *, int64_t));
  SIGNATURE(riis_resistance_arrays_init, int32_t, (riis_resistance_arrays *, int64_t));
  SIGNATURE(riis_marks_add_resistance, int32_t,
            (const riis_marks *, const riis_resistance *, const riis_resistance_arrays *));
  SIGNATURE(riis_flow_arrays_init, int32_t, (riis_flow_arrays *, int64_t));
  SIGNATURE(riis_reaction_init, int32_t, (riis_reaction *, int64_t));
  SIGNATURE(riis_marks_add_reaction, int32_t,
            (const riis_marks *, const riis_resistance *, const riis_flow_arrays *, const riis_reaction *));
  SIGNATURE(
      riis_marks_add_vertex_reaction, int32_t,
      (const riis_marks *, const riis_surface *, const riis_resistance *, const riis_flow_arrays *, int64_t, double *));
  SIGNATURE(riis_loads_init, int32_t, (riis_loads *, int64_t));
  SIGNATURE(riis_loads_add_sums, int32_t, (const riis_loads *, const riis_points *, const double *, double *));
  SIGNATURE(riis_loads_add_forces, int32_t,
            (const riis_loads *, const riis_points *, const double *, const double *, double *));
  SIGNATURE(riis_band_init, int32_t, (riis_band *, int64_t));
  SIGNATURE(riis_marks_get_band_sums, int32_t, (const riis_marks *, const riis_band *, riis_band_sums *, int64_t));
  SIGNATURE(riis_leaks_create, int32_t, (riis_leaks **));
  SIGNATURE(riis_leaks_destroy, void, (riis_leaks **));
  SIGNATURE(riis_find_leaks, int32_t,
            (const riis_surface *, const riis_mesh *, const riis_marks *, const riis_mark_options *, riis_leaks *));
  SIGNATURE(riis_leaks_get_list, int32_t, (const riis_leaks *, riis_leak_list *, int64_t));
  SIGNATURE(riis_label_open_regions, int32_t,
            (const riis_mesh *, const riis_marks *, const riis_mark_options *, int64_t, int64_t *, int64_t *));
  SIGNATURE(riis_passage_ends_init, int32_t, (riis_passage_ends *, int64_t));
  SIGNATURE(riis_find_passage, int32_t,
            (const riis_surface *, const riis_mesh *, const riis_passage_ends *, const riis_mark_options *,
             riis_passage *, int64_t));
  SIGNATURE(riis_surface_get_n_leaflets, int32_t, (const riis_surface *, int64_t *));
  SIGNATURE(riis_surface_get_leaflet, int32_t, (const riis_surface *, int64_t, riis_leaflet *, int64_t));
  SIGNATURE(riis_surface_get_orifice, int32_t,
            (const riis_surface *, const riis_resistance *, riis_orifice *, int64_t));
  SIGNATURE(riis_surface_get_orifice_in_wall, int32_t,
            (const riis_surface *, const riis_surface *, const riis_resistance *, riis_orifice *, int64_t));
  SIGNATURE(riis_surface_get_leak, int32_t, (const riis_surface *, const riis_resistance *, double, double *));
  SIGNATURE(riis_area_search_init, int32_t, (riis_area_search *, int64_t));
  SIGNATURE(riis_find_by_area, int32_t,
            (const riis_valve *, const char *, int64_t, const double *, const riis_area_search *, double *, double *,
             riis_area_range *, int64_t));
  SIGNATURE(riis_first_passage_options_init, int32_t, (riis_first_passage_options *, int64_t));
  SIGNATURE(riis_find_first_passage, int32_t,
            (const riis_valve *, const riis_mesh *, const riis_passage_ends *, const riis_first_passage_options *,
             riis_first_passage *, int64_t));
  SIGNATURE(riis_marks_get_cells_across, int32_t,
            (const riis_marks *, const riis_mesh *, riis_cells_across *, int64_t));
  SIGNATURE(riis_valve_get_swept_volume, int32_t,
            (const riis_valve *, double, double, const riis_surface_options *, int32_t, double *));
  SIGNATURE(riis_landmarks_init, int32_t, (riis_landmarks *, int64_t));
  SIGNATURE(
      riis_place, int32_t,
      (riis_valve *, const riis_landmarks *, const char *, const riis_placement_arrays *, riis_placement *, int64_t));
  SIGNATURE(riis_placement_arrays_init, int32_t, (riis_placement_arrays *, int64_t));
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
  SIGNATURE(riis_vtk_mesh_read, int32_t, (const char *, riis_vtk_mesh **));
  SIGNATURE(riis_vtk_mesh_get_notes, int32_t, (const riis_vtk_mesh *, const char **));
  SIGNATURE(riis_vtk_mesh_use_centers, int32_t, (riis_vtk_mesh *));
  SIGNATURE(riis_vtk_mesh_destroy, void, (riis_vtk_mesh **));
  SIGNATURE(riis_vtk_mesh_get_nodes, int32_t, (const riis_vtk_mesh *, int64_t *, int64_t *, const double **));
  SIGNATURE(riis_vtk_mesh_get_axes, int32_t, (const riis_vtk_mesh *, riis_grid *, int64_t));
  SIGNATURE(riis_vtk_mesh_create_adjacency, int32_t, (const riis_vtk_mesh *, int32_t, riis_adjacency **));
  SIGNATURE(riis_vtk_mesh_get_volume_cells, int32_t, (const riis_vtk_mesh *, int64_t *, int64_t *));
  SIGNATURE(riis_vtk_mesh_create_long_edges, int32_t,
            (const riis_vtk_mesh *, const riis_surface *, double, int32_t, int64_t *, riis_adjacency **));
  SIGNATURE(riis_vtk_mesh_set_marks, int32_t, (riis_vtk_mesh *, const riis_marks *, double, const char *));
  SIGNATURE(riis_vtk_mesh_set_fields, int32_t, (riis_vtk_mesh *, const riis_marks *, int32_t, const char *));
  SIGNATURE(riis_vtk_mesh_set_point_array, int32_t, (riis_vtk_mesh *, const char *, int64_t, int64_t, const double *));
  SIGNATURE(riis_vtk_mesh_set_unit, int32_t, (riis_vtk_mesh *, const char *, const char *));
  SIGNATURE(riis_vtk_mesh_has_point_array, int32_t, (const riis_vtk_mesh *, const char *, int32_t *));
  SIGNATURE(riis_vtk_mesh_copy_cells, int32_t,
            (const riis_vtk_mesh *, int64_t, int64_t *, uint8_t *, int64_t, int64_t *));
  SIGNATURE(riis_vtk_mesh_get_median_edge, int32_t, (const riis_vtk_mesh *, double *));
  SIGNATURE(riis_vtk_mesh_choose_cells, int32_t, (riis_vtk_mesh *, const char *, int64_t *));
  SIGNATURE(riis_vtk_mesh_find_regions, int32_t, (riis_vtk_mesh *, const char **, int64_t *, const double **));
  SIGNATURE(riis_vtk_mesh_find_outside, int32_t, (const riis_vtk_mesh *, int64_t, const double *, double, uint8_t *));
  SIGNATURE(riis_vtk_mesh_extract, int32_t, (const riis_vtk_mesh *, int64_t, const int64_t *, riis_vtk_mesh **));
  SIGNATURE(riis_vtk_mesh_get_file_size, int32_t, (const riis_vtk_mesh *, int64_t *));
  SIGNATURE(riis_vtk_mesh_write, int32_t, (const riis_vtk_mesh *, const char *));
  SIGNATURE(riis_vtk_pieces_read, int32_t, (const char *, riis_vtk_pieces **));
  SIGNATURE(riis_vtk_pieces_create, int32_t, (const riis_vtk_mesh *, int64_t, const char *const *, riis_vtk_pieces **));
  SIGNATURE(riis_vtk_pieces_set_files, int32_t, (riis_vtk_pieces *, int64_t, const char *const *));
  SIGNATURE(riis_vtk_pieces_destroy, void, (riis_vtk_pieces **));
  SIGNATURE(riis_vtk_pieces_get_files, int32_t, (const riis_vtk_pieces *, int64_t *, const char *const **));
  SIGNATURE(riis_vtk_pieces_read_mesh, int32_t, (const riis_vtk_pieces *, int64_t, riis_vtk_mesh **));
  SIGNATURE(riis_vtk_pieces_write, int32_t, (const riis_vtk_pieces *, const char *));
  SIGNATURE(riis_vtk_mesh_get_sharing, int32_t,
            (const riis_vtk_mesh *, int64_t, uint8_t *, int64_t *, riis_vtk_sharing *, int64_t));
  SIGNATURE(riis_vtk_surface_read, int32_t, (const char *, const char *, riis_vtk_surface **));
  SIGNATURE(riis_vtk_mesh_get_boundary, int32_t, (const riis_vtk_mesh *, riis_vtk_surface **));
  SIGNATURE(riis_vtk_surface_number_pieces, int32_t, (riis_vtk_surface *));
  SIGNATURE(riis_vtk_surface_append, int32_t, (riis_vtk_surface *, const riis_vtk_surface *));
  SIGNATURE(riis_vtk_surface_destroy, void, (riis_vtk_surface **));
  SIGNATURE(riis_vtk_surface_get_arrays, int32_t, (const riis_vtk_surface *, riis_surface_arrays *, int64_t));
  SIGNATURE(riis_vtk_surface_write, int32_t, (const riis_surface *, const char *));
  SIGNATURE(riis_vtk_motion_read_pvd, int32_t, (const char *, const char *, riis_vtk_motion **));
  SIGNATURE(riis_vtk_motion_read_files, int32_t,
            (int64_t, const char *const *, const double *, const char *, riis_vtk_motion **));
  SIGNATURE(riis_vtk_motion_read_displacements, int32_t,
            (const char *, const char *, int64_t, const double *, const char *, riis_vtk_motion **));
  SIGNATURE(riis_vtk_motion_get_files, int32_t, (const riis_vtk_motion *, int64_t *, const char *const **));
  SIGNATURE(riis_vtk_motion_number_pieces, int32_t, (riis_vtk_motion *));
  SIGNATURE(riis_vtk_motion_append, int32_t, (riis_vtk_motion *, const riis_vtk_motion *));
  SIGNATURE(riis_vtk_motion_read_frames, int32_t, (const char *, double, const char *, riis_vtk_motion **));
  SIGNATURE(riis_vtk_motion_destroy, void, (riis_vtk_motion **));
  SIGNATURE(riis_vtk_motion_get_arrays, int32_t, (const riis_vtk_motion *, riis_surface_arrays *, int64_t));
  SIGNATURE(riis_vtk_motion_get_frames, int32_t, (const riis_vtk_motion *, riis_keyframe_arrays *, int64_t));
  SIGNATURE(riis_vtk_picture_options_init, int32_t, (riis_vtk_picture_options *, int64_t));
  SIGNATURE(riis_vtk_draw, int32_t,
            (const riis_surface *, const riis_vtk_mesh *, const riis_vtk_picture_options *, const char *));
  SIGNATURE(riis_vtk_draw_views, int32_t,
            (const riis_surface *, const riis_vtk_mesh *, const riis_vtk_picture_options *, int64_t, const int32_t *,
             const char *const *));
  SIGNATURE(
      riis_vtk_film_create, int32_t,
      (const riis_vtk_mesh *, const double *, const double *, const riis_vtk_picture_options *, riis_vtk_film **));
  SIGNATURE(riis_vtk_film_draw, int32_t, (riis_vtk_film *, const riis_surface *, const char *, const char *));
  SIGNATURE(riis_vtk_film_destroy, void, (riis_vtk_film **));
}

int main(void) { return run_cases(NULL, NULL); }
