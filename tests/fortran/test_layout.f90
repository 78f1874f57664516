! SPDX-License-Identifier: Apache-2.0
! The derived types of riis_c lie in memory as the structs of riis.h do, field by field, and the real constants are the
! same bits. The fields are listed here by hand, the C half of the comparison comes from riis.h by fortran/bindings/generate.py.
program test_layout
  use, intrinsic :: iso_c_binding
  use checks
  use c_twin
  use riis_c
  implicit none
  type(riis_patches), target :: pa
  type(riis_parameter), target :: p
  type(riis_surface_options), target :: so
  type(riis_surface_arrays), target :: sa
  type(riis_keyframe_arrays), target :: ka
  type(riis_surface_info), target :: si
  type(riis_closest), target :: c
  type(riis_closest_options), target :: co
  type(riis_closest_arrays), target :: ca
  type(riis_csr), target :: cs
  type(riis_mesh_cells), target :: ce
  type(riis_mesh_faces), target :: fa
  type(riis_mark_options), target :: mo
  type(riis_mark_stats), target :: ms
  integer :: n_compared = 0
  type(riis_leaks), target :: lk
  type(riis_crossing_options), target :: xo
  type(riis_crossings), target :: xs
  type(riis_passage), target :: pg
  type(riis_mark_fields), target :: mf
  type(riis_resistance), target :: re
  type(riis_band_sums), target :: bs
  type(riis_opening_table), target :: ot
  type(riis_opening_times), target :: oi
  type(riis_opening_switch), target :: ow
  type(riis_opening_switch_state), target :: os
  type(riis_opening_angle), target :: oa
  type(riis_opening_angle_state), target :: og

  call compare('riis_patches', c_sizeof(pa), c_loc(pa), [at(c_loc(pa%struct_size)), at(c_loc(pa%n_curves)), &
    at(c_loc(pa%degree)), at(c_loc(pa%control)), at(c_loc(pa%n_patches)), at(c_loc(pa%curve_id)), &
    at(c_loc(pa%reversed)), at(c_loc(pa%leaflet_id)), at(c_loc(pa%index_base)), at(c_loc(pa%reserved))])
  call compare('riis_parameter', c_sizeof(p), c_loc(p), [at(c_loc(p%name)), at(c_loc(p%unit)), &
    at(c_loc(p%description)), at(c_loc(p%n_values)), at(c_loc(p%default_values)), at(c_loc(p%minimum)), &
    at(c_loc(p%maximum))])
  call compare('riis_surface_options', c_sizeof(so), c_loc(so), [at(c_loc(so%struct_size)), &
    at(c_loc(so%half_thickness)), at(c_loc(so%tolerance)), at(c_loc(so%scale)), at(c_loc(so%rotation_axis)), &
    at(c_loc(so%rotation_angle)), at(c_loc(so%translation)), at(c_loc(so%zero_area)), at(c_loc(so%flip_normals)), &
    at(c_loc(so%distance)), at(c_loc(so%n_threads)), at(c_loc(so%measure_tolerance)), &
    at(c_loc(so%triangulation)), at(c_loc(so%reserved))])
  call compare('riis_surface_arrays', c_sizeof(sa), c_loc(sa), [at(c_loc(sa%struct_size)), at(c_loc(sa%n_vertices)), &
    at(c_loc(sa%x)), at(c_loc(sa%y)), at(c_loc(sa%z)), at(c_loc(sa%stride)), at(c_loc(sa%n_faces)), &
    at(c_loc(sa%vertex_ids)), at(c_loc(sa%vertex_id_bits)), at(c_loc(sa%index_base)), &
    at(c_loc(sa%corners_per_face)), at(c_loc(sa%reserved)), at(c_loc(sa%leaflet_id)), at(c_loc(sa%vx)), &
    at(c_loc(sa%vy)), at(c_loc(sa%vz)), at(c_loc(sa%velocity_stride))])
  call compare('riis_keyframe_arrays', c_sizeof(ka), c_loc(ka), [at(c_loc(ka%struct_size)), at(c_loc(ka%n_keys)), &
    at(c_loc(ka%n_vertices)), at(c_loc(ka%time)), at(c_loc(ka%xyz)), at(c_loc(ka%period)), &
    at(c_loc(ka%interpolation)), at(c_loc(ka%reserved))])
  call compare('riis_surface_info', c_sizeof(si), c_loc(si), [at(c_loc(si%n_vertices)), at(c_loc(si%n_triangles)), &
    at(c_loc(si%n_zero_area)), at(c_loc(si%half_thickness)), at(c_loc(si%area)), at(c_loc(si%lower)), &
    at(c_loc(si%upper)), at(c_loc(si%seconds_triangles)), at(c_loc(si%seconds_scene)), &
    at(c_loc(si%error_bound)), at(c_loc(si%velocity_error_bound))])
  call compare('riis_crossing_options', c_sizeof(xo), c_loc(xo), [at(c_loc(xo%struct_size)), at(c_loc(xo%depth)), &
    at(c_loc(xo%n_threads)), at(c_loc(xo%reserved))])
  call compare('riis_crossings', c_sizeof(xs), c_loc(xs), [at(c_loc(xs%n_pairs)), at(c_loc(xs%length)), &
    at(c_loc(xs%depth)), at(c_loc(xs%point)), at(c_loc(xs%triangle_id)), at(c_loc(xs%leaflet_id)), &
    at(c_loc(xs%seconds))])
  call compare('riis_closest', c_sizeof(c), c_loc(c), [at(c_loc(c%distance)), at(c_loc(c%point)), &
    at(c_loc(c%barycentric)), at(c_loc(c%normal)), at(c_loc(c%triangle_id)), at(c_loc(c%leaflet_id)), &
    at(c_loc(c%side))])
  call compare('riis_closest_options', c_sizeof(co), c_loc(co), [at(c_loc(co%struct_size)), &
    at(c_loc(co%distance_limit)), at(c_loc(co%far_distance)), at(c_loc(co%n_threads)), at(c_loc(co%reserved)), &
    at(c_loc(co%point_mask)), at(c_loc(co%n_point_ids)), at(c_loc(co%point_ids))])
  call compare('riis_closest_arrays', c_sizeof(ca), c_loc(ca), [at(c_loc(ca%struct_size)), at(c_loc(ca%distance)), &
    at(c_loc(ca%point)), at(c_loc(ca%barycentric)), at(c_loc(ca%normal)), at(c_loc(ca%triangle_id)), &
    at(c_loc(ca%leaflet_id)), at(c_loc(ca%side))])
  call compare('riis_csr', c_sizeof(cs), c_loc(cs), [at(c_loc(cs%struct_size)), at(c_loc(cs%n_rows)), &
    at(c_loc(cs%n_all)), at(c_loc(cs%offsets)), at(c_loc(cs%columns)), at(c_loc(cs%offset_bits)), &
    at(c_loc(cs%column_bits)), at(c_loc(cs%index_base)), at(c_loc(cs%reserved))])
  call compare('riis_mesh_cells', c_sizeof(ce), c_loc(ce), [at(c_loc(ce%struct_size)), at(c_loc(ce%n_nodes)), &
    at(c_loc(ce%n_cells)), at(c_loc(ce%node_ids)), at(c_loc(ce%offsets)), at(c_loc(ce%nodes_per_cell)), &
    at(c_loc(ce%id_bits)), at(c_loc(ce%index_base)), at(c_loc(ce%n_threads))])
  call compare('riis_mesh_faces', c_sizeof(fa), c_loc(fa), [at(c_loc(fa%struct_size)), at(c_loc(fa%n_cells)), &
    at(c_loc(fa%n_faces)), at(c_loc(fa%owner)), at(c_loc(fa%neighbor)), at(c_loc(fa%stride)), at(c_loc(fa%id_bits)), &
    at(c_loc(fa%index_base)), at(c_loc(fa%n_threads)), at(c_loc(fa%reserved))])
  call compare('riis_mark_options', c_sizeof(mo), c_loc(mo), [at(c_loc(mo%struct_size)), &
    at(c_loc(mo%distance_limit)), at(c_loc(mo%node_mask)), at(c_loc(mo%search)), at(c_loc(mo%n_threads)), &
    at(c_loc(mo%instructions)), at(c_loc(mo%reserved)), at(c_loc(mo%fields)), at(c_loc(mo%reserved2))])
  call compare('riis_mark_stats', c_sizeof(ms), c_loc(ms), [at(c_loc(ms%n_nodes)), at(c_loc(ms%n_marked)), &
    at(c_loc(ms%n_within_limit)), at(c_loc(ms%n_queries)), at(c_loc(ms%seconds)), at(c_loc(ms%search)), &
    at(c_loc(ms%n_threads)), at(c_loc(ms%complete)), at(c_loc(ms%instructions)), at(c_loc(ms%n_unreached))])
  call compare('riis_leaks', c_sizeof(lk), c_loc(lk), [at(c_loc(lk%n_edges)), at(c_loc(lk%longest_node_id)), &
    at(c_loc(lk%longest_length)), at(c_loc(lk%longest_middle)), at(c_loc(lk%half_thickness)), at(c_loc(lk%seconds))])
  call compare('riis_passage', c_sizeof(pg), c_loc(pg), [at(c_loc(pg%node_id)), at(c_loc(pg%distance)), &
    at(c_loc(pg%point)), at(c_loc(pg%seconds)), at(c_loc(pg%state)), at(c_loc(pg%reserved))])
  call compare('riis_mark_fields', c_sizeof(mf), c_loc(mf), [at(c_loc(mf%n_nodes)), at(c_loc(mf%point)), &
    at(c_loc(mf%normal)), at(c_loc(mf%barycentric)), at(c_loc(mf%uv)), at(c_loc(mf%velocity)), at(c_loc(mf%side)), &
    at(c_loc(mf%rim)), at(c_loc(mf%patch_id))])
  call compare('riis_resistance', c_sizeof(re), c_loc(re), [at(c_loc(re%struct_size)), at(c_loc(re%resistance)), &
    at(c_loc(re%half_thickness)), at(c_loc(re%rim)), at(c_loc(re%reserved))])
  call compare('riis_band_sums', c_sizeof(bs), c_loc(bs), [at(c_loc(bs%sum)), at(c_loc(bs%weight)), &
    at(c_loc(bs%n_nodes))])
  call compare('riis_opening_table', c_sizeof(ot), c_loc(ot), [at(c_loc(ot%struct_size)), at(c_loc(ot%n_keys)), &
    at(c_loc(ot%time)), at(c_loc(ot%opening)), at(c_loc(ot%period)), at(c_loc(ot%interpolation)), &
    at(c_loc(ot%reserved))])
  call compare('riis_opening_times', c_sizeof(oi), c_loc(oi), [at(c_loc(oi%struct_size)), &
    at(c_loc(oi%opening_start)), at(c_loc(oi%opening_duration)), at(c_loc(oi%closing_start)), &
    at(c_loc(oi%closing_duration)), at(c_loc(oi%closed)), at(c_loc(oi%open)), at(c_loc(oi%period))])
  call compare('riis_opening_switch', c_sizeof(ow), c_loc(ow), [at(c_loc(ow%struct_size)), &
    at(c_loc(ow%opening_duration)), at(c_loc(ow%closing_duration)), at(c_loc(ow%open_above)), &
    at(c_loc(ow%close_below)), at(c_loc(ow%filter_time)), at(c_loc(ow%dwell_time))])
  call compare('riis_opening_switch_state', c_sizeof(os), c_loc(os), [at(c_loc(os%struct_size)), at(c_loc(os%time)), &
    at(c_loc(os%opening)), at(c_loc(os%rate)), at(c_loc(os%progress)), at(c_loc(os%pressure_difference)), &
    at(c_loc(os%flow)), at(c_loc(os%since)), at(c_loc(os%phase)), at(c_loc(os%reserved))])
  call compare('riis_opening_angle', c_sizeof(oa), c_loc(oa), [at(c_loc(oa%struct_size)), &
    at(c_loc(oa%pressure_gain)), at(c_loc(oa%flow_gain)), at(c_loc(oa%friction)), at(c_loc(oa%vortex_gain)), &
    at(c_loc(oa%angle_min)), at(c_loc(oa%angle_max))])
  call compare('riis_opening_angle_state', c_sizeof(og), c_loc(og), [at(c_loc(og%struct_size)), at(c_loc(og%time)), &
    at(c_loc(og%opening)), at(c_loc(og%rate)), at(c_loc(og%angle)), at(c_loc(og%angle_rate)), &
    at(c_loc(og%pressure_difference)), at(c_loc(og%flow))])

  call check(n_compared == twin_n_layouts(), 'every struct of riis.h is compared')

  call check(transfer(RIIS_AUTO, 0_c_int64_t) == transfer(twin_auto(), 0_c_int64_t), 'RIIS_AUTO')
  call check(transfer(RIIS_FAR_DISTANCE, 0_c_int64_t) == transfer(twin_far_distance(), 0_c_int64_t), &
    'RIIS_FAR_DISTANCE')
  call finish()

contains

  integer(c_intptr_t) function at(field)
    type(c_ptr), intent(in) :: field
    at = transfer(field, 0_c_intptr_t)
  end function at

  subroutine compare(name, n_bytes, start, fields)
    character(len=*), intent(in) :: name
    integer(c_size_t), intent(in) :: n_bytes
    type(c_ptr), intent(in) :: start
    integer(c_intptr_t), intent(in) :: fields(:) ! their addresses
    integer(c_int64_t) :: layout(32), n
    n_compared = n_compared + 1
    n = twin_layout(riis_c_string(name), size(layout, kind=c_int64_t), layout)
    call check(n == size(fields) + 1, name // ' has as many fields in C')
    if (n /= size(fields) + 1) return
    call check(layout(1) == n_bytes, name // ' has its size in C')
    call check(all(layout(2:n) == fields - at(start)), name // ' has its fields where they are in C')
  end subroutine compare
end program test_layout
