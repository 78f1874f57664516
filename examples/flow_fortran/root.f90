! SPDX-License-Identifier: Apache-2.0
!> Describes the walls of an aortic root with three sinuses. The attachment of the cusps lies on the wall, so a valve that seals
!! in its own attachment seals here. The root fits the trileaflet valve, or another valve after fit_root has read its sizes. The
!! formulas come from examples/demo/aortic_root.geo. docs/theory/aortic.md and coapting.md describe the attachments. Lengths are
!! in the valve's unit, centimetres.
module flow_root
  use, intrinsic :: iso_fortran_env, only: dp => real64
  use riis, only: riis_valve
  implicit none
  private
  public :: in_root, root_radius, fit_root

  real(dp), parameter :: radian = acos(-1._dp) / 180
  real(dp), parameter :: base_z = -1.2_dp         ! the free edges of the closed trileaflet valve lie at z = 0
  ! The sizes of the root are equal to the valve's parameters of the same names. Three numbers belong to the right, left and
  ! non-coronary cusps. leaflet_height is the height of the commissures.
  real(dp) :: base_radius = 1.25_dp, leaflet_height = 1.2_dp, bending_height = 0.6_dp
  real(dp), dimension(3) :: leaflet_radius = 1.25_dp, leaflet_angle = 60, bending_radius = 1.275_dp, bending_angle = 35
  real(dp) :: middle_of_cusp(3) = [0, 120, 240]   ! [degrees]
  logical :: is_coapting = .false.                ! the attachment is a cubic with the next two parameters
  real(dp) :: attachment_width = 0, attachment_drop = 0
  ! A sinus bulges outward beyond the attachment, up to this height above the commissures. The bulge is largest, 0.5, at the
  ! middle of a cusp.
  real(dp), parameter :: sinus_above = 0.4_dp, sinus_depth = 0.5_dp

contains

  !> Reads the sizes of an aortic, trileaflet or coapting valve. Returns the shift along z that places the valve in the root [m].
  subroutine fit_root(valve, kind, shift)
    type(riis_valve), intent(in) :: valve
    character(len=*), intent(in) :: kind
    real(dp), intent(out) :: shift
    character(len=12), parameter :: cusps(3) = ['right       ', 'left        ', 'non_coronary']
    real(dp) :: translation(3), rotation(3)
    integer :: c
    call valve%get('root_radius', base_radius)
    is_coapting = kind == 'coapting'
    select case (kind)
    case ('coapting')
      call valve%get('commissure_height', leaflet_height)
      call valve%get('commissure_radius', leaflet_radius(1))
      call valve%get('attachment_width', attachment_width)
      call valve%get('attachment_drop', attachment_drop)
      call valve%get('translation', translation)
    case ('aortic')
      call valve%get('leaflet_height', leaflet_height)
      call valve%get('bending_height', bending_height)
      do c = 1, 3
        call valve%get(trim(cusps(c)) // '.leaflet_radius_out', leaflet_radius(c))
        call valve%get(trim(cusps(c)) // '.leaflet_angle', leaflet_angle(c))
        call valve%get(trim(cusps(c)) // '.bending_radius_out', bending_radius(c))
        call valve%get(trim(cusps(c)) // '.bending_angle', bending_angle(c))
        call valve%get(trim(cusps(c)) // '.rotation', rotation)
        middle_of_cusp(c) = rotation(3)
      end do
      call valve%get('right.translation', translation)
    case default
      call valve%get('leaflet_height', leaflet_height)
      call valve%get('bending_height', bending_height)
      call valve%get('leaflet_radius_out', leaflet_radius(1))
      call valve%get('bending_radius_out', bending_radius(1))
      call valve%get('bending_angle', bending_angle(1))
      bending_radius = bending_radius(1)
      bending_angle = bending_angle(1)
      call valve%get('translation', translation)
    end select
    if (kind /= 'aortic') then                    ! three equal cusps
      leaflet_radius = leaflet_radius(1)
      leaflet_angle = 60
      middle_of_cusp = [0, 120, 240]
    end if
    shift = (base_z - translation(3)) / 100
  end subroutine fit_root

  !> Tells whether a point, in metres, is inside the walls.
  pure logical function in_root(x)
    real(dp), intent(in) :: x(3)
    in_root = hypot(x(1), x(2)) * 100 < root_radius(x(3) * 100, atan2(x(2), x(1)) / radian)
  end function in_root

  !> Returns the distance of the wall from the axis [cm], at a height z [cm] and an angle [degrees].
  pure real(dp) function root_radius(z, angle)
    real(dp), intent(in) :: z, angle
    real(dp) :: p(2), half_angle, away(3), sinus
    integer :: cusp
    away = abs(modulo(angle - middle_of_cusp + 180, 360._dp) - 180)
    cusp = minloc(away / leaflet_angle, 1)
    if (is_coapting) then
      p = point_of_cubic(z - base_z)
    else
      p = point_of_parabola(z - base_z, cusp)
    end if
    half_angle = max(atan2(p(2), p(1)) / radian, 1e-6_dp)
    sinus = sinus_depth * sin(acos(-1._dp) * min(1._dp, max(0._dp, (z - base_z) / (leaflet_height + sinus_above)))**0.65_dp)
    root_radius = norm2(p) + sinus * half_angle / 60 * (1 - min(1._dp, away(cusp) / half_angle)**4)**2
  end function root_radius

  ! Returns x and y of the attachment of half a cusp at a height above the root: a parabola through the root, the end of the
  ! bending curve and the commissure.
  pure function point_of_parabola(height, cusp) result(p)
    real(dp), intent(in) :: height
    integer, intent(in) :: cusp
    real(dp) :: p(2), t, s, end_of_edge(2), end_of_bend(2), middle(2)
    t = min(1._dp, max(0._dp, height / leaflet_height))
    s = bending_height / leaflet_height
    end_of_edge = leaflet_radius(cusp) * [cos(leaflet_angle(cusp) * radian), sin(leaflet_angle(cusp) * radian)]
    end_of_bend = bending_radius(cusp) * [cos(bending_angle(cusp) * radian), sin(bending_angle(cusp) * radian)]
    middle = (end_of_bend - (1 - s)**2 * [base_radius, 0._dp] - s**2 * end_of_edge) / (2 * s * (1 - s))
    p = (1 - t)**2 * [base_radius, 0._dp] + 2 * t * (1 - t) * middle + t**2 * end_of_edge
  end function point_of_parabola

  ! Returns x and y of the attachment of half a coapting cusp at a height above the root: a cubic, whose height grows with t.
  pure function point_of_cubic(height) result(p)
    real(dp), intent(in) :: height
    real(dp) :: p(2), t, low, high, share
    integer :: i
    low = 0
    high = 1
    do i = 1, 40                                  ! halves an interval
      t = (low + high) / 2
      if (leaflet_height * (3 * (1 - t) * t**2 * (1 - attachment_drop) + t**3) < height) then
        low = t
      else
        high = t
      end if
    end do
    share = 3 * (1 - t) * t**2 + t**3
    p = (1 - t)**2 * base_radius * [1 - t, 3 * t * attachment_width] + &
      [3 * (1 - t)**2 * t * base_radius, 0._dp] + share * leaflet_radius(1) * [0.5_dp, sqrt(0.75_dp)]
  end function point_of_cubic
end module flow_root
