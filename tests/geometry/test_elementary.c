/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests the library's sines, cosines, arc tangents, powers and roots against the C library's functions of long double, which have
 * at least 11 more bits. common/elementary.hpp states the bounds, in units of 2^-53. */
#include <float.h>

#include "elementary_shim.h"
#include "test_support.h"

static const long double pi = 3.14159265358979323846264338327950288L;
static const double unit = 0x1p-53;

enum { n_arguments = 20000 };

static double absolute(double value, long double exact) { return (double)fabsl(value - exact) / unit; }
static double relative(double value, long double exact) { return absolute(value, exact) / (double)fabsl(exact); }
static double larger(double a, double b) { return a > b ? a : b; }

/* Returns a positive number of any size between 2^-least and 1. */
static double small_number(random_source *random, double least) { return pow(2, -random_between(random, 0, least)); }

TEST(test_of_pi) {
  random_source random = random_start("test_elementary");
  double sine = 0, cosine = 0, largest = 0;
  for (int i = 0; i < trials_of(n_arguments); ++i) {
    const double part = i % 2 ? random_between(&random, 0, 0.5) : 0.5 * small_number(&random, 40);
    for (int from_end = 0; from_end < 2; ++from_end) {
      const double u = from_end ? 0.5 - part : part, s = shim_sine_of_pi(u);
      assert_true(shim_sine_of_pi(-u) == -s);
      sine = larger(sine, relative(s, sinl(pi * u)));
      largest = larger(largest, s);
      const double t = from_end ? 1 - 2 * part : 2 * part;
      cosine = larger(cosine, absolute(shim_cosine_of_pi(t), cosl(pi * t)));
    }
  }
  CHECK_AT_MOST(sine, 3.5);
  CHECK_AT_MOST(cosine, 3.5);
  CHECK_AT_MOST(largest, 1);
  assert_true(shim_sine_of_pi(0) == 0 && shim_sine_of_pi(0.5) == 1);
  assert_true(shim_cosine_of_pi(0) == 1 && shim_cosine_of_pi(0.5) == 0 && shim_cosine_of_pi(1) == -1);
}

TEST(test_sine_cosine) {
  random_source random = random_start("test_elementary");
  double in_radians = 0, in_degrees = 0;
  for (int i = 0; i < trials_of(n_arguments); ++i) {
    const double most = i % 2 ? 10 : 1e6;
    const double x = random_between(&random, -most, most);
    double at[2];
    shim_sine_cosine(x, at);
    in_radians = larger(in_radians, larger(absolute(at[0], sinl(x)), absolute(at[1], cosl(x))));
    shim_sine_cosine_degrees(x, at);
    const long double turned = pi * remainderl(x, 360) / 180;
    in_degrees = larger(in_degrees, larger(absolute(at[0], sinl(turned)), absolute(at[1], cosl(turned))));
  }
  CHECK_AT_MOST(in_radians, 2);
  CHECK_AT_MOST(in_degrees, 2);
  const double exact[4][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
  for (int quarter = -8; quarter <= 8; ++quarter) {
    double at[2];
    shim_sine_cosine_degrees(90 * quarter, at);
    for (int k = 0; k < 2; ++k) assert_true(at[k] == exact[(quarter + 8) % 4][k]);
  }
}

TEST(test_inverse) {
  random_source random = random_start("test_elementary");
  double tangent = 0, cosine = 0;
  for (int i = 0; i < trials_of(n_arguments); ++i) {
    double x = random_between(&random, -1, 1), y = random_between(&random, -1, 1);
    if (i % 3 == 0) x *= small_number(&random, 300);
    if (i % 5 == 0) y *= small_number(&random, 300);
    tangent = larger(tangent, relative(shim_arc_tangent(y, x), atan2l(y, x)));
    const double c = random_between(&random, -1, 1);
    cosine = larger(cosine, relative(shim_arc_cosine(c), acosl(c)));
  }
  CHECK_AT_MOST(tangent, 3);
  CHECK_AT_MOST(cosine, 4);
  const double ends[] = {0.0, -0.0, 1, -1, 0.5, -0.5};
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k) {
      const double made = shim_arc_tangent(ends[i], ends[k]), exact = (double)atan2l(ends[i], ends[k]);
      CHECK_AT_MOST(fabs(made - exact), 3 * unit * fabs(exact));
      assert_true(signbit(made) == signbit(exact));
    }
  assert_true(shim_arc_cosine(1) == 0 && shim_arc_cosine(0) == (double)(pi / 2) && shim_arc_cosine(-1) == (double)pi);
}

TEST(test_powers) {
  random_source random = random_start("test_elementary");
  double exponential = 0, power = 0, root = 0;
  for (int i = 0; i < trials_of(n_arguments); ++i) {
    const double x = -80 * small_number(&random, 60);
    exponential = larger(exponential, relative(shim_exponential_minus_one(x), expm1l(x)));
    const double base = pow(2, random_between(&random, -60, 60)), share = random_between(&random, 0, 1);
    power = larger(power, relative(shim_power_to_share(base, share), powl(base, share)));
    root = larger(root, relative(shim_cube_root(base), cbrtl(base)));
  }
  CHECK_AT_MOST(exponential, 7);
  CHECK_AT_MOST(power, 60);
  CHECK_AT_MOST(root, 2);
  assert_true(shim_exponential_minus_one(0) == 0 && shim_exponential_minus_one(-1e300) == -1);
  assert_true(shim_power_to_share(7, 0) == 1 && shim_power_to_share(7, 1) == 7 && shim_power_to_share(9, 0.5) == 3);
}

int main(void) {
  if (LDBL_MANT_DIG < 64) {
    puts("skipped: long double has no more bits than double");
    return 77;
  }
  return run_cases(NULL, NULL);
}
