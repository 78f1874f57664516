! SPDX-License-Identifier: Apache-2.0
!> Checks moving valves: the force, the displaced volume, and the jet. Each check runs with and without the source in the band,
!! and shows which conditions fail without the source.
module check_moving
  use riis
  use flow_solver, only: dp, flow
  use flow_valve, only: leaflets, check
  use flow_circulation, only: circulation
  use check_tools
  implicit none
  private
  public :: check_equal_pressures, check_beside, check_plates, check_jet, check_box

  real(dp), parameter :: mmHg = 133.322_dp, ml = 1e-6_dp
  character(len=7), parameter :: words(0:1) = ['without', 'with   ']

contains

  !> (g) The trileaflet valve opens in its root within 40 ms between equal pressures. The forces along x and y must vanish,
  !! because the root is symmetric.
  subroutine check_equal_pressures(cells)
    integer, intent(in) :: cells(:)
    type(flow), target :: fluid
    type(leaflets) :: valve
    type(motion) :: seen(0:1, size(cells))
    integer :: i, with
    print '(a)', 'The trileaflet valve opens within 40 ms between equal pressures: largest force over time, and pressure anywhere'
    print '(a)', '  cells  source   steps    Fx, N    Fy, N    Fz, N  after 20 ms  pressure, mmHg'
    do i = 1, size(cells)
      do with = 0, 1
        fluid = flow()
        fluid%tolerance = 1e-6_dp
        fluid%band_source = with == 1
        call start_root(fluid, valve, cells(i), 1.5_dp, 1e4_dp, 0._dp)
        call move_valve(fluid, valve, 1._dp, 0.04_dp, 1e-3_dp, seen(with, i))
        call finish_root(fluid, valve)
        associate (a => seen(with, i))
          print '(i7, 2x, a, i7, 3f9.3, f13.3, f9.0, a, f7.0)', cells(i), words(with), a%steps, a%side, a%along_late, &
            a%p_least / mmHg, ' to', a%p_most / mmHg
        end associate
      end do
    end do
    call demand(all(seen(1, :)%across < 0.1_dp .and. seen(1, :)%along_late < 0.15_dp), &
      'with the source the force across is below 0.1 N, that along below 0.15 N after 20 ms')
    call demand(all(seen(0, :)%across > 0.1_dp .and. seen(0, :)%along_late > 0.15_dp), 'without the source neither holds')
    print '(a)', 'The same: volumes until the opening is 0.25, while the bands of the cusps touch, and until the end'
    print '(a)', '  cells  source    swept, ml  mean of both ends  ratio   swept  in at inlet  out at outlet  net source'
    do i = 1, size(cells)
      do with = 0, 1
        associate (a => seen(with, i))
          print '(i7, 2x, a, f13.3, f19.3, f7.3, f8.3, 2f13.3, f14.3)', cells(i), words(with), a%displaced(2, touching) / ml, &
            a%displaced(1, touching) / ml, share_of(a, touching), a%swept / ml, a%into / ml, a%out / ml, a%source / ml
        end associate
      end do
    end do
    call demand(all(abs([(share_of(seen(1, i), touching), i = 1, size(cells))] - 1) < 0.15_dp), &
      'while bands touch, the valve displaces what it sweeps, within 15 %')
    if (any(cells == 24)) call demand(abs(share_of(seen(0, 1), touching) - 1) > 0.15_dp, &
      'without the source it does not, with 24 cells')
    print '(a)', 'The same, over the opening, with the source and the most cells'
    print '(a)', '  opening  swept, ml  mean of both ends  ratio'
    do i = 1, size(openings)
      associate (a => seen(1, size(cells)))
        print '(f9.2, f11.3, f19.3, f7.3)', openings(i), a%displaced(2, i) / ml, a%displaced(1, i) / ml, share_of(a, i)
      end associate
    end do
    print '(a)', ''
  end subroutine check_equal_pressures

  ! Returns the ratio of the displaced volume to the swept volume, up to an opening.
  pure real(dp) function share_of(seen, at)
    type(motion), intent(in) :: seen
    integer, intent(in) :: at                     ! index in `openings`
    share_of = seen%displaced(1, at) / seen%displaced(2, at)
  end function share_of

  !> (g) Repeats the check with other settings. A row's name tells how it differs from the default: the trileaflet valve opens
  !! within 40 ms in 24 cells.
  subroutine check_beside(rows)
    integer, intent(in) :: rows(:)                ! indices of the rows to run, in the list of names
    character(len=36), parameter :: names(9) = [character(len=36) :: 'it closes', 'steps of 0.25 ms', 'steps of 0.1 ms', &
      'within 20 ms', 'turned by 17 degrees about its axis', 'shifted by 0.4, 0.3 and 0.2 cells', &
      'tilted by 20 degrees, with its root', 'bileaflet, turned, shifted', 'mitral, in an oval tube']
    real(dp), parameter :: h = 0.033_dp / 24
    type(flow), target :: fluid
    type(leaflets) :: valve
    type(motion) :: seen(0:1, size(names))
    real(dp) :: duration, first, longest
    integer :: i, k, n(3), with
    print '(a)', 'Variants of the default, 24 cells: largest force in N across the axis, of steps and of 1 ms means; along it'
    print '(a)', repeat(' ', 40) // 'across     mean across           along           pressure, mmHg'
    print '(a)', '  case                                  without   with' // repeat('  without   with', 2) // &
      '           without              with'
    do k = 1, size(rows)
      i = rows(k)
      do with = 0, 1
        fluid = flow()
        fluid%tolerance = 1e-6_dp
        fluid%band_source = with == 1
        valve = leaflets()
        duration = 0.04_dp
        longest = 1e-3_dp
        first = 0
        n = [24, 24, 29]
        select case (i)
        case (1)
          first = 1
        case (2)
          longest = 0.25e-3_dp
        case (3)
          longest = 0.1e-3_dp
        case (4)
          duration = 0.02_dp
        case (5)
          valve%turn = 17
        case (6)
          valve%place = [0.4_dp, 0.3_dp, 0.2_dp] * h
          n = [26, 26, 29]
        case (7)
          valve%turn = 20
          valve%turn_axis = [1, 2, 0]
          n = [36, 36, 32]
        case (8)
          valve%kind = 'bileaflet'
          valve%turn = 17
          valve%place = [0.4_dp, 0.3_dp, 0.2_dp] * h
          n = [26, 26, 29]
        case (9)
          valve%kind = 'mitral'
          n = [30, 28, 40]
        end select
        call place_vessel(valve%kind, valve%place, valve%turn_axis, valve%turn)
        call fluid%start(n, h, -[n(1), n(2), merge(30, 26, i == 9)] * h / 2, in_vessel)
        valve%eps = 1.5_dp * h
        call valve%valve%create(valve%kind)
        call valve%start(fluid, first)
        call move_valve(fluid, valve, 1 - first, duration, longest, seen(with, i))
        call finish_root(fluid, valve)
      end do
      print '(2x, a, 3(f9.3, f7.3), 2(f8.0, a, f6.0))', names(i), seen(:, i)%across, seen(:, i)%across_mean, seen(:, i)%along, &
        seen(0, i)%p_least / mmHg, ' to', seen(0, i)%p_most / mmHg, seen(1, i)%p_least / mmHg, ' to', seen(1, i)%p_most / mmHg
    end do
    print '(a)', ''
    associate (symmetric => pack(rows, rows < 9))
      call demand(all(seen(1, symmetric)%across_mean < 0.1_dp) .and. all(seen(1, symmetric)%across < 0.25_dp), &
        'with the source no mean across is above 0.1 N, and no step above 0.25 N, but for the mitral valve')
      call demand(all(seen(0, symmetric)%across_mean > 0.2_dp), 'without the source each mean across is above 0.2 N')
    end associate
    if (any(rows == 9)) call demand(seen(1, 9)%across < 0.5_dp .and. seen(0, 9)%across > 5, &
      'the mitral valve, which is not symmetric, has less than 0.5 N across with the source, more than 5 N without')
  end subroutine check_beside

  !> (h) A plate closes a duct and moves. The mean volume of both ends must be area times stroke. The plate moves straight, or it
  !! also slides along x, or it is tilted. In the last two cases its velocity points through the walls.
  subroutine check_plates()
    integer, parameter :: n = 12
    real(dp), parameter :: h = 1e-3_dp, R = 1e4_dp, eps = 1.5_dp * h, w = 0.1_dp, dt = 1e-3_dp
    real(dp), parameter :: slope(3) = [0._dp, 0._dp, 0.3_dp], slide(3) = [0._dp, 0.05_dp, 0._dp]
    character(len=8), parameter :: names(3) = ['straight', 'slides  ', 'tilted  ']
    type(flow) :: fluid
    real(dp) :: ratio(0:1, 3), pressure(0:1, 3), stroke, volume
    integer :: i, k, with
    print '(a)', 'A plate closes a duct of 12 by 12 cells and moves up at 0.1 m/s for 0.1 s, between equal pressures: mean volume'
    print '(a)', 'of both ends over area times stroke, and the largest pressure at the end'
    print '(a)', '  plate     without    with  without, Pa  with, Pa'
    do k = 1, 3
      do with = 0, 1
        fluid = flow()
        fluid%band_source = with == 1
        call make_duct(fluid, [n, n, 3 * n], h, .false.)
        volume = 0
        do i = 1, 100
          stroke = i * dt * w
          call put_plate(fluid, n * h + stroke, R, eps, w, slope(k), slide(k))
          call fluid%step(dt, 0._dp, 0._dp)
          volume = volume + dt * fluid%flow_through()
        end do
        ratio(with, k) = volume / ((n * h)**2 * stroke)
        pressure(with, k) = maxval(abs(fluid%p(fluid%cell)))
        call fluid%equation%finish()
      end do
      print '(2x, a, 2f9.4, f12.0, f10.0)', names(k), ratio(:, k), pressure(:, k)
    end do
    call demand(all(abs(ratio(1, :) - 1) < 0.01_dp) .and. all(pressure(1, :) < 200), &
      'with the source each volume is right within 1 %, and no pressure is above 200 Pa')
    call demand(abs(ratio(0, 3) - 1) > 0.01_dp .and. all(pressure(0, 2:) > 1e4_dp), &
      'without the source the tilted plate misses the volume, and pressures are above 10 kPa where walls are in the way')
  end subroutine check_plates

  !> (i) While the valve opens in a heartbeat, the speed of the jet is bounded by the largest pressure difference so far.
  subroutine check_jet(cells)
    integer, intent(in) :: cells(:)
    type(flow), target :: fluid
    type(leaflets) :: valve
    type(circulation) :: heart
    type(riis_opening_switch), parameter :: law = riis_opening_switch(opening_duration=0.04d0, closing_duration=0.04d0, &
      filter_time=0.002d0, dwell_time=0.05d0)
    type(riis_opening_switch_state) :: state
    real(dp) :: dt, difference, flow_rate, force(3), fastest, jet, most, time
    real(dp) :: ratio(0:1, size(cells)), up(0:1, size(cells))
    integer :: i, with
    print '(a)', 'In a heartbeat, while the valve opens: the jet over sqrt(2 dp/rho), the largest of all steps, where dp is the'
    print '(a)', 'largest pressure difference since the opening began; and the largest force downstream'
    print '(a)', '  cells  source   opened at, s  dp, mmHg  jet, m/s  jet over sqrt(2 dp/rho)  Fz, N'
    do i = 1, size(cells)
      do with = 0, 1
        fluid = flow()
        fluid%tolerance = 1e-6_dp
        fluid%band_source = with == 1
        valve = leaflets()
        heart = circulation()
        state = riis_opening_switch_state()
        call start_root(fluid, valve, cells(i), 1.5_dp, 1e4_dp, 0._dp)
        time = 0
        difference = 0
        flow_rate = 0
        most = 0
        fastest = 0
        ratio(with, i) = 0
        up(with, i) = 0
        do while (state%opening < 1 .and. time < 0.3_dp)
          dt = fluid%time_step(1e-3_dp)
          time = time + dt
          call riis_opening_advance(law, state, time, difference, flow_rate)
          call valve%move(state%opening, dt, fluid)
          call fluid%step(dt, heart%p_ventricle(time), heart%p_aorta(flow_rate))
          flow_rate = fluid%flow_through()
          call heart%advance(time, dt, flow_rate)
          difference = fluid%mean_pressure(-0.014_dp) - fluid%mean_pressure(0.006_dp)
          if (.not. state%opening > 0) cycle
          most = max(most, difference)
          jet = maxval(fluid%v(fluid%cell, 3))
          fastest = max(fastest, jet)
          ratio(with, i) = max(ratio(with, i), jet / sqrt(2 * most / fluid%rho))
          force = valve%force(fluid)
          up(with, i) = max(up(with, i), force(3))
        end do
        print '(i7, 2x, a, f14.4, f10.2, f10.2, f25.3, f7.2)', cells(i), words(with), time, most / mmHg, fastest, &
          ratio(with, i), up(with, i)
        call finish_root(fluid, valve)
      end do
    end do
    call demand(all(ratio(1, :) < 1.05_dp), 'with the source the jet is at most 1.05 sqrt(2 dp/rho)')
    call demand(all(ratio(0, :) > 1.05_dp), 'without the source it is more')
  end subroutine check_jet

  !> (j) Between closed ends the sum of all sources must be 0. The trileaflet valve opens in the middle of a wide box, where the
  !! walls at the ends have little effect. The valve also opens in its closed root, from an opening of 0.5.
  subroutine check_box(first)
    integer, intent(in) :: first                  ! the first row to run; rows 5 and 6 are the root
    character(len=17), parameter :: names(6) = [character(len=17) :: 'box, open, net', 'box, open', 'box, closed', &
      'box, closed', 'root, closed', 'root, closed']
    integer, parameter :: with(6) = [1, 1, 1, 0, 1, 0]
    type(flow), target :: fluid
    type(leaflets) :: valve
    type(motion) :: seen(6)
    real(dp) :: apart(6), apart_late(6), difference(160)
    integer :: i, step
    print '(a)', 'The trileaflet valve opens in a wide box and in its root, steps of 0.25 ms. Net is the largest sum of sources,'
    print '(a)', 'apart the largest difference of the force from that in the second row, of all steps and of the second half'
    print '(a)', '  vessel, ends     source      net, ml/s  of, ml/s  divergence, 1/s  across, N  along, N' // &
      '  apart, N   late, N  pressure, mmHg'
    do i = first, 6
      fluid = flow()
      fluid%band_source = with(i) == 1
      fluid%net_source = i == 1
      fluid%closed_ends = i > 2
      valve = leaflets()
      if (i < 5) then
        call fluid%start([32, 32, 32], 1.65e-3_dp, -16 * [1, 1, 1] * 1.65e-3_dp, anywhere)
        valve%eps = 1.5_dp * fluid%h
        call valve%valve%create(valve%kind)
        call valve%start(fluid, 0._dp)
      else
        call start_root(fluid, valve, 24, 1.5_dp, 1e4_dp, 0.5_dp)
      end if
      call move_valve(fluid, valve, 1._dp, 0.04_dp, 0.25e-3_dp, seen(i))
      call finish_root(fluid, valve)
      apart(i) = 0
      apart_late(i) = 0
      if (i == 3) then
        difference = [(norm2(seen(i)%force(:, step) - seen(2)%force(:, step)), step = 1, 160)]
        apart(i) = maxval(difference)
        apart_late(i) = maxval(difference(81:))
      end if
      associate (a => seen(i))
        print '(2x, a, a, es11.1, f10.1, es17.1, f11.3, 3f10.3, f8.0, a, f5.0)', names(i), words(with(i)), a%net / ml, &
          a%gross / ml, a%divergence, a%across, a%along, apart(i), apart_late(i), a%p_least / mmHg, ' to', a%p_most / mmHg
      end associate
    end do
    call demand(all(seen([2, 3, 5])%net <= 1e-12_dp * seen([2, 3, 5])%gross) .and. seen(5)%gross > 0 .and. &
      all(seen%divergence < 1e-4_dp), &
      'without a net source the sources add up to 0, and the pressure equation is solved')
    if (first == 1) call demand(seen(3)%steps == 160 .and. apart(3) < 0.1_dp .and. apart_late(3) < 0.03_dp, &
      'walls at the ends of the box change the force by less than 0.1 N, and by 0.03 N in the second half')
    call demand(seen(5)%along < 0.3_dp .and. seen(6)%along > 1, &
      'in the closed root the force is below 0.3 N; without the source it is above 1 N')
    if (first == 1) call demand(seen(4)%p_least < 10 * seen(3)%p_least, &
      'in the box pressures are ten times as large without it')
  end subroutine check_box
end module check_moving
