// SPDX-License-Identifier: Apache-2.0
#include "vtk/display.hpp"

#include <X11/Xlib.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

constexpr const char *advice = "; on a machine without one, run the program by: xvfb-run -a PROGRAM";

struct CloseDisplay {
  void operator()(Display *display) const { XCloseDisplay(display); }
};

}  // namespace

void check_display() {
  const char *name = std::getenv("DISPLAY");
  if (!name || !*name) fail(RIIS_UNAVAILABLE, std::string("a picture needs an X display: DISPLAY is not set") + advice);
  const std::unique_ptr<Display, CloseDisplay> display(XOpenDisplay(nullptr));
  if (!display) {
    fail(RIIS_UNAVAILABLE, std::string("a picture needs an X display: DISPLAY ") + name + " cannot be opened" + advice);
  }
  int opcode = 0, event = 0, error = 0;
  if (!XQueryExtension(display.get(), "GLX", &opcode, &event, &error)) {
    fail(RIIS_UNAVAILABLE, std::string("a picture needs OpenGL: DISPLAY ") + name + " has no GLX extension" + advice);
  }
}

}  // namespace riis::vtk
