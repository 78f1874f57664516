// SPDX-License-Identifier: Apache-2.0
#include "valve/cusp_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "geometry/placement.hpp"
#include "valve/coapting_half.hpp"
#include "valve/valve.hpp"

namespace riis {
namespace {

// An edge that is too short for open_radius_ratio opens less. It opens as far as an edge without sag that has `used_of_edge`
// times its length.
constexpr double used_of_edge = 0.97;
// An open edge whose height is at least `round_from` times the height of a circle's arc leaves the commissure like this arc.
constexpr double round_from = 0.7;
// The edges of three equal cusps are always round. Their half sectors are 60 degrees. The edge of another cusp becomes straighter
// as the cosine of its half sector moves away from the cosine of 60 degrees. If the cosines differ by `not_of_three` or more, the
// edge gets no roundness from its sector.
constexpr double not_of_three = 0.22;
// The attachment of a cusp whose sector exceeds `most_of_one_piece` degrees has two pieces, because one cubic would leave the
// cylinder.
constexpr double most_of_one_piece = 210;

std::array<double, 4> blend(const std::array<double, 4> &from, const std::array<double, 4> &to, double share) {
  std::array<double, 4> made{};
  for (std::size_t i = 0; i < made.size(); ++i) view(made)[i] = riis::blend(view(from)[i], view(to)[i], share);
  return made;
}

// Blends the numbers of two halves. Early in the motion, the leaflet becomes upright at the root and flatter beside the
// commissure. If all numbers were blended evenly, the leaflet would fold beside the attachment.
HalfNumbers blend(const HalfNumbers &a, const HalfNumbers &b, double opening) {
  const double early = opening * (2 - opening);
  const auto mixed = [&](double from, double to) { return riis::blend(from, to, opening); };
  return {mixed(a.root_radius, b.root_radius),
          riis::blend(a.commissure, b.commissure, opening),
          mixed(a.attachment_width, b.attachment_width),
          mixed(a.attachment_drop, b.attachment_drop),
          blend(a.edge_x, b.edge_x, opening),
          blend(a.edge_y, b.edge_y, opening),
          blend(a.sag, b.sag, early),
          mixed(a.edge_top, b.edge_top),
          mixed(a.edge_length, b.edge_length),
          mixed(a.band, b.band),
          mixed(a.band_lean, b.band_lean),
          riis::blend(a.belly_x, b.belly_x, early),
          mixed(a.belly_rise, b.belly_rise),
          mixed(a.band_start, b.band_start),
          a.attachment_arc,
          a.fused};
}

// Mixes the places of two states, with a share for each control point of the free edge. The share of the middle applies to all
// numbers of the symmetry plane, and the commissure has a separate share. `made` keeps its other numbers.
void mix_places(const HalfNumbers &closed, const HalfNumbers &open, const std::array<double, 4> &shares,
                HalfNumbers &made) {
  for (auto list : {&HalfNumbers::edge_x, &HalfNumbers::edge_y, &HalfNumbers::sag})
    for (std::size_t i = 0; i < shares.size(); ++i)
      view(made.*list)[i] = riis::blend(view(closed.*list)[i], view(open.*list)[i], view(shares)[i]);
  for (auto number : {&HalfNumbers::band, &HalfNumbers::band_lean, &HalfNumbers::belly_x, &HalfNumbers::belly_rise,
                      &HalfNumbers::band_start})
    made.*number = riis::blend(closed.*number, open.*number, shares.front());
  made.commissure = riis::blend(closed.commissure, open.commissure, shares.back());
}

// A cubic approximates an arc. Returns the distance, in radii, of the cubic's inner control points from its ends.
double arc_reach(double degrees) {
  const auto [sine, cosine] = sine_cosine_degrees(degrees / 4);
  return 4.0 / 3.0 * sine / cosine;
}

// The length of the start tangent, in radii, of an attachment that is a single cubic. With this length, the cubic's middle lies
// on the cylinder.
double tangent_on_cylinder(double sine, double cosine) {
  const double middle = (1 + cosine) / 2;
  return 8.0 / 3 * (std::sqrt(1 - middle * middle) - sine / 2);
}

// Returns the parameter at which y of a curve has this value. Along the curve, y ascends.
double parameter_at_y(const Bezier &curve, double y) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (evaluate(curve, middle).y < y ? low : high) = middle;
  }
  return low;
}

