/* SPDX-License-Identifier: Apache-2.0
 * The search over clusters gives the same results as the exhaustive search, bit for bit. The results agree for every mesh,
 * surface, limit, mask, instruction set and number of threads, and also without a limit. If clusters cannot be used, the
 * exhaustive search runs, and the statistics report it. */
#include <omp.h>
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "oracle.h"
#include "searches.h"

#include "cluster_checks.h"
#include "sanitized.h"

enum { every_distance = 1 };
static const double no_limit = 1e60;

/* Checks a marking with a limit. If `also` is every_distance, also checks the distances of all nodes. */
static void check_also(const riis_surface *surface, int64_t n, const double *xyz, double limit, int also) {
  riis_mesh *mesh = mesh_of(n, xyz);
  riis_mark_options options = mark_options();
  options.distance_limit = limit;
  check_with(surface, mesh, options, 2, RIIS_SEARCH_CLUSTERS);
  if (also == every_distance) {
    const int64_t most_before = most_within;
    options.distance_limit = no_limit;
    most_within = 0;
    check_with(surface, mesh, options, 2, RIIS_SEARCH_CLUSTERS);
    assert_int_equal(most_within, n);
    most_within = most_before;
  }
  free_one_owned(mesh);
}
static void check(const riis_surface *surface, int64_t n, const double *xyz, double limit) {
  check_also(surface, n, xyz, limit, every_distance);
}

static riis_surface *valve_surface(const char *kind, riis_surface_options options) {
  return surface_of_kind(kind, &options);
}

/* --- Meshes ---------------------------------------------------------------------------------------------------------- */

enum { max_nodes = 40000 };
static double xyz[3 * max_nodes];

TEST(meshes_of_few_nodes) {
  riis_surface *surface = aortic_surface(NULL);
  most_within = 0;
  for (int n = 1; n <= 70; n += trial_step()) {
    for (int i = 0; i < n; ++i) point_near(surface, n % 3 ? 0.15 : 3, xyz + 3 * i);
    check(surface, n, xyz, n % 2 ? RIIS_AUTO : 0.2);
  }
  assert_true(most_within > 20);
}

/* All nodes are at one point, at few points, on a line or in a plane. The number of nodes is near the size of a leaf, a cluster
 * or a region. */
TEST(nodes_without_extent) {
  static const int counts[] = {1, 2, 31, 33, 100, 511, 513, 1025, 8191, 8193, 20000};
  riis_surface *surface = aortic_surface(NULL);
  for (size_t k = 0; k < sizeof counts / sizeof counts[0]; ++k)
    for (int kind = 0; kind < 5; ++kind) {
      double at[9], axis[2][3];
      const int n = counts[k];
      if (n > 8000 && (5 * (int)k + kind) % trial_step()) continue;
      for (int i = 0; i < 3; ++i) point_near(surface, 0.05, at + 3 * i);
      for (int i = 0; i < 6; ++i) axis[i / 3][i % 3] = kind == 2 ? i == 2 : random_between(&rng, -1, 1);
      for (int i = 0; i < n; ++i) {
        const double s = random_between(&rng, -2, 2), t = random_between(&rng, -2, 2);
        for (int c = 0; c < 3; ++c)
          xyz[3 * i + c] = kind == 0   ? at[c]
                           : kind == 1 ? at[3 * (i % 3) + c]
                           : kind == 4 ? at[c] + s * axis[0][c] + t * axis[1][c]
                                       : at[c] + s * axis[0][c];
      }
      most_within = 0;
      check(surface, n, xyz, RIIS_AUTO);
      if (kind < 2) assert_int_equal(most_within, n);
    }
}

