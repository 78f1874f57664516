! SPDX-License-Identifier: Apache-2.0
! Tests module riis: meshes without copies, and adjacencies of all kinds.
program test_meshes
  use, intrinsic :: iso_c_binding, only: c_associated, c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use box
  use checks
  use riis
  implicit none

  type :: node_data ! as in codes that store all data of a node together
    real(c_double) :: pressure
    real(c_double) :: at(3)
    integer :: flag
  end type node_data

  integer(riis_status) :: status

  call make_box()
  call test_sections()
  call test_in_place()
  call test_mesh_errors()
  call test_copies()
  call test_grids()
  call test_rows()
  call test_row_errors()
  call test_adjacencies()
  call test_adjacency_errors()
  call free_box()
  call finish()

contains

  subroutine test_sections()
    type(riis_mesh) :: mesh
    real(c_double), allocatable :: wide(:, :), rows(:, :), x(:), y(:), z(:)
    type(node_data), allocatable :: nodes(:)
    integer :: k

    call mesh%create(xyz)
    call check(mesh%n_nodes() == n_nodes .and. mesh%is_created() .and. c_associated(mesh%c_handle()), 'a mesh')
    call check_marking(mesh, 'xyz(3, n)')
    call mesh%create(xyz, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the mesh was already created')
    call mesh%destroy()
    call mesh%destroy()
    call check(mesh%n_nodes() == 0 .and. .not. mesh%is_created(), 'a mesh that was destroyed twice is empty')

    x = xyz(1, :)
    y = xyz(2, :)
    z = xyz(3, :)
    call mesh%create(x, y, z)
    call check_marking(mesh, 'x, y, z')
    call mesh%destroy()

    ! The coordinates are every second column. The rows of the coordinates have another order, and other rows lie between them.
    allocate (wide(6, 2 * n_nodes))
    wide = ieee_value(0d0, ieee_quiet_nan)
    wide(6:2:-2, 2::2) = xyz
    call mesh%create(wide(6:2:-2, 2::2))
    call check_marking(mesh, 'a section')
    call mesh%update(xyz)
    call check_marking(mesh, 'an update from a section to a whole array')
    call mesh%update(wide(6, 2::2), wide(4, 2::2), wide(2, 2::2))
    call check_marking(mesh, 'an update to three sections')
    call mesh%destroy()

    allocate (rows(n_nodes, 3))
    rows = transpose(xyz)
    call mesh%create(rows(:, 1), rows(:, 2), rows(:, 3))
    call check_marking(mesh, 'xyz(n, 3)')
    call mesh%destroy()

    allocate (nodes(n_nodes))
    do k = 1, n_nodes
      nodes(k)%at = xyz(:, k)
    end do
    k = storage_size(nodes) / storage_size(nodes(1)%at)
    call mesh%create(n_nodes, nodes(1)%at(1), nodes(1)%at(2), nodes(1)%at(3), k)
    call check_marking(mesh, 'components')
    call mesh%update(int(n_nodes, int64), xyz(1, 1), xyz(2, 1), xyz(3, 1), 3_int64)
    nodes%at(1) = 99
    call check_marking(mesh, 'an update from components')
    call mesh%update(n_nodes, nodes(1)%at(2), nodes(1)%at(2), nodes(1)%at(3), 0, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'stride is 0')
    call mesh%update(n_nodes, xyz(1, 1), xyz(2, 1), xyz(3, 1), 3)
    call mesh%destroy()
    call mesh%create(int(n_nodes, int64), x(1), y(1), z(1), 1_int64)
    call check_marking(mesh, 'first elements')
    call mesh%destroy()

    call mesh%create(xyz(:, 5:5), status)
    call check_ok(status, 'one node')
    call mesh%destroy()
    call mesh%create(wide(2::2, n_nodes:n_nodes), status)
    call check_refused(status, RIIS_INVALID_MESH, 'node 0')
  end subroutine test_sections

  ! Nothing is copied: if the caller's coordinates change in place, the mesh changes.
  subroutine test_in_place()
    type(riis_mesh) :: mesh
    type(riis_marks) :: result
    type(riis_closest) :: closest
    integer, allocatable :: node_num(:)
    real(c_double), allocatable :: distance(:)
    integer :: node
    call mesh%create(xyz)
    node = 1 ! a corner, far from the valve
    call check(.not. any(expected + 1 == node), 'the corner is not marked')
    xyz(:, node) = [0d0, -1.2d0, 0.2d0]
    call surface%closest_point(xyz(:, node), closest)
    xyz(:, node) = closest%point + 0.01d0 * closest%normal
    call mesh%update(xyz)
    call riis_mark_nodes(surface, mesh, result)
    call result%marked_nodes(node_num, distance)
    call check(size(node_num) == size(expected) + 1 .and. node_num(1) == node .and. abs(distance(1) - 0.01d0) < 1d-9, &
      'a node that moved in place is marked')
    xyz(:, node) = -1.4d0
    ! The mesh borrows the coordinates' memory, so it has the new coordinates without an update.
    call riis_mark_nodes(surface, mesh, result, search=RIIS_SEARCH_EXHAUSTIVE)
    call check(result%n_marked() == size(expected), 'a node that moved back is not')
    call result%destroy()
    call mesh%destroy()
  end subroutine test_in_place

  subroutine test_mesh_errors()
    type(riis_mesh) :: mesh
    real(c_double) :: bad(3, 4)
    real(c_double) :: x(8), y(4), z(4)
    bad = 0
    x = 0
    y = 0
    z = 0
    call mesh%create(bad(:2, :), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of xyz is (2, 4); it must be (3, n)')
    call mesh%create(transpose(bad), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, &
      'the shape of xyz is (4, 3); it must be (3, n); a mesh takes (n, 3) by create_copy(transpose(xyz))')
    call mesh%create(bad(:, 4:1:-1), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'xyz is a section with a stride of -24 bytes')
    call mesh%create(x(:4), y, z(4:1:-1), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'z is a section with a stride of -8 bytes')
    call mesh%create(x(::2), y, z, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the strides of x, y and z are 2, 1 and 1')
    call mesh%create(x, y, z, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the sizes of x, y and z are 8, 4 and 4')
    bad(2, 3) = ieee_value(0d0, ieee_quiet_nan)
    call mesh%create(bad, status)
    call check_refused(status, RIIS_INVALID_MESH, 'node 2')
    call check(.not. mesh%is_created(), 'a refused mesh is empty')
    call mesh%update(bad, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the mesh was not created, or was destroyed')
    call mesh%update(y, y, z, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the mesh was not created, or was destroyed')
  end subroutine test_mesh_errors

  ! Tests meshes that copy temporaries of both precisions. The caller's arrays may be freed afterwards.
  subroutine test_copies()
    type(riis_mesh) :: mesh
    type(riis_marks) :: marks
    type(riis_mark_list) :: list
    real(real32), allocatable :: single(:, :)
    integer(int64), allocatable :: node_id(:)
    integer :: n_single
    allocate (single, source=real(xyz, real32))
    call mesh%create_copy(xyz + 0d0)
    call check_marking(mesh, 'a copy in double precision', RIIS_SEARCH_AUTO)
    call mesh%update_copy(xyz(1, :), xyz(2, :), xyz(3, :))
    call check_marking(mesh, 'a copy of three arrays', RIIS_SEARCH_AUTO)
    call mesh%update_copy(2 * single - single)
    call riis_mark_nodes(surface, mesh, marks)
    call marks%get_list(RIIS_LIST_MARKED, list)
    allocate (node_id, source=list%node_id)
    n_single = size(node_id)
    call mesh%update(real(single, real64))
    call mesh%update_copy(real(single, real64))
    call riis_mark_nodes(surface, mesh, marks)
    call marks%get_list(RIIS_LIST_MARKED, list)
    call check(n_single > 100 .and. all(list%node_id == node_id), 'single precision becomes double exactly')
    call mesh%destroy()
    call mesh%create_copy(single(1, :), single(2, :), single(3, :))
    call mesh%update_copy(single(1, :), single(2, :), single(3, :))
    call riis_mark_nodes(surface, mesh, marks, R=5d0)
    call marks%get_list(RIIS_LIST_MARKED, list)
    call check(all(list%node_id == node_id) .and. size(list%K) == n_single .and. maxval(list%K) > 0 .and. &
      size(list%K_u_surface) == 0, 'three arrays of single precision, with K')
    call riis_mark_nodes(surface, mesh, marks, rim=RIIS_RIM_CUT, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'half_thickness or rim is given, but R is not')
    call mesh%destroy()
    call mesh%create_copy(xyz(1:2, :), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the first extent of xyz is 2; it must be 3')
    call mesh%create_copy(single(1, :), single(2, 2:), single(3, :), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of y is')
    single(2, 7) = ieee_value(0.0, ieee_quiet_nan)
    call mesh%create_copy(single, status)
    call check_refused(status, RIIS_INVALID_MESH, 'y of node 6 is nan')
    call check(.not. mesh%is_created(), 'a refused copy is empty')
    call mesh%create_copy(xyz(1, :), xyz(2, :), xyz(3, :))
    call mesh%destroy()
    call mesh%create_copy(reshape([real(real64) ::], [3, 0]))
    call check(mesh%n_nodes() == 0, 'a copy without nodes')
    call mesh%destroy()
    call marks%destroy()
  end subroutine test_copies

  ! Tests meshes from axes. The marks of a mesh that copies are those of the box, also with a halo, in another order and in single
  ! precision.
  subroutine test_grids()
    type(riis_mesh) :: mesh
    type(riis_marks) :: marks
    integer(int64), pointer :: node_id(:)
    real(c_double), pointer :: distance(:)
    real(c_double) :: axis(per_side)
    integer :: i, number(n_nodes), at(3)
    integer, parameter :: n = per_side, with_halo = (n + 4)**3
    axis = -1.4d0 + 0.14d0 * [(i, i=0, n - 1)]
    call mesh%create_grid(axis, axis + 0d0, axis)
    call check(mesh%n_nodes() == n_nodes, 'the number of nodes of a grid')
    call check_marking(mesh, 'a grid')
    call mesh%update_grid(real(axis, real32), real(axis, real32), real(axis, real32))
    call mesh%update(xyz)
    call check_marking(mesh, 'a grid that became points')

    ! A halo of two layers, as in K(-1:n+2, -1:n+2, -1:n+2).
    call mesh%update_grid(axis, axis, axis, halo=2)
    call check(mesh%n_nodes() == with_halo, 'the number of nodes with a halo')
    do i = 0, n_nodes - 1
      at = [mod(i, n), mod(i / n, n), i / n**2] + 2
      number(i + 1) = at(1) + (n + 4) * (at(2) + (n + 4) * at(3))
    end do
    call riis_mark_nodes(surface, mesh, marks)
    call marks%marked(node_id, distance)
    call check(size(node_id) == size(expected), 'as many marks with a halo')
    call check(all(node_id == number(expected + 1)) .and. all(same(distance, expected_distance)), 'marks with a halo')
    call mesh%destroy()
    call mesh%create_grid(axis, axis, axis, first=1 + 2 * (1 + (n + 4) + (n + 4)**2), &
      stride=[1_int64, int(n + 4, int64), int(n + 4, int64)**2], n_nodes=with_halo)
    call riis_mark_nodes(surface, mesh, marks)
    call marks%marked(node_id, distance)
    call check(all(node_id == number(expected + 1)), 'strides instead of a halo')
    call mesh%destroy()
    call mesh%create_grid(real(axis, real32), real(axis, real32), real(axis, real32), stride=[1, n, n**2])
    call check(mesh%n_nodes() == n_nodes, 'axes of single precision')
    call mesh%update_grid(axis, axis, axis)
    call check_marking(mesh, 'another update')

    call mesh%update_grid(axis, axis(n:1:-1), axis, status=status)
    call check_refused(status, RIIS_INVALID_MESH, 'grid.y[1] is')
    call mesh%update_grid(axis, axis, axis, halo=1, first=2, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'halo stands for first, stride and n_nodes')
    call mesh%update_grid(axis, axis, axis, halo=-1, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'halo is -1')
    call mesh%update_grid(axis, axis, axis, halo=2**20, status=status)
    call check_refused(status, RIIS_LIMIT_EXCEEDED, 'grid.n_nodes is')
    call mesh%update_grid(axis, axis, axis, first=0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'first is 0; it must be at least 1')
    call mesh%update_grid(axis, axis, axis, stride=[1, 2], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of stride is 2')
    call mesh%update_grid(axis(:0), axis, axis, status=status)
    call check_refused(status, RIIS_INVALID_MESH, 'grid.ni is 0')
    call mesh%create_grid(axis, axis, axis, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the mesh was already created')
    call check_marking(mesh, 'a grid after refused updates')
    call mesh%destroy()
    call marks%destroy()
  end subroutine test_grids

  subroutine test_rows()
    type(riis_mesh) :: mesh
    integer(int64), allocatable :: offsets(:), columns(:), offsets_0(:), columns_0(:)
    integer(int32), allocatable :: small_offsets(:), small_columns(:)
    call get_rows(offsets, columns)
    small_offsets = int(offsets, int32)
    small_columns = int(columns, int32)
    call mesh%create(xyz)
    call mesh%set_adjacency(offsets, columns, status=status)
    call check_ok(status, 'rows of 64 and 64 bits')
    call check_marking(mesh, 'rows of 64 and 64 bits', RIIS_SEARCH_NEIGHBOR)
    call mesh%set_adjacency(offsets, small_columns, status=status)
    call check_ok(status, 'rows of 64 and 32 bits')
    call check_marking(mesh, 'rows of 64 and 32 bits', RIIS_SEARCH_NEIGHBOR)
    call mesh%set_adjacency(small_offsets, columns, status=status)
    call check_ok(status, 'rows of 32 and 64 bits')
    call check_marking(mesh, 'rows of 32 and 64 bits', RIIS_SEARCH_NEIGHBOR)
    call mesh%set_adjacency(small_offsets, small_columns, status=status)
    call check_ok(status, 'rows of 32 and 32 bits')
    call check_marking(mesh, 'rows of 32 and 32 bits', RIIS_SEARCH_NEIGHBOR)
    ! The rows may also count from 0 and name ghost nodes.
    offsets_0 = offsets - 1
    columns_0 = columns - 1
    columns_0(1) = n_nodes + 4
    call mesh%set_adjacency(offsets_0, columns_0, index_base=0, n_all=n_nodes + 5, status=status)
    call check_ok(status, 'rows from 0 with ghosts')
    call check_marking(mesh, 'rows from 0 with ghosts', RIIS_SEARCH_NEIGHBOR)
    call mesh%set_adjacency(offsets_0, columns_0, index_base=0_int64, n_all=int(n_nodes, int64), status=status)
    call check_refused(status, RIIS_INVALID_MESH, 'row 0')
    call mesh%clear_adjacency()
    call check_no_adjacency(mesh)
    call mesh%destroy()
  end subroutine test_rows

  subroutine check_no_adjacency(mesh)
    type(riis_mesh), intent(in) :: mesh
    type(riis_marks) :: result
    call riis_mark_nodes(surface, mesh, result, search=RIIS_SEARCH_NEIGHBOR, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'adjacency')
    call result%destroy()
  end subroutine check_no_adjacency

  subroutine test_row_errors()
    type(riis_mesh) :: mesh
    integer(int64), allocatable :: offsets(:), columns(:), wide(:)
    integer :: n
    call get_rows(offsets, columns)
    call mesh%set_adjacency(offsets, columns, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the mesh was not created')
    call mesh%clear_adjacency(status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the mesh was not created')
    call mesh%prepare(status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the mesh was not created')
    call mesh%create(xyz)
    call mesh%prepare(-2, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_threads is -2')
    call mesh%prepare(2_int64)
    call check_marking(mesh, 'clusters', RIIS_SEARCH_CLUSTERS)
    n = n_nodes
    call mesh%set_adjacency(offsets(:n), columns, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of offsets is 9261; it must be one more than the 9261 nodes')
    call mesh%set_adjacency(offsets(:0), columns, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of offsets is 0')
    call mesh%set_adjacency(offsets, columns(:7), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'columns has 7 entries')
    call mesh%set_adjacency(offsets, columns(:0), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'columns has 0 entries')
    call mesh%set_adjacency(offsets, columns, index_base=2, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'index_base is 2')
    call mesh%set_adjacency(offsets, columns, n_all=1.5d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_all is neither')
    allocate (wide(2 * size(columns)))
    wide = 1
    wide(::2) = columns
    call mesh%set_adjacency(offsets, wide(::2), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'columns is a section that is not contiguous')
    wide(1:2 * n + 1:2) = offsets
    call mesh%set_adjacency(wide(1:2 * n + 1:2), columns, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'offsets is a section that is not contiguous')
    call mesh%set_adjacency(offsets, columns(size(columns):1:-1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'columns is a section that is not contiguous')
    call check_no_adjacency(mesh)
    call mesh%destroy()
  end subroutine test_row_errors

  ! Tests adjacencies of all kinds: from six tetrahedra in each cube of the box, from hexahedra, from faces and from the grid.
  subroutine test_adjacencies()
    integer, parameter :: corners(3, 8) = reshape([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1], &
      [3, 8])
    integer, parameter :: n_cubes = (per_side - 1)**3
    type(riis_mesh) :: mesh
    type(riis_adjacency) :: adjacency
    integer(int32), allocatable :: cubes(:, :), node_ids(:), offsets(:), faces(:, :)
    integer(int64), allocatable :: columns(:), rows(:)
    integer :: cube, at(3), corner, k, row
    allocate (cubes(8, n_cubes))
    do cube = 0, n_cubes - 1
      at = [mod(cube, per_side - 1), mod(cube / (per_side - 1), per_side - 1), cube / (per_side - 1)**2]
      do corner = 1, 8
        cubes(corner, cube + 1) = dot_product(at + corners(:, corner), [1, per_side, per_side**2]) + 1
      end do
    end do
    allocate (node_ids(8 * n_cubes)) ! allocated first, because gfortran 14 otherwise warns that it is undefined
    node_ids(:) = reshape(cubes, [8 * n_cubes])
    offsets = [(8 * k + 1, k = 0, n_cubes)]
    call get_rows(rows, columns)
    allocate (faces(2, (size(columns) + 1) / 2))
    k = 0
    do row = 1, n_nodes
      do corner = int(rows(row)), int(rows(row + 1)) - 1
        if (columns(corner) <= row) cycle
        k = k + 1
        faces(:, k) = [row, int(columns(corner))]
      end do
    end do
    faces = faces(:, :k)
    call mesh%create(xyz)

    call adjacency%create_from_cells(n_nodes, cubes)
    call check(adjacency%is_created() .and. c_associated(adjacency%c_handle()), 'an adjacency')
    call use_adjacency(mesh, adjacency, 'cells')
    call adjacency%create_from_cells(int(n_nodes, int64), cubes - 1, index_base=0, n_threads=2_int64)
    call use_adjacency(mesh, adjacency, 'cells, n_nodes of 64 bits')
    call adjacency%create_from_cells(n_nodes, int(cubes, int64))
    call use_adjacency(mesh, adjacency, 'cells of 64 bits')
    call adjacency%create_from_cells(int(n_nodes, int64), int(cubes, int64))
    call use_adjacency(mesh, adjacency, 'cells and n_nodes of 64 bits')
    call adjacency%create_from_cells(n_nodes, node_ids, offsets)
    call use_adjacency(mesh, adjacency, 'mixed cells')
    call adjacency%create_from_cells(int(n_nodes, int64), node_ids, offsets)
    call use_adjacency(mesh, adjacency, 'mixed cells, n_nodes of 64 bits')
    call adjacency%create_from_cells(n_nodes, int(node_ids, int64), int(offsets - 1, int64))
    call use_adjacency(mesh, adjacency, 'mixed cells of 64 bits')
    call adjacency%create_from_cells(int(n_nodes, int64), int(node_ids - 1, int64), int(offsets - 1, int64), 0_int64, 1)
    call use_adjacency(mesh, adjacency, 'mixed cells and n_nodes of 64 bits')
    call adjacency%create_from_faces(n_nodes, faces)
    call use_adjacency(mesh, adjacency, 'faces')
    call adjacency%create_from_faces(int(n_nodes, int64), faces)
    call use_adjacency(mesh, adjacency, 'faces, n_cells of 64 bits')
    call adjacency%create_from_faces(n_nodes, int(faces, int64), n_threads=1)
    call use_adjacency(mesh, adjacency, 'faces of 64 bits')
    call adjacency%create_from_faces(int(n_nodes, int64), int(faces, int64))
    call use_adjacency(mesh, adjacency, 'faces and n_cells of 64 bits')
    call adjacency%create_from_faces(n_nodes, faces(1, :), faces(2, :))
    call use_adjacency(mesh, adjacency, 'owners and neighbours')
    call adjacency%create_from_faces(int(n_nodes, int64), faces(1, :) - 1, faces(2, :) - 1, index_base=0)
    call use_adjacency(mesh, adjacency, 'owners and neighbours, n_cells of 64 bits')
    call adjacency%create_from_faces(n_nodes, int(faces(1, :), int64), int(faces(2, :), int64))
    call use_adjacency(mesh, adjacency, 'owners and neighbours of 64 bits')
    call adjacency%create_from_faces(int(n_nodes, int64), int(faces(1, :), int64), int(faces(2, :), int64))
    call use_adjacency(mesh, adjacency, 'owners, neighbours and n_cells of 64 bits')
    call adjacency%create_from_grid(per_side, per_side, per_side)
    call use_adjacency(mesh, adjacency, 'a grid')
    call adjacency%create_from_grid(int(per_side, int64), int(per_side, int64), int(per_side, int64), n_threads=1)
    call mesh%set_adjacency(adjacency)
    call adjacency%create_from_grid(1, 1, 1, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the adjacency was already created')
    call mesh%destroy()
    call adjacency%destroy()
    call adjacency%destroy()
    call check(.not. adjacency%is_created(), 'an adjacency that was destroyed twice is empty')
  end subroutine test_adjacencies

  ! Marks with the adjacency, then removes it from the mesh.
  subroutine use_adjacency(mesh, adjacency, what)
    type(riis_mesh), intent(inout) :: mesh
    type(riis_adjacency), intent(inout) :: adjacency
    character(len=*), intent(in) :: what
    type(riis_marks) :: result
    type(riis_mark_stats) :: stats
    call mesh%set_adjacency(adjacency)
    call check_marking(mesh, what, RIIS_SEARCH_NEIGHBOR)
    ! The walk along neighbours reached all nodes. The search's final check finds any other nodes.
    call riis_mark_nodes(surface, mesh, result, search=RIIS_SEARCH_NEIGHBOR)
    call result%get_stats(stats)
    call check(stats%search == RIIS_SEARCH_NEIGHBOR .and. stats%complete == 1 .and. &
      10 * stats%n_unreached < stats%n_marked, what // ': the neighbours are used')
    call result%destroy()
    call mesh%clear_adjacency()
    call adjacency%destroy()
  end subroutine use_adjacency

  subroutine test_adjacency_errors()
    type(riis_adjacency) :: adjacency
    type(riis_mesh) :: mesh
    integer(int32) :: tetrahedron(4, 1), wide(8, 1)
    tetrahedron(:, 1) = [1, 2, 3, 4]
    wide = -1
    wide(::2, :) = tetrahedron
    call adjacency%create_from_cells(4, wide(::2, :), status=status)
    call check_ok(status, 'cells that do not lie side by side')
    call mesh%create(xyz)
    call mesh%set_adjacency(adjacency, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_rows is 4')
    call adjacency%destroy()
    call mesh%set_adjacency(adjacency, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'adjacency was not created, or was destroyed')
    call mesh%destroy()
    call mesh%set_adjacency(adjacency, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the mesh was not created')
    call adjacency%create_from_cells(3, tetrahedron, status=status)
    call check_refused(status, RIIS_INVALID_MESH, 'cell 0')
    call adjacency%create_from_cells(4, tetrahedron(:3, :), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'nodes_per_cell is 3')
    call adjacency%create_from_cells(4, tetrahedron(:, :0), status=status)
    call check_ok(status, 'no cells')
    call adjacency%destroy()
    call adjacency%create_from_cells(4, [1, 2, 3, 4], [1, 6], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'offsets asks for 5 nodes of cells; node_ids has 4 entries')
    call adjacency%create_from_cells(4, [1, 2, 3, 4], [1], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of offsets is 1')
    call adjacency%create_from_faces(4, tetrahedron(:3, :), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'face_cells is 3; it must be 2')
    call adjacency%create_from_faces(4, [1, 2, 3], [2, 3], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of neighbor is 2; there are 3 owners')
    call adjacency%create_from_faces(4, tetrahedron(:2, :0), status=status)
    call check_ok(status, 'no faces')
    call adjacency%destroy()
    call adjacency%create_from_grid(0, 1, 1, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'ni is 0')
    call adjacency%create_from_grid(2_int64**62, 2_int64**62, 2_int64**62, status=status)
    call check(status > 0, 'a grid that is too large is refused: ' // riis_error_message())
    call adjacency%create_from_grid(2, 2, 2, n_threads='two', status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_threads is neither')
    call check(.not. adjacency%is_created(), 'a refused adjacency is empty')
  end subroutine test_adjacency_errors
end program test_meshes
