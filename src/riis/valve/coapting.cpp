// SPDX-License-Identifier: Apache-2.0
// The coapting valve. Its three equal cusps lie side by side in a coaptation zone, and their free edges keep their length while
// the valve opens (docs/theory/coapting.md).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "geometry/placement.hpp"
#include "valve/cusp.hpp"
#include "valve/valve.hpp"

namespace riis {
namespace {

// Positions in the list of specs below.
// clang-format off
enum Parameter {
  root_radius, commissure_radius, commissure_height, effective_height, coaptation_height, gap, bottom_angle, belly, edge_rise,
  attachment_width, attachment_drop, open_radius_ratio, commissure_expansion, translation, opening
};
// clang-format on

// The angle from a cusp's symmetry plane to its commissures is 60 degrees.
const double sine_60 = std::sqrt(0.75);
constexpr double cosine_60 = 0.5;

// The distance of the inner control points from the ends of a cubic that approximates an arc of 60 degrees of a circle, in radii.
const double arc_reach = 4.0 / 3.0 * (2 - std::sqrt(3.0));  // 4/3 tan 15 degrees
// The open free edge: how far the inner control point by the commissure hangs, as a share of the middle.
constexpr double open_sag = 1.0 / 3;
// If an open free edge does not hang, it must be shorter than this share of the closed free edge.
constexpr double most_of_edge = 0.998;
// The free edge must stay this high above the root while the valve opens, times root_radius.
constexpr double least_height = 0.05;
// At these openings, the cusps of every set of values are checked for folds, because folds arise in the second half of the
// motion.
constexpr std::array<double, 4> openings_of_folds{0.6, 0.75, 0.9, 1};
// At the root, the leaflet must rise by this share of the rise of a leaflet without sag.
constexpr double least_rise = 0.05;
// The rates of the control points are differences over this step of the opening. The rates only determine where vertices are
// dense.
constexpr double rate_step = 1e-4;

// The coaptation line is turned in n_crease_steps steps until no crease is left. Each step computes the crease at the ends of
// n_crease_spans spans. The stiffness is the weight of the line's displacement against the crease. With these values the largest
// crease of random valves is below one degree.
constexpr int n_crease_steps = 2;
constexpr std::size_t n_crease_spans = 8;
constexpr double crease_stiffness = 0.03;

// The Gauss-Legendre rule with 4 points on [0, 1].
struct Abscissa {
  double at, weight;
};
constexpr std::array<Abscissa, 4> rule{{{0.06943184420297371239, 0.17392742256872692869},
                                        {0.33000947820757186760, 0.32607257743127307131},
                                        {0.66999052179242813240, 0.32607257743127307131},
                                        {0.93056815579702628761, 0.17392742256872692869}}};

// The rules of sizes that were not set.
using Rule = std::array<double, 3>;
Rule commissure_radius_rule(const ParameterValues &values) { return {values[root_radius][0]}; }
Rule commissure_height_rule(const ParameterValues &values) { return {1.4 * values[commissure_radius][0]}; }
// The line from the middle of a free edge to the commissure rises by 34 degrees, whose tangent is 0.6745.
Rule effective_height_rule(const ParameterValues &values) {
  const double h = values[commissure_height][0];
  return {std::max(h - 0.6745 * values[commissure_radius][0], 0.3 * h)};
}
// If the commissures are low, there is less room for the coaptation zone.
Rule coaptation_height_rule(const ParameterValues &values) {
  return {std::min(0.3 * values[commissure_radius][0], 0.6 * values[effective_height][0])};
}
Rule gap_rule(const ParameterValues &values) { return {0.016 * values[commissure_radius][0]}; }

void check_values(const ParameterValues &values);
PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening);

// Lengths are in centimetres. docs/theory/coapting.md has the sources of the values.
// clang-format off
ValveKind make_kind() {
  constexpr double shortest = 1e-9, longest = 1e9;
  const char *length = "length", *degree = "degree", *number = "1";
  ValveKind kind{"coapting", {
    {"root_radius", length, "radius of the root, where the cusps begin", 1, {1.25}, shortest, longest, {}, {"annulus", 2}},
    {"commissure_radius", length, "radius of the commissures", 1, {1.25}, shortest, longest,
     {"root_radius", commissure_radius_rule}, {"stj", 2}},
    {"commissure_height", length, "height of the commissures above the root", 1, {1.75}, shortest, longest,
     {"1.4 commissure_radius", commissure_height_rule}},
    {"effective_height", length, "height of the middle of the closed free edges above the root", 1, {1.75 - 0.6745 * 1.25},
     shortest, longest, {"commissure_height - 0.6745 commissure_radius, at least 0.3 commissure_height", effective_height_rule}},
    {"coaptation_height", length, "height of the coaptation zone in the middle of the closed valve", 1, {0.3 * 1.25}, shortest,
     longest, {"0.3 commissure_radius, at most 0.6 effective_height", coaptation_height_rule}},
    {"gap", length, "distance between closed cusps in the coaptation zone", 1, {0.016 * 1.25}, shortest, longest,
     {"0.016 commissure_radius", gap_rule}},
    {"bottom_angle", degree, "angle of the closed cusp to the root's plane, at the root", 1, {20}, 0, 80},
    {"belly", number, "start tangent of the closed symmetry curve, at most, times root_radius", 1, {0.5}, 0.05, 0.8},
    {"edge_rise", number, "closed free edge: rise of the inner control point by the commissure, times that of the whole edge",
     1, {0.3}, 0, 0.9},
    {"attachment_width", number, "start tangent of the attachment, times root_radius", 1, {0.6}, 0.1, 1.2},
    {"attachment_drop", number, "end tangent of the attachment, times commissure_height", 1, {0.5}, 0.1, 0.9},
    {"open_radius_ratio", number, "open state: radius of the free edge at the symmetry plane, times commissure_radius",
     1, {0.85}, 0.3, 1.1},
    {"commissure_expansion", number, "open state: how far the commissures move outwards, times commissure_radius",
     1, {0.05}, 0, 0.3},
    {"translation", length, "shift of the valve", 3, {0, 0, 0}, -longest, longest},
    opening_spec("0 closed to 1 open", 0),
  }, opening, true, check_values, make_patches, nullptr};
  kind.has_exact_contacts = true;
  return kind;
}
// clang-format on

// The numbers that change as half a cusp opens, y >= 0. They are blended, and the curves follow from them. Shares have the range
// 0 to 1. Control points are counted from the symmetry plane, or from the root.
struct CuspNumbers {
  double root_radius;
  Vec3 commissure;
  double attachment_width, attachment_drop;  // the lengths of the attachment's end tangents
  std::array<double, 4> edge_x, edge_y;      // the free edge, seen along the axis
  std::array<double, 4> sag;                 // how far control points of the free edge hang, as shares of the sag
  double edge_length;
  double band;        // height of the coaptation zone, as a share of the height of the free edge's middle
  double band_lean;   // in the middle, how much farther from the axis the coaptation line is than the free edge
  double belly_x;     // x of the first inner control point of the symmetry curve
  double belly_rise;  // height of that point, as a share of the height of the coaptation line's middle
  double band_start;  // height from the second inner control point to the coaptation line, as the same share
};

// Blends the numbers of two cusps. Early in the motion, the leaflet becomes upright at the root and flatter beside the
// commissure. Otherwise it would fold beside the attachment.
CuspNumbers blend(const CuspNumbers &a, const CuspNumbers &b, double opening) {
  const double early = opening * (2 - opening);
  const auto mixed = [&](double from, double to) { return riis::blend(from, to, opening); };
  const auto all = [](const std::array<double, 4> &from, const std::array<double, 4> &to, double share) {
    std::array<double, 4> made{};
    for (std::size_t i = 0; i < made.size(); ++i) view(made)[i] = riis::blend(view(from)[i], view(to)[i], share);
    return made;
  };
  return {mixed(a.root_radius, b.root_radius),
          riis::blend(a.commissure, b.commissure, opening),
          mixed(a.attachment_width, b.attachment_width),
          mixed(a.attachment_drop, b.attachment_drop),
          all(a.edge_x, b.edge_x, opening),
          all(a.edge_y, b.edge_y, opening),
          all(a.sag, b.sag, early),
          mixed(a.edge_length, b.edge_length),
          mixed(a.band, b.band),
          mixed(a.band_lean, b.band_lean),
          riis::blend(a.belly_x, b.belly_x, early),
          mixed(a.belly_rise, b.belly_rise),
          mixed(a.band_start, b.band_start)};
}

// The length of half a free edge as a function of how far its middle hangs below the commissure. A fixed quadrature rule
// computes it, so that it is a smooth function of the cusp.
class EdgeLength {
 public:
  explicit EdgeLength(const CuspNumbers &cusp) {
    const auto slope = [](const std::array<double, 4> &q, double t) {
      const double s = 1 - t;
      return 3 * (s * s * (q[1] - q[0]) + 2 * s * t * (q[2] - q[1]) + t * t * (q[3] - q[2]));
    };
    for (std::size_t i = 0; i < n_nodes; ++i) {
      const double panel = static_cast<double>(i / rule.size()), t = (panel + rule[i % rule.size()].at) / n_panels;
      const double x = slope(cusp.edge_x, t), y = slope(cusp.edge_y, t), z = slope(cusp.sag, t);
      view(nodes_)[i] = {rule[i % rule.size()].weight / n_panels, x * x + y * y, z * z};
    }
    chord_ = std::hypot(cusp.edge_x[3] - cusp.edge_x[0], cusp.edge_y[3] - cusp.edge_y[0]);
  }

