// SPDX-License-Identifier: Apache-2.0
// Turns patches into grids of quads (paper, 3.3 "Surface structure", and the appendix, "Leaflet surfaces").
// In: boundary polylines that meet at their ends. Out: grid points at the union of their parameters.
#pragma once

#include <cstddef>

#include "base/recycled.hpp"
#include "geometry/bulge.hpp"
#include "geometry/polyline.hpp"

namespace riis {

// The sides of a patch have the name of the parameter that is constant on them. side_v0 and side_v1 run with u, side_u0
// and side_u1 run with v. A collapsed side has length 0.
struct PatchSides {
  const Polyline *side_v0, *side_v1, *side_u0, *side_u1;
};

// A line of the grid. Vertices of two opposite sides share a line if they nearly coincide in parameter, and each side
// keeps its own vertex. So there are no sliver quads, and no vertex of a shared curve is lost or moved: neighbouring
// patches stay without cracks.
struct GridLine {
  double t0, t1;                                // parameter on the first and the second side that the line ends on
  double middle;                                // their mean: the line's u (or v)
  bool is_vertex0 = false, is_vertex1 = false;  // whether it ends on a vertex there
};

// Returns the union of two polylines' parameters. Values closer than merge_tolerance share a line. A polyline without
// length contributes none.
Vector<GridLine> merge_parameters(const Polyline &side0, const Polyline &side1, double merge_tolerance);

// The lines that a grid was made from.
struct GridLines {
  Vector<GridLine> u, v;
};

struct QuadGrid {
  Vector<double> u, v;    // ascending from 0 to 1
  Vector<Vec3> points;    // points[j * u.size() + i] at (u[i], v[j])
  Vector<double> errors;  // errors[j * (u.size() - 1) + i] of the quad between lines i, i + 1 and j, j + 1: a bound
                          // of its distance, at equal (u,v), from the patch between the exact curves

  GridLines lines{};  // that the grid was made from; empty unless requested

  const Vec3 &point(std::size_t i, std::size_t j) const { return points[j * u.size() + i]; }
  double error(std::size_t i, std::size_t j) const { return errors[j * (u.size() - 1) + i]; }
};

// Vectors on the four sides of a patch, one for each line of its grid that ends there.
struct SideVectors {
  Vector<Vec3> v0, v1;  // on the lines u
  Vector<Vec3> u0, u1;  // on the lines v; the first and the last are not read, because they are corners
};

// Returns the Coons combination of the sides' vectors, points or displacements, in the order of QuadGrid::points.
Vector<Vec3> coons_combination(const Vector<double> &u, const Vector<double> &v, const SideVectors &sides);

// Makes the Coons patch on the grid. It is bilinear inside every quad, so the grid loses nothing. Lines are merged if that moves
// a point by at most max_merge_shift along a side. Writes the lines to `lines` unless it is null.
QuadGrid make_quad_grid(const PatchSides &sides, double max_merge_shift, GridLines *lines = nullptr);
// Makes the grid on given lines, which end on vertices of the sides.
QuadGrid make_quad_grid(const PatchSides &sides, const GridLines &lines);

// A patch of arcs consists of the straight lines from side_v0, the base, to side_v1, the edge, plus 2 v (1-v) O(u)
// (geometry/bulge.hpp). It is made in two steps, because patches that share an arc must agree on the number of rows.
struct ArcLines {
  Vector<GridLine> u_lines;
  Vector<Vec3> offsets;   // O on each line
  Vector<double> errors;  // between each two lines: how far O may be from linear
  double largest_offset() const;
};

struct ArcLimits {
  double max_merge_shift, max_error;
  std::size_t max_lines;
};

// Returns the grid lines of the two sides, and more lines until O is within max_error of linear between them. Adds none
// once there are more than max_lines. offset_u0 and offset_u1 are O at the ends as the neighbours have it, to the last
// bit. Uses side_v0 and side_v1 only. Fails with RIIS_INVALID_PARAMETER if O has no direction.
ArcLines make_arc_lines(const PatchSides &sides, const Bulge &bulge, Vec3 offset_u0, Vec3 offset_u1,
                        const ArcLimits &limits);

// Makes rows of equal height h. An arc is at most |O| / 2 times h squared from its chords.
QuadGrid make_arc_grid(const PatchSides &sides, const ArcLines &lines, std::size_t n_rows);

// Returns the larger of two values, at `from` and at `to`, of the linear function that is at0 at 0 and at1 at 1.
double larger_mix(double at0, double at1, double from, double to);
// Returns the largest 2 v (1-v) from one v to another.
double largest_arc_weight(double from, double to);

// Returns the parameters of lines.
Vector<double> middles(const Vector<GridLine> &lines);

// Returns the lines of that grid.
GridLines lines_of_arc_grid(const ArcLines &lines, const QuadGrid &grid);

// Returns the index of the interval of ascending values that holds x. A value belongs to the interval behind it, and the upper
// end belongs to the last interval.
std::size_t interval_of(const Vector<double> &values, double x);

// Returns S(u,v) by bilinear interpolation inside the quad that holds (u,v) in [0,1]^2. (The paper prints u - u_o for
// the weight's numerator; it is u - u_{o-1}.)
Vec3 evaluate(const QuadGrid &grid, double u, double v);

}  // namespace riis
