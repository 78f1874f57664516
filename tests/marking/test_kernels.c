/* SPDX-License-Identifier: Apache-2.0
 * Tests the kernels, which are compiled for several instruction sets. Decisions and located points have the bits of the scalar
 * kernel. The error of single precision is at most the library's allowance (docs/theory/clusters.md). No pair that matters is
 * left out, even with a small buffer for pairs. */
#include "internals.h"
#include "test_support.h"

static random_source rng;

/* Returns whether a count is large enough for the number of trials. With all trials, the count must be above n. */
static int is_more(int64_t count, int n) { return is_short_test() || count > trials_of(n); }

static double sign(void) { return random_bits(&rng) & 1 ? 1 : -1; }
static void random_point(double size, double *p) {
  for (int c = 0; c < 3; ++c) p[c] = size * random_between(&rng, -1, 1);
}
static void random_direction(double *v) {
  double length;
  do {
    random_point(1, v);
    length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  } while (length < 0.1 || length > 1);
  for (int c = 0; c < 3; ++c) v[c] /= length;
}
static void cross(const double *a, const double *b, double *c) {
  for (int i = 0; i < 3; ++i) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}
/* Makes three unit vectors at right angles. */
static void random_frame(double (*axis)[3]) {
  double other[3], length = 0;
  random_direction(axis[0]);
  do {
    random_direction(other);
    cross(axis[0], other, axis[1]);
    length = sqrt(axis[1][0] * axis[1][0] + axis[1][1] * axis[1][1] + axis[1][2] * axis[1][2]);
  } while (length < 0.1);
  for (int c = 0; c < 3; ++c) axis[1][c] /= length;
  cross(axis[0], axis[1], axis[2]);
}
static void place(const double *origin, double (*axis)[3], double e, double f, double g, double *p) {
  for (int c = 0; c < 3; ++c) p[c] = origin[c] + e * axis[0][c] + f * axis[1][c] + g * axis[2][c];
}
static double longest_edge_of(int n, const double *corners) {
  double longest = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      const double *a = corners + 9 * i + 3 * k, *b = corners + 9 * i + 3 * ((k + 1) % 3);
      longest = fmax(
          longest, sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2])));
    }
  return longest;
}
static double largest_of(const double *x, int n) {
  double largest = 0;
  for (int i = 0; i < n; ++i) largest = fmax(largest, fabs(x[i]));
  return largest;
}

/* Makes random triangles in the surface's frame, with coordinates of at most 1. Some triangles are needles, with heights down to
 * 1e-12 of their length and any angle at their tips. Some triangles are tiny, and some have coinciding corners. The corners are
 * in any order. */
enum { n_kinds = 6 };
static void random_triangle(int kind, double *abc) {
  double q[3][3], axis[3][3], origin[3];
  const double size = kind == 3 ? random_power_of_ten(&rng, -60, -1) : random_power_of_ten(&rng, -2, -0.5),
               height = kind == 1 || kind == 2 ? random_power_of_ten(&rng, -12, 0) : random_between(&rng, 0.1, 1);
  random_frame(axis);
  random_point(0.4, origin);
  if (kind == 0)
    for (int i = 0; i < 3; ++i) random_point(1, q[i]);
  else {
    /* The third corner stands over the first edge, far beyond the edge, or anywhere. */
    const double along = kind == 2   ? random_between(&rng, 0, 1)
                         : kind == 1 ? (double)(random_bits(&rng) % 2)
                                     : random_between(&rng, -1, 2);
    place(origin, axis, 0, 0, 0, q[0]);
    place(origin, axis, size, 0, 0, q[1]);
    place(origin, axis, size * along, size * height, 0, q[2]);
    if (kind == 4) memcpy(q[random_bits(&rng) % 3], q[random_bits(&rng) % 3], sizeof q[0]);
    if (kind == 5) /* corners on a lattice, where several distances are equal */
      for (int i = 0; i < 9; ++i) q[i / 3][i % 3] = (double)((int)(random_bits(&rng) % 5) - 2) / 4;
  }
  const int first = (int)(random_bits(&rng) % 3), turn = random_bits(&rng) & 1 ? 1 : 2;
  for (int i = 0; i < 3; ++i) memcpy(abc + 3 * i, q[(first + turn * i) % 3], sizeof q[0]);
}

/* Makes a point on a triangle, or away from the triangle by a power of ten. The point lies over a corner, an edge or the inside,
 * beyond a tip, or anywhere. */
static void random_point_near(const double *abc, double reach, double *p) {
  const int kind = (int)(random_bits(&rng) % 8), from = (int)(random_bits(&rng) % 3), to = (from + 1) % 3;
  double offset[3], w[3] = {0, 0, 0};
  if (kind == 0) {
    random_point(1, p);
    return;
  }
  random_direction(offset);
  if (kind <= 2) w[from] = 1;
  if (kind == 3 || kind == 4) w[from] = random_between(&rng, 0, 1), w[to] = 1 - w[from];
  if (kind == 5 || kind == 6) {
    w[0] = random_between(&rng, 0, 1), w[1] = random_between(&rng, 0, 1) * (1 - w[0]), w[2] = 1 - w[0] - w[1];
    double ab[3], ac[3], n[3];
    for (int c = 0; c < 3; ++c) ab[c] = abc[3 + c] - abc[c], ac[c] = abc[6 + c] - abc[c];
    cross(ab, ac, n);
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length > 1e-100)
      for (int c = 0; c < 3; ++c) offset[c] = n[c] / length;
  }
  if (kind == 7) { /* in the triangle's plane, beyond a tip, on the extended median */
    const double beyond = random_power_of_ten(&rng, -6, 0.5);
    w[from] = 1 + 2 * beyond, w[to] = w[(from + 2) % 3] = -beyond;
  }
  const double off = (random_bits(&rng) % 4 == 0 || kind == 7) ? 0 : reach * sign() * random_power_of_ten(&rng, -9, 0);
  for (int c = 0; c < 3; ++c) p[c] = w[0] * abc[c] + w[1] * abc[3 + c] + w[2] * abc[6 + c] + off * offset[c];
}

/* --- Decisions ------------------------------------------------------------------------------------------------------- */

