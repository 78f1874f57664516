! SPDX-License-Identifier: Apache-2.0
! Calls every binding of riis_c. Each call must give the same bits as the same call from C (c_twin.c). check_called.sh checks that
! no binding is left out.
module log_capture
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int32_t, c_ptr
  use riis_c
  use riis_calls
  implicit none
  public

  ! The user data of the log function is a pointer to this type.
  type, bind(c) :: captured
    integer(c_int32_t) :: n_messages
    integer(c_int32_t) :: n_warnings
  end type captured
  character(len=200) :: last_warning = ''

contains

  subroutine capture(user_data, level, message) bind(c)
    type(c_ptr), value :: user_data
    integer(c_int32_t), value :: level
    type(c_ptr), value :: message
    type(captured), pointer :: log
    call c_f_pointer(user_data, log)
    log%n_messages = log%n_messages + 1
    if (level /= RIIS_LOG_WARNING) return
    log%n_warnings = log%n_warnings + 1
    last_warning = riis_c_text(message)
  end subroutine capture
end module log_capture

program test_calls
  use, intrinsic :: iso_c_binding
  use checks
  use c_twin
  use log_capture
  use riis_c
  use riis_calls
  implicit none
  integer(c_int64_t), parameter :: per_side = 20, n_nodes = per_side**3
  real(c_double), target :: xyz(3, n_nodes) ! a box around the valve, in mm, a node every 1.8 mm
  type(twin_numbers), target :: twin
  type(c_ptr) :: valve = c_null_ptr, surface = c_null_ptr, plate = c_null_ptr, mesh = c_null_ptr, result = c_null_ptr
  integer(c_int64_t) :: i

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -17 + 1.8d0 * [mod(i, per_side), mod(i / per_side, per_side), i / per_side**2]
  end do
  call check_ok(twin_run(per_side, c_loc(xyz), twin), 'the calls from C')

  call check(riis_c_text(riis_last_error()) == '', 'no error text before the first error')
  call test_version_and_texts()
  call test_valve()
  call test_surface()
  call test_mitral_valve()
  call test_open_state()
  call test_valve_from_patches()
  call test_surface_from_arrays()
  call test_closest_points()
  call test_marking()
  call test_motion()
  call test_keyframes()
  call test_warp()
  call test_crossings()
  call test_landmarks()
  call test_laws()
  call test_mixed_cells()
  call test_adjacency()
  call test_own_rows()
  call test_destroy()
  call check(transfer(RIIS_AUTO, 0_c_int64_t) == transfer(twin_auto(), 0_c_int64_t), 'RIIS_AUTO')
  call check(transfer(RIIS_FAR_DISTANCE, 0_c_int64_t) == transfer(twin_far_distance(), 0_c_int64_t), 'RIIS_FAR_DISTANCE')
  call twin_end()
  call finish()

