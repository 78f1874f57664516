! SPDX-License-Identifier: Apache-2.0
!> Gives the pressures at both ends of the aortic root. The left ventricle has a time-varying elastance. An atrium of constant
!! pressure fills it through an ideal mitral valve. The arteries are a windkessel of three elements. The numbers are typical of a
!! healthy adult.
module flow_circulation
  use, intrinsic :: iso_fortran_env, only: dp => real64
  implicit none
  private
  public :: circulation, mmHg, ml

  real(dp), parameter :: mmHg = 133.322_dp, ml = 1e-6_dp                 ! [Pa], [m^3]
  real(dp), parameter, public :: period = 0.8_dp                         ! [s] duration of a heartbeat
  real(dp), parameter :: contraction = 0.38_dp, relaxation = 0.15_dp     ! [s] durations of both phases
  real(dp), parameter :: E_min = 0.07_dp * mmHg / ml, E_max = 2.2_dp * mmHg / ml, V_0 = 10 * ml
  real(dp), parameter :: p_atrium = 9 * mmHg, R_mitral = 0.01_dp * mmHg / ml
  real(dp), parameter :: Z_aorta = 0.065_dp * mmHg / ml, R_arteries = mmHg / ml, C_arteries = 1.4_dp * ml / mmHg

  type :: circulation
    real(dp) :: V = 125 * ml                      ! [m^3] volume of the ventricle; it begins full
    real(dp) :: p = 80 * mmHg                     ! [Pa] pressure in the windkessel
  contains
    procedure :: p_ventricle, p_aorta, advance
  end type circulation

contains

  !> Returns the pressure in the ventricle. At time 0 the ventricle begins to contract.
  pure real(dp) function p_ventricle(this, time)
    class(circulation), intent(in) :: this
    real(dp), intent(in) :: time
    real(dp), parameter :: pi = acos(-1._dp)
    real(dp) :: t, active
    t = modulo(time, period)
    active = 0
    if (t < contraction) then
      active = (1 - cos(pi * t / contraction)) / 2
    else if (t < contraction + relaxation) then
      active = (1 + cos(pi * (t - contraction) / relaxation)) / 2
    end if
    p_ventricle = (E_min + (E_max - E_min) * active) * (this%V - V_0)
  end function p_ventricle

  !> Returns the pressure at the outlet. The pressure at the outlet depends on the flow through it.
  pure real(dp) function p_aorta(this, flow)
    class(circulation), intent(in) :: this
    real(dp), intent(in) :: flow
    p_aorta = this%p + Z_aorta * flow
  end function p_aorta

  !> Advances both volumes by dt. The flow leaves the ventricle and enters the arteries.
  pure subroutine advance(this, time, dt, flow)
    class(circulation), intent(inout) :: this
    real(dp), intent(in) :: time, dt, flow
    this%V = this%V + dt * (max(0._dp, p_atrium - this%p_ventricle(time)) / R_mitral - flow)
    this%p = this%p + dt * (flow - this%p / R_arteries) / C_arteries
  end subroutine advance
end module flow_circulation
