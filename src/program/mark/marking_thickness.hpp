// SPDX-License-Identifier: Apache-2.0
// Tells which half thickness marks a node, as the library orders the nodes of a passage (docs/theory/marks.md, "Offset").
// In: a surface, and the nodes of a marking. Out: the least half thickness that marks each node.
#pragma once

#include <riis/riis.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "common/band.hpp"

namespace riis::program {

class MarkingThickness {
 public:
  // The surface must outlive this object, and must not change.
  explicit MarkingThickness(const riis_surface *surface);

  const Band &band() const { return band_; }
  // Returns the fields that the marking needs. There are none without an offset.
  std::int32_t fields() const;
  // Returns the least half thickness that marks node i of the list. Without an offset, this is its distance. `node` has the
  // node's coordinates.
  double of(const riis_mark_list &list, std::int64_t i, const double *node) const;

 private:
  using Vector = std::array<double, 3>;
  // The places of both ends of an edge, in ascending order. A vertex has its own place twice.
  using Feature = std::array<std::int64_t, 2>;

  Feature feature(std::int64_t a, std::int64_t b) const;
  void add_normals(std::int64_t triangle);
  Vector normal_at(const riis_mark_list &list, std::int64_t i) const;

  Band band_;
  riis_triangles triangles_;
  std::vector<std::int64_t> place_;   // of each vertex; vertices with equal coordinates have one place
  std::map<Feature, Vector> normal_;  // sums of unit normals, at vertices with the triangles' angles as weights
};

}  // namespace riis::program
