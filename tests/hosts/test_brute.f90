! SPDX-License-Identifier: Apache-2.0
! Compares the marks of an open valve with distances of the loop over all triangles, by both calls of the loop.
program test_brute
  use, intrinsic :: iso_c_binding, only: c_double, c_intptr_t
  use, intrinsic :: iso_fortran_env, only: int64
  use brute
  use riis
  implicit none
  external :: fixed_form
  integer, parameter :: n = 13, n_nodes = n**3
  real(c_double), parameter :: eps = 0.15d0
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: marks
  real(c_double) :: xyz(3, n_nodes), loop(n_nodes), again(n_nodes), dense(n_nodes)
  integer(int64), pointer :: node_id(:)
  real(c_double), pointer :: distance(:)
  integer :: i
  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -1.5d0 + 0.25d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do
  call valve%create('trileaflet')
  call valve%set('opening', 0.5d0)
  call surface%create(valve, half_thickness=eps)
  call mesh%create(xyz)
  call riis_mark_nodes(surface, mesh, marks)
  call marks%marked(node_id, distance)
  call brute_distances(surface%c_handle(), int(n_nodes, int64), xyz(1, 1), xyz(2, 1), xyz(3, 1), 3_int64, eps, loop)
  call fixed_form(int(transfer(surface%c_handle(), 0_c_intptr_t), int64), n_nodes, xyz, eps, again)
  if (maxval(abs(loop - again)) > 0) error stop 'the calls of both languages differ'
  if (size(node_id) < 50 .or. size(node_id) /= count(loop <= eps)) error stop 'riis marks other nodes'
  if (maxval(abs(distance - loop(node_id + 1))) > 1d-12) error stop 'riis gives other distances'
  dense = 9
  dense(node_id + 1) = distance
  if (any(dense > 1 .neqv. loop > eps)) error stop 'riis leaves other nodes out'
  print *, size(node_id), 'marks equal the loop over all triangles'
  call marks%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()
end program test_brute
