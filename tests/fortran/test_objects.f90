! SPDX-License-Identifier: Apache-2.0
! Tests module riis: valves, surfaces, closest points, errors and log. Results equal those of riis_c bit for bit.
module log_lines
  use, intrinsic :: iso_fortran_env, only: int32
  use riis, only: RIIS_LOG_WARNING
  implicit none
  private
  public :: keep_line, n_lines, last_warning
  integer :: n_lines = 0
  character(len=200) :: last_warning = ''

contains

  subroutine keep_line(message, level)
    character(len=*), intent(in) :: message
    integer(int32), intent(in) :: level
    n_lines = n_lines + 1
    if (level == RIIS_LOG_WARNING) last_warning = message
  end subroutine keep_line
end module log_lines

program test_objects
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_f_pointer, c_null_ptr
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use checks
  use log_lines
  use riis
  use riis_c, only: c_get_triangles => riis_surface_get_triangles, c_triangles => riis_triangles, &
    c_closest_point => riis_closest_point
  implicit none
  real(c_double), parameter :: square(3, 4) = reshape([0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 1d0, 1d0, 0d0, 0d0, 1d0, 0d0], [3, 4])
  integer(riis_status) :: status

  call test_texts()
  call test_valve()
  call test_patches()
  call test_options()
  call test_surface()
  call test_distances()
  call test_surface_from_arrays()
  call test_closest_points()
  call test_crossings()
  call test_log()
  call test_empty()
  call test_assignment()
  call finish()

