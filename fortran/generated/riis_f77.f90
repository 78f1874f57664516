! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> riis for codes that cannot use modules: external subroutines with implicit interfaces, for Fortran 77 and later, in fixed or
!! free form. `include 'riisf.h'` gives the constants.
!!
!!           INCLUDE 'riisf.h'
!!           INTEGER*8 VALVE, SURFACE, MESH, RESULT
!!           DOUBLE PRECISION XYZ(3, 100000), AXIS(3), SHIFT(3), DIST(5000)
!!           INTEGER STATUS, N, NODE(5000)
!!           DATA VALVE, SURFACE, MESH, RESULT /4*0/, AXIS /0D0, 0D0, 1D0/, SHIFT /3*0D0/
!!           CALL RIISF_VALVE_CREATE('aortic', VALVE, STATUS)
!!           CALL RIISF_SURFACE_CREATE(VALVE, RIIS_AUTO, 0.05D0, 1D0, AXIS, 0D0, SHIFT, SURFACE, STATUS)
!!           CALL RIISF_MESH_CREATE(100000, XYZ(1,1), XYZ(2,1), XYZ(3,1), 3, MESH, STATUS)
!!           CALL RIISF_MARK_NODES(SURFACE, MESH, RIIS_AUTO, RIIS_SEARCH_AUTO, 0, RESULT, STATUS)
!!           CALL RIISF_MARKED(RESULT, 5000, N, NODE, DIST, STATUS)
!!
!! Rules for every subroutine:
!!
!! - Pass every argument, with exactly the kind that is declared here: no compiler checks this. `integer(int32)` is INTEGER*4,
!!   INTEGER with the usual options; `integer(int64)` is INTEGER*8; `real(c_double)` is DOUBLE PRECISION, or REAL*8 if an
!!   option (-fdefault-real-8) makes DOUBLE PRECISION longer.
!! - Handles are INTEGER*8, 0 before they are created and after they are destroyed. Creating sets them only on success.
!! - The last argument is the status: RIIS_OK (0), or an error, whose message riisf_last_error gives. After an error nothing
!!   has changed. Each thread has its own message. Messages count from 0.
!! - Names may have trailing blanks.
!! - Coordinates, and the rows for riisf_mesh_set_adjacency, are borrowed: they must stay in place (in COMMON, or with SAVE,
!!   or in the main program) until the mesh is destroyed or gets other arrays. All other arrays are used during the call only. No
!!   array is copied except the marks of riisf_dense_mark.
!! - Nodes that the library gives count from 1. Anything called *_id counts from 0, as in C. Ids that the caller gives count
!!   from index_base.
!! - A subroutine whose name ends in _64 does the same as the one without _64, with counts and ids of INTEGER*8.
!! - Threads: any number of threads may read an object at once. One thread may write it while no other reads it.

