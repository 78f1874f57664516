// SPDX-License-Identifier: Apache-2.0
#include "geometry/strided.hpp"

#include <algorithm>
#include <limits>

#include "base/errors.hpp"

namespace riis {
namespace {

// Two doubles in one register, which are compared at once. Comparing one double at a time would take longer than reading the
// memory.
typedef double Two __attribute__((vector_size(16)));

struct Spread {
  Two lower = Two{} + Bounds::infinity, upper = Two{} - Bounds::infinity;
  void add(Two p) {
    lower = p < lower ? p : lower;
    upper = p > upper ? p : upper;
  }
};

// Takes two points at once, in three registers. These hold x and y of the first point, x and y of the second point, and z of
// both.
struct PairSpread {
  Spread xy[2], z;
  Two sum{};
  void add(Two first_xy, Two second_xy, Two both_z) {
    xy[0].add(first_xy);
    xy[1].add(second_xy);
    z.add(both_z);
    sum += first_xy + second_xy + both_z;
  }
  void give(Bounds &bounds, double &total) const {
    for (const Spread &s : xy) {
      bounds.lower = {std::min(bounds.lower.x, s.lower[0]), std::min(bounds.lower.y, s.lower[1]), bounds.lower.z};
      bounds.upper = {std::max(bounds.upper.x, s.upper[0]), std::max(bounds.upper.y, s.upper[1]), bounds.upper.z};
    }
    bounds.lower.z = std::min({bounds.lower.z, z.lower[0], z.lower[1]});
    bounds.upper.z = std::max({bounds.upper.z, z.upper[0], z.upper[1]});
    total += sum[0] + sum[1];
  }
};

// If a coordinate is NaN, `sum` becomes NaN and stays so. The comparisons for the bounds ignore NaN.
Bounds bounds_of(const StridedPoints &points, double &sum) {
  const double *const x = points.x, *const y = points.y, *const z = points.z;
  const std::int64_t stride = points.stride;
  // With two separate bounds, two comparisons can run at the same time. With one, each comparison would have to wait for the
  // previous one.
  PairSpread pairs[2];
  std::int64_t i = 0;
  for (; i + 4 <= points.n; i += 4)
    for (std::int64_t k = 0; k < 2; ++k) {
      const std::int64_t a = (i + 2 * k) * stride, b = a + stride;
      pairs[k].add(Two{x[a], y[a]}, Two{x[b], y[b]}, Two{z[a], z[b]});
    }
  Bounds bounds;
  if (i > 0)
    for (const PairSpread &pair : pairs) pair.give(bounds, sum);
  for (; i < points.n; ++i) {
    const Vec3 p = points[i];
    bounds.add(p);
    sum += p.x + p.y + p.z;
  }
  return bounds;
}

// Coordinates in single precision are rare, so one point at a time is fast enough.
Bounds bounds_of(const StridedReals<float> &points, double &sum) {
  Bounds bounds;
  for (std::int64_t i = 0; i < points.n; ++i) {
    const Vec3 p = points[i];
    bounds.add(p);
    sum += p.x + p.y + p.z;
  }
  return bounds;
}

template <class Points>
[[noreturn]] void refuse_first_unusable(const Points &points, const char *what, riis_status bad_coordinate) {
  for (std::int64_t i = 0; i < points.n; ++i) check_point(points, i, what, bad_coordinate);
  fail(bad_coordinate, "the coordinates of the ", what, "s changed while they were checked");
}

void require_array(const void *array, const char *prefix, const char *name) {
  if (!array) fail(RIIS_INVALID_ARGUMENT, prefix, name, " is NULL");
}

}  // namespace

template <class Real>
void check_point(const StridedReals<Real> &points, std::int64_t i, const char *what, riis_status bad_coordinate) {
  const Vec3 p = points[i];
  if (is_usable(p)) return;
  const char *axis = !is_usable(p.x) ? "x" : !is_usable(p.y) ? "y" : "z";
  const double value = !is_usable(p.x) ? p.x : !is_usable(p.y) ? p.y : p.z;
  fail(bad_coordinate, axis, " of ", what, " ", i, " is ", value, "; it must be finite and at most ", max_coordinate,
       " in magnitude");
}

template <class Real>
void check_pointers(const StridedReals<Real> &points, const char *what, const char *prefix) {
  require_array(points.x, prefix, "x");
  require_array(points.y, prefix, "y");
  require_array(points.z, prefix, "z");
  if (points.stride < 1) fail(RIIS_INVALID_ARGUMENT, prefix, "stride is ", points.stride, "; it must be at least 1");
  constexpr auto size = static_cast<std::int64_t>(sizeof(Real));
  if (points.n > std::numeric_limits<std::int64_t>::max() / size / points.stride)
    fail(RIIS_INVALID_ARGUMENT, points.n, " ", what, "s with a stride of ", points.stride,
         " are more than memory can hold");
  check_apart(points.n, {points.x, points.y, points.z}, points.stride, size, {prefix, {"x", "y", "z"}, "stride"});
}

void check_apart(std::int64_t n, const void *const (&components)[3], std::int64_t stride, std::int64_t size,
                 const ComponentNames &names, bool may_be_equal) {
  const auto address = [&](int c) { return reinterpret_cast<std::uintptr_t>(components[c]); };
  const auto step = static_cast<std::uintptr_t>(stride * size);
  if (n == 0) return;
  for (int a = 0; a < 2; ++a)
    for (int b = a + 1; b < 3; ++b) {
      const int early = address(a) <= address(b) ? a : b, late = a + b - early;
      const std::uintptr_t difference = address(late) - address(early);
      if (difference > 0 && (difference < step || difference > step * static_cast<std::uintptr_t>(n - 1))) continue;
      const auto numbers = static_cast<std::int64_t>(difference) / size;
      if (difference > 0)
        fail(RIIS_INVALID_ARGUMENT, names.prefix, names.names[late], " begins at number ", numbers, " of ",
             names.prefix, names.names[early], ", because ", names.prefix, names.stride, " is ", stride,
             stride == 1 && numbers < 3   ? "; the components of xyz(3,n) have the stride 3"
             : stride > 1 && numbers >= n ? "; separate arrays have the stride 1"
                                          : "; the components must not overlap");
      if (!may_be_equal)
        fail(RIIS_INVALID_ARGUMENT, names.prefix, names.names[late], " is the same array as ", names.prefix,
             names.names[early], "; each component needs its own array");
    }
}

template <class Real>
Bounds check_points(const StridedReals<Real> &points, const char *what, riis_status bad_coordinate,
                    const char *prefix) {
  check_pointers(points, what, prefix);
  double sum = 0;
  const Bounds bounds = bounds_of(points, sum);
  // Usable coordinates are at most max_coordinate, so their sum is finite.
  const bool usable = points.n == 0 || (is_usable(bounds.lower) && is_usable(bounds.upper) && std::isfinite(sum));
  if (!usable) refuse_first_unusable(points, what, bad_coordinate);
  return bounds;
}

template Bounds check_points(const StridedReals<double> &, const char *, riis_status, const char *);
template Bounds check_points(const StridedReals<float> &, const char *, riis_status, const char *);
template void check_pointers(const StridedReals<double> &, const char *, const char *);
template void check_pointers(const StridedReals<float> &, const char *, const char *);
template void check_point(const StridedReals<double> &, std::int64_t, const char *, riis_status);
template void check_point(const StridedReals<float> &, std::int64_t, const char *, riis_status);

}  // namespace riis
