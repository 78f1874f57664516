! SPDX-License-Identifier: Apache-2.0
! Uses riisf.h in free form. test_f77.f uses it in fixed form. generate.py writes the constants of riisf.h from riis.h.
program test_include
  use, intrinsic :: iso_c_binding, only: c_double
  use checks
  implicit none
  include 'riisf.h'
  external :: riisf_version
  character(len=20) :: text
  call check(RIIS_INVALID_ARGUMENT == 1 .and. RIIS_SEARCH_PAPER == 3, 'integer constants')
  call check(storage_size(RIIS_OK) == 32, 'their kind')
  call check(same(RIIS_AUTO, -1d0) .and. same(RIIS_FAR_DISTANCE, 1e30_c_double), 'real constants')
  call riisf_version(text)
  call check(index(text, '.') > 0, 'a call with an implicit interface')
  call finish()
end program test_include
