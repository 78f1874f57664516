/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests `riis check crossings` with a known crossing. The command is also compared with the C interface, and run on the library's
 * own valves. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "calls.h"
#include "expect.h"
#include "program.h"
#include "scratch.h"

/* A unit square lies at z = 0. A second square stands upright at x = 0.5. This square's lower side is at z = 0.245 when closed
 * and at z = -0.755 when open. */
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

/* Checks the exit code, and that stderr has one line that begins with this text. */
static void expect_warning(int exit_code, const char *begins) {
  assert_int_equal(program_exit_code, exit_code);
  assert_string_equal(program_err, "");
  if (strncmp(program_crossings, begins, strlen(begins)) != 0)
    fail_msg("stderr has \"%s\", not \"%s\"", program_crossings, begins);
  assert_ptr_equal(strchr(program_crossings, '\n'), program_crossings + strlen(program_crossings) - 1);
}

TEST(the_first_opening_is_named) {
  const char *file = write_squares();
  run_program("check", "crossings", "--valve", file, NULL);
  expect_warning(4, "riis: leaflets 0 and 1 cross at opening 0.25: ");
  assert_non_null(strstr(program_crossings,
                         " of triangles go through each other, along a length of 1; the deepest is 0.005 deep, "
                         "at 0.5 "));
  assert_non_null(strstr(program_out, "crossing  "));
  assert_non_null(strstr(program_out, " at opening 0.25, along a length of 1, up to 0.005 deep\n"));
  /* --quiet does not suppress warnings. */
  run_program("check", "crossings", "--valve", file, "--quiet", NULL);
  expect_warning(4, "riis: leaflets 0 and 1 cross at opening 0.25: ");
  assert_string_equal(program_out, "");
}

TEST(a_given_opening_is_the_only_one) {
  const char *file = write_squares();
  RUN_FINE("check", "crossings", "--valve", file, "--opening", "0.245");
  assert_non_null(strstr(program_out, "crossing  none: no triangles go through each other\n"));
  RUN_FINE("check", "crossings", "--valve", file, "--set", "opening=0.2");
  run_program("check", "crossings", "--valve", file, "--opening", "0.5", NULL);
  expect_warning(4, "riis: leaflets 0 and 1 cross at opening 0.5: ");
  /* `riis surface` gives the warning of `riis check crossings --opening 0.5`, at any opening that it writes. */
  run_program("surface", "--valve", file, "--opening", "0.5", "--output", scratch_path("crossed.vtp"), NULL);
  expect_warning(0, "riis: leaflets 0 and 1 cross at opening 0.5: ");
  run_program("surface", "--valve", file, "--opening", "0.1", "--output", scratch_path("sound.vtp"), NULL);
  expect_warning(0, "riis: leaflets 0 and 1 cross at opening 0.5: ");
  /* A surface from a file has only one state. */
  run_program("check", "crossings", "--surface", scratch_path("crossed.vtp"), NULL);
  expect_warning(4, "riis: leaflets 0 and 1 cross: ");
  assert_non_null(strstr(program_crossings, "along a length of 1; "));
}

TEST(numbers_are_those_of_the_c_interface) {
  const double turned[3] = {0, 0, 60};
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_crossing_list by_c;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_valve_set(valve, "right.rotation", 3, turned));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  expect_fine(find_crossings_in(surface, NULL, &by_c));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  run_program("check", "crossings", "--set", "right.rotation=0,0,60", "--opening", "0", "--stats", "-", NULL);
  expect_warning(4, "riis: leaflets right and left cross at opening 0: ");
  assert_true(by_c.deepest_leaflet_id[0] == RIIS_LEAFLET_RIGHT && by_c.deepest_leaflet_id[1] == RIIS_LEAFLET_LEFT);
  const char *json = strstr(program_out, "\"crossings\"");
  assert_non_null(json);
  assert_true(json_number(json, "n_openings") == 0);
  assert_true(json_number(json, "n_pairs") == (double)by_c.n_pairs && by_c.n_pairs > 10);
  assert_true(json_number(json, "length") == by_c.total_length);
  assert_true(json_number(json, "depth") == by_c.deepest_depth);
}

