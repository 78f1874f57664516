! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_measures.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The measures of a valve for a flow: leaflets, orifice, leak, first passage, cells across the band and swept volume of riis.h,
!! as a part of module riis.
module riis_measures
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c, c_find_by_area => riis_find_by_area, c_find_first_passage => riis_find_first_passage
  use riis_support
  use riis_calls
  use riis_valves, only: riis_valve
  use riis_surfaces, only: riis_surface
  use riis_meshes, only: riis_mesh
  use riis_marking, only: riis_marks
  implicit none
  private
  public :: riis_get_n_leaflets, riis_get_leaflet, riis_get_orifice, riis_get_orifice_in_wall, &
    riis_get_coaptation, riis_get_gap, &
    riis_set_skirt_to_wall, riis_get_leak, riis_get_cells_across, riis_get_swept_volume, riis_find_by_area, &
    riis_find_first_passage

  !> Finds the opening at which a valve first leaves a passage through a mesh.
  interface riis_find_first_passage
    module procedure find_first_passage_int32, find_first_passage_int64
  end interface riis_find_first_passage

  !> Finds the openings, or the sizes, at which the orifice of a valve has given areas.
  interface riis_find_by_area
    module procedure find_by_area
  end interface riis_find_by_area

contains

  !> Gives the number of the surface's leaflets.
  subroutine riis_get_n_leaflets(surface, n_leaflets, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    integer(int64), intent(inout) :: n_leaflets             !< Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_created(surface%c_handle(), 'the surface')
    if (code == RIIS_OK) code = riis_surface_get_n_leaflets(surface%c_handle(), n_leaflets)
    call finish(code, status)
  end subroutine riis_get_n_leaflets

  !> Gives the sizes of a leaflet. Errors: RIIS_INVALID_ARGUMENT for a leaflet that the surface lacks.
  subroutine riis_get_leaflet(surface, leaflet_num, leaflet, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    class(*), intent(in) :: leaflet_num                     !< integer, 1 to n_leaflets, ascending by leaflet_id.
    type(riis_leaflet), intent(inout) :: leaflet            !< Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: num
    code = check_created(surface%c_handle(), 'the surface')
    call get_integer(leaflet_num, 'leaflet_num', num, code)
    if (code == RIIS_OK) code = riis_surface_get_leaflet(surface%c_handle(), num - 1, leaflet, c_sizeof(leaflet))
    call finish(code, status)
  end subroutine riis_get_leaflet

  !> Measures the orifice of a surface along the axis: the area that its triangles do not cover, and the effective area that the
  !! band leaves to the flow. Errors: RIIS_INVALID_ARGUMENT for an argument out of range.
  subroutine riis_get_orifice(surface, orifice, half_thickness, rim, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    type(riis_orifice), intent(inout) :: orifice            !< Unchanged on an error.
    real(c_double), intent(in), optional :: half_thickness  !< eps of the resistance. Default RIIS_AUTO: the surface's.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    code = check_created(surface%c_handle(), 'the surface')
    call get_resistance(half_thickness=half_thickness, rim=rim, made=made, code=code)
    if (code == RIIS_OK) code = riis_surface_get_orifice(surface%c_handle(), made, orifice, c_sizeof(orifice))
    call finish(code, status)
  end subroutine riis_get_orifice

  !> Measures the orifice inside a wall: a ring or a tube around leaflets that do not reach it. Errors: RIIS_INVALID_ARGUMENT for
  !! an argument out of range, and for a wall whose open edges do not surround a centre.
  subroutine riis_get_orifice_in_wall(surface, wall, orifice, half_thickness, rim, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    class(riis_surface), intent(in) :: wall                 !< Must be created, in the same frame.
    type(riis_orifice), intent(inout) :: orifice            !< Unchanged on an error.
    real(c_double), intent(in), optional :: half_thickness  !< eps of the resistance. Default RIIS_AUTO: the surface's.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    code = check_created(surface%c_handle(), 'the surface')
    if (code == RIIS_OK) code = check_created(wall%c_handle(), 'the wall')
    call get_resistance(half_thickness=half_thickness, rim=rim, made=made, code=code)
    if (code == RIIS_OK) &
      code = riis_surface_get_orifice_in_wall(surface%c_handle(), wall%c_handle(), made, orifice, c_sizeof(orifice))
    call finish(code, status)
  end subroutine riis_get_orifice_in_wall

  !> Measures the coaptation of leaflets: the area and the length of free edge that lie within reach of another leaflet. Errors:
  !! RIIS_INVALID_ARGUMENT for a leaflet that the surface lacks, and for a reach out of range.
  subroutine riis_get_coaptation(surface, coaptation, reach, leaflet_id, status)
    class(riis_surface), intent(in) :: surface              !< Must be created.
    type(riis_coaptation), intent(inout) :: coaptation      !< Unchanged on an error.
    real(c_double), intent(in), optional :: reach           !< Mesh units. Default RIIS_AUTO: the surface's half thickness.
    class(*), intent(in), optional :: leaflet_id            !< integer. Default RIIS_ALL_LEAFLETS: the sum over all leaflets.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    real(c_double) :: within
    integer(int32) :: id
    within = RIIS_AUTO
    if (present(reach)) within = reach
    id = RIIS_ALL_LEAFLETS
    code = check_created(surface%c_handle(), 'the surface')
    call get_integer(leaflet_id, 'leaflet_id', id, code)
    if (code == RIIS_OK) &
      code = riis_surface_get_coaptation(surface%c_handle(), within, id, coaptation, c_sizeof(coaptation))
    call finish(code, status)
  end subroutine riis_get_coaptation

  !> Measures the gap between the attachment of a valve and a wall, along the direction of a skirt. Errors: RIIS_INVALID_ARGUMENT
  !! for a surface from arrays, for one without an attachment, and for a distance of another size.
  subroutine riis_get_gap(surface, wall, gap, distance, status)
    class(riis_surface), intent(in) :: surface              !< Must be created from a valve.
    class(riis_surface), intent(in) :: wall                 !< Must be created, in the same frame.
    type(riis_gap), intent(inout) :: gap                    !< Unchanged on an error.
    real(c_double), intent(inout), contiguous, optional :: distance(:, :) !< (2, n_edges): at both ends of the edges of
                                                            !! %get_attachment. RIIS_FAR_DISTANCE without a wall.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_attachment) :: attachment
    code = check_created(surface%c_handle(), 'the surface')
    if (code == RIIS_OK) code = check_created(wall%c_handle(), 'the wall')
    if (code == RIIS_OK .and. present(distance)) then
      code = riis_surface_get_attachment(surface%c_handle(), attachment, c_sizeof(attachment))
      if (code == RIIS_OK .and. size(distance, 1) /= 2) &
        code = refuse('the first extent of distance is ' // text_of(size(distance, 1)) // '; it must be 2')
      if (code == RIIS_OK) code = check_size(size(distance, 2, int64), attachment%n_edges, 'distance(1, :)', 'edges')
    end if
    if (code == RIIS_OK) &
      code = riis_surface_get_gap(surface%c_handle(), wall%c_handle(), distance, gap, c_sizeof(gap))
    call finish(code, status)
  end subroutine riis_get_gap

  !> Gives a valve a skirt that reaches a wall, and no farther. Its length at each point of the closed valve's attachment is the
  !! gap to the wall. Errors: RIIS_INVALID_ARGUMENT for a wall that the skirt misses, or that is farther than longest;
  !! RIIS_INVALID_PARAMETER for a bileaflet valve, and for an attachment that encloses no area.
  subroutine riis_set_skirt_to_wall(valve, wall, longest, scale, rotation_axis, rotation_angle, translation, status)
    class(riis_valve), intent(inout) :: valve               !< Must be created.
    class(riis_surface), intent(in) :: wall                 !< Must be created, in the frame of the placed valve.
    real(c_double), intent(in) :: longest                   !< The longest length to accept, mesh units.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12. Default 1.
    real(c_double), intent(in), optional :: rotation_axis(3) !< At least 1e-50 long. Default (0, 0, 1).
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees. Default 0.
    real(c_double), intent(in), optional :: translation(3)  !< Mesh units. Default 0.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_surface_options) :: options
    code = check_created(valve%c_handle(), 'the valve')
    if (code == RIIS_OK) code = check_created(wall%c_handle(), 'the wall')
    if (code == RIIS_OK) code = riis_surface_options_init(options, c_sizeof(options))
    if (present(scale)) options%scale = scale
    if (present(rotation_axis)) options%rotation_axis = rotation_axis
    if (present(rotation_angle)) options%rotation_angle = rotation_angle
    if (present(translation)) options%translation = translation
    if (code == RIIS_OK) code = riis_valve_set_skirt_to_wall(valve%c_handle(), wall%c_handle(), longest, options)
    call finish(code, status)
  end subroutine riis_set_skirt_to_wall

  !> Tells the ideal leak of a closed surface: the volume flow through it at a pressure drop. The flow is drop * (eps / R) * area.
  !! The bileaflet housing does not count. Errors: RIIS_INVALID_ARGUMENT for an argument out of range.
  subroutine riis_get_leak(surface, R, drop, flow, half_thickness, status)
    class(riis_surface), intent(in) :: surface              !< Must be created and closed.
    real(c_double), intent(in) :: R                         !< 1e-60 to 1e60, mass / (length time): kg/(m s).
    real(c_double), intent(in) :: drop                      !< Upstream minus downstream pressure, magnitude at most 1e30.
    real(c_double), intent(inout) :: flow                   !< Unchanged on an error.
    real(c_double), intent(in), optional :: half_thickness  !< eps of the resistance. Default RIIS_AUTO: the surface's.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_resistance) :: made
    code = check_created(surface%c_handle(), 'the surface')
    call get_resistance(R, half_thickness, made=made, code=code)
    if (code == RIIS_OK) code = riis_surface_get_leak(surface%c_handle(), made, drop, flow)
    call finish(code, status)
  end subroutine riis_get_leak

  !> Tells how many mesh edges lie across the band around the surface, by the lengths of the edges with a marked node. Errors:
  !! RIIS_INVALID_ARGUMENT for a mesh without an adjacency, and for marks that do not come from a marking with this mesh.
  subroutine riis_get_cells_across(marks, mesh, cells, status)
    class(riis_marks), intent(in) :: marks                  !< From riis_mark_nodes.
    class(riis_mesh), intent(in) :: mesh                    !< The mesh of the marking, with an adjacency.
    type(riis_cells_across), intent(inout) :: cells         !< Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_created(marks%c_handle(), 'the object marks')
    if (code == RIIS_OK) code = check_created(mesh%c_handle(), 'mesh')
    if (code == RIIS_OK) code = riis_marks_get_cells_across(marks%c_handle(), mesh%c_handle(), cells, c_sizeof(cells))
    call finish(code, status)
  end subroutine riis_get_cells_across

  !> Gives the volume that a valve sweeps between two openings, in mesh units cubed. It is the integral of u_surface . n over
  !! surface and time, positive along the normals. Errors: RIIS_INVALID_ARGUMENT for an opening out of range and a leaflet that
  !! the valve lacks; RIIS_INVALID_PARAMETER for parameters that do not fit together, and for a valve of one state unless both
  !! openings are 0.
  subroutine riis_get_swept_volume(valve, opening_from, opening_to, volume, leaflet_id, scale, flip_normals, &
      n_threads, status)
    class(riis_valve), intent(in) :: valve                  !< Must be created. Its own opening has no effect.
    real(c_double), intent(in) :: opening_from              !< 0 to 1.
    real(c_double), intent(in) :: opening_to                !< 0 to 1.
    real(c_double), intent(inout) :: volume                 !< Unchanged on an error.
    class(*), intent(in), optional :: leaflet_id            !< integer, RIIS_LEAFLET_*. Default RIIS_ALL_LEAFLETS.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12. Default 1.
    logical, intent(in), optional :: flip_normals           !< .true. changes the sign. Default .false.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_surface_options) :: options
    integer(int32) :: id
    id = RIIS_ALL_LEAFLETS
    code = check_created(valve%c_handle(), 'the valve')
    if (code == RIIS_OK) code = riis_surface_options_init(options, c_sizeof(options))
    if (present(scale)) options%scale = scale
    if (present(flip_normals)) options%flip_normals = merge(1, 0, flip_normals)
    call get_integer(leaflet_id, 'leaflet_id', id, code)
    call get_integer(n_threads, 'n_threads', options%n_threads, code)
    if (code == RIIS_OK) &
      code = riis_valve_get_swept_volume(valve%c_handle(), opening_from, opening_to, options, id, volume)
    call finish(code, status)
  end subroutine riis_get_swept_volume

  !> Finds the openings, or the sizes, at which the orifice of a valve has given areas. Of several openings the least is taken,
  !! and of several sizes the one nearest to the present size. Errors: RIIS_INVALID_ARGUMENT naming the area, counted from 0, and
  !! the range if it is out of reach; RIIS_INVALID_PARAMETER for a name that is unknown, has three values or does not change the
  !! area, and for a valve with one state or no orifice.
  subroutine find_by_area(valve, areas, values, name, reached, range, effective, from, to, half_thickness, tolerance, &
      scale, rotation_axis, rotation_angle, translation, triangulation, rim, area_tolerance, n_samples, n_threads, &
      status)
    class(riis_valve), intent(in) :: valve                  !< Must be created. Its own opening has no effect on openings.
    real(c_double), intent(in), contiguous :: areas(:)      !< Mesh units squared.
    real(c_double), intent(inout), contiguous :: values(:)  !< As many: the openings or sizes. Unchanged on an error.
    character(len=*), intent(in), optional :: name          !< 'scale' or a parameter with one value. Default 'opening'.
    real(c_double), intent(inout), contiguous, optional :: reached(:) !< As many: the areas at these values.
    type(riis_area_range), intent(inout), optional :: range !< The areas that can be reached. Unchanged on an error.
    logical, intent(in), optional :: effective              !< .true. for effective areas. Default .false.
    real(c_double), intent(in), optional :: from            !< The least value to search. Default as in riis_area_search.
    real(c_double), intent(in), optional :: to              !< The largest value to search.
    real(c_double), intent(in), optional :: half_thickness  !< As for riis_surface%create.
    real(c_double), intent(in), optional :: tolerance       !< As for riis_surface%create.
    real(c_double), intent(in), optional :: scale           !< As for riis_surface%create.
    real(c_double), intent(in), optional :: rotation_axis(3) !< As for riis_surface%create.
    real(c_double), intent(in), optional :: rotation_angle  !< As for riis_surface%create.
    real(c_double), intent(in), optional :: translation(3)  !< As for riis_surface%create.
    class(*), intent(in), optional :: triangulation         !< integer, RIIS_TRIANGULATION_*.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND.
    real(c_double), intent(in), optional :: area_tolerance  !< 1e-12 to 1e-2, as a share of an area. Default 1e-8.
    class(*), intent(in), optional :: n_samples             !< integer, 2 to 100001. Default 33.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_surface_options), target :: surface
    type(riis_resistance), target :: model
    type(riis_area_search) :: search
    code = check_created(valve%c_handle(), 'the valve')
    if (code == RIIS_OK) code = riis_surface_options_init(surface, c_sizeof(surface))
    if (code == RIIS_OK) code = riis_area_search_init(search, c_sizeof(search))
    call get_resistance(rim=rim, made=model, code=code)
    if (present(half_thickness)) surface%half_thickness = half_thickness
    if (present(tolerance)) surface%tolerance = tolerance
    if (present(scale)) surface%scale = scale
    if (present(rotation_axis)) surface%rotation_axis = rotation_axis
    if (present(rotation_angle)) surface%rotation_angle = rotation_angle
    if (present(translation)) surface%translation = translation
    call get_integer(triangulation, 'triangulation', surface%triangulation, code)
    call get_integer(n_samples, 'n_samples', search%n_samples, code)
    call get_integer(n_threads, 'n_threads', surface%n_threads, code)
    if (present(effective)) search%area = merge(RIIS_AREA_EFFECTIVE, RIIS_AREA_GEOMETRIC, effective)
    if (present(from)) search%from = from
    if (present(to)) search%to = to
    if (present(area_tolerance)) search%tolerance = area_tolerance
    if (code == RIIS_OK) code = check_size(size(values, kind=int64), size(areas, kind=int64), 'values', 'areas')
    if (code == RIIS_OK .and. present(reached)) &
      code = check_size(size(reached, kind=int64), size(areas, kind=int64), 'reached', 'areas')
    search%surface = c_loc(surface)
    search%resistance = c_loc(model)
    if (code == RIIS_OK) call find_values(valve, areas, search, values, name, reached, range, code)
    call finish(code, status)
  end subroutine find_by_area

  ! The call of riis_find_by_area.
  subroutine find_values(valve, areas, search, values, name, reached, range, code)
    class(riis_valve), intent(in) :: valve
    real(c_double), intent(in), contiguous :: areas(:)
    type(riis_area_search), intent(in) :: search
    real(c_double), intent(inout), contiguous :: values(:)
    character(len=*), intent(in), optional :: name
    real(c_double), intent(inout), contiguous, optional :: reached(:)
    type(riis_area_range), intent(inout), optional :: range
    integer(riis_status), intent(inout) :: code
    type(riis_area_range) :: found
    if (present(name)) then
      code = c_find_by_area(valve%c_handle(), riis_c_string(name), size(areas, kind=int64), areas, search, values, reached, &
        found, c_sizeof(found))
    else
      code = c_find_by_area(valve%c_handle(), riis_c_string('opening'), size(areas, kind=int64), areas, search, values, &
        reached, found, c_sizeof(found))
    end if
    if (code == RIIS_OK .and. present(range)) range = found
  end subroutine find_values

  !> Finds the first opening at which riis_find_passage finds an open passage. It tries the openings 0, 1/8, 2/8, ... until it
  !! finds one, and then halves the last step again and again. Errors: those of riis_surface%create and riis_find_passage, with
  !! the opening.
  subroutine find_first_passage_int32(valve, mesh, from_num, to_num, first, half_thickness, tolerance, scale, &
      rotation_axis, rotation_angle, translation, opening_tolerance, node_mask, n_threads, status)
    class(riis_valve), intent(in) :: valve                  !< Must be created. Its own opening has no effect.
    class(riis_mesh), intent(in) :: mesh                    !< With an adjacency. A marking is not needed.
    integer(int32), intent(in) :: from_num(:)               !< Nodes where paths begin, counted from 1, in any order; copied.
    integer(int32), intent(in) :: to_num(:)                 !< Nodes where paths end; copied.
    type(riis_first_passage), intent(inout) :: first        !< node_id counts from 0. Unchanged on an error.
    real(c_double), intent(in), optional :: half_thickness  !< As for riis_surface%create.
    real(c_double), intent(in), optional :: tolerance       !< As for riis_surface%create.
    real(c_double), intent(in), optional :: scale           !< As for riis_surface%create.
    real(c_double), intent(in), optional :: rotation_axis(3) !< As for riis_surface%create.
    real(c_double), intent(in), optional :: rotation_angle  !< As for riis_surface%create.
    real(c_double), intent(in), optional :: translation(3)  !< As for riis_surface%create.
    real(c_double), intent(in), optional :: opening_tolerance !< 1e-6 to 1. Default 1e-3.
    logical, intent(in), optional :: node_mask(:)           !< (n_nodes): nodes with .false. are on no path; copied. Default:
                                                            !! all nodes.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_surface_options), target :: surface
    code = riis_surface_options_init(surface, c_sizeof(surface))
    if (present(half_thickness)) surface%half_thickness = half_thickness
    if (present(tolerance)) surface%tolerance = tolerance
    if (present(scale)) surface%scale = scale
    if (present(rotation_axis)) surface%rotation_axis = rotation_axis
    if (present(rotation_angle)) surface%rotation_angle = rotation_angle
    if (present(translation)) surface%translation = translation
    call get_integer(n_threads, 'n_threads', surface%n_threads, code)
    call find(valve, mesh, int(from_num, int64) - 1, int(to_num, int64) - 1, surface, opening_tolerance, node_mask, first, code)
    call finish(code, status)
  end subroutine find_first_passage_int32

  !> Implements riis_find_first_passage for node numbers of another kind.
  subroutine find_first_passage_int64(valve, mesh, from_num, to_num, first, half_thickness, tolerance, scale, &
      rotation_axis, rotation_angle, translation, opening_tolerance, node_mask, n_threads, status)
    class(riis_valve), intent(in) :: valve                  !< Must be created. Its own opening has no effect.
    class(riis_mesh), intent(in) :: mesh                    !< With an adjacency. A marking is not needed.
    integer(int64), intent(in) :: from_num(:)               !< Nodes where paths begin, counted from 1, in any order; copied.
    integer(int64), intent(in) :: to_num(:)                 !< Nodes where paths end; copied.
    type(riis_first_passage), intent(inout) :: first        !< node_id counts from 0. Unchanged on an error.
    real(c_double), intent(in), optional :: half_thickness  !< As for riis_surface%create.
    real(c_double), intent(in), optional :: tolerance       !< As for riis_surface%create.
    real(c_double), intent(in), optional :: scale           !< As for riis_surface%create.
    real(c_double), intent(in), optional :: rotation_axis(3) !< As for riis_surface%create.
    real(c_double), intent(in), optional :: rotation_angle  !< As for riis_surface%create.
    real(c_double), intent(in), optional :: translation(3)  !< As for riis_surface%create.
    real(c_double), intent(in), optional :: opening_tolerance !< 1e-6 to 1. Default 1e-3.
    logical, intent(in), optional :: node_mask(:)           !< (n_nodes): nodes with .false. are on no path; copied. Default:
                                                            !! all nodes.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_surface_options), target :: surface
    code = riis_surface_options_init(surface, c_sizeof(surface))
    if (present(half_thickness)) surface%half_thickness = half_thickness
    if (present(tolerance)) surface%tolerance = tolerance
    if (present(scale)) surface%scale = scale
    if (present(rotation_axis)) surface%rotation_axis = rotation_axis
    if (present(rotation_angle)) surface%rotation_angle = rotation_angle
    if (present(translation)) surface%translation = translation
    call get_integer(n_threads, 'n_threads', surface%n_threads, code)
    call find(valve, mesh, int(from_num, int64) - 1, int(to_num, int64) - 1, surface, opening_tolerance, node_mask, first, code)
    call finish(code, status)
  end subroutine find_first_passage_int64

  ! The common part of riis_find_first_passage for both kinds of node numbers. It does nothing after an error.
  subroutine find(valve, mesh, from, to, surface, opening_tolerance, node_mask, first, code)
    class(riis_valve), intent(in) :: valve
    class(riis_mesh), intent(in) :: mesh
    integer(int64), intent(in), contiguous :: from(:), to(:)
    type(riis_surface_options), intent(in), target :: surface
    real(c_double), intent(in), optional :: opening_tolerance
    logical, intent(in), optional :: node_mask(:)
    type(riis_first_passage), intent(inout) :: first
    integer(riis_status), intent(inout) :: code
    type(riis_passage_ends) :: ends
    type(riis_mark_options), target :: marking
    type(riis_first_passage_options) :: options
    integer(int8), allocatable, target :: bytes(:)
    if (code == RIIS_OK) code = check_created(valve%c_handle(), 'the valve')
    if (code == RIIS_OK) code = check_created(mesh%c_handle(), 'mesh')
    if (code == RIIS_OK) code = describe_ends(from, to, ends)
    if (code == RIIS_OK) code = riis_mark_options_init(marking, c_sizeof(marking))
    if (code == RIIS_OK) code = riis_first_passage_options_init(options, c_sizeof(options))
    call get_mask(node_mask, bytes, code)
    if (code == RIIS_OK .and. present(node_mask)) then
      code = check_size(size(node_mask, kind=int64), mesh%n_nodes(), 'node_mask', 'nodes')
      if (size(node_mask) > 0) marking%node_mask = c_loc(bytes)
    end if
    if (code /= RIIS_OK) return
    marking%n_threads = surface%n_threads
    options%surface = c_loc(surface)
    options%marking = c_loc(marking)
    if (present(opening_tolerance)) options%tolerance = opening_tolerance
    code = c_find_first_passage(valve%c_handle(), mesh%c_handle(), ends, options, first, c_sizeof(first))
  end subroutine find
end module riis_measures
