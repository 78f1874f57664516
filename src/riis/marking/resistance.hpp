// SPDX-License-Identifier: Apache-2.0
// The resistive term of the momentum equation and the sums over it (paper, eq. "RIIS"; docs/theory.md, "Resistance").
// In: the nodes within the limit, with their fields. Out: sums over these nodes, added to the caller's arrays.
#pragma once

#include <riis/riis.h>

#include "marking/marks.hpp"

namespace riis {

// The checked numbers of a riis_resistance. Every K is at a node within the half thickness.
struct Resistance {
  double factor;          // R / eps
  double half_thickness;  // eps
  bool cuts_rim;
};

// Checks a resistance, the argument `name`, for a marking with these lengths.
Resistance checked_resistance(const riis_resistance &resistance, const char *name, double half_thickness,
                              double distance_limit);
// Makes K and K u_surface of the nodes of a list, which has their fields and room for both. Null stands for no resistance.
void list_resistance(const Resistance *resistance, const WantedData &data, const Threads &n_threads, ListedNodes &list);

// All fail with RIIS_INVALID_ARGUMENT if the marks lack data that they need.
Resistance checked_resistance(const riis_resistance &resistance, const Marks &marks);
void add_resistance(const Marks &marks, const Resistance &resistance, const riis_resistance_arrays &to);
// Also fails for edges or leaflets that do not fit. Nothing is added then.
void add_reaction(const Marks &marks, const Resistance &resistance, const riis_flow_arrays &flow,
                  const riis_reaction &to);
riis_band_sums band_sums(const Marks &marks, const riis_band &band);

}  // namespace riis
