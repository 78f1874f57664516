// SPDX-License-Identifier: Apache-2.0
// What a marking found, and the memory it is found in: kept from step to step.
#pragma once

#include <riis/riis.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "distance/point_triangle.hpp"
#include "kernels/kernels.hpp"
#include "parallel/range.hpp"
#include "surface/surface.hpp"

namespace riis {

// More than any memory holds the coordinates of.
inline constexpr std::int64_t max_nodes = std::int64_t{1} << 40;

// A node within the distance limit, while it is being collected.
struct FoundNode {
  std::uint64_t node : 40, triangle : 24;  // the latter a position in the surface's set, or of a patch where
                                           // distances are not the triangles'
  double distance;

  FoundNode() = default;
  FoundNode(std::int64_t node_id, double node_distance, std::int64_t position)
      : node(static_cast<std::uint64_t>(node_id) & (max_nodes - 1)),
        triangle(static_cast<std::uint64_t>(position) & (max_triangles - 1)),
        distance(node_distance) {}
};
static_assert(sizeof(FoundNode) == 16);

// Arrays of one entry a node, ascending by node.
struct NodeList {
  std::vector<std::int64_t> node_id;
  std::vector<double> distance;
  std::vector<std::int64_t> triangle_id;
  std::vector<std::int32_t> leaflet_id;

  std::size_t size() const { return node_id.size(); }
  void reserve(std::size_t n);
  void resize(std::size_t n);  // does not throw after reserve(n)
  void set(std::size_t i, std::int64_t node, double node_distance, std::int64_t triangle, std::int32_t leaflet);
};

// Found nodes by the thread that found them, in any order, with what searches and the putting in order need. Reused: a steady step
// allocates nothing of the library's own.
struct Collection {
  std::vector<std::vector<FoundNode>> by_thread;

  // Nodes by their numbers, in stretches: how many of each thread's are in each, then where they begin among all.
  struct Stretch {
    std::int64_t n_within, n_marked;
  };
  std::vector<Stretch> stretches;
  std::vector<FoundNode> by_stretch;

  // A group of nodes that may have some within the limit, and the distance of its centre, or less.
  struct NearGroup {
    std::int64_t group;
    double distance;
  };

  // Where a walk has been.
  struct Walked {
    // A thread's own; on cache lines of its own.
    struct alignas(64) Thread {
      std::vector<std::int64_t> next;
      std::vector<NearGroup> near_groups;
      std::int64_t n_queries = 0;

      void clear() {
        next.clear();
        near_groups.clear();
        n_queries = 0;
      }
    };
    std::vector<Thread> threads;
    std::vector<std::int64_t> queue;  // nodes in the order in which they were claimed
    std::vector<Range> ranges;
    std::vector<NearGroup> near_groups;

    // Nodes that a thread hands on together.
    static constexpr std::int64_t nodes_per_range = 128;

    void prepare(std::int64_t n_nodes, int n_threads);
    // True for the first thread that asks, for each node.
    bool claim(std::int64_t node) {
      std::atomic<std::uint8_t> &mark = marks_[static_cast<std::size_t>(node)];
      return mark.load(std::memory_order_relaxed) != walk_ && mark.exchange(walk_, std::memory_order_relaxed) != walk_;
    }
    bool is_claimed(std::int64_t node) const {
      return marks_[static_cast<std::size_t>(node)].load(std::memory_order_relaxed) == walk_;
    }

   private:
    std::unique_ptr<std::atomic<std::uint8_t>[]> marks_;  // the number of the walk that claimed the node
    std::int64_t n_marks_ = 0;
    std::uint8_t walk_ = 0;
  };
  Walked walked;

  // What a search over clusters needs.
  struct Clustered {
    static constexpr std::int32_t room_for_pairs = 4096;

    // A near cluster, and which of a thread's near groups are its.
    struct Item {
      std::int64_t cluster;
      std::size_t first, n;
      int thread;
    };
    struct alignas(64) Thread {
      std::vector<std::int32_t> candidates;  // of a region
      std::vector<std::uint16_t> bits;       // and which of its clusters each is near to
      std::vector<Item> items;
      std::vector<std::int32_t> near_groups;  // of clusters
      std::vector<std::uint16_t> leaf_bits;   // and which leaves each is near to
      std::vector<std::int32_t> leaf_groups;
      struct alignas(64) NodeBounds {
        float of_node[nodes_per_leaf];
      };
      std::vector<NodeBounds> lower_bounds;  // of a leaf's nodes, for each of its groups
      std::vector<std::int32_t> pair_nodes, pair_triangles;
      std::vector<double> pair_decided;      // squares of distances
      std::vector<ClosestTriangle> closest;  // of a cluster's nodes
      std::int64_t n_queries = 0;

      float *room_for_bounds(std::size_t n_groups) {
        if (lower_bounds.size() < n_groups) lower_bounds.resize(n_groups + n_groups / 2);
        return lower_bounds.data()->of_node;
      }
    };
    std::vector<Thread> threads;
    std::vector<Item> items;

    void prepare(int n_threads);
  };
  Clustered clustered;

  void prepare(int n_threads);
};

// Edges between two unmarked nodes that cross the surface, ascending.
struct LeakingEdges {
  std::vector<std::int64_t> node_id;  // (2, n)
  std::vector<double> length, distance;
};

struct MarkResult {
  NodeList within;  // the distance limit
  NodeList marked;  // only used while the limit is wider than the half thickness; otherwise `within` is it
  bool limit_is_wider = false;
  double distance_limit = 0;
  double half_thickness = 0;
  int n_threads = 1;  // as asked for
  riis_mark_stats stats{};
  LeakingEdges leaking;  // of the last marking, once they were sought
  Collection collection;

  const NodeList &marked_nodes() const { return limit_is_wider ? marked : within; }
};

// Makes the lists of a result from what its collection found, ascending by node, on up to n_threads threads. The list of marked nodes is
// only made where the limit is wider. All memory is reserved before a list is overwritten.
void put_in_order(const Surface &surface, bool limit_is_wider, std::int64_t n_nodes, int n_threads, MarkResult &result);

}  // namespace riis
