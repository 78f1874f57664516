// SPDX-License-Identifier: Apache-2.0
// Puts nodes in an order in which nodes that are near each other in space follow each other. Clusters and balls both use this
// order.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "geometry/strided.hpp"
#include "geometry/vec3.hpp"
#include "kernels/kernels.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {

inline constexpr std::int64_t nodes_per_sorting_block = 32768;

// Returns a node's coordinates. Fails with RIIS_INVALID_MESH if a coordinate became unusable after the check.
inline Vec3 node_at(const StridedPoints &nodes, std::int64_t i) {
  return checked_point(nodes, i, "node", RIIS_INVALID_MESH);
}

// The frame of a mesh's nodes: it takes a coordinate x to (x - centre) * scale. The scale is a power of two that brings all
// coordinates between -1 and 1. A coordinate far outside becomes 2 or -2, which single precision can hold.
struct NodeFrame {
  Vec3 centre{0, 0, 0};
  double scale = 1;

  // Takes a point to the frame. The point must lie within the nodes' box.
  void place_inner(Vec3 p, float *x) const {
    const Vec3 q = scale * (p - centre);
    x[0] = static_cast<float>(q.x), x[1] = static_cast<float>(q.y), x[2] = static_cast<float>(q.z);
  }
  void operator()(Vec3 p, float *x) const {
    const Vec3 q = scale * (p - centre);
    const auto inside = [](double a) { return static_cast<float>(std::min(std::max(-2.0, a), 2.0)); };
    x[0] = inside(q.x), x[1] = inside(q.y), x[2] = inside(q.z);
  }
};

inline NodeFrame frame_around(const Bounds &nodes) {
  const Vec3 extent = nodes.half_extent();
  int exponent = 0;
  std::frexp(std::max({extent.x, extent.y, extent.z}), &exponent);
  // The exponent is limited, because a denormal extent would make the scale infinite.
  return {nodes.middle(), std::ldexp(1.0, -std::max(exponent, -1000))};
}

// A box in the mesh's frame, in single precision.
struct NodeBox {
  static constexpr float inf = std::numeric_limits<float>::infinity();
  float lower[3] = {inf, inf, inf}, upper[3] = {-inf, -inf, -inf};

