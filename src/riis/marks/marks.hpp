// SPDX-License-Identifier: Apache-2.0
// The results of a marking, and the memory that markings reuse from step to step.
#pragma once

#include <riis/riis.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "kernels/kernels.hpp"
#include "parallel/threads.hpp"
#include "scene/surface.hpp"
#include "search/cluster_search.hpp"
#include "search/neighbor_search.hpp"
#include "search/search.hpp"

namespace riis {

// The arrays that a caller gets from a marking. The arrays have one entry for each node, in ascending order.

// Makes room for n elements. If new memory is needed, reserves 1.5 times the needed size. A moving valve often marks slightly
// more nodes than in all earlier steps. Without the reserve, each such step would allocate memory.
template <class Array>
void reserve_amply(Array &array, std::int64_t n) {
  const auto needed = static_cast<std::size_t>(n);
  if (needed > array.capacity()) array.reserve(needed + needed / 2);
}

// Returns whether the array stays at its address in resize(n).
template <class Array>
bool has_room(const Array &array, std::int64_t n) {
  return static_cast<std::size_t>(n) <= array.capacity();
}

struct NodeList {
  std::vector<std::int64_t> node_id;
  std::vector<double> distance;
  std::vector<std::int64_t> triangle_id;
  std::vector<std::int32_t> leaflet_id;

  std::int64_t size() const { return view(node_id).size(); }
  bool has_room(std::int64_t n) const {
    return riis::has_room(node_id, n) && riis::has_room(distance, n) && riis::has_room(triangle_id, n) &&
           riis::has_room(leaflet_id, n);
  }
  void reserve(std::int64_t n) {
    reserve_amply(node_id, n);
    reserve_amply(distance, n);
    reserve_amply(triangle_id, n);
    reserve_amply(leaflet_id, n);
  }
  // Sets the number of entries. Does not throw if reserve(n) was called before.
  void resize(std::int64_t n) {
    riis::resize(node_id, n);
    riis::resize(distance, n);
    riis::resize(triangle_id, n);
    riis::resize(leaflet_id, n);
  }
  void set(std::int64_t i, std::int64_t node, double node_distance, std::int64_t triangle, std::int32_t leaflet) {
    view(node_id)[i] = node;
    view(distance)[i] = node_distance;
    view(triangle_id)[i] = triangle;
    view(leaflet_id)[i] = leaflet;
  }
};

// A field is a number or a vector at each node's closest point. An example is the velocity, from which a solver computes its
// force. Each requested field becomes an array with an entry for each node within the limit.

// The field NodeFields::height. Every marking with an offset has it, but no caller can request it.
inline constexpr std::int32_t field_height = 1 << 30;

// A set of fields, and the number of the surface's directions of motion, which RIIS_FIELD_GRADIENT needs.
struct FieldSet {
  std::int32_t bits;  // a sum of RIIS_FIELD_* and field_height
  std::int64_t n_directions;
};

// The fields of one list of nodes, in the list's order. The array of a field that was not requested is empty.
struct NodeFields {
  UnfilledVector<double> point, normal, barycentric, velocity;  // (3, n)
  UnfilledVector<double> uv;                                    // (2, n)
  UnfilledVector<double> distance_gradient;                     // (n_directions, n)
  UnfilledVector<double> height;                                // (n), as Band takes it
  UnfilledVector<double> height_gradient;                       // (n_directions, n), with height and distance_gradient
  UnfilledVector<std::int32_t> side, rim, patch_id;             // (n)

  // Reserves memory for n nodes. After this call, resize(m) with m <= n does not throw.
  void reserve(const FieldSet &fields, std::int64_t n);
  bool has_room(const FieldSet &fields, std::int64_t n) const;
  void resize(const FieldSet &fields, std::int64_t n);
};

// Memory that is reused for the fields of the next marking.
struct FieldScratch {
  UnfilledVector<VertexNumbers> at_vertices;
  std::vector<Tie> ties;                           // by node, then by leaflet; a leaflet's closest triangle comes first
  std::vector<Pseudonormals::Rates> normal_rates;  // for each direction, with an offset

