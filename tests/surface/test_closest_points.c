/* SPDX-License-Identifier: Apache-2.0
 * Compares closest points from the Embree scene with the independent oracle and with plain loops. The triangles, placements and
 * limits vary. */
#include <riis/riis.h>

#include <stdbool.h>

#include "oracle.h"
#include "test_support.h"

#include "handles.h"

static random_source rng;

static void single_equals_the_oracle(riis_surface *surface, int n_points, double reach) {
  const riis_surface_info info = info_of(surface);
  const double *xyz = triangles_of(surface).xyz;
  const int64_t n = triangles_of(surface).n_triangles;
  const int64_t *vertex_id = triangles_of(surface).vertex_id;
  double size = 0;
  for (int c = 0; c < 3; ++c) size = fmax(size, fmax(fabs(info.lower[c]), fabs(info.upper[c])));
  for (int i = 0; i < n_points; ++i) {
    double p[3], largest = size;
    for (int c = 0; c < 3; ++c) {
      const double extent = info.upper[c] - info.lower[c];
      p[c] = random_between(&rng, info.lower[c] - reach * extent, info.upper[c] + reach * extent);
      largest = fmax(largest, fabs(p[c]));
    }
    const riis_closest closest = closest_to(surface, p[0], p[1], p[2]);
    int64_t triangle;
    CHECK_NEAR(closest.distance, (double)oracle_distance(p, n, vertex_id, xyz, &triangle), 1e-12 * largest);
  }
}

TEST(aortic_valve_equals_the_oracle) {
  riis_surface_options options = surface_options();
  for (int trial = 0; trial < 4; ++trial) {
    const int owned_before = n_owned();
    /* The surface is near the origin, 300 cm away, in metres, or turned. */
    options.scale = trial < 2 ? 1 : 0.01;
    options.rotation_angle = 77 * trial;
    for (int c = 0; c < 3; ++c) options.translation[c] = trial % 2 ? random_between(&rng, -300, 300) : 0;
    riis_surface *surface = aortic_surface(&options);
    single_equals_the_oracle(surface, 250, 0.5);
    single_equals_the_oracle(surface, 20, 1000);
    free_owned_after(owned_before);
  }
}

TEST(random_soups_equal_the_oracle) {
  for (int trial = 0; trial < trials_of(120); ++trial) {
    const int owned_before = n_owned();
    const int64_t n = 1 + (int64_t)(random_bits(&rng) % 300);
    double *xyz;
    int32_t *ids;
    random_soup(&rng, n, pow(10, random_between(&rng, -3, 1)), &xyz, &ids);
    riis_surface_arrays arrays = triangle_arrays(3 * n, xyz, n, ids);
    riis_surface_options options = surface_options();
    options.scale = pow(10, random_between(&rng, -6, 6));
    for (int c = 0; c < 3; ++c) options.translation[c] = options.scale * random_between(&rng, -100, 100);
    riis_surface *surface = surface_from(&arrays, &options);
    single_equals_the_oracle(surface, 200, trial % 2 ? 0.3 : 30);
    free_owned_after(owned_before);
  }
}

/* The points are so far away that single precision does not separate the triangles. */
TEST(far_points_equal_the_oracle) {
  riis_surface *surface = aortic_surface(NULL);
  int64_t triangle;
  const double *xyz = triangles_of(surface).xyz;
  const int64_t n = triangles_of(surface).n_triangles;
  const int64_t *vertex_id = triangles_of(surface).vertex_id;
  for (int power = 1; power <= 59; power += 2) {
    const double r = pow(10, power), p[3] = {r, -0.3 * r, 0.7 * r};
    const riis_closest closest = closest_to(surface, p[0], p[1], p[2]);
    CHECK_NEAR(closest.distance / r, (double)oracle_distance(p, n, vertex_id, xyz, &triangle) / r, 1e-15);
  }
}

