! SPDX-License-Identifier: Apache-2.0
!> Meshes and adjacencies: the part of module riis that is riis_mesh_* and riis_adjacency_* in riis.h.
module riis_meshes
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c
  use riis_support
  implicit none
  private
  public :: riis_mesh, riis_adjacency

  !> Which nodes are neighbours, made from what solvers have: cells, faces or a structured grid. Empty until one of the
  !! creations, and again after %destroy, which has to be called. May be read by any number of threads at once.
  type :: riis_adjacency
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    generic :: create_from_cells => cells_int32_int32, cells_int32_int64, cells_int64_int32, cells_int64_int64, &
      mixed_int32_int32, mixed_int32_int64, mixed_int64_int32, mixed_int64_int64
                                                               !< Cells by their nodes.
    generic :: create_from_faces => faces_int32_int32, faces_int32_int64, faces_int64_int32, faces_int64_int64, &
      owner_int32_int32, owner_int32_int64, owner_int64_int32, owner_int64_int64
                                                               !< Faces between cells.
    generic :: create_from_grid => grid_int32, grid_int64      !< A structured grid.
    procedure :: is_created => adjacency_is_created            !< Whether there is anything in it.
    procedure :: c_handle => adjacency_c_handle                !< For calls of riis_c.
    procedure :: destroy => adjacency_destroy                  !< Frees what it holds.
    generic :: assignment(=) => assign                         !< Refused: a handle cannot be copied.
    procedure, private :: assign => adjacency_assign
    procedure, private :: cells_int32_int32 => adjacency_cells_int32_int32
    procedure, private :: cells_int32_int64 => adjacency_cells_int32_int64
    procedure, private :: cells_int64_int32 => adjacency_cells_int64_int32
    procedure, private :: cells_int64_int64 => adjacency_cells_int64_int64
    procedure, private :: mixed_int32_int32 => adjacency_mixed_int32_int32
    procedure, private :: mixed_int32_int64 => adjacency_mixed_int32_int64
    procedure, private :: mixed_int64_int32 => adjacency_mixed_int64_int32
    procedure, private :: mixed_int64_int64 => adjacency_mixed_int64_int64
    procedure, private :: faces_int32_int32 => adjacency_faces_int32_int32
    procedure, private :: faces_int32_int64 => adjacency_faces_int32_int64
    procedure, private :: faces_int64_int32 => adjacency_faces_int64_int32
    procedure, private :: faces_int64_int64 => adjacency_faces_int64_int64
    procedure, private :: owner_int32_int32 => adjacency_owner_int32_int32
    procedure, private :: owner_int32_int64 => adjacency_owner_int32_int64
    procedure, private :: owner_int64_int32 => adjacency_owner_int64_int32
    procedure, private :: owner_int64_int64 => adjacency_owner_int64_int64
    procedure, private :: grid_int32 => adjacency_grid_int32
    procedure, private :: grid_int64 => adjacency_grid_int64
  end type riis_adjacency

  !> The caller's nodes. The coordinates are borrowed, as are the rows of an adjacency: they are never copied, and must stay
  !! where they are until the mesh is destroyed or given others. So pass variables that outlive it, whole or as sections by
  !! subscript triplets: not an expression, nor (xyz) in parentheses, nor a section by a vector subscript, which are copies
  !! that the compiler makes and drops after the call (gfortran -Warray-temporaries shows them), nor a local variable that
  !! ends or an allocatable that is reallocated. TARGET is not needed.
  !!
  !! Empty until %create, and again after %destroy, which has to be called. May be read by any number of threads at once; is
  !! written by one with no reader beside it.
  type :: riis_mesh
    private
    type(c_ptr) :: handle = c_null_ptr
    integer(int64) :: n = 0
  contains
    generic :: create => create_xyz, create_x_y_z              !< Borrows coordinates.
    generic :: update => update_xyz, update_x_y_z              !< Tells that the coordinates moved.
    generic :: set_adjacency => adjacency_int32_int32, adjacency_int32_int64, adjacency_int64_int32, &
      adjacency_int64_int64, adjacency_handle                  !< Gives what the neighbour search walks along.
    procedure :: clear_adjacency => mesh_clear_adjacency       !< Takes it away.
    procedure :: n_nodes => mesh_n_nodes                       !< How many nodes.
    procedure :: is_created => mesh_is_created                 !< Whether there is anything in it.
    procedure :: c_handle => mesh_c_handle                     !< For calls of riis_c.
    procedure :: destroy => mesh_destroy                       !< Frees what it holds; the coordinates are the caller's.
    generic :: assignment(=) => assign                         !< Refused: a handle cannot be copied.
    procedure, private :: assign => mesh_assign
    procedure, private :: create_xyz => mesh_create_xyz
    procedure, private :: create_x_y_z => mesh_create_x_y_z
    procedure, private :: update_xyz => mesh_update_xyz
    procedure, private :: update_x_y_z => mesh_update_x_y_z
    procedure, private :: adjacency_int32_int32 => mesh_adjacency_int32_int32
    procedure, private :: adjacency_int32_int64 => mesh_adjacency_int32_int64
    procedure, private :: adjacency_int64_int32 => mesh_adjacency_int64_int32
    procedure, private :: adjacency_int64_int64 => mesh_adjacency_int64_int64
    procedure, private :: adjacency_handle => mesh_adjacency_handle
  end type riis_mesh

