! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_marking.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Marking: riis_mark_* of riis.h, as a part of module riis.
module riis_marking
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_f_pointer, c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c, c_mark_nodes => riis_mark_nodes, c_mark_fields => riis_mark_fields
  use riis_support
  use riis_surfaces, only: riis_surface
  use riis_meshes, only: riis_mesh
  implicit none
  private
  public :: riis_marks, riis_mark_fields, riis_mark_nodes

  !> Pointers to the fields of the closest points that riis_mark_nodes kept, by %marked_fields or
  !! %within_limit_fields. The result owns the arrays; they count from 1. The size of a field that was not requested is 0.
  type :: riis_mark_fields
    integer(int64) :: n_nodes = 0                           !< Returns the number of nodes.
    real(c_double), pointer :: point(:, :) => null()        !< (3, n_nodes): the closest point of the surface.
    real(c_double), pointer :: normal(:, :) => null()       !< (3, n_nodes): the unit normal of its triangle.
    real(c_double), pointer :: barycentric(:, :) => null()  !< (3, n_nodes): its weights of the triangle's vertices.
    real(c_double), pointer :: uv(:, :) => null()           !< (2, n_nodes): its place on its patch, in [0, 1].
    real(c_double), pointer :: velocity(:, :) => null()     !< (3, n_nodes): the velocity of the surface there.
    integer(int32), pointer :: side(:) => null()            !< (n_nodes): 1 downstream, -1 upstream, 0 on the surface or level
                                                            !! with its rim.
    integer(int32), pointer :: rim(:) => null()             !< (n_nodes): 1 if the point lies on the rim of the surface, else 0.
    integer(int32), pointer :: patch_id(:) => null()        !< (n_nodes), from 0, as %triangles of the surface gives it.
  end type riis_mark_fields

  !> The nodes that a marking found, with their distances. It is empty until riis_mark_nodes and after %destroy, which must
  !! be called. Use the same variable every time step: its memory is kept. Any number of threads may read it at once. One
  !! thread may write it while no other reads it.
  type :: riis_marks
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, non_overridable :: n_marked => result_n_marked           !< Returns the number of marked nodes.
    procedure, non_overridable :: n_within_limit => result_n_within_limit !< Returns the number of nodes within the limit.
    procedure, non_overridable :: marked => result_marked               !< Points to the arrays of the marked nodes.
    procedure, non_overridable :: within_limit => result_within_limit   !< Points to those of the nodes within the limit.
    generic :: marked_nodes => marked_int32, marked_int64               !< Copies the marked nodes, counted from 1.
    generic :: nodes_within_limit => within_int32, within_int64         !< Copies the nodes within the limit, counted from 1.
    procedure, non_overridable :: marked_fields => result_marked_fields !< Pointers to the marked nodes' fields.
    procedure, non_overridable :: within_limit_fields => result_within_limit_fields !< The same of those within the limit.
    procedure, non_overridable :: add_resistance => result_add_resistance !< Adds K and K u_surface to the caller's arrays.
    procedure, non_overridable :: add_reaction => result_add_reaction   !< Adds the force of the flow on the surface.
    procedure, non_overridable :: band_sums => result_band_sums         !< Sums on either side of the surface.
    generic :: dense => dense_int8, dense_int32, dense_logical          !< Writes one entry a node into the caller's arrays.
    procedure, non_overridable :: get_stats => result_get_stats         !< Tells how the last marking went.
    procedure, non_overridable :: leaking_edges => result_leaking_edges !< Points to the edges that riis_find_leaks found.
    procedure, non_overridable :: is_created => result_is_created       !< Tells whether it was created.
    procedure, non_overridable :: c_handle => result_c_handle           !< The handle for calls of riis_c.
    procedure, non_overridable :: destroy => result_destroy             !< Frees its memory.
    generic :: assignment(=) => assign                                  !< Refused: a handle cannot be copied.
    procedure, private, non_overridable :: assign => result_assign
    procedure, private, non_overridable :: marked_int32 => result_marked_int32
    procedure, private, non_overridable :: marked_int64 => result_marked_int64
    procedure, private, non_overridable :: within_int32 => result_within_int32
    procedure, private, non_overridable :: within_int64 => result_within_int64
    procedure, private, non_overridable :: dense_int8 => result_dense_int8
    procedure, private, non_overridable :: dense_int32 => result_dense_int32
    procedure, private, non_overridable :: dense_logical => result_dense_logical
  end type riis_marks

  !> Finds every node whose distance to the surface is at most the half thickness (marked) or the distance limit.
  interface riis_mark_nodes
    module procedure mark_nodes_logical
    module procedure mark_nodes_int8
    module procedure mark_nodes_int32
  end interface riis_mark_nodes

  ! A list of nodes as the library has it.
  type :: node_list
    integer(int64) :: n = 0
    type(c_ptr) :: node_id = c_null_ptr, distance = c_null_ptr, triangle_id = c_null_ptr, leaflet_id = c_null_ptr
  end type node_list

  ! The target of pointers to nothing, so that their size can be taken.
  real(c_double), target, save :: no_reals(0), no_vectors(3, 0), no_uv(2, 0)
  integer(int32), target, save :: no_int32(0)
  integer(int64), target, save :: no_int64(0), no_edges(2, 0)

