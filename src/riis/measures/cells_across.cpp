// SPDX-License-Identifier: Apache-2.0
#include "measures/measures.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "common/array_view.hpp"
#include "common/edge_lengths.hpp"
#include "geometry/strided.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

constexpr std::int64_t rows_per_block = 4096;

// Adds the lengths of those edges of row i that have a marked node. Leaves out edges that are also in an earlier row.
template <class Edges, class IsMarked>
void add_row(const MeshNodes &nodes, const Edges &edges, std::int64_t i, const IsMarked &is_marked,
             std::vector<std::int64_t> &others, EdgeLengths<double> &lengths) {
  others.clear();
  edges.for_each_neighbor(i, [&](std::int64_t j) {
    if (!is_marked(i) && !is_marked(j)) return;
    if (j < i && edges.has_neighbor(j, i)) return;  // row j counts this edge
    others.push_back(j);
  });
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());  // a row may list a neighbour twice
  for (const std::int64_t j : others) {
    const double length = distance(checked_node(nodes, i), checked_node(nodes, j));
    if (length > 0) lengths.add(length);
  }
}

// Each block of rows has its own sum. The sums are added in the order of the blocks, so the result does not depend on threads.
EdgeLengths<double> lengths_along(const Adjacency &adjacency, const MeshNodes &nodes,
                                  const std::vector<std::int64_t> &marked, int n_threads) {
  std::vector<std::uint8_t> is_marked(static_cast<std::size_t>(nodes.n), 0);
  for (const std::int64_t id : marked) view(is_marked)[id] = 1;
  std::vector<EdgeLengths<double>> by_block(static_cast<std::size_t>((nodes.n + rows_per_block - 1) / rows_per_block));
  parallel_for_ranges(nodes.n, rows_per_block, n_threads, [&](const Range &rows, int) {
    std::vector<std::int64_t> others;
    EdgeLengths<double> lengths;
    for (std::int64_t i = rows.begin; i < rows.end; ++i)
      add_row(
          nodes, adjacency, i, [&](std::int64_t node) { return view(is_marked)[node] != 0; }, others, lengths);
    view(by_block)[rows.begin / rows_per_block] = lengths;
  });
  EdgeLengths<double> all;
  for (const EdgeLengths<double> &block : by_block) all.add(block);
  return all;
}

// Visits only rows near the surface. The rows are divided into the same blocks as in a mesh that lists its points one by one.
// Both kinds of meshes therefore give the same bits.
EdgeLengths<double> lengths_along(const GridEdges &edges, const MeshNodes &nodes,
                                  const std::vector<std::int64_t> &marked, int) {
  std::vector<std::int64_t> rows = marked, others;
  for (const std::int64_t i : marked)
    edges.for_each_neighbor(i, [&](std::int64_t j) {
      if (j < i) rows.push_back(j);
    });
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  const auto is_marked = [&](std::int64_t node) { return std::binary_search(marked.begin(), marked.end(), node); };
  EdgeLengths<double> all, block;
  std::int64_t last_block = 0;
  for (const std::int64_t i : rows) {
    GridIndex index;
    edges.grid.find(i, index);
    const std::int64_t of_row = edges.grid.rank(index) / rows_per_block;
    if (of_row != last_block) {
      all.add(block);
      block = {};
      last_block = of_row;
    }
    add_row(nodes, edges, i, is_marked, others, block);
  }
  all.add(block);
  return all;
}

}  // namespace

riis_cells_across cells_across(const Marks &marks, const Mesh &mesh, int n_threads) {
  return with_edges(mesh, [&](const auto &edges) {
    return lengths_along(edges, mesh.nodes(), marks.marked_nodes().node_id, n_threads)
        .across(marks.band.half_thickness);
  });
}

}  // namespace riis
