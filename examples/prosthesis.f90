! SPDX-License-Identifier: Apache-2.0
! A valve of one's own: a bioprosthesis of three cusps from control points, marked while it opens. Lengths are in cm.
!
! The ring, of radius 1.2, lies at z = 0; blood flows to +z; the tips of the posts, the commissures, are at z = 1.2. A
! cusp is one patch between two curves that run counter-clockwise from commissure to commissure: at v = 0 its
! attachment, down one post to the ring and up the next; at v = 1 its free edge. The sides u = 0 and u = 1 are
! collapsed to the commissures, so the cusp consists of straight lines from the attachment to the free edge. To open,
! only the free edges move. Closed, they pass the axis within 0.08, less than the half thickness: the marked valve is
! tight.
program prosthesis
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use riis_c
  implicit none
  integer(c_int64_t), parameter :: n = 27, n_nodes = n**3
  real(c_double), parameter :: closed_edges(36) = [ & ! control points of curves 1 to 3, the free edges, closed
     0.60d0, -1.04d0,  1.20d0, -0.10d0,  0.00d0,  0.90d0, -0.10d0,  0.00d0,  0.90d0,  0.60d0,  1.04d0,  1.20d0, &
     0.60d0,  1.04d0,  1.20d0,  0.05d0, -0.09d0,  0.90d0,  0.05d0, -0.09d0,  0.90d0, -1.20d0,  0.00d0,  1.20d0, &
    -1.20d0,  0.00d0,  1.20d0,  0.05d0,  0.09d0,  0.90d0,  0.05d0,  0.09d0,  0.90d0,  0.60d0, -1.04d0,  1.20d0]
  real(c_double), parameter :: open_edges(36) = [ & ! and open
     0.60d0, -1.04d0,  1.20d0,  1.13d0, -0.60d0,  1.20d0,  1.13d0,  0.60d0,  1.20d0,  0.60d0,  1.04d0,  1.20d0, &
     0.60d0,  1.04d0,  1.20d0, -0.05d0,  1.28d0,  1.20d0, -1.08d0,  0.68d0,  1.20d0, -1.20d0,  0.00d0,  1.20d0, &
    -1.20d0,  0.00d0,  1.20d0, -1.08d0, -0.68d0,  1.20d0, -0.05d0, -1.28d0,  1.20d0,  0.60d0, -1.04d0,  1.20d0]
  real(c_double), parameter :: attachments(36) = [ & ! of curves 4 to 6, the attachments
     0.60d0, -1.04d0,  1.20d0,  1.40d0, -0.58d0, -0.40d0,  1.40d0,  0.58d0, -0.40d0,  0.60d0,  1.04d0,  1.20d0, &
     0.60d0,  1.04d0,  1.20d0, -0.20d0,  1.50d0, -0.40d0, -1.20d0,  0.92d0, -0.40d0, -1.20d0,  0.00d0,  1.20d0, &
    -1.20d0,  0.00d0,  1.20d0, -1.20d0, -0.92d0, -0.40d0, -0.20d0, -1.50d0, -0.40d0,  0.60d0, -1.04d0,  1.20d0]
  real(c_double), parameter :: commissures(18) = [ & ! of curves 7 to 9, the commissures: lines from a point to itself
     0.60d0, -1.04d0,  1.20d0,  0.60d0, -1.04d0,  1.20d0, &
     0.60d0,  1.04d0,  1.20d0,  0.60d0,  1.04d0,  1.20d0, &
    -1.20d0,  0.00d0,  1.20d0, -1.20d0,  0.00d0,  1.20d0]
  real(c_double), target :: xyz(3, n_nodes) ! a cube of 3.25 cm around the prosthesis, a node every 1.25 mm
  type(c_ptr) :: valve, open, surface = c_null_ptr, mesh = c_null_ptr, result = c_null_ptr
  integer(c_int64_t) :: n_marked = 0, i
  integer :: step

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = [-1.625d0, -1.625d0, -1d0] + 0.125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do

  valve = valve_with(closed_edges)
  open = valve_with(open_edges)
  call check(riis_valve_set_open_state(valve, open))
  call riis_valve_destroy(open) ! it was copied
  call check(riis_surface_create(valve, surface=surface))
  call check(riis_mesh_create(n_nodes, c_loc(xyz(1, 1)), c_loc(xyz(2, 1)), c_loc(xyz(3, 1)), 3_c_int64_t, mesh))
  call check(riis_mark_result_create(result))

  print '(i0, a)', n_nodes, ' nodes'
  do step = 0, 2
    call check(riis_valve_set_scalar(valve, riis_c_string('opening'), 0.5d0 * step)) ! the valve moves
    call check(riis_surface_update(surface, valve))
    call check(riis_mark_nodes(surface, mesh, result=result))
    call check(riis_mark_result_marked(result, n_marked))
    print '(a, f3.1, a, i0)', 'opening ', 0.5d0 * step, ', marked: ', n_marked
  end do

  call riis_mark_result_destroy(result)
  call riis_mesh_destroy(mesh)
  call riis_surface_destroy(surface)
  call riis_valve_destroy(valve)

contains

  function valve_with(free_edges) result(made)
    real(c_double), intent(in) :: free_edges(:)
    type(c_ptr) :: made
    integer(c_int32_t), target :: degree(9), curve_id(4, 3), leaflet_id(3)
    real(c_double), target :: control(90)
    type(riis_patches) :: patches

    degree = [3, 3, 3, 3, 3, 3, 1, 1, 1]
    control = [free_edges, attachments, commissures]
    curve_id(:, 1) = [4, 1, 7, 8] ! at v = 0, v = 1, u = 0, u = 1
    curve_id(:, 2) = [5, 2, 8, 9]
    curve_id(:, 3) = [6, 3, 9, 7]
    leaflet_id = [0, 1, 2]
    call check(riis_patches_init(patches, c_sizeof(patches)))
    patches%n_curves = size(degree)
    patches%degree = c_loc(degree)
    patches%control = c_loc(control)
    patches%n_patches = size(leaflet_id)
    patches%curve_id = c_loc(curve_id)
    patches%leaflet_id = c_loc(leaflet_id)
    patches%index_base = 1
    made = c_null_ptr
    call check(riis_valve_create_from_patches(patches, made))
  end function valve_with

  subroutine check(status)
    integer(riis_status), intent(in) :: status
    if (status == RIIS_OK) return
    write (error_unit, '(3a)') riis_c_text(riis_status_name(status)), ': ', riis_c_text(riis_last_error())
    error stop
  end subroutine check
end program prosthesis
