// SPDX-License-Identifier: Apache-2.0
// A mesh's nodes in leaves, clusters and regions. A leaf holds 32 nodes near each other, a cluster holds 16 leaves, and a region
// holds 16 clusters. Each has a box, so that a search can dismiss all its nodes at once. The order of the nodes is made once for
// a mesh. When nodes move, the order stays, and coordinates and boxes are made again.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/bounds.hpp"
#include "geometry/strided.hpp"
#include "kernels/kernels.hpp"
#include "mesh/node_order.hpp"
#include "parallel/range.hpp"

namespace riis {

// The coordinates of a leaf's nodes in double precision, stored together. The caller's array may have them far apart, and the
// decision reads them together.
struct LeafPoints {
  double xyz[3 * nodes_per_leaf];
};

struct Clusters {
  static constexpr std::int64_t clusters_per_region = 16;

  std::int64_t n_nodes = 0;
  NodeFrame frame;  // the frame of the coordinates in leaves and boxes
  std::int64_t n_leaves = 0, room_for_leaves = 0;
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

// The limit exists because a leaf stores node numbers in 32 bits.
inline constexpr std::int64_t max_clustered_nodes = INT64_C(0xffffffff);

// Both functions fail with RIIS_INVALID_MESH for an unusable coordinate. n_nodes is 0 in clusters that were never made.
//   bounds  the box of the nodes at the time when the caller gave them
void sort_into_clusters(const StridedPoints &nodes, const Bounds &bounds, int n_threads, Clusters &clusters);
// Keeps the order, and updates coordinates and boxes to the nodes' new positions.
void place_clusters(const StridedPoints &nodes, const Bounds &bounds, int n_threads, Clusters &clusters);

}  // namespace riis
