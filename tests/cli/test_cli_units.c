/* SPDX-License-Identifier: Apache-2.0
 *
 * --unit and --surface-unit: the marks are the same in all units. If the sizes of mesh, surface and half thickness do not match,
 * a warning advises options. After the test follows this advice, the warning must disappear. */
#include <riis/riis_vtk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_units = 3 };
static const char *const units[n_units] = {"m", "cm", "mm"};
static const double factors[n_units] = {0.01, 1, 10}; /* from centimetres to each unit */
static char meshes[n_units][256], surfaces[n_units][256];
static int n_wanted; /* number of marked nodes of the valve in the box */

/* Writes the box of in.vtu with finer cells, and the valve. Box and valve have a file in every unit. */
static int make_files(void **state) {
  scratch_setup(state);
  for (int i = 0; i < n_units; ++i) {
    char name[32];
    const double f = factors[i];
    snprintf(name, sizeof name, "%s.vtu", units[i]);
    snprintf(meshes[i], sizeof meshes[i], "%s", scratch_path(name));
    snprintf(name, sizeof name, "%s.vtp", units[i]);
    snprintf(surfaces[i], sizeof surfaces[i], "%s", scratch_path(name));
    if (!shim_write_box(meshes[i], SHIM_RAW, 22, (double[3]){-1.7 * f, -1.6 * f, -1.3 * f},
                        (double[3]){1.5 * f, 1.6 * f, 0.4 * f}, 0))
      return -1;
    run_program("surface", "--unit", units[i], "--output", surfaces[i], "--quiet", NULL);
    if (program_exit_code != 0) return -1;
  }
  run_program("mark", meshes[1], "--stats", "-", NULL);
  n_wanted = (int)json_number(program_out, "n_marked");
  return n_wanted > 100 ? 0 : -1;
}

/* Rounding may change the mark of a node at the half thickness. A wrong unit would change all marks. */
static void expect_wanted_marks(void) {
  if (program_exit_code != 0 || program_err[0]) fail_msg("exit code %d, stderr: %s", program_exit_code, program_err);
  const double n = json_number(program_out, "n_marked");
  if (!(n >= n_wanted - 2 && n <= n_wanted + 2)) fail_msg("%g nodes are marked, not %d", n, n_wanted);
}

