! SPDX-License-Identifier: Apache-2.0
! Tests module riis: surfaces that move, the fields at closest points, and the resistance. The results are compared with closed
! forms and other queries.
program test_resistance
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_loc, c_ptr
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use box
  use checks
  use riis
  use riis_c, only: c_mark_list => riis_mark_list, c_get_list => riis_marks_get_list
  implicit none
  integer, parameter :: all_fields = RIIS_FIELD_POINT + RIIS_FIELD_NORMAL + RIIS_FIELD_BARYCENTRIC + RIIS_FIELD_SIDE + &
    RIIS_FIELD_RIM + RIIS_FIELD_UV + RIIS_FIELD_VELOCITY + RIIS_FIELD_PATCH
  real(c_double), parameter :: pi = acos(-1d0), R = 3d0, eps = 0.3d0, spacing = 0.14d0
  type(riis_mesh) :: mesh
  type(riis_surface) :: plate
  integer(riis_status) :: status

  call make_box()
  call mesh%create(xyz)
  call make_plate()
  call test_copy()
  call test_velocities()
  call test_placement_before()
  call test_fixed_triangles()
  call test_motion_errors()
  call test_directions()
  call test_fields()
  call test_fields_not_asked_for()
  call test_resistance_of_plate()
  call test_offset()
  call test_reaction()
  call test_band_sums()
  call test_errors()
  call test_no_nodes()
  call plate%destroy()
  call mesh%destroy()
  call free_box()
  call finish()

