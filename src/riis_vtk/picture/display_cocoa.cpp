// SPDX-License-Identifier: Apache-2.0
// VTK draws by Cocoa on macOS, without a connection that could be held.
#include "riis_vtk/picture/drawing.hpp"

namespace riis::vtk {

HeldDisplay::HeldDisplay() = default;
HeldDisplay::~HeldDisplay() = default;

}  // namespace riis::vtk
