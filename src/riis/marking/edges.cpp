// SPDX-License-Identifier: Apache-2.0
#include "marking/edges.hpp"

#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

EdgeBlocks::Block block_of(const StridedPoints &nodes, const Adjacency &adjacency, std::int64_t begin) {
  EdgeBlocks::Block made;
  const std::int64_t end = std::min(begin + EdgeBlocks::rows_per_block, nodes.n);
  for (std::int64_t i = begin; i < end; ++i) {
    const Vec3 p = checked_point(nodes, i, "node", RIIS_INVALID_MESH);
    adjacency.for_each_neighbor(i, [&](std::int64_t j) {
      const Vec3 q = checked_point(nodes, j, "node", RIIS_INVALID_MESH);
      made.longest = std::max(made.longest, distance(p, q));
      made.bounds.add(p);
      made.bounds.add(q);
    });
  }
  return made;
}

}  // namespace

EdgeBlocks edge_blocks(const StridedPoints &nodes, const Adjacency &adjacency, int n_threads) {
  constexpr std::int64_t blocks_per_task = 64;
  EdgeBlocks made;
  const std::int64_t n_blocks = (nodes.n + EdgeBlocks::rows_per_block - 1) / EdgeBlocks::rows_per_block;
  resize(made.blocks, n_blocks);
  parallel_for_ranges(n_blocks, blocks_per_task, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i)
      view(made.blocks)[i] = block_of(nodes, adjacency, i * EdgeBlocks::rows_per_block);
  });
  for (const EdgeBlocks::Block &block : made.blocks) made.longest = std::max(made.longest, block.longest);
  return made;
}

}  // namespace riis
