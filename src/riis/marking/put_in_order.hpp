// SPDX-License-Identifier: Apache-2.0
// Turns the lists of several threads into lists in ascending order of nodes.
// In: found nodes. Out: the nodes within the limit and, if the limit is wider than the half thickness, the marked nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "distance/surface.hpp"
#include "marking/found_nodes.hpp"
#include "marking/node_list.hpp"

namespace riis {

// Memory that put_in_order reuses. A stretch is a range of node numbers.
struct OrderScratch {
  struct Counts {
    std::int64_t n_within, n_marked;
  };
  std::vector<Counts> counts;         // for each stretch and list; later the positions where the nodes begin
  std::vector<FoundNode> by_stretch;  // all found nodes, stretch by stretch
};

// Counts the nodes of both lists. The lists must have these sizes when put_in_order fills them. Only this function allocates
// memory.
OrderScratch::Counts prepare_order(const Surface &surface, const FoundNodes &found, bool limit_is_wider,
                                   std::int64_t n_nodes, int n_threads, OrderScratch &scratch);

// Fills the lists. Fills `marked` only if the limit is wider than the half thickness. Call prepare_order first with the same
// arguments.
void put_in_order(const Surface &surface, const FoundNodes &found, bool limit_is_wider, std::int64_t n_nodes,
                  int n_threads, OrderScratch &scratch, NodeList &within, NodeList &marked);

}  // namespace riis
