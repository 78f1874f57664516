// SPDX-License-Identifier: Apache-2.0
// How the program gives up: an exit code and one line for stderr.
#pragma once

#include <riis/riis.h>

#include <string>

namespace riis::cli {

enum ExitCode { exit_fine = 0, exit_bad_data = 1, exit_wrong_usage = 2 };

struct Refusal {
  ExitCode exit_code;
  std::string text;
};

// Throws the library's own text. Files, arrays and parameters are data; an argument that the library refuses is an
// option of the command line that is out of range. subject, such as a file's name, goes before texts that do not name
// it themselves.
inline void check(riis_status status, const std::string &subject = "") {
  if (status == RIIS_OK) return;
  const bool data = status == RIIS_INVALID_SURFACE || status == RIIS_INVALID_MESH || status == RIIS_INVALID_PARAMETER;
  throw Refusal{status == RIIS_INVALID_ARGUMENT ? exit_wrong_usage : exit_bad_data,
                (data && !subject.empty() ? subject + ": " : "") + riis_last_error()};
}

}  // namespace riis::cli
