// SPDX-License-Identifier: Apache-2.0
#include "marking/clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::int64_t nodes_per_block = 32768;

struct Item {
  float x[3];
  std::uint32_t node;
};

struct Box {
  float lower[3] = {infinity, infinity, infinity}, upper[3] = {-infinity, -infinity, -infinity};

  void add(const float *x) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = x[i] < lower[i] ? x[i] : lower[i];
      upper[i] = x[i] > upper[i] ? x[i] : upper[i];
    }
  }
  void add(const Box &box) {
    add(box.lower);
    add(box.upper);
  }
  int longest_axis() const {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (upper[i] - lower[i] > upper[axis] - lower[axis]) axis = i;
    return axis;
  }
};

// Nodes in an order by counting along one axis, cut where the parts are multiples of a unit. From one array to the other and back.
class Sorter {
 public:
  Sorter(std::vector<Item> items, int n_threads)
      : items_(std::move(items)), buffer_(items_.size()), n_threads_(n_threads) {}

  const std::vector<Item> &sort() {
    // While parts are fewer than threads want, threads share a part; then each takes whole ones.
    Item *at = items_.data(), *other = buffer_.data();
    std::vector<Part> parts{{0, static_cast<std::int64_t>(items_.size())}}, next;
    const std::int64_t enough = n_threads_ == 1 ? 1 : 4 * n_threads_;
    while (static_cast<std::int64_t>(parts.size()) < enough && parts.front().size() > 8 * nodes_per_block) {
      next.clear();
      for (const Part &part : parts) {
        ManyBlocks blocks(part, n_threads_);
        sort_once(part, at, other, blocks);
        for_each_cut(part, [&](const Part &cut) { next.push_back(cut); });
      }
      std::swap(parts, next);
      std::swap(at, other);
    }
    parallel_for(static_cast<std::int64_t>(parts.size()), n_threads_,
                 [&](std::int64_t i, int) { sort_alone(parts[static_cast<std::size_t>(i)], at, other); });
    return items_;
  }

 private:
  static constexpr int n_bins = 256;
  typedef std::array<std::uint32_t, n_bins> Counts;
  struct Part {
    std::int64_t begin, end;
    std::int64_t size() const { return end - begin; }
  };
  struct Bins {
    int axis;
    float from, per_unit;

    explicit Bins(const Box &box) : axis(box.longest_axis()), from(box.lower[axis]) {
      const float extent = box.upper[axis] - from;
      per_unit = extent > 0 ? n_bins / extent : 0;
      if (!(per_unit <= std::numeric_limits<float>::max())) per_unit = 0;
    }
    std::size_t operator()(const Item &item) const {
      const auto bin = static_cast<int>((item.x[axis] - from) * per_unit);
      return static_cast<std::size_t>(bin < n_bins ? bin : n_bins - 1);
    }
  };

  // A part in blocks that threads share, and what is known of each; or in one, by one thread.
  struct ManyBlocks {
    const Part &part;
    int n_threads;
    std::vector<Box> boxes;
    std::vector<Counts> at;

    ManyBlocks(const Part &of, int threads)
        : part(of),
          n_threads(threads),
          boxes(static_cast<std::size_t>((of.size() + nodes_per_block - 1) / nodes_per_block)),
          at(boxes.size()) {}
    template <class Visit>
    void for_each(const Visit &visit) const {
      parallel_for_ranges(part.size(), nodes_per_block, n_threads, [&](const Range &range, int) {
        visit(static_cast<std::size_t>(range.begin / nodes_per_block),
              Part{part.begin + range.begin, part.begin + range.end});
      });
    }
  };
  struct OneBlock {
    const Part &part;
    std::array<Box, 1> boxes;
    std::array<Counts, 1> at;

    explicit OneBlock(const Part &of) : part(of) {}
    template <class Visit>
    void for_each(const Visit &visit) const {
      visit(0, part);
    }
  };

  // Into as many parts as keep the cuts at multiples of a unit: clusters, and within a cluster leaves.
  template <class Visit>
  static void for_each_cut(const Part &part, const Visit &visit) {
    const std::int64_t unit = part.size() > nodes_per_cluster ? nodes_per_cluster : nodes_per_leaf;
    const std::int64_t n_units = (part.size() + unit - 1) / unit;
    const std::int64_t n_parts = n_units >= 8 ? 4 : 2;
    std::int64_t begin = part.begin;
    for (std::int64_t i = 1; i <= n_parts; ++i) {
      const std::int64_t end = std::min(part.begin + n_units * i / n_parts * unit, part.end);
      visit(Part{begin, end});
      begin = end;
    }
  }

