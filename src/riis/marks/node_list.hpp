// SPDX-License-Identifier: Apache-2.0
// The arrays that a caller gets from a marking. They have one entry for each node, in ascending order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/array_view.hpp"

namespace riis {

// Makes room for n elements. If it has to reserve memory, it reserves half as much again. Without this surplus, a moving valve
// would need new memory each time its number of nodes reaches a new maximum.
template <class Array>
void reserve_amply(Array &array, std::int64_t n) {
  const auto needed = static_cast<std::size_t>(n);
  if (needed > array.capacity()) array.reserve(needed + needed / 2);
}

// Returns whether resize(n) keeps the array at its address.
template <class Array>
bool has_room(const Array &array, std::int64_t n) {
  return static_cast<std::size_t>(n) <= array.capacity();
}

struct NodeList {
  std::vector<std::int64_t> node_id;
  std::vector<double> distance;
  std::vector<std::int64_t> triangle_id;
  std::vector<std::int32_t> leaflet_id;

  std::int64_t size() const { return view(node_id).size(); }
  bool has_room(std::int64_t n) const {
    return riis::has_room(node_id, n) && riis::has_room(distance, n) && riis::has_room(triangle_id, n) &&
           riis::has_room(leaflet_id, n);
  }
  void reserve(std::int64_t n) {
    reserve_amply(node_id, n);
    reserve_amply(distance, n);
    reserve_amply(triangle_id, n);
    reserve_amply(leaflet_id, n);
  }
  // Sets the number of entries. Does not throw if reserve(n) was called before.
  void resize(std::int64_t n) {
    riis::resize(node_id, n);
    riis::resize(distance, n);
    riis::resize(triangle_id, n);
    riis::resize(leaflet_id, n);
  }
  void set(std::int64_t i, std::int64_t node, double node_distance, std::int64_t triangle, std::int32_t leaflet) {
    view(node_id)[i] = node;
    view(distance)[i] = node_distance;
    view(triangle_id)[i] = triangle;
    view(leaflet_id)[i] = leaflet;
  }
};

}  // namespace riis
