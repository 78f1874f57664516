// SPDX-License-Identifier: Apache-2.0
// Opens the X display. The code is in a separate file, because X11's headers define macros with names that VTK's headers use.
#include <chrono>
#include <cstdlib>
#include <thread>

#include "riis_vtk/base/vtk_errors.hpp"
#include "riis_vtk/picture/drawing.hpp"

#include <X11/Xlib.h>
#include <dlfcn.h>

namespace riis::vtk {
namespace {

constexpr const char *advice = "; on a machine without one, run the program by: xvfb-run -a PROGRAM";

// Tries several times, because the X server resets itself after a picture and refuses connections meanwhile. A display on another
// machine is tried only once, because its refusal may take minutes.
Display *open_display() {
  using std::chrono::milliseconds;
  const auto end = std::chrono::steady_clock::now() + milliseconds(450);
  for (;;) {
    Display *display = XOpenDisplay(nullptr);
    if (display || std::chrono::steady_clock::now() > end) return display;
    std::this_thread::sleep_for(milliseconds(100));
  }
}

// Returns whether VTK's OpenGL can draw on the display. Whether VTK can draw depends on the OpenGL library in use. Some
// libraries, such as the one in the program's archive, draw by X alone and do not need the server's extension GLX. VTK has
// already loaded the OpenGL library before the call.
bool has_opengl(Display *display) {
  int opcode = 0, event = 0, error = 0;
  using Query = int(Display *, int *, int *);
  auto *query = reinterpret_cast<Query *>(dlsym(RTLD_DEFAULT, "glXQueryExtension"));
  return query ? query(display, &error, &event) != 0 : XQueryExtension(display, "GLX", &opcode, &event, &error) != 0;
}

}  // namespace

HeldDisplay::HeldDisplay() {
  const char *name = std::getenv("DISPLAY");
  if (!name || !*name) fail(RIIS_UNAVAILABLE, joined("a picture needs an X display: DISPLAY is not set", advice));
  display_ = open_display();
  if (!display_) {
    fail(RIIS_UNAVAILABLE, joined("a picture needs an X display: DISPLAY ", name, " cannot be opened", advice));
  }
  if (!has_opengl(display_)) {
    XCloseDisplay(display_);
    fail(RIIS_UNAVAILABLE, joined("a picture needs OpenGL: DISPLAY ", name, " has no GLX extension", advice));
  }
}

HeldDisplay::~HeldDisplay() { XCloseDisplay(display_); }

}  // namespace riis::vtk
