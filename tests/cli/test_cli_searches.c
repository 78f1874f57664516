/* SPDX-License-Identifier: Apache-2.0
 *
 * --search chooses the search. The tests check which search runs, its marks, and the message about a search that may be
 * incomplete. All searches here give equal marks. --steps only adds the cost of each step of a moving valve to the output. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "marks.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

static void mark_default_valve(double half_thickness, double distance_limit) {
  riis_valve *valve = NULL;
  riis_surface_options options;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = half_thickness;
  mark_by_c(valve, &options, distance_limit, RIIS_FAR_DISTANCE);
  riis_valve_destroy(&valve);
}

/* Every search gives the same marks. The search `auto` reports which search it chose. */
TEST(test_marks_are_equal) {
  mark_default_valve(0.2, 0.3);
  const char *searches[] = {"auto", "exhaustive", "neighbor"};
  const char *ran[] = {"\"exhaustive\"", "\"exhaustive\"", "\"neighbor\""};
  for (int i = 0; i < 3; ++i) {
    for (int n_threads = 1; n_threads <= 2; ++n_threads) {
      RUN_FINE("mark", scratch_path("in.vtu"), "--half-thickness", "0.2", "--distance-limit", "0.3", "--search",
               searches[i], "--threads", n_threads == 1 ? "1" : "2", "--output", scratch_path("out.vtu"), "--stats",
               "-");
      expect_marked_mesh();
      assert_true(json_has_text(program_out, "search", ran[i]));
      assert_true(json_has_text(program_out, "complete", "true"));
      assert_true(json_number(program_out, "n_unreached") >= 0);
      assert_true(json_number(program_out, "n_marked") == (double)by_c.stats.n_marked);
      assert_true(json_number(program_out, "n_within_limit") == (double)by_c.stats.n_within_limit);
      assert_true(json_number(program_out, "threads") <= n_threads);
      const double seconds = json_number(strstr(program_out, "\"seconds\": {"), "adjacency");
      assert_true(i == 2 ? seconds > 0 : seconds == 0);
    }
  }
}

/* For each way to measure, the distances equal those of the C interface with the same options. Distances by sampling or
 * minimisation differ from the distances to the triangles, and the output says so. */
TEST(test_distances) {
  const char *methods[] = {"triangles", "sampling", "minimization"};
  double n_marked[3];
  for (int32_t i = RIIS_MEASURE_SAMPLING; i <= RIIS_MEASURE_MINIMIZATION; ++i) {
    riis_valve *valve = NULL;
    riis_surface_options options;
    expect_fine(riis_valve_create("aortic", &valve));
    expect_fine(riis_surface_options_init(&options, sizeof options));
    options.half_thickness = 0.2;
    options.measure = i;
    options.measure_tolerance = 0.3;
    mark_by_c(valve, &options, RIIS_AUTO, RIIS_FAR_DISTANCE);
    riis_valve_destroy(&valve);
    const char *searches[] = {"auto", "neighbor"};
    for (int k = 0; k < 2; ++k) {
      RUN_FINE("mark", scratch_path("in.vtu"), "--half-thickness", "0.2", "--distance", methods[i],
               "--distance-tolerance", "0.3", "--search", searches[k], "--output", scratch_path("out.vtu"), "--stats",
               "-");
      expect_marked_mesh();
      assert_true(json_has_text(program_out, "complete", "true"));
    }
    char text[32];
    snprintf(text, sizeof text, "\"%s\"", methods[i]);
    assert_true(json_has_text(program_out, "distance", text));
    n_marked[i] = json_number(program_out, "n_marked");
    RUN_FINE("mark", scratch_path("in.vtu"), "--distance", methods[i]);
    snprintf(text, sizeof text, ", distances by %s\n", methods[i]);
    assert_non_null(strstr(program_out, text));
  }
  RUN_FINE("mark", scratch_path("in.vtu"), "--half-thickness", "0.2", "--stats", "-");
  assert_true(json_has_text(program_out, "distance", "\"triangles\""));
  n_marked[0] = json_number(program_out, "n_marked");
  assert_true(n_marked[RIIS_MEASURE_SAMPLING] > 0 && n_marked[RIIS_MEASURE_SAMPLING] < n_marked[0]);
  assert_true(n_marked[RIIS_MEASURE_MINIMIZATION] > 0 && n_marked[RIIS_MEASURE_MINIMIZATION] <= n_marked[0]);
}

