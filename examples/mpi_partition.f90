! SPDX-License-Identifier: Apache-2.0
! A mesh that is partitioned over the ranks of MPI. Each rank marks the nodes that it owns, and riis does not communicate.
! Then rank 0 compares the ranks' marks with the marking of the whole mesh. Lengths are in cm.
!   mpirun -n 4 ./mpi_partition_fortran
program mpi_partition
  use mpi_f08
  use riis
  implicit none
  integer, parameter :: n = 27, plane = n**2, n_nodes = n * plane
  ! A cube of 3.25 cm around the valve, a node every 1.25 mm; in this example every rank stores all nodes.
  double precision :: xyz(3, n_nodes)
  double precision :: distance(n_nodes), by_ranks(n_nodes)
  integer :: offsets(n_nodes + 1), columns(6 * n_nodes)
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_marks) :: result
  integer :: rank, n_ranks, first, last, n_all, n_marked, n_marked_by_ranks, i
  logical :: same

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, n_ranks)
  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -1.625d0 + 0.125d0 * [mod(i, n), mod(i / n, n), i / plane]
  end do

  ! The surface is small, so every rank makes its own copy. All copies have the same bits.
  call valve%create('aortic')
  call surface%create(valve)

  first = n * rank / n_ranks * plane + 1 ! a part consists of whole planes of the grid
  last = n * (rank + 1) / n_ranks * plane
  distance = RIIS_FAR_DISTANCE
  n_marked = 0
  if (first <= last) then ! a rank without nodes has nothing to mark
    call make_rows(last - first + 1, n_all)
    call mesh%create(xyz(:, first:last))
    call mesh%set_adjacency(offsets(1:last - first + 2), columns, n_all=n_all)
    ! If every core has a rank, each rank should use one thread. If each rank is bound to several cores, such as by mpirun
    ! --map-by slot:PE=4, leave n_threads out. The rank then uses all of its cores. If ranks are not bound, each rank would use
    ! all cores of the machine.
    call riis_mark_nodes(surface, mesh, result, search=RIIS_SEARCH_NEIGHBOR, n_threads=1)
    n_marked = int(result%n_marked())
    call result%dense(distance=distance(first:last))
    call mesh%destroy()
  end if
  call MPI_Reduce(n_marked, n_marked_by_ranks, 1, MPI_INTEGER, MPI_SUM, 0, MPI_COMM_WORLD)
  call MPI_Reduce(distance, by_ranks, n_nodes, MPI_DOUBLE_PRECISION, MPI_MIN, 0, MPI_COMM_WORLD)

  same = .true.
  if (rank == 0) then
    call mesh%create(xyz)
    call riis_mark_nodes(surface, mesh, result, search=RIIS_SEARCH_EXHAUSTIVE, n_threads=1)
    n_marked = int(result%n_marked())
    call result%dense(distance=distance)
    call mesh%destroy()
    same = n_marked == n_marked_by_ranks .and. all(abs(distance - by_ranks) <= 0)
    print '(i0, a, i0)', n_nodes, ' nodes, marked: ', n_marked
    print '(i0, a, i0, 2a)', n_ranks, ' ranks, marked: ', n_marked_by_ranks, ', ', &
      trim(merge('the same nodes and distances', 'other nodes or distances    ', same))
  end if

  call result%destroy()
  call surface%destroy()
  call valve%destroy()
  call MPI_Finalize()
  if (.not. same) error stop

contains

  ! Makes compressed sparse rows of the rank's n_rows own nodes. The neighbours in the planes before and behind belong to other
  ! ranks. These ghost nodes are numbered from n_rows + 1 on, as in most solvers.
  subroutine make_rows(n_rows, n_all)
    integer, intent(in) :: n_rows
    integer, intent(out) :: n_all ! the number of own nodes and ghost nodes
    integer :: n_before, n_behind, i
    n_before = merge(plane, 0, first > 1)
    n_behind = merge(plane, 0, last < n_nodes)
    n_all = n_rows + n_before + n_behind
    offsets(1) = 1
    do i = 1, n_rows
      offsets(i + 1) = offsets(i)
      if (mod(i - 1, n) > 0) call add(i, i - 1)
      if (mod(i - 1, n) < n - 1) call add(i, i + 1)
      if (mod((i - 1) / n, n) > 0) call add(i, i - n)
      if (mod((i - 1) / n, n) < n - 1) call add(i, i + n)
      if (i > plane) then
        call add(i, i - plane)
      else if (n_before > 0) then
        call add(i, n_rows + i)
      end if
      if (i + plane <= n_rows) then
        call add(i, i + plane)
      else if (n_behind > 0) then
        call add(i, i + plane + n_before)
      end if
    end do
  end subroutine make_rows

  subroutine add(row, column)
    integer, intent(in) :: row, column
    columns(offsets(row + 1)) = column
    offsets(row + 1) = offsets(row + 1) + 1
  end subroutine add
end program mpi_partition
