! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_valves.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> Valves: riis_valve_* of riis.h, as a part of module riis.
module riis_valves
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_ptr, c_associated, c_f_pointer, c_loc, c_null_ptr, &
    c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, c_valve_patches => riis_valve_patches
  use riis_support
  use riis_warping, only: riis_warp
  implicit none
  private
  public :: riis_valve, riis_parameter_info, riis_valve_patches

  !> Pointers to the curves and patches of a valve, by riis_valve%get_patches. The valve owns the arrays, which are valid until
  !! the valve changes. The arrays count from 1. Pieces, curves and ids count from 0.
  type :: riis_valve_patches
    integer(int64), pointer, contiguous :: first_piece(:) => null() !< (n_curves + 1): the pieces of curve i are first_piece(i +
                                                            !! 1) to first_piece(i + 2) - 1.
    integer(int32), pointer, contiguous :: degree(:) => null() !< (n_pieces): 2 or 3.
    real(c_double), pointer, contiguous :: control(:, :) => null() !< (3, the sum of degree + 1 over all pieces): the control
                                                            !! points, piece after piece.
    integer(int32), pointer, contiguous :: curve_id(:, :) => null() !< (4, n_patches): the curves at v = 0, v = 1, u = 0, u = 1.
    integer(int32), pointer, contiguous :: reversed(:, :) => null() !< (4, n_patches): 1 if the side runs opposite to the
                                                            !! direction of its curve, else 0.
    integer(int32), pointer, contiguous :: leaflet_id(:) => null() !< (n_patches): as in riis_triangles.
    integer(int32), pointer, contiguous :: patch_id(:) => null() !< (n_patches): as in riis_triangles.
    integer(int32), pointer, contiguous :: attached(:) => null() !< (n_patches): the side that is attached, 0 to 3 in the order
                                                            !! of curve_id; -1 if no side is attached.
    real(c_double), pointer, contiguous :: bulge(:) => null() !< (n_patches): 0 for a Coons patch. If the bulge is not 0, the
                                                            !! line at each u is an arc from v = 0 to v = 1. Let W be the
                                                            !! vector from the start to the end of the arc, and T the unit
                                                            !! tangent of the side v = 0. The middle control point of the arc
                                                            !! is the midpoint of start and end plus bulge |W| unit(W x T).
  end type riis_valve_patches

  !> The description of a parameter.
  type :: riis_parameter_info
    character(len=:), allocatable :: name            !< The name for riis_valve%set, such as 'right.leaflet_angle'.
    character(len=:), allocatable :: unit            !< 'length', 'degree' or '1'.
    character(len=:), allocatable :: description     !< One line.
    real(c_double), allocatable :: default_values(:) !< The paper's values, 1 or 3.
    real(c_double) :: minimum = 0                    !< The least allowed value, for each value.
    real(c_double) :: maximum = 0                    !< The greatest allowed value, for each value.
    character(len=:), allocatable :: rule            !< The value if it is not set, such as '0.5 leaflet_height'. '': the default.
    character(len=:), allocatable :: other_name      !< A second name for riis_valve%set, such as 'annulus'. '': none.
    real(c_double) :: other_factor = 0               !< The value of other_name over the parameter's value: 1, 2, or 0 if none.
  end type riis_parameter_info

  !> A parametric valve: its kind and its parameters' values. The valve is empty before %create or %create_from_patches and after
  !! %destroy. Call %destroy, because nothing else frees the memory. Any number of threads may read a valve at once. One thread
  !! may write a valve while no other thread reads it.
  type :: riis_valve
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, non_overridable :: create => valve_create                !< Makes the valve from the name of a kind.
    generic :: create_from_patches => from_patches_int32, from_patches_int64 !< Makes a valve from the caller's patches.
    procedure, non_overridable :: copy => valve_copy                    !< Makes a copy of the valve.
    generic :: set => set_scalar, set_vector                            !< Sets a parameter's value or values.
    generic :: get => get_scalar, get_vector                            !< Gets a parameter's value or values.
    procedure, non_overridable :: unset => valve_unset                  !< Returns a parameter to its rule or default.
    procedure, non_overridable :: is_set => valve_is_set                !< Returns whether a parameter was set.
    procedure, non_overridable :: set_open_state => valve_set_open_state !< Gives the valve an open state.
    procedure, non_overridable :: set_warp => valve_set_warp            !< Warps the valve, or removes the warp.
    procedure, non_overridable :: get_patches => valve_get_patches      !< Points to the valve's curves and patches.
    procedure, non_overridable :: n_parameters => valve_n_parameters    !< Returns the number of parameters.
    generic :: parameter => parameter_int32, parameter_int64            !< Describes a parameter.
    procedure, non_overridable :: is_created => valve_is_created        !< Returns whether the object was created.
    procedure, non_overridable :: c_handle => valve_c_handle            !< The handle for calls of riis_c.
    procedure, non_overridable :: destroy => valve_destroy              !< Frees its memory.
    generic :: assignment(=) => assign                                  !< Refused: a handle cannot be copied.
    procedure, private, non_overridable :: assign => valve_assign
    procedure, private, non_overridable :: from_patches_int32 => valve_from_patches_int32
    procedure, private, non_overridable :: from_patches_int64 => valve_from_patches_int64
    procedure, private, non_overridable :: set_scalar => valve_set_scalar
    procedure, private, non_overridable :: set_vector => valve_set_vector
    procedure, private, non_overridable :: get_scalar => valve_get_scalar
    procedure, private, non_overridable :: get_vector => valve_get_vector
    procedure, private, non_overridable :: parameter_int32 => valve_parameter_int32
    procedure, private, non_overridable :: parameter_int64 => valve_parameter_int64
  end type riis_valve

