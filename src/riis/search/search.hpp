// SPDX-License-Identifier: Apache-2.0
// The request and the report that all searches share.
// In: surface, mesh, limit. Out: the nodes within the limit in any order, with distance and triangle.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "mesh/mesh.hpp"
#include "parallel/threads.hpp"
#include "scene/surface.hpp"
#include "search/found_nodes.hpp"

namespace riis {

// A search among nodes, wherever they are stored.
struct NodeSearch {
  const Surface &surface;
  double distance_limit;
  const std::uint8_t *node_mask;  // or null
  Threads n_threads;
  InstructionSet instructions;
  TieRule ties = {};

  bool is_masked_out(std::int64_t node) const { return node_mask && !node_mask[node]; }
};

struct SearchRequest : NodeSearch {
  const Mesh &mesh;
};

struct SearchReport {
  std::int64_t n_queries;
  int n_threads;
  bool complete;
  std::int64_t n_unreached;  // number of nodes that only the neighbour search's proof found
};

// Every search fills FoundNodes in any order. It fails with RIIS_INVALID_MESH if it reads an unusable coordinate.

// Queries every node (paper, 4.2.1 "Exhaustive node iteration").
SearchReport search_exhaustively(const SearchRequest &request, FoundNodes &found);

// The two ways in which a search measures distances: to a surface's triangles, or by the surface's other method. Searches are
// compiled once for each way, so distances to triangles cost no virtual call.

// Distances to the triangles of a surface.
struct TriangleDistances {
  const TriangleScene &scene;
  InstructionSet instructions;

  bool may_be_within(Vec3 p, double limit) const { return scene.may_be_within(p, limit); }
  // Returns the triangle closest to p. Replaces the candidates of `ties`, which may be null, by those of p.
  ClosestTriangle closest(Vec3 p, double limit, Ties *ties = nullptr) const {
    return scene.closest(p, limit, instructions, ties);
  }

  // Returns a number d such that every point q has a distance of at least d - |q - p| from the surface. A large d proves that all
  // points near p are far from the surface. Returns infinity if d is above the limit.
  double lower_bound(Vec3 p, double limit) const {
    return std::sqrt(scene.closest(p, limit, instructions).distance_sq);
  }

  // Returns the constant part of the error of a distance from p. The other part is proportional to the distance and to |p|.
  double rounding() const { return scene.rounding(); }
};

// Distances by another method. The index of a patch takes the place of a triangle's index.
struct OtherDistances {
  const PatchDistance &method;
  const TriangleScene &scene;
  double triangle_error;  // the distance to the triangles exceeds a distance to S(u,v) by at most this

  bool may_be_within(Vec3 p, double limit) const { return method.may_be_within(p, limit); }
  ClosestTriangle closest(Vec3 p, double limit, Ties * = nullptr) const {
    const ClosestOnPatches found = method.closest(p, limit);
    return {found.distance_sq, found.patch};
  }

  // Sampling measures the distance to fixed points, so the distance is such a bound. A minimisation may end anywhere on S, so its
  // result at p bounds no result near p. But each of its results is the distance to some point of S, and so at least the distance
  // to the triangles minus triangle_error.
  double lower_bound(Vec3 p, double limit) const {
    if (method.is_of_fixed_points()) return std::sqrt(method.closest(p, limit).distance_sq);
    const double infinity = std::numeric_limits<double>::infinity();
    const ClosestTriangle found = scene.closest(p, limit + triangle_error, best_instruction_set());
    return found.triangle < 0 ? infinity : std::sqrt(found.distance_sq) - triangle_error;
  }

  double rounding() const { return scene.rounding(); }
};

// Calls visit(distances) with the way in which the surface measures.
template <class Visit>
auto with_distances(const Surface &surface, InstructionSet instructions, const Visit &visit) {
  if (const PatchDistance *method = surface.other_distance())
    return visit(OtherDistances{*method, surface.scene(), surface.triangle_error()});
  return visit(TriangleDistances{surface.scene(), instructions});
}

}  // namespace riis
