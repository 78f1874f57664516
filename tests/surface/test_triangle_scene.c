/* SPDX-License-Identifier: Apache-2.0
 * The Embree scene only decides which triangles to skip. The scene's answers therefore have the bits of a loop over all triangles
 * with the same kernel. The bits agree for every position and shape of the surface, and for distances at the limit. */
#include "internals.h"
#include "test_support.h"

TEST(equals_the_loop_bit_for_bit) {
  random_source rng = random_start("test_triangle_scene");
  int64_t n_pairs = 0;
  for (int trial = 0; trial < 120; ++trial) {
    enum { max_triangles = 400, n_points = 400 };
    static double xyz[9 * max_triangles], points[3 * n_points];
    const int64_t n = 1 + (int64_t)(random_bits(&rng) % max_triangles);
    const double scale = pow(10, random_between(&rng, -40, 40)),
                 offset = pow(10, random_between(&rng, -2, trial % 3 ? 3 : 9));
    const double size = pow(10, random_between(&rng, -4, 0)), flat = trial % 4 ? 1 : 0; /* some surfaces are flat */
    double centre[3];
    for (int c = 0; c < 3; ++c) centre[c] = offset * random_between(&rng, -1, 1);
    for (int64_t i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c) {
        const double at = random_between(&rng, -1, 1);
        for (int k = 0; k < 3; ++k)
          xyz[9 * i + 3 * k + c] =
              scale * (centre[c] + (c == 2 ? flat : 1) * (at + size * random_between(&rng, -1, 1)));
      }
    const double reach = pow(10, random_between(&rng, -1, trial % 10 ? 1 : 8)),
                 limit = scale * pow(10, random_between(&rng, -4, 1));
    for (int64_t i = 0; i < n_points; ++i) {
      const double *corner = xyz + 9 * (random_bits(&rng) % (uint64_t)n);
      for (int c = 0; c < 3; ++c) /* some points are at corners or on edges, where several distances are equal */
        points[3 * i + c] = i % 5 == 0   ? corner[c]
                            : i % 5 == 1 ? 0.5 * (corner[c] + corner[3 + c])
                                         : scale * (centre[c] + reach * random_between(&rng, -1, 1));
    }
    assert_int_equal(scene_differs_from_loop(n, xyz, n_points, points, INFINITY), 0);
    assert_int_equal(scene_differs_from_loop(n, xyz, n_points, points, limit), 0);
    assert_int_equal(scene_differs_from_loop(n, xyz, n_points, points, 0), 0);
    n_pairs += 3 * n * n_points;
  }
  printf("%lld point-triangle pairs\n", (long long)n_pairs);
}

/* The limit is inclusive. Each limit equals the distance, or is one bit below or above it. */
TEST(limit_is_inclusive_to_the_last_bit) {
  const double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const double heights[3] = {0.1, nextafter(0.1, 0), nextafter(0.1, 1)};
  for (int i = 0; i < 3; ++i) {
    const double point[3] = {0.25, 0.25, heights[i]};
    for (int k = 0; k < 3; ++k) assert_int_equal(scene_differs_from_loop(1, xyz, 1, point, heights[k]), 0);
  }
}

int main(void) { return run_cases(NULL, NULL); }
