// SPDX-License-Identifier: Apache-2.0
// Measures the time and the error of a query by each of the paper's three methods to compute a distance (section 4.1,
// "Performance evaluation"). The points are on the surface, as in the paper, or in a box around it. Tolerances are fractions of
// the half thickness, which is 0.1.
#include <benchmark/benchmark.h>
#include <riis/riis.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "api/handles.hpp"
#include "paper_distances/patch_distance.hpp"
#include "shared/handles.hpp"

namespace {

using namespace bench;

constexpr double half_thickness = 0.1;
constexpr std::size_t n_points = 4096;

Surface surface_of(const char *kind, std::int32_t measure, double tolerance) {
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = half_thickness;
  options.measure = measure;
  (measure == RIIS_MEASURE_TRIANGLES ? options.tolerance : options.measure_tolerance) = tolerance;
  return make_surface(make_valve(kind).get(), &options);
}

// The points are the same in every run. Reference distances are measured to fine triangles. The fine triangles lie within 1e-3
// half thicknesses of the smooth surface.
struct Points {
  std::vector<double> xyz, distances;

  Points(const char *kind, bool on_surface) {
    const Surface fine = surface_of(kind, RIIS_MEASURE_TRIANGLES, 1e-3);
    riis_surface_info info;
    check(riis_surface_get_info(fine.get(), &info, sizeof info));
    const riis_triangles triangles = triangles_of(fine.get());
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    for (std::size_t i = 0; i < n_points; ++i) {
      const auto vertex = static_cast<std::size_t>(share(random) * static_cast<double>(triangles.n_vertices));
      for (std::size_t c = 0; c < 3; ++c)
        xyz.push_back(on_surface ? triangles.xyz[3 * vertex + c]
                                 : info.lower[c] - 0.3 + share(random) * (info.upper[c] - info.lower[c] + 0.6));
      riis_closest closest;
      check(riis_closest_point(fine.get(), xyz.data() + 3 * i, &closest, sizeof closest));
      distances.push_back(closest.distance);
    }
  }
};

// The arguments are RIIS_MEASURE_*, the tolerance in tenths of a per cent, and 1 if the points are on the surface.
void distance_query(benchmark::State &state, const char *kind) {
  const auto method = static_cast<std::int32_t>(state.range(0));
  const Surface surface = surface_of(kind, method, 1e-3 * static_cast<double>(state.range(1)));
  const Points points(kind, state.range(2) != 0);
  double largest = 0, n_off = 0;
  for (std::size_t i = 0; i < n_points; ++i) {
    riis_closest closest;
    check(riis_closest_point(surface.get(), points.xyz.data() + 3 * i, &closest, sizeof closest));
    const double error = (closest.distance - points.distances[i]) / half_thickness;
    largest = std::max(largest, error);
    n_off += error > 0.02;
  }
  std::size_t i = 0;
  for (auto _ : state) {
    riis_closest closest;
    check(riis_closest_point(surface.get(), points.xyz.data() + 3 * (i++ % n_points), &closest, sizeof closest));
    benchmark::DoNotOptimize(closest);
  }
  state.counters["largest_error"] = largest;
  state.counters["off_by_2%"] = n_off / static_cast<double>(n_points);
  state.counters["triangles"] = method == RIIS_MEASURE_TRIANGLES ? n_triangles_of(surface.get()) : 0;
  const auto *samples = dynamic_cast<const riis::SampleSet *>(riis::content_of(surface.get()).other_distance());
  state.counters["samples"] = samples ? static_cast<double>(samples->n_samples()) : 0;
}

void all_methods(benchmark::internal::Benchmark *run) {
  for (const int on_surface : {1, 0}) {
    for (const int method : {RIIS_MEASURE_TRIANGLES, RIIS_MEASURE_SAMPLING})
      for (const int tolerance : {50, 20, 10}) run->Args({method, tolerance, on_surface});
    for (const int tolerance : {10, 1}) run->Args({RIIS_MEASURE_MINIMIZATION, tolerance, on_surface});
  }
  run->ArgNames({"method", "tolerance", "on_surface"})->Unit(benchmark::kMicrosecond);
}
BENCHMARK_CAPTURE(distance_query, aortic, "aortic")->Apply(all_methods);
BENCHMARK_CAPTURE(distance_query, mitral, "mitral")->Apply(all_methods);

}  // namespace
