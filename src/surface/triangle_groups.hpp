// SPDX-License-Identifier: Apache-2.0
// Neighbouring triangles in groups of up to 16, as the filters take them (kernels/kernels.hpp).
// In: a triangle set. Out: groups in the surface's frame, their bounds, and all corners as they are.
#pragma once

#include <vector>

#include "geometry/bounds.hpp"
#include "kernels/kernels.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

// Coordinates relative to the surface: (x - centre) * scale, scale a power of two that makes the surface's half extent
// from 1/2 to 1. Both operations are right to rounding of their result.
struct Frame {
  Vec3 centre{0, 0, 0};
  double scale = 1;

  Frame() = default;
  explicit Frame(const Bounds &bounds);
  Vec3 operator()(Vec3 p) const { return scale * (p - centre); }
};

// Rounded to single precision towards minus and plus infinity.
float round_down(double x);
float round_up(double x);

// The bounds of the corners that triangles use.
Bounds bounds_of(const TriangleSet &set, int n_threads);

// What the filters' distances in the surface's frame may be off by (docs/theory.md, section 8): for points that were in a frame
// `ratio` times as large and moved by `shift`, up to `reach` from triangles of edges up to `longest_edge`.
inline float filter_error(double ratio, double shift, double reach, double longest_edge) {
  return static_cast<float>(0x1p-21 * (ratio + shift + 4 * reach + 7 * longest_edge + 6));
}

// What squares of filtered distances up to `reach`, which the error is part of, may differ by though the distances are the same.
inline float filter_tolerance(double error, double reach) { return static_cast<float>(5 * error * (reach + error)); }

// Groups the triangles from begin to end - 1 of a set by where they are, and adds the groups.
void group_by_place(const TriangleSet &set, std::int32_t begin, std::int32_t end, Grouping &grouping);

struct TriangleGroups {
  Frame frame;
  std::vector<double> corners;  // (3, 3, n_triangles), as they are
  std::vector<TriangleGroup> groups;
  std::vector<GroupBounds> bounds;
  float longest_edge = 0;
  // As when they were last made, by the same positions in the set, and not much larger: what was built over them still fits.
  bool are_as_before = false;

  // Keeps the memory of what was there.
  void make(const TriangleSet &set, const Frame &surface_frame, int n_threads);

 private:
  void enclose(const TriangleSet &set, int n_threads);
  double size() const;

  Grouping grouping_;
  bool is_by_place_ = false;
  double size_at_first_ = 0;  // when they were last made otherwise than before
};

}  // namespace riis
