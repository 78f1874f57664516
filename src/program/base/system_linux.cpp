// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "program/base/refusal.hpp"
#include "program/base/system.hpp"

namespace riis::program {

std::string path_of_this_program() {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) refuse_data("/proc/self/exe: cannot be read: " + error.message());
  return path.string();
}

bool make_pipe(int ends[2]) { return pipe2(ends, O_CLOEXEC) == 0; }

void end_with_parent(int signal) { prctl(PR_SET_PDEATHSIG, signal); }

std::optional<std::uintmax_t> limited_memory() {
  std::ifstream statm("/proc/self/statm");
  std::uintmax_t n_pages = 0;
  if (!(statm >> n_pages)) return std::nullopt;
  return n_pages * static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace riis::program
