// SPDX-License-Identifier: Apache-2.0
// The aortic valve has three cusps of four patches each (paper, 2.1 and table "Aortic valve parameters"; docs/theory.md).
#pragma once

#include "valve/valve.hpp"

namespace riis {

const ValveKind &aortic_valve_kind();

}  // namespace riis
