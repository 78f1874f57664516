// SPDX-License-Identifier: Apache-2.0
#include "marking/adjacency.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>

#include "base/array_view.hpp"
#include "base/errors.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

constexpr std::int64_t max_count = std::numeric_limits<std::int64_t>::max() / 64;

void check_count(const char *field, std::int64_t n, std::int64_t least) {
  if (n < least || n > max_count)
    fail(RIIS_INVALID_ARGUMENT, field, " is ", n, "; it must be from ", least, " to ", max_count);
}

constexpr std::int64_t rows_per_block = 4096;
// Makes rows from a function that appends the neighbours of a node, in any order and with repeats. The function is called twice
// for each node: for the row's length, then for its columns. So no list of all pairs is ever held.
template <class Append>
OwnAdjacency rows_of(std::int64_t n_nodes, int n_threads, const Append &append) {
  OwnAdjacency made;
  resize(made.offsets, n_nodes + 1);
  const auto neighbors_of = [&](std::int64_t i, std::vector<std::int64_t> &neighbors) {
    neighbors.clear();
    append(i, neighbors);
    std::sort(neighbors.begin(), neighbors.end());
    neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  };
  parallel_for_ranges(n_nodes, rows_per_block, n_threads, [&](const Range &range, int) {
    std::vector<std::int64_t> neighbors;
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      neighbors_of(i, neighbors);
      view(made.offsets)[i + 1] = view(neighbors).size();
    }
  });
  for (std::int64_t i = 0; i < n_nodes; ++i) view(made.offsets)[i + 1] += view(made.offsets)[i];
  const bool small = n_nodes <= std::numeric_limits<std::int32_t>::max();
  if (small)
    resize(made.columns_32, made.offsets.back());
  else
    resize(made.columns_64, made.offsets.back());
  parallel_for_ranges(n_nodes, rows_per_block, n_threads, [&](const Range &range, int) {
    std::vector<std::int64_t> neighbors;
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      neighbors_of(i, neighbors);
      std::int64_t at = view(made.offsets)[i];
      for (const std::int64_t j : neighbors) {
        if (small)
          view(made.columns_32)[at++] = static_cast<std::int32_t>(j);
        else
          view(made.columns_64)[at++] = j;
      }
    }
  });
  return made;
}

// The items (cells or faces) that each node is in, in no particular order.
struct ItemsOfNodes {
  std::vector<std::int64_t> offsets, items;
};

// nodes_of(item, visit) calls visit for each node of an item.
template <class NodesOf>
ItemsOfNodes items_of_nodes(std::int64_t n_nodes, std::int64_t n_items, int n_threads, const NodesOf &nodes_of) {
  const auto n = static_cast<std::size_t>(n_nodes);
  const auto next = std::make_unique<std::atomic<std::int64_t>[]>(n + 1);
  for (std::size_t i = 0; i <= n; ++i) next[i].store(0, std::memory_order_relaxed);
  parallel_for_ranges(n_items, rows_per_block, n_threads, [&](const Range &range, int) {
    for (std::int64_t item = range.begin; item < range.end; ++item) {
      nodes_of(item, [&](std::int64_t node) { next.get()[node].fetch_add(1, std::memory_order_relaxed); });
    }
  });
  ItemsOfNodes made;
  made.offsets.resize(n + 1);
  for (std::size_t i = 0; i < n; ++i) {
    made.offsets[i + 1] = made.offsets[i] + next[i].load(std::memory_order_relaxed);
    next[i].store(made.offsets[i], std::memory_order_relaxed);
  }
  resize(made.items, made.offsets[n]);
  parallel_for_ranges(n_items, rows_per_block, n_threads, [&](const Range &range, int) {
    for (std::int64_t item = range.begin; item < range.end; ++item) {
      nodes_of(item, [&](std::int64_t node) {
        const std::int64_t at = next.get()[node].fetch_add(1, std::memory_order_relaxed);
        view(made.items)[at] = item;
      });
    }
  });
  return made;
}

// A cell's edges, as pairs of positions in its list of nodes. The number of nodes decides the shape.
struct CellShape {
  int n_edges;
  std::array<std::array<std::uint8_t, 2>, 12> edges;
};
constexpr CellShape tetrahedron{6, {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}}};
constexpr CellShape pyramid{8, {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}}};
constexpr CellShape prism{9, {{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}}};
constexpr CellShape hexahedron{
    12, {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}}};

const CellShape *shape_of(std::int64_t n_nodes) {
  switch (n_nodes) {
    case 4:
      return &tetrahedron;
    case 5:
      return &pyramid;
    case 6:
      return &prism;
    case 8:
      return &hexahedron;
    default:
      return nullptr;
  }
}

