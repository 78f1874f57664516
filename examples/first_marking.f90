! SPDX-License-Identifier: Apache-2.0
! Marks the nodes of a box that are near the default coapting valve. Lengths are in cm, like the valve's default parameters.
program first_marking
  use riis
  implicit none
  integer, parameter :: n = 27, n_nodes = n**3
  double precision :: xyz(3, n_nodes) ! a cube of 3.25 cm around the origin, a node every 1.25 mm
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: result
  integer, allocatable :: node_num(:)
  double precision, allocatable :: distance(:)
  character(len=*), parameter :: place = '("(", f6.3, ", ", f6.3, ", ", f6.3, ") at ", f8.6, " cm")'
  integer :: i

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -1.625d0 + 0.125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do

  ! Without a status argument an error stops the program with a message.
  call valve%create('coapting')
  call surface%create(valve) ! half thickness 0.1 cm, tolerance 5 % of the half thickness
  call mesh%create(xyz)
  call riis_mark_nodes(surface, mesh, result) ! repeated in every time step
  call result%marked_nodes(node_num, distance) ! node_num counts from 1: xyz(:, node_num(i)) is marked

  print '(i0, a, i0, a)', n_nodes, ' nodes, marked: ', size(node_num), ', the first of them:'
  do i = 1, min(size(node_num), 5)
    print place, xyz(:, node_num(i)), distance(i)
  end do
  print '(a)', 'and the closest:'
  if (size(node_num) > 0) then
    i = minloc(distance, dim=1)
    print place, xyz(:, node_num(i)), distance(i)
  end if

  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()
end program first_marking
