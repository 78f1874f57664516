! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77_leaks.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The external subroutines for leaks. The conventions are those of riis_f77.f90.

!> Finds every edge of the mesh's adjacency that leaks: it crosses the surface between two unmarked nodes. Edges that are at most
!! two half thicknesses long do not leak. Gaps of the surface itself are not found. Errors: RIIS_INVALID_ARGUMENT if the mesh has
!! no adjacency, or if the marks do not come from a marking with this mesh and half thickness.
subroutine riisf_find_leaks(surface, mesh, marks, n_threads, leaks, n_edges, longest, middle, half_thickness, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_leak_list, riis_mark_options, riis_status, RIIS_OK, riis_find_leaks, riis_leaks_create, &
    riis_leaks_destroy, riis_leaks_get_list, riis_mark_options_init
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< The surface of the marking.
  integer(int64), intent(in) :: mesh                      !< The mesh of the marking, with an adjacency.
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: leaks                  !< 0, which creates them, or from an earlier call.
  integer(int64), intent(inout) :: n_edges                !< The number of edges that leak, INTEGER*8.
  real(c_double), intent(inout) :: longest                !< The length of the longest edge; 0 if none leaks.
  real(c_double), intent(inout) :: middle(3)              !< The middle of the longest edge.
  real(c_double), intent(inout) :: half_thickness         !< The smallest half thickness that closes all edges; 0 if none leaks.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  type(riis_leak_list) :: list
  type(c_ptr) :: c_handle
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%n_threads = n_threads
  c_handle = c_handle_of(leaks)
  if (leaks == 0) status = riis_leaks_create(c_handle)
  if (status == RIIS_OK) &
    status = riis_find_leaks(c_handle_of(surface), c_handle_of(mesh), c_handle_of(marks), options, c_handle)
  if (status == RIIS_OK) status = riis_leaks_get_list(c_handle, list, c_sizeof(list))
  if (status /= RIIS_OK .and. leaks == 0) call riis_leaks_destroy(c_handle) ! the handle stays 0, as before the call
  leaks = handle_of(c_handle)
  if (status /= RIIS_OK) return
  n_edges = list%n_edges
  longest = list%longest_length
  middle = list%longest_middle
  half_thickness = list%half_thickness
end subroutine riisf_find_leaks

!> Copies the edges of the last riisf_find_leaks into the caller's array, ascending. Errors: RIIS_INVALID_ARGUMENT if the
!! array is too short; only n is then written.
subroutine riisf_leaking_edges(leaks, length, n, node_num, status)
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_LIMIT_EXCEEDED, RIIS_OK, &
    riis_leak_list, riis_leaks_get_list
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: leaks                     !< From riisf_find_leaks.
  integer(int32), intent(in) :: length                    !< The length of the array.
  integer(int32), intent(inout) :: n                      !< The number of edges, even if the array is too short.
  integer(int32), intent(inout) :: node_num(2, *)         !< (2, length): both nodes, counted from 1; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_leak_list) :: list
  integer(int64), pointer :: ids(:, :)
  integer(int64) :: found
  status = riis_leaks_get_list(c_handle_of(leaks), list, c_sizeof(list))
  if (status /= RIIS_OK) return
  found = list%n_edges
  n = int(min(found, int(huge(n), int64)), int32)
  if (found > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; edges that leak: ' // text_of(found))
    return
  end if
  if (found == 0) return
  call c_f_pointer(list%node_id, ids, [2_int64, found])
  if (maxval(ids) >= huge(n)) then
    status = fail(RIIS_LIMIT_EXCEEDED, 'node ' // text_of(maxval(ids)) // &
      ' is more than an INTEGER*4 can count: use riisf_leaking_edges_64')
    return
  end if
  node_num(:, :n) = int(ids + 1, int32)
end subroutine riisf_leaking_edges

!> Does the same with INTEGER*8.
subroutine riisf_leaking_edges_64(leaks, length, n, node_num, status)
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, &
    riis_leak_list, riis_leaks_get_list
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: leaks                     !< From riisf_find_leaks.
  integer(int64), intent(in) :: length                    !< The length of the array.
  integer(int64), intent(inout) :: n                      !< The number of edges, even if the array is too short.
  integer(int64), intent(inout) :: node_num(2, *)         !< (2, length): both nodes, counted from 1; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_leak_list) :: list
  integer(int64), pointer :: ids(:, :)
  integer(int64) :: found
  status = riis_leaks_get_list(c_handle_of(leaks), list, c_sizeof(list))
  if (status /= RIIS_OK) return
  found = list%n_edges
  n = int(min(found, int(huge(n), int64)), int64)
  if (found > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; edges that leak: ' // text_of(found))
    return
  end if
  if (found == 0) return
  call c_f_pointer(list%node_id, ids, [2_int64, found])
  node_num(:, :n) = int(ids + 1, int64)
end subroutine riisf_leaking_edges_64

!> Destroys the leaks and sets their handle to 0. Nothing happens to a handle that is 0.
subroutine riisf_leaks_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_leaks_destroy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_leaks_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_leaks_destroy

!> Labels the open regions. They are the connected components of unmarked nodes along the edges of the mesh's adjacency. Edges to
!! ghost nodes are ignored. Errors: RIIS_INVALID_ARGUMENT if the mesh has no adjacency, or if the marks do not come from a marking
!! with this mesh.
subroutine riisf_label_open_regions(mesh, marks, n_threads, n_nodes, region_num, n_regions, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_options, riis_status, RIIS_OK, riis_label_open_regions, riis_mark_options_init
  use riis_support, only: c_handle_of, out_of_memory
  implicit none
  integer(int64), intent(in) :: mesh                      !< The mesh of the marking, with an adjacency.
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(in) :: n_nodes                   !< The number of nodes of the marking.
  integer(int32), intent(inout) :: region_num(*)          !< (n_nodes): the lowest node of the node's region, counted from 1;
                                                          !! 0 for marked nodes.
  integer(int32), intent(inout) :: n_regions              !< The number of regions.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  integer(int64) :: found
  integer(int64), allocatable :: label(:)
  integer :: stat
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%n_threads = n_threads
  found = 0
  allocate (label(max(n_nodes, 1)), stat=stat)
  status = out_of_memory(stat)
  if (status == RIIS_OK) status = riis_label_open_regions(c_handle_of(mesh), c_handle_of(marks), options, &
    int(n_nodes, int64), label, found)
  if (status /= RIIS_OK) return
  region_num(:n_nodes) = int(label(:n_nodes) + 1)
  n_regions = int(found, int32)
end subroutine riisf_label_open_regions

!> Works like riisf_label_open_regions, but with INTEGER*8 and without a copy.
subroutine riisf_label_open_regions_64(mesh, marks, n_threads, n_nodes, region_num, n_regions, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_options, riis_status, RIIS_OK, riis_label_open_regions, riis_mark_options_init
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: mesh                      !< The mesh of the marking, with an adjacency.
  integer(int64), intent(in) :: marks                     !< From riisf_mark_nodes.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(in) :: n_nodes                   !< The number of nodes of the marking.
  integer(int64), intent(inout) :: region_num(*)          !< (n_nodes): the lowest node of the node's region, counted from 1;
                                                          !! 0 for marked nodes.
  integer(int64), intent(inout) :: n_regions              !< The number of regions.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  integer(int64) :: found
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%n_threads = n_threads
  found = 0
  status = riis_label_open_regions(c_handle_of(mesh), c_handle_of(marks), options, n_nodes, region_num, found)
  if (status /= RIIS_OK) return
  region_num(:n_nodes) = region_num(:n_nodes) + 1
  n_regions = int(found, int64)
end subroutine riisf_label_open_regions_64

!> Finds the widest passage from one set of nodes to another. It is the path, along the edges of the mesh's adjacency, whose
!! smallest distance to the surface is largest. A path includes its ends. Errors: RIIS_INVALID_ARGUMENT if the mesh has no
!! adjacency, or for a node that the mesh lacks, or that is within the half thickness.
subroutine riisf_find_passage(surface, mesh, n_from, from_num, n_to, to_num, n_threads, state, node_num, distance, &
    point, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_options, riis_passage, riis_status, RIIS_OK, riis_mark_options_init
  use riis_calls, only: find_passage_between
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< A surface.
  integer(int64), intent(in) :: mesh                      !< A mesh with an adjacency. A marking is not needed.
  integer(int32), intent(in) :: n_from                    !< At least 1.
  integer(int32), intent(in) :: from_num(n_from)          !< Nodes where paths begin, counted from 1, in any order.
  integer(int32), intent(in) :: n_to                      !< At least 1.
  integer(int32), intent(in) :: to_num(n_to)              !< Nodes where paths end.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(inout) :: state                  !< RIIS_PASSAGE_*.
  integer(int32), intent(inout) :: node_num               !< The path's node nearest to the surface, from 1; 0 without a path.
  real(c_double), intent(inout) :: distance               !< That node's distance, the smallest half thickness that closes the
                                                          !! path.
  real(c_double), intent(inout) :: point(3)               !< That node's coordinates.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  type(riis_passage) :: passage
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%n_threads = n_threads
  status = find_passage_between(c_handle_of(surface), c_handle_of(mesh), options, int(n_from, int64), &
    int(from_num, int64) - 1, int(n_to, int64), int(to_num, int64) - 1, passage)
  if (status /= RIIS_OK) return
  state = passage%state
  node_num = int(passage%node_id + 1, int32)
  distance = passage%distance
  point = passage%point
end subroutine riisf_find_passage

!> Does the same with INTEGER*8.
subroutine riisf_find_passage_64(surface, mesh, n_from, from_num, n_to, to_num, n_threads, state, node_num, distance, &
    point, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mark_options, riis_passage, riis_status, RIIS_OK, riis_mark_options_init
  use riis_calls, only: find_passage_between
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< A surface.
  integer(int64), intent(in) :: mesh                      !< A mesh with an adjacency. A marking is not needed.
  integer(int64), intent(in) :: n_from                    !< At least 1.
  integer(int64), intent(in) :: from_num(n_from)          !< Nodes where paths begin, counted from 1, in any order.
  integer(int64), intent(in) :: n_to                      !< At least 1.
  integer(int64), intent(in) :: to_num(n_to)              !< Nodes where paths end.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int32), intent(inout) :: state                  !< RIIS_PASSAGE_*.
  integer(int64), intent(inout) :: node_num               !< The path's node nearest to the surface, from 1; 0 without a path.
  real(c_double), intent(inout) :: distance               !< That node's distance, the smallest half thickness that closes the
                                                          !! path.
  real(c_double), intent(inout) :: point(3)               !< That node's coordinates.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mark_options) :: options
  type(riis_passage) :: passage
  status = riis_mark_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%n_threads = n_threads
  status = find_passage_between(c_handle_of(surface), c_handle_of(mesh), options, int(n_from, int64), &
    int(from_num, int64) - 1, int(n_to, int64), int(to_num, int64) - 1, passage)
  if (status /= RIIS_OK) return
  state = passage%state
  node_num = int(passage%node_id + 1, int64)
  distance = passage%distance
  point = passage%point
end subroutine riisf_find_passage_64
