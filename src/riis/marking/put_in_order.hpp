// SPDX-License-Identifier: Apache-2.0
// Turns the lists of several threads into lists that ascend by node.
// In: found nodes. Out: the nodes within the limit, and also the marked nodes if the limit is wider than the half thickness.
#pragma once

#include <cstdint>
#include <vector>

#include "distance/surface.hpp"
#include "marking/found_nodes.hpp"
#include "marking/node_list.hpp"

namespace riis {

// The memory that putting in order reuses. A stretch is a range of nodes by their numbers.
struct OrderScratch {
  struct Counts {
    std::int64_t n_within, n_marked;
  };
  std::vector<Counts> counts;         // stretch by stretch, list by list; later the places where their nodes begin
  std::vector<FoundNode> by_stretch;  // all found nodes, stretch after stretch
};

// Counts the nodes of both lists, which must have these sizes when put_in_order fills them. Only this function allocates.
OrderScratch::Counts prepare_order(const Surface &surface, const FoundNodes &found, bool limit_is_wider,
                                   std::int64_t n_nodes, int n_threads, OrderScratch &scratch);

// Fills the lists, `marked` only if the limit is wider than the half thickness. Call prepare_order first, with the same
// arguments.
void put_in_order(const Surface &surface, const FoundNodes &found, bool limit_is_wider, std::int64_t n_nodes,
                  int n_threads, OrderScratch &scratch, NodeList &within, NodeList &marked);

}  // namespace riis
