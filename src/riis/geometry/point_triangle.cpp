// SPDX-License-Identifier: Apache-2.0
#include "geometry/point_triangle.hpp"

#include <cmath>
#include <limits>

namespace riis {
namespace {

struct Weights {
  double b, c;  // weights of the second and the third corner; the first has 1 - b - c
};

// Returns the weights of the foot of the perpendicular from a + r onto the triangle's plane. `n` is ab x ac.
Weights plane_weights(Vec3 r, Vec3 ab, Vec3 ac, Vec3 n, double inverse_nn) {
  return {dot(cross(r, ac), n) * inverse_nn, dot(cross(ab, r), n) * inverse_nn};
}

bool inside(Weights w) { return w.b >= 0 && w.c >= 0 && w.b + w.c <= 1; }

// Returns the parameter in [0, 1] of the point closest to a + r on the segment from a to a + edge.
double segment_parameter(Vec3 r, Vec3 edge) {
  const double t = dot(r, edge) / dot(edge, edge);
  return t > 0 ? (t < 1 ? t : 1.0) : 0.0;
}

}  // namespace

PointOnTriangle closest_point_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, bc = c - b, ap = p - a, bp = p - b;
  const double t_ab = segment_parameter(ap, ab), t_ac = segment_parameter(ap, ac), t_bc = segment_parameter(bp, bc);

  PointOnTriangle best{};
  best.distance_sq = std::numeric_limits<double>::infinity();
  const auto offer = [&](Vec3 point, double weight_a, double weight_b, double weight_c) {
    const Vec3 difference = p - point;
    const double distance_sq = dot(difference, difference);
    if (distance_sq < best.distance_sq) best = {distance_sq, point, {weight_a, weight_b, weight_c}};
  };
  // If the parameter is limited to an end, the result is the corner itself. All triangles with this corner thus give the distance
  // with the same bits.
  const auto on_edge = [](Vec3 first, Vec3 edge, Vec3 last, double t) { return t == 1.0 ? last : first + t * edge; };
  offer(on_edge(a, ab, b, t_ab), 1 - t_ab, t_ab, 0);
  offer(on_edge(b, bc, c, t_bc), 0, 1 - t_bc, t_bc);
  offer(on_edge(a, ac, c, t_ac), 1 - t_ac, 0, t_ac);

  const Vec3 n = cross(ab, ac);
  const double inverse_nn = 1.0 / dot(n, n);
  Weights w = plane_weights(ap, ab, ac, n, inverse_nn);
  if (inside(w)) {
    // In a needle-shaped triangle, the weights have an error of about one rounding divided by the sine of the smallest angle.
    // Each further step projects the vector that remains, and multiplies the error by this ratio. Other triangles need only the
    // first projection.
    for (int repeat = 0; repeat < 6; ++repeat) {
      const Weights rest = plane_weights(ap - (w.b * ab + w.c * ac), ab, ac, n, inverse_nn);
      const Weights refined{w.b + rest.b, w.c + rest.c};
      if (!inside(refined)) break;
      w = refined;
      if (std::abs(rest.b) + std::abs(rest.c) <= 0x1p-50) break;
    }
    offer(a + (w.b * ab + w.c * ac), 1 - (w.b + w.c), w.b, w.c);
  }
  return best;
}

}  // namespace riis
