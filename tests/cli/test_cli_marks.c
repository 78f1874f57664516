/* SPDX-License-Identifier: Apache-2.0
 *
 * Compares the files that riis writes with results of the C interface on the same mesh. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "marks.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

TEST(test_defaults) {
  riis_valve *valve = NULL;
  expect_fine(riis_valve_create("aortic", &valve));
  mark_by_c(valve, NULL, RIIS_AUTO, RIIS_FAR_DISTANCE);
  riis_valve_destroy(&valve);
  RUN_FINE("mark", scratch_path("in.vtu"), "--output", scratch_path("out.vtu"), "--surface-output",
           scratch_path("out.vtp"));
  expect_marked_mesh();
  expect_surface_output();
  assert_non_null(strstr(program_out, "2,197 nodes"));
  assert_non_null(strstr(program_out, "aortic valve"));
}

TEST(test_every_number) {
  riis_valve *valve = NULL;
  riis_surface_options options;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_valve_set_scalar(valve, "root_radius", 1.3));
  expect_fine(riis_valve_set_scalar(valve, "right.leaflet_angle", 60));
  const double shift[3] = {0.1, -0.05, -0.9};
  expect_fine(riis_valve_set(valve, "left.translation", 3, shift));
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 0.17;
  options.tolerance = 0.4;
  options.scale = 1.1;
  options.rotation_axis[0] = 1;
  options.rotation_axis[1] = -2;
  options.rotation_axis[2] = 0.5;
  options.rotation_angle = -12.5;
  options.translation[0] = -0.1;
  options.translation[2] = -0.2;
  options.flip_normals = 1;
  mark_by_c(valve, &options, 0.35, -2.5);
  riis_valve_destroy(&valve);
  RUN_FINE("mark", "--set", "root_radius=1.3", "--set", "right.leaflet_angle=60", scratch_path("in.vtu"), "--set",
           "left.translation=0.1,-0.05,-0.9", "--half-thickness", "0.17", "--tolerance", ".4", "--scale", "1.1",
           "--rotate", "1,-2,0.5,-12.5", "--translate", "-0.1,0,-2e-1", "--flip-normals", "--distance-limit", "0.35",
           "--far-distance", "-2.5", "--search", "exhaustive", "--threads", "1", "--output", scratch_path("out.vtu"),
           "--surface-output", scratch_path("out.vtp"), "--stats", scratch_path("stats.json"), "--quiet");
  expect_marked_mesh();
  expect_surface_output();
  assert_string_equal(program_out, "");
  char *json = scratch_read(scratch_path("stats.json"), NULL);
  riis_surface_info info;
  expect_fine(riis_surface_get_info(by_c.surface, &info, sizeof info));
  assert_true(json_number(json, "n_nodes") == n_box);
  assert_true(json_number(json, "n_marked") == (double)by_c.stats.n_marked);
  assert_true(json_number(json, "n_within_limit") == (double)by_c.stats.n_within_limit);
  assert_true(by_c.stats.n_within_limit > by_c.stats.n_marked);
  assert_true(json_number(json, "n_triangles") == (double)info.n_triangles);
  assert_true(json_number(json, "area") == info.area);
  assert_true(json_number(json, "half_thickness") == 0.17);
  assert_true(json_number(json, "distance_limit") == 0.35);
  assert_true(json_number(json, "threads") == 1);
  assert_true(json_has_text(json, "search", "\"exhaustive\""));
  assert_true(json_has_text(json, "complete", "true"));
  const char *stages[] = {"read", "surface", "scene", "mesh", "adjacency", "search", "leaks", "write", "picture"};
  const char *seconds = strstr(json, "\"seconds\": {");
  assert_non_null(seconds);
  for (size_t i = 0; i < sizeof stages / sizeof stages[0]; ++i) {
    const double value = json_number(seconds, stages[i]);
    assert_true(value >= 0 && value < 3600);
  }
  free(json);
}

TEST(test_stats_on_stdout) {
  RUN_FINE("mark", scratch_path("in.vtu"), "--stats", "-");
  assert_true(program_out[0] == '{' && strcmp(program_out + strlen(program_out) - 3, "\n}\n") == 0);
  assert_true(json_number(program_out, "n_nodes") == n_box);
}

/* A run with --surface reads the written surface, and finds the marks, triangles and leaflets of the first run. */
TEST(test_surface_from_file) {
  riis_valve *valve = NULL;
  riis_surface_options options;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 0.2;
  mark_by_c(valve, &options, 0.3, RIIS_FAR_DISTANCE);
  riis_valve_destroy(&valve);
  /* The half thickness changes the triangles, because the tolerance depends on it. */
  RUN_FINE("surface", "--half-thickness", "0.2", "--output", scratch_path("out.vtp"));
  RUN_FINE("mark", scratch_path("in.vtu"), "--surface", scratch_path("out.vtp"), "--half-thickness", "0.2",
           "--distance-limit", "0.3", "--output", scratch_path("out.vtu"));
  expect_marked_mesh();
  assert_non_null(strstr(program_out, "out.vtp: "));
}

