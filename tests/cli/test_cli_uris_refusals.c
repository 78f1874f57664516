/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests refusals of `riis export uris`, which leave no file. Also tests the frames of cycles and of valves from patches. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program.h"
#include "scratch.h"
#include "uris_files.h"

#define FOLDER scratch_path("uris")
#define EXPORT "export", FOLDER, "--resistance", "1e4"
#define RAMPS "--opening-seconds", "0.02", "--closing-seconds", "0.01"

static void expect_nothing_left(void) { assert_false(scratch_exists("uris")); }
static void remove_folder(void) {
  char command[256];
  snprintf(command, sizeof command, "rm -r %s", FOLDER);
  assert_int_equal(system(command), 0);
}

#define REFUSED(exit_code, text, ...) (RUN_REFUSED(exit_code, text, __VA_ARGS__), expect_nothing_left())

/* Runs an export, which must succeed. Returns the data of the export, and removes its folder. */
#define EXPORTED(...) (RUN_FINE(EXPORT, __VA_ARGS__), take_export())
static uris_valve take_export(void) {
  const uris_valve valve = uris_read(program_out);
  remove_folder();
  return valve;
}

/* ---- Usage ---- */

TEST(test_missing_options) {
  REFUSED(2, "--time-step is required", EXPORT, RAMPS);
  REFUSED(2, "--resistance is required", "export", FOLDER, "--time-step", "0.001", RAMPS);
  const char *const text = "riis export needs --opening-seconds and --closing-seconds, or --cycle";
  REFUSED(2, text, EXPORT, "--time-step", "0.001");
  REFUSED(2, text, EXPORT, "--time-step", "0.001", "--closing-seconds", "1");
  REFUSED(2, text, EXPORT, "--time-step", "0.001", "--opening-seconds", "1");
  REFUSED(2, "--opening-span requires --cycle", EXPORT, "--time-step", "0.001", RAMPS, "--opening-span", "0:1");
  REFUSED(2, "--closing-span requires --cycle", EXPORT, "--time-step", "0.001", RAMPS, "--closing-span", "0:1");
  REFUSED(2, "--period requires --cycle", EXPORT, "--time-step", "0.001", RAMPS, "--period", "1");
}

/* svMultiPhysics needs grams and centimetres. */
TEST(test_units) {
  REFUSED(2,
          "--scale: 10 makes lengths in millimetres, and svMultiPhysics needs grams and centimetres: write --unit mm "
          "in place of --scale; riis export then converts the lengths",
          EXPORT, "--time-step", "0.001", RAMPS, "--scale", "10");
  REFUSED(2, "--scale: 0.01 makes lengths in metres", EXPORT, "--time-step", "0.001", RAMPS, "--scale", "0.01");
  REFUSED(2, "--resistance: -1 is below 0", "export", FOLDER, "--resistance", "-1", "--time-step", "0.001", RAMPS);
  REFUSED(2, "--resistance: 'kg/m3' is not a unit of a resistance, such as kg/(m s)", "export", FOLDER, "--resistance",
          "1 kg/m3", "--time-step", "0.001", RAMPS);
}

TEST(test_useless_options) {
  scratch_write_text("c.csv", "0,0\n1,1\n2,0\n");
  const char *cycle = scratch_path("c.csv");
  REFUSED(2, "--opening-seconds excludes --cycle", EXPORT, "--time-step", "0.1", "--cycle", cycle, "--opening-seconds",
          "1");
  REFUSED(2, "--closing-seconds excludes --cycle", EXPORT, "--time-step", "0.1", "--cycle", cycle, "--closing-seconds",
          "1");
  REFUSED(2, "more.vtu is one argument too many", EXPORT, "mesh.vtu", "more.vtu", "--time-step", "0.001", RAMPS);
  REFUSED(2, "--set opening has no effect, because the export contains all openings", EXPORT, "--time-step", "0.001",
          RAMPS, "--set", "opening=0.5");
  const char *const others[] = {"--opening=0.5", "--triangulation=adapted", "--flip-normals", "--surface=s.vtp"};
  for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i)
    REFUSED(2, " is not an option", EXPORT, "--time-step", "0.001", RAMPS, others[i]);
}

