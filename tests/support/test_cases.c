/* SPDX-License-Identifier: Apache-2.0 */
#include "test_cases.h"

#include <stdio.h>
#include <stdlib.h>

enum { most_cases = 100 };
static struct CMUnitTest cases[most_cases];
static int line_of[most_cases];
static size_t n_cases = 0;
static int were_run = 0;

static void give_up(const char *text) {
  fprintf(stderr, "%s\n", text);
  _Exit(1);
}

static void check_that_they_were_run(void) {
  if (!were_run) give_up("the main of a test must call run_cases");
}

void add_test_case(struct CMUnitTest test, int line) {
  if (n_cases == most_cases) give_up("a test has too many cases for test_cases.c");
  if (n_cases == 0) atexit(check_that_they_were_run);
  size_t at = n_cases++;
  for (; at > 0 && line_of[at - 1] > line; --at) {
    cases[at] = cases[at - 1];
    line_of[at] = line_of[at - 1];
  }
  cases[at] = test;
  line_of[at] = line;
}

int run_cases(CMFixtureFunction setup, CMFixtureFunction teardown) {
  were_run = 1;
  if (n_cases == 0) give_up("a test without cases");
  return _cmocka_run_group_tests("tests", cases, n_cases, setup, teardown);
}
