! SPDX-License-Identifier: Apache-2.0
! A code in Fortran 2003, which has no int64 and no real128, uses module riis: riis_id is the kind of its ids.
program test_f2003
  use riis
  implicit none
  integer, parameter :: n = 11, n_nodes = n**3
  double precision :: xyz(3, n_nodes), resistance(n_nodes)
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_mark_result) :: result
  type(riis_mark_fields) :: fields
  integer(riis_id), pointer :: node_id(:), triangle_id(:)
  integer(riis_id), allocatable :: node_num(:)
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
  call result%marked_fields(fields)
  call result%add_resistance(1d0, resistance)
  if (size(node_num) < 10 .or. any(node_num /= node_id + 1_riis_id) .or. minval(triangle_id) < 0) stop 1
  if (size(fields%velocity, 2) /= size(node_num) .or. any(abs(fields%velocity) > 0d0)) stop 2
  if (count(resistance > 0) > size(node_num) .or. .not. any(resistance > 0)) stop 3
  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()
  deallocate (node_num) ! a main program keeps it, and the sanitizer takes it for a leak
end program test_f2003
