/* SPDX-License-Identifier: Apache-2.0
 *
 * Without a display, riis refuses a picture. VTK alone would abort the process. */
#include <riis/riis_vtk.h>
#include <stdint.h>
#include <stdlib.h>

#include "expect.h"
#include "scratch.h"

static void expect_unavailable(const char *display, const char *part_of_text) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  if (display) {
    setenv("DISPLAY", display, 1);
  } else {
    unsetenv("DISPLAY");
  }
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  const int n_before = scratch_n_files();
  scratch_watch_output();
  const riis_status status = riis_vtk_draw(surface, NULL, NULL, scratch_path("a.png"));
  const long n_printed = scratch_end_watch();
  expect_refused(status, RIIS_UNAVAILABLE, part_of_text);
  expect_refused(status, RIIS_UNAVAILABLE, "xvfb-run");
  assert_int_equal(n_printed, 0);
  riis_vtk_film *film = NULL;
  const double lower[3] = {-1, -1, -1}, upper[3] = {1, 1, 1};
  expect_refused(riis_vtk_film_create(NULL, lower, upper, NULL, &film), RIIS_UNAVAILABLE, part_of_text);
  assert_null(film);
  assert_int_equal(scratch_n_files(), n_before);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

TEST(test_no_display) {
  expect_unavailable(NULL, "DISPLAY is not set");
  expect_unavailable("", "DISPLAY is not set");
  expect_unavailable(":7654", "DISPLAY :7654 cannot be opened");
  expect_unavailable("nonsense", "DISPLAY nonsense cannot be opened");
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
