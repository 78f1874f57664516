// SPDX-License-Identifier: Apache-2.0
#include "marking/put_in_order.hpp"

#include <array>
#include <cstddef>

#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Nodes are sorted stretch by stretch. A stretch is a range of node numbers. Its found nodes become a set with one bit for each
// node, which gives their order.
constexpr std::int64_t nodes_per_stretch = 16384, bits_per_word = 64;
constexpr std::size_t n_words = nodes_per_stretch / bits_per_word;

// The set of a stretch's found nodes. It gives the rank of each node in the set.
class Ranks {
 public:
  void clear() { bits_.fill(0); }
  void add(std::int64_t node) { view(bits_)[word(node)] |= bit(node); }
  void count() {
    std::uint32_t n = 0;
    for (std::size_t i = 0; i < n_words; ++i) {
      before_[i] = n;
      n += n_bits(bits_[i]);
    }
  }
  std::int64_t operator()(std::int64_t node) const {
    const std::int64_t i = word(node);
    return view(before_)[i] + n_bits(view(bits_)[i] & (bit(node) - 1));
  }

 private:
  static std::int64_t word(std::int64_t node) { return node % nodes_per_stretch / bits_per_word; }
  static std::uint64_t bit(std::int64_t node) { return std::uint64_t{1} << node % bits_per_word; }
  // Counts bits without the popcount instruction. For processors that may lack it, the compiler's built-in would call a
  // function.
  static std::uint32_t n_bits(std::uint64_t x) {
    x -= x >> 1 & 0x5555555555555555;
    x = (x & 0x3333333333333333) + (x >> 2 & 0x3333333333333333);
    return static_cast<std::uint32_t>(((x + (x >> 4)) & 0x0f0f0f0f0f0f0f0f) * 0x0101010101010101 >> 56);
  }

  std::array<std::uint64_t, n_words> bits_;
  std::array<std::uint32_t, n_words> before_;
};

std::int64_t node_of(const FoundNode &found) { return found.node; }

class Ordering {
 public:
  Ordering(const Surface &surface, const FoundNodes &found, bool limit_is_wider, std::int64_t n_nodes, int n_threads,
           OrderScratch &scratch)
      : triangles_(surface.triangles()),
        other_(surface.other_distance()),
        half_thickness_(surface.half_thickness()),
        found_(found),
        limit_is_wider_(limit_is_wider),
        n_threads_(n_threads),
        n_lists_(view(found.by_thread).size()),
        n_stretches_((n_nodes + nodes_per_stretch - 1) / nodes_per_stretch),
        scratch_(scratch) {}

  // Pass 1. Counts the nodes of each list in each stretch. Then replaces each count by the position where these nodes will
  // begin. Returns the sums.
  OrderScratch::Counts count() {
    scratch_.counts.clear();
    resize(scratch_.counts, n_stretches_ * n_lists_ + 1);
    for_each_list([&](std::int64_t list, const FoundNode &found) {
      OrderScratch::Counts &counts = counts_of(found, list);
      ++counts.n_within;
      counts.n_marked += is_marked(found);
    });
    OrderScratch::Counts sum{0, 0};
    for (OrderScratch::Counts &counts : scratch_.counts) {
      const OrderScratch::Counts n = counts;
      counts = sum;
      sum.n_within += n.n_within;
      sum.n_marked += n.n_marked;
    }
    return sum;
  }

  // Pass 2. Copies the found nodes so that each stretch's nodes are together. Afterwards each position is the end of its nodes.
  void gather() {
    for_each_list([&](std::int64_t list, const FoundNode &found) {
      std::int64_t &at = counts_of(found, list).n_within;
      view(scratch_.by_stretch)[at++] = found;
    });
  }

  // Pass 3. Writes each stretch's nodes in ascending order.
  void write(NodeList &within, NodeList &marked) {
    parallel_for(n_stretches_, n_threads_, [&](std::int64_t stretch, int) {
      const OrderScratch::Counts *lists = scratch_.counts.data() + stretch * n_lists_;
      // A stretch begins where the previous stretch ends.
      const std::int64_t begin = stretch == 0 ? 0 : lists[-1].n_within, end = lists[n_lists_ - 1].n_within;
      if (begin == end) return;
      const FoundNode *nodes = scratch_.by_stretch.data();
      write_ranked(nodes + begin, nodes + end, begin, within, [](const FoundNode &) { return true; });
      if (!limit_is_wider_) return;
      write_ranked(nodes + begin, nodes + end, lists[0].n_marked, marked,
                   [&](const FoundNode &found) { return is_marked(found); });
    });
  }

 private:
  bool is_marked(const FoundNode &found) const { return found.distance <= half_thickness_; }

  OrderScratch::Counts &counts_of(const FoundNode &found, std::int64_t list) const {
    return view(scratch_.counts)[node_of(found) / nodes_per_stretch * n_lists_ + list];
  }

  template <class Visit>
  void for_each_list(const Visit &visit) const {
    parallel_for(n_lists_, n_threads_, [&](std::int64_t list, int) {
      for (const FoundNode &found : view(found_.by_thread)[list]) visit(list, found);
    });
  }

  // Writes the wanted nodes of a stretch to the list in the order of their ranks. The first one gets position `first`.
  template <class IsWanted>
  void write_ranked(const FoundNode *begin, const FoundNode *end, std::int64_t first, NodeList &list,
                    const IsWanted &is_wanted) const {
    Ranks ranks;
    ranks.clear();
    for (const FoundNode *found = begin; found != end; ++found)
      if (is_wanted(*found)) ranks.add(node_of(*found));
    ranks.count();
    for (const FoundNode *found = begin; found != end; ++found)
      if (is_wanted(*found)) put(*found, first + ranks(node_of(*found)), list);
  }

  void put(const FoundNode &found, std::int64_t at, NodeList &list) const {
    const std::int64_t position = found.triangle;
    list.set(at, node_of(found), found.distance, other_ ? -1 : view(triangles_.triangle_id)[position],
             other_ ? view(other_->patches().patches)[position].leaflet_id : view(triangles_.leaflet_id)[position]);
  }

  const TriangleSet &triangles_;
  const PatchDistance *other_;
  double half_thickness_;
  const FoundNodes &found_;
  bool limit_is_wider_;
  int n_threads_;
  std::int64_t n_lists_;
  std::int64_t n_stretches_;
  OrderScratch &scratch_;
};

// One thread handles few nodes, because other threads would start too late to help.
int threads_for_order(std::int64_t n_within, int n_threads) {
  constexpr std::int64_t few = 4096;
  return n_within < few ? 1 : n_threads;
}

}  // namespace

OrderScratch::Counts prepare_order(const Surface &surface, const FoundNodes &found, bool limit_is_wider,
                                   std::int64_t n_nodes, int n_threads, OrderScratch &scratch) {
  const std::int64_t n_within = found.size();
  if (view(scratch.by_stretch).size() < n_within) resize(scratch.by_stretch, n_within + n_within / 2);
  Ordering ordering(surface, found, limit_is_wider, n_nodes, threads_for_order(n_within, n_threads), scratch);
  const std::int64_t n_marked = ordering.count().n_marked;
  return {n_within, limit_is_wider ? n_marked : 0};
}

void put_in_order(const Surface &surface, const FoundNodes &found, bool limit_is_wider, std::int64_t n_nodes,
                  int n_threads, OrderScratch &scratch, NodeList &within, NodeList &marked) {
  Ordering ordering(surface, found, limit_is_wider, n_nodes, threads_for_order(within.size(), n_threads), scratch);
  ordering.gather();
  ordering.write(within, marked);
}

}  // namespace riis
