// SPDX-License-Identifier: Apache-2.0
// Finds the leaflet of each nadir, and the two leaflets beside each commissure, from the order of landmarks around a valve's
// axis. Some landmarks may name their leaflets. The result is the landmarks in the order of the leaflets.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "landmarks/landmarks.hpp"

namespace riis {

// The leaflets of a kind, counter-clockwise seen from +z.
struct LeafletsAround {
  std::vector<std::string> names;  // in the order of leaflet ids
  const char *seen_along_flow;     // the direction from leaflet to leaflet: "clockwise" if blood flows along +z
  // The end of a message that asks for names. Null if the leaflets need no names, because leaflet 0 is then at the first nadir.
  const char *why_names;

  std::size_t n() const { return names.size(); }
  std::size_t next(std::size_t leaflet) const { return (leaflet + 1) % n(); }
};

// The landmarks of each leaflet.
struct Order {
  std::vector<std::size_t> nadir;       // empty for a kind without nadirs
  std::vector<std::size_t> commissure;  // between a leaflet and the next leaflet
};

// Refuses ids that no leaflet has, and more or fewer ids than a landmark's role needs.
void check_leaflet_ids(const Landmarks &landmarks, const LeafletsAround &leaflets);

// Returns whether the names fit the order around the axis, which points along z.
bool names_fit(const Landmarks &landmarks, const LeafletsAround &leaflets, Vec3 axis, Vec3 middle);

// Returns the order around the axis. There must be as many commissures as leaflets, and as many nadirs as leaflets or none.
// Refuses commissures and nadirs that do not alternate, and names that contradict the order.
Order order_around(const Landmarks &landmarks, const LeafletsAround &leaflets, Vec3 axis, Vec3 middle);

}  // namespace riis
