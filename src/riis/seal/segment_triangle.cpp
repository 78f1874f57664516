// SPDX-License-Identifier: Apache-2.0
#include "seal/seal.hpp"

#include <algorithm>
#include <cmath>

#include "common/array_view.hpp"
#include "geometry/vec3.hpp"

namespace riis {
namespace {

// An exact number, stored as doubles whose sum it is. The doubles are not 0, do not overlap, and ascend in magnitude (Shewchuk,
// "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997). Sums and products are exact,
// because the range of the coordinates excludes overflow and underflow.
template <int capacity>
struct Exact {
  std::array<double, capacity> part;
  int n = 0;

  void append(double x) {
    if (x != 0) view(part)[n++] = x;
  }
  int sign() const { return n == 0 ? 0 : view(part)[n - 1] > 0 ? 1 : -1; }
};

struct TwoDoubles {
  double high, low;  // the sum of both numbers, rounded to double precision
};

TwoDoubles two_sum(double a, double b) {
  const double sum = a + b, b_in_sum = sum - a, a_in_sum = sum - b_in_sum;
  return {sum, (a - a_in_sum) + (b - b_in_sum)};
}

// Splits a double into two parts of at most 26 bits.
TwoDoubles split(double a) {
  const double c = 134217729.0 * a, high = c - (c - a);
  return {high, a - high};
}

TwoDoubles two_product(double a, double b) {
  const double product = a * b;
  const auto [a_high, a_low] = split(a);
  const auto [b_high, b_low] = split(b);
  return {product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)};
}

Exact<2> difference(double a, double b) {
  const auto [high, low] = two_sum(a, -b);
  Exact<2> made;
  made.append(low);
  made.append(high);
  return made;
}

// Adds the doubles of b one after another. Each pass writes at most as many parts as it has read, so it overwrites only parts
// that are no longer needed.
template <int n, int m>
Exact<n + m> operator+(const Exact<n> &a, const Exact<m> &b) {
  Exact<n + m> sum;
  std::copy_n(a.part.begin(), a.n, sum.part.begin());
  sum.n = a.n;
  for (int i = 0; i < b.n; ++i) {
    double carry = view(b.part)[i];
    const int n_before = sum.n;
    sum.n = 0;
    for (int k = 0; k < n_before; ++k) {
      const auto [high, low] = two_sum(carry, view(sum.part)[k]);
      sum.append(low);
      carry = high;
    }
    sum.append(carry);
  }
  return sum;
}

template <int n>
Exact<n> operator-(Exact<n> a) {
  for (int i = 0; i < a.n; ++i) view(a.part)[i] = -view(a.part)[i];
  return a;
}
template <int n, int m>
Exact<n + m> operator-(const Exact<n> &a, const Exact<m> &b) {
  return a + -b;
}

template <int n>
Exact<2 * n> scaled(const Exact<n> &a, double factor) {
  Exact<2 * n> made;
  double carry = 0;
  for (int i = 0; i < a.n; ++i) {
    const auto [high, low] = two_product(view(a.part)[i], factor);
    const auto [sum, rest] = two_sum(carry, low);
    made.append(rest);
    const auto [next, small] = two_sum(high, sum);
    made.append(small);
    carry = next;
  }
  made.append(carry);
  return made;
}

// Multiplies by a number of at most two parts. No other factors are needed.
template <int n>
Exact<4 * n> operator*(const Exact<n> &a, const Exact<2> &b) {
  Exact<4 * n> made;
  if (b.n == 0) return made;
  const Exact<2 *n> first = scaled(a, b.part[0]);
  if (b.n == 1) {
    std::copy_n(first.part.begin(), first.n, made.part.begin());
    made.n = first.n;
    return made;
  }
  return first + scaled(a, b.part[1]);
}

int sign(double x) { return (x > 0) - (x < 0); }

// Each coordinate is 0 or at least negligible_coordinate in magnitude. If a product of three differences of coordinates
// underflows, its error is therefore far below the constant `underflow`.
constexpr double underflow = 1e-290;

struct Point2 {
  double u, v;
};

int orientation_exactly(Point2 a, Point2 b, Point2 c) {
  return (difference(a.u, c.u) * difference(b.v, c.v) - difference(a.v, c.v) * difference(b.u, c.u)).sign();
}

// Returns +1 if a, b, c run counter-clockwise, -1 if they run clockwise, and 0 if they lie on a line.
int orientation(Point2 a, Point2 b, Point2 c) {
  const double left = (a.u - c.u) * (b.v - c.v), right = (a.v - c.v) * (b.u - c.u);
  const double determinant = left - right;
  // Shewchuk's bound on the relative error is (3 + 16 e) e with e = 2^-53. The code uses a larger number, 2^-51.
  if (std::abs(determinant) > 0x1p-51 * (std::abs(left) + std::abs(right)) + underflow) return sign(determinant);
  return orientation_exactly(a, b, c);
}

int orientation_exactly(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const auto ax = difference(a.x, d.x), ay = difference(a.y, d.y), az = difference(a.z, d.z);
  const auto bx = difference(b.x, d.x), by = difference(b.y, d.y), bz = difference(b.z, d.z);
  const auto cx = difference(c.x, d.x), cy = difference(c.y, d.y), cz = difference(c.z, d.z);
  return ((bx * cy - by * cx) * az + (cx * ay - cy * ax) * bz + (ax * by - ay * bx) * cz).sign();
}

// Returns the sign of the volume of the tetrahedron a, b, c, d, or 0 if the four points lie in a plane.
int orientation(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 p = a - d, q = b - d, r = c - d;
  const double qxry = q.x * r.y, qyrx = q.y * r.x, rxpy = r.x * p.y, rypx = r.y * p.x, pxqy = p.x * q.y,
               pyqx = p.y * q.x;
  const double determinant = p.z * (qxry - qyrx) + q.z * (rxpy - rypx) + r.z * (pxqy - pyqx);
  const double magnitude = std::abs(p.z) * (std::abs(qxry) + std::abs(qyrx)) +
                           std::abs(q.z) * (std::abs(rxpy) + std::abs(rypx)) +
                           std::abs(r.z) * (std::abs(pxqy) + std::abs(pyqx));
  // Shewchuk's bound on the relative error is (7 + 56 e) e with e = 2^-53. The code uses a larger number, 2^-50.
  if (std::abs(determinant) > 0x1p-50 * magnitude + underflow) return sign(determinant);
  return orientation_exactly(a, b, c, d);
}

// Returns true if no two of the signs are opposite.
bool agree(int a, int b, int c) { return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0); }