  // Reserves memory for the fields of the nodes that a search found, and sorts their ties.
  void prepare(const SearchRequest &request, std::int32_t fields, const FoundNodes &found);
};

// Fails with RIIS_INVALID_ARGUMENT if `fields`, a sum of RIIS_FIELD_*, contains a field that the surface lacks.
void check_fields(const Surface &surface, std::int32_t fields);

// Returns whether the fields of n_nodes nodes need Surface::pseudonormals().
bool need_normals(const Surface &surface, std::int32_t fields, std::int64_t n_nodes);

// Returns the rule by which a search must collect ties for these fields.
TieRule ties_for(const Surface &surface, std::int32_t fields);

// Writes the fields of the nodes in the list. The memory must be reserved, so this function does not throw.
void make_fields(const SearchRequest &request, std::int32_t fields, const NodeList &list, FieldScratch &scratch,
                 NodeFields &made);

// Copies a range of nodes, or of their fields, to the positions from `at` on. A copy within one list must go to a position before
// the range.
void copy_nodes(const NodeList &from, const Range &range, NodeList &to, std::int64_t at);
void copy_fields(const FieldSet &fields, const NodeFields &from, const Range &range, NodeFields &to, std::int64_t at);

// Writes the fields of the nodes in `some`, which is a part of `all`. Both lists are in ascending order of nodes.
void select_fields(const FieldSet &fields, const NodeList &all, const NodeFields &fields_of_all, const NodeList &some,
                   NodeFields &made);

// The functions below merge the lists of several threads into one list in ascending order of nodes. This list has the nodes
// within the limit. If the limit is wider than the half thickness, a second list has the marked nodes.

// A set of nodes whose numbers lie in one range, a bin. The set has a bit for each number of the bin. The rank of a node is the
// number of nodes in the set that have lower numbers. A stretch consists of 64 words of bits. Only stretches that contain nodes
// are written and read.
class NodeRanks {
 public:
  // Makes room for bins of n_numbers. Only this function allocates memory.
  void make_room(std::int64_t n_numbers);
  // Empties the set.
  void clear();
  // `node` is a number within the bin.
  void add(std::int64_t node);
  // Call count() after all nodes were added, and before the first call of rank().
  void count();
  std::int64_t rank(std::int64_t node) const;

 private:
  UnfilledVector<std::uint64_t> words_;
  UnfilledVector<std::uint32_t> before_;  // for each word, the number of nodes in the earlier words
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
  std::int64_t n_lists = 0;      // the number of lists that have nodes; these lists come first
  std::vector<Counts> first;     // each bin's first position in both results, then the results' sizes
  std::vector<NodeRanks> ranks;  // one for each thread
};

// Counts the nodes of both lists. The caller resizes the lists to these numbers before put_in_order fills them. Only this
// function allocates memory.
OrderScratch::Counts prepare_order(const Surface &surface, const FoundNodes &found, bool limit_is_wider, int n_threads,
                                   OrderScratch &scratch);

// Fills the lists. Fills `marked` only if the limit is wider than the half thickness. `numbers` is a range that contains the
// numbers of all found nodes. Call prepare_order first, with the same arguments.
void put_in_order(const Surface &surface, bool limit_is_wider, const Range &numbers, int n_threads,
                  OrderScratch &scratch, NodeList &within, NodeList &marked);

// The data that a marking computes for its nodes, besides their distances.
struct WantedData {
  std::int32_t fields = 0;        // the sum of the RIIS_FIELD_* that are computed
  std::int32_t given_fields = 0;  // the sum of the RIIS_FIELD_* that the caller requested
  bool k = false, k_u_surface = false;
  std::int64_t n_directions = 0;  // 0 without RIIS_FIELD_GRADIENT

  FieldSet field_set() const { return {fields, n_directions}; }
  std::int64_t n_k_gradients() const { return k ? n_directions : 0; }  // of each node
};

// The nodes of a list, with the data that were computed for them.
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
  ListedNodes within;       // nodes within the distance limit, or in a band with an offset
  ListedNodes marked;       // used if the limit exceeds the half thickness; else `within` serves for both
  bool was_marked = false;  // false until the first marking
  WantedData data;          // the data of the last marking
  bool limit_is_wider = false;
  double distance_limit = 0;
  Band band;                              // of the last marking
  Threads n_threads = 1;                  // number of threads of the last marking
  std::vector<std::int32_t> leaflet_ids;  // the ids of the surface's leaflets, ascending
  riis_mark_stats stats{};

  // Memory that the next marking reuses.
  FoundNodes found;
  NeighborScratch neighbor_scratch;
  GridClusters grid_clusters;
  ClusterScratch cluster_scratch;
  OrderScratch order_scratch;
  FieldScratch field_scratch;

  const ListedNodes &marked_list() const { return limit_is_wider ? marked : within; }
  const NodeList &marked_nodes() const { return marked_list().nodes; }
};

}  // namespace riis