  struct Value {
    double length, slope;  // the slope is the derivative by the depth
  };
  Value at(double depth) const {
    Value value{0, 0};
    for (const Node &node : nodes_) {
      const double speed = std::sqrt(node.across + depth * depth * node.down);
      value.length += node.weight * speed;
      if (speed > 0) value.slope += node.weight * depth * node.down / speed;
    }
    return value;
  }

  // Returns the depth at which the edge has this length. The length must be at least the length at depth 0. The length grows
  // with the depth, and it is convex. Newton's method starts at too large a depth. It therefore comes down to the solution
  // and never passes it. An edge is at least as long as the line between its ends, so the start depth is too large.
  double depth(double edge_length) const {
    double depth = std::sqrt(std::max(0.0, edge_length * edge_length - chord_ * chord_));
    for (int i = 0; i < 200; ++i) {
      const auto [length, slope] = at(depth);
      if (!(slope > 0)) break;
      const double next = depth - (length - edge_length) / slope;
      if (!(next < depth)) break;
      depth = next;
    }
    return depth;
  }

  double chord() const { return chord_; }

 private:
  struct Node {
    double weight, across, down;
  };
  static constexpr std::size_t n_panels = 16, n_nodes = n_panels * rule.size();
  std::array<Node, n_nodes> nodes_;
  double chord_;
};

CuspNumbers closed_cusp(const ParameterValues &values) {
  const auto value = [&](Parameter parameter) { return values[parameter][0]; };
  const double R = value(root_radius), Rc = value(commissure_radius), h = value(commissure_height);
  const double h_e = value(effective_height), z_k = h_e - value(coaptation_height);
  const auto [sine, cosine] = sine_cosine_degrees(value(bottom_angle));
  // The tangent becomes shorter if its end would otherwise lie above half the height of the coaptation line.
  const double tangent = std::min(value(belly) * R, sine > 0 ? 0.5 * z_k / sine : value(belly) * R);
  // The edge lies in a vertical plane through the commissure. In the middle, its distance from the plane between the two cusps
  // is half the gap.
  const double x_in = 0.5 * value(gap) / sine_60;
  const auto x = [&](double share) { return (1 - share) * x_in + share * cosine_60 * Rc; };
  CuspNumbers cusp{R,
                   {cosine_60 * Rc, sine_60 * Rc, h},
                   value(attachment_width) * R,
                   value(attachment_drop) * h,
                   {x_in, x(1.0 / 3), x(2.0 / 3), cosine_60 * Rc},
                   {0, sine_60 * Rc / 3, sine_60 * Rc * 2 / 3, sine_60 * Rc},
                   {1, 1, 1 - value(edge_rise), 0},
                   0,
                   value(coaptation_height) / h_e,
                   0,
                   R - tangent * cosine,
                   tangent * sine / z_k,
                   0.5};
  cusp.edge_length = EdgeLength(cusp).at(h - h_e).length;
  return cusp;
}

// Returns the lower part of the symmetry curve. It ends at `end`. Its direction there is `up`, the vector from `end` to the
// free edge.
Bezier symmetry_curve(const CuspNumbers &cusp, Vec3 end, Vec3 up) {
  return Bezier::cubic({cusp.root_radius, 0, 0}, {cusp.belly_x, 0, cusp.belly_rise * end.z},
                       end - (cusp.band_start * end.z / up.z) * up, end);
}

// The open free edge is round, like an arc of a circle seen along the axis. The symmetry curve is straight, and the coaptation
// zone has the same share of its length as in the closed state.
CuspNumbers open_cusp(const ParameterValues &values) {
  const auto value = [&](Parameter parameter) { return values[parameter][0]; };
  const CuspNumbers closed = closed_cusp(values);
  const double R = value(root_radius), Rc = value(commissure_radius), h = value(commissure_height);
  const double h_e = value(effective_height), h_co = value(coaptation_height);
  const double x_in = value(open_radius_ratio) * Rc, reach = arc_reach * Rc;
  const double below = arc_length(symmetry_curve(closed, {closed.edge_x[0], 0, h_e - h_co}, {0, 0, 1}));
  const double below_share = below / (below + h_co);
  const Vec3 commissure{(1 + value(commissure_expansion)) * closed.commissure.x,
                        (1 + value(commissure_expansion)) * closed.commissure.y, h};
  CuspNumbers cusp = closed;
  cusp.commissure = commissure;
  cusp.edge_x = {x_in, x_in, commissure.x + sine_60 * reach, commissure.x};
  cusp.edge_y = {0, reach, commissure.y - cosine_60 * reach, commissure.y};
  cusp.sag = {1, 1, open_sag, 0};
  cusp.band = 1 - below_share;
  cusp.band_lean = (1 - below_share) * (R - x_in);
  cusp.belly_x = R + (x_in - R) * below_share / 3;
  cusp.belly_rise = cusp.band_start = 1.0 / 3;
  return cusp;
}

// Returns the cubic from `first` to `last` that passes through these points at 1/3 and 2/3.
Bezier cubic_through(Vec3 first, Vec3 at_third, Vec3 at_two_thirds, Vec3 last) {
  constexpr double sixth = 1.0 / 6;
  return Bezier::cubic(first, sixth * (-5 * first + 18 * at_third - 9 * at_two_thirds + 2 * last),
                       sixth * (2 * first - 9 * at_third + 18 * at_two_thirds - 5 * last), last);
}

// Along the coaptation line K, the derivative of the lower patch by v is T = K - c + (1 - u) Y + u A, with the chord c of K. Y
// and A are the end tangents of the symmetry curve and of the attachment, and are as long as these curves.
struct EndTangents {
  Vec3 of_symmetry, of_attachment;