/* A grid of coplanar, repeated and mirrored triangles gives equal distances everywhere. The lowest id must win in any order of
 * triangles. */
TEST(ties_go_to_the_lowest_id) {
  enum { copies = 50 };
  double xyz[9 * copies];
  int32_t ids[3 * copies];
  const double triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  for (int i = 0; i < copies; ++i) {
    for (int k = 0; k < 9; ++k)
      xyz[9 * i + k] = triangle[k] + (k % 3 == 2 ? (i % 2 ? 1.0 : -1.0) : 0); /* planes z = -1 and z = 1 */
    for (int k = 0; k < 3; ++k) ids[3 * i + k] = 3 * i + k;
  }
  riis_surface_arrays arrays = triangle_arrays(3 * copies, xyz, copies, ids);
  riis_surface *surface = surface_from(&arrays, NULL);
  assert_int_equal(closest_to(surface, 0.2, 0.2, 0).triangle_id, 0);
  assert_int_equal(closest_to(surface, 0.2, 0.2, 0.5).triangle_id, 1);
  assert_int_equal(closest_to(surface, 0.2, 0.2, 3).triangle_id, 1);
  assert_int_equal(closest_to(surface, 0.2, 0.2, -3).triangle_id, 0);
  assert_int_equal(closest_to(surface, -5, -5, 0).triangle_id, 0);
}

/* Every output of a batch has the bits of the single query, for any number of threads, layout and choice of arrays. */
TEST(batches_equal_single_queries) {
  enum { n = 3000 };
  static double xyz[3 * n], x[n], y[n], z[n], distance[n], point[3 * n], barycentric[3 * n], normal[3 * n],
      only_distance[n];
  static int64_t triangle_id[n];
  static int32_t leaflet_id[n], side[n];
  riis_surface *surface = aortic_surface(NULL);
  for (int i = 0; i < 3 * n; ++i) xyz[i] = random_between(&rng, -2, 2);
  for (int i = 0; i < n; ++i) x[i] = xyz[3 * i], y[i] = xyz[3 * i + 1], z[i] = xyz[3 * i + 2];
  riis_closest_options options;
  riis_closest_arrays arrays, few;
  CHECK_OK(riis_closest_options_init(&options, sizeof options));
  CHECK_OK(riis_closest_arrays_init(&arrays, sizeof arrays));
  CHECK_OK(riis_closest_arrays_init(&few, sizeof few));
  arrays.distance = distance, arrays.point = point, arrays.barycentric = barycentric, arrays.normal = normal;
  arrays.triangle_id = triangle_id, arrays.leaflet_id = leaflet_id, arrays.side = side;
  few.distance = only_distance;
  for (int threads = 0; threads <= 4; ++threads) {
    options.n_threads = threads;
    CHECK_OK(closest_points_of(surface, n, xyz, xyz + 1, xyz + 2, 3, threads ? &options : NULL, &arrays));
    CHECK_OK(closest_points_of(surface, n, x, y, z, 1, &options, &few));
    for (int i = 0; i < n; ++i) {
      const riis_closest one = closest_to(surface, x[i], y[i], z[i]);
      CHECK_SAME(distance[i], one.distance);
      CHECK_SAME(only_distance[i], one.distance);
      assert_memory_equal(point + 3 * i, one.point, sizeof one.point);
      assert_memory_equal(barycentric + 3 * i, one.barycentric, sizeof one.barycentric);
      assert_memory_equal(normal + 3 * i, one.normal, sizeof one.normal);
      assert_int_equal(triangle_id[i], one.triangle_id);
      assert_int_equal(leaflet_id[i], one.leaflet_id);
      assert_int_equal(side[i], one.side);
    }
  }
  /* With a limit, the results of near points stay unchanged, and far points are reported as far. */
  options.distance_limit = 0.3;
  options.far_distance = -5;
  static double limited[n];
  static int64_t limited_triangle[n];
  CHECK_OK(riis_closest_arrays_init(&few, sizeof few));
  few.distance = limited, few.triangle_id = limited_triangle;
  CHECK_OK(closest_points_of(surface, n, x, y, z, 1, &options, &few));
  int n_far = 0;
  for (int i = 0; i < n; ++i) {
    const int far = distance[i] > 0.3;
    n_far += far;
    CHECK_SAME(limited[i], far ? -5 : distance[i]);
    assert_int_equal(limited_triangle[i], far ? -1 : triangle_id[i]);
  }
  assert_true(n_far > 100 && n_far < n - 100);
  /* An infinite limit means no limit. */
  options.distance_limit = INFINITY;
  options.far_distance = RIIS_FAR_DISTANCE;
  CHECK_OK(closest_points_of(surface, n, x, y, z, 1, &options, &few));
  assert_memory_equal(limited, distance, sizeof limited);
  CHECK_OK(closest_points_of(surface, 0, NULL, NULL, NULL, 1, NULL, &few)); /* n = 0: nothing to do */
}

