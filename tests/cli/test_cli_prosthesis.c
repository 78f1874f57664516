/* SPDX-License-Identifier: Apache-2.0
 *
 * The example of a user-defined valve exists as prosthesis.json, .c and .f90. All three files define one valve. The valve's
 * leaflets never cross, and the closed valve has no hole. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "marks.h"
#include "program.h"
#include "scratch.h"
#include "test_support.h"
#include "vtk_shim.h"

/* This file contains the control points and the function valve_with() of the example. */
#define main prosthesis_main
#define xyz prosthesis_xyz
#include RIIS_EXAMPLE_C
#undef xyz
#undef main

#define EXAMPLE_JSON RIIS_EXAMPLES "/prosthesis.json"

/* The triangles that the program wrote: their vertices, corners and leaflets. */
enum { most_vertices = 8192, most_triangles = 16384 };
static struct {
  int64_t n_triangles;
  double corner[most_triangles][3][3];
  int leaflet[most_triangles];
} shown;

static void read_surface(void) {
  static double points[3 * most_vertices], leaflets[most_triangles];
  static int64_t ids[3 * most_triangles];
  int64_t n_points = 0;
  const char *path = scratch_path("out.vtp");
  assert_int_equal(shim_read_points(path, &n_points, &shown.n_triangles, NULL, NULL), 1);
  assert_true(n_points <= most_vertices && shown.n_triangles <= most_triangles && shown.n_triangles > 100);
  assert_int_equal(shim_read_points(path, NULL, NULL, NULL, points), 1);
  assert_int_equal(shim_read_corners(path, ids), 3 * shown.n_triangles);
  assert_int_equal(shim_read_array(path, 'c', "riis_leaflet", NULL, NULL, NULL, leaflets), 1);
  for (int64_t i = 0; i < shown.n_triangles; ++i) {
    for (int k = 0; k < 3; ++k) memcpy(shown.corner[i][k], points + 3 * ids[3 * i + k], sizeof shown.corner[i][k]);
    shown.leaflet[i] = (int)leaflets[i];
  }
}

/* Lets the program make the valve of this file at this opening, and reads the result. */
static void show(const char *file, double opening) {
  char text[32];
  snprintf(text, sizeof text, "%.17g", opening);
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", file, "--opening", text, "--surface-output",
           scratch_path("out.vtp"), "--quiet");
  read_surface();
}

