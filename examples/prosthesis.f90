! SPDX-License-Identifier: Apache-2.0
! Makes a user-defined valve, a bioprosthesis of three cusps, from control points, and marks it while it opens.
! Lengths are in cm.
!
! The ring of radius 1.2 lies at z = 0, and blood flows to +z. The tips of the posts, the commissures, are at z = 1.2. A leaflet
! consists of two patches. The two halves meet at the leaflet's middle line, which runs from the ring to the free edge. Each patch
! lies between two curves from a commissure to the middle line. The attachment at v = 0 runs down the post to the ring. The curve
! at v = 1 is half of the free edge. The patch's side at the commissure is a point, so the patch consists of straight lines from
! the attachment to the free edge. When the valve opens, only the free edges and the middle lines move.
!
! When the valve is closed, each half of a free edge runs from its commissure to the axis. The curve has the same control points
! as the adjacent half of the neighbouring leaflet, so the leaflets meet without a hole. All control points of a leaflet lie in
! its third of the ring, at every opening. A third is convex, so the whole leaflet stays in it, and leaflets never cross.
program prosthesis
  use riis
  implicit none
  integer, parameter :: n = 27, n_nodes = n**3
  ! Control points of the closed valve: curves 1 to 6 are the free edges, and 7 to 9 the middle lines.
  double precision, parameter :: closed_moving(90) = [ &
      0.60d0, -1.04d0,  1.20d0,  0.45d0, -0.78d0,  1.00d0,  0.30d0, -0.52d0,  0.80d0,  0.00d0,  0.00d0,  0.80d0, &
      0.60d0,  1.04d0,  1.20d0,  0.45d0,  0.78d0,  1.00d0,  0.30d0,  0.52d0,  0.80d0,  0.00d0,  0.00d0,  0.80d0, &
      0.60d0,  1.04d0,  1.20d0,  0.45d0,  0.78d0,  1.00d0,  0.30d0,  0.52d0,  0.80d0,  0.00d0,  0.00d0,  0.80d0, &
     -1.20d0,  0.00d0,  1.20d0, -0.90d0,  0.00d0,  1.00d0, -0.60d0,  0.00d0,  0.80d0,  0.00d0,  0.00d0,  0.80d0, &
     -1.20d0,  0.00d0,  1.20d0, -0.90d0,  0.00d0,  1.00d0, -0.60d0,  0.00d0,  0.80d0,  0.00d0,  0.00d0,  0.80d0, &
      0.60d0, -1.04d0,  1.20d0,  0.45d0, -0.78d0,  1.00d0,  0.30d0, -0.52d0,  0.80d0,  0.00d0,  0.00d0,  0.80d0, &
      1.20d0,  0.00d0,  0.00d0,  0.00d0,  0.00d0,  0.80d0, &
     -0.60d0,  1.04d0,  0.00d0,  0.00d0,  0.00d0,  0.80d0, &
     -0.60d0, -1.04d0,  0.00d0,  0.00d0,  0.00d0,  0.80d0]
  ! Control points of the same nine curves for the open valve.
  double precision, parameter :: open_moving(90) = [ &
      0.60d0, -1.04d0,  1.20d0,  0.87d0, -0.80d0,  1.20d0,  1.05d0, -0.37d0,  1.20d0,  1.05d0,  0.00d0,  1.20d0, &
      0.60d0,  1.04d0,  1.20d0,  0.87d0,  0.80d0,  1.20d0,  1.05d0,  0.37d0,  1.20d0,  1.05d0,  0.00d0,  1.20d0, &
      0.60d0,  1.04d0,  1.20d0,  0.26d0,  1.15d0,  1.20d0, -0.20d0,  1.09d0,  1.20d0, -0.52d0,  0.91d0,  1.20d0, &
     -1.20d0,  0.00d0,  1.20d0, -1.13d0,  0.35d0,  1.20d0, -0.85d0,  0.72d0,  1.20d0, -0.52d0,  0.91d0,  1.20d0, &
     -1.20d0,  0.00d0,  1.20d0, -1.13d0, -0.35d0,  1.20d0, -0.85d0, -0.72d0,  1.20d0, -0.52d0, -0.91d0,  1.20d0, &
      0.60d0, -1.04d0,  1.20d0,  0.26d0, -1.15d0,  1.20d0, -0.20d0, -1.09d0,  1.20d0, -0.52d0, -0.91d0,  1.20d0, &
      1.20d0,  0.00d0,  0.00d0,  1.05d0,  0.00d0,  1.20d0, &
     -0.60d0,  1.04d0,  0.00d0, -0.52d0,  0.91d0,  1.20d0, &
     -0.60d0, -1.04d0,  0.00d0, -0.52d0, -0.91d0,  1.20d0]
  ! These control points do not move. Curves 10 to 15 are the attachments. Curves 16 to 18 are the commissures: each is a line
  ! from a point to itself.
  double precision, parameter :: fixed(90) = [ &
      0.60d0, -1.04d0,  1.20d0,  1.00d0, -0.81d0,  0.40d0,  1.20d0, -0.40d0,  0.00d0,  1.20d0,  0.00d0,  0.00d0, &
      0.60d0,  1.04d0,  1.20d0,  1.00d0,  0.81d0,  0.40d0,  1.20d0,  0.40d0,  0.00d0,  1.20d0,  0.00d0,  0.00d0, &
      0.60d0,  1.04d0,  1.20d0,  0.20d0,  1.27d0,  0.40d0, -0.25d0,  1.24d0,  0.00d0, -0.60d0,  1.04d0,  0.00d0, &
     -1.20d0,  0.00d0,  1.20d0, -1.20d0,  0.46d0,  0.40d0, -0.95d0,  0.84d0,  0.00d0, -0.60d0,  1.04d0,  0.00d0, &
     -1.20d0,  0.00d0,  1.20d0, -1.20d0, -0.46d0,  0.40d0, -0.95d0, -0.84d0,  0.00d0, -0.60d0, -1.04d0,  0.00d0, &
      0.60d0, -1.04d0,  1.20d0,  0.20d0, -1.27d0,  0.40d0, -0.25d0, -1.24d0,  0.00d0, -0.60d0, -1.04d0,  0.00d0, &
      0.60d0, -1.04d0,  1.20d0,  0.60d0, -1.04d0,  1.20d0, &
      0.60d0,  1.04d0,  1.20d0,  0.60d0,  1.04d0,  1.20d0, &
     -1.20d0,  0.00d0,  1.20d0, -1.20d0,  0.00d0,  1.20d0]
  double precision :: xyz(3, n_nodes) ! a cube of 3.25 cm around the prosthesis, a node every 1.25 mm
  type(riis_valve) :: valve, open
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: result
  integer :: i, step

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = [-1.625d0, -1.625d0, -1d0] + 0.125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do

  call make_valve(valve, closed_moving)
  call make_valve(open, open_moving)
  call valve%set_open_state(open)
  call open%destroy() ! the valve has copied it
  call surface%create(valve)
  call mesh%create(xyz)

  print '(i0, a)', n_nodes, ' nodes'
  do step = 0, 2
    call valve%set('opening', 0.5d0 * step) ! moves the valve
    call surface%update(valve)
    call riis_mark_nodes(surface, mesh, result)
    print '(a, f3.1, a, i0)', 'opening ', 0.5d0 * step, ', marked: ', result%n_marked()
  end do

  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()

contains

  subroutine make_valve(valve, moving)
    type(riis_valve), intent(inout) :: valve
    double precision, intent(in) :: moving(:)
    integer, parameter :: degree(18) = [3, 3, 3, 3, 3, 3, 1, 1, 1, 3, 3, 3, 3, 3, 3, 1, 1, 1]
    integer, parameter :: curve_id(4, 6) = reshape([ & ! the curves at v = 0, v = 1, u = 0, u = 1 of each half leaflet
      10, 1, 16, 7,  11, 2, 7, 17, &
      12, 3, 17, 8,  13, 4, 8, 18, &
      14, 5, 18, 9,  15, 6, 9, 16], [4, 6])
    logical, parameter :: f = .false., t = .true.
    logical, parameter :: reversed(4, 6) = reshape([ & ! whether a side runs opposite to its curve
      f, f, f, f,  t, t, f, f, &
      f, f, f, f,  t, t, f, f, &
      f, f, f, f,  t, t, f, f], [4, 6])
    call valve%create_from_patches(degree, reshape([moving, fixed], [3, 60]), curve_id, reversed=reversed, &
      leaflet_id=[0, 0, 1, 1, 2, 2])
  end subroutine make_valve
end program prosthesis
