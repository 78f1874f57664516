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

namespace riis::cli {

using Point = std::array<double, 3>;
using Line = std::vector<Point>;

// The arrays of a valve's surface, borrowed until its next update.
struct SurfaceArrays {
  std::int64_t n_vertices, n_triangles;
  const double *xyz, *uv;
  const std::int64_t *vertex_id;
  const std::int32_t *leaflet_id, *patch_id;

  explicit SurfaceArrays(const riis_surface *surface);
  Point vertex(std::int64_t id) const { return {xyz[3 * id], xyz[3 * id + 1], xyz[3 * id + 2]}; }
};

enum PatchSide : std::int32_t { side_v0, side_v1, side_u0, side_u1, n_sides };

struct PatchSides {
  std::int32_t patch_id, leaflet_id;
  std::array<Line, n_sides> lines;  // by ascending u or v
};

// Ascending by patch.
std::vector<PatchSides> sides_of_patches(const SurfaceArrays &surface);

double length_of(const Line &line);

std::map<std::int32_t, double> areas_of_leaflets(const SurfaceArrays &surface);

// The patches whose side v = 1 is a free edge: it has a length, and no other patch of its leaflet has it for a side.
std::set<std::int32_t> free_edges(const std::vector<PatchSides> &patches);

// The sides v = 0 that have a length and are no side of another patch: where the leaflets hang.
std::vector<Line> attachment(const std::vector<PatchSides> &patches);

}  // namespace riis::cli
