! SPDX-License-Identifier: Apache-2.0
! Written by fortran/bindings/generate.py from riis.h and from the files in that folder; run ./run bindings to repeat it.
!> riis for codes in the style of Fortran 77: external subroutines, for fixed and free form. With `use riisf` the compiler refuses
!! an argument of the wrong kind, such as REAL*4 where REAL*8 is due. Without it no compiler checks a call, and a wrong kind gives
!! wrong results or a crash. Codes that cannot use modules call the same subroutines. `include 'riisf.h'` gives the constants.
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
!! - Pass every argument, with exactly the kind that is declared here. `integer(int32)` is INTEGER*4,
!!   INTEGER with the usual options; `integer(int64)` is INTEGER*8; `real(c_double)` is DOUBLE PRECISION, or REAL*8 if an
!!   option (-fdefault-real-8) makes DOUBLE PRECISION longer.
!! - Handles are INTEGER*8, 0 before they are created and after they are destroyed. Creating sets them only on success.
!! - The last argument is the status: RIIS_OK (0), or an error, whose message riisf_last_error gives. After an error nothing
!!   has changed. Each thread has its own message. Messages count from 0.
!! - Names may have trailing blanks.
!! - Coordinates, and the rows for riisf_mesh_set_adjacency, are borrowed: they must stay in place (in COMMON, or with SAVE,
!!   or in the main program) until the mesh is destroyed or gets other arrays. All other arrays are used during the call only. No
!!   array is copied except the marks of riisf_dense_mark, the nodes of passages, listed points and labels of INTEGER*4.
!! - Nodes that the library gives count from 1. Anything called *_id counts from 0, as in C. Ids that the caller gives count
!!   from index_base.
!! - The comments are those of riis.h, which says more about each call.
!! - A subroutine whose name ends in _64 does the same as the one without _64, with counts and ids of INTEGER*8.
!! - Threads: any number of threads may read an object at once. One thread may write it while no other reads it.

! -----------------------------------------------------------------------------------------------------------------
! Valves and surfaces
! A placement is x -> scale * rotation * x + translation.
! -----------------------------------------------------------------------------------------------------------------

!> Makes a valve with the default parameter values. For 'aortic' and 'mitral' the defaults come from the paper.
subroutine riisf_valve_create(kind, valve, status)
  use, intrinsic :: iso_c_binding, only: c_char, c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: end_for_c, handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_valve_create
  implicit none
  character(len=*), intent(in) :: kind                    !< One of these names (docs/theory.md). Any other name gives
                                                          !! RIIS_INVALID_PARAMETER. - 'aortic' and 'mitral', the paper's three
                                                          !! cusps and two leaflets - 'coapting', 'bicuspid' and
                                                          !! 'quadricuspid', three, two and four cusps with a zone of
                                                          !! coaptation - 'tricuspid' and 'mitral_coapting', three and two
                                                          !! leaflets of an annulus, with a zone of coaptation - 'trileaflet',
                                                          !! three equal cusps that close in straight lines - 'bileaflet', a
                                                          !! mechanical prosthesis.
  integer(int64), intent(inout) :: valve                  !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(kind) + 1, kind=c_char) :: c_kind
  type(c_ptr) :: c_handle
  call end_for_c(kind, c_kind)
  c_handle = c_null_ptr
  status = riis_valve_create(c_kind, c_handle)
  if (status /= RIIS_OK) return
  valve = handle_of(c_handle)
end subroutine riisf_valve_create

!> Makes a copy of a valve, including its parameters, patches and open state. The caller destroys both valves.
subroutine riisf_valve_copy(valve, copy, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_valve_copy
  implicit none
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  integer(int64), intent(inout) :: copy                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_valve_copy(c_handle_of(valve), c_handle)
  if (status /= RIIS_OK) return
  copy = handle_of(c_handle)
end subroutine riisf_valve_copy

!> Sets a parameter by its name. This call checks only the range of the values; riisf_surface_create checks whether all
!! parameters fit together. Errors: RIIS_INVALID_PARAMETER for a bad name or value; the message names the parameter and the
!! value.
subroutine riisf_valve_set(valve, name, n_values, values, status)
  use, intrinsic :: iso_c_binding, only: c_char, c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, end_for_c
  use riis_c, only: riis_status, riis_valve_set
  implicit none
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  character(len=*), intent(in) :: name                    !< Such as 'root_radius'. A name such as 'right.leaflet_angle',
                                                          !! 'commissure_0.fusion' or 'bump_0.open' sets a parameter of one
                                                          !! part. The name 'leaflet_angle' without a part sets this parameter
                                                          !! for all parts. However, if the whole valve also has a parameter of
                                                          !! the name, only the whole valve's parameter is set.
  integer(int32), intent(in) :: n_values                  !< The number of values: 3 for translation (x, y, z), 3 for rotation,
                                                          !! t0_* and t3_* (right, left, non-coronary cusp), and 1 for all
                                                          !! other parameters.
  real(c_double), intent(in) :: values(*)                 !< (n_values): the values, within the parameter's range.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(name) + 1, kind=c_char) :: c_name
  call end_for_c(name, c_name)
  status = riis_valve_set(c_handle_of(valve), c_name, int(n_values, int64), values)
end subroutine riisf_valve_set

!> Copies the values of a parameter to the caller's array. Arguments are as in riisf_valve_set. Errors: RIIS_INVALID_PARAMETER
!! for an unknown name, and for a name that stands for a parameter of several cusps.
subroutine riisf_valve_get(valve, name, n_values, values, status)
  use, intrinsic :: iso_c_binding, only: c_char, c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, end_for_c
  use riis_c, only: riis_status, riis_valve_get
  implicit none
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  character(len=*), intent(in) :: name                    !< Such as 'root_radius'. A name such as 'right.leaflet_angle',
                                                          !! 'commissure_0.fusion' or 'bump_0.open' sets a parameter of one
                                                          !! part. The name 'leaflet_angle' without a part sets this parameter
                                                          !! for all parts. However, if the whole valve also has a parameter of
                                                          !! the name, only the whole valve's parameter is set.
  integer(int32), intent(in) :: n_values                  !< The number of values: 3 for translation (x, y, z), 3 for rotation,
                                                          !! t0_* and t3_* (right, left, non-coronary cusp), and 1 for all
                                                          !! other parameters.
  real(c_double), intent(inout) :: values(*)              !< (n_values): the values, within the parameter's range.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(name) + 1, kind=c_char) :: c_name
  call end_for_c(name, c_name)
  status = riis_valve_get(c_handle_of(valve), c_name, int(n_values, int64), values)
end subroutine riisf_valve_get

!> Undoes riisf_valve_set: the parameter gets the value of its rule again, or its default if it has no rule. Errors:
!! RIIS_INVALID_PARAMETER for an unknown name.
subroutine riisf_valve_unset(valve, name, status)
  use, intrinsic :: iso_c_binding, only: c_char
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, end_for_c
  use riis_c, only: riis_status, riis_valve_unset
  implicit none
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  character(len=*), intent(in) :: name                    !< As in riisf_valve_set.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(name) + 1, kind=c_char) :: c_name
  call end_for_c(name, c_name)
  status = riis_valve_unset(c_handle_of(valve), c_name)
end subroutine riisf_valve_unset

!> Tells whether a parameter was set. Errors: RIIS_INVALID_PARAMETER for an unknown name, and for a name that stands for a
!! parameter of several cusps.
subroutine riisf_valve_is_set(valve, name, is_set, status)
  use, intrinsic :: iso_c_binding, only: c_char
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, end_for_c
  use riis_c, only: riis_status, riis_valve_is_set
  implicit none
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  character(len=*), intent(in) :: name                    !< As in riisf_valve_get.
  integer(int32), intent(inout) :: is_set                 !< 1 if the parameter was set; 0 if its value is the default or comes
                                                          !! from its rule.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(name) + 1, kind=c_char) :: c_name
  call end_for_c(name, c_name)
  status = riis_valve_is_set(c_handle_of(valve), c_name, is_set)
end subroutine riisf_valve_is_set

!> Gives a valve an open state. The valve then has its own shape at opening 0, and the shape of the valve `open` at opening 1.
!! Errors: RIIS_INVALID_PARAMETER if `open` has another kind, or other curves, degrees or sides.
subroutine riisf_valve_set_open_state(valve, open, status)
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: riis_status, riis_valve_set_open_state
  implicit none
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  integer(int64), intent(in) :: open                      !< A valve of the same kind, which is copied. The opening, leaflet
                                                          !! ids and open state of `open` are ignored. If the valves come from
                                                          !! patches, `open` must have the same curves, sides and degrees
                                                          !! (degree 1 may stand for degree 2). Two bileaflet valves must both
                                                          !! have a ring, or both lack it.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_valve_set_open_state(c_handle_of(valve), c_handle_of(open))
end subroutine riisf_valve_set_open_state

!> Destroys the valve. Surfaces that were made from the valve do not change. Valves with this valve as their open state do not
!! change either. The handle becomes 0. Nothing happens to a handle that is 0.
subroutine riisf_valve_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: riis_valve_destroy
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_valve_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_valve_destroy

