/* SPDX-License-Identifier: Apache-2.0
 *
 * Runs the program on structured grids. The program's reports and files equal those for a .vtu with the grid's nodes and
 * cells. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "grids_shim.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_along = 21, n_nodes = n_along * n_along * n_along };

static double axis[n_along];

static shim_grid image_with(double spacing) {
  shim_grid grid = {.n = {n_along, n_along - 2, n_along - 1}, .first = {-10, -9, -9}, .spacing = {1, 1, 1}};
  for (int c = 0; c < 3; ++c) grid.spacing[c] = spacing;
  return grid;
}

/* Returns the statistics without their seconds. The caller frees them. */
static char *stats_of(const char *name) {
  char *text = scratch_read(scratch_path(name), NULL), *seconds = strstr(text, "\"seconds\"");
  assert_non_null(seconds);
  const char *rest = strchr(seconds, '}');
  memmove(seconds, rest, strlen(rest) + 1);
  return text;
}

/* Returns the lines of a report, from the line `from` to the line with the seconds. The caller frees them. */
static char *report_from(const char *from) {
  char *text = strdup(strstr(program_out, from));
  *strstr(text, "\nseconds ") = 0;
  return text;
}

static void expect_same_array(char where, const char *name) {
  static double values[2][4 * n_nodes];
  static const char *const files[2] = {"grid_out.vtu", "cells_out.vtu"};
  char type[2][32];
  int64_t n_components[2], n[2];
  for (int i = 0; i < 2; ++i)
    assert_true(shim_read_array(scratch_path(files[i]), where, name, type[i], &n_components[i], &n[i], values[i]));
  assert_string_equal(type[0], type[1]);
  assert_int_equal(n[0], n[1]);
  assert_int_equal(n_components[0], n_components[1]);
  assert_memory_equal(values[0], values[1], (size_t)(n[0] * n_components[0]) * sizeof(double));
}

static char mark_leaks[longest_output]; /* the warning of the last mark */

/* Writes a grid and a .vtu of its cells, marks both, and compares everything. */
static void expect_same(const char *name, const shim_grid *grid, const char *option, const char *value) {
  const char *const files[2] = {name, "cells.vtu"}, *const stats[2] = {"grid.json", "cells.json"};
  const char *const outputs[2] = {"grid_out.vtu", "cells_out.vtu"};
  char *texts[2], *reports[2];
  assert_int_equal(shim_write_grid(scratch_path(name), SHIM_RAW, grid), 1);
  assert_int_equal(shim_write_grid_as_cells(scratch_path("cells.vtu"), grid), 1);
  static char leaks[2][longest_output];
  for (int i = 0; i < 2; ++i) {
    run_program("mark", scratch_path(files[i]), "--opening", "0", "--resistance", "3", option, value, "--quiet",
                "--stats", scratch_path(stats[i]), "--output", scratch_path(outputs[i]), NULL);
    if (program_exit_code != 0) fail_msg("%s: %s", files[i], program_err);
    strcpy(leaks[i], program_leaks);
    texts[i] = stats_of(stats[i]);
  }
  assert_string_equal(leaks[0], leaks[1]);
  strcpy(mark_leaks, leaks[0]);
  if (strcmp(texts[0], texts[1]) != 0) fail_msg("%s: %s\n%s", name, texts[0], texts[1]);
  for (int i = 0; i < 2; ++i) free(texts[i]);
  expect_same_array('p', "value");
  expect_same_array('c', "sample");
  expect_same_array('p', "riis_marked");
  expect_same_array('p', "riis_distance");
  expect_same_array('p', "riis_leaflet");
  expect_same_array('p', "riis_K");
  for (int i = 0; i < 2; ++i) {
    run_program("check", "leaks", scratch_path(files[i]), "--valve", "trileaflet", "--between", "0,0,-1.5", "0,0,1.7",
                "--first-passage", "--half-thickness", "0.25", NULL);
    if (program_exit_code != 0) fail_msg("%s: %s", files[i], program_err);
    strcpy(leaks[i], program_leaks);
    reports[i] = report_from("\nleaks ");
  }
  assert_string_equal(leaks[0], leaks[1]);
  assert_string_equal(reports[0], reports[1]);
  for (int i = 0; i < 2; ++i) free(reports[i]);
}

