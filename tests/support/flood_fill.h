/* SPDX-License-Identifier: Apache-2.0
 * Provides a serial flood fill that labels open regions, random graphs, and meshes in a tube. Include after searches.h and
 * random_meshes.h. */
#ifndef RIIS_TEST_FLOOD_FILL_H
#define RIIS_TEST_FLOOD_FILL_H

/* Returns a copy of the mesh whose rows have both directions of each edge and no ghost nodes. The test owns the arrays. */
static inline test_mesh both_ways(const test_mesh *mesh) {
  test_mesh made = {.n = mesh->n, .xyz = mesh->xyz};
  int64_t *pairs = malloc((size_t)(2 * mesh->offsets[mesh->n] + 1) * sizeof *pairs), n_pairs = 0;
  for (int64_t i = 0; i < mesh->n; ++i)
    for (int64_t k = mesh->offsets[i]; k < mesh->offsets[i + 1]; ++k)
      if (mesh->columns[k] < mesh->n) pairs[2 * n_pairs] = i, pairs[2 * n_pairs++ + 1] = mesh->columns[k];
  set_rows(&made, n_pairs, pairs);
  free(pairs);
  return made;
}

/* Labels the open regions. A walk starts at each open node without a label, in ascending order. The rows must have both
 * directions of each edge. Returns the number of regions. */
static inline int64_t flood_fill(const test_mesh *rows, const uint8_t *is_open, int64_t *label) {
  int64_t *stack = malloc((size_t)(rows->n + 1) * sizeof *stack), n_regions = 0;
  for (int64_t i = 0; i < rows->n; ++i) label[i] = -1;
  for (int64_t i = 0; i < rows->n; ++i) {
    if (!is_open[i] || label[i] >= 0) continue;
    int64_t n = 1;
    ++n_regions;
    stack[0] = i, label[i] = i;
    while (n > 0) {
      const int64_t at = stack[--n];
      for (int64_t k = rows->offsets[at]; k < rows->offsets[at + 1]; ++k) {
        const int64_t to = rows->columns[k];
        if (is_open[to] && label[to] < 0) label[to] = i, stack[n++] = to;
      }
    }
  }
  free(stack);
  return n_regions;
}

/* Makes random nodes in a cube, and random rows. Edges have one or both directions. Rows may repeat a neighbour, and may contain
 * the node itself and ghost nodes up to n + 5. */
static inline test_mesh random_graph(int64_t n, double edges_per_node) {
  test_mesh mesh = {.n = n};
  mesh.xyz = own(malloc((size_t)n * 3 * sizeof *mesh.xyz));
  mesh.offsets = own(malloc((size_t)(n + 1) * sizeof *mesh.offsets));
  mesh.columns = own(malloc((size_t)(2 * (double)n * edges_per_node + 1) * sizeof *mesh.columns));
  for (int64_t i = 0; i < 3 * n; ++i) mesh.xyz[i] = random_between(&rng, -1, 1);
  int64_t at = 0;
  for (int64_t i = 0; i < n; ++i) {
    mesh.offsets[i] = at;
    const int64_t most = (int64_t)(2 * edges_per_node);
    for (int64_t k = random_integer(0, most); k > 0; --k)
      mesh.columns[at++] = one_in(12) ? n + random_integer(0, 4) : one_in(12) ? i : random_integer(0, n - 1);
  }
  mesh.offsets[n] = at;
  return mesh;
}

/* Makes a mesh that borrows coordinates and rows. The rows may name ghost nodes up to n + 5. */
static inline riis_mesh *mesh_of_graph(const test_mesh *graph) {
  riis_mesh *mesh = mesh_of(graph->n, graph->xyz);
  riis_csr csr = csr_of(graph);
  csr.n_all = graph->n + 5;
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  return mesh;
}

/* Makes a surface with a few triangles in the cube and a random half thickness. */
static inline riis_surface *random_surface(void) {
  static const int32_t ids[18] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17};
  double xyz[54];
  for (int i = 0; i < 54; ++i) xyz[i] = random_between(&rng, -1, 1);
  const int64_t n = random_integer(1, 6);
  const riis_surface_arrays arrays = triangle_arrays(3 * n, xyz, n, ids);
  riis_surface_options options = surface_options();
  options.half_thickness = one_in(8) ? 1e-40 : pow(10, random_between(&rng, -2, -0.2));
  return surface_from(&arrays, &options);
}

/* Makes a lattice of nodes inside a tube around the z axis. */
static inline test_mesh tube(double radius, double from, double to, double spacing) {
  const int64_t across = 1 + 2 * (int64_t)ceil(radius / spacing), along = 1 + (int64_t)ceil((to - from) / spacing);
  const int64_t counts[3] = {across, across, along};
  const double half = spacing * (double)(across / 2);
  const double lower[3] = {-half, -half, from}, upper[3] = {half, half, from + spacing * (double)(along - 1)};
  test_mesh mesh = lattice(counts, lower, upper);
  uint8_t *wanted = own(malloc((size_t)mesh.n));
  for (int64_t i = 0; i < mesh.n; ++i) wanted[i] = hypot(mesh.xyz[3 * i], mesh.xyz[3 * i + 1]) <= radius;
  keep(&mesh, wanted);
  return mesh;
}

/* Returns the node that is nearest to a point. */
static inline int64_t node_at(const test_mesh *mesh, double x, double y, double z) {
  int64_t nearest = 0;
  double least = INFINITY;
  for (int64_t i = 0; i < mesh->n; ++i) {
    const double *p = mesh->xyz + 3 * i;
    const double d = hypot(hypot(p[0] - x, p[1] - y), p[2] - z);
    if (d < least) least = d, nearest = i;
  }
  return nearest;
}

#endif
