! SPDX-License-Identifier: Apache-2.0
!> Solves for incompressible flow on a staggered grid of cubic cells, by a fractional step method. The resistance K of a valve is
!! implicit in the momentum equation AND in the pressure equation. README.md has the equations.
!!
!! A cell has a number m. The neighbour of cell m in direction d has the number m + stride(d). The lower face of cell m in
!! direction c has the index (m, c), and velocity component c lies on it. Walls are closed faces between cells inside and outside
!! the lumen. The flow enters at the lower end in z and leaves at the upper end.
module flow_solver
  use, intrinsic :: iso_fortran_env, only: dp => real64
  use flow_pressure, only: pressure_equation
  use flow_source, only: find_source
  use flow_stop, only: refuse
  implicit none
  private
  public :: dp, flow, lumen_function

  type :: flow
    real(dp) :: rho = 1060, mu = 3.5e-3_dp        ! [kg/m^3], [Pa s] of blood
    real(dp) :: tolerance = 1e-8_dp               ! largest residual of the pressure equation, relative to its right-hand side
    logical :: imposed_inlet = .false.            ! .true.: the velocity at the inlet is given; .false.: the pressure is given
    logical :: K_in_pressure = .true.             ! .false. leaves K out of the pressure equation, for the checks
    logical :: band_source = .true.               ! .false. leaves the source in the band out, for the checks
    logical :: net_source = .true.                ! .false.: all sources add up to 0, as they must between closed ends
    logical :: closed_ends = .false.              ! .true.: both ends are walls, so that the vessel is a closed box
    integer :: n(3) = 0, stride(3) = 0            ! cells in each direction, and the step in m to the next cell
    real(dp) :: h = 0, corner(3) = 0              ! [m] side of a cell, lower corner of the box
    integer, allocatable :: cell(:)               ! the cells of the box, x fastest
    integer, allocatable :: face(:, :)            ! (2, n_faces): m and c of every face with an unknown velocity
    integer, allocatable :: inlet(:), outlet(:)   ! the open faces at both ends
    logical, allocatable :: solid(:), closed(:, :) ! cells outside the lumen; faces without flow
    real(dp), allocatable :: xyz(:, :)            ! [m] (3, n_faces) the centres of these faces: the mesh that riis marks
    real(dp), allocatable :: K(:), K_u(:, :)      ! (n_faces), (3, n_faces): K and K u_surface, from riis
    real(dp), allocatable :: v(:, :), p(:)        ! [m/s] (:, 3), [Pa]
    real(dp), allocatable :: b(:)                 ! right-hand side of the pressure equation
    real(dp), allocatable :: S(:)                 ! [1/s] the source in the band of a moving valve
    integer, allocatable, private :: fluid_cell(:), end_cell(:) ! numbers of the cells in the lumen, and of the cells at both ends
    real(dp), allocatable, private :: A(:, :), p_before(:), coefficient(:, :), x(:), predicted(:)
    type(pressure_equation) :: equation
  contains
    procedure :: start, step, time_step, divergence, flow_in, flow_out, flow_through, net_source_rate, mean_pressure, centre
  end type flow

  abstract interface
    pure function lumen_function(x) result(inside)
      import :: dp
      real(dp), intent(in) :: x(3)
      logical :: inside
    end function lumen_function
  end interface

