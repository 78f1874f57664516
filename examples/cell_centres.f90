! SPDX-License-Identifier: Apache-2.0
! Computes resistances for a finite volume code: K of every cell, at the cell's centre. The cell centres are the nodes of riis's
! mesh, which needs no adjacency. The program checks that the integral of K over the cells is the area of the valve times R/eps.
! Lengths are in metres.
program cell_centres
  use riis
  implicit none
  integer, parameter :: n = 64, n_cells = n**3
  double precision, parameter :: width = 0.00075d0 ! [m] of a cell
  double precision, parameter :: R = 1d4           ! [kg/(m s)] the resistance of the model
  double precision, parameter :: eps = 1d-3        ! [m] the half thickness
  double precision :: centre(3, n_cells)    ! [m] centres of the cells, each 0.75 mm wide, in a cube of 4.8 cm around the valve
  double precision :: coefficient(n_cells)  ! [kg/(m^3 s)] K of each cell; a scheme adds K V u to the cell's momentum balance
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: result
  type(riis_surface_info) :: info
  double precision :: integral, expected
  integer :: i

  do i = 0, n_cells - 1
    centre(:, i + 1) = -0.024d0 + width * ([mod(i, n), mod(i / n, n), i / n**2] + 0.5d0)
  end do
  coefficient = 0

  call valve%create('mitral')
  call valve%set('opening', 0d0) ! closed
  call surface%create(valve, half_thickness=eps, scale=0.01d0) ! the valve is given in centimetres
  call mesh%create(centre)

  ! With a round rim, the band would have half a tube around the free edges and the annulus. With a cut rim, the band ends at the
  ! free edges and the annulus.
  call riis_mark_nodes(surface, mesh, result, fields=RIIS_FIELD_RIM)
  call result%add_resistance(R, coefficient, rim=RIIS_RIM_CUT)

  integral = sum(coefficient) * width**3 ! integral of K over the cells
  call surface%get_info(info)
  expected = R / eps * info%area
  print '(i0, a, i0, a)', n_cells, ' cells, ', count(coefficient > 0), ' resist'
  print '(a, es10.4, a, es10.4, a)', 'integral of K ', integral, ' kg/s, area * R/eps ', expected, ' kg/s'

  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()
  if (abs(integral / expected - 1) > 0.01d0) error stop 'the integral of K is off by more than 1 %'
end program cell_centres