TEST(a_leaflet_may_cross_itself) {
  char text[sizeof squares];
  strcpy(text, squares);
  *(strstr(text, "\"leaflet\": 1") + strlen("\"leaflet\": ")) = '0';
  scratch_write_text("one.json", text);
  run_program("check", "crossings", "--valve", scratch_path("one.json"), NULL);
  expect_warning(4, "riis: leaflet 0 crosses itself at opening 0.25: ");
}

TEST(the_library_s_valves_do_not_cross) {
  static const char all[] = "crossing  none: no triangles go through each other at 101 openings from 0 to 1\n";
  static const char *const kinds[] = {"aortic", "trileaflet", "bileaflet", "mitral", "coapting"};
  for (int kind = 0; kind < 5; ++kind) {
    RUN_FINE("check", "crossings", "--valve", kinds[kind]);
    assert_non_null(strstr(program_out, all));
  }
  static const char *const files[] = {RIIS_EXAMPLES "/prosthesis.json", RIIS_EXAMPLES "/valves/bicuspid.json"};
  for (int file = 0; file < 2; ++file) {
    RUN_FINE("check", "crossings", "--valve", files[file]);
    assert_non_null(strstr(program_out, all));
  }
  static const char *const parameters[] = {RIIS_EXAMPLES "/valves/pulmonary.json",
                                           RIIS_EXAMPLES "/valves/stenotic.json"};
  for (int file = 0; file < 2; ++file) {
    RUN_FINE("check", "crossings", "--valve", "trileaflet", "--params", parameters[file]);
    assert_non_null(strstr(program_out, all));
  }
  /* The valve opens between two states, as README.md shows. */
  scratch_write_text("open.json", "{\"leaflet_radius_in\": 1, \"bending_radius_in\": 1.1}");
  RUN_FINE("check", "crossings", "--params-open", scratch_path("open.json"));
  assert_non_null(strstr(program_out, all));
}

/* ---- Shapes that the user chose ---- */

/* A valve with tall leaflets whose bending curve keeps its place, so the cusps cross. */
#define TALL "--valve", "trileaflet", "--set", "leaflet_height=1.3", "--set", "bending_height=0.6"

static const char tall_crosses[] = "riis: leaflets right and non-coronary cross at opening 0: ";
static const char advice[] = "; change the sizes, and look at all openings by riis check crossings\n";

static void expect_tall(const char *begins) {
  expect_warning(0, begins);
  assert_non_null(strstr(program_crossings, advice));
}

TEST(what_has_no_effect_is_refused) {
  RUN_REFUSED(2, "in.vtu is one argument too many", "check", "crossings", scratch_path("in.vtu"));
  RUN_REFUSED(2, "--valve excludes --case", "check", "crossings", "--case", RIIS_EXAMPLES "/beating_valves.json",
              "--valve", "mitral");
  RUN_REFUSED(2, "--times is not an option", "check", "crossings", "--valve", "mitral", "--times", "0,1");
}

/* The numbers equal those of the C interface. The numbers do not depend on the valve's present opening. */
TEST(a_chosen_shape_is_looked_at) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_crossing_list by_c;
  char pairs[128];
  expect_fine(riis_valve_create("trileaflet", &valve));
  expect_fine(riis_valve_set_scalar(valve, "leaflet_height", 1.3));
  expect_fine(riis_valve_set_scalar(valve, "bending_height", 0.6));
  expect_fine(riis_valve_set_scalar(valve, "opening", 0));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  expect_fine(find_crossings_in(surface, NULL, &by_c));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  assert_true(by_c.n_pairs > 50);
  snprintf(pairs, sizeof pairs, "%s%lld pairs of triangles", tall_crosses, (long long)by_c.n_pairs);
  const char *const openings[] = {"0", "0.7", "1"};
  for (int i = 0; i < 3; ++i) {
    run_program("mark", scratch_path("in.vtu"), TALL, "--opening", openings[i], "--quiet", "--stats", "-", NULL);
    expect_tall(pairs);
    const char *json = strstr(program_out, "\"crossings\"");
    assert_non_null(json);
    assert_true(json_number(json, "n_openings") == 1 && json_number(json, "opening") == 0);
    assert_true(json_number(json, "n_pairs") == (double)by_c.n_pairs);
    assert_true(json_number(json, "depth") == by_c.deepest_depth);
  }
  run_program("mark", scratch_path("in.vtu"), TALL, "--strict", NULL);
  assert_int_equal(program_exit_code, 4);
  /* The warning of `riis check crossings` does not recommend the command itself. */
  run_program("check", "crossings", TALL, NULL);
  expect_warning(4, tall_crosses);
  assert_null(strstr(program_crossings, advice));
}

