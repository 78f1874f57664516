! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_meshes.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Meshes: riis_mesh_* of riis.h, as a part of module riis.
module riis_meshes
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use riis_c
  use riis_adjacencies, only: riis_adjacency
  use riis_support
  implicit none
  private
  public :: riis_mesh

  !> The caller's nodes. The coordinates and the rows of an adjacency are borrowed: they must stay in place until the mesh is
  !! destroyed or gets other arrays. Pass variables that outlive the mesh, as whole arrays or as sections with subscript triplets
  !! and any positive stride. TARGET is not needed. If the compiler passes a copy, the copy is lost after the call, and the mesh
  !! then reads other data. The compiler copies
  !!
  !! - expressions, such as 2 * xyz, transpose(xyz) or (xyz) in parentheses;
  !! - sections with vector subscripts;
  !! - with gfortran, components of arrays of a derived type, such as nodes%x, and pointers to them: pass the first node
  !!   as nodes(1)%x, nodes(1)%y, nodes(1)%z and a stride instead;
  !! - sections that pass through an argument of your own procedure that is CONTIGUOUS or of explicit shape.
  !!
  !! gfortran shows these copies with -Warray-temporaries and, when the program runs, with -fcheck=array-temps. Local variables
  !! that end, and allocatable arrays that are reallocated, have the same effect.
  !!
  !! A mesh is empty before %create and after %destroy. Call %destroy, since nothing else frees it. Any number of threads may read
  !! it at once. One thread may write it while no other reads it.
  type :: riis_mesh
    private
    type(c_ptr) :: handle = c_null_ptr
    integer(int64) :: n = 0
  contains
    generic :: create => create_xyz, create_x_y_z, create_first_int32, create_first_int64
                                                                        !< Makes a mesh that borrows coordinates.
    generic :: update => update_xyz, update_x_y_z, update_first_int32, update_first_int64
                                                                        !< Tells the mesh that coordinates changed.
    generic :: create_copy => create_copy_xyz_real32, create_copy_xyz_real64, create_copy_x_y_z_real32, create_copy_x_y_z_real64
                                                                        !< Makes a mesh that copies coordinates.
    generic :: update_copy => update_copy_xyz_real32, update_copy_xyz_real64, update_copy_x_y_z_real32, update_copy_x_y_z_real64
                                                                        !< Copies new coordinates.
    generic :: create_grid => create_grid_real32, create_grid_real64    !< Makes a mesh from the axes of a grid.
    generic :: update_grid => update_grid_real32, update_grid_real64    !< Gives the mesh other axes.
    generic :: set_adjacency => adjacency_int32_int32, adjacency_int32_int64, adjacency_int64_int32, adjacency_int64_int64, &
      adjacency_handle                                         !< Sets the adjacency for the neighbour search.
    procedure, non_overridable :: clear_adjacency => mesh_clear_adjacency !< Removes the adjacency.
    procedure, non_overridable :: prepare => mesh_prepare               !< Makes the clusters of RIIS_SEARCH_CLUSTERS now.
    procedure, non_overridable :: n_nodes => mesh_n_nodes               !< Returns the number of nodes.
    procedure, non_overridable :: is_created => mesh_is_created         !< Returns whether the object was created.
    procedure, non_overridable :: c_handle => mesh_c_handle             !< The handle for calls of riis_c.
    procedure, non_overridable :: destroy => mesh_destroy               !< Frees its memory, not the coordinates.
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
    procedure, private, non_overridable :: create_copy_xyz_real32 => mesh_create_copy_xyz_real32
    procedure, private, non_overridable :: create_copy_xyz_real64 => mesh_create_copy_xyz_real64
    procedure, private, non_overridable :: create_copy_x_y_z_real32 => mesh_create_copy_x_y_z_real32
    procedure, private, non_overridable :: create_copy_x_y_z_real64 => mesh_create_copy_x_y_z_real64
    procedure, private, non_overridable :: update_copy_xyz_real32 => mesh_update_copy_xyz_real32
    procedure, private, non_overridable :: update_copy_xyz_real64 => mesh_update_copy_xyz_real64
    procedure, private, non_overridable :: update_copy_x_y_z_real32 => mesh_update_copy_x_y_z_real32
    procedure, private, non_overridable :: update_copy_x_y_z_real64 => mesh_update_copy_x_y_z_real64
    procedure, private, non_overridable :: create_grid_real32 => mesh_create_grid_real32
    procedure, private, non_overridable :: create_grid_real64 => mesh_create_grid_real64
    procedure, private, non_overridable :: update_grid_real32 => mesh_update_grid_real32
    procedure, private, non_overridable :: update_grid_real64 => mesh_update_grid_real64
    procedure, private, non_overridable :: adjacency_int32_int32 => mesh_adjacency_int32_int32
    procedure, private, non_overridable :: adjacency_int32_int64 => mesh_adjacency_int32_int64
    procedure, private, non_overridable :: adjacency_int64_int32 => mesh_adjacency_int64_int32
    procedure, private, non_overridable :: adjacency_int64_int64 => mesh_adjacency_int64_int64
    procedure, private, non_overridable :: adjacency_handle => mesh_adjacency_handle
  end type riis_mesh

