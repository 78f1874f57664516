// SPDX-License-Identifier: Apache-2.0
// Finds where single nodes are relative to a band with an offset. For a point at any distance from a surface, this file finds the
// least half thickness that marks the point, and the point's side.
#pragma once

#include "search/search.hpp"

namespace riis {

// The least half thickness that marks a node, and the node's place.
struct NodePlace {
  double half_thickness;
  int side;
  bool is_beyond_rim;
};

// Finds the places of nodes of a request, at any distance from the surface. Several threads may use one object at once.
class NodePlaces {
 public:
  explicit NodePlaces(const SearchRequest &request);
  // Returns the place of a point. Without an offset, the half thickness is the distance, and the side is 0.
  NodePlace of(Vec3 p) const;

 private:
  const SearchRequest &request_;
  const Pseudonormals *normals_;  // null without an offset
};

}  // namespace riis
