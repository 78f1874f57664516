// SPDX-License-Identifier: Apache-2.0
// The searches that walk along the mesh's adjacency, and the memory that they reuse from one marking to the next.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/array_view.hpp"
#include "parallel/threads.hpp"
#include "search/search.hpp"

namespace riis {

// A ball that may hold nodes within the limit.
struct NearBall {
  std::int64_t ball;
  double distance;  // a lower bound on the distance of its centre
};

class NeighborScratch {
 public:
  // The memory of one thread, on cache lines that no other thread uses.
  struct alignas(64) Thread {
    std::vector<std::int64_t> next;
    std::vector<NearBall> near_balls;
    std::int64_t n_queries = 0;

    void clear() {
      next.clear();
      near_balls.clear();
      n_queries = 0;
    }
  };
  std::vector<Thread> threads;
  std::vector<std::int64_t> queue;  // nodes in the order in which they were claimed
  std::vector<Range> ranges;
  std::vector<std::int64_t> near_large_balls;
  std::vector<NearBall> near_balls;

  // The number of nodes that a thread passes on to other threads at a time.
  static constexpr std::int64_t nodes_per_range = 128;

  void prepare(std::int64_t n_nodes, int n_threads);
  // Returns true for the first thread that claims the node.
  bool claim(std::int64_t node) {
    std::atomic<std::uint8_t> &mark = marks_.get()[node];
    return mark.load(std::memory_order_relaxed) != walk_ && mark.exchange(walk_, std::memory_order_relaxed) != walk_;
  }
  bool is_claimed(std::int64_t node) const { return marks_.get()[node].load(std::memory_order_relaxed) == walk_; }

 private:
  std::unique_ptr<std::atomic<std::uint8_t>[]> marks_;  // for each node, the number of the last walk that claimed it
  std::int64_t n_marks_ = 0;
  std::uint8_t walk_ = 0;
};

// Walks from neighbour to neighbour (paper, 4.2.2 "Recursive neighbor search"). After the walk, the search proves for each
// remaining node that it is far, or queries it (docs/theory/search.md). The walk starts at the nodes in `last`, which usually are
// the nodes that the last marking found. The mesh must have an adjacency.
SearchReport search_neighbors(const SearchRequest &request, const std::vector<std::int64_t> &last,
                              NeighborScratch &scratch, FoundNodes &found);

// Runs exactly the algorithm of the paper, which does not prove that the remaining nodes are far. The mesh must have an
// adjacency.
SearchReport search_as_the_paper(const SearchRequest &request, NeighborScratch &scratch, FoundNodes &found);

}  // namespace riis
