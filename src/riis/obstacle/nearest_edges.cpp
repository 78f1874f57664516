// SPDX-License-Identifier: Apache-2.0
#include "obstacle/nearest_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "common/array_view.hpp"

namespace riis {
namespace {

constexpr std::int64_t edges_per_box = 4;

double largest_coordinate(const Edges &edges) {
  double largest = 0;
  for (std::int64_t i = 0; i < 6 * edges.n; ++i) largest = std::max(largest, std::abs(edges.ends[i]));
  return largest;
}

// Returns the coordinate along which the box is longest.
double Vec3::*longest_axis(Vec3 extent) {
  if (extent.x >= extent.y && extent.x >= extent.z) return &Vec3::x;
  return extent.y >= extent.z ? &Vec3::y : &Vec3::z;
}

}  // namespace

Edges checked_edges(const char *owner, std::int64_t n, const double *ends, const std::int32_t *leaflet_id) {
  if (!ends) fail(RIIS_INVALID_ARGUMENT, owner, ".edges is NULL");
  for (std::int64_t i = 0; i < 6 * n; ++i)
    if (!(std::abs(ends[i]) <= 1e60))
      fail(RIIS_INVALID_ARGUMENT, owner, ".edges: ", "xyz"[i % 3], " of the ", i / 3 % 2 == 0 ? "first" : "second",
           " point of edge ", i / 6, " is ", ends[i], "; it must be finite, of magnitude at most 1e+60");
  for (std::int64_t i = 0; leaflet_id && i < n; ++i)
    if (leaflet_id[i] < 0)
      fail(RIIS_INVALID_ARGUMENT, owner, ".edge_leaflet_id of edge ", i, " is ", leaflet_id[i],
           "; it must be at least 0");
  return {n, ends, leaflet_id};
}

double distance_sq(const Edges &edges, std::int64_t edge, Vec3 point) {
  const Vec3 a = edges.first(edge), b = edges.second(edge), along = b - a;
  const double at = dot(point - a, along), whole = dot(along, along);
  const Vec3 nearest = at <= 0 ? a : at >= whole ? b : a + (at / whole) * along;
  return dot(point - nearest, point - nearest);
}

NearestEdges::NearestEdges(const Edges &edges) : edges_(edges), rounding_(1e-15 * largest_coordinate(edges)) {
  resize(order_, edges.n);
  for (std::int64_t i = 0; i < edges.n; ++i) view(order_)[i] = i;
  const auto leaflet_of = [&](std::int64_t edge) { return edges.leaflet_id ? edges.leaflet_id[edge] : 0; };
  std::sort(order_.begin(), order_.end(), [&](std::int64_t a, std::int64_t b) {
    return leaflet_of(a) != leaflet_of(b) ? leaflet_of(a) < leaflet_of(b) : a < b;
  });
  for (std::int64_t begin = 0; begin < edges.n;) {
    const std::int32_t leaflet = leaflet_of(view(order_)[begin]);
    std::int64_t end = begin;
    while (end < edges.n && leaflet_of(view(order_)[end]) == leaflet) ++end;
    trees_.push_back({leaflet, view(boxes_).size()});
    add(begin, end);
    begin = end;
  }
}

NearestEdges::Box NearestEdges::box_around(std::int64_t begin, std::int64_t end) const {
  Bounds bounds;
  for (std::int64_t k = begin; k < end; ++k) {
    bounds.add(edges_.first(view(order_)[k]));
    bounds.add(edges_.second(view(order_)[k]));
  }
  const Vec3 margin{rounding_, rounding_, rounding_};
  return {{bounds.lower - margin, bounds.upper + margin}, begin, end, 0};
}

// Adds the boxes of order_[begin] to order_[end - 1]. A box with more than a few edges is split into two boxes. The middle of an
// edge decides to which of these boxes the edge belongs.
void NearestEdges::add(std::int64_t begin, std::int64_t end) {
  const std::int64_t own = view(boxes_).size();
  boxes_.push_back(box_around(begin, end));
  if (end - begin <= edges_per_box) return;
  const std::int64_t half = begin + (end - begin) / 2;
  double Vec3::*const axis = longest_axis(view(boxes_)[own].bounds.upper - view(boxes_)[own].bounds.lower);
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::int64_t a, std::int64_t b) {
                     const double at_a = edges_.middle(a).*axis, at_b = edges_.middle(b).*axis;
                     return at_a != at_b ? at_a < at_b : a < b;
                   });
  add(begin, half);
  view(boxes_)[own].second = view(boxes_).size();
  add(half, end);
}

const NearestEdges::Tree *NearestEdges::tree_of(std::int32_t leaflet_id) const {
  if (!edges_.leaflet_id) return trees_.empty() ? nullptr : trees_.data();
  const auto found = std::lower_bound(trees_.begin(), trees_.end(), leaflet_id,
                                      [](const Tree &tree, std::int32_t id) { return tree.leaflet_id < id; });
  return found != trees_.end() && found->leaflet_id == leaflet_id ? &*found : nullptr;
}

std::int64_t NearestEdges::of(std::int32_t leaflet_id, Vec3 point) const {
  const Tree *tree = tree_of(leaflet_id);
  if (!tree) return -1;
  double least = std::numeric_limits<double>::infinity();
  std::int64_t nearest = -1;
  // Rounding may make a box seem slightly farther than an edge inside it. The bound is therefore made slightly smaller. The
  // search thus never skips a box with an edge that is as near as the nearest edge so far.
  const auto bound = [&](std::int64_t box) { return (1 - 1e-12) * view(boxes_)[box].bounds.distance_sq_to(point); };
  std::array<std::int64_t, 64> open;  // boxes still to be visited: at most one on each of fewer than 64 levels
  std::size_t n_open = 0;
  open[n_open++] = tree->root;
  while (n_open > 0) {
    const std::int64_t at = open[--n_open];
    if (bound(at) > least) continue;
    const Box &box = view(boxes_)[at];
    if (box.second != 0) {
      const bool first_is_nearer = bound(at + 1) <= bound(box.second);
      open[n_open++] = first_is_nearer ? box.second : at + 1;
      open[n_open++] = first_is_nearer ? at + 1 : box.second;
      continue;
    }
    for (std::int64_t k = box.begin; k < box.end; ++k) {
      const std::int64_t edge = view(order_)[k];
      const double here = distance_sq(edges_, edge, point);
      if (here < least || (here == least && edge < nearest)) least = here, nearest = edge;
    }
  }
  return nearest;
}

}  // namespace riis
