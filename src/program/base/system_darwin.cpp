// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <limits.h>
#include <mach-o/dyld.h>
#include <sys/event.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>

#include "program/base/refusal.hpp"
#include "program/base/system.hpp"
#include "program/base/text.hpp"
#include "program/base/virtual_display.hpp"

namespace riis::program {

std::string path_of_this_program() {
  std::uint32_t size = 0;
  _NSGetExecutablePath(nullptr, &size);
  std::string path(size, '\0');
  char whole[PATH_MAX];
  if (_NSGetExecutablePath(&path[0], &size) != 0 || realpath(path.c_str(), whole) == nullptr)
    refuse_data("the path of this program is not known: " + system_text(errno));
  return whole;
}

bool make_pipe(int ends[2]) {
  if (pipe(ends) != 0) return false;
  for (int end = 0; end < 2; ++end) fcntl(ends[end], F_SETFD, FD_CLOEXEC);
  return true;
}

void end_with_parent(int signal) {
  const int queue = kqueue();
  if (queue < 0) return;  // without the watch, this process goes on until its work is done
  std::thread([queue, signal, parent = getppid()] {
    struct kevent parents_end {
    }, seen{};
    EV_SET(&parents_end, static_cast<uintptr_t>(parent), EVFILT_PROC, EV_ADD, NOTE_EXIT, 0, nullptr);
    while (kevent(queue, &parents_end, 1, &seen, 1, nullptr) < 0 && errno == EINTR) {
    }
    kill(getpid(), signal);
  }).detach();
}

// Darwin accepts the limit, but does not enforce it.
std::optional<std::uintmax_t> limited_memory() { return std::nullopt; }

// VTK draws by Cocoa here, so a picture needs no X display.
void check_virtual_display() {}
VirtualDisplay::VirtualDisplay() {
  refuse_data("a picture cannot be drawn: VTK finds no display, and riis cannot start a display on macOS");
}
VirtualDisplay::~VirtualDisplay() = default;

}  // namespace riis::program
