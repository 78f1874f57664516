// SPDX-License-Identifier: Apache-2.0
#include "program/commands/commands.hpp"

#include <variant>

#include "program/base/ranks.hpp"
#include "program/input/parameters.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/marking.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {
namespace {

// Returns advice about the band for a valve of this kind. No parameter sets the band, so the table of parameters says nothing
// about it.
std::string advice_on_band(const std::string &kind) {
  if (kind == "bileaflet") return "band: leave --offset at 0, because the flow passes on both sides of the leaflets\n";
  if (kind == "mitral") {
    return "band: with a cut rim and a skirt, --offset 0.5 gives the flow nearly the full width of an open valve.\n"
           "With a half thickness of 1 mm, the open mitral valve then leaves 2 % less area than its leaflets would\n"
           "leave as thin walls, and the half-open valve 5 % more. With --offset 0.75, the half-open valve leaves\n"
           "8 % more. If the half thickness is below the gap of the closed valve, leave --offset at 0\n"
           "(docs/choosing.md)\n";
  }
  std::string advice =
      "band: with a cut rim and a skirt, --offset 0.75 gives the flow the full width of an open valve. This offset\n"
      "needs a half thickness of at least twice the gap of the closed valve. If the half thickness is between the gap\n"
      "and twice the gap, take --offset 0.5. If the half thickness is below the gap, leave --offset at 0\n"
      "(docs/choosing.md)\n";
  if (kind == "coapting")
    advice +=
        "Even with --offset 0.75, a half-open coapting valve with a half thickness of 1 mm leaves 5 % less area than\n"
        "its leaflets would leave as thin walls (docs/validation.md)\n";
  return advice;
}

void print_params(const ParamsOptions &options) {
  const Valve valve = make_valve(options, OpeningCheck::no);
  write_text("-", options.describe ? parameter_table(valve) + "\n" + advice_on_band(options.valve)
                                   : json_template(valve) + "\n");
}

// Runs the command to which the given options belong.
ExitCode run_command(const Request &request) {
  // riis mark, riis surface and the two commands of riis check
  if (const auto *options = std::get_if<MarkOptions>(&request)) return run_mark(*options);
  if (const auto *options = std::get_if<SizeFieldOptions>(&request)) return run_size_field(*options);
  if (const auto *options = std::get_if<StatesOptions>(&request)) run_states(*options);
  if (const auto *options = std::get_if<AreaOptions>(&request)) run_from_area(*options);
  if (const auto *options = std::get_if<ExportOptions>(&request)) export_uris(*options);
  if (const auto *options = std::get_if<PlaceOptions>(&request)) run_place(*options);
  if (const auto *options = std::get_if<PatientOptions>(&request)) return run_patient(*options);
  if (const auto *options = std::get_if<ParamsOptions>(&request)) print_params(*options);
  return exit_fine;
}

// Several ranks share the work only if the mesh has pieces. The mesh of a case file may also have pieces.
bool has_ranks(const Request &request) {
  const auto *options = std::get_if<MarkOptions>(&request);
  return options && (is_in_pieces(options->mesh) || !options->series.case_file.empty());
}

}  // namespace

ExitCode run(const Request &request) {
  if (!ranks::is_first() && !has_ranks(request)) return exit_fine;
  const ExitCode code = run_command(request);
  const bool is_strict = std::visit([](const ValveOptions &options) { return options.strict; }, request);
  return code == exit_fine && is_strict && n_warnings() > 0 ? exit_warned : code;
}

}  // namespace riis::program