!> Makes the surface of a valve from curves, by way of polylines, Coons patches, quads and triangles (paper, 3 and 4.1;
!! docs/theory.md). Errors: RIIS_INVALID_PARAMETER for parameters that do not fit together or that put a curve out of range.
!! RIIS_INVALID_SURFACE if two neighbouring triangles have opposite windings in a surface with an offset. RIIS_LIMIT_EXCEEDED if
!! a tolerance needs more than 16,777,216 triangles, quads or samples, or is smaller than the rounding error of coordinates.
subroutine riisf_surface_create(valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
    surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_create, riis_surface_options, riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: valve                     !< A valve whose parameters fit together.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  c_handle = c_null_ptr
  status = riis_surface_create(c_handle_of(valve), options, c_handle)
  if (status /= RIIS_OK) return
  surface = handle_of(c_handle)
end subroutine riisf_surface_create

!> Replaces the surface by the surface of a valve that moved, with the same options. Errors: as riisf_surface_create.
subroutine riisf_surface_update(surface, valve, status)
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: riis_status, riis_surface_update
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_surface_update(c_handle_of(surface), c_handle_of(valve))
end subroutine riisf_surface_update

!> Replaces the surface like riisf_surface_update, but with other options, which are those of riisf_surface_create. Errors: as
!! riisf_surface_create.
subroutine riisf_surface_place(surface, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
    translation, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_options, riis_surface_options_init, riis_surface_update
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  status = riis_surface_update(c_handle_of(surface), c_handle_of(valve), options)
end subroutine riisf_surface_place

!> Replaces the surface like riisf_surface_place, and sets the method of measuring distances. riisf_surface_update keeps this
!! method. Errors: as riisf_surface_create.
subroutine riisf_surface_measure(surface, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
    translation, measure, measure_tolerance, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_options, riis_surface_options_init, riis_surface_update
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int32), intent(in) :: measure                   !< RIIS_MEASURE_*, for closest points and marking only. Usually
                                                          !! RIIS_MEASURE_TRIANGLES; surfaces from arrays accept only this
                                                          !! value.
  real(c_double), intent(in) :: measure_tolerance         !< A fraction of half_thickness, 1e-6 to 1; RIIS_AUTO: tolerance. Not
                                                          !! used by RIIS_MEASURE_TRIANGLES.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  options%measure = measure
  options%measure_tolerance = measure_tolerance
  status = riis_surface_update(c_handle_of(surface), c_handle_of(valve), options)
end subroutine riisf_surface_measure

!> Replaces the surface like riisf_surface_place, and sets the kind of triangulation, which later updates keep. Errors: as
!! riisf_surface_create.
subroutine riisf_surface_triangulate(surface, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
    translation, triangulation, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_options, riis_surface_options_init, riis_surface_update
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int32), intent(in) :: triangulation             !< RIIS_TRIANGULATION_*, usually RIIS_TRIANGULATION_ADAPTED.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  options%triangulation = triangulation
  status = riis_surface_update(c_handle_of(surface), c_handle_of(valve), options)
end subroutine riisf_surface_triangulate

!> Replaces the surface like riisf_surface_place, with a band that steps aside along the normals, by `offset` half thicknesses.
!! riisf_surface_update and riisf_surface_update_moving keep the offset. The other calls that place the surface set it to 0.
!! Errors: as riisf_surface_create.
subroutine riisf_surface_offset(surface, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
    translation, offset, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_options, riis_surface_options_init, riis_surface_update
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  real(c_double), intent(in) :: offset                    !< The offset o, in half thicknesses, above -1 and below 1, usually
                                                          !! 0. The middle of the band is the surface moved by o half
                                                          !! thicknesses along its normals (after flip_normals).
                                                          !! RIIS_MEASURE_SAMPLING and RIIS_MEASURE_MINIMIZATION need the
                                                          !! offset 0.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  options%offset = offset
  status = riis_surface_update(c_handle_of(surface), c_handle_of(valve), options)
end subroutine riisf_surface_offset

!> Replaces the content of a surface by the surface of a valve, and gives every vertex a velocity. The triangles are bitwise the
!! same as those of riisf_surface_update. For a valve at rest, pass the same valve as valve_before. Errors: as
!! riisf_surface_update. RIIS_INVALID_PARAMETER if valve_before differs from `valve` in kind or patches, or if its parameters do
!! not fit together.
subroutine riisf_surface_update_moving(surface, valve, valve_before, dt, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: riis_status, riis_surface_update_moving
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  integer(int64), intent(in) :: valve_before              !< The valve in its earlier state, of the same kind. Valves from
                                                          !! patches must have the same curves and sides.
  real(c_double), intent(in) :: dt                        !< The time from valve_before to valve, 1e-30 to 1e30, or -1e30 to
                                                          !! -1e-30 if time runs backwards.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_surface_update_moving(c_handle_of(surface), c_handle_of(valve), c_handle_of(valve_before), dt)
end subroutine riisf_surface_update_moving

!> Replaces the surface like riisf_surface_update_moving, but with another placement, now and before. Errors: as
!! riisf_surface_update. RIIS_INVALID_PARAMETER if valve_before differs from `valve` in kind or patches, or if its parameters do
!! not fit together.
subroutine riisf_surface_place_moving(surface, valve, valve_before, dt, half_thickness, tolerance, scale, &
    rotation_axis, rotation_angle, translation, scale_before, rotation_axis_before, rotation_angle_before, &
    translation_before, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_options, riis_surface_options_init, riis_surface_update_moving
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  integer(int64), intent(in) :: valve_before              !< The valve in its earlier state, of the same kind. Valves from
                                                          !! patches must have the same curves and sides.
  real(c_double), intent(in) :: dt                        !< The time from valve_before to valve, 1e-30 to 1e30, or -1e30 to
                                                          !! -1e-30 if time runs backwards.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  real(c_double), intent(in) :: scale_before              !< The placement of the earlier state.
  real(c_double), intent(in) :: rotation_axis_before(3)   !< The placement of the earlier state.
  real(c_double), intent(in) :: rotation_angle_before     !< The placement of the earlier state.
  real(c_double), intent(in) :: translation_before(3)     !< The placement of the earlier state.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  type(riis_surface_options) :: options_before
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_surface_options_init(options_before, c_sizeof(options_before))
  if (status /= RIIS_OK) return
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  options_before%scale = scale_before
  options_before%rotation_axis = rotation_axis_before
  options_before%rotation_angle = rotation_angle_before
  options_before%translation = translation_before
  options_before%half_thickness = half_thickness
  options_before%tolerance = tolerance
  status = riis_surface_update_moving(c_handle_of(surface), c_handle_of(valve), c_handle_of(valve_before), dt, &
      options, options_before)
end subroutine riisf_surface_place_moving

!> Adds a direction in which the surface of a valve can change. A direction belongs to one number: a parameter, a coordinate of a
!! landmark or a number of the placement. Below, this number is called the parameter. Errors: RIIS_INVALID_ARGUMENT for a surface
!! from arrays, and for a dp out of range. RIIS_INVALID_PARAMETER if the kind or the patches of a state differ from those of the
!! surface, and if the parameters of a state do not fit together. RIIS_LIMIT_EXCEEDED for more than 1000 directions.
subroutine riisf_surface_add_direction(surface, valve_after, valve_before, dp, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: riis_status, riis_surface_add_direction
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: valve_after               !< Two copies of the surface's valve. In valve_after the parameter is
                                                          !! a little larger than in the surface's valve, and in valve_before a
                                                          !! little smaller. If only the placement changes, pass the same valve
                                                          !! twice.
  integer(int64), intent(in) :: valve_before              !< Two copies of the surface's valve. In valve_after the parameter is
                                                          !! a little larger than in the surface's valve, and in valve_before a
                                                          !! little smaller. If only the placement changes, pass the same valve
                                                          !! twice.
  real(c_double), intent(in) :: dp                        !< The value of the parameter in valve_after minus its value in
                                                          !! valve_before, 1e-30 to 1e30 in magnitude.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_surface_add_direction(c_handle_of(surface), c_handle_of(valve_after), c_handle_of(valve_before), dp)
end subroutine riisf_surface_add_direction

!> Adds a direction like riisf_surface_add_direction, in which the placement also changes. Errors: RIIS_INVALID_ARGUMENT for a
!! surface from arrays, and for a dp out of range. RIIS_INVALID_PARAMETER if the kind or the patches of a state differ from those
!! of the surface, and if the parameters of a state do not fit together. RIIS_LIMIT_EXCEEDED for more than 1000 directions.
subroutine riisf_surface_add_placed(surface, valve_after, valve_before, dp, scale_after, rotation_axis_after, &
    rotation_angle_after, translation_after, scale_before, rotation_axis_before, rotation_angle_before, &
    translation_before, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_add_direction, riis_surface_options, riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: valve_after               !< Two copies of the surface's valve. In valve_after the parameter is
                                                          !! a little larger than in the surface's valve, and in valve_before a
                                                          !! little smaller. If only the placement changes, pass the same valve
                                                          !! twice.
  integer(int64), intent(in) :: valve_before              !< Two copies of the surface's valve. In valve_after the parameter is
                                                          !! a little larger than in the surface's valve, and in valve_before a
                                                          !! little smaller. If only the placement changes, pass the same valve
                                                          !! twice.
  real(c_double), intent(in) :: dp                        !< The value of the parameter in valve_after minus its value in
                                                          !! valve_before, 1e-30 to 1e30 in magnitude.
  real(c_double), intent(in) :: scale_after               !< The placement of the later state.
  real(c_double), intent(in) :: rotation_axis_after(3)    !< The placement of the later state.
  real(c_double), intent(in) :: rotation_angle_after      !< The placement of the later state.
  real(c_double), intent(in) :: translation_after(3)      !< The placement of the later state.
  real(c_double), intent(in) :: scale_before              !< The placement of the earlier state.
  real(c_double), intent(in) :: rotation_axis_before(3)   !< The placement of the earlier state.
  real(c_double), intent(in) :: rotation_angle_before     !< The placement of the earlier state.
  real(c_double), intent(in) :: translation_before(3)     !< The placement of the earlier state.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options_after
  type(riis_surface_options) :: options_before
  status = riis_surface_options_init(options_after, c_sizeof(options_after))
  if (status == RIIS_OK) status = riis_surface_options_init(options_before, c_sizeof(options_before))
  if (status /= RIIS_OK) return
  options_after%scale = scale_after
  options_after%rotation_axis = rotation_axis_after
  options_after%rotation_angle = rotation_angle_after
  options_after%translation = translation_after
  options_before%scale = scale_before
  options_before%rotation_axis = rotation_axis_before
  options_before%rotation_angle = rotation_angle_before
  options_before%translation = translation_before
  status = riis_surface_add_direction(c_handle_of(surface), c_handle_of(valve_after), c_handle_of(valve_before), dp, &
      options_after, options_before)
end subroutine riisf_surface_add_placed

!> Destroys the surface. Marks of the surface stay valid. The handle becomes 0. Nothing happens to a handle that is 0.
subroutine riisf_surface_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: riis_surface_destroy
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_surface_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_surface_destroy

! -----------------------------------------------------------------------------------------------------------------
! Meshes
! -----------------------------------------------------------------------------------------------------------------

!> Makes a mesh that borrows the coordinates of its nodes, and checks them once. The coordinates must stay in place until the
!! mesh is updated or destroyed. With MPI, a process without nodes must also make a mesh, with n_nodes 0. Errors:
!! RIIS_INVALID_MESH for a bad coordinate; the message names the node and the value. RIIS_LIMIT_EXCEEDED for too many nodes.
subroutine riisf_mesh_create(n_nodes, x, y, z, stride, mesh, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_mesh_create, riis_status
  implicit none
  integer(int32), intent(in) :: n_nodes                   !< 0 to 2^40.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int64), intent(inout) :: mesh                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_mesh_create(int(n_nodes, int64), location_of(x), location_of(y), location_of(z), int(stride, int64), &
      c_handle)
  if (status /= RIIS_OK) return
  mesh = handle_of(c_handle)
end subroutine riisf_mesh_create

!> Does the same as riisf_mesh_create, with counts and ids of INTEGER*8.
subroutine riisf_mesh_create_64(n_nodes, x, y, z, stride, mesh, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_mesh_create, riis_status
  implicit none
  integer(int64), intent(in) :: n_nodes                   !< 0 to 2^40.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int64), intent(inout) :: mesh                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_mesh_create(n_nodes, location_of(x), location_of(y), location_of(z), stride, c_handle)
  if (status /= RIIS_OK) return
  mesh = handle_of(c_handle)
end subroutine riisf_mesh_create_64

!> Tells the mesh that coordinates have changed or are now in other arrays, and checks them again. Call this function after every
!! change of coordinates. If n_nodes is the same, the mesh keeps its adjacency. For a different mesh, make a new handle.
!! Arguments and errors are as in riisf_mesh_create.
subroutine riisf_mesh_update(mesh, n_nodes, x, y, z, stride, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: riis_mesh_update, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_mesh_update(c_handle_of(mesh), int(n_nodes, int64), location_of(x), location_of(y), location_of(z), &
      int(stride, int64))
end subroutine riisf_mesh_update

!> Does the same as riisf_mesh_update, with counts and ids of INTEGER*8.
subroutine riisf_mesh_update_64(mesh, n_nodes, x, y, z, stride, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: riis_mesh_update, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_mesh_update(c_handle_of(mesh), n_nodes, location_of(x), location_of(y), location_of(z), stride)
end subroutine riisf_mesh_update_64

!> Makes a mesh with copies of the coordinates of its nodes, and checks them. Use this call for a temporary array of Fortran, or
!! for coordinates in single precision, which become doubles without rounding. The copies take 24 bytes per node. Errors: as
!! riisf_mesh_create.
subroutine riisf_mesh_create_copy(n_nodes, x, y, z, stride, real_bits, mesh, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_mesh_create_copy, riis_points, riis_points_init, riis_status
  implicit none
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  type(*), intent(in) :: x(*)                             !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  type(*), intent(in) :: y(*)                             !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  type(*), intent(in) :: z(*)                             !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: real_bits                 !< 32 for REAL*4, 64 for REAL*8.
  integer(int64), intent(inout) :: mesh                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: nodes
  type(c_ptr) :: c_handle
  status = riis_points_init(nodes, c_sizeof(nodes))
  if (status /= RIIS_OK) return
  nodes%n_points = n_nodes
  nodes%x = location_of(x)
  nodes%y = location_of(y)
  nodes%z = location_of(z)
  nodes%stride = stride
  nodes%real_bits = real_bits
  c_handle = c_null_ptr
  status = riis_mesh_create_copy(nodes, c_handle)
  if (status /= RIIS_OK) return
  mesh = handle_of(c_handle)
end subroutine riisf_mesh_create_copy

!> Does the same as riisf_mesh_create_copy, with counts and ids of INTEGER*8.
subroutine riisf_mesh_create_copy_64(n_nodes, x, y, z, stride, real_bits, mesh, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_mesh_create_copy, riis_points, riis_points_init, riis_status
  implicit none
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  type(*), intent(in) :: x(*)                             !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  type(*), intent(in) :: y(*)                             !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  type(*), intent(in) :: z(*)                             !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: real_bits                 !< 32 for REAL*4, 64 for REAL*8.
  integer(int64), intent(inout) :: mesh                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: nodes
  type(c_ptr) :: c_handle
  status = riis_points_init(nodes, c_sizeof(nodes))
  if (status /= RIIS_OK) return
  nodes%n_points = n_nodes
  nodes%x = location_of(x)
  nodes%y = location_of(y)
  nodes%z = location_of(z)
  nodes%stride = stride
  nodes%real_bits = real_bits
  c_handle = c_null_ptr
  status = riis_mesh_create_copy(nodes, c_handle)
  if (status /= RIIS_OK) return
  mesh = handle_of(c_handle)
end subroutine riisf_mesh_create_copy_64

!> Does the same as riisf_mesh_update, but copies the coordinates. A mesh may change from borrowed coordinates to copies, and
!! back.
subroutine riisf_mesh_update_copy(mesh, n_nodes, x, y, z, stride, real_bits, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_mesh_update_copy, riis_points, riis_points_init, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  type(*), intent(in) :: x(*)                             !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  type(*), intent(in) :: y(*)                             !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  type(*), intent(in) :: z(*)                             !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
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

!> Does the same as riisf_mesh_update_copy, with counts and ids of INTEGER*8.
subroutine riisf_mesh_update_copy_64(mesh, n_nodes, x, y, z, stride, real_bits, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_mesh_update_copy, riis_points, riis_points_init, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  type(*), intent(in) :: x(*)                             !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  type(*), intent(in) :: y(*)                             !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  type(*), intent(in) :: z(*)                             !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
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

!> Makes a mesh from the axes of a rectilinear grid, and stores nothing for each node. Node (i, j, k) is at X(i), Y(j), Z(k). Its
!! number is first_num + (i - 1) stride_i + (j - 1) stride_j + (k - 1) stride_k. An array K(0:NI+1, 0:NJ+1, 0:NK+1) has the
!! strides 1, NI+2 and (NI+2)(NJ+2), its first node is 1 plus their sum, and n_nodes is its length. Errors: RIIS_INVALID_MESH for
!! a bad axis; the message names the axis, the index and the value. RIIS_LIMIT_EXCEEDED if a node has a number of 2^40 or more.
subroutine riisf_mesh_create_grid(ni, nj, nk, x, y, z, real_bits, first_num, stride_i, stride_j, stride_k, n_nodes, &
    mesh, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_grid, riis_grid_init, riis_mesh_create_grid, riis_status
  implicit none
  integer(int32), intent(in) :: ni                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  integer(int32), intent(in) :: nj                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  integer(int32), intent(in) :: nk                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  type(*), intent(in) :: x(*)                             !< (ni), strictly ascending; copied.
  type(*), intent(in) :: y(*)                             !< (nj).
  type(*), intent(in) :: z(*)                             !< (nk).
  integer(int32), intent(in) :: real_bits                 !< 32 for REAL*4, 64 for REAL*8.
  integer(int32), intent(in) :: first_num                 !< The number of node (1, 1, 1), counted from 1.
  integer(int32), intent(in) :: stride_i                  !< From a node to the next along x; three times 0 stands for 1, ni
                                                          !! and ni * nj.
  integer(int32), intent(in) :: stride_j                  !< Along y.
  integer(int32), intent(in) :: stride_k                  !< Along z.
  integer(int32), intent(in) :: n_nodes                   !< The length of the caller's arrays; 0 for the least length.
  integer(int64), intent(inout) :: mesh                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_grid) :: grid
  type(c_ptr) :: c_handle
  status = riis_grid_init(grid, c_sizeof(grid))
  if (status /= RIIS_OK) return
  grid%ni = ni
  grid%nj = nj
  grid%nk = nk
  grid%x = location_of(x)
  grid%y = location_of(y)
  grid%z = location_of(z)
  grid%real_bits = real_bits
  grid%first = first_num - 1
  grid%stride(1) = stride_i
  grid%stride(2) = stride_j
  grid%stride(3) = stride_k
  grid%n_nodes = n_nodes
  c_handle = c_null_ptr
  status = riis_mesh_create_grid(grid, c_handle)
  if (status /= RIIS_OK) return
  mesh = handle_of(c_handle)
end subroutine riisf_mesh_create_grid

!> Does the same as riisf_mesh_create_grid, with counts and ids of INTEGER*8.
subroutine riisf_mesh_create_grid_64(ni, nj, nk, x, y, z, real_bits, first_num, stride_i, stride_j, stride_k, n_nodes, &
    mesh, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_grid, riis_grid_init, riis_mesh_create_grid, riis_status
  implicit none
  integer(int64), intent(in) :: ni                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  integer(int64), intent(in) :: nj                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  integer(int64), intent(in) :: nk                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  type(*), intent(in) :: x(*)                             !< (ni), strictly ascending; copied.
  type(*), intent(in) :: y(*)                             !< (nj).
  type(*), intent(in) :: z(*)                             !< (nk).
  integer(int32), intent(in) :: real_bits                 !< 32 for REAL*4, 64 for REAL*8.
  integer(int64), intent(in) :: first_num                 !< The number of node (1, 1, 1), counted from 1.
  integer(int64), intent(in) :: stride_i                  !< From a node to the next along x; three times 0 stands for 1, ni
                                                          !! and ni * nj.
  integer(int64), intent(in) :: stride_j                  !< Along y.
  integer(int64), intent(in) :: stride_k                  !< Along z.
  integer(int64), intent(in) :: n_nodes                   !< The length of the caller's arrays; 0 for the least length.
  integer(int64), intent(inout) :: mesh                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_grid) :: grid
  type(c_ptr) :: c_handle
  status = riis_grid_init(grid, c_sizeof(grid))
  if (status /= RIIS_OK) return
  grid%ni = ni
  grid%nj = nj
  grid%nk = nk
  grid%x = location_of(x)
  grid%y = location_of(y)
  grid%z = location_of(z)
  grid%real_bits = real_bits
  grid%first = first_num - 1
  grid%stride(1) = stride_i
  grid%stride(2) = stride_j
  grid%stride(3) = stride_k
  grid%n_nodes = n_nodes
  c_handle = c_null_ptr
  status = riis_mesh_create_grid(grid, c_handle)
  if (status /= RIIS_OK) return
  mesh = handle_of(c_handle)
end subroutine riisf_mesh_create_grid_64

!> Gives a mesh the axes of a grid, in place of its axes or points. riisf_mesh_update makes such a mesh a mesh of points again.
!! Errors: as riisf_mesh_create_grid. After an error the mesh keeps its nodes.
subroutine riisf_mesh_update_grid(mesh, ni, nj, nk, x, y, z, real_bits, first_num, stride_i, stride_j, stride_k, &
    n_nodes, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_grid, riis_grid_init, riis_mesh_update_grid, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(int32), intent(in) :: ni                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  integer(int32), intent(in) :: nj                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  integer(int32), intent(in) :: nk                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  type(*), intent(in) :: x(*)                             !< (ni), strictly ascending; copied.
  type(*), intent(in) :: y(*)                             !< (nj).
  type(*), intent(in) :: z(*)                             !< (nk).
  integer(int32), intent(in) :: real_bits                 !< 32 for REAL*4, 64 for REAL*8.
  integer(int32), intent(in) :: first_num                 !< The number of node (1, 1, 1), counted from 1.
  integer(int32), intent(in) :: stride_i                  !< From a node to the next along x; three times 0 stands for 1, ni
                                                          !! and ni * nj.
  integer(int32), intent(in) :: stride_j                  !< Along y.
  integer(int32), intent(in) :: stride_k                  !< Along z.
  integer(int32), intent(in) :: n_nodes                   !< The length of the caller's arrays; 0 for the least length.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_grid) :: grid
  status = riis_grid_init(grid, c_sizeof(grid))
  if (status /= RIIS_OK) return
  grid%ni = ni
  grid%nj = nj
  grid%nk = nk
  grid%x = location_of(x)
  grid%y = location_of(y)
  grid%z = location_of(z)
  grid%real_bits = real_bits
  grid%first = first_num - 1
  grid%stride(1) = stride_i
  grid%stride(2) = stride_j
  grid%stride(3) = stride_k
  grid%n_nodes = n_nodes
  status = riis_mesh_update_grid(c_handle_of(mesh), grid)
end subroutine riisf_mesh_update_grid

!> Does the same as riisf_mesh_update_grid, with counts and ids of INTEGER*8.
subroutine riisf_mesh_update_grid_64(mesh, ni, nj, nk, x, y, z, real_bits, first_num, stride_i, stride_j, stride_k, &
    n_nodes, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_grid, riis_grid_init, riis_mesh_update_grid, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(int64), intent(in) :: ni                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  integer(int64), intent(in) :: nj                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  integer(int64), intent(in) :: nk                        !< ni, nj, nk: the numbers of nodes along the three axes, each >= 1.
  type(*), intent(in) :: x(*)                             !< (ni), strictly ascending; copied.
  type(*), intent(in) :: y(*)                             !< (nj).
  type(*), intent(in) :: z(*)                             !< (nk).
  integer(int32), intent(in) :: real_bits                 !< 32 for REAL*4, 64 for REAL*8.
  integer(int64), intent(in) :: first_num                 !< The number of node (1, 1, 1), counted from 1.
  integer(int64), intent(in) :: stride_i                  !< From a node to the next along x; three times 0 stands for 1, ni
                                                          !! and ni * nj.
  integer(int64), intent(in) :: stride_j                  !< Along y.
  integer(int64), intent(in) :: stride_k                  !< Along z.
  integer(int64), intent(in) :: n_nodes                   !< The length of the caller's arrays; 0 for the least length.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_grid) :: grid
  status = riis_grid_init(grid, c_sizeof(grid))
  if (status /= RIIS_OK) return
  grid%ni = ni
  grid%nj = nj
  grid%nk = nk
  grid%x = location_of(x)
  grid%y = location_of(y)
  grid%z = location_of(z)
  grid%real_bits = real_bits
  grid%first = first_num - 1
  grid%stride(1) = stride_i
  grid%stride(2) = stride_j
  grid%stride(3) = stride_k
  grid%n_nodes = n_nodes
  status = riis_mesh_update_grid(c_handle_of(mesh), grid)
end subroutine riisf_mesh_update_grid_64

!> Makes the clusters for RIIS_SEARCH_CLUSTERS in advance, so that no marking has to make them. The clusters contain a copy of
!! the coordinates, so they take 41 bytes per node until the mesh is destroyed. While the call makes the clusters, it needs 32
!! more bytes per node. For a grid, the call stores nothing per node. Errors: RIIS_LIMIT_EXCEEDED for 2^32 nodes or more.
!! RIIS_INVALID_MESH as riisf_mark_nodes.
subroutine riisf_mesh_prepare(mesh, n_threads, status)
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: riis_mesh_prepare, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_mesh_prepare(c_handle_of(mesh), n_threads)
end subroutine riisf_mesh_prepare

!> Destroys the handle. The caller's coordinates and all marks stay. The handle becomes 0. Nothing happens to a handle that is 0.
subroutine riisf_mesh_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: riis_mesh_destroy
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_mesh_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_mesh_destroy

! -----------------------------------------------------------------------------------------------------------------
! Errors and version
! -----------------------------------------------------------------------------------------------------------------

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

! -----------------------------------------------------------------------------------------------------------------
! Adjacencies
! -----------------------------------------------------------------------------------------------------------------

!> Gives the mesh an adjacency, and checks the adjacency once. The adjacency is the edges along which the neighbour search walks.
!! Errors: RIIS_INVALID_MESH for a bad row; the message names the row and its value.
subroutine riisf_mesh_set_adjacency(mesh, n_rows, offsets, columns, index_base, n_all, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_csr, riis_csr_init, riis_mesh_set_adjacency, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(int32), intent(in) :: n_rows                    !< The mesh's n_nodes.
  integer(int32), intent(in) :: offsets(*)                !< (n_rows + 1), ascending; the first offset is index_base, and a row
                                                          !! may be empty.
  integer(int32), intent(in) :: columns(*)                !< (offsets(n_rows + 1) - index_base), borrowed like offsets. If
                                                          !! index_base is 1, the neighbours of node i are columns(offsets(i))
                                                          !! to columns(offsets(i + 1) - 1).
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int32), intent(in) :: n_all                     !< The number of nodes including ghosts, which are nodes of other
                                                          !! ranks; at least n_rows. Every column is below this number. Columns
                                                          !! from n_rows on are ghosts, and are ignored. The default 0 stands
                                                          !! for n_rows.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_csr) :: csr
  status = riis_csr_init(csr, c_sizeof(csr))
  if (status /= RIIS_OK) return
  csr%n_rows = n_rows
  csr%offsets = location_of(offsets)
  csr%columns = location_of(columns)
  csr%index_base = index_base
  csr%n_all = n_all
  csr%offset_bits = storage_size(offsets)
  csr%column_bits = storage_size(columns)
  status = riis_mesh_set_adjacency(c_handle_of(mesh), csr)
end subroutine riisf_mesh_set_adjacency

!> Does the same as riisf_mesh_set_adjacency, with counts and ids of INTEGER*8.
subroutine riisf_mesh_set_adjacency_64(mesh, n_rows, offsets, columns, index_base, n_all, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_csr, riis_csr_init, riis_mesh_set_adjacency, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(int64), intent(in) :: n_rows                    !< The mesh's n_nodes.
  integer(int64), intent(in) :: offsets(*)                !< (n_rows + 1), ascending; the first offset is index_base, and a row
                                                          !! may be empty.
  integer(int64), intent(in) :: columns(*)                !< (offsets(n_rows + 1) - index_base), borrowed like offsets. If
                                                          !! index_base is 1, the neighbours of node i are columns(offsets(i))
                                                          !! to columns(offsets(i + 1) - 1).
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int64), intent(in) :: n_all                     !< The number of nodes including ghosts, which are nodes of other
                                                          !! ranks; at least n_rows. Every column is below this number. Columns
                                                          !! from n_rows on are ghosts, and are ignored. The default 0 stands
                                                          !! for n_rows.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_csr) :: csr
  status = riis_csr_init(csr, c_sizeof(csr))
  if (status /= RIIS_OK) return
  csr%n_rows = n_rows
  csr%offsets = location_of(offsets)
  csr%columns = location_of(columns)
  csr%index_base = index_base
  csr%n_all = n_all
  csr%offset_bits = storage_size(offsets)
  csr%column_bits = storage_size(columns)
  status = riis_mesh_set_adjacency(c_handle_of(mesh), csr)
end subroutine riisf_mesh_set_adjacency_64

!> Gives the mesh the rows of an adjacency that the library made. The adjacency must live until the mesh is destroyed or gets
!! another adjacency.
subroutine riisf_mesh_use_adjacency(mesh, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_adjacency_get_csr, riis_csr, riis_mesh_set_adjacency, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(int64), intent(in) :: adjacency                 !< Must be created. Destroy it after the mesh.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_csr) :: csr
  status = riis_adjacency_get_csr(c_handle_of(adjacency), csr, c_sizeof(csr))
  if (status == RIIS_OK) status = riis_mesh_set_adjacency(c_handle_of(mesh), csr)
end subroutine riisf_mesh_use_adjacency

!> Removes the mesh's adjacency. Its rows are not borrowed any more. Errors: none for a created mesh.
subroutine riisf_mesh_clear_adjacency(mesh, status)
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: riis_mesh_set_adjacency, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_mesh_set_adjacency(c_handle_of(mesh))
end subroutine riisf_mesh_clear_adjacency

!> Makes an adjacency of nodes from cells. Two nodes are neighbours if an edge of a cell joins them. Errors: RIIS_INVALID_MESH
!! for a bad cell; the message names the cell and its value.
subroutine riisf_adjacency_from_cells(n_nodes, nodes_per_cell, n_cells, cells, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_adjacency_create_from_cells, riis_mesh_cells, riis_mesh_cells_init, riis_status
  implicit none
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  integer(int32), intent(in) :: nodes_per_cell            !< 4 tetrahedron, 5 pyramid, 6 prism, 8 hexahedron.
  integer(int32), intent(in) :: n_cells                   !< >= 0.
  integer(int32), intent(in) :: cells(*)                  !< (nodes_per_cell, n_cells): the nodes of all cells, cell after
                                                          !! cell.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_cells) :: the_cells
  type(c_ptr) :: c_handle
  status = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
  if (status /= RIIS_OK) return
  the_cells%n_nodes = n_nodes
  the_cells%nodes_per_cell = nodes_per_cell
  the_cells%n_cells = n_cells
  the_cells%node_ids = location_of(cells)
  the_cells%index_base = index_base
  the_cells%n_threads = n_threads
  the_cells%id_bits = storage_size(cells)
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_cells(the_cells, c_handle)
  if (status /= RIIS_OK) return
  adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_cells

!> Does the same as riisf_adjacency_from_cells, with counts and ids of INTEGER*8.
subroutine riisf_adjacency_from_cells_64(n_nodes, nodes_per_cell, n_cells, cells, index_base, n_threads, adjacency, &
    status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_adjacency_create_from_cells, riis_mesh_cells, riis_mesh_cells_init, riis_status
  implicit none
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  integer(int32), intent(in) :: nodes_per_cell            !< 4 tetrahedron, 5 pyramid, 6 prism, 8 hexahedron.
  integer(int64), intent(in) :: n_cells                   !< >= 0.
  integer(int64), intent(in) :: cells(*)                  !< (nodes_per_cell, n_cells): the nodes of all cells, cell after
                                                          !! cell.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_cells) :: the_cells
  type(c_ptr) :: c_handle
  status = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
  if (status /= RIIS_OK) return
  the_cells%n_nodes = n_nodes
  the_cells%nodes_per_cell = nodes_per_cell
  the_cells%n_cells = n_cells
  the_cells%node_ids = location_of(cells)
  the_cells%index_base = index_base
  the_cells%n_threads = n_threads
  the_cells%id_bits = storage_size(cells)
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_cells(the_cells, c_handle)
  if (status /= RIIS_OK) return
  adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_cells_64

!> Makes an adjacency from cells of several shapes. If offsets begins with 1, the nodes of cell i are node_ids(offsets(i)) to
!! node_ids(offsets(i + 1) - 1). Errors: RIIS_INVALID_MESH for a bad cell; the message names the cell and its value.
subroutine riisf_adjacency_from_mixed(n_nodes, n_cells, node_ids, offsets, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_adjacency_create_from_cells, riis_mesh_cells, riis_mesh_cells_init, riis_status
  implicit none
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  integer(int32), intent(in) :: n_cells                   !< >= 0.
  integer(int32), intent(in) :: node_ids(*)               !< (nodes_per_cell, n_cells): the nodes of all cells, cell after
                                                          !! cell.
  integer(int32), intent(in) :: offsets(*)                !< (n_cells + 1): the position in node_ids at which each cell begins,
                                                          !! then the end of the last cell; ascending from 0 or from
                                                          !! index_base.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_cells) :: cells
  type(c_ptr) :: c_handle
  status = riis_mesh_cells_init(cells, c_sizeof(cells))
  if (status /= RIIS_OK) return
  cells%n_nodes = n_nodes
  cells%n_cells = n_cells
  cells%node_ids = location_of(node_ids)
  cells%offsets = location_of(offsets)
  cells%index_base = index_base
  cells%n_threads = n_threads
  cells%id_bits = storage_size(node_ids)
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_cells(cells, c_handle)
  if (status /= RIIS_OK) return
  adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_mixed

!> Does the same as riisf_adjacency_from_mixed, with counts and ids of INTEGER*8.
subroutine riisf_adjacency_from_mixed_64(n_nodes, n_cells, node_ids, offsets, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_adjacency_create_from_cells, riis_mesh_cells, riis_mesh_cells_init, riis_status
  implicit none
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  integer(int64), intent(in) :: n_cells                   !< >= 0.
  integer(int64), intent(in) :: node_ids(*)               !< (nodes_per_cell, n_cells): the nodes of all cells, cell after
                                                          !! cell.
  integer(int64), intent(in) :: offsets(*)                !< (n_cells + 1): the position in node_ids at which each cell begins,
                                                          !! then the end of the last cell; ascending from 0 or from
                                                          !! index_base.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_cells) :: cells
  type(c_ptr) :: c_handle
  status = riis_mesh_cells_init(cells, c_sizeof(cells))
  if (status /= RIIS_OK) return
  cells%n_nodes = n_nodes
  cells%n_cells = n_cells
  cells%node_ids = location_of(node_ids)
  cells%offsets = location_of(offsets)
  cells%index_base = index_base
  cells%n_threads = n_threads
  cells%id_bits = storage_size(node_ids)
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_cells(cells, c_handle)
  if (status /= RIIS_OK) return
  adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_mixed_64

!> Makes an adjacency of cells from faces. Two cells are neighbours if they have a common face. Errors: RIIS_INVALID_MESH if an
!! owner or neighbor is not a cell; the message names the face and the value.
subroutine riisf_adjacency_from_faces(n_cells, n_faces, face_cells, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_adjacency_create_from_faces, riis_mesh_faces, riis_mesh_faces_init, riis_status
  implicit none
  integer(int32), intent(in) :: n_cells                   !< The number of cells, >= 0. The nodes of the mesh are cell centres.
  integer(int32), intent(in) :: n_faces                   !< >= 0.
  integer(int32), intent(in) :: face_cells(*)             !< FACE_CELLS(2, n_faces); the second is index_base - 1 at the
                                                          !! boundary.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_faces) :: faces
  type(c_ptr) :: c_handle
  status = riis_mesh_faces_init(faces, c_sizeof(faces))
  if (status /= RIIS_OK) return
  faces%n_cells = n_cells
  faces%n_faces = n_faces
  faces%index_base = index_base
  faces%n_threads = n_threads
  faces%id_bits = storage_size(face_cells)
  if (n_faces > 0) faces%owner = location_of(face_cells(1))
  if (n_faces > 0) faces%neighbor = location_of(face_cells(2))
  faces%stride = 2
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_faces(faces, c_handle)
  if (status /= RIIS_OK) return
  adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_faces

!> Does the same as riisf_adjacency_from_faces, with counts and ids of INTEGER*8.
subroutine riisf_adjacency_from_faces_64(n_cells, n_faces, face_cells, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_adjacency_create_from_faces, riis_mesh_faces, riis_mesh_faces_init, riis_status
  implicit none
  integer(int64), intent(in) :: n_cells                   !< The number of cells, >= 0. The nodes of the mesh are cell centres.
  integer(int64), intent(in) :: n_faces                   !< >= 0.
  integer(int64), intent(in) :: face_cells(*)             !< FACE_CELLS(2, n_faces); the second is index_base - 1 at the
                                                          !! boundary.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_faces) :: faces
  type(c_ptr) :: c_handle
  status = riis_mesh_faces_init(faces, c_sizeof(faces))
  if (status /= RIIS_OK) return
  faces%n_cells = n_cells
  faces%n_faces = n_faces
  faces%index_base = index_base
  faces%n_threads = n_threads
  faces%id_bits = storage_size(face_cells)
  if (n_faces > 0) faces%owner = location_of(face_cells(1))
  if (n_faces > 0) faces%neighbor = location_of(face_cells(2))
  faces%stride = 2
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_faces(faces, c_handle)
  if (status /= RIIS_OK) return
  adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_faces_64

!> Makes the adjacency of a structured grid. Two nodes (i, j, k) are neighbours if exactly one of the three numbers differs, by
!! 1. Errors: RIIS_LIMIT_EXCEEDED for more nodes than memory can hold.
subroutine riisf_adjacency_from_grid(ni, nj, nk, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of
  use riis_c, only: RIIS_OK, riis_adjacency_create_from_grid, riis_status
  implicit none
  integer(int32), intent(in) :: ni                        !< The numbers of nodes along the three axes, each >= 1. The number
                                                          !! of node (i, j, k) is i + ni (j + nj k), all from 0.
  integer(int32), intent(in) :: nj                        !< The numbers of nodes along the three axes, each >= 1. The number
                                                          !! of node (i, j, k) is i + ni (j + nj k), all from 0.
  integer(int32), intent(in) :: nk                        !< The numbers of nodes along the three axes, each >= 1. The number
                                                          !! of node (i, j, k) is i + ni (j + nj k), all from 0.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_grid(int(ni, int64), int(nj, int64), int(nk, int64), n_threads, c_handle)
  if (status /= RIIS_OK) return
  adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_grid

!> Destroys the adjacency and its arrays. If a mesh borrows these arrays, destroy the mesh first. The handle becomes 0. Nothing
!! happens to a handle that is 0.
subroutine riisf_adjacency_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: riis_adjacency_destroy
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_adjacency_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_adjacency_destroy

! -----------------------------------------------------------------------------------------------------------------
! Surfaces from triangles or quads, and from frames in time
! Triangles without area are refused.
! -----------------------------------------------------------------------------------------------------------------

!> Makes a surface from arrays, and keeps the winding of the caller's faces. The id of a triangle is the number of its face. The
!! halves of quad q have the ids 2 q and 2 q + 1. No other triangle gets the id of a skipped triangle. A triangle has zero area
!! if its longest edge is shorter than 1e-60, or if its height over its longest edge is at most 1e-12 of this edge. A skirt leads
!! outwards from the axis of the attachment. This axis passes through the centroid of the attachment, in the direction of the
!! vector area that the attachment encloses (docs/theory/skirt.md). The skirt's vertices and triangles come after the caller's
!! vertices and triangles. An open edge belongs to only one triangle. Without `attached`, the attachment is the closed line of
!! open edges that encloses the largest area. The call refuses the skirt if this area is less than 0.8 times the area inside the
!! leaflets' outline (RIIS_OUTLINE_BOUNDARY). Errors: RIIS_LIMIT_EXCEEDED for too many triangles. RIIS_INVALID_SURFACE for a bad
!! face or vertex, and if no attachment is found. The message names the face or vertex and its value, or says why there is no
!! attachment. RIIS_INVALID_ARGUMENT if a length of the skirt is out of range.
subroutine riisf_surface_from_arrays(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, index_base, &
    half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_arrays, riis_surface_arrays_init, &
      riis_surface_create_from_arrays, riis_surface_options, riis_surface_options_init
  implicit none
  integer(int32), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: corners_per_face          !< 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3.
                                                          !! Usually 3.
  integer(int32), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int32), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces): the vertices of each face. The normal
                                                          !! follows the right-hand rule.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status == RIIS_OK) status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%index_base = index_base
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  arrays%id_bits = storage_size(vertex_ids)
  c_handle = c_null_ptr
  status = riis_surface_create_from_arrays(arrays, options, c_handle)
  if (status /= RIIS_OK) return
  surface = handle_of(c_handle)
end subroutine riisf_surface_from_arrays

!> Does the same as riisf_surface_from_arrays, with counts and ids of INTEGER*8.
subroutine riisf_surface_from_arrays_64(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, &
    index_base, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_arrays, riis_surface_arrays_init, &
      riis_surface_create_from_arrays, riis_surface_options, riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: corners_per_face          !< 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3.
                                                          !! Usually 3.
  integer(int64), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int64), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces): the vertices of each face. The normal
                                                          !! follows the right-hand rule.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status == RIIS_OK) status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%index_base = index_base
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  arrays%id_bits = storage_size(vertex_ids)
  c_handle = c_null_ptr
  status = riis_surface_create_from_arrays(arrays, options, c_handle)
  if (status /= RIIS_OK) return
  surface = handle_of(c_handle)
end subroutine riisf_surface_from_arrays_64

!> Makes a surface as riisf_surface_from_arrays does, with a skirt. Errors: RIIS_LIMIT_EXCEEDED for too many triangles.
!! RIIS_INVALID_SURFACE for a bad face or vertex, and if no attachment is found. The message names the face or vertex and its
!! value, or says why there is no attachment. RIIS_INVALID_ARGUMENT if a length of the skirt is out of range.
subroutine riisf_surface_with_skirt(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, index_base, &
    attached, skirt_length, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, surface, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_arrays, riis_surface_arrays_init, &
      riis_surface_create_from_arrays, riis_surface_options, riis_surface_options_init
  implicit none
  integer(int32), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: corners_per_face          !< 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3.
                                                          !! Usually 3.
  integer(int32), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int32), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces): the vertices of each face. The normal
                                                          !! follows the right-hand rule.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int8), intent(in) :: attached(*)                !< INTEGER*1, (n_vertices): 1 for the vertices of the attachment, 0
                                                          !! for others. attached(1) = -1: the attachment is chosen.
  real(c_double), intent(in) :: skirt_length              !< The length of a skirt before placement. A skirt is a strip that
                                                          !! leads outwards from the attachment. The length is 1e-4 to 10 times
                                                          !! the attachment's mean distance from its axis. 0: no skirt.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status == RIIS_OK) status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%index_base = index_base
  arrays%skirt_length = skirt_length
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  arrays%id_bits = storage_size(vertex_ids)
  if (attached(1) < 0) arrays%attached = c_null_ptr
  c_handle = c_null_ptr
  status = riis_surface_create_from_arrays(arrays, options, c_handle)
  if (status /= RIIS_OK) return
  surface = handle_of(c_handle)
end subroutine riisf_surface_with_skirt

!> Does the same as riisf_surface_with_skirt, with counts and ids of INTEGER*8.
subroutine riisf_surface_with_skirt_64(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, index_base, &
    attached, skirt_length, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, surface, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_arrays, riis_surface_arrays_init, &
      riis_surface_create_from_arrays, riis_surface_options, riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: corners_per_face          !< 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3.
                                                          !! Usually 3.
  integer(int64), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int64), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces): the vertices of each face. The normal
                                                          !! follows the right-hand rule.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int8), intent(in) :: attached(*)                !< INTEGER*1, (n_vertices): 1 for the vertices of the attachment, 0
                                                          !! for others. attached(1) = -1: the attachment is chosen.
  real(c_double), intent(in) :: skirt_length              !< The length of a skirt before placement. A skirt is a strip that
                                                          !! leads outwards from the attachment. The length is 1e-4 to 10 times
                                                          !! the attachment's mean distance from its axis. 0: no skirt.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status == RIIS_OK) status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%index_base = index_base
  arrays%skirt_length = skirt_length
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  arrays%id_bits = storage_size(vertex_ids)
  if (attached(1) < 0) arrays%attached = c_null_ptr
  c_handle = c_null_ptr
  status = riis_surface_create_from_arrays(arrays, options, c_handle)
  if (status /= RIIS_OK) return
  surface = handle_of(c_handle)
end subroutine riisf_surface_with_skirt_64

!> Makes a surface like riisf_surface_from_arrays, whose band steps aside along the normals, by `offset` half thicknesses. Later
!! updates keep the offset. Errors: also RIIS_INVALID_SURFACE for two triangles that run along a shared edge in the same
!! direction.
subroutine riisf_surface_offset_arrays(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, index_base, &
    half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, offset, surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_arrays, riis_surface_arrays_init, &
      riis_surface_create_from_arrays, riis_surface_options, riis_surface_options_init
  implicit none
  integer(int32), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: corners_per_face          !< 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3.
                                                          !! Usually 3.
  integer(int32), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int32), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces): the vertices of each face. The normal
                                                          !! follows the right-hand rule.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  real(c_double), intent(in) :: offset                    !< The offset o, in half thicknesses, above -1 and below 1, usually
                                                          !! 0. The middle of the band is the surface moved by o half
                                                          !! thicknesses along its normals (after flip_normals).
                                                          !! RIIS_MEASURE_SAMPLING and RIIS_MEASURE_MINIMIZATION need the
                                                          !! offset 0.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status == RIIS_OK) status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%index_base = index_base
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  options%offset = offset
  arrays%id_bits = storage_size(vertex_ids)
  c_handle = c_null_ptr
  status = riis_surface_create_from_arrays(arrays, options, c_handle)
  if (status /= RIIS_OK) return
  surface = handle_of(c_handle)
end subroutine riisf_surface_offset_arrays

!> Does the same as riisf_surface_offset_arrays, with counts and ids of INTEGER*8.
subroutine riisf_surface_offset_arrays_64(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, &
    index_base, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, offset, surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_arrays, riis_surface_arrays_init, &
      riis_surface_create_from_arrays, riis_surface_options, riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: corners_per_face          !< 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3.
                                                          !! Usually 3.
  integer(int64), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int64), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces): the vertices of each face. The normal
                                                          !! follows the right-hand rule.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  real(c_double), intent(in) :: offset                    !< The offset o, in half thicknesses, above -1 and below 1, usually
                                                          !! 0. The middle of the band is the surface moved by o half
                                                          !! thicknesses along its normals (after flip_normals).
                                                          !! RIIS_MEASURE_SAMPLING and RIIS_MEASURE_MINIMIZATION need the
                                                          !! offset 0.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status == RIIS_OK) status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%index_base = index_base
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  options%offset = offset
  arrays%id_bits = storage_size(vertex_ids)
  c_handle = c_null_ptr
  status = riis_surface_create_from_arrays(arrays, options, c_handle)
  if (status /= RIIS_OK) return
  surface = handle_of(c_handle)
end subroutine riisf_surface_offset_arrays_64

!> Replaces the surface by triangles or quads that moved, with the same options and with the velocities of the vertices. Errors:
!! as riisf_surface_from_arrays. With n_faces 0, also RIIS_INVALID_ARGUMENT if n_vertices has changed since the last arrays, or
!! if the surface was not made from arrays.
subroutine riisf_surface_update_arrays(surface, n_vertices, x, y, z, stride, vx, vy, vz, velocity_stride, &
    corners_per_face, n_faces, vertex_ids, index_base, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_arrays, riis_surface_arrays_init, riis_surface_update_from_arrays
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int32), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  real(c_double), intent(in) :: vx(*)                     !< (n_vertices) by velocity_stride: velocities of the vertices, in
                                                          !! the unit of x, y and z per unit of time. The placement rotates and
                                                          !! scales the velocities.
  real(c_double), intent(in) :: vy(*)                     !< (n_vertices) by velocity_stride: velocities of the vertices, in
                                                          !! the unit of x, y and z per unit of time. The placement rotates and
                                                          !! scales the velocities.
  real(c_double), intent(in) :: vz(*)                     !< (n_vertices) by velocity_stride: velocities of the vertices, in
                                                          !! the unit of x, y and z per unit of time. The placement rotates and
                                                          !! scales the velocities.
  integer(int32), intent(in) :: velocity_stride           !< Of vx, vy and vz. Usually 1.
  integer(int32), intent(in) :: corners_per_face          !< 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3.
                                                          !! Usually 3.
  integer(int32), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int32), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces): the vertices of each face. The normal
                                                          !! follows the right-hand rule.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  arrays%vx = location_of(vx)
  arrays%vy = location_of(vy)
  arrays%vz = location_of(vz)
  arrays%velocity_stride = velocity_stride
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%index_base = index_base
  arrays%id_bits = storage_size(vertex_ids)
  status = riis_surface_update_from_arrays(c_handle_of(surface), arrays)
end subroutine riisf_surface_update_arrays

