! SPDX-License-Identifier: Apache-2.0
! Written by fortran/bindings/generate.py from riis.h and from the files in that folder; run ./run bindings to repeat it.
!> riis for Fortran: heart valves as resistive immersed implicit surfaces. Types with procedures offer all of riis.h. Callers need
!! neither iso_c_binding nor TARGET.
!!
!!     use riis
!!     type(riis_valve) :: valve
!!     type(riis_surface) :: surface
!!     type(riis_mesh) :: mesh
!!     type(riis_marks) :: result
!!     integer, allocatable :: node_num(:)
!!     real(8), allocatable :: distance(:)
!!
!!     call valve%create('coapting')
!!     call surface%create(valve, scale=0.01d0)          ! a mesh in metres: half thickness 0.001 m, tolerance 5 % of it
!!     call mesh%create(xyz)                             ! real(8) :: xyz(3, n_nodes), borrowed
!!     call riis_mark_nodes(surface, mesh, result)       ! once a time step
!!     call result%marked_nodes(node_num, distance)      ! xyz(:, node_num(i)) is distance(i) away
!!     call result%destroy(); call mesh%destroy(); call surface%destroy(); call valve%destroy()
!!
!! Rules for every procedure:
!!
!! - Errors. Each procedure has the argument `integer(riis_status), intent(out), optional :: status`. It gets RIIS_OK or an error,
!!   and riis_error_message() gives the message of the error. Without `status`, an error stops the program, with the error's name
!!   and message on the error unit. After a
!!   positive error nothing has changed. After a negative error, an object that the call would have written can only be
!!   destroyed. Each thread has its own message. Messages name the C arguments and count from 0.
!! - Objects. Each is empty until it is created, and must be destroyed: the end of a scope does not destroy it. An
!!   intent(out) argument loses its object. Creating an object twice is an error, and so is the use of an empty object.
!!   Destroying an empty object is allowed. Objects cannot be copied: a = b stops the program unless both are empty. Pass them as
!!   arguments or point to them; functions cannot return them. Array constructors and allocate(..., source=...) copy objects
!!   without an error. If a type has an object in an allocatable component, such as type(riis_valve), allocatable :: v, gfortran
!!   also copies the object when it assigns a variable of this type. Avoid all of these, and do not enlarge an array of objects
!!   by assignment.
!! - Integers. Ids, counts, numbers of threads and bases may be integer(int32), the default kind, or integer(int64). Optional
!!   integers are declared class(*), since a generic procedure cannot distinguish them; other types are refused. If a call has
!!   several counts that are not optional (n_nodes and stride; ni, nj, nk), they must be of one kind. Integers that the
!!   library writes have the same kind as in C: triangle_id integer(int64), leaflet_id, patch_id and side integer(int32).
!! - Counting. Anything called *_id counts from 0, as in C, including triangle_id and leaflet_id (RIIS_LEAFLET_*). Anything called
!!   node_num counts from 1. Ids that the caller gives count from index_base, by default 1.
!! - Reals are real(c_double), real(8) with most compilers. Lengths have one unit of the caller's choice, and angles are in
!!   degrees.
!! - Arrays are whole or sections. Coordinates are read in place, with any positive stride. The coordinates of a mesh and
!!   the rows of an adjacency are borrowed beyond the call: riis_mesh describes how, and which arguments to avoid. Other arrays
!!   are used during the call only. The call copies sections that are not contiguous, and arrays for which the procedure's
!!   comment says so. If an argument is declared CONTIGUOUS and a pointer is not, gfortran also copies the pointer's target.
!! - Threads. Any number of threads may read an object (intent(in)) at once. One thread may write it while no other reads it.
!!   Different objects never interfere. Results are bitwise the same for any number of threads. In an OpenMP region, declare
!!   a thread's own objects in a procedure that it calls or in a BLOCK: gfortran leaves copies by PRIVATE undefined.
!! - Compiler options. With options that change the default kinds (-fdefault-integer-8), logical arguments need the kind that
!!   this module was compiled with; leaflet_id, side and marks stay integer(int32). Compile these sources without gfortran's
!!   -fno-automatic: it puts local variables into static memory that all threads share, and error messages get lost.
module riis
  use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int32_t, c_int64_t, c_null_funptr, c_null_ptr, c_ptr, &
    c_f_procpointer
  use, intrinsic :: iso_fortran_env, only: int32
  ! The modules below publish what callers use. A constant of riis.h needs no line here.
  use riis_warping
  use riis_valves
  use riis_frames
  use riis_surfaces
  use riis_adjacencies
  use riis_meshes
  use riis_marking
  use riis_leaking
  use riis_crossing
  use riis_passages
  use riis_measures
  use riis_placing
  use riis_loading
  use riis_laws
  use riis_c, only: riis_status, riis_surface_info, riis_closest, riis_mark_stats, riis_c_text, &
    riis_c_text_length, riis_last_error, riis_band_sums, riis_passage, riis_leaflet, riis_orifice, riis_coaptation, riis_gap, &
    riis_first_passage, riis_area_range, riis_cells_across, riis_warp_info, riis_placement, &
    c_set_log => riis_set_log, c_status_name => riis_status_name, c_version_string => riis_version_string, &
    RIIS_OK, RIIS_INVALID_ARGUMENT, RIIS_INVALID_STRUCT_SIZE, RIIS_INVALID_PARAMETER, RIIS_INVALID_SURFACE, &
    RIIS_INVALID_MESH, RIIS_LIMIT_EXCEEDED, RIIS_OUT_OF_MEMORY, RIIS_FILE_ERROR, RIIS_UNAVAILABLE, &
    RIIS_INTERNAL_ERROR, RIIS_LOG_INFO, RIIS_LOG_WARNING, RIIS_LEAFLET_RIGHT, RIIS_LEAFLET_LEFT, &
    RIIS_LEAFLET_NON_CORONARY, RIIS_LEAFLET_ANTERIOR, RIIS_LEAFLET_POSTERIOR, RIIS_LEAFLET_POSITIVE, &
    RIIS_LEAFLET_NEGATIVE, RIIS_LEAFLET_HOUSING, RIIS_LEAFLET_SKIRT, RIIS_MEASURE_TRIANGLES, RIIS_MEASURE_SAMPLING, &
    RIIS_MEASURE_MINIMIZATION, RIIS_TRIANGULATION_ADAPTED, RIIS_TRIANGULATION_FIXED, RIIS_INTERPOLATION_LINEAR, &
    RIIS_INTERPOLATION_CUBIC, RIIS_SEARCH_AUTO, RIIS_SEARCH_EXHAUSTIVE, RIIS_SEARCH_NEIGHBOR, RIIS_SEARCH_PAPER, &
    RIIS_SEARCH_CLUSTERS, RIIS_INSTRUCTIONS_AUTO, RIIS_INSTRUCTIONS_BASELINE, RIIS_INSTRUCTIONS_AVX2, &
    RIIS_INSTRUCTIONS_AVX512, RIIS_FIELD_POINT, RIIS_FIELD_NORMAL, RIIS_FIELD_BARYCENTRIC, RIIS_FIELD_SIDE, &
    RIIS_FIELD_RIM, RIIS_FIELD_UV, RIIS_FIELD_VELOCITY, RIIS_FIELD_PATCH, RIIS_FIELD_GRADIENT, RIIS_RIM_ROUND, &
    RIIS_RIM_CUT, RIIS_LIST_MARKED, RIIS_LIST_WITHIN_LIMIT, RIIS_PASSAGE_CLOSED, RIIS_PASSAGE_OPEN, RIIS_PASSAGE_NONE, &
    RIIS_OUTLINE_NONE, RIIS_OUTLINE_DISC, RIIS_OUTLINE_ATTACHMENT, RIIS_OUTLINE_BOUNDARY, RIIS_OUTLINE_WALL, &
    RIIS_AREA_GEOMETRIC, RIIS_AREA_EFFECTIVE, RIIS_ALL_LEAFLETS, RIIS_FIRST_PASSAGE_FOUND, RIIS_FIRST_PASSAGE_ALWAYS, &
    RIIS_FIRST_PASSAGE_NEVER, RIIS_FIRST_PASSAGE_NONE, RIIS_LANDMARK_COMMISSURE, RIIS_LANDMARK_NADIR, &
    RIIS_LANDMARK_COAPTATION, RIIS_LANDMARK_ANNULUS, RIIS_LANDMARK_ANTERIOR_HORN, RIIS_LANDMARK_POSTERIOR_HORN, &
    RIIS_LANDMARK_TRIGONE, RIIS_LANDMARK_POSTEROMEDIAL, RIIS_LANDMARK_ANTEROLATERAL, RIIS_LANDMARK_HINGE, &
    RIIS_LANDMARK_ATTACHMENT, RIIS_SIZE_KEPT, RIIS_SIZE_DETERMINED, RIIS_SIZE_TIED, RIIS_SIZE_UNDETERMINED, &
    RIIS_PHASE_CLOSING, RIIS_PHASE_OPENING, RIIS_AUTO, RIIS_FAR_DISTANCE
  implicit none
  private :: c_funloc, c_funptr, c_int32_t, c_int64_t, c_null_funptr, c_null_ptr, c_ptr, c_f_procpointer, int32, riis_c_text, &
    riis_c_text_length, riis_last_error, c_set_log, c_status_name, c_version_string, error_length, name_length, &
    version_length, status_name, version_string, set_log, pass_message

  integer, parameter :: riis_id = c_int64_t         !< The kind of node, triangle and vertex ids. It is for codes in
                                                            !! Fortran 2003, which has no int64.

  !> Returns the name of a status.
  interface riis_status_name
    module procedure status_name
  end interface riis_status_name

  !> Returns the version of the linked library, as text.
  interface riis_version_string
    module procedure version_string
  end interface riis_version_string

  !> Sets the procedure that receives the library's messages.
  interface riis_set_log
    module procedure set_log
  end interface riis_set_log

  abstract interface
    !> Receives the library's messages, on any thread that calls the library. The procedure must not call the library.
    subroutine riis_log_procedure(message, level)
      import :: int32
      implicit none
      character(len=*), intent(in) :: message               !< One line.
      integer(int32), intent(in) :: level                   !< RIIS_LOG_INFO or RIIS_LOG_WARNING.
    end subroutine riis_log_procedure
  end interface

