// SPDX-License-Identifier: Apache-2.0
// The caller's nodes and adjacency, borrowed; checked when they are given. And what searches want to know of them, made when it is first
// asked for.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "geometry/strided.hpp"
#include "marking/adjacency.hpp"
#include "marking/clusters.hpp"
#include "marking/edges.hpp"
#include "marking/node_groups.hpp"

namespace riis {

class Mesh {
 public:
  explicit Mesh(const StridedPoints &nodes) : nodes_(nodes) {}

  const StridedPoints &nodes() const { return nodes_; }
  const std::optional<Adjacency> &adjacency() const { return adjacency_; }

  // What is known of where the nodes are no longer holds.
  void forget_places() {
    has_groups_.store(false, std::memory_order_relaxed);
    has_clusters_.store(false, std::memory_order_relaxed);
    has_edges_.store(false, std::memory_order_relaxed);
  }

  // Other coordinates of the same nodes, or other nodes: these have no adjacency yet.
  void set_nodes(const StridedPoints &nodes);
  void set_adjacency(const std::optional<Adjacency> &adjacency) {
    adjacency_ = adjacency;
    has_edges_.store(false, std::memory_order_relaxed);
  }

  // The nodes in groups of near ones. May be asked for by several threads at once.
  const NodeGroups &groups(int n_threads) const;
  // The same in clusters, for at most max_clustered_nodes.
  const Clusters &clusters(int n_threads) const;
  // Where the long edges are; the mesh has an adjacency.
  const EdgeBlocks &edges(int n_threads) const;

  // Counts a marking of these nodes; true if it is not the first, or if clusters were made before: then they pay.
  bool pays_for_clusters() const { return was_marked_.exchange(true, std::memory_order_relaxed); }

 private:
  StridedPoints nodes_;
  std::optional<Adjacency> adjacency_;
  mutable std::mutex groups_mutex_;
  mutable NodeGroups groups_;
  mutable std::atomic<bool> has_groups_{false};
  mutable std::mutex clusters_mutex_;
  mutable Clusters clusters_;
  mutable std::atomic<bool> has_clusters_{false}, was_marked_{false};
  mutable std::mutex edges_mutex_;
  mutable EdgeBlocks edges_;
  mutable std::atomic<bool> has_edges_{false};
};

}  // namespace riis
