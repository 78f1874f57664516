// SPDX-License-Identifier: Apache-2.0
#include "pipeline/updatable_surface.hpp"

#include <optional>
#include <utility>

#include "base/errors.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// A surface with more triangles gives its memory back, because keeping so much would cost more than allocating it again. A
// triangle takes about 300 bytes.
constexpr std::int64_t max_triangles_kept = 1'000'000;

}  // namespace

SurfaceRequest UpdatableSurface::with_threads(const SurfaceRequest &request) const {
  SurfaceRequest made = request;
  made.n_threads =
      threads_for(request.n_threads, surface_ ? surface_->triangles().n_triangles() : 0, triangles_per_thread);
  return made;
}

// Makes a new surface and replaces the old one only after it has succeeded.
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
  // In a time loop, the earlier state is often the state of the last update. Its patches are then known.
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
  crossing_watch_.look(valve, *surface_, with_threads(request).n_threads);
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
    replace_by_faces(faces, arrays, skip_zero_area, request);
    faces_memory_ = std::exchange(faces_, std::move(faces));
    return;
  }
  if (faces_.leaflet_id.empty())
    fail(RIIS_INVALID_ARGUMENT,
         "arrays.vertex_ids is NULL, but the surface was not made from arrays last: it has no faces to keep");
  if (arrays.leaflet_id) fail(RIIS_INVALID_ARGUMENT, "arrays.leaflet_id is given without faces: it must be NULL");
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

}  // namespace riis