TEST(test_numbers) {
  const char *const steps[] = {"0", "-0.001", "nan", "inf", "-inf"};
  for (size_t i = 0; i < sizeof steps / sizeof steps[0]; ++i) {
    char text[64];
    snprintf(text, sizeof text, "--time-step: %s is not above 0 and finite", steps[i]);
    char option[32];
    snprintf(option, sizeof option, "--time-step=%s", steps[i]);
    REFUSED(2, text, EXPORT, option, RAMPS);
  }
  REFUSED(2, "--time-step: 'soon' is not a number", EXPORT, "--time-step", "soon", RAMPS);
  REFUSED(2, "--time-step: 0.02 is longer than the closing, 0.01", EXPORT, "--time-step", "0.02", RAMPS);
  REFUSED(2, "--time-step: 0.03 is longer than the opening, 0.02", EXPORT, "--time-step", "0.03", "--opening-seconds",
          "0.02", "--closing-seconds", "1");
  REFUSED(2, "--time-step: 1e-09 makes 20000001 frames of the opening; at most 100000", EXPORT, "--time-step", "1e-9",
          RAMPS);
  REFUSED(2, "--opening-seconds: 0 is not above 0", EXPORT, "--time-step", "0.001", "--opening-seconds", "0",
          "--closing-seconds", "1");
  REFUSED(2, "--closing-seconds: nan is not above 0", EXPORT, "--time-step", "0.001", "--opening-seconds", "1",
          "--closing-seconds", "nan");
  REFUSED(2, "--largest-edge: 0 is not above 0", EXPORT, "--time-step", "0.001", RAMPS, "--largest-edge", "0");
  REFUSED(2, "--largest-edge: 1e-05 makes more than 2000000 triangles", EXPORT, "--time-step", "0.01", RAMPS,
          "--largest-edge", "1e-5");
  REFUSED(2, "--half-thickness: -1 is not above 0", EXPORT, "--time-step", "0.01", RAMPS, "--half-thickness=-1");
}

TEST(test_spans) {
  scratch_write_text("c.csv", "0,0\n1,1\n2,0\n");
  const char *cycle = scratch_path("c.csv");
#define CYCLE EXPORT, "--time-step", "0.25", "--cycle", cycle
  REFUSED(2, "--opening-span: '0-1' is not START:STOP", CYCLE, "--opening-span", "0-1");
  REFUSED(2, "--opening-span: '0:1:2' is not START:STOP", CYCLE, "--opening-span", "0:1:2");
  REFUSED(2, "--closing-span: 'a' is not a number", CYCLE, "--closing-span", "a:1");
  REFUSED(2, "--closing-span: nan:1 is not finite", CYCLE, "--closing-span", "nan:1");
  REFUSED(2, "--closing-span: the stop of 2:1 is not after its start", CYCLE, "--closing-span", "2:1");
  REFUSED(2, "--opening-span: 1:2 takes the valve from opening 1 to 0", CYCLE, "--opening-span", "1:2");
  REFUSED(2, "--closing-span: 0:1 takes the valve from opening 0 to 1", CYCLE, "--closing-span", "0:1");
  REFUSED(2, "--time-step: 0.25 is longer than the opening, 0.125", CYCLE, "--opening-span", "0.5:0.625");
  scratch_write_text("flat.csv", "0,0.5\n1,0.5\n");
  REFUSED(1, "flat.csv: the opening is 0.5 throughout", EXPORT, "--time-step", "0.25", "--cycle",
          scratch_path("flat.csv"));
  scratch_write_text("up.csv", "0,0\n1,1\n");
  REFUSED(1, "up.csv: the valve does not close there: no key of its least opening follows one of the largest", EXPORT,
          "--time-step", "0.25", "--cycle", scratch_path("up.csv"));
  scratch_write_text("down.csv", "0,1\n1,0\n");
  REFUSED(1, "down.csv: the valve does not open there", EXPORT, "--time-step", "0.25", "--cycle",
          scratch_path("down.csv"));
  REFUSED(1, "none.csv: cannot be read", EXPORT, "--time-step", "0.25", "--cycle", scratch_path("none.csv"));
}

/* ---- The folder ---- */