contains

  ! The length of a function's result may come from a pure function, which may call only pure functions. The interface therefore
  ! declares the C function pure.
  pure function error_length() result(length)
    integer :: length
    interface
      pure function last_error() result(text) bind(c, name='riis_last_error')
        import :: c_ptr
        implicit none
        type(c_ptr) :: text
      end function last_error
    end interface
    length = riis_c_text_length(last_error())
  end function error_length

  pure function name_length(status) result(length)
    integer(riis_status), intent(in) :: status
    integer :: length
    interface
      pure function status_name_of(status) result(text) bind(c, name='riis_status_name')
        import :: c_ptr, riis_status
        implicit none
        integer(riis_status), value :: status
        type(c_ptr) :: text
      end function status_name_of
    end interface
    length = riis_c_text_length(status_name_of(status))
  end function name_length

  pure function version_length() result(length)
    integer :: length
    interface
      pure function version_text() result(text) bind(c, name='riis_version_string')
        import :: c_ptr
        implicit none
        type(c_ptr) :: text
      end function version_text
    end interface
    length = riis_c_text_length(version_text())
  end function version_length

  !> Returns the message of the calling thread's last error, which names the argument and its value. Returns '' if there was no
  !! error. A call that succeeds does not change the message.
  function riis_error_message() result(text)
    character(len=error_length()) :: text                   !< A copy.
    text = riis_c_text(riis_last_error())
  end function riis_error_message

  !> Returns the status's own name, such as 'RIIS_INVALID_ARGUMENT', or 'unknown status'.
  function status_name(status) result(name)
    integer(riis_status), intent(in) :: status              !< Any value.
    character(len=name_length(status)) :: name              !< A copy.
    name = riis_c_text(c_status_name(status))
  end function status_name

  !> Gives the version of the linked library, such as '1.0.0'.
  function version_string() result(text)
    character(len=version_length()) :: text                 !< A copy.
    text = riis_c_text(c_version_string())
  end function version_string

  !> Sets the procedure that receives the messages of the whole process. Without an argument no messages are sent, which is the
  !! default. Any thread may call it. A message that another thread is sending may still reach the previous procedure.
  subroutine set_log(procedure)
    procedure(riis_log_procedure), optional :: procedure    !< Called until another one is set. It must be a module or external
                                                            !! procedure, not an internal one of a procedure that returns.
    type(c_funptr) :: location
    if (present(procedure)) then
      location = c_funloc(procedure)
      ! The Fortran procedure is passed as user data, because the library stores function and user data together under a lock.
      call c_set_log(c_funloc(pass_message), transfer(location, c_null_ptr))
    else
      call c_set_log(c_null_funptr, c_null_ptr)
    end if
  end subroutine set_log

  ! The log function that the library calls. The function turns the message into a Fortran string. Its C name is empty, so that it
  ! cannot collide with a procedure of the caller's program.
  subroutine pass_message(user_data, level, message) bind(c, name='')
    type(c_ptr), value :: user_data
    integer(c_int32_t), value :: level
    type(c_ptr), value :: message
    procedure(riis_log_procedure), pointer :: log
    call c_f_procpointer(transfer(user_data, c_null_funptr), log)
    call log(riis_c_text(message), level)
  end subroutine pass_message
end module riis
