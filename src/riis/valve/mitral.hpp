// SPDX-License-Identifier: Apache-2.0
// The mitral valve has an annulus, an anterior leaflet and a posterior leaflet of three scallops. It is closed, open or
// in between (paper, appendix "Parametric modeling of the mitral valve"; docs/theory.md, section 4).
#pragma once

#include "valve/valve.hpp"

namespace riis {

const ValveKind &mitral_valve_kind();

}  // namespace riis
