/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests --valve FILE.json. The marks of a valve from a file are compared with those of the C interface. Every fault of a file is
 * refused. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "marks.h"
#include "program.h"
#include "scratch.h"

/* A flap of two patches that swings open. The flap has curves of every degree, and one side that is a point. The file lists the
 * curves in another order, also in its "open" state. */
static const char *const flap =
    "{\"curves\": {\"hinge\": [[-1, 0, 0], [0, 0, 0]], \"rim\": [[0, 1.2, -0.3], [-1, 1, 0]],\n"
    "  \"left\": [[-1, 0, 0], [-1, 0.5, 0.4], [-1, 1, 0]], \"middle\": [[0, 0, 0], [0, 0.4, 0.4], [0, 0.8, 0.4], [0, "
    "1.2, "
    "-0.3]],\n"
    "  \"tip\": [[1, 0.5, 0]], \"low\": [[0, 0, 0], [1, 0.5, 0]], \"high\": [[0, 1.2, -0.3], [1, 0.5, 0]]},\n"
    " \"patches\": [{\"v0\": \"hinge\", \"v1\": \"-rim\", \"u0\": \"left\", \"u1\": \"middle\"},\n"
    "  {\"leaflet\": 5, \"u0\": \"middle\", \"u1\": \"-tip\", \"v0\": \"low\", \"v1\": \"high\"}]%s}";
static const char *const flap_open =
    ", \"open\": {\"curves\": {\"rim\": [[0, 1, -1], [-1, 0.8, -1]],\n"
    "  \"hinge\": [[-1, 0, 0], [0, 0, 0]], \"left\": [[-1, 0, 0], [-1, 0.5, 0], [-1, 0.8, -1]],\n"
    "  \"middle\": [[0, 0, 0], [0, 0.4, 0], [0, 0.8, 0], [0, 1, -1]], \"tip\": [[1, 0.5, -1]],\n"
    "  \"low\": [[0, 0, 0], [1, 0.5, -1]], \"high\": [[0, 1, -1], [1, 0.5, -1]]}}";

static const int32_t degree[] = {1, 1, 2, 3, 1, 1, 1};
static const double closed_control[] = {
    -1, 0,   0, 0,  0,   0,   0,  1.2, -0.3, -1, 1,   0,    /* the curves hinge and rim */
    -1, 0,   0, -1, 0.5, 0.4, -1, 1,   0,                   /* left */
    0,  0,   0, 0,  0.4, 0.4, 0,  0.8, 0.4,  0,  1.2, -0.3, /* middle */
    1,  0.5, 0, 1,  0.5, 0,                                 /* tip */
    0,  0,   0, 1,  0.5, 0,   0,  1.2, -0.3, 1,  0.5, 0     /* low and high */
};
static const double open_control[] = {-1,  0,  0,   0,   0,  0, 0, 1, -1,  -1,  0.8, -1,  -1, 0,  0, -1,  0.5,
                                      0,   -1, 0.8, -1,  0,  0, 0, 0, 0.4, 0,   0,   0.8, 0,  0,  1, -1,  1,
                                      0.5, -1, 1,   0.5, -1, 0, 0, 0, 1,   0.5, -1,  0,   1,  -1, 1, 0.5, -1};
static const int32_t curve_id[] = {0, 1, 2, 3, 5, 6, 3, 4};
static const int32_t reversed[] = {0, 1, 0, 0, 0, 0, 0, 1};
static const int32_t leaflet_id[] = {0, 5};

static riis_valve *flap_by_c(const double *control) {
  riis_patches patches;
  riis_valve *valve = NULL;
  expect_fine(riis_patches_init(&patches, sizeof patches));
  patches.n_curves = 7;
  patches.degree = degree;
  patches.control = control;
  patches.n_patches = 2;
  patches.curve_id = curve_id;
  patches.reversed = reversed;
  patches.leaflet_id = leaflet_id;
  expect_fine(riis_valve_create_from_patches(&patches, &valve));
  return valve;
}

/* Writes v.json, which is the flap after one replacement: the first occurrence of `found`. If can_open is not 0, the file has an
 * open state. */
static void write_flap(int can_open, const char *found, const char *replacement) {
  char text[4096], changed[4096];
  snprintf(text, sizeof text, flap, can_open ? flap_open : "");
  const char *place = found ? strstr(text, found) : NULL;
  if (found && !place) fail_msg("no %s in %s", found, text);
  if (place) {
    snprintf(changed, sizeof changed, "%.*s%s%s", (int)(place - text), text, replacement, place + strlen(found));
  } else {
    strcpy(changed, text);
  }
  scratch_write_text("v.json", changed);
}

