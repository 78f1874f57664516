// SPDX-License-Identifier: Apache-2.0
#include "mesh/adjacency.hpp"

#include <algorithm>
#include <limits>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "mesh/cells.hpp"
#include "mesh/incidence.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

constexpr std::int64_t max_count = std::numeric_limits<std::int64_t>::max() / 64;

void check_count(const char *field, std::int64_t n, std::int64_t least) {
  if (n < least || n > max_count)
    fail(n < least ? RIIS_INVALID_ARGUMENT : RIIS_LIMIT_EXCEEDED, field, " is ", n, "; it must be from ", least, " to ",
         max_count);
}

constexpr std::int64_t rows_per_block = 4096;
// Makes rows. append(i, neighbors) appends the neighbours of node i in any order, perhaps with repeats. It is called twice for
// each node, first for the row's length and then for the row's columns, so that memory never holds a list of all pairs.
template <class Append>
OwnAdjacency rows_of(std::int64_t n_nodes, int n_threads, const Append &append) {
  OwnAdjacency made;
  resize(made.offsets, n_nodes + 1);
  view(made.offsets)[0] = 0;
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

// The lists that incidence.hpp takes, for the neighbours of cells: here the nodes are the cells, and an entry is a face between
// two cells.
struct InnerFaces {
  static constexpr std::int64_t most_neighbors = 1;

  IntegerArray owner, neighbor;
  std::int64_t stride, base;
  std::int64_t n_nodes, n_items;

  template <class Visit>
  void for_each_entry(const Range &range, const Visit &visit) const {
    for (std::int64_t face = range.begin; face < range.end; ++face) {
      const std::int64_t other = neighbor[face * stride] - base;
      if (other < 0) continue;
      visit(owner[face * stride] - base, face);
      visit(other, face);
    }
  }
  template <class Visit>
  void for_each_neighbor(std::int64_t face, std::int64_t node, const Visit &visit) const {
    const std::int64_t a = owner[face * stride] - base, b = neighbor[face * stride] - base;
    visit(a == node ? b : a);
  }
  void prefetch(std::int64_t) const {}
};

template <class Id>
OwnAdjacency adjacency_from_cells_with(const riis_mesh_cells &given, int n_threads, const NarrowLimits &limits) {
  const Cells<Id> cells(given, n_threads);
  // Code for cells of one shape takes three quarters of the time of general code. This code is compiled only for meshes that 32
  // bits can count, because hardly any mesh is larger.
  if (given.offsets || cells.n_nodes() > limits.n_nodes || cells.n_listed() > limits.n_entries)
    return adjacency_of_lists(CellsOfAnyShape<Id>(cells), cells.n_listed(), n_threads, limits);
  const auto made_of = [&](const auto &lists) { return narrow_adjacency_of_lists(lists, n_threads); };
  switch (given.nodes_per_cell) {
    case tetrahedron.n_nodes:
      return made_of(CellsOfOneShape<Id, tetrahedron>(cells));
    case pyramid.n_nodes:
      return made_of(CellsOfOneShape<Id, pyramid>(cells));
    case prism.n_nodes:
      return made_of(CellsOfOneShape<Id, prism>(cells));
    default:
      return made_of(CellsOfOneShape<Id, hexahedron>(cells));
  }
}

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
  // The offsets ascend, so no row goes beyond the columns that the last offset announces.
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

OwnAdjacency adjacency_from_cells(const riis_mesh_cells &cells, int n_threads, const NarrowLimits &limits) {
  check_count("cells.n_nodes", cells.n_nodes, 0);
  check_count("cells.n_cells", cells.n_cells, 0);
  check_bits("cells.id_bits", cells.id_bits);
  check_base("cells.index_base", cells.index_base);
  if (cells.n_cells > 0) require(cells.node_ids, "cells.node_ids");
  return cells.id_bits == 64 ? adjacency_from_cells_with<std::int64_t>(cells, n_threads, limits)
                             : adjacency_from_cells_with<std::int32_t>(cells, n_threads, limits);
}

OwnAdjacency adjacency_from_faces(const riis_mesh_faces &faces, int n_threads) {
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
  // Compares the numbers before subtracting the base, because subtracting from an unchecked number may overflow.
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
  return adjacency_of_lists(InnerFaces{owner, neighbor, faces.stride, base, faces.n_cells, faces.n_faces},
                            2 * faces.n_faces, n_threads, {});
}

std::int64_t nodes_of_grid(std::int64_t ni, std::int64_t nj, std::int64_t nk) {
  check_count("ni", ni, 1);
  check_count("nj", nj, 1);
  check_count("nk", nk, 1);
  if (nj > max_count / ni || nk > max_count / (ni * nj))
    fail(RIIS_LIMIT_EXCEEDED, "a grid of ", ni, " * ", nj, " * ", nk, " nodes is more than memory can hold");
  return ni * nj * nk;
}

OwnAdjacency adjacency_from_grid(std::int64_t ni, std::int64_t nj, std::int64_t nk, int n_threads) {
  return rows_of(nodes_of_grid(ni, nj, nk), n_threads, [&](std::int64_t node, std::vector<std::int64_t> &neighbors) {
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
