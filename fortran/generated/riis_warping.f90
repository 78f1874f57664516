! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_warping.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Warps: riis_warp_* of riis.h, as a part of module riis.
module riis_warping
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_associated, c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c
  use riis_support
  implicit none
  private
  public :: riis_warp

  !> A smooth map of space that takes landmarks on a valve to landmarks in a patient. The matrix of the warp is factored once, so
  !! new targets in each time step cost little. The warp is empty before %create and after %destroy. Call %destroy, because
  !! nothing else frees the memory. Any number of threads may read a warp at once. One thread may write a warp while no other
  !! thread reads it.
  type :: riis_warp
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, non_overridable :: create => warp_create                 !< Makes the warp from landmarks on the valve.
    procedure, non_overridable :: set_targets => warp_set_targets       !< Takes the landmarks to new places.
    procedure, non_overridable :: set_targets_at => warp_set_targets_at !< Takes them to their places at a time.
    procedure, non_overridable :: map => warp_map                       !< Maps points.
    procedure, non_overridable :: get_info => warp_get_info             !< Gives the quality of the warp.
    procedure, non_overridable :: is_created => warp_is_created         !< Returns whether the object was created.
    procedure, non_overridable :: c_handle => warp_c_handle             !< The handle for calls of riis_c.
    procedure, non_overridable :: destroy => warp_destroy               !< Frees its memory.
    generic :: assignment(=) => assign                                  !< Refused: a handle cannot be copied.
    procedure, private, non_overridable :: assign => warp_assign
  end type riis_warp

