! SPDX-License-Identifier: Apache-2.0
! Stand-ins for the modules of CaNS and MPI that examples/cans uses: one rank, a duct with an inflow of speed 1, an outflow, and
! walls on which the flow slips. The procedures have CaNS's arguments, and new code.
module mpi
  implicit none
  integer, parameter :: MPI_COMM_WORLD = 0, MPI_IN_PLACE = 0, MPI_SUM = 0, MPI_INTEGER8 = 8, MPI_DOUBLE_PRECISION = 8
contains
  ! Adds up over the ranks. With one rank, a sum in place needs no work.
  subroutine MPI_ALLREDUCE(send, receive, n, kind_of, operation, communicator, error)
    type(*), dimension(..), intent(in) :: send
    type(*), dimension(..), intent(inout) :: receive
    integer, intent(in) :: n, kind_of, operation, communicator
    integer, intent(out) :: error
    error = 0
    if (rank(send) /= 0 .or. rank(receive) > 1 .or. n < 1 .or. kind_of /= 8 .or. operation /= communicator) error stop 'ALLREDUCE'
  end subroutine MPI_ALLREDUCE

  subroutine MPI_ABORT(communicator, code, error)
    integer, intent(in) :: communicator, code
    integer, intent(out) :: error
    error = communicator
    error stop code
  end subroutine MPI_ABORT
end module mpi

module mod_types
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none
  integer, parameter :: rp = real64, MPI_REAL_RP = 8
end module mod_types

module mod_common_mpi
  implicit none
  integer :: myid = 0
end module mod_common_mpi

module mod_param
  use mod_types
  implicit none
  integer, parameter :: ng(3) = [24, 12, 12]
  real(rp), parameter :: l(3) = [2._rp, 1._rp, 1._rp]
  real(rp), parameter :: dl(3) = l / ng, dli(3) = ng / l
  character(len=1), parameter :: cbcvel(0:1, 3, 3) = 'N', cbcpre(0:1, 3) = 'N' ! the stand-ins know the boundaries
  real(rp), parameter :: bcvel(0:1, 3, 3) = 0
  real(rp) :: bcpre(0:1, 3) = 0, bforce(3) = 0
  integer, parameter :: nb(0:1, 3) = 0
  logical :: is_bound(0:1, 3) = .true., is_forced(3) = .false., is_poisson_dtdma = .false.
end module mod_param

module mod_bound
  use mod_types
  implicit none
contains
  ! Sets the velocity at the walls and at the inflow.
  subroutine bounduvw(cbc, n, bc, nb, is_bound, dl, dzc, dzf, u, v, w, keep, halos_norm, halos_tang)
    character(len=1), intent(in) :: cbc(0:1, 3, 3)
    integer, intent(in) :: n(3), nb(0:1, 3)
    real(rp), intent(in) :: bc(0:1, 3, 3), dl(3), dzc(0:), dzf(0:)
    logical, intent(in) :: is_bound(0:1, 3)
    real(rp), intent(inout), dimension(0:, 0:, 0:) :: u, v, w
    logical, intent(in), optional :: keep
    integer, intent(in), optional :: halos_norm, halos_tang
    if (present(halos_norm) .and. present(halos_tang)) return
    if (.not. all(is_bound) .or. any(cbc /= 'N') .or. any(nb /= 0) .or. any(abs(bc) > 0)) error stop 'bounduvw'
    if (dl(1) * dzc(1) * dzf(1) <= 0 .or. .not. present(keep)) error stop 'bounduvw'
    u(0, :, :) = 1
    v(:, 0, :) = 0
    v(:, n(2), :) = 0
    w(:, :, 0) = 0
    w(:, :, n(3)) = 0
  end subroutine bounduvw

  ! Sets p in the halo: p is 0 at the outflow, and has no gradient at the other boundaries.
  subroutine boundp(cbc, n, bc, nb, is_bound, dl, dzc, p, halo_side)
    character(len=1), intent(in) :: cbc(0:1, 3)
    integer, intent(in) :: n(3), nb(0:1, 3)
    real(rp), intent(in) :: bc(0:1, 3), dl(3), dzc(0:)
    logical, intent(in) :: is_bound(0:1, 3)
    real(rp), intent(inout) :: p(0:, 0:, 0:)
    integer, intent(in), optional :: halo_side
    if (present(halo_side)) error stop 'boundp'
    if (.not. all(is_bound) .or. any(cbc /= 'N') .or. any(nb /= 0) .or. any(abs(bc) > 0) .or. dl(1) * dzc(1) <= 0) &
      error stop 'boundp'
    p(0, :, :) = p(1, :, :)
    p(n(1) + 1, :, :) = -p(n(1), :, :)
    p(:, 0, :) = p(:, 1, :)
    p(:, n(2) + 1, :) = p(:, n(2), :)
    p(:, :, 0) = p(:, :, 1)
    p(:, :, n(3) + 1) = p(:, :, n(3))
  end subroutine boundp
