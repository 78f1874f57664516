/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests the output of riis without a mesh, and the reading of its command line. */
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

TEST(test_version) {
  RUN_FINE("--version");
  char expected[64];
  snprintf(expected, sizeof expected, "riis %s\n", riis_version_string());
  assert_string_equal(program_out, expected);
}

static void expect_printed(const char *name) {
  if (!strstr(program_out, name)) fail_msg("%s is not in:\n%s", name, program_out);
}

static int lines_of(const char *text) {
  int n = 0;
  for (; *text; ++text) n += *text == '\n';
  return n;
}

/* Each command has separate options and examples, which fit on about one screen. */
TEST(test_help) {
  static const struct {
    const char *command, *option[10];
  } helps[] = {
      {"mark",
       {"MESH", "--surface-unit", "--params,--params-closed", "--half-thickness", "--search", "--prefix", "--times",
        "--case", "--strict"}},
      {"surface", {"--output OUT.vtp", "--picture", "--view", "--time T", "--rotate"}},
      {"states", {"OUT", "--count", "--tolerance", "--params-open"}},
      {"export", {"FOLDER", "--time-step", "--largest-edge", "--closing-span"}},
      {"params", {"--describe", "--set", "--opening"}},
      {"view", {"--unit", "--folder", "--no-browser", "--open", "--port", "--cells-where", "RIIS_PYTHON"}},
      {"help", {"TOPIC"}},
  };
  for (size_t i = 0; i < sizeof helps / sizeof helps[0]; ++i) {
    RUN_FINE(helps[i].command, "--help");
    for (const char *const *option = helps[i].option; *option; ++option) expect_printed(*option);
    expect_printed("Examples:\n  riis ");
    assert_true(lines_of(program_out) < 95);
    RUN_FINE("--help");
    expect_printed(helps[i].command);
  }
  RUN_FINE("check", "crossings", "--help");
  expect_printed("--threads");
  RUN_FINE("check", "leaks", "--help");
  expect_printed("--between X,Y,Z X,Y,Z");
}

/* The list names every topic, and each topic has an explanation. */
TEST(test_topics) {
  RUN_FINE("help");
  char *list = strdup(program_out), *next = NULL;
  int n = 0;
  for (char *line = strtok_r(list, "\n", &next); line; line = strtok_r(NULL, "\n", &next)) {
    char name[64];
    if (line[0] != ' ' || sscanf(line, " %63s", name) != 1) continue;
    RUN_FINE("help", name);
    assert_true(strlen(program_out) > 100);
    assert_null(strstr(program_out, "riis-mark"));
    ++n;
  }
  free(list);
  assert_int_equal(n, 27);
  RUN_FINE("help", "status");
  const char *statuses[] = {"0  fine", "1  bad data", "2  wrong usage", "3  no node is marked",
                            "4  riis check crossings"};
  for (size_t i = 0; i < sizeof statuses / sizeof statuses[0]; ++i) expect_printed(statuses[i]);
  RUN_FINE("help", "searches");
  expect_printed("auto is exhaustive");
  RUN_FINE("help", "patches");
  expect_printed("\"patches\"");
}

/* An option takes one value. The next argument is the mesh. */
TEST(test_order) {
  RUN_FINE("mark", "--set", "root_radius=1.29", scratch_path("in.vtu"), "--stats", "-");
  assert_true(json_number(program_out, "n_nodes") == n_box);
  RUN_FINE("mark", "--stats=-", "--half-thickness=0.3", scratch_path("in.vtu"));
  assert_true(json_number(program_out, "half_thickness") == 0.3);
  RUN_FINE("mark", "--stats=-", "--translate=-.5,+1,0", "--", scratch_path("in.vtu"));
  assert_true(json_number(program_out, "n_nodes") == n_box);
}

/* The program fails if it cannot print its output. */
TEST(test_no_stdout) {
  const char *places[] = {"/dev/full", ""};
  for (int i = 0; i < 2; ++i) {
    program_stdout = places[i];
    RUN_REFUSED(1, "standard output: cannot be written", "--help");
    RUN_REFUSED(1, "standard output: cannot be written", "--version");
    RUN_REFUSED(1, "standard output: cannot be written", "params");
    RUN_REFUSED(1, "standard output: cannot be written", "mark", scratch_path("in.vtu"), "--stats", "-");
  }
  program_stdout = NULL;
}

TEST(test_skip_zero_area) {
  scratch_write_text(
      "flat.stl",
      "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 2 0 0\nendloop\nendfacet\nendsolid\n");
  RUN_REFUSED(1, "flat.stl: ", "mark", scratch_path("in.vtu"), "--surface", scratch_path("flat.stl"));
  RUN_FINE("mark", scratch_path("in.vtu"), "--surface", scratch_path("flat.stl"), "--skip-zero-area", "--stats", "-");
  assert_true(json_number(program_out, "n_triangles") == 1 && json_number(program_out, "n_zero_area") == 1);
  assert_true(json_number(program_out, "area") == 0.5);
}

/* Numbers have a decimal point in input and output, whatever the locale. */
TEST(test_locale) {
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  RUN_FINE("mark", scratch_path("in.vtu"), "--half-thickness", "0.25", "--stats", "-");
  unsetenv("LC_ALL");
  assert_true(json_number(program_out, "half_thickness") == 0.25);
}

/* Without arguments, the program prints a few commands to type, and no error message. */
TEST(test_no_arguments) {
  run_program(NULL);
  assert_int_equal(program_exit_code, 2);
  assert_string_equal(program_out, "");
  assert_int_equal(lines_of(program_err), 5);
  const char *parts[] = {"riis marks the nodes", "riis mark MESH.vtu --output", "--unit m", "--surface-unit mm",
                         "--help"};
  for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i) assert_non_null(strstr(program_err, parts[i]));
}

/* riis view passes its arguments to Python's riis. If Python lacks this package, the program says how to install it. A script
 * stands for Python here. */
TEST(test_view) {
  const char *python = scratch_path("python");
  FILE *file = fopen(python, "w");
  assert_non_null(file);
  fputs("#!/bin/sh\nif [ \"$1\" = -c ]; then exit ${MISSING:-0}; fi\nprintf '<%s>' \"$@\"\nexit 4\n", file);
  assert_int_equal(fclose(file), 0);
  assert_int_equal(chmod(python, 0700), 0);
  setenv("RIIS_PYTHON", python, 1);
  run_program("view", "a mesh.vtu", "--unit=mm", "-", NULL);
  assert_string_equal(program_out, "<-m><riis><view><a mesh.vtu><--unit=mm><->");
  assert_int_equal(program_exit_code, 4);
  setenv("MISSING", "3", 1);
  RUN_REFUSED(1, "does not find the Python package riis; install it by 'python3 -m venv", "view", "mesh.vtu");
  setenv("MISSING", "1", 1);
  RUN_REFUSED(1, "python fails when it imports the Python package riis; install it by", "view");
  unsetenv("MISSING");
  setenv("RIIS_PYTHON", scratch_path("no python"), 1);
  RUN_REFUSED(1, "no python cannot be run; install it by", "view");
  unsetenv("RIIS_PYTHON");
}

int main(void) { return run_cases(make_box, scratch_teardown); }
