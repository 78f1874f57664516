! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77_arrays.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The external subroutines for surfaces from the caller's triangles or quads, and from frames in time. The conventions are those
!! of riis_f77.f90. Triangles without area are refused.

!> Makes a surface from triangles or quads, placed by x -> scale * rotation * x + translation. A quad 1 2 3 4 becomes the
!! triangles 1 2 3 and 1 3 4. Errors: RIIS_INVALID_SURFACE naming the face or vertex and its value, RIIS_INVALID_ARGUMENT for
!! an option out of range, RIIS_LIMIT_EXCEEDED for too many faces.
subroutine riisf_surface_from_arrays(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, index_base, &
    half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_surface_arrays, riis_surface_options, RIIS_OK, riis_surface_arrays_init, &
    riis_surface_create_from_arrays
  use riis_support, only: get_placement, handle_of, location_of
  implicit none
  integer(int32), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  integer(int32), intent(in) :: corners_per_face          !< 3 for triangles, 4 for quads.
  integer(int32), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int32), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces), counted from index_base. The
                                                          !! right-hand rule makes the normal.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first vertex's number.
  real(c_double), intent(in) :: x(*)                      !< Vertex i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Vertex i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Vertex i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  real(c_double), intent(in) :: half_thickness            !< Mesh units; RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The error of distances is at most tolerance
                                                          !! * half_thickness.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees; 0 for no rotation.
  real(c_double), intent(in) :: translation(3)            !< Mesh units; 0 for no translation.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%id_bits = storage_size(n_faces)
  arrays%index_base = index_base
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  status = get_placement(half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, options)
  if (status /= RIIS_OK) return
  c_handle = c_null_ptr
  status = riis_surface_create_from_arrays(arrays, options, c_handle)
  if (status == RIIS_OK) surface = handle_of(c_handle)
end subroutine riisf_surface_from_arrays

!> Replaces the surface by triangles or quads that moved, with the same options and with the velocities of the vertices. The
!! placement rotates and scales velocities, but does not translate them. Errors: as for riisf_surface_from_arrays.
subroutine riisf_surface_update_arrays(surface, n_vertices, x, y, z, stride, vx, vy, vz, velocity_stride, &
    corners_per_face, n_faces, vertex_ids, index_base, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_surface_arrays, RIIS_OK, riis_surface_arrays_init, riis_surface_update_from_arrays
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int32), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  integer(int32), intent(in) :: corners_per_face          !< 3 for triangles, 4 for quads.
  integer(int32), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int32), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces), counted from index_base. The
                                                          !! right-hand rule makes the normal.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first vertex's number.
  real(c_double), intent(in) :: x(*)                      !< Vertex i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Vertex i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Vertex i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int32), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  real(c_double), intent(in) :: vx(*)                     !< Vertex i has vx(1 + (i - 1) * velocity_stride); 0: no velocities.
  real(c_double), intent(in) :: vy(*)                     !< Like vx.
  real(c_double), intent(in) :: vz(*)                     !< Like vx.
  integer(int32), intent(in) :: velocity_stride           !< 1 for separate arrays, 3 for V(3,*).
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%id_bits = storage_size(n_faces)
  arrays%index_base = index_base
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  arrays%vx = location_of(vx)
  arrays%vy = location_of(vy)
  arrays%vz = location_of(vz)
  arrays%velocity_stride = velocity_stride
  status = riis_surface_update_from_arrays(c_handle_of(surface), arrays)
end subroutine riisf_surface_update_arrays

!> Makes keyframes: a surface that moves by frames in time. All frames have the same faces, but other positions of the vertices.
!! All arrays are copied. Errors: RIIS_INVALID_ARGUMENT naming the key, counted from 0, and its value; RIIS_INVALID_SURFACE naming
!! the frame, vertex or face.
subroutine riisf_keyframes_create(n_vertices, n_keys, time, xyz, period, interpolation, corners_per_face, n_faces, &
    vertex_ids, index_base, keyframes, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_keyframe_arrays, riis_status, riis_surface_arrays, RIIS_OK, riis_keyframe_arrays_init, &
    riis_keyframes_create, riis_surface_arrays_init
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int32), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  integer(int32), intent(in) :: corners_per_face          !< 3 for triangles, 4 for quads.
  integer(int32), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int32), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces), counted from index_base. The
                                                          !! right-hand rule makes the normal.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first vertex's number.
  integer(int32), intent(in) :: n_keys                    !< 1 to 1,000,000.
  real(c_double), intent(in) :: time(*)                   !< (n_keys), strictly ascending, magnitude at most 1e30.
  real(c_double), intent(in) :: xyz(*)                    !< (3, n_vertices, n_keys): the vertices, one frame after the other.
  real(c_double), intent(in) :: period                    !< > 0: the motion repeats. Its keys lie within one period of the first.
                                                          !! A last key one period after the first must have the same frame. 0:
                                                          !! the surface rests before the first frame and after the last.
  integer(int32), intent(in) :: interpolation             !< RIIS_INTERPOLATION_LINEAR or RIIS_INTERPOLATION_CUBIC.
  integer(int64), intent(inout) :: keyframes              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_keyframe_arrays) :: frames
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%id_bits = storage_size(n_faces)
  arrays%index_base = index_base
  status = riis_keyframe_arrays_init(frames, c_sizeof(frames))
  if (status /= RIIS_OK) return
  frames%n_keys = n_keys
  frames%n_vertices = n_vertices
  frames%time = location_of(time)
  frames%xyz = location_of(xyz)
  frames%period = period
  frames%interpolation = interpolation
  c_handle = c_null_ptr
  status = riis_keyframes_create(arrays, frames, c_handle)
  if (status == RIIS_OK) keyframes = handle_of(c_handle)
