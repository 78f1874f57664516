! SPDX-License-Identifier: Apache-2.0
! Marks the nodes of a cube that are near a half open mitral valve: fpm run
program mark_box
  use riis
  implicit none
  integer :: i, j, k
  integer, parameter :: x(33) = [(i, i=-16, 16)]
  double precision :: xyz(3, 33**3) = 0.125d0 * reshape([(((x(i), x(j), x(k), i=1, 33), j=1, 33), k=1, 33)], [3, 33**3]) ! in cm
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: marks
  integer, allocatable :: node_num(:)
  double precision, allocatable :: distance(:)
  call valve%create('mitral')
  call valve%set('opening', 0.5d0)
  call surface%create(valve)
  call mesh%create(xyz)
  call riis_mark_nodes(surface, mesh, marks)
  call marks%marked_nodes(node_num, distance)
  print '(i0, a, i0, 2(a, es24.17), a)', size(node_num), ' of ', size(xyz, 2), ' nodes are marked, at', &
    minval(distance), ' to', maxval(distance), ' cm'
end program mark_box
