! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_crossing.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Crossings: riis_crossings_* and riis_find_crossings of riis.h, as a part of module riis.
module riis_crossing
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_f_pointer, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, c_find_crossings => riis_find_crossings, c_crossing_list => riis_crossing_list
  use riis_support
  use riis_surfaces, only: riis_surface
  implicit none
  private
  public :: riis_crossings, riis_crossing_list, riis_find_crossings

  !> Pairs of triangles that cross, from %get_list. The object of the crossings owns the arrays, which count from 1. Ids count
  !! from 0. Lengths are in mesh units.
  type :: riis_crossing_list
    integer(int64) :: n_pairs = 0                           !< The number of pairs. If n_pairs is 0, the ids in this struct are
                                                            !! -1, and all other components except seconds are 0.
    integer(int64), pointer :: triangle_id(:, :) => null()  !< (2, n_pairs): the two triangles, the lower id first.
    real(c_double), pointer :: point(:, :) => null()        !< (3, n_pairs): the middle of the segment where the two triangles
                                                            !! meet.
    real(c_double), pointer :: depth(:) => null()           !< (n_pairs): the penetration depth.
    real(c_double), pointer :: length(:) => null()          !< (n_pairs): the length of the segment where the two triangles meet.
    real(c_double) :: total_length = 0                      !< The sum of all lengths.
    real(c_double) :: deepest_depth = 0                     !< The depth of the deepest pair. Of equally deep pairs, the first
                                                            !! one counts as the deepest.
    real(c_double) :: deepest_point(3) = 0                  !< The point of the deepest pair.
    integer(int64) :: deepest_triangle_id(2) = -1           !< The triangles of the deepest pair.
    integer(int32) :: deepest_leaflet_id(2) = -1            !< The leaflets of the deepest pair's triangles.
    real(c_double) :: seconds = 0                           !< Wall time of riis_find_crossings.
  end type riis_crossing_list

  !> The pairs that riis_find_crossings found. There are no pairs before riis_find_crossings and after %destroy. Call %destroy,
  !! because nothing else frees the memory.
  type :: riis_crossings
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, non_overridable :: get_list => crossings_get_list        !< Gives the pairs.
    procedure, non_overridable :: is_created => crossings_is_created    !< Returns whether the object was created.
    procedure, non_overridable :: c_handle => crossings_c_handle        !< The handle for calls of riis_c.
    procedure, non_overridable :: destroy => crossings_destroy          !< Frees its memory.
    generic :: assignment(=) => assign                                  !< Refused: a handle cannot be copied.
    procedure, private, non_overridable :: assign => crossings_assign
  end type riis_crossings

  !> Finds every pair of a surface's triangles that go through each other.
  interface riis_find_crossings
    module procedure find_crossings
  end interface riis_find_crossings

  ! A pointer without entries gets one of these targets, because the size of a null pointer is not defined.
  real(c_double), target, save :: no_reals(0), no_points(3, 0)
  integer(int64), target, save :: no_pairs(2, 0)

contains

  !> Finds every pair of the surface's triangles that go through each other. The depth of a pair is the length of the shortest
  !! translation of one triangle after which the two triangles only touch. Triangles that touch or lie in one plane have depth
  !! zero. Triangles of one leaflet that share a vertex do not count as a pair. %get_list of the crossings gives the pairs.
  !! Errors: RIIS_INVALID_ARGUMENT naming depth or n_threads; the crossings are then unchanged.
  subroutine find_crossings(surface, crossings, depth, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    type(riis_crossings), intent(inout) :: crossings        !< Empty, or from an earlier call; replaced, but not on an error.
    real(c_double), intent(in), optional :: depth           !< In half thicknesses, 0 to 1. Pairs of at most this depth only
                                                            !! touch. Default 1e-6.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: 1 per 4096 triangles, at most 1 per
                                                            !! processor.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_crossing_options) :: options
    logical :: was_empty
    code = check_created(surface%c_handle(), 'the surface')
    if (code == RIIS_OK) code = riis_crossing_options_init(options, c_sizeof(options))
    if (present(depth)) options%depth = depth
    call get_integer(n_threads, 'n_threads', options%n_threads, code)
    was_empty = .not. c_associated(crossings%handle)
    if (code == RIIS_OK .and. was_empty) code = riis_crossings_create(crossings%handle)
    if (code == RIIS_OK) code = c_find_crossings(surface%c_handle(), options, crossings%handle)
    ! The crossings were empty before the call and stay so.
    if (code /= RIIS_OK .and. was_empty) call riis_crossings_destroy(crossings%handle)
    call finish(code, status)
  end subroutine find_crossings

  !> Gives the pairs from the last call of riis_find_crossings, in ascending order, without a copy. The pairs are valid until the
  !! crossings are found again or destroyed. Do not write to the arrays of the pairs. On an error all sizes are 0.
  subroutine crossings_get_list(this, list, status)
    class(riis_crossings), intent(in) :: this               !< From riis_find_crossings.
    type(riis_crossing_list), intent(inout) :: list         !< Every component is set.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_crossing_list) :: made
    list = riis_crossing_list(triangle_id=no_pairs, point=no_points, depth=no_reals, length=no_reals)
    code = check_created(this%handle, 'the object crossings')
    if (code == RIIS_OK) code = riis_crossings_get_list(this%handle, made, c_sizeof(made))
    if (code == RIIS_OK) then
      list%n_pairs = made%n_pairs
      if (c_associated(made%triangle_id)) call c_f_pointer(made%triangle_id, list%triangle_id, [2_int64, made%n_pairs])
      if (c_associated(made%point)) call c_f_pointer(made%point, list%point, [3_int64, made%n_pairs])
      if (c_associated(made%depth)) call c_f_pointer(made%depth, list%depth, [made%n_pairs])
      if (c_associated(made%length)) call c_f_pointer(made%length, list%length, [made%n_pairs])
      list%total_length = made%total_length
      list%deepest_depth = made%deepest_depth
      list%deepest_point = made%deepest_point
      list%deepest_triangle_id = made%deepest_triangle_id
      list%deepest_leaflet_id = made%deepest_leaflet_id
      list%seconds = made%seconds
    end if
    call finish(code, status)
  end subroutine crossings_get_list

  !> Returns whether the crossings were found and not destroyed.
  pure function crossings_is_created(this) result(is_created)
    class(riis_crossings), intent(in) :: this               !< May be empty.
    logical :: is_created                                   !< .false. for empty ones.
    is_created = c_associated(this%handle)
  end function crossings_is_created

  !> Returns the C handle, for calls of module riis_c. The handle belongs to this variable, so do not destroy the handle.
  function crossings_c_handle(this) result(handle)
    class(riis_crossings), intent(in) :: this               !< May be empty.
    type(c_ptr) :: handle                                   !< c_null_ptr for empty ones.
    handle = this%handle
  end function crossings_c_handle

  !> Frees the memory of the crossings, which are then empty and can be used again. Nothing happens to empty crossings.
  subroutine crossings_destroy(this)
    class(riis_crossings), intent(inout) :: this            !< May be empty.
    call riis_crossings_destroy(this%handle)
  end subroutine crossings_destroy

  !> Stops the program unless both objects are empty.
  impure elemental subroutine crossings_assign(left, right)
    class(riis_crossings), intent(inout) :: left            !< Must be empty.
    class(riis_crossings), intent(in) :: right              !< Must be empty.
    call refuse_copy(left%handle, right%handle, 'riis_crossings')
  end subroutine crossings_assign
end module riis_crossing
