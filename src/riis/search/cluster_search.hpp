// SPDX-License-Identifier: Apache-2.0
// The search over clusters of nodes, and the memory that it reuses from one marking to the next. The search filters in single
// precision, sixteen triangles at a time, and decides in double precision (docs/theory/clusters.md, "The proof").
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/point_triangle.hpp"
#include "kernels/kernels.hpp"
#include "mesh/grid_clusters.hpp"
#include "search/search.hpp"

namespace riis {

struct ClusterScratch {
  static constexpr std::int32_t room_for_pairs = 4096;

  // A near cluster and its near groups. The groups are in the thread's lists, from `first` on.
  struct Item {
    std::int64_t cluster;
    std::size_t first, n;
    int thread;
    std::uint32_t near_leaves;  // a bit for each leaf that a group may be near
  };
  struct alignas(64) Thread {
    std::vector<std::int32_t> candidates;  // groups near a region
    std::vector<std::uint16_t> bits;       // for each candidate, a bit for each near cluster of the region
    std::vector<Item> items;
    std::vector<std::int32_t> near_groups;  // groups near the clusters of the items
    std::vector<std::uint16_t> leaf_bits;   // for each near group, a bit for each near leaf of the cluster
    std::vector<std::int32_t> leaf_groups;  // the near groups of the leaves that are filtered together
    ClusterTask task;
    std::unique_ptr<GridClusters::Room> room;  // for the clusters of a grid
    struct alignas(64) NodeBounds {
      float of_node[nodes_per_leaf];
    };
    std::vector<NodeBounds> lower_bounds;  // for each group near a leaf, bounds of the leaf's nodes
    std::vector<std::int32_t> pair_nodes, pair_triangles;
    std::vector<double> pair_decided;        // squares of distances
    std::vector<ClosestTriangle> closest;    // closest triangles of a cluster's nodes
    std::vector<std::uint16_t> bits_within;  // for each near group, a bit for each leaf within the limit
    std::int64_t region = -1;                // the region whose groups are in `bits`, in a search with every distance
    std::int64_t n_queries = 0;

    std::int32_t *room_for_groups(std::size_t n_groups) {
      if (leaf_groups.size() < n_groups) leaf_groups.resize(n_groups + n_groups / 2);
      return leaf_groups.data();
    }
    float *room_for_bounds(std::size_t n_groups) {
      if (lower_bounds.size() < n_groups) lower_bounds.resize(n_groups + n_groups / 2);
      return lower_bounds.data()->of_node;
    }
  };
  std::vector<Thread> threads;
  std::vector<std::int64_t> near_regions;
  std::vector<Item> items;
  std::vector<std::int32_t> all_groups;  // 0, 1, 2, ...
  std::vector<float> ends_of_band;       // OneSide::end_of_band

  void prepare(int n_threads, bool needs_room);
};

// Returns false if single precision cannot tell near triangles from far triangles. This happens if the mesh, or its distance from
// the surface, is about a million times as large as the surface. It also happens if the mesh is extremely small.
bool separates_in_single_precision(const NodeSearch &request, const NodeFrame &nodes);

// Returns whether a search over clusters is faster for this number of nodes, if the limit leaves out few nodes. With too few
// nodes, comparing all groups with the first clusters takes longer than querying each node.
bool are_enough_for_clusters(std::int64_t n_nodes, const Surface &surface);

// Returns whether most triangles are beyond the limit for most nodes near the surface.
bool has_few_near(const NodeSearch &request);

// Searches over clusters. The clusters must belong to the request's mesh, and separates_in_single_precision must hold. `kernels`
// must use the instructions of the request. Only ./run bench roofline passes special kernels, which count operations.
SearchReport search_clusters(const NodeSearch &request, const Clusters &clusters, const Kernels &kernels,
                             ClusterScratch &scratch, FoundNodes &found);
SearchReport search_clusters(const NodeSearch &request, const GridClusters &clusters, const Kernels &kernels,
                             ClusterScratch &scratch, FoundNodes &found);

}  // namespace riis
