// SPDX-License-Identifier: Apache-2.0
// What the process has of malloc.
#pragma once

#include <malloc.h>

namespace bench {

// Bytes that were given and not yet freed, of all arenas and of pages of their own.
inline double allocated() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

}  // namespace bench