/* The warning appears for every way to choose a shape, in every kind of run. */
TEST(every_run_looks) {
  const char *in = scratch_path("in.vtu");
  scratch_write_text("tall.json", "{\"leaflet_height\": 1.3, \"bending_height\": 0.6}");
  run_program("mark", in, "--valve", "trileaflet", "--params", scratch_path("tall.json"), NULL);
  expect_tall(tall_crosses);
  run_program("surface", "--valve", write_squares(), "--output", scratch_path("half_open.vtp"), NULL);
  expect_tall("riis: leaflets 0 and 1 cross at opening 0.5: ");
  /* The user chose only the shape of the open state. The closed state is the paper's. */
  scratch_write_text("turned.json", "{\"right.rotation\": [0, 0, 60]}");
  run_program("mark", in, "--valve", "aortic", "--params-open", scratch_path("turned.json"), "--opening", "0", NULL);
  expect_tall("riis: leaflets right and left cross at opening ");
  run_program("states", scratch_path("states.csv"), TALL, "--count", "2", NULL);
  expect_tall(tall_crosses);
  run_program("export", scratch_path("uris"), TALL, "--resistance", "1", "--time-step", "0.01", "--opening-seconds",
              "0.02", "--closing-seconds", "0.02", NULL);
  expect_tall(tall_crosses);
  scratch_write_text("beat.csv", "0,0\n1,1\n");
  run_program("mark", in, TALL, "--cycle", scratch_path("beat.csv"), "--times", "0,0.5,1", "--output",
              scratch_path("s.pvd"), "--quiet", NULL);
  expect_tall(tall_crosses);
  scratch_write_text("case.json",
                     "{\"mesh\": \"in.vtu\", \"valves\": ["
                     "{\"name\": \"a\", \"valve\": \"trileaflet\", \"parameters\": {\"leaflet_height\": 1.3, "
                     "\"bending_height\": 0.6}},"
                     "{\"name\": \"b\", \"valve\": \"trileaflet\"}]}");
  run_program("mark", "--case", scratch_path("case.json"), "--output", scratch_path("case.vtu"), NULL);
  expect_tall("riis: a: leaflets right and non-coronary cross at opening 0: ");
}

/* A placement or an opening does not change the shape. A bileaflet valve's hinges reach into its housing, which is not a
 * fault. */
TEST(sound_shapes_are_not_named) {
  static const char *const kinds[] = {"aortic", "trileaflet", "mitral", "bileaflet", "coapting"};
  const char *in = scratch_path("in.vtu");
  for (int kind = 0; kind < 5; ++kind) {
    RUN_FINE("mark", in, "--valve", kinds[kind], "--opening", "0.4", "--rotate", "1,0,0,10", "--translate", "0,0,0.1",
             "--half-thickness", "0.2", "--stats", "-");
    assert_string_equal(program_crossings, "");
    assert_null(strstr(program_out, "\"crossings\""));
  }
  RUN_FINE("mark", in, "--valve", "bileaflet", "--set", "ring_height=0.5", "--stats", "-");
  assert_string_equal(program_crossings, "");
  assert_true(json_number(strstr(program_out, "\"crossings\""), "n_openings") == 3);
  run_program("check", "crossings", "--valve", "bileaflet", "--set", "ring_height=0.5", NULL);
  assert_true(program_crossings[0] != 0);
  RUN_FINE("mark", in, "--valve", "mitral", "--set", "anterior_length=2.2", "--triangulation", "fixed");
  assert_string_equal(program_crossings, "");
  static const char *const files[] = {RIIS_EXAMPLES "/prosthesis.json", RIIS_EXAMPLES "/valves/bicuspid.json"};
  for (int file = 0; file < 2; ++file) {
    RUN_FINE("mark", in, "--valve", files[file], "--allow-none");
    assert_string_equal(program_crossings, "");
  }
}

int main(void) { return run_cases(make_box, scratch_teardown); }
