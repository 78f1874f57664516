// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh.hpp"

#include <algorithm>

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

}  // namespace

void Mesh::borrow_nodes(const StridedPoints &nodes, const Bounds &bounds) {
  set_nodes(nodes, bounds);
  own_xyz_ = {};
}

void Mesh::set_nodes(const StridedPoints &nodes, const Bounds &bounds) {
  if (nodes.n != nodes_.n) {
    adjacency_.reset();
    balls_.order.clear();
    clusters_.n_nodes = 0;
    was_marked_.store(false, std::memory_order_relaxed);
  }
  nodes_ = nodes;
  bounds_ = bounds;
  forget_places();
}

const NodeBalls &Mesh::balls(int n_threads) const {
  if (has_balls_.load(std::memory_order_acquire)) return balls_;
  const std::lock_guard<std::mutex> lock(balls_mutex_);
  if (!has_balls_.load(std::memory_order_relaxed)) {
    // Nodes that moved keep their order. It stays good while nodes near each other stay together.
    if (balls_.order.empty()) sort_into_balls(nodes_, bounds_, n_threads, balls_);
    enclose(nodes_, n_threads, balls_);
    has_balls_.store(true, std::memory_order_release);
  }
  return balls_;
}

const Clusters &Mesh::clusters(int n_threads) const {
  if (has_clusters_.load(std::memory_order_acquire)) return clusters_;
  const std::lock_guard<std::mutex> lock(clusters_mutex_);
  if (!has_clusters_.load(std::memory_order_relaxed)) {
    if (clusters_.n_nodes == 0)
      sort_into_clusters(nodes_, bounds_, n_threads, clusters_);
    else
      place_clusters(nodes_, bounds_, n_threads, clusters_);
    was_marked_.store(true, std::memory_order_relaxed);
    has_clusters_.store(true, std::memory_order_release);
  }
  return clusters_;
}

const EdgeBlocks &Mesh::edges(int n_threads) const {
  if (has_edges_.load(std::memory_order_acquire)) return edges_;
  const std::lock_guard<std::mutex> lock(edges_mutex_);
  if (!has_edges_.load(std::memory_order_relaxed)) {
    edges_ = edge_blocks(nodes_, *adjacency_, n_threads);
    has_edges_.store(true, std::memory_order_release);
  }
  return edges_;
}

}  // namespace riis