  // By bins of the longest axis; within a bin they stay as they were, however many the blocks.
  template <class Blocks>
  static void sort_once(const Part &part, const Item *from, Item *to, Blocks &blocks) {
    blocks.for_each([&](std::size_t block, const Part &of_block) {
      Box box;
      for (std::int64_t i = of_block.begin; i < of_block.end; ++i) box.add(from[i].x);
      blocks.boxes[block] = box;
    });
    Box box;
    for (const Box &of_block : blocks.boxes) box.add(of_block);
    const Bins bins(box);
    blocks.for_each([&](std::size_t block, const Part &of_block) {
      Counts &counts = blocks.at[block];
      counts.fill(0);
      for (std::int64_t i = of_block.begin; i < of_block.end; ++i) ++counts[bins(from[i])];
    });
    std::uint32_t n = 0;
    for (std::size_t bin = 0; bin < n_bins; ++bin)
      for (Counts &counts : blocks.at) {
        const std::uint32_t count = counts[bin];
        counts[bin] = n;
        n += count;
      }
    blocks.for_each([&](std::size_t block, const Part &of_block) {
      Counts &next = blocks.at[block];
      for (std::int64_t i = of_block.begin; i < of_block.end; ++i) to[part.begin + next[bins(from[i])]++] = from[i];
    });
  }

  // By one thread, down to leaves.
  void sort_alone(const Part &part, Item *at, Item *other) {
    if (part.size() <= nodes_per_leaf) {
      if (at != items_.data()) std::copy(at + part.begin, at + part.end, items_.data() + part.begin);
      return;
    }
    OneBlock block(part);
    sort_once(part, at, other, block);
    for_each_cut(part, [&](const Part &cut) { sort_alone(cut, other, at); });
  }

  std::vector<Item> items_, buffer_;
  int n_threads_;
};

Vec3 node_at(const StridedPoints &nodes, std::int64_t i) { return checked_point(nodes, i, "node", RIIS_INVALID_MESH); }

// Where the mesh's frame is.
void frame_nodes(const StridedPoints &nodes, int n_threads, Clusters &clusters) {
  clusters.blocks.resize(static_cast<std::size_t>((nodes.n + nodes_per_block - 1) / nodes_per_block));
  parallel_for_ranges(nodes.n, nodes_per_block, n_threads, [&](const Range &range, int) {
    Bounds bounds;
    for (std::int64_t i = range.begin; i < range.end; ++i) bounds.add(node_at(nodes, i));
    clusters.blocks[static_cast<std::size_t>(range.begin / nodes_per_block)] = bounds;
  });
  Bounds all;
  for (const Bounds &block : clusters.blocks) all.add(block);
  clusters.centre = all.middle();
  const Vec3 extent = all.half_extent();
  int exponent = 0;
  std::frexp(std::max({extent.x, extent.y, extent.z}), &exponent);
  clusters.scale = std::ldexp(1.0, -std::max(exponent, -1000));  // of denormal extents it would be infinite
}

void put_box(const Box &box, Boxes &boxes, std::int64_t at) {
  for (int i = 0; i < 3; ++i) {
    boxes.lower[i][at] = box.lower[i];
    boxes.upper[i][at] = box.upper[i];
  }
}

Box box_of(const Boxes &boxes) {
  Box box;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 16; ++k) {
      box.lower[i] = std::min(box.lower[i], boxes.lower[i][k]);
      box.upper[i] = std::max(box.upper[i], boxes.upper[i][k]);
    }
  return box;
}

// The box of lanes that there are not: far from everything, finite.
Boxes no_boxes() {
  Boxes boxes;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 16; ++k) boxes.lower[i][k] = infinity, boxes.upper[i][k] = -infinity;
  return boxes;
}

std::int64_t n_of(std::int64_t n, std::int64_t size) { return (n + size - 1) / size; }

Item item_at(Vec3 p, std::uint32_t node, const Clusters &clusters) {
  const Vec3 q = clusters.scale * (p - clusters.centre);
  return {{static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)}, node};
}

