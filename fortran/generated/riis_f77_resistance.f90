! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77_resistance.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The external subroutines for the resistance. The conventions are those of riis_f77.f90.

!> Marks nodes like riisf_mark_with_fields, and also computes K and K u_surface of the nodes in the lists. K u_surface exists if
!! the surface has velocities. Errors: RIIS_INVALID_ARGUMENT for an argument out of range.
subroutine riisf_mark_with_resistance(surface, mesh, distance_limit, search, n_threads, fields, R, half_thickness, rim, marks, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_options, riis_resistance, riis_status, RIIS_OK, riis_mark_nodes, riis_mark_options_init, &
    riis_marks_create, riis_marks_destroy, riis_resistance_init
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: mesh                      !< Must be created.
  real(c_double), intent(in) :: distance_limit            !< Nodes get their distance up to this limit; RIIS_AUTO: the half
                                                          !! thickness.
  integer(int32), intent(in) :: search                    !< RIIS_SEARCH_*, usually RIIS_SEARCH_AUTO.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(in) :: fields                    !< A sum of RIIS_FIELD_*; 0: none.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit; RIIS_AUTO: the half thickness.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND or RIIS_RIM_CUT.
  integer(int64), intent(inout) :: marks                  !< 0, which creates them, or from an earlier call.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  type(riis_resistance), target :: made
  type(c_ptr) :: c_handle
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_resistance_init(made, c_sizeof(made))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  options%distance_limit = distance_limit
  options%search = search
  options%n_threads = n_threads
  options%fields = fields
  options%resistance = c_loc(made)
  c_handle = c_handle_of(marks)
  if (marks == 0) status = riis_marks_create(c_handle)
  if (status == RIIS_OK) status = riis_mark_nodes(c_handle_of(surface), c_handle_of(mesh), options, c_handle)
  if (status /= RIIS_OK .and. marks == 0) call riis_marks_destroy(c_handle) ! the handle stays 0, as before the call
  marks = handle_of(c_handle)
end subroutine riisf_mark_with_resistance

!> Copies K and K u_surface of the nodes that are marked, in the order of riisf_marked.
!! Without velocities K u_surface is zero. Errors: RIIS_INVALID_ARGUMENT without riisf_mark_with_resistance, or if the arrays are
!! too short; only n is then written.
subroutine riisf_marked_resistance(marks, length, n, K, K_u_surface, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_MARKED
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_resistance.
  integer(int32), intent(in) :: length                    !< The number of nodes for which the arrays have room.
  integer(int32), intent(inout) :: n                      !< The number of nodes, even if the arrays are too short.
  real(c_double), intent(inout) :: K(*)                   !< (length); written up to n.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  real(c_double), pointer :: own(:), own_vectors(:, :)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int32)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
      text_of(list%n_nodes))
  else if (c_associated(list%K)) then
    call c_f_pointer(list%K, own, [list%n_nodes])
    K(:n) = own
    K_u_surface(:, :n) = 0
    if (.not. c_associated(list%K_u_surface)) return
    call c_f_pointer(list%K_u_surface, own_vectors, [3_int64, list%n_nodes])
    K_u_surface(:, :n) = own_vectors
  else if (list%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'the nodes have no K: mark with riisf_mark_with_resistance')
  end if
end subroutine riisf_marked_resistance

!> Does the same.
subroutine riisf_marked_resistance_64(marks, length, n, K, K_u_surface, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_MARKED
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_resistance.
  integer(int64), intent(in) :: length                    !< The number of nodes for which the arrays have room.
  integer(int64), intent(inout) :: n                      !< The number of nodes, even if the arrays are too short.
  real(c_double), intent(inout) :: K(*)                   !< (length); written up to n.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  real(c_double), pointer :: own(:), own_vectors(:, :)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int64)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
      text_of(list%n_nodes))
  else if (c_associated(list%K)) then
    call c_f_pointer(list%K, own, [list%n_nodes])
    K(:n) = own
    K_u_surface(:, :n) = 0
    if (.not. c_associated(list%K_u_surface)) return
    call c_f_pointer(list%K_u_surface, own_vectors, [3_int64, list%n_nodes])
    K_u_surface(:, :n) = own_vectors
  else if (list%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'the nodes have no K: mark with riisf_mark_with_resistance')
  end if
