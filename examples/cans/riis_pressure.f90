! SPDX-License-Identifier: Apache-2.0
! The pressure of CaNS with a valve. CaNS solves a Poisson equation with constant coefficients, which does not contain K. The
! pressure therefore reaches the drop of the valve only after many steps. This module improves the pressure before CaNS projects:
!
!   jump           the drop across the valve, one number a call, is computed by a Galerkin condition
!   sweeps         predictor and projection are repeated
!   cg             conjugate gradients on the equation with K, preconditioned by CaNS's own solver
!   extrapolation  the last change of the pressure is repeated
!
! README.md, "The lag of the pressure", compares the ways to improve the pressure. All ways keep p and the predicted velocity
! consistent: velocity = (velocity without pressure and K - a grad p) / (1 + a K), where a is the length of the substep.
module mod_riis_pressure
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use mpi
  use mod_types, only: rp, MPI_REAL_RP
  use mod_param, only: ng, dl, dli, cbcvel, bcvel, cbcpre, bcpre, nb, is_bound
  use mod_bound, only: boundp, bounduvw
  use mod_correc, only: correc
  use mod_fillps, only: fillps
  use mod_solver, only: solver
  use riis, only: riis_mark_list
  implicit none
  private
  public :: riis_pressure_setup, riis_pressure_valve_moved, riis_pressure_damp, riis_pressure_improve

  logical, public :: jump = .true.           ! the method that README.md recommends
  integer, public :: sweeps = 1, cg = 0
  real(rp), public :: extrapolation = 0

  ! For the faces of a velocity component near the valve: 1 / (1 + a K), the velocity before a correction, and fluxes.
  type :: faces
    real(rp), allocatable :: softened(:), before(:), flux(:)
  end type faces

  ! CaNS's data of the solver and the grid.
  integer :: n(3)
  integer(int64) :: stride(3)                ! from a cell to the next in an array (0:n(1)+1, 0:n(2)+1, 0:n(3)+1)
  real(rp), allocatable :: dzc(:), dzf(:), dzci(:), dzfi(:), lambda(:, :), a_z(:), b_z(:), c_z(:)
  type(c_ptr) :: plans(2, 2)
  real(rp) :: norm

  type(riis_mark_list) :: near(3)            ! the faces near the valve
  type(faces) :: band(3)
  logical :: has_valve = .false.             ! on any rank
  real(rp), allocatable, dimension(:, :, :) :: shape_of_jump, last, x, residual, direction, laplacian