!> Makes a valve with the paper's parameter values. Errors: RIIS_INVALID_PARAMETER for an unknown kind.
subroutine riisf_valve_create(kind, valve, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, RIIS_OK, riis_c_string, riis_valve_create
  use riis_support, only: handle_of
  implicit none
  character(len=*), intent(in) :: kind                    !< 'aortic', 'mitral', 'coapting', 'trileaflet' or 'bileaflet'.
  integer(int64), intent(inout) :: valve                  !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_valve_create(riis_c_string(kind), c_handle)
  if (status == RIIS_OK) valve = handle_of(c_handle)
end subroutine riisf_valve_create

!> Makes a copy with the same parameters and states. Each valve is destroyed separately.
subroutine riisf_valve_copy(valve, copy, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, RIIS_OK, riis_valve_copy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created.
  integer(int64), intent(inout) :: copy                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_valve_copy(c_handle_of(valve), c_handle)
  if (status == RIIS_OK) copy = handle_of(c_handle)
end subroutine riisf_valve_copy

!> Sets a parameter, which has 1 or 3 values. Every valve has the parameter 'opening', from 0 to 1. Errors: RIIS_INVALID_PARAMETER
!! naming the parameter and the value.
subroutine riisf_valve_set(valve, name, n_values, values, status)
  use, intrinsic :: iso_c_binding, only: c_char, c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_valve_set
  use riis_support, only: c_handle_of, end_for_c
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created.
  character(len=*), intent(in) :: name                    !< Such as 'leaflet_angle', 'right.rotation'.
  integer(int32), intent(in) :: n_values                  !< 1 or 3, as the parameter has.
  real(c_double), intent(in) :: values(*)                 !< Lengths in the valve's unit, angles in degrees.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(name) + 1, kind=c_char) :: c_name
  call end_for_c(name, c_name)
  status = riis_valve_set(c_handle_of(valve), c_name, int(n_values, int64), values)
end subroutine riisf_valve_set

!> Gets a parameter's values.
subroutine riisf_valve_get(valve, name, n_values, values, status)
  use, intrinsic :: iso_c_binding, only: c_char, c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_valve_get
  use riis_support, only: c_handle_of, end_for_c
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created.
  character(len=*), intent(in) :: name                    !< As in riisf_valve_set, but always with the cusp's name.
  integer(int32), intent(in) :: n_values                  !< 1 or 3, as the parameter has.
  real(c_double), intent(inout) :: values(*)              !< Unchanged on an error.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(name) + 1, kind=c_char) :: c_name
  call end_for_c(name, c_name)
  status = riis_valve_get(c_handle_of(valve), c_name, int(n_values, int64), values)
end subroutine riisf_valve_get

!> Returns a parameter to the value of a valve on which it was not set: its rule's value, or its default.
subroutine riisf_valve_unset(valve, name, status)
  use, intrinsic :: iso_c_binding, only: c_char
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_valve_unset
  use riis_support, only: c_handle_of, end_for_c
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created.
  character(len=*), intent(in) :: name                    !< As in riisf_valve_set.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(name) + 1, kind=c_char) :: c_name
  call end_for_c(name, c_name)
  status = riis_valve_unset(c_handle_of(valve), c_name)
end subroutine riisf_valve_unset

!> Says whether a parameter was set.
subroutine riisf_valve_is_set(valve, name, is_set, status)
  use, intrinsic :: iso_c_binding, only: c_char
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_valve_is_set
  use riis_support, only: c_handle_of, end_for_c
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created.
  character(len=*), intent(in) :: name                    !< As in riisf_valve_get.
  integer(int32), intent(inout) :: is_set                 !< 1, or 0 for a default or a rule. Unchanged on an error.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(name) + 1, kind=c_char) :: c_name
  call end_for_c(name, c_name)
  status = riis_valve_is_set(c_handle_of(valve), c_name, is_set)
end subroutine riisf_valve_is_set

!> Gives the valve an open state at 'opening' 1. Its own state is the closed state. Errors: RIIS_INVALID_PARAMETER for a valve of
!! another kind.
subroutine riisf_valve_set_open_state(valve, open, status)
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_valve_set_open_state
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created.
  integer(int64), intent(in) :: open                      !< Must be created. It is copied, so it may be destroyed.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_valve_set_open_state(c_handle_of(valve), c_handle_of(open))
end subroutine riisf_valve_set_open_state

!> Destroys the valve and sets its handle to 0. Nothing happens to a handle that is 0.
subroutine riisf_valve_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_valve_destroy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_valve_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_valve_destroy