// Splits the closed half into a free part, which opens, and a fused part. The middle of the half's edge is at the height `low`.
// The free and the fused part meet in a vertical line of the zone.
void fuse(HalfNumbers &half, double fusion, double low) {
  const HalfCusp whole = coapting_half(half, half.edge_top - low, low).front();
  const auto [free, fused] = split(whole.leaflet, 1 - fusion);
  const double free_length = arc_length(free), share = free_length / (free_length + arc_length(fused));
  const auto lines = split(whole.bending, parameter_at_y(whole.bending, free.last().y));
  half.edge_top = free.last().z;
  for (std::size_t i = 0; i < half.sag.size(); ++i) {
    const Vec3 q = view(free.control)[i];
    view(half.edge_x)[i] = q.x, view(half.edge_y)[i] = q.y;
    view(half.sag)[i] = (half.edge_top - q.z) / (half.edge_top - low);
  }
  half.fused = FusedPart{fused, lines.second, half.commissure, share};
}

HalfNumbers closed_half(const CuspSizes &sizes, const CuspSizes::Side &side) {
  const double R = sizes.root_radius, Rc = sizes.commissure_radius, h = side.commissure_height;
  const double h_e = sizes.effective_height, z_k = h_e - sizes.coaptation_height;
  const Vec3 C{sizes.sector.cosine * Rc, sizes.sector.sine * Rc, h};
  // The edge lies in a vertical plane through the commissure. In the middle, its distance from the plane between the two cusps
  // is half the gap.
  const double sine_of_plane = sizes.meeting == 0 ? sizes.sector.sine : C.y / hypotenuse(C.x - sizes.meeting, C.y);
  const double x_in = sizes.meeting + 0.5 * sizes.gap / sine_of_plane;
  // The length of the tangent is limited, so that its end lies neither above half the height of the coaptation line nor beyond
  // the zone.
  const auto [sine, cosine] = sine_cosine_degrees(sizes.bottom_angle);
  double tangent = std::min(sizes.belly * R, sine > 0 ? 0.5 * z_k / sine : sizes.belly * R);
  if (sizes.meeting != 0) tangent = std::min(tangent, 0.9 * (R - x_in));
  const auto x = [&](double share) { return (1 - share) * x_in + share * sizes.sector.cosine * Rc; };
  HalfNumbers half{R,
                   C,
                   sizes.sector.attachment_factor * sizes.attachment_width * R,
                   sizes.attachment_drop * h,
                   {x_in, x(1.0 / 3), x(2.0 / 3), C.x},
                   {0, C.y / 3, C.y * 2 / 3, C.y},
                   {1, 1, 1 - sizes.edge_rise, 0},
                   h,
                   0,
                   sizes.coaptation_height / h_e,
                   0,
                   R - tangent * cosine,
                   tangent * sine / z_k,
                   0.5,
                   sizes.sector.arc};
  if (side.fusion > 0) fuse(half, side.fusion, h_e);
  half.edge_length = EdgeLength(half).at(half.edge_top - h_e).length;
  return half;
}

// Returns the numbers of the closed half with the free edge of the open half. Seen along the axis, the edge is round like an arc
// of a circle. An edge that is too short for an arc opens less. It leaves the commissure in a direction between the arc's
// direction and a straight line. For a fused edge, which is shorter than the arc, the straight line leads to the inner control
// point beside the middle.
HalfNumbers with_open_edge(const CuspSizes &sizes, const CuspSizes::Side &side, const HalfNumbers &closed,
                           double ratio) {
  const HalfSector &sector = sizes.sector;
  HalfNumbers half = closed;
  half.commissure = {(1 + sizes.commissure_expansion) * closed.commissure.x,
                     (1 + sizes.commissure_expansion) * closed.commissure.y, closed.commissure.z};
  Vec3 end = half.commissure;
  if (closed.fused) end = closed.fused->edge.first() + (half.commissure - closed.commissure);
  const double free = 1 - side.fusion;
  const double x_in = ratio * sizes.commissure_radius, reach = free * sector.arc_reach * sizes.commissure_radius;
  const double rise = (ratio - sector.cosine) / (1 - sector.cosine);
  const double as_of_three = closed.fused ? 0 : std::max(0.0, 1 - std::abs(sector.cosine - 0.5) / not_of_three);
  const double roundness =
      sizes.keeps_ratio ? 1 : free * std::max(as_of_three, std::clamp(rise / round_from, 0.0, 1.0));
  const Vec3 arc{sector.sine, -sector.cosine, 0}, chord{x_in - end.x, reach - end.y, 0};
  const Vec3 straight = closed.fused ? (1 / length(chord)) * chord : Vec3{0, -1, 0};
  const Vec3 to = mix(straight, arc, roundness);
  half.edge_x = {x_in, x_in, end.x + to.x * reach, end.x};
  half.edge_y = {0, reach, end.y + to.y * reach, end.y};
  half.sag = {1, 1, sizes.open_sag, 0};
  return half;
}

