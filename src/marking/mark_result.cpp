// SPDX-License-Identifier: Apache-2.0
#include "marking/mark_result.hpp"

#include <algorithm>
#include <array>

#include "parallel/parallel_for.hpp"

namespace riis {

// By half more than needed, so that a valve that moves does not want more memory with every new largest number.
void NodeList::reserve(std::size_t n) {
  if (n <= node_id.capacity() && n <= leaflet_id.capacity()) return;
  n += n / 2;
  node_id.reserve(n);
  distance.reserve(n);
  triangle_id.reserve(n);
  leaflet_id.reserve(n);
}

void NodeList::resize(std::size_t n) {
  node_id.resize(n);
  distance.resize(n);
  triangle_id.resize(n);
  leaflet_id.resize(n);
}

void NodeList::set(std::size_t i, std::int64_t node, double node_distance, std::int64_t triangle,
                   std::int32_t leaflet) {
  node_id[i] = node;
  distance[i] = node_distance;
  triangle_id[i] = triangle;
  leaflet_id[i] = leaflet;
}

void Collection::prepare(int n_threads) {
  if (by_thread.size() < static_cast<std::size_t>(n_threads)) by_thread.resize(static_cast<std::size_t>(n_threads));
  // Which thread finds how much differs from step to step: each gets room for twice what any had.
  std::size_t largest = 0;
  for (const auto &found : by_thread) largest = std::max({largest, 2 * found.size(), found.capacity()});
  for (auto &found : by_thread) {
    found.clear();
    found.reserve(largest);
  }
}

void Collection::Clustered::prepare(int n_threads) {
  const auto n = static_cast<std::size_t>(n_threads);
  if (threads.size() < n) threads.resize(n);
  // As above.
  const auto make_room = [this](auto member) {
    std::size_t largest = 0;
    for (const Thread &thread : threads)
      largest = std::max({largest, 2 * (thread.*member).size(), (thread.*member).capacity()});
    for (Thread &thread : threads) (thread.*member).reserve(largest);
  };
  make_room(&Thread::candidates);
  make_room(&Thread::bits);
  make_room(&Thread::items);
  make_room(&Thread::near_groups);
  make_room(&Thread::leaf_bits);
  make_room(&Thread::leaf_groups);
  make_room(&Thread::lower_bounds);
  for (Thread &thread : threads) {
    thread.items.clear();
    thread.near_groups.clear();
    thread.leaf_bits.clear();
    // The kernels write whole registers.
    constexpr std::size_t room = static_cast<std::size_t>(room_for_pairs) + 16;
    thread.pair_nodes.resize(room);
    thread.pair_triangles.resize(room);
    thread.pair_decided.resize(room);
    thread.closest.resize(static_cast<std::size_t>(nodes_per_cluster));
    thread.n_queries = 0;
  }
}

void Collection::Walked::prepare(std::int64_t n_nodes, int n_threads) {
  const auto n = static_cast<std::size_t>(n_nodes), n_slots = static_cast<std::size_t>(n_threads);
  if (n_nodes != n_marks_ || walk_ == 255) {
    if (n_nodes != n_marks_) marks_ = std::make_unique<std::atomic<std::uint8_t>[]>(n);
    n_marks_ = n_nodes;
    for (std::size_t i = 0; i < n; ++i) marks_[i].store(0, std::memory_order_relaxed);
    walk_ = 0;
  }
  ++walk_;
  queue.resize(n);
  if (threads.size() < n_slots) threads.resize(n_slots);
  std::size_t largest = 0;
  for (const Thread &thread : threads) largest = std::max(largest, thread.near_groups.capacity());
  for (Thread &thread : threads) {
    thread.clear();
    thread.next.reserve(static_cast<std::size_t>(nodes_per_range));
    thread.near_groups.reserve(largest);
  }
}

namespace {

// A stretch's nodes are a bit each while it is put in order.
constexpr std::int64_t nodes_per_stretch = 16384, bits_per_word = 64;
constexpr std::size_t n_words = nodes_per_stretch / bits_per_word;

// Which of a stretch's nodes there are, and how many before each.
class Ranks {
 public:
  void clear() { bits_.fill(0); }
  void add(std::int64_t node) { bits_[word(node)] |= bit(node); }
  void count() {
    std::uint32_t n = 0;
    for (std::size_t i = 0; i < n_words; ++i) {
      before_[i] = n;
      n += n_bits(bits_[i]);
    }
  }
  std::size_t operator()(std::int64_t node) const {
    const std::size_t i = word(node);
    return before_[i] + n_bits(bits_[i] & (bit(node) - 1));
  }

 private:
  static std::size_t word(std::int64_t node) {
    return static_cast<std::size_t>(node % nodes_per_stretch / bits_per_word);
  }
  static std::uint64_t bit(std::int64_t node) { return std::uint64_t{1} << node % bits_per_word; }
  // Of an x86-64 without the instruction for it the compiler would call a function.
  static std::uint32_t n_bits(std::uint64_t x) {
    x -= x >> 1 & 0x5555555555555555;
    x = (x & 0x3333333333333333) + (x >> 2 & 0x3333333333333333);
    return static_cast<std::uint32_t>(((x + (x >> 4)) & 0x0f0f0f0f0f0f0f0f) * 0x0101010101010101 >> 56);
  }

