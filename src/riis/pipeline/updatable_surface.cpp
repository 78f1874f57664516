// SPDX-License-Identifier: Apache-2.0
#include "pipeline/updatable_surface.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/errors.hpp"
#include "base/log.hpp"
#include "common/array_view.hpp"
#include "measures/measures.hpp"
#include "parallel/parallel_for.hpp"
#include "pipeline/skirt_of_arrays.hpp"

namespace riis {
namespace {

// If the new surface has more than `max_triangles_kept` triangles, the memory of the old surface is freed. Keeping so much memory
// would cost more than allocating it again. A triangle takes about 300 bytes.
constexpr std::int64_t max_triangles_kept = 1'000'000;

}  // namespace

SurfaceRequest UpdatableSurface::with_threads(const SurfaceRequest &request) const {
  SurfaceRequest made = request;
  made.n_threads =
      threads_for(request.n_threads, surface_ ? surface_->triangles().n_triangles() : 0, triangles_per_thread);
  return made;
}

// Makes a new surface, and replaces the old surface only after this has succeeded.
template <class Make>
void UpdatableSurface::replace(const Make &make) {
  std::unique_ptr<Surface> made = std::move(before_);
  if (!made) made = std::make_unique<Surface>();
  seconds_ = make(*made);
  before_ = std::exchange(surface_, std::move(made));
  if (!before_) return;
  before_->measure_by(nullptr, 0);
  if (before_->triangles().n_triangles() > max_triangles_kept) before_.reset();
}

void UpdatableSurface::update_from_valve(const Valve &valve, const EarlierValve *earlier, const SurfaceRequest &request,
                                         const ValveAccuracy &accuracy) {
  const SurfaceRequest whole = with_threads(request);
  std::unique_ptr<const FixedTriangulation> newly_fixed;
  if (accuracy.is_fixed && !fixed_)
    newly_fixed =
        std::make_unique<FixedTriangulation>(valve, accuracy.triangle_error / request.placement.scale, whole.n_threads);
  const FixedTriangulation *fixed = newly_fixed ? newly_fixed.get() : fixed_.get();
  // In a time loop, the earlier state is often the state of the last update. The patches of that state are then known.
  std::optional<EarlierValve> moved;
  if (earlier) moved.emplace(*earlier);
  if (moved && moved->before.revision() == revision_) moved->patches_before = surface_->patches();
  replace([&](Surface &made) {
    return make_surface(valve, moved ? &*moved : nullptr, whole, accuracy, accuracy.is_fixed ? fixed : nullptr, made);
  });
  revision_ = valve.revision();
  faces_.leaflet_id.clear();
  if (!accuracy.is_fixed) fixed_.reset();
  if (newly_fixed) fixed_ = std::move(newly_fixed);
  if (!ignores_crossings_) crossing_watch_.look(valve, *surface_, with_threads(request).n_threads);
}

void UpdatableSurface::replace_by_faces(const UserFaces &faces, const riis_surface_arrays &arrays, bool skip_zero_area,
                                        const SurfaceRequest &request) {
  const SurfaceRequest whole = with_threads(request);
  replace([&](Surface &made) { return make_surface(faces, arrays, skip_zero_area, whole, made); });
  revision_ = 0;
  fixed_.reset();
}

void UpdatableSurface::update_from_arrays(const riis_surface_arrays &arrays, bool skip_zero_area,
                                          const SurfaceRequest &request) {
  if (arrays.vertex_ids || arrays.n_faces != 0 || !surface_) {
    UserFaces faces = faces_from_arrays(arrays, std::move(faces_memory_));
    find_attachment(faces, arrays);
    replace_by_faces(faces, arrays, skip_zero_area, request);
    faces_memory_ = std::exchange(faces_, std::move(faces));
    return;
  }
  if (faces_.leaflet_id.empty())
    fail(RIIS_INVALID_ARGUMENT,
         "arrays.vertex_ids is NULL, but the surface has no faces to keep, because its triangles are those of a valve");
  if (arrays.leaflet_id) fail(RIIS_INVALID_ARGUMENT, "arrays.leaflet_id is given without faces: it must be NULL");
  if (arrays.skirt_length != 0 || arrays.attached || arrays.skirt_lengths)
    fail(RIIS_INVALID_ARGUMENT,
         "without faces the skirt does not change: arrays.skirt_length must be 0, and arrays.attached and "
         "arrays.skirt_lengths must be NULL");
  replace_by_faces(faces_, arrays, skip_zero_area, request);
}

void UpdatableSurface::update_from_keyframes(const Keyframes &frames, double time, double dt, bool skip_zero_area,
                                             const SurfaceRequest &request) {
  frames.at(time, dt, frame_xyz_, frame_velocity_);
  riis_surface_arrays arrays{};
  const double *xyz = frame_xyz_.data(), *velocity = frame_velocity_.data();
  arrays.n_vertices = frames.faces().n_vertices;
  arrays.x = xyz, arrays.y = xyz + 1, arrays.z = xyz + 2;
  arrays.vx = velocity, arrays.vy = velocity + 1, arrays.vz = velocity + 2;
  arrays.stride = arrays.velocity_stride = 3;
  arrays.real_bits = 64;
  replace_by_faces(frames.faces(), arrays, skip_zero_area, request);
  faces_.leaflet_id.clear();
}

void UpdatableSurface::add_direction(const ValveDirection &direction, std::int32_t n_threads) {
  riis::add_direction(direction, threads_for(n_threads, surface_->triangles().n_triangles(), triangles_per_thread),
                      *surface_);
}

namespace {

// Pairs of triangles whose depth is below `least_depth` half thicknesses are left out, as by default in riis_find_crossings.
constexpr double least_depth = 1e-6;

// Logs a warning if leaflets cross deeper than touching leaflets can. Returns whether it has logged a warning.
bool say(const Valve &valve, const Surface &surface, int n_threads) {
  const TriangleSet &set = surface.triangles();
  const Crossings pairs =
      find_crossings(set, surface.scene().groups(), least_depth * surface.half_thickness(), n_threads);
  const auto leaflet = [&](std::int64_t pair, int k) {
    return view(set.leaflet_id)[view(pairs.triangle)[2 * pair + k]];
  };
  // Hinges reach into recesses of the housing, but the model of the housing has no recesses. Crossings with the housing are
  // therefore left out.
  const std::int32_t housing = valve.kind().housing;
  std::int64_t n = 0, deepest = -1;
  for (std::int64_t i = 0; i < view(pairs.depth).size(); ++i) {
    if (housing >= 0 && (leaflet(i, 0) == housing || leaflet(i, 1) == housing)) continue;
    ++n;
    if (deepest < 0 || view(pairs.depth)[i] > view(pairs.depth)[deepest]) deepest = i;
  }
  if (n == 0 || view(pairs.depth)[deepest] <= depth_of_contacts(surface)) return false;
  constexpr int digits = 3;
  const auto at = [&](int k) { return rounded(view(pairs.point)[3 * deepest + k], digits + 1); };
  const std::int32_t one = leaflet(deepest, 0), other = leaflet(deepest, 1);
  const Message who = one == other ? Message("leaflet ", one, " goes through itself")
                                   : Message("leaflets ", one, " and ", other, " go through each other");
  log_message(RIIS_LOG_WARNING, who.text(), " at opening ", valve.opening(), ": ", n, n == 1 ? " pair" : " pairs",
              " of triangles, up to ", rounded(view(pairs.depth)[deepest], digits), " deep, at (", at(0), ", ", at(1),
              ", ", at(2), "); riis_find_crossings lists them, and riis check crossings looks at all openings");
  return true;
}

}  // namespace

CrossingWatch::Shape &CrossingWatch::remembered(std::uint64_t digest) {
  const auto known =
      std::find_if(shapes_.begin(), shapes_.end(), [&](const Shape &shape) { return shape.digest == digest; });
  if (known != shapes_.end()) return *known;
  Shape &shape = shapes_[next_];
  next_ = (next_ + 1) % n_remembered;
  shape = {digest, 0, false};
  return shape;
}

void CrossingWatch::look(const Valve &valve, const Surface &surface, int n_threads) noexcept {
  if (!is_logging() || valve.has_default_shape()) return;
  Shape &shape = remembered(valve.shape_digest());
  unsigned range = 1;
  for (const double least : {0.0, 0.05, 1.0 / 3, 2.0 / 3})
    if (valve.opening() > least) range *= 2;
  if (shape.is_said || (shape.looked_at & range) != 0) return;
  shape.looked_at |= range;
  try {
    shape.is_said = say(valve, surface, n_threads);
  } catch (...) {
    // The search ran out of memory. This is not reported as a failure, because the caller did not request the search, and the
    // surface itself is good.
  }
}

}  // namespace riis
