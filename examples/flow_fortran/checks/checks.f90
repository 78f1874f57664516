! SPDX-License-Identifier: Apache-2.0
!> Checks the flow solver against known results. `checks NAME` runs one check, `checks` runs all of them, and `checks short` runs
!! all of them on coarse grids. The status is 1 if a check fails.
program checks
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use riis
  use flow_solver, only: dp, flow
  use flow_valve, only: leaflets, check
  use check_tools
  use check_moving, only: check_equal_pressures, check_beside, check_plates, check_jet, check_box
  use flow_root, only: in_root, fit_root
  use flow_stop, only: step_number, step_time
  implicit none
  real(dp), parameter :: pi = acos(-1._dp)
  character(len=20) :: name

  call get_command_argument(1, name)
  select case (name)
  case ('duct')
    call check_duct()
  case ('drop')
    call check_drop()
  case ('slow')
    call check_slow_drop()
  case ('explicit')
    call check_explicit()
  case ('balance')
    call check_balance()
  case ('moving')
    call check_u_surface()
  case ('equal')
    call check_equal_pressures([24, 32, 48])
  case ('beside')
    call check_beside([1, 2, 3, 4, 5, 6, 7, 8, 9])
  case ('plates')
    call check_plates()
  case ('jet')
    call check_jet([24, 32, 40])
  case ('box')
    call check_box(1)
  case ('closed')
    call check_closed(0.5_dp, 5)
  case ('study')
    call study()
  case ('nan')
    call feed_nan()
  case ('short', '')
    call check_duct()
    call check_drop()
    call check_slow_drop()
    call check_explicit()
    call check_balance()
    call check_u_surface()
    call check_plates()
    if (name == 'short') then                     ! coarse grids
      call check_closed(1._dp, 3)
      call check_box(5)
      call check_equal_pressures([24])
      call check_beside([1, 5])
      call check_jet([24])
    else
      call check_closed(0.5_dp, 5)
      call check_box(1)
      call check_equal_pressures([24, 32, 48])
      call check_beside([1, 2, 3, 4, 5, 6, 7, 8, 9])
      call check_jet([24, 32, 40])
    end if
  case default
    print '(3a)', 'checks: "', trim(name), '" is none of duct, drop, slow, explicit, balance, moving, plates, box, closed, ' // &
      'equal, beside, jet, short, study, nan'
    stop 2, quiet=.true.
  end select
  if (.not. all_right) stop 1, quiet=.true.

