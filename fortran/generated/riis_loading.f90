! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_loading.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The forces of the leaflets at nodes of tissue: riis_loads_* of riis.h, as a part of module riis.
module riis_loading
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_loads, riis_points, riis_status, RIIS_OK, c_loads_add_sums => riis_loads_add_sums, &
    c_loads_add_forces => riis_loads_add_forces, riis_loads_init, riis_points_init
  use riis_support
  implicit none
  private
  public :: riis_loads_add_sums, riis_loads_add_forces

  !> Adds the sums over nodes of tissue that riis_loads_add_forces needs.
  interface riis_loads_add_sums
    module procedure add_sums
  end interface riis_loads_add_sums

  !> Adds the forces of the leaflets at nodes of tissue.
  interface riis_loads_add_forces
    module procedure add_forces
  end interface riis_loads_add_forces

contains

  !> Adds the sums over nodes of tissue that riis_loads_add_forces needs. Each rank passes its nodes, and the ranks add their sums
  !! by a reduction. Errors: RIIS_INVALID_ARGUMENT naming the argument, or the edge, node or weight, counted from 0.
  subroutine add_sums(xyz, radius, edges, sums, edge_leaflet_id, weight, n_threads, status)
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_nodes): the nodes, in the frame of the edges.
    real(c_double), intent(in) :: radius                    !< Mesh units: nodes nearer than this to a leaflet's edges get its
                                                            !! force.
    real(c_double), intent(in), contiguous, target :: edges(:, :, :) !< (3, 2, n_edges): both ends of each edge, as from
                                                            !! %get_attachment.
    real(c_double), intent(inout), contiguous :: sums(:, :) !< (11, n_leaflets): sums are added; leaflet 0 has column 1.
    integer(int32), intent(in), contiguous, optional, target :: edge_leaflet_id(:) !< (n_edges): the leaflet that the edge holds.
                                                            !! All edges hold a leaflet without an edge of its own. Default: all
                                                            !! edges hold all leaflets.
    real(c_double), intent(in), contiguous, optional :: weight(:) !< (n_nodes): the area or volume around a node, 0 for nodes of
                                                            !! other ranks. Default 1.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_loads) :: loads
    type(riis_points) :: nodes
    call describe(xyz, radius, edges, sums, edge_leaflet_id, weight, n_threads, loads, nodes, code)
    if (code == RIIS_OK) code = c_loads_add_sums(loads, nodes, weight, sums)
    call finish(code, status)
  end subroutine add_sums

  !> Adds the forces of the leaflets at nodes of tissue. For each leaflet, the sum of the forces is leaflet_force, and their
  !! moment is leaflet_moment. Errors: as for riis_loads_add_sums; RIIS_INVALID_ARGUMENT also for a leaflet with fewer than three
  !! nodes within the radius, and for a leaflet whose nodes lie nearly on a line.
  subroutine add_forces(xyz, radius, edges, leaflet_force, leaflet_moment, sums, node_force, about, edge_leaflet_id, &
      weight, n_threads, status)
    real(c_double), intent(in), target :: xyz(:, :)         !< (3, n_nodes), as for riis_loads_add_sums.
    real(c_double), intent(in) :: radius                    !< As for riis_loads_add_sums.
    real(c_double), intent(in), contiguous, target :: edges(:, :, :) !< (3, 2, n_edges), as for riis_loads_add_sums.
    real(c_double), intent(in), contiguous, target :: leaflet_force(:, :) !< (3, n_leaflets), from %add_reaction, the sum over all
                                                            !! ranks.
    real(c_double), intent(in), contiguous, target :: leaflet_moment(:, :) !< (3, n_leaflets), from %add_reaction, the sum over
                                                            !! all ranks.
    real(c_double), intent(in), contiguous :: sums(:, :)    !< (11, n_leaflets), from riis_loads_add_sums, the sum over all ranks.
    real(c_double), intent(inout), contiguous :: node_force(:, :) !< (3, n_nodes): forces are added.
    real(c_double), intent(in), optional :: about(:)        !< (3): the point of leaflet_moment. Default 0.
    integer(int32), intent(in), contiguous, optional, target :: edge_leaflet_id(:) !< (n_edges), as for riis_loads_add_sums.
    real(c_double), intent(in), contiguous, optional :: weight(:) !< (n_nodes), as for riis_loads_add_sums.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: as many as there is work for.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    integer(riis_status) :: code
    type(riis_loads) :: loads
    type(riis_points) :: nodes
    call describe(xyz, radius, edges, sums, edge_leaflet_id, weight, n_threads, loads, nodes, code)
    call check_columns(leaflet_force, 3, size(sums, 2, int64), 'leaflet_force', code)
    call check_columns(leaflet_moment, 3, size(sums, 2, int64), 'leaflet_moment', code)
    call check_columns(node_force, 3, size(xyz, 2, int64), 'node_force', code)
    if (present(about) .and. code == RIIS_OK) code = check_size(size(about, kind=int64), 3_int64, 'about', 'x, y, z')
    if (code == RIIS_OK) then
      if (present(about)) loads%about = about
      loads%leaflet_force = location_of(leaflet_force)
      loads%leaflet_moment = location_of(leaflet_moment)
      code = c_loads_add_forces(loads, nodes, weight, sums, node_force)
    end if
    call finish(code, status)
  end subroutine add_forces

  ! Checks the shapes of the arrays, and describes the edges and the nodes for C, without a copy.
  subroutine describe(xyz, radius, edges, sums, edge_leaflet_id, weight, n_threads, loads, nodes, code)
    real(c_double), intent(in), target :: xyz(:, :)
    real(c_double), intent(in) :: radius
    real(c_double), intent(in), contiguous, target :: edges(:, :, :)
    real(c_double), intent(in) :: sums(:, :)
    integer(int32), intent(in), contiguous, optional, target :: edge_leaflet_id(:)
    real(c_double), intent(in), optional :: weight(:)
    class(*), intent(in), optional :: n_threads
    type(riis_loads), intent(inout) :: loads
    type(riis_points), intent(inout) :: nodes
    integer(riis_status), intent(out) :: code
    type(strided_points) :: points
    call points_of(xyz, 'xyz', points, code)
    if (code == RIIS_OK .and. (size(edges, 1) /= 3 .or. size(edges, 2) /= 2)) code = refuse('the shape of edges is (' // &
      text_of(size(edges, 1)) // ', ' // text_of(size(edges, 2)) // ', ' // text_of(size(edges, 3)) // &
      '); it must be (3, 2, n_edges)')
    call check_columns(sums, 11, size(sums, 2, int64), 'sums', code)
    if (present(edge_leaflet_id) .and. code == RIIS_OK) &
      code = check_size(size(edge_leaflet_id, kind=int64), size(edges, 3, int64), 'edge_leaflet_id', 'edges')
    if (present(weight) .and. code == RIIS_OK) code = check_size(size(weight, kind=int64), points%n, 'weight', 'nodes')
    if (code == RIIS_OK) code = riis_loads_init(loads, c_sizeof(loads))
    if (code == RIIS_OK) code = riis_points_init(nodes, c_sizeof(nodes))
    if (code /= RIIS_OK) return
    loads%radius = radius
    loads%n_leaflets = size(sums, 2, int64)
    loads%n_edges = size(edges, 3, int64)
    loads%edges = location_of(edges)
    if (present(edge_leaflet_id)) loads%edge_leaflet_id = location_of(edge_leaflet_id)
    nodes%n_points = points%n
    nodes%x = points%x
    nodes%y = points%y
    nodes%z = points%z
    nodes%stride = points%stride
    call get_integer(n_threads, 'n_threads', loads%n_threads, code)
  end subroutine describe
end module riis_loading
