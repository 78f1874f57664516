! SPDX-License-Identifier: Apache-2.0
! The derived types of riis_c must have the memory layout of the structs in riis.h, field by field. The real constants must have
! the same bits. The fields are listed here by hand. fortran/bindings/generate.py writes the C half of the comparison from riis.h.
program test_layout
  use, intrinsic :: iso_c_binding
  use checks
  use c_twin
  use riis_c
  implicit none
  type(riis_points), target :: ps
  type(riis_patches), target :: ps2
  type(riis_parameter), target :: ps3
  type(riis_surface_options), target :: sos
  type(riis_surface_arrays), target :: sas
  type(riis_keyframe_arrays), target :: kas
  type(riis_surface_info), target :: sis
  type(riis_attachment), target :: as
  type(riis_direction), target :: ds
  type(riis_warp_options), target :: wos
  type(riis_warp_info), target :: wis
  type(riis_valve_patches), target :: vps
  type(riis_triangles), target :: ts
  type(riis_crossing_options), target :: cos
  type(riis_crossing_list), target :: cls
  type(riis_closest), target :: cs
  type(riis_closest_options), target :: cos2
  type(riis_closest_arrays), target :: cas
  type(riis_csr), target :: cs2
  type(riis_mesh_cells), target :: mcs
  type(riis_mesh_faces), target :: mfs
  type(riis_resistance), target :: rs
  type(riis_mark_options), target :: mos
  type(riis_mark_list), target :: mls
  type(riis_dense_arrays), target :: das
  type(riis_mark_stats), target :: mss
  type(riis_resistance_arrays), target :: ras
  type(riis_flow_arrays), target :: fas
  type(riis_reaction), target :: rs2
  type(riis_band_sums), target :: bss
  type(riis_band), target :: bs
  type(riis_leak_list), target :: lls
  type(riis_passage), target :: ps4
  type(riis_passage_ends), target :: pes
  type(riis_leaflet), target :: lf
  type(riis_orifice), target :: orf
  type(riis_coaptation), target :: coa
  type(riis_gap), target :: gp
  type(riis_first_passage_options), target :: fpo
  type(riis_first_passage), target :: fp
  type(riis_cells_across), target :: ca
  type(riis_landmarks), target :: lms
  type(riis_placement), target :: plm
  type(riis_placement_arrays), target :: pla
  type(riis_opening_table), target :: ots
  type(riis_opening_times), target :: ots2
  type(riis_opening_switch), target :: oss
  type(riis_opening_switch_state), target :: osss
  type(riis_opening_angle), target :: oas
  type(riis_opening_angle_state), target :: oass
  integer :: n_compared = 0

  call compare('riis_points', c_sizeof(ps), c_loc(ps), [at(c_loc(ps%struct_size)), at(c_loc(ps%n_points)), &
    at(c_loc(ps%x)), at(c_loc(ps%y)), at(c_loc(ps%z)), at(c_loc(ps%stride)), at(c_loc(ps%real_bits)), &
    at(c_loc(ps%reserved))])
  call compare('riis_patches', c_sizeof(ps2), c_loc(ps2), [at(c_loc(ps2%struct_size)), at(c_loc(ps2%n_curves)), &
    at(c_loc(ps2%degree)), at(c_loc(ps2%control)), at(c_loc(ps2%n_patches)), at(c_loc(ps2%curve_id)), &
    at(c_loc(ps2%reversed)), at(c_loc(ps2%leaflet_id)), at(c_loc(ps2%index_base)), at(c_loc(ps2%reserved))])
  call compare('riis_parameter', c_sizeof(ps3), c_loc(ps3), [at(c_loc(ps3%name)), at(c_loc(ps3%unit)), &
    at(c_loc(ps3%description)), at(c_loc(ps3%n_values)), at(c_loc(ps3%default_values)), at(c_loc(ps3%minimum)), &
    at(c_loc(ps3%maximum)), at(c_loc(ps3%rule)), at(c_loc(ps3%other_name)), at(c_loc(ps3%other_factor))])
  call compare('riis_surface_options', c_sizeof(sos), c_loc(sos), [at(c_loc(sos%struct_size)), &
    at(c_loc(sos%half_thickness)), at(c_loc(sos%tolerance)), at(c_loc(sos%scale)), at(c_loc(sos%rotation_axis)), &
    at(c_loc(sos%rotation_angle)), at(c_loc(sos%translation)), at(c_loc(sos%measure_tolerance)), &
    at(c_loc(sos%measure)), at(c_loc(sos%triangulation)), at(c_loc(sos%zero_area)), at(c_loc(sos%flip_normals)), &
    at(c_loc(sos%n_threads)), at(c_loc(sos%reserved))])
  call compare('riis_surface_arrays', c_sizeof(sas), c_loc(sas), [at(c_loc(sas%struct_size)), &
    at(c_loc(sas%n_vertices)), at(c_loc(sas%x)), at(c_loc(sas%y)), at(c_loc(sas%z)), at(c_loc(sas%stride)), &
    at(c_loc(sas%vx)), at(c_loc(sas%vy)), at(c_loc(sas%vz)), at(c_loc(sas%velocity_stride)), &
    at(c_loc(sas%n_faces)), at(c_loc(sas%vertex_ids)), at(c_loc(sas%leaflet_id)), at(c_loc(sas%corners_per_face)), &
    at(c_loc(sas%id_bits)), at(c_loc(sas%index_base)), at(c_loc(sas%real_bits))])
  call compare('riis_keyframe_arrays', c_sizeof(kas), c_loc(kas), [at(c_loc(kas%struct_size)), &
    at(c_loc(kas%n_keys)), at(c_loc(kas%n_vertices)), at(c_loc(kas%time)), at(c_loc(kas%xyz)), &
    at(c_loc(kas%period)), at(c_loc(kas%interpolation)), at(c_loc(kas%real_bits))])
  call compare('riis_surface_info', c_sizeof(sis), c_loc(sis), [at(c_loc(sis%n_vertices)), &
    at(c_loc(sis%n_triangles)), at(c_loc(sis%n_zero_area)), at(c_loc(sis%half_thickness)), at(c_loc(sis%area)), &
    at(c_loc(sis%lower)), at(c_loc(sis%upper)), at(c_loc(sis%seconds_triangles)), at(c_loc(sis%seconds_scene)), &
    at(c_loc(sis%error_bound)), &
    at(c_loc(sis%largest_leaflet_id))])
  call compare('riis_attachment', c_sizeof(as), c_loc(as), [at(c_loc(as%n_edges)), at(c_loc(as%edges)), &
    at(c_loc(as%vertex_id)), at(c_loc(as%leaflet_id)), at(c_loc(as%patch_id))])
  call compare('riis_direction', c_sizeof(ds), c_loc(ds), [at(c_loc(ds%n_vertices)), at(c_loc(ds%rate)), &
    at(c_loc(ds%area_rate))])
  call compare('riis_warp_options', c_sizeof(wos), c_loc(wos), [&
    at(c_loc(wos%struct_size)), at(c_loc(wos%noise)), at(c_loc(wos%placement))])
  call compare('riis_warp_info', c_sizeof(wis), c_loc(wis), [&
    at(c_loc(wis%n_landmarks)), at(c_loc(wis%rms_residual)), at(c_loc(wis%largest_residual)), &
    at(c_loc(wis%largest_landmark_id)), at(c_loc(wis%smoothing)), at(c_loc(wis%least_determinant)), &
    at(c_loc(wis%least_point)), at(c_loc(wis%is_planar)), at(c_loc(wis%reserved))])
  call compare('riis_valve_patches', c_sizeof(vps), c_loc(vps), [&
    at(c_loc(vps%n_curves)), at(c_loc(vps%n_pieces)), at(c_loc(vps%first_piece)), at(c_loc(vps%degree)), &
    at(c_loc(vps%control)), at(c_loc(vps%n_patches)), at(c_loc(vps%curve_id)), at(c_loc(vps%reversed)), &
    at(c_loc(vps%leaflet_id)), at(c_loc(vps%patch_id)), at(c_loc(vps%attached)), at(c_loc(vps%bulge))])
  call compare('riis_triangles', c_sizeof(ts), c_loc(ts), [at(c_loc(ts%n_vertices)), at(c_loc(ts%xyz)), &
    at(c_loc(ts%uv)), at(c_loc(ts%velocity)), at(c_loc(ts%n_triangles)), at(c_loc(ts%vertex_id)), &
    at(c_loc(ts%triangle_id)), at(c_loc(ts%leaflet_id)), at(c_loc(ts%patch_id))])
  call compare('riis_crossing_options', c_sizeof(cos), c_loc(cos), [at(c_loc(cos%struct_size)), &
    at(c_loc(cos%depth)), at(c_loc(cos%n_threads)), at(c_loc(cos%reserved))])
  call compare('riis_crossing_list', c_sizeof(cls), c_loc(cls), [at(c_loc(cls%n_pairs)), &
    at(c_loc(cls%triangle_id)), at(c_loc(cls%point)), at(c_loc(cls%depth)), at(c_loc(cls%length)), &
    at(c_loc(cls%total_length)), at(c_loc(cls%deepest_depth)), at(c_loc(cls%deepest_point)), &
    at(c_loc(cls%deepest_triangle_id)), at(c_loc(cls%deepest_leaflet_id)), at(c_loc(cls%seconds))])
  call compare('riis_closest', c_sizeof(cs), c_loc(cs), [at(c_loc(cs%distance)), at(c_loc(cs%point)), &
    at(c_loc(cs%barycentric)), at(c_loc(cs%normal)), at(c_loc(cs%triangle_id)), at(c_loc(cs%leaflet_id)), &
    at(c_loc(cs%side))])
  call compare('riis_closest_options', c_sizeof(cos2), c_loc(cos2), [at(c_loc(cos2%struct_size)), &
    at(c_loc(cos2%distance_limit)), at(c_loc(cos2%far_distance)), at(c_loc(cos2%point_mask)), &
    at(c_loc(cos2%n_point_ids)), at(c_loc(cos2%point_ids)), at(c_loc(cos2%n_threads)), at(c_loc(cos2%reserved))])
  call compare('riis_closest_arrays', c_sizeof(cas), c_loc(cas), [at(c_loc(cas%struct_size)), &
    at(c_loc(cas%distance)), at(c_loc(cas%point)), at(c_loc(cas%barycentric)), at(c_loc(cas%normal)), &
    at(c_loc(cas%triangle_id)), at(c_loc(cas%leaflet_id)), at(c_loc(cas%side))])
  call compare('riis_csr', c_sizeof(cs2), c_loc(cs2), [at(c_loc(cs2%struct_size)), at(c_loc(cs2%n_rows)), &
    at(c_loc(cs2%n_all)), at(c_loc(cs2%offsets)), at(c_loc(cs2%columns)), at(c_loc(cs2%offset_bits)), &
    at(c_loc(cs2%column_bits)), at(c_loc(cs2%index_base)), at(c_loc(cs2%reserved))])
  call compare('riis_mesh_cells', c_sizeof(mcs), c_loc(mcs), [at(c_loc(mcs%struct_size)), at(c_loc(mcs%n_nodes)), &
    at(c_loc(mcs%n_cells)), at(c_loc(mcs%node_ids)), at(c_loc(mcs%offsets)), at(c_loc(mcs%nodes_per_cell)), &
    at(c_loc(mcs%id_bits)), at(c_loc(mcs%index_base)), at(c_loc(mcs%n_threads))])
  call compare('riis_mesh_faces', c_sizeof(mfs), c_loc(mfs), [at(c_loc(mfs%struct_size)), at(c_loc(mfs%n_cells)), &
    at(c_loc(mfs%n_faces)), at(c_loc(mfs%owner)), at(c_loc(mfs%neighbor)), at(c_loc(mfs%stride)), &
    at(c_loc(mfs%id_bits)), at(c_loc(mfs%index_base)), at(c_loc(mfs%n_threads)), at(c_loc(mfs%reserved))])
  call compare('riis_resistance', c_sizeof(rs), c_loc(rs), [at(c_loc(rs%struct_size)), at(c_loc(rs%R)), &
    at(c_loc(rs%half_thickness)), at(c_loc(rs%rim)), at(c_loc(rs%reserved))])
  call compare('riis_mark_options', c_sizeof(mos), c_loc(mos), [at(c_loc(mos%struct_size)), &
    at(c_loc(mos%distance_limit)), at(c_loc(mos%node_mask)), at(c_loc(mos%resistance)), at(c_loc(mos%fields)), &
    at(c_loc(mos%search)), at(c_loc(mos%n_threads)), at(c_loc(mos%instructions))])
  call compare('riis_mark_list', c_sizeof(mls), c_loc(mls), [at(c_loc(mls%n_nodes)), at(c_loc(mls%node_id)), &
    at(c_loc(mls%distance)), at(c_loc(mls%triangle_id)), at(c_loc(mls%leaflet_id)), at(c_loc(mls%K)), &
    at(c_loc(mls%K_u_surface)), at(c_loc(mls%point)), at(c_loc(mls%normal)), at(c_loc(mls%barycentric)), &
    at(c_loc(mls%uv)), at(c_loc(mls%velocity)), at(c_loc(mls%side)), at(c_loc(mls%rim)), at(c_loc(mls%patch_id)), &
    at(c_loc(mls%n_directions)), at(c_loc(mls%distance_gradient)), at(c_loc(mls%K_gradient))])
  call compare('riis_dense_arrays', c_sizeof(das), c_loc(das), [at(c_loc(das%struct_size)), at(c_loc(das%n_nodes)), &
    at(c_loc(das%far_distance)), at(c_loc(das%mark)), at(c_loc(das%distance)), at(c_loc(das%triangle_id)), &
    at(c_loc(das%leaflet_id))])
  call compare('riis_mark_stats', c_sizeof(mss), c_loc(mss), [at(c_loc(mss%n_nodes)), at(c_loc(mss%n_marked)), &
    at(c_loc(mss%n_within_limit)), at(c_loc(mss%n_queries)), at(c_loc(mss%seconds)), at(c_loc(mss%search)), &
    at(c_loc(mss%n_threads)), at(c_loc(mss%complete)), at(c_loc(mss%instructions)), at(c_loc(mss%n_unreached))])
  call compare('riis_resistance_arrays', c_sizeof(ras), c_loc(ras), [at(c_loc(ras%struct_size)), &
    at(c_loc(ras%n_nodes)), at(c_loc(ras%K)), at(c_loc(ras%K_stride)), at(c_loc(ras%K_u_surface)), &
    at(c_loc(ras%K_u_surface_stride))])
  call compare('riis_flow_arrays', c_sizeof(fas), c_loc(fas), [at(c_loc(fas%struct_size)), at(c_loc(fas%n_nodes)), &
    at(c_loc(fas%velocity)), at(c_loc(fas%velocity_stride)), at(c_loc(fas%weight))])
  call compare('riis_reaction', c_sizeof(rs2), c_loc(rs2), [at(c_loc(rs2%struct_size)), at(c_loc(rs2%about)), &
    at(c_loc(rs2%force)), at(c_loc(rs2%moment)), at(c_loc(rs2%n_leaflets)), at(c_loc(rs2%leaflet_force)), &
    at(c_loc(rs2%leaflet_moment)), at(c_loc(rs2%n_edges)), at(c_loc(rs2%edges)), at(c_loc(rs2%edge_leaflet_id)), &
    at(c_loc(rs2%edge_force)), at(c_loc(rs2%edge_moment))])
  call compare('riis_band_sums', c_sizeof(bss), c_loc(bss), [at(c_loc(bss%sum)), at(c_loc(bss%weight)), &
    at(c_loc(bss%n_nodes))])
  call compare('riis_band', c_sizeof(bs), c_loc(bs), [at(c_loc(bs%struct_size)), at(c_loc(bs%inner)), &
    at(c_loc(bs%outer)), at(c_loc(bs%n_nodes)), at(c_loc(bs%value)), at(c_loc(bs%weight))])
  call compare('riis_leak_list', c_sizeof(lls), c_loc(lls), [at(c_loc(lls%n_edges)), at(c_loc(lls%node_id)), &
    at(c_loc(lls%length)), at(c_loc(lls%distance)), at(c_loc(lls%half_thickness)), at(c_loc(lls%longest_node_id)), &
    at(c_loc(lls%longest_length)), at(c_loc(lls%longest_middle)), at(c_loc(lls%seconds))])
  call compare('riis_passage', c_sizeof(ps4), c_loc(ps4), [at(c_loc(ps4%node_id)), at(c_loc(ps4%distance)), &
    at(c_loc(ps4%point)), at(c_loc(ps4%seconds)), at(c_loc(ps4%state)), at(c_loc(ps4%reserved))])
  call compare('riis_passage_ends', c_sizeof(pes), c_loc(pes), [at(c_loc(pes%struct_size)), at(c_loc(pes%n_from)), &
    at(c_loc(pes%from)), at(c_loc(pes%n_to)), at(c_loc(pes%to))])
  call compare('riis_leaflet', c_sizeof(lf), c_loc(lf), [at(c_loc(lf%n_triangles)), at(c_loc(lf%area)), &
    at(c_loc(lf%free_edge)), at(c_loc(lf%leaflet_id)), at(c_loc(lf%reserved))])
  call compare('riis_orifice', c_sizeof(orf), c_loc(orf), [at(c_loc(orf%area)), at(c_loc(orf%outline_area)), &
    at(c_loc(orf%perimeter)), at(c_loc(orf%effective_area)), at(c_loc(orf%rim_reach)), at(c_loc(orf%half_thickness)), &
    at(c_loc(orf%radius)), at(c_loc(orf%axis)), at(c_loc(orf%outline)), at(c_loc(orf%reserved))])
  call compare('riis_coaptation', c_sizeof(coa), c_loc(coa), [at(c_loc(coa%area)), at(c_loc(coa%edge)), &
    at(c_loc(coa%reach))])
  call compare('riis_gap', c_sizeof(gp), c_loc(gp), [at(c_loc(gp%least)), at(c_loc(gp%mean)), at(c_loc(gp%most)), &
    at(c_loc(gp%widest_point)), at(c_loc(gp%n_ends)), at(c_loc(gp%n_without_wall))])
  call compare('riis_first_passage_options', c_sizeof(fpo), c_loc(fpo), [at(c_loc(fpo%struct_size)), &
    at(c_loc(fpo%surface)), at(c_loc(fpo%marking)), at(c_loc(fpo%tolerance))])
  call compare('riis_first_passage', c_sizeof(fp), c_loc(fp), [at(c_loc(fp%opening)), at(c_loc(fp%closed_opening)), &
    at(c_loc(fp%node_id)), at(c_loc(fp%distance)), at(c_loc(fp%point)), at(c_loc(fp%seconds)), &
    at(c_loc(fp%n_openings)), at(c_loc(fp%state))])
  call compare('riis_cells_across', c_sizeof(ca), c_loc(ca), [at(c_loc(ca%least)), at(c_loc(ca%mean)), &
    at(c_loc(ca%most)), at(c_loc(ca%shortest_edge)), at(c_loc(ca%mean_edge)), at(c_loc(ca%longest_edge)), &
    at(c_loc(ca%half_thickness)), at(c_loc(ca%n_edges))])
  call compare('riis_landmarks', c_sizeof(lms), c_loc(lms), [at(c_loc(lms%struct_size)), at(c_loc(lms%n_landmarks)), &
    at(c_loc(lms%x)), at(c_loc(lms%y)), at(c_loc(lms%z)), at(c_loc(lms%stride)), at(c_loc(lms%role)), &
    at(c_loc(lms%leaflet_id)), at(c_loc(lms%scale)), at(c_loc(lms%noise)), at(c_loc(lms%flow)), &
    at(c_loc(lms%real_bits)), at(c_loc(lms%reserved))])
  call compare('riis_placement', c_sizeof(plm), c_loc(plm), [at(c_loc(plm%scale)), at(c_loc(plm%rotation_axis)), &
    at(c_loc(plm%rotation_angle)), at(c_loc(plm%translation)), at(c_loc(plm%rms)), at(c_loc(plm%worst)), &
    at(c_loc(plm%noise)), at(c_loc(plm%rotation_error)), at(c_loc(plm%position_error)), &
    at(c_loc(plm%worst_landmark_id)), at(c_loc(plm%n_undetermined)), at(c_loc(plm%reserved))])
  call compare('riis_placement_arrays', c_sizeof(pla), c_loc(pla), [at(c_loc(pla%struct_size)), &
    at(c_loc(pla%residual)), at(c_loc(pla%standard_error)), at(c_loc(pla%size_state)), &
    at(c_loc(pla%place))])
  call compare('riis_opening_table', c_sizeof(ots), c_loc(ots), [at(c_loc(ots%struct_size)), at(c_loc(ots%n_keys)), &
    at(c_loc(ots%time)), at(c_loc(ots%opening)), at(c_loc(ots%period)), at(c_loc(ots%interpolation)), &
    at(c_loc(ots%reserved))])
  call compare('riis_opening_times', c_sizeof(ots2), c_loc(ots2), [at(c_loc(ots2%struct_size)), &
    at(c_loc(ots2%opening_start)), at(c_loc(ots2%opening_duration)), at(c_loc(ots2%closing_start)), &
    at(c_loc(ots2%closing_duration)), at(c_loc(ots2%closed)), at(c_loc(ots2%open)), at(c_loc(ots2%period))])
  call compare('riis_opening_switch', c_sizeof(oss), c_loc(oss), [at(c_loc(oss%struct_size)), &
    at(c_loc(oss%opening_duration)), at(c_loc(oss%closing_duration)), at(c_loc(oss%open_above)), &
    at(c_loc(oss%close_below)), at(c_loc(oss%filter_time)), at(c_loc(oss%dwell_time))])
  call compare('riis_opening_switch_state', c_sizeof(osss), c_loc(osss), [at(c_loc(osss%struct_size)), &
    at(c_loc(osss%time)), at(c_loc(osss%opening)), at(c_loc(osss%rate)), at(c_loc(osss%progress)), &
    at(c_loc(osss%pressure_difference)), at(c_loc(osss%flow)), at(c_loc(osss%turn_time)), at(c_loc(osss%phase)), &
    at(c_loc(osss%reserved))])
  call compare('riis_opening_angle', c_sizeof(oas), c_loc(oas), [at(c_loc(oas%struct_size)), &
    at(c_loc(oas%pressure_gain)), at(c_loc(oas%flow_gain)), at(c_loc(oas%friction)), at(c_loc(oas%vortex_gain)), &
    at(c_loc(oas%angle_min)), at(c_loc(oas%angle_max))])
  call compare('riis_opening_angle_state', c_sizeof(oass), c_loc(oass), [at(c_loc(oass%struct_size)), &
    at(c_loc(oass%time)), at(c_loc(oass%opening)), at(c_loc(oass%rate)), at(c_loc(oass%angle)), &
    at(c_loc(oass%angle_rate)), at(c_loc(oass%pressure_difference)), at(c_loc(oass%flow))])

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
    integer(c_intptr_t), intent(in) :: fields(:) ! the fields' addresses
    integer(c_int64_t) :: layout(40), n
    n_compared = n_compared + 1
    n = twin_layout(riis_c_string(name), size(layout, kind=c_int64_t), layout)
    call check(n == size(fields) + 1, name // ' has as many fields in C')
    if (n /= size(fields) + 1) return
    call check(layout(1) == n_bytes, name // ' has its size in C')
    call check(all(layout(2:n) == fields - at(start)), name // ' has its fields where they are in C')
  end subroutine compare
end program test_layout