/* Arrays for all results of n points. */
typedef struct results {
  double *distance, *point, *barycentric, *normal;
  int64_t *triangle_id;
  int32_t *leaflet_id, *side;
} results;

static results results_of(int64_t n) {
  const size_t m = (size_t)n;
  results made;
  made.distance = own(calloc(m, 8)), made.point = own(calloc(m, 24)), made.barycentric = own(calloc(m, 24));
  made.normal = own(calloc(m, 24)), made.triangle_id = own(calloc(m, 8));
  made.leaflet_id = own(calloc(m, 4)), made.side = own(calloc(m, 4));
  return made;
}

static void check_equal(const results *a, int64_t i, const riis_closest *one) {
  CHECK_SAME(a->distance[i], one->distance);
  assert_memory_equal(a->point + 3 * i, one->point, sizeof one->point);
  assert_memory_equal(a->barycentric + 3 * i, one->barycentric, sizeof one->barycentric);
  assert_memory_equal(a->normal + 3 * i, one->normal, sizeof one->normal);
  assert_int_equal(a->triangle_id[i], one->triangle_id);
  assert_int_equal(a->leaflet_id[i], one->leaflet_id);
  assert_int_equal(a->side[i], one->side);
}

/* Masks, lists, limits and single precision give the results of single queries, and write no other entry. Points in order advance
 * along x, as in many meshes. */
