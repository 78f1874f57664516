// SPDX-License-Identifier: Apache-2.0
#include "program/cli/command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "program/base/refusal.hpp"
#include "program/base/text.hpp"

namespace riis::program {
namespace {

std::string option_name(const std::string &names) { return names.substr(0, names.find(',')); }

}  // namespace

bool Command::parsed() const { return app_->parsed(); }
CLI::Option *Command::option(const std::string &name) const { return app_->get_option(name); }
bool Command::knows(const std::string &name) const { return app_->get_option_no_throw(name) != nullptr; }
bool Command::has(const std::string &name) const { return option(name)->count() > 0; }

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
    // Refuses an empty value, because it would look like an option that was not given.
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

CLI::Option *Command::number(const std::string &names, const char *type, const char *help, double &to) {
  return value(names, type, help,
               [&to, name = option_name(names)](const std::string &text) { to = parse_number(text, name); });
}

CLI::Option *Command::positive(const std::string &names, const char *type, const char *help, double &to) {
  return value(names, type, help,
               [&to, name = option_name(names)](const std::string &text) { to = parse_positive(text, name); });
}

CLI::Option *Command::choice(const std::string &names, const char *help, const std::vector<std::string> &words,
                             std::int32_t &to, const char *type) {
  return value(names, type, help, [&to, &words](const std::string &text) { to = position_of(text, words); })
      ->check(CLI::IsMember(words));
}

CLI::Option *Command::flag(const std::string &names, const char *help, bool &to) {
  return finished(app_->add_flag(names, to, help), nullptr);
}

void refuse_empty(const std::string &name) { refuse_usage(name + ": the value is empty"); }

std::int32_t position_of(const std::string &name, const std::vector<std::string> &names) {
  return static_cast<std::int32_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

double parse_positive(const std::string &text, const std::string &subject) {
  const double number = parse_number(text, subject);
  if (!(number > 0)) refuse_usage(subject + ": " + text + " is not above 0");
  return number;
}

}  // namespace riis::program
