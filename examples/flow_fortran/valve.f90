! SPDX-License-Identifier: Apache-2.0
!> Connects the valve with the flow. All calls of riis are in this file. A solver calls `move` in every time step.
module flow_valve
  use riis
  use flow_solver, only: dp, flow
  use flow_stop, only: clocks, refuse
  implicit none
  private
  public :: leaflets, check

  type :: leaflets
    character(len=32) :: kind = 'trileaflet'
    real(dp) :: R = 1e4_dp                        ! [kg/(m s)] resistance
    real(dp) :: eps = 0                           ! [m] half thickness
    real(dp) :: offset = 0                        ! [half thicknesses] by which the band steps aside along the normals
    integer :: rim = RIIS_RIM_ROUND               ! RIIS_RIM_CUT cuts the band off where the leaflets end
    real(dp) :: place(3) = 0                      ! [m] position of the valve's origin
    real(dp) :: turn_axis(3) = [0, 0, 1], turn = 0 ! [degrees] by which the valve is turned about an axis through its origin
    logical :: moves_flow = .true.                ! .false. leaves K u_surface out, for the checks
    real(dp) :: opening = 0
    real(dp) :: seconds(2) = 0                    ! wall time and processor time in the library
    integer :: markings = 0
    logical, private :: at_rest = .false.
    integer, allocatable :: marked(:)
    type(riis_valve) :: valve, before
    type(riis_surface) :: surface
    type(riis_mesh) :: faces
    type(riis_marks) :: marks
  contains
    procedure :: start, move, force, finish
  end type leaflets

contains

  !> Makes the valve's surface at an opening. The valve is in centimetres and the flow is in metres, so the surface is scaled. The
  !! library borrows the array of the flow's faces, so the array must not move in memory.
  subroutine start(this, fluid, opening)
    class(leaflets), intent(inout) :: this
    type(flow), intent(in) :: fluid
    real(dp), intent(in) :: opening
    integer(riis_status) :: status
    real(dp) :: begin(2)
    begin = clocks()
    this%opening = opening
    call this%valve%set('opening', opening, status)
    if (status == RIIS_OK) call this%valve%copy(this%before, status)
    if (status == RIIS_OK) call this%surface%create(this%valve, half_thickness=this%eps, scale=0.01_dp, &
      rotation_axis=this%turn_axis, rotation_angle=this%turn, translation=this%place, &
      offset=this%offset, n_threads=1, status=status) ! more threads gain nothing, because triangles and nodes are few
    if (status == RIIS_OK) call this%faces%create(fluid%xyz, status)
    if (status == RIIS_OK) call this%faces%prepare(n_threads=1, status=status)
    call check(status)
    allocate (this%marked(0))
    this%seconds = clocks() - begin
    this%markings = 0
    this%at_rest = .false.
  end subroutine start

  !> Moves the valve to an opening within dt, and computes K and K u_surface on every face of the flow.
  subroutine move(this, opening, dt, fluid)
    class(leaflets), intent(inout) :: this
    real(dp), intent(in) :: opening, dt
    type(flow), intent(inout) :: fluid
    integer(riis_status) :: status
    real(dp) :: begin(2)
    if (this%at_rest .and. .not. abs(opening - this%opening) > 0) return ! K does not change
    this%at_rest = .not. abs(opening - this%opening) > 0

    begin = clocks()
    fluid%K(this%marked) = 0
    fluid%K_u(:, this%marked) = 0
    call this%valve%set('opening', opening, status)
    if (status == RIIS_OK) call this%surface%update_moving(this%valve, this%before, dt, status=status)
    if (status == RIIS_OK) call this%before%set('opening', opening, status)
    if (status == RIIS_OK) call riis_mark_nodes(this%surface, this%faces, this%marks, &
      fields=RIIS_FIELD_VELOCITY + RIIS_FIELD_RIM, n_threads=1, status=status)
    if (status == RIIS_OK) call this%marks%add_resistance(this%R, fluid%K, fluid%K_u, rim=this%rim, status=status)
    if (status == RIIS_OK) call this%marks%marked_nodes(this%marked, status=status)
    call check(status)
    this%seconds = this%seconds + clocks() - begin

    call check_inside(this, fluid)
    if (.not. this%moves_flow) fluid%K_u(:, this%marked) = 0
    this%opening = opening
    this%markings = this%markings + 1
  end subroutine move

  !> Returns the force of the flow on the valve [N]: the sum of K (u - u_surface) over the volumes of the faces.
  function force(this, fluid) result(newton)
    class(leaflets), intent(in) :: this
    type(flow), intent(in) :: fluid
    real(dp) :: newton(3)
    integer :: c, f, i
    newton = 0
    do i = 1, size(this%marked)
      f = this%marked(i)
      c = fluid%face(2, f)
      newton(c) = newton(c) + fluid%h**3 * (fluid%K(f) * fluid%v(fluid%face(1, f), c) - fluid%K_u(c, f))
    end do
  end function force

  ! Stops if the valve is outside the box, where it would resist no flow. The library does not know the box.
  subroutine check_inside(this, fluid)
    class(leaflets), intent(in) :: this
    type(flow), intent(in) :: fluid
    type(riis_surface_info) :: info
    character(len=200) :: text
    integer(riis_status) :: status
    call this%surface%get_info(info, status)
    call check(status)
    if (all(info%lower >= fluid%corner) .and. all(info%upper <= fluid%corner + fluid%h * fluid%n)) return
    write (text, '(2(a, 3f9.5), 2(a, 3f9.5), a)') 'the valve leaves the box: it goes from', info%lower, ' to', info%upper, &
      ' m, the box from', fluid%corner, ' to', fluid%corner + fluid%h * fluid%n, ' m'
    call refuse(trim(text))
  end subroutine check_inside

  !> Stops with the library's message if a call failed.
  subroutine check(status)
    integer(riis_status), intent(in) :: status
    if (status /= RIIS_OK) call refuse(riis_status_name(status) // ': ' // riis_error_message())
  end subroutine check

  !> Frees the library's memory.
  subroutine finish(this)
    class(leaflets), intent(inout) :: this
    call this%marks%destroy()
    call this%faces%destroy()
    call this%surface%destroy()
    call this%before%destroy()
    call this%valve%destroy()
  end subroutine finish
end module flow_valve
