// SPDX-License-Identifier: Apache-2.0
// Sines, cosines and arc tangents whose bits depend on the argument alone. A C library may use different code for these functions
// on different processors, and then the last bits of the results differ. The functions of this file consist only of sums,
// products, quotients and roots, which IEEE 754 rounds in one way. Arguments are finite. The comments below give errors in units
// of 2^-53 = 1.1e-16, and test_elementary checks these errors.
//
// The functions use polynomials in the square of the argument, which interpolate the functions at Chebyshev points. Only the
// polynomial of sine_of_pi is a least-squares fit. The third coefficient of this fit was lowered by five units in its last place,
// so that no value exceeds 1.
#pragma once

#include <cmath>
#include <cstddef>

namespace riis {

inline constexpr double pi = 3.14159265358979323846;

struct SineCosine {
  double sine, cosine;
};

namespace elementary {

// Evaluates the polynomial with the given coefficients at x. The constant term is the first coefficient.
template <std::size_t n>
constexpr double polynomial(const double (&coefficient)[n], double x) {
  double value = coefficient[n - 1];
  for (std::size_t i = n - 1; i > 0; --i) value = value * x + coefficient[i - 1];
  return value;
}

inline constexpr double half_pi = pi / 2;

// Returns sine and cosine of |x| <= pi/4.
inline SineCosine of_small(double x) {
  constexpr double sine[] = {-0.16666666666666666,   0.008333333333330948,   -0.00019841269836756774,
                             2.7557316101617874e-06, -2.505113165023518e-08, 1.5918115263265974e-10};
  constexpr double cosine[] = {0.041666666666666664,    -0.0013888888888887398, 2.480158729876456e-05,
                               -2.7557317271145144e-07, 2.087614614655861e-09,  -1.1382623647474604e-11};
  const double square = x * x, half = 0.5 * square, rest = 1 - half;
  // The cosine is 1 - x^2/2, plus the rounding error of this difference, plus the terms of higher degree.
  return {x + x * square * polynomial(sine, square),
          rest + (((1 - rest) - half) + square * square * polynomial(cosine, square))};
}

inline SineCosine turned_by_quarters(SineCosine of, double quarters) {
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return of;
    case 1:
      return {of.cosine, -of.sine};
    case 2:
      return {-of.sine, -of.cosine};
    default:
      return {-of.cosine, of.sine};
  }
}

}  // namespace elementary

// Returns sin(pi u) for |u| <= 1/2, with an error of 3.5 units. The sine is exact at 0 and at both ends of this range, and never
// larger than 1 in magnitude.
inline double sine_of_pi(double u) {
  constexpr double in_squares[] = {3.141592653589793,     -5.167712780049953,      2.5501640398765839,
                                   -0.5992645293034821,   0.08214588638811002,     -0.0073704292175835835,
                                   0.0004662946167413797, -2.1892224918961937e-05, 7.596285591336678e-07};
  return u * elementary::polynomial(in_squares, u * u);
}

// Returns cos(pi t) for 0 <= t <= 1, with an error of 3.5 units. The cosine is exact at 0, 1/2 and 1.
inline double cosine_of_pi(double t) { return sine_of_pi(0.5 - t); }

// Returns sine and cosine of an angle in radians, with errors of 2 units. Beyond 1e6 radians the error grows with the angle.
inline SineCosine sine_cosine(double radians) {
  using elementary::half_pi;
  // pi/2 in three parts. The first two parts have few digits, so that their product with any number of quarters below 2^20 is
  // exact.
  constexpr double first = 0x1.921fb544p+0, second = 0x1.0b4611a6p-34, third = 0x1.3198a2e037073p-69;
  const double near = std::abs(radians) <= 1e6 ? radians : std::remainder(radians, 2 * pi);
  const double quarters = std::floor(near / half_pi + 0.5);
  return elementary::turned_by_quarters(
      elementary::of_small(((near - quarters * first) - quarters * second) - quarters * third), quarters);
}