contains

  !> Makes a warp from landmarks on the valve at rest. Until %set_targets, the warp is the identity. Without a placement,
  !! landmarks are in the valve's own coordinates. With a placement, which must be the placement of the surface, landmarks are in
  !! the mesh's coordinates. Errors: RIIS_INVALID_ARGUMENT naming the landmark, counted from 0. Two landmarks in one place are
  !! refused, and so are landmarks on a line.
  subroutine warp_create(this, sources, noise, scale, rotation_axis, rotation_angle, translation, status)
    class(riis_warp), intent(inout) :: this                 !< Must be empty.
    real(c_double), intent(in), contiguous, target :: sources(:, :) !< (3, n): 3 to 1000 landmarks.
    real(c_double), intent(in), optional :: noise           !< Standard deviation of each coordinate of the targets, >= 0. The map
                                                            !! is smoothed until it misses the targets by about that much. Default
                                                            !! 0: the map meets the targets exactly.
    real(c_double), intent(in), optional :: scale           !< 1e-12 to 1e12. Default 1.
    real(c_double), intent(in), optional :: rotation_axis(:) !< (3), at least 1e-50 long. Default (0, 0, 1).
    real(c_double), intent(in), optional :: rotation_angle  !< Degrees. Default 0.
    real(c_double), intent(in), optional :: translation(:)  !< (3), mesh units. Default 0.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_warp_options) :: options
    type(riis_surface_options), target :: placement
    type(riis_points) :: points
    code = check_not_created(this%handle, 'the warp')
    if (code == RIIS_OK) code = riis_warp_options_init(options, c_sizeof(options))
    if (code == RIIS_OK) code = riis_surface_options_init(placement, c_sizeof(placement))
    if (code == RIIS_OK) then
      if (present(noise)) options%noise = noise
      if (present(scale)) placement%scale = scale
      if (present(rotation_angle)) placement%rotation_angle = rotation_angle
      if (present(scale) .or. present(rotation_axis) .or. present(rotation_angle) .or. present(translation)) &
        options%placement = c_loc(placement)
      call set_vector(rotation_axis, 'rotation_axis', placement%rotation_axis, code)
      call set_vector(translation, 'translation', placement%translation, code)
      call get_points(sources, 'sources', points, code)
    end if
    if (code == RIIS_OK) code = riis_warp_create(points, options, this%handle)
    call finish(code, status)
  end subroutine warp_create

  ! Describes points in an array (3, n).
  subroutine get_points(xyz, name, points, code)
    real(c_double), intent(in), contiguous, target :: xyz(:, :)
    character(len=*), intent(in) :: name
    type(riis_points), intent(inout) :: points
    integer(riis_status), intent(inout) :: code
    if (code == RIIS_OK .and. size(xyz, 1) /= 3) &
      code = refuse('the first extent of ' // name // ' is ' // text_of(size(xyz, 1)) // '; it must be 3')
    if (code == RIIS_OK) code = describe_points(size(xyz, 2, int64), xyz, points)
  end subroutine get_points

  !> Takes the landmarks to the given places. The same targets give the same bits, even after other targets. Errors:
  !! RIIS_INVALID_ARGUMENT naming the landmark; RIIS_INVALID_PARAMETER for a warp that folds, with the place and the determinant.
  subroutine warp_set_targets(this, targets, status)
    class(riis_warp), intent(inout) :: this                 !< Must be created.
    real(c_double), intent(in), contiguous, target :: targets(:, :) !< (3, n): as many as the sources, in their order.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_points) :: points
    code = check_created(this%handle, 'the warp')
    call get_points(targets, 'targets', points, code)
    if (code == RIIS_OK) code = riis_warp_set_targets(this%handle, points)
    call finish(code, status)
  end subroutine warp_set_targets

  !> Takes the landmarks to their places at a time, from a table of keys in time. Errors: as %set_targets, and
  !! RIIS_INVALID_ARGUMENT naming the key, counted from 0, and its value.
  subroutine warp_set_targets_at(this, time, xyz, at, period, interpolation, status)
    class(riis_warp), intent(inout) :: this                 !< Must be created.
    real(c_double), intent(in), contiguous, target :: time(:) !< (n_keys), 1 to 1,000,000, strictly ascending.
    real(c_double), intent(in), contiguous, target :: xyz(:, :, :) !< (3, n, n_keys): the targets, one key after the other.
    real(c_double), intent(in) :: at                        !< The time.
    real(c_double), intent(in), optional :: period          !< > 0: the motion repeats. Default 0: the landmarks rest before the
                                                            !! first key and after the last.
    class(*), intent(in), optional :: interpolation         !< integer, RIIS_INTERPOLATION_*. Default RIIS_INTERPOLATION_LINEAR.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_keyframe_arrays) :: frames
    code = check_created(this%handle, 'the warp')
    if (code == RIIS_OK .and. size(xyz, 1) /= 3) &
      code = refuse('the first extent of xyz is ' // text_of(size(xyz, 1)) // '; it must be 3')
    if (code == RIIS_OK) code = check_size(size(xyz, 3, int64), size(time, kind=int64), 'xyz(1, 1, :)', 'times of keys')
    if (code == RIIS_OK) code = riis_keyframe_arrays_init(frames, c_sizeof(frames))
    call get_integer(interpolation, 'interpolation', frames%interpolation, code)
    if (code == RIIS_OK) then
      frames%n_keys = size(time, kind=int64)
      frames%n_vertices = size(xyz, 2, int64)
      if (size(time) > 0) frames%time = c_loc(time)
      if (size(xyz) > 0) frames%xyz = c_loc(xyz)
      if (present(period)) frames%period = period
      code = riis_warp_set_targets_at(this%handle, frames, at)
    end if
    call finish(code, status)
  end subroutine warp_set_targets_at

  !> Maps points, which are in the coordinates of the landmarks. Errors: RIIS_INVALID_ARGUMENT naming the point, counted from 0.
  subroutine warp_map(this, points, mapped, status)
    class(riis_warp), intent(in) :: this                    !< Must be created.
    real(c_double), intent(in), contiguous, target :: points(:, :) !< (3, n).
    real(c_double), intent(out), contiguous :: mapped(:, :) !< (3, n).
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_points) :: given
    code = check_created(this%handle, 'the warp')
    call get_points(points, 'points', given, code)
    if (code == RIIS_OK .and. any(shape(mapped) /= shape(points))) &
      code = refuse('the shape of mapped is (' // text_of(size(mapped, 1)) // ', ' // text_of(size(mapped, 2)) // &
        '); it must be that of points')
    if (code == RIIS_OK .and. size(points, 2) > 0) code = riis_warp_map(this%handle, given, mapped)
    call finish(code, status)
  end subroutine warp_map

  !> Gives the quality of the warp: residuals, smoothing, and the least determinant.
  subroutine warp_get_info(this, info, status)
    class(riis_warp), intent(in) :: this                    !< Must be created.
    type(riis_warp_info), intent(inout) :: info             !< Every component is set. largest_landmark_id counts from 0.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_created(this%handle, 'the warp')
    if (code == RIIS_OK) code = riis_warp_get_info(this%handle, info, c_sizeof(info))
    call finish(code, status)
  end subroutine warp_get_info

  !> Returns whether the warp was created and not destroyed.
  pure function warp_is_created(this) result(is_created)
    class(riis_warp), intent(in) :: this                    !< May be empty.
    logical :: is_created                                   !< .false. for an empty one.
    is_created = c_associated(this%handle)
  end function warp_is_created

  !> Returns the C handle, for calls of module riis_c. The handle belongs to this variable, so do not destroy the handle.
  function warp_c_handle(this) result(handle)
    class(riis_warp), intent(in) :: this                    !< May be empty.
    type(c_ptr) :: handle                                   !< c_null_ptr for an empty one.
    handle = this%handle
  end function warp_c_handle

  !> Frees the memory of the warp, which is then empty and can be created again. Valves with this warp keep their copies.
  subroutine warp_destroy(this)
    class(riis_warp), intent(inout) :: this                 !< May be empty.
    call riis_warp_destroy(this%handle)
  end subroutine warp_destroy

  !> Stops the program unless both objects are empty.
  impure elemental subroutine warp_assign(left, right)
    class(riis_warp), intent(inout) :: left                 !< Must be empty.
    class(riis_warp), intent(in) :: right                   !< Must be empty.
    call refuse_copy(left%handle, right%handle, 'riis_warp')
  end subroutine warp_assign
end module riis_warping
