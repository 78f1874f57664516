// SPDX-License-Identifier: Apache-2.0
#include "geometry/polyline.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "common/array_view.hpp"

namespace riis {

Polyline make_polyline(const Vector<Vec3> &points) {
  Polyline polyline{{points.front()}, {0.0}, {}, 0.0};
  for (const Vec3 &point : points) {
    const double step = distance(polyline.points.back(), point);
    // A step too short to change the sum is dropped, because it would give two points the same t.
    if (!(polyline.length + step > polyline.length)) continue;
    polyline.length += step;
    polyline.points.push_back(point);
    polyline.t.push_back(polyline.length);
    polyline.errors.push_back(0.0);
  }
  if (polyline.length > 0) {
    // The last point is always the given one, even if the step to it was dropped, because neighbours share it.
    polyline.points.back() = points.back();
    for (double &t : polyline.t) t /= polyline.length;
  }
  return polyline;
}

namespace {

Polyline polyline_of(Flattened flattened, const Curve &curve) {
  return {std::move(flattened.points), std::move(flattened.t), std::move(flattened.errors), curve.length()};
}

}  // namespace

Polyline make_polyline(const Curve &curve, double max_error) { return polyline_of(flatten(curve, max_error), curve); }

Polyline make_polyline(const Curve &curve, double max_error, const Bezier &velocity, double max_bend) {
  if (!(curve.length() > 0)) return make_polyline(curve, max_error);
  const VelocityBend bend(curve.spans().front(), curve.length(), velocity);
  return polyline_of(flatten(curve, max_error, &bend, max_bend), curve);
}

Polyline reversed(const Polyline &polyline) {
  Polyline turned{{polyline.points.rbegin(), polyline.points.rend()},
                  {polyline.t.rbegin(), polyline.t.rend()},
                  {polyline.errors.rbegin(), polyline.errors.rend()},
                  polyline.length};
  if (polyline.length > 0)
    for (double &t : turned.t) t = 1 - t;
  return turned;
}

Vec3 evaluate(const Polyline &polyline, double t) {
  const auto after = std::upper_bound(polyline.t.begin(), polyline.t.end(), t);
  if (after == polyline.t.end()) return polyline.points.back();
  if (after == polyline.t.begin()) return polyline.points.front();
  const std::int64_t i = after - polyline.t.begin();
  const double t0 = view(polyline.t)[i - 1], t1 = view(polyline.t)[i];
  return mix(view(polyline.points)[i - 1], view(polyline.points)[i], (t - t0) / (t1 - t0));
}

}  // namespace riis
