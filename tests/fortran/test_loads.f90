! SPDX-License-Identifier: Apache-2.0
! Tests module riis: forces of the flow at the vertices of a surface, and the forces of its leaflets at nodes of tissue. The sums
! and moments at the nodes must be those of the leaflets.
program test_loads
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use box, only: make_box, free_box, xyz
  use checks
  use riis
  implicit none
  real(c_double), parameter :: R = 3d0, eps = 0.3d0, radius = 0.3d0, about(3) = [0.5d0, -1d0, 2d0]
  type(riis_valve) :: valve
  type(riis_surface) :: cusps
  type(riis_mesh) :: mesh
  type(riis_marks) :: marks
  type(riis_triangles) :: triangles
  type(riis_attachment) :: held
  real(c_double), allocatable :: velocity(:, :), weight(:)
  real(c_double) :: force(3, 3), moment(3, 3)
  integer(riis_status) :: status
  integer :: i

  call make_box()
  call mesh%create(xyz)
  call valve%create('trileaflet')
  call cusps%create(valve, half_thickness=eps)
  call cusps%get_triangles(triangles)
  call cusps%get_attachment(held)
  allocate (weight(size(xyz, 2)), velocity(3, size(xyz, 2)))
  weight = 1 + xyz(1, :)**2
  do i = 1, 3
    velocity(i, :) = cos(i + xyz(2, :)) + xyz(3, :)
  end do
  call riis_mark_nodes(cusps, mesh, marks, fields=RIIS_FIELD_POINT + RIIS_FIELD_BARYCENTRIC)
  force = 0
  moment = 0
  call marks%add_reaction(R, velocity, weight, leaflet_force=force, leaflet_moment=moment, about=about)
  call test_vertices()
  call test_tissue()
  call marks%destroy()
  call mesh%destroy()
  call cusps%destroy()
  call valve%destroy()
  call free_box()
  deallocate (velocity, weight)
  call finish()

