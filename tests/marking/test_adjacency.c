/* SPDX-License-Identifier: Apache-2.0
 * Tests adjacencies against lists of pairs that are made without the library. Wrong cells, faces and grids are refused.
 */
#include <riis/riis.h>

#include "test_support.h"

#include "cell_edges.h"
#include "handles.h"
#include "searches.h"

static random_source rng;

/* --- A list of pairs, made without the library ----------------------------------------------------------------------- */

typedef struct pair_list {
  int64_t n, room;
  int64_t *ends; /* (2, n): each pair in both directions */
} pair_list;

static void add_pair(pair_list *list, int64_t a, int64_t b) {
  if (a == b) return;
  if (list->n + 2 > list->room) {
    list->room = 2 * list->room + 64;
    int64_t *longer = own(malloc((size_t)list->room * 2 * sizeof *longer));
    if (list->n) memcpy(longer, list->ends, (size_t)list->n * 2 * sizeof *longer);
    free_one_owned(list->ends);
    list->ends = longer;
  }
  int64_t *to = list->ends + 2 * list->n;
  to[0] = a, to[1] = b, to[2] = b, to[3] = a;
  list->n += 2;
}

static int compare_pairs(const void *a, const void *b) {
  const int64_t *p = a, *q = b;
  if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
  return p[1] < q[1] ? -1 : p[1] > q[1];
}

/* Sorts the pairs and removes repeats. The result should equal the adjacency's rows, read in order. */
static void tidy_pairs(pair_list *list) {
  if (list->n == 0) return;
  qsort(list->ends, (size_t)list->n, 2 * sizeof *list->ends, compare_pairs);
  int64_t m = 1;
  for (int64_t i = 1; i < list->n; ++i)
    if (compare_pairs(list->ends + 2 * i, list->ends + 2 * (m - 1)) != 0)
      memmove(list->ends + 2 * m++, list->ends + 2 * i, 2 * sizeof *list->ends);
  list->n = m;
}

static riis_csr rows_of(const riis_adjacency *adjacency) {
  riis_csr csr;
  CHECK_OK(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  return csr;
}

/* Checks that the rows contain exactly the pairs. The rows have base 0, 64-bit offsets and 32-bit columns. */
static void check_rows(const riis_adjacency *adjacency, int64_t n_nodes, pair_list *expected) {
  const riis_csr csr = rows_of(adjacency);
  tidy_pairs(expected);
  assert_int_equal(csr.struct_size, sizeof csr);
  assert_int_equal(csr.n_rows, n_nodes);
  assert_int_equal(csr.n_all, n_nodes);
  assert_int_equal(csr.offset_bits, 64);
  assert_int_equal(csr.column_bits, 32);
  assert_int_equal(csr.index_base, 0);
  assert_int_equal(csr.reserved, 0);
  const int64_t *offsets = csr.offsets;
  const int32_t *columns = csr.columns;
  assert_int_equal(offsets[0], 0);
  int64_t at = 0;
  for (int64_t i = 0; i < n_nodes; ++i) {
    assert_int_equal(offsets[i], at);
    for (; at < expected->n && expected->ends[2 * at] == i; ++at) {
      assert_true(at < offsets[i + 1]);
      assert_int_equal(columns[at], expected->ends[2 * at + 1]);
    }
    assert_int_equal(offsets[i + 1], at);
  }
  assert_int_equal(at, expected->n);
}

static int same_rows(const riis_adjacency *a, const riis_adjacency *b) {
  const riis_csr x = rows_of(a), y = rows_of(b);
  if (x.n_rows != y.n_rows || x.column_bits != 32 || y.column_bits != 32) return 0;
  const size_t n = (size_t)x.n_rows, n_columns = (size_t)((const int64_t *)x.offsets)[n];
  if (memcmp(x.offsets, y.offsets, (n + 1) * sizeof(int64_t)) != 0) return 0;
  return n_columns == 0 || memcmp(x.columns, y.columns, n_columns * sizeof(int32_t)) == 0;
}

/* --- Cells ----------------------------------------------------------------------------------------------------------- */

typedef struct cell_list {
  int64_t n_nodes, n_cells;
  int64_t *offsets, *nodes; /* counted from 0 */
} cell_list;

/* Makes random cells. `kind` is the number of nodes of a cell: 4, 5, 6 or 8, or 0 for a mixture. Nodes n_used to n_nodes - 1 are
 * in no cell. */
static cell_list random_cells(int kind, int64_t n_nodes, int64_t n_used, int64_t n_cells, int repeated_nodes) {
  static const int kinds[4] = {4, 5, 6, 8};
  cell_list list = {n_nodes, n_cells, own(calloc((size_t)n_cells + 1, sizeof(int64_t))),
                    own(malloc((size_t)n_cells * 8 * sizeof(int64_t)))};
  for (int64_t c = 0; c < n_cells; ++c) {
    const int n = kind ? kind : kinds[random_bits(&rng) % 4];
    int64_t *nodes = list.nodes + list.offsets[c];
    list.offsets[c + 1] = list.offsets[c] + n;
    for (int k = 0; k < n; ++k) {
      int is_new;
      do { /* chooses nodes near each other, as in a real mesh */
        nodes[k] = (c * n_used / n_cells + (int64_t)(random_bits(&rng) % 40)) % n_used;
        is_new = 1;
        for (int m = 0; m < k && !repeated_nodes; ++m) is_new = is_new && nodes[m] != nodes[k];
      } while (!is_new);
    }
  }
  return list;
}

static pair_list pairs_of_cells(const cell_list *list) {
  pair_list pairs = {0};
  for (int64_t c = 0; c < list->n_cells; ++c) {
    const int64_t *nodes = list->nodes + list->offsets[c];
    const int n = (int)(list->offsets[c + 1] - list->offsets[c]);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < a; ++b)
        if (on_an_edge(n, a, b)) add_pair(&pairs, nodes[a], nodes[b]);
  }
  return pairs;
}