static long double dot(const long double *a, const long double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const long double *a, const long double *b, long double *c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

static void difference(const double *a, const double *b, long double *c) {
  for (int k = 0; k < 3; ++k) c[k] = (long double)a[k] - b[k];
}

/* Returns how deep the segment from p to q goes through the triangle, or at most 0 if it does not. The depth is the least of
 * three distances: from each end to the triangle's plane, and from the crossing point to the triangle's edges. */
static long double depth_of_segment(const double *p, const double *q, double triangle[3][3]) {
  long double ab[3], ac[3], normal[3], ap[3], aq[3];
  difference(triangle[1], triangle[0], ab);
  difference(triangle[2], triangle[0], ac);
  cross(ab, ac, normal);
  const long double size = sqrtl(dot(normal, normal));
  difference(p, triangle[0], ap);
  difference(q, triangle[0], aq);
  const long double up = dot(ap, normal) / size, uq = dot(aq, normal) / size;
  if (up * uq >= 0) return 0;
  long double depth = fminl(fabsl(up), fabsl(uq));
  for (int k = 0; k < 3; ++k) {
    const double *from = triangle[k];
    long double edge[3], inwards[3], fp[3], fq[3];
    difference(triangle[(k + 1) % 3], from, edge);
    cross(normal, edge, inwards);
    difference(p, from, fp);
    difference(q, from, fq);
    const long double inside = (dot(fp, inwards) * uq - dot(fq, inwards) * up) / (uq - up);
    depth = fminl(depth, inside / sqrtl(dot(inwards, inwards)));
  }
  return depth;
}

static int boxes_are_apart(double a[3][3], double b[3][3]) {
  for (int k = 0; k < 3; ++k) {
    if (fmax(fmax(a[0][k], a[1][k]), a[2][k]) < fmin(fmin(b[0][k], b[1][k]), b[2][k])) return 1;
    if (fmax(fmax(b[0][k], b[1][k]), b[2][k]) < fmin(fmin(a[0][k], a[1][k]), a[2][k])) return 1;
  }
  return 0;
}

/* Returns the greatest depth at which triangles of different leaflets go through each other. Tries all pairs and all edges. */
static double deepest_crossing(void) {
  long double deepest = 0;
  for (int64_t i = 0; i < shown.n_triangles; ++i) {
    for (int64_t j = 0; j < i; ++j) {
      double(*a)[3] = shown.corner[i], (*b)[3] = shown.corner[j];
      if (shown.leaflet[i] == shown.leaflet[j] || boxes_are_apart(a, b)) continue;
      for (int k = 0; k < 3; ++k) {
        deepest = fmaxl(deepest, depth_of_segment(a[k], a[(k + 1) % 3], b));
        deepest = fmaxl(deepest, depth_of_segment(b[k], b[(k + 1) % 3], a));
      }
    }
  }
  return (double)deepest;
}

/* Returns the largest distance of a vertex outside its leaflet's third of the ring. Half planes from the axis through the
 * commissures bound each third. A third is convex, so a triangle is inside if its corners are. */
static double farthest_outside(void) {
  static const double commissure[3][2] = {{0.60, -1.04}, {0.60, 1.04}, {-1.20, 0.00}};
  double farthest = 0;
  for (int64_t i = 0; i < shown.n_triangles; ++i) {
    const double *begin = commissure[shown.leaflet[i]], *end = commissure[(shown.leaflet[i] + 1) % 3];
    for (int k = 0; k < 3; ++k) {
      const double *p = shown.corner[i][k];
      farthest = fmax(farthest, -(begin[0] * p[1] - begin[1] * p[0]) / 1.2);
      farthest = fmax(farthest, -(p[0] * end[1] - p[1] * end[0]) / 1.2);
    }
  }
  return farthest;
}

/* Returns whether the vertical line through (x, y) meets a triangle, or passes a triangle within the tolerance. */
static int is_covered(double x, double y, double tolerance) {
  for (int64_t i = 0; i < shown.n_triangles; ++i) {
    double(*c)[3] = shown.corner[i];
    const double area = (c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]);
    int inside = 1;
    for (int k = 0; k < 3 && inside; ++k) {
      const double *a = c[k], *b = c[(k + 1) % 3];
      const double side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
      inside = copysign(1, area) * side >= -tolerance * hypot(b[0] - a[0], b[1] - a[1]);
    }
    if (inside) return 1;
  }
  return 0;
}

/* Returns how many vertical lines of a grid meet no triangle. The grid covers the disc inside the ring, around the axis. The
 * ring's radius is 1.2, and its polygon is off by at most 0.01. Extra rows lie on the lines where leaflets meet. */
static int n_uncovered(void) {
  const double radius = 1.19, tolerance = 1e-9;
  int n_missed = 0;
  for (int i = -100; i <= 100; ++i)
    for (int j = -100; j <= 100; ++j)
      if (i * i + j * j <= 100 * 100) n_missed += !is_covered(radius * i / 100, radius * j / 100, tolerance);
  for (int i = 0; i <= 1000; ++i)
    for (int k = 0; k < 3; ++k)
      n_missed += !is_covered(closed_moving[8 * k][0] * i / 1010, closed_moving[8 * k][1] * i / 1010, tolerance);
  return n_missed;
}

static const double rounding = 1e-13; /* in cm; leaflets that meet may overlap by the rounding of their coordinates */

TEST(test_no_crossing) {
  const int n_steps = is_long_test() ? 100 : 20;
  for (int i = 0; i <= n_steps; ++i) {
    show(EXAMPLE_JSON, (double)i / n_steps);
    if (deepest_crossing() > rounding)
      fail_msg("leaflets cross by %.3g at opening %d/%d", deepest_crossing(), i, n_steps);
    if (farthest_outside() > rounding)
      fail_msg("a leaflet leaves its third by %.3g at opening %d/%d", farthest_outside(), i, n_steps);
  }
}

TEST(test_closed) {
  show(EXAMPLE_JSON, 0);
  assert_int_equal(n_uncovered(), 0);
}