/* The coordinates differ by the smallest possible number, or by numbers whose inverse overflows. */
TEST(nodes_that_differ_by_next_to_nothing) {
  const double soup[9] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
  const int32_t ids[3] = {0, 1, 2};
  static const double steps[] = {1e-300, 1e-308, 1e-309, 1e-310, 1e-320, 5e-324};
  const riis_surface_arrays arrays = triangle_arrays(3, soup, 1, ids);
  riis_surface_options options = surface_options();
  options.half_thickness = 0.1;
  riis_surface *surface = surface_from(&arrays, &options);
  for (size_t k = 0; k < sizeof steps / sizeof steps[0]; ++k) {
    const int owned_before = n_owned();
    enum { n = 700 };
    for (int i = 0; i < 3 * n; ++i) xyz[i] = (double)(random_bits(&rng) % 3) * steps[k];
    riis_mesh *mesh = mesh_of(n, xyz);
    riis_marks *result = new_result();
    riis_mark_options of_clusters = mark_options();
    of_clusters.search = RIIS_SEARCH_CLUSTERS;
    CHECK_OK(riis_mesh_prepare(mesh, 1));
    CHECK_OK(riis_mark_nodes(surface, mesh, &of_clusters, result));
    assert_int_equal(marked_in(result).n, n);
    free_owned_after(owned_before);
  }
}

/* Both valves are tested in meshes whose spacing grows to one side, and in meshes whose cells are a hundred times as long as
 * high. Limits go from nearly 0 to beyond the mesh. */
TEST(graded_and_anisotropic_meshes) {
  static const double limits[] = {0, 1e-3, 0.05, 0.4, 50};
  most_threads = 0;
  for (int mitral = 0; mitral < 2; ++mitral)
    for (size_t k = 0; k < sizeof limits / sizeof limits[0]; ++k) {
      const int owned_before = n_owned();
      riis_surface_options options = surface_options();
      options.half_thickness = fmax(1e-4, fmin(limits[k], 0.1));
      options.tolerance = 0.5;
      riis_surface *surface = valve_surface(mitral ? "mitral" : "aortic", options);
      const int64_t n = is_short_test() ? 12 : 30, counts[2][3] = {{n, n, n}, {5, 20, 9 * n}};
      for (int kind = 0; kind < 2; ++kind) {
        const int n_outside = n_owned();
        const double lower[3] = {-2, -2, -2}, upper[3] = {2, 2, 2};
        test_mesh nodes = lattice(counts[kind], lower, upper);
        for (int64_t i = 0; i < 3 * nodes.n && kind == 0; ++i) nodes.xyz[i] = nodes.xyz[i] * fabs(nodes.xyz[i]);
        riis_mesh *mesh = mesh_of(nodes.n, nodes.xyz);
        riis_mark_options marking = mark_options();
        marking.distance_limit = fmax(limits[k], options.half_thickness);
        check_with(surface, mesh, marking, kind == 0 ? 4 : 1, RIIS_SEARCH_CLUSTERS);
        free_owned_after(n_outside);
      }
      free_owned_after(owned_before);
    }
  /* If OpenMP gives as many threads as requested, several threads must have run. */
  if (omp_get_thread_limit() > 1) assert_true(most_threads > 1);
}

TEST(masked_nodes_are_left_out) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, is_short_test() ? 0.15 : 0.09, 0.3);
  riis_mesh *mesh = mesh_of(nodes.n, nodes.xyz);
  uint8_t *mask = own(malloc((size_t)nodes.n));
  for (int kind = 0; kind < 5; ++kind) {
    for (int64_t i = 0; i < nodes.n; ++i)
      mask[i] = kind == 0   ? 0
                : kind == 1 ? 255
                : kind == 2 ? nodes.xyz[3 * i] > 0
                : kind == 3 ? i % 2 != 0
                            : random_bits(&rng) % 8 == 0;
    riis_mark_options options = mark_options();
    options.node_mask = mask;
    options.distance_limit = 0.25;
    check_with(surface, mesh, options, 3, RIIS_SEARCH_CLUSTERS);
  }
}

