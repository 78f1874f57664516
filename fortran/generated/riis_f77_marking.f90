! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77_marking.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The external subroutines for marking. The conventions are those of riis_f77.f90.

!> Finds every node whose distance to the surface is at most the half thickness (marked) or the distance limit. Use the same marks
!! in every time step, because they keep their memory. Errors: RIIS_INVALID_ARGUMENT for an option out of range; the marks are
!! then as they were.
subroutine riisf_mark_nodes(surface, mesh, distance_limit, search, n_threads, marks, status)
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
  integer(int64), intent(inout) :: marks                  !< 0, which creates one, or from an earlier call.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  type(c_ptr) :: c_handle
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%distance_limit = distance_limit
  options%search = search
  options%n_threads = n_threads
  c_handle = c_handle_of(marks)
  if (marks == 0) status = riis_marks_create(c_handle)
  if (status == RIIS_OK) status = riis_mark_nodes(c_handle_of(surface), c_handle_of(mesh), options, c_handle)
  if (status /= RIIS_OK .and. marks == 0) call riis_marks_destroy(c_handle) ! the handle stays 0, as before the call
  marks = handle_of(c_handle)
end subroutine riisf_mark_nodes

!> Copies the marked nodes into the caller's arrays, ascending by node. Errors: RIIS_INVALID_ARGUMENT if the arrays are too
!! short; only n is then written.
subroutine riisf_marked(marks, length, n, node_num, distance, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_LIMIT_EXCEEDED, RIIS_OK, riis_mark_list, riis_marks_get_list, &
    RIIS_LIST_MARKED
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int32), intent(in) :: length                    !< The length of the arrays.
  integer(int32), intent(inout) :: n                      !< The number of nodes, even if the arrays are too short.
  integer(int32), intent(inout) :: node_num(*)            !< (length): counted from 1; written up to n.
  real(c_double), intent(inout) :: distance(*)            !< (length): mesh units; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  integer(int64), pointer :: ids(:)
  real(c_double), pointer :: near(:)
  integer(int64) :: found
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  found = list%n_nodes
  n = int(min(found, int(huge(n), int64)), int32)
  if (found > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
      text_of(found))
    return
  end if
  if (found == 0) return
  call c_f_pointer(list%node_id, ids, [found])
  call c_f_pointer(list%distance, near, [found])
  if (ids(found) >= huge(n)) then
    status = fail(RIIS_LIMIT_EXCEEDED, 'node ' // text_of(ids(found)) // &
      ' is more than an INTEGER*4 can count: use riisf_marked_64')
    return
  end if
  node_num(:n) = int(ids(:n) + 1, int32)
  distance(:n) = near
end subroutine riisf_marked

!> Does the same.
subroutine riisf_marked_64(marks, length, n, node_num, distance, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_mark_list, riis_marks_get_list, &
    RIIS_LIST_MARKED
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int64), intent(in) :: length                    !< The length of the arrays.
  integer(int64), intent(inout) :: n                      !< The number of nodes, even if the arrays are too short.
  integer(int64), intent(inout) :: node_num(*)            !< (length): counted from 1; written up to n.
  real(c_double), intent(inout) :: distance(*)            !< (length): mesh units; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  integer(int64), pointer :: ids(:)
  real(c_double), pointer :: near(:)
  integer(int64) :: found
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_MARKED, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  found = list%n_nodes
  n = int(min(found, int(huge(n), int64)), int64)
  if (found > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes that are marked: ' // &
      text_of(found))
    return
  end if
  if (found == 0) return
  call c_f_pointer(list%node_id, ids, [found])
  call c_f_pointer(list%distance, near, [found])
  node_num(:n) = int(ids(:n) + 1, int64)
  distance(:n) = near
end subroutine riisf_marked_64

!> Copies all nodes within the distance limit, marked or not, into the caller's arrays, ascending by node. Errors:
!! RIIS_INVALID_ARGUMENT if the arrays are too short; only n is then written.
subroutine riisf_within_limit(marks, length, n, node_num, distance, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_LIMIT_EXCEEDED, RIIS_OK, riis_mark_list, riis_marks_get_list, &
    RIIS_LIST_WITHIN_LIMIT
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int32), intent(in) :: length                    !< The length of the arrays.
  integer(int32), intent(inout) :: n                      !< The number of nodes, even if the arrays are too short.
  integer(int32), intent(inout) :: node_num(*)            !< (length): counted from 1; written up to n.
  real(c_double), intent(inout) :: distance(*)            !< (length): mesh units; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  integer(int64), pointer :: ids(:)
  real(c_double), pointer :: near(:)
  integer(int64) :: found
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  found = list%n_nodes
  n = int(min(found, int(huge(n), int64)), int32)
  if (found > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
      text_of(found))
    return
  end if
  if (found == 0) return
  call c_f_pointer(list%node_id, ids, [found])
  call c_f_pointer(list%distance, near, [found])
  if (ids(found) >= huge(n)) then
    status = fail(RIIS_LIMIT_EXCEEDED, 'node ' // text_of(ids(found)) // &
      ' is more than an INTEGER*4 can count: use riisf_within_limit_64')
    return
  end if
  node_num(:n) = int(ids(:n) + 1, int32)
  distance(:n) = near
