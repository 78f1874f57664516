// SPDX-License-Identifier: Apache-2.0
// Finds the leaflet of each nadir, and the two leaflets beside each commissure, from the order of landmarks around a valve's
// axis. A landmark may name its leaflets, but need not. The result lists the landmarks in the order of the leaflets.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "landmarks/landmarks.hpp"

namespace riis {

// The leaflets of a kind of valve, in counter-clockwise order seen from +z.
struct LeafletsAround {
  std::vector<std::string> names;  // in the order of leaflet ids
  const char *seen_along_flow;     // the direction from leaflet to leaflet: "clockwise" if blood flows along +z
  // The end of a message that asks for names. The pointer is null if no names are needed, because the first nadir then belongs to
  // leaflet 0.
  const char *why_names;

  std::size_t n() const { return names.size(); }
  std::size_t next(std::size_t leaflet) const { return (leaflet + 1) % n(); }
};

// The landmarks of each leaflet.
struct Order {
  std::vector<std::size_t> nadir;       // empty for a kind without nadirs
  std::vector<std::size_t> commissure;  // between a leaflet and the next leaflet
};

// Refuses ids that no leaflet has. Also refuses a landmark with more or fewer ids than its role needs.
void check_leaflet_ids(const Landmarks &landmarks, const LeafletsAround &leaflets);

// Returns whether the names fit the order around the axis, which points along z.
bool names_fit(const Landmarks &landmarks, const LeafletsAround &leaflets, Vec3 axis, Vec3 middle);

// Returns the order around the axis. The number of commissures must equal the number of leaflets. The number of nadirs must be
// the same, or 0. Refuses commissures and nadirs that do not alternate, and names that contradict the order.
Order order_around(const Landmarks &landmarks, const LeafletsAround &leaflets, Vec3 axis, Vec3 middle);

}  // namespace riis
