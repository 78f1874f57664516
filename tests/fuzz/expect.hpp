// SPDX-License-Identifier: Apache-2.0
// A fault that a harness finds ends the process. The fuzzer takes this for a crash and keeps the input.
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