contains

  !> Finds every node whose distance to the surface is at most the half thickness (marked) or the distance limit. They
  !! replace the result's content; pointers got from it before end. Errors: RIIS_INVALID_MESH for a coordinate that became
  !! non-finite without %update; RIIS_INVALID_ARGUMENT for an option out of range. The result's content is then as it was,
  !! but its arrays may have moved.
  subroutine mark_nodes_logical(surface, mesh, result, distance_limit, node_mask, search, n_threads, status, fields)
    class(riis_surface), intent(in) :: surface              !< Created. Other calls under way may share it.
    class(riis_mesh), intent(in) :: mesh                    !< Created. Other calls under way may share it.
    class(riis_marks), intent(inout) :: result        !< Empty, or from a call before.
    real(c_double), intent(in), optional :: distance_limit  !< Nodes get their distance up to here, from the half thickness to
                                                            !! 1e60. Default RIIS_AUTO: the half thickness.
    logical, intent(in), optional :: node_mask(:)           !< (n_nodes): nodes with .false. are left out; copied. Default:
                                                            !! all nodes.
    class(*), intent(in), optional :: search                !< integer, RIIS_SEARCH_*. Default RIIS_SEARCH_AUTO.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as the work feeds.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    class(*), intent(in), optional :: fields                !< integer, a sum of RIIS_FIELD_*: what the result keeps of the
                                                            !! closest points, for %marked_fields. Default 0: nothing.
    integer(int8), allocatable :: bytes(:)
    integer(riis_status) :: code
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call mark(surface, mesh, result, distance_limit, bytes, search, n_threads, fields, code)
    call finish(code, status)
  end subroutine mark_nodes_logical

  !> Does the same with a mask of bytes. Only a section that is not contiguous is copied.
  subroutine mark_nodes_int8(surface, mesh, result, distance_limit, node_mask, search, n_threads, status, fields)
    class(riis_surface), intent(in) :: surface              !< Created. Other calls under way may share it.
    class(riis_mesh), intent(in) :: mesh                    !< Created. Other calls under way may share it.
    class(riis_marks), intent(inout) :: result        !< Empty, or from a call before.
    real(c_double), intent(in), optional :: distance_limit  !< Nodes get their distance up to here, from the half thickness to
                                                            !! 1e60. Default RIIS_AUTO: the half thickness.
    integer(int8), intent(in), contiguous :: node_mask(:)   !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: search                !< integer, RIIS_SEARCH_*. Default RIIS_SEARCH_AUTO.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as the work feeds.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    class(*), intent(in), optional :: fields                !< integer, a sum of RIIS_FIELD_*: what the result keeps of the
                                                            !! closest points, for %marked_fields. Default 0: nothing.
    integer(riis_status) :: code
    code = RIIS_OK
    call mark(surface, mesh, result, distance_limit, node_mask, search, n_threads, fields, code)
    call finish(code, status)
  end subroutine mark_nodes_int8

  !> Does the same with a mask of integers, which is copied.
  subroutine mark_nodes_int32(surface, mesh, result, distance_limit, node_mask, search, n_threads, status, fields)
    class(riis_surface), intent(in) :: surface              !< Created. Other calls under way may share it.
    class(riis_mesh), intent(in) :: mesh                    !< Created. Other calls under way may share it.
    class(riis_marks), intent(inout) :: result        !< Empty, or from a call before.
    real(c_double), intent(in), optional :: distance_limit  !< Nodes get their distance up to here, from the half thickness to
                                                            !! 1e60. Default RIIS_AUTO: the half thickness.
    integer(int32), intent(in) :: node_mask(:)              !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: search                !< integer, RIIS_SEARCH_*. Default RIIS_SEARCH_AUTO.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as the work feeds.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    class(*), intent(in), optional :: fields                !< integer, a sum of RIIS_FIELD_*: what the result keeps of the
                                                            !! closest points, for %marked_fields. Default 0: nothing.
    integer(int8), allocatable :: bytes(:)
    integer(riis_status) :: code
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call mark(surface, mesh, result, distance_limit, bytes, search, n_threads, fields, code)
    call finish(code, status)
  end subroutine mark_nodes_int32

  ! The common part of all specifics of riis_mark_nodes; does nothing after an error.
  subroutine mark(surface, mesh, result, distance_limit, mask, search, n_threads, fields, code)
    class(riis_surface), intent(in) :: surface
    class(riis_mesh), intent(in) :: mesh
    class(riis_marks), intent(inout) :: result
    real(c_double), intent(in), optional :: distance_limit
    integer(int8), intent(in), contiguous, optional, target :: mask(:)
    class(*), intent(in), optional :: search, n_threads, fields
    integer(riis_status), intent(inout) :: code
    type(riis_mark_options) :: options
    logical :: was_empty
    was_empty = .not. c_associated(result%handle)
    if (code == RIIS_OK) code = check_created(surface%c_handle(), 'surface')
    if (code == RIIS_OK) code = check_created(mesh%c_handle(), 'mesh')
    if (code == RIIS_OK) code = riis_mark_options_init(options, c_sizeof(options))
    if (present(distance_limit)) options%distance_limit = distance_limit
    call get_integer(search, 'search', options%search, code)
    call get_integer(n_threads, 'n_threads', options%n_threads, code)
    call get_integer(fields, 'fields', options%fields, code)
    if (code == RIIS_OK .and. present(mask)) then
      code = check_size(size(mask, kind=int64), mesh%n_nodes(), 'node_mask', 'nodes')
      if (size(mask, kind=int64) > 0) options%node_mask = c_loc(mask)
    end if
    if (code == RIIS_OK .and. was_empty) code = riis_marks_create(result%handle)
    if (code == RIIS_OK) code = c_mark_nodes(surface%c_handle(), mesh%c_handle(), options, result%handle)
    if (code /= RIIS_OK .and. was_empty) call riis_marks_destroy(result%handle) ! empty as before
  end subroutine mark

  !> Returns the number of marked nodes.
  function result_n_marked(this, status) result(n)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int64) :: n                                     !< 0 on an error.
    integer(riis_status) :: code
    n = 0
    code = check_created(this%handle, 'the result')
    if (code == RIIS_OK) code = riis_mark_result_marked(this%handle, n)
    call finish(code, status)
  end function result_n_marked

  !> Returns the number of nodes within the distance limit, marked or not.
  function result_n_within_limit(this, status) result(n)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int64) :: n                                     !< 0 on an error.
    integer(riis_status) :: code
    n = 0
    code = check_created(this%handle, 'the result')
    if (code == RIIS_OK) code = riis_mark_result_within_limit(this%handle, n)
    call finish(code, status)
  end function result_n_within_limit

  ! The library's list of the marked nodes, or of those within the limit.
  function get_list(this, within_limit, list) result(code)
    class(riis_marks), intent(in) :: this
    logical, intent(in) :: within_limit
    type(node_list), intent(out) :: list
    integer(riis_status) :: code
    code = check_created(this%handle, 'the result')
    if (code /= RIIS_OK) return
    if (within_limit) then
      code = riis_mark_result_within_limit(this%handle, list%n, list%node_id, list%distance, list%triangle_id, &
        list%leaflet_id)
    else
      code = riis_mark_result_marked(this%handle, list%n, list%node_id, list%distance, list%triangle_id, list%leaflet_id)
    end if
  end function get_list

  ! Points to a list. A list without nodes has no address.
  subroutine point_to(list, node_id, distance, triangle_id, leaflet_id)
    type(node_list), intent(in) :: list
    integer(int64), pointer, intent(out), optional :: node_id(:), triangle_id(:)
    real(c_double), pointer, intent(out), optional :: distance(:)
    integer(int32), pointer, intent(out), optional :: leaflet_id(:)
    if (present(node_id)) then
      node_id => no_int64
      if (list%n > 0) call c_f_pointer(list%node_id, node_id, [list%n])
    end if
    if (present(distance)) then
      distance => no_reals
      if (list%n > 0) call c_f_pointer(list%distance, distance, [list%n])
    end if
    if (present(triangle_id)) then
      triangle_id => no_int64
      if (list%n > 0) call c_f_pointer(list%triangle_id, triangle_id, [list%n])
    end if
    if (present(leaflet_id)) then
      leaflet_id => no_int32
      if (list%n > 0) call c_f_pointer(list%leaflet_id, leaflet_id, [list%n])
    end if
  end subroutine point_to

  !> Points to the result's own arrays of the marked nodes, ascending by node, without a copy. They are valid until the next
  !! riis_mark_nodes with the result or its destruction. Do not write to them. Without marked nodes, and on an error, their
  !! sizes are 0.
  subroutine result_marked(this, node_id, distance, triangle_id, leaflet_id, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    integer(int64), pointer, intent(out), optional :: node_id(:) !< (n), ascending, from 0: node_id + 1 is the column of xyz.
    real(c_double), pointer, intent(out), optional :: distance(:) !< (n), mesh units.
    integer(int64), pointer, intent(out), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), pointer, intent(out), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(node_list) :: list
    integer(riis_status) :: code
    code = get_list(this, .false., list)
    call point_to(list, node_id, distance, triangle_id, leaflet_id)
    call finish(code, status)
  end subroutine result_marked

  !> Does the same for all nodes within the distance limit, marked or not.
  subroutine result_within_limit(this, node_id, distance, triangle_id, leaflet_id, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    integer(int64), pointer, intent(out), optional :: node_id(:) !< (n), ascending, from 0: node_id + 1 is the column of xyz.
    real(c_double), pointer, intent(out), optional :: distance(:) !< (n), mesh units.
    integer(int64), pointer, intent(out), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), pointer, intent(out), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(node_list) :: list
    integer(riis_status) :: code
    code = get_list(this, .true., list)
    call point_to(list, node_id, distance, triangle_id, leaflet_id)
    call finish(code, status)
  end subroutine result_within_limit

  !> Copies the arrays of the marked nodes, ascending by node; the copies stay when the result goes. Each array is allocated
  !! to exactly the size that is needed, (0) for none, unless it has that size. Errors: RIIS_LIMIT_EXCEEDED for a node that
  !! integer(int32) cannot count; the arrays are left alone on an error.
  subroutine result_marked_int32(this, node_num, distance, triangle_id, leaflet_id, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    integer(int32), allocatable, intent(inout) :: node_num(:)  !< (n), ascending, from 1: the column of xyz.
    real(c_double), allocatable, intent(inout), optional :: distance(:) !< (n), mesh units.
    integer(int64), allocatable, intent(inout), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), allocatable, intent(inout), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(node_list) :: list
    integer(int64), pointer :: ids(:)
    integer(riis_status) :: code
    integer :: stat
    code = get_list(this, .false., list)
    call point_to(list, ids)
    if (code == RIIS_OK .and. list%n > 0) then
      if (ids(list%n) >= huge(node_num)) code = fail(RIIS_LIMIT_EXCEEDED, 'node ' // text_of(ids(list%n)) // &
        ' is more than an integer(int32) can count: use integer(int64)')
    end if
    if (code == RIIS_OK) then
      if (allocated(node_num)) then
        if (size(node_num, kind=int64) /= list%n) deallocate (node_num)
      end if
      stat = 0
      if (.not. allocated(node_num)) allocate (node_num(list%n), stat=stat)
      code = out_of_memory(stat)
    end if
    if (code == RIIS_OK) then
      node_num = int(ids + 1, int32)
      code = copy_list(list, distance, triangle_id, leaflet_id)
    end if
    call finish(code, status)
  end subroutine result_marked_int32

  !> Does the same for integer(int64).
  subroutine result_marked_int64(this, node_num, distance, triangle_id, leaflet_id, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    integer(int64), allocatable, intent(inout) :: node_num(:)  !< (n), ascending, from 1: the column of xyz.
    real(c_double), allocatable, intent(inout), optional :: distance(:) !< (n), mesh units.
    integer(int64), allocatable, intent(inout), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), allocatable, intent(inout), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(node_list) :: list
    integer(int64), pointer :: ids(:)
    integer(riis_status) :: code
    integer :: stat
    code = get_list(this, .false., list)
    call point_to(list, ids)
    if (code == RIIS_OK) then
      if (allocated(node_num)) then
        if (size(node_num, kind=int64) /= list%n) deallocate (node_num)
      end if
      stat = 0
      if (.not. allocated(node_num)) allocate (node_num(list%n), stat=stat)
      code = out_of_memory(stat)
    end if
    if (code == RIIS_OK) then
      node_num = int(ids + 1, int64)
      code = copy_list(list, distance, triangle_id, leaflet_id)
    end if
    call finish(code, status)
  end subroutine result_marked_int64

  !> Does the same for all nodes within the distance limit, marked or not.
  subroutine result_within_int32(this, node_num, distance, triangle_id, leaflet_id, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    integer(int32), allocatable, intent(inout) :: node_num(:)  !< (n), ascending, from 1: the column of xyz.
    real(c_double), allocatable, intent(inout), optional :: distance(:) !< (n), mesh units.
    integer(int64), allocatable, intent(inout), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), allocatable, intent(inout), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(node_list) :: list
    integer(int64), pointer :: ids(:)
    integer(riis_status) :: code
    integer :: stat
    code = get_list(this, .true., list)
    call point_to(list, ids)
    if (code == RIIS_OK .and. list%n > 0) then
      if (ids(list%n) >= huge(node_num)) code = fail(RIIS_LIMIT_EXCEEDED, 'node ' // text_of(ids(list%n)) // &
        ' is more than an integer(int32) can count: use integer(int64)')
    end if
    if (code == RIIS_OK) then
      if (allocated(node_num)) then
        if (size(node_num, kind=int64) /= list%n) deallocate (node_num)
      end if
      stat = 0
      if (.not. allocated(node_num)) allocate (node_num(list%n), stat=stat)
      code = out_of_memory(stat)
    end if
    if (code == RIIS_OK) then
      node_num = int(ids + 1, int32)
      code = copy_list(list, distance, triangle_id, leaflet_id)
    end if
    call finish(code, status)
  end subroutine result_within_int32

  !> Does the same for integer(int64).
  subroutine result_within_int64(this, node_num, distance, triangle_id, leaflet_id, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    integer(int64), allocatable, intent(inout) :: node_num(:)  !< (n), ascending, from 1: the column of xyz.
    real(c_double), allocatable, intent(inout), optional :: distance(:) !< (n), mesh units.
    integer(int64), allocatable, intent(inout), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), allocatable, intent(inout), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(node_list) :: list
    integer(int64), pointer :: ids(:)
    integer(riis_status) :: code
    integer :: stat
    code = get_list(this, .true., list)
    call point_to(list, ids)
    if (code == RIIS_OK) then
      if (allocated(node_num)) then
        if (size(node_num, kind=int64) /= list%n) deallocate (node_num)
      end if
      stat = 0
      if (.not. allocated(node_num)) allocate (node_num(list%n), stat=stat)
      code = out_of_memory(stat)
    end if
    if (code == RIIS_OK) then
      node_num = int(ids + 1, int64)
      code = copy_list(list, distance, triangle_id, leaflet_id)
    end if
    call finish(code, status)
  end subroutine result_within_int64

  ! Copies the arrays besides that of the nodes.
  function copy_list(list, distance, triangle_id, leaflet_id) result(code)
    type(node_list), intent(in) :: list
    real(c_double), allocatable, intent(inout), optional :: distance(:)
    integer(int64), allocatable, intent(inout), optional :: triangle_id(:)
    integer(int32), allocatable, intent(inout), optional :: leaflet_id(:)
    real(c_double), pointer :: distances(:)
    integer(int64), pointer :: triangles(:)
    integer(int32), pointer :: leaflets(:)
    integer(riis_status) :: code
    integer :: stat
    call point_to(list, distance=distances, triangle_id=triangles, leaflet_id=leaflets)
    stat = 0
    if (present(distance) .and. stat == 0) then
      if (allocated(distance)) then
        if (size(distance, kind=int64) /= list%n) deallocate (distance)
      end if
      if (.not. allocated(distance)) allocate (distance(list%n), stat=stat)
      if (stat == 0) distance = distances
    end if
    if (present(triangle_id) .and. stat == 0) then
      if (allocated(triangle_id)) then
        if (size(triangle_id, kind=int64) /= list%n) deallocate (triangle_id)
      end if
      if (.not. allocated(triangle_id)) allocate (triangle_id(list%n), stat=stat)
      if (stat == 0) triangle_id = triangles
    end if
    if (present(leaflet_id) .and. stat == 0) then
      if (allocated(leaflet_id)) then
        if (size(leaflet_id, kind=int64) /= list%n) deallocate (leaflet_id)
      end if
      if (.not. allocated(leaflet_id)) allocate (leaflet_id(list%n), stat=stat)
      if (stat == 0) leaflet_id = leaflets
    end if
    code = out_of_memory(stat)
  end function copy_list

  !> Writes one entry a node into the arrays that are given. Each has the size of the mesh's number of nodes. The compiler
  !! copies sections that are not contiguous there and back. Errors: RIIS_INVALID_ARGUMENT for another size, or a
  !! far_distance that looks near; nothing is then written.
  subroutine result_dense_int8(this, mark, distance, triangle_id, leaflet_id, far_distance, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    integer(int8), intent(inout), optional :: mark(:) !< (n_nodes): 1 for marked nodes, 0 for others; not copied.
    real(c_double), intent(inout), optional :: distance(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! far_distance.
    integer(int64), intent(inout), optional :: triangle_id(:) !< (n_nodes): for nodes within the distance limit, from
                                                            !! 0, else -1.
    integer(int32), intent(inout), optional :: leaflet_id(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! -1.
    real(c_double), intent(in), optional :: far_distance    !< Any value outside [0, distance_limit], NaN also. Default
                                                            !! RIIS_FAR_DISTANCE.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int64) :: n
    integer(riis_status) :: code
    n = -1
    code = check_created(this%handle, 'the result')
    if (present(mark)) n = size(mark, kind=int64)
    if (present(distance)) call check('distance', size(distance, kind=int64))
    if (present(triangle_id)) call check('triangle_id', size(triangle_id, kind=int64))
    if (present(leaflet_id)) call check('leaflet_id', size(leaflet_id, kind=int64))
    if (code == RIIS_OK .and. n < 0) code = refuse('none of mark, distance, triangle_id and leaflet_id is given')
    if (code == RIIS_OK) then
      if (present(far_distance)) then
        code = riis_marks_get_dense(this%handle, n, far_distance, mark, distance, triangle_id, leaflet_id)
      else
        code = riis_marks_get_dense(this%handle, n, RIIS_FAR_DISTANCE, mark, distance, triangle_id, leaflet_id)
      end if
    end if
    call finish(code, status)

  contains

    ! The first array sets the size, which the library compares with the mesh.
    subroutine check(name, n_entries)
      character(len=*), intent(in) :: name
      integer(int64), intent(in) :: n_entries
      if (code /= RIIS_OK) return
      if (n < 0) n = n_entries
      code = check_size(n_entries, n, name, 'entries in the array before it')
    end subroutine check
  end subroutine result_dense_int8

  !> Does the same with marks in another kind of integer, which are converted.
  subroutine result_dense_int32(this, mark, distance, triangle_id, leaflet_id, far_distance, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    integer(int32), intent(inout) :: mark(:)                !< (n_nodes): 1 for marked nodes, 0 for others.
    real(c_double), intent(inout), optional :: distance(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! far_distance.
    integer(int64), intent(inout), optional :: triangle_id(:) !< (n_nodes): for nodes within the distance limit, from
                                                            !! 0, else -1.
    integer(int32), intent(inout), optional :: leaflet_id(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! -1.
    real(c_double), intent(in), optional :: far_distance    !< Any value outside [0, distance_limit], NaN also. Default
                                                            !! RIIS_FAR_DISTANCE.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int8), allocatable :: bytes(:)
    integer(riis_status) :: code
    integer :: stat
    allocate (bytes(size(mark, kind=int64)), stat=stat)
    code = out_of_memory(stat)
    if (code == RIIS_OK) call this%dense_int8(bytes, distance, triangle_id, leaflet_id, far_distance, code)
    if (code == RIIS_OK) mark = bytes
    call finish(code, status)
  end subroutine result_dense_int32

  !> Does the same with logical marks, which are converted.
  subroutine result_dense_logical(this, mark, distance, triangle_id, leaflet_id, far_distance, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    logical, intent(inout) :: mark(:)                       !< (n_nodes): .true. for marked nodes.
    real(c_double), intent(inout), optional :: distance(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! far_distance.
    integer(int64), intent(inout), optional :: triangle_id(:) !< (n_nodes): for nodes within the distance limit, from
                                                            !! 0, else -1.
    integer(int32), intent(inout), optional :: leaflet_id(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! -1.
    real(c_double), intent(in), optional :: far_distance    !< Any value outside [0, distance_limit], NaN also. Default
                                                            !! RIIS_FAR_DISTANCE.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int8), allocatable :: bytes(:)
    integer(riis_status) :: code
    integer :: stat
    allocate (bytes(size(mark, kind=int64)), stat=stat)
    code = out_of_memory(stat)
    if (code == RIIS_OK) call this%dense_int8(bytes, distance, triangle_id, leaflet_id, far_distance, code)
    if (code == RIIS_OK) mark = bytes /= 0
    call finish(code, status)
  end subroutine result_dense_logical

  !> Points to the result's own fields of the marked nodes, in the order of %marked: no copy. Valid until the next
  !! riis_mark_nodes with the result or its destruction; not to be written to. On an error all sizes are 0.
  subroutine result_marked_fields(this, fields, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    type(riis_mark_fields), intent(inout) :: fields         !< Every component is set.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(c_mark_fields) :: made
    integer(riis_status) :: code
    code = check_created(this%handle, 'the result')
    if (code == RIIS_OK) code = riis_mark_result_marked_fields(this%handle, made, c_sizeof(made))
    if (code == RIIS_OK) then
      call point_to_fields(made, fields)
    else
      call point_to_fields(c_mark_fields(0, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, &
        c_null_ptr, c_null_ptr), fields)
    end if
    call finish(code, status)
  end subroutine result_marked_fields

  !> The same for all nodes within the distance limit, in the order of %within_limit.
  subroutine result_within_limit_fields(this, fields, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    type(riis_mark_fields), intent(inout) :: fields         !< Every component is set.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(c_mark_fields) :: made
    integer(riis_status) :: code
    code = check_created(this%handle, 'the result')
    if (code == RIIS_OK) code = riis_mark_result_within_limit_fields(this%handle, made, c_sizeof(made))
    if (code == RIIS_OK) then
      call point_to_fields(made, fields)
    else
      call point_to_fields(c_mark_fields(0, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, &
        c_null_ptr, c_null_ptr), fields)
    end if
    call finish(code, status)
  end subroutine result_within_limit_fields

  ! Points to what the library has; there is no address of a field that was not requested, nor in one of no nodes.
  subroutine point_to_fields(made, fields)
    type(c_mark_fields), intent(in) :: made
    type(riis_mark_fields), intent(inout) :: fields
    fields%n_nodes = made%n_nodes
    fields%point => no_vectors
    if (c_associated(made%point)) call c_f_pointer(made%point, fields%point, [3_int64, made%n_nodes])
    fields%normal => no_vectors
    if (c_associated(made%normal)) call c_f_pointer(made%normal, fields%normal, [3_int64, made%n_nodes])
    fields%barycentric => no_vectors
    if (c_associated(made%barycentric)) call c_f_pointer(made%barycentric, fields%barycentric, [3_int64, made%n_nodes])
    fields%velocity => no_vectors
    if (c_associated(made%velocity)) call c_f_pointer(made%velocity, fields%velocity, [3_int64, made%n_nodes])
    fields%uv => no_uv
    if (c_associated(made%uv)) call c_f_pointer(made%uv, fields%uv, [2_int64, made%n_nodes])
    fields%side => no_int32
    if (c_associated(made%side)) call c_f_pointer(made%side, fields%side, [made%n_nodes])
    fields%rim => no_int32
    if (c_associated(made%rim)) call c_f_pointer(made%rim, fields%rim, [made%n_nodes])
    fields%patch_id => no_int32
    if (c_associated(made%patch_id)) call c_f_pointer(made%patch_id, fields%patch_id, [made%n_nodes])
  end subroutine point_to_fields

  ! The resistance as the library takes it; does nothing after an error.
  subroutine get_resistance(resistance, half_thickness, rim, made, code)
    real(c_double), intent(in) :: resistance
    real(c_double), intent(in), optional :: half_thickness
    class(*), intent(in), optional :: rim
    type(riis_resistance), intent(inout) :: made
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK) code = riis_resistance_init(made, c_sizeof(made))
    made%resistance = resistance
    if (present(half_thickness)) made%half_thickness = half_thickness
    call get_integer(rim, 'rim', made%rim, code)
  end subroutine get_resistance

  ! A vector for each node: its shape is (3, n_nodes).
  function check_vectors(vectors, n, name) result(code)
    real(c_double), intent(in) :: vectors(:, :)
    integer(int64), intent(in) :: n
    character(len=*), intent(in) :: name
    integer(riis_status) :: code
    code = RIIS_OK
    if (size(vectors, 1) /= 3 .or. size(vectors, 2, int64) /= n) code = refuse('the shape of ' // name // ' is (' // &
      text_of(size(vectors, 1)) // ', ' // text_of(size(vectors, 2, int64)) // '); it must be (3, ' // text_of(n) // ')')
  end function check_vectors

  !> Adds the resistance K = (R / eps) delta(d), and K u_surface, to arrays of the caller's, so that several valves add up: a
  !! scheme takes (sum of K) u - (sum of K u_surface). delta(d) is (1 + cos(pi d / eps)) / (2 eps) at the distance d < eps.
  !! Errors: RIIS_INVALID_ARGUMENT for an argument out of range, another number of nodes, or a field that the result lacks;
  !! the arrays are then as they were.
  subroutine result_add_resistance(this, resistance, coefficient, momentum, half_thickness, rim, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    real(c_double), intent(in) :: resistance                !< R, 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(inout), optional :: coefficient(:) !< (n_nodes): K is added.
    real(c_double), intent(inout), optional :: momentum(:, :) !< (3, n_nodes): K u_surface is added; needs
                                                            !! RIIS_FIELD_VELOCITY.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(riis_resistance) :: made
    integer(int64) :: n
    integer(riis_status) :: code
    n = -1
    code = check_created(this%handle, 'the result')
    if (present(coefficient)) n = size(coefficient, kind=int64)
    if (code == RIIS_OK .and. present(momentum)) then
      if (n < 0) n = size(momentum, 2, int64)
      code = check_vectors(momentum, n, 'momentum')
    end if
    if (code == RIIS_OK .and. n < 0) code = refuse('none of coefficient and momentum is given')
    call get_resistance(resistance, half_thickness, rim, made, code)
    ! An absent array of rank 2 is not passed on: gfortran would compute its size for a copy, from bounds that nobody set.
    if (code == RIIS_OK) then
      if (present(momentum)) then
        code = riis_marks_add_resistance(this%handle, made, n, coefficient, momentum)
      else
        code = riis_marks_add_resistance(this%handle, made, n, coefficient)
      end if
    end if
    call finish(code, status)
  end subroutine result_add_resistance

  !> Adds the force of the flow on the surface, the sum of weight K (velocity - u_surface). Ranks add theirs by a reduction.
  !! u_surface counts where the marking had RIIS_FIELD_VELOCITY, and is 0 otherwise. Errors: as of %add_resistance.
  subroutine result_add_reaction(this, resistance, velocity, weight, force, half_thickness, rim, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    real(c_double), intent(in) :: resistance                !< R, 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(in) :: velocity(:, :) !< (3, n_nodes), of the flow.
    real(c_double), intent(in) :: weight(:)     !< (n_nodes), the volume that a node stands for; 0 for the nodes of
                                                            !! other ranks.
    real(c_double), intent(inout) :: force(:)               !< (3): added to.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(riis_resistance) :: made
    real(c_double) :: sum_of_forces(3)
    integer(int64) :: n
    integer(riis_status) :: code
    n = size(weight, kind=int64)
    code = check_created(this%handle, 'the result')
    if (code == RIIS_OK) code = check_vectors(velocity, n, 'velocity')
    if (code == RIIS_OK .and. size(force) /= 3) &
      code = refuse('the size of force is ' // text_of(size(force)) // '; it must be 3')
    call get_resistance(resistance, half_thickness, rim, made, code)
    if (code == RIIS_OK) then
      sum_of_forces = force
      code = riis_marks_add_reaction(this%handle, made, n, velocity, weight, sum_of_forces)
    end if
    if (code == RIIS_OK) force = sum_of_forces
    call finish(code, status)
  end subroutine result_add_reaction

  !> Sums a value, such as the pressure, over the nodes at a distance from inner to outer, by side. Nodes whose closest point
  !! is on the rim, or that are on neither side, are left out. With an open valve the two sides have no meaning. Errors:
  !! RIIS_INVALID_ARGUMENT for a distance out of range, another number of nodes, or a field that the result lacks.
  subroutine result_band_sums(this, inner, outer, value, weight, sums, status)
    class(riis_marks), intent(in) :: this             !< Of a call of riis_mark_nodes with RIIS_FIELD_SIDE + RIIS_FIELD_RIM.
    real(c_double), intent(in) :: inner                     !< Mesh units, from 0 to outer.
    real(c_double), intent(in) :: outer                     !< Mesh units, at most the distance limit of the marking.
    real(c_double), intent(in) :: value(:)      !< (n_nodes).
    real(c_double), intent(in) :: weight(:)     !< (n_nodes), the volume that a node stands for; 0 for the nodes of
                                                            !! other ranks.
    type(riis_band_sums), intent(inout) :: sums             !< Entry 1 is upstream, 2 downstream. Left alone on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int64) :: n
    integer(riis_status) :: code
    n = size(value, kind=int64)
    code = check_created(this%handle, 'the result')
    if (code == RIIS_OK) code = check_size(size(weight, kind=int64), n, 'weight', 'values')
    if (code == RIIS_OK) &
      code = riis_marks_get_band_sums(this%handle, inner, outer, n, value, weight, sums, c_sizeof(sums))
    call finish(code, status)
  end subroutine result_band_sums

  !> Tells how the last marking went.
  subroutine result_get_stats(this, stats, status)
    class(riis_marks), intent(in) :: this             !< From riis_mark_nodes.
    type(riis_mark_stats), intent(inout) :: stats           !< Left alone on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_created(this%handle, 'the result')
    if (code == RIIS_OK) code = riis_marks_get_stats(this%handle, stats, c_sizeof(stats))
    call finish(code, status)
  end subroutine result_get_stats

  !> Points to the result's own arrays of the edges that riis_find_leaks found last, ascending, without a copy. They are
  !! valid until the next riis_find_leaks or riis_mark_nodes with the result, or its destruction. Do not write to them.
  !! Without such edges, and on an error, their sizes are 0.
  subroutine result_leaking_edges(this, node_id, length, distance, status)
    class(riis_marks), intent(in) :: this             !< From riis_find_leaks.
    integer(int64), pointer, intent(out), optional :: node_id(:, :) !< (2, n), from 0: node_id + 1 are columns of xyz.
    real(c_double), pointer, intent(out), optional :: length(:) !< (n), mesh units.
    real(c_double), pointer, intent(out), optional :: distance(:) !< (n): the distance of its nearer node, mesh units.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(c_ptr) :: ids, lengths, distances
    integer(int64) :: n
    integer(riis_status) :: code
    n = 0
    ids = c_null_ptr
    lengths = c_null_ptr
    distances = c_null_ptr
    code = check_created(this%handle, 'the result')
    if (code == RIIS_OK) code = riis_mark_result_leaking_edges(this%handle, n, ids, lengths, distances)
    if (present(node_id)) then
      node_id => no_edges
      if (n > 0) call c_f_pointer(ids, node_id, [2_int64, n])
    end if
    if (present(length)) then
      length => no_reals
      if (n > 0) call c_f_pointer(lengths, length, [n])
    end if
    if (present(distance)) then
      distance => no_reals
      if (n > 0) call c_f_pointer(distances, distance, [n])
    end if
    call finish(code, status)
  end subroutine result_leaking_edges

  !> Tells whether the result was made by a marking and not destroyed.
  pure function result_is_created(this) result(is_created)
    class(riis_marks), intent(in) :: this             !< Any.
    logical :: is_created                                   !< .false. for an empty one.
    is_created = c_associated(this%handle)
  end function result_is_created

  !> Returns the C handle, for calls of module riis_c. It belongs to this variable: do not destroy it.
  function result_c_handle(this) result(handle)
    class(riis_marks), intent(in) :: this             !< Any.
    type(c_ptr) :: handle                                   !< c_null_ptr for an empty one.
    handle = this%handle
  end function result_c_handle

  !> Frees the memory of the result, which is then empty and can be used again. Nothing happens to an empty one.
  subroutine result_destroy(this)
    class(riis_marks), intent(inout) :: this          !< Any.
    call riis_marks_destroy(this%handle)
  end subroutine result_destroy

  !> Stops the program unless both are empty.
  impure elemental subroutine result_assign(left, right)
    class(riis_marks), intent(inout) :: left          !< Empty.
    class(riis_marks), intent(in) :: right            !< Empty.
    call refuse_copy(left%handle, right%handle, 'riis_marks')
  end subroutine result_assign
end module riis_marking
