! SPDX-License-Identifier: Apache-2.0
! A valve in CaNS. patch.py inserts calls into CaNS's main program: riis_valve_setup once, riis_valve_apply in each substep after
! the predictor, riis_valve_report after each time step. The file riis.nml describes the valve (README.md, "riis.nml"). Edit
! make_valve and move_valve for your own valve.
!
! Each velocity component has a separate mesh: the faces at which CaNS stores the component. A mesh consists of three axes,
! without a list of nodes. A node's number is the place in the array u(0:n(1)+1, 0:n(2)+1, 0:n(3)+1), so the lists of marked faces
! index u, v and w.
module mod_riis_valve
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: error_unit, int64, real64
  use mpi
  use mod_types, only: rp, MPI_REAL_RP
  use mod_common_mpi, only: myid
  use mod_param, only: l, dl, bcpre, bforce, is_bound, is_forced, is_poisson_dtdma
  use mod_riis_pressure
  use riis
  implicit none
  private
  public :: riis_valve_setup, riis_valve_apply, riis_valve_report
  public :: riis_valve_start, riis_valve_mark, riis_valve_lists, surface ! for the tests

  ! riis.nml. Lengths are in the unit of CaNS. R is divided by the density, because the density in CaNS is 1.
  character(len=16) :: kind = 'plate'        ! plate, none, or a kind of riis such as trileaflet
  real(real64) :: R = 0, half_thickness = 0
  real(real64) :: place(3) = 0               ! of the valve's origin
  real(real64) :: axis(3) = [0, 1, 0], angle = 90 ! the rotation; by default the valve's axis z becomes x
  real(real64) :: skirt_length = 0           ! closes the gap between the valve and the walls
  real(real64) :: opens_at = 1e30_real64, opens_in = 0.04_real64 ! seconds
  real(real64) :: planes(2) = 0              ! x where the report takes mean pressures; 0: the first and the last cell
  namelist /valve/ kind, R, half_thickness, place, axis, angle, skirt_length, opens_at, opens_in, planes
  namelist /pressure/ jump, sweeps, cg, extrapolation

  type(riis_valve) :: now, before
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh(3)
  type(riis_marks) :: marks(3)
  logical :: moves = .false., is_marked = .false.
  real(rp) :: opening = 0, marked_at = -huge(1._rp)
  real(rp) :: seconds(3) = 0                 ! processor time: riis, the pressure, at the end of the last step
  integer :: n(3), lo(3), report_unit = -1