/* Each mesh is one node. The node's box is as small as the allowance for single precision. The limit is the node's distance, or
 * one bit less. */
TEST(nodes_at_the_limit_are_found) {
  riis_surface_options options = surface_options();
  options.half_thickness = 1e-4;
  options.tolerance = 1;
  for (int c = 0; c < 3; ++c) options.translation[c] = random_between(&rng, -3, 3);
  const double square[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  const int32_t ids[6] = {0, 1, 2, 0, 2, 3};
  const riis_surface_arrays arrays = triangle_arrays(4, square, 2, ids);
  /* The node is as far from the square's bounding box as from the square. */
  riis_surface *surfaces[2] = {valve_surface("aortic", options), surface_from(&arrays, &options)};
  for (int k = 0; k < 2; ++k) {
    int n_tried = 0;
    for (int i = 0; i < trials(300, 300); ++i) {
      point_near(surfaces[k], random_power_of_ten(&rng, -3, 0.5), xyz);
      const double distance = closest_to(surfaces[k], xyz[0], xyz[1], xyz[2]).distance;
      if (distance <= options.half_thickness * 1.01) continue;
      most_within = 0;
      check_also(surfaces[k], 1, xyz, distance, !every_distance);
      assert_int_equal(most_within, 1);
      most_within = 0;
      check_also(surfaces[k], 1, xyz, nextafter(distance, 0), i % 4);
      assert_int_equal(most_within, 0);
      ++n_tried;
    }
    CHECK_MET(n_tried > 150);
  }
}

/* --- Surfaces -------------------------------------------------------------------------------------------------------- */

/* Makes a sphere around the origin. The sphere has 2 n by n quads, each of two triangles except at the poles. */
static riis_surface *sphere(int n, double radius, double half_thickness) {
  double *at = own(malloc((size_t)(2 * n) * (size_t)(n + 1) * 3 * sizeof *at));
  int32_t *ids = own(malloc((size_t)(4 * n * n) * 3 * sizeof *ids));
  int64_t n_triangles = 0;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i < 2 * n; ++i) {
      const double u = i * acos(-1) / n, v = j * acos(-1) / n;
      double *p = at + 3 * (2 * n * j + i);
      p[0] = radius * sin(v) * cos(u), p[1] = radius * sin(v) * sin(u), p[2] = radius * cos(v);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < 2 * n; ++i) {
      const int32_t a = 2 * n * j + i, b = 2 * n * j + (i + 1) % (2 * n),
                    quad[6] = {a, a + 2 * n, b + 2 * n, a, b + 2 * n, b};
      for (int k = j == n - 1; k < (j == 0 ? 1 : 2); ++k)
        memcpy(ids + 3 * n_triangles++, quad + 3 * k, 3 * sizeof *ids);
    }
  const riis_surface_arrays arrays = triangle_arrays(2 * n * (n + 1), at, n_triangles, ids);
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness;
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  return surface_from(&arrays, &options);
}

/* Every point of the surface is equally far from the sphere's middle, so the filter keeps far more pairs than its buffer can
 * hold. The test counts the pairs that the filter must keep. The filter must keep a pair if its triangle's distance exceeds the
 * smallest distance by at most the error of single precision. */
TEST(more_pairs_than_room) {
  enum { n = 40, room = 4096 };
  riis_surface *surface = sphere(40, 0.9, 0.1);
  const riis_triangles all = triangles_of(surface);
  const double middle[3] = {0, 0, 0}, error = 0x1p-18 * 5, smallest = closest_to(surface, 0, 0, 0).distance;
  int64_t n_equal = 0;
  for (int64_t i = 0; i < all.n_triangles; ++i) {
    double abc[9];
    for (int k = 0; k < 9; ++k) abc[k] = all.xyz[3 * all.vertex_id[3 * i + k / 3] + k % 3];
    n_equal += oracle_point_triangle(middle, abc) <= smallest + error;
  }
  printf("%lld of %lld triangles are as near\n", (long long)n_equal, (long long)all.n_triangles);
  assert_true(32 * n_equal > 2 * room); /* the number of pairs of one leaf */
  for (int spread = 0; spread < 3; ++spread) {
    for (int i = 0; i < 3 * n; ++i)
      xyz[i] = spread == 0 ? 0 : (spread == 1 ? 1e-7 : 1e-3) * random_between(&rng, -1, 1);
    most_within = 0;
    check(surface, n, xyz, 1);
    assert_int_equal(most_within, n);
    check(surface, n, xyz, smallest); /* a limit that only triangles at exactly this distance meet */
  }
}

