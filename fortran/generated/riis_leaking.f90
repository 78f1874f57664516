! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_leaking.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Leaks: riis_leaks_* and riis_find_leaks of riis.h, as a part of module riis.
module riis_leaking
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_f_pointer, c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c, c_find_leaks => riis_find_leaks, c_leak_list => riis_leak_list
  use riis_support
  use riis_surfaces, only: riis_surface
  use riis_meshes, only: riis_mesh
  use riis_marking, only: riis_marks
  implicit none
  private
  public :: riis_leaks, riis_leak_list, riis_find_leaks

  !> Edges that leak, from %get_list. The object of the leaks owns the arrays, which count from 1. Ids count from
  !! 0: node_id + 1 are columns of xyz. Lengths are in mesh units.
  type :: riis_leak_list
    integer(int64) :: n_edges = 0                           !< The number of edges that leak. If n_edges is 0, the node ids are
                                                            !! -1, and all other components except seconds are 0.
    integer(int64), pointer :: node_id(:, :) => null()      !< (2, n_edges): the two nodes, the lower id first.
    real(c_double), pointer :: length(:) => null()          !< (n_edges).
    real(c_double), pointer :: distance(:) => null()        !< (n_edges): for each edge, the least half thickness with which the
                                                            !! edge does not leak. Without an offset, this is the distance of the
                                                            !! edge's nearer node from the surface.
    real(c_double) :: half_thickness = 0                    !< The least half thickness with which each edge of the list has a
                                                            !! marked node, for the present triangles.
    integer(int64) :: longest_node_id(2) = -1               !< The nodes of the longest edge, the lower id first. Of equally long
                                                            !! edges, the first one counts.
    real(c_double) :: longest_length = 0                    !< The length of this edge.
    real(c_double) :: longest_middle(3) = 0                 !< The middle of this edge.
    real(c_double) :: seconds = 0                           !< Wall time of riis_find_leaks.
  end type riis_leak_list

  !> The edges that riis_find_leaks found. There are no edges before riis_find_leaks and after %destroy. Call %destroy, because
  !! nothing else frees the memory.
  type :: riis_leaks
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, non_overridable :: get_list => leaks_get_list            !< Gives the edges.
    procedure, non_overridable :: is_created => leaks_is_created        !< Returns whether the object was created.
    procedure, non_overridable :: c_handle => leaks_c_handle            !< The handle for calls of riis_c.
    procedure, non_overridable :: destroy => leaks_destroy              !< Frees its memory.
    generic :: assignment(=) => assign                                  !< Refused: a handle cannot be copied.
    procedure, private, non_overridable :: assign => leaks_assign
  end type riis_leaks

  !> Finds every edge of the mesh that crosses the surface between two unmarked nodes.
  interface riis_find_leaks
    module procedure find_leaks_logical
    module procedure find_leaks_int8
    module procedure find_leaks_int32
  end interface riis_find_leaks

  ! A pointer without entries gets this target, because the size of a null pointer is not defined.
  real(c_double), target, save :: no_reals(0)
  integer(int64), target, save :: no_edges(2, 0)

