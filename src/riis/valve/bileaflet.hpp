// SPDX-License-Identifier: Apache-2.0
// The bileaflet mechanical valve: two rigid flat leaflets, each of which turns about its hinge in a round housing
// (docs/theory.md, "The bileaflet valve").
// In: the parameters of two states, the opening. Out: patches of two leaflets and, on request, of the housing's wall.
#pragma once

#include "valve/valve.hpp"

namespace riis {

const ValveKind &bileaflet_valve_kind();

}  // namespace riis