  void add(const float *x) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = x[i] < lower[i] ? x[i] : lower[i];
      upper[i] = x[i] > upper[i] ? x[i] : upper[i];
    }
  }
  void add(const NodeBox &box) {
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

// A node with its coordinates and its number.
template <class Node>
struct NodeItem {
  float x[3];
  Node node;
};

template <class Node>
using NodeItems = UnfilledVector<NodeItem<Node>>;

// Where a part of the nodes is cut. With by_clusters, a part is cut into at most four parts at a time: a large part between
// clusters, and a small part between leaves. This makes clusters compact. With by_leaves, all cuts are between leaves, and the
// number of parts is chosen so that leaves become as wide as they are long. This takes half as many passes, but makes long
// clusters.
enum class Cuts { by_clusters, by_leaves };

// Sorts nodes so that near nodes follow each other. Each pass divides the longest axis of a part's box into bins, counts the
// nodes in each bin, and then cuts the part across this axis. The items move back and forth between two arrays.
template <class Node>
class NodeSorter {
 public:
  typedef NodeItem<Node> Item;

  // The buffer may have any content.
  NodeSorter(NodeItems<Node> &items, NodeItems<Node> &buffer, Cuts cuts, int n_threads)
      : items_(items),
        buffer_(buffer),
        cuts_(cuts),
        per_block_(cuts == Cuts::by_clusters ? nodes_per_sorting_block : nodes_per_sorting_block / 8),
        n_threads_(n_threads) {}

  void sort() {
    resize(buffer_, view(items_).size());
    // While there are too few parts for all threads, the threads work on each part together. Afterwards each thread takes whole
    // parts.
    Item *at = items_.data(), *other = buffer_.data();
    std::vector<Part> parts{{0, view(items_).size()}}, next;
    const std::int64_t enough = n_threads_ == 1 ? 1 : 4 * n_threads_;
    while (view(parts).size() < enough && parts.front().size() > 8 * per_block_) {
      next.clear();
      for (const Part &part : parts) {
        ManyBlocks blocks(part, per_block_, n_threads_);
        for_each_cut(part, sort_once(part, at, other, blocks), [&](const Part &cut) { next.push_back(cut); });
      }
      std::swap(parts, next);
      std::swap(at, other);
    }
    parallel_for(view(parts).size(), n_threads_, [&](std::int64_t i, int) { sort_alone(view(parts)[i], at, other); });
  }

 private:
  static constexpr int n_bins = 256, most_parts = 16;
  // A part of at most this size gets fewer bins, because clearing and summing many bins would take longer than counting the
  // part's nodes.
  static constexpr std::int64_t small_size = 1024;
  static constexpr int n_small_bins = 64, n_small_bins_per_part = 16;
  typedef std::array<Node, n_bins> Counts;
  // Items are counted and moved four at a time, one from each quarter of a block. Neighbouring items often belong to the same
  // bin, and each update of the bin's count has to wait for the previous update. Each quarter of the items therefore has its own
  // counts.
  static constexpr int n_quarters = 4;
  typedef std::array<Node, n_quarters> OfQuarters;
  typedef std::array<OfQuarters, n_bins> QuarterCounts;
  struct Part {
    std::int64_t begin, end;
    std::int64_t size() const { return end - begin; }
  };
  // Returns n / extent, or 0 if the quotient would be infinite.
  static float per_unit_of(float n, float extent) {
    const float per_unit = extent > 0 ? n / extent : 0;
    return per_unit <= std::numeric_limits<float>::max() ? per_unit : 0;
  }
  struct Bins {
    int n, axis;
    float from, per_unit;

    Bins(const NodeBox &box, std::int64_t size, std::int64_t n_parts)
        : n(size <= small_size ? std::max(n_small_bins, static_cast<int>(n_parts) * n_small_bins_per_part) : n_bins),
          axis(box.longest_axis()),
          from(box.lower[axis]) {
      per_unit = per_unit_of(static_cast<float>(n), box.upper[axis] - from);
    }
    int operator()(const Item &item) const {
      const auto bin = static_cast<int>((item.x[axis] - from) * per_unit);
      return bin < n ? bin : n - 1;
    }
  };

  // A stream is a run of successive bins whose items are written one after another. A bin that contains a cut is a stream by
  // itself. All bins between two such bins are one stream. Writing to few streams is faster than writing to many bins.
  struct Streams {
    static constexpr int most = 2 * most_parts - 1;
    std::array<std::uint8_t, n_bins> of_bin;
    int n = 1;

    // `counts` has the number of items in each bin of a part. `ends` has the positions of the cuts in the part, in ascending
    // order.
    Streams(const Counts &counts, int n_in_use, const std::array<std::int64_t, most_parts> &ends, int n_parts) {
      int first_of_stream = 0, bin = 0;
      const auto begin_stream = [&](int at) {
        if (at == first_of_stream || at == n_in_use) return;
        std::fill(of_bin.begin() + first_of_stream, of_bin.begin() + at, static_cast<std::uint8_t>(n - 1));
        first_of_stream = at;
        ++n;
      };
      std::int64_t end = 0;  // the end of the items in the earlier bins
      for (int cut = 0; cut + 1 < n_parts; ++cut) {
        const std::int64_t at = view(ends)[cut];
        for (; end + static_cast<std::int64_t>(view(counts)[bin]) <= at; ++bin)
          end += static_cast<std::int64_t>(view(counts)[bin]);
        if (bin >= first_of_stream) begin_stream(bin);
        if (end < at) begin_stream(bin + 1);
      }
      std::fill(of_bin.begin() + first_of_stream, of_bin.begin() + n_in_use, static_cast<std::uint8_t>(n - 1));
    }
  };

  // A part that is divided into blocks, so that several threads can work on it. Each block has its own box, counts and positions
  // of streams. OneBlock is a part that one thread handles as a single block.
  struct ManyBlocks {
    const Part &part;
    std::int64_t per_block;
    int n_threads;
    std::vector<NodeBox> boxes;
    std::vector<QuarterCounts> counts;
    std::vector<std::array<OfQuarters, Streams::most>> at;

    ManyBlocks(const Part &of, std::int64_t size, int threads) : part(of), per_block(size), n_threads(threads) {
      const std::int64_t n_blocks = (of.size() + per_block - 1) / per_block;
      resize(boxes, n_blocks);
      resize(counts, n_blocks);
      resize(at, n_blocks);
    }
    template <class Visit>
    void for_each(const Visit &visit) const {
      parallel_for_ranges(part.size(), per_block, n_threads, [&](const Range &range, int) {
        visit(range.begin / per_block, Part{part.begin + range.begin, part.begin + range.end});
      });
    }
  };
  struct OneBlock {
    const Part &part;
    std::array<NodeBox, 1> boxes;
    std::array<QuarterCounts, 1> counts;
    std::array<std::array<OfQuarters, Streams::most>, 1> at;

    explicit OneBlock(const Part &of) : part(of) {}
    template <class Visit>
    void for_each(const Visit &visit) const {
      visit(0, part);
    }
  };

  static std::int64_t n_units(const Part &part, std::int64_t unit) { return (part.size() + unit - 1) / unit; }

  // How a part is cut: into `n_parts` parts, at multiples of `unit` items.
  struct Cutting {
    std::int64_t unit, n_parts;
  };
  Cutting cutting(const Part &part, const NodeBox &box) const {
    if (cuts_ == Cuts::by_clusters) {
      const std::int64_t unit = part.size() > nodes_per_cluster ? nodes_per_cluster : nodes_per_leaf;
      return {unit, n_units(part, unit) >= 8 ? 4 : 2};
    }
    const std::int64_t n_leaves = n_units(part, nodes_per_leaf), most = std::min<std::int64_t>(most_parts, n_leaves);
    const float along = leaves_along(box, static_cast<float>(n_leaves));
    return {nodes_per_leaf, std::clamp(static_cast<std::int64_t>(along + 0.5f), std::int64_t{2}, most)};
  }

  // Returns how many leaves lie along the longest side of the box, if a leaf is as wide as it is long. In a box narrower than a
  // leaf, leaves have the width of the box.
  static float leaves_along(const NodeBox &box, float n_leaves) {
    float side[3];
    for (int i = 0; i < 3; ++i) side[i] = box.upper[i] - box.lower[i];
    std::sort(side, side + 3);
    const float middle = side[1] / side[2], least = side[0] / side[2];  // NaN if all nodes are in one place
    float edge = 1 / n_leaves;                                          // as a share of the longest side
    if (middle > edge) edge = std::sqrt(middle / n_leaves);
    if (least > edge) edge = static_cast<float>(cube_root(middle * least / n_leaves));
    return 1 / edge;
  }

  template <class Visit>
  static void for_each_cut(const Part &part, const Cutting &cutting, const Visit &visit) {
    const std::int64_t n = n_units(part, cutting.unit);
    std::int64_t begin = part.begin;
    for (std::int64_t i = 1; i <= cutting.n_parts; ++i) {
      const std::int64_t end = std::min(part.begin + n * i / cutting.n_parts * cutting.unit, part.end);
      visit(Part{begin, end});
      begin = end;
    }
  }

  // Returns the box of some items. Compares four numbers at once, because comparing them one by one would take longer than
  // reading the memory. The fourth number has any value and is not used.
  static NodeBox box_of(const Item *items, const Part &part) {
    typedef float Four __attribute__((vector_size(16)));
    static_assert(sizeof(Item) >= sizeof(Four));
    // With two separate boxes, two comparisons can run at the same time. With one, each comparison would have to wait for the
    // previous one.
    Four lower[2], upper[2];
    for (int k = 0; k < 2; ++k) lower[k] = Four{} + NodeBox::inf, upper[k] = Four{} - NodeBox::inf;
    const auto add = [&](const Item *item, int k) {
      Four x;
      std::memcpy(&x, item, sizeof x);
      lower[k] = x < lower[k] ? x : lower[k];
      upper[k] = x > upper[k] ? x : upper[k];
    };
    const Item *item = items + part.begin;
    for (const Item *const end = items + part.end - 1; item < end; item += 2) {
      add(item, 0);
      add(item + 1, 1);
    }
    add(items + part.end - 1, 0);
    NodeBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(lower[0][axis], lower[1][axis]);
      box.upper[axis] = std::max(upper[0][axis], upper[1][axis]);
    }
    return box;
  }

  // Calls visit(item, quarter) for all items of a part, which is divided into four quarters. Within a quarter, the items are
  // visited in order.
  template <class Visit>
  static void for_each_by_quarters(const Item *items, const Part &part, const Visit &visit) {
    const std::int64_t size = part.size() / n_quarters;
    const Item *item = items + part.begin;
    for (const Item *const end = item + size; item != end; ++item)
      for (int quarter = 0; quarter < n_quarters; ++quarter) visit(item[quarter * size], quarter);
    for (const Item *rest = items + part.begin + n_quarters * size; rest != items + part.end; ++rest)
      visit(*rest, n_quarters - 1);
  }

  static void count(const Item *items, const Part &part, const Bins &bins, QuarterCounts &counts) {
    std::fill(counts.begin(), counts.begin() + bins.n, OfQuarters{});
    for_each_by_quarters(items, part,
                         [&](const Item &item, int quarter) { ++view(view(counts)[bins(item)])[quarter]; });
  }

  static void add(const OfQuarters &numbers, OfQuarters &to) {
    for (int quarter = 0; quarter < n_quarters; ++quarter) view(to)[quarter] += view(numbers)[quarter];
  }

  // Moves the items so that the items of each new part are together. Within a stream, the items keep their order. The number of
  // blocks thus does not change the result. Returns where the part was cut.
  template <class Blocks>
  Cutting sort_once(const Part &part, const Item *from, Item *to, Blocks &blocks) const {
    blocks.for_each(
        [&](std::int64_t block, const Part &of_block) { view(blocks.boxes)[block] = box_of(from, of_block); });
    NodeBox box;
    for (const NodeBox &of_block : blocks.boxes) box.add(of_block);
    Cutting cut = cutting(part, box);
    const Bins bins(box, part.size(), cut.n_parts);
    blocks.for_each(
        [&](std::int64_t block, const Part &of_block) { count(from, of_block, bins, view(blocks.counts)[block]); });
    Counts sums;
    for (int bin = 0; bin < bins.n; ++bin) {
      OfQuarters sum{};
      for (const QuarterCounts &counts : blocks.counts) add(view(counts)[bin], sum);
      view(sums)[bin] = sum[0] + sum[1] + sum[2] + sum[3];
    }
    // Many items may lie in one bin. The next pass can separate these items, because their own box is smaller.
    constexpr std::int64_t few_parts = 4;
    if (cut.n_parts > few_parts) {
      const auto most = static_cast<std::int64_t>(*std::max_element(sums.begin(), sums.begin() + bins.n));
      if (most > part.size() / cut.n_parts) cut.n_parts = few_parts;
    }
    std::array<std::int64_t, most_parts> ends;
    int n_parts = 0;
    for_each_cut(part, cut, [&](const Part &made) { view(ends)[n_parts++] = made.end - part.begin; });
    const Streams streams(sums, bins.n, ends, n_parts);
    for (std::int64_t block = 0; block < view(blocks.counts).size(); ++block) {
      auto &at = view(blocks.at)[block];
      at.fill({});
      for (int bin = 0; bin < bins.n; ++bin)
        add(view(view(blocks.counts)[block])[bin], view(at)[view(streams.of_bin)[bin]]);
    }
    Node n = 0;
    for (int stream = 0; stream < streams.n; ++stream)
      for (auto &at : blocks.at)
        for (Node &of_quarter : view(at)[stream]) {
          const Node count = of_quarter;
          of_quarter = n;
          n += count;
        }
    blocks.for_each([&](std::int64_t block, const Part &of_block) {
      std::array<std::array<Item *, n_quarters>, Streams::most> next;
      for (int stream = 0; stream < streams.n; ++stream)
        for (int quarter = 0; quarter < n_quarters; ++quarter)
          view(view(next)[stream])[quarter] = to + part.begin + view(view(view(blocks.at)[block])[stream])[quarter];
      for_each_by_quarters(from, of_block, [&](const Item &item, int quarter) {
        *view(view(next)[view(streams.of_bin)[bins(item)]])[quarter]++ = item;
      });
    });
    return cut;
  }

  // Sorts a short part completely along its longest axis. For so few items, this is faster than counting in bins.
  static void sort_whole(const Part &part, const Item *from, Item *to) {
    const NodeBox box = box_of(from, part);
    const int axis = box.longest_axis();
    // A key holds the position along the axis in its upper bits, and the item's number in its lower bits, so that all keys
    // differ.
    constexpr std::int32_t most = (1 << 24) - 1;
    const float per_unit = per_unit_of(static_cast<float>(most), box.upper[axis] - box.lower[axis]);
    static_assert(most < std::numeric_limits<std::int32_t>::max() / keys_at_once);
    alignas(64) std::array<std::int32_t, keys_at_once> key{}, rank;
    const auto n = static_cast<std::int32_t>(part.size());
    for (std::int32_t i = 0; i < n; ++i) {
      const auto place = static_cast<std::int32_t>((from[part.begin + i].x[axis] - box.lower[axis]) * per_unit);
      view(key)[i] = std::min(place, most) * keys_at_once + i;
    }
    kernels(best_instruction_set()).rank(key.data(), n, rank.data());
    for (std::int32_t i = 0; i < n; ++i) to[part.begin + view(rank)[i]] = from[part.begin + i];
  }

  // Sorts a part into leaves, on one thread.
  void sort_alone(const Part &part, Item *at, Item *other) {
    if (part.size() <= nodes_per_leaf) {
      if (at != items_.data()) std::copy(at + part.begin, at + part.end, items_.data() + part.begin);
      return;
    }
    Cutting cut{nodes_per_leaf, 2};
    if (part.size() <= keys_at_once)
      sort_whole(part, at, other);
    else {
      OneBlock block(part);
      cut = sort_once(part, at, other, block);
    }
    for_each_cut(part, cut, [&](const Part &made) { sort_alone(made, other, at); });
  }

  NodeItems<Node> &items_, &buffer_;
  const Cuts cuts_;
  const std::int64_t per_block_;
  const int n_threads_;
};

template <class Node>
NodeItems<Node> items_of(const StridedPoints &nodes, const NodeFrame &frame, int n_threads) {
  NodeItems<Node> items;
  resize(items, nodes.n);
  parallel_for_ranges(nodes.n, nodes_per_sorting_block, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      NodeItem<Node> &item = view(items)[i];
      frame(node_at(nodes, i), item.x);
      item.node = static_cast<Node>(i);
    }
  });
  return items;
}

}  // namespace riis