/* Keeps the path of v.json, because scratch_path would keep it only for a few calls. */
static char file[256];
static void keep_path(void) { snprintf(file, sizeof file, "%s", scratch_path("v.json")); }

static void mark_at(riis_valve *valve, double opening) {
  riis_surface_options options;
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 0.2;
  expect_fine(riis_valve_set_scalar(valve, "opening", opening));
  mark_by_c(valve, &options, RIIS_AUTO, RIIS_FAR_DISTANCE);
}

static void run_at(const char *valve, const char *opening) {
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", valve, "--half-thickness", "0.2", "--opening", opening,
           "--output", scratch_path("out.vtu"), "--surface-output", scratch_path("out.vtp"), "--stats", "-");
  expect_marked_mesh();
  expect_surface_output();
}

TEST(test_marks) {
  riis_valve *valve = flap_by_c(closed_control), *open = flap_by_c(open_control);
  keep_path();
  write_flap(0, NULL, NULL);
  mark_at(valve, 0);
  run_at(file, "0");
  assert_true(json_has_text(program_out, "valve", "\""));
  assert_non_null(strstr(program_out, "v.json\","));
  assert_true(json_number(program_out, "opening") == 0);
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", file);
  assert_non_null(strstr(program_out, "v.json, opening 0: "));
  /* The ending of the file's name may be in capitals. */
  char *text = scratch_read(file, NULL);
  scratch_write_text("V.JSON", text);
  free(text);
  run_at(scratch_path("V.JSON"), "0");
  write_flap(1, NULL, NULL);
  expect_fine(riis_valve_set_open_state(valve, open));
  mark_at(valve, 0.5);
  run_at(file, "0.5");
  assert_true(json_number(program_out, "opening") == 0.5);
  mark_at(valve, 1);
  run_at(file, "1");
  riis_valve_destroy(&valve);
  riis_valve_destroy(&open);
}

/* Every option for parameters accepts the parameters of this valve. */
TEST(test_parameters) {
  keep_path();
  write_flap(1, NULL, NULL);
  RUN_FINE("params", "--valve", file);
  assert_string_equal(program_out, "{\n  \"opening\": 0.0,\n  \"skirt_length\": 0.0\n}\n");
  scratch_write_text("p.json", program_out);
  RUN_FINE("params", "--valve", file, "--params", scratch_path("p.json"), "--opening", "0.25");
  assert_string_equal(program_out, "{\n  \"opening\": 0.25,\n  \"skirt_length\": 0.0\n}\n");
  scratch_write_text("p.json", program_out);
  riis_valve *valve = flap_by_c(closed_control), *open = flap_by_c(open_control);
  expect_fine(riis_valve_set_open_state(valve, open));
  mark_at(valve, 0.25);
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", file, "--params", scratch_path("p.json"), "--half-thickness",
           "0.2", "--output", scratch_path("out.vtu"));
  expect_marked_mesh();
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", file, "--set", "opening=0.25", "--half-thickness", "0.2",
           "--output", scratch_path("out.vtu"));
  expect_marked_mesh();
  riis_valve_destroy(&valve);
  riis_valve_destroy(&open);
  RUN_REFUSED(1, "'root_radius' is not a parameter", "params", "--valve", file, "--set", "root_radius=1");
  RUN_REFUSED(2, "--params-open has no effect with --valve", "mark", scratch_path("in.vtu"), "--valve", file,
              "--opening", "1", "--params-open", scratch_path("p.json"));
  write_flap(0, NULL, NULL);
  RUN_REFUSED(1, "v.json: opening is 0.5, but the file has no \"open\" state", "mark", scratch_path("in.vtu"),
              "--valve", file, "--opening", "0.5");
}

/* A number within 70 arrays. */
#define SEVEN_TIMES(text) text text text text text text text
#define NESTED SEVEN_TIMES("[[[[[[[[[[") "1" SEVEN_TIMES("]]]]]]]]]]")

