/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests the area and the edge of the part of an outline that triangles leave uncovered. Area and edge are compared with closed
 * forms and with counts of points. */
#include "plane_cover_shim.h"
#include "test_support.h"

static const double pi = 3.14159265358979323846;
enum { n_lines = 2048, n_edge_lines = 512 }; /* the values of the library */

static void rotated(double x, double y, double angle, const double *centre, double *to) {
  to[0] = centre[0] + cos(angle) * x - sin(angle) * y;
  to[1] = centre[1] + sin(angle) * x + cos(angle) * y;
}

TEST(test_circle) {
  const double centre[2] = {0.3, -7}, radius = 1.29, area = pi * radius * radius;
  double last = 1;
  for (int n = 64; n <= n_lines; n *= 2) {
    const double error = fabs(shim_circle_area(radius, centre, n) / area - 1);
    CHECK_AT_MOST(error, pow(n, -1.5));
    CHECK_AT_MOST(error, last / 2.5); /* twice as many lines divide the error by nearly 2 to the power of 1.5 */
    last = error;
    CHECK_NEAR(shim_uncovered_circle(radius, centre, 0, NULL, n), shim_circle_area(radius, centre, n), 1e-13);
  }
  CHECK_AT_MOST(last, 1e-5);
}

/* A flat ring covers the circle, except for a hole with m corners. */
TEST(test_ring) {
  enum { m = 90 };
  random_source random = random_start("test_plane_cover");
  static double corners[2 * m][6];
  for (int turn = 0; turn < trials_of(24); ++turn) {
    const double centre[2] = {random_between(&random, -2, 2), random_between(&random, -2, 2)};
    const double radius = random_between(&random, 0.5, 2), hole = radius * random_between(&random, 0.2, 0.9);
    const double first = random_between(&random, 0, 2 * pi), step = 2 * pi / m;
    for (int i = 0; i < m; ++i) {
      const double a = first + i * step, b = first + (i + 1) * step, outer = 1.1 * radius;
      rotated(hole, 0, a, centre, corners[2 * i]);
      rotated(outer, 0, a, centre, corners[2 * i] + 2);
      rotated(outer, 0, b, centre, corners[2 * i] + 4);
      rotated(hole, 0, a, centre, corners[2 * i + 1]);
      rotated(outer, 0, b, centre, corners[2 * i + 1] + 2);
      rotated(hole, 0, b, centre, corners[2 * i + 1] + 4);
    }
    const double area = 0.5 * m * hole * hole * sin(step), spacing = 2 * radius / n_lines;
    /* The bound is the error for a round hole, whose edge crosses all lines, plus the error of edges that are parallel to the
     * lines. Two such edges may occur, each with an error of half a spacing. */
    const double bound = area * pow(2 * hole / spacing, -1.5) + spacing * hole * step;
    CHECK_NEAR(shim_uncovered_circle(radius, centre, 2 * m, corners[0], n_lines), area, bound);
  }
}

/* A half plane through the centre covers half the circle, in any direction. The lines run along x, so an edge along x is the
 * worst case. */
TEST(test_half) {
  random_source random = random_start("test_plane_cover");
  for (int turn = 0; turn < trials_of(60); ++turn) {
    const double centre[2] = {random_between(&random, -2, 2), random_between(&random, -2, 2)};
    const double radius = 1.1, angle = turn < 4 ? turn * pi / 2 : random_between(&random, 0, 2 * pi);
    const double up = turn % 2 ? random_between(&random, -0.5, 0.5) : 0; /* distance from the centre to the edge */
    double corners[6];
    rotated(-20, up, angle, centre, corners);
    rotated(20, up, angle, centre, corners + 2);
    rotated(0, 40, angle, centre, corners + 4);
    const double part = radius * radius * acos(-up / radius) + up * sqrt(radius * radius - up * up);
    const double strip = 2 * radius * radius / n_lines; /* area of a strip, half a spacing by twice the radius */
    CHECK_NEAR(shim_uncovered_circle(radius, centre, 1, corners, n_lines), part, strip + 1e-5);
  }
}

