// SPDX-License-Identifier: Apache-2.0
#include "valve/coaptation_line.hpp"

#include <array>
#include <cstddef>

#include "common/array_view.hpp"
#include "valve/cusp_numbers.hpp"

namespace riis {
namespace {

// The coaptation line is turned in n_crease_steps steps until no crease is left. Each step computes the crease at the ends of
// n_crease_spans spans. The stiffness is the weight of the line's displacement against the crease. With these values the largest
// crease of random valves is below one degree.
constexpr int n_crease_steps = 2;
constexpr std::size_t n_crease_spans = 8;
constexpr double crease_stiffness = 0.03;

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

}  // namespace

Bezier first_coaptation_line(const Bezier &free_edge, Vec3 middle, const EndTangents &tangents) {
  const double factor = distance(free_edge.first(), middle) / length(tangents.of_symmetry);
  const auto point = [&](double u) {
    const double w = (1 - u) * factor;
    const Vec3 hung = mix(middle, free_edge.last(), u) - tangents.at(u);
    return (1 / (1 + w)) * (evaluate(free_edge, u) + w * hung);
  };
  return cubic_through(middle, point(1.0 / 3), point(2.0 / 3), free_edge.last());
}

// The crease is the sine of the angle between the planes of K' and T, and of K' and F - K. It is computed at the ends of spans of
// K. A step linearizes the determinant of K', T and F - K. Patches pair points of K and F at equal shares u of the lengths of
// both curves.
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

}  // namespace riis