// The caller's cells, checked.
class Cells {
 public:
  explicit Cells(const riis_cells &cells) : cells_(cells), base_(cells.index_base) {
    check_count("cells.n_nodes", cells.n_nodes, 0);
    check_count("cells.n_cells", cells.n_cells, 0);
    check_bits("cells.id_bits", cells.id_bits);
    check_base("cells.index_base", cells.index_base);
    if (cells.n_cells > 0) require(cells.node_ids, "cells.node_ids");
    nodes_ = {cells.node_ids, cells.id_bits == 64};
    if (cells.offsets) {
      offsets_ = {cells.offsets, cells.id_bits == 64};
      first_offset_ = offsets_[0];
      if (first_offset_ != 0 && first_offset_ != base_)
        fail(RIIS_INVALID_MESH, "cells.offsets begins with ", first_offset_,
             "; it must begin with 0 or with index_base, ", base_);
    } else if (!shape_of(cells.nodes_per_cell))
      fail(RIIS_INVALID_ARGUMENT, "cells.nodes_per_cell is ", cells.nodes_per_cell, "; it must be 4, 5, 6 or 8");
    // All offsets are checked before any node: only then is it known where the nodes end.
    if (offsets_.data)
      for (std::int64_t cell = 0; cell < cells.n_cells; ++cell) check_size(cell);
    for (std::int64_t cell = 0; cell < cells.n_cells; ++cell) check_nodes(cell);
  }

  std::int64_t begin(std::int64_t cell) const {
    return offsets_.data ? offsets_[cell] - first_offset_ : cell * cells_.nodes_per_cell;
  }
  std::int64_t size(std::int64_t cell) const { return begin(cell + 1) - begin(cell); }
  std::int64_t node(std::int64_t cell, std::int64_t k) const { return nodes_[begin(cell) + k] - base_; }

 private:
  // Checks the numbers as they are given: subtracting unchecked numbers may overflow.
  void check_size(std::int64_t cell) const {
    const std::int64_t from = offsets_[cell], to = offsets_[cell + 1];
    if (to < from || !shape_of(to - from))
      fail(RIIS_INVALID_MESH, "the nodes of cell ", cell, " are given from ", from, " to ", to,
           "; there are cells of 4, 5, 6 and 8 nodes");
  }

  void check_nodes(std::int64_t cell) const {
    for (std::int64_t k = 0; k < size(cell); ++k) {
      const std::int64_t given = nodes_[begin(cell) + k];
      if (given < base_ || given >= cells_.n_nodes + base_)
        fail(RIIS_INVALID_MESH, "node ", k, " of cell ", cell, " is ", given, "; there are nodes ", base_, " to ",
             cells_.n_nodes - 1 + base_);
    }
  }

  const riis_cells &cells_;
  std::int64_t base_, first_offset_ = 0;
  IntegerArray nodes_, offsets_;
};

}  // namespace

Adjacency checked_adjacency(const riis_csr &csr, std::int64_t n_nodes) {
  if (csr.n_rows != n_nodes)
    fail(RIIS_INVALID_ARGUMENT, "csr.n_rows is ", csr.n_rows, "; the mesh has ", n_nodes, " nodes");
  const std::int64_t n_all = csr.n_all == 0 ? csr.n_rows : csr.n_all;
  if (n_all < csr.n_rows || n_all > max_count)
    fail(RIIS_INVALID_ARGUMENT, "csr.n_all is ", csr.n_all, "; it must be at least n_rows, which is ", csr.n_rows,
         ", and at most ", max_count);
  check_bits("csr.offset_bits", csr.offset_bits);
  check_bits("csr.column_bits", csr.column_bits);
  check_base("csr.index_base", csr.index_base);
  check_reserved("csr.reserved", csr.reserved);
  if (csr.n_rows > 0) require(csr.offsets, "csr.offsets");
  const Adjacency made{
      csr.n_rows, {csr.offsets, csr.offset_bits == 64}, {csr.columns, csr.column_bits == 64}, csr.index_base};
  if (csr.offsets && made.offsets[0] != made.base)
    fail(RIIS_INVALID_MESH, "csr.offsets begins with ", made.offsets[0], "; it must begin with ", made.base);
  for (std::int64_t i = 0; i < csr.n_rows; ++i) {
    const std::int64_t begin = made.offsets[i], end = made.offsets[i + 1];
    if (end < begin)
      fail(RIIS_INVALID_MESH, "row ", i, " of the adjacency ends at ", end, ", before it begins, at ", begin);
  }
  // The offsets ascend, so no row reaches beyond the columns that the last offset promises.
  for (std::int64_t i = 0; i < csr.n_rows; ++i) {
    const std::int64_t begin = made.offsets[i], end = made.offsets[i + 1];
    if (end > begin) require(csr.columns, "csr.columns");
    for (std::int64_t k = begin - made.base; k < end - made.base; ++k) {
      const std::int64_t given = made.columns[k];
      if (given < made.base || given >= n_all + made.base)
        fail(RIIS_INVALID_MESH, "row ", i, " of the adjacency has the column ", given, "; there are nodes ", made.base,
             " to ", n_all - 1 + made.base);
    }
  }
  return made;
}