  Vec3 at(double u) const { return mix(of_symmetry, of_attachment, u); }
};

// Returns a first coaptation line below the free edge F. The derivative of the upper patch by v is F - K. At the parameters 1/3
// and 2/3 of both curves, F - K is T times a factor. The factor decreases from the middle to 0 at the commissure.
Bezier first_coaptation_line(const Bezier &free_edge, Vec3 middle, const EndTangents &tangents) {
  const double factor = distance(free_edge.first(), middle) / length(tangents.of_symmetry);
  const auto point = [&](double u) {
    const double w = (1 - u) * factor;
    const Vec3 hung = mix(middle, free_edge.last(), u) - tangents.at(u);
    return (1 / (1 + w)) * (evaluate(free_edge, u) + w * hung);
  };
  return cubic_through(middle, point(1.0 / 3), point(2.0 / 3), free_edge.last());
}

// Linear least squares for the displacements of the two inner control points of a line.
class Displacements {
 public:
  // Adds the square of residual + of_first . d1 + of_second . d2.
  void add(double residual, Vec3 of_first, Vec3 of_second) {
    const std::array<double, n> row{of_first.x, of_first.y, of_first.z, of_second.x, of_second.y, of_second.z};
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) view(view(matrix_)[i])[j] += view(row)[i] * view(row)[j];
      view(view(matrix_)[i])[n] -= view(row)[i] * residual;
    }
  }

  // Returns the d1 and d2 that minimise the sum of the squares plus weight (|d1|^2 + |d2|^2), with weight > 0. The matrix is
  // positive definite, so the elimination needs no pivots.
  std::array<Vec3, 2> solve(double weight) {
    for (std::size_t i = 0; i < n; ++i) view(view(matrix_)[i])[i] += weight;
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < n; ++i) {
        if (i == k) continue;
        const double factor = view(view(matrix_)[i])[k] / view(view(matrix_)[k])[k];
        for (std::size_t j = k; j <= n; ++j) view(view(matrix_)[i])[j] -= factor * view(view(matrix_)[k])[j];
      }
    const auto value = [&](std::size_t i) { return view(view(matrix_)[i])[n] / view(view(matrix_)[i])[i]; };
    return {Vec3{value(0), value(1), value(2)}, Vec3{value(3), value(4), value(5)}};
  }

 private:
  static constexpr std::size_t n = 6;
  std::array<std::array<double, n + 1>, n> matrix_{};  // the last column is the right side
};

