// SPDX-License-Identifier: Apache-2.0
#include "marking/clusters.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

void put_box(const NodeBox &box, Boxes &boxes, std::int64_t at) {
  for (int i = 0; i < 3; ++i) {
    boxes.lower[i][at] = box.lower[i];
    boxes.upper[i][at] = box.upper[i];
  }
}

NodeBox box_of(const Boxes &boxes) {
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
Boxes no_boxes() {
  Boxes boxes;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 16; ++k) boxes.lower[i][k] = infinity, boxes.upper[i][k] = -infinity;
  return boxes;
}

std::int64_t n_of(std::int64_t n, std::int64_t size) { return (n + size - 1) / size; }

// Fills leaves with the nodes node_of(position), and then makes the boxes. If memory runs out, n_nodes stays as it was, so
// clusters that were never made do not count as made.
template <class NodeOf>
void fill(const StridedPoints &nodes, Clusters &clusters, int n_threads, const NodeOf &node_of) {
  const std::int64_t n_nodes = nodes.n;
  const std::int64_t n_leaves = n_of(n_nodes, nodes_per_leaf);
  const std::int64_t n_clusters = n_of(n_nodes, nodes_per_cluster);
  if (n_leaves != clusters.n_leaves) {
    clusters.n_leaves = 0;
    // The memory is left unfilled. So the thread that uses a page of it is also the first to write to that page.
    const auto n = static_cast<std::size_t>(n_leaves);
    clusters.leaves.reset(new Leaf[n]);
    clusters.points.reset(new LeafPoints[n]);
    clusters.n_leaves = n_leaves;
  }
  resize(clusters.clusters, n_clusters);
  resize(clusters.regions, n_of(n_clusters, Clusters::clusters_per_region));
  clusters.boxes.resize(clusters.regions.size());
  clusters.n_nodes = n_nodes;
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
        const std::int64_t first = l * nodes_per_leaf, last = clusters.n_nodes - 1;
        // Prefetches the next leaf's nodes, because they may lie anywhere in the caller's memory. Stops at the end of this
        // region, because another thread reads the next one.
        for (std::int64_t i = first + nodes_per_leaf; i < std::min(first + 2 * nodes_per_leaf, end); ++i)
          nodes.prefetch(node_of(i));
        NodeBox box;
        for (int i = 0; i < nodes_per_leaf; ++i) {
          const std::uint32_t node = node_of(std::min(first + i, last));
          const Vec3 p = node_at(nodes, node);
          float x[3];
          clusters.frame(p, x);
          leaf.x[i] = x[0], leaf.y[i] = x[1], leaf.z[i] = x[2];
          leaf.node[i] = node;
          xyz[3 * i] = p.x, xyz[3 * i + 1] = p.y, xyz[3 * i + 2] = p.z;
          box.add(x);
        }
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

// Checks that all boxes lie within the frame. The caller may have moved nodes without telling the mesh. The errors of single
// precision are bounded only for coordinates of at most 1.
bool are_within_frame(const Clusters &clusters) {
  return std::all_of(clusters.boxes.begin(), clusters.boxes.end(), [](const Clusters::Box &box) {
    return std::all_of(box.lower, box.lower + 3, [](float x) { return x >= -1; }) &&
           std::all_of(box.upper, box.upper + 3, [](float x) { return x <= 1; });
  });
}

Bounds bounds_of(const StridedPoints &nodes) {
  Bounds bounds;
  for (std::int64_t i = 0; i < nodes.n; ++i) bounds.add(node_at(nodes, i));
  return bounds;
}

}  // namespace

Range Clusters::leaves_of(std::int64_t cluster) const {
  const std::int64_t begin = cluster * leaves_per_cluster;
  return {begin, std::min(begin + leaves_per_cluster, n_leaves)};
}

Range Clusters::clusters_of(std::int64_t region) const {
  const std::int64_t begin = region * clusters_per_region;
  return {begin, std::min(begin + clusters_per_region, view(clusters).size())};
}

int Clusters::n_nodes_of(std::int64_t leaf) const {
  return static_cast<int>(std::min<std::int64_t>(nodes_per_leaf, n_nodes - leaf * nodes_per_leaf));
}

void sort_into_clusters(const StridedPoints &nodes, const Bounds &bounds, int n_threads, Clusters &clusters) {
  clusters.frame = frame_around(bounds);
  NodeSorter<std::uint32_t> sorter(items_of<std::uint32_t>(nodes, clusters.frame, n_threads), n_threads);
  const NodeItems<std::uint32_t> &sorted = sorter.sort();
  fill(nodes, clusters, n_threads, [&](std::int64_t i) { return view(sorted)[i].node; });
  if (!are_within_frame(clusters)) place_clusters(nodes, bounds_of(nodes), n_threads, clusters);
}

void place_clusters(const StridedPoints &nodes, const Bounds &bounds, int n_threads, Clusters &clusters) {
  // Each leaf is read and written in place. A node's number is read before it is overwritten.
  const Leaf *leaves = clusters.leaves.get();
  const auto place = [&](const Bounds &around) {
    clusters.frame = frame_around(around);
    fill(nodes, clusters, n_threads,
         [leaves](std::int64_t i) { return leaves[i / nodes_per_leaf].node[i % nodes_per_leaf]; });
  };
  place(bounds);
  if (!are_within_frame(clusters)) place(bounds_of(nodes));
}

}  // namespace riis