end subroutine riisf_keyframes_create

!> Does the same.
subroutine riisf_surface_from_arrays_64(n_vertices, x, y, z, stride, corners_per_face, n_faces, vertex_ids, index_base, &
    half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_surface_arrays, riis_surface_options, RIIS_OK, riis_surface_arrays_init, &
    riis_surface_create_from_arrays
  use riis_support, only: get_placement, handle_of, location_of
  implicit none
  integer(int64), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  integer(int32), intent(in) :: corners_per_face          !< 3 for triangles, 4 for quads.
  integer(int64), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int64), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces), counted from index_base. The
                                                          !! right-hand rule makes the normal.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first vertex's number.
  real(c_double), intent(in) :: x(*)                      !< Vertex i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Vertex i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Vertex i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  real(c_double), intent(in) :: half_thickness            !< Mesh units; RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The error of distances is at most tolerance
                                                          !! * half_thickness.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees; 0 for no rotation.
  real(c_double), intent(in) :: translation(3)            !< Mesh units; 0 for no translation.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%id_bits = storage_size(n_faces)
  arrays%index_base = index_base
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  status = get_placement(half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, options)
  if (status /= RIIS_OK) return
  c_handle = c_null_ptr
  status = riis_surface_create_from_arrays(arrays, options, c_handle)
  if (status == RIIS_OK) surface = handle_of(c_handle)
end subroutine riisf_surface_from_arrays_64

!> Does the same.
subroutine riisf_surface_update_arrays_64(surface, n_vertices, x, y, z, stride, vx, vy, vz, velocity_stride, &
    corners_per_face, n_faces, vertex_ids, index_base, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, riis_surface_arrays, RIIS_OK, riis_surface_arrays_init, riis_surface_update_from_arrays
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  integer(int32), intent(in) :: corners_per_face          !< 3 for triangles, 4 for quads.
  integer(int64), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int64), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces), counted from index_base. The
                                                          !! right-hand rule makes the normal.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first vertex's number.
  real(c_double), intent(in) :: x(*)                      !< Vertex i is x(1 + (i - 1) * stride): X or XYZ(1,1).
  real(c_double), intent(in) :: y(*)                      !< Vertex i is y(1 + (i - 1) * stride): Y or XYZ(2,1).
  real(c_double), intent(in) :: z(*)                      !< Vertex i is z(1 + (i - 1) * stride): Z or XYZ(3,1).
  integer(int64), intent(in) :: stride                    !< 1 for separate arrays, 3 for XYZ(3,*).
  real(c_double), intent(in) :: vx(*)                     !< Vertex i has vx(1 + (i - 1) * velocity_stride); 0: no velocities.
  real(c_double), intent(in) :: vy(*)                     !< Like vx.
  real(c_double), intent(in) :: vz(*)                     !< Like vx.
  integer(int64), intent(in) :: velocity_stride           !< 1 for separate arrays, 3 for V(3,*).
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%id_bits = storage_size(n_faces)
  arrays%index_base = index_base
  arrays%x = location_of(x)
  arrays%y = location_of(y)
  arrays%z = location_of(z)
  arrays%stride = stride
  arrays%vx = location_of(vx)
  arrays%vy = location_of(vy)
  arrays%vz = location_of(vz)
  arrays%velocity_stride = velocity_stride
  status = riis_surface_update_from_arrays(c_handle_of(surface), arrays)
end subroutine riisf_surface_update_arrays_64

