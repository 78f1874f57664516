// SPDX-License-Identifier: Apache-2.0
// The peak rates at which one thread of this machine computes and copies. ./run bench roofline compares the stages of a step with
// these rates.
#pragma once

#include <stdint.h>

#include "kernels/kernels.hpp"

namespace bench {

// Each function repeats its operations on registers, and returns a number that depends on all of these operations. Operations are
// counted as in kernels/lanes.hpp.
struct PeakKernel {
  int64_t operations;  // in one repetition
  double (*repeat)(int64_t n);
};
struct PeakKernels {
  // These functions use single precision. The first function does multiply-adds, the second multiply-adds and additions, and the
  // third multiplications and additions.
  PeakKernel floats[3];
  PeakKernel doubles;  // for double precision: multiplications and additions, because the decision kernel fuses no
                       // operations
};

extern const PeakKernels peak_kernels_baseline, peak_kernels_avx2, peak_kernels_avx512;

// The highest rates per nanosecond: operations in single and in double precision, and bytes that a copy reads and writes. The
// copied arrays are larger than any cache.
struct Peak {
  double floats, doubles, bytes;
};
Peak measure_peak(riis::InstructionSet set);

}  // namespace bench
