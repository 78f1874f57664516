! SPDX-License-Identifier: Apache-2.0
! Tests module riis: leaflets, orifice, leak, first passage, cells across and swept volume. All results are compared with closed
! forms and other calls.
program test_measures
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use checks
  use riis
  implicit none
  real(c_double), parameter :: pi = acos(-1d0)
  integer(riis_status) :: status

  call test_orifices()
  call test_walls()
  call test_swept_volumes()
  call test_by_area()
  call test_passages()
  call finish()

contains

  subroutine test_orifices()
    type(riis_valve) :: valve
    type(riis_surface) :: surface, empty, plate
    type(riis_orifice) :: orifice, placed
    type(riis_leaflet) :: leaflet
    type(riis_surface_info) :: info
    real(c_double) :: xyz(3, 3), flow, area
    integer(int64) :: n
    integer :: i
    call valve%create('trileaflet')
    call valve%set('opening', 1d0)
    call surface%create(valve)
    call riis_get_orifice(surface, orifice)
    call check(orifice%outline == RIIS_OUTLINE_ATTACHMENT .and. orifice%outline_area > pi * 1.25d0**2 .and. &
      orifice%outline_area < pi * 1.35d0**2, 'the outline')
    call check(orifice%area > 3.8d0 .and. orifice%area < 4d0 .and. orifice%effective_area < orifice%area, 'the orifice')
    call surface%update(valve, scale=2d0, rotation_axis=[1d0, 2d0, 3d0], rotation_angle=40d0, half_thickness=0.2d0)
    call riis_get_orifice(surface, placed, half_thickness=0.2d0, rim=int(RIIS_RIM_ROUND, int64))
    call check(abs(placed%area - 4 * orifice%area) < 1d-4 .and. abs(placed%perimeter - 2 * orifice%perimeter) < 1d-2 .and. &
      abs(placed%effective_area - 4 * orifice%effective_area) < 1d-4, 'the orifice of a placed valve')
    call riis_get_orifice(surface, orifice, rim=7, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'resistance.rim is 7')
    call riis_get_orifice(surface, orifice, half_thickness=0d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'resistance.half_thickness is 0')
    call riis_get_orifice(empty, orifice, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')

    call riis_get_n_leaflets(surface, n)
    call check(n == 3, 'three leaflets')
    area = 0
    do i = 1, 3
      call riis_get_leaflet(surface, i, leaflet)
      area = area + leaflet%area
      call check(leaflet%leaflet_id == i - 1 .and. leaflet%free_edge > 4.9d0, 'a leaflet')
    end do
    call surface%get_info(info)
    call check(abs(area - info%area) < 1d-12 * area, 'leaflets share the surface')
    call riis_get_leaflet(surface, 4_int64, leaflet, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'leaflet is 3')
    call riis_get_n_leaflets(empty, n, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')

    call riis_get_leak(surface, 10d0, 50d0, flow)
    call check(abs(flow - 50 * 0.2d0 / 10 * area) < 1d-12 * flow, 'the ideal leak')
    call riis_get_leak(surface, 10d0, 50d0, flow, half_thickness=0.1d0)
    call check(abs(flow - 50 * 0.1d0 / 10 * area) < 1d-12 * flow, 'of another half thickness')
    call riis_get_leak(surface, 0d0, 50d0, flow, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'resistance.R is 0')
    xyz = reshape([0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0, 0d0], [3, 3])
    call plate%create_from_arrays(xyz, reshape([1, 2, 3], [3, 1]))
    call riis_get_orifice(plate, orifice)
    call check(orifice%outline == RIIS_OUTLINE_BOUNDARY .and. abs(orifice%outline_area - 0.5d0) < 1d-3, 'a boundary')
    call plate%destroy()
    call surface%destroy()
    call valve%destroy()
  end subroutine test_orifices

  ! A square tube stands around a trileaflet valve. Closed cusps touch along their free edges.
  subroutine test_walls()
    type(riis_valve) :: valve, prosthesis
    type(riis_surface) :: surface, wall, empty
    type(riis_attachment) :: attachment
    type(riis_leaflet) :: leaflet
    type(riis_coaptation) :: contact
    type(riis_gap) :: gap
    type(riis_orifice) :: orifice
    real(c_double) :: xyz(3, 8), length
    real(c_double), allocatable :: distance(:, :)
    integer :: ids(3, 8), i
    do i = 0, 3
      xyz(:, i + 1) = 3 * [cos(pi / 2 * i), sin(pi / 2 * i), -2d0]
      xyz(:, i + 5) = 3 * [cos(pi / 2 * i), sin(pi / 2 * i), 2d0]
      ids(:, 2 * i + 1) = [i + 1, mod(i + 1, 4) + 1, mod(i + 1, 4) + 5]
      ids(:, 2 * i + 2) = [i + 1, mod(i + 1, 4) + 5, i + 5]
    end do
    call wall%create_from_arrays(xyz, ids)
    call valve%create('trileaflet')
    call surface%create(valve)
    call surface%get_attachment(attachment)
    allocate (distance(2, size(attachment%edges, 3)))
    call riis_get_gap(surface, wall, gap, distance)
    call check(abs(minval(distance) - gap%least) < 1d-15 .and. abs(maxval(distance) - gap%most) < 1d-15 .and. &
      gap%least > 0.8d0 .and. gap%most < 2 .and. gap%n_without_wall == 0, 'the gap')
    call riis_get_gap(surface, wall, gap, distance(:, 2:), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'distance(1, :)')
    call riis_get_gap(surface, wall, gap, distance(:1, :), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the first extent of distance is 1')
    call riis_get_gap(wall, wall, gap, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'its attached edges are not known')
    call riis_get_orifice_in_wall(surface, wall, orifice, rim=RIIS_RIM_CUT)
    call check(orifice%outline == RIIS_OUTLINE_WALL .and. abs(orifice%outline_area - 18) < 1d-9 .and. &
      orifice%area > 11 .and. orifice%area < 14, 'an orifice in a wall')
    call riis_get_orifice_in_wall(surface, empty, orifice, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the wall was not created')
    call riis_get_gap(surface, empty, gap, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the wall was not created')
    call riis_set_skirt_to_wall(valve, wall, 2d0, scale=1d0, rotation_axis=[0d0, 0d0, 1d0], rotation_angle=0d0, &
      translation=[0d0, 0d0, 0d0])
    call valve%get('skirt_length', length)
    call check(abs(length - gap%most) < 1d-2, 'a skirt to the wall')
    call riis_set_skirt_to_wall(valve, wall, 1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'wall is not within longest, 1')
    call prosthesis%create('bileaflet')
    call riis_set_skirt_to_wall(prosthesis, wall, 1d0, status=status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'the bileaflet valve has no skirt')
    call riis_get_leaflet(surface, 2, leaflet)
    call riis_get_coaptation(surface, contact, leaflet_id=1)
    call check(abs(contact%edge - leaflet%free_edge) < 1d-12 .and. contact%area > 0 .and. &
      abs(contact%reach - 0.1d0) < 1d-15, 'contact')
    call riis_get_coaptation(surface, contact, reach=0.05d0)
    call check(abs(contact%edge - 3 * leaflet%free_edge) < 1d-9 .and. abs(contact%reach - 0.05d0) < 1d-15, 'contact of all')
    call riis_get_coaptation(surface, contact, leaflet_id=7, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'leaflet_id is 7')
    call prosthesis%destroy()
    call surface%destroy()
    call wall%destroy()
    call valve%destroy()
  end subroutine test_walls

  ! The halves of a disc turn, and a triangle translates.
  ! Finds the opening and the scale at which the orifice of a valve has an area.
  subroutine test_by_area()
    type(riis_valve) :: valve, empty
    type(riis_surface) :: surface
    type(riis_orifice) :: orifice
    type(riis_area_range) :: range
    real(c_double) :: values(2), reached(2), scales(1)
    integer(riis_status) :: status
    call valve%create('bileaflet')
    call riis_find_by_area(valve, [1d0, 2d0], values, reached=reached, range=range, n_samples=5)
    call check(values(1) > 0 .and. values(1) < values(2) .and. values(2) < 1 .and. maxval(abs(reached - [1, 2])) < 1d-6 .and. &
      range%n_turns == 0 .and. range%n_surfaces < 30, 'openings by area')
    call valve%set('opening', values(2))
    call surface%create(valve, half_thickness=0.2d0)
    call riis_get_orifice(surface, orifice, rim=RIIS_RIM_CUT)
    call riis_find_by_area(valve, [orifice%effective_area], values(:1), effective=.true., from=0.1d0, to=0.9d0, &
      half_thickness=0.2d0, tolerance=0.05d0, rotation_axis=[0d0, 0d0, 1d0], rotation_angle=0d0, &
      translation=[0d0, 0d0, 0d0], triangulation=RIIS_TRIANGULATION_ADAPTED, rim=RIIS_RIM_CUT, area_tolerance=1d-6, &
      n_samples=5_int64, n_threads=1)
    call check(abs(values(1) - values(2)) < 1d-4, 'an opening by effective area')
    call riis_find_by_area(valve, [8 * reached(2)], scales, name='scale', scale=2d0, n_samples=3)
    call check(abs(scales(1) - 2 * sqrt(2d0)) < 1d-6, 'a scale by area')
    call riis_find_by_area(valve, [9d0], scales, status=status, n_samples=3)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'area 0 is 9, which is out of reach')
    call riis_find_by_area(valve, [1d0], scales, name='radus', status=status)
    call check_refused(status, RIIS_INVALID_PARAMETER, "'radus' is not a parameter")
    call riis_find_by_area(valve, [1d0], values, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'values')
    call riis_find_by_area(valve, [1d0], scales, reached=values, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'reached')
    call riis_find_by_area(empty, [1d0], scales, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call surface%destroy()
    call valve%destroy()
  end subroutine test_by_area

  subroutine test_swept_volumes()
    type(riis_valve) :: valve, empty
    real(c_double) :: whole, half, back
    call valve%create('bileaflet')
    call riis_get_swept_volume(valve, 0d0, 1d0, whole)
    call riis_get_swept_volume(valve, 0d0, 1d0, half, RIIS_LEAFLET_POSITIVE, n_threads=2)
    call riis_get_swept_volume(valve, 1d0, 0d0, back, int(RIIS_ALL_LEAFLETS, int64), scale=2d0)
    call check(whole > 1 .and. abs(half - whole / 2) < 1d-12 .and. abs(back + 8 * whole) < 1d-12, 'the swept volume')
    call riis_get_swept_volume(valve, 0d0, 1d0, back, flip_normals=.true.)
    call check(abs(back + whole) < 1d-14, 'turned over')
    call riis_get_swept_volume(valve, 0d0, 1.5d0, back, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'opening_to is 1.5')
    call riis_get_swept_volume(valve, 0d0, 1d0, back, 9, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'leaflet_id is 9')
    call riis_get_swept_volume(empty, 0d0, 1d0, back, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call valve%destroy()
  end subroutine test_swept_volumes

  ! Tests passages in a box. The valve reaches the walls of the box, so the closed valve divides the box.
  subroutine test_passages()
    integer, parameter :: n_side = 17, n_along = 41, n_nodes = n_side * n_side * n_along
    type(riis_valve) :: valve, empty
    type(riis_surface) :: surface
    type(riis_mesh) :: mesh
    type(riis_adjacency) :: adjacency
    type(riis_marks) :: marks
    type(riis_cells_across) :: cells
    type(riis_first_passage) :: first, again
    type(riis_passage) :: passage
    real(c_double), allocatable, target :: xyz(:, :)
    logical :: mask(n_nodes)
    integer :: i, j, k, from(1), to(1)
    allocate (xyz(3, n_nodes))
    do k = 1, n_along
      do j = 1, n_side
        do i = 1, n_side
          xyz(:, i + n_side * (j - 1 + n_side * (k - 1))) = 0.1d0 * [i - 9, j - 9, k - 21]
        end do
      end do
    end do
    from = (n_side**2 + 1) / 2
    to = n_nodes - (n_side**2 - 1) / 2
    call valve%create('trileaflet')
    call mesh%create(xyz)
    call riis_find_first_passage(valve, mesh, from, to, first, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'mesh has no adjacency')
    call adjacency%create_from_grid(n_side, n_side, n_along)
    call mesh%set_adjacency(adjacency)

    call surface%create(valve)
    call riis_get_cells_across(marks, mesh, cells, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call riis_mark_nodes(surface, mesh, marks)
    call riis_get_cells_across(marks, mesh, cells)
    call check(all(abs([cells%least, cells%mean, cells%most] - 2) < 1d-12) .and. cells%n_edges > 0 .and. &
      abs(cells%mean_edge - 0.1d0) < 1d-14, 'two cells across')

    call riis_find_first_passage(valve, mesh, from, to, first, opening_tolerance=0.01d0, n_threads=2)
    call check(first%state == RIIS_FIRST_PASSAGE_FOUND .and. first%opening > 0 .and. first%opening < 0.5d0 .and. &
      first%opening - first%closed_opening <= 0.01d0, 'the first passage')
    call valve%set('opening', first%opening)
    call surface%update(valve)
    call riis_find_passage(surface, mesh, from, to, passage)
    call check(passage%state == RIIS_PASSAGE_OPEN .and. passage%node_id == first%node_id, 'it is open')
    call valve%set('opening', first%closed_opening)
    call surface%update(valve)
    call riis_find_passage(surface, mesh, from, to, passage)
    call check(passage%state == RIIS_PASSAGE_CLOSED, 'before, it is closed')
    call riis_find_first_passage(valve, mesh, int(from, int64), int(to, int64), again, half_thickness=0.1d0, &
      tolerance=0.05d0, scale=1d0, rotation_axis=[0d0, 0d0, 2d0], rotation_angle=120d0, translation=[0d0, 0d0, 0d0], &
      opening_tolerance=0.01d0)
    call check(abs(again%opening - first%opening) < 0.05d0, 'turned by a third')
    mask = .true.
    mask(n_side**2 + 1:2 * n_side**2) = .false.
    call riis_find_first_passage(valve, mesh, from, to, again, node_mask=mask)
    call check(again%state == RIIS_FIRST_PASSAGE_NONE .and. again%node_id == -1, 'behind a mask')
    call riis_find_first_passage(valve, mesh, from, to, again, opening_tolerance=2d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.tolerance is 2')
    call riis_find_first_passage(valve, mesh, [0], to, again, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'ends.from[0] is -1')
    call riis_find_first_passage(valve, mesh, from, to, again, half_thickness=-2d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'half_thickness is -2')
    call riis_find_first_passage(empty, mesh, from, to, again, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call mesh%destroy()
    call adjacency%destroy()
    call marks%destroy()
    call surface%destroy()
    call valve%destroy()
  end subroutine test_passages
end program test_measures