end module mod_bound

module mod_correc
  use mod_types
  implicit none
contains
  subroutine correc(n, dli, dzci, dt, p, u, v, w)
    integer, intent(in) :: n(3)
    real(rp), intent(in) :: dli(3), dzci(0:), dt
    real(rp), intent(in) :: p(0:, 0:, 0:)
    real(rp), intent(inout), dimension(0:, 0:, 0:) :: u, v, w
    u(0:n(1), :, :) = u(0:n(1), :, :) - dt * dli(1) * (p(1:, :, :) - p(:n(1), :, :))
    v(:, 0:n(2), :) = v(:, 0:n(2), :) - dt * dli(2) * (p(:, 1:, :) - p(:, :n(2), :))
    w(:, :, 0:n(3)) = w(:, :, 0:n(3)) - dt * dzci(1) * (p(:, :, 1:) - p(:, :, :n(3)))
  end subroutine correc
end module mod_correc

module mod_fillps
  use mod_types
  implicit none
contains
  subroutine fillps(n, dli, dzfi, dti, u, v, w, p)
    integer, intent(in) :: n(3)
    real(rp), intent(in) :: dli(3), dzfi(0:), dti
    real(rp), intent(in), dimension(0:, 0:, 0:) :: u, v, w
    real(rp), intent(out) :: p(0:, 0:, 0:)
    integer :: i, j, k
    p = 0
    do concurrent (i = 1:n(1), j = 1:n(2), k = 1:n(3))
      p(i, j, k) = dti * (dli(1) * (u(i, j, k) - u(i-1, j, k)) + dli(2) * (v(i, j, k) - v(i, j-1, k)) &
        + dzfi(k) * (w(i, j, k) - w(i, j, k-1)))
    end do
  end subroutine fillps
end module mod_fillps

module mod_solver
  use, intrinsic :: iso_c_binding, only: c_ptr
  use mod_types
  use mod_param, only: dl, dli, nb, is_bound, bcpre
  use mod_bound, only: boundp
  implicit none
contains
  ! Solves the Poisson equation by conjugate gradients.
  subroutine solver(n, ng, plans, norm, lambda, a, b, c, bc, c_or_f, p)
    integer, intent(in) :: n(3), ng(3)
    type(c_ptr), intent(in) :: plans(2, 2)
    real(rp), intent(in) :: norm, lambda(:, :), a(:), b(:), c(:)
    character(len=1), intent(in) :: bc(0:1, 3), c_or_f(3)
    real(rp), intent(inout) :: p(0:, 0:, 0:)
    real(rp), dimension(n(1), n(2), n(3)) :: x, r, q
    real(rp) :: d(0:n(1)+1, 0:n(2)+1, 0:n(3)+1), rr, rr_before, first, step
    integer :: iteration
    if (any(n /= ng) .or. norm * size(plans) * size(lambda) * size(a) * size(b) * size(c) <= 0 .or. any(c_or_f /= 'c')) &
      error stop 'solver'
    x = 0
    r = -p(1:n(1), 1:n(2), 1:n(3))
    d = 0
    d(1:n(1), 1:n(2), 1:n(3)) = r
    rr = sum(r**2)
    first = rr
    do iteration = 1, 2000
      if (rr <= 1e-28_rp * first) exit
      call boundp(bc, n, bcpre, nb, is_bound, dl, dl, d)
      q = -laplacian(d)
      step = rr / sum(d(1:n(1), 1:n(2), 1:n(3)) * q)
      x = x + step * d(1:n(1), 1:n(2), 1:n(3))
      r = r - step * q
      rr_before = rr
      rr = sum(r**2)
      d(1:n(1), 1:n(2), 1:n(3)) = r + rr / rr_before * d(1:n(1), 1:n(2), 1:n(3))
    end do
    p(1:n(1), 1:n(2), 1:n(3)) = x
  contains
    function laplacian(d) result(sums)
      real(rp), intent(in) :: d(0:, 0:, 0:)
      real(rp) :: sums(n(1), n(2), n(3))
      integer :: i, j, k
      do concurrent (i = 1:n(1), j = 1:n(2), k = 1:n(3))
        sums(i, j, k) = dli(1)**2 * (d(i-1, j, k) - 2 * d(i, j, k) + d(i+1, j, k)) &
          + dli(2)**2 * (d(i, j-1, k) - 2 * d(i, j, k) + d(i, j+1, k)) &
          + dli(3)**2 * (d(i, j, k-1) - 2 * d(i, j, k) + d(i, j, k+1))
      end do
    end function laplacian
  end subroutine solver
end module mod_solver
