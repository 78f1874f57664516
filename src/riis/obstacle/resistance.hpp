// SPDX-License-Identifier: Apache-2.0
// Computes the resistive term of the momentum equation and its sums (paper, eq. "RIIS"; docs/theory/marks.md, "Resistance"). The
// term at each node within the limit is added to the caller's arrays, and so are the sums.
#pragma once

#include <riis/riis.h>

#include "marks/marks.hpp"

namespace riis {

// The checked numbers of a riis_resistance. K is above 0 only at nodes in the band.
struct Resistance {
  double factor;  // R / eps
  Band band;      // eps and the surface's offset
  bool cuts_rim;
};

// Checks the argument `name`, a resistance, for a marking with this band and this distance limit.
Resistance checked_resistance(const riis_resistance &resistance, const char *name, const Band &band,
                              double distance_limit);
// Computes K and K u_surface at the nodes of the list, and stores both in the list. The fields of the nodes are already in the
// list. `resistance` is null if `data` requests neither K nor K u_surface.
void list_resistance(const Resistance *resistance, const WantedData &data, const Threads &n_threads, ListedNodes &list);

// Each of the next five functions fails with RIIS_INVALID_ARGUMENT if the marks lack data that it needs.
Resistance checked_resistance(const riis_resistance &resistance, const Marks &marks);
void add_resistance(const Marks &marks, const Resistance &resistance, const riis_resistance_arrays &to);
// Adds the flow's force on the surface, and its moments. Also fails if the reaction's edges or n_leaflets do not fit the surface.
// After such a failure, nothing has been added.
void add_reaction(const Marks &marks, const Resistance &resistance, const riis_flow_arrays &flow,
                  const riis_reaction &to);
// Adds the flow's force on each vertex of the triangles with which the nodes were marked. Also fails if the triangles lack the
// closest triangle of a node.
void add_vertex_reaction(const Marks &marks, const TriangleSet &triangles, const Resistance &resistance,
                         const riis_flow_arrays &flow, double *vertex_force);
// Sums a value of the caller over the nodes of the band, separately for each side of the surface. Nodes beyond a rim are left
// out.
riis_band_sums band_sums(const Marks &marks, const riis_band &band);

}  // namespace riis