TEST(test_valves) {
  for (int i = 0; i < n_units; ++i) {
    run_program("mark", meshes[i], "--unit", units[i], "--stats", "-", NULL);
    expect_wanted_marks();
    assert_true(json_number(program_out, "half_thickness") == 0.1 * factors[i]);
    run_program("mark", meshes[i], "--unit", units[i], "--surface-unit", "cm", "--stats", "-", NULL);
    expect_wanted_marks();
    char scale[32];
    snprintf(scale, sizeof scale, "%g", factors[i]);
    run_program("mark", meshes[i], "--scale", scale, "--stats", "-", NULL);
    expect_wanted_marks();
  }
  run_program("mark", meshes[0], "--unit", "m", "--half-thickness", "0.002", "--stats", "-", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_true(json_number(program_out, "half_thickness") == 0.002);
}

TEST(test_surface_files) {
  for (int i = 0; i < n_units; ++i) {
    for (int k = 0; k < n_units; ++k) {
      run_program("mark", meshes[i], "--unit", units[i], "--surface", surfaces[k], "--surface-unit", units[k],
                  "--stats", "-", NULL);
      expect_wanted_marks();
      assert_true(json_number(program_out, "half_thickness") == 0.1 * factors[i]);
    }
  }
}

TEST(test_patches) {
  /* A square of one centimetre, in millimetres. */
  scratch_write_text(
      "v.json",
      "{\"curves\": {\"a\": [[-5,-5,-3], [5,-5,-3]], \"b\": [[-5,5,-3], [5,5,-3]], \"c\": [[-5,-5,-3], [-5,5,-3]],"
      " \"d\": [[5,-5,-3], [5,5,-3]]}, \"patches\": [{\"v0\": \"a\", \"v1\": \"b\", \"u0\": \"c\", \"u1\": \"d\"}]}");
  double n_marked[n_units];
  for (int i = 0; i < n_units; ++i) {
    RUN_FINE("mark", meshes[i], "--valve", scratch_path("v.json"), "--unit", units[i], "--surface-unit", "mm",
             "--stats", "-");
    n_marked[i] = json_number(program_out, "n_marked");
    assert_true(json_number(program_out, "area") > 0.99 * factors[i] * factors[i] &&
                json_number(program_out, "area") < 1.01 * factors[i] * factors[i]);
  }
  assert_true(n_marked[0] > 30 && n_marked[0] == n_marked[1] && n_marked[1] == n_marked[2]);
}

/* Checks the exit code, and that one line with this text is printed. --quiet does not remove the line. */
static void expect_warning(int exit_code, const char *text) {
  const char *end = strchr(program_err, '\n');
  if (program_exit_code != exit_code || strncmp(program_err, "riis: ", 6) != 0 || !end || end[1] ||
      !strstr(program_err, text))
    fail_msg("exit code %d for %d, wanted \"%s\"\nstderr: %s", program_exit_code, exit_code, text, program_err);
}

/* Splits the words between "write " and " in place of" into arguments. */
static int advised(char words[8][64]) {
  static char text[longest_output];
  const char *place = strstr(program_err, ": write ");
  if (!place) fail_msg("no advice in %s", program_err);
  snprintf(text, sizeof text, "%s", place + strlen(": write "));
  text[strcspn(text, "\n")] = 0;
  char *rest = strstr(text, " in place of");
  if (rest) *rest = 0;
  int n = 0;
  for (char *word = strtok(text, " "); word && n < 8; word = strtok(NULL, " ")) snprintf(words[n++], 64, "%s", word);
  assert_true(n > 0);
  return n;
}

/* Runs the program with the options that the last warning advises. No warning may follow. `surface` may be NULL. */
static void expect_cured(const char *mesh, const char *surface) {
  char words[8][64];
  const int n_words = advised(words);
  const char *arguments[13] = {"--stats", "-"};
  int n = 2;
  if (surface) arguments[n++] = "--surface";
  if (surface) arguments[n++] = surface;
  for (int i = 0; i < n_words; ++i) arguments[n++] = words[i];
  run_program("mark", mesh, arguments[0], arguments[1], arguments[2], arguments[3], arguments[4], arguments[5],
              arguments[6], arguments[7], arguments[8], arguments[9], arguments[10], arguments[11], NULL);
  expect_wanted_marks();
}

TEST(test_wrong_valve_units) {
  run_program("mark", meshes[0], NULL);
  expect_warning(3, "no node is marked: the mesh looks as if it were in metres, the surface in centimetres");
  expect_warning(3, ": write --unit m\n");
  expect_cured(meshes[0], NULL);
  run_program("mark", meshes[0], "--quiet", "--stats", scratch_path("s.json"), NULL);
  expect_warning(3, ": write --unit m\n");
  run_program("mark", meshes[2], NULL);
  expect_warning(program_exit_code, "the mesh looks as if it were in millimetres, the surface in centimetres");
  expect_warning(program_exit_code, ": write --unit mm\n");
  expect_cured(meshes[2], NULL);
  run_program("mark", meshes[1], "--scale", "0.01", NULL);
  expect_warning(3, "the mesh looks as if it were in centimetres, the surface in metres (sides ");
  expect_warning(3, ": write --unit cm in place of --scale 0.01\n");
  expect_cured(meshes[1], NULL);
  run_program("mark", meshes[0], "--unit", "mm", NULL);
  expect_warning(3, "the mesh looks as if it were in metres, the surface in millimetres (sides ");
  expect_warning(3, ": write --unit m in place of --unit mm\n");
  expect_cured(meshes[0], NULL);
  /* If both the unit and the half thickness are wrong, one warning corrects both. */
  run_program("mark", meshes[0], "--half-thickness", "0.1", NULL);
  expect_warning(3, ": write --unit m --half-thickness 0.001\n");
  expect_cured(meshes[0], NULL);
}

/* Checks that only the first warning has advice, and that the following warning about leaks has none. */
static void expect_one_advice(void) {
  assert_non_null(strstr(program_leaks, " between two unmarked nodes"));
  assert_null(strstr(program_leaks, "--half-thickness"));
  assert_null(strstr(program_leaks, "half thicknesses"));
}

TEST(test_wrong_file_units) {
  run_program("mark", meshes[0], "--surface", surfaces[2], NULL);
  expect_warning(3, ": write --unit m --surface-unit mm\n");
  expect_cured(meshes[0], surfaces[2]);
  run_program("mark", meshes[2], "--surface", surfaces[0], NULL);
  expect_warning(program_exit_code, ": write --unit mm --surface-unit m\n");
  expect_cured(meshes[2], surfaces[0]);
  run_program("mark", meshes[0], "--surface", surfaces[2], "--unit", "m", "--surface-unit", "m", NULL);
  expect_warning(3, ": write --unit m --surface-unit mm in place of --unit m --surface-unit m\n");
  expect_cured(meshes[0], surfaces[2]);
  /* The half thickness is in another unit than the mesh and the surface. */
  run_program("mark", meshes[2], "--surface", surfaces[2], NULL);
  expect_warning(0, "the median edge of the mesh ");
  expect_warning(0, "both look as if they were in millimetres: write --unit mm --surface-unit mm\n");
  expect_cured(meshes[2], surfaces[2]);
  run_program("mark", meshes[0], "--surface", surfaces[0], NULL);
  expect_warning(0, "all 10,648 nodes are marked: the half thickness is 0.1, the largest side of the surface 0.02");
  expect_warning(0, "both look as if they were in metres: write --unit m --surface-unit m\n");
  expect_cured(meshes[0], surfaces[0]);
  /* The factor 0.005 is not the ratio of any two units. */
  run_program("mark", meshes[1], "--surface", surfaces[1], "--scale", "0.005", NULL);
  expect_warning(3, "different units");
  expect_warning(3, "write --scale 0.5 in place of --scale 0.005\n");
}

/* Checks that the first line has this text, and removes the line. */
static void expect_note_and_warning(const char *text) {
  char *const end = strchr(program_err, '\n');
  if (!end || !strstr(program_err, text) || strstr(program_err, text) > end)
    fail_msg("wanted \"%s\"\nstderr: %s", text, program_err);
  memmove(program_err, end + 1, strlen(end + 1) + 1);
}

/* The mesh's edges suggest millimetres. A large and coarse mesh in centimetres would also have these edges, so a unit that the
 * user names decides. */
TEST(test_coarse_or_other_unit) {
  assert_int_equal(
      shim_write_box(scratch_path("large.vtu"), SHIM_RAW, 40, (double[3]){-9, -9, -9}, (double[3]){9, 9, 9}, 0), 1);
  run_program("mark", scratch_path("large.vtu"), NULL);
  expect_warning(program_exit_code, "the mesh looks as if it were in millimetres or centimetres, the surface in ");
  expect_warning(program_exit_code, ": write --unit mm or --unit cm\n");
  expect_one_advice();
  run_program("mark", scratch_path("large.vtu"), "--unit", "mm", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_err, "the unit is not sure: --unit mm marks "));
  assert_null(strstr(program_err, "write "));
  run_program("mark", scratch_path("large.vtu"), "--unit", "cm", NULL);
  expect_note_and_warning("the unit is not sure: --unit cm marks 18 nodes, --unit mm marks ");
  expect_warning(program_exit_code, "the half thickness is 0.1, the median edge of the mesh 0.6");
  expect_warning(program_exit_code, ": write --half-thickness 0.6");
  expect_one_advice();
  run_program("mark", scratch_path("large.vtu"), "--scale", "1", NULL);
  expect_note_and_warning("the unit is not sure: --unit cm marks 18 nodes, --unit mm marks ");
  expect_warning(program_exit_code, ": write --half-thickness 0.6");
  /* The file's unit is unknown, so the default half thickness says nothing about the unit. */
  run_program("mark", scratch_path("large.vtu"), "--surface", surfaces[2], NULL);
  expect_warning(0, "both look as if they were in millimetres: write --unit mm --surface-unit mm\n");
}

