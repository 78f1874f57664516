// SPDX-License-Identifier: Apache-2.0
#include "pipeline/make_surface.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "arrays/user_arrays.hpp"
#include "base/errors.hpp"
#include "base/log.hpp"
#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "paper_distances/patch_distance.hpp"
#include "pipeline/skirt_of_arrays.hpp"
#include "triangulate/triangulate.hpp"

namespace riis {
namespace {

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Bounds the difference between the triangles and the other approximation of the smooth surface. The bound is the sum of both
// errors, with a margin for rounding.
double largest_difference(double triangle_error, const PatchDistance &distance) {
  return (triangle_error + distance.patches().largest_error()) * (1 + 1e-6);
}

// With an offset, the normals of neighbouring triangles must agree. The normals that this check computes are also needed by every
// marking with an offset.
void check_normals_agree(const Surface &surface) {
  if (!surface.band().steps_aside()) return;
  const std::array<std::int64_t, 2> triangles = surface.pseudonormals().disagreeing();
  if (triangles[0] < 0) return;
  const auto id = [&](std::int64_t triangle) { return view(surface.triangles().triangle_id)[triangle]; };
  fail(RIIS_INVALID_SURFACE, "options.offset is ", surface.band().offset, ", but the triangles ", id(triangles[0]),
       " and ", id(triangles[1]),
       " run along their shared edge in the same direction, so their normals disagree: turn one of them over, or take "
       "the offset 0");
}

SurfaceSeconds logged(const Surface &surface, const SurfaceSeconds &seconds) {
  log_message(RIIS_LOG_INFO, "surface: ", surface.triangles().n_triangles(), " triangles in ",
              rounded(seconds.triangles, 3), " s, groups of triangles in ", rounded(seconds.scene, 3), " s");
  return seconds;
}

}  // namespace

SurfaceSeconds make_surface(const Valve &valve, const EarlierValve *moved, const SurfaceRequest &request,
                            const ValveAccuracy &accuracy, const FixedTriangulation *fixed, Surface &surface) {
  const Placement &placement = request.placement;
  Stopwatch stopwatch;
  if (fixed) fixed->check(valve);
  // Turns parameters into curves and patches.
  PatchSet patches = valve.make_patches();
  // Turns the earlier state into curves and patches. Corresponding points have the same u and v in both states.
  std::optional<PatchSet> patches_before;
  std::optional<EarlierState> earlier;
  if (moved) {
    patches_before = valve.make_patches_before(moved->before, moved->patches_before);
    earlier.emplace(EarlierState{*patches_before, moved->placement_before, moved->seconds});
  }
  // Turns curves into polylines, patches into quads, and quads into triangles.
  const Triangulation how{accuracy.triangle_error / placement.scale, placement, request.flip_normals, request.n_threads,
                          earlier ? &*earlier : nullptr};
  TriangleSet triangles = fixed ? triangulate_fixed(patches, how, fixed->plan(), surface.take_triangles())
                                : triangulate_adapted(patches, how, surface.take_triangles());
  if (triangles.n_triangles() == 0) fail(RIIS_INVALID_PARAMETER, "the valve has no area");
  triangles.skirt = valve.has_skirt() ? skirt_leaflet(patches) : -1;
  const double seconds_triangles = stopwatch.lap();
  // If distances are measured by another method than triangles, this method is made first, because its making may fail.
  std::unique_ptr<const PatchDistance> distance;
  if (accuracy.measure != RIIS_MEASURE_TRIANGLES)
    distance = make_distance(patches, {accuracy.measure, accuracy.distance_error}, placement, request.flip_normals);
  // Turns triangles into the scene that answers queries for closest points.
  surface.make(std::move(triangles), request.band, request.n_threads);
  check_normals_agree(surface);
  surface.is_of_valve({placement, valve.disc(), valve.kind().housing, &valve.kind(), valve.is_warped()});
  surface.is_of_patches(std::move(patches));
  if (distance) {
    const double difference = largest_difference(accuracy.triangle_error, *distance);
    surface.measure_by(std::move(distance), difference);
  }
  return logged(surface, {seconds_triangles, stopwatch.lap()});
}

SurfaceSeconds make_surface(const UserFaces &faces, const riis_surface_arrays &arrays, bool skip_zero_area,
                            const SurfaceRequest &request, Surface &surface) {
  Stopwatch stopwatch;
  TriangleSet triangles = triangles_from_arrays(faces, arrays, request.placement, skip_zero_area, request.flip_normals,
                                                surface.take_triangles());
  add_skirt_of_arrays(faces, request.placement.scale, request.flip_normals, triangles);
  const double seconds_triangles = stopwatch.lap();
  surface.make(std::move(triangles), request.band, request.n_threads);
  check_normals_agree(surface);
  return logged(surface, {seconds_triangles, stopwatch.lap()});
}

void add_direction(const ValveDirection &direction, int n_threads, Surface &surface) {
  const SourceValve &source = *surface.source();
  const auto patches_of = [&](const Valve &state, const char *name) {
    const StateNames names{name, "the surface's valve"};
    state.check_is_state_of(*source.kind, source.is_warped, names);
    PatchSet made = state.make_patches_unsearched(name);
    check_same_ids(*surface.patches(), made, names);
    return made;
  };
  const PatchSet after = patches_of(direction.after, "valve_after");
  std::optional<PatchSet> before;
  if (&direction.before != &direction.after) before = patches_of(direction.before, "valve_before");
  surface.add_direction(
      {after, before ? *before : after, direction.placement_after, direction.placement_before, direction.step},
      n_threads);
}

namespace {

// The grid lines are chosen for `n_openings` openings, evenly spaced from 0 to 1.
constexpr int n_openings = 33;
// The chosen lines are then tested at `n_between` further openings between every two neighbouring openings. If the lines are too
// coarse at some of the further openings, these openings are added, and the lines are chosen again. The test is made at most
// `n_trials` times.
constexpr int n_between = 7, n_trials = 4;
// During the choice, the patches of all openings are kept in memory, so their number is limited.
constexpr std::size_t max_patches = 10'000;
// A warp may change after the triangles were planned, and then their error also changes. The plan of a warped valve therefore
// uses only `warped_share` of the allowed error.
constexpr double warped_share = 0.6;

PatchSet patches_at(Valve &valve, double opening) {
  valve.set("opening", 1, &opening);
  try {
    return valve.make_patches();
  } catch (const Error &error) {
    fail(error.status, "at the opening ", opening, ", for a fixed triangulation: ", error.message.text());
  }
}

TriangulationPlan plan_for(Valve valve, double max_error, int n_threads) {
  Vector<PatchSet> states;
  if (!valve.can_open()) {
    states.push_back(valve.make_patches());
    return plan_triangulation(states, max_error, n_threads);
  }
  const std::size_t n_patches = patches_at(valve, 0).patches.size();
  if (n_patches > max_patches)
    fail(RIIS_LIMIT_EXCEEDED, "the valve has ", n_patches, " patches; a fixed triangulation takes at most ",
         max_patches);
  constexpr int n_spans = (n_between + 1) * (n_openings - 1);
  const auto opening = [](int i) { return static_cast<double>(i) / n_spans; };
  for (int i = 0; i <= n_spans; i += n_between + 1) states.push_back(patches_at(valve, opening(i)));
  TriangulationPlan plan = plan_triangulation(states, max_error, n_threads);
  for (int trial = 0; trial < n_trials; ++trial) {
    const std::size_t n_states = states.size();
    for (int i = 0; i <= n_spans; ++i) {
      PatchSet state = patches_at(valve, opening(i));
      if (!is_within(state, plan, max_error)) states.push_back(std::move(state));
    }
    if (states.size() == n_states) break;
    plan = plan_triangulation(states, max_error, n_threads);
  }
  return plan;
}

}  // namespace

FixedTriangulation::FixedTriangulation(const Valve &valve, double max_error, int n_threads)
    : valve_(valve), plan_(plan_for(valve, valve.is_warped() ? warped_share * max_error : max_error, n_threads)) {
  free_kept_memory();
}

}  // namespace riis
