// SPDX-License-Identifier: Apache-2.0
// Turns the lists of several threads into lists in ascending order of nodes.
// In: found nodes. Out: the nodes within the limit and, if the limit is wider than the half thickness, the marked nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "base/recycled.hpp"
#include "marks/node_list.hpp"
#include "scene/surface.hpp"
#include "search/found_nodes.hpp"

namespace riis {

// A bin is a range of node numbers. This is a set of nodes of one bin, with a bit for each number of the bin. It gives each node
// a rank, which is the number of lesser nodes in the set. A stretch is 64 words of bits. Only stretches with nodes are written
// and read.
class NodeRanks {
 public:
  // Makes room for bins of n_numbers. Only this function allocates memory.
  void make_room(std::int64_t n_numbers);
  // Empties the set.
  void clear();
  // `node` is a number within the bin.
  void add(std::int64_t node);
  // Call this after all nodes were added, and before the first rank is requested.
  void count();
  std::int64_t rank(std::int64_t node) const;

 private:
  UnfilledVector<std::uint64_t> words_;
  UnfilledVector<std::uint32_t> before_;  // for each word, the number of nodes in the words before it
  std::vector<std::uint8_t> stretch_has_nodes_;
};

// Memory that put_in_order reuses.
struct OrderScratch {
  struct Counts {
    std::int64_t n_within, n_marked;
  };
  // The nodes of a thread's list, bin by bin.
  struct alignas(64) List {
    const UnfilledVector<FoundNode> *found;  // while they are gathered
    UnfilledVector<FoundNode> nodes;
    std::vector<Counts> n;          // for each bin
    std::vector<std::int64_t> end;  // for each bin, the end of its nodes
  };
  std::vector<List> lists;
  std::int64_t n_lists = 0;      // the number of lists that have nodes; they come first
  std::vector<Counts> first;     // for each bin, its first position in each result; at last the sizes of both results
  std::vector<NodeRanks> ranks;  // one for each thread
};

// Counts the nodes of both lists. The lists must have these sizes when put_in_order fills them. Only this function allocates
// memory.
OrderScratch::Counts prepare_order(const Surface &surface, const FoundNodes &found, bool limit_is_wider,
                                   std::int64_t n_nodes, int n_threads, OrderScratch &scratch);

// Fills the lists. Fills `marked` only if the limit is wider than the half thickness. Call prepare_order first with the same
// arguments.
void put_in_order(const Surface &surface, bool limit_is_wider, std::int64_t n_nodes, int n_threads,
                  OrderScratch &scratch, NodeList &within, NodeList &marked);

}  // namespace riis
