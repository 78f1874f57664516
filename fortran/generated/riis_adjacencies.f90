! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_adjacencies.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Adjacencies: riis_adjacency_* of riis.h, as a part of module riis.
module riis_adjacencies
  use, intrinsic :: iso_c_binding, only: c_ptr, c_associated, c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c
  use riis_support
  implicit none
  private
  public :: riis_adjacency

  !> The neighbours of nodes, made from cells, faces or a structured grid. It is empty before it is created and after %destroy.
  !! Call %destroy, since nothing else frees it. Any number of threads may read it at once.
  type :: riis_adjacency
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    generic :: create_from_cells => cells_int32_int32, cells_int32_int64, cells_int64_int32, cells_int64_int64, &
      mixed_int32_int32, mixed_int32_int64, mixed_int64_int32, mixed_int64_int64
                                                               !< Makes the adjacency from cells, given by their nodes.
    generic :: create_from_faces => faces_int32_int32, faces_int32_int64, faces_int64_int32, faces_int64_int64, &
      owner_int32_int32, owner_int32_int64, owner_int64_int32, owner_int64_int64
                                                               !< Makes the adjacency from faces between cells.
    generic :: create_from_grid => grid_int32, grid_int64               !< Makes the adjacency of a structured grid.
    procedure, non_overridable :: is_created => adjacency_is_created    !< Returns whether the object was created.
    procedure, non_overridable :: c_handle => adjacency_c_handle        !< The handle for calls of riis_c.
    procedure, non_overridable :: destroy => adjacency_destroy          !< Frees its memory.
    generic :: assignment(=) => assign                                  !< Refused: a handle cannot be copied.
    procedure, private, non_overridable :: assign => adjacency_assign
    procedure, private, non_overridable :: cells_int32_int32 => adjacency_cells_int32_int32
    procedure, private, non_overridable :: cells_int32_int64 => adjacency_cells_int32_int64
    procedure, private, non_overridable :: cells_int64_int32 => adjacency_cells_int64_int32
    procedure, private, non_overridable :: cells_int64_int64 => adjacency_cells_int64_int64
    procedure, private, non_overridable :: mixed_int32_int32 => adjacency_mixed_int32_int32
    procedure, private, non_overridable :: mixed_int32_int64 => adjacency_mixed_int32_int64
    procedure, private, non_overridable :: mixed_int64_int32 => adjacency_mixed_int64_int32
    procedure, private, non_overridable :: mixed_int64_int64 => adjacency_mixed_int64_int64
    procedure, private, non_overridable :: faces_int32_int32 => adjacency_faces_int32_int32
    procedure, private, non_overridable :: faces_int32_int64 => adjacency_faces_int32_int64
    procedure, private, non_overridable :: faces_int64_int32 => adjacency_faces_int64_int32
    procedure, private, non_overridable :: faces_int64_int64 => adjacency_faces_int64_int64
    procedure, private, non_overridable :: owner_int32_int32 => adjacency_owner_int32_int32
    procedure, private, non_overridable :: owner_int32_int64 => adjacency_owner_int32_int64
    procedure, private, non_overridable :: owner_int64_int32 => adjacency_owner_int64_int32
    procedure, private, non_overridable :: owner_int64_int64 => adjacency_owner_int64_int64
    procedure, private, non_overridable :: grid_int32 => adjacency_grid_int32
    procedure, private, non_overridable :: grid_int64 => adjacency_grid_int64
  end type riis_adjacency

