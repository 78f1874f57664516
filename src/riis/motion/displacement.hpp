// SPDX-License-Identifier: Apache-2.0
// Computes how far the points of a patch have moved since an earlier state of the valve (docs/theory/velocity.md). The result is
// the displacement of every vertex of the patch's grid.
#pragma once

#include <array>
#include <cstddef>

#include "base/recycled.hpp"
#include "geometry/coons.hpp"
#include "geometry/curve.hpp"
#include "geometry/placement.hpp"
#include "geometry/quads.hpp"
#include "valve/patches.hpp"

namespace riis {

// The earlier state of the valve, and the time from it to the triangulated state.
struct EarlierState {
  const PatchSet &patches_before;
  Placement placement_before;
  double seconds;  // not 0; negative if the valve moves backwards in time
};

// A patch in both states.
struct MovedPatch {
  const PatchSet &now, &before;
  std::size_t patch;
};

// The polynomial through values at n_material nodes, in Newton's form. The first node is 0 and the last node is 1.
template <class T>
class Through {
 public:
  Through() = default;
  Through(const std::array<double, n_material> &nodes, const std::array<T, n_material> &values)
      : nodes_(nodes), factors_(values) {
    for (std::size_t order = 1; order < n_material; ++order)
      for (std::size_t i = n_material - 1; i >= order; --i)
        factors_[i] = (1 / (nodes_[i] - nodes_[i - order])) * (factors_[i] - factors_[i - 1]);
  }

  T at(double x) const {
    T value = factors_[n_material - 1];
    for (std::size_t i = n_material - 1; i-- > 0;) value = (x - nodes_[i]) * value + factors_[i];
    return value;
  }

 private:
  std::array<double, n_material> nodes_{};
  std::array<T, n_material> factors_{};
};

// Tells where a material point of a side is in each of the two states. Without a warp, the point has the same share of the length
// in both states. A warp stretches curves unevenly, so the point's share may change. A warped curve also differs slightly from
// the mapped points of the original curve. If this difference changes between the states, `rest` compensates for the change.
class SideMaterial {
 public:
  SideMaterial() = default;  // of a side that is not warped
  SideMaterial(const MovedPatch &moved, Side Patch::*side);

  bool is_warped() const { return is_warped_; }
  // For points that now have the given shares, returns their shares in the earlier state. The result ascends from 0 to 1.
  Vector<double> shares_before(const Vector<double> &shares) const;
  Vec3 rest(double share) const { return rest_.at(share); }

  // Returns the current share of the material point k of the side.
  const std::array<double, n_material> &nodes() const { return nodes_; }

 private:
  bool is_warped_ = false;
  std::array<double, n_material> nodes_{};
  Through<double> slide_;
  Through<Vec3> rest_;
};

// The SideMaterial of each side of a patch. A patch of arcs needs none for u0 and u1, because its arcs follow from v0 and v1.
struct PatchMaterial {
  explicit PatchMaterial(const MovedPatch &moved);

  bool has_arcs;  // whether the patch has arcs in one of the states
  SideMaterial v0, v1, u0, u1;
};

// Returns the displacement of the mapped offsets of a patch of arcs, minus the displacement of the warped curves' own offsets.
// The polynomial is 0 for a patch without a warp.
Through<Vec3> rest_of_offsets(const MovedPatch &moved, const SideMaterial &base, const SideMaterial &edge);

// Inside a warped Coons patch, the displacement is the Coons combination of the sides' displacements plus a rest, which this
// class computes. The rest is 0 at the sides, and is a polynomial of degree 3 in u and in v. It is determined by its values at
// four inner points, where u and v are 1/3 or 2/3. The displacement at an inner point is computed from the displacement of a
// mapped material point close to it (MappedInside).
class RestInside {
 public:
  RestInside() = default;
  RestInside(const MovedPatch &moved, const PatchMaterial &material);

  bool is_warped() const { return is_warped_; }
  Vec3 at(double u, double v) const {
    return first(u) * (first(v) * rest_[0] + second(v) * rest_[2]) +
           second(u) * (first(v) * rest_[1] + second(v) * rest_[3]);
  }

 private:
  // first(x) is 1 at x = 1/3, and 0 at x = 2/3 and at the ends.
  static double first(double x) { return 13.5 * x * (1 - x) * (2.0 / 3 - x); }
  static double second(double x) { return 13.5 * x * (1 - x) * (x - 1.0 / 3); }