end subroutine riisf_within_limit

!> Does the same.
subroutine riisf_within_limit_64(marks, length, n, node_num, distance, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_mark_list, riis_marks_get_list, &
    RIIS_LIST_WITHIN_LIMIT
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int64), intent(in) :: length                    !< The length of the arrays.
  integer(int64), intent(inout) :: n                      !< The number of nodes, even if the arrays are too short.
  integer(int64), intent(inout) :: node_num(*)            !< (length): counted from 1; written up to n.
  real(c_double), intent(inout) :: distance(*)            !< (length): mesh units; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_list) :: list
  integer(int64), pointer :: ids(:)
  real(c_double), pointer :: near(:)
  integer(int64) :: found
  status = riis_marks_get_list(c_handle_of(marks), RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list))
  if (status /= RIIS_OK) return
  found = list%n_nodes
  n = int(min(found, int(huge(n), int64)), int64)
  if (found > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; nodes within the distance limit: ' // &
      text_of(found))
    return
  end if
  if (found == 0) return
  call c_f_pointer(list%node_id, ids, [found])
  call c_f_pointer(list%distance, near, [found])
  node_num(:n) = int(ids(:n) + 1, int64)
  distance(:n) = near
end subroutine riisf_within_limit_64

!> Writes every node's distance. Errors: RIIS_INVALID_ARGUMENT for a far_distance within the distance limit.
subroutine riisf_dense_distance(marks, n_nodes, far_distance, distance, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status
  use riis_calls, only: write_dense
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  real(c_double), intent(in) :: far_distance              !< The distance of other nodes, outside [0, distance_limit]; usually
                                                          !! RIIS_FAR_DISTANCE.
  real(c_double), intent(inout) :: distance(*)            !< (n_nodes): for nodes within the distance limit, else far_distance.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = write_dense(c_handle_of(marks), int(n_nodes, int64), far_distance, distance=distance)
end subroutine riisf_dense_distance

!> Writes every node's closest triangle.
subroutine riisf_dense_triangle(marks, n_nodes, triangle_id, status)
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_FAR_DISTANCE
  use riis_calls, only: write_dense
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  integer(int64), intent(inout) :: triangle_id(*)         !< (n_nodes): from 0, for nodes within the distance limit, else -1.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = write_dense(c_handle_of(marks), int(n_nodes, int64), RIIS_FAR_DISTANCE, triangle_id=triangle_id)
end subroutine riisf_dense_triangle

!> Writes every node's closest leaflet.
subroutine riisf_dense_leaflet(marks, n_nodes, leaflet_id, status)
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_FAR_DISTANCE
  use riis_calls, only: write_dense
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (n_nodes): RIIS_LEAFLET_* for nodes within the distance limit, else
                                                          !! -1.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = write_dense(c_handle_of(marks), int(n_nodes, int64), RIIS_FAR_DISTANCE, leaflet_id=leaflet_id)
end subroutine riisf_dense_leaflet

!> Writes every node's mark.
subroutine riisf_dense_mark(marks, n_nodes, mark, status)
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c, only: riis_status, RIIS_FAR_DISTANCE, RIIS_OK
  use riis_calls, only: write_dense
  use riis_support, only: c_handle_of, out_of_memory
  implicit none
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes.
  integer(int32), intent(inout) :: mark(*)                !< (n_nodes): 1 for marked nodes, else 0.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  integer(int8), allocatable :: bytes(:)
  integer :: stat
  allocate (bytes(max(n_nodes, 0_int32)), stat=stat)
  status = out_of_memory(stat)
  if (status == RIIS_OK) status = write_dense(c_handle_of(marks), int(n_nodes, int64), RIIS_FAR_DISTANCE, bytes)
  if (status == RIIS_OK) mark(:n_nodes) = bytes
end subroutine riisf_dense_mark

!> Destroys the marks and sets their handle to 0. Nothing happens to a handle that is 0.
subroutine riisf_marks_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_marks_destroy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_marks_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_marks_destroy
