/* SPDX-License-Identifier: Apache-2.0
 *
 * --check-crossing: against a valve whose crossing is known, against the C interface, and on the valves that come with the
 * library. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"

/* A unit square lies at z = 0. Another stands at x = 0.5. Its lower side is at 0.245 closed and at -0.755 open. */
static const char squares[] =
    "{\"curves\": {\"a\": [[0,0,0],[1,0,0]], \"b\": [[0,1,0],[1,1,0]], \"c\": [[0,0,0],[0,1,0]], \"d\": "
    "[[1,0,0],[1,1,0]],\n"
    " \"e\": [[0.5,0,0.245],[0.5,1,0.245]], \"f\": [[0.5,0,1.245],[0.5,1,1.245]],\n"
    " \"g\": [[0.5,0,0.245],[0.5,0,1.245]], \"h\": [[0.5,1,0.245],[0.5,1,1.245]]},\n"
    " \"patches\": [{\"v0\": \"a\", \"v1\": \"b\", \"u0\": \"c\", \"u1\": \"d\", \"leaflet\": 0},\n"
    "  {\"v0\": \"e\", \"v1\": \"f\", \"u0\": \"g\", \"u1\": \"h\", \"leaflet\": 1}],\n"
    " \"open\": {\"curves\": {\"a\": [[0,0,0],[1,0,0]], \"b\": [[0,1,0],[1,1,0]], \"c\": [[0,0,0],[0,1,0]],\n"
    "  \"d\": [[1,0,0],[1,1,0]], \"e\": [[0.5,0,-0.755],[0.5,1,-0.755]], \"f\": [[0.5,0,0.245],[0.5,1,0.245]],\n"
    "  \"g\": [[0.5,0,-0.755],[0.5,0,0.245]], \"h\": [[0.5,1,-0.755],[0.5,1,0.245]]}}}\n";

static const char *write_squares(void) {
  scratch_write_text("squares.json", squares);
  return scratch_path("squares.json");
}

/* Checks that the program succeeds, with this as the beginning of one line on stderr. */
static void expect_warning(const char *begins) {
  assert_int_equal(program_exit_code, 0);
  if (strncmp(program_err, begins, strlen(begins)) != 0) fail_msg("stderr has \"%s\", not \"%s\"", program_err, begins);
  assert_ptr_equal(strchr(program_err, '\n'), program_err + strlen(program_err) - 1);
}

static void the_first_opening_is_named(void **state) {
  (void)state;
  const char *file = write_squares();
  run_program("--valve", file, "--check-crossing", NULL);
  expect_warning("riis-mark: leaflets 0 and 1 cross at opening 0.25: ");
  assert_non_null(strstr(program_err,
                         " of triangles go through each other, along a length of 1; the deepest is 0.005 deep, "
                         "at 0.5 "));
  assert_non_null(strstr(program_out, "crossing  "));
  assert_non_null(strstr(program_out, " at opening 0.25, along a length of 1, up to 0.005 deep\n"));
  /* Warnings stay. */
  run_program("--valve", file, "--check-crossing", "--quiet", NULL);
  expect_warning("riis-mark: leaflets 0 and 1 cross at opening 0.25: ");
  assert_string_equal(program_out, "");
}

static void a_given_opening_is_the_only_one(void **state) {
  (void)state;
  const char *file = write_squares();
  RUN_FINE("--valve", file, "--check-crossing", "--opening", "0.245");
  assert_non_null(strstr(program_out, "crossing  none: no triangles go through each other\n"));
  RUN_FINE("--valve", file, "--check-crossing", "--set", "opening=0.2");
  run_program("--valve", file, "--check-crossing", "--opening", "0.5", NULL);
  expect_warning("riis-mark: leaflets 0 and 1 cross at opening 0.5: ");
  /* Without the option nobody looks. */
  RUN_FINE("--valve", file, "--opening", "0.5", "--surface-output", scratch_path("crossed.vtp"));
  assert_null(strstr(program_out, "crossing"));
  /* A file has one state. */
  run_program("--surface", scratch_path("crossed.vtp"), "--check-crossing", NULL);
  expect_warning("riis-mark: leaflets 0 and 1 cross: ");
  assert_non_null(strstr(program_err, "along a length of 1; "));
}

