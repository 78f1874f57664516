! SPDX-License-Identifier: Apache-2.0
!> Computes a heartbeat of the aortic valve in its root. The options are words of the form NAME=VALUE. README.md lists them.
program flow_through_valve
  use, intrinsic :: iso_fortran_env, only: output_unit
  use riis
  use flow_solver, only: dp, flow
  use flow_valve, only: leaflets, check
  use flow_root, only: in_root
  use flow_circulation, only: circulation, mmHg, ml, period
  use flow_files, only: option_words, open_table, write_frame, write_restart, read_restart
  use flow_stop, only: clocks, refuse, step_number, step_time
  implicit none
  real(dp), parameter :: width = 0.033_dp, length = 0.0396_dp, bottom = -0.018_dp ! [m] the box around the root
  real(dp), parameter :: z_up = -0.014_dp, z_down = 0.006_dp, z_jet = 0.0015_dp   ! [m] heights of the pressures and the jet
  type(flow), target :: fluid
  type(leaflets) :: valve
  type(circulation) :: heart
  type(riis_opening_switch) :: law = riis_opening_switch(opening_duration=0.04d0, closing_duration=0.04d0, &
    filter_time=0.002d0, dwell_time=0.05d0) ! opens by the pressure difference, closes as the flow reverses
  type(riis_opening_switch_state) :: state
  integer :: table, frame, status
  real(dp) :: dt, flow_rate, p_up, p_down, force(3), jet, begin(2), seconds(2)
  character(len=20) :: number
  ! The options.
  integer :: cells = 40, steps = huge(0), frames = 100, save(2) = 0
  real(dp) :: end_time = period, longest_step = 1e-3_dp, eps_in_cells = 1.5_dp, resistance = 1e4_dp, place(3) = 0
  real(dp) :: offset = 0, skirt = 0
  logical :: surface_velocity = .true., band_source = .true., cut_rim = .false.
  character(len=32) :: kind = 'trileaflet'
  character(len=300) :: out = 'out/flow', restart = ''
  namelist /options/ cells, steps, frames, save, end_time, longest_step, eps_in_cells, resistance, place, offset, skirt, &
    surface_velocity, band_source, cut_rim, kind, out, restart

  begin = clocks()
  call read_options()
  fluid%tolerance = 1e-6_dp
  fluid%band_source = band_source
  call fluid%start([cells, cells, nint(cells * length / width)], width / cells, [-width / 2, -width / 2, bottom], in_root)
  valve%kind = kind
  valve%R = resistance
  valve%eps = eps_in_cells * fluid%h
  valve%place = place
  valve%offset = offset
  if (cut_rim) valve%rim = RIIS_RIM_CUT
  valve%moves_flow = surface_velocity
  call valve%valve%create(trim(kind), status)
  if (status == RIIS_OK .and. abs(skirt) > 0) call valve%valve%set('skirt_length', 100 * skirt, status)
  call check(status)
  if (restart /= '') call read_restart(trim(restart), fluid, valve, heart, state)
  call valve%start(fluid, state%opening)
  call open_table(trim(out) // '/beat.csv', table)
  print '(a, i0, a, i0, 2(a, f5.3), a)', 'cells: ', product(fluid%n), ', in the lumen: ', &
    count(.not. fluid%solid(fluid%cell)), ', side ', 1000 * fluid%h, ' mm, half thickness ', 1000 * valve%eps, ' mm'
  print '(a)', '  step  time, s  opening  pressure up and down, mmHg  flow, ml/s  jet, m/s  force, N'

  frame = floor(step_time / end_time * frames) + merge(1, 0, step_number > 0)
  call look()
  do while (step_time < end_time .and. step_number < steps)
    dt = fluid%time_step(longest_step)
    step_number = step_number + 1
    step_time = step_time + dt
    ! The law of opening uses the pressures and the flow of the previous step. The pressure equation uses the valve's new
    ! position.
    call riis_opening_advance(law, state, step_time, p_up - p_down, flow_rate, status)
    call check(status)
    call valve%move(state%opening, dt, fluid)
    call fluid%step(dt, heart%p_ventricle(step_time), heart%p_aorta(flow_rate))
    call heart%advance(step_time, dt, fluid%flow_through())
    call look()
    call tell()
  end do

  seconds = clocks() - begin
  print '(a, i0, a, i0, a, f0.2, a)', 'steps: ', step_number, '; markings: ', valve%markings, ', ', &
    1e3_dp * valve%seconds(2) / max(1, valve%markings), ' ms of a processor each'
  print '(2(a, f0.1, a, f0.1, a, f0.2))', 'seconds: ', seconds(1), ', in riis ', valve%seconds(1), ', % ', &
    100 * valve%seconds(1) / seconds(1), '; of processors: ', seconds(2), ', in riis ', valve%seconds(2), ', % ', &
    100 * valve%seconds(2) / seconds(2)
  call valve%finish()
  call fluid%equation%finish()

contains

  ! Computes the pressures and the flow that the law of opening and the table need.
  subroutine look()
    flow_rate = fluid%flow_through()
    p_up = fluid%mean_pressure(z_up)
    p_down = fluid%mean_pressure(z_down)
    jet = maxval(fluid%v(fluid%cell, 3))
    force = valve%force(fluid)
  end subroutine look

  subroutine tell()
    write (table, '(i0, 14(",", es24.16), 2(",", i0))') step_number, step_time, dt, valve%opening, &
      heart%p_ventricle(step_time), p_up, p_down, flow_rate, jet, force, &
      fluid%divergence(), fluid%flow_in() + fluid%net_source_rate() - fluid%flow_out(), fluid%net_source_rate(), &
      fluid%equation%iterations, size(valve%marked)
    if (mod(step_number, 20) == 0) then
      print '(i6, f9.4, f9.3, f18.1, f10.1, f12.1, 2f10.2)', step_number, step_time, valve%opening, p_up / mmHg, p_down / mmHg, &
        flow_rate / ml, jet, force(3)
      flush (output_unit)
    end if
    if (step_time * frames >= frame * end_time) then
      write (number, '(i4.4)') frame
      call write_frame(trim(out) // '/frames/' // trim(number) // '.bin', fluid, valve, z_jet)
      frame = frame + 1
    end if
    write (number, '(i0)') step_number
    if (any(step_number == save)) &
      call write_restart(trim(out) // '/restart_' // trim(number) // '.bin', fluid, valve, heart, state)
  end subroutine tell

  subroutine read_options()
    character(len=2000) :: words
    character(len=400) :: message
    integer :: stat
    words = option_words()
    read (words, nml=options, iostat=stat, iomsg=message)
    if (stat /= 0) call refuse('options: ' // trim(message))
    if (cells < 8) call refuse('options: cells must be at least 8')
    if (frames < 0 .or. .not. end_time > 0 .or. .not. longest_step > 0 .or. .not. eps_in_cells > 0) &
      call refuse('options: end_time, longest_step and eps_in_cells must be positive, frames must not be negative')
  end subroutine read_options
end program flow_through_valve
