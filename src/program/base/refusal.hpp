// SPDX-License-Identifier: Apache-2.0
// A Refusal is an exit code and one line for stderr. To give up, the program throws a Refusal. The Python package raises an
// exception with a Refusal's status and text.
#pragma once

#include <riis/riis.h>

#include <string>
#include <utility>

namespace riis::program {

enum ExitCode { exit_fine = 0, exit_bad_data = 1, exit_wrong_usage = 2, exit_none_marked = 3, exit_warned = 4 };

struct Refusal {
  ExitCode exit_code;
  std::string text;
  riis_status status = RIIS_INVALID_ARGUMENT;
};

[[noreturn]] inline void refuse_data(const std::string &text) { throw Refusal{exit_bad_data, text}; }
[[noreturn]] inline void refuse_usage(const std::string &text) { throw Refusal{exit_wrong_usage, text}; }

// Returns the library's message. If the message begins with the name of a struct's field, the program replaces this name by the
// option of the command line.
inline std::string with_option_named(const std::string &text) {
  static const std::pair<std::string, std::string> options[] = {{"options.scale ", "--scale "},
                                                                {"options.rotation_axis ", "--rotate: the axis "},
                                                                {"options.rotation_angle ", "--rotate: the angle "},
                                                                {"options.translation ", "--translate "},
                                                                {"options.half_thickness ", "--half-thickness "},
                                                                {"options.offset ", "--offset "},
                                                                {"options.tolerance ", "--tolerance "},
                                                                {"options.distance_limit ", "--distance-limit "},
                                                                {"options.measure_tolerance ", "--distance-tolerance "},
                                                                {"options.search ", "--search "},
                                                                {"options.n_threads ", "--threads "},
                                                                {"arrays.far_distance ", "--far-distance "},
                                                                {"arrays.skirt_length ", "--skirt: skirt_length "},
                                                                {"resistance.R ", "--resistance "},
                                                                {"area 0 ", "--area "},
                                                                {"search.from ", "--from "},
                                                                {"search.to ", "--to "},
                                                                {"where: ", "--cells-where: "},
                                                                {"where is ", "--cells-where is "},
                                                                {"time ", "--time "},
                                                                {"frames.period ", "--period "},
                                                                {"frames.time ", "--period: the time "}};
  for (const auto &[field, option] : options) {
    if (text.rfind(field, 0) == 0) return option + text.substr(field.size());
  }
  const std::string surface = "search.surface: ";
  if (text.rfind(surface, 0) == 0) return with_option_named(text.substr(surface.size()));
  return text;
}

// Throws a Refusal with the library's message if the status is not RIIS_OK. Faults of files, arrays and parameters count as bad
// data. A refused argument counts as wrong usage, because it comes from an option that is out of range. If a message does not
// begin with `subject`, such as a file's name, puts `subject` before the message.
inline void check(riis_status status, const std::string &subject = "") {
  if (status == RIIS_OK) return;
  const bool data = status == RIIS_INVALID_SURFACE || status == RIIS_INVALID_MESH || status == RIIS_INVALID_PARAMETER ||
                    status == RIIS_LIMIT_EXCEEDED;
  if (status == RIIS_INVALID_ARGUMENT) throw Refusal{exit_wrong_usage, with_option_named(riis_last_error()), status};
  throw Refusal{exit_bad_data, (data && !subject.empty() ? subject + ": " : "") + riis_last_error(), status};
}

}  // namespace riis::program
