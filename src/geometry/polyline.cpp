// SPDX-License-Identifier: Apache-2.0
#include "geometry/polyline.hpp"

#include <algorithm>

namespace riis {

namespace {

// The polyline of consecutive points with the lengths and errors of the pieces between them.
Polyline from_pieces(const std::vector<Vec3> &points, const std::vector<double> &lengths,
                     const std::vector<double> &errors) {
  Polyline polyline{{points.front()}, {0.0}, {}, 0.0};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    // A step too short to change the sum would repeat a t.
    if (!(polyline.length + lengths[i] > polyline.length)) continue;
    polyline.length += lengths[i];
    polyline.points.push_back(points[i + 1]);
    polyline.t.push_back(polyline.length);
    polyline.errors.push_back(errors[i]);
  }
  if (polyline.length > 0) {
    // The end point is the curve's, whatever step was dropped before it: neighbours share it.
    polyline.points.back() = points.back();
    for (double &t : polyline.t) t /= polyline.length;
  }
  return polyline;
}

}  // namespace

Polyline make_polyline(const std::vector<Vec3> &points) {
  std::vector<double> lengths;
  for (std::size_t i = 1; i < points.size(); ++i) lengths.push_back(distance(points[i - 1], points[i]));
  return from_pieces(points, lengths, std::vector<double>(lengths.size(), 0.0));
}

Polyline make_polyline(const Bezier &curve, double max_error) {
  const Flattened flattened = flatten(curve, max_error);
  return from_pieces(flattened.points, flattened.lengths, flattened.errors);
}

Vec3 evaluate(const Polyline &polyline, double t) {
  const auto after = std::upper_bound(polyline.t.begin(), polyline.t.end(), t);
  if (after == polyline.t.end()) return polyline.points.back();
  if (after == polyline.t.begin()) return polyline.points.front();
  const auto i = static_cast<std::size_t>(after - polyline.t.begin());
  const double t0 = polyline.t[i - 1], t1 = polyline.t[i];
  return mix(polyline.points[i - 1], polyline.points[i], (t - t0) / (t1 - t0));
}

}  // namespace riis