  std::array<std::uint64_t, n_words> bits_;
  std::array<std::uint32_t, n_words> before_;
};

}  // namespace

void put_in_order(const Surface &surface, bool limit_is_wider, std::int64_t n_nodes, int n_threads,
                  MarkResult &result) {
  const TriangleSet &triangles = surface.triangles();
  const PatchDistance *other = surface.other_distance();
  const double half_thickness = surface.half_thickness();
  Collection &collection = result.collection;
  const std::size_t n_lists = collection.by_thread.size();
  const auto n_stretches = static_cast<std::size_t>((n_nodes + nodes_per_stretch - 1) / nodes_per_stretch);
  const auto stretch_of = [](const FoundNode &found) {
    return static_cast<std::size_t>(found.node / nodes_per_stretch);
  };

  std::size_t n_within = 0;
  for (const auto &found : collection.by_thread) n_within += found.size();
  constexpr std::size_t few = 4096;  // other threads would come too late
  if (n_within < few) n_threads = 1;

  // Stretch by stretch, list by list: how many, then where they begin; a last one with the sums.
  std::vector<Collection::Stretch> &stretches = collection.stretches;
  stretches.assign(n_stretches * n_lists + 1, {0, 0});
  parallel_for(static_cast<std::int64_t>(n_lists), n_threads, [&](std::int64_t list, int) {
    for (const FoundNode &found : collection.by_thread[static_cast<std::size_t>(list)]) {
      Collection::Stretch &stretch = stretches[stretch_of(found) * n_lists + static_cast<std::size_t>(list)];
      ++stretch.n_within;
      stretch.n_marked += found.distance <= half_thickness;
    }
  });
  Collection::Stretch sum{0, 0};
  for (Collection::Stretch &stretch : stretches) {
    const Collection::Stretch n = stretch;
    stretch = sum;
    sum.n_within += n.n_within;
    sum.n_marked += n.n_marked;
  }
  const std::size_t n_in_marked = limit_is_wider ? static_cast<std::size_t>(sum.n_marked) : 0;
  result.within.reserve(n_within);
  result.marked.reserve(n_in_marked);
  if (collection.by_stretch.size() < n_within) collection.by_stretch.resize(n_within + n_within / 2);

  result.within.resize(n_within);
  result.marked.resize(n_in_marked);
  parallel_for(static_cast<std::int64_t>(n_lists), n_threads, [&](std::int64_t list, int) {
    for (const FoundNode &found : collection.by_thread[static_cast<std::size_t>(list)]) {
      // From its list's begin to the next one's: n_within counts up.
      std::int64_t &at = stretches[stretch_of(found) * n_lists + static_cast<std::size_t>(list)].n_within;
      collection.by_stretch[static_cast<std::size_t>(at++)] = found;
    }
  });
  parallel_for(static_cast<std::int64_t>(n_stretches), n_threads, [&](std::int64_t i, int) {
    const Collection::Stretch *lists = stretches.data() + static_cast<std::size_t>(i) * n_lists;
    // Each list's place has moved on to its end: the end of the stretch before is where this one begins.
    const std::int64_t begin = i == 0 ? 0 : lists[-1].n_within, end = lists[n_lists - 1].n_within;
    if (begin == end) return;
    const auto for_each = [&](const auto &visit) {
      for (std::int64_t k = begin; k < end; ++k) visit(collection.by_stretch[static_cast<std::size_t>(k)]);
    };
    Ranks ranks;
    const auto put = [&](NodeList &list, std::size_t first, const FoundNode &found) {
      const auto at = static_cast<std::size_t>(found.triangle);
      const auto node = static_cast<std::int64_t>(found.node);
      const std::int64_t triangle_id = other ? -1 : triangles.triangle_id[at];
      const std::int32_t leaflet_id = other ? other->patches().patches[at].leaflet_id : triangles.leaflet_id[at];
      list.set(first + ranks(node), node, found.distance, triangle_id, leaflet_id);
    };
    ranks.clear();
    for_each([&](const FoundNode &found) { ranks.add(static_cast<std::int64_t>(found.node)); });
    ranks.count();
    for_each([&](const FoundNode &found) { put(result.within, static_cast<std::size_t>(begin), found); });
    if (!limit_is_wider) return;
    const auto is_marked = [&](const FoundNode &found) { return found.distance <= half_thickness; };
    ranks.clear();
    for_each([&](const FoundNode &found) {
      if (is_marked(found)) ranks.add(static_cast<std::int64_t>(found.node));
    });
    ranks.count();
    for_each([&](const FoundNode &found) {
      if (is_marked(found)) put(result.marked, static_cast<std::size_t>(lists[0].n_marked), found);
    });
  });
}

}  // namespace riis
