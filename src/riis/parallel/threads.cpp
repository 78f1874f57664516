// SPDX-License-Identifier: Apache-2.0
#include "parallel/threads.hpp"

#include <pthread.h>
#if defined(__APPLE__)
#include <dlfcn.h>
#endif

#include <atomic>

namespace riis {
namespace {

std::atomic<bool> are_used{false}, are_lost{false};

void begin_child() {
  if (are_used) are_lost = true;
}

// A program may close a plug-in that uses riis while threads still run the library's code. This function keeps the code in
// memory. On Linux the linker's option -z nodelete does the same (cmake/RiisPlatform.cmake). Darwin's linker has no such option.
// `address` is the address of any code or data of the library.
void stay_loaded([[maybe_unused]] const void *address) noexcept {
#if defined(__APPLE__)
  // The library's file is opened a second time and never closed, so the loader keeps it. If the file cannot be opened, the
  // program contains a static riis, which needs no such protection.
  Dl_info file{};
  if (dladdr(address, &file) != 0) static_cast<void>(dlopen(file.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE));
#endif
}

}  // namespace

bool begin_threads() noexcept {
  if (!are_used.load(std::memory_order_relaxed)) {
    // Without this handler, the library could not notice a fork. If there is no memory for the handler, the library therefore
    // starts no threads.
    static const bool is_watched = pthread_atfork(nullptr, nullptr, begin_child) == 0;
    if (!is_watched) return false;
    stay_loaded(&are_used);
    are_used = true;
  }
  return !has_lost_threads();
}

bool has_lost_threads() noexcept { return are_lost.load(std::memory_order_relaxed); }

}  // namespace riis