/* A basin of 13 cm with short edges may also be a vessel of 13 mm. The advice names both units. The next run says how many nodes
 * each unit marks. */
TEST(test_two_possible_units) {
  const double far = 6.5;
  assert_int_equal(shim_write_box(scratch_path("basin.vtu"), SHIM_RAW, 40, (double[3]){-far, -far, -far},
                                  (double[3]){far, far, far}, 0),
                   1);
  double n_marked[n_units] = {0, 0, 0};
  for (int i = 1; i < n_units; ++i) {
    run_program("mark", scratch_path("basin.vtu"), "--unit", units[i], "--stats", "-", NULL);
    n_marked[i] = json_number(program_out, "n_marked");
    assert_non_null(strstr(program_err, "the unit is not sure: "));
  }
  char wanted[96];
  snprintf(wanted, sizeof wanted, "--unit mm marks %d,%03d nodes, --unit cm marks %d nodes\n", (int)n_marked[2] / 1000,
           (int)n_marked[2] % 1000, (int)n_marked[1]);
  assert_true(n_marked[1] < 1000 && n_marked[2] >= 1000);
  assert_non_null(strstr(program_err, wanted));
  run_program("mark", scratch_path("basin.vtu"), NULL);
  assert_non_null(strstr(program_err,
                         "the mesh looks as if it were in millimetres or centimetres, the surface in "
                         "centimetres (sides 13 x 13 x 13 and 2.78 x 2.75 x 1.02)"));
  assert_non_null(strstr(program_err, "): write --unit mm or --unit cm\n"));
}

