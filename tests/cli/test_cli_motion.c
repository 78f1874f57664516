/* SPDX-License-Identifier: Apache-2.0
 *
 * --surface FILE.pvd --time T reads a moving surface at one time. The .pvd lists its frames. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "moving_sheet.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

#define DATA_SET(timestep, file) "<DataSet timestep=\"" timestep "\" file=\"" file "\"/>"

static void write_collection(const char *name, const char *data_sets) {
  char text[1024];
  snprintf(text, sizeof text, "<VTKFile type=\"Collection\"><Collection>%s</Collection></VTKFile>\n", data_sets);
  scratch_write_text(name, text);
}

static int make_frames(void **state) {
  if (make_box(state)) return 1;
  sheet_write("a.vtp", 0, NULL);
  sheet_write("b.vtp", 0.5, NULL);
  sheet_write("c.vtp", 1, NULL);
  write_collection("sheet.pvd", DATA_SET("2", "a.vtp") DATA_SET("2.5", "b.vtp") DATA_SET("3", "c.vtp"));
  write_collection("closed.pvd", DATA_SET("2", "a.vtp") DATA_SET("2.5", "b.vtp") DATA_SET("3", "a.vtp"));
  return 0;
}

/* Compares the vertices and velocities in a file with the moving sheet at a time. `scale` multiplies the sheet's size and
 * velocity, and `speed` multiplies only the velocity. */
static void expect_sheet(const char *path, double time, double speed, double scale) {
  double xyz[3 * sheet_n_vertices], velocity[3 * sheet_n_vertices];
  int64_t n = 0;
  assert_int_equal(shim_read_points(path, &n, NULL, NULL, NULL), 1);
  assert_int_equal(n, sheet_n_vertices);
  assert_int_equal(shim_read_points(path, NULL, NULL, NULL, xyz), 1);
  assert_int_equal(shim_read_array(path, 'p', "riis_velocity", NULL, NULL, NULL, velocity), 1);
  for (int v = 0; v < sheet_n_vertices; ++v) {
    double at[3], by[3];
    sheet_vertex(v, time, at, by);
    for (int k = 0; k < 3; ++k) {
      if (fabs(xyz[3 * v + k] - scale * at[k]) > 1e-13 || fabs(velocity[3 * v + k] - scale * speed * by[k]) > 1e-12)
        fail_msg("vertex %d, %d: at %.17g by %.17g", v, k, xyz[3 * v + k], velocity[3 * v + k]);
    }
  }
}

TEST(test_times) {
  const char *moved = scratch_path("moved.vtp");
  RUN_FINE("surface", "--surface", scratch_path("sheet.pvd"), "--time", "2.125", "--output", moved);
  expect_sheet(moved, 0.125, 1, 1);
  assert_non_null(strstr(program_out, "sheet.pvd, time 2.125: 24 triangles"));
  RUN_FINE("surface", "--surface", scratch_path("sheet.pvd"), "--time", "2.75", "--scale", "2", "--output", moved);
  expect_sheet(moved, 0.75, 1, 2);
  RUN_FINE("surface", "--surface", scratch_path("sheet.pvd"), "--time", "-7", "--output", moved);
  expect_sheet(moved, 0, 0, 1);
  /* With the period, the surface returns to the first frame in half a second. */
  RUN_FINE("surface", "--surface", scratch_path("sheet.pvd"), "--time", "9.25", "--period", "1.5", "--output", moved);
  expect_sheet(moved, 0.5, -2, 1);
  RUN_FINE("surface", "--surface", scratch_path("closed.pvd"), "--time", "2.75", "--period", "1", "--output", moved);
  expect_sheet(moved, 0.25, -1, 1);
}

