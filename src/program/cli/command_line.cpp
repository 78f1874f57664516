// SPDX-License-Identifier: Apache-2.0

#include "program/cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <sstream>
#include <utility>

#include "program/base/other_program.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {

namespace {

// Formats an option as its name and the type of its value. For each option, CLI11's own format would also list other options that
// it excludes or needs. The help would then be too long for a screen.
class BriefHelp : public CLI::Formatter {
 public:
  BriefHelp() { column_width(36); }

  std::string make_option_opts(const CLI::Option *option) const override {
    if (option->get_positional() || option->get_type_size() == 0) return "";
    const std::string type = option->get_type_name();  // CLI11 appends the allowed words to the type
    return " " + type.substr(0, type.find(":{"));
  }
};

// Replaces each pair of blank lines in a help text by one blank line.
std::string tidied(std::string help) {
  for (std::size_t at = 0; (at = help.find("\n\n\n", at)) != std::string::npos;) help.erase(at, 1);
  return help;
}

// Returns the full name of a command as the user types it, such as "riis check leaks".
std::string name_of(const CLI::App &app) {
  return (app.get_parent() ? name_of(*app.get_parent()) + " " : "") + app.get_name();
}

[[noreturn]] void refuse_empty(const std::string &name) { refuse_usage(name + ": the value is empty"); }

// Refuses "--output= mesh.vtu", because CLI11 would read it as "--output=mesh.vtu".
void check_equals_signs(int argc, char **argv) {
  for (int i = 1; i < argc && argv[i] != std::string("--"); ++i) {
    const std::string argument = argv[i];
    if (argument.rfind("--", 0) == 0 && argument.find('=') == argument.size() - 1)
      refuse_empty(argument.substr(0, argument.size() - 1));
  }
}

// Returns a hint for words on the command line that belong to no option. Usually the user typed the value of an option as several
// words.
std::string hint_of(const CLI::App &app) {
  const struct {
    const char *name;
    char mark;
    int n_marks;  // how often a complete value contains the character `mark`
  } forms[] = {{"--set", '=', 1}, {"--rotate", ',', 3}, {"--translate", ',', 2}};
  for (const auto &form : forms) {
    const CLI::Option *option = app.get_option_no_throw(form.name);
    if (!option) continue;
    for (const std::string &value : option->results()) {
      if (std::count(value.begin(), value.end(), form.mark) < form.n_marks)
        return std::string(form.name) + " takes " + option->get_type_name();
    }
  }
  return name_of(app) + " --help lists the options";
}

std::vector<std::string> names_of_options(const CLI::App &app) {
  std::vector<std::string> names;
  for (const CLI::Option *option : app.get_options())
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  return names;
}

bool looks_like_option(const std::string &argument) { return argument.size() > 1 && argument[0] == '-'; }

// Returns the words that CLI11 did not understand, in the order of typing. (CLI11 does not keep the order of the words.) If some
// of these words are unknown options, returns only the options. The remaining words may be values of the unknown options.
std::string text_of_leftovers(const CLI::App &app, int argc, char **argv) {
  std::vector<std::string> left = app.remaining();
  const bool has_options = std::any_of(left.begin(), left.end(), looks_like_option);
  std::string text;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto found = std::find(left.begin(), left.end(), argument);
    if (found == left.end()) continue;
    left.erase(found);
    if (looks_like_option(argument) != has_options) continue;
    if (!text.empty()) text += "; ";
    const std::string name = argument.substr(0, argument.find('='));
    text += has_options ? name + " is not an option" : argument + " is one argument too many";
    if (has_options && name.size() > 2) text += did_you_mean(name.substr(2), names_of_options(app), "--");
  }
  return text;
}

std::vector<const CLI::App *> commands_of(const CLI::App &app) {
  return app.get_subcommands([](const CLI::App *) { return true; });
}

// Returns the command with this name. Refuses a word that is not a command.
const CLI::App &command_named(const CLI::App &app, const std::string &word) {
  const std::string hint = " (" + name_of(app) + " --help lists the commands)";
  if (looks_like_option(word)) refuse_usage(word + " stands before a command" + hint);
  std::vector<std::string> names;
  for (const CLI::App *command : commands_of(app)) {
    if (command->get_name() == word) return *command;
    names.push_back(command->get_name());
  }
  refuse_usage("'" + word.substr(0, 64) + "' is not a command" + did_you_mean(word, names) + hint);
}

// Refuses a command line if its first words are neither a complete command nor a request for help or the version.
void check_commands(const CLI::App &app, int argc, char **argv) {
  const CLI::App *at = &app;
  for (int i = 1; !commands_of(*at).empty(); ++i) {
    std::string names;
    for (const CLI::App *command : commands_of(*at)) names += (names.empty() ? "" : " or ") + command->get_name();
    if (i >= argc) refuse_usage(name_of(*at) + " needs a command: " + names);
    const std::string word = argv[i];
    if (word == "--help" || word == "-h" || word == "--version") return;
    at = &command_named(*at, word);
  }
}

// Returns the command that was parsed. If commands contain commands, returns the innermost command.
const CLI::App &innermost(const CLI::App &app) {
  const CLI::App *at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  return *at;
}

}  // namespace

