// SPDX-License-Identifier: Apache-2.0
// Measures the distance of a point to the surface without triangles (paper, 4.1), for comparison.
// In: a point, a limit. Out: the closest point that the method finds, with its patch, u and v.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/coons.hpp"
#include "geometry/placement.hpp"
#include "geometry/vec3.hpp"
#include "valve/patches.hpp"

namespace riis {

// Turns placed patches into functions S(u,v) that can be evaluated anywhere (paper, 3.3), for sampling and minimisation.
// In: a valve's curves and patches, the allowed error, the placement. Out: a grid of quads for each image of a patch.

// S(u,v), bilinear in every quad of a grid with placed points.
struct PlacedPatch {
  QuadGrid grid;
  std::int32_t leaflet_id, patch_id;
  bool is_turned_over;  // S_u x S_v points against the normal

  Vec3 at(double u, double v) const { return evaluate(grid, u, v); }
  // Returns the unit normal by the right-hand rule of the triangles, or 0 if S has no normal there, for example at a
  // collapsed side. On a grid line it returns the normal of the quad after the line.
  Vec3 normal_at(double u, double v) const;
};

struct PlacedPatches {
  std::vector<PlacedPatch> patches;
  // For each patch, a bound on the distance between S and the smooth surface at equal (u,v), in mesh units. The bound is at most
  // max_error times the scale.
  std::vector<double> errors;

  // max_error is in the patches' units before placement. Fails with RIIS_LIMIT_EXCEEDED if make_grids does.
  PlacedPatches(const PatchSet &set, double max_error, const Placement &placement, bool flip_normals);
  double largest_error() const;
};

// Calls visit(along_u, along_v) for every quad. along_u has S_u at the lower and the upper v, and along_v has S_v at the lower
// and the upper u. Elsewhere in the quad, S_u and S_v are weighted means of these.
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

// The largest |S_u| and |S_v|. No line v = const is longer than the first, and no line u = const is longer than the second.
struct Speeds {
  double u, v;
};
Speeds largest_speeds(const QuadGrid &grid);

// Returns the box of the grid's points. The box also holds every S(u,v), which is a weighted mean of these points.
Bounds bounds_of(const QuadGrid &grid);

// Returns the square of the distance from p to a box. The result is at most dot(q - p, q - p) for any point q in the box, even in
// the last bit: rounding keeps the order of differences, squares and sums.
double distance_sq_to(const Bounds &box, Vec3 p);

struct ClosestOnPatches {
  double distance_sq = std::numeric_limits<double>::infinity();
  std::int64_t patch = -1;  // position among the placed patches; -1 for none
  double u = 0, v = 0;
  Vec3 point{0, 0, 0};
};

class PatchDistance {
 public:
  virtual ~PatchDistance() = default;

  // Returns the closest point that the method finds, if its distance from p is at most limit (>= 0, may be infinite).
  // Otherwise patch is -1. A result within the limit has the same bits for every limit. Several threads may call this function at
  // once.
  virtual ClosestOnPatches closest(Vec3 p, double limit) const = 0;

  // Returns false only if the surface certainly has no point within the limit of p.
  virtual bool may_be_within(Vec3 p, double limit) const = 0;

  // Returns true if the method measures the distance to the same set of points for every p. If so, the results for two points
  // differ by at most the distance between the two points.
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

// Makes the method that a surface's options choose. Fails with RIIS_LIMIT_EXCEEDED if it would need too many patches or
// samples.
std::unique_ptr<const PatchDistance> make_distance(const PatchSet &set, const DistanceRequest &request,
                                                   const Placement &placement, bool flip_normals);

}  // namespace riis
