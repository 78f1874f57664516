// SPDX-License-Identifier: Apache-2.0
#include "scene/triangle_groups.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {

SurfaceFrame::SurfaceFrame(const Bounds &bounds) {
  centre = bounds.middle();
  const Vec3 extent = bounds.upper - bounds.lower;
  int exponent = 0;
  std::frexp(0.5 * std::max({extent.x, extent.y, extent.z}), &exponent);
  scale = std::ldexp(1.0, -exponent);
}

float round_down(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafterf(f, -std::numeric_limits<float>::infinity()) : f;
}
float round_up(double x) { return -round_down(-x); }

void TriangleGroups::take_corners(const TriangleSet &set, int n_threads) {
  const std::int64_t n = set.n_triangles();
  resize(corners, 9 * n);
  constexpr std::int64_t triangles_per_block = 1024;
  Vector<Bounds> blocks;
  resize(blocks, (n + triangles_per_block - 1) / triangles_per_block);
  const Kernels &simd = kernels(best_instruction_set());
  parallel_for_ranges(n, triangles_per_block, n_threads, [&](const Range &block, int) {
    double lower[3], upper[3];
    simd.take_corners(set.xyz.data(), set.vertex_id.data() + 3 * block.begin, block.end - block.begin,
                      corners.data() + 9 * block.begin, lower, upper);
    view(blocks)[block.begin / triangles_per_block] = {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
  });
  of_all = {};
  for (const Bounds &block : blocks) of_all.add(block);
}

void TriangleGroups::make(const TriangleSet &set, const SurfaceFrame &surface_frame, int n_threads) {
  constexpr double much = 2;
  frame = surface_frame;
  const bool is_by_place = set.grouping.end.empty(), was_by_place = is_by_place_;
  is_by_place_ = is_by_place;
  // If the number of triangles is unchanged, the triangles have probably only moved. Groups that were made by position are
  // therefore kept, until their boxes become much larger.
  const bool is_kept = is_by_place && was_by_place && view(by_place_.order).size() == set.n_triangles();
  if (is_by_place && !is_kept) group_all_by_place(set, by_place_);
  bool are_same = enclose(is_by_place ? by_place_ : set.grouping, n_threads);
  if (is_kept && size() > much * size_at_first_) {
    group_all_by_place(set, by_place_);
    enclose(by_place_, n_threads);
    are_same = false;
  }
  // Finds the longest edge only now, because the groups may have been made a second time above.
  longest_edge = 0;
  for (const GroupBounds &pack : packs) longest_edge = std::max(longest_edge, pack.longest_edge);
  are_as_before = are_same && size() <= much * size_at_first_;
  if (!are_as_before) size_at_first_ = size();
}

// Returns the sum of the extents of all boxes, in the frame's units. This sum grows when the triangles of a group move apart.
double TriangleGroups::size() const {
  double sum = 0;
  for (const OfPack &pack : of_packs_) sum += pack.size;
  return sum;
}

bool TriangleGroups::enclose(const Grouping &grouping, int n_threads) {
  const Vector<std::int32_t> &order = grouping.order, &end = grouping.end;
  const bool is_same_number = end.size() == groups.size();
  groups.resize(end.size());
  bounds.resize(end.size());
  const Kernels &simd = kernels(best_instruction_set());
  const PlainFrame surface_frame{{frame.centre.x, frame.centre.y, frame.centre.z}, frame.scale};
  resize(packs, (view(end).size() + groups_per_pack - 1) / groups_per_pack);
  resize(of_packs_, view(packs).size());
  parallel_for_ranges(view(end).size(), groups_per_pack, n_threads, [&](const Range &range, int) {
    GroupCorners framed[groups_at_once];
    bool are_same = true;
    for (std::int64_t first = range.begin; first < range.end; first += groups_at_once) {
      const auto n = static_cast<std::int32_t>(std::min<std::int64_t>(groups_at_once, range.end - first));
      for (std::int32_t k = 0; k < n; ++k) {
        const std::int64_t g = first + k;
        const std::int32_t begin = g == 0 ? 0 : view(end)[g - 1];
        GroupBounds &of_group = view(bounds)[g];
        const auto in_order = order.begin() + begin;
        are_same = are_same && of_group.n == view(end)[g] - begin &&
                   std::equal(of_group.triangle, of_group.triangle + of_group.n, in_order);
        of_group.n = view(end)[g] - begin;
        std::copy_n(in_order, of_group.n, of_group.triangle);
        // The corners of the next group's triangles lie apart in memory, so they are prefetched.
        const std::int32_t next = g + 1 < range.end ? view(end)[g + 1] : view(end)[g];
        for (std::int32_t i = view(end)[g]; i < next; ++i) {
          const double *ahead = corners.data() + 9 * std::int64_t{view(order)[i]};
          __builtin_prefetch(ahead);
          __builtin_prefetch(ahead + 8);
        }
        simd.frame_group(surface_frame, corners.data(), of_group.triangle, of_group.n, framed[k]);
      }
      simd.make_groups(framed, n, &view(groups)[first], &view(bounds)[first]);
    }
    enclose_pack(range);
    view(of_packs_)[range.begin / groups_per_pack].are_same = are_same;
  });
  return is_same_number &&
         std::all_of(of_packs_.begin(), of_packs_.end(), [](const OfPack &pack) { return pack.are_same; });
}

void TriangleGroups::enclose_pack(const Range &range) {
  GroupBounds &pack = view(packs)[range.begin / groups_per_pack];
  pack = view(bounds)[(range.begin + range.end) / 2];
  double size = 0;
  for (std::int64_t g = range.begin; g < range.end; ++g) {
    const GroupBounds &group = view(bounds)[g];
    for (int i = 0; i < 3; ++i) {
      pack.lower[i] = std::min(pack.lower[i], group.lower[i]);
      pack.upper[i] = std::max(pack.upper[i], group.upper[i]);
      size += static_cast<double>(group.upper[i]) - static_cast<double>(group.lower[i]);
    }
    pack.longest_edge = std::max(pack.longest_edge, group.longest_edge);
  }
  view(of_packs_)[range.begin / groups_per_pack].size = size;
}

}  // namespace riis
