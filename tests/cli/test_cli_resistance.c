/* SPDX-License-Identifier: Apache-2.0
 *
 * --resistance writes K of every node beside its distance. The test computes K by the formula of docs/theory/marks.md. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

TEST(test_resistance) {
  static double distance[n_box], resistance[n_box];
  const double R = 10, eps = 0.3, pi = acos(-1);
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "aortic", "--half-thickness", "0.3", "--resistance", "10",
           "--output", scratch_path("out.vtu"));
  assert_int_equal(shim_read_array(scratch_path("out.vtu"), 'p', "riis_distance", NULL, NULL, NULL, distance), 1);
  assert_int_equal(shim_read_array(scratch_path("out.vtu"), 'p', "riis_K", NULL, NULL, NULL, resistance), 1);
  int n_resisting = 0;
  for (int i = 0; i < n_box; ++i) {
    const double expected = distance[i] < eps ? R / eps * (1 + cos(pi * distance[i] / eps)) / (2 * eps) : 0;
    if (fabs(resistance[i] - expected) > 1e-12 * R / eps / eps)
      fail_msg("node %d at %.17g has K %.17g, not %.17g", i, distance[i], resistance[i], expected);
    n_resisting += resistance[i] > 0;
  }
  assert_true(n_resisting > 20);
}

TEST(test_no_array_unless_asked) {
  static double resistance[n_box];
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "aortic", "--half-thickness", "0.3", "--output",
           scratch_path("plain.vtu"));
  assert_int_equal(shim_read_array(scratch_path("plain.vtu"), 'p', "riis_K", NULL, NULL, NULL, resistance), 0);
}

TEST(test_refusals) {
  RUN_REFUSED(2, "--resistance is -1", "mark", scratch_path("in.vtu"), "--valve", "aortic", "--resistance", "-1");
  RUN_REFUSED(2, "--resistance is nan", "mark", scratch_path("in.vtu"), "--valve", "aortic", "--resistance", "nan");
  RUN_REFUSED(2, "--resistance", "mark", scratch_path("in.vtu"), "--valve", "aortic", "--resistance", "ten");
  RUN_REFUSED(2, "--resistance is not an option", "surface", "--valve", "aortic", "--resistance", "1");
  /* The K that another valve wrote is not replaced by accident. */
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "aortic", "--half-thickness", "0.3", "--resistance", "1",
           "--prefix", "a", "--output", scratch_path("a.vtu"));
  RUN_REFUSED(2, "a_marked", "mark", scratch_path("a.vtu"), "--valve", "aortic", "--half-thickness", "0.3",
              "--resistance", "1", "--prefix", "a", "--output", scratch_path("b.vtu"));
}

int main(void) { return run_cases(make_box, NULL); }
