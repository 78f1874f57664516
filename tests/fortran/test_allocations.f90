! SPDX-License-Identifier: Apache-2.0
! In a step of a moving valve, module riis allocates nothing. The module's pointers point to arrays of the library.
program test_allocations
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use box
  use checks
  use riis
  implicit none
  interface
    subroutine allocations_begin() bind(c)
    end subroutine allocations_begin
    function allocations_end() result(n) bind(c)
      import :: c_int64_t
      integer(c_int64_t) :: n
    end function allocations_end
  end interface
  type(riis_valve) :: before
  type(riis_mesh) :: mesh
  type(riis_marks) :: result
  type(riis_opening_switch_state) :: state
  type(riis_opening_angle_state) :: angle
  real(c_double), pointer :: coefficient(:), momentum(:, :), weight(:), distance(:) ! pointers, as in many solvers
  real(c_double), allocatable :: near(:) ! for an argument with the attribute CONTIGUOUS
  integer(int8), allocatable :: mask(:)
  integer :: step

  call make_box()
  call valve%copy(before)
  call mesh%create(xyz)
  allocate (coefficient(n_nodes), momentum(3, n_nodes), weight(n_nodes), distance(n_nodes), near(n_nodes), mask(n_nodes))
  coefficient = 0
  momentum = 0
  weight = 1
  mask = 1
  do step = 1, 3
    call one_step()
  end do
  call test_counting()
  deallocate (coefficient, momentum, weight, distance)
  call result%destroy()
  call mesh%destroy()
  call before%destroy()
  call free_box()
  call finish()

contains

  subroutine one_step()
    type(riis_triangles) :: all_triangles
    type(riis_opening_switch), parameter :: by_switch = riis_opening_switch(0.1d0, 0.1d0)
    type(riis_opening_angle), parameter :: by_angle = riis_opening_angle(5500d0, 2d0, 50d0, 3.5d0)
    type(riis_mark_list) :: fields
    type(riis_band_sums) :: sums
    type(riis_mark_stats) :: stats
    real(c_double), pointer :: at(:, :), velocity(:, :), marked_distance(:)
    integer(int64), pointer :: node_id(:), vertex_id(:, :), triangle_id(:)
    integer(int32), pointer :: leaflet_id(:)
    real(c_double) :: force(3), opening
    force = 0
    call allocations_begin()
    call riis_opening_advance(by_switch, state, 0.01d0 * step, 1d0, 1d0)
    call riis_opening_advance(by_angle, angle, 0.01d0 * step, 1d0, 1d0)
    call riis_opening_from_table([0d0, 1d0], [0d0, 1d0], 0.5d0, opening, period=2d0, interpolation=RIIS_INTERPOLATION_CUBIC)
    call riis_opening_from_times(riis_opening_times(0d0, 1d0, 2d0, 1d0), 0.5d0, opening)
    call before%set('leaflet_angle', 20d0 + step)
    call valve%set('leaflet_angle', 21d0 + step)
    call surface%update_moving(valve, before, 0.01d0)
    call surface%get_triangles(all_triangles)
    at => all_triangles%xyz
    call surface%get_triangles(all_triangles)
    velocity => all_triangles%velocity
    call surface%get_triangles(all_triangles)
    vertex_id => all_triangles%vertex_id
    triangle_id => all_triangles%triangle_id
    leaflet_id => all_triangles%leaflet_id
    call riis_mark_nodes(surface, mesh, result, distance_limit=0.2d0, node_mask=mask, n_threads=1, &
      fields=RIIS_FIELD_VELOCITY + RIIS_FIELD_SIDE + RIIS_FIELD_RIM)
    call result%marked(node_id, marked_distance)
    call result%get_list(RIIS_LIST_MARKED, fields)
    call result%add_resistance(1d0, coefficient)
    call result%add_resistance(1d0, K_u_surface=momentum)
    call result%add_resistance(1d0, coefficient, momentum)
    call result%add_reaction(1d0, momentum, weight, force)
    call result%band_sums(0.1d0, 0.2d0, weight, weight, sums)
    call result%dense(mask, distance)
    mask = 1
    call result%get_stats(stats)
    call surface%closest_points(xyz, distance=near, point_id=node_id, n_threads=1)
    call check(allocations_end() == 0, 'a step allocates nothing in Fortran')
    call check(size(node_id) > 100 .and. size(velocity, 2) == size(at, 2) .and. lbound(node_id, 1) == 1 .and. &
      lbound(fields%velocity, 2) == 1 .and. size(fields%velocity, 2) == size(node_id), 'pointers count from 1')
  end subroutine one_step

  ! Calls that do copy must be counted, which shows that the count can fail.
  subroutine test_counting()
    integer, allocatable :: node_num(:)
    call allocations_begin()
    call result%marked_nodes(node_num)
    call check(allocations_end() == 1, 'an array that is allocated is counted')
  end subroutine test_counting
end program test_allocations
