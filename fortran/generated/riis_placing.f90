! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_placing.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The sizes and the placement of a valve from a patient's landmarks: riis_place of riis.h, as a part of module riis.
module riis_placing
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_loc, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_landmarks, riis_placement, riis_placement_arrays, riis_status, RIIS_OK, c_place => riis_place, &
    riis_c_string, riis_landmarks_init, riis_placement_arrays_init, riis_valve_get_n_parameters
  use riis_support
  use riis_valves, only: riis_valve
  implicit none
  private
  public :: riis_place

  !> Sets a valve's sizes to a patient's sizes, and finds its placement.
  interface riis_place
    module procedure place
  end interface riis_place

contains

  !> Sets a valve's sizes, in centimetres, to a patient's sizes, and finds its placement. The valve's values are the template:
  !! lengths that depend on no landmark keep their proportions. The surface has arguments with the names of the components of the
  !! placement. Errors: RIIS_INVALID_ARGUMENT naming landmarks that are missing, in one place, collinear, mirrored, or too large
  !! or small for a heart valve at this scale, and landmarks that contradict the fitted mitral valve (riis.h);
  !! RIIS_INVALID_PARAMETER for a valve from patches and for sizes that do not fit together.
  subroutine place(valve, xyz, role, scale, placement, leaflet_id, flow, noise, held, residual, standard_error, &
      size_state, places, status)
    class(riis_valve), intent(inout) :: valve               !< Must be created from a kind's name. Unchanged on an error.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_landmarks), in mesh units.
    integer(int32), intent(in), contiguous, target :: role(:) !< (n_landmarks): RIIS_LANDMARK_*.
    real(c_double), intent(in) :: scale                     !< Mesh units in a centimetre: 10 for millimetres, 0.01 for metres.
    type(riis_placement), intent(inout) :: placement        !< Unchanged on an error. worst_landmark_id counts from 0.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:, :) !< (2, n_landmarks): for a nadir or a point of
                                                            !! the attachment, its cusp and -1; for a commissure, its two cusps.
                                                            !! Default -1: not known.
    real(c_double), intent(in), optional :: flow(:)         !< (3), the direction of flow. Default: not known.
    real(c_double), intent(in), optional :: noise           !< Standard deviation of each coordinate. Default 0.03 * scale.
    character(len=*), intent(in), optional :: held          !< Parameters that keep their values, separated by blanks.
    real(c_double), intent(inout), contiguous, optional, target :: residual(:) !< (n_landmarks), mesh units.
    real(c_double), intent(inout), contiguous, optional, target :: standard_error(:) !< (number of parameters).
    integer(int32), intent(inout), contiguous, optional, target :: size_state(:) !< (number of parameters): RIIS_SIZE_*.
    real(c_double), intent(inout), contiguous, optional, target :: places(:, :) !< (3, n_landmarks): the landmarks' places on the
                                                            !! valve, mesh units: the sources of a warp to the landmarks.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_landmarks) :: landmarks
    type(riis_placement_arrays) :: arrays
    type(strided_points) :: points
    character(len=:, kind=c_char), allocatable :: names
    integer(int64) :: n_parameters
    code = check_created(valve%c_handle(), 'the valve')
    if (code == RIIS_OK) code = riis_valve_get_n_parameters(valve%c_handle(), n_parameters)
    if (code == RIIS_OK) code = riis_landmarks_init(landmarks, c_sizeof(landmarks))
    if (code == RIIS_OK) code = riis_placement_arrays_init(arrays, c_sizeof(arrays))
    if (code == RIIS_OK) call points_of(xyz, 'xyz', points, code)
    if (code == RIIS_OK) code = check_size(size(role, kind=int64), points%n, 'role', 'one for each landmark')
    if (present(leaflet_id) .and. code == RIIS_OK) &
      code = check_size(size(leaflet_id, kind=int64), 2 * points%n, 'leaflet_id', 'two for each landmark')
    if (present(flow) .and. code == RIIS_OK) &
      code = check_size(size(flow, kind=int64), 3_int64, 'flow', 'x, y, z')
    if (present(residual) .and. code == RIIS_OK) &
      code = check_size(size(residual, kind=int64), points%n, 'residual', 'one for each landmark')
    if (present(standard_error) .and. code == RIIS_OK) &
      code = check_size(size(standard_error, kind=int64), n_parameters, 'standard_error', 'one for each parameter')
    if (present(size_state) .and. code == RIIS_OK) &
      code = check_size(size(size_state, kind=int64), n_parameters, 'size_state', 'one for each parameter')
    if (present(places) .and. code == RIIS_OK) &
      code = check_size(size(places, kind=int64), 3 * points%n, 'places', 'three for each landmark')
    landmarks%n_landmarks = points%n
    landmarks%x = points%x
    landmarks%y = points%y
    landmarks%z = points%z
    landmarks%stride = points%stride
    if (code == RIIS_OK) then
      if (points%n > 0) landmarks%role = c_loc(role)
      if (present(leaflet_id) .and. points%n > 0) landmarks%leaflet_id = c_loc(leaflet_id)
      landmarks%scale = scale
      if (present(noise)) landmarks%noise = noise
      if (present(flow)) landmarks%flow = flow
      names = riis_c_string('')
      if (present(held)) names = riis_c_string(held)
      if (present(residual) .and. points%n > 0) arrays%residual = c_loc(residual)
      if (present(standard_error)) arrays%standard_error = c_loc(standard_error)
      if (present(size_state)) arrays%size_state = c_loc(size_state)
      if (present(places) .and. points%n > 0) arrays%place = c_loc(places)
      code = c_place(valve%c_handle(), landmarks, names, arrays, placement, c_sizeof(placement))
    end if
    call finish(code, status)
  end subroutine place

end module riis_placing
