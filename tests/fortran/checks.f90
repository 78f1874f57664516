! SPDX-License-Identifier: Apache-2.0
! Helps the Fortran tests with checks that count failures, and with a comparison of bits.
module checks
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use riis_c
  implicit none
  private
  public :: check, check_ok, check_refused, finish, same

  integer :: n_checks = 0, n_failed = 0

contains

  subroutine check(is_true, what)
    logical, intent(in) :: is_true
    character(len=*), intent(in) :: what
    n_checks = n_checks + 1
    if (is_true) return
    n_failed = n_failed + 1
    write (error_unit, '(2a)') 'failed: ', what
  end subroutine check

  ! Ends the test if the call failed, because later calls depend on it.
  subroutine check_ok(status, what)
    integer(riis_status), intent(in) :: status
    character(len=*), intent(in) :: what
    n_checks = n_checks + 1
    if (status == RIIS_OK) return
    write (error_unit, '(6a)') 'failed: ', what, ': ', riis_c_text(riis_status_name(status)), ': ', &
      riis_c_text(riis_last_error())
    error stop
  end subroutine check_ok

  ! Checks that the call was refused with this status, and that the error message contains these words.
  subroutine check_refused(status, expected, words)
    integer(riis_status), intent(in) :: status, expected
    character(len=*), intent(in) :: words
    call check(status == expected, 'refused with ' // riis_c_text(riis_status_name(expected)) // ' for "' // words // &
      '", not ' // riis_c_text(riis_status_name(status)))
    call check(index(riis_c_text(riis_last_error()), words) > 0, 'the error text has "' // words // '": ' // &
      riis_c_text(riis_last_error()))
  end subroutine check_refused

  ! Returns whether two numbers have the same bits. A comparison of values would not do: -0 would equal 0, and NaN would differ
  ! from itself.
  elemental function same(a, b)
    real(c_double), intent(in) :: a, b
    logical :: same
    same = transfer(a, 0_c_int64_t) == transfer(b, 0_c_int64_t)
  end function same

  subroutine finish()
    print '(i0, a, i0, a)', n_checks, ' checks, ', n_failed, ' failed'
    if (n_checks == 0 .or. n_failed > 0) error stop
  end subroutine finish
end module checks
