// SPDX-License-Identifier: Apache-2.0
// The checked cells of the caller, and the edges of each shape of cell.
#pragma once

#include <riis/riis.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {

// The edges of one shape of cell, as pairs of positions in a cell's list of nodes. The shape of a cell follows from the cell's
// number of nodes.
struct CellShape {
  int n_nodes, n_edges;
  std::array<std::array<std::uint8_t, 2>, 12> edges;
};
inline constexpr CellShape tetrahedron{4, 6, {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}}};
inline constexpr CellShape pyramid{5, 8, {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}}};
inline constexpr CellShape prism{6, 9, {{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}}};
inline constexpr CellShape hexahedron{
    8, 12, {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}}};

// For each position in a cell's list of nodes, the positions at the other ends of its edges.
struct CellNeighbors {
  struct Positions {
    std::int64_t n = 0;
    std::array<std::uint8_t, 4> at{};
  };
  std::array<Positions, 8> of{};
  std::int64_t most = 0;  // the most neighbours of one position

  constexpr explicit CellNeighbors(const CellShape &shape) {
    for (int e = 0; e < shape.n_edges; ++e) {
      const auto &edge = view(shape.edges)[e];
      for (int end = 0; end < 2; ++end) {
        Positions &positions = view(of)[view(edge)[end]];
        view(positions.at)[positions.n++] = view(edge)[1 - end];
        most = std::max(most, positions.n);
      }
    }
  }
};
template <const CellShape &shape>
inline constexpr CellNeighbors neighbors_in{shape};

inline const CellNeighbors *neighbors_in_cell(std::int64_t n_nodes) {
  switch (n_nodes) {
    case 4:
      return &neighbors_in<tetrahedron>;
    case 5:
      return &neighbors_in<pyramid>;
    case 6:
      return &neighbors_in<prism>;
    case 8:
      return &neighbors_in<hexahedron>;
    default:
      return nullptr;
  }
}

// The caller's list of the cells' nodes, unchanged. The nodes of each cell follow the nodes of the previous cell.
template <class Id>
struct CellNodes {
  const Id *ids, *offsets;  // offsets is NULL if all cells have the same number of nodes
  std::int64_t nodes_per_cell, base, first_offset;

  std::int64_t begin(std::int64_t cell) const { return offsets ? offsets[cell] - first_offset : cell * nodes_per_cell; }
  // Returns the node at a position in the list of all cells' nodes.
  std::int64_t node_at(std::int64_t position) const { return ids[position] - base; }
  void prefetch(std::int64_t position) const { __builtin_prefetch(ids + position); }
};

// Checks the caller's cells, whose node ids are of type Id.
template <class Id>
class Cells {
 public:
  // Checks the sizes of all cells before any node, because the length of the list of nodes is known only from these sizes.
  Cells(const riis_mesh_cells &cells, int n_threads)
      : n_cells_(cells.n_cells),
        n_nodes_(cells.n_nodes),
        nodes_{static_cast<const Id *>(cells.node_ids), static_cast<const Id *>(cells.offsets), cells.nodes_per_cell,
               cells.index_base, 0} {
    if (nodes_.offsets) {
      nodes_.first_offset = nodes_.offsets[0];
      if (nodes_.first_offset != 0 && nodes_.first_offset != nodes_.base)
        fail(RIIS_INVALID_MESH, "cells.offsets begins with ", nodes_.first_offset,
             "; it must begin with 0 or with index_base, ", nodes_.base);
      for_each_block(n_threads, [&](const Range &range) {
        for (std::int64_t cell = range.begin; cell < range.end; ++cell) check_size(cell);
      });
    } else if (!neighbors_in_cell(nodes_.nodes_per_cell))
      fail(RIIS_INVALID_ARGUMENT, "cells.nodes_per_cell is ", nodes_.nodes_per_cell, "; it must be 4, 5, 6 or 8");
    for_each_block(n_threads, [&](const Range &range) {
      if (has_only_nodes(range)) return;
      for (std::int64_t cell = range.begin; cell < range.end; ++cell) check_nodes(cell);
    });
  }

  std::int64_t n_nodes() const { return n_nodes_; }
  std::int64_t n_cells() const { return n_cells_; }
  const CellNodes<Id> &nodes() const { return nodes_; }
  // Returns the total length of the node lists of all cells.
  std::int64_t n_listed() const { return nodes_.begin(n_cells_); }

 private:
  template <class Check>
  void for_each_block(int n_threads, const Check &check) const {
    constexpr std::int64_t cells_per_block = 4096;
    parallel_for_ranges(n_cells_, cells_per_block, n_threads, [&](const Range &range, int) { check(range); });
  }

