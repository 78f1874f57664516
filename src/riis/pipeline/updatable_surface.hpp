// SPDX-License-Identifier: Apache-2.0
// A surface that can be updated, with the data that the next update needs or reuses. The surface comes from a valve, the caller's
// arrays or keyframes. The object records how many seconds its last update took.
#pragma once

#include <riis/riis.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "arrays/user_arrays.hpp"
#include "pipeline/make_surface.hpp"
#include "scene/surface.hpp"
#include "valve/valve.hpp"

namespace riis {

// Logs a warning if leaflets go through each other, at most once for each shape of the valve.
class CrossingWatch {
 public:
  // The openings are divided into ranges. For each shape, the function examines the first surface in each range, until it has
  // logged a warning about this shape. Without a log function, it does nothing and allocates nothing. If there is too little
  // memory for the search, no warning and no failure follow, because the surface itself is good.
  void look(const Valve &valve, const Surface &surface, int n_threads) noexcept;

 private:
  struct Shape {
    std::uint64_t digest = 0;
    unsigned looked_at = 0;  // a bit for each range of the opening
    bool is_said = false;
  };
  Shape &remembered(std::uint64_t digest);

  // The number of shapes that are remembered. A caller that alternates between at most this many shapes gets one warning for each
  // shape.
  static constexpr std::size_t n_remembered = 8;

  std::array<Shape, n_remembered> shapes_{};
  std::size_t next_ = 0;
};

class UpdatableSurface {
 public:
  // Returns the surface of the last successful update. At least one update must have succeeded.
  const Surface &surface() const { return *surface_; }
  const SurfaceSeconds &seconds() const { return seconds_; }

  // The update functions fail as make_surface does, and a failure leaves the surface unchanged. If request.n_threads is 0, the
  // number of threads depends on the number of triangles of the last surface. The first update with accuracy.is_fixed chooses the
  // fixed triangulation. An update without accuracy.is_fixed ends it.
  void update_from_valve(const Valve &valve, const EarlierValve *earlier, const SurfaceRequest &request,
                         const ValveAccuracy &accuracy);
  // Updates the surface from arrays. If the arrays contain no faces, the surface keeps the faces of the last arrays, and only the
  // vertices are new.
  void update_from_arrays(const riis_surface_arrays &arrays, bool skip_zero_area, const SurfaceRequest &request);
  // Updates the surface to the keyframes' vertices at `time`. The velocities are means over the time dt that ends at `time`
  // (Keyframes::at).
  void update_from_keyframes(const Keyframes &frames, double time, double dt, bool skip_zero_area,
                             const SurfaceRequest &request);

  // Switches off the search for crossings in later updates. This is for shapes that the caller did not choose.
  void ignore_crossings() { ignores_crossings_ = true; }

  // Adds a direction to the surface of a valve, until the next update.
  void add_direction(const ValveDirection &direction, std::int32_t n_threads);

 private:
  SurfaceRequest with_threads(const SurfaceRequest &request) const;
  template <class Make>
  void replace(const Make &make);
  void replace_by_faces(const UserFaces &faces, const riis_surface_arrays &arrays, bool skip_zero_area,
                        const SurfaceRequest &request);

  std::unique_ptr<Surface> surface_, before_;        // before_ is kept to reuse its memory
  std::uint64_t revision_ = 0;                       // the revision of surface_'s valve; 0 without a valve
  std::unique_ptr<const FixedTriangulation> fixed_;  // null without RIIS_TRIANGULATION_FIXED
  SurfaceSeconds seconds_{};
  UserFaces faces_, faces_memory_;                  // faces of the last arrays; empty after a valve or keyframes
  std::vector<double> frame_xyz_, frame_velocity_;  // memory for updates from keyframes
  CrossingWatch crossing_watch_;
  bool ignores_crossings_ = false;
};

}  // namespace riis
