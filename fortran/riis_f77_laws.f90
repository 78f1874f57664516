! SPDX-License-Identifier: Apache-2.0
!> The external subroutines for laws of opening. The conventions are those of riis_f77.f90.
!!
!! The same arguments give the same bits, and nothing is kept between calls. Times, pressures and flows have the solver's units.
!! The pressure difference is upstream pressure minus downstream pressure, and flow is positive downstream, so positive values of
!! both open a valve. A state is an array. If a restart file contains it, unformatted or in full precision, the law continues with
!! the same bits. To repeat a step, start from a copy of the state. The rate is the derivative of the opening by time.

!> Gives the opening at a time from a table of keys. Errors: RIIS_INVALID_ARGUMENT naming the key, counted from 0, and its value.
subroutine riisf_opening_from_table(n_keys, key_time, key_opening, period, interpolation, time, opening, rate, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32
  use riis_c, only: riis_opening_table, riis_status, RIIS_OK, riis_opening_from_table, riis_opening_table_init
  use riis_support, only: location_of
  implicit none
  integer(int32), intent(in) :: n_keys                    !< 1 to 1,000,000.
  real(c_double), intent(in) :: key_time(*)               !< (n_keys), strictly ascending, magnitude at most 1e30.
  real(c_double), intent(in) :: key_opening(*)            !< (n_keys), 0 to 1.
  real(c_double), intent(in) :: period                    !< > 0: the table repeats. Its keys lie within one period of the first.
                                                          !! A last key one period after the first must have the same opening. 0:
                                                          !! the opening is constant before the first key and after the last.
  integer(int32), intent(in) :: interpolation             !< RIIS_INTERPOLATION_LINEAR or RIIS_INTERPOLATION_CUBIC.
  real(c_double), intent(in) :: time                      !< Magnitude at most 1e30.
  real(c_double), intent(inout) :: opening                !< Written on success.
  real(c_double), intent(inout) :: rate                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_table) :: table
  status = riis_opening_table_init(table, c_sizeof(table))
  if (status /= RIIS_OK) return
  table%n_keys = n_keys
  table%time = location_of(key_time)
  table%opening = location_of(key_opening)
  table%period = period
  table%interpolation = interpolation
  status = riis_opening_from_table(table, time, opening, rate)
end subroutine riisf_opening_from_table

!> Gives the opening at a time from the times of opening and closing. The ramps are of fifth degree: neither the rate nor its
!! derivative jumps. Errors: RIIS_INVALID_ARGUMENT naming the argument and its value.
subroutine riisf_opening_from_times(opening_start, opening_duration, closing_start, closing_duration, closed, open, period, &
    time, opening, rate, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use riis_c, only: riis_opening_times, riis_status, RIIS_OK, riis_opening_from_times, riis_opening_times_init
  implicit none
  real(c_double), intent(in) :: opening_start             !< When the valve begins to open.
  real(c_double), intent(in) :: opening_duration           !< The duration of opening, > 0.
  real(c_double), intent(in) :: closing_start             !< When it begins to close, at least opening_start +
                                                          !! opening_duration.
  real(c_double), intent(in) :: closing_duration           !< The duration of closing, > 0.
  real(c_double), intent(in) :: closed                    !< The opening when closed, 0 to 1; usually 0.
  real(c_double), intent(in) :: open                      !< The opening when open, 0 to 1; usually 1.
  real(c_double), intent(in) :: period                    !< > 0: the motion repeats, at the earliest when the valve has closed.
                                                          !! 0: the valve opens once.
  real(c_double), intent(in) :: time                      !< Magnitude at most 1e30.
  real(c_double), intent(inout) :: opening                !< Written on success.
  real(c_double), intent(inout) :: rate                   !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_times) :: times
  status = riis_opening_times_init(times, c_sizeof(times))
  if (status /= RIIS_OK) return
  times%opening_start = opening_start
  times%opening_duration = opening_duration
  times%closing_start = closing_start
  times%closing_duration = closing_duration
  times%closed = closed
  times%open = open
  times%period = period
  status = riis_opening_from_times(times, time, opening, rate)
end subroutine riisf_opening_from_times

!> Fills the state of a switch with a closed valve at time 0.
subroutine riisf_opening_switch_init(state, phase, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32
  use riis_c, only: riis_opening_switch_state, riis_status, RIIS_OK, riis_opening_switch_state_init
  implicit none
  real(c_double), intent(inout) :: state(7)               !< As for riisf_opening_switch_advance.
  integer(int32), intent(inout) :: phase                  !< RIIS_PHASE_CLOSING.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_switch_state) :: made
  status = riis_opening_switch_state_init(made, c_sizeof(made))
  if (status /= RIIS_OK) return
  state = [made%time, made%opening, made%rate, made%progress, made%pressure_difference, made%flow, made%turn_time]
  phase = made%phase
end subroutine riisf_opening_switch_init

