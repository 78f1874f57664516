! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_calls.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> These procedures fill structs from plain arguments and call riis_c, for module riis. Arrays are contiguous. Users do not need
!! this module, and `use riis` does not give its names.
module riis_calls
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64
  use riis_c
  use riis_support, only: get_integer, location_of
  implicit none
  private
  public :: write_dense, add_resistance_to, add_reaction_to, add_vertex_reaction_to, band_sums_of, describe_ends, &
    get_resistance

contains

  !> Makes the library's struct of a resistance. The procedure does nothing after an error.
  subroutine get_resistance(R, half_thickness, rim, made, code)
    real(c_double), intent(in), optional :: R               !< Default NaN, which is refused where it counts.
    real(c_double), intent(in), optional :: half_thickness  !< Default RIIS_AUTO.
    class(*), intent(in), optional :: rim                   !< integer, RIIS_RIM_*. Default RIIS_RIM_ROUND.
    type(riis_resistance), intent(inout) :: made            !< Written on success.
    integer(riis_status), intent(inout) :: code             !< Unchanged on success.
    if (code == RIIS_OK) code = riis_resistance_init(made, c_sizeof(made))
    if (present(R)) made%R = R
    if (present(half_thickness)) made%half_thickness = half_thickness
    call get_integer(rim, 'rim', made%rim, code)
  end subroutine get_resistance

  !> Calls riis_marks_get_dense.
  function write_dense(marks, n_nodes, far_distance, mark, distance, triangle_id, leaflet_id) result(code)
    type(c_ptr), intent(in) :: marks                        !< A handle.
    integer(int64), intent(in) :: n_nodes                   !< The number of nodes of the marking.
    real(c_double), intent(in) :: far_distance              !< The distance of other nodes.
    integer(int8), intent(inout), optional :: mark(*)       !< (n_nodes).
    real(c_double), intent(inout), optional :: distance(*)  !< (n_nodes).
    integer(int64), intent(inout), optional :: triangle_id(*) !< (n_nodes).
    integer(int32), intent(inout), optional :: leaflet_id(*) !< (n_nodes).
    integer(riis_status) :: code                            !< RIIS_OK or the error.
    type(riis_dense_arrays) :: arrays
    code = riis_dense_arrays_init(arrays, c_sizeof(arrays))
    if (code /= RIIS_OK) return
    arrays%n_nodes = n_nodes
    arrays%far_distance = far_distance
    if (present(mark)) arrays%mark = location_of(mark)
    if (present(distance)) arrays%distance = location_of(distance)
    if (present(triangle_id)) arrays%triangle_id = location_of(triangle_id)
    if (present(leaflet_id)) arrays%leaflet_id = location_of(leaflet_id)
    code = riis_marks_get_dense(marks, arrays)
  end function write_dense

  !> Calls riis_marks_add_resistance.
  function add_resistance_to(marks, resistance, n_nodes, K, K_u_surface, K_u_x, K_u_y, K_u_z) result(code)
    type(c_ptr), intent(in) :: marks                        !< A handle.
    type(riis_resistance), intent(in) :: resistance         !< From its init function.
    integer(int64), intent(in) :: n_nodes                   !< The number of nodes of the marking.
    real(c_double), intent(inout), optional :: K(*)         !< (n_nodes).
    real(c_double), intent(inout), optional :: K_u_surface(3, *) !< (3, n_nodes).
    real(c_double), intent(inout), optional :: K_u_x(*)     !< (n_nodes), with K_u_y and K_u_z in place of K_u_surface.
    real(c_double), intent(inout), optional :: K_u_y(*)     !< (n_nodes).
    real(c_double), intent(inout), optional :: K_u_z(*)     !< (n_nodes).
    integer(riis_status) :: code                            !< RIIS_OK or the error.
    type(riis_resistance_arrays) :: arrays
    integer :: i
    code = riis_resistance_arrays_init(arrays, c_sizeof(arrays))
    if (code /= RIIS_OK) return
    arrays%n_nodes = n_nodes
    if (present(K)) arrays%K = location_of(K)
    if (present(K_u_surface)) then
      do i = 1, 3
        arrays%K_u_surface(i) = location_of(K_u_surface(i, 1))
      end do
      arrays%K_u_surface_stride = 3
    end if
    if (present(K_u_x)) arrays%K_u_surface(1) = location_of(K_u_x)
    if (present(K_u_y)) arrays%K_u_surface(2) = location_of(K_u_y)
    if (present(K_u_z)) arrays%K_u_surface(3) = location_of(K_u_z)
    code = riis_marks_add_resistance(marks, resistance, arrays)
  end function add_resistance_to

  !> Calls riis_marks_add_reaction.
  function add_reaction_to(marks, resistance, n_nodes, weight, reaction, velocity, vx, vy, vz) result(code)
    type(c_ptr), intent(in) :: marks                        !< A handle.
    type(riis_resistance), intent(in) :: resistance         !< From its init function.
    integer(int64), intent(in) :: n_nodes                   !< The number of nodes of the marking.
    real(c_double), intent(in) :: weight(*)                 !< (n_nodes).
    type(riis_reaction), intent(in) :: reaction             !< The init function fills it, and the call adds to its sums.
    real(c_double), intent(in), optional :: velocity(3, *)  !< (3, n_nodes).
    real(c_double), intent(in), optional :: vx(*)           !< (n_nodes), with vy and vz in place of velocity.
    real(c_double), intent(in), optional :: vy(*)           !< (n_nodes).
    real(c_double), intent(in), optional :: vz(*)           !< (n_nodes).
    integer(riis_status) :: code                            !< RIIS_OK or the error.
    type(riis_flow_arrays) :: flow
    code = describe_flow(n_nodes, weight, velocity, vx, vy, vz, flow)
    if (code == RIIS_OK) code = riis_marks_add_reaction(marks, resistance, flow, reaction)
  end function add_reaction_to

  !> Calls riis_marks_add_vertex_reaction.
  function add_vertex_reaction_to(marks, surface, resistance, n_nodes, weight, n_vertices, vertex_force, velocity, vx, vy, &
      vz) result(code)
    type(c_ptr), intent(in) :: marks                        !< A handle.
    type(c_ptr), intent(in) :: surface                      !< A handle.
    type(riis_resistance), intent(in) :: resistance         !< From its init function.
    integer(int64), intent(in) :: n_nodes                   !< The number of nodes of the marking.
    real(c_double), intent(in) :: weight(*)                 !< (n_nodes).
    integer(int64), intent(in) :: n_vertices                !< The surface's number of vertices.
    real(c_double), intent(inout) :: vertex_force(3, *)     !< (3, n_vertices): forces are added.
    real(c_double), intent(in), optional :: velocity(3, *)  !< (3, n_nodes).
    real(c_double), intent(in), optional :: vx(*)           !< (n_nodes), with vy and vz in place of velocity.
    real(c_double), intent(in), optional :: vy(*)           !< (n_nodes).
    real(c_double), intent(in), optional :: vz(*)           !< (n_nodes).
    integer(riis_status) :: code                            !< RIIS_OK or the error.
    type(riis_flow_arrays) :: flow
    code = describe_flow(n_nodes, weight, velocity, vx, vy, vz, flow)
    if (code == RIIS_OK) code = riis_marks_add_vertex_reaction(marks, surface, resistance, flow, n_vertices, vertex_force)
  end function add_vertex_reaction_to

  ! Describes the flow at the nodes for C, without a copy.
  function describe_flow(n_nodes, weight, velocity, vx, vy, vz, flow) result(code)
    integer(int64), intent(in) :: n_nodes
    real(c_double), intent(in) :: weight(*)
    real(c_double), intent(in), optional :: velocity(3, *), vx(*), vy(*), vz(*)
    type(riis_flow_arrays), intent(inout) :: flow
    integer(riis_status) :: code
    integer :: i
    code = riis_flow_arrays_init(flow, c_sizeof(flow))
    if (code /= RIIS_OK) return
    flow%n_nodes = n_nodes
    if (present(velocity)) then
      do i = 1, 3
        flow%velocity(i) = location_of(velocity(i, 1))
      end do
      flow%velocity_stride = 3
    end if
    if (present(vx)) flow%velocity(1) = location_of(vx)
    if (present(vy)) flow%velocity(2) = location_of(vy)
    if (present(vz)) flow%velocity(3) = location_of(vz)
    flow%weight = location_of(weight)
  end function describe_flow

  !> Calls riis_marks_get_band_sums.
  function band_sums_of(marks, inner, outer, n_nodes, value, weight, sums) result(code)
    type(c_ptr), intent(in) :: marks                        !< A handle.
    real(c_double), intent(in) :: inner                     !< Mesh units.
    real(c_double), intent(in) :: outer                     !< Mesh units.
    integer(int64), intent(in) :: n_nodes                   !< The number of nodes of the marking.
    real(c_double), intent(in) :: value(*)                  !< (n_nodes).
    real(c_double), intent(in) :: weight(*)                 !< (n_nodes).
    type(riis_band_sums), intent(inout) :: sums             !< Unchanged on an error.
    integer(riis_status) :: code                            !< RIIS_OK or the error.
    type(riis_band) :: band
    code = riis_band_init(band, c_sizeof(band))
    if (code /= RIIS_OK) return
    band%inner = inner
    band%outer = outer
    band%n_nodes = n_nodes
    band%value = location_of(value)
    band%weight = location_of(weight)
    code = riis_marks_get_band_sums(marks, band, sums, c_sizeof(sums))
  end function band_sums_of

  !> Describes the ends of paths, for riis_find_passage and riis_find_first_passage.
  function describe_ends(from, to, ends) result(code)
    integer(int64), intent(in), contiguous :: from(:)       !< Nodes where paths begin, from 0. It must live as long as `ends`.
    integer(int64), intent(in), contiguous :: to(:)         !< Nodes where paths end, likewise.
    type(riis_passage_ends), intent(inout) :: ends          !< Written on success.
    integer(riis_status) :: code                            !< RIIS_OK or the error.
    code = riis_passage_ends_init(ends, c_sizeof(ends))
    if (code /= RIIS_OK) return
    ends%n_from = size(from, kind=int64)
    ends%from = location_of(from)
    ends%n_to = size(to, kind=int64)
    ends%to = location_of(to)
  end function describe_ends
end module riis_calls
