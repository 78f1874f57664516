// SPDX-License-Identifier: Apache-2.0
// Ends the process if a harness finds a fault. The fuzzer then reports a crash and keeps the input.
#pragma once

#include <cstdio>
#include <cstdlib>

#define EXPECT(condition, ...)                                                         \
  do {                                                                                 \
    if (!(condition)) {                                                                \
      std::fprintf(stderr, "%s:%d: expected: %s\n  ", __FILE__, __LINE__, #condition); \
      std::fprintf(stderr, __VA_ARGS__);                                               \
      std::fputc('\n', stderr);                                                        \
      std::abort();                                                                    \
    }                                                                                  \
  } while (0)
