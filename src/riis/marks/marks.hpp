// SPDX-License-Identifier: Apache-2.0
// The results of a marking, and the memory that markings reuse from step to step.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "base/recycled.hpp"
#include "marks/fields.hpp"
#include "marks/node_list.hpp"
#include "marks/put_in_order.hpp"
#include "parallel/threads.hpp"
#include "search/cluster_search.hpp"
#include "search/found_nodes.hpp"
#include "search/neighbor_search.hpp"

namespace riis {

// The data that a marking computes for its nodes, besides their distances.
struct WantedData {
  std::int32_t fields = 0;        // the sum of RIIS_FIELD_* that are computed
  std::int32_t given_fields = 0;  // the sum of the fields that the caller requested
  bool k = false, k_u_surface = false;
  std::int64_t n_directions = 0;  // 0 without RIIS_FIELD_GRADIENT

  FieldSet field_set() const { return {fields, n_directions}; }
  std::int64_t n_k_gradients() const { return k ? n_directions : 0; }  // of each node
};

// The nodes of a list with the data computed for them.
struct ListedNodes {
  NodeList nodes;
  NodeFields fields;
  UnfilledVector<double> k;            // (n), empty without a resistance
  UnfilledVector<double> k_u_surface;  // (3, n), empty without a resistance or velocities
  UnfilledVector<double> k_gradient;   // (n_directions, n), empty without a resistance or RIIS_FIELD_GRADIENT

  bool has_room(const WantedData &data, std::int64_t n) const;
  void reserve(const WantedData &data, std::int64_t n);
};

struct Marks {
  ListedNodes within;       // nodes within the distance limit
  ListedNodes marked;       // used only if the limit is wider than the half thickness; otherwise `within` has them
  bool was_marked = false;  // false until the first marking
  WantedData data;          // the data of the last marking
  bool limit_is_wider = false;
  double distance_limit = 0;
  double half_thickness = 0;
  Threads n_threads = 1;                  // number of threads of the last marking
  std::vector<std::int32_t> leaflet_ids;  // the ids of the surface's leaflets, ascending
  riis_mark_stats stats{};

  // Memory that the next marking reuses.
  FoundNodes found;
  NeighborScratch neighbor_scratch;
  ClusterScratch cluster_scratch;
  OrderScratch order_scratch;
  FieldScratch field_scratch;

  const ListedNodes &marked_list() const { return limit_is_wider ? marked : within; }
  const NodeList &marked_nodes() const { return marked_list().nodes; }
};

}  // namespace riis
