! SPDX-License-Identifier: Apache-2.0
! Tests module riis: surfaces from keyframes, warps, velocities of the caller's vertices, and closest points of a mask and of a
! list. The results are compared with closed forms and with riis_c.
program test_frames
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_loc, c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use box
  use checks
  use riis
  use riis_c, only: c_get_triangles => riis_surface_get_triangles, c_triangles => riis_triangles
  implicit none
  real(c_double), parameter :: square(3, 4) = reshape([0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 1d0, 1d0, 0d0, 0d0, 1d0, 0d0], [3, 4])
  integer(int32), parameter :: quad(4, 1) = reshape([1, 2, 3, 4], [4, 1]), halves(3, 2) = reshape([1, 2, 3, 1, 3, 4], [3, 2])
  real(c_double), parameter :: time(4) = [0d0, 0.25d0, 0.5d0, 1d0], height(4) = [0d0, 0.1d0, 0.3d0, 0d0]
  real(c_double) :: frames(3, 4, 4)
  integer(riis_status) :: status
  integer :: k

  do k = 1, 4
    frames(:2, :, k) = square(:2, :)
    frames(3, :, k) = height(k)
  end do
  call test_keyframes()
  call test_period()
  call test_bad_keyframes()
  call test_warps()
  call test_bad_warps()
  call test_velocities_of_arrays()
  call test_skirts()
  call test_bad_velocities()
  call make_box()
  call test_masks()
  call test_bad_masks()
  call free_box()
  call finish()

