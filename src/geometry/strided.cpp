// SPDX-License-Identifier: Apache-2.0
#include "geometry/strided.hpp"

#include <limits>

#include "base/errors.hpp"

namespace riis {

void check_points(const StridedPoints &points, const char *what, riis_status bad_coordinate) {
  require(points.x, "x");
  require(points.y, "y");
  require(points.z, "z");
  if (points.stride < 1) fail(RIIS_INVALID_ARGUMENT, "stride is ", points.stride, "; it must be at least 1");
  if (points.n > std::numeric_limits<std::int64_t>::max() / 8 / points.stride)
    fail(RIIS_INVALID_ARGUMENT, points.n, " ", what, "s with a stride of ", points.stride,
         " are more than memory can hold");
  for (std::int64_t i = 0; i < points.n; ++i) {
    const Vec3 p = points[i];
    if (is_usable(p)) continue;
    const char *axis = !is_usable(p.x) ? "x" : !is_usable(p.y) ? "y" : "z";
    const double value = !is_usable(p.x) ? p.x : !is_usable(p.y) ? p.y : p.z;
    fail(bad_coordinate, axis, " of ", what, " ", i, " is ", value, "; it must be finite and at most ", max_coordinate,
         " in magnitude");
  }
}

}  // namespace riis