TEST(test_table) {
  RUN_FINE("mark", scratch_path("in.vtu"), "--search", "neighbor", "--threads", "1");
  assert_non_null(strstr(program_out, "\nsearch    neighbor, 1 thread"));
  assert_non_null(strstr(program_out, ", adjacency 0."));
  assert_null(strstr(program_out, "\ncomplete"));
  RUN_FINE("mark", scratch_path("in.vtu"), "--threads", "1");
  assert_non_null(strstr(program_out, "\nsearch    exhaustive, 1 thread\n"));
}

static void expect_warning(void) {
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_err, "riis: the marks may be incomplete: --search paper"));
  assert_ptr_equal(strchr(program_err, '\n') + 1, program_err + strlen(program_err));
}

/* If the marked nodes are connected, the paper's search finds all of them. The search cannot know that it is complete, and says
 * so. */
TEST(test_paper) {
  mark_default_valve(0.3, RIIS_AUTO);
  run_program("mark", scratch_path("in.vtu"), "--half-thickness", "0.3", "--search", "paper", "--output",
              scratch_path("out.vtu"), NULL);
  expect_warning();
  assert_non_null(strstr(program_out, "\nsearch    paper, "));
  assert_non_null(strstr(program_out, "\ncomplete  unknown, because "));
  expect_marked_mesh();
  run_program("mark", scratch_path("in.vtu"), "--half-thickness", "0.3", "--search", "paper", "--stats", "-", NULL);
  expect_warning();
  assert_true(json_has_text(program_out, "complete", "false"));
  assert_true(json_has_text(program_out, "search", "\"paper\""));
  assert_true(json_number(program_out, "n_unreached") == 0);
  assert_true(json_number(program_out, "n_marked") == (double)by_c.stats.n_marked);
  run_program("mark", scratch_path("in.vtu"), "--search", "paper", "--quiet", "--output", scratch_path("quiet.vtu"),
              NULL);
  expect_warning();
  assert_string_equal(program_out, "");
}

/* Two triangles are far apart. The paper's search finds only the nodes near the first triangle. The neighbour search finds the
 * nodes near both triangles. */
TEST(test_two_pieces) {
  scratch_write_text(
      "pieces.stl",
      "solid x\nfacet normal 0 0 1\nouter loop\nvertex -1.6 -1 -1\nvertex -.9 -1 -1\nvertex -1.4 -.4 -1\n"
      "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex .5 .5 0\nvertex 1.4 .5 0\n"
      "vertex .5 1.4 0\nendloop\nendfacet\nendsolid\n");
  const char *searches[] = {"exhaustive", "neighbor", "paper"};
  double n_marked[3];
  for (int i = 0; i < 3; ++i) {
    run_program("mark", scratch_path("in.vtu"), "--surface", scratch_path("pieces.stl"), "--half-thickness", "0.2",
                "--search", searches[i], "--stats", "-", NULL);
    assert_int_equal(program_exit_code, 0);
    n_marked[i] = json_number(program_out, "n_marked");
    assert_true(json_has_text(program_out, "complete", i == 2 ? "false" : "true"));
  }
  assert_true(n_marked[0] > 0 && n_marked[0] == n_marked[1]);
  assert_true(n_marked[2] > 0 && n_marked[2] < n_marked[0]);
}

/* A mesh of points has no neighbours, so the final check of the search finds the nodes. The table gives their number. */
TEST(test_no_cells) {
  scratch_write_text("points.vtk",
                     "# vtk DataFile Version 3.0\npoints\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n"
                     "0 0 0 .1 0 0 5 5 5\nCELLS 1 2\n1 0\nCELL_TYPES 1\n1\n");
  scratch_write_text("one.stl",
                     "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                     "endloop\nendfacet\nendsolid\n");
  RUN_WITHOUT_CELLS("mark", scratch_path("points.vtk"), "--surface", scratch_path("one.stl"), "--search", "neighbor");
  assert_non_null(strstr(program_out, "2 nodes within the half thickness"));
  assert_non_null(strstr(program_out, ", 1 node not reached from a neighbour\n"));
  RUN_WITHOUT_CELLS("mark", scratch_path("points.vtk"), "--surface", scratch_path("one.stl"), "--search", "neighbor",
                    "--stats", "-");
  assert_true(json_number(program_out, "n_marked") == 2);
  assert_true(json_number(program_out, "n_unreached") == 1);
  run_program("mark", scratch_path("points.vtk"), "--surface", scratch_path("one.stl"), "--search", "paper", "--stats",
              "-", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_err, "riis: the marks may be incomplete: --search paper"));
  assert_non_null(strstr(program_err, " has no volume cells\n"));
  assert_true(json_number(program_out, "n_marked") == 1);
}

