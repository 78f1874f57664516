! SPDX-License-Identifier: Apache-2.0
! Marks the nodes of a cube of 4 cm that are near a half open mitral valve: fpm run
program mark_box
  use riis
  implicit none
  integer, parameter :: n = 33
  integer :: i
  double precision :: xyz(3, n**3) ! in cm, x first
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: marks
  integer, allocatable :: node_num(:)
  double precision, allocatable :: distance(:)

  do i = 0, n**3 - 1
    xyz(:, i + 1) = -2 + 0.125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do
  call valve%create('mitral')
  call valve%set('opening', 0.5d0)
  call surface%create(valve)
  call mesh%create(xyz)
  call riis_mark_nodes(surface, mesh, marks)
  call marks%marked_nodes(node_num, distance)
  print '(i0, a, i0, 2(a, es24.17), a)', size(node_num), ' of ', n**3, ' nodes are marked, at', &
    minval(distance), ' to', maxval(distance), ' cm'
end program mark_box