/* Returns the n integers plus `base`, as integers of 32 or 64 bits. */
static void *as_bits(const int64_t *from, int64_t n, int bits, int64_t base) {
  int32_t *narrow = own(malloc((size_t)(n + 1) * sizeof(int64_t)));
  int64_t *wide = (int64_t *)(void *)narrow;
  for (int64_t i = 0; i < n; ++i) {
    if (bits == 32)
      narrow[i] = (int32_t)(from[i] + base);
    else
      wide[i] = from[i] + base;
  }
  return narrow;
}

static riis_mesh_cells cells_init(void) {
  riis_mesh_cells cells;
  CHECK_OK(riis_mesh_cells_init(&cells, sizeof cells));
  return cells;
}

TEST(cells_of_every_kind) {
  static const int kinds[5] = {4, 5, 6, 8, 0};
  for (int k = 0; k < 5; ++k)
    for (int repeated_nodes = 0; repeated_nodes < 2; ++repeated_nodes)
      for (int trial = 0; trial < 2; ++trial) {
        const int owned_before = n_owned();
        const int64_t n_used = 60 + (int64_t)(random_bits(&rng) % 9000),
                      n_nodes = n_used + (int64_t)(random_bits(&rng) % 50);
        cell_list list =
            random_cells(kinds[k], n_nodes, n_used, 1 + (int64_t)(random_bits(&rng) % 12000), repeated_nodes);
        pair_list expected = pairs_of_cells(&list);
        for (int bits = 32; bits <= 64; bits += 32)
          for (int base = 0; base < 2; ++base) {
            const int n_outside = n_owned();
            void *nodes = as_bits(list.nodes, list.offsets[list.n_cells], bits, base);
            void *offsets = as_bits(list.offsets, list.n_cells + 1, bits, 0);
            riis_mesh_cells cells = cells_init();
            cells.n_nodes = n_nodes;
            cells.n_cells = list.n_cells;
            cells.node_ids = nodes;
            cells.id_bits = bits;
            cells.index_base = base;
            riis_adjacency *one = NULL, *four = NULL;
            if (kinds[k] && trial == 0)
              cells.nodes_per_cell = kinds[k];
            else
              cells.offsets = offsets, cells.nodes_per_cell = 77; /* nodes_per_cell is ignored if there are offsets */
            cells.n_threads = 1;
            CHECK_OK(riis_adjacency_create_from_cells(&cells, &one));
            check_rows(one, n_nodes, &expected);
            cells.n_threads = 4;
            CHECK_OK(riis_adjacency_create_from_cells(&cells, &four));
            own(four);
            assert_true(same_rows(one, four));
            riis_adjacency_destroy(&one);
            assert_null(one);
            free_owned_after(n_outside);
          }
        free_owned_after(owned_before);
      }
}