static void numbers_are_those_of_the_c_interface(void **state) {
  (void)state;
  const double turned[3] = {0, 0, 60};
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_crossings by_c;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_valve_set(valve, "right.rotation", 3, turned));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  expect_fine(riis_find_crossings(surface, NULL, &by_c, sizeof by_c));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  run_program(scratch_path("in.vtu"), "--set", "right.rotation=0,0,60", "--opening", "0", "--check-crossing", "--stats",
              "-", NULL);
  expect_warning("riis-mark: leaflets right and left cross at opening 0: ");
  assert_true(by_c.leaflet_id[0] == RIIS_LEAFLET_RIGHT && by_c.leaflet_id[1] == RIIS_LEAFLET_LEFT);
  const char *json = strstr(program_out, "\"crossings\"");
  assert_non_null(json);
  assert_true(json_number(json, "n_openings") == 0);
  assert_true(json_number(json, "n_pairs") == (double)by_c.n_pairs && by_c.n_pairs > 10);
  assert_true(json_number(json, "length") == by_c.length);
  assert_true(json_number(json, "depth") == by_c.depth);
}

static void a_leaflet_may_cross_itself(void **state) {
  (void)state;
  char text[sizeof squares];
  strcpy(text, squares);
  *(strstr(text, "\"leaflet\": 1") + strlen("\"leaflet\": ")) = '0';
  scratch_write_text("one.json", text);
  run_program("--valve", scratch_path("one.json"), "--check-crossing", NULL);
  expect_warning("riis-mark: leaflet 0 crosses itself at opening 0.25: ");
}

static void the_library_s_valves_do_not_cross(void **state) {
  (void)state;
  static const char all[] = "crossing  none: no triangles go through each other at 101 openings from 0 to 1\n";
  static const char *const kinds[] = {"aortic", "trileaflet", "bileaflet", "mitral"};
  for (int kind = 0; kind < 4; ++kind) {
    RUN_FINE("--valve", kinds[kind], "--check-crossing");
    assert_non_null(strstr(program_out, all));
  }
  static const char *const files[] = {RIIS_EXAMPLES "/prosthesis.json", RIIS_EXAMPLES "/valves/bicuspid.json"};
  for (int file = 0; file < 2; ++file) {
    RUN_FINE("--valve", files[file], "--check-crossing");
    assert_non_null(strstr(program_out, all));
  }
  static const char *const parameters[] = {RIIS_EXAMPLES "/valves/pulmonary.json", RIIS_EXAMPLES "/valves/stenotic.json"};
  for (int file = 0; file < 2; ++file) {
    RUN_FINE("--valve", "trileaflet", "--params", parameters[file], "--check-crossing");
    assert_non_null(strstr(program_out, all));
  }
  /* Between two states, as README.md has them. */
  scratch_write_text("open.json", "{\"leaflet_radius_in\": 1, \"bending_radius_in\": 1.1}");
  RUN_FINE("--params-open", scratch_path("open.json"), "--check-crossing");
  assert_non_null(strstr(program_out, all));
}

static void what_has_no_effect_is_refused(void **state) {
  (void)state;
  RUN_REFUSED(2, "--check-crossing has no effect with --print-params", "--check-crossing", "--print-params");
  RUN_REFUSED(2, "--check-crossing has no effect with --case", "--case", RIIS_EXAMPLES "/beating_valves.json",
              "--check-crossing");
  RUN_REFUSED(2, "--check-crossing has no effect with --times", scratch_path("in.vtu"), "--valve", "mitral", "--cycle",
              "beat.csv", "--times", "0,1", "--check-crossing");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_first_opening_is_named),           cmocka_unit_test(a_given_opening_is_the_only_one),
      cmocka_unit_test(numbers_are_those_of_the_c_interface), cmocka_unit_test(a_leaflet_may_cross_itself),
      cmocka_unit_test(the_library_s_valves_do_not_cross),    cmocka_unit_test(what_has_no_effect_is_refused),
  };
  return cmocka_run_group_tests(tests, make_box, scratch_teardown);
}