static void check_many_points(int64_t n, bool are_in_order) {
  const int64_t stride = is_long_test() ? 1 : 5;
  riis_surface_options options = surface_options();
  options.rotation_angle = random_between(&rng, 0, 360);
  for (int c = 0; c < 3; ++c) options.rotation_axis[c] = random_between(&rng, 0.1, 1), options.translation[c] = c - 5;
  for (int c = 0; c < 3; ++c) options.translation[c] += random_between(&rng, -1, 1);
  riis_surface *surface = surface_of_kind(random_bits(&rng) % 2 ? "aortic" : "mitral", &options);
  const riis_surface_info info = info_of(surface);
  float *xyz = own(malloc((size_t)n * 3 * sizeof *xyz));
  riis_closest *one = own(malloc((size_t)n * sizeof *one));
  for (int64_t i = 0; i < n; ++i) {
    /* Some points are far away. Some points are so far away that single precision does not separate triangles. */
    const double wide = i % 25 ? 0.5 : i % 1000 ? 100 : random_power_of_ten(&rng, 2, 20);
    for (int c = 0; c < 3; ++c) {
      const double extent = info.upper[c] - info.lower[c];
      xyz[3 * i + c] = (float)random_between(&rng, info.lower[c] - wide * extent, info.upper[c] + wide * extent);
      if (are_in_order && c == 0) xyz[3 * i] = (float)(info.lower[0] + extent * (double)i / (double)n);
      /* Points without an order are mixed: any 1000 consecutive points extend as far as all points. */
      if (!are_in_order && i % 500 == 1) xyz[3 * i + c] = i % 1000 == 1 ? 1e22F : -1e22F;
    }
  }
  /* The coordinates were rounded in a separate loop. In a common loop, GCC 12 would pass coordinates that are not yet rounded. */
  for (int64_t i = 0; i < n; ++i)
    if (i % stride == 0)
      one[i] = closest_to(surface, (double)xyz[3 * i], (double)xyz[3 * i + 1], (double)xyz[3 * i + 2]);
  riis_points points;
  CHECK_OK(riis_points_init(&points, sizeof points));
  points.n_points = n, points.x = xyz, points.y = xyz + 1, points.z = xyz + 2, points.stride = 3, points.real_bits = 32;
  uint8_t *mask = own(malloc((size_t)n));
  int64_t *ids = own(malloc((size_t)n * sizeof *ids)), n_ids = 0;
  for (int64_t i = 0; i < n; ++i) {
    mask[i] = random_bits(&rng) % 3 > 0;
    if (mask[i]) ids[n_ids++] = i;
  }
  /* all points; a mask; a list; a limit, and fewer arrays; too few for clusters */
  enum { all, masked, listed, limited, few, n_ways };
  for (int way = all; way < n_ways; ++way) {
    const int owned_before = n_owned();
    riis_closest_options how;
    riis_closest_arrays arrays;
    CHECK_OK(riis_closest_options_init(&how, sizeof how));
    CHECK_OK(riis_closest_arrays_init(&arrays, sizeof arrays));
    results got = results_of(n);
    memset(got.side, 0x5a, (size_t)n * 4);
    arrays.distance = got.distance, arrays.triangle_id = got.triangle_id, arrays.leaflet_id = got.leaflet_id;
    if (way != limited)
      arrays.point = got.point, arrays.barycentric = got.barycentric, arrays.normal = got.normal,
      arrays.side = got.side;
    how.n_threads = way == all ? 0 : 1 + way % 4;
    if (way == masked) how.point_mask = mask;
    if (way >= listed) how.point_ids = ids, how.n_point_ids = way == few ? 50 : n_ids;
    if (way == limited) how.distance_limit = 0.3 * (info.upper[0] - info.lower[0]), how.far_distance = -7;
    CHECK_OK(riis_closest_points(surface, &points, &how, &arrays));
    int64_t n_written = 0, n_far = 0;
    for (int64_t i = 0; i < n; ++i) {
      if (i % stride) continue;
      if (way != all && (!mask[i] || (way == few && i > ids[49]))) {
        assert_true(got.triangle_id[i] == 0 && got.distance[i] == 0 && got.side[i] == 0x5a5a5a5a);
        continue;
      }
      ++n_written;
      if (way != limited) {
        check_equal(&got, i, one + i);
      } else if (one[i].distance <= how.distance_limit) {
        CHECK_SAME(got.distance[i], one[i].distance);
        assert_int_equal(got.triangle_id[i], one[i].triangle_id);
      } else {
        assert_true(got.distance[i] == -7 && got.triangle_id[i] == -1 && got.leaflet_id[i] == -1);
        ++n_far;
      }
    }
    assert_true(n_written > (way == few ? 3 : 100));
    if (way == limited) CHECK_MET(n_far > 100 && n_far < n_written - 100);
    free_owned_after(owned_before);
  }
}

/* The points fill several batches, which all threads share. */
TEST(many_points_equal_single_queries) { check_many_points(is_long_test() ? 3000000 : trials_of(140000), false); }

/* Near points follow each other in the list, so each thread takes separate batches. */
TEST(many_points_in_order_equal_single_queries) {
  check_many_points(is_long_test() ? 3000000 : trials_of(140000), true);
}

/* The points lie in a plane, on a line, in one place, mostly in a small part of their box, or all but one near the valve. The
 * points are sorted into leaves without gaps, and get the results of single queries. */
