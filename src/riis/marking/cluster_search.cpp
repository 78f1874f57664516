// SPDX-License-Identifier: Apache-2.0
#include "marking/cluster_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Maps the mesh's frame to the surface's frame.
struct Placing {
  double ratio;
  Vec3 shift;
  double largest_shift;

  Placing(const Clusters &clusters, const Frame &frame)
      : ratio(frame.scale / clusters.frame.scale),
        shift(frame.scale * (clusters.frame.centre - frame.centre)),
        largest_shift(std::max({std::abs(shift.x), std::abs(shift.y), std::abs(shift.z)})) {}
};

class ClusterSearch {
 public:
  ClusterSearch(const SearchRequest &request, const Clusters &clusters, const Kernels &kernels, ClusterScratch &scratch,
                FoundNodes &found)
      : request_(request),
        scene_(request.surface.scene()),
        groups_(scene_.groups()),
        clusters_(clusters),
        kernels_(kernels),
        found_(found),
        own_(scratch) {
    const Frame &frame = groups_.frame;
    const Placing placing(clusters_, frame);
    const double limit = request.distance_limit * frame.scale;
    // The second term of the error covers the rounding of the distances that are decided in double precision. The third term
    // covers ties, which may be farther than the closest triangle by this amount.
    const double error = filter_error(placing.ratio, placing.largest_shift, limit, groups_.longest_edge) +
                         4 * scene_.rounding() * frame.scale + request.ties.of_leaflets * frame.scale;
    reach_ = static_cast<float>(limit + 2 * error);
    task_.ratio = static_cast<float>(placing.ratio);
    task_.shift[0] = static_cast<float>(placing.shift.x);
    task_.shift[1] = static_cast<float>(placing.shift.y);
    task_.shift[2] = static_cast<float>(placing.shift.z);
    task_.reach_sq = static_cast<float>((limit + 2 * error) * (limit + 2 * error));
    task_.tolerance = filter_tolerance(error, limit + 2 * error);
    task_.margin = static_cast<float>(0.5 * error);
    task_.groups = groups_.groups.data();
    task_.bounds = groups_.bounds.data();
    found.prepare(request.n_threads, request.ties);
    own_.prepare(request.n_threads);
  }

  // Finds the clusters that may be near the surface. For each of them, lists the groups that may be near the cluster. For each of
  // these groups, sets a bit for each leaf of the cluster that may be near the group.
  void find_near_clusters() {
    const Bounds &bounds = scene_.bounds();
    const Vec3 lower = groups_.frame(bounds.lower), upper = groups_.frame(bounds.upper);
    const float surface_lower[3] = {round_down(lower.x), round_down(lower.y), round_down(lower.z)};
    const float surface_upper[3] = {round_up(upper.x), round_up(upper.y), round_up(upper.z)};
    const auto n_regions = view(clusters_.regions).size();
    own_.near_regions.clear();
    own_.near_regions.reserve(static_cast<std::size_t>(n_regions));
    for (std::int64_t region = 0; region < n_regions; ++region) {
      const Clusters::Box &box = view(clusters_.boxes)[region];
      float gap_sq = 0;
      for (int i = 0; i < 3; ++i) {
        const auto [from, to] = placed(box, i);
        const float gap = std::max({from - surface_upper[i], surface_lower[i] - to, 0.0f});
        gap_sq += gap * gap;
      }
      if (gap_sq <= task_.reach_sq) own_.near_regions.push_back(region);
    }
    constexpr std::int64_t few = 64;  // searching so few regions takes a few tenths of a millisecond
    const auto n_near = view(own_.near_regions).size();
    const int n_ran = parallel_for(n_near, request_.n_threads.for_part(n_near, few), [&](std::int64_t i, int thread) {
      search_region(view(own_.near_regions)[i], view(own_.threads)[thread]);
    });
    n_threads_ = std::max(n_threads_, n_ran);
  }

