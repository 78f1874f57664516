// SPDX-License-Identifier: Apache-2.0
#include "measures/measures.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "common/array_view.hpp"
#include "measures/leaflet_boundary.hpp"
#include "measures/leaflet_outline.hpp"
#include "measures/plane_cover.hpp"

namespace riis {
namespace {

// Returns the disc of a mechanical valve, seen along the valve's axis.
SeenOutline disc_of(const SourceValve &source) {
  const Placement &placed = source.placement;
  const AlongAxis seen(placed.rotation * Vec3{0, 0, 1}, placed.translation, placed.rotation * Vec3{1, 0, 0});
  return {seen,
          circle(placed.scale * source.disc.radius, {placed.scale * source.disc.x, placed.scale * source.disc.y})};
}

// Returns the vertex ids of all triangles except those of one leaflet.
std::vector<std::int64_t> without_leaflet(const TriangleSet &set, std::int32_t leaflet_id) {
  std::vector<std::int64_t> kept;
  kept.reserve(set.vertex_id.size());
  for (std::int64_t i = 0; i < set.n_triangles(); ++i)
    if (view(set.leaflet_id)[i] != leaflet_id)
      kept.insert(kept.end(), set.vertex_id.begin() + 3 * i, set.vertex_id.begin() + 3 * i + 3);
  return kept;
}

Orifice measured(const TriangleSet &set, const SeenOutline &from, std::int32_t kind, const OrificeLimits &limits) {
  std::vector<PlanePoint> vertices;
  vertices.reserve(set.xyz.size() / 3);
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) vertices.push_back(from.seen(set.vertex(i)));
  const Cover cover = cover_of(vertices, set.skirt < 0 ? set.vertex_id : without_leaflet(set, set.skirt));
  const double whole = area_of(from.outline);
  const UncoveredAreas open = uncovered_areas(from.outline, cover, limits.reach);
  // In a closed valve, all gaps between the triangles and the outline are rounding errors.
  const auto above_rounding = [&](double area) { return area > 1e-12 * whole ? area : 0; };
  return {above_rounding(open.outside),
          whole,
          uncovered_edge(from.outline, cover, limits.slit),
          above_rounding(open.beyond_reach),
          from.seen.axis(),
          kind};
}

}  // namespace

double rim_reach(const Surface &surface, std::int32_t rim) {
  const double without = rim == RIIS_RIM_CUT ? rim_reach_cut : rim_reach_round, offset = surface.band().offset;
  const ValveKind *const kind = surface.source() ? surface.source()->kind : nullptr;
  if (offset == 0 || (kind && kind->is_rigid)) return without;
  // The offsets at which c is 0, in half thicknesses. For mitral valves, only flows with a cut rim were computed.
  const double of_cut_rim = kind == &mitral_valve_kind() ? 0.8 : 0.85, of_round_rim = 1.05;
  return without * std::max(0.0, 1 - offset / (rim == RIIS_RIM_CUT ? of_cut_rim : of_round_rim));
}

double moved_area(const Surface &surface, double shift, std::int32_t left_out) {
  const TriangleSet &set = surface.triangles();
  const Pseudonormals &normals = surface.pseudonormals();
  double area = 0;
  for (std::int64_t i = 0; i < set.n_triangles(); ++i) {
    if (view(set.leaflet_id)[i] == left_out) continue;
    std::array<Vec3, 3> corner = set.corners(i);
    for (std::int64_t k = 0; k < 3; ++k) {
      const Vec3 normal = normals.at(i, {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0}).normal;
      view(corner)[k] = view(corner)[k] + (shift / length(normal)) * normal;
    }
    area += 0.5 * length(cross(corner[1] - corner[0], corner[2] - corner[0]));
  }
  return area;
}

Orifice measure_orifice(const TriangleSet &set, const SourceValve *source, const OrificeLimits &limits) {
  if (source && source->disc.radius > 0) return measured(set, disc_of(*source), RIIS_OUTLINE_DISC, limits);
  std::optional<ValveDirections> valve;
  if (source)
    valve = {source->placement.rotation * source->disc.axis, source->placement.rotation * Vec3{1, 0, 0},
             source->kind->is_seen_along_z};
  const std::optional<SeenOutline> seen = outline_of_leaflets(boundary_of_leaflets(set), valve);
  if (!seen) return {0, 0, 0, 0, valve ? valve->axis : Vec3{0, 0, 0}, RIIS_OUTLINE_NONE};
  return measured(set, *seen, source ? RIIS_OUTLINE_ATTACHMENT : RIIS_OUTLINE_BOUNDARY, limits);
}

Orifice measure_orifice_in_wall(const TriangleSet &set, const SourceValve *source, const TriangleSet &wall,
                                const OrificeLimits &limits) {
  LeafletBoundary boundary = boundary_of_wall(wall);
  // The wall's normals do not show in which direction the valve opens, so the direction is taken from the valve or the leaflets.
  boundary.normal = source ? source->placement.rotation * source->disc.axis : boundary_of_leaflets(set).normal;
  const std::optional<SeenOutline> seen = outline_of_leaflets(boundary, std::nullopt);
  if (!seen) return {0, 0, 0, 0, {0, 0, 0}, RIIS_OUTLINE_NONE};
  return measured(set, *seen, RIIS_OUTLINE_WALL, limits);
}

}  // namespace riis