TEST(decisions_have_the_bits_of_the_scalar_kernel) {
  enum { n_triangles = 64, n_points = 200, max_pairs = 600 };
  static double corners[9 * n_triangles], points[3 * n_points], decided[max_pairs + 7], expected[max_pairs];
  static double on[3 * max_pairs], weights[3 * max_pairs];
  static int32_t point[max_pairs], triangle[max_pairs];
  int64_t n_compared = 0, n_inside = 0, n_edge = 0, n_corner = 0;
  for (int trial = 0; trial < trials_of(500); ++trial) {
    /* Some trials use other units. Some trials lie so far from the origin that coordinates are rounded. */
    const double unit = trial % 3 ? 1 : random_power_of_ten(&rng, -50, 50),
                 far = trial % 2 ? 0 : random_power_of_ten(&rng, 0, 9);
    double origin[3];
    random_point(far, origin);
    for (int i = 0; i < n_triangles; ++i) random_triangle(trial % 7 == 0 ? 5 : i % n_kinds, corners + 9 * i);
    for (int i = 0; i < n_points; ++i)
      random_point_near(corners + 9 * (random_bits(&rng) % n_triangles), i % 20 ? 1 : 1e6, points + 3 * i);
    for (int i = 0; i < 9 * n_triangles; ++i) corners[i] = unit * (corners[i] + origin[i % 3]);
    for (int i = 0; i < 3 * n_points; ++i) points[i] = unit * (points[i] + origin[i % 3]);
    const int32_t n = 1 + (int32_t)(random_bits(&rng) % max_pairs);
    for (int32_t i = 0; i < n; ++i) {
      double *weight = weights + 3 * i;
      point[i] = (int32_t)(random_bits(&rng) % n_points);
      triangle[i] = (int32_t)(random_bits(&rng) % n_triangles);
      expected[i] = kernel_point_triangle(points + 3 * point[i], corners + 9 * triangle[i], on + 3 * i, weight);
      const int n_zero = (weight[0] == 0) + (weight[1] == 0) + (weight[2] == 0);
      n_inside += n_zero == 0, n_edge += n_zero == 1, n_corner += n_zero == 2;
    }
    for (int set = 0; set < n_kernel_sets; ++set) {
      if (!kernels_there(set)) continue;
      memset(decided, 0x77, sizeof decided);
      kernels_decide(set, n, point, triangle, points, corners, decided);
      for (int32_t i = 0; i < n; ++i)
        if (memcmp(decided + i, expected + i, sizeof expected[0]) != 0)
          fail_msg("%s, trial %d, pair %d: %.17g instead of %.17g", kernels_name(set), trial, i, decided[i],
                   expected[i]);
      for (int32_t i = 0; i < n; i += 8) {
        const int32_t n_here = n - i < 8 ? n - i : 8;
        const size_t size = (size_t)n_here * sizeof decided[0];
        double closest[3 * 8], barycentric[3 * 8];
        kernels_locate(set, n_here, point + i, triangle + i, points, corners, decided, closest, barycentric);
        if (memcmp(decided, expected + i, size) != 0 || memcmp(closest, on + 3 * i, 3 * size) != 0 ||
            memcmp(barycentric, weights + 3 * i, 3 * size) != 0)
          fail_msg("%s, trial %d, pairs from %d: other closest points", kernels_name(set), trial, i);
      }
      n_compared += n;
    }
  }
  printf("%lld decisions; %lld pairs inside, %lld at edges, %lld at corners\n", (long long)n_compared,
         (long long)n_inside, (long long)n_edge, (long long)n_corner);
  assert_true(is_more(n_compared, 100000) && is_more(n_inside, 5000) && is_more(n_edge, 5000) &&
              is_more(n_corner, 5000));
}

/* Triangles are random, are needles, have coinciding corners, or lie on lattices. One register of eight triangles mixes these
 * kinds of triangles. Some points are at corners and on edges. In some units, squares of coordinates nearly overflow or
 * underflow. */
TEST(located_points_have_the_bits_of_the_scalar_kernel) {
  enum { n = 8 };
  static const int32_t each[n] = {0, 1, 2, 3, 4, 5, 6, 7};
  int64_t n_compared = 0, n_inside = 0, n_edge = 0, n_corner = 0, n_without_area = 0;
  for (int trial = 0; trial < trials_of(20000); ++trial) {
    double corners[9 * n], points[3 * n], sq[n], on[3 * n], weight[3 * n];
    double expected_sq[n], expected_on[3 * n], expected_weight[3 * n];
    const double unit = trial % 3 ? 1 : random_power_of_ten(&rng, -50, 50),
                 far = trial % 2 ? 0 : random_power_of_ten(&rng, 0, 9);
    double origin[3];
    random_point(far, origin);
    for (int i = 0; i < n; ++i) {
      const int kind = trial % 7 == 0 ? 5 : (int)(random_bits(&rng) % n_kinds);
      double *abc = corners + 9 * i, *p = points + 3 * i;
      random_triangle(kind, abc);
      if (random_bits(&rng) % 32 == 0) memcpy(abc + 3, abc, 3 * sizeof *abc), memcpy(abc + 6, abc, 3 * sizeof *abc);
      random_point_near(abc, random_bits(&rng) % 20 ? 1 : 1e6, p);
      const double *q = abc + 3 * (random_bits(&rng) % 3), *r = abc + 3 * (random_bits(&rng) % 3);
      if (random_bits(&rng) % 4 == 0) /* the point is at a corner, or half way along an edge */
        for (int c = 0; c < 3; ++c) p[c] = 0.5 * (q[c] + r[c]);
      for (int c = 0; c < 9; ++c) abc[c] = unit * (abc[c] + origin[c % 3]);
      for (int c = 0; c < 3; ++c) p[c] = unit * (p[c] + origin[c]);
      expected_sq[i] = kernel_point_triangle(p, abc, expected_on + 3 * i, expected_weight + 3 * i);
      const double *w = expected_weight + 3 * i;
      const int n_zero = (w[0] == 0) + (w[1] == 0) + (w[2] == 0);
      n_inside += n_zero == 0, n_edge += n_zero == 1, n_corner += n_zero == 2;
      n_without_area += kind == 4;
    }
    for (int set = 0; set < n_kernel_sets; ++set) {
      if (!kernels_there(set)) continue;
      memset(sq, 0x77, sizeof sq), memset(on, 0x77, sizeof on), memset(weight, 0x77, sizeof weight);
      kernels_locate(set, n, each, each, points, corners, sq, on, weight);
      for (int i = 0; i < n; ++i)
        if (memcmp(sq + i, expected_sq + i, sizeof *sq) != 0 ||
            memcmp(on + 3 * i, expected_on + 3 * i, 3 * sizeof *on) != 0 ||
            memcmp(weight + 3 * i, expected_weight + 3 * i, 3 * sizeof *weight) != 0)
          fail_msg("%s, trial %d, lane %d: (%.17g %.17g %.17g), square %.17g instead of (%.17g %.17g %.17g), %.17g",
                   kernels_name(set), trial, i, on[3 * i], on[3 * i + 1], on[3 * i + 2], sq[i], expected_on[3 * i],
                   expected_on[3 * i + 1], expected_on[3 * i + 2], expected_sq[i]);
      n_compared += n;
    }
  }
  printf("%lld located; %lld pairs inside, %lld at edges, %lld at corners, %lld without area\n", (long long)n_compared,
         (long long)n_inside, (long long)n_edge, (long long)n_corner, (long long)n_without_area);
  assert_true(n_compared >= 8 * trials_of(20000) && is_more(n_inside, 5000) && is_more(n_edge, 5000) &&
              is_more(n_corner, 5000) && is_more(n_without_area, 5000));
}

