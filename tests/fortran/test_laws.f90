! SPDX-License-Identifier: Apache-2.0
! Tests laws of opening in module riis. Results equal those of riis_c bit for bit. A restart in the middle of a motion changes
! nothing.
program test_laws
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use box
  use checks
  use riis
  use riis_c, only: c_angle => riis_opening_angle, c_angle_state => riis_opening_angle_state, &
    c_switch => riis_opening_switch, c_switch_state => riis_opening_switch_state, c_table => riis_opening_table, &
    c_times => riis_opening_times, c_from_table => riis_opening_from_table, c_from_times => riis_opening_from_times, &
    riis_opening_angle_advance, riis_opening_angle_init, riis_opening_angle_state_init, riis_opening_switch_advance, &
    riis_opening_switch_init, riis_opening_switch_state_init, riis_opening_table_init, riis_opening_times_init
  implicit none
  integer, parameter :: n_steps = 40, n_before = 9
  real(c_double), parameter :: dt = 0.01d0
  integer(riis_status) :: status

  call test_table()
  call test_times()
  call test_switch()
  call test_angle()
  call test_restart()
  call finish()

contains

  ! Returns whether two numbers have the same bits, or are both NaN, because the sign of Fortran's default NaN is unspecified.
  elemental logical function alike(a, b)
    real(c_double), intent(in) :: a, b
    alike = same(a, b) .or. (ieee_is_nan(a) .and. ieee_is_nan(b))
  end function alike

  subroutine test_table()
    real(c_double), target :: time(4) = [0d0, 0.25d0, 0.5d0, 1d0], opening(4) = [0d0, 1d0, 0.75d0, 0d0]
    real(c_double) :: pairs(2, 4), from_c(2), got, rate
    type(c_table) :: table
    integer :: i, interpolation
    pairs(1, :) = time
    pairs(2, :) = opening
    call check_ok(riis_opening_table_init(table, c_sizeof(table)), 'a table from riis_c')
    table%n_keys = 4
    table%time = c_loc(time)
    table%opening = c_loc(opening)
    table%period = 1
    do interpolation = RIIS_INTERPOLATION_LINEAR, RIIS_INTERPOLATION_CUBIC
      table%interpolation = interpolation
      do i = -30, 30
        call check_ok(c_from_table(table, 0.07d0 * i, from_c(1), from_c(2)), 'an opening from riis_c')
        call riis_opening_from_table(time, opening, 0.07d0 * i, got, rate, period=1d0, interpolation=interpolation)
        call check(all(same([got, rate], from_c)), 'an opening by keys')
        call riis_opening_from_table(pairs(1, :), pairs(2, :), 0.07d0 * i, got, period=1d0, &
          interpolation=int(interpolation, int64))
        call check(same(got, from_c(1)), 'by keys that do not lie side by side')
      end do
    end do
    call riis_opening_from_table(time, opening, 0.375d0, got)
    call check(same(got, 0.875d0), 'linear by default')
    call riis_opening_from_table(time(:3), opening(:3), 7d0, got, rate)
    call check(same(got, 0.75d0) .and. same(rate, 0d0), 'the last key counts behind it')

    got = 7
    call riis_opening_from_table(time, opening(:3), 0d0, got, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of key_opening is 3; there are 4 times of keys')
    call riis_opening_from_table(time(:0), opening(:0), 0d0, got, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'table.n_keys is 0')
    call riis_opening_from_table(time([1, 3, 2, 4]), opening, 0d0, got, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'table.time of key 2 is 0.25; it must be above')
    call riis_opening_from_table(time, opening + [0d0, 0.5d0, 0d0, 0d0], 0d0, got, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'table.opening of key 1 is 1.5')
    call riis_opening_from_table(time, opening, 0d0, got, period=0.5d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'table.time of key 3 is 1, beyond the period of 0.5')
    call riis_opening_from_table(time, opening, 0d0, got, interpolation=2, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'table.interpolation is 2')
    call riis_opening_from_table(time, opening, 0d0, got, interpolation='cubic', status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'interpolation is neither')
    call riis_opening_from_table(time, opening, ieee_value(1d0, ieee_quiet_nan), got, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'time is nan')
    call check(same(got, 7d0), 'a refused call writes nothing')
  end subroutine test_table

  subroutine test_times()
    type(riis_opening_times) :: law
    type(c_times) :: of_c
    real(c_double) :: opening, rate, from_c(2)
    integer :: i
    call check_ok(riis_opening_times_init(of_c, c_sizeof(of_c)), 'times from riis_c')
    call check(all(alike([law%opening_start, law%opening_duration, law%closing_start, law%closing_duration, law%closed, &
      law%open, law%period], [of_c%opening_start, of_c%opening_duration, of_c%closing_start, of_c%closing_duration, &
      of_c%closed, of_c%open, of_c%period])), 'the defaults of times')
    opening = 7
    call riis_opening_from_times(law, 0d0, opening, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'times.opening_start is nan')
    law = riis_opening_times(0.45d0, 0.05d0, closing_start=0.9d0, closing_duration=0.08d0)
    of_c%opening_start = 0.45d0
    of_c%opening_duration = 0.05d0
    of_c%closing_start = 0.9d0
    of_c%closing_duration = 0.08d0
    do i = 1, 2
      if (i == 2) law = riis_opening_times(0.45d0, 0.05d0, 0.9d0, 0.08d0, 0.1d0, 0.8d0, 1d0)
      call check_ok(c_from_times(of_c, 0.97d0, from_c(1), from_c(2)), 'an opening from riis_c')
      call riis_opening_from_times(law, 0.97d0, opening, rate)
      call check(all(same([opening, rate], from_c)) .and. rate < -0.1d0, 'an opening by times')
      of_c%closed = 0.1d0
      of_c%open = 0.8d0
      of_c%period = 1
    end do
    call riis_opening_from_times(law, 3.7d0, opening)
    call check(same(opening, 0.8d0), 'open in another period')
    law%closing_start = 0.47d0
    call riis_opening_from_times(law, 0d0, opening, rate, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'times.closing_start is 0.47')
    call check(same(opening, 0.8d0), 'a refused call writes nothing')
  end subroutine test_times

  subroutine test_switch()
    type(riis_opening_switch) :: law
    type(riis_opening_switch_state) :: state
    type(c_switch) :: of_c
    type(c_switch_state) :: now, before
    real(c_double) :: time
    integer :: i
    call check_ok(riis_opening_switch_init(of_c, c_sizeof(of_c)), 'a switch from riis_c')
    call check_ok(riis_opening_switch_state_init(now, c_sizeof(now)), 'its state')
    call check(all(alike([law%opening_duration, law%closing_duration, law%open_above, law%close_below, law%filter_time, &
      law%dwell_time], [of_c%opening_duration, of_c%closing_duration, of_c%open_above, of_c%close_below, &
      of_c%filter_time, of_c%dwell_time])), 'the defaults of a switch')
    call check(is_same_switch(state, now), 'it begins closed')
    call riis_opening_advance(law, state, 1d0, 0d0, 0d0, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'law.opening_duration is nan')
    law = riis_opening_switch(0.04d0, 0.08d0, open_above=0.5d0, close_below=-0.25d0, filter_time=0.003d0, &
      dwell_time=0.02d0)
    of_c%opening_duration = 0.04d0
    of_c%closing_duration = 0.08d0
    of_c%open_above = 0.5d0
    of_c%close_below = -0.25d0
    of_c%filter_time = 0.003d0
    of_c%dwell_time = 0.02d0
    do i = 1, 300
      time = 0.003d0 * i
      before = now
      call check_ok(riis_opening_switch_advance(of_c, before, time, sin(20 * time), cos(21 * time), now), 'a step of riis_c')
      call riis_opening_advance(law, state, time, sin(20 * time), cos(21 * time))
      if (.not. is_same_switch(state, now)) exit
    end do
    call check(i > 300, 'a switch goes on as that of riis_c')

    now%time = state%time
    call riis_opening_advance(law, state, 0.1d0, 0d0, 0d0, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'time is 0.1; it must be from 0.9')
    call riis_opening_advance(law, state, 1d0, ieee_value(1d0, ieee_quiet_nan), 0d0, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'pressure_difference is nan')
    state%phase = 5
    call riis_opening_advance(law, state, 1d0, 0d0, 0d0, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'before.phase is 5')
    state%phase = now%phase
    law%dwell_time = -1
    call riis_opening_advance(law, state, 1d0, 0d0, 0d0, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'law.dwell_time is -1')
    call check(is_same_switch(state, now), 'a refused call writes nothing')
  end subroutine test_switch

  logical function is_same_switch(state, of_c)
    type(riis_opening_switch_state), intent(in) :: state
    type(c_switch_state), intent(in) :: of_c
    is_same_switch = state%phase == of_c%phase .and. all(alike([state%time, state%opening, state%rate, state%progress, &
      state%pressure_difference, state%flow, state%turn_time], [of_c%time, of_c%opening, of_c%rate, of_c%progress, &
      of_c%pressure_difference, of_c%flow, of_c%turn_time]))
  end function is_same_switch

  subroutine test_angle()
    type(riis_opening_angle) :: law
    type(riis_opening_angle_state) :: state
    type(c_angle) :: of_c
    type(c_angle_state) :: now, before
    real(c_double) :: time
    integer :: i
    call check_ok(riis_opening_angle_init(of_c, c_sizeof(of_c)), 'an angle law from riis_c')
    call check_ok(riis_opening_angle_state_init(now, c_sizeof(now)), 'its state')
    call check(all(alike([law%pressure_gain, law%flow_gain, law%friction, law%vortex_gain, law%angle_min, &
      law%angle_max], [of_c%pressure_gain, of_c%flow_gain, of_c%friction, of_c%vortex_gain, of_c%angle_min, &
      of_c%angle_max])), 'the defaults of an angle law')
    call check(is_same_angle(state, now), 'it begins at rest')
    call riis_opening_advance(law, state, 1d0, 0d0, 0d0, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'law.pressure_gain is nan')
    law = riis_opening_angle(5500d0, 2d0, 50d0, 7d0, angle_min=5d0, angle_max=70d0)
    of_c%pressure_gain = 5500
    of_c%flow_gain = 2
    of_c%friction = 50
    of_c%vortex_gain = 7
    of_c%angle_min = 5
    of_c%angle_max = 70
    state%angle = 6
    now%angle = 6
    do i = 1, 300
      time = 0.003d0 * i
      before = now
      call check_ok(riis_opening_angle_advance(of_c, before, time, sin(20 * time), 30 * cos(21 * time), now), &
        'a step of riis_c')
      call riis_opening_advance(law, state, time, sin(20 * time), 30 * cos(21 * time))
      if (.not. is_same_angle(state, now)) exit
    end do
    call check(i > 300, 'an angle goes on as that of riis_c')

    call riis_opening_advance(law, state, 1d0, 0d0, ieee_value(1d0, ieee_quiet_nan), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'flow is nan')
    call riis_opening_advance(law, state, 1d6, 1d0, 0d0, status)
    call check_refused(status, RIIS_LIMIT_EXCEEDED, 'time is 999999.1 after before.time')
    law%angle_max = 4
    call riis_opening_advance(law, state, 1d0, 0d0, 0d0, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'law.angle_max is 4')
    call check(is_same_angle(state, now), 'a refused call writes nothing')
  end subroutine test_angle

  logical function is_same_angle(state, of_c)
    type(riis_opening_angle_state), intent(in) :: state
    type(c_angle_state), intent(in) :: of_c
    is_same_angle = all(alike([state%time, state%opening, state%rate, state%angle, state%angle_rate, &
      state%pressure_difference, state%flow], [of_c%time, of_c%opening, of_c%rate, of_c%angle, of_c%angle_rate, &
      of_c%pressure_difference, of_c%flow]))
  end function is_same_angle

  ! An aortic and a mitral valve follow laws. A restart file holds only the states of the laws. From the restart to the end of the
  ! cycle, K and K u_surface must have the bits of a run without the restart.
  subroutine test_restart()
    type(riis_opening_switch_state) :: aortic
    type(riis_opening_angle_state) :: mitral
    type(riis_mesh) :: mesh
    real(c_double), allocatable :: whole(:, :, :), restarted(:, :, :)
    integer :: unit, i
    call make_box()
    call mesh%create(xyz)
    allocate (whole(4, n_nodes, n_steps), restarted(4, n_nodes, n_steps))
    whole = 0
    restarted = 0
    call run(mesh, aortic, mitral, 1, n_steps, whole)

    aortic = riis_opening_switch_state()
    mitral = riis_opening_angle_state()
    call run(mesh, aortic, mitral, 1, n_before, restarted)
    call check(aortic%opening > 0.1d0 .and. aortic%opening < 0.9d0 .and. mitral%opening > 0.1d0 .and. &
      mitral%opening < 0.9d0, 'both valves are in the middle of their motion')
    open (newunit=unit, status='scratch', form='unformatted')
    write (unit) aortic, mitral
    rewind (unit)
    aortic = riis_opening_switch_state()
    mitral = riis_opening_angle_state()
    read (unit) aortic, mitral
    close (unit)
    call run(mesh, aortic, mitral, n_before + 1, n_steps, restarted)

    do i = 1, n_steps
      call check(all(same(whole(:, :, i), restarted(:, :, i))) .and. maxval(whole(1, :, i)) > 1d5, &
        'the same resistance after a restart')
    end do
    call check(maxval(abs(whole(2:, :, n_before + 1))) > 1d5, 'of what moves')
    call mesh%destroy()
    call free_box()
  end subroutine test_restart

  ! Runs the steps from `first` to `last`, starting from the state before.
  subroutine run(mesh, aortic, mitral, first, last, fields)
    type(riis_mesh), intent(in) :: mesh
    type(riis_opening_switch_state), intent(inout) :: aortic
    type(riis_opening_angle_state), intent(inout) :: mitral
    integer, intent(in) :: first, last
    real(c_double), intent(inout) :: fields(:, :, :)
    type(riis_opening_switch), parameter :: by_switch = riis_opening_switch(0.1d0, 0.1d0, filter_time=0.005d0)
    type(riis_opening_angle), parameter :: by_angle = riis_opening_angle(5500d0, 2d0, 50d0, 3.5d0)
    type(riis_valve) :: now(2), before(2), open
    type(riis_surface) :: surfaces(2)
    type(riis_marks) :: result
    real(c_double) :: wave, time
    integer :: i, j
    call now(1)%create('aortic')
    call open%create('aortic')
    call open%set('leaflet_angle', 40d0)
    call now(1)%set_open_state(open)
    call open%destroy()
    call now(2)%create('mitral')
    do j = 1, 2
      call now(j)%set('opening', merge(aortic%opening, mitral%opening, j == 1))
      call now(j)%copy(before(j))
      call surfaces(j)%create(now(j), half_thickness=0.2d0, translation=[0d0, 0d0, 1.5d0 - j])
    end do
    do i = first, last
      time = i * dt
      wave = sin(16 * time)
      call riis_opening_advance(by_switch, aortic, time, 5 * wave, 300 * sin(16 * time - 0.3d0))
      call riis_opening_advance(by_angle, mitral, time, 0.1d0 * wave, 20 * wave)
      do j = 1, 2
        call now(j)%set('opening', merge(aortic%opening, mitral%opening, j == 1))
        call surfaces(j)%update_moving(now(j), before(j), dt)
        call before(j)%set('opening', merge(aortic%opening, mitral%opening, j == 1))
        call riis_mark_nodes(surfaces(j), mesh, result, fields=RIIS_FIELD_VELOCITY)
        call result%add_resistance(1d4, fields(1, :, i), fields(2:, :, i))
      end do
    end do
    call result%destroy()
    do j = 1, 2
      call surfaces(j)%destroy()
      call before(j)%destroy()
      call now(j)%destroy()
    end do
  end subroutine run
end program test_laws
