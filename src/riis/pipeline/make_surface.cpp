// SPDX-License-Identifier: Apache-2.0
#include "pipeline/make_surface.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "base/errors.hpp"
#include "base/log.hpp"
#include "distance/patch_distance.hpp"
#include "surface/triangulate.hpp"
#include "surface/user_arrays.hpp"

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

// Bounds the difference between two approximations of the smooth surface. It adds both errors and a margin for rounding.
double largest_difference(double triangle_error, const PatchDistance &distance) {
  return (triangle_error + distance.patches().largest_error()) * (1 + 1e-6);
}

SurfaceSeconds logged(const Surface &surface, const SurfaceSeconds &seconds) {
  log_message(RIIS_LOG_INFO, "surface: ", surface.triangles().n_triangles(), " triangles in ",
              rounded(seconds.triangles, 3), " s, groups of triangles in ", rounded(seconds.scene, 3), " s");
  return seconds;
}

}  // namespace

SurfaceSeconds make_surface(const Valve &valve, const ValveMotion *moved, const SurfaceRequest &request,
                            const ValveAccuracy &accuracy, const FixedTriangulation *fixed, Surface &surface) {
  const Placement &placement = request.placement;
  Stopwatch stopwatch;
  if (fixed) fixed->check(valve);
  // Turns parameters into curves and patches.
  PatchSet patches = valve.make_patches();
  // Turns the earlier state into curves and patches. Corresponding points of both states have the same u and v.
  std::optional<PatchSet> patches_before;
  std::optional<Motion> motion;
  if (moved) {
    patches_before = valve.make_patches_before(moved->before, moved->patches_before);
    motion.emplace(Motion{*patches_before, moved->placement_before, moved->seconds});
  }
  // Turns curves into polylines, patches into quads, and quads into triangles.
  const Triangulation how{accuracy.triangle_error / placement.scale, placement, request.flip_normals, request.n_threads,
                          motion ? &*motion : nullptr};
  TriangleSet triangles = fixed ? triangulate_fixed(patches, how, fixed->plan(), surface.take_triangles())
                                : triangulate_adapted(patches, how, surface.take_triangles());
  if (triangles.n_triangles() == 0) fail(RIIS_INVALID_PARAMETER, "the valve has no area");
  const double seconds_triangles = stopwatch.lap();
  // If distances are not to the triangles, makes the other method first, because the library may refuse it.
  std::unique_ptr<const PatchDistance> distance;
  if (accuracy.measure != RIIS_MEASURE_TRIANGLES)
    distance = make_distance(patches, {accuracy.measure, accuracy.distance_error}, placement, request.flip_normals);
  // Turns triangles into the scene that answers queries for closest points.
  surface.make(std::move(triangles), request.half_thickness, request.n_threads);
  surface.is_of_valve(
      {placement, valve.disc(), valve.kind().housing, valve.skirt_leaflet(), &valve.kind(), valve.is_warped()});
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
  const double seconds_triangles = stopwatch.lap();
  surface.make(std::move(triangles), request.half_thickness, request.n_threads);
  return logged(surface, {seconds_triangles, stopwatch.lap()});
}

void add_direction(const ValveDirection &direction, int n_threads, Surface &surface) {
  const ValveFrame &frame = *surface.frame();
  const auto patches_of = [&](const Valve &state, const char *name) {
    const StateNames names{name, "the surface's valve"};
    state.check_is_state_of(*frame.kind, frame.is_warped, names);
    PatchSet made = state.make_patches_unsearched(name);
    check_same_build(*surface.patches(), made, names);
    return made;
  };
  const PatchSet after = patches_of(direction.after, "valve_after");
  std::optional<PatchSet> before;
  if (&direction.before != &direction.after) before = patches_of(direction.before, "valve_before");
  surface.add_direction(
      {after, before ? *before : after, direction.placement_after, direction.placement_before, direction.step},
      n_threads);
}

}  // namespace riis