TEST(test_folders) {
  char text[128];
  assert_int_equal(mkdir(scratch_path("full"), 0777), 0);
  scratch_write_text("full/mine.txt", "mine");
  REFUSED(1, "full: the folder is not empty", "export", scratch_path("full"), "--resistance", "1", "--time-step",
          "0.01", RAMPS);
  char *mine = scratch_read(scratch_path("full/mine.txt"), NULL);
  assert_string_equal(mine, "mine");
  free(mine);
  scratch_write_text("file", "a file");
  REFUSED(1, "file: is a file, not a folder", "export", scratch_path("file"), "--resistance", "1", "--time-step",
          "0.01", RAMPS);
  snprintf(text, sizeof text, "FOLDER: %s: the folder %s does not exist", scratch_path("no/uris"), scratch_path("no"));
  REFUSED(1, text, "export", scratch_path("no/uris"), "--resistance", "1", "--time-step", "0.01", RAMPS);
  REFUSED(2, "has a blank, but svMultiPhysics cannot read a path with blanks", "export", "my folder", "--resistance",
          "1", "--time-step", "0.01", RAMPS);
  /* The export fills an empty folder. A folder's name may end in a slash. */
  const int n_files = scratch_n_files();
  assert_int_equal(mkdir(FOLDER, 0777), 0);
  snprintf(text, sizeof text, "%s/", FOLDER);
  RUN_FINE("export", text, "--resistance", "1", "--time-step", "0.01", RAMPS, "--valve", "mitral");
  assert_null(strstr(program_out, "//"));
  uris_valve valve = take_export();
  uris_free(&valve);
  assert_int_equal(scratch_n_files(), n_files);
}

/* A refused valve, a full disk or an interruption leaves nothing behind, not even the folder. */
TEST(test_nothing_half_written) {
  REFUSED(1, "root_radius", EXPORT, "--time-step", "0.01", RAMPS, "--valve", "trileaflet", "--set", "root_radius=-1");
  REFUSED(1, "opening is 0.", EXPORT, "--time-step", "0.004", RAMPS, "--valve", scratch_path("patch.json"));
  struct rlimit before, small = {100000, 0};
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
  small.rlim_max = before.rlim_max;
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  run_program(EXPORT, "--time-step", "0.001", RAMPS, "--valve", "mitral", NULL);
  setrlimit(RLIMIT_FSIZE, &before);
  expect_run_refused(1, "_open.dat: cannot be written: File too large", __FILE__, __LINE__);
  expect_nothing_left();
  const pid_t process = start_program(EXPORT, "--time-step", "2e-4", RAMPS, "--valve", "mitral", NULL);
  for (int i = 0; i < 100000 && !scratch_exists("uris"); ++i) usleep(1000);
  kill(process, SIGINT);
  finish_program(process);
  assert_int_equal(program_exit_code, 128 + SIGINT);
  expect_nothing_left();
}

/* ---- Names and the first state ---- */

/* Two valves of one kind have different names, because their folders differ. */
TEST(test_names) {
  char name[2][64];
  const char *const folders[] = {"left-heart", "right-heart"};
  for (int i = 0; i < 2; ++i) {
    RUN_FINE("export", scratch_path(folders[i]), "--resistance", "1", "--time-step", "0.01", RAMPS, "--valve",
             "mitral");
    uris_valve valve = uris_read(program_out);
    snprintf(name[i], sizeof name[i], "%s", valve.name);
    assert_true(strspn(name[i], "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.") == strlen(name[i]));
    uris_free(&valve);
  }
  assert_string_not_equal(name[0], name[1]);
  uris_valve valve = EXPORTED("--time-step", "0.01", RAMPS, "--valve", "mitral", "--name", "MV-1");
  assert_string_equal(valve.name, "MV-1");
  uris_free(&valve);
  REFUSED(2, "--name: 'a b' must have 1 to 64 characters: letters, digits, _, . and -, without two - in a row", EXPORT,
          "--time-step", "0.01", RAMPS, "--name", "a b");
  REFUSED(2, "--name: 'a--b' must have", EXPORT, "--time-step", "0.01", RAMPS, "--name", "a--b");
  REFUSED(2, "--ring has no effect: only a bileaflet valve has a ring", EXPORT, "--time-step", "0.01", RAMPS, "--ring",
          "none");
  REFUSED(2, "--starts: half not in {closed,open}", EXPORT, "--time-step", "0.01", RAMPS, "--starts", "half");
}

static void expect_start(const char *value) {
  char text[64];
  snprintf(text, sizeof text, "<Valve_starts_as_closed> %s </Valve_starts_as_closed>", value);
  if (!strstr(program_out, text)) fail_msg("no '%s' in:\n%s", text, program_out);
  remove_folder();
}