contains

  ! Returns the moment of forces at points.
  function moment_of(points, forces) result(sum_of)
    real(c_double), intent(in) :: points(:, :), forces(:, :)
    real(c_double) :: sum_of(3), arm(3)
    integer :: k
    sum_of = 0
    do k = 1, size(points, 2)
      arm = points(:, k) - about
      sum_of = sum_of + cshift(arm, 1) * cshift(forces(:, k), 2) - cshift(arm, 2) * cshift(forces(:, k), 1)
    end do
  end function moment_of

  subroutine test_vertices()
    type(riis_surface) :: none
    real(c_double), allocatable :: at(:, :)
    real(c_double) :: size_of
    allocate (at(3, 2 * size(triangles%xyz, 2)), source=0d0)
    call marks%add_vertex_reaction(cusps, R, velocity, weight, at(:, ::2)) ! a section is copied
    call check(all(same(at(:, 2::2), 0d0)), 'other columns keep their values')
    call marks%add_vertex_reaction(cusps, R, velocity, weight, at(:, 2::2), eps, RIIS_RIM_ROUND)
    call check(all(same(at(:, 2::2), at(:, ::2))), 'the defaults')
    size_of = sum(abs(at))
    call check(size_of > 1, 'there is a force')
    call check(all(abs(sum(at(:, ::2), 2) - sum(force, 2)) < 1d-12 * size_of), 'the vertices have the force')
    call check(all(abs(moment_of(triangles%xyz, at(:, ::2)) - sum(moment, 2)) < 1d-11 * size_of), 'and the moment')
    call marks%add_vertex_reaction(cusps, R, velocity, weight, at(:2, :), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of vertex_force is (2, ')
    call marks%add_vertex_reaction(cusps, R, velocity, weight, at(:, :4), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'n_vertices is 4; the surface has ')
    call marks%add_vertex_reaction(none, R, velocity, weight, at, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the surface was not created')
    call marks%add_vertex_reaction(cusps, R, velocity(:, 2:), weight, at, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of velocity is (3, ')
  end subroutine test_vertices

  subroutine test_tissue()
    real(c_double), allocatable :: tissue(:, :), at(:, :), alone(:, :), share(:)
    real(c_double) :: sums(11, 3), size_of
    integer :: n, half
    n = 8 * size(held%edges, 3)
    allocate (tissue(3, n), at(3, n), alone(3, n), share(n))
    do i = 1, n
      tissue(:, i) = held%edges(:, 1, 1 + (i - 1) / 8) + 0.15d0 * [cos(7d0 * i), sin(5d0 * i), cos(3d0 * i + 1)]
      share(i) = 1 + mod(i, 3)
    end do
    half = n / 2

    ! Each of two ranks has a part of the nodes. The sums of both ranks are added.
    sums = 0
    call riis_loads_add_sums(tissue(:, :half), radius, held%edges, sums, held%leaflet_id, share(:half))
    call riis_loads_add_sums(tissue(:, half + 1:), radius, held%edges, sums, held%leaflet_id, share(half + 1:), n_threads=2)
    at = 0
    call riis_loads_add_forces(tissue(:, :half), radius, held%edges, force, moment, sums, at(:, :half), about, &
      held%leaflet_id, share(:half))
    call riis_loads_add_forces(tissue(:, half + 1:), radius, held%edges, force, moment, sums, at(:, half + 1:), about, &
      held%leaflet_id, share(half + 1:), n_threads=2_int64)
    size_of = sum(abs(at))
    call check(all(abs(sum(at, 2) - sum(force, 2)) < 1d-12 * size_of), 'the tissue has the force')
    call check(all(abs(moment_of(tissue, at) - sum(moment, 2)) < 1d-11 * size_of), 'and the moment')
    sums = 0
    call riis_loads_add_sums(tissue, radius, held%edges, sums, held%leaflet_id, share)
    alone = 0
    call riis_loads_add_forces(tissue, radius, held%edges, force, moment, sums, alone, about, held%leaflet_id, share)
    call check(all(abs(alone - at) < 1d-12 * maxval(abs(at))), 'one rank has the same forces')

    ! If leaflets, weights and a point are left out, all edges hold each leaflet.
    sums = 0
    call riis_loads_add_sums(tissue, radius, held%edges, sums)
    call check(all(same(sums(:, 2), sums(:, 1))) .and. sums(1, 1) > 100, 'all edges hold all leaflets')
    at = 0
    call riis_loads_add_forces(tissue, radius, held%edges, force, moment, sums, at)
    call check(all(abs(sum(at, 2) - sum(force, 2)) < 1d-12 * sum(abs(at))), 'the force without the optional arguments')

    call riis_loads_add_sums(tissue(:2, :), radius, held%edges, sums, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of xyz is (2, ')
    call riis_loads_add_sums(tissue, 0d0, held%edges, sums, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'loads.radius is 0; it must be from 1e-50 to 1e+50')
    call riis_loads_add_sums(tissue, radius, held%edges(:, :, :0), sums, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'a surface without an attachment needs edges of the caller')
    call riis_loads_add_sums(tissue, radius, reshape(tissue(:, :4), [3, 1, 4]), sums, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of edges is (3, 1, 4); it must be (3, 2, n_edges)')
    call riis_loads_add_sums(tissue, radius, held%edges, force, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of sums is (3, 3); it must be (11, 3)')
    call riis_loads_add_sums(tissue, radius, held%edges, sums, held%leaflet_id(:3), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of edge_leaflet_id is 3; there are ')
    call riis_loads_add_sums(tissue, radius, held%edges, sums, weight=share(:5), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of weight is 5; there are ')
    call riis_loads_add_forces(tissue, radius, held%edges, force(:, :2), moment, sums, at, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of leaflet_force is (3, 2); it must be (3, 3)')
    call riis_loads_add_forces(tissue, radius, held%edges, force, moment(:2, :), sums, at, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of leaflet_moment is (2, 3); it must be (3, 3)')
    call riis_loads_add_forces(tissue, radius, held%edges, force, moment, sums, at(:, :7), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the shape of node_force is (3, 7); it must be (3, ')
    call riis_loads_add_forces(tissue, radius, held%edges, force, moment, sums, at, about(:2), status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'the size of about is 2; there are 3 x, y, z')
    sums = 0
    call riis_loads_add_forces(tissue, radius, held%edges, force, moment, sums, at, status=status)
    call check_refused(status, RIIS_INVALID_ARGUMENT, 'tissue has 0 nodes within the radius 0.3 of the edges that hold leaflet 0')
  end subroutine test_tissue
end program test_loads