!> Does the same as riisf_surface_update_arrays, with counts and ids of INTEGER*8.
subroutine riisf_surface_update_arrays_64(surface, n_vertices, x, y, z, stride, vx, vy, vz, velocity_stride, &
    corners_per_face, n_faces, vertex_ids, index_base, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_arrays, riis_surface_arrays_init, riis_surface_update_from_arrays
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  real(c_double), intent(in) :: vx(*)                     !< (n_vertices) by velocity_stride: velocities of the vertices, in
                                                          !! the unit of x, y and z per unit of time. The placement rotates and
                                                          !! scales the velocities.
  real(c_double), intent(in) :: vy(*)                     !< (n_vertices) by velocity_stride: velocities of the vertices, in
                                                          !! the unit of x, y and z per unit of time. The placement rotates and
                                                          !! scales the velocities.
  real(c_double), intent(in) :: vz(*)                     !< (n_vertices) by velocity_stride: velocities of the vertices, in
                                                          !! the unit of x, y and z per unit of time. The placement rotates and
                                                          !! scales the velocities.
  integer(int64), intent(in) :: velocity_stride           !< Of vx, vy and vz. Usually 1.
  integer(int32), intent(in) :: corners_per_face          !< 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3.
                                                          !! Usually 3.
  integer(int64), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int64), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces): the vertices of each face. The normal
                                                          !! follows the right-hand rule.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  arrays%vx = location_of(vx)
  arrays%vy = location_of(vy)
  arrays%vz = location_of(vz)
  arrays%velocity_stride = velocity_stride
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%index_base = index_base
  arrays%id_bits = storage_size(vertex_ids)
  status = riis_surface_update_from_arrays(c_handle_of(surface), arrays)
end subroutine riisf_surface_update_arrays_64

!> Makes keyframes from arrays and frames, which are copied. Errors: RIIS_INVALID_SURFACE for a bad frame, vertex or face; the
!! message names it. RIIS_LIMIT_EXCEEDED for too many frames, vertices or faces.
subroutine riisf_keyframes_create(n_vertices, n_keys, time, xyz, period, interpolation, corners_per_face, n_faces, &
    vertex_ids, index_base, keyframes, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_keyframe_arrays, riis_keyframe_arrays_init, riis_keyframes_create, riis_status, &
      riis_surface_arrays, riis_surface_arrays_init
  implicit none
  integer(int32), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  integer(int32), intent(in) :: n_keys                    !< 1 to 1,000,000.
  real(c_double), intent(in) :: time(*)                   !< (n_keys), strictly ascending, magnitude at most 1e30.
  real(c_double), intent(in) :: xyz(*)                    !< (3, n_vertices, n_keys): the vertices, frame after frame;
                                                          !! magnitude at most 1e60.
  real(c_double), intent(in) :: period                    !< If above 0, the motion repeats with this period. All keys must lie
                                                          !! within one period after the first key. If the last key is exactly
                                                          !! one period after the first key, the two keys must have the same
                                                          !! frame. With 0, the default, the surface rests before the first key
                                                          !! and after the last key.
  integer(int32), intent(in) :: interpolation             !< RIIS_INTERPOLATION_*, of each coordinate. Usually
                                                          !! RIIS_INTERPOLATION_LINEAR.
  integer(int32), intent(in) :: corners_per_face          !< 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3.
                                                          !! Usually 3.
  integer(int32), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int32), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces): the vertices of each face. The normal
                                                          !! follows the right-hand rule.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int64), intent(inout) :: keyframes              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_keyframe_arrays) :: frames
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status == RIIS_OK) status = riis_keyframe_arrays_init(frames, c_sizeof(frames))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  frames%n_keys = n_keys
  frames%time = location_of(time)
  frames%xyz = location_of(xyz)
  frames%period = period
  frames%interpolation = interpolation
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%index_base = index_base
  arrays%id_bits = storage_size(vertex_ids)
  frames%n_vertices = n_vertices
  c_handle = c_null_ptr
  status = riis_keyframes_create(arrays, frames, c_handle)
  if (status /= RIIS_OK) return
  keyframes = handle_of(c_handle)
end subroutine riisf_keyframes_create

!> Does the same as riisf_keyframes_create, with counts and ids of INTEGER*8.
subroutine riisf_keyframes_create_64(n_vertices, n_keys, time, xyz, period, interpolation, corners_per_face, n_faces, &
    vertex_ids, index_base, keyframes, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_keyframe_arrays, riis_keyframe_arrays_init, riis_keyframes_create, riis_status, &
      riis_surface_arrays, riis_surface_arrays_init
  implicit none
  integer(int64), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  integer(int32), intent(in) :: n_keys                    !< 1 to 1,000,000.
  real(c_double), intent(in) :: time(*)                   !< (n_keys), strictly ascending, magnitude at most 1e30.
  real(c_double), intent(in) :: xyz(*)                    !< (3, n_vertices, n_keys): the vertices, frame after frame;
                                                          !! magnitude at most 1e60.
  real(c_double), intent(in) :: period                    !< If above 0, the motion repeats with this period. All keys must lie
                                                          !! within one period after the first key. If the last key is exactly
                                                          !! one period after the first key, the two keys must have the same
                                                          !! frame. With 0, the default, the surface rests before the first key
                                                          !! and after the last key.
  integer(int32), intent(in) :: interpolation             !< RIIS_INTERPOLATION_*, of each coordinate. Usually
                                                          !! RIIS_INTERPOLATION_LINEAR.
  integer(int32), intent(in) :: corners_per_face          !< 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3.
                                                          !! Usually 3.
  integer(int64), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int64), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces): the vertices of each face. The normal
                                                          !! follows the right-hand rule.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the number of the first.
  integer(int64), intent(inout) :: keyframes              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_keyframe_arrays) :: frames
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status == RIIS_OK) status = riis_keyframe_arrays_init(frames, c_sizeof(frames))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  frames%n_keys = n_keys
  frames%time = location_of(time)
  frames%xyz = location_of(xyz)
  frames%period = period
  frames%interpolation = interpolation
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%index_base = index_base
  arrays%id_bits = storage_size(vertex_ids)
  frames%n_vertices = n_vertices
  c_handle = c_null_ptr
  status = riis_keyframes_create(arrays, frames, c_handle)
  if (status /= RIIS_OK) return
  keyframes = handle_of(c_handle)
end subroutine riisf_keyframes_create_64