contains

  ! The right cusp is turned into its neighbours.
  subroutine test_crossings()
    type(riis_valve) :: turned
    type(riis_surface) :: surface
    type(riis_crossings) :: crossings
    type(riis_crossing_list) :: list
    integer :: deepest
    call riis_find_crossings(surface, crossings, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call crossings%get_list(list, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object crossings was not created')
    call check(list%n_pairs == 0 .and. size(list%triangle_id) == 0 .and. size(list%length) == 0, 'no pairs to point to')
    call turned%create('aortic')
    call turned%set('right.rotation', [0d0, 0d0, 60d0])
    call surface%create(turned)
    call riis_find_crossings(surface, crossings, depth=-1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.depth is -1')
    call riis_find_crossings(surface, crossings, n_threads=-1, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_threads is -1')
    call check(.not. crossings%is_created() .and. .not. c_associated(crossings%c_handle()), 'refused calls make nothing')
    call riis_find_crossings(surface, crossings, 1d-3, 2)
    call crossings%get_list(list)
    call check(list%n_pairs > 10 .and. size(list%triangle_id, 2) == list%n_pairs .and. &
      size(list%point, 2) == list%n_pairs .and. size(list%length) == list%n_pairs, 'pairs that cross')
    deepest = maxloc(list%depth, 1)
    call check(all(list%triangle_id(1, :) < list%triangle_id(2, :)) .and. minval(list%depth) > 1d-4, 'the lower one first')
    call check(all(list%deepest_triangle_id == list%triangle_id(:, deepest)) .and. &
      all(same([list%deepest_depth, list%deepest_point], [list%depth(deepest), list%point(:, deepest)])), 'the deepest pair')
    call check(abs(sum(list%length) - list%total_length) < 1d-12 .and. list%seconds > 0 .and. &
      all(list%deepest_leaflet_id >= 0), 'the summary')
    call surface%update(turned)
    call crossings%get_list(list)
    call check(size(list%depth) == list%n_pairs .and. list%n_pairs > 10, 'an update leaves the pairs')
    call surface%destroy()
    call crossings%destroy()
    call crossings%destroy()
    call turned%destroy()
  end subroutine test_crossings

  subroutine test_texts()
    call check(riis_error_message() == '', 'no error text before the first error')
    call check(verify(riis_version_string(), '0123456789.') == 0, 'the version')
    call check(riis_status_name(RIIS_INVALID_MESH) == 'RIIS_INVALID_MESH', 'the name of a status')
    call check(riis_status_name(99) == 'unknown status', 'the name of none')
  end subroutine test_texts

  subroutine test_valve()
    type(riis_valve) :: valve, other
    type(riis_parameter_info) :: info
    real(c_double) :: angle, line(6), rotation(3)
    integer(int64) :: i, n
    logical :: found

    call valve%create('pulmonary', status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'pulmonary')
    call check(.not. valve%is_created(), 'a refused valve is empty')
    call valve%create('aortic    ', status)
    call check_ok(status, 'a name with trailing blanks')
    call check(valve%is_created() .and. c_associated(valve%c_handle()), 'the valve is created')
    call valve%create('mitral', status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was already created')

    call valve%set('leaflet_angle  ', 21.5d0)
    call valve%get('left.leaflet_angle', angle)
    call check(same(angle, 21.5d0), 'a name without a cusp sets all three')
    line = [1, 0, 2, 0, 3, 0]
    call valve%set('right.rotation', line(1::2), status)
    call check_ok(status, 'values that do not lie side by side')
    call valve%get('right.rotation', rotation)
    call check(all(same(rotation, [1d0, 2d0, 3d0])), 'are the parameter''s')
    line = -1
    call valve%get('right.rotation', line(6:1:-2))
    call check(all(same(line, [-1d0, 3d0, -1d0, 2d0, -1d0, 1d0])), 'are got to where they belong')
    call valve%set('leaflet_angle', 1d3, status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'leaflet_angle')
    call check(riis_error_message() /= '', 'the error has a text')
    call valve%set('right.rotation', [1d0, 2d0], status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'right.rotation')
    angle = 7
    call valve%get('leaflet_angle', angle, status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'leaflet_angle')
    call check(same(angle, 7d0), 'a refused call writes nothing')
    call valve%get('rotation', rotation, status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'rotation')

    call test_named_sizes()
  call test_coapting()

    n = valve%n_parameters(status)
    call check_ok(status, 'the number of parameters')
    found = .false.
    do i = 1, n
      call valve%parameter(i, info)
      if (info%name /= 'right.rotation') cycle
      found = info%unit == 'degree' .and. len(info%description) > 0 .and. size(info%default_values) == 3 .and. &
        info%minimum < info%maximum
    end do
    call check(found, 'the parameters are described')
    call valve%parameter(1, info, status)
    call check_ok(status, 'the first parameter by an integer(int32)')
    call valve%parameter(0, info, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'number is 0')
    call valve%parameter(n + 1, info, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the parameters 1 to')

    call other%create('mitral')
    call valve%set_open_state(other, status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'kind')
    call other%destroy()
    call valve%set_open_state(other, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'open was not created, or was destroyed')
    call other%create('aortic')
    call valve%set_open_state(other, status)
    call check_ok(status, 'an open state')
    call other%destroy()
    call valve%set('opening', 0.5d0, status)
    call check_ok(status, 'a valve with an open state opens')
    call valve%destroy()
    call valve%destroy()
    call check(.not. valve%is_created(), 'a valve that was destroyed twice is empty')
    call valve%create('mitral', status)
    call check_ok(status, 'a valve that was destroyed can be created again')
    call valve%destroy()
  end subroutine test_valve

  ! A surgeon's names set sizes in every order, and other sizes follow from them.
  subroutine test_named_sizes()
    character(len=*), parameter :: names(3) = [character(len=16) :: 'annulus', 'stj', 'effective_height']
    integer, parameter :: orders(3, 6) = reshape([1, 2, 3, 1, 3, 2, 2, 1, 3, 2, 3, 1, 3, 1, 2, 3, 2, 1], [3, 6])
    real(c_double), parameter :: sizes(3) = [2.3d0, 2.6d0, 1d0]
    type(riis_valve) :: valve
    type(riis_parameter_info) :: info
    real(c_double) :: value, rotation(3)
    integer :: i, k
    logical :: is_set
    do i = 1, 6
      call valve%create('trileaflet')
      do k = 1, 3
        call valve%set(names(orders(k, i)), sizes(orders(k, i)))
      end do
      call valve%get('bending_height', value)
      call check(same(value, 0.5d0), 'half of effective_height')
      call valve%get('bending_radius_in', value)
      call check(abs(value - 0.368d0) < 1d-15, 'a share of annulus')
      call valve%get('bending_radius_out', value)
      call check(abs(value - 1.2495d0) < 1d-15, 'a share of annulus and stj')
      call valve%get('stj', value)
      call check(same(value, 2.6d0), 'stj as it was set')
      if (i < 6) call valve%destroy()
    end do
    call check(valve%is_set('annulus'), 'a size is set')
    call check(valve%is_set('root_radius  '), 'a size is set by its other name')
    call check(.not. valve%is_set('bending_height'), 'a size that follows is not set')
    call valve%set('bending_height', 0.6d0)
    call check(valve%is_set('bending_height'), 'a size that was set')
    call valve%unset('bending_height  ', status)
    call check_ok(status, 'unset')
    call valve%get('bending_height', value)
    call check(same(value, 0.5d0), 'a size follows again')
    call check(.not. valve%is_set('bending_height'), 'a size that was unset')
    call valve%parameter(1, info)
    call check(info%rule == '' .and. info%other_name == 'annulus' .and. same(info%other_factor, 2d0), 'a second name')
    call valve%parameter(4, info)
    call check(info%rule == '0.5 leaflet_height' .and. info%other_name == '' .and. same(info%other_factor, 0d0), 'a rule')
    call valve%unset('right.stj', status)
    call check_refused(status, RIIS_INVALID_PARAMETER, '''right.stj'' is not a parameter of the trileaflet valve')
    is_set = valve%is_set('stjj', status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'did you mean ''stj''?')
    call check(.not. is_set, 'a refused call returns .false.')
    call valve%set('annulus', -1d0, status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'parameter ''annulus'' is -1; it must be from 2e-09 to 2e+09')
    call valve%destroy()
    call valve%unset('stj', status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    is_set = valve%is_set('stj', status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call check(.not. is_set, 'nothing is set on no valve')

    call valve%create('mitral')
    call valve%set('annulus', 3.5d0, status)
    call check_refused(status, RIIS_INVALID_PARAMETER, &
      '''annulus'' is not a parameter of the mitral valve: its annulus is not round')
    call valve%get('stj', value, status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'it has no sinotubular junction')
    call valve%destroy()
    call valve%create('bileaflet')
    call valve%set('annulus', 2.5d0)
    call valve%get('radius', value)
    call check(same(value, 1.25d0), 'the radius of a bileaflet valve is half of annulus')
    call valve%set('effective_height', 1d0, status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'only cusps have an effective height')
    call valve%destroy()
    call valve%create('aortic')
    call valve%set('leaflet_angle', 60d0)
    call valve%get('non_coronary.rotation', rotation)
    call check(all(same(rotation, [0d0, 0d0, -120d0])), 'cusps turn until they meet')
    is_set = valve%is_set('stj', status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'exists for each leaflet separately: name a leaflet, as in ''right.stj''')
    call valve%destroy()
  end subroutine test_named_sizes

  ! Tests the sizes of the coapting valve, its refusals, and the length of its free edges at two openings.
  subroutine test_coapting()
    type(riis_valve) :: valve
    type(riis_surface) :: surface
    type(riis_leaflet) :: closed, half_open
    real(c_double) :: value
    call valve%create('coapting')
    call valve%set('annulus', 2.2d0)
    call valve%set('stj', 2d0)
    call valve%get('commissure_height', value)
    call check(abs(value - 1.4d0) < 1d-15, 'the commissures are 1.4 radii high')
    call valve%get('effective_height', value)
    call check(abs(value - 0.7255d0) < 1d-15, 'the free edge rises by 34 degrees')
    call surface%create(valve)
    call riis_get_leaflet(surface, 3, closed)
    call valve%set('opening', 0.5d0)
    call surface%update(valve)
    call riis_get_leaflet(surface, 3, half_open)
    call check(abs(half_open%free_edge / closed%free_edge - 1) < 1d-3, 'a free edge keeps its length')
    call valve%set('gap', 1d-3)
    call surface%update(valve, status=status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'gap is 0.001; it must be from 0.002 to 0.2 times commissure_radius')
    call valve%unset('gap')
    call valve%set('effective_height', 1.38d0)
    call surface%update(valve, status=status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'effective_height is 1.38')
    call valve%set('bottom_angle', 81d0, status)
    call check_refused(status, RIIS_INVALID_PARAMETER, '''bottom_angle'' is 81; it must be from 0 to 80')
    call valve%destroy()
    call surface%destroy()
  end subroutine test_coapting

  ! A unit square of one patch.
  subroutine test_patches()
    type(riis_triangles) :: all_triangles
    type(riis_valve) :: valve
    type(riis_surface) :: surface, twin
    type(riis_surface_info) :: info
    integer(int32) :: degree(4), curve_id(4, 1), leaflet_id(1)
    real(c_double) :: control(3, 8)
    logical :: reversed(4, 1)
    integer(int32), pointer :: leaflets(:), patches(:)

    degree = 1
    control = square(:, [1, 2, 4, 3, 1, 4, 2, 3]) ! the sides v = 0, v = 1, u = 0, u = 1
    curve_id(:, 1) = [1, 2, 3, 4]
    leaflet_id = 5
    call valve%create_from_patches(degree, control, curve_id, leaflet_id=leaflet_id)
    call surface%create(valve, half_thickness=0.1d0)
    call surface%get_info(info)
    call check(abs(info%area - 1) < 1d-12, 'the area of the square')
    call surface%get_triangles(all_triangles)
    leaflets => all_triangles%leaflet_id
    patches => all_triangles%patch_id
    call check(size(leaflets) > 0 .and. all(leaflets == 5) .and. all(patches == 0), 'the leaflet and patch ids')
    call valve%destroy()

    ! The patch is given again in another way. One side is reversed. Curves and sides are integers of the other kind, which count
    ! from 0.
    control(:, 3:4) = square(:, [3, 4])
    reversed = .false.
    reversed(2, 1) = .true.
    call valve%create_from_patches(int(degree, int64), control, int(curve_id - 1, int64), reversed, &
      int(leaflet_id, int64), index_base=0)
    call twin%create(valve, half_thickness=0.1d0)
    call check_same_surface(surface, twin, 'a side turned round')
    call twin%destroy()
    call valve%destroy()
    call valve%create_from_patches(int(degree, int64), control, int(curve_id, int64), reversed, status=status)
    call check_ok(status, 'without leaflets')
    call valve%destroy()

    call valve%create_from_patches(degree, control, curve_id, status=status)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'patch')
    call valve%create_from_patches(degree, control(:, :7), curve_id, reversed, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, '7; there are 8')
    call valve%create_from_patches(degree, control(:2, :), curve_id, reversed, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'control is 2')
    call valve%create_from_patches(degree, control, curve_id(:3, :), reversed, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'curve_id is 3')
    call valve%create_from_patches(degree, control, curve_id, reversed(:3, :), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'reversed is (3, 1)')
    call valve%create_from_patches(degree, control, curve_id, reversed, [1, 2], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'leaflet_id')
    call valve%create_from_patches(degree(:0), control(:, :0), curve_id(:, :0), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_curves')
    call valve%create_from_patches([2_int64**40], control, int(curve_id, int64), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'degree has the entry 1099511627776')
    call valve%create_from_patches(degree, control, curve_id, index_base=3, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'index_base is 3')
    call surface%destroy()
  end subroutine test_patches

  ! Some options may be of either integer kind, other options only of one kind.
  subroutine test_options()
    type(riis_valve) :: valve
    type(riis_surface) :: surface
    real(c_double) :: distance(1)
    call valve%create('aortic')
    call surface%create(valve)
    call surface%closest_points(square(:, :1), n_threads=1_int32, distance=distance)
    call surface%closest_points(square(:, :1), n_threads=1_int64, distance=distance)
    call surface%closest_points(square(:, :1), n_threads=2_int64**40, distance=distance, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_threads is 1099511627776; it must fit in 32 bits')
    call surface%closest_points(square(:, :1), n_threads=-huge(0_int64) - 1, distance=distance, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_threads is -9223372036854775808; it must fit in 32 bits')
    call surface%closest_points(square(:, :1), n_threads=-1, distance=distance, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_threads is -1')
    call surface%closest_points(square(:, :1), n_threads=1.0, distance=distance, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_threads is neither an integer(int32) nor an integer(int64)')
    call surface%closest_points(square(:, :1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'none of distance, point,')
    call surface%destroy()
    call valve%destroy()
  end subroutine test_options

  subroutine test_surface()
    type(c_triangles) :: from_c
    type(riis_triangles) :: all_triangles
    type(riis_valve) :: valve
    type(riis_surface) :: surface, twin
    type(riis_surface_info) :: info, again
    real(c_double), pointer :: xyz(:, :), uv(:, :)
    integer(int64), pointer :: vertex_id(:, :), triangle_id(:)
    type(c_ptr) :: c_xyz, c_vertex_id
    integer(int64) :: i, n

    call valve%create('aortic')
    call surface%create(valve, half_thickness=0.2d0, tolerance=0.1d0, scale=2d0, rotation_axis=[1d0, 0d0, 0d0], &
      rotation_angle=90d0, translation=[1d0, 2d0, 3d0], flip_normals=.true., status=status)
    call check_ok(status, 'a surface with all options')
    call surface%create(valve, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was already created')
    call surface%get_info(info)
    call check(same(info%half_thickness, 0.2d0) .and. info%n_triangles > 0, 'its half thickness')

    call surface%get_triangles(all_triangles)
    xyz => all_triangles%xyz
    call surface%get_triangles(all_triangles)
    uv => all_triangles%uv
    call surface%get_triangles(all_triangles)
    vertex_id => all_triangles%vertex_id
    triangle_id => all_triangles%triangle_id
    call check(size(xyz, 2) == info%n_vertices .and. size(uv, 2) == info%n_vertices, 'its vertices')
    call check(all(triangle_id == [(i, i = 0, info%n_triangles - 1)]), 'its triangles')
    c_xyz = c_null_ptr
    c_vertex_id = c_null_ptr
    n = 0
    status = c_get_triangles(surface%c_handle(), from_c, storage_size(from_c, int64) / 8)
    n = from_c%n_triangles
    c_xyz = from_c%xyz
    c_vertex_id = from_c%vertex_id
    call check_address(xyz, c_xyz, 'the vertices are the library''s own')
    call check(size(vertex_id, 2) == n .and. minval(vertex_id) == 0, 'the corners count from 0')

    ! An update keeps the options that its call leaves out, and replaces those that the call gives.
    call surface%update(valve)
    call surface%get_info(again)
    call check(same(again%half_thickness, info%half_thickness) .and. all(same(again%lower, info%lower)), 'all options stay')
    call surface%update(valve, scale=1d0, flip_normals=.false.)
    call twin%create(valve, 0.2d0, 0.1d0, 1d0, [1d0, 0d0, 0d0], 90d0, [1d0, 2d0, 3d0])
    call check_same_surface(surface, twin, 'some options stay')
    call surface%update(valve, tolerance=7d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'tolerance is 7')
    call surface%update(valve, rotation_axis=[1d0, 0d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of rotation_axis is 2; it must be 3')
    call surface%update(valve, translation=[1d0, 2d0, 3d0, 4d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of translation is 4; it must be 3')
    call surface%update(valve)
    call check_same_surface(surface, twin, 'a refused option is forgotten')
    call twin%destroy()
    ! The default half thickness is multiplied by the scale.
    call twin%create(valve)
    call twin%update(valve, scale=10d0)
    call twin%get_info(info)
    call check(same(info%half_thickness, 1d0), 'the default half thickness is 0.1 * scale')
    call twin%destroy()
    call surface%destroy()
    call valve%destroy()
  end subroutine test_surface

  ! Another way to measure distances is chosen when a surface is made, or later. The surface keeps it.
  subroutine test_distances()
    type(riis_valve) :: valve
    type(riis_surface) :: by_triangles, by_other
    type(riis_closest) :: exact, closest
    integer(int32) :: method, side(1)
    real(c_double), parameter :: point(3) = [0.3d0, 0.2d0, -0.1d0], half_thickness = 0.1d0
    real(c_double) :: distance(1)

    call valve%create('aortic')
    call by_triangles%create(valve)
    call by_triangles%closest_point(point, exact)
    do method = RIIS_MEASURE_SAMPLING, RIIS_MEASURE_MINIMIZATION
      call by_other%create(valve, measure=method, measure_tolerance=0.1d0, status=status)
      call check_ok(status, 'a surface with another distance')
      call by_other%update(valve)
      call by_other%closest_point(point, closest)
      call check(closest%triangle_id == -1 .and. exact%triangle_id >= 0, 'it has no triangle')
      call check(abs(closest%distance - exact%distance) <= 0.15d0 * half_thickness .and. &
        .not. same(closest%distance, exact%distance), 'it is about as far')
      call by_other%closest_points(reshape(point, [3, 1]), distance=distance)
      call check(same(distance(1), closest%distance), 'a batch agrees')
      call by_other%closest_points(reshape(point, [3, 1]), side=side, status=status)
      call check_refused(status, RIIS_INVALID_ARGUMENT, 'arrays.side is given')
      call by_other%update(valve, measure=RIIS_MEASURE_TRIANGLES)
      call by_other%closest_point(point, closest)
      call check(same(closest%distance, exact%distance) .and. closest%triangle_id == exact%triangle_id, 'triangles again')
      call by_other%update(valve, measure=7_int32, status=status)
      call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.measure is 7')
      call by_other%update(valve, measure=method, measure_tolerance=2d0, status=status)
      call check_refused(status, RIIS_INVALID_ARGUMENT, 'options.measure_tolerance is 2')
      call by_other%destroy()
    end do
    call by_triangles%destroy()
    call valve%destroy()
  end subroutine test_distances

  subroutine test_surface_from_arrays()
    type(riis_triangles) :: all_triangles
    type(riis_surface) :: surface, twin
    type(riis_surface_info) :: info
    integer(int32) :: faces(3, 2), leaflets(2), wide(6, 2)
    real(c_double) :: sheet(6, 8)
    real(c_double), pointer :: uv(:, :)

    faces = reshape([1, 2, 3, 1, 3, 4], [3, 2])
    leaflets = [7, 8]
    call surface%create_from_arrays(square, faces, leaflets, half_thickness=0.1d0)
    call surface%get_info(info)
    call check(same(info%area, 1d0) .and. info%n_triangles == 2, 'two triangles')
    call surface%get_triangles(all_triangles)
    uv => all_triangles%uv
    call check(size(uv) == 0, 'which have no parameters')

    sheet = -9
    sheet(2:6:2, 1::2) = square
    wide = 99
    wide(1::2, :) = faces
    call twin%create_from_arrays(sheet(2:6:2, 1::2), int(faces - 1, int64), leaflets, index_base=0_int64, &
      half_thickness=0.1d0)
    call check_same_surface(surface, twin, 'a section of coordinates, faces of the other kind from 0')
    call twin%destroy()
    call twin%create_from_arrays(square(1, :), square(2, :), square(3, :), wide(1::2, :), leaflets, half_thickness=0.1d0)
    call check_same_surface(surface, twin, 'separate coordinates, a section of faces')
    call twin%destroy()
    call twin%create_from_arrays(square(1, :), square(2, :), square(3, :), int(faces, int64), leaflets, &
      half_thickness=0.1d0)
    call check_same_surface(surface, twin, 'separate coordinates, faces of the other kind')
    call twin%destroy()
    call twin%create_from_arrays(square, reshape([1, 2, 3, 4], [4, 1]), half_thickness=0.1d0)
    call check_same_surface(surface, twin, 'a quad')

    ! Updates move the sheet up by 1.
    sheet(6, :) = 1
    call surface%update_from_arrays(sheet(2:6:2, 1::2), faces, leaflets)
    call surface%get_info(info)
    call check(same(info%lower(3), 1d0) .and. same(info%half_thickness, 0.1d0), 'an update by a section')
    call twin%update_from_arrays(sheet(2:6:2, 1::2), int(faces, int64), leaflets)
    call check_same_surface(surface, twin, 'an update by faces of the other kind')
    call twin%update_from_arrays(square(1, :), square(2, :), square(3, :), faces)
    call twin%update_from_arrays(sheet(2, 1::2), sheet(4, 1::2), sheet(6, 1::2), int(faces, int64), leaflets)
    call check_same_surface(surface, twin, 'an update by separate coordinates')
    call twin%destroy()

    ! A triangle without area.
    faces(:, 2) = 1
    call surface%update_from_arrays(square, faces, status=status)
    call check_refused(status, RIIS_INVALID_SURFACE, 'area')
    call surface%update_from_arrays(square, faces, skip_zero_area=.true.)
    call surface%get_info(info)
    call check(info%n_zero_area == 1, 'it can be skipped')
    call surface%update_from_arrays(square, faces, status=status)
    call check_ok(status, 'and stays so')
    call twin%create_from_arrays(square, faces, skip_zero_area=.true., status=status)
    call check_ok(status, 'also at first')
    call twin%destroy()

    call surface%update_from_arrays(square(:2, :), faces, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of xyz is (2, 4); it must be (3, n)')
    call surface%update_from_arrays(square, faces(:2, :), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'vertex_ids is 2')
    call surface%update_from_arrays(square, faces, leaflets(:1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of leaflet_id is 1; there are 2 faces')
    call surface%update_from_arrays(square(:, :0), faces, status=status)
    call check_refused(status, RIIS_INVALID_SURFACE, 'no vertices')
    call surface%update_from_arrays(square, reshape([1, 2, 3], [3, 1]), translation=[1d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of translation is 1')
    call twin%create_from_arrays(square, reshape([1, 2, 3], [3, 1]), translation=[1d0], status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of translation is 1')
    call surface%update_from_arrays(square, faces(:, :0), status=status)
    call check_refused(status, RIIS_INVALID_SURFACE, 'no faces')
    call surface%destroy()
  end subroutine test_surface_from_arrays

  subroutine test_closest_points()
    integer, parameter :: n = 50
    type(riis_valve) :: valve
    type(riis_surface) :: surface
    type(riis_closest) :: closest, from_c
    real(c_double) :: xyz(3, n), distance(n), point(3, n), barycentric(3, n), normal(3, n), sections(2, n), random(4, 3)
    integer(int64) :: triangle_id(n)
    integer(int32) :: leaflet_id(n), side(n)
    logical :: all_same
    integer :: i

    call random_init(.true., .true.)
    call random_number(xyz)
    xyz = 2 * xyz - 1
    call valve%create('aortic')
    call surface%create(valve)
    call surface%closest_points(xyz, distance=distance, point=point, barycentric=barycentric, normal=normal, &
      triangle_id=triangle_id, leaflet_id=leaflet_id, side=side)
    all_same = .true.
    do i = 1, n
      call surface%closest_point(xyz(:, i), closest)
      status = c_closest_point(surface%c_handle(), xyz(:, i), from_c, storage_size(from_c, int64) / 8)
      all_same = all_same .and. status == RIIS_OK .and. same(closest%distance, from_c%distance) .and. &
        same(distance(i), from_c%distance) .and. all(same(point(:, i), from_c%point)) .and. &
        all(same(barycentric(:, i), from_c%barycentric)) .and. all(same(normal(:, i), from_c%normal)) .and. &
        triangle_id(i) == from_c%triangle_id .and. leaflet_id(i) == from_c%leaflet_id .and. side(i) == from_c%side .and. &
        closest%side == from_c%side
    end do
    call check(all_same, 'closest points are those of riis_c')

    ! Tests closest points with leaflets, separate coordinates and a limit.
    sections = -1
    call surface%closest_points(xyz(1, :), xyz(2, :), xyz(3, :), distance_limit=0.2d0, far_distance=-5d0, &
      distance=sections(2, :), n_threads=2)
    call check(all(same(sections(2, :), merge(distance, -5d0, distance <= 0.2d0))) .and. all(same(sections(1, :), -1d0)), &
      'answers into a section, with a limit')
    call surface%closest_points(xyz(:, :0), distance=distance(:0), point=point(:, :0), triangle_id=triangle_id(:0), &
      leaflet_id=leaflet_id(:0), side=side(:0), status=status)
    call check_ok(status, 'no points')

    distance = -1
    call surface%closest_points(xyz, distance=distance(:n - 1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of distance is 49; there are 50 points')
    call surface%closest_points(xyz, distance=distance, point=point(:2, :), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of point is (2, 50); it must be (3, 50)')
    call surface%closest_points(xyz, triangle_id=triangle_id(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of triangle_id is 49')
    call surface%closest_points(xyz, leaflet_id=leaflet_id(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of leaflet_id is 49')
    call surface%closest_points(xyz, side=side(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of side is 49')
    call surface%closest_points(xyz(:, n:1:-1), distance=distance, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'a stride of -24 bytes')
    xyz(2, 7) = ieee_value(0d0, ieee_quiet_nan)
    call surface%closest_points(xyz, distance=distance(::1), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'point 6')
    call check(all(same(distance, -1d0)), 'refused calls write nothing')
    call surface%closest_point([1d0, 2d0], closest, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of point is 2; it must be 3')
    random = 0.5d0
    call surface%closest_point(random(2, :), closest, status)
    call check_ok(status, 'a point that does not lie side by side')
    call surface%destroy()
    call valve%destroy()
  end subroutine test_closest_points

  subroutine test_log()
    type(riis_surface) :: surface
    integer :: n
    call riis_set_log(keep_line)
    call surface%create_from_arrays(square, reshape([1, 2, 3, 1, 1, 1], [3, 2]), skip_zero_area=.true.)
    call check(n_lines > 0 .and. index(last_warning, 'area') > 0, 'the log has a warning: ' // trim(last_warning))
    call riis_set_log()
    n = n_lines
    call surface%update_from_arrays(square, reshape([1, 2, 3, 1, 1, 1], [3, 2]))
    call check(n_lines == n, 'silence')
    call surface%destroy()
  end subroutine test_log

  ! A call refuses handles that were not created.
  subroutine test_empty()
    type(riis_triangles) :: all_triangles
    type(riis_valve) :: valve
    type(riis_surface) :: surface
    type(riis_surface_info) :: info
    type(riis_closest) :: closest
    type(riis_parameter_info) :: parameter
    real(c_double), pointer :: xyz(:, :), uv(:, :)
    integer(int64), pointer :: vertex_id(:, :), triangle_id(:)
    real(c_double) :: value, values(3)
    integer(int64) :: n

    call valve%set('leaflet_angle', 1d0, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created, or was destroyed')
    call valve%set('leaflet_angle', [1d0], status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call valve%get('leaflet_angle', value, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call valve%get('leaflet_angle', values, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    n = valve%n_parameters(status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call check(n == 0, 'no parameters')
    call valve%parameter(1, parameter, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call valve%set_open_state(valve, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the valve was not created')
    call surface%create(valve, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'valve was not created')
    call check(.not. surface%is_created() .and. .not. c_associated(surface%c_handle()), 'a refused surface is empty')
    call surface%update(valve, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call surface%update_from_arrays(square, reshape([1, 2, 3], [3, 1]), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call surface%get_info(info, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call surface%get_triangles(all_triangles, status)
    xyz => all_triangles%xyz
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call surface%get_triangles(all_triangles, status)
    uv => all_triangles%uv
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call surface%get_triangles(all_triangles, status)
    vertex_id => all_triangles%vertex_id
    triangle_id => all_triangles%triangle_id
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call check(size(xyz) == 0 .and. size(uv) == 0 .and. size(vertex_id) == 0 .and. size(triangle_id) == 0, 'no arrays')
    call surface%closest_point([0d0, 0d0, 0d0], closest, status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call surface%closest_points(square, distance=values(:0), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call surface%destroy()
    call valve%destroy()
  end subroutine test_empty

  ! Empty handles may be assigned, even inside other types. error_stop.f90 tests assignments of created handles.
  subroutine test_assignment()
    type :: holder
      type(riis_valve) :: valve
      type(riis_surface) :: surface
    end type holder
    type(holder) :: a, b
    type(riis_valve) :: valves(2), others(2)
    type(riis_leaks) :: leaks, other_leaks
    type(riis_crossings) :: crossings, other_crossings
    leaks = other_leaks
    crossings = other_crossings
    call check(.not. (leaks%is_created() .or. crossings%is_created()), 'no leaks, no crossings')
    a = b
    valves = others
    a%surface = b%surface
    call check(.not. (a%valve%is_created() .or. valves(2)%is_created() .or. a%surface%is_created()), &
      'an empty copy is empty')
  end subroutine test_assignment

  subroutine check_same_surface(a, b, what)
    type(riis_triangles) :: all_triangles
    type(riis_surface), intent(in) :: a, b
    character(len=*), intent(in) :: what
    real(c_double), pointer :: xyz_a(:, :), xyz_b(:, :)
    integer(int64), pointer :: corners_a(:, :), corners_b(:, :)
    type(riis_surface_info) :: info_a, info_b
    call a%get_triangles(all_triangles)
    xyz_a => all_triangles%xyz
    call b%get_triangles(all_triangles)
    xyz_b => all_triangles%xyz
    call a%get_triangles(all_triangles)
    corners_a => all_triangles%vertex_id
    call b%get_triangles(all_triangles)
    corners_b => all_triangles%vertex_id
    call a%get_info(info_a)
    call b%get_info(info_b)
    call check(size(xyz_a) > 0 .and. size(xyz_a) == size(xyz_b) .and. size(corners_a) == size(corners_b), what // ': sizes')
    call check(all(same(xyz_a, xyz_b)) .and. all(corners_a == corners_b) .and. &
      same(info_a%half_thickness, info_b%half_thickness), what // ': the same surface')
  end subroutine check_same_surface

  subroutine check_address(array, location, what)
    real(c_double), pointer, intent(in) :: array(:, :)
    type(c_ptr), intent(in) :: location
    character(len=*), intent(in) :: what
    real(c_double), pointer :: other(:, :)
    call c_f_pointer(location, other, shape(array))
    call check(associated(array, other), what)
  end subroutine check_address
end program test_objects
