// SPDX-License-Identifier: Apache-2.0
// A virtual X display for pictures on a machine without a screen. The program Xvfb makes the display. Xvfb is in Debian's package
// xvfb.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace riis::program {

// Throws a Refusal that names Debian's package if Xvfb is not on the PATH.
void check_virtual_display();

// Starts Xvfb, and puts the display into the variables DISPLAY and XAUTHORITY. Only this process knows the key of the display.
// Xvfb ends with this object. Xvfb also ends if the thread that made the object ends for any reason. Each run of the program has
// a separate display.
class VirtualDisplay {
 public:
  // Throws a Refusal if Xvfb is missing, ends early, or is not ready in time.
  VirtualDisplay();
  // Restores the former values of DISPLAY and XAUTHORITY.
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay &) = delete;
  VirtualDisplay &operator=(const VirtualDisplay &) = delete;

 private:
  [[maybe_unused]] pid_t process_ = -1;  // not used on macOS, like key_
  [[maybe_unused]] int key_ = -1;        // a file in memory
  std::optional<std::string> display_before_, key_before_;
};

}  // namespace riis::program