contains

  !> Makes a mesh that borrows node coordinates, and checks them once. The columns of xyz may be any multiple of a real (8 bytes)
  !! apart, and its rows any distance. Errors: RIIS_INVALID_MESH naming the node, counted from 0, and the value.
  subroutine mesh_create_xyz(this, xyz, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be empty.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_nodes), any positive stride; finite; borrowed.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(strided_points) :: points
    call points_of(xyz, 'xyz', points, code)
    call create_mesh(this, points, code)
    call finish(code, status)
  end subroutine mesh_create_xyz

  !> Works like the version for xyz(3, n), with separate arrays x, y, z of the same stride.
  subroutine mesh_create_x_y_z(this, x, y, z, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be empty.
    real(c_double), intent(in), target :: x(:)              !< (n_nodes), any positive stride; finite; borrowed.
    real(c_double), intent(in), target :: y(:)              !< (n_nodes), any positive stride; finite; borrowed.
    real(c_double), intent(in), target :: z(:)              !< (n_nodes), any positive stride; finite; borrowed.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(strided_points) :: points
    call points_of(x, y, z, points, code)
    call create_mesh(this, points, code)
    call finish(code, status)
  end subroutine mesh_create_x_y_z

  !> Makes a mesh from coordinates at equal distances in memory, as in an array of a derived type:
  !! call mesh%create(size(nodes), nodes(1)%x, nodes(1)%y, nodes(1)%z, storage_size(nodes) / storage_size(nodes(1)%x)). No
  !! compiler can check the number of nodes.
  subroutine mesh_create_first_int32(this, n_nodes, x, y, z, stride, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be empty.
    integer(int32), intent(in) :: n_nodes                   !< >= 0.
    real(c_double), intent(in), target :: x                 !< The first node's x, an element of an array; borrowed.
    real(c_double), intent(in), target :: y                 !< The first node's y.
    real(c_double), intent(in), target :: z                 !< The first node's z.
    integer(int32), intent(in) :: stride                    !< The distance from one node to the next, in reals, >= 1.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call create_mesh(this, strided_points(int(n_nodes, int64), int(stride, int64), c_loc(x), c_loc(y), c_loc(z)), code)
    call finish(code, status)
  end subroutine mesh_create_first_int32

  !> Does the same for integer(int64).
  subroutine mesh_create_first_int64(this, n_nodes, x, y, z, stride, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be empty.
    integer(int64), intent(in) :: n_nodes                   !< >= 0.
    real(c_double), intent(in), target :: x                 !< The first node's x, an element of an array; borrowed.
    real(c_double), intent(in), target :: y                 !< The first node's y.
    real(c_double), intent(in), target :: z                 !< The first node's z.
    integer(int64), intent(in) :: stride                    !< The distance from one node to the next, in reals, >= 1.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call create_mesh(this, strided_points(int(n_nodes, int64), int(stride, int64), c_loc(x), c_loc(y), c_loc(z)), code)
    call finish(code, status)
  end subroutine mesh_create_first_int64

  !> Tells the mesh that the coordinates changed, in place or to another array, and checks them again. Call it after every change
  !! of coordinates. The adjacency stays if the number of nodes stays. The errors are those of %create.
  subroutine mesh_update_xyz(this, xyz, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_nodes), any positive stride; finite; borrowed.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(strided_points) :: points
    call points_of(xyz, 'xyz', points, code)
    call update_mesh(this, points, code)
    call finish(code, status)
  end subroutine mesh_update_xyz

  !> Works like the version for xyz(3, n), with separate arrays x, y, z of the same stride.
  subroutine mesh_update_x_y_z(this, x, y, z, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    real(c_double), intent(in), target :: x(:)              !< (n_nodes), any positive stride; finite; borrowed.
    real(c_double), intent(in), target :: y(:)              !< (n_nodes), any positive stride; finite; borrowed.
    real(c_double), intent(in), target :: z(:)              !< (n_nodes), any positive stride; finite; borrowed.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(strided_points) :: points
    call points_of(x, y, z, points, code)
    call update_mesh(this, points, code)
    call finish(code, status)
  end subroutine mesh_update_x_y_z

  !> Updates coordinates that lie in an array of a derived type.
  subroutine mesh_update_first_int32(this, n_nodes, x, y, z, stride, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    integer(int32), intent(in) :: n_nodes                   !< >= 0.
    real(c_double), intent(in), target :: x                 !< The first node's x, an element of an array; borrowed.
    real(c_double), intent(in), target :: y                 !< The first node's y.
    real(c_double), intent(in), target :: z                 !< The first node's z.
    integer(int32), intent(in) :: stride                    !< The distance from one node to the next, in reals, >= 1.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call update_mesh(this, strided_points(int(n_nodes, int64), int(stride, int64), c_loc(x), c_loc(y), c_loc(z)), code)
    call finish(code, status)
  end subroutine mesh_update_first_int32

  !> Does the same for integer(int64).
  subroutine mesh_update_first_int64(this, n_nodes, x, y, z, stride, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    integer(int64), intent(in) :: n_nodes                   !< >= 0.
    real(c_double), intent(in), target :: x                 !< The first node's x, an element of an array; borrowed.
    real(c_double), intent(in), target :: y                 !< The first node's y.
    real(c_double), intent(in), target :: z                 !< The first node's z.
    integer(int64), intent(in) :: stride                    !< The distance from one node to the next, in reals, >= 1.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = RIIS_OK
    call update_mesh(this, strided_points(int(n_nodes, int64), int(stride, int64), c_loc(x), c_loc(y), c_loc(z)), code)
    call finish(code, status)
  end subroutine mesh_update_first_int64

  !> Makes a mesh that copies node coordinates, in single or double precision, and checks them. Any expression may be passed.
  !! Single precision is converted to double once, exactly. Errors: RIIS_INVALID_MESH naming the node, counted from 0, and the
  !! value.
  subroutine mesh_create_copy_xyz_real32(this, xyz, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be empty.
    real(real32), intent(in), contiguous, target :: xyz(:, :) !< (3, n_nodes), finite.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_points) :: nodes
    code = riis_points_init(nodes, c_sizeof(nodes))
    if (code == RIIS_OK .and. size(xyz, 1) /= 3) &
      code = refuse('the first extent of xyz is ' // text_of(size(xyz, 1)) // '; it must be 3')
    nodes%n_points = size(xyz, 2, int64)
    nodes%stride = 3
    nodes%real_bits = storage_size(xyz)
    if (nodes%n_points > 0 .and. size(xyz, 1) == 3) then
      nodes%x = c_loc(xyz(1, 1))
      nodes%y = c_loc(xyz(2, 1))
      nodes%z = c_loc(xyz(3, 1))
    end if
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_create_copy(nodes, this%handle)
    if (code == RIIS_OK) this%n = nodes%n_points
    call finish(code, status)
  end subroutine mesh_create_copy_xyz_real32

  !> Does the same.
  subroutine mesh_create_copy_xyz_real64(this, xyz, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be empty.
    real(real64), intent(in), contiguous, target :: xyz(:, :) !< (3, n_nodes), finite.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_points) :: nodes
    code = riis_points_init(nodes, c_sizeof(nodes))
    if (code == RIIS_OK .and. size(xyz, 1) /= 3) &
      code = refuse('the first extent of xyz is ' // text_of(size(xyz, 1)) // '; it must be 3')
    nodes%n_points = size(xyz, 2, int64)
    nodes%stride = 3
    nodes%real_bits = storage_size(xyz)
    if (nodes%n_points > 0 .and. size(xyz, 1) == 3) then
      nodes%x = c_loc(xyz(1, 1))
      nodes%y = c_loc(xyz(2, 1))
      nodes%z = c_loc(xyz(3, 1))
    end if
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_create_copy(nodes, this%handle)
    if (code == RIIS_OK) this%n = nodes%n_points
    call finish(code, status)
  end subroutine mesh_create_copy_xyz_real64

  !> Does the same.
  subroutine mesh_create_copy_x_y_z_real32(this, x, y, z, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be empty.
    real(real32), intent(in), contiguous, target :: x(:) !< (n_nodes), finite.
    real(real32), intent(in), contiguous, target :: y(:) !< (n_nodes), finite.
    real(real32), intent(in), contiguous, target :: z(:) !< (n_nodes), finite.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_points) :: nodes
    code = riis_points_init(nodes, c_sizeof(nodes))
    nodes%n_points = size(x, kind=int64)
    nodes%real_bits = storage_size(x)
    if (code == RIIS_OK) code = check_size(size(y, kind=int64), nodes%n_points, 'y', 'entries in x')
    if (code == RIIS_OK) code = check_size(size(z, kind=int64), nodes%n_points, 'z', 'entries in x')
    if (nodes%n_points > 0) then
      nodes%x = c_loc(x)
      nodes%y = c_loc(y)
      nodes%z = c_loc(z)
    end if
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_create_copy(nodes, this%handle)
    if (code == RIIS_OK) this%n = nodes%n_points
    call finish(code, status)
  end subroutine mesh_create_copy_x_y_z_real32

  !> Does the same.
  subroutine mesh_create_copy_x_y_z_real64(this, x, y, z, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be empty.
    real(real64), intent(in), contiguous, target :: x(:) !< (n_nodes), finite.
    real(real64), intent(in), contiguous, target :: y(:) !< (n_nodes), finite.
    real(real64), intent(in), contiguous, target :: z(:) !< (n_nodes), finite.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_points) :: nodes
    code = riis_points_init(nodes, c_sizeof(nodes))
    nodes%n_points = size(x, kind=int64)
    nodes%real_bits = storage_size(x)
    if (code == RIIS_OK) code = check_size(size(y, kind=int64), nodes%n_points, 'y', 'entries in x')
    if (code == RIIS_OK) code = check_size(size(z, kind=int64), nodes%n_points, 'z', 'entries in x')
    if (nodes%n_points > 0) then
      nodes%x = c_loc(x)
      nodes%y = c_loc(y)
      nodes%z = c_loc(z)
    end if
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_create_copy(nodes, this%handle)
    if (code == RIIS_OK) this%n = nodes%n_points
    call finish(code, status)
  end subroutine mesh_create_copy_x_y_z_real64

  !> Copies new coordinates. A mesh may change between borrowed and copied coordinates. The errors are those of %create_copy.
  subroutine mesh_update_copy_xyz_real32(this, xyz, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    real(real32), intent(in), contiguous, target :: xyz(:, :) !< (3, n_nodes), finite.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_points) :: nodes
    code = riis_points_init(nodes, c_sizeof(nodes))
    if (code == RIIS_OK .and. size(xyz, 1) /= 3) &
      code = refuse('the first extent of xyz is ' // text_of(size(xyz, 1)) // '; it must be 3')
    nodes%n_points = size(xyz, 2, int64)
    nodes%stride = 3
    nodes%real_bits = storage_size(xyz)
    if (nodes%n_points > 0 .and. size(xyz, 1) == 3) then
      nodes%x = c_loc(xyz(1, 1))
      nodes%y = c_loc(xyz(2, 1))
      nodes%z = c_loc(xyz(3, 1))
    end if
    if (code == RIIS_OK) code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_update_copy(this%handle, nodes)
    if (code == RIIS_OK) this%n = nodes%n_points
    call finish(code, status)
  end subroutine mesh_update_copy_xyz_real32

  !> Does the same.
  subroutine mesh_update_copy_xyz_real64(this, xyz, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    real(real64), intent(in), contiguous, target :: xyz(:, :) !< (3, n_nodes), finite.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_points) :: nodes
    code = riis_points_init(nodes, c_sizeof(nodes))
    if (code == RIIS_OK .and. size(xyz, 1) /= 3) &
      code = refuse('the first extent of xyz is ' // text_of(size(xyz, 1)) // '; it must be 3')
    nodes%n_points = size(xyz, 2, int64)
    nodes%stride = 3
    nodes%real_bits = storage_size(xyz)
    if (nodes%n_points > 0 .and. size(xyz, 1) == 3) then
      nodes%x = c_loc(xyz(1, 1))
      nodes%y = c_loc(xyz(2, 1))
      nodes%z = c_loc(xyz(3, 1))
    end if
    if (code == RIIS_OK) code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_update_copy(this%handle, nodes)
    if (code == RIIS_OK) this%n = nodes%n_points
    call finish(code, status)
  end subroutine mesh_update_copy_xyz_real64

  !> Does the same.
  subroutine mesh_update_copy_x_y_z_real32(this, x, y, z, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    real(real32), intent(in), contiguous, target :: x(:) !< (n_nodes), finite.
    real(real32), intent(in), contiguous, target :: y(:) !< (n_nodes), finite.
    real(real32), intent(in), contiguous, target :: z(:) !< (n_nodes), finite.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_points) :: nodes
    code = riis_points_init(nodes, c_sizeof(nodes))
    nodes%n_points = size(x, kind=int64)
    nodes%real_bits = storage_size(x)
    if (code == RIIS_OK) code = check_size(size(y, kind=int64), nodes%n_points, 'y', 'entries in x')
    if (code == RIIS_OK) code = check_size(size(z, kind=int64), nodes%n_points, 'z', 'entries in x')
    if (nodes%n_points > 0) then
      nodes%x = c_loc(x)
      nodes%y = c_loc(y)
      nodes%z = c_loc(z)
    end if
    if (code == RIIS_OK) code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_update_copy(this%handle, nodes)
    if (code == RIIS_OK) this%n = nodes%n_points
    call finish(code, status)
  end subroutine mesh_update_copy_x_y_z_real32

  !> Does the same.
  subroutine mesh_update_copy_x_y_z_real64(this, x, y, z, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    real(real64), intent(in), contiguous, target :: x(:) !< (n_nodes), finite.
    real(real64), intent(in), contiguous, target :: y(:) !< (n_nodes), finite.
    real(real64), intent(in), contiguous, target :: z(:) !< (n_nodes), finite.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_points) :: nodes
    code = riis_points_init(nodes, c_sizeof(nodes))
    nodes%n_points = size(x, kind=int64)
    nodes%real_bits = storage_size(x)
    if (code == RIIS_OK) code = check_size(size(y, kind=int64), nodes%n_points, 'y', 'entries in x')
    if (code == RIIS_OK) code = check_size(size(z, kind=int64), nodes%n_points, 'z', 'entries in x')
    if (nodes%n_points > 0) then
      nodes%x = c_loc(x)
      nodes%y = c_loc(y)
      nodes%z = c_loc(z)
    end if
    if (code == RIIS_OK) code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_update_copy(this%handle, nodes)
    if (code == RIIS_OK) this%n = nodes%n_points
    call finish(code, status)
  end subroutine mesh_update_copy_x_y_z_real64

  !> Makes a mesh from the axes of a rectilinear grid, and stores nothing for each node. Node (i, j, k) is at x(i), y(j), z(k).
  !! Its number is first + (i - 1) stride(1) + (j - 1) stride(2) + (k - 1) stride(3). An array K(0:ni+1, 0:nj+1, 0:nk+1) has
  !! halo=1, because an argument loses its lower bounds. Each component of the velocity of a staggered grid has its own axes, so
  !! it has its own mesh. Errors: RIIS_INVALID_MESH naming the axis, the index, counted from 0, and the value.
  subroutine mesh_create_grid_real32(this, x, y, z, halo, first, stride, n_nodes, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be empty.
    real(real32), intent(in), contiguous, target :: x(:) !< At least one node, strictly ascending; copied.
    real(real32), intent(in), contiguous, target :: y(:) !< At least one node, strictly ascending; copied.
    real(real32), intent(in), contiguous, target :: z(:) !< At least one node, strictly ascending; copied.
    class(*), intent(in), optional :: halo                  !< integer: layers around the nodes in the caller's arrays. Without
                                                            !! halo, the call uses first, stride and n_nodes.
    class(*), intent(in), optional :: first                 !< integer: the number of node (1, 1, 1). Default 1.
    class(*), intent(in), optional :: stride(:)             !< integer (3): from a node to the next along each axis. Default 1,
                                                            !! size(x), size(x) * size(y).
    class(*), intent(in), optional :: n_nodes               !< integer: the length of the caller's arrays. Default: the least.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_grid) :: grid
    code = riis_grid_init(grid, c_sizeof(grid))
    grid%ni = size(x, kind=int64)
    grid%nj = size(y, kind=int64)
    grid%nk = size(z, kind=int64)
    if (min(grid%ni, grid%nj, grid%nk) > 0) then
      grid%x = c_loc(x)
      grid%y = c_loc(y)
      grid%z = c_loc(z)
    end if
    grid%real_bits = storage_size(x)
    call set_numbers(grid, halo, first, stride, n_nodes, code)
    call create_mesh_of_grid(this, grid, code)
    call finish(code, status)
  end subroutine mesh_create_grid_real32

  !> Does the same.
  subroutine mesh_create_grid_real64(this, x, y, z, halo, first, stride, n_nodes, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be empty.
    real(real64), intent(in), contiguous, target :: x(:) !< At least one node, strictly ascending; copied.
    real(real64), intent(in), contiguous, target :: y(:) !< At least one node, strictly ascending; copied.
    real(real64), intent(in), contiguous, target :: z(:) !< At least one node, strictly ascending; copied.
    class(*), intent(in), optional :: halo                  !< integer: layers around the nodes in the caller's arrays. Without
                                                            !! halo, the call uses first, stride and n_nodes.
    class(*), intent(in), optional :: first                 !< integer: the number of node (1, 1, 1). Default 1.
    class(*), intent(in), optional :: stride(:)             !< integer (3): from a node to the next along each axis. Default 1,
                                                            !! size(x), size(x) * size(y).
    class(*), intent(in), optional :: n_nodes               !< integer: the length of the caller's arrays. Default: the least.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_grid) :: grid
    code = riis_grid_init(grid, c_sizeof(grid))
    grid%ni = size(x, kind=int64)
    grid%nj = size(y, kind=int64)
    grid%nk = size(z, kind=int64)
    if (min(grid%ni, grid%nj, grid%nk) > 0) then
      grid%x = c_loc(x)
      grid%y = c_loc(y)
      grid%z = c_loc(z)
    end if
    grid%real_bits = storage_size(x)
    call set_numbers(grid, halo, first, stride, n_nodes, code)
    call create_mesh_of_grid(this, grid, code)
    call finish(code, status)
  end subroutine mesh_create_grid_real64

  !> Gives a mesh other axes. A mesh may change between a grid and coordinates of nodes. The errors are those of %create_grid.
  subroutine mesh_update_grid_real32(this, x, y, z, halo, first, stride, n_nodes, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    real(real32), intent(in), contiguous, target :: x(:) !< At least one node, strictly ascending; copied.
    real(real32), intent(in), contiguous, target :: y(:) !< At least one node, strictly ascending; copied.
    real(real32), intent(in), contiguous, target :: z(:) !< At least one node, strictly ascending; copied.
    class(*), intent(in), optional :: halo                  !< integer: layers around the nodes in the caller's arrays. Without
                                                            !! halo, the call uses first, stride and n_nodes.
    class(*), intent(in), optional :: first                 !< integer: the number of node (1, 1, 1). Default 1.
    class(*), intent(in), optional :: stride(:)             !< integer (3): from a node to the next along each axis. Default 1,
                                                            !! size(x), size(x) * size(y).
    class(*), intent(in), optional :: n_nodes               !< integer: the length of the caller's arrays. Default: the least.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_grid) :: grid
    code = riis_grid_init(grid, c_sizeof(grid))
    grid%ni = size(x, kind=int64)
    grid%nj = size(y, kind=int64)
    grid%nk = size(z, kind=int64)
    if (min(grid%ni, grid%nj, grid%nk) > 0) then
      grid%x = c_loc(x)
      grid%y = c_loc(y)
      grid%z = c_loc(z)
    end if
    grid%real_bits = storage_size(x)
    call set_numbers(grid, halo, first, stride, n_nodes, code)
    call update_mesh_of_grid(this, grid, code)
    call finish(code, status)
  end subroutine mesh_update_grid_real32

  !> Does the same.
  subroutine mesh_update_grid_real64(this, x, y, z, halo, first, stride, n_nodes, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    real(real64), intent(in), contiguous, target :: x(:) !< At least one node, strictly ascending; copied.
    real(real64), intent(in), contiguous, target :: y(:) !< At least one node, strictly ascending; copied.
    real(real64), intent(in), contiguous, target :: z(:) !< At least one node, strictly ascending; copied.
    class(*), intent(in), optional :: halo                  !< integer: layers around the nodes in the caller's arrays. Without
                                                            !! halo, the call uses first, stride and n_nodes.
    class(*), intent(in), optional :: first                 !< integer: the number of node (1, 1, 1). Default 1.
    class(*), intent(in), optional :: stride(:)             !< integer (3): from a node to the next along each axis. Default 1,
                                                            !! size(x), size(x) * size(y).
    class(*), intent(in), optional :: n_nodes               !< integer: the length of the caller's arrays. Default: the least.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_grid) :: grid
    code = riis_grid_init(grid, c_sizeof(grid))
    grid%ni = size(x, kind=int64)
    grid%nj = size(y, kind=int64)
    grid%nk = size(z, kind=int64)
    if (min(grid%ni, grid%nj, grid%nk) > 0) then
      grid%x = c_loc(x)
      grid%y = c_loc(y)
      grid%z = c_loc(z)
    end if
    grid%real_bits = storage_size(x)
    call set_numbers(grid, halo, first, stride, n_nodes, code)
    call update_mesh_of_grid(this, grid, code)
    call finish(code, status)
  end subroutine mesh_update_grid_real64

  ! Gives a grid the numbers of its nodes. It does nothing after an error.
  subroutine set_numbers(grid, halo, first, stride, n_nodes, code)
    type(riis_grid), intent(inout) :: grid
    class(*), intent(in), optional :: halo, first, stride(:), n_nodes
    integer(riis_status), intent(inout) :: code
    integer(int64) :: width, first_number, extents(3)
    if (code /= RIIS_OK) return
    if (present(halo)) then
      call get_integer(halo, 'halo', width, code)
      if (code /= RIIS_OK) return
      if (present(first) .or. present(stride) .or. present(n_nodes)) then
        code = refuse('halo stands for first, stride and n_nodes, so only one of both is taken')
      else if (width < 0 .or. width > 2_int64**30) then
        code = refuse('halo is ' // text_of(width) // '; it must be from 0 to 2^30')
      else
        extents = [grid%ni, grid%nj, grid%nk] + 2 * width
        grid%n_nodes = huge(width) ! the library refuses so many
        if (product(real(extents, real64)) < 2.0_real64**41) then
          grid%n_nodes = product(extents)
          grid%stride = [1_int64, extents(1), extents(1) * extents(2)]
          grid%first = width * sum(grid%stride)
        end if
      end if
      return
    end if
    first_number = 1
    call get_integer(first, 'first', first_number, code)
    grid%first = first_number - 1
    if (code == RIIS_OK .and. first_number < 1) &
      code = refuse('first is ' // text_of(first_number) // '; it must be at least 1')
    call get_integer(n_nodes, 'n_nodes', grid%n_nodes, code)
    if (.not. present(stride)) return
    if (size(stride) /= 3) then
      code = refuse('the size of stride is ' // text_of(size(stride)) // '; it must be 3')
      return
    end if
    select type (stride)
    type is (integer(int32))
      grid%stride = stride
    type is (integer(int64))
      grid%stride = stride
    class default
      code = refuse('stride is neither integer(int32) nor integer(int64)')
    end select
  end subroutine set_numbers

  ! Returns the length of the caller's arrays. The library has checked the grid.
  function n_numbers_of(grid) result(n)
    type(riis_grid), intent(in) :: grid
    integer(int64) :: n
    integer(int64) :: extents(3), stride(3)
    extents = [grid%ni, grid%nj, grid%nk]
    stride = grid%stride
    if (all(stride == 0)) stride = [1_int64, grid%ni, grid%ni * grid%nj]
    n = grid%n_nodes
    if (n == 0) n = grid%first + 1 + sum((extents - 1) * stride, mask=extents > 1)
  end function n_numbers_of

  ! The common part of all specific procedures of create. It does nothing after an error.
  subroutine create_mesh(this, points, code)
    class(riis_mesh), intent(inout) :: this
    type(strided_points), intent(in) :: points
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the mesh')
    if (code == RIIS_OK) &
      code = riis_mesh_create(points%n, points%x, points%y, points%z, points%stride, this%handle)
    if (code == RIIS_OK) this%n = points%n
  end subroutine create_mesh

  ! The common part of all specific procedures of create_grid. It does nothing after an error.
  subroutine create_mesh_of_grid(this, grid, code)
    class(riis_mesh), intent(inout) :: this
    type(riis_grid), intent(in) :: grid
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_create_grid(grid, this%handle)
    if (code == RIIS_OK) this%n = n_numbers_of(grid)
  end subroutine create_mesh_of_grid

  ! The common part of all specific procedures of update. It does nothing after an error.
  subroutine update_mesh(this, points, code)
    class(riis_mesh), intent(inout) :: this
    type(strided_points), intent(in) :: points
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK) code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) &
      code = riis_mesh_update(this%handle, points%n, points%x, points%y, points%z, points%stride)
    if (code == RIIS_OK) this%n = points%n
  end subroutine update_mesh

  ! The common part of all specific procedures of update_grid. It does nothing after an error.
  subroutine update_mesh_of_grid(this, grid, code)
    class(riis_mesh), intent(inout) :: this
    type(riis_grid), intent(in) :: grid
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK) code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_update_grid(this%handle, grid)
    if (code == RIIS_OK) this%n = n_numbers_of(grid)
  end subroutine update_mesh_of_grid

  !> Gives the mesh its adjacency as compressed sparse rows and checks them once. The rows are borrowed: they must be contiguous
  !! and stay in place, unchanged, until the mesh is destroyed or gets other rows. With the default base, the neighbours of node i
  !! are columns(offsets(i) : offsets(i + 1) - 1), in any order. Errors: RIIS_INVALID_ARGUMENT for sizes that do not match and for
  !! sections that are not contiguous, RIIS_INVALID_MESH naming the row, counted from 0, and its value. The mesh then keeps its
  !! earlier rows.
  subroutine mesh_adjacency_int32_int32(this, offsets, columns, index_base, n_all, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    integer(int32), intent(in), target :: offsets(:)        !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int32), intent(in), target :: columns(:)        !< (>= offsets(n_nodes + 1) - index_base), from index_base;
                                                            !! borrowed.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number and the first offset.
                                                            !! Default 1.
    class(*), intent(in), optional :: n_all                 !< integer: n_nodes plus the ghost nodes, which columns may name and
                                                            !! which are ignored. Default: n_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_csr) :: csr
    integer(int64) :: n_offsets, n_columns
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

  !> Implements %set_adjacency for other integer kinds.
  subroutine mesh_adjacency_int32_int64(this, offsets, columns, index_base, n_all, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    integer(int32), intent(in), target :: offsets(:)        !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int64), intent(in), target :: columns(:)        !< (>= offsets(n_nodes + 1) - index_base), from index_base;
                                                            !! borrowed.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number and the first offset.
                                                            !! Default 1.
    class(*), intent(in), optional :: n_all                 !< integer: n_nodes plus the ghost nodes, which columns may name and
                                                            !! which are ignored. Default: n_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_csr) :: csr
    integer(int64) :: n_offsets, n_columns
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

  !> Implements %set_adjacency for other integer kinds.
  subroutine mesh_adjacency_int64_int32(this, offsets, columns, index_base, n_all, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    integer(int64), intent(in), target :: offsets(:)        !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int32), intent(in), target :: columns(:)        !< (>= offsets(n_nodes + 1) - index_base), from index_base;
                                                            !! borrowed.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number and the first offset.
                                                            !! Default 1.
    class(*), intent(in), optional :: n_all                 !< integer: n_nodes plus the ghost nodes, which columns may name and
                                                            !! which are ignored. Default: n_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_csr) :: csr
    integer(int64) :: n_offsets, n_columns
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

  !> Implements %set_adjacency for other integer kinds.
  subroutine mesh_adjacency_int64_int64(this, offsets, columns, index_base, n_all, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    integer(int64), intent(in), target :: offsets(:)        !< (n_nodes + 1), ascending from index_base; borrowed.
    integer(int64), intent(in), target :: columns(:)        !< (>= offsets(n_nodes + 1) - index_base), from index_base;
                                                            !! borrowed.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first node's number and the first offset.
                                                            !! Default 1.
    class(*), intent(in), optional :: n_all                 !< integer: n_nodes plus the ghost nodes, which columns may name and
                                                            !! which are ignored. Default: n_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_csr) :: csr
    integer(int64) :: n_offsets, n_columns
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

  ! Checks that the rows can be borrowed, and that there is one row for each node.
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

  ! The common part for all kinds of rows.
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

  !> Gives the mesh the rows of an adjacency that the library made. The adjacency must live until the mesh is destroyed or
  !! gets other rows. Errors: RIIS_INVALID_ARGUMENT for an adjacency of another number of nodes.
  subroutine mesh_adjacency_handle(this, adjacency, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    class(riis_adjacency), intent(in) :: adjacency          !< Must be created. Destroy it after the mesh.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_csr) :: csr
    code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = check_created(adjacency%c_handle(), 'adjacency')
    if (code == RIIS_OK) code = riis_adjacency_get_csr(adjacency%c_handle(), csr, c_sizeof(csr))
    if (code == RIIS_OK) code = riis_mesh_set_adjacency(this%handle, csr)
    call finish(code, status)
  end subroutine mesh_adjacency_handle

  !> Removes the mesh's adjacency. Its rows are not borrowed any more.
  subroutine mesh_clear_adjacency(this, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_created(this%handle, 'the mesh')
    if (code == RIIS_OK) code = riis_mesh_set_adjacency(this%handle)
    call finish(code, status)
  end subroutine mesh_clear_adjacency

  !> Makes the clusters of RIIS_SEARCH_CLUSTERS now, not in the first marking that uses them. They take 41 bytes per node as long
  !! as the mesh lives. After an update with the same number of nodes, their order stays, and only positions are updated.
  subroutine mesh_prepare(this, n_threads, status)
    class(riis_mesh), intent(inout) :: this                 !< Must be created.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int32) :: threads
    threads = 0
    code = check_created(this%handle, 'the mesh')
    call get_integer(n_threads, 'n_threads', threads, code)
    if (code == RIIS_OK) code = riis_mesh_prepare(this%handle, threads)
    call finish(code, status)
  end subroutine mesh_prepare

  !> Returns the number of nodes of the mesh.
  pure function mesh_n_nodes(this) result(n)
    class(riis_mesh), intent(in) :: this                    !< May be empty.
    integer(int64) :: n                                     !< 0 for an empty one.
    n = this%n
  end function mesh_n_nodes

  !> Returns whether the mesh was created and not destroyed.
  pure function mesh_is_created(this) result(is_created)
    class(riis_mesh), intent(in) :: this                    !< May be empty.
    logical :: is_created                                   !< .false. for an empty one.
    is_created = c_associated(this%handle)
  end function mesh_is_created

  !> Returns the C handle, for calls of module riis_c. The handle belongs to this variable, so do not destroy the handle.
  function mesh_c_handle(this) result(handle)
    class(riis_mesh), intent(in) :: this                    !< May be empty.
    type(c_ptr) :: handle                                   !< c_null_ptr for an empty one.
    handle = this%handle
  end function mesh_c_handle

  !> Frees the memory of the mesh, not the coordinates, which are not borrowed any more. The mesh is then empty and can be created
  !! again. Nothing happens to an empty one.
  subroutine mesh_destroy(this)
    class(riis_mesh), intent(inout) :: this                 !< May be empty.
    call riis_mesh_destroy(this%handle)
    this%n = 0
  end subroutine mesh_destroy

  !> Stops the program unless both objects are empty.
  impure elemental subroutine mesh_assign(left, right)
    class(riis_mesh), intent(inout) :: left                 !< Must be empty.
    class(riis_mesh), intent(in) :: right                   !< Must be empty.
    call refuse_copy(left%handle, right%handle, 'riis_mesh')
  end subroutine mesh_assign
end module riis_meshes