end subroutine riisf_marked_resistance_64

!> Copies K and K u_surface of the nodes within the distance limit, in the order of riisf_within_limit.
!! Without velocities K u_surface is zero. Errors: RIIS_INVALID_ARGUMENT without riisf_mark_with_resistance, or if the arrays are
!! too short; only n is then written.
subroutine riisf_within_limit_resistance(marks, length, n, K, K_u_surface, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_WITHIN_LIMIT
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_resistance.
  integer(int32), intent(in) :: length                    !< The number of nodes for which the arrays have room.
  integer(int32), intent(inout) :: n                      !< The number of nodes, even if the arrays are too short.
  real(c_double), intent(inout) :: K(*)                   !< (length); written up to n.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  real(c_double), pointer :: own(:), own_vectors(:, :)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int32)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
      text_of(list%n_nodes))
  else if (c_associated(list%K)) then
    call c_f_pointer(list%K, own, [list%n_nodes])
    K(:n) = own
    K_u_surface(:, :n) = 0
    if (.not. c_associated(list%K_u_surface)) return
    call c_f_pointer(list%K_u_surface, own_vectors, [3_int64, list%n_nodes])
    K_u_surface(:, :n) = own_vectors
  else if (list%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'the nodes have no K: mark with riisf_mark_with_resistance')
  end if
end subroutine riisf_within_limit_resistance

