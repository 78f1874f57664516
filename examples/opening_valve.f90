! SPDX-License-Identifier: Apache-2.0
! A mitral valve opens step by step by a law of opening. The program computes the resistance of every node to the flow relative to
! the moving leaflets. The mesh is in metres and the valve in centimetres, so the scale is 0.01.
program opening_valve
  use riis
  implicit none
  integer, parameter :: n = 37, n_nodes = n**3, n_steps = 5
  double precision, parameter :: R = 1d4    ! [kg/(m s)] the resistance of the model, from literature or by calibration
  double precision, parameter :: eps = 1d-3 ! [m] the half thickness
  double precision, parameter :: dt = 1d-2  ! [s] the time step
  double precision :: xyz(3, n_nodes)       ! [m] a cube of 4.5 cm around the valve, a node every 1.25 mm
  double precision :: coefficient(n_nodes)  ! [kg/(m^3 s)] K in the term K (u - u_surface) of the momentum equation
  double precision :: momentum(3, n_nodes)  ! [N/m^3] K u_surface, which goes to the right-hand side
  type(riis_valve) :: valve, valve_before
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: result
  type(riis_opening_times) :: times
  integer, allocatable :: node_num(:)
  double precision :: opening, time
  integer :: i, step

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = [-0.0225d0, -0.0225d0, -0.02d0] + 0.00125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do
  coefficient = 0
  momentum = 0

  ! All objects of riis are made once, and every step reuses their memory.
  call valve%create('mitral')
  call valve%set('opening', 0d0)
  call valve%copy(valve_before) ! valve_before has the opening of the previous step
  call surface%create(valve, half_thickness=eps, scale=0.01d0) ! scale: centimetres to metres; eps is in metres
  call mesh%create(xyz)

  ! The valve opens at 0.45 s in 50 ms, and closes at 0.95 s, every second.
  times = riis_opening_times(opening_start=0.45d0, opening_duration=0.05d0, closing_start=0.95d0, closing_duration=0.05d0, &
    period=1d0)
  allocate (node_num(0))
  do step = 0, n_steps
    coefficient(node_num) = 0 ! resets only the nodes that the last step set
    momentum(:, node_num) = 0

    time = times%opening_start + step * dt
    call riis_opening_from_times(times, time, opening) ! with other laws the flow opens the valve: riis_opening_advance
    call valve%set('opening', opening)
    call surface%update_moving(valve, valve_before, dt) ! the surface keeps its options
    call valve_before%set('opening', opening)
    call riis_mark_nodes(surface, mesh, result, fields=RIIS_FIELD_VELOCITY) ! the marks keep the surface's velocity at the nodes
    call result%add_resistance(R, coefficient, momentum)
    call result%marked_nodes(node_num)

    print '(f4.2, a, f5.3, a, i5, a, es11.5, a, es11.5, a, sp, es12.5, a)', time, ' s, opening ', opening, ', marked: ', &
      size(node_num), ', K: sum ', sum(coefficient), ', maximum ', maxval(coefficient), &
      ' kg/(m^3 s), z of K u_surface: sum ', sum(momentum(3, :)), ' N/m^3'
  end do

  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve_before%destroy()
  call valve%destroy()
end program opening_valve