  void search_near_clusters() {
    std::vector<ClusterScratch::Item> &items = own_.items;
    items.clear();
    for (std::size_t thread = 0; thread < own_.threads.size(); ++thread)
      for (ClusterScratch::Item item : own_.threads[thread].items) {
        item.thread = static_cast<int>(thread);
        items.push_back(item);
      }
    constexpr std::int64_t few = 128;  // searching so few clusters takes about half a millisecond
    const auto n = view(items).size();
    const int n_ran = parallel_for(n, request_.n_threads.for_part(n, few), [&](std::int64_t i, int thread) {
      search_cluster(view(items)[i], view(own_.threads)[thread], thread);
    });
    n_threads_ = std::max(n_threads_, n_ran);
  }

  SearchReport report() {
    std::int64_t n_queries = 0;
    for (const auto &own : own_.threads) n_queries += own.n_queries;
    return {n_queries, n_threads_, true, 0};
  }

 private:
  // The extent of a box along one axis, in the surface's frame.
  struct Interval {
    float from, to;
  };
  Interval placed(const Clusters::Box &box, int axis) const {
    return {box.lower[axis] * task_.ratio + task_.shift[axis], box.upper[axis] * task_.ratio + task_.shift[axis]};
  }

  void search_region(std::int64_t region, ClusterScratch::Thread &own) {
    float centre[3], sum = 0;
    for (int i = 0; i < 3; ++i) {
      const auto [from, to] = placed(view(clusters_.boxes)[region], i);
      centre[i] = 0.5f * (from + to);
      sum += (to - from) * (to - from);
    }
    ++own.n_queries;
    own.candidates.clear();
    scene_.collect_groups(centre, 0.5f * std::sqrt(sum) + reach_, own.candidates);
    if (own.candidates.empty()) return;
    own.bits.resize(own.candidates.size());
    if (!kernels_.near_boxes(task_, view(clusters_.regions)[region], own.candidates.data(),
                             static_cast<std::int32_t>(own.candidates.size()), own.bits.data()))
      return;
    const Range of_region = clusters_.clusters_of(region);
    for (std::int64_t cluster = of_region.begin; cluster < of_region.end; ++cluster)
      add_cluster(cluster, cluster - of_region.begin, own);
  }

  // Appends each numbers[k] whose bits[k] has the given bit. Returns how many were appended.
  static std::size_t add_marked(const std::int32_t *numbers, const std::uint16_t *bits, std::size_t n, std::int64_t bit,
                                std::vector<std::int32_t> &to) {
    const std::size_t first = to.size();
    to.resize(first + n);
    std::int32_t *next = to.data() + first;
    // Writes every number, but moves on only after a number that is kept. This avoids a branch that the processor could not
    // predict.
    for (std::size_t k = 0; k < n; ++k) {
      *next = numbers[k];
      next += bits[k] >> bit & 1;
    }
    const auto n_added = static_cast<std::size_t>(next - (to.data() + first));
    to.resize(first + n_added);
    return n_added;
  }

  void add_cluster(std::int64_t cluster, std::int64_t bit, ClusterScratch::Thread &own) {
    const std::size_t first = own.near_groups.size();
    const std::size_t n =
        add_marked(own.candidates.data(), own.bits.data(), own.candidates.size(), bit, own.near_groups);
    if (n == 0) return;
    own.leaf_bits.resize(first + n);
    if (kernels_.near_boxes(task_, view(clusters_.clusters)[cluster], own.near_groups.data() + first,
                            static_cast<std::int32_t>(n), own.leaf_bits.data() + first)) {
      own.items.push_back({cluster, first, n, 0});
    } else {
      own.near_groups.resize(first);
      own.leaf_bits.resize(first);
    }
  }

  // The pairs of node and triangle in a cluster that the filter did not dismiss. They are stored until double precision decides
  // them.
  struct Pairs {
    std::int64_t first_leaf;
    Ties *ties;  // or null
    std::int32_t n = 0;
    std::uint32_t nodes[leaves_per_cluster] = {};  // for each leaf, a bit for each node that has or had pairs
  };

