/* SPDX-License-Identifier: Apache-2.0 */
#include "internals.h"
#include "oracle.h"
#include "test_support.h"

/* The sides of a curved square, in the order v0, v1, u0, u1. The sides meet at their ends. The parameters are 0 0.3 0.6 1 along u
 * and 0 0.5 0.6 1 along v, as in the paper. */
static const double side_v0[12] = {0, 0, 0, 3, 0, 0, 6, 0, 0, 10, 0, 0};
static const double side_v1[12] = {0, 8, 2, 5, 8, 2, 6, 8, 2, 10, 8, 2};
static const double side_u0[9] = {0, 0, 0, 0, 4, 3, 0, 8, 2};
static const double side_u1[6] = {10, 0, 0, 10, 8, 2};
static const int64_t sizes[4] = {4, 4, 3, 2};
static const double *const sides[4] = {side_v0, side_v1, side_u0, side_u1};

TEST(parameters_are_merged_as_in_the_paper) {
  quad_grid grid = coons_grid(sizes, sides, 1e-9);
  const double expected[5] = {0, 0.3, 0.5, 0.6, 1};
  const int64_t n_u = grid.n_u, n_v = grid.n_v;
  double u[5];
  if (n_u == 5) memcpy(u, grid.u, sizeof u);
  quad_grid_free(&grid);
  assert_int_equal(n_u, 5);
  assert_int_equal(n_v, 3);
  for (int i = 0; i < 5; ++i) CHECK_NEAR(u[i], expected[i], 1e-15);
}

TEST(boundary_is_the_polylines_to_the_last_bit) {
  quad_grid grid = coons_grid(sizes, sides, 0);
  double p[3];
  int different = 0;
  for (int64_t i = 0; i < grid.n_u; ++i) {
    polyline_evaluate(sizes[0], side_v0, grid.u[i], p);
    different += memcmp(p, grid.points + 3 * i, sizeof p) != 0;
    polyline_evaluate(sizes[1], side_v1, grid.u[i], p);
    different += memcmp(p, grid.points + 3 * ((grid.n_v - 1) * grid.n_u + i), sizeof p) != 0;
  }
  for (int64_t j = 0; j < grid.n_v; ++j) {
    polyline_evaluate(sizes[2], side_u0, grid.v[j], p);
    different += memcmp(p, grid.points + 3 * j * grid.n_u, sizeof p) != 0;
    polyline_evaluate(sizes[3], side_u1, grid.v[j], p);
    different += memcmp(p, grid.points + 3 * (j * grid.n_u + grid.n_u - 1), sizeof p) != 0;
  }
  quad_grid_free(&grid);
  assert_int_equal(different, 0);
}

/* Compares the grid with the Coons formula of the polylines at any (u, v). The grid is exact, because the formula is bilinear
 * between its lines. */
TEST(surface_equals_the_coons_formula_everywhere) {
  random_source rng = random_start("test_coons");
  for (int trial = 0; trial < 500; ++trial) {
    const double u = random_between(&rng, 0, 1), v = random_between(&rng, 0, 1);
    double got[3], c0[3], c1[3], d0[3], d1[3];
    coons_evaluate(sizes, sides, u, v, got);
    polyline_evaluate(sizes[0], side_v0, u, c0);
    polyline_evaluate(sizes[1], side_v1, u, c1);
    polyline_evaluate(sizes[2], side_u0, v, d0);
    polyline_evaluate(sizes[3], side_u1, v, d1);
    for (int c = 0; c < 3; ++c) {
      const double p00 = side_v0[c], p10 = side_v0[9 + c], p01 = side_v1[c], p11 = side_v1[9 + c];
      const double expected = (1 - v) * c0[c] + v * c1[c] + (1 - u) * d0[c] + u * d1[c] - (1 - u) * (1 - v) * p00 -
                              u * (1 - v) * p10 - (1 - u) * v * p01 - u * v * p11;
      CHECK_NEAR(got[c], expected, 1e-13);
    }
  }
  double corner[3];
  coons_evaluate(sizes, sides, 1, 1, corner); /* the paper's rule finds no grid cell at u = v = 1 */
  for (int c = 0; c < 3; ++c) CHECK_NEAR(corner[c], side_v1[9 + c], 0);
}

TEST(nearly_equal_parameters_share_a_line) {
  const double v0[9] = {0, 0, 0, 0.5, 0, 0, 1, 0, 0}, v1[9] = {0, 1, 0, 0.5001, 1, 0, 1, 1, 0};
  const double u0[6] = {0, 0, 0, 0, 1, 0}, u1[6] = {1, 0, 0, 1, 1, 0};
  const int64_t n[4] = {3, 3, 2, 2};
  const double *const points[4] = {v0, v1, u0, u1};
  quad_grid apart = coons_grid(n, points, 1e-6), together = coons_grid(n, points, 1e-3);
  const int64_t n_apart = apart.n_u, n_together = together.n_u;
  /* The two vertices on the side keep their bits, because the neighbour on this side has the same vertices. */
  const int kept = memcmp(together.points + 3, v0 + 3, 3 * sizeof(double)) == 0 &&
                   memcmp(together.points + 3 * (n_together + 1), v1 + 3, 3 * sizeof(double)) == 0;
  quad_grid_free(&apart);
  quad_grid_free(&together);
  assert_int_equal(n_apart, 4);
  assert_int_equal(n_together, 3);
  assert_true(kept);
}