/* The surfaces from arrays have needles down to 1e-11, sizes over many powers of ten, coplanar triangles, and separate pieces.
 * Units go from 1e-50 to 1e50. Some surfaces are so far from the origin that their coordinates are rounded. */
TEST(surfaces_from_arrays) {
  enum { max_triangles = 600, n = 1500 };
  static double corners[9 * max_triangles];
  static int32_t ids[3 * max_triangles];
  for (int i = 0; i < 3 * max_triangles; ++i) ids[i] = i;
  most_within = 0;
  for (int trial = 0; trial < trials_of(150); ++trial) {
    const int owned_before = n_owned();
    const int64_t n_triangles = 8 + (int64_t)(random_bits(&rng) % (max_triangles - 8));
    const double unit = trial % 3 ? 1 : random_power_of_ten(&rng, -45, 45),
                 far = trial % 2   ? 0
                       : trial % 4 ? 300
                                   : random_power_of_ten(&rng, 0, 13);
    double origin[3];
    for (int c = 0; c < 3; ++c) origin[c] = far * random_between(&rng, -1, 1);
    for (int64_t i = 0; i < n_triangles; ++i) {
      double *p = corners + 9 * i, along[3], across[3];
      const double size = trial % 5 == 0 && far == 0 ? random_power_of_ten(&rng, -5, 0) : 0.1,
                   height = far > 0 ? 0.1 : random_power_of_ten(&rng, trial % 5 == 1 ? -11 : -3, 0);
      for (int c = 0; c < 3; ++c) {
        const double at = random_between(&rng, -1, 1) + (i % 2 ? 5 * (trial % 7 == 0) : 0);
        along[c] = size * random_between(&rng, -1, 1), across[c] = size * height * random_between(&rng, -1, 1);
        p[c] = at, p[3 + c] = at + along[c], p[6 + c] = at + 0.4 * along[c] + across[c];
      }
      if (trial % 6 == 0) p[2] = p[5] = p[8] = 0.25;
    }
    for (int64_t i = 0; i < 9 * n_triangles; ++i) corners[i] = unit * (corners[i] + origin[i % 3]);
    const riis_surface_arrays arrays = triangle_arrays(3 * n_triangles, corners, n_triangles, ids);
    riis_surface_options options = surface_options();
    options.zero_area = RIIS_ZERO_AREA_SKIP;
    options.half_thickness = unit * random_power_of_ten(&rng, -4, -1);
    riis_surface *surface = NULL;
    const riis_status status = riis_surface_create_from_arrays(&arrays, &options, &surface);
    if (status == RIIS_INVALID_SURFACE) continue; /* none of its triangles has an area */
    CHECK_OK(status);
    own(surface);
    const double off = unit * random_power_of_ten(&rng, -6, 0.5);
    for (int i = 0; i < n; ++i) point_near(surface, i % 3 ? off : 0, xyz + 3 * i);
    for (int i = 0; i < n; i += 50) /* some nodes are far away, so the mesh is at least as large as the surface */
      for (int c = 0; c < 3 && trial % 4 == 0; ++c) xyz[3 * i + c] += 300 * unit * random_between(&rng, -1, 1);
    check(surface, n, xyz, RIIS_AUTO);
    check_also(surface, n, xyz, fmax(options.half_thickness, off * random_power_of_ten(&rng, -1, 1)), !every_distance);
    free_owned_after(owned_before);
  }
  assert_int_equal(most_within, n);
}

