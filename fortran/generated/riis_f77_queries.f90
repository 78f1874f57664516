! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77_queries.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The external subroutines for a surface's vertices and their velocities, and for closest points. The conventions are those of
!! riis_f77.f90.

!> Copies the surface's vertices, after placement, into the caller's array. Errors: RIIS_INVALID_ARGUMENT if the array is too
!! short; only n is then written.
subroutine riisf_surface_vertices(surface, length, n, xyz, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_surface_get_triangles, riis_triangles
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int32), intent(in) :: length                    !< The number of vertices for which the array has room.
  integer(int32), intent(inout) :: n                      !< The number of vertices, even if the array is too short.
  real(c_double), intent(inout) :: xyz(*)                 !< (3, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_triangles) :: triangles
  real(c_double), pointer :: own(:)
  status = riis_surface_get_triangles(c_handle_of(surface), triangles, c_sizeof(triangles))
  if (status /= RIIS_OK) return
  n = int(min(triangles%n_vertices, int(huge(n), int64)), int32)
  if (triangles%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // &
      text_of(triangles%n_vertices))
  else if (c_associated(triangles%xyz)) then
    call c_f_pointer(triangles%xyz, own, [3 * triangles%n_vertices])
    xyz(:3 * triangles%n_vertices) = own
  end if
end subroutine riisf_surface_vertices

