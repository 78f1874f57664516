// SPDX-License-Identifier: Apache-2.0
// What a marking made, and the memory that markings reuse from step to step.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "base/unfilled.hpp"
#include "marking/cluster_search.hpp"
#include "marking/fields.hpp"
#include "marking/found_nodes.hpp"
#include "marking/neighbor_search.hpp"
#include "marking/node_list.hpp"
#include "marking/put_in_order.hpp"
#include "parallel/threads.hpp"

namespace riis {

// The data that a marking makes of its nodes besides their distances.
struct WantedData {
  std::int32_t fields = 0;        // the sum of RIIS_FIELD_* that are made
  std::int32_t given_fields = 0;  // those of them that the caller requested
  bool k = false, k_u_surface = false;
};

// The nodes of a list with the data that the marking made of them.
struct ListedNodes {
  NodeList nodes;
  NodeFields fields;
  UnfilledVector<double> k;            // (n), empty without a resistance
  UnfilledVector<double> k_u_surface;  // (3, n), empty without a resistance or velocities

  bool has_room(const WantedData &data, std::int64_t n) const;
  void reserve(const WantedData &data, std::int64_t n);
};

struct Marks {
  ListedNodes within;       // nodes within the distance limit
  ListedNodes marked;       // used only if the limit is wider than the half thickness; otherwise `within` has them
  bool was_marked = false;  // false for empty marks
  WantedData data;          // of the last marking
  bool limit_is_wider = false;
  double distance_limit = 0;
  double half_thickness = 0;
  Threads n_threads = 1;                  // of the marking
  std::vector<std::int32_t> leaflet_ids;  // of the surface's triangles, each once, ascending
  riis_mark_stats stats{};

  // Memory for the next marking.
  FoundNodes found;
  NeighborScratch neighbor_scratch;
  ClusterScratch cluster_scratch;
  OrderScratch order_scratch;
  FieldScratch field_scratch;

  const ListedNodes &marked_list() const { return limit_is_wider ? marked : within; }
  const NodeList &marked_nodes() const { return marked_list().nodes; }
};

}  // namespace riis