/* Needles lie along a diagonal. Subtracting the surface's middle from the needles' corners rounds the heights to 0. */
TEST(needles_that_are_lines_in_the_frame) {
  enum { n_triangles = 64, n = 2000 };
  double corners[9 * n_triangles];
  int32_t ids[3 * n_triangles];
  for (int i = 0; i < 3 * n_triangles; ++i) ids[i] = i;
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    for (int i = 0; i < n_triangles; ++i) {
      double *p = corners + 9 * i;
      const double size = random_power_of_ten(&rng, -8, -5), at = random_between(&rng, 0, 1e-4);
      for (int c = 0; c < 3; ++c)
        p[c] = at, p[3 + c] = at + size, p[6 + c] = at + size * random_between(&rng, 0.2, 0.8);
      p[6] = p[7] = p[8];
      p[6] += size * 1e-11, p[7] -= size * 1e-11;
    }
    /* A large triangle determines the surface's frame. */
    const double large[9] = {0.7, 0.7, 0.7, -0.1, 0.7, 0.7, 0.7, -0.1, -0.1};
    memcpy(corners, large, sizeof large);
    const riis_surface_arrays arrays = triangle_arrays(3 * n_triangles, corners, n_triangles, ids);
    riis_surface_options options = surface_options();
    options.zero_area = RIIS_ZERO_AREA_SKIP;
    options.half_thickness = 0.3;
    riis_surface *surface = surface_from(&arrays, &options);
    if (trial == 0) assert_true(info_of(surface).n_triangles > n_triangles / 2);
    for (int i = 0; i < 3 * n; ++i) xyz[i] = random_between(&rng, -0.5, 1);
    check(surface, n, xyz, RIIS_AUTO);
    free_owned_after(owned_before);
  }
}

/* The valve lies far from the origin, as in a scanner's coordinates. Some valves lie so far away that coordinates are rounded. */
TEST(valves_far_from_the_origin) {
  static const double far[] = {300, 1e4, 1e6};
  for (size_t k = 0; k < sizeof far / sizeof far[0]; ++k) {
    const int owned_before = n_owned();
    riis_surface_options options = surface_options();
    for (int c = 0; c < 3; ++c) options.translation[c] = far[k] * random_between(&rng, -1, 1);
    options.tolerance = 0.5;
    riis_surface *surface = valve_surface(k % 2 ? "mitral" : "aortic", options);
    test_mesh nodes = lattice_around(surface, 0.12, 0.3);
    for (int64_t i = 0; i < 3 * nodes.n; ++i) nodes.xyz[i] += 0.01 * random_between(&rng, -1, 1);
    most_within = 0;
    check(surface, nodes.n, nodes.xyz, RIIS_AUTO);
    check_also(surface, nodes.n, nodes.xyz, 0.4, !every_distance);
    assert_true(most_within > 1000);
    free_owned_after(owned_before);
  }
}

/* --- Every distance --------------------------------------------------------------------------------------------------- */

/* Sets the i-th of a list of points: on the surface, near it, at a vertex, anywhere in the surface's box, on the box's axis, or
 * far away. Some points are equal. */
