// SPDX-License-Identifier: Apache-2.0
#include "kernels/kernels.hpp"

#include "kernels/table.hpp"

namespace riis {
bool has(InstructionSet set) {
  switch (set) {
    case InstructionSet::baseline:
      return true;
#if defined(RIIS_X86_KERNELS)
    // __builtin_cpu_supports also checks that the operating system saves the wider registers.
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") && has(InstructionSet::avx2);
#endif
    default:
      return false;
  }
}

InstructionSet best_instruction_set() {
  static const InstructionSet best = has(InstructionSet::avx512) ? InstructionSet::avx512
                                     : has(InstructionSet::avx2) ? InstructionSet::avx2
                                                                 : InstructionSet::baseline;
  return best;
}

const Kernels &kernels([[maybe_unused]] InstructionSet set) {
#if defined(RIIS_X86_KERNELS)
  static const Kernels tables[n_instruction_sets] = {{filter_kernels_baseline, decision_kernels_baseline},
                                                     {filter_kernels_avx2, decision_kernels_avx2},
                                                     {filter_kernels_avx512, decision_kernels_avx512}};
  return tables[static_cast<int>(set)];
#else
  static const Kernels only{filter_kernels_baseline, decision_kernels_baseline};
  return only;
#endif
}

}  // namespace riis
