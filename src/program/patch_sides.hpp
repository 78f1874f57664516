// SPDX-License-Identifier: Apache-2.0
// In: the surface of a valve. Out: the sides of its patches as lines through vertices, the free edges, the
// attachment, and the areas of the leaflets.
#pragma once

#include <riis/riis.h>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace riis::program {

using Point = std::array<double, 3>;
using Line = std::vector<Point>;

inline Point vertex_of(const riis_triangles &surface, std::int64_t id) {
  return {surface.xyz[3 * id], surface.xyz[3 * id + 1], surface.xyz[3 * id + 2]};
}

enum PatchSide : std::int32_t { side_v0, side_v1, side_u0, side_u1, n_sides };

struct PatchSides {
  std::int32_t patch_id, leaflet_id;
  std::array<Line, n_sides> lines;  // vertices by ascending u or v
};

// Ascending by patch.
std::vector<PatchSides> sides_of_patches(const riis_triangles &surface);

double line_length(const Line &line);

std::map<std::int32_t, double> areas_of_leaflets(const riis_triangles &surface);

// Returns the patches whose side v = 1 is a free edge. A free edge has a length and is not a side of another patch of its
// leaflet.
std::set<std::int32_t> free_edges(const std::vector<PatchSides> &patches);

// Returns the sides v = 0 at which the leaflets are attached. They have a length and are not a side of another patch.
std::vector<Line> attachment(const std::vector<PatchSides> &patches);

}  // namespace riis::program