/* --- Single precision ------------------------------------------------------------------------------------------------ */

/* The mesh's frame, relative to the surface's frame. Points are stored in the mesh's frame and compared in the surface's
 * frame. */
typedef struct framed {
  double ratio, shift[3], largest_shift;
} framed;

static framed random_framed(void) {
  framed f = {ldexp(1, (int)(random_bits(&rng) % 9) - 4), {0, 0, 0}, 0};
  if (random_bits(&rng) % 16 == 0) f.ratio = ldexp(1, (int)(random_bits(&rng) % 30) - 20);
  random_point(f.ratio + 0.5, f.shift);
  f.largest_shift = largest_of(f.shift, 3);
  return f;
}

/* Computes the numbers that the mesh stores for a point p of the surface's frame. as_float gets the stored point in single
 * precision, in the surface's frame. Returns 0 if p is not in the mesh. */
static int store(const framed *f, const double *p, float *stored, float *as_float) {
  for (int c = 0; c < 3; ++c) {
    const double x = (p[c] - f->shift[c]) / f->ratio;
    if (!(fabs(x) <= 1)) return 0;
    stored[c] = (float)x;
    as_float[c] = stored[c] * (float)f->ratio + (float)f->shift[c];
  }
  return 1;
}

/* Compares the distances of the filter, in single precision, with the distances of the decision kernel. The differences are
 * fractions of the allowed error. Too small and too large distances are checked separately, because the margin makes most
 * distances too large. */
TEST(single_precision_is_right_to_its_error) {
  enum { n_lanes = 16 };
  for (int set = 0; set < n_kernel_sets; ++set) {
    if (!kernels_there(set)) continue;
    double nearer = 0, farther = 0;
    int64_t n_compared = 0;
    for (int trial = 0; trial < trials_of(20000); ++trial) {
      double corners[9 * n_lanes], decided[n_lanes + 7];
      float filtered[n_lanes];
      const int n = 1 + (int)(random_bits(&rng) % n_lanes);
      for (int i = 0; i < n; ++i) random_triangle((int)(random_bits(&rng) % n_kinds), corners + 9 * i);
      kernel_group *group = kernels_group(set, n, corners);
      const framed f = random_framed();
      const double limit = random_power_of_ten(&rng, -3, 1);
      for (int k = 0; k < 8; ++k) {
        double p[3];
        float stored[3], as_float[3];
        random_point_near(corners + 9 * (random_bits(&rng) % (uint64_t)n), limit, p);
        if (!store(&f, p, stored, as_float)) continue;
        const double error = kernels_error(f.ratio, f.largest_shift, limit, longest_edge_of(n, corners));
        static const int32_t zeros[n_lanes];
        int32_t triangle[n_lanes];
        for (int i = 0; i < n_lanes; ++i) triangle[i] = i < n ? i : 0;
        kernels_decide(set, n_lanes, zeros, triangle, p, corners, decided);
        kernels_group_distances(set, group, as_float, 0.5 * error, filtered);
        for (int i = 0; i < n_lanes; ++i) {
          const double distance = sqrt(decided[i]);
          if (i >= n) {
            CHECK_AT_MOST(0x1p39, sqrt(filtered[i])); /* no triangle */
            continue;
          }
          if (!(distance <= limit)) continue;
          const double share = (sqrt(filtered[i]) - distance) / error;
          if (!(fabs(share) <= 1))
            fail_msg("%s: filtered %.9g, decided %.17g, error allowed for %.9g", kernels_name(set), sqrt(filtered[i]),
                     distance, error);
          nearer = fmax(nearer, -share), farther = fmax(farther, share);
          ++n_compared;
        }
      }
      kernels_group_free(group);
    }
    printf("%s: %lld distances, nearer by %.3f of the error at most, farther by %.3f\n", kernels_name(set),
           (long long)n_compared, nearer, farther);
    assert_true(is_more(n_compared, 100000));
    /* The proof's error E2 is at most half of the allowed error. */
    CHECK_AT_MOST(nearer, 0.5);
    /* The largest errors are close to the margin, so this check would notice a much smaller margin of the library. */
    CHECK_MET(farther >= 0.4);
  }
}

/* --- A leaf of nodes and its groups of triangles --- */

typedef struct leaf_case {
  enum { max_groups = 24, max_nodes = 32 } sizes;
  int n_groups, n_nodes, n[max_groups];
  double corners[max_groups][9 * 16], points[3 * max_nodes];
  float nodes[3 * max_nodes];
  kernel_group *groups[max_groups];
  kernel_filter filter;
  double error;
} leaf_case;

/* The first triangle has an edge that is perpendicular to the other, parallel triangles. The quantity that chooses the axes of a
 * group is then nearly 0. */
