/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests valves that open. The program's marks are compared with those of the C interface. The mitral valve needs no second file,
 * because its kind has an open state. Other valves open between two files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "marks.h"
#include "program.h"
#include "scratch.h"

static const char *const opening_texts[] = {"0", "0.5", "1"};
static const double openings[] = {0, 0.5, 1};
static const char *half_thickness = "0.25"; /* large enough to mark nodes of the coarse box */

static riis_valve *make_valve(const char *kind) {
  riis_valve *valve = NULL;
  expect_fine(riis_valve_create(kind, &valve));
  return valve;
}

static void mark_at(riis_valve *valve, double opening) {
  riis_surface_options options;
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 0.25;
  expect_fine(riis_valve_set_scalar(valve, "opening", opening));
  mark_by_c(valve, &options, RIIS_AUTO, RIIS_FAR_DISTANCE);
}

static void expect_outputs(void) {
  expect_marked_mesh();
  expect_surface_output();
}

#define RUN_ON_BOX(...)                                                                                             \
  RUN_FINE("mark", scratch_path("in.vtu"), "--half-thickness", half_thickness, "--output", scratch_path("out.vtu"), \
           "--surface-output", scratch_path("out.vtp"), __VA_ARGS__)

TEST(test_mitral) {
  riis_valve *valve = make_valve("mitral");
  int64_t n_marked[3];
  for (int i = 0; i < 3; ++i) {
    mark_at(valve, openings[i]);
    n_marked[i] = by_c.stats.n_marked;
    RUN_ON_BOX("--valve", "mitral", "--opening", opening_texts[i], "--stats", "-");
    expect_outputs();
    assert_true(json_has_text(program_out, "valve", "\"mitral\""));
    assert_true(json_number(program_out, "opening") == openings[i]);
    char title[64];
    snprintf(title, sizeof title, "mitral valve, opening %s: ", opening_texts[i]);
    RUN_ON_BOX("--valve", "mitral", "--opening", opening_texts[i]);
    assert_non_null(strstr(program_out, title));
  }
  assert_true(n_marked[0] != n_marked[1] && n_marked[1] != n_marked[2]);
  /* The mitral valve is open by default. --set and a file can also set the opening, and --opening overrides both. */
  mark_at(valve, 1);
  RUN_ON_BOX("--valve", "mitral");
  expect_outputs();
  mark_at(valve, 0.25);
  RUN_ON_BOX("--valve", "mitral", "--set", "opening=0.25");
  expect_outputs();
  scratch_write_text("p.json", "{\"opening\": 0.25}");
  RUN_ON_BOX("--valve", "mitral", "--params", scratch_path("p.json"));
  expect_outputs();
  scratch_write_text("p.json", "{\"opening\": 0.75}");
  RUN_ON_BOX("--opening", "0.25", "--valve", "mitral", "--params", scratch_path("p.json"));
  expect_outputs();
  riis_valve_destroy(&valve);
}

TEST(test_bileaflet) {
  riis_valve *valve = make_valve("bileaflet");
  for (int i = 0; i < 3; ++i) {
    mark_at(valve, openings[i]);
    RUN_ON_BOX("--valve", "bileaflet", "--opening", opening_texts[i], "--stats", "-");
    expect_outputs();
    assert_true(json_has_text(program_out, "valve", "\"bileaflet\""));
    assert_true(json_number(program_out, "opening") == openings[i]);
  }
  /* The bileaflet valve is closed by default. The program counts the bileaflet valve's ring as a third leaflet. */
  mark_at(valve, 0);
  RUN_ON_BOX("--valve", "bileaflet");
  expect_outputs();
  expect_fine(riis_valve_set_scalar(valve, "ring_height", 0.5));
  mark_at(valve, 1);
  RUN_ON_BOX("--valve", "bileaflet", "--set", "ring_height=0.5", "--opening", "1");
  expect_outputs();
  RUN_REFUSED(1, "closed_angle is 30; it must be less than open_angle, which is 20", "mark", scratch_path("in.vtu"),
              "--valve", "bileaflet", "--set", "open_angle=20", "--stats", "-");
  riis_valve_destroy(&valve);
}

/* Tests the kinds that open without a second file. */
TEST(test_own_open_states) {
  static const char *const kinds[3] = {"aortic", "trileaflet", "coapting"};
  for (int k = 0; k < 3; ++k) {
    riis_valve *valve = make_valve(kinds[k]);
    for (int i = 0; i < 3; ++i) {
      mark_at(valve, openings[i]);
      RUN_ON_BOX("--valve", kinds[k], "--opening", opening_texts[i]);
      expect_outputs();
    }
    riis_valve_destroy(&valve);
  }
}

/* One parameter file defines the closed state, and another the open state. */
TEST(test_aortic) {
  riis_valve *closed = make_valve("aortic"), *open = make_valve("aortic");
  expect_fine(riis_valve_set_scalar(closed, "leaflet_angle", 68));
  expect_fine(riis_valve_set_scalar(closed, "root_radius", 1.25));
  expect_fine(riis_valve_set_scalar(open, "leaflet_angle", 45));
  /* An opening in the open state's file has no effect. */
  scratch_write_text("closed.json", "{\"leaflet_angle\": 68}");
  scratch_write_text("open.json", "{\"leaflet_angle\": 45, \"opening\": 0.3}");
  expect_fine(riis_valve_set_open_state(closed, open));
  for (int i = 0; i < 3; ++i) {
    mark_at(closed, 0.5 * i);
    /* --set changes only the closed state. */
    RUN_ON_BOX("--params-closed", scratch_path("closed.json"), "--params-open", scratch_path("open.json"), "--set",
               "root_radius=1.25", "--opening", opening_texts[i]);
    expect_outputs();
    char setting[32];
    snprintf(setting, sizeof setting, "opening=%s", opening_texts[i]);
    RUN_ON_BOX("--params", scratch_path("closed.json"), "--params-open", scratch_path("open.json"), "--set",
               "root_radius=1.25", "--set", setting);
    expect_outputs();
  }
  riis_valve_destroy(&closed);
  riis_valve_destroy(&open);
}

