! SPDX-License-Identifier: Apache-2.0
! Computes distances by a loop over all triangles of a surface, for the tests of hosts in Fortran 90. brute.h describes the call.
module brute
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t, c_ptr
  implicit none
  private
  public :: brute_distances

  interface
    ! The handle is surface%c_handle().
    subroutine brute_distances(surface, n_points, x, y, z, stride, limit, distance) bind(c, name='brute_distances')
      import :: c_double, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value, intent(in) :: surface
      integer(c_int64_t), value, intent(in) :: n_points, stride
      real(c_double), intent(in) :: x(*), y(*), z(*)
      real(c_double), value, intent(in) :: limit
      real(c_double), intent(inout) :: distance(*)
    end subroutine brute_distances
  end interface
end module brute