// Fills leaves with the nodes node_of(position), then the boxes. Clusters of no nodes stay that if there is no memory.
template <class NodeOf>
void fill(const StridedPoints &nodes, Clusters &clusters, int n_threads, const NodeOf &node_of) {
  const std::int64_t n_nodes = nodes.n;
  const std::int64_t n_leaves = n_of(n_nodes, nodes_per_leaf);
  const auto n_clusters = static_cast<std::size_t>(n_of(n_nodes, nodes_per_cluster));
  if (n_leaves != clusters.n_leaves) {
    clusters.n_leaves = 0;
    // Not filled with zeros: whoever writes a page first should be who has it.
    clusters.leaves.reset(new Leaf[static_cast<std::size_t>(n_leaves)]);
    clusters.points.reset(new LeafPoints[static_cast<std::size_t>(n_leaves)]);
    clusters.n_leaves = n_leaves;
  }
  clusters.clusters.resize(n_clusters);
  clusters.regions.resize(
      static_cast<std::size_t>(n_of(static_cast<std::int64_t>(n_clusters), Clusters::clusters_per_region)));
  clusters.boxes.resize(clusters.regions.size());
  clusters.n_nodes = n_nodes;
  parallel_for(static_cast<std::int64_t>(clusters.regions.size()), n_threads, [&](std::int64_t r, int) {
    Boxes &region = clusters.regions[static_cast<std::size_t>(r)];
    region = no_boxes();
    const Range of_region = clusters.clusters_of(r);
    for (std::int64_t c = of_region.begin; c < of_region.end; ++c) {
      Boxes &cluster = clusters.clusters[static_cast<std::size_t>(c)];
      cluster = no_boxes();
      const Range of_cluster = clusters.leaves_of(c);
      for (std::int64_t l = of_cluster.begin; l < of_cluster.end; ++l) {
        Leaf &leaf = clusters.leaves[static_cast<std::size_t>(l)];
        double *xyz = clusters.points[static_cast<std::size_t>(l)].xyz;
        const std::int64_t first = l * nodes_per_leaf, last = clusters.n_nodes - 1;
        Box box;
        for (int i = 0; i < nodes_per_leaf; ++i) {
          const std::uint32_t node = node_of(std::min(first + i, last));
          const Vec3 p = node_at(nodes, node);
          const Item item = item_at(p, node, clusters);
          leaf.x[i] = item.x[0], leaf.y[i] = item.x[1], leaf.z[i] = item.x[2];
          leaf.node[i] = node;
          xyz[3 * i] = p.x, xyz[3 * i + 1] = p.y, xyz[3 * i + 2] = p.z;
          box.add(item.x);
        }
        put_box(box, cluster, l - of_cluster.begin);
      }
      put_box(box_of(cluster), region, c - of_region.begin);
    }
    const Box box = box_of(region);
    Clusters::Box &whole = clusters.boxes[static_cast<std::size_t>(r)];
    std::copy(box.lower, box.lower + 3, whole.lower);
    std::copy(box.upper, box.upper + 3, whole.upper);
  });
}

}  // namespace

Range Clusters::leaves_of(std::int64_t cluster) const {
  const std::int64_t begin = cluster * leaves_per_cluster;
  return {begin, std::min(begin + leaves_per_cluster, n_leaves)};
}

Range Clusters::clusters_of(std::int64_t region) const {
  const std::int64_t begin = region * clusters_per_region;
  return {begin, std::min(begin + clusters_per_region, static_cast<std::int64_t>(clusters.size()))};
}

int Clusters::n_nodes_of(std::int64_t leaf) const {
  return static_cast<int>(std::min<std::int64_t>(nodes_per_leaf, n_nodes - leaf * nodes_per_leaf));
}

void sort_into_clusters(const StridedPoints &nodes, int n_threads, Clusters &clusters) {
  frame_nodes(nodes, n_threads, clusters);
  std::vector<Item> items(static_cast<std::size_t>(nodes.n));
  parallel_for_ranges(nodes.n, nodes_per_block, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i)
      items[static_cast<std::size_t>(i)] = item_at(node_at(nodes, i), static_cast<std::uint32_t>(i), clusters);
  });
  Sorter sorter(std::move(items), n_threads);
  const std::vector<Item> &sorted = sorter.sort();
  fill(nodes, clusters, n_threads, [&](std::int64_t i) { return sorted[static_cast<std::size_t>(i)].node; });
}

void place_clusters(const StridedPoints &nodes, int n_threads, Clusters &clusters) {
  frame_nodes(nodes, n_threads, clusters);
  // A leaf's nodes are read where they are written: each before its place is.
  const Leaf *leaves = clusters.leaves.get();
  fill(nodes, clusters, n_threads,
       [leaves](std::int64_t i) { return leaves[i / nodes_per_leaf].node[i % nodes_per_leaf]; });
}

}  // namespace riis