!> Makes the surface that keyframes have at a given time, with velocities. Errors: as riisf_surface_from_arrays.
subroutine riisf_surface_from_keyframes(keyframes, time, dt, half_thickness, tolerance, scale, rotation_axis, &
    rotation_angle, translation, surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_create_from_keyframes, riis_surface_options, &
      riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: keyframes                 !< From riisf_keyframes_create, for example.
  real(c_double), intent(in) :: time                      !< The time, finite and at most 1e30 in magnitude.
  real(c_double), intent(in) :: dt                        !< The length of the time interval that ends at `time`, over which
                                                          !! the velocity is the mean. With dt 0, the velocity is the time
                                                          !! derivative of the interpolation.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  c_handle = c_null_ptr
  status = riis_surface_create_from_keyframes(c_handle_of(keyframes), time, dt, options, c_handle)
  if (status /= RIIS_OK) return
  surface = handle_of(c_handle)
end subroutine riisf_surface_from_keyframes

!> Makes a surface like riisf_surface_from_keyframes, whose band steps aside as in riisf_surface_offset_arrays. Errors: as
!! riisf_surface_from_arrays.
subroutine riisf_surface_offset_keyframes(keyframes, time, dt, half_thickness, tolerance, scale, rotation_axis, &
    rotation_angle, translation, offset, surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_create_from_keyframes, riis_surface_options, &
      riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: keyframes                 !< From riisf_keyframes_create, for example.
  real(c_double), intent(in) :: time                      !< The time, finite and at most 1e30 in magnitude.
  real(c_double), intent(in) :: dt                        !< The length of the time interval that ends at `time`, over which
                                                          !! the velocity is the mean. With dt 0, the velocity is the time
                                                          !! derivative of the interpolation.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  real(c_double), intent(in) :: offset                    !< The offset o, in half thicknesses, above -1 and below 1, usually
                                                          !! 0. The middle of the band is the surface moved by o half
                                                          !! thicknesses along its normals (after flip_normals).
                                                          !! RIIS_MEASURE_SAMPLING and RIIS_MEASURE_MINIMIZATION need the
                                                          !! offset 0.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  options%offset = offset
  c_handle = c_null_ptr
  status = riis_surface_create_from_keyframes(c_handle_of(keyframes), time, dt, options, c_handle)
  if (status /= RIIS_OK) return
  surface = handle_of(c_handle)
end subroutine riisf_surface_offset_keyframes

!> Replaces the content of a surface by the surface that keyframes have at a given time.
subroutine riisf_surface_update_keyframes(surface, keyframes, time, dt, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: riis_status, riis_surface_update_from_keyframes
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: keyframes                 !< From riisf_keyframes_create, for example.
  real(c_double), intent(in) :: time                      !< The time, finite and at most 1e30 in magnitude.
  real(c_double), intent(in) :: dt                        !< The length of the time interval that ends at `time`, over which
                                                          !! the velocity is the mean. With dt 0, the velocity is the time
                                                          !! derivative of the interpolation.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_surface_update_from_keyframes(c_handle_of(surface), c_handle_of(keyframes), time, dt)
end subroutine riisf_surface_update_keyframes

!> Destroys the keyframes. Surfaces made from them stay. The handle becomes 0. Nothing happens to a handle that is 0.
subroutine riisf_keyframes_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: riis_keyframes_destroy
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_keyframes_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_keyframes_destroy

! -----------------------------------------------------------------------------------------------------------------
! Vertices, velocities, closest points
! -----------------------------------------------------------------------------------------------------------------

!> Copies the surface's vertices, after placement.
subroutine riisf_surface_vertices(surface, length, n, xyz, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_status, riis_surface_get_triangles, riis_triangles
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of vertices, even if an array is too short.
  real(c_double), intent(inout) :: xyz(*)                 !< (3, length): the vertices; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_triangles) :: triangles
  real(c_double), pointer :: c_xyz(:)
  status = riis_surface_get_triangles(c_handle_of(surface), triangles, c_sizeof(triangles))
  if (status /= RIIS_OK) return
  n = int(min(triangles%n_vertices, int(huge(n), int64)), int32)
  if (triangles%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // &
        text_of(triangles%n_vertices))
    return
  end if
  if (triangles%n_vertices == 0) return
  call c_f_pointer(triangles%xyz, c_xyz, [3 * triangles%n_vertices])
  xyz(:3 * triangles%n_vertices) = c_xyz
end subroutine riisf_surface_vertices

!> Does the same as riisf_surface_vertices, with counts and ids of INTEGER*8.
subroutine riisf_surface_vertices_64(surface, length, n, xyz, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_status, riis_surface_get_triangles, riis_triangles
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of vertices, even if an array is too short.
  real(c_double), intent(inout) :: xyz(*)                 !< (3, length): the vertices; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_triangles) :: triangles
  real(c_double), pointer :: c_xyz(:)
  status = riis_surface_get_triangles(c_handle_of(surface), triangles, c_sizeof(triangles))
  if (status /= RIIS_OK) return
  n = int(min(triangles%n_vertices, int(huge(n), int64)), int64)
  if (triangles%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // &
        text_of(triangles%n_vertices))
    return
  end if
  if (triangles%n_vertices == 0) return
  call c_f_pointer(triangles%xyz, c_xyz, [3 * triangles%n_vertices])
  xyz(:3 * triangles%n_vertices) = c_xyz
end subroutine riisf_surface_vertices_64

!> Copies the surface's triangles that answer queries.
subroutine riisf_surface_triangles(surface, length, n, vertex_num, triangle_id, leaflet_id, patch_id, status)
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIMIT_EXCEEDED, RIIS_OK, riis_status, riis_surface_get_triangles, &
      riis_triangles
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of triangles, even if an array is too short.
  integer(int32), intent(inout) :: vertex_num(3, *)       !< (3, length): the vertices of each triangle, from 1; written up to
                                                          !! n.
  integer(int64), intent(inout) :: triangle_id(*)         !< (length), ascending: the ids of the triangles in results of
                                                          !! queries; 0, 1, 2, ... for a valve; written up to n.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (length): RIIS_LEAFLET_*, or the caller's leaflet_id if the
                                                          !! surface comes from patches or arrays; written up to n.
  integer(int32), intent(inout) :: patch_id(*)            !< From 0; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_triangles) :: triangles
  integer(int64), pointer :: c_vertex_num(:, :)
  integer(int64), pointer :: c_triangle_id(:)
  integer(int32), pointer :: c_leaflet_id(:)
  integer(int32), pointer :: c_patch_id(:)
  status = riis_surface_get_triangles(c_handle_of(surface), triangles, c_sizeof(triangles))
  if (status /= RIIS_OK) return
  n = int(min(triangles%n_triangles, int(huge(n), int64)), int32)
  if (triangles%n_triangles > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; triangles: ' // &
        text_of(triangles%n_triangles))
    return
  end if
  if (triangles%n_triangles == 0) return
  call c_f_pointer(triangles%vertex_id, c_vertex_num, [3_int64, triangles%n_triangles])
  if (maxval(c_vertex_num) >= huge(n)) then
    status = fail(RIIS_LIMIT_EXCEEDED, 'vertex ' // text_of(maxval(c_vertex_num)) // &
        ' is more than an INTEGER*4 can count: use riisf_surface_triangles_64')
    return
  end if
  vertex_num(:, :n) = int(c_vertex_num + 1, int32)
  call c_f_pointer(triangles%triangle_id, c_triangle_id, [triangles%n_triangles])
  triangle_id(:n) = c_triangle_id
  call c_f_pointer(triangles%leaflet_id, c_leaflet_id, [triangles%n_triangles])
  leaflet_id(:n) = c_leaflet_id
  call c_f_pointer(triangles%patch_id, c_patch_id, [triangles%n_triangles])
  patch_id(:n) = c_patch_id
end subroutine riisf_surface_triangles

!> Does the same as riisf_surface_triangles, with counts and ids of INTEGER*8.
subroutine riisf_surface_triangles_64(surface, length, n, vertex_num, triangle_id, leaflet_id, patch_id, status)
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_status, riis_surface_get_triangles, riis_triangles
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of triangles, even if an array is too short.
  integer(int64), intent(inout) :: vertex_num(3, *)       !< (3, length): the vertices of each triangle, from 1; written up to
                                                          !! n.
  integer(int64), intent(inout) :: triangle_id(*)         !< (length), ascending: the ids of the triangles in results of
                                                          !! queries; 0, 1, 2, ... for a valve; written up to n.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (length): RIIS_LEAFLET_*, or the caller's leaflet_id if the
                                                          !! surface comes from patches or arrays; written up to n.
  integer(int32), intent(inout) :: patch_id(*)            !< From 0; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_triangles) :: triangles
  integer(int64), pointer :: c_vertex_num(:, :)
  integer(int64), pointer :: c_triangle_id(:)
  integer(int32), pointer :: c_leaflet_id(:)
  integer(int32), pointer :: c_patch_id(:)
  status = riis_surface_get_triangles(c_handle_of(surface), triangles, c_sizeof(triangles))
  if (status /= RIIS_OK) return
  n = int(min(triangles%n_triangles, int(huge(n), int64)), int64)
  if (triangles%n_triangles > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; triangles: ' // &
        text_of(triangles%n_triangles))
    return
  end if
  if (triangles%n_triangles == 0) return
  call c_f_pointer(triangles%vertex_id, c_vertex_num, [3_int64, triangles%n_triangles])
  vertex_num(:, :n) = int(c_vertex_num + 1, int64)
  call c_f_pointer(triangles%triangle_id, c_triangle_id, [triangles%n_triangles])
  triangle_id(:n) = c_triangle_id
  call c_f_pointer(triangles%leaflet_id, c_leaflet_id, [triangles%n_triangles])
  leaflet_id(:n) = c_leaflet_id
  call c_f_pointer(triangles%patch_id, c_patch_id, [triangles%n_triangles])
  patch_id(:n) = c_patch_id
end subroutine riisf_surface_triangles_64

!> Copies the velocities of the surface's vertices, after placement. Errors: RIIS_INVALID_ARGUMENT if the last update gave none.
subroutine riisf_surface_vertex_velocities(surface, length, n, velocity, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_status, riis_surface_get_triangles, riis_triangles
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of vertices, even if an array is too short.
  real(c_double), intent(inout) :: velocity(*)            !< (3, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_triangles) :: triangles
  real(c_double), pointer :: c_velocity(:)
  status = riis_surface_get_triangles(c_handle_of(surface), triangles, c_sizeof(triangles))
  if (status /= RIIS_OK) return
  n = int(min(triangles%n_vertices, int(huge(n), int64)), int32)
  if (triangles%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // &
        text_of(triangles%n_vertices))
    return
  end if
  if (triangles%n_vertices == 0) return
  if (.not. c_associated(triangles%velocity)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'surface has no velocities: its last update gave none')
    return
  end if
  call c_f_pointer(triangles%velocity, c_velocity, [3 * triangles%n_vertices])
  velocity(:3 * triangles%n_vertices) = c_velocity
end subroutine riisf_surface_vertex_velocities

!> Does the same as riisf_surface_vertex_velocities, with counts and ids of INTEGER*8.
subroutine riisf_surface_vertex_velocities_64(surface, length, n, velocity, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_status, riis_surface_get_triangles, riis_triangles
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of vertices, even if an array is too short.
  real(c_double), intent(inout) :: velocity(*)            !< (3, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_triangles) :: triangles
  real(c_double), pointer :: c_velocity(:)
  status = riis_surface_get_triangles(c_handle_of(surface), triangles, c_sizeof(triangles))
  if (status /= RIIS_OK) return
  n = int(min(triangles%n_vertices, int(huge(n), int64)), int64)
  if (triangles%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // &
        text_of(triangles%n_vertices))
    return
  end if
  if (triangles%n_vertices == 0) return
  if (.not. c_associated(triangles%velocity)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'surface has no velocities: its last update gave none')
    return
  end if
  call c_f_pointer(triangles%velocity, c_velocity, [3 * triangles%n_vertices])
  velocity(:3 * triangles%n_vertices) = c_velocity
end subroutine riisf_surface_vertex_velocities_64

!> Copies the edges at which tissue or a stent holds the leaflets of a valve (riis_surface_get_attachment in riis.h). Errors:
!! RIIS_INVALID_ARGUMENT for a surface from arrays or keyframes without an attachment.
subroutine riisf_surface_attachment(surface, length, n, edges, leaflet_id, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_attachment, riis_status, riis_surface_get_attachment
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of edges, even if an array is too short.
  real(c_double), intent(inout) :: edges(3, 2, *)         !< (3, 2, length): the coordinates of both ends of each edge, in the
                                                          !! layout of riis_reaction.edges; written up to n.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (length): the leaflet that is attached there; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_attachment) :: attachment
  real(c_double), pointer :: c_edges(:, :, :)
  integer(int32), pointer :: c_leaflet_id(:)
  status = riis_surface_get_attachment(c_handle_of(surface), attachment, c_sizeof(attachment))
  if (status /= RIIS_OK) return
  n = int(min(attachment%n_edges, int(huge(n), int64)), int32)
  if (attachment%n_edges > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; edges: ' // text_of(attachment%n_edges))
    return
  end if
  if (attachment%n_edges == 0) return
  call c_f_pointer(attachment%edges, c_edges, [3_int64, 2_int64, attachment%n_edges])
  edges(:, :, :n) = c_edges
  call c_f_pointer(attachment%leaflet_id, c_leaflet_id, [attachment%n_edges])
  leaflet_id(:n) = c_leaflet_id
end subroutine riisf_surface_attachment

!> Does the same as riisf_surface_attachment, with counts and ids of INTEGER*8.
subroutine riisf_surface_attachment_64(surface, length, n, edges, leaflet_id, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_attachment, riis_status, riis_surface_get_attachment
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of edges, even if an array is too short.
  real(c_double), intent(inout) :: edges(3, 2, *)         !< (3, 2, length): the coordinates of both ends of each edge, in the
                                                          !! layout of riis_reaction.edges; written up to n.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (length): the leaflet that is attached there; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_attachment) :: attachment
  real(c_double), pointer :: c_edges(:, :, :)
  integer(int32), pointer :: c_leaflet_id(:)
  status = riis_surface_get_attachment(c_handle_of(surface), attachment, c_sizeof(attachment))
  if (status /= RIIS_OK) return
  n = int(min(attachment%n_edges, int(huge(n), int64)), int64)
  if (attachment%n_edges > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; edges: ' // text_of(attachment%n_edges))
    return
  end if
  if (attachment%n_edges == 0) return
  call c_f_pointer(attachment%edges, c_edges, [3_int64, 2_int64, attachment%n_edges])
  edges(:, :, :n) = c_edges
  call c_f_pointer(attachment%leaflet_id, c_leaflet_id, [attachment%n_edges])
  leaflet_id(:n) = c_leaflet_id
end subroutine riisf_surface_attachment_64

!> Copies the rates of the surface's vertices in a direction. Errors: RIIS_INVALID_ARGUMENT if the surface lacks the direction.
subroutine riisf_surface_direction(surface, direction_num, length, n, rate, area_rate, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_direction, riis_status, riis_surface_get_direction
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int32), intent(in) :: direction_num             !< The direction, from 1. A message counts from 0.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of vertices, even if an array is too short.
  real(c_double), intent(inout) :: rate(*)                !< (3, length): the derivative of each vertex; written up to n.
  real(c_double), intent(inout) :: area_rate              !< The derivative of riis_surface_info.area. Each call of
                                                          !! riisf_surface_direction computes it again from all triangles.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_direction) :: direction
  real(c_double), pointer :: c_rate(:)
  status = riis_surface_get_direction(c_handle_of(surface), int(direction_num, int64) - 1, direction, &
      c_sizeof(direction))
  if (status /= RIIS_OK) return
  n = int(min(direction%n_vertices, int(huge(n), int64)), int32)
  if (direction%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // &
        text_of(direction%n_vertices))
    return
  end if
  if (direction%n_vertices == 0) return
  call c_f_pointer(direction%rate, c_rate, [3 * direction%n_vertices])
  rate(:3 * direction%n_vertices) = c_rate
  area_rate = direction%area_rate
end subroutine riisf_surface_direction

!> Does the same as riisf_surface_direction, with counts and ids of INTEGER*8.
subroutine riisf_surface_direction_64(surface, direction_num, length, n, rate, area_rate, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_direction, riis_status, riis_surface_get_direction
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: direction_num             !< The direction, from 1. A message counts from 0.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of vertices, even if an array is too short.
  real(c_double), intent(inout) :: rate(*)                !< (3, length): the derivative of each vertex; written up to n.
  real(c_double), intent(inout) :: area_rate              !< The derivative of riis_surface_info.area. Each call of
                                                          !! riisf_surface_direction computes it again from all triangles.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_direction) :: direction
  real(c_double), pointer :: c_rate(:)
  status = riis_surface_get_direction(c_handle_of(surface), int(direction_num, int64) - 1, direction, &
      c_sizeof(direction))
  if (status /= RIIS_OK) return
  n = int(min(direction%n_vertices, int(huge(n), int64)), int64)
  if (direction%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // &
        text_of(direction%n_vertices))
    return
  end if
  if (direction%n_vertices == 0) return
  call c_f_pointer(direction%rate, c_rate, [3 * direction%n_vertices])
  rate(:3 * direction%n_vertices) = c_rate
  area_rate = direction%area_rate
end subroutine riisf_surface_direction_64

!> Finds the closest point of the surface for each of many points, in parallel. Errors: RIIS_INVALID_ARGUMENT for a bad point;
!! the message names the first bad point, and nothing is written.
subroutine riisf_closest_points(surface, n_points, x, y, z, stride, distance_limit, n_threads, distance, point, &
    normal, triangle_id, leaflet_id, side, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_closest_arrays, riis_closest_arrays_init, riis_closest_options, &
      riis_closest_options_init, riis_closest_points, riis_points, riis_points_init, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int32), intent(in) :: n_points                  !< 0 to 2^40.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  real(c_double), intent(in) :: distance_limit            !< >= 0. Farther points get RIIS_FAR_DISTANCE, ids -1, side 0 and
                                                          !! zeros. HUGE(1D0): no limit.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  real(c_double), intent(inout) :: distance(*)            !< (n_points), >= 0.
  real(c_double), intent(inout) :: point(*)               !< (3, n_points): the closest points.
  real(c_double), intent(inout) :: normal(*)              !< (3, n_points): the triangle's unit normal.
  integer(int64), intent(inout) :: triangle_id(*)         !< (n_points), from 0. INTEGER*8.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (n_points): RIIS_LEAFLET_*, or the caller's.
  integer(int32), intent(inout) :: side(*)                !< (n_points): 1 downstream, -1 upstream, 0 on the surface or level
                                                          !! with its rim.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: points
  type(riis_closest_options) :: options
  type(riis_closest_arrays) :: arrays
  status = riis_points_init(points, c_sizeof(points))
  if (status == RIIS_OK) status = riis_closest_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_closest_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  points%n_points = n_points
  points%x = location_of(x)
  points%y = location_of(y)
  points%z = location_of(z)
  points%stride = stride
  options%n_threads = n_threads
  arrays%distance = location_of(distance)
  arrays%point = location_of(point)
  arrays%normal = location_of(normal)
  arrays%triangle_id = location_of(triangle_id)
  arrays%leaflet_id = location_of(leaflet_id)
  arrays%side = location_of(side)
  if (distance_limit < huge(distance_limit)) options%distance_limit = distance_limit
  status = riis_closest_points(c_handle_of(surface), points, options, arrays)
end subroutine riisf_closest_points

!> Does the same as riisf_closest_points, with counts and ids of INTEGER*8.
subroutine riisf_closest_points_64(surface, n_points, x, y, z, stride, distance_limit, n_threads, distance, point, &
    normal, triangle_id, leaflet_id, side, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_closest_arrays, riis_closest_arrays_init, riis_closest_options, &
      riis_closest_options_init, riis_closest_points, riis_points, riis_points_init, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: n_points                  !< 0 to 2^40.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  real(c_double), intent(in) :: distance_limit            !< >= 0. Farther points get RIIS_FAR_DISTANCE, ids -1, side 0 and
                                                          !! zeros. HUGE(1D0): no limit.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  real(c_double), intent(inout) :: distance(*)            !< (n_points), >= 0.
  real(c_double), intent(inout) :: point(*)               !< (3, n_points): the closest points.
  real(c_double), intent(inout) :: normal(*)              !< (3, n_points): the triangle's unit normal.
  integer(int64), intent(inout) :: triangle_id(*)         !< (n_points), from 0. INTEGER*8.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (n_points): RIIS_LEAFLET_*, or the caller's.
  integer(int32), intent(inout) :: side(*)                !< (n_points): 1 downstream, -1 upstream, 0 on the surface or level
                                                          !! with its rim.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: points
  type(riis_closest_options) :: options
  type(riis_closest_arrays) :: arrays
  status = riis_points_init(points, c_sizeof(points))
  if (status == RIIS_OK) status = riis_closest_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_closest_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  points%n_points = n_points
  points%x = location_of(x)
  points%y = location_of(y)
  points%z = location_of(z)
  points%stride = stride
  options%n_threads = n_threads
  arrays%distance = location_of(distance)
  arrays%point = location_of(point)
  arrays%normal = location_of(normal)
  arrays%triangle_id = location_of(triangle_id)
  arrays%leaflet_id = location_of(leaflet_id)
  arrays%side = location_of(side)
  if (distance_limit < huge(distance_limit)) options%distance_limit = distance_limit
  status = riis_closest_points(c_handle_of(surface), points, options, arrays)
end subroutine riisf_closest_points_64

!> Works like riisf_closest_points, but for a list of points. Only these points are read, and only their entries are written.
!! Errors: RIIS_INVALID_ARGUMENT for a bad point; the message names the first bad point, and nothing is written.
subroutine riisf_closest_points_listed(surface, n_points, x, y, z, stride, n_listed, point_num, distance_limit, &
    n_threads, distance, point, normal, triangle_id, leaflet_id, side, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of, out_of_memory
  use riis_c, only: RIIS_OK, riis_closest_arrays, riis_closest_arrays_init, riis_closest_options, &
      riis_closest_options_init, riis_closest_points, riis_points, riis_points_init, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int32), intent(in) :: n_points                  !< 0 to 2^40.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: n_listed                  !< 0 to n_points.
  integer(int32), intent(in) :: point_num(*)              !< (n_listed), strictly ascending, from 1, like the nodes of
                                                          !! riisf_marked; copied.
  real(c_double), intent(in) :: distance_limit            !< >= 0. Farther points get RIIS_FAR_DISTANCE, ids -1, side 0 and
                                                          !! zeros. HUGE(1D0): no limit.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  real(c_double), intent(inout) :: distance(*)            !< (n_points), >= 0.
  real(c_double), intent(inout) :: point(*)               !< (3, n_points): the closest points.
  real(c_double), intent(inout) :: normal(*)              !< (3, n_points): the triangle's unit normal.
  integer(int64), intent(inout) :: triangle_id(*)         !< (n_points), from 0. INTEGER*8.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (n_points): RIIS_LEAFLET_*, or the caller's.
  integer(int32), intent(inout) :: side(*)                !< (n_points): 1 downstream, -1 upstream, 0 on the surface or level
                                                          !! with its rim.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int64), allocatable, target :: c_point_num(:)
  type(riis_points) :: points
  type(riis_closest_options) :: options
  type(riis_closest_arrays) :: arrays
  integer :: stat
  status = riis_points_init(points, c_sizeof(points))
  if (status == RIIS_OK) status = riis_closest_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_closest_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  allocate (c_point_num(max(n_listed, 1_int32)), stat=stat)
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  points%n_points = n_points
  points%x = location_of(x)
  points%y = location_of(y)
  points%z = location_of(z)
  points%stride = stride
  options%n_point_ids = n_listed
  c_point_num(:n_listed) = int(point_num(:n_listed), int64) - 1
  options%point_ids = c_loc(c_point_num)
  options%n_threads = n_threads
  arrays%distance = location_of(distance)
  arrays%point = location_of(point)
  arrays%normal = location_of(normal)
  arrays%triangle_id = location_of(triangle_id)
  arrays%leaflet_id = location_of(leaflet_id)
  arrays%side = location_of(side)
  if (distance_limit < huge(distance_limit)) options%distance_limit = distance_limit
  status = riis_closest_points(c_handle_of(surface), points, options, arrays)
end subroutine riisf_closest_points_listed

!> Does the same as riisf_closest_points_listed, with counts and ids of INTEGER*8.
subroutine riisf_closest_points_listed_64(surface, n_points, x, y, z, stride, n_listed, point_num, distance_limit, &
    n_threads, distance, point, normal, triangle_id, leaflet_id, side, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of, out_of_memory
  use riis_c, only: RIIS_OK, riis_closest_arrays, riis_closest_arrays_init, riis_closest_options, &
      riis_closest_options_init, riis_closest_points, riis_points, riis_points_init, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: n_points                  !< 0 to 2^40.
  real(c_double), intent(in) :: x(*)                      !< Entry i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Entry i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Entry i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int64), intent(in) :: n_listed                  !< 0 to n_points.
  integer(int64), intent(in) :: point_num(*)              !< (n_listed), strictly ascending, from 1, like the nodes of
                                                          !! riisf_marked; copied.
  real(c_double), intent(in) :: distance_limit            !< >= 0. Farther points get RIIS_FAR_DISTANCE, ids -1, side 0 and
                                                          !! zeros. HUGE(1D0): no limit.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  real(c_double), intent(inout) :: distance(*)            !< (n_points), >= 0.
  real(c_double), intent(inout) :: point(*)               !< (3, n_points): the closest points.
  real(c_double), intent(inout) :: normal(*)              !< (3, n_points): the triangle's unit normal.
  integer(int64), intent(inout) :: triangle_id(*)         !< (n_points), from 0. INTEGER*8.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (n_points): RIIS_LEAFLET_*, or the caller's.
  integer(int32), intent(inout) :: side(*)                !< (n_points): 1 downstream, -1 upstream, 0 on the surface or level
                                                          !! with its rim.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int64), allocatable, target :: c_point_num(:)
  type(riis_points) :: points
  type(riis_closest_options) :: options
  type(riis_closest_arrays) :: arrays
  integer :: stat
  status = riis_points_init(points, c_sizeof(points))
  if (status == RIIS_OK) status = riis_closest_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_closest_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  allocate (c_point_num(max(n_listed, 1_int64)), stat=stat)
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  points%n_points = n_points
  points%x = location_of(x)
  points%y = location_of(y)
  points%z = location_of(z)
  points%stride = stride
  options%n_point_ids = n_listed
  c_point_num(:n_listed) = int(point_num(:n_listed), int64) - 1
  options%point_ids = c_loc(c_point_num)
  options%n_threads = n_threads
  arrays%distance = location_of(distance)
  arrays%point = location_of(point)
  arrays%normal = location_of(normal)
  arrays%triangle_id = location_of(triangle_id)
  arrays%leaflet_id = location_of(leaflet_id)
  arrays%side = location_of(side)
  if (distance_limit < huge(distance_limit)) options%distance_limit = distance_limit
  status = riis_closest_points(c_handle_of(surface), points, options, arrays)
end subroutine riisf_closest_points_listed_64

! -----------------------------------------------------------------------------------------------------------------
! Marking
! -----------------------------------------------------------------------------------------------------------------

!> Finds the marked nodes, which lie in the band around the surface (riisf_surface_create), and the nodes within the distance
!! limit. Without an offset, the band holds the nodes whose distance from the surface is at most the half thickness. Distances in
!! double precision decide which nodes are found. Errors: RIIS_INVALID_MESH if a coordinate has become non-finite since the mesh
!! was created or updated.
subroutine riisf_mark_nodes(surface, mesh, distance_limit, search, n_threads, marks, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: RIIS_OK, riis_mark_nodes, riis_mark_options, riis_mark_options_init, riis_marks_create, &
      riis_marks_destroy, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  real(c_double), intent(in) :: distance_limit            !< Nodes get their distance up to this limit; RIIS_AUTO: the half
                                                          !! thickness.
  integer(int32), intent(in) :: search                    !< RIIS_SEARCH_*, usually RIIS_SEARCH_AUTO.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: marks                  !< 0, which creates them, or from an earlier call.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  type(c_ptr) :: c_handle
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%distance_limit = distance_limit
  options%search = search
  options%n_threads = n_threads
  c_handle = c_handle_of(marks)
  if (marks == 0) status = riis_marks_create(c_handle)
  if (status == RIIS_OK) status = riis_mark_nodes(c_handle_of(surface), c_handle_of(mesh), options, c_handle)
  ! The handle stays 0 if it was 0 and an error occurred.
  if (status /= RIIS_OK .and. marks == 0) call riis_marks_destroy(c_handle)
  marks = handle_of(c_handle)
end subroutine riisf_mark_nodes

!> Copies the marked nodes, ascending by node.
subroutine riisf_marked(marks, length, n, node_num, distance, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIMIT_EXCEEDED, RIIS_LIST_MARKED, RIIS_OK, riis_mark_list, &
      riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes, for example.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of nodes that are marked, even if an array is too
                                                          !! short.
  integer(int32), intent(inout) :: node_num(*)            !< (length), from 1; written up to n.
  real(c_double), intent(inout) :: distance(*)            !< (length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  integer(int64), pointer :: c_node_num(:)
  real(c_double), pointer :: c_distance(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int32)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  call c_f_pointer(list%node_id, c_node_num, [list%n_nodes])
  if (maxval(c_node_num) >= huge(n)) then
    status = fail(RIIS_LIMIT_EXCEEDED, 'node ' // text_of(maxval(c_node_num)) // &
        ' is more than an INTEGER*4 can count: use riisf_marked_64')
    return
  end if
  node_num(:n) = int(c_node_num + 1, int32)
  call c_f_pointer(list%distance, c_distance, [list%n_nodes])
  distance(:n) = c_distance
end subroutine riisf_marked

!> Does the same as riisf_marked, with counts and ids of INTEGER*8.
subroutine riisf_marked_64(marks, length, n, node_num, distance, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIST_MARKED, RIIS_OK, riis_mark_list, riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes, for example.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of nodes that are marked, even if an array is too
                                                          !! short.
  integer(int64), intent(inout) :: node_num(*)            !< (length), from 1; written up to n.
  real(c_double), intent(inout) :: distance(*)            !< (length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  integer(int64), pointer :: c_node_num(:)
  real(c_double), pointer :: c_distance(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int64)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  call c_f_pointer(list%node_id, c_node_num, [list%n_nodes])
  node_num(:n) = int(c_node_num + 1, int64)
  call c_f_pointer(list%distance, c_distance, [list%n_nodes])
  distance(:n) = c_distance
end subroutine riisf_marked_64

!> Copies all nodes within the distance limit, marked or not, ascending by node.
subroutine riisf_within_limit(marks, length, n, node_num, distance, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIMIT_EXCEEDED, RIIS_LIST_WITHIN_LIMIT, RIIS_OK, riis_mark_list, &
      riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes, for example.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of nodes within the distance limit, even if an array is
                                                          !! too short.
  integer(int32), intent(inout) :: node_num(*)            !< (length), from 1; written up to n.
  real(c_double), intent(inout) :: distance(*)            !< (length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  integer(int64), pointer :: c_node_num(:)
  real(c_double), pointer :: c_distance(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int32)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  call c_f_pointer(list%node_id, c_node_num, [list%n_nodes])
  if (maxval(c_node_num) >= huge(n)) then
    status = fail(RIIS_LIMIT_EXCEEDED, 'node ' // text_of(maxval(c_node_num)) // &
        ' is more than an INTEGER*4 can count: use riisf_within_limit_64')
    return
  end if
  node_num(:n) = int(c_node_num + 1, int32)
  call c_f_pointer(list%distance, c_distance, [list%n_nodes])
  distance(:n) = c_distance
end subroutine riisf_within_limit

!> Does the same as riisf_within_limit, with counts and ids of INTEGER*8.
subroutine riisf_within_limit_64(marks, length, n, node_num, distance, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIST_WITHIN_LIMIT, RIIS_OK, riis_mark_list, riis_marks_get_list, &
      riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes, for example.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of nodes within the distance limit, even if an array is
                                                          !! too short.
  integer(int64), intent(inout) :: node_num(*)            !< (length), from 1; written up to n.
  real(c_double), intent(inout) :: distance(*)            !< (length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  integer(int64), pointer :: c_node_num(:)
  real(c_double), pointer :: c_distance(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int64)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  call c_f_pointer(list%node_id, c_node_num, [list%n_nodes])
  node_num(:n) = int(c_node_num + 1, int64)
  call c_f_pointer(list%distance, c_distance, [list%n_nodes])
  distance(:n) = c_distance
end subroutine riisf_within_limit_64

!> Writes every node's distance. Errors: RIIS_INVALID_ARGUMENT for a bad field; the message names the field.
subroutine riisf_dense_distance(marks, n_nodes, far_distance, distance, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_dense_arrays, riis_dense_arrays_init, riis_marks_get_dense, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes, for example.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: far_distance              !< The number that `distance` gets for nodes that are masked out or
                                                          !! beyond the limit. This number may be NaN, or any value outside [0,
                                                          !! distance limit]. Usually RIIS_FAR_DISTANCE.
  real(c_double), intent(inout) :: distance(*)            !< (n_nodes): the distance for nodes within the distance limit,
                                                          !! far_distance for others.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_dense_arrays) :: arrays
  status = riis_dense_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_nodes = n_nodes
  arrays%far_distance = far_distance
  arrays%distance = location_of(distance)
  status = riis_marks_get_dense(c_handle_of(marks), arrays)
end subroutine riisf_dense_distance

!> Writes every node's closest triangle. Errors: RIIS_INVALID_ARGUMENT for a bad field; the message names the field.
subroutine riisf_dense_triangle(marks, n_nodes, triangle_id, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_dense_arrays, riis_dense_arrays_init, riis_marks_get_dense, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes, for example.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  integer(int64), intent(inout) :: triangle_id(*)         !< (n_nodes): the closest triangle for nodes within the distance
                                                          !! limit, -1 for others.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_dense_arrays) :: arrays
  status = riis_dense_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_nodes = n_nodes
  arrays%triangle_id = location_of(triangle_id)
  status = riis_marks_get_dense(c_handle_of(marks), arrays)
end subroutine riisf_dense_triangle

!> Writes every node's closest leaflet. Errors: RIIS_INVALID_ARGUMENT for a bad field; the message names the field.
subroutine riisf_dense_leaflet(marks, n_nodes, leaflet_id, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_dense_arrays, riis_dense_arrays_init, riis_marks_get_dense, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes, for example.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (n_nodes): the leaflet of this triangle, -1 for others.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_dense_arrays) :: arrays
  status = riis_dense_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_nodes = n_nodes
  arrays%leaflet_id = location_of(leaflet_id)
  status = riis_marks_get_dense(c_handle_of(marks), arrays)
end subroutine riisf_dense_leaflet

!> Writes every node's mark. Errors: RIIS_INVALID_ARGUMENT for a bad field; the message names the field.
subroutine riisf_dense_mark(marks, n_nodes, mark, status)
  use, intrinsic :: iso_c_binding, only: c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_support, only: c_handle_of, out_of_memory
  use riis_c, only: RIIS_OK, riis_dense_arrays, riis_dense_arrays_init, riis_marks_get_dense, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes, for example.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  integer(int32), intent(inout) :: mark(*)                !< (n_nodes): 1 for marked nodes, 0 for others.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int8), allocatable, target :: c_mark(:)
  type(riis_dense_arrays) :: arrays
  integer :: stat
  status = riis_dense_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  allocate (c_mark(max(n_nodes, 1_int32)), stat=stat)
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  arrays%n_nodes = n_nodes
  arrays%mark = c_loc(c_mark)
  status = riis_marks_get_dense(c_handle_of(marks), arrays)
  if (status /= RIIS_OK) return
  mark(:n_nodes) = c_mark(:n_nodes)
end subroutine riisf_dense_mark

!> Destroys the marks and their lists. The handle becomes 0. Nothing happens to a handle that is 0.
subroutine riisf_marks_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: riis_marks_destroy
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_marks_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_marks_destroy

! -----------------------------------------------------------------------------------------------------------------
! Fields of closest points
! -----------------------------------------------------------------------------------------------------------------

!> Marks nodes like riisf_mark_nodes, and the marks also keep fields of the closest points. Errors: RIIS_INVALID_ARGUMENT for
!! fields that the surface lacks, such as RIIS_FIELD_VELOCITY without riisf_surface_update_moving.
subroutine riisf_mark_with_fields(surface, mesh, distance_limit, search, n_threads, fields, marks, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: RIIS_OK, riis_mark_nodes, riis_mark_options, riis_mark_options_init, riis_marks_create, &
      riis_marks_destroy, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  real(c_double), intent(in) :: distance_limit            !< Nodes get their distance up to this limit; RIIS_AUTO: the half
                                                          !! thickness.
  integer(int32), intent(in) :: search                    !< RIIS_SEARCH_*, usually RIIS_SEARCH_AUTO.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(in) :: fields                    !< A sum of RIIS_FIELD_*, for the nodes of riis_mark_list. Usually 0.
  integer(int64), intent(inout) :: marks                  !< 0, which creates them, or from an earlier call.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  type(c_ptr) :: c_handle
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%distance_limit = distance_limit
  options%search = search
  options%n_threads = n_threads
  options%fields = fields
  c_handle = c_handle_of(marks)
  if (marks == 0) status = riis_marks_create(c_handle)
  if (status == RIIS_OK) status = riis_mark_nodes(c_handle_of(surface), c_handle_of(mesh), options, c_handle)
  ! The handle stays 0 if it was 0 and an error occurred.
  if (status /= RIIS_OK .and. marks == 0) call riis_marks_destroy(c_handle)
  marks = handle_of(c_handle)
end subroutine riisf_mark_with_fields

!> Copies a field of the nodes that are marked, in the order of riisf_marked. RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC and
!! _VELOCITY have three values per node, RIIS_FIELD_UV two, RIIS_FIELD_GRADIENT one for each direction. Errors:
!! RIIS_INVALID_ARGUMENT for another field.
subroutine riisf_marked_reals(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_FIELD_BARYCENTRIC, RIIS_FIELD_GRADIENT, RIIS_FIELD_NORMAL, RIIS_FIELD_POINT, RIIS_FIELD_UV, &
      RIIS_FIELD_VELOCITY, RIIS_INVALID_ARGUMENT, RIIS_LIST_MARKED, RIIS_OK, riis_mark_list, riis_marks_get_list, &
      riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of nodes that are marked, even if an array is too
                                                          !! short.
  real(c_double), intent(inout) :: values(*)              !< (3, length), (2, length) for RIIS_FIELD_UV, or (number of
                                                          !! directions, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  type(c_ptr) :: location
  integer(int64) :: n_values
  real(c_double), pointer :: c_values(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_POINT)
    location = list%point
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_NORMAL)
    location = list%normal
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_BARYCENTRIC)
    location = list%barycentric
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_UV)
    location = list%uv
    n_values = 2 * list%n_nodes
  case (RIIS_FIELD_VELOCITY)
    location = list%velocity
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_GRADIENT)
    location = list%distance_gradient
    n_values = list%n_directions * list%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
        '; it must be one of RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC, _UV, _VELOCITY, _GRADIENT')
    return
  end select
  n = int(min(list%n_nodes, int(huge(n), int64)), int32)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(location)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
    return
  end if
  call c_f_pointer(location, c_values, [n_values])
  values(:n_values) = c_values
end subroutine riisf_marked_reals

!> Does the same as riisf_marked_reals, with counts and ids of INTEGER*8.
subroutine riisf_marked_reals_64(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_FIELD_BARYCENTRIC, RIIS_FIELD_GRADIENT, RIIS_FIELD_NORMAL, RIIS_FIELD_POINT, RIIS_FIELD_UV, &
      RIIS_FIELD_VELOCITY, RIIS_INVALID_ARGUMENT, RIIS_LIST_MARKED, RIIS_OK, riis_mark_list, riis_marks_get_list, &
      riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of nodes that are marked, even if an array is too
                                                          !! short.
  real(c_double), intent(inout) :: values(*)              !< (3, length), (2, length) for RIIS_FIELD_UV, or (number of
                                                          !! directions, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  type(c_ptr) :: location
  integer(int64) :: n_values
  real(c_double), pointer :: c_values(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_POINT)
    location = list%point
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_NORMAL)
    location = list%normal
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_BARYCENTRIC)
    location = list%barycentric
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_UV)
    location = list%uv
    n_values = 2 * list%n_nodes
  case (RIIS_FIELD_VELOCITY)
    location = list%velocity
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_GRADIENT)
    location = list%distance_gradient
    n_values = list%n_directions * list%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
        '; it must be one of RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC, _UV, _VELOCITY, _GRADIENT')
    return
  end select
  n = int(min(list%n_nodes, int(huge(n), int64)), int64)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(location)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
    return
  end if
  call c_f_pointer(location, c_values, [n_values])
  values(:n_values) = c_values
end subroutine riisf_marked_reals_64

!> Copies a field of the nodes within the distance limit, in the order of riisf_within_limit. RIIS_FIELD_POINT, _NORMAL,
!! _BARYCENTRIC and _VELOCITY have three values per node, RIIS_FIELD_UV two, RIIS_FIELD_GRADIENT one for each direction. Errors:
!! RIIS_INVALID_ARGUMENT for another field.
subroutine riisf_within_limit_reals(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_FIELD_BARYCENTRIC, RIIS_FIELD_GRADIENT, RIIS_FIELD_NORMAL, RIIS_FIELD_POINT, RIIS_FIELD_UV, &
      RIIS_FIELD_VELOCITY, RIIS_INVALID_ARGUMENT, RIIS_LIST_WITHIN_LIMIT, RIIS_OK, riis_mark_list, &
      riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of nodes within the distance limit, even if an array is
                                                          !! too short.
  real(c_double), intent(inout) :: values(*)              !< (3, length), (2, length) for RIIS_FIELD_UV, or (number of
                                                          !! directions, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  type(c_ptr) :: location
  integer(int64) :: n_values
  real(c_double), pointer :: c_values(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_POINT)
    location = list%point
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_NORMAL)
    location = list%normal
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_BARYCENTRIC)
    location = list%barycentric
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_UV)
    location = list%uv
    n_values = 2 * list%n_nodes
  case (RIIS_FIELD_VELOCITY)
    location = list%velocity
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_GRADIENT)
    location = list%distance_gradient
    n_values = list%n_directions * list%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
        '; it must be one of RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC, _UV, _VELOCITY, _GRADIENT')
    return
  end select
  n = int(min(list%n_nodes, int(huge(n), int64)), int32)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(location)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
    return
  end if
  call c_f_pointer(location, c_values, [n_values])
  values(:n_values) = c_values
end subroutine riisf_within_limit_reals

!> Does the same as riisf_within_limit_reals, with counts and ids of INTEGER*8.
subroutine riisf_within_limit_reals_64(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_FIELD_BARYCENTRIC, RIIS_FIELD_GRADIENT, RIIS_FIELD_NORMAL, RIIS_FIELD_POINT, RIIS_FIELD_UV, &
      RIIS_FIELD_VELOCITY, RIIS_INVALID_ARGUMENT, RIIS_LIST_WITHIN_LIMIT, RIIS_OK, riis_mark_list, &
      riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of nodes within the distance limit, even if an array is
                                                          !! too short.
  real(c_double), intent(inout) :: values(*)              !< (3, length), (2, length) for RIIS_FIELD_UV, or (number of
                                                          !! directions, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  type(c_ptr) :: location
  integer(int64) :: n_values
  real(c_double), pointer :: c_values(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_POINT)
    location = list%point
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_NORMAL)
    location = list%normal
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_BARYCENTRIC)
    location = list%barycentric
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_UV)
    location = list%uv
    n_values = 2 * list%n_nodes
  case (RIIS_FIELD_VELOCITY)
    location = list%velocity
    n_values = 3 * list%n_nodes
  case (RIIS_FIELD_GRADIENT)
    location = list%distance_gradient
    n_values = list%n_directions * list%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
        '; it must be one of RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC, _UV, _VELOCITY, _GRADIENT')
    return
  end select
  n = int(min(list%n_nodes, int(huge(n), int64)), int64)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(location)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
    return
  end if
  call c_f_pointer(location, c_values, [n_values])
  values(:n_values) = c_values
end subroutine riisf_within_limit_reals_64

!> Copies the field RIIS_FIELD_SIDE, RIIS_FIELD_RIM or RIIS_FIELD_PATCH, which has one value per node.
subroutine riisf_marked_integers(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_FIELD_PATCH, RIIS_FIELD_RIM, RIIS_FIELD_SIDE, RIIS_INVALID_ARGUMENT, RIIS_LIST_MARKED, &
      RIIS_OK, riis_mark_list, riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of nodes that are marked, even if an array is too
                                                          !! short.
  integer(int32), intent(inout) :: values(*)              !< (length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  type(c_ptr) :: location
  integer(int64) :: n_values
  integer(int32), pointer :: c_values(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_SIDE)
    location = list%side
    n_values = list%n_nodes
  case (RIIS_FIELD_RIM)
    location = list%rim
    n_values = list%n_nodes
  case (RIIS_FIELD_PATCH)
    location = list%patch_id
    n_values = list%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
        '; it must be one of RIIS_FIELD_SIDE, _RIM, _PATCH')
    return
  end select
  n = int(min(list%n_nodes, int(huge(n), int64)), int32)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(location)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
    return
  end if
  call c_f_pointer(location, c_values, [n_values])
  values(:n_values) = c_values
end subroutine riisf_marked_integers

!> Does the same as riisf_marked_integers, with counts and ids of INTEGER*8.
subroutine riisf_marked_integers_64(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_FIELD_PATCH, RIIS_FIELD_RIM, RIIS_FIELD_SIDE, RIIS_INVALID_ARGUMENT, RIIS_LIST_MARKED, &
      RIIS_OK, riis_mark_list, riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of nodes that are marked, even if an array is too
                                                          !! short.
  integer(int32), intent(inout) :: values(*)              !< (length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  type(c_ptr) :: location
  integer(int64) :: n_values
  integer(int32), pointer :: c_values(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_SIDE)
    location = list%side
    n_values = list%n_nodes
  case (RIIS_FIELD_RIM)
    location = list%rim
    n_values = list%n_nodes
  case (RIIS_FIELD_PATCH)
    location = list%patch_id
    n_values = list%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
        '; it must be one of RIIS_FIELD_SIDE, _RIM, _PATCH')
    return
  end select
  n = int(min(list%n_nodes, int(huge(n), int64)), int64)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(location)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
    return
  end if
  call c_f_pointer(location, c_values, [n_values])
  values(:n_values) = c_values
end subroutine riisf_marked_integers_64

!> Copies the field RIIS_FIELD_SIDE, RIIS_FIELD_RIM or RIIS_FIELD_PATCH, which has one value per node.
subroutine riisf_within_limit_integers(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_FIELD_PATCH, RIIS_FIELD_RIM, RIIS_FIELD_SIDE, RIIS_INVALID_ARGUMENT, RIIS_LIST_WITHIN_LIMIT, &
      RIIS_OK, riis_mark_list, riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of nodes within the distance limit, even if an array is
                                                          !! too short.
  integer(int32), intent(inout) :: values(*)              !< (length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  type(c_ptr) :: location
  integer(int64) :: n_values
  integer(int32), pointer :: c_values(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_SIDE)
    location = list%side
    n_values = list%n_nodes
  case (RIIS_FIELD_RIM)
    location = list%rim
    n_values = list%n_nodes
  case (RIIS_FIELD_PATCH)
    location = list%patch_id
    n_values = list%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
        '; it must be one of RIIS_FIELD_SIDE, _RIM, _PATCH')
    return
  end select
  n = int(min(list%n_nodes, int(huge(n), int64)), int32)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(location)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
    return
  end if
  call c_f_pointer(location, c_values, [n_values])
  values(:n_values) = c_values
end subroutine riisf_within_limit_integers

!> Does the same as riisf_within_limit_integers, with counts and ids of INTEGER*8.
subroutine riisf_within_limit_integers_64(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_FIELD_PATCH, RIIS_FIELD_RIM, RIIS_FIELD_SIDE, RIIS_INVALID_ARGUMENT, RIIS_LIST_WITHIN_LIMIT, &
      RIIS_OK, riis_mark_list, riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of nodes within the distance limit, even if an array is
                                                          !! too short.
  integer(int32), intent(inout) :: values(*)              !< (length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  type(c_ptr) :: location
  integer(int64) :: n_values
  integer(int32), pointer :: c_values(:)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_SIDE)
    location = list%side
    n_values = list%n_nodes
  case (RIIS_FIELD_RIM)
    location = list%rim
    n_values = list%n_nodes
  case (RIIS_FIELD_PATCH)
    location = list%patch_id
    n_values = list%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
        '; it must be one of RIIS_FIELD_SIDE, _RIM, _PATCH')
    return
  end select
  n = int(min(list%n_nodes, int(huge(n), int64)), int64)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(location)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
    return
  end if
  call c_f_pointer(location, c_values, [n_values])
  values(:n_values) = c_values
end subroutine riisf_within_limit_integers_64

! -----------------------------------------------------------------------------------------------------------------
! Resistance
! -----------------------------------------------------------------------------------------------------------------

!> Marks nodes like riisf_mark_with_fields, and also computes K and K u_surface of the nodes in the lists. K u_surface exists if
!! the surface has velocities. Errors: RIIS_INVALID_MESH if a coordinate has become non-finite since the mesh was created or
!! updated.
subroutine riisf_mark_with_resistance(surface, mesh, distance_limit, search, n_threads, fields, R, half_thickness, &
    rim, marks, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: RIIS_OK, riis_mark_nodes, riis_mark_options, riis_mark_options_init, riis_marks_create, &
      riis_marks_destroy, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: mesh                      !< From riisf_mesh_create, for example.
  real(c_double), intent(in) :: distance_limit            !< Nodes get their distance up to this limit; RIIS_AUTO: the half
                                                          !! thickness.
  integer(int32), intent(in) :: search                    !< RIIS_SEARCH_*, usually RIIS_SEARCH_AUTO.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(in) :: fields                    !< A sum of RIIS_FIELD_*, for the nodes of riis_mark_list. Usually 0.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit; RIIS_AUTO: the half thickness.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_*, usually RIIS_RIM_ROUND.
  integer(int64), intent(inout) :: marks                  !< 0, which creates them, or from an earlier call.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  type(riis_resistance), target :: resistance
  type(c_ptr) :: c_handle
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status /= RIIS_OK) return
  options%distance_limit = distance_limit
  options%search = search
  options%n_threads = n_threads
  options%fields = fields
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  options%resistance = c_loc(resistance)
  c_handle = c_handle_of(marks)
  if (marks == 0) status = riis_marks_create(c_handle)
  if (status == RIIS_OK) status = riis_mark_nodes(c_handle_of(surface), c_handle_of(mesh), options, c_handle)
  ! The handle stays 0 if it was 0 and an error occurred.
  if (status /= RIIS_OK .and. marks == 0) call riis_marks_destroy(c_handle)
  marks = handle_of(c_handle)
end subroutine riisf_mark_with_resistance

!> Copies K and K u_surface of the nodes that are marked, in the order of riisf_marked. Without velocities K u_surface is zero.
!! Errors: RIIS_INVALID_ARGUMENT without riisf_mark_with_resistance.
subroutine riisf_marked_resistance(marks, length, n, K, K_u_surface, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIST_MARKED, RIIS_OK, riis_mark_list, riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_resistance.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of nodes that are marked, even if an array is too
                                                          !! short.
  real(c_double), intent(inout) :: K(*)                   !< (length): K of options.resistance; written up to n.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, length): K u_surface; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  real(c_double), pointer :: c_K(:)
  real(c_double), pointer :: c_K_u_surface(:, :)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int32)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(list%K)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'the nodes have no K: mark with riisf_mark_with_resistance')
    return
  end if
  call c_f_pointer(list%K, c_K, [list%n_nodes])
  K(:n) = c_K
  if (c_associated(list%K_u_surface)) then
    call c_f_pointer(list%K_u_surface, c_K_u_surface, [3_int64, list%n_nodes])
    K_u_surface(:, :n) = c_K_u_surface
  else
    K_u_surface(:, :n) = 0
  end if
end subroutine riisf_marked_resistance

!> Does the same as riisf_marked_resistance, with counts and ids of INTEGER*8.
subroutine riisf_marked_resistance_64(marks, length, n, K, K_u_surface, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIST_MARKED, RIIS_OK, riis_mark_list, riis_marks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_resistance.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of nodes that are marked, even if an array is too
                                                          !! short.
  real(c_double), intent(inout) :: K(*)                   !< (length): K of options.resistance; written up to n.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, length): K u_surface; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  real(c_double), pointer :: c_K(:)
  real(c_double), pointer :: c_K_u_surface(:, :)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int64)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(list%K)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'the nodes have no K: mark with riisf_mark_with_resistance')
    return
  end if
  call c_f_pointer(list%K, c_K, [list%n_nodes])
  K(:n) = c_K
  if (c_associated(list%K_u_surface)) then
    call c_f_pointer(list%K_u_surface, c_K_u_surface, [3_int64, list%n_nodes])
    K_u_surface(:, :n) = c_K_u_surface
  else
    K_u_surface(:, :n) = 0
  end if
end subroutine riisf_marked_resistance_64

