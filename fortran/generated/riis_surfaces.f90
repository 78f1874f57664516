! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_surfaces.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Surfaces and closest points: riis_surface_* and riis_closest_* of riis.h, as a part of module riis.
module riis_surfaces
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_f_pointer, c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c, c_attachment => riis_attachment, c_triangles => riis_triangles
  use riis_support
  use riis_frames, only: riis_keyframes
  use riis_valves, only: riis_valve
  implicit none
  private
  public :: riis_surface, riis_triangles, riis_attachment

  !> Pointers to the triangles of a surface, after placement, from %get_triangles. The surface owns the arrays, which count from
  !! 1. Ids count from 0: vertex_id + 1 are columns of xyz. An array that the surface lacks has the size 0.
  type :: riis_triangles
    real(c_double), pointer :: xyz(:, :) => null()          !< (3, n_vertices): the vertices.
    real(c_double), pointer :: uv(:, :) => null()           !< (2, n_vertices): each vertex's u and v on its patch, in [0,1].
    real(c_double), pointer :: velocity(:, :) => null()     !< (3, n_vertices): each vertex's velocity. Where closed cusps meet,
                                                            !! each vertex has the velocity of its own cusp.
    integer(int64), pointer :: vertex_id(:, :) => null()    !< (3, n_triangles): the vertices of each triangle.
    integer(int64), pointer :: triangle_id(:) => null()     !< (n_triangles), ascending: the ids of the triangles in results of
                                                            !! queries; 0, 1, 2, ... for a valve.
    integer(int32), pointer :: leaflet_id(:) => null()      !< (n_triangles): RIIS_LEAFLET_*, or the caller's leaflet_id if the
                                                            !! surface comes from patches or arrays.
    integer(int32), pointer :: patch_id(:) => null()        !< (n_triangles): the number of the patch. In a surface from arrays,
                                                            !! leaflets have 0 and a skirt has 1. Patches of the caller are
                                                            !! numbered from 0. In a valve of n cusps, the bottom of the cusp
                                                            !! with leaflet_id i has 4 i, and the top 4 i + 1. The mirror images
                                                            !! of bottom and top have 4 i + 2 and 4 i + 3. In a fused part, each
                                                            !! of these ids is 4 n larger. In the anterior mitral leaflet, the
                                                            !! triangle at the posteromedial commissure has 0, the side has 1,
                                                            !! and the middle has 2. The mirror images of 2, 1 and 0 have 3, 4
                                                            !! and 5. In the posterior mitral leaflet, a side scallop has 6, and
                                                            !! half of the middle scallop has 7. The mirror images of 7 and 6
                                                            !! have 8 and 9. In a bileaflet valve, the halves of leaflet i have 2
                                                            !! i and 2 i + 1, and the quarters of the ring have 4 to 7. A patch
                                                            !! of a skirt has the id of the leaflet's patch that it continues,
                                                            !! plus the number of patch ids of the leaflets. This number is 10
                                                            !! for mitral, and 12 for three cusps without a fused commissure.
  end type riis_triangles

  !> Pointers to the attachment of a valve's surface, by %get_attachment. The surface owns the arrays, which count from 1. Ids
  !! count from 0.
  type :: riis_attachment
    real(c_double), pointer :: edges(:, :, :) => null()     !< (3, 2, n_edges): both ends of each edge, after placement.
    integer(int64), pointer :: vertex_id(:, :) => null()    !< (2, n_edges): the vertices at the ends, in riis_triangles%xyz.
    integer(int32), pointer :: leaflet_id(:) => null()      !< (n_edges): the leaflet that is attached there.
    integer(int32), pointer :: patch_id(:) => null()        !< (n_edges): the patch of this leaflet, as in riis_triangles.
  end type riis_attachment

  !> A surface of triangles with a half thickness, which answers closest-point queries. It borrows nothing from the caller. It is
  !! empty before %create or %create_from_arrays and after %destroy. Call %destroy, since nothing else frees it. Any number of
  !! threads may read it at once. One thread may write it while no other reads it.
  !!
  !! The placement, x -> scale * rotation * x + translation, is applied last, to valves and to arrays. Options that are passed to
  !! an update replace the surface's options. Other options stay as they were.
  type :: riis_surface
    private
    type(c_ptr) :: handle = c_null_ptr
    type(riis_surface_options) :: options ! the options in use; defined if there is a handle
  contains
    procedure, non_overridable :: create => surface_create              !< Makes the surface of a valve.
    generic :: create_from_arrays => create_xyz_int32, create_xyz_int64, create_x_y_z_int32, create_x_y_z_int64
                                                               !< Makes a surface from the caller's triangles or quads.
    procedure, non_overridable :: update => surface_update              !< Replaces the surface when the valve has moved.
    procedure, non_overridable :: update_moving => surface_update_moving !< Updates with the velocity of every vertex.
    procedure, non_overridable :: add_direction => surface_add_direction !< Adds a direction for the derivatives of distances.
    procedure, non_overridable :: get_direction => surface_get_direction !< Points to the rates of the vertices in a direction.
    generic :: update_from_arrays => update_xyz_int32, update_xyz_int64, update_x_y_z_int32, update_x_y_z_int64
                                                               !< Replaces it when the triangles or quads have moved.
    procedure, non_overridable :: create_from_keyframes => surface_create_from_keyframes !< Makes a surface from frames, at a
                                                                                         !! time.
    procedure, non_overridable :: update_from_keyframes => surface_update_from_keyframes !< Replaces it by the surface at another
                                                                                         !! time.
    procedure, non_overridable :: get_info => surface_get_info          !< Gives counts, bounds, area and times.
    procedure, non_overridable :: get_triangles => surface_get_triangles !< Points to the vertices and triangles.
    procedure, non_overridable :: get_attachment => surface_get_attachment !< Points to the edges where leaflets are attached.
    procedure, non_overridable :: closest_point => surface_closest_point !< Finds the closest point to one point.
    generic :: closest_points => closest_xyz_logical, closest_xyz_int8, closest_x_y_z_logical, closest_x_y_z_int8
                                                               !< Finds the closest points to many points, in parallel.
    procedure, non_overridable :: is_created => surface_is_created      !< Returns whether the object was created.
    procedure, non_overridable :: c_handle => surface_c_handle          !< The handle for calls of riis_c.
    procedure, non_overridable :: destroy => surface_destroy            !< Frees its memory.
    generic :: assignment(=) => assign                                  !< Refused: a handle cannot be copied.
    procedure, private, non_overridable :: assign => surface_assign
    procedure, private, non_overridable :: create_xyz_int32 => surface_create_from_arrays_xyz_int32
    procedure, private, non_overridable :: create_xyz_int64 => surface_create_from_arrays_xyz_int64
    procedure, private, non_overridable :: create_x_y_z_int32 => surface_create_from_arrays_x_y_z_int32
    procedure, private, non_overridable :: create_x_y_z_int64 => surface_create_from_arrays_x_y_z_int64
    procedure, private, non_overridable :: update_xyz_int32 => surface_update_from_arrays_xyz_int32
    procedure, private, non_overridable :: update_xyz_int64 => surface_update_from_arrays_xyz_int64
    procedure, private, non_overridable :: update_x_y_z_int32 => surface_update_from_arrays_x_y_z_int32
    procedure, private, non_overridable :: update_x_y_z_int64 => surface_update_from_arrays_x_y_z_int64
    procedure, private, non_overridable :: closest_xyz_logical => surface_closest_points_xyz_logical
    procedure, private, non_overridable :: closest_xyz_int8 => surface_closest_points_xyz_int8
    procedure, private, non_overridable :: closest_x_y_z_logical => surface_closest_points_x_y_z_logical
    procedure, private, non_overridable :: closest_x_y_z_int8 => surface_closest_points_x_y_z_int8
  end type riis_surface

  ! A pointer without entries gets one of these targets, because size() of a null pointer is not defined.
  real(c_double), target, save :: no_points(3, 0), no_uv(2, 0)
  integer(int32), target, save :: no_int32(0)
  real(c_double), target, save :: no_edges(3, 2, 0)
  integer(int64), target, save :: no_pairs(2, 0)
  integer(int64), target, save :: no_int64(0), no_corners(3, 0)

