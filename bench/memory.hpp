// SPDX-License-Identifier: Apache-2.0
// What the process has of malloc, and of the system.
#pragma once

#include <malloc.h>

#include <cstdio>
#include <cstdlib>

namespace bench {

// Bytes that were given and not yet freed, of all arenas and of pages of their own.
inline double allocated() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

// Bytes of the process in memory.
inline double resident() {
  long long all = 0, in_memory = 0;
  std::FILE *file = std::fopen("/proc/self/statm", "r");
  if (!file || std::fscanf(file, "%lld %lld", &all, &in_memory) != 2) {
    std::fprintf(stderr, "/proc/self/statm cannot be read\n");
    std::exit(1);
  }
  std::fclose(file);
  return 4096.0 * static_cast<double>(in_memory);
}

}  // namespace bench
