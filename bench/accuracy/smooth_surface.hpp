// SPDX-License-Identifier: Apache-2.0
// The smooth surface that tolerances refer to (docs/theory.md, section 2): Coons patches and patches of arcs of the Bézier curves
// themselves, by the share of their exact length. It has no polylines, no grid and no tolerance.
// In: curves and patches of a valve. Out: points, normals and curvatures anywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/bulge.hpp"
#include "valve/patches.hpp"

namespace riis::accuracy {

// A point of a placed patch.
struct SurfacePoint {
  Vec3 point, normal;  // unit, along S_u x S_v, turned over in mirror images; 0 if undefined
  double curvature;    // the larger principal curvature, without sign; infinite if there is no normal
};

class SmoothSurface {
 public:
  explicit SmoothSurface(const PatchSet &set);

  // Images of patches have numbers and a patch_id.
  std::size_t n_images() const { return images_.size(); }
  std::int32_t patch_id(std::size_t image) const { return images_[image].image.patch_id; }
  std::size_t image_of(std::int32_t patch_id) const;

  // The result is right up to the rounding of the curves' lengths, 1e-13 of them.
  Vec3 at(std::size_t image, double u, double v) const;
  // Uses differences over `step`. u and v must be at least that far from 0 and 1.
  static constexpr double step = 1e-4;
  SurfacePoint describe(std::size_t image, double u, double v) const;
  // Returns all points (u[i], v[j]), with u running fastest. Every curve is evaluated once per line.
  std::vector<Vec3> at_lines(std::size_t image, const std::vector<double> &u, const std::vector<double> &v) const;

 private:
  struct SmoothPatch {
    Curve v0, v1;
    std::optional<Curve> u0, u1;  // for a Coons patch
    std::optional<Bulge> bulge;   // for a patch of arcs
  };
  struct Image {
    std::size_t patch;
    PatchImage image;
  };
  // The curves' values on a line u = const, and on a line v = const.
  struct AcrossU {
    Vec3 c0, c1, offset;
  };
  struct AcrossV {
    Vec3 d0, d1;
  };
  AcrossU across_u(const SmoothPatch &patch, double u) const;
  AcrossV across_v(const SmoothPatch &patch, double v) const;
  static Vec3 blend(const SmoothPatch &patch, double u, double v, const AcrossU &c, const AcrossV &d);

  std::vector<SmoothPatch> patches_;
  std::vector<Image> images_;
};

}  // namespace riis::accuracy
