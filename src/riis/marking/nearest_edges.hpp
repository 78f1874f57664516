// SPDX-License-Identifier: Apache-2.0
// The nearest of the caller's edges to a point. A tree of boxes leaves edges out; what it finds is that of a loop over all edges.
// In: edges, points. Out: an edge for each point, of equally near ones the first.
#pragma once

#include <cstdint>

#include "base/recycled.hpp"
#include "geometry/vec3.hpp"

namespace riis {

struct Edges {
  std::int64_t n = 0;
  const double *ends = nullptr;              // (3, 2, n)
  const std::int32_t *leaflet_id = nullptr;  // (n), or null: an edge is for all leaflets

  Vec3 first(std::int64_t i) const { return {ends[6 * i], ends[6 * i + 1], ends[6 * i + 2]}; }
  Vec3 second(std::int64_t i) const { return {ends[6 * i + 3], ends[6 * i + 4], ends[6 * i + 5]}; }
  Vec3 middle(std::int64_t i) const { return mix(first(i), second(i), 0.5); }
};

// Returns the squared distance from a point to an edge. At an end that two edges share, both give the same bits.
double distance_sq(const Edges &edges, std::int64_t edge, Vec3 point);

// Building takes a time of n log n. A query takes log n where edges lie beside each other, and n where all are equally near.
class NearestEdges {
 public:
  // Borrows the arrays of the edges.
  explicit NearestEdges(const Edges &edges);

  // Returns the nearest edge of those for the leaflet, or -1 without one. Several threads may call this function at once.
  std::int64_t of(std::int32_t leaflet_id, Vec3 point) const;
  bool has(std::int32_t leaflet_id) const { return tree_of(leaflet_id) != nullptr; }

 private:
  // A box around order_[begin] to order_[end - 1]. Its first half is the next box, its second half is box `second`, or it has no
  // parts if that is 0.
  struct Box {
    Vec3 lower, upper;
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
  double rounding_;             // by which boxes are larger
  Vector<std::int64_t> order_;  // edges by leaflet, then so that each box has consecutive ones
  Vector<Box> boxes_;
  Vector<Tree> trees_;  // ascending by leaflet; one if an edge is for all leaflets
};

}  // namespace riis
