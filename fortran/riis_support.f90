! SPDX-License-Identifier: Apache-2.0
!> The common part of the modules behind `riis`: errors, the addresses of the caller's arrays, integers of either kind. Users do
!! not need this module, and `use riis` does not give its names.
module riis_support
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_intptr_t, c_null_char, c_ptr, c_associated, &
    c_loc, c_null_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c, only: riis_status, RIIS_OK, RIIS_INVALID_ARGUMENT, RIIS_INVALID_SURFACE, RIIS_LIMIT_EXCEEDED, &
    RIIS_OUT_OF_MEMORY, riis_points, riis_surface_arrays, riis_c_string, riis_c_text, &
    riis_last_error, riis_points_init, riis_status_name, riis_surface_arrays_init
  implicit none
  private
  public :: strided_points, points_of, describe_points, address_of, text_of
  public :: c_handle_of, handle_of, location_of
  public :: finish, fail, refuse, out_of_memory, check_created, check_not_created, refuse_copy, get_integer, check_size
  public :: check_columns, set_vector
  public :: get_faces, set_skirt, get_mask, end_for_c

  !> The location of points in the form of riis.h: point i is x[i * stride], y[i * stride], z[i * stride].
  type :: strided_points
    integer(int64) :: n = 0               !< The number of points.
    integer(int64) :: stride = 1          !< The distance from one point to the next, in reals.
    type(c_ptr) :: x = c_null_ptr         !< The first point's x; null, like y and z, if there are no points.
    type(c_ptr) :: y = c_null_ptr         !< The first point's y.
    type(c_ptr) :: z = c_null_ptr         !< The first point's z.
  end type strided_points

  !> Gives the points of the caller's arrays without a copy: xyz(3, n), or x(n), y(n), z(n).
  interface points_of
    module procedure points_of_matrix
    module procedure points_of_vectors
  end interface points_of

  !> Gets the value of an option of either integer kind. If the option is absent, the value does not change.
  interface get_integer
    module procedure get_int32
    module procedure get_int64
  end interface get_integer

  !> Converts a mask to bytes: 1 for .true. and for numbers other than 0. If the mask is absent, the bytes stay unallocated. If
  !! unallocated bytes are passed to an optional argument, this argument is absent.
  interface get_mask
    module procedure get_mask_logical
    module procedure get_mask_int32
  end interface get_mask

  !> Returns an integer of either kind as a text without blanks.
  interface text_of
    module procedure text_of_int32
    module procedure text_of_int64
  end interface text_of

  interface
    !> Records the message as the calling thread's last error, so that riis_last_error also returns errors of the Fortran
    !! procedures. The function is declared in src/common/component.h.
    function riis_component_error(status, text) result(same) bind(c, name='riis_component_error')
      import :: c_char, riis_status
      implicit none
      integer(riis_status), value :: status                 !< The error's status.
      character(kind=c_char), intent(in) :: text(*)         !< Ended by a null character.
      integer(riis_status) :: same                          !< The same status.
    end function riis_component_error
  end interface