static int is_in_triangle(const double *c, double x, double y) {
  int n_left = 0;
  for (int k = 0; k < 3; ++k) {
    const double *a = c + 2 * k, *b = c + 2 * ((k + 1) % 3);
    n_left += (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) >= 0;
  }
  return n_left == 0 || n_left == 3;
}

/* Random overlapping triangles, inside a square and inside a circle, are compared with a grid of points. */
TEST(test_random) {
  enum { n_side = 600, n_triangles = 12 };
  const double square[4][6] = {{-1, -1, 0, 1, -1, 5}, {1, -1, 5, 1, 1, 0}, {-1, 1, 2, 1, 1, 0}, {-1, -1, 0, -1, 1, 2}};
  const double origin[2] = {0, 0};
  random_source random = random_start("test_plane_cover");
  for (int turn = 0; turn < 6; ++turn) {
    double corners[n_triangles][6];
    for (int i = 0; i < 6 * n_triangles; ++i) corners[i / 6][i % 6] = random_between(&random, -1.3, 1.3);
    int n_in_square = 0, n_in_circle = 0;
    for (int i = 0; i < n_side * n_side; ++i) {
      const double x = (2 * (i % n_side) + 1.0) / n_side - 1, y = (2 * (i / n_side) + 1.0) / n_side - 1;
      int is_covered = 0;
      for (int k = 0; k < turn + 1 && !is_covered; ++k) is_covered = is_in_triangle(corners[k], x, y);
      n_in_square += !is_covered;
      n_in_circle += !is_covered && x * x + y * y < 1;
    }
    const double cell = 4.0 / (n_side * n_side), error = 0.02; /* 40 edges of length 2 in a grid of cells of 1/300 */
    CHECK_NEAR(shim_uncovered_inside(4, square[0], turn + 1, corners[0], n_lines), cell * n_in_square, error);
    CHECK_NEAR(shim_uncovered_circle(1, origin, turn + 1, corners[0], n_lines), cell * n_in_circle, error);
  }
}

TEST(test_open_lines) {
  const double lines[3][6] = {{0, 0, 0, 1, 0, 0}, {1, 0, 0, 0, 1, 0}, {0, 1, 1, 0, 0, 0}};
  CHECK_NEAR(shim_uncovered_inside(3, lines[0], 0, NULL, n_lines), 0.5, 1e-12);
  assert_true(shim_uncovered_inside(2, lines[0], 0, NULL, n_lines) == -1);
  assert_true(shim_uncovered_inside(0, NULL, 0, NULL, n_lines) == -1);
  /* Triangles that are seen edge on cover nothing, whether they lie along x, along y or slanted. */
  for (int i = 0; i < 4; ++i) {
    const double x = i % 2 ? 0.3 : 0, y = i / 2 ? 0.7 : 0;
    const double flat[3][6] = {{0, 0, 0, x, y, 0}, {x, y, 0, 2 * x, 2 * y, 1}, {2 * x, 2 * y, 1, 0, 0, 0}};
    assert_true(shim_uncovered_inside(3, flat[0], 0, NULL, n_lines) == -1);
  }
  /* Triangles that are lines along x or y up to rounding also cover nothing. */
  const double near_x[3][6] = {{0, 0, 0, 1, 1e-16, 0}, {1, 1e-16, 0, 2, -1e-16, 1}, {2, -1e-16, 1, 0, 0, 0}};
  const double near_y[3][6] = {{0, 0, 0, 1e-16, 1, 0}, {1e-16, 1, 0, -1e-16, 2, 1}, {-1e-16, 2, 1, 0, 0, 0}};
  assert_true(shim_uncovered_inside(3, near_x[0], 0, NULL, n_lines) == -1);
  assert_true(shim_uncovered_inside(3, near_y[0], 0, NULL, n_lines) == -1);
}

/* Two triangles begin in one point of a line, at edges of different slopes. Only one of the two edges counts, and the order of
 * the triangles does not decide which. */
