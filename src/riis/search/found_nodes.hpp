// SPDX-License-Identifier: Apache-2.0
// The nodes that a search finds, in one list for each thread. The lists' memory is reused, so the library allocates nothing in a
// steady run of time steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "scene/ties.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// A limit on the number of nodes. No memory holds the coordinates of so many.
inline constexpr std::int64_t max_nodes = std::int64_t{1} << 40;

// A node within the distance limit. `triangle` is a position in the surface's set of triangles. If another method measures the
// distances, `triangle` is the position of a patch.
struct FoundNode {
  std::uint64_t node : 40, triangle : 24;
  double distance;

  FoundNode() = default;
  FoundNode(std::int64_t node_id, double node_distance, std::int64_t position)
      : node(static_cast<std::uint64_t>(node_id) & (max_nodes - 1)),
        triangle(static_cast<std::uint64_t>(position) & (max_triangles - 1)),
        distance(node_distance) {}
};
static_assert(sizeof(FoundNode) == 16);

// Gives each thread's list room for twice the longest list, because the threads' shares differ from step to step. The room is a
// power of two. So a step that finds a few more nodes than all previous steps allocates no memory.
template <class Threads, class ListOf>
void make_room(Threads &threads, const ListOf &list_of) {
  std::size_t largest = 0, room = 1;
  for (auto &thread : threads) largest = std::max({largest, 2 * list_of(thread).size(), list_of(thread).capacity()});
  if (largest == 0) return;
  while (room < largest) room *= 2;
  for (auto &thread : threads) list_of(thread).reserve(room);
}

// One list for each thread. The order within a list has no meaning.
struct FoundNodes {
  std::vector<UnfilledVector<FoundNode>> by_thread;
  std::vector<Ties> ties_by_thread;  // stay empty unless the rule requests ties

  // Empties the lists, and makes room for the next search.
  void prepare(int n_threads, const TieRule &ties = {}) {
    // Checks each list on its own, because an earlier call may have resized only the first and then run out of memory.
    if (view(by_thread).size() < n_threads) resize(by_thread, n_threads);
    if (view(ties_by_thread).size() < n_threads) resize(ties_by_thread, n_threads);
    make_room(
        by_thread, [](auto &found) -> auto & { return found; });
    make_room(
        ties_by_thread, [](Ties & thread) -> auto & { return thread.candidates; });
    make_room(
        ties_by_thread, [](Ties & thread) -> auto & { return thread.found; });
    for (auto &found : by_thread) found.clear();
    for (Ties &thread : ties_by_thread) {
      thread.rule = ties;
      thread.candidates.clear();
      thread.found.clear();
    }
  }

  // Returns the place for a thread's ties, or null if ties are not wanted.
  Ties *ties_of(int thread) {
    Ties &ties = view(ties_by_thread)[thread];
    return ties.rule.leaflet_id ? &ties : nullptr;
  }

  // Adds a node with its closest triangle and its ties. All candidates for ties must belong to this node.
  void add(int thread, std::int64_t node, const ClosestTriangle &closest) {
    view(by_thread)[thread].push_back({node, std::sqrt(closest.distance_sq), closest.triangle});
    if (Ties *const ties = ties_of(thread))
      ties->settle(
          [&](std::int64_t) -> auto & { return closest; }, [&](std::int64_t) { return node; });
  }

  std::int64_t size() const {
    std::int64_t n = 0;
    for (const auto &found : by_thread) n += view(found).size();
    return n;
  }
};

}  // namespace riis
