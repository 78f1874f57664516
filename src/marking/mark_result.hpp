// SPDX-License-Identifier: Apache-2.0
// What a marking found, and the memory it is found in: kept from step to step.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

namespace riis {

// A node within the distance limit, while it is being collected.
struct FoundNode {
  std::int64_t node;
  double distance;
  std::int64_t triangle;  // position in the surface's set
};

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

// Found nodes by the thread that found them, and where those of each block of nodes are. Reused: a steady step
// allocates nothing.
struct Collection {
  struct Block {
    int thread;
    std::size_t begin, end;  // in by_thread[thread]
  };
  std::vector<std::vector<FoundNode>> by_thread;
  std::vector<Block> blocks;
};

struct MarkResult {
  NodeList within;  // the distance limit
  NodeList marked;  // only used while the limit is wider than the half thickness; otherwise `within` is it
  bool limit_is_wider = false;
  double distance_limit = 0;
  int n_threads = 1;  // as asked for
  riis_mark_stats stats{};
  Collection collection;

  const NodeList &marked_nodes() const { return limit_is_wider ? marked : within; }
};

}  // namespace riis
