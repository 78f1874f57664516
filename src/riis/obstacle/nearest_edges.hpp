// SPDX-License-Identifier: Apache-2.0
// Finds the caller's edge that is nearest to a point. A tree of boxes skips distant edges. The result is the same as that of a
// loop over all edges. If several edges are equally near to a point, the result is the first of these edges.
#pragma once

#include <cstdint>

#include "base/recycled.hpp"
#include "geometry/vec3.hpp"

namespace riis {

struct Edges {
  std::int64_t n = 0;
  const double *ends = nullptr;              // (3, 2, n)
  const std::int32_t *leaflet_id = nullptr;  // (n), or null if each edge belongs to all leaflets

  Vec3 first(std::int64_t i) const { return {ends[6 * i], ends[6 * i + 1], ends[6 * i + 2]}; }
  Vec3 second(std::int64_t i) const { return {ends[6 * i + 3], ends[6 * i + 4], ends[6 * i + 5]}; }
  Vec3 middle(std::int64_t i) const { return mix(first(i), second(i), 0.5); }
};

// Checks the caller's edges and borrows their arrays. There must be at least one edge. `owner` is the name of the caller's
// argument that contains the edges.
Edges checked_edges(const char *owner, std::int64_t n, const double *ends, const std::int32_t *leaflet_id);

// Returns the squared distance from a point to an edge. If two edges share an end that is their nearest point, both give the same
// bits.
double distance_sq(const Edges &edges, std::int64_t edge, Vec3 point);

// Building the trees of n edges takes a time of order n log n. A query usually takes a time of order log n. If all edges are
// equally near, a query takes a time of order n.
class NearestEdges {
 public:
  // Borrows the arrays of the edges.
  explicit NearestEdges(const Edges &edges);

  // Returns the nearest edge of the leaflet, or -1 if the leaflet has no edge. Several threads may call this function at once.
  std::int64_t of(std::int32_t leaflet_id, Vec3 point) const;
  bool has(std::int32_t leaflet_id) const { return tree_of(leaflet_id) != nullptr; }

 private:
  // A box around the edges order_[begin] to order_[end - 1]. If `second` is 0, the box is not split. Otherwise the next box of
  // boxes_ holds the first half of the edges, and boxes_[second] holds the second half.
  struct Box {
    Bounds bounds;
    std::int64_t begin, end, second;
  };
  struct Tree {
    std::int32_t leaflet_id;
    std::int64_t root;
  };

  void add(std::int64_t begin, std::int64_t end);
  Box box_around(std::int64_t begin, std::int64_t end) const;
  const Tree *tree_of(std::int32_t leaflet_id) const;

  Edges edges_;
  double rounding_;             // the margin of each box around its edges
  Vector<std::int64_t> order_;  // the edges in the order of leaflets; the edges of a box are consecutive
  Vector<Box> boxes_;
  Vector<Tree> trees_;  // ascending by leaflet; a single tree if each edge belongs to all leaflets
};

}  // namespace riis
