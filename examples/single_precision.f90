! SPDX-License-Identifier: Apache-2.0
! A solver in single precision. The solver's mesh moves, and the leaflets are the solver's own triangles. riis copies the
! coordinates and converts them to double precision, so that the solver may change its arrays between calls.
program single_precision
  use riis
  use, intrinsic :: iso_fortran_env, only: int64, real32
  implicit none
  integer, parameter :: n = 21, n_nodes = n**3, n_steps = 3
  real(real32) :: xyz(3, n_nodes)            ! [m] the nodes, every millimetre of a cube of 2 cm
  double precision :: coefficient(n_nodes)   ! [kg/(m^3 s)] K
  double precision :: distance(n_nodes)      ! [m]
  integer(int64) :: wanted(3)
  real(real32) :: leaflet(3, 4) = reshape([-0.009, -0.009, 0., 0.009, -0.009, 0., 0.009, 0.009, 0., -0.009, 0.009, 0.], [3, 4])
  integer :: triangles(3, 2) = reshape([1, 2, 3, 1, 3, 4], [3, 2])
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: marks
  type(riis_mark_stats) :: stats
  integer :: i, step

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -0.01 + 0.001 * real([mod(i, n), mod(i / n, n), i / n**2], real32)
  end do
  call surface%create_from_arrays(dble(leaflet), triangles, half_thickness=1d-3)
  call mesh%create_copy(xyz)
  do step = 0, n_steps - 1
    leaflet(3, :) = 0.002 * real(step, real32)            ! the leaflet rises
    if (step > 0) xyz(3, :) = xyz(3, :) + 0.0005          ! and so does the mesh
    call surface%update_from_arrays(dble(leaflet), triangles)
    call mesh%update_copy(xyz)
    call riis_mark_nodes(surface, mesh, marks)
    coefficient = 0
    call marks%add_resistance(1d4, coefficient)
    call marks%get_stats(stats)
    print '(a, i0, a, i0, a, es10.4, a)', 'step ', step, ': ', stats%n_marked, ' nodes marked, sum of K ', sum(coefficient), &
      ' kg/(m^3 s)'
  end do

  ! The distances of some nodes only. The entries of the other nodes are not written.
  wanted = [0, (n_nodes - 1) / 2, n_nodes - 1]
  call surface%closest_points(dble(xyz), distance=distance, point_id=wanted)
  print '(a, f0.3, a, f0.3, a, f0.3, a)', 'distances ', 1d3 * distance(wanted(1) + 1), ', ', 1d3 * distance(wanted(2) + 1), &
    ' and ', 1d3 * distance(wanted(3) + 1), ' mm'

  call marks%destroy()
  call mesh%destroy()
  call surface%destroy()
end program single_precision