!> Does the same.
subroutine riisf_surface_vertices_64(surface, length, n, xyz, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_surface_get_triangles, riis_triangles
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: length                    !< The number of vertices for which the array has room.
  integer(int64), intent(inout) :: n                      !< The number of vertices, even if the array is too short.
  real(c_double), intent(inout) :: xyz(*)                 !< (3, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_triangles) :: triangles
  real(c_double), pointer :: own(:)
  status = riis_surface_get_triangles(c_handle_of(surface), triangles, c_sizeof(triangles))
  if (status /= RIIS_OK) return
  n = int(min(triangles%n_vertices, int(huge(n), int64)), int64)
  if (triangles%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // &
      text_of(triangles%n_vertices))
  else if (c_associated(triangles%xyz)) then
    call c_f_pointer(triangles%xyz, own, [3 * triangles%n_vertices])
    xyz(:3 * triangles%n_vertices) = own
  end if
end subroutine riisf_surface_vertices_64

!> Copies the velocities of the surface's vertices, after placement, into the caller's array. Errors: RIIS_INVALID_ARGUMENT if the
!! last update gave none, or if the array is too short; only n is then written.
subroutine riisf_surface_vertex_velocities(surface, length, n, velocity, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_surface_get_triangles, riis_triangles
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int32), intent(in) :: length                    !< The number of vertices for which the array has room.
  integer(int32), intent(inout) :: n                      !< The number of vertices, even if the array is too short.
  real(c_double), intent(inout) :: velocity(*)            !< (3, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_triangles) :: triangles
  real(c_double), pointer :: own(:)
  status = riis_surface_get_triangles(c_handle_of(surface), triangles, c_sizeof(triangles))
  if (status /= RIIS_OK) return
  n = int(min(triangles%n_vertices, int(huge(n), int64)), int32)
  if (triangles%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // &
      text_of(triangles%n_vertices))
  else if (c_associated(triangles%velocity)) then
    call c_f_pointer(triangles%velocity, own, [3 * triangles%n_vertices])
    velocity(:3 * triangles%n_vertices) = own
  else
    status = fail(RIIS_INVALID_ARGUMENT, 'surface has no velocities: its last update gave none')
  end if
end subroutine riisf_surface_vertex_velocities

!> Does the same.
subroutine riisf_surface_vertex_velocities_64(surface, length, n, velocity, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_surface_get_triangles, riis_triangles
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: length                    !< The number of vertices for which the array has room.
  integer(int64), intent(inout) :: n                      !< The number of vertices, even if the array is too short.
  real(c_double), intent(inout) :: velocity(*)            !< (3, length); written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_triangles) :: triangles
  real(c_double), pointer :: own(:)
  status = riis_surface_get_triangles(c_handle_of(surface), triangles, c_sizeof(triangles))
  if (status /= RIIS_OK) return
  n = int(min(triangles%n_vertices, int(huge(n), int64)), int64)
  if (triangles%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // &
      text_of(triangles%n_vertices))
  else if (c_associated(triangles%velocity)) then
    call c_f_pointer(triangles%velocity, own, [3 * triangles%n_vertices])
    velocity(:3 * triangles%n_vertices) = own
  else
    status = fail(RIIS_INVALID_ARGUMENT, 'surface has no velocities: its last update gave none')
  end if
end subroutine riisf_surface_vertex_velocities_64

!> Copies the edges at which tissue or a stent holds the leaflets of a valve (riis_surface_get_attachment in riis.h) into the
!! caller's arrays. Errors: RIIS_INVALID_ARGUMENT for a surface from arrays, or if the arrays are too short; only n is then
!! written.
subroutine riisf_surface_attachment(surface, length, n, edges, leaflet_id, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_attachment, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_surface_get_attachment
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int32), intent(in) :: length                    !< The number of edges for which the arrays have room.
  integer(int32), intent(inout) :: n                      !< The number of edges, even if the arrays are too short.
  real(c_double), intent(inout) :: edges(3, 2, *)         !< (3, 2, length): both ends of each edge; written up to n.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (length): the leaflet that is attached there; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_attachment) :: made
  real(c_double), pointer :: own(:, :, :)
  integer(int32), pointer :: own_id(:)
  status = riis_surface_get_attachment(c_handle_of(surface), made, c_sizeof(made))
  if (status /= RIIS_OK) return
  n = int(min(made%n_edges, int(huge(n), int64)), int32)
  if (made%n_edges > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; edges: ' // text_of(made%n_edges))
  else if (c_associated(made%edges)) then
    call c_f_pointer(made%edges, own, [3_int64, 2_int64, made%n_edges])
    call c_f_pointer(made%leaflet_id, own_id, [made%n_edges])
    edges(:, :, :made%n_edges) = own
    leaflet_id(:made%n_edges) = own_id
  end if
end subroutine riisf_surface_attachment

!> Does the same.
subroutine riisf_surface_attachment_64(surface, length, n, edges, leaflet_id, status)
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_attachment, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_surface_get_attachment
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: length                    !< The number of edges for which the arrays have room.
  integer(int64), intent(inout) :: n                      !< The number of edges, even if the arrays are too short.
  real(c_double), intent(inout) :: edges(3, 2, *)         !< (3, 2, length): both ends of each edge; written up to n.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (length): the leaflet that is attached there; written up to n.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_attachment) :: made
  real(c_double), pointer :: own(:, :, :)
  integer(int32), pointer :: own_id(:)
  status = riis_surface_get_attachment(c_handle_of(surface), made, c_sizeof(made))
  if (status /= RIIS_OK) return
  n = int(min(made%n_edges, int(huge(n), int64)), int64)
  if (made%n_edges > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; edges: ' // text_of(made%n_edges))
  else if (c_associated(made%edges)) then
    call c_f_pointer(made%edges, own, [3_int64, 2_int64, made%n_edges])
    call c_f_pointer(made%leaflet_id, own_id, [made%n_edges])
    edges(:, :, :made%n_edges) = own
    leaflet_id(:made%n_edges) = own_id
  end if
end subroutine riisf_surface_attachment_64

!> Copies the rates of the surface's vertices in a direction (riis_surface_get_direction in riis.h) into the caller's array.
!! Errors: RIIS_INVALID_ARGUMENT for a direction that the surface lacks, or if the array is too short; only n is then written.
subroutine riisf_surface_direction(surface, direction_num, length, n, rate, area_rate, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_direction, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_surface_get_direction
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int32), intent(in) :: direction_num             !< The direction, from 1. A message counts from 0.
  integer(int32), intent(in) :: length                    !< The number of vertices for which the array has room.
  integer(int32), intent(inout) :: n                      !< The number of vertices, even if the array is too short.
  real(c_double), intent(inout) :: rate(*)                !< (3, length): the derivative of each vertex; written up to n.
  real(c_double), intent(inout) :: area_rate              !< The derivative of the surface's area.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_direction) :: made
  real(c_double), pointer :: own(:)
  status = riis_surface_get_direction(c_handle_of(surface), int(direction_num, int64) - 1, made, c_sizeof(made))
  if (status /= RIIS_OK) return
  n = int(min(made%n_vertices, int(huge(n), int64)), int32)
  if (made%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // text_of(made%n_vertices))
  else
    call c_f_pointer(made%rate, own, [3 * made%n_vertices])
    rate(:3 * made%n_vertices) = own
    area_rate = made%area_rate
  end if
end subroutine riisf_surface_direction

!> Does the same.
subroutine riisf_surface_direction_64(surface, direction_num, length, n, rate, area_rate, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_direction, riis_status, RIIS_INVALID_ARGUMENT, RIIS_OK, riis_surface_get_direction
  use riis_support, only: c_handle_of, fail, text_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: direction_num             !< The direction, from 1. A message counts from 0.
  integer(int64), intent(in) :: length                    !< The number of vertices for which the array has room.
  integer(int64), intent(inout) :: n                      !< The number of vertices, even if the array is too short.
  real(c_double), intent(inout) :: rate(*)                !< (3, length): the derivative of each vertex; written up to n.
  real(c_double), intent(inout) :: area_rate              !< The derivative of the surface's area.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_direction) :: made
  real(c_double), pointer :: own(:)
  status = riis_surface_get_direction(c_handle_of(surface), int(direction_num, int64) - 1, made, c_sizeof(made))
  if (status /= RIIS_OK) return
  n = int(min(made%n_vertices, int(huge(n), int64)), int64)
  if (made%n_vertices > length) then
    status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // '; vertices: ' // text_of(made%n_vertices))
  else
    call c_f_pointer(made%rate, own, [3 * made%n_vertices])
    rate(:3 * made%n_vertices) = own
    area_rate = made%area_rate
  end if
end subroutine riisf_surface_direction_64

!> Finds the closest points of the surface to many points, in parallel. No array may overlap another. Errors:
!! RIIS_INVALID_ARGUMENT naming the first bad point, counted from 0, or for a surface that measures distances by sampling or
!! minimisation, because it has no sides. Nothing is then written.
subroutine riisf_closest_points(surface, n_points, x, y, z, stride, &
    distance_limit, n_threads, distance, point, normal, triangle_id, leaflet_id, &
    side, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_closest_arrays, riis_closest_options, riis_status, RIIS_OK, riis_closest_arrays_init, &
    riis_closest_options_init, riis_closest_points, riis_points, riis_points_init
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int32), intent(in) :: n_points                  !< >= 0.
  real(c_double), intent(in) :: x(*)                      !< Point i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Point i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Point i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  real(c_double), intent(in) :: distance_limit            !< >= 0. Farther points get RIIS_FAR_DISTANCE, ids -1, side 0 and zeros.
                                                          !! HUGE(1D0): no limit.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  real(c_double), intent(inout) :: distance(*)            !< (n_points), >= 0.
  real(c_double), intent(inout) :: point(*)               !< (3, n_points): the closest points.
  real(c_double), intent(inout) :: normal(*)              !< (3, n_points): the triangle's unit normal.
  integer(int64), intent(inout) :: triangle_id(*)         !< (n_points), from 0. INTEGER*8.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (n_points): RIIS_LEAFLET_*, or the caller's.
  integer(int32), intent(inout) :: side(*)                !< (n_points): 1 downstream, -1 upstream, 0 on the surface or level
                                                          !! with its rim.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_closest_options) :: options
  type(riis_closest_arrays) :: arrays
  type(riis_points) :: points
  status = riis_closest_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_closest_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  if (distance_limit < huge(distance_limit)) options%distance_limit = distance_limit
  options%n_threads = n_threads
  arrays%distance = location_of(distance)
  arrays%point = location_of(point)
  arrays%normal = location_of(normal)
  arrays%triangle_id = location_of(triangle_id)
  arrays%leaflet_id = location_of(leaflet_id)
  arrays%side = location_of(side)
  status = riis_points_init(points, c_sizeof(points))
  if (status /= RIIS_OK) return
  points%n_points = n_points
  points%x = location_of(x)
  points%y = location_of(y)
  points%z = location_of(z)
  points%stride = stride
  status = riis_closest_points(c_handle_of(surface), points, options, arrays)
end subroutine riisf_closest_points

!> Does the same.
subroutine riisf_closest_points_64(surface, n_points, x, y, z, stride, &
    distance_limit, n_threads, distance, point, normal, triangle_id, leaflet_id, &
    side, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_closest_arrays, riis_closest_options, riis_status, RIIS_OK, riis_closest_arrays_init, &
    riis_closest_options_init, riis_closest_points, riis_points, riis_points_init
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: n_points                  !< >= 0.
  real(c_double), intent(in) :: x(*)                      !< Point i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Point i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Point i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  real(c_double), intent(in) :: distance_limit            !< >= 0. Farther points get RIIS_FAR_DISTANCE, ids -1, side 0 and zeros.
                                                          !! HUGE(1D0): no limit.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  real(c_double), intent(inout) :: distance(*)            !< (n_points), >= 0.
  real(c_double), intent(inout) :: point(*)               !< (3, n_points): the closest points.
  real(c_double), intent(inout) :: normal(*)              !< (3, n_points): the triangle's unit normal.
  integer(int64), intent(inout) :: triangle_id(*)         !< (n_points), from 0. INTEGER*8.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (n_points): RIIS_LEAFLET_*, or the caller's.
  integer(int32), intent(inout) :: side(*)                !< (n_points): 1 downstream, -1 upstream, 0 on the surface or level
                                                          !! with its rim.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_closest_options) :: options
  type(riis_closest_arrays) :: arrays
  type(riis_points) :: points
  status = riis_closest_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_closest_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  if (distance_limit < huge(distance_limit)) options%distance_limit = distance_limit
  options%n_threads = n_threads
  arrays%distance = location_of(distance)
  arrays%point = location_of(point)
  arrays%normal = location_of(normal)
  arrays%triangle_id = location_of(triangle_id)
  arrays%leaflet_id = location_of(leaflet_id)
  arrays%side = location_of(side)
  status = riis_points_init(points, c_sizeof(points))
  if (status /= RIIS_OK) return
  points%n_points = n_points
  points%x = location_of(x)
  points%y = location_of(y)
  points%z = location_of(z)
  points%stride = stride
  status = riis_closest_points(c_handle_of(surface), points, options, arrays)
end subroutine riisf_closest_points_64

!> Works like riisf_closest_points, but for a list of points. Only these points are read, and only their entries are written.
subroutine riisf_closest_points_listed(surface, n_points, x, y, z, stride, &
    n_listed, point_num, distance_limit, n_threads, distance, point, normal, triangle_id, leaflet_id, &
    side, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_closest_arrays, riis_closest_options, riis_status, RIIS_OK, riis_closest_arrays_init, &
    riis_closest_options_init, riis_closest_points, riis_points, riis_points_init
  use riis_support, only: c_handle_of, location_of, out_of_memory
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int32), intent(in) :: n_points                  !< >= 0.
  real(c_double), intent(in) :: x(*)                      !< Point i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Point i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Point i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int32), intent(in) :: n_listed                  !< 0 to n_points.
  integer(int32), intent(in) :: point_num(*)              !< (n_listed), strictly ascending, from 1, like the nodes of
                                                          !! riisf_marked; copied.
  real(c_double), intent(in) :: distance_limit            !< >= 0. Farther points get RIIS_FAR_DISTANCE, ids -1, side 0 and zeros.
                                                          !! HUGE(1D0): no limit.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  real(c_double), intent(inout) :: distance(*)            !< (n_points), >= 0.
  real(c_double), intent(inout) :: point(*)               !< (3, n_points): the closest points.
  real(c_double), intent(inout) :: normal(*)              !< (3, n_points): the triangle's unit normal.
  integer(int64), intent(inout) :: triangle_id(*)         !< (n_points), from 0. INTEGER*8.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (n_points): RIIS_LEAFLET_*, or the caller's.
  integer(int32), intent(inout) :: side(*)                !< (n_points): 1 downstream, -1 upstream, 0 on the surface or level
                                                          !! with its rim.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_closest_options) :: options
  type(riis_closest_arrays) :: arrays
  type(riis_points) :: points
  integer(int64), allocatable, target :: ids(:)
  integer :: stat
  status = riis_closest_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_closest_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  allocate (ids(max(n_listed, 1_int32)), stat=stat) ! an empty list still needs an address
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  ids(:n_listed) = int(point_num(:n_listed), int64) - 1
  options%n_point_ids = n_listed
  options%point_ids = c_loc(ids)
  if (distance_limit < huge(distance_limit)) options%distance_limit = distance_limit
  options%n_threads = n_threads
  arrays%distance = location_of(distance)
  arrays%point = location_of(point)
  arrays%normal = location_of(normal)
  arrays%triangle_id = location_of(triangle_id)
  arrays%leaflet_id = location_of(leaflet_id)
  arrays%side = location_of(side)
  status = riis_points_init(points, c_sizeof(points))
  if (status /= RIIS_OK) return
  points%n_points = n_points
  points%x = location_of(x)
  points%y = location_of(y)
  points%z = location_of(z)
  points%stride = stride
  status = riis_closest_points(c_handle_of(surface), points, options, arrays)
