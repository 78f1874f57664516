// SPDX-License-Identifier: Apache-2.0
// VTK 9.1 renders through X and GLX only and aborts the process where it finds none.
#pragma once

namespace riis::vtk {

// Fails with RIIS_UNAVAILABLE unless the X display that VTK would open is there and has GLX.
void check_display();

}  // namespace riis::vtk
