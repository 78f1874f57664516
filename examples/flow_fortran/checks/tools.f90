! SPDX-License-Identifier: Apache-2.0
!> Provides procedures for several checks of the flow solver: verdicts, ducts with a plate, the aortic valve in its root, and
!! moving valves.
module check_tools
  use riis
  use flow_solver, only: dp, flow
  use flow_valve, only: leaflets, check
  use flow_root, only: in_root
  implicit none
  private
  public :: demand, make_duct, put_plate, start_root, finish_root, ramp, anywhere, motion, move_valve, place_vessel, in_vessel
  logical, public :: all_right = .true.
  real(dp), parameter, public :: openings(8) = [0.05_dp, 0.1_dp, 0.15_dp, 0.2_dp, 0.25_dp, 0.5_dp, 0.75_dp, 1._dp]
  integer, parameter, public :: touching = 5      ! the index of the opening until which the bands of the cusps touch
  ! The kind and the placement of the vessel, set by place_vessel.
  character(len=32) :: vessel = 'trileaflet'
  real(dp) :: vessel_place(3) = 0, to_valve(3, 3) = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])

  !> The results of a moving valve. A force has a part along the valve's axis and a part across it.
  type :: motion
    real(dp) :: across = 0, along = 0             ! [N] largest parts of the force
    real(dp) :: along_late = 0                    ! [N] largest force along the axis in the second half of the time
    real(dp) :: across_mean = 0, along_mean = 0   ! [N] largest means of these parts over a millisecond
    real(dp) :: side(3) = 0                       ! [N] largest magnitude of each component of the force
    real(dp) :: into = 0, out = 0, source = 0     ! [m^3] volumes: inflow, outflow, and net source
    real(dp) :: swept = 0                         ! [m^3] volume that the leaflets sweep
    real(dp) :: displaced(2, size(openings)) = 0  ! [m^3] mean of inflow and outflow, and swept volume, up to each opening
    real(dp) :: divergence = 0                    ! [1/s] largest |divergence - source|
    real(dp) :: net = 0, gross = 0                ! [m^3/s] largest sum of the sources, and of their magnitudes
    real(dp) :: p_least = 0, p_most = 0           ! [Pa] smallest and largest pressure
    real(dp), allocatable :: force(:, :)          ! [N] (3, steps), the force in each step
    integer :: steps = 0
  end type motion