!> Copies K and K u_surface of the nodes within the distance limit, in the order of riisf_within_limit. Without velocities K
!! u_surface is zero. Errors: RIIS_INVALID_ARGUMENT without riisf_mark_with_resistance.
subroutine riisf_within_limit_resistance(marks, length, n, K, K_u_surface, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIST_WITHIN_LIMIT, RIIS_OK, riis_mark_list, riis_marks_get_list, &
      riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_resistance.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of nodes within the distance limit, even if an array is
                                                          !! too short.
  real(c_double), intent(inout) :: K(*)                   !< (length): K of options.resistance; written up to n.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, length): K u_surface; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  real(c_double), pointer :: c_K(:)
  real(c_double), pointer :: c_K_u_surface(:, :)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int32)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(list%K)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'the nodes have no K: mark with riisf_mark_with_resistance')
    return
  end if
  call c_f_pointer(list%K, c_K, [list%n_nodes])
  K(:n) = c_K
  if (c_associated(list%K_u_surface)) then
    call c_f_pointer(list%K_u_surface, c_K_u_surface, [3_int64, list%n_nodes])
    K_u_surface(:, :n) = c_K_u_surface
  else
    K_u_surface(:, :n) = 0
  end if
end subroutine riisf_within_limit_resistance

!> Does the same as riisf_within_limit_resistance, with counts and ids of INTEGER*8.
subroutine riisf_within_limit_resistance_64(marks, length, n, K, K_u_surface, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIST_WITHIN_LIMIT, RIIS_OK, riis_mark_list, riis_marks_get_list, &
      riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_resistance.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of nodes within the distance limit, even if an array is
                                                          !! too short.
  real(c_double), intent(inout) :: K(*)                   !< (length): K of options.resistance; written up to n.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, length): K u_surface; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  real(c_double), pointer :: c_K(:)
  real(c_double), pointer :: c_K_u_surface(:, :)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int64)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
        text_of(list%n_nodes))
    return
  end if
  if (list%n_nodes == 0) return
  if (.not. c_associated(list%K)) then
    status = fail(RIIS_INVALID_ARGUMENT, 'the nodes have no K: mark with riisf_mark_with_resistance')
    return
  end if
  call c_f_pointer(list%K, c_K, [list%n_nodes])
  K(:n) = c_K
  if (c_associated(list%K_u_surface)) then
    call c_f_pointer(list%K_u_surface, c_K_u_surface, [3_int64, list%n_nodes])
    K_u_surface(:, :n) = c_K_u_surface
  else
    K_u_surface(:, :n) = 0
  end if
end subroutine riisf_within_limit_resistance_64

!> Adds the resistance K = (R / eps) delta(d), so that several valves add up. At a distance d below eps, delta(d) is (1 + cos(pi
!! d / eps)) / (2 eps). Errors: RIIS_INVALID_ARGUMENT if the marks are empty, and if they lack a field that is needed.
subroutine riisf_add_resistance(marks, R, half_thickness, rim, n_nodes, K, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_marks_add_resistance, riis_resistance, riis_resistance_arrays, &
      riis_resistance_arrays_init, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes, for example.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(inout) :: K(*)                   !< (n_nodes): K is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_resistance_arrays) :: arrays
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_resistance_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  arrays%n_nodes = n_nodes
  arrays%K = location_of(K)
  status = riis_marks_add_resistance(c_handle_of(marks), resistance, arrays)
end subroutine riisf_add_resistance

!> Does the same as riisf_add_resistance, with counts and ids of INTEGER*8.
subroutine riisf_add_resistance_64(marks, R, half_thickness, rim, n_nodes, K, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_marks_add_resistance, riis_resistance, riis_resistance_arrays, &
      riis_resistance_arrays_init, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes, for example.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(inout) :: K(*)                   !< (n_nodes): K is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_resistance_arrays) :: arrays
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_resistance_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  arrays%n_nodes = n_nodes
  arrays%K = location_of(K)
  status = riis_marks_add_resistance(c_handle_of(marks), resistance, arrays)
end subroutine riisf_add_resistance_64

!> Adds K like riisf_add_resistance, but for a surface that moves, and also adds K u_surface. A scheme uses (sum of K) u - (sum
!! of K u_surface). Errors: RIIS_INVALID_ARGUMENT if the marks are empty, and if they lack a field that is needed.
subroutine riisf_add_moving_resistance(marks, R, half_thickness, rim, n_nodes, K, K_u_surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_marks_add_resistance, riis_resistance, riis_resistance_arrays, &
      riis_resistance_arrays_init, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_VELOCITY.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(inout) :: K(*)                   !< (n_nodes): K is added.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, n_nodes): K u_surface is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_resistance_arrays) :: arrays
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_resistance_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  arrays%n_nodes = n_nodes
  arrays%K = location_of(K)
  arrays%K_u_surface(1) = location_of(K_u_surface(1, 1))
  arrays%K_u_surface(2) = location_of(K_u_surface(2, 1))
  arrays%K_u_surface(3) = location_of(K_u_surface(3, 1))
  arrays%K_u_surface_stride = 3
  status = riis_marks_add_resistance(c_handle_of(marks), resistance, arrays)
end subroutine riisf_add_moving_resistance

!> Does the same as riisf_add_moving_resistance, with counts and ids of INTEGER*8.
subroutine riisf_add_moving_resistance_64(marks, R, half_thickness, rim, n_nodes, K, K_u_surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_marks_add_resistance, riis_resistance, riis_resistance_arrays, &
      riis_resistance_arrays_init, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_VELOCITY.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(inout) :: K(*)                   !< (n_nodes): K is added.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, n_nodes): K u_surface is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_resistance_arrays) :: arrays
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_resistance_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  arrays%n_nodes = n_nodes
  arrays%K = location_of(K)
  arrays%K_u_surface(1) = location_of(K_u_surface(1, 1))
  arrays%K_u_surface(2) = location_of(K_u_surface(2, 1))
  arrays%K_u_surface(3) = location_of(K_u_surface(3, 1))
  arrays%K_u_surface_stride = 3
  status = riis_marks_add_resistance(c_handle_of(marks), resistance, arrays)
end subroutine riisf_add_moving_resistance_64

!> Adds K like riisf_add_resistance, but for a surface that moves, and also adds K u_surface. A scheme uses (sum of K) u - (sum
!! of K u_surface). Errors: RIIS_INVALID_ARGUMENT if the marks are empty, and if they lack a field that is needed.
subroutine riisf_add_resistance_components(marks, R, half_thickness, rim, n_nodes, K, K_u_x, K_u_y, K_u_z, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_marks_add_resistance, riis_resistance, riis_resistance_arrays, &
      riis_resistance_arrays_init, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_VELOCITY.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(inout) :: K(*)                   !< (n_nodes): K is added.
  real(c_double), intent(inout) :: K_u_x(*)               !< (n_nodes): the x component of K u_surface is added. The rank of
                                                          !! the arrays may be any.
  real(c_double), intent(inout) :: K_u_y(*)               !< (n_nodes): the y component is added.
  real(c_double), intent(inout) :: K_u_z(*)               !< (n_nodes): the z component is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_resistance_arrays) :: arrays
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_resistance_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  arrays%n_nodes = n_nodes
  arrays%K = location_of(K)
  arrays%K_u_surface(1) = location_of(K_u_x)
  arrays%K_u_surface(2) = location_of(K_u_y)
  arrays%K_u_surface(3) = location_of(K_u_z)
  status = riis_marks_add_resistance(c_handle_of(marks), resistance, arrays)
end subroutine riisf_add_resistance_components

!> Does the same as riisf_add_resistance_components, with counts and ids of INTEGER*8.
subroutine riisf_add_resistance_components_64(marks, R, half_thickness, rim, n_nodes, K, K_u_x, K_u_y, K_u_z, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_marks_add_resistance, riis_resistance, riis_resistance_arrays, &
      riis_resistance_arrays_init, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_VELOCITY.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(inout) :: K(*)                   !< (n_nodes): K is added.
  real(c_double), intent(inout) :: K_u_x(*)               !< (n_nodes): the x component of K u_surface is added. The rank of
                                                          !! the arrays may be any.
  real(c_double), intent(inout) :: K_u_y(*)               !< (n_nodes): the y component is added.
  real(c_double), intent(inout) :: K_u_z(*)               !< (n_nodes): the z component is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_resistance_arrays) :: arrays
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_resistance_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  arrays%n_nodes = n_nodes
  arrays%K = location_of(K)
  arrays%K_u_surface(1) = location_of(K_u_x)
  arrays%K_u_surface(2) = location_of(K_u_y)
  arrays%K_u_surface(3) = location_of(K_u_z)
  status = riis_marks_add_resistance(c_handle_of(marks), resistance, arrays)
end subroutine riisf_add_resistance_components_64

