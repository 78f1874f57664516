// SPDX-License-Identifier: Apache-2.0
#include "marking/mark_result.hpp"

namespace riis {

void NodeList::reserve(std::size_t n) {
  node_id.reserve(n);
  distance.reserve(n);
  triangle_id.reserve(n);
  leaflet_id.reserve(n);
}

void NodeList::resize(std::size_t n) {
  node_id.resize(n);
  distance.resize(n);
  triangle_id.resize(n);
  leaflet_id.resize(n);
}

void NodeList::set(std::size_t i, std::int64_t node, double node_distance, std::int64_t triangle,
                   std::int32_t leaflet) {
  node_id[i] = node;
  distance[i] = node_distance;
  triangle_id[i] = triangle;
  leaflet_id[i] = leaflet;
}

}  // namespace riis
