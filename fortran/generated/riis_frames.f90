! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_frames.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Motion by frames: riis_keyframes_* of riis.h, as a part of module riis.
module riis_frames
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c, only: riis_keyframe_arrays, riis_status, riis_surface_arrays, RIIS_OK, riis_keyframe_arrays_init, &
    riis_keyframes_create, riis_keyframes_destroy
  use riis_support
  implicit none
  private
  public :: riis_keyframes

  !> A surface that moves by frames, such as a patient's valve. All frames have the same faces, but other positions of the
  !! vertices. riis_surface%create_from_keyframes and %update_from_keyframes make the surface at a time. Keyframes are empty
  !! before %create and after %destroy. Call %destroy, since nothing else frees them. Any number of threads may read them at once.
  type :: riis_keyframes
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    generic :: create => create_int32, create_int64                 !< Makes the keyframes from the caller's frames.
    procedure, non_overridable :: is_created => keyframes_is_created    !< Returns whether the object was created.
    procedure, non_overridable :: c_handle => keyframes_c_handle        !< The handle for calls of riis_c.
    procedure, non_overridable :: destroy => keyframes_destroy          !< Frees its memory.
    generic :: assignment(=) => assign                                  !< Refused: a handle cannot be copied.
    procedure, private, non_overridable :: assign => keyframes_assign
    procedure, private, non_overridable :: create_int32 => keyframes_create_int32
    procedure, private, non_overridable :: create_int64 => keyframes_create_int64
  end type riis_keyframes