contains

  !> Prints whether a condition holds. If it does not, the program later ends with status 1.
  subroutine demand(condition, text)
    logical, intent(in) :: condition
    character(len=*), intent(in) :: text
    all_right = all_right .and. condition
    print '(4a)', '  ', merge('holds: ', 'FAILS: ', condition), text
    print '(a)', ''
  end subroutine demand

  !> Sets the vessel of in_vessel. A vessel has the name of a kind of valve as its kind, and the valve's placement.
  subroutine place_vessel(kind, place, axis, angle)
    character(len=*), intent(in) :: kind
    real(dp), intent(in) :: place(3), axis(3), angle
    real(dp) :: turned(3)
    integer :: c
    vessel = kind
    vessel_place = place
    do c = 1, 3
      turned = 0
      turned(c) = 1
      to_valve(:, c) = turn(turned, axis, -angle)
    end do
  end subroutine place_vessel

  !> Tells whether a point is inside the vessel: the aortic root, a round tube, or an oval tube. The valve seals the vessel, or
  !! nearly does.
  pure logical function in_vessel(x)
    real(dp), intent(in) :: x(3)
    real(dp) :: y(3)
    y = matmul(to_valve, x - vessel_place)
    select case (vessel)
    case ('bileaflet')
      in_vessel = norm2(y(1:2)) < 0.011_dp
    case ('mitral')
      in_vessel = norm2(y(1:2) / [0.020_dp, 0.015_dp]) < 1
    case default
      in_vessel = in_root(y)
    end select
  end function in_vessel

  ! Turns x about an axis, by Rodrigues' formula.
  pure function turn(x, axis, degrees) result(turned)
    real(dp), intent(in) :: x(3), axis(3), degrees
    real(dp) :: turned(3), e(3), angle
    e = axis / norm2(axis)
    angle = degrees * acos(-1._dp) / 180
    turned = cos(angle) * x + sin(angle) * [e(2) * x(3) - e(3) * x(2), e(3) * x(1) - e(1) * x(3), e(1) * x(2) - e(2) * x(1)] + &
      (1 - cos(angle)) * dot_product(e, x) * e
  end function turn

  pure logical function anywhere(x)
    real(dp), intent(in) :: x(3)
    anywhere = all(x > -huge(x))
  end function anywhere

  !> Makes a duct of n cells of side h. The lower corner of the duct is at 0.
  subroutine make_duct(fluid, n, h, imposed)
    type(flow), intent(inout) :: fluid
    integer, intent(in) :: n(3)
    real(dp), intent(in) :: h
    logical, intent(in) :: imposed
    fluid%imposed_inlet = imposed
    call fluid%start(n, h, [0._dp, 0._dp, 0._dp], anywhere)
  end subroutine make_duct

  !> Puts a flat plate across a duct, and computes K and K u_surface with riis. The plate crosses the duct's axis at height z, and
  !! moves up with the speed w. With a slope along x it moves along its normal. The plate may also slide along x.
  subroutine put_plate(fluid, z, R, eps, w, slope, slide)
    type(flow), intent(inout) :: fluid
    real(dp), intent(in) :: z, R, eps, w
    real(dp), intent(in), optional :: slope, slide
    type(riis_surface) :: surface
    type(riis_mesh) :: faces
    type(riis_marks) :: marks
    real(dp) :: corners(3, 4), velocity(3, 4), side, middle
    side = fluid%h * maxval(fluid%n)
    middle = fluid%h * fluid%n(1) / 2
    corners = reshape([-side, -side, z, 2 * side, -side, z, 2 * side, 2 * side, z, -side, 2 * side, z], [3, 4])
    velocity = 0
    velocity(3, :) = w
    if (present(slope)) then
      corners(3, :) = z + slope * (corners(1, :) - middle)
      velocity(1, :) = -w * slope / (1 + slope**2)
      velocity(3, :) = w / (1 + slope**2)
    end if
    if (present(slide)) velocity(1, :) = velocity(1, :) + slide
    call surface%create_from_arrays(corners, reshape([1, 2, 3, 4], [4, 1]), half_thickness=eps, velocity=velocity)
    call faces%create(fluid%xyz)
    call riis_mark_nodes(surface, faces, marks, fields=RIIS_FIELD_VELOCITY)
    fluid%K = 0
    fluid%K_u = 0
    call marks%add_resistance(R, fluid%K, fluid%K_u)
    call marks%destroy()
    call faces%destroy()
    call surface%destroy()
  end subroutine put_plate

  !> Rises smoothly from 0 at x = 0 to 1 at x = 1.
  pure real(dp) function ramp(x)
    real(dp), intent(in) :: x
    ramp = max(0._dp, x)**3 * (10 + x * (6 * x - 15))
  end function ramp

  !> Makes the aortic valve in its root. The box is `cells` cells wide, and the half thickness is `cells_of_eps` cells.
  subroutine start_root(fluid, valve, cells, cells_of_eps, R, opening)
    type(flow), intent(inout), target :: fluid
    type(leaflets), intent(inout) :: valve
    integer, intent(in) :: cells
    real(dp), intent(in) :: cells_of_eps, R, opening
    integer(riis_status) :: status
    call fluid%start([cells, cells, 6 * cells / 5], 0.033_dp / cells, [-0.0165_dp, -0.0165_dp, -0.018_dp], in_root)
    valve%eps = cells_of_eps * fluid%h
    valve%R = R
    call valve%valve%create(valve%kind, status)
    call check(status)
    call valve%start(fluid, opening)
  end subroutine start_root

  subroutine finish_root(fluid, valve)
    type(flow), intent(inout) :: fluid
    type(leaflets), intent(inout) :: valve
    call fluid%equation%finish()
    call valve%finish()
    deallocate (valve%marked)
  end subroutine finish_root

  !> Moves a valve from its opening to another opening within a given time. The pressures at both ends are equal. A time step is
  !! at most `longest`.
  subroutine move_valve(fluid, valve, to, duration, longest, seen)
    type(flow), intent(inout) :: fluid
    type(leaflets), intent(inout) :: valve
    real(dp), intent(in) :: to, duration, longest
    type(motion), intent(out) :: seen
    type(riis_valve) :: shape_valve
    type(riis_surface) :: shape
    real(dp), allocatable :: vertices(:, :), before(:, :)
    integer, allocatable :: corners(:, :)
    real(dp) :: from, opening, time, dt, axis(3), force(3), along, impulse(3), span
    integer :: i
    from = valve%opening
    axis = turn([0._dp, 0._dp, 1._dp], valve%turn_axis, valve%turn)
    call valve%valve%copy(shape_valve)
    call shape%create(shape_valve, half_thickness=valve%eps, scale=0.01_dp, rotation_axis=valve%turn_axis, &
      rotation_angle=valve%turn, translation=valve%place, triangulation=RIIS_TRIANGULATION_FIXED)
    call get_triangles(shape, before, corners)
    allocate (seen%force(3, 0))
    time = 0
    impulse = 0
    span = 0
    do while (time < duration * (1 - 1e-9_dp))
      dt = min(fluid%time_step(longest), duration - time)
      time = time + dt
      opening = from + (to - from) * ramp(time / duration)
      call valve%move(opening, dt, fluid)
      call fluid%step(dt, 0._dp, 0._dp)
      force = valve%force(fluid)
      along = dot_product(force, axis)
      seen%steps = seen%steps + 1
      seen%force = reshape([seen%force, force], [3, seen%steps])
      seen%side = max(seen%side, abs(force))
      seen%across = max(seen%across, norm2(force - along * axis))
      seen%along = max(seen%along, abs(along))
      impulse = impulse + dt * force
      span = span + dt
      if (span > 0.999e-3_dp) then
        along = dot_product(impulse, axis) / span
        seen%along_mean = max(seen%along_mean, abs(along))
        seen%across_mean = max(seen%across_mean, norm2(impulse / span - along * axis))
        impulse = 0
        span = 0
      end if
      if (time > duration / 2) seen%along_late = max(seen%along_late, abs(along))
      seen%into = seen%into + dt * fluid%flow_in()
      seen%out = seen%out + dt * fluid%flow_out()
      seen%source = seen%source + dt * fluid%net_source_rate()
      seen%divergence = max(seen%divergence, fluid%divergence())
      seen%net = max(seen%net, abs(fluid%net_source_rate()))
      seen%gross = max(seen%gross, fluid%h**3 * sum(abs(fluid%S(fluid%cell))))
      seen%p_least = min(seen%p_least, minval(fluid%p(fluid%cell)))
      seen%p_most = max(seen%p_most, maxval(fluid%p(fluid%cell)))
      call shape_valve%set('opening', opening)
      call shape%update(shape_valve)
      call get_triangles(shape, vertices, corners)
      seen%swept = seen%swept + swept_between(before, vertices, corners)
      before = vertices
      do i = 1, size(openings)
        if (opening <= openings(i) + 1e-9_dp) seen%displaced(:, i) = [(seen%into + seen%out) / 2, seen%swept]
      end do
    end do
    call shape%destroy()
    call shape_valve%destroy()
  end subroutine move_valve

  ! Copies the vertices of a surface, and the vertex numbers of its triangles, which count from 1.
  subroutine get_triangles(surface, vertices, corners)
    type(riis_surface), intent(in) :: surface
    real(dp), allocatable, intent(out) :: vertices(:, :)
    integer, allocatable, intent(out) :: corners(:, :)
    type(riis_triangles) :: triangles
    call surface%get_triangles(triangles)
    vertices = triangles%xyz
    call surface%get_triangles(triangles)
    corners = int(triangles%vertex_id) + 1
  end subroutine get_triangles

  ! Returns the volume that triangles sweep while their vertices move along straight lines. Simpson's rule is exact here.
  pure real(dp) function swept_between(first, last, corners)
    real(dp), intent(in) :: first(:, :), last(:, :)
    integer, intent(in) :: corners(:, :)
    real(dp), parameter :: weight(0:2) = [1, 4, 1] / 6._dp
    real(dp) :: x(3, 3), a(3), b(3)
    integer :: i, k
    swept_between = 0
    do i = 1, size(corners, 2)
      do k = 0, 2
        x = first(:, corners(:, i)) + k / 2._dp * (last(:, corners(:, i)) - first(:, corners(:, i)))
        a = x(:, 2) - x(:, 1)
        b = x(:, 3) - x(:, 1)
        swept_between = swept_between + weight(k) * dot_product(sum(last(:, corners(:, i)) - first(:, corners(:, i)), 2) / 3, &
          [a(2) * b(3) - a(3) * b(2), a(3) * b(1) - a(1) * b(3), a(1) * b(2) - a(2) * b(1)]) / 2
      end do
    end do
  end function swept_between
end module check_tools
