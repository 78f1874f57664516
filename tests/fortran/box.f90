! SPDX-License-Identifier: Apache-2.0
! Makes a box of nodes around the aortic valve, which the tests of module riis mark. Also makes the expected marks, by riis_c.
module box
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_loc, c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use checks
  use riis
  use riis_c, only: c_mark_nodes => riis_mark_nodes, c_marks_create => riis_marks_create, &
    c_marks_destroy => riis_marks_destroy, c_marks_get_list => riis_marks_get_list, c_mark_list => riis_mark_list, &
    c_mesh_create => riis_mesh_create, c_mesh_destroy => riis_mesh_destroy
  implicit none
  private
  public :: per_side, n_nodes, xyz, expected, expected_distance, valve, surface, make_box, free_box, get_rows, check_marking
  integer, parameter :: per_side = 21, n_nodes = per_side**3
  real(c_double), allocatable :: xyz(:, :)             ! a cube of 2.8 cm with a node every 1.4 mm
  integer(int64), allocatable :: expected(:)           ! the nodes that riis_c marks, from 0
  real(c_double), allocatable :: expected_distance(:)  ! and their distances
  type(riis_valve) :: valve
  type(riis_surface) :: surface

contains

  subroutine make_box()
    integer :: i
    allocate (xyz(3, n_nodes))
    do i = 0, n_nodes - 1
      xyz(:, i + 1) = -1.4d0 + 0.14d0 * [mod(i, per_side), mod(i / per_side, per_side), i / per_side**2]
    end do
    call valve%create('aortic')
    call surface%create(valve, half_thickness=0.12d0)
    call mark_from_c()
  end subroutine make_box

  subroutine free_box()
    call surface%destroy()
    call valve%destroy()
  end subroutine free_box

  ! Computes the reference marks, without module riis where possible.
  subroutine mark_from_c()
    type(c_mark_list) :: list
    type(c_ptr) :: mesh, result
    integer(int64), pointer :: id(:)
    real(c_double), pointer :: distance(:)
    real(c_double), pointer :: target_xyz(:, :)
    integer(int64) :: n
    allocate (target_xyz, source=xyz)
    mesh = c_null_ptr
    result = c_null_ptr
    call check_ok(c_mesh_create(int(n_nodes, int64), c_loc(target_xyz(1, 1)), c_loc(target_xyz(2, 1)), &
      c_loc(target_xyz(3, 1)), 3_int64, mesh), 'a mesh from riis_c')
    call check_ok(c_marks_create(result), 'a result from riis_c')
    call check_ok(c_mark_nodes(surface%c_handle(), mesh, marks=result), 'marking from riis_c')
    call check_ok(c_marks_get_list(result, RIIS_LIST_MARKED, list, storage_size(list, int64) / 8), &
      'the marked nodes from riis_c')
    n = list%n_nodes
    call c_f_pointer(list%node_id, id, [n])
    call c_f_pointer(list%distance, distance, [n])
    expected = id
    expected_distance = distance
    call check(n > 100 .and. 2 * n < n_nodes, 'riis_c marks some of the nodes')
    call c_marks_destroy(result)
    call c_mesh_destroy(mesh)
    deallocate (target_xyz)
  end subroutine mark_from_c

  ! Checks that a mesh gets the marks that riis_c gives.
  subroutine check_marking(mesh, what, search)
    type(riis_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: what
    integer, intent(in), optional :: search
    type(riis_marks) :: result
    integer(int64), pointer :: node_id(:)
    real(c_double), pointer :: distance(:)
    logical :: is_same
    call riis_mark_nodes(surface, mesh, result, search=search)
    call result%marked(node_id, distance)
    is_same = size(node_id) == size(expected)
    if (is_same) is_same = all(node_id == expected) .and. all(same(distance, expected_distance))
    call check(is_same, what // ': marked as from riis_c')
    call result%destroy()
  end subroutine check_marking

  ! Gives the rows of the box's adjacency, counted from 1.
  subroutine get_rows(offsets, columns)
    integer(int64), allocatable, intent(out) :: offsets(:), columns(:)
    integer :: ijk(3), node, axis, step, n
    allocate (offsets(n_nodes + 1), columns(6 * n_nodes))
    n = 0
    do node = 0, n_nodes - 1
      offsets(node + 1) = n + 1
      ijk = [mod(node, per_side), mod(node / per_side, per_side), node / per_side**2]
      do axis = 1, 3
        do step = -1, 1, 2
          if (ijk(axis) + step < 0 .or. ijk(axis) + step >= per_side) cycle
          n = n + 1
          columns(n) = node + step * per_side**(axis - 1) + 1
        end do
      end do
    end do
    offsets(n_nodes + 1) = n + 1
  end subroutine get_rows
end module box
