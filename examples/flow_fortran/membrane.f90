! SPDX-License-Identifier: Apache-2.0
!> A small demonstration: one cusp of a half-open valve is a membrane of springs, which the flow moves. The other two cusps stay
!> where they are.
!! The springs, the mass and the friction are not those of tissue, and nothing stops a cusp from going through another cusp. The
!! program shows the calls that a shell code needs: a force at each vertex, and vertices that move with velocities.
program membrane
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis
  use flow_solver, only: dp, flow
  use flow_valve, only: check
  use flow_root, only: in_root
  use flow_stop, only: refuse, step_number, step_time
  implicit none
  integer, parameter :: cells = 24, substeps = 10
  real(dp), parameter :: width = 0.033_dp, length = 0.0396_dp, bottom = -0.018_dp ! [m] the box around the root
  real(dp), parameter :: R = 1e4_dp, opening = 0.4_dp, turn = 0.03_dp, end_time = 0.06_dp, mmHg = 133.322_dp
  real(dp), parameter :: stiffness = 60         ! [N/m] of each spring
  real(dp), parameter :: mass = 0.01_dp         ! [kg] of the cusp. A real cusp has a twentieth of it. The coupling is explicit,
                                                ! so the mass must exceed that of the blood that the cusp takes along.
  real(dp), parameter :: damping = 50           ! [1/s] friction over mass
  type(flow), target :: fluid
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: faces
  type(riis_marks) :: marks
  integer(int64), allocatable :: corners(:, :)  ! (3, n_triangles), vertices from 1
  integer(int32), allocatable :: leaflet(:)     ! (n_triangles)
  integer, allocatable :: marked(:), twin(:), springs(:, :)
  logical, allocatable :: in_cusp(:), moves(:)  ! (n_vertices)
  real(dp), allocatable :: x(:, :), start(:, :), u(:, :), v(:, :), force(:, :), at_rest(:)
  real(dp) :: dt, of_leaflets(3, 3)
  integer(riis_status) :: status

  fluid%tolerance = 1e-6_dp
  call fluid%start([cells, cells, nint(cells * length / width)], width / cells, [-width / 2, -width / 2, bottom], in_root)
  call take_shape(1.5_dp * fluid%h)
  call faces%create(fluid%xyz, status)
  call check(status)
  allocate (marked(0))
  print '(3(a, i0))', 'springs: ', size(springs, 2), ', vertices that move: ', count(moves), ', cells: ', product(fluid%n)
  print '(a)', '  time, ms  flow, ml/s  force along x and z, mN  at the vertices, mN  largest way, mm'
  do while (step_time < end_time)
    dt = fluid%time_step(2.5e-4_dp)
    step_number = step_number + 1
    step_time = step_time + dt
    fluid%K(marked) = 0
    fluid%K_u(:, marked) = 0
    call surface%update_from_arrays(x, corners, leaflet, velocity=u, status=status)
    if (status == RIIS_OK) call riis_mark_nodes(surface, faces, marks, fields=RIIS_FIELD_VELOCITY + RIIS_FIELD_BARYCENTRIC, &
      status=status)
    if (status == RIIS_OK) call marks%add_resistance(R, fluid%K, fluid%K_u, status=status)
    if (status == RIIS_OK) call marks%marked_nodes(marked, status=status)
    call check(status)
    call fluid%step(dt, merge(6 * mmHg, 0._dp, step_time < turn), merge(0._dp, 6 * mmHg, step_time < turn))
    call take_forces()
    if (mod(step_number, 20) == 0) print '(f10.2, f12.1, f15.3, f11.3, f12.3, f9.3, f15.2)', 1e3_dp * step_time, &
      1e6_dp * fluid%flow_through(), 1e3_dp * of_leaflets([1, 3], 1), 1e3_dp * sum(force(1, :), mask=in_cusp), &
      1e3_dp * sum(force(3, :), mask=in_cusp), 1e3_dp * maxval(norm2(x - start, dim=1))
    call move_cusp()
  end do
  call marks%destroy()
  call faces%destroy()
  call surface%destroy()

