! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_passages.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Open regions and passages: riis_label_open_regions and riis_find_passage of riis.h, as a part of module riis.
module riis_passages
  use, intrinsic :: iso_c_binding, only: c_loc, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c, c_label_open_regions => riis_label_open_regions, c_find_passage => riis_find_passage
  use riis_support
  use riis_calls
  use riis_surfaces, only: riis_surface
  use riis_meshes, only: riis_mesh
  use riis_marking, only: riis_marks
  implicit none
  private
  public :: riis_label_open_regions, riis_find_passage

  !> Labels the open regions, the connected components of the nodes that a marking left unmarked.
  interface riis_label_open_regions
    module procedure label_open_regions_logical
    module procedure label_open_regions_int8
    module procedure label_open_regions_int32
  end interface riis_label_open_regions

  !> Finds the widest passage from one set of nodes to another, whether it is open or closed.
  interface riis_find_passage
    module procedure find_passage_logical_int32, find_passage_logical_int64
    module procedure find_passage_int8_int32, find_passage_int8_int64
    module procedure find_passage_int32_int32, find_passage_int32_int64
  end interface riis_find_passage

contains

  !> Labels the open regions. They are the connected components of unmarked nodes along the edges of the mesh's adjacency. Edges
  !! to ghost nodes are ignored. Errors: RIIS_INVALID_ARGUMENT if the mesh has no adjacency, or if the marks do not come from a
  !! marking with this mesh. The array is then as it was.
  subroutine label_open_regions_logical(mesh, marks, region_num, n_regions, node_mask, n_threads, status)
    class(riis_mesh), intent(in) :: mesh                    !< The mesh of the marking, with an adjacency.
    class(riis_marks), intent(in) :: marks           !< From riis_mark_nodes.
    integer(int64), intent(inout), contiguous :: region_num(:) !< (n_nodes): the lowest node of the node's region, counted
                                                            !! from 1; 0 for nodes in no region.
    integer(int64), intent(inout), optional :: n_regions    !< The number of regions.
    logical, intent(in), optional :: node_mask(:)           !< (n_nodes), as in the marking: nodes with .false. are left out;
                                                            !! copied. Default: all nodes.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call label(mesh, marks, region_num, n_regions, bytes, n_threads, code)
    call finish(code, status)
  end subroutine label_open_regions_logical

  !> Implements riis_label_open_regions for a mask of bytes. Only a section that is not contiguous is copied.
  subroutine label_open_regions_int8(mesh, marks, region_num, n_regions, node_mask, n_threads, status)
    class(riis_mesh), intent(in) :: mesh                    !< The mesh of the marking, with an adjacency.
    class(riis_marks), intent(in) :: marks           !< From riis_mark_nodes.
    integer(int64), intent(inout), contiguous :: region_num(:) !< (n_nodes): the lowest node of the node's region, counted
                                                            !! from 1; 0 for nodes in no region.
    integer(int64), intent(inout), optional :: n_regions    !< The number of regions.
    integer(int8), intent(in), contiguous :: node_mask(:)   !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call label(mesh, marks, region_num, n_regions, node_mask, n_threads, code)
    call finish(code, status)
  end subroutine label_open_regions_int8

  !> Implements riis_label_open_regions for a mask of integers, which is copied.
  subroutine label_open_regions_int32(mesh, marks, region_num, n_regions, node_mask, n_threads, status)
    class(riis_mesh), intent(in) :: mesh                    !< The mesh of the marking, with an adjacency.
    class(riis_marks), intent(in) :: marks           !< From riis_mark_nodes.
    integer(int64), intent(inout), contiguous :: region_num(:) !< (n_nodes): the lowest node of the node's region, counted
                                                            !! from 1; 0 for nodes in no region.
    integer(int64), intent(inout), optional :: n_regions    !< The number of regions.
    integer(int32), intent(in) :: node_mask(:)              !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call label(mesh, marks, region_num, n_regions, bytes, n_threads, code)
    call finish(code, status)
  end subroutine label_open_regions_int32

  !> Finds the widest passage from one set of nodes to another. It is the path, along the edges of the mesh's adjacency, whose
  !! smallest distance to the surface is largest. A path includes its ends. Errors: RIIS_INVALID_ARGUMENT if the mesh has no
  !! adjacency. It is also returned if a node is not in the mesh, is left out by node_mask, or is within the half thickness.
  subroutine find_passage_logical_int32(surface, mesh, from_num, to_num, passage, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    class(riis_mesh), intent(in) :: mesh                    !< With an adjacency. A marking is not needed.
    integer(int32), intent(in) :: from_num(:)               !< Nodes where paths begin, counted from 1, in any order; copied.
    integer(int32), intent(in) :: to_num(:)                 !< Nodes where paths end; copied.
    type(riis_passage), intent(inout) :: passage            !< The passage, whose node_id counts from 0; unchanged on an error.
    logical, intent(in), optional :: node_mask(:)           !< (n_nodes), as in the marking: nodes with .false. are left out;
                                                            !! copied. Default: all nodes.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    integer(int64), allocatable :: from(:), to(:)
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call get_ids_int32(from_num, from, code)
    call get_ids_int32(to_num, to, code)
    if (code == RIIS_OK) call find(surface, mesh, from, to, passage, bytes, n_threads, code)
    call finish(code, status)
  end subroutine find_passage_logical_int32

  !> Implements riis_find_passage for node numbers of another kind.
  subroutine find_passage_logical_int64(surface, mesh, from_num, to_num, passage, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    class(riis_mesh), intent(in) :: mesh                    !< With an adjacency. A marking is not needed.
    integer(int64), intent(in) :: from_num(:)               !< Nodes where paths begin, counted from 1, in any order; copied.
    integer(int64), intent(in) :: to_num(:)                 !< Nodes where paths end; copied.
    type(riis_passage), intent(inout) :: passage            !< The passage, whose node_id counts from 0; unchanged on an error.
    logical, intent(in), optional :: node_mask(:)           !< (n_nodes), as in the marking: nodes with .false. are left out;
                                                            !! copied. Default: all nodes.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    integer(int64), allocatable :: from(:), to(:)
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call get_ids_int64(from_num, from, code)
    call get_ids_int64(to_num, to, code)
    if (code == RIIS_OK) call find(surface, mesh, from, to, passage, bytes, n_threads, code)
    call finish(code, status)
  end subroutine find_passage_logical_int64

  !> Implements riis_find_passage for a mask of bytes. Only a section that is not contiguous is copied.
  subroutine find_passage_int8_int32(surface, mesh, from_num, to_num, passage, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    class(riis_mesh), intent(in) :: mesh                    !< With an adjacency. A marking is not needed.
    integer(int32), intent(in) :: from_num(:)               !< Nodes where paths begin, counted from 1, in any order; copied.
    integer(int32), intent(in) :: to_num(:)                 !< Nodes where paths end; copied.
    type(riis_passage), intent(inout) :: passage            !< The passage, whose node_id counts from 0; unchanged on an error.
    integer(int8), intent(in), contiguous :: node_mask(:)   !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64), allocatable :: from(:), to(:)
    code = RIIS_OK
    call get_ids_int32(from_num, from, code)
    call get_ids_int32(to_num, to, code)
    if (code == RIIS_OK) call find(surface, mesh, from, to, passage, node_mask, n_threads, code)
    call finish(code, status)
  end subroutine find_passage_int8_int32

  !> Implements riis_find_passage for a mask of bytes. Only a section that is not contiguous is copied.
  subroutine find_passage_int8_int64(surface, mesh, from_num, to_num, passage, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    class(riis_mesh), intent(in) :: mesh                    !< With an adjacency. A marking is not needed.
    integer(int64), intent(in) :: from_num(:)               !< Nodes where paths begin, counted from 1, in any order; copied.
    integer(int64), intent(in) :: to_num(:)                 !< Nodes where paths end; copied.
    type(riis_passage), intent(inout) :: passage            !< The passage, whose node_id counts from 0; unchanged on an error.
    integer(int8), intent(in), contiguous :: node_mask(:)   !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64), allocatable :: from(:), to(:)
    code = RIIS_OK
    call get_ids_int64(from_num, from, code)
    call get_ids_int64(to_num, to, code)
    if (code == RIIS_OK) call find(surface, mesh, from, to, passage, node_mask, n_threads, code)
    call finish(code, status)
  end subroutine find_passage_int8_int64

  !> Implements riis_find_passage for a mask of integers, which is copied.
  subroutine find_passage_int32_int32(surface, mesh, from_num, to_num, passage, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    class(riis_mesh), intent(in) :: mesh                    !< With an adjacency. A marking is not needed.
    integer(int32), intent(in) :: from_num(:)               !< Nodes where paths begin, counted from 1, in any order; copied.
    integer(int32), intent(in) :: to_num(:)                 !< Nodes where paths end; copied.
    type(riis_passage), intent(inout) :: passage            !< The passage, whose node_id counts from 0; unchanged on an error.
    integer(int32), intent(in) :: node_mask(:)              !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    integer(int64), allocatable :: from(:), to(:)
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call get_ids_int32(from_num, from, code)
    call get_ids_int32(to_num, to, code)
    if (code == RIIS_OK) call find(surface, mesh, from, to, passage, bytes, n_threads, code)
    call finish(code, status)
  end subroutine find_passage_int32_int32

  !> Implements riis_find_passage for a mask of integers, which is copied.
  subroutine find_passage_int32_int64(surface, mesh, from_num, to_num, passage, node_mask, n_threads, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    class(riis_mesh), intent(in) :: mesh                    !< With an adjacency. A marking is not needed.
    integer(int64), intent(in) :: from_num(:)               !< Nodes where paths begin, counted from 1, in any order; copied.
    integer(int64), intent(in) :: to_num(:)                 !< Nodes where paths end; copied.
    type(riis_passage), intent(inout) :: passage            !< The passage, whose node_id counts from 0; unchanged on an error.
    integer(int32), intent(in) :: node_mask(:)              !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    integer(int64), allocatable :: from(:), to(:)
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call get_ids_int64(from_num, from, code)
    call get_ids_int64(to_num, to, code)
    if (code == RIIS_OK) call find(surface, mesh, from, to, passage, bytes, n_threads, code)
    call finish(code, status)
  end subroutine find_passage_int32_int64

  ! Makes ids from node numbers: the only copy of the numbers. Does nothing after an error.
  subroutine get_ids_int32(numbers, ids, code)
    integer(int32), intent(in) :: numbers(:)
    integer(int64), allocatable, intent(out) :: ids(:)
    integer(riis_status), intent(inout) :: code
    integer :: stat
    if (code /= RIIS_OK) return
    allocate (ids(size(numbers, kind=int64)), stat=stat)
    code = out_of_memory(stat)
    if (code == RIIS_OK) ids = int(numbers, int64) - 1
  end subroutine get_ids_int32

  ! Makes ids from node numbers: the only copy of the numbers. Does nothing after an error.
  subroutine get_ids_int64(numbers, ids, code)
    integer(int64), intent(in) :: numbers(:)
    integer(int64), allocatable, intent(out) :: ids(:)
    integer(riis_status), intent(inout) :: code
    integer :: stat
    if (code /= RIIS_OK) return
    allocate (ids(size(numbers, kind=int64)), stat=stat)
    code = out_of_memory(stat)
    if (code == RIIS_OK) ids = int(numbers, int64) - 1
  end subroutine get_ids_int64

  ! Makes the options of riis_label_open_regions and riis_find_passage. Does nothing after an error.
  subroutine get_options(mesh, mask, n_threads, options, code)
    class(riis_mesh), intent(in) :: mesh
    integer(int8), intent(in), contiguous, optional, target :: mask(:)
    class(*), intent(in), optional :: n_threads
    type(riis_mark_options), intent(inout) :: options
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK) code = check_created(mesh%c_handle(), 'mesh')
    if (code == RIIS_OK) code = riis_mark_options_init(options, c_sizeof(options))
    call get_integer(n_threads, 'n_threads', options%n_threads, code)
    if (code /= RIIS_OK .or. .not. present(mask)) return
    code = check_size(size(mask, kind=int64), mesh%n_nodes(), 'node_mask', 'nodes')
    if (size(mask, kind=int64) > 0) options%node_mask = c_loc(mask)
  end subroutine get_options

  ! The common part of all specific procedures. It does nothing after an error.
  subroutine label(mesh, marks, region_num, n_regions, mask, n_threads, code)
    class(riis_mesh), intent(in) :: mesh
    class(riis_marks), intent(in) :: marks
    integer(int64), intent(inout), contiguous :: region_num(:)
    integer(int64), intent(inout), optional :: n_regions
    integer(int8), intent(in), contiguous, optional, target :: mask(:)
    class(*), intent(in), optional :: n_threads
    integer(riis_status), intent(inout) :: code
    type(riis_mark_options) :: options
    call get_options(mesh, mask, n_threads, options, code)
    if (code == RIIS_OK) code = check_created(marks%c_handle(), 'the object marks')
    if (code == RIIS_OK) code = check_size(size(region_num, kind=int64), mesh%n_nodes(), 'region_num', 'nodes')
    if (code == RIIS_OK) code = c_label_open_regions(mesh%c_handle(), marks%c_handle(), options, &
      size(region_num, kind=int64), region_num, n_regions)
    if (code == RIIS_OK) region_num = region_num + 1
  end subroutine label

  ! The common part of all specific procedures. It does nothing after an error.
  subroutine find(surface, mesh, from, to, passage, mask, n_threads, code)
    class(riis_surface), intent(in) :: surface
    class(riis_mesh), intent(in) :: mesh
    integer(int64), intent(in), contiguous :: from(:), to(:)
    type(riis_passage), intent(inout) :: passage
    integer(int8), intent(in), contiguous, optional, target :: mask(:)
    class(*), intent(in), optional :: n_threads
    integer(riis_status), intent(inout) :: code
    type(riis_mark_options) :: options
    type(riis_passage_ends) :: ends
    if (code == RIIS_OK) code = check_created(surface%c_handle(), 'surface')
    call get_options(mesh, mask, n_threads, options, code)
    if (code == RIIS_OK) code = describe_ends(from, to, ends)
    if (code == RIIS_OK) &
      code = c_find_passage(surface%c_handle(), mesh%c_handle(), ends, options, passage, c_sizeof(passage))
  end subroutine find
end module riis_passages
