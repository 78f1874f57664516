! SPDX-License-Identifier: Apache-2.0
! Tests whether a closed valve seals, in a mesh that is partitioned over the ranks of MPI. Each rank labels the open regions of
! its part, and riis does not communicate. The ranks exchange the labels of the nodes that they share, until nothing changes. Then
! rank 0 compares the labels with those of the whole mesh. Lengths are in cm.
!   mpirun -n 4 ./mpi_leaks_fortran
program mpi_leaks
  use, intrinsic :: iso_fortran_env, only: int64
  use mpi_f08
  use riis
  implicit none
  integer, parameter :: n = 27, plane = n**2, n_nodes = n * plane
  ! A cube of 3.25 cm around the valve, a node every 1.25 mm; in this example every rank stores all nodes.
  double precision :: xyz(3, n_nodes)
  logical :: in_tube(n_nodes)
  ! For each node of a rank's part: the lowest node of its region, within the part; 0: no region.
  integer(int64) :: region(n_nodes)
  integer(int64) :: lowest(n_nodes)   ! for each such node: the lowest node of its region, within the whole mesh
  integer(int64) :: label(n_nodes), by_ranks(n_nodes), n_regions
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_marks) :: result
  integer :: rank, n_ranks, first, n_own, n_planes, before, behind, axis, i
  logical :: changed, same

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, n_ranks)
  if (n_ranks > n) then
    if (rank == 0) print '(a, i0, a)', 'at most ', n, ' ranks, one for each plane'
    call MPI_Abort(MPI_COMM_WORLD, 1)
  end if
  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -1.625d0 + 0.125d0 * [mod(i, n), mod(i / n, n), i / plane]
  end do
  in_tube = xyz(1, :)**2 + xyz(2, :)**2 <= 1.2d0**2

  ! In this aortic valve the cusps nearly meet. The surface is small, so every rank makes its own copy, with the same bits.
  call valve%create('aortic')
  call valve%set('leaflet_radius_in', 0.02d0)
  call surface%create(valve)

  ! The part consists of whole planes and of the first plane of the next rank, whose nodes both ranks have.
  first = n * rank / n_ranks * plane + 1
  n_own = n * (rank + 1) / n_ranks - n * rank / n_ranks
  n_planes = n_own + merge(1, 0, rank + 1 < n_ranks)
  before = merge(rank - 1, MPI_PROC_NULL, rank > 0)
  behind = merge(rank + 1, MPI_PROC_NULL, rank + 1 < n_ranks)
  call label_part(first, n_planes, region)
  do i = 1, n_planes * plane
    lowest(i) = first + i - 1 ! local numbers become global ones
  end do

  changed = .true.
  do while (changed)
    changed = .false.
    call exchange(1, before, n_planes, behind) ! sends the first plane to the rank before
    call exchange(n_planes, behind, 1, before) ! sends the last plane to the rank behind
    call MPI_Allreduce(MPI_IN_PLACE, changed, 1, MPI_LOGICAL, MPI_LOR, MPI_COMM_WORLD)
  end do

  label = n_nodes + 1
  do i = 1, n_own * plane
    label(first + i - 1) = 0
    if (region(i) > 0) label(first + i - 1) = lowest(region(i))
  end do
  call MPI_Reduce(label, by_ranks, n_nodes, MPI_INTEGER8, MPI_MIN, 0, MPI_COMM_WORLD)

  same = .true.
  if (rank == 0) then
    call label_part(1, n, label)
    same = all(label == by_ranks)
    axis = 1 + (n + 1) * ((n - 1) / 2) ! the node on the axis at the lower end of the tube
    print '(i0, a, i0, 2a)', n_nodes, ' nodes, ', n_regions, ' open regions: the valve ', &
      merge('leaks', 'seals', label(axis) == label(axis + (n - 1) * plane))
    print '(i0, 2a)', n_ranks, ' ranks: ', trim(merge('the same labels', 'other labels   ', same))
  end if

  call result%destroy()
  call surface%destroy()
  call valve%destroy()
  call MPI_Finalize()
  if (.not. same) error stop

contains

  ! Marks planes of the grid from node `start` on, and labels their open regions with numbers that count from `start`.
  subroutine label_part(start, planes, labels)
    integer, intent(in) :: start, planes
    integer(int64), intent(inout) :: labels(n_nodes)
    type(riis_mesh) :: mesh
    type(riis_adjacency) :: adjacency
    integer :: last
    last = start + planes * plane - 1
    call mesh%create(xyz(:, start:last))
    call adjacency%create_from_grid(n, n, planes)
    call mesh%set_adjacency(adjacency)
    ! One thread per rank, because each core has a rank.
    call riis_mark_nodes(surface, mesh, result, node_mask=in_tube(start:last), n_threads=1)
    call riis_label_open_regions(mesh, result, labels(1:planes * plane), n_regions, in_tube(start:last), 1)
    call mesh%destroy()
    call adjacency%destroy()
  end subroutine label_part

  ! Sends the labels of one plane of the part to a rank, and receives the labels of the plane at_plane from a rank. The received
  ! labels may show that a region reaches to a lower node.
  subroutine exchange(from_plane, to_rank, at_plane, from_rank)
    integer, intent(in) :: from_plane, to_rank, at_plane, from_rank
    integer(int64) :: sent(plane), got(plane), own
    integer :: k
    sent = 0
    got = 0
    do k = 1, plane
      own = region((from_plane - 1) * plane + k)
      if (own > 0) sent(k) = lowest(own)
    end do
    call MPI_Sendrecv(sent, plane, MPI_INTEGER8, to_rank, 0, got, plane, MPI_INTEGER8, from_rank, 0, MPI_COMM_WORLD, &
      MPI_STATUS_IGNORE)
    do k = 1, plane
      own = region((at_plane - 1) * plane + k)
      if (got(k) == 0 .or. own == 0) cycle
      if (got(k) >= lowest(own)) cycle
      lowest(own) = got(k)
      changed = .true.
    end do
  end subroutine exchange
end program mpi_leaks
