// SPDX-License-Identifier: Apache-2.0
// The caller's nodes and adjacency, borrowed; checked when they are given. And what searches want to know of them, made when it is first
// asked for.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "geometry/bounds.hpp"
#include "geometry/strided.hpp"
#include "marking/adjacency.hpp"
#include "marking/clusters.hpp"
#include "marking/edges.hpp"
#include "marking/node_balls.hpp"
#include "marking/proportions.hpp"

namespace riis {

class Mesh {
 public:
  Mesh(const StridedPoints &nodes, const Bounds &bounds) : nodes_(nodes), bounds_(bounds) {}

  const StridedPoints &nodes() const { return nodes_; }
  // The box of the nodes as they were given.
  const Bounds &bounds() const { return bounds_; }
  const std::optional<Adjacency> &adjacency() const { return adjacency_; }

  // What is known of where the nodes are no longer holds.
  void forget_places() {
    has_balls_.store(false, std::memory_order_relaxed);
    has_clusters_.store(false, std::memory_order_relaxed);
    has_edges_.store(false, std::memory_order_relaxed);
  }

  // Other coordinates of the same nodes, or other nodes: these have no adjacency yet.
  void set_nodes(const StridedPoints &nodes, const Bounds &bounds);
  void set_adjacency(const std::optional<Adjacency> &adjacency) {
    adjacency_ = adjacency;
    has_edges_.store(false, std::memory_order_relaxed);
  }

  // The nodes in balls of near ones. Several threads may call it at once.
  const NodeBalls &balls(int n_threads) const;
  // The same in clusters, for at most max_clustered_nodes.
  const Clusters &clusters(int n_threads) const;
  // Where the long edges are; the mesh has an adjacency.
  const EdgeBlocks &edges(int n_threads) const;

  // Records a marking of these nodes. Returns true if one was recorded before, or if clusters were made: then clusters pay.
  bool record_marking() const { return was_marked_.exchange(true, std::memory_order_relaxed); }

  // The surfaces that do not fit this mesh, as far as that was said.
  Warned &warned() const { return warned_; }

 private:
  StridedPoints nodes_;
  Bounds bounds_;
  std::optional<Adjacency> adjacency_;
  mutable std::mutex balls_mutex_;
  mutable NodeBalls balls_;
  mutable std::atomic<bool> has_balls_{false};
  mutable std::mutex clusters_mutex_;
  mutable Clusters clusters_;
  mutable std::atomic<bool> has_clusters_{false}, was_marked_{false};
  mutable Warned warned_;
  mutable std::mutex edges_mutex_;
  mutable EdgeBlocks edges_;
  mutable std::atomic<bool> has_edges_{false};
};

}  // namespace riis
