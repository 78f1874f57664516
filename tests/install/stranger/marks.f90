! SPDX-License-Identifier: Apache-2.0
! Prints in Fortran what marks.c prints.
program marks
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use riis
  implicit none
  integer, parameter :: n = 41, n_nodes = n**3
  real(real64), allocatable :: xyz(:, :), distance(:)
  integer, allocatable :: node_num(:)
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: result
  integer :: i

  allocate (xyz(3, n_nodes))
  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -2.5_real64 + 0.125_real64 * [mod(i, n), mod(i / n, n), i / n**2]
  end do
  call valve%create('mitral')
  call valve%set('opening', 0.5_real64)
  call surface%create(valve)
  call mesh%create(xyz)
  call riis_mark_nodes(surface, mesh, result)
  call result%marked_nodes(node_num, distance)
  do i = 1, size(node_num)
    print '(i0, 1x, z16.16)', node_num(i) - 1, transfer(distance(i), 0_int64)
  end do
  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()
end program marks