TEST(crowded_points_equal_single_queries) {
  enum { n = 3000 };
  static double xyz[3 * n];
  riis_surface *surface = surface_of_kind(random_bits(&rng) % 2 ? "trileaflet" : "bileaflet", NULL);
  const results got = results_of(n);
  for (int shape = 0; shape < 6; ++shape) {
    for (int i = 0; i < n; ++i) {
      /* a box, a plane, a line, one place, a crowd in a wide box, one point far away */
      const int n_free = shape < 4 ? 3 - shape : 3;
      const double reach = shape == 4 && i % 50 ? 1e-3 : shape == 5 && i == n / 2 ? 30 : 2;
      for (int c = 0; c < 3; ++c) xyz[3 * i + c] = c < n_free ? random_between(&rng, -reach, reach) : 0.1 * c;
    }
    riis_closest_options options;
    riis_closest_arrays arrays;
    CHECK_OK(riis_closest_options_init(&options, sizeof options));
    CHECK_OK(riis_closest_arrays_init(&arrays, sizeof arrays));
    options.n_threads = 1 + shape % 3;
    arrays.distance = got.distance, arrays.point = got.point, arrays.barycentric = got.barycentric;
    arrays.normal = got.normal, arrays.triangle_id = got.triangle_id, arrays.leaflet_id = got.leaflet_id;
    arrays.side = got.side;
    CHECK_OK(closest_points_of(surface, n, xyz, xyz + 1, xyz + 2, 3, &options, &arrays));
    for (int i = 0; i < n; ++i) {
      const riis_closest one = closest_to(surface, xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
      check_equal(&got, i, &one);
    }
  }
}

/* The results of a single query are consistent. The point lies on the triangle at the reported distance. The normal is the
 * triangle's normal, and the side is the sign of the height. */
TEST(closest_is_consistent) {
  riis_surface *surface = aortic_surface(NULL);
  const double *xyz = triangles_of(surface).xyz;
  const int64_t n = triangles_of(surface).n_triangles;
  const int64_t *vertex_id = triangles_of(surface).vertex_id;
  const int32_t *leaflet_id = triangles_of(surface).leaflet_id;
  for (int trial = 0; trial < trials_of(9000); ++trial) {
    const double p[3] = {random_between(&rng, -1.6, 1.6), random_between(&rng, -1.6, 1.6),
                         random_between(&rng, -1.1, 0.2)};
    const riis_closest c = closest_to(surface, p[0], p[1], p[2]);
    assert_true(c.triangle_id >= 0 && c.triangle_id < n);
    assert_int_equal(c.leaflet_id, leaflet_id[c.triangle_id]);
    double distance_sq = 0, height = 0, unit = 0;
    for (int k = 0; k < 3; ++k) {
      double at = 0;
      for (int v = 0; v < 3; ++v) at += c.barycentric[v] * xyz[3 * vertex_id[3 * c.triangle_id + v] + k];
      CHECK_NEAR(c.point[k], at, 1e-14);
      distance_sq += (p[k] - c.point[k]) * (p[k] - c.point[k]);
      height += (p[k] - c.point[k]) * c.normal[k];
      unit += c.normal[k] * c.normal[k];
    }
    CHECK_NEAR(c.distance, sqrt(distance_sq), 1e-15);
    CHECK_NEAR(unit, 1, 1e-14);
    /* If the closest point is inside a triangle, the line to it from the query point runs along the normal. */
    if (c.barycentric[0] > 1e-6 && c.barycentric[1] > 1e-6 && c.barycentric[2] > 1e-6 && c.distance > 1e-6) {
      CHECK_NEAR(fabs(height), c.distance, 1e-9);
      assert_int_equal(c.side, height > 0 ? 1 : -1);
    }
  }
}

int main(void) {
  rng = random_start("test_closest_points");
  return run_cases(NULL, NULL);
}
