/* SPDX-License-Identifier: Apache-2.0
 * A set of edges as an oracle for adjacencies, and the library's builder for cells with other limits. */
#ifndef RIIS_TEST_EDGE_SET_H
#define RIIS_TEST_EDGE_SET_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Compressed sparse rows with 64-bit integers. */
typedef struct wide_rows {
  int64_t n_rows;
  int64_t *offsets, *columns;
  int column_bits; /* width of the rows as they were made */
} wide_rows;
void wide_rows_free(wide_rows *rows);
/* Returns 1 if the rows are the same, in any width. */
int wide_rows_same(const wide_rows *a, const wide_rows *b);

/* A std::set of both directions of each edge. An edge from a node to itself is left out. */
typedef struct edge_set edge_set;
edge_set *edge_set_make(void);
void edge_set_add(edge_set *set, int64_t a, int64_t b);
wide_rows edge_set_rows(const edge_set *set, int64_t n_nodes);
void edge_set_free(edge_set **set);

/* Makes rows as riis_adjacency_create_from_cells does, but with limits for 32 bits: one for the entries, which are the nodes of
 * all cells, and one for the nodes. A negative limit stands for the library's own. Use complete structs only. */
riis_status rows_with_limits(const riis_mesh_cells *cells, int n_threads, int64_t n_entries, int64_t n_nodes,
                             wide_rows *rows);

#ifdef __cplusplus
}
#endif

#endif