!> Advances a switch to a time. The valve opens when the pressure difference exceeds open_above, and closes when the flow falls
!! below close_below. The phase changes at the end of the step in which this happens, so the opening is accurate to first order in
!! the time step. Errors: RIIS_INVALID_ARGUMENT naming the argument and its value.
subroutine riisf_opening_switch_advance(opening_duration, closing_duration, open_above, close_below, filter_time, &
    dwell_time, time, pressure_difference, flow, state, phase, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32
  use riis_c, only: riis_opening_switch, riis_opening_switch_state, riis_status, RIIS_OK, riis_opening_switch_advance, &
    riis_opening_switch_init, riis_opening_switch_state_init
  implicit none
  real(c_double), intent(in) :: opening_duration           !< The time from closed to open, > 0.
  real(c_double), intent(in) :: closing_duration           !< The time from open to closed, > 0.
  real(c_double), intent(in) :: open_above                !< A pressure difference; usually 0.
  real(c_double), intent(in) :: close_below               !< A flow; usually 0.
  real(c_double), intent(in) :: filter_time            !< Time constant of a first-order filter of both, >= 0; 0: no
                                                          !! filter.
  real(c_double), intent(in) :: dwell_time             !< The least time between changes of phase, >= 0.
  real(c_double), intent(in) :: time                      !< At least state(1).
  real(c_double), intent(in) :: pressure_difference       !< Upstream minus downstream, at the given time.
  real(c_double), intent(in) :: flow                      !< Positive downstream, at the given time.
  real(c_double), intent(inout) :: state(7)               !< Time, opening, rate, progress, filtered pressure difference,
                                                          !! filtered flow, time of the last change of phase (NaN: none yet).
                                                          !! Written on success.
  integer(int32), intent(inout) :: phase                  !< RIIS_PHASE_*, a part of the state. Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_switch) :: law
  type(riis_opening_switch_state) :: before, now
  status = riis_opening_switch_init(law, c_sizeof(law))
  if (status == RIIS_OK) status = riis_opening_switch_state_init(before, c_sizeof(before))
  if (status /= RIIS_OK) return
  law%opening_duration = opening_duration
  law%closing_duration = closing_duration
  law%open_above = open_above
  law%close_below = close_below
  law%filter_time = filter_time
  law%dwell_time = dwell_time
  before%time = state(1)
  before%opening = state(2)
  before%rate = state(3)
  before%progress = state(4)
  before%pressure_difference = state(5)
  before%flow = state(6)
  before%turn_time = state(7)
  before%phase = phase
  now = before
  status = riis_opening_switch_advance(law, before, time, pressure_difference, flow, now)
  if (status /= RIIS_OK) return
  state = [now%time, now%opening, now%rate, now%progress, now%pressure_difference, now%flow, now%turn_time]
  phase = now%phase
end subroutine riisf_opening_switch_advance

!> Fills the state of an angle law with a closed valve at rest, at time 0. Its angle 0 means angle_min.
subroutine riisf_opening_angle_init(state, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use riis_c, only: riis_opening_angle_state, riis_status, RIIS_OK, riis_opening_angle_state_init
  implicit none
  real(c_double), intent(inout) :: state(7)               !< As for riisf_opening_angle_advance.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_angle_state) :: made
  status = riis_opening_angle_state_init(made, c_sizeof(made))
  if (status /= RIIS_OK) return
  state = [made%time, made%opening, made%rate, made%angle, made%angle_rate, made%pressure_difference, made%flow]
end subroutine riisf_opening_angle_init

!> Advances the angle law of Korakianitis and Shi (2006) to a time: angle'' = -friction angle' + (pressure_gain dp + flow_gain Q)
!! cos(angle) - vortex_gain max(Q, 0) sin(2 angle), in radians, between stops that absorb all speed. The paper's values, for mmHg,
!! ml and s: pressure_gain 5500, flow_gain 2, friction 50, vortex_gain 7 for the aortic and 3.5 for the mitral valve. Errors:
!! RIIS_INVALID_ARGUMENT naming the argument and its value; RIIS_LIMIT_EXCEEDED for a step so long that it would need more than a
!! million inner steps.
subroutine riisf_opening_angle_advance(pressure_gain, flow_gain, friction, vortex_gain, angle_min, angle_max, time, &
    pressure_difference, flow, state, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use riis_c, only: riis_opening_angle, riis_opening_angle_state, riis_status, RIIS_OK, riis_opening_angle_advance, &
    riis_opening_angle_init, riis_opening_angle_state_init
  implicit none
  real(c_double), intent(in) :: pressure_gain             !< K_p, >= 0.
  real(c_double), intent(in) :: flow_gain                 !< K_q, >= 0.
  real(c_double), intent(in) :: friction                  !< K_f, >= 0.
  real(c_double), intent(in) :: vortex_gain               !< K_v, >= 0.
  real(c_double), intent(in) :: angle_min                 !< Degrees, 0 to 90: the closed angle; usually 0.
  real(c_double), intent(in) :: angle_max                 !< Degrees, above angle_min, at most 90: the open angle; usually 75.
  real(c_double), intent(in) :: time                      !< At least state(1).
  real(c_double), intent(in) :: pressure_difference       !< Upstream minus downstream, at the given time.
  real(c_double), intent(in) :: flow                      !< Positive downstream, at the given time.
  real(c_double), intent(inout) :: state(7)               !< Time, opening, rate, angle in degrees, its rate, pressure
                                                          !! difference, flow (NaN: none yet). Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_opening_angle) :: law
  type(riis_opening_angle_state) :: before, now
  status = riis_opening_angle_init(law, c_sizeof(law))
  if (status == RIIS_OK) status = riis_opening_angle_state_init(before, c_sizeof(before))
  if (status /= RIIS_OK) return
  law%pressure_gain = pressure_gain
  law%flow_gain = flow_gain
  law%friction = friction
  law%vortex_gain = vortex_gain
  law%angle_min = angle_min
  law%angle_max = angle_max
  before%time = state(1)
  before%opening = state(2)
  before%rate = state(3)
  before%angle = state(4)
  before%angle_rate = state(5)
  before%pressure_difference = state(6)
  before%flow = state(7)
  now = before
  status = riis_opening_angle_advance(law, before, time, pressure_difference, flow, now)
  if (status /= RIIS_OK) return
  state = [now%time, now%opening, now%rate, now%angle, now%angle_rate, now%pressure_difference, now%flow]
end subroutine riisf_opening_angle_advance
