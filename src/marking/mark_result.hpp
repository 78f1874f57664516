// SPDX-License-Identifier: Apache-2.0
// The result of a marking, and the memory that markings reuse from step to step.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "marking/cluster_search.hpp"
#include "marking/fields.hpp"
#include "marking/found_nodes.hpp"
#include "marking/neighbor_search.hpp"
#include "marking/node_list.hpp"
#include "marking/put_in_order.hpp"
#include "parallel/threads.hpp"

namespace riis {

// Edges between two unmarked nodes that cross the surface, ascending.
struct LeakingEdges {
  std::vector<std::int64_t> node_id;  // (2, n)
  std::vector<double> length, distance;
};

struct MarkResult {
  NodeList within;          // nodes within the distance limit
  NodeList marked;          // used only if the limit is wider than the half thickness; otherwise `within` has them
  bool was_marked = false;  // false for an empty result
  std::int32_t fields = 0;  // the sum of RIIS_FIELD_* that the last marking kept
  NodeFields fields_within;
  NodeFields fields_marked;  // used only where `marked` is
  bool limit_is_wider = false;
  double distance_limit = 0;
  double half_thickness = 0;
  Threads n_threads = 1;  // of the marking
  riis_mark_stats stats{};
  LeakingEdges leaking;  // empty until a search for leaks follows the marking

  // Memory for the next marking.
  FoundNodes found;
  NeighborScratch neighbor_scratch;
  ClusterScratch cluster_scratch;
  OrderScratch order_scratch;
  FieldScratch field_scratch;

  const NodeList &marked_nodes() const { return limit_is_wider ? marked : within; }
  const NodeFields &marked_fields() const { return limit_is_wider ? fields_marked : fields_within; }
};

}  // namespace riis
