// SPDX-License-Identifier: Apache-2.0
#include "valve/coapting_half.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "common/array_view.hpp"
#include "common/elementary.hpp"

namespace riis {
namespace {

// The coaptation line is turned in `n_crease_steps` steps until no crease is left. Each step computes the crease at the ends of
// `n_crease_spans` parts of the line. The stiffness is the weight of the line's displacement in comparison with the crease. With
// these values the largest crease of random valves is below one degree.
constexpr int n_crease_steps = 2;
constexpr std::size_t n_crease_spans = 8;
constexpr double crease_stiffness = 0.03;

// A fused part that takes up at least the share `turned_from` of the edge has room for a parting curve without a crease at the
// coaptation line.
constexpr double turned_from = 0.3;

// Along the coaptation line K, the derivative of the lower patch with respect to v is T = K - c + (1 - u) Y + u A, with the chord
// c of K. Y and A are the end tangents of the symmetry curve and of the attachment, and are as long as these curves.
struct EndTangents {
  Vec3 of_symmetry, of_attachment;

  Vec3 at(double u) const { return mix(of_symmetry, of_attachment, u); }
};

// Returns the cubic from `first` to `last` that passes through these points at 1/3 and 2/3.
Bezier cubic_through(Vec3 first, Vec3 at_third, Vec3 at_two_thirds, Vec3 last) {
  constexpr double sixth = 1.0 / 6;
  return Bezier::cubic(first, sixth * (-5 * first + 18 * at_third - 9 * at_two_thirds + 2 * last),
                       sixth * (2 * first - 9 * at_third + 18 * at_two_thirds - 5 * last), last);
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

// Returns a first coaptation line below the free edge F. The derivative of the upper patch with respect to v is F - K. At the
// parameters 1/3 and 2/3 of both curves, F - K is T times a factor. The factor decreases from the middle to 0 at the commissure.
Bezier first_coaptation_line(const Bezier &free_edge, Vec3 middle, const EndTangents &tangents) {
  const double factor = distance(free_edge.first(), middle) / length(tangents.of_symmetry);
  const auto point = [&](double u) {
    const double w = (1 - u) * factor;
    const Vec3 hung = mix(middle, free_edge.last(), u) - tangents.at(u);
    return (1 / (1 + w)) * (evaluate(free_edge, u) + w * hung);
  };
  return cubic_through(middle, point(1.0 / 3), point(2.0 / 3), free_edge.last());
}

// Moves the inner control points of the coaptation line until the patches above and below the line have a common tangent plane.
// The crease is the sine of the angle between two planes: the plane of K' and T, and the plane of K' and F - K. The sine is
// computed at the ends of parts of K. A step linearizes the determinant of K', T and F - K. A patch joins the points of K and F
// at equal shares u of their lengths.
Bezier smoothed(Bezier line, const Bezier &free_edge, const EndTangents &tangents) {
  const double edge_length = arc_length(free_edge), chord = distance(line.first(), line.last());
  for (int step = 0; step < n_crease_steps; ++step) {
    std::array<double, n_crease_spans + 1> behind{};
    for (std::size_t i = 0; i < n_crease_spans; ++i) {
      view(behind)[i + 1] = view(behind)[i];
      for (const auto &[at, weight] : gauss_4)
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

Bezier moved(Bezier curve, Vec3 by) {
  for (Vec3 &q : curve.control) q = q + by;
  return curve;
}

// Returns the curve between the free and the fused part below the coaptation line. The curve is a mixture of the symmetry curve
// and the attachment. At its end, the curve has the direction of the zone's edge S, so that the leaflet has no crease there. In a
// fused part whose share is below `turned_from`, the curve turns less, because a larger turn would lead it out of this part and
// across the attachment.
Bezier parting_curve(const HalfCusp &half, const Bezier &attachment, double share, const Bezier &S) {
  const Vec3 first = half.symmetry_below.first(), last = S.first();
  const Vec3 off = last - mix(half.symmetry_below.last(), attachment.last(), share);
  const auto mixed = [&](std::size_t i) {
    return mix(view(half.symmetry_below.control)[i], view(attachment.control)[i], share) +
           (static_cast<double>(i * i) / 9) * off;
  };
  const Vec3 up = S.last() - last;
  const Vec3 without_crease = last - (distance(mixed(2), last) / length(up)) * up;
  return Bezier::cubic(first, mixed(1), mix(mixed(2), without_crease, std::min(1.0, (1 - share) / turned_from)), last);
}

// Gives the part its attachment. In a wide cusp, a single cubic would leave the cylinder. An arc therefore leads from the
// symmetry plane to a second piece. The second piece starts at the height of the single cubic's middle. The two pieces have the
// same direction where they meet.
void put_attachment(const HalfNumbers &numbers, const Bezier &one_piece, HalfCusp &part) {
  const Vec3 top = one_piece.last();
  part.sinus_below = one_piece;
  part.sinus_above = Bezier::point(top);
  if (!numbers.attachment_arc) return;
  const auto &[sine, cosine, reach] = *numbers.attachment_arc;
  const double R = numbers.root_radius, width = numbers.attachment_width, drop = numbers.attachment_drop;
  const double height = evaluate(one_piece, 0.5).z, share = height / top.z;
  const double radius = (1 - share) * R + share * hypotenuse(top.x, top.y);
  const Vec3 joint{radius * cosine, radius * sine, height};
  const Vec3 along{-sine * width, cosine * width, (2 * top.z - drop) / 8};
  part.sinus_start = Bezier::cubic(one_piece.first(), {R, reach * width, 0}, joint - reach * along, joint);
  part.sinus_below = Bezier::cubic(joint, joint + along, top - Vec3{0, 0, drop / 2}, top);
}

double length_of_sinus(const HalfCusp &part) {
  return (part.sinus_start ? arc_length(*part.sinus_start) : 0) + arc_length(part.sinus_below);
}

// Returns the least rise of a part. K is the coaptation line, c is its chord, and Y and A are the tangents at the root. At the
// root, the lower patch has the tangent K - c + (1 - u) Y + u A. The rise is this tangent's height divided by 1 - u and by the
// length of Y.
double rise_of_part(const HalfCusp &part) {
  const Bezier &line = part.bending, &symmetry = part.symmetry_below;
  const auto start = [](const Bezier &curve) {
    const Vec3 along = curve.control[1] - curve.control[0];
    return along.z / length(along);
  };
  const double of_symmetry = start(symmetry), symmetry_length = arc_length(symmetry);
  const double of_other_side = start(part.sinus_start.value_or(part.sinus_below)) * length_of_sinus(part);
  static constexpr std::array<double, 5> shares{0.5, 0.6, 0.7, 0.8, 0.9};
  const double line_length = arc_length(line);
  Vector<double> behind;
  for (const double u : shares) behind.push_back(u * line_length);
  std::array<double, shares.size()> t{};
  parameters_at_lengths(line, line_length, behind, t.data());
  double least = of_symmetry;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double u = view(shares)[i];
    const double sag = mix(line.first(), line.last(), u).z - evaluate(line, view(t)[i]).z - u * of_other_side;
    least = std::min(least, of_symmetry - sag / ((1 - u) * symmetry_length));
  }
  return least;
}

}  // namespace

Vector<HalfCusp> coapting_half(const HalfNumbers &numbers, double depth, double low) {
  const Vec3 top = numbers.commissure, moved_by = numbers.fused ? top - numbers.fused->commissure : Vec3{0, 0, 0};
  const auto on_edge = [&](std::size_t i) {
    return Vec3{view(numbers.edge_x)[i], view(numbers.edge_y)[i], numbers.edge_top - depth * view(numbers.sag)[i]};
  };
  HalfCusp half;
  half.leaflet =
      Bezier::cubic(on_edge(0), on_edge(1), on_edge(2), numbers.fused ? numbers.fused->edge.first() + moved_by : top);
  const Vec3 middle{half.leaflet.first().x + numbers.band_lean, 0, (1 - numbers.band) * low};
  const Vec3 up = half.leaflet.first() - middle;
  half.symmetry_below = symmetry_curve(numbers, middle, up);
  half.symmetry_above = Bezier::line(middle, half.leaflet.first());
  const double R = numbers.root_radius;
  const Bezier attachment =
      Bezier::cubic({R, 0, 0}, {R, numbers.attachment_width, 0}, top - Vec3{0, 0, numbers.attachment_drop}, top);
  const Vec3 end_of_symmetry = (arc_length(half.symmetry_below) / length(up)) * up;
  if (!numbers.fused) {
    put_attachment(numbers, attachment, half);
    const EndTangents tangents{end_of_symmetry, {0, 0, length_of_sinus(half)}};
    half.bending = smoothed(first_coaptation_line(half.leaflet, middle, tangents), half.leaflet, tangents);
    return {half};
  }
  HalfCusp fused;
  fused.leaflet = moved(numbers.fused->edge, moved_by);
  fused.bending = moved(numbers.fused->line, moved_by);
  fused.leaflet.control[3] = fused.bending.control[3] = top;
  const Vec3 end = fused.bending.first(), up_there = fused.leaflet.first() - end;
  half.sinus_above = fused.symmetry_above = Bezier::line(end, fused.leaflet.first());
  half.sinus_below = fused.symmetry_below = parting_curve(half, attachment, numbers.fused->share, fused.symmetry_above);
  put_attachment(numbers, attachment, fused);
  const auto point = [&](double u) { return evaluate(half.leaflet, u) - mix(up, up_there, u); };
  const EndTangents tangents{end_of_symmetry, (arc_length(half.sinus_below) / length(up_there)) * up_there};
  half.bending = smoothed(cubic_through(middle, point(1.0 / 3), point(2.0 / 3), end), half.leaflet, tangents);
  return {half, fused};
}

double rise_at_root(const Vector<HalfCusp> &parts) {
  const double least = rise_of_part(parts.front());
  if (parts.size() == 1) return least;
  // The curve between the free and the fused part rises less than the symmetry curve, because it is nearer to the commissure.
  const double free = arc_length(parts[0].leaflet), fused = arc_length(parts[1].leaflet);
  const double expected = fused / (free + fused) * arc_length(parts[0].symmetry_below);
  return std::min(least, rise_of_part(parts[1]) * arc_length(parts[1].symmetry_below) / expected);
}

}  // namespace riis
