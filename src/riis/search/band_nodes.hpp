// SPDX-License-Identifier: Apache-2.0
// The nodes of a band that steps aside: which of the found nodes it holds, and which half thickness marks a node.
// In: a surface with an offset, nodes with their closest triangles. Out: the nodes in the band.
#pragma once

#include "search/search.hpp"

namespace riis {

// Removes the nodes outside the band from the lists. The surface must have an offset. Ties of removed nodes stay.
void keep_in_band(const SearchRequest &request, const Band &band, FoundNodes &found);

// The least half thickness that marks a node, and the node's place.
struct NodePlace {
  double half_thickness;
  int side;
  bool is_beyond_rim;
};

// Places nodes of a request, at any distance from the surface. Several threads may use it at once.
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
