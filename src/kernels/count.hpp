// SPDX-License-Identifier: Apache-2.0
// Counts what kernels compute, where they are compiled with RIIS_COUNT_OPERATIONS. Only ./run bench roofline links such kernels;
// in all others this is no code.
#pragma once

#include <stdint.h>

namespace riis {

// An operation is an arithmetic instruction or a comparison in one lane. A multiply-add is one. A pair is a node and a triangle
// whose distance the filter computed.
struct Counts {
  int64_t operations, pairs;
};
extern Counts counts_of_kernels;

namespace {

inline __attribute__((always_inline)) void count_operations(int64_t n) {
#if defined(RIIS_COUNT_OPERATIONS)
  counts_of_kernels.operations += n;
#else
  static_cast<void>(n);
#endif
}

inline __attribute__((always_inline)) void count_pairs(int64_t n) {
#if defined(RIIS_COUNT_OPERATIONS)
  counts_of_kernels.pairs += n;
#else
  static_cast<void>(n);
#endif
}

}  // namespace
}  // namespace riis