static void first_edge_across(int n, double *corners) {
  double axis[3][3], origin[3];
  random_frame(axis);
  random_point(0.2, origin);
  const double height = random_power_of_ten(&rng, -11.7, -10);
  place(origin, axis, 0, 0, 0, corners);
  place(origin, axis, 0, 0, 0.7, corners + 3);
  place(origin, axis, 0, height, 0.7, corners + 6);
  for (int i = 1; i < n; ++i) {
    double *abc = corners + 9 * i;
    const double e = random_between(&rng, -0.4, 0.4), f = random_between(&rng, -0.4, 0.4),
                 g = random_between(&rng, -0.4, 0.4);
    place(origin, axis, e, f, g, abc);
    place(origin, axis, e + 0.3, f, g, abc + 3);
    place(origin, axis, e, f + 0.3, g, abc + 6);
  }
}

/* Makes small triangles at equal distances from the middle. */
static void on_a_sphere(int n, double *corners) {
  for (int i = 0; i < n; ++i) {
    double axis[3][3];
    const double origin[3] = {0, 0, 0};
    random_frame(axis);
    place(origin, axis, 0.5, 0, 0, corners + 9 * i);
    place(origin, axis, 0.5, 1e-4, 0, corners + 9 * i + 3);
    place(origin, axis, 0.5, 0, 1e-4, corners + 9 * i + 6);
  }
}

enum { with_edge_across, with_ties, all_near, any_at_all, n_cases };
static void make_case(int set, int trial, leaf_case *c) {
  memset(c, 0, sizeof *c);
  const int what = trial % n_cases;
  framed f = random_framed();
  f.ratio = what == with_edge_across ? 4 : fmax(f.ratio, 0x1p-4);
  const double limit = what == all_near           ? 1
                       : what == with_edge_across ? 3
                                                  : random_power_of_ten(&rng, -4, 0.5),
               spread = what == with_ties || what == with_edge_across ? 1
                        : what == all_near                            ? 1e-6
                                                                      : random_power_of_ten(&rng, -3, 0);
  double centre[3];
  const int has_many = what == all_near && trial % (2 * n_cases) >= n_cases; /* the filter's list becomes full */
  c->n_groups = has_many ? max_groups : 1 + (int)(random_bits(&rng) % max_groups);
  for (int g = 0; g < c->n_groups; ++g) {
    c->n[g] = 1 + (int)(random_bits(&rng) % 16);
    if (what == with_edge_across) first_edge_across(c->n[g], c->corners[g]);
    if (what == all_near) on_a_sphere(c->n[g], c->corners[g]);
    for (int i = 0; i < c->n[g] && (what == with_ties || what == any_at_all); ++i)
      random_triangle(what == with_ties ? 5 : (int)(random_bits(&rng) % n_kinds), c->corners[g] + 9 * i);
    c->groups[g] = kernels_group(set, c->n[g], c->corners[g]);
  }
  random_point_near(c->corners[0], limit, centre);
  if (what == all_near) memset(centre, 0, sizeof centre);
  if (what == with_edge_across) random_point(1.5, centre); /* so far away that the angles of axes matter */
  const int wanted = has_many ? max_nodes : 1 + (int)(random_bits(&rng) % max_nodes);
  for (int tries = 0; tries < 1000 && c->n_nodes < wanted; ++tries) {
    double *p = c->points + 3 * c->n_nodes;
    float as_float[3];
    random_point(spread, p);
    for (int i = 0; i < 3; ++i)
      p[i] = what == with_ties ? (double)((int)(random_bits(&rng) % 9) - 4) / 8 : p[i] + centre[i];
    if (store(&f, p, c->nodes + 3 * c->n_nodes, as_float)) ++c->n_nodes;
  }
  const uint32_t there = c->n_nodes == 32 ? UINT32_MAX : (UINT32_C(1) << c->n_nodes) - 1;
  c->filter = (kernel_filter){f.ratio,     {f.shift[0], f.shift[1], f.shift[2]},   limit,      {there, there},
                              c->n_groups, (const kernel_group *const *)c->groups, c->n_nodes, c->nodes};
  for (int leaf = 0; leaf < kernel_leaves && trial % 3 == 0; ++leaf)
    c->filter.wanted[leaf] &= (uint32_t)random_bits(&rng);
  double longest_edge = 0;
  for (int g = 0; g < c->n_groups; ++g) longest_edge = fmax(longest_edge, longest_edge_of(c->n[g], c->corners[g]));
  c->error = kernels_error(f.ratio, f.largest_shift, limit, longest_edge);
}

static void free_case(leaf_case *c) {
  for (int g = 0; g < c->n_groups; ++g) kernels_group_free(c->groups[g]);
}

static double decided_sq(const leaf_case *c, int node, int triangle) {
  double on[3], weight[3];
  return kernel_point_triangle(c->points + 3 * node, c->corners[triangle / 16] + 9 * (triangle % 16), on, weight);
}

