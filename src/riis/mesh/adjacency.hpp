// SPDX-License-Identifier: Apache-2.0
// The neighbours of each node, as compressed sparse rows. The caller may give the rows, which are then checked but not copied.
// Otherwise the library makes the rows from cells, faces or a structured grid.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <limits>

#include "base/integer_array.hpp"
#include "base/recycled.hpp"

namespace riis {

struct Adjacency {
  static constexpr bool is_symmetric = false;  // the caller's rows need not be symmetric

  std::int64_t n_rows = 0;
  IntegerArray offsets, columns;
  std::int64_t base = 0;

  // Calls visit for every neighbour of node i that is a node of the mesh. Skips ghosts and node i itself.
  template <class Visit>
  void for_each_neighbor(std::int64_t i, const Visit &visit) const {
    const std::int64_t begin = offsets[i] - base, end = offsets[i + 1] - base;
    for (std::int64_t k = begin; k < end; ++k) {
      const std::int64_t j = columns[k] - base;
      if (j < n_rows && j != i) visit(j);
    }
  }

  // Returns whether node j is in row i.
  bool has_neighbor(std::int64_t i, std::int64_t j) const {
    const std::int64_t end = offsets[i + 1] - base;
    std::int64_t k = offsets[i] - base;
    while (k < end && columns[k] - base != j) ++k;
    return k < end;
  }
};

// Checks the caller's rows and borrows them. Fails with RIIS_INVALID_ARGUMENT or RIIS_INVALID_MESH. The message names the field
// or the row, and the value.
Adjacency checked_adjacency(const riis_csr &csr, std::int64_t n_nodes);

// Rows that the library made and owns.
struct OwnAdjacency {
  UnfilledVector<std::int64_t> offsets;
  UnfilledVector<std::int32_t> columns_32;  // for fewer than 2^31 nodes
  UnfilledVector<std::int64_t> columns_64;  // otherwise

  riis_csr csr() const;
};

// Within these limits, 32-bit numbers can count the entries and hold the columns. Each node of each cell counts as one entry. A
// test sets lower limits, so that a small mesh runs the code for large meshes.
struct NarrowLimits {
  std::int64_t n_entries = std::numeric_limits<std::uint32_t>::max();
  std::int64_t n_nodes = std::numeric_limits<std::int32_t>::max();
};

OwnAdjacency adjacency_from_cells(const riis_mesh_cells &cells, int n_threads, const NarrowLimits &limits = {});
OwnAdjacency adjacency_from_faces(const riis_mesh_faces &faces, int n_threads);
// Returns the number of a grid's nodes. Fails with RIIS_LIMIT_EXCEEDED if memory cannot hold so many nodes.
std::int64_t nodes_of_grid(std::int64_t ni, std::int64_t nj, std::int64_t nk);
OwnAdjacency adjacency_from_grid(std::int64_t ni, std::int64_t nj, std::int64_t nk, int n_threads);

}  // namespace riis
