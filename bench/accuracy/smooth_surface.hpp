// SPDX-License-Identifier: Apache-2.0
// Evaluates the smooth surface to which tolerances refer (docs/theory/triangles.md). The surface consists of Coons patches and
// patches of arcs. The patches are made from the Bézier curves themselves. The parameter of a point on a curve is the exact
// length up to this point, divided by the exact length of the whole curve. The surface has no polylines, no grid and no
// tolerance. Input: curves and patches of a valve. Output: points, normals and curvatures anywhere.
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
  Vec3 point, normal;  // normal: unit vector along S_u x S_v, reversed in mirror images; 0 if undefined
  double curvature;    // the absolute value of the larger principal curvature; infinite if there is no normal
};

class SmoothSurface {
 public:
  explicit SmoothSurface(const PatchSet &set);

  // The images of all patches are numbered from 0. Each image also has a patch_id.
  std::size_t n_images() const { return images_.size(); }
  std::int32_t patch_id(std::size_t image) const { return images_[image].image.patch_id; }
  std::size_t image_of(std::int32_t patch_id) const;

  // The returned point has a relative error of 1e-13, because the lengths of the curves are rounded.
  Vec3 at(std::size_t image, double u, double v) const;
  // Computes derivatives by differences over `step`. u and v must be at least `step` away from 0 and 1.
  static constexpr double step = 1e-4;
  SurfacePoint describe(std::size_t image, double u, double v) const;
  // Returns all points (u[i], v[j]). u runs fastest. A line has a constant u or a constant v. The function evaluates every curve
  // only once per line.
  std::vector<Vec3> at_lines(std::size_t image, const std::vector<double> &u, const std::vector<double> &v) const;

 private:
  struct SmoothPatch {
    Curve v0, v1;
    std::optional<Curve> u0, u1;  // used by a Coons patch
    std::optional<Bulge> bulge;   // used by a patch of arcs
  };
  struct Image {
    std::size_t patch;
    PatchImage image;
  };
  // AcrossU has the curves' points for one value of u, and AcrossV has them for one value of v.
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
