// SPDX-License-Identifier: Apache-2.0
// The coaptation of leaflets: the parts of them that lie within a distance of another leaflet.
// In: triangles, free edges, a distance. Out: areas and lengths.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "scene/edges.hpp"

namespace riis {

struct Contact {
  double area, edge;
};

// Returns the contact of each leaflet. A point of a leaflet is in contact if another leaflet is within `reach` of it. `parts` has
// the free edges. The leaflets of `omitted` count as touching nothing. `wanted` is a leaflet, or RIIS_ALL_LEAFLETS.
std::map<std::int32_t, Contact> contacts_of(const TriangleSet &set, const std::vector<EdgePart> &parts, double reach,
                                            std::int32_t wanted, const std::vector<std::int32_t> &omitted,
                                            int n_threads);

}  // namespace riis
