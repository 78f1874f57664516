// SPDX-License-Identifier: Apache-2.0
#include "marks/marks.hpp"

#include <algorithm>
#include <cstddef>

#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

constexpr std::int64_t bits_per_word = 64, words_per_stretch = 64;

// A bin is a range of nodes' numbers. All bins have the same length, which is a power of two. One thread writes all nodes of a
// bin, so two threads seldom write to the same cache line. With many more bins, it would take longer to gather the nodes.
class Bins {
 public:
  explicit Bins(std::int64_t n_nodes) {
    constexpr std::int64_t most = 256;
    while (n_nodes > most << shift_) ++shift_;
    n_ = (n_nodes + size() - 1) >> shift_;
  }
  std::int64_t n() const { return n_; }
  std::int64_t size() const { return std::int64_t{1} << shift_; }
  std::int64_t bin_of(const FoundNode &found) const { return number(found) >> shift_; }
  std::int64_t number_in_bin(const FoundNode &found) const { return number(found) & (size() - 1); }

 private:
  static std::int64_t number(const FoundNode &found) { return static_cast<std::int64_t>(found.node); }

  int shift_ = 12;  // a bin has at least 2^12 numbers: the bits of one stretch
  std::int64_t n_ = 0;
};
static_assert(bits_per_word * words_per_stretch == 1 << 12);

std::uint64_t bit_of(std::int64_t node) { return std::uint64_t{1} << node % bits_per_word; }

// Counts the bits that are set. The popcount instruction is not used, because some processors lack it. The compiler's built-in
// would call a function for this reason.
std::uint32_t n_bits(std::uint64_t x) {
  x -= x >> 1 & 0x5555555555555555;
  x = (x & 0x3333333333333333) + (x >> 2 & 0x3333333333333333);
  return static_cast<std::uint32_t>(((x + (x >> 4)) & 0x0f0f0f0f0f0f0f0f) * 0x0101010101010101 >> 56);
}

class Ordering {
 public:
  Ordering(const Surface &surface, bool limit_is_wider, const Range &numbers, std::int64_t n_within, int n_threads,
           OrderScratch &scratch)
      : triangles_(surface.triangles()),
        other_(surface.other_distance()),
        half_thickness_(surface.half_thickness()),
        limit_is_wider_(limit_is_wider),
        first_number_(numbers.begin),
        bins_(numbers.end - numbers.begin),
        n_threads_(threads_for_order(n_within, n_threads)),
        scratch_(scratch) {}

  // Copies the nodes of each list bin by bin. Returns how many nodes the results will have.
  OrderScratch::Counts gather(const FoundNodes &found) {
    make_room(found);
    parallel_for(scratch_.n_lists, n_threads_, [&](std::int64_t i, int) { gather_list(view(scratch_.lists)[i]); });
    OrderScratch::Counts sum{0, 0};
    for (std::int64_t bin = 0; bin < bins_.n(); ++bin) {
      view(scratch_.first)[bin] = sum;
      for (std::int64_t i = 0; i < scratch_.n_lists; ++i) {
        const OrderScratch::Counts &n = view(view(scratch_.lists)[i].n)[bin];
        sum.n_within += n.n_within;
        sum.n_marked += n.n_marked;
      }
    }
    view(scratch_.first)[bins_.n()] = sum;
    return sum;
  }

  // Writes the nodes of each bin in ascending order.
  void write(NodeList &within, NodeList &marked) {
    parallel_for(bins_.n(), n_threads_, [&](std::int64_t bin, int thread) {
      const OrderScratch::Counts &first = view(scratch_.first)[bin], &next = view(scratch_.first)[bin + 1];
      // The part of the result for the next bin is prefetched now, because this part will be written in random order.
      if (bin + 1 < bins_.n()) request({next.n_within, view(scratch_.first)[bin + 2].n_within}, within);
      if (next.n_within == first.n_within) return;
      NodeRanks &ranks = view(scratch_.ranks)[thread];
      write_bin(bin, first.n_within, ranks, within, [](const FoundNode &) { return true; });
      if (limit_is_wider_)
        write_bin(bin, first.n_marked, ranks, marked, [&](const FoundNode &found) { return is_marked(found); });
    });
  }

 private:
  // If there are only a few nodes, one thread handles them alone, because other threads would start too late to help.
  static int threads_for_order(std::int64_t n_within, int n_threads) {
    constexpr std::int64_t few = 4096;
    return n_within < few ? 1 : n_threads;
  }

  // Prefetches a range of a result before the range is written.
  template <class Number>
  static void request(const Range &range, const std::vector<Number> &numbers) {
    constexpr auto per_line = static_cast<std::int64_t>(64 / sizeof(Number));
    for (std::int64_t i = range.begin; i < range.end; i += per_line) __builtin_prefetch(numbers.data() + i, 1);
  }
  static void request(const Range &range, const NodeList &list) {
    request(range, list.node_id);
    request(range, list.distance);
    request(range, list.triangle_id);
    request(range, list.leaflet_id);
  }

  bool is_marked(const FoundNode &found) const { return found.distance <= half_thickness_; }

