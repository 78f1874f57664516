// SPDX-License-Identifier: Apache-2.0
// The nodes of a grid in leaves, clusters and regions, as the search over clusters needs them. Leaves, clusters and regions are
// bricks of nodes, so their boxes are computed from the axes. A thread fills the leaves of one cluster at a time. Only the nodes
// within one box, which is the part of the grid near a surface, are included.
#pragma once

#include <cstdint>
#include <vector>

#include "common/array_view.hpp"
#include "kernels/kernels.hpp"
#include "mesh/clusters.hpp"
#include "mesh/grid.hpp"
#include "mesh/node_order.hpp"

namespace riis {

class GridClusters {
 public:
  // The memory of one thread. It holds boxes, and the leaves of the cluster that the thread has opened.
  struct Room {
    Boxes region, cluster;
    GridIndex begin;     // the cluster's first node, counted from the first node of the grid's box
    std::int64_t first;  // the number of this node, counted in the same way
    Leaf leaves[leaves_per_cluster];
    LeafPoints points[leaves_per_cluster];
  };

  // Sets the box whose nodes are included. The box must have at least one node. The memory of earlier boxes is reused.
  void make(const Grid &grid, const GridBox &box);

  const NodeFrame &frame() const { return frame_; }
  std::int64_t n_regions() const { return n_regions_[0] * n_regions_[1] * n_regions_[2]; }
  std::int64_t n_clusters() const { return n_regions() * Clusters::clusters_per_region; }

  // Return the boxes of a region's clusters, and of a cluster's leaves.
  const Boxes &region(std::int64_t region, Room *room) const {
    return boxes_at(begin_of_region(region), clusters_, cluster_extent_, room->region);
  }
  const Boxes &cluster(std::int64_t cluster, Room *room) const {
    return boxes_at(begin_of(cluster), leaves_, leaf_extent_, room->cluster);
  }

  // Opens a cluster, and fills those of its leaves whose bit in `leaves` is set.
  void open(std::int64_t cluster, std::uint32_t leaves, Room &room) const;
  // Returns a bit for each lane of a leaf. The bit is set if the lane has a node.
  std::uint32_t lanes(int leaf, const Room &room) const;
  // The numbers of a leaf's nodes, counted from the number of the box's first node.
  struct Numbers {
    std::int64_t first;
    const std::int64_t *step;
    std::int64_t operator[](int lane) const { return first + step[lane]; }
  };
  Numbers numbers(int leaf, const Room &room) const { return {room.first, step_ + nodes_per_leaf * leaf}; }
  // Writes the points of those lanes of a leaf whose bit is set.
  void fill_points(int leaf, std::uint32_t lanes, Room &room) const;

 private:
  // Where the parts of a brick begin along each axis, counted in nodes from the brick's first node.
  struct Parts {
    std::int32_t at[3][nodes_per_leaf];
  };
  Parts parts_of(int n, GridIndex &extent) const;
  GridIndex begin_of_region(std::int64_t region) const;
  GridIndex begin_of(std::int64_t cluster) const;
  const Boxes &boxes_at(const GridIndex &begin, const Parts &parts, const GridIndex &extent, Boxes &boxes) const;

  const Grid *grid_ = nullptr;
  GridBox box_;
  NodeFrame frame_;
  GridIndex n_regions_, leaf_extent_, cluster_extent_, region_extent_;
  Parts lanes_, leaves_, clusters_;       // the parts of a leaf, a cluster and a region
  std::int64_t step_[nodes_per_cluster];  // the step from a cluster's first number to each node's number
  std::vector<float> x_[3];  // coordinates in the frame. The last coordinate is repeated to the end of the last region
};

}  // namespace riis
