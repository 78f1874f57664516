// SPDX-License-Identifier: Apache-2.0
// One command of the command line. It declares the command's options and reads their values.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace riis::program {

// Declares options of a command. CLI11 passes on each value as text. This program parses the numbers itself, so that they do not
// depend on the locale.
class Command {
 public:
  explicit Command(CLI::App *app) : app_(app) {}

  bool parsed() const;
  bool has(const std::string &name) const;    // whether the user gave the option
  bool knows(const std::string &name) const;  // whether the command has this option
  CLI::Option *option(const std::string &name) const;
  // Sets the heading in the help for the options declared next.
  void group(const char *title) { group_ = title; }

  using Take = std::function<void(const std::string &)>;
  // Each of the next functions declares an option by its names, a word for its value, and a help text. A positional argument has
  // a name such as "OUT".
  CLI::Option *value(const std::string &names, const char *type, const char *help, const Take &take);
  CLI::Option *text(const std::string &names, const char *type, const char *help, std::string &to);
  using TakeAll = std::function<void(const std::vector<std::string> &)>;
  CLI::Option *values(const std::string &names, const char *type, const char *help, const TakeAll &take);
  CLI::Option *number(const std::string &names, const char *type, const char *help, double &to);
  CLI::Option *positive(const std::string &names, const char *type, const char *help, double &to);
  // Sets `to` to the position of the given word in `words`.
  CLI::Option *choice(const std::string &names, const char *help, const std::vector<std::string> &words,
                      std::int32_t &to, const char *type = "HOW");
  CLI::Option *flag(const std::string &names, const char *help, bool &to);

 private:
  CLI::Option *finished(CLI::Option *option, const char *type) const;

  CLI::App *app_;
  const char *group_ = "Options";
};

[[noreturn]] void refuse_empty(const std::string &name);

// Returns the position of a word in a list, or the list's length if it is not there.
std::int32_t position_of(const std::string &name, const std::vector<std::string> &names);

// Refuses numbers that are not above 0. RIIS_AUTO is a negative number, and a user's number must not be mistaken for it.
double parse_positive(const std::string &text, const std::string &subject);

}  // namespace riis::program
