! SPDX-License-Identifier: Apache-2.0
!> Ends the program after an error with a message that names the step and the time. Also reads the clocks.
module flow_stop
  use, intrinsic :: iso_fortran_env, only: dp => real64, error_unit, int64
  implicit none
  private
  public :: refuse, clocks
  integer, public :: step_number = 0
  real(dp), public :: step_time = 0

contains

  !> Prints the message with the step and the time, and ends the program with status 1.
  subroutine refuse(text)
    character(len=*), intent(in) :: text
    write (error_unit, '(a, i0, a, f0.6, 2a)') 'flow: step ', step_number, ', ', step_time, ' s: ', text
    stop 1, quiet=.true.
  end subroutine refuse

  !> Returns two times in seconds: the wall clock and the processor time.
  function clocks() result(seconds)
    real(dp) :: seconds(2)
    integer(int64) :: ticks, rate
    call system_clock(ticks, rate)
    seconds(1) = real(ticks, dp) / rate
    call cpu_time(seconds(2))
  end function clocks
end module flow_stop