/* The placed valve is in millimetres, although the user did not type --unit mm. The mesh is in metres. */
TEST(test_placed_valve_in_other_unit) {
  scratch_write_text("placed.json",
                     "{\"valve\": \"coapting\", \"unit\": \"mm\", \"axes\": \"mesh\", \"rotate\": [0, 0, 1, 0], "
                     "\"translate\": [0, 0, -5], \"parameters\": {}}");
  run_program("mark", meshes[0], "--valve", scratch_path("placed.json"), NULL);
  expect_warning(program_exit_code, "the mesh looks as if it were in metres, the surface in millimetres (sides ");
  expect_warning(program_exit_code, "): write --unit m\n");
  run_program("check", "leaks", meshes[0], "--valve", scratch_path("placed.json"), "--between", "0,0,5", "0,0,-0.01",
              NULL);
  assert_non_null(strstr(program_err,
                         "FROM, 0 0 5, is outside the mesh, which goes from -0.017 -0.016 -0.013 to "
                         "0.015 0.016 0.004\n"));
  RUN_FINE("mark", meshes[2], "--valve", scratch_path("placed.json"));
  RUN_FINE("mark", meshes[0], "--valve", scratch_path("placed.json"), "--unit", "m");
}

TEST(test_half_thickness) {
  run_program("mark", meshes[0], "--scale", "0.01", "--half-thickness", "0.1", "--quiet", "--stats",
              scratch_path("s.json"), NULL);
  expect_warning(0, "all 10,648 nodes are marked: the half thickness is 0.1, the largest side of the surface 0.02");
  expect_warning(0, ": write --half-thickness 0.001\n");
  run_program("mark", meshes[0], "--scale", "0.01", "--half-thickness", "0.001", "--stats", "-", NULL);
  expect_wanted_marks();
  run_program("mark", meshes[1], "--half-thickness", "1", NULL);
  expect_warning(0, "nodes are marked, which looks wrong: the half thickness is 1, the largest side of the surface 2.");
  expect_cured(meshes[1], NULL);
  run_program("mark", meshes[1], "--half-thickness", "0.001", NULL);
  expect_warning(program_exit_code, "the half thickness is 0.001, the median edge of the mesh 0.1");
  expect_warning(program_exit_code, ": write --half-thickness 0.1\n");
  expect_cured(meshes[1], NULL);
  /* If no power of ten suits a coarse mesh, the program advises the mesh's edge length. A length that is also too large is not
   * advised. */
  const double far = 1.6;
  assert_int_equal(shim_write_box(scratch_path("coarse.vtu"), SHIM_RAW, 6, (double[3]){-far, -far, -far},
                                  (double[3]){far, far, far}, 0),
                   1);
  run_program("mark", scratch_path("coarse.vtu"), "--half-thickness", "0.08", NULL);
  expect_warning(program_exit_code, ", the median edge of the mesh 0.9");
  expect_warning(program_exit_code, ": the mesh is too coarse for this surface\n");
  assert_int_equal(shim_write_box(scratch_path("coarse.vtu"), SHIM_RAW, 12, (double[3]){-far, -far, -far},
                                  (double[3]){far, far, far}, 0),
                   1);
  run_program("mark", scratch_path("coarse.vtu"), "--half-thickness", "0.075", NULL);
  expect_warning(program_exit_code, ": write --half-thickness 0.4");
  /* The surface of this file does not have the size of a valve in any unit. */
  run_program("mark", meshes[1], "--surface", surfaces[1], "--half-thickness", "7", NULL);
  expect_warning(0, ": write --half-thickness 0.07\n");
}