/* Half way between two states, the surface's area lies between the areas of the states. */
TEST(test_between) {
  scratch_write_text("open.json", "{\"leaflet_angle\": 50}");
  double area[3];
  for (int i = 0; i < 3; ++i) {
    RUN_FINE("mark", scratch_path("in.vtu"), "--params-open", scratch_path("open.json"), "--opening", opening_texts[i],
             "--half-thickness", half_thickness, "--stats", "-");
    area[i] = json_number(program_out, "area");
    assert_true(json_has_text(program_out, "valve", "\"aortic\""));
  }
  assert_true((area[0] < area[1] && area[1] < area[2]) || (area[0] > area[1] && area[1] > area[2]));
}

/* With two files, the closed curves come from the first file, and the open curves from the second. */
TEST(test_mitral_states) {
  riis_valve *valve = make_valve("mitral"), *open = make_valve("mitral");
  expect_fine(riis_valve_set_scalar(valve, "anterior_horn_height", 0.5));
  expect_fine(riis_valve_set_scalar(open, "leaflet_inward_angle", 85));
  expect_fine(riis_valve_set_open_state(valve, open));
  scratch_write_text("closed.json", "{\"anterior_horn_height\": 0.5}");
  scratch_write_text("open.json", "{\"leaflet_inward_angle\": 85}");
  for (int i = 0; i < 3; ++i) {
    mark_at(valve, openings[i]);
    RUN_ON_BOX("--valve", "mitral", "--params-closed", scratch_path("closed.json"), "--params-open",
               scratch_path("open.json"), "--opening", opening_texts[i]);
    expect_outputs();
  }
  riis_valve_destroy(&valve);
  riis_valve_destroy(&open);
}

TEST(test_refusals) {
  char mesh[256], file[256]; /* copies, since scratch_path keeps its result only for a few calls */
  snprintf(mesh, sizeof mesh, "%s", scratch_path("in.vtu"));
  snprintf(file, sizeof file, "%s", scratch_path("p.json"));
  scratch_write_text("p.json", "{\"root_radius\": 1.3}");
  RUN_REFUSED(2, "--opening: 1.5 is not from 0 to 1", "mark", mesh, "--opening", "1.5");
  RUN_REFUSED(2, "--opening: -0.1 is not from 0 to 1", "mark", mesh, "--opening", "-0.1");
  RUN_REFUSED(2, "--opening: nan is not from 0 to 1", "mark", mesh, "--opening", "nan");
  RUN_REFUSED(2, "--opening: 'half' is not a number", "mark", mesh, "--opening", "half");
  RUN_REFUSED(1, "--set: parameter 'opening' is 1.5", "mark", mesh, "--set", "opening=1.5");
  RUN_REFUSED(2, "--opening and --set opening exclude each other", "mark", mesh, "--opening", "0", "--set",
              "opening=0");
  RUN_REFUSED(2, "--opening excludes --surface", "mark", mesh, "--opening", "0", "--surface", "a.stl");
  RUN_REFUSED(2, "--params-open", "mark", mesh, "--params-open", file, "--surface", "a.stl");
  RUN_REFUSED(2, "--params-open needs --opening", "mark", mesh, "--params-open", file);
  RUN_REFUSED(2, "--params", "mark", mesh, "--params", file, "--params-closed", file);
  RUN_REFUSED(1, "missing.json: cannot be read", "mark", mesh, "--params-open", scratch_path("missing.json"),
              "--opening", "0");
  RUN_REFUSED(1, "missing.json: cannot be read", "mark", mesh, "--params-closed", scratch_path("missing.json"));
  /* A file may only contain parameters of its kind of valve. */
  RUN_REFUSED(1, "p.json: 'root_radius' is not a parameter of the mitral valve", "mark", mesh, "--valve", "mitral",
              "--params-open", file, "--opening", "0");
  RUN_REFUSED(1, "'left.leaflet_angle' is not a parameter of the mitral valve", "mark", mesh, "--valve", "mitral",
              "--set", "left.leaflet_angle=3");
  RUN_REFUSED(1, "is not a kind of valve; there are: aortic, bi", "mark", mesh, "--valve", "pulmonary");
  RUN_REFUSED(1, ", trileaflet, diseases (riis help diseases), and files of patches, FILE.json", "mark", mesh,
              "--valve", "pulmonary");
  /* An output must not replace an input. */
  RUN_REFUSED(2, "is also the file of --params-open", "mark", mesh, "--params-open", file, "--opening", "0", "--stats",
              file);
}

static int make_mitral_box(void **state) {
  return make_box_of(state, (double[3]){-2.2, -1.8, -1.3}, (double[3]){2.2, 2, 2});
}

static int destroy_all(void **state) {
  forget_marks();
  return scratch_teardown(state);
}

int main(void) { return run_cases(make_mitral_box, destroy_all); }
