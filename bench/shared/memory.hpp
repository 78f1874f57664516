// SPDX-License-Identifier: Apache-2.0
// Measures the memory of the process, as malloc and the system count it.
#pragma once

#include <malloc.h>

#include <cstdio>
#include <cstdlib>

namespace bench {

// Returns the bytes that malloc has allocated and not yet freed, in all arenas and in separate pages.
inline double allocated() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

// Returns the process's resident memory in bytes.
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
