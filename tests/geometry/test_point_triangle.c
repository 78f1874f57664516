/* SPDX-License-Identifier: Apache-2.0
 * Compares the decision kernel, which finds a triangle's closest point, with an independent kernel in extended
 * precision. Triangles have every shape, size and position. */
#include "internals.h"
#include "oracle.h"
#include "test_support.h"

static random_source rng;

typedef struct {
  double p[3], abc[9], size;
} sample;

/* Makes a triangle of the given size and thinness around a random centre. Also makes a point within a few sizes of the
 * triangle. */
static sample random_sample(double size, double thinness, double offset) {
  sample s;
  double centre[3], along[3], across[3];
  s.size = size;
  for (int c = 0; c < 3; ++c) {
    centre[c] = random_between(&rng, -offset, offset);
    along[c] = random_between(&rng, -1, 1);
    across[c] = random_between(&rng, -1, 1);
  }
  const double shares[6] = {0, 0, 1, 0, random_between(&rng, 0, 1), thinness};
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 3; ++c)
      s.abc[3 * k + c] = centre[c] + size * (shares[2 * k] * along[c] + shares[2 * k + 1] * across[c]);
  const double reach = size * pow(10, random_between(&rng, -3, 1));
  const int start = (int)(random_bits(&rng) % 3);
  for (int c = 0; c < 3; ++c) s.p[c] = s.abc[3 * start + c] + random_between(&rng, -reach, reach);
  return s;
}

static double height_over_longest(const double *abc) {
  double e[3][3], longest = 0, n[3];
  for (int k = 0; k < 3; ++k) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) e[k][c] = abc[3 * ((k + 1) % 3) + c] - abc[3 * k + c], sum += e[k][c] * e[k][c];
    longest = fmax(longest, sum);
  }
  n[0] = e[0][1] * e[1][2] - e[0][2] * e[1][1];
  n[1] = e[0][2] * e[1][0] - e[0][0] * e[1][2];
  n[2] = e[0][0] * e[1][1] - e[0][1] * e[1][0];
  return sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / longest;
}

static void check_sample(const sample *s, double *worst) {
  double point[3], w[3];
  const double distance = sqrt(kernel_point_triangle(s->p, s->abc, point, w));
  const double expected = (double)oracle_point_triangle(s->p, s->abc);
  double largest = expected;
  for (int i = 0; i < 9; ++i) largest = fmax(largest, fabs(s->abc[i]));
  for (int c = 0; c < 3; ++c) largest = fmax(largest, fabs(s->p[c]));
  *worst = fmax(*worst, fabs(distance - expected) / largest);
  /* The weights are at least 0 and sum to 1. The corners with these weights give the closest point, which lies at the returned
   * distance. */
  CHECK_NEAR(w[0] + w[1] + w[2], 1, 1e-15);
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    assert_true(w[c] >= 0);
    CHECK_NEAR(point[c], w[0] * s->abc[c] + w[1] * s->abc[3 + c] + w[2] * s->abc[6 + c], 8e-16 * largest);
    sum += (s->p[c] - point[c]) * (s->p[c] - point[c]);
  }
  CHECK_NEAR(distance, sqrt(sum), 1e-15 * largest);
}

TEST(agrees_with_the_oracle) {
  double worst = 0;
  for (int trial = 0; trial < 200000; ++trial) {
    const sample s = random_sample(pow(10, random_between(&rng, -4, 2)), 1, random_between(&rng, 0, 1) < 0.5 ? 1 : 300);
    if (height_over_longest(s.abc) > 1e-3) check_sample(&s, &worst);
  }
  printf("largest difference over the size of the coordinates: %.2g\n", worst);
  CHECK_AT_MOST(worst, 1e-14);
}

TEST(agrees_on_needles) {
  double worst = 0;
  int n = 0;
  for (int trial = 0; trial < 200000; ++trial) {
    const sample s = random_sample(pow(10, random_between(&rng, -3, 1)), pow(10, random_between(&rng, -11, -2)), 1);
    /* A triangle below this height counts as having no area, and never reaches the kernel. */
    if (height_over_longest(s.abc) <= 2e-12) continue;
    check_sample(&s, &worst);
    ++n;
  }
  printf("%d needles: largest difference over the size of the coordinates: %.2g\n", n, worst);
  assert_true(n > 100000);
  CHECK_AT_MOST(worst, 1e-12);
}

TEST(knows_its_regions) {
  const double abc[9] = {0, 0, 0, 2, 0, 0, 0, 2, 0};
  const struct {
    double p[3], distance, w[3];
  } cases[] = {
      {{0.5, 0.5, 3}, 3, {0.5, 0.25, 0.25}},
      {{-3, -4, 0}, 5, {1, 0, 0}},
      {{5, -4, 0}, 5, {0, 1, 0}},
      {{0, 2, -7}, 7, {0, 0, 1}},
      {{1, -3, 4}, 5, {0.5, 0.5, 0}},
      {{-2, 1, 0}, 2, {0.5, 0, 0.5}},
      {{2, 2, 0}, 1.4142135623730951, {0, 0.5, 0.5}},
      {{0.5, 0.25, 0}, 0, {0.625, 0.25, 0.125}},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    double point[3], w[3];
    CHECK_NEAR(sqrt(kernel_point_triangle(cases[i].p, abc, point, w)), cases[i].distance, 1e-15);
    for (int c = 0; c < 3; ++c) {
      CHECK_NEAR(w[c], cases[i].w[c], 1e-15);
      if (cases[i].w[c] == 0) CHECK_SAME(w[c], 0.0);
    }
  }
}

TEST(holds_at_the_limits_of_size) {
  for (int power = -58; power <= 58; power += 4) {
    const double s = pow(10, power), abc[9] = {0, 0, 0, 2 * s, 0, 0, 0, 2 * s, 0}, p[3] = {0.5 * s, 0.5 * s, 3 * s};
    double point[3], w[3];
    CHECK_NEAR(sqrt(kernel_point_triangle(p, abc, point, w)) / s, 3, 1e-14);
  }
}

int main(void) {
  rng = random_start("test_point_triangle");
  return run_cases(NULL, NULL);
}