!> Does the same.
subroutine riisf_within_limit_resistance_64(marks, length, n, K, K_u_surface, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_WITHIN_LIMIT
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_resistance.
  integer(int64), intent(in) :: length                    !< The number of nodes for which the arrays have room.
  integer(int64), intent(inout) :: n                      !< The number of nodes, even if the arrays are too short.
  real(c_double), intent(inout) :: K(*)                   !< (length); written up to n.
  real(c_double), intent(inout) :: K_u_surface(3, *)      !< (3, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  real(c_double), pointer :: own(:), own_vectors(:, :)
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  n = int(min(list%n_nodes, int(huge(n), int64)), int64)
  if (list%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
      text_of(list%n_nodes))
  else if (c_associated(list%K)) then
    call c_f_pointer(list%K, own, [list%n_nodes])
    K(:n) = own
    K_u_surface(:, :n) = 0
    if (.not. c_associated(list%K_u_surface)) return
    call c_f_pointer(list%K_u_surface, own_vectors, [3_int64, list%n_nodes])
    K_u_surface(:, :n) = own_vectors
  else if (list%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'the nodes have no K: mark with riisf_mark_with_resistance')
  end if
end subroutine riisf_within_limit_resistance_64

!> Adds the resistance K = (R / eps) delta(d) to the caller's array, so that several valves add up. At a
!! distance d below eps, delta(d) is (1 + cos(pi d / eps)) / (2 eps). Errors: RIIS_INVALID_ARGUMENT for an argument out of range,
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

!> Adds K like riisf_add_resistance, but for a surface that moves, and also adds K u_surface. A scheme uses (sum of K) u - (sum of
!! K u_surface).
subroutine riisf_add_moving_resistance(marks, R, half_thickness, rim, n_nodes, K, K_u_surface, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_resistance, riis_status, RIIS_OK, riis_resistance_init
  use riis_calls, only: add_resistance_to
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_VELOCITY.
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
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_VELOCITY.
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

!> Adds the force of the flow on the surface: the sum of weight * K * (velocity - u_surface). Ranks sum their forces by a
!! reduction. u_surface is used if the marking had RIIS_FIELD_VELOCITY, and is 0 otherwise. Errors: as for riisf_add_resistance.
subroutine riisf_add_reaction(marks, R, half_thickness, rim, n_nodes, velocity, weight, force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_reaction, riis_resistance, riis_status, RIIS_OK, riis_reaction_init, riis_resistance_init
  use riis_calls, only: add_reaction_to
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes or riisf_mark_with_fields.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that belongs to a node; 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(inout) :: force(3)               !< The force is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  type(riis_reaction) :: to
  status = riis_resistance_init(made, c_sizeof(made))
  if (status == RIIS_OK) status = riis_reaction_init(to, c_sizeof(to))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  to%force = location_of(force)
  status = add_reaction_to(c_handle_of(marks), made, int(n_nodes, int64), velocity, weight, to)
end subroutine riisf_add_reaction

!> Does the same.
subroutine riisf_add_reaction_64(marks, R, half_thickness, rim, n_nodes, velocity, weight, force, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_reaction, riis_resistance, riis_status, RIIS_OK, riis_reaction_init, riis_resistance_init
  use riis_calls, only: add_reaction_to
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes or riisf_mark_with_fields.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that belongs to a node; 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(inout) :: force(3)               !< The force is added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  type(riis_reaction) :: to
  status = riis_resistance_init(made, c_sizeof(made))
  if (status == RIIS_OK) status = riis_reaction_init(to, c_sizeof(to))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  to%force = location_of(force)
  status = add_reaction_to(c_handle_of(marks), made, int(n_nodes, int64), velocity, weight, to)
end subroutine riisf_add_reaction_64

!> Adds the force of the flow and its moment about a point, for the whole surface and for each leaflet. The force of a node acts
!! at the closest point of the surface. Ranks pass the same point, and add their sums by a reduction. Errors: as for
!! riisf_add_reaction; RIIS_INVALID_ARGUMENT also for too few leaflets, naming the leaflet id.
subroutine riisf_add_leaflet_reaction(marks, R, half_thickness, rim, n_nodes, velocity, weight, &
    about, n_leaflets, force, moment, leaflet_force, leaflet_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_reaction, riis_resistance, riis_status, RIIS_OK, riis_reaction_init, riis_resistance_init
  use riis_calls, only: add_reaction_to
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that belongs to a node; 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(in) :: about(3)                  !< Moments are taken about this point.
  integer(int32), intent(in) :: n_leaflets                !< More than the surface's largest leaflet id.
  real(c_double), intent(inout) :: force(3)               !< The force on the whole surface is added.
  real(c_double), intent(inout) :: moment(3)              !< The moment on the whole surface is added.
  real(c_double), intent(inout) :: leaflet_force(3, *)    !< (3, n_leaflets): forces are added; leaflet 0 has column 1.
  real(c_double), intent(inout) :: leaflet_moment(3, *)   !< (3, n_leaflets): moments are added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  type(riis_reaction) :: to
  status = riis_resistance_init(made, c_sizeof(made))
  if (status == RIIS_OK) status = riis_reaction_init(to, c_sizeof(to))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  to%about = about
  to%n_leaflets = n_leaflets
  to%force = location_of(force)
  to%moment = location_of(moment)
  to%leaflet_force = location_of(leaflet_force)
  to%leaflet_moment = location_of(leaflet_moment)
  status = add_reaction_to(c_handle_of(marks), made, int(n_nodes, int64), velocity, weight, to)
end subroutine riisf_add_leaflet_reaction

!> Does the same.
subroutine riisf_add_leaflet_reaction_64(marks, R, half_thickness, rim, n_nodes, velocity, weight, &
    about, n_leaflets, force, moment, leaflet_force, leaflet_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_reaction, riis_resistance, riis_status, RIIS_OK, riis_reaction_init, riis_resistance_init
  use riis_calls, only: add_reaction_to
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that belongs to a node; 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(in) :: about(3)                  !< Moments are taken about this point.
  integer(int32), intent(in) :: n_leaflets                !< More than the surface's largest leaflet id.
  real(c_double), intent(inout) :: force(3)               !< The force on the whole surface is added.
  real(c_double), intent(inout) :: moment(3)              !< The moment on the whole surface is added.
  real(c_double), intent(inout) :: leaflet_force(3, *)    !< (3, n_leaflets): forces are added; leaflet 0 has column 1.
  real(c_double), intent(inout) :: leaflet_moment(3, *)   !< (3, n_leaflets): moments are added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  type(riis_reaction) :: to
  status = riis_resistance_init(made, c_sizeof(made))
  if (status == RIIS_OK) status = riis_reaction_init(to, c_sizeof(to))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  to%about = about
  to%n_leaflets = n_leaflets
  to%force = location_of(force)
  to%moment = location_of(moment)
  to%leaflet_force = location_of(leaflet_force)
  to%leaflet_moment = location_of(leaflet_moment)
  status = add_reaction_to(c_handle_of(marks), made, int(n_nodes, int64), velocity, weight, to)
end subroutine riisf_add_leaflet_reaction_64

!> Adds the force of the flow, and its moment about the edge's middle, to edges. The force of a node goes to the edge nearest to
!! its closest point, or to the first of several equally near edges. The sums of edges are loads for tissue codes. They do not
!! model how a membrane carries loads to its edges. Ranks pass the same edges, and add their sums by a reduction. Errors: as for
!! riisf_add_reaction; RIIS_INVALID_ARGUMENT also for a bad edge, and for a leaflet without an edge.
subroutine riisf_add_edge_reaction(marks, R, half_thickness, rim, n_nodes, velocity, weight, &
    n_edges, edges, edge_leaflet_id, edge_force, edge_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_reaction, riis_resistance, riis_status, RIIS_OK, riis_reaction_init, riis_resistance_init
  use riis_calls, only: add_reaction_to
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that belongs to a node; 0 for nodes of other
                                                          !! ranks.
  integer(int32), intent(in) :: n_edges                   !< At least 1.
  real(c_double), intent(in) :: edges(3, 2, *)            !< (3, 2, n_edges): both ends of each edge.
  integer(int32), intent(in) :: edge_leaflet_id(*)        !< (n_edges): a node's force goes to the nearest edge of its
                                                          !! leaflet. If the first entry is -1, the other entries are not
                                                          !! read, and each edge serves all leaflets.
  real(c_double), intent(inout) :: edge_force(3, *)       !< (3, n_edges): forces are added.
  real(c_double), intent(inout) :: edge_moment(3, *)      !< (3, n_edges): moments about each edge's middle are added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  type(riis_reaction) :: to
  status = riis_resistance_init(made, c_sizeof(made))
  if (status == RIIS_OK) status = riis_reaction_init(to, c_sizeof(to))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  to%n_edges = n_edges
  to%edges = location_of(edges)
  if (edge_leaflet_id(1) /= -1) to%edge_leaflet_id = location_of(edge_leaflet_id)
  to%edge_force = location_of(edge_force)
  to%edge_moment = location_of(edge_moment)
  status = add_reaction_to(c_handle_of(marks), made, int(n_nodes, int64), velocity, weight, to)
end subroutine riisf_add_edge_reaction

!> Does the same.
subroutine riisf_add_edge_reaction_64(marks, R, half_thickness, rim, n_nodes, velocity, weight, &
    n_edges, edges, edge_leaflet_id, edge_force, edge_moment, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_reaction, riis_resistance, riis_status, RIIS_OK, riis_reaction_init, riis_resistance_init
  use riis_calls, only: add_reaction_to
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_POINT.
  real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
  real(c_double), intent(in) :: half_thickness            !< eps, at most the distance limit of the marking; RIIS_AUTO: the
                                                          !! half thickness of the marking.
  integer(int32), intent(in) :: rim                       !< RIIS_RIM_ROUND, or RIIS_RIM_CUT, which needs RIIS_FIELD_RIM.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: velocity(3, *)            !< (3, n_nodes), the flow's velocity.
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that belongs to a node; 0 for nodes of other
                                                          !! ranks.
  integer(int64), intent(in) :: n_edges                   !< At least 1.
  real(c_double), intent(in) :: edges(3, 2, *)            !< (3, 2, n_edges): both ends of each edge.
  integer(int32), intent(in) :: edge_leaflet_id(*)        !< (n_edges): a node's force goes to the nearest edge of its
                                                          !! leaflet. If the first entry is -1, the other entries are not
                                                          !! read, and each edge serves all leaflets.
  real(c_double), intent(inout) :: edge_force(3, *)       !< (3, n_edges): forces are added.
  real(c_double), intent(inout) :: edge_moment(3, *)      !< (3, n_edges): moments about each edge's middle are added.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_resistance) :: made
  type(riis_reaction) :: to
  status = riis_resistance_init(made, c_sizeof(made))
  if (status == RIIS_OK) status = riis_reaction_init(to, c_sizeof(to))
  if (status /= RIIS_OK) return
  made%R = R
  made%half_thickness = half_thickness
  made%rim = rim
  to%n_edges = n_edges
  to%edges = location_of(edges)
  if (edge_leaflet_id(1) /= -1) to%edge_leaflet_id = location_of(edge_leaflet_id)
  to%edge_force = location_of(edge_force)
  to%edge_moment = location_of(edge_moment)
  status = add_reaction_to(c_handle_of(marks), made, int(n_nodes, int64), velocity, weight, to)
end subroutine riisf_add_edge_reaction_64

!> Sums a value, such as the pressure, over the nodes at a distance from inner to outer, separately for each side. Nodes whose
!! closest point is on the rim, or that are on neither side, are left out. If the valve is open, the two sides have no meaning.
!! Errors: RIIS_INVALID_ARGUMENT for a distance out of range, another number of nodes, or a field that the marks lack.
subroutine riisf_band_sums(marks, inner, outer, n_nodes, value, weight, sum_of_values, sum_of_weights, n_in_band, &
    status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_band_sums, riis_status, RIIS_OK
  use riis_calls, only: band_sums_of
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_SIDE and _RIM.
  real(c_double), intent(in) :: inner                     !< Mesh units, from 0 to outer.
  real(c_double), intent(in) :: outer                     !< Mesh units, at most the distance limit of the marking.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: value(*)                  !< (n_nodes).
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that belongs to a node; 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(inout) :: sum_of_values(2)       !< The sum of weight * value: 1 is upstream, 2 downstream.
  real(c_double), intent(inout) :: sum_of_weights(2)      !< The sum of weight.
  integer(int64), intent(inout) :: n_in_band(2)           !< The number of nodes. INTEGER*8.
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
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields with RIIS_FIELD_SIDE and _RIM.
  real(c_double), intent(in) :: inner                     !< Mesh units, from 0 to outer.
  real(c_double), intent(in) :: outer                     !< Mesh units, at most the distance limit of the marking.
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: value(*)                  !< (n_nodes).
  real(c_double), intent(in) :: weight(*)                 !< (n_nodes), the volume that belongs to a node; 0 for nodes of other
                                                          !! ranks.
  real(c_double), intent(inout) :: sum_of_values(2)       !< The sum of weight * value: 1 is upstream, 2 downstream.
  real(c_double), intent(inout) :: sum_of_weights(2)      !< The sum of weight.
  integer(int64), intent(inout) :: n_in_band(2)           !< The number of nodes. INTEGER*8.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_band_sums) :: sums
  status = band_sums_of(c_handle_of(marks), inner, outer, int(n_nodes, int64), value, weight, sums)
  if (status /= RIIS_OK) return
  sum_of_values = sums%sum
  sum_of_weights = sums%weight
  n_in_band = sums%n_nodes
end subroutine riisf_band_sums_64