CuspNumbers with_open_edges(const CuspSizes &sizes, const CuspNumbers &closed, double ratio) {
  CuspNumbers made;
  for (std::size_t i = 0; i < closed.size(); ++i)
    made.push_back(with_open_edge(sizes, sizes.sides[i], closed[i], ratio));
  return made;
}

double total_length(const CuspNumbers &cusp) {
  double sum = 0;
  for (const HalfNumbers &half : cusp) sum += half.edge_length;
  return sum;
}

// Returns the largest ratio up to open_radius_ratio for which the edge is long enough.
double reached_ratio(const CuspSizes &sizes, const CuspNumbers &closed) {
  const double wanted = sizes.open_radius_ratio, most = used_of_edge * (1 + sizes.edge_stretch) * total_length(closed);
  const auto fits = [&](double ratio) { return least_edge_length(with_open_edges(sizes, closed, ratio)) <= most; };
  if (sizes.keeps_ratio || fits(wanted)) return wanted;
  double low = closed.front().edge_x[0] / sizes.commissure_radius, high = wanted;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

CuspNumbers closed_cusp(const CuspSizes &sizes) {
  CuspNumbers made;
  for (const CuspSizes::Side &side : sizes.sides) made.push_back(closed_half(sizes, side));
  return made;
}

// The symmetry curve is straight. The coaptation zone takes up the same share of the curve's length as in the closed state.
CuspNumbers open_cusp(const CuspSizes &sizes) {
  const CuspNumbers closed = closed_cusp(sizes);
  const double ratio = reached_ratio(sizes, closed);
  const double R = sizes.root_radius, h_e = sizes.effective_height, h_co = sizes.coaptation_height;
  const double x_in = ratio * sizes.commissure_radius;
  const Vec3 middle{closed.front().edge_x[0], 0, h_e - h_co};
  const double below = arc_length(symmetry_curve(closed.front(), middle, {0, 0, 1}));
  const double below_share = below / (below + h_co);
  CuspNumbers made = with_open_edges(sizes, closed, ratio);
  for (HalfNumbers &half : made) {
    half.edge_length = (1 + sizes.edge_stretch) * half.edge_length;
    half.band = 1 - below_share;
    half.band_lean = (1 - below_share) * (R - x_in);
    half.belly_x = R + (x_in - R) * below_share / 3;
    half.belly_rise = half.band_start = 1.0 / 3;
  }
  return made;
}

}  // namespace

HalfSector half_sector(double sector_degrees) {
  // For three equal cusps, the sine of 60 degrees is this root, rounded correctly.
  const double sine_60 = std::sqrt(0.75), on_cylinder_60 = tangent_on_cylinder(sine_60, 0.5);
  if (sector_degrees == 120) return {sine_60, 0.5, 4.0 / 3.0 * (2 - std::sqrt(3.0)), 1, std::nullopt};
  const auto [sine, cosine] = sine_cosine_degrees(sector_degrees / 2);
  HalfSector made{sine, cosine, arc_reach(sector_degrees / 2), tangent_on_cylinder(sine, cosine) / on_cylinder_60,
                  std::nullopt};
  if (sector_degrees > most_of_one_piece) {
    // The arc ends at the middle of the single cubic. From there the attachment continues with a cubic, which is built like the
    // single cubic of a narrower cusp.
    const double arc_cosine = (1 + cosine) / 2, arc_sine = std::sqrt(1 - arc_cosine * arc_cosine);
    const double on_cylinder =
        tangent_on_cylinder(sine * arc_cosine - cosine * arc_sine, cosine * arc_cosine + sine * arc_sine);
    made.attachment_factor = on_cylinder / on_cylinder_60;
    made.arc = AttachmentArc{arc_sine, arc_cosine, arc_reach(riis::arc_cosine(arc_cosine) / pi * 180) / on_cylinder};
  }
  return made;
}

CuspNumbers blend(const CuspNumbers &a, const CuspNumbers &b, double opening) {
  CuspNumbers made;
  for (std::size_t i = 0; i < a.size(); ++i) made.push_back(blend(a[i], b[i], opening));
  return made;
}

