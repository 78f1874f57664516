// SPDX-License-Identifier: Apache-2.0
#include "marking/mesh.hpp"

namespace riis {

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
    // Nodes that moved keep their order, which stays good as long as they do not mix.
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