contains

  ! Makes the valve and the meshes. CaNS's grid and its Poisson solver are ready.
  subroutine riis_valve_setup(n_cells, lower, zc, zf, dzc, dzf, dzci, dzfi, plans, norm, lambda, a, b, c)
    integer, intent(in) :: n_cells(3), lower(3) ! of this rank
    real(rp), intent(in) :: zc(0:), zf(0:), dzc(0:), dzf(0:), dzci(0:), dzfi(0:), norm, lambda(:, :), a(:), b(:), c(:)
    type(c_ptr), intent(in) :: plans(2, 2)
    if (any(is_forced)) call stop_run('is_forced keeps the mean velocity, so it must be F; drive the flow by bforce or bcvel')
    if (any(abs(bcpre) > 0)) call stop_run('bcpre must be 0; drive the flow by bforce or bcvel')
    if (is_poisson_dtdma) call stop_run('is_poisson_dtdma = T is not supported')
    call riis_valve_start(n_cells, lower, zc, zf)
    call riis_pressure_setup(n, dzc, dzf, dzci, dzfi, plans, norm, lambda, a, b, c)
    if (myid == 0) then
      open (newunit=report_unit, file='valve.csv', action='write', status='replace')
      write (report_unit, '(a)') 'step,time,opening,drop,flow,faces,seconds_riis,seconds_pressure,seconds'
    end if
  end subroutine riis_valve_setup

  ! Reads riis.nml, and makes the surface and the three meshes.
  subroutine riis_valve_start(n_cells, lower, zc, zf)
    integer, intent(in) :: n_cells(3), lower(3)
    real(rp), intent(in) :: zc(0:), zf(0:)
    integer(int64) :: first(3), stride(3)
    integer :: unit, status, c, lowest(3), highest(3)
    character(len=200) :: message
    n = n_cells
    lo = lower
    open (newunit=unit, file='riis.nml', action='read', status='old', iostat=status, iomsg=message)
    if (status == 0) read (unit, nml=valve, iostat=status, iomsg=message)
    if (status == 0) read (unit, nml=pressure, iostat=status, iomsg=message)
    if (status /= 0) call stop_run('riis.nml: ' // trim(message))
    close (unit)
    if (kind == 'none') return
    if (sweeps < 1) call stop_run('riis.nml: sweeps must be at least 1')
    call make_valve

    ! u(i, j, k) is on the upper face of its cell in x, and in the middle of the cell in y and z. A face in the lower halo is
    ! marked if another rank owns it. A face on a boundary of the domain is left out, because CaNS sets its velocity.
    stride = [1, n(1) + 2, (n(1) + 2) * (n(2) + 2)]
    do c = 1, 3
      lowest = 1
      highest = n
      if (.not. is_bound(0, c)) lowest(c) = 0
      if (is_bound(1, c)) highest(c) = n(c) - 1
      first = 1 + sum(lowest * stride)
      call mesh(c)%create_grid(axis_of(1), axis_of(2), axis_of(3), first=first(1), stride=stride, &
        n_nodes=product(int(n + 2, int64)))
    end do
  contains
    ! The coordinates of a component's faces along a direction.
    function axis_of(d) result(x)
      integer, intent(in) :: d
      real(real64), allocatable :: x(:)
      integer :: i
      if (d < 3) then
        x = [((lo(d) - 1 + i - merge(0._real64, 0.5_real64, c == d)) * real(dl(d), real64), i=lowest(d), highest(d))]
      else
        x = real(merge(zf(lowest(3):highest(3)), zc(lowest(3):highest(3)), c == 3), real64)
      end if
    end function axis_of
  end subroutine riis_valve_start

  ! Makes the surface, which is closed at the beginning. A plate extends beyond the walls.
  subroutine make_valve
    real(real64) :: corners(3, 4), size_of
    if (kind == 'plate') then
      size_of = 2 * maxval(l)
      corners = reshape(size_of * [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], [3, 4])
      call surface%create_from_arrays(corners, reshape([1, 2, 3, 4], [4, 1]), half_thickness=half_thickness, rotation_axis=axis, &
        rotation_angle=angle, translation=place)
      return
    end if
    call now%create(trim(kind))
    call now%set('opening', 0._real64)
    if (skirt_length > 0) call now%set('skirt_length', skirt_length)
    call now%copy(before)
    call surface%create(now, half_thickness=half_thickness, rotation_axis=axis, rotation_angle=angle, translation=place)
    moves = opens_at < 1e30_real64
  end subroutine make_valve

  ! Moves the surface to its state at the end of a time step. The velocity of the surface comes from the state of the previous
  ! step.
  subroutine move_valve(time, dt)
    real(rp), intent(in) :: time, dt
    call before%set('opening', opening_at(real(time - dt, real64)))
    opening = real(opening_at(real(time, real64)), rp)
    call now%set('opening', opening_at(real(time, real64)))
    call surface%update_moving(now, before, real(dt, real64))
  end subroutine move_valve

  function opening_at(time) result(opening)
    real(real64), intent(in) :: time
    real(real64) :: opening
    call riis_opening_from_times(riis_opening_times(opening_start=opens_at, opening_duration=opens_in, &
      closing_start=1e6_real64, closing_duration=opens_in), time, opening)
  end function opening_at

  ! Marks the faces near the valve.
  subroutine riis_valve_mark(time, dt)
    real(rp), intent(in) :: time, dt
    integer :: c
    if (moves) call move_valve(time, dt)
    do c = 1, 3
      call riis_mark_nodes(surface, mesh(c), marks(c), R=R, fields=RIIS_FIELD_NORMAL + merge(RIIS_FIELD_VELOCITY, 0, moves))
    end do
    marked_at = time
    is_marked = .true.
  end subroutine riis_valve_mark

  ! Lets `lists` point to the lists of marked faces: numbers from 0, distances, K, normals, and K u_surface if the valve moves.
  subroutine riis_valve_lists(lists)
    type(riis_mark_list), intent(inout) :: lists(3)
    integer :: c
    do c = 1, 3
      call marks(c)%get_list(RIIS_LIST_MARKED, lists(c))
    end do
  end subroutine riis_valve_lists

  ! Adds the valve to the predicted velocity, and improves the pressure. time is the end of the time step, and dt_substep the
  ! length of the substep. pp is CaNS's work array.
  subroutine riis_valve_apply(time, dt, dt_substep, u, v, w, p, pp)
    real(rp), intent(in) :: time, dt, dt_substep
    real(rp), intent(inout), contiguous, dimension(0:, 0:, 0:) :: u, v, w, p, pp
    type(riis_mark_list) :: lists(3)
    real(real64) :: start, marked, improved
    if (kind == 'none') return
    call cpu_time(start)
    if (time > marked_at .and. (moves .or. .not. is_marked)) then
      call riis_valve_mark(time, dt)
      call riis_valve_lists(lists)
      call cpu_time(marked)
      call riis_pressure_valve_moved(lists)
      seconds(1) = seconds(1) + real(marked - start, rp)
      start = marked
    end if
    call riis_pressure_damp(dt_substep, u, v, w)
    call riis_pressure_improve(dt_substep, u, v, w, p, pp)
    call cpu_time(improved)
    seconds(2) = seconds(2) + real(improved - start, rp)
  end subroutine riis_valve_apply

  ! Writes a line of valve.csv. The line has the drop of the mean pressure between the two planes, which contains the pressure of
  ! the body force, the mean velocity, and the number of marked faces. The line also has this rank's processor time in riis, in
  ! the pressure and in total.
  subroutine riis_valve_report(step, time, u, p)
    integer, intent(in) :: step
    real(rp), intent(in) :: time
    real(rp), intent(in), dimension(0:, 0:, 0:) :: u, p
    real(rp) :: sums(6), distance
    real(real64) :: now_is
    integer :: cell(2)
    integer :: plane, i, error
    sums = 0
    cell = int(planes / dl(1)) + 1
    if (maxval(planes) <= 0) cell = [1, nint(l(1) / dl(1))]
    distance = (cell(2) - cell(1)) * dl(1)
    do plane = 1, 2
      i = cell(plane) - lo(1) + 1
      if (i >= 1 .and. i <= n(1)) sums(2 * plane - 1:2 * plane) = [sum(p(i, 1:n(2), 1:n(3))), real(n(2) * n(3), rp)]
    end do
    if (lo(1) == 1) sums(5) = sum(u(1, 1:n(2), 1:n(3)))
    if (kind /= 'none') sums(6) = real(marks(1)%n_marked() + marks(2)%n_marked() + marks(3)%n_marked(), rp)
    call MPI_ALLREDUCE(MPI_IN_PLACE, sums, 6, MPI_REAL_RP, MPI_SUM, MPI_COMM_WORLD, error)
    call cpu_time(now_is)
    if (myid == 0) then
      write (report_unit, '(i0, 4(",", es16.9), ",", i0, 3(",", es11.4))') step, time, opening, &
        sums(1) / sums(2) - sums(3) / sums(4) + bforce(1) * distance, sums(5) / sums(2), nint(sums(6), int64), seconds(1:2), &
        now_is - seconds(3)
      flush (report_unit)
    end if
    seconds = [0._rp, 0._rp, real(now_is, rp)]
  end subroutine riis_valve_report

  subroutine stop_run(text)
    character(len=*), intent(in) :: text
    integer :: error
    if (myid == 0) write (error_unit, '(2a)') 'riis: ', text
    call MPI_ABORT(MPI_COMM_WORLD, 1, error)
  end subroutine stop_run
end module mod_riis_valve
