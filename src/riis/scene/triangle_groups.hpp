// SPDX-License-Identifier: Apache-2.0
// Puts neighbouring triangles into groups of up to 16, because the filters work on such groups (kernels/kernels.hpp). The groups
// are in the surface's frame, and have bounds. The original corners of all triangles are also stored.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/array_view.hpp"
#include "geometry/vec3.hpp"
#include "kernels/kernels.hpp"
#include "parallel/threads.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// The frame takes a coordinate x to (x - centre) * scale. The scale is the power of two that brings the surface's half extent
// between 1/2 and 1. The only errors are the rounding of the difference and of the product.
struct SurfaceFrame {
  Vec3 centre{0, 0, 0};
  double scale = 1;

  SurfaceFrame() = default;
  explicit SurfaceFrame(const Bounds &bounds);
  Vec3 operator()(Vec3 p) const { return scale * (p - centre); }
};

// round_down rounds to single precision towards minus infinity, and round_up towards plus infinity.
float round_down(double x);
float round_up(double x);

// Bounds the error of the filters' distances in the surface's frame (docs/theory/clusters.md). A coordinate x of a point is taken
// from another frame to x * ratio + shift. The points are within `reach` of the triangles, whose edges are at most `longest_edge`
// long.
inline float filter_error(double ratio, double shift, double reach, double longest_edge) {
  return static_cast<float>(0x1p-21 * (ratio + shift + 5 * reach + 7 * longest_edge + 3));
}

// Bounds the difference between the computed squares of two distances that are in fact equal. Both distances are at most `reach`,
// which includes the error.
inline float filter_tolerance(double error, double reach) { return static_cast<float>(5 * error * (reach + error)); }

struct TriangleGroups {
  static constexpr std::int64_t groups_per_pack = 16;

  SurfaceFrame frame;
  std::vector<double> corners;  // (3, 3, n_triangles), in the set's own coordinates
  std::vector<TriangleGroup> groups;
  Bounds of_all;  // bounds of all corners, in the set's own coordinates
  std::vector<GroupBounds> bounds;
  // A pack consists of groups_per_pack successive groups, or of fewer at the end. Only these bounds of a pack are set: the box
  // along the coordinate axes, the longest edge, and the corner, which is the corner of one group.
  std::vector<GroupBounds> packs;
  float longest_edge = 0;
  // True if the groups have the same triangles as before, and are not much larger than before. A tree over the groups can then be
  // kept.
  bool are_as_before = false;

  // Copies the corners of a set's triangles, and computes their bounds.
  void take_corners(const TriangleSet &set, int n_threads);
  // Makes new groups of the triangles that take_corners has copied last. Reuses the memory of the old groups.
  void make(const TriangleSet &set, const SurfaceFrame &surface_frame, int n_threads);

  Range groups_of(std::int64_t pack) const {
    return {pack * groups_per_pack, std::min((pack + 1) * groups_per_pack, view(groups).size())};
  }

 private:
  // Facts about the groups of one pack, found by the thread that makes the pack.
  struct OfPack {
    double size;    // the sum of the extents of its groups' boxes
    bool are_same;  // whether each group has the same triangles as before
  };

  // Makes the groups and packs. Returns whether all groups have the same triangles as before.
  bool enclose(const Grouping &grouping, int n_threads);
  void enclose_pack(const Range &range);
  double size() const;

  std::vector<OfPack> of_packs_;
  Grouping by_place_;  // the groups by position, if the set has no groups of its own
  bool is_by_place_ = false;
  double size_at_first_ = 0;  // the size at the last time that are_as_before was false
};

}  // namespace riis
