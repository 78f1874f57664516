! SPDX-License-Identifier: Apache-2.0
!> The external subroutine that places a valve by a patient's landmarks. The conventions are those of riis_f77.f90.

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
