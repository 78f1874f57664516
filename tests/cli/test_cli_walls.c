/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests walls of skirts: volume meshes, holes, other axes, and gaps that grow while the valve opens. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_round = 48, n_along = 40 };

/* A tube around an axis parallel to z, in centimetres. The tube may lack a square. */
typedef struct tube {
  double x, y, radius, growth; /* the radius grows with z */
  int is_closed, hole;         /* the layer of a hole, or -1 for no hole */
} tube;

static void tube_point(const tube *t, int i, int k, double *p) {
  const double turn = 2 * acos(-1) * i / n_round, z = -3 + 7.0 * k / n_along, r = t->radius + t->growth * z;
  p[0] = t->x + r * cos(turn), p[1] = t->y + r * sin(turn), p[2] = z;
}

static void write_triangle(FILE *file, const double *a, const double *b, const double *c) {
  fprintf(file, "facet normal 0 0 0\nouter loop\nvertex %.9g %.9g %.9g\nvertex %.9g %.9g %.9g\nvertex %.9g %.9g %.9g\n",
          a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]);
  fputs("endloop\nendfacet\n", file);
}

static const char *write_tube(const char *name, const tube *t) {
  FILE *file = fopen(scratch_path(name), "w");
  assert_non_null(file);
  fputs("solid wall\n", file);
  for (int k = 0; k < n_along; ++k)
    for (int i = 0; i < n_round; ++i) {
      if (k == t->hole && i == 5) continue;
      double p[4][3];
      for (int c = 0; c < 4; ++c) tube_point(t, i + (c == 1 || c == 2), k + (c > 1), p[c]);
      write_triangle(file, p[0], p[1], p[2]);
      write_triangle(file, p[0], p[2], p[3]);
    }
  for (int end = 0; end < 2 && t->is_closed; ++end)
    for (int i = 0; i < n_round; ++i) {
      double p[2][3];
      for (int c = 0; c < 2; ++c) tube_point(t, i + c, end ? n_along : 0, p[c]);
      const double centre[3] = {t->x, t->y, p[0][2]};
      write_triangle(file, p[end], p[1 - end], centre);
    }
  fputs("endsolid wall\n", file);
  assert_int_equal(fclose(file), 0);
  return scratch_path(name);
}

/* Makes the surface of a valve with a skirt to a wall. */
static void skirt_to(const char *wall, const char *skirt, const char *translate) {
  static char path[256];
  snprintf(path, sizeof path, "%s", wall);
  run_program("surface", "--valve", "coapting", "--skirt", skirt, "--wall", path, "--translate", translate, "--output",
              scratch_path("skirt.vtp"), NULL);
}

TEST(test_holes) {
  const tube whole = {0, 0, 1.6, 0, 1, -1};
  skirt_to(write_tube("wall.stl", &whole), "1", "0,0,0");
  expect_run_fine(__FILE__, __LINE__);
  tube one = whole;
  one.is_closed = 0; /* the ends of a vessel are not holes */
  skirt_to(write_tube("wall.stl", &one), "1", "0,0,0");
  expect_run_fine(__FILE__, __LINE__);
  for (int is_closed = 0; is_closed < 2; ++is_closed)
    for (one.hole = 1; one.hole < n_along - 1; one.hole += 6) {
      one.is_closed = is_closed;
      double p[3];
      tube_point(&one, 5, one.hole, p);
      skirt_to(write_tube("wall.stl", &one), "1", "0,0,0");
      assert_int_equal(program_exit_code, 0);
      const char *const text = strstr(program_err, "wall.stl: the wall has a hole of 4 edges at ");
      double at[3];
      if (!text || sscanf(text, "wall.stl: the wall has a hole of 4 edges at %lf %lf %lf", at, at + 1, at + 2) != 3)
        fail_msg("stderr: %s", program_err);
      for (int k = 0; k < 3; ++k) assert_true(fabs(at[k] - p[k]) < 0.3);
      assert_true(strchr(program_err, '\n')[1] == 0);
    }
}

/* Writes a valve that cannot open, in the closed state of the example's patches. */
static void write_closed_state(const char *name) {
  char text[8192];
  FILE *file = fopen(RIIS_EXAMPLES "/prosthesis.json", "r");
  assert_non_null(file);
  const size_t n = fread(text, 1, sizeof text - 1, file);
  assert_true(n < sizeof text - 1 && fclose(file) == 0);
  text[n] = 0;
  char *const open = strstr(text, ",\n  \"open\"");
  assert_non_null(open);
  strcpy(open, "}\n");
  scratch_write_text(name, text);
}

TEST(test_hole_beside_a_valve_that_does_not_open) {
  write_closed_state("closed.json");
  tube one = {0, 0, 1.6, 0, 1, 13};
  char wall[256];
  snprintf(wall, sizeof wall, "%s", write_tube("wall.stl", &one));
  run_program("surface", "--valve", scratch_path("closed.json"), "--skirt", "1", "--wall", wall, "--output",
              scratch_path("skirt.vtp"), NULL);
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_err, "wall.stl: the wall has a hole of 4 edges at "));
}

