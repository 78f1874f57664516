// SPDX-License-Identifier: Apache-2.0
// Each file with kernels defines one table. The table's name ends with the instruction set.
#pragma once

#include "kernels/kernels.hpp"

// RIIS_INSTRUCTION_SET names the instruction set that the file is compiled for: baseline, avx2 or avx512. The baseline is SSE2 on
// x86-64 and NEON on 64-bit ARM. Two more names exist. Only tests link the table `portable`, whose code is for processors without
// any of these sets. Only ./run bench roofline links the table `counted`, whose code counts operations.
#define RIIS_JOIN(a, b) a##_##b
#define RIIS_JOINED(a, b) RIIS_JOIN(a, b)
#define RIIS_KERNELS(name) RIIS_JOINED(name, RIIS_INSTRUCTION_SET)

#define RIIS_LAMBDA __attribute__((always_inline))

namespace riis {

extern const FilterKernels filter_kernels_baseline, filter_kernels_avx2, filter_kernels_avx512, filter_kernels_portable,
    filter_kernels_counted;
extern const DecisionKernels decision_kernels_baseline, decision_kernels_avx2, decision_kernels_avx512,
    decision_kernels_portable, decision_kernels_counted;

}  // namespace riis
