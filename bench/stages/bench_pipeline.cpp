// SPDX-License-Identifier: Apache-2.0
// Measures the times of the stages from parameters to a scene (paper, 3 and 4.1), on one thread. The valves are the aortic valve
// and the half-open mitral valve, at the default tolerance. Every stage starts from the results of the stage before.
// riis_surface_create runs all stages. Inside riis_surface_create, a stage is faster if it reuses the memory of the last surface.
#include <benchmark/benchmark.h>

#include "api/handles.hpp"
#include "geometry/curve.hpp"
#include "scene/triangle_scene.hpp"
#include "shared/handles.hpp"
#include "triangulate/grids.hpp"
#include "triangulate/triangulate.hpp"

namespace {

using namespace bench;

constexpr double max_error = 0.05 * 0.1;  // tolerance, half thickness

Valve moved_valve(const char *kind) {
  Valve valve = make_valve(kind);
  if (kind[0] == 'm') check(riis_valve_set_scalar(valve.get(), "opening", 0.5));
  return valve;
}

Surface surface_of(const riis_valve *valve) {
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.n_threads = 1;
  return make_surface(valve, &options);
}

// Measures the time from parameters to curves and patches.
void pipeline_patches(benchmark::State &state, const char *kind) {
  const Valve valve = moved_valve(kind);
  for (auto _ : state) benchmark::DoNotOptimize(valve->valve.make_patches());
  state.counters["curves"] = static_cast<double>(valve->valve.make_patches().curves.size());
}

// Flattens every curve once, with the whole tolerance. Surfaces need finer polylines.
void pipeline_curves(benchmark::State &state, const char *kind) {
  const riis::PatchSet patches = moved_valve(kind)->valve.make_patches();
  std::size_t n_points = 0;
  for (auto _ : state) {
    n_points = 0;
    for (const riis::Curve &curve : patches.curves) n_points += riis::make_polyline(curve, max_error).points.size();
    benchmark::DoNotOptimize(n_points);
  }
  state.counters["points"] = static_cast<double>(n_points);
}

// Flattens curves as finely as the surface needs, and makes the patches' quads.
void pipeline_quads(benchmark::State &state, const char *kind) {
  const riis::PatchSet patches = moved_valve(kind)->valve.make_patches();
  for (auto _ : state) benchmark::DoNotOptimize(riis::make_grids(patches, max_error));
}

// Flattens the curves and makes the placed triangles directly. No quads are stored.
void pipeline_triangles(benchmark::State &state, const char *kind) {
  const Valve valve = moved_valve(kind);
  const riis::PatchSet patches = valve->valve.make_patches();
  const riis::Placement placement{1, riis::rotation_about({0, 0, 1}, 0), {0, 0, 0}};
  for (auto _ : state) benchmark::DoNotOptimize(riis::triangulate_adapted(patches, {max_error, placement, false, 1}));
  state.counters["triangles"] = n_triangles_of(surface_of(valve.get()).get());
}

// Makes a new scene.
void pipeline_scene(benchmark::State &state, const char *kind) {
  const Surface surface = surface_of(moved_valve(kind).get());
  for (auto _ : state) {
    riis::TriangleScene scene;
    scene.make(riis::content_of(surface.get()).triangles(), 1);
    scene.build_tree();
  }
  state.counters["triangles"] = n_triangles_of(surface.get());
}

// Measures the time to make the scene again after the triangles have moved.
void pipeline_scene_again(benchmark::State &state, const char *kind) {
  const Surface surface = surface_of(moved_valve(kind).get());
  riis::TriangleScene scene;
  scene.make(riis::content_of(surface.get()).triangles(), 1);
  scene.build_tree();
  for (auto _ : state) {
    scene.make(riis::content_of(surface.get()).triangles(), 1);
    scene.build_tree();
  }
  state.counters["triangles"] = n_triangles_of(surface.get());
}

// Runs all stages, as a caller does.
void pipeline_surface(benchmark::State &state, const char *kind) {
  const Valve valve = moved_valve(kind);
  for (auto _ : state) surface_of(valve.get());
  state.counters["triangles"] = n_triangles_of(surface_of(valve.get()).get());
}
void pipeline_surface_again(benchmark::State &state, const char *kind) {
  const Valve valve = moved_valve(kind);
  const Surface surface = surface_of(valve.get());
  for (auto _ : state) check(riis_surface_update(surface.get(), valve.get(), nullptr));
  state.counters["triangles"] = n_triangles_of(surface.get());
}

#define BOTH_VALVES(stage)                                                                  \
  BENCHMARK_CAPTURE(stage, aortic, "aortic")->Unit(benchmark::kMicrosecond)->UseRealTime(); \
  BENCHMARK_CAPTURE(stage, mitral, "mitral")->Unit(benchmark::kMicrosecond)->UseRealTime()
BOTH_VALVES(pipeline_patches);
BOTH_VALVES(pipeline_curves);
BOTH_VALVES(pipeline_quads);
BOTH_VALVES(pipeline_triangles);
BOTH_VALVES(pipeline_scene);
BOTH_VALVES(pipeline_scene_again);
BOTH_VALVES(pipeline_surface);
BOTH_VALVES(pipeline_surface_again);

}  // namespace
