! SPDX-License-Identifier: Apache-2.0
! Marks the nodes of a box that lie near the default aortic valve. Lengths are in cm, as in the valve's tables.
program first_marking
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use riis_c
  implicit none
  integer(c_int64_t), parameter :: n = 27, n_nodes = n**3
  real(c_double), target :: xyz(3, n_nodes) ! a cube of 3.25 cm around the origin, a node every 1.25 mm
  type(c_ptr) :: valve = c_null_ptr, surface = c_null_ptr, mesh = c_null_ptr, result = c_null_ptr
  type(c_ptr) :: ids = c_null_ptr, distances = c_null_ptr
  integer(c_int64_t), pointer :: node_id(:)
  real(c_double), pointer :: distance(:)
  integer(c_int64_t) :: n_marked = 0, i

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -1.625d0 + 0.125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do

  call check(riis_valve_create(riis_c_string('aortic'), valve))
  call check(riis_surface_create(valve, surface=surface)) ! half thickness 0.1 cm, tolerance 5 % of it
  call check(riis_mesh_create(n_nodes, c_loc(xyz(1, 1)), c_loc(xyz(2, 1)), c_loc(xyz(3, 1)), 3_c_int64_t, mesh))
  call check(riis_mark_result_create(result))
  call check(riis_mark_nodes(surface, mesh, result=result)) ! once a time step
  call check(riis_mark_result_marked(result, n_marked, ids, distances))

  print '(i0, a, i0, a)', n_nodes, ' nodes, marked: ', n_marked, ', the first of them:'
  if (n_marked > 0) then
    call c_f_pointer(ids, node_id, [n_marked]) ! node_id counts from 0: node_id(i) is xyz(:, node_id(i) + 1)
    call c_f_pointer(distances, distance, [n_marked])
    print '(a, i6, a, f9.6, a)', ('node', node_id(i), ' at', distance(i), ' cm', i = 1, min(n_marked, 5_c_int64_t))
    i = minloc(distance, dim=1)
    print '(a, i6, a, f9.6, a)', 'closest: node', node_id(i), ' at', distance(i), ' cm'
  end if

  call riis_mark_result_destroy(result)
  call riis_mesh_destroy(mesh)
  call riis_surface_destroy(surface)
  call riis_valve_destroy(valve)

contains

  subroutine check(status)
    integer(riis_status), intent(in) :: status
    if (status == RIIS_OK) return
    write (error_unit, '(3a)') riis_c_text(riis_status_name(status)), ': ', riis_c_text(riis_last_error())
    error stop
  end subroutine check
end program first_marking
