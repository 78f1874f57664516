// SPDX-License-Identifier: Apache-2.0
// Puts neighbouring triangles into groups of up to 16, as the filters take them (kernels/kernels.hpp).
// In: a triangle set. Out: groups in the surface's frame, their bounds, and all corners as they are.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/bounds.hpp"
#include "kernels/kernels.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

// Coordinates relative to the surface are (x - centre) * scale. The scale is a power of two that makes the surface's
// half extent from 1/2 to 1. Both operations are right to rounding of their result.
struct Frame {
  Vec3 centre{0, 0, 0};
  double scale = 1;

  Frame() = default;
  explicit Frame(const Bounds &bounds);
  Vec3 operator()(Vec3 p) const { return scale * (p - centre); }
};

// Round to single precision, towards minus and plus infinity.
float round_down(double x);
float round_up(double x);

// Bounds the error of the filters' distances in the surface's frame (docs/theory.md, section 8). It holds for points that were
// in a frame `ratio` times as large and moved by `shift`, up to `reach` from triangles with edges up to `longest_edge`.
inline float filter_error(double ratio, double shift, double reach, double longest_edge) {
  return static_cast<float>(0x1p-21 * (ratio + shift + 4 * reach + 7 * longest_edge + 6));
}

// Bounds the difference between the squares of two filtered distances that are really equal. Both are up to `reach`,
// which includes the error.
inline float filter_tolerance(double error, double reach) { return static_cast<float>(5 * error * (reach + error)); }

// Groups the triangles from begin to end - 1 of a set by their place, and adds the groups to `grouping`.
void group_by_place(const TriangleSet &set, std::int32_t begin, std::int32_t end, Grouping &grouping);

struct TriangleGroups {
  Frame frame;
  std::vector<double> corners;  // (3, 3, n_triangles), as they are
  std::vector<TriangleGroup> groups;
  Bounds of_all;  // of all corners, as they are
  std::vector<GroupBounds> bounds;
  float longest_edge = 0;
  // True if the groups have the same positions in the set as before and are not much larger. Structures built over them
  // then still fit.
  bool are_as_before = false;

  // Copies the corners of a set's triangles, and bounds them.
  void take_corners(const TriangleSet &set, int n_threads);
  // Replaces the groups, for the corners that were taken last, and keeps their memory.
  void make(const TriangleSet &set, const Frame &surface_frame, int n_threads);

 private:
  void enclose(int n_threads);
  double size() const;

  Grouping grouping_;
  bool is_by_place_ = false;
  double size_at_first_ = 0;  // when are_as_before was last false
};

}  // namespace riis
