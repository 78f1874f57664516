! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_laws.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Laws of opening: riis_opening_* of riis.h, as a part of module riis.
!!
!! The same arguments give the same bits, and nothing is kept between calls. Times, pressures and flows have the solver's units.
!! The pressure difference is upstream pressure minus downstream pressure, and flow is positive downstream, so positive values of
!! both open a valve. Laws and states are ordinary variables, which are neither created nor destroyed. A structure constructor
!! makes a law: in riis_opening_switch(opening_duration=0.04d0, closing_duration=0.04d0) the other components have their defaults.
!! A state can be copied by =, for a step that may be repeated. If a restart file contains the state, by an unformatted WRITE or
!! in full precision, the law continues with the same bits.
module riis_laws
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_OK, RIIS_INTERPOLATION_LINEAR, RIIS_PHASE_CLOSING, c_angle => riis_opening_angle, &
    c_angle_state => riis_opening_angle_state, c_switch => riis_opening_switch, &
    c_switch_state => riis_opening_switch_state, c_table => riis_opening_table, c_times => riis_opening_times, &
    c_from_table => riis_opening_from_table, c_from_times => riis_opening_from_times, riis_opening_angle_advance, &
    riis_opening_angle_init, riis_opening_angle_state_init, riis_opening_switch_advance, riis_opening_switch_init, &
    riis_opening_switch_state_init, riis_opening_table_init, riis_opening_times_init
  use riis_support
  implicit none
  private
  public :: riis_opening_times, riis_opening_switch, riis_opening_switch_state, riis_opening_angle, riis_opening_angle_state
  public :: riis_opening_from_table, riis_opening_from_times, riis_opening_advance

  ! NaN stands for a number that has no default, or that is not known yet.
  real(c_double), parameter :: no_value = transfer(int(z'7FF8000000000000', int64), 0._c_double)

  !> An opening that follows from the times of opening and closing. Example: every second, a mitral valve begins to open at 0.45 s
  !! and to close at 0.95 s, and both take 0.05 s. The ramps are of fifth degree: neither the rate nor its derivative jumps.
  type :: riis_opening_times
    real(c_double) :: opening_start = no_value              !< The time at which the valve begins to open. This field and the
                                                            !! next three have the default NaN, which is refused.
    real(c_double) :: opening_duration = no_value           !< How long opening takes, > 0.
    real(c_double) :: closing_start = no_value              !< The time at which the valve begins to close, at least
                                                            !! opening_start + opening_duration.
    real(c_double) :: closing_duration = no_value           !< How long closing takes, > 0.
    real(c_double) :: closed = 0                            !< closed, open: the opening of the closed valve, and the opening of
                                                            !! the open valve, each 0 to 1. Default 0 and 1.
    real(c_double) :: open = 1                              !< closed, open: the opening of the closed valve, and the opening of
                                                            !! the open valve, each 0 to 1. Default 0 and 1.
    real(c_double) :: period = 0                            !< If above 0, the valve opens and closes once in each period. With
                                                            !! 0, the default, the valve opens and closes only once.
  end type riis_opening_times

  !> A valve that opens when the pressure difference exceeds open_above, and closes when the flow falls below close_below.
  !! Example: an aortic valve in SI units has opening_duration 0.04, closing_duration 0.04, open_above 0, close_below 0 (the flow
  !! reverses), filter_time 0.002, dwell_time 0.02.
  type :: riis_opening_switch
    real(c_double) :: opening_duration = no_value           !< The time that the valve takes to open, > 0. Default NaN, which is
                                                            !! refused.
    real(c_double) :: closing_duration = no_value           !< The time that the valve takes to close, > 0. Default NaN, which is
                                                            !! refused.
    real(c_double) :: open_above = 0                        !< The pressure difference above which the valve opens. Default 0.
    real(c_double) :: close_below = 0                       !< The flow below which the valve closes. Default 0.
    real(c_double) :: filter_time = 0                       !< The time constant of the filter that smooths pressure difference
                                                            !! and flow, >= 0. Default 0: no filter.
    real(c_double) :: dwell_time = 0                        !< The shortest time between two changes of phase, >= 0. Default 0.
  end type riis_opening_switch

  !> The state of a switch. At time 0, the state is a closed valve.
  type :: riis_opening_switch_state
    real(c_double) :: time = 0                              !< Of this state.
    real(c_double) :: opening = 0                           !< opening, rate: at that time.
    real(c_double) :: rate = 0                              !< opening, rate: at that time.
    real(c_double) :: progress = 0                          !< The position within the motion from closed (0) to open (1). The
                                                            !! opening is a smooth function of this position.
    real(c_double) :: pressure_difference = no_value        !< Filtered; NaN: none yet.
    real(c_double) :: flow = no_value                       !< Filtered; NaN: none yet.
    real(c_double) :: turn_time = no_value                  !< The time of the last change of phase; NaN: none yet.
    integer(int32) :: phase = RIIS_PHASE_CLOSING            !< RIIS_PHASE_*.
  end type riis_opening_switch_state

  !> The angle law of T. Korakianitis and Y. Shi, Med. Eng. Phys. 28 (2006), with angles in radians, between stops that absorb all
  !! speed:
  !!
  !!     angle'' = -friction angle' + (pressure_gain dp + flow_gain Q) cos(angle) - vortex_gain max(Q, 0) sin(2 angle)
  !!
  !! The opening is the angle's fraction of the range from angle_min to angle_max. The paper's values, for mmHg, ml and s:
  !! pressure_gain 5500, flow_gain 2, friction 50, vortex_gain 7 for the aortic and 3.5 for the mitral valve.
  type :: riis_opening_angle
    real(c_double) :: pressure_gain = no_value              !< K_p in the paper, >= 0. This field and the next three have the
                                                            !! default NaN, which is refused.
    real(c_double) :: flow_gain = no_value                  !< K_q, >= 0.
    real(c_double) :: friction = no_value                   !< K_f, >= 0.
    real(c_double) :: vortex_gain = no_value                !< K_v, >= 0.
    real(c_double) :: angle_min = 0                         !< The angle of the closed valve in degrees, 0 to 90. Default 0.
    real(c_double) :: angle_max = 75                        !< The angle of the open valve in degrees, above angle_min, at most
                                                            !! 90. Default 75.
  end type riis_opening_angle

  !> The state of the angle law. At time 0, the state is a closed valve at rest. The angle 0 in this state means angle_min.
  type :: riis_opening_angle_state
    real(c_double) :: time = 0                              !< Of this state.
    real(c_double) :: opening = 0                           !< opening, rate: at that time.
    real(c_double) :: rate = 0                              !< opening, rate: at that time.
    real(c_double) :: angle = 0                             !< angle, angle_rate: in degrees, and in degrees per unit of time.
    real(c_double) :: angle_rate = 0                        !< angle, angle_rate: in degrees, and in degrees per unit of time.
    real(c_double) :: pressure_difference = no_value        !< At that time; NaN: none yet.
    real(c_double) :: flow = no_value                       !< At that time; NaN: none yet.
  end type riis_opening_angle_state

  !> Gives the opening at a time from a table of keys.
  interface riis_opening_from_table
    module procedure from_table
  end interface riis_opening_from_table

  !> Gives the opening at a time from the times of opening and closing.
  interface riis_opening_from_times
    module procedure from_times
  end interface riis_opening_from_times

  !> Advances the state of a law to a time.
  interface riis_opening_advance
    module procedure advance_switch
    module procedure advance_angle
  end interface riis_opening_advance