  void search_cluster(const ClusterScratch::Item &item, ClusterScratch::Thread &own, int thread) {
    const ClusterScratch::Thread &from = view(own_.threads)[item.thread];
    const std::int32_t *candidates = from.near_groups.data() + item.first;
    const std::uint16_t *leaf_bits = from.leaf_bits.data() + item.first;
    const Range leaves = clusters_.leaves_of(item.cluster);
    std::uint32_t near = 0;  // a bit for each near leaf
    for (std::size_t k = 0; k < item.n; ++k) near |= leaf_bits[k];
    Pairs pairs{leaves.begin, found_.ties_of(thread)};
    for (; near; near &= near - 1) {
      const int bit = __builtin_ctz(near);
      const std::uint32_t after = near & (near - 1);
      if (after) prefetch(leaves.begin + __builtin_ctz(after));
      own.leaf_groups.clear();
      add_marked(candidates, leaf_bits, item.n, bit, own.leaf_groups);
      std::fill_n(own.closest.begin() + nodes_per_leaf * bit, nodes_per_leaf, nothing);
      filter_leaf(leaves.begin + bit, own, pairs);
    }
    decide(own, pairs);
    std::vector<FoundNode> &found = view(found_.by_thread)[thread];
    for (std::int64_t leaf = leaves.begin; leaf < leaves.end; ++leaf) {
      const std::int64_t i = leaf - leaves.begin;
      for (std::uint32_t rest = pairs.nodes[i]; rest; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        const ClosestTriangle &closest = view(own.closest)[nodes_per_leaf * i + lane];
        const double distance = std::sqrt(closest.distance_sq);
        if (distance <= request_.distance_limit)
          found.emplace_back(clusters_.leaves.get()[leaf].node[lane], distance, closest.triangle);
      }
    }
    if (pairs.ties) settle_ties(own, pairs);
  }

  // Turns the cluster's candidates for ties into ties, for the nodes within the limit.
  __attribute__((noinline)) void settle_ties(const ClusterScratch::Thread &own, const Pairs &pairs) const {
    const auto closest_to = [&](std::int64_t node) -> auto & {
      const ClosestTriangle &closest = view(own.closest)[node];
      return std::sqrt(closest.distance_sq) <= request_.distance_limit ? closest : nothing;
    };
    pairs.ties->settle(closest_to, [&](std::int64_t node) -> std::int64_t {
      return clusters_.leaves.get()[pairs.first_leaf + node / nodes_per_leaf].node[node % nodes_per_leaf];
    });
  }

  void prefetch(std::int64_t leaf) const {
    const auto bytes = [](const auto &of) {
      constexpr std::size_t line = 64;
      for (std::size_t at = 0; at < sizeof of; at += line) __builtin_prefetch(reinterpret_cast<const char *>(&of) + at);
    };
    bytes(clusters_.leaves.get()[leaf]);
    bytes(clusters_.points.get()[leaf]);
  }

  void filter_leaf(std::int64_t number, ClusterScratch::Thread &own, Pairs &pairs) {
    const Leaf &leaf = clusters_.leaves.get()[number];
    const int n_nodes = clusters_.n_nodes_of(number);
    LeafTask task;
    task.leaf = &leaf;
    task.first_node = static_cast<std::int32_t>((number - pairs.first_leaf) * nodes_per_leaf);
    task.wanted = n_nodes == nodes_per_leaf ? 0xffffffffu : (1u << n_nodes) - 1;
    if (request_.node_mask)
      for (int lane = 0; lane < n_nodes; ++lane)
        if (!request_.node_mask[leaf.node[lane]]) task.wanted &= ~(1u << lane);
    task.near_groups = own.leaf_groups.data();
    task.n_groups = static_cast<std::int32_t>(own.leaf_groups.size());
    task.lower_bounds = own.room_for_bounds(own.leaf_groups.size());
    task.next_group = 0;
    task.rest = 0;
    while (task.next_group < task.n_groups) {
      constexpr std::int32_t room = ClusterScratch::room_for_pairs, enough = 1024;
      if (room - pairs.n < enough) decide(own, pairs);
      pairs.n += kernels_.filter_leaf(
          task_, task, {own.pair_nodes.data() + pairs.n, own.pair_triangles.data() + pairs.n}, room - pairs.n);
      pairs.nodes[number - pairs.first_leaf] |= task.found;
    }
  }