riis_csr OwnAdjacency::csr() const {
  const auto n = view(offsets).size() - 1;
  const bool small = columns_64.empty();
  return {sizeof(riis_csr),
          n,
          n,
          offsets.data(),
          small ? static_cast<const void *>(columns_32.data()) : static_cast<const void *>(columns_64.data()),
          64,
          small ? 32 : 64,
          0,
          0};
}

OwnAdjacency adjacency_from_cells(const riis_cells &given, int n_threads) {
  const Cells cells(given);
  const ItemsOfNodes cells_of =
      items_of_nodes(given.n_nodes, given.n_cells, n_threads, [&](std::int64_t cell, const auto &visit) {
        for (std::int64_t k = 0; k < cells.size(cell); ++k) visit(cells.node(cell, k));
      });
  return rows_of(given.n_nodes, n_threads, [&](std::int64_t i, std::vector<std::int64_t> &neighbors) {
    for (std::int64_t k = view(cells_of.offsets)[i]; k < view(cells_of.offsets)[i + 1]; ++k) {
      const std::int64_t cell = view(cells_of.items)[k];
      const CellShape &shape = *shape_of(cells.size(cell));
      for (int e = 0; e < shape.n_edges; ++e) {
        const auto &edge = view(shape.edges)[e];
        const std::int64_t a = cells.node(cell, edge[0]), b = cells.node(cell, edge[1]);
        if (a == i && b != i) neighbors.push_back(b);
        if (b == i && a != i) neighbors.push_back(a);
      }
    }
  });
}

OwnAdjacency adjacency_from_faces(const riis_faces &faces, int n_threads) {
  check_count("faces.n_cells", faces.n_cells, 0);
  check_count("faces.n_faces", faces.n_faces, 0);
  check_bits("faces.id_bits", faces.id_bits);
  check_base("faces.index_base", faces.index_base);
  if (faces.stride < 1 || faces.stride > 1024)
    fail(RIIS_INVALID_ARGUMENT, "faces.stride is ", faces.stride, "; it must be from 1 to 1024");
  check_reserved("faces.reserved", faces.reserved);
  if (faces.n_faces > 0) {
    require(faces.owner, "faces.owner");
    require(faces.neighbor, "faces.neighbor");
  }
  const IntegerArray owner{faces.owner, faces.id_bits == 64}, neighbor{faces.neighbor, faces.id_bits == 64};
  const std::int64_t base = faces.index_base;
  const auto end_of = [&](const IntegerArray &ends, std::int64_t face) { return ends[face * faces.stride] - base; };
  // Checks the numbers as they are given, as for cells.
  const auto check = [&](const char *which, std::int64_t face, const IntegerArray &ends, std::int64_t least) {
    const std::int64_t given = ends[face * faces.stride];
    if (given < least || given >= faces.n_cells + base)
      fail(RIIS_INVALID_MESH, which, " of face ", face, " is ", given, "; there are cells ", base, " to ",
           faces.n_cells - 1 + base,
           least == base ? ""
           : base == 1   ? ", and 0 for the boundary"
                         : ", and -1 for the boundary");
  };
  for (std::int64_t face = 0; face < faces.n_faces; ++face) {
    check("owner", face, owner, base);
    check("neighbor", face, neighbor, base - 1);
  }
  const ItemsOfNodes faces_of =
      items_of_nodes(faces.n_cells, faces.n_faces, n_threads, [&](std::int64_t face, const auto &visit) {
        if (end_of(neighbor, face) < 0) return;
        visit(end_of(owner, face));
        visit(end_of(neighbor, face));
      });
  return rows_of(faces.n_cells, n_threads, [&](std::int64_t i, std::vector<std::int64_t> &neighbors) {
    for (std::int64_t k = view(faces_of.offsets)[i]; k < view(faces_of.offsets)[i + 1]; ++k) {
      const std::int64_t face = view(faces_of.items)[k];
      const std::int64_t a = end_of(owner, face), b = end_of(neighbor, face);
      if (a != b) neighbors.push_back(a == i ? b : a);
    }
  });
}

OwnAdjacency adjacency_from_grid(std::int64_t ni, std::int64_t nj, std::int64_t nk, int n_threads) {
  check_count("ni", ni, 1);
  check_count("nj", nj, 1);
  check_count("nk", nk, 1);
  if (nj > max_count / ni || nk > max_count / (ni * nj))
    fail(RIIS_INVALID_ARGUMENT, "a grid of ", ni, " * ", nj, " * ", nk, " nodes is more than memory can hold");
  return rows_of(ni * nj * nk, n_threads, [&](std::int64_t node, std::vector<std::int64_t> &neighbors) {
    const std::int64_t i = node % ni, j = node / ni % nj, k = node / (ni * nj);
    if (i > 0) neighbors.push_back(node - 1);
    if (i + 1 < ni) neighbors.push_back(node + 1);
    if (j > 0) neighbors.push_back(node - ni);
    if (j + 1 < nj) neighbors.push_back(node + ni);
    if (k > 0) neighbors.push_back(node - ni * nj);
    if (k + 1 < nk) neighbors.push_back(node + ni * nj);
  });
}

}  // namespace riis