contains

  !> Finds every edge that leaks. Such an edge belongs to the mesh's adjacency, and crosses the surface between two unmarked
  !! nodes. Edges of at most two half thicknesses do not leak. With an offset o, the limit is 2 (1 - |o|) half thicknesses. Gaps
  !! of the surface itself are not found. %get_list of the leaks gives the edges. Errors: RIIS_INVALID_ARGUMENT if the mesh has no
  !! adjacency, or if the marks do not come from a marking with this mesh and half thickness. The leaks are then unchanged.
  subroutine find_leaks_logical(surface, mesh, marks, leaks, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< The surface of the marking.
    class(riis_mesh), intent(in) :: mesh                    !< The mesh of the marking, with an adjacency.
    class(riis_marks), intent(in) :: marks                  !< From riis_mark_nodes.
    type(riis_leaks), intent(inout) :: leaks                !< Empty, or from an earlier call; replaced, but not on an error.
    logical, intent(in), optional :: node_mask(:)           !< (n_nodes), as in the marking: nodes with .false. are left out;
                                                            !! copied. Default: all nodes.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call find(surface, mesh, marks, leaks, bytes, n_threads, code)
    call finish(code, status)
  end subroutine find_leaks_logical

  !> Implements riis_find_leaks for a mask of bytes. Only a section that is not contiguous is copied.
  subroutine find_leaks_int8(surface, mesh, marks, leaks, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< The surface of the marking.
    class(riis_mesh), intent(in) :: mesh                    !< The mesh of the marking, with an adjacency.
    class(riis_marks), intent(in) :: marks                  !< From riis_mark_nodes.
    type(riis_leaks), intent(inout) :: leaks                !< Empty, or from an earlier call; replaced, but not on an error.
    integer(int8), intent(in), contiguous :: node_mask(:)   !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call find(surface, mesh, marks, leaks, node_mask, n_threads, code)
    call finish(code, status)
  end subroutine find_leaks_int8

  !> Implements riis_find_leaks for a mask of integers, which is copied.
  subroutine find_leaks_int32(surface, mesh, marks, leaks, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< The surface of the marking.
    class(riis_mesh), intent(in) :: mesh                    !< The mesh of the marking, with an adjacency.
    class(riis_marks), intent(in) :: marks                  !< From riis_mark_nodes.
    type(riis_leaks), intent(inout) :: leaks                !< Empty, or from an earlier call; replaced, but not on an error.
    integer(int32), intent(in) :: node_mask(:)              !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call find(surface, mesh, marks, leaks, bytes, n_threads, code)
    call finish(code, status)
  end subroutine find_leaks_int32

  ! The common part of all specific procedures. The procedure does nothing after an error.
  subroutine find(surface, mesh, marks, leaks, mask, n_threads, code)
    class(riis_surface), intent(in) :: surface
    class(riis_mesh), intent(in) :: mesh
    class(riis_marks), intent(in) :: marks
    type(riis_leaks), intent(inout) :: leaks
    integer(int8), intent(in), contiguous, optional, target :: mask(:)
    class(*), intent(in), optional :: n_threads
    integer(riis_status), intent(inout) :: code
    type(riis_mark_options) :: options
    logical :: was_empty
    if (code == RIIS_OK) code = check_created(surface%c_handle(), 'surface')
    if (code == RIIS_OK) code = check_created(mesh%c_handle(), 'mesh')
    if (code == RIIS_OK) code = check_created(marks%c_handle(), 'the object marks')
    if (code == RIIS_OK) code = riis_mark_options_init(options, c_sizeof(options))
    call get_integer(n_threads, 'n_threads', options%n_threads, code)
    if (code == RIIS_OK .and. present(mask)) then
      code = check_size(size(mask, kind=int64), mesh%n_nodes(), 'node_mask', 'nodes')
      if (size(mask, kind=int64) > 0) options%node_mask = c_loc(mask)
    end if
    was_empty = .not. c_associated(leaks%handle)
    if (code == RIIS_OK .and. was_empty) code = riis_leaks_create(leaks%handle)
    if (code == RIIS_OK) &
      code = c_find_leaks(surface%c_handle(), mesh%c_handle(), marks%c_handle(), options, leaks%handle)
    if (code /= RIIS_OK .and. was_empty) call riis_leaks_destroy(leaks%handle) ! the leaks were empty before the call and stay so
  end subroutine find

  !> Gives the edges from the last call of riis_find_leaks, in ascending order, without a copy. The edges are valid until the
  !! leaks are found again or destroyed. Do not write to the arrays of the edges. On an error all sizes are 0.
  subroutine leaks_get_list(this, list, status)
    class(riis_leaks), intent(in) :: this                   !< From riis_find_leaks.
    type(riis_leak_list), intent(inout) :: list             !< Every component is set.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_leak_list) :: made
    list = riis_leak_list(node_id=no_edges, length=no_reals, distance=no_reals)
    code = check_created(this%handle, 'the object leaks')
    if (code == RIIS_OK) code = riis_leaks_get_list(this%handle, made, c_sizeof(made))
    if (code == RIIS_OK) then
      list%n_edges = made%n_edges
      if (c_associated(made%node_id)) call c_f_pointer(made%node_id, list%node_id, [2_int64, made%n_edges])
      if (c_associated(made%length)) call c_f_pointer(made%length, list%length, [made%n_edges])
      if (c_associated(made%distance)) call c_f_pointer(made%distance, list%distance, [made%n_edges])
      list%half_thickness = made%half_thickness
      list%longest_node_id = made%longest_node_id
      list%longest_length = made%longest_length
      list%longest_middle = made%longest_middle
      list%seconds = made%seconds
    end if
    call finish(code, status)
  end subroutine leaks_get_list

  !> Returns whether the leaks were found and not destroyed.
  pure function leaks_is_created(this) result(is_created)
    class(riis_leaks), intent(in) :: this                   !< May be empty.
    logical :: is_created                                   !< .false. for empty ones.
    is_created = c_associated(this%handle)
  end function leaks_is_created

  !> Returns the C handle, for calls of module riis_c. The handle belongs to this variable, so do not destroy the handle.
  function leaks_c_handle(this) result(handle)
    class(riis_leaks), intent(in) :: this                   !< May be empty.
    type(c_ptr) :: handle                                   !< c_null_ptr for empty ones.
    handle = this%handle
  end function leaks_c_handle

  !> Frees the memory of the leaks, which are then empty and can be used again. Nothing happens to empty leaks.
  subroutine leaks_destroy(this)
    class(riis_leaks), intent(inout) :: this                !< May be empty.
    call riis_leaks_destroy(this%handle)
  end subroutine leaks_destroy

  !> Stops the program unless both objects are empty.
  impure elemental subroutine leaks_assign(left, right)
    class(riis_leaks), intent(inout) :: left                !< Must be empty.
    class(riis_leaks), intent(in) :: right                  !< Must be empty.
    call refuse_copy(left%handle, right%handle, 'riis_leaks')
  end subroutine leaks_assign
end module riis_leaking