TEST(test_bad_files) {
  const struct {
    const char *json, *text;
  } files[] = {
      {"", "v.json: is empty"},
      {"{\"curves\": ", "v.json: is not JSON: parse error at line 1"},
      {"[]", "v.json: the file must be an object with curves, patches, open, not of type array"},
      {"{}", "v.json: \"curves\" is missing"},
      {"{\"curves\": {\"a\": [[0,0,0]]}}", "v.json: \"patches\" is missing"},
      {"{\"curves\": [], \"patches\": []}",
       "v.json: \"curves\" must be an object of curves by name, not of type array"},
      {"{\"curves\": {}, \"patches\": []}", "v.json: \"curves\" is empty"},
      {"{\"curves\": {\"a\": [[0,0,0]]}, \"patches\": {}}",
       "v.json: \"patches\" must be an array of patches, not of type "
       "object"},
      {"{\"curves\": {\"a\": [[0,0,0]]}, \"patches\": []}", "v.json: \"patches\" is empty"},
      {"{\"curves\": {\"a\": [[0,0,0]], \"a\": [[0,0,0]]}}", "v.json: a is given twice"},
      {"{\"curves\": {\"a\": [[0,0,0]]}, \"curves\": {}}", "v.json: curves is given twice"},
      {"{\"curves\": {\"a\": " NESTED "}}", "v.json: is nested deeper than curves and patches can be"},
      {"{\"curves\": {\"a\\nb\": [[0,0,0]]}}", "v.json: a name holds a control character"},
      {"{\"curves\": {\"\": [[0,0,0]]}}", "v.json: a curve has an empty name"},
      {"{\"curves\": {\"-a\": [[0,0,0]]}}", "v.json: curve \"-a\": a name must not begin with a minus"},
  };
  for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
    scratch_write_text("v.json", files[i].json);
    RUN_REFUSED(1, files[i].text, "mark", scratch_path("in.vtu"), "--valve", scratch_path("v.json"));
  }
  /* The program finds the fault of this file only when it makes the surface. */
  scratch_write_text("v.json",
                     "{\"curves\": {\"p\": [[0,0,0]]}, \"patches\": [{\"v0\": \"p\", \"v1\": \"p\", \"u0\": \"p\", "
                     "\"u1\": \"-p\"}]}");
  RUN_REFUSED(1, "v.json: the valve has no area", "mark", scratch_path("in.vtu"), "--valve", scratch_path("v.json"));
  RUN_REFUSED(1, "missing.json: cannot be read: No such file", "mark", scratch_path("in.vtu"), "--valve",
              scratch_path("missing.json"));
}

