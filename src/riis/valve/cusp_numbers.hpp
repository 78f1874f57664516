// SPDX-License-Identifier: Apache-2.0
// The numbers that change as a coapting cusp opens, and the length of its free edge (docs/theory/coapting.md). This file computes
// the numbers from the sizes of a cusp, in the closed state, in the open state and between them. It also finds the depth of the
// free edge.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/recycled.hpp"
#include "geometry/bezier.hpp"
#include "valve/bumps.hpp"

namespace riis {

// The Gauss-Legendre rule with 4 points on [0, 1].
struct Abscissa {
  double at, weight;
};
inline constexpr std::array<Abscissa, 4> gauss_4{{{0.06943184420297371239, 0.17392742256872692869},
                                                  {0.33000947820757186760, 0.32607257743127307131},
                                                  {0.66999052179242813240, 0.32607257743127307131},
                                                  {0.93056815579702628761, 0.17392742256872692869}}};

// The arc with which the attachment of a wide cusp begins at the symmetry plane. Its angle is given by sine and cosine.
struct AttachmentArc {
  double sine, cosine;
  double reach;  // the length of its end tangents, divided by the second piece's start tangent
};

// The range of a cusp's sector in degrees.
inline constexpr double least_sector = 50, most_sector = 240;

// Half of a cusp's sector: the angle theta from its symmetry plane to a commissure.
struct HalfSector {
  double sine, cosine;
  // A cubic approximates an arc of theta. This is the distance, in radii, of its inner control points from its ends.
  double arc_reach;
  double attachment_factor;  // factor of the attachment's start tangent, to keep the curve's middle on the cylinder
  std::optional<AttachmentArc> arc;
};
HalfSector half_sector(double sector_degrees);

// The open_sag of cusps that are far from a fold.
inline constexpr double usual_open_sag = 1.0 / 3;

// The sizes of a cusp. Lengths are the parameters with the same names.
struct CuspSizes {
  HalfSector sector;
  double root_radius, commissure_radius, effective_height, coaptation_height, gap, bottom_angle, belly, edge_rise;
  double attachment_width, attachment_drop, open_radius_ratio, commissure_expansion, edge_stretch;
  double meeting;  // x of the point in which the planes between closed neighbours meet
  // True for one of three equal cusps. Equal cusps open to open_radius_ratio, whatever the shape and length of their edge. The
  // edges of other cusps open as far as their length allows.
  bool keeps_ratio;
  struct Side {
    double commissure_height, fusion;
    std::array<LocalOpening, 4> local;  // at the control points of the free edge, from the middle
  };
  Vector<Side> sides;  // the sides y >= 0 and y < 0, or one side for both
  // The depth at which the inner control points of the open free edge beside the commissures hang, as a share of the depth of the
  // middle.
  double open_sag = usual_open_sag;
};

// The part of half a cusp that is fused to the neighbour and stays as in the closed valve. The fused edge leads from the end of
// the free edge to the commissure. The coaptation line begins below the end of the free edge.
struct FusedPart {
  Bezier edge, line;
  Vec3 commissure;  // the commissure of the closed valve
  double share;     // the length of the free part, as a share of the closed edge's length
};

// The numbers of half a cusp, y >= 0. During the motion these numbers are blended, and the curves are computed from them. Shares
// have the range 0 to 1. Control points are counted from the symmetry plane, or from the root.
struct HalfNumbers {
  double root_radius;
  Vec3 commissure;
  double attachment_width, attachment_drop;  // lengths of the end tangents, for the attachment or its second piece
  std::array<double, 4> edge_x, edge_y;      // the free edge, seen along the axis
  std::array<double, 4> sag;                 // how far control points of the free edge hang, as shares of the sag
  double edge_top;                           // height of the free edge's end
  double edge_length;
  double band;        // height of the coaptation zone, as a share of the height of the free edge's middle
  double band_lean;   // in the middle, how much farther from the axis the coaptation line is than the free edge
  double belly_x;     // x of the first inner control point of the symmetry curve
  double belly_rise;  // height of that point, as a share of the height of the coaptation line's middle
  double band_start;  // height of the coaptation line above the second inner control point, as such a share
  std::optional<AttachmentArc> attachment_arc = {};
  std::optional<FusedPart> fused = {};
};

// The halves of a cusp, in the order of its sides. They meet at the cusp's middle.
using CuspNumbers = Vector<HalfNumbers>;

// Blends the numbers of two states.
CuspNumbers blend(const CuspNumbers &a, const CuspNumbers &b, double opening);

// The length of half a free edge. It depends on how far the edge's middle hangs below its end. A fixed quadrature rule computes
// this length, so the length is a smooth function of the cusp's sizes.
class EdgeLength {
 public:
  explicit EdgeLength(const HalfNumbers &half);

  struct Value {
    double length, slope;  // the slope is the derivative by the depth
  };
  Value at(double depth) const;
  double chord() const { return chord_; }

 private:
  struct Node {
    double weight, across, down;
  };
  static constexpr std::size_t n_panels = 16, n_nodes = n_panels * gauss_4.size();
  std::array<Node, n_nodes> nodes_;
  double chord_;
};

// Returns how far the middle of the free edge hangs below the end of the first half. At this depth, all halves together have
// their given length. The halves must be at least as long as at depth 0.
double edge_depth(const CuspNumbers &cusp);
// Returns the length of the free edge whose middle is as high as its lower end.
double least_edge_length(const CuspNumbers &cusp);

// Returns the area between the free edges of all halves and the axis, seen along the axis.
double area_inside(const CuspNumbers &cusp);

// Returns the lower part of the symmetry curve. The curve ends at `end`. At `end`, the curve has the direction `up`, the vector
// from `end` to the free edge.
Bezier symmetry_curve(const HalfNumbers &half, Vec3 end, Vec3 up);

// The states between which a cusp moves: its closed and its open state. At a bump, the end states lie between these two states.
struct EndStates {
  CuspNumbers closed, open;
};
// The closed state comes from the first sizes, and the open state from the second.
EndStates end_states(const CuspSizes &closed, const CuspSizes &open);

}  // namespace riis
