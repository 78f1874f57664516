// SPDX-License-Identifier: Apache-2.0
// A rectilinear grid: three ascending axes, and the place of each node in the caller's arrays. No data are stored for a node: its
// coordinates, number and neighbours are computed from the axes, the first number and the strides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/array_view.hpp"
#include "geometry/vec3.hpp"

namespace riis {

// A number for each axis, such as i, j, k.
struct GridIndex {
  std::int64_t of[3];

  std::int64_t &operator[](std::int64_t axis) { return of[axis]; }
  std::int64_t operator[](std::int64_t axis) const { return of[axis]; }
};

// The nodes with indices from `begin` to below `end` along each axis.
struct GridBox {
  GridIndex begin, end;

  std::int64_t size(std::int64_t axis) const { return end[axis] - begin[axis]; }
  bool is_empty() const { return size(0) <= 0 || size(1) <= 0 || size(2) <= 0; }
  std::int64_t n_nodes() const { return is_empty() ? 0 : size(0) * size(1) * size(2); }
  // Returns the index of node t of the box. The nodes are counted so that i changes fastest.
  GridIndex operator[](std::int64_t t) const {
    return {begin[0] + t % size(0), begin[1] + t / size(0) % size(1), begin[2] + t / size(0) / size(1)};
  }
};

class Grid {
 public:
  typedef std::array<std::vector<double>, 3> Axes;

  // The axes must ascend. The strides must come from checked_strides.
  Grid(Axes axes, std::int64_t first, const GridIndex &stride, std::int64_t n_numbers);

  std::int64_t size(std::int64_t axis) const { return size_[axis]; }
  const double *axis(std::int64_t axis) const { return view(axes_)[axis].data(); }
  std::int64_t stride(std::int64_t axis) const { return stride_[axis]; }
  std::int64_t n_numbers() const { return n_numbers_; }  // some numbers may have no node
  GridBox all() const { return {{0, 0, 0}, size_}; }
  Bounds bounds() const { return {at({0, 0, 0}), at({size(0) - 1, size(1) - 1, size(2) - 1})}; }

  Vec3 at(const GridIndex &index) const { return {axis(0)[index[0]], axis(1)[index[1]], axis(2)[index[2]]}; }
  std::int64_t number(const GridIndex &index) const {
    return first_ + index[0] * stride_[0] + index[1] * stride_[1] + index[2] * stride_[2];
  }
  // Finds the node with the given number. If no node has this number, returns false and the index of the first node.
  bool find(std::int64_t number, GridIndex &index) const {
    std::int64_t rest = number - first_;
    index = {0, 0, 0};
    for (int i = 0; i < n_long_axes_ && rest >= 0; ++i) {
      const int axis = long_axes_[i];
      index[axis] = rest / stride_[axis];
      rest = index[axis] < size_[axis] ? rest - index[axis] * stride_[axis] : -1;
    }
    if (rest != 0) index = {0, 0, 0};
    return rest == 0;
  }
  bool has_node(std::int64_t number) const {
    GridIndex index;
    return find(number, index);
  }
  // Returns the coordinates of the node with the given number. If no node has this number, returns the first node's coordinates.
  Vec3 operator[](std::int64_t number) const {
    GridIndex index;
    find(number, index);
    return at(index);
  }
  // Returns the number of nodes whose numbers are lower than that of the given node.
  std::int64_t rank(const GridIndex &index) const;

  // Returns the nodes whose coordinates lie within the bounds.
  GridBox within(const Bounds &bounds) const;
  // Returns the length of the longest edge between two nodes of a box.
  double longest_edge(const GridBox &box) const;

 private:
  Axes axes_;
  GridIndex size_, stride_;
  std::int64_t first_, n_numbers_;
  // The axes with several nodes. The axis with the largest stride comes first. On an axis with one node, every index is 0.
  int long_axes_[3], n_long_axes_;
};

// Checks that no two nodes have the same number, and returns the strides. Fails with RIIS_INVALID_ARGUMENT or
// RIIS_LIMIT_EXCEEDED.
//   `given`: the strides as the caller gave them; three zeros stand for the default.
//   `n_numbers`: 0 is replaced by the least length.
// The stride of an axis with one node becomes 0.
GridIndex checked_strides(const GridIndex &n, std::int64_t first, const GridIndex &given, std::int64_t &n_numbers);

// The edges of a grid, with the same functions as Adjacency. A number without a node has no edges.
struct GridEdges {
  static constexpr bool is_symmetric = true;

  const Grid &grid;
  std::int64_t n_rows = grid.n_numbers();

  template <class Visit>
  void for_each_neighbor(std::int64_t i, const Visit &visit) const {
    GridIndex index;
    if (!grid.find(i, index)) return;
    for (int axis = 0; axis < 3; ++axis) {
      if (index[axis] > 0) visit(i - grid.stride(axis));
      if (index[axis] + 1 < grid.size(axis)) visit(i + grid.stride(axis));
    }
  }
  // The result is always true, because callers pass only neighbours, and a grid's edges are symmetric.
  bool has_neighbor(std::int64_t, std::int64_t) const { return true; }
};

}  // namespace riis
