// SPDX-License-Identifier: Apache-2.0
// Keeps the library's code in memory once threads may run it, even if a plug-in that uses riis is closed. On Linux the linker's
// option -z nodelete does that (cmake/RiisPlatform.cmake). Darwin's linker has no option like -z nodelete.
#pragma once

#if defined(__APPLE__)
#include <dlfcn.h>
#endif

namespace riis {

// `address` is an address of the library's code or data.
inline void stay_loaded([[maybe_unused]] const void *address) noexcept {
#if defined(__APPLE__)
  // The library's file is opened a second time and never closed, so the loader keeps it. A program that contains a static riis
  // does not need this, so a file that cannot be opened does no harm.
  Dl_info file{};
  if (dladdr(address, &file) != 0) static_cast<void>(dlopen(file.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE));
#endif
}

}  // namespace riis
