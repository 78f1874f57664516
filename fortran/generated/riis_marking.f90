! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_marking.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Marking: riis_mark_* of riis.h, as a part of module riis.
module riis_marking
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_f_pointer, c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c, c_mark_nodes => riis_mark_nodes, c_mark_list => riis_mark_list
  use riis_support
  use riis_calls
  use riis_surfaces, only: riis_surface
  use riis_meshes, only: riis_mesh
  implicit none
  private
  public :: riis_marks, riis_mark_list, riis_mark_nodes

  !> Pointers to the arrays of a list, from %get_list. The marks own the arrays, which count from 1 and ascend by node. Ids count
  !! from 0: node_id + 1 is the column of xyz. An array that was not requested, or that the surface cannot give, has the size 0.
  type :: riis_mark_list
    integer(int64) :: n_nodes = 0                           !< The number of nodes.
    integer(int64), pointer :: node_id(:) => null()         !< (n_nodes).
    real(c_double), pointer :: distance(:) => null()        !< (n_nodes).
    integer(int64), pointer :: triangle_id(:) => null()     !< (n_nodes): of the closest triangle, as in riis_closest.
    integer(int32), pointer :: leaflet_id(:) => null()      !< (n_nodes): of that triangle.
    real(c_double), pointer :: K(:) => null()               !< (n_nodes): K, if the marking had R.
    real(c_double), pointer :: K_u_surface(:, :) => null()  !< (3, n_nodes): K u_surface.
    real(c_double), pointer :: point(:, :) => null()        !< (3, n_nodes): the closest point of the surface.
    real(c_double), pointer :: normal(:, :) => null()       !< (3, n_nodes): the unit normal of its triangle.
    real(c_double), pointer :: barycentric(:, :) => null()  !< (3, n_nodes): the closest point's weights for the vertices of its
                                                            !! triangle.
    real(c_double), pointer :: uv(:, :) => null()           !< (2, n_nodes): u and v of the closest point on its patch S(u,v), in
                                                            !! [0,1]. The vector S_u x S_v points along the normal. On mirrored
                                                            !! patches (cusps: patch_id % 4 >= 2; mitral: 3, 4, 5, 8, 9), this
                                                            !! vector points against the normal. With flip_normals, both
                                                            !! directions are reversed.
    real(c_double), pointer :: velocity(:, :) => null()     !< (3, n_nodes): the velocity of the surface at the closest point,
                                                            !! from the surface's last update. If several leaflets are equally
                                                            !! near (within 1e-6 half thicknesses), the velocity is the mean of
                                                            !! the velocities at their closest points (docs/theory/marks.md). The
                                                            !! same holds for several patches of one leaflet (within 1e-9 half
                                                            !! thicknesses). All other components come from the closest triangle.
    integer(int32), pointer :: side(:) => null()            !< (n_nodes): as riis_closest%side.
    integer(int32), pointer :: rim(:) => null()             !< (n_nodes): 1 if the closest point lies on the rim of the surface,
                                                            !! else 0. The rim of a valve consists of those sides of patches that
                                                            !! belong to only one patch, such as free edges and the annulus.
                                                            !! Where free edges of a closed valve coincide, they are not part of
                                                            !! the rim. The rim of a surface from arrays consists of the edges
                                                            !! that belong to only one triangle. Vertices with equal coordinates
                                                            !! count as one vertex.
    integer(int32), pointer :: patch_id(:) => null()        !< (n_nodes): as in riis_triangles.
    real(c_double), pointer :: distance_gradient(:, :) => null() !< (n_directions, n_nodes): the derivative of the distance in
                                                            !! each direction, which is -n.V. The unit vector n points from
                                                            !! the closest point to the node, and V is the rate of the
                                                            !! closest point in the triangle triangle_id. Nodes on the
                                                            !! surface get 0, because the distance has a kink there. The
                                                            !! distance also has a kink at nodes with several closest
                                                            !! points.
    real(c_double), pointer :: K_gradient(:, :) => null()   !< (n_directions, n_nodes): the derivative of K in each direction,
                                                            !! for constant R and half thickness. The derivative is 0 where K is
                                                            !! 0. If the surface has an offset, the unit vector n of a node on
                                                            !! the surface is the surface's normal. At a rim, the derivative then
                                                            !! includes the rotation of this normal.
    real(c_double), pointer :: height(:) => null()          !< (n_nodes): for a surface with an offset, the signed distance s of
                                                            !! riis_surface_create. If the closest point p is on a rim, the
                                                            !! height of a node x is n.(x - p) with the normal n.
  end type riis_mark_list

  !> The nodes that a marking found, with their distances. It is empty before riis_mark_nodes and after %destroy, which must be
  !! called. Use the same variable in every time step, because it keeps its memory. Any number of threads may read it at once. One
  !! thread may write it while no other reads it.
  type :: riis_marks
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, non_overridable :: n_marked => marks_n_marked           !< Returns the number of marked nodes.
    procedure, non_overridable :: n_within_limit => marks_n_within_limit !< Returns the number of nodes within the limit.
    procedure, non_overridable :: marked => marks_marked               !< Points to the arrays of the marked nodes.
    procedure, non_overridable :: within_limit => marks_within_limit   !< Points to the arrays of nodes within the limit.
    generic :: marked_nodes => marked_int32, marked_int64               !< Copies the marked nodes, counted from 1.
    generic :: nodes_within_limit => within_int32, within_int64         !< Copies the nodes within the limit, counted from 1.
    procedure, non_overridable :: get_list => marks_get_list            !< Points to all arrays of a list.
    generic :: add_resistance => add_resistance_vectors, &
      add_resistance_rank1, add_resistance_rank3, add_resistance_rank4
                                                                        !< Adds K and K u_surface to the caller's arrays.
    generic :: add_reaction => add_reaction_vectors, &
      add_reaction_rank1, add_reaction_rank3, add_reaction_rank4
                                                                        !< Adds the force of the flow on the surface.
    generic :: add_vertex_reaction => add_vertex_reaction_vectors, &
      add_vertex_reaction_rank1, add_vertex_reaction_rank3, add_vertex_reaction_rank4
                                                                        !< Adds the force on each vertex.
    generic :: band_sums => band_sums_rank1, band_sums_rank3, band_sums_rank4
                                                                        !< Sums a value on each side of the surface.
    generic :: dense => dense_int8, dense_int32, dense_logical          !< Writes one entry per node into the caller's arrays.
    procedure, non_overridable :: get_stats => marks_get_stats         !< Gives the statistics of the last marking.
    procedure, non_overridable :: is_created => marks_is_created        !< Returns whether the object was created.
    procedure, non_overridable :: c_handle => marks_c_handle            !< The handle for calls of riis_c.
    procedure, non_overridable :: destroy => marks_destroy              !< Frees its memory.
    generic :: assignment(=) => assign                                  !< Refused: a handle cannot be copied.
    procedure, private, non_overridable :: assign => marks_assign
    procedure, private, non_overridable :: marked_int32 => result_marked_int32
    procedure, private, non_overridable :: marked_int64 => result_marked_int64
    procedure, private, non_overridable :: within_int32 => result_within_int32
    procedure, private, non_overridable :: within_int64 => result_within_int64
    procedure, private, non_overridable :: add_resistance_vectors => marks_add_resistance_vectors
    procedure, private, non_overridable :: add_resistance_rank1 => marks_add_resistance_rank1
    procedure, private, non_overridable :: add_resistance_rank3 => marks_add_resistance_rank3
    procedure, private, non_overridable :: add_resistance_rank4 => marks_add_resistance_rank4
    procedure, private, non_overridable :: add_reaction_vectors => marks_add_reaction_vectors
    procedure, private, non_overridable :: add_reaction_rank1 => marks_add_reaction_rank1
    procedure, private, non_overridable :: add_reaction_rank3 => marks_add_reaction_rank3
    procedure, private, non_overridable :: add_reaction_rank4 => marks_add_reaction_rank4
    procedure, private, non_overridable :: add_vertex_reaction_vectors => marks_add_vertex_reaction_vectors
    procedure, private, non_overridable :: add_vertex_reaction_rank1 => marks_add_vertex_reaction_rank1
    procedure, private, non_overridable :: add_vertex_reaction_rank3 => marks_add_vertex_reaction_rank3
    procedure, private, non_overridable :: add_vertex_reaction_rank4 => marks_add_vertex_reaction_rank4
    procedure, private, non_overridable :: band_sums_rank1 => marks_band_sums_rank1
    procedure, private, non_overridable :: band_sums_rank3 => marks_band_sums_rank3
    procedure, private, non_overridable :: band_sums_rank4 => marks_band_sums_rank4
    procedure, private, non_overridable :: dense_int8 => marks_dense_int8
    procedure, private, non_overridable :: dense_int32 => marks_dense_int32
    procedure, private, non_overridable :: dense_logical => marks_dense_logical
  end type riis_marks

  !> Finds every node whose distance to the surface is at most the half thickness (marked) or the distance limit.
  interface riis_mark_nodes
    module procedure mark_nodes_logical
    module procedure mark_nodes_int8
    module procedure mark_nodes_int32
  end interface riis_mark_nodes

  ! A pointer without entries gets one of these targets, because size() of a null pointer is not defined.
  real(c_double), target, save :: no_reals(0), no_vectors(3, 0), no_uv(2, 0), no_gradients(0, 0)
  integer(int32), target, save :: no_int32(0)
  integer(int64), target, save :: no_int64(0)

