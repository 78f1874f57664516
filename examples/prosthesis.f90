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
  use riis
  implicit none
  integer, parameter :: n = 27, n_nodes = n**3
  double precision, parameter :: closed_edges(36) = [ & ! control points of curves 1 to 3, the free edges, closed
     0.60d0, -1.04d0,  1.20d0, -0.10d0,  0.00d0,  0.90d0, -0.10d0,  0.00d0,  0.90d0,  0.60d0,  1.04d0,  1.20d0, &
     0.60d0,  1.04d0,  1.20d0,  0.05d0, -0.09d0,  0.90d0,  0.05d0, -0.09d0,  0.90d0, -1.20d0,  0.00d0,  1.20d0, &
    -1.20d0,  0.00d0,  1.20d0,  0.05d0,  0.09d0,  0.90d0,  0.05d0,  0.09d0,  0.90d0,  0.60d0, -1.04d0,  1.20d0]
  double precision, parameter :: open_edges(36) = [ & ! and open
     0.60d0, -1.04d0,  1.20d0,  1.13d0, -0.60d0,  1.20d0,  1.13d0,  0.60d0,  1.20d0,  0.60d0,  1.04d0,  1.20d0, &
     0.60d0,  1.04d0,  1.20d0, -0.05d0,  1.28d0,  1.20d0, -1.08d0,  0.68d0,  1.20d0, -1.20d0,  0.00d0,  1.20d0, &
    -1.20d0,  0.00d0,  1.20d0, -1.08d0, -0.68d0,  1.20d0, -0.05d0, -1.28d0,  1.20d0,  0.60d0, -1.04d0,  1.20d0]
  double precision, parameter :: attachments(36) = [ & ! of curves 4 to 6, the attachments
     0.60d0, -1.04d0,  1.20d0,  1.40d0, -0.58d0, -0.40d0,  1.40d0,  0.58d0, -0.40d0,  0.60d0,  1.04d0,  1.20d0, &
     0.60d0,  1.04d0,  1.20d0, -0.20d0,  1.50d0, -0.40d0, -1.20d0,  0.92d0, -0.40d0, -1.20d0,  0.00d0,  1.20d0, &
    -1.20d0,  0.00d0,  1.20d0, -1.20d0, -0.92d0, -0.40d0, -0.20d0, -1.50d0, -0.40d0,  0.60d0, -1.04d0,  1.20d0]
  double precision, parameter :: commissures(18) = [ & ! of curves 7 to 9, the commissures: lines from a point to itself
     0.60d0, -1.04d0,  1.20d0,  0.60d0, -1.04d0,  1.20d0, &
     0.60d0,  1.04d0,  1.20d0,  0.60d0,  1.04d0,  1.20d0, &
    -1.20d0,  0.00d0,  1.20d0, -1.20d0,  0.00d0,  1.20d0]
  double precision :: xyz(3, n_nodes) ! a cube of 3.25 cm around the prosthesis, a node every 1.25 mm
  type(riis_valve) :: valve, open
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_mark_result) :: result
  integer :: i, step

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = [-1.625d0, -1.625d0, -1d0] + 0.125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do

  call make_valve(valve, closed_edges)
  call make_valve(open, open_edges)
  call valve%set_open_state(open)
  call open%destroy() ! it was copied
  call surface%create(valve)
  call mesh%create(xyz)

  print '(i0, a)', n_nodes, ' nodes'
  do step = 0, 2
    call valve%set('opening', 0.5d0 * step) ! the valve moves
    call surface%update(valve)
    call riis_mark_nodes(surface, mesh, result)
    print '(a, f3.1, a, i0)', 'opening ', 0.5d0 * step, ', marked: ', result%n_marked()
  end do

  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()

contains

  subroutine make_valve(valve, free_edges)
    type(riis_valve), intent(inout) :: valve
    double precision, intent(in) :: free_edges(:)
    integer, parameter :: degree(9) = [3, 3, 3, 3, 3, 3, 1, 1, 1]
    integer, parameter :: curve_id(4, 3) = reshape([ & ! at v = 0, v = 1, u = 0, u = 1 of each cusp
      4, 1, 7, 8, &
      5, 2, 8, 9, &
      6, 3, 9, 7], [4, 3])
    call valve%create_from_patches(degree, reshape([free_edges, attachments, commissures], [3, 30]), curve_id, &
      leaflet_id=[0, 1, 2])
  end subroutine make_valve
end program prosthesis
