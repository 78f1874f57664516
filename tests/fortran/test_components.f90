! SPDX-License-Identifier: Apache-2.0
! Tests module riis: velocities and K u_surface in three arrays of rank 1, 3 and 4. The sums must have the bits that arrays (3, n)
! give.
program test_components
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int64
  use box
  use checks
  use riis
  implicit none
  integer, parameter :: m = per_side, extents(4) = [3, m / 3, m, m]
  real(c_double), parameter :: R = 3d0, eps = 0.12d0
  type(riis_mesh) :: mesh
  type(riis_surface) :: moving
  type(riis_marks) :: marks
  integer(riis_status) :: status
  real(c_double), allocatable :: velocity(:, :), weight(:)
  real(c_double), allocatable, dimension(:, :, :) :: u3, v3, w3, weight3
  real(c_double), allocatable, dimension(:, :, :, :) :: u4, v4, w4, weight4

  call make_box()
  call mesh%create(xyz)
  call moving%create(valve, half_thickness=eps)
  call moving%update_moving(valve, valve, 0.01d0, translation_before=[0.01d0, -0.02d0, 0.03d0])
  call riis_mark_nodes(moving, mesh, marks, distance_limit=0.3d0, fields=RIIS_FIELD_POINT + RIIS_FIELD_BARYCENTRIC + &
    RIIS_FIELD_VELOCITY + RIIS_FIELD_SIDE + RIIS_FIELD_RIM)
  call make_flow()
  call test_resistance()
  call test_halo()
  call test_reaction()
  call test_vertices()
  call test_band()
  call test_refused()
  call marks%destroy()
  call moving%destroy()
  call mesh%destroy()
  deallocate (velocity, weight, u3, v3, w3, weight3, u4, v4, w4, weight4)
  call free_box()
  call finish()

