! SPDX-License-Identifier: Apache-2.0
!> Leaks: riis_find_leaks of riis.h, as a part of module riis.
module riis_leaking
  use, intrinsic :: iso_c_binding, only: c_loc, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c, c_find_leaks => riis_find_leaks
  use riis_support
  use riis_surfaces, only: riis_surface
  use riis_meshes, only: riis_mesh
  use riis_marking, only: riis_marks
  implicit none
  private
  public :: riis_find_leaks

  !> Finds every edge of the mesh that crosses the surface between two unmarked nodes.
  interface riis_find_leaks
    module procedure find_leaks_logical
    module procedure find_leaks_int8
    module procedure find_leaks_int32
  end interface riis_find_leaks

contains

  !> Finds every edge of the mesh's adjacency that leaks: it crosses the surface between two unmarked nodes. Edges that are
  !! at most two half thicknesses long do not leak. Gaps of the surface itself are not found. %leaking_edges of the result
  !! gives the edges. Errors: RIIS_INVALID_ARGUMENT if the mesh has no adjacency, or if the result was never marked with, or
  !! was marked with another mesh or half thickness. The result is then as it was.
  subroutine find_leaks_logical(surface, mesh, result, leaks, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< The surface of the marking.
    class(riis_mesh), intent(in) :: mesh                    !< The mesh of the marking, with an adjacency.
    class(riis_marks), intent(inout) :: result        !< From riis_mark_nodes; its leaking edges are replaced.
    type(riis_leaks), intent(inout) :: leaks                !< The summary; left alone on an error.
    logical, intent(in), optional :: node_mask(:)           !< (n_nodes), as in the marking: edges to nodes with .false. are no
                                                            !! paths; copied. Default: all nodes.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as the work feeds.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int8), allocatable :: bytes(:)
    integer(riis_status) :: code
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call find(surface, mesh, result, leaks, bytes, n_threads, code)
    call finish(code, status)
  end subroutine find_leaks_logical

  !> Does the same with a mask of bytes. Only a section that is not contiguous is copied.
  subroutine find_leaks_int8(surface, mesh, result, leaks, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< The surface of the marking.
    class(riis_mesh), intent(in) :: mesh                    !< The mesh of the marking, with an adjacency.
    class(riis_marks), intent(inout) :: result        !< From riis_mark_nodes; its leaking edges are replaced.
    type(riis_leaks), intent(inout) :: leaks                !< The summary; left alone on an error.
    integer(int8), intent(in), contiguous :: node_mask(:)   !< (n_nodes): edges to nodes with 0 are no paths.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as the work feeds.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call find(surface, mesh, result, leaks, node_mask, n_threads, code)
    call finish(code, status)
  end subroutine find_leaks_int8

  !> Does the same with a mask of integers, which is copied.
  subroutine find_leaks_int32(surface, mesh, result, leaks, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< The surface of the marking.
    class(riis_mesh), intent(in) :: mesh                    !< The mesh of the marking, with an adjacency.
    class(riis_marks), intent(inout) :: result        !< From riis_mark_nodes; its leaking edges are replaced.
    type(riis_leaks), intent(inout) :: leaks                !< The summary; left alone on an error.
    integer(int32), intent(in) :: node_mask(:)              !< (n_nodes): edges to nodes with 0 are no paths.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as the work feeds.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int8), allocatable :: bytes(:)
    integer(riis_status) :: code
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call find(surface, mesh, result, leaks, bytes, n_threads, code)
    call finish(code, status)
  end subroutine find_leaks_int32

  ! The common part of all specifics; does nothing after an error.
  subroutine find(surface, mesh, result, leaks, mask, n_threads, code)
    class(riis_surface), intent(in) :: surface
    class(riis_mesh), intent(in) :: mesh
    class(riis_marks), intent(inout) :: result
    type(riis_leaks), intent(inout) :: leaks
    integer(int8), intent(in), contiguous, optional, target :: mask(:)
    class(*), intent(in), optional :: n_threads
    integer(riis_status), intent(inout) :: code
    type(riis_mark_options) :: options
    if (code == RIIS_OK) code = check_created(surface%c_handle(), 'surface')
    if (code == RIIS_OK) code = check_created(mesh%c_handle(), 'mesh')
    if (code == RIIS_OK) code = check_created(result%c_handle(), 'the result')
    if (code == RIIS_OK) code = riis_mark_options_init(options, c_sizeof(options))
    call get_integer(n_threads, 'n_threads', options%n_threads, code)
    if (code == RIIS_OK .and. present(mask)) then
      code = check_size(size(mask, kind=int64), mesh%n_nodes(), 'node_mask', 'nodes')
      if (size(mask, kind=int64) > 0) options%node_mask = c_loc(mask)
    end if
    if (code == RIIS_OK) code = c_find_leaks(surface%c_handle(), mesh%c_handle(), options, result%c_handle(), leaks, &
      c_sizeof(leaks))
  end subroutine find
end module riis_leaking
