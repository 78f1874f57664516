// SPDX-License-Identifier: Apache-2.0
// Each benchmark times one stage. The valve is the aortic valve at the default tolerance, with 100,000 nodes around it. Times
// depend on the machine. Ratios hardly depend on the machine, because both times of a ratio come from one run.
#include <benchmark/benchmark.h>
#include <riis/riis.h>

#include <chrono>
#include <cmath>
#include <random>
#include <vector>

#include "../../tests/support/brute_force.hpp"
#include "api/handles.hpp"
#include "counters.hpp"
#include "shared/handles.hpp"

namespace {

using namespace bench;

riis_surface_options with_tolerance(double tolerance) {
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.tolerance = tolerance;
  return options;
}

Surface aortic_surface(double tolerance) {
  const riis_surface_options options = with_tolerance(tolerance);
  return make_surface(make_valve("aortic").get(), &options);
}

// Returns nodes in the box around the demo's cylinder. The nodes are the same in every run.
const std::vector<double> &nodes() {
  static const std::vector<double> xyz = [] {
    constexpr std::size_t n_nodes = 100000;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> across(-1.6, 1.6), along(-1.4, 0.6);
    std::vector<double> made;
    for (std::size_t i = 0; i < n_nodes; ++i) {
      made.push_back(across(random));
      made.push_back(across(random));
      made.push_back(along(random));
    }
    return made;
  }();
  return xyz;
}

std::int64_t n_nodes() { return static_cast<std::int64_t>(nodes().size() / 3); }

Mesh box_mesh() {
  riis_mesh *mesh = nullptr;
  const double *xyz = nodes().data();
  check(riis_mesh_create(n_nodes(), xyz, xyz + 1, xyz + 2, 3, &mesh));
  return Mesh(mesh);
}

// Measures the time of all stages from parameters to triangles and the scene, as in every time step of a moving valve. The
// argument is the tolerance in tenths of a per cent.
void surface_update(benchmark::State &state) {
  const Valve valve = make_valve("aortic");
  const riis_surface_options options = with_tolerance(static_cast<double>(state.range(0)) * 1e-3);
  const Surface surface = aortic_surface(0.05);
  double seconds_triangles = 0, seconds_scene = 0;
  for (auto _ : state) {
    check(riis_surface_update(surface.get(), valve.get(), &options));
    riis_surface_info info;
    check(riis_surface_get_info(surface.get(), &info, sizeof info));
    seconds_triangles += info.seconds_triangles;
    seconds_scene += info.seconds_scene;
  }
  state.counters["triangles"] = n_triangles_of(surface.get());
  state.counters["triangles_share"] = seconds_triangles / (seconds_triangles + seconds_scene);
}
BENCHMARK(surface_update)->Arg(100)->Arg(50)->Arg(20)->Arg(5)->Unit(benchmark::kMillisecond);

void closest_point(benchmark::State &state) {
  const Surface surface = aortic_surface(static_cast<double>(state.range(0)) * 1e-3);
  std::size_t i = 0;
  riis_closest closest;
  // The first query of a surface also prepares the data for sides. This query is therefore not timed.
  check(riis_closest_point(surface.get(), nodes().data(), &closest, sizeof closest));
  for (auto _ : state) {
    check(riis_closest_point(surface.get(), nodes().data() + 3 * (i++ % 100000), &closest, sizeof closest));
    benchmark::DoNotOptimize(closest);
  }
  state.counters["triangles"] = n_triangles_of(surface.get());
}
BENCHMARK(closest_point)->Arg(50)->Arg(5)->Unit(benchmark::kMicrosecond);

// Argument: threads.
void mark_exhaustive(benchmark::State &state) {
  const Surface surface = aortic_surface(0.05);
  const Mesh mesh = box_mesh();
  const Result result = make_result();
  riis_mark_options options;
  check(riis_mark_options_init(&options, sizeof options));
  options.search = RIIS_SEARCH_EXHAUSTIVE;
  options.n_threads = static_cast<std::int32_t>(state.range(0));
  for (auto _ : state) check(riis_mark_nodes(surface.get(), mesh.get(), &options, result.get()));
  count_marking(state, stats_of(result.get()));
}
BENCHMARK(mark_exhaustive)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

// Compares the marking of nodes on one thread with a loop that measures all triangles by the library's kernel. The ratio says how
// many times as fast the marking is. The loop measures every 100th node.
void brute_force_over_marking(benchmark::State &state) {
  const Surface surface = aortic_surface(0.05);
  const riis::TriangleSet &triangles = riis::content_of(surface.get()).triangles();
  const double *xyz = nodes().data();
  const std::int64_t n_sample = n_nodes() / 100;
  riis_mesh *sampled = nullptr;
  check(riis_mesh_create(n_sample, xyz, xyz + 1, xyz + 2, 300, &sampled));
  const Mesh mesh(sampled);
  const Result result = make_result();
  riis_mark_options options;
  check(riis_mark_options_init(&options, sizeof options));
  options.n_threads = 1;
  double seconds_loop = 0, seconds_marking = 0;
  std::int64_t n_marked_by_loop = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    n_marked_by_loop = 0;
    for (std::int64_t i = 0; i < n_sample; ++i) {
      const double *p = xyz + 300 * i;
      n_marked_by_loop += std::sqrt(riis::closest_by_brute_force(triangles, {p[0], p[1], p[2]}).distance_sq) <= 0.1;
    }
    const auto middle = std::chrono::steady_clock::now();
    check(riis_mark_nodes(surface.get(), mesh.get(), &options, result.get()));
    const auto end = std::chrono::steady_clock::now();
    seconds_loop += std::chrono::duration<double>(middle - start).count();
    seconds_marking += std::chrono::duration<double>(end - middle).count();
  }
  if (marked_in(result.get()).n_nodes != n_marked_by_loop) state.SkipWithError("the loop and the marking differ");
  const double pairs =
      static_cast<double>(n_sample) * n_triangles_of(surface.get()) * static_cast<double>(state.iterations());
  state.counters["ratio"] = seconds_loop / seconds_marking;
  state.counters["loop_ns/pair"] = 1e9 * seconds_loop / pairs;
}
BENCHMARK(brute_force_over_marking)->Unit(benchmark::kMillisecond);

}  // namespace
