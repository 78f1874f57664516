// SPDX-License-Identifier: Apache-2.0
// A mesh's nodes in leaves, clusters and regions. A leaf holds 32 nodes near each other, a cluster holds 16 leaves, and a region
// holds 16 clusters. Each level has boxes, so a search can dismiss all nodes of a box at once. The nodes of a mesh are put in
// order only once. When nodes move, the order stays, and only the coordinates and the boxes are computed again.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/array_view.hpp"
#include "geometry/strided.hpp"
#include "geometry/vec3.hpp"
#include "kernels/kernels.hpp"
#include "mesh/node_order.hpp"
#include "parallel/parallel_for.hpp"
#include "parallel/threads.hpp"

namespace riis {

// A copy of the coordinates of a leaf's nodes, in double precision. The decision kernel reads these coordinates together, whereas
// they may be far apart in the caller's array.
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

// A leaf stores the numbers of its nodes in 32 bits, which limits the number of nodes.
inline constexpr std::int64_t max_clustered_nodes = INT64_C(0xffffffff);

// The next two functions fail with RIIS_INVALID_MESH for an unusable coordinate. Until clusters are made for the first time,
// their n_nodes is 0.
//   `bounds`: the box of the nodes at the time when the caller gave them.
void sort_into_clusters(const StridedPoints &nodes, const Bounds &bounds, int n_threads, Clusters &clusters);
// Keeps the order, and updates coordinates and boxes to the nodes' new positions.
void place_clusters(const StridedPoints &nodes, const Bounds &bounds, int n_threads, Clusters &clusters);

// Fills clusters with nodes whose order is known:
// makes the leaves, and the boxes of leaves, clusters and regions.

// A node with its number and its coordinates.
struct OrderedNode {
  std::uint32_t number;
  Vec3 at;
};

inline void put_box(const NodeBox &box, Boxes &boxes, std::int64_t at) {
  for (int i = 0; i < 3; ++i) {
    boxes.lower[i][at] = box.lower[i];
    boxes.upper[i][at] = box.upper[i];
  }
}

inline NodeBox box_of(const Boxes &boxes) {
  NodeBox box;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 16; ++k) {
      box.lower[i] = std::min(box.lower[i], boxes.lower[i][k]);
      box.upper[i] = std::max(box.upper[i], boxes.upper[i][k]);
    }
  return box;
}

// Returns boxes that are all empty: lower bounds are +infinity and upper bounds are -infinity, so nothing is near them. Unused
// lanes keep such boxes.
inline Boxes no_boxes() {
  Boxes boxes;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 16; ++k) boxes.lower[i][k] = NodeBox::inf, boxes.upper[i][k] = -NodeBox::inf;
  return boxes;
}

// Makes room for n_nodes nodes. If memory runs out, n_nodes keeps its old value. If this value is 0, it still says that the
// clusters were never made.
void make_room_for(std::int64_t n_nodes, Clusters &clusters);

// Fills clusters, whose frame must be set. The function node_at(i) returns the i-th node in the order, and prefetch(i) requests
// the memory that node_at(i) reads. If a coordinate is unusable (strided.hpp), some boxes will not lie within the frame.
template <class NodeAt, class Prefetch>
void fill_clusters(std::int64_t n_nodes, int n_threads, const NodeAt &node_at, const Prefetch &prefetch,
                   Clusters &clusters) {
  make_room_for(n_nodes, clusters);
  const Kernels &simd = kernels(best_instruction_set());
  const Vec3 centre = clusters.frame.centre;
  const PlainFrame frame{{centre.x, centre.y, centre.z}, clusters.frame.scale};
  parallel_for(view(clusters.regions).size(), n_threads, [&](std::int64_t r, int) {
    Boxes &region = view(clusters.regions)[r];
    region = no_boxes();
    const Range of_region = clusters.clusters_of(r);
    const std::int64_t end = std::min(clusters.leaves_of(of_region.end - 1).end * nodes_per_leaf, n_nodes);
    for (std::int64_t c = of_region.begin; c < of_region.end; ++c) {
      Boxes &cluster = view(clusters.clusters)[c];
      cluster = no_boxes();
      const Range of_cluster = clusters.leaves_of(c);
      for (std::int64_t l = of_cluster.begin; l < of_cluster.end; ++l) {
        Leaf &leaf = clusters.leaves.get()[l];
        double *xyz = clusters.points.get()[l].xyz;
        const std::int64_t first = l * nodes_per_leaf, last = n_nodes - 1;
        // Prefetches the nodes of the next leaf, because they may lie anywhere in the caller's memory. Stops at the end of
        // this region, because another thread reads the next region.
        for (std::int64_t i = first + nodes_per_leaf; i < std::min(first + 2 * nodes_per_leaf, end); ++i) prefetch(i);
        for (int i = 0; i < nodes_per_leaf; ++i) {
          const OrderedNode node = node_at(std::min(first + i, last));
          leaf.node[i] = node.number;
          xyz[3 * i] = node.at.x, xyz[3 * i + 1] = node.at.y, xyz[3 * i + 2] = node.at.z;
        }
        NodeBox box;
        simd.frame_leaf(frame, xyz, leaf, box.lower, box.upper);
        put_box(box, cluster, l - of_cluster.begin);
      }
      put_box(box_of(cluster), region, c - of_region.begin);
    }
    const NodeBox box = box_of(region);
    Clusters::Box &whole = view(clusters.boxes)[r];
    std::copy(box.lower, box.lower + 3, whole.lower);
    std::copy(box.upper, box.upper + 3, whole.upper);
  });
}

}  // namespace riis
