/* SPDX-License-Identifier: Apache-2.0
 * Copies the triangles of a surface into arrays of the caller, as if the arrays came from a file. Include after handles.h. */
#ifndef RIIS_TEST_GIVEN_BACK_H
#define RIIS_TEST_GIVEN_BACK_H

/* Copies the triangles. If has_attachment is not 0, the arrays also name the attached vertices. */
static inline riis_surface_arrays given_back(const riis_surface *surface, int has_attachment) {
  const riis_triangles all = triangles_of(surface);
  const size_t n_points = (size_t)all.n_vertices, n_faces = (size_t)all.n_triangles;
  double *xyz = own(malloc(n_points * 3 * sizeof *xyz));
  int32_t *ids = own(malloc(n_faces * 3 * sizeof *ids)), *leaflets = own(malloc(n_faces * sizeof *leaflets));
  uint8_t *attached = own(calloc(n_points, sizeof *attached));
  memcpy(xyz, all.xyz, n_points * 3 * sizeof *xyz);
  for (size_t i = 0; i < 3 * n_faces; ++i) ids[i] = (int32_t)all.vertex_id[i];
  memcpy(leaflets, all.leaflet_id, n_faces * sizeof *leaflets);
  riis_surface_arrays arrays = triangle_arrays(all.n_vertices, xyz, all.n_triangles, ids);
  arrays.leaflet_id = leaflets;
  if (!has_attachment) return arrays;
  riis_attachment held;
  CHECK_OK(riis_surface_get_attachment(surface, &held, sizeof held));
  for (int64_t i = 0; i < 2 * held.n_edges; ++i)
    for (int64_t id = 0; id < all.n_vertices; ++id) /* other vertices at this place are also attached */
      if (memcmp(xyz + 3 * id, held.edges + 3 * i, 3 * sizeof *xyz) == 0) attached[id] = 1;
  arrays.attached = attached;
  return arrays;
}

#endif