TEST(lower_bounds_and_boxes_lose_nothing) {
  for (int set = 0; set < n_kernel_sets; ++set) {
    if (!kernels_there(set)) continue;
    double below = -1;
    int64_t n_near = 0, n_far = 0, n_cleared = 0, n_own_cleared = 0;
    for (int trial = 0; trial < trials_of(3000); ++trial) {
      static leaf_case c;
      static float lower_sq[32 * max_groups];
      uint16_t near[max_groups], own[max_groups], given[max_groups];
      make_case(set, trial, &c);
      if (c.n_nodes == 0) {
        free_case(&c);
        continue;
      }
      c.filter.wanted[0] = UINT32_MAX;
      kernels_lower_bounds(set, &c.filter, lower_sq);
      kernel_filter boxes = c.filter;
      if (boxes.n_nodes > 16) boxes.n_nodes = 16;
      const int any_near = kernels_near_boxes(set, &boxes, near);
      for (int g = 0; g < c.n_groups; ++g) own[g] = given[g] = (uint16_t)(trial % 2 ? 0xffff : random_bits(&rng));
      const int any_own = kernels_near_own_boxes(set, &c.filter, own);
      int expect_near = 0, expect_own = 0;
      for (int g = 0; g < c.n_groups; ++g) {
        if (own[g] & ~given[g]) fail_msg("%s, trial %d: a box comes back", kernels_name(set), trial);
        expect_own |= own[g] != 0;
      }
      assert_int_equal(any_own, expect_own);
      for (int node = 0; node < c.n_nodes; ++node) {
        for (int g = 0; g < c.n_groups; ++g) {
          double distance = INFINITY;
          for (int i = 0; i < c.n[g]; ++i) distance = fmin(distance, sqrt(decided_sq(&c, node, 16 * g + i)));
          if (node < 16 && !(near[g] >> node & 1)) {
            ++n_cleared;
            if (distance <= c.filter.limit) fail_msg("%s, trial %d: a near box is left out", kernels_name(set), trial);
          }
          if (node < 16) expect_near |= near[g] >> node & 1;
          if ((given[g] & ~own[g]) >> node / 2 & 1) {
            ++n_own_cleared;
            if (distance <= c.filter.limit)
              fail_msg("%s, trial %d: a box near by own axes is left out", kernels_name(set), trial);
          }
          if (!(distance <= c.filter.limit)) {
            ++n_far;
            continue;
          }
          ++n_near;
          const double share = (sqrt(lower_sq[32 * g + node]) - distance) / c.error;
          below = fmax(below, share);
          if (!(share <= 0.25)) /* the library allows for twice this error */
            fail_msg("%s, trial %d: a bound from below of %.9g, the distance is %.17g", kernels_name(set), trial,
                     sqrt(lower_sq[32 * g + node]), distance);
        }
      }
      assert_int_equal(any_near, expect_near);
      free_case(&c);
    }
    printf(
        "%s: %lld near nodes and groups, %lld far; left out %lld of boxes, and %lld by the groups' own axes; "
        "bounds are wrong by %.3f of the error\n",
        kernels_name(set), (long long)n_near, (long long)n_far, (long long)n_cleared, (long long)n_own_cleared, below);
    assert_true(is_more(n_near, 10000) && is_more(n_cleared, 10000) && is_more(n_own_cleared, 10000));
  }
}

/* The pairs contain the closest triangle of every node within the limit. If several triangles are equally near, the pairs contain
 * them all. The buffer has room for all pairs, or is so small that the filter must stop and continue. */
TEST(no_pair_that_matters_is_lost) {
  static const int32_t rooms[] = {100000, 16, 64, 65, 79, 200};
  for (int set = 0; set < n_kernel_sets; ++set) {
    if (!kernels_there(set)) continue;
    int64_t n_closest = 0, n_ties = 0, n_left = 0, n_all = 0, n_resumed = 0, n_full = 0;
    for (int trial = 0; trial < trials_of(1500); ++trial) {
      static leaf_case c;
      make_case(set, trial, &c);
      for (size_t k = 0; c.n_nodes > 0 && k < sizeof rooms / sizeof rooms[0]; ++k) {
        static uint8_t has[32 * kernel_leaves][16 * max_groups];
        kernel_pair *pairs;
        int64_t n_calls;
        const int64_t n = kernels_filter(set, &c.filter, rooms[k], &pairs, &n_calls);
        if (n < 0)
          fail_msg("%s, trial %d: writes beyond its room, or names other nodes than it has pairs of", kernels_name(set),
                   trial);
        n_resumed += n_calls > 1;
        /* The filter also stops when its internal list is full. */
        if (k == 0) n_full += n_calls > 1;
        if (k == 0) assert_true(n_calls <= 1 + 32 * kernel_leaves * c.n_groups / 900);
        memset(has, 0, sizeof has);
        for (int64_t i = 0; i < n; ++i) {
          const int node = pairs[i].node % 32, leaf = pairs[i].node / 32;
          if (!(c.filter.wanted[leaf] >> node & 1)) fail_msg("a pair of a node that is not wanted");
          if (has[pairs[i].node][pairs[i].triangle]++) fail_msg("%s, trial %d: a pair twice", kernels_name(set), trial);
        }
        n_left += n;
        for (int node = 0; node < c.n_nodes; ++node) {
          double smallest = INFINITY;
          static double sq[16 * max_groups];
          int n_triangles = 0;
          for (int g = 0; g < c.n_groups; ++g)
            for (int i = 0; i < c.n[g]; ++i, ++n_triangles)
              smallest = fmin(smallest, sq[16 * g + i] = decided_sq(&c, node, 16 * g + i));
          for (int leaf = 0; leaf < kernel_leaves; ++leaf) {
            if (!(c.filter.wanted[leaf] >> node & 1)) continue;
            n_all += n_triangles;
            if (!(sqrt(smallest) <= c.filter.limit / (leaf + 1))) continue;
            int64_t n_of_node = 0;
            for (int g = 0; g < c.n_groups; ++g)
              for (int i = 0; i < c.n[g]; ++i) {
                if (sq[16 * g + i] != smallest) continue;
                ++n_of_node;
                if (!has[32 * leaf + node][16 * g + i])
                  fail_msg("%s, trial %d, room %d: a closest triangle of node %d of leaf %d, at %.17g, is lost",
                           kernels_name(set), trial, rooms[k], node, leaf, sqrt(smallest));
              }
            ++n_closest, n_ties += n_of_node > 1;
          }
        }
        free(pairs);
      }
      free_case(&c);
    }
    printf(
        "%s: %lld nodes, %lld of them with ties; %lld of %lld pairs are left; went on %lld times, %lld lists were "
        "full\n",
        kernels_name(set), (long long)n_closest, (long long)n_ties, (long long)n_left, (long long)n_all,
        (long long)n_resumed, (long long)n_full);
    assert_true(is_more(n_closest, 10000) && is_more(n_ties, 1000) && is_more(n_resumed, 500) && is_more(n_full, 20) &&
                2 * n_left < n_all);
  }
}

/* --- The content of groups ------------------------------------------------------------------------------------------- */