contains

  ! Makes the square from -1 to 1 at z = 0. The square moves there from z = -0.01 in 2 ms, so its velocity u is 5 upwards.
  subroutine make_plate()
    type(riis_valve) :: square
    real(c_double) :: corners(3, 4)
    corners = reshape([-1d0, -1d0, 0d0, 1d0, -1d0, 0d0, 1d0, 1d0, 0d0, -1d0, 1d0, 0d0], [3, 4])
    call square%create_from_patches([1, 1, 1, 1], corners(:, [1, 2, 4, 3, 1, 4, 2, 3]), reshape([1, 2, 3, 4], [4, 1]))
    call plate%create(square, half_thickness=eps)
    call plate%update_moving(square, square, 0.002d0, translation_before=[0d0, 0d0, -0.01d0])
    call square%destroy()
  end subroutine make_plate

  subroutine test_copy()
    type(riis_valve) :: original, copy
    real(c_double) :: radius
    call original%copy(copy, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call original%create('aortic')
    call original%set('root_radius', 1.3d0)
    call original%copy(copy)
    call original%copy(copy, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'copy was already created')
    call original%destroy()
    call copy%get('root_radius', radius)
    call check(same(radius, 1.3d0), 'a copy has the parameters, and outlives its original')
    call copy%destroy()
  end subroutine test_copy

  ! While a valve opens, a vertex's velocity is its displacement between the two openings, divided by the time.
  subroutine test_velocities()
    type(riis_triangles) :: all_triangles
    type(riis_valve) :: before, now
    type(riis_surface) :: moving, still
    real(c_double), pointer :: velocity(:, :), from(:, :), to(:, :)
    real(c_double), allocatable :: forth(:, :)
    call before%create('mitral')
    call before%copy(now)
    call before%set('opening', 0.5d0)
    call now%set('opening', 0.5001d0)
    call moving%create(before)
    call moving%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    call check(size(velocity, 1) == 3 .and. size(velocity, 2) == 0, 'no velocity yet')
    call moving%update_moving(now, before, 0.25d0)
    call moving%get_triangles(all_triangles)
    to => all_triangles%xyz
    call moving%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    call still%create(before)
    call still%get_triangles(all_triangles)
    from => all_triangles%xyz
    call check(size(velocity, 2) == size(to, 2) .and. size(from, 2) == size(to, 2), 'a velocity for every vertex')
    ! The parameters u and v of a vertex depend on the opening. The displacements therefore belong to one point of the leaflet
    ! only to second order.
    call check(maxval(abs(velocity - (to - from) / 0.25d0)) < 0.02d0 * maxval(abs(velocity)), 'the way by the time')
    allocate (forth, source=velocity)
    call moving%update_moving(now, before, -0.25d0)
    call moving%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    call check(all(abs(forth + velocity) <= 0), 'back in time')
    call moving%update_moving(now, now, 1d0)
    call moving%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    call check(size(velocity, 2) == size(forth, 2) .and. all(abs(velocity) <= 0), 'at rest')
    call moving%update(now)
    call moving%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    call check(size(velocity) == 0, 'an update without a state before takes the velocity away')
    call moving%destroy()
    call moving%get_triangles(all_triangles, status)
    velocity => all_triangles%velocity
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call still%destroy()
    call now%destroy()
    call before%destroy()
  end subroutine test_velocities

  ! The placement turns the surface about z and enlarges it. Each vertex x comes from a position in the earlier placement.
  subroutine test_placement_before()
    type(riis_triangles) :: all_triangles
    type(riis_surface) :: moving
    real(c_double), pointer :: velocity(:, :), at(:, :)
    real(c_double) :: c, s
    c = cos(30 * pi / 180)
    s = sin(30 * pi / 180)
    call moving%create(valve)
    call moving%update_moving(valve, valve, 0.5d0, half_thickness=0.2d0, tolerance=0.1d0, scale=2d0, &
      rotation_axis=[0d0, 0d0, 1d0], rotation_angle=0d0, translation=[1d0, 2d0, 3d0], flip_normals=.true., &
      measure=RIIS_MEASURE_TRIANGLES, measure_tolerance=RIIS_AUTO, n_threads=1, scale_before=1d0, &
      rotation_axis_before=[0d0, 0d0, 2d0], rotation_angle_before=30d0, translation_before=[0d0, 0d0, 0d0])
    call moving%get_triangles(all_triangles)
    at => all_triangles%xyz
    call moving%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    associate (x => (at(1, :) - 1) / 2, y => (at(2, :) - 2) / 2, z => (at(3, :) - 3) / 2)
      call check(maxval(abs(velocity(1, :) - (at(1, :) - (c * x - s * y)) / 0.5d0)) < 1d-12 .and. &
        maxval(abs(velocity(2, :) - (at(2, :) - (s * x + c * y)) / 0.5d0)) < 1d-12 .and. &
        maxval(abs(velocity(3, :) - (at(3, :) - z) / 0.5d0)) < 1d-12, 'turned, grown and moved')
    end associate
    ! If a part of the earlier placement is left out, it equals the present part.
    call moving%update_moving(valve, valve, 0.5d0, translation_before=[1d0, 2d0, 2d0])
    call moving%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    call check(all(abs(velocity(3, :) - 2) < 1d-13) .and. all(abs(velocity(:2, :)) < 1d-13), 'moved only')
    call moving%destroy()
  end subroutine test_placement_before

  ! The triangulation stays the same while a valve opens. The triangles equal those of riis_c.
  subroutine test_fixed_triangles()
    type(riis_triangles) :: all_triangles
    type(riis_valve) :: mitral, before
    type(riis_surface) :: fixed
    type(riis_surface_info) :: info
    integer(int64), pointer :: vertex_id(:, :)
    integer(int64), allocatable :: first(:, :)
    integer :: step
    call mitral%create('mitral')
    call mitral%set('opening', 0.2d0)
    call mitral%copy(before)
    call fixed%create(mitral, triangulation=RIIS_TRIANGULATION_FIXED)
    call fixed%get_triangles(all_triangles)
    vertex_id => all_triangles%vertex_id
    allocate (first, source=vertex_id)
    do step = 1, 2
      call mitral%set('opening', 0.2d0 + 0.1d0 * step)
      if (step == 1) call fixed%update(mitral)
      if (step == 2) call fixed%update_moving(mitral, before, 0.1d0, triangulation=RIIS_TRIANGULATION_FIXED)
      call fixed%get_triangles(all_triangles)
      vertex_id => all_triangles%vertex_id
      call check(size(vertex_id) == size(first), 'as many triangles at another opening')
      if (size(vertex_id) == size(first)) call check(all(vertex_id == first), 'with the same vertices')
      call fixed%get_info(info)
      call check(info%error_bound > 0 .and. info%error_bound <= 0.05d0 * info%half_thickness, 'within the bound')
    end do
    call mitral%set('surface_angle', 3d0)
    call fixed%update(mitral, status=status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'surface_angle')
    call fixed%update(mitral, triangulation=RIIS_TRIANGULATION_ADAPTED)
    call fixed%update(mitral, triangulation=7, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.triangulation is 7')
    call fixed%destroy()
    call before%destroy()
    call mitral%destroy()
  end subroutine test_fixed_triangles

  subroutine test_motion_errors()
    type(riis_surface) :: moving
    type(riis_valve) :: mitral, none
    type(riis_surface_info) :: info
    call moving%update_moving(valve, valve, 1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call moving%create(valve)
    call mitral%create('mitral')
    call moving%update_moving(none, valve, 1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'valve was not created')
    call moving%update_moving(valve, none, 1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'valve_before was not created')
    call moving%update_moving(valve, mitral, 1d0, status=status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'kind')
    call moving%update_moving(valve, valve, 0d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'dt is 0')
    call moving%update_moving(valve, valve, 1d0, half_thickness=0.5d0, scale_before=-1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options_before.scale is -1')
    call moving%update_moving(valve, valve, 1d0, translation_before=[1d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of translation_before is 1; it must be 3')
    call moving%update_moving(valve, valve, 1d0, rotation_axis_before=[1d0, 0d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of rotation_axis_before is 2; it must be 3')
    call moving%update(valve)
    call moving%get_info(info)
    call check(same(info%half_thickness, 0.1d0), 'a refused option is forgotten')
    call mitral%destroy()
    call moving%destroy()
  end subroutine test_motion_errors

  ! For two directions of the placement, the expected derivatives follow from the closest points on a rigid body.
  subroutine test_directions()
    type(riis_surface) :: moving
    type(riis_valve) :: mitral, none
    type(riis_marks) :: result
    type(riis_mark_list) :: list
    real(c_double), allocatable :: along_z(:)
    real(c_double), pointer :: rate(:, :)
    real(c_double) :: growth
    type(riis_surface_info) :: info
    call moving%get_direction(0_int64, rate, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call moving%add_direction(valve, valve, 1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call moving%create(valve)
    call mitral%create('mitral')
    call moving%add_direction(none, valve, 1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'valve_after was not created')
    call moving%add_direction(valve, none, 1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'valve_before was not created')
    call moving%add_direction(valve, mitral, 1d0, status=status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'valve_before is of the kind mitral')
    call moving%add_direction(valve, valve, 0d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'dp is 0')
    call moving%add_direction(valve, valve, 1d0, scale_after=-1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options_after.scale is -1')
    call moving%add_direction(valve, valve, 1d0, translation_before=[1d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of translation_before is 1; it must be 3')
    call riis_mark_nodes(moving, mesh, result, fields=RIIS_FIELD_GRADIENT, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface has no direction')
    call moving%get_direction(0_int64, rate, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'direction_id is 0, but the surface has no direction')
    call check(size(rate) == 0, 'no rates')
    call moving%add_direction(valve, valve, 0.02d0, translation_after=[0d0, 0d0, 0.01d0], translation_before=[0d0, 0d0, -0.01d0])
    call moving%add_direction(valve, valve, 0.02d0, translation_before=[0d0, 0d0, 0.02d0])
    call moving%add_direction(valve, valve, 0.02d0, scale_after=1.01d0, scale_before=0.99d0)
    call moving%get_direction(2_int64, rate, area_rate=growth)
    call moving%get_info(info)
    call check(abs(growth - 2 * info%area) < 1d-9 * info%area, 'the area grows as the square of the scale')
    call moving%update(valve)
    call moving%add_direction(valve, valve, 0.02d0, translation_after=[0d0, 0d0, 0.01d0], translation_before=[0d0, 0d0, -0.01d0])
    call moving%add_direction(valve, valve, 0.02d0, translation_before=[0d0, 0d0, 0.02d0])
    call moving%get_direction(1_int64, rate)
    call moving%get_info(info)
    call check(all(shape(rate, int64) == [3_int64, info%n_vertices]), 'a rate for every vertex')
    call check(all(abs(rate(1:2, :)) < 1d-9) .and. all(abs(rate(3, :) + 1) < 1d-9), 'downwards')
    call riis_mark_nodes(moving, mesh, result, fields=RIIS_FIELD_GRADIENT + RIIS_FIELD_POINT, R=2d0)
    call result%get_list(RIIS_LIST_MARKED, list)
    call check(list%n_nodes > 100 .and. all(shape(list%distance_gradient) == [2_int64, list%n_nodes]) .and. &
      all(shape(list%K_gradient) == [2_int64, list%n_nodes]), 'two directions for every node')
    allocate (along_z(list%n_nodes))
    along_z = (xyz(3, list%node_id + 1) - list%point(3, :)) / max(list%distance, tiny(1d0))
    call check(all(abs(list%distance_gradient(1, :) + along_z) < 1d-9 .or. list%distance < 1d-6), 'minus n.V')
    call check(all(abs(list%distance_gradient(2, :) + list%distance_gradient(1, :)) < 1d-9), 'the opposite direction')
    call check(all(abs(list%K_gradient(1, :)) <= 0 .or. list%K_gradient(1, :) * along_z > 0), 'K falls with the distance')
    call result%destroy()
    call mitral%destroy()
    call moving%destroy()
  end subroutine test_directions

  ! Every field is compared with closest points, and with the vertices of the triangles.
  subroutine test_fields()
    type(riis_triangles) :: all_triangles
    type(riis_surface) :: moving
    type(riis_valve) :: before
    type(riis_marks) :: result
    type(riis_mark_list) :: fields, marked
    type(c_mark_list) :: from_c
    type(c_ptr) :: own_points, own_rims
    integer(int64), pointer :: node_id(:), triangle_id(:), vertex_id(:, :), marked_id(:)
    integer(int32), pointer :: patch_id(:)
    real(c_double), pointer :: uv(:, :), velocity(:, :)
    real(c_double), allocatable :: point(:, :), normal(:, :), barycentric(:, :)
    integer(int32), allocatable :: side(:)
    logical :: is_interpolated
    integer :: i, j, n_means
    call before%create('aortic')
    call before%set('leaflet_angle', 25d0)
    call moving%create(before, half_thickness=0.12d0)
    call moving%update_moving(valve, before, 0.01d0)
    call riis_mark_nodes(moving, mesh, result, distance_limit=0.3d0, fields=all_fields)
    call result%within_limit(node_id, triangle_id=triangle_id)
    call result%get_list(RIIS_LIST_WITHIN_LIMIT, fields)
    call check(fields%n_nodes == size(node_id) .and. fields%n_nodes > 1000, 'fields of all nodes within the limit')
    allocate (point, mold=fields%point)
    allocate (normal, mold=fields%normal)
    allocate (barycentric, mold=fields%barycentric)
    allocate (side, mold=fields%side)
    call moving%closest_points(xyz(1, node_id + 1), xyz(2, node_id + 1), xyz(3, node_id + 1), point=point, normal=normal, &
      barycentric=barycentric, side=side)
    call check(all(same(fields%point, point)) .and. all(same(fields%normal, normal)) .and. &
      all(same(fields%barycentric, barycentric)) .and. all(fields%side == side), 'they are those of closest points')
    call moving%get_triangles(all_triangles)
    vertex_id => all_triangles%vertex_id
    patch_id => all_triangles%patch_id
    call moving%get_triangles(all_triangles)
    uv => all_triangles%uv
    call moving%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    is_interpolated = .true.
    n_means = 0
    do i = 1, size(node_id)
      j = int(triangle_id(i)) + 1
      is_interpolated = is_interpolated .and. fields%patch_id(i) == patch_id(j) .and. &
        all(abs(matmul(uv(:, vertex_id(:, j) + 1), barycentric(:, i)) - fields%uv(:, i)) < 1d-12)
      if (any(abs(matmul(velocity(:, vertex_id(:, j) + 1), barycentric(:, i)) - fields%velocity(:, i)) >= 1d-10)) &
        n_means = n_means + 1
    end do
    ! If two patches are equally near, as in a cusp's plane of symmetry, the velocity is the mean of the patches' velocities.
    call check(is_interpolated .and. n_means < size(node_id) / 20 .and. any(abs(fields%velocity) > 0.1d0), &
      'patches, u, v and velocities are the triangles''')
    call check(any(fields%rim == 1) .and. any(fields%rim == 0) .and. all(fields%rim == 0 .or. fields%rim == 1), 'the rim')

    ! The fields of the marked nodes have the same values, and they are not copied.
    call result%marked(marked_id)
    call result%get_list(RIIS_LIST_MARKED, marked)
    call check(marked%n_nodes == size(marked_id) .and. lbound(marked%velocity, 2) == 1, 'fields of marked nodes count from 1')
    j = 0
    do i = 1, size(node_id)
      if (j == size(marked_id)) exit
      if (node_id(i) /= marked_id(j + 1)) cycle
      j = j + 1
      if (.not. (all(same(marked%velocity(:, j), fields%velocity(:, i))) .and. all(same(marked%uv(:, j), fields%uv(:, i))) &
        .and. marked%side(j) == fields%side(i) .and. marked%patch_id(j) == fields%patch_id(i))) exit
    end do
    call check(j == size(marked_id), 'they are the same')
    status = c_get_list(result%c_handle(), RIIS_LIST_MARKED, from_c, storage_size(from_c, int64) / 8)
    own_points = c_loc(marked%point(1, 1))
    own_rims = c_loc(marked%rim(1))
    call check(c_associated(own_points, from_c%point) .and. c_associated(own_rims, from_c%rim), 'they are the library''s own')
    call result%destroy()
    call moving%destroy()
    call before%destroy()
  end subroutine test_fields

  subroutine test_fields_not_asked_for()
    type(riis_marks) :: result
    type(riis_mark_list) :: fields
    call riis_mark_nodes(surface, mesh, result, fields=RIIS_FIELD_SIDE)
    call result%get_list(RIIS_LIST_MARKED, fields)
    call check(size(fields%side) == size(expected) .and. size(fields%point, 2) == 0 .and. size(fields%point, 1) == 3 .and. &
      size(fields%uv, 1) == 2 .and. size(fields%rim) == 0 .and. fields%n_nodes == size(expected), 'one field alone')
    call riis_mark_nodes(surface, mesh, result, fields=RIIS_FIELD_VELOCITY, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'has no velocity')
    call riis_mark_nodes(surface, mesh, result, fields=2_int64**40, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'fields is 1099511627776; it must fit in 32 bits')
    call riis_mark_nodes(surface, mesh, result, fields='side', status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'fields is neither')
    call riis_mark_nodes(surface, mesh, result, fields=512, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.fields is 512')
    call result%destroy()
    call result%get_list(RIIS_LIST_MARKED, fields, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call check(fields%n_nodes == 0 .and. size(fields%side) == 0, 'nothing to point to')
    call result%get_list(RIIS_LIST_WITHIN_LIMIT, fields, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
  end subroutine test_fields_not_asked_for

  ! Returns K by the formula, at the node's distance from the square.
  function resistance_at(node, half_thickness, cuts_rim) result(k)
    integer, intent(in) :: node
    real(c_double), intent(in) :: half_thickness
    logical, intent(in) :: cuts_rim
    real(c_double) :: k, beside(2), d
    beside = max(abs(xyz(:2, node)) - 1, 0d0)
    d = norm2([beside, xyz(3, node)])
    k = 0
    if (d < half_thickness .and. .not. (cuts_rim .and. any(beside > 0))) &
      k = R / half_thickness * (1 + cos(pi * d / half_thickness)) / (2 * half_thickness)
  end function resistance_at

  ! An offset shifts the band along the normals, and flip_normals reverses these.
  subroutine test_offset()
    type(riis_valve) :: square
    type(riis_surface) :: surface
    type(riis_surface_info) :: info
    type(riis_marks) :: result
    real(c_double), allocatable :: coefficient(:)
    real(c_double) :: corners(3, 4), d
    integer :: i, turn
    corners = reshape([-9d0, -9d0, 0d0, 9d0, -9d0, 0d0, 9d0, 9d0, 0d0, -9d0, 9d0, 0d0], [3, 4])
    call square%create_from_patches([1, 1, 1, 1], corners(:, [1, 2, 4, 3, 1, 4, 2, 3]), reshape([1, 2, 3, 4], [4, 1]))
    call surface%create(square, half_thickness=eps, offset=0.5d0)
    allocate (coefficient(n_nodes))
    do turn = 1, -1, -2
      if (turn < 0) call surface%update(square, flip_normals=.true.)
      call surface%get_info(info)
      call check(same(info%offset, 0.5d0), 'an update keeps the offset')
      call riis_mark_nodes(surface, mesh, result)
      coefficient = 0
      call result%add_resistance(R, coefficient)
      do i = 1, n_nodes
        d = abs(xyz(3, i) - 0.5d0 * eps * turn)
        call check(abs(coefficient(i) - merge(R / (2 * eps**2) * (1 + cos(pi * d / eps)), 0d0, d < eps)) < 1d-11, 'K beside')
      end do
    end do
    call surface%update(square, offset=-1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.offset is -1')
    call square%destroy()
    call surface%destroy()
    call result%destroy()
  end subroutine test_offset

  subroutine test_resistance_of_plate()
    type(riis_marks) :: result
    real(c_double), allocatable :: coefficient(:), momentum(:, :), formula(:), wide(:, :)
    integer :: i
    allocate (coefficient(n_nodes), momentum(3, n_nodes), formula(n_nodes), wide(2, n_nodes))
    call riis_mark_nodes(plate, mesh, result, fields=RIIS_FIELD_VELOCITY + RIIS_FIELD_RIM)
    formula(:) = [(resistance_at(i, eps, .false.), i = 1, n_nodes)]
    coefficient = 0
    momentum = 0
    call result%add_resistance(R, coefficient, momentum)
    call check(all(abs(coefficient - formula) < 1d-11) .and. maxval(coefficient) > R / eps**2 - 1d-11, 'K')
    call check(all(abs(momentum(3, :) - 5 * formula) < 1d-9) .and. all(abs(momentum(:2, :)) < 1d-9), 'K u_surface')
    call result%add_resistance(R, coefficient)
    call check(all(abs(coefficient - 2 * formula) < 1d-11), 'it is added')
    call result%add_resistance(R, K_u_surface=momentum, half_thickness=RIIS_AUTO, rim=RIIS_RIM_ROUND)
    call check(all(abs(momentum(3, :) - 10 * formula) < 1d-9), 'the momentum alone')
    wide = 0
    call result%add_resistance(R, wide(2, :), half_thickness=0.2d0, rim=int(RIIS_RIM_CUT, int64))
    formula(:) = [(resistance_at(i, 0.2d0, .true.), i = 1, n_nodes)]
    call check(all(abs(wide(2, :) - formula) < 1d-11) .and. all(abs(wide(1, :)) <= 0), 'thinner, cut at the rim, into a section')
    call result%destroy()
  end subroutine test_resistance_of_plate

  subroutine test_reaction()
    type(riis_marks) :: result
    real(c_double), allocatable :: velocity(:, :), weight(:), coefficient(:)
    real(c_double) :: force(6)
    allocate (velocity(3, n_nodes), weight(n_nodes), coefficient(n_nodes))
    call riis_mark_nodes(plate, mesh, result, fields=RIIS_FIELD_VELOCITY)
    velocity(1, :) = 1
    velocity(2, :) = xyz(1, :)
    velocity(3, :) = 6
    weight = spacing**3
    weight(::3) = 0
    coefficient = 0
    call result%add_resistance(R, coefficient)
    force = 10
    call result%add_reaction(R, velocity, weight, force(::2))
    call check(all(abs(force(::2) - 10 - [sum(weight * coefficient), sum(weight * coefficient * xyz(1, :)), &
      sum(weight * coefficient)]) < 1d-11) .and. all(same(force(2::2), 10d0)), 'the force, by u - u_surface')
    call riis_mark_nodes(plate, mesh, result)
    force = 0
    call result%add_reaction(R, velocity, weight, force(:3), half_thickness=eps, rim=RIIS_RIM_ROUND)
    call check(abs(force(3) - 6 * sum(weight * coefficient)) < 1d-10, 'without velocities the surface is at rest')
    call test_sums_of_parts(result, velocity, weight)
    call result%destroy()
  end subroutine test_reaction

  ! Sums by leaflet and sums by edge add up to the whole, also in sections of larger arrays.
  subroutine test_sums_of_parts(result, velocity, weight)
    type(riis_marks), intent(inout) :: result
    real(c_double), intent(in) :: velocity(:, :), weight(:)
    type(riis_surface) :: cusps
    type(riis_valve) :: valve
    type(riis_surface_info) :: info
    type(riis_attachment) :: attachment
    real(c_double) :: force(3), moment(3), alone(3), about(3), of_leaflets(3, 8, 2), middle(3), turned(3), size_of
    real(c_double), allocatable :: of_edges(:, :, :)
    integer :: i
    call valve%create('trileaflet')
    call cusps%create(valve, half_thickness=eps)
    call cusps%get_info(info)
    call cusps%get_attachment(attachment)
    call check(info%largest_leaflet_id == 2 .and. size(attachment%edges, 3) > 20 .and. &
      size(attachment%vertex_id, 2) == size(attachment%edges, 3) .and. all(attachment%leaflet_id == attachment%patch_id / 4), &
      'the attachment of three cusps')
    call riis_mark_nodes(cusps, mesh, result, fields=RIIS_FIELD_POINT)
    allocate (of_edges(3, size(attachment%edges, 3), 2))
    force = 0
    moment = 0
    alone = 0
    of_leaflets = 0
    of_edges = 0
    about = [0.5d0, -1d0, 2d0]
    call result%add_reaction(R, velocity, weight, force, moment=moment, about=about, leaflet_force=of_leaflets(:, ::3, 1), &
      leaflet_moment=of_leaflets(:, ::3, 2), edges=attachment%edges, edge_force=of_edges(:, :, 1), &
      edge_moment=of_edges(:, :, 2), edge_leaflet_id=attachment%leaflet_id)
    size_of = sum(abs(of_edges(:, :, 1)))
    call check(size_of > 1d-3, 'there is a force')
    call check(all(abs(sum(of_leaflets(:, ::3, 1), 2) - force) < 1d-11 * size_of) .and. &
      all(abs(sum(of_leaflets(:, ::3, 2), 2) - moment) < 1d-10 * size_of) .and. all(same(of_leaflets(:, 2::3, 1), 0d0)), &
      'leaflets add up to the whole, in every third column')
    do i = 1, size(of_edges, 2)
      middle = (attachment%edges(:, 1, i) + attachment%edges(:, 2, i)) / 2 - about
      turned = cshift(middle, 1) * cshift(of_edges(:, i, 1), 2) - cshift(middle, 2) * cshift(of_edges(:, i, 1), 1)
      force = force - of_edges(:, i, 1)
      moment = moment - of_edges(:, i, 2) - turned
    end do
    call check(all(abs(force) < 1d-11 * size_of) .and. all(abs(moment) < 1d-10 * size_of), 'edges add up to the whole')
    call result%add_reaction(R, velocity, weight, leaflet_force=of_leaflets(:, :3, 2))
    call result%add_reaction(R, velocity, weight, alone)
    call result%add_reaction(R, velocity, weight, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'reaction has no array to add to')
    call result%add_reaction(R, velocity, weight, alone, leaflet_force=of_leaflets(:, :2, 1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'reaction.n_leaflets is 2, but the surface has the leaflet id 2')
    call result%add_reaction(R, velocity, weight, alone, leaflet_force=of_leaflets(:2, :3, 1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of leaflet_force is (2, 3); it must be (3, 3)')
    call result%add_reaction(R, velocity, weight, leaflet_force=of_leaflets(:, :3, 1), leaflet_moment=of_leaflets(:, :4, 2), &
      status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of leaflet_moment is (3, 4); it must be (3, 3)')
    call result%add_reaction(R, velocity, weight, moment=force(:2), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of moment is 2; it must be 3')
    call result%add_reaction(R, velocity, weight, alone, about=force(:1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of about is 1; it must be 3')
    call result%add_reaction(R, velocity, weight, edges=attachment%edges(:, :1, :), edge_force=of_edges(:, :, 1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, '); it must be (3, 2, n_edges)')
    call result%add_reaction(R, velocity, weight, edge_force=of_edges(:, :2, 1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of edge_force is (3, 2); it must be (3, 0)')
    call result%add_reaction(R, velocity, weight, edge_moment=of_edges(:, :0, 1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'reaction.n_edges is 0')
    call result%add_reaction(R, velocity, weight, edges=attachment%edges(:, :, :2), edge_force=of_edges(:, :2, 1), &
      edge_leaflet_id=attachment%leaflet_id(:1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of edge_leaflet_id is 1; there are 2 edges')
    call result%add_reaction(R, velocity, weight, edges=attachment%edges(:, :, :1), edge_force=of_edges(:, :1, 1), &
      edge_leaflet_id=[0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'no edge of leaflet 1')
    call riis_mark_nodes(cusps, mesh, result)
    call result%add_reaction(R, velocity, weight, moment=moment, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'needs RIIS_FIELD_POINT')
    call cusps%destroy()
    call cusps%get_attachment(attachment, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call check(size(attachment%edges) == 0 .and. size(attachment%leaflet_id) == 0, 'no edges on an error')
    call cusps%create_from_arrays(xyz(:, [1, 2, 30]), reshape([1, 2, 3], [3, 1]))
    call cusps%get_attachment(attachment, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'surface was made from arrays')
    call cusps%destroy()
    call valve%destroy()
    call valve%create('bileaflet')
    call cusps%create(valve)
    call cusps%get_attachment(attachment)
    call check(size(attachment%edges, 3) == 0, 'a bileaflet valve is not attached')
    call cusps%destroy()
    call valve%destroy()
  end subroutine test_sums_of_parts

  subroutine test_band_sums()
    type(riis_marks) :: result
    type(riis_band_sums) :: sums
    real(c_double), allocatable :: value(:), weight(:)
    logical :: in_band(n_nodes)
    integer :: side
    allocate (value(n_nodes), weight(n_nodes))
    call riis_mark_nodes(plate, mesh, result, distance_limit=0.4d0, fields=RIIS_FIELD_SIDE + RIIS_FIELD_RIM)
    value = 100 + xyz(1, :) + 10 * xyz(3, :)
    weight = 1 + xyz(2, :)
    call result%band_sums(0.2d0, 0.35d0, value, weight, sums)
    do side = 1, 2
      in_band = abs(xyz(1, :)) < 1 .and. abs(xyz(2, :)) < 1 .and. abs(xyz(3, :)) > 0.2d0 .and. abs(xyz(3, :)) < 0.35d0 .and. &
        (xyz(3, :) < 0 .eqv. side == 1)
      call check(sums%n_nodes(side) == count(in_band) .and. sums%n_nodes(side) > 100, 'the nodes of one side')
      call check(abs(sums%sum(side) - sum(weight * value, in_band)) < 1d-9 .and. &
        abs(sums%weight(side) - sum(weight, in_band)) < 1d-11, 'their sums')
    end do
    call result%destroy()
  end subroutine test_band_sums

  subroutine test_errors()
    type(riis_marks) :: result
    type(riis_band_sums) :: sums
    real(c_double), allocatable :: a(:), b(:, :)
    real(c_double) :: force(3)
    allocate (a(n_nodes), b(3, n_nodes))
    a = 1
    b = 1
    force = 1
    sums%n_nodes = 7
    call result%add_resistance(R, a, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call result%add_reaction(R, b, a, force, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call result%band_sums(0d0, eps, a, a, sums, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call riis_mark_nodes(plate, mesh, result)
    call result%add_resistance(R, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'none of K and K_u_surface is given')
    call result%add_resistance(R, a(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_nodes is 9260')
    call result%add_resistance(R, a, b(:2, :), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of K_u_surface is (2, 9261); it must be (3, 9261)')
    call result%add_resistance(R, a, b(:, 2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of K_u_surface is (3, 9260); it must be (3, 9261)')
    call result%add_resistance(R, a, b, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'K_u_surface needs RIIS_FIELD_VELOCITY')
    call result%add_resistance(-1d0, a, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'resistance.R is -1')
    call result%add_resistance(R, a, half_thickness=0.5d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'resistance.half_thickness is 0.5')
    call result%add_resistance(R, a, rim=17, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'resistance.rim is 17')
    call result%add_resistance(R, a, rim='cut', status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'rim is neither')
    call result%add_resistance(R, a, rim=RIIS_RIM_CUT, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'RIIS_RIM_CUT needs RIIS_FIELD_RIM')
    call result%add_reaction(R, b(:, 2:), a, force, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of velocity is (3, 9260)')
    call result%add_reaction(R, b, a, force(:2), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of force is 2; it must be 3')
    call result%add_reaction(R, b(:, 2:), a(2:), force, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_nodes is 9260')
    call result%band_sums(0d0, eps, a, a(2:), sums, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of weight is 9260; there are 9261 values')
    call result%band_sums(0d0, eps, a, a, sums, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'needs RIIS_FIELD_SIDE')
    call result%band_sums(0.2d0, 0.1d0, a, a, sums, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'inner is 0.2')
    call check(all(same(a, 1d0)) .and. all(same(b, 1d0)) .and. all(same(force, 1d0)) .and. all(sums%n_nodes == 7), &
      'refused calls write nothing')
    call result%destroy()
  end subroutine test_errors

  ! A rank without nodes makes the same calls as the other ranks.
  subroutine test_no_nodes()
    type(riis_mesh) :: empty
    type(riis_adjacency) :: adjacency
    type(riis_marks) :: result
    type(riis_mark_list) :: fields
    type(riis_band_sums) :: sums
    type(riis_leaks) :: leaks
    type(riis_leak_list) :: leak_list
    real(c_double) :: none(0), no_vectors(3, 0), force(3), one(1)
    integer(int64), pointer :: node_id(:)
    integer, allocatable :: node_num(:)
    logical :: marks(0)
    call empty%create(no_vectors)
    call check(empty%is_created() .and. empty%n_nodes() == 0, 'a mesh without nodes')
    call empty%prepare()
    call riis_mark_nodes(plate, empty, result, node_mask=marks, fields=all_fields)
    call result%marked(node_id)
    call result%marked_nodes(node_num)
    call result%get_list(RIIS_LIST_MARKED, fields)
    call result%dense(marks, none)
    call check(size(node_id) == 0 .and. size(node_num) == 0 .and. fields%n_nodes == 0 .and. size(fields%velocity, 2) == 0, &
      'has no marked ones')
    force = 1
    call result%add_resistance(R, none, no_vectors)
    call result%add_reaction(R, no_vectors, none, force)
    call result%band_sums(0d0, eps, none, none, sums)
    call check(all(same(force, 1d0)) .and. all(sums%n_nodes == 0) .and. all(same(sums%sum, 0d0)), 'and no force')
    call empty%set_adjacency([1], node_num)
    call riis_mark_nodes(plate, empty, result, search=RIIS_SEARCH_NEIGHBOR)
    call riis_find_leaks(plate, empty, result, leaks)
    call leaks%get_list(leak_list)
    call leaks%destroy()
    call check(leak_list%n_edges == 0, 'no leaks')
    call adjacency%create_from_cells(0, reshape([integer ::], [4, 0]))
    call empty%set_adjacency(adjacency)
    call riis_mark_nodes(plate, empty, result, search=RIIS_SEARCH_PAPER)
    call empty%update(none, none, none)
    call empty%update(0, one(1), one(1), one(1), 1)
    call empty%destroy()
    call adjacency%destroy()
    call empty%create(0_int64, one(1), one(1), one(1), 1_int64)
    call riis_mark_nodes(plate, empty, result)
    call check(result%n_marked() == 0, 'by a first element')
    call empty%update(-1, one(1), one(1), one(1), 1, status)
    call check_refused(status, RIIS_INVALID_MESH, 'n_nodes is -1')
    call result%destroy()
    call empty%destroy()
  end subroutine test_no_nodes
end program test_resistance
