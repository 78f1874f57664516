// SPDX-License-Identifier: Apache-2.0
// A valve of three equal cusps that closes: free edges meet along straight lines from the commissures to the axis
// (docs/theory.md, section 3).
#pragma once

#include "valve/valve.hpp"

namespace riis {

const ValveKind &trileaflet_valve_kind();

}  // namespace riis
