! SPDX-License-Identifier: Apache-2.0
! Uses riis_c directly, as its first comment shows. The tests cover texts, handles, structs with their sizes, arguments that are
! left out, arrays of the library, and log functions. check_declarations.py compares every declaration with riis.h. The tests of
! module riis and of the subroutines for Fortran 77 call every function.
module log_capture
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int32_t, c_ptr
  use riis_c
  implicit none
  public

  ! The type of the log function's user data.
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
  use log_capture
  use riis_c
  implicit none
  integer, parameter :: per_side = 11, n_nodes = per_side**3
  real(c_double), target :: xyz(3, n_nodes)
  integer :: i

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -1.8d0 + 0.36d0 * [mod(i, per_side), mod(i / per_side, per_side), i / per_side**2]
  end do
  call test_version_and_texts()
  call test_marking()
  call test_log()
  call finish()

contains

  subroutine test_version_and_texts()
    call check(riis_c_text(riis_last_error()) == '', 'no error text before the first error')
    call check(verify(riis_c_text(riis_version_string()), '0123456789.') == 0, 'the version has numbers and points')
    call check(riis_c_text(riis_status_name(RIIS_INTERNAL_ERROR)) == 'RIIS_INTERNAL_ERROR', 'the name of a status')
    call check(riis_c_text(riis_status_name(12345_riis_status)) == 'unknown status', 'the name of no status')
    call check(riis_c_text(c_null_ptr) == '', 'no text')
    call check(riis_c_string(' a b  ') == ' a b' // c_null_char, 'a string for C')
    call check(len(riis_c_string('')) == 1, 'an empty string for C')
  end subroutine test_version_and_texts

  subroutine test_marking()
    type(c_ptr) :: valve = c_null_ptr, surface = c_null_ptr, mesh = c_null_ptr, marks = c_null_ptr
    type(riis_mark_list) :: list
    type(riis_closest) :: closest
    integer(c_int64_t), pointer :: ids(:)
    real(c_double), pointer :: distance(:)
    integer(riis_status) :: status
    status = riis_valve_create(riis_c_string('pulmonary'), valve)
    call check_refused(status, RIIS_INVALID_PARAMETER, 'pulmonary')
    call check(.not. c_associated(valve), 'no valve is made by a call that is refused')
    call check_ok(riis_valve_create(riis_c_string('aortic'), valve), 'create a valve')
    call check_ok(riis_surface_create(valve, surface=surface), 'create a surface without options')
    call check_ok(riis_mesh_create(int(n_nodes, c_int64_t), c_loc(xyz(1, 1)), c_loc(xyz(2, 1)), c_loc(xyz(3, 1)), 3_c_int64_t, &
      mesh), 'create a mesh')
    call check_ok(riis_marks_create(marks), 'create marks')
    call check_ok(riis_mark_nodes(surface, mesh, marks=marks), 'mark')
    call check_refused(riis_marks_get_list(marks, RIIS_LIST_MARKED, list, c_sizeof(list) + 1), RIIS_INVALID_STRUCT_SIZE, 'size')
    call check_ok(riis_marks_get_list(marks, RIIS_LIST_MARKED, list, c_sizeof(list)), 'get the marked nodes')
    call check(list%n_nodes > 0, 'some nodes are marked')
    call c_f_pointer(list%node_id, ids, [list%n_nodes])
    call c_f_pointer(list%distance, distance, [list%n_nodes])
    do i = 1, size(ids)
      call check_ok(riis_closest_point(surface, xyz(:, ids(i) + 1), closest, c_sizeof(closest)), 'ask for the closest point')
      call check(abs(closest%distance - distance(i)) < 1d-12 .and. distance(i) <= 0.1d0, 'the distance of a marked node')
    end do
    call riis_marks_destroy(marks)
    call riis_mesh_destroy(mesh)
    call riis_surface_destroy(surface)
    call riis_valve_destroy(valve)
    call check(.not. c_associated(marks) .and. .not. c_associated(valve), 'destroying sets handles to NULL')
  end subroutine test_marking

  ! A triangle without area causes a warning if the options accept it.
  subroutine test_log()
    type(captured), target :: log
    type(riis_surface_arrays) :: arrays
    type(riis_surface_options) :: options
    type(c_ptr) :: surface = c_null_ptr
    integer(c_int32_t), target :: faces(3, 2)
    log = captured(0, 0)
    faces = reshape([1, 2, 12, 1, 1, 1], [3, 2])
    call check_ok(riis_surface_arrays_init(arrays, c_sizeof(arrays)), 'the defaults of arrays')
    call check_ok(riis_surface_options_init(options, c_sizeof(options)), 'the defaults of options')
    arrays%n_vertices = n_nodes
    arrays%x = c_loc(xyz(1, 1))
    arrays%y = c_loc(xyz(2, 1))
    arrays%z = c_loc(xyz(3, 1))
    arrays%stride = 3
    arrays%n_faces = 2
    arrays%vertex_ids = c_loc(faces)
    arrays%index_base = 1
    options%zero_area = RIIS_ZERO_AREA_SKIP
    call riis_set_log(c_funloc(capture), c_loc(log))
    call check_ok(riis_surface_create_from_arrays(arrays, options, surface), 'create a surface from arrays')
    call check(log%n_warnings == 1 .and. log%n_messages >= 1, 'one warning reaches the user data')
    call check(index(last_warning, 'area') > 0, 'the warning: ' // trim(last_warning))
    call riis_set_log(c_null_funptr, c_null_ptr)
    call riis_surface_destroy(surface)
  end subroutine test_log
end program test_calls
