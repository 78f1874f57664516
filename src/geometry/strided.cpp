// SPDX-License-Identifier: Apache-2.0
#include "geometry/strided.hpp"

#include <limits>

#include "base/errors.hpp"

namespace riis {

void check_points(const StridedPoints &points, const char *what, riis_status bad_coordinate) {
  require(points.x, "x");
  require(points.y, "y");
  require(points.z, "z");
  if (points.stride < 1)
    fail(RIIS_INVALID_ARGUMENT, "stride is %lld; it must be at least 1", static_cast<long long>(points.stride));
  if (points.n > std::numeric_limits<std::int64_t>::max() / 8 / points.stride)
    fail(RIIS_INVALID_ARGUMENT, "%lld %ss with a stride of %lld are more than memory can hold",
         static_cast<long long>(points.n), what, static_cast<long long>(points.stride));
  for (std::int64_t i = 0; i < points.n; ++i) {
    const Vec3 p = points[i];
    if (is_usable(p)) continue;
    const char *axis = !is_usable(p.x) ? "x" : !is_usable(p.y) ? "y" : "z";
    const double value = !is_usable(p.x) ? p.x : !is_usable(p.y) ? p.y : p.z;
    fail(bad_coordinate, "%s of %s %lld is %s; it must be finite and at most %s in magnitude", axis, what,
         static_cast<long long>(i), Number(value).text, Number(max_coordinate).text);
  }
}

}  // namespace riis
