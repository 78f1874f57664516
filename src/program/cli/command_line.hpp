// SPDX-License-Identifier: Apache-2.0
// Turns argc and argv into a command with its options, and has the texts of help.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "program/base/options.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace riis::program {

// The command that the user requested, with its options. riis surface and riis check also store their options in MarkOptions.
using Request = std::variant<MarkOptions, SizeFieldOptions, StatesOptions, AreaOptions, ExportOptions, ParamsOptions,
                             PlaceOptions, PatientOptions>;

// Parses the command line. If the user wants only help or the version, prints the text and returns nothing. Throws a Refusal for
// wrong usage.
std::optional<Request> parse_command_line(int argc, char **argv);

// Declares options of a command. CLI11 gives each value to the program as text. The program parses the numbers itself, because
// the result of CLI11 would depend on the locale.
class Command {
 public:
  explicit Command(CLI::App *app) : app_(app) {}

  bool has(const std::string &name) const;    // whether the command has this option, and the user gave it
  bool knows(const std::string &name) const;  // whether the command has this option
  CLI::Option *option(const std::string &name) const;
  // Sets the heading under which the help lists the next options.
  void group(const char *title) { group_ = title; }

  using Take = std::function<void(const std::string &)>;
  // Each of the next functions declares an option. The arguments are the option's names, a word for its value, and a help text. A
  // positional argument has a name such as "OUT".
  CLI::Option *value(const std::string &names, const char *type, const char *help, const Take &take);
  CLI::Option *text(const std::string &names, const char *type, const char *help, std::string &to);
  using TakeAll = std::function<void(const std::vector<std::string> &)>;
  CLI::Option *values(const std::string &names, const char *type, const char *help, const TakeAll &take);
  // Parses the value by parse(value, the option's name), and stores the result in `to`. `parse` refuses bad values.
  template <class To, class Parse>
  CLI::Option *parsed(const std::string &names, const char *type, const char *help, To &to, const Parse &parse) {
    return value(names, type, help, [&to, parse, name = names.substr(0, names.find(','))](const std::string &text) {
      to = parse(text, name);
    });
  }
  // Stores in `to` the position of the given word in the list `words`.
  CLI::Option *choice(const std::string &names, const char *help, const std::vector<std::string> &words,
                      std::int32_t &to, const char *type = "HOW");
  CLI::Option *flag(const std::string &names, const char *help, bool &to);

 private:
  CLI::Option *finished(CLI::Option *option, const char *type) const;

  CLI::App *app_;
  const char *group_ = "Options";
};

// Returns the position of a word in a list, or the list's length if the word is missing.
std::int32_t position_of(const std::string &name, const std::vector<std::string> &names);

// Declares the options of each command, and checks that the given options fit together.

void declare_mark(Command command, MarkOptions &options);
void declare_surface(Command command, MarkOptions &options);
void declare_crossings(Command command, MarkOptions &options);
void declare_leaks(Command command, MarkOptions &options);
void declare_size_field(Command command, SizeFieldOptions &options);
void declare_states(Command command, StatesOptions &options);
void declare_from_area(Command command, AreaOptions &options);
void declare_export(Command command, ExportOptions &options);
void declare_params(Command command, ParamsOptions &options);
void declare_place(Command command, PlaceOptions &options);
void declare_patient(Command command, PatientOptions &options);

// Each function finish_* checks the options of a command and computes the values that follow from them. An option that
// contradicts another option or has no effect is refused.
MarkOptions finish_mark(const Command &command, MarkOptions options);
MarkOptions finish_surface(const Command &command, MarkOptions options);
MarkOptions finish_crossings(const Command &command, MarkOptions options);
MarkOptions finish_leaks(const Command &command, MarkOptions options);
SizeFieldOptions finish_size_field(const Command &command, SizeFieldOptions options);
StatesOptions finish_states(const Command &command, StatesOptions options);
AreaOptions finish_from_area(const Command &command, AreaOptions options);
ExportOptions finish_export(const Command &command, ExportOptions options);
ParamsOptions finish_params(const Command &command, ParamsOptions options);
PlaceOptions finish_place(const Command &command, PlaceOptions options);
PatientOptions finish_patient(const Command &command, PatientOptions options);

// The beginning of the program's help.
extern const char *const description;

// Returns the text that follows the options in a command's help: examples, and topics to read. The name "riis" stands for the
// program's own help.
std::string help_of(const std::string &command);

// Returns the text of a topic, or the list of topics if the name is "". Throws a Refusal for an unknown name.
std::string text_of_topic(const std::string &name);

// Returns the lines that the program prints if the command line has no arguments.
std::string short_help();

}  // namespace riis::program
