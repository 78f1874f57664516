// SPDX-License-Identifier: Apache-2.0
#include "program/text_file.hpp"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include "program/refusal.hpp"

namespace riis::program {

void refuse_file(const std::string &path, const std::string &reason) {
  constexpr std::size_t longest = 300;
  throw Refusal{exit_bad_data, path + ": " + (reason.size() > longest ? reason.substr(0, longest) + " ..." : reason)};
}

std::string text_of_file(const std::string &path) {
  errno = 0;
  std::ifstream file(path);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  // A folder can be opened, but not read.
  if (!file.is_open() || errno != 0) refuse_file(path, "cannot be read: " + std::generic_category().message(errno));
  if (text.str().empty()) refuse_file(path, "is empty");
  return text.str();
}

}  // namespace riis::program