contains

  subroutine riis_pressure_setup(n_cells, dzc_, dzf_, dzci_, dzfi_, plans_, norm_, lambda_, a, b, c)
    integer, intent(in) :: n_cells(3)
    real(rp), intent(in) :: dzc_(0:), dzf_(0:), dzci_(0:), dzfi_(0:), norm_, lambda_(:, :), a(:), b(:), c(:)
    type(c_ptr), intent(in) :: plans_(2, 2)
    n = n_cells
    stride = [1, n(1) + 2, (n(1) + 2) * (n(2) + 2)]
    allocate (dzc(0:n(3)+1), dzf(0:n(3)+1), dzci(0:n(3)+1), dzfi(0:n(3)+1))
    dzc = dzc_
    dzf = dzf_
    dzci = dzci_
    dzfi = dzfi_
    plans = plans_
    norm = norm_
    lambda = lambda_
    a_z = a
    b_z = b
    c_z = c
    if (jump) call new(shape_of_jump)
    if (extrapolation > 0) call new(last)
    if (cg > 0) then
      call new(x)
      call new(residual)
      call new(direction)
      call new(laplacian)
    end if
  end subroutine riis_pressure_setup

  subroutine new(field)
    real(rp), allocatable, intent(out) :: field(:, :, :)
    allocate (field(0:n(1)+1, 0:n(2)+1, 0:n(3)+1), source=0._rp)
  end subroutine new

  ! Reads the lists of another marking. The lists need K, and for the jump also the normals.
  subroutine riis_pressure_valve_moved(lists)
    type(riis_mark_list), intent(in) :: lists(3)
    integer(int64) :: all
    integer :: c, error
    near = lists
    do c = 1, 3
      if (allocated(band(c)%softened)) deallocate (band(c)%softened, band(c)%before, band(c)%flux)
      allocate (band(c)%softened(near(c)%n_nodes), band(c)%before(near(c)%n_nodes), band(c)%flux(near(c)%n_nodes))
    end do
    all = sum(near%n_nodes)
    call MPI_ALLREDUCE(MPI_IN_PLACE, all, 1, MPI_INTEGER8, MPI_SUM, MPI_COMM_WORLD, error)
    has_valve = all > 0
    if (jump .and. has_valve) call make_shape
  end subroutine riis_pressure_valve_moved

  ! The shape of the jump: the potential of K times the normals. The pressure changes by about one number across the valve, and is
  ! smooth at a free edge.
  subroutine make_shape
    integer :: c
    shape_of_jump = 0
    do c = 1, 3
      band(c)%flux = real(near(c)%K * near(c)%normal(c, :), rp)
      call add_divergence(shape_of_jump, size(shape_of_jump, kind=int64), c)
    end do
    call solve(shape_of_jump)
  end subroutine make_shape

  ! Adds the divergence of the band's fluxes. Each face is the upper face of its cell and the lower face of the next cell. Sums in
  ! halos are not used.
  subroutine add_divergence(field, m, c)
    integer(int64), intent(in) :: m
    real(rp), intent(inout) :: field(0:m - 1)
    integer, intent(in) :: c
    real(rp) :: inverse(0:1)                 ! of the lengths of both cells
    integer(int64) :: i, cell
    integer :: k
    inverse = dli(c)
    do i = 1, near(c)%n_nodes
      cell = near(c)%node_id(i)
      k = int(cell / stride(3))
      if (c == 3) inverse = dzfi(k:k + 1)
      field(cell) = field(cell) + band(c)%flux(i) * inverse(0)
      field(cell + stride(c)) = field(cell + stride(c)) - band(c)%flux(i) * inverse(1)
    end do
  end subroutine add_divergence

  ! Solves CaNS's Poisson equation in place, and fills the halos.
  subroutine solve(q)
    real(rp), intent(inout) :: q(0:, 0:, 0:)
    call solver(n, ng, plans, norm, lambda, a_z, b_z, c_z, cbcpre, ['c', 'c', 'c'], q)
    call boundp(cbcpre, n, bcpre, nb, is_bound, dl, dzc, q)
  end subroutine solve

  ! Lets the valve act on the velocity: u = (u + a K u_surface) / (1 + a K).
  subroutine riis_pressure_damp(a, u, v, w)
    real(rp), intent(in) :: a
    real(rp), intent(inout), contiguous :: u(0:, 0:, 0:), v(0:, 0:, 0:), w(0:, 0:, 0:)
    integer(int64) :: m
    integer :: c
    m = size(u, kind=int64)
    do c = 1, 3
      band(c)%softened = real(1 / (1 + a * near(c)%K), rp)
    end do
    call damp_flat(u, m, a, 1)
    call damp_flat(v, m, a, 2)
    call damp_flat(w, m, a, 3)
  end subroutine riis_pressure_damp

  subroutine damp_flat(u, m, a, c)
    integer(int64), intent(in) :: m
    real(rp), intent(inout) :: u(0:m - 1)
    real(rp), intent(in) :: a
    integer, intent(in) :: c
    logical :: moves
    integer(int64) :: i, face
    moves = size(near(c)%K_u_surface) > 0
    do i = 1, near(c)%n_nodes
      face = near(c)%node_id(i)
      if (moves) u(face) = u(face) + real(a * near(c)%K_u_surface(c, i), rp)
      u(face) = u(face) * band(c)%softened(i)
    end do
  end subroutine damp_flat

  ! Improves p and the predicted velocity before CaNS projects. The velocity contains K already.
  subroutine riis_pressure_improve(a, u, v, w, p, pp)
    real(rp), intent(in) :: a
    real(rp), intent(inout), contiguous, dimension(0:, 0:, 0:) :: u, v, w, p
    real(rp), intent(out), contiguous, dimension(0:, 0:, 0:) :: pp     ! CaNS's work array
    integer :: sweep
    if (.not. has_valve) return
    if (extrapolation > 0) then
      pp = extrapolation * (p - last)
      last = p
      call advance(a, 1._rp, pp, u, v, w, p)
    end if
    do sweep = 1, sweeps
      if (jump) call correct_jump(a, u, v, w, p, pp)
      if (sweep == 1 .and. cg > 0) call conjugate_gradients(a, u, v, w, p, pp)
      if (sweep == sweeps) exit              ! CaNS's own projection follows
      call divergence(a, u, v, w, pp)
      call solve(pp)
      call advance(a, 1._rp, pp, u, v, w, p)
    end do
  end subroutine riis_pressure_improve

  ! Adds factor q to p, and changes the predicted velocity accordingly: u = u - a factor grad q / (1 + a K).
  subroutine advance(a, factor, q, u, v, w, p)
    real(rp), intent(in) :: a, factor
    real(rp), intent(in) :: q(0:, 0:, 0:)
    real(rp), intent(inout), contiguous, dimension(0:, 0:, 0:) :: u, v, w, p
    integer(int64) :: m
    m = size(u, kind=int64)
    call keep(u, m, 1)
    call keep(v, m, 2)
    call keep(w, m, 3)
    call correc(n, dli, dzci, a * factor, q, u, v, w)
    call soften(u, m, 1)
    call soften(v, m, 2)
    call soften(w, m, 3)
    p = p + factor * q
  end subroutine advance

  subroutine keep(u, m, c)
    integer(int64), intent(in) :: m
    real(rp), intent(in) :: u(0:m - 1)
    integer, intent(in) :: c
    band(c)%before = u(near(c)%node_id)
  end subroutine keep

  subroutine soften(u, m, c)
    integer(int64), intent(in) :: m
    real(rp), intent(inout) :: u(0:m - 1)
    integer, intent(in) :: c
    integer(int64) :: i, face
    do i = 1, near(c)%n_nodes
      face = near(c)%node_id(i)
      u(face) = band(c)%before(i) + band(c)%softened(i) * (u(face) - band(c)%before(i))
    end do
  end subroutine soften

  subroutine divergence(a, u, v, w, q)
    real(rp), intent(in) :: a
    real(rp), intent(inout), dimension(0:, 0:, 0:) :: u, v, w
    real(rp), intent(out), dimension(0:, 0:, 0:) :: q
    call bounduvw(cbcvel, n, bcvel, nb, is_bound, dl, dzc, dzf, u, v, w, .false., -1)
    call fillps(n, dli, dzfi, 1 / a, u, v, w, q)
  end subroutine divergence

  ! Changes p by a multiple of the jump's shape s. After the change, s is orthogonal to the divergence of the predicted velocity.
  ! With the equation A p = b of the pressure with K, this is the best multiple in A's norm. The slow part of the error is a jump
  ! of the pressure across the valve. The gradient of this jump lies in the band, where a solver with constant coefficients makes
  ! its effect 1 + a K times too large.
  subroutine correct_jump(a, u, v, w, p, pp)
    real(rp), intent(in) :: a
    real(rp), intent(inout), contiguous, dimension(0:, 0:, 0:) :: u, v, w, p
    real(rp), intent(out), contiguous, dimension(0:, 0:, 0:) :: pp
    real(rp) :: sums(2)
    integer :: error
    call divergence(a, u, v, w, pp)
    sums = [product_of(shape_of_jump, pp), work_of_shape(shape_of_jump)]
    call MPI_ALLREDUCE(MPI_IN_PLACE, sums, 2, MPI_REAL_RP, MPI_SUM, MPI_COMM_WORLD, error)
    if (sums(2) < 0) call advance(a, sums(1) / sums(2), shape_of_jump, u, v, w, p)
  end subroutine correct_jump

  ! Returns this rank's part of the sum of q div(grad s / (1 + a K)) over the volume, for the jump's shape s. The Laplacian of the
  ! shape is div(K normal), so only faces near the valve have a part.
  function work_of_shape(q) result(work)
    real(rp), intent(in), contiguous :: q(0:, 0:, 0:)
    real(rp) :: work
    integer(int64) :: m
    integer :: c
    m = size(q, kind=int64)
    work = 0
    do c = 1, 3
      call take_from_gradient(shape_of_jump, m, c)
      band(c)%flux = real(near(c)%K * near(c)%normal(c, :), rp) - band(c)%flux
      work = work + work_of_band(q, m, c)
    end do
  end function work_of_shape

  ! Returns this rank's part of the sum of f g over the volume.
  function product_of(f, g) result(sum_of)
    real(rp), intent(in), dimension(0:, 0:, 0:) :: f, g
    real(rp) :: sum_of
    integer :: k
    sum_of = 0
    do k = 1, n(3)
      sum_of = sum_of + sum(f(1:n(1), 1:n(2), k) * g(1:n(1), 1:n(2), k)) * dl(1) * dl(2) * dzf(k)
    end do
  end function product_of

  ! Sets the band's fluxes to the part that the valve takes away from a gradient: (1 - 1 / (1 + a K)) grad q.
  subroutine take_from_gradient(q, m, c)
    integer(int64), intent(in) :: m
    real(rp), intent(in) :: q(0:m - 1)
    integer, intent(in) :: c
    real(rp) :: inverse
    integer(int64) :: i, cell
    inverse = dli(c)
    do i = 1, near(c)%n_nodes
      cell = near(c)%node_id(i)
      if (c == 3) inverse = dzci(int(cell / stride(3)))
      band(c)%flux(i) = (1 - band(c)%softened(i)) * (q(cell + stride(c)) - q(cell)) * inverse
    end do
  end subroutine take_from_gradient

  ! Returns this rank's part of the sum of q div(F) over the volume, where F is the band's fluxes and 0 elsewhere. A face in the
  ! lower halo belongs to another rank.
  function work_of_band(q, m, c) result(work)
    integer(int64), intent(in) :: m
    real(rp), intent(in) :: q(0:m - 1)
    integer, intent(in) :: c
    real(rp) :: work, area
    integer(int64) :: i, cell
    work = 0
    do i = 1, near(c)%n_nodes
      cell = near(c)%node_id(i)
      if (mod(cell / stride(c), int(n(c) + 2, int64)) == 0) cycle
      area = merge(dl(1) * dl(2), dl(3 - min(c, 2)) * dzf(int(cell / stride(3))), c == 3)
      work = work + band(c)%flux(i) * (q(cell) - q(cell + stride(c))) * area
    end do
  end function work_of_band

  ! Conjugate gradients for A x = -div(predicted velocity) / a with A q = -div(grad q / (1 + a K)). The preconditioner is CaNS's
  ! solver, so the Laplacian of each direction is known. A differs from this Laplacian only at faces near the valve.
  subroutine conjugate_gradients(a, u, v, w, p, pp)
    real(rp), intent(in) :: a
    real(rp), intent(inout), contiguous, dimension(0:, 0:, 0:) :: u, v, w, p
    real(rp), intent(out), contiguous, dimension(0:, 0:, 0:) :: pp     ! the preconditioned residual, then A times the direction
    real(rp) :: sums(3), r_z, r_z_before, first
    integer(int64) :: m
    integer :: iteration, c, error
    m = size(pp, kind=int64)
    x = 0
    direction = 0
    laplacian = 0
    r_z_before = 1
    first = -1
    call divergence(a, u, v, w, pp)
    residual = -pp
    do iteration = 1, cg
      pp = -residual
      call solve(pp)
      sums = [product_of(residual, pp), 0._rp, 0._rp]
      if (jump) sums(2:3) = [work_of_shape(pp), work_of_shape(shape_of_jump)]
      call MPI_ALLREDUCE(MPI_IN_PLACE, sums, 3, MPI_REAL_RP, MPI_SUM, MPI_COMM_WORLD, error)
      r_z = sums(1)
      if (first < 0) first = r_z
      if (r_z <= epsilon(r_z) * first) exit
      if (iteration == 1) r_z_before = huge(r_z)
      direction = pp + r_z / r_z_before * direction
      laplacian = -residual + r_z / r_z_before * laplacian
      if (jump) then
        ! The residual contains no jump, so each direction must stay orthogonal to the jump's shape.
        direction = direction - sums(2) / sums(3) * shape_of_jump
        do c = 1, 3
          band(c)%flux = -sums(2) / sums(3) * real(near(c)%K * near(c)%normal(c, :), rp)
          call add_divergence(laplacian, m, c)
        end do
      end if
      pp = -laplacian
      do c = 1, 3
        call take_from_gradient(direction, m, c)
        call add_divergence(pp, m, c)
      end do
      sums(1) = product_of(direction, pp)
      call MPI_ALLREDUCE(MPI_IN_PLACE, sums, 1, MPI_REAL_RP, MPI_SUM, MPI_COMM_WORLD, error)
      x = x + r_z / sums(1) * direction
      residual = residual - r_z / sums(1) * pp
      r_z_before = r_z
    end do
    call advance(a, 1._rp, x, u, v, w, p)
  end subroutine conjugate_gradients
end module mod_riis_pressure