EdgeLength::EdgeLength(const HalfNumbers &half) {
  const auto slope = [](const std::array<double, 4> &q, double t) {
    const double s = 1 - t;
    return 3 * (s * s * (q[1] - q[0]) + 2 * s * t * (q[2] - q[1]) + t * t * (q[3] - q[2]));
  };
  for (std::size_t i = 0; i < n_nodes; ++i) {
    const Abscissa &node = gauss_4[i % gauss_4.size()];
    const double panel = static_cast<double>(i / gauss_4.size()), t = (panel + node.at) / n_panels;
    const double x = slope(half.edge_x, t), y = slope(half.edge_y, t), z = slope(half.sag, t);
    view(nodes_)[i] = {node.weight / n_panels, x * x + y * y, z * z};
  }
  chord_ = hypotenuse(half.edge_x[3] - half.edge_x[0], half.edge_y[3] - half.edge_y[0]);
}

EdgeLength::Value EdgeLength::at(double depth) const {
  Value value{0, 0};
  for (const Node &node : nodes_) {
    const double speed = std::sqrt(node.across + depth * depth * node.down);
    value.length += node.weight * speed;
    if (speed > 0) value.slope += node.weight * depth * node.down / speed;
  }
  return value;
}

// The length of the free edge is a convex function of its depth, and grows with the depth. Newton's method starts at a depth that
// is too large, so it descends to the solution and never passes it. At the starting depth, the straight line between the ends of
// one half alone is as long as the whole edge should be. A half is at least as long as its line, so this depth is large enough.
double edge_depth(const CuspNumbers &cusp) {
  Vector<EdgeLength> halves(cusp.begin(), cusp.end());
  const double wanted = total_length(cusp), first_top = cusp.front().edge_top;
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cusp.size(); ++i) {
    const double chord = halves[i].chord();
    const double alone = std::sqrt(std::max(0.0, wanted * wanted - chord * chord));
    depth = std::min(depth, alone - (cusp[i].edge_top - first_top));
  }
  for (int i = 0; i < 200; ++i) {
    EdgeLength::Value sum{0, 0};
    for (std::size_t k = 0; k < cusp.size(); ++k) {
      const auto [length, slope] = halves[k].at(depth + (cusp[k].edge_top - first_top));
      sum.length += length, sum.slope += slope;
    }
    if (!(sum.slope > 0)) break;
    const double next = depth - (sum.length - wanted) / sum.slope;
    if (!(next < depth)) break;
    depth = next;
  }
  return depth;
}

double least_edge_length(const CuspNumbers &cusp) {
  double lower_end = cusp.front().edge_top, sum = 0;
  for (const HalfNumbers &half : cusp) lower_end = std::min(lower_end, half.edge_top);
  for (const HalfNumbers &half : cusp) sum += EdgeLength(half).at(half.edge_top - lower_end).length;
  return sum;
}

double area_inside(const CuspNumbers &cusp) {
  double sum = 0;
  for (const HalfNumbers &half : cusp) {
    Bezier edge = Bezier::point({0, 0, 0});
    edge.degree = 3;
    for (std::size_t i = 0; i < 4; ++i) edge.control[i] = {half.edge_x[i], half.edge_y[i], 0};
    for (const auto &[at, weight] : gauss_4) sum += weight / 2 * cross(evaluate(edge, at), derivative(edge, at)).z;
  }
  return sum;
}

Bezier symmetry_curve(const HalfNumbers &half, Vec3 end, Vec3 up) {
  return Bezier::cubic({half.root_radius, 0, 0}, {half.belly_x, 0, half.belly_rise * end.z},
                       end - (half.band_start * end.z / up.z) * up, end);
}

EndStates end_states(const CuspSizes &closed, const CuspSizes &open) {
  const CuspNumbers from = closed_cusp(closed), to = open_cusp(open);
  EndStates made{from, to};
  for (std::size_t side = 0; side < from.size(); ++side) {
    std::array<double, 4> at_start{}, at_end{};
    for (std::size_t i = 0; i < at_start.size(); ++i) {
      view(at_start)[i] = view(closed.sides[side].local)[i].closed;
      view(at_end)[i] = view(open.sides[side].local)[i].open;
    }
    mix_places(from[side], to[side], at_start, made.closed[side]);
    mix_places(from[side], to[side], at_end, made.open[side]);
  }
  return made;
}

}  // namespace riis
