/* SPDX-License-Identifier: Apache-2.0
 * Defines IS_SANITIZED if the address or the thread sanitizer replaces the allocator; gcc and clang report a sanitizer
 * differently. */
#ifndef RIIS_TEST_SANITIZED_H
#define RIIS_TEST_SANITIZED_H

#include <stdlib.h>
#include <string.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define IS_SANITIZED 1
#endif
#endif

static inline int is_sanitized(void) {
#ifdef IS_SANITIZED
  return 1;
#else
  return 0;
#endif
}

/* Returns whether tests are short, as they are with a sanitizer or with RIIS_TEST_SHORT=1. Runs in an emulator set this variable,
 * because an emulator is slow. */
static inline int is_short_test(void) {
  const char *given = getenv("RIIS_TEST_SHORT");
  return is_sanitized() || (given && strcmp(given, "1") == 0);
}

#endif