// Moves the inner control points of the coaptation line, so that the two patches that meet in it have a common tangent plane.
// The crease is the sine of the angle between the planes of K' and T, and of K' and F - K. It is computed at the ends of spans of
// K. A step linearizes the determinant of K', T and F - K. Patches pair points of K and F at equal shares u of the lengths of
// both curves.
Bezier smoothed(Bezier line, const Bezier &free_edge, const EndTangents &tangents) {
  const double edge_length = arc_length(free_edge), chord = distance(line.first(), line.last());
  for (int step = 0; step < n_crease_steps; ++step) {
    std::array<double, n_crease_spans + 1> behind{};
    for (std::size_t i = 0; i < n_crease_spans; ++i) {
      view(behind)[i + 1] = view(behind)[i];
      for (const auto &[at, weight] : rule)
        view(behind)[i + 1] +=
            weight * length(derivative(line, (static_cast<double>(i) + at) / static_cast<double>(n_crease_spans)));
    }
    Vector<double> on_edge;
    for (std::size_t i = 1; i < n_crease_spans; ++i) on_edge.push_back(view(behind)[i] / behind.back() * edge_length);
    std::array<double, n_crease_spans> at_edge{};
    parameters_at_lengths(free_edge, edge_length, on_edge, at_edge.data());
    Displacements displacements;
    for (std::size_t i = 1; i < n_crease_spans; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(n_crease_spans), s = 1 - t;
      const double u = view(behind)[i] / behind.back();
      const Vec3 on_line = evaluate(line, t), along = derivative(line, t);
      const Vec3 below = on_line - mix(line.first(), line.last(), u) + tangents.at(u);
      const Vec3 above = evaluate(free_edge, view(at_edge)[i - 1]) - on_line;
      const Vec3 of_below = cross(along, below), of_above = cross(along, above), of_both = cross(below, above);
      const double size = length(of_below) * length(of_above) / length(along);
      if (!(size > 0)) continue;  // a patch without a tangent plane has no crease
      const auto by_control_point = [&](double weight, double slope) {
        return (1 / size) * (slope * of_both - weight * (of_below + of_above));
      };
      displacements.add(dot(of_below, above) / size, by_control_point(3 * s * s * t, 3 * s * (s - 2 * t)),
                        by_control_point(3 * s * t * t, 3 * t * (2 * s - t)));
    }
    const auto [first, second] = displacements.solve(crease_stiffness / (chord * chord));
    line.control[1] = line.control[1] + first;
    line.control[2] = line.control[2] + second;
  }
  return line;
}

