! SPDX-License-Identifier: Apache-2.0
! Tests module riis: a valve's sizes and placement from landmarks. The landmarks are made from known sizes and a known placement.
program test_placing
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use checks
  use riis
  implicit none
  real(c_double), parameter :: pi = acos(-1d0), radius = 1.1d0, top = 1.3d0, height = 1.5d0
  integer(int32), parameter :: role(6) = [1, 1, 1, 0, 0, 0]
  integer(riis_status) :: status

  call test_known_valve()
  call test_refusals()
  call finish()

contains

  ! Landmarks of a trileaflet valve in millimetres, turned by 90 degrees about x and moved.
  function landmarks() result(xyz)
    real(c_double) :: xyz(3, 6), p(3)
    integer :: i
    do i = 1, 6
      p = merge([radius, 0d0, 0d0], [top, height, 0d0], i <= 3)
      p = [p(1) * cos(angle(i)), p(1) * sin(angle(i)), p(2)]
      xyz(:, i) = 10 * [p(1), -p(3), p(2)] + [30d0, -20d0, 7d0]
    end do
  end function landmarks

  real(c_double) function angle(i)
    integer, intent(in) :: i
    angle = merge(120 * (i - 1), 120 * (i - 4) + 60, i <= 3) * pi / 180
  end function angle

  subroutine test_known_valve()
    type(riis_valve) :: valve
    type(riis_placement) :: placement
    real(c_double) :: residual(6), errors(17), found(3), wide(4, 12), places(3, 6)
    integer(int32) :: states(17), cusps(2, 6)
    call valve%create('trileaflet')
    cusps = -1
    cusps(1, 1:3) = [RIIS_LEAFLET_RIGHT, RIIS_LEAFLET_LEFT, RIIS_LEAFLET_NON_CORONARY]
    call riis_place(valve, landmarks(), role, 10d0, placement, cusps, [0d0, -1d0, 0d0], 0.3d0, residual=residual, &
      standard_error=errors, size_state=states, places=places)
    call check(all(abs(places - landmarks()) < 1d-8), 'the places are those of exact landmarks')
    call valve%get('root_radius', found(1))
    call valve%get('leaflet_radius_out', found(2))
    call valve%get('leaflet_height', found(3))
    call check(all(abs(found - [radius, top, height]) < 1d-9), 'the sizes')
    call check(all(residual < 1d-9) .and. placement%rms < 1d-9 .and. placement%n_undetermined == 0, 'the residuals')
    call check(all(states(1:4) == [RIIS_SIZE_DETERMINED, RIIS_SIZE_DETERMINED, RIIS_SIZE_DETERMINED, RIIS_SIZE_TIED]) &
      .and. all(errors(1:3) > 0.01d0) .and. all(errors(1:3) < 0.05d0), 'the states of the sizes')
    call check(abs(placement%scale - 10) < 1d-15 .and. abs(placement%rotation_angle - 90) < 1d-7 .and. &
      abs(placement%rotation_axis(1) - 1) < 1d-9, 'the rotation')
    ! The valve's own translation is -1.2 along z, which is -y of the mesh.
    call check(all(abs(placement%translation - [30d0, -32d0, 7d0]) < 1d-8), 'the translation')

    ! Landmarks in an array section give the same placement. A held size keeps its value.
    wide = 0
    wide(2:4, 1:11:2) = landmarks()
    call valve%set('leaflet_height', 1.6d0)
    call riis_place(valve, wide(2:4, 1:11:2), role, 10d0, placement, held='leaflet_height ')
    call valve%get('leaflet_height', found(3))
    call check(abs(found(3) - 1.6d0) < 1d-15 .and. placement%worst > 0.3d0 .and. placement%worst < 0.6d0, 'a held size')
    call valve%destroy()
  end subroutine test_known_valve

  subroutine test_refusals()
    type(riis_valve) :: valve, empty
    type(riis_placement) :: placement
    real(c_double) :: xyz(3, 6), short(5)
    integer(int32) :: cusps(2, 6), few(3)
    xyz = landmarks()
    call riis_place(empty, xyz, role, 10d0, placement, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call valve%create('aortic')
    call riis_place(valve, xyz, role, 10d0, placement, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'does not say which nadir')
    cusps = -1
    cusps(1, 1:3) = [RIIS_LEAFLET_LEFT, RIIS_LEAFLET_RIGHT, RIIS_LEAFLET_NON_CORONARY]
    call riis_place(valve, xyz, role, 10d0, placement, cusps, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'mirrored')
    call riis_place(valve, xyz, role, 1d0, placement, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'landmarks.scale is 1 (centimetres)')
    call riis_place(valve, xyz, role(1:5), 10d0, placement, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'role')
    call riis_place(valve, xyz(1:2, :), role, 10d0, placement, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of xyz is (2, 6)')
    call riis_place(valve, xyz, role, 10d0, placement, cusps(:, 1:5), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'leaflet_id')
    call riis_place(valve, xyz, role, 10d0, placement, flow=[1d0, 2d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'flow')
    call riis_place(valve, xyz, role, 10d0, placement, residual=short, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'residual')
    call riis_place(valve, xyz, role, 10d0, placement, places=xyz(:, 1:5), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'places')
    call riis_place(valve, xyz, role, 10d0, placement, standard_error=short, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'standard_error')
    call riis_place(valve, xyz, role, 10d0, placement, size_state=few, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'size_state')
    call valve%destroy()
    call test_wrong_landmarks()
  end subroutine test_refusals

  ! Tests faults in landmarks that are usual at a first try.
  subroutine test_wrong_landmarks()
    type(riis_valve) :: valve
    type(riis_placement) :: placement
    real(c_double) :: xyz(3, 6), annulus(3, 13)
    integer(int32) :: cusps(2, 6), roles(13)
    integer :: i
    call valve%create('trileaflet')
    xyz = landmarks()
    xyz(:, 2) = xyz(:, 1) + 0.01d0
    call riis_place(valve, xyz, role, 10d0, placement, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'landmark 0 (nadir) and landmark 1 (nadir) are in one place')
    do i = 1, 6
      xyz(:, i) = [3d0, 6d0, 9d0] * i
    end do
    call riis_place(valve, xyz, role, 10d0, placement, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the landmarks lie along a line')
    xyz = landmarks()
    xyz(1, :) = -xyz(1, :)
    cusps = -1
    cusps(1, 1:3) = [RIIS_LEAFLET_RIGHT, RIIS_LEAFLET_LEFT, RIIS_LEAFLET_NON_CORONARY]
    call riis_place(valve, xyz, role, 10d0, placement, cusps, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'mirrored')
    call valve%destroy()

    call valve%create('mitral')
    roles = RIIS_LANDMARK_ANNULUS
    roles(13) = RIIS_LANDMARK_ANTERIOR_HORN
    do i = 1, 12
      annulus(:, i) = [18 * sin(pi * i / 6), 12 * cos(pi * i / 6), 4 * cos(pi * i / 3)]
    end do
    annulus(:, 13) = annulus(:, 12)
    call riis_place(valve, annulus, roles, 10d0, placement, flow=[0d0, 0d0, -1d0], status=status)
    call check(status == RIIS_OK, 'an annulus in order')
    annulus(:, [3, 5]) = annulus(:, [5, 3])
    call riis_place(valve, annulus, roles, 10d0, placement, flow=[0d0, 0d0, -1d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the annulus crosses itself')
    call valve%destroy()

    call valve%create('coapting')
    call valve%set('coaptation_height', 2d0)
    call riis_place(valve, landmarks(), role, 10d0, placement, held='coaptation_height', status=status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'commissure_height 1.5, and then coaptation_height is 2')
    call valve%destroy()
  end subroutine test_wrong_landmarks

end program test_placing
