/* SPDX-License-Identifier: Apache-2.0
 * Compares adjacencies of small random meshes with a std::set of edges. The meshes have cells of every shape, mixtures of shapes,
 * repeated cells and nodes, nodes in no cell, and nodes in every cell. The integers have each width, and the number of threads
 * varies.
 */
#include <riis/riis.h>

#include "test_support.h"

#include "cell_edges.h"
#include "handles.h"
#include "internals.h"

static random_source rng;

/* Each kind of cells has the same number of meshes. */
enum { n_kinds = 5, n_meshes = 150 * n_kinds, most_cells = 300, most_corners = 8 };

static int64_t below(int64_t n) { return (int64_t)(random_bits(&rng) % (uint64_t)n); }

typedef struct random_mesh {
  int64_t n_nodes, n_cells;
  int64_t offsets[most_cells + 1], nodes[most_cells * most_corners]; /* counted from 0 */
} random_mesh;

/* Makes a mesh. `kind` is the number of corners of the mesh's cells, or 0 for a mixture. */
static void make_mesh(random_mesh *mesh, int kind) {
  static const int kinds[4] = {4, 5, 6, 8};
  const int is_large = below(20) == 0; /* large enough for several blocks of nodes */
  const int64_t n_used = is_large ? 4000 + below(9000) : 1 + below(200),
                n_cells = below(10) ? below(most_cells) : below(3);
  const int repeats_nodes = n_used < most_corners || below(3) == 0, has_hub = below(6) == 0;
  mesh->n_nodes = n_used + below(30);
  mesh->n_cells = n_cells;
  for (int64_t c = 0; c < n_cells; ++c) {
    int64_t *nodes = mesh->nodes + mesh->offsets[c];
    int n = kind ? kind : kinds[below(4)];
    if (c > 0 && below(8) == 0) { /* repeats a cell */
      const int64_t again = below(c), begin = mesh->offsets[again];
      n = (int)(mesh->offsets[again + 1] - begin);
      memmove(nodes, mesh->nodes + begin, (size_t)n * sizeof *nodes);
    } else
      for (int k = 0; k < n; ++k) {
        int is_new;
        do {
          nodes[k] = has_hub && k == 0 ? 0 : below(n_used);
          is_new = 1;
          for (int m = 0; m < k && !repeats_nodes; ++m) is_new = is_new && nodes[m] != nodes[k];
        } while (!is_new);
      }
    mesh->offsets[c + 1] = mesh->offsets[c] + n;
  }
}

static wide_rows rows_by_set(const random_mesh *mesh) {
  edge_set *set = edge_set_make();
  for (int64_t c = 0; c < mesh->n_cells; ++c) {
    const int64_t *nodes = mesh->nodes + mesh->offsets[c];
    const int n = (int)(mesh->offsets[c + 1] - mesh->offsets[c]);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < a; ++b)
        if (on_an_edge(n, a, b)) edge_set_add(set, nodes[a], nodes[b]);
  }
  const wide_rows rows = edge_set_rows(set, mesh->n_nodes);
  edge_set_free(&set);
  return rows;
}

static void put(void *to, int64_t i, int64_t value, int bits) {
  if (bits == 32)
    ((int32_t *)to)[i] = (int32_t)value;
  else
    ((int64_t *)to)[i] = value;
}

