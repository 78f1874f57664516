! SPDX-License-Identifier: Apache-2.0
! The pressure of the solver opens a valve. riis sums the pressure over the nodes on either side of the closed valve, and a law of
! opening takes the difference of the means. Instead of a solver, this program has a pressure that falls downstream.
program pressure_opens
  use riis
  implicit none
  integer, parameter :: n = 33, n_nodes = n**3, n_steps = 6
  double precision, parameter :: eps = 1.5d-3 ! [m] the half thickness
  double precision, parameter :: dt = 0.01d0  ! [s]
  double precision :: xyz(3, n_nodes)         ! [m] a cube of 4 cm around the valve, a node every 1.25 mm
  double precision :: pressure(n_nodes)       ! [Pa]
  double precision :: volume(n_nodes)         ! [m^3] around each node; 0 for nodes of other ranks
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: marks
  type(riis_band_sums) :: sums
  type(riis_opening_switch) :: law
  type(riis_opening_switch_state) :: state
  double precision :: mean(2)
  integer :: i, step

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = [-0.02d0, -0.02d0, -0.01d0] + 0.00125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do
  volume = 0.00125d0**3
  call valve%create('trileaflet') ! closed: its opening is 0
  call surface%create(valve, half_thickness=eps, scale=0.01d0)
  call mesh%create(xyz)

  ! The band from one to two half thicknesses. The band of the pressure does not overlap the resistance, so its pressure is that
  ! of the blood.
  call riis_mark_nodes(surface, mesh, marks, distance_limit=2 * eps, fields=RIIS_FIELD_SIDE + RIIS_FIELD_RIM)
  law = riis_opening_switch(opening_duration=0.04d0, closing_duration=0.04d0, open_above=100d0)
  do step = 1, n_steps
    pressure = -8000 * step * xyz(3, :)
    call marks%band_sums(eps, 2 * eps, pressure, volume, sums) ! with MPI, add up the sums and weights of all ranks first
    mean = sums%sum / sums%weight ! entry 1 is upstream, 2 downstream
    call riis_opening_advance(law, state, step * dt, mean(1) - mean(2), 0d0)
    print '(f4.2, a, i0, a, i0, a, f7.3, a, f6.4)', state%time, ' s: ', sums%n_nodes(1), ' nodes upstream, ', sums%n_nodes(2), &
      ' downstream, ', mean(1) - mean(2), ' Pa, opening ', state%opening
    ! A solver now sets the valve's opening, updates the surface and marks the mesh, as in opening_valve.f90. While the valve is
    ! open, the two sides are not defined, and the law closes the valve by the flow.
  end do

  call marks%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()
end program pressure_opens