end subroutine riisf_closest_points_listed

!> Does the same.
subroutine riisf_closest_points_listed_64(surface, n_points, x, y, z, stride, &
    n_listed, point_num, distance_limit, n_threads, distance, point, normal, triangle_id, leaflet_id, &
    side, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_loc, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_closest_arrays, riis_closest_options, riis_status, RIIS_OK, riis_closest_arrays_init, &
    riis_closest_options_init, riis_closest_points, riis_points, riis_points_init
  use riis_support, only: c_handle_of, location_of, out_of_memory
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: n_points                  !< >= 0.
  real(c_double), intent(in) :: x(*)                      !< Point i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Point i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Point i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  integer(int64), intent(in) :: n_listed                  !< 0 to n_points.
  integer(int64), intent(in) :: point_num(*)              !< (n_listed), strictly ascending, from 1, like the nodes of
                                                          !! riisf_marked; copied.
  real(c_double), intent(in) :: distance_limit            !< >= 0. Farther points get RIIS_FAR_DISTANCE, ids -1, side 0 and zeros.
                                                          !! HUGE(1D0): no limit.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  real(c_double), intent(inout) :: distance(*)            !< (n_points), >= 0.
  real(c_double), intent(inout) :: point(*)               !< (3, n_points): the closest points.
  real(c_double), intent(inout) :: normal(*)              !< (3, n_points): the triangle's unit normal.
  integer(int64), intent(inout) :: triangle_id(*)         !< (n_points), from 0. INTEGER*8.
  integer(int32), intent(inout) :: leaflet_id(*)          !< (n_points): RIIS_LEAFLET_*, or the caller's.
  integer(int32), intent(inout) :: side(*)                !< (n_points): 1 downstream, -1 upstream, 0 on the surface or level
                                                          !! with its rim.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_closest_options) :: options
  type(riis_closest_arrays) :: arrays
  type(riis_points) :: points
  integer(int64), allocatable, target :: ids(:)
  integer :: stat
  status = riis_closest_options_init(options, c_sizeof(options))
  if (status == RIIS_OK) status = riis_closest_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  allocate (ids(max(n_listed, 1_int64)), stat=stat) ! an empty list still needs an address
  status = out_of_memory(stat)
  if (status /= RIIS_OK) return
  ids(:n_listed) = int(point_num(:n_listed), int64) - 1
  options%n_point_ids = n_listed
  options%point_ids = c_loc(ids)
  if (distance_limit < huge(distance_limit)) options%distance_limit = distance_limit
  options%n_threads = n_threads
  arrays%distance = location_of(distance)
  arrays%point = location_of(point)
  arrays%normal = location_of(normal)
  arrays%triangle_id = location_of(triangle_id)
  arrays%leaflet_id = location_of(leaflet_id)
  arrays%side = location_of(side)
  status = riis_points_init(points, c_sizeof(points))
  if (status /= RIIS_OK) return
  points%n_points = n_points
  points%x = location_of(x)
  points%y = location_of(y)
  points%z = location_of(z)
  points%stride = stride
  status = riis_closest_points(c_handle_of(surface), points, options, arrays)
end subroutine riisf_closest_points_listed_64