TEST(corners_are_bounded_and_framed) {
  enum { most = 100, n_lanes = 16 };
  for (int set = 0; set < n_kernel_sets; ++set) {
    if (!kernels_there(set)) continue;
    for (int trial = 0; trial < trials_of(2000); ++trial) {
      static double vertices[3 * most], corners[9 * most + 1];
      static int64_t id[3 * most];
      const int64_t n = 1 + (int64_t)(random_bits(&rng) % most);
      double lower[3], upper[3], least[3] = {INFINITY, INFINITY, INFINITY},
                                 greatest[3] = {-INFINITY, -INFINITY, -INFINITY};
      for (int64_t i = 0; i < 3 * most; ++i) {
        vertices[i] = random_between(&rng, -1, 1) * random_power_of_ten(&rng, -3, 3);
        id[i] = (int64_t)(random_bits(&rng) % most);
      }
      corners[9 * n] = 17;
      kernels_take_corners(set, vertices, id, n, corners, lower, upper);
      for (int64_t i = 0; i < 9 * n; ++i) {
        CHECK_SAME(corners[i], vertices[3 * id[i / 3] + i % 3]);
        least[i % 3] = fmin(least[i % 3], corners[i]), greatest[i % 3] = fmax(greatest[i % 3], corners[i]);
      }
      CHECK_SAME(corners[9 * n], 17.0);
      for (int c = 0; c < 3; ++c) {
        CHECK_SAME(lower[c], least[c]);
        CHECK_SAME(upper[c], greatest[c]);
      }
      double in_frame[9 * n_lanes];
      int32_t triangle[n_lanes];
      const int in_group = 1 + (int)(random_bits(&rng) % n_lanes);
      const double centre[3] = {0.1, -0.7, 3}, scale = 0.25;
      for (int i = 0; i < in_group; ++i) triangle[i] = (int32_t)(random_bits(&rng) % (uint64_t)n);
      kernels_frame_group(set, centre, scale, corners, triangle, in_group, in_frame);
      for (int i = 0; i < n_lanes; ++i)
        for (int c = 0; c < 9; ++c) {
          const double x = corners[9 * triangle[i < in_group ? i : 0] + c];
          CHECK_SAME(in_frame[n_lanes * c + i], scale * (x - centre[c % 3]));
        }
    }
  }
}

/* The nodes of a leaf get the bits that a plain loop computes. Some coordinates are far outside the frame, infinite or not
 * numbers. */
TEST(leaves_are_framed) {
  enum { n_nodes = 32 };
  for (int trial = 0; trial < trials_of(5000); ++trial) {
    double nodes[3 * n_nodes], centre[3];
    const double scale = ldexp(1, (int)(random_bits(&rng) % 40) - 20);
    for (int c = 0; c < 3; ++c) centre[c] = random_between(&rng, -1, 1) * random_power_of_ten(&rng, -3, 3);
    for (int i = 0; i < 3 * n_nodes; ++i) nodes[i] = centre[i % 3] + random_between(&rng, -1, 1) / scale;
    if (trial % 3 == 0) {
      const double strange[] = {5 / scale, -1e9 / scale, 1e60, -1e61, -INFINITY, INFINITY, NAN};
      nodes[random_bits(&rng) % (3 * n_nodes)] = strange[random_bits(&rng) % 7];
    }
    for (int set = 0; set < n_kernel_sets; ++set) {
      if (!kernels_there(set)) continue;
      float in_frame[3 * n_nodes], lower[3], upper[3];
      kernels_frame_leaf(set, centre, scale, nodes, in_frame, lower, upper);
      for (int c = 0; c < 3; ++c) {
        float least = INFINITY, greatest = -INFINITY;
        for (int i = 0; i < n_nodes; ++i) {
          const double x = scale * (nodes[3 * i + c] - centre[c]);
          const float expected = (float)(isnan(x) ? -2 : fmin(fmax(x, -2), 2));
          CHECK_SAME(in_frame[n_nodes * c + i], expected);
          least = fminf(least, expected), greatest = fmaxf(greatest, expected);
        }
        CHECK_SAME(lower[c], least);
        CHECK_SAME(upper[c], greatest);
      }
    }
  }
}

/* The triangles' heights are close to the least height. A triangle without area never passes. A triangle with a hundred times the
 * least height always passes. */
TEST(triangles_without_area_are_noticed) {
  for (int set = 0; set < n_kernel_sets; ++set) {
    if (!kernels_there(set)) continue;
    int n_flat = 0, n_high = 0;
    for (int trial = 0; trial < trials_of(20000); ++trial) {
      enum { most = 8 };
      double vertices[9 * most];
      int64_t id[3 * most];
      const int n = 1 + (int)(random_bits(&rng) % most), which = (int)(random_bits(&rng) % (uint64_t)n);
      const double height = random_power_of_ten(&rng, -14, -8), size = random_power_of_ten(&rng, -20, 20);
      for (int i = 0; i < n; ++i) {
        const double h = i == which ? height : 0.5, foot = random_between(&rng, 0, 1);
        const double t[9] = {0, 0, 0, size, 0, 0, foot * size, h * size, 0};
        memcpy(vertices + 9 * i, t, sizeof t);
        for (int k = 0; k < 3; ++k) id[3 * i + k] = 3 * i + (k + trial) % 3;
      }
      const int have_area = kernels_have_area(set, vertices, id, n, 0);
      if (height <= 1e-12) {
        ++n_flat;
        assert_false(have_area);
      } else if (height > 1e-10) {
        ++n_high;
        assert_true(have_area);
      }
    }
    assert_true(is_more(n_flat, 1000) && is_more(n_high, 1000));
  }
}

