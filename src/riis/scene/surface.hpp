// SPDX-License-Identifier: Apache-2.0
// A surface that answers queries. A surface has triangles, their scene and their band, and perhaps another method to measure
// distances. It finds closest triangles and sides.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/made_once.hpp"
#include "common/band.hpp"
#include "geometry/placement.hpp"
#include "motion/vertex_rates.hpp"
#include "paper_distances/patch_distance.hpp"
#include "scene/edges.hpp"
#include "scene/pseudonormals.hpp"
#include "scene/triangle_scene.hpp"
#include "triangulate/triangle_set.hpp"
#include "valve/valve.hpp"

namespace riis {

// The placement, the disc, the housing and the kind of the valve from which a surface was made.
struct SourceValve {
  Placement placement;
  Valve::Disc disc;      // before placement
  std::int32_t housing;  // the leaflet_id of the housing, or -1 if the valve has no housing
  const ValveKind *kind;
  bool is_warped;
};

class Surface {
 public:
  // Makes the surface. A later call, for example after the valve has moved, reuses the surface's memory. After a failure the
  // surface must not be used.
  void make(TriangleSet triangles, const Band &band, int n_threads);
  // Moves the triangles out of the surface, so that the next surface's triangles can reuse their memory.
  TriangleSet take_triangles() { return std::move(triangles_); }
  // Sets another method to measure distances. Without this call, distances are measured to the triangles.
  void measure_by(std::unique_ptr<const PatchDistance> other_distance, double triangle_error);

  // Stores the valve that the triangles come from. A surface from arrays has no valve.
  void is_of_valve(const SourceValve &source) { source_valve_.emplace(source); }
  const std::optional<SourceValve> &source() const { return source_valve_; }

  // Stores the patches that the triangles come from.
  void is_of_patches(PatchSet patches) { patches_.emplace(std::move(patches)); }
  // Returns the patches that the triangles come from, or null for a surface from arrays.
  const PatchSet *patches() const { return patches_ ? &*patches_ : nullptr; }

  // Adds a direction in which the patches change. The images in the direction's two states must have the same ids as those of
  // patches() (check_same_ids).
  void add_direction(const Direction &direction, int n_threads);
  std::int64_t n_directions() const { return n_directions_; }
  // Returns the rates of the vertices in a direction, (3, n_vertices).
  const std::vector<double> &rates(std::int64_t direction) const { return view(rates_)[direction]; }
  // Computes the derivative of area() in a direction.
  double area_rate(std::int64_t direction) const;

  const TriangleSet &triangles() const { return triangles_; }
  const TriangleScene &scene() const { return scene_; }
  const Band &band() const { return band_; }
  double half_thickness() const { return band_.half_thickness; }
  // The leaflet ids of the triangles, each once, ascending.
  const std::vector<std::int32_t> &leaflet_ids() const { return leaflet_ids_; }
  // Returns the area of all triangles, which the first call computes. Several threads may call this function at once.
  double area() const;

  // Tells whether the attachment is known. The attachment of arrays is known only if the caller has named it or has requested a
  // skirt.
  bool has_attachment() const { return triangles_.is_of_patches() || !triangles_.attached.empty(); }
  // Returns the sides at which leaflets are attached, or the attached edges of arrays. The first call makes them. Several threads
  // may call this function at once.
  const Attachment &attachment() const {
    return attachment_.get([this](Attachment &made) { made = attachment_of(triangles_); });
  }

  // Returns the leaflets, ascending by id. The first call measures them. Several threads may call this function at once.
  const std::vector<riis_leaflet> &leaflets() const {
    return leaflets_.get([this](std::vector<riis_leaflet> &made) { made = leaflets_of(triangles_); });
  }

  // Returns the other method for distances, or null if the triangles' scene measures distances.
  const PatchDistance *other_distance() const { return other_distance_.get(); }
  // Bounds how far the distance to the triangles may exceed the distance that the other method returns.
  double triangle_error() const { return triangle_error_; }

  // Returns the normals for sides and rims. The first call makes them. Several threads may call this function at once.
  const Pseudonormals &pseudonormals() const {
    return *pseudonormals_.get([this](auto &made) { made.emplace(triangles_); });
  }

 private:
  static constexpr double not_known = -1;

  TriangleSet triangles_;
  TriangleScene scene_;
  Band band_;
  std::vector<std::int32_t> leaflet_ids_;
  // The area is computed only when it is requested, because marking never needs it. If several threads compute it at the same
  // time, all get the same bits.
  mutable std::atomic<double> area_{not_known};
  std::optional<SourceValve> source_valve_;
  std::optional<PatchSet> patches_;
  std::vector<std::vector<double>> rates_;  // one for each direction; further entries only keep memory
  std::int64_t n_directions_ = 0;
  std::unique_ptr<const PatchDistance> other_distance_;
  double triangle_error_ = 0;
  // The pseudonormals are made when a side is first queried, because marking alone does not need them.
  mutable MadeOnce<std::optional<const Pseudonormals>> pseudonormals_;
  mutable MadeOnce<Attachment> attachment_;
  mutable MadeOnce<std::vector<riis_leaflet>> leaflets_;
};

}  // namespace riis