TEST(test_other_axes) {
  const tube wall = {-3, -2, 1.6, 0, 1, -1};
  skirt_to(write_tube("wall.stl", &wall), "1", "-3,-2,0");
  expect_run_fine(__FILE__, __LINE__);
  skirt_to(write_tube("wall.stl", &wall), "1", "3,2,0");
  assert_int_equal(program_exit_code, 1);
  assert_non_null(strstr(program_err, "the wall is not within --skirt, 1, at "));
  assert_non_null(strstr(program_err,
                         "; after half a turn about z the wall would be within --skirt, so the valve and the wall are "
                         "in different axes, LPS and RAS: give both the same axes\n"));
  scratch_write_text("placed.json",
                     "{\"valve\": \"coapting\", \"unit\": \"cm\", \"axes\": \"LPS\", \"rotate\": [0, 0, 1, 0], "
                     "\"translate\": [3, 2, 0], \"parameters\": {}}");
  run_program("check", "crossings", "--valve", scratch_path("placed.json"), "--skirt", "1.2345678901234567", "--wall",
              write_tube("wall.stl", &wall), NULL);
  assert_non_null(strstr(program_err, "the wall is not within --skirt, 1.23457, at "));
  assert_non_null(strstr(program_err, " axes, LPS and RAS: place the valve by riis place --axes RAS\n"));
}

TEST(test_volume_mesh_as_wall) {
  assert_int_equal(
      shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 6, (double[3]){-2, -1.8, -3}, (double[3]){2, 1.9, 4}, 0), 1);
  skirt_to(scratch_path("box.vtu"), "2", "0,0,0");
  expect_run_fine(__FILE__, __LINE__);
  char line[256];
  const char *const text = strstr(program_out, "skirt     to the wall, ");
  assert_non_null(text);
  snprintf(line, sizeof line, "%.*s", (int)strcspn(text, "\n"), text);
  /* Writes a box as a surface of twelve triangles. */
  FILE *file = fopen(scratch_path("box.stl"), "w");
  assert_non_null(file);
  fputs("solid box\n", file);
  static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (int f = 0; f < 6; ++f) {
    double p[4][3];
    for (int c = 0; c < 4; ++c) {
      p[c][0] = faces[f][c] & 1 ? 2 : -2;
      p[c][1] = faces[f][c] & 2 ? 1.9 : -1.8;
      p[c][2] = faces[f][c] & 4 ? 4 : -3;
    }
    write_triangle(file, p[0], p[1], p[2]);
    write_triangle(file, p[0], p[2], p[3]);
  }
  fputs("endsolid box\n", file);
  assert_int_equal(fclose(file), 0);
  skirt_to(scratch_path("box.stl"), "2", "0,0,0");
  expect_run_fine(__FILE__, __LINE__);
  if (!strstr(program_out, line)) fail_msg("%s\n%s", line, program_out);
  /* A damaged surface and a mesh without volumes are refused as walls. */
  scratch_write_text("few.vtk",
                     "# vtk DataFile Version 3.0\nfew\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 double\n"
                     "1 0 0 2 0 0\nCELLS 1 3\n2 0 1\nCELL_TYPES 1\n3\n");
  skirt_to(scratch_path("few.vtk"), "2", "0,0,0");
  assert_int_equal(program_exit_code, 1);
  assert_non_null(strstr(program_err, "few.vtk: "));
  skirt_to(scratch_path("none.vtu"), "2", "0,0,0");
  assert_int_equal(program_exit_code, 1);
  assert_non_null(strstr(program_err, "none.vtu"));
}

/* The open state has a smaller root, so its attachment is farther from the wall. */
TEST(test_wall_at_all_openings) {
  const tube wall = {0, 0, 1.8, 0, 1, -1};
  char path[256], open_state[256];
  snprintf(path, sizeof path, "%s", write_tube("wall.stl", &wall));
  scratch_write_text("open.json", "{\"root_radius\": 1.15, \"commissure_radius\": 1.15}");
  snprintf(open_state, sizeof open_state, "%s", scratch_path("open.json"));
  for (int i = 0; i < 2; ++i) {
    run_program("surface", "--valve", "coapting", "--params-open", open_state, "--opening", "0", "--skirt",
                i ? "0.7" : "0.6", "--wall", path, "--output", scratch_path("skirt.vtp"), NULL);
    if (i) expect_run_fine(__FILE__, __LINE__);
    if (i) continue;
    assert_int_equal(program_exit_code, 1);
    assert_non_null(strstr(program_err,
                           "wall.stl: at the opening 0.6 the wall is not within --skirt, 0.6: the widest "
                           "gap is 0.61"));
  }
  RUN_FINE("surface", "--valve", "coapting", "--skirt", "0.6", "--wall", path, "--output", scratch_path("skirt.vtp"));
}

TEST(test_lengths_in_another_unit) {
  const tube wall = {0, 0, 1.6, 0, 1, -1};
  skirt_to(write_tube("wall.stl", &wall), "12", "0,0,0");
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_err, "--skirt: 12 is longer than the valve, whose largest side is "));
  for (int i = 0; i < 2; ++i) {
    run_program(i ? "surface" : "size-field", i ? "--output" : scratch_path("f.dat"),
                i ? scratch_path("s.vtp") : "--unit", i ? "--unit" : "m", i ? "m" : "--half-thickness",
                i ? "--half-thickness" : "1", i ? "1" : NULL, NULL);
    assert_non_null(strstr(program_err, "the half thickness is 1, the largest side of the surface 0.02"));
    assert_non_null(strstr(program_err, ": write --half-thickness 0.001\n"));
  }
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