contains

  !> Borrows node coordinates and checks them once. The columns of xyz may lie apart by any multiple of a real (8 bytes),
  !! its rows at any distance. Errors: RIIS_INVALID_MESH naming the node, counted from 0, and the value.
  subroutine mesh_create_xyz(this, xyz, status)
    class(riis_mesh), intent(inout) :: this                 !< Empty before.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_nodes), any positive stride; finite; borrowed.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(strided_points) :: points
    integer(riis_status) :: code
    call points_of(xyz, 'xyz', points, code)
    call create_mesh(this, points, code)
    call finish(code, status)
  end subroutine mesh_create_xyz

  !> The same for separate coordinates, all of the same stride.
  subroutine mesh_create_x_y_z(this, x, y, z, status)
    class(riis_mesh), intent(inout) :: this                 !< Empty before.
    real(c_double), intent(in), target :: x(:)              !< (n_nodes), any positive stride; finite; borrowed.
    real(c_double), intent(in), target :: y(:)              !< (n_nodes), any positive stride; finite; borrowed.
    real(c_double), intent(in), target :: z(:)              !< (n_nodes), any positive stride; finite; borrowed.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(strided_points) :: points
    integer(riis_status) :: code
    call points_of(x, y, z, points, code)
    call create_mesh(this, points, code)
    call finish(code, status)
  end subroutine mesh_create_x_y_z

  !> Tells the mesh that the coordinates moved, in place or to another array, and checks them again. To be called after any
  !! change of coordinates. The adjacency stays if the number of nodes does. Errors as of %create.
  subroutine mesh_update_xyz(this, xyz, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_nodes), any positive stride; finite; borrowed.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(strided_points) :: points
    integer(riis_status) :: code
    call points_of(xyz, 'xyz', points, code)
    call update_mesh(this, points, code)
    call finish(code, status)
  end subroutine mesh_update_xyz

  !> The same for separate coordinates, all of the same stride.
  subroutine mesh_update_x_y_z(this, x, y, z, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    real(c_double), intent(in), target :: x(:)              !< (n_nodes), any positive stride; finite; borrowed.
    real(c_double), intent(in), target :: y(:)              !< (n_nodes), any positive stride; finite; borrowed.
    real(c_double), intent(in), target :: z(:)              !< (n_nodes), any positive stride; finite; borrowed.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(strided_points) :: points
    integer(riis_status) :: code
    call points_of(x, y, z, points, code)
    call update_mesh(this, points, code)
    call finish(code, status)
  end subroutine mesh_update_x_y_z

  ! What both specifics of create have in common; does nothing after an error.
  subroutine create_mesh(this, points, code)
    class(riis_mesh), intent(inout) :: this
    type(strided_points), intent(in) :: points
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_create(points%n, points%x, points%y, points%z, points%stride, this%handle)
    if (code == RIIS_OK) this%n = points%n
  end subroutine create_mesh

  ! The same of update.
  subroutine update_mesh(this, points, code)
    class(riis_mesh), intent(inout) :: this
    type(strided_points), intent(in) :: points
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK) code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_update(this%handle, points%n, points%x, points%y, points%z, points%stride)
    if (code == RIIS_OK) this%n = points%n
  end subroutine update_mesh

  !> Gives the mesh its adjacency as compressed sparse rows, which are borrowed: they have to be contiguous, and to stay in
  !! place, unchanged, until the mesh is destroyed or given others. The neighbours of node i are
  !! columns(offsets(i) : offsets(i + 1) - 1), in any order, with the default base. Checked once. Errors:
  !! RIIS_INVALID_ARGUMENT for sizes that do not go together and for sections that are not contiguous, RIIS_INVALID_MESH
  !! naming the row, counted from 0, and its value; the mesh then keeps what it had.
  subroutine mesh_adjacency_int32_int32(this, offsets, columns, index_base, n_all, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    integer(int32), intent(in), target :: offsets(:)         !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int32), intent(in), target :: columns(:)         !< (>= offsets(n_nodes + 1) - index_base), from index_base;
                                                            !! borrowed.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number, and what offsets
                                                            !! begin with. Default 1.
    class(*), intent(in), optional :: n_all                 !< integer: n_nodes and the ghosts, which columns may name and
                                                            !! which are ignored. Default: n_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_csr) :: csr
    integer(int64) :: n_offsets, n_columns
    integer(riis_status) :: code
    n_offsets = size(offsets, kind=int64)
    n_columns = size(columns, kind=int64)
    code = check_rows(this, n_offsets, is_contiguous(offsets), n_columns, is_contiguous(columns))
    if (code == RIIS_OK) code = riis_csr_init(csr, c_sizeof(csr))
    if (code == RIIS_OK) then
      csr%offsets = c_loc(offsets(1))
      csr%offset_bits = storage_size(offsets)
      if (n_columns > 0) csr%columns = c_loc(columns(1))
      csr%column_bits = storage_size(columns)
      code = set_rows(this, csr, int(offsets(n_offsets), int64), n_columns, index_base, n_all)
    end if
    call finish(code, status)
  end subroutine mesh_adjacency_int32_int32

  !> The same for other kinds.
  subroutine mesh_adjacency_int32_int64(this, offsets, columns, index_base, n_all, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    integer(int32), intent(in), target :: offsets(:)         !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int64), intent(in), target :: columns(:)         !< (>= offsets(n_nodes + 1) - index_base), from index_base;
                                                            !! borrowed.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number, and what offsets
                                                            !! begin with. Default 1.
    class(*), intent(in), optional :: n_all                 !< integer: n_nodes and the ghosts, which columns may name and
                                                            !! which are ignored. Default: n_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_csr) :: csr
    integer(int64) :: n_offsets, n_columns
    integer(riis_status) :: code
    n_offsets = size(offsets, kind=int64)
    n_columns = size(columns, kind=int64)
    code = check_rows(this, n_offsets, is_contiguous(offsets), n_columns, is_contiguous(columns))
    if (code == RIIS_OK) code = riis_csr_init(csr, c_sizeof(csr))
    if (code == RIIS_OK) then
      csr%offsets = c_loc(offsets(1))
      csr%offset_bits = storage_size(offsets)
      if (n_columns > 0) csr%columns = c_loc(columns(1))
      csr%column_bits = storage_size(columns)
      code = set_rows(this, csr, int(offsets(n_offsets), int64), n_columns, index_base, n_all)
    end if
    call finish(code, status)
  end subroutine mesh_adjacency_int32_int64

  !> The same for other kinds.
  subroutine mesh_adjacency_int64_int32(this, offsets, columns, index_base, n_all, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    integer(int64), intent(in), target :: offsets(:)         !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int32), intent(in), target :: columns(:)         !< (>= offsets(n_nodes + 1) - index_base), from index_base;
                                                            !! borrowed.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number, and what offsets
                                                            !! begin with. Default 1.
    class(*), intent(in), optional :: n_all                 !< integer: n_nodes and the ghosts, which columns may name and
                                                            !! which are ignored. Default: n_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_csr) :: csr
    integer(int64) :: n_offsets, n_columns
    integer(riis_status) :: code
    n_offsets = size(offsets, kind=int64)
    n_columns = size(columns, kind=int64)
    code = check_rows(this, n_offsets, is_contiguous(offsets), n_columns, is_contiguous(columns))
    if (code == RIIS_OK) code = riis_csr_init(csr, c_sizeof(csr))
    if (code == RIIS_OK) then
      csr%offsets = c_loc(offsets(1))
      csr%offset_bits = storage_size(offsets)
      if (n_columns > 0) csr%columns = c_loc(columns(1))
      csr%column_bits = storage_size(columns)
      code = set_rows(this, csr, int(offsets(n_offsets), int64), n_columns, index_base, n_all)
    end if
    call finish(code, status)
  end subroutine mesh_adjacency_int64_int32

  !> The same for other kinds.
  subroutine mesh_adjacency_int64_int64(this, offsets, columns, index_base, n_all, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    integer(int64), intent(in), target :: offsets(:)         !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int64), intent(in), target :: columns(:)         !< (>= offsets(n_nodes + 1) - index_base), from index_base;
                                                            !! borrowed.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number, and what offsets
                                                            !! begin with. Default 1.
    class(*), intent(in), optional :: n_all                 !< integer: n_nodes and the ghosts, which columns may name and
                                                            !! which are ignored. Default: n_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_csr) :: csr
    integer(int64) :: n_offsets, n_columns
    integer(riis_status) :: code
    n_offsets = size(offsets, kind=int64)
    n_columns = size(columns, kind=int64)
    code = check_rows(this, n_offsets, is_contiguous(offsets), n_columns, is_contiguous(columns))
    if (code == RIIS_OK) code = riis_csr_init(csr, c_sizeof(csr))
    if (code == RIIS_OK) then
      csr%offsets = c_loc(offsets(1))
      csr%offset_bits = storage_size(offsets)
      if (n_columns > 0) csr%columns = c_loc(columns(1))
      csr%column_bits = storage_size(columns)
      code = set_rows(this, csr, int(offsets(n_offsets), int64), n_columns, index_base, n_all)
    end if
    call finish(code, status)
  end subroutine mesh_adjacency_int64_int64

  ! Whether the rows can be borrowed, and are as many as the nodes.
  function check_rows(this, n_offsets, contiguous_offsets, n_columns, contiguous_columns) result(code)
    class(riis_mesh), intent(in) :: this
    integer(int64), intent(in) :: n_offsets, n_columns
    logical, intent(in) :: contiguous_offsets, contiguous_columns
    integer(riis_status) :: code
    code = check_created(this%handle, 'the mesh')
    if (code /= RIIS_OK) return
    if (n_offsets /= this%n + 1) then
      code = refuse('the size of offsets is ' // text_of(n_offsets) // '; it must be one more than the ' // &
        text_of(this%n) // ' nodes')
    else if (n_offsets > 1 .and. .not. contiguous_offsets) then
      code = refuse('offsets is a section that is not contiguous: it is borrowed, so it is not copied')
    else if (n_columns > 1 .and. .not. contiguous_columns) then
      code = refuse('columns is a section that is not contiguous: it is borrowed, so it is not copied')
    end if
  end function check_rows

  ! What all kinds of rows have in common.
  function set_rows(this, csr, last_offset, n_columns, index_base, n_all) result(code)
    class(riis_mesh), intent(inout) :: this
    type(riis_csr), intent(inout) :: csr
    integer(int64), intent(in) :: last_offset, n_columns
    class(*), intent(in), optional :: index_base, n_all
    integer(riis_status) :: code
    code = RIIS_OK
    csr%n_rows = this%n
    csr%index_base = 1
    call get_integer(index_base, 'index_base', csr%index_base, code)
    call get_integer(n_all, 'n_all', csr%n_all, code)
    if (code == RIIS_OK .and. last_offset - csr%index_base > n_columns) &
      code = refuse('offsets ends with ' // text_of(last_offset) // ', counting from ' // text_of(csr%index_base) // &
        '; columns has ' // text_of(n_columns) // ' entries')
    if (code == RIIS_OK) code = riis_mesh_set_adjacency(this%handle, csr)
  end function set_rows

  !> The same with rows that the library made: they stay the adjacency's, which has to live until the mesh is destroyed or
  !! given others. Errors: RIIS_INVALID_ARGUMENT for one of another number of nodes.
  subroutine mesh_adjacency_handle(this, adjacency, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    class(riis_adjacency), intent(in) :: adjacency          !< Created; to be destroyed after the mesh.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_csr) :: csr
    integer(riis_status) :: code
    code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = check_created(adjacency%handle, 'adjacency')
    if (code == RIIS_OK) code = riis_adjacency_csr(adjacency%handle, csr, c_sizeof(csr))
    if (code == RIIS_OK) code = riis_mesh_set_adjacency(this%handle, csr)
    call finish(code, status)
  end subroutine mesh_adjacency_handle

  !> Takes the adjacency away: its rows are not borrowed any more.
  subroutine mesh_clear_adjacency(this, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    integer(riis_status) :: code
    code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_set_adjacency(this%handle)
    call finish(code, status)
  end subroutine mesh_clear_adjacency

  !> How many nodes the mesh has.
  pure function mesh_n_nodes(this) result(n)
    class(riis_mesh), intent(in) :: this                    !< Any.
    integer(int64) :: n                                     !< 0 for an empty one.
    n = this%n
  end function mesh_n_nodes

  !> Makes the adjacency of cells that all have the same number of nodes: neighbours are nodes that an edge of a cell joins.
  !! What a cell is, its number of nodes says: 4 tetrahedron, 5 pyramid, 6 prism, 8 hexahedron, in VTK's order. The array is
  !! read during the call only; a section that is not contiguous is copied for it. Errors: RIIS_INVALID_ARGUMENT for an
  !! argument out of range, RIIS_INVALID_MESH naming the cell, counted from 0, and its value.
  subroutine adjacency_cells_int32_int32(this, n_nodes, cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int32), intent(in) :: n_nodes                    !< Of the mesh, >= 1.
    integer(int32), intent(in), contiguous, target :: cells(:, :) !< (4, 5, 6 or 8, n_cells), counted from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_cells) :: the_cells
    integer(riis_status) :: code
    code = riis_cells_init(the_cells, c_sizeof(the_cells))
    the_cells%n_cells = size(cells, 2, int64)
    the_cells%nodes_per_cell = size(cells, 1)
    if (size(cells) > 0) the_cells%node_ids = c_loc(cells)
    the_cells%id_bits = storage_size(cells)
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_cells_int32_int32

  !> The same for other kinds.
  subroutine adjacency_cells_int32_int64(this, n_nodes, cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int32), intent(in) :: n_nodes                    !< Of the mesh, >= 1.
    integer(int64), intent(in), contiguous, target :: cells(:, :) !< (4, 5, 6 or 8, n_cells), counted from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_cells) :: the_cells
    integer(riis_status) :: code
    code = riis_cells_init(the_cells, c_sizeof(the_cells))
    the_cells%n_cells = size(cells, 2, int64)
    the_cells%nodes_per_cell = size(cells, 1)
    if (size(cells) > 0) the_cells%node_ids = c_loc(cells)
    the_cells%id_bits = storage_size(cells)
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_cells_int32_int64

  !> The same for other kinds.
  subroutine adjacency_cells_int64_int32(this, n_nodes, cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int64), intent(in) :: n_nodes                    !< Of the mesh, >= 1.
    integer(int32), intent(in), contiguous, target :: cells(:, :) !< (4, 5, 6 or 8, n_cells), counted from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_cells) :: the_cells
    integer(riis_status) :: code
    code = riis_cells_init(the_cells, c_sizeof(the_cells))
    the_cells%n_cells = size(cells, 2, int64)
    the_cells%nodes_per_cell = size(cells, 1)
    if (size(cells) > 0) the_cells%node_ids = c_loc(cells)
    the_cells%id_bits = storage_size(cells)
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_cells_int64_int32

  !> The same for other kinds.
  subroutine adjacency_cells_int64_int64(this, n_nodes, cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int64), intent(in) :: n_nodes                    !< Of the mesh, >= 1.
    integer(int64), intent(in), contiguous, target :: cells(:, :) !< (4, 5, 6 or 8, n_cells), counted from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_cells) :: the_cells
    integer(riis_status) :: code
    code = riis_cells_init(the_cells, c_sizeof(the_cells))
    the_cells%n_cells = size(cells, 2, int64)
    the_cells%nodes_per_cell = size(cells, 1)
    if (size(cells) > 0) the_cells%node_ids = c_loc(cells)
    the_cells%id_bits = storage_size(cells)
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_cells_int64_int64

  !> The same of mixed cells, one after the other; the nodes of cell i are node_ids(offsets(i) : offsets(i + 1) - 1) where
  !! offsets begins with 1.
  subroutine adjacency_mixed_int32_int32(this, n_nodes, node_ids, offsets, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int32), intent(in) :: n_nodes                    !< Of the mesh, >= 1.
    integer(int32), intent(in), contiguous, target :: node_ids(:) !< The nodes of cell after cell, counted from index_base.
    integer(int32), intent(in), contiguous, target :: offsets(:) !< (n_cells + 1), ascending from 0 or from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_cells) :: the_cells
    integer(riis_status) :: code
    integer(int64) :: n
    code = riis_cells_init(the_cells, c_sizeof(the_cells))
    n = size(offsets, kind=int64)
    if (code == RIIS_OK .and. n < 2) code = refuse('the size of offsets is ' // text_of(n) // '; it must be one more ' // &
      'than the cells, of which there is at least 1')
    if (code == RIIS_OK) then
      code = check_nodes_of_cells(int(offsets(n), int64) - offsets(1), size(node_ids, kind=int64))
      the_cells%n_cells = n - 1
      the_cells%offsets = c_loc(offsets)
      if (size(node_ids) > 0) the_cells%node_ids = c_loc(node_ids)
      the_cells%id_bits = storage_size(node_ids)
    end if
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_mixed_int32_int32

  !> The same for other kinds.
  subroutine adjacency_mixed_int32_int64(this, n_nodes, node_ids, offsets, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int32), intent(in) :: n_nodes                    !< Of the mesh, >= 1.
    integer(int64), intent(in), contiguous, target :: node_ids(:) !< The nodes of cell after cell, counted from index_base.
    integer(int64), intent(in), contiguous, target :: offsets(:) !< (n_cells + 1), ascending from 0 or from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_cells) :: the_cells
    integer(riis_status) :: code
    integer(int64) :: n
    code = riis_cells_init(the_cells, c_sizeof(the_cells))
    n = size(offsets, kind=int64)
    if (code == RIIS_OK .and. n < 2) code = refuse('the size of offsets is ' // text_of(n) // '; it must be one more ' // &
      'than the cells, of which there is at least 1')
    if (code == RIIS_OK) then
      code = check_nodes_of_cells(int(offsets(n), int64) - offsets(1), size(node_ids, kind=int64))
      the_cells%n_cells = n - 1
      the_cells%offsets = c_loc(offsets)
      if (size(node_ids) > 0) the_cells%node_ids = c_loc(node_ids)
      the_cells%id_bits = storage_size(node_ids)
    end if
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_mixed_int32_int64

  !> The same for other kinds.
  subroutine adjacency_mixed_int64_int32(this, n_nodes, node_ids, offsets, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int64), intent(in) :: n_nodes                    !< Of the mesh, >= 1.
    integer(int32), intent(in), contiguous, target :: node_ids(:) !< The nodes of cell after cell, counted from index_base.
    integer(int32), intent(in), contiguous, target :: offsets(:) !< (n_cells + 1), ascending from 0 or from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_cells) :: the_cells
    integer(riis_status) :: code
    integer(int64) :: n
    code = riis_cells_init(the_cells, c_sizeof(the_cells))
    n = size(offsets, kind=int64)
    if (code == RIIS_OK .and. n < 2) code = refuse('the size of offsets is ' // text_of(n) // '; it must be one more ' // &
      'than the cells, of which there is at least 1')
    if (code == RIIS_OK) then
      code = check_nodes_of_cells(int(offsets(n), int64) - offsets(1), size(node_ids, kind=int64))
      the_cells%n_cells = n - 1
      the_cells%offsets = c_loc(offsets)
      if (size(node_ids) > 0) the_cells%node_ids = c_loc(node_ids)
      the_cells%id_bits = storage_size(node_ids)
    end if
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_mixed_int64_int32

  !> The same for other kinds.
  subroutine adjacency_mixed_int64_int64(this, n_nodes, node_ids, offsets, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int64), intent(in) :: n_nodes                    !< Of the mesh, >= 1.
    integer(int64), intent(in), contiguous, target :: node_ids(:) !< The nodes of cell after cell, counted from index_base.
    integer(int64), intent(in), contiguous, target :: offsets(:) !< (n_cells + 1), ascending from 0 or from index_base.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_cells) :: the_cells
    integer(riis_status) :: code
    integer(int64) :: n
    code = riis_cells_init(the_cells, c_sizeof(the_cells))
    n = size(offsets, kind=int64)
    if (code == RIIS_OK .and. n < 2) code = refuse('the size of offsets is ' // text_of(n) // '; it must be one more ' // &
      'than the cells, of which there is at least 1')
    if (code == RIIS_OK) then
      code = check_nodes_of_cells(int(offsets(n), int64) - offsets(1), size(node_ids, kind=int64))
      the_cells%n_cells = n - 1
      the_cells%offsets = c_loc(offsets)
      if (size(node_ids) > 0) the_cells%node_ids = c_loc(node_ids)
      the_cells%id_bits = storage_size(node_ids)
    end if
    call create_from_cells(this, int(n_nodes, int64), the_cells, index_base, n_threads, code)
    call finish(code, status)
  end subroutine adjacency_mixed_int64_int64

  ! Whether offsets asks for no more nodes than there are.
  function check_nodes_of_cells(n_asked_for, n) result(code)
    integer(int64), intent(in) :: n_asked_for, n
    integer(riis_status) :: code
    code = RIIS_OK
    if (n_asked_for > n) code = refuse('offsets asks for ' // text_of(n_asked_for) // ' nodes of cells; node_ids has ' // &
      text_of(n) // ' entries')
  end function check_nodes_of_cells

  ! What all specifics of create_from_cells have in common; does nothing after an error.
  subroutine create_from_cells(this, n_nodes, cells, index_base, n_threads, code)
    class(riis_adjacency), intent(inout) :: this
    integer(int64), intent(in) :: n_nodes
    type(riis_cells), intent(inout) :: cells
    class(*), intent(in), optional :: index_base, n_threads
    integer(riis_status), intent(inout) :: code
    cells%n_nodes = n_nodes
    cells%index_base = 1
    call get_integer(index_base, 'index_base', cells%index_base, code)
    call get_integer(n_threads, 'n_threads', cells%n_threads, code)
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the adjacency')
    if (code == RIIS_OK) code = riis_adjacency_create_from_cells(cells, this%handle)
  end subroutine create_from_cells

  !> Makes the adjacency of cells with common faces, for codes that mark cell centres. The array is read during the call
  !! only; a section that is not contiguous is copied for it. Errors as of %create_from_cells.
  subroutine adjacency_faces_int32_int32(this, n_cells, face_cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int32), intent(in) :: n_cells                    !< >= 1: the nodes of the mesh are cell centres.
    integer(int32), intent(in), contiguous, target :: face_cells(:, :) !< (2, n_faces), from index_base; the second is
                                                            !! index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_faces) :: faces
    integer(riis_status) :: code
    code = riis_faces_init(faces, c_sizeof(faces))
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

  !> The same for other kinds.
  subroutine adjacency_faces_int32_int64(this, n_cells, face_cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int32), intent(in) :: n_cells                    !< >= 1: the nodes of the mesh are cell centres.
    integer(int64), intent(in), contiguous, target :: face_cells(:, :) !< (2, n_faces), from index_base; the second is
                                                            !! index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_faces) :: faces
    integer(riis_status) :: code
    code = riis_faces_init(faces, c_sizeof(faces))
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

  !> The same for other kinds.
  subroutine adjacency_faces_int64_int32(this, n_cells, face_cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int64), intent(in) :: n_cells                    !< >= 1: the nodes of the mesh are cell centres.
    integer(int32), intent(in), contiguous, target :: face_cells(:, :) !< (2, n_faces), from index_base; the second is
                                                            !! index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_faces) :: faces
    integer(riis_status) :: code
    code = riis_faces_init(faces, c_sizeof(faces))
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

  !> The same for other kinds.
  subroutine adjacency_faces_int64_int64(this, n_cells, face_cells, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int64), intent(in) :: n_cells                    !< >= 1: the nodes of the mesh are cell centres.
    integer(int64), intent(in), contiguous, target :: face_cells(:, :) !< (2, n_faces), from index_base; the second is
                                                            !! index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_faces) :: faces
    integer(riis_status) :: code
    code = riis_faces_init(faces, c_sizeof(faces))
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

  !> The same with both sides of a face in arrays of their own.
  subroutine adjacency_owner_int32_int32(this, n_cells, owner, neighbor, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int32), intent(in) :: n_cells                    !< >= 1: the nodes of the mesh are cell centres.
    integer(int32), intent(in), contiguous, target :: owner(:) !< (n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, target :: neighbor(:) !< (n_faces), index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_faces) :: faces
    integer(riis_status) :: code
    code = riis_faces_init(faces, c_sizeof(faces))
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

  !> The same for other kinds.
  subroutine adjacency_owner_int32_int64(this, n_cells, owner, neighbor, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int32), intent(in) :: n_cells                    !< >= 1: the nodes of the mesh are cell centres.
    integer(int64), intent(in), contiguous, target :: owner(:) !< (n_faces), counted from index_base.
    integer(int64), intent(in), contiguous, target :: neighbor(:) !< (n_faces), index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_faces) :: faces
    integer(riis_status) :: code
    code = riis_faces_init(faces, c_sizeof(faces))
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

  !> The same for other kinds.
  subroutine adjacency_owner_int64_int32(this, n_cells, owner, neighbor, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int64), intent(in) :: n_cells                    !< >= 1: the nodes of the mesh are cell centres.
    integer(int32), intent(in), contiguous, target :: owner(:) !< (n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, target :: neighbor(:) !< (n_faces), index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_faces) :: faces
    integer(riis_status) :: code
    code = riis_faces_init(faces, c_sizeof(faces))
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

  !> The same for other kinds.
  subroutine adjacency_owner_int64_int64(this, n_cells, owner, neighbor, index_base, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int64), intent(in) :: n_cells                    !< >= 1: the nodes of the mesh are cell centres.
    integer(int64), intent(in), contiguous, target :: owner(:) !< (n_faces), counted from index_base.
    integer(int64), intent(in), contiguous, target :: neighbor(:) !< (n_faces), index_base - 1 for a face at the boundary.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first cell's number. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    type(riis_faces) :: faces
    integer(riis_status) :: code
    code = riis_faces_init(faces, c_sizeof(faces))
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

  ! What all specifics of create_from_faces have in common; does nothing after an error.
  subroutine create_from_faces(this, n_cells, faces, index_base, n_threads, code)
    class(riis_adjacency), intent(inout) :: this
    integer(int64), intent(in) :: n_cells
    type(riis_faces), intent(inout) :: faces
    class(*), intent(in), optional :: index_base, n_threads
    integer(riis_status), intent(inout) :: code
    faces%n_cells = n_cells
    faces%index_base = 1
    call get_integer(index_base, 'index_base', faces%index_base, code)
    call get_integer(n_threads, 'n_threads', faces%n_threads, code)
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the adjacency')
    if (code == RIIS_OK) code = riis_adjacency_create_from_faces(faces, this%handle)
  end subroutine create_from_faces

  !> Makes the adjacency of a structured grid of ni * nj * nk nodes, as xyz(3, ni, nj, nk): neighbours differ by 1 in one of
  !! i, j, k. Errors: RIIS_INVALID_ARGUMENT for an argument out of range.
  subroutine adjacency_grid_int32(this, ni, nj, nk, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int32), intent(in) :: ni                        !< >= 1.
    integer(int32), intent(in) :: nj                        !< >= 1.
    integer(int32), intent(in) :: nk                        !< >= 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    call adjacency_grid_int64(this, int(ni, int64), int(nj, int64), int(nk, int64), n_threads, status)
  end subroutine adjacency_grid_int32

  !> The same for integer(int64).
  subroutine adjacency_grid_int64(this, ni, nj, nk, n_threads, status)
    class(riis_adjacency), intent(inout) :: this            !< Empty before.
    integer(int64), intent(in) :: ni                        !< >= 1.
    integer(int64), intent(in) :: nj                        !< >= 1.
    integer(int64), intent(in) :: nk                        !< >= 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024; 0, the default: the processors the
                                                            !! calling thread may use.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    integer(int32) :: n_threads_or_0
    integer(riis_status) :: code
    n_threads_or_0 = 0
    code = check_not_created(this%handle, 'the adjacency')
    call get_integer(n_threads, 'n_threads', n_threads_or_0, code)
    if (code == RIIS_OK) code = riis_adjacency_create_from_grid(ni, nj, nk, n_threads_or_0, this%handle)
    call finish(code, status)
  end subroutine adjacency_grid_int64

  !> Whether the mesh was created and not destroyed.
  pure function mesh_is_created(this) result(is_created)
    class(riis_mesh), intent(in) :: this                     !< Any.
    logical :: is_created                                   !< .false. for an empty one.
    is_created = c_associated(this%handle)
  end function mesh_is_created

  !> The C handle, for calls of module riis_c. It stays this variable's: do not destroy it.
  function mesh_c_handle(this) result(handle)
    class(riis_mesh), intent(in) :: this                     !< Any.
    type(c_ptr) :: handle                                   !< c_null_ptr for an empty one.
    handle = this%handle
  end function mesh_c_handle

  !> Frees what it holds, not the coordinates, and borrows nothing any more; it is empty then, and can be created again.
  !! Nothing happens to an empty one.
  subroutine mesh_destroy(this)
    class(riis_mesh), intent(inout) :: this                  !< Any.
    call riis_mesh_destroy(this%handle)
    this%n = 0
  end subroutine mesh_destroy

  !> Stops the program, unless both are empty.
  impure elemental subroutine mesh_assign(left, right)
    class(riis_mesh), intent(inout) :: left                  !< Empty.
    class(riis_mesh), intent(in) :: right                    !< Empty.
    call refuse_copy(left%handle, right%handle, 'riis_mesh')
  end subroutine mesh_assign

  !> Whether the adjacency was created and not destroyed.
  pure function adjacency_is_created(this) result(is_created)
    class(riis_adjacency), intent(in) :: this                     !< Any.
    logical :: is_created                                   !< .false. for an empty one.
    is_created = c_associated(this%handle)
  end function adjacency_is_created

  !> The C handle, for calls of module riis_c. It stays this variable's: do not destroy it.
  function adjacency_c_handle(this) result(handle)
    class(riis_adjacency), intent(in) :: this                     !< Any.
    type(c_ptr) :: handle                                   !< c_null_ptr for an empty one.
    handle = this%handle
  end function adjacency_c_handle

  !> Frees what it holds; it is empty then, and can be created again. Nothing happens to an empty one.
  subroutine adjacency_destroy(this)
    class(riis_adjacency), intent(inout) :: this                  !< Any.
    call riis_adjacency_destroy(this%handle)
  end subroutine adjacency_destroy

  !> Stops the program, unless both are empty.
  impure elemental subroutine adjacency_assign(left, right)
    class(riis_adjacency), intent(inout) :: left                  !< Empty.
    class(riis_adjacency), intent(in) :: right                    !< Empty.
    call refuse_copy(left%handle, right%handle, 'riis_adjacency')
  end subroutine adjacency_assign
end module riis_meshes
