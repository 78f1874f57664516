// SPDX-License-Identifier: Apache-2.0
// The arrays that a caller gets from a marking: one entry per node, ascending by node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/array_view.hpp"

namespace riis {

struct NodeList {
  std::vector<std::int64_t> node_id;
  std::vector<double> distance;
  std::vector<std::int64_t> triangle_id;
  std::vector<std::int32_t> leaflet_id;

  std::size_t size() const { return node_id.size(); }
  // Reserves half as much again: a moving valve would otherwise need more memory at every new largest number of nodes.
  void reserve(std::size_t n) {
    if (n <= node_id.capacity() && n <= leaflet_id.capacity()) return;
    n += n / 2;
    node_id.reserve(n);
    distance.reserve(n);
    triangle_id.reserve(n);
    leaflet_id.reserve(n);
  }
  // Does not throw after reserve(n).
  void resize(std::size_t n) {
    node_id.resize(n);
    distance.resize(n);
    triangle_id.resize(n);
    leaflet_id.resize(n);
  }
  void set(std::int64_t i, std::int64_t node, double node_distance, std::int64_t triangle, std::int32_t leaflet) {
    view(node_id)[i] = node;
    view(distance)[i] = node_distance;
    view(triangle_id)[i] = triangle;
    view(leaflet_id)[i] = leaflet;
  }
};

}  // namespace riis
