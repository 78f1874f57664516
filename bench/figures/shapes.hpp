// SPDX-License-Identifier: Apache-2.0
// Makes the parts of a valve that can be drawn.
// Input: a valve, a tolerance. Output: its placed curves with their control points, and its quads, triangles and edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "figures/picture.hpp"
#include "triangulate/grids.hpp"
#include "triangulate/triangulate.hpp"
#include "valve/valve.hpp"

namespace riis::figures {

inline constexpr double half_thickness = 0.1;
inline constexpr std::int32_t every_leaflet = -1;

// The results of every stage for a valve.
struct Model {
  PatchSet patches;
  Vector<QuadGrid> grids;  // one per patch, before its images are placed
  TriangleSet triangles;
};
Model make_model(const Valve &valve, double tolerance);

using LeafletColours = std::array<Colour, 3>;
inline constexpr LeafletColours leaflet_colours = {blue, orange, green};
// Returns paler colours, for leaflets in the background of curves.
LeafletColours paler(const LeafletColours &colours, double white);

Faces quads_of(const Model &model, std::int32_t leaflet, const LeafletColours &colours = leaflet_colours);
Faces triangles_of(const Model &model, std::int32_t leaflet, const LeafletColours &colours = leaflet_colours);
Segments edges_of(const Faces &faces);

// The edges that subdivision adds to the quads, and the diagonals that divide quads into triangles.
struct TriangleEdges {
  Segments halving, diagonals;
};
TriangleEdges triangle_edges_of(const Model &model, std::int32_t leaflet);

// A curve as the list of its pieces. Each piece begins where the previous one ends.
using Pieces = std::vector<Bezier>;

Pieces placed(const PatchSet &set, const Side &side, const PatchImage &image);
Pieces reversed(Pieces pieces);
// Rejoins the parts of curves that were cut. Pieces that were separate from the start stay separate.
Pieces joined(const Pieces &pieces);
Points samples(const Pieces &pieces);
std::vector<Points> control_polygons(const Pieces &pieces);
// Returns every control point once: an end that two pieces share counts once, and so does the end of a closed curve.
Points control_points(const Pieces &pieces);

// The polylines on the boundary of a patch's grid, in the order v0, v1, u0, u1, before any image is placed. They consist of the
// grid's boundary points that lie on the curve. A collapsed side is a single point.
struct BoundaryPolyline {
  Points points;
  std::vector<double> t;
};
std::array<BoundaryPolyline, 4> boundary_polylines(const PatchSet &set, const Patch &patch, const QuadGrid &grid);

// The curves that define half a cusp in the paper. They are rejoined where the bending curve cuts them.
struct CuspCurves {
  std::array<Pieces, 2> leaflet, bending, sinus;  // each array has a curve and its mirror image
  Pieces symmetry;
};
CuspCurves cusp_curves(const PatchSet &set, std::int32_t cusp);

// The annulus, once around from the posterior point, and the free edges from one commissure to the other.
struct MitralCurves {
  Pieces annulus, anterior, posterior;
};
MitralCurves mitral_curves(const PatchSet &set);

void append(Points &to, const Points &from);

}  // namespace riis::figures