contains

  !> Gives the opening at a time from a table of keys. Errors: RIIS_INVALID_ARGUMENT naming the key, counted from 0, and its
  !! value.
  subroutine from_table(key_time, key_opening, time, opening, rate, period, interpolation, status)
    real(c_double), intent(in), contiguous, target :: key_time(:) !< (n_keys), 1 to 1,000,000, strictly ascending, magnitude
                                                            !! at most 1e30.
    real(c_double), intent(in), contiguous, target :: key_opening(:) !< (n_keys), 0 to 1.
    real(c_double), intent(in) :: time                      !< Magnitude at most 1e30.
    real(c_double), intent(inout) :: opening                !< Unchanged on an error.
    real(c_double), intent(inout), optional :: rate         !< Its derivative by time. Unchanged on an error.
    real(c_double), intent(in), optional :: period          !< > 0: the table repeats. Its keys lie within one period of the
                                                            !! first. A last key one period after the first must have the same
                                                            !! opening. Default 0: the opening is constant before the first key
                                                            !! and after the last.
    class(*), intent(in), optional :: interpolation         !< integer, RIIS_INTERPOLATION_*. Default
                                                            !! RIIS_INTERPOLATION_LINEAR.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_table) :: table
    code = check_size(size(key_opening, kind=int64), size(key_time, kind=int64), 'key_opening', 'times of keys')
    if (code == RIIS_OK) code = riis_opening_table_init(table, c_sizeof(table))
    call get_integer(interpolation, 'interpolation', table%interpolation, code)
    if (code == RIIS_OK) then
      table%n_keys = size(key_time, kind=int64)
      if (table%n_keys > 0) table%time = c_loc(key_time)
      if (table%n_keys > 0) table%opening = c_loc(key_opening)
      if (present(period)) table%period = period
      code = c_from_table(table, time, opening, rate)
    end if
    call finish(code, status)
  end subroutine from_table

  !> Gives the opening at a time. Errors: RIIS_INVALID_ARGUMENT naming the component and its value.
  subroutine from_times(times, time, opening, rate, status)
    type(riis_opening_times), intent(in) :: times           !< The law.
    real(c_double), intent(in) :: time                      !< Magnitude at most 1e30.
    real(c_double), intent(inout) :: opening                !< Unchanged on an error.
    real(c_double), intent(inout), optional :: rate         !< Its derivative by time. Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_times) :: law
    code = riis_opening_times_init(law, c_sizeof(law))
    if (code == RIIS_OK) then
      law%opening_start = times%opening_start
      law%opening_duration = times%opening_duration
      law%closing_start = times%closing_start
      law%closing_duration = times%closing_duration
      law%closed = times%closed
      law%open = times%open
      law%period = times%period
      code = c_from_times(law, time, opening, rate)
    end if
    call finish(code, status)
  end subroutine from_times

  !> Advances a switch to a time. The phase changes at the end of the step in which its condition is met. The opening is thus
  !! accurate to first order in the time step. Errors: RIIS_INVALID_ARGUMENT naming the argument or component and its value.
  subroutine advance_switch(law, state, time, pressure_difference, flow, status)
    type(riis_opening_switch), intent(in) :: law            !< The law.
    type(riis_opening_switch_state), intent(inout) :: state !< Its state, which is advanced to the time. Unchanged on an error.
    real(c_double), intent(in) :: time                      !< At least state%time.
    real(c_double), intent(in) :: pressure_difference       !< Upstream minus downstream, at the given time.
    real(c_double), intent(in) :: flow                      !< Positive downstream, at the given time.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_switch) :: made
    type(c_switch_state) :: before, now
    code = riis_opening_switch_init(made, c_sizeof(made))
    if (code == RIIS_OK) code = riis_opening_switch_state_init(before, c_sizeof(before))
    if (code == RIIS_OK) then
      made%opening_duration = law%opening_duration
      made%closing_duration = law%closing_duration
      made%open_above = law%open_above
      made%close_below = law%close_below
      made%filter_time = law%filter_time
      made%dwell_time = law%dwell_time
      before%time = state%time
      before%opening = state%opening
      before%rate = state%rate
      before%progress = state%progress
      before%pressure_difference = state%pressure_difference
      before%flow = state%flow
      before%turn_time = state%turn_time
      before%phase = state%phase
      now = before
      code = riis_opening_switch_advance(made, before, time, pressure_difference, flow, now)
    end if
    if (code == RIIS_OK) then
      state%time = now%time
      state%opening = now%opening
      state%rate = now%rate
      state%progress = now%progress
      state%pressure_difference = now%pressure_difference
      state%flow = now%flow
      state%turn_time = now%turn_time
      state%phase = now%phase
    end if
    call finish(code, status)
  end subroutine advance_switch

  !> Advances the angle law to a time. Pressure difference and flow are taken as linear over the step. The angle is thus accurate
  !! to second order in the time step. If the state has no earlier pressure difference and flow, the present values are used for
  !! the whole step. Errors: RIIS_INVALID_ARGUMENT naming the argument or component and its value; RIIS_LIMIT_EXCEEDED for a step
  !! that needs more than a million inner steps.
  subroutine advance_angle(law, state, time, pressure_difference, flow, status)
    type(riis_opening_angle), intent(in) :: law             !< The law.
    type(riis_opening_angle_state), intent(inout) :: state  !< Its state, which is advanced to the time. Unchanged on an error.
    real(c_double), intent(in) :: time                      !< At least state%time.
    real(c_double), intent(in) :: pressure_difference       !< Upstream minus downstream, at the given time.
    real(c_double), intent(in) :: flow                      !< Positive downstream, at the given time.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_angle) :: made
    type(c_angle_state) :: before, now
    code = riis_opening_angle_init(made, c_sizeof(made))
    if (code == RIIS_OK) code = riis_opening_angle_state_init(before, c_sizeof(before))
    if (code == RIIS_OK) then
      made%pressure_gain = law%pressure_gain
      made%flow_gain = law%flow_gain
      made%friction = law%friction
      made%vortex_gain = law%vortex_gain
      made%angle_min = law%angle_min
      made%angle_max = law%angle_max
      before%time = state%time
      before%opening = state%opening
      before%rate = state%rate
      before%angle = state%angle
      before%angle_rate = state%angle_rate
      before%pressure_difference = state%pressure_difference
      before%flow = state%flow
      now = before
      code = riis_opening_angle_advance(made, before, time, pressure_difference, flow, now)
    end if
    if (code == RIIS_OK) then
      state%time = now%time
      state%opening = now%opening
      state%rate = now%rate
      state%angle = now%angle
      state%angle_rate = now%angle_rate
      state%pressure_difference = now%pressure_difference
      state%flow = now%flow
    end if
    call finish(code, status)
  end subroutine advance_angle

end module riis_laws
