// SPDX-License-Identifier: Apache-2.0
// Measures work that does not use the library. compare.py divides the times of all other benchmarks by these times, so that runs
// on different machines or days can be compared.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

#include "shared/references.hpp"

namespace {

// Measures the speed of memory: reads the coordinates of a million nodes once.
void calibration_coordinates(benchmark::State &state) {
  constexpr std::size_t n_nodes = 1000000;
  std::vector<double> xyz(3 * n_nodes);
  for (std::size_t i = 0; i < xyz.size(); ++i) xyz[i] = 1 + static_cast<double>(i % 1024);
  for (auto _ : state) benchmark::DoNotOptimize(bench::pass_over_coordinates(n_nodes, xyz.data(), 1));
}
BENCHMARK(calibration_coordinates)->Unit(benchmark::kMillisecond);

// Measures the speed of a core. Each product or sum in double precision needs the result of the operation before it.
void calibration_products(benchmark::State &state) {
  constexpr int n_products = 1000000;
  double factor = 0.9999999, summand = 1e-7;
  benchmark::DoNotOptimize(factor);
  benchmark::DoNotOptimize(summand);
  for (auto _ : state) {
    double value = 1;
    for (int i = 0; i < n_products; ++i) value = value * factor + summand;
    benchmark::DoNotOptimize(value);
  }
}
BENCHMARK(calibration_products)->Unit(benchmark::kMillisecond);

}  // namespace