/* One cell of each kind, with its edges listed by hand. */
TEST(one_cell_of_each_kind) {
  static const int n_corners[4] = {4, 5, 6, 8}, n_edges[4] = {6, 8, 9, 12};
  static const int64_t edges[4][24] = {
      {0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3},
      {0, 1, 1, 2, 2, 3, 0, 3, 0, 4, 1, 4, 2, 4, 3, 4},
      {0, 1, 1, 2, 0, 2, 3, 4, 4, 5, 3, 5, 0, 3, 1, 4, 2, 5},
      {0, 1, 1, 2, 2, 3, 0, 3, 4, 5, 5, 6, 6, 7, 4, 7, 0, 4, 1, 5, 2, 6, 3, 7},
  };
  const int32_t ids[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int k = 0; k < 4; ++k) {
    const int owned_before = n_owned();
    riis_mesh_cells cells = cells_init();
    cells.n_nodes = 10;
    cells.n_cells = 1;
    cells.node_ids = ids;
    cells.nodes_per_cell = n_corners[k];
    riis_adjacency *adjacency = NULL;
    CHECK_OK(riis_adjacency_create_from_cells(&cells, &adjacency));
    own(adjacency);
    pair_list expected = {0};
    for (int e = 0; e < n_edges[k]; ++e) add_pair(&expected, edges[k][2 * e], edges[k][2 * e + 1]);
    check_rows(adjacency, 10, &expected);
    free_owned_after(owned_before);
  }
}

/* --- Faces ----------------------------------------------------------------------------------------------------------- */

static riis_mesh_faces faces_init(void) {
  riis_mesh_faces faces;
  CHECK_OK(riis_mesh_faces_init(&faces, sizeof faces));
  return faces;
}

/* A rank without cells passes NULL for each array. */
TEST(nothing_makes_empty_rows) {
  for (int64_t n_nodes = 0; n_nodes <= 3; n_nodes += 3) {
    riis_adjacency *adjacency = NULL;
    pair_list none = {0};
    riis_mesh_cells cells = cells_init();
    cells.n_nodes = n_nodes;
    CHECK_OK(riis_adjacency_create_from_cells(&cells, &adjacency));
    check_rows(adjacency, n_nodes, &none);
    riis_adjacency_destroy(&adjacency);
    riis_mesh_faces faces = faces_init();
    faces.n_cells = n_nodes;
    CHECK_OK(riis_adjacency_create_from_faces(&faces, &adjacency));
    check_rows(adjacency, n_nodes, &none);
    riis_adjacency_destroy(&adjacency);
  }
}

