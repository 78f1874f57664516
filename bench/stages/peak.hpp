// SPDX-License-Identifier: Apache-2.0
// The most that one thread of this machine computes and copies. ./run bench roofline sets the stages of a step beside it.
#pragma once

#include <stdint.h>

#include "kernels/kernels.hpp"

namespace bench {

// Each function repeats its operations on registers and returns a number that depends on all of them. Operations are those of
// kernels/count.hpp.
struct PeakKernel {
  int64_t operations;  // in one repetition
  double (*repeat)(int64_t n);
};
struct PeakKernels {
  PeakKernel floats[3];  // multiply-adds; multiply-adds and additions; multiplications and additions
  PeakKernel doubles;    // multiplications and additions, because the decision fuses none
};

extern const PeakKernels peak_kernels_baseline, peak_kernels_avx2, peak_kernels_avx512;

// The largest numbers in a nanosecond. Bytes are those that a copy reads and writes, of arrays that no cache holds.
struct Peak {
  double floats, doubles, bytes;
};
Peak measure_peak(riis::InstructionSet set);

}  // namespace bench
