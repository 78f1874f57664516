/* SPDX-License-Identifier: Apache-2.0
 * Defines the cases of a test, and runs them by CMocka. This header first includes the headers that CMocka's header needs. */
#ifndef RIIS_TEST_CASES_H
#define RIIS_TEST_CASES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* TEST(name) {...} defines a case. The compiler registers each case, so none is forgotten. The cases run in the order of their
 * lines. */
#define TEST(name) TEST_WITH(name, NULL, NULL)

/* Defines a case with its own setup and teardown. In the case, *fixture is the object of the setup. */
#define TEST_WITH(name, setup, teardown)                                              \
  static void name(void **fixture);                                                   \
  __attribute__((constructor)) static void add_##name(void) {                         \
    add_test_case((struct CMUnitTest){#name, name, setup, teardown, NULL}, __LINE__); \
  }                                                                                   \
  static void name(__attribute__((unused)) void **fixture)

void add_test_case(struct CMUnitTest test, int line);

/* Runs all cases, and returns how many failed. The setup runs before the first case, and the teardown after the last case. Setup
 * and teardown may be NULL. */
int run_cases(CMFixtureFunction setup, CMFixtureFunction teardown);

#endif