  void make_room(const FoundNodes &found) {
    if (scratch_.lists.size() < found.by_thread.size()) scratch_.lists.resize(found.by_thread.size());
    scratch_.n_lists = 0;
    for (const UnfilledVector<FoundNode> &nodes : found.by_thread) {
      if (nodes.empty()) continue;
      OrderScratch::List &list = view(scratch_.lists)[scratch_.n_lists++];
      list.found = &nodes;
      if (list.nodes.size() < nodes.size()) {
        list.nodes.clear();  // no old nodes have to be copied
        list.nodes.resize(nodes.capacity());
      }
      list.n.assign(static_cast<std::size_t>(bins_.n()), {0, 0});
      resize(list.end, bins_.n());
    }
    resize(scratch_.first, bins_.n() + 1);
    if (view(scratch_.ranks).size() < n_threads_) resize(scratch_.ranks, n_threads_);
    for (NodeRanks &ranks : scratch_.ranks) ranks.make_room(bins_.size());
  }

  void gather_list(OrderScratch::List &list) const {
    const UnfilledVector<FoundNode> &found = *list.found;
    OrderScratch::Counts *const n = list.n.data();
    for (const FoundNode &node : found) {
      OrderScratch::Counts &of_bin = n[bins_.bin_of(node)];
      ++of_bin.n_within;
      if (limit_is_wider_) of_bin.n_marked += is_marked(node);
    }
    std::int64_t *const end = list.end.data();
    std::int64_t sum = 0;
    for (std::int64_t bin = 0; bin < bins_.n(); ++bin) {
      end[bin] = sum;
      sum += n[bin].n_within;
    }
    FoundNode *const nodes = list.nodes.data();
    constexpr std::ptrdiff_t ahead = 8;  // the number of nodes that fill two cache lines
    for (const FoundNode &node : found) {
      FoundNode *const to = nodes + end[bins_.bin_of(node)]++;
      *to = node;
      __builtin_prefetch(to + ahead, 1);
    }
  }

  template <class Visit>
  void for_each_in(std::int64_t bin, const Visit &visit) const {
    for (std::int64_t i = 0; i < scratch_.n_lists; ++i) {
      const OrderScratch::List &list = view(scratch_.lists)[i];
      const FoundNode *const end = list.nodes.data() + view(list.end)[bin];
      for (const FoundNode *node = end - view(list.n)[bin].n_within; node != end; ++node) visit(*node);
    }
  }

  // Writes the wanted nodes of a bin. The first wanted node gets position `first`.
  template <class IsWanted>
  void write_bin(std::int64_t bin, std::int64_t first, NodeRanks &ranks, NodeList &list,
                 const IsWanted &is_wanted) const {
    ranks.clear();
    for_each_in(bin, [&](const FoundNode &found) {
      if (is_wanted(found)) ranks.add(bins_.number_in_bin(found));
    });
    ranks.count();
    for_each_in(bin, [&](const FoundNode &found) {
      if (is_wanted(found)) put(found, first + ranks.rank(bins_.number_in_bin(found)), list);
    });
  }

  void put(const FoundNode &found, std::int64_t at, NodeList &list) const {
    const std::int64_t position = found.triangle;
    list.set(at, first_number_ + static_cast<std::int64_t>(found.node), found.distance,
             other_ ? -1 : view(triangles_.triangle_id)[position],
             other_ ? view(other_->patches().patches)[position].leaflet_id : view(triangles_.leaflet_id)[position]);
  }

  const TriangleSet &triangles_;
  const PatchDistance *other_;
  double half_thickness_;
  bool limit_is_wider_;
  std::int64_t first_number_;
  Bins bins_;
  int n_threads_;
  OrderScratch &scratch_;
};

}  // namespace

void NodeRanks::make_room(std::int64_t n_numbers) {
  resize(words_, n_numbers / bits_per_word);
  resize(before_, n_numbers / bits_per_word);
  resize(stretch_has_nodes_, n_numbers / (bits_per_word * words_per_stretch));
}

void NodeRanks::clear() { std::fill(stretch_has_nodes_.begin(), stretch_has_nodes_.end(), std::uint8_t{0}); }

void NodeRanks::add(std::int64_t node) {
  const std::int64_t word = node / bits_per_word, stretch = word / words_per_stretch;
  if (!view(stretch_has_nodes_)[stretch]) {
    view(stretch_has_nodes_)[stretch] = 1;
    std::fill_n(words_.begin() + stretch * words_per_stretch, words_per_stretch, std::uint64_t{0});
  }
  view(words_)[word] |= bit_of(node);
}

void NodeRanks::count() {
  std::uint32_t n = 0;
  for (std::int64_t stretch = 0; stretch < view(stretch_has_nodes_).size(); ++stretch) {
    if (!view(stretch_has_nodes_)[stretch]) continue;
    for (std::int64_t word = stretch * words_per_stretch; word < (stretch + 1) * words_per_stretch; ++word) {
      view(before_)[word] = n;
      n += n_bits(view(words_)[word]);
    }
  }
}

std::int64_t NodeRanks::rank(std::int64_t node) const {
  const std::int64_t word = node / bits_per_word;
  return view(before_)[word] + n_bits(view(words_)[word] & (bit_of(node) - 1));
}

OrderScratch::Counts prepare_order(const Surface &surface, const FoundNodes &found, bool limit_is_wider, int n_threads,
                                   OrderScratch &scratch) {
  return Ordering(surface, limit_is_wider, found.numbers, found.size(), n_threads, scratch).gather(found);
}

void put_in_order(const Surface &surface, bool limit_is_wider, const Range &numbers, int n_threads,
                  OrderScratch &scratch, NodeList &within, NodeList &marked) {
  Ordering(surface, limit_is_wider, numbers, within.size(), n_threads, scratch).write(within, marked);
}

}  // namespace riis
