/* SPDX-License-Identifier: Apache-2.0
 *
 * The output of riis-mark without a mesh, and the reading of its command line. */
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

static void test_version(void **state) {
  (void)state;
  RUN_FINE("--version");
  char expected[64];
  snprintf(expected, sizeof expected, "riis-mark %s\n", riis_version_string());
  assert_string_equal(program_out, expected);
}

static void test_help(void **state) {
  (void)state;
  RUN_FINE("--help");
  const char *names[] = {"MESH",
                         "--surface",
                         "--valve",
                         "--params",
                         "--set",
                         "--print-params",
                         "--tolerance",
                         "--skip-zero-area",
                         "--flip-normals",
                         "--scale",
                         "--rotate",
                         "--translate",
                         "--half-thickness",
                         "--distance-limit",
                         "--far-distance",
                         "--distance",
                         "--distance-tolerance",
                         "sampling",
                         "minimization",
                         "--search",
                         "clusters or paper",
                         "auto is exhaustive",
                         "--threads",
                         "--steps",
                         "--output",
                         "--surface-output",
                         "--picture",
                         "--view",
                         "--stats",
                         "--quiet",
                         "--version",
                         "--opening",
                         "--params-closed",
                         "--params-open",
                         "mitral",
                         "\"patches\"",
                         "Exit status",
                         "  1  bad data",
                         "  2  wrong usage",
                         "  3  no node is marked",
                         "--unit",
                         "--surface-unit",
                         "--leaflets",
                         "--prefix",
                         "--replace",
                         "--strict",
                         "--allow-none",
                         "--describe-params"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
    if (!strstr(program_out, names[i])) fail_msg("%s is not in the help", names[i]);
  }
}

/* The program fails if it cannot print its output. */
static void test_no_stdout(void **state) {
  (void)state;
  const char *places[] = {"/dev/full", ""};
  for (int i = 0; i < 2; ++i) {
    program_stdout = places[i];
    RUN_REFUSED(1, "standard output: cannot be written", "--help");
    RUN_REFUSED(1, "standard output: cannot be written", "--version");
    RUN_REFUSED(1, "standard output: cannot be written", "--print-params");
    RUN_REFUSED(1, "standard output: cannot be written", scratch_path("in.vtu"), "--stats", "-");
  }
  program_stdout = NULL;
}

/* An option takes one value. The next argument is the mesh. */
static void test_order(void **state) {
  (void)state;
  RUN_FINE("--set", "root_radius=1.29", scratch_path("in.vtu"), "--stats", "-");
  assert_true(json_number(program_out, "n_nodes") == n_box);
  RUN_FINE("--stats=-", "--half-thickness=0.3", scratch_path("in.vtu"));
  assert_true(json_number(program_out, "half_thickness") == 0.3);
  RUN_FINE("--stats=-", "--translate=-.5,+1,0", "--", scratch_path("in.vtu"));
  assert_true(json_number(program_out, "n_nodes") == n_box);
}

static void test_skip_zero_area(void **state) {
  (void)state;
  scratch_write_text(
      "flat.stl",
      "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 2 0 0\nendloop\nendfacet\nendsolid\n");
  RUN_REFUSED(1, "flat.stl: ", scratch_path("in.vtu"), "--surface", scratch_path("flat.stl"));
  RUN_FINE(scratch_path("in.vtu"), "--surface", scratch_path("flat.stl"), "--skip-zero-area", "--stats", "-");
  assert_true(json_number(program_out, "n_triangles") == 1 && json_number(program_out, "n_zero_area") == 1);
  assert_true(json_number(program_out, "area") == 0.5);
}

/* The program's name alone prints a few lines on what to type, not on what was wrong. */
static void test_no_arguments(void **state) {
  (void)state;
  run_program(NULL);
  assert_int_equal(program_exit_code, 2);
  assert_string_equal(program_out, "");
  int n_lines = 0;
  for (const char *c = program_err; *c; ++c) n_lines += *c == '\n';
  assert_int_equal(n_lines, 5);
  const char *parts[] = {"riis-mark marks the nodes", "MESH.vtu --output", "--unit m", "--surface-unit mm", "--help"};
  for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i) assert_non_null(strstr(program_err, parts[i]));
}

/* Numbers are read and written with a decimal point, whatever the locale. */
static void test_locale(void **state) {
  (void)state;
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  RUN_FINE(scratch_path("in.vtu"), "--half-thickness", "0.25", "--stats", "-");
  unsetenv("LC_ALL");
  assert_true(json_number(program_out, "half_thickness") == 0.25);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_version),      cmocka_unit_test(test_help),           cmocka_unit_test(test_order),
      cmocka_unit_test(test_no_stdout),    cmocka_unit_test(test_skip_zero_area), cmocka_unit_test(test_locale),
      cmocka_unit_test(test_no_arguments),
  };
  return cmocka_run_group_tests(tests, make_box, scratch_teardown);
}