contains

  subroutine make_flow()
    allocate (velocity(3, n_nodes), weight(n_nodes))
    velocity(1, :) = cos(3 * xyz(2, :))
    velocity(2, :) = xyz(3, :)**2
    velocity(3, :) = 6 + xyz(1, :)
    weight = 1 + xyz(1, :)**2
    u3 = reshape(velocity(1, :), [m, m, m])
    v3 = reshape(velocity(2, :), [m, m, m])
    w3 = reshape(velocity(3, :), [m, m, m])
    weight3 = reshape(weight, [m, m, m])
    u4 = reshape(velocity(1, :), extents)
    v4 = reshape(velocity(2, :), extents)
    w4 = reshape(velocity(3, :), extents)
    weight4 = reshape(weight, extents)
  end subroutine make_flow

  subroutine test_resistance()
    real(c_double), allocatable :: K(:), K_u(:, :), parts(:, :), K1(:), wide(:, :)
    real(c_double), allocatable, dimension(:, :, :) :: K3, x3, y3, z3
    real(c_double), allocatable, dimension(:, :, :, :) :: K4, x4, y4, z4
    allocate (K(n_nodes), K_u(3, n_nodes), parts(n_nodes, 3), K1(n_nodes), wide(2, n_nodes))
    allocate (K3(m, m, m), x3(m, m, m), y3(m, m, m), z3(m, m, m))
    allocate (K4(3, m / 3, m, m), x4(3, m / 3, m, m), y4(3, m / 3, m, m), z4(3, m / 3, m, m))
    K = 0.25d0
    K_u = 0.5d0
    call marks%add_resistance(R, K, K_u, rim=RIIS_RIM_CUT)
    call check(maxval(K) > 1 .and. maxval(abs(K_u - 0.5d0)) > 1, 'there is a band that moves')

    K1 = 0.25d0
    parts = 0.5d0
    call marks%add_resistance(R, K1, parts(:, 1), parts(:, 2), parts(:, 3), rim=RIIS_RIM_CUT)
    call check(all(same(K1, K)) .and. all(same(transpose(parts), K_u)), 'rank 1')
    wide = 0.5d0
    wide(1, :) = 0.25d0
    call marks%add_resistance(R, wide(1, :), parts(:, 1), wide(2, :), parts(:, 3), rim=RIIS_RIM_CUT, status=status)
    call check_ok(status, 'sections')
    call check(all(same(wide(1, :), K)) .and. all(same(wide(2, :), K_u(2, :))), 'sections that are not contiguous')

    K3 = 0.25d0
    x3 = 0.5d0
    y3 = 0.5d0
    z3 = 0.5d0
    call marks%add_resistance(R, K3, x3, y3, z3, eps, RIIS_RIM_CUT)
    call check(all(same(reshape(K3, [n_nodes]), K)) .and. all(same(reshape(x3, [n_nodes]), K_u(1, :))) .and. &
      all(same(reshape(y3, [n_nodes]), K_u(2, :))) .and. all(same(reshape(z3, [n_nodes]), K_u(3, :))), 'rank 3')
    K4 = 0.25d0
    x4 = 0.5d0
    y4 = 0.5d0
    z4 = 0.5d0
    call marks%add_resistance(R, K4, x4, y4, z4, half_thickness=RIIS_AUTO, rim=RIIS_RIM_CUT, status=status)
    call check_ok(status, 'rank 4')
    call check(all(same(reshape(K4, [n_nodes]), K)) .and. all(same(reshape(x4, [n_nodes]), K_u(1, :))) .and. &
      all(same(reshape(y4, [n_nodes]), K_u(2, :))) .and. all(same(reshape(z4, [n_nodes]), K_u(3, :))), 'rank 4')
    K3 = 0.25d0
    K4 = 0.25d0
    call marks%add_resistance(R, K3, rim=RIIS_RIM_CUT)
    call marks%add_resistance(R, K4, rim=RIIS_RIM_CUT)
    call check(all(same(reshape(K3, [n_nodes]), K)) .and. all(same(reshape(K4, [n_nodes]), K)), 'K alone')
  end subroutine test_resistance

  ! A structured code has a halo around its nodes, and passes its arrays with the halo.
  subroutine test_halo()
    type(riis_mesh) :: grid
    type(riis_marks) :: found
    real(c_double), allocatable :: K(:), axis(:)
    real(c_double), allocatable, dimension(:, :, :) :: held, x, y, z
    integer :: i
    allocate (K(n_nodes), axis(m), held(0:m + 1, 0:m + 1, 0:m + 1))
    axis = [(-1.4d0 + 0.14d0 * i, i = 0, m - 1)]
    call grid%create_grid(axis, axis, axis, halo=1)
    call riis_mark_nodes(moving, grid, found, fields=RIIS_FIELD_VELOCITY)
    held = 0
    allocate (x, y, z, source=held)
    K = 0
    call found%add_resistance(R, held, x, y, z)
    call marks%add_resistance(R, K)
    call check(all(same(reshape(held(1:m, 1:m, 1:m), [n_nodes]), K)), 'K inside the halo')
    call check(all(abs(x(1:m, 1:m, 1:m) - held(1:m, 1:m, 1:m) * (-1)) < 1d-9 * (1 + held(1:m, 1:m, 1:m))) .and. &
      all(abs(y - 2 * held) < 1d-9 * (1 + held)) .and. all(abs(z + 3 * held) < 1d-9 * (1 + held)), 'K u_surface')
    held(1:m, 1:m, 1:m) = 0
    call check(maxval(abs(held)) <= 0, 'nothing in the halo')
    ! The interior is a section of the arrays that is not contiguous. The section's nodes are those of the mesh without a halo.
    call marks%add_resistance(R, held(1:m, 1:m, 1:m))
    call check(all(same(reshape(held(1:m, 1:m, 1:m), [n_nodes]), K)), 'a section of the array with a halo')
    call found%destroy()
    call grid%destroy()
  end subroutine test_halo

  subroutine test_reaction()
    type(riis_attachment) :: attachment
    real(c_double) :: force(3, 4), moment(3, 4), leaflets(3, 3, 4), about(3)
    real(c_double), allocatable :: edges(:, :, :)
    integer :: i
    call moving%get_attachment(attachment)
    allocate (edges(3, size(attachment%edges, 3), 4))
    force = 1
    moment = 1
    leaflets = 1
    edges = 1
    about = [0.5d0, -1d0, 2d0]
    call marks%add_reaction(R, velocity, weight, force(:, 1), moment=moment(:, 1), about=about, &
      leaflet_force=leaflets(:, :, 1), edges=attachment%edges, edge_force=edges(:, :, 1), rim=RIIS_RIM_CUT)
    call marks%add_reaction(R, velocity(1, :), velocity(2, :), velocity(3, :), weight, force(:, 2), moment=moment(:, 2), &
      about=about, leaflet_force=leaflets(:, :, 2), edges=attachment%edges, edge_force=edges(:, :, 2), rim=RIIS_RIM_CUT)
    call marks%add_reaction(R, u3, v3, w3, weight3, force(:, 3), moment=moment(:, 3), about=about, &
      leaflet_force=leaflets(:, :, 3), edges=attachment%edges, edge_force=edges(:, :, 3), rim=RIIS_RIM_CUT)
    call marks%add_reaction(R, u4, v4, w4, weight4, force(:, 4), moment=moment(:, 4), about=about, &
      leaflet_force=leaflets(:, :, 4), edges=attachment%edges, edge_force=edges(:, :, 4), rim=RIIS_RIM_CUT, status=status)
    call check_ok(status, 'a reaction of rank 4')
    call check(minval(abs(force(:, 1) - 1)) > 1d-6, 'there is a force')
    do i = 2, 4
      call check(all(same(force(:, i), force(:, 1))) .and. all(same(moment(:, i), moment(:, 1))), 'the same whole')
      call check(all(same(leaflets(:, :, i), leaflets(:, :, 1))), 'the same leaflets')
      call check(all(same(edges(:, :, i), edges(:, :, 1))), 'the same edges')
    end do
  end subroutine test_reaction

  subroutine test_vertices()
    type(riis_triangles) :: triangles
    real(c_double), allocatable :: force(:, :, :)
    integer :: i
    call moving%get_triangles(triangles)
    allocate (force(3, size(triangles%xyz, 2), 4))
    force = 1
    call marks%add_vertex_reaction(moving, R, velocity, weight, force(:, :, 1), rim=RIIS_RIM_CUT)
    call marks%add_vertex_reaction(moving, R, velocity(1, :), velocity(2, :), velocity(3, :), weight, force(:, :, 2), &
      rim=RIIS_RIM_CUT)
    call marks%add_vertex_reaction(moving, R, u3, v3, w3, weight3, force(:, :, 3), RIIS_AUTO, RIIS_RIM_CUT)
    call marks%add_vertex_reaction(moving, R, u4, v4, w4, weight4, force(:, :, 4), rim=RIIS_RIM_CUT, status=status)
    call check_ok(status, 'forces at vertices of rank 4')
    call check(maxval(abs(force(:, :, 1) - 1)) > 1d-6, 'there are forces at vertices')
    do i = 2, 4
      call check(all(same(force(:, :, i), force(:, :, 1))), 'the same vertices')
    end do
  end subroutine test_vertices

  subroutine test_band()
    type(riis_band_sums) :: sums(3)
    integer :: i
    call marks%band_sums(0d0, 0.3d0, velocity(3, :), weight, sums(1))
    call marks%band_sums(0d0, 0.3d0, w3, weight3, sums(2))
    call marks%band_sums(0d0, 0.3d0, w4, weight4, sums(3), status)
    call check_ok(status, 'sums of rank 4')
    call check(all(sums(1)%n_nodes > 100), 'there is a band')
    do i = 2, 3
      call check(all(same(sums(i)%sum, sums(1)%sum)) .and. all(same(sums(i)%weight, sums(1)%weight)) .and. &
        all(sums(i)%n_nodes == sums(1)%n_nodes), 'the same sums')
    end do
    call marks%band_sums(0d0, 0.3d0, w3, weight3(:, :, 2:), sums(2), status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of weight is 8820; there are 9261 values')
  end subroutine test_band

  subroutine test_refused()
    type(riis_marks) :: none
    real(c_double) :: force(3)
    real(c_double), allocatable :: K3(:, :, :), a(:), vertices(:, :)
    allocate (K3, source=u3)
    allocate (a, source=weight)
    allocate (vertices(3, 7))
    force = 1
    call none%add_resistance(R, K3, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call none%add_resistance(R, a, a(2:), a, a, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call marks%add_resistance(R, K3, u3, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'K_u_x, K_u_y and K_u_z are not all given')
    call marks%add_resistance(R, K3, u3, v3(:, :, 3:), w3, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of K_u_y is 8379; there are 9261 entries in K')
    call marks%add_resistance(R, a(2:), a, a, a, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of K_u_x is 9261; there are 9260 entries in K')
    call marks%add_resistance(R, a(2:), a(2:), a(2:), a(2:), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_nodes is 9260')
    call marks%add_resistance(-R, K3, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'resistance.R is -3')
    call none%add_reaction(R, u3, v3, w3, weight3, force, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the object marks was not created')
    call marks%add_reaction(R, a, a, a(3:), a, force, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of vz is 9259; there are 9261 weights')
    call marks%add_reaction(R, u3, v3, w3, weight3, force(:2), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of force is 2; it must be 3')
    call marks%add_reaction(R, u4, v4, w4, weight4, force, half_thickness=1d0, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'resistance.half_thickness is 1')
    call marks%add_vertex_reaction(moving, R, u4, v4(:, :, 2:, :), w4, weight4, vertices, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of vy is 8820; there are 9261 weights')
    call marks%add_vertex_reaction(moving, R, a, a, a, a, vertices, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_vertices is 7')
    call riis_mark_nodes(moving, mesh, marks)
    call marks%add_resistance(R, K3, u3, v3, w3, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'K_u_surface needs RIIS_FIELD_VELOCITY')
    call check(all(same(K3, reshape(velocity(1, :), [m, m, m]))) .and. all(same(u3, K3)) .and. all(same(a, weight)) .and. &
      all(same(force, 1d0)), 'refused calls write nothing')
  end subroutine test_refused
end program test_components
