! SPDX-License-Identifier: Apache-2.0
!> Computes the steady flow through a valve that stands still, and its pressure drop. The flow rate is given at the inlet. The
!! options are words of the form NAME=VALUE. README.md lists them. The last two lines of output have the names and the values of
!! the results.
program drop_of_valve
  use riis
  use flow_solver, only: dp, flow
  use flow_valve, only: leaflets, check
  use flow_root, only: in_root, fit_root
  use flow_circulation, only: mmHg, ml
  use flow_files, only: option_words
  use flow_stop, only: clocks, refuse, step_number, step_time
  implicit none
  real(dp), parameter :: width = 0.036_dp, length = 0.044_dp, bottom = -0.018_dp ! [m] the box around the root
  type(flow), target :: fluid
  type(leaflets) :: valve
  type(riis_orifice) :: orifice
  real(dp), allocatable :: pressure(:)            ! [Pa] mean of each layer of cells and of a window of time
  real(dp) :: speed, window, jet, drop, before, begin(2), seconds(2)
  integer :: n_windows, status
  logical :: has_settled
  ! The options. Lengths are in m, and the flow rate is in ml/s.
  integer :: cells = 36, most_windows = 8
  real(dp) :: opening = 1, flow_rate = 250, eps = 1e-3_dp, offset = 0, skirt = 2e-3_dp, resistance = 1e3_dp, settled = 0.01_dp
  logical :: cut_rim = .true.
  character(len=32) :: kind = 'trileaflet'
  namelist /options/ cells, most_windows, opening, flow_rate, eps, offset, skirt, resistance, settled, cut_rim, kind

  begin = clocks()
  call read_options()
  call valve%valve%create(trim(kind), status)
  if (status == RIIS_OK) call valve%valve%set('skirt_length', 100 * skirt, status)
  call check(status)
  valve%kind = kind
  valve%R = resistance
  valve%eps = eps
  valve%offset = offset
  if (cut_rim) valve%rim = RIIS_RIM_CUT
  call fit_root(valve%valve, trim(kind), valve%place(3))
  fluid%tolerance = 1e-4_dp
  fluid%imposed_inlet = .true.
  call fluid%start([cells, cells, nint(cells * length / width)], width / cells, [-width / 2, -width / 2, bottom], in_root)
  call valve%start(fluid, opening)
  call measure_orifice()
  call valve%move(opening, 1._dp, fluid)

  speed = flow_rate * ml / (size(fluid%inlet) * fluid%h**2)
  window = length / (flow_rate * ml / orifice%area) ! the jet passes the box once
  allocate (pressure(fluid%n(3)))
  before = 0
  do n_windows = 1, most_windows
    call advance(window)
    has_settled = n_windows > 2 .and. abs(drop - before) < settled * abs(drop)
    print '(i0, a, f0.3, a, f0.3, a)', step_number, ' steps, ', step_time, ' s: drop ', drop / mmHg, ' mmHg'
    if (has_settled .or. n_windows == most_windows) exit
    before = drop
  end do
  seconds = clocks() - begin
  print '(2a)', 'kind,opening,flow_ml_s,cells,h_mm,eps_mm,offset,area_cm2,effective_cm2,rim_reach,wall_cm2,drop_mmHg,', &
    'lasting_mmHg,jet_m_s,apart_percent,windows,steps,seconds'
  print '(a, 14(",", g0), 2(",", i0), ",", f0.1)', trim(kind), opening, flow_rate, cells, 1e3_dp * fluid%h, 1e3_dp * eps, &
    offset, 1e4_dp * orifice%area, 1e4_dp * orifice%effective_area, orifice%rim_reach, 1e4_dp * size(fluid%outlet) * fluid%h**2, &
    drop / mmHg, lasting() / mmHg, jet, 100 * abs(drop - before) / drop, n_windows, step_number, seconds(2)
  call valve%finish()
  call fluid%equation%finish()

contains

  ! Computes the flow for a window of time, and its means. The drop is the difference between the pressure of blood at rest before
  ! the valve and the lowest mean pressure of a layer of cells. The layer with the lowest pressure is in the jet.
  subroutine advance(window)
    real(dp), intent(in) :: window
    real(dp) :: dt, span
    integer :: k
    pressure = 0
    jet = 0
    span = 0
    do while (span < window)
      dt = fluid%time_step(1e-3_dp)
      step_number = step_number + 1
      step_time = step_time + dt
      span = span + dt
      call fluid%step(dt, speed, 0._dp)
      pressure = pressure + dt * [(fluid%mean_pressure(bottom + (k - 0.5_dp) * fluid%h), k = 1, fluid%n(3))]
      jet = jet + dt * maxval(fluid%v(fluid%cell, 3))
    end do
    pressure = pressure / span
    jet = jet / span
    drop = lasting() - minval(pressure)
  end subroutine advance

  ! Returns the drop from rest before the valve to the outlet, where the pressure is 0. Behind the valve the jet regains a part of
  ! its pressure, and this drop does not include that part.
  real(dp) function lasting()
    lasting = pressure(1) + fluid%rho / 2 * speed**2
  end function lasting

  ! Measures the orifice with the triangles of `riis states`.
  subroutine measure_orifice()
    type(riis_surface) :: surface
    call surface%create(valve%valve, half_thickness=eps, scale=0.01_dp, tolerance=0.01_dp, offset=offset, status=status)
    if (status == RIIS_OK) call riis_get_orifice(surface, orifice, rim=valve%rim, status=status)
    call check(status)
    call surface%destroy()
  end subroutine measure_orifice

  subroutine read_options()
    character(len=2000) :: words
    character(len=400) :: message
    words = option_words()
    read (words, nml=options, iostat=status, iomsg=message)
    if (status /= 0) call refuse('options: ' // trim(message))
    if (cells < 8) call refuse('options: cells must be at least 8')
    if (.not. flow_rate > 0 .or. .not. settled > 0 .or. most_windows < 3) &
      call refuse('options: flow_rate and settled must be positive, most_windows must be at least 3')
    if (all(kind /= ['aortic    ', 'trileaflet', 'coapting  '])) &
      call refuse('options: kind must be ''aortic'', ''trileaflet'' or ''coapting'', not ''' // trim(kind) // '''')
  end subroutine read_options
end program drop_of_valve
