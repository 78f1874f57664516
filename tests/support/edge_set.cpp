// SPDX-License-Identifier: Apache-2.0
#include "edge_set.h"

#include <cstdlib>
#include <cstring>
#include <new>
#include <set>
#include <utility>

#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "mesh/adjacency.hpp"

struct edge_set {
  std::set<std::pair<std::int64_t, std::int64_t>> directed;
};

namespace {

wide_rows new_rows(std::int64_t n_rows, std::int64_t n_columns) {
  wide_rows rows{n_rows, static_cast<std::int64_t *>(std::calloc(static_cast<std::size_t>(n_rows + 1), 8)),
                 static_cast<std::int64_t *>(std::calloc(static_cast<std::size_t>(n_columns + 1), 8)), 64};
  if (!rows.offsets || !rows.columns) throw std::bad_alloc();
  return rows;
}

}  // namespace

void wide_rows_free(wide_rows *rows) {
  std::free(rows->offsets);
  std::free(rows->columns);
  *rows = {};
}

int wide_rows_same(const wide_rows *a, const wide_rows *b) {
  if (a->n_rows != b->n_rows) return 0;
  const auto n = static_cast<std::size_t>(a->n_rows);
  return std::memcmp(a->offsets, b->offsets, (n + 1) * 8) == 0 &&
         std::memcmp(a->columns, b->columns, static_cast<std::size_t>(a->offsets[n]) * 8) == 0;
}

edge_set *edge_set_make(void) { return new edge_set; }
void edge_set_free(edge_set **set) {
  delete *set;
  *set = nullptr;
}

void edge_set_add(edge_set *set, std::int64_t a, std::int64_t b) {
  if (a == b) return;
  set->directed.emplace(a, b);
  set->directed.emplace(b, a);
}

wide_rows edge_set_rows(const edge_set *set, std::int64_t n_nodes) {
  wide_rows rows = new_rows(n_nodes, static_cast<std::int64_t>(set->directed.size()));
  std::int64_t n = 0;
  for (const auto &edge : set->directed) {
    rows.columns[n++] = edge.second;
    ++rows.offsets[edge.first + 1];
  }
  for (std::int64_t i = 0; i < n_nodes; ++i) rows.offsets[i + 1] += rows.offsets[i];
  return rows;
}

riis_status rows_with_limits(const riis_mesh_cells *cells, int n_threads, std::int64_t n_entries, std::int64_t n_nodes,
                             wide_rows *rows) {
  return riis::guarded([&] {
    riis::NarrowLimits limits;
    if (n_entries >= 0) limits.n_entries = n_entries;
    if (n_nodes >= 0) limits.n_nodes = n_nodes;
    const riis::OwnAdjacency made = riis::adjacency_from_cells(*cells, n_threads, limits);
    const riis_csr csr = made.csr();
    const riis::IntegerArray offsets{csr.offsets, csr.offset_bits == 64}, columns{csr.columns, csr.column_bits == 64};
    *rows = new_rows(csr.n_rows, offsets[csr.n_rows]);
    rows->column_bits = csr.column_bits;
    for (std::int64_t i = 0; i <= csr.n_rows; ++i) rows->offsets[i] = offsets[i];
    for (std::int64_t k = 0; k < offsets[csr.n_rows]; ++k) rows->columns[k] = columns[k];
  });
}
