// SPDX-License-Identifier: Apache-2.0
// A mesh's nodes in leaves of 32 near ones, 16 leaves to a cluster, 16 clusters to a region, each with a box: what a search can dismiss
// together. Made once for a mesh; when nodes move the order stays and places and boxes are made again.
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

// The coordinates of a leaf's nodes as they are: the caller's lie anywhere, and what is decided wants them together.
struct LeafPoints {
  double xyz[3 * nodes_per_leaf];
};

struct Clusters {
  static constexpr std::int64_t clusters_per_region = 16;

  std::int64_t n_nodes = 0;
  NodeFrame frame;  // of the coordinates in leaves and boxes
  std::int64_t n_leaves = 0;
  std::unique_ptr<Leaf[]> leaves;
  std::unique_ptr<LeafPoints[]> points;  // of leaves
  std::vector<Boxes> clusters;           // the boxes of its leaves
  std::vector<Boxes> regions;            // the boxes of its clusters
  struct Box {
    float lower[3], upper[3];
  };
  std::vector<Box> boxes;      // of regions
  std::vector<Bounds> blocks;  // memory of frame_of

  Range leaves_of(std::int64_t cluster) const;
  Range clusters_of(std::int64_t region) const;
  int n_nodes_of(std::int64_t leaf) const;
};

// More nodes than have numbers in a leaf.
inline constexpr std::int64_t max_clustered_nodes = INT64_C(0xffffffff);

// Both fail with RIIS_INVALID_MESH for a coordinate that is not finite. Clusters without nodes have not been made yet.
void sort_into_clusters(const StridedPoints &nodes, int n_threads, Clusters &clusters);
// The nodes of the clusters where they are now.
void place_clusters(const StridedPoints &nodes, int n_threads, Clusters &clusters);

}  // namespace riis