contains

  ! Returns the pressure drop over the middle of a duct.
  real(dp) function drop_of(fluid)
    type(flow), intent(in) :: fluid
    drop_of = fluid%mean_pressure(fluid%h * 1.5_dp) - fluid%mean_pressure(fluid%h * (fluid%n(3) - 1.5_dp))
  end function drop_of

  ! (a) A pressure difference drives a steady flow through a square duct. The exact formula is a series of cosines.
  subroutine check_duct()
    integer, parameter :: sizes(3) = [6, 12, 24]
    real(dp), parameter :: side = 0.01_dp, gradient = 0.01_dp ! the flow is so slow that inertia is negligible
    type(flow) :: fluid
    real(dp) :: error(0:3), flow_error(0:3), order(2), exact, flow_exact, x(3), length, largest
    integer :: i, n, q, term
    print '(a)', 'Duct, without a valve: error of the velocity against the closed form, and of the flow'
    error(0) = 1
    flow_error(0) = 1
    print '(a)', '  cells across  velocity, %  order  flow, %  order'
    do i = 1, 3
      n = sizes(i)
      fluid = flow()
      fluid%mu = 0.05_dp
      call make_duct(fluid, [n, n, 4], side / n, .false.)
      length = 4 * fluid%h
      do q = 1, 8 * n**2                          ! until the time side^2 rho/mu; the rest of the transient is then below 1e-8
        call fluid%step(fluid%time_step(1._dp), gradient * length, 0._dp)
      end do
      error(i) = 0
      largest = 0
      flow_exact = 0
      do q = 1, n * n
        x = (fluid%centre(fluid%cell(q)) - side / 2) / side
        exact = 0
        do term = 1, 199, 2
          exact = exact + 4 * gradient * side**2 / (fluid%mu * pi**3 * term**3) * sin(term * pi / 2) * cos(term * pi * x(1)) * &
            (1 - cosh(term * pi * x(2)) / cosh(term * pi / 2))
        end do
        error(i) = max(error(i), abs(fluid%v(fluid%cell(q), 3) - exact))
        largest = max(largest, abs(exact))
      end do
      do term = 1, 199, 2
        flow_exact = flow_exact + 8 * gradient * side**4 / (fluid%mu * pi**4 * term**4) * &
          (1 - 2 * tanh(term * pi / 2) / (term * pi))
      end do
      error(i) = error(i) / largest
      flow_error(i) = abs(fluid%flow_out() / flow_exact - 1)
      order = log([error(i - 1) / error(i), flow_error(i - 1) / flow_error(i)]) / log(2._dp)
      if (i == 1) print '(i14, f13.3, a7, f9.3, a7)', n, 100 * error(i), '-', 100 * flow_error(i), '-'
      if (i > 1) print '(i14, f13.3, f7.2, f9.3, f7.2)', n, 100 * error(i), order(1), 100 * flow_error(i), order(2)
      call fluid%equation%finish()
    end do
    call demand(all(abs(order - 2) < 0.2_dp), 'both are of second order')
  end subroutine check_duct

  ! (b) A plate closes a duct with a given flow. The next step must have the whole drop, whatever the size of the time step.
  subroutine check_drop()
    real(dp), parameter :: h = 1e-3_dp, R = 1e4_dp, eps = 1.5_dp * h, u = 0.1_dp
    type(flow) :: fluid
    real(dp) :: dt, before, drop, worst
    integer :: halving, i
    print '(a)', 'Plate in a duct, flow 0.1 m/s given, K in both equations: drop in the very step after closing'
    print '(a)', '   dt, ms  drop, kPa  (R/eps) u, kPa  ratio'
    worst = 0
    do halving = 0, 2
      dt = 1e-3_dp / 2**halving
      fluid = flow()
      call make_duct(fluid, [12, 12, 24], h, .true.)
      do i = 1, 10
        call fluid%step(dt, u, 0._dp)
      end do
      before = drop_of(fluid)
      call put_plate(fluid, 12.3_dp * h, R, eps, 0._dp)
      call fluid%step(dt, u, 0._dp)
      drop = drop_of(fluid) - before
      worst = max(worst, abs(drop / (R / eps * u) - 1))
      print '(f9.2, f11.2, f16.2, f7.4)', 1e3_dp * dt, drop / 1000, R / eps * u / 1000, drop / (R / eps * u)
      call fluid%equation%finish()
    end do
    call demand(worst < 0.05_dp, 'each is within 5 % of (R/eps) u')
  end subroutine check_drop

  ! (b) A plate closes the same duct, but the pressure equation does not contain K. Each face in the band then lacks the share
  ! (1 + rho/(K dt))^-steps of its drop.
  subroutine check_slow_drop()
    real(dp), parameter :: h = 1e-3_dp, R = 1e4_dp, eps = 1.5_dp * h, u = 0.1_dp, dt = 1e-3_dp
    integer, parameter :: seen(5) = [1, 10, 100, 1000, 10000]
    real(dp), parameter :: stages(3) = [8 / 15._dp, 2 / 15._dp, 1 / 3._dp]
    type(flow) :: fluid
    real(dp), allocatable :: K_dt(:), missing(:)  ! K dt/rho of faces, and its product with the missing share of the drop
    real(dp) :: drop, expected, worst
    integer :: i, stage
    print '(a)', 'The same with K in the momentum equation alone, and pressure increments: share of (R/eps) u, dt 1 ms'
    print '(a)', '   steps     time, s  measured  expected'
    fluid = flow()
    fluid%K_in_pressure = .false.
    fluid%mu = 1e-9_dp                            ! the formula holds for a uniform flow, so friction at the walls must be small
    call make_duct(fluid, [4, 4, 16], h, .true.)
    fluid%v(fluid%face(1, :), 3) = merge(u, 0._dp, fluid%face(2, :) == 3)
    call put_plate(fluid, 8.3_dp * h, R, eps, 0._dp)
    worst = 0
    do i = 1, maxval(seen)
      call fluid%step(dt, u, 0._dp)
      if (all(i /= seen)) cycle
      drop = drop_of(fluid) / (R / eps * u)
      expected = h / 16 / (R / eps) * sum(fluid%K * (1 - (fluid%K * dt / (fluid%rho + fluid%K * dt))**i), &
        mask=fluid%face(2, :) == 3)
      worst = max(worst, abs(drop / expected - 1))
      print '(i8, f12.3, 2f10.4)', i, i * dt, drop, expected
    end do
    call fluid%equation%finish()
    call demand(worst < 0.05_dp, 'the drop builds up as expected, within 5 %')
    ! With Runge-Kutta stages, a stage of the length a dt multiplies the missing share by a K dt/(rho + a K dt).
    allocate(K_dt, source=pack(fluid%K, fluid%face(2, :) == 3) * dt / fluid%rho)
    K_dt = K_dt * 214 / maxval(K_dt)
    print '(a)', 'Expected with the three stages of a Runge-Kutta scheme and K dt/rho = 214 at the peak'
    print '(a)', '   steps  expected'
    do i = 1, 3
      missing = K_dt
      do stage = 1, 3
        missing = missing * (stages(stage) * K_dt / (1 + stages(stage) * K_dt))**seen(i)
      end do
      print '(i8, f10.4)', seen(i), 1 - sum(missing) / sum(K_dt)
    end do
    print '(a)', ''
  end subroutine check_slow_drop

  ! (c) The difference between inflow and outflow is bounded by the residual that HYPRE leaves.
  subroutine check_balance()
    type(flow), target :: fluid
    type(leaflets) :: valve
    real(dp) :: bound, flow_bound, difference, divergence
    logical :: fits
    integer :: i, j
    print '(a)', 'Mass balance with the valve half open in its root, 1 kPa: largest divergence, and inflow less outflow'
    print '(a)', '  tolerance  residual  divergence, 1/s     bound  in - out, ml/s     bound  flow, ml/s  iterations'
    fits = .true.
    do i = 4, 10, 2
      fluid = flow()
      fluid%tolerance = 10._dp**(-i)
      call start_root(fluid, valve, 24, 1.5_dp, 1e4_dp, 0.5_dp)
      do j = 1, 10
        call valve%move(0.5_dp, 1e-3_dp, fluid)
        call fluid%step(1e-3_dp, 1000._dp, 0._dp)
      end do
      bound = fluid%tolerance * norm2(fluid%b) / fluid%h**2
      flow_bound = fluid%tolerance * norm2(fluid%b) * sqrt(real(size(fluid%b), dp)) * fluid%h
      difference = abs(fluid%flow_in() - fluid%flow_out())
      divergence = fluid%divergence()
      fits = fits .and. divergence <= 1.01_dp * bound .and. difference <= 1.01_dp * flow_bound
      print '(es11.0, es10.1, es17.2, es10.1, es16.2, es10.1, f12.2, i12)', fluid%tolerance, fluid%equation%residual, &
        divergence, bound, 1e6_dp * difference, 1e6_dp * flow_bound, 1e6_dp * fluid%flow_out(), fluid%equation%iterations
      call finish_root(fluid, valve)
    end do
    call demand(fits, 'both are within their bounds')
  end subroutine check_balance

  ! (d) A plate that moves through a duct must move the fluid like a piston. Without u_surface the fluid stays at rest.
  subroutine check_u_surface()
    real(dp), parameter :: h = 1e-3_dp, R = 1e4_dp, eps = 1.5_dp * h, w = 0.1_dp, dt = 1e-3_dp
    type(flow), target :: fluid
    type(leaflets) :: valve
    real(dp) :: u(2), displaced(2), least(2), time, short
    integer :: i, with
    print '(a)', 'A plate moves at 0.1 m/s through a duct, and the aortic valve closes within 40 ms in its root.'
    print '(a)', 'The pressures at both ends are equal. The table shows the flow that they drive:'
    print '(a)', '  K u_surface  flow behind plate, m/s  back through root, ml  most, ml/s'
    do with = 1, 2
      fluid = flow()
      call make_duct(fluid, [8, 8, 32], h, .false.)
      do i = 1, 100
        call put_plate(fluid, 0.01_dp + i * dt * w, R, eps, w)
          if (with == 2) fluid%K_u = 0
        call fluid%step(dt, 0._dp, 0._dp)
      end do
      u(with) = fluid%flow_out() / (64 * h**2)
      call fluid%equation%finish()
      fluid = flow()
      valve%moves_flow = with == 1
      call start_root(fluid, valve, 24, 1.5_dp, 1e4_dp, 1._dp)
      displaced(with) = 0
      least(with) = 0
      time = 0
      do while (time < 0.04_dp)
        short = fluid%time_step(dt)
        time = time + short
        call valve%move(ramp(1 - time / 0.04_dp), short, fluid)
        call fluid%step(short, 0._dp, 0._dp)
        displaced(with) = displaced(with) - short * fluid%flow_out()
        least(with) = min(least(with), fluid%flow_out())
      end do
      call finish_root(fluid, valve)
      print '(a13, f24.4, f23.2, f12.1)', merge('with   ', 'without', with == 1), u(with), 1e6_dp * displaced(with), &
        1e6_dp * abs(least(with))
    end do
    call demand(abs(u(1) / w - 1) < 0.01_dp .and. abs(u(2)) < 0.01_dp * w .and. displaced(1) > 10 * abs(displaced(2)), &
      'with K u_surface the plate and the leaflets move the fluid, without K u_surface the fluid rests')
  end subroutine check_u_surface

  ! (g) With an explicit K, the flow grows without limit where K dt/rho is too large. The scheme is sum over j of a(j) u(n+1-j) =
  ! -(K dt/rho) sum over j of b(j) u(n+1-j), with b(0) = 0. The history changes its sign in each step. The check finds by
  ! bisection the largest K dt/rho at which u decays. Algebra gives the value at which the scheme has the root -1.
  subroutine check_explicit()
    integer, parameter :: n_schemes = 6
    character(len=33), parameter :: names(n_schemes) = [character(len=33) :: 'forward Euler', 'BDF2, EXT2', &
      'AB2 (Adams-Bashforth)', 'BDF3, EXT3', 'BDF2, three levels (Nek5000)', 'AB3']
    real(dp), parameter :: a(0:3, n_schemes) = reshape([real(dp) :: 1, -1, 0, 0, 1.5_dp, -2, 0.5_dp, 0, 1, -1, 0, 0, &
      11 / 6._dp, -3, 1.5_dp, -1 / 3._dp, 1.5_dp, -2, 0.5_dp, 0, 1, -1, 0, 0], [4, n_schemes])
    real(dp), parameter :: b(3, n_schemes) = reshape([real(dp) :: 1, 0, 0, 2, -1, 0, 1.5_dp, -0.5_dp, 0, 3, -3, 1, &
      8 / 3._dp, -7 / 3._dp, 2 / 3._dp, 23 / 12._dp, -16 / 12._dp, 5 / 12._dp], [3, n_schemes])
    real(dp), parameter :: signs(0:3) = [1, -1, 1, -1]
    real(dp) :: least, most, middle, exact
    logical :: fits
    integer :: scheme
    print '(a)', 'Largest K dt/rho at which an explicit K u decays; K is at most R/eps^2'
    print '(a)', '  scheme                             root -1   measured'
    fits = .true.
    do scheme = 1, n_schemes
      exact = -sum(signs * a(:, scheme)) / sum(signs(1:3) * b(:, scheme))
      least = 0
      most = 4
      do while (most - least > 1e-5_dp)
        middle = (least + most) / 2
        if (decays(a(:, scheme), middle * b(:, scheme))) then
          least = middle
        else
          most = middle
        end if
      end do
      fits = fits .and. abs(least - exact) < 1e-3_dp
      print '(2x, a, 2f10.4)', names(scheme), exact, least
    end do
    call demand(fits, 'both agree')
  end subroutine check_explicit

  ! Returns whether a scheme makes u decay within 100,000 steps.
  logical function decays(a, z_b)
    real(dp), intent(in) :: a(0:3), z_b(3)
    real(dp) :: u(0:3)
    integer :: i
    u(1:3) = [1, -1, 1]
    do i = 1, 100000
      u(0) = -sum((a(1:3) + z_b) * u(1:3)) / a(0)
      u(1:3) = u(0:2)
      if (maxval(abs(u(1:3))) > 1e3_dp) exit
    end do
    decays = maxval(abs(u(1:3))) < 1
  end function decays

  ! (i) The leak of a closed valve hardly depends on the offset. Rims are cut, and a skirt extends into the wall. The half
  ! thickness is 1 mm, and a cell has the size h in mm. The walls of the first rows are straight. In a root, the offset moves the
  ! band into the sinuses, where it has more area. The last root is that of the trileaflet valve, which the other checks also use.
  subroutine check_closed(h, n_rows)
    real(dp), intent(in) :: h
    integer, intent(in) :: n_rows
    character(len=10), parameter :: kinds(5) = [character(len=10) :: 'coapting', 'trileaflet', 'mitral', 'coapting', 'trileaflet']
    character(len=9), parameter :: vessels(5) = [character(len=9) :: 'tube', 'tube', 'oval tube', 'root', 'root']
    real(dp), parameter :: offsets(3) = [0._dp, 0.5_dp, 0.75_dp], eps = 1e-3_dp, R = 1e3_dp, dp_closed = 80 * 133.322_dp
    type(flow), target :: fluid
    type(leaflets) :: valve
    real(dp) :: leak(3), largest(5), side
    integer :: i, n(3), row
    print '(a)', 'Leak of closed valves at 80 mmHg, half thickness 1 mm, R = 1000, cut rim and skirt, in ml/s'
    print '(a)', '  valve       walls        o = 0    0.5   0.75   over that of o = 0'
    side = h * 1e-3_dp
    n = nint([0.036_dp, 0.036_dp, 0.042_dp] / side)
    largest = 0
    do row = 1, n_rows
      do i = 1, size(offsets)
        fluid = flow()
        valve = leaflets(kind=kinds(row), eps=eps, R=R, offset=offsets(i), rim=RIIS_RIM_CUT)
        call valve%valve%create(valve%kind)
        call valve%valve%set('skirt_length', 0.2_dp)
        select case (vessels(row))
        case ('oval tube')
          call place_vessel(valve%kind, valve%place, valve%turn_axis, valve%turn)
          call fluid%start(nint([0.046_dp, 0.04_dp, 0.05_dp] / side), side, [-0.023_dp, -0.02_dp, -0.018_dp], in_vessel)
        case ('tube')
          call fit_root(valve%valve, kinds(row), valve%place(3))
          call fluid%start(n, side, [-0.018_dp, -0.018_dp, -0.018_dp], in_tube)
        case default
          call fit_root(valve%valve, kinds(row), valve%place(3))
          call fluid%start(n, side, [-0.018_dp, -0.018_dp, -0.018_dp], in_root)
        end select
        call valve%start(fluid, 0._dp)
        call valve%move(0._dp, 1e-3_dp, fluid)
        do step_number = 1, 5
          call fluid%step(1e-3_dp, 0._dp, dp_closed)
        end do
        leak(i) = -1e6_dp * fluid%flow_out()
        call finish_root(fluid, valve)
      end do
      largest(row) = maxval(abs(leak / leak(1) - 1))
      print '(2x, 2a, f9.3, 2f7.3, f10.3, f7.3)', kinds(row), '  ' // vessels(row), leak, leak(2:) / leak(1)
    end do
    print '(a)', ''
    call demand(all(largest(2:3) < 0.05_dp), &
      'in tubes an offset changes the leak of trileaflet and mitral valves by less than 5 %')
    call demand(largest(1) < 0.16_dp, 'in a tube it changes that of the coapting valve, whose gap is 0.2 mm, by less than 16 %')
  end subroutine check_closed

  ! Tells whether a point is inside a tube that cuts the attachments of the trileaflet and the coapting valves.
  pure logical function in_tube(x)
    real(dp), intent(in) :: x(3)
    in_tube = norm2(x(1:2)) < 0.0124_dp
  end function in_tube

  ! (f) Prints how R and eps change the drop of a plate at ten places between faces, and the leak of the closed valve.
  subroutine study()
    real(dp), parameter :: h = 1e-3_dp, u = 0.1_dp, &
      cells_of_eps(8) = [0.35_dp, 0.5_dp, 0.75_dp, 1._dp, 1.25_dp, 1.5_dp, 2._dp, 3._dp]
    real(dp), parameter :: dp_closed = 80 * 133.322_dp
    integer, parameter :: sizes(3) = [24, 40, 56]
    type(flow), target :: fluid
    type(leaflets) :: valve
    type(riis_surface_info) :: info
    real(dp) :: drop(0:9), eps, R, ideal
    integer :: i, iterations, j, k
    print '(a)', 'Drop of a plate in one step, over (R/eps) u: least and largest of 10 places between two faces'
    print '(a)', '  eps/h     least   largest'
    do i = 1, size(cells_of_eps)
      eps = cells_of_eps(i) * h
      do j = 0, 9
        fluid = flow()
        call make_duct(fluid, [4, 4, 24], h, .true.)
        fluid%v(fluid%face(1, :), 3) = merge(u, 0._dp, fluid%face(2, :) == 3)
        call put_plate(fluid, (12 + j / 10._dp) * h, 1e4_dp, eps, 0._dp)
        call fluid%step(1e-3_dp, u, 0._dp)
        drop(j) = drop_of(fluid) / (1e4_dp / eps * u)
        call fluid%equation%finish()
      end do
      print '(f7.2, 2f10.4)', cells_of_eps(i), minval(drop), maxval(drop)
    end do
    print '(/a)', 'Leak of the closed aortic valve at 80 mmHg, and the most iterations of a step'
    print '(a)', 'Ideal is dp eps/R through the area of the leaflets'
    print '(a)', '  cells  eps/h  eps, mm       R  leak, ml/s    ideal   ratio  iterations'
    do k = 1, size(sizes)
      do i = 1, size(cells_of_eps)
        do j = 3, 5
          if (j /= 4 .and. .not. (k == 2 .and. abs(cells_of_eps(i) - 1.5_dp) < 0.1_dp)) cycle
          R = 10._dp**j
          fluid = flow()
          call start_root(fluid, valve, sizes(k), cells_of_eps(i), R, 0._dp)
          call valve%move(0._dp, 1e-3_dp, fluid)
          iterations = 0
          do step_number = 1, 20
            call fluid%step(fluid%time_step(1e-3_dp), 0._dp, dp_closed)
            iterations = max(iterations, fluid%equation%iterations)
          end do
          call valve%surface%get_info(info)
          ideal = dp_closed * valve%eps / R * info%area
          print '(i7, f7.2, f9.3, es8.0, f12.2, f9.2, f8.2, i12)', sizes(k), cells_of_eps(i), valve%eps * 1000, R, &
            -1e6_dp * fluid%flow_out(), 1e6_dp * ideal, -fluid%flow_out() / ideal, iterations
          call finish_root(fluid, valve)
        end do
      end do
    end do
  end subroutine study

  ! In step 3 the law of opening receives a pressure that is not a number. The library must refuse it.
  subroutine feed_nan()
    type(riis_opening_switch) :: law = riis_opening_switch(opening_duration=0.04d0, closing_duration=0.04d0)
    type(riis_opening_switch_state) :: state
    type(flow), target :: fluid
    type(leaflets) :: valve
    integer(riis_status) :: status
    call start_root(fluid, valve, 16, 1.5_dp, 1e4_dp, 0._dp)
    do step_number = 1, 5
      step_time = step_number * 1e-3_dp
      if (step_number == 3) fluid%p = ieee_value(1._dp, ieee_quiet_nan)
      call riis_opening_advance(law, state, step_time, fluid%mean_pressure(-0.014_dp) - fluid%mean_pressure(0.006_dp), &
        fluid%flow_out(), status)
      call check(status)
      call valve%move(state%opening, 1e-3_dp, fluid)
      call fluid%step(1e-3_dp, 0._dp, 1e4_dp)
    end do
  end subroutine feed_nan
end program checks
