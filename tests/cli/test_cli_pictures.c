/* SPDX-License-Identifier: Apache-2.0
 *
 * --picture: without a display there is one line and exit code 1, not an abort. With a display there is a file for each option,
 * each with its view. */
#include <riis/riis_vtk.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "virtual_display.h"
#include "vtk_shim.h"

static void test_without_display(void **state) {
  (void)state;
  char display[64] = "";
  const char *before = getenv("DISPLAY");
  if (before) strncpy(display, before, sizeof display - 1);
  unsetenv("DISPLAY");
  RUN_REFUSED(1, "DISPLAY is not set", scratch_path("in.vtu"), "--picture", scratch_path("none.png"));
  assert_int_equal(scratch_exists("none.png"), 0);
  /* The refusal comes before any work: the mesh is also missing, but is not named. */
  RUN_REFUSED(1, "DISPLAY is not set", scratch_path("missing.vtu"), "--picture", scratch_path("none.png"));
  setenv("DISPLAY", ":7654", 1);
  RUN_REFUSED(1, "DISPLAY :7654 cannot be opened", scratch_path("in.vtu"), "--picture", scratch_path("none.png"));
  assert_int_equal(scratch_exists("none.png"), 0);
  /* The marks are good, so the other requested files are there. */
  RUN_REFUSED(1, "DISPLAY :7654 cannot be opened", scratch_path("in.vtu"), "--picture", scratch_path("none.png"),
              "--output", scratch_path("out.vtu"), "--stats", scratch_path("stats.json"));
  assert_true(scratch_exists("out.vtu"));
  char *json = scratch_read(scratch_path("stats.json"), NULL);
  assert_true(json_number(json, "n_nodes") == n_box);
  free(json);
  if (before) {
    setenv("DISPLAY", display, 1);
  } else {
    unsetenv("DISPLAY");
  }
}

static void expect_picture(const char *name) {
  int width = 0, height = 0, n_colours = 0, n_coloured[2] = {0, 0};
  assert_int_equal(shim_read_png(scratch_path(name), &width, &height, &n_colours, n_coloured), 1);
  assert_int_equal(width, 1600);
  assert_int_equal(height, 800);
  assert_true(n_colours > 100);
  assert_true(n_coloured[0] > 30000 && n_coloured[1] > 30000);
}

static void test_pictures(void **state) {
  (void)state;
  RUN_FINE(scratch_path("in.vtu"), "--half-thickness", "0.3", "--picture", scratch_path("1.png"), "--view", "top",
           "--picture", scratch_path("2.png"), "--view", "side", "--picture", scratch_path("3.png"));
  expect_picture("1.png");
  expect_picture("2.png");
  expect_picture("3.png");
  assert_non_null(strstr(program_out, "3.png"));
  /* The third picture had no --view, so its view is oblique. */
  RUN_FINE("--half-thickness", "0.3", "--picture", scratch_path("4.png"), scratch_path("in.vtu"), "--view", "oblique");
  assert_true(scratch_is_same("3.png", "4.png"));
  assert_false(scratch_is_same("1.png", "2.png"));
  assert_false(scratch_is_same("1.png", "3.png"));
  assert_false(scratch_is_same("2.png", "3.png"));
  /* Marks with another name are drawn in the same way. */
  RUN_FINE("--half-thickness", "0.3", "--picture", scratch_path("5.png"), scratch_path("in.vtu"), "--prefix", "left",
           "--output", scratch_path("left.vtu"));
  assert_true(scratch_is_same("3.png", "5.png"));
}

/* Compares a picture of the program with one of the C interface that has the expected title. */
static void expect_title(const char *title, const char *setting, const char *value) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_vtk_picture_options options;
  static const char *const names[3] = {"right", "left", "non-coronary"};
  RUN_FINE("--picture", scratch_path("by_program.png"), setting, value);
  expect_fine(riis_valve_create("aortic", &valve));
  if (strcmp(value, "leaflet_angle=60") == 0) expect_fine(riis_valve_set_scalar(valve, "leaflet_angle", 60));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.title = title;
  options.leaflet_names = names;
  options.n_leaflet_names = 3;
  expect_fine(riis_vtk_draw(surface, NULL, &options, scratch_path("by_c.png")));
  assert_true(scratch_is_same("by_program.png", "by_c.png"));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

/* The title must not let anyone take the paper's aortic valve for a closed one. */
static void test_titles(void **state) {
  (void)state;
  expect_title("Aortic valve, opening 0 (the paper's, not closed)", "--set", "opening=0");
  expect_title("Aortic valve, opening 0 (the paper's, not closed)", "--set", "open_radius_ratio=0.9");
  expect_title("Aortic valve, opening 0", "--set", "leaflet_angle=60");
}

int main(int argc, char **argv) {
  (void)argc;
  enter_virtual_display(argv);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_without_display),
      cmocka_unit_test(test_pictures),
      cmocka_unit_test(test_titles),
  };
  return cmocka_run_group_tests(tests, make_box, scratch_teardown);
}