TEST(cells_that_are_refused) {
  int32_t ids[12] = {0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5}, offsets[4] = {0, 4, 8, 12};
  riis_adjacency *adjacency = NULL;
  riis_mesh_cells good = cells_init(), cells;
  assert_int_equal(good.struct_size, sizeof good);
  assert_int_equal(good.nodes_per_cell, 4);
  assert_int_equal(good.id_bits, 32);
  good.n_nodes = 6;
  good.n_cells = 3;
  good.node_ids = ids;
  CHECK_OK(riis_adjacency_create_from_cells(&good, &adjacency));
  riis_adjacency_destroy(&adjacency);
#define REFUSED_WITH(change, status, parts)                                             \
  do {                                                                                  \
    cells = good;                                                                       \
    cells.change;                                                                       \
    CHECK_REFUSED(status, parts, riis_adjacency_create_from_cells(&cells, &adjacency)); \
  } while (0)
  REFUSED_WITH(n_nodes = 0, RIIS_INVALID_MESH, "node 0 of cell 0 is 0; there are nodes 0 to -1");
  REFUSED_WITH(n_nodes = -3, RIIS_INVALID_ARGUMENT, "cells.n_nodes is -3");
  REFUSED_WITH(n_nodes = INT64_MAX, RIIS_LIMIT_EXCEEDED, "cells.n_nodes is 9223372036854775807");
  REFUSED_WITH(n_cells = INT64_MIN, RIIS_INVALID_ARGUMENT, "cells.n_cells is -9223372036854775808");
  REFUSED_WITH(node_ids = NULL, RIIS_INVALID_ARGUMENT, "cells.node_ids|NULL");
  REFUSED_WITH(id_bits = 16, RIIS_INVALID_ARGUMENT, "cells.id_bits is 16|32 or 64");
  REFUSED_WITH(index_base = 2, RIIS_INVALID_ARGUMENT, "cells.index_base is 2|0 or 1");
  REFUSED_WITH(index_base = -1, RIIS_INVALID_ARGUMENT, "cells.index_base is -1");
  REFUSED_WITH(nodes_per_cell = 7, RIIS_INVALID_ARGUMENT, "cells.nodes_per_cell is 7|4, 5, 6 or 8");
  REFUSED_WITH(nodes_per_cell = 0, RIIS_INVALID_ARGUMENT, "cells.nodes_per_cell is 0");
  REFUSED_WITH(n_threads = -1, RIIS_INVALID_ARGUMENT, "cells.n_threads is -1");
  REFUSED_WITH(n_threads = 1025, RIIS_INVALID_ARGUMENT, "cells.n_threads is 1025");
  REFUSED_WITH(struct_size = 0, RIIS_INVALID_STRUCT_SIZE, "cells is 0");
  REFUSED_WITH(struct_size = sizeof cells + 8, RIIS_INVALID_STRUCT_SIZE, "cells is 64");
  REFUSED_WITH(struct_size = sizeof cells - 1, RIIS_INVALID_STRUCT_SIZE, "cells is 55");
  REFUSED_WITH(n_nodes = 5, RIIS_INVALID_MESH, "node 3 of cell 2 is 5|nodes 0 to 4");
  REFUSED_WITH(index_base = 1, RIIS_INVALID_MESH, "node 0 of cell 0 is 0|nodes 1 to 6");
  ids[6] = -7;
  REFUSED_WITH(n_nodes = 6, RIIS_INVALID_MESH, "node 2 of cell 1 is -7");
  ids[6] = INT32_MAX;
  REFUSED_WITH(n_nodes = 6, RIIS_INVALID_MESH, "node 2 of cell 1 is 2147483647");
  ids[6] = 3;
  offsets[1] = 7;
  REFUSED_WITH(offsets = offsets, RIIS_INVALID_MESH, "cell 0 are given from 0 to 7|4, 5, 6 and 8");
  offsets[1] = 4, offsets[2] = 3;
  REFUSED_WITH(offsets = offsets, RIIS_INVALID_MESH, "cell 1 are given from 4 to 3");
  /* Offsets above the last offset, 12, must be refused before the call reads beyond the array. */
  offsets[1] = 8, offsets[2] = 16;
  REFUSED_WITH(offsets = offsets, RIIS_INVALID_MESH, "cell 2 are given from 16 to 12");
  offsets[1] = 4, offsets[2] = 8, offsets[0] = 1;
  REFUSED_WITH(offsets = offsets, RIIS_INVALID_MESH, "cells.offsets begins with 1|begin with 0");
  offsets[0] = 0;
  good.offsets = offsets;
  CHECK_OK(riis_adjacency_create_from_cells(&good, &adjacency));
  riis_adjacency_destroy(&adjacency);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "cells|NULL", riis_adjacency_create_from_cells(NULL, &adjacency));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "adjacency|NULL", riis_adjacency_create_from_cells(&good, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "cells|NULL", riis_mesh_cells_init(NULL, sizeof cells));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "cells is 8", riis_mesh_cells_init(&cells, 8));
  assert_null(adjacency); /* a handle is written only on success */
