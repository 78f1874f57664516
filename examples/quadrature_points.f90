! SPDX-License-Identifier: Apache-2.0
! Computes resistances for a finite element code: K and K u_surface at the quadrature points of tetrahedra, and their integrals
! with the shape functions. The quadrature points are the nodes of riis's mesh, which needs no adjacency. The valve is half open
! and moves with the heart. The program checks that the integral of K is the area of the valve times R/eps, and that K u_surface
! is K times the valve's velocity. Lengths are in metres.
program quadrature_points
  use riis
  implicit none
  integer, parameter :: n = 33, n_nodes = n**3, n_cells = 6 * (n - 1)**3, n_points = 4 * n_cells
  double precision, parameter :: R = 1d4, eps = 1.5d-3, dt = 1d-3         ! [kg/(m s)], [m], [s]
  double precision, parameter :: speed(3) = [0d0, 0.01d0, 0.05d0]         ! [m/s] the heart's velocity
  double precision, parameter :: weight = 0.0015d0**3 / 6 / 4             ! [m^3] each is a quarter of the tetrahedron's volume
  double precision, parameter :: near = 0.58541019662496852d0, far = 0.1381966011250105d0 ! values of the shape functions
  double precision :: xyz(3, n_nodes)             ! [m] a cube of 4.8 cm around the valve, a node every 1.5 mm
  integer :: node_ids(4, n_cells)                 ! the four nodes of each tetrahedron
  double precision :: point(3, n_points)          ! [m] four quadrature points per tetrahedron, of degree 2
  double precision :: coefficient(n_points)       ! [kg/(m^3 s)] K
  double precision :: momentum(3, n_points)       ! [N/m^3] K u_surface
  double precision :: lumped(n_nodes)             ! [kg/s] integral of K times the node's shape function
  double precision :: right_hand_side(3, n_nodes) ! [N] integral of K u_surface times the shape function
  double precision :: force(3), expected
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: result
  type(riis_surface_info) :: info
  logical :: is_right

  call make_tetrahedra()
  call make_points()
  call valve%create('mitral')
  call valve%set('opening', 0.5d0)
  call surface%create(valve, half_thickness=eps, scale=0.01d0) ! the valve is given in centimetres
  ! One time step ago, the valve was at another place. If the valve also opened, the call would need a second valve with the
  ! earlier opening.
  call surface%update_moving(valve, valve, dt, translation=[0d0, 0d0, 0d0], translation_before=-speed * dt)
  call mesh%create(point)

  ! The band ends at the free edges and at the annulus.
  coefficient = 0
  momentum = 0
  call riis_mark_nodes(surface, mesh, result, fields=RIIS_FIELD_VELOCITY + RIIS_FIELD_RIM)
  call result%add_resistance(R, coefficient, momentum, rim=RIIS_RIM_CUT)
  call assemble()

  force = sum(right_hand_side, 2)
  call surface%get_info(info)
  expected = R / eps * info%area
  print '(i0, a, i0, a)', n_points, ' quadrature points in ', n_cells, ' tetrahedra'
  print '(a, es10.4, a, es10.4, a)', 'sum of K ', sum(lumped), ' kg/s, area * R/eps ', expected, ' kg/s'
  print '(a, es10.4, a, es10.4, a)', 'sum of K u_surface ', force(2), ' ', force(3), ' N along y and z'
  is_right = abs(sum(lumped) / expected - 1) < 0.01d0 .and. &
    all(abs(force - sum(lumped) * speed) < 1d-9 * sum(lumped) * speed(3))

  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()
  if (.not. is_right) error stop 'the sums are off'

contains

  ! Cuts each cube of the grid into six tetrahedra. Each tetrahedron follows three edges from the first node of the cube to its
  ! last node. No two tetrahedra follow the axes in the same order.
  subroutine make_tetrahedra()
    integer, parameter :: axes(3, 6) = reshape([1, 2, 3, 1, 3, 2, 2, 1, 3, 2, 3, 1, 3, 1, 2, 3, 2, 1], [3, 6])
    integer, parameter :: step(3) = [1, n, n**2]
    integer :: cell, node, i, j, at(3)

    cell = 0
    do node = 1, n_nodes
      at = mod((node - 1) / step, n)
      xyz(:, node) = -0.024d0 + 0.0015d0 * at
      if (any(at == n - 1)) cycle ! no cube begins here
      do i = 1, 6
        cell = cell + 1
        node_ids(1, cell) = node
        do j = 1, 3
          node_ids(j + 1, cell) = node_ids(j, cell) + step(axes(j, i))
        end do
      end do
    end do
  end subroutine make_tetrahedra

  ! Returns the shape functions of the four corners at a quadrature point.
  pure function shapes(q) result(values)
    integer, intent(in) :: q
    double precision :: values(4)

    values = far
    values(q) = near
  end function shapes

  subroutine make_points()
    integer :: cell, q

    do cell = 1, n_cells
      do q = 1, 4
        point(:, 4 * (cell - 1) + q) = matmul(xyz(:, node_ids(:, cell)), shapes(q))
      end do
    end do
  end subroutine make_points

  ! Adds K and K u_surface of all points to the nodes, as in the assembly of any element vector.
  subroutine assemble()
    integer :: cell, q, a, i, node
    double precision :: by(4)

    lumped = 0
    right_hand_side = 0
    do cell = 1, n_cells
      do q = 1, 4
        i = 4 * (cell - 1) + q
        by = weight * shapes(q)
        do a = 1, 4
          node = node_ids(a, cell)
          lumped(node) = lumped(node) + by(a) * coefficient(i)
          right_hand_side(:, node) = right_hand_side(:, node) + by(a) * momentum(:, i)
        end do
      end do
    end do
  end subroutine assemble
end program quadrature_points
