! SPDX-License-Identifier: Apache-2.0
! Puts a heart valve into code_saturne 6.0, by a momentum source, in Fortran. The momentum equation gets the source -K (u -
! u_surface). -K is its implicit part, and K u_surface its explicit part. The pressure equation of code_saturne does not take this
! source into account. The pressure drop therefore builds up over several time steps, and stays too small. The head losses in ../c
! avoid this delay.
module valve_in_root
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int64_t, c_null_char, c_ptr
  use riis
  implicit none
  private
  public :: advance_valve, write_checkpoint, record_step, coefficient, momentum, present_valve

  ! The objects of riis are made in the first time step.
  type(riis_valve), save :: valve, valve_before
  type(riis_surface), save :: surface
  type(riis_mesh), save :: cells
  type(riis_marks), save :: marks
  type(riis_opening_switch), save :: law
  type(riis_opening_switch_state), save :: state ! state%opening is the opening of the last time step
  double precision, allocatable, save :: coefficient(:) ! (n_cells), K in kg/(m3 s)
  double precision, allocatable, save :: momentum(:, :) ! (3, n_cells), K u_surface in N/m3
  double precision, save :: mesh_lower(3), mesh_upper(3)
  integer, save :: last_step = -1

  interface
    function setting(name) bind(c) result(value)
      import :: c_char, c_double
      character(kind=c_char), intent(in) :: name(*)
      real(c_double) :: value
    end function setting
    subroutine record_valve(n_marked, cell_id, coefficient, opening, seconds) bind(c)
      import :: c_double, c_int64_t
      integer(c_int64_t), value :: n_marked
      integer(c_int64_t), intent(in) :: cell_id(*)
      real(c_double), intent(in) :: coefficient(*)
      real(c_double), value :: opening, seconds
    end subroutine record_valve
    subroutine record_step() bind(c)
    end subroutine record_step
    function record_clock() bind(c) result(seconds)
      import :: c_double
      real(c_double) :: seconds
    end function record_clock
  end interface

