// SPDX-License-Identifier: Apache-2.0
// Patches with one image each: every image becomes a separate patch, because a warp has no symmetry (docs/theory/warp.md, "Warped
// valves"). This file makes the copies of curves that these patches need.
#pragma once

#include <cstddef>

#include "base/recycled.hpp"
#include "geometry/curve.hpp"
#include "valve/patches.hpp"

namespace riis {

// A curve of one image: placed spans, and the spans' rates if the set has rates.
struct CurveCopy {
  std::size_t curve;
  const PatchImage *image;
  std::size_t next;  // another copy of the same curve; the largest number if there is none
  Vector<Bezier> spans, rates;
};

// Collects the copies of curves that the images of a set need. Images that share a curve also share its copy. The set must
// outlive this object.
class Unfolding {
 public:
  explicit Unfolding(const PatchSet &set);

  Vector<CurveCopy> &copies() { return copies_; }
  Vector<Patch> &patches() { return patches_; }

 private:
  static constexpr std::size_t no_copy = static_cast<std::size_t>(-1);

  std::size_t add(std::size_t curve, const PatchImage *image);
  bool has_copy_at(const CurveCopy &copy, const PatchImage &image) const;
  std::size_t copy_of(std::size_t curve, const PatchImage &image);
  Vec3 &end_of(const Side &side, bool last);
  Patch unfolded(std::size_t number, std::size_t which);
  void sew(const Patch &patch, const Patch &twin, SeamPlace place);

  const PatchSet &set_;
  bool keeps_numbers_ = false;
  Vector<std::size_t> first_;
  Vector<CurveCopy> copies_;
  Vector<Patch> patches_;
};

}  // namespace riis
