! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77_resistance.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The external subroutines for the resistance. The conventions are those of riis_f77.f90.

!> Adds the resistance K = (R / eps) delta(d) to the caller's array, so that several valves add up. At the distance
!! d < eps delta(d) is (1 + cos(pi d / eps)) / (2 eps). Errors: RIIS_INVALID_ARGUMENT for an argument out of range,
!! another number of nodes, or a field that the marks lack.
subroutine riisf_add_resistance(marks, R, half_thickness, rim, n_nodes, K, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_resistance, riis_status, RIIS_OK, riis_resistance_init
  use riis_calls, only: add_resistance_to
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(inout) :: K(*)                   !< (n_nodes): K is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  status = riis_resistance_init(made, c_sizeof(made))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  status = add_resistance_to(c_handle_of(marks), made, int(n_nodes, int64), K)
end subroutine riisf_add_resistance

!> Does the same.
subroutine riisf_add_resistance_64(marks, R, half_thickness, rim, n_nodes, K, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_resistance, riis_status, RIIS_OK, riis_resistance_init
  use riis_calls, only: add_resistance_to
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(inout) :: K(*)                   !< (n_nodes): K is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  status = riis_resistance_init(made, c_sizeof(made))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  status = add_resistance_to(c_handle_of(marks), made, int(n_nodes, int64), K)
end subroutine riisf_add_resistance_64

!> The same for a surface that moves: adds K u_surface also. A scheme takes (sum of K) u - (sum of K u_surface).
subroutine riisf_add_moving_resistance(marks, R, half_thickness, rim, n_nodes, K, K_u_surface, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_resistance, riis_status, RIIS_OK, riis_resistance_init
  use riis_calls, only: add_resistance_to
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< Of riisf_mark_with_fields with RIIS_FIELD_VELOCITY.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(inout) :: K(*)                   !< (n_nodes): K is added.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, n_nodes): K u_surface is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  status = riis_resistance_init(made, c_sizeof(made))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  status = add_resistance_to(c_handle_of(marks), made, int(n_nodes, int64), K, K_u_surface)
end subroutine riisf_add_moving_resistance

!> Does the same.
subroutine riisf_add_moving_resistance_64(marks, R, half_thickness, rim, n_nodes, K, K_u_surface, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_resistance, riis_status, RIIS_OK, riis_resistance_init
  use riis_calls, only: add_resistance_to
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< Of riisf_mark_with_fields with RIIS_FIELD_VELOCITY.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(inout) :: K(*)                   !< (n_nodes): K is added.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, n_nodes): K u_surface is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  status = riis_resistance_init(made, c_sizeof(made))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  status = add_resistance_to(c_handle_of(marks), made, int(n_nodes, int64), K, K_u_surface)
end subroutine riisf_add_moving_resistance_64

!> Adds the force of the flow on the surface, the sum of weight K (velocity - u_surface). Ranks add theirs by a reduction.
!! u_surface counts where the marking had RIIS_FIELD_VELOCITY, and is 0 otherwise. Errors: as of riisf_add_resistance.
subroutine riisf_add_reaction(marks, R, half_thickness, rim, n_nodes, velocity, weight, force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_resistance, riis_status, RIIS_OK, riis_resistance_init
  use riis_calls, only: add_reaction_to
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< Of a call of riisf_mark_nodes or riisf_mark_with_fields.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), of the flow.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that a node stands for; 0 for the nodes
                                                          !! of other ranks.
  real(c_double), intent(inout) :: force(3)               !< Added to.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  status = riis_resistance_init(made, c_sizeof(made))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  status = add_reaction_to(c_handle_of(marks), made, int(n_nodes, int64), velocity, weight, force)
end subroutine riisf_add_reaction

!> Does the same.
subroutine riisf_add_reaction_64(marks, R, half_thickness, rim, n_nodes, velocity, weight, force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_resistance, riis_status, RIIS_OK, riis_resistance_init
  use riis_calls, only: add_reaction_to
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< Of a call of riisf_mark_nodes or riisf_mark_with_fields.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), of the flow.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that a node stands for; 0 for the nodes
                                                          !! of other ranks.
  real(c_double), intent(inout) :: force(3)               !< Added to.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  status = riis_resistance_init(made, c_sizeof(made))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  status = add_reaction_to(c_handle_of(marks), made, int(n_nodes, int64), velocity, weight, force)
end subroutine riisf_add_reaction_64

!> Sums a value, such as the pressure, over the nodes at a distance from inner to outer, by side. Nodes whose closest point
!! is on the rim, or that are on neither side, are left out. With an open valve the two sides have no meaning. Errors:
!! RIIS_INVALID_ARGUMENT for a distance out of range, another number of nodes, or a field that the marks lack.
subroutine riisf_band_sums(marks, inner, outer, n_nodes, value, weight, sum_of_values, sum_of_weights, n_in_band, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_band_sums, riis_status, RIIS_OK
  use riis_calls, only: band_sums_of
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< Of riisf_mark_with_fields with RIIS_FIELD_SIDE and _RIM.
  real(c_double), intent(in) :: inner                     !< Mesh units, from 0 to outer.
  real(c_double), intent(in) :: outer                     !< Mesh units, at most the distance limit of the marking.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: value(*)                  !< (n_nodes).
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that a node stands for; 0 for the nodes
                                                          !! of other ranks.
  real(c_double), intent(inout) :: sum_of_values(2)       !< Of weight * value: 1 is upstream, 2 downstream.
  real(c_double), intent(inout) :: sum_of_weights(2)      !< Of weight.
  integer(int64), intent(inout) :: n_in_band(2)           !< How many nodes. INTEGER*8.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_band_sums) :: sums
  status = band_sums_of(c_handle_of(marks), inner, outer, int(n_nodes, int64), value, weight, sums)
  if (status /= RIIS_OK) return
  sum_of_values = sums%sum
  sum_of_weights = sums%weight
  n_in_band = sums%n_nodes
end subroutine riisf_band_sums

!> Does the same.
subroutine riisf_band_sums_64(marks, inner, outer, n_nodes, value, weight, sum_of_values, sum_of_weights, n_in_band, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_band_sums, riis_status, RIIS_OK
  use riis_calls, only: band_sums_of
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< Of riisf_mark_with_fields with RIIS_FIELD_SIDE and _RIM.
  real(c_double), intent(in) :: inner                     !< Mesh units, from 0 to outer.
  real(c_double), intent(in) :: outer                     !< Mesh units, at most the distance limit of the marking.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: value(*)                  !< (n_nodes).
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that a node stands for; 0 for the nodes
                                                          !! of other ranks.
  real(c_double), intent(inout) :: sum_of_values(2)       !< Of weight * value: 1 is upstream, 2 downstream.
  real(c_double), intent(inout) :: sum_of_weights(2)      !< Of weight.
  integer(int64), intent(inout) :: n_in_band(2)           !< How many nodes. INTEGER*8.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_band_sums) :: sums
  status = band_sums_of(c_handle_of(marks), inner, outer, int(n_nodes, int64), value, weight, sums)
  if (status /= RIIS_OK) return
  sum_of_values = sums%sum
  sum_of_weights = sums%weight
  n_in_band = sums%n_nodes
end subroutine riisf_band_sums_64
