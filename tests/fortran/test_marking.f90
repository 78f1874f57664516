! SPDX-License-Identifier: Apache-2.0
! Tests marking by module riis: its results in every form, and with several threads.
program test_marking
  use, intrinsic :: iso_c_binding, only: c_associated, c_double
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_quiet_nan
  use box
  use checks
  use riis
  use riis_c, only: c_get_list => riis_marks_get_list, c_mark_list => riis_mark_list
  use riis_calls, only: c_dense => write_dense
  implicit none
  type(riis_mesh) :: mesh
  integer(riis_status) :: status

  call make_box()
  call mesh%create(xyz)
  call test_results()
  call test_nothing_marked()
  call test_masks()
  call test_dense()
  call test_leaks()
  call test_passages()
  call test_errors()
  call test_assignment()
  call test_threads()
  call mesh%destroy()
  call free_box()
  call finish()

contains

  subroutine test_results()
    type(riis_marks) :: result
    type(riis_mark_stats) :: stats
    integer(int32), allocatable :: node_num(:), leaflets(:)
    integer(int64), allocatable :: wide_num(:), triangles(:)
    real(c_double), allocatable :: distances(:)
    integer(int64), pointer :: node_id(:), triangle_id(:)
    real(c_double), pointer :: distance(:)
    integer(int32), pointer :: leaflet_id(:)
    integer(int64) :: n

    call riis_mark_nodes(surface, mesh, result, status=status)
    call check_ok(status, 'marking without options')
    call check(result%is_created() .and. c_associated(result%c_handle()), 'which creates the result')
    call check(result%n_marked() == size(expected), 'how many it marked')
    call check(result%n_within_limit() == size(expected), 'as many are within the limit')
    call result%marked(node_id, distance, triangle_id, leaflet_id)
    call check(all(node_id == expected) .and. all(same(distance, expected_distance)), 'its pointers')
    call check(minval(triangle_id) >= 0 .and. any(leaflet_id == RIIS_LEAFLET_NON_CORONARY), 'its triangles and leaflets')

    ! Copies the results into arrays that are not allocated, too short, too long, or of the right size.
    call result%marked_nodes(node_num, distances, triangles, leaflets)
    call check(all(node_num == expected + 1) .and. all(same(distances, distance)) .and. all(triangles == triangle_id) &
      .and. all(leaflets == leaflet_id), 'its copies, counted from 1')
    allocate (wide_num(3))
    node_num = [node_num, node_num]
    distances = distances(:5)
    triangles = [triangles, triangles]
    leaflets = leaflets(:0)
    call result%marked_nodes(node_num, distances, triangles, leaflets)
    call result%marked_nodes(wide_num)
    call check(size(node_num) == size(expected) .and. all(wide_num == expected + 1) .and. all(same(distances, distance)) &
      .and. all(triangles == triangle_id) .and. all(leaflets == leaflet_id), 'copies are as long as they have to be')
    call result%marked_nodes(node_num, distances, triangles, leaflets)
    call check(all(node_num == expected + 1) .and. all(same(distances, distance)), 'copies over copies')

    ! The distance limit is wider than the half thickness. Options that are integers may be of either kind.
    call riis_mark_nodes(surface, mesh, result, distance_limit=0.3d0, search=int(RIIS_SEARCH_EXHAUSTIVE, int64), &
      n_threads=1_int64)
    n = result%n_within_limit()
    call check(result%n_marked() == size(expected) .and. n > size(expected), 'more nodes within the limit')
    call result%within_limit(node_id, distance, triangle_id, leaflet_id)
    call result%nodes_within_limit(node_num, distances, triangles, leaflets)
    call result%nodes_within_limit(wide_num)
    call check(size(node_id) == n .and. maxval(distance) <= 0.3d0 .and. maxval(distance) > 0.12d0, 'they are in there')
    call check(all(node_num == node_id + 1) .and. all(wide_num == node_num) .and. all(same(distances, distance)) &
      .and. all(triangles == triangle_id) .and. all(leaflets == leaflet_id), 'and in the copies')
    call result%get_stats(stats)
    call check(stats%n_nodes == n_nodes .and. stats%n_marked == size(expected) .and. stats%n_within_limit == n .and. &
      stats%search == RIIS_SEARCH_EXHAUSTIVE .and. stats%n_threads == 1 .and. stats%complete == 1, 'how it went')
    call result%destroy()
    call result%destroy()
    call check(.not. result%is_created(), 'a result that was destroyed twice is empty')
  end subroutine test_results

  subroutine test_nothing_marked()
    type(riis_surface) :: far
    type(riis_marks) :: result
    integer(int32), allocatable :: node_num(:), leaflets(:)
    integer(int64), allocatable :: triangles(:)
    real(c_double), allocatable :: distances(:)
    integer(int64), pointer :: node_id(:), triangle_id(:)
    real(c_double), pointer :: distance(:)
    integer(int32), pointer :: leaflet_id(:)
    call far%create(valve, translation=[100d0, 0d0, 0d0])
    call riis_mark_nodes(far, mesh, result)
    call result%marked(node_id, distance, triangle_id, leaflet_id)
    call check(result%n_marked() == 0 .and. size(node_id) == 0 .and. size(distance) == 0 .and. size(triangle_id) == 0 &
      .and. size(leaflet_id) == 0, 'nothing is marked: pointers to nothing')
    call result%marked_nodes(node_num, distances, triangles, leaflets)
    call check(size(node_num) == 0 .and. size(distances) == 0 .and. size(triangles) == 0 .and. size(leaflets) == 0, &
      'nothing is marked: copies of nothing')
    call result%destroy()
    call far%destroy()
  end subroutine test_nothing_marked

  subroutine test_masks()
    type(riis_marks) :: result
    logical :: mask(n_nodes)
    integer(int8) :: bytes(n_nodes), wide(2 * n_nodes)
    integer(int32) :: numbers(n_nodes)
    integer :: i
    mask = [(mod(i, 3) /= 0, i = 1, n_nodes)]
    bytes = merge(1_int8, 0_int8, mask)
    numbers = merge(-7, 0, mask)
    wide = 1
    wide(::2) = bytes
    call riis_mark_nodes(surface, mesh, result, node_mask=mask)
    call check_half(result, mask, 'a logical mask')
    call riis_mark_nodes(surface, mesh, result, node_mask=bytes)
    call check_half(result, mask, 'a mask of bytes')
    call riis_mark_nodes(surface, mesh, result, 0.12d0, wide(::2), RIIS_SEARCH_AUTO, 2)
    call check_half(result, mask, 'a section as a mask')
    call riis_mark_nodes(surface, mesh, result, node_mask=numbers)
    call check_half(result, mask, 'a mask of integers')
    call riis_mark_nodes(surface, mesh, result, node_mask=mask(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of node_mask is 9260; there are 9261 nodes')
    call riis_mark_nodes(surface, mesh, result, node_mask=bytes(:0), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of node_mask is 0')
    call riis_mark_nodes(surface, mesh, result, node_mask=numbers(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of node_mask is 9260')
    call check_half(result, mask, 'a refused call leaves the result')
    call result%destroy()
  end subroutine test_masks

  subroutine check_half(result, mask, what)
    type(riis_marks), intent(in) :: result
    logical, intent(in) :: mask(:)
    character(len=*), intent(in) :: what
    integer(int64), pointer :: node_id(:)
    logical :: is_same
    call result%marked(node_id)
    is_same = size(node_id) == count(mask(expected + 1))
    if (is_same) is_same = all(node_id == pack(expected, mask(expected + 1)))
    call check(is_same, what)
  end subroutine check_half

  subroutine test_dense()
    type(riis_marks) :: result
    integer(int8) :: mark(n_nodes), c_mark(n_nodes)
    integer(int32) :: number(n_nodes), leaflet_id(n_nodes), c_leaflet_id(n_nodes)
    logical :: is_marked(n_nodes)
    real(c_double) :: distance(n_nodes), c_distance(n_nodes), wide(2, n_nodes)
    integer(int64) :: triangle_id(n_nodes), c_triangle_id(n_nodes)
    call riis_mark_nodes(surface, mesh, result, distance_limit=0.3d0)
    call check_ok(c_dense(result%c_handle(), int(n_nodes, int64), RIIS_FAR_DISTANCE, c_mark, c_distance, c_triangle_id, &
      c_leaflet_id), 'dense arrays from riis_c')
    call result%dense(mark, distance, triangle_id, leaflet_id)
    call check(all(mark == c_mark) .and. all(same(distance, c_distance)) .and. all(triangle_id == c_triangle_id) .and. &
      all(leaflet_id == c_leaflet_id), 'dense arrays')
    call result%dense(number, distance, far_distance=-1d0)
    call check(all(number == c_mark) .and. all(same(distance, merge(c_distance, -1d0, c_distance < 1))), 'integer marks')
    call result%dense(is_marked, leaflet_id=leaflet_id)
    call check(all(is_marked .eqv. c_mark == 1), 'logical marks')
    wide = 3
    call result%dense(distance=wide(2, :), far_distance=ieee_value(0d0, ieee_quiet_nan))
    call check(all(ieee_is_nan(wide(2, :)) .eqv. c_distance >= 1) .and. all(same(wide(1, :), 3d0)), 'into a section')

    mark = 5
    number = 5
    call result%dense(mark, distance(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of distance is 9260; there are 9261')
    call result%dense(mark, triangle_id=triangle_id(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of triangle_id is 9260')
    call result%dense(mark(2:), leaflet_id=leaflet_id(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_nodes is 9260')
    call result%dense(mark(:0), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_nodes is 0')
    call result%dense(number, far_distance=0.1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'far_distance is 0.1')
    call result%dense(is_marked(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_nodes is 9260')
    call result%dense(status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'none of mark, distance, triangle_id and leaflet_id is given')
    call check(all(mark == 5) .and. all(number == 5), 'refused calls write nothing')
    call result%destroy()
  end subroutine test_dense

  ! The box leaks along its edges through a thin valve. The leaks equal those of riis_c.
  subroutine test_leaks()
    type(riis_surface) :: thin
    type(riis_mesh) :: joined
    type(riis_adjacency) :: adjacency
    type(riis_marks) :: result
    type(riis_leaks) :: leaks, masked
    type(riis_leak_list) :: list
    logical :: mask(n_nodes)
    integer :: i, worst
    call thin%create(valve, half_thickness=0.02d0)
    call joined%create(xyz)
    call riis_mark_nodes(thin, joined, result)
    call riis_find_leaks(thin, joined, result, leaks, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'mesh has no adjacency')
    call adjacency%create_from_grid(per_side, per_side, per_side)
    call joined%set_adjacency(adjacency)
    call riis_find_leaks(surface, joined, result, leaks, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'half thickness')
    call riis_find_leaks(thin, joined, result, leaks, n_threads=-1, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_threads is -1')
    call check(.not. leaks%is_created() .and. .not. c_associated(leaks%c_handle()), 'refused calls make nothing')
    call leaks%get_list(list, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object leaks was not created')
    call check(size(list%node_id) == 0 .and. size(list%length) == 0 .and. size(list%distance) == 0, 'nothing was found yet')

    call riis_find_leaks(thin, joined, result, leaks, n_threads=2_int64)
    call leaks%get_list(list)
    call check(list%n_edges > 10 .and. size(list%node_id, 2) == list%n_edges .and. size(list%node_id, 1) == 2, 'edges that leak')
    call check(all(list%node_id(1, :) < list%node_id(2, :)) .and. all(list%distance > 0.02d0) .and. all(list%length > 0.04d0), &
      'both ends')
    do i = 1, size(list%length)
      if (abs(norm2(xyz(:, list%node_id(1, i) + 1) - xyz(:, list%node_id(2, i) + 1)) - list%length(i)) > 1d-12) exit
    end do
    call check(i > size(list%length), 'their lengths')
    worst = maxloc(list%length, 1)
    call check(all(list%longest_node_id == list%node_id(:, worst)) .and. &
      all(same([list%longest_length], [list%length(worst)])) .and. &
      all(same([list%half_thickness], [maxval(list%distance)])) .and. list%seconds > 0, 'the longest, and what closes all')
    call check(norm2(list%longest_middle - 0.5d0 * (xyz(:, list%node_id(1, worst) + 1) + &
      xyz(:, list%node_id(2, worst) + 1))) < 1d-14, 'its middle')

    mask = .true.
    mask(list%node_id(1, :) + 1) = .false.
    call riis_find_leaks(thin, joined, result, masked, mask)
    call check(n_of(masked) == 0, 'masked out')
    call riis_find_leaks(thin, joined, result, masked, merge(1_int8, 0_int8, mask), 1)
    call check(n_of(masked) == 0, 'masked out by bytes')
    call riis_find_leaks(thin, joined, result, masked, merge(5, 0, mask))
    call check(n_of(masked) == 0, 'masked out by integers')
    call riis_find_leaks(thin, joined, result, masked, mask(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of node_mask is 9260')
    call result%destroy()
    call riis_find_leaks(thin, joined, result, masked, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call check(n_of(leaks) == size(list%length), 'leaks do not need the marks')
    call leaks%destroy()
    call masked%destroy()
    call joined%destroy()
    call adjacency%destroy()
    call thin%destroy()
  end subroutine test_leaks

  function n_of(leaks) result(n)
    type(riis_leaks), intent(in) :: leaks
    integer(int64) :: n
    type(riis_leak_list) :: list
    call leaks%get_list(list)
    n = list%n_edges
  end function n_of

  ! Tests passages in the box, with masks, and with numbers of every kind. A node without neighbours is a separate region.
  subroutine test_passages()
    type(riis_surface) :: thin
    type(riis_mesh) :: joined
    type(riis_adjacency) :: adjacency
    type(riis_marks) :: result
    type(riis_passage) :: passage, again
    integer(int64) :: region_num(n_nodes), again_num(n_nodes), n_regions
    integer, pointer :: no_nodes(:)
    logical :: mask(n_nodes)
    integer :: i
    call thin%create(valve, half_thickness=0.02d0)
    call joined%create(xyz)
    call riis_mark_nodes(thin, joined, result)
    region_num = -7
    call riis_label_open_regions(joined, result, region_num, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'mesh has no adjacency')
    call riis_find_passage(thin, joined, [1], [n_nodes], passage, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'mesh has no adjacency')
    call adjacency%create_from_grid(per_side, per_side, per_side)
    call joined%set_adjacency(adjacency)
    call riis_label_open_regions(joined, result, region_num(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of region_num is 9260')
    call check(all(region_num == -7), 'refused calls write nothing')

    call riis_label_open_regions(joined, result, region_num, n_regions, n_threads=2)
    call check(n_regions == count(region_num == [(i, i=1, n_nodes)]), 'as many regions as lowest nodes')
    call check(count(region_num == 0) == result%n_marked() .and. minval(region_num) == 0, 'marked nodes are in no region')
    call check(region_num(1) == 1, 'the first node')
    mask = .true.
    mask([2, 1 + per_side, 1 + per_side**2]) = .false. ! the neighbours of the first node
    call riis_label_open_regions(joined, result, region_num, node_mask=mask)
    call check(count(region_num == 1) == 1 .and. region_num(2) == 0, 'a lone node')
    call riis_label_open_regions(joined, result, again_num, n_regions, merge(1_int8, 0_int8, mask))
    call check(all(again_num == region_num), 'masked out by bytes')
    call riis_label_open_regions(joined, result, again_num, n_regions, merge(5, 0, mask), 1_int64)
    call check(all(again_num == region_num), 'masked out by integers')

    call riis_find_passage(thin, joined, [1], [n_nodes, n_nodes - 1], passage)
    call check(passage%state == RIIS_PASSAGE_OPEN .and. passage%distance > 0.02d0, 'an open passage')
    call check(all(same(passage%point, xyz(:, passage%node_id + 1))), 'its place')
    call riis_find_passage(thin, joined, [1_int64], int([n_nodes, n_nodes - 1], int64), again, n_threads=2)
    call check(again%node_id == passage%node_id .and. all(same([again%distance], [passage%distance])), 'by int64')
    call riis_find_passage(thin, joined, [1], [n_nodes], again, mask)
    call check(again%state == RIIS_PASSAGE_NONE .and. again%node_id == -1, 'no passage round the mask')
    call riis_find_passage(thin, joined, [1_int64], [int(n_nodes, int64)], again, mask)
    call check(again%state == RIIS_PASSAGE_NONE, 'by int64')
    again%state = -7
    call riis_find_passage(thin, joined, [1], [n_nodes], again, merge(1_int8, 0_int8, mask))
    call check(again%state == RIIS_PASSAGE_NONE, 'masked out by bytes')
    again%state = -7
    call riis_find_passage(thin, joined, [1_int64], [int(n_nodes, int64)], again, merge(1_int8, 0_int8, mask))
    call check(again%state == RIIS_PASSAGE_NONE, 'by int64')
    again%state = -7
    call riis_find_passage(thin, joined, [1], [n_nodes], again, merge(5, 0, mask))
    call check(again%state == RIIS_PASSAGE_NONE, 'masked out by integers')
    again%state = -7
    call riis_find_passage(thin, joined, [1_int64], [int(n_nodes, int64)], again, merge(5, 0, mask))
    call check(again%state == RIIS_PASSAGE_NONE, 'by int64')

    allocate (no_nodes(0))
    call riis_find_passage(thin, joined, no_nodes, [1], again, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_from is 0')
    call riis_find_passage(thin, joined, [1], [n_nodes + 1], again, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'to[0] is 9261')
    call riis_find_passage(thin, joined, [0], [1], again, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'from[0] is -1')
    deallocate (no_nodes)
    call result%destroy()
    call riis_label_open_regions(joined, result, region_num, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call joined%destroy()
    call adjacency%destroy()
    call thin%destroy()
  end subroutine test_passages

  ! Options out of range and handles that were not created are refused.
  subroutine test_errors()
    type(riis_surface) :: no_surface
    type(riis_mesh) :: no_mesh
    type(riis_marks) :: result
    type(riis_mark_stats) :: stats
    integer(int8) :: mark(1)
    integer(int32), allocatable :: node_num(:)
    integer(int64), allocatable :: wide_num(:)
    integer(int64), pointer :: node_id(:)
    integer(int64) :: n
    call riis_mark_nodes(no_surface, mesh, result, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'surface was not created, or was destroyed')
    call riis_mark_nodes(surface, no_mesh, result, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'mesh was not created, or was destroyed')
    call riis_mark_nodes(surface, mesh, result, search=17, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'search is 17')
    call riis_mark_nodes(surface, mesh, result, search='auto', status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'search is neither')
    call riis_mark_nodes(surface, mesh, result, n_threads=5000, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_threads is 5000')
    call riis_mark_nodes(surface, mesh, result, distance_limit=0.01d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'distance_limit is 0.01')
    call result%destroy()

    n = result%n_marked(status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created, or was destroyed')
    n = n + result%n_within_limit(status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call check(n == 0, 'no nodes')
    call result%marked(node_id, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call check(size(node_id) == 0, 'no nodes to point to')
    call result%within_limit(node_id, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    node_num = [7]
    wide_num = [7]
    call result%marked_nodes(node_num, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call result%marked_nodes(wide_num, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call result%nodes_within_limit(node_num, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call result%nodes_within_limit(wide_num, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call check(all(node_num == [7]) .and. all(wide_num == [7_int64]), 'the copies before are left alone')
    call result%dense(mark, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call result%get_stats(stats, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
  end subroutine test_errors

  subroutine test_assignment()
    type(riis_mesh) :: a, b
    type(riis_adjacency) :: c, d
    type(riis_marks) :: e, f
    a = b
    c = d
    e = f
    call check(.not. (a%is_created() .or. c%is_created() .or. e%is_created()), 'an empty copy is empty')
  end subroutine test_assignment

  ! All threads read one surface and one mesh. Each thread has a separate result and a separate error message.
  subroutine test_threads()
    integer, parameter :: n_parts = 8
    logical :: is_right(n_parts)
    integer :: part
    is_right = .false.
    !$omp parallel do num_threads(4) schedule(static, 1)
    do part = 1, n_parts
      call work(part, is_right(part))
    end do
    !$omp end parallel do
    call check(all(is_right), 'threads do not disturb each other')
  end subroutine test_threads

  ! The procedure is recursive, so that its variables are local to a thread under any -fcheck or -fno-automatic.
  recursive subroutine work(part, is_right)
    integer, intent(in) :: part
    logical, intent(out) :: is_right
    type(riis_marks) :: result
    integer, allocatable :: node_num(:)
    character(len=80) :: text
    integer(riis_status) :: own_status
    integer :: step, none(0)
    is_right = .true.
    do step = 1, 5
      call riis_mark_nodes(surface, mesh, result, n_threads=1)
      call result%marked_nodes(node_num)
      is_right = is_right .and. size(node_num) == size(expected)
      if (is_right) is_right = all(node_num == expected + 1)
      call riis_mark_nodes(surface, mesh, result, search=100 + part, status=own_status)
      text = 'search is 10' // achar(iachar('0') + part) // ';' ! a WRITE statement would mix the messages of several threads
      is_right = index(riis_error_message(), trim(text)) > 0 .and. is_right
      call surface%closest_points(xyz(:, :part), side=none, status=own_status) ! module riis itself refuses this call
      text = 'there are ' // achar(iachar('0') + part) // ' points'
      is_right = index(riis_error_message(), trim(text)) > 0 .and. is_right
    end do
    call result%destroy()
  end subroutine work
end program test_marking
