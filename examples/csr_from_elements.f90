! SPDX-License-Identifier: Apache-2.0
! The neighbour search for a finite element code: makes an adjacency from tetrahedra, whose 32-bit node numbers count from 1, and
! marks nodes. The exhaustive search, which needs no adjacency, finds the same nodes. Lengths are in cm.
program csr_from_elements
  use riis
  implicit none
  integer, parameter :: n = 27, n_nodes = n**3, n_cells = 6 * (n - 1)**3
  double precision :: xyz(3, n_nodes) ! a cube of 3.25 cm around the valve, a node every 1.25 mm
  integer :: node_ids(4, n_cells)     ! the four nodes of each tetrahedron
  type(riis_valve) :: valve
  type(riis_surface) :: surface
  type(riis_mesh) :: mesh
  type(riis_adjacency) :: adjacency
  ! The marks are kept from step to step, because the neighbour search starts from the previously marked nodes.
  type(riis_marks) :: by_neighbors, by_all
  integer, allocatable :: node_num(:), node_num_of_all(:)
  double precision, allocatable :: distance(:), distance_of_all(:)
  integer :: i
  logical :: same

  do i = 0, n_nodes - 1
    xyz(:, i + 1) = -1.625d0 + 0.125d0 * [mod(i, n), mod(i / n, n), i / n**2]
  end do
  call make_tetrahedra()

  call valve%create('aortic')
  call surface%create(valve)
  call mesh%create(xyz)
  call adjacency%create_from_cells(n_nodes, node_ids)
  call mesh%set_adjacency(adjacency) ! borrowed: the adjacency has to outlive the mesh

  print '(i0, a, i0, a)', n_nodes, ' nodes, ', n_cells, ' tetrahedra'
  call mark(RIIS_SEARCH_NEIGHBOR, 'neighbor', by_neighbors, node_num, distance)
  call mark(RIIS_SEARCH_EXHAUSTIVE, 'exhaustive', by_all, node_num_of_all, distance_of_all)
  same = size(node_num) == size(node_num_of_all)
  if (same) same = all(node_num == node_num_of_all) .and. all(abs(distance - distance_of_all) <= 0)
  print '(2a)', 'nodes and distances: ', trim(merge('the same, bit for bit', 'different            ', same))

  call by_all%destroy()
  call by_neighbors%destroy()
  call mesh%destroy()
  call adjacency%destroy()
  call surface%destroy()
  call valve%destroy()
  if (.not. same) error stop

contains

  subroutine mark(search, name, result, node_num, distance)
    integer, intent(in) :: search
    character(len=*), intent(in) :: name
    type(riis_marks), intent(inout) :: result
    integer, allocatable, intent(inout) :: node_num(:)
    double precision, allocatable, intent(inout) :: distance(:)
    type(riis_mark_stats) :: stats

    call riis_mark_nodes(surface, mesh, result, search=search)
    call result%marked_nodes(node_num, distance)
    call result%get_stats(stats)
    print '(2a, i0, 2a)', name, ' search, marked: ', size(node_num), ', ', &
      trim(merge('complete            ', 'perhaps not complete', stats%complete /= 0))
  end subroutine mark

  ! Cuts each cube of the grid into six tetrahedra. Each tetrahedron follows three edges from the first node of the cube to its
  ! last node. No two tetrahedra follow the axes in the same order.
  subroutine make_tetrahedra()
    integer, parameter :: step(3) = [1, n, n**2]
    integer, parameter :: axes(3, 6) = reshape([1, 2, 3, 1, 3, 2, 2, 1, 3, 2, 3, 1, 3, 1, 2, 3, 2, 1], [3, 6])
    integer :: i, j, k, order, corner, cell

    cell = 0
    do k = 1, n - 1
      do j = 1, n - 1
        do i = 1, n - 1
          do order = 1, 6
            cell = cell + 1
            node_ids(1, cell) = i + n * (j - 1) + n**2 * (k - 1)
            do corner = 1, 3
              node_ids(corner + 1, cell) = node_ids(corner, cell) + step(axes(corner, order))
            end do
          end do
        end do
      end do
    end do
  end subroutine make_tetrahedra
end program csr_from_elements