#undef REFUSED_WITH
}

/* The least 64-bit integer is not a valid node, with base 0 or 1. */
TEST(wildest_integers_are_refused) {
  const int64_t ids[4] = {1, 2, 3, INT64_MIN}, offsets[2] = {1, 2}, columns[1] = {INT64_MIN};
  for (int base = 0; base < 2; ++base) {
    const int owned_before = n_owned();
    riis_adjacency *adjacency = NULL;
    riis_mesh_cells cells = cells_init();
    cells.n_nodes = 6;
    cells.n_cells = 1;
    cells.node_ids = ids;
    cells.id_bits = 64;
    cells.index_base = base;
    CHECK_REFUSED(RIIS_INVALID_MESH, "node 3 of cell 0 is -9223372036854775808",
                  riis_adjacency_create_from_cells(&cells, &adjacency));
    riis_mesh_faces faces;
    CHECK_OK(riis_mesh_faces_init(&faces, sizeof faces));
    faces.n_cells = 3;
    faces.n_faces = 1;
    faces.owner = ids;
    faces.neighbor = ids + 3;
    faces.id_bits = 64;
    faces.index_base = base;
    CHECK_REFUSED(RIIS_INVALID_MESH, "neighbor of face 0 is -9223372036854775808",
                  riis_adjacency_create_from_faces(&faces, &adjacency));
    faces.owner = ids + 3;
    CHECK_REFUSED(RIIS_INVALID_MESH, "owner of face 0 is -9223372036854775808",
                  riis_adjacency_create_from_faces(&faces, &adjacency));
    const double xyz[3] = {0};
    const int64_t offsets_0[2] = {0, 1};
    riis_csr csr;
    CHECK_OK(riis_csr_init(&csr, sizeof csr));
    riis_mesh *mesh = mesh_of(1, xyz);
    csr.n_rows = 1;
    csr.offsets = base ? offsets : offsets_0;
    csr.columns = columns;
    csr.offset_bits = csr.column_bits = 64;
    csr.index_base = base;
    CHECK_REFUSED(RIIS_INVALID_MESH, "row 0|column -9223372036854775808", riis_mesh_set_adjacency(mesh, &csr));
    free_owned_after(owned_before);
  }
  const int64_t wild_offsets[3] = {0, 4, INT64_MIN};
  riis_adjacency *adjacency = NULL;
  riis_mesh_cells cells = cells_init();
  cells.n_nodes = 6;
  cells.n_cells = 2;
  cells.node_ids = (const int64_t[8]){0, 1, 2, 3, 0, 1, 2, 3};
  cells.offsets = wild_offsets;
  cells.id_bits = 64;
  CHECK_REFUSED(RIIS_INVALID_MESH, "cell 1", riis_adjacency_create_from_cells(&cells, &adjacency));
}

