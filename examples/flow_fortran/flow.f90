! SPDX-License-Identifier: Apache-2.0
!> A heartbeat of the aortic valve in its root. Options are words NAME=VALUE, which README.md lists.
program flow_through_valve
  use, intrinsic :: iso_fortran_env, only: int64
  use riis
  use flow_solver, only: dp, flow
  use flow_valve, only: leaflets, check
  use flow_root, only: in_root
  use flow_circulation, only: circulation, mmHg, ml, period
  use flow_files, only: write_frame, write_restart, read_restart
  use flow_stop, only: refuse, step_number, step_time
  implicit none
  real(dp), parameter :: width = 0.033_dp, length = 0.0396_dp, bottom = -0.018_dp ! [m] the box around the root
  real(dp), parameter :: z_up = -0.014_dp, z_down = 0.006_dp, z_jet = 0.0015_dp   ! [m] where pressures and the jet are seen
  type(flow), target :: fluid
  type(leaflets) :: valve
  type(circulation) :: heart
  type(riis_opening_switch) :: law = riis_opening_switch(opening_seconds=0.04d0, closing_seconds=0.04d0, open_above=0d0, &
    close_below=0d0, filter_seconds=0.002d0, dwell_seconds=0.05d0)
  type(riis_opening_switch_state) :: state
  integer :: cells = 40, most_steps = huge(0), frames = 100, restart_step = 0, table, frame, status
  real(dp) :: end_time = period, longest_step = 1e-3_dp, dt, flow_rate, force(3), p_up, p_down, seconds
  logical :: surface_velocity = .true.
  character(len=400) :: out = 'out/flow', restart = '', name
  character(len=4) :: digits
  integer(int64) :: begin, now, rate
  namelist /options/ cells, end_time, most_steps, longest_step, frames, restart, restart_step, out, surface_velocity

  call system_clock(begin, rate)
  call read_options()
  fluid%tolerance = 1e-8_dp
  call fluid%start([cells, cells, nint(cells * length / width)], width / cells, [-width / 2, -width / 2, bottom], in_root)
  valve%eps = 1.5_dp * fluid%h
  valve%moves_flow = surface_velocity
  call valve%valve%create(trim(valve%kind), status)
  call check(status)
  if (restart /= '') call read_restart(trim(restart), fluid, valve, heart, state)
  call valve%start(fluid, valve%opening)
  if (restart == '') then
    fluid%p = 0
    open (newunit=table, file=trim(out) // '/beat.csv', status='replace', action='write')
    write (table, '(a)') 'step,time_s,dt_s,opening,p_ventricle_Pa,p_upstream_Pa,p_downstream_Pa,flow_m3_per_s,jet_m_per_s,' // &
      'force_x_N,force_y_N,force_z_N,divergence_per_s,balance_m3_per_s,iterations,marked'
  else
    open (newunit=table, file=trim(out) // '/beat.csv', status='replace', action='write')
  end if
  frame = 0
  print '(a, i0, a, i0, a, f5.3, a, f5.3, a)', 'cells: ', product(fluid%n), ', in the lumen: ', &
    count(.not. fluid%solid(fluid%cell)), ', a side of ', fluid%h * 1000, ' mm; half thickness ', valve%eps * 1000, ' mm'
  print '(a)', '  step   time s  opening   p up mmHg  p down mmHg  flow ml/s  jet m/s  force N'

  flow_rate = fluid%flow_out()
  p_up = fluid%mean_pressure(z_up)
  p_down = fluid%mean_pressure(z_down)
  do while (step_time < end_time .and. step_number < most_steps)
    dt = fluid%time_step(longest_step)
    step_number = step_number + 1
    step_time = step_time + dt
    ! The law of the opening sees the pressures and the flow of the last step.
    call riis_opening_advance(law, state, step_time, p_up - p_down, flow_rate, status)
    call check(status)
    call valve%move(state%opening, dt, fluid)
    call fluid%step(dt, heart%p_ventricle(step_time), heart%p_aorta(fluid%flow_out()))
    call heart%advance(step_time, dt, fluid%flow_in(), fluid%flow_out())
    call report()
    if (step_number == restart_step) call write_restart(trim(out) // '/restart.bin', fluid, valve, heart, state)
  end do

  call system_clock(now)
  seconds = real(now - begin, dp) / rate
  print '(a, i0, a, f0.1, a, f0.2, a, f0.2, a, i0, a, f0.2, a)', 'steps: ', step_number, ', seconds: ', seconds, &
    ', in the library: ', valve%seconds, ' (', 100 * valve%seconds / seconds, ' %) for ', valve%markings, ' markings, ', &
    1000 * valve%seconds / max(1, valve%markings), ' ms each'
  call valve%finish()
  call fluid%finish()

contains

  subroutine report()
    real(dp) :: jet
    flow_rate = fluid%flow_out()
    p_up = fluid%mean_pressure(z_up)
    p_down = fluid%mean_pressure(z_down)
    force = valve%force(fluid)
    jet = maxval(fluid%v(fluid%cell, 3))
    write (table, '(i0, 13(",", es24.16), 2(",", i0))') step_number, step_time, dt, valve%opening, &
      heart%p_ventricle(step_time), p_up, p_down, flow_rate, jet, force, fluid%divergence(), flow_rate - fluid%flow_in(), &
      fluid%equation%iterations, size(valve%marked)
    if (mod(step_number, 20) == 0) print '(i6, f9.4, f9.3, 2f12.1, f12.1, f9.2, f9.3, i4)', step_number, step_time, valve%opening, &
      p_up / mmHg, p_down / mmHg, flow_rate / ml, jet, force(3), fluid%equation%iterations
    if (frames == 0 .or. step_time < frame * end_time / max(1, frames)) return
    write (digits, '(i4.4)') frame
    frame = frame + 1
    name = trim(out) // '/frames/' // digits // '.bin'
    call write_frame(trim(name), fluid, valve, z_jet)
  end subroutine report

  subroutine read_options()
    character(len=1000) :: words
    character(len=200) :: word, message
    integer :: i, stat
    words = '&options'
    do i = 1, command_argument_count()
      call get_command_argument(i, word)
      words = trim(words) // ' ' // word
    end do
    words = trim(words) // ' /'
    read (words, nml=options, iostat=stat, iomsg=message)
    if (stat /= 0) call refuse('options: ' // trim(message))
    if (cells < 8) call refuse('options: cells must be at least 8')
  end subroutine read_options
end program flow_through_valve