/* The two searches along an adjacency refuse a bad option before the mesh is read. Here the mesh is missing. */
TEST(test_refusals) {
  const char *searches[] = {"neighbor", "paper"};
  for (int i = 0; i < 2; ++i) {
    const char *mesh = scratch_path("missing.vtu");
    RUN_REFUSED(2, "--threads is -2; ", "mark", mesh, "--search", searches[i], "--threads", "-2");
    RUN_REFUSED(2, "--distance-limit is 0.05; ", "mark", mesh, "--search", searches[i], "--distance-limit", "0.05");
    RUN_REFUSED(1, "missing.vtu: cannot be read", "mark", mesh, "--search", searches[i]);
  }
  RUN_REFUSED(2, "--search", "mark", scratch_path("in.vtu"), "--search", "neighbour");
}

static int destroy_all(void **state) {
  forget_marks();
  return scratch_teardown(state);
}

TEST(test_steps) {
  static const struct {
    const char *option, *search;
  } searches[] = {{"auto", "\"clusters\""},
                  {"exhaustive", "\"exhaustive\""},
                  {"neighbor", "\"neighbor\""},
                  {"clusters", "\"clusters\""}};
  for (size_t i = 0; i < sizeof searches / sizeof searches[0]; ++i) {
    const char *const search = searches[i].option;
    RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--opening", "0.99", "--search", search, "--output",
             scratch_path("without.vtu"), "--surface-output", scratch_path("without.vtp"), "--stats", "-");
    assert_null(strstr(program_out, "\"step\""));
    RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--opening", "0.99", "--search", search, "--output",
             scratch_path("with.vtu"), "--surface-output", scratch_path("with.vtp"), "--steps", "5", "--stats", "-");
    assert_true(json_number(program_out, "n_steps") == 5);
    assert_true(json_number(program_out, "seconds_surface") > 0);
    assert_true(json_number(program_out, "seconds_search") > 0);
    assert_true(json_number(program_out, "opening") == 0.99);
    assert_true(json_has_text(strstr(program_out, "\"step\""), "search", searches[i].search));
    assert_true(scratch_is_same("with.vtu", "without.vtu"));
    assert_true(scratch_is_same("with.vtp", "without.vtp"));
  }
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--steps", "1");
  assert_non_null(strstr(program_out, "\nstep      "));
  assert_non_null(strstr(program_out, "median of 1 step of 0.02 in opening, search clusters\n"));
}

TEST(test_refused_steps) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--steps: 0 is not above 0", "mark", mesh, "--valve", "mitral", "--steps", "0");
  RUN_REFUSED(2, "--steps: -3 is not above 0", "mark", mesh, "--valve", "mitral", "--steps", "-3");
  RUN_REFUSED(2, "--steps", "mark", mesh, "--valve", "mitral", "--steps", "2.5");
  RUN_REFUSED(2, "--steps is not an option", "surface", "--valve", "mitral", "--steps", "2");
  RUN_REFUSED(2, "--surface excludes --steps", "mark", mesh, "--surface", scratch_path("a.vtp"), "--steps", "2");
  /* A valve from patches with only one state cannot move, so it has no steps. */
  scratch_write_text(
      "patch.json",
      "{\"curves\": {\"a\": [[0,0,0],[1,0,0]], \"b\": [[0,1,0],[1,1,0]], \"c\": [[0,0,0],[0,1,0]],"
      "\"d\": [[1,0,0],[1,1,0]]}, \"patches\": [{\"v0\": \"a\", \"v1\": \"b\", \"u0\": \"c\", \"u1\": \"d\"}]}");
  RUN_REFUSED(1, "opening is 0.02, but the patches valve has only one state", "mark", mesh, "--valve",
              scratch_path("patch.json"), "--steps", "2");
}

int main(void) { return run_cases(make_box, destroy_all); }
