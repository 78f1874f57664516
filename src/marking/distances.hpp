// SPDX-License-Identifier: Apache-2.0
// What searches ask for distances, whichever way a surface measures them: its triangles, or another method. Searches are
// compiled for either, so that the triangles pay nothing for there being others.
#pragma once

#include <cmath>
#include <limits>

#include "distance/surface.hpp"

namespace riis {

// The closest triangle of a surface.
struct TriangleDistances {
  const TriangleScene &scene;
  InstructionSet instructions;

  bool may_be_within(Vec3 p, double limit) const { return scene.may_be_within(p, limit); }
  ClosestTriangle closest(Vec3 p, double limit) const { return scene.closest(p, limit, instructions); }

  // A number d such that no point q has a distance below d - |q - p|: what proves that points near p are far. Infinity where
  // d is above the limit.
  double lower_bound(Vec3 p, double limit) const {
    return std::sqrt(scene.closest(p, limit, instructions).distance_sq);
  }

  // How far a distance may be off, beyond what is in proportion to it and to p.
  double rounding() const { return scene.rounding(); }
};

// By another method. Where a triangle would be said it is the position of a patch.
struct OtherDistances {
  const PatchDistance &method;
  const TriangleScene &scene;
  double triangle_error;  // distances to the triangles are at most this above those to S(u,v)

  bool may_be_within(Vec3 p, double limit) const { return method.may_be_within(p, limit); }
  ClosestTriangle closest(Vec3 p, double limit) const {
    const ClosestOnPatches found = method.closest(p, limit);
    return {found.distance_sq, found.patch};
  }

  // A method that may end anywhere proves nothing of points nearby. But what it says is the distance of a point of S, so not less
  // than the distance to the triangles, less what these are off.
  double lower_bound(Vec3 p, double limit) const {
    if (method.is_of_fixed_points()) return std::sqrt(method.closest(p, limit).distance_sq);
    const double infinity = std::numeric_limits<double>::infinity();
    const ClosestTriangle found = scene.closest(p, limit + triangle_error, best_instruction_set());
    return found.triangle < 0 ? infinity : std::sqrt(found.distance_sq) - triangle_error;
  }

  double rounding() const { return scene.rounding(); }
};

// visit(distances) for those of the surface.
template <class Visit>
auto with_distances(const Surface &surface, InstructionSet instructions, const Visit &visit) {
  if (const PatchDistance *method = surface.other_distance())
    return visit(OtherDistances{*method, surface.scene(), surface.triangle_error()});
  return visit(TriangleDistances{surface.scene(), instructions});
}

}  // namespace riis
