// SPDX-License-Identifier: Apache-2.0
// Counts the operations of kernels that are compiled with RIIS_COUNT_OPERATIONS. Only ./run bench roofline links such kernels.
// In all other kernels, counting compiles to nothing.
#pragma once

#include <stdint.h>

namespace riis {

// `operations` counts arithmetic instructions and comparisons in one lane, with a multiply-add as one. `pairs` counts the pairs
// of a node and a triangle whose distance the filter computed.
struct Counts {
  int64_t operations, pairs;
};
extern Counts counts_of_kernels;

namespace {

inline __attribute__((always_inline)) void count(int64_t Counts::*which, int64_t n) {
#if defined(RIIS_COUNT_OPERATIONS)
  counts_of_kernels.*which += n;
#else
  static_cast<void>(which), static_cast<void>(n);
#endif
}

}  // namespace
}  // namespace riis