TEST(faces_in_every_layout) {
  for (int trial = 0; trial < 6; ++trial) {
    const int owned_before = n_owned();
    const int64_t n_cells = 1 + (int64_t)(random_bits(&rng) % 9000), n_faces = trial == 5 ? 0 : 4 * n_cells;
    int64_t *ends = own(malloc((size_t)(2 * n_faces + 2) * sizeof *ends));
    pair_list expected = {0};
    for (int64_t f = 0; f < n_faces; ++f) {
      int64_t *face = ends + 2 * f;
      if (f > 0 && random_bits(&rng) % 10 == 0) { /* repeats a face, with its two cells in either order */
        const int64_t *again = ends + 2 * (int64_t)(random_bits(&rng) % (uint64_t)f);
        const int turned = again[1] >= 0 && random_bits(&rng) % 2;
        face[0] = again[turned], face[1] = again[!turned];
      } else {
        face[0] = (int64_t)(random_bits(&rng) % (uint64_t)n_cells);
        face[1] = random_bits(&rng) % 5 == 0 ? -1 : (face[0] + (int64_t)(random_bits(&rng) % 30)) % n_cells;
      }
      if (face[1] >= 0) add_pair(&expected, face[0], face[1]);
    }
    for (int bits = 32; bits <= 64; bits += 32)
      for (int base = 0; base < 2; ++base)
        for (int stride = 1; stride <= 2; ++stride) {
          const int n_outside = n_owned();
          int64_t *laid_out = own(malloc((size_t)(2 * n_faces + 2) * sizeof *laid_out));
          for (int64_t f = 0; f < n_faces; ++f)
            for (int e = 0; e < 2; ++e) laid_out[stride == 2 ? 2 * f + e : e * n_faces + f] = ends[2 * f + e];
          char *numbers = as_bits(laid_out, 2 * n_faces, bits, base);
          riis_mesh_faces faces = faces_init();
          faces.n_cells = n_cells;
          faces.n_faces = n_faces;
          faces.owner = n_faces ? numbers : NULL;
          faces.neighbor = n_faces ? numbers + (stride == 2 ? 1 : n_faces) * (bits / 8) : NULL;
          faces.stride = stride;
          faces.id_bits = bits;
          faces.index_base = base;
          faces.n_threads = 1;
          riis_adjacency *one = NULL, *four = NULL;
          CHECK_OK(riis_adjacency_create_from_faces(&faces, &one));
          own(one);
          check_rows(one, n_cells, &expected);
          faces.n_threads = 4;
          CHECK_OK(riis_adjacency_create_from_faces(&faces, &four));
          own(four);
          assert_true(same_rows(one, four));
          free_owned_after(n_outside);
        }
    free_owned_after(owned_before);
  }
}

TEST(faces_that_are_refused) {
  int32_t owner[3] = {0, 1, 2}, neighbor[3] = {1, 2, -1};
  riis_adjacency *adjacency = NULL;
  riis_mesh_faces good = faces_init(), faces;
  assert_int_equal(good.struct_size, sizeof good);
  assert_int_equal(good.stride, 1);
  assert_int_equal(good.id_bits, 32);
  good.n_cells = 3;
  good.n_faces = 3;
  good.owner = owner;
  good.neighbor = neighbor;
  CHECK_OK(riis_adjacency_create_from_faces(&good, &adjacency));
  riis_adjacency_destroy(&adjacency);
#define REFUSED_WITH(change, status, parts)                                             \
  do {                                                                                  \
    faces = good;                                                                       \
    faces.change;                                                                       \
    CHECK_REFUSED(status, parts, riis_adjacency_create_from_faces(&faces, &adjacency)); \
  } while (0)
  REFUSED_WITH(n_cells = 0, RIIS_INVALID_MESH, "owner of face 0 is 0; there are cells 0 to -1");
  REFUSED_WITH(n_cells = INT64_MAX, RIIS_LIMIT_EXCEEDED, "faces.n_cells is 9223372036854775807");
  REFUSED_WITH(n_faces = -1, RIIS_INVALID_ARGUMENT, "faces.n_faces is -1");
  REFUSED_WITH(owner = NULL, RIIS_INVALID_ARGUMENT, "faces.owner|NULL");
  REFUSED_WITH(neighbor = NULL, RIIS_INVALID_ARGUMENT, "faces.neighbor|NULL");
  REFUSED_WITH(stride = 0, RIIS_INVALID_ARGUMENT, "faces.stride is 0");
  REFUSED_WITH(id_bits = 16, RIIS_INVALID_ARGUMENT, "faces.id_bits is 16|32 or 64");
  REFUSED_WITH(index_base = 2, RIIS_INVALID_ARGUMENT, "faces.index_base is 2|0 or 1");
  REFUSED_WITH(n_threads = -1, RIIS_INVALID_ARGUMENT, "faces.n_threads is -1");
  REFUSED_WITH(reserved = 1, RIIS_INVALID_ARGUMENT, "faces.reserved is 1");
  REFUSED_WITH(struct_size = 56, RIIS_INVALID_STRUCT_SIZE, "faces is 56");
  REFUSED_WITH(n_cells = 2, RIIS_INVALID_MESH, "neighbor of face 1 is 2|cells 0 to 1");
  REFUSED_WITH(index_base = 1, RIIS_INVALID_MESH, "owner of face 0 is 0|cells 1 to 3");
  neighbor[2] = -2;
  REFUSED_WITH(n_cells = 3, RIIS_INVALID_MESH, "neighbor of face 2 is -2");
  neighbor[2] = -1, owner[1] = -1;
  REFUSED_WITH(n_cells = 3, RIIS_INVALID_MESH, "owner of face 1 is -1");
  owner[1] = 1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "faces|NULL", riis_adjacency_create_from_faces(NULL, &adjacency));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "adjacency|NULL", riis_adjacency_create_from_faces(&good, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "faces|NULL", riis_mesh_faces_init(NULL, sizeof faces));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "faces is 0", riis_mesh_faces_init(&faces, 0));
  assert_null(adjacency);