contains

  ! Gives the arrays of a surface's triangles by their names.
  function triangles_from(surface, n_vertices, xyz, uv, velocity, n_triangles, vertex_id, triangle_id, leaflet_id, &
      patch_id) result(status)
    type(c_ptr), intent(in) :: surface
    integer(c_int64_t), intent(out), optional :: n_vertices, n_triangles
    type(c_ptr), intent(out), optional :: xyz, uv, velocity, vertex_id, triangle_id, leaflet_id, patch_id
    integer(riis_status) :: status
    type(riis_triangles) :: all
    all = riis_triangles(0, c_null_ptr, c_null_ptr, c_null_ptr, 0, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr)
    status = riis_surface_get_triangles(surface, all, c_sizeof(all))
    if (present(n_vertices)) n_vertices = all%n_vertices
    if (present(xyz)) xyz = all%xyz
    if (present(uv)) uv = all%uv
    if (present(velocity)) velocity = all%velocity
    if (present(n_triangles)) n_triangles = all%n_triangles
    if (present(vertex_id)) vertex_id = all%vertex_id
    if (present(triangle_id)) triangle_id = all%triangle_id
    if (present(leaflet_id)) leaflet_id = all%leaflet_id
    if (present(patch_id)) patch_id = all%patch_id
  end function triangles_from

  subroutine test_version_and_texts()
    integer(c_int32_t) :: major, minor, patch
    character(len=40) :: text
    integer :: i
    integer(riis_status), parameter :: statuses(11) = [RIIS_OK, RIIS_INVALID_ARGUMENT, RIIS_INVALID_STRUCT_SIZE, &
      RIIS_INVALID_PARAMETER, RIIS_INVALID_SURFACE, RIIS_INVALID_MESH, RIIS_LIMIT_EXCEEDED, RIIS_OUT_OF_MEMORY, &
      RIIS_FILE_ERROR, RIIS_UNAVAILABLE, RIIS_INTERNAL_ERROR]
    character(len=*), parameter :: names(11) = [character(len=24) :: 'RIIS_OK', 'RIIS_INVALID_ARGUMENT', &
      'RIIS_INVALID_STRUCT_SIZE', 'RIIS_INVALID_PARAMETER', 'RIIS_INVALID_SURFACE', 'RIIS_INVALID_MESH', &
      'RIIS_LIMIT_EXCEEDED', 'RIIS_OUT_OF_MEMORY', 'RIIS_FILE_ERROR', 'RIIS_UNAVAILABLE', 'RIIS_INTERNAL_ERROR']

    call riis_get_version(major, minor, patch)
    write (text, '(i0, ".", i0, ".", i0)') major, minor, patch
    call check(riis_c_text(riis_version_string()) == text, 'the version and its string agree: ' // trim(text))
    patch = -1
    call riis_get_version(patch=patch) ! an argument that is left out is passed as NULL
    call check(patch >= 0, 'the patch version alone')
    do i = 1, size(statuses)
      call check(riis_c_text(riis_status_name(statuses(i))) == names(i), 'the name of ' // names(i))
    end do
    call check(riis_c_text(riis_status_name(12345_riis_status)) == 'unknown status', 'the name of no status')

    call check(riis_c_text(c_null_ptr) == '', 'no text')
    call check(riis_c_string(' a b  ') == ' a b' // c_null_char, 'a string for C')
    call check(len(riis_c_string('')) == 1, 'an empty string for C')
  end subroutine test_version_and_texts

  subroutine test_valve()
    type(c_ptr) :: none = c_null_ptr
    type(riis_parameter), target :: parameter
    type(riis_parameter), pointer :: from_c(:)
    integer(c_int64_t) :: n_parameters, id, n_found
    integer(c_int32_t) :: is_set
    real(c_double) :: values(3), scalar(1)
    character(len=*), parameter :: rotation = 'non_coronary.rotation'

    call check_refused(riis_valve_create(riis_c_string('tricuspid'), none), RIIS_INVALID_PARAMETER, 'tricuspid')
    call check(.not. c_associated(none), 'no valve is made by a call that is refused')
    call check_ok(riis_valve_create(riis_c_string('aortic'), valve), 'create a valve')
    call check(c_associated(valve), 'a valve is made')

    n_parameters = 0
    call check_ok(riis_valve_get_n_parameters(valve, n_parameters), 'count parameters')
    call check(n_parameters == twin%n_parameters .and. n_parameters > 20, 'there are as many parameters as from C')
    call c_f_pointer(twin%parameters, from_c, [twin%n_parameters])
    n_found = 0
    do id = 0, n_parameters - 1
      call check_ok(riis_valve_get_parameter(valve, id, parameter, c_sizeof(parameter)), 'describe a parameter')
      call check_same_bytes(c_loc(parameter), c_loc(from_c(id + 1)), int(c_sizeof(parameter), c_int64_t), 'parameter')
      if (riis_c_text(parameter%name) /= rotation) cycle
      n_found = n_found + 1
      call check(parameter%n_values == 3, 'the length of ' // rotation)
      call check(riis_c_text(parameter%unit) == 'degree', 'the unit of ' // rotation)
      call check(len(riis_c_text(parameter%description)) > 0, 'the description of ' // rotation)
    end do
    call check(n_found == 1, rotation // ' is there once')
    call check_refused(riis_valve_get_parameter(valve, n_parameters, parameter, c_sizeof(parameter)), &
      RIIS_INVALID_ARGUMENT, 'parameter_id')
    call check_refused(riis_valve_get_parameter(valve, 0_c_int64_t, parameter, 8_c_int64_t), RIIS_INVALID_STRUCT_SIZE, &
      'struct size')

    ! Surfaces of the default valve, before the valve is changed.
    call check_ok(riis_surface_create(valve, surface=surface), 'create a surface with default options')
    call check_area(6.986d0, 0.02d0)

    call check_ok(riis_valve_set_scalar(valve, riis_c_string('root_radius'), 1.3d0), 'set a scalar')
    call check_ok(riis_valve_set(valve, riis_c_string(rotation), 3_c_int64_t, [0d0, 0d0, 120d0]), 'set a vector')
    call check_ok(riis_valve_set(valve, riis_c_string('translation'), 3_c_int64_t, [0.1d0, 0d0, -1d0]), &
      'set a vector for all cusps')
    values = 0
    call check_ok(riis_valve_get(valve, riis_c_string(rotation), 3_c_int64_t, values), 'get a vector')
    call check(all(nint(values) == [0, 0, 120]), 'the vector that was set')
    call check_ok(riis_valve_get(valve, riis_c_string('root_radius'), 1_c_int64_t, scalar), 'get a scalar')
    call check(transfer(scalar(1), 0_c_int64_t) == transfer(1.3d0, 0_c_int64_t), 'the scalar that was set')

    is_set = 7
    call check_ok(riis_valve_is_set(valve, riis_c_string('annulus'), is_set), 'ask whether a parameter is set')
    call check(is_set == 1, 'annulus is root_radius, which was set')
    call check_ok(riis_valve_set_scalar(valve, riis_c_string('right.stj'), 2.5d0), 'set a scalar by its second name')
    call check_ok(riis_valve_unset(valve, riis_c_string('right.leaflet_radius_out')), 'unset a scalar')
    call check_ok(riis_valve_is_set(valve, riis_c_string('right.stj'), is_set), 'ask again')
    call check(is_set == 0, 'a parameter that was unset')
    call check_refused(riis_valve_unset(valve, riis_c_string('root_radios')), RIIS_INVALID_PARAMETER, 'root_radios')
    call check_refused(riis_valve_is_set(valve, riis_c_string('stj'), is_set), RIIS_INVALID_PARAMETER, 'right.stj')
    call check_refused(riis_valve_is_set(c_null_ptr, riis_c_string('stj'), is_set), RIIS_INVALID_ARGUMENT, 'valve')

    call check_refused(riis_valve_set_scalar(valve, riis_c_string('root_radios'), 1d0), RIIS_INVALID_PARAMETER, &
      'root_radios')
    call check_refused(riis_valve_set(valve, riis_c_string(rotation), 2_c_int64_t, values), RIIS_INVALID_PARAMETER, &
      rotation)
    call check_refused(riis_valve_get(valve, riis_c_string('translation'), 3_c_int64_t, values), &
      RIIS_INVALID_PARAMETER, 'translation')
    call check_refused(riis_valve_get_n_parameters(c_null_ptr, n_parameters), RIIS_INVALID_ARGUMENT, 'valve')
  end subroutine test_valve

  subroutine check_area(expected, tolerance)
    real(c_double), intent(in) :: expected, tolerance
    type(riis_surface_info) :: info
    call check_ok(riis_surface_get_info(surface, info, c_sizeof(info)), 'describe a surface')
    call check(abs(info%area - expected) < tolerance, 'the area of the surface')
  end subroutine check_area

  subroutine test_surface()
    type(riis_surface_options) :: options
    type(c_ptr) :: other = c_null_ptr, leaflet_id = c_null_ptr
    integer(c_int64_t) :: n, n_triangles
    integer(c_int32_t), pointer :: leaflets(:)

    call check_refused(riis_surface_options_init(options, 12_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    call check_ok(riis_surface_options_init(options, c_sizeof(options)), 'default surface options')
    call check(options%struct_size == c_sizeof(options) .and. nint(options%scale) == 1 .and. &
      all(nint(options%rotation_axis) == [0, 0, 1]) .and. options%zero_area == RIIS_ZERO_AREA_REFUSE .and. &
      options%measure == RIIS_MEASURE_TRIANGLES .and. abs(options%measure_tolerance - RIIS_AUTO) <= 0, &
      'the defaults of the surface options')
    options%half_thickness = 1.1d0
    options%tolerance = 0.1d0
    options%scale = 10
    options%rotation_axis = [1, 2, 3]
    options%rotation_angle = 25
    options%translation = [1, -2, 3]
    call check_ok(riis_surface_update(surface, valve, options), 'update a surface')

    call check_same_surface(surface, twin%aortic, 'the aortic valve')
    call check_ok(triangles_from(surface, n_triangles=n_triangles, leaflet_id=leaflet_id), 'leaflet ids alone')
    call check(n_triangles == twin%aortic%info%n_triangles, 'the number of triangles')
    call c_f_pointer(leaflet_id, leaflets, [n_triangles])
    call check(minval(leaflets) == RIIS_LEAFLET_RIGHT .and. maxval(leaflets) == RIIS_LEAFLET_NON_CORONARY .and. &
      any(leaflets == RIIS_LEAFLET_LEFT), 'three leaflets')
    n = -1
    call check_ok(triangles_from(surface, n_triangles=n), 'the number of triangles alone')
    call check(n == n_triangles, 'the number of triangles alone')

    options%measure = 3
    call check_refused(riis_surface_create(valve, options, other), RIIS_INVALID_ARGUMENT, 'options.measure is 3')
    options%measure = RIIS_MEASURE_TRIANGLES
    options%tolerance = 2
    call check_refused(riis_surface_create(valve, options, other), RIIS_INVALID_ARGUMENT, 'tolerance')
    options%struct_size = 12
    call check_refused(riis_surface_update(surface, valve, options), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    call check_ok(riis_valve_set_scalar(valve, riis_c_string('bending_height'), 3d0), 'a bad height is found later')
    call check_refused(riis_surface_create(valve, surface=other), RIIS_INVALID_PARAMETER, 'bending_height')
    call check(.not. c_associated(other), 'no surface is made by calls that are refused')
    call check_refused(riis_surface_update(surface, valve), RIIS_INVALID_PARAMETER, 'bending_height')
    call check_ok(triangles_from(surface, n_triangles=n), 'triangles')
    call check(n == n_triangles, 'a surface stays as it was when its update is refused')
  end subroutine test_surface

  subroutine check_same_surface(made, from_c, what)
    type(c_ptr), intent(in) :: made
    type(twin_surface), target, intent(in) :: from_c
    character(len=*), intent(in) :: what
    type(riis_surface_info), target :: info
    type(c_ptr) :: vertices, parameters, vertex_id, triangle_id, leaflet_id, patch_id
    integer(c_int64_t) :: n_vertices, n_parameters, n_triangles

    call check_ok(riis_surface_get_info(made, info, c_sizeof(info)), what // ': describe a surface')
    ! Only the bytes before the times are compared, because times differ.
    call check_same_bytes(c_loc(info), c_loc(from_c%info), 88_c_int64_t, what // ': description')
    call check(info%seconds_triangles > 0 .and. info%seconds_scene > 0, what // ': a surface takes time')
    call check_ok(triangles_from(made, n_vertices=n_vertices, xyz=vertices), what // ': vertices')
    call check(n_vertices == info%n_vertices, what // ': the number of vertices')
    call check_same_bytes(vertices, from_c%triangles%xyz, 24 * n_vertices, what // ': vertices')
    call check_ok(triangles_from(made, n_vertices=n_parameters, uv=parameters), what // ': vertex parameters')
    call check(n_parameters == n_vertices, what // ': the number of vertex parameters')
    call check_same_bytes(parameters, from_c%triangles%uv, 16 * n_vertices, what // ': vertex parameters')
    call check_ok(triangles_from(made, n_triangles=n_triangles, vertex_id=vertex_id, triangle_id=triangle_id, &
      leaflet_id=leaflet_id, patch_id=patch_id), &
      what // ': triangles')
    call check(n_triangles == info%n_triangles, what // ': the number of triangles')
    call check_same_bytes(vertex_id, from_c%triangles%vertex_id, 24 * n_triangles, what // ': vertex ids')
    call check_same_bytes(triangle_id, from_c%triangles%triangle_id, 8 * n_triangles, what // ': triangle ids')
    call check_same_bytes(leaflet_id, from_c%triangles%leaflet_id, 4 * n_triangles, what // ': leaflet ids')
    call check_same_bytes(patch_id, from_c%triangles%patch_id, 4 * n_triangles, what // ': patch ids')
  end subroutine check_same_surface

  subroutine test_mitral_valve()
    type(c_ptr) :: mitral = c_null_ptr, made = c_null_ptr, leaflet_id = c_null_ptr
    integer(c_int64_t) :: n_triangles
    integer(c_int32_t), pointer :: leaflets(:)
    call check_ok(riis_valve_create(riis_c_string('mitral'), mitral), 'create a mitral valve')
    call check_refused(riis_valve_set_scalar(mitral, riis_c_string('opening'), 1.5d0), RIIS_INVALID_PARAMETER, &
      'opening')
    call check_ok(riis_valve_set_scalar(mitral, riis_c_string('opening'), 0.5d0), 'open it half')
    call check_ok(riis_surface_create(mitral, surface=made), 'create its surface')
    call check_same_surface(made, twin%mitral, 'the mitral valve')
    call check_ok(triangles_from(made, n_triangles=n_triangles, leaflet_id=leaflet_id), 'leaflet ids alone')
    call c_f_pointer(leaflet_id, leaflets, [n_triangles])
    call check(minval(leaflets) == RIIS_LEAFLET_ANTERIOR .and. maxval(leaflets) == RIIS_LEAFLET_POSTERIOR, &
      'two leaflets')
    call riis_surface_destroy(made)
    call riis_valve_destroy(mitral)
  end subroutine test_mitral_valve

  subroutine test_open_state()
    type(c_ptr) :: closed = c_null_ptr, open = c_null_ptr, mitral = c_null_ptr, made = c_null_ptr
    call check_ok(riis_valve_create(riis_c_string('aortic'), closed), 'create a valve')
    call check_ok(riis_valve_create(riis_c_string('aortic'), open), 'create its open state')
    call check_ok(riis_valve_create(riis_c_string('mitral'), mitral), 'create another kind of valve')
    call check_ok(riis_valve_set_scalar(open, riis_c_string('leaflet_radius_in'), 1.1d0), 'change the open state')
    call check_refused(riis_valve_set_open_state(closed, mitral), RIIS_INVALID_PARAMETER, 'mitral')
    call check_refused(riis_valve_set_open_state(closed, c_null_ptr), RIIS_INVALID_ARGUMENT, 'open')
    call check_ok(riis_valve_set_open_state(closed, open), 'set the open state')
    call riis_valve_destroy(open)
    call riis_valve_destroy(mitral)
    call check_ok(riis_valve_set_scalar(closed, riis_c_string('opening'), 0.3d0), 'open it')
    call check_ok(riis_surface_create(closed, surface=made), 'create its surface')
    call check_same_surface(made, twin%opening, 'the opening aortic valve')
    call riis_surface_destroy(made)
    call riis_valve_destroy(closed)
  end subroutine test_open_state

  subroutine test_valve_from_patches()
    integer(c_int32_t), target :: degree(7), curve_id(4, 2), reversed(4, 2), leaflet_id(2)
    real(c_double), target :: control(3, 18)
    type(riis_patches) :: patches
    type(c_ptr) :: given = c_null_ptr, made = c_null_ptr

    degree = [2, 1, 1, 3, 2, 1, 1]
    control = reshape([-8, -8, 0, -4, -8, 4, 0, -8, 2, -8, 8, 0, 0, 8, 2, -8, -8, 0, -8, 8, 0, 0, -8, 2, 1, -3, 1, &
      -1, 3, 1, 0, 8, 2, 0, -8, 2, 4, -8, 4, 8, -8, 0, 0, 8, 2, 8, 8, 0, 8, 8, 0, 8, -8, 0], [3, 18])
    curve_id = reshape([1, 2, 3, 4, 5, 6, 4, 7], [4, 2])
    reversed = 0
    reversed(4, 2) = 1
    leaflet_id = [1, 7]
    call check_refused(riis_patches_init(patches, 64_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    call check_ok(riis_patches_init(patches, c_sizeof(patches)), 'default patches')
    call check(patches%struct_size == c_sizeof(patches) .and. patches%n_curves == 0 .and. &
      patches%index_base == 0 .and. .not. c_associated(patches%reversed), 'the defaults of the patches')
    patches%n_curves = size(degree)
    patches%degree = c_loc(degree)
    patches%control = c_loc(control)
    patches%n_patches = size(leaflet_id)
    patches%curve_id = c_loc(curve_id)
    patches%leaflet_id = c_loc(leaflet_id)
    patches%index_base = 1
    call check_refused(riis_valve_create_from_patches(patches, given), RIIS_INVALID_PARAMETER, 'patch 1 does not close')
    call check(.not. c_associated(given), 'no valve is made by a call that is refused')
    patches%reversed = c_loc(reversed)
    call check_ok(riis_valve_create_from_patches(patches, given), 'create a valve from patches')
    call check_ok(riis_surface_create(given, surface=made), 'create its surface')
    call check_same_surface(made, twin%patches, 'the valve from patches')
    call riis_surface_destroy(made)
    call riis_valve_destroy(given)
  end subroutine test_valve_from_patches

  subroutine test_surface_from_arrays()
    real(c_double), target :: x(6), y(6), z(6)
    integer(c_int64_t), target :: quads(4, 2)
    integer(c_int32_t), target :: triangles(3, 3), leaflet_id(3)
    type(riis_surface_arrays) :: arrays
    type(riis_surface_options) :: options
    type(riis_surface_info) :: info
    type(captured), target :: log
    type(c_ptr) :: other = c_null_ptr, parameters
    integer(c_int32_t) :: n_before

    x = [-9, 0, 9, -9, 0, 9]
    y = [-9, -9, -9, 9, 9, 9]
    z = [0d0, 0.5d0, 0d0, 0d0, 0.5d0, 0d0]
    quads = reshape([1, 2, 5, 4, 2, 3, 6, 5], [4, 2])
    triangles = reshape([0, 1, 4, 1, 1, 2, 2, 5, 4], [3, 3])
    leaflet_id = [3, 4, 5]
    call check_refused(riis_surface_arrays_init(arrays, 0_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    call check_ok(riis_surface_arrays_init(arrays, c_sizeof(arrays)), 'default surface arrays')
    call check(arrays%struct_size == c_sizeof(arrays) .and. arrays%stride == 1 .and. arrays%id_bits == 32 .and. &
      arrays%corners_per_face == 3 .and. .not. c_associated(arrays%x), 'the defaults of the surface arrays')
    arrays%n_vertices = 6
    arrays%x = c_loc(x)
    arrays%y = c_loc(y)
    arrays%z = c_loc(z)
    arrays%n_faces = 2
    arrays%vertex_ids = c_loc(quads)
    arrays%id_bits = 64
    arrays%index_base = 1
    arrays%corners_per_face = 4
    call check_ok(riis_surface_create_from_arrays(arrays, surface=plate), 'create a surface from quads')
    call check_ok(riis_surface_get_info(plate, info, c_sizeof(info)), 'describe the plate')
    call check(info%n_triangles == 4 .and. info%n_zero_area == 0, 'two quads are four triangles')
    parameters = c_loc(x)
    call check_ok(triangles_from(plate, uv=parameters), 'vertex parameters of a surface from arrays')
    call check(.not. c_associated(parameters), 'a surface from arrays has no vertex parameters')

    arrays%n_faces = 3
    arrays%vertex_ids = c_loc(triangles)
    arrays%id_bits = 32
    arrays%index_base = 0
    arrays%corners_per_face = 3
    arrays%leaflet_id = c_loc(leaflet_id)
    call check_ok(riis_surface_options_init(options, c_sizeof(options)), 'default surface options')
    call check_refused(riis_surface_update_from_arrays(plate, arrays, options), RIIS_INVALID_SURFACE, 'face 1')

    options%zero_area = RIIS_ZERO_AREA_SKIP
    options%flip_normals = 1
    log = captured(0, 0)
    call riis_set_log(c_funloc(capture), c_loc(log))
    call check_ok(riis_surface_update_from_arrays(plate, arrays, options), 'update a surface from triangles')
    call riis_set_log(c_null_funptr, c_null_ptr)
    call check(log%n_warnings == 1 .and. index(last_warning, 'zero area') > 0, 'a warning of the skipped triangle')
    call check(log%n_messages > log%n_warnings, 'information is also logged')
    n_before = log%n_messages
    call check_ok(riis_surface_update_from_arrays(plate, arrays), 'update with the options that the surface has')
    call check(log%n_messages == n_before, 'silence after the log function is taken away')
    call check_ok(riis_surface_get_info(plate, info, c_sizeof(info)), 'describe the plate')
    call check(info%n_triangles == 2 .and. info%n_zero_area == 1, 'one of three triangles has no area')

    triangles(3, 3) = 6
    call check_refused(riis_surface_create_from_arrays(arrays, options, other), RIIS_INVALID_SURFACE, 'face 2')
    arrays%n_faces = 2_c_int64_t**40
    call check_refused(riis_surface_create_from_arrays(arrays, options, other), RIIS_LIMIT_EXCEEDED, 'n_faces')
    call check(.not. c_associated(other), 'no surface is made by calls that are refused')
  end subroutine test_surface_from_arrays

  subroutine test_closest_points()
    type(riis_closest), target :: closest
    type(riis_closest_options) :: options
    type(riis_closest_arrays) :: arrays
    type(riis_points) :: points
    real(c_double), target, allocatable :: distance(:), point(:, :), barycentric(:, :), normal(:, :)
    integer(c_int64_t), target, allocatable :: triangle_id(:)
    integer(c_int32_t), target, allocatable :: leaflet_id(:), side(:)

    call check_ok(riis_closest_point(surface, xyz(:, 1), closest, c_sizeof(closest)), 'one closest point')
    call check_same_bytes(c_loc(closest), c_loc(twin%closest), int(c_sizeof(closest), c_int64_t), 'one closest point')
    call check(closest%distance > 0 .and. abs(closest%distance - norm2(closest%point - xyz(:, 1))) < 1d-12, &
      'a distance is that to the closest point')
    call check_refused(riis_closest_point(surface, xyz(:, 1), closest, 1_c_int64_t), RIIS_INVALID_STRUCT_SIZE, &
      'struct size')

    allocate (distance(n_nodes), point(3, n_nodes), barycentric(3, n_nodes), normal(3, n_nodes))
    allocate (triangle_id(n_nodes), leaflet_id(n_nodes), side(n_nodes))
    call check_ok(riis_closest_arrays_init(arrays, c_sizeof(arrays)), 'default closest arrays')
    call check(arrays%struct_size == c_sizeof(arrays) .and. .not. c_associated(arrays%side), &
      'the defaults of the closest arrays')
    arrays%distance = c_loc(distance)
    arrays%point = c_loc(point)
    arrays%barycentric = c_loc(barycentric)
    arrays%normal = c_loc(normal)
    arrays%triangle_id = c_loc(triangle_id)
    arrays%leaflet_id = c_loc(leaflet_id)
    arrays%side = c_loc(side)
    call check_ok(riis_closest_options_init(options, c_sizeof(options)), 'default closest options')
    call check(options%struct_size == c_sizeof(options) .and. options%far_distance > 9d29 .and. &
      options%distance_limit > huge(1d0), 'the defaults of the closest options')
    options%distance_limit = 12
    options%far_distance = -1
    options%n_threads = 2
    call check_ok(riis_points_init(points, c_sizeof(points)), 'default points')
    call check(points%real_bits == 64 .and. points%stride == 1, 'points are doubles')
    points%n_points = n_nodes
    points%x = c_loc(xyz(1, 1))
    points%y = c_loc(xyz(2, 1))
    points%z = c_loc(xyz(3, 1))
    points%stride = 3
    call check_ok(riis_closest_points(plate, points, options, arrays), &
      'closest points')
    call check_same_bytes(c_loc(distance), twin%all%distance, 8 * n_nodes, 'distances')
    call check_same_bytes(c_loc(point), twin%all%point, 24 * n_nodes, 'points')
    call check_same_bytes(c_loc(barycentric), twin%all%barycentric, 24 * n_nodes, 'barycentric coordinates')
    call check_same_bytes(c_loc(normal), twin%all%normal, 24 * n_nodes, 'normals')
    call check_same_bytes(c_loc(triangle_id), twin%all%triangle_id, 8 * n_nodes, 'triangle ids')
    call check_same_bytes(c_loc(leaflet_id), twin%all%leaflet_id, 4 * n_nodes, 'leaflet ids')
    call check_same_bytes(c_loc(side), twin%all%side, 4 * n_nodes, 'sides')
    call check(minval(triangle_id) == -1 .and. any(triangle_id == 0) .and. maxval(triangle_id) == 2, &
      'the triangles of the plate, and none far away')
    call check(any(side == 1) .and. any(side == -1) .and. any(leaflet_id == 3) .and. any(leaflet_id == 5) .and. &
      .not. any(leaflet_id == 4), 'both sides and both leaflets of the plate')

    options%far_distance = 3
    call check_refused(riis_closest_points(plate, points, options, arrays), RIIS_INVALID_ARGUMENT, 'far_distance')
    points%stride = 0
    call check_refused(riis_closest_points(plate, points, arrays=arrays), RIIS_INVALID_ARGUMENT, 'stride')
  end subroutine test_closest_points

  subroutine test_marking()
    type(riis_mark_options) :: options
    type(riis_mark_stats), target :: stats
    integer(c_int8_t), target :: node_mask(n_nodes)
    integer(c_int8_t), target, allocatable :: mark(:)
    real(c_double), target, allocatable :: distance(:)
    integer(c_int64_t), target, allocatable :: triangle_id(:)
    integer(c_int32_t), target, allocatable :: leaflet_id(:)
    type(riis_mark_list) :: list
    type(c_ptr) :: other = c_null_ptr
    integer(c_int64_t) :: n_default, n
    integer(c_int64_t), pointer :: ids(:)
    real(c_double), pointer :: distances(:)
    real(c_double), target :: bad(3)

    call check_ok(riis_mesh_create(1_c_int64_t, c_loc(xyz(1, 1)), c_loc(xyz(2, 1)), c_loc(xyz(3, 1)), 3_c_int64_t, &
      mesh), 'create a mesh')
    call check_ok(riis_mesh_update(mesh, n_nodes, c_loc(xyz(1, 1)), c_loc(xyz(2, 1)), c_loc(xyz(3, 1)), 3_c_int64_t), &
      'update a mesh')
    call check_ok(riis_mesh_prepare(mesh, 2), 'prepare a mesh')
    call check_refused(riis_mesh_prepare(mesh, -1), RIIS_INVALID_ARGUMENT, 'n_threads is -1')
    call check_ok(riis_marks_create(result), 'create a result')
    call check_ok(riis_marks_get_list(result, RIIS_LIST_MARKED, list, c_sizeof(list)), 'the marked nodes of new marks')
    call check(list%n_nodes == 0, 'a new result has no marked nodes')
    call check_ok(riis_mark_nodes(surface, mesh, marks=result), 'mark with default options')
    call check_ok(riis_marks_get_list(result, RIIS_LIST_MARKED, list, c_sizeof(list)), 'the marked nodes')
    n_default = list%n_nodes
    call check(n_default > 0 .and. n_default < n_nodes, 'some nodes are marked')

    do n = 1, n_nodes
      node_mask(n) = merge(0_c_int8_t, 1_c_int8_t, mod(n - 1, 7_c_int64_t) == 0)
    end do
    call check_refused(riis_mark_options_init(options, 4_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    call check_ok(riis_mark_options_init(options, c_sizeof(options)), 'default mark options')
    call check(options%struct_size == c_sizeof(options) .and. options%search == RIIS_SEARCH_AUTO .and. &
      .not. c_associated(options%node_mask), 'the defaults of the mark options')
    options%distance_limit = 2.5d0
    options%node_mask = c_loc(node_mask)
    options%search = RIIS_SEARCH_EXHAUSTIVE
    options%n_threads = 2
    call check_ok(riis_mark_nodes(surface, mesh, options, result), 'mark')

    call check_ok(riis_marks_get_list(result, RIIS_LIST_MARKED, list, c_sizeof(list)), 'the marked nodes')
    call check_same_list(list, twin%marked, 'marked')
    call check(list%n_nodes > 0 .and. list%n_nodes < n_default, 'the mask leaves marked nodes out')
    call c_f_pointer(list%node_id, ids, [list%n_nodes])
    call c_f_pointer(list%distance, distances, [list%n_nodes])
    call check(all(ids(2:) > ids(:list%n_nodes - 1)) .and. all(mod(ids, 7_c_int64_t) /= 0), 'ascending ids, from 0, unmasked')
    call check(maxval(distances) <= 1.1d0, 'marked nodes are within the half thickness')

    call check_ok(riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list)), 'the nodes within the limit')
    call check_same_list(list, twin%within_limit, 'within the limit')
    call check(list%n_nodes > twin%marked%n_nodes, 'more nodes are within the limit')

    allocate (mark(n_nodes), distance(n_nodes), triangle_id(n_nodes), leaflet_id(n_nodes))
    call check_ok(write_dense(result, n_nodes, RIIS_FAR_DISTANCE, mark, distance, triangle_id, leaflet_id), &
      'dense arrays')
    call check_same_bytes(c_loc(mark), twin%dense_mark, n_nodes, 'dense marks')
    call check_same_bytes(c_loc(distance), twin%dense_distance, 8 * n_nodes, 'dense distances')
    call check_same_bytes(c_loc(triangle_id), twin%dense_triangle_id, 8 * n_nodes, 'dense triangle ids')
    call check_same_bytes(c_loc(leaflet_id), twin%dense_leaflet_id, 4 * n_nodes, 'dense leaflet ids')
    call check(sum(int(mark, c_int64_t)) == twin%marked%n_nodes, 'as many dense marks as marked nodes')
    leaflet_id = -2
    call check_ok(write_dense(result, n_nodes, -1d0, leaflet_id=leaflet_id), 'one dense array alone')
    call check_same_bytes(c_loc(leaflet_id), twin%dense_leaflet_id, 4 * n_nodes, 'dense leaflet ids alone')

    call check_ok(riis_marks_get_stats(result, stats, c_sizeof(stats)), 'statistics')
    call check_same_bytes(c_loc(stats), c_loc(twin%stats), 32_c_int64_t, 'statistics')
    call check(stats%n_nodes == n_nodes .and. stats%n_marked == twin%marked%n_nodes .and. &
      stats%n_within_limit == list%n_nodes .and. stats%n_queries >= list%n_nodes .and. stats%seconds > 0 .and. &
      stats%search == RIIS_SEARCH_EXHAUSTIVE .and. stats%complete == 1, 'the statistics of the marking')
    call check(stats%n_threads == twin%stats%n_threads, 'as many threads as from C')

    call check_refused(write_dense(result, n_nodes - 1, -1d0, mark), RIIS_INVALID_ARGUMENT, 'n_nodes')
    options%distance_limit = 1
    call check_refused(riis_mark_nodes(surface, mesh, options, result), RIIS_INVALID_ARGUMENT, 'distance_limit')
    call check_refused(riis_mark_nodes(surface, c_null_ptr, marks=result), RIIS_INVALID_ARGUMENT, 'mesh')
    call check_refused(riis_marks_get_stats(result, stats, 8_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    bad = [0d0, 1d300, 0d0]
    call check_refused(riis_mesh_create(1_c_int64_t, c_loc(bad(1)), c_loc(bad(2)), c_loc(bad(3)), 3_c_int64_t, other), &
      RIIS_INVALID_MESH, '1e+300')
    call check(.not. c_associated(other), 'no mesh is made by a call that is refused')
    call check_refused(riis_mesh_update(mesh, -1_c_int64_t, c_loc(bad(1)), c_loc(bad(2)), c_loc(bad(3)), 3_c_int64_t), &
      RIIS_INVALID_MESH, 'n_nodes')
    call check_ok(riis_mesh_create(0_c_int64_t, c_null_ptr, c_null_ptr, c_null_ptr, 3_c_int64_t, other), 'no nodes')
    call check_ok(riis_mark_nodes(surface, other, marks=result), 'mark no nodes')
    call check_ok(riis_marks_get_list(result, RIIS_LIST_MARKED, list, c_sizeof(list)), 'the marked nodes of none')
    call check(list%n_nodes == 0, 'none of no nodes is marked')
    call riis_mesh_destroy(other)
    call check_ok(riis_mesh_update(mesh, n_nodes, c_loc(xyz(1, 1)), c_loc(xyz(2, 1)), c_loc(xyz(3, 1)), 3_c_int64_t), &
      'the nodes are back')
  end subroutine test_marking

  subroutine check_same_list(a, b, what)
    type(riis_mark_list), intent(in) :: a, b
    character(len=*), intent(in) :: what
    call check(a%n_nodes == b%n_nodes, what // ': as many nodes as from C')
    call check_same_bytes(a%node_id, b%node_id, 8 * min(a%n_nodes, b%n_nodes), what // ': node ids')
    call check_same_bytes(a%distance, b%distance, 8 * min(a%n_nodes, b%n_nodes), what // ': distances')
    call check_same_bytes(a%triangle_id, b%triangle_id, 8 * min(a%n_nodes, b%n_nodes), what // ': triangle ids')
    call check_same_bytes(a%leaflet_id, b%leaflet_id, 4 * min(a%n_nodes, b%n_nodes), what // ': leaflet ids')
  end subroutine check_same_list

  ! A valve that opens, marked with all fields and the resistance.
  subroutine test_motion()
    type(c_ptr) :: before, now, open, moving, resisting, velocity
    type(riis_surface_options) :: options, options_before
    type(riis_mark_options) :: mark_options
    type(riis_mark_list) :: marked, within
    type(riis_resistance) :: resistance
    type(riis_band_sums), target :: sums
    type(riis_resistance), target :: listed
    real(c_double), target, allocatable :: coefficient(:), momentum(:, :)
    real(c_double), target :: force(30)
    type(riis_gap) :: gap
    type(riis_coaptation) :: contact
    type(riis_attachment) :: attachment
    type(riis_direction) :: direction
    type(riis_reaction) :: reaction
    integer :: i
    integer(c_int64_t) :: n

    before = c_null_ptr
    now = c_null_ptr
    open = c_null_ptr
    moving = c_null_ptr
    resisting = c_null_ptr
    call check_ok(riis_valve_create(riis_c_string('aortic'), before), 'create a valve')
    call check_ok(riis_valve_create(riis_c_string('aortic'), open), 'create its open state')
    call check_ok(riis_valve_set_scalar(open, riis_c_string('leaflet_radius_in'), 1.1d0), 'change the open state')
    call check_ok(riis_valve_set_open_state(before, open), 'set the open state')
    call check_refused(riis_valve_copy(c_null_ptr, now), RIIS_INVALID_ARGUMENT, 'valve')
    call check_ok(riis_valve_copy(before, now), 'copy a valve')
    call check_ok(riis_valve_set_scalar(before, riis_c_string('opening'), 0.3d0), 'open it')
    call check_ok(riis_valve_set_scalar(now, riis_c_string('opening'), 0.4d0), 'open the copy further')
    call check_ok(riis_surface_options_init(options, c_sizeof(options)), 'default surface options')
    options%scale = 10
    options_before = options
    options_before%translation(3) = -0.01d0
    call check_ok(riis_surface_create(before, options_before, moving), 'create a surface')
    velocity = c_loc(force)
    call check_ok(triangles_from(moving, velocity=velocity), 'vertex velocities of a surface at rest')
    call check(.not. c_associated(velocity), 'a surface that was not updated so has no velocity')
    call check_refused(riis_surface_update_moving(moving, now, before, 0d0), RIIS_INVALID_ARGUMENT, 'dt is 0')
    call check_refused(riis_surface_update_moving(moving, now, c_null_ptr, 1d0), RIIS_INVALID_ARGUMENT, 'valve_before')
    call check_ok(riis_surface_update_moving(moving, now, before, 0.005d0, options, options_before), 'update a moving surface')
    call check_refused(riis_surface_add_direction(moving, now, before, 0d0), RIIS_INVALID_ARGUMENT, 'dp is 0')
    call check_ok(riis_surface_add_direction(moving, now, before, 0.1d0), 'the direction of the opening')
    call check_ok(riis_surface_add_direction(moving, now, now, 0.01d0, options, options_before), 'that of the translation')
    call riis_valve_destroy(open)
    call riis_valve_destroy(now)
    call riis_valve_destroy(before)
    call check_same_surface(moving, twin%motion%surface, 'the moving valve')
    call check_ok(triangles_from(moving, n_vertices=n, velocity=velocity), 'vertex velocities')
    call check(n == twin%motion%surface%info%n_vertices, 'the number of vertex velocities')
    call check_same_bytes(velocity, twin%motion%surface%triangles%velocity, 24 * n, 'vertex velocities')
    call check_refused(riis_surface_get_direction(moving, 2_c_int64_t, direction, c_sizeof(direction)), RIIS_INVALID_ARGUMENT, &
      'direction_id is 2')
    call check_ok(riis_surface_get_direction(moving, 1_c_int64_t, direction, c_sizeof(direction)), 'the second direction')
    call check(abs(direction%area_rate - twin%motion%direction%area_rate) <= 0, 'the rate of the area')
    call check(direction%n_vertices == n .and. twin%motion%direction%n_vertices == n, 'the number of rates')
    call check_same_bytes(direction%rate, twin%motion%direction%rate, 24 * n, 'the rates of vertices')

    call check_ok(riis_marks_create(resisting), 'create a result')
    call check_ok(riis_mark_options_init(mark_options, c_sizeof(mark_options)), 'default mark options')
    mark_options%distance_limit = 2.5d0
    mark_options%n_threads = 2
    call check_ok(riis_resistance_init(listed, c_sizeof(listed)), 'a resistance for the lists')
    mark_options%resistance = c_loc(listed)
    call check_refused(riis_mark_nodes(moving, mesh, mark_options, resisting), RIIS_INVALID_ARGUMENT, &
      'options.resistance.R is nan')
    listed%R = 3
    mark_options%fields = 512
    call check_refused(riis_mark_nodes(moving, mesh, mark_options, resisting), RIIS_INVALID_ARGUMENT, 'fields is 512')
    mark_options%fields = RIIS_FIELD_POINT + RIIS_FIELD_NORMAL + RIIS_FIELD_BARYCENTRIC + RIIS_FIELD_SIDE + &
      RIIS_FIELD_RIM + RIIS_FIELD_UV + RIIS_FIELD_VELOCITY + RIIS_FIELD_PATCH + RIIS_FIELD_GRADIENT
    call check_ok(riis_mark_nodes(moving, mesh, mark_options, resisting), 'mark with all fields')
    call check_refused(riis_marks_get_list(resisting, RIIS_LIST_MARKED, marked, 8_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'list')
    call check_refused(riis_marks_get_list(resisting, 7, marked, c_sizeof(marked)), RIIS_INVALID_ARGUMENT, 'which is 7')
    call check_ok(riis_marks_get_list(resisting, RIIS_LIST_MARKED, marked, c_sizeof(marked)), 'fields of the marked nodes')
    call check_same_fields(marked, twin%motion%marked, 'marked')
    call check_ok(riis_marks_get_list(resisting, RIIS_LIST_WITHIN_LIMIT, within, c_sizeof(within)), 'fields within the limit')
    call check_same_fields(within, twin%motion%within_limit, 'within the limit')

    call check_refused(riis_resistance_init(resistance, 8_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'resistance')
    call check_ok(riis_resistance_init(resistance, c_sizeof(resistance)), 'the default resistance')
    allocate (coefficient(n_nodes), momentum(3, n_nodes))
    coefficient = 0.25d0
    momentum = -1
    call check_refused(add_resistance_to(resisting, resistance, n_nodes, coefficient), &
      RIIS_INVALID_ARGUMENT, 'resistance.R is nan')
    resistance%R = 7
    resistance%half_thickness = 2
    resistance%rim = RIIS_RIM_CUT
    call check_refused(add_resistance_to(resisting, resistance, n_nodes - 1, coefficient), &
      RIIS_INVALID_ARGUMENT, 'n_nodes is 7999')
    call check_ok(add_resistance_to(resisting, resistance, n_nodes, coefficient, momentum), 'add resistance')
    call check_same_bytes(c_loc(coefficient), twin%motion%coefficient, 8 * n_nodes, 'resistance')
    call check_same_bytes(c_loc(momentum), twin%motion%momentum, 24 * n_nodes, 'resistance times velocity')
    call check(any(coefficient > 0.25d0) .and. any(momentum > -1), 'there is resistance')
    force = [(i, i = 0, 29)]
    call check_refused(riis_surface_get_gap(moving, moving, gap=gap, struct_size=8_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'gap')
    call check_ok(riis_surface_get_gap(moving, moving, gap=gap, struct_size=c_sizeof(gap)), 'the gap to itself')
    call check(gap%n_ends > 0 .and. gap%n_without_wall == 0 .and. abs(gap%most) < 1d-12, 'a surface without a gap to itself')
    call check_refused(riis_valve_set_skirt_to_wall(valve, moving, -1d0), RIIS_INVALID_ARGUMENT, 'longest is -1')
    call check_ok(riis_surface_get_coaptation(moving, RIIS_AUTO, RIIS_ALL_LEAFLETS, contact, c_sizeof(contact)), 'contact')
    call check(contact%reach > 0, 'the reach')
    call check_refused(riis_surface_get_attachment(moving, attachment, 8_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'attachment')
    call check_ok(riis_surface_get_attachment(moving, attachment, c_sizeof(attachment)), 'the attachment')
    call check_ok(riis_reaction_init(reaction, c_sizeof(reaction)), 'default reaction')
    reaction%about(2) = 0.5d0
    reaction%force = c_loc(force(1))
    reaction%moment = c_loc(force(4))
    reaction%n_leaflets = 1
    reaction%leaflet_force = c_loc(force(7))
    reaction%leaflet_moment = c_loc(force(16))
    reaction%n_edges = 1
    reaction%edges = attachment%edges
    reaction%edge_force = c_loc(force(25))
    reaction%edge_moment = c_loc(force(28))
    call check_refused(add_reaction_to(resisting, resistance, n_nodes, xyz, coefficient, reaction), RIIS_INVALID_ARGUMENT, &
      'n_leaflets is 1')
    reaction%n_leaflets = 3
    call check_ok(add_reaction_to(resisting, resistance, n_nodes, xyz, coefficient, reaction), 'add a reaction')
    call check_same_bytes(c_loc(force), c_loc(twin%motion%force), 240_c_int64_t, 'the reaction')
    call check_refused(band_sums_of(resisting, 0.5d0, 3d0, n_nodes, coefficient, coefficient, sums), &
      RIIS_INVALID_ARGUMENT, 'outer is 3')
    call check_ok(band_sums_of(resisting, 0.5d0, 2d0, n_nodes, coefficient, coefficient, sums), 'sums of a band')
    call check_same_bytes(c_loc(sums), c_loc(twin%motion%sums), int(c_sizeof(sums), c_int64_t), 'sums of a band')
    call check(all(sums%n_nodes > 100), 'both sides have nodes')
    call riis_marks_destroy(resisting)
    call riis_surface_destroy(moving)
  end subroutine test_motion

  subroutine check_same_fields(a, b, what)
    type(riis_mark_list), intent(in) :: a, b
    character(len=*), intent(in) :: what
    call check(a%n_nodes == b%n_nodes .and. a%n_nodes > 0, what // ': as many nodes as from C')
    call check_same_list(a, b, what)
    call check_same_bytes(a%K, b%K, 8 * a%n_nodes, what // ': K')
    call check_same_bytes(a%K_u_surface, b%K_u_surface, 24 * a%n_nodes, what // ': K u_surface')
    call check_same_bytes(a%point, b%point, 24 * a%n_nodes, what // ': points')
    call check_same_bytes(a%normal, b%normal, 24 * a%n_nodes, what // ': normals')
    call check_same_bytes(a%barycentric, b%barycentric, 24 * a%n_nodes, what // ': barycentric coordinates')
    call check_same_bytes(a%uv, b%uv, 16 * a%n_nodes, what // ': u and v')
    call check_same_bytes(a%velocity, b%velocity, 24 * a%n_nodes, what // ': velocities')
    call check_same_bytes(a%side, b%side, 4 * a%n_nodes, what // ': sides')
    call check_same_bytes(a%rim, b%rim, 4 * a%n_nodes, what // ': rims')
    call check_same_bytes(a%patch_id, b%patch_id, 4 * a%n_nodes, what // ': patches')
    call check(a%n_directions == 2 .and. b%n_directions == 2, what // ': two directions')
    call check_same_bytes(a%distance_gradient, b%distance_gradient, 16 * a%n_nodes, what // ': derivatives of distances')
    call check_same_bytes(a%K_gradient, b%K_gradient, 16 * a%n_nodes, what // ': derivatives of K')
  end subroutine check_same_fields

  ! A square is lifted by 1 and bent.
  subroutine test_keyframes()
    type(riis_surface_arrays) :: faces
    type(riis_keyframe_arrays) :: frames
    integer(c_int32_t), target :: quad(4)
    real(c_double), target :: time(2), vertices(3, 4, 2)
    type(c_ptr) :: keyframes, framed, velocity, parameters
    type(riis_surface_info), target :: info
    real(c_double), pointer :: velocities(:, :)
    integer(c_int64_t) :: n

    keyframes = c_null_ptr
    framed = c_null_ptr
    quad = [1, 2, 3, 4]
    time = [0d0, 0.5d0]
    vertices(:, :, 1) = reshape([0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 1d0, 1d0, 0d0, 0d0, 1d0, 0d0], [3, 4])
    vertices(:, :, 2) = vertices(:, :, 1)
    vertices(3, :, 2) = [1d0, 1d0, 1.25d0, 1d0]
    call check_ok(riis_surface_arrays_init(faces, c_sizeof(faces)), 'default surface arrays')
    faces%n_vertices = 4
    faces%n_faces = 1
    faces%vertex_ids = c_loc(quad)
    faces%corners_per_face = 4
    faces%index_base = 1
    call check_refused(riis_keyframe_arrays_init(frames, 8_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    call check_ok(riis_keyframe_arrays_init(frames, c_sizeof(frames)), 'default frames')
    call check_refused(riis_keyframes_create(faces, frames, keyframes), RIIS_INVALID_ARGUMENT, 'n_keys is 0')
    frames%n_keys = 2
    frames%n_vertices = 4
    frames%time = c_loc(time)
    frames%xyz = c_loc(vertices)
    call check_ok(riis_keyframes_create(faces, frames, keyframes), 'create keyframes')
    call check_ok(riis_surface_create_from_keyframes(keyframes, 0d0, 0d0, surface=framed), 'create a surface from them')
    call check_ok(riis_surface_update_from_keyframes(framed, keyframes, 0.25d0, 0.125d0), 'update it')
    call riis_keyframes_destroy(keyframes)
    call check(.not. c_associated(keyframes), 'destroyed keyframes are null')
    call check_ok(riis_surface_get_info(framed, info, c_sizeof(info)), 'describe the framed surface')
    call check_same_bytes(c_loc(info), c_loc(twin%motion%framed%info), 88_c_int64_t, 'the framed surface')
    call check_ok(triangles_from(framed, n_vertices=n, xyz=parameters), 'framed vertices')
    call check_same_bytes(parameters, twin%motion%framed%triangles%xyz, 24 * n, 'framed vertices')
    call check_ok(triangles_from(framed, n_vertices=n, velocity=velocity), 'framed velocities')
    call check_same_bytes(velocity, twin%motion%framed%triangles%velocity, 24 * n, 'framed velocities')
    call c_f_pointer(velocity, velocities, [3_c_int64_t, n])
    call check(n == 4 .and. all(abs(velocities(3, :) - [2d0, 2d0, 2.5d0, 2d0]) < 1d-14), 'lifted by 1 in half a unit of time')
    call riis_surface_destroy(framed)
  end subroutine test_keyframes

  subroutine test_landmarks()
    real(c_double), target :: xyz(3, 6)
    integer(c_int32_t), target :: role(6)
    real(c_double), target :: residual(6)
    real(c_double) :: radius(1)
    type(c_ptr) :: valve
    type(riis_landmarks) :: landmarks
    type(riis_placement) :: placement
    type(riis_placement_arrays) :: arrays
    integer :: i
    do i = 1, 6
      xyz(:, i) = [cos(i * acos(-1d0) / 3), sin(i * acos(-1d0) / 3), merge(1.2d0, 0d0, mod(i, 2) == 0)]
      role(i) = merge(RIIS_LANDMARK_COMMISSURE, RIIS_LANDMARK_NADIR, mod(i, 2) == 0)
    end do
    call check_ok(riis_landmarks_init(landmarks, c_sizeof(landmarks)), 'the default landmarks')
    call check_ok(riis_placement_arrays_init(arrays, c_sizeof(arrays)), 'no arrays')
    arrays%residual = c_loc(residual)
    landmarks%n_landmarks = 6
    landmarks%x = c_loc(xyz(1, 1))
    landmarks%y = c_loc(xyz(2, 1))
    landmarks%z = c_loc(xyz(3, 1))
    landmarks%stride = 3
    landmarks%role = c_loc(role)
    landmarks%scale = 1
    valve = c_null_ptr
    call check_ok(riis_valve_create(riis_c_string('trileaflet'), valve), 'a valve to place')
    call check_ok(riis_place(valve, landmarks, riis_c_string(''), arrays, placement=placement, &
      struct_size=c_sizeof(placement)), 'place a valve')
    call check_ok(riis_valve_get(valve, riis_c_string('root_radius'), 1_c_int64_t, radius), 'the radius')
    call check(abs(radius(1) - 1) < 1d-12 .and. all(residual < 1d-12) &
      .and. abs(placement%scale - 1) < 1d-15, 'a placed valve')
    role(2) = 77
    call check_refused(riis_place(valve, landmarks, riis_c_string(''), placement=placement, &
      struct_size=c_sizeof(placement)), RIIS_INVALID_ARGUMENT, 'landmarks.role of landmark 1 is 77')
    call riis_valve_destroy(valve)
  end subroutine test_landmarks

  ! A valve is widened, read out, and made again.
  subroutine test_warp()
    type(riis_points) :: points
    type(riis_warp_options) :: options
    type(riis_warp_info) :: warp_info
    type(riis_keyframe_arrays) :: frames
    type(riis_valve_patches) :: patches
    real(c_double), target :: sources(3, 6), targets(3, 6), time(1)
    real(c_double) :: mapped(3, 6)
    type(c_ptr) :: warp, valve
    integer(c_int32_t), pointer :: degrees(:)
    integer :: i

    warp = c_null_ptr
    valve = c_null_ptr
    sources = reshape([1d0, 0d0, 0d0, 0d0, 1d0, 0d0, -1d0, 0d0, 0d0, 0d0, -1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, -1d0], [3, 6])
    targets = sources
    targets(:2, :) = 1.25d0 * sources(:2, :)
    time = 0
    call check_ok(riis_points_init(points, c_sizeof(points)), 'default points')
    points%n_points = 6
    points%stride = 3
    points%x = c_loc(sources(1, 1))
    points%y = c_loc(sources(2, 1))
    points%z = c_loc(sources(3, 1))
    call check_refused(riis_warp_options_init(options, 8_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'options')
    call check_ok(riis_warp_options_init(options, c_sizeof(options)), 'default options of a warp')
    options%noise = -1
    call check_refused(riis_warp_create(points, options, warp), RIIS_INVALID_ARGUMENT, 'options.noise is -1')
    call check_ok(riis_warp_create(points, warp=warp), 'create a warp')
    points%x = c_loc(targets(1, 1))
    points%y = c_loc(targets(2, 1))
    points%z = c_loc(targets(3, 1))
    call check_ok(riis_warp_set_targets(warp, points), 'set its targets')
    call check_ok(riis_warp_get_info(warp, warp_info, c_sizeof(warp_info)), 'its quality')
    call check(warp_info%n_landmarks == 6 .and. warp_info%largest_residual < 1d-14, 'targets are met')
    call check_ok(riis_warp_map(warp, points, mapped), 'map points')
    call check(all(abs(mapped(:2, :) - 1.25d0 * targets(:2, :)) < 1d-14), 'mapped points')
    call check_ok(riis_keyframe_arrays_init(frames, c_sizeof(frames)), 'default frames')
    frames%n_keys = 1
    frames%n_vertices = 6
    frames%time = c_loc(time)
    frames%xyz = c_loc(sources)
    call check_ok(riis_warp_set_targets_at(warp, frames, 3d0), 'targets from frames')
    call check_ok(riis_warp_map(warp, points, mapped), 'map points back')
    call check(all(abs(mapped - targets) < 1d-14), 'the identity')
    call check_ok(riis_valve_create(riis_c_string('trileaflet'), valve), 'create a valve')
    call check_refused(riis_valve_set_warp(valve, c_null_ptr, warp), RIIS_INVALID_ARGUMENT, 'closed is NULL')
    call check_ok(riis_valve_set_warp(valve, warp, c_null_ptr), 'warp the valve')
    call check_ok(riis_valve_get_patches(valve, patches, c_sizeof(patches)), 'its patches')
    call check(patches%n_patches == 12 .and. patches%n_pieces == patches%n_curves, 'twelve patches')
    call c_f_pointer(patches%degree, degrees, [patches%n_pieces])
    call check(all([(degrees(i) == 2 .or. degrees(i) == 3, i=1, int(patches%n_pieces))]), 'degrees')
    call riis_warp_destroy(warp)
    call check(.not. c_associated(warp), 'a destroyed warp is null')
    call riis_valve_destroy(valve)
  end subroutine test_warp

  subroutine test_laws()
    real(c_double), target :: time(3), openings(3)
    real(c_double) :: opening, rate
    type(riis_opening_table) :: table
    type(riis_opening_times) :: times
    type(riis_opening_switch) :: by_switch
    type(riis_opening_switch_state), target :: switched, switched_before
    type(riis_opening_angle) :: by_angle
    type(riis_opening_angle_state), target :: turned, turned_before
    integer :: step

    time = [0d0, 0.3d0, 0.5d0]
    openings = [0d0, 1d0, 0.2d0]
    call check_ok(riis_opening_table_init(table, c_sizeof(table)), 'the default table')
    table%n_keys = 3
    table%time = c_loc(time)
    table%opening = c_loc(openings)
    table%interpolation = RIIS_INTERPOLATION_CUBIC
    call check_ok(riis_opening_from_table(table, 0.1d0, opening, rate), 'an opening by a table')
    call check(all(same([opening, rate], twin%laws%by_table)) .and. opening > 0 .and. rate > 0, 'an opening by a table')
    table%interpolation = 7
    call check_refused(riis_opening_from_table(table, 0.1d0), RIIS_INVALID_ARGUMENT, 'interpolation is 7')

    call check_ok(riis_opening_times_init(times, c_sizeof(times)), 'the default times')
    call check_refused(riis_opening_from_times(times, 0.47d0, opening), RIIS_INVALID_ARGUMENT, 'opening_start is nan')
    times%opening_start = 0.45d0
    times%opening_duration = 0.05d0
    times%closing_start = 0.95d0
    times%closing_duration = 0.05d0
    call check_ok(riis_opening_from_times(times, 0.47d0, opening, rate), 'an opening by times')
    call check(all(same([opening, rate], twin%laws%by_times)) .and. opening > 0 .and. rate > 0, 'an opening by times')

    call check_ok(riis_opening_switch_init(by_switch, c_sizeof(by_switch)), 'the default switch')
    call check_ok(riis_opening_switch_state_init(switched, c_sizeof(switched)), 'a closed valve')
    by_switch%opening_duration = 0.04d0
    by_switch%closing_duration = 0.05d0
    call check_ok(riis_opening_angle_init(by_angle, c_sizeof(by_angle)), 'the default law of the angle')
    call check_ok(riis_opening_angle_state_init(turned, c_sizeof(turned)), 'a valve at rest')
    by_angle%pressure_gain = 5500
    by_angle%flow_gain = 2
    by_angle%friction = 50
    by_angle%vortex_gain = 7
    do step = 1, 5
      switched_before = switched
      call check_ok(riis_opening_switch_advance(by_switch, switched_before, 0.003d0 * step, 2d0, 10d0 * step, switched), &
        'advance a switch')
      turned_before = turned
      call check_ok(riis_opening_angle_advance(by_angle, turned_before, 0.003d0 * step, 2d0, 10d0 * step, turned), &
        'advance an angle')
    end do
    call check_same_bytes(c_loc(switched), c_loc(twin%laws%by_switch), int(c_sizeof(switched), c_int64_t), 'the switch')
    call check_same_bytes(c_loc(turned), c_loc(twin%laws%by_angle), int(c_sizeof(turned), c_int64_t), 'the angle')
    call check(switched%phase == RIIS_PHASE_OPENING .and. switched%opening > 0 .and. turned%opening > 0, 'both open')
    call check_refused(riis_opening_switch_advance(by_switch, switched_before, 0d0, 2d0, 1d0, switched), &
      RIIS_INVALID_ARGUMENT, 'time is 0')
    call check_refused(riis_opening_angle_advance(by_angle, turned_before, 0d0, 2d0, 1d0, turned), &
      RIIS_INVALID_ARGUMENT, 'time is 0')
  end subroutine test_laws

  ! A hexahedron has a pyramid on it and a prism beside it. A tetrahedron lies between pyramid and prism.
  subroutine test_mixed_cells()
    integer(c_int64_t), target :: node_ids(23), offsets(5)
    type(riis_mesh_cells) :: cells
    type(riis_csr) :: csr
    type(c_ptr) :: adjacency = c_null_ptr
    integer(c_int64_t), pointer :: row_offsets(:)
    integer(c_int32_t), pointer :: columns(:)

    node_ids = [1, 2, 3, 4, 5, 6, 7, 8, 5, 6, 7, 8, 9, 2, 6, 10, 3, 7, 11, 6, 7, 9, 12]
    offsets = [0, 8, 13, 19, 23]
    call check_refused(riis_mesh_cells_init(cells, 48_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    call check_ok(riis_mesh_cells_init(cells, c_sizeof(cells)), 'default cells')
    call check(cells%struct_size == c_sizeof(cells) .and. cells%n_cells == 0 .and. cells%nodes_per_cell == 4 .and. &
      cells%id_bits == 32 .and. cells%index_base == 0 .and. .not. c_associated(cells%offsets), &
      'the defaults of the cells')
    cells%n_nodes = maxval(node_ids)
    cells%n_cells = size(offsets) - 1
    cells%node_ids = c_loc(node_ids)
    cells%offsets = c_loc(offsets)
    cells%id_bits = storage_size(node_ids)
    cells%index_base = 1
    call check_ok(riis_adjacency_create_from_cells(cells, adjacency), 'an adjacency from mixed cells')
    call check_refused(riis_adjacency_get_csr(adjacency, csr, 8_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    call check_ok(riis_adjacency_get_csr(adjacency, csr, c_sizeof(csr)), 'its rows')
    call check(csr%n_rows == 12 .and. csr%offset_bits == 64 .and. csr%column_bits == 32 .and. csr%index_base == 0, &
      'twelve rows, from 0')
    call c_f_pointer(csr%offsets, row_offsets, [csr%n_rows + 1])
    call c_f_pointer(csr%columns, columns, [row_offsets(csr%n_rows + 1)])
    call check(size(columns) == 2 * (12 + 4 + 5 + 3), 'every edge twice')
    ! Node 6 is in every cell.
    call check(all(columns(row_offsets(6) + 1:row_offsets(7)) + 1 == [2, 5, 7, 9, 10, 12]), 'the neighbours of a node')
    call riis_adjacency_destroy(adjacency)
    call check(.not. c_associated(adjacency), 'a destroyed handle is null')
    call riis_adjacency_destroy(adjacency)

    node_ids(20) = 13
    call check_refused(riis_adjacency_create_from_cells(cells, adjacency), RIIS_INVALID_MESH, 'cell 3')
    offsets = offsets + 2
    call check_refused(riis_adjacency_create_from_cells(cells, adjacency), RIIS_INVALID_MESH, 'cells.offsets')
    call check(.not. c_associated(adjacency), 'no adjacency is made by calls that are refused')
  end subroutine test_mixed_cells

  ! Makes the same grid's adjacency by three functions, with 32-bit ids from 1. C gives 64-bit ids from 0.
  subroutine test_adjacency()
    type(c_ptr) :: of_cells = c_null_ptr, of_faces = c_null_ptr, of_grid = c_null_ptr, of_nothing = c_null_ptr
    type(riis_mark_options) :: options
    type(riis_mark_stats) :: stats
    type(riis_csr) :: csr

    call make_tetrahedra(of_cells)
    call make_faces(of_faces)
    call check_ok(riis_adjacency_create_from_grid(per_side, per_side, per_side, 2, of_grid), 'an adjacency from a grid')
    call check_refused(riis_adjacency_create_from_grid(0_c_int64_t, per_side, per_side, 2, of_nothing), &
      RIIS_INVALID_ARGUMENT, 'ni')
    call check_refused(riis_adjacency_get_csr(of_nothing, csr, c_sizeof(csr)), RIIS_INVALID_ARGUMENT, 'adjacency')
    call check(.not. c_associated(of_nothing), 'no adjacency is made by calls that are refused')

    call check_ok(riis_mark_options_init(options, c_sizeof(options)), 'default mark options')
    options%search = RIIS_SEARCH_NEIGHBOR
    call check_refused(riis_mark_nodes(surface, mesh, options, result), RIIS_INVALID_ARGUMENT, 'adjacency')

    call check_walk(of_cells, twin%cells, 'along tetrahedra')
    call check_walk(of_faces, twin%faces, 'along faces')
    call check_walk(of_grid, twin%grid, 'along a grid')

    call set_adjacency(of_grid)
    call mark_along(RIIS_SEARCH_AUTO, stats)
    call check(stats%search /= RIIS_SEARCH_AUTO .and. stats%complete == 1, 'the choice is complete')
    call mark_along(RIIS_SEARCH_EXHAUSTIVE, stats)
    call check(stats%search == RIIS_SEARCH_EXHAUSTIVE .and. stats%n_unreached == 0, 'the exhaustive search stays')
    call mark_along(RIIS_SEARCH_PAPER, stats)
    call check_same_stats(stats, twin%paper, 'as the paper')
    call check(stats%search == RIIS_SEARCH_PAPER .and. stats%complete == 0, 'the paper''s search is never complete')
    call check_ok(riis_mesh_set_adjacency(mesh), 'take the adjacency away')
    call mark_along(RIIS_SEARCH_AUTO, stats)
    call check(stats%search /= RIIS_SEARCH_NEIGHBOR .and. stats%complete == 1, 'the choice needs no adjacency')

    call test_leaks(of_cells)
    call riis_adjacency_destroy(of_cells)
    call riis_adjacency_destroy(of_faces)
    call riis_adjacency_destroy(of_grid)
    call check(.not. (c_associated(of_cells) .or. c_associated(of_faces) .or. c_associated(of_grid)), &
      'destroyed handles are null')
  end subroutine test_adjacency

  ! Finds the leaks of a thin valve along tetrahedra.
  subroutine test_leaks(of_cells)
    type(c_ptr), intent(in) :: of_cells
    type(riis_surface_options) :: surface_options
    type(riis_mark_options) :: options
    type(riis_leak_list) :: list
    type(riis_passage) :: passage
    integer(c_int64_t), allocatable, target :: label(:)
    integer(c_int64_t) :: n_regions
    type(c_ptr) :: thin, thin_valve, leaking, leaks

    thin = c_null_ptr
    thin_valve = c_null_ptr
    leaking = c_null_ptr
    call check_ok(riis_surface_options_init(surface_options, c_sizeof(surface_options)), 'default surface options')
    surface_options%scale = 10
    surface_options%half_thickness = 0.3d0
    call check_ok(riis_valve_create(riis_c_string('aortic'), thin_valve), 'create a valve')
    call check_ok(riis_surface_create(thin_valve, surface_options, thin), 'create a thin surface')
    call check_ok(riis_marks_create(leaking), 'create a result')
    call check_ok(riis_mark_options_init(options, c_sizeof(options)), 'default mark options')
    options%n_threads = 2
    leaks = c_null_ptr
    call check_ok(riis_leaks_create(leaks), 'create leaks')
    call check_ok(riis_mesh_set_adjacency(mesh), 'take the adjacency away')
    call check_refused(riis_find_leaks(thin, mesh, leaking, options, leaks), RIIS_INVALID_ARGUMENT, &
      'mesh has no adjacency')
    call set_adjacency(of_cells)
    call check_refused(riis_find_leaks(thin, mesh, leaking, options, leaks), RIIS_INVALID_ARGUMENT, &
      'marks are empty')
    call check_ok(riis_leaks_get_list(leaks, list, c_sizeof(list)), 'the edges before')
    call check(list%n_edges == 0 .and. .not. c_associated(list%node_id), 'refused calls write nothing')
    call check_ok(riis_mark_nodes(thin, mesh, marks=leaking), 'mark with a thin surface')
    call check_ok(riis_find_leaks(thin, mesh, leaking, options, leaks), 'find leaks')
    call check_ok(riis_leaks_get_list(leaks, list, c_sizeof(list)), 'the edges that leak')
    call check(list%n_edges > 0 .and. list%n_edges == twin%leaks%list%n_edges .and. &
      all(list%longest_node_id == twin%leaks%list%longest_node_id) .and. list%seconds > 0, 'as many leaks as from C')
    call check(all(transfer([list%longest_length, list%longest_middle, list%half_thickness], [0_c_int64_t]) == &
      transfer([twin%leaks%list%longest_length, twin%leaks%list%longest_middle, twin%leaks%list%half_thickness], &
      [0_c_int64_t])), 'the longest leak')
    call check_same_bytes(list%node_id, twin%leaks%list%node_id, 16 * list%n_edges, 'nodes of edges that leak')
    call check_same_bytes(list%length, twin%leaks%list%length, 8 * list%n_edges, 'their lengths')
    call check_same_bytes(list%distance, twin%leaks%list%distance, 8 * list%n_edges, 'their distances')
    allocate (label(n_nodes))
    call check_ok(riis_label_open_regions(mesh, leaking, options, n_nodes, label, n_regions), 'open regions')
    call check(n_regions == twin%leaks%n_regions .and. n_regions > 0, 'as many regions as from C')
    call check_same_bytes(c_loc(label), twin%leaks%label, 8 * n_nodes, 'the labels')
    call check_ok(find_passage_between(thin, mesh, options, 1_c_int64_t, [0_c_int64_t], 1_c_int64_t, &
      [n_nodes - 1], passage), 'a passage')
    call check(passage%node_id == twin%leaks%passage%node_id .and. passage%state == twin%leaks%passage%state .and. &
      all(transfer([passage%distance, passage%point], [0_c_int64_t]) == &
      transfer([twin%leaks%passage%distance, twin%leaks%passage%point], [0_c_int64_t])), 'the passage')
    call riis_leaks_destroy(leaks)
    call riis_marks_destroy(leaking)
    call riis_surface_destroy(thin)
    call riis_valve_destroy(thin_valve)
  end subroutine test_leaks

  ! The right cusp of an aortic valve is turned into its neighbours.
  subroutine test_crossings()
    type(riis_crossing_options) :: options
    type(riis_crossing_list) :: list
    type(c_ptr) :: crossed, valve, crossings

    crossed = c_null_ptr
    valve = c_null_ptr
    call check_ok(riis_valve_create(riis_c_string('aortic'), valve), 'create a valve')
    call check_ok(riis_valve_set(valve, riis_c_string('right.rotation'), 3_c_int64_t, [0d0, 0d0, 60d0]), 'turn a cusp')
    call check_ok(riis_surface_create(valve, surface=crossed), 'create a surface that crosses itself')
    call check_ok(riis_crossing_options_init(options, c_sizeof(options)), 'default crossing options')
    call check(abs(options%depth - 1d-6) < 1d-20 .and. options%n_threads == 0, 'the default depth')
    options%depth = 2
    crossings = c_null_ptr
    call check_ok(riis_crossings_create(crossings), 'create crossings')
    call check_refused(riis_find_crossings(crossed, options, crossings), RIIS_INVALID_ARGUMENT, &
      'options.depth is 2')
    call check_ok(riis_crossings_get_list(crossings, list, c_sizeof(list)), 'the pairs before')
    call check(list%n_pairs == 0 .and. .not. c_associated(list%depth), 'refused calls write nothing')
    options%depth = 1d-3
    call check_ok(riis_find_crossings(crossed, options, crossings), 'find crossings')
    call check_ok(riis_crossings_get_list(crossings, list, c_sizeof(list)), 'the pairs that cross')
    call check(list%n_pairs > 0 .and. list%n_pairs == twin%crossings%n_pairs .and. list%seconds > 0, &
      'as many pairs as from C')
    call check(all(transfer([list%total_length, list%deepest_depth, list%deepest_point], [0_c_int64_t]) == &
      transfer([twin%crossings%total_length, twin%crossings%deepest_depth, twin%crossings%deepest_point], &
      [0_c_int64_t])) .and. all(list%deepest_triangle_id == twin%crossings%deepest_triangle_id) .and. &
      all(list%deepest_leaflet_id == twin%crossings%deepest_leaflet_id), 'the summary')
    call check_same_bytes(list%triangle_id, twin%crossings%triangle_id, 16 * list%n_pairs, 'triangles that cross')
    call check_same_bytes(list%point, twin%crossings%point, 24 * list%n_pairs, 'where they cross')
    call check_same_bytes(list%depth, twin%crossings%depth, 8 * list%n_pairs, 'their depths')
    call check_same_bytes(list%length, twin%crossings%length, 8 * list%n_pairs, 'their lengths')
    call riis_crossings_destroy(crossings)
    call riis_surface_destroy(crossed)
    call riis_valve_destroy(valve)
  end subroutine test_crossings

  ! Cuts every cube of the grid into six tetrahedra, each along a path from the cube's first corner to its last.
  subroutine make_tetrahedra(adjacency)
    type(c_ptr), intent(inout) :: adjacency
    integer(c_int32_t), parameter :: n = int(per_side, c_int32_t), nn = n * n
    integer(c_int32_t), parameter :: paths(2, 6) = reshape([1, n, 1, nn, n, 1, n, nn, nn, 1, nn, n], [2, 6])
    integer(c_int32_t), target, allocatable :: node_ids(:, :)
    integer(c_int32_t) :: i, j, k, path, first, n_cells
    type(riis_mesh_cells) :: cells

    allocate (node_ids(4, 6 * (n - 1)**3))
    n_cells = 0
    do k = 1, n - 1
      do j = 1, n - 1
        do i = 1, n - 1
          first = i + n * (j - 1) + nn * (k - 1)
          do path = 1, 6
            n_cells = n_cells + 1
            node_ids(:, n_cells) = first + [0, paths(1, path), sum(paths(:, path)), 1 + n + nn]
          end do
        end do
      end do
    end do
    call check_ok(riis_mesh_cells_init(cells, c_sizeof(cells)), 'default cells')
    cells%n_nodes = n_nodes
    cells%n_cells = n_cells
    cells%node_ids = c_loc(node_ids)
    cells%id_bits = storage_size(node_ids)
    call check_refused(riis_adjacency_create_from_cells(cells, adjacency), RIIS_INVALID_MESH, '8000')
    cells%index_base = 1
    call check_ok(riis_adjacency_create_from_cells(cells, adjacency), 'an adjacency from tetrahedra')
  end subroutine make_tetrahedra

  ! Uses the grid's nodes as cell centres, with faces at one of the grid's boundaries.
  subroutine make_faces(adjacency)
    type(c_ptr), intent(inout) :: adjacency
    integer(c_int32_t), parameter :: n = int(per_side, c_int32_t), steps(3) = [1, n, n * n]
    integer(c_int32_t), target, allocatable :: face_cells(:, :)
    integer(c_int32_t) :: node, axis, n_faces
    type(riis_mesh_faces) :: faces

    allocate (face_cells(2, 3 * n**3))
    n_faces = 0
    do node = 1, n**3
      do axis = 1, 3
        n_faces = n_faces + 1
        face_cells(:, n_faces) = [node, merge(0, node + steps(axis), mod((node - 1) / steps(axis), n) == n - 1)]
      end do
    end do
    call check_refused(riis_mesh_faces_init(faces, 56_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    call check_ok(riis_mesh_faces_init(faces, c_sizeof(faces)), 'default faces')
    call check(faces%struct_size == c_sizeof(faces) .and. faces%n_faces == 0 .and. faces%stride == 1 .and. &
      faces%id_bits == 32 .and. faces%index_base == 0 .and. .not. c_associated(faces%owner), &
      'the defaults of the faces')
    faces%n_cells = n_nodes
    faces%n_faces = n_faces
    faces%owner = c_loc(face_cells(1, 1))
    faces%neighbor = c_loc(face_cells(2, 1))
    faces%stride = 2
    faces%id_bits = storage_size(face_cells)
    call check_refused(riis_adjacency_create_from_faces(faces, adjacency), RIIS_INVALID_MESH, '8000')
    faces%index_base = 1
    call check_ok(riis_adjacency_create_from_faces(faces, adjacency), 'an adjacency from faces')
  end subroutine make_faces

  subroutine set_adjacency(adjacency)
    type(c_ptr), intent(in) :: adjacency
    type(riis_csr) :: csr ! may be lost on return, since only its arrays are used
    call check_ok(riis_adjacency_get_csr(adjacency, csr, c_sizeof(csr)), 'the rows of an adjacency')
    call check_ok(riis_mesh_set_adjacency(mesh, csr), 'set an adjacency')
  end subroutine set_adjacency

  ! Marks as the calls from C do, with a new result that holds no earlier marking. All searches but the paper's find the same
  ! nodes.
  subroutine mark_along(search, stats)
    integer(c_int32_t), intent(in) :: search
    type(riis_mark_stats), intent(inout) :: stats
    integer(c_int8_t), target :: node_mask(n_nodes)
    type(riis_mark_options) :: options
    type(c_ptr) :: walked
    type(riis_mark_list) :: list
    integer(c_int64_t) :: n

    do n = 1, n_nodes
      node_mask(n) = merge(0_c_int8_t, 1_c_int8_t, mod(n - 1, 7_c_int64_t) == 0)
    end do
    call check_ok(riis_mark_options_init(options, c_sizeof(options)), 'default mark options')
    options%distance_limit = 2.5d0
    options%node_mask = c_loc(node_mask)
    options%search = search
    options%n_threads = 2
    walked = c_null_ptr
    call check_ok(riis_marks_create(walked), 'create a result')
    call check_ok(riis_mark_nodes(surface, mesh, options, walked), 'mark along an adjacency')
    call check_ok(riis_marks_get_stats(walked, stats, c_sizeof(stats)), 'statistics')
    if (search /= RIIS_SEARCH_PAPER) then
      call check_ok(riis_marks_get_list(walked, RIIS_LIST_MARKED, list, c_sizeof(list)), &
        'the marked nodes')
      call check_same_list(list, twin%marked, 'marked along an adjacency')
      call check_ok(riis_marks_get_list(walked, RIIS_LIST_WITHIN_LIMIT, list, c_sizeof(list)), &
        'the nodes within the limit')
      call check_same_list(list, twin%within_limit, 'within the limit along an adjacency')
      call check(stats%complete == 1, 'the search is complete')
    end if
    call riis_marks_destroy(walked)
  end subroutine mark_along

  subroutine check_walk(adjacency, from_c, what)
    type(c_ptr), intent(in) :: adjacency
    type(twin_walk), intent(in) :: from_c
    character(len=*), intent(in) :: what
    type(riis_csr) :: csr
    type(riis_mark_stats) :: stats
    integer(c_int64_t), pointer :: offsets(:)

    call check_ok(riis_adjacency_get_csr(adjacency, csr, c_sizeof(csr)), what // ': rows')
    call check(csr%struct_size == c_sizeof(csr) .and. csr%n_rows == n_nodes .and. csr%n_all == n_nodes .and. &
      csr%offset_bits == 64 .and. csr%column_bits == 32 .and. csr%index_base == 0, what // ': what the rows are')
    call check_same_bytes(csr%offsets, from_c%csr%offsets, 8 * (n_nodes + 1), what // ': offsets')
    call c_f_pointer(csr%offsets, offsets, [n_nodes + 1])
    call check_same_bytes(csr%columns, from_c%csr%columns, 4 * offsets(n_nodes + 1), what // ': columns')
    call set_adjacency(adjacency)
    call mark_along(RIIS_SEARCH_NEIGHBOR, stats)
    call check(stats%search == RIIS_SEARCH_NEIGHBOR, what // ': the search that ran')
    call check_same_stats(stats, from_c%stats, what)
    call check_ok(riis_mesh_set_adjacency(mesh), what // ': take it away')
  end subroutine check_walk

  ! Compares everything but the time.
  subroutine check_same_stats(a, b, what)
    type(riis_mark_stats), intent(in) :: a, b
    character(len=*), intent(in) :: what
    call check(a%n_nodes == b%n_nodes .and. a%n_marked == b%n_marked .and. a%n_within_limit == b%n_within_limit .and. &
      a%n_queries == b%n_queries .and. a%search == b%search .and. a%complete == b%complete .and. &
      a%n_unreached == b%n_unreached, what // ': the same statistics from Fortran and from C')
    call check(a%n_marked > 0 .and. a%n_queries > 0 .and. a%seconds > 0, what // ': there is something to compare')
  end subroutine check_same_stats

  ! Uses rows as a Fortran solver has them: counted from 1, of the default integer kind, with a ghost node.
  subroutine test_own_rows()
    integer, target, allocatable :: offsets(:), columns(:)
    integer(c_int64_t), pointer :: own_offsets(:)
    integer(c_int32_t), pointer :: own_columns(:)
    type(c_ptr) :: of_grid = c_null_ptr
    type(riis_mark_stats) :: stats
    type(riis_csr) :: csr

    call check_ok(riis_adjacency_create_from_grid(per_side, per_side, per_side, 0, of_grid), 'rows of a grid')
    call check_ok(riis_adjacency_get_csr(of_grid, csr, c_sizeof(csr)), 'the rows of an adjacency')
    call c_f_pointer(csr%offsets, own_offsets, [n_nodes + 1])
    call c_f_pointer(csr%columns, own_columns, [own_offsets(n_nodes + 1)])
    allocate (offsets(n_nodes + 1), columns(size(own_columns) + 1))
    offsets(:) = int(own_offsets) + 1
    columns(:) = [own_columns + 1, int(n_nodes) + 1] ! the last row also lists a ghost node
    offsets(n_nodes + 1) = offsets(n_nodes + 1) + 1
    call riis_adjacency_destroy(of_grid)

    call check_refused(riis_csr_init(csr, 48_c_int64_t), RIIS_INVALID_STRUCT_SIZE, 'struct size')
    call check_ok(riis_csr_init(csr, c_sizeof(csr)), 'default rows')
    call check(csr%struct_size == c_sizeof(csr) .and. csr%n_rows == 0 .and. csr%n_all == 0 .and. &
      csr%offset_bits == 32 .and. csr%column_bits == 32 .and. csr%index_base == 0 .and. &
      .not. c_associated(csr%columns), 'the defaults of the rows')
    csr%n_rows = n_nodes - 1
    csr%offsets = c_loc(offsets)
    csr%columns = c_loc(columns)
    csr%offset_bits = storage_size(offsets)
    csr%column_bits = storage_size(columns)
    csr%index_base = 1
    call check_refused(riis_mesh_set_adjacency(mesh, csr), RIIS_INVALID_ARGUMENT, 'n_rows')
    csr%n_rows = n_nodes
    call check_refused(riis_mesh_set_adjacency(mesh, csr), RIIS_INVALID_MESH, '8001')
    csr%n_all = n_nodes + 1
    call check_ok(riis_mesh_set_adjacency(mesh, csr), 'set own rows')
    call mark_along(RIIS_SEARCH_NEIGHBOR, stats)
    call check_same_stats(stats, twin%grid%stats, 'along own rows')
    call check_ok(riis_mesh_set_adjacency(mesh), 'take own rows away')
  end subroutine test_own_rows

  subroutine test_destroy()
    integer :: i
    do i = 1, 2 ! destroying a handle twice is allowed
      call riis_marks_destroy(result)
      call riis_mesh_destroy(mesh)
      call riis_surface_destroy(plate)
      call riis_surface_destroy(surface)
      call riis_valve_destroy(valve)
      call check(.not. (c_associated(result) .or. c_associated(mesh) .or. c_associated(plate) .or. &
        c_associated(surface) .or. c_associated(valve)), 'destroyed handles are null')
    end do
  end subroutine test_destroy
end program test_calls
