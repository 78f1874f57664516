// SPDX-License-Identifier: Apache-2.0
// The gap between the attachment of a valve and a wall, along the direction in which a skirt leads.
// In: points and directions, the triangles of the wall. Out: distances, and the lengths of a skirt that reaches the wall.
#pragma once

#include <riis/riis.h>

#include <optional>
#include <vector>

#include "geometry/placement.hpp"
#include "scene/edges.hpp"
#include "scene/triangle_scene.hpp"
#include "triangulate/triangle_set.hpp"
#include "valve/skirt.hpp"

namespace riis {

// The triangles of a wall, and the scene that finds them.
struct Wall {
  const TriangleSet &triangles;
  const TriangleScene &scene;
};

// Returns the distance from a point to the nearest place at which the line through it meets the wall. The distance is negative if
// this place lies against the direction, which has length 1. Returns nothing if the line misses the wall.
std::optional<double> distance_along(const Wall &wall, Vec3 point, Vec3 direction);

// The gap at each end of each edge of an attachment.
struct Gap {
  std::vector<double> distance;  // (2, n_edges); RIIS_FAR_DISTANCE where the line misses the wall
  riis_gap measures;
};
// Measures the gap. Fails with RIIS_INVALID_ARGUMENT if there are no edges, and if nothing tells which way is outwards.
Gap gap_of(const Attachment &attachment, const Wall &wall, int n_threads);

// Returns the lengths of a skirt that reaches the wall from a placed valve, whose patches have no skirt. Where the wall is nearer
// than the shortest skirt allows, the length is that of the shortest skirt. Fails with RIIS_INVALID_ARGUMENT if the wall is
// farther than `longest`, in placed units.
SkirtLengths lengths_to_wall(const PatchSet &set, const Placement &placement, const Wall &wall, double longest,
                             int n_threads);

}  // namespace riis
