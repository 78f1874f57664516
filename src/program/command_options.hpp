// SPDX-License-Identifier: Apache-2.0
// Declares the options of each command, and checks that they fit each other.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "program/options.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace riis::program {

// The largest number of openings of riis states.
inline constexpr std::int32_t most_states = 100001;

// Declares options of a command. CLI11 passes text on as it was typed. Numbers are read here and do not depend on the locale.
class Command {
 public:
  explicit Command(CLI::App *app) : app_(app) {}

  bool parsed() const;
  bool has(const std::string &name) const;  // whether the user gave the option
  CLI::Option *option(const std::string &name) const;
  // The heading of the next options in the help.
  void group(const char *title) { group_ = title; }

  using Take = std::function<void(const std::string &)>;
  // Each option has names, a word for its value, and a help text. A value without an option name has a name such as "OUT".
  CLI::Option *value(const std::string &names, const char *type, const char *help, const Take &take);
  CLI::Option *text(const std::string &names, const char *type, const char *help, std::string &to);
  using TakeAll = std::function<void(const std::vector<std::string> &)>;
  CLI::Option *values(const std::string &names, const char *type, const char *help, const TakeAll &take);
  CLI::Option *number(const std::string &names, const char *type, const char *help, double &to);
  CLI::Option *positive(const std::string &names, const char *type, const char *help, double &to);
  // Sets `to` to the position of one of these words.
  CLI::Option *choice(const std::string &names, const char *help, const std::vector<std::string> &words,
                      std::int32_t &to, const char *type = "HOW");
  CLI::Option *flag(const std::string &names, const char *help, bool &to);

 private:
  CLI::Option *finished(CLI::Option *option, const char *type) const;

  CLI::App *app_;
  const char *group_ = "Options";
};

[[noreturn]] void refuse_empty(const std::string &name);

void declare_mark(Command command, MarkOptions &options);
void declare_surface(Command command, MarkOptions &options);
void declare_crossings(Command command, MarkOptions &options);
void declare_leaks(Command command, MarkOptions &options);
void declare_states(Command command, StatesOptions &options);
void declare_export(Command command, ExportOptions &options);
void declare_params(Command command, ParamsOptions &options);

// These refuse options that contradict each other or have no effect, and derive the remaining values.
MarkOptions finish_mark(const Command &command, MarkOptions options);
MarkOptions finish_surface(const Command &command, MarkOptions options);
MarkOptions finish_crossings(const Command &command, MarkOptions options);
MarkOptions finish_leaks(const Command &command, MarkOptions options);
StatesOptions finish_states(const Command &command, StatesOptions options);
ExportOptions finish_export(const Command &command, ExportOptions options);
ParamsOptions finish_params(const Command &command, ParamsOptions options);

}  // namespace riis::program
