/* SPDX-License-Identifier: Apache-2.0
 *
 * --steps prints the cost of each step of a moving valve and changes nothing else. */
#include <stdlib.h>
#include <string.h>

#include "program.h"
#include "scratch.h"

static const struct {
  const char *option, *search;
} searches[] = {{"auto", "\"clusters\""},
                {"exhaustive", "\"exhaustive\""},
                {"neighbor", "\"neighbor\""},
                {"clusters", "\"clusters\""}};

TEST(test_steps) {
  for (size_t i = 0; i < sizeof searches / sizeof searches[0]; ++i) {
    const char *const search = searches[i].option;
    RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--opening", "0.99", "--search", search, "--output",
             scratch_path("without.vtu"), "--surface-output", scratch_path("without.vtp"), "--stats", "-");
    assert_null(strstr(program_out, "\"step\""));
    RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--opening", "0.99", "--search", search, "--output",
             scratch_path("with.vtu"), "--surface-output", scratch_path("with.vtp"), "--steps", "5", "--stats", "-");
    assert_true(json_number(program_out, "n_steps") == 5);
    assert_true(json_number(program_out, "seconds_surface") > 0);
    assert_true(json_number(program_out, "seconds_search") > 0);
    assert_true(json_number(program_out, "opening") == 0.99);
    assert_true(json_has_text(strstr(program_out, "\"step\""), "search", searches[i].search));
    assert_true(scratch_is_same("with.vtu", "without.vtu"));
    assert_true(scratch_is_same("with.vtp", "without.vtp"));
  }
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--steps", "1");
  assert_non_null(strstr(program_out, "\nstep      "));
  assert_non_null(strstr(program_out, "median of 1 step of 0.02 in opening, search clusters\n"));
}

TEST(test_refusals) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--steps: 0 is not above 0", "mark", mesh, "--valve", "mitral", "--steps", "0");
  RUN_REFUSED(2, "--steps: -3 is not above 0", "mark", mesh, "--valve", "mitral", "--steps", "-3");
  RUN_REFUSED(2, "--steps", "mark", mesh, "--valve", "mitral", "--steps", "2.5");
  RUN_REFUSED(2, "--steps is not an option", "surface", "--valve", "mitral", "--steps", "2");
  RUN_REFUSED(2, "--surface excludes --steps", "mark", mesh, "--surface", scratch_path("a.vtp"), "--steps", "2");
  /* A valve from patches with only one state cannot move, so it has no steps. */
  scratch_write_text(
      "patch.json",
      "{\"curves\": {\"a\": [[0,0,0],[1,0,0]], \"b\": [[0,1,0],[1,1,0]], \"c\": [[0,0,0],[0,1,0]],"
      "\"d\": [[1,0,0],[1,1,0]]}, \"patches\": [{\"v0\": \"a\", \"v1\": \"b\", \"u0\": \"c\", \"u1\": \"d\"}]}");
  RUN_REFUSED(1, "opening is 0.02, but the patches valve has only one state", "mark", mesh, "--valve",
              scratch_path("patch.json"), "--steps", "2");
}

int main(void) { return run_cases(make_box, scratch_teardown); }
