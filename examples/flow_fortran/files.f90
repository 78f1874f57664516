! SPDX-License-Identifier: Apache-2.0
!> Reads the words of the command line, and writes the files of a run: a table with a row for each step, slices for the movie, and
!! restart files.
module flow_files
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32
  use riis, only: riis_triangles, riis_parameter_info, riis_opening_switch_state
  use flow_solver, only: dp, flow
  use flow_valve, only: leaflets, check
  use flow_circulation, only: circulation
  use flow_stop, only: refuse, step_number, step_time
  implicit none
  private
  public :: option_words, open_table, write_frame, write_restart, read_restart

  character(len=*), parameter :: magic = 'riis flow_fortran 1 '

contains

  !> Returns the words of the command line as a namelist with the name `options`. Reading it refuses unknown names and bad values.
  function option_words() result(words)
    character(len=2000) :: words
    character(len=400) :: word
    integer :: i
    words = '&options'
    do i = 1, command_argument_count()
      call get_command_argument(i, word)
      words = trim(words) // ' ' // word
    end do
    words = trim(words) // ' /'
  end function option_words

  !> Opens the table of steps. After a restart, new rows are appended to the old table.
  subroutine open_table(name, unit)
    character(len=*), intent(in) :: name
    integer, intent(out) :: unit
    character(len=200) :: message
    integer :: stat
    open (newunit=unit, file=name, position='append', action='write', iostat=stat, iomsg=message, &
      status=merge('replace', 'unknown', step_number == 0))
    if (stat /= 0) call refuse(trim(message))
    inquire (unit=unit, size=stat)
    if (stat == 0) write (unit, '(a)') 'step,time_s,dt_s,opening,p_ventricle_Pa,p_upstream_Pa,p_downstream_Pa,' // &
      'flow_m3_per_s,jet_m_per_s,force_x_N,force_y_N,force_z_N,divergence_per_s,unbalanced_m3_per_s,source_m3_per_s,' // &
      'iterations,marked'
  end subroutine open_table

  !> Writes a frame of the movie: velocity and pressure in the cells beside x = 0, velocity in the layer at z = height, and the
  !! leaflets' triangles. Walls are NaN.
  subroutine write_frame(name, fluid, valve, height)
    type(riis_triangles) :: all_triangles
    character(len=*), intent(in) :: name
    type(flow), intent(in) :: fluid
    type(leaflets), intent(in) :: valve
    real(dp), intent(in) :: height
    real(dp), pointer :: xyz(:, :)
    integer(int64), pointer :: corner(:, :)
    integer :: unit, layer
    open (newunit=unit, file=name, access='stream', form='unformatted', status='replace', action='write')
    layer = product(fluid%n(1:2)) * floor((height - fluid%corner(3)) / fluid%h)
    write (unit) int(fluid%n, int32), real([fluid%h, fluid%corner, height, step_time, valve%opening], real32)
    call write_slice(unit, fluid, fluid%cell(fluid%n(1) / 2 + 1::fluid%n(1)), .true.)
    call write_slice(unit, fluid, fluid%cell(layer + 1:layer + product(fluid%n(1:2))), .false.)
    call valve%surface%get_triangles(all_triangles)
    xyz => all_triangles%xyz
    call valve%surface%get_triangles(all_triangles)
    corner => all_triangles%vertex_id
    write (unit) size(corner, 2), real(xyz(:, reshape(corner, [size(corner)]) + 1), real32)
    close (unit)
  end subroutine write_frame

  subroutine write_slice(unit, fluid, m, with_pressure)
    integer, intent(in) :: unit, m(:)
    type(flow), intent(in) :: fluid
    logical, intent(in) :: with_pressure
    real(real32) :: values(size(m), 4)
    integer :: c
    do c = 1, 3
      values(:, c) = real((fluid%v(m, c) + fluid%v(m + fluid%stride(c), c)) / 2, real32)
    end do
    values(:, 4) = real(fluid%p(m), real32)
    do c = 1, merge(4, 3, with_pressure)
      where (fluid%solid(m)) values(:, c) = transfer(int(z'7FC00000', int32), 1._real32)
      write (unit) values(:, c)
    end do
  end subroutine write_slice

  ! Writes the settings that a restart must not change: the grid, and the valve with parameters and placement. Each line of the
  ! result has a name and a value.
  subroutine get_identity(fluid, valve, lines)
    type(flow), intent(in) :: fluid
    type(leaflets), intent(in) :: valve
    character(len=160), allocatable, intent(out) :: lines(:)
    type(riis_parameter_info) :: info
    real(dp), allocatable :: values(:)
    integer :: i
    allocate (lines(7 + valve%valve%n_parameters()))
    write (lines(1), '(a, 3i6)') 'cells', fluid%n
    write (lines(2), '(2a)') 'valve ', trim(valve%kind)
    write (lines(3), '(a, es24.16)') 'resistance', valve%R
    write (lines(4), '(a, es24.16)') 'half_thickness', valve%eps
    write (lines(5), '(a, 3es24.16)') 'place', valve%place
    write (lines(6), '(a, es24.16)') 'offset', valve%offset
    write (lines(7), '(a, i6)') 'rim', valve%rim
    do i = 1, size(lines) - 7
      call valve%valve%parameter(i, info)
      values = info%default_values
      call valve%valve%get(info%name, values)
      if (info%name == 'opening') values = 0      ! the opening belongs to the state, not to the settings
      write (lines(7 + i), '(a, 3es24.16)') info%name, values
    end do
  end subroutine get_identity

  !> Writes the state that the next step needs, in full precision.
  subroutine write_restart(name, fluid, valve, heart, law)
    character(len=*), intent(in) :: name
    type(flow), intent(in) :: fluid
    type(leaflets), intent(in) :: valve
    type(circulation), intent(in) :: heart
    type(riis_opening_switch_state), intent(in) :: law
    character(len=160), allocatable :: lines(:)
    integer :: unit
    call get_identity(fluid, valve, lines)
    open (newunit=unit, file=name, access='stream', form='unformatted', status='replace', action='write')
    write (unit) magic, size(lines), lines, step_number, step_time, heart, law, fluid%v, fluid%p
    close (unit)
  end subroutine write_restart

  !> Reads a restart file. Refuses a file whose settings differ from this run, and names the first difference.
  subroutine read_restart(name, fluid, valve, heart, law)
    character(len=*), intent(in) :: name
    type(flow), intent(inout) :: fluid
    type(leaflets), intent(in) :: valve
    type(circulation), intent(inout) :: heart
    type(riis_opening_switch_state), intent(inout) :: law
    character(len=160), allocatable :: here(:), there(:)
    character(len=len(magic)) :: first
    character(len=200) :: message
    integer :: unit, i, n, stat
    open (newunit=unit, file=name, access='stream', form='unformatted', status='old', action='read', iostat=stat, iomsg=message)
    if (stat /= 0) call refuse(trim(message))
    read (unit, iostat=stat) first, n
    if (stat /= 0 .or. first /= magic) call refuse(name // ' is no restart file of this program')
    call get_identity(fluid, valve, here)
    allocate (there(n))
    read (unit, iostat=stat) there
    do i = 1, min(n, size(here))                  ! the first difference counts, because later lines depend on the kind in line 2
      if (here(i) /= there(i)) call refuse('the restart file ' // name // ' is of another run: it has "' // trim(there(i)) // &
        '", here it is "' // trim(here(i)) // '"')
    end do
    read (unit, iostat=stat) step_number, step_time, heart, law, fluid%v, fluid%p
    if (stat /= 0) call refuse('the restart file ' // name // ' ends too early')
    close (unit)
  end subroutine read_restart
end module flow_files