HalfCusp half_cusp(const CuspNumbers &cusp) {
  const Vec3 top = cusp.commissure;
  const double depth = EdgeLength(cusp).depth(cusp.edge_length), low = top.z - depth;
  if (!(low >= least_height * cusp.root_radius))
    fail(RIIS_INVALID_PARAMETER, "as the valve opens, its free edge hangs down to the height ", low,
         " above the root; it must stay at least ", least_height, " times root_radius, which is ", cusp.root_radius,
         ", above the root: look at commissure_height, effective_height, and those of the open state");
  const auto on_edge = [&](std::size_t i) {
    return Vec3{view(cusp.edge_x)[i], view(cusp.edge_y)[i], top.z - depth * view(cusp.sag)[i]};
  };
  HalfCusp half;
  half.leaflet = Bezier::cubic(on_edge(0), on_edge(1), on_edge(2), top);
  const Vec3 middle{half.leaflet.first().x + cusp.band_lean, 0, (1 - cusp.band) * low};
  half.symmetry_below = symmetry_curve(cusp, middle, half.leaflet.first() - middle);
  half.symmetry_above = Bezier::line(middle, half.leaflet.first());
  const double R = cusp.root_radius;
  half.sinus_below =
      Bezier::cubic({R, 0, 0}, {R, cusp.attachment_width, 0}, top - Vec3{0, 0, cusp.attachment_drop}, top);
  half.sinus_above = Bezier::point(top);
  const Vec3 up = half.leaflet.first() - middle;
  const EndTangents tangents{(arc_length(half.symmetry_below) / length(up)) * up, {0, 0, arc_length(half.sinus_below)}};
  half.bending = smoothed(first_coaptation_line(half.leaflet, middle, tangents), half.leaflet, tangents);
  return half;
}

