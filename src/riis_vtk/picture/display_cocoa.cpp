// SPDX-License-Identifier: Apache-2.0
// On macOS, VTK draws by Cocoa, so no connection to a display is held.
#include "riis_vtk/picture/drawing.hpp"

namespace riis::vtk {

HeldDisplay::HeldDisplay() = default;
HeldDisplay::~HeldDisplay() = default;

}  // namespace riis::vtk