  void decide(ClusterScratch::Thread &own, Pairs &pairs) {
    kernels_.decide(pairs.n, own.pair_nodes.data(), own.pair_triangles.data(),
                    clusters_.points.get()[pairs.first_leaf].xyz, groups_.corners.data(), own.pair_decided.data());
    if (pairs.ties) {
      take_closest_and_ties(own, pairs);
    } else {
      for (std::size_t i = 0; i < static_cast<std::size_t>(pairs.n); ++i) {
        ClosestTriangle &best = view(own.closest)[own.pair_nodes[i]];
        if (is_closer(own.pair_decided[i], own.pair_triangles[i], best))
          best = {own.pair_decided[i], own.pair_triangles[i]};
      }
    }
    pairs.n = 0;
  }

  // This function is not inlined, so that the code for a search without ties can use all registers.
  __attribute__((noinline)) void take_closest_and_ties(ClusterScratch::Thread &own, const Pairs &pairs) const {
    for (std::int64_t i = 0; i < pairs.n; ++i) {
      const std::int32_t node = view(own.pair_nodes)[i];
      ClosestTriangle &best = view(own.closest)[node];
      const ClosestTriangle before = best, decided{view(own.pair_decided)[i], view(own.pair_triangles)[i]};
      const bool is_nearer = is_closer(decided.distance_sq, decided.triangle, before);
      if (is_nearer) best = decided;
      pairs.ties->compare(node, best, is_nearer ? before : decided);
    }
  }

  static constexpr ClosestTriangle nothing{std::numeric_limits<double>::infinity(), -1};

  const SearchRequest &request_;
  const TriangleScene &scene_;
  const TriangleGroups &groups_;
  const Clusters &clusters_;
  const Kernels &kernels_;
  FoundNodes &found_;
  ClusterScratch &own_;
  FilterTask task_;
  float reach_;
  int n_threads_ = 1;
};

}  // namespace

void ClusterScratch::prepare(int n_threads) {
  if (view(threads).size() < n_threads) resize(threads, n_threads);
  const auto make_room_for = [this](auto member) {
    make_room(
        threads, [member](Thread & thread) -> auto & { return thread.*member; });
  };
  make_room_for(&Thread::candidates);
  make_room_for(&Thread::bits);
  make_room_for(&Thread::items);
  make_room_for(&Thread::near_groups);
  make_room_for(&Thread::leaf_bits);
  make_room_for(&Thread::leaf_groups);
  make_room_for(&Thread::lower_bounds);
  for (Thread &thread : threads) {
    thread.items.clear();
    thread.near_groups.clear();
    thread.leaf_bits.clear();
    // The arrays get more room than they need, because the kernels write whole registers.
    constexpr std::int64_t room = room_for_pairs + 16;
    resize(thread.pair_nodes, room);
    resize(thread.pair_triangles, room);
    resize(thread.pair_decided, room);
    resize(thread.closest, nodes_per_cluster);
    thread.n_queries = 0;
  }
}

bool separates_in_single_precision(const SearchRequest &request, const Clusters &clusters) {
  const Frame &frame = request.surface.scene().groups().frame;
  const Placing placing(clusters, frame);
  constexpr double large = 0x1p20;
  return placing.ratio >= 0x1p-100 && placing.ratio <= large && placing.largest_shift <= large &&
         request.distance_limit * frame.scale <= large;
}

SearchReport search_clusters(const SearchRequest &request, const Clusters &clusters, const Kernels &kernels,
                             ClusterScratch &scratch, FoundNodes &found) {
  ClusterSearch search(request, clusters, kernels, scratch, found);
  search.find_near_clusters();
  search.search_near_clusters();
  return search.report();
}

}  // namespace riis
