/* SPDX-License-Identifier: Apache-2.0
 * Defines IS_SANITIZED if the address or the thread sanitizer replaces the allocator; gcc and clang report this differently. */
#ifndef RIIS_TEST_SANITIZED_H
#define RIIS_TEST_SANITIZED_H

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

#endif
