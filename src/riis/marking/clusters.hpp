// SPDX-License-Identifier: Apache-2.0
// A mesh's nodes in leaves, clusters and regions. A leaf has 32 nodes near each other, a cluster 16 leaves, a region 16 clusters.
// Each has a box, so that a search can dismiss its nodes together. The order is made once for a mesh. When nodes move, the order
// stays; places and boxes are made again.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/bounds.hpp"
#include "geometry/strided.hpp"
#include "kernels/kernels.hpp"
#include "marking/node_order.hpp"
#include "parallel/range.hpp"

namespace riis {

// The coordinates of a leaf's nodes in double precision, side by side: in the caller's array they lie anywhere, and the decision
// reads them together.
struct LeafPoints {
  double xyz[3 * nodes_per_leaf];
};

struct Clusters {
  static constexpr std::int64_t clusters_per_region = 16;

  std::int64_t n_nodes = 0;
  NodeFrame frame;  // the coordinates in leaves and boxes are in this frame
  std::int64_t n_leaves = 0;
  std::unique_ptr<Leaf[]> leaves;
  std::unique_ptr<LeafPoints[]> points;  // one per leaf
  std::vector<Boxes> clusters;           // for each cluster, the boxes of its leaves
  std::vector<Boxes> regions;            // for each region, the boxes of its clusters
  struct Box {
    float lower[3], upper[3];
  };
  std::vector<Box> boxes;  // one per region

  Range leaves_of(std::int64_t cluster) const;
  Range clusters_of(std::int64_t region) const;
  int n_nodes_of(std::int64_t leaf) const;
};

// A leaf stores node numbers in 32 bits.
inline constexpr std::int64_t max_clustered_nodes = INT64_C(0xffffffff);

// Both functions fail with RIIS_INVALID_MESH for an unusable coordinate. Clusters with n_nodes 0 have not been made yet.
//   bounds  of the nodes when they were given
void sort_into_clusters(const StridedPoints &nodes, const Bounds &bounds, int n_threads, Clusters &clusters);
// Keeps the order and updates places and boxes to the nodes' new coordinates.
void place_clusters(const StridedPoints &nodes, const Bounds &bounds, int n_threads, Clusters &clusters);

}  // namespace riis
