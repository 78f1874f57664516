// SPDX-License-Identifier: Apache-2.0
// The resistive term of the momentum equation and the sums over it (paper, eq. "RIIS"; docs/theory.md, "Resistance").
// In: the nodes within the limit, with their fields. Out: sums over these nodes, added to the caller's arrays.
#pragma once

#include <riis/riis.h>

#include "marking/mark_result.hpp"

namespace riis {

// The checked numbers of a riis_resistance. Every K is at a node within the half thickness.
struct Resistance {
  double factor;          // R / eps
  double half_thickness;  // eps
  bool cuts_rim;
};

// All fail with RIIS_INVALID_ARGUMENT if the result lacks data that they need.
Resistance checked_resistance(const riis_resistance &resistance, const MarkResult &result);
void add_resistance(const MarkResult &result, const Resistance &resistance, double *coefficient, double *momentum);
void add_reaction(const MarkResult &result, const Resistance &resistance, const double *velocity, const double *weight,
                  double *force);
riis_band_sums band_sums(const MarkResult &result, double inner, double outer, const double *value,
                         const double *weight);

}  // namespace riis