/* Writes v.json, which is the example with another closed end of leaflet 0's free edges. */
static void write_with_end(const char *end) {
  static const char *const keys[] = {"\"edge 0a\"", "\"edge 0b\"", "\"middle 0\""};
  static const char axis[] = "[0.00, 0.00, 0.80]";
  static char changed[65536];
  char *text = scratch_read(EXAMPLE_JSON, NULL);
  const char *from = text;
  size_t length = 0;
  for (int i = 0; i < 3; ++i) {
    const char *key = strstr(from, keys[i]), *found = key ? strstr(key, axis) : NULL;
    if (!found) fail_msg("%s has no %s any more behind %s", EXAMPLE_JSON, axis, keys[i]);
    length += (size_t)sprintf(changed + length, "%.*s%s", (int)(found - from), from, end);
    from = found + strlen(axis);
  }
  strcpy(changed + length, from);
  scratch_write_text("v.json", changed);
  free(text);
}

/* Planted faults show that the checks above can fail. */
TEST(test_faults_are_found) {
  char file[256];
  snprintf(file, sizeof file, "%s", scratch_path("v.json"));
  write_with_end("[0.00, 0.00, 0.80]");
  show(file, 0);
  assert_int_equal(n_uncovered(), 0);
  show(file, 0.01);
  assert_true(n_uncovered() > 0);
  write_with_end("[-0.01, 0.00, 0.80]");
  show(file, 0);
  assert_true(deepest_crossing() > 1e-3);
  assert_true(farthest_outside() > 1e-3);
  write_with_end("[0.01, 0.00, 0.80]");
  show(file, 0);
  assert_true(n_uncovered() > 0);
  assert_true(deepest_crossing() <= rounding);
}

/* The file and the C program give equal triangles and marks. */
TEST(test_file_is_c) {
  riis_valve *valve = valve_with(closed_moving), *open = valve_with(open_moving);
  riis_surface_options options;
  char text[32];
  expect_fine(riis_valve_set_open_state(valve, open));
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 0.2;
  for (int i = 0; i <= 4; ++i) {
    snprintf(text, sizeof text, "%g", 0.25 * i);
    expect_fine(riis_valve_set_scalar(valve, "opening", 0.25 * i));
    mark_by_c(valve, &options, RIIS_AUTO, RIIS_FAR_DISTANCE);
    RUN_FINE("mark", scratch_path("in.vtu"), "--valve", EXAMPLE_JSON, "--opening", text, "--half-thickness", "0.2",
             "--output", scratch_path("out.vtu"), "--surface-output", scratch_path("out.vtp"), "--quiet");
    expect_marked_mesh();
    expect_surface_output();
  }
  riis_valve_destroy(&valve);
  riis_valve_destroy(&open);
}

/* Reads the numbers of a source's array initializers. A line with numbers begins with blanks and then a number or a brace. */
static int numbers_of(const char *path, double *numbers, int n_most) {
  char *text = scratch_read(path, NULL);
  int n_found = 0;
  for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
    const char *p = line + strspn(line, " {");
    if (line[0] != ' ' || !*p || !strchr("-0123456789", *p) || !strchr(p, '.')) continue;
    while (*p && *p != '/' && *p != '&') {
      char *end = NULL;
      const double value = strtod(p, &end);
      if (end == p) {
        ++p;
        continue;
      }
      assert_true(n_found < n_most);
      numbers[n_found++] = value;
      p = end + 2 * (strncmp(end, "d0", 2) == 0);
    }
  }
  free(text);
  return n_found;
}

/* The C and the Fortran program have the same control points. Another test compares the output of both programs. */
TEST(test_fortran_is_c) {
  enum { n_all = 3 * (30 + 30 + 30), n_most = 2 * n_all };
  double of_c[n_most], of_fortran[n_most];
  assert_int_equal(numbers_of(RIIS_EXAMPLES "/prosthesis.c", of_c, n_most), n_all);
  assert_int_equal(numbers_of(RIIS_EXAMPLES "/prosthesis.f90", of_fortran, n_most), n_all);
  for (int i = 0; i < n_all; ++i)
    if (of_c[i] != of_fortran[i])
      fail_msg("number %d is %g in prosthesis.c, %g in prosthesis.f90", i, of_c[i], of_fortran[i]);
  assert_memory_equal(of_c, closed_moving, sizeof closed_moving);
  assert_memory_equal(of_c + 90, open_moving, sizeof open_moving);
  assert_memory_equal(of_c + 180, fixed, sizeof fixed);
}

static int make_prosthesis_box(void **state) {
  return make_box_of(state, (double[3]){-1.3, -1.3, -0.2}, (double[3]){1.3, 1.3, 1.4});
}

static int destroy_all(void **state) {
  forget_marks();
  return scratch_teardown(state);
}

int main(void) { return run_cases(make_prosthesis_box, destroy_all); }