contains

  ! Checks that the square is at the given height everywhere and moves up at the given speed.
  subroutine check_height(surface, height, speed, what)
    type(riis_triangles) :: all_triangles
    type(riis_surface), intent(in) :: surface
    real(c_double), intent(in) :: height, speed
    character(len=*), intent(in) :: what
    real(c_double), pointer :: xyz(:, :), velocity(:, :)
    call surface%get_triangles(all_triangles)
    xyz => all_triangles%xyz
    call surface%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    call check(size(xyz, 2) == 4 .and. size(velocity, 2) == 4 .and. lbound(velocity, 2) == 1, what // ': four vertices')
    if (size(velocity, 2) /= 4) return
    call check(all(abs(xyz(3, :) - height) < 1d-14) .and. all(abs(velocity(3, :) - speed) < 1d-12) .and. &
      all(abs(velocity(:2, :)) <= 0), what)
  end subroutine check_height

  subroutine test_keyframes()
    type(c_triangles) :: from_c
    type(riis_triangles) :: all_triangles
    type(riis_keyframes) :: keyframes, others
    type(riis_surface) :: surface
    type(riis_surface_info) :: info
    real(c_double) :: mine(3, 4, 4)
    real(c_double), pointer :: velocity(:, :)
    integer(int32), pointer :: leaflet_id(:)
    integer(int64) :: n
    type(c_ptr) :: own_velocities, of_c
    mine = frames
    call check(.not. keyframes%is_created(), 'empty at first')
    call keyframes%create(time, mine, quad, [7])
    mine = 0 ! the arrays were copied, so they may change
    call surface%create_from_keyframes(keyframes, 0.125d0, half_thickness=0.2d0, scale=2d0, translation=[0d0, 0d0, 5d0])
    call check_height(surface, 5.1d0, 0.8d0, 'placed')
    call surface%get_triangles(all_triangles)
    leaflet_id => all_triangles%leaflet_id
    call check(size(leaflet_id) == 2 .and. all(leaflet_id == 7), 'with leaflets')
    call surface%update_from_keyframes(keyframes, 0.25d0, scale=1d0, translation=[0d0, 0d0, 0d0])
    call check_height(surface, 0.1d0, 0.8d0, 'the velocity behind a key')
    call surface%update_from_keyframes(keyframes, 0.75d0, dt=0.625d0)
    call check_height(surface, 0.15d0, 0.1d0 / 0.625d0, 'the mean velocity')
    call surface%update_from_keyframes(keyframes, 0.125d0, -0.625d0, .false., 0.3d0, 0.1d0, 1d0, [0d0, 0d0, 1d0], 0d0, &
      [0d0, 0d0, 0d0], .true., 1)
    call check_height(surface, 0.05d0, 0.1d0 / 0.625d0, 'back in time')
    call surface%get_info(info)
    call check(same(info%half_thickness, 0.3d0), 'with another half thickness')
    call surface%update_from_keyframes(keyframes, 9d0)
    call check_height(surface, 0d0, 0d0, 'at rest behind the last key')

    ! The pointer to the velocities has the address of the library's array.
    n = 0
    of_c = c_null_ptr
    call surface%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    own_velocities = c_loc(velocity(1, 1))
    call check_ok(c_get_triangles(surface%c_handle(), from_c, storage_size(from_c, int64) / 8), 'triangles from riis_c')
    call check(from_c%n_vertices == 4 .and. c_associated(own_velocities, from_c%velocity), 'no copy of velocities')
    call surface%destroy()

    ! The keyframes `others` also have leaflet ids and cubic interpolation. The vertex ids of these keyframes are of the other
    ! integer kind and count from 0.
    call others%create(time, frames, int(halves - 1, int64), [7, 8], index_base=0, interpolation=RIIS_INTERPOLATION_CUBIC)
    call surface%create_from_keyframes(others, 0.25d0, 0d0, .true., 0.2d0, 0.1d0, 1d0, [0d0, 0d0, 1d0], 0d0, &
      [0d0, 0d0, 0d0], .false., 1)
    ! The slope at a key is the weighted harmonic mean of the slopes on both sides.
    call check_height(surface, 0.1d0, 2 / (1 / 0.4d0 + 1 / 0.8d0), 'cubic')
    call surface%destroy()
    call surface%create_from_keyframes(keyframes, 0.25d0)
    call keyframes%destroy()
    call check_height(surface, 0.1d0, 0.8d0, 'a surface outlives its keyframes')
    call check(.not. keyframes%is_created() .and. .not. c_associated(keyframes%c_handle()), 'destroyed')
    call keyframes%destroy()
    call surface%destroy()
    call others%destroy()
  end subroutine test_keyframes

  subroutine test_period()
    type(riis_keyframes) :: keyframes, empty(2), copies(2)
    type(riis_surface) :: surface
    integer :: i
    call keyframes%create(time, frames, halves, period=1d0, interpolation=int(RIIS_INTERPOLATION_LINEAR, int64))
    call surface%create_from_keyframes(keyframes, 0.125d0)
    do i = -3, 3
      call surface%update_from_keyframes(keyframes, i + 0.125d0)
      call check_height(surface, 0.05d0, 0.4d0, 'in every period')
    end do
    copies = empty
    call check(.not. copies(2)%is_created(), 'an empty copy is empty')
    call surface%destroy()
    call keyframes%destroy()
  end subroutine test_period

  subroutine test_bad_keyframes()
    type(riis_keyframes) :: keyframes
    type(riis_surface) :: surface
    real(c_double) :: bad(3, 4, 4)
    call surface%create_from_keyframes(keyframes, 0d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'keyframes was not created, or was destroyed')
    call keyframes%create(time, frames(:2, :, :), quad, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the first extent of xyz is 2; it must be 3')
    call keyframes%create(time, frames(:, :, :3), quad, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of xyz(1, 1, :) is 3; there are 4 times of keys')
    call keyframes%create(time(:0), frames(:, :, :0), quad, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'frames.n_keys is 0')
    call keyframes%create(time, frames(:, :0, :), quad, status=status)
    call check_refused(status, RIIS_INVALID_SURFACE, 'there are no vertices')
    call keyframes%create(time, frames, quad(:2, :), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the first extent of vertex_ids is 2; it must be 3 or 4')
    call keyframes%create(time, frames, quad(:, :0), status=status)
    call check_refused(status, RIIS_INVALID_SURFACE, 'there are no faces')
    call keyframes%create(time, frames, quad, [1, 2], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of leaflet_id is 2; there are 1 faces')
    call keyframes%create(time, frames, quad, index_base=2, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'index_base is 2')
    call keyframes%create(time, frames, quad + 1, status=status)
    call check_refused(status, RIIS_INVALID_SURFACE, 'corner 3 of face 0 is 5')
    call keyframes%create(time([1, 3, 2, 4]), frames, quad, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'frames.time of key 2 is 0.25; it must be above')
    call keyframes%create(time, frames, quad, period=0.75d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'frames.time of key 3 is 1, beyond the period of 0.75')
    call keyframes%create(time, frames, quad, period=-1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'frames.period is -1')
    call keyframes%create(time, frames, quad, interpolation=5, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'frames.interpolation is 5')
    call keyframes%create(time, frames, quad, interpolation='cubic', status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'interpolation is neither')
    bad = frames
    bad(2, 3, 2) = 1d99
    call keyframes%create(time, bad, quad, status=status)
    call check_refused(status, RIIS_INVALID_SURFACE, 'y of vertex 2 in frame 1 is 1e+99')
    bad = frames
    bad(3, 1, 4) = 1
    call keyframes%create(time, bad, quad, period=1d0, status=status)
    call check_refused(status, RIIS_INVALID_SURFACE, 'vertex 0 in the last frame')
    call check(.not. keyframes%is_created(), 'refused keyframes are empty')

    call keyframes%create(time, frames, quad)
    call keyframes%create(time, frames, quad, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'keyframes was already created')
    call surface%update_from_keyframes(keyframes, 0d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call surface%create_from_keyframes(keyframes, 0d0, tolerance=7d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.tolerance is 7')
    call surface%create_from_keyframes(keyframes, 0d0, translation=[1d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of translation is 1')
    call surface%create_from_keyframes(keyframes, 1d31, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'time is 1e+31')
    call check(.not. surface%is_created(), 'a refused surface is empty')
    call surface%create_from_keyframes(keyframes, 0.125d0)
    call surface%create_from_keyframes(keyframes, 0d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was already created')
    call surface%update_from_keyframes(keyframes, 1d31, half_thickness=9d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'time is 1e+31')
    call check_height(surface, 0.05d0, 0.4d0, 'refused updates change nothing')
    call surface%destroy()
    call keyframes%destroy()
  end subroutine test_bad_keyframes

  ! Velocities are given as xyz or as x, y, z, with ids of either kind. The call that makes the surface gives the velocities, or a
  ! later call does. The placement turns the velocities about z and doubles them.

  ! Landmarks on the attachment of a placed valve are widened and lifted by factors. The warped valve is larger by the same
  ! factors.
  subroutine test_warps()
    type(riis_valve) :: valve, before, again
    type(riis_warp) :: warp, in_place
    type(riis_warp_info) :: info
    type(riis_surface) :: surface, plain
    type(riis_surface_info) :: sizes(2)
    type(riis_attachment) :: attachment
    type(riis_triangles) :: triangles
    type(riis_valve_patches) :: patches
    real(c_double), allocatable :: sources(:, :), targets(:, :), mapped(:, :), keys(:, :, :)
    integer :: i, n

    call valve%create('trileaflet')
    call valve%set('opening', 0.5d0)
    call plain%create(valve, scale=10d0, translation=[1d0, 2d0, 3d0])
    call plain%get_info(sizes(1))
    call plain%get_attachment(attachment)
    n = 0
    allocate (sources(3, 0))
    do i = 1, size(attachment%edges, 3), 4 ! two lines begin at each root
      if (is_new(sources, attachment%edges(:, 1, i))) sources = reshape([sources, attachment%edges(:, 1, i)], [3, n + 1])
      n = size(sources, 2)
    end do
    allocate (targets(3, n), mapped(3, n), keys(3, n, 2))
    targets = 2 * sources
    call warp%create(sources, scale=10d0, translation=[1d0, 2d0, 3d0])
    call check(warp%is_created() .and. c_associated(warp%c_handle()), 'a warp')
    call warp%set_targets(targets)
    call warp%get_info(info)
    call check(info%n_landmarks == n .and. info%largest_residual < 1d-11 .and. abs(info%least_determinant - 8) < 1d-9, 'twice')
    call warp%map(sources, mapped)
    call check(all(abs(mapped - targets) < 1d-11), 'mapped landmarks')
    call valve%set_warp(warp)
    call surface%create(valve, scale=10d0, translation=[1d0, 2d0, 3d0])
    call surface%get_info(sizes(2))
    call check(abs(sizes(2)%area - 4 * sizes(1)%area) < 0.02d0 * sizes(2)%area, 'four times the area')
    call check(all(abs(sizes(2)%upper - 2 * sizes(1)%upper) < 0.2d0), 'twice the size')

    ! The annulus moves up by 1 in half a unit of time.
    keys(:, :, 1) = targets
    keys(:, :, 2) = targets
    keys(3, :, 2) = targets(3, :) + 1
    call valve%copy(before)
    call warp%set_targets_at([0d0, 0.5d0], keys, 0.25d0)
    call valve%set_warp(warp, warp)
    call surface%update_moving(valve, before, 0.25d0)
    call surface%get_triangles(triangles)
    call check(all(abs(triangles%velocity(3, :) - 2) < 1d-9) .and. all(abs(triangles%velocity(:2, :)) < 1d-9), 'moved up')
    call warp%set_targets_at([0d0, 0.5d0, 1d0], keys(:, :, [1, 2, 1]), 2.25d0, 1d0, int(RIIS_INTERPOLATION_LINEAR, int64))
    call warp%map(sources(:, :1), mapped(:, :1))
    call check(abs(mapped(3, 1) - targets(3, 1) - 0.5d0) < 1d-11, 'a period later')

    call valve%set_warp()
    call surface%update(valve)
    call surface%get_info(sizes(2))
    call check(abs(sizes(2)%area - sizes(1)%area) < 1d-12 * sizes(1)%area, 'without a warp')
    call valve%get_patches(patches)
    call check(size(patches%curve_id, 2) == 12 .and. all(abs(patches%bulge) <= 0) .and. all(patches%attached >= 2), 'patches')
    call again%create_from_patches(patches%degree, patches%control, patches%curve_id, patches%reversed == 1, &
      patches%leaflet_id, 0)
    call surface%update(again)
    call surface%get_info(sizes(2))
    call check(abs(sizes(2)%area - sizes(1)%area) < 0.01d0 * sizes(1)%area, 'the same valve from its patches')
    call in_place%create(sources, 0.1d0, rotation_axis=[0d0, 0d0, 2d0], rotation_angle=30d0)
    call in_place%destroy()
    call warp%destroy()
    call check(.not. warp%is_created(), 'destroyed')
    call surface%destroy()
    call plain%destroy()
    call valve%destroy()
    call before%destroy()
    call again%destroy()
  end subroutine test_warps

  ! Returns whether a point differs from all other points.
  pure logical function is_new(others, point)
    real(c_double), intent(in) :: others(:, :), point(3)
    integer :: k
    is_new = .true.
    do k = 1, size(others, 2)
      is_new = is_new .and. sum(abs(others(:, k) - point)) > 1d-6
    end do
  end function is_new

  subroutine test_bad_warps()
    type(riis_warp) :: warp, empty(2), copies(2)
    type(riis_warp_info) :: info
    type(riis_valve) :: valve
    type(riis_valve_patches) :: patches
    real(c_double) :: sources(3, 6), mapped(3, 6)
    sources = reshape([1d0, 0d0, 0d0, 0d0, 1d0, 0d0, -1d0, 0d0, 0d0, 0d0, -1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, -1d0], [3, 6])
    copies = empty
    call warp%set_targets(sources, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the warp was not created, or was destroyed')
    call warp%set_targets_at([0d0], reshape(sources, [3, 6, 1]), 0d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the warp was not created, or was destroyed')
    call warp%map(sources, mapped, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the warp was not created, or was destroyed')
    call warp%get_info(info, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the warp was not created, or was destroyed')
    call warp%create(sources(:2, :), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the first extent of sources is 2')
    call warp%create(sources(:, :2), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'sources.n_points is 2')
    call warp%create(sources(:, [1, 2, 3, 4, 5, 2]), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'landmarks 1 and 5 are in one place')
    call warp%create(sources(:, [1, 3, 5]) * reshape([1d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 0d0, 0d0], [3, 3]), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'all 3 landmarks lie on a line')
    call warp%create(sources, -1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.noise is -1')
    call warp%create(sources, scale=0d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.placement.scale is 0')
    call warp%create(sources, rotation_axis=[1d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of rotation_axis is 1')
    call warp%create(sources)
    call warp%create(sources, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the warp was already created')
    call warp%set_targets(sources(:, :5), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'targets.n_points is 5')
    call warp%set_targets(sources(:, [2, 1, 3, 4, 5, 6]), status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'the warp folds near landmark')
    call warp%set_targets_at([0d0, 1d0], reshape(sources, [3, 6, 1]), 0d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'xyz(1, 1, :)')
    call warp%set_targets_at([0d0], reshape(sources(:, :5), [3, 5, 1]), 0d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'frames.n_vertices is 5')
    call warp%map(sources, mapped(:, :5), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of mapped is (3, 5)')
    call valve%set_warp(warp, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call valve%get_patches(patches, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call valve%create('bileaflet')
    call valve%set_warp(warp, status=status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'the bileaflet valve cannot be warped')
    call valve%set_warp(open=warp, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'closed is NULL')
    call valve%set_warp(empty(1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'closed was not created')
    call valve%destroy()
    call warp%destroy()
  end subroutine test_bad_warps

  subroutine test_velocities_of_arrays()
    type(riis_triangles) :: all_triangles
    type(riis_surface) :: surface
    real(c_double), pointer :: velocity(:, :)
    real(c_double) :: v(3, 4), wide(6, 8), placed(3, 4)
    v = reshape([1d0, 2d0, 3d0, 4d0, 5d0, 6d0, 7d0, 8d0, 9d0, 10d0, 11d0, 12d0], [3, 4])
    placed = 2 * reshape([-v(2, :), v(1, :), v(3, :)], [3, 4], order=[2, 1])
    wide = -9
    wide(1::2, 1::2) = v
    call surface%create_from_arrays(square, halves, velocity=v, scale=2d0, rotation_angle=90d0, n_threads=1)
    call check_velocities(surface, placed, 'a matrix')
    call surface%update_from_arrays(square, int(quad, int64), velocity=wide(1::2, 1::2))
    call check_velocities(surface, placed, 'a section of a matrix')
    call surface%update_from_arrays(square(1, :), square(2, :), square(3, :), halves, vx=v(1, :), vy=v(2, :), vz=v(3, :))
    call check_velocities(surface, placed, 'three vectors')
    call surface%update_from_arrays(square(1, :), square(2, :), square(3, :), int(quad, int64), vx=wide(1, 1::2), &
      vy=wide(3, 1::2), vz=wide(5, 1::2))
    call check_velocities(surface, placed, 'sections of vectors')
    call surface%update_from_arrays(square, halves)
    call surface%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    call check(size(velocity) == 0, 'without velocities')
    call surface%destroy()
    call surface%create_from_arrays(square, int(halves, int64), velocity=v)
    call check_velocities(surface, v, 'at first, by ids of the other kind')
    call surface%destroy()
    call surface%create_from_arrays(square(1, :), square(2, :), square(3, :), halves, vx=v(1, :), vy=v(2, :), vz=v(3, :))
    call check_velocities(surface, v, 'at first, by three vectors')
    call surface%destroy()
  end subroutine test_velocities_of_arrays

  subroutine check_velocities(surface, expected, what)
    type(riis_triangles) :: all_triangles
    type(riis_surface), intent(in) :: surface
    real(c_double), intent(in) :: expected(:, :)
    character(len=*), intent(in) :: what
    real(c_double), pointer :: velocity(:, :)
    logical :: is_same
    call surface%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    is_same = size(velocity, 2) == size(expected, 2)
    if (is_same) is_same = all(abs(velocity - expected) < 1d-13)
    call check(is_same, 'velocities by ' // what)
  end subroutine check_velocities

  ! The unit square gets a skirt that leads away from its middle.
  subroutine test_skirts()
    type(riis_surface) :: surface
    type(riis_keyframes) :: keys
    real(c_double), parameter :: lengths(4) = 0.25d0
    real(c_double) :: middle(3), moved(3, 4), outwards(3, 4)
    integer :: i
    middle = sum(square, dim=2) / 4
    do i = 1, 4
      outwards(:, i) = (square(:, i) - middle) / norm2(square(:, i) - middle)
    end do
    call surface%create_from_arrays(square, halves, skirt_length=0.5d0)
    call check_outer(surface, square + 0.5d0 * outwards, 'chosen')
    call surface%update_from_arrays(square, int(quad, int64), skirt_length=0.5d0, attached=[.true., .true., .true., .true.], &
      skirt_lengths=lengths)
    call check_outer(surface, square + 0.25d0 * outwards, 'named')
    call surface%update_from_arrays(square, halves, skirt_length=0.5d0, attached=[.true., .true., .true.], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of attached is 3; there are 4 vertices')
    call surface%update_from_arrays(square, halves, skirt_length=0.5d0, skirt_lengths=lengths(:2), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of skirt_lengths is 2; there are 4 vertices')
    call surface%update_from_arrays(square, halves, skirt_length=-0.5d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'arrays.skirt_length is -0.5')
    call surface%destroy()
    moved = square + 1
    call keys%create([0d0, 1d0], reshape([square, moved], [3, 4, 2]), halves, skirt_length=0.5d0)
    call surface%create_from_keyframes(keys, 1d0)
    call check_outer(surface, moved + 0.5d0 * outwards, 'of frames')
    call surface%destroy()
    call keys%destroy()
  end subroutine test_skirts

  subroutine check_outer(of, expected, what)
    type(riis_triangles) :: all_triangles
    type(riis_surface), intent(in) :: of
    real(c_double), intent(in) :: expected(:, :)
    character(len=*), intent(in) :: what
    real(c_double), pointer :: xyz(:, :)
    logical :: is_same
    integer :: i
    call of%get_triangles(all_triangles)
    xyz => all_triangles%xyz
    is_same = size(xyz, 2) == 8
    ! The outer vertices have the order of the attached edges.
    if (is_same) is_same = all([(minval(norm2(expected - spread(xyz(:, i), 2, 4), dim=1)) < 1d-13, i=5, 8)])
    call check(is_same, 'the skirt, ' // what)
  end subroutine check_outer

  subroutine test_bad_velocities()
    type(riis_surface) :: surface
    real(c_double) :: v(3, 4), x(4)
    v = 1
    x = 0
    call surface%create_from_arrays(square, quad, velocity=v(:2, :), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of velocity is (2, 4); it must be (3, n)')
    call surface%create_from_arrays(square, quad, velocity=v(:, :3), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of velocity(1, :) is 3; there are 4 vertices')
    call surface%create_from_arrays(square, quad, velocity=v(:, :0), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of velocity(1, :) is 0; there are 4 vertices')
    call surface%create_from_arrays(square, quad, velocity=v(:, 4:1:-1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'velocity is a section with a stride of -24 bytes')
    call surface%create_from_arrays(square(1, :), square(2, :), square(3, :), quad, vx=x, vy=x, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'vx, vy and vz are not all given')
    call surface%create_from_arrays(square(1, :), square(2, :), square(3, :), quad, vx=x, vy=x(:3), vz=x, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the sizes of vx, vy and vz are 4, 3 and 4; they must be equal')
    call surface%create_from_arrays(square(1, :), square(2, :), square(3, :), quad, vx=x(:3), vy=x(:3), vz=x(:3), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of vx is 3; there are 4 vertices')
    call surface%create_from_arrays(square(1, :), square(2, :), square(3, :), quad, vx=x, vy=v(1, :), vz=x, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the strides of vx, vy and vz are 1, 3 and 1; they must be equal')
    v(2, 3) = 1d99
    call surface%create_from_arrays(square, quad, velocity=v, status=status)
    call check_refused(status, RIIS_INVALID_SURFACE, 'velocity y of vertex 2 is 1e+99')
    call surface%create_from_arrays(square, quad, n_threads=-1, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.n_threads is -1')
    call check(.not. surface%is_created(), 'a refused surface is empty')
  end subroutine test_bad_velocities

  ! Only the points of a mask or a list get results, which equal those of a query of all points.
  subroutine test_masks()
    real(c_double), allocatable :: all_distances(:), distance(:), point(:, :), expected_distance(:)
    integer(int8), allocatable :: bytes(:)
    logical, allocatable :: mask(:)
    integer(int64), allocatable :: list(:)
    type(riis_marks) :: result
    type(riis_mesh) :: mesh
    integer(int64), pointer :: node_id(:)
    integer :: i
    allocate (all_distances(n_nodes), distance(n_nodes), point(3, n_nodes), bytes(n_nodes))
    call surface%closest_points(xyz, distance=all_distances)
    allocate (mask(n_nodes), source=[(mod(i, 3) == 0, i = 1, n_nodes)])
    bytes = merge(1_int8, 0_int8, mask)
    allocate (expected_distance, source=merge(all_distances, -7d0, mask))
    distance = -7
    call surface%closest_points(xyz, distance=distance, point_mask=mask)
    call check(all(same(distance, expected_distance)), 'a mask')
    distance = -7
    call surface%closest_points(xyz, distance=distance, point_mask=bytes, n_threads=2)
    call check(all(same(distance, expected_distance)), 'a mask of bytes')
    distance = -7
    call surface%closest_points(xyz(1, :), xyz(2, :), xyz(3, :), distance=distance, point_mask=mask)
    call check(all(same(distance, expected_distance)), 'separate coordinates and a mask')
    distance = -7
    call surface%closest_points(xyz(1, :), xyz(2, :), xyz(3, :), distance=distance, point_mask=bytes)
    call check(all(same(distance, expected_distance)), 'separate coordinates and a mask of bytes')

    allocate (list, source=pack([(int(i - 1, int64), i = 1, n_nodes)], mask))
    distance = -7
    call surface%closest_points(xyz, distance=distance, point_id=list)
    call check(all(same(distance, expected_distance)), 'a list')
    distance = -7
    call surface%closest_points(xyz(1, :), xyz(2, :), xyz(3, :), distance=distance, point_id=list(::2))
    call check(all(same(distance(list(::2) + 1), all_distances(list(::2) + 1))) .and. &
      count(same(distance, -7d0)) == n_nodes - size(list(::2)), 'separate coordinates and a section of a list')
    distance = -7
    call surface%closest_points(xyz, distance=distance, point_id=list(:0))
    call check(all(same(distance, -7d0)), 'a list of none is not a list of all')

    ! Reads the marked nodes through the result's pointer. The call gathers and scatters nothing.
    call mesh%create(xyz)
    call riis_mark_nodes(surface, mesh, result, fields=RIIS_FIELD_POINT)
    call result%marked(node_id)
    distance = -7
    point = -7
    call surface%closest_points(xyz, distance=distance, point=point, point_id=node_id)
    call check(all(same(distance(node_id + 1), all_distances(node_id + 1))) .and. &
      count(.not. same(distance, -7d0)) == size(node_id), 'the marked nodes')
    call check(all(all(same(point, -7d0), 1) .eqv. same(distance, -7d0)), 'and their points')
    call result%destroy()
    call mesh%destroy()
  end subroutine test_masks

  subroutine test_bad_masks()
    real(c_double) :: distance(4)
    distance = -7
    call surface%closest_points(square, distance=distance, point_mask=[.true.], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of point_mask is 1; there are 4 points')
    call surface%closest_points(square, distance=distance, point_mask=[1_int8], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of point_mask is 1; there are 4 points')
    call surface%closest_points(square, distance=distance, point_id=[2_int64, 1_int64], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.point_ids: entry 1 is 1')
    call surface%closest_points(square, distance=distance, point_id=[4_int64], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.point_ids: entry 0 is 4')
    call surface%closest_points(square, distance=distance, point_id=[0_int64, 1_int64, 2_int64, 3_int64, 4_int64], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.n_point_ids is 5')
    call surface%closest_points(square, distance=distance, point_id=[1_int64], point_mask=distance < 0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.point_ids and options.point_mask are both given')
    call check(all(same(distance, -7d0)), 'refused calls write nothing')
  end subroutine test_bad_masks
end program test_frames
