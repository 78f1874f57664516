// SPDX-License-Identifier: Apache-2.0
#include "mesh/grid_clusters.hpp"

#include <algorithm>

namespace riis {

// Doubles the size of a brick until it consists of n bricks of the original size. Returns the places of these n bricks. Each
// doubling is along the axis on which the brick is shortest, so that the result is nearly a cube. Axes along which the brick
// already covers the whole box are left out.
GridClusters::Parts GridClusters::parts_of(int n, GridIndex &extent) const {
  Parts parts{};
  for (int n_parts = 1; n_parts < n; n_parts *= 2) {
    int shortest = 0;
    double least = Bounds::infinity;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t last = box_.end[axis] - 1, first = box_.begin[axis];
      if (extent[axis] > last - first) continue;
      const double spacing = (grid_->axis(axis)[last] - grid_->axis(axis)[first]) / static_cast<double>(last - first);
      const double length = static_cast<double>(extent[axis]) * spacing;
      if (length < least) least = length, shortest = axis;
    }
    for (int part = 0; part < n_parts; ++part)
      for (int axis = 0; axis < 3; ++axis)
        parts.at[axis][n_parts + part] =
            parts.at[axis][part] + (axis == shortest ? static_cast<std::int32_t>(extent[axis]) : 0);
    extent[shortest] *= 2;
  }
  return parts;
}

void GridClusters::make(const Grid &grid, const GridBox &box) {
  grid_ = &grid;
  box_ = box;
  frame_ = frame_around({grid.at(box.begin), grid.at({box.end[0] - 1, box.end[1] - 1, box.end[2] - 1})});
  GridIndex extent{1, 1, 1};
  lanes_ = parts_of(nodes_per_leaf, extent);
  leaf_extent_ = extent;
  leaves_ = parts_of(leaves_per_cluster, extent);
  cluster_extent_ = extent;
  clusters_ = parts_of(Clusters::clusters_per_region, extent);
  region_extent_ = extent;
  for (int node = 0; node < nodes_per_cluster; ++node) {
    step_[node] = 0;
    for (int axis = 0; axis < 3; ++axis)
      step_[node] +=
          grid.stride(axis) * (leaves_.at[axis][node / nodes_per_leaf] + lanes_.at[axis][node % nodes_per_leaf]);
  }
  const double centre[3] = {frame_.centre.x, frame_.centre.y, frame_.centre.z};
  for (int axis = 0; axis < 3; ++axis) {
    n_regions_[axis] = (box.size(axis) + extent[axis] - 1) / extent[axis];
    const std::int64_t n = n_regions_[axis] * extent[axis];
    std::vector<float> &x = x_[axis];
    if (static_cast<std::size_t>(n) > x.capacity()) x.reserve(static_cast<std::size_t>(2 * n));
    resize(x, n);
    for (std::int64_t i = 0; i < n; ++i) {
      const std::int64_t at = box.begin[axis] + std::min(i, box.size(axis) - 1);
      view(x)[i] = static_cast<float>(frame_.scale * (grid.axis(axis)[at] - centre[axis]));
    }
  }
}

GridIndex GridClusters::begin_of_region(std::int64_t region) const {
  return {region % n_regions_[0] * region_extent_[0], region / n_regions_[0] % n_regions_[1] * region_extent_[1],
          region / n_regions_[0] / n_regions_[1] * region_extent_[2]};
}

GridIndex GridClusters::begin_of(std::int64_t cluster) const {
  GridIndex begin = begin_of_region(cluster / Clusters::clusters_per_region);
  for (int axis = 0; axis < 3; ++axis) begin[axis] += clusters_.at[axis][cluster % Clusters::clusters_per_region];
  return begin;
}

const Boxes &GridClusters::boxes_at(const GridIndex &begin, const Parts &parts, const GridIndex &extent,
                                    Boxes &boxes) const {
  bool is_empty[16] = {};
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 16; ++k) {
      const std::int64_t first = begin[axis] + parts.at[axis][k];
      boxes.lower[axis][k] = view(x_[axis])[first];
      boxes.upper[axis][k] = view(x_[axis])[first + extent[axis] - 1];
      is_empty[k] = is_empty[k] || first >= box_.size(axis);
    }
  for (int k = 0; k < 16; ++k)
    for (int axis = 0; axis < 3 && is_empty[k]; ++axis)
      boxes.lower[axis][k] = NodeBox::inf, boxes.upper[axis][k] = -NodeBox::inf;
  return boxes;
}

void GridClusters::open(std::int64_t cluster, std::uint32_t leaves, Room &room) const {
  room.begin = begin_of(cluster);
  room.first = 0;
  for (int axis = 0; axis < 3; ++axis) room.first += room.begin[axis] * grid_->stride(axis);
  for (std::uint32_t rest = leaves; rest; rest &= rest - 1) {
    const int i = __builtin_ctz(rest);
    float *const to[3] = {room.leaves[i].x, room.leaves[i].y, room.leaves[i].z};
    for (int axis = 0; axis < 3; ++axis) {
      const float *const x = x_[axis].data() + room.begin[axis] + leaves_.at[axis][i];
      const std::int32_t *const at = lanes_.at[axis];
      for (int lane = 0; lane < nodes_per_leaf; ++lane) to[axis][lane] = x[at[lane]];
    }
  }
}

std::uint32_t GridClusters::lanes(int leaf, const Room &room) const {
  std::uint32_t lanes = 0xffffffffu;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t n = box_.size(axis) - room.begin[axis] - leaves_.at[axis][leaf];
    for (int lane = 0; n < leaf_extent_[axis] && lane < nodes_per_leaf; ++lane)
      if (lanes_.at[axis][lane] >= n) lanes &= ~(1u << lane);
  }
  return lanes;
}

void GridClusters::fill_points(int leaf, std::uint32_t lanes, Room &room) const {
  const double *x[3];
  for (int axis = 0; axis < 3; ++axis)
    x[axis] = grid_->axis(axis) + box_.begin[axis] + room.begin[axis] + leaves_.at[axis][leaf];
  double *const xyz = room.points[leaf].xyz;
  for (std::uint32_t rest = lanes; rest; rest &= rest - 1) {
    const int lane = __builtin_ctz(rest);
    for (int axis = 0; axis < 3; ++axis) xyz[3 * lane + axis] = x[axis][lanes_.at[axis][lane]];
  }
}

}  // namespace riis
