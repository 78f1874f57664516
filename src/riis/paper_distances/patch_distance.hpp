// SPDX-License-Identifier: Apache-2.0
// Measures the distance from a point to the surface without triangles (paper, 4.1), for comparison. There are two methods,
// minimisation and sampling. Both find the closest point of the surface within a limit, and its patch, u and v.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "geometry/coons.hpp"
#include "geometry/placement.hpp"
#include "geometry/vec3.hpp"
#include "valve/patches.hpp"

namespace riis {

// Turns placed patches into functions S(u,v) that can be evaluated anywhere (paper, 3.3), for sampling and minimisation. Each
// image of a patch becomes a grid of quads.

// S(u,v) on a grid with placed points. The placed patch is bilinear in every quad.
struct PlacedPatch {
  QuadGrid grid;
  std::int32_t leaflet_id, patch_id;
  bool is_turned_over;  // S_u x S_v points against the normal

  Vec3 at(double u, double v) const { return evaluate(grid, u, v); }
  // Returns the unit normal by the right-hand rule of the triangles. Returns 0 where S has no normal, for example at a collapsed
  // side. On a grid line, the function returns the normal of the quad after the line.
  Vec3 normal_at(double u, double v) const;
};

struct PlacedPatches {
  std::vector<PlacedPatch> patches;
  // For each patch, a bound on the distance between S and the smooth surface at equal (u,v), in mesh units. The bound is at most
  // max_error times the scale.
  std::vector<double> errors;

  // max_error is in the units of the patches before their placement. Fails with RIIS_LIMIT_EXCEEDED in the same cases as
  // make_grids.
  PlacedPatches(const PatchSet &set, double max_error, const Placement &placement, bool flip_normals);
  double largest_error() const;
};

// Calls visit(along_u, along_v) for every quad. `along_u` has S_u at the two sides v = const of the quad, and `along_v` has S_v
// at the two sides u = const. Inside the quad, S_u and S_v are weighted means of these vectors.
template <class Visit>
void for_each_derivatives(const QuadGrid &grid, const Visit &visit) {
  for (std::size_t j = 0; j + 1 < grid.v.size(); ++j)
    for (std::size_t i = 0; i + 1 < grid.u.size(); ++i) {
      const Vec3 p00 = grid.point(i, j), p10 = grid.point(i + 1, j);
      const Vec3 p01 = grid.point(i, j + 1), p11 = grid.point(i + 1, j + 1);
      const double per_u = 1 / (grid.u[i + 1] - grid.u[i]), per_v = 1 / (grid.v[j + 1] - grid.v[j]);
      visit(std::array<Vec3, 2>{per_u * (p10 - p00), per_u * (p11 - p01)},
            std::array<Vec3, 2>{per_v * (p01 - p00), per_v * (p11 - p10)});
    }
}

// The largest |S_u| and |S_v|. A line v = const is at most as long as the largest |S_u|. A line u = const is at most as long as
// the largest |S_v|.
struct Speeds {
  double u, v;
};
Speeds largest_speeds(const QuadGrid &grid);

// Returns the box of the grid's points. The box also contains every S(u,v), because each S(u,v) is a weighted mean of these
// points.
Bounds bounds_of(const QuadGrid &grid);

struct ClosestOnPatches {
  double distance_sq = std::numeric_limits<double>::infinity();
  std::int64_t patch = -1;  // position among the placed patches; -1 for none
  double u = 0, v = 0;
  Vec3 point{0, 0, 0};
};

class PatchDistance {
 public:
  virtual ~PatchDistance() = default;

  // Returns the closest point that the method finds, if its distance from p is at most `limit`. Otherwise the returned patch is
  // -1. `limit` is at least 0 and may be infinite. The bits of a result do not depend on the limit. Several threads may call this
  // function at once.
  virtual ClosestOnPatches closest(Vec3 p, double limit) const = 0;

  // Returns false only if the surface certainly has no point within the limit of p.
  virtual bool may_be_within(Vec3 p, double limit) const = 0;

  // Returns true if the method measures all distances to the same fixed set of points. The results for two points p then differ
  // by at most the distance between these two points.
  virtual bool is_of_fixed_points() const = 0;

  virtual const char *name() const = 0;

  const PlacedPatches &patches() const { return patches_; }

 protected:
  explicit PatchDistance(PlacedPatches patches) : patches_(std::move(patches)) {}

  PlacedPatches patches_;
};

struct DistanceRequest {
  std::int32_t method;  // RIIS_MEASURE_SAMPLING or RIIS_MEASURE_MINIMIZATION
  double max_error;     // measure_tolerance * half_thickness, in mesh units
};

// Makes the object for the method that the options of a surface choose. Fails with RIIS_LIMIT_EXCEEDED if the method would need
// too many patches or samples.
std::unique_ptr<const PatchDistance> make_distance(const PatchSet &set, const DistanceRequest &request,
                                                   const Placement &placement, bool flip_normals);

// Distances by sampling (paper, 4.1 "Sampling"): the method finds the nearest of evenly spaced points S(u,v). The number of
// samples of a patch depends on its width and height (docs/theory/paper-distances.md).
// A SampleSet makes the samples for an allowed error, and finds the nearest sample.

// The most samples that the library accepts. Each sample takes 24 bytes, and the boxes of the tree need some more memory.
inline constexpr std::int64_t max_samples = 16'777'216;

// The numbers of steps between samples. The samples lie at all pairs of u = 0, 1/s_u, ..., 1 and v = 0, 1/s_v, ..., 1. The member
// `u` is s_u, and `v` is s_v.
struct SampleCounts {
  std::int64_t u, v;
  double n() const { return static_cast<double>(u + 1) * static_cast<double>(v + 1); }
};

// Bounds the distance between any S(u,v) and the sample with the nearest u and v. At each place on S, take the parallelogram with
// the sides h_u S_u and h_v S_v. The bound is half of the longest diagonal of all these parallelograms.
double covering_radius(const QuadGrid &grid, double h_u, double h_v);

// Returns the smallest numbers of steps in u and v for which the covering radius is at most `radius`. The two numbers have the
// same ratio as the patch's width and height. The result may exceed max_samples.
SampleCounts samples_within(const QuadGrid &grid, double radius);

class SampleSet final : public PatchDistance {
 public:
  // Makes samples. The distance to the nearest sample differs from the distance to the smooth surface by at most max_error, in
  // mesh units. The covering radius is therefore max_error minus the patches' own error. Fails with RIIS_LIMIT_EXCEEDED for more
  // than max_samples.
  SampleSet(PlacedPatches patches, double max_error);

  ClosestOnPatches closest(Vec3 p, double limit) const override;
  bool may_be_within(Vec3 p, double limit) const override;
  bool is_of_fixed_points() const override { return true; }
  const char *name() const override { return "sampling"; }

  const std::vector<double> &xyz() const { return xyz_; }
  std::int64_t n_samples() const { return view(xyz_).size() / 3; }

 private:
  static constexpr std::int64_t samples_per_leaf = 64;

  // A node of the tree: a box around the samples of a leaf, or around the boxes of two other nodes. The first of these two nodes
  // follows this node in the array.
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
