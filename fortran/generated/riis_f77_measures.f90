! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77_measures.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The external subroutines for the measures of a valve for a flow: leaflets, orifice, leak, first passage, cells across the band
!! and swept volume. The conventions are those of riis_f77.f90.

!> Gives the number of the surface's leaflets.
subroutine riisf_surface_n_leaflets(surface, n_leaflets, status)
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_OK, riis_surface_get_n_leaflets
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int32), intent(inout) :: n_leaflets             !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int64) :: n
  status = riis_surface_get_n_leaflets(c_handle_of(surface), n)
  if (status == RIIS_OK) n_leaflets = int(n, int32)
end subroutine riisf_surface_n_leaflets

!> Gives the sizes of a leaflet. Errors: RIIS_INVALID_ARGUMENT for a leaflet that the surface lacks.
subroutine riisf_surface_leaflet(surface, leaflet_num, leaflet_id, area, free_edge, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_leaflet, riis_status, RIIS_OK, riis_surface_get_leaflet
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int32), intent(in) :: leaflet_num               !< 1 to n_leaflets, ascending by leaflet_id.
  integer(int32), intent(inout) :: leaflet_id             !< From 0.
  real(c_double), intent(inout) :: area                   !< The area of its triangles.
  real(c_double), intent(inout) :: free_edge              !< The length of its free edge.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_leaflet) :: leaflet
  status = riis_surface_get_leaflet(c_handle_of(surface), int(leaflet_num, int64) - 1, leaflet, c_sizeof(leaflet))
  if (status /= RIIS_OK) return
  leaflet_id = leaflet%leaflet_id
  area = leaflet%area
  free_edge = leaflet%free_edge
end subroutine riisf_surface_leaflet

!> Measures the orifice of a surface, along its axis. Errors: RIIS_INVALID_ARGUMENT for an argument out of range.
subroutine riisf_surface_orifice(surface, half_thickness, rim, area, outline_area, perimeter, effective_area, outline, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_orifice, riis_resistance, riis_status, RIIS_OK, riis_resistance_init, riis_surface_get_orifice
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  real(c_double), intent(in) :: half_thickness            !< eps of the resistance; RIIS_AUTO: the surface's.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_*.
  real(c_double), intent(inout) :: area                   !< The area that the triangles leave uncovered.
  real(c_double), intent(inout) :: outline_area           !< The area inside the outline.
  real(c_double), intent(inout) :: perimeter              !< The length of the orifice's edge along triangles.
  real(c_double), intent(inout) :: effective_area         !< The area that the band leaves to the flow.
  integer(int32), intent(inout) :: outline                !< RIIS_OUTLINE_*.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_orifice) :: orifice
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status /= RIIS_OK) return
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  status = riis_surface_get_orifice(c_handle_of(surface), resistance, orifice, c_sizeof(orifice))
  if (status /= RIIS_OK) return
  area = orifice%area
  outline_area = orifice%outline_area
  perimeter = orifice%perimeter
  effective_area = orifice%effective_area
  outline = orifice%outline
end subroutine riisf_surface_orifice

!> Measures the coaptation of leaflets: the area and the length of free edge that lie within reach of another leaflet. Errors:
!! RIIS_INVALID_ARGUMENT for a leaflet that the surface lacks, and for a reach out of range.
subroutine riisf_surface_coaptation(surface, reach, leaflet_id, area, edge, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_coaptation, riis_status, RIIS_OK, riis_surface_get_coaptation
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  real(c_double), intent(in) :: reach                     !< Mesh units; RIIS_AUTO: the surface's half thickness.
  integer(int32), intent(in) :: leaflet_id                !< From 0; RIIS_ALL_LEAFLETS: the sum over all leaflets.
  real(c_double), intent(inout) :: area                   !< The area within reach of another leaflet.
  real(c_double), intent(inout) :: edge                   !< The length of free edge within reach of another leaflet.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_coaptation) :: coaptation
  status = riis_surface_get_coaptation(c_handle_of(surface), reach, leaflet_id, coaptation, c_sizeof(coaptation))
  if (status /= RIIS_OK) return
  area = coaptation%area
  edge = coaptation%edge
