// SPDX-License-Identifier: Apache-2.0
#include "mesh/grid.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"

namespace riis {
namespace {

// Numbers are stored in 40 bits (FoundNode).
constexpr std::int64_t most_numbers = std::int64_t{1} << 40;

// Lists the axes with several nodes, the axis with the largest stride first. Returns the number of these axes.
int list_long_axes(const GridIndex &n, const GridIndex &stride, int (&axes)[3]) {
  int n_axes = 0;
  for (int axis = 2; axis >= 0; --axis)
    if (n[axis] > 1) axes[n_axes++] = axis;
  std::stable_sort(axes, axes + n_axes, [&](int a, int b) { return stride[a] > stride[b]; });
  return n_axes;
}

}  // namespace

Grid::Grid(Axes axes, std::int64_t first, const GridIndex &stride, std::int64_t n_numbers)
    : axes_(std::move(axes)),
      size_{view(axes_[0]).size(), view(axes_[1]).size(), view(axes_[2]).size()},
      stride_(stride),
      first_(first),
      n_numbers_(n_numbers),
      n_long_axes_(list_long_axes(size_, stride_, long_axes_)) {}

std::int64_t Grid::rank(const GridIndex &index) const {
  std::int64_t rank = 0;
  for (int i = 0; i < n_long_axes_; ++i) rank = rank * size_[long_axes_[i]] + index[long_axes_[i]];
  return rank;
}

GridBox Grid::within(const Bounds &bounds) const {
  GridBox box;
  const double lower[3] = {bounds.lower.x, bounds.lower.y, bounds.lower.z};
  const double upper[3] = {bounds.upper.x, bounds.upper.y, bounds.upper.z};
  for (int i = 0; i < 3; ++i) {
    const double *const x = axis(i), *const end = x + size(i);
    box.begin[i] = std::lower_bound(x, end, lower[i]) - x;
    box.end[i] = std::upper_bound(x, end, upper[i]) - x;
  }
  return box;
}

double Grid::longest_edge(const GridBox &box) const {
  double longest = 0;
  for (int i = 0; i < 3; ++i)
    for (std::int64_t k = box.begin[i]; k + 1 < box.end[i]; ++k)
      longest = std::max(longest, axis(i)[k + 1] - axis(i)[k]);
  return longest;
}

GridIndex checked_strides(const GridIndex &n, std::int64_t first, const GridIndex &given, std::int64_t &n_numbers) {
  if (first < 0 || first >= most_numbers)
    fail(first < 0 ? RIIS_INVALID_ARGUMENT : RIIS_LIMIT_EXCEEDED, "grid.first is ", first, "; it must be from 0 to ",
         most_numbers - 1);
  GridIndex stride = given;
  const bool is_default = given[0] == 0 && given[1] == 0 && given[2] == 0;
  std::int64_t last = first, n_nodes = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (is_default) stride[axis] = n_nodes;
    if (stride[axis] < 1)
      fail(RIIS_INVALID_ARGUMENT, "grid.stride[", axis, "] is ", stride[axis], "; it must be at least 1");
    // The factors are compared before they are multiplied, because the product may overflow.
    if (n[axis] > 1 && stride[axis] > (most_numbers - 1 - last) / (n[axis] - 1))
      fail(RIIS_LIMIT_EXCEEDED, "grid.stride[", axis, "] is ", stride[axis], ", so ", n[axis],
           " nodes along this axis exceed the limit of ", most_numbers, " numbers");
    if (n[axis] == 1) stride[axis] = 0;
    last += (n[axis] - 1) * stride[axis];
    if (is_default) n_nodes *= n[axis];
  }
  int axes[3];
  std::int64_t way = 0;  // the way from the first to the last node along the axes with smaller strides
  for (int i = list_long_axes(n, stride, axes) - 1; i >= 0; --i) {
    const int axis = axes[i];
    if (stride[axis] <= way)
      fail(RIIS_INVALID_ARGUMENT, "grid.stride[", axis, "] is ", stride[axis], "; it must be above ", way,
           ", because the nodes along the axes with smaller strides take that many numbers");
    way += (n[axis] - 1) * stride[axis];
  }
  if (n_numbers == 0) n_numbers = last + 1;
  if (n_numbers <= last)
    fail(RIIS_INVALID_ARGUMENT, "grid.n_nodes is ", n_numbers, "; the last node has the number ", last);
  if (n_numbers > most_numbers)
    fail(RIIS_LIMIT_EXCEEDED, "grid.n_nodes is ", n_numbers, "; it must be at most ", most_numbers);
  return stride;
}

}  // namespace riis