// Returns the derivatives of the control points by the opening, as a difference.
HalfCusp rate_at(const CuspNumbers &closed, const CuspNumbers &open, double at) {
  const double from = std::max(at - rate_step, 0.0), to = std::min(at + rate_step, 1.0);
  HalfCusp made = rate(half_cusp(blend(closed, open, from)), half_cusp(blend(closed, open, to)));
  for (Bezier *curve :
       {&made.leaflet, &made.bending, &made.sinus_below, &made.sinus_above, &made.symmetry_below, &made.symmetry_above})
    for (Vec3 &q : curve->control) q = (1 / (to - from)) * q;
  return made;
}

// Returns the least rise of the leaflet at the root, as a share of the length of its symmetry curve. K is the coaptation line, c
// is its chord, and Y and A are the tangents at the root. At the root, the lower patch has the tangent K - c + (1 - u) Y + u A.
// The rise is this tangent's height divided by 1 - u. If the rise is negative somewhere, the leaflet dips below its attachment
// and folds.
double rise_at_root(const HalfCusp &half) {
  const Bezier &line = half.bending, &symmetry = half.symmetry_below;
  const Vec3 start = symmetry.control[1] - symmetry.control[0];
  const double of_symmetry = start.z / length(start), symmetry_length = arc_length(symmetry);
  static constexpr std::array<double, 5> shares{0.5, 0.6, 0.7, 0.8, 0.9};
  const double line_length = arc_length(line);
  Vector<double> behind;
  for (const double u : shares) behind.push_back(u * line_length);
  std::array<double, shares.size()> t{};
  parameters_at_lengths(line, line_length, behind, t.data());
  double least = of_symmetry;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double u = view(shares)[i];
    const double sag = mix(line.first(), line.last(), u).z - evaluate(line, view(t)[i]).z;
    least = std::min(least, of_symmetry - sag / ((1 - u) * symmetry_length));
  }
  return least;
}

