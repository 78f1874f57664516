// SPDX-License-Identifier: Apache-2.0
#include "program/state_options.hpp"

#include <CLI/CLI.hpp>
#include <set>

#include "program/refusal.hpp"
#include "program/text.hpp"

namespace riis::program {
namespace {

const std::set<std::string> of_states = {
    "--states", "--state-count", "--valve",        "--params",         "--params-open", "--set",   "--tolerance",
    "--scale",  "--unit",        "--surface-unit", "--half-thickness", "--quiet",       "--strict"};

[[noreturn]] void refuse_states(const std::string &text) { throw Refusal{exit_wrong_usage, text}; }

}  // namespace

void declare_states(CLI::App &app, Options &options, std::string &count) {
  const char *group = "States of a valve";
  CLI::Option *states =
      app.add_option("--states", options.states,
                     "Write free edges, leaflet areas and the orifice at openings from 0 to 1; takes no MESH")
          ->type_name("OUT.csv|-")
          ->group(group)
          ->excludes(app.get_option("--surface"));
  app.add_option("--state-count", count, "Number of these openings (default 101)")
      ->type_name("N")
      ->group(group)
      ->needs(states);
}

void parse_states(const std::string &count, Options &options) {
  if (count.empty()) return;
  options.n_states = parse_integer(count, "--state-count");
  if (options.n_states < 2 || options.n_states > most_states)
    refuse_states("--state-count: " + count + " is not from 2 to " + std::to_string(most_states));
}

void check_states_purpose(const Options &options, const std::vector<const CLI::Option *> &given) {
  if (options.states.empty()) return;
  for (const CLI::Option *option : given)
    if (of_states.count(option->get_name()) == 0) refuse_states(option->get_name() + " has no effect with --states");
  for (const std::string &setting : options.settings)
    if (setting.rfind("opening=", 0) == 0) refuse_states("--set opening has no effect with --states");
}

}  // namespace riis::program
