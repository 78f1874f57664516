// SPDX-License-Identifier: Apache-2.0
// The request and the report that all searches share.
// A search takes a surface, a mesh and a limit. It finds the nodes within the limit, with their distances and closest triangles,
// in any order.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "common/band.hpp"
#include "mesh/mesh.hpp"
#include "parallel/threads.hpp"
#include "scene/surface.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// The nodes that a search finds, in one list for each thread. The lists' memory is reused, so the library allocates nothing in a
// steady run of time steps.

// A limit on the number of a mesh's nodes. No machine has memory for the coordinates of so many nodes.
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

// Each thread's list gets room for twice the length of the longest list, because the number of nodes that a thread finds changes
// from step to step. The room is rounded up to a power of two. A step that finds slightly more nodes than all previous steps thus
// allocates no memory.
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
  Range numbers{0, 0};  // the range of the nodes' numbers; the lists count nodes from the beginning of this range
  std::vector<UnfilledVector<FoundNode>> by_thread;
  std::vector<Ties> ties_by_thread;  // the lists stay empty unless the rule requests ties

  // Empties the lists, and makes room for the next search.
  void prepare(int n_threads, const TieRule &ties = {}) {
    // Checks the size of each array of lists separately, because an earlier call may have run out of memory after the first
    // array.
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
    view(by_thread)[thread].push_back({node - numbers.begin, std::sqrt(closest.distance_sq), closest.triangle});
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

// The part of a search's request that does not depend on how the nodes are stored.
struct NodeSearch {
  const Surface &surface;
  double distance_limit;
  const std::uint8_t *node_mask;  // or null
  Threads n_threads;
  InstructionSet instructions;
  TieRule ties = {};
  // If this pointer is not null, the search may leave out nodes outside of the band, because the caller does not want them.
  const Band *listed = nullptr;

  bool is_masked_out(std::int64_t node) const { return node_mask && !node_mask[node]; }
};

struct SearchRequest : NodeSearch {
  const Mesh &mesh;
};

struct SearchReport {
  std::int64_t n_queries;
  int n_threads;
  bool complete;
  std::int64_t n_unreached;  // the number of nodes that only the proof of the neighbour search found
};

// Every search fills FoundNodes. The nodes are in no particular order. A search that reads an unusable coordinate fails with
// RIIS_INVALID_MESH.

// Queries every node (paper, 4.2.1 "Exhaustive node iteration").
SearchReport search_exhaustively(const SearchRequest &request, FoundNodes &found);
// Queries every node in a box of a grid.
SearchReport search_exhaustively(const NodeSearch &request, const Grid &grid, const GridBox &box, FoundNodes &found);

// A search measures distances in one of two ways: to a surface's triangles, or by another method of the surface. The code of
// searches is compiled for both ways, so that distances to triangles need no virtual call.

// Distances to the triangles of a surface.
struct TriangleDistances {
  const TriangleScene &scene;
  InstructionSet instructions;

  bool may_be_within(Vec3 p, double limit) const { return scene.may_be_within(p, limit); }
  // Returns the triangle closest to p. If `ties` is not null, the function replaces the candidates in it by those for p.
  ClosestTriangle closest(Vec3 p, double limit, Ties *ties = nullptr) const {
    return scene.closest(p, limit, instructions, ties);
  }

  // Returns a number d such that every point q is at least d - |q - p| away from the surface. A large d thus proves that all
  // points near p are far from the surface. If d is above the limit, the result is infinity.
  double lower_bound(Vec3 p, double limit) const {
    return std::sqrt(scene.closest(p, limit, instructions).distance_sq);
  }

  // Returns the constant part of the error of a distance from p. Another part of the error is proportional to the distance and to
  // |p|.
  double rounding() const { return scene.rounding(); }
};

// Distances by another method. The index of a patch takes the place of a triangle's index.
struct OtherDistances {
  const PatchDistance &method;
  const TriangleScene &scene;
  double triangle_error;  // the most by which the distance to the triangles exceeds a distance to S(u,v)

  bool may_be_within(Vec3 p, double limit) const { return method.may_be_within(p, limit); }
  ClosestTriangle closest(Vec3 p, double limit, Ties * = nullptr) const {
    const ClosestOnPatches found = method.closest(p, limit);
    return {found.distance_sq, found.patch};
  }

  // Sampling measures the distance to fixed points, so this distance itself is the bound. Minimisation may end at any point of S,
  // so its result at p gives no bound for other points. However, every result is the distance to some point of S. Every result is
  // therefore at least the distance to the triangles, minus triangle_error.
  double lower_bound(Vec3 p, double limit) const {
    if (method.is_of_fixed_points()) return std::sqrt(method.closest(p, limit).distance_sq);
    constexpr double far = std::numeric_limits<double>::infinity();
    const ClosestTriangle found = scene.closest(p, limit + triangle_error, best_instruction_set());
    return found.triangle < 0 ? far : std::sqrt(found.distance_sq) - triangle_error;
  }

  double rounding() const { return scene.rounding(); }
};

// Calls visit(distances). `distances` is a TriangleDistances or an OtherDistances, as the surface requires.
template <class Visit>
auto with_distances(const Surface &surface, InstructionSet instructions, const Visit &visit) {
  if (const PatchDistance *method = surface.other_distance())
    return visit(OtherDistances{*method, surface.scene(), surface.triangle_error()});
  return visit(TriangleDistances{surface.scene(), instructions});
}

}  // namespace riis