TEST(test_first_state) {
  RUN_FINE(EXPORT, "--time-step", "0.01", RAMPS);
  expect_start("true");
  RUN_FINE(EXPORT, "--time-step", "0.01", RAMPS, "--starts", "open");
  expect_start("false");
  scratch_write_text("open.csv", "0,1\n0.3,0\n0.6,0\n0.9,1\n");
  RUN_FINE(EXPORT, "--time-step", "0.1", "--cycle", scratch_path("open.csv"), "--period", "1");
  assert_non_null(strstr(program_out, "at time 0 of the cycle the valve is open, or nearer to this state"));
  expect_start("false");
  RUN_FINE(EXPORT, "--time-step", "0.1", "--cycle", scratch_path("open.csv"), "--period", "1", "--starts", "closed");
  expect_start("true");
  scratch_write_text("shut.csv", "0,0\n0.3,1\n0.6,1\n0.9,0\n");
  RUN_FINE(EXPORT, "--time-step", "0.1", "--cycle", scratch_path("shut.csv"));
  expect_start("true");
}

/* ---- Cycles, and valves of patches ---- */

static void expect_openings(const char *text) {
  if (!strstr(program_out, text)) fail_msg("no '%s' in:\n%s", text, program_out);
}

TEST(test_cycles) {
  /* The valve opens in 0.22:0.29. The valve closes in 0.29:0.66, from the key with the largest opening to the next key with the
   * least opening. */
  scratch_write_text("mitral.csv", "0,0\n0.22,0\n0.29,1\n0.40,0.62\n0.50,0.55\n0.57,0.85\n0.66,0\n");
  uris_valve valve = EXPORTED("--time-step", "0.01", "--valve", "mitral", "--cycle", scratch_path("mitral.csv"));
  assert_int_equal(valve.face[0].n_open, 8);
  assert_int_equal(valve.face[0].n_close, 38);
  expect_openings("opening: 8 frames, from opening 0 to 1\n");
  expect_openings("closing: 38 frames, from opening 1 to 0\n");
  uris_free(&valve);
  /* In a cycle with a period, opening or closing may go beyond the end of the cycle. */
  scratch_write_text("over.csv", "0,0.5\n0.25,1\n0.5,0\n");
  valve = EXPORTED("--time-step", "0.125", "--cycle", scratch_path("over.csv"), "--period", "1", "--interpolation",
                   "cubic");
  assert_int_equal(valve.face[0].n_open, 7);
  assert_int_equal(valve.face[0].n_close, 3);
  uris_free(&valve);
  /* The exported span of time is only a part of the closing. The leaflets therefore jump at the beginning of the exported span,
   * and the program warns about the jump. */
  run_program(EXPORT, "--time-step", "0.01", "--valve", "mitral", "--cycle", scratch_path("mitral.csv"),
              "--closing-span", "0.57:0.66", "--quiet", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_string_equal(program_out, "");
  assert_non_null(
      strstr(program_err, "the leaflets will jump: the opening ends at opening 1, the closing begins at 0.85\n"));
  remove_folder();
}

/* While the patch opens, one of its sides shrinks to a point. Some triangles then have no area. */
TEST(test_patches) {
  scratch_write_text(
      "shrinks.json",
      "{\"curves\": {\"a\": [[0,0,0],[1,0,0]], \"b\": [[0,1,0],[1,1,0]], \"c\": [[0,0,0],[0,1,0]],"
      "\"d\": [[1,0,0],[1,1,0]]}, \"patches\": [{\"v0\": \"a\", \"v1\": \"b\", \"u0\": \"c\", \"u1\": \"d\"}],"
      "\"open\": {\"curves\": {\"a\": [[0,0,0],[1,0,0]], \"b\": [[0,1,0],[0,1,0]], \"c\": [[0,0,0],[0,1,0]],"
      "\"d\": [[1,0,0],[0,1,0]]}}}");
  run_program(EXPORT, "--time-step", "0.01", RAMPS, "--valve", scratch_path("shrinks.json"), NULL);
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_err, "left out: the area is 0 in some frames"));
  uris_valve valve = take_export();
  assert_non_null(strstr(program_out, "<!-- riis, shrinks valve\n"));
  assert_string_equal(valve.face[0].name, "leaflet_0");
  assert_true(valve.normal[2] == 1 && valve.normal[0] == 0);
  uris_free(&valve);
}

static int make_files(void **state) {
  const int status = scratch_setup(state);
  scratch_write_text(
      "patch.json",
      "{\"curves\": {\"a\": [[0,0,0],[1,0,0]], \"b\": [[0,1,0],[1,1,0]], \"c\": [[0,0,0],[0,1,0]],"
      "\"d\": [[1,0,0],[1,1,0]]}, \"patches\": [{\"v0\": \"a\", \"v1\": \"b\", \"u0\": \"c\", \"u1\": \"d\"}]}");
  return status;
}

int main(void) { return run_cases(make_files, scratch_teardown); }
