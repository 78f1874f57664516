// SPDX-License-Identifier: Apache-2.0
#include "measures/measures.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "common/array_view.hpp"
#include "geometry/strided.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

struct Lengths {
  std::int64_t n = 0;
  double sum = 0, shortest = std::numeric_limits<double>::infinity(), longest = 0;

  void add(double length) {
    ++n;
    sum += length;
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  void add(const Lengths &other) {
    n += other.n;
    sum += other.sum;
    shortest = std::min(shortest, other.shortest);
    longest = std::max(longest, other.longest);
  }
};

}  // namespace

riis_cells_across cells_across(const Marks &marks, const Mesh &mesh, const Adjacency &adjacency, int n_threads) {
  const StridedPoints &nodes = mesh.nodes();
  std::vector<std::uint8_t> is_marked(static_cast<std::size_t>(nodes.n), 0);
  for (const std::int64_t id : marks.marked_nodes().node_id) view(is_marked)[id] = 1;
  // Each block of rows has its own sum. The sums are added in the order of the blocks, so the result does not depend on threads.
  constexpr std::int64_t rows_per_block = 4096;
  std::vector<Lengths> by_block(static_cast<std::size_t>((nodes.n + rows_per_block - 1) / rows_per_block));
  parallel_for_ranges(nodes.n, rows_per_block, n_threads, [&](const Range &rows, int) {
    std::vector<std::int64_t> others;
    Lengths lengths;
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
  Lengths all;
  for (const Lengths &block : by_block) all.add(block);
  const double eps = marks.band.half_thickness;
  if (all.n == 0) return {0, 0, 0, 0, 0, 0, eps, 0};
  // The mean is limited to the range of the lengths, because the rounded sum could put it outside. Otherwise the mean of equal
  // lengths could differ from them.
  const double mean = std::clamp(all.sum / static_cast<double>(all.n), all.shortest, all.longest);
  return {2 * eps / all.longest, 2 * eps / mean, 2 * eps / all.shortest, all.shortest, mean, all.longest, eps, all.n};
}

}  // namespace riis
