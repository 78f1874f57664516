// SPDX-License-Identifier: Apache-2.0
#include "program/uris_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/array_view.hpp"

namespace riis::program {
namespace {

// The share by which the solver widens its box, and the end of its pressure bands in half thicknesses. The factor keeps a node at
// the very end inside.
constexpr double solver_share = 0.1, end_of_bands = 5 * (1 + 1e-6);

struct Side {
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  double middle() const { return (lower + upper) / 2; }
};

std::array<Side, 3> box_of(const std::vector<Corners> &triangles, const std::vector<double> &xyz) {
  std::array<Side, 3> box;
  for (const Corners &corners : triangles)
    for (const std::int64_t vertex : corners)
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = view(xyz)[3 * vertex + static_cast<std::int64_t>(k)];
        box[k].lower = std::min(box[k].lower, x);
        box[k].upper = std::max(box[k].upper, x);
      }
  return box;
}

double sum_of(const Corners &corners, const std::vector<double> &xyz, std::size_t k) {
  double sum = 0;
  for (const std::int64_t vertex : corners) sum += view(xyz)[3 * vertex + static_cast<std::int64_t>(k)];
  return sum;
}

}  // namespace

double uris_grid(double largest) {
  constexpr int free_bits = 7;
  return std::ldexp(1, std::ilogb(largest) + 1 + free_bits - std::numeric_limits<double>::digits);
}

UrisBox::UrisBox(std::vector<Corners> triangles, const std::vector<double> &first, const std::vector<double> &last,
                 double half_thickness, double grid)
    : triangles_(std::move(triangles)), half_thickness_(half_thickness), grid_(grid) {
  const std::array<Side, 3> at_first = box_of(triangles_, first), at_last = box_of(triangles_, last);
  for (std::size_t k = 0; k < 3; ++k) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const double off = std::max(std::abs(sum_of(triangles_[i], first, k) / 3 - at_first[k].middle()),
                                  std::abs(sum_of(triangles_[i], last, k) / 3 - at_last[k].middle()));
      if (!(off < least)) continue;
      least = off;
      chosen_[k] = i;
    }
  }
}

void UrisBox::append_nodes(std::vector<double> &xyz) const {
  const std::array<Side, 3> box = box_of(triangles_, xyz);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double nodes[3][3];  // [corner][coordinate]
    for (std::size_t k = 0; k < 3; ++k) {
      const double sum = sum_of(triangles_[chosen_[axis]], xyz, k), middle = sum / 3;
      const double half = (box[k].upper - box[k].lower) / 2,
                   wanted = std::max(half, (half + end_of_bands * half_thickness_) / (1 + 2 * solver_share));
      // Along its axis the triangle reaches equally far to both sides. Across the axis it has a width, for its area.
      const double reach = wanted + std::abs(middle - box[k].middle());
      const bool is_along = k == axis, is_across = k == (axis + 1) % 3;
      const double offsets[2] = {is_along    ? reach
                                 : is_across ? half_thickness_
                                             : 0,
                                 is_along    ? -reach
                                 : is_across ? half_thickness_
                                             : 0};
      for (std::size_t c = 0; c < 2; ++c) nodes[c][k] = std::nearbyint((middle + offsets[c]) / grid_) * grid_;
      nodes[2][k] = sum - nodes[0][k] - nodes[1][k];
    }
    for (const auto &node : nodes) xyz.insert(xyz.end(), node, node + 3);
  }
}

}  // namespace riis::program
