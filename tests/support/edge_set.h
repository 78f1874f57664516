/* SPDX-License-Identifier: Apache-2.0
 * Provides a set of edges as a reference for adjacencies, and the library's builder of rows with other limits. */
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
  int column_bits; /* bits of the columns in the original rows */
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

/* Makes rows as riis_adjacency_create_from_cells does, but with other limits for the use of 32-bit integers. n_entries limits
 * the entries, the nodes of all cells together. n_nodes limits the nodes. A negative limit stands for the library's own. Pass
 * complete structs only. */
riis_status rows_with_limits(const riis_mesh_cells *cells, int n_threads, int64_t n_entries, int64_t n_nodes,
                             wide_rows *rows);

#ifdef __cplusplus
}
#endif

#endif
