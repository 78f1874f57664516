/* SPDX-License-Identifier: Apache-2.0
 * Provides the common parts of all tests: the definition of cases, checks on doubles, and random numbers with a printed seed.
 * CMocka 1.1.5 compares only floats. */
#ifndef RIIS_TEST_SUPPORT_H
#define RIIS_TEST_SUPPORT_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "sanitized.h"
#include "test_cases.h"

/* Checks that |a - b| <= tolerance and that neither is NaN. */
#define CHECK_NEAR(a, b, tolerance)                                                                                   \
  do {                                                                                                                \
    const double check_a = (a), check_b = (b), check_t = (tolerance);                                                 \
    if (!(fabs(check_a - check_b) <= check_t))                                                                        \
      fail_msg("%s = %.17g, %s = %.17g: differ by %.3g, more than %.3g", #a, check_a, #b, check_b, check_a - check_b, \
               check_t);                                                                                              \
  } while (0)

#define CHECK_AT_MOST(a, limit)                                                                              \
  do {                                                                                                       \
    const double check_a = (a), check_l = (limit);                                                           \
    if (!(check_a <= check_l)) fail_msg("%s = %.17g is more than %s = %.17g", #a, check_a, #limit, check_l); \
  } while (0)

/* Checks that a and b have the same bits. */
#define CHECK_SAME(a, b)                                                               \
  do {                                                                                 \
    const double check_a = (a), check_b = (b);                                         \
    if (memcmp(&check_a, &check_b, sizeof check_a) != 0)                               \
      fail_msg("%s = %.17g, %s = %.17g: not the same bits", #a, check_a, #b, check_b); \
  } while (0)

#ifdef RIIS_RIIS_H
#define CHECK_OK(call)                                                                                   \
  do {                                                                                                   \
    const riis_status check_s = (call);                                                                  \
    if (check_s != RIIS_OK) fail_msg("%s: %s: %s", #call, riis_status_name(check_s), riis_last_error()); \
  } while (0)

/* Checks that the call is refused with this status and message. The message must contain up to three parts, which '|'
 * separates. */
static inline void check_refused(riis_status expected, riis_status got, const char *parts, const char *call) {
  char copy[256];
  if (got != expected)
    fail_msg("%s: %s instead of %s (%s)", call, riis_status_name(got), riis_status_name(expected), riis_last_error());
  snprintf(copy, sizeof copy, "%s", parts);
  for (char *part = strtok(copy, "|"); part; part = strtok(NULL, "|"))
    if (!strstr(riis_last_error(), part)) fail_msg("%s: the text \"%s\" lacks \"%s\"", call, riis_last_error(), part);
}
#define CHECK_REFUSED(status, parts, call) check_refused(status, call, parts, #call)
#endif

/* Random numbers by splitmix64. RIIS_TEST_SEED gives the seed, so that a run can be repeated. The default seed is the time. */
typedef struct random_source {
  uint64_t state;
} random_source;

static inline random_source random_start(const char *name) {
  const char *given = getenv("RIIS_TEST_SEED");
  struct timespec now;
  random_source random;
  timespec_get(&now, TIME_UTC);
  random.state = given ? strtoull(given, NULL, 10) : ((uint64_t)now.tv_sec << 20) ^ (uint64_t)now.tv_nsec;
  printf("%s: RIIS_TEST_SEED=%llu\n", name, (unsigned long long)random.state);
  return random;
}

/* Returns whether RIIS_TEST_LONG=1 requests many more random trials. */
static inline int is_long_test(void) {
  const char *given = getenv("RIIS_TEST_LONG");
  return given && strcmp(given, "1") == 0;
}

/* Returns how many random trials to make: usually n, and n_long with RIIS_TEST_LONG=1. A short test makes a twentieth of n, at
 * least one. Few trials suffice for a sanitizer or an emulator, because further trials rarely run other code. */
static inline int trials(int n, int n_long) { return is_long_test() ? n_long : is_short_test() ? (n + 19) / 20 : n; }

/* Returns how many of n random trials to make: usually a fifth, and all with RIIS_TEST_LONG=1. */
static inline int trials_of(int n) { return trials((n + 4) / 5, n); }

/* Returns the step of a loop over combinations, such as kinds of valves with triangulations. A short test tries every eleventh
 * combination. The number of kinds is seldom a multiple of eleven, so the tried combinations include each kind. */
static inline int trial_step(void) { return is_short_test() ? 11 : 1; }

/* Checks that the random trials have covered a condition. A short test makes too few trials to cover every condition. */
#define CHECK_MET(condition) assert_true(is_short_test() || (condition))

static inline uint64_t random_bits(random_source *random) {
  uint64_t z = (random->state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

static inline double random_between(random_source *random, double low, double high) {
  return low + (high - low) * ((double)(random_bits(random) >> 11) * 0x1p-53);
}

/* Returns 10^x, with x uniform. */
static inline double random_power_of_ten(random_source *random, double from, double to) {
  return pow(10, random_between(random, from, to));
}

#endif
