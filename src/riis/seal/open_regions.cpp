// SPDX-License-Identifier: Apache-2.0
#include "seal/open_regions.hpp"

#include <atomic>

#include "parallel/parallel_for.hpp"
#include "seal/open_sets.hpp"

namespace riis {

std::int64_t label_open_regions(const OpenNodes &nodes, int n_threads, ArrayView<std::int64_t> label) {
  constexpr std::int64_t rows_per_task = 4096;
  const std::int64_t n = nodes.adjacency.n_rows;
  OpenSets sets(label);
  parallel_for_ranges(n, rows_per_task, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i)
      label[i] = nodes.node_mask && !nodes.node_mask[i] ? OpenSets::closed : i;
  });
  for (const std::int64_t i : nodes.closed_id) label[i] = OpenSets::closed;
  parallel_for_ranges(n, rows_per_task, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      if (!sets.is_open(i)) continue;
      nodes.adjacency.for_each_neighbor(i, [&](std::int64_t j) {
        if (sets.is_open(j)) sets.unite(i, j);
      });
    }
  });
  std::atomic<std::int64_t> n_regions{0};
  parallel_for_ranges(n, rows_per_task, n_threads, [&](const Range &range, int) {
    std::int64_t n_roots = 0;
    for (std::int64_t i = range.begin; i < range.end; ++i) n_roots += sets.is_open(i) && sets.flatten(i) == i;
    n_regions.fetch_add(n_roots, std::memory_order_relaxed);
  });
  return n_regions;
}

}  // namespace riis
