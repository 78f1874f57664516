! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_meshes.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Meshes: the part of module riis that is riis_mesh_* in riis.h.
module riis_meshes
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c
  use riis_adjacencies, only: riis_adjacency
  use riis_support
  implicit none
  private
  public :: riis_mesh

  !> The caller's nodes. The coordinates are borrowed, as are the rows of an adjacency, and must stay
  !! where they are until the mesh is destroyed or given others. So pass variables that outlive it, whole or as sections by
  !! subscript triplets, of any positive stride; TARGET is not needed. What the compiler copies for the call is gone after
  !! it, and the mesh reads what is there instead. It copies
  !!
  !! - expressions, such as 2 * xyz, transpose(xyz) or (xyz) in parentheses; sections by vector subscripts;
  !! - with gfortran also components of arrays of a derived type, such as nodes%x, and pointers to such: pass the first node
  !!   by nodes(1)%x, nodes(1)%y, nodes(1)%z and a stride instead;
  !! - sections on their way through an argument of yours that is CONTIGUOUS or of explicit shape.
  !!
  !! gfortran shows them with -Warray-temporaries and, when the program runs, with -fcheck=array-temps. Equally bad are local
  !! variables that end, and allocatables that are reallocated.
  !!
  !! Empty until %create, and again after %destroy, which has to be called. May be read by any number of threads at once; is
  !! written by one with no reader beside it.
  type :: riis_mesh
    private
    type(c_ptr) :: handle = c_null_ptr
    integer(int64) :: n = 0
  contains
    generic :: create => create_xyz, create_x_y_z, create_first_int32, create_first_int64
                                                                        !< Borrows coordinates.
    generic :: update => update_xyz, update_x_y_z, update_first_int32, update_first_int64
                                                                        !< Tells that the coordinates moved.
    generic :: set_adjacency => adjacency_int32_int32, adjacency_int32_int64, adjacency_int64_int32, adjacency_int64_int64, &
      adjacency_handle                                         !< Gives what the neighbour search walks along.
    procedure, non_overridable :: clear_adjacency => mesh_clear_adjacency !< Takes it away.
    procedure, non_overridable :: prepare => mesh_prepare               !< Makes what RIIS_SEARCH_CLUSTERS wants, now.
    procedure, non_overridable :: n_nodes => mesh_n_nodes               !< How many nodes.
    procedure, non_overridable :: is_created => mesh_is_created         !< Whether there is anything in it.
    procedure, non_overridable :: c_handle => mesh_c_handle             !< For calls of riis_c.
    procedure, non_overridable :: destroy => mesh_destroy               !< Frees what it holds, not the coordinates.
    generic :: assignment(=) => assign                                  !< Refused: a handle cannot be copied.
    procedure, private, non_overridable :: assign => mesh_assign
    procedure, private, non_overridable :: create_xyz => mesh_create_xyz
    procedure, private, non_overridable :: create_x_y_z => mesh_create_x_y_z
    procedure, private, non_overridable :: create_first_int32 => mesh_create_first_int32
    procedure, private, non_overridable :: create_first_int64 => mesh_create_first_int64
    procedure, private, non_overridable :: update_xyz => mesh_update_xyz
    procedure, private, non_overridable :: update_x_y_z => mesh_update_x_y_z
    procedure, private, non_overridable :: update_first_int32 => mesh_update_first_int32
    procedure, private, non_overridable :: update_first_int64 => mesh_update_first_int64
    procedure, private, non_overridable :: adjacency_int32_int32 => mesh_adjacency_int32_int32
    procedure, private, non_overridable :: adjacency_int32_int64 => mesh_adjacency_int32_int64
    procedure, private, non_overridable :: adjacency_int64_int32 => mesh_adjacency_int64_int32
    procedure, private, non_overridable :: adjacency_int64_int64 => mesh_adjacency_int64_int64
    procedure, private, non_overridable :: adjacency_handle => mesh_adjacency_handle
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

  !> The same for coordinates in an array of a derived type, or wherever else they lie at equal distances:
  !! call mesh%create(size(nodes), nodes(1)%x, nodes(1)%y, nodes(1)%z, storage_size(nodes) / storage_size(nodes(1)%x)). No
  !! compiler can check that there are so many.
  subroutine mesh_create_first_int32(this, n_nodes, x, y, z, stride, status)
    class(riis_mesh), intent(inout) :: this                 !< Empty before.
    integer(int32), intent(in) :: n_nodes                   !< >= 0.
    real(c_double), intent(in), target :: x                 !< Of the first node: an element of an array; borrowed.
    real(c_double), intent(in), target :: y                 !< Of the first node.
    real(c_double), intent(in), target :: z                 !< Of the first node.
    integer(int32), intent(in) :: stride                    !< From one node to the next, in reals, >= 1.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call create_mesh(this, strided_points(int(n_nodes, int64), int(stride, int64), c_loc(x), c_loc(y), c_loc(z)), code)
    call finish(code, status)
  end subroutine mesh_create_first_int32

  !> The same for integer(int64).
  subroutine mesh_create_first_int64(this, n_nodes, x, y, z, stride, status)
    class(riis_mesh), intent(inout) :: this                 !< Empty before.
    integer(int64), intent(in) :: n_nodes                   !< >= 0.
    real(c_double), intent(in), target :: x                 !< Of the first node: an element of an array; borrowed.
    real(c_double), intent(in), target :: y                 !< Of the first node.
    real(c_double), intent(in), target :: z                 !< Of the first node.
    integer(int64), intent(in) :: stride                    !< From one node to the next, in reals, >= 1.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call create_mesh(this, strided_points(int(n_nodes, int64), int(stride, int64), c_loc(x), c_loc(y), c_loc(z)), code)
    call finish(code, status)
  end subroutine mesh_create_first_int64

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

  !> The same for coordinates in an array of a derived type.
  subroutine mesh_update_first_int32(this, n_nodes, x, y, z, stride, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    integer(int32), intent(in) :: n_nodes                   !< >= 0.
    real(c_double), intent(in), target :: x                 !< Of the first node: an element of an array; borrowed.
    real(c_double), intent(in), target :: y                 !< Of the first node.
    real(c_double), intent(in), target :: z                 !< Of the first node.
    integer(int32), intent(in) :: stride                    !< From one node to the next, in reals, >= 1.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call update_mesh(this, strided_points(int(n_nodes, int64), int(stride, int64), c_loc(x), c_loc(y), c_loc(z)), code)
    call finish(code, status)
  end subroutine mesh_update_first_int32

  !> The same for integer(int64).
  subroutine mesh_update_first_int64(this, n_nodes, x, y, z, stride, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    integer(int64), intent(in) :: n_nodes                   !< >= 0.
    real(c_double), intent(in), target :: x                 !< Of the first node: an element of an array; borrowed.
    real(c_double), intent(in), target :: y                 !< Of the first node.
    real(c_double), intent(in), target :: z                 !< Of the first node.
    integer(int64), intent(in) :: stride                    !< From one node to the next, in reals, >= 1.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call update_mesh(this, strided_points(int(n_nodes, int64), int(stride, int64), c_loc(x), c_loc(y), c_loc(z)), code)
    call finish(code, status)
  end subroutine mesh_update_first_int64

  ! What all specifics of create have in common; does nothing after an error.
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
    integer(int32), intent(in), target :: offsets(:)        !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int32), intent(in), target :: columns(:)        !< (>= offsets(n_nodes + 1) - index_base), from index_base;
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
    integer(int32), intent(in), target :: offsets(:)        !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int64), intent(in), target :: columns(:)        !< (>= offsets(n_nodes + 1) - index_base), from index_base;
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
    integer(int64), intent(in), target :: offsets(:)        !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int32), intent(in), target :: columns(:)        !< (>= offsets(n_nodes + 1) - index_base), from index_base;
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
    integer(int64), intent(in), target :: offsets(:)        !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int64), intent(in), target :: columns(:)        !< (>= offsets(n_nodes + 1) - index_base), from index_base;
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
    if (code == RIIS_OK) code = check_created(adjacency%c_handle(), 'adjacency')
    if (code == RIIS_OK) code = riis_adjacency_csr(adjacency%c_handle(), csr, c_sizeof(csr))
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

  !> Makes what RIIS_SEARCH_CLUSTERS wants of the mesh now, rather than in the first marking that does: the order of its nodes in
  !! clusters, about 17 bytes a node. After an update with as many nodes the order stays, and only places are made again.
  subroutine mesh_prepare(this, n_threads, status)
    class(riis_mesh), intent(inout) :: this                 !< Created.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024, or 0, the default: the processors there are.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error, which otherwise stops the program.
    integer(int32) :: threads
    integer(riis_status) :: code
    threads = 0
    code = check_created(this%handle, 'the mesh')
    call get_integer(n_threads, 'n_threads', threads, code)
    if (code == RIIS_OK) code = riis_mesh_prepare(this%handle, threads)
    call finish(code, status)
  end subroutine mesh_prepare

  !> How many nodes the mesh has.
  pure function mesh_n_nodes(this) result(n)
    class(riis_mesh), intent(in) :: this                    !< Any.
    integer(int64) :: n                                     !< 0 for an empty one.
    n = this%n
  end function mesh_n_nodes

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
end module riis_meshes
