// SPDX-License-Identifier: Apache-2.0
#include "program/finer_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "common/array_view.hpp"

namespace riis::program {

FinerTriangles::FinerTriangles(std::int64_t n_given, std::vector<Triangle> triangles)
    : n_given_(n_given), triangles_(std::move(triangles)) {
  find_edges();
}

double FinerTriangles::longest_edge() const {
  double longest = 0;
  for (const Edge &edge : edges_) longest = std::max(longest, edge.length);
  return longest;
}

void FinerTriangles::append_middles(std::vector<double> &xyz) const {
  xyz.reserve(xyz.size() + 3 * middles_.size());
  for (const Ends &ends : middles_) {
    for (std::int64_t k = 0; k < 3; ++k) xyz.push_back(0.5 * (view(xyz)[3 * ends.a + k] + view(xyz)[3 * ends.b + k]));
  }
}

void FinerTriangles::measure(const std::vector<double> &xyz) {
  const auto at = view(xyz);
  for (Edge &edge : edges_) {
    const std::int64_t a = 3 * edge.ends.a, b = 3 * edge.ends.b;
    edge.length = std::max(edge.length, std::hypot(at[a] - at[b], at[a + 1] - at[b + 1], at[a + 2] - at[b + 2]));
  }
}

bool FinerTriangles::halve_longer(double length) {
  // The middle of each edge, or -1.
  std::vector<std::int64_t> middle;
  for (const Edge &edge : edges_) {
    middle.push_back(edge.length > length ? n_given_ + view(middles_).size() : -1);
    if (edge.length > length) middles_.push_back(edge.ends);
  }
  std::vector<Triangle> cut;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto &[corners, leaflet] = triangles_[i];
    const auto add = [&cut, id = leaflet](std::int64_t a, std::int64_t b, std::int64_t c) {
      cut.push_back({{a, b, c}, id});
    };
    std::array<std::int64_t, 3> middles{};
    std::size_t n_cut = 0, last_cut = 0, whole = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      middles[k] = view(middle)[edge_of(i, k)];
      n_cut += middles[k] >= 0;
      (middles[k] >= 0 ? last_cut : whole) = k;
    }
    if (n_cut == 0) {
      add(corners[0], corners[1], corners[2]);
    } else if (n_cut == 1) {
      const std::size_t k = last_cut, next = (k + 1) % 3, other = (k + 2) % 3;
      add(corners[k], middles[k], corners[other]);
      add(middles[k], corners[next], corners[other]);
    } else if (n_cut == 2) {
      // The edge from a to b stays. A line to the middle of the longer halved edge is the shorter one of the two diagonals.
      const std::size_t k = whole, next = (k + 1) % 3, other = (k + 2) % 3;
      const std::int64_t a = corners[k], b = corners[next], c = corners[other], bc = middles[next], ca = middles[other];
      add(ca, bc, c);
      const bool bc_is_longer = view(edges_)[edge_of(i, next)].length > view(edges_)[edge_of(i, other)].length;
      add(a, b, bc_is_longer ? bc : ca);
      bc_is_longer ? add(a, bc, ca) : add(ca, b, bc);
    } else {
      for (std::size_t k = 0; k < 3; ++k) add(corners[k], middles[k], middles[(k + 2) % 3]);
      add(middles[0], middles[1], middles[2]);
    }
  }
  const bool was_cut = cut.size() > triangles_.size();
  triangles_ = std::move(cut);
  if (was_cut) find_edges();
  return was_cut;
}

void FinerTriangles::find_edges() {
  struct Side {
    Ends ends;
    std::size_t triangle, k;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(triangles_[i].corners[k], triangles_[i].corners[(k + 1) % 3]);
      sides.push_back({{a, b}, i, k});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side &s, const Side &t) { return std::tie(s.ends.a, s.ends.b) < std::tie(t.ends.a, t.ends.b); });
  edges_.clear();
  triangle_edges_.assign(triangles_.size(), {});
  for (const Side &side : sides) {
    const bool is_known = !edges_.empty() && edges_.back().ends.a == side.ends.a && edges_.back().ends.b == side.ends.b;
    if (!is_known) edges_.push_back({side.ends, 0});
    triangle_edges_[side.triangle][side.k] = view(edges_).size() - 1;
  }
}

}  // namespace riis::program
