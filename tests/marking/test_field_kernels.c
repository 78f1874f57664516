/* SPDX-License-Identifier: Apache-2.0
 * Tests the kernels that compute fields of closest points. Every instruction set gives the bits that plain C gives with the same
 * order of operations. */
#include "internals.h"
#include "test_support.h"

static random_source rng;

enum { n_lanes = 8 };

static void random_numbers(int n, double size, double *x) {
  for (int i = 0; i < n; ++i) x[i] = random_between(&rng, -size, size);
}
static double product(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static void difference(const double *a, const double *b, double *c) {
  for (int i = 0; i < 3; ++i) c[i] = a[i] - b[i];
}
static void cross(const double *a, const double *b, double *c) {
  for (int i = 0; i < 3; ++i) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

TEST(numbers_are_mixed_by_weights) {
  enum { n_vertices = 20, n_numbers = 8 };
  for (int trial = 0; trial < 5000; ++trial) {
    double numbers[n_numbers * n_vertices], weights[3 * n_lanes], mixed[n_numbers * n_lanes];
    int64_t id[3 * n_lanes];
    random_numbers(n_numbers * n_vertices, random_power_of_ten(&rng, -100, 100), numbers);
    random_numbers(3 * n_lanes, 1, weights);
    for (int i = 0; i < 3 * n_lanes; ++i) {
      id[i] = (int64_t)(random_bits(&rng) % n_vertices);
      if (random_bits(&rng) % 8 == 0) weights[i] = 0;
    }
    for (int set = 0; set < n_kernel_sets; ++set) {
      if (!kernels_there(set)) continue;
      kernels_mix_at_vertices(set, n_vertices, numbers, id, weights, mixed);
      for (int i = 0; i < n_numbers * n_lanes; ++i) {
        const int lane = i / n_numbers, k = i % n_numbers;
        const double *w = weights + 3 * lane;
        const int64_t *v = id + 3 * lane;
        const double expected = w[0] * numbers[n_numbers * v[0] + k] + w[1] * numbers[n_numbers * v[1] + k] +
                                w[2] * numbers[n_numbers * v[2] + k];
        if (memcmp(mixed + i, &expected, sizeof expected) != 0)
          fail_msg("%s, trial %d, lane %d: %.17g instead of %.17g", kernels_name(set), trial, lane, mixed[i], expected);
      }
    }
  }
}

/* A derivative is -n.V. The unit vector n points from the closest point to the given point, and V is the mean of the rates. The
 * derivative is 0 at distance 0. The kernel writes nothing after the last point. */
TEST(distances_are_differentiated) {
  enum { n_vertices = 20, most_directions = 3, room = most_directions * n_lanes + 1 };
  for (int trial = 0; trial < 5000; ++trial) {
    double points[3 * n_lanes], on[3 * n_lanes], weights[3 * n_lanes], made[room];
    double rates[3 * n_vertices * most_directions];
    int64_t id[3 * n_lanes];
    const int n_points = 1 + (int)(random_bits(&rng) % n_lanes), n_directions = (int)(random_bits(&rng) % 4);
    const double size = random_power_of_ten(&rng, -100, 100);
    random_numbers(3 * n_lanes, size, points);
    random_numbers(3 * n_lanes, size, on);
    random_numbers(3 * n_lanes, 1, weights);
    random_numbers(3 * n_vertices * most_directions, random_power_of_ten(&rng, -100, 100), rates);
    for (int i = 0; i < 3 * n_lanes; ++i) {
      id[i] = (int64_t)(random_bits(&rng) % n_vertices);
      if (random_bits(&rng) % 8 == 0) weights[i] = 0;
    }
    for (int lane = 0; lane < n_lanes; ++lane)
      if (random_bits(&rng) % 8 == 0) memcpy(on + 3 * lane, points + 3 * lane, 3 * sizeof *on);
    for (int set = 0; set < n_kernel_sets; ++set) {
      if (!kernels_there(set)) continue;
      for (int i = 0; i < room; ++i) made[i] = 77;
      kernels_differentiate(set, points, on, weights, id, n_vertices, n_directions, rates, n_points, made);
      for (int i = 0; i < room; ++i) {
        double expected = 77;
        if (i < n_points * n_directions) {
          const int lane = i / n_directions;
          double away[3], dots[3];
          difference(points + 3 * lane, on + 3 * lane, away);
          const double length = sqrt(product(away, away)), factor = length > 0 ? -1 / length : 0;
          for (int k = 0; k < 3; ++k) {
            double at[3];
            for (int x = 0; x < 3; ++x) at[x] = weights[3 * lane + k] * (length > 0 ? factor * away[x] : 0);
            dots[k] = product(at, rates + 3 * n_vertices * (i % n_directions) + 3 * id[3 * lane + k]);
          }
          expected = dots[0] + dots[1] + dots[2];
        }
        if (memcmp(made + i, &expected, sizeof expected) != 0)
          fail_msg("%s, trial %d, number %d: %.17g instead of %.17g", kernels_name(set), trial, i, made[i], expected);
      }
    }
  }
}

TEST(sides_follow_the_height_over_the_plane) {
  int64_t n_of_side[3] = {0, 0, 0};
  for (int trial = 0; trial < 5000; ++trial) {
    double points[3 * n_lanes], on[3 * n_lanes], normals[3 * n_lanes];
    int32_t side[n_lanes];
    /* The coordinates are small whole numbers, so that many points lie in the triangle's plane. */
    for (int i = 0; i < 3 * n_lanes; ++i) {
      points[i] = (double)(random_bits(&rng) % 4);
      on[i] = (double)(random_bits(&rng) % 4);
      normals[i] = (double)(random_bits(&rng) % 3) - 1;
    }
    for (int set = 0; set < n_kernel_sets; ++set) {
      if (!kernels_there(set)) continue;
      memset(side, 0x77, sizeof side);
      kernels_find_sides(set, points, on, normals, side);
      for (int lane = 0; lane < n_lanes; ++lane) {
        double up[3];
        difference(points + 3 * lane, on + 3 * lane, up);
        const double height = product(up, normals + 3 * lane);
        const int expected = (height > 0) - (height < 0);
        if (side[lane] != expected)
          fail_msg("%s, trial %d, lane %d: %d instead of %d", kernels_name(set), trial, lane, side[lane], expected);
        ++n_of_side[expected + 1];
      }
    }
  }
  for (int k = 0; k < 3; ++k) assert_true(n_of_side[k] > 1000);
}

TEST(triangles_are_measured) {
  enum { n_vertices = 24, n_measures = 6 };
  for (int trial = 0; trial < 5000; ++trial) {
    double vertices[3 * n_vertices], measures[n_measures * n_lanes];
    int64_t id[3 * n_lanes];
    const int n = 1 + (int)(random_bits(&rng) % n_lanes);
    random_numbers(3 * n_vertices, random_power_of_ten(&rng, -30, 30), vertices);
    for (int i = 0; i < 3 * n; ++i) id[i] = (i + trial) % n_vertices;
    for (int set = 0; set < n_kernel_sets; ++set) {
      if (!kernels_there(set)) continue;
      kernels_measure_triangles(set, vertices, id, n, measures);
      for (int i = 0; i < n; ++i) {
        const double *a = vertices + 3 * id[3 * i], *b = vertices + 3 * id[3 * i + 1],
                     *c = vertices + 3 * id[3 * i + 2];
        double ab[3], ac[3], bc[3], ba[3], area[3], scaled_ab[3], scaled_ac[3], normal[3];
        difference(b, a, ab), difference(c, a, ac), difference(c, b, bc), difference(a, b, ba);
        cross(ab, ac, area);
        const double longest = sqrt(fmax(fmax(product(ab, ab), product(bc, bc)), product(ac, ac)));
        for (int k = 0; k < 3; ++k) scaled_ab[k] = 1 / longest * ab[k], scaled_ac[k] = 1 / longest * ac[k];
        cross(scaled_ab, scaled_ac, normal);
        const double inverse = 1 / sqrt(product(normal, normal));
        const double expected[n_measures] = {inverse * normal[0],       inverse * normal[1], inverse * normal[2],
                                             sqrt(product(area, area)), product(ab, ac),     product(bc, ba)};
        if (memcmp(measures + n_measures * i, expected, sizeof expected) != 0)
          fail_msg("%s, trial %d, triangle %d: normal (%.17g %.17g %.17g) instead of (%.17g %.17g %.17g)",
                   kernels_name(set), trial, i, measures[n_measures * i], measures[n_measures * i + 1],
                   measures[n_measures * i + 2], expected[0], expected[1], expected[2]);
      }
    }
  }
}

int main(void) {
  rng = random_start("test_field_kernels");
  return run_cases(NULL, NULL);
}