TEST(test_order_of_triangles) {
  const double line = 1.0 / n_edge_lines, origin[2] = {0, 0}; /* a line of the upper half passes here */
  const double upright[6] = {-0.5, line - 0.25, -0.5, line + 0.25, 0.5, line + 0.125};
  const double slanted[6] = {-0.75, line - 0.5, -0.25, line + 0.5, 0.5, line + 0.25};
  double xy[12];
  memcpy(xy, upright, sizeof upright);
  memcpy(xy + 6, slanted, sizeof slanted);
  const int64_t one_order[6] = {0, 1, 2, 3, 4, 5}, other_order[6] = {3, 4, 5, 0, 1, 2};
  const double edge = shim_edge_beyond(1, origin, 6, xy, 2, one_order, 0);
  assert_true(edge > 1);
  assert_true(edge == shim_edge_beyond(1, origin, 6, xy, 2, other_order, 0));
}

/* A round plate in the circle grows, so the ring around it shrinks. In other trials, a plate with a round hole grows, so the hole
 * shrinks. */
TEST(test_growing) {
  enum { m = 720 };
  const int n_turns = trials(4, 8);
  static double xy[2 * (2 * m + 1)];
  static int64_t ids[3 * 2 * m];
  random_source random = random_start("test_plane_cover");
  const double step = 2 * pi / m;
  for (int turn = 0; turn < n_turns; ++turn) {
    const double centre[2] = {random_between(&random, -2, 2), random_between(&random, -2, 2)};
    const double radius = random_between(&random, 0.5, 2), size = radius * random_between(&random, 0.3, 0.7);
    const double reach = size * random_between(&random, 0.05, 0.3), first = random_between(&random, 0, 2 * pi);
    const int is_plate = turn % 2; /* otherwise a ring round a hole */
    for (int i = 0; i < m; ++i) {
      rotated(size, 0, first + i * step, centre, xy + 2 * i);
      rotated(is_plate ? 0 : 1.2 * radius, 0, first + i * step, centre, xy + 2 * (m + i));
      const int next = (i + 1) % m, apart = turn % 4 < 2; /* both windings */
      const int64_t a[3] = {i, apart ? m + i : next, apart ? next : m + i}, b[3] = {next, m + i, m + next};
      memcpy(ids + 6 * i, a, sizeof a);
      memcpy(ids + 6 * i + 3, b, sizeof b);
    }
    const double edge = is_plate ? size + reach : size - reach; /* the radius of the edge after the growth */
    const double area = is_plate ? pi * (radius * radius - edge * edge) : pi * edge * edge;
    CHECK_NEAR(shim_area_beyond(radius, centre, 2 * m, xy, 2 * m, ids, reach), area, 2e-4 * pi * radius * radius);
    CHECK_NEAR(shim_edge_beyond(radius, centre, 2 * m, xy, 2 * m, ids, reach), 2 * pi * edge,
               16 * radius / n_edge_lines); /* one spacing for each end of eight arcs */
    CHECK_NEAR(shim_area_beyond(radius, centre, 2 * m, xy, 2 * m, ids, 2 * radius), 0, 0);
    CHECK_NEAR(shim_edge_beyond(radius, centre, 2 * m, xy, 2 * m, ids, 2 * radius), 0, 0);
  }
}

/* A turned square plate grows. The plate's edge then includes arcs round the corners. */
TEST(test_growing_square) {
  random_source random = random_start("test_plane_cover");
  const int64_t ids[6] = {0, 1, 2, 0, 2, 3};
  for (int turn = 0; turn < trials_of(24); ++turn) {
    const double centre[2] = {random_between(&random, -2, 2), random_between(&random, -2, 2)};
    const double half = 0.5, reach = turn % 3 ? random_between(&random, 0.01, 0.2) : 0;
    const double angle = turn < 4 ? turn * pi / 4 : random_between(&random, 0, 2 * pi);
    double xy[8];
    rotated(-half, -half, angle, centre, xy);
    rotated(half, -half, angle, centre, xy + 2);
    rotated(half, half, angle, centre, xy + 4);
    rotated(-half, half, angle, centre, xy + 6);
    const double area = pi - (4 * half * half + 8 * half * reach + pi * reach * reach);
    CHECK_NEAR(shim_area_beyond(1, centre, 4, xy, 2, ids, reach), area, 2e-3);
    CHECK_NEAR(shim_edge_beyond(1, centre, 4, xy, 2, ids, reach), 8 * half + 2 * pi * reach, 16 * 2.0 / n_edge_lines);
  }
}

int main(void) { return run_cases(NULL, NULL); }
