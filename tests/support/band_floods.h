/* SPDX-License-Identifier: Apache-2.0
 * Finds the nodes outside a band with an offset, for a flood fill that passes through these nodes. Include after band_oracle.h
 * and flood_fill.h. */
#ifndef RIIS_TEST_BAND_FLOODS_H
#define RIIS_TEST_BAND_FLOODS_H

/* Copies the triangles of a surface, and gives the copy another half thickness. A valve that is made anew with another half
 * thickness could have other triangles. */
static inline riis_surface *same_triangles(const riis_surface *surface, double half_thickness, double offset) {
  const riis_triangles all = triangles_of(surface);
  riis_surface_arrays arrays = triangle_arrays(all.n_vertices, all.xyz, all.n_triangles, NULL);
  arrays.vertex_ids = all.vertex_id, arrays.id_bits = 64, arrays.leaflet_id = all.leaflet_id;
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness, options.offset = offset;
  return surface_from(&arrays, &options);
}

/* Writes 1 for each node that the oracle does not mark. */
static inline void open_nodes(const riis_surface *surface, const test_mesh *nodes, double eps, double offset,
                              uint8_t *is_open) {
  const riis_triangles all = triangles_of(surface);
  riis_mesh *mesh = mesh_from(nodes);
  riis_marks *marks = new_result();
  riis_surface *thick = same_triangles(surface, eps, 0);
  riis_mark_options asked = mark_options();
  asked.fields = RIIS_FIELD_RIM;
  asked.distance_limit = 2 * eps;
  CHECK_OK(riis_mark_nodes(thick, mesh, &asked, marks));
  const riis_mark_list within = within_list(marks);
  memset(is_open, 1, (size_t)nodes->n);
  for (int64_t i = 0; i < within.n_nodes; ++i) {
    const band_place place = place_of(&all, nodes->xyz + 3 * within.node_id[i], within.triangle_id[i], within.rim[i]);
    is_open[within.node_id[i]] = from_middle(&place, eps, offset) > eps;
  }
}

#endif
