// SPDX-License-Identifier: Apache-2.0
// Turns patches into grids of quads (paper, 3.3 "Surface structure", and the appendix, "Leaflet surfaces"). The four sides of a
// patch are polylines that meet at their ends. The grid has a line at the parameter of every vertex of these sides.
#pragma once

#include <cstddef>

#include "base/recycled.hpp"
#include "geometry/bulge.hpp"
#include "geometry/curve.hpp"

namespace riis {

// Each side of a patch is named after the parameter that is constant on it. Thus side_v0 and side_v1 run along u, and side_u0 and
// side_u1 run along v. A collapsed side has length 0.
struct PatchSides {
  const Polyline *side_v0, *side_v1, *side_u0, *side_u1;
};

// A line of the grid. If the parameters of two vertices on opposite sides nearly agree, one line joins the vertices, so no sliver
// quads arise. Both vertices keep their places. Neighbouring patches therefore meet without cracks.
struct GridLine {
  double t0, t1;                                // the line's parameters on the first and the second of its two sides
  double middle;                                // the mean of t0 and t1, which is the line's u (or v) in the grid
  bool is_vertex0 = false, is_vertex1 = false;  // whether the line ends on a vertex of that side
};

// Returns the union of two polylines' parameters. Parameters closer than merge_tolerance share a line. A polyline without length
// contributes no parameters.
Vector<GridLine> merge_parameters(const Polyline &side0, const Polyline &side1, double merge_tolerance);

// The lines from which a grid was made.
struct GridLines {
  Vector<GridLine> u, v;
  bool move_with_joints = false;  // whether the lines u of a planned patch of arcs move with the joints of its base
};

struct QuadGrid {
  Vector<double> u, v;  // ascending from 0 to 1
  Vector<Vec3> points;  // points[j * u.size() + i] lies at (u[i], v[j])
  // errors[j * (u.size() - 1) + i] belongs to the quad between lines i, i + 1 and j, j + 1. An error bounds the distance, at
  // equal (u,v), between the quad and the patch of the exact curves.
  Vector<double> errors;

  GridLines lines{};  // the lines that the grid was made from; empty unless requested

  const Vec3 &point(std::size_t i, std::size_t j) const { return points[j * u.size() + i]; }
  double error(std::size_t i, std::size_t j) const { return errors[j * (u.size() - 1) + i]; }
};

// Vectors on the four sides of a patch, one for each end of a grid line.
struct SideVectors {
  Vector<Vec3> v0, v1;  // vectors at the ends of the lines u
  Vector<Vec3> u0, u1;  // vectors at the ends of the lines v; the first and the last, at corners, are not read
};

// Returns the Coons combination of vectors on the sides, which may be points or displacements. The result has the order of
// QuadGrid::points.
Vector<Vec3> coons_combination(const Vector<double> &u, const Vector<double> &v, const SideVectors &sides);

// Makes the grid of the Coons patch. The grid represents the patch exactly, because the patch is bilinear inside every quad. Two
// lines are merged unless this would move a point along a side by more than max_merge_shift. If `lines` is not null, also writes
// the grid's lines there.
QuadGrid make_quad_grid(const PatchSides &sides, double max_merge_shift, GridLines *lines = nullptr);
// Makes the grid on given lines, whose ends are vertices of the sides.
QuadGrid make_quad_grid(const PatchSides &sides, const GridLines &lines);

// A patch of arcs consists of the straight lines from side_v0, the base, to side_v1, the edge, plus 2 v (1-v) O(u)
// (geometry/bulge.hpp). Patches that share an arc must have equally many rows. The lines of all such patches are therefore made
// first, and their rows afterwards.
struct ArcLines {
  Vector<GridLine> u_lines;
  Vector<Vec3> offsets;   // O on each line
  Vector<double> errors;  // a bound on O's deviation from linear, for each pair of neighbouring lines
  double largest_offset() const;
};

struct ArcLimits {
  double max_merge_shift, max_error;
  std::size_t max_lines;
};

// Returns the grid lines of the two sides side_v0 and side_v1. Adds lines until O deviates from a linear function between
// neighbouring lines by at most max_error, or until there are more than max_lines. `offset_u0` and `offset_u1` are O at the two
// ends, with the same bits as in the neighbouring patches. If O has no direction, fails with RIIS_INVALID_PARAMETER.
ArcLines make_arc_lines(const PatchSides &sides, const Bulge &bulge, Vec3 offset_u0, Vec3 offset_u1,
                        const ArcLimits &limits);

// Makes the grid with n_rows rows of equal height h. The distance of an arc from its chords is at most |O| h^2 / 2.
QuadGrid make_arc_grid(const PatchSides &sides, const ArcLines &lines, std::size_t n_rows);

// Returns the larger of a linear function's values at `from` and `to`. The function's values at 0 and 1 are `at0` and `at1`.
double larger_mix(double at0, double at1, double from, double to);
// Returns the largest value of 2 v (1-v) between two values of v.
double largest_arc_weight(double from, double to);

// Returns the member `middle` of all lines.
Vector<double> middles(const Vector<GridLine> &lines);

// Returns the lines of the grid that make_arc_grid made from `lines`.
GridLines lines_of_arc_grid(const ArcLines &lines, const QuadGrid &grid);

// Returns the index of the interval that holds x, between ascending values. An x that equals a value belongs to the interval
// after that value. An x at the upper end of the range belongs to the last interval.
std::size_t interval_of(const Vector<double> &values, double x);

// Returns S(u,v) by bilinear interpolation inside the quad that holds (u,v) in [0,1]^2. (The paper prints u - u_o as the
// numerator of the weight. The right numerator is u - u_{o-1}.)
Vec3 evaluate(const QuadGrid &grid, double u, double v);

}  // namespace riis
