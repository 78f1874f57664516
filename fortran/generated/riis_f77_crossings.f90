! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77_crossings.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The external subroutines for crossings. The conventions are those of riis_f77.f90.

!> Finds every pair of the surface's triangles that go through each other by more than a depth. Triangles of one leaflet that
!! share a vertex do not count as a pair. Errors: RIIS_INVALID_ARGUMENT naming the depth or n_threads.
subroutine riisf_find_crossings(surface, depth, n_threads, crossings, n_pairs, length, deepest, point, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_crossing_list, riis_crossing_options, riis_status, RIIS_OK, riis_crossing_options_init, &
    riis_crossings_create, riis_crossings_destroy, riis_crossings_get_list, riis_find_crossings
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  real(c_double), intent(in) :: depth                     !< Half thicknesses, 0 to 1: less deep pairs only touch; usually 1D-6.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: 1 per 4096 triangles, at most 1 per processor.
  integer(int64), intent(inout) :: crossings              !< 0, which creates them, or from an earlier call.
  integer(int64), intent(inout) :: n_pairs                !< The number of pairs that cross, INTEGER*8.
  real(c_double), intent(inout) :: length                 !< The total length of their intersections.
  real(c_double), intent(inout) :: deepest                !< The depth of the deepest pair; 0 if none crosses.
  real(c_double), intent(inout) :: point(3)               !< The middle of the deepest pair's intersection.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_crossing_options) :: options
  type(riis_crossing_list) :: list
  type(c_ptr) :: c_handle
  status = riis_crossing_options_init(options, c_sizeof(options))
  if (status /= RIIS_OK) return
  options%depth = depth
  options%n_threads = n_threads
  c_handle = c_handle_of(crossings)
  if (crossings == 0) status = riis_crossings_create(c_handle)
  if (status == RIIS_OK) status = riis_find_crossings(c_handle_of(surface), options, c_handle)
  if (status == RIIS_OK) status = riis_crossings_get_list(c_handle, list, c_sizeof(list))
  if (status /= RIIS_OK .and. crossings == 0) call riis_crossings_destroy(c_handle) ! the handle stays 0, as before the call
  crossings = handle_of(c_handle)
  if (status /= RIIS_OK) return
  n_pairs = list%n_pairs
  length = list%total_length
  deepest = list%deepest_depth
  point = list%deepest_point
end subroutine riisf_find_crossings

!> Destroys the crossings and sets their handle to 0. Nothing happens to a handle that is 0.
subroutine riisf_crossings_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_crossings_destroy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_crossings_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_crossings_destroy

!> Copies the pairs of the last riisf_find_crossings into the caller's arrays, ascending. Errors: RIIS_INVALID_ARGUMENT if the
!! arrays are too short; only n is then written.
subroutine riisf_crossing_pairs(crossings, length, n, triangle_num, point, depth, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_crossing_list, riis_crossings_get_list
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: crossings                 !< From riisf_find_crossings.
  integer(int32), intent(in) :: length                    !< The length of the arrays.
  integer(int32), intent(inout) :: n                      !< The number of pairs, even if the arrays are too short.
  integer(int32), intent(inout) :: triangle_num(2, *)     !< (2, length): both triangles, counted from 1; written up to n.
  real(c_double), intent(inout) :: point(3, *)            !< (3, length): the middle of the pair's intersection.
  real(c_double), intent(inout) :: depth(*)               !< (length): the penetration depth.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_crossing_list) :: list
  integer(int64), pointer :: ids(:, :)
  real(c_double), pointer :: places(:, :), all_depths(:)
  integer(int64) :: found
  status = riis_crossings_get_list(c_handle_of(crossings), list, c_sizeof(list))
  if (status /= RIIS_OK) return
  found = list%n_pairs
  n = int(min(found, int(huge(n), int64)), int32)
  if (found > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; pairs that cross: ' // text_of(found))
    return
  end if
  if (found == 0) return
  call c_f_pointer(list%triangle_id, ids, [2_int64, found])
  call c_f_pointer(list%point, places, [3_int64, found])
  call c_f_pointer(list%depth, all_depths, [found])
  triangle_num(:, :n) = int(ids + 1, int32) ! the library's limit on triangles fits into either kind
  point(:, :n) = places
  depth(:n) = all_depths
end subroutine riisf_crossing_pairs

!> Does the same with INTEGER*8.
subroutine riisf_crossing_pairs_64(crossings, length, n, triangle_num, point, depth, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_crossing_list, riis_crossings_get_list
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: crossings                 !< From riisf_find_crossings.
  integer(int64), intent(in) :: length                    !< The length of the arrays.
  integer(int64), intent(inout) :: n                      !< The number of pairs, even if the arrays are too short.
  integer(int64), intent(inout) :: triangle_num(2, *)     !< (2, length): both triangles, counted from 1; written up to n.
  real(c_double), intent(inout) :: point(3, *)            !< (3, length): the middle of the pair's intersection.
  real(c_double), intent(inout) :: depth(*)               !< (length): the penetration depth.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_crossing_list) :: list
  integer(int64), pointer :: ids(:, :)
  real(c_double), pointer :: places(:, :), all_depths(:)
  integer(int64) :: found
  status = riis_crossings_get_list(c_handle_of(crossings), list, c_sizeof(list))
  if (status /= RIIS_OK) return
  found = list%n_pairs
  n = int(min(found, int(huge(n), int64)), int64)
  if (found > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; pairs that cross: ' // text_of(found))
    return
  end if
  if (found == 0) return
  call c_f_pointer(list%triangle_id, ids, [2_int64, found])
  call c_f_pointer(list%point, places, [3_int64, found])
  call c_f_pointer(list%depth, all_depths, [found])
  triangle_num(:, :n) = int(ids + 1, int64) ! the library's limit on triangles fits into either kind
  point(:, :n) = places
  depth(:n) = all_depths
end subroutine riisf_crossing_pairs_64