!> Makes the surface of a valve, placed by x -> scale * rotation * x + translation. Errors: RIIS_INVALID_ARGUMENT for an option
!! out of range, RIIS_INVALID_PARAMETER for parameters that do not fit together.
subroutine riisf_surface_create(valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
    translation, surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_surface_options, RIIS_OK, riis_surface_create
  use riis_support, only: c_handle_of, get_placement, handle_of
  implicit none
  integer(int64), intent(in) :: valve                     !< Must be created; read during the call only.
  real(c_double), intent(in) :: half_thickness            !< Mesh units; RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The error of distances is at most tolerance
                                                          !! * half_thickness.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees; 0 for no rotation.
  real(c_double), intent(in) :: translation(3)            !< Mesh units; 0 for no translation.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = get_placement(half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, options)
  if (status /= RIIS_OK) return
  c_handle = c_null_ptr
  status = riis_surface_create(c_handle_of(valve), options, c_handle)
  if (status == RIIS_OK) surface = handle_of(c_handle)
end subroutine riisf_surface_create

!> Replaces the surface by the surface of a valve that moved, with the same options. The errors are those of riisf_surface_create.
subroutine riisf_surface_update(surface, valve, status)
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_surface_update
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: valve                     !< Must be created; read during the call only.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_surface_update(c_handle_of(surface), c_handle_of(valve))
end subroutine riisf_surface_update

!> Replaces the surface like riisf_surface_update, but with other options, which are those of riisf_surface_create.
subroutine riisf_surface_place(surface, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
    translation, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_surface_options, RIIS_OK, riis_surface_update
  use riis_support, only: c_handle_of, get_placement
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: valve                     !< Must be created; read during the call only.
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
  status = riis_surface_update(c_handle_of(surface), c_handle_of(valve), options)
end subroutine riisf_surface_place

!> Replaces the surface like riisf_surface_place, and sets the method of measuring distances. riisf_surface_update keeps this
!! method.
subroutine riisf_surface_measure(surface, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
    translation, measure, measure_tolerance, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_surface_options, RIIS_OK, riis_surface_update
  use riis_support, only: c_handle_of, get_placement
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: valve                     !< Must be created; read during the call only.
  real(c_double), intent(in) :: half_thickness            !< Mesh units; RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The error of distances is at most tolerance
                                                          !! * half_thickness.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees; 0 for no rotation.
  real(c_double), intent(in) :: translation(3)            !< Mesh units; 0 for no translation.
  integer(int32), intent(in) :: measure                   !< RIIS_MEASURE_*.
  real(c_double), intent(in) :: measure_tolerance        !< A fraction of half_thickness, 1e-6 to 1; RIIS_AUTO: tolerance.
                                                          !! Not used by RIIS_MEASURE_TRIANGLES.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  status = get_placement(half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, options)
  if (status /= RIIS_OK) return
  options%measure = measure
  options%measure_tolerance = measure_tolerance
  status = riis_surface_update(c_handle_of(surface), c_handle_of(valve), options)
end subroutine riisf_surface_measure

!> Replaces the surface like riisf_surface_place, and sets the kind of triangulation, which later updates keep. With
!! RIIS_TRIANGULATION_FIXED, triangles keep their ids, vertices and neighbours at every opening, and only the opening may change.
!! Errors then: RIIS_INVALID_PARAMETER naming another parameter that changed, RIIS_LIMIT_EXCEEDED for an opening at which the
!! tolerance does not hold.
subroutine riisf_surface_triangulate(surface, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
    translation, triangulation, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_surface_options, RIIS_OK, riis_surface_update
  use riis_support, only: c_handle_of, get_placement
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: valve                     !< Must be created; read during the call only.
  real(c_double), intent(in) :: half_thickness            !< Mesh units; RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The error of distances is at most tolerance
                                                          !! * half_thickness.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees; 0 for no rotation.
  real(c_double), intent(in) :: translation(3)            !< Mesh units; 0 for no translation.
  integer(int32), intent(in) :: triangulation             !< RIIS_TRIANGULATION_*.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  status = get_placement(half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, options)
  if (status /= RIIS_OK) return
  options%triangulation = triangulation
  status = riis_surface_update(c_handle_of(surface), c_handle_of(valve), options)
end subroutine riisf_surface_triangulate

!> Replaces the surface like riisf_surface_update, and also gives every vertex a velocity. The velocity is the displacement from
!! the point with the same patch, u and v in the earlier state, divided by dt. Errors: as for riisf_surface_create;
!! RIIS_INVALID_ARGUMENT for dt out of range; RIIS_INVALID_PARAMETER for a valve_before of another kind or with other patches.
subroutine riisf_surface_update_moving(surface, valve, valve_before, dt, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_surface_update_moving
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: valve                     !< Must be created; read during the call only.
  integer(int64), intent(in) :: valve_before              !< The earlier state; read during the call only.
  real(c_double), intent(in) :: dt                        !< From valve_before to valve, 1e-30 to 1e30, or negative if time goes
                                                          !! backwards.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_surface_update_moving(c_handle_of(surface), c_handle_of(valve), c_handle_of(valve_before), dt)
end subroutine riisf_surface_update_moving

!> Replaces the surface like riisf_surface_update_moving, but with another placement, now and before.
subroutine riisf_surface_place_moving(surface, valve, valve_before, dt, half_thickness, tolerance, scale, &
    rotation_axis, rotation_angle, translation, scale_before, rotation_axis_before, rotation_angle_before, &
    translation_before, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_surface_options, RIIS_OK, riis_surface_update_moving
  use riis_support, only: c_handle_of, get_placement
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: valve                     !< Must be created; read during the call only.
  integer(int64), intent(in) :: valve_before              !< The earlier state; read during the call only.
  real(c_double), intent(in) :: dt                        !< From valve_before to valve.
  real(c_double), intent(in) :: half_thickness            !< Mesh units; RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The error of distances is at most tolerance
                                                          !! * half_thickness.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees; 0 for no rotation.
  real(c_double), intent(in) :: translation(3)            !< Mesh units; 0 for no translation.
  real(c_double), intent(in) :: scale_before              !< For the earlier state, like the next three arguments.
  real(c_double), intent(in) :: rotation_axis_before(3)   !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle_before     !< Degrees.
  real(c_double), intent(in) :: translation_before(3)     !< Mesh units.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options, before
  status = get_placement(half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, options)
  if (status == RIIS_OK) status = get_placement(half_thickness, tolerance, scale_before, rotation_axis_before, &
    rotation_angle_before, translation_before, before)
  if (status /= RIIS_OK) return
  status = riis_surface_update_moving(c_handle_of(surface), c_handle_of(valve), c_handle_of(valve_before), dt, options, &
    before)
end subroutine riisf_surface_place_moving

!> Adds a direction in which the surface of a valve changes, as riis_surface_add_direction does with the surface's placement.
!! Marking with RIIS_FIELD_GRADIENT then gives the derivatives of distances and of K. The directions count from 1, in the order of
!! the calls. An update removes them. Errors: RIIS_INVALID_ARGUMENT for a surface from arrays and for dp out of range;
!! RIIS_INVALID_PARAMETER for a state of another kind or with other patches; RIIS_LIMIT_EXCEEDED for more than 1000.
subroutine riisf_surface_add_direction(surface, valve_after, valve_before, dp, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_surface_add_direction
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: valve_after               !< The valve with the parameter a little larger than in the surface.
  integer(int64), intent(in) :: valve_before              !< The valve with the parameter a little smaller.
  real(c_double), intent(in) :: dp                        !< The parameter's difference from valve_before to valve_after.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_surface_add_direction(c_handle_of(surface), c_handle_of(valve_after), c_handle_of(valve_before), dp)
end subroutine riisf_surface_add_direction

!> Adds a direction like riisf_surface_add_direction, in which the placement also changes.
subroutine riisf_surface_add_placed(surface, valve_after, valve_before, dp, scale_after, rotation_axis_after, &
    rotation_angle_after, translation_after, scale_before, rotation_axis_before, rotation_angle_before, &
    translation_before, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_surface_options, RIIS_AUTO, RIIS_OK, riis_surface_add_direction
  use riis_support, only: c_handle_of, get_placement
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: valve_after               !< The valve with the parameter a little larger than in the surface.
  integer(int64), intent(in) :: valve_before              !< The valve with the parameter a little smaller, or the same valve.
  real(c_double), intent(in) :: dp                        !< The parameter's difference from the state before to the state after.
  real(c_double), intent(in) :: scale_after               !< For the state after, like the next three arguments.
  real(c_double), intent(in) :: rotation_axis_after(3)    !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle_after      !< Degrees.
  real(c_double), intent(in) :: translation_after(3)      !< Mesh units.
  real(c_double), intent(in) :: scale_before              !< For the state before, like the next three arguments.
  real(c_double), intent(in) :: rotation_axis_before(3)   !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle_before     !< Degrees.
  real(c_double), intent(in) :: translation_before(3)     !< Mesh units.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: after, before
  status = get_placement(RIIS_AUTO, 0.05d0, scale_after, rotation_axis_after, rotation_angle_after, translation_after, after)
  if (status == RIIS_OK) status = get_placement(RIIS_AUTO, 0.05d0, scale_before, rotation_axis_before, &
    rotation_angle_before, translation_before, before)
  if (status /= RIIS_OK) return
  status = riis_surface_add_direction(c_handle_of(surface), c_handle_of(valve_after), c_handle_of(valve_before), dp, after, &
    before)
end subroutine riisf_surface_add_placed

!> Destroys the surface and sets its handle to 0. Nothing happens to a handle that is 0.
subroutine riisf_surface_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_surface_destroy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_surface_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_surface_destroy

!> Makes a mesh that borrows node coordinates and checks them once. Errors: RIIS_INVALID_MESH naming the node, counted from 0, and
!! the value.
subroutine riisf_mesh_create(n_nodes, x, y, z, stride, mesh, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_OK, riis_mesh_create
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int32), intent(in) :: n_nodes                   !< >= 0.
  real(c_double), intent(in) :: x(*)                      !< Node i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Node i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Node i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int64), intent(inout) :: mesh                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_mesh_create(int(n_nodes, int64), location_of(x), location_of(y), location_of(z), int(stride, int64), &
    c_handle)
  if (status == RIIS_OK) mesh = handle_of(c_handle)
end subroutine riisf_mesh_create

!> Does the same.
subroutine riisf_mesh_create_64(n_nodes, x, y, z, stride, mesh, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, RIIS_OK, riis_mesh_create
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int64), intent(in) :: n_nodes                   !< >= 0.
  real(c_double), intent(in) :: x(*)                      !< Node i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Node i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Node i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int64), intent(inout) :: mesh                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_mesh_create(int(n_nodes, int64), location_of(x), location_of(y), location_of(z), int(stride, int64), &
    c_handle)
  if (status == RIIS_OK) mesh = handle_of(c_handle)
end subroutine riisf_mesh_create_64

!> Tells the mesh that the coordinates changed, in place or to other arrays. Call it after every change of coordinates. The
!! adjacency stays if n_nodes stays.
subroutine riisf_mesh_update(mesh, n_nodes, x, y, z, stride, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_mesh_update
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: mesh                      !< Must be created.
  integer(int32), intent(in) :: n_nodes                   !< >= 0.
  real(c_double), intent(in) :: x(*)                      !< Node i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Node i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Node i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_mesh_update(c_handle_of(mesh), int(n_nodes, int64), location_of(x), location_of(y), location_of(z), &
    int(stride, int64))
end subroutine riisf_mesh_update

!> Does the same.
subroutine riisf_mesh_update_64(mesh, n_nodes, x, y, z, stride, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_mesh_update
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: mesh                      !< Must be created.
  integer(int64), intent(in) :: n_nodes                   !< >= 0.
  real(c_double), intent(in) :: x(*)                      !< Node i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Node i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Node i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_mesh_update(c_handle_of(mesh), int(n_nodes, int64), location_of(x), location_of(y), location_of(z), &
    int(stride, int64))
end subroutine riisf_mesh_update_64

!> Makes a mesh that copies node coordinates and checks them: REAL*4 with real_bits 32, REAL*8 with 64. The caller's arrays are
!! not needed afterwards. Errors: RIIS_INVALID_MESH naming the node, counted from 0, and the value.
subroutine riisf_mesh_create_copy(n_nodes, x, y, z, stride, real_bits, &
    mesh, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_points, riis_status, RIIS_OK, riis_mesh_create_copy, riis_points_init
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int32), intent(in) :: n_nodes                   !< >= 0.
  type(*), intent(in) :: x(*)                             !< Node i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  type(*), intent(in) :: y(*)                             !< Node i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  type(*), intent(in) :: z(*)                             !< Node i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: real_bits                 !< 32 for REAL*4, 64 for REAL*8.
  integer(int64), intent(inout) :: mesh                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: nodes
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_points_init(nodes, c_sizeof(nodes))
  if (status /= RIIS_OK) return
  nodes%n_points = n_nodes
  nodes%x = location_of(x)
  nodes%y = location_of(y)
  nodes%z = location_of(z)
  nodes%stride = stride
  nodes%real_bits = real_bits
  status = riis_mesh_create_copy(nodes, c_handle)
  if (status == RIIS_OK) mesh = handle_of(c_handle)
end subroutine riisf_mesh_create_copy

!> Does the same.
subroutine riisf_mesh_create_copy_64(n_nodes, x, y, z, stride, real_bits, &
    mesh, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_points, riis_status, RIIS_OK, riis_mesh_create_copy, riis_points_init
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int64), intent(in) :: n_nodes                   !< >= 0.
  type(*), intent(in) :: x(*)                             !< Node i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  type(*), intent(in) :: y(*)                             !< Node i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  type(*), intent(in) :: z(*)                             !< Node i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: real_bits                 !< 32 for REAL*4, 64 for REAL*8.
  integer(int64), intent(inout) :: mesh                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: nodes
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_points_init(nodes, c_sizeof(nodes))
  if (status /= RIIS_OK) return
  nodes%n_points = n_nodes
  nodes%x = location_of(x)
  nodes%y = location_of(y)
  nodes%z = location_of(z)
  nodes%stride = stride
  nodes%real_bits = real_bits
  status = riis_mesh_create_copy(nodes, c_handle)
  if (status == RIIS_OK) mesh = handle_of(c_handle)
end subroutine riisf_mesh_create_copy_64

!> Copies new coordinates into a mesh. A mesh may change between borrowed and copied coordinates.
subroutine riisf_mesh_update_copy(mesh, n_nodes, x, y, z, stride, real_bits, &
    status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_points, riis_status, RIIS_OK, riis_mesh_update_copy, riis_points_init
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: mesh                      !< Must be created.
  integer(int32), intent(in) :: n_nodes                   !< >= 0.
  type(*), intent(in) :: x(*)                             !< Node i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  type(*), intent(in) :: y(*)                             !< Node i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  type(*), intent(in) :: z(*)                             !< Node i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: real_bits                 !< 32 for REAL*4, 64 for REAL*8.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: nodes
  status = riis_points_init(nodes, c_sizeof(nodes))
  if (status /= RIIS_OK) return
  nodes%n_points = n_nodes
  nodes%x = location_of(x)
  nodes%y = location_of(y)
  nodes%z = location_of(z)
  nodes%stride = stride
  nodes%real_bits = real_bits
  status = riis_mesh_update_copy(c_handle_of(mesh), nodes)
end subroutine riisf_mesh_update_copy

!> Does the same.
subroutine riisf_mesh_update_copy_64(mesh, n_nodes, x, y, z, stride, real_bits, &
    status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_points, riis_status, RIIS_OK, riis_mesh_update_copy, riis_points_init
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: mesh                      !< Must be created.
  integer(int64), intent(in) :: n_nodes                   !< >= 0.
  type(*), intent(in) :: x(*)                             !< Node i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  type(*), intent(in) :: y(*)                             !< Node i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  type(*), intent(in) :: z(*)                             !< Node i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: real_bits                 !< 32 for REAL*4, 64 for REAL*8.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: nodes
  status = riis_points_init(nodes, c_sizeof(nodes))
  if (status /= RIIS_OK) return
  nodes%n_points = n_nodes
  nodes%x = location_of(x)
  nodes%y = location_of(y)
  nodes%z = location_of(z)
  nodes%stride = stride
  nodes%real_bits = real_bits
  status = riis_mesh_update_copy(c_handle_of(mesh), nodes)
end subroutine riisf_mesh_update_copy_64

!> Makes the clusters of RIIS_SEARCH_CLUSTERS now, not in the first marking that uses them.
subroutine riisf_mesh_prepare(mesh, n_threads, status)
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_mesh_prepare
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: mesh                      !< Must be created.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_mesh_prepare(c_handle_of(mesh), n_threads)
end subroutine riisf_mesh_prepare

!> Destroys the mesh, not the coordinates, and sets its handle to 0. Nothing happens to a handle that is 0.
subroutine riisf_mesh_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_mesh_destroy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_mesh_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_mesh_destroy

!> Gives the message of the calling thread's last error, truncated or padded with blanks.
subroutine riisf_last_error(text)
  use riis_c, only: riis_c_text, riis_last_error
  implicit none
  character(len=*), intent(out) :: text                   !< 512 characters are enough for every message.
  text = riis_c_text(riis_last_error())
end subroutine riisf_last_error

!> Gives a status's own name, such as 'RIIS_INVALID_ARGUMENT'.
subroutine riisf_status_name(status, text)
  use riis_c, only: riis_c_text, riis_status, riis_status_name
  implicit none
  integer(riis_status), intent(in) :: status              !< Any value.
  character(len=*), intent(out) :: text                   !< 24 characters are enough for every name.
  text = riis_c_text(riis_status_name(status))
end subroutine riisf_status_name

!> Gives the version of the linked library, such as '1.0.0'.
subroutine riisf_version(text)
  use riis_c, only: riis_c_text, riis_version_string
  implicit none
  character(len=*), intent(out) :: text                   !< 16 characters are enough for every version.
  text = riis_c_text(riis_version_string())
end subroutine riisf_version