// Returns whether c lies between a and b. The three points must lie on one line.
bool is_between(Point2 a, Point2 b, Point2 c) {
  return std::min(a.u, b.u) <= c.u && c.u <= std::max(a.u, b.u) && std::min(a.v, b.v) <= c.v &&
         c.v <= std::max(a.v, b.v);
}

bool segments_meet(Point2 a, Point2 b, Point2 c, Point2 d) {
  const int a_side = orientation(c, d, a), b_side = orientation(c, d, b);
  const int c_side = orientation(a, b, c), d_side = orientation(a, b, d);
  if (a_side * b_side < 0 && c_side * d_side < 0) return true;
  return (a_side == 0 && is_between(c, d, a)) || (b_side == 0 && is_between(c, d, b)) ||
         (c_side == 0 && is_between(a, b, c)) || (d_side == 0 && is_between(a, b, d));
}

// Decides whether a segment in the plane of a triangle meets the triangle. Projects the segment and the triangle along a
// coordinate axis, so that the projected triangle has an area.
bool meets_in_plane(Vec3 a, Vec3 b, const std::array<Vec3, 3> &corners) {
  const auto along = [](int axis, Vec3 p) {
    return axis == 0 ? Point2{p.y, p.z} : axis == 1 ? Point2{p.z, p.x} : Point2{p.x, p.y};
  };
  int axis = 0;
  while (axis < 2 && orientation(along(axis, corners[0]), along(axis, corners[1]), along(axis, corners[2])) == 0)
    ++axis;
  const Point2 p = along(axis, a), q = along(axis, b);
  const Point2 c[3] = {along(axis, corners[0]), along(axis, corners[1]), along(axis, corners[2])};
  if (agree(orientation(c[0], c[1], p), orientation(c[1], c[2], p), orientation(c[2], c[0], p))) return true;
  return segments_meet(p, q, c[0], c[1]) || segments_meet(p, q, c[1], c[2]) || segments_meet(p, q, c[2], c[0]);
}

Vec3 without_negligible(Vec3 p) {
  const auto keep = [](double x) { return std::abs(x) < negligible_coordinate ? 0.0 : x; };
  return {keep(p.x), keep(p.y), keep(p.z)};
}

bool boxes_overlap(Vec3 a, Vec3 b, const std::array<Vec3, 3> &corners) {
  Bounds segment, triangle;
  for (const Vec3 p : {a, b}) segment.add(p);
  for (const Vec3 p : corners) triangle.add(p);
  return overlap(segment, triangle);
}

}  // namespace

bool segment_meets_triangle(Vec3 a, Vec3 b, const std::array<Vec3, 3> &corners) {
  a = without_negligible(a);
  b = without_negligible(b);
  const std::array<Vec3, 3> c = {without_negligible(corners[0]), without_negligible(corners[1]),
                                 without_negligible(corners[2])};
  if (!boxes_overlap(a, b, c)) return false;
  const int a_side = orientation(c[0], c[1], c[2], a), b_side = orientation(c[0], c[1], c[2], b);
  if (a_side * b_side > 0) return false;
  if (a_side == 0 && b_side == 0) return meets_in_plane(a, b, c);
  // The line of the segment meets the plane in one point. This point is in the triangle if the line passes all three edges on the
  // same side.
  return agree(orientation(a, b, c[0], c[1]), orientation(a, b, c[1], c[2]), orientation(a, b, c[2], c[0]));
}

}  // namespace riis
