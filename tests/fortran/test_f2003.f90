! SPDX-License-Identifier: Apache-2.0
! Uses module riis from Fortran 2003, which has no int64 and no real128. The kind of node ids is riis_id.
program test_f2003
  use riis
  implicit none
  type(riis_triangles) :: all_triangles
  integer, parameter :: n = 11, n_nodes = n**3
  double precision :: xyz(3, n_nodes), resistance(n_nodes), distance(n_nodes), opening
  double precision :: frames(3, 4, 2)
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_keyframes) :: keyframes
  type(riis_mesh) :: mesh
  type(riis_marks) :: result
  type(riis_mark_list) :: fields
  integer(riis_id), pointer :: node_id(:), triangle_id(:)
  integer(riis_id), allocatable :: node_num(:)
  double precision, pointer :: velocity(:, :)
  type(riis_opening_switch_state) :: state
  integer :: i
  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -1.5d0 + 0.3d0 * (/mod(i, n), mod(i / n, n), i / n**2/)
  end do
  resistance = 0
  call valve%create('aortic')
  call surface%create(valve, half_thickness=0.2d0)
  call surface%update_moving(valve, valve, 1d-3)
  call mesh%create(xyz)
  call riis_mark_nodes(surface, mesh, result, fields=RIIS_FIELD_VELOCITY + RIIS_FIELD_SIDE)
  call result%marked(node_id, triangle_id=triangle_id)
  call result%marked_nodes(node_num)
  call result%get_list(RIIS_LIST_MARKED, fields)
  call result%add_resistance(1d0, resistance)
  if (size(node_num) < 10 .or. any(node_num /= node_id + 1_riis_id) .or. minval(triangle_id) < 0) stop 1
  if (size(fields%velocity, 2) /= size(node_num) .or. any(abs(fields%velocity) > 0d0)) stop 2
  if (count(resistance > 0) > size(node_num) .or. .not. any(resistance > 0)) stop 3

  ! Reads the marked nodes through the result's pointers.
  distance = -1
  call surface%closest_points(xyz, distance=distance, point_id=node_id)
  if (count(distance >= 0) /= size(node_id)) stop 4

  ! Tests laws of opening, and a surface that moves by keyframes.
  call riis_opening_from_times(riis_opening_times(0.45d0, 0.05d0, 0.9d0, 0.1d0, period=1d0), 3.7d0, opening)
  if (opening < 1d0) stop 5
  call riis_opening_advance(riis_opening_switch(0.04d0, 0.08d0), state, 0.1d0, 1d0, 1d0)
  if (state%phase /= RIIS_PHASE_OPENING) stop 6
  frames(:2, :, 1) = reshape((/0d0, 0d0, 1d0, 0d0, 1d0, 1d0, 0d0, 1d0/), (/2, 4/))
  frames(3, :, 1) = 0
  frames(:, :, 2) = frames(:, :, 1)
  frames(3, :, 2) = 1
  call keyframes%create((/0d0, 0.5d0/), frames, reshape((/1, 2, 3, 4/), (/4, 1/)))
  call surface%update_from_keyframes(keyframes, 0.25d0)
  call surface%get_triangles(all_triangles)
  velocity => all_triangles%velocity
  if (size(velocity, 2) /= 4 .or. any(abs(velocity(3, :) - 2d0) > 1d-12)) stop 7
  call keyframes%destroy()
  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()
  deallocate (node_num) ! variables of a main program keep their memory, which the leak sanitizer would report
end program test_f2003