// Checks both states, because one set of values defines both.
void check_values(const ParameterValues &values) {
  const auto reference = [&](Parameter parameter) {
    return Reference{coapting_valve_kind().parameters[parameter].name.c_str(), values[parameter][0]};
  };
  const auto check = [&](Parameter parameter, Parameter unit, double least, double most) {
    check_ratio(coapting_valve_kind().parameters[parameter], values[parameter], reference(unit), least, most);
  };
  check(commissure_radius, root_radius, 0.5, 2);
  check(commissure_height, commissure_radius, 0.3, 5);
  check(effective_height, commissure_height, 0.1, 0.97);
  check(coaptation_height, effective_height, 0.02, 0.9);
  check(gap, commissure_radius, 0.002, 0.2);
  check(translation, root_radius, 0, 100);
  const CuspNumbers closed = closed_cusp(values), open = open_cusp(values);
  const double least_length = EdgeLength(open).at(0).length;
  if (!(least_length <= most_of_edge * open.edge_length))
    fail(RIIS_INVALID_PARAMETER, "half an open free edge is at least ", least_length,
         " long, but half a closed one is ", open.edge_length,
         " long, too short to open so far: look at effective_height, commissure_height, open_radius_ratio, "
         "commissure_expansion");
  // The middle of the edge is at least as far from a commissure as the symmetry plane is. So it never hangs deeper than this.
  const double away = sine_60 * values[commissure_radius][0];
  const double low = values[commissure_height][0] - std::sqrt(open.edge_length * open.edge_length - away * away);
  if (!(low >= least_height * values[root_radius][0]))
    fail(RIIS_INVALID_PARAMETER, "half a free edge is ", open.edge_length, " long and may hang down to the height ",
         low, " above the root while the valve opens; it must stay at least ", least_height,
         " times root_radius, which is ", values[root_radius][0],
         ", above the root: look at commissure_height, effective_height");
  for (const double opening : openings_of_folds)
    if (!(rise_at_root(half_cusp(blend(closed, open, opening))) >= least_rise))
      fail(RIIS_INVALID_PARAMETER, "a cusp would fold beside its attachment at opening ", opening,
           ", because its free edge hangs deep beside its height: edge_rise is ", values[edge_rise][0],
           ", effective_height ", values[effective_height][0], ", commissure_height ", values[commissure_height][0],
           "; higher values help");
}

PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening) {
  const CuspNumbers from = closed_cusp(closed.values), to = open_cusp(open.values);
  const Vec3 shift = riis::blend(vector_of(closed.values[translation]), vector_of(open.values[translation]), opening);
  PatchSet set;
  add_cusps(set, half_cusp(blend(from, to, opening)), rate_at(from, to, opening), equal_places(shift));
  // The cusps meet only at the commissures, where the side u1 of the top patch is one point.
  sew_equal_cusps(set, top_patch(set) - 1, SeamPlace::corner);
  sew_equal_cusps(set, top_patch(set), SeamPlace::side_u1);
  return set;
}

}  // namespace

const ValveKind &coapting_valve_kind() {
  // The kind is made when it is first used, and it is never destroyed. So it can be used during the whole life of the process.
  static const ValveKind &kind = *new ValveKind(with_skirt(make_kind(), SkirtAxis::of_cusp));
  return kind;
}

}  // namespace riis
