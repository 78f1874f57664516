// SPDX-License-Identifier: Apache-2.0
#include "peak.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace bench {
namespace {

using riis::InstructionSet;

const PeakKernels &peak_kernels(InstructionSet set) {
#if defined(RIIS_X86_KERNELS)
  if (set == InstructionSet::avx512) return peak_kernels_avx512;
  if (set == InstructionSet::avx2) return peak_kernels_avx2;
#else
  static_cast<void>(set);
#endif
  return peak_kernels_baseline;
}

// Other work on the machine makes times longer, so the shortest of many runs counts.
template <class Work>
double shortest_nanoseconds(int n_turns, const Work &work) {
  double least = 1e300;
  for (int turn = 0; turn < n_turns; ++turn) {
    const auto start = std::chrono::steady_clock::now();
    work();
    least = std::min(least, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

double operations_a_nanosecond(const PeakKernel &kernel) {
  constexpr std::int64_t n = 100000;
  double sum = 0;
  const double nanoseconds = shortest_nanoseconds(500, [&] { sum += kernel.repeat(n); });
  if (!std::isfinite(sum)) {
    std::fprintf(stderr, "the peak's operations gave no number\n");
    std::exit(1);
  }
  return static_cast<double>(kernel.operations * n) / nanoseconds;
}

// Copies in blocks, because other work interrupts long copies. All blocks together are larger than the caches, so a block has
// left every cache before its turn comes again.
double bytes_a_nanosecond() {
  constexpr std::size_t of_block = std::size_t{2} << 20, n_blocks = 128;
  const std::vector<char> from(n_blocks * of_block, 1);
  std::vector<char> to(n_blocks * of_block);
  std::size_t block = 0;
  const double nanoseconds = shortest_nanoseconds(4 * n_blocks, [&] {
    std::memcpy(to.data() + block * of_block, from.data() + block * of_block, of_block);
    block = (block + 1) % n_blocks;
  });
  if (to.back() != from.back()) std::exit(1);
  return 2.0 * static_cast<double>(of_block) / nanoseconds;
}

}  // namespace

Peak measure_peak(InstructionSet set) {
  const PeakKernels &kernels = peak_kernels(set);
  double floats = 0;
  for (const PeakKernel &kernel : kernels.floats) floats = std::max(floats, operations_a_nanosecond(kernel));
  return {floats, operations_a_nanosecond(kernels.doubles), bytes_a_nanosecond()};
}

}  // namespace bench