/* Each case adds one fault to a valid file. */
TEST(test_changed_files) {
  const struct {
    int can_open;
    const char *found, *replacement, *text;
  } changes[] = {
      {0, "\"curves\"", "\"colour\": 1, \"curves\"",
       "v.json: the file: \"colour\" is unknown; there are: curves, patches, open"},
      {0, "[[1, 0.5, 0]]", "3", "v.json: curve \"tip\" must be an array of 1 to 4 points, not of type number"},
      {0, "[[1, 0.5, 0]]", "[]", "v.json: curve \"tip\" has 0 points; it must have 1 to 4"},
      {0, "[[1, 0.5, 0]]", "[[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0]]", "v.json: curve \"tip\" has 5 points"},
      {0, "[[1, 0.5, 0]]", "[1, 0.5, 0]", "v.json: curve \"tip\": point 0 is 1; it must be three numbers, [x, y, z]"},
      {0, "[[1, 0.5, 0]]", "[[1, 0.5]]", "v.json: curve \"tip\": point 0 is [1,0.5]; it must be three numbers"},
      {0, "[-1, 0.5, 0.4]", "[-1, \"0.5\", 0.4]",
       "v.json: curve \"left\": point 1 is [-1,\"0.5\",0.4]; it must be three"},
      {0, "[-1, 0.5, 0.4]", "[-1, null, 0.4]", "v.json: curve \"left\": point 1 is [-1,null,0.4]"},
      {0, "[-1, 0.5, 0.4]", "[-1, 1e31, 0.4]", "v.json: y of control point 1 of curve \"left\" is 1e+31"},
      {0, "[-1, 0.5, 0.4]", "[-1, 1e999, 0.4]", "v.json: is not JSON: "},
      {0, "\"leaflet\": 5, ", "\"leaf\": 5, ",
       "v.json: patch 1: \"leaf\" is unknown; there are: v0, v1, u0, u1, leaflet"},
      {0, "\"leaflet\": 5, ", "\"leaflet\": -1, ", "v.json: patch 1: leaflet is -1; it must be a whole number from 0"},
      {0, "\"leaflet\": 5, ", "\"leaflet\": 2.0, ", "v.json: patch 1: leaflet is 2.0; it must be a whole number"},
      {0, "\"leaflet\": 5, ", "\"leaflet\": 2147483648, ", "v.json: patch 1: leaflet is 2147483648; it must be"},
      {0, "\"leaflet\": 5, ", "\"leaflet\": \"left\", ", "v.json: patch 1: leaflet is \"left\"; it must be"},
      {0, "\"leaflet\": 5, ", "\"leaflet\": 5, \"leaflet\": 5, ", "v.json: leaflet is given twice"},
      {0, "\"u1\": \"-tip\", ", "", "v.json: patch 1: \"u1\" is missing"},
      {0, "\"-tip\"", "\"top\"", "v.json: patch 1: u1 is \"top\"; there is no such curve"},
      {0, "\"-tip\"", "\"--tip\"", "v.json: patch 1: u1 is \"--tip\"; there is no such curve"},
      {0, "\"-tip\"", "\"-\"", "v.json: patch 1: u1 is \"-\"; there is no such curve"},
      {0, "\"-tip\"", "4", "v.json: patch 1: u1 is 4; it must be the name of a curve"},
      {0, "[{", "[3, {", "v.json: patch 0 must be an object with v0, v1, u0, u1, leaflet, not of type number"},
      {0, "\"tip\":", "\"idle\": [[0, 0, 0]], \"tip\":", "v.json: curve \"idle\" is a side of no patch"},
      {0, "\"-rim\"", "\"rim\"",
       "v.json: patch 0 does not close: v1 \"rim\" begins in (0, 1.2, -0.3), u0 \"left\" ends in (-1, 1, 0)"},
      {0, "[[1, 0.5, 0]]", "[[1, 0.5, 1]]",
       "v.json: patch 1 does not close: v0 \"low\" ends in (1, 0.5, 0), u1 \"-tip\" begins in "},
      {0, "[-1, 0.5, 0.4]", "[-1, 1e29, 0.4]", "v.json: control points have coordinates up to 1e+29"},
      {1, "\"open\": {", "\"open\": {\"patches\": [], ", "v.json: \"open\": \"patches\" is unknown; there are: curves"},
      {1, "\"open\": {", "\"open\": [{", "v.json: is not JSON"},
      {1, "[[1, 0.5, -1]]", "[[1, 0.5, -1], [1, 0.5, -1], [1, 0.5, -1]]",
       "v.json: open: curve \"tip\" has degree 2, in the closed state 1"},
      {1, "[[1, 0.5, -1]]", "[[1, 0.5, 7]]",
       "v.json: open: patch 1 does not close: v0 \"low\" ends in (1, 0.5, -1), u1 \"-tip\""},
      {1, "[[1, 0.5, -1]]", "[[1, 0.5]]", "v.json: open: curve \"tip\": point 0 is [1,0.5]"},
      {1, "\"tip\": [[1, 0.5, -1]],", "", "v.json: open: curve \"tip\" is missing"},
      {1, "\"tip\": [[1, 0.5, -1]]", "\"top\": [[1, 0.5, -1]]",
       "v.json: open: curve \"top\" is not a curve of the closed state"},
  };
  for (size_t i = 0; i < sizeof changes / sizeof changes[0]; ++i) {
    write_flap(changes[i].can_open, changes[i].found, changes[i].replacement);
    RUN_REFUSED(1, changes[i].text, "mark", scratch_path("in.vtu"), "--valve", scratch_path("v.json"));
  }
  /* A curve without length gets a length, or a curve with length loses it. */
  write_flap(1, "[[1, 0.5, -1]]", "[[1, 0.5, -1], [1, 0.5, -1]]");
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", scratch_path("v.json"), "--opening", "1");
  /* An output must not replace an input. */
  RUN_REFUSED(2, "is also the file of --valve", "mark", scratch_path("in.vtu"), "--valve", scratch_path("v.json"),
              "--stats", scratch_path("v.json"));
}

static int make_patches_box(void **state) {
  return make_box_of(state, (double[3]){-1.4, -1.3, -1.1}, (double[3]){1.3, 1.4, 1.3});
}

static int destroy_all(void **state) {
  forget_marks();
  return scratch_teardown(state);
}

int main(void) { return run_cases(make_patches_box, destroy_all); }