static void any_point(const riis_surface *surface, int i) {
  const riis_surface_info info = info_of(surface);
  const riis_triangles all = triangles_of(surface);
  double *p = xyz + 3 * i, longest = 0;
  for (int c = 0; c < 3; ++c) longest = fmax(longest, info.upper[c] - info.lower[c]);
  const double far = longest * random_power_of_ten(&rng, 0, 4);
  const int64_t kind = (int64_t)(random_bits(&rng) % 8),
                vertex = (int64_t)(random_bits(&rng) % (uint64_t)all.n_vertices);
  if (kind < 3) {
    point_near(surface, kind == 0 ? 0 : longest * random_power_of_ten(&rng, -7, -0.5), p);
    return;
  }
  const int other = (int)(random_bits(&rng) % (uint64_t)(i + 1));
  for (int c = 0; c < 3; ++c) {
    const double middle = 0.5 * (info.lower[c] + info.upper[c]), extent = info.upper[c] - info.lower[c];
    p[c] = kind == 3                 ? all.xyz[3 * vertex + c]
           : kind == 4 && i != other ? xyz[3 * other + c]
           : kind == 5               ? middle + far * random_between(&rng, -1, 1)
           : kind == 6 && c < 2      ? middle
                                     : middle + extent * random_between(&rng, -1, 1);
  }
}

/* Tests random valves of every kind, at random openings and placements, with both triangulations. RIIS_TEST_LONG=1 continues
 * until ten million distances are compared. */
TEST(every_distance_of_random_valves) {
  static const char *const kinds[] = {"aortic", "trileaflet", "coapting", "mitral", "bileaflet"};
  enum { n_kinds = 5 };
  const int64_t n_wanted = trials((80000 + 2) / 3, 10000000);
  int64_t n_compared = 0;
  for (int trial = 0; n_compared < n_wanted; ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = new_valve(kinds[trial % n_kinds]);
    if (riis_valve_set_scalar(valve, "opening", random_between(&rng, 0, 1)) != RIIS_OK)
      assert_non_null(strstr(riis_last_error(), "opening"));
    riis_surface_options options = surface_options();
    options.scale = random_power_of_ten(&rng, -3, 1);
    options.tolerance = random_power_of_ten(&rng, trial % 4 ? -1.3 : -2, 0);
    options.triangulation = trial % 3 ? RIIS_TRIANGULATION_ADAPTED : RIIS_TRIANGULATION_FIXED;
    options.rotation_angle = trial % 2 ? random_between(&rng, -180, 180) : 0;
    for (int c = 0; c < 3; ++c) {
      options.rotation_axis[c] = random_between(&rng, 0.1, 1);
      options.translation[c] = trial % 2 ? options.scale * random_between(&rng, -30, 30) : 0;
    }
    riis_surface *surface = new_surface(valve, &options);
    const int n = (int)random_power_of_ten(&rng, 0, 4);
    for (int i = 0; i < n; ++i) any_point(surface, i);
    riis_mark_options marking = mark_options();
    marking.distance_limit = trial % 3 ? no_limit : options.scale * random_power_of_ten(&rng, -0.2, 3);
    most_within = 0;
    check_with(surface, mesh_of(n, xyz), marking, 4, RIIS_SEARCH_CLUSTERS);
    if (marking.distance_limit == no_limit) assert_int_equal(most_within, n);
    n_compared += n;
    free_owned_after(owned_before);
  }
  printf("%lld distances of random valves\n", (long long)n_compared);
}

/* Leaves are larger than the surface. More groups of triangles are near a leaf than the filter takes at once. A few nodes are
 * between the leaflets. */
TEST(large_leaves_near_small_triangles) {
  riis_surface_options options = surface_options();
  options.tolerance = is_short_test() ? 0.02 : 4e-4;
  riis_surface *surface = aortic_surface(&options);
  if (!is_short_test()) assert_true(info_of(surface).n_triangles > 16 * 4096);
  const int n = 300;
  for (int i = 0; i < 3 * n; ++i) xyz[i] = random_between(&rng, -1, 1) * (i < 60 ? 1 : 30);
  riis_mark_options marking = mark_options();
  marking.distance_limit = no_limit;
  most_within = 0;
  check_with(surface, mesh_of(n, xyz), marking, 2, RIIS_SEARCH_CLUSTERS);
  assert_int_equal(most_within, n);
}