/* Sums of cubes equal those of a plain loop, and have the same bits with every instruction set. */
TEST(cubes_are_summed) {
  enum { most = 40 };
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 8 * (1 + (int)(random_bits(&rng) % 5));
    double sources[3 * most], weights[3 * most], at[3], expected[12] = {0}, sizes[12] = {0}, sums[15], first[15];
    for (int i = 0; i < 3 * n; ++i) sources[i] = random_between(&rng, -2, 2), weights[i] = random_between(&rng, -1, 1);
    for (int c = 0; c < 3; ++c) at[c] = trial % 10 ? random_between(&rng, -2, 2) : sources[c * n + 1];
    for (int i = 0; i < n; ++i) {
      double d[3], square = 0;
      for (int c = 0; c < 3; ++c) d[c] = at[c] - sources[c * n + i], square += d[c] * d[c];
      for (int c = 0; c < 3; ++c)
        for (int k = 0; k < 4; ++k) {
          const double term = weights[c * n + i] * sqrt(square) * (k == 0 ? square : d[k - 1]);
          expected[3 * k + c] += term, sizes[3 * k + c] += fabs(term);
        }
    }
    int is_first = 1;
    for (int set = 0; set < n_kernel_sets; ++set) {
      if (!kernels_there(set)) continue;
      kernels_sum_cubes(set, n, sources, weights, at, sums);
      for (int i = 0; i < 12; ++i) CHECK_NEAR(sums[i], expected[i], 1e-14 * sizes[i]);
      assert_memory_equal(sums, sums + 12, 3 * sizeof *sums);
      if (is_first) memcpy(first, sums, sizeof sums);
      assert_memory_equal(first, sums, sizeof sums);
      is_first = 0;
    }
  }
}

/* A triangle may pass the check for a shift. If each corner then moves by an eighth of the shift, the triangle still has an
 * area. */
TEST(triangles_keep_their_area_when_corners_move) {
  for (int set = 0; set < n_kernel_sets; ++set) {
    if (!kernels_there(set)) continue;
    int n_passed = 0, n_stopped = 0;
    for (int trial = 0; trial < trials_of(20000); ++trial) {
      const double size = random_power_of_ten(&rng, -20, 20), height = random_power_of_ten(&rng, -13, 0),
                   shift = size * random_power_of_ten(&rng, -13, 0);
      const double foot = random_between(&rng, -1, 2);
      double vertices[9] = {0, 0, 0, size, 0, 0, foot * size, height * size, 0};
      const int64_t id[3] = {trial % 3, (trial + 1) % 3, (trial + 2) % 3};
      if (!kernels_have_area(set, vertices, id, 1, shift)) {
        ++n_stopped;
        continue;
      }
      ++n_passed;
      for (int k = 0; k < 3; ++k) {
        double by[3] = {0, k == 2 ? -1 : 1, 0};  // this direction lowers the height most
        if (trial % 2) random_direction(by);
        for (int c = 0; c < 3; ++c) vertices[3 * k + c] += 0.125 * shift * by[c];
      }
      const double *a = vertices, *b = vertices + 3, *c = vertices + 6;
      double ab[3], ac[3], longest_sq = 0, of_ab = 0, of_ac = 0, of_bc = 0, area_sq = 0;
      for (int k = 0; k < 3; ++k) {
        ab[k] = b[k] - a[k], ac[k] = c[k] - a[k];
        of_ab += ab[k] * ab[k], of_ac += ac[k] * ac[k], of_bc += (c[k] - b[k]) * (c[k] - b[k]);
      }
      longest_sq = fmax(of_ab, fmax(of_ac, of_bc));
      for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        area_sq += (ab[i] * ac[j] - ab[j] * ac[i]) * (ab[i] * ac[j] - ab[j] * ac[i]);
      }
      assert_true(area_sq > 1e-24 * longest_sq * longest_sq);
    }
    assert_true(is_more(n_passed, 1000) && is_more(n_stopped, 1000));
  }
}

/* The kernel's points have the bits of plain products and sums from left to right. Nothing is written after the last point. */
TEST(points_are_placed) {
  enum { most = 20 };
  for (int set = 0; set < n_kernel_sets; ++set) {
    if (!kernels_there(set)) continue;
    for (int trial = 0; trial < trials_of(2000); ++trial) {
      double points[3 * most], placed[3 * most + 3], first[12], second[12];
      const int64_t n = (int64_t)(random_bits(&rng) % (most + 1));
      const double scale = random_power_of_ten(&rng, -2, 2), untouched = 17;
      for (int64_t i = 0; i < n; ++i) random_point(3, points + 3 * i);
      for (int k = 0; k < 12; k += 3) random_point(2, first + k), random_point(2, second + k);
      for (int i = 0; i < 3 * most + 3; ++i) placed[i] = untouched;
      kernels_place_points(set, first, second, scale, n, points, placed);
      for (int64_t i = 0; i < n; ++i) {
        const double *p = points + 3 * i;
        double q[3];
        for (int c = 0; c < 3; ++c) q[c] = p[0] * first[c] + p[1] * first[3 + c] + p[2] * first[6 + c] + first[9 + c];
        for (int c = 0; c < 3; ++c)
          CHECK_SAME(placed[3 * i + c],
                     scale * (q[0] * second[c] + q[1] * second[3 + c] + q[2] * second[6 + c]) + second[9 + c]);
      }
      for (int64_t i = 3 * n; i < 3 * most + 3; ++i) CHECK_SAME(placed[i], untouched);
    }
  }
}

/* --- Without any instruction set ------------------------------------------------------------------------------------- */

/* The portable code is for processors without AVX2, AVX-512 and the baseline's instructions. The portable code does the
 * operations of the baseline set. If the baseline fuses multiplications and additions, its filter rounds differently. The groups
 * are equal even with fused operations, and the tests above check each filter separately. */