contains

  !> Makes the surface of a valve: curves, Coons patches, triangles, Embree scene. Normals point downstream. Errors:
  !! RIIS_INVALID_ARGUMENT for an option out of range; RIIS_INVALID_PARAMETER for parameters that do not fit together;
  !! RIIS_LIMIT_EXCEEDED if the tolerance needs more than 16,777,216 triangles, or does not hold for a fixed triangulation.
  subroutine surface_create(this, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
      flip_normals, status, measure, measure_tolerance, n_threads, triangulation, offset)
    class(riis_surface), intent(inout) :: this              !< Must be empty.
    class(riis_valve), intent(in) :: valve                  !< Must be created; read during the call only.
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units, 1e-50 to 1e50: nodes within it are marked.
                                                            !! Default RIIS_AUTO: 0.1 * scale.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1, default 0.05. The error of distances is at most
                                                            !! tolerance * half_thickness. Not used by surfaces from arrays.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12. Default 1.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), at least 1e-50 long. Default (0, 0, 1).
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees, counter-clockwise seen against the axis. Default 0.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units. Default 0.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle. Default .false.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int32), intent(in), optional :: measure         !< RIIS_MEASURE_*: how distances are measured from now on. Default
                                                            !! RIIS_MEASURE_TRIANGLES.
    real(c_double), intent(in), optional :: measure_tolerance !< For the other methods: a fraction of half_thickness, 1e-6 to
                                                            !! 1. Default RIIS_AUTO: tolerance.
    integer(int32), intent(in), optional :: n_threads       !< The number of threads that make the surface from now on: 1 to 1024.
                                                            !! Default 0: as many as make it faster.
    integer(int32), intent(in), optional :: triangulation   !< RIIS_TRIANGULATION_*, from now on. With RIIS_TRIANGULATION_FIXED,
                                                            !! triangles keep their ids, vertices and neighbours at every opening,
                                                            !! and only opening and placement may change. Default
                                                            !! RIIS_TRIANGULATION_ADAPTED.
    real(c_double), intent(in), optional :: offset          !< By how many half thicknesses the band steps aside along the
                                                            !! normals, above -1 and below 1. Default 0.
    integer(riis_status) :: code
    type(riis_surface_options) :: options
    code = RIIS_OK
    call create_options(this, options, code)
    if (code == RIIS_OK) code = check_created(valve%c_handle(), 'valve')
    call set_options(options, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
      flip_normals, code, measure, measure_tolerance, n_threads, triangulation, offset=offset)
    if (code == RIIS_OK) code = riis_surface_create(valve%c_handle(), options, this%handle)
    if (code == RIIS_OK) this%options = options
    call finish(code, status)
  end subroutine surface_create

  !> Replaces the surface by the surface of a valve that moved. Options that are left out stay as they were. If half_thickness is
  !! RIIS_AUTO, the default, it follows the scale. Earlier pointers to the surface's arrays become invalid. The errors are those
  !! of %create, and RIIS_INVALID_PARAMETER naming a parameter that changed despite a fixed triangulation. After an error the
  !! surface is as it was.
  subroutine surface_update(this, valve, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
      flip_normals, status, measure, measure_tolerance, n_threads, triangulation, offset)
    class(riis_surface), intent(inout) :: this              !< Must be created.
    class(riis_valve), intent(in) :: valve                  !< Must be created; read during the call only.
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int32), intent(in), optional :: measure         !< RIIS_MEASURE_*.
    real(c_double), intent(in), optional :: measure_tolerance !< 1e-6 to 1, or RIIS_AUTO.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    integer(int32), intent(in), optional :: triangulation   !< RIIS_TRIANGULATION_*.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_options) :: options
    code = RIIS_OK
    call update_options(this, options, code)
    if (code == RIIS_OK) code = check_created(valve%c_handle(), 'valve')
    call set_options(options, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
      flip_normals, code, measure, measure_tolerance, n_threads, triangulation, offset=offset)
    if (code == RIIS_OK) code = riis_surface_update(this%handle, valve%c_handle(), options)
    if (code == RIIS_OK) this%options = options
    call finish(code, status)
  end subroutine surface_update

  !> Replaces the surface as %update does, with the same triangles to the last bit, and also gives every vertex a velocity. The
  !! velocity is the displacement from the point with the same patch, u and v in an earlier state, divided by dt. Nothing is
  !! stored between calls. For a valve at rest, pass the valve itself as valve_before. Errors: as for %update;
  !! RIIS_INVALID_ARGUMENT for dt out of range; RIIS_INVALID_PARAMETER for a valve_before of another kind or with other patches.
  subroutine surface_update_moving(this, valve, valve_before, dt, half_thickness, tolerance, scale, rotation_axis, &
      rotation_angle, translation, flip_normals, measure, measure_tolerance, n_threads, scale_before, &
      rotation_axis_before, rotation_angle_before, translation_before, status, triangulation, offset)
    class(riis_surface), intent(inout) :: this              !< Must be created.
    class(riis_valve), intent(in) :: valve                  !< Must be created; read during the call only.
    class(riis_valve), intent(in) :: valve_before           !< The earlier state, of the same kind. A valve from patches must have
                                                            !! the same curves and sides. Read during the call only.
    real(c_double), intent(in) :: dt                        !< From valve_before to valve, 1e-30 to 1e30, or negative if time goes
                                                            !! backwards.
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(int32), intent(in), optional :: measure         !< RIIS_MEASURE_*.
    real(c_double), intent(in), optional :: measure_tolerance !< 1e-6 to 1, or RIIS_AUTO.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    real(c_double), intent(in), optional :: scale_before    !< For the earlier state, like the next three. Default: as now.
    real(c_double), intent(in), optional :: rotation_axis_before(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle_before !< Degrees.
    real(c_double), intent(in), optional :: translation_before(:) !< (3), mesh units.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int32), intent(in), optional :: triangulation   !< RIIS_TRIANGULATION_*.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_options) :: options, before
    code = RIIS_OK
    call update_options(this, options, code)
    if (code == RIIS_OK) code = check_created(valve%c_handle(), 'valve')
    if (code == RIIS_OK) code = check_created(valve_before%c_handle(), 'valve_before')
    call set_options(options, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
      flip_normals, code, measure, measure_tolerance, n_threads, triangulation, offset=offset)
    if (code == RIIS_OK) then
      before = options
      if (present(scale_before)) before%scale = scale_before
      if (present(rotation_angle_before)) before%rotation_angle = rotation_angle_before
      call set_vector(rotation_axis_before, 'rotation_axis_before', before%rotation_axis, code)
      call set_vector(translation_before, 'translation_before', before%translation, code)
      if (code == RIIS_OK) code = riis_surface_update_moving(this%handle, valve%c_handle(), valve_before%c_handle(), dt, &
        options, before)
      if (code == RIIS_OK) this%options = options
    end if
    call finish(code, status)
  end subroutine surface_update_moving

  !> Adds a direction in which the surface of a valve changes. It belongs to a parameter, a landmark or a number of the placement.
  !! Marking with RIIS_FIELD_GRADIENT then gives the derivatives of distances and of K in all directions. The directions count
  !! from 1, in the order of the calls. An update removes them. Errors: RIIS_INVALID_ARGUMENT for a surface from arrays and for dp
  !! out of range; RIIS_INVALID_PARAMETER for a state of another kind or with other patches; RIIS_LIMIT_EXCEEDED for more than
  !! 1000.
  subroutine surface_add_direction(this, valve_after, valve_before, dp, scale_after, rotation_axis_after, &
      rotation_angle_after, translation_after, scale_before, rotation_axis_before, rotation_angle_before, &
      translation_before, status)
    class(riis_surface), intent(inout) :: this              !< Must be created.
    class(riis_valve), intent(in) :: valve_after            !< The valve with the parameter a little larger than in the surface.
                                                            !! Read during the call only.
    class(riis_valve), intent(in) :: valve_before           !< The valve with the parameter a little smaller. If only the
                                                            !! placement changes, the same valve. Read during the call only.
    real(c_double), intent(in) :: dp                        !< The parameter's difference from valve_before to valve_after,
                                                            !! 1e-30 to 1e30 in magnitude.
    real(c_double), intent(in), optional :: scale_after     !< For the state after, like the next three. Default: the surface's.
    real(c_double), intent(in), optional :: rotation_axis_after(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle_after !< Degrees.
    real(c_double), intent(in), optional :: translation_after(:) !< (3), mesh units.
    real(c_double), intent(in), optional :: scale_before    !< For the state before, like the next three. Default: the surface's.
    real(c_double), intent(in), optional :: rotation_axis_before(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle_before !< Degrees.
    real(c_double), intent(in), optional :: translation_before(:) !< (3), mesh units.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_surface_options) :: after, before
    code = RIIS_OK
    call update_options(this, after, code)
    if (code == RIIS_OK) code = check_created(valve_after%c_handle(), 'valve_after')
    if (code == RIIS_OK) code = check_created(valve_before%c_handle(), 'valve_before')
    if (code == RIIS_OK) then
      before = after
      if (present(scale_after)) after%scale = scale_after
      if (present(rotation_angle_after)) after%rotation_angle = rotation_angle_after
      call set_vector(rotation_axis_after, 'rotation_axis_after', after%rotation_axis, code)
      call set_vector(translation_after, 'translation_after', after%translation, code)
      if (present(scale_before)) before%scale = scale_before
      if (present(rotation_angle_before)) before%rotation_angle = rotation_angle_before
      call set_vector(rotation_axis_before, 'rotation_axis_before', before%rotation_axis, code)
      call set_vector(translation_before, 'translation_before', before%translation, code)
      if (code == RIIS_OK) code = riis_surface_add_direction(this%handle, valve_after%c_handle(), valve_before%c_handle(), &
        dp, after, before)
    end if
    call finish(code, status)
  end subroutine surface_add_direction

  !> Makes a surface from the caller's triangles or quads, which are read during the call only. Sections of vertex_ids and
  !! leaflet_id that are not contiguous are copied. The normal follows from the order of the corners by the right-hand rule. A
  !! quad 1 2 3 4 becomes the triangles 1 2 3 and 1 3 4. The options are those of %create. Errors: RIIS_INVALID_SURFACE naming the
  !! face or vertex and its value, RIIS_INVALID_ARGUMENT for an option out of range, RIIS_LIMIT_EXCEEDED for more than 16,777,216
  !! triangles.
  subroutine surface_create_from_arrays_xyz_int32(this, xyz, vertex_ids, leaflet_id, index_base, skip_zero_area, &
      half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, flip_normals, status, velocity, &
      n_threads, skirt_length, attached, skirt_lengths, offset)
    class(riis_surface), intent(inout) :: this              !< Must be empty.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_vertices), any positive stride, never copied.
    integer(int32), intent(in), contiguous, target :: vertex_ids(:, :) !< (3 or 4, n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces), >= 0. Default 0.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first vertex's number. Default 1.
    logical, intent(in), optional :: skip_zero_area         !< .true. skips triangles without area, .false. refuses them. Default
                                                            !! .false..
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional, target :: velocity(:, :) !< (3, n_vertices), any positive stride: the velocities of the
                                                                   !! vertices.
                                                            !! The placement rotates and scales them, but does not translate them.
                                                            !! Default: none.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    real(c_double), intent(in), optional :: skirt_length    !< The length of a skirt before placement, 0 for none. Default 0.
    logical, intent(in), optional :: attached(:)            !< (n_vertices): the vertices of the attachment. Default: with a
                                                            !! skirt, the attachment is chosen.
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices): the skirt's lengths at the
                                                            !! attached vertices. Default skirt_length.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_arrays) :: arrays
    type(strided_points) :: points, velocities
    integer(int8), allocatable, target :: bytes(:)
    call points_of(xyz, 'xyz', points, code)
    if (code == RIIS_OK .and. present(velocity)) then
      call points_of(velocity, 'velocity', velocities, code)
      if (code == RIIS_OK) code = check_size(velocities%n, points%n, 'velocity(1, :)', 'vertices')
    end if
    call get_faces(points%n, size(vertex_ids, 1), size(vertex_ids, 2, int64), storage_size(vertex_ids), leaflet_id, index_base, &
      arrays, code)
    call set_points(points, velocities, arrays)
    if (size(vertex_ids, kind=int64) > 0) arrays%vertex_ids = c_loc(vertex_ids)
    call get_mask(attached, bytes, code)
    call set_skirt(skirt_length, bytes, skirt_lengths, arrays, code)
    call create_from_arrays(this, arrays, skip_zero_area, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
      translation, flip_normals, n_threads, offset, code)
    call finish(code, status)
  end subroutine surface_create_from_arrays_xyz_int32

  !> Implements %create_from_arrays for integer(int64).
  subroutine surface_create_from_arrays_xyz_int64(this, xyz, vertex_ids, leaflet_id, index_base, skip_zero_area, &
      half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, flip_normals, status, velocity, &
      n_threads, skirt_length, attached, skirt_lengths, offset)
    class(riis_surface), intent(inout) :: this              !< Must be empty.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_vertices), any positive stride, never copied.
    integer(int64), intent(in), contiguous, target :: vertex_ids(:, :) !< (3 or 4, n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces), >= 0. Default 0.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first vertex's number. Default 1.
    logical, intent(in), optional :: skip_zero_area         !< .true. skips triangles without area, .false. refuses them. Default
                                                            !! .false..
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional, target :: velocity(:, :) !< (3, n_vertices), any positive stride: the velocities of the
                                                                   !! vertices.
                                                            !! The placement rotates and scales them, but does not translate them.
                                                            !! Default: none.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    real(c_double), intent(in), optional :: skirt_length    !< The length of a skirt before placement, 0 for none. Default 0.
    logical, intent(in), optional :: attached(:)            !< (n_vertices): the vertices of the attachment. Default: with a
                                                            !! skirt, the attachment is chosen.
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices): the skirt's lengths at the
                                                            !! attached vertices. Default skirt_length.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_arrays) :: arrays
    type(strided_points) :: points, velocities
    integer(int8), allocatable, target :: bytes(:)
    call points_of(xyz, 'xyz', points, code)
    if (code == RIIS_OK .and. present(velocity)) then
      call points_of(velocity, 'velocity', velocities, code)
      if (code == RIIS_OK) code = check_size(velocities%n, points%n, 'velocity(1, :)', 'vertices')
    end if
    call get_faces(points%n, size(vertex_ids, 1), size(vertex_ids, 2, int64), storage_size(vertex_ids), leaflet_id, index_base, &
      arrays, code)
    call set_points(points, velocities, arrays)
    if (size(vertex_ids, kind=int64) > 0) arrays%vertex_ids = c_loc(vertex_ids)
    call get_mask(attached, bytes, code)
    call set_skirt(skirt_length, bytes, skirt_lengths, arrays, code)
    call create_from_arrays(this, arrays, skip_zero_area, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
      translation, flip_normals, n_threads, offset, code)
    call finish(code, status)
  end subroutine surface_create_from_arrays_xyz_int64

  !> Implements %create_from_arrays for separate arrays x, y, z.
  subroutine surface_create_from_arrays_x_y_z_int32(this, x, y, z, vertex_ids, leaflet_id, index_base, skip_zero_area, &
      half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, flip_normals, status, vx, vy, vz, &
      n_threads, skirt_length, attached, skirt_lengths, offset)
    class(riis_surface), intent(inout) :: this              !< Must be empty.
    real(c_double), intent(in), target :: x(:)              !< (n_vertices), any positive stride, never copied.
    real(c_double), intent(in), target :: y(:)              !< (n_vertices), any positive stride, never copied.
    real(c_double), intent(in), target :: z(:)              !< (n_vertices), any positive stride, never copied.
    integer(int32), intent(in), contiguous, target :: vertex_ids(:, :) !< (3 or 4, n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces), >= 0. Default 0.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first vertex's number. Default 1.
    logical, intent(in), optional :: skip_zero_area         !< .true. skips triangles without area, .false. refuses them. Default
                                                            !! .false..
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional, target :: vx(:)   !< (n_vertices), any positive stride: the velocities of the
                                                            !! vertices. Default: none.
    real(c_double), intent(in), optional, target :: vy(:)   !< (n_vertices), like vx.
    real(c_double), intent(in), optional, target :: vz(:)   !< (n_vertices), like vx.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    real(c_double), intent(in), optional :: skirt_length    !< The length of a skirt before placement, 0 for none. Default 0.
    logical, intent(in), optional :: attached(:)            !< (n_vertices): the vertices of the attachment. Default: with a
                                                            !! skirt, the attachment is chosen.
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices): the skirt's lengths at the
                                                            !! attached vertices. Default skirt_length.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_arrays) :: arrays
    type(strided_points) :: points, velocities
    integer(int8), allocatable, target :: bytes(:)
    call points_of(x, y, z, points, code)
    if (code == RIIS_OK .and. present(vx) .and. present(vy) .and. present(vz)) then
      call points_of(vx, vy, vz, velocities, code, 'v')
      if (code == RIIS_OK) code = check_size(velocities%n, points%n, 'vx', 'vertices')
    else if (code == RIIS_OK .and. (present(vx) .or. present(vy) .or. present(vz))) then
      code = refuse('vx, vy and vz are not all given')
    end if
    call get_faces(points%n, size(vertex_ids, 1), size(vertex_ids, 2, int64), storage_size(vertex_ids), leaflet_id, index_base, &
      arrays, code)
    call set_points(points, velocities, arrays)
    if (size(vertex_ids, kind=int64) > 0) arrays%vertex_ids = c_loc(vertex_ids)
    call get_mask(attached, bytes, code)
    call set_skirt(skirt_length, bytes, skirt_lengths, arrays, code)
    call create_from_arrays(this, arrays, skip_zero_area, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
      translation, flip_normals, n_threads, offset, code)
    call finish(code, status)
  end subroutine surface_create_from_arrays_x_y_z_int32

  !> Implements %create_from_arrays for integer(int64) and separate arrays x, y, z.
  subroutine surface_create_from_arrays_x_y_z_int64(this, x, y, z, vertex_ids, leaflet_id, index_base, skip_zero_area, &
      half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, flip_normals, status, vx, vy, vz, &
      n_threads, skirt_length, attached, skirt_lengths, offset)
    class(riis_surface), intent(inout) :: this              !< Must be empty.
    real(c_double), intent(in), target :: x(:)              !< (n_vertices), any positive stride, never copied.
    real(c_double), intent(in), target :: y(:)              !< (n_vertices), any positive stride, never copied.
    real(c_double), intent(in), target :: z(:)              !< (n_vertices), any positive stride, never copied.
    integer(int64), intent(in), contiguous, target :: vertex_ids(:, :) !< (3 or 4, n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces), >= 0. Default 0.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first vertex's number. Default 1.
    logical, intent(in), optional :: skip_zero_area         !< .true. skips triangles without area, .false. refuses them. Default
                                                            !! .false..
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional, target :: vx(:)   !< (n_vertices), any positive stride: the velocities of the
                                                            !! vertices. Default: none.
    real(c_double), intent(in), optional, target :: vy(:)   !< (n_vertices), like vx.
    real(c_double), intent(in), optional, target :: vz(:)   !< (n_vertices), like vx.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    real(c_double), intent(in), optional :: skirt_length    !< The length of a skirt before placement, 0 for none. Default 0.
    logical, intent(in), optional :: attached(:)            !< (n_vertices): the vertices of the attachment. Default: with a
                                                            !! skirt, the attachment is chosen.
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices): the skirt's lengths at the
                                                            !! attached vertices. Default skirt_length.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_arrays) :: arrays
    type(strided_points) :: points, velocities
    integer(int8), allocatable, target :: bytes(:)
    call points_of(x, y, z, points, code)
    if (code == RIIS_OK .and. present(vx) .and. present(vy) .and. present(vz)) then
      call points_of(vx, vy, vz, velocities, code, 'v')
      if (code == RIIS_OK) code = check_size(velocities%n, points%n, 'vx', 'vertices')
    else if (code == RIIS_OK .and. (present(vx) .or. present(vy) .or. present(vz))) then
      code = refuse('vx, vy and vz are not all given')
    end if
    call get_faces(points%n, size(vertex_ids, 1), size(vertex_ids, 2, int64), storage_size(vertex_ids), leaflet_id, index_base, &
      arrays, code)
    call set_points(points, velocities, arrays)
    if (size(vertex_ids, kind=int64) > 0) arrays%vertex_ids = c_loc(vertex_ids)
    call get_mask(attached, bytes, code)
    call set_skirt(skirt_length, bytes, skirt_lengths, arrays, code)
    call create_from_arrays(this, arrays, skip_zero_area, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
      translation, flip_normals, n_threads, offset, code)
    call finish(code, status)
  end subroutine surface_create_from_arrays_x_y_z_int64

  !> Replaces the surface as %update does, from arrays as in %create_from_arrays.
  subroutine surface_update_from_arrays_xyz_int32(this, xyz, vertex_ids, leaflet_id, index_base, skip_zero_area, &
      half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, flip_normals, status, velocity, &
      n_threads, skirt_length, attached, skirt_lengths, offset)
    class(riis_surface), intent(inout) :: this              !< Must be created.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_vertices), any positive stride, never copied.
    integer(int32), intent(in), contiguous, target :: vertex_ids(:, :) !< (3 or 4, n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces), >= 0. Default 0.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first vertex's number. Default 1.
    logical, intent(in), optional :: skip_zero_area         !< .true. skips triangles without area, .false. refuses them. Default
                                                            !! as before.
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional, target :: velocity(:, :) !< (3, n_vertices), any positive stride: the velocities of the
                                                                   !! vertices.
                                                            !! The placement rotates and scales them, but does not translate them.
                                                            !! Default: none.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    real(c_double), intent(in), optional :: skirt_length    !< The length of a skirt before placement, 0 for none. Default 0.
    logical, intent(in), optional :: attached(:)            !< (n_vertices): the vertices of the attachment. Default: with a
                                                            !! skirt, the attachment is chosen.
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices): the skirt's lengths at the
                                                            !! attached vertices. Default skirt_length.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_arrays) :: arrays
    type(strided_points) :: points, velocities
    integer(int8), allocatable, target :: bytes(:)
    call points_of(xyz, 'xyz', points, code)
    if (code == RIIS_OK .and. present(velocity)) then
      call points_of(velocity, 'velocity', velocities, code)
      if (code == RIIS_OK) code = check_size(velocities%n, points%n, 'velocity(1, :)', 'vertices')
    end if
    call get_faces(points%n, size(vertex_ids, 1), size(vertex_ids, 2, int64), storage_size(vertex_ids), leaflet_id, index_base, &
      arrays, code)
    call set_points(points, velocities, arrays)
    if (size(vertex_ids, kind=int64) > 0) arrays%vertex_ids = c_loc(vertex_ids)
    call get_mask(attached, bytes, code)
    call set_skirt(skirt_length, bytes, skirt_lengths, arrays, code)
    call update_from_arrays(this, arrays, skip_zero_area, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
      translation, flip_normals, n_threads, offset, code)
    call finish(code, status)
  end subroutine surface_update_from_arrays_xyz_int32

  !> Implements %update_from_arrays for integer(int64).
  subroutine surface_update_from_arrays_xyz_int64(this, xyz, vertex_ids, leaflet_id, index_base, skip_zero_area, &
      half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, flip_normals, status, velocity, &
      n_threads, skirt_length, attached, skirt_lengths, offset)
    class(riis_surface), intent(inout) :: this              !< Must be created.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_vertices), any positive stride, never copied.
    integer(int64), intent(in), contiguous, target :: vertex_ids(:, :) !< (3 or 4, n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces), >= 0. Default 0.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first vertex's number. Default 1.
    logical, intent(in), optional :: skip_zero_area         !< .true. skips triangles without area, .false. refuses them. Default
                                                            !! as before.
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional, target :: velocity(:, :) !< (3, n_vertices), any positive stride: the velocities of the
                                                                   !! vertices.
                                                            !! The placement rotates and scales them, but does not translate them.
                                                            !! Default: none.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    real(c_double), intent(in), optional :: skirt_length    !< The length of a skirt before placement, 0 for none. Default 0.
    logical, intent(in), optional :: attached(:)            !< (n_vertices): the vertices of the attachment. Default: with a
                                                            !! skirt, the attachment is chosen.
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices): the skirt's lengths at the
                                                            !! attached vertices. Default skirt_length.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_arrays) :: arrays
    type(strided_points) :: points, velocities
    integer(int8), allocatable, target :: bytes(:)
    call points_of(xyz, 'xyz', points, code)
    if (code == RIIS_OK .and. present(velocity)) then
      call points_of(velocity, 'velocity', velocities, code)
      if (code == RIIS_OK) code = check_size(velocities%n, points%n, 'velocity(1, :)', 'vertices')
    end if
    call get_faces(points%n, size(vertex_ids, 1), size(vertex_ids, 2, int64), storage_size(vertex_ids), leaflet_id, index_base, &
      arrays, code)
    call set_points(points, velocities, arrays)
    if (size(vertex_ids, kind=int64) > 0) arrays%vertex_ids = c_loc(vertex_ids)
    call get_mask(attached, bytes, code)
    call set_skirt(skirt_length, bytes, skirt_lengths, arrays, code)
    call update_from_arrays(this, arrays, skip_zero_area, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
      translation, flip_normals, n_threads, offset, code)
    call finish(code, status)
  end subroutine surface_update_from_arrays_xyz_int64

  !> Implements %update_from_arrays for separate arrays x, y, z.
  subroutine surface_update_from_arrays_x_y_z_int32(this, x, y, z, vertex_ids, leaflet_id, index_base, skip_zero_area, &
      half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, flip_normals, status, vx, vy, vz, &
      n_threads, skirt_length, attached, skirt_lengths, offset)
    class(riis_surface), intent(inout) :: this              !< Must be created.
    real(c_double), intent(in), target :: x(:)              !< (n_vertices), any positive stride, never copied.
    real(c_double), intent(in), target :: y(:)              !< (n_vertices), any positive stride, never copied.
    real(c_double), intent(in), target :: z(:)              !< (n_vertices), any positive stride, never copied.
    integer(int32), intent(in), contiguous, target :: vertex_ids(:, :) !< (3 or 4, n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces), >= 0. Default 0.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first vertex's number. Default 1.
    logical, intent(in), optional :: skip_zero_area         !< .true. skips triangles without area, .false. refuses them. Default
                                                            !! as before.
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional, target :: vx(:)   !< (n_vertices), any positive stride: the velocities of the
                                                            !! vertices. Default: none.
    real(c_double), intent(in), optional, target :: vy(:)   !< (n_vertices), like vx.
    real(c_double), intent(in), optional, target :: vz(:)   !< (n_vertices), like vx.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    real(c_double), intent(in), optional :: skirt_length    !< The length of a skirt before placement, 0 for none. Default 0.
    logical, intent(in), optional :: attached(:)            !< (n_vertices): the vertices of the attachment. Default: with a
                                                            !! skirt, the attachment is chosen.
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices): the skirt's lengths at the
                                                            !! attached vertices. Default skirt_length.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_arrays) :: arrays
    type(strided_points) :: points, velocities
    integer(int8), allocatable, target :: bytes(:)
    call points_of(x, y, z, points, code)
    if (code == RIIS_OK .and. present(vx) .and. present(vy) .and. present(vz)) then
      call points_of(vx, vy, vz, velocities, code, 'v')
      if (code == RIIS_OK) code = check_size(velocities%n, points%n, 'vx', 'vertices')
    else if (code == RIIS_OK .and. (present(vx) .or. present(vy) .or. present(vz))) then
      code = refuse('vx, vy and vz are not all given')
    end if
    call get_faces(points%n, size(vertex_ids, 1), size(vertex_ids, 2, int64), storage_size(vertex_ids), leaflet_id, index_base, &
      arrays, code)
    call set_points(points, velocities, arrays)
    if (size(vertex_ids, kind=int64) > 0) arrays%vertex_ids = c_loc(vertex_ids)
    call get_mask(attached, bytes, code)
    call set_skirt(skirt_length, bytes, skirt_lengths, arrays, code)
    call update_from_arrays(this, arrays, skip_zero_area, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
      translation, flip_normals, n_threads, offset, code)
    call finish(code, status)
  end subroutine surface_update_from_arrays_x_y_z_int32

  !> Implements %update_from_arrays for integer(int64) and separate arrays x, y, z.
  subroutine surface_update_from_arrays_x_y_z_int64(this, x, y, z, vertex_ids, leaflet_id, index_base, skip_zero_area, &
      half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, flip_normals, status, vx, vy, vz, &
      n_threads, skirt_length, attached, skirt_lengths, offset)
    class(riis_surface), intent(inout) :: this              !< Must be created.
    real(c_double), intent(in), target :: x(:)              !< (n_vertices), any positive stride, never copied.
    real(c_double), intent(in), target :: y(:)              !< (n_vertices), any positive stride, never copied.
    real(c_double), intent(in), target :: z(:)              !< (n_vertices), any positive stride, never copied.
    integer(int64), intent(in), contiguous, target :: vertex_ids(:, :) !< (3 or 4, n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces), >= 0. Default 0.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first vertex's number. Default 1.
    logical, intent(in), optional :: skip_zero_area         !< .true. skips triangles without area, .false. refuses them. Default
                                                            !! as before.
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional, target :: vx(:)   !< (n_vertices), any positive stride: the velocities of the
                                                            !! vertices. Default: none.
    real(c_double), intent(in), optional, target :: vy(:)   !< (n_vertices), like vx.
    real(c_double), intent(in), optional, target :: vz(:)   !< (n_vertices), like vx.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    real(c_double), intent(in), optional :: skirt_length    !< The length of a skirt before placement, 0 for none. Default 0.
    logical, intent(in), optional :: attached(:)            !< (n_vertices): the vertices of the attachment. Default: with a
                                                            !! skirt, the attachment is chosen.
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices): the skirt's lengths at the
                                                            !! attached vertices. Default skirt_length.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_arrays) :: arrays
    type(strided_points) :: points, velocities
    integer(int8), allocatable, target :: bytes(:)
    call points_of(x, y, z, points, code)
    if (code == RIIS_OK .and. present(vx) .and. present(vy) .and. present(vz)) then
      call points_of(vx, vy, vz, velocities, code, 'v')
      if (code == RIIS_OK) code = check_size(velocities%n, points%n, 'vx', 'vertices')
    else if (code == RIIS_OK .and. (present(vx) .or. present(vy) .or. present(vz))) then
      code = refuse('vx, vy and vz are not all given')
    end if
    call get_faces(points%n, size(vertex_ids, 1), size(vertex_ids, 2, int64), storage_size(vertex_ids), leaflet_id, index_base, &
      arrays, code)
    call set_points(points, velocities, arrays)
    if (size(vertex_ids, kind=int64) > 0) arrays%vertex_ids = c_loc(vertex_ids)
    call get_mask(attached, bytes, code)
    call set_skirt(skirt_length, bytes, skirt_lengths, arrays, code)
    call update_from_arrays(this, arrays, skip_zero_area, half_thickness, tolerance, scale, rotation_axis, rotation_angle, &
      translation, flip_normals, n_threads, offset, code)
    call finish(code, status)
  end subroutine surface_update_from_arrays_x_y_z_int64

  ! Sets the vertices of the caller's arrays, and the velocities if they are present.
  subroutine set_points(points, velocities, arrays)
    type(strided_points), intent(in) :: points, velocities
    type(riis_surface_arrays), intent(inout) :: arrays
    arrays%x = points%x
    arrays%y = points%y
    arrays%z = points%z
    arrays%stride = points%stride
    arrays%vx = velocities%x
    arrays%vy = velocities%y
    arrays%vz = velocities%z
    arrays%velocity_stride = velocities%stride
  end subroutine set_points

  ! The common part of all specific procedures of create_from_arrays. It does nothing after an error.
  subroutine create_from_arrays(this, arrays, skip_zero_area, half_thickness, tolerance, scale, rotation_axis, &
      rotation_angle, translation, flip_normals, n_threads, offset, code)
    class(riis_surface), intent(inout) :: this
    type(riis_surface_arrays), intent(in) :: arrays
    real(c_double), intent(in), optional :: half_thickness, tolerance, scale, rotation_axis(:), rotation_angle, &
      translation(:)
    logical, intent(in), optional :: skip_zero_area, flip_normals
    integer(int32), intent(in), optional :: n_threads
    real(c_double), intent(in), optional :: offset
    integer(riis_status), intent(inout) :: code
    type(riis_surface_options) :: options
    call create_options(this, options, code)
    call set_options(options, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
      flip_normals, code, n_threads=n_threads, skip_zero_area=skip_zero_area, offset=offset)
    if (code == RIIS_OK) code = riis_surface_create_from_arrays(arrays, options, this%handle)
    if (code == RIIS_OK) this%options = options
  end subroutine create_from_arrays

  ! The common part of all specific procedures of update_from_arrays. It does nothing after an error.
  subroutine update_from_arrays(this, arrays, skip_zero_area, half_thickness, tolerance, scale, rotation_axis, &
      rotation_angle, translation, flip_normals, n_threads, offset, code)
    class(riis_surface), intent(inout) :: this
    type(riis_surface_arrays), intent(in) :: arrays
    real(c_double), intent(in), optional :: half_thickness, tolerance, scale, rotation_axis(:), rotation_angle, &
      translation(:)
    logical, intent(in), optional :: skip_zero_area, flip_normals
    integer(int32), intent(in), optional :: n_threads
    real(c_double), intent(in), optional :: offset
    integer(riis_status), intent(inout) :: code
    type(riis_surface_options) :: options
    call update_options(this, options, code)
    call set_options(options, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
      flip_normals, code, n_threads=n_threads, skip_zero_area=skip_zero_area, offset=offset)
    if (code == RIIS_OK) code = riis_surface_update_from_arrays(this%handle, arrays, options)
    if (code == RIIS_OK) this%options = options
  end subroutine update_from_arrays

  !> Makes a surface from the frames around a time, with the velocity of every vertex. The options are those of %create.
  !! Errors: RIIS_INVALID_ARGUMENT for a time or an option out of range, RIIS_INVALID_SURFACE for a face without area.
  subroutine surface_create_from_keyframes(this, keyframes, time, dt, skip_zero_area, half_thickness, tolerance, &
      scale, rotation_axis, rotation_angle, translation, flip_normals, n_threads, status, offset)
    class(riis_surface), intent(inout) :: this              !< Must be empty.
    class(riis_keyframes), intent(in) :: keyframes          !< Must be created; read during the call only.
    real(c_double), intent(in) :: time                      !< Magnitude at most 1e30.
    real(c_double), intent(in), optional :: dt              !< The velocity is the mean from time - dt to time. Default 0: it is
                                                            !! the derivative of the interpolation.
    logical, intent(in), optional :: skip_zero_area         !< .true. skips triangles without area, .false. refuses them. Default
                                                            !! .false..
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_options) :: options
    real(c_double) :: step
    step = 0
    if (present(dt)) step = dt
    code = RIIS_OK
    call create_options(this, options, code)
    if (code == RIIS_OK) code = check_created(keyframes%c_handle(), 'keyframes')
    call set_options(options, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
      flip_normals, code, n_threads=n_threads, skip_zero_area=skip_zero_area, offset=offset)
    if (code == RIIS_OK) code = riis_surface_create_from_keyframes(keyframes%c_handle(), time, step, options, this%handle)
    if (code == RIIS_OK) this%options = options
    call finish(code, status)
  end subroutine surface_create_from_keyframes

  !> Replaces the surface as %update does, by the surface at another time, as in %create_from_keyframes.
  subroutine surface_update_from_keyframes(this, keyframes, time, dt, skip_zero_area, half_thickness, tolerance, &
      scale, rotation_axis, rotation_angle, translation, flip_normals, n_threads, status, offset)
    class(riis_surface), intent(inout) :: this              !< Must be created.
    class(riis_keyframes), intent(in) :: keyframes          !< Must be created; read during the call only.
    real(c_double), intent(in) :: time                      !< Magnitude at most 1e30.
    real(c_double), intent(in), optional :: dt              !< The velocity is the mean from time - dt to time. Default 0: it is
                                                            !! the derivative of the interpolation.
    logical, intent(in), optional :: skip_zero_area         !< .true. skips triangles without area, .false. refuses them. Default
                                                            !! as before.
    real(c_double), intent(in), optional :: half_thickness  !< Mesh units.
    real(c_double), intent(in), optional :: tolerance       !< 1e-6 to 1.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), of any length.
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units.
    logical, intent(in), optional :: flip_normals           !< .true. reverses every triangle.
    integer(int32), intent(in), optional :: n_threads       !< 0 to 1024.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional :: offset          !< Half thicknesses, above -1 and below 1.
    integer(riis_status) :: code
    type(riis_surface_options) :: options
    real(c_double) :: step
    step = 0
    if (present(dt)) step = dt
    code = RIIS_OK
    call update_options(this, options, code)
    if (code == RIIS_OK) code = check_created(keyframes%c_handle(), 'keyframes')
    call set_options(options, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
      flip_normals, code, n_threads=n_threads, skip_zero_area=skip_zero_area, offset=offset)
    if (code == RIIS_OK) code = riis_surface_update_from_keyframes(this%handle, keyframes%c_handle(), time, step, options)
    if (code == RIIS_OK) this%options = options
    call finish(code, status)
  end subroutine surface_update_from_keyframes

  ! Makes the options with which a new surface begins. Does nothing after an error.
  subroutine create_options(this, options, code)
    class(riis_surface), intent(in) :: this
    type(riis_surface_options), intent(out) :: options
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK) code = check_not_created(this%handle, 'the surface')
    if (code == RIIS_OK) code = riis_surface_options_init(options, c_sizeof(options))
  end subroutine create_options

  ! Returns the present options of a surface. Does nothing after an error.
  subroutine update_options(this, options, code)
    class(riis_surface), intent(in) :: this
    type(riis_surface_options), intent(out) :: options
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK) code = check_created(this%handle, 'the surface')
    if (code == RIIS_OK) options = this%options
  end subroutine update_options

  ! Sets the options that are present. Does nothing after an error.
  subroutine set_options(options, half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, &
      flip_normals, code, measure, measure_tolerance, n_threads, triangulation, skip_zero_area, offset)
    type(riis_surface_options), intent(inout) :: options
    real(c_double), intent(in), optional :: half_thickness, tolerance, scale, rotation_axis(:), rotation_angle, &
      translation(:)
    logical, intent(in), optional :: flip_normals, skip_zero_area
    integer(riis_status), intent(inout) :: code
    integer(int32), intent(in), optional :: measure, n_threads, triangulation
    real(c_double), intent(in), optional :: measure_tolerance, offset
    if (code /= RIIS_OK) return
    if (present(half_thickness)) options%half_thickness = half_thickness
    if (present(tolerance)) options%tolerance = tolerance
    if (present(scale)) options%scale = scale
    if (present(rotation_angle)) options%rotation_angle = rotation_angle
    if (present(flip_normals)) options%flip_normals = merge(1, 0, flip_normals)
    if (present(measure)) options%measure = measure
    if (present(measure_tolerance)) options%measure_tolerance = measure_tolerance
    if (present(n_threads)) options%n_threads = n_threads
    if (present(triangulation)) options%triangulation = triangulation
    if (present(offset)) options%offset = offset
    if (present(skip_zero_area)) options%zero_area = merge(RIIS_ZERO_AREA_SKIP, RIIS_ZERO_AREA_REFUSE, skip_zero_area)
    call set_vector(rotation_axis, 'rotation_axis', options%rotation_axis, code)
    call set_vector(translation, 'translation', options%translation, code)
  end subroutine set_options

  !> Gives the surface's counts, half thickness, area and bounds, and the wall times of the last create or update.
  subroutine surface_get_info(this, info, status)
    class(riis_surface), intent(in) :: this                 !< Must be created.
    type(riis_surface_info), intent(inout) :: info          !< Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_created(this%handle, 'the surface')
    if (code == RIIS_OK) code = riis_surface_get_info(this%handle, info, c_sizeof(info))
    call finish(code, status)
  end subroutine surface_get_info

  !> Points to the surface's own vertices and triangles, after placement, without a copy. They are valid until its next update or
  !! its destruction. Do not write to them. On an error all sizes are 0.
  subroutine surface_get_triangles(this, triangles, status)
    class(riis_surface), intent(in) :: this                 !< Must be created.
    type(riis_triangles), intent(inout) :: triangles        !< Every component is set.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_triangles) :: made
    made = c_triangles(0, c_null_ptr, c_null_ptr, c_null_ptr, 0, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr)
    code = check_created(this%handle, 'the surface')
    if (code == RIIS_OK) code = riis_surface_get_triangles(this%handle, made, c_sizeof(made))
    triangles = riis_triangles(no_points, no_uv, no_points, no_corners, no_int64, no_int32, no_int32)
    if (c_associated(made%xyz)) call c_f_pointer(made%xyz, triangles%xyz, [3_int64, made%n_vertices])
    if (c_associated(made%uv)) call c_f_pointer(made%uv, triangles%uv, [2_int64, made%n_vertices])
    if (c_associated(made%velocity)) call c_f_pointer(made%velocity, triangles%velocity, [3_int64, made%n_vertices])
    if (c_associated(made%vertex_id)) call c_f_pointer(made%vertex_id, triangles%vertex_id, [3_int64, made%n_triangles])
    if (c_associated(made%triangle_id)) call c_f_pointer(made%triangle_id, triangles%triangle_id, [made%n_triangles])
    if (c_associated(made%leaflet_id)) call c_f_pointer(made%leaflet_id, triangles%leaflet_id, [made%n_triangles])
    if (c_associated(made%patch_id)) call c_f_pointer(made%patch_id, triangles%patch_id, [made%n_triangles])
    call finish(code, status)
  end subroutine surface_get_triangles

  !> Points to the rates of the surface's vertices in a direction of %add_direction, without a copy. The pointer is valid until
  !! the surface's next update or its destruction. Do not write to the array. On an error its size is 0. Errors:
  !! RIIS_INVALID_ARGUMENT for a direction that the surface lacks.
  subroutine surface_get_direction(this, direction_id, rate, status, area_rate)
    class(riis_surface), intent(in) :: this                 !< Must be created.
    integer(int64), intent(in) :: direction_id              !< From 0: the number of directions that were added before.
    real(c_double), pointer, intent(inout) :: rate(:, :)    !< (3, n_vertices): the derivative of each vertex by the parameter, in
                                                            !! mesh units divided by the parameter's unit.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(out), optional :: area_rate      !< The derivative of the surface's area.
    integer(riis_status) :: code
    type(riis_direction) :: made
    made = riis_direction(0, c_null_ptr, 0)
    code = check_created(this%handle, 'the surface')
    if (code == RIIS_OK) code = riis_surface_get_direction(this%handle, direction_id, made, c_sizeof(made))
    if (present(area_rate)) area_rate = made%area_rate
    rate => no_points
    if (c_associated(made%rate)) call c_f_pointer(made%rate, rate, [3_int64, made%n_vertices])
    call finish(code, status)
  end subroutine surface_get_direction

  !> Points to the edges at which tissue or a stent holds the leaflets of a valve, without a copy. These edges lie where cusps
  !! meet the sinus, on the mitral annulus, and on the sides v = 0 that patches do not share. A bileaflet valve has no such edges.
  !! The pointers are valid until the surface's next update or its destruction. Do not write to the arrays. Sizes are 0 on an
  !! error. Errors: RIIS_INVALID_ARGUMENT for a surface from arrays, because its attached and free edges cannot be
  !! distinguished.
  subroutine surface_get_attachment(this, attachment, status)
    class(riis_surface), intent(in) :: this                 !< Must be created.
    type(riis_attachment), intent(inout) :: attachment      !< Every component is set.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_attachment) :: made
    made = c_attachment(0, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr)
    code = check_created(this%handle, 'the surface')
    if (code == RIIS_OK) code = riis_surface_get_attachment(this%handle, made, c_sizeof(made))
    attachment = riis_attachment(no_edges, no_pairs, no_int32, no_int32)
    if (c_associated(made%edges)) call c_f_pointer(made%edges, attachment%edges, [3_int64, 2_int64, made%n_edges])
    if (c_associated(made%vertex_id)) call c_f_pointer(made%vertex_id, attachment%vertex_id, [2_int64, made%n_edges])
    if (c_associated(made%leaflet_id)) call c_f_pointer(made%leaflet_id, attachment%leaflet_id, [made%n_edges])
    if (c_associated(made%patch_id)) call c_f_pointer(made%patch_id, attachment%patch_id, [made%n_edges])
    call finish(code, status)
  end subroutine surface_get_attachment

  !> Finds the closest point of the surface to one point. Errors: RIIS_INVALID_ARGUMENT for a point that is not finite.
  subroutine surface_closest_point(this, point, closest, status)
    class(riis_surface), intent(in) :: this                 !< Must be created.
    real(c_double), intent(in) :: point(:)                  !< (3), magnitude at most 1e60.
    type(riis_closest), intent(inout) :: closest            !< Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    real(c_double) :: the_point(3)
    code = check_created(this%handle, 'the surface')
    if (code == RIIS_OK .and. size(point) /= 3) &
      code = refuse('the size of point is ' // text_of(size(point)) // '; it must be 3')
    if (code == RIIS_OK) then
      the_point = point
      code = riis_closest_point(this%handle, the_point, closest, c_sizeof(closest))
    end if
    call finish(code, status)
  end subroutine surface_closest_point

  !> Finds the closest points of the surface to many points, in parallel. It writes the arrays that are present. For sections of
  !! them that are not contiguous, the compiler makes copies in both directions. No array may overlap another or the coordinates,
  !! which are never copied. Errors: RIIS_INVALID_ARGUMENT naming the first bad point. Barycentric and side have the same error if
  !! distances are measured by sampling or minimisation. Nothing is then written.
  subroutine surface_closest_points_xyz_logical(this, xyz, distance_limit, far_distance, n_threads, distance, point, &
      barycentric, normal, triangle_id, leaflet_id, side, status, point_mask, point_id)
    class(riis_surface), intent(in) :: this                 !< Must be created.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_points), finite, any positive stride.
    real(c_double), intent(in), optional :: distance_limit  !< >= 0. Farther points get far_distance, ids -1, side 0 and zeros.
                                                            !! Default: no limit.
    real(c_double), intent(in), optional :: far_distance    !< Outside [0, distance_limit]. Default RIIS_FAR_DISTANCE.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    real(c_double), intent(inout), contiguous, optional, target :: distance(:) !< (n_points), >= 0.
    real(c_double), intent(inout), contiguous, optional, target :: point(:, :) !< (3, n_points): the closest points.
    real(c_double), intent(inout), contiguous, optional, target :: barycentric(:, :) !< (3, n_points): the points' barycentric
                                                            !! coordinates.
    real(c_double), intent(inout), contiguous, optional, target :: normal(:, :) !< (3, n_points): the triangle's unit normal.
    integer(int64), intent(inout), contiguous, optional, target :: triangle_id(:) !< (n_points), from 0.
    integer(int32), intent(inout), contiguous, optional, target :: leaflet_id(:) !< (n_points).
    integer(int32), intent(inout), contiguous, optional, target :: side(:) !< (n_points): 1 downstream, -1 upstream, 0 on the
                                                            !! surface or level with its rim.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    logical, intent(in), optional :: point_mask(:)          !< (n_points): points with .false. get no result, but must be finite;
                                                            !! copied. Default: all points.
    integer(int64), intent(in), optional, target :: point_id(:) !< Strictly ascending, from 0, like node_id of %marked: only
                                                            !! these points are read, and only their entries are written. Only a
                                                            !! section that is not contiguous is copied. Default: all points. Not
                                                            !! with point_mask.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    type(strided_points) :: points
    call points_of(xyz, 'xyz', points, code)
    call get_mask(point_mask, bytes, code)
    call closest_points(this, points, distance_limit, far_distance, n_threads, distance, point, barycentric, normal, &
      triangle_id, leaflet_id, side, code, bytes, point_id)
    call finish(code, status)
  end subroutine surface_closest_points_xyz_logical

  !> Implements %closest_points for a mask of bytes. Only a section that is not contiguous is copied.
  subroutine surface_closest_points_xyz_int8(this, xyz, distance_limit, far_distance, n_threads, distance, point, &
      barycentric, normal, triangle_id, leaflet_id, side, status, point_mask)
    class(riis_surface), intent(in) :: this                 !< Must be created.
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_points), finite, any positive stride.
    real(c_double), intent(in), optional :: distance_limit  !< >= 0. Farther points get far_distance, ids -1, side 0 and zeros.
                                                            !! Default: no limit.
    real(c_double), intent(in), optional :: far_distance    !< Outside [0, distance_limit]. Default RIIS_FAR_DISTANCE.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    real(c_double), intent(inout), contiguous, optional, target :: distance(:) !< (n_points), >= 0.
    real(c_double), intent(inout), contiguous, optional, target :: point(:, :) !< (3, n_points): the closest points.
    real(c_double), intent(inout), contiguous, optional, target :: barycentric(:, :) !< (3, n_points): the points' barycentric
                                                            !! coordinates.
    real(c_double), intent(inout), contiguous, optional, target :: normal(:, :) !< (3, n_points): the triangle's unit normal.
    integer(int64), intent(inout), contiguous, optional, target :: triangle_id(:) !< (n_points), from 0.
    integer(int32), intent(inout), contiguous, optional, target :: leaflet_id(:) !< (n_points).
    integer(int32), intent(inout), contiguous, optional, target :: side(:) !< (n_points): 1 downstream, -1 upstream, 0 on the
                                                            !! surface or level with its rim.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int8), intent(in), contiguous :: point_mask(:)  !< (n_points): points with 0 get no result, but must be finite.
    integer(riis_status) :: code
    type(strided_points) :: points
    call points_of(xyz, 'xyz', points, code)
    call closest_points(this, points, distance_limit, far_distance, n_threads, distance, point, barycentric, normal, &
      triangle_id, leaflet_id, side, code, point_mask)
    call finish(code, status)
  end subroutine surface_closest_points_xyz_int8

  !> Implements %closest_points for separate arrays x, y, z.
  subroutine surface_closest_points_x_y_z_logical(this, x, y, z, distance_limit, far_distance, n_threads, distance, &
      point, barycentric, normal, triangle_id, leaflet_id, side, status, point_mask, point_id)
    class(riis_surface), intent(in) :: this                 !< Must be created.
    real(c_double), intent(in), target :: x(:)              !< (n_points), finite, any positive stride.
    real(c_double), intent(in), target :: y(:)              !< (n_points), finite, any positive stride.
    real(c_double), intent(in), target :: z(:)              !< (n_points), finite, any positive stride.
    real(c_double), intent(in), optional :: distance_limit  !< >= 0. Farther points get far_distance, ids -1, side 0 and zeros.
                                                            !! Default: no limit.
    real(c_double), intent(in), optional :: far_distance    !< Outside [0, distance_limit]. Default RIIS_FAR_DISTANCE.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    real(c_double), intent(inout), contiguous, optional, target :: distance(:) !< (n_points), >= 0.
    real(c_double), intent(inout), contiguous, optional, target :: point(:, :) !< (3, n_points): the closest points.
    real(c_double), intent(inout), contiguous, optional, target :: barycentric(:, :) !< (3, n_points): the points' barycentric
                                                            !! coordinates.
    real(c_double), intent(inout), contiguous, optional, target :: normal(:, :) !< (3, n_points): the triangle's unit normal.
    integer(int64), intent(inout), contiguous, optional, target :: triangle_id(:) !< (n_points), from 0.
    integer(int32), intent(inout), contiguous, optional, target :: leaflet_id(:) !< (n_points).
    integer(int32), intent(inout), contiguous, optional, target :: side(:) !< (n_points): 1 downstream, -1 upstream, 0 on the
                                                            !! surface or level with its rim.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    logical, intent(in), optional :: point_mask(:)          !< (n_points): points with .false. get no result, but must be finite;
                                                            !! copied. Default: all points.
    integer(int64), intent(in), optional, target :: point_id(:) !< Strictly ascending, from 0, like node_id of %marked: only
                                                            !! these points are read, and only their entries are written. Only a
                                                            !! section that is not contiguous is copied. Default: all points. Not
                                                            !! with point_mask.
    integer(riis_status) :: code
    integer(int8), allocatable :: bytes(:)
    type(strided_points) :: points
    call points_of(x, y, z, points, code)
    call get_mask(point_mask, bytes, code)
    call closest_points(this, points, distance_limit, far_distance, n_threads, distance, point, barycentric, normal, &
      triangle_id, leaflet_id, side, code, bytes, point_id)
    call finish(code, status)
  end subroutine surface_closest_points_x_y_z_logical

  !> Implements %closest_points for separate arrays x, y, z and a mask of bytes.
  subroutine surface_closest_points_x_y_z_int8(this, x, y, z, distance_limit, far_distance, n_threads, distance, &
      point, barycentric, normal, triangle_id, leaflet_id, side, status, point_mask)
    class(riis_surface), intent(in) :: this                 !< Must be created.
    real(c_double), intent(in), target :: x(:)              !< (n_points), finite, any positive stride.
    real(c_double), intent(in), target :: y(:)              !< (n_points), finite, any positive stride.
    real(c_double), intent(in), target :: z(:)              !< (n_points), finite, any positive stride.
    real(c_double), intent(in), optional :: distance_limit  !< >= 0. Farther points get far_distance, ids -1, side 0 and zeros.
                                                            !! Default: no limit.
    real(c_double), intent(in), optional :: far_distance    !< Outside [0, distance_limit]. Default RIIS_FAR_DISTANCE.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    real(c_double), intent(inout), contiguous, optional, target :: distance(:) !< (n_points), >= 0.
    real(c_double), intent(inout), contiguous, optional, target :: point(:, :) !< (3, n_points): the closest points.
    real(c_double), intent(inout), contiguous, optional, target :: barycentric(:, :) !< (3, n_points): the points' barycentric
                                                            !! coordinates.
    real(c_double), intent(inout), contiguous, optional, target :: normal(:, :) !< (3, n_points): the triangle's unit normal.
    integer(int64), intent(inout), contiguous, optional, target :: triangle_id(:) !< (n_points), from 0.
    integer(int32), intent(inout), contiguous, optional, target :: leaflet_id(:) !< (n_points).
    integer(int32), intent(inout), contiguous, optional, target :: side(:) !< (n_points): 1 downstream, -1 upstream, 0 on the
                                                            !! surface or level with its rim.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(int8), intent(in), contiguous :: point_mask(:)  !< (n_points): points with 0 get no result, but must be finite.
    integer(riis_status) :: code
    type(strided_points) :: points
    call points_of(x, y, z, points, code)
    call closest_points(this, points, distance_limit, far_distance, n_threads, distance, point, barycentric, normal, &
      triangle_id, leaflet_id, side, code, point_mask)
    call finish(code, status)
  end subroutine surface_closest_points_x_y_z_int8

  ! The common part of all specific procedures of closest_points.
  subroutine closest_points(this, points, distance_limit, far_distance, n_threads, distance, point, barycentric, normal, &
      triangle_id, leaflet_id, side, code, mask, point_id)
    class(riis_surface), intent(in) :: this
    type(strided_points), intent(in) :: points
    real(c_double), intent(in), optional :: distance_limit, far_distance
    class(*), intent(in), optional :: n_threads
    real(c_double), intent(inout), contiguous, optional, target :: distance(:), point(:, :), barycentric(:, :), normal(:, :)
    integer(int64), intent(inout), contiguous, optional, target :: triangle_id(:)
    integer(int32), intent(inout), contiguous, optional, target :: leaflet_id(:), side(:)
    integer(riis_status), intent(inout) :: code
    integer(int8), intent(in), contiguous, optional, target :: mask(:)
    ! The argument is not declared CONTIGUOUS, because gfortran would then copy the target of a pointer.
    integer(int64), intent(in), optional, target :: point_id(:)
    type(riis_closest_options) :: options
    type(riis_closest_arrays) :: arrays
    type(riis_points) :: given
    integer(int64), target :: no_id(1)
    integer(int64), allocatable, target :: ids(:)

    if (code == RIIS_OK) code = check_created(this%handle, 'the surface')
    if (code == RIIS_OK) code = riis_closest_options_init(options, c_sizeof(options))
    if (code == RIIS_OK) code = riis_closest_arrays_init(arrays, c_sizeof(arrays))
    if (present(distance_limit)) options%distance_limit = distance_limit
    if (present(far_distance)) options%far_distance = far_distance
    call get_integer(n_threads, 'n_threads', options%n_threads, code)
    if (code == RIIS_OK .and. present(mask)) then
      code = check_size(size(mask, kind=int64), points%n, 'point_mask', 'points')
      if (size(mask, kind=int64) > 0) options%point_mask = c_loc(mask)
    end if
    if (present(point_id)) call get_list()
    call get_vectors(point, 'point', arrays%point)
    call get_vectors(barycentric, 'barycentric', arrays%barycentric)
    call get_vectors(normal, 'normal', arrays%normal)
    if (code == RIIS_OK .and. present(distance)) then
      code = check_size(size(distance, kind=int64), points%n, 'distance', 'points')
      if (size(distance, kind=int64) > 0) arrays%distance = c_loc(distance)
    end if
    if (code == RIIS_OK .and. present(triangle_id)) then
      code = check_size(size(triangle_id, kind=int64), points%n, 'triangle_id', 'points')
      if (size(triangle_id, kind=int64) > 0) arrays%triangle_id = c_loc(triangle_id)
    end if
    if (code == RIIS_OK .and. present(leaflet_id)) then
      code = check_size(size(leaflet_id, kind=int64), points%n, 'leaflet_id', 'points')
      if (size(leaflet_id, kind=int64) > 0) arrays%leaflet_id = c_loc(leaflet_id)
    end if
    if (code == RIIS_OK .and. present(side)) then
      code = check_size(size(side, kind=int64), points%n, 'side', 'points')
      if (size(side, kind=int64) > 0) arrays%side = c_loc(side)
    end if
    if (code == RIIS_OK .and. .not. (present(distance) .or. present(point) .or. present(barycentric) .or. present(normal) .or. &
      present(triangle_id) .or. present(leaflet_id) .or. present(side))) code = refuse('none of distance, point, &
      &barycentric, normal, triangle_id, leaflet_id and side is given, or allocated')
    if (code == RIIS_OK) code = riis_points_init(given, c_sizeof(given))
    given%n_points = points%n
    given%x = points%x
    given%y = points%y
    given%z = points%z
    given%stride = points%stride
    if (code == RIIS_OK) code = riis_closest_points(this%handle, given, options, arrays)

  contains

    subroutine get_list()
      integer :: stat
      options%n_point_ids = size(point_id, kind=int64)
      if (options%n_point_ids == 0) then
        options%point_ids = c_loc(no_id) ! an empty list still needs an address
      else if (is_contiguous(point_id)) then
        options%point_ids = c_loc(point_id(1))
      else if (code == RIIS_OK) then
        allocate (ids(options%n_point_ids), stat=stat)
        code = out_of_memory(stat)
        if (code /= RIIS_OK) return
        ids = point_id
        options%point_ids = c_loc(ids)
      end if
    end subroutine get_list

    subroutine get_vectors(vectors, name, location)
      real(c_double), intent(in), contiguous, optional, target :: vectors(:, :)
      character(len=*), intent(in) :: name
      type(c_ptr), intent(inout) :: location
      if (code /= RIIS_OK .or. .not. present(vectors)) return
      call check_columns(vectors, 3, points%n, name, code)
      if (code == RIIS_OK .and. size(vectors, kind=int64) > 0) location = c_loc(vectors)
    end subroutine get_vectors
  end subroutine closest_points

  !> Returns whether the surface was created and not destroyed.
  pure function surface_is_created(this) result(is_created)
    class(riis_surface), intent(in) :: this                 !< May be empty.
    logical :: is_created                                   !< .false. for an empty one.
    is_created = c_associated(this%handle)
  end function surface_is_created

  !> Returns the C handle, for calls of module riis_c. The handle belongs to this variable, so do not destroy the handle.
  function surface_c_handle(this) result(handle)
    class(riis_surface), intent(in) :: this                 !< May be empty.
    type(c_ptr) :: handle                                   !< c_null_ptr for an empty one.
    handle = this%handle
  end function surface_c_handle

  !> Frees the memory of the surface, which is then empty and can be created again. Nothing happens to an empty one.
  subroutine surface_destroy(this)
    class(riis_surface), intent(inout) :: this              !< May be empty.
    call riis_surface_destroy(this%handle)
  end subroutine surface_destroy

  !> Stops the program unless both objects are empty.
  impure elemental subroutine surface_assign(left, right)
    class(riis_surface), intent(inout) :: left              !< Must be empty.
    class(riis_surface), intent(in) :: right                !< Must be empty.
    call refuse_copy(left%handle, right%handle, 'riis_surface')
  end subroutine surface_assign
end module riis_surfaces