contains

  !> Ends every public procedure. If the argument is present, it gets the status; otherwise an error stops the program.
  subroutine finish(code, status)
    integer(riis_status), intent(in) :: code                !< The result of the procedure.
    integer(riis_status), intent(out), optional :: status   !< The caller's argument.
    if (present(status)) then
      status = code
    else if (code /= RIIS_OK) then
      error stop 'riis: ' // riis_c_text(riis_status_name(code)) // ': ' // riis_c_text(riis_last_error())
    end if
  end subroutine finish

  !> Sets the message of the calling thread's last error.
  function fail(code, text) result(same)
    integer(riis_status), intent(in) :: code                !< The status of the error.
    character(len=*), intent(in) :: text                    !< The fault, with the argument's name and value.
    integer(riis_status) :: same                            !< The same status.
    same = riis_component_error(code, riis_c_string(text))
  end function fail

  !> Sets the message of RIIS_INVALID_ARGUMENT, the most frequent error, and returns this status.
  function refuse(text) result(code)
    character(len=*), intent(in) :: text                    !< The fault, with the argument's name and value.
    integer(riis_status) :: code                            !< RIIS_INVALID_ARGUMENT.
    code = fail(RIIS_INVALID_ARGUMENT, text)
  end function refuse

  !> Turns the STAT of an ALLOCATE into a status.
  function out_of_memory(stat) result(code)
    integer, intent(in) :: stat                             !< 0 if the ALLOCATE succeeded.
    integer(riis_status) :: code                            !< RIIS_OK or RIIS_OUT_OF_MEMORY.
    code = RIIS_OK
    if (stat /= 0) code = fail(RIIS_OUT_OF_MEMORY, 'out of memory')
  end function out_of_memory

  !> Checks that a handle was created.
  function check_created(handle, name) result(code)
    type(c_ptr), intent(in) :: handle                       !< The handle.
    character(len=*), intent(in) :: name                    !< The caller's name for it.
    integer(riis_status) :: code                            !< RIIS_OK or RIIS_INVALID_ARGUMENT.
    code = RIIS_OK
    if (.not. c_associated(handle)) code = refuse(name // ' was not created, or was destroyed')
  end function check_created

  !> Checks that a handle is empty, because creating an object would lose the present one.
  function check_not_created(handle, name) result(code)
    type(c_ptr), intent(in) :: handle                       !< The handle.
    character(len=*), intent(in) :: name                    !< The caller's name for it.
    integer(riis_status) :: code                            !< RIIS_OK or RIIS_INVALID_ARGUMENT.
    code = RIIS_OK
    if (c_associated(handle)) code = refuse(name // ' was already created: destroy it first')
  end function check_not_created

  !> Refuses to copy a handle, because two variables with one handle would destroy it twice. The assignments call this procedure.
  subroutine refuse_copy(left, right, name)
    type(c_ptr), intent(in) :: left                         !< The handle that would be overwritten.
    type(c_ptr), intent(in) :: right                        !< The handle that would be copied.
    character(len=*), intent(in) :: name                    !< The name of the type.
    if (c_associated(right)) then
      error stop 'riis: a ' // name // ' cannot be copied: pass it as an argument, or point to it'
    else if (c_associated(left)) then
      error stop 'riis: a ' // name // ' cannot be overwritten: destroy it first'
    end if
  end subroutine refuse_copy

  !> Checks the length of the caller's array.
  function check_size(n, expected, name, of) result(code)
    integer(int64), intent(in) :: n                         !< The array's length.
    integer(int64), intent(in) :: expected                  !< The expected length.
    character(len=*), intent(in) :: name                    !< The argument's name.
    character(len=*), intent(in) :: of                      !< What is counted, such as 'points'.
    integer(riis_status) :: code                            !< RIIS_OK or RIIS_INVALID_ARGUMENT.
    code = RIIS_OK
    if (n /= expected) code = refuse('the size of ' // name // ' is ' // text_of(n) // '; there are ' // &
      text_of(expected) // ' ' // of)
  end function check_size

  !> Checks the shape of an array (rows, columns). The procedure does nothing after an error.
  subroutine check_columns(array, rows, columns, name, code)
    real(c_double), intent(in) :: array(:, :)               !< Any array.
    integer, intent(in) :: rows                             !< The expected first extent.
    integer(int64), intent(in) :: columns                   !< The expected second extent.
    character(len=*), intent(in) :: name                    !< The argument's name.
    integer(riis_status), intent(inout) :: code             !< Unchanged on success.
    if (code == RIIS_OK .and. (size(array, 1) /= rows .or. size(array, 2, int64) /= columns)) code = refuse('the shape of ' // &
      name // ' is (' // text_of(size(array, 1)) // ', ' // text_of(size(array, 2, int64)) // '); it must be (' // &
      text_of(rows) // ', ' // text_of(columns) // ')')
  end subroutine check_columns

  !> Sets an option of three reals, if the values are present. The procedure does nothing after an error.
  subroutine set_vector(values, name, option, code)
    real(c_double), intent(in), optional :: values(:)       !< (3).
    character(len=*), intent(in) :: name                    !< The argument's name.
    real(c_double), intent(inout) :: option(3)              !< Gets the values.
    integer(riis_status), intent(inout) :: code             !< Unchanged on success.
    if (code /= RIIS_OK .or. .not. present(values)) return
    if (size(values) == 3) then
      option = values
    else
      code = refuse('the size of ' // name // ' is ' // text_of(size(values)) // '; it must be 3')
    end if
  end subroutine set_vector

  !> Works like riis_c_string, but writes to the caller's memory, because gfortran would allocate a function's text in every call.
  subroutine end_for_c(text, c_text)
    character(len=*), intent(in) :: text                    !< Any text.
    character(len=*, kind=c_char), intent(out) :: c_text    !< Of the length len_trim(text) + 1.
    c_text = text
    c_text(len(c_text):) = c_null_char
  end subroutine end_for_c

  !> Fills the faces of a surface, except vertex_ids. The procedure does nothing after an error.
  subroutine get_faces(n_vertices, n_corners, n_faces, vertex_id_bits, leaflet_id, index_base, arrays, code)
    integer(int64), intent(in) :: n_vertices                !< The number of vertices.
    integer, intent(in) :: n_corners                        !< The first extent of vertex_ids.
    integer(int64), intent(in) :: n_faces                   !< Its second extent.
    integer, intent(in) :: vertex_id_bits                   !< 32 or 64.
    integer(int32), intent(in), contiguous, optional, target :: leaflet_id(:) !< (n_faces).
    class(*), intent(in), optional :: index_base            !< integer, 0 or 1. Default 1.
    type(riis_surface_arrays), intent(inout) :: arrays      !< Its vertices are set elsewhere and stay NULL here.
    integer(riis_status), intent(inout) :: code             !< Unchanged on success.
    if (code == RIIS_OK) code = riis_surface_arrays_init(arrays, c_sizeof(arrays))
    if (code /= RIIS_OK) return
    arrays%n_vertices = n_vertices
    arrays%n_faces = n_faces
    arrays%id_bits = vertex_id_bits
    arrays%corners_per_face = n_corners
    arrays%index_base = 1
    if (n_corners /= 3 .and. n_corners /= 4) &
      code = refuse('the first extent of vertex_ids is ' // text_of(n_corners) // '; it must be 3 or 4')
    if (code == RIIS_OK .and. n_vertices == 0) code = fail(RIIS_INVALID_SURFACE, 'there are no vertices')
    if (code == RIIS_OK .and. n_faces == 0) code = fail(RIIS_INVALID_SURFACE, 'there are no faces')
    call get_integer(index_base, 'index_base', arrays%index_base, code)
    if (code /= RIIS_OK .or. .not. present(leaflet_id)) return
    code = check_size(size(leaflet_id, kind=int64), n_faces, 'leaflet_id', 'faces')
    if (size(leaflet_id, kind=int64) > 0) arrays%leaflet_id = c_loc(leaflet_id)
  end subroutine get_faces

  !> Sets the skirt of a surface. The number of vertices must already be set. The procedure does nothing after an error.
  subroutine set_skirt(skirt_length, attached, skirt_lengths, arrays, code)
    real(c_double), intent(in), optional :: skirt_length    !< Default 0.
    integer(int8), intent(in), contiguous, optional, target :: attached(:) !< (n_vertices).
    real(c_double), intent(in), contiguous, optional, target :: skirt_lengths(:) !< (n_vertices).
    type(riis_surface_arrays), intent(inout) :: arrays      !< Borrows the arrays.
    integer(riis_status), intent(inout) :: code             !< Unchanged on success.
    if (code /= RIIS_OK) return
    if (present(skirt_length)) arrays%skirt_length = skirt_length
    if (present(attached)) then
      code = check_size(size(attached, kind=int64), arrays%n_vertices, 'attached', 'vertices')
      if (size(attached) > 0) arrays%attached = c_loc(attached)
    end if
    if (present(skirt_lengths) .and. code == RIIS_OK) then
      code = check_size(size(skirt_lengths, kind=int64), arrays%n_vertices, 'skirt_lengths', 'vertices')
      if (size(skirt_lengths) > 0) arrays%skirt_lengths = c_loc(skirt_lengths)
    end if
  end subroutine set_skirt

  !> Implements get_mask.
  subroutine get_mask_logical(mask, bytes, code)
    logical, intent(in), optional :: mask(:)                !< Any mask.
    integer(int8), allocatable, intent(out) :: bytes(:)     !< 1 or 0. Not allocated if the mask is absent.
    integer(riis_status), intent(inout) :: code             !< Unchanged on success; after an earlier error nothing happens.
    integer :: stat
    if (code /= RIIS_OK .or. .not. present(mask)) return
    allocate (bytes(size(mask, kind=int64)), stat=stat)
    code = out_of_memory(stat)
    if (code == RIIS_OK) bytes = merge(1_int8, 0_int8, mask)
  end subroutine get_mask_logical

  !> Implements get_mask.
  subroutine get_mask_int32(mask, bytes, code)
    integer(int32), intent(in) :: mask(:)                   !< Any mask.
    integer(int8), allocatable, intent(out) :: bytes(:)     !< 1 or 0.
    integer(riis_status), intent(inout) :: code             !< Unchanged on success; after an earlier error nothing happens.
    integer :: stat
    if (code /= RIIS_OK) return
    allocate (bytes(size(mask, kind=int64)), stat=stat)
    code = out_of_memory(stat)
    if (code == RIIS_OK) bytes = merge(1_int8, 0_int8, mask /= 0)
  end subroutine get_mask_int32

  !> Turns a Fortran 77 handle into a C handle.
  function c_handle_of(handle) result(c_handle)
    integer(int64), intent(in) :: handle                    !< 0 for no object.
    type(c_ptr) :: c_handle                                 !< c_null_ptr for no object.
    c_handle = transfer(int(handle, c_intptr_t), c_handle)
  end function c_handle_of

  !> Turns a C handle into a Fortran 77 handle.
  function handle_of(c_handle) result(handle)
    type(c_ptr), intent(in) :: c_handle                     !< c_null_ptr for no object.
    integer(int64) :: handle                                !< 0 for no object.
    handle = int(transfer(c_handle, 0_c_intptr_t), int64)
  end function handle_of

  !> Returns the address of a Fortran 77 caller's array. (A TARGET attribute there would need an explicit interface.)
  function location_of(array) result(location)
    type(*), intent(in), target :: array(*)                 !< An array of any type.
    type(c_ptr) :: location                                 !< The address of the first entry.
    location = c_loc(array)
  end function location_of

  !> Returns an address as a number, for differences of addresses.
  function address_of(location) result(address)
    type(c_ptr), intent(in) :: location                     !< From c_loc.
    integer(c_intptr_t) :: address                          !< In bytes.
    address = transfer(location, address)
  end function address_of

  !> Converts a stride in bytes to a stride in reals, or refuses it if the library cannot use it.
  subroutine get_stride(n_bytes, name, stride, code)
    integer(c_intptr_t), intent(in) :: n_bytes              !< The distance from one entry to the next.
    character(len=*), intent(in) :: name                    !< The argument's name.
    integer(int64), intent(inout) :: stride                 !< In reals.
    integer(riis_status), intent(out) :: code               !< RIIS_OK or RIIS_INVALID_ARGUMENT.
    integer(c_intptr_t), parameter :: real_bytes = storage_size(0._c_double) / 8
    code = RIIS_OK
    if (n_bytes <= 0) then
      code = refuse(name // ' is a section with a stride of ' // text_of(int(n_bytes, int64)) // &
        ' bytes; it must not go backwards')
    else if (mod(n_bytes, real_bytes) /= 0) then
      code = refuse(name // ' is a section with a stride of ' // text_of(int(n_bytes, int64)) // &
        ' bytes; it must be a multiple of ' // text_of(int(real_bytes, int64)))
    else
      stride = n_bytes / real_bytes
    end if
  end subroutine get_stride

  !> Takes xyz(3, n). The argument may be a whole array or a section with a positive stride.
  subroutine points_of_matrix(xyz, name, points, code)
    real(c_double), intent(in), target :: xyz(:, :)         !< The coordinates, (3, n).
    character(len=*), intent(in) :: name                    !< The argument's name.
    type(strided_points), intent(out) :: points             !< The location of the points.
    integer(riis_status), intent(out) :: code               !< RIIS_OK or RIIS_INVALID_ARGUMENT.
    character(len=:), allocatable :: advice                 ! create would borrow the temporary array transpose(xyz)
    if (size(xyz, 1) /= 3) then
      advice = ''
      if (size(xyz, 2) == 3) advice = '; a mesh takes (n, 3) by create_copy(transpose(' // name // '))'
      code = refuse('the shape of ' // name // ' is (' // text_of(size(xyz, 1, int64)) // ', ' // &
        text_of(size(xyz, 2, int64)) // '); it must be (3, n)' // advice)
      return
    end if
    code = RIIS_OK
    points%n = size(xyz, 2, int64)
    if (points%n == 0) return
    points%x = c_loc(xyz(1, 1))
    points%y = c_loc(xyz(2, 1))
    points%z = c_loc(xyz(3, 1))
    if (points%n > 1) call get_stride(address_of(c_loc(xyz(1, 2))) - address_of(points%x), name, points%stride, code)
  end subroutine points_of_matrix

  !> Takes x(n), y(n) and z(n). The arguments may be whole arrays, or sections with one positive stride.
  subroutine points_of_vectors(x, y, z, points, code, prefix)
    real(c_double), intent(in), target :: x(:)              !< (n).
    real(c_double), intent(in), target :: y(:)              !< (n).
    real(c_double), intent(in), target :: z(:)              !< (n).
    type(strided_points), intent(out) :: points             !< The location of the points.
    integer(riis_status), intent(out) :: code               !< RIIS_OK or RIIS_INVALID_ARGUMENT.
    character(len=*), intent(in), optional :: prefix        !< 'v' if the arguments are vx, vy, vz. Default: x, y, z.
    integer(int64) :: y_stride, z_stride
    if (size(y, kind=int64) /= size(x, kind=int64) .or. size(z, kind=int64) /= size(x, kind=int64)) then
      code = refuse_unequal('sizes', size(x, kind=int64), size(y, kind=int64), size(z, kind=int64), prefix)
      return
    end if
    code = RIIS_OK
    points%n = size(x, kind=int64)
    if (points%n == 0) return
    points%x = c_loc(x(1))
    points%y = c_loc(y(1))
    points%z = c_loc(z(1))
    if (points%n == 1) return
    call get_stride(address_of(c_loc(x(2))) - address_of(points%x), prefixed('x', prefix), points%stride, code)
    y_stride = points%stride
    z_stride = points%stride
    if (code == RIIS_OK) &
      call get_stride(address_of(c_loc(y(2))) - address_of(points%y), prefixed('y', prefix), y_stride, code)
    if (code == RIIS_OK) &
      call get_stride(address_of(c_loc(z(2))) - address_of(points%z), prefixed('z', prefix), z_stride, code)
    if (code == RIIS_OK .and. (y_stride /= points%stride .or. z_stride /= points%stride)) &
      code = refuse_unequal('strides', points%stride, y_stride, z_stride, prefix)
  end subroutine points_of_vectors

  !> Describes the points of an array (3, n) for C, without a copy.
  function describe_points(n_points, xyz, points) result(code)
    integer(int64), intent(in) :: n_points                  !< C checks its range.
    real(c_double), intent(in), target :: xyz(3, *)         !< (3, n_points). It must live as long as `points` is used.
    type(riis_points), intent(inout) :: points              !< Written on success.
    integer(riis_status) :: code                            !< RIIS_OK or the error.
    code = riis_points_init(points, c_sizeof(points))
    if (code /= RIIS_OK) return
    points%n_points = n_points
    points%stride = 3
    if (n_points < 1) return
    points%x = c_loc(xyz(1, 1))
    points%y = c_loc(xyz(2, 1))
    points%z = c_loc(xyz(3, 1))
  end function describe_points

  ! Returns an argument's name with its prefix.
  function prefixed(name, prefix) result(whole)
    character(len=1), intent(in) :: name
    character(len=*), intent(in), optional :: prefix
    character(len=:), allocatable :: whole
    whole = name
    if (present(prefix)) whole = prefix // name
  end function prefixed

  ! Refuses three arguments because their sizes or strides differ.
  function refuse_unequal(what, x, y, z, prefix) result(code)
    character(len=*), intent(in) :: what
    integer(int64), intent(in) :: x, y, z
    character(len=*), intent(in), optional :: prefix
    integer(riis_status) :: code
    code = refuse('the ' // what // ' of ' // prefixed('x', prefix) // ', ' // prefixed('y', prefix) // ' and ' // &
      prefixed('z', prefix) // ' are ' // text_of(x) // ', ' // text_of(y) // ' and ' // text_of(z) // &
      '; they must be equal')
  end function refuse_unequal

  !> Implements get_integer for options that are int32_t in riis.h.
  subroutine get_int32(option, name, value, code)
    class(*), intent(in), optional :: option                !< integer(int32) or integer(int64).
    character(len=*), intent(in) :: name                    !< The argument's name.
    integer(int32), intent(inout) :: value                  !< Gets the option's value, if the option is present.
    integer(riis_status), intent(inout) :: code             !< Unchanged on success; an earlier error is kept.
    integer(int64) :: wide
    wide = value
    call get_int64(option, name, wide, code)
    if (code /= RIIS_OK) return
    if (wide > huge(value) .or. wide < -huge(value)) then
      code = refuse(name // ' is ' // text_of(wide) // '; it must fit in 32 bits')
    else
      value = int(wide, int32)
    end if
  end subroutine get_int32

  !> Implements get_integer for options that are int64_t in riis.h.
  subroutine get_int64(option, name, value, code)
    class(*), intent(in), optional :: option                !< integer(int32) or integer(int64).
    character(len=*), intent(in) :: name                    !< The argument's name.
    integer(int64), intent(inout) :: value                  !< Gets the option's value, if the option is present.
    integer(riis_status), intent(inout) :: code             !< Unchanged on success; an earlier error is kept.
    if (code /= RIIS_OK .or. .not. present(option)) return
    select type (option)
    type is (integer(int32))
      value = option
    type is (integer(int64))
      value = option
    class default
      code = refuse(name // ' is neither an integer(int32) nor an integer(int64)')
    end select
  end subroutine get_int64

  ! Returns the length of a number as text, with its sign.
  pure function n_letters(number) result(n)
    integer(int64), intent(in) :: number
    integer :: n
    integer(int64) :: rest
    n = merge(2, 1, number < 0)
    rest = number / 10
    do while (rest /= 0)
      n = n + 1
      rest = rest / 10
    end do
  end function n_letters

  !> Implements text_of.
  function text_of_int64(number) result(text)
    integer(int64), intent(in) :: number                    !< Any value.
    character(len=n_letters(number)) :: text                !< The number as text.
    integer(int64) :: rest
    integer :: i
    rest = number
    do i = len(text), 1, -1
      text(i:i) = achar(iachar('0') + int(abs(mod(rest, 10_int64))))
      rest = rest / 10
    end do
    if (number < 0) text(1:1) = '-'
  end function text_of_int64

  !> Implements text_of.
  function text_of_int32(number) result(text)
    integer(int32), intent(in) :: number                    !< Any value.
    character(len=n_letters(int(number, int64))) :: text    !< The number as text.
    text = text_of_int64(int(number, int64))
  end function text_of_int32

end module riis_support