contains

  ! Takes the triangles of a valve. Vertices of a leaflet that coincide are twins, and only the first twin moves. The attachment
  ! and the other cusps do not move. Each side of a triangle of the cusp is a spring, at rest in this shape.
  subroutine take_shape(eps)
    real(dp), intent(in) :: eps
    type(riis_triangles) :: t
    type(riis_attachment) :: held
    integer :: i, k, n
    integer, allocatable :: of(:)
    call valve%create('trileaflet', status)
    if (status == RIIS_OK) call valve%set('opening', opening, status)
    if (status == RIIS_OK) call surface%create(valve, half_thickness=eps, scale=0.01_dp, status=status)
    if (status == RIIS_OK) call surface%get_triangles(t, status)
    if (status == RIIS_OK) call surface%get_attachment(held, status)
    call check(status)
    x = t%xyz
    corners = t%vertex_id + 1
    leaflet = t%leaflet_id
    n = size(x, 2)
    allocate (of(n), twin(n), u(3, n), v(3, n), force(3, n))
    u = 0
    v = 0
    of = -1                                       ! some vertices belong to no triangle
    do k = 1, 3
      of(corners(k, :)) = leaflet
    end do
    do i = 1, n
      do k = 1, i
        if (of(k) == of(i) .and. all(abs(x(:, k) - x(:, i)) < 1e-9_dp)) exit
      end do
      twin(i) = k
    end do
    in_cusp = of == RIIS_LEAFLET_RIGHT
    moves = in_cusp .and. twin == [(i, i = 1, n)]
    do k = 1, 2
      moves(twin(held%vertex_id(k, :) + 1)) = .false.
    end do
    springs = reshape([((twin(corners([k, mod(k, 3) + 1], i)), k = 1, 3), i = 1, size(leaflet))], [2, 3 * size(leaflet)])
    springs = springs(:, pack([(i, i = 1, size(springs, 2))], in_cusp(springs(1, :)) .and. springs(1, :) /= springs(2, :)))
    start = x
    at_rest = [(norm2(x(:, springs(2, i)) - x(:, springs(1, i))), i = 1, size(springs, 2))]
    call valve%destroy()
    call surface%destroy()
    call surface%create_from_arrays(x, corners, leaflet, half_thickness=eps, velocity=u, status=status)
    call check(status)
  end subroutine take_shape

  ! Takes the force of the flow at each vertex. On a staggered grid a face stores one component of the velocity. Each component
  ! therefore has its own call, with the volumes of its faces. The forces at the vertices of a cusp must add up to the force on
  ! the cusp.
  subroutine take_forces()
    real(dp) :: velocity(3, size(fluid%K)), weight(size(fluid%K)), part(3, size(x, 2)), sums(3, 3)
    integer :: c, f
    do c = 1, 3
      weight = merge(fluid%h**3, 0._dp, fluid%face(2, :) == c)
      velocity = 0
      do f = 1, size(weight)
        velocity(c, f) = fluid%v(fluid%face(1, f), c)
      end do
      part = 0
      sums = 0
      call marks%add_vertex_reaction(surface, R, velocity, weight, part, status=status)
      if (status == RIIS_OK) call marks%add_reaction(R, velocity, weight, leaflet_force=sums, status=status)
      call check(status)
      force(c, :) = part(c, :)
      of_leaflets(c, :) = sums(c, :)
      if (abs(sum(force(c, :), mask=in_cusp) - of_leaflets(c, 1)) > 1e-12_dp * sum(abs(force(c, :)))) &
        call refuse('the vertices of the cusp have another force than the cusp')
    end do
  end subroutine take_forces

  ! Moves the cusp by dt. The force of the flow stays the same during the step, and the springs move in smaller steps.
  subroutine move_cusp()
    real(dp) :: before(3, size(x, 2)), pull(3, size(x, 2)), along(3), h
    integer :: i, k
    before = x
    h = dt / substeps
    do k = 1, substeps
      pull = 0
      do i = 1, size(x, 2)
        pull(:, twin(i)) = pull(:, twin(i)) + force(:, i)
      end do
      do i = 1, size(springs, 2)
        along = x(:, springs(2, i)) - x(:, springs(1, i))
        along = stiffness * (1 - at_rest(i) / norm2(along)) * along
        pull(:, springs(1, i)) = pull(:, springs(1, i)) + along
        pull(:, springs(2, i)) = pull(:, springs(2, i)) - along
      end do
      do i = 1, size(x, 2)
        if (moves(i)) v(:, i) = (v(:, i) + h * pull(:, i) * count(moves) / mass) / (1 + h * damping)
        if (moves(i)) x(:, i) = x(:, i) + h * v(:, i)
      end do
    end do
    x = x(:, twin)
    u = (x - before) / dt
  end subroutine move_cusp
end program membrane
