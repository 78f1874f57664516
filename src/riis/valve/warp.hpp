// SPDX-License-Identifier: Apache-2.0
// A smooth map of space that landmarks determine (docs/theory/warp.md): an affine map plus a function |r|^3 for each landmark.
// This file computes the map's values and derivatives from the landmarks at rest and their present places.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/recycled.hpp"
#include "geometry/vec3.hpp"
#include "kernels/kernels.hpp"
#include "valve/patches.hpp"

namespace riis {

class LandmarkCuts;

// A map at a point: the value, and its derivatives along x, y and z.
struct MapAt {
  Vec3 value, along_x, along_y, along_z;

  Vec3 along(Vec3 direction) const { return direction.x * along_x + direction.y * along_y + direction.z * along_z; }
  double determinant() const { return dot(cross(along_x, along_y), along_z); }
};

// The map x -> x + size * (shift + linear * y + sum of weight_i |y - source_i|^3) with y = (x - centre) / size. A map without
// sources and shift is the identity.
class WarpMap {
 public:
  Vec3 value(Vec3 x) const;
  MapAt at(Vec3 x) const;

  Vec3 centre{0, 0, 0};
  double size = 1;
  Vec3 shift{0, 0, 0};
  Vec3 linear_x{0, 0, 0}, linear_y{0, 0, 0}, linear_z{0, 0, 0};  // the columns of `linear`
  // Each coordinate of the sources and of the weights has a separate array, so that the processor handles eight at a time.
  // Sources with the weight 0 make the number of sources a multiple of eight.
  Vector<double> source_x, source_y, source_z, weight_x, weight_y, weight_z;
  std::size_t n_sources = 0;

  Vec3 source(std::size_t i) const { return centre + size * Vec3{source_x[i], source_y[i], source_z[i]}; }

 private:
  CubeSources cubes() const;
};

// The map between two states of a valve: (1 - opening) times the map `closed` plus opening times the map `open`.
class BlendedWarp {
 public:
  BlendedWarp(const WarpMap &closed, const WarpMap &open, double opening)
      : closed_(closed), open_(open), opening_(&closed == &open ? 0 : opening) {}

  Vec3 value(Vec3 x) const;
  MapAt at(Vec3 x) const;
  // Returns the map's derivative with respect to the opening.
  Vec3 rate(Vec3 x) const;
  bool changes_with_opening() const { return &closed_ != &open_; }

 private:
  const WarpMap &closed_, &open_;
  double opening_;
};

// The quality of a map: how far it misses the targets, its smoothing and its least determinant.
struct WarpQuality {
  double rms_residual, largest_residual;  // distances of mapped sources from their targets
  std::int64_t largest_landmark;
  double smoothing;          // lambda; infinite if the map is affine
  double least_determinant;  // the least determinant of the map's derivative, half way between near landmarks
  Vec3 least_point;          // where the determinant is least
  std::int64_t least_landmark;
};

// Landmarks at rest. The landmarks' equations are reduced to a tridiagonal matrix once. To find the map to new targets then costs
// only as much as a few products of a matrix and a vector.
class WarpLandmarks {
 public:
  // `noise` is the standard deviation of each coordinate of the targets. It is at least 0. Fails with RIIS_INVALID_ARGUMENT for
  // too few landmarks, for two landmarks in one place, and for landmarks that all lie on one line. The message calls the array
  // `name`.
  WarpLandmarks(const Vector<Vec3> &sources, double noise, const char *name);

  std::size_t size() const { return sources_.size(); }
  const Vector<Vec3> &sources() const { return sources_; }
  // True if the landmarks are too near to a plane to determine an affine map. The map then stretches space across the plane as
  // much as the landmarks stretch it within the plane.
  bool is_planar() const { return is_planar_; }

  // Returns an (n, n) matrix. Its product with the displacements gives the weights of a map that meets its targets. The product
  // of displacements and weights is the map's bending. Displacements are measured in the map's `size`.
  Vector<double> bending_matrix();

  // Writes the map to the targets, and the map's quality. The same targets give the same bits. Accepts a map of any quality.
  void fit(const Vector<Vec3> &targets, WarpMap &map, WarpQuality &quality);

 private:
  void reduce();
  void tridiagonalise(Vector<double> &matrix);
  double solve(double lambda);
  double smoothing_for_noise();

  Vector<Vec3> sources_;
  double noise_ = 0;
  bool is_planar_ = false;
  Vec3 centre_{0, 0, 0};
  double size_ = 1;
  Vec3 axis_[3];                      // principal directions of the sources, the thinnest last
  std::size_t n_terms_ = 4;           // terms of the polynomial: 1, and the coordinates along the first axes
  std::size_t n_free_ = 0;            // the number of landmarks minus n_terms_
  Vector<Vec3> scaled_;               // (source - centre) / size
  Vector<double> basis_;              // (n_free_, n): U, columns orthogonal to the polynomials
  Vector<double> least_squares_;      // (n_terms_, n): gives the polynomial that fits values at the landmarks best
  Vector<double> of_kernel_;          // (n_terms_, n): the same for a sum of |r|^3, from the sum's weights
  Vector<double> diagonal_, beside_;  // diagonals of the tridiagonal matrix U^T |r|^3 U
  // The places half way from each landmark to the nearest other landmark. A map that folds between landmarks changes most at
  // these places.
  struct Probe {
    Vec3 place;
    std::int64_t landmark;
  };
  Vector<Probe> probes_;
  // Memory of fit().
  Vector<Vec3> displacement_, reduced_, solution_;
  Vector<double> pivot_;
};

// A warp moves the curves of a valve's patches (docs/theory/warp.md). Every image of a patch first becomes a separate patch.

// Returns the patches, with every image as a separate patch. The patches keep their order and their labels u and v. Patches that
// met before still share their curves. Patches that already have one image each keep the numbers of their curves.
PatchSet without_images(const PatchSet &set);

// Returns the same patches with warped curves. Curves are cut at landmarks first. Each part of a curve becomes a cubic between
// its warped ends, in the directions of its warped end tangents. The lengths of these tangents are fitted by least squares, to
// bring the cubic as near as possible to the part's warped points. Arcs are bent anew between warped curves. If `check` is
// FoldCheck::yes, fails with RIIS_INVALID_PARAMETER for a warp that folds at a patch or turns a part of the patch over. The
// message names the place and the value.
enum class FoldCheck { no, yes };
PatchSet warped(const PatchSet &set, const BlendedWarp &warp, const LandmarkCuts &cuts,
                FoldCheck check = FoldCheck::yes);

// `points` states places on the warped curve. For each place, writes the point there, and the share of the curve's length up to
// this point.
void locate_on_curve(const Curve &curve, MaterialPoints &points);

}  // namespace riis
