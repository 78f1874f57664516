! SPDX-License-Identifier: Apache-2.0
! Helpers of the Fortran tests: checks that count failures, and a comparison of memory.
module checks
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int8_t, c_int64_t, c_ptr
  use, intrinsic :: iso_fortran_env, only: error_unit
  use riis_c
  implicit none
  private
  public :: check, check_ok, check_refused, check_same_bytes, finish, same

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

  ! Compares bit for bit. Comparing reals by value would treat -0 and 0 as equal, and NaN as different from itself.
  subroutine check_same_bytes(a, b, n_bytes, what)
    type(c_ptr), intent(in) :: a, b
    integer(c_int64_t), intent(in) :: n_bytes
    character(len=*), intent(in) :: what
    integer(c_int8_t), pointer :: bytes_a(:), bytes_b(:)
    call check(n_bytes > 0 .and. c_associated(a) .and. c_associated(b), what // ': there is something to compare')
    if (n_bytes <= 0 .or. .not. (c_associated(a) .and. c_associated(b))) return
    call c_f_pointer(a, bytes_a, [n_bytes])
    call c_f_pointer(b, bytes_b, [n_bytes])
    call check(all(bytes_a == bytes_b), what // ': the same bits from Fortran and from C')
  end subroutine check_same_bytes

  ! Returns whether two numbers have the same bits.
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
