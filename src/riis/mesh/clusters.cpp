// SPDX-License-Identifier: Apache-2.0
#include "mesh/clusters.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "common/array_view.hpp"

namespace riis {
namespace {

// Checks that all boxes lie within the frame. The caller may have moved nodes, or made coordinates unusable, without telling the
// mesh. Outside of the frame, coordinates exceed 1, and the errors of single precision have no bound.
bool are_within_frame(const Clusters &clusters) {
  return std::all_of(clusters.boxes.begin(), clusters.boxes.end(), [](const Clusters::Box &box) {
    return std::all_of(box.lower, box.lower + 3, [](float x) { return x >= -1; }) &&
           std::all_of(box.upper, box.upper + 3, [](float x) { return x <= 1; });
  });
}

// Fills clusters with nodes. The node at position i in the order has the number number_of(i).
template <class NumberOf>
void fill(const StridedPoints &nodes, Clusters &clusters, int n_threads, const NumberOf &number_of) {
  const auto ordered = [&](std::int64_t i) {
    const std::uint32_t number = number_of(i);
    return OrderedNode{number, nodes[number]};
  };
  fill_clusters(
      nodes.n, n_threads, ordered, [&](std::int64_t i) { nodes.prefetch(number_of(i)); }, clusters);
}

// Fails with RIIS_INVALID_MESH for an unusable coordinate.
Bounds bounds_of(const StridedPoints &nodes) {
  Bounds bounds;
  for (std::int64_t i = 0; i < nodes.n; ++i) bounds.add(node_at(nodes, i));
  return bounds;
}

// Asks the system for large pages for the memory of leaves. A search reads leaves in random order. With small pages, the
// processor would have to look up a page for nearly every leaf. Only large pages that lie wholly inside the memory are requested,
// so the process needs no additional memory.
void ask_for_large_pages(void *memory, std::size_t n_bytes) {
#if defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t size = std::uintptr_t{1} << 21;
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = (address + size - 1) / size * size, end = (address + n_bytes) / size * size;
  if (begin < end)
    madvise(reinterpret_cast<void *>(begin), end - begin, MADV_HUGEPAGE);  // a system without large pages refuses
#else
  static_cast<void>(memory), static_cast<void>(n_bytes);
#endif
}

}  // namespace

void make_room_for(std::int64_t n_nodes, Clusters &clusters) {
  const auto n_of = [n_nodes](std::int64_t size) { return (n_nodes + size - 1) / size; };
  const std::int64_t n_leaves = n_of(nodes_per_leaf);
  if (n_leaves > clusters.room_for_leaves) {
    clusters.room_for_leaves = 0;
    // The memory is left unfilled, so that each page is first written by the thread that uses it.
    const auto n = static_cast<std::size_t>(n_leaves);
    clusters.leaves.reset(new Leaf[n]);
    clusters.points.reset(new LeafPoints[n]);
    ask_for_large_pages(clusters.leaves.get(), n * sizeof(Leaf));
    ask_for_large_pages(clusters.points.get(), n * sizeof(LeafPoints));
    clusters.room_for_leaves = n_leaves;
  }
  resize(clusters.clusters, n_of(nodes_per_cluster));
  resize(clusters.regions, n_of(Clusters::clusters_per_region * nodes_per_cluster));
  clusters.boxes.resize(clusters.regions.size());
  clusters.n_leaves = n_leaves;
  clusters.n_nodes = n_nodes;
}

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
  NodeItems<std::uint32_t> items = items_of<std::uint32_t>(nodes, clusters.frame, n_threads), buffer;
  NodeSorter<std::uint32_t>(items, buffer, Cuts::by_clusters, n_threads).sort();
  fill(nodes, clusters, n_threads, [&](std::int64_t i) { return view(items)[i].node; });
  if (!are_within_frame(clusters)) place_clusters(nodes, bounds_of(nodes), n_threads, clusters);
}

void place_clusters(const StridedPoints &nodes, const Bounds &bounds, int n_threads, Clusters &clusters) {
  // Each leaf is overwritten in place, but every number in the leaf is read before it is overwritten.
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