TEST(rows_are_those_of_a_set) {
  static const int kinds[n_kinds] = {4, 5, 6, 8, 0};
  static random_mesh mesh;
  static int64_t nodes[most_cells * most_corners], offsets[most_cells + 1];
  int64_t n_wide = 0, n_long_rows = 0;
  for (int trial = 0; trial < n_meshes; ++trial) {
    const int kind = kinds[trial % n_kinds];
    make_mesh(&mesh, kind);
    wide_rows expected = rows_by_set(&mesh);
    const int bits = below(2) ? 32 : 64, base = (int)below(2);
    for (int64_t i = 0; i < mesh.offsets[mesh.n_cells]; ++i) put(nodes, i, mesh.nodes[i] + base, bits);
    const int first = base && below(2);
    for (int64_t c = 0; c <= mesh.n_cells; ++c) put(offsets, c, mesh.offsets[c] + first, bits);
    riis_mesh_cells cells;
    CHECK_OK(riis_mesh_cells_init(&cells, sizeof cells));
    cells.n_nodes = mesh.n_nodes;
    cells.n_cells = mesh.n_cells;
    cells.node_ids = nodes;
    cells.id_bits = bits;
    cells.index_base = base;
    if (kind && below(2))
      cells.nodes_per_cell = kind;
    else
      cells.offsets = offsets;
    for (int width = 0; width < 3; ++width) {
      /* Tests the library's own limits first, then limits that the meshes exceed. */
      const int64_t n_entries = width == 1 ? mesh.offsets[mesh.n_cells] - 1 : -1, n_nodes = width == 2 ? 0 : -1;
      const int n_threads = below(20) ? 1 + (int)below(3) : 9;
      wide_rows rows = {0};
      CHECK_OK(rows_with_limits(&cells, n_threads, n_entries, n_nodes, &rows));
      assert_true(wide_rows_same(&rows, &expected));
      if (rows.offsets[rows.n_rows] > 0) assert_int_equal(rows.column_bits, width == 2 ? 64 : 32);
      n_wide += rows.column_bits == 64;
      for (int64_t i = 0; i < rows.n_rows; ++i) n_long_rows += rows.offsets[i + 1] - rows.offsets[i] > 64;
      wide_rows_free(&rows);
    }
    wide_rows_free(&expected);
  }
  assert_true(n_wide > n_meshes / 2);
  assert_true(n_long_rows > 0);
}

/* Without nodes or without cells the rows are empty, for each width of integers. */
TEST(nothing_makes_empty_rows_in_each_width) {
  for (int64_t n_nodes = 0; n_nodes <= 5000; n_nodes += 5000)
    for (int width = 0; width < 2; ++width)
      for (int n_threads = 1; n_threads <= 3; ++n_threads) {
        riis_mesh_cells cells;
        CHECK_OK(riis_mesh_cells_init(&cells, sizeof cells));
        cells.n_nodes = n_nodes;
        wide_rows rows = {0};
        CHECK_OK(rows_with_limits(&cells, n_threads, -1, width ? 0 : -1, &rows));
        assert_int_equal(rows.n_rows, n_nodes);
        for (int64_t i = 0; i <= n_nodes; ++i) assert_int_equal(rows.offsets[i], 0);
        wide_rows_free(&rows);
      }
}

/* The message names the first wrong cell, whichever thread checks its cells first. */
TEST(the_first_wrong_cell_is_named) {
  enum { n_cells = 20000 };
  int32_t *nodes = own(calloc(4 * n_cells, sizeof *nodes)), *offsets = own(calloc(n_cells + 1, sizeof *offsets));
  for (int c = 0; c < n_cells; ++c) offsets[c + 1] = 4 * (c + 1);
  riis_mesh_cells cells;
  CHECK_OK(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = 1;
  cells.n_cells = n_cells;
  cells.node_ids = nodes;
  nodes[4 * 17000 + 1] = 5, nodes[4 * 9001 + 2] = -3, nodes[4 * 9001 + 3] = 4;
  wide_rows rows = {0};
  for (int has_offsets = 0; has_offsets < 2; ++has_offsets)
    for (int n_threads = 1; n_threads <= 4; ++n_threads) {
      cells.offsets = has_offsets ? offsets : NULL;
      CHECK_REFUSED(RIIS_INVALID_MESH, "node 2 of cell 9001 is -3; there are nodes 0 to 0",
                    rows_with_limits(&cells, n_threads, -1, -1, &rows));
    }
  /* A wrong size is reported before a wrong node. */
  offsets[15001] = 60003, offsets[18001] = 72003;
  for (int n_threads = 1; n_threads <= 4; ++n_threads)
    CHECK_REFUSED(RIIS_INVALID_MESH, "cell 15000 are given from 60000 to 60003",
                  rows_with_limits(&cells, n_threads, -1, -1, &rows));
}

int main(void) {
  rng = random_start("test_adjacency_sets");
  return run_cases(NULL, NULL);
}