!> Adds the force of the flow on the surface: the sum of weight * K * (velocity - u_surface). Ranks sum their forces by a
!! reduction. u_surface is 0 without RIIS_FIELD_VELOCITY. Errors: as riisf_add_resistance. RIIS_INVALID_ARGUMENT also if
!! n_leaflets is too small (the message names the leaflet id), if a leaflet lacks an edge, and if an edge has a coordinate that
!! is not finite or too large.
subroutine riisf_add_reaction(marks, R, half_thickness, rim, n_nodes, velocity, weight, force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes or riisf_mark_with_fields.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(inout) :: force(3)               !< (3): force on the whole surface, in the unit of weight K velocity,
                                                          !! which is N in SI units.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(velocity(1, 1))
  flow%velocity(2) = location_of(velocity(2, 1))
  flow%velocity(3) = location_of(velocity(3, 1))
  flow%velocity_stride = 3
  flow%weight = location_of(weight)
  reaction%force = location_of(force)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_reaction

!> Does the same as riisf_add_reaction, with counts and ids of INTEGER*8.
subroutine riisf_add_reaction_64(marks, R, half_thickness, rim, n_nodes, velocity, weight, force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes or riisf_mark_with_fields.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(inout) :: force(3)               !< (3): force on the whole surface, in the unit of weight K velocity,
                                                          !! which is N in SI units.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(velocity(1, 1))
  flow%velocity(2) = location_of(velocity(2, 1))
  flow%velocity(3) = location_of(velocity(3, 1))
  flow%velocity_stride = 3
  flow%weight = location_of(weight)
  reaction%force = location_of(force)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_reaction_64

!> Adds the force of the flow on the surface: the sum of weight * K * (velocity - u_surface). Ranks sum their forces by a
!! reduction. u_surface is 0 without RIIS_FIELD_VELOCITY. Errors: as riisf_add_resistance. RIIS_INVALID_ARGUMENT also if
!! n_leaflets is too small (the message names the leaflet id), if a leaflet lacks an edge, and if an edge has a coordinate that
!! is not finite or too large.
subroutine riisf_add_reaction_components(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes or riisf_mark_with_fields.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: vx(*)                     !< (n_nodes), the x component of the flow's velocity. Its rank may be
                                                          !! any.
  real(c_double), intent(in) :: vy(*)                     !< (n_nodes), the y component.
  real(c_double), intent(in) :: vz(*)                     !< (n_nodes), the z component.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(inout) :: force(3)               !< (3): force on the whole surface, in the unit of weight K velocity,
                                                          !! which is N in SI units.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(vx)
  flow%velocity(2) = location_of(vy)
  flow%velocity(3) = location_of(vz)
  flow%weight = location_of(weight)
  reaction%force = location_of(force)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_reaction_components

!> Does the same as riisf_add_reaction_components, with counts and ids of INTEGER*8.
subroutine riisf_add_reaction_components_64(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes or riisf_mark_with_fields.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: vx(*)                     !< (n_nodes), the x component of the flow's velocity. Its rank may be
                                                          !! any.
  real(c_double), intent(in) :: vy(*)                     !< (n_nodes), the y component.
  real(c_double), intent(in) :: vz(*)                     !< (n_nodes), the z component.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(inout) :: force(3)               !< (3): force on the whole surface, in the unit of weight K velocity,
                                                          !! which is N in SI units.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(vx)
  flow%velocity(2) = location_of(vy)
  flow%velocity(3) = location_of(vz)
  flow%weight = location_of(weight)
  reaction%force = location_of(force)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_reaction_components_64

!> Adds the force of the flow and its moment about a point, for the whole surface and for each leaflet. The force of a node acts
!! at the closest point of the surface. Ranks pass the same point, and add their sums by a reduction. Errors: as
!! riisf_add_resistance. RIIS_INVALID_ARGUMENT also if n_leaflets is too small (the message names the leaflet id), if a leaflet
!! lacks an edge, and if an edge has a coordinate that is not finite or too large.
subroutine riisf_add_leaflet_reaction(marks, R, half_thickness, rim, n_nodes, velocity, weight, about, n_leaflets, &
    force, moment, leaflet_force, leaflet_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(in) :: about(3)                  !< The reference point of moment and leaflet_moment; each coordinate
                                                          !! at most 1e60 in magnitude. Usually 0.
  integer(int32), intent(in) :: n_leaflets                !< More than the surface's largest leaflet id.
  real(c_double), intent(inout) :: force(3)               !< (3): force on the whole surface, in the unit of weight K velocity,
                                                          !! which is N in SI units.
  real(c_double), intent(inout) :: moment(3)              !< (3): moment on the whole surface.
  real(c_double), intent(inout) :: leaflet_force(3, *)    !< (3, n_leaflets): force on each leaflet. The force from a node acts
                                                          !! on the leaflet riis_mark_list.leaflet_id, even if another leaflet
                                                          !! is equally near.
  real(c_double), intent(inout) :: leaflet_moment(3, *)   !< (3, n_leaflets): moment on each leaflet.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(velocity(1, 1))
  flow%velocity(2) = location_of(velocity(2, 1))
  flow%velocity(3) = location_of(velocity(3, 1))
  flow%velocity_stride = 3
  flow%weight = location_of(weight)
  reaction%about = about
  reaction%n_leaflets = n_leaflets
  reaction%force = location_of(force)
  reaction%moment = location_of(moment)
  reaction%leaflet_force = location_of(leaflet_force)
  reaction%leaflet_moment = location_of(leaflet_moment)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_leaflet_reaction

!> Does the same as riisf_add_leaflet_reaction, with counts and ids of INTEGER*8.
subroutine riisf_add_leaflet_reaction_64(marks, R, half_thickness, rim, n_nodes, velocity, weight, about, n_leaflets, &
    force, moment, leaflet_force, leaflet_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(in) :: about(3)                  !< The reference point of moment and leaflet_moment; each coordinate
                                                          !! at most 1e60 in magnitude. Usually 0.
  integer(int32), intent(in) :: n_leaflets                !< More than the surface's largest leaflet id.
  real(c_double), intent(inout) :: force(3)               !< (3): force on the whole surface, in the unit of weight K velocity,
                                                          !! which is N in SI units.
  real(c_double), intent(inout) :: moment(3)              !< (3): moment on the whole surface.
  real(c_double), intent(inout) :: leaflet_force(3, *)    !< (3, n_leaflets): force on each leaflet. The force from a node acts
                                                          !! on the leaflet riis_mark_list.leaflet_id, even if another leaflet
                                                          !! is equally near.
  real(c_double), intent(inout) :: leaflet_moment(3, *)   !< (3, n_leaflets): moment on each leaflet.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(velocity(1, 1))
  flow%velocity(2) = location_of(velocity(2, 1))
  flow%velocity(3) = location_of(velocity(3, 1))
  flow%velocity_stride = 3
  flow%weight = location_of(weight)
  reaction%about = about
  reaction%n_leaflets = n_leaflets
  reaction%force = location_of(force)
  reaction%moment = location_of(moment)
  reaction%leaflet_force = location_of(leaflet_force)
  reaction%leaflet_moment = location_of(leaflet_moment)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_leaflet_reaction_64

!> Adds the force of the flow and its moment about a point, for the whole surface and for each leaflet. The force of a node acts
!! at the closest point of the surface. Ranks pass the same point, and add their sums by a reduction. Errors: as
!! riisf_add_resistance. RIIS_INVALID_ARGUMENT also if n_leaflets is too small (the message names the leaflet id), if a leaflet
!! lacks an edge, and if an edge has a coordinate that is not finite or too large.
subroutine riisf_add_leaflet_reaction_components(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, about, &
    n_leaflets, force, moment, leaflet_force, leaflet_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: vx(*)                     !< (n_nodes), the x component of the flow's velocity. Its rank may be
                                                          !! any.
  real(c_double), intent(in) :: vy(*)                     !< (n_nodes), the y component.
  real(c_double), intent(in) :: vz(*)                     !< (n_nodes), the z component.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(in) :: about(3)                  !< The reference point of moment and leaflet_moment; each coordinate
                                                          !! at most 1e60 in magnitude. Usually 0.
  integer(int32), intent(in) :: n_leaflets                !< More than the surface's largest leaflet id.
  real(c_double), intent(inout) :: force(3)               !< (3): force on the whole surface, in the unit of weight K velocity,
                                                          !! which is N in SI units.
  real(c_double), intent(inout) :: moment(3)              !< (3): moment on the whole surface.
  real(c_double), intent(inout) :: leaflet_force(3, *)    !< (3, n_leaflets): force on each leaflet. The force from a node acts
                                                          !! on the leaflet riis_mark_list.leaflet_id, even if another leaflet
                                                          !! is equally near.
  real(c_double), intent(inout) :: leaflet_moment(3, *)   !< (3, n_leaflets): moment on each leaflet.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(vx)
  flow%velocity(2) = location_of(vy)
  flow%velocity(3) = location_of(vz)
  flow%weight = location_of(weight)
  reaction%about = about
  reaction%n_leaflets = n_leaflets
  reaction%force = location_of(force)
  reaction%moment = location_of(moment)
  reaction%leaflet_force = location_of(leaflet_force)
  reaction%leaflet_moment = location_of(leaflet_moment)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_leaflet_reaction_components

!> Does the same as riisf_add_leaflet_reaction_components, with counts and ids of INTEGER*8.
subroutine riisf_add_leaflet_reaction_components_64(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, about, &
    n_leaflets, force, moment, leaflet_force, leaflet_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: vx(*)                     !< (n_nodes), the x component of the flow's velocity. Its rank may be
                                                          !! any.
  real(c_double), intent(in) :: vy(*)                     !< (n_nodes), the y component.
  real(c_double), intent(in) :: vz(*)                     !< (n_nodes), the z component.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(in) :: about(3)                  !< The reference point of moment and leaflet_moment; each coordinate
                                                          !! at most 1e60 in magnitude. Usually 0.
  integer(int32), intent(in) :: n_leaflets                !< More than the surface's largest leaflet id.
  real(c_double), intent(inout) :: force(3)               !< (3): force on the whole surface, in the unit of weight K velocity,
                                                          !! which is N in SI units.
  real(c_double), intent(inout) :: moment(3)              !< (3): moment on the whole surface.
  real(c_double), intent(inout) :: leaflet_force(3, *)    !< (3, n_leaflets): force on each leaflet. The force from a node acts
                                                          !! on the leaflet riis_mark_list.leaflet_id, even if another leaflet
                                                          !! is equally near.
  real(c_double), intent(inout) :: leaflet_moment(3, *)   !< (3, n_leaflets): moment on each leaflet.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(vx)
  flow%velocity(2) = location_of(vy)
  flow%velocity(3) = location_of(vz)
  flow%weight = location_of(weight)
  reaction%about = about
  reaction%n_leaflets = n_leaflets
  reaction%force = location_of(force)
  reaction%moment = location_of(moment)
  reaction%leaflet_force = location_of(leaflet_force)
  reaction%leaflet_moment = location_of(leaflet_moment)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_leaflet_reaction_components_64

!> Adds the force of the flow, and its moment about the edge's middle, to edges. The force of a node goes to the edge nearest to
!! its closest point. The sums of edges are loads for tissue codes. They do not model how a membrane carries loads to its edges.
!! Ranks pass the same edges, and add their sums by a reduction. Errors: as riisf_add_resistance. RIIS_INVALID_ARGUMENT also if
!! n_leaflets is too small (the message names the leaflet id), if a leaflet lacks an edge, and if an edge has a coordinate that
!! is not finite or too large.
subroutine riisf_add_edge_reaction(marks, R, half_thickness, rim, n_nodes, velocity, weight, n_edges, edges, &
    edge_leaflet_id, edge_force, edge_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  integer(int32), intent(in) :: n_edges                   !< At least 1.
  real(c_double), intent(in) :: edges(3, 2, *)            !< (3, 2, n_edges): both ends of each edge, for example
                                                          !! riis_attachment.edges; coordinates at most 1e60 in magnitude. An
                                                          !! edge may have length 0.
  integer(int32), intent(in) :: edge_leaflet_id(*)        !< (n_edges): a node's force goes to the nearest edge of its leaflet.
                                                          !! If the first entry is -1, the other entries are not read, and each
                                                          !! edge serves all leaflets.
  real(c_double), intent(inout) :: edge_force(3, *)       !< (3, n_edges): for each edge, the sum of the forces that act at the
                                                          !! edge. The nearest edge is the one nearest to the node's closest
                                                          !! point on the surface. Of equally near edges, the first one counts.
  real(c_double), intent(inout) :: edge_moment(3, *)      !< (3, n_edges): for each edge, the moment of these forces about the
                                                          !! middle of the edge.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(velocity(1, 1))
  flow%velocity(2) = location_of(velocity(2, 1))
  flow%velocity(3) = location_of(velocity(3, 1))
  flow%velocity_stride = 3
  flow%weight = location_of(weight)
  reaction%n_edges = n_edges
  reaction%edges = location_of(edges)
  reaction%edge_force = location_of(edge_force)
  reaction%edge_moment = location_of(edge_moment)
  if (edge_leaflet_id(1) /= -1) reaction%edge_leaflet_id = location_of(edge_leaflet_id)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_edge_reaction

!> Does the same as riisf_add_edge_reaction, with counts and ids of INTEGER*8.
subroutine riisf_add_edge_reaction_64(marks, R, half_thickness, rim, n_nodes, velocity, weight, n_edges, edges, &
    edge_leaflet_id, edge_force, edge_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  integer(int64), intent(in) :: n_edges                   !< At least 1.
  real(c_double), intent(in) :: edges(3, 2, *)            !< (3, 2, n_edges): both ends of each edge, for example
                                                          !! riis_attachment.edges; coordinates at most 1e60 in magnitude. An
                                                          !! edge may have length 0.
  integer(int32), intent(in) :: edge_leaflet_id(*)        !< (n_edges): a node's force goes to the nearest edge of its leaflet.
                                                          !! If the first entry is -1, the other entries are not read, and each
                                                          !! edge serves all leaflets.
  real(c_double), intent(inout) :: edge_force(3, *)       !< (3, n_edges): for each edge, the sum of the forces that act at the
                                                          !! edge. The nearest edge is the one nearest to the node's closest
                                                          !! point on the surface. Of equally near edges, the first one counts.
  real(c_double), intent(inout) :: edge_moment(3, *)      !< (3, n_edges): for each edge, the moment of these forces about the
                                                          !! middle of the edge.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(velocity(1, 1))
  flow%velocity(2) = location_of(velocity(2, 1))
  flow%velocity(3) = location_of(velocity(3, 1))
  flow%velocity_stride = 3
  flow%weight = location_of(weight)
  reaction%n_edges = n_edges
  reaction%edges = location_of(edges)
  reaction%edge_force = location_of(edge_force)
  reaction%edge_moment = location_of(edge_moment)
  if (edge_leaflet_id(1) /= -1) reaction%edge_leaflet_id = location_of(edge_leaflet_id)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_edge_reaction_64

!> Adds the force of the flow, and its moment about the edge's middle, to edges. The force of a node goes to the edge nearest to
!! its closest point. The sums of edges are loads for tissue codes. They do not model how a membrane carries loads to its edges.
!! Ranks pass the same edges, and add their sums by a reduction. Errors: as riisf_add_resistance. RIIS_INVALID_ARGUMENT also if
!! n_leaflets is too small (the message names the leaflet id), if a leaflet lacks an edge, and if an edge has a coordinate that
!! is not finite or too large.
subroutine riisf_add_edge_reaction_components(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, n_edges, &
    edges, edge_leaflet_id, edge_force, edge_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: vx(*)                     !< (n_nodes), the x component of the flow's velocity. Its rank may be
                                                          !! any.
  real(c_double), intent(in) :: vy(*)                     !< (n_nodes), the y component.
  real(c_double), intent(in) :: vz(*)                     !< (n_nodes), the z component.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  integer(int32), intent(in) :: n_edges                   !< At least 1.
  real(c_double), intent(in) :: edges(3, 2, *)            !< (3, 2, n_edges): both ends of each edge, for example
                                                          !! riis_attachment.edges; coordinates at most 1e60 in magnitude. An
                                                          !! edge may have length 0.
  integer(int32), intent(in) :: edge_leaflet_id(*)        !< (n_edges): a node's force goes to the nearest edge of its leaflet.
                                                          !! If the first entry is -1, the other entries are not read, and each
                                                          !! edge serves all leaflets.
  real(c_double), intent(inout) :: edge_force(3, *)       !< (3, n_edges): for each edge, the sum of the forces that act at the
                                                          !! edge. The nearest edge is the one nearest to the node's closest
                                                          !! point on the surface. Of equally near edges, the first one counts.
  real(c_double), intent(inout) :: edge_moment(3, *)      !< (3, n_edges): for each edge, the moment of these forces about the
                                                          !! middle of the edge.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(vx)
  flow%velocity(2) = location_of(vy)
  flow%velocity(3) = location_of(vz)
  flow%weight = location_of(weight)
  reaction%n_edges = n_edges
  reaction%edges = location_of(edges)
  reaction%edge_force = location_of(edge_force)
  reaction%edge_moment = location_of(edge_moment)
  if (edge_leaflet_id(1) /= -1) reaction%edge_leaflet_id = location_of(edge_leaflet_id)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_edge_reaction_components

!> Does the same as riisf_add_edge_reaction_components, with counts and ids of INTEGER*8.
subroutine riisf_add_edge_reaction_components_64(marks, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, n_edges, &
    edges, edge_leaflet_id, edge_force, edge_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_reaction, riis_reaction, &
      riis_reaction_init, riis_resistance, riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: vx(*)                     !< (n_nodes), the x component of the flow's velocity. Its rank may be
                                                          !! any.
  real(c_double), intent(in) :: vy(*)                     !< (n_nodes), the y component.
  real(c_double), intent(in) :: vz(*)                     !< (n_nodes), the z component.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  integer(int64), intent(in) :: n_edges                   !< At least 1.
  real(c_double), intent(in) :: edges(3, 2, *)            !< (3, 2, n_edges): both ends of each edge, for example
                                                          !! riis_attachment.edges; coordinates at most 1e60 in magnitude. An
                                                          !! edge may have length 0.
  integer(int32), intent(in) :: edge_leaflet_id(*)        !< (n_edges): a node's force goes to the nearest edge of its leaflet.
                                                          !! If the first entry is -1, the other entries are not read, and each
                                                          !! edge serves all leaflets.
  real(c_double), intent(inout) :: edge_force(3, *)       !< (3, n_edges): for each edge, the sum of the forces that act at the
                                                          !! edge. The nearest edge is the one nearest to the node's closest
                                                          !! point on the surface. Of equally near edges, the first one counts.
  real(c_double), intent(inout) :: edge_moment(3, *)      !< (3, n_edges): for each edge, the moment of these forces about the
                                                          !! middle of the edge.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  type(riis_reaction) :: reaction
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status == RIIS_OK) status = riis_reaction_init(reaction, c_sizeof(reaction))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(vx)
  flow%velocity(2) = location_of(vy)
  flow%velocity(3) = location_of(vz)
  flow%weight = location_of(weight)
  reaction%n_edges = n_edges
  reaction%edges = location_of(edges)
  reaction%edge_force = location_of(edge_force)
  reaction%edge_moment = location_of(edge_moment)
  if (edge_leaflet_id(1) /= -1) reaction%edge_leaflet_id = location_of(edge_leaflet_id)
  status = riis_marks_add_reaction(c_handle_of(marks), resistance, flow, reaction)
end subroutine riisf_add_edge_reaction_components_64

!> Adds to an array the force of the flow on each vertex of the surface, so that a code for shells can move the leaflets. Errors:
!! as riisf_add_reaction. RIIS_INVALID_ARGUMENT also if the marks lack RIIS_FIELD_BARYCENTRIC, if n_vertices is wrong, and if the
!! closest triangle of a node is not in the surface.
subroutine riisf_add_vertex_reaction(marks, surface, R, half_thickness, rim, n_nodes, velocity, weight, n_vertices, &
    vertex_force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_vertex_reaction, riis_resistance, &
      riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_BARYCENTRIC.
  integer(int64), intent(in) :: surface                   !< The surface of the marking. The surface must not have been updated
                                                          !! since the marking.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  integer(int32), intent(in) :: n_vertices                !< The surface's number of vertices.
  real(c_double), intent(inout) :: vertex_force(3, *)     !< (3, n_vertices): the array to which the forces are added. The
                                                          !! force from a node is divided among the three vertices of the
                                                          !! node's closest triangle, in proportion to the barycentric
                                                          !! coordinates of the closest point.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(velocity(1, 1))
  flow%velocity(2) = location_of(velocity(2, 1))
  flow%velocity(3) = location_of(velocity(3, 1))
  flow%velocity_stride = 3
  flow%weight = location_of(weight)
  status = riis_marks_add_vertex_reaction(c_handle_of(marks), c_handle_of(surface), resistance, flow, int(n_vertices, &
      int64), vertex_force)
end subroutine riisf_add_vertex_reaction

!> Does the same as riisf_add_vertex_reaction, with counts and ids of INTEGER*8.
subroutine riisf_add_vertex_reaction_64(marks, surface, R, half_thickness, rim, n_nodes, velocity, weight, n_vertices, &
    vertex_force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_vertex_reaction, riis_resistance, &
      riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_BARYCENTRIC.
  integer(int64), intent(in) :: surface                   !< The surface of the marking. The surface must not have been updated
                                                          !! since the marking.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  integer(int64), intent(in) :: n_vertices                !< The surface's number of vertices.
  real(c_double), intent(inout) :: vertex_force(3, *)     !< (3, n_vertices): the array to which the forces are added. The
                                                          !! force from a node is divided among the three vertices of the
                                                          !! node's closest triangle, in proportion to the barycentric
                                                          !! coordinates of the closest point.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(velocity(1, 1))
  flow%velocity(2) = location_of(velocity(2, 1))
  flow%velocity(3) = location_of(velocity(3, 1))
  flow%velocity_stride = 3
  flow%weight = location_of(weight)
  status = riis_marks_add_vertex_reaction(c_handle_of(marks), c_handle_of(surface), resistance, flow, n_vertices, &
      vertex_force)
end subroutine riisf_add_vertex_reaction_64

!> Adds to an array the force of the flow on each vertex of the surface, so that a code for shells can move the leaflets. Errors:
!! as riisf_add_reaction. RIIS_INVALID_ARGUMENT also if the marks lack RIIS_FIELD_BARYCENTRIC, if n_vertices is wrong, and if the
!! closest triangle of a node is not in the surface.
subroutine riisf_add_vertex_reaction_components(marks, surface, R, half_thickness, rim, n_nodes, vx, vy, vz, weight, &
    n_vertices, vertex_force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_vertex_reaction, riis_resistance, &
      riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_BARYCENTRIC.
  integer(int64), intent(in) :: surface                   !< The surface of the marking. The surface must not have been updated
                                                          !! since the marking.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: vx(*)                     !< (n_nodes), the x component of the flow's velocity. Its rank may be
                                                          !! any.
  real(c_double), intent(in) :: vy(*)                     !< (n_nodes), the y component.
  real(c_double), intent(in) :: vz(*)                     !< (n_nodes), the z component.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  integer(int32), intent(in) :: n_vertices                !< The surface's number of vertices.
  real(c_double), intent(inout) :: vertex_force(3, *)     !< (3, n_vertices): the array to which the forces are added. The
                                                          !! force from a node is divided among the three vertices of the
                                                          !! node's closest triangle, in proportion to the barycentric
                                                          !! coordinates of the closest point.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(vx)
  flow%velocity(2) = location_of(vy)
  flow%velocity(3) = location_of(vz)
  flow%weight = location_of(weight)
  status = riis_marks_add_vertex_reaction(c_handle_of(marks), c_handle_of(surface), resistance, flow, int(n_vertices, &
      int64), vertex_force)
end subroutine riisf_add_vertex_reaction_components

!> Does the same as riisf_add_vertex_reaction_components, with counts and ids of INTEGER*8.
subroutine riisf_add_vertex_reaction_components_64(marks, surface, R, half_thickness, rim, n_nodes, vx, vy, vz, &
    weight, n_vertices, vertex_force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_flow_arrays, riis_flow_arrays_init, riis_marks_add_vertex_reaction, riis_resistance, &
      riis_resistance_init, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_BARYCENTRIC.
  integer(int64), intent(in) :: surface                   !< The surface of the marking. The surface must not have been updated
                                                          !! since the marking.
  real(c_double), intent(in) :: R                         !< The resistance, 0 or 1e-300 to 1e60, in mass / (length time), such
                                                          !! as kg/(m s). In a flow of velocity u, the pressure drop across a
                                                          !! flat closed valve is (R / eps) u.
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking divided by 1 +
                                                          !! |offset|; RIIS_AUTO: the half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: vx(*)                     !< (n_nodes), the x component of the flow's velocity. Its rank may be
                                                          !! any.
  real(c_double), intent(in) :: vy(*)                     !< (n_nodes), the y component.
  real(c_double), intent(in) :: vz(*)                     !< (n_nodes), the z component.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  integer(int64), intent(in) :: n_vertices                !< The surface's number of vertices.
  real(c_double), intent(inout) :: vertex_force(3, *)     !< (3, n_vertices): the array to which the forces are added. The
                                                          !! force from a node is divided among the three vertices of the
                                                          !! node's closest triangle, in proportion to the barycentric
                                                          !! coordinates of the closest point.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_flow_arrays) :: flow
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status == RIIS_OK) status = riis_flow_arrays_init(flow, c_sizeof(flow))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  flow%n_nodes = n_nodes
  flow%velocity(1) = location_of(vx)
  flow%velocity(2) = location_of(vy)
  flow%velocity(3) = location_of(vz)
  flow%weight = location_of(weight)
  status = riis_marks_add_vertex_reaction(c_handle_of(marks), c_handle_of(surface), resistance, flow, n_vertices, &
      vertex_force)
end subroutine riisf_add_vertex_reaction_components_64

!> Gives the sums of a value over the nodes in the band, for each side of the surface. Nodes whose closest point is on the rim
!! and nodes with side 0 are left out. For an open valve, the two sides have no meaning. If the surface has an offset o,
!! distances and sides refer to the middle of the marked band instead of the surface. Let s be the signed distance of a node, and
!! eps the half thickness of the marking. Then |s - o eps| is the distance of the node, and the sign of s - o eps is its side.
!! Errors: RIIS_INVALID_ARGUMENT also if the marks lack a field.
subroutine riisf_band_sums(marks, inner, outer, n_nodes, value, weight, sum_of_values, sum_of_weights, n_in_band, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_band, riis_band_init, riis_band_sums, riis_marks_get_band_sums, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_SIDE and _RIM.
  real(c_double), intent(in) :: inner                     !< inner, outer: the band holds the nodes with distances from inner
                                                          !! to outer, where 0 <= inner <= outer. Let o be the offset of the
                                                          !! surface, and eps the half thickness: outer + |o| eps must be at
                                                          !! most the marking's distance limit. Usually 0.
  real(c_double), intent(in) :: outer                     !< inner, outer: the band holds the nodes with distances from inner
                                                          !! to outer, where 0 <= inner <= outer. Let o be the offset of the
                                                          !! surface, and eps the half thickness: outer + |o| eps must be at
                                                          !! most the marking's distance limit. Usually 0.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: value(*)                  !< (n_nodes): the value at each node, such as the pressure.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(inout) :: sum_of_values(2)       !< The sum of weight * value: 1 is upstream, 2 downstream.
  real(c_double), intent(inout) :: sum_of_weights(2)      !< The sum of weight.
  integer(int64), intent(inout) :: n_in_band(2)           !< The number of nodes in the band.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_band) :: band
  type(riis_band_sums) :: sums
  status = riis_band_init(band, c_sizeof(band))
  if (status /= RIIS_OK) return
  band%inner = inner
  band%outer = outer
  band%n_nodes = n_nodes
  band%value = location_of(value)
  band%weight = location_of(weight)
  status = riis_marks_get_band_sums(c_handle_of(marks), band, sums, c_sizeof(sums))
  if (status /= RIIS_OK) return
  sum_of_values = sums%sum
  sum_of_weights = sums%weight
  n_in_band = sums%n_nodes
end subroutine riisf_band_sums

!> Does the same as riisf_band_sums, with counts and ids of INTEGER*8.
subroutine riisf_band_sums_64(marks, inner, outer, n_nodes, value, weight, sum_of_values, sum_of_weights, n_in_band, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_band, riis_band_init, riis_band_sums, riis_marks_get_band_sums, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_SIDE and _RIM.
  real(c_double), intent(in) :: inner                     !< inner, outer: the band holds the nodes with distances from inner
                                                          !! to outer, where 0 <= inner <= outer. Let o be the offset of the
                                                          !! surface, and eps the half thickness: outer + |o| eps must be at
                                                          !! most the marking's distance limit. Usually 0.
  real(c_double), intent(in) :: outer                     !< inner, outer: the band holds the nodes with distances from inner
                                                          !! to outer, where 0 <= inner <= outer. Let o be the offset of the
                                                          !! surface, and eps the half thickness: outer + |o| eps must be at
                                                          !! most the marking's distance limit. Usually 0.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: value(*)                  !< (n_nodes): the value at each node, such as the pressure.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the volume around each node, 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(inout) :: sum_of_values(2)       !< The sum of weight * value: 1 is upstream, 2 downstream.
  real(c_double), intent(inout) :: sum_of_weights(2)      !< The sum of weight.
  integer(int64), intent(inout) :: n_in_band(2)           !< The number of nodes in the band.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_band) :: band
  type(riis_band_sums) :: sums
  status = riis_band_init(band, c_sizeof(band))
  if (status /= RIIS_OK) return
  band%inner = inner
  band%outer = outer
  band%n_nodes = n_nodes
  band%value = location_of(value)
  band%weight = location_of(weight)
  status = riis_marks_get_band_sums(c_handle_of(marks), band, sums, c_sizeof(sums))
  if (status /= RIIS_OK) return
  sum_of_values = sums%sum
  sum_of_weights = sums%weight
  n_in_band = sums%n_nodes
end subroutine riisf_band_sums_64

! -----------------------------------------------------------------------------------------------------------------
! Loads of tissue
! -----------------------------------------------------------------------------------------------------------------

!> Computes sums over nodes of tissue for riisf_loads_forces, and adds them to an array. Errors: RIIS_INVALID_ARGUMENT for a bad
!! field, edge, node or weight; the message names the bad entry and its value.
subroutine riisf_loads_sums(radius, n_edges, edges, edge_leaflet_id, n_nodes, xyz, weight, n_leaflets, sums, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32
  use riis_support, only: location_of
  use riis_c, only: RIIS_OK, riis_loads, riis_loads_add_sums, riis_loads_init, riis_points, riis_points_init, &
      riis_status
  implicit none
  real(c_double), intent(in) :: radius                    !< Mesh units, 1e-50 to 1e50. The force of a leaflet acts at the
                                                          !! nodes whose distance from the leaflet's edges is below the radius.
  integer(int32), intent(in) :: n_edges                   !< At least 1.
  real(c_double), intent(in) :: edges(3, 2, *)            !< (3, 2, n_edges): both ends of each edge, for example
                                                          !! riis_attachment.edges; coordinates at most 1e60 in magnitude. An
                                                          !! edge may have length 0.
  integer(int32), intent(in) :: edge_leaflet_id(*)        !< (n_edges): the leaflet that the edge holds. If the first entry is
                                                          !! -1, the other entries are not read, and each edge holds all
                                                          !! leaflets.
  integer(int32), intent(in) :: n_nodes                   !< 0 to 2^40.
  real(c_double), intent(in) :: xyz(3, *)                 !< (3, n_nodes): the points, in mesh units.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the area or volume around each node, 0 to 1e60; 0 for
                                                          !! nodes of other ranks.
  integer(int32), intent(in) :: n_leaflets                !< More than the surface's largest leaflet id.
  real(c_double), intent(inout) :: sums(11, *)            !< (11, n_leaflets): the array to which the sums are added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_loads) :: loads
  type(riis_points) :: nodes
  status = riis_loads_init(loads, c_sizeof(loads))
  if (status == RIIS_OK) status = riis_points_init(nodes, c_sizeof(nodes))
  if (status /= RIIS_OK) return
  loads%radius = radius
  loads%n_edges = n_edges
  loads%edges = location_of(edges)
  nodes%n_points = n_nodes
  nodes%x = location_of(xyz(1, 1))
  nodes%y = location_of(xyz(2, 1))
  nodes%z = location_of(xyz(3, 1))
  nodes%stride = 3
  loads%n_leaflets = n_leaflets
  if (edge_leaflet_id(1) /= -1) loads%edge_leaflet_id = location_of(edge_leaflet_id)
  status = riis_loads_add_sums(loads, nodes, weight, sums)
end subroutine riisf_loads_sums

!> Does the same as riisf_loads_sums, with counts and ids of INTEGER*8.
subroutine riisf_loads_sums_64(radius, n_edges, edges, edge_leaflet_id, n_nodes, xyz, weight, n_leaflets, sums, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: location_of
  use riis_c, only: RIIS_OK, riis_loads, riis_loads_add_sums, riis_loads_init, riis_points, riis_points_init, &
      riis_status
  implicit none
  real(c_double), intent(in) :: radius                    !< Mesh units, 1e-50 to 1e50. The force of a leaflet acts at the
                                                          !! nodes whose distance from the leaflet's edges is below the radius.
  integer(int64), intent(in) :: n_edges                   !< At least 1.
  real(c_double), intent(in) :: edges(3, 2, *)            !< (3, 2, n_edges): both ends of each edge, for example
                                                          !! riis_attachment.edges; coordinates at most 1e60 in magnitude. An
                                                          !! edge may have length 0.
  integer(int32), intent(in) :: edge_leaflet_id(*)        !< (n_edges): the leaflet that the edge holds. If the first entry is
                                                          !! -1, the other entries are not read, and each edge holds all
                                                          !! leaflets.
  integer(int64), intent(in) :: n_nodes                   !< 0 to 2^40.
  real(c_double), intent(in) :: xyz(3, *)                 !< (3, n_nodes): the points, in mesh units.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes): the area or volume around each node, 0 to 1e60; 0 for
                                                          !! nodes of other ranks.
  integer(int64), intent(in) :: n_leaflets                !< More than the surface's largest leaflet id.
  real(c_double), intent(inout) :: sums(11, *)            !< (11, n_leaflets): the array to which the sums are added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_loads) :: loads
  type(riis_points) :: nodes
  status = riis_loads_init(loads, c_sizeof(loads))
  if (status == RIIS_OK) status = riis_points_init(nodes, c_sizeof(nodes))
  if (status /= RIIS_OK) return
  loads%radius = radius
  loads%n_edges = n_edges
  loads%edges = location_of(edges)
  nodes%n_points = n_nodes
  nodes%x = location_of(xyz(1, 1))
  nodes%y = location_of(xyz(2, 1))
  nodes%z = location_of(xyz(3, 1))
  nodes%stride = 3
  loads%n_leaflets = n_leaflets
  if (edge_leaflet_id(1) /= -1) loads%edge_leaflet_id = location_of(edge_leaflet_id)
  status = riis_loads_add_sums(loads, nodes, weight, sums)
end subroutine riisf_loads_sums_64

!> Adds to an array the forces of the leaflets at nodes of tissue. Up to rounding, the forces of a leaflet have the sum
!! leaflet_force and the moment leaflet_moment. Errors: as riisf_loads_sums. RIIS_INVALID_ARGUMENT also if a leaflet with a force
!! has fewer than three nodes within the radius, or only nodes that lie nearly on a line. Let r be the root-mean-square distance
!! of these nodes from the line. The nodes are too near the line if r is less than a hundredth of the root-mean-square distance
!! of the nodes from their middle. The nodes are also too near the line if r is less than a thousandth of the size of the edges
!! (docs/theory/loads.md).
subroutine riisf_loads_forces(radius, n_edges, edges, edge_leaflet_id, n_nodes, xyz, weight, n_leaflets, about, &
    leaflet_force, leaflet_moment, sums, node_force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32
  use riis_support, only: location_of
  use riis_c, only: RIIS_OK, riis_loads, riis_loads_add_forces, riis_loads_init, riis_points, riis_points_init, &
      riis_status
  implicit none
  real(c_double), intent(in) :: radius                    !< Mesh units, 1e-50 to 1e50. The force of a leaflet acts at the
                                                          !! nodes whose distance from the leaflet's edges is below the radius.
  integer(int32), intent(in) :: n_edges                   !< At least 1.
  real(c_double), intent(in) :: edges(3, 2, *)            !< (3, 2, n_edges): both ends of each edge, for example
                                                          !! riis_attachment.edges; coordinates at most 1e60 in magnitude. An
                                                          !! edge may have length 0.
  integer(int32), intent(in) :: edge_leaflet_id(*)        !< (n_edges): the leaflet that the edge holds. If the first entry is
                                                          !! -1, the other entries are not read, and each edge holds all
                                                          !! leaflets.
  integer(int32), intent(in) :: n_nodes                   !< 0 to 2^40.
  real(c_double), intent(in) :: xyz(3, *)                 !< (3, n_nodes): the points, in mesh units.
  real(c_double), intent(in) :: weight(*)                 !< As in riisf_loads_sums.
  integer(int32), intent(in) :: n_leaflets                !< More than the surface's largest leaflet id.
  real(c_double), intent(in) :: about(3)                  !< The reference point of leaflet_moment; each coordinate at most
                                                          !! 1e60 in magnitude. Usually 0.
  real(c_double), intent(in) :: leaflet_force(3, *)       !< (3, n_leaflets): from riisf_add_leaflet_reaction, the sum over all
                                                          !! ranks.
  real(c_double), intent(in) :: leaflet_moment(3, *)      !< (3, n_leaflets): from riisf_add_leaflet_reaction, the sum over all
                                                          !! ranks.
  real(c_double), intent(in) :: sums(11, *)               !< (11, n_leaflets): the sums of riisf_loads_sums, added up over all
                                                          !! ranks.
  real(c_double), intent(inout) :: node_force(3, *)       !< (3, n_nodes): the array to which the forces are added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_loads) :: loads
  type(riis_points) :: nodes
  status = riis_loads_init(loads, c_sizeof(loads))
  if (status == RIIS_OK) status = riis_points_init(nodes, c_sizeof(nodes))
  if (status /= RIIS_OK) return
  loads%radius = radius
  loads%n_edges = n_edges
  loads%edges = location_of(edges)
  nodes%n_points = n_nodes
  nodes%x = location_of(xyz(1, 1))
  nodes%y = location_of(xyz(2, 1))
  nodes%z = location_of(xyz(3, 1))
  nodes%stride = 3
  loads%n_leaflets = n_leaflets
  loads%about = about
  loads%leaflet_force = location_of(leaflet_force)
  loads%leaflet_moment = location_of(leaflet_moment)
  if (edge_leaflet_id(1) /= -1) loads%edge_leaflet_id = location_of(edge_leaflet_id)
  status = riis_loads_add_forces(loads, nodes, weight, sums, node_force)
end subroutine riisf_loads_forces

!> Does the same as riisf_loads_forces, with counts and ids of INTEGER*8.
subroutine riisf_loads_forces_64(radius, n_edges, edges, edge_leaflet_id, n_nodes, xyz, weight, n_leaflets, about, &
    leaflet_force, leaflet_moment, sums, node_force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: location_of
  use riis_c, only: RIIS_OK, riis_loads, riis_loads_add_forces, riis_loads_init, riis_points, riis_points_init, &
      riis_status
  implicit none
  real(c_double), intent(in) :: radius                    !< Mesh units, 1e-50 to 1e50. The force of a leaflet acts at the
                                                          !! nodes whose distance from the leaflet's edges is below the radius.
  integer(int64), intent(in) :: n_edges                   !< At least 1.
  real(c_double), intent(in) :: edges(3, 2, *)            !< (3, 2, n_edges): both ends of each edge, for example
                                                          !! riis_attachment.edges; coordinates at most 1e60 in magnitude. An
                                                          !! edge may have length 0.
  integer(int32), intent(in) :: edge_leaflet_id(*)        !< (n_edges): the leaflet that the edge holds. If the first entry is
                                                          !! -1, the other entries are not read, and each edge holds all
                                                          !! leaflets.
  integer(int64), intent(in) :: n_nodes                   !< 0 to 2^40.
  real(c_double), intent(in) :: xyz(3, *)                 !< (3, n_nodes): the points, in mesh units.
  real(c_double), intent(in) :: weight(*)                 !< As in riisf_loads_sums.
  integer(int64), intent(in) :: n_leaflets                !< More than the surface's largest leaflet id.
  real(c_double), intent(in) :: about(3)                  !< The reference point of leaflet_moment; each coordinate at most
                                                          !! 1e60 in magnitude. Usually 0.
  real(c_double), intent(in) :: leaflet_force(3, *)       !< (3, n_leaflets): from riisf_add_leaflet_reaction, the sum over all
                                                          !! ranks.
  real(c_double), intent(in) :: leaflet_moment(3, *)      !< (3, n_leaflets): from riisf_add_leaflet_reaction, the sum over all
                                                          !! ranks.
  real(c_double), intent(in) :: sums(11, *)               !< (11, n_leaflets): the sums of riisf_loads_sums, added up over all
                                                          !! ranks.
  real(c_double), intent(inout) :: node_force(3, *)       !< (3, n_nodes): the array to which the forces are added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_loads) :: loads
  type(riis_points) :: nodes
  status = riis_loads_init(loads, c_sizeof(loads))
  if (status == RIIS_OK) status = riis_points_init(nodes, c_sizeof(nodes))
  if (status /= RIIS_OK) return
  loads%radius = radius
  loads%n_edges = n_edges
  loads%edges = location_of(edges)
  nodes%n_points = n_nodes
  nodes%x = location_of(xyz(1, 1))
  nodes%y = location_of(xyz(2, 1))
  nodes%z = location_of(xyz(3, 1))
  nodes%stride = 3
  loads%n_leaflets = n_leaflets
  loads%about = about
  loads%leaflet_force = location_of(leaflet_force)
  loads%leaflet_moment = location_of(leaflet_moment)
  if (edge_leaflet_id(1) /= -1) loads%edge_leaflet_id = location_of(edge_leaflet_id)
  status = riis_loads_add_forces(loads, nodes, weight, sums, node_force)
end subroutine riisf_loads_forces_64

! -----------------------------------------------------------------------------------------------------------------
! Leaks
! -----------------------------------------------------------------------------------------------------------------

!> Finds the mesh edges that leak through the surface. An edge of the mesh's adjacency leaks if its two nodes are unmarked and
!! the edge crosses or touches a triangle of the surface. Errors: RIIS_INVALID_ARGUMENT if the mesh has no adjacency, if the
!! marks are empty, if the marks and the mesh differ in the number of nodes, and if the marks and the surface differ in the half
!! thickness. RIIS_INVALID_MESH as riisf_mark_nodes.
subroutine riisf_find_leaks(surface, mesh, marks, n_threads, leaks, n_edges, longest, middle, half_thickness, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: RIIS_OK, riis_find_leaks, riis_leak_list, riis_leaks_create, riis_leaks_destroy, &
      riis_leaks_get_list, riis_mark_options, riis_mark_options_init, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< The surface and the mesh of the marking. The mesh must have an
                                                          !! adjacency.
  integer(int64), intent(in) :: mesh                      !< The surface and the mesh of the marking. The mesh must have an
                                                          !! adjacency.
  integer(int64), intent(in) :: marks                     !< Marks from riisf_mark_nodes.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: leaks                  !< 0, which creates them, or from an earlier call.
  integer(int64), intent(inout) :: n_edges                !< The number of edges that leak. If n_edges is 0, the node ids are
                                                          !! -1, and all other fields except seconds are 0.
  real(c_double), intent(inout) :: longest                !< The length of the longest edge; 0 if none leaks.
  real(c_double), intent(inout) :: middle(3)              !< The middle of the longest edge.
  real(c_double), intent(inout) :: half_thickness         !< The least half thickness with which each edge of the list has a
                                                          !! marked node, for the present triangles.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  type(riis_leak_list) :: list
  type(c_ptr) :: c_handle
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%n_threads = n_threads
  c_handle = c_handle_of(leaks)
  if (leaks == 0) status = riis_leaks_create(c_handle)
  if (status == RIIS_OK) status = riis_find_leaks(c_handle_of(surface), c_handle_of(mesh), c_handle_of(marks), &
      options, c_handle)
  if (status == RIIS_OK) status = riis_leaks_get_list(c_handle, list, c_sizeof(list))
  ! The handle stays 0 if it was 0 and an error occurred.
  if (status /= RIIS_OK .and. leaks == 0) call riis_leaks_destroy(c_handle)
  leaks = handle_of(c_handle)
  if (status /= RIIS_OK) return
  n_edges = list%n_edges
  longest = list%longest_length
  middle = list%longest_middle
  half_thickness = list%half_thickness
end subroutine riisf_find_leaks

!> Copies the edges of the last riisf_find_leaks, ascending.
subroutine riisf_leaking_edges(leaks, length, n, node_num, status)
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIMIT_EXCEEDED, RIIS_OK, riis_leak_list, riis_leaks_get_list, &
      riis_status
  implicit none
  integer(int64), intent(in) :: leaks                     !< From riisf_find_leaks, for example.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of edges that leak, even if an array is too short.
  integer(int32), intent(inout) :: node_num(2, *)         !< (2, length): the two nodes, the lower id first, from 1; written up
                                                          !! to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_leak_list) :: list
  integer(int64), pointer :: c_node_num(:, :)
  status = riis_leaks_get_list(c_handle_of(leaks), list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_edges, int(huge(n), int64)), int32)
  if (list%n_edges > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; edges that leak: ' // &
        text_of(list%n_edges))
    return
  end if
  if (list%n_edges == 0) return
  call c_f_pointer(list%node_id, c_node_num, [2_int64, list%n_edges])
  if (maxval(c_node_num) >= huge(n)) then
    status = fail(RIIS_LIMIT_EXCEEDED, 'node ' // text_of(maxval(c_node_num)) // &
        ' is more than an INTEGER*4 can count: use riisf_leaking_edges_64')
    return
  end if
  node_num(:, :n) = int(c_node_num + 1, int32)
end subroutine riisf_leaking_edges

!> Does the same as riisf_leaking_edges, with counts and ids of INTEGER*8.
subroutine riisf_leaking_edges_64(leaks, length, n, node_num, status)
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_leak_list, riis_leaks_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: leaks                     !< From riisf_find_leaks, for example.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of edges that leak, even if an array is too short.
  integer(int64), intent(inout) :: node_num(2, *)         !< (2, length): the two nodes, the lower id first, from 1; written up
                                                          !! to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_leak_list) :: list
  integer(int64), pointer :: c_node_num(:, :)
  status = riis_leaks_get_list(c_handle_of(leaks), list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_edges, int(huge(n), int64)), int64)
  if (list%n_edges > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; edges that leak: ' // &
        text_of(list%n_edges))
    return
  end if
  if (list%n_edges == 0) return
  call c_f_pointer(list%node_id, c_node_num, [2_int64, list%n_edges])
  node_num(:, :n) = int(c_node_num + 1, int64)
end subroutine riisf_leaking_edges_64

!> Destroys the leaks and their list. The handle becomes 0. Nothing happens to a handle that is 0.
subroutine riisf_leaks_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: riis_leaks_destroy
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_leaks_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_leaks_destroy

!> Labels the open regions: the connected components of the unmarked nodes, along mesh edges. Errors: RIIS_INVALID_ARGUMENT for a
!! mesh without adjacency, for empty marks, and if the marks and the mesh differ in the number of nodes.
subroutine riisf_label_open_regions(mesh, marks, n_threads, n_nodes, region_num, n_regions, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, out_of_memory
  use riis_c, only: RIIS_OK, riis_label_open_regions, riis_mark_options, riis_mark_options_init, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< The mesh of the marking, with an adjacency.
  integer(int64), intent(in) :: marks                     !< Marks from riisf_mark_nodes.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(in) :: n_nodes                   !< The number of nodes of the marking.
  integer(int32), intent(inout) :: region_num(*)          !< (n_nodes): the lowest node of the node's region, counted from 1; 0
                                                          !! for marked nodes.
  integer(int32), intent(inout) :: n_regions              !< The number of regions.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int64), allocatable, target :: c_region_num(:)
  integer(int64) :: c_n_regions
  type(riis_mark_options) :: options
  integer :: stat
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  allocate (c_region_num(max(n_nodes, 1_int32)), stat=stat)
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  options%n_threads = n_threads
  status = riis_label_open_regions(c_handle_of(mesh), c_handle_of(marks), options, int(n_nodes, int64), c_region_num, &
      c_n_regions)
  if (status /= RIIS_OK) return
  region_num(:n_nodes) = int(c_region_num(:n_nodes) + 1, int32)
  n_regions = int(c_n_regions, int32)
end subroutine riisf_label_open_regions

!> Does the same as riisf_label_open_regions, with counts and ids of INTEGER*8.
subroutine riisf_label_open_regions_64(mesh, marks, n_threads, n_nodes, region_num, n_regions, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_label_open_regions, riis_mark_options, riis_mark_options_init, riis_status
  implicit none
  integer(int64), intent(in) :: mesh                      !< The mesh of the marking, with an adjacency.
  integer(int64), intent(in) :: marks                     !< Marks from riisf_mark_nodes.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(in) :: n_nodes                   !< The number of nodes of the marking.
  integer(int64), intent(inout) :: region_num(*)          !< (n_nodes): the lowest node of the node's region, counted from 1; 0
                                                          !! for marked nodes.
  integer(int64), intent(inout) :: n_regions              !< The number of regions.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%n_threads = n_threads
  status = riis_label_open_regions(c_handle_of(mesh), c_handle_of(marks), options, n_nodes, region_num, n_regions)
  if (status /= RIIS_OK) return
  region_num(:n_nodes) = region_num(:n_nodes) + 1
end subroutine riisf_label_open_regions_64

!> Finds the widest passage along the edges of the mesh's adjacency, whether it is open or closed. Errors: RIIS_INVALID_ARGUMENT
!! for a mesh without adjacency, and for a bad node in `from` or `to`. A node is bad if it is not in the mesh, if node_mask
!! leaves it out, or if it lies in the band around the surface. RIIS_INVALID_MESH as riisf_mark_nodes.
subroutine riisf_find_passage(surface, mesh, n_from, from_num, n_to, to_num, n_threads, state, node_num, distance, &
    point, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, out_of_memory
  use riis_c, only: RIIS_OK, riis_find_passage, riis_mark_options, riis_mark_options_init, riis_passage, &
      riis_passage_ends, riis_passage_ends_init, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: mesh                      !< A mesh with an adjacency, marked or not.
  integer(int32), intent(in) :: n_from                    !< At least 1.
  integer(int32), intent(in) :: from_num(n_from)          !< (n_from): the ids of the nodes at which paths begin, in any order.
                                                          !! Counted from 1.
  integer(int32), intent(in) :: n_to                      !< At least 1.
  integer(int32), intent(in) :: to_num(n_to)              !< (n_to): the ids of the nodes at which paths end, in any order. A
                                                          !! node in both sets is itself a path. Counted from 1.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(inout) :: state                  !< RIIS_PASSAGE_*.
  integer(int32), intent(inout) :: node_num               !< The path's node nearest to the surface, from 1; 0 without a path.
  real(c_double), intent(inout) :: distance               !< That node's distance, the smallest half thickness that closes the
                                                          !! path.
  real(c_double), intent(inout) :: point(3)               !< That node's coordinates.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int64), allocatable, target :: c_from_num(:)
  integer(int64), allocatable, target :: c_to_num(:)
  type(riis_passage_ends) :: ends
  type(riis_mark_options) :: options
  type(riis_passage) :: passage
  integer :: stat
  status = riis_passage_ends_init(ends, c_sizeof(ends))
  if (status == RIIS_OK) status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  allocate (c_from_num(max(n_from, 1_int32)), c_to_num(max(n_to, 1_int32)), stat=stat)
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  ends%n_from = n_from
  c_from_num(:n_from) = int(from_num(:n_from), int64) - 1
  ends%from = c_loc(c_from_num)
  ends%n_to = n_to
  c_to_num(:n_to) = int(to_num(:n_to), int64) - 1
  ends%to = c_loc(c_to_num)
  options%n_threads = n_threads
  status = riis_find_passage(c_handle_of(surface), c_handle_of(mesh), ends, options, passage, c_sizeof(passage))
  if (status /= RIIS_OK) return
  state = passage%state
  node_num = int(passage%node_id + 1, int32)
  distance = passage%distance
  point = passage%point
end subroutine riisf_find_passage

!> Does the same as riisf_find_passage, with counts and ids of INTEGER*8.
subroutine riisf_find_passage_64(surface, mesh, n_from, from_num, n_to, to_num, n_threads, state, node_num, distance, &
    point, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, out_of_memory
  use riis_c, only: RIIS_OK, riis_find_passage, riis_mark_options, riis_mark_options_init, riis_passage, &
      riis_passage_ends, riis_passage_ends_init, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: mesh                      !< A mesh with an adjacency, marked or not.
  integer(int64), intent(in) :: n_from                    !< At least 1.
  integer(int64), intent(in) :: from_num(n_from)          !< (n_from): the ids of the nodes at which paths begin, in any order.
                                                          !! Counted from 1.
  integer(int64), intent(in) :: n_to                      !< At least 1.
  integer(int64), intent(in) :: to_num(n_to)              !< (n_to): the ids of the nodes at which paths end, in any order. A
                                                          !! node in both sets is itself a path. Counted from 1.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(inout) :: state                  !< RIIS_PASSAGE_*.
  integer(int64), intent(inout) :: node_num               !< The path's node nearest to the surface, from 1; 0 without a path.
  real(c_double), intent(inout) :: distance               !< That node's distance, the smallest half thickness that closes the
                                                          !! path.
  real(c_double), intent(inout) :: point(3)               !< That node's coordinates.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int64), allocatable, target :: c_from_num(:)
  integer(int64), allocatable, target :: c_to_num(:)
  type(riis_passage_ends) :: ends
  type(riis_mark_options) :: options
  type(riis_passage) :: passage
  integer :: stat
  status = riis_passage_ends_init(ends, c_sizeof(ends))
  if (status == RIIS_OK) status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  allocate (c_from_num(max(n_from, 1_int64)), c_to_num(max(n_to, 1_int64)), stat=stat)
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  ends%n_from = n_from
  c_from_num(:n_from) = int(from_num(:n_from), int64) - 1
  ends%from = c_loc(c_from_num)
  ends%n_to = n_to
  c_to_num(:n_to) = int(to_num(:n_to), int64) - 1
  ends%to = c_loc(c_to_num)
  options%n_threads = n_threads
  status = riis_find_passage(c_handle_of(surface), c_handle_of(mesh), ends, options, passage, c_sizeof(passage))
  if (status /= RIIS_OK) return
  state = passage%state
  node_num = passage%node_id + 1
  distance = passage%distance
  point = passage%point
end subroutine riisf_find_passage_64

! -----------------------------------------------------------------------------------------------------------------
! Crossings
! -----------------------------------------------------------------------------------------------------------------

!> Finds every pair of the surface's triangles that go through each other. Errors: RIIS_INVALID_ARGUMENT for a bad field; the
!! message names the field.
subroutine riisf_find_crossings(surface, depth, n_threads, crossings, n_pairs, length, deepest, point, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: RIIS_OK, riis_crossing_list, riis_crossing_options, riis_crossing_options_init, &
      riis_crossings_create, riis_crossings_destroy, riis_crossings_get_list, riis_find_crossings, riis_status
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  real(c_double), intent(in) :: depth                     !< The largest depth of a pair of triangles that counts as touching,
                                                          !! in half thicknesses, 0 to 1. Usually 1e-6.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: crossings              !< 0, which creates them, or from an earlier call.
  integer(int64), intent(inout) :: n_pairs                !< The number of pairs. If n_pairs is 0, the ids in this struct are
                                                          !! -1, and all other fields except seconds are 0.
  real(c_double), intent(inout) :: length                 !< The total length of their intersections.
  real(c_double), intent(inout) :: deepest                !< The depth of the deepest pair. Of equally deep pairs, the first
                                                          !! one counts as the deepest.
  real(c_double), intent(inout) :: point(3)               !< The middle of the deepest pair's intersection.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_crossing_options) :: options
  type(riis_crossing_list) :: list
  type(c_ptr) :: c_handle
  status = riis_crossing_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%depth = depth
  options%n_threads = n_threads
  c_handle = c_handle_of(crossings)
  if (crossings == 0) status = riis_crossings_create(c_handle)
  if (status == RIIS_OK) status = riis_find_crossings(c_handle_of(surface), options, c_handle)
  if (status == RIIS_OK) status = riis_crossings_get_list(c_handle, list, c_sizeof(list))
  ! The handle stays 0 if it was 0 and an error occurred.
  if (status /= RIIS_OK .and. crossings == 0) call riis_crossings_destroy(c_handle)
  crossings = handle_of(c_handle)
  if (status /= RIIS_OK) return
  n_pairs = list%n_pairs
  length = list%total_length
  deepest = list%deepest_depth
  point = list%deepest_point
end subroutine riisf_find_crossings

!> Destroys the crossings and their list. The handle becomes 0. Nothing happens to a handle that is 0.
subroutine riisf_crossings_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: riis_crossings_destroy
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_crossings_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_crossings_destroy

!> Copies the pairs of the last riisf_find_crossings, ascending.
subroutine riisf_crossing_pairs(crossings, length, n, triangle_num, point, depth, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_LIMIT_EXCEEDED, RIIS_OK, riis_crossing_list, riis_crossings_get_list, &
      riis_status
  implicit none
  integer(int64), intent(in) :: crossings                 !< From riisf_find_crossings, for example.
  integer(int32), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int32), intent(inout) :: n                      !< The number of pairs that cross, even if an array is too short.
  integer(int32), intent(inout) :: triangle_num(2, *)     !< (2, length): the two triangles, the lower id first, from 1;
                                                          !! written up to n.
  real(c_double), intent(inout) :: point(3, *)            !< (3, length): the middle of the segment where the two triangles
                                                          !! meet; written up to n.
  real(c_double), intent(inout) :: depth(*)               !< (length): the penetration depth; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_crossing_list) :: list
  integer(int64), pointer :: c_triangle_num(:, :)
  real(c_double), pointer :: c_point(:, :)
  real(c_double), pointer :: c_depth(:)
  status = riis_crossings_get_list(c_handle_of(crossings), list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_pairs, int(huge(n), int64)), int32)
  if (list%n_pairs > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; pairs that cross: ' // &
        text_of(list%n_pairs))
    return
  end if
  if (list%n_pairs == 0) return
  call c_f_pointer(list%triangle_id, c_triangle_num, [2_int64, list%n_pairs])
  if (maxval(c_triangle_num) >= huge(n)) then
    status = fail(RIIS_LIMIT_EXCEEDED, 'triangle ' // text_of(maxval(c_triangle_num)) // &
        ' is more than an INTEGER*4 can count: use riisf_crossing_pairs_64')
    return
  end if
  triangle_num(:, :n) = int(c_triangle_num + 1, int32)
  call c_f_pointer(list%point, c_point, [3_int64, list%n_pairs])
  point(:, :n) = c_point
  call c_f_pointer(list%depth, c_depth, [list%n_pairs])
  depth(:n) = c_depth
end subroutine riisf_crossing_pairs

!> Does the same as riisf_crossing_pairs, with counts and ids of INTEGER*8.
subroutine riisf_crossing_pairs_64(crossings, length, n, triangle_num, point, depth, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, fail, text_of
  use riis_c, only: RIIS_INVALID_ARGUMENT, RIIS_OK, riis_crossing_list, riis_crossings_get_list, riis_status
  implicit none
  integer(int64), intent(in) :: crossings                 !< From riisf_find_crossings, for example.
  integer(int64), intent(in) :: length                    !< The number of entries for which the arrays have room.
                                                          !! RIIS_INVALID_ARGUMENT if n is larger; only n is then written.
  integer(int64), intent(inout) :: n                      !< The number of pairs that cross, even if an array is too short.
  integer(int64), intent(inout) :: triangle_num(2, *)     !< (2, length): the two triangles, the lower id first, from 1;
                                                          !! written up to n.
  real(c_double), intent(inout) :: point(3, *)            !< (3, length): the middle of the segment where the two triangles
                                                          !! meet; written up to n.
  real(c_double), intent(inout) :: depth(*)               !< (length): the penetration depth; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_crossing_list) :: list
  integer(int64), pointer :: c_triangle_num(:, :)
  real(c_double), pointer :: c_point(:, :)
  real(c_double), pointer :: c_depth(:)
  status = riis_crossings_get_list(c_handle_of(crossings), list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_pairs, int(huge(n), int64)), int64)
  if (list%n_pairs > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; pairs that cross: ' // &
        text_of(list%n_pairs))
    return
  end if
  if (list%n_pairs == 0) return
  call c_f_pointer(list%triangle_id, c_triangle_num, [2_int64, list%n_pairs])
  triangle_num(:, :n) = int(c_triangle_num + 1, int64)
  call c_f_pointer(list%point, c_point, [3_int64, list%n_pairs])
  point(:, :n) = c_point
  call c_f_pointer(list%depth, c_depth, [list%n_pairs])
  depth(:n) = c_depth
end subroutine riisf_crossing_pairs_64

! -----------------------------------------------------------------------------------------------------------------
! Measures for a flow
! -----------------------------------------------------------------------------------------------------------------

!> Gives the number of leaflets of the surface.
subroutine riisf_surface_n_leaflets(surface, n_leaflets, status)
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_get_n_leaflets
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int32), intent(inout) :: n_leaflets             !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int64) :: c_n_leaflets
  status = riis_surface_get_n_leaflets(c_handle_of(surface), c_n_leaflets)
  if (status /= RIIS_OK) return
  n_leaflets = int(c_n_leaflets, int32)
end subroutine riisf_surface_n_leaflets

!> Gives the sizes of a leaflet.
subroutine riisf_surface_leaflet(surface, leaflet_num, leaflet_id, area, free_edge, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_leaflet, riis_status, riis_surface_get_leaflet
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int32), intent(in) :: leaflet_num               !< 1 to n_leaflets, ascending by leaflet_id.
  integer(int32), intent(inout) :: leaflet_id             !< As in riis_triangles.
  real(c_double), intent(inout) :: area                   !< The sum of the areas of these triangles.
  real(c_double), intent(inout) :: free_edge              !< The length of the free edge, 0 for a skirt. The free edge of a
                                                          !! valve's leaflet consists of the sides v = 1 that belong to only
                                                          !! one patch of the leaflet. In a surface from arrays, the free edge
                                                          !! consists of the edges that belong to only one triangle, without
                                                          !! the longest closed line of such edges.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_leaflet) :: sizes
  status = riis_surface_get_leaflet(c_handle_of(surface), int(leaflet_num, int64) - 1, sizes, c_sizeof(sizes))
  if (status /= RIIS_OK) return
  leaflet_id = sizes%leaflet_id
  area = sizes%area
  free_edge = sizes%free_edge
end subroutine riisf_surface_leaflet

!> Measures the orifice of a surface.
subroutine riisf_surface_orifice(surface, half_thickness, rim, area, outline_area, perimeter, effective_area, outline, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_orifice, riis_resistance, riis_resistance_init, riis_status, riis_surface_get_orifice
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  real(c_double), intent(in) :: half_thickness            !< eps of the resistance; RIIS_AUTO: the surface's.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_*, usually RIIS_RIM_ROUND.
  real(c_double), intent(inout) :: area                   !< The area of the orifice. If there is no outline, all fields except
                                                          !! axis and rim_reach are 0.
  real(c_double), intent(inout) :: outline_area           !< The area inside the outline.
  real(c_double), intent(inout) :: perimeter              !< The length of the orifice's edge along the triangles. Before the
                                                          !! measurement, the edge is moved inwards by a tenth of the half
                                                          !! thickness, so that narrow slits vanish. Parts of the edge that lie
                                                          !! on the outline count as walls, and do not add to the perimeter.
  real(c_double), intent(inout) :: effective_area         !< The area that the band around the leaflets leaves for the flow. To
                                                          !! find it, the edge of the orifice along the triangles is moved
                                                          !! inwards by rim_reach * half_thickness. To first order the
                                                          !! effective area is area - rim_reach * half_thickness * perimeter.
                                                          !! The effective area is never below 0.
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

!> Measures the orifice inside a wall, such as a ring or a tube around the leaflets. Use this call if the leaflets do not reach
!! the wall, as in a mechanical valve from arrays. The longest connected line of open edges of the wall gives the outline and the
!! axis (docs/theory/measures.md, 'Outline'). The other arguments are as in riisf_surface_orifice.
subroutine riisf_surface_orifice_in_wall(surface, wall, half_thickness, rim, area, outline_area, perimeter, &
    effective_area, outline, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_orifice, riis_resistance, riis_resistance_init, riis_status, &
      riis_surface_get_orifice_in_wall
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: wall                      !< The wall, in the same coordinates as the surface. If the line of
                                                          !! the outline does not surround a centre, the call returns
                                                          !! RIIS_INVALID_ARGUMENT.
  real(c_double), intent(in) :: half_thickness            !< eps of the resistance; RIIS_AUTO: the surface's.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_*, usually RIIS_RIM_ROUND.
  real(c_double), intent(inout) :: area                   !< The area of the orifice. If there is no outline, all fields except
                                                          !! axis and rim_reach are 0.
  real(c_double), intent(inout) :: outline_area           !< The area inside the outline.
  real(c_double), intent(inout) :: perimeter              !< The length of the orifice's edge along the triangles. Before the
                                                          !! measurement, the edge is moved inwards by a tenth of the half
                                                          !! thickness, so that narrow slits vanish. Parts of the edge that lie
                                                          !! on the outline count as walls, and do not add to the perimeter.
  real(c_double), intent(inout) :: effective_area         !< The area that the band around the leaflets leaves for the flow. To
                                                          !! find it, the edge of the orifice along the triangles is moved
                                                          !! inwards by rim_reach * half_thickness. To first order the
                                                          !! effective area is area - rim_reach * half_thickness * perimeter.
                                                          !! The effective area is never below 0.
  integer(int32), intent(inout) :: outline                !< RIIS_OUTLINE_*.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  type(riis_orifice) :: orifice
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status /= RIIS_OK) return
  resistance%half_thickness = half_thickness
  resistance%rim = rim
  status = riis_surface_get_orifice_in_wall(c_handle_of(surface), c_handle_of(wall), resistance, orifice, &
      c_sizeof(orifice))
  if (status /= RIIS_OK) return
  area = orifice%area
  outline_area = orifice%outline_area
  perimeter = orifice%perimeter
  effective_area = orifice%effective_area
  outline = orifice%outline
end subroutine riisf_surface_orifice_in_wall

!> Measures the coaptation. Contact with a skirt or with the bileaflet housing does not count. Errors: RIIS_INVALID_ARGUMENT if
!! the surface lacks the leaflet, and if the reach is out of range.
subroutine riisf_surface_coaptation(surface, reach, leaflet_id, area, edge, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_coaptation, riis_status, riis_surface_get_coaptation
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  real(c_double), intent(in) :: reach                     !< 1e-50 to 1e50. RIIS_AUTO stands for the surface's half thickness.
  integer(int32), intent(in) :: leaflet_id                !< As in riis_triangles, or RIIS_ALL_LEAFLETS for the sum over all
                                                          !! leaflets. In this sum each contact counts twice, once for each of
                                                          !! the two leaflets.
  real(c_double), intent(inout) :: area                   !< The area of the part of the leaflet whose distance from another
                                                          !! leaflet is at most `reach`.
  real(c_double), intent(inout) :: edge                   !< The length of the part of the free edge (riis_leaflet) whose
                                                          !! distance from another leaflet is at most `reach`.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_coaptation) :: coaptation
  status = riis_surface_get_coaptation(c_handle_of(surface), reach, leaflet_id, coaptation, c_sizeof(coaptation))
  if (status /= RIIS_OK) return
  area = coaptation%area
  edge = coaptation%edge
end subroutine riisf_surface_coaptation

!> Measures the gap between a valve's attachment and a wall, such as a patient's vessel. Errors: RIIS_INVALID_ARGUMENT if the
!! surface has no attachment, and if the attachment encloses no area.
subroutine riisf_surface_gap(surface, wall, least, mean, most, missed, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_gap, riis_status, riis_surface_get_gap
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  integer(int64), intent(in) :: wall                      !< A surface in the same coordinates as the valve's surface, usually
                                                          !! from riisf_surface_from_arrays.
  real(c_double), intent(inout) :: least                  !< least, mean, most: the least, the mean and the largest gap at the
                                                          !! ends of the edges of riis_attachment. The mean is weighted by the
                                                          !! lengths of the edges. All three are 0 if no end has a gap.
  real(c_double), intent(inout) :: mean                   !< least, mean, most: the least, the mean and the largest gap at the
                                                          !! ends of the edges of riis_attachment. The mean is weighted by the
                                                          !! lengths of the edges. All three are 0 if no end has a gap.
  real(c_double), intent(inout) :: most                   !< least, mean, most: the least, the mean and the largest gap at the
                                                          !! ends of the edges of riis_attachment. The mean is weighted by the
                                                          !! lengths of the edges. All three are 0 if no end has a gap.
  integer(int32), intent(inout) :: missed                 !< The number of ends from which a line in the skirt's direction does
                                                          !! not meet the wall. These ends have no gap, and count only here and
                                                          !! in n_ends.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_gap) :: gap
  status = riis_surface_get_gap(c_handle_of(surface), c_handle_of(wall), gap=gap, struct_size=c_sizeof(gap))
  if (status /= RIIS_OK) return
  least = gap%least
  mean = gap%mean
  most = gap%most
  missed = int(gap%n_without_wall, int32)
end subroutine riisf_surface_gap

!> Gives a valve a skirt that just reaches a wall. An earlier skirt of the valve is replaced. Errors: RIIS_INVALID_ARGUMENT if
!! the skirt from a point of the attachment does not meet the wall, or would be longer than `longest`. The message names the
!! first such point. RIIS_INVALID_PARAMETER for a bileaflet valve, and for an attachment that encloses no area.
subroutine riisf_valve_skirt_to_wall(valve, wall, longest, half_thickness, tolerance, scale, rotation_axis, &
    rotation_angle, translation, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_options, riis_surface_options_init, riis_valve_set_skirt_to_wall
  implicit none
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  integer(int64), intent(in) :: wall                      !< As in riisf_surface_gap.
  real(c_double), intent(in) :: longest                   !< The largest permitted length of the skirt, in mesh units, 1e-50 to
                                                          !! 1e50.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%half_thickness = half_thickness
  options%tolerance = tolerance
  options%scale = scale
  options%rotation_axis = rotation_axis
  options%rotation_angle = rotation_angle
  options%translation = translation
  status = riis_valve_set_skirt_to_wall(c_handle_of(valve), c_handle_of(wall), longest, options)
end subroutine riisf_valve_skirt_to_wall

!> Gives the ideal leak of a closed surface: the volume flow drop * (eps / R) * area that a pressure drop causes. The area is
!! that of the surface without a bileaflet housing. If the surface has an offset o, the area is that of the surface after a shift
!! by o eps along its normals. The leak in a solver differs from the ideal leak (docs/solvers.md). Errors: RIIS_INVALID_ARGUMENT
!! for a bad field or argument; the message names the field or argument and its value.
subroutine riisf_surface_leak(surface, R, half_thickness, drop, flow, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_resistance, riis_resistance_init, riis_status, riis_surface_get_leak
  implicit none
  integer(int64), intent(in) :: surface                   !< From riisf_surface_create, for example.
  real(c_double), intent(in) :: R                         !< 1e-60 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps of the resistance; RIIS_AUTO: the surface's.
  real(c_double), intent(in) :: drop                      !< Upstream pressure minus downstream pressure, at most 1e30 in
                                                          !! magnitude.
  real(c_double), intent(inout) :: flow                   !< The volume flow, in the unit of drop * area * eps / R. In SI units
                                                          !! this is m^3/s.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: resistance
  status = riis_resistance_init(resistance, c_sizeof(resistance))
  if (status /= RIIS_OK) return
  resistance%R = R
  resistance%half_thickness = half_thickness
  status = riis_surface_get_leak(c_handle_of(surface), resistance, drop, flow)
end subroutine riisf_surface_leak

!> Computes how many mesh edges fit across the band. An edge counts once, even if the adjacency has it in the rows of both of its
!! nodes. Edges to ghosts and edges of length 0 do not count. Errors: RIIS_INVALID_ARGUMENT if the mesh has no adjacency, if the
!! marks are empty, and if the marks and the mesh differ in the number of nodes. RIIS_INVALID_MESH as riisf_mark_nodes.
subroutine riisf_cells_across(marks, mesh, least, mean, most, mean_edge, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_cells_across, riis_marks_get_cells_across, riis_status
  implicit none
  integer(int64), intent(in) :: marks                     !< Marks from riisf_mark_nodes.
  integer(int64), intent(in) :: mesh                      !< The mesh of the marking, with an adjacency.
  real(c_double), intent(inout) :: least                  !< least, mean, most: the numbers of mesh edges across the band: 2 *
                                                          !! half_thickness divided by longest_edge, by mean_edge and by
                                                          !! shortest_edge.
  real(c_double), intent(inout) :: mean                   !< least, mean, most: the numbers of mesh edges across the band: 2 *
                                                          !! half_thickness divided by longest_edge, by mean_edge and by
                                                          !! shortest_edge.
  real(c_double), intent(inout) :: most                   !< least, mean, most: the numbers of mesh edges across the band: 2 *
                                                          !! half_thickness divided by longest_edge, by mean_edge and by
                                                          !! shortest_edge.
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

!> Gives the volume that the valve sweeps between two openings, in mesh units cubed. The volume is the integral of u_surface . n
!! over surface and time, so motion in the direction of the normals counts as positive. In a flow, a valve displaces less blood
!! than this volume, because blood slips past the leaflets. Errors: RIIS_INVALID_ARGUMENT if an opening is out of range, and if
!! the valve has no leaflet of this id. RIIS_INVALID_PARAMETER if parameters do not fit together, and for an opening above 0 of a
!! valve that has only one state.
subroutine riisf_valve_swept_volume(valve, opening_from, opening_to, scale, leaflet_id, volume, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of
  use riis_c, only: RIIS_OK, riis_status, riis_surface_options, riis_surface_options_init, riis_valve_get_swept_volume
  implicit none
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  real(c_double), intent(in) :: opening_from              !< 0 to 1. The valve's own opening is ignored.
  real(c_double), intent(in) :: opening_to                !< 0 to 1. The valve's own opening is ignored.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  integer(int32), intent(in) :: leaflet_id                !< RIIS_LEAFLET_*, a leaflet_id of the caller's patches, or
                                                          !! RIIS_ALL_LEAFLETS.
  real(c_double), intent(inout) :: volume                 !< Written on success, mesh units cubed.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  status = riis_surface_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%scale = scale
  status = riis_valve_get_swept_volume(c_handle_of(valve), opening_from, opening_to, options, leaflet_id, volume)
end subroutine riisf_valve_swept_volume

!> Finds the openings, or the sizes, at which the orifice of a valve has given areas (docs/theory/measures.md, 'From an area to a
!! valve'). Errors: RIIS_INVALID_ARGUMENT for a bad area; the message names the area. If no opening or size has the area, the
!! message names the range of areas. RIIS_INVALID_PARAMETER for an unknown name, and for a parameter that has three values or
!! does not change the area. RIIS_INVALID_PARAMETER also for a valve with only one state, and for a valve without an orifice. If
!! a surface cannot be made, the message names the opening or size. After an error nothing is written.
subroutine riisf_find_by_area(valve, name, n_areas, areas, half_thickness, tolerance, scale, rotation_axis, &
    rotation_angle, translation, n_threads, area_kind, values, reached, least, most, n_turns, status)
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, end_for_c
  use riis_c, only: RIIS_OK, riis_area_range, riis_area_search, riis_area_search_init, riis_find_by_area, riis_status, &
      riis_surface_options, riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: valve                     !< The valve. If the call searches for openings, it ignores the
                                                          !! valve's own opening.
  character(len=*), intent(in) :: name                    !< 'opening', 'scale' (of the placement), or the name of a parameter
                                                          !! for which riisf_valve_get gives one value.
  integer(int32), intent(in) :: n_areas                   !< 0 to 1,000,000.
  real(c_double), intent(in) :: areas(*)                  !< (n_areas): the wanted areas, 0 to 1e120, in mesh units squared.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(in) :: area_kind                 !< RIIS_AREA_*, usually RIIS_AREA_GEOMETRIC.
  real(c_double), intent(inout) :: values(*)              !< (n_areas): the openings or sizes that were found.
  real(c_double), intent(inout) :: reached(*)             !< (n_areas): the areas at these openings or sizes.
  real(c_double), intent(inout) :: least                  !< least, most: the least and the largest area in this range.
  real(c_double), intent(inout) :: most                   !< least, most: the least and the largest area in this range.
  integer(int32), intent(inout) :: n_turns                !< The number of all such openings or sizes. If n_turns is 0, the
                                                          !! area only grows or only falls.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(name) + 1, kind=c_char) :: c_name
  type(riis_area_search) :: search
  type(riis_area_range) :: range
  type(riis_surface_options), target :: surface
  status = riis_area_search_init(search, c_sizeof(search))
  if (status == RIIS_OK) status = riis_surface_options_init(surface, c_sizeof(surface))
  if (status /= RIIS_OK) return
  call end_for_c(name, c_name)
  surface%half_thickness = half_thickness
  surface%tolerance = tolerance
  surface%scale = scale
  surface%rotation_axis = rotation_axis
  surface%rotation_angle = rotation_angle
  surface%translation = translation
  surface%n_threads = n_threads
  search%area = area_kind
  search%surface = c_loc(surface)
  status = riis_find_by_area(c_handle_of(valve), c_name, int(n_areas, int64), areas, search, values, reached, range, &
      c_sizeof(range))
  if (status /= RIIS_OK) return
  least = range%least
  most = range%most
  n_turns = int(range%n_turns, int32)
end subroutine riisf_find_by_area

!> Does the same as riisf_find_by_area, with counts and ids of INTEGER*8.
subroutine riisf_find_by_area_64(valve, name, n_areas, areas, half_thickness, tolerance, scale, rotation_axis, &
    rotation_angle, translation, n_threads, area_kind, values, reached, least, most, n_turns, status)
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, end_for_c
  use riis_c, only: RIIS_OK, riis_area_range, riis_area_search, riis_area_search_init, riis_find_by_area, riis_status, &
      riis_surface_options, riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: valve                     !< The valve. If the call searches for openings, it ignores the
                                                          !! valve's own opening.
  character(len=*), intent(in) :: name                    !< 'opening', 'scale' (of the placement), or the name of a parameter
                                                          !! for which riisf_valve_get gives one value.
  integer(int64), intent(in) :: n_areas                   !< 0 to 1,000,000.
  real(c_double), intent(in) :: areas(*)                  !< (n_areas): the wanted areas, 0 to 1e120, in mesh units squared.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(in) :: area_kind                 !< RIIS_AREA_*, usually RIIS_AREA_GEOMETRIC.
  real(c_double), intent(inout) :: values(*)              !< (n_areas): the openings or sizes that were found.
  real(c_double), intent(inout) :: reached(*)             !< (n_areas): the areas at these openings or sizes.
  real(c_double), intent(inout) :: least                  !< least, most: the least and the largest area in this range.
  real(c_double), intent(inout) :: most                   !< least, most: the least and the largest area in this range.
  integer(int64), intent(inout) :: n_turns                !< The number of all such openings or sizes. If n_turns is 0, the
                                                          !! area only grows or only falls.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(name) + 1, kind=c_char) :: c_name
  type(riis_area_search) :: search
  type(riis_area_range) :: range
  type(riis_surface_options), target :: surface
  status = riis_area_search_init(search, c_sizeof(search))
  if (status == RIIS_OK) status = riis_surface_options_init(surface, c_sizeof(surface))
  if (status /= RIIS_OK) return
  call end_for_c(name, c_name)
  surface%half_thickness = half_thickness
  surface%tolerance = tolerance
  surface%scale = scale
  surface%rotation_axis = rotation_axis
  surface%rotation_angle = rotation_angle
  surface%translation = translation
  surface%n_threads = n_threads
  search%area = area_kind
  search%surface = c_loc(surface)
  status = riis_find_by_area(c_handle_of(valve), c_name, n_areas, areas, search, values, reached, range, &
      c_sizeof(range))
  if (status /= RIIS_OK) return
  least = range%least
  most = range%most
  n_turns = range%n_turns
end subroutine riisf_find_by_area_64

!> Finds the first opening of a valve at which riisf_find_passage finds a passage. Errors: as riisf_surface_create and
!! riisf_find_passage; the message also names the opening. RIIS_INVALID_PARAMETER for a valve with only one state.
subroutine riisf_find_first_passage(valve, mesh, n_from, from_num, n_to, to_num, half_thickness, tolerance, scale, &
    rotation_axis, rotation_angle, translation, opening_tolerance, n_threads, state, opening, closed_opening, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, out_of_memory
  use riis_c, only: RIIS_OK, riis_find_first_passage, riis_first_passage, riis_first_passage_options, &
      riis_first_passage_options_init, riis_mark_options, riis_mark_options_init, riis_passage_ends, &
      riis_passage_ends_init, riis_status, riis_surface_options, riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: valve                     !< The valve, whose own opening is ignored.
  integer(int64), intent(in) :: mesh                      !< A mesh with an adjacency, marked or not.
  integer(int32), intent(in) :: n_from                    !< At least 1.
  integer(int32), intent(in) :: from_num(n_from)          !< (n_from): the ids of the nodes at which paths begin, in any order.
                                                          !! Counted from 1.
  integer(int32), intent(in) :: n_to                      !< At least 1.
  integer(int32), intent(in) :: to_num(n_to)              !< (n_to): the ids of the nodes at which paths end, in any order. A
                                                          !! node in both sets is itself a path. Counted from 1.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  real(c_double), intent(in) :: opening_tolerance         !< Tolerance of the opening, 1e-6 to 1. Usually 1e-3.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(inout) :: state                  !< RIIS_FIRST_PASSAGE_*.
  real(c_double), intent(inout) :: opening                !< The first opening with a passage; 0 for ALWAYS, 1 for NEVER, 0 for
                                                          !! NONE.
  real(c_double), intent(inout) :: closed_opening         !< With RIIS_FIRST_PASSAGE_FOUND, the largest opening below `opening`
                                                          !! at which the call found no passage. In other states it equals
                                                          !! `opening`.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int64), allocatable, target :: c_from_num(:)
  integer(int64), allocatable, target :: c_to_num(:)
  type(riis_passage_ends) :: ends
  type(riis_first_passage_options) :: options
  type(riis_first_passage) :: first
  type(riis_surface_options), target :: surface
  type(riis_mark_options), target :: marking
  integer :: stat
  status = riis_passage_ends_init(ends, c_sizeof(ends))
  if (status == RIIS_OK) status = riis_first_passage_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_surface_options_init(surface, c_sizeof(surface))
  if (status == RIIS_OK) status = riis_mark_options_init(marking, c_sizeof(marking))
  if (status /= RIIS_OK) return
  allocate (c_from_num(max(n_from, 1_int32)), c_to_num(max(n_to, 1_int32)), stat=stat)
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  ends%n_from = n_from
  c_from_num(:n_from) = int(from_num(:n_from), int64) - 1
  ends%from = c_loc(c_from_num)
  ends%n_to = n_to
  c_to_num(:n_to) = int(to_num(:n_to), int64) - 1
  ends%to = c_loc(c_to_num)
  surface%half_thickness = half_thickness
  surface%tolerance = tolerance
  surface%scale = scale
  surface%rotation_axis = rotation_axis
  surface%rotation_angle = rotation_angle
  surface%translation = translation
  options%tolerance = opening_tolerance
  marking%n_threads = n_threads
  surface%n_threads = n_threads
  options%surface = c_loc(surface)
  options%marking = c_loc(marking)
  status = riis_find_first_passage(c_handle_of(valve), c_handle_of(mesh), ends, options, first, c_sizeof(first))
  if (status /= RIIS_OK) return
  state = first%state
  opening = first%opening
  closed_opening = first%closed_opening
end subroutine riisf_find_first_passage

!> Does the same as riisf_find_first_passage, with counts and ids of INTEGER*8.
subroutine riisf_find_first_passage_64(valve, mesh, n_from, from_num, n_to, to_num, half_thickness, tolerance, scale, &
    rotation_axis, rotation_angle, translation, opening_tolerance, n_threads, state, opening, closed_opening, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, out_of_memory
  use riis_c, only: RIIS_OK, riis_find_first_passage, riis_first_passage, riis_first_passage_options, &
      riis_first_passage_options_init, riis_mark_options, riis_mark_options_init, riis_passage_ends, &
      riis_passage_ends_init, riis_status, riis_surface_options, riis_surface_options_init
  implicit none
  integer(int64), intent(in) :: valve                     !< The valve, whose own opening is ignored.
  integer(int64), intent(in) :: mesh                      !< A mesh with an adjacency, marked or not.
  integer(int64), intent(in) :: n_from                    !< At least 1.
  integer(int64), intent(in) :: from_num(n_from)          !< (n_from): the ids of the nodes at which paths begin, in any order.
                                                          !! Counted from 1.
  integer(int64), intent(in) :: n_to                      !< At least 1.
  integer(int64), intent(in) :: to_num(n_to)              !< (n_to): the ids of the nodes at which paths end, in any order. A
                                                          !! node in both sets is itself a path. Counted from 1.
  real(c_double), intent(in) :: half_thickness            !< The half thickness of the band, in mesh units, 1e-50 to 1e50:
                                                          !! d_min in the paper (4.2). RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The distance to a valve's triangles
                                                          !! differs from the distance to its smooth surface by at most
                                                          !! tolerance * half_thickness (docs/theory.md).
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  real(c_double), intent(in) :: opening_tolerance         !< Tolerance of the opening, 1e-6 to 1. Usually 1e-3.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(inout) :: state                  !< RIIS_FIRST_PASSAGE_*.
  real(c_double), intent(inout) :: opening                !< The first opening with a passage; 0 for ALWAYS, 1 for NEVER, 0 for
                                                          !! NONE.
  real(c_double), intent(inout) :: closed_opening         !< With RIIS_FIRST_PASSAGE_FOUND, the largest opening below `opening`
                                                          !! at which the call found no passage. In other states it equals
                                                          !! `opening`.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int64), allocatable, target :: c_from_num(:)
  integer(int64), allocatable, target :: c_to_num(:)
  type(riis_passage_ends) :: ends
  type(riis_first_passage_options) :: options
  type(riis_first_passage) :: first
  type(riis_surface_options), target :: surface
  type(riis_mark_options), target :: marking
  integer :: stat
  status = riis_passage_ends_init(ends, c_sizeof(ends))
  if (status == RIIS_OK) status = riis_first_passage_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_surface_options_init(surface, c_sizeof(surface))
  if (status == RIIS_OK) status = riis_mark_options_init(marking, c_sizeof(marking))
  if (status /= RIIS_OK) return
  allocate (c_from_num(max(n_from, 1_int64)), c_to_num(max(n_to, 1_int64)), stat=stat)
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  ends%n_from = n_from
  c_from_num(:n_from) = int(from_num(:n_from), int64) - 1
  ends%from = c_loc(c_from_num)
  ends%n_to = n_to
  c_to_num(:n_to) = int(to_num(:n_to), int64) - 1
  ends%to = c_loc(c_to_num)
  surface%half_thickness = half_thickness
  surface%tolerance = tolerance
  surface%scale = scale
  surface%rotation_axis = rotation_axis
  surface%rotation_angle = rotation_angle
  surface%translation = translation
  options%tolerance = opening_tolerance
  marking%n_threads = n_threads
  surface%n_threads = n_threads
  options%surface = c_loc(surface)
  options%marking = c_loc(marking)
  status = riis_find_first_passage(c_handle_of(valve), c_handle_of(mesh), ends, options, first, c_sizeof(first))
  if (status /= RIIS_OK) return
  state = first%state
  opening = first%opening
  closed_opening = first%closed_opening
end subroutine riisf_find_first_passage_64

! -----------------------------------------------------------------------------------------------------------------
! Laws of opening
! The same arguments give the same bits, and nothing is kept between calls. Times, pressures and flows have the solver's units.
! laws.h has the formulas. Positive values of the pressure difference and of the flow open a valve. A state is an array. If a
! restart file contains it, unformatted or in full precision, the law continues with the same bits. To repeat a step, start from
! a copy of the state. The rate is the derivative of the opening by time.
! -----------------------------------------------------------------------------------------------------------------

!> Gives the opening and its rate at a given time, from a table. Errors: RIIS_INVALID_ARGUMENT for a bad field or key; the
!! message names the field or key and its value.
subroutine riisf_opening_from_table(n_keys, key_time, key_opening, period, interpolation, time, opening, rate, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32
  use riis_support, only: location_of
  use riis_c, only: RIIS_OK, riis_opening_from_table, riis_opening_table, riis_opening_table_init, riis_status
  implicit none
  integer(int32), intent(in) :: n_keys                    !< 1 to 1,000,000.
  real(c_double), intent(in) :: key_time(*)               !< (n_keys), strictly ascending, magnitude at most 1e30.
  real(c_double), intent(in) :: key_opening(*)            !< (n_keys), 0 to 1.
  real(c_double), intent(in) :: period                    !< If above 0, the table repeats with this period. All keys must lie
                                                          !! within one period after the first key. If the last key is exactly
                                                          !! one period after the first key, the two keys must have the same
                                                          !! opening. With 0, the default, the opening is constant before the
                                                          !! first key and after the last key.
  integer(int32), intent(in) :: interpolation             !< RIIS_INTERPOLATION_*, usually RIIS_INTERPOLATION_LINEAR.
  real(c_double), intent(in) :: time                      !< Magnitude at most 1e30.
  real(c_double), intent(inout) :: opening                !< Written on success.
  real(c_double), intent(inout) :: rate                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_table) :: table
  status = riis_opening_table_init(table, c_sizeof(table))
  if (status /= RIIS_OK) return
  table%n_keys = n_keys
  table%time = location_of(key_time)
  table%opening = location_of(key_opening)
  table%period = period
  table%interpolation = interpolation
  status = riis_opening_from_table(table, time, opening, rate)
end subroutine riisf_opening_from_table

!> Gives the opening and its rate at a given time, from the times of the two ramps. Errors: RIIS_INVALID_ARGUMENT for a bad
!! field; the message names the field and its value.
subroutine riisf_opening_from_times(opening_start, opening_duration, closing_start, closing_duration, closed, open, &
    period, time, opening, rate, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use riis_c, only: RIIS_OK, riis_opening_from_times, riis_opening_times, riis_opening_times_init, riis_status
  implicit none
  real(c_double), intent(in) :: opening_start             !< The time at which the valve begins to open. This field and the
                                                          !! next three have the default NaN, which is refused.
  real(c_double), intent(in) :: opening_duration          !< How long opening takes, > 0.
  real(c_double), intent(in) :: closing_start             !< The time at which the valve begins to close, at least
                                                          !! opening_start + opening_duration.
  real(c_double), intent(in) :: closing_duration          !< How long closing takes, > 0.
  real(c_double), intent(in) :: closed                    !< closed, open: the opening of the closed valve, and the opening of
                                                          !! the open valve, each 0 to 1. Usually 0 and 1.
  real(c_double), intent(in) :: open                      !< closed, open: the opening of the closed valve, and the opening of
                                                          !! the open valve, each 0 to 1. Usually 0 and 1.
  real(c_double), intent(in) :: period                    !< If above 0, the valve opens and closes once in each period. With
                                                          !! 0, the default, the valve opens and closes only once.
  real(c_double), intent(in) :: time                      !< Magnitude at most 1e30.
  real(c_double), intent(inout) :: opening                !< Written on success.
  real(c_double), intent(inout) :: rate                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_times) :: times
  status = riis_opening_times_init(times, c_sizeof(times))
  if (status /= RIIS_OK) return
  times%opening_start = opening_start
  times%opening_duration = opening_duration
  times%closing_start = closing_start
  times%closing_duration = closing_duration
  times%closed = closed
  times%open = open
  times%period = period
  status = riis_opening_from_times(times, time, opening, rate)
end subroutine riisf_opening_from_times

!> Fills state with a closed valve at time 0.
subroutine riisf_opening_switch_init(state, phase, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32
  use riis_c, only: RIIS_OK, riis_opening_switch_state, riis_opening_switch_state_init, riis_status
  implicit none
  real(c_double), intent(inout) :: state(7)               !< As for riisf_opening_switch_advance.
  integer(int32), intent(inout) :: phase                  !< RIIS_PHASE_*.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_switch_state) :: the_state
  status = riis_opening_switch_state_init(the_state, c_sizeof(the_state))
  if (status /= RIIS_OK) return
  state = [the_state%time, the_state%opening, the_state%rate, the_state%progress, the_state%pressure_difference, &
      the_state%flow, the_state%turn_time]
  phase = the_state%phase
end subroutine riisf_opening_switch_init

!> Advances the state of a switch to a later time. The phase changes only at the end of a step, so the error of the opening is of
!! first order in the length of the step. Errors: RIIS_INVALID_ARGUMENT for a bad field or argument; the message names the field
!! or argument and its value.
subroutine riisf_opening_switch_advance(opening_duration, closing_duration, open_above, close_below, filter_time, &
    dwell_time, time, pressure_difference, flow, state, phase, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32
  use riis_c, only: RIIS_OK, riis_opening_switch, riis_opening_switch_advance, riis_opening_switch_init, &
      riis_opening_switch_state, riis_opening_switch_state_init, riis_status
  implicit none
  real(c_double), intent(in) :: opening_duration          !< The time that the valve takes to open, > 0.
  real(c_double), intent(in) :: closing_duration          !< The time that the valve takes to close, > 0.
  real(c_double), intent(in) :: open_above                !< The pressure difference above which the valve opens. Usually 0.
  real(c_double), intent(in) :: close_below               !< The flow below which the valve closes. Usually 0.
  real(c_double), intent(in) :: filter_time               !< The time constant of the filter that smooths pressure difference
                                                          !! and flow, >= 0. 0: no filter.
  real(c_double), intent(in) :: dwell_time                !< The shortest time between two changes of phase, >= 0. Usually 0.
  real(c_double), intent(in) :: time                      !< At least state(1).
  real(c_double), intent(in) :: pressure_difference       !< The values at `time`, each at most 1e30 in magnitude.
  real(c_double), intent(in) :: flow                      !< The values at `time`, each at most 1e30 in magnitude.
  real(c_double), intent(inout) :: state(7)               !< Time, opening, rate, progress, filtered pressure difference,
                                                          !! filtered flow, time of the last change of phase (NaN: none yet).
                                                          !! Written on success.
  integer(int32), intent(inout) :: phase                  !< RIIS_PHASE_*.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_switch) :: law
  type(riis_opening_switch_state) :: before
  type(riis_opening_switch_state) :: now
  status = riis_opening_switch_init(law, c_sizeof(law))
  if (status == RIIS_OK) status = riis_opening_switch_state_init(before, c_sizeof(before))
  if (status /= RIIS_OK) return
  law%opening_duration = opening_duration
  law%closing_duration = closing_duration
  law%open_above = open_above
  law%close_below = close_below
  law%filter_time = filter_time
  law%dwell_time = dwell_time
  before%time = state(1)
  before%opening = state(2)
  before%rate = state(3)
  before%progress = state(4)
  before%pressure_difference = state(5)
  before%flow = state(6)
  before%turn_time = state(7)
  before%phase = phase
  now = before
  status = riis_opening_switch_advance(law, before, time, pressure_difference, flow, now)
  if (status /= RIIS_OK) return
  state = [now%time, now%opening, now%rate, now%progress, now%pressure_difference, now%flow, now%turn_time]
  phase = now%phase
end subroutine riisf_opening_switch_advance

!> Fills state with a closed valve at rest, at time 0. In the first step, the angle 0 of this state stands for angle_min.
subroutine riisf_opening_angle_init(state, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use riis_c, only: RIIS_OK, riis_opening_angle_state, riis_opening_angle_state_init, riis_status
  implicit none
  real(c_double), intent(inout) :: state(7)               !< As for riisf_opening_angle_advance.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_angle_state) :: the_state
  status = riis_opening_angle_state_init(the_state, c_sizeof(the_state))
  if (status /= RIIS_OK) return
  state = [the_state%time, the_state%opening, the_state%rate, the_state%angle, the_state%angle_rate, &
      the_state%pressure_difference, the_state%flow]
end subroutine riisf_opening_angle_init

!> Advances the state of the angle law to a later time. The law assumes that the pressure difference and the flow change linearly
!! during a step. The error of the angle is therefore of second order in the length of the step. During the first step both are
!! assumed to be constant, because no earlier values are known. Errors: RIIS_INVALID_ARGUMENT for a bad field or argument; the
!! message names the field or argument and its value. RIIS_LIMIT_EXCEEDED if the integration of the step needs more than a
!! million smaller steps.
subroutine riisf_opening_angle_advance(pressure_gain, flow_gain, friction, vortex_gain, angle_min, angle_max, time, &
    pressure_difference, flow, state, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use riis_c, only: RIIS_OK, riis_opening_angle, riis_opening_angle_advance, riis_opening_angle_init, &
      riis_opening_angle_state, riis_opening_angle_state_init, riis_status
  implicit none
  real(c_double), intent(in) :: pressure_gain             !< K_p in the paper, >= 0. This field and the next three have the
                                                          !! default NaN, which is refused.
  real(c_double), intent(in) :: flow_gain                 !< K_q, >= 0.
  real(c_double), intent(in) :: friction                  !< K_f, >= 0.
  real(c_double), intent(in) :: vortex_gain               !< K_v, >= 0.
  real(c_double), intent(in) :: angle_min                 !< The angle of the closed valve in degrees, 0 to 90. Usually 0.
  real(c_double), intent(in) :: angle_max                 !< The angle of the open valve in degrees, above angle_min, at most
                                                          !! 90. Usually 75.
  real(c_double), intent(in) :: time                      !< At least state(1).
  real(c_double), intent(in) :: pressure_difference       !< The values at `time`, each at most 1e30 in magnitude.
  real(c_double), intent(in) :: flow                      !< The values at `time`, each at most 1e30 in magnitude.
  real(c_double), intent(inout) :: state(7)               !< Time, opening, rate, angle in degrees, its rate, pressure
                                                          !! difference, flow (NaN: none yet). Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_angle) :: law
  type(riis_opening_angle_state) :: before
  type(riis_opening_angle_state) :: now
  status = riis_opening_angle_init(law, c_sizeof(law))
  if (status == RIIS_OK) status = riis_opening_angle_state_init(before, c_sizeof(before))
  if (status /= RIIS_OK) return
  law%pressure_gain = pressure_gain
  law%flow_gain = flow_gain
  law%friction = friction
  law%vortex_gain = vortex_gain
  law%angle_min = angle_min
  law%angle_max = angle_max
  before%time = state(1)
  before%opening = state(2)
  before%rate = state(3)
  before%angle = state(4)
  before%angle_rate = state(5)
  before%pressure_difference = state(6)
  before%flow = state(7)
  now = before
  status = riis_opening_angle_advance(law, before, time, pressure_difference, flow, now)
  if (status /= RIIS_OK) return
  state = [now%time, now%opening, now%rate, now%angle, now%angle_rate, now%pressure_difference, now%flow]
end subroutine riisf_opening_angle_advance

! -----------------------------------------------------------------------------------------------------------------
! Placing and warping by a patient's landmarks
! -----------------------------------------------------------------------------------------------------------------

!> Sets a valve's sizes to a patient's sizes, in centimetres, and finds the placement of the valve. Errors: RIIS_INVALID_ARGUMENT
!! if landmarks are missing, too many, in one place, collinear or mirrored, and if they do not show the direction of flow.
!! RIIS_INVALID_ARGUMENT also if the distances between landmarks are too large or too small for a heart valve at this scale. The
!! message names the landmarks. The axis of a tricuspid or mitral_coapting valve must be at most 20 degrees from the normal of
!! the annulus. A mitral valve must satisfy three conditions: - The posterior horn is on the posterior side of the annulus, and
!! the trigones are on the anterior side. - The axis of the fitted valve is at most 20 degrees from the annulus' normal. - The
!! fitted AP_diameter differs from the depth of the annulus by at most a twelfth of this depth, or by at most five times the
!! noise. The depth is measured from the anterior horn to the posterior horn, or if there is no posterior horn, to the farthest
!! point of the annulus. RIIS_INVALID_PARAMETER for a valve from patches, for an unknown name in `held`, and for sizes that do
!! not fit together.
subroutine riisf_place(valve, n_landmarks, xyz, role, leaflet_id, scale, noise, flow, held, rotation_axis, &
    rotation_angle, translation, residual, size_state, status)
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, end_for_c, location_of
  use riis_c, only: RIIS_OK, riis_landmarks, riis_landmarks_init, riis_place, riis_placement, riis_placement_arrays, &
      riis_placement_arrays_init, riis_status
  implicit none
  integer(int64), intent(in) :: valve                     !< A valve of any kind with any parameters. Lengths that no landmark
                                                          !! determines keep their proportions. Translation, opening and the
                                                          !! open state of riisf_valve_set_open_state do not change.
  integer(int32), intent(in) :: n_landmarks               !< 1 to 10,000.
  real(c_double), intent(in) :: xyz(3, *)                 !< (3, n_landmarks): the points, in mesh units.
  integer(int32), intent(in) :: role(*)                   !< (n_landmarks): RIIS_LANDMARK_*.
  integer(int32), intent(in) :: leaflet_id(2, *)          !< (2, n_landmarks): the ids of up to two leaflets for each landmark.
                                                          !! For a nadir or an attachment point, pass the id of its cusp, and
                                                          !! -1. For a commissure, pass the ids of its two leaflets in any
                                                          !! order. Pass -1 and -1 if the leaflets are not known. For an aortic
                                                          !! or tricuspid valve, enough ids must be known to name all leaflets.
                                                          !! For other kinds with cusps, if no id is known, the cusp of the
                                                          !! first nadir becomes cusp 0.
  real(c_double), intent(in) :: scale                     !< The number of mesh units in a centimetre: 10 for millimetres, 1
                                                          !! for centimetres, or 0.01 for metres. This field must be set.
  real(c_double), intent(in) :: noise                     !< The standard deviation of each coordinate of the landmarks, mesh
                                                          !! units, >= 0. RIIS_AUTO: 0.03 * scale.
  real(c_double), intent(in) :: flow(3)                   !< The direction of flow, a vector of any length. 0: not known.
                                                          !! bileaflet: must be set. mitral: needed unless both commissures or
                                                          !! both horns show the side of the atrium. mitral_coapting: needed
                                                          !! unless the anterior horn and both commissures are among the
                                                          !! landmarks. tricuspid: needed unless the leaflets of two
                                                          !! commissures are known.
  character(len=*), intent(in) :: held                    !< The names of the parameters whose values must not change,
                                                          !! separated by blanks or commas. '' stands for no name.
  real(c_double), intent(inout) :: rotation_axis(3)       !< Unit vector.
  real(c_double), intent(inout) :: rotation_angle         !< Degrees, 0 to 180.
  real(c_double), intent(inout) :: translation(3)         !< Mesh units.
  real(c_double), intent(inout) :: residual(*)            !< (n_landmarks): the distance of each landmark from its place on the
                                                          !! closed valve, mesh units.
  integer(int32), intent(inout) :: size_state(*)          !< (number of parameters): RIIS_SIZE_*.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  character(len=len_trim(held) + 1, kind=c_char) :: c_held
  type(riis_landmarks) :: landmarks
  type(riis_placement_arrays) :: arrays
  type(riis_placement) :: placement
  status = riis_landmarks_init(landmarks, c_sizeof(landmarks))
  if (status == RIIS_OK) status = riis_placement_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  landmarks%n_landmarks = n_landmarks
  landmarks%x = location_of(xyz(1, 1))
  landmarks%y = location_of(xyz(2, 1))
  landmarks%z = location_of(xyz(3, 1))
  landmarks%stride = 3
  landmarks%role = location_of(role)
  landmarks%leaflet_id = location_of(leaflet_id)
  landmarks%scale = scale
  landmarks%noise = noise
  landmarks%flow = flow
  call end_for_c(held, c_held)
  arrays%residual = location_of(residual)
  arrays%size_state = location_of(size_state)
  status = riis_place(c_handle_of(valve), landmarks, c_held, arrays, placement, c_sizeof(placement))
  if (status /= RIIS_OK) return
  rotation_axis = placement%rotation_axis
  rotation_angle = placement%rotation_angle
  translation = placement%translation
end subroutine riisf_place

!> Makes a warp from landmarks on the unwarped valve. The map is the identity until riisf_warp_set_targets gives it targets.
!! Errors: RIIS_INVALID_ARGUMENT for a bad landmark or field, if two landmarks coincide, and if all landmarks lie on a line. The
!! message names the landmark or field and its value.
subroutine riisf_warp_create(n_landmarks, xyz, noise, scale, rotation_axis, rotation_angle, translation, warp, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: handle_of, location_of
  use riis_c, only: RIIS_OK, riis_points, riis_points_init, riis_status, riis_surface_options, &
      riis_surface_options_init, riis_warp_create, riis_warp_options, riis_warp_options_init
  implicit none
  integer(int32), intent(in) :: n_landmarks               !< 3 to 1000.
  real(c_double), intent(in) :: xyz(3, *)                 !< (3, n_landmarks), mesh units: give the placement of
                                                          !! riisf_surface_create.
  real(c_double), intent(in) :: noise                     !< The standard deviation of each coordinate of the targets, 0 to
                                                          !! 1e50. The map is smoothed until it misses the targets by about
                                                          !! this noise. 0: the map takes the landmarks exactly to the targets.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12, usually 1.
  real(c_double), intent(in) :: rotation_axis(3)          !< A vector with a length of at least 1e-50 and components up to
                                                          !! 1e50, usually (0, 0, 1).
  real(c_double), intent(in) :: rotation_angle            !< Degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6,
                                                          !! usually 0.
  real(c_double), intent(in) :: translation(3)            !< A shift in mesh units, -1e50 to 1e50, usually 0. Calls refuse a
                                                          !! shift of a valve that would round coordinates by more than a
                                                          !! thousandth of tolerance * half_thickness.
  integer(int64), intent(inout) :: warp                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: sources
  type(riis_warp_options) :: options
  type(riis_surface_options), target :: placement
  type(c_ptr) :: c_handle
  status = riis_points_init(sources, c_sizeof(sources))
  if (status == RIIS_OK) status = riis_warp_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_surface_options_init(placement, c_sizeof(placement))
  if (status /= RIIS_OK) return
  sources%n_points = n_landmarks
  sources%x = location_of(xyz(1, 1))
  sources%y = location_of(xyz(2, 1))
  sources%z = location_of(xyz(3, 1))
  sources%stride = 3
  options%noise = noise
  placement%scale = scale
  placement%rotation_axis = rotation_axis
  placement%rotation_angle = rotation_angle
  placement%translation = translation
  options%placement = c_loc(placement)
  c_handle = c_null_ptr
  status = riis_warp_create(sources, options, c_handle)
  if (status /= RIIS_OK) return
  warp = handle_of(c_handle)
end subroutine riisf_warp_create

!> Sets the targets to which the warp takes its landmarks. Earlier targets have no influence on the map, not even on its last
!! bits. Errors: RIIS_INVALID_ARGUMENT for a bad point; the message names the point. RIIS_INVALID_PARAMETER for a warp that
!! folds. To find folds, the call computes the determinant of the map's derivative half way between each landmark and the
!! landmark nearest to it. The warp folds if any of these determinants is 0 or less. A larger noise in the options smooths the
!! map more, and may prevent folds.
subroutine riisf_warp_set_targets(warp, n_landmarks, xyz, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_support, only: c_handle_of, location_of
  use riis_c, only: RIIS_OK, riis_points, riis_points_init, riis_status, riis_warp_set_targets
  implicit none
  integer(int64), intent(in) :: warp                      !< From riisf_warp_create, for example.
  integer(int32), intent(in) :: n_landmarks               !< As many as the warp has.
  real(c_double), intent(in) :: xyz(3, *)                 !< (3, n_landmarks): the points, in mesh units.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: targets
  status = riis_points_init(targets, c_sizeof(targets))
  if (status /= RIIS_OK) return
  targets%n_points = n_landmarks
  targets%x = location_of(xyz(1, 1))
  targets%y = location_of(xyz(2, 1))
  targets%z = location_of(xyz(3, 1))
  targets%stride = 3
  status = riis_warp_set_targets(c_handle_of(warp), targets)
end subroutine riisf_warp_set_targets

!> Warps a valve by one or two maps, which are copied. At every opening the maps move the valve's curves, before the placement.
!! Errors: RIIS_INVALID_ARGUMENT for `open` without `closed`. RIIS_INVALID_PARAMETER for a bileaflet valve, which is rigid.
subroutine riisf_valve_set_warp(valve, closed, open, status)
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of
  use riis_c, only: riis_status, riis_valve_set_warp
  implicit none
  integer(int64), intent(in) :: valve                     !< From riisf_valve_create, for example.
  integer(int64), intent(in) :: closed                    !< The warp at opening 0; 0: the valve loses its warp.
  integer(int64), intent(in) :: open                      !< The warp at opening 1; 0: the same as `closed`.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_valve_set_warp(c_handle_of(valve), c_handle_of(closed), c_handle_of(open))
end subroutine riisf_valve_set_warp

!> Destroys the warp. Valves with this warp keep their copies. The handle becomes 0. Nothing happens to a handle that is 0.
subroutine riisf_warp_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_support, only: c_handle_of, handle_of
  use riis_c, only: riis_warp_destroy
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_warp_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_warp_destroy
