// SPDX-License-Identifier: Apache-2.0
// Distances by sampling (paper, 4.1 "Sampling"): the method finds the nearest of evenly spaced points S(u,v). The number of
// samples of a patch depends on its width and height (docs/theory.md, section 9).
// In: placed patches, the allowed error of a distance. Out: nearest samples.
#pragma once

#include <cstdint>
#include <vector>

#include "common/array_view.hpp"
#include "paper_distances/patch_distance.hpp"

namespace riis {

// The most samples that the library accepts. Each takes 24 bytes, and the boxes of the tree take a little more.
inline constexpr std::int64_t max_samples = 16'777'216;

// Numbers of steps: samples stand at u = 0, 1/s_u, ..., 1 and at v = 0, 1/s_v, ..., 1, with s_u = `u` and s_v = `v`.
struct SampleCounts {
  std::int64_t u, v;
  double n() const { return static_cast<double>(u + 1) * static_cast<double>(v + 1); }
};

// Bounds the distance between any S(u,v) and the sample with the nearest u and v. The bound is half of the longest diagonal of a
// parallelogram with the sides h_u S_u and h_v S_v anywhere on S.
double covering_radius(const QuadGrid &grid, double h_u, double h_v);

// Returns the fewest samples that keep the covering radius within `radius`. Their numbers in u and v are in the proportion of
// the patch's width to its height. The result may exceed max_samples.
SampleCounts samples_within(const QuadGrid &grid, double radius);

class SampleSet final : public PatchDistance {
 public:
  // Every distance differs from the distance to the smooth surface by at most max_error, in mesh units. The covering radius is
  // max_error minus the patches' own error. Fails with RIIS_LIMIT_EXCEEDED for more than max_samples.
  SampleSet(PlacedPatches patches, double max_error);

  ClosestOnPatches closest(Vec3 p, double limit) const override;
  bool may_be_within(Vec3 p, double limit) const override;
  bool is_of_fixed_points() const override { return true; }
  const char *name() const override { return "sampling"; }

  const std::vector<double> &xyz() const { return xyz_; }
  std::int64_t n_samples() const { return view(xyz_).size() / 3; }

 private:
  static constexpr std::int64_t samples_per_leaf = 64;

  // A box around the samples of a leaf or around two other nodes. The first of the two follows this node in the array.
  struct Node {
    Bounds box;
    std::int32_t second = -1;  // the position of the second node, or -1 in a leaf
    std::int32_t leaf = -1;
  };
  // A block of one patch's samples, stored row by row.
  struct Leaf {
    std::int64_t first;  // the position of its first sample
    std::int32_t patch;
    std::int32_t column, row, n_columns, n_rows;
  };
  struct Samples {
    std::int32_t column, row, n_columns, n_rows;
  };
  struct Query;

  std::int32_t add_patches(std::int32_t begin, std::int32_t end);
  std::int32_t add_samples(std::int32_t patch, const Samples &samples);
  void add_leaf(std::int32_t patch, const Samples &samples, Node &node);
  void join(std::int32_t node, std::int32_t second);
  void visit(std::int32_t at, Query &query) const;

  std::vector<SampleCounts> counts_;  // one for each patch
  std::vector<double> xyz_;           // (3, n_samples), leaf after leaf
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

}  // namespace riis
