// SPDX-License-Identifier: Apache-2.0
// VTK 9.1 renders only through X and GLX, and aborts the process where it finds neither.
#pragma once

struct _XDisplay;

namespace riis::vtk {

// A connection to the X display that VTK would open, held while VTK draws. A server without clients resets itself and refuses
// connections meanwhile.
class HeldDisplay {
 public:
  // Fails with RIIS_UNAVAILABLE unless the display is there and has GLX.
  HeldDisplay();
  ~HeldDisplay();
  HeldDisplay(const HeldDisplay &) = delete;
  HeldDisplay &operator=(const HeldDisplay &) = delete;

 private:
  _XDisplay *display_;
};

}  // namespace riis::vtk
