! SPDX-License-Identifier: Apache-2.0
!> Solves the pressure equation on a box of cells with HYPRE, by conjugate gradients with the structured multigrid PFMG.
module flow_pressure
  use, intrinsic :: iso_fortran_env, only: dp => real64, int64
  use mpi, only: mpi_init, mpi_initialized, MPI_COMM_SELF
  implicit none
  private
  public :: pressure_equation

  integer, parameter :: pfmg = 1 ! HYPRE's number for this preconditioner
  ! The matrix is symmetric, so its stencil has only the cell and its lower neighbours in x, y and z.
  integer, parameter :: offset(3, 0:3) = reshape([0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1], [3, 4])

  type :: pressure_equation
    private
    integer :: n(3) = 0                                        ! cells of the box
    integer(int64) :: grid = 0, stencil = 0, matrix = 0, right = 0, left = 0 ! HYPRE's handles
    integer, public :: iterations = 0                          ! iterations of the last solution
    real(dp), public :: residual = 0                           ! residual of the last solution, relative to the right-hand side
  contains
    procedure :: start, solve, finish
  end type pressure_equation

contains

  !> Makes the matrix and both vectors. HYPRE needs MPI, and this program runs as one rank.
  subroutine start(this, n)
    class(pressure_equation), intent(inout) :: this
    integer, intent(in) :: n(3)
    integer :: entry, ierr
    logical :: done
    call mpi_initialized(done, ierr)
    if (.not. done) call mpi_init(ierr)
    this%n = n
    call HYPRE_StructGridCreate(MPI_COMM_SELF, 3, this%grid, ierr)
    call HYPRE_StructGridSetExtents(this%grid, [1, 1, 1], n, ierr)
    call HYPRE_StructGridAssemble(this%grid, ierr)
    call HYPRE_StructStencilCreate(3, 4, this%stencil, ierr)
    do entry = 0, 3
      call HYPRE_StructStencilSetElement(this%stencil, entry, offset(:, entry), ierr)
    end do
    call HYPRE_StructMatrixCreate(MPI_COMM_SELF, this%grid, this%stencil, this%matrix, ierr)
    call HYPRE_StructMatrixSetSymmetric(this%matrix, 1, ierr)
    call HYPRE_StructMatrixInitialize(this%matrix, ierr)
    call HYPRE_StructVectorCreate(MPI_COMM_SELF, this%grid, this%right, ierr)
    call HYPRE_StructVectorInitialize(this%right, ierr)
    call HYPRE_StructVectorCreate(MPI_COMM_SELF, this%grid, this%left, ierr)
    call HYPRE_StructVectorInitialize(this%left, ierr)
  end subroutine start

  !> Solves for p. The caller's p is the first guess. The preconditioner is set up in each call, because a moving valve changes
  !! the matrix.
  subroutine solve(this, coefficient, b, p, tolerance, failed)
    class(pressure_equation), intent(inout) :: this
    real(dp), intent(in) :: coefficient(0:, :)                 ! (0:3, n_cells): in the order of the stencil
    real(dp), intent(in) :: b(:)                               ! (n_cells)
    real(dp), intent(inout) :: p(:)                            ! (n_cells)
    real(dp), intent(in) :: tolerance                          ! largest residual, relative to b
    logical, intent(out) :: failed                             ! true if the solver did not converge
    integer(int64) :: cg, multigrid
    integer :: ierr
    call HYPRE_StructMatrixSetBoxValues(this%matrix, [1, 1, 1], this%n, 4, [0, 1, 2, 3], coefficient, ierr)
    call HYPRE_StructMatrixAssemble(this%matrix, ierr)
    call HYPRE_StructVectorSetBoxValues(this%right, [1, 1, 1], this%n, b, ierr)
    call HYPRE_StructVectorAssemble(this%right, ierr)
    call HYPRE_StructVectorSetBoxValues(this%left, [1, 1, 1], this%n, p, ierr)
    call HYPRE_StructVectorAssemble(this%left, ierr)

    call HYPRE_StructPFMGCreate(MPI_COMM_SELF, multigrid, ierr)
    call HYPRE_StructPFMGSetMaxIter(multigrid, 1, ierr)
    call HYPRE_StructPFMGSetTol(multigrid, 0._dp, ierr)
    call HYPRE_StructPFMGSetZeroGuess(multigrid, ierr)
    call HYPRE_StructPFMGSetRelaxType(multigrid, 2, ierr)      ! symmetric red and black Gauss and Seidel
    call HYPRE_StructPCGCreate(MPI_COMM_SELF, cg, ierr)
    call HYPRE_StructPCGSetTwoNorm(cg, 1, ierr)
    call HYPRE_StructPCGSetTol(cg, tolerance, ierr)
    call HYPRE_StructPCGSetMaxIter(cg, 200, ierr)
    call HYPRE_StructPCGSetPrecond(cg, pfmg, multigrid, ierr)
    call HYPRE_StructPCGSetup(cg, this%matrix, this%right, this%left, ierr)
    call HYPRE_StructPCGSolve(cg, this%matrix, this%right, this%left, ierr)
    call HYPRE_StructPCGGetNumIterations(cg, this%iterations, ierr)
    call HYPRE_StructPCGGetFinalRelative(cg, this%residual, ierr)
    call HYPRE_StructPCGDestroy(cg, ierr)
    call HYPRE_StructPFMGDestroy(multigrid, ierr)
    call HYPRE_StructVectorGetBoxValues(this%left, [1, 1, 1], this%n, p, ierr)
    failed = .not. this%residual <= tolerance                  ! also true if the residual is NaN
  end subroutine solve

  subroutine finish(this)
    class(pressure_equation), intent(inout) :: this
    integer :: ierr
    if (this%grid == 0) return
    call HYPRE_StructVectorDestroy(this%left, ierr)
    call HYPRE_StructVectorDestroy(this%right, ierr)
    call HYPRE_StructMatrixDestroy(this%matrix, ierr)
    call HYPRE_StructStencilDestroy(this%stencil, ierr)
    call HYPRE_StructGridDestroy(this%grid, ierr)
    this%grid = 0
  end subroutine finish
end module flow_pressure