contains

  !> Makes keyframes from frames, which are copied. The faces are as for %create_from_arrays of a surface. Errors:
  !! RIIS_INVALID_ARGUMENT naming the key, counted from 0, and its value; RIIS_INVALID_SURFACE naming the frame, vertex or face.
  subroutine keyframes_create_int32(this, time, xyz, vertex_ids, leaflet_id, index_base, period, interpolation, &
      status, skirt_length, attached, skirt_lengths)
    class(riis_keyframes), intent(inout) :: this            !< Must be empty.
    real(c_double), intent(in), contiguous, target :: time(:) !< (n_keys), 1 to 1,000,000, strictly ascending, magnitude at
                                                            !! most 1e30.
    real(c_double), intent(in), contiguous, target :: xyz(:, :, :) !< (3, n_vertices, n_keys): the vertices, one frame after
                                                            !! the other.
    integer(int32), intent(in), contiguous, target :: vertex_ids(:, :) !< (3 or 4, n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces), >= 0. Default 0.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first vertex's number. Default 1.
    real(c_double), intent(in), optional :: period          !< > 0: the motion repeats. Its keys lie within one period of the
                                                            !! first. A last key one period after the first must have the same
                                                            !! frame. Default 0: the surface rests before the first frame and
                                                            !! after the last.
    class(*), intent(in), optional :: interpolation         !< integer, RIIS_INTERPOLATION_*, for every coordinate. Default
                                                            !! RIIS_INTERPOLATION_LINEAR.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional :: skirt_length    !< The length of a skirt before placement, 0 for none. Default 0.
    logical, intent(in), optional :: attached(:)            !< (n_vertices): the vertices of the attachment. Default: with a
                                                            !! skirt, the attachment is chosen in the first frame.
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices): the skirt's lengths at the
                                                            !! attached vertices. Default skirt_length.
    integer(riis_status) :: code
    type(riis_surface_arrays) :: faces
    integer(int8), allocatable, target :: bytes(:)
    code = check_not_created(this%handle, 'keyframes')
    call get_faces(size(xyz, 2, int64), size(vertex_ids, 1), size(vertex_ids, 2, int64), storage_size(vertex_ids), leaflet_id, &
      index_base, faces, code)
    if (size(vertex_ids, kind=int64) > 0) faces%vertex_ids = c_loc(vertex_ids)
    call get_mask(attached, bytes, code)
    call set_skirt(skirt_length, bytes, skirt_lengths, faces, code)
    call create(this, time, xyz, faces, period, interpolation, code)
    call finish(code, status)
  end subroutine keyframes_create_int32

  !> Implements %create for integer(int64).
  subroutine keyframes_create_int64(this, time, xyz, vertex_ids, leaflet_id, index_base, period, interpolation, &
      status, skirt_length, attached, skirt_lengths)
    class(riis_keyframes), intent(inout) :: this            !< Must be empty.
    real(c_double), intent(in), contiguous, target :: time(:) !< (n_keys), 1 to 1,000,000, strictly ascending, magnitude at
                                                            !! most 1e30.
    real(c_double), intent(in), contiguous, target :: xyz(:, :, :) !< (3, n_vertices, n_keys): the vertices, one frame after
                                                            !! the other.
    integer(int64), intent(in), contiguous, target :: vertex_ids(:, :) !< (3 or 4, n_faces), counted from index_base.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces), >= 0. Default 0.
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1: the first vertex's number. Default 1.
    real(c_double), intent(in), optional :: period          !< > 0: the motion repeats. Its keys lie within one period of the
                                                            !! first. A last key one period after the first must have the same
                                                            !! frame. Default 0: the surface rests before the first frame and
                                                            !! after the last.
    class(*), intent(in), optional :: interpolation         !< integer, RIIS_INTERPOLATION_*, for every coordinate. Default
                                                            !! RIIS_INTERPOLATION_LINEAR.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    real(c_double), intent(in), optional :: skirt_length    !< The length of a skirt before placement, 0 for none. Default 0.
    logical, intent(in), optional :: attached(:)            !< (n_vertices): the vertices of the attachment. Default: with a
                                                            !! skirt, the attachment is chosen in the first frame.
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices): the skirt's lengths at the
                                                            !! attached vertices. Default skirt_length.
    integer(riis_status) :: code
    type(riis_surface_arrays) :: faces
    integer(int8), allocatable, target :: bytes(:)
    code = check_not_created(this%handle, 'keyframes')
    call get_faces(size(xyz, 2, int64), size(vertex_ids, 1), size(vertex_ids, 2, int64), storage_size(vertex_ids), leaflet_id, &
      index_base, faces, code)
    if (size(vertex_ids, kind=int64) > 0) faces%vertex_ids = c_loc(vertex_ids)
    call get_mask(attached, bytes, code)
    call set_skirt(skirt_length, bytes, skirt_lengths, faces, code)
    call create(this, time, xyz, faces, period, interpolation, code)
    call finish(code, status)
  end subroutine keyframes_create_int64

  ! The common part of both specific procedures of create. It does nothing after an error.
  subroutine create(this, time, xyz, faces, period, interpolation, code)
    class(riis_keyframes), intent(inout) :: this
    real(c_double), intent(in), contiguous, target :: time(:), xyz(:, :, :)
    type(riis_surface_arrays), intent(in) :: faces
    real(c_double), intent(in), optional :: period
    class(*), intent(in), optional :: interpolation
    integer(riis_status), intent(inout) :: code
    type(riis_keyframe_arrays) :: frames
    if (code == RIIS_OK .and. size(xyz, 1) /= 3) &
      code = refuse('the first extent of xyz is ' // text_of(size(xyz, 1)) // '; it must be 3')
    if (code == RIIS_OK) code = check_size(size(xyz, 3, int64), size(time, kind=int64), 'xyz(1, 1, :)', 'times of keys')
    if (code == RIIS_OK) code = riis_keyframe_arrays_init(frames, c_sizeof(frames))
    call get_integer(interpolation, 'interpolation', frames%interpolation, code)
    if (code /= RIIS_OK) return
    frames%n_keys = size(time, kind=int64)
    frames%n_vertices = faces%n_vertices
    if (size(time) > 0) frames%time = c_loc(time)
    if (size(time) > 0) frames%xyz = c_loc(xyz)
    if (present(period)) frames%period = period
    code = riis_keyframes_create(faces, frames, this%handle)
  end subroutine create

  !> Returns whether the keyframes were created and not destroyed.
  pure function keyframes_is_created(this) result(is_created)
    class(riis_keyframes), intent(in) :: this               !< May be empty.
    logical :: is_created                                   !< .false. for empty ones.
    is_created = c_associated(this%handle)
  end function keyframes_is_created

  !> Returns the C handle, for calls of module riis_c. The handle belongs to this variable, so do not destroy the handle.
  function keyframes_c_handle(this) result(handle)
    class(riis_keyframes), intent(in) :: this               !< May be empty.
    type(c_ptr) :: handle                                   !< c_null_ptr for empty ones.
    handle = this%handle
  end function keyframes_c_handle

  !> Frees the memory of the keyframes, which are then empty and can be created again. Surfaces made from them stay. Nothing
  !! happens to empty ones.
  subroutine keyframes_destroy(this)
    class(riis_keyframes), intent(inout) :: this            !< May be empty.
    call riis_keyframes_destroy(this%handle)
  end subroutine keyframes_destroy

  !> Stops the program unless both objects are empty.
  impure elemental subroutine keyframes_assign(left, right)
    class(riis_keyframes), intent(inout) :: left            !< Must be empty.
    class(riis_keyframes), intent(in) :: right              !< Must be empty.
    call refuse_copy(left%handle, right%handle, 'riis_keyframes')
  end subroutine keyframes_assign
end module riis_frames