// Returns sine and cosine of an angle in degrees, with errors of 2 units. Sine and cosine are exact at multiples of 90 degrees.
inline SineCosine sine_cosine_degrees(double degrees) {
  using elementary::half_pi;
  // The angle is split into quarter turns and a rest within [-45, 45] degrees, without any rounding.
  const double turned = std::remainder(degrees, 360.0);
  const double quarters = std::nearbyint(turned / 90.0);
  return elementary::turned_by_quarters(elementary::of_small((turned - 90.0 * quarters) * (half_pi / 90.0)), quarters);
}

// Returns the angle of the point (x, y), from -pi to pi, with a relative error of 3 units. Zeros are treated as in std::atan2.
// The sum |x| + |y| must not overflow.
inline double arc_tangent(double y, double x) {
  using elementary::half_pi;
  constexpr double in_squares[] = {-0.3333333333333333,  0.19999999999995516,  -0.14285714284665682,
                                   0.11111111015187018,  -0.0909090457530649,  0.07692183125376892,
                                   -0.06664510525508936, 0.05858140904866328,  -0.050854078345894844,
                                   0.03923044778479309,  -0.019175404711104935};
  const double ax = std::abs(x), ay = std::abs(y), least = ay < ax ? ay : ax, largest = ay < ax ? ax : ay;
  // The angle is measured from the nearest multiple of pi/4, so the quotient is at most tan(pi/8).
  constexpr double tangent_of_eighth = 0.41421356237309503;
  const bool is_wide = least > tangent_of_eighth * largest;
  const double over = is_wide ? least - largest : least, under = is_wide ? least + largest : largest;
  const double t = under > 0 ? over / under : 0;
  const double near = t + t * (t * t) * elementary::polynomial(in_squares, t * t);
  double angle = is_wide ? half_pi / 2 + near : near;
  if (ay >= ax && ay > 0) angle = half_pi - angle;
  if (std::signbit(x)) angle = pi - angle;
  return std::copysign(angle, y);
}

// Returns the angle from 0 to pi with the given cosine, with a relative error of 4 units. The cosine must be from -1 to 1.
inline double arc_cosine(double cosine) { return arc_tangent(std::sqrt((1 - cosine) * (1 + cosine)), cosine); }

// Returns exp(x) - 1 for x <= 0, with a relative error of 7 units.
inline double exponential_minus_one(double x) {
  if (x < -50) return -1;
  int n_doublings = 0;
  for (; x < -0.25; x *= 0.5) ++n_doublings;
  // Taylor's series of (exp(x) - 1) / x. The first term that is left out is below 1e-17.
  constexpr double series[] = {1.0,          1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,       1.0 / 720,
                               1.0 / 5040.0, 1.0 / 40320.0, 1.0 / 362880.0, 1.0 / 3628800.0, 1.0 / 39916800.0};
  double value = x * elementary::polynomial(series, x);
  for (int i = 0; i < n_doublings; ++i) value *= 2 + value;  // exp(2 x) - 1 = (exp(x) - 1) (exp(x) + 1)
  return value;
}

// Returns the base raised to a power between 0 and 1, with a relative error of 60 units. The base is positive.
inline double power_to_share(double base, double share) {
  // Each binary digit of the share belongs to one of the repeated square roots of the base. The power is the product of the roots
  // whose digit is 1.
  if (share >= 1) return base;
  double power = 1, root = base;
  for (int digit = 0; digit < 53 && share > 0; ++digit) {
    root = std::sqrt(root);
    share *= 2;
    if (share >= 1) power *= root, share -= 1;
  }
  return power;
}

// Returns the third root of a positive number, with a relative error of 2 units.
inline double cube_root(double x) {
  int exponent;
  std::frexp(x, &exponent);
  double root = std::ldexp(1.0, exponent / 3);  // within a factor of 2
  for (int i = 0; i < 7; ++i)
    root -= (root - x / (root * root)) / 3;  // each of Newton's steps doubles the number of right digits
  return root;
}

// Returns the length of a vector. The squares must not overflow. A square that underflows must be negligible.
inline double hypotenuse(double x, double y, double z = 0) { return std::sqrt(x * x + y * y + z * z); }

}  // namespace riis