/* --- If single precision does not suffice ---------------------------------------------------------------------------- */

TEST(where_it_cannot_be_used_the_exhaustive_search_runs) {
  const int n = is_long_test() ? 500 : is_short_test() ? 40 : 167;
  riis_surface *surface = aortic_surface(NULL);
  const struct {
    double size, at, limit;
    int32_t search;
  } cases[] = {
      {1, 0, RIIS_AUTO, RIIS_SEARCH_CLUSTERS},
      {1e5, 0, RIIS_AUTO, RIIS_SEARCH_CLUSTERS},
      {1e8, 0, RIIS_AUTO, RIIS_SEARCH_EXHAUSTIVE},
      {1e60, 0, RIIS_AUTO, RIIS_SEARCH_EXHAUSTIVE},
      {1, 1e5, RIIS_AUTO, RIIS_SEARCH_CLUSTERS},
      {1, 1e8, RIIS_AUTO, RIIS_SEARCH_EXHAUSTIVE},
      {1, 1e59, RIIS_AUTO, RIIS_SEARCH_EXHAUSTIVE},
      {1, 0, 1e5, RIIS_SEARCH_CLUSTERS},
      {1, 0, 1e8, RIIS_SEARCH_CLUSTERS},
      {1, 0, 1e60, RIIS_SEARCH_CLUSTERS},
      {1e-20, 0, RIIS_AUTO, RIIS_SEARCH_CLUSTERS},
      {1e-60, 0, RIIS_AUTO, RIIS_SEARCH_EXHAUSTIVE},
      {1e5, 1e5, 2e5, RIIS_SEARCH_CLUSTERS},
      {3e5, 3e5, 5e5, RIIS_SEARCH_CLUSTERS},
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
    const int owned_before = n_owned();
    for (int i = 0; i < 3 * n; ++i) xyz[i] = cases[k].at + cases[k].size * random_between(&rng, -1, 1);
    for (int i = 0; i < 20; ++i) /* some are near the surface */
      if (cases[k].at == 0 && cases[k].size > 1) point_near(surface, 0.1, xyz + 3 * i);
    riis_mesh *mesh = mesh_of(n, xyz);
    riis_mark_options options = mark_options();
    options.distance_limit = cases[k].limit;
    check_with(surface, mesh, options, 2, cases[k].search);
    free_owned_after(owned_before);
  }
}

TEST(what_options_say) {
  riis_surface *surface = aortic_surface(NULL);
  for (int i = 0; i < 300; ++i) point_near(surface, 0.2, xyz + 3 * i);
  riis_mesh *mesh = mesh_of(100, xyz);
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  assert_int_equal(options.instructions, RIIS_INSTRUCTIONS_AUTO);
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  const int32_t best = stats_of(result).instructions;
  const int64_t n_within = within_in(result).n;
  assert_true(best >= RIIS_INSTRUCTIONS_BASELINE && best <= RIIS_INSTRUCTIONS_AVX512);
  static const int32_t wrong[] = {-1, 4, INT32_MIN, INT32_MAX};
  for (int k = 0; k < 4; ++k) {
    char text[64];
    snprintf(text, sizeof text, "options.instructions is %d; it must be one of", wrong[k]);
    options.instructions = wrong[k];
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, text, riis_mark_nodes(surface, mesh, &options, result));
  }
  /* The loop also tries instruction sets that this processor lacks. */
  for (int32_t set = RIIS_INSTRUCTIONS_BASELINE; set <= RIIS_INSTRUCTIONS_AVX512; ++set) {
    options.instructions = set;
    assert_int_equal(is_refused(riis_mark_nodes(surface, mesh, &options, result), set), set > best);
    if (set <= best) assert_int_equal(stats_of(result).instructions, set);
  }
  assert_int_equal(within_in(result).n, n_within);
}

int main(void) {
  rng = random_start("test_cluster_search");
  return run_cases(NULL, NULL);
}
