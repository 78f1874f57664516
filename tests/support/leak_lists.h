/* SPDX-License-Identifier: Apache-2.0
 * Gives the edges that leak as lists, and makes meshes with rows. Include after searches.h. */
#ifndef RIIS_TEST_LEAK_LISTS_H
#define RIIS_TEST_LEAK_LISTS_H

typedef struct leak_list {
  riis_leak_list sum;
  const int64_t *node_id;
  const double *length, *distance;
} leak_list;

static inline leak_list leaks_of(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options *options,
                                 const riis_marks *marks) {
  leak_list list;
  riis_leaks *leaks = NULL;
  memset(&list, 0x5a, sizeof list);
  CHECK_OK(riis_leaks_create(&leaks));
  CHECK_OK(riis_find_leaks(surface, mesh, marks, options, own(leaks)));
  CHECK_OK(riis_leaks_get_list(leaks, &list.sum, sizeof list.sum));
  list.node_id = list.sum.node_id, list.length = list.sum.length, list.distance = list.sum.distance;
  assert_true(list.sum.seconds >= 0);
  if (list.sum.n_edges == 0) assert_true(!list.node_id && !list.length && !list.distance);
  return list;
}

static inline riis_mesh *mesh_with_rows(const test_mesh *nodes, int64_t n_all) {
  riis_mesh *mesh = mesh_of(nodes->n, nodes->xyz);
  riis_csr csr;
  CHECK_OK(riis_csr_init(&csr, sizeof csr));
  csr.n_rows = nodes->n;
  csr.n_all = n_all;
  csr.offsets = nodes->offsets;
  csr.columns = nodes->columns;
  csr.offset_bits = csr.column_bits = 64;
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  return mesh;
}

#endif
