! SPDX-License-Identifier: Apache-2.0
! The inlet (faces 1) is in the ventricle, the outlet (faces 2) in the aorta. The faces get either the pressures of a beat, or a
! given inflow.
subroutine cs_f_user_boundary_conditions(nvar, nscal, icodcl, itrifb, itypfb, izfppp, dt, rcodcl)
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_null_char
  use paramx
  use numvar
  use optcal
  use mesh
  implicit none
  integer :: nvar, nscal
  integer :: icodcl(nfabor, nvar), itrifb(nfabor), itypfb(nfabor), izfppp(nfabor)
  double precision :: dt(ncelet), rcodcl(nfabor, nvar, 3)
  interface
    function setting(name) bind(c) result(value)
      import :: c_char, c_double
      character(kind=c_char), intent(in) :: name(*)
      real(c_double) :: value
    end function setting
  end interface
  ! The pressure difference between ventricle and aorta in Pa, at times of a beat in s.
  double precision, parameter :: key_time(6) = [0d0, 0.02d0, 0.04d0, 0.1d0, 0.14d0, 0.3d0]
  double precision, parameter :: key_difference(6) = [-4d2, -4d2, 4d2, 4d2, -4d2, -4d2]
  integer, allocatable :: faces(:)
  double precision :: inflow, difference, share
  integer :: i, k, n, face

  allocate (faces(nfabor))
  inflow = setting('RUN_INFLOW'//c_null_char)
  difference = key_difference(6)
  do k = 1, 5
    if (ttcabs >= key_time(k) .and. ttcabs < key_time(k + 1)) then
      share = (ttcabs - key_time(k)) / (key_time(k + 1) - key_time(k))
      share = share**2 * (3 - 2 * share)
      difference = key_difference(k) + share * (key_difference(k + 1) - key_difference(k))
    end if
  end do

  call getfbr('1', n, faces)
  do i = 1, n
    face = faces(i)
    if (inflow > 0) then
      itypfb(face) = ientre
      rcodcl(face, iu, 1) = 0
      rcodcl(face, iv, 1) = 0
      rcodcl(face, iw, 1) = inflow
    else
      call open_face(face, difference)
    end if
  end do
  call getfbr('2', n, faces)
  do i = 1, n
    call open_face(faces(i), 0d0)
  end do
  call getfbr('3', n, faces)
  do i = 1, n
    itypfb(faces(i)) = iparoi
  end do

contains

  ! A face with a given pressure, through which the flow may go in either direction. code_saturne takes the momentum of inflow as
  ! 0, so the fluid outside is at rest at the given pressure.
  subroutine open_face(face, pressure)
    integer, intent(in) :: face
    double precision, intent(in) :: pressure
    itypfb(face) = isolib
    icodcl(face, ipr) = 1
    rcodcl(face, ipr, 1) = pressure
  end subroutine open_face
end subroutine cs_f_user_boundary_conditions
