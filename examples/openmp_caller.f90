! SPDX-License-Identifier: Apache-2.0
! Two ways to mark nodes in a code that uses OpenMP itself. The first way is one call between the code's parallel regions. The
! call starts threads of the library. The second way is one call from each of the code's threads, for its block of the mesh. These
! calls start no threads. Lengths are in cm.
program openmp_caller
  use omp_lib
  use riis
  implicit none
  integer, parameter :: n = 27, n_nodes = n**3, n_blocks = 4
  double precision :: xyz(3, n_nodes) ! a cube of 3.25 cm around the valve, a node every 1.25 mm
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh, block_mesh(n_blocks)
  type(riis_marks) :: result, block_result(n_blocks)
  integer, allocatable :: node_num(:), block_node_num(:)
  double precision, allocatable :: distance(:), block_distance(:)
  double precision :: farthest
  integer :: i, n_found, n_in_block
  logical :: kept, same

  call omp_set_num_threads(3) ! the code's settings, which riis neither follows nor changes
  call omp_set_dynamic(.false.)
  !$omp parallel do
  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -1.625d0 + 0.125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do

  call valve%create('aortic')
  call surface%create(valve)

  ! One call between parallel regions. Whatever OpenMP's settings are, the call uses the processors on which this thread may run.
  ! For another number of threads, set n_threads.
  call mesh%create(xyz)
  call riis_mark_nodes(surface, mesh, result)
  call result%marked_nodes(node_num, distance)
  kept = omp_get_max_threads() == 3
  if (omp_get_dynamic()) kept = .false.
  farthest = 0
  !$omp parallel do reduction(max : farthest)
  do i = 1, size(node_num)
    farthest = max(farthest, distance(i))
  end do
  print '(a, i0, a, f8.6, a)', 'one call, marked: ', size(node_num), ', the farthest at ', farthest, ' cm'
  print '(2a)', 'settings of OpenMP: ', trim(merge('as they were', 'changed     ', kept))

  ! One call from each thread. All threads read one surface. Each thread has a separate mesh and a separate result. While any
  ! thread marks, no thread may update the surface. Update the surface before the region, or in a single construct, because all
  ! threads wait at its end.
  !$omp parallel do num_threads(n_blocks) schedule(static, 1)
  do i = 1, n_blocks
    call block_mesh(i)%create(xyz(:, last_node(i - 1) + 1:last_node(i)))
    call riis_mark_nodes(surface, block_mesh(i), block_result(i), n_threads=1)
  end do

  ! The lists of the blocks, one after the other, are the list of the whole mesh.
  n_found = 0
  same = .true.
  do i = 1, n_blocks
    call block_result(i)%marked_nodes(block_node_num, block_distance)
    n_in_block = size(block_node_num)
    print '(a, i0, a, i0)', 'block ', i - 1, ', marked: ', n_in_block
    same = same .and. n_found + n_in_block <= size(node_num)
    if (same) same = all(node_num(n_found + 1:n_found + n_in_block) == last_node(i - 1) + block_node_num) .and. &
      all(abs(distance(n_found + 1:n_found + n_in_block) - block_distance) <= 0)
    n_found = n_found + n_in_block
    call block_result(i)%destroy()
    call block_mesh(i)%destroy()
  end do
  same = same .and. n_found == size(node_num)
  print '(2a)', 'blocks together: ', trim(merge('the same nodes and distances', 'other nodes or distances    ', same))

  call result%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()
  if (.not. (kept .and. same)) error stop

contains

  integer function last_node(block)
    integer, intent(in) :: block
    last_node = n_nodes * block / n_blocks
  end function last_node
end program openmp_caller
