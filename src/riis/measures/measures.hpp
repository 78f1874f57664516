// SPDX-License-Identifier: Apache-2.0
// The measures of a surface and of its marks. Each part of this header has its own source file.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "geometry/placement.hpp"
#include "marks/marks.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/mesh.hpp"
#include "scene/edges.hpp"
#include "scene/surface.hpp"
#include "scene/triangle_groups.hpp"
#include "scene/triangle_scene.hpp"
#include "triangulate/triangle_set.hpp"
#include "valve/skirt.hpp"
#include "valve/valve.hpp"

namespace riis {

// The orifice of a valve is the part of an outline's area that no triangle covers, seen along the axis. The triangles come from a
// valve or from arrays. The results are areas and a perimeter.

// The factor c of the effective area A - c eps P. The band around the rim narrows an orifice by the distance c eps. A thin wall
// would block the flow as much if its rim reached c eps farther into the orifice. Each number below is the mean of c for two
// valves, which docs/validation.md compares with walls in body-fitted meshes. For the open bileaflet valve, c is 0.98 (round rim)
// and 0.95 (cut rim). For the open trileaflet valve, c is 0.70 (round rim) and 0.46 (cut rim).
inline constexpr double rim_reach_round = 0.84;  // RIIS_RIM_ROUND
inline constexpr double rim_reach_cut = 0.70;    // RIIS_RIM_CUT

// The measured numbers. From them and the valve, the caller computes the other fields of riis_orifice.
struct Orifice {
  double area, outline_area, perimeter, effective_area;
  Vec3 axis;             // of length 1, or 0 without an axis
  std::int32_t outline;  // RIIS_OUTLINE_*
};

struct OrificeLimits {
  double reach;  // how far inwards the rim is moved to give the effective orifice
  double slit;   // how far inwards the rim is moved before the perimeter is measured
};

// Returns the factor c of a surface's band. An offset lowers c, because the flow then passes nearer to the leaflet. The offset at
// which c reaches 0 was fitted to computed flows through trileaflet and mitral valves. A bileaflet valve has flow on both sides
// of its leaflets, so an offset does not change its c.
double rim_reach(const Surface &surface, std::int32_t rim);

// Measures the orifice. `source` is null for triangles from arrays, whose outline is their longest boundary.
Orifice measure_orifice(const TriangleSet &set, const SourceValve *source, const OrificeLimits &limits);
// Measures the orifice inside the outline of a wall. The wall's own triangles do not cover any part of the orifice.
Orifice measure_orifice_in_wall(const TriangleSet &set, const SourceValve *source, const TriangleSet &wall,
                                const OrificeLimits &limits);

// Returns the area of the surface after each vertex has moved by `shift` along its unit normal. The triangles of one leaflet are
// left out; -1 leaves out no triangles.
double moved_area(const Surface &surface, double shift, std::int32_t left_out);

// The coaptation of leaflets consists of their parts that are within a given distance of another leaflet.
// The results are areas and lengths.

struct Contact {
  double area, edge;
};

// Returns the contact of each leaflet. A point of a leaflet is in contact if another leaflet is within `reach` of it. `parts` has
// the free edges. The leaflets in `omitted` have no contact. `wanted` is a leaflet, or RIIS_ALL_LEAFLETS.
std::map<std::int32_t, Contact> contacts_of(const TriangleSet &set, const std::vector<EdgePart> &parts, double reach,
                                            std::int32_t wanted, const std::vector<std::int32_t> &omitted,
                                            int n_threads);

// Self-intersections of a surface are pairs of triangles that go through each other.
// The result has the pairs in ascending order, with their depths and common segments.

struct Crossings {
  std::vector<std::int64_t> triangle;     // (2, n_pairs), positions in the set, the lower one first
  std::vector<std::int64_t> triangle_id;  // (2, n_pairs)
  std::vector<double> point;              // (3, n_pairs), the middle of the common segment
  std::vector<double> depth, length;      // (n_pairs)
};

// Finds the pairs of triangles that penetrate each other by more than `least_depth`. Two triangles of one leaflet that share a
// vertex do not count as a pair. Vertices are shared if their coordinates are equal.
Crossings find_crossings(const TriangleSet &set, const TriangleGroups &groups, double least_depth, int n_threads);

// Returns the depth up to which the triangles of touching leaflets may cross (docs/theory/crossings.md).
double depth_of_contacts(const Surface &surface);

// This part measures the gap between the attachment of a valve and a wall, along the direction in which a skirt leads. The
// results are distances, and the lengths of a skirt that reaches the wall.

// The triangles of a wall, and the scene that finds them.
struct Wall {
  const TriangleSet &triangles;
  const TriangleScene &scene;
};

// The line through `point` along `direction`, which has length 1, may meet the wall in several places. Returns the distance from
// `point` to the nearest of them. The distance is negative if this place lies on the side opposite to `direction`. Returns
// nothing if the line misses the wall.
std::optional<double> distance_along(const Wall &wall, Vec3 point, Vec3 direction);

// The gap at both ends of every edge of an attachment.
struct Gap {
  std::vector<double> distance;  // (2, n_edges); RIIS_FAR_DISTANCE where the line misses the wall
  riis_gap measures;
};
// Measures the gap. Fails with RIIS_INVALID_ARGUMENT if there are no edges or if the outward direction is undetermined.
Gap gap_of(const Attachment &attachment, const Wall &wall, int n_threads);

// Returns the lengths of a skirt that reaches the wall from a placed valve, whose patches have no skirt. A skirt has a shortest
// permitted length. Where the wall is nearer than this, the skirt has the shortest length. Fails with RIIS_INVALID_ARGUMENT if
// the wall is farther than `longest`, in placed units.
SkirtLengths lengths_to_wall(const PatchSet &set, const Placement &placement, const Wall &wall, double longest,
                             int n_threads);

// Computes the volume that a surface sweeps. The volume is the integral of u . n over the surface and time, so motion along the
// normals counts as positive.
// The result is the volume that each leaflet of a valve sweeps between two openings.

// Maps a leaflet_id to the volume that the leaflet sweeps. The volumes are those of the valve before placement.
using SweptVolumes = std::map<std::int32_t, double>;

// Computes the volumes between two openings. Fails if the patches cannot be made at an opening. If the two openings are
// exchanged, only the sign of the result changes.
SweptVolumes swept_volumes(const Valve &valve, double opening_from, double opening_to, int n_threads);

// Estimates how many mesh edges fit across the band. Divides the band's thickness by the shortest, the mean and the longest of
// the mesh edges with a marked node.
// The results are counts and lengths.

// Computes the number of mesh edges across the band. Fails with RIIS_INVALID_MESH if a coordinate is not finite or too large.
riis_cells_across cells_across(const Marks &marks, const Mesh &mesh, int n_threads);

}  // namespace riis
