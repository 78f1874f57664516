! SPDX-License-Identifier: Apache-2.0
! Written by fortran/bindings/generate.py from riis.h and from the files in that folder; run ./run bindings to repeat it.
!> riis_c - riis.h for Fortran, one to one: the same names, the same order, the same arguments. riis.h describes each function,
!! its ranges and its errors. This module only describes how each C argument is passed from Fortran.
!!
!!   status = riis_valve_create(riis_c_string('aortic'), valve)
!!   status = riis_surface_create(valve, surface=surface)                            ! without options: all defaults
!!   status = riis_mesh_create(n_nodes, c_loc(xyz(1, 1)), c_loc(xyz(2, 1)), c_loc(xyz(3, 1)), 3_c_int64_t, mesh)
!!   status = riis_marks_create(marks)
!!   status = riis_mark_nodes(surface, mesh, marks=marks)                            ! once a time step
!!   status = riis_marks_get_list(marks, RIIS_LIST_MARKED, list, c_sizeof(list))
!!   if (list%n_nodes > 0) call c_f_pointer(list%node_id, ids, [list%n_nodes])   ! integer(c_int64_t), pointer :: ids(:)
!!
!! Rules for every interface below:
!!
!! - Arguments that may be NULL in C are OPTIONAL here; an argument that is left out is NULL. Use keywords for the arguments
!!   after it.
!! - Handles are type(c_ptr). Start them as c_null_ptr; destroying sets them to it again.
!! - Arguments that a call writes are intent(inout), not intent(out), because a refused call leaves them as they were.
!! - Arrays that are read or written during the call only are assumed-size: pass the array, or its first element and a
!!   stride. The coordinates and the rows of a mesh are borrowed beyond the call, so they are type(c_ptr): c_loc needs
!!   TARGET, so no compiler can pass a temporary copy. Keep the array in place: no local variable that ends, no reallocation.
!! - Arrays of the library are type(c_ptr), for c_f_pointer with the shape given here. Do not write to them. Empty
!!   arrays are c_null_ptr.
!! - Ids that the library gives count from 0, also in Fortran: node_id + 1 is the column of xyz(3, n). Ids in a struct count from
!!   the field index_base, so set index_base to 1. Set id_bits and similar fields to the kind of the ids: storage_size(the array).
!! - Structs: call the init function with c_sizeof(the variable) as struct_size, then set the fields that differ:
!!     status = riis_mark_options_init(options, c_sizeof(options))
!! - Pass texts through riis_c_string and take them through riis_c_text. A bare literal also compiles, but it is wrong, because
!!   it lacks the null character at the end.
module riis_c
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int8_t, c_int32_t, c_int64_t, c_null_char, &
    c_ptr, c_size_t, c_associated, c_f_pointer
  implicit none
  public
  private :: c_char, c_double, c_funptr, c_int8_t, c_int32_t, c_int64_t, c_null_char, c_ptr, c_size_t, c_associated, &
    c_f_pointer, c_strlen

  ! -------------------------------------------------------------------------------------------------------------------
  ! Constants
  ! -------------------------------------------------------------------------------------------------------------------

  !> The kind of a status: integer(riis_status) :: status
  integer, parameter :: riis_status = c_int32_t

  integer(riis_status), parameter :: RIIS_OK = 0
  integer(riis_status), parameter :: RIIS_INVALID_ARGUMENT = 1
  integer(riis_status), parameter :: RIIS_INVALID_STRUCT_SIZE = 2
  integer(riis_status), parameter :: RIIS_INVALID_PARAMETER = 3
  integer(riis_status), parameter :: RIIS_INVALID_SURFACE = 4
  integer(riis_status), parameter :: RIIS_INVALID_MESH = 5
  integer(riis_status), parameter :: RIIS_LIMIT_EXCEEDED = 6
  integer(riis_status), parameter :: RIIS_OUT_OF_MEMORY = 7
  integer(riis_status), parameter :: RIIS_FILE_ERROR = 8
  integer(riis_status), parameter :: RIIS_UNAVAILABLE = 9
  integer(riis_status), parameter :: RIIS_INTERNAL_ERROR = -1

  integer(c_int32_t), parameter :: RIIS_LOG_INFO = 0
  integer(c_int32_t), parameter :: RIIS_LOG_WARNING = 1

  integer(c_int32_t), parameter :: RIIS_LEAFLET_RIGHT = 0
  integer(c_int32_t), parameter :: RIIS_LEAFLET_LEFT = 1
  integer(c_int32_t), parameter :: RIIS_LEAFLET_NON_CORONARY = 2
  integer(c_int32_t), parameter :: RIIS_LEAFLET_ANTERIOR = 0
  integer(c_int32_t), parameter :: RIIS_LEAFLET_POSTERIOR = 1
  integer(c_int32_t), parameter :: RIIS_LEAFLET_POSITIVE = 0
  integer(c_int32_t), parameter :: RIIS_LEAFLET_NEGATIVE = 1
  integer(c_int32_t), parameter :: RIIS_LEAFLET_HOUSING = 2
  integer(c_int32_t), parameter :: RIIS_LEAFLET_SKIRT = 3

  integer(c_int32_t), parameter :: RIIS_ZERO_AREA_REFUSE = 0
  integer(c_int32_t), parameter :: RIIS_ZERO_AREA_SKIP = 1

  integer(c_int32_t), parameter :: RIIS_MEASURE_TRIANGLES = 0
  integer(c_int32_t), parameter :: RIIS_MEASURE_SAMPLING = 1
  integer(c_int32_t), parameter :: RIIS_MEASURE_MINIMIZATION = 2

  integer(c_int32_t), parameter :: RIIS_TRIANGULATION_ADAPTED = 0
  integer(c_int32_t), parameter :: RIIS_TRIANGULATION_FIXED = 1

  integer(c_int32_t), parameter :: RIIS_INTERPOLATION_LINEAR = 0
  integer(c_int32_t), parameter :: RIIS_INTERPOLATION_CUBIC = 1

  integer(c_int32_t), parameter :: RIIS_SEARCH_AUTO = 0
  integer(c_int32_t), parameter :: RIIS_SEARCH_EXHAUSTIVE = 1
  integer(c_int32_t), parameter :: RIIS_SEARCH_NEIGHBOR = 2
  integer(c_int32_t), parameter :: RIIS_SEARCH_PAPER = 3
  integer(c_int32_t), parameter :: RIIS_SEARCH_CLUSTERS = 4

  integer(c_int32_t), parameter :: RIIS_INSTRUCTIONS_AUTO = 0
  integer(c_int32_t), parameter :: RIIS_INSTRUCTIONS_BASELINE = 1
  integer(c_int32_t), parameter :: RIIS_INSTRUCTIONS_AVX2 = 2
  integer(c_int32_t), parameter :: RIIS_INSTRUCTIONS_AVX512 = 3

  integer(c_int32_t), parameter :: RIIS_FIELD_POINT = 1
  integer(c_int32_t), parameter :: RIIS_FIELD_NORMAL = 2
  integer(c_int32_t), parameter :: RIIS_FIELD_BARYCENTRIC = 4
  integer(c_int32_t), parameter :: RIIS_FIELD_SIDE = 8
  integer(c_int32_t), parameter :: RIIS_FIELD_RIM = 16
  integer(c_int32_t), parameter :: RIIS_FIELD_UV = 32
  integer(c_int32_t), parameter :: RIIS_FIELD_VELOCITY = 64
  integer(c_int32_t), parameter :: RIIS_FIELD_PATCH = 128
  integer(c_int32_t), parameter :: RIIS_FIELD_GRADIENT = 256

  integer(c_int32_t), parameter :: RIIS_RIM_ROUND = 0
  integer(c_int32_t), parameter :: RIIS_RIM_CUT = 1

  integer(c_int32_t), parameter :: RIIS_LIST_MARKED = 0
  integer(c_int32_t), parameter :: RIIS_LIST_WITHIN_LIMIT = 1

  integer(c_int32_t), parameter :: RIIS_PASSAGE_CLOSED = 0
  integer(c_int32_t), parameter :: RIIS_PASSAGE_OPEN = 1
  integer(c_int32_t), parameter :: RIIS_PASSAGE_NONE = 2

  integer(c_int32_t), parameter :: RIIS_OUTLINE_NONE = 0
  integer(c_int32_t), parameter :: RIIS_OUTLINE_DISC = 1
  integer(c_int32_t), parameter :: RIIS_OUTLINE_ATTACHMENT = 2
  integer(c_int32_t), parameter :: RIIS_OUTLINE_BOUNDARY = 3
  integer(c_int32_t), parameter :: RIIS_OUTLINE_WALL = 4

  integer(c_int32_t), parameter :: RIIS_AREA_GEOMETRIC = 0
  integer(c_int32_t), parameter :: RIIS_AREA_EFFECTIVE = 1

  integer(c_int32_t), parameter :: RIIS_ALL_LEAFLETS = -1

  integer(c_int32_t), parameter :: RIIS_FIRST_PASSAGE_FOUND = 0
  integer(c_int32_t), parameter :: RIIS_FIRST_PASSAGE_ALWAYS = 1
  integer(c_int32_t), parameter :: RIIS_FIRST_PASSAGE_NEVER = 2
  integer(c_int32_t), parameter :: RIIS_FIRST_PASSAGE_NONE = 3

  integer(c_int32_t), parameter :: RIIS_LANDMARK_COMMISSURE = 0
  integer(c_int32_t), parameter :: RIIS_LANDMARK_NADIR = 1
  integer(c_int32_t), parameter :: RIIS_LANDMARK_COAPTATION = 2
  integer(c_int32_t), parameter :: RIIS_LANDMARK_ANNULUS = 3
  integer(c_int32_t), parameter :: RIIS_LANDMARK_ANTERIOR_HORN = 4
  integer(c_int32_t), parameter :: RIIS_LANDMARK_POSTERIOR_HORN = 5
  integer(c_int32_t), parameter :: RIIS_LANDMARK_TRIGONE = 6
  integer(c_int32_t), parameter :: RIIS_LANDMARK_POSTEROMEDIAL = 7
  integer(c_int32_t), parameter :: RIIS_LANDMARK_ANTEROLATERAL = 8
  integer(c_int32_t), parameter :: RIIS_LANDMARK_HINGE = 9
  integer(c_int32_t), parameter :: RIIS_LANDMARK_ATTACHMENT = 10

  integer(c_int32_t), parameter :: RIIS_SIZE_KEPT = 0
  integer(c_int32_t), parameter :: RIIS_SIZE_DETERMINED = 1
  integer(c_int32_t), parameter :: RIIS_SIZE_TIED = 2
  integer(c_int32_t), parameter :: RIIS_SIZE_UNDETERMINED = 3

  integer(c_int32_t), parameter :: RIIS_PHASE_CLOSING = 0
  integer(c_int32_t), parameter :: RIIS_PHASE_OPENING = 1

  real(c_double), parameter :: RIIS_AUTO = -1.0_c_double
  real(c_double), parameter :: RIIS_FAR_DISTANCE = 1.0e30_c_double

  ! -------------------------------------------------------------------------------------------------------------------
  ! The structs of riis.h, with their fields in order. Pointers are type(c_ptr), set by c_loc
  ! -------------------------------------------------------------------------------------------------------------------

  type, bind(c) :: riis_points
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_points
    type(c_ptr) :: x, y, z       !< real(c_double) or (c_float), (n_points), or xyz(3, n_points): c_loc(xyz(1, 1)),
                                 !! c_loc(xyz(2, 1)), ...
    integer(c_int64_t) :: stride !< 3 for xyz(3, n_points)
    integer(c_int32_t) :: real_bits
    integer(c_int32_t) :: reserved
  end type riis_points

  type, bind(c) :: riis_patches
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_curves
    type(c_ptr) :: degree     !< integer(c_int32_t), (n_curves)
    type(c_ptr) :: control    !< real(c_double), (3, sum(degree + 1))
    integer(c_int64_t) :: n_patches
    type(c_ptr) :: curve_id   !< integer(c_int32_t), (4, n_patches)
    type(c_ptr) :: reversed   !< integer(c_int32_t), (4, n_patches), or c_null_ptr
    type(c_ptr) :: leaflet_id !< integer(c_int32_t), (n_patches), or c_null_ptr
    integer(c_int32_t) :: index_base
    integer(c_int32_t) :: reserved
  end type riis_patches

  type, bind(c) :: riis_parameter
    type(c_ptr) :: name        !< for riis_c_text
    type(c_ptr) :: unit        !< for riis_c_text
    type(c_ptr) :: description !< for riis_c_text
    integer(c_int64_t) :: n_values
    real(c_double) :: default_values(3)
    real(c_double) :: minimum
    real(c_double) :: maximum
    type(c_ptr) :: rule        !< for riis_c_text
    type(c_ptr) :: other_name  !< for riis_c_text
    real(c_double) :: other_factor
  end type riis_parameter

  type, bind(c) :: riis_valve_patches
    integer(c_int64_t) :: n_curves
    integer(c_int64_t) :: n_pieces
    type(c_ptr) :: first_piece !< integer(c_int64_t), (n_curves + 1)
    type(c_ptr) :: degree      !< integer(c_int32_t), (n_pieces)
    type(c_ptr) :: control     !< real(c_double), (3, sum(degree + 1))
    integer(c_int64_t) :: n_patches
    type(c_ptr) :: curve_id    !< integer(c_int32_t), (4, n_patches)
    type(c_ptr) :: reversed    !< integer(c_int32_t), (4, n_patches)
    type(c_ptr) :: leaflet_id  !< integer(c_int32_t), (n_patches)
    type(c_ptr) :: patch_id    !< integer(c_int32_t), (n_patches)
    type(c_ptr) :: attached    !< integer(c_int32_t), (n_patches)
    type(c_ptr) :: bulge       !< real(c_double), (n_patches)
  end type riis_valve_patches

  type, bind(c) :: riis_surface_options
    integer(c_int64_t) :: struct_size
    real(c_double) :: half_thickness
    real(c_double) :: tolerance
    real(c_double) :: scale
    real(c_double) :: rotation_axis(3)
    real(c_double) :: rotation_angle
    real(c_double) :: translation(3)
    real(c_double) :: measure_tolerance
    integer(c_int32_t) :: measure
    integer(c_int32_t) :: triangulation
    integer(c_int32_t) :: zero_area
    integer(c_int32_t) :: flip_normals
    integer(c_int32_t) :: n_threads
    integer(c_int32_t) :: reserved
    real(c_double) :: offset
  end type riis_surface_options

  type, bind(c) :: riis_surface_arrays
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_vertices
    type(c_ptr) :: x, y, z       !< real(c_double) or (c_float), (n_vertices), or xyz(3, n_vertices): c_loc(xyz(1, 1)),
                                 !! c_loc(xyz(2, 1)), ...
    integer(c_int64_t) :: stride
    type(c_ptr) :: vx, vy, vz    !< real(c_double) or (c_float), (n_vertices), or like x, y, z; or c_null_ptr
    integer(c_int64_t) :: velocity_stride
    integer(c_int64_t) :: n_faces
    type(c_ptr) :: vertex_ids    !< integer(c_int32_t) or (c_int64_t), (corners_per_face, n_faces)
    type(c_ptr) :: leaflet_id    !< integer(c_int32_t), (n_faces), or c_null_ptr
    integer(c_int32_t) :: corners_per_face
    integer(c_int32_t) :: id_bits
    integer(c_int32_t) :: index_base
    integer(c_int32_t) :: real_bits
    real(c_double) :: skirt_length
    type(c_ptr) :: attached      !< integer(c_int8_t), (n_vertices), or c_null_ptr
    type(c_ptr) :: skirt_lengths !< real(c_double), (n_vertices), or c_null_ptr
  end type riis_surface_arrays

  !> The size of a surface, and the wall times of the call that last made or updated it.
  type, bind(c) :: riis_surface_info
    integer(c_int64_t) :: n_vertices         !< as riis_triangles.n_vertices
    integer(c_int64_t) :: n_triangles        !< triangles that answer queries
    integer(c_int64_t) :: n_zero_area        !< the number of triangles that were skipped because they have no area
    real(c_double) :: half_thickness         !< mesh units
    real(c_double) :: area                   !< of all triangles, mesh units squared
    real(c_double) :: lower(3), upper(3)     !< bounds of the triangles, mesh units
    real(c_double) :: seconds_triangles      !< wall time for checks and for making triangles, in the last call that
                                             !! made or updated the surface
    real(c_double) :: seconds_scene          !< wall time for groups of triangles, sampling and minimisation, in the
                                             !! same call. The time does not include Embree's scene, because the first
                                             !! query that needs the scene builds it
    real(c_double) :: error_bound            !< an upper bound of the error of distances. The error is the difference
                                             !! between the distances to the triangles and to the smooth valve. The
                                             !! bound is at most tolerance * half_thickness, and 0 for a surface from
                                             !! arrays
    integer(c_int64_t) :: largest_leaflet_id !< of the triangles
    real(c_double) :: offset                 !< of the band, in half thicknesses
    real(c_double) :: contact_depth          !< where triangles of different leaflets cross by at most this depth, the
                                             !! leaflets only touch (docs/theory/crossings.md)
    integer(c_int32_t) :: skirt_leaflet_id   !< the leaflet_id of the skirt; -1: no skirt
    integer(c_int32_t) :: housing_leaflet_id !< bileaflet: RIIS_LEAFLET_HOUSING; -1 for other surfaces
  end type riis_surface_info

  type, bind(c) :: riis_triangles
    integer(c_int64_t) :: n_vertices
    type(c_ptr) :: xyz         !< real(c_double), (3, n_vertices)
    type(c_ptr) :: uv          !< real(c_double), (2, n_vertices), or c_null_ptr
    type(c_ptr) :: velocity    !< real(c_double), (3, n_vertices), or c_null_ptr
    integer(c_int64_t) :: n_triangles
    type(c_ptr) :: vertex_id   !< integer(c_int64_t), (3, n_triangles)
    type(c_ptr) :: triangle_id !< integer(c_int64_t), (n_triangles)
    type(c_ptr) :: leaflet_id  !< integer(c_int32_t), (n_triangles)
    type(c_ptr) :: patch_id    !< integer(c_int32_t), (n_triangles)
  end type riis_triangles

  !> c_null_ptr for arrays without edges
  type, bind(c) :: riis_attachment
    integer(c_int64_t) :: n_edges
    type(c_ptr) :: edges      !< real(c_double), (3, 2, n_edges)
    type(c_ptr) :: vertex_id  !< integer(c_int64_t), (2, n_edges)
    type(c_ptr) :: leaflet_id !< integer(c_int32_t), (n_edges)
    type(c_ptr) :: patch_id   !< integer(c_int32_t), (n_edges)
  end type riis_attachment

  type, bind(c) :: riis_keyframe_arrays
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_keys
    integer(c_int64_t) :: n_vertices
    type(c_ptr) :: time !< real(c_double), (n_keys)
    type(c_ptr) :: xyz  !< real(c_double) or (c_float), (3, n_vertices, n_keys)
    real(c_double) :: period
    integer(c_int32_t) :: interpolation
    integer(c_int32_t) :: real_bits
  end type riis_keyframe_arrays

  !> The point of the surface that is closest to a given point. For closest points by sampling or minimisation, see
  !! RIIS_MEASURE_*.
  type, bind(c) :: riis_closest
    real(c_double) :: distance        !< >= 0, mesh units
    real(c_double) :: point(3)        !< the closest point, on the triangle triangle_id, mesh units
    real(c_double) :: barycentric(3)  !< the closest point's weights for the triangle's vertices, >= 0, with sum 1
    real(c_double) :: normal(3)       !< unit normal of the triangle, by the right-hand rule
    integer(c_int64_t) :: triangle_id !< the id of the closest triangle. Of several equally close triangles, the one
                                      !! with the lowest id counts
    integer(c_int32_t) :: leaflet_id  !< of the triangle
    integer(c_int32_t) :: side        !< +1 if the given point is on the side to which normals point (downstream), -1 if
                                      !! it is on the other side. The side is 0 for a point on the surface, and for a
                                      !! point where the surface would continue beyond its rim. If the closest point is
                                      !! on an edge or vertex of several triangles, the angle-weighted mean of their
                                      !! normals gives the side (Baerentzen, Aanaes 2005). Vertices with equal
                                      !! coordinates after placement count as one vertex
  end type riis_closest

  type, bind(c) :: riis_closest_options
    integer(c_int64_t) :: struct_size
    real(c_double) :: distance_limit
    real(c_double) :: far_distance
    type(c_ptr) :: point_mask !< integer(c_int8_t), (n_points), or c_null_ptr
    integer(c_int64_t) :: n_point_ids
    type(c_ptr) :: point_ids  !< integer(c_int64_t), (n_point_ids), from 0; or c_null_ptr
    integer(c_int32_t) :: n_threads
    integer(c_int32_t) :: reserved
  end type riis_closest_options

  !> c_null_ptr for arrays that are not wanted
  type, bind(c) :: riis_closest_arrays
    integer(c_int64_t) :: struct_size
    type(c_ptr) :: distance    !< real(c_double), (n_points)
    type(c_ptr) :: point       !< real(c_double), (3, n_points)
    type(c_ptr) :: barycentric !< real(c_double), (3, n_points)
    type(c_ptr) :: normal      !< real(c_double), (3, n_points)
    type(c_ptr) :: triangle_id !< integer(c_int64_t), (n_points)
    type(c_ptr) :: leaflet_id  !< integer(c_int32_t), (n_points)
    type(c_ptr) :: side        !< integer(c_int32_t), (n_points)
  end type riis_closest_arrays

  type, bind(c) :: riis_crossing_options
    integer(c_int64_t) :: struct_size
    real(c_double) :: depth
    integer(c_int32_t) :: n_threads
    integer(c_int32_t) :: reserved
  end type riis_crossing_options

  !> c_null_ptr for arrays without pairs
  type, bind(c) :: riis_crossing_list
    integer(c_int64_t) :: n_pairs
    type(c_ptr) :: triangle_id !< integer(c_int64_t), (2, n_pairs)
    type(c_ptr) :: point       !< real(c_double), (3, n_pairs)
    type(c_ptr) :: depth       !< real(c_double), (n_pairs)
    type(c_ptr) :: length      !< real(c_double), (n_pairs)
    real(c_double) :: total_length
    real(c_double) :: deepest_depth
    real(c_double) :: deepest_point(3)
    integer(c_int64_t) :: deepest_triangle_id(2)
    integer(c_int32_t) :: deepest_leaflet_id(2)
    real(c_double) :: seconds
  end type riis_crossing_list

  type, bind(c) :: riis_grid
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: ni, nj, nk
    type(c_ptr) :: x !< real(c_double) or (c_float), (ni), or c_null_ptr
    type(c_ptr) :: y !< real(c_double) or (c_float), (nj), or c_null_ptr
    type(c_ptr) :: z !< real(c_double) or (c_float), (nk), or c_null_ptr
    real(c_double) :: origin(3)
    real(c_double) :: spacing(3)
    integer(c_int64_t) :: first
    integer(c_int64_t) :: stride(3)
    integer(c_int64_t) :: n_nodes
    integer(c_int32_t) :: real_bits
    integer(c_int32_t) :: reserved
  end type riis_grid

  type, bind(c) :: riis_csr
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_rows
    integer(c_int64_t) :: n_all
    type(c_ptr) :: offsets !< integer(c_int32_t) or (c_int64_t), (n_rows + 1)
    type(c_ptr) :: columns !< integer(c_int32_t) or (c_int64_t), (offsets(n_rows + 1) - index_base)
    integer(c_int32_t) :: offset_bits
    integer(c_int32_t) :: column_bits
    integer(c_int32_t) :: index_base
    integer(c_int32_t) :: reserved
  end type riis_csr

  type, bind(c) :: riis_mesh_cells
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_nodes
    integer(c_int64_t) :: n_cells
    type(c_ptr) :: node_ids !< integer(c_int32_t) or (c_int64_t), (nodes_per_cell, n_cells)
    type(c_ptr) :: offsets  !< integer(c_int32_t) or (c_int64_t), (n_cells + 1), of the same kind as node_ids, from 0 or
                            !! from index_base; or c_null_ptr
    integer(c_int32_t) :: nodes_per_cell
    integer(c_int32_t) :: id_bits
    integer(c_int32_t) :: index_base
    integer(c_int32_t) :: n_threads
  end type riis_mesh_cells

  type, bind(c) :: riis_mesh_faces
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_cells
    integer(c_int64_t) :: n_faces
    type(c_ptr) :: owner    !< integer(c_int32_t) or (c_int64_t), (n_faces), or c_loc(face_cells(1, 1)) of face_cells(2,
                            !! n_faces)
    type(c_ptr) :: neighbor !< integer(c_int32_t) or (c_int64_t), (n_faces), or c_loc(face_cells(2, 1))
    integer(c_int64_t) :: stride
    integer(c_int32_t) :: id_bits
    integer(c_int32_t) :: index_base
    integer(c_int32_t) :: n_threads
    integer(c_int32_t) :: reserved
  end type riis_mesh_faces

  type, bind(c) :: riis_resistance
    integer(c_int64_t) :: struct_size
    real(c_double) :: R
    real(c_double) :: half_thickness
    integer(c_int32_t) :: rim
    integer(c_int32_t) :: reserved
  end type riis_resistance

  type, bind(c) :: riis_mark_options
    integer(c_int64_t) :: struct_size
    real(c_double) :: distance_limit
    type(c_ptr) :: node_mask  !< integer(c_int8_t), (n_nodes), or c_null_ptr
    type(c_ptr) :: resistance !< type(riis_resistance), (*), c_loc of a riis_resistance; or c_null_ptr
    integer(c_int32_t) :: fields
    integer(c_int32_t) :: search
    integer(c_int32_t) :: n_threads
    integer(c_int32_t) :: instructions
  end type riis_mark_options

  !> c_null_ptr for arrays that were not requested or have no nodes
  type, bind(c) :: riis_mark_list
    integer(c_int64_t) :: n_nodes
    type(c_ptr) :: node_id           !< integer(c_int64_t), (n_nodes)
    type(c_ptr) :: distance          !< real(c_double), (n_nodes)
    type(c_ptr) :: triangle_id       !< integer(c_int64_t), (n_nodes)
    type(c_ptr) :: leaflet_id        !< integer(c_int32_t), (n_nodes)
    type(c_ptr) :: K                 !< real(c_double), (n_nodes), or c_null_ptr
    type(c_ptr) :: K_u_surface       !< real(c_double), (3, n_nodes), or c_null_ptr
    type(c_ptr) :: point             !< real(c_double), (3, n_nodes)
    type(c_ptr) :: normal            !< real(c_double), (3, n_nodes)
    type(c_ptr) :: barycentric       !< real(c_double), (3, n_nodes)
    type(c_ptr) :: uv                !< real(c_double), (2, n_nodes)
    type(c_ptr) :: velocity          !< real(c_double), (3, n_nodes)
    type(c_ptr) :: side              !< integer(c_int32_t), (n_nodes)
    type(c_ptr) :: rim               !< integer(c_int32_t), (n_nodes)
    type(c_ptr) :: patch_id          !< integer(c_int32_t), (n_nodes)
    integer(c_int64_t) :: n_directions
    type(c_ptr) :: distance_gradient !< real(c_double), (n_directions, n_nodes)
    type(c_ptr) :: K_gradient        !< real(c_double), (n_directions, n_nodes), or c_null_ptr
    type(c_ptr) :: height            !< real(c_double), (n_nodes), or c_null_ptr
  end type riis_mark_list

  !> c_null_ptr for arrays that are not wanted
  type, bind(c) :: riis_dense_arrays
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_nodes
    real(c_double) :: far_distance
    type(c_ptr) :: mark        !< integer(c_int8_t), (n_nodes)
    type(c_ptr) :: distance    !< real(c_double), (n_nodes)
    type(c_ptr) :: triangle_id !< integer(c_int64_t), (n_nodes)
    type(c_ptr) :: leaflet_id  !< integer(c_int32_t), (n_nodes)
  end type riis_dense_arrays

  !> Counts and times of the last marking.
  type, bind(c) :: riis_mark_stats
    integer(c_int64_t) :: n_nodes        !< the number of nodes of the mesh, masked out or not
    integer(c_int64_t) :: n_marked       !< the length of RIIS_LIST_MARKED
    integer(c_int64_t) :: n_within_limit !< the number of nodes within the distance limit, marked or not
    integer(c_int64_t) :: n_queries      !< the number of closest-point queries for nodes and for parts of the mesh
    real(c_double) :: seconds            !< wall time of riis_mark_nodes
    integer(c_int32_t) :: search         !< the search that ran, never RIIS_SEARCH_AUTO
    integer(c_int32_t) :: n_threads      !< the largest number of threads that any part of the marking used. A limit
                                         !! that the caller sets for TBB's threads affects only the walks of the
                                         !! neighbour search
    integer(c_int32_t) :: complete       !< 1: all nodes within the limit were found, for the coordinates that the mesh
                                         !! had when it was made or last updated. 0: nodes may have been missed
    integer(c_int32_t) :: instructions   !< the instructions that were used, never RIIS_INSTRUCTIONS_AUTO
    integer(c_int64_t) :: n_unreached    !< the number of nodes within the limit that the neighbour search found without
                                         !! walking to them
  end type riis_mark_stats

  type, bind(c) :: riis_resistance_arrays
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_nodes
    type(c_ptr) :: K              !< real(c_double), (n_nodes), or c_null_ptr
    integer(c_int64_t) :: K_stride
    type(c_ptr) :: K_u_surface(3) !< real(c_double), (n_nodes), for each component: c_loc(u(1, 1)), c_loc(u(2, 1)),
                                  !! c_loc(u(3, 1)); or c_null_ptr
    integer(c_int64_t) :: K_u_surface_stride
  end type riis_resistance_arrays

  type, bind(c) :: riis_flow_arrays
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_nodes
    type(c_ptr) :: velocity(3) !< real(c_double), (n_nodes), for each component: c_loc(u(1, 1)), c_loc(u(2, 1)),
                               !! c_loc(u(3, 1))
    integer(c_int64_t) :: velocity_stride
    type(c_ptr) :: weight      !< real(c_double), (n_nodes)
  end type riis_flow_arrays

  !> c_null_ptr for sums that are not wanted
  type, bind(c) :: riis_reaction
    integer(c_int64_t) :: struct_size
    real(c_double) :: about(3)
    type(c_ptr) :: force           !< real(c_double), (3)
    type(c_ptr) :: moment          !< real(c_double), (3)
    integer(c_int64_t) :: n_leaflets
    type(c_ptr) :: leaflet_force   !< real(c_double), (3, n_leaflets)
    type(c_ptr) :: leaflet_moment  !< real(c_double), (3, n_leaflets)
    integer(c_int64_t) :: n_edges
    type(c_ptr) :: edges           !< real(c_double), (3, 2, n_edges)
    type(c_ptr) :: edge_leaflet_id !< integer(c_int32_t), (n_edges), or c_null_ptr
    type(c_ptr) :: edge_force      !< real(c_double), (3, n_edges)
    type(c_ptr) :: edge_moment     !< real(c_double), (3, n_edges)
  end type riis_reaction

  !> Sums over the nodes on either side of the surface: entry 1 is upstream, side -1, entry 2 downstream.
  type, bind(c) :: riis_band_sums
    real(c_double) :: sum(2)         !< the sums of weight * value
    real(c_double) :: weight(2)      !< the sums of weight
    integer(c_int64_t) :: n_nodes(2) !< the numbers of nodes in the band
  end type riis_band_sums

  type, bind(c) :: riis_band
    integer(c_int64_t) :: struct_size
    real(c_double) :: inner, outer
    integer(c_int64_t) :: n_nodes
    type(c_ptr) :: value  !< real(c_double), (n_nodes)
    type(c_ptr) :: weight !< real(c_double), (n_nodes)
  end type riis_band

  type, bind(c) :: riis_loads
    integer(c_int64_t) :: struct_size
    real(c_double) :: radius
    real(c_double) :: about(3)
    integer(c_int64_t) :: n_leaflets
    type(c_ptr) :: leaflet_force   !< real(c_double), (3, n_leaflets)
    type(c_ptr) :: leaflet_moment  !< real(c_double), (3, n_leaflets)
    integer(c_int64_t) :: n_edges
    type(c_ptr) :: edges           !< real(c_double), (3, 2, n_edges)
    type(c_ptr) :: edge_leaflet_id !< integer(c_int32_t), (n_edges), or c_null_ptr
    integer(c_int32_t) :: n_threads
    integer(c_int32_t) :: reserved
  end type riis_loads

  !> c_null_ptr for arrays without edges
  type, bind(c) :: riis_leak_list
    integer(c_int64_t) :: n_edges
    type(c_ptr) :: node_id  !< integer(c_int64_t), (2, n_edges)
    type(c_ptr) :: length   !< real(c_double), (n_edges)
    type(c_ptr) :: distance !< real(c_double), (n_edges)
    real(c_double) :: half_thickness
    integer(c_int64_t) :: longest_node_id(2)
    real(c_double) :: longest_length
    real(c_double) :: longest_middle(3)
    real(c_double) :: seconds
  end type riis_leak_list

  !> The widest passage from one set of nodes to another: the path along mesh edges that stays farthest from the
  !! surface.
  type, bind(c) :: riis_passage
    integer(c_int64_t) :: node_id  !< the node of the path that is nearest to the surface; -1 if there is no path. Of
                                   !! equally near nodes, the one with the highest id counts
    real(c_double) :: distance     !< the distance of node_id from the surface; 0 if there is no path. The passage is
                                   !! closed if the half thickness is at least this distance, otherwise open. If the
                                   !! surface has an offset o, the distance of a node is replaced by the least half
                                   !! thickness that marks the node. With the signed distance s, this is s / (1 + o) for
                                   !! s >= 0, and -s / (1 - o) for s < 0
    real(c_double) :: point(3)     !< the coordinates of node_id; 0 without a path
    real(c_double) :: seconds      !< wall time of riis_find_passage
    integer(c_int32_t) :: state    !< RIIS_PASSAGE_*
    integer(c_int32_t) :: reserved !< 0
  end type riis_passage

  type, bind(c) :: riis_passage_ends
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_from
    type(c_ptr) :: from !< integer(c_int64_t), (n_from)
    integer(c_int64_t) :: n_to
    type(c_ptr) :: to   !< integer(c_int64_t), (n_to)
  end type riis_passage_ends

  !> A leaflet of a surface. Lengths are in mesh units.
  type, bind(c) :: riis_leaflet
    integer(c_int64_t) :: n_triangles !< the number of the leaflet's triangles with an area above 0
    real(c_double) :: area            !< the sum of the areas of these triangles
    real(c_double) :: free_edge       !< the length of the free edge, 0 for a skirt. The free edge of a valve's leaflet
                                      !! consists of the sides v = 1 that belong to only one patch of the leaflet. In a
                                      !! surface from arrays, the free edge consists of the edges that belong to only
                                      !! one triangle, without the longest closed line of such edges
    integer(c_int32_t) :: leaflet_id  !< as in riis_triangles
    integer(c_int32_t) :: reserved    !< 0
  end type riis_leaflet

  !> The orifice of a surface: the part of the area inside an outline that the triangles do not cover, seen along an
  !! axis. The axis has the direction of the vector area that the edges of the outline enclose. For a valve, the axis
  !! points towards the valve's +z. For a surface from arrays or keyframes, the axis points to the side of the normals.
  !! For a bileaflet valve, the axis is the valve's z axis. Skirts are left out. If leaflets from arrays do not touch at
  !! the commissures, straight lines join their ends. Lengths are in mesh units (docs/theory/measures.md, "Outline").
  type, bind(c) :: riis_orifice
    real(c_double) :: area           !< the area of the orifice. If there is no outline, all fields except axis and
                                     !! rim_reach are 0
    real(c_double) :: outline_area   !< the area inside the outline
    real(c_double) :: perimeter      !< the length of the orifice's edge along the triangles. Before the measurement,
                                     !! the edge is moved inwards by a tenth of the half thickness, so that narrow slits
                                     !! vanish. Parts of the edge that lie on the outline count as walls, and do not add
                                     !! to the perimeter
    real(c_double) :: effective_area !< the area that the band around the leaflets leaves for the flow. To find it, the
                                     !! edge of the orifice along the triangles is moved inwards by rim_reach *
                                     !! half_thickness. To first order the effective area is area - rim_reach *
                                     !! half_thickness * perimeter. The effective area is never below 0
    real(c_double) :: rim_reach      !< how far the band narrows the orifice, in half thicknesses: 0.84 for a round rim,
                                     !! 0.70 for a cut rim. Computed flows through open valves gave 0.70 to 0.98 for a
                                     !! round rim, and 0.46 to 0.95 for a cut rim (docs/validation.md). If the surface
                                     !! has an offset o, rim_reach is multiplied by max(0, 1 - o / 1.05) for a round
                                     !! rim, by max(0, 1 - o / 0.85) for a cut rim, by max(0, 1 - o / 0.8) for a cut rim
                                     !! of a mitral valve, and by 1 for a bileaflet valve
    real(c_double) :: half_thickness !< the half thickness of the resistance
    real(c_double) :: radius         !< the radius of the disc; 0 for other outlines
    real(c_double) :: axis(3)        !< unit vector; 0 for a surface from arrays or keyframes without an outline
    integer(c_int32_t) :: outline    !< RIIS_OUTLINE_*
    integer(c_int32_t) :: reserved   !< 0
  end type riis_orifice

  type, bind(c) :: riis_area_search
    integer(c_int64_t) :: struct_size
    type(c_ptr) :: surface    !< type(riis_surface_options), (*), c_loc of a riis_surface_options; or c_null_ptr
    type(c_ptr) :: resistance !< type(riis_resistance), (*), c_loc of a riis_resistance; or c_null_ptr
    real(c_double) :: from, to
    real(c_double) :: tolerance
    integer(c_int32_t) :: n_samples
    integer(c_int32_t) :: area
  end type riis_area_search

  !> The areas of a valve in the range of openings or sizes that riis_find_by_area searched.
  type, bind(c) :: riis_area_range
    real(c_double) :: from, to          !< the range that was searched
    real(c_double) :: least, most       !< the least and the largest area in this range
    real(c_double) :: least_at, most_at !< the opening or size with the least area, and the one with the largest area
    real(c_double) :: turns(4)          !< the first openings or sizes at which the area turns from growing to falling,
                                        !! or from falling to growing. Unused entries are NaN. A change of the area by
                                        !! less than 1e-4 of the largest area does not count
    real(c_double) :: seconds           !< wall time of riis_find_by_area
    integer(c_int64_t) :: n_turns       !< the number of all such openings or sizes. If n_turns is 0, the area only
                                        !! grows or only falls
    integer(c_int64_t) :: n_surfaces    !< the number of surfaces that the search made. The cost of the search grows
                                        !! with this number
    integer(c_int64_t) :: n_refused     !< the number of sampled openings or sizes for which there is no valve or no
                                        !! orifice. The search leaves them out
  end type riis_area_range

  !> The coaptation of a leaflet: the part of the leaflet that touches other leaflets. Lengths are in mesh units.
  type, bind(c) :: riis_coaptation
    real(c_double) :: area  !< the area of the part of the leaflet whose distance from another leaflet is at most
                            !! `reach`
    real(c_double) :: edge  !< the length of the part of the free edge (riis_leaflet) whose distance from another
                            !! leaflet is at most `reach`
    real(c_double) :: reach !< the distance up to which leaflets count as touching
  end type riis_coaptation

  type, bind(c) :: riis_first_passage_options
    integer(c_int64_t) :: struct_size
    type(c_ptr) :: surface !< type(riis_surface_options), (*), c_loc of a riis_surface_options; or c_null_ptr
    type(c_ptr) :: marking !< type(riis_mark_options), (*), c_loc of a riis_mark_options; or c_null_ptr
    real(c_double) :: tolerance
  end type riis_first_passage_options

  !> The first opening at which the marked mesh has a passage.
  type, bind(c) :: riis_first_passage
    real(c_double) :: opening        !< the first opening with a passage; 0 for ALWAYS, 1 for NEVER, 0 for NONE
    real(c_double) :: closed_opening !< with RIIS_FIRST_PASSAGE_FOUND, the largest opening below `opening` at which the
                                     !! call found no passage. In other states it equals `opening`
    integer(c_int64_t) :: node_id    !< the node of the passage at `opening`, as in riis_passage
    real(c_double) :: distance       !< as in riis_passage
    real(c_double) :: point(3)       !< as in riis_passage
    real(c_double) :: seconds        !< wall time of riis_find_first_passage
    integer(c_int32_t) :: n_openings !< the number of openings that were tried
    integer(c_int32_t) :: state      !< RIIS_FIRST_PASSAGE_*
  end type riis_first_passage

  !> How many mesh edges fit across the band, computed from the lengths of the mesh edges with a marked node.
  type, bind(c) :: riis_cells_across
    real(c_double) :: least, mean, most       !< the numbers of mesh edges across the band: 2 * half_thickness divided
                                              !! by longest_edge, by mean_edge and by shortest_edge
    real(c_double) :: shortest_edge, mean_edge, longest_edge !< the lengths of the mesh edges with a marked node
    real(c_double) :: half_thickness          !< the half thickness of the marking
    integer(c_int64_t) :: n_edges             !< the number of edges with at least one marked node. If n_edges is 0, all
                                              !! fields except half_thickness are 0
  end type riis_cells_across

  type, bind(c) :: riis_landmarks
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_landmarks
    type(c_ptr) :: x, y, z    !< real(c_double) or (c_float), (n_landmarks), or xyz(3, n_landmarks): c_loc(xyz(1, 1)),
                              !! c_loc(xyz(2, 1)), ...
    integer(c_int64_t) :: stride
    type(c_ptr) :: role       !< integer(c_int32_t), (n_landmarks)
    type(c_ptr) :: leaflet_id !< integer(c_int32_t), (2, n_landmarks), or c_null_ptr
    real(c_double) :: scale
    real(c_double) :: noise
    real(c_double) :: flow(3)
    integer(c_int32_t) :: real_bits
    integer(c_int32_t) :: reserved
  end type riis_landmarks

  !> The placement that riis_place finds. To place a surface, copy scale, rotation and translation to the fields of the
  !! same names in riis_surface_options.
  type, bind(c) :: riis_placement
    real(c_double) :: scale                 !< riis_landmarks.scale. With this scale, the default half thickness of a
                                            !! surface is 0.1 cm
    real(c_double) :: rotation_axis(3)      !< unit vector
    real(c_double) :: rotation_angle        !< degrees, 0 to 180
    real(c_double) :: translation(3)        !< mesh units
    real(c_double) :: rms                   !< the root mean square of the residuals (riis_placement_arrays.residual),
                                            !! mesh units
    real(c_double) :: worst                 !< the largest residual, mesh units
    real(c_double) :: noise                 !< the noise that the standard errors are computed from:
                                            !! riis_landmarks.noise, or more if the residuals show more noise
    real(c_double) :: rotation_error        !< standard error of the rotation, degrees
    real(c_double) :: position_error        !< standard error of the position of the valve's origin, mesh units
    integer(c_int64_t) :: worst_landmark_id !< the landmark with the largest residual
    integer(c_int32_t) :: n_undetermined    !< the number of parameters with RIIS_SIZE_UNDETERMINED
    integer(c_int32_t) :: n_as_annulus      !< the number of trigones that lie behind the anterior horn. The model has
                                            !! no trigones there, so these landmarks count as points of the annulus, and
                                            !! have no influence on IT_distance
  end type riis_placement

  !> c_null_ptr for arrays that are not wanted
  type, bind(c) :: riis_placement_arrays
    integer(c_int64_t) :: struct_size
    type(c_ptr) :: residual       !< real(c_double), (n_landmarks)
    type(c_ptr) :: standard_error !< real(c_double), (n_parameters)
    type(c_ptr) :: size_state     !< integer(c_int32_t), (n_parameters)
    type(c_ptr) :: place          !< real(c_double), (3, n_landmarks)
  end type riis_placement_arrays

  type, bind(c) :: riis_warp_options
    integer(c_int64_t) :: struct_size
    real(c_double) :: noise
    type(c_ptr) :: placement !< type(riis_surface_options), (*), c_loc of a riis_surface_options; or c_null_ptr
  end type riis_warp_options

  !> How well a warp takes its sources to its targets, in the units of the landmarks.
  type, bind(c) :: riis_warp_info
    integer(c_int64_t) :: n_landmarks         !< the number of landmarks
    real(c_double) :: rms_residual            !< the root mean square of the distances between the mapped sources and
                                              !! their targets. For the distance of a target from a warped valve, call
                                              !! riis_closest_point
    real(c_double) :: largest_residual        !< the largest distance between a mapped source and its target
    integer(c_int64_t) :: largest_landmark_id !< the landmark with the largest residual
    real(c_double) :: smoothing               !< the parameter lambda of the smoothing; 0 without noise, infinite if the
                                              !! map is affine
    real(c_double) :: least_determinant       !< the least determinant of the map's derivative among the points half way
                                              !! between each landmark and the landmark nearest to it
    real(c_double) :: least_point(3)          !< the point with the least determinant
    integer(c_int32_t) :: is_planar           !< 1 if the landmarks lie nearly in a plane, else 0
    integer(c_int32_t) :: reserved            !< 0
  end type riis_warp_info

  !> The sizes of the gap between the attachment of a valve and a wall. Lengths are in mesh units.
  type, bind(c) :: riis_gap
    real(c_double) :: least, mean, most  !< the least, the mean and the largest gap at the ends of the edges of
                                         !! riis_attachment. The mean is weighted by the lengths of the edges. All three
                                         !! are 0 if no end has a gap
    real(c_double) :: widest_point(3)    !< the coordinates of that end of an edge that has the largest gap
    integer(c_int64_t) :: n_ends         !< the number of ends of edges, 2 * riis_attachment.n_edges
    integer(c_int64_t) :: n_without_wall !< the number of ends from which a line in the skirt's direction does not meet
                                         !! the wall. These ends have no gap, and count only here and in n_ends
  end type riis_gap

  type, bind(c) :: riis_direction
    integer(c_int64_t) :: n_vertices
    type(c_ptr) :: rate !< real(c_double), (3, n_vertices)
    real(c_double) :: area_rate
  end type riis_direction

  type, bind(c) :: riis_opening_table
    integer(c_int64_t) :: struct_size
    integer(c_int64_t) :: n_keys
    type(c_ptr) :: time    !< real(c_double), (n_keys)
    type(c_ptr) :: opening !< real(c_double), (n_keys)
    real(c_double) :: period
    integer(c_int32_t) :: interpolation
    integer(c_int32_t) :: reserved
  end type riis_opening_table

  type, bind(c) :: riis_opening_times
    integer(c_int64_t) :: struct_size
    real(c_double) :: opening_start
    real(c_double) :: opening_duration
    real(c_double) :: closing_start
    real(c_double) :: closing_duration
    real(c_double) :: closed, open
    real(c_double) :: period
  end type riis_opening_times

  type, bind(c) :: riis_opening_switch
    integer(c_int64_t) :: struct_size
    real(c_double) :: opening_duration
    real(c_double) :: closing_duration
    real(c_double) :: open_above
    real(c_double) :: close_below
    real(c_double) :: filter_time
    real(c_double) :: dwell_time
  end type riis_opening_switch

  type, bind(c) :: riis_opening_switch_state
    integer(c_int64_t) :: struct_size
    real(c_double) :: time
    real(c_double) :: opening, rate
    real(c_double) :: progress
    real(c_double) :: pressure_difference
    real(c_double) :: flow
    real(c_double) :: turn_time
    integer(c_int32_t) :: phase
    integer(c_int32_t) :: reserved
  end type riis_opening_switch_state

  type, bind(c) :: riis_opening_angle
    integer(c_int64_t) :: struct_size
    real(c_double) :: pressure_gain
    real(c_double) :: flow_gain
    real(c_double) :: friction
    real(c_double) :: vortex_gain
    real(c_double) :: angle_min
    real(c_double) :: angle_max
  end type riis_opening_angle

  type, bind(c) :: riis_opening_angle_state
    integer(c_int64_t) :: struct_size
    real(c_double) :: time
    real(c_double) :: opening, rate
    real(c_double) :: angle, angle_rate
    real(c_double) :: pressure_difference
    real(c_double) :: flow
  end type riis_opening_angle_state

  ! -------------------------------------------------------------------------------------------------------------------
  ! Log functions
  ! -------------------------------------------------------------------------------------------------------------------

  abstract interface
    subroutine riis_log_function(user_data, level, message) bind(c)
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: user_data           !< the pointer that was given to riis_set_log
      integer(c_int32_t), value :: level        !< RIIS_LOG_*
      type(c_ptr), value :: message             !< for riis_c_text, valid during the call only
    end subroutine riis_log_function
  end interface

  interface
    ! -----------------------------------------------------------------------------------------------------------------
    ! Status, errors, log, version
    ! -----------------------------------------------------------------------------------------------------------------

    !> For riis_c_text.
    function riis_status_name(status) result(text) bind(c, name='riis_status_name')
      import :: c_ptr, riis_status
      implicit none
      integer(riis_status), value :: status
      type(c_ptr) :: text
    end function riis_status_name

    !> For riis_c_text.
    function riis_last_error() result(text) bind(c, name='riis_last_error')
      import :: c_ptr
      implicit none
      type(c_ptr) :: text
    end function riis_last_error

    !> For riis_c_text.
    function riis_version_string() result(text) bind(c, name='riis_version_string')
      import :: c_ptr
      implicit none
      type(c_ptr) :: text
    end function riis_version_string

    !>   function   c_funloc of a procedure with the interface riis_log_function; c_null_funptr for no messages
    !!   user_data  c_loc of a target that outlives the log function, or c_null_ptr
    subroutine riis_set_log(function, user_data) bind(c, name='riis_set_log')
      import :: c_funptr, c_ptr
      implicit none
      type(c_funptr), value :: function
      type(c_ptr), value :: user_data
    end subroutine riis_set_log

    !>   struct_size  c_sizeof(points)
    function riis_points_init(points, struct_size) result(status) bind(c, name='riis_points_init')
      import :: c_int64_t, riis_points, riis_status
      implicit none
      type(riis_points), intent(inout) :: points
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_points_init

    ! -----------------------------------------------------------------------------------------------------------------
    ! Valve
    ! -----------------------------------------------------------------------------------------------------------------

    !>   kind  riis_c_string('aortic'), 'tricuspid' or another kind of riis.h
    function riis_valve_create(kind, valve) result(status) bind(c, name='riis_valve_create')
      import :: c_char, c_ptr, riis_status
      implicit none
      character(kind=c_char), intent(in) :: kind(*)
      type(c_ptr), intent(inout) :: valve
      integer(riis_status) :: status
    end function riis_valve_create

    function riis_valve_copy(valve, copy) result(status) bind(c, name='riis_valve_copy')
      import :: c_ptr, riis_status
      implicit none
      type(c_ptr), value :: valve
      type(c_ptr), intent(inout) :: copy
      integer(riis_status) :: status
    end function riis_valve_copy

    subroutine riis_valve_destroy(valve) bind(c, name='riis_valve_destroy')
      import :: c_ptr
      implicit none
      type(c_ptr), intent(inout) :: valve
    end subroutine riis_valve_destroy

    !>   name    riis_c_string('right.rotation')
    !!   values  (n_values)
    function riis_valve_set(valve, name, n_values, values) result(status) bind(c, name='riis_valve_set')
      import :: c_char, c_double, c_int64_t, c_ptr, riis_status
      implicit none
      type(c_ptr), value :: valve
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: n_values
      real(c_double), intent(in) :: values(*)
      integer(riis_status) :: status
    end function riis_valve_set

    function riis_valve_set_scalar(valve, name, value) result(status) bind(c, name='riis_valve_set_scalar')
      import :: c_char, c_double, c_ptr, riis_status
      implicit none
      type(c_ptr), value :: valve
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), value :: value
      integer(riis_status) :: status
    end function riis_valve_set_scalar

    !>   values  (n_values)
    function riis_valve_get(valve, name, n_values, values) result(status) bind(c, name='riis_valve_get')
      import :: c_char, c_double, c_int64_t, c_ptr, riis_status
      implicit none
      type(c_ptr), value :: valve
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: n_values
      real(c_double), intent(inout) :: values(*)
      integer(riis_status) :: status
    end function riis_valve_get

    function riis_valve_unset(valve, name) result(status) bind(c, name='riis_valve_unset')
      import :: c_char, c_ptr, riis_status
      implicit none
      type(c_ptr), value :: valve
      character(kind=c_char), intent(in) :: name(*)
      integer(riis_status) :: status
    end function riis_valve_unset

    function riis_valve_is_set(valve, name, is_set) result(status) bind(c, name='riis_valve_is_set')
      import :: c_char, c_int32_t, c_ptr, riis_status
      implicit none
      type(c_ptr), value :: valve
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t), intent(inout) :: is_set
      integer(riis_status) :: status
    end function riis_valve_is_set

    function riis_valve_set_open_state(valve, open) result(status) bind(c, name='riis_valve_set_open_state')
      import :: c_ptr, riis_status
      implicit none
      type(c_ptr), value :: valve
      type(c_ptr), value :: open
      integer(riis_status) :: status
    end function riis_valve_set_open_state

    !>   struct_size  c_sizeof(patches)
    function riis_patches_init(patches, struct_size) result(status) bind(c, name='riis_patches_init')
      import :: c_int64_t, riis_patches, riis_status
      implicit none
      type(riis_patches), intent(inout) :: patches
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_patches_init

    function riis_valve_create_from_patches(patches, valve) result(status) &
        bind(c, name='riis_valve_create_from_patches')
      import :: c_ptr, riis_patches, riis_status
      implicit none
      type(riis_patches), intent(in) :: patches
      type(c_ptr), intent(inout) :: valve
      integer(riis_status) :: status
    end function riis_valve_create_from_patches

    function riis_valve_get_n_parameters(valve, n_parameters) result(status) bind(c, name='riis_valve_get_n_parameters')
      import :: c_int64_t, c_ptr, riis_status
      implicit none
      type(c_ptr), value :: valve
      integer(c_int64_t), intent(inout) :: n_parameters
      integer(riis_status) :: status
    end function riis_valve_get_n_parameters

    !>   parameter_id  from 0
    !!   struct_size   c_sizeof(parameter)
    function riis_valve_get_parameter(valve, parameter_id, parameter, struct_size) result(status) &
        bind(c, name='riis_valve_get_parameter')
      import :: c_int64_t, c_ptr, riis_parameter, riis_status
      implicit none
      type(c_ptr), value :: valve
      integer(c_int64_t), value :: parameter_id
      type(riis_parameter), intent(inout) :: parameter
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_valve_get_parameter

    !>   struct_size  c_sizeof(patches)
    function riis_valve_get_patches(valve, patches, struct_size) result(status) bind(c, name='riis_valve_get_patches')
      import :: c_int64_t, c_ptr, riis_status, riis_valve_patches
      implicit none
      type(c_ptr), value :: valve
      type(riis_valve_patches), intent(inout) :: patches
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_valve_get_patches

    ! -----------------------------------------------------------------------------------------------------------------
    ! Surface
    ! -----------------------------------------------------------------------------------------------------------------

    !>   struct_size  c_sizeof(options)
    function riis_surface_options_init(options, struct_size) result(status) bind(c, name='riis_surface_options_init')
      import :: c_int64_t, riis_status, riis_surface_options
      implicit none
      type(riis_surface_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_options_init

    !>   options  if left out: all defaults
    function riis_surface_create(valve, options, surface) result(status) bind(c, name='riis_surface_create')
      import :: c_ptr, riis_status, riis_surface_options
      implicit none
      type(c_ptr), value :: valve
      type(riis_surface_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: surface
      integer(riis_status) :: status
    end function riis_surface_create

    !>   struct_size  c_sizeof(arrays)
    function riis_surface_arrays_init(arrays, struct_size) result(status) bind(c, name='riis_surface_arrays_init')
      import :: c_int64_t, riis_status, riis_surface_arrays
      implicit none
      type(riis_surface_arrays), intent(inout) :: arrays
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_arrays_init

    !>   options  if left out: all defaults
    function riis_surface_create_from_arrays(arrays, options, surface) result(status) &
        bind(c, name='riis_surface_create_from_arrays')
      import :: c_ptr, riis_status, riis_surface_arrays, riis_surface_options
      implicit none
      type(riis_surface_arrays), intent(in) :: arrays
      type(riis_surface_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: surface
      integer(riis_status) :: status
    end function riis_surface_create_from_arrays

    !>   options  if left out: the present options of the surface
    function riis_surface_update(surface, valve, options) result(status) bind(c, name='riis_surface_update')
      import :: c_ptr, riis_status, riis_surface_options
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), value :: valve
      type(riis_surface_options), intent(in), optional :: options
      integer(riis_status) :: status
    end function riis_surface_update

    !>   options  if left out: the surface's own options
    function riis_surface_update_from_arrays(surface, arrays, options) result(status) &
        bind(c, name='riis_surface_update_from_arrays')
      import :: c_ptr, riis_status, riis_surface_arrays, riis_surface_options
      implicit none
      type(c_ptr), value :: surface
      type(riis_surface_arrays), intent(in) :: arrays
      type(riis_surface_options), intent(in), optional :: options
      integer(riis_status) :: status
    end function riis_surface_update_from_arrays

    subroutine riis_surface_destroy(surface) bind(c, name='riis_surface_destroy')
      import :: c_ptr
      implicit none
      type(c_ptr), intent(inout) :: surface
    end subroutine riis_surface_destroy

    !>   struct_size  c_sizeof(info)
    function riis_surface_get_info(surface, info, struct_size) result(status) bind(c, name='riis_surface_get_info')
      import :: c_int64_t, c_ptr, riis_status, riis_surface_info
      implicit none
      type(c_ptr), value :: surface
      type(riis_surface_info), intent(inout) :: info
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_get_info

    !>   struct_size  c_sizeof(triangles)
    function riis_surface_get_triangles(surface, triangles, struct_size) result(status) &
        bind(c, name='riis_surface_get_triangles')
      import :: c_int64_t, c_ptr, riis_status, riis_triangles
      implicit none
      type(c_ptr), value :: surface
      type(riis_triangles), intent(inout) :: triangles
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_get_triangles

    !>   struct_size  c_sizeof(attachment)
    function riis_surface_get_attachment(surface, attachment, struct_size) result(status) &
        bind(c, name='riis_surface_get_attachment')
      import :: c_int64_t, c_ptr, riis_attachment, riis_status
      implicit none
      type(c_ptr), value :: surface
      type(riis_attachment), intent(inout) :: attachment
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_get_attachment

    ! -----------------------------------------------------------------------------------------------------------------
    ! Motion
    ! -----------------------------------------------------------------------------------------------------------------

    !>   options         if left out: the surface's own options
    !!   options_before  if left out: the earlier state has the placement of the new state
    function riis_surface_update_moving(surface, valve, valve_before, dt, options, options_before) result(status) &
        bind(c, name='riis_surface_update_moving')
      import :: c_double, c_ptr, riis_status, riis_surface_options
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), value :: valve, valve_before
      real(c_double), value :: dt
      type(riis_surface_options), intent(in), optional :: options, options_before
      integer(riis_status) :: status
    end function riis_surface_update_moving

    !>   struct_size  c_sizeof(frames)
    function riis_keyframe_arrays_init(frames, struct_size) result(status) bind(c, name='riis_keyframe_arrays_init')
      import :: c_int64_t, riis_keyframe_arrays, riis_status
      implicit none
      type(riis_keyframe_arrays), intent(inout) :: frames
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_keyframe_arrays_init

    function riis_keyframes_create(arrays, frames, keyframes) result(status) bind(c, name='riis_keyframes_create')
      import :: c_ptr, riis_keyframe_arrays, riis_status, riis_surface_arrays
      implicit none
      type(riis_surface_arrays), intent(in) :: arrays
      type(riis_keyframe_arrays), intent(in) :: frames
      type(c_ptr), intent(inout) :: keyframes
      integer(riis_status) :: status
    end function riis_keyframes_create

    subroutine riis_keyframes_destroy(keyframes) bind(c, name='riis_keyframes_destroy')
      import :: c_ptr
      implicit none
      type(c_ptr), intent(inout) :: keyframes
    end subroutine riis_keyframes_destroy

    !>   options  if left out: all defaults
    function riis_surface_create_from_keyframes(keyframes, time, dt, options, surface) result(status) &
        bind(c, name='riis_surface_create_from_keyframes')
      import :: c_double, c_ptr, riis_status, riis_surface_options
      implicit none
      type(c_ptr), value :: keyframes
      real(c_double), value :: time, dt
      type(riis_surface_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: surface
      integer(riis_status) :: status
    end function riis_surface_create_from_keyframes

    !>   options  if left out: the surface's own options
    function riis_surface_update_from_keyframes(surface, keyframes, time, dt, options) result(status) &
        bind(c, name='riis_surface_update_from_keyframes')
      import :: c_double, c_ptr, riis_status, riis_surface_options
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), value :: keyframes
      real(c_double), value :: time, dt
      type(riis_surface_options), intent(in), optional :: options
      integer(riis_status) :: status
    end function riis_surface_update_from_keyframes

    ! -----------------------------------------------------------------------------------------------------------------
    ! Closest points
    ! -----------------------------------------------------------------------------------------------------------------

    !>   struct_size  c_sizeof(closest)
    function riis_closest_point(surface, point, closest, struct_size) result(status) bind(c, name='riis_closest_point')
      import :: c_double, c_int64_t, c_ptr, riis_closest, riis_status
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: point(3)
      type(riis_closest), intent(inout) :: closest
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_closest_point

    !>   struct_size  c_sizeof(options)
    function riis_closest_options_init(options, struct_size) result(status) bind(c, name='riis_closest_options_init')
      import :: c_int64_t, riis_closest_options, riis_status
      implicit none
      type(riis_closest_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_closest_options_init

    !>   struct_size  c_sizeof(arrays)
    function riis_closest_arrays_init(arrays, struct_size) result(status) bind(c, name='riis_closest_arrays_init')
      import :: c_int64_t, riis_closest_arrays, riis_status
      implicit none
      type(riis_closest_arrays), intent(inout) :: arrays
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_closest_arrays_init

    !>   options  if left out: all defaults
    function riis_closest_points(surface, points, options, arrays) result(status) bind(c, name='riis_closest_points')
      import :: c_ptr, riis_closest_arrays, riis_closest_options, riis_points, riis_status
      implicit none
      type(c_ptr), value :: surface
      type(riis_points), intent(in) :: points
      type(riis_closest_options), intent(in), optional :: options
      type(riis_closest_arrays), intent(in) :: arrays
      integer(riis_status) :: status
    end function riis_closest_points

    ! -----------------------------------------------------------------------------------------------------------------
    ! Crossings
    ! -----------------------------------------------------------------------------------------------------------------

    !>   struct_size  c_sizeof(options)
    function riis_crossing_options_init(options, struct_size) result(status) bind(c, name='riis_crossing_options_init')
      import :: c_int64_t, riis_crossing_options, riis_status
      implicit none
      type(riis_crossing_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_crossing_options_init

    function riis_crossings_create(crossings) result(status) bind(c, name='riis_crossings_create')
      import :: c_ptr, riis_status
      implicit none
      type(c_ptr), intent(inout) :: crossings
      integer(riis_status) :: status
    end function riis_crossings_create

    subroutine riis_crossings_destroy(crossings) bind(c, name='riis_crossings_destroy')
      import :: c_ptr
      implicit none
      type(c_ptr), intent(inout) :: crossings
    end subroutine riis_crossings_destroy

    !>   options  if left out: all defaults
    function riis_find_crossings(surface, options, crossings) result(status) bind(c, name='riis_find_crossings')
      import :: c_ptr, riis_crossing_options, riis_status
      implicit none
      type(c_ptr), value :: surface
      type(riis_crossing_options), intent(in), optional :: options
      type(c_ptr), value :: crossings
      integer(riis_status) :: status
    end function riis_find_crossings

    !>   struct_size  c_sizeof(list)
    function riis_crossings_get_list(crossings, list, struct_size) result(status) &
        bind(c, name='riis_crossings_get_list')
      import :: c_int64_t, c_ptr, riis_crossing_list, riis_status
      implicit none
      type(c_ptr), value :: crossings
      type(riis_crossing_list), intent(inout) :: list
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_crossings_get_list

    ! -----------------------------------------------------------------------------------------------------------------
    ! Mesh
    ! -----------------------------------------------------------------------------------------------------------------

    !>   x, y, z  c_loc of real(c_double) targets, borrowed until the mesh is destroyed or updated: c_loc(xyz(1, 1)),
    !!            c_loc(xyz(2, 1)), c_loc(xyz(3, 1)) and stride 3, or c_loc(x), c_loc(y), c_loc(z) and stride 1
    function riis_mesh_create(n_nodes, x, y, z, stride, mesh) result(status) bind(c, name='riis_mesh_create')
      import :: c_int64_t, c_ptr, riis_status
      implicit none
      integer(c_int64_t), value :: n_nodes
      type(c_ptr), value :: x, y, z
      integer(c_int64_t), value :: stride
      type(c_ptr), intent(inout) :: mesh
      integer(riis_status) :: status
    end function riis_mesh_create

    !>   x, y, z  as in riis_mesh_create
    function riis_mesh_update(mesh, n_nodes, x, y, z, stride) result(status) bind(c, name='riis_mesh_update')
      import :: c_int64_t, c_ptr, riis_status
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: n_nodes
      type(c_ptr), value :: x, y, z
      integer(c_int64_t), value :: stride
      integer(riis_status) :: status
    end function riis_mesh_update

    function riis_mesh_create_copy(nodes, mesh) result(status) bind(c, name='riis_mesh_create_copy')
      import :: c_ptr, riis_points, riis_status
      implicit none
      type(riis_points), intent(in) :: nodes
      type(c_ptr), intent(inout) :: mesh
      integer(riis_status) :: status
    end function riis_mesh_create_copy

    function riis_mesh_update_copy(mesh, nodes) result(status) bind(c, name='riis_mesh_update_copy')
      import :: c_ptr, riis_points, riis_status
      implicit none
      type(c_ptr), value :: mesh
      type(riis_points), intent(in) :: nodes
      integer(riis_status) :: status
    end function riis_mesh_update_copy

    subroutine riis_mesh_destroy(mesh) bind(c, name='riis_mesh_destroy')
      import :: c_ptr
      implicit none
      type(c_ptr), intent(inout) :: mesh
    end subroutine riis_mesh_destroy

    function riis_mesh_prepare(mesh, n_threads) result(status) bind(c, name='riis_mesh_prepare')
      import :: c_int32_t, c_ptr, riis_status
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: n_threads
      integer(riis_status) :: status
    end function riis_mesh_prepare

    !>   struct_size  c_sizeof(grid)
    function riis_grid_init(grid, struct_size) result(status) bind(c, name='riis_grid_init')
      import :: c_int64_t, riis_grid, riis_status
      implicit none
      type(riis_grid), intent(inout) :: grid
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_grid_init

    function riis_mesh_create_grid(grid, mesh) result(status) bind(c, name='riis_mesh_create_grid')
      import :: c_ptr, riis_grid, riis_status
      implicit none
      type(riis_grid), intent(in) :: grid
      type(c_ptr), intent(inout) :: mesh
      integer(riis_status) :: status
    end function riis_mesh_create_grid

    function riis_mesh_update_grid(mesh, grid) result(status) bind(c, name='riis_mesh_update_grid')
      import :: c_ptr, riis_grid, riis_status
      implicit none
      type(c_ptr), value :: mesh
      type(riis_grid), intent(in) :: grid
      integer(riis_status) :: status
    end function riis_mesh_update_grid

    !>   struct_size  c_sizeof(csr)
    function riis_csr_init(csr, struct_size) result(status) bind(c, name='riis_csr_init')
      import :: c_int64_t, riis_csr, riis_status
      implicit none
      type(riis_csr), intent(inout) :: csr
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_csr_init

    !>   csr  its arrays are borrowed until the mesh is destroyed or gets another adjacency; csr itself is not borrowed.
    !!        If left out: the adjacency is removed
    function riis_mesh_set_adjacency(mesh, csr) result(status) bind(c, name='riis_mesh_set_adjacency')
      import :: c_ptr, riis_csr, riis_status
      implicit none
      type(c_ptr), value :: mesh
      type(riis_csr), intent(in), optional :: csr
      integer(riis_status) :: status
    end function riis_mesh_set_adjacency

    ! -----------------------------------------------------------------------------------------------------------------
    ! Adjacency from cells, faces, or a structured grid
    ! -----------------------------------------------------------------------------------------------------------------

    !>   struct_size  c_sizeof(cells)
    function riis_mesh_cells_init(cells, struct_size) result(status) bind(c, name='riis_mesh_cells_init')
      import :: c_int64_t, riis_mesh_cells, riis_status
      implicit none
      type(riis_mesh_cells), intent(inout) :: cells
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_mesh_cells_init

    function riis_adjacency_create_from_cells(cells, adjacency) result(status) &
        bind(c, name='riis_adjacency_create_from_cells')
      import :: c_ptr, riis_mesh_cells, riis_status
      implicit none
      type(riis_mesh_cells), intent(in) :: cells
      type(c_ptr), intent(inout) :: adjacency
      integer(riis_status) :: status
    end function riis_adjacency_create_from_cells

    !>   struct_size  c_sizeof(faces)
    function riis_mesh_faces_init(faces, struct_size) result(status) bind(c, name='riis_mesh_faces_init')
      import :: c_int64_t, riis_mesh_faces, riis_status
      implicit none
      type(riis_mesh_faces), intent(inout) :: faces
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_mesh_faces_init

    function riis_adjacency_create_from_faces(faces, adjacency) result(status) &
        bind(c, name='riis_adjacency_create_from_faces')
      import :: c_ptr, riis_mesh_faces, riis_status
      implicit none
      type(riis_mesh_faces), intent(in) :: faces
      type(c_ptr), intent(inout) :: adjacency
      integer(riis_status) :: status
    end function riis_adjacency_create_from_faces

    function riis_adjacency_create_from_grid(ni, nj, nk, n_threads, adjacency) result(status) &
        bind(c, name='riis_adjacency_create_from_grid')
      import :: c_int32_t, c_int64_t, c_ptr, riis_status
      implicit none
      integer(c_int64_t), value :: ni, nj, nk
      integer(c_int32_t), value :: n_threads
      type(c_ptr), intent(inout) :: adjacency
      integer(riis_status) :: status
    end function riis_adjacency_create_from_grid

    !>   csr          for riis_mesh_set_adjacency; destroy the adjacency after the mesh, not before. Its offsets are
    !!                integer(c_int64_t), (n_rows + 1), from 0; its columns integer(c_int32_t), or (c_int64_t) if
    !!                column_bits is 64, (offsets(n_rows + 1)), from 0
    !!   struct_size  c_sizeof(csr)
    function riis_adjacency_get_csr(adjacency, csr, struct_size) result(status) bind(c, name='riis_adjacency_get_csr')
      import :: c_int64_t, c_ptr, riis_csr, riis_status
      implicit none
      type(c_ptr), value :: adjacency
      type(riis_csr), intent(inout) :: csr
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_adjacency_get_csr

    subroutine riis_adjacency_destroy(adjacency) bind(c, name='riis_adjacency_destroy')
      import :: c_ptr
      implicit none
      type(c_ptr), intent(inout) :: adjacency
    end subroutine riis_adjacency_destroy

    ! -----------------------------------------------------------------------------------------------------------------
    ! Marking
    ! -----------------------------------------------------------------------------------------------------------------

    function riis_marks_create(marks) result(status) bind(c, name='riis_marks_create')
      import :: c_ptr, riis_status
      implicit none
      type(c_ptr), intent(inout) :: marks
      integer(riis_status) :: status
    end function riis_marks_create

    subroutine riis_marks_destroy(marks) bind(c, name='riis_marks_destroy')
      import :: c_ptr
      implicit none
      type(c_ptr), intent(inout) :: marks
    end subroutine riis_marks_destroy

    !>   struct_size  c_sizeof(resistance)
    function riis_resistance_init(resistance, struct_size) result(status) bind(c, name='riis_resistance_init')
      import :: c_int64_t, riis_resistance, riis_status
      implicit none
      type(riis_resistance), intent(inout) :: resistance
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_resistance_init

    !>   struct_size  c_sizeof(options)
    function riis_mark_options_init(options, struct_size) result(status) bind(c, name='riis_mark_options_init')
      import :: c_int64_t, riis_mark_options, riis_status
      implicit none
      type(riis_mark_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_mark_options_init

    !>   options  if left out: all defaults
    function riis_mark_nodes(surface, mesh, options, marks) result(status) bind(c, name='riis_mark_nodes')
      import :: c_ptr, riis_mark_options, riis_status
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), value :: mesh
      type(riis_mark_options), intent(in), optional :: options
      type(c_ptr), value :: marks
      integer(riis_status) :: status
    end function riis_mark_nodes

    !>   struct_size  c_sizeof(list)
    function riis_marks_get_list(marks, which, list, struct_size) result(status) bind(c, name='riis_marks_get_list')
      import :: c_int32_t, c_int64_t, c_ptr, riis_mark_list, riis_status
      implicit none
      type(c_ptr), value :: marks
      integer(c_int32_t), value :: which
      type(riis_mark_list), intent(inout) :: list
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_marks_get_list

    !>   struct_size  c_sizeof(arrays)
    function riis_dense_arrays_init(arrays, struct_size) result(status) bind(c, name='riis_dense_arrays_init')
      import :: c_int64_t, riis_dense_arrays, riis_status
      implicit none
      type(riis_dense_arrays), intent(inout) :: arrays
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_dense_arrays_init

    function riis_marks_get_dense(marks, arrays) result(status) bind(c, name='riis_marks_get_dense')
      import :: c_ptr, riis_dense_arrays, riis_status
      implicit none
      type(c_ptr), value :: marks
      type(riis_dense_arrays), intent(in) :: arrays
      integer(riis_status) :: status
    end function riis_marks_get_dense

    !>   struct_size  c_sizeof(stats)
    function riis_marks_get_stats(marks, stats, struct_size) result(status) bind(c, name='riis_marks_get_stats')
      import :: c_int64_t, c_ptr, riis_mark_stats, riis_status
      implicit none
      type(c_ptr), value :: marks
      type(riis_mark_stats), intent(inout) :: stats
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_marks_get_stats

    ! -----------------------------------------------------------------------------------------------------------------
    ! Resistance
    ! -----------------------------------------------------------------------------------------------------------------

    !>   struct_size  c_sizeof(arrays)
    function riis_resistance_arrays_init(arrays, struct_size) result(status) bind(c, name='riis_resistance_arrays_init')
      import :: c_int64_t, riis_resistance_arrays, riis_status
      implicit none
      type(riis_resistance_arrays), intent(inout) :: arrays
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_resistance_arrays_init

    function riis_marks_add_resistance(marks, resistance, arrays) result(status) &
        bind(c, name='riis_marks_add_resistance')
      import :: c_ptr, riis_resistance, riis_resistance_arrays, riis_status
      implicit none
      type(c_ptr), value :: marks
      type(riis_resistance), intent(in) :: resistance
      type(riis_resistance_arrays), intent(in) :: arrays
      integer(riis_status) :: status
    end function riis_marks_add_resistance

    !>   struct_size  c_sizeof(flow)
    function riis_flow_arrays_init(flow, struct_size) result(status) bind(c, name='riis_flow_arrays_init')
      import :: c_int64_t, riis_flow_arrays, riis_status
      implicit none
      type(riis_flow_arrays), intent(inout) :: flow
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_flow_arrays_init

    !>   struct_size  c_sizeof(reaction)
    function riis_reaction_init(reaction, struct_size) result(status) bind(c, name='riis_reaction_init')
      import :: c_int64_t, riis_reaction, riis_status
      implicit none
      type(riis_reaction), intent(inout) :: reaction
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_reaction_init

    function riis_marks_add_reaction(marks, resistance, flow, reaction) result(status) &
        bind(c, name='riis_marks_add_reaction')
      import :: c_ptr, riis_flow_arrays, riis_reaction, riis_resistance, riis_status
      implicit none
      type(c_ptr), value :: marks
      type(riis_resistance), intent(in) :: resistance
      type(riis_flow_arrays), intent(in) :: flow
      type(riis_reaction), intent(in) :: reaction
      integer(riis_status) :: status
    end function riis_marks_add_reaction

    !>   vertex_force  (3, n_vertices)
    function riis_marks_add_vertex_reaction(marks, surface, resistance, flow, n_vertices, vertex_force) result(status) &
        bind(c, name='riis_marks_add_vertex_reaction')
      import :: c_double, c_int64_t, c_ptr, riis_flow_arrays, riis_resistance, riis_status
      implicit none
      type(c_ptr), value :: marks
      type(c_ptr), value :: surface
      type(riis_resistance), intent(in) :: resistance
      type(riis_flow_arrays), intent(in) :: flow
      integer(c_int64_t), value :: n_vertices
      real(c_double), intent(inout) :: vertex_force(*)
      integer(riis_status) :: status
    end function riis_marks_add_vertex_reaction

    !>   struct_size  c_sizeof(band)
    function riis_band_init(band, struct_size) result(status) bind(c, name='riis_band_init')
      import :: c_int64_t, riis_band, riis_status
      implicit none
      type(riis_band), intent(inout) :: band
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_band_init

    !>   struct_size  c_sizeof(sums)
    function riis_marks_get_band_sums(marks, band, sums, struct_size) result(status) &
        bind(c, name='riis_marks_get_band_sums')
      import :: c_int64_t, c_ptr, riis_band, riis_band_sums, riis_status
      implicit none
      type(c_ptr), value :: marks
      type(riis_band), intent(in) :: band
      type(riis_band_sums), intent(inout) :: sums
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_marks_get_band_sums

    ! -----------------------------------------------------------------------------------------------------------------
    ! Loads
    ! -----------------------------------------------------------------------------------------------------------------

    !>   struct_size  c_sizeof(loads)
    function riis_loads_init(loads, struct_size) result(status) bind(c, name='riis_loads_init')
      import :: c_int64_t, riis_loads, riis_status
      implicit none
      type(riis_loads), intent(inout) :: loads
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_loads_init

    !>   weight  (n_points), if left out: 1 for each node
    !!   sums    (11, n_leaflets)
    function riis_loads_add_sums(loads, nodes, weight, sums) result(status) bind(c, name='riis_loads_add_sums')
      import :: c_double, riis_loads, riis_points, riis_status
      implicit none
      type(riis_loads), intent(in) :: loads
      type(riis_points), intent(in) :: nodes
      real(c_double), intent(in), optional :: weight(*)
      real(c_double), intent(inout) :: sums(*)
      integer(riis_status) :: status
    end function riis_loads_add_sums

    !>   weight      (n_points)
    !!   sums        (11, n_leaflets)
    !!   node_force  (3, n_points)
    function riis_loads_add_forces(loads, nodes, weight, sums, node_force) result(status) &
        bind(c, name='riis_loads_add_forces')
      import :: c_double, riis_loads, riis_points, riis_status
      implicit none
      type(riis_loads), intent(in) :: loads
      type(riis_points), intent(in) :: nodes
      real(c_double), intent(in), optional :: weight(*)
      real(c_double), intent(in) :: sums(*)
      real(c_double), intent(inout) :: node_force(*)
      integer(riis_status) :: status
    end function riis_loads_add_forces

    ! -----------------------------------------------------------------------------------------------------------------
    ! Leaks
    ! -----------------------------------------------------------------------------------------------------------------

    function riis_leaks_create(leaks) result(status) bind(c, name='riis_leaks_create')
      import :: c_ptr, riis_status
      implicit none
      type(c_ptr), intent(inout) :: leaks
      integer(riis_status) :: status
    end function riis_leaks_create

    subroutine riis_leaks_destroy(leaks) bind(c, name='riis_leaks_destroy')
      import :: c_ptr
      implicit none
      type(c_ptr), intent(inout) :: leaks
    end subroutine riis_leaks_destroy

    !>   options  if left out: all defaults
    function riis_find_leaks(surface, mesh, marks, options, leaks) result(status) bind(c, name='riis_find_leaks')
      import :: c_ptr, riis_mark_options, riis_status
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), value :: mesh
      type(c_ptr), value :: marks
      type(riis_mark_options), intent(in), optional :: options
      type(c_ptr), value :: leaks
      integer(riis_status) :: status
    end function riis_find_leaks

    !>   struct_size  c_sizeof(list)
    function riis_leaks_get_list(leaks, list, struct_size) result(status) bind(c, name='riis_leaks_get_list')
      import :: c_int64_t, c_ptr, riis_leak_list, riis_status
      implicit none
      type(c_ptr), value :: leaks
      type(riis_leak_list), intent(inout) :: list
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_leaks_get_list

    ! -----------------------------------------------------------------------------------------------------------------
    ! Open regions and passages
    ! -----------------------------------------------------------------------------------------------------------------

    !>   options  if left out: all defaults
    !!   label    (n_nodes)
    function riis_label_open_regions(mesh, marks, options, n_nodes, label, n_regions) result(status) &
        bind(c, name='riis_label_open_regions')
      import :: c_int64_t, c_ptr, riis_mark_options, riis_status
      implicit none
      type(c_ptr), value :: mesh
      type(c_ptr), value :: marks
      type(riis_mark_options), intent(in), optional :: options
      integer(c_int64_t), value :: n_nodes
      integer(c_int64_t), intent(inout) :: label(*)
      integer(c_int64_t), intent(inout), optional :: n_regions
      integer(riis_status) :: status
    end function riis_label_open_regions

    !>   struct_size  c_sizeof(ends)
    function riis_passage_ends_init(ends, struct_size) result(status) bind(c, name='riis_passage_ends_init')
      import :: c_int64_t, riis_passage_ends, riis_status
      implicit none
      type(riis_passage_ends), intent(inout) :: ends
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_passage_ends_init

    !>   options      if left out: all defaults
    !!   struct_size  c_sizeof(passage)
    function riis_find_passage(surface, mesh, ends, options, passage, struct_size) result(status) &
        bind(c, name='riis_find_passage')
      import :: c_int64_t, c_ptr, riis_mark_options, riis_passage, riis_passage_ends, riis_status
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), value :: mesh
      type(riis_passage_ends), intent(in) :: ends
      type(riis_mark_options), intent(in), optional :: options
      type(riis_passage), intent(inout) :: passage
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_find_passage

    ! -----------------------------------------------------------------------------------------------------------------
    ! Measures
    ! -----------------------------------------------------------------------------------------------------------------

    function riis_surface_get_n_leaflets(surface, n_leaflets) result(status) bind(c, name='riis_surface_get_n_leaflets')
      import :: c_int64_t, c_ptr, riis_status
      implicit none
      type(c_ptr), value :: surface
      integer(c_int64_t), intent(inout) :: n_leaflets
      integer(riis_status) :: status
    end function riis_surface_get_n_leaflets

    !>   struct_size  c_sizeof(sizes)
    function riis_surface_get_leaflet(surface, leaflet, sizes, struct_size) result(status) &
        bind(c, name='riis_surface_get_leaflet')
      import :: c_int64_t, c_ptr, riis_leaflet, riis_status
      implicit none
      type(c_ptr), value :: surface
      integer(c_int64_t), value :: leaflet
      type(riis_leaflet), intent(inout) :: sizes
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_get_leaflet

    !>   resistance   if left out: the defaults
    !!   struct_size  c_sizeof(orifice)
    function riis_surface_get_orifice(surface, resistance, orifice, struct_size) result(status) &
        bind(c, name='riis_surface_get_orifice')
      import :: c_int64_t, c_ptr, riis_orifice, riis_resistance, riis_status
      implicit none
      type(c_ptr), value :: surface
      type(riis_resistance), intent(in), optional :: resistance
      type(riis_orifice), intent(inout) :: orifice
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_get_orifice

    !>   resistance   if left out: all defaults
    !!   struct_size  c_sizeof(orifice)
    function riis_surface_get_orifice_in_wall(surface, wall, resistance, orifice, struct_size) result(status) &
        bind(c, name='riis_surface_get_orifice_in_wall')
      import :: c_int64_t, c_ptr, riis_orifice, riis_resistance, riis_status
      implicit none
      type(c_ptr), value :: surface, wall
      type(riis_resistance), intent(in), optional :: resistance
      type(riis_orifice), intent(inout) :: orifice
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_get_orifice_in_wall

    !>   struct_size  c_sizeof(search)
    function riis_area_search_init(search, struct_size) result(status) bind(c, name='riis_area_search_init')
      import :: c_int64_t, riis_area_search, riis_status
      implicit none
      type(riis_area_search), intent(inout) :: search
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_area_search_init

    !>   areas        (n_areas)
    !!   search       if left out: the defaults
    !!   values       (n_areas), if left out: not wanted
    !!   reached      (n_areas), if left out: not wanted
    !!   range        if left out: not wanted
    !!   struct_size  c_sizeof(range)
    function riis_find_by_area(valve, name, n_areas, areas, search, values, reached, range, struct_size) &
        result(status) bind(c, name='riis_find_by_area')
      import :: c_char, c_double, c_int64_t, c_ptr, riis_area_range, riis_area_search, riis_status
      implicit none
      type(c_ptr), value :: valve
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: n_areas
      real(c_double), intent(in) :: areas(*)
      type(riis_area_search), intent(in), optional :: search
      real(c_double), intent(inout), optional :: values(*), reached(*)
      type(riis_area_range), intent(inout), optional :: range
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_find_by_area

    !>   struct_size  c_sizeof(coaptation)
    function riis_surface_get_coaptation(surface, reach, leaflet_id, coaptation, struct_size) result(status) &
        bind(c, name='riis_surface_get_coaptation')
      import :: c_double, c_int32_t, c_int64_t, c_ptr, riis_coaptation, riis_status
      implicit none
      type(c_ptr), value :: surface
      real(c_double), value :: reach
      integer(c_int32_t), value :: leaflet_id
      type(riis_coaptation), intent(inout) :: coaptation
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_get_coaptation

    function riis_surface_get_leak(surface, resistance, drop, flow) result(status) bind(c, name='riis_surface_get_leak')
      import :: c_double, c_ptr, riis_resistance, riis_status
      implicit none
      type(c_ptr), value :: surface
      type(riis_resistance), intent(in) :: resistance
      real(c_double), value :: drop
      real(c_double), intent(inout) :: flow
      integer(riis_status) :: status
    end function riis_surface_get_leak

    !>   struct_size  c_sizeof(options)
    function riis_first_passage_options_init(options, struct_size) result(status) &
        bind(c, name='riis_first_passage_options_init')
      import :: c_int64_t, riis_first_passage_options, riis_status
      implicit none
      type(riis_first_passage_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_first_passage_options_init

    !>   options      if left out: all defaults
    !!   struct_size  c_sizeof(first)
    function riis_find_first_passage(valve, mesh, ends, options, first, struct_size) result(status) &
        bind(c, name='riis_find_first_passage')
      import :: c_int64_t, c_ptr, riis_first_passage, riis_first_passage_options, riis_passage_ends, riis_status
      implicit none
      type(c_ptr), value :: valve
      type(c_ptr), value :: mesh
      type(riis_passage_ends), intent(in) :: ends
      type(riis_first_passage_options), intent(in), optional :: options
      type(riis_first_passage), intent(inout) :: first
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_find_first_passage

    !>   struct_size  c_sizeof(cells)
    function riis_marks_get_cells_across(marks, mesh, cells, struct_size) result(status) &
        bind(c, name='riis_marks_get_cells_across')
      import :: c_int64_t, c_ptr, riis_cells_across, riis_status
      implicit none
      type(c_ptr), value :: marks
      type(c_ptr), value :: mesh
      type(riis_cells_across), intent(inout) :: cells
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_marks_get_cells_across

    !>   options  if left out: the defaults
    function riis_valve_get_swept_volume(valve, opening_from, opening_to, options, leaflet_id, volume) result(status) &
        bind(c, name='riis_valve_get_swept_volume')
      import :: c_double, c_int32_t, c_ptr, riis_status, riis_surface_options
      implicit none
      type(c_ptr), value :: valve
      real(c_double), value :: opening_from, opening_to
      type(riis_surface_options), intent(in), optional :: options
      integer(c_int32_t), value :: leaflet_id
      real(c_double), intent(inout) :: volume
      integer(riis_status) :: status
    end function riis_valve_get_swept_volume

    ! -----------------------------------------------------------------------------------------------------------------
    ! Landmarks
    ! -----------------------------------------------------------------------------------------------------------------

    !>   struct_size  c_sizeof(landmarks)
    function riis_landmarks_init(landmarks, struct_size) result(status) bind(c, name='riis_landmarks_init')
      import :: c_int64_t, riis_landmarks, riis_status
      implicit none
      type(riis_landmarks), intent(inout) :: landmarks
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_landmarks_init

    !>   struct_size  c_sizeof(arrays)
    function riis_placement_arrays_init(arrays, struct_size) result(status) bind(c, name='riis_placement_arrays_init')
      import :: c_int64_t, riis_placement_arrays, riis_status
      implicit none
      type(riis_placement_arrays), intent(inout) :: arrays
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_placement_arrays_init

    !>   held         riis_c_string('') for none
    !!   arrays       if left out: not wanted
    !!   struct_size  c_sizeof(placement)
    function riis_place(valve, landmarks, held, arrays, placement, struct_size) result(status) &
        bind(c, name='riis_place')
      import :: c_char, c_int64_t, c_ptr, riis_landmarks, riis_placement, riis_placement_arrays, riis_status
      implicit none
      type(c_ptr), value :: valve
      type(riis_landmarks), intent(in) :: landmarks
      character(kind=c_char), intent(in) :: held(*)
      type(riis_placement_arrays), intent(in), optional :: arrays
      type(riis_placement), intent(inout) :: placement
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_place

    ! -----------------------------------------------------------------------------------------------------------------
    ! Warp
    ! -----------------------------------------------------------------------------------------------------------------

    !>   struct_size  c_sizeof(options)
    function riis_warp_options_init(options, struct_size) result(status) bind(c, name='riis_warp_options_init')
      import :: c_int64_t, riis_status, riis_warp_options
      implicit none
      type(riis_warp_options), intent(inout) :: options
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_warp_options_init

    !>   options  if left out: all defaults
    function riis_warp_create(sources, options, warp) result(status) bind(c, name='riis_warp_create')
      import :: c_ptr, riis_points, riis_status, riis_warp_options
      implicit none
      type(riis_points), intent(in) :: sources
      type(riis_warp_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: warp
      integer(riis_status) :: status
    end function riis_warp_create

    subroutine riis_warp_destroy(warp) bind(c, name='riis_warp_destroy')
      import :: c_ptr
      implicit none
      type(c_ptr), intent(inout) :: warp
    end subroutine riis_warp_destroy

    function riis_warp_set_targets(warp, targets) result(status) bind(c, name='riis_warp_set_targets')
      import :: c_ptr, riis_points, riis_status
      implicit none
      type(c_ptr), value :: warp
      type(riis_points), intent(in) :: targets
      integer(riis_status) :: status
    end function riis_warp_set_targets

    function riis_warp_set_targets_at(warp, frames, time) result(status) bind(c, name='riis_warp_set_targets_at')
      import :: c_double, c_ptr, riis_keyframe_arrays, riis_status
      implicit none
      type(c_ptr), value :: warp
      type(riis_keyframe_arrays), intent(in) :: frames
      real(c_double), value :: time
      integer(riis_status) :: status
    end function riis_warp_set_targets_at

    !>   struct_size  c_sizeof(info)
    function riis_warp_get_info(warp, info, struct_size) result(status) bind(c, name='riis_warp_get_info')
      import :: c_int64_t, c_ptr, riis_status, riis_warp_info
      implicit none
      type(c_ptr), value :: warp
      type(riis_warp_info), intent(inout) :: info
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_warp_get_info

    !>   mapped  (3, n_points)
    function riis_warp_map(warp, points, mapped) result(status) bind(c, name='riis_warp_map')
      import :: c_double, c_ptr, riis_points, riis_status
      implicit none
      type(c_ptr), value :: warp
      type(riis_points), intent(in) :: points
      real(c_double), intent(inout) :: mapped(*)
      integer(riis_status) :: status
    end function riis_warp_map

    function riis_valve_set_warp(valve, closed, open) result(status) bind(c, name='riis_valve_set_warp')
      import :: c_ptr, riis_status
      implicit none
      type(c_ptr), value :: valve
      type(c_ptr), value :: closed, open
      integer(riis_status) :: status
    end function riis_valve_set_warp

    ! -----------------------------------------------------------------------------------------------------------------
    ! Skirt
    ! -----------------------------------------------------------------------------------------------------------------

    !>   distance     (2, n_edges), if left out: not wanted
    !!   struct_size  c_sizeof(gap)
    function riis_surface_get_gap(surface, wall, distance, gap, struct_size) result(status) &
        bind(c, name='riis_surface_get_gap')
      import :: c_double, c_int64_t, c_ptr, riis_gap, riis_status
      implicit none
      type(c_ptr), value :: surface, wall
      real(c_double), intent(inout), optional :: distance(*)
      type(riis_gap), intent(inout) :: gap
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_get_gap

    !>   options  if left out: the defaults
    function riis_valve_set_skirt_to_wall(valve, wall, longest, options) result(status) &
        bind(c, name='riis_valve_set_skirt_to_wall')
      import :: c_double, c_ptr, riis_status, riis_surface_options
      implicit none
      type(c_ptr), value :: valve
      type(c_ptr), value :: wall
      real(c_double), value :: longest
      type(riis_surface_options), intent(in), optional :: options
      integer(riis_status) :: status
    end function riis_valve_set_skirt_to_wall

    ! -----------------------------------------------------------------------------------------------------------------
    ! Gradients
    ! -----------------------------------------------------------------------------------------------------------------

    !>   options_after   if left out: the surface's options
    !!   options_before  if left out: the surface's options
    function riis_surface_add_direction(surface, valve_after, valve_before, dp, options_after, options_before) &
        result(status) bind(c, name='riis_surface_add_direction')
      import :: c_double, c_ptr, riis_status, riis_surface_options
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), value :: valve_after, valve_before
      real(c_double), value :: dp
      type(riis_surface_options), intent(in), optional :: options_after, options_before
      integer(riis_status) :: status
    end function riis_surface_add_direction

    !>   direction_id  from 0
    !!   struct_size   c_sizeof(direction)
    function riis_surface_get_direction(surface, direction_id, direction, struct_size) result(status) &
        bind(c, name='riis_surface_get_direction')
      import :: c_int64_t, c_ptr, riis_direction, riis_status
      implicit none
      type(c_ptr), value :: surface
      integer(c_int64_t), value :: direction_id
      type(riis_direction), intent(inout) :: direction
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_surface_get_direction

    ! -----------------------------------------------------------------------------------------------------------------
    ! Laws of opening
    ! -----------------------------------------------------------------------------------------------------------------

    !>   struct_size  c_sizeof(table)
    function riis_opening_table_init(table, struct_size) result(status) bind(c, name='riis_opening_table_init')
      import :: c_int64_t, riis_opening_table, riis_status
      implicit none
      type(riis_opening_table), intent(inout) :: table
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_opening_table_init

    function riis_opening_from_table(table, time, opening, rate) result(status) bind(c, name='riis_opening_from_table')
      import :: c_double, riis_opening_table, riis_status
      implicit none
      type(riis_opening_table), intent(in) :: table
      real(c_double), value :: time
      real(c_double), intent(inout), optional :: opening, rate
      integer(riis_status) :: status
    end function riis_opening_from_table

    !>   struct_size  c_sizeof(times)
    function riis_opening_times_init(times, struct_size) result(status) bind(c, name='riis_opening_times_init')
      import :: c_int64_t, riis_opening_times, riis_status
      implicit none
      type(riis_opening_times), intent(inout) :: times
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_opening_times_init

    function riis_opening_from_times(times, time, opening, rate) result(status) bind(c, name='riis_opening_from_times')
      import :: c_double, riis_opening_times, riis_status
      implicit none
      type(riis_opening_times), intent(in) :: times
      real(c_double), value :: time
      real(c_double), intent(inout), optional :: opening, rate
      integer(riis_status) :: status
    end function riis_opening_from_times

    !>   struct_size  c_sizeof(law)
    function riis_opening_switch_init(law, struct_size) result(status) bind(c, name='riis_opening_switch_init')
      import :: c_int64_t, riis_opening_switch, riis_status
      implicit none
      type(riis_opening_switch), intent(inout) :: law
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_opening_switch_init

    !>   struct_size  c_sizeof(state)
    function riis_opening_switch_state_init(state, struct_size) result(status) &
        bind(c, name='riis_opening_switch_state_init')
      import :: c_int64_t, riis_opening_switch_state, riis_status
      implicit none
      type(riis_opening_switch_state), intent(inout) :: state
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_opening_switch_state_init

    !>   now  not the same variable as before
    function riis_opening_switch_advance(law, before, time, pressure_difference, flow, now) result(status) &
        bind(c, name='riis_opening_switch_advance')
      import :: c_double, riis_opening_switch, riis_opening_switch_state, riis_status
      implicit none
      type(riis_opening_switch), intent(in) :: law
      type(riis_opening_switch_state), intent(in) :: before
      real(c_double), value :: time, pressure_difference, flow
      type(riis_opening_switch_state), intent(inout) :: now
      integer(riis_status) :: status
    end function riis_opening_switch_advance

    !>   struct_size  c_sizeof(law)
    function riis_opening_angle_init(law, struct_size) result(status) bind(c, name='riis_opening_angle_init')
      import :: c_int64_t, riis_opening_angle, riis_status
      implicit none
      type(riis_opening_angle), intent(inout) :: law
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_opening_angle_init

    !>   struct_size  c_sizeof(state)
    function riis_opening_angle_state_init(state, struct_size) result(status) &
        bind(c, name='riis_opening_angle_state_init')
      import :: c_int64_t, riis_opening_angle_state, riis_status
      implicit none
      type(riis_opening_angle_state), intent(inout) :: state
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
    end function riis_opening_angle_state_init

    !>   now  not the same variable as before
    function riis_opening_angle_advance(law, before, time, pressure_difference, flow, now) result(status) &
        bind(c, name='riis_opening_angle_advance')
      import :: c_double, riis_opening_angle, riis_opening_angle_state, riis_status
      implicit none
      type(riis_opening_angle), intent(in) :: law
      type(riis_opening_angle_state), intent(in) :: before
      real(c_double), value :: time, pressure_difference, flow
      type(riis_opening_angle_state), intent(inout) :: now
      integer(riis_status) :: status
    end function riis_opening_angle_advance
  end interface

  ! The C library's strlen, for riis_c_text.
  interface
    pure function c_strlen(text) result(length) bind(c, name='strlen')
      import :: c_ptr, c_size_t
      implicit none
      type(c_ptr), value, intent(in) :: text
      integer(c_size_t) :: length
    end function c_strlen
  end interface

contains

  !> Returns the text without its trailing blanks, ended by a null character for C.
  pure function riis_c_string(text) result(c_text)
    character(len=*), intent(in) :: text
    character(len=len_trim(text) + 1, kind=c_char) :: c_text
    c_text = trim(text) // c_null_char
  end function riis_c_string

  !> Returns the length of a text of the library, or 0 for c_null_ptr. Functions that return texts declare their length with this
  !! function. They have no deferred length, because gfortran keeps a deferred length in memory that all threads share.
  pure function riis_c_text_length(c_text) result(length)
    type(c_ptr), intent(in) :: c_text
    integer :: length
    length = 0
    if (c_associated(c_text)) length = int(c_strlen(c_text))
  end function riis_c_text_length

  !> Returns a copy of a text of the library; '' for c_null_ptr.
  function riis_c_text(c_text) result(text)
    type(c_ptr), intent(in) :: c_text
    character(len=riis_c_text_length(c_text)) :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: i
    if (len(text) == 0) return
    call c_f_pointer(c_text, letters, [len(text)])
    do i = 1, len(text)
      text(i:i) = letters(i)
    end do
  end function riis_c_text

end module riis_c
