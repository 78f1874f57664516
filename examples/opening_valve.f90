! SPDX-License-Identifier: Apache-2.0
! A mitral valve that opens step by step, and the resistance of every node to the flow through it. The mesh is in metres,
! the valve's tables are in centimetres, so the scale is 0.01.
program opening_valve
  use riis
  implicit none
  integer, parameter :: n = 37, n_nodes = n**3, n_steps = 5
  double precision, parameter :: R = 1d4    ! [kg/(m s)] of the model, from its literature or by calibration
  double precision, parameter :: eps = 1d-3 ! [m] the half thickness
  double precision :: xyz(3, n_nodes)       ! [m] a cube of 4.5 cm around the valve, a node every 1.25 mm
  double precision :: resistance(n_nodes)   ! [kg/(m^3 s)]; times the flow's velocity relative to the valve: N/m^3 against it
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_mark_result) :: result
  integer, allocatable :: node_num(:)
  double precision, allocatable :: distance(:)
  double precision :: opening
  integer :: i, step

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = [-0.0225d0, -0.0225d0, -0.02d0] + 0.00125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do
  resistance = 0

  ! These are made once, and every step reuses their memory.
  call valve%create('mitral')
  call surface%create(valve, half_thickness=eps, scale=0.01d0) ! centimetres to metres; eps is in the mesh's unit
  call mesh%create(xyz)

  allocate (node_num(0))
  do step = 0, n_steps
    resistance(node_num) = 0 ! resets only the nodes that the last step set

    opening = dble(step) / n_steps ! a solver has a function of time
    call valve%set('opening', opening)
    call surface%update(valve) ! the surface keeps its options
    call riis_mark_nodes(surface, mesh, result)
    call result%marked_nodes(node_num, distance)
    resistance(node_num) = R / eps * delta(distance)

    print '(a, f3.1, a, i5, a, es11.5, a, es11.5, a)', 'opening ', opening, ', marked: ', size(node_num), &
      ', resistance: sum ', sum(resistance), ', maximum ', maxval(resistance), ' kg/(m^3 s)'
  end do

  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()

contains

  ! [1/m] The delta function smeared over the band: its integral from -eps to eps is 1.
  elemental double precision function delta(distance)
    double precision, intent(in) :: distance
    delta = 0
    if (distance <= eps) delta = (1 + cos(acos(-1d0) * distance / eps)) / (2 * eps)
  end function delta
end program opening_valve