#undef REFUSED_WITH
}

/* --- Grids ----------------------------------------------------------------------------------------------------------- */

TEST(grids_of_any_dimension) {
  static const int64_t counts[9][3] = {{1, 1, 1}, {7, 1, 1},   {1, 7, 1},    {1, 1, 7}, {5, 4, 1},
                                       {5, 1, 4}, {1, 90, 80}, {20, 21, 22}, {2, 2, 2}};
  for (int g = 0; g < 9; ++g) {
    const int owned_before = n_owned();
    const int64_t *c = counts[g], n = c[0] * c[1] * c[2];
    pair_list expected = {0};
    for (int64_t k = 0; k < c[2]; ++k)
      for (int64_t j = 0; j < c[1]; ++j)
        for (int64_t i = 0; i < c[0]; ++i) {
          const int64_t node = i + c[0] * (j + c[1] * k);
          if (i + 1 < c[0]) add_pair(&expected, node, i + 1 + c[0] * (j + c[1] * k));
          if (j + 1 < c[1]) add_pair(&expected, node, i + c[0] * (j + 1 + c[1] * k));
          if (k + 1 < c[2]) add_pair(&expected, node, i + c[0] * (j + c[1] * (k + 1)));
        }
    riis_adjacency *one = NULL, *four = NULL;
    CHECK_OK(riis_adjacency_create_from_grid(c[0], c[1], c[2], 1, &one));
    own(one);
    CHECK_OK(riis_adjacency_create_from_grid(c[0], c[1], c[2], 4, &four));
    own(four);
    check_rows(one, n, &expected);
    assert_true(same_rows(one, four));
    free_owned_after(owned_before);
  }
}

TEST(grids_that_are_refused) {
  riis_adjacency *adjacency = NULL;
#define REFUSED_AS(status, ni, nj, nk, parts) \
  CHECK_REFUSED(status, parts, riis_adjacency_create_from_grid(ni, nj, nk, 1, &adjacency))
#define REFUSED(ni, nj, nk, threads, parts) \
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, parts, riis_adjacency_create_from_grid(ni, nj, nk, threads, &adjacency))
  REFUSED(0, 1, 1, 1, "ni is 0");
  REFUSED(1, -1, 1, 1, "nj is -1");
  REFUSED(1, 1, 0, 1, "nk is 0");
  REFUSED_AS(RIIS_LIMIT_EXCEEDED, INT64_MAX, 1, 1, "ni is 9223372036854775807");
  REFUSED_AS(RIIS_LIMIT_EXCEEDED, INT64_C(1) << 40, INT64_C(1) << 40, 1, "1099511627776 * 1099511627776 * 1");
  REFUSED_AS(RIIS_LIMIT_EXCEEDED, INT64_C(1) << 30, INT64_C(1) << 20, INT64_C(1) << 20,
             "1073741824 * 1048576 * 1048576");
  REFUSED(1, 1, 1, -1, "n_threads is -1");
  REFUSED(1, 1, 1, 1025, "n_threads is 1025");
#undef REFUSED
#undef REFUSED_AS
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "adjacency|NULL", riis_adjacency_create_from_grid(1, 1, 1, 1, NULL));
  assert_null(adjacency);
}

int main(void) {
  rng = random_start("test_adjacency");
  return run_cases(NULL, NULL);
}