  // Compares the numbers before the base is subtracted, because subtracting from an unchecked number may overflow.
  void check_size(std::int64_t cell) const {
    const std::int64_t from = nodes_.offsets[cell], to = nodes_.offsets[cell + 1];
    if (to < from || !neighbors_in_cell(to - from))
      fail(RIIS_INVALID_MESH, "the nodes of cell ", cell, " are given from ", from, " to ", to,
           "; there are cells of 4, 5, 6 and 8 nodes");
  }

  bool is_node(std::int64_t given) const { return given >= nodes_.base && given < n_nodes_ + nodes_.base; }
  bool has_only_nodes(const Range &range) const {
    const std::int64_t from = nodes_.begin(range.begin), to = nodes_.begin(range.end);
    Id least = nodes_.ids[from], most = least;
    for (std::int64_t k = from; k < to; ++k) {
      least = std::min(least, nodes_.ids[k]);
      most = std::max(most, nodes_.ids[k]);
    }
    return is_node(least) && is_node(most);
  }
  void check_nodes(std::int64_t cell) const {
    const std::int64_t begin = nodes_.begin(cell), end = nodes_.begin(cell + 1);
    for (std::int64_t k = begin; k < end; ++k)
      if (const std::int64_t given = nodes_.ids[k]; !is_node(given))
        fail(RIIS_INVALID_MESH, "node ", k - begin, " of cell ", cell, " is ", given, "; there are nodes ", nodes_.base,
             " to ", n_nodes_ - 1 + nodes_.base);
  }

  std::int64_t n_cells_, n_nodes_;
  CellNodes<Id> nodes_;
};

// The type Lists that RowMaker needs (adjacency.cpp), for cells of one shape. An entry is a position in the list of all cells'
// nodes.
template <class Id, const CellShape &shape>
struct CellsOfOneShape {
  static constexpr std::int64_t most_neighbors = neighbors_in<shape>.most;

  explicit CellsOfOneShape(const Cells<Id> &cells)
      : nodes(cells.nodes()), n_nodes(cells.n_nodes()), n_items(cells.n_cells()) {}

  CellNodes<Id> nodes;
  std::int64_t n_nodes, n_items;

  template <class Visit>
  void for_each_entry(const Range &range, const Visit &visit) const {
    for (std::int64_t k = range.begin * shape.n_nodes; k < range.end * shape.n_nodes; ++k) visit(nodes.node_at(k), k);
  }
  template <class Visit>
  void for_each_neighbor(std::int64_t entry, std::int64_t, const Visit &visit) const {
    const auto position = static_cast<std::int64_t>(static_cast<std::uint64_t>(entry) % shape.n_nodes);
    const CellNeighbors::Positions &positions = view(neighbors_in<shape>.of)[position];
    for (std::int64_t k = 0; k < most_neighbors && k < positions.n; ++k)
      visit(nodes.node_at(entry - position + view(positions.at)[k]));
  }
  void prefetch(std::int64_t entry) const { nodes.prefetch(entry); }
};

// The type Lists that RowMaker needs, for cells of any shapes. An entry is a cell.
template <class Id>
struct CellsOfAnyShape {
  static constexpr std::int64_t most_neighbors = 7;  // a node listed twice in a cell may be joined to all other nodes

  explicit CellsOfAnyShape(const Cells<Id> &cells)
      : nodes(cells.nodes()), n_nodes(cells.n_nodes()), n_items(cells.n_cells()) {}

  CellNodes<Id> nodes;
  std::int64_t n_nodes, n_items;

  template <class Visit>
  void for_each_entry(const Range &range, const Visit &visit) const {
    for (std::int64_t cell = range.begin; cell < range.end; ++cell) {
      const std::int64_t end = nodes.begin(cell + 1);
      for (std::int64_t k = nodes.begin(cell); k < end; ++k) visit(nodes.node_at(k), cell);
    }
  }
  template <class Visit>
  void for_each_neighbor(std::int64_t cell, std::int64_t node, const Visit &visit) const {
    const std::int64_t begin = nodes.begin(cell), n = nodes.begin(cell + 1) - begin;
    const CellNeighbors &neighbors = *neighbors_in_cell(n);
    for (std::int64_t position = 0; position < n; ++position) {
      if (nodes.node_at(begin + position) != node) continue;
      const CellNeighbors::Positions &positions = view(neighbors.of)[position];
      for (std::int64_t k = 0; k < positions.n; ++k) visit(nodes.node_at(begin + view(positions.at)[k]));
    }
  }
  void prefetch(std::int64_t cell) const { nodes.prefetch(nodes.begin(cell)); }
};

}  // namespace riis