TEST(test_marks) {
  shim_grid grid = image_with(0.21);
  expect_same("grid.vti", &grid, "--search", "clusters");
  assert_string_equal(mark_leaks, "");
  /* The edges are longer than two half thicknesses, so they leak. */
  grid = image_with(0.45);
  expect_same("grid.vti", &grid, "--search", "clusters");
  assert_string_not_equal(mark_leaks, "");
  for (int i = 0; i < n_along; ++i) axis[i] = 2.2 * tanh(0.2 * (i - 9.5));
  for (int c = 0; c < 3; ++c) grid.x[c] = axis;
  expect_same("grid.vtr", &grid, "--distance", "minimization");
  grid.is_curved = 1, grid.bend = 0.02;
  expect_same("grid.vts", &grid, "--search", "exhaustive");
  grid = image_with(0.21);
  grid.turn = 0.4;
  expect_same("grid.vti", &grid, "--search", "neighbor");
}

/* Runs by cells, series and parts of the mesh need points. The files of these runs equal those of the .vtu. */
TEST(test_cells_and_series) {
  const shim_grid grid = image_with(0.21);
  assert_int_equal(shim_write_grid(scratch_path("grid.vti"), SHIM_RAW, &grid), 1);
  assert_int_equal(shim_write_grid_as_cells(scratch_path("cells.vtu"), &grid), 1);
  scratch_write_text("beat.csv", "0,0\n0.5,1\n1,0\n");
  const char *const files[2] = {"grid.vti", "cells.vtu"}, *const outputs[2] = {"grid_out.vtu", "cells_out.vtu"};
  const char *const series[2] = {"grid.pvd", "cells.pvd"};
  for (int i = 0; i < 2; ++i) {
    RUN_FINE("mark", scratch_path(files[i]), "--cells", "--output", scratch_path(outputs[i]), "--quiet");
    RUN_FINE("mark", scratch_path(files[i]), "--cycle", scratch_path("beat.csv"), "--times", "0.1:0.4:0.1", "--quiet",
             "--output", scratch_path(series[i]));
  }
  expect_same_array('c', "riis_distance");
  assert_true(scratch_is_same("grid/grid_0002.vtu", "cells/cells_0002.vtu"));
  RUN_FINE("mark", scratch_path("grid.vti"), "--cells", "--output", scratch_path("marked.vti"), "--quiet");
  RUN_REFUSED(2, "--cells-where: no volume cell has such a value of sample", "mark", scratch_path("grid.vti"),
              "--cells-where", "sample=7");
}

/* For a grid of axes, the marks go to a .vti or a .vtr. The program can read this file again. */
TEST(test_output) {
  shim_grid grid = image_with(0.21);
  assert_int_equal(shim_write_grid(scratch_path("grid.vti"), SHIM_RAW, &grid), 1);
  static double values[2][n_nodes], x[3][n_along];
  double *const axes[3] = {x[0], x[1], x[2]};
  int n[3];
  const char *const names[2] = {"marked.vti", "marked.vtr"};
  for (int i = 0; i < 2; ++i) {
    RUN_FINE("mark", scratch_path("grid.vti"), "--resistance", "2", "--output", scratch_path(names[i]), "--quiet");
    assert_int_equal(shim_read_grid(scratch_path(names[i]), n, axes, "riis_K", values[i]), 1);
    assert_int_equal(n[1], n_along - 2);
    RUN_REFUSED(2, "already has an array riis_marked: write --replace", "mark", scratch_path(names[i]), "--output",
                scratch_path("o.vtu"));
  }
  assert_memory_equal(values[0], values[1], sizeof values[0]);
  RUN_REFUSED(2, "marked.vti must end in .vtu", "mark", scratch_path("in.vtu"), "--output", scratch_path("marked.vti"));
  grid.turn = 0.4;
  assert_int_equal(shim_write_grid(scratch_path("turned.vti"), SHIM_RAW, &grid), 1);
  RUN_REFUSED(1, "marked.vti: takes a mesh that was read as an image, with ascending axes", "mark",
              scratch_path("turned.vti"), "--quiet", "--output", scratch_path("marked.vti"));
}

TEST(test_refused) {
  const shim_grid grid = image_with(0.21);
  assert_int_equal(shim_write_grid(scratch_path("grid.vti"), SHIM_RAW, &grid), 1);
  static const char *const searches[2] = {"neighbor", "paper"};
  for (int i = 0; i < 2; ++i)
    RUN_REFUSED(2, "grid.vti is a grid, whose nodes are not stored, so this search cannot walk from node to node",
                "mark", scratch_path("grid.vti"), "--search", searches[i]);
  RUN_REFUSED(1, "grid.pvti: a mesh must be a .vtu, .vtk, .vti", "mark", scratch_path("grid.pvti"));
  shim_grid thin = grid;
  thin.n[2] = 1;
  assert_int_equal(shim_write_grid(scratch_path("thin.vti"), SHIM_RAW, &thin), 1);
  RUN_WITHOUT_CELLS("mark", scratch_path("thin.vti"), "--allow-none");
}

int main(void) { return run_cases(make_box, scratch_teardown); }
