/* SPDX-License-Identifier: Apache-2.0
 * Defines IS_SANITIZED where the address or the thread sanitizer owns the memory: gcc and clang tell it differently. */
#ifndef RIIS_TEST_SANITIZED_H
#define RIIS_TEST_SANITIZED_H

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define IS_SANITIZED 1
#endif
#endif

#endif