  bool is_warped_ = false;
  std::array<Vec3, 4> rest_{};
};

// The displacement S_now(u,v) - S_before(u,v) of a patch at the vertices of its grid and of its subdivided quads. Both states are
// evaluated on the smooth patches. On the sides, the curves are evaluated. Inside, the patch's combination of its sides is
// evaluated. A point is identified in both states by its (u,v) alone, so the triangles of the two states may differ. On a warped
// side, SideMaterial finds where each point was in the earlier state. If the sides and the bulge did not change, the result is
// exactly 0.
class PatchDisplacement {
 public:
  // Computes the displacements at the grid's vertices. The grid must still have its lines.
  PatchDisplacement(const MovedPatch &moved, const LevelledGrid &levelled);

  // Returns the displacement where two lines of the grid meet.
  Vec3 at_lines(std::size_t i, std::size_t j) const { return at(column_[i], row_[j]); }
  // Returns the displacement inside the quad whose first corner is the grid point (i, j). The sides of the quad are halved
  // `level` times.
  Vec3 in_quad(std::size_t i, std::size_t j, int level, int column, int row) const {
    return at(column_[i] + (static_cast<std::size_t>(column) << (column_levels_[i] - level)),
              row_[j] + (static_cast<std::size_t>(row) << (row_levels_[j] - level)));
  }
  // Returns the displacement inside a quad. Along a side of the quad, the displacement is linear between the vertices that are
  // also vertices of the neighbouring quad. The displacement therefore does not jump between neighbouring quads.
  Vec3 without_jumps(std::size_t i, std::size_t j, int column, int row) const;

 private:
  Vec3 at(std::size_t i, std::size_t j) const;

  Vector<int> column_levels_, row_levels_;  // the largest level of the quads between two lines
  Vector<std::size_t> column_, row_;        // for each line of the grid, its position among the halved lines
  Vector<double> u_, v_;                    // u and v of the halved lines
  bool has_arcs_;
  const LevelledGrid &levelled_;
  SideVectors sides_;
  Vector<Vec3> offsets_;
  RestInside rest_;  // for a patch without arcs
};

// The velocity in space of the points of one image of a patch. It combines the displacements of the patch, the image and the
// placement.
class ImageVelocity {
 public:
  ImageVelocity(const PatchImage &now, const PatchImage &before, const Placement &placement_now,
                const EarlierState &earlier);

  // Returns the mean velocity of a point over the time between the two states. In the patch's own coordinates, the point is now
  // at p, and was at p - displacement in the earlier state. If the image and the placement are at rest, no digits are lost by
  // cancellation.
  Vec3 velocity(Vec3 p, Vec3 displacement) const {
    const Vec3 moved = now_.linear * displacement + difference_.linear * (p - displacement) + difference_.offset;
    return {moved.x / seconds_, moved.y / seconds_, moved.z / seconds_};
  }

 private:
  struct AffineMap {
    Rotation linear;  // a matrix of any scale, perhaps with a reflection
    Vec3 offset;
  };
  static AffineMap map_of(const PatchImage &image, const Placement &placement);

  AffineMap now_, difference_;
  double seconds_;
};

// Returns the offsets O of a patch of arcs (geometry/bulge.hpp) at the u of these points, which ascend. Returns 0 for other
// patches. At the two ends, O is computed from the shared sides, so that neighbouring patches agree.
Vector<Vec3> arc_offsets(const PatchSet &set, const Patch &patch, const CurvePoints &base, const CurvePoints &edge);

// Returns the joints of a side, as values of the patch's parameter.
Vector<double> joints_of(const PatchSet &set, const Side &side);
// Moves each grid line together with the two joints on both sides of it. If the number of joints has changed, no line moves.
Vector<double> moved_with_joints(const Vector<double> &lines, const Vector<double> &from, const Vector<double> &to);

// Returns whether each patch has the same images in both states.
bool have_same_build(const PatchSet &now, const PatchSet &before);
// Gives each image of a state its own patch. Two states of one valve may be built differently: equal cusps are images of one half
// cusp, but unequal cusps have separate patches. The new patches are in the order of the images of `like`, which has the same
// ids.
PatchSet with_own_patches(const PatchSet &state, const PatchSet &like);
// Fails with RIIS_INVALID_PARAMETER if the two states are built differently.
void check_same_build(const PatchSet &now, const PatchSet &before);
// Fails with RIIS_INVALID_PARAMETER if the images of the two states have different ids. If the ids are the same, with_own_patches
// can give both states the same structure. The message names the states.
void check_same_ids(const PatchSet &now, const PatchSet &before, const StateNames &names = {"valve_before", "valve"});

}  // namespace riis
