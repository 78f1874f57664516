// SPDX-License-Identifier: Apache-2.0
// What can be drawn of a valve.
// In: a valve, a tolerance. Out: its curves put in place, with their control points; quads, triangles, edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "figures/picture.hpp"
#include "surface/grids.hpp"
#include "surface/triangulate.hpp"
#include "valve/valve.hpp"

namespace riis::figures {

inline constexpr double half_thickness = 0.1;
inline constexpr std::int32_t every_leaflet = -1;

// A valve as every stage leaves it.
struct Model {
  PatchSet patches;
  std::vector<QuadGrid> grids;  // one a patch, before its images are put in place
  TriangleSet triangles;
};
Model make_model(const Valve &valve, double tolerance);

using LeafletColours = std::array<Colour, 3>;
inline constexpr LeafletColours leaflet_colours = {blue, orange, green};
// The same leaflets as the ground on which curves are drawn.
LeafletColours paler(const LeafletColours &colours, double white);

Faces quads_of(const Model &model, std::int32_t leaflet, const LeafletColours &colours = leaflet_colours);
Faces triangles_of(const Model &model, std::int32_t leaflet, const LeafletColours &colours = leaflet_colours);
Segments edges_of(const Faces &faces);

// What subdivision of the quads adds to their edges, and the diagonals that make triangles.
struct TriangleEdges {
  Segments halving, diagonals;
};
TriangleEdges triangle_edges_of(const Model &model, std::int32_t leaflet);

// Curves as lists of their pieces, each beginning where the one before ends.
using Pieces = std::vector<Bezier>;

Pieces placed(const PatchSet &set, const Side &side, const PatchImage &image);
Pieces reversed(Pieces pieces);
// Parts that a curve was cut into are put together again; what were pieces of their own stays so.
Pieces joined(const Pieces &pieces);
Points samples(const Pieces &pieces);
std::vector<Points> control_polygons(const Pieces &pieces);
// Every control point once: the ends that two pieces share count as one, as does the end of a closed curve.
Points control_points(const Pieces &pieces);

// The polylines that a patch's grid was made of, in the order v0, v1, u0, u1, before any image is put in place; a
// collapsed side is a single point. Of a grid's boundary points these are the ones on the curve.
struct BoundaryPolyline {
  Points points;
  std::vector<double> t;
};
std::array<BoundaryPolyline, 4> boundary_polylines(const PatchSet &set, const Patch &patch, const QuadGrid &grid);

// The curves by which the paper defines half a cusp, put together again where the bending curve cuts them.
struct CuspCurves {
  std::array<Pieces, 2> leaflet, bending, sinus;  // and mirrored
  Pieces symmetry;
};
CuspCurves cusp_curves(const PatchSet &set, std::int32_t cusp);

// The annulus once around from the posterior point, and the free edges from one commissure to the other.
struct MitralCurves {
  Pieces annulus, anterior, posterior;
};
MitralCurves mitral_curves(const PatchSet &set);

void append(Points &to, const Points &from);

}  // namespace riis::figures