TEST(portable_kernels_have_the_bits_of_the_baseline) {
  if (!kernels_there(portable_set)) skip();
  const int rounds_twice = kernels_baseline_rounds_twice();
  static const int32_t rooms[] = {100000, 64};
  enum { n_both = 2 };
  static const int sets[n_both] = {baseline_set, portable_set};
  int64_t n_groups = 0, n_pairs_compared = 0, n_near = 0, n_cleared = 0;
  for (int trial = 0; trial < trials_of(2000); ++trial) {
    static leaf_case c;
    static float lower_sq[n_both][32 * max_groups], distance_sq[n_both][16];
    uint16_t near[n_both][max_groups], own[n_both][max_groups];
    kernel_group *groups[n_both][max_groups];
    int any_near[n_both];
    make_case(baseline_set, trial, &c);
    for (int g = 0; g < c.n_groups; ++g) {
      groups[0][g] = c.groups[g];
      groups[1][g] = kernels_group(portable_set, c.n[g], c.corners[g]);
      if (!kernels_groups_equal(groups[0][g], groups[1][g])) fail_msg("trial %d: other groups", trial);
      ++n_groups;
      if (!rounds_twice) continue;
      float p[3];
      for (int i = 0; i < 3; ++i) p[i] = (float)random_between(&rng, -1, 1);
      for (int k = 0; k < n_both; ++k) kernels_group_distances(sets[k], groups[k][g], p, 0.5 * c.error, distance_sq[k]);
      if (memcmp(distance_sq[0], distance_sq[1], sizeof distance_sq[0]) != 0)
        fail_msg("trial %d: other distances", trial);
    }
    if (c.n_nodes > 0 && rounds_twice) {
      kernel_filter filters[n_both] = {c.filter, c.filter};
      for (int k = 0; k < n_both; ++k) {
        filters[k].groups = (const kernel_group *const *)groups[k];
        kernel_filter boxes = filters[k];
        if (boxes.n_nodes > 16) boxes.n_nodes = 16;
        any_near[k] = kernels_near_boxes(sets[k], &boxes, near[k]);
        memset(own[k], 0xff, sizeof own[k]);
        kernels_near_own_boxes(sets[k], &filters[k], own[k]);
        kernels_lower_bounds(sets[k], &filters[k], lower_sq[k]);
      }
      const size_t n = (size_t)c.n_groups;
      if (any_near[0] != any_near[1] || memcmp(near[0], near[1], n * sizeof near[0][0]) != 0 ||
          memcmp(own[0], own[1], sizeof own[0]) != 0)
        fail_msg("trial %d: other near boxes", trial);
      for (size_t g = 0; g < n; ++g) n_cleared += near[0][g] == 0, n_near += near[0][g] != 0;
      if (memcmp(lower_sq[0], lower_sq[1], 32 * n * sizeof lower_sq[0][0]) != 0)
        fail_msg("trial %d: other bounds", trial);
      for (size_t i = 0; i < sizeof rooms / sizeof rooms[0]; ++i) {
        kernel_pair *pairs[n_both];
        int64_t n_pairs[n_both], n_calls[n_both];
        for (int k = 0; k < n_both; ++k)
          n_pairs[k] = kernels_filter(sets[k], &filters[k], rooms[i], &pairs[k], &n_calls[k]);
        assert_true(n_pairs[0] >= 0);
        if (n_pairs[0] != n_pairs[1] || n_calls[0] != n_calls[1] ||
            memcmp(pairs[0], pairs[1], (size_t)n_pairs[0] * sizeof *pairs[0]) != 0)
          fail_msg("trial %d, room %d: other pairs", trial, rooms[i]);
        n_pairs_compared += n_pairs[0];
        for (int k = 0; k < n_both; ++k) free(pairs[k]);
      }
    }
    for (int g = 0; g < c.n_groups; ++g) kernels_group_free(groups[1][g]);
    free_case(&c);
  }
  printf("%lld groups, %lld pairs; %lld groups near some boxes, %lld near none\n", (long long)n_groups,
         (long long)n_pairs_compared, (long long)n_near, (long long)n_cleared);
  assert_true(is_more(n_groups, 3000));
  if (rounds_twice) assert_true(is_more(n_pairs_compared, 100000) && is_more(n_near, 5000) && is_more(n_cleared, 100));
}

/* --- The order of nodes ---------------------------------------------------------------------------------------------- */

TEST(keys_are_ranked) {
  enum { n_keys = 64 };
  for (int trial = 0; trial < trials_of(5000); ++trial) {
    int32_t key[n_keys], n_less[n_keys];
    const int32_t n = (int32_t)(random_bits(&rng) % (n_keys + 1));
    const uint64_t n_values = trial % 2 ? 10 : UINT64_C(1) << 32; /* many keys are equal, or only a few */
    for (int i = 0; i < n_keys; ++i)
      key[i] = (int32_t)((int64_t)(random_bits(&rng) % n_values) - (trial % 2 ? 5 : INT64_C(1) << 31));
    for (int set = 0; set < n_kernel_sets; ++set) {
      if (!kernels_there(set)) continue;
      memset(n_less, 0x77, sizeof n_less);
      kernels_rank(set, key, n, n_less);
      for (int i = 0; i < n_keys; ++i) {
        int32_t expected = 0;
        for (int32_t k = 0; k < n; ++k) expected += key[k] < key[i];
        if (n_less[i] != expected)
          fail_msg("%s, trial %d: %d of %d keys are less than %d, not %d", kernels_name(set), trial, expected, n,
                   key[i], n_less[i]);
      }
    }
  }
}

/* The arrays have exactly the promised sizes, so a sanitizer notices a read or write beyond them. */
TEST(marked_numbers_are_selected) {
  for (int trial = 0; trial < trials_of(3000); ++trial) {
    const int32_t n = (int32_t)(random_bits(&rng) % 100), bit = (int32_t)(random_bits(&rng) % 16);
    int32_t *numbers = malloc((size_t)n * sizeof *numbers), *to = malloc((size_t)n * sizeof *to);
    uint16_t *marks = malloc((size_t)n * sizeof *marks);
    for (int32_t i = 0; i < n; ++i) {
      numbers[i] = (int32_t)random_bits(&rng);
      /* The tested bit is set nowhere, everywhere, or here and there. All other bits are set at random. */
      const uint64_t has_bit = trial % 4 < 2 ? (uint64_t)(trial % 2) : random_bits(&rng) % 2;
      marks[i] = (uint16_t)((random_bits(&rng) & ~(UINT64_C(1) << bit)) | has_bit << bit);
    }
    for (int set = 0; set < n_kernel_sets; ++set) {
      if (!kernels_there(set)) continue;
      if (n > 0) memset(to, 0x77, (size_t)n * sizeof *to);
      const int32_t n_selected = kernels_select(set, numbers, marks, n, bit, to);
      int32_t n_expected = 0;
      for (int32_t i = 0; i < n; ++i)
        if (marks[i] >> bit & 1 && to[n_expected++] != numbers[i])
          fail_msg("%s, trial %d: number %d of %d, bit %d", kernels_name(set), trial, i, n, bit);
      assert_int_equal(n_selected, n_expected);
    }
    free(numbers), free(to), free(marks);
  }
}

int main(void) {
  rng = random_start("test_kernels");
  return run_cases(NULL, NULL);
}