std::optional<Request> parse_command_line(int argc, char **argv) {
  CLI::App app(description, "riis");
  app.formatter(std::make_shared<BriefHelp>());
  app.set_version_flag("--version", std::string("riis ") + riis_version_string(), "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this and exit");
  app.footer(help_of("riis"));
  app.require_subcommand(1);
  const auto named = [](CLI::App &in, const char *name, const char *what) {
    CLI::App *made = in.add_subcommand(name, what);
    made->footer(help_of(name));
    return made;
  };
  // For each command with options: CLI11's object, and a call that turns the options into a request.
  std::vector<std::pair<const CLI::App *, std::function<Request()>>> commands;
  const auto add = [&](CLI::App &in, const char *name, const char *what, auto declare, auto finish, auto options) {
    const Command command(named(in, name, what));
    const auto parsed = std::make_shared<decltype(options)>(std::move(options));
    declare(command, *parsed);
    commands.emplace_back(in.get_subcommand(name), [=]() -> Request { return finish(command, std::move(*parsed)); });
  };
  add(app, "mark", "Mark the mesh nodes near a valve, at one time or at many times", declare_mark, finish_mark,
      MarkOptions());
  add(app, "surface", "Write or draw the triangles of a valve, without a mesh", declare_surface, finish_surface,
      MarkOptions());
  add(app, "states", "Measure a valve at openings from 0 to 1", declare_states, finish_states, StatesOptions());
  add(app, "from-area", "Find the opening or the size of a valve from the area of its orifice", declare_from_area,
      finish_from_area, AreaOptions());
  CLI::App *checks = named(app, "check", "Look for leaflets that cross, or for ways through a valve");
  checks->require_subcommand(1);
  add(*checks, "crossings", "Tell whether leaflets go through each other, at 101 openings", declare_crossings,
      finish_crossings, MarkOptions());
  add(*checks, "leaks", "Tell whether flow can pass through the marked valve in a mesh", declare_leaks, finish_leaks,
      MarkOptions());
  add(app, "size-field", "Write the edge lengths that a mesh needs near a valve, for gmsh", declare_size_field,
      finish_size_field, SizeFieldOptions());
  add(app, "export", "Write the motion of leaflets in the format of svMultiPhysics", declare_export, finish_export,
      ExportOptions());
  add(app, "params", "Print the parameters of a valve", declare_params, finish_params, ParamsOptions());
  add(app, "place", "Find a valve's sizes and placement from a patient's landmarks", declare_place, finish_place,
      PlaceOptions());
  add(app, "patient", "Make a mesh with a valve, and a case for a solver, from a patient's wall and landmarks",
      declare_patient, finish_patient, PatientOptions());
  named(app, "view", "Show a mesh and a valve in a browser, with the Python package riis");
  CLI::App *help = named(app, "help", "Explain a topic, or list the topics");
  std::string topic;
  help->add_option("TOPIC", topic, "A topic that riis help lists");
  const auto asks_for_help = [](const std::string &word) { return word == "--help" || word == "-h"; };
  if (argc > 1 && std::string("view") == argv[1] && std::none_of(argv + 2, argv + argc, asks_for_help))
    run_view(argc, argv);
  check_equals_signs(argc, argv);
  check_commands(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success &request) {
    std::ostringstream text;
    app.exit(request, text, text);
    write_text("-", tidied(text.str()));
    return std::nullopt;
  } catch (const CLI::ExtrasError &) {
    const CLI::App &parsed = innermost(app);
    refuse_usage(text_of_leftovers(parsed, argc, argv) + " (" + hint_of(parsed) + ")");
  } catch (const CLI::ParseError &error) {
    refuse_usage(std::string(error.what()) + " (" + name_of(innermost(app)) + " --help lists the options)");
  }
  if (help->parsed()) {
    write_text("-", text_of_topic(topic));
    return std::nullopt;
  }
  for (const auto &[parsed, request] : commands)
    if (parsed->parsed()) return request();
  return std::nullopt;
}

namespace {

std::string option_name(const std::string &names) { return names.substr(0, names.find(',')); }

}  // namespace

CLI::Option *Command::option(const std::string &name) const { return app_->get_option(name); }
bool Command::knows(const std::string &name) const { return app_->get_option_no_throw(name) != nullptr; }
bool Command::has(const std::string &name) const { return knows(name) && option(name)->count() > 0; }

CLI::Option *Command::finished(CLI::Option *option, const char *type) const {
  if (type) option->type_name(type);
  return option->group(group_);
}

CLI::Option *Command::value(const std::string &names, const char *type, const char *help, const Take &take) {
  if (!type)
    return finished(app_->add_flag_callback(
                        names, [take] { take(""); }, help),
                    nullptr);
  const auto taken = [take, name = option_name(names)](const std::string &text) {
    // Refuses an empty value, because an empty value stands for an option that was not given.
    if (text.empty()) refuse_empty(name);
    take(text);
  };
  return finished(app_->add_option_function<std::string>(names, taken, help), type);
}

CLI::Option *Command::text(const std::string &names, const char *type, const char *help, std::string &to) {
  return value(names, type, help, [&to](const std::string &text) { to = text; });
}

CLI::Option *Command::values(const std::string &names, const char *type, const char *help, const TakeAll &take) {
  const auto taken = [take, name = option_name(names)](const std::vector<std::string> &words) {
    if (std::find(words.begin(), words.end(), "") != words.end()) refuse_empty(name);
    take(words);
  };
  return finished(app_->add_option_function<std::vector<std::string>>(names, taken, help), type);
}

CLI::Option *Command::choice(const std::string &names, const char *help, const std::vector<std::string> &words,
                             std::int32_t &to, const char *type) {
  return value(names, type, help, [&to, &words](const std::string &text) { to = position_of(text, words); })
      ->check(CLI::IsMember(words));
}

CLI::Option *Command::flag(const std::string &names, const char *help, bool &to) {
  return finished(app_->add_flag(names, to, help), nullptr);
}

std::int32_t position_of(const std::string &name, const std::vector<std::string> &names) {
  return static_cast<std::int32_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace riis::program
