! SPDX-License-Identifier: Apache-2.0
!> Describes the walls of an aortic root with three sinuses. The attachment of the trileaflet valve's cusps lies on the wall, so
!! the valve seals. The numbers and formulas come from examples/demo/aortic_root.geo. docs/theory/aortic.md describes the
!! attachment. Lengths are in the valve's unit, centimetres.
module flow_root
  use, intrinsic :: iso_fortran_env, only: dp => real64
  implicit none
  private
  public :: in_root, root_radius

  real(dp), parameter :: radian = acos(-1._dp) / 180
  ! These constants equal the valve's parameters of the same names. The free edges of the closed valve lie at z = 0.
  real(dp), parameter :: base_radius = 1.25_dp, leaflet_height = 1.2_dp, bending_height = 0.6_dp, leaflet_radius = 1.25_dp, &
    leaflet_angle = 60, bending_radius = 1.275_dp, bending_angle = 35, base_z = -1.2_dp
  ! A sinus bulges outward beyond the attachment. The bulge is largest, 0.5, at the middle of a cusp.
  real(dp), parameter :: sinus_height = leaflet_height + 0.4_dp, sinus_depth = 0.5_dp

contains

  !> Tells whether a point, in metres, is inside the walls.
  pure logical function in_root(x)
    real(dp), intent(in) :: x(3)
    in_root = hypot(x(1), x(2)) * 100 < root_radius(x(3) * 100, atan2(x(2), x(1)) / radian)
  end function in_root

  !> Returns the distance of the wall from the axis [cm], at a height z [cm] and an angle [degrees]. The middles of the cusps are
  !! at 0, 120 and -120 degrees.
  pure real(dp) function root_radius(z, angle)
    real(dp), intent(in) :: z, angle
    real(dp) :: t, s, end_of_edge(2), end_of_bend(2), middle(2), p(2), half_angle, away, sinus
    integer :: cusp
    ! The attachment of half a cusp is a parabola through the root, the end of the bending curve and the commissure.
    t = min(1._dp, max(0._dp, (z - base_z) / leaflet_height))
    s = bending_height / leaflet_height
    end_of_edge = leaflet_radius * [cos(leaflet_angle * radian), sin(leaflet_angle * radian)]
    end_of_bend = bending_radius * [cos(bending_angle * radian), sin(bending_angle * radian)]
    middle = (end_of_bend - (1 - s)**2 * [base_radius, 0._dp] - s**2 * end_of_edge) / (2 * s * (1 - s))
    p = (1 - t)**2 * [base_radius, 0._dp] + 2 * t * (1 - t) * middle + t**2 * end_of_edge
    half_angle = max(atan2(p(2), p(1)) / radian, 1e-6_dp)
    sinus = sinus_depth * sin(acos(-1._dp) * min(1._dp, max(0._dp, (z - base_z) / sinus_height))**0.65_dp)

    root_radius = norm2(p)                        ! the cusps are equal, so without the sinuses the wall is round
    do cusp = 0, 2
      away = abs(modulo(angle - 120 * cusp + 180, 360._dp) - 180)
      root_radius = root_radius + sinus * half_angle / 60 * (1 - min(1._dp, away / half_angle)**4)**2
    end do
  end function root_radius
end module flow_root