TEST(a_collapsed_side_gives_no_parameters) {
  const double v0[6] = {0, 0, 0, 0, 0, 0}, v1[9] = {-1, 1, 0, 0.25, 1, 0, 1, 1, 0};
  const double u0[6] = {0, 0, 0, -1, 1, 0}, u1[6] = {0, 0, 0, 1, 1, 0};
  const int64_t n[4] = {2, 3, 2, 2};
  const double *const points[4] = {v0, v1, u0, u1};
  quad_grid grid = coons_grid(n, points, 0);
  const int64_t n_u = grid.n_u;
  double at_root = 0;
  for (int64_t i = 0; i < 3 * grid.n_u; ++i) at_root += fabs(grid.points[i]);
  quad_grid_free(&grid);
  assert_int_equal(n_u, 3);
  CHECK_NEAR(at_root, 0, 0);
}

TEST(kappa_of_known_quads) {
  const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {1, 1, 0}, d[3] = {0, 1, 0}, lifted[3] = {1, 1, 1},
               wide[3] = {3, 1, 0};
  CHECK_NEAR(quad_kappa(a, b, c, d), 0, 0);
  CHECK_NEAR(quad_kappa(a, b, lifted, d), 0.25, 1e-16);
  CHECK_NEAR(quad_kappa(a, b, wide, d), 0.5, 1e-16); /* a planar trapezoid */
}

static void bilinear(const double (*q)[3], double s, double t, double *point) {
  for (int c = 0; c < 3; ++c)
    point[c] = (1 - s) * (1 - t) * q[0][c] + s * (1 - t) * q[1][c] + s * t * q[2][c] + (1 - s) * t * q[3][c];
}

static double distance(const double *p, const double *q) { return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]); }

/* For a fixed t, the bilinear quad is a segment. Returns the exact distance from p to this segment. */
static double distance_to_line_of_quad(const double (*q)[3], double t, const double *p) {
  double along = 0, length_sq = 0, a[3], b[3], at[3];
  bilinear(q, 0, t, a);
  bilinear(q, 1, t, b);
  for (int c = 0; c < 3; ++c) along += (p[c] - a[c]) * (b[c] - a[c]), length_sq += (b[c] - a[c]) * (b[c] - a[c]);
  bilinear(q, length_sq > 0 ? fmin(fmax(along / length_sq, 0), 1) : 0, t, at);
  return distance(at, p);
}

/* Returns the distance to the bilinear quad, which is at most 2e-7 above the true value and never below it. Between t and t', a
 * point of a segment moves by at most |t - t'| times the longer side along t. The distance at the middle of an interval therefore
 * shows whether the interval can contain the nearest point. If it can, the interval is halved. (A search that follows only its
 * best point can end in a wrong minimum.) */
static double distance_to_bilinear(const double (*q)[3], const double *p) {
  const double speed = fmax(distance(q[0], q[3]), distance(q[1], q[2]));
  double best = INFINITY, from[64], width[64];
  int n = 1;
  for (from[0] = 0, width[0] = 1; n > 0;) {
    const double begin = from[--n], half = width[n] / 2;
    const double here = distance_to_line_of_quad(q, begin + half, p);
    best = fmin(best, here);
    if (here - speed * half >= best - 2e-7) continue;
    from[n] = begin, width[n++] = half;
    from[n] = begin + half, width[n++] = half;
  }
  return best;
}

/* Each point of either surface is within the bound of the other surface. The quads have all shapes from flat to folded. */
TEST(triangles_stay_within_the_split_error) {
  random_source rng = random_start("test_coons split");
  int n_tighter = 0;
  double largest = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double bend = pow(10, random_between(&rng, -3, 0)), shape = random_between(&rng, 0, 1.5);
    double q[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 3; ++c) q[k][c] += (c == 2 ? bend : shape * 0.5) * random_between(&rng, -1, 1);
    if (trial % 8 == 0) memcpy(q[2], q[3], sizeof q[2]); /* a collapsed side */
    const double bound = quad_split_error(q[0], q[1], q[2], q[3]);
    CHECK_AT_MOST(bound, quad_kappa(q[0], q[1], q[2], q[3]));
    n_tighter += bound < 0.7 * quad_kappa(q[0], q[1], q[2], q[3]);
    double triangles[2][9];
    for (int c = 0; c < 3; ++c) {
      triangles[0][c] = triangles[1][c] = q[0][c];
      triangles[0][3 + c] = q[1][c];
      triangles[0][6 + c] = triangles[1][3 + c] = q[2][c];
      triangles[1][6 + c] = q[3][c];
    }
    for (int k = 0; k < 40; ++k) {
      const double s = random_between(&rng, 0, 1), t = random_between(&rng, 0, 1);
      double p[3];
      bilinear(q, s, t, p);
      const double from_quad =
          (double)fminl(oracle_point_triangle(p, triangles[0]), oracle_point_triangle(p, triangles[1]));
      const double w[3] = {1 - fmax(s, t), fabs(s - t), fmin(s, t)};
      for (int c = 0; c < 3; ++c)
        p[c] = w[0] * triangles[k % 2][c] + w[1] * triangles[k % 2][3 + c] + w[2] * triangles[k % 2][6 + c];
      const double from_triangles = k < 10 ? distance_to_bilinear(q, p) : 0;
      CHECK_AT_MOST(from_quad, bound + 1e-6);
      CHECK_AT_MOST(from_triangles, bound + 1e-6);
      if (bound > 1e-4) largest = fmax(largest, fmax(from_quad, from_triangles) / bound);
    }
  }
  printf("%d of 400 bounds are tighter than kappa; at most %.2f of the bound\n", n_tighter, largest);
  assert_true(n_tighter > 100);
  assert_true(largest > 0.5);
}

int main(void) { return run_cases(NULL, NULL); }
