! SPDX-License-Identifier: Apache-2.0
! Written by fortran/bindings/generate.py from riis.h and from the files in that folder; run ./run bindings to repeat it.
!> The explicit interfaces of the external subroutines riisf_*, for codes that call these and can use modules. With
!! `use riisf` a compiler refuses a wrong kind, such as REAL where REAL*8 is due, and a wrong number of arguments. The
!! subroutines are the same without `use riisf`. Their documentation is in riis_f77.f90. The module has no constants, so
!! the caller also includes riisf.h.
module riisf
  implicit none
  private
  public :: riisf_valve_create
  public :: riisf_valve_copy
  public :: riisf_valve_set
  public :: riisf_valve_get
  public :: riisf_valve_unset
  public :: riisf_valve_is_set
  public :: riisf_valve_set_open_state
  public :: riisf_valve_destroy
  public :: riisf_surface_create
  public :: riisf_surface_update
  public :: riisf_surface_place
  public :: riisf_surface_measure
  public :: riisf_surface_triangulate
  public :: riisf_surface_offset
  public :: riisf_surface_update_moving
  public :: riisf_surface_place_moving
  public :: riisf_surface_add_direction
  public :: riisf_surface_add_placed
  public :: riisf_surface_destroy
  public :: riisf_mesh_create
  public :: riisf_mesh_create_64
  public :: riisf_mesh_update
  public :: riisf_mesh_update_64
  public :: riisf_mesh_create_copy
  public :: riisf_mesh_create_copy_64
  public :: riisf_mesh_update_copy
  public :: riisf_mesh_update_copy_64
  public :: riisf_mesh_create_grid
  public :: riisf_mesh_create_grid_64
  public :: riisf_mesh_update_grid
  public :: riisf_mesh_update_grid_64
  public :: riisf_mesh_prepare
  public :: riisf_mesh_destroy
  public :: riisf_last_error
  public :: riisf_status_name
  public :: riisf_version
  public :: riisf_mesh_set_adjacency
  public :: riisf_mesh_set_adjacency_64
  public :: riisf_mesh_use_adjacency
  public :: riisf_mesh_clear_adjacency
  public :: riisf_adjacency_from_cells
  public :: riisf_adjacency_from_cells_64
  public :: riisf_adjacency_from_mixed
  public :: riisf_adjacency_from_mixed_64
  public :: riisf_adjacency_from_faces
  public :: riisf_adjacency_from_faces_64
  public :: riisf_adjacency_from_grid
  public :: riisf_adjacency_destroy
  public :: riisf_surface_from_arrays
  public :: riisf_surface_from_arrays_64
  public :: riisf_surface_with_skirt
  public :: riisf_surface_with_skirt_64
  public :: riisf_surface_offset_arrays
  public :: riisf_surface_offset_arrays_64
  public :: riisf_surface_update_arrays
  public :: riisf_surface_update_arrays_64
  public :: riisf_keyframes_create
  public :: riisf_keyframes_create_64
  public :: riisf_surface_from_keyframes
  public :: riisf_surface_offset_keyframes
  public :: riisf_surface_update_keyframes
  public :: riisf_keyframes_destroy
  public :: riisf_surface_vertices
  public :: riisf_surface_vertices_64
  public :: riisf_surface_triangles
  public :: riisf_surface_triangles_64
  public :: riisf_surface_vertex_velocities
  public :: riisf_surface_vertex_velocities_64
  public :: riisf_surface_attachment
  public :: riisf_surface_attachment_64
  public :: riisf_surface_direction
  public :: riisf_surface_direction_64
  public :: riisf_closest_points
  public :: riisf_closest_points_64
  public :: riisf_closest_points_listed
  public :: riisf_closest_points_listed_64
  public :: riisf_mark_nodes
  public :: riisf_marked
  public :: riisf_marked_64
  public :: riisf_within_limit
  public :: riisf_within_limit_64
  public :: riisf_dense_distance
  public :: riisf_dense_triangle
  public :: riisf_dense_leaflet
  public :: riisf_dense_mark
  public :: riisf_marks_destroy
  public :: riisf_mark_with_fields
  public :: riisf_marked_reals
  public :: riisf_marked_reals_64
  public :: riisf_within_limit_reals
  public :: riisf_within_limit_reals_64
  public :: riisf_marked_integers
  public :: riisf_marked_integers_64
  public :: riisf_within_limit_integers
  public :: riisf_within_limit_integers_64
  public :: riisf_mark_with_resistance
  public :: riisf_marked_resistance
  public :: riisf_marked_resistance_64
  public :: riisf_within_limit_resistance
  public :: riisf_within_limit_resistance_64
  public :: riisf_add_resistance
  public :: riisf_add_resistance_64
  public :: riisf_add_moving_resistance
  public :: riisf_add_moving_resistance_64
  public :: riisf_add_resistance_components
  public :: riisf_add_resistance_components_64
  public :: riisf_add_reaction
  public :: riisf_add_reaction_64
  public :: riisf_add_reaction_components
  public :: riisf_add_reaction_components_64
  public :: riisf_add_leaflet_reaction
  public :: riisf_add_leaflet_reaction_64
  public :: riisf_add_leaflet_reaction_components
  public :: riisf_add_leaflet_reaction_components_64
  public :: riisf_add_edge_reaction
  public :: riisf_add_edge_reaction_64
  public :: riisf_add_edge_reaction_components
  public :: riisf_add_edge_reaction_components_64
  public :: riisf_add_vertex_reaction
  public :: riisf_add_vertex_reaction_64
  public :: riisf_add_vertex_reaction_components
  public :: riisf_add_vertex_reaction_components_64
  public :: riisf_band_sums
  public :: riisf_band_sums_64
  public :: riisf_loads_sums
  public :: riisf_loads_sums_64
  public :: riisf_loads_forces
  public :: riisf_loads_forces_64
  public :: riisf_find_leaks
  public :: riisf_leaking_edges
  public :: riisf_leaking_edges_64
  public :: riisf_leaks_destroy
  public :: riisf_label_open_regions
  public :: riisf_label_open_regions_64
  public :: riisf_find_passage
  public :: riisf_find_passage_64
  public :: riisf_find_crossings
  public :: riisf_crossings_destroy
  public :: riisf_crossing_pairs
  public :: riisf_crossing_pairs_64
  public :: riisf_surface_n_leaflets
  public :: riisf_surface_leaflet
  public :: riisf_surface_orifice
  public :: riisf_surface_orifice_in_wall
  public :: riisf_surface_coaptation
  public :: riisf_surface_gap
  public :: riisf_valve_skirt_to_wall
  public :: riisf_surface_leak
  public :: riisf_cells_across
  public :: riisf_valve_swept_volume
  public :: riisf_find_by_area
  public :: riisf_find_by_area_64
  public :: riisf_find_first_passage
  public :: riisf_find_first_passage_64
  public :: riisf_opening_from_table
  public :: riisf_opening_from_times
  public :: riisf_opening_switch_init
  public :: riisf_opening_switch_advance
  public :: riisf_opening_angle_init
  public :: riisf_opening_angle_advance
  public :: riisf_place
  public :: riisf_warp_create
  public :: riisf_warp_set_targets
  public :: riisf_valve_set_warp
  public :: riisf_warp_destroy

  interface

    subroutine riisf_valve_create(kind, valve, status)
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      character(len=*), intent(in) :: kind
      integer(int64), intent(inout) :: valve
      integer(riis_status), intent(out) :: status
    end subroutine riisf_valve_create

    subroutine riisf_valve_copy(valve, copy, status)
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      integer(int64), intent(inout) :: copy
      integer(riis_status), intent(out) :: status
    end subroutine riisf_valve_copy

    subroutine riisf_valve_set(valve, name, n_values, values, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      character(len=*), intent(in) :: name
      integer(int32), intent(in) :: n_values
      real(c_double), intent(in) :: values(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_valve_set

    subroutine riisf_valve_get(valve, name, n_values, values, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      character(len=*), intent(in) :: name
      integer(int32), intent(in) :: n_values
      real(c_double), intent(inout) :: values(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_valve_get

    subroutine riisf_valve_unset(valve, name, status)
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      character(len=*), intent(in) :: name
      integer(riis_status), intent(out) :: status
    end subroutine riisf_valve_unset

    subroutine riisf_valve_is_set(valve, name, is_set, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      character(len=*), intent(in) :: name
      integer(int32), intent(inout) :: is_set
      integer(riis_status), intent(out) :: status
    end subroutine riisf_valve_is_set

    subroutine riisf_valve_set_open_state(valve, open, status)
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      integer(int64), intent(in) :: open
      integer(riis_status), intent(out) :: status
    end subroutine riisf_valve_set_open_state

    subroutine riisf_valve_destroy(handle)
      use, intrinsic :: iso_fortran_env, only: int64
      implicit none
      integer(int64), intent(inout) :: handle
    end subroutine riisf_valve_destroy

    subroutine riisf_surface_create(valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
        translation, surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int64), intent(inout) :: surface
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_create

    subroutine riisf_surface_update(surface, valve, status)
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: valve
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_update

    subroutine riisf_surface_place(surface, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
        translation, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: valve
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_place

    subroutine riisf_surface_measure(surface, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
        translation, measure, measure_tolerance, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: valve
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int32), intent(in) :: measure
      real(c_double), intent(in) :: measure_tolerance
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_measure

    subroutine riisf_surface_triangulate(surface, valve, half_thickness, tolerance, scale, rotation_axis, &
        rotation_angle, translation, triangulation, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: valve
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int32), intent(in) :: triangulation
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_triangulate

    subroutine riisf_surface_offset(surface, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
        translation, offset, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: valve
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      real(c_double), intent(in) :: offset
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_offset

    subroutine riisf_surface_update_moving(surface, valve, valve_before, dt, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: valve
      integer(int64), intent(in) :: valve_before
      real(c_double), intent(in) :: dt
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_update_moving

    subroutine riisf_surface_place_moving(surface, valve, valve_before, dt, half_thickness, tolerance, scale, &
        rotation_axis, rotation_angle, translation, scale_before, rotation_axis_before, rotation_angle_before, &
        translation_before, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: valve
      integer(int64), intent(in) :: valve_before
      real(c_double), intent(in) :: dt
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      real(c_double), intent(in) :: scale_before
      real(c_double), intent(in) :: rotation_axis_before(3)
      real(c_double), intent(in) :: rotation_angle_before
      real(c_double), intent(in) :: translation_before(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_place_moving

    subroutine riisf_surface_add_direction(surface, valve_after, valve_before, dp, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: valve_after
      integer(int64), intent(in) :: valve_before
      real(c_double), intent(in) :: dp
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_add_direction

    subroutine riisf_surface_add_placed(surface, valve_after, valve_before, dp, scale_after, rotation_axis_after, &
        rotation_angle_after, translation_after, scale_before, rotation_axis_before, rotation_angle_before, &
        translation_before, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: valve_after
      integer(int64), intent(in) :: valve_before
      real(c_double), intent(in) :: dp
      real(c_double), intent(in) :: scale_after
      real(c_double), intent(in) :: rotation_axis_after(3)
      real(c_double), intent(in) :: rotation_angle_after
      real(c_double), intent(in) :: translation_after(3)
      real(c_double), intent(in) :: scale_before
      real(c_double), intent(in) :: rotation_axis_before(3)
      real(c_double), intent(in) :: rotation_angle_before
      real(c_double), intent(in) :: translation_before(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_add_placed

    subroutine riisf_surface_destroy(handle)
      use, intrinsic :: iso_fortran_env, only: int64
      implicit none
      integer(int64), intent(inout) :: handle
    end subroutine riisf_surface_destroy

    subroutine riisf_mesh_create(n_nodes, x, y, z, stride, mesh, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int32), intent(in) :: stride
      integer(int64), intent(inout) :: mesh
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_create

    subroutine riisf_mesh_create_64(n_nodes, x, y, z, stride, mesh, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int64), intent(in) :: stride
      integer(int64), intent(inout) :: mesh
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_create_64

    subroutine riisf_mesh_update(mesh, n_nodes, x, y, z, stride, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int32), intent(in) :: stride
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_update

    subroutine riisf_mesh_update_64(mesh, n_nodes, x, y, z, stride, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int64), intent(in) :: stride
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_update_64

    subroutine riisf_mesh_create_copy(n_nodes, x, y, z, stride, real_bits, mesh, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_nodes
      type(*), intent(in) :: x(*)
      type(*), intent(in) :: y(*)
      type(*), intent(in) :: z(*)
      integer(int32), intent(in) :: stride
      integer(int32), intent(in) :: real_bits
      integer(int64), intent(inout) :: mesh
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_create_copy

    subroutine riisf_mesh_create_copy_64(n_nodes, x, y, z, stride, real_bits, mesh, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: n_nodes
      type(*), intent(in) :: x(*)
      type(*), intent(in) :: y(*)
      type(*), intent(in) :: z(*)
      integer(int64), intent(in) :: stride
      integer(int32), intent(in) :: real_bits
      integer(int64), intent(inout) :: mesh
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_create_copy_64

    subroutine riisf_mesh_update_copy(mesh, n_nodes, x, y, z, stride, real_bits, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int32), intent(in) :: n_nodes
      type(*), intent(in) :: x(*)
      type(*), intent(in) :: y(*)
      type(*), intent(in) :: z(*)
      integer(int32), intent(in) :: stride
      integer(int32), intent(in) :: real_bits
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_update_copy

    subroutine riisf_mesh_update_copy_64(mesh, n_nodes, x, y, z, stride, real_bits, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int64), intent(in) :: n_nodes
      type(*), intent(in) :: x(*)
      type(*), intent(in) :: y(*)
      type(*), intent(in) :: z(*)
      integer(int64), intent(in) :: stride
      integer(int32), intent(in) :: real_bits
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_update_copy_64

    subroutine riisf_mesh_create_grid(ni, nj, nk, x, y, z, real_bits, first_num, stride_i, stride_j, stride_k, &
        n_nodes, mesh, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: ni
      integer(int32), intent(in) :: nj
      integer(int32), intent(in) :: nk
      type(*), intent(in) :: x(*)
      type(*), intent(in) :: y(*)
      type(*), intent(in) :: z(*)
      integer(int32), intent(in) :: real_bits
      integer(int32), intent(in) :: first_num
      integer(int32), intent(in) :: stride_i
      integer(int32), intent(in) :: stride_j
      integer(int32), intent(in) :: stride_k
      integer(int32), intent(in) :: n_nodes
      integer(int64), intent(inout) :: mesh
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_create_grid

    subroutine riisf_mesh_create_grid_64(ni, nj, nk, x, y, z, real_bits, first_num, stride_i, stride_j, stride_k, &
        n_nodes, mesh, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: ni
      integer(int64), intent(in) :: nj
      integer(int64), intent(in) :: nk
      type(*), intent(in) :: x(*)
      type(*), intent(in) :: y(*)
      type(*), intent(in) :: z(*)
      integer(int32), intent(in) :: real_bits
      integer(int64), intent(in) :: first_num
      integer(int64), intent(in) :: stride_i
      integer(int64), intent(in) :: stride_j
      integer(int64), intent(in) :: stride_k
      integer(int64), intent(in) :: n_nodes
      integer(int64), intent(inout) :: mesh
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_create_grid_64

    subroutine riisf_mesh_update_grid(mesh, ni, nj, nk, x, y, z, real_bits, first_num, stride_i, stride_j, stride_k, &
        n_nodes, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int32), intent(in) :: ni
      integer(int32), intent(in) :: nj
      integer(int32), intent(in) :: nk
      type(*), intent(in) :: x(*)
      type(*), intent(in) :: y(*)
      type(*), intent(in) :: z(*)
      integer(int32), intent(in) :: real_bits
      integer(int32), intent(in) :: first_num
      integer(int32), intent(in) :: stride_i
      integer(int32), intent(in) :: stride_j
      integer(int32), intent(in) :: stride_k
      integer(int32), intent(in) :: n_nodes
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_update_grid

    subroutine riisf_mesh_update_grid_64(mesh, ni, nj, nk, x, y, z, real_bits, first_num, stride_i, stride_j, &
        stride_k, n_nodes, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int64), intent(in) :: ni
      integer(int64), intent(in) :: nj
      integer(int64), intent(in) :: nk
      type(*), intent(in) :: x(*)
      type(*), intent(in) :: y(*)
      type(*), intent(in) :: z(*)
      integer(int32), intent(in) :: real_bits
      integer(int64), intent(in) :: first_num
      integer(int64), intent(in) :: stride_i
      integer(int64), intent(in) :: stride_j
      integer(int64), intent(in) :: stride_k
      integer(int64), intent(in) :: n_nodes
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_update_grid_64

    subroutine riisf_mesh_prepare(mesh, n_threads, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int32), intent(in) :: n_threads
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_prepare

    subroutine riisf_mesh_destroy(handle)
      use, intrinsic :: iso_fortran_env, only: int64
      implicit none
      integer(int64), intent(inout) :: handle
    end subroutine riisf_mesh_destroy

    subroutine riisf_last_error(text)
      implicit none
      character(len=*), intent(out) :: text
    end subroutine riisf_last_error

    subroutine riisf_status_name(status, text)
      use riis_c, only: riis_status
      implicit none
      integer(riis_status), intent(in) :: status
      character(len=*), intent(out) :: text
    end subroutine riisf_status_name

    subroutine riisf_version(text)
      implicit none
      character(len=*), intent(out) :: text
    end subroutine riisf_version

    subroutine riisf_mesh_set_adjacency(mesh, n_rows, offsets, columns, index_base, n_all, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int32), intent(in) :: n_rows
      integer(int32), intent(in) :: offsets(*)
      integer(int32), intent(in) :: columns(*)
      integer(int32), intent(in) :: index_base
      integer(int32), intent(in) :: n_all
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_set_adjacency

    subroutine riisf_mesh_set_adjacency_64(mesh, n_rows, offsets, columns, index_base, n_all, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int64), intent(in) :: n_rows
      integer(int64), intent(in) :: offsets(*)
      integer(int64), intent(in) :: columns(*)
      integer(int32), intent(in) :: index_base
      integer(int64), intent(in) :: n_all
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_set_adjacency_64

    subroutine riisf_mesh_use_adjacency(mesh, adjacency, status)
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int64), intent(in) :: adjacency
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_use_adjacency

    subroutine riisf_mesh_clear_adjacency(mesh, status)
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mesh_clear_adjacency

    subroutine riisf_adjacency_from_cells(n_nodes, nodes_per_cell, n_cells, cells, index_base, n_threads, adjacency, &
        status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_nodes
      integer(int32), intent(in) :: nodes_per_cell
      integer(int32), intent(in) :: n_cells
      integer(int32), intent(in) :: cells(*)
      integer(int32), intent(in) :: index_base
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(inout) :: adjacency
      integer(riis_status), intent(out) :: status
    end subroutine riisf_adjacency_from_cells

    subroutine riisf_adjacency_from_cells_64(n_nodes, nodes_per_cell, n_cells, cells, index_base, n_threads, &
        adjacency, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: n_nodes
      integer(int32), intent(in) :: nodes_per_cell
      integer(int64), intent(in) :: n_cells
      integer(int64), intent(in) :: cells(*)
      integer(int32), intent(in) :: index_base
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(inout) :: adjacency
      integer(riis_status), intent(out) :: status
    end subroutine riisf_adjacency_from_cells_64

    subroutine riisf_adjacency_from_mixed(n_nodes, n_cells, node_ids, offsets, index_base, n_threads, adjacency, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_nodes
      integer(int32), intent(in) :: n_cells
      integer(int32), intent(in) :: node_ids(*)
      integer(int32), intent(in) :: offsets(*)
      integer(int32), intent(in) :: index_base
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(inout) :: adjacency
      integer(riis_status), intent(out) :: status
    end subroutine riisf_adjacency_from_mixed

    subroutine riisf_adjacency_from_mixed_64(n_nodes, n_cells, node_ids, offsets, index_base, n_threads, adjacency, &
        status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: n_nodes
      integer(int64), intent(in) :: n_cells
      integer(int64), intent(in) :: node_ids(*)
      integer(int64), intent(in) :: offsets(*)
      integer(int32), intent(in) :: index_base
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(inout) :: adjacency
      integer(riis_status), intent(out) :: status
    end subroutine riisf_adjacency_from_mixed_64

    subroutine riisf_adjacency_from_faces(n_cells, n_faces, face_cells, index_base, n_threads, adjacency, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_cells
      integer(int32), intent(in) :: n_faces
      integer(int32), intent(in) :: face_cells(*)
      integer(int32), intent(in) :: index_base
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(inout) :: adjacency
      integer(riis_status), intent(out) :: status
    end subroutine riisf_adjacency_from_faces

    subroutine riisf_adjacency_from_faces_64(n_cells, n_faces, face_cells, index_base, n_threads, adjacency, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: n_cells
      integer(int64), intent(in) :: n_faces
      integer(int64), intent(in) :: face_cells(*)
      integer(int32), intent(in) :: index_base
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(inout) :: adjacency
      integer(riis_status), intent(out) :: status
    end subroutine riisf_adjacency_from_faces_64

    subroutine riisf_adjacency_from_grid(ni, nj, nk, n_threads, adjacency, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: ni
      integer(int32), intent(in) :: nj
      integer(int32), intent(in) :: nk
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(inout) :: adjacency
      integer(riis_status), intent(out) :: status
    end subroutine riisf_adjacency_from_grid

    subroutine riisf_adjacency_destroy(handle)
      use, intrinsic :: iso_fortran_env, only: int64
      implicit none
      integer(int64), intent(inout) :: handle
    end subroutine riisf_adjacency_destroy

    subroutine riisf_surface_from_arrays(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, &
        index_base, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_vertices
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int32), intent(in) :: stride
      integer(int32), intent(in) :: corners_per_face
      integer(int32), intent(in) :: n_faces
      integer(int32), intent(in) :: vertex_ids(*)
      integer(int32), intent(in) :: index_base
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int64), intent(inout) :: surface
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_from_arrays

    subroutine riisf_surface_from_arrays_64(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, &
        index_base, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: n_vertices
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int64), intent(in) :: stride
      integer(int32), intent(in) :: corners_per_face
      integer(int64), intent(in) :: n_faces
      integer(int64), intent(in) :: vertex_ids(*)
      integer(int32), intent(in) :: index_base
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int64), intent(inout) :: surface
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_from_arrays_64

    subroutine riisf_surface_with_skirt(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, &
        index_base, attached, skirt_length, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
        translation, surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int8, int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_vertices
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int32), intent(in) :: stride
      integer(int32), intent(in) :: corners_per_face
      integer(int32), intent(in) :: n_faces
      integer(int32), intent(in) :: vertex_ids(*)
      integer(int32), intent(in) :: index_base
      integer(int8), intent(in) :: attached(*)
      real(c_double), intent(in) :: skirt_length
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int64), intent(inout) :: surface
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_with_skirt

    subroutine riisf_surface_with_skirt_64(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, &
        index_base, attached, skirt_length, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
        translation, surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int8, int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: n_vertices
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int64), intent(in) :: stride
      integer(int32), intent(in) :: corners_per_face
      integer(int64), intent(in) :: n_faces
      integer(int64), intent(in) :: vertex_ids(*)
      integer(int32), intent(in) :: index_base
      integer(int8), intent(in) :: attached(*)
      real(c_double), intent(in) :: skirt_length
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int64), intent(inout) :: surface
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_with_skirt_64

    subroutine riisf_surface_offset_arrays(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, &
        index_base, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, offset, surface, &
        status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_vertices
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int32), intent(in) :: stride
      integer(int32), intent(in) :: corners_per_face
      integer(int32), intent(in) :: n_faces
      integer(int32), intent(in) :: vertex_ids(*)
      integer(int32), intent(in) :: index_base
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      real(c_double), intent(in) :: offset
      integer(int64), intent(inout) :: surface
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_offset_arrays

    subroutine riisf_surface_offset_arrays_64(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, &
        index_base, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, offset, surface, &
        status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: n_vertices
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int64), intent(in) :: stride
      integer(int32), intent(in) :: corners_per_face
      integer(int64), intent(in) :: n_faces
      integer(int64), intent(in) :: vertex_ids(*)
      integer(int32), intent(in) :: index_base
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      real(c_double), intent(in) :: offset
      integer(int64), intent(inout) :: surface
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_offset_arrays_64

    subroutine riisf_surface_update_arrays(surface, n_vertices, x, y, z, stride, vx, vy, vz, velocity_stride, &
        corners_per_face, n_faces, vertex_ids, index_base, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int32), intent(in) :: n_vertices
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int32), intent(in) :: stride
      real(c_double), intent(in) :: vx(*)
      real(c_double), intent(in) :: vy(*)
      real(c_double), intent(in) :: vz(*)
      integer(int32), intent(in) :: velocity_stride
      integer(int32), intent(in) :: corners_per_face
      integer(int32), intent(in) :: n_faces
      integer(int32), intent(in) :: vertex_ids(*)
      integer(int32), intent(in) :: index_base
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_update_arrays

    subroutine riisf_surface_update_arrays_64(surface, n_vertices, x, y, z, stride, vx, vy, vz, velocity_stride, &
        corners_per_face, n_faces, vertex_ids, index_base, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: n_vertices
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int64), intent(in) :: stride
      real(c_double), intent(in) :: vx(*)
      real(c_double), intent(in) :: vy(*)
      real(c_double), intent(in) :: vz(*)
      integer(int64), intent(in) :: velocity_stride
      integer(int32), intent(in) :: corners_per_face
      integer(int64), intent(in) :: n_faces
      integer(int64), intent(in) :: vertex_ids(*)
      integer(int32), intent(in) :: index_base
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_update_arrays_64

    subroutine riisf_keyframes_create(n_vertices, n_keys, time, xyz, period, interpolation, corners_per_face, n_faces, &
        vertex_ids, index_base, keyframes, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_vertices
      integer(int32), intent(in) :: n_keys
      real(c_double), intent(in) :: time(*)
      real(c_double), intent(in) :: xyz(*)
      real(c_double), intent(in) :: period
      integer(int32), intent(in) :: interpolation
      integer(int32), intent(in) :: corners_per_face
      integer(int32), intent(in) :: n_faces
      integer(int32), intent(in) :: vertex_ids(*)
      integer(int32), intent(in) :: index_base
      integer(int64), intent(inout) :: keyframes
      integer(riis_status), intent(out) :: status
    end subroutine riisf_keyframes_create

    subroutine riisf_keyframes_create_64(n_vertices, n_keys, time, xyz, period, interpolation, corners_per_face, &
        n_faces, vertex_ids, index_base, keyframes, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: n_vertices
      integer(int32), intent(in) :: n_keys
      real(c_double), intent(in) :: time(*)
      real(c_double), intent(in) :: xyz(*)
      real(c_double), intent(in) :: period
      integer(int32), intent(in) :: interpolation
      integer(int32), intent(in) :: corners_per_face
      integer(int64), intent(in) :: n_faces
      integer(int64), intent(in) :: vertex_ids(*)
      integer(int32), intent(in) :: index_base
      integer(int64), intent(inout) :: keyframes
      integer(riis_status), intent(out) :: status
    end subroutine riisf_keyframes_create_64

    subroutine riisf_surface_from_keyframes(keyframes, time, dt, half_thickness, tolerance, scale, rotation_axis, &
        rotation_angle, translation, surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: keyframes
      real(c_double), intent(in) :: time
      real(c_double), intent(in) :: dt
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int64), intent(inout) :: surface
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_from_keyframes

    subroutine riisf_surface_offset_keyframes(keyframes, time, dt, half_thickness, tolerance, scale, rotation_axis, &
        rotation_angle, translation, offset, surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: keyframes
      real(c_double), intent(in) :: time
      real(c_double), intent(in) :: dt
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      real(c_double), intent(in) :: offset
      integer(int64), intent(inout) :: surface
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_offset_keyframes

    subroutine riisf_surface_update_keyframes(surface, keyframes, time, dt, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: keyframes
      real(c_double), intent(in) :: time
      real(c_double), intent(in) :: dt
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_update_keyframes

    subroutine riisf_keyframes_destroy(handle)
      use, intrinsic :: iso_fortran_env, only: int64
      implicit none
      integer(int64), intent(inout) :: handle
    end subroutine riisf_keyframes_destroy

    subroutine riisf_surface_vertices(surface, length, n, xyz, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      real(c_double), intent(inout) :: xyz(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_vertices

    subroutine riisf_surface_vertices_64(surface, length, n, xyz, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      real(c_double), intent(inout) :: xyz(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_vertices_64

    subroutine riisf_surface_triangles(surface, length, n, vertex_num, triangle_id, leaflet_id, patch_id, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      integer(int32), intent(inout) :: vertex_num(3, *)
      integer(int64), intent(inout) :: triangle_id(*)
      integer(int32), intent(inout) :: leaflet_id(*)
      integer(int32), intent(inout) :: patch_id(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_triangles

    subroutine riisf_surface_triangles_64(surface, length, n, vertex_num, triangle_id, leaflet_id, patch_id, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      integer(int64), intent(inout) :: vertex_num(3, *)
      integer(int64), intent(inout) :: triangle_id(*)
      integer(int32), intent(inout) :: leaflet_id(*)
      integer(int32), intent(inout) :: patch_id(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_triangles_64

    subroutine riisf_surface_vertex_velocities(surface, length, n, velocity, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      real(c_double), intent(inout) :: velocity(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_vertex_velocities

    subroutine riisf_surface_vertex_velocities_64(surface, length, n, velocity, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      real(c_double), intent(inout) :: velocity(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_vertex_velocities_64

    subroutine riisf_surface_attachment(surface, length, n, edges, leaflet_id, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      real(c_double), intent(inout) :: edges(3, 2, *)
      integer(int32), intent(inout) :: leaflet_id(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_attachment

    subroutine riisf_surface_attachment_64(surface, length, n, edges, leaflet_id, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      real(c_double), intent(inout) :: edges(3, 2, *)
      integer(int32), intent(inout) :: leaflet_id(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_attachment_64

    subroutine riisf_surface_direction(surface, direction_num, length, n, rate, area_rate, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int32), intent(in) :: direction_num
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      real(c_double), intent(inout) :: rate(*)
      real(c_double), intent(inout) :: area_rate
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_direction

    subroutine riisf_surface_direction_64(surface, direction_num, length, n, rate, area_rate, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: direction_num
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      real(c_double), intent(inout) :: rate(*)
      real(c_double), intent(inout) :: area_rate
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_direction_64

    subroutine riisf_closest_points(surface, n_points, x, y, z, stride, distance_limit, n_threads, distance, point, &
        normal, triangle_id, leaflet_id, side, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int32), intent(in) :: n_points
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int32), intent(in) :: stride
      real(c_double), intent(in) :: distance_limit
      integer(int32), intent(in) :: n_threads
      real(c_double), intent(inout) :: distance(*)
      real(c_double), intent(inout) :: point(*)
      real(c_double), intent(inout) :: normal(*)
      integer(int64), intent(inout) :: triangle_id(*)
      integer(int32), intent(inout) :: leaflet_id(*)
      integer(int32), intent(inout) :: side(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_closest_points

    subroutine riisf_closest_points_64(surface, n_points, x, y, z, stride, distance_limit, n_threads, distance, point, &
        normal, triangle_id, leaflet_id, side, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: n_points
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int64), intent(in) :: stride
      real(c_double), intent(in) :: distance_limit
      integer(int32), intent(in) :: n_threads
      real(c_double), intent(inout) :: distance(*)
      real(c_double), intent(inout) :: point(*)
      real(c_double), intent(inout) :: normal(*)
      integer(int64), intent(inout) :: triangle_id(*)
      integer(int32), intent(inout) :: leaflet_id(*)
      integer(int32), intent(inout) :: side(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_closest_points_64

    subroutine riisf_closest_points_listed(surface, n_points, x, y, z, stride, n_listed, point_num, distance_limit, &
        n_threads, distance, point, normal, triangle_id, leaflet_id, side, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int32), intent(in) :: n_points
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int32), intent(in) :: stride
      integer(int32), intent(in) :: n_listed
      integer(int32), intent(in) :: point_num(*)
      real(c_double), intent(in) :: distance_limit
      integer(int32), intent(in) :: n_threads
      real(c_double), intent(inout) :: distance(*)
      real(c_double), intent(inout) :: point(*)
      real(c_double), intent(inout) :: normal(*)
      integer(int64), intent(inout) :: triangle_id(*)
      integer(int32), intent(inout) :: leaflet_id(*)
      integer(int32), intent(inout) :: side(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_closest_points_listed

    subroutine riisf_closest_points_listed_64(surface, n_points, x, y, z, stride, n_listed, point_num, distance_limit, &
        n_threads, distance, point, normal, triangle_id, leaflet_id, side, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: n_points
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(in) :: z(*)
      integer(int64), intent(in) :: stride
      integer(int64), intent(in) :: n_listed
      integer(int64), intent(in) :: point_num(*)
      real(c_double), intent(in) :: distance_limit
      integer(int32), intent(in) :: n_threads
      real(c_double), intent(inout) :: distance(*)
      real(c_double), intent(inout) :: point(*)
      real(c_double), intent(inout) :: normal(*)
      integer(int64), intent(inout) :: triangle_id(*)
      integer(int32), intent(inout) :: leaflet_id(*)
      integer(int32), intent(inout) :: side(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_closest_points_listed_64

    subroutine riisf_mark_nodes(surface, mesh, distance_limit, search, n_threads, marks, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: mesh
      real(c_double), intent(in) :: distance_limit
      integer(int32), intent(in) :: search
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(inout) :: marks
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mark_nodes

    subroutine riisf_marked(marks, length, n, node_num, distance, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      integer(int32), intent(inout) :: node_num(*)
      real(c_double), intent(inout) :: distance(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_marked

    subroutine riisf_marked_64(marks, length, n, node_num, distance, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      integer(int64), intent(inout) :: node_num(*)
      real(c_double), intent(inout) :: distance(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_marked_64

    subroutine riisf_within_limit(marks, length, n, node_num, distance, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      integer(int32), intent(inout) :: node_num(*)
      real(c_double), intent(inout) :: distance(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_within_limit

    subroutine riisf_within_limit_64(marks, length, n, node_num, distance, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      integer(int64), intent(inout) :: node_num(*)
      real(c_double), intent(inout) :: distance(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_within_limit_64

    subroutine riisf_dense_distance(marks, n_nodes, far_distance, distance, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: far_distance
      real(c_double), intent(inout) :: distance(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_dense_distance

    subroutine riisf_dense_triangle(marks, n_nodes, triangle_id, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: n_nodes
      integer(int64), intent(inout) :: triangle_id(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_dense_triangle

    subroutine riisf_dense_leaflet(marks, n_nodes, leaflet_id, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: n_nodes
      integer(int32), intent(inout) :: leaflet_id(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_dense_leaflet

    subroutine riisf_dense_mark(marks, n_nodes, mark, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: n_nodes
      integer(int32), intent(inout) :: mark(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_dense_mark

    subroutine riisf_marks_destroy(handle)
      use, intrinsic :: iso_fortran_env, only: int64
      implicit none
      integer(int64), intent(inout) :: handle
    end subroutine riisf_marks_destroy

    subroutine riisf_mark_with_fields(surface, mesh, distance_limit, search, n_threads, fields, marks, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: mesh
      real(c_double), intent(in) :: distance_limit
      integer(int32), intent(in) :: search
      integer(int32), intent(in) :: n_threads
      integer(int32), intent(in) :: fields
      integer(int64), intent(inout) :: marks
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mark_with_fields

    subroutine riisf_marked_reals(marks, field, length, n, values, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: field
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      real(c_double), intent(inout) :: values(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_marked_reals

    subroutine riisf_marked_reals_64(marks, field, length, n, values, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: field
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      real(c_double), intent(inout) :: values(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_marked_reals_64

    subroutine riisf_within_limit_reals(marks, field, length, n, values, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: field
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      real(c_double), intent(inout) :: values(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_within_limit_reals

    subroutine riisf_within_limit_reals_64(marks, field, length, n, values, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: field
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      real(c_double), intent(inout) :: values(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_within_limit_reals_64

    subroutine riisf_marked_integers(marks, field, length, n, values, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: field
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      integer(int32), intent(inout) :: values(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_marked_integers

    subroutine riisf_marked_integers_64(marks, field, length, n, values, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: field
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      integer(int32), intent(inout) :: values(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_marked_integers_64

    subroutine riisf_within_limit_integers(marks, field, length, n, values, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: field
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      integer(int32), intent(inout) :: values(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_within_limit_integers

    subroutine riisf_within_limit_integers_64(marks, field, length, n, values, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: field
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      integer(int32), intent(inout) :: values(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_within_limit_integers_64

    subroutine riisf_mark_with_resistance(surface, mesh, distance_limit, search, n_threads, fields, R, half_thickness, &
        rim, marks, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: mesh
      real(c_double), intent(in) :: distance_limit
      integer(int32), intent(in) :: search
      integer(int32), intent(in) :: n_threads
      integer(int32), intent(in) :: fields
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(inout) :: marks
      integer(riis_status), intent(out) :: status
    end subroutine riisf_mark_with_resistance

    subroutine riisf_marked_resistance(marks, length, n, K, K_u_surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      real(c_double), intent(inout) :: K(*)
      real(c_double), intent(inout) :: K_u_surface(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_marked_resistance

    subroutine riisf_marked_resistance_64(marks, length, n, K, K_u_surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      real(c_double), intent(inout) :: K(*)
      real(c_double), intent(inout) :: K_u_surface(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_marked_resistance_64

    subroutine riisf_within_limit_resistance(marks, length, n, K, K_u_surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      real(c_double), intent(inout) :: K(*)
      real(c_double), intent(inout) :: K_u_surface(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_within_limit_resistance

    subroutine riisf_within_limit_resistance_64(marks, length, n, K, K_u_surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      real(c_double), intent(inout) :: K(*)
      real(c_double), intent(inout) :: K_u_surface(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_within_limit_resistance_64

    subroutine riisf_add_resistance(marks, R, half_thickness, rim, n_nodes, K, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(inout) :: K(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_resistance

    subroutine riisf_add_resistance_64(marks, R, half_thickness, rim, n_nodes, K, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(inout) :: K(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_resistance_64

    subroutine riisf_add_moving_resistance(marks, R, half_thickness, rim, n_nodes, K, K_u_surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(inout) :: K(*)
      real(c_double), intent(inout) :: K_u_surface(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_moving_resistance

    subroutine riisf_add_moving_resistance_64(marks, R, half_thickness, rim, n_nodes, K, K_u_surface, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(inout) :: K(*)
      real(c_double), intent(inout) :: K_u_surface(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_moving_resistance_64

    subroutine riisf_add_resistance_components(marks, R, half_thickness, rim, n_nodes, K, K_u_x, K_u_y, K_u_z, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(inout) :: K(*)
      real(c_double), intent(inout) :: K_u_x(*)
      real(c_double), intent(inout) :: K_u_y(*)
      real(c_double), intent(inout) :: K_u_z(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_resistance_components

    subroutine riisf_add_resistance_components_64(marks, R, half_thickness, rim, n_nodes, K, K_u_x, K_u_y, K_u_z, &
        status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(inout) :: K(*)
      real(c_double), intent(inout) :: K_u_x(*)
      real(c_double), intent(inout) :: K_u_y(*)
      real(c_double), intent(inout) :: K_u_z(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_resistance_components_64

    subroutine riisf_add_reaction(marks, R, half_thickness, rim, n_nodes, velocity, weight, force, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: velocity(3, *)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(inout) :: force(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_reaction

    subroutine riisf_add_reaction_64(marks, R, half_thickness, rim, n_nodes, velocity, weight, force, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: velocity(3, *)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(inout) :: force(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_reaction_64

    subroutine riisf_add_reaction_components(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, force, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: vx(*)
      real(c_double), intent(in) :: vy(*)
      real(c_double), intent(in) :: vz(*)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(inout) :: force(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_reaction_components

    subroutine riisf_add_reaction_components_64(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, force, &
        status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: vx(*)
      real(c_double), intent(in) :: vy(*)
      real(c_double), intent(in) :: vz(*)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(inout) :: force(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_reaction_components_64

    subroutine riisf_add_leaflet_reaction(marks, R, half_thickness, rim, n_nodes, velocity, weight, about, n_leaflets, &
        force, moment, leaflet_force, leaflet_moment, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: velocity(3, *)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(in) :: about(3)
      integer(int32), intent(in) :: n_leaflets
      real(c_double), intent(inout) :: force(3)
      real(c_double), intent(inout) :: moment(3)
      real(c_double), intent(inout) :: leaflet_force(3, *)
      real(c_double), intent(inout) :: leaflet_moment(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_leaflet_reaction

    subroutine riisf_add_leaflet_reaction_64(marks, R, half_thickness, rim, n_nodes, velocity, weight, about, &
        n_leaflets, force, moment, leaflet_force, leaflet_moment, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: velocity(3, *)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(in) :: about(3)
      integer(int32), intent(in) :: n_leaflets
      real(c_double), intent(inout) :: force(3)
      real(c_double), intent(inout) :: moment(3)
      real(c_double), intent(inout) :: leaflet_force(3, *)
      real(c_double), intent(inout) :: leaflet_moment(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_leaflet_reaction_64

    subroutine riisf_add_leaflet_reaction_components(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, &
        about, n_leaflets, force, moment, leaflet_force, leaflet_moment, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: vx(*)
      real(c_double), intent(in) :: vy(*)
      real(c_double), intent(in) :: vz(*)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(in) :: about(3)
      integer(int32), intent(in) :: n_leaflets
      real(c_double), intent(inout) :: force(3)
      real(c_double), intent(inout) :: moment(3)
      real(c_double), intent(inout) :: leaflet_force(3, *)
      real(c_double), intent(inout) :: leaflet_moment(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_leaflet_reaction_components

    subroutine riisf_add_leaflet_reaction_components_64(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, &
        about, n_leaflets, force, moment, leaflet_force, leaflet_moment, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: vx(*)
      real(c_double), intent(in) :: vy(*)
      real(c_double), intent(in) :: vz(*)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(in) :: about(3)
      integer(int32), intent(in) :: n_leaflets
      real(c_double), intent(inout) :: force(3)
      real(c_double), intent(inout) :: moment(3)
      real(c_double), intent(inout) :: leaflet_force(3, *)
      real(c_double), intent(inout) :: leaflet_moment(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_leaflet_reaction_components_64

    subroutine riisf_add_edge_reaction(marks, R, half_thickness, rim, n_nodes, velocity, weight, n_edges, edges, &
        edge_leaflet_id, edge_force, edge_moment, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: velocity(3, *)
      real(c_double), intent(in) :: weight(*)
      integer(int32), intent(in) :: n_edges
      real(c_double), intent(in) :: edges(3, 2, *)
      integer(int32), intent(in) :: edge_leaflet_id(*)
      real(c_double), intent(inout) :: edge_force(3, *)
      real(c_double), intent(inout) :: edge_moment(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_edge_reaction

    subroutine riisf_add_edge_reaction_64(marks, R, half_thickness, rim, n_nodes, velocity, weight, n_edges, edges, &
        edge_leaflet_id, edge_force, edge_moment, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: velocity(3, *)
      real(c_double), intent(in) :: weight(*)
      integer(int64), intent(in) :: n_edges
      real(c_double), intent(in) :: edges(3, 2, *)
      integer(int32), intent(in) :: edge_leaflet_id(*)
      real(c_double), intent(inout) :: edge_force(3, *)
      real(c_double), intent(inout) :: edge_moment(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_edge_reaction_64

    subroutine riisf_add_edge_reaction_components(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, n_edges, &
        edges, edge_leaflet_id, edge_force, edge_moment, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: vx(*)
      real(c_double), intent(in) :: vy(*)
      real(c_double), intent(in) :: vz(*)
      real(c_double), intent(in) :: weight(*)
      integer(int32), intent(in) :: n_edges
      real(c_double), intent(in) :: edges(3, 2, *)
      integer(int32), intent(in) :: edge_leaflet_id(*)
      real(c_double), intent(inout) :: edge_force(3, *)
      real(c_double), intent(inout) :: edge_moment(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_edge_reaction_components

    subroutine riisf_add_edge_reaction_components_64(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, &
        n_edges, edges, edge_leaflet_id, edge_force, edge_moment, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: vx(*)
      real(c_double), intent(in) :: vy(*)
      real(c_double), intent(in) :: vz(*)
      real(c_double), intent(in) :: weight(*)
      integer(int64), intent(in) :: n_edges
      real(c_double), intent(in) :: edges(3, 2, *)
      integer(int32), intent(in) :: edge_leaflet_id(*)
      real(c_double), intent(inout) :: edge_force(3, *)
      real(c_double), intent(inout) :: edge_moment(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_edge_reaction_components_64

    subroutine riisf_add_vertex_reaction(marks, surface, R, half_thickness, rim, n_nodes, velocity, weight, &
        n_vertices, vertex_force, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int64), intent(in) :: surface
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: velocity(3, *)
      real(c_double), intent(in) :: weight(*)
      integer(int32), intent(in) :: n_vertices
      real(c_double), intent(inout) :: vertex_force(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_vertex_reaction

    subroutine riisf_add_vertex_reaction_64(marks, surface, R, half_thickness, rim, n_nodes, velocity, weight, &
        n_vertices, vertex_force, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int64), intent(in) :: surface
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: velocity(3, *)
      real(c_double), intent(in) :: weight(*)
      integer(int64), intent(in) :: n_vertices
      real(c_double), intent(inout) :: vertex_force(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_vertex_reaction_64

    subroutine riisf_add_vertex_reaction_components(marks, surface, R, half_thickness, rim, n_nodes, vx, vy, vz, &
        weight, n_vertices, vertex_force, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int64), intent(in) :: surface
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: vx(*)
      real(c_double), intent(in) :: vy(*)
      real(c_double), intent(in) :: vz(*)
      real(c_double), intent(in) :: weight(*)
      integer(int32), intent(in) :: n_vertices
      real(c_double), intent(inout) :: vertex_force(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_vertex_reaction_components

    subroutine riisf_add_vertex_reaction_components_64(marks, surface, R, half_thickness, rim, n_nodes, vx, vy, vz, &
        weight, n_vertices, vertex_force, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int64), intent(in) :: surface
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: vx(*)
      real(c_double), intent(in) :: vy(*)
      real(c_double), intent(in) :: vz(*)
      real(c_double), intent(in) :: weight(*)
      integer(int64), intent(in) :: n_vertices
      real(c_double), intent(inout) :: vertex_force(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_add_vertex_reaction_components_64

    subroutine riisf_band_sums(marks, inner, outer, n_nodes, value, weight, sum_of_values, sum_of_weights, n_in_band, &
        status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: inner
      real(c_double), intent(in) :: outer
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: value(*)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(inout) :: sum_of_values(2)
      real(c_double), intent(inout) :: sum_of_weights(2)
      integer(int64), intent(inout) :: n_in_band(2)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_band_sums

    subroutine riisf_band_sums_64(marks, inner, outer, n_nodes, value, weight, sum_of_values, sum_of_weights, &
        n_in_band, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      real(c_double), intent(in) :: inner
      real(c_double), intent(in) :: outer
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: value(*)
      real(c_double), intent(in) :: weight(*)
      real(c_double), intent(inout) :: sum_of_values(2)
      real(c_double), intent(inout) :: sum_of_weights(2)
      integer(int64), intent(inout) :: n_in_band(2)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_band_sums_64

    subroutine riisf_loads_sums(radius, n_edges, edges, edge_leaflet_id, n_nodes, xyz, weight, n_leaflets, sums, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32
      use riis_c, only: riis_status
      implicit none
      real(c_double), intent(in) :: radius
      integer(int32), intent(in) :: n_edges
      real(c_double), intent(in) :: edges(3, 2, *)
      integer(int32), intent(in) :: edge_leaflet_id(*)
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: xyz(3, *)
      real(c_double), intent(in) :: weight(*)
      integer(int32), intent(in) :: n_leaflets
      real(c_double), intent(inout) :: sums(11, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_loads_sums

    subroutine riisf_loads_sums_64(radius, n_edges, edges, edge_leaflet_id, n_nodes, xyz, weight, n_leaflets, sums, &
        status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      real(c_double), intent(in) :: radius
      integer(int64), intent(in) :: n_edges
      real(c_double), intent(in) :: edges(3, 2, *)
      integer(int32), intent(in) :: edge_leaflet_id(*)
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: xyz(3, *)
      real(c_double), intent(in) :: weight(*)
      integer(int64), intent(in) :: n_leaflets
      real(c_double), intent(inout) :: sums(11, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_loads_sums_64

    subroutine riisf_loads_forces(radius, n_edges, edges, edge_leaflet_id, n_nodes, xyz, weight, n_leaflets, about, &
        leaflet_force, leaflet_moment, sums, node_force, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32
      use riis_c, only: riis_status
      implicit none
      real(c_double), intent(in) :: radius
      integer(int32), intent(in) :: n_edges
      real(c_double), intent(in) :: edges(3, 2, *)
      integer(int32), intent(in) :: edge_leaflet_id(*)
      integer(int32), intent(in) :: n_nodes
      real(c_double), intent(in) :: xyz(3, *)
      real(c_double), intent(in) :: weight(*)
      integer(int32), intent(in) :: n_leaflets
      real(c_double), intent(in) :: about(3)
      real(c_double), intent(in) :: leaflet_force(3, *)
      real(c_double), intent(in) :: leaflet_moment(3, *)
      real(c_double), intent(in) :: sums(11, *)
      real(c_double), intent(inout) :: node_force(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_loads_forces

    subroutine riisf_loads_forces_64(radius, n_edges, edges, edge_leaflet_id, n_nodes, xyz, weight, n_leaflets, about, &
        leaflet_force, leaflet_moment, sums, node_force, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      real(c_double), intent(in) :: radius
      integer(int64), intent(in) :: n_edges
      real(c_double), intent(in) :: edges(3, 2, *)
      integer(int32), intent(in) :: edge_leaflet_id(*)
      integer(int64), intent(in) :: n_nodes
      real(c_double), intent(in) :: xyz(3, *)
      real(c_double), intent(in) :: weight(*)
      integer(int64), intent(in) :: n_leaflets
      real(c_double), intent(in) :: about(3)
      real(c_double), intent(in) :: leaflet_force(3, *)
      real(c_double), intent(in) :: leaflet_moment(3, *)
      real(c_double), intent(in) :: sums(11, *)
      real(c_double), intent(inout) :: node_force(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_loads_forces_64

    subroutine riisf_find_leaks(surface, mesh, marks, n_threads, leaks, n_edges, longest, middle, half_thickness, &
        status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: mesh
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(inout) :: leaks
      integer(int64), intent(inout) :: n_edges
      real(c_double), intent(inout) :: longest
      real(c_double), intent(inout) :: middle(3)
      real(c_double), intent(inout) :: half_thickness
      integer(riis_status), intent(out) :: status
    end subroutine riisf_find_leaks

    subroutine riisf_leaking_edges(leaks, length, n, node_num, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: leaks
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      integer(int32), intent(inout) :: node_num(2, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_leaking_edges

    subroutine riisf_leaking_edges_64(leaks, length, n, node_num, status)
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: leaks
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      integer(int64), intent(inout) :: node_num(2, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_leaking_edges_64

    subroutine riisf_leaks_destroy(handle)
      use, intrinsic :: iso_fortran_env, only: int64
      implicit none
      integer(int64), intent(inout) :: handle
    end subroutine riisf_leaks_destroy

    subroutine riisf_label_open_regions(mesh, marks, n_threads, n_nodes, region_num, n_regions, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: n_threads
      integer(int32), intent(in) :: n_nodes
      integer(int32), intent(inout) :: region_num(*)
      integer(int32), intent(inout) :: n_regions
      integer(riis_status), intent(out) :: status
    end subroutine riisf_label_open_regions

    subroutine riisf_label_open_regions_64(mesh, marks, n_threads, n_nodes, region_num, n_regions, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: mesh
      integer(int64), intent(in) :: marks
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(in) :: n_nodes
      integer(int64), intent(inout) :: region_num(*)
      integer(int64), intent(inout) :: n_regions
      integer(riis_status), intent(out) :: status
    end subroutine riisf_label_open_regions_64

    subroutine riisf_find_passage(surface, mesh, n_from, from_num, n_to, to_num, n_threads, state, node_num, distance, &
        point, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: mesh
      integer(int32), intent(in) :: n_from
      integer(int32), intent(in) :: from_num(n_from)
      integer(int32), intent(in) :: n_to
      integer(int32), intent(in) :: to_num(n_to)
      integer(int32), intent(in) :: n_threads
      integer(int32), intent(inout) :: state
      integer(int32), intent(inout) :: node_num
      real(c_double), intent(inout) :: distance
      real(c_double), intent(inout) :: point(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_find_passage

    subroutine riisf_find_passage_64(surface, mesh, n_from, from_num, n_to, to_num, n_threads, state, node_num, &
        distance, point, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: mesh
      integer(int64), intent(in) :: n_from
      integer(int64), intent(in) :: from_num(n_from)
      integer(int64), intent(in) :: n_to
      integer(int64), intent(in) :: to_num(n_to)
      integer(int32), intent(in) :: n_threads
      integer(int32), intent(inout) :: state
      integer(int64), intent(inout) :: node_num
      real(c_double), intent(inout) :: distance
      real(c_double), intent(inout) :: point(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_find_passage_64

    subroutine riisf_find_crossings(surface, depth, n_threads, crossings, n_pairs, length, deepest, point, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      real(c_double), intent(in) :: depth
      integer(int32), intent(in) :: n_threads
      integer(int64), intent(inout) :: crossings
      integer(int64), intent(inout) :: n_pairs
      real(c_double), intent(inout) :: length
      real(c_double), intent(inout) :: deepest
      real(c_double), intent(inout) :: point(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_find_crossings

    subroutine riisf_crossings_destroy(handle)
      use, intrinsic :: iso_fortran_env, only: int64
      implicit none
      integer(int64), intent(inout) :: handle
    end subroutine riisf_crossings_destroy

    subroutine riisf_crossing_pairs(crossings, length, n, triangle_num, point, depth, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: crossings
      integer(int32), intent(in) :: length
      integer(int32), intent(inout) :: n
      integer(int32), intent(inout) :: triangle_num(2, *)
      real(c_double), intent(inout) :: point(3, *)
      real(c_double), intent(inout) :: depth(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_crossing_pairs

    subroutine riisf_crossing_pairs_64(crossings, length, n, triangle_num, point, depth, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: crossings
      integer(int64), intent(in) :: length
      integer(int64), intent(inout) :: n
      integer(int64), intent(inout) :: triangle_num(2, *)
      real(c_double), intent(inout) :: point(3, *)
      real(c_double), intent(inout) :: depth(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_crossing_pairs_64

    subroutine riisf_surface_n_leaflets(surface, n_leaflets, status)
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int32), intent(inout) :: n_leaflets
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_n_leaflets

    subroutine riisf_surface_leaflet(surface, leaflet_num, leaflet_id, area, free_edge, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int32), intent(in) :: leaflet_num
      integer(int32), intent(inout) :: leaflet_id
      real(c_double), intent(inout) :: area
      real(c_double), intent(inout) :: free_edge
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_leaflet

    subroutine riisf_surface_orifice(surface, half_thickness, rim, area, outline_area, perimeter, effective_area, &
        outline, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      real(c_double), intent(inout) :: area
      real(c_double), intent(inout) :: outline_area
      real(c_double), intent(inout) :: perimeter
      real(c_double), intent(inout) :: effective_area
      integer(int32), intent(inout) :: outline
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_orifice

    subroutine riisf_surface_orifice_in_wall(surface, wall, half_thickness, rim, area, outline_area, perimeter, &
        effective_area, outline, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: wall
      real(c_double), intent(in) :: half_thickness
      integer(int32), intent(in) :: rim
      real(c_double), intent(inout) :: area
      real(c_double), intent(inout) :: outline_area
      real(c_double), intent(inout) :: perimeter
      real(c_double), intent(inout) :: effective_area
      integer(int32), intent(inout) :: outline
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_orifice_in_wall

    subroutine riisf_surface_coaptation(surface, reach, leaflet_id, area, edge, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      real(c_double), intent(in) :: reach
      integer(int32), intent(in) :: leaflet_id
      real(c_double), intent(inout) :: area
      real(c_double), intent(inout) :: edge
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_coaptation

    subroutine riisf_surface_gap(surface, wall, least, mean, most, missed, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      integer(int64), intent(in) :: wall
      real(c_double), intent(inout) :: least
      real(c_double), intent(inout) :: mean
      real(c_double), intent(inout) :: most
      integer(int32), intent(inout) :: missed
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_gap

    subroutine riisf_valve_skirt_to_wall(valve, wall, longest, half_thickness, tolerance, scale, rotation_axis, &
        rotation_angle, translation, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      integer(int64), intent(in) :: wall
      real(c_double), intent(in) :: longest
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_valve_skirt_to_wall

    subroutine riisf_surface_leak(surface, R, half_thickness, drop, flow, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: surface
      real(c_double), intent(in) :: R
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: drop
      real(c_double), intent(inout) :: flow
      integer(riis_status), intent(out) :: status
    end subroutine riisf_surface_leak

    subroutine riisf_cells_across(marks, mesh, least, mean, most, mean_edge, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: marks
      integer(int64), intent(in) :: mesh
      real(c_double), intent(inout) :: least
      real(c_double), intent(inout) :: mean
      real(c_double), intent(inout) :: most
      real(c_double), intent(inout) :: mean_edge
      integer(riis_status), intent(out) :: status
    end subroutine riisf_cells_across

    subroutine riisf_valve_swept_volume(valve, opening_from, opening_to, scale, leaflet_id, volume, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      real(c_double), intent(in) :: opening_from
      real(c_double), intent(in) :: opening_to
      real(c_double), intent(in) :: scale
      integer(int32), intent(in) :: leaflet_id
      real(c_double), intent(inout) :: volume
      integer(riis_status), intent(out) :: status
    end subroutine riisf_valve_swept_volume

    subroutine riisf_find_by_area(valve, name, n_areas, areas, half_thickness, tolerance, scale, rotation_axis, &
        rotation_angle, translation, n_threads, area_kind, values, reached, least, most, n_turns, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      character(len=*), intent(in) :: name
      integer(int32), intent(in) :: n_areas
      real(c_double), intent(in) :: areas(*)
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int32), intent(in) :: n_threads
      integer(int32), intent(in) :: area_kind
      real(c_double), intent(inout) :: values(*)
      real(c_double), intent(inout) :: reached(*)
      real(c_double), intent(inout) :: least
      real(c_double), intent(inout) :: most
      integer(int32), intent(inout) :: n_turns
      integer(riis_status), intent(out) :: status
    end subroutine riisf_find_by_area

    subroutine riisf_find_by_area_64(valve, name, n_areas, areas, half_thickness, tolerance, scale, rotation_axis, &
        rotation_angle, translation, n_threads, area_kind, values, reached, least, most, n_turns, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      character(len=*), intent(in) :: name
      integer(int64), intent(in) :: n_areas
      real(c_double), intent(in) :: areas(*)
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int32), intent(in) :: n_threads
      integer(int32), intent(in) :: area_kind
      real(c_double), intent(inout) :: values(*)
      real(c_double), intent(inout) :: reached(*)
      real(c_double), intent(inout) :: least
      real(c_double), intent(inout) :: most
      integer(int64), intent(inout) :: n_turns
      integer(riis_status), intent(out) :: status
    end subroutine riisf_find_by_area_64

    subroutine riisf_find_first_passage(valve, mesh, n_from, from_num, n_to, to_num, half_thickness, tolerance, scale, &
        rotation_axis, rotation_angle, translation, opening_tolerance, n_threads, state, opening, closed_opening, &
        status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      integer(int64), intent(in) :: mesh
      integer(int32), intent(in) :: n_from
      integer(int32), intent(in) :: from_num(n_from)
      integer(int32), intent(in) :: n_to
      integer(int32), intent(in) :: to_num(n_to)
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      real(c_double), intent(in) :: opening_tolerance
      integer(int32), intent(in) :: n_threads
      integer(int32), intent(inout) :: state
      real(c_double), intent(inout) :: opening
      real(c_double), intent(inout) :: closed_opening
      integer(riis_status), intent(out) :: status
    end subroutine riisf_find_first_passage

    subroutine riisf_find_first_passage_64(valve, mesh, n_from, from_num, n_to, to_num, half_thickness, tolerance, &
        scale, rotation_axis, rotation_angle, translation, opening_tolerance, n_threads, state, opening, &
        closed_opening, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      integer(int64), intent(in) :: mesh
      integer(int64), intent(in) :: n_from
      integer(int64), intent(in) :: from_num(n_from)
      integer(int64), intent(in) :: n_to
      integer(int64), intent(in) :: to_num(n_to)
      real(c_double), intent(in) :: half_thickness
      real(c_double), intent(in) :: tolerance
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      real(c_double), intent(in) :: opening_tolerance
      integer(int32), intent(in) :: n_threads
      integer(int32), intent(inout) :: state
      real(c_double), intent(inout) :: opening
      real(c_double), intent(inout) :: closed_opening
      integer(riis_status), intent(out) :: status
    end subroutine riisf_find_first_passage_64

    subroutine riisf_opening_from_table(n_keys, key_time, key_opening, period, interpolation, time, opening, rate, &
        status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_keys
      real(c_double), intent(in) :: key_time(*)
      real(c_double), intent(in) :: key_opening(*)
      real(c_double), intent(in) :: period
      integer(int32), intent(in) :: interpolation
      real(c_double), intent(in) :: time
      real(c_double), intent(inout) :: opening
      real(c_double), intent(inout) :: rate
      integer(riis_status), intent(out) :: status
    end subroutine riisf_opening_from_table

    subroutine riisf_opening_from_times(opening_start, opening_duration, closing_start, closing_duration, closed, &
        open, period, time, opening, rate, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use riis_c, only: riis_status
      implicit none
      real(c_double), intent(in) :: opening_start
      real(c_double), intent(in) :: opening_duration
      real(c_double), intent(in) :: closing_start
      real(c_double), intent(in) :: closing_duration
      real(c_double), intent(in) :: closed
      real(c_double), intent(in) :: open
      real(c_double), intent(in) :: period
      real(c_double), intent(in) :: time
      real(c_double), intent(inout) :: opening
      real(c_double), intent(inout) :: rate
      integer(riis_status), intent(out) :: status
    end subroutine riisf_opening_from_times

    subroutine riisf_opening_switch_init(state, phase, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32
      use riis_c, only: riis_status
      implicit none
      real(c_double), intent(inout) :: state(7)
      integer(int32), intent(inout) :: phase
      integer(riis_status), intent(out) :: status
    end subroutine riisf_opening_switch_init

    subroutine riisf_opening_switch_advance(opening_duration, closing_duration, open_above, close_below, filter_time, &
        dwell_time, time, pressure_difference, flow, state, phase, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32
      use riis_c, only: riis_status
      implicit none
      real(c_double), intent(in) :: opening_duration
      real(c_double), intent(in) :: closing_duration
      real(c_double), intent(in) :: open_above
      real(c_double), intent(in) :: close_below
      real(c_double), intent(in) :: filter_time
      real(c_double), intent(in) :: dwell_time
      real(c_double), intent(in) :: time
      real(c_double), intent(in) :: pressure_difference
      real(c_double), intent(in) :: flow
      real(c_double), intent(inout) :: state(7)
      integer(int32), intent(inout) :: phase
      integer(riis_status), intent(out) :: status
    end subroutine riisf_opening_switch_advance

    subroutine riisf_opening_angle_init(state, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use riis_c, only: riis_status
      implicit none
      real(c_double), intent(inout) :: state(7)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_opening_angle_init

    subroutine riisf_opening_angle_advance(pressure_gain, flow_gain, friction, vortex_gain, angle_min, angle_max, &
        time, pressure_difference, flow, state, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use riis_c, only: riis_status
      implicit none
      real(c_double), intent(in) :: pressure_gain
      real(c_double), intent(in) :: flow_gain
      real(c_double), intent(in) :: friction
      real(c_double), intent(in) :: vortex_gain
      real(c_double), intent(in) :: angle_min
      real(c_double), intent(in) :: angle_max
      real(c_double), intent(in) :: time
      real(c_double), intent(in) :: pressure_difference
      real(c_double), intent(in) :: flow
      real(c_double), intent(inout) :: state(7)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_opening_angle_advance

    subroutine riisf_place(valve, n_landmarks, xyz, role, leaflet_id, scale, noise, flow, held, rotation_axis, &
        rotation_angle, translation, residual, size_state, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      integer(int32), intent(in) :: n_landmarks
      real(c_double), intent(in) :: xyz(3, *)
      integer(int32), intent(in) :: role(*)
      integer(int32), intent(in) :: leaflet_id(2, *)
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: noise
      real(c_double), intent(in) :: flow(3)
      character(len=*), intent(in) :: held
      real(c_double), intent(inout) :: rotation_axis(3)
      real(c_double), intent(inout) :: rotation_angle
      real(c_double), intent(inout) :: translation(3)
      real(c_double), intent(inout) :: residual(*)
      integer(int32), intent(inout) :: size_state(*)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_place

    subroutine riisf_warp_create(n_landmarks, xyz, noise, scale, rotation_axis, rotation_angle, translation, warp, &
        status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int32), intent(in) :: n_landmarks
      real(c_double), intent(in) :: xyz(3, *)
      real(c_double), intent(in) :: noise
      real(c_double), intent(in) :: scale
      real(c_double), intent(in) :: rotation_axis(3)
      real(c_double), intent(in) :: rotation_angle
      real(c_double), intent(in) :: translation(3)
      integer(int64), intent(inout) :: warp
      integer(riis_status), intent(out) :: status
    end subroutine riisf_warp_create

    subroutine riisf_warp_set_targets(warp, n_landmarks, xyz, status)
      use, intrinsic :: iso_c_binding, only: c_double
      use, intrinsic :: iso_fortran_env, only: int32, int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: warp
      integer(int32), intent(in) :: n_landmarks
      real(c_double), intent(in) :: xyz(3, *)
      integer(riis_status), intent(out) :: status
    end subroutine riisf_warp_set_targets

    subroutine riisf_valve_set_warp(valve, closed, open, status)
      use, intrinsic :: iso_fortran_env, only: int64
      use riis_c, only: riis_status
      implicit none
      integer(int64), intent(in) :: valve
      integer(int64), intent(in) :: closed
      integer(int64), intent(in) :: open
      integer(riis_status), intent(out) :: status
    end subroutine riisf_valve_set_warp

    subroutine riisf_warp_destroy(handle)
      use, intrinsic :: iso_fortran_env, only: int64
      implicit none
      integer(int64), intent(inout) :: handle
    end subroutine riisf_warp_destroy
  end interface
end module riisf