contains

  !> Finds every node whose distance to the surface is at most the half thickness (marked) or the distance limit. The result
  !! replaces the marks' content, and earlier pointers to it become invalid. Errors: RIIS_INVALID_MESH for a coordinate that
  !! became non-finite without %update; RIIS_INVALID_ARGUMENT for an option out of range. The marks and pointers to them are then
  !! as they were.
  subroutine mark_nodes_logical(surface, mesh, marks, distance_limit, node_mask, search, n_threads, status, fields, R, &
      half_thickness, rim)
    class(riis_surface), intent(in) :: surface              !< Must be created. Calls on other threads may also use it.
    class(riis_mesh), intent(in) :: mesh                    !< Must be created. Calls on other threads may also use it.
    class(riis_marks), intent(inout) :: marks               !< Empty, or from an earlier call.
    real(c_double), intent(in), optional :: distance_limit  !< Nodes get their distance up to this limit, from the half thickness
                                                            !! to 1e60. Default RIIS_AUTO: the half thickness.
    logical, intent(in), optional :: node_mask(:)           !< (n_nodes): nodes with .false. are left out;
                                                            !! copied. Default: all nodes.
    class(*), intent(in), optional :: search                !< integer, RIIS_SEARCH_*. Default RIIS_SEARCH_AUTO.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    class(*), intent(in), optional :: fields                !< integer, a sum of RIIS_FIELD_*: the fields of the closest points in
                                                            !! a list. Default 0: none.
    real(c_double), intent(in), optional :: R               !< 0 to 1e60, mass / (length time): if given, a list has K and K
                                                            !! u_surface.
    real(c_double), intent(in), optional :: half_thickness  !< eps of K, at most the distance limit. Default RIIS_AUTO: the
                                                            !! surface's half thickness. Needs R.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND. Needs R.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call mark(surface, mesh, marks, distance_limit, bytes, search, n_threads, fields, R, half_thickness, rim, code)
    call finish(code, status)
  end subroutine mark_nodes_logical

  !> Implements riis_mark_nodes for a mask of bytes. Only a section that is not contiguous is copied.
  subroutine mark_nodes_int8(surface, mesh, marks, distance_limit, node_mask, search, n_threads, status, fields, R, &
      half_thickness, rim)
    class(riis_surface), intent(in) :: surface              !< Must be created. Calls on other threads may also use it.
    class(riis_mesh), intent(in) :: mesh                    !< Must be created. Calls on other threads may also use it.
    class(riis_marks), intent(inout) :: marks               !< Empty, or from an earlier call.
    real(c_double), intent(in), optional :: distance_limit  !< Nodes get their distance up to this limit, from the half thickness
                                                            !! to 1e60. Default RIIS_AUTO: the half thickness.
    integer(int8), intent(in), contiguous :: node_mask(:)   !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: search                !< integer, RIIS_SEARCH_*. Default RIIS_SEARCH_AUTO.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    class(*), intent(in), optional :: fields                !< integer, a sum of RIIS_FIELD_*: the fields of the closest points in
                                                            !! a list. Default 0: none.
    real(c_double), intent(in), optional :: R               !< 0 to 1e60, mass / (length time): if given, a list has K and K
                                                            !! u_surface.
    real(c_double), intent(in), optional :: half_thickness  !< eps of K, at most the distance limit. Default RIIS_AUTO: the
                                                            !! surface's half thickness. Needs R.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND. Needs R.
    integer(riis_status) :: code
    code = RIIS_OK
    call mark(surface, mesh, marks, distance_limit, node_mask, search, n_threads, fields, R, half_thickness, rim, code)
    call finish(code, status)
  end subroutine mark_nodes_int8

  !> Implements riis_mark_nodes for a mask of integers, which is copied.
  subroutine mark_nodes_int32(surface, mesh, marks, distance_limit, node_mask, search, n_threads, status, fields, R, &
      half_thickness, rim)
    class(riis_surface), intent(in) :: surface              !< Must be created. Calls on other threads may also use it.
    class(riis_mesh), intent(in) :: mesh                    !< Must be created. Calls on other threads may also use it.
    class(riis_marks), intent(inout) :: marks               !< Empty, or from an earlier call.
    real(c_double), intent(in), optional :: distance_limit  !< Nodes get their distance up to this limit, from the half thickness
                                                            !! to 1e60. Default RIIS_AUTO: the half thickness.
    integer(int32), intent(in) :: node_mask(:)              !< (n_nodes): nodes with 0 are left out.
    class(*), intent(in), optional :: search                !< integer, RIIS_SEARCH_*. Default RIIS_SEARCH_AUTO.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    class(*), intent(in), optional :: fields                !< integer, a sum of RIIS_FIELD_*: the fields of the closest points in
                                                            !! a list. Default 0: none.
    real(c_double), intent(in), optional :: R               !< 0 to 1e60, mass / (length time): if given, a list has K and K
                                                            !! u_surface.
    real(c_double), intent(in), optional :: half_thickness  !< eps of K, at most the distance limit. Default RIIS_AUTO: the
                                                            !! surface's half thickness. Needs R.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND. Needs R.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    code = RIIS_OK
    call get_mask(node_mask, bytes, code)
    call mark(surface, mesh, marks, distance_limit, bytes, search, n_threads, fields, R, half_thickness, rim, code)
    call finish(code, status)
  end subroutine mark_nodes_int32

  ! The common part of all specific procedures of riis_mark_nodes. It does nothing after an error.
  subroutine mark(surface, mesh, marks, distance_limit, mask, search, n_threads, fields, R, half_thickness, rim, code)
    class(riis_surface), intent(in) :: surface
    class(riis_mesh), intent(in) :: mesh
    class(riis_marks), intent(inout) :: marks
    real(c_double), intent(in), optional :: distance_limit
    integer(int8), intent(in), contiguous, optional, target :: mask(:)
    class(*), intent(in), optional :: search, n_threads, fields, rim
    real(c_double), intent(in), optional :: R, half_thickness
    integer(riis_status), intent(inout) :: code
    type(riis_mark_options) :: options
    type(riis_resistance), target :: resistance
    logical :: was_empty
    was_empty = .not. c_associated(marks%handle)
    if (code == RIIS_OK) code = check_created(surface%c_handle(), 'surface')
    if (code == RIIS_OK) code = check_created(mesh%c_handle(), 'mesh')
    if (code == RIIS_OK) code = riis_mark_options_init(options, c_sizeof(options))
    if (present(distance_limit)) options%distance_limit = distance_limit
    call get_integer(search, 'search', options%search, code)
    call get_integer(n_threads, 'n_threads', options%n_threads, code)
    call get_integer(fields, 'fields', options%fields, code)
    if (code == RIIS_OK .and. .not. present(R) .and. (present(half_thickness) .or. present(rim))) &
      code = refuse('half_thickness or rim is given, but R is not')
    if (present(R)) then
      call get_resistance(R, half_thickness, rim, resistance, code)
      options%resistance = c_loc(resistance)
    end if
    if (code == RIIS_OK .and. present(mask)) then
      code = check_size(size(mask, kind=int64), mesh%n_nodes(), 'node_mask', 'nodes')
      if (size(mask, kind=int64) > 0) options%node_mask = c_loc(mask)
    end if
    if (code == RIIS_OK .and. was_empty) code = riis_marks_create(marks%handle)
    if (code == RIIS_OK) code = c_mark_nodes(surface%c_handle(), mesh%c_handle(), options, marks%handle)
    if (code /= RIIS_OK .and. was_empty) call riis_marks_destroy(marks%handle) ! the marks were empty before the call and stay so
  end subroutine mark

  !> Returns the number of marked nodes.
  function marks_n_marked(this, status) result(n)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: n                                     !< 0 on an error.
    type(c_mark_list) :: list
    n = 0
    code = c_list(this, RIIS_LIST_MARKED, list)
    if (code == RIIS_OK) n = list%n_nodes
    call finish(code, status)
  end function marks_n_marked

  !> Returns the number of nodes within the distance limit, marked or not.
  function marks_n_within_limit(this, status) result(n)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: n                                     !< 0 on an error.
    type(c_mark_list) :: list
    n = 0
    code = c_list(this, RIIS_LIST_WITHIN_LIMIT, list)
    if (code == RIIS_OK) n = list%n_nodes
    call finish(code, status)
  end function marks_n_within_limit

  ! Gets the library's list of the marked nodes, or of the nodes within the limit. On an error the list is empty.
  function c_list(this, which, list) result(code)
    class(riis_marks), intent(in) :: this
    integer(int32), intent(in) :: which
    type(c_mark_list), intent(out) :: list
    integer(riis_status) :: code
    list = c_mark_list(0, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, &
      c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, 0, c_null_ptr, c_null_ptr, c_null_ptr)
    code = check_created(this%handle, 'the object marks')
    if (code == RIIS_OK) code = riis_marks_get_list(this%handle, which, list, c_sizeof(list))
  end function c_list

  ! Points to a list's arrays. A list without nodes has no address.
  subroutine point_to(list, node_id, distance, triangle_id, leaflet_id)
    type(c_mark_list), intent(in) :: list
    integer(int64), pointer, intent(out), optional :: node_id(:), triangle_id(:)
    real(c_double), pointer, intent(out), optional :: distance(:)
    integer(int32), pointer, intent(out), optional :: leaflet_id(:)
    if (present(node_id)) then
      node_id => no_int64
      if (list%n_nodes > 0) call c_f_pointer(list%node_id, node_id, [list%n_nodes])
    end if
    if (present(distance)) then
      distance => no_reals
      if (list%n_nodes > 0) call c_f_pointer(list%distance, distance, [list%n_nodes])
    end if
    if (present(triangle_id)) then
      triangle_id => no_int64
      if (list%n_nodes > 0) call c_f_pointer(list%triangle_id, triangle_id, [list%n_nodes])
    end if
    if (present(leaflet_id)) then
      leaflet_id => no_int32
      if (list%n_nodes > 0) call c_f_pointer(list%leaflet_id, leaflet_id, [list%n_nodes])
    end if
  end subroutine point_to

  !> Points to the marks' own arrays of marked nodes, ascending by node, without a copy. They are valid until the next
  !! riis_mark_nodes with these marks or their destruction. Do not write to them. If there are no marked nodes, and on an error,
  !! their sizes are 0.
  subroutine marks_marked(this, node_id, distance, triangle_id, leaflet_id, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(int64), pointer, intent(out), optional :: node_id(:) !< (n), ascending, from 0: node_id + 1 is the column of xyz.
    real(c_double), pointer, intent(out), optional :: distance(:) !< (n), mesh units.
    integer(int64), pointer, intent(out), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), pointer, intent(out), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_mark_list) :: list
    code = c_list(this, RIIS_LIST_MARKED, list)
    call point_to(list, node_id, distance, triangle_id, leaflet_id)
    call finish(code, status)
  end subroutine marks_marked

  !> Points to the arrays of all nodes within the distance limit, as %marked does for the marked nodes.
  subroutine marks_within_limit(this, node_id, distance, triangle_id, leaflet_id, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(int64), pointer, intent(out), optional :: node_id(:) !< (n), ascending, from 0: node_id + 1 is the column of xyz.
    real(c_double), pointer, intent(out), optional :: distance(:) !< (n), mesh units.
    integer(int64), pointer, intent(out), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), pointer, intent(out), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_mark_list) :: list
    code = c_list(this, RIIS_LIST_WITHIN_LIMIT, list)
    call point_to(list, node_id, distance, triangle_id, leaflet_id)
    call finish(code, status)
  end subroutine marks_within_limit

  !> Copies the arrays of marked nodes, ascending by node. The copies do not depend on the marks any more. Each array is allocated
  !! to exactly the needed size, which may be 0, unless it has that size already. Errors: RIIS_LIMIT_EXCEEDED for a node number
  !! too large for integer(int32); the arrays are unchanged on an error.
  subroutine result_marked_int32(this, node_num, distance, triangle_id, leaflet_id, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(int32), allocatable, intent(inout) :: node_num(:)  !< (n), ascending, from 1: the column of xyz.
    real(c_double), allocatable, intent(inout), optional :: distance(:) !< (n), mesh units.
    integer(int64), allocatable, intent(inout), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), allocatable, intent(inout), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_mark_list) :: list
    integer(int64), pointer :: ids(:)
    integer :: stat
    code = c_list(this, RIIS_LIST_MARKED, list)
    call point_to(list, ids)
    if (code == RIIS_OK .and. list%n_nodes > 0) then
      if (ids(list%n_nodes) >= huge(node_num)) code = fail(RIIS_LIMIT_EXCEEDED, 'node ' // text_of(ids(list%n_nodes)) // &
        ' is more than an integer(int32) can count: use integer(int64)')
    end if
    if (code == RIIS_OK) then
      if (allocated(node_num)) then
        if (size(node_num, kind=int64) /= list%n_nodes) deallocate (node_num)
      end if
      stat = 0
      if (.not. allocated(node_num)) allocate (node_num(list%n_nodes), stat=stat)
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
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(int64), allocatable, intent(inout) :: node_num(:)  !< (n), ascending, from 1: the column of xyz.
    real(c_double), allocatable, intent(inout), optional :: distance(:) !< (n), mesh units.
    integer(int64), allocatable, intent(inout), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), allocatable, intent(inout), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_mark_list) :: list
    integer(int64), pointer :: ids(:)
    integer :: stat
    code = c_list(this, RIIS_LIST_MARKED, list)
    call point_to(list, ids)
    if (code == RIIS_OK) then
      if (allocated(node_num)) then
        if (size(node_num, kind=int64) /= list%n_nodes) deallocate (node_num)
      end if
      stat = 0
      if (.not. allocated(node_num)) allocate (node_num(list%n_nodes), stat=stat)
      code = out_of_memory(stat)
    end if
    if (code == RIIS_OK) then
      node_num = int(ids + 1, int64)
      code = copy_list(list, distance, triangle_id, leaflet_id)
    end if
    call finish(code, status)
  end subroutine result_marked_int64

  !> Copies the arrays of all nodes within the distance limit, as %marked_nodes does for the marked nodes.
  subroutine result_within_int32(this, node_num, distance, triangle_id, leaflet_id, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(int32), allocatable, intent(inout) :: node_num(:)  !< (n), ascending, from 1: the column of xyz.
    real(c_double), allocatable, intent(inout), optional :: distance(:) !< (n), mesh units.
    integer(int64), allocatable, intent(inout), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), allocatable, intent(inout), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_mark_list) :: list
    integer(int64), pointer :: ids(:)
    integer :: stat
    code = c_list(this, RIIS_LIST_WITHIN_LIMIT, list)
    call point_to(list, ids)
    if (code == RIIS_OK .and. list%n_nodes > 0) then
      if (ids(list%n_nodes) >= huge(node_num)) code = fail(RIIS_LIMIT_EXCEEDED, 'node ' // text_of(ids(list%n_nodes)) // &
        ' is more than an integer(int32) can count: use integer(int64)')
    end if
    if (code == RIIS_OK) then
      if (allocated(node_num)) then
        if (size(node_num, kind=int64) /= list%n_nodes) deallocate (node_num)
      end if
      stat = 0
      if (.not. allocated(node_num)) allocate (node_num(list%n_nodes), stat=stat)
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
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(int64), allocatable, intent(inout) :: node_num(:)  !< (n), ascending, from 1: the column of xyz.
    real(c_double), allocatable, intent(inout), optional :: distance(:) !< (n), mesh units.
    integer(int64), allocatable, intent(inout), optional :: triangle_id(:) !< (n), from 0: the closest triangle.
    integer(int32), allocatable, intent(inout), optional :: leaflet_id(:) !< (n): RIIS_LEAFLET_*, or the caller's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_mark_list) :: list
    integer(int64), pointer :: ids(:)
    integer :: stat
    code = c_list(this, RIIS_LIST_WITHIN_LIMIT, list)
    call point_to(list, ids)
    if (code == RIIS_OK) then
      if (allocated(node_num)) then
        if (size(node_num, kind=int64) /= list%n_nodes) deallocate (node_num)
      end if
      stat = 0
      if (.not. allocated(node_num)) allocate (node_num(list%n_nodes), stat=stat)
      code = out_of_memory(stat)
    end if
    if (code == RIIS_OK) then
      node_num = int(ids + 1, int64)
      code = copy_list(list, distance, triangle_id, leaflet_id)
    end if
    call finish(code, status)
  end subroutine result_within_int64

  ! Copies all arrays but node_num.
  function copy_list(list, distance, triangle_id, leaflet_id) result(code)
    type(c_mark_list), intent(in) :: list
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
        if (size(distance, kind=int64) /= list%n_nodes) deallocate (distance)
      end if
      if (.not. allocated(distance)) allocate (distance(list%n_nodes), stat=stat)
      if (stat == 0) distance = distances
    end if
    if (present(triangle_id) .and. stat == 0) then
      if (allocated(triangle_id)) then
        if (size(triangle_id, kind=int64) /= list%n_nodes) deallocate (triangle_id)
      end if
      if (.not. allocated(triangle_id)) allocate (triangle_id(list%n_nodes), stat=stat)
      if (stat == 0) triangle_id = triangles
    end if
    if (present(leaflet_id) .and. stat == 0) then
      if (allocated(leaflet_id)) then
        if (size(leaflet_id, kind=int64) /= list%n_nodes) deallocate (leaflet_id)
      end if
      if (.not. allocated(leaflet_id)) allocate (leaflet_id(list%n_nodes), stat=stat)
      if (stat == 0) leaflet_id = leaflets
    end if
    code = out_of_memory(stat)
  end function copy_list

  !> Writes one entry per node into the arrays that are present. Each has the size of the mesh's number of nodes. For sections
  !! that are not contiguous, the compiler makes copies in both directions. Errors: RIIS_INVALID_ARGUMENT for another size, or for
  !! a far_distance within the distance limit; nothing is then written.
  subroutine marks_dense_int8(this, mark, distance, triangle_id, leaflet_id, far_distance, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(int8), intent(inout), optional :: mark(:) !< (n_nodes): 1 for marked nodes, 0 for others; not copied.
    real(c_double), intent(inout), optional :: distance(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! far_distance.
    integer(int64), intent(inout), optional :: triangle_id(:) !< (n_nodes): for nodes within the distance limit, from
                                                            !! 0, else -1.
    integer(int32), intent(inout), optional :: leaflet_id(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! -1.
    real(c_double), intent(in), optional :: far_distance    !< Any value outside [0, distance_limit], including NaN. Default
                                                            !! RIIS_FAR_DISTANCE.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    real(c_double) :: far
    integer(int64) :: n
    n = -1
    far = RIIS_FAR_DISTANCE
    if (present(far_distance)) far = far_distance
    code = check_created(this%handle, 'the object marks')
    if (present(mark)) n = size(mark, kind=int64)
    ! The first array determines the size, which the library compares with the mesh.
    if (code == RIIS_OK .and. present(distance)) then
      if (n < 0) n = size(distance, kind=int64)
      code = check_size(size(distance, kind=int64), n, 'distance', 'entries in the array before it')
    end if
    if (code == RIIS_OK .and. present(triangle_id)) then
      if (n < 0) n = size(triangle_id, kind=int64)
      code = check_size(size(triangle_id, kind=int64), n, 'triangle_id', 'entries in the array before it')
    end if
    if (code == RIIS_OK .and. present(leaflet_id)) then
      if (n < 0) n = size(leaflet_id, kind=int64)
      code = check_size(size(leaflet_id, kind=int64), n, 'leaflet_id', 'entries in the array before it')
    end if
    if (code == RIIS_OK .and. n < 0) code = refuse('none of mark, distance, triangle_id and leaflet_id is given')
    if (code == RIIS_OK) code = write_dense(this%handle, n, far, mark, distance, triangle_id, leaflet_id)
    call finish(code, status)
  end subroutine marks_dense_int8

  !> Implements %dense for marks of another integer kind, which are converted.
  subroutine marks_dense_int32(this, mark, distance, triangle_id, leaflet_id, far_distance, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(int32), intent(inout) :: mark(:)                !< (n_nodes): 1 for marked nodes, 0 for others.
    real(c_double), intent(inout), optional :: distance(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! far_distance.
    integer(int64), intent(inout), optional :: triangle_id(:) !< (n_nodes): for nodes within the distance limit, from
                                                            !! 0, else -1.
    integer(int32), intent(inout), optional :: leaflet_id(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! -1.
    real(c_double), intent(in), optional :: far_distance    !< Any value outside [0, distance_limit], including NaN. Default
                                                            !! RIIS_FAR_DISTANCE.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    integer :: stat
    allocate (bytes(size(mark, kind=int64)), stat=stat)
    code = out_of_memory(stat)
    if (code == RIIS_OK) call this%dense_int8(bytes, distance, triangle_id, leaflet_id, far_distance, code)
    if (code == RIIS_OK) mark = bytes
    call finish(code, status)
  end subroutine marks_dense_int32

  !> Implements %dense for logical marks, which are converted.
  subroutine marks_dense_logical(this, mark, distance, triangle_id, leaflet_id, far_distance, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    logical, intent(inout) :: mark(:)                       !< (n_nodes): .true. for marked nodes.
    real(c_double), intent(inout), optional :: distance(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! far_distance.
    integer(int64), intent(inout), optional :: triangle_id(:) !< (n_nodes): for nodes within the distance limit, from
                                                            !! 0, else -1.
    integer(int32), intent(inout), optional :: leaflet_id(:) !< (n_nodes): for nodes within the distance limit, else
                                                            !! -1.
    real(c_double), intent(in), optional :: far_distance    !< Any value outside [0, distance_limit], including NaN. Default
                                                            !! RIIS_FAR_DISTANCE.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    integer :: stat
    allocate (bytes(size(mark, kind=int64)), stat=stat)
    code = out_of_memory(stat)
    if (code == RIIS_OK) call this%dense_int8(bytes, distance, triangle_id, leaflet_id, far_distance, code)
    if (code == RIIS_OK) mark = bytes /= 0
    call finish(code, status)
  end subroutine marks_dense_logical

  !> Points to all arrays of a list, without a copy. They are valid until the next riis_mark_nodes with these marks or their
  !! destruction. Do not write to them. On an error all sizes are 0.
  subroutine marks_get_list(this, which, list, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    integer(int32), intent(in) :: which                     !< RIIS_LIST_*.
    type(riis_mark_list), intent(inout) :: list             !< Every component is set.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_mark_list) :: made
    code = c_list(this, which, made)
    list = riis_mark_list(0, no_int64, no_reals, no_int64, no_int32, no_reals, no_vectors, no_vectors, no_vectors, no_vectors, &
      no_uv, no_vectors, no_int32, no_int32, no_int32, no_gradients, no_gradients, no_reals)
    list%n_nodes = made%n_nodes
    if (c_associated(made%node_id)) call c_f_pointer(made%node_id, list%node_id, [made%n_nodes])
    if (c_associated(made%distance)) call c_f_pointer(made%distance, list%distance, [made%n_nodes])
    if (c_associated(made%triangle_id)) call c_f_pointer(made%triangle_id, list%triangle_id, [made%n_nodes])
    if (c_associated(made%leaflet_id)) call c_f_pointer(made%leaflet_id, list%leaflet_id, [made%n_nodes])
    if (c_associated(made%K)) call c_f_pointer(made%K, list%K, [made%n_nodes])
    if (c_associated(made%K_u_surface)) call c_f_pointer(made%K_u_surface, list%K_u_surface, [3_int64, made%n_nodes])
    if (c_associated(made%point)) call c_f_pointer(made%point, list%point, [3_int64, made%n_nodes])
    if (c_associated(made%normal)) call c_f_pointer(made%normal, list%normal, [3_int64, made%n_nodes])
    if (c_associated(made%barycentric)) call c_f_pointer(made%barycentric, list%barycentric, [3_int64, made%n_nodes])
    if (c_associated(made%uv)) call c_f_pointer(made%uv, list%uv, [2_int64, made%n_nodes])
    if (c_associated(made%velocity)) call c_f_pointer(made%velocity, list%velocity, [3_int64, made%n_nodes])
    if (c_associated(made%side)) call c_f_pointer(made%side, list%side, [made%n_nodes])
    if (c_associated(made%rim)) call c_f_pointer(made%rim, list%rim, [made%n_nodes])
    if (c_associated(made%patch_id)) call c_f_pointer(made%patch_id, list%patch_id, [made%n_nodes])
    if (c_associated(made%distance_gradient)) call c_f_pointer(made%distance_gradient, list%distance_gradient, &
      [made%n_directions, made%n_nodes])
    if (c_associated(made%K_gradient)) call c_f_pointer(made%K_gradient, list%K_gradient, [made%n_directions, &
      made%n_nodes])
    if (c_associated(made%height)) call c_f_pointer(made%height, list%height, [made%n_nodes])
    call finish(code, status)
  end subroutine marks_get_list

  ! Checks three arrays with an entry for each node. It does nothing after an error.
  subroutine check_components(sizes, n, names, of, code)
    integer(int64), intent(in) :: sizes(3), n
    character(len=*), intent(in) :: names(3), of
    integer(riis_status), intent(inout) :: code
    integer :: i
    do i = 1, 3
      if (code == RIIS_OK) code = check_size(sizes(i), n, names(i), of)
    end do
  end subroutine check_components

  !> Adds the resistance K = (R / eps) delta(d), and K u_surface, to the caller's arrays, so that several valves add up. A scheme
  !! uses (sum of K) u - (sum of K u_surface). delta(d) is (1 + cos(pi d / eps)) / (2 eps) at the distance d < eps. Errors:
  !! RIIS_INVALID_ARGUMENT for an argument out of range, another number of nodes, or a field that the marks lack; the arrays are
  !! then as they were.
  subroutine marks_add_resistance_vectors(this, R, K, K_u_surface, half_thickness, rim, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(inout), optional :: K(:)         !< (n_nodes): K is added.
    real(c_double), intent(inout), optional :: K_u_surface(:, :) !< (3, n_nodes): K u_surface is added; needs
                                                            !! RIIS_FIELD_VELOCITY.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    integer(int64) :: n
    n = -1
    code = check_created(this%handle, 'the object marks')
    if (present(K)) n = size(K, kind=int64)
    if (code == RIIS_OK .and. present(K_u_surface)) then
      if (n < 0) n = size(K_u_surface, 2, int64)
      call check_columns(K_u_surface, 3, n, 'K_u_surface', code)
    end if
    if (code == RIIS_OK .and. n < 0) code = refuse('none of K and K_u_surface is given')
    call get_resistance(R, half_thickness, rim, made, code)
    ! An absent array of rank 2 is not passed on, because gfortran would use its undefined bounds to compute the size of a copy.
    if (code == RIIS_OK) then
      if (present(K_u_surface)) then
        code = add_resistance_to(this%handle, made, n, K, K_u_surface)
      else
        code = add_resistance_to(this%handle, made, n, K)
      end if
    end if
    call finish(code, status)
  end subroutine marks_add_resistance_vectors

  !> Does the same for solvers with K u_surface in three arrays. Arrays of rank 3 or 4 are also taken, as whole arrays in the
  !! order of the mesh's nodes; then K alone may be given. A section that is not contiguous is copied.
  subroutine marks_add_resistance_rank1(this, R, K, K_u_x, K_u_y, K_u_z, half_thickness, rim, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes with RIIS_FIELD_VELOCITY.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(inout) :: K(:) !< (n_nodes): K is added.
    real(c_double), intent(inout) :: K_u_x(:) !< (n_nodes): K u_surface is added.
    real(c_double), intent(inout) :: K_u_y(:) !< (n_nodes): K u_surface is added.
    real(c_double), intent(inout) :: K_u_z(:) !< (n_nodes): K u_surface is added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    integer(int64) :: n
    n = size(K, kind=int64)
    code = check_created(this%handle, 'the object marks')
    call check_components([size(K_u_x, kind=int64), size(K_u_y, kind=int64), size(K_u_z, kind=int64)], n, &
      ['K_u_x', 'K_u_y', 'K_u_z'], 'entries in K', code)
    call get_resistance(R, half_thickness, rim, made, code)
    if (code == RIIS_OK) code = add_resistance_to(this%handle, made, n, K, K_u_x=K_u_x, K_u_y=K_u_y, K_u_z=K_u_z)
    call finish(code, status)
  end subroutine marks_add_resistance_rank1

  !> Implements %add_resistance for arrays of rank 3.
  subroutine marks_add_resistance_rank3(this, R, K, K_u_x, K_u_y, K_u_z, half_thickness, rim, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes with RIIS_FIELD_VELOCITY.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(inout) :: K(:, :, :) !< (n_nodes): K is added.
    real(c_double), intent(inout), optional :: K_u_x(:, :, :) !< (n_nodes): K u_surface is added.
    real(c_double), intent(inout), optional :: K_u_y(:, :, :) !< (n_nodes): K u_surface is added.
    real(c_double), intent(inout), optional :: K_u_z(:, :, :) !< (n_nodes): K u_surface is added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    integer(int64) :: n
    n = size(K, kind=int64)
    code = check_created(this%handle, 'the object marks')
    if (.not. (present(K_u_x) .and. present(K_u_y) .and. present(K_u_z))) then
      if (code == RIIS_OK .and. (present(K_u_x) .or. present(K_u_y) .or. present(K_u_z))) &
        code = refuse('K_u_x, K_u_y and K_u_z are not all given')
      call get_resistance(R, half_thickness, rim, made, code)
      if (code == RIIS_OK) code = add_resistance_to(this%handle, made, n, K)
      call finish(code, status)
      return
    end if
    call check_components([size(K_u_x, kind=int64), size(K_u_y, kind=int64), size(K_u_z, kind=int64)], n, &
      ['K_u_x', 'K_u_y', 'K_u_z'], 'entries in K', code)
    call get_resistance(R, half_thickness, rim, made, code)
    if (code == RIIS_OK) code = add_resistance_to(this%handle, made, n, K, K_u_x=K_u_x, K_u_y=K_u_y, K_u_z=K_u_z)
    call finish(code, status)
  end subroutine marks_add_resistance_rank3

  !> Implements %add_resistance for arrays of rank 4.
  subroutine marks_add_resistance_rank4(this, R, K, K_u_x, K_u_y, K_u_z, half_thickness, rim, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes with RIIS_FIELD_VELOCITY.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(inout) :: K(:, :, :, :) !< (n_nodes): K is added.
    real(c_double), intent(inout), optional :: K_u_x(:, :, :, :) !< (n_nodes): K u_surface is added.
    real(c_double), intent(inout), optional :: K_u_y(:, :, :, :) !< (n_nodes): K u_surface is added.
    real(c_double), intent(inout), optional :: K_u_z(:, :, :, :) !< (n_nodes): K u_surface is added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    integer(int64) :: n
    n = size(K, kind=int64)
    code = check_created(this%handle, 'the object marks')
    if (.not. (present(K_u_x) .and. present(K_u_y) .and. present(K_u_z))) then
      if (code == RIIS_OK .and. (present(K_u_x) .or. present(K_u_y) .or. present(K_u_z))) &
        code = refuse('K_u_x, K_u_y and K_u_z are not all given')
      call get_resistance(R, half_thickness, rim, made, code)
      if (code == RIIS_OK) code = add_resistance_to(this%handle, made, n, K)
      call finish(code, status)
      return
    end if
    call check_components([size(K_u_x, kind=int64), size(K_u_y, kind=int64), size(K_u_z, kind=int64)], n, &
      ['K_u_x', 'K_u_y', 'K_u_z'], 'entries in K', code)
    call get_resistance(R, half_thickness, rim, made, code)
    if (code == RIIS_OK) code = add_resistance_to(this%handle, made, n, K, K_u_x=K_u_x, K_u_y=K_u_y, K_u_z=K_u_z)
    call finish(code, status)
  end subroutine marks_add_resistance_rank4

  !> Adds the force of the flow on the surface and its moment, for the whole surface, for each leaflet and for each edge. The
  !! force of a node is weight * K * (velocity - u_surface), and acts at the closest point of the surface. u_surface is used if
  !! the marking had RIIS_FIELD_VELOCITY, and is 0 otherwise. Moments and the sums of edges need RIIS_FIELD_POINT. The sums of
  !! edges are loads for tissue codes. They do not model how a membrane carries loads to its edges. Ranks pass the same point and
  !! edges, and add their sums by a reduction. Errors: as for %add_resistance; RIIS_INVALID_ARGUMENT also for too few leaflets,
  !! for a leaflet without an edge, and for a bad edge.
  subroutine marks_add_reaction_vectors(this, R, velocity, weight, force, half_thickness, rim, moment, about, &
      leaflet_force, leaflet_moment, edges, edge_force, edge_moment, edge_leaflet_id, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(in) :: velocity(:, :)            !< (3, n_nodes), the flow's velocity.
    real(c_double), intent(in) :: weight(:)                 !< (n_nodes), the volume that belongs to a node; 0 for nodes of
                                                            !! other ranks.
    real(c_double), intent(inout), optional :: force(:)     !< (3): the force is added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    real(c_double), intent(inout), optional :: moment(:)    !< (3): the moment is added.
    real(c_double), intent(in), optional :: about(:)        !< (3): the point of moment and leaflet_moment. Default 0.
    real(c_double), intent(inout), optional :: leaflet_force(:, :) !< (3, n_leaflets): forces are added. n_leaflets is above
                                                            !! the surface's largest leaflet id; leaflet 0 has column 1.
    real(c_double), intent(inout), optional :: leaflet_moment(:, :) !< (3, n_leaflets): moments are added.
    real(c_double), intent(in), optional :: edges(:, :, :)  !< (3, 2, n_edges): both ends of each edge, as from
                                                            !! %get_attachment.
    real(c_double), intent(inout), optional :: edge_force(:, :) !< (3, n_edges): forces are added. A node's force goes to
                                                            !! the edge nearest to its closest point, or to the first
                                                            !! of several equally near edges.
    real(c_double), intent(inout), optional :: edge_moment(:, :) !< (3, n_edges): moments about each edge's middle are added.
    integer(int32), intent(in), optional :: edge_leaflet_id(:) !< (n_edges): a node's force goes to the nearest edge of
                                                            !! its leaflet. Default: the nearest edge of all leaflets.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: n
    n = size(weight, kind=int64)
    code = check_created(this%handle, 'the object marks')
    call check_columns(velocity, 3, n, 'velocity', code)
    call react(this%handle, R, n, weight, force, half_thickness, rim, moment, about, leaflet_force, leaflet_moment, edges, &
      edge_force, edge_moment, edge_leaflet_id, code, velocity=velocity)
    call finish(code, status)
  end subroutine marks_add_reaction_vectors

  !> Does the same for solvers with the velocity in three arrays. Arrays of rank 3 or 4 are also taken, as by %add_resistance.
  subroutine marks_add_reaction_rank1(this, R, vx, vy, vz, weight, force, half_thickness, rim, moment, about, &
      leaflet_force, leaflet_moment, edges, edge_force, edge_moment, edge_leaflet_id, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(in) :: vx(:) !< (n_nodes), the x component of the flow's velocity.
    real(c_double), intent(in) :: vy(:) !< (n_nodes), the y component of the flow's velocity.
    real(c_double), intent(in) :: vz(:) !< (n_nodes), the z component of the flow's velocity.
    real(c_double), intent(in) :: weight(:) !< (n_nodes), the volume that belongs to a node; 0 for nodes
                                                            !! of other ranks.
    real(c_double), intent(inout), optional :: force(:)     !< (3): the force is added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    real(c_double), intent(inout), optional :: moment(:)    !< (3): the moment is added.
    real(c_double), intent(in), optional :: about(:)        !< (3): the point of moment and leaflet_moment. Default 0.
    real(c_double), intent(inout), optional :: leaflet_force(:, :) !< (3, n_leaflets): forces are added. n_leaflets is above
                                                            !! the surface's largest leaflet id; leaflet 0 has column 1.
    real(c_double), intent(inout), optional :: leaflet_moment(:, :) !< (3, n_leaflets): moments are added.
    real(c_double), intent(in), optional :: edges(:, :, :)  !< (3, 2, n_edges): both ends of each edge, as from
                                                            !! %get_attachment.
    real(c_double), intent(inout), optional :: edge_force(:, :) !< (3, n_edges): forces are added. A node's force goes to
                                                            !! the edge nearest to its closest point, or to the first
                                                            !! of several equally near edges.
    real(c_double), intent(inout), optional :: edge_moment(:, :) !< (3, n_edges): moments about each edge's middle are added.
    integer(int32), intent(in), optional :: edge_leaflet_id(:) !< (n_edges): a node's force goes to the nearest edge of
                                                            !! its leaflet. Default: the nearest edge of all leaflets.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: n
    n = size(weight, kind=int64)
    code = check_created(this%handle, 'the object marks')
    call check_components([size(vx, kind=int64), size(vy, kind=int64), size(vz, kind=int64)], n, ['vx', 'vy', 'vz'], &
      'weights', code)
    call react(this%handle, R, n, weight, force, half_thickness, rim, moment, about, leaflet_force, leaflet_moment, edges, &
      edge_force, edge_moment, edge_leaflet_id, code, vx=vx, vy=vy, vz=vz)
    call finish(code, status)
  end subroutine marks_add_reaction_rank1

  !> Implements %add_reaction for arrays of rank 3.
  subroutine marks_add_reaction_rank3(this, R, vx, vy, vz, weight, force, half_thickness, rim, moment, about, &
      leaflet_force, leaflet_moment, edges, edge_force, edge_moment, edge_leaflet_id, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(in) :: vx(:, :, :) !< (n_nodes), the x component of the flow's velocity.
    real(c_double), intent(in) :: vy(:, :, :) !< (n_nodes), the y component of the flow's velocity.
    real(c_double), intent(in) :: vz(:, :, :) !< (n_nodes), the z component of the flow's velocity.
    real(c_double), intent(in) :: weight(:, :, :) !< (n_nodes), the volume that belongs to a node; 0 for nodes
                                                            !! of other ranks.
    real(c_double), intent(inout), optional :: force(:)     !< (3): the force is added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    real(c_double), intent(inout), optional :: moment(:)    !< (3): the moment is added.
    real(c_double), intent(in), optional :: about(:)        !< (3): the point of moment and leaflet_moment. Default 0.
    real(c_double), intent(inout), optional :: leaflet_force(:, :) !< (3, n_leaflets): forces are added. n_leaflets is above
                                                            !! the surface's largest leaflet id; leaflet 0 has column 1.
    real(c_double), intent(inout), optional :: leaflet_moment(:, :) !< (3, n_leaflets): moments are added.
    real(c_double), intent(in), optional :: edges(:, :, :)  !< (3, 2, n_edges): both ends of each edge, as from
                                                            !! %get_attachment.
    real(c_double), intent(inout), optional :: edge_force(:, :) !< (3, n_edges): forces are added. A node's force goes to
                                                            !! the edge nearest to its closest point, or to the first
                                                            !! of several equally near edges.
    real(c_double), intent(inout), optional :: edge_moment(:, :) !< (3, n_edges): moments about each edge's middle are added.
    integer(int32), intent(in), optional :: edge_leaflet_id(:) !< (n_edges): a node's force goes to the nearest edge of
                                                            !! its leaflet. Default: the nearest edge of all leaflets.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: n
    n = size(weight, kind=int64)
    code = check_created(this%handle, 'the object marks')
    call check_components([size(vx, kind=int64), size(vy, kind=int64), size(vz, kind=int64)], n, ['vx', 'vy', 'vz'], &
      'weights', code)
    call react(this%handle, R, n, weight, force, half_thickness, rim, moment, about, leaflet_force, leaflet_moment, edges, &
      edge_force, edge_moment, edge_leaflet_id, code, vx=vx, vy=vy, vz=vz)
    call finish(code, status)
  end subroutine marks_add_reaction_rank3

  !> Implements %add_reaction for arrays of rank 4.
  subroutine marks_add_reaction_rank4(this, R, vx, vy, vz, weight, force, half_thickness, rim, moment, about, &
      leaflet_force, leaflet_moment, edges, edge_force, edge_moment, edge_leaflet_id, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(in) :: vx(:, :, :, :) !< (n_nodes), the x component of the flow's velocity.
    real(c_double), intent(in) :: vy(:, :, :, :) !< (n_nodes), the y component of the flow's velocity.
    real(c_double), intent(in) :: vz(:, :, :, :) !< (n_nodes), the z component of the flow's velocity.
    real(c_double), intent(in) :: weight(:, :, :, :) !< (n_nodes), the volume that belongs to a node; 0 for nodes
                                                            !! of other ranks.
    real(c_double), intent(inout), optional :: force(:)     !< (3): the force is added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    real(c_double), intent(inout), optional :: moment(:)    !< (3): the moment is added.
    real(c_double), intent(in), optional :: about(:)        !< (3): the point of moment and leaflet_moment. Default 0.
    real(c_double), intent(inout), optional :: leaflet_force(:, :) !< (3, n_leaflets): forces are added. n_leaflets is above
                                                            !! the surface's largest leaflet id; leaflet 0 has column 1.
    real(c_double), intent(inout), optional :: leaflet_moment(:, :) !< (3, n_leaflets): moments are added.
    real(c_double), intent(in), optional :: edges(:, :, :)  !< (3, 2, n_edges): both ends of each edge, as from
                                                            !! %get_attachment.
    real(c_double), intent(inout), optional :: edge_force(:, :) !< (3, n_edges): forces are added. A node's force goes to
                                                            !! the edge nearest to its closest point, or to the first
                                                            !! of several equally near edges.
    real(c_double), intent(inout), optional :: edge_moment(:, :) !< (3, n_edges): moments about each edge's middle are added.
    integer(int32), intent(in), optional :: edge_leaflet_id(:) !< (n_edges): a node's force goes to the nearest edge of
                                                            !! its leaflet. Default: the nearest edge of all leaflets.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: n
    n = size(weight, kind=int64)
    code = check_created(this%handle, 'the object marks')
    call check_components([size(vx, kind=int64), size(vy, kind=int64), size(vz, kind=int64)], n, ['vx', 'vy', 'vz'], &
      'weights', code)
    call react(this%handle, R, n, weight, force, half_thickness, rim, moment, about, leaflet_force, leaflet_moment, edges, &
      edge_force, edge_moment, edge_leaflet_id, code, vx=vx, vy=vy, vz=vz)
    call finish(code, status)
  end subroutine marks_add_reaction_rank4

  ! The common part of all specific procedures of add_reaction. It does nothing after an error.
  subroutine react(handle, R, n, weight, force, half_thickness, rim, moment, about, leaflet_force, leaflet_moment, edges, &
      edge_force, edge_moment, edge_leaflet_id, code, velocity, vx, vy, vz)
    type(c_ptr), intent(in) :: handle
    integer(int64), intent(in) :: n
    real(c_double), intent(in) :: R, weight(*)
    real(c_double), intent(inout), optional :: force(:), moment(:), leaflet_force(:, :), leaflet_moment(:, :), &
      edge_force(:, :), edge_moment(:, :)
    real(c_double), intent(in), optional :: half_thickness, about(:), edges(:, :, :), velocity(3, *), vx(*), vy(*), vz(*)
    class(*), intent(in), optional :: rim
    integer(int32), intent(in), optional :: edge_leaflet_id(:)
    integer(riis_status), intent(inout) :: code
    type(riis_resistance) :: made
    type(riis_reaction) :: to
    ! The library needs contiguous sums and edges, so it gets copies of the caller's arrays.
    real(c_double), target :: own_force(3), own_moment(3)
    real(c_double), pointer, contiguous :: own_leaflet_force(:, :), own_leaflet_moment(:, :), own_edge_force(:, :), &
      own_edge_moment(:, :)
    real(c_double), allocatable, target :: own_edges(:, :, :)
    integer(int32), allocatable, target :: own_edge_leaflet_id(:)
    integer(int64) :: n_leaflets, n_edges
    n_leaflets = 0
    n_edges = 0
    if (present(force)) call check_three(size(force, kind=int64), 'force', code)
    if (present(moment)) call check_three(size(moment, kind=int64), 'moment', code)
    if (present(about)) call check_three(size(about, kind=int64), 'about', code)
    if (present(leaflet_force)) n_leaflets = size(leaflet_force, 2, int64)
    if (present(leaflet_moment) .and. .not. present(leaflet_force)) n_leaflets = size(leaflet_moment, 2, int64)
    if (present(leaflet_force)) call check_columns(leaflet_force, 3, n_leaflets, 'leaflet_force', code)
    if (present(leaflet_moment)) call check_columns(leaflet_moment, 3, n_leaflets, 'leaflet_moment', code)
    if (present(edges)) then
      n_edges = size(edges, 3, int64)
      if (code == RIIS_OK .and. (size(edges, 1) /= 3 .or. size(edges, 2) /= 2)) code = refuse('the shape of edges is (' // &
        text_of(size(edges, 1)) // ', ' // text_of(size(edges, 2)) // ', ' // text_of(n_edges) // &
        '); it must be (3, 2, n_edges)')
    end if
    if (present(edge_force)) call check_columns(edge_force, 3, n_edges, 'edge_force', code)
    if (present(edge_moment)) call check_columns(edge_moment, 3, n_edges, 'edge_moment', code)
    if (code == RIIS_OK .and. present(edge_leaflet_id)) &
      code = check_size(size(edge_leaflet_id, kind=int64), n_edges, 'edge_leaflet_id', 'edges')
    call get_resistance(R, half_thickness, rim, made, code)
    if (code == RIIS_OK) code = riis_reaction_init(to, c_sizeof(to))
    if (code /= RIIS_OK) return
    if (present(about)) to%about = about
    to%n_leaflets = n_leaflets
    to%n_edges = n_edges
    if (present(force)) then
      own_force = force
      to%force = location_of(own_force)
    end if
    if (present(moment)) then
      own_moment = moment
      to%moment = location_of(own_moment)
    end if
    own_leaflet_force => no_vectors
    if (present(leaflet_force)) then
      allocate (own_leaflet_force, source=leaflet_force)
      to%leaflet_force = location_of(own_leaflet_force)
    end if
    own_leaflet_moment => no_vectors
    if (present(leaflet_moment)) then
      allocate (own_leaflet_moment, source=leaflet_moment)
      to%leaflet_moment = location_of(own_leaflet_moment)
    end if
    own_edge_force => no_vectors
    if (present(edge_force)) then
      allocate (own_edge_force, source=edge_force)
      to%edge_force = location_of(own_edge_force)
    end if
    own_edge_moment => no_vectors
    if (present(edge_moment)) then
      allocate (own_edge_moment, source=edge_moment)
      to%edge_moment = location_of(own_edge_moment)
    end if
    if (present(edges)) then
      allocate (own_edges, source=edges)
      to%edges = location_of(own_edges)
    end if
    if (present(edge_leaflet_id)) then
      allocate (own_edge_leaflet_id, source=edge_leaflet_id)
      to%edge_leaflet_id = location_of(own_edge_leaflet_id)
    end if
    code = add_reaction_to(handle, made, n, weight, to, velocity, vx, vy, vz)
    if (code == RIIS_OK) then
      if (present(force)) force = own_force
      if (present(moment)) moment = own_moment
      if (present(leaflet_force)) leaflet_force = own_leaflet_force
      if (present(leaflet_moment)) leaflet_moment = own_leaflet_moment
      if (present(edge_force)) edge_force = own_edge_force
      if (present(edge_moment)) edge_moment = own_edge_moment
    end if
    if (present(leaflet_force)) deallocate (own_leaflet_force)
    if (present(leaflet_moment)) deallocate (own_leaflet_moment)
    if (present(edge_force)) deallocate (own_edge_force)
    if (present(edge_moment)) deallocate (own_edge_moment)
  end subroutine react

  !> Adds the force of the flow on each vertex of the surface, so that a code for shells can move the leaflets. The force of a
  !! node goes to the vertices of its closest triangle, in the shares of the closest point's barycentric coordinates. Ranks add
  !! their forces by a reduction. Errors: as for %add_reaction; RIIS_INVALID_ARGUMENT also for another number of vertices, and for
  !! a surface that lacks the closest triangle of a node.
  subroutine marks_add_vertex_reaction_vectors(this, surface, R, velocity, weight, vertex_force, half_thickness, rim, &
      status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes with RIIS_FIELD_BARYCENTRIC.
    class(riis_surface), intent(in) :: surface              !< The surface of the marking, without an update since then.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(in) :: velocity(:, :)            !< (3, n_nodes), the flow's velocity.
    real(c_double), intent(in) :: weight(:)                 !< (n_nodes), the volume that belongs to a node; 0 for nodes of
                                                            !! other ranks.
    real(c_double), intent(inout) :: vertex_force(:, :)     !< (3, n_vertices): forces are added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    integer(int64) :: n
    n = size(weight, kind=int64)
    code = check_created(this%handle, 'the object marks')
    call check_columns(velocity, 3, n, 'velocity', code)
    if (code == RIIS_OK) code = check_created(surface%c_handle(), 'the surface')
    call check_columns(vertex_force, 3, size(vertex_force, 2, int64), 'vertex_force', code)
    call get_resistance(R, half_thickness, rim, made, code)
    if (code == RIIS_OK) code = add_vertex_reaction_to(this%handle, surface%c_handle(), made, n, weight, &
      size(vertex_force, 2, int64), vertex_force, velocity=velocity)
    call finish(code, status)
  end subroutine marks_add_vertex_reaction_vectors

  !> Does the same for solvers with the velocity in three arrays. Arrays of rank 3 or 4 are also taken, as by %add_resistance.
  subroutine marks_add_vertex_reaction_rank1(this, surface, R, vx, vy, vz, weight, vertex_force, half_thickness, rim, &
      status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes with RIIS_FIELD_BARYCENTRIC.
    class(riis_surface), intent(in) :: surface              !< The surface of the marking, without an update since then.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(in) :: vx(:) !< (n_nodes), the x component of the flow's velocity.
    real(c_double), intent(in) :: vy(:) !< (n_nodes), the y component of the flow's velocity.
    real(c_double), intent(in) :: vz(:) !< (n_nodes), the z component of the flow's velocity.
    real(c_double), intent(in) :: weight(:) !< (n_nodes), the volume that belongs to a node; 0 for nodes
                                                            !! of other ranks.
    real(c_double), intent(inout) :: vertex_force(:, :)     !< (3, n_vertices): forces are added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    integer(int64) :: n
    n = size(weight, kind=int64)
    code = check_created(this%handle, 'the object marks')
    call check_components([size(vx, kind=int64), size(vy, kind=int64), size(vz, kind=int64)], n, ['vx', 'vy', 'vz'], &
      'weights', code)
    if (code == RIIS_OK) code = check_created(surface%c_handle(), 'the surface')
    call check_columns(vertex_force, 3, size(vertex_force, 2, int64), 'vertex_force', code)
    call get_resistance(R, half_thickness, rim, made, code)
    if (code == RIIS_OK) code = add_vertex_reaction_to(this%handle, surface%c_handle(), made, n, weight, &
      size(vertex_force, 2, int64), vertex_force, vx=vx, vy=vy, vz=vz)
    call finish(code, status)
  end subroutine marks_add_vertex_reaction_rank1

  !> Implements %add_vertex_reaction for arrays of rank 3.
  subroutine marks_add_vertex_reaction_rank3(this, surface, R, vx, vy, vz, weight, vertex_force, half_thickness, rim, &
      status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes with RIIS_FIELD_BARYCENTRIC.
    class(riis_surface), intent(in) :: surface              !< The surface of the marking, without an update since then.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(in) :: vx(:, :, :) !< (n_nodes), the x component of the flow's velocity.
    real(c_double), intent(in) :: vy(:, :, :) !< (n_nodes), the y component of the flow's velocity.
    real(c_double), intent(in) :: vz(:, :, :) !< (n_nodes), the z component of the flow's velocity.
    real(c_double), intent(in) :: weight(:, :, :) !< (n_nodes), the volume that belongs to a node; 0 for nodes
                                                            !! of other ranks.
    real(c_double), intent(inout) :: vertex_force(:, :)     !< (3, n_vertices): forces are added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    integer(int64) :: n
    n = size(weight, kind=int64)
    code = check_created(this%handle, 'the object marks')
    call check_components([size(vx, kind=int64), size(vy, kind=int64), size(vz, kind=int64)], n, ['vx', 'vy', 'vz'], &
      'weights', code)
    if (code == RIIS_OK) code = check_created(surface%c_handle(), 'the surface')
    call check_columns(vertex_force, 3, size(vertex_force, 2, int64), 'vertex_force', code)
    call get_resistance(R, half_thickness, rim, made, code)
    if (code == RIIS_OK) code = add_vertex_reaction_to(this%handle, surface%c_handle(), made, n, weight, &
      size(vertex_force, 2, int64), vertex_force, vx=vx, vy=vy, vz=vz)
    call finish(code, status)
  end subroutine marks_add_vertex_reaction_rank3

  !> Implements %add_vertex_reaction for arrays of rank 4.
  subroutine marks_add_vertex_reaction_rank4(this, surface, R, vx, vy, vz, weight, vertex_force, half_thickness, rim, &
      status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes with RIIS_FIELD_BARYCENTRIC.
    class(riis_surface), intent(in) :: surface              !< The surface of the marking, without an update since then.
    real(c_double), intent(in) :: R                         !< 0 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(in) :: vx(:, :, :, :) !< (n_nodes), the x component of the flow's velocity.
    real(c_double), intent(in) :: vy(:, :, :, :) !< (n_nodes), the y component of the flow's velocity.
    real(c_double), intent(in) :: vz(:, :, :, :) !< (n_nodes), the z component of the flow's velocity.
    real(c_double), intent(in) :: weight(:, :, :, :) !< (n_nodes), the volume that belongs to a node; 0 for nodes
                                                            !! of other ranks.
    real(c_double), intent(inout) :: vertex_force(:, :)     !< (3, n_vertices): forces are added.
    real(c_double), intent(in), optional :: half_thickness  !< eps, at most the distance limit of the marking. Default
                                                            !! RIIS_AUTO: the half thickness of the marking.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND; RIIS_RIM_CUT needs
                                                            !! RIIS_FIELD_RIM.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    integer(int64) :: n
    n = size(weight, kind=int64)
    code = check_created(this%handle, 'the object marks')
    call check_components([size(vx, kind=int64), size(vy, kind=int64), size(vz, kind=int64)], n, ['vx', 'vy', 'vz'], &
      'weights', code)
    if (code == RIIS_OK) code = check_created(surface%c_handle(), 'the surface')
    call check_columns(vertex_force, 3, size(vertex_force, 2, int64), 'vertex_force', code)
    call get_resistance(R, half_thickness, rim, made, code)
    if (code == RIIS_OK) code = add_vertex_reaction_to(this%handle, surface%c_handle(), made, n, weight, &
      size(vertex_force, 2, int64), vertex_force, vx=vx, vy=vy, vz=vz)
    call finish(code, status)
  end subroutine marks_add_vertex_reaction_rank4

  ! Refuses a vector of another size. Does nothing after an error.
  subroutine check_three(n, name, code)
    integer(int64), intent(in) :: n
    character(len=*), intent(in) :: name
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK .and. n /= 3) code = refuse('the size of ' // name // ' is ' // text_of(n) // '; it must be 3')
  end subroutine check_three

  !> Sums a value, such as the pressure, over the nodes at a distance from inner to outer, separately for each side. Nodes whose
  !! closest point is on the rim, or that are on neither side, are left out. If the valve is open, the two sides have no meaning.
  !! Errors: RIIS_INVALID_ARGUMENT for a distance out of range, another number of nodes, or a field that the marks lack.
  subroutine marks_band_sums_rank1(this, inner, outer, value, weight, sums, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes with RIIS_FIELD_SIDE + RIIS_FIELD_RIM.
    real(c_double), intent(in) :: inner                     !< Mesh units, from 0 to outer.
    real(c_double), intent(in) :: outer                     !< Mesh units, at most the distance limit of the marking.
    real(c_double), intent(in) :: value(:) !< (n_nodes).
    real(c_double), intent(in) :: weight(:) !< (n_nodes), the volume that belongs to a node; 0 for nodes of
                                                            !! other ranks.
    type(riis_band_sums), intent(inout) :: sums             !< Entry 1 is upstream, 2 downstream. Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: n
    n = size(value, kind=int64)
    code = check_created(this%handle, 'the object marks')
    if (code == RIIS_OK) code = check_size(size(weight, kind=int64), n, 'weight', 'values')
    if (code == RIIS_OK) &
      code = band_sums_of(this%handle, inner, outer, n, value, weight, sums)
    call finish(code, status)
  end subroutine marks_band_sums_rank1

  !> Implements %band_sums for arrays of rank 3.
  subroutine marks_band_sums_rank3(this, inner, outer, value, weight, sums, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes with RIIS_FIELD_SIDE + RIIS_FIELD_RIM.
    real(c_double), intent(in) :: inner                     !< Mesh units, from 0 to outer.
    real(c_double), intent(in) :: outer                     !< Mesh units, at most the distance limit of the marking.
    real(c_double), intent(in) :: value(:, :, :) !< (n_nodes).
    real(c_double), intent(in) :: weight(:, :, :) !< (n_nodes), the volume that belongs to a node; 0 for nodes of
                                                            !! other ranks.
    type(riis_band_sums), intent(inout) :: sums             !< Entry 1 is upstream, 2 downstream. Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: n
    n = size(value, kind=int64)
    code = check_created(this%handle, 'the object marks')
    if (code == RIIS_OK) code = check_size(size(weight, kind=int64), n, 'weight', 'values')
    if (code == RIIS_OK) &
      code = band_sums_of(this%handle, inner, outer, n, value, weight, sums)
    call finish(code, status)
  end subroutine marks_band_sums_rank3

  !> Implements %band_sums for arrays of rank 4.
  subroutine marks_band_sums_rank4(this, inner, outer, value, weight, sums, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes with RIIS_FIELD_SIDE + RIIS_FIELD_RIM.
    real(c_double), intent(in) :: inner                     !< Mesh units, from 0 to outer.
    real(c_double), intent(in) :: outer                     !< Mesh units, at most the distance limit of the marking.
    real(c_double), intent(in) :: value(:, :, :, :) !< (n_nodes).
    real(c_double), intent(in) :: weight(:, :, :, :) !< (n_nodes), the volume that belongs to a node; 0 for nodes of
                                                            !! other ranks.
    type(riis_band_sums), intent(inout) :: sums             !< Entry 1 is upstream, 2 downstream. Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: n
    n = size(value, kind=int64)
    code = check_created(this%handle, 'the object marks')
    if (code == RIIS_OK) code = check_size(size(weight, kind=int64), n, 'weight', 'values')
    if (code == RIIS_OK) &
      code = band_sums_of(this%handle, inner, outer, n, value, weight, sums)
    call finish(code, status)
  end subroutine marks_band_sums_rank4

  !> Gives the statistics of the last marking.
  subroutine marks_get_stats(this, stats, status)
    class(riis_marks), intent(in) :: this                   !< From riis_mark_nodes.
    type(riis_mark_stats), intent(inout) :: stats           !< Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_created(this%handle, 'the object marks')
    if (code == RIIS_OK) code = riis_marks_get_stats(this%handle, stats, c_sizeof(stats))
    call finish(code, status)
  end subroutine marks_get_stats

  !> Returns whether the marks were made by a marking and not destroyed.
  pure function marks_is_created(this) result(is_created)
    class(riis_marks), intent(in) :: this                   !< May be empty.
    logical :: is_created                                   !< .false. for an empty one.
    is_created = c_associated(this%handle)
  end function marks_is_created

  !> Returns the C handle, for calls of module riis_c. The handle belongs to this variable, so do not destroy the handle.
  function marks_c_handle(this) result(handle)
    class(riis_marks), intent(in) :: this                   !< May be empty.
    type(c_ptr) :: handle                                   !< c_null_ptr for an empty one.
    handle = this%handle
  end function marks_c_handle

  !> Frees the memory of the marks, which are then empty and can be used again. Nothing happens to an empty one.
  subroutine marks_destroy(this)
    class(riis_marks), intent(inout) :: this                !< May be empty.
    call riis_marks_destroy(this%handle)
  end subroutine marks_destroy

  !> Stops the program unless both objects are empty.
  impure elemental subroutine marks_assign(left, right)
    class(riis_marks), intent(inout) :: left                !< Must be empty.
    class(riis_marks), intent(in) :: right                  !< Must be empty.
    call refuse_copy(left%handle, right%handle, 'riis_marks')
  end subroutine marks_assign
end module riis_marking
