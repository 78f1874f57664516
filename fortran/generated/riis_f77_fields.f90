! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77_fields.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The external subroutines for the fields of closest points. The conventions are those of riis_f77.f90.

!> Marks nodes like riisf_mark_nodes, and the marks also keep fields of the closest points. Errors: RIIS_INVALID_ARGUMENT for
!! fields that the surface lacks, such as RIIS_FIELD_VELOCITY without riisf_surface_update_moving.
subroutine riisf_mark_with_fields(surface, mesh, distance_limit, search, n_threads, fields, marks, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_options, riis_status, RIIS_OK, riis_mark_nodes, riis_mark_options_init, &
    riis_marks_create, riis_marks_destroy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: mesh                      !< Must be created.
  real(c_double), intent(in) :: distance_limit            !< Nodes get their distance up to this limit; RIIS_AUTO: the half
                                                          !! thickness.
  integer(int32), intent(in) :: search                    !< RIIS_SEARCH_*, usually RIIS_SEARCH_AUTO.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(in) :: fields                    !< A sum of RIIS_FIELD_*; 0: none.
  integer(int64), intent(inout) :: marks                  !< 0, which creates one, or from an earlier call.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  type(c_ptr) :: c_handle
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%distance_limit = distance_limit
  options%search = search
  options%n_threads = n_threads
  options%fields = fields
  c_handle = c_handle_of(marks)
  if (marks == 0) status = riis_marks_create(c_handle)
  if (status == RIIS_OK) status = riis_mark_nodes(c_handle_of(surface), c_handle_of(mesh), options, c_handle)
  if (status /= RIIS_OK .and. marks == 0) call riis_marks_destroy(c_handle) ! the handle stays 0, as before the call
  marks = handle_of(c_handle)
end subroutine riisf_mark_with_fields

!> Copies a field of the nodes that are marked into the caller's array,
!! in the order of riisf_marked. RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC and _VELOCITY have three
!! values per node, RIIS_FIELD_UV two, RIIS_FIELD_GRADIENT one for each direction. Errors: RIIS_INVALID_ARGUMENT for another
!! field, or if the array is too short; only n is then written.
subroutine riisf_marked_reals(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_MARKED, &
    RIIS_FIELD_POINT, RIIS_FIELD_NORMAL, RIIS_FIELD_BARYCENTRIC, &
    RIIS_FIELD_UV, RIIS_FIELD_VELOCITY, RIIS_FIELD_GRADIENT
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int32), intent(in) :: length                    !< The number of nodes for which the array has room.
  integer(int32), intent(inout) :: n                      !< The number of nodes, even if the array is too short.
  real(c_double), intent(inout) :: values(*)              !< (3, length), (2, length) for RIIS_FIELD_UV, or (number of
                                                          !! directions, length); written up to n.
  real(c_double), pointer :: kept(:)
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: fields
  type(c_ptr) :: location
  integer(int64) :: n_values
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, fields, c_sizeof(fields))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_POINT)
    location = fields%point
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_NORMAL)
    location = fields%normal
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_BARYCENTRIC)
    location = fields%barycentric
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_UV)
    location = fields%uv
    n_values = 2 * fields%n_nodes
  case (RIIS_FIELD_VELOCITY)
    location = fields%velocity
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_GRADIENT)
    location = fields%distance_gradient
    n_values = fields%n_directions * fields%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
      '; it must be one of RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC, _UV, _VELOCITY, _GRADIENT')
    return
  end select
  n = int(min(fields%n_nodes, int(huge(n), int64)), int32)
  if (fields%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
      text_of(fields%n_nodes))
  else if (c_associated(location)) then
    call c_f_pointer(location, kept, [n_values])
    values(:n_values) = kept
  else if (fields%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
  end if
end subroutine riisf_marked_reals

!> Does the same.
subroutine riisf_marked_reals_64(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_MARKED, &
    RIIS_FIELD_POINT, RIIS_FIELD_NORMAL, RIIS_FIELD_BARYCENTRIC, &
    RIIS_FIELD_UV, RIIS_FIELD_VELOCITY, RIIS_FIELD_GRADIENT
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int64), intent(in) :: length                    !< The number of nodes for which the array has room.
  integer(int64), intent(inout) :: n                      !< The number of nodes, even if the array is too short.
  real(c_double), intent(inout) :: values(*)              !< (3, length), (2, length) for RIIS_FIELD_UV, or (number of
                                                          !! directions, length); written up to n.
  real(c_double), pointer :: kept(:)
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: fields
  type(c_ptr) :: location
  integer(int64) :: n_values
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, fields, c_sizeof(fields))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_POINT)
    location = fields%point
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_NORMAL)
    location = fields%normal
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_BARYCENTRIC)
    location = fields%barycentric
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_UV)
    location = fields%uv
    n_values = 2 * fields%n_nodes
  case (RIIS_FIELD_VELOCITY)
    location = fields%velocity
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_GRADIENT)
    location = fields%distance_gradient
    n_values = fields%n_directions * fields%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
      '; it must be one of RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC, _UV, _VELOCITY, _GRADIENT')
    return
  end select
  n = int(min(fields%n_nodes, int(huge(n), int64)), int64)
  if (fields%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
      text_of(fields%n_nodes))
  else if (c_associated(location)) then
    call c_f_pointer(location, kept, [n_values])
    values(:n_values) = kept
  else if (fields%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
  end if
end subroutine riisf_marked_reals_64

!> Copies the field RIIS_FIELD_SIDE, RIIS_FIELD_RIM or RIIS_FIELD_PATCH, which has one value per node.
subroutine riisf_marked_integers(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_MARKED, &
    RIIS_FIELD_SIDE, RIIS_FIELD_RIM, RIIS_FIELD_PATCH
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int32), intent(in) :: length                    !< The number of nodes for which the array has room.
  integer(int32), intent(inout) :: n                      !< The number of nodes, even if the array is too short.
  integer(int32), intent(inout) :: values(*)              !< (length); written up to n.
  integer(int32), pointer :: kept(:)
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: fields
  type(c_ptr) :: location
  integer(int64) :: n_values
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, fields, c_sizeof(fields))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_SIDE)
    location = fields%side
    n_values = fields%n_nodes
  case (RIIS_FIELD_RIM)
    location = fields%rim
    n_values = fields%n_nodes
  case (RIIS_FIELD_PATCH)
    location = fields%patch_id
    n_values = fields%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
      '; it must be one of RIIS_FIELD_SIDE, _RIM, _PATCH')
    return
  end select
  n = int(min(fields%n_nodes, int(huge(n), int64)), int32)
  if (fields%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
      text_of(fields%n_nodes))
  else if (c_associated(location)) then
    call c_f_pointer(location, kept, [n_values])
    values(:n_values) = kept
  else if (fields%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
  end if
end subroutine riisf_marked_integers

!> Does the same.
subroutine riisf_marked_integers_64(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_MARKED, &
    RIIS_FIELD_SIDE, RIIS_FIELD_RIM, RIIS_FIELD_PATCH
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int64), intent(in) :: length                    !< The number of nodes for which the array has room.
  integer(int64), intent(inout) :: n                      !< The number of nodes, even if the array is too short.
  integer(int32), intent(inout) :: values(*)              !< (length); written up to n.
  integer(int32), pointer :: kept(:)
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: fields
  type(c_ptr) :: location
  integer(int64) :: n_values
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, fields, c_sizeof(fields))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_SIDE)
    location = fields%side
    n_values = fields%n_nodes
  case (RIIS_FIELD_RIM)
    location = fields%rim
    n_values = fields%n_nodes
  case (RIIS_FIELD_PATCH)
    location = fields%patch_id
    n_values = fields%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
      '; it must be one of RIIS_FIELD_SIDE, _RIM, _PATCH')
    return
  end select
  n = int(min(fields%n_nodes, int(huge(n), int64)), int64)
  if (fields%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
      text_of(fields%n_nodes))
  else if (c_associated(location)) then
    call c_f_pointer(location, kept, [n_values])
    values(:n_values) = kept
  else if (fields%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
  end if
end subroutine riisf_marked_integers_64

!> Copies a field of the nodes within the distance limit into the caller's array,
!! in the order of riisf_within_limit. RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC and _VELOCITY have three
!! values per node, RIIS_FIELD_UV two, RIIS_FIELD_GRADIENT one for each direction. Errors: RIIS_INVALID_ARGUMENT for another
!! field, or if the array is too short; only n is then written.
subroutine riisf_within_limit_reals(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_WITHIN_LIMIT, &
    RIIS_FIELD_POINT, RIIS_FIELD_NORMAL, RIIS_FIELD_BARYCENTRIC, &
    RIIS_FIELD_UV, RIIS_FIELD_VELOCITY, RIIS_FIELD_GRADIENT
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int32), intent(in) :: length                    !< The number of nodes for which the array has room.
  integer(int32), intent(inout) :: n                      !< The number of nodes, even if the array is too short.
  real(c_double), intent(inout) :: values(*)              !< (3, length), (2, length) for RIIS_FIELD_UV, or (number of
                                                          !! directions, length); written up to n.
  real(c_double), pointer :: kept(:)
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: fields
  type(c_ptr) :: location
  integer(int64) :: n_values
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, fields, c_sizeof(fields))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_POINT)
    location = fields%point
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_NORMAL)
    location = fields%normal
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_BARYCENTRIC)
    location = fields%barycentric
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_UV)
    location = fields%uv
    n_values = 2 * fields%n_nodes
  case (RIIS_FIELD_VELOCITY)
    location = fields%velocity
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_GRADIENT)
    location = fields%distance_gradient
    n_values = fields%n_directions * fields%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
      '; it must be one of RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC, _UV, _VELOCITY, _GRADIENT')
    return
  end select
  n = int(min(fields%n_nodes, int(huge(n), int64)), int32)
  if (fields%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
      text_of(fields%n_nodes))
  else if (c_associated(location)) then
    call c_f_pointer(location, kept, [n_values])
    values(:n_values) = kept
  else if (fields%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
  end if
end subroutine riisf_within_limit_reals

!> Does the same.
subroutine riisf_within_limit_reals_64(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_WITHIN_LIMIT, &
    RIIS_FIELD_POINT, RIIS_FIELD_NORMAL, RIIS_FIELD_BARYCENTRIC, &
    RIIS_FIELD_UV, RIIS_FIELD_VELOCITY, RIIS_FIELD_GRADIENT
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int64), intent(in) :: length                    !< The number of nodes for which the array has room.
  integer(int64), intent(inout) :: n                      !< The number of nodes, even if the array is too short.
  real(c_double), intent(inout) :: values(*)              !< (3, length), (2, length) for RIIS_FIELD_UV, or (number of
                                                          !! directions, length); written up to n.
  real(c_double), pointer :: kept(:)
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: fields
  type(c_ptr) :: location
  integer(int64) :: n_values
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, fields, c_sizeof(fields))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_POINT)
    location = fields%point
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_NORMAL)
    location = fields%normal
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_BARYCENTRIC)
    location = fields%barycentric
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_UV)
    location = fields%uv
    n_values = 2 * fields%n_nodes
  case (RIIS_FIELD_VELOCITY)
    location = fields%velocity
    n_values = 3 * fields%n_nodes
  case (RIIS_FIELD_GRADIENT)
    location = fields%distance_gradient
    n_values = fields%n_directions * fields%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
      '; it must be one of RIIS_FIELD_POINT, _NORMAL, _BARYCENTRIC, _UV, _VELOCITY, _GRADIENT')
    return
  end select
  n = int(min(fields%n_nodes, int(huge(n), int64)), int64)
  if (fields%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
      text_of(fields%n_nodes))
  else if (c_associated(location)) then
    call c_f_pointer(location, kept, [n_values])
    values(:n_values) = kept
  else if (fields%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
  end if
end subroutine riisf_within_limit_reals_64

!> Copies the field RIIS_FIELD_SIDE, RIIS_FIELD_RIM or RIIS_FIELD_PATCH, which has one value per node.
subroutine riisf_within_limit_integers(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_WITHIN_LIMIT, &
    RIIS_FIELD_SIDE, RIIS_FIELD_RIM, RIIS_FIELD_PATCH
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int32), intent(in) :: length                    !< The number of nodes for which the array has room.
  integer(int32), intent(inout) :: n                      !< The number of nodes, even if the array is too short.
  integer(int32), intent(inout) :: values(*)              !< (length); written up to n.
  integer(int32), pointer :: kept(:)
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: fields
  type(c_ptr) :: location
  integer(int64) :: n_values
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, fields, c_sizeof(fields))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_SIDE)
    location = fields%side
    n_values = fields%n_nodes
  case (RIIS_FIELD_RIM)
    location = fields%rim
    n_values = fields%n_nodes
  case (RIIS_FIELD_PATCH)
    location = fields%patch_id
    n_values = fields%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
      '; it must be one of RIIS_FIELD_SIDE, _RIM, _PATCH')
    return
  end select
  n = int(min(fields%n_nodes, int(huge(n), int64)), int32)
  if (fields%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
      text_of(fields%n_nodes))
  else if (c_associated(location)) then
    call c_f_pointer(location, kept, [n_values])
    values(:n_values) = kept
  else if (fields%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
  end if
end subroutine riisf_within_limit_integers

!> Does the same.
subroutine riisf_within_limit_integers_64(marks, field, length, n, values, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_list, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_marks_get_list, RIIS_LIST_WITHIN_LIMIT, &
    RIIS_FIELD_SIDE, RIIS_FIELD_RIM, RIIS_FIELD_PATCH
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_with_fields.
  integer(int32), intent(in) :: field                     !< One of RIIS_FIELD_*.
  integer(int64), intent(in) :: length                    !< The number of nodes for which the array has room.
  integer(int64), intent(inout) :: n                      !< The number of nodes, even if the array is too short.
  integer(int32), intent(inout) :: values(*)              !< (length); written up to n.
  integer(int32), pointer :: kept(:)
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: fields
  type(c_ptr) :: location
  integer(int64) :: n_values
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, fields, c_sizeof(fields))
  if (status /= RIIS_OK) return
  select case (field)
  case (RIIS_FIELD_SIDE)
    location = fields%side
    n_values = fields%n_nodes
  case (RIIS_FIELD_RIM)
    location = fields%rim
    n_values = fields%n_nodes
  case (RIIS_FIELD_PATCH)
    location = fields%patch_id
    n_values = fields%n_nodes
  case default
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // &
      '; it must be one of RIIS_FIELD_SIDE, _RIM, _PATCH')
    return
  end select
  n = int(min(fields%n_nodes, int(huge(n), int64)), int64)
  if (fields%n_nodes > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
      text_of(fields%n_nodes))
  else if (c_associated(location)) then
    call c_f_pointer(location, kept, [n_values])
    values(:n_values) = kept
  else if (fields%n_nodes > 0) then
    status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // ', which the marking did not keep')
  end if
end subroutine riisf_within_limit_integers_64