!> Does the same.
subroutine riisf_keyframes_create_64(n_vertices, n_keys, time, xyz, period, interpolation, corners_per_face, n_faces, &
    vertex_ids, index_base, keyframes, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_keyframe_arrays, riis_status, riis_surface_arrays, RIIS_OK, riis_keyframe_arrays_init, &
    riis_keyframes_create, riis_surface_arrays_init
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int64), intent(in) :: n_vertices                !< 1 to 2^31 - 1.
  integer(int32), intent(in) :: corners_per_face          !< 3 for triangles, 4 for quads.
  integer(int64), intent(in) :: n_faces                   !< 1 to 16,777,216 triangles, half as many quads.
  integer(int64), intent(in) :: vertex_ids(*)             !< (corners_per_face, n_faces), counted from index_base. The
                                                          !! right-hand rule makes the normal.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first vertex's number.
  integer(int32), intent(in) :: n_keys                    !< 1 to 1,000,000.
  real(c_double), intent(in) :: time(*)                   !< (n_keys), strictly ascending, magnitude at most 1e30.
  real(c_double), intent(in) :: xyz(*)                    !< (3, n_vertices, n_keys): the vertices, one frame after the other.
  real(c_double), intent(in) :: period                    !< > 0: the motion repeats. Its keys lie within one period of the first.
                                                          !! A last key one period after the first must have the same frame. 0:
                                                          !! the surface rests before the first frame and after the last.
  integer(int32), intent(in) :: interpolation             !< RIIS_INTERPOLATION_LINEAR or RIIS_INTERPOLATION_CUBIC.
  integer(int64), intent(inout) :: keyframes              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_arrays) :: arrays
  type(riis_keyframe_arrays) :: frames
  type(c_ptr) :: c_handle
  status = riis_surface_arrays_init(arrays, c_sizeof(arrays))
  if (status /= RIIS_OK) return
  arrays%n_vertices = n_vertices
  arrays%corners_per_face = corners_per_face
  arrays%n_faces = n_faces
  arrays%vertex_ids = location_of(vertex_ids)
  arrays%id_bits = storage_size(n_faces)
  arrays%index_base = index_base
  status = riis_keyframe_arrays_init(frames, c_sizeof(frames))
  if (status /= RIIS_OK) return
  frames%n_keys = n_keys
  frames%n_vertices = n_vertices
  frames%time = location_of(time)
  frames%xyz = location_of(xyz)
  frames%period = period
  frames%interpolation = interpolation
  c_handle = c_null_ptr
  status = riis_keyframes_create(arrays, frames, c_handle)
  if (status == RIIS_OK) keyframes = handle_of(c_handle)
end subroutine riisf_keyframes_create_64

!> Makes a surface from the frames around a time, with velocities. The placement is that of riisf_surface_create. Errors:
!! RIIS_INVALID_ARGUMENT for a time or an option out of range, RIIS_INVALID_SURFACE for a face without area.
subroutine riisf_surface_from_keyframes(keyframes, time, dt, half_thickness, tolerance, scale, rotation_axis, &
    rotation_angle, translation, surface, status)
  use, intrinsic :: iso_c_binding, only: c_double, c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_surface_options, RIIS_OK, riis_surface_create_from_keyframes
  use riis_support, only: c_handle_of, get_placement, handle_of
  implicit none
  integer(int64), intent(in) :: keyframes                 !< Must be created; read during the call only.
  real(c_double), intent(in) :: time                      !< Magnitude at most 1e30.
  real(c_double), intent(in) :: dt                        !< The velocity is the mean from time - dt to time. 0: it is the
                                                          !! derivative of the interpolation.
  real(c_double), intent(in) :: half_thickness            !< Mesh units; RIIS_AUTO: 0.1 * scale.
  real(c_double), intent(in) :: tolerance                 !< 1e-6 to 1, usually 0.05. The error of distances is at most tolerance
                                                          !! * half_thickness.
  real(c_double), intent(in) :: scale                     !< 1e-12 to 1e12; 1 leaves the size.
  real(c_double), intent(in) :: rotation_axis(3)          !< At least 1e-50 long.
  real(c_double), intent(in) :: rotation_angle            !< Degrees; 0 for no rotation.
  real(c_double), intent(in) :: translation(3)            !< Mesh units; 0 for no translation.
  integer(int64), intent(inout) :: surface                !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_surface_options) :: options
  type(c_ptr) :: c_handle
  status = get_placement(half_thickness, tolerance, scale, rotation_axis, rotation_angle, translation, options)
  if (status /= RIIS_OK) return
  c_handle = c_null_ptr
  status = riis_surface_create_from_keyframes(c_handle_of(keyframes), time, dt, options, c_handle)
  if (status == RIIS_OK) surface = handle_of(c_handle)
end subroutine riisf_surface_from_keyframes

!> Replaces the surface by the surface at another time, with the same options. Errors: as for riisf_surface_from_keyframes.
subroutine riisf_surface_update_keyframes(surface, keyframes, time, dt, status)
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_surface_update_from_keyframes
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: surface                   !< Must be created.
  integer(int64), intent(in) :: keyframes                 !< Must be created; read during the call only.
  real(c_double), intent(in) :: time                      !< Magnitude at most 1e30.
  real(c_double), intent(in) :: dt                        !< As in riisf_surface_from_keyframes.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_surface_update_from_keyframes(c_handle_of(surface), c_handle_of(keyframes), time, dt)
end subroutine riisf_surface_update_keyframes

!> Destroys the keyframes and sets their handle to 0. Surfaces made from them stay. Nothing happens to a handle that is 0.
subroutine riisf_keyframes_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_keyframes_destroy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_keyframes_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_keyframes_destroy