end subroutine riisf_surface_coaptation

!> Measures the gap between the attachment of a valve and a wall, along the direction of a skirt. Errors: RIIS_INVALID_ARGUMENT
!! for a surface from arrays, and for one without an attachment.
subroutine riisf_surface_gap(surface, wall, least, mean, most, missed, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_gap, riis_status, RIIS_OK, riis_surface_get_gap
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< A surface made from a valve.
  integer(int64), intent(in) :: wall                      !< A surface in the same frame.
  real(c_double), intent(inout) :: least                  !< The least gap; negative where the wall is inside.
  real(c_double), intent(inout) :: mean                   !< The mean along the attachment.
  real(c_double), intent(inout) :: most                   !< The widest gap.
  integer(int32), intent(inout) :: missed                 !< The number of ends of edges whose line misses the wall.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_gap) :: gap
  status = riis_surface_get_gap(c_handle_of(surface), c_handle_of(wall), gap=gap, struct_size=c_sizeof(gap))
  if (status /= RIIS_OK) return
  least = gap%least
  mean = gap%mean
  most = gap%most
  missed = int(gap%n_without_wall, int32)
end subroutine riisf_surface_gap

!> Gives a valve a skirt that reaches a wall, and no farther. Errors: RIIS_INVALID_ARGUMENT for a wall that is missed or farther
!! than longest; RIIS_INVALID_PARAMETER for a bileaflet valve, and for an attachment that encloses no area.
subroutine riisf_valve_skirt_to_wall(valve, wall, longest, half_thickness, tolerance, scale, rotation_axis, &
    rotation_angle, translation, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_surface_options, RIIS_OK, riis_valve_set_skirt_to_wall
  use riis_support, only: c_handle_of, get_placement
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created.
  integer(int64), intent(in) :: wall                      !< A surface in the frame of the placed valve.
  real(c_double), intent(in) :: longest                   !< The longest length to accept, mesh units.
  real(c_double), intent(in) :: half_thickness            !< Mesh units; RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The error of distances is at most tolerance
                                                          !! * half_thickness.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees; 0 for no rotation.
  real(c_double), intent(in) :: translation(3)            !< Mesh units; 0 for no translation.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  status = get_placement(half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, options)
  if (status /= RIIS_OK) return
  status = riis_valve_set_skirt_to_wall(c_handle_of(valve), c_handle_of(wall), longest, options)
end subroutine riisf_valve_skirt_to_wall

!> Tells the ideal leak of a closed surface: the volume flow through it at a pressure drop. The flow is drop * (eps / R) * area.
!! The bileaflet housing does not count. Errors: RIIS_INVALID_ARGUMENT for an argument out of range.
subroutine riisf_surface_leak(surface, R, half_thickness, drop, flow, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_resistance, riis_status, RIIS_OK, riis_resistance_init, riis_surface_get_leak
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created and closed.
  real(c_double), intent(in) :: R                         !< 1e-60 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps of the resistance; RIIS_AUTO: the surface's.
  real(c_double), intent(in) :: drop                      !< Upstream minus downstream pressure, magnitude at most 1e30.
  real(c_double), intent(inout) :: flow                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  status = riis_surface_get_leak(c_handle_of(surface), resistance, drop, flow)
end subroutine riisf_surface_leak

!> Gives the number of mesh edges across the band around the surface, from the lengths of the edges with a marked node. Errors:
!! RIIS_INVALID_ARGUMENT for a mesh without an adjacency, and for marks that do not come from a marking with this mesh.
subroutine riisf_cells_across(marks, mesh, least, mean, most, mean_edge, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_cells_across, riis_status, RIIS_OK, riis_marks_get_cells_across
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int64), intent(in) :: mesh                      !< The mesh of the marking, with an adjacency.
  real(c_double), intent(inout) :: least                  !< 2 half thicknesses / longest edge; 0 without an edge.
  real(c_double), intent(inout) :: mean                   !< 2 half thicknesses / mean edge.
  real(c_double), intent(inout) :: most                   !< 2 half thicknesses / shortest edge.
  real(c_double), intent(inout) :: mean_edge              !< The mean length of the edges.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_cells_across) :: cells
  status = riis_marks_get_cells_across(c_handle_of(marks), c_handle_of(mesh), cells, c_sizeof(cells))
  if (status /= RIIS_OK) return
  least = cells%least
  mean = cells%mean
  most = cells%most
  mean_edge = cells%mean_edge
end subroutine riisf_cells_across

!> Gives the volume that a valve sweeps between two openings: the integral of u_surface . n over surface and time, positive along
!! the normals. Errors: RIIS_INVALID_ARGUMENT for an opening out of range and for a leaflet that the valve lacks;
!! RIIS_INVALID_PARAMETER for parameters that do not fit together, and for a valve with one state unless both are 0.
subroutine riisf_valve_swept_volume(valve, opening_from, opening_to, scale, leaflet_id, volume, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_surface_options, RIIS_OK, riis_surface_options_init, riis_valve_get_swept_volume
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created. Its own opening has no effect.
  real(c_double), intent(in) :: opening_from              !< 0 to 1.
  real(c_double), intent(in) :: opening_to                !< 0 to 1.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  integer(int32), intent(in) :: leaflet_id                !< RIIS_LEAFLET_* or RIIS_ALL_LEAFLETS.
  real(c_double), intent(inout) :: volume                 !< Written on success, mesh units cubed.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%scale = scale
  status = riis_valve_get_swept_volume(c_handle_of(valve), opening_from, opening_to, options, leaflet_id, volume)
end subroutine riisf_valve_swept_volume


!> Finds the opening at which riisf_find_passage first finds a passage: it tries 0, 1/8, 2/8, ... until one is open, and then
!! halves the last step. Errors: those of riisf_surface_create and riisf_find_passage, with the opening.
subroutine riisf_find_first_passage(valve, mesh, n_from, from_num, n_to, to_num, half_thickness, tolerance, scale, &
    rotation_axis, rotation_angle, translation, opening_tolerance, n_threads, state, opening, closed_opening, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_first_passage, riis_first_passage_options, riis_mark_options, riis_passage_ends, riis_status, &
    riis_surface_options, RIIS_OK, riis_find_first_passage, riis_first_passage_options_init, riis_mark_options_init, &
    riis_passage_ends_init
  use riis_support, only: c_handle_of, get_placement, out_of_memory
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created. Its own opening has no effect.
  integer(int64), intent(in) :: mesh                      !< A mesh with an adjacency. A marking is not needed.
  integer(int32), intent(in) :: n_from                    !< At least 1.
  integer(int32), intent(in) :: from_num(n_from)          !< Nodes where paths begin, counted from 1, in any order.
  integer(int32), intent(in) :: n_to                      !< At least 1.
  integer(int32), intent(in) :: to_num(n_to)              !< Nodes where paths end.
  real(c_double), intent(in) :: half_thickness            !< Mesh units; RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The error of distances is at most tolerance
                                                          !! * half_thickness.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees; 0 for no rotation.
  real(c_double), intent(in) :: translation(3)            !< Mesh units; 0 for no translation.
  real(c_double), intent(in) :: opening_tolerance         !< 1e-6 to 1, usually 1e-3.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(inout) :: state                  !< RIIS_FIRST_PASSAGE_*.
  real(c_double), intent(inout) :: opening                !< The opening that was tried and has a passage.
  real(c_double), intent(inout) :: closed_opening         !< The largest tried opening below that one.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options), target :: surface
  type(riis_mark_options), target :: marking
  type(riis_first_passage_options) :: options
  type(riis_passage_ends) :: ends
  type(riis_first_passage) :: first
  integer(int64), allocatable, target :: from(:), to(:)
  integer :: stat
  status = get_placement(half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, surface)
  if (status == RIIS_OK) status = riis_mark_options_init(marking, c_sizeof(marking))
  if (status == RIIS_OK) status = riis_first_passage_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_passage_ends_init(ends, c_sizeof(ends))
  if (status /= RIIS_OK) return
  surface%n_threads = n_threads
  marking%n_threads = n_threads
  allocate (from(max(n_from, int(1, int32))), to(max(n_to, int(1, int32))), stat=stat)
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  from(:n_from) = int(from_num, int64) - 1
  to(:n_to) = int(to_num, int64) - 1
  ends%n_from = n_from
  ends%from = c_loc(from)
  ends%n_to = n_to
  ends%to = c_loc(to)
  options%surface = c_loc(surface)
  options%marking = c_loc(marking)
  options%tolerance = opening_tolerance
  status = riis_find_first_passage(c_handle_of(valve), c_handle_of(mesh), ends, options, first, c_sizeof(first))
  if (status /= RIIS_OK) return
  state = first%state
  opening = first%opening
  closed_opening = first%closed_opening
end subroutine riisf_find_first_passage

!> Does the same with INTEGER*8.
subroutine riisf_find_first_passage_64(valve, mesh, n_from, from_num, n_to, to_num, half_thickness, tolerance, scale, &
    rotation_axis, rotation_angle, translation, opening_tolerance, n_threads, state, opening, closed_opening, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_first_passage, riis_first_passage_options, riis_mark_options, riis_passage_ends, riis_status, &
    riis_surface_options, RIIS_OK, riis_find_first_passage, riis_first_passage_options_init, riis_mark_options_init, &
    riis_passage_ends_init
  use riis_support, only: c_handle_of, get_placement, out_of_memory
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created. Its own opening has no effect.
  integer(int64), intent(in) :: mesh                      !< A mesh with an adjacency. A marking is not needed.
  integer(int64), intent(in) :: n_from                    !< At least 1.
  integer(int64), intent(in) :: from_num(n_from)          !< Nodes where paths begin, counted from 1, in any order.
  integer(int64), intent(in) :: n_to                      !< At least 1.
  integer(int64), intent(in) :: to_num(n_to)              !< Nodes where paths end.
  real(c_double), intent(in) :: half_thickness            !< Mesh units; RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The error of distances is at most tolerance
                                                          !! * half_thickness.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees; 0 for no rotation.
  real(c_double), intent(in) :: translation(3)            !< Mesh units; 0 for no translation.
  real(c_double), intent(in) :: opening_tolerance         !< 1e-6 to 1, usually 1e-3.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(inout) :: state                  !< RIIS_FIRST_PASSAGE_*.
  real(c_double), intent(inout) :: opening                !< The opening that was tried and has a passage.
  real(c_double), intent(inout) :: closed_opening         !< The largest tried opening below that one.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options), target :: surface
  type(riis_mark_options), target :: marking
  type(riis_first_passage_options) :: options
  type(riis_passage_ends) :: ends
  type(riis_first_passage) :: first
  integer(int64), allocatable, target :: from(:), to(:)
  integer :: stat
  status = get_placement(half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, surface)
  if (status == RIIS_OK) status = riis_mark_options_init(marking, c_sizeof(marking))
  if (status == RIIS_OK) status = riis_first_passage_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_passage_ends_init(ends, c_sizeof(ends))
  if (status /= RIIS_OK) return
  surface%n_threads = n_threads
  marking%n_threads = n_threads
  allocate (from(max(n_from, int(1, int64))), to(max(n_to, int(1, int64))), stat=stat)
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  from(:n_from) = int(from_num, int64) - 1
  to(:n_to) = int(to_num, int64) - 1
  ends%n_from = n_from
  ends%from = c_loc(from)
  ends%n_to = n_to
  ends%to = c_loc(to)
  options%surface = c_loc(surface)
  options%marking = c_loc(marking)
  options%tolerance = opening_tolerance
  status = riis_find_first_passage(c_handle_of(valve), c_handle_of(mesh), ends, options, first, c_sizeof(first))
  if (status /= RIIS_OK) return
  state = first%state
  opening = first%opening
  closed_opening = first%closed_opening
end subroutine riisf_find_first_passage_64
