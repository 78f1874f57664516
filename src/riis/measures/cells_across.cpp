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
riis_cells_across cells_across(const Marks &marks, const Mesh &mesh, const Adjacency &adjacency, int n_threads) {
  const StridedPoints &nodes = mesh.nodes();
  std::vector<std::uint8_t> is_marked(static_cast<std::size_t>(nodes.n), 0);
  for (const std::int64_t id : marks.marked_nodes().node_id) view(is_marked)[id] = 1;
  // Each block of rows has its own sum. The sums are added in the order of the blocks, so the result does not depend on threads.
  constexpr std::int64_t rows_per_block = 4096;
  std::vector<EdgeLengths<double>> by_block(static_cast<std::size_t>((nodes.n + rows_per_block - 1) / rows_per_block));
  parallel_for_ranges(nodes.n, rows_per_block, n_threads, [&](const Range &rows, int) {
    std::vector<std::int64_t> others;
    EdgeLengths<double> lengths;
    for (std::int64_t i = rows.begin; i < rows.end; ++i) {
      others.clear();
      adjacency.for_each_neighbor(i, [&](std::int64_t j) {
        if (!view(is_marked)[i] && !view(is_marked)[j]) return;
        if (j < i && adjacency.has_neighbor(j, i)) return;  // row j counts this edge
        others.push_back(j);
      });
      std::sort(others.begin(), others.end());
      others.erase(std::unique(others.begin(), others.end()), others.end());  // a row may list a neighbour twice
      for (const std::int64_t j : others) {
        const double length = distance(checked_point(nodes, i, "node", RIIS_INVALID_MESH),
                                       checked_point(nodes, j, "node", RIIS_INVALID_MESH));
        if (length > 0) lengths.add(length);
      }
    }
    view(by_block)[rows.begin / rows_per_block] = lengths;
  });
  EdgeLengths<double> all;
  for (const EdgeLengths<double> &block : by_block) all.add(block);
  return all.across(marks.band.half_thickness);
}

}  // namespace riis