/* If the sizes do not explain why nothing is marked, the message gives the positions of mesh and surface. */
TEST(test_places) {
  run_program("mark", meshes[1], "--translate", "50,0,0", NULL);
  expect_warning(3,
                 "no node is marked: the mesh is in x -1.7 to 1.5, y -1.6 to 1.6, z -1.3 to 0.4, the surface in x 48.");
  expect_warning(3, "the half thickness is 0.1: see --translate, --rotate, --scale, --half-thickness\n");
  /* Only a corner of the valve is in the mesh. */
  run_program("mark", meshes[1], "--translate", "3,0,0", NULL);
  expect_warning(0, "only ");
  expect_warning(0, " of 10,648 nodes are marked: the mesh is in x");
  RUN_FINE("mark", meshes[1], "--translate", "50,0,0", "--allow-none", "--quiet", "--stats", scratch_path("s.json"));
  /* If a mesh has few nodes that are all near the valve, there is no message. */
  scratch_write_text("few.vtk",
                     "# vtk DataFile Version 3.0\nfew\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
                     "1 0 -.3 1.01 0 -.3 1 .01 -.3 1 0 -.31\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n");
  run_program("mark", scratch_path("few.vtk"), "--half-thickness", "1", NULL);
  assert_int_equal(program_exit_code, 0);
}

/* In a case of several valves, the program reports the more likely cause first, whatever the order of the valves. Only this
 * message has advice. */
TEST(test_order_of_causes) {
  scratch_write_text("two.json",
                     "{\"mesh\": \"mm.vtu\", \"valves\": [\n"
                     "{\"name\": \"thick\", \"valve\": \"aortic\", \"scale\": 10, \"half_thickness\": 12},\n"
                     "{\"name\": \"small\", \"valve\": \"aortic\", \"half_thickness\": 0.1, \"scale\": 0.1}]}\n");
  run_program("mark", "--case", scratch_path("two.json"), "--output", scratch_path("two.vtu"), "--quiet", NULL);
  const char *const second = strchr(program_err, '\n') + 1;
  assert_int_equal(strncmp(program_err, "riis: small: ", strlen("riis: small: ")), 0);
  assert_non_null(strstr(program_err, ": write --unit mm"));
  assert_int_equal(strncmp(second, "riis: thick: ", strlen("riis: thick: ")), 0);
  assert_non_null(strstr(second, ": the half thickness is 12, the largest side of the surface 27.8\n"));
  assert_null(strstr(second, "--half-thickness"));
  assert_null(strstr(program_leaks, "--half-thickness"));
}

/* The mesh is in another unit and also too coarse. The warning is about the unit. */
TEST(test_coarse_and_other_unit) {
  for (int i = 0; i < n_units; i += 2) {
    const double f = factors[i];
    assert_int_equal(shim_write_box(scratch_path("coarse.vtu"), SHIM_RAW, 8, (double[3]){-2.1 * f, -2.1 * f, -1.5 * f},
                                    (double[3]){2.1 * f, 2.2 * f, 1.5 * f}, 0),
                     1);
    char advice[64];
    snprintf(advice, sizeof advice, ": write --unit %s\n", units[i]);
    run_program("mark", scratch_path("coarse.vtu"), NULL);
    expect_warning(program_exit_code, advice);
  }
}

/* Similar sizes show that mesh and surface share a unit, even if no node is near the surface. */
TEST(test_beside_the_mesh) {
  for (int named = 0; named < 2; ++named) {
    run_program("mark", meshes[1], "--surface", surfaces[1], "--translate", "0,0,2.6", named ? "--unit" : NULL, "cm",
                "--surface-unit", "cm", NULL);
    assert_int_equal(program_exit_code, 3);
    assert_null(strstr(program_err, "looks as if"));
    assert_non_null(strstr(program_err, "--translate"));
  }
}

int main(void) { return run_cases(make_files, scratch_teardown); }