contains

  !> Makes an adjacency from cells that all have the same number of nodes. Two nodes are neighbours if an edge of a cell joins
  !! them. The number of nodes determines the shape: 4 tetrahedron, 5 pyramid, 6 prism, 8 hexahedron, in VTK's order. The array is
  !! read during the call only, and a section that is not contiguous is copied. Errors: RIIS_INVALID_ARGUMENT for an argument out
  !! of range, RIIS_INVALID_MESH naming the cell, counted from 0, and its value.
  subroutine adjacency_cells_int32_int32(this, n_nodes, cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
    integer(int32), intent(in), contiguous, target :: cells(:, :) !< (4, 5, 6 or 8, n_cells), counted from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_cells) :: the_cells
    code = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
    the_cells%n_cells = size(cells, 2, int64)
    the_cells%nodes_per_cell = size(cells, 1)
    if (size(cells, kind=int64) > 0) the_cells%node_ids = c_loc(cells)
    the_cells%id_bits = storage_size(cells)
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_cells_int32_int32

  !> Implements %create_from_cells for other integer kinds.
  subroutine adjacency_cells_int32_int64(this, n_nodes, cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
    integer(int64), intent(in), contiguous, target :: cells(:, :) !< (4, 5, 6 or 8, n_cells), counted from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_cells) :: the_cells
    code = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
    the_cells%n_cells = size(cells, 2, int64)
    the_cells%nodes_per_cell = size(cells, 1)
    if (size(cells, kind=int64) > 0) the_cells%node_ids = c_loc(cells)
    the_cells%id_bits = storage_size(cells)
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_cells_int32_int64

  !> Implements %create_from_cells for other integer kinds.
  subroutine adjacency_cells_int64_int32(this, n_nodes, cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
    integer(int32), intent(in), contiguous, target :: cells(:, :) !< (4, 5, 6 or 8, n_cells), counted from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_cells) :: the_cells
    code = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
    the_cells%n_cells = size(cells, 2, int64)
    the_cells%nodes_per_cell = size(cells, 1)
    if (size(cells, kind=int64) > 0) the_cells%node_ids = c_loc(cells)
    the_cells%id_bits = storage_size(cells)
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_cells_int64_int32

  !> Implements %create_from_cells for other integer kinds.
  subroutine adjacency_cells_int64_int64(this, n_nodes, cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
    integer(int64), intent(in), contiguous, target :: cells(:, :) !< (4, 5, 6 or 8, n_cells), counted from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_cells) :: the_cells
    code = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
    the_cells%n_cells = size(cells, 2, int64)
    the_cells%nodes_per_cell = size(cells, 1)
    if (size(cells, kind=int64) > 0) the_cells%node_ids = c_loc(cells)
    the_cells%id_bits = storage_size(cells)
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_cells_int64_int64

  !> Makes an adjacency from cells of several shapes. If offsets begins with 1, the nodes of cell i are node_ids(offsets(i) :
  !! offsets(i + 1) - 1).
  subroutine adjacency_mixed_int32_int32(this, n_nodes, node_ids, offsets, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
    integer(int32), intent(in), contiguous, target :: node_ids(:) !< The nodes of all cells, one cell after the other, from
                                                                        !! index_base.
    integer(int32), intent(in), contiguous, target :: offsets(:) !< (n_cells + 1), ascending from 0 or from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_cells) :: the_cells
    integer(int64) :: n
    code = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
    n = size(offsets, kind=int64)
    if (code == RIIS_OK .and. n < 2) code = refuse('the size of offsets is ' // text_of(n) // '; it must be one more ' // &
      'than the cells, of which there is at least 1')
    if (code == RIIS_OK) then
      code = check_nodes_of_cells(int(offsets(n), int64) - offsets(1), size(node_ids, kind=int64))
      the_cells%n_cells = n - 1
      the_cells%offsets = c_loc(offsets)
      if (size(node_ids, kind=int64) > 0) the_cells%node_ids = c_loc(node_ids)
      the_cells%id_bits = storage_size(node_ids)
    end if
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_mixed_int32_int32

  !> Implements %create_from_cells for other integer kinds.
  subroutine adjacency_mixed_int32_int64(this, n_nodes, node_ids, offsets, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
    integer(int64), intent(in), contiguous, target :: node_ids(:) !< The nodes of all cells, one cell after the other, from
                                                                        !! index_base.
    integer(int64), intent(in), contiguous, target :: offsets(:) !< (n_cells + 1), ascending from 0 or from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_cells) :: the_cells
    integer(int64) :: n
    code = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
    n = size(offsets, kind=int64)
    if (code == RIIS_OK .and. n < 2) code = refuse('the size of offsets is ' // text_of(n) // '; it must be one more ' // &
      'than the cells, of which there is at least 1')
    if (code == RIIS_OK) then
      code = check_nodes_of_cells(int(offsets(n), int64) - offsets(1), size(node_ids, kind=int64))
      the_cells%n_cells = n - 1
      the_cells%offsets = c_loc(offsets)
      if (size(node_ids, kind=int64) > 0) the_cells%node_ids = c_loc(node_ids)
      the_cells%id_bits = storage_size(node_ids)
    end if
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_mixed_int32_int64

  !> Implements %create_from_cells for other integer kinds.
  subroutine adjacency_mixed_int64_int32(this, n_nodes, node_ids, offsets, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
    integer(int32), intent(in), contiguous, target :: node_ids(:) !< The nodes of all cells, one cell after the other, from
                                                                        !! index_base.
    integer(int32), intent(in), contiguous, target :: offsets(:) !< (n_cells + 1), ascending from 0 or from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_cells) :: the_cells
    integer(int64) :: n
    code = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
    n = size(offsets, kind=int64)
    if (code == RIIS_OK .and. n < 2) code = refuse('the size of offsets is ' // text_of(n) // '; it must be one more ' // &
      'than the cells, of which there is at least 1')
    if (code == RIIS_OK) then
      code = check_nodes_of_cells(int(offsets(n), int64) - offsets(1), size(node_ids, kind=int64))
      the_cells%n_cells = n - 1
      the_cells%offsets = c_loc(offsets)
      if (size(node_ids, kind=int64) > 0) the_cells%node_ids = c_loc(node_ids)
      the_cells%id_bits = storage_size(node_ids)
    end if
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_mixed_int64_int32

  !> Implements %create_from_cells for other integer kinds.
  subroutine adjacency_mixed_int64_int64(this, n_nodes, node_ids, offsets, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
    integer(int64), intent(in), contiguous, target :: node_ids(:) !< The nodes of all cells, one cell after the other, from
                                                                        !! index_base.
    integer(int64), intent(in), contiguous, target :: offsets(:) !< (n_cells + 1), ascending from 0 or from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_cells) :: the_cells
    integer(int64) :: n
    code = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
    n = size(offsets, kind=int64)
    if (code == RIIS_OK .and. n < 2) code = refuse('the size of offsets is ' // text_of(n) // '; it must be one more ' // &
      'than the cells, of which there is at least 1')
    if (code == RIIS_OK) then
      code = check_nodes_of_cells(int(offsets(n), int64) - offsets(1), size(node_ids, kind=int64))
      the_cells%n_cells = n - 1
      the_cells%offsets = c_loc(offsets)
      if (size(node_ids, kind=int64) > 0) the_cells%node_ids = c_loc(node_ids)
      the_cells%id_bits = storage_size(node_ids)
    end if
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_mixed_int64_int64

  ! Checks that offsets refers to no more nodes than node_ids has.
  function check_nodes_of_cells(n_asked_for, n) result(code)
    integer(int64), intent(in) :: n_asked_for, n
    integer(riis_status) :: code
    code = RIIS_OK
    if (n_asked_for > n) code = refuse('offsets asks for ' // text_of(n_asked_for) // ' nodes of cells; node_ids has ' // &
      text_of(n) // ' entries')
  end function check_nodes_of_cells

  !> Makes an adjacency from faces, for codes that mark cell centres. Two cells are neighbours if they have a common face. The
  !! array is read during the call only, and a section that is not contiguous is copied. The errors are those of
  !! %create_from_cells.
  subroutine adjacency_faces_int32_int32(this, n_cells, face_cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int32), intent(in) :: n_cells                   !< >= 1: the nodes of the mesh are cell centres.
    integer(int32), intent(in), contiguous, target :: face_cells(:, :) !< (2, n_faces), from index_base; the second is
                                                            !! index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_faces) :: faces
    code = riis_mesh_faces_init(faces, c_sizeof(faces))
    if (code == RIIS_OK .and. size(face_cells, 1) /= 2) &
      code = refuse('the first extent of face_cells is ' // text_of(size(face_cells, 1)) // '; it must be 2')
    faces%n_faces = size(face_cells, 2, int64)
    faces%stride = 2
    faces%id_bits = storage_size(face_cells)
    if (code == RIIS_OK .and. faces%n_faces > 0) then
      faces%owner = c_loc(face_cells(1, 1))
      faces%neighbor = c_loc(face_cells(2, 1))
    end if
    call create_from_faces(this, int(n_cells, int64), faces, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_faces_int32_int32

  !> Implements %create_from_faces for other integer kinds.
  subroutine adjacency_faces_int32_int64(this, n_cells, face_cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int32), intent(in) :: n_cells                   !< >= 1: the nodes of the mesh are cell centres.
    integer(int64), intent(in), contiguous, target :: face_cells(:, :) !< (2, n_faces), from index_base; the second is
                                                            !! index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_faces) :: faces
    code = riis_mesh_faces_init(faces, c_sizeof(faces))
    if (code == RIIS_OK .and. size(face_cells, 1) /= 2) &
      code = refuse('the first extent of face_cells is ' // text_of(size(face_cells, 1)) // '; it must be 2')
    faces%n_faces = size(face_cells, 2, int64)
    faces%stride = 2
    faces%id_bits = storage_size(face_cells)
    if (code == RIIS_OK .and. faces%n_faces > 0) then
      faces%owner = c_loc(face_cells(1, 1))
      faces%neighbor = c_loc(face_cells(2, 1))
    end if
    call create_from_faces(this, int(n_cells, int64), faces, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_faces_int32_int64

  !> Implements %create_from_faces for other integer kinds.
  subroutine adjacency_faces_int64_int32(this, n_cells, face_cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int64), intent(in) :: n_cells                   !< >= 1: the nodes of the mesh are cell centres.
    integer(int32), intent(in), contiguous, target :: face_cells(:, :) !< (2, n_faces), from index_base; the second is
                                                            !! index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_faces) :: faces
    code = riis_mesh_faces_init(faces, c_sizeof(faces))
    if (code == RIIS_OK .and. size(face_cells, 1) /= 2) &
      code = refuse('the first extent of face_cells is ' // text_of(size(face_cells, 1)) // '; it must be 2')
    faces%n_faces = size(face_cells, 2, int64)
    faces%stride = 2
    faces%id_bits = storage_size(face_cells)
    if (code == RIIS_OK .and. faces%n_faces > 0) then
      faces%owner = c_loc(face_cells(1, 1))
      faces%neighbor = c_loc(face_cells(2, 1))
    end if
    call create_from_faces(this, int(n_cells, int64), faces, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_faces_int64_int32

  !> Implements %create_from_faces for other integer kinds.
  subroutine adjacency_faces_int64_int64(this, n_cells, face_cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int64), intent(in) :: n_cells                   !< >= 1: the nodes of the mesh are cell centres.
    integer(int64), intent(in), contiguous, target :: face_cells(:, :) !< (2, n_faces), from index_base; the second is
                                                            !! index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_faces) :: faces
    code = riis_mesh_faces_init(faces, c_sizeof(faces))
    if (code == RIIS_OK .and. size(face_cells, 1) /= 2) &
      code = refuse('the first extent of face_cells is ' // text_of(size(face_cells, 1)) // '; it must be 2')
    faces%n_faces = size(face_cells, 2, int64)
    faces%stride = 2
    faces%id_bits = storage_size(face_cells)
    if (code == RIIS_OK .and. faces%n_faces > 0) then
      faces%owner = c_loc(face_cells(1, 1))
      faces%neighbor = c_loc(face_cells(2, 1))
    end if
    call create_from_faces(this, int(n_cells, int64), faces, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_faces_int64_int64

  !> Makes an adjacency from faces whose two cells are in separate arrays.
  subroutine adjacency_owner_int32_int32(this, n_cells, owner, neighbor, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int32), intent(in) :: n_cells                   !< >= 1: the nodes of the mesh are cell centres.
    integer(int32), intent(in), contiguous, target :: owner(:) !< (n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, target :: neighbor(:) !< (n_faces), index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_faces) :: faces
    code = riis_mesh_faces_init(faces, c_sizeof(faces))
    if (code == RIIS_OK) code = check_size(size(neighbor, kind=int64), size(owner, kind=int64), 'neighbor', 'owners')
    faces%n_faces = size(owner, kind=int64)
    faces%id_bits = storage_size(owner)
    if (code == RIIS_OK .and. faces%n_faces > 0) then
      faces%owner = c_loc(owner)
      faces%neighbor = c_loc(neighbor)
    end if
    call create_from_faces(this, int(n_cells, int64), faces, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_owner_int32_int32

  !> Implements %create_from_faces for other integer kinds.
  subroutine adjacency_owner_int32_int64(this, n_cells, owner, neighbor, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int32), intent(in) :: n_cells                   !< >= 1: the nodes of the mesh are cell centres.
    integer(int64), intent(in), contiguous, target :: owner(:) !< (n_faces), counted from index_base.
    integer(int64), intent(in), contiguous, target :: neighbor(:) !< (n_faces), index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_faces) :: faces
    code = riis_mesh_faces_init(faces, c_sizeof(faces))
    if (code == RIIS_OK) code = check_size(size(neighbor, kind=int64), size(owner, kind=int64), 'neighbor', 'owners')
    faces%n_faces = size(owner, kind=int64)
    faces%id_bits = storage_size(owner)
    if (code == RIIS_OK .and. faces%n_faces > 0) then
      faces%owner = c_loc(owner)
      faces%neighbor = c_loc(neighbor)
    end if
    call create_from_faces(this, int(n_cells, int64), faces, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_owner_int32_int64

  !> Implements %create_from_faces for other integer kinds.
  subroutine adjacency_owner_int64_int32(this, n_cells, owner, neighbor, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int64), intent(in) :: n_cells                   !< >= 1: the nodes of the mesh are cell centres.
    integer(int32), intent(in), contiguous, target :: owner(:) !< (n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, target :: neighbor(:) !< (n_faces), index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_faces) :: faces
    code = riis_mesh_faces_init(faces, c_sizeof(faces))
    if (code == RIIS_OK) code = check_size(size(neighbor, kind=int64), size(owner, kind=int64), 'neighbor', 'owners')
    faces%n_faces = size(owner, kind=int64)
    faces%id_bits = storage_size(owner)
    if (code == RIIS_OK .and. faces%n_faces > 0) then
      faces%owner = c_loc(owner)
      faces%neighbor = c_loc(neighbor)
    end if
    call create_from_faces(this, int(n_cells, int64), faces, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_owner_int64_int32

  !> Implements %create_from_faces for other integer kinds.
  subroutine adjacency_owner_int64_int64(this, n_cells, owner, neighbor, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int64), intent(in) :: n_cells                   !< >= 1: the nodes of the mesh are cell centres.
    integer(int64), intent(in), contiguous, target :: owner(:) !< (n_faces), counted from index_base.
    integer(int64), intent(in), contiguous, target :: neighbor(:) !< (n_faces), index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_mesh_faces) :: faces
    code = riis_mesh_faces_init(faces, c_sizeof(faces))
    if (code == RIIS_OK) code = check_size(size(neighbor, kind=int64), size(owner, kind=int64), 'neighbor', 'owners')
    faces%n_faces = size(owner, kind=int64)
    faces%id_bits = storage_size(owner)
    if (code == RIIS_OK .and. faces%n_faces > 0) then
      faces%owner = c_loc(owner)
      faces%neighbor = c_loc(neighbor)
    end if
    call create_from_faces(this, int(n_cells, int64), faces, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_owner_int64_int64

  ! The common part of all specific procedures of create_from_cells. It does nothing after an error.
  subroutine create_from_cells(this, n_nodes, cells, index_base, n_threads, code)
    class(riis_adjacency), intent(inout) :: this
    integer(int64), intent(in) :: n_nodes
    type(riis_mesh_cells), intent(inout) :: cells
    class(*), intent(in), optional :: index_base, n_threads
    integer(riis_status), intent(inout) :: code
    cells%n_nodes = n_nodes
    cells%index_base = 1
    call get_integer(index_base, 'index_base', cells%index_base, code)
    call get_integer(n_threads, 'n_threads', cells%n_threads, code)
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the adjacency')
    if (code == RIIS_OK) code = riis_adjacency_create_from_cells(cells, this%handle)
  end subroutine create_from_cells

  ! The common part of all specific procedures of create_from_faces. It does nothing after an error.
  subroutine create_from_faces(this, n_cells, faces, index_base, n_threads, code)
    class(riis_adjacency), intent(inout) :: this
    integer(int64), intent(in) :: n_cells
    type(riis_mesh_faces), intent(inout) :: faces
    class(*), intent(in), optional :: index_base, n_threads
    integer(riis_status), intent(inout) :: code
    faces%n_cells = n_cells
    faces%index_base = 1
    call get_integer(index_base, 'index_base', faces%index_base, code)
    call get_integer(n_threads, 'n_threads', faces%n_threads, code)
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the adjacency')
    if (code == RIIS_OK) code = riis_adjacency_create_from_faces(faces, this%handle)
  end subroutine create_from_faces

  !> Makes the adjacency of a structured grid, xyz(3, ni, nj, nk). Neighbours differ by 1 in one of i, j, k. Errors:
  !! RIIS_INVALID_ARGUMENT for an argument out of range.
  subroutine adjacency_grid_int32(this, ni, nj, nk, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int32), intent(in) :: ni                        !< >= 1.
    integer(int32), intent(in) :: nj                        !< >= 1.
    integer(int32), intent(in) :: nk                        !< >= 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    call adjacency_grid_int64(this, int(ni, int64), int(nj, int64), int(nk, int64), n_threads, code)
    call finish(code, status)
  end subroutine adjacency_grid_int32

  !> Implements %create_from_grid for integer(int64).
  subroutine adjacency_grid_int64(this, ni, nj, nk, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Must be empty.
    integer(int64), intent(in) :: ni                        !< >= 1.
    integer(int64), intent(in) :: nj                        !< >= 1.
    integer(int64), intent(in) :: nk                        !< >= 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int32) :: n_threads_or_0
    n_threads_or_0 = 0
    code = check_not_created(this%handle, 'the adjacency')
    call get_integer(n_threads, 'n_threads', n_threads_or_0, code)
    if (code == RIIS_OK) code = riis_adjacency_create_from_grid(ni, nj, nk, n_threads_or_0, this%handle)
    call finish(code, status)
  end subroutine adjacency_grid_int64

  !> Returns whether the adjacency was created and not destroyed.
  pure function adjacency_is_created(this) result(is_created)
    class(riis_adjacency), intent(in) :: this               !< May be empty.
    logical :: is_created                                   !< .false. for an empty one.
    is_created = c_associated(this%handle)
  end function adjacency_is_created

  !> Returns the C handle, for calls of module riis_c. The handle belongs to this variable, so do not destroy the handle.
  function adjacency_c_handle(this) result(handle)
    class(riis_adjacency), intent(in) :: this               !< May be empty.
    type(c_ptr) :: handle                                   !< c_null_ptr for an empty one.
    handle = this%handle
  end function adjacency_c_handle

  !> Frees the memory of the adjacency, which is then empty and can be created again. Nothing happens to an empty one.
  subroutine adjacency_destroy(this)
    class(riis_adjacency), intent(inout) :: this            !< May be empty.
    call riis_adjacency_destroy(this%handle)
  end subroutine adjacency_destroy

  !> Stops the program unless both objects are empty.
  impure elemental subroutine adjacency_assign(left, right)
    class(riis_adjacency), intent(inout) :: left            !< Must be empty.
    class(riis_adjacency), intent(in) :: right              !< Must be empty.
    call refuse_copy(left%handle, right%handle, 'riis_adjacency')
  end subroutine adjacency_assign
end module riis_adjacencies
