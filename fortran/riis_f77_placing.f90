! SPDX-License-Identifier: Apache-2.0
!> The external subroutines that place and warp a valve by a patient's landmarks. The conventions are those of riis_f77.f90.

!> Sets a valve's sizes, in centimetres, to those of a patient, and finds its placement, for riisf_surface_create. Lengths that no
!! landmark bears on keep the valve's proportions. Errors: RIIS_INVALID_ARGUMENT naming landmarks that are missing, in one place,
!! collinear, mirrored or not those of a heart valve at this scale; RIIS_INVALID_PARAMETER for a valve from patches and for sizes
!! that do not fit together.
subroutine riisf_place(valve, n_landmarks, xyz, role, leaflet_id, scale, noise, flow, held, rotation_axis, rotation_angle, &
    translation, residual, size_state, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_landmarks, riis_placement, riis_placement_arrays, riis_status, RIIS_OK, riis_c_string, &
    riis_landmarks_init, riis_place, riis_placement_arrays_init
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: valve                     !< A kind of valve. Unchanged on an error.
  integer(int32), intent(in) :: n_landmarks               !< 1 to 10,000.
  real(c_double), intent(in) :: xyz(3, *)                 !< (3, n_landmarks), in mesh units.
  integer(int32), intent(in) :: role(*)                   !< (n_landmarks): RIIS_LANDMARK_*.
  integer(int32), intent(in) :: leaflet_id(2, *)          !< (2, n_landmarks): of a nadir, its cusp and -1; of a commissure, its
                                                          !! two cusps; -1 and -1: not known.
  real(c_double), intent(in) :: scale                     !< Mesh units in a centimetre: 10 for millimetres, 0.01 for metres.
  real(c_double), intent(in) :: noise                     !< Standard deviation of each coordinate; RIIS_AUTO: 0.03 * scale.
  real(c_double), intent(in) :: flow(3)                   !< The direction of flow; 0 0 0: not known.
  character(len=*), intent(in) :: held                    !< Parameters that keep their values, separated by blanks; ' ': none.
  real(c_double), intent(inout) :: rotation_axis(3)       !< Written on success, as the next arguments.
  real(c_double), intent(inout) :: rotation_angle         !< Degrees.
  real(c_double), intent(inout) :: translation(3)         !< Mesh units.
  real(c_double), intent(inout) :: residual(*)            !< (n_landmarks), mesh units.
  integer(int32), intent(inout) :: size_state(*)          !< (number of parameters): RIIS_SIZE_*.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_landmarks) :: landmarks
  type(riis_placement) :: placement
  type(riis_placement_arrays) :: arrays
  status = riis_landmarks_init(landmarks, c_sizeof(landmarks))
  if (status /= RIIS_OK) return
  landmarks%n_landmarks = n_landmarks
  if (n_landmarks > 0) then
    landmarks%x = location_of(xyz(1:1, 1))
    landmarks%y = location_of(xyz(2:2, 1))
    landmarks%z = location_of(xyz(3:3, 1))
    landmarks%role = location_of(role)
    landmarks%leaflet_id = location_of(leaflet_id)
  end if
  landmarks%stride = 3
  landmarks%scale = scale
  landmarks%noise = noise
  landmarks%flow = flow
  status = riis_placement_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  if (n_landmarks > 0) arrays%residual = location_of(residual)
  arrays%size_state = location_of(size_state)
  status = riis_place(c_handle_of(valve), landmarks, riis_c_string(held), arrays, placement, c_sizeof(placement))
  if (status /= RIIS_OK) return
  rotation_axis = placement%rotation_axis
  rotation_angle = placement%rotation_angle
  translation = placement%translation
end subroutine riisf_place

!> Makes a warp from landmarks on a valve, which are in mesh units: give the placement of riisf_surface_create. Until
!! riisf_warp_set_targets, it is the identity. Errors: RIIS_INVALID_ARGUMENT naming the landmark, counted from 0. Two landmarks in
!! one place are refused, and so are landmarks on a line.
subroutine riisf_warp_create(n_landmarks, xyz, noise, scale, rotation_axis, rotation_angle, translation, warp, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_points, riis_status, riis_surface_options, riis_warp_options, RIIS_OK, riis_surface_options_init, &
    riis_warp_create, riis_warp_options_init
  use riis_support, only: describe_points, handle_of
  implicit none
  integer(int32), intent(in) :: n_landmarks               !< 3 to 1000.
  real(c_double), intent(in) :: xyz(3, *)                 !< (3, n_landmarks).
  real(c_double), intent(in) :: noise                     !< Standard deviation of each coordinate of the targets; 0: none.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees.
  real(c_double), intent(in) :: translation(3)            !< Mesh units.
  integer(int64), intent(inout) :: warp                   !< Written on success. Free it with riisf_warp_destroy.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: points
  type(riis_surface_options), target :: placement
  type(riis_warp_options) :: options
  type(c_ptr) :: c_handle
  status = describe_points(int(n_landmarks, int64), xyz, points)
  if (status == RIIS_OK) status = riis_surface_options_init(placement, c_sizeof(placement))
  if (status == RIIS_OK) status = riis_warp_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  placement%scale = scale
  placement%rotation_axis = rotation_axis
  placement%rotation_angle = rotation_angle
  placement%translation = translation
  options%noise = noise
  options%placement = c_loc(placement)
  c_handle = c_null_ptr
  status = riis_warp_create(points, options, c_handle)
  if (status == RIIS_OK) warp = handle_of(c_handle)
end subroutine riisf_warp_create

!> Takes the landmarks to these places, in each time step. Valves that have the warp keep the map until riisf_valve_set_warp.
!! Errors: RIIS_INVALID_ARGUMENT naming the landmark; RIIS_INVALID_PARAMETER for a warp that folds, with the place.
subroutine riisf_warp_set_targets(warp, n_landmarks, xyz, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_points, riis_status, RIIS_OK, riis_warp_set_targets
  use riis_support, only: c_handle_of, describe_points
  implicit none
  integer(int64), intent(in) :: warp                      !< Unchanged on an error.
  integer(int32), intent(in) :: n_landmarks               !< As many as the warp has.
  real(c_double), intent(in) :: xyz(3, *)                 !< (3, n_landmarks), mesh units.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_points) :: points
  status = describe_points(int(n_landmarks, int64), xyz, points)
  if (status == RIIS_OK) status = riis_warp_set_targets(c_handle_of(warp), points)
end subroutine riisf_warp_set_targets

!> Gives a valve copies of the maps of two warps. Errors: RIIS_INVALID_ARGUMENT for `open` without `closed`;
!! RIIS_INVALID_PARAMETER for a bileaflet valve.
subroutine riisf_valve_set_warp(valve, closed, open, status)
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_valve_set_warp
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: valve                     !< Unchanged on an error.
  integer(int64), intent(in) :: closed                    !< The warp at opening 0; 0: the valve loses its warp.
  integer(int64), intent(in) :: open                      !< The warp at opening 1; 0: the same as `closed`.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_valve_set_warp(c_handle_of(valve), c_handle_of(closed), c_handle_of(open))
end subroutine riisf_valve_set_warp

!> Frees a warp and sets its handle to 0.
subroutine riisf_warp_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_warp_destroy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_warp_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_warp_destroy