contains

  ! Stops the run with a message and the time step.
  subroutine stop_run(message)
    use entsor, only: nfecra
    use optcal, only: ntcabs
    character(len=*), intent(in) :: message
    write (nfecra, '(a, i0, 2a)') 'riis: time step ', ntcabs, ': ', message
    write (*, '(a, i0, 2a)') 'riis: time step ', ntcabs, ': ', message
    call csexit(1)
  end subroutine stop_run

  ! Stops the run with the library's message.
  subroutine check(status)
    integer(riis_status), intent(in) :: status
    if (status /= RIIS_OK) call stop_run(riis_status_name(status)//': '//riis_error_message())
  end subroutine check

  logical function present_valve()
    present_valve = setting('VALVE_PRESENT'//c_null_char) > 0
  end function present_valve

  ! ---- The checkpoint: the state of the law, and the parameters of its valve. ----

  ! Gives all values of the valve's parameters, one after the other. "opening" is left out.
  subroutine get_parameters(values)
    double precision, allocatable, intent(out) :: values(:)
    type(riis_parameter_info) :: parameter
    double precision :: scalar, vector(3)
    integer :: i
    integer(riis_status) :: status
    allocate (values(0))
    do i = 1, int(valve%n_parameters())
      call valve%parameter(i, parameter, status=status)
      call check(status)
      if (parameter%name == 'opening') cycle
      if (size(parameter%default_values) == 3) then
        call valve%get(parameter%name, vector, status=status)
        values = [values, vector]
      else
        call valve%get(parameter%name, scalar, status=status)
        values = [values, scalar]
      end if
      call check(status)
    end do
  end subroutine get_parameters

  subroutine write_checkpoint()
    use cs_c_bindings
    double precision, allocatable :: parameters(:)
    type(c_ptr) :: file
    if (.not. valve%is_created()) return
    call get_parameters(parameters)
    call restart_create('riis', '', 1, file)
    call restart_write_section_real_t(file, 'parameters', 0, size(parameters), parameters)
    call restart_write_section_real_t(file, 'law', 0, 8, [state%time, state%opening, state%rate, state%progress, &
      state%pressure_difference, state%flow, state%turn_time, dble(state%phase)])
    call restart_destroy(file)
  end subroutine write_checkpoint

  subroutine read_checkpoint()
    use cs_c_bindings
    double precision, allocatable :: parameters(:), stored(:)
    double precision :: values(8)
    type(c_ptr) :: file
    integer :: error
    call get_parameters(parameters)
    allocate (stored(size(parameters)))
    call restart_create('riis', '', 0, file)
    call restart_read_section_real_t(file, 'parameters', 0, size(stored), stored, error)
    if (error /= 0) call stop_run('the checkpoint is of another kind of valve, or of none')
    if (any(abs(stored - parameters) > 0)) call stop_run('the checkpoint is of another valve')
    call restart_read_section_real_t(file, 'law', 0, 8, values, error)
    if (error /= 0) call stop_run('the checkpoint has no state of the valve''s law')
    call restart_destroy(file)
    state = riis_opening_switch_state(values(1), values(2), values(3), values(4), values(5), values(6), values(7), &
      nint(values(8)))
  end subroutine read_checkpoint

  ! ---- The valve. ----

  subroutine create_valve()
    use mesh
    use parall
    use optcal, only: isuite
    character(len=32) :: kind
    integer(riis_status) :: status
    integer :: length, k
    law = riis_opening_switch(opening_duration=0.04d0, closing_duration=0.04d0, filter_time=0.002d0, dwell_time=0.02d0)
    if (setting('VALVE_OPENING'//c_null_char) >= 0) state%opening = setting('VALVE_OPENING'//c_null_char)
    call get_environment_variable('VALVE_KIND', kind, length)
    if (length == 0) kind = 'trileaflet'
    call valve%create(kind, status=status)
    call check(status)
    if (isuite == 1) call read_checkpoint()
    call valve%set('opening', state%opening, status=status)
    call check(status)
    call valve%copy(valve_before, status=status)
    call check(status)
    ! The valve is in centimetres, the mesh in metres. Each processor runs one rank, so one thread is enough.
    call surface%create(valve, half_thickness=setting('VALVE_HALF_THICKNESS'//c_null_char), scale=0.01d0, &
      translation=[0d0, 0d0, setting('VALVE_Z'//c_null_char)], n_threads=1, status=status)
    call check(status)
    ! A rank without cells makes the same calls.
    call cells%create(xyzcen(:, 1:ncel), status=status)
    call check(status)
    call cells%prepare(n_threads=1, status=status)
    call check(status)
    allocate (coefficient(ncel), momentum(3, ncel))
    coefficient = 0
    momentum = 0
    do k = 1, 3
      mesh_lower(k) = minval(xyznod(k, :))
      mesh_upper(k) = maxval(xyznod(k, :))
      if (irangp >= 0) call parmin(mesh_lower(k))
      if (irangp >= 0) call parmax(mesh_upper(k))
    end do
  end subroutine create_valve

  ! Advances the law by the pressures and the flow of the last time step, as means over slabs of the tubes.
  subroutine advance_law()
    use mesh
    use numvar
    use parall
    use field
    use optcal, only: dtref, ntcabs
    double precision, pointer :: pressure(:), velocity(:, :)
    ! Upstream slab: volume, integrals of pressure and velocity; downstream slab: volume, integral of pressure.
    double precision :: sums(5)
    integer(riis_status) :: status
    integer :: c
    call field_get_val_s(ivarfl(ipr), pressure)
    call field_get_val_v(ivarfl(iu), velocity)
    sums = 0
    do c = 1, ncel
      if (xyzcen(3, c) > -0.022d0 .and. xyzcen(3, c) < -0.018d0) then
        sums(1:3) = sums(1:3) + volume(c) * [1d0, pressure(c), velocity(3, c)]
      else if (xyzcen(3, c) > 0.01d0 .and. xyzcen(3, c) < 0.014d0) then
        sums(4:5) = sums(4:5) + volume(c) * [1d0, pressure(c)]
      end if
    end do
    if (irangp >= 0) call parrsm(5, sums)
    ! The upstream slab is 4 mm long. The time is not ttcabs, because after a restart code_saturne's own sum of its time steps
    ! differs in its last bits.
    call riis_opening_advance(law, state, ntcabs * dtref, sums(2) / sums(1) - sums(5) / sums(4), sums(3) / 0.004d0, status=status)
    call check(status)
  end subroutine advance_law

  ! Refuses a valve that has left the mesh. No cells would then be marked, and the flow would pass as if there were no valve. The
  ! attachment of an open valve is up to a half thickness outside the wall.
  subroutine check_place()
    type(riis_surface_info) :: info
    character(len=120) :: message
    integer(riis_status) :: status
    integer :: k
    call surface%get_info(info, status=status)
    call check(status)
    do k = 1, 3
      if (info%lower(k) >= mesh_lower(k) - info%half_thickness .and. &
        info%upper(k) <= mesh_upper(k) + info%half_thickness) cycle
      write (message, '(a, 4(a, es11.4))') 'the valve leaves the mesh: its '//'xyz'(k:k), ' is from ', info%lower(k), ' to ', &
        info%upper(k), ' m, the mesh''s from ', mesh_lower(k), ' to ', mesh_upper(k)
      call stop_run(trim(message)//' m')
    end do
  end subroutine check_place

  ! Computes K and K u_surface of this time step. The solver may request the source term several times in a step.
  subroutine advance_valve()
    use mesh
    use optcal, only: dtref, ntcabs
    integer(c_int64_t), pointer :: cell(:)
    double precision, pointer :: distance(:)
    double precision :: start
    integer(riis_status) :: status
    integer :: i
    if (ntcabs == last_step) return
    last_step = ntcabs
    start = record_clock()
    if (.not. valve%is_created()) call create_valve()
    if (setting('VALVE_OPENING'//c_null_char) < 0) call advance_law()
    call valve%set('opening', state%opening, status=status)
    call check(status)
    call surface%update_moving(valve, valve_before, dtref, status=status)
    call check(status)
    call valve_before%set('opening', state%opening, status=status)
    call check(status)
    call check_place()
    if (marks%is_created()) then ! the cells that were marked in the last time step
      call marks%marked(cell, distance)
      do i = 1, size(cell)
        coefficient(cell(i) + 1) = 0
        momentum(:, cell(i) + 1) = 0
      end do
    end if
    call riis_mark_nodes(surface, cells, marks, n_threads=1, fields=RIIS_FIELD_VELOCITY, status=status)
    call check(status)
    if (setting('VALVE_VELOCITY'//c_null_char) > 0) then
      call marks%add_resistance(setting('VALVE_RESISTANCE'//c_null_char), coefficient, momentum, status=status)
    else
      call marks%add_resistance(setting('VALVE_RESISTANCE'//c_null_char), coefficient, status=status)
    end if
    call check(status)
    call marks%marked(cell, distance)
    call record_valve(int(size(cell), c_int64_t), cell, coefficient, state%opening, record_clock() - start)
  end subroutine advance_valve
end module valve_in_root

! ---- The hooks of code_saturne. ----

! Gives the momentum source: crvimp in kg/s, negative; crvexp in N. Called for the velocity.
subroutine ustsnv(nvar, nscal, ncepdp, ncesmp, ivar, icepdc, icetsm, itypsm, dt, ckupdc, smacel, crvexp, crvimp)
  use paramx
  use numvar
  use mesh
  use valve_in_root
  implicit none
  integer :: nvar, nscal, ncepdp, ncesmp, ivar
  integer :: icepdc(ncepdp), icetsm(ncesmp), itypsm(ncesmp, nvar)
  double precision :: dt(ncelet), ckupdc(6, ncepdp), smacel(ncesmp, nvar)
  double precision :: crvexp(3, ncelet), crvimp(3, 3, ncelet)
  integer :: c, k
  if (ivar /= iu .or. .not. present_valve()) return
  call advance_valve()
  do c = 1, ncel
    if (.not. coefficient(c) > 0) cycle
    do k = 1, 3
      crvimp(k, k, c) = crvimp(k, k, c) - coefficient(c) * volume(c)
      crvexp(k, c) = crvexp(k, c) + momentum(k, c) * volume(c)
    end do
  end do
end subroutine ustsnv

! Called at the end of each time step, before code_saturne writes its checkpoint.
subroutine cs_f_user_extra_operations(nvar, nscal, dt)
  use mesh
  use valve_in_root
  implicit none
  integer :: nvar, nscal, due
  double precision :: dt(ncelet)
  call reqsui(due) ! due is 1 if code_saturne writes a checkpoint in this time step
  if (due == 1) call write_checkpoint()
  call record_step()
end subroutine cs_f_user_extra_operations