contains

  !> Numbers cells and faces, and begins with fluid at rest. lumen tells whether a cell's centre is inside the walls.
  subroutine start(this, n, h, corner, lumen)
    class(flow), intent(inout) :: this
    integer, intent(in) :: n(3)
    real(dp), intent(in) :: h, corner(3)
    procedure(lumen_function) :: lumen
    integer :: all, area, c, f, first, i, j, k, q, s(3)
    s = [1, n(1) + 5, (n(1) + 5) * (n(2) + 5)]    ! numbers run from -1 to n + 3 in each direction
    all = s(3) * (n(3) + 5)
    area = n(1) * n(2)
    this%n = n
    this%h = h
    this%corner = corner
    this%stride = s
    allocate (this%cell(product(n)), this%solid(all), this%closed(all, 3), this%v(all, 3), this%p(all), this%A(all, 3), &
      this%S(all))
    allocate (this%coefficient(0:3, product(n)), this%b(product(n)), this%x(product(n)))
    this%solid = .true.
    this%closed = .true.
    this%v = 0
    this%p = 0
    this%A = 0
    this%S = 0
    this%cell = [(((1 + dot_product([i, j, k] + 1, s), i = 1, n(1)), j = 1, n(2)), k = 1, n(3))]
    do q = 1, size(this%cell)
      this%solid(this%cell(q)) = .not. lumen(this%centre(this%cell(q)))
    end do
    do k = 1, merge(0, 2, this%closed_ends)       ! the lumen continues beyond open ends
      this%solid(this%cell(:area) - k * s(3)) = this%solid(this%cell(:area))
      this%solid(this%cell(product(n) - area + 1:) + k * s(3)) = this%solid(this%cell(product(n) - area + 1:))
    end do
    do c = 1, 3
      this%closed(1 + s(c):, c) = this%solid(1 + s(c):) .or. this%solid(:all - s(c))
    end do
    this%inlet = pack(this%cell(:area), .not. this%closed(this%cell(:area), 3))
    this%outlet = pack(this%cell(product(n) - area + 1:) + s(3), .not. this%closed(this%cell(product(n) - area + 1:) + s(3), 3))
    this%fluid_cell = pack(this%cell, .not. this%solid(this%cell))
    this%end_cell = pack(this%fluid_cell, this%fluid_cell <= this%cell(area) .or. &
      this%fluid_cell >= this%cell(product(n) - area + 1))
    f = count(.not. this%closed(this%cell, :)) + size(this%outlet) - merge(size(this%inlet), 0, this%imposed_inlet)
    allocate (this%face(2, f), this%xyz(3, f), this%K(f), this%K_u(3, f), this%predicted(f))
    f = 0
    do c = 1, 3
      first = merge(area + 1, 1, c == 3 .and. this%imposed_inlet)
      do q = first, size(this%cell)
        if (this%closed(this%cell(q), c)) cycle
        f = f + 1
        this%face(:, f) = [this%cell(q), c]
      end do
    end do
    this%face(1, f + 1:) = this%outlet
    this%face(2, f + 1:) = 3
    do f = 1, size(this%face, 2)
      this%xyz(:, f) = this%centre(this%face(1, f))
      this%xyz(this%face(2, f), f) = this%xyz(this%face(2, f), f) - h / 2
    end do
    this%K = 0
    this%K_u = 0
    call this%equation%start(n)
  end subroutine start

  !> Returns the centre of cell m.
  pure function centre(this, m) result(x)
    class(flow), intent(in) :: this
    integer, intent(in) :: m
    real(dp) :: x(3)
    x = this%corner + this%h * (0.5_dp - 2 + [mod(m - 1, this%stride(2)), mod(m - 1, this%stride(3)) / this%stride(2), &
      (m - 1) / this%stride(3)])
  end function centre

  !> Advances velocity and pressure by dt. at_inlet is the given velocity or pressure at the inlet. p_out is the pressure at the
  !! outlet.
  subroutine step(this, dt, at_inlet, p_out)
    class(flow), intent(inout) :: this
    real(dp), intent(in) :: dt, at_inlet, p_out
    real(dp) :: rate
    logical :: failed
    integer :: c, d, f, m, q
    associate (v => this%v, p => this%p, A => this%A, s => this%stride, h => this%h, rho => this%rho, face => this%face)
      if (this%imposed_inlet) v(this%inlet, 3) = at_inlet
      call fill_ends(this)
      call set_source(this, dt)
      if (.not. this%K_in_pressure) this%p_before = p

      ! The predictor: (rho/dt + K) u* = rho/dt u - rho div(u u) + mu laplace(u) + K u_surface.
      !$omp parallel do private(m, c, d, rate)
      do f = 1, size(face, 2)
        m = face(1, f)
        c = face(2, f)
        rate = 0
        do d = 1, 3
          rate = rate + (flux(this, m - s(d), d, c) - flux(this, m, d, c)) / h
        end do
        if (.not. this%K_in_pressure) rate = rate - (p(m) - p(m - s(c))) / h
        this%predicted(f) = (rho / dt * v(m, c) + rate + this%K_u(c, f)) / (rho / dt + this%K(f))
        A(m, c) = 1 / (rho / dt + merge(this%K(f), 0._dp, this%K_in_pressure))
      end do
      !$omp parallel do private(m, c)
      do f = 1, size(face, 2)
        v(face(1, f), face(2, f)) = this%predicted(f)
      end do

      ! The pressure equation: div(1/(rho/dt + K) grad p) = div u* - S, times -h^2. At both ends p is given half a cell beyond the
      ! last cell. Inflow comes from rest, so its pressure is lower than the given pressure by rho u^2 / 2.
      p(this%inlet - s(3)) = at_inlet - rho / 2 * max(0._dp, v(this%inlet, 3))**2
      p(this%outlet) = p_out - rho / 2 * min(0._dp, v(this%outlet, 3))**2
      !$omp parallel do private(m)
      do q = 1, size(this%cell)
        m = this%cell(q)
        this%coefficient(0, q) = sum(A(m, :)) + A(m + s(1), 1) + A(m + s(2), 2) + A(m + s(3), 3)
        this%coefficient(1:3, q) = -A(m, :)
        this%b(q) = -h * (v(m + s(1), 1) - v(m, 1) + v(m + s(2), 2) - v(m, 2) + v(m + s(3), 3) - v(m, 3) - &
          h * this%S(m))
        if (m <= 3 * s(3)) then
          this%coefficient(0, q) = this%coefficient(0, q) + A(m, 3)
          this%coefficient(3, q) = 0
          this%b(q) = this%b(q) + 2 * A(m, 3) * p(m - s(3)) ! A is 0 if the velocity is given
        else if (m > (this%n(3) + 1) * s(3)) then
          this%coefficient(0, q) = this%coefficient(0, q) + A(m + s(3), 3)
          this%b(q) = this%b(q) + 2 * A(m + s(3), 3) * p(m + s(3))
        end if
        if (this%coefficient(0, q) <= 0) this%coefficient(0, q) = dt / rho ! a cell in the wall
        ! Between closed ends the pressure is known only up to a constant, so it is set to 0 in one cell at an end.
        if (this%closed_ends .and. m == this%end_cell(1)) this%coefficient(0, q) = this%coefficient(0, q) + dt / rho
        this%x(q) = merge(p(m), 0._dp, this%K_in_pressure)
      end do
      call this%equation%solve(this%coefficient, this%b, this%x, this%tolerance, failed)
      if (failed) call refuse('the pressure equation does not converge')
      p(this%cell) = this%x
      p(this%inlet - s(3)) = 2 * p(this%inlet - s(3)) - p(this%inlet)
      p(this%outlet) = 2 * p(this%outlet) - p(this%outlet - s(3))

      ! The corrector: u = u* - 1/(rho/dt + K) grad p.
      !$omp parallel do private(m, c)
      do f = 1, size(face, 2)
        m = face(1, f)
        c = face(2, f)
        v(m, c) = v(m, c) - A(m, c) * (p(m) - p(m - s(c))) / h
      end do
      if (.not. this%K_in_pressure) p = p + this%p_before
    end associate
  end subroutine step

  ! Computes S for a step of dt. A face is held by the band if K dt > rho. S is 0 if K u_surface is 0 everywhere.
  subroutine set_source(this, dt)
    class(flow), intent(inout) :: this
    real(dp), intent(in) :: dt
    logical, allocatable :: held(:)
    real(dp), allocatable :: u(:)
    integer :: f
    if (.not. this%band_source .or. .not. any(abs(this%K_u) > 0)) then
      this%S = 0
      return
    end if
    held = this%K * dt > this%rho
    u = [(this%K_u(this%face(2, f), f) / merge(this%K(f), 1._dp, held(f)), f = 1, size(held))]
    call find_source(this%fluid_cell, this%end_cell, this%stride, this%h, this%closed, this%face, held, u, &
      this%closed_ends .or. .not. this%net_source, this%S)
  end subroutine set_source

  ! Returns the flux of momentum c from m to m + stride(d): the convective flux minus the viscous flux. The velocity on the face
  ! is second order where the flow is smooth. Van Leer's limiter keeps it between the values of its neighbours.
  pure real(dp) function flux(this, m, d, c)
    class(flow), intent(in) :: this
    integer, intent(in) :: m, d, c
    real(dp) :: carrier, low, high, value
    integer :: next
    next = m + this%stride(d)
    low = this%v(m, c)
    high = this%v(next, c)
    carrier = (this%v(next, d) + this%v(next - this%stride(c), d)) / 2
    if (carrier >= 0) then
      value = low + limited(low - this%v(m - this%stride(d), c), high - low) / 2
    else
      value = high - limited(this%v(next + this%stride(d), c) - high, high - low) / 2
    end if
    if (d /= c) then                              ! a wall is half a cell away
      if (this%closed(m, c)) low = -high
      if (this%closed(next, c)) high = -low
    end if
    flux = this%rho * carrier * value - this%mu * (high - low) / this%h
  end function flux

  ! Returns the harmonic mean of two slopes, or 0 if their signs differ.
  pure real(dp) function limited(a, b)
    real(dp), intent(in) :: a, b
    limited = 0
    if (a * b > 0) limited = 2 * a * b / (a + b)
  end function limited

  ! Copies the velocities inside both ends to the places beyond the ends. Inflow has no component across the axis.
  subroutine fill_ends(this)
    class(flow), intent(inout) :: this
    integer :: c, f, m, s
    s = this%stride(3)
    do c = 1, 3
      do f = 1, size(this%inlet)
        m = this%inlet(f)
        this%v([m - s, m - 2 * s], c) = merge(0._dp, this%v(m, c), c < 3 .and. this%v(m, 3) > 0)
      end do
      do f = 1, size(this%outlet)
        m = this%outlet(f)
        if (c < 3) this%v([m, m + s], c) = merge(0._dp, this%v(m - s, c), this%v(m, 3) < 0)
        if (c == 3) this%v([m + s, m + 2 * s], c) = this%v(m, c)
      end do
    end do
  end subroutine fill_ends

  !> Returns the time step: half a cell over the largest sum of the three speeds, and at most `longest`.
  real(dp) function time_step(this, longest)
    class(flow), intent(in) :: this
    real(dp), intent(in) :: longest
    real(dp) :: speed
    integer :: m, q
    speed = 0
    !$omp parallel do private(m) reduction(max: speed)
    do q = 1, size(this%cell)
      m = this%cell(q)
      speed = max(speed, max(abs(this%v(m, 1)), abs(this%v(m + this%stride(1), 1))) + &
        max(abs(this%v(m, 2)), abs(this%v(m + this%stride(2), 2))) + max(abs(this%v(m, 3)), abs(this%v(m + this%stride(3), 3))))
    end do
    time_step = min(longest, this%h**2 * this%rho / (8 * this%mu), 0.5_dp * this%h / max(speed, tiny(speed)))
  end function time_step

  !> Returns the largest value over the cells of |divergence - source| [1/s].
  real(dp) function divergence(this)
    class(flow), intent(in) :: this
    associate (m => this%cell, s => this%stride, v => this%v)
      divergence = maxval(abs(v(m + s(1), 1) - v(m, 1) + v(m + s(2), 2) - v(m, 2) + v(m + s(3), 3) - v(m, 3) - &
        this%h * this%S(m))) / this%h
    end associate
  end function divergence

  !> Returns the flow through the inlet [m^3/s].
  real(dp) function flow_in(this)
    class(flow), intent(in) :: this
    flow_in = this%h**2 * sum(this%v(this%inlet, 3))
  end function flow_in

  !> Returns the flow through the outlet [m^3/s].
  real(dp) function flow_out(this)
    class(flow), intent(in) :: this
    flow_out = this%h**2 * sum(this%v(this%outlet, 3))
  end function flow_out

  !> Returns the flow that passes the valve [m^3/s]: the mean of inflow and outflow. The two differ by the net source in the band
  !! of a moving valve.
  real(dp) function flow_through(this)
    class(flow), intent(in) :: this
    flow_through = (this%flow_in() + this%flow_out()) / 2
  end function flow_through

  !> Returns the sum of all sources [m^3/s].
  real(dp) function net_source_rate(this)
    class(flow), intent(in) :: this
    net_source_rate = this%h**3 * sum(this%S(this%cell))
  end function net_source_rate

  !> Returns the mean pressure [Pa] over the layer of cells in the lumen at height z.
  real(dp) function mean_pressure(this, z)
    class(flow), intent(in) :: this
    real(dp), intent(in) :: z
    integer :: area, k
    area = product(this%n(1:2))
    k = min(this%n(3), max(1, ceiling((z - this%corner(3)) / this%h)))
    associate (layer => this%cell((k - 1) * area + 1:k * area))
      mean_pressure = sum(this%p(layer), mask=.not. this%solid(layer)) / count(.not. this%solid(layer))
    end associate
  end function mean_pressure

end module flow_solver