TEST(test_one_of_each) {
  scratch_write_text("one.vtk",
                     "# vtk DataFile Version 3.0\none\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 double\n0 0 0\n"
                     "CELLS 1 2\n1 0\nCELL_TYPES 1\n1\n");
  scratch_write_text("one.stl",
                     "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                     "endloop\nendfacet\nendsolid\n");
  RUN_WITHOUT_CELLS("mark", scratch_path("one.vtk"), "--surface", scratch_path("one.stl"), "--threads", "1");
  assert_non_null(strstr(program_out, "one.stl: 1 triangle, area 0.5\n"));
  assert_non_null(strstr(program_out, "one.vtk: 1 node, 1 cell\n"));
  assert_non_null(strstr(program_out, "1 node within the half thickness 0.1\n"));
  assert_non_null(strstr(program_out, "1 thread\n"));
}

/* A run without marks has a special exit code, which the user can turn into 0. All requested files are written. */
TEST(test_no_marks) {
  run_program("mark", scratch_path("in.vtu"), "--translate", "9,9,9", "--stats", scratch_path("none.json"), "--output",
              scratch_path("none.vtu"), NULL);
  assert_int_equal(program_exit_code, 3);
  assert_non_null(strstr(program_err, "riis: no node is marked: the mesh is in x"));
  assert_non_null(strstr(program_err, "see --translate"));
  assert_ptr_equal(strchr(program_err, '\n') + 1, program_err + strlen(program_err));
  assert_non_null(strstr(program_out, "0 nodes within the half thickness"));
  char *json = scratch_read(scratch_path("none.json"), NULL);
  assert_true(json_number(json, "n_marked") == 0);
  free(json);
  assert_int_equal(shim_read_array(scratch_path("none.vtu"), 'p', "riis_marked", NULL, NULL, NULL, NULL), 1);
  RUN_FINE("mark", scratch_path("in.vtu"), "--translate", "9,9,9", "--allow-none");
  /* The paper's search may miss nodes, and does not find any node here. The program reports both facts. */
  run_program("mark", scratch_path("in.vtu"), "--translate", "9,9,9", "--search", "paper", NULL);
  assert_int_equal(program_exit_code, 3);
  assert_non_null(strstr(program_err, "riis: the marks may be incomplete"));
  assert_non_null(strstr(program_err, "riis: no node is marked"));
}

TEST(test_legacy_mesh) {
  const double lower[3] = {-1.5, -1.5, -1}, upper[3] = {1.5, 1.5, 0};
  assert_int_equal(shim_write_box(scratch_path("in.vtk"), SHIM_LEGACY_BINARY, 6, lower, upper, 0), 1);
  RUN_FINE("mark", scratch_path("in.vtk"), "--output", scratch_path("from_legacy.vtu"), "--half-thickness", "0.3");
  int64_t n = 0;
  assert_int_equal(shim_read_array(scratch_path("from_legacy.vtu"), 'p', "riis_marked", NULL, NULL, &n, NULL), 1);
  assert_int_equal(n, 216);
}

static int destroy_all(void **state) {
  forget_marks();
  return scratch_teardown(state);
}

/* --resistance writes K of every node beside its distance. The test computes K by the formula of docs/theory/marks.md. */
TEST(test_resistance) {
  static double distance[n_box], resistance[n_box];
  const double R = 10, eps = 0.3, pi = acos(-1);
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "aortic", "--half-thickness", "0.3", "--resistance", "10",
           "--output", scratch_path("out.vtu"));
  assert_int_equal(shim_read_array(scratch_path("out.vtu"), 'p', "riis_distance", NULL, NULL, NULL, distance), 1);
  assert_int_equal(shim_read_array(scratch_path("out.vtu"), 'p', "riis_K", NULL, NULL, NULL, resistance), 1);
  int n_resisting = 0;
  for (int i = 0; i < n_box; ++i) {
    const double expected = distance[i] < eps ? R / eps * (1 + cos(pi * distance[i] / eps)) / (2 * eps) : 0;
    if (fabs(resistance[i] - expected) > 1e-12 * R / eps / eps)
      fail_msg("node %d at %.17g has K %.17g, not %.17g", i, distance[i], resistance[i], expected);
    n_resisting += resistance[i] > 0;
  }
  assert_true(n_resisting > 20);
}

TEST(test_no_array_unless_asked) {
  static double resistance[n_box];
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "aortic", "--half-thickness", "0.3", "--output",
           scratch_path("plain.vtu"));
  assert_int_equal(shim_read_array(scratch_path("plain.vtu"), 'p', "riis_K", NULL, NULL, NULL, resistance), 0);
}

TEST(test_refused_resistances) {
  RUN_REFUSED(2, "--resistance is -1", "mark", scratch_path("in.vtu"), "--valve", "aortic", "--resistance", "-1");
  RUN_REFUSED(2, "--resistance is nan", "mark", scratch_path("in.vtu"), "--valve", "aortic", "--resistance", "nan");
  RUN_REFUSED(2, "--resistance", "mark", scratch_path("in.vtu"), "--valve", "aortic", "--resistance", "ten");
  RUN_REFUSED(2, "--resistance is not an option", "surface", "--valve", "aortic", "--resistance", "1");
  /* If the mesh already has the K of a valve, a second run does not replace this K by accident. */
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "aortic", "--half-thickness", "0.3", "--resistance", "1",
           "--prefix", "a", "--output", scratch_path("a.vtu"));
  RUN_REFUSED(2, "a_marked", "mark", scratch_path("a.vtu"), "--valve", "aortic", "--half-thickness", "0.3",
              "--resistance", "1", "--prefix", "a", "--output", scratch_path("b.vtu"));
}

int main(void) { return run_cases(make_box, destroy_all); }