/* The marks equal those of a file that has the surface at this time. */
TEST(test_marks) {
  static double by_motion[n_box], by_file[n_box];
  sheet_write("now.vtp", 0.25, NULL);
  RUN_FINE("mark", scratch_path("in.vtu"), "--surface", scratch_path("sheet.pvd"), "--time", "2.25", "--half-thickness",
           "0.2", "--leaflets", "connected", "--quiet", "--stats", scratch_path("stats.json"), "--output",
           scratch_path("out.vtu"));
  RUN_FINE("mark", scratch_path("in.vtu"), "--surface", scratch_path("now.vtp"), "--half-thickness", "0.2", "--quiet",
           "--output", scratch_path("file.vtu"));
  assert_int_equal(shim_read_array(scratch_path("out.vtu"), 'p', "riis_distance", NULL, NULL, NULL, by_motion), 1);
  assert_int_equal(shim_read_array(scratch_path("file.vtu"), 'p', "riis_distance", NULL, NULL, NULL, by_file), 1);
  assert_memory_equal(by_motion, by_file, sizeof by_motion);
  char *stats = scratch_read(scratch_path("stats.json"), NULL);
  assert_true(json_number(stats, "time") == 2.25);
  assert_true(json_number(stats, "n_leaflets") == 1);
  assert_true(json_number(stats, "n_marked") > 5);
  free(stats);
  RUN_FINE("mark", scratch_path("in.vtu"), "--surface", scratch_path("sheet.pvd"), "--time", "2.25", "--half-thickness",
           "0.2", "--leaflets", "riis_leaflet", "--quiet", "--stats", scratch_path("stats.json"));
  stats = scratch_read(scratch_path("stats.json"), NULL);
  assert_true(json_number(stats, "n_leaflets") == 2);
  free(stats);
}

TEST(test_usage) {
  const char *motion = scratch_path("sheet.pvd"), *still = scratch_path("a.vtp"), *moved = scratch_path("moved.vtp");
  RUN_REFUSED(2, "sheet.pvd is a motion: it needs --time T", "surface", "--surface", motion, "--output", moved);
  RUN_REFUSED(2, "--time has no effect with --surface", "surface", "--surface", still, "--time", "0", "--output",
              moved);
  RUN_REFUSED(2, "--time requires --surface", "surface", "--valve", "mitral", "--time", "0", "--output", moved);
  RUN_REFUSED(2, "--period needs a motion that repeats: --surface FILE.pvd, --surface FILE.dat or --cycle", "surface",
              "--period", "1", "--output", moved);
  RUN_REFUSED(2, "it needs --time T", "surface", "--surface", motion, "--period", "1", "--output", moved);
  RUN_REFUSED(2, "--time: 'soon' is not a number", "surface", "--surface", motion, "--time", "soon", "--output", moved);
  RUN_REFUSED(2, "--time is nan; it must be finite", "surface", "--surface", motion, "--time", "nan", "--output",
              moved);
  RUN_REFUSED(2, "--time is 2e+30; it must be finite", "surface", "--surface", motion, "--time", "2e30", "--output",
              moved);
  RUN_REFUSED(2, "--period: 0 is not above 0", "surface", "--surface", motion, "--time", "0", "--period", "0",
              "--output", moved);
  RUN_REFUSED(2, "--period: nan is not above 0", "surface", "--surface", motion, "--time", "0", "--period", "nan",
              "--output", moved);
  RUN_REFUSED(2, "--period is inf", "surface", "--surface", motion, "--time", "0", "--period", "inf", "--output",
              moved);
  RUN_REFUSED(2, "--period: the time of key 2 is 3, beyond the period of 0.75", "surface", "--surface", motion,
              "--time", "0", "--period", "0.75", "--output", moved);
  /* A frame is an input, so no output may replace it. */
  RUN_REFUSED(2, "b.vtp is a frame of --surface ", "surface", "--surface", motion, "--time", "2", "--output",
              scratch_path("b.vtp"));
}

TEST(test_bad_data) {
  const char *moved = scratch_path("moved.vtp");
  RUN_REFUSED(1, "missing.pvd: cannot be read: No such file", "surface", "--surface", scratch_path("missing.pvd"),
              "--time", "0", "--output", moved);
  RUN_REFUSED(1, "sheet.pvd: vertex 0 in the last frame, one period after the first frame, has the ", "surface",
              "--surface", scratch_path("sheet.pvd"), "--time", "0", "--period", "1", "--output", moved);
  write_collection("lost.pvd", DATA_SET("0", "a.vtp") DATA_SET("1", "lost.vtp"));
  RUN_REFUSED(1, "lost.vtp: cannot be read: No such file", "surface", "--surface", scratch_path("lost.pvd"), "--time",
              "0", "--output", moved);
  RUN_REFUSED(1, "a.vtp: has no cell array part", "surface", "--surface", scratch_path("sheet.pvd"), "--time", "0",
              "--leaflets", "part", "--output", moved);
}

int main(void) { return run_cases(make_frames, scratch_teardown); }