contains

  !> Makes a valve with the default parameter values. Errors: RIIS_INVALID_PARAMETER for an unknown kind.
  subroutine valve_create(this, kind, status)
    class(riis_valve), intent(inout) :: this                !< Must be empty.
    character(len=*), intent(in) :: kind                    !< 'aortic', 'tricuspid' or another kind of riis_valve_create.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_not_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = riis_valve_create(riis_c_string(kind), this%handle)
    call finish(code, status)
  end subroutine valve_create

  !> Makes a copy with the same parameters, patches and states. Each valve is destroyed separately.
  subroutine valve_copy(this, copy, status)
    class(riis_valve), intent(in) :: this                   !< Must be created.
    class(riis_valve), intent(inout) :: copy                !< Must be empty.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = check_not_created(copy%handle, 'copy')
    if (code == RIIS_OK) code = riis_valve_copy(this%handle, copy%handle)
    call finish(code, status)
  end subroutine valve_copy

  !> Makes a valve, such as a prosthesis, from Coons patches, each given by its four boundary curves. The valve has the parameters
  !! 'opening' and 'skirt_length'. The sides v = 0 and v = 1 run from the side u = 0 to the side u = 1. The sides u = 0 and u = 1
  !! run from v = 0 to v = 1. Corners must meet to 1e-9 of the valve's size. Normals point along S_u x S_v. All arrays are read
  !! during the call only, and sections that are not contiguous are copied. Errors: RIIS_INVALID_ARGUMENT for sizes that do not
  !! match, RIIS_INVALID_PARAMETER naming the curve or patch and its value.
  subroutine valve_from_patches_int32(this, degree, control, curve_id, reversed, leaflet_id, index_base, status)
    class(riis_valve), intent(inout) :: this                     !< Must be empty.
    integer(int32), intent(in), contiguous, target :: degree(:)  !< (n_curves): the degrees of the Bezier curves, 1, 2 or 3.
    real(c_double), intent(in), contiguous, target :: control(:, :) !< (3, sum(degree + 1)): the control points, one curve
                                                                 !! after the other.
    integer(int32), intent(in), contiguous, target :: curve_id(:, :) !< (4, n_patches): the curves at v = 0, v = 1,
                                                                 !! u = 0, u = 1, counted from index_base.
    logical, intent(in), optional :: reversed(:, :)              !< (4, n_patches): .true. if the side runs opposite to its curve.
                                                                 !! Default .false.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_patches), >= 0. Default 0.
    class(*), intent(in), optional :: index_base                 !< integer, 0 or 1: the first curve's number. Default 1.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_patches) :: patches
    integer(int32), allocatable, target :: reversed_sides(:, :)
    integer :: stat

    code = check_not_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = riis_patches_init(patches, c_sizeof(patches))
    patches%index_base = 1
    call get_integer(index_base, 'index_base', patches%index_base, code)
    if (code == RIIS_OK) code = check_patches(degree, control, curve_id, reversed, leaflet_id)
    if (code == RIIS_OK) then
      patches%n_curves = size(degree, kind=int64)
      patches%n_patches = size(curve_id, 2, int64)
      if (size(degree, kind=int64) > 0) patches%degree = c_loc(degree)
      if (size(control, kind=int64) > 0) patches%control = c_loc(control)
      if (size(curve_id, kind=int64) > 0) patches%curve_id = c_loc(curve_id)
      if (present(leaflet_id)) then
        if (size(leaflet_id, kind=int64) > 0) patches%leaflet_id = c_loc(leaflet_id)
      end if
      if (present(reversed)) then
        allocate (reversed_sides(4, size(curve_id, 2)), stat=stat)
        code = out_of_memory(stat)
        if (code == RIIS_OK .and. size(reversed, kind=int64) > 0) then
          reversed_sides = merge(1_int32, 0_int32, reversed)
          patches%reversed = c_loc(reversed_sides)
        end if
      end if
    end if
    if (code == RIIS_OK) code = riis_valve_create_from_patches(patches, this%handle)
    call finish(code, status)
  end subroutine valve_from_patches_int32

  !> Implements %create_from_patches for integer(int64). The arrays of these integers are copied.
  subroutine valve_from_patches_int64(this, degree, control, curve_id, reversed, leaflet_id, index_base, status)
    class(riis_valve), intent(inout) :: this                     !< Must be empty.
    integer(int64), intent(in) :: degree(:)                      !< (n_curves).
    real(c_double), intent(in) :: control(:, :)                  !< (3, sum(degree + 1)).
    integer(int64), intent(in) :: curve_id(:, :)                 !< (4, n_patches).
    logical, intent(in), optional :: reversed(:, :)              !< (4, n_patches). Default .false.
    integer(int64), intent(in), optional :: leaflet_id(:)        !< (n_patches), >= 0. Default 0.
    class(*), intent(in), optional :: index_base                 !< integer, 0 or 1. Default 1.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_fits(degree, 'degree')
    if (code == RIIS_OK) code = check_fits(reshape(curve_id, [size(curve_id, kind=int64)]), 'curve_id')
    if (code == RIIS_OK .and. present(leaflet_id)) code = check_fits(leaflet_id, 'leaflet_id')
    if (code == RIIS_OK .and. present(leaflet_id)) then
      call this%from_patches_int32(int(degree, int32), control, int(curve_id, int32), reversed, int(leaflet_id, int32), &
        index_base, code)
    else if (code == RIIS_OK) then
      call this%from_patches_int32(int(degree, int32), control, int(curve_id, int32), reversed, index_base=index_base, &
        status=code)
    end if
    call finish(code, status)
  end subroutine valve_from_patches_int64

  ! Checks that each array has as many entries as the library will read.
  function check_patches(degree, control, curve_id, reversed, leaflet_id) result(code)
    integer(int32), intent(in) :: degree(:)
    real(c_double), intent(in) :: control(:, :)
    integer(int32), intent(in) :: curve_id(:, :)
    logical, intent(in), optional :: reversed(:, :)
    integer(int32), intent(in), optional :: leaflet_id(:)
    integer(riis_status) :: code
    code = RIIS_OK
    if (size(control, 1) /= 3) then
      code = refuse('the first extent of control is ' // text_of(size(control, 1)) // '; it must be 3')
    else if (size(curve_id, 1) /= 4) then
      code = refuse('the first extent of curve_id is ' // text_of(size(curve_id, 1)) // '; it must be 4')
    else if (all(degree >= 1 .and. degree <= 3)) then ! the library names the bad degree
      code = check_size(size(control, 2, int64), sum(int(degree, int64) + 1), 'control(1, :)', 'control points by degree')
    end if
    if (code == RIIS_OK .and. present(reversed)) then
      if (any(shape(reversed) /= shape(curve_id))) &
        code = refuse('the shape of reversed is (' // text_of(size(reversed, 1)) // ', ' // text_of(size(reversed, 2)) // &
          '); it must be that of curve_id')
    end if
    if (code == RIIS_OK .and. present(leaflet_id)) &
      code = check_size(size(leaflet_id, kind=int64), size(curve_id, 2, int64), 'leaflet_id', 'patches')
  end function check_patches

  ! Checks that conversion to integer(int32) changes no value.
  function check_fits(values, name) result(code)
    integer(int64), intent(in) :: values(:)
    character(len=*), intent(in) :: name
    integer(riis_status) :: code
    integer(int64) :: i
    code = RIIS_OK
    do i = 1, size(values, kind=int64)
      if (values(i) <= huge(0_int32) .and. values(i) >= -huge(0_int32)) cycle
      code = refuse(name // ' has the entry ' // text_of(values(i)) // '; it must fit in 32 bits')
      return
    end do
  end function check_fits

  !> Sets a parameter with one value. A cusp's parameter without a cusp's name ('leaflet_angle') sets all three cusps. The names
  !! 'annulus', 'stj' and 'effective_height' set sizes. Every valve has the parameter 'opening', from 0 to 1. Errors:
  !! RIIS_INVALID_PARAMETER naming the parameter and the value; the valve is then unchanged.
  subroutine valve_set_scalar(this, name, value, status)
    class(riis_valve), intent(inout) :: this                !< Must be created.
    character(len=*), intent(in) :: name                    !< Trailing blanks do not matter.
    real(c_double), intent(in) :: value                     !< Lengths in the valve's unit, angles in degrees.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    character(len=len_trim(name) + 1, kind=c_char) :: c_name
    call end_for_c(name, c_name)
    code = check_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = riis_valve_set_scalar(this%handle, c_name, value)
    call finish(code, status)
  end subroutine valve_set_scalar

  !> Sets a parameter to a copy of the values: as many as it has, 1 or 3. Errors: RIIS_INVALID_PARAMETER naming the
  !! parameter and the value; the valve is then unchanged.
  subroutine valve_set_vector(this, name, value, status)
    class(riis_valve), intent(inout) :: this                !< Must be created.
    character(len=*), intent(in) :: name                    !< Trailing blanks do not matter.
    real(c_double), intent(in), contiguous :: value(:)      !< Lengths in the valve's unit, angles in degrees.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    character(len=len_trim(name) + 1, kind=c_char) :: c_name
    call end_for_c(name, c_name)
    code = check_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = riis_valve_set(this%handle, c_name, size(value, kind=int64), value)
    call finish(code, status)
  end subroutine valve_set_vector

  !> Gets a parameter with one value. A name that stands for all three cusps cannot be read.
  subroutine valve_get_scalar(this, name, value, status)
    class(riis_valve), intent(in) :: this                   !< Must be created.
    character(len=*), intent(in) :: name                    !< Trailing blanks do not matter.
    real(c_double), intent(inout) :: value                  !< Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    character(len=len_trim(name) + 1, kind=c_char) :: c_name
    real(c_double) :: values(1)
    values = value
    call end_for_c(name, c_name)
    code = check_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = riis_valve_get(this%handle, c_name, 1_int64, values)
    value = values(1)
    call finish(code, status)
  end subroutine valve_get_scalar

  !> Gets a parameter with as many values as it has, 1 or 3. A name that stands for all three cusps cannot be read.
  subroutine valve_get_vector(this, name, value, status)
    class(riis_valve), intent(in) :: this                   !< Must be created.
    character(len=*), intent(in) :: name                    !< Trailing blanks do not matter.
    real(c_double), intent(inout), contiguous :: value(:)   !< Unchanged on an error.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    character(len=len_trim(name) + 1, kind=c_char) :: c_name
    call end_for_c(name, c_name)
    code = check_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = riis_valve_get(this%handle, c_name, size(value, kind=int64), value)
    call finish(code, status)
  end subroutine valve_get_vector

  !> Returns a parameter to the value of a valve on which it was not set: its rule's value, or its default. Errors:
  !! RIIS_INVALID_PARAMETER for another name; the valve is then unchanged.
  subroutine valve_unset(this, name, status)
    class(riis_valve), intent(inout) :: this                !< Must be created.
    character(len=*), intent(in) :: name                    !< As in %set. Trailing blanks do not matter.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    character(len=len_trim(name) + 1, kind=c_char) :: c_name
    call end_for_c(name, c_name)
    code = check_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = riis_valve_unset(this%handle, c_name)
    call finish(code, status)
  end subroutine valve_unset

  !> Returns whether a parameter was set. .false. means that the parameter has its default or follows its rule, or that there was
  !! an error. A name that stands for all three cusps cannot be used.
  function valve_is_set(this, name, status) result(is_set)
    class(riis_valve), intent(in) :: this                   !< Must be created.
    character(len=*), intent(in) :: name                    !< As in %get. Trailing blanks do not matter.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    logical :: is_set                                       !< .true. if it was set.
    integer(int32) :: found
    character(len=len_trim(name) + 1, kind=c_char) :: c_name
    found = 0
    call end_for_c(name, c_name)
    code = check_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = riis_valve_is_set(this%handle, c_name, found)
    is_set = found /= 0
    call finish(code, status)
  end function valve_is_set

  !> Gives the valve an open state: its own state is at 'opening' 0, and the other valve's state at 'opening' 1. At other
  !! openings, control points are interpolated. Errors: RIIS_INVALID_PARAMETER for a valve of another kind or with other patches;
  !! the valve is then unchanged.
  subroutine valve_set_open_state(this, open, status)
    class(riis_valve), intent(inout) :: this                !< Must be created.
    class(riis_valve), intent(in) :: open                   !< Must be created. It is copied, so it may be destroyed.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    code = check_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = check_created(open%handle, 'open')
    if (code == RIIS_OK) code = riis_valve_set_open_state(this%handle, open%handle)
    call finish(code, status)
  end subroutine valve_set_open_state

  !> Warps the valve: its curves are mapped at every opening, before the placement. The valve copies the warps. For an annulus
  !! that moves, call this procedure in each step, for two valves in turn, and pass both to riis_surface%update_moving. Without
  !! arguments, the procedure removes the warp. Errors: RIIS_INVALID_ARGUMENT for open without closed; RIIS_INVALID_PARAMETER for
  !! a bileaflet valve.
  subroutine valve_set_warp(this, closed, open, status)
    class(riis_valve), intent(inout) :: this                !< Must be created.
    class(riis_warp), intent(in), optional :: closed        !< The warp at opening 0. Must be created.
    class(riis_warp), intent(in), optional :: open          !< The warp at opening 1. Must be created. Default: closed.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_ptr) :: handles(2)
    handles = c_null_ptr
    code = check_created(this%handle, 'the valve')
    if (present(closed)) then
      handles(1) = closed%c_handle()
      if (code == RIIS_OK) code = check_created(handles(1), 'closed')
    end if
    if (present(open)) then
      handles(2) = open%c_handle()
      if (code == RIIS_OK) code = check_created(handles(2), 'open')
    end if
    if (code == RIIS_OK) code = riis_valve_set_warp(this%handle, handles(1), handles(2))
    call finish(code, status)
  end subroutine valve_set_warp

  !> Points to the curves and patches of the valve at its opening, after a warp and before placement. Errors:
  !! RIIS_INVALID_PARAMETER as for a surface.
  subroutine valve_get_patches(this, patches, status)
    class(riis_valve), intent(inout) :: this                !< Must be created.
    type(riis_valve_patches), intent(inout) :: patches      !< Every component is set, on an error to null.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(c_valve_patches) :: made
    patches = riis_valve_patches()
    code = check_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = riis_valve_get_patches(this%handle, made, c_sizeof(made))
    if (code == RIIS_OK) then
      if (c_associated(made%first_piece)) call c_f_pointer(made%first_piece, patches%first_piece, [made%n_curves + 1])
      if (c_associated(made%degree)) call c_f_pointer(made%degree, patches%degree, [made%n_pieces])
      if (c_associated(made%curve_id)) call c_f_pointer(made%curve_id, patches%curve_id, [4_int64, made%n_patches])
      if (c_associated(made%reversed)) call c_f_pointer(made%reversed, patches%reversed, [4_int64, made%n_patches])
      if (c_associated(made%leaflet_id)) call c_f_pointer(made%leaflet_id, patches%leaflet_id, [made%n_patches])
      if (c_associated(made%patch_id)) call c_f_pointer(made%patch_id, patches%patch_id, [made%n_patches])
      if (c_associated(made%attached)) call c_f_pointer(made%attached, patches%attached, [made%n_patches])
      if (c_associated(made%bulge)) call c_f_pointer(made%bulge, patches%bulge, [made%n_patches])
      call c_f_pointer(made%control, patches%control, [3_int64, sum(int(patches%degree, int64) + 1)])
    end if
    call finish(code, status)
  end subroutine valve_get_patches

  !> Returns the number of the valve's parameters, or 0 on an error.
  function valve_n_parameters(this, status) result(n)
    class(riis_valve), intent(in) :: this                   !< Must be created.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    integer(int64) :: n                                     !< >= 1.
    n = 0
    code = check_created(this%handle, 'the valve')
    if (code == RIIS_OK) code = riis_valve_get_n_parameters(this%handle, n)
    call finish(code, status)
  end function valve_n_parameters

  !> Describes one parameter. Errors: RIIS_INVALID_ARGUMENT for a number out of range; info is then unchanged.
  subroutine valve_parameter_int32(this, number, info, status)
    class(riis_valve), intent(in) :: this                   !< Must be created.
    integer(int32), intent(in) :: number                    !< From 1 to %n_parameters().
    type(riis_parameter_info), intent(inout) :: info        !< Gets copies of the texts and values.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    call valve_parameter_int64(this, int(number, int64), info, code)
    call finish(code, status)
  end subroutine valve_parameter_int32

  !> Does the same as for integer(int32).
  subroutine valve_parameter_int64(this, number, info, status)
    class(riis_valve), intent(in) :: this                   !< Must be created.
    integer(int64), intent(in) :: number                    !< From 1 to %n_parameters().
    type(riis_parameter_info), intent(inout) :: info        !< Gets copies of the texts and values.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_parameter) :: parameter
    integer(int64) :: n
    code = check_created(this%handle, 'the valve')
    n = 0
    if (code == RIIS_OK) code = riis_valve_get_n_parameters(this%handle, n)
    if (code == RIIS_OK .and. (number < 1 .or. number > n)) &
      code = refuse('number is ' // text_of(number) // '; the valve has the parameters 1 to ' // text_of(n))
    if (code == RIIS_OK) code = riis_valve_get_parameter(this%handle, number - 1, parameter, c_sizeof(parameter))
    if (code == RIIS_OK) then
      info%name = riis_c_text(parameter%name)
      info%unit = riis_c_text(parameter%unit)
      info%description = riis_c_text(parameter%description)
      info%default_values = parameter%default_values(:parameter%n_values)
      info%minimum = parameter%minimum
      info%maximum = parameter%maximum
      info%rule = riis_c_text(parameter%rule)
      info%other_name = riis_c_text(parameter%other_name)
      info%other_factor = parameter%other_factor
    end if
    call finish(code, status)
  end subroutine valve_parameter_int64

  !> Returns whether the valve was created and not destroyed.
  pure function valve_is_created(this) result(is_created)
    class(riis_valve), intent(in) :: this                   !< May be empty.
    logical :: is_created                                   !< .false. for an empty one.
    is_created = c_associated(this%handle)
  end function valve_is_created

  !> Returns the C handle, for calls of module riis_c. The handle belongs to this variable, so do not destroy the handle.
  function valve_c_handle(this) result(handle)
    class(riis_valve), intent(in) :: this                   !< May be empty.
    type(c_ptr) :: handle                                   !< c_null_ptr for an empty one.
    handle = this%handle
  end function valve_c_handle

  !> Frees the memory of the valve, which is then empty and can be created again. Nothing happens to an empty valve.
  subroutine valve_destroy(this)
    class(riis_valve), intent(inout) :: this                !< May be empty.
    call riis_valve_destroy(this%handle)
  end subroutine valve_destroy

  !> Stops the program unless both objects are empty.
  impure elemental subroutine valve_assign(left, right)
    class(riis_valve), intent(inout) :: left                !< Must be empty.
    class(riis_valve), intent(in) :: right                  !< Must be empty.
    call refuse_copy(left%handle, right%handle, 'riis_valve')
  end subroutine valve_assign
end module riis_valves
