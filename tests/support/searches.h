/* SPDX-License-Identifier: Apache-2.0
 * Makes meshes whose adjacency is written by hand, and compares the bits of search results. Include after riis.h, test_support.h
 * and handles.h. */
#ifndef RIIS_TEST_SEARCHES_H
#define RIIS_TEST_SEARCHES_H

typedef struct found_nodes {
  int64_t n;
  const int64_t *node_id, *triangle_id;
  const double *distance;
  const int32_t *leaflet_id;
} found_nodes;

static inline found_nodes found_in(riis_mark_list list) {
  return (found_nodes){list.n_nodes, list.node_id, list.triangle_id, list.distance, list.leaflet_id};
}
static inline found_nodes marked_in(const riis_marks *marks) { return found_in(marked_list(marks)); }
static inline found_nodes within_in(const riis_marks *marks) { return found_in(within_list(marks)); }

static inline riis_mark_stats stats_of(const riis_marks *result) {
  riis_mark_stats stats;
  CHECK_OK(riis_marks_get_stats(result, &stats, sizeof stats));
  return stats;
}

static inline riis_marks *new_result(void) {
  riis_marks *result = NULL;
  CHECK_OK(riis_marks_create(&result));
  return own(result);
}

static inline int same_nodes(found_nodes a, found_nodes b) {
  if (a.n != b.n) return 0;
  if (a.n == 0) return 1;
  const size_t m = (size_t)a.n;
  return memcmp(a.node_id, b.node_id, m * sizeof *a.node_id) == 0 &&
         memcmp(a.distance, b.distance, m * sizeof *a.distance) == 0 &&
         memcmp(a.triangle_id, b.triangle_id, m * sizeof *a.triangle_id) == 0 &&
         memcmp(a.leaflet_id, b.leaflet_id, m * sizeof *a.leaflet_id) == 0;
}

/* Returns 1 if two results have the same bits in their lists of marked nodes and of nodes within the limit. The function asserts
 * nothing, so any thread may call it. */
static inline int same_results(const riis_marks *a, const riis_marks *b) {
  return same_nodes(marked_in(a), marked_in(b)) && same_nodes(within_in(a), within_in(b));
}

/* Nodes and their neighbours. The rows have n + 1 offsets, and the first offset is 0. The test owns the arrays. */
typedef struct test_mesh {
  int64_t n;
  double *xyz;
  int64_t *offsets, *columns;
} test_mesh;

/* Makes rows from pairs, (2, n_pairs). Each pair joins its nodes in both directions. The mesh's old rows are freed. */
static inline void set_rows(test_mesh *mesh, int64_t n_pairs, const int64_t *pairs) {
  const size_t n = (size_t)mesh->n;
  int64_t *next = calloc(n + 1, sizeof *next);
  free_one_owned(mesh->offsets), free_one_owned(mesh->columns);
  mesh->offsets = own(calloc(n + 1, sizeof *mesh->offsets));
  mesh->columns = own(malloc((size_t)(2 * n_pairs + 1) * sizeof *mesh->columns));
  for (int64_t k = 0; k < 2 * n_pairs; ++k) ++mesh->offsets[pairs[k] + 1];
  for (int64_t i = 0; i < mesh->n; ++i) mesh->offsets[i + 1] += mesh->offsets[i];
  memcpy(next, mesh->offsets, n * sizeof *next);
  for (int64_t k = 0; k < n_pairs; ++k) {
    const int64_t a = pairs[2 * k], b = pairs[2 * k + 1];
    mesh->columns[next[a]++] = b;
    mesh->columns[next[b]++] = a;
  }
  free(next);
}

/* Makes counts[0] * counts[1] * counts[2] nodes between two corners, each with up to 6 neighbours. */
static inline test_mesh lattice(const int64_t *counts, const double *lower, const double *upper) {
  const int64_t step[3] = {1, counts[0], counts[0] * counts[1]};
  test_mesh mesh = {.n = step[2] * counts[2]};
  mesh.xyz = own(malloc((size_t)mesh.n * 3 * sizeof *mesh.xyz));
  int64_t *pairs = malloc((size_t)mesh.n * 6 * sizeof *pairs), n_pairs = 0;
  for (int64_t i = 0; i < mesh.n; ++i)
    for (int c = 0; c < 3; ++c) {
      const int64_t at = i / step[c] % counts[c];
      mesh.xyz[3 * i + c] =
          counts[c] == 1 ? lower[c] : lower[c] + (upper[c] - lower[c]) * (double)at / (double)(counts[c] - 1);
      if (at + 1 == counts[c]) continue;
      pairs[2 * n_pairs] = i;
      pairs[2 * n_pairs++ + 1] = i + step[c];
    }
  set_rows(&mesh, n_pairs, pairs);
  free(pairs);
  return mesh;
}

/* Makes a lattice with about the given spacing, which covers the surface and a margin around it. */
static inline test_mesh lattice_around(const riis_surface *surface, double spacing, double margin) {
  const riis_surface_info info = info_of(surface);
  double lower[3], upper[3];
  int64_t counts[3];
  for (int c = 0; c < 3; ++c) {
    lower[c] = info.lower[c] - margin, upper[c] = info.upper[c] + margin;
    counts[c] = 1 + (int64_t)ceil((upper[c] - lower[c]) / spacing);
  }
  return lattice(counts, lower, upper);
}

static inline riis_csr csr_of(const test_mesh *mesh) {
  riis_csr csr;
  CHECK_OK(riis_csr_init(&csr, sizeof csr));
  csr.n_rows = mesh->n;
  csr.offsets = mesh->offsets;
  csr.columns = mesh->columns;
  csr.offset_bits = csr.column_bits = 64;
  return csr;
}

/* Makes a mesh that borrows all arrays. */
static inline riis_mesh *mesh_from(const test_mesh *from) {
  riis_mesh *mesh = mesh_of(from->n, from->xyz);
  const riis_csr csr = csr_of(from);
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  return mesh;
}

#endif
