// SPDX-License-Identifier: Apache-2.0
// Fuzzes the program's command line. Each line of the input is an argument. The harness opens no file, and sets the parameters of
// --set.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "input.hpp"
#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"
#include "program/cli/command_line.hpp"
#include "program/input/parameters.hpp"

namespace {

using namespace riis::program;

void check_valve(const ValveOptions &options) {
  EXPECT(!options.valve.empty() || !options.surface.empty(), "neither valve nor surface");
  EXPECT(!options.opening || (*options.opening >= 0 && *options.opening <= 1), "opening %g", *options.opening);
  EXPECT(!options.surface_unit || options.unit, "a surface's unit without the mesh's");
  EXPECT(!options.unit || (options.surface_options.scale >= 1e-3 && options.surface_options.scale <= 1e3), "scale %g",
         options.surface_options.scale);
  EXPECT(!options.unit || options.surface_options.half_thickness > 0, "half thickness %g",
         options.surface_options.half_thickness);
  riis_valve *handle = nullptr;
  EXPECT(riis_valve_create(options.valve == "mitral" ? "mitral" : "aortic", &handle) == RIIS_OK, "%s",
         riis_last_error());
  const riis::Valve valve(handle);
  for (const std::string &setting : options.settings) set_from_text(valve.get(), setting);
}

void check(const MarkOptions &options) {
  check_valve(options);
  for (const Picture &picture : options.pictures)
    EXPECT(picture.view >= 0 && picture.view <= 2 && !picture.path.empty(), "view %d", picture.view);
  EXPECT(!options.prefix.empty() && options.prefix.find_first_of(" /\n\"<") == std::string::npos, "prefix %s",
         options.prefix.c_str());
  EXPECT(options.series.times.size() <= 100000, "%zu times", options.series.times.size());
  for (std::size_t i = 1; i < options.series.times.size(); ++i)
    EXPECT(options.series.times[i] > options.series.times[i - 1], "time %zu is not above the one before", i);
}

void check(const SizeFieldOptions &options) {
  check(static_cast<const MarkOptions &>(options));
  EXPECT(!options.field.empty() && options.band_edge > 0 && options.growth > 0 && options.n_openings >= 2,
         "a field of %d openings", options.n_openings);
}

void check(const StatesOptions &options) {
  check_valve(options);
  EXPECT(!options.output.empty() && options.n_states >= 2 && options.n_states <= 100001, "%d states", options.n_states);
}

void check(const AreaOptions &options) {
  check_valve(options);
  EXPECT(options.area || (!options.areas.empty() && !options.output.empty()), "neither an area nor areas");
  EXPECT(!options.area || *options.area >= 0, "area %g", *options.area);
}

void check(const ExportOptions &options) {
  check_valve(options);
  EXPECT(!options.folder.empty() && options.time_step > 0, "an export lacks options");
  EXPECT(!options.cycle.empty() || (options.opening_duration && options.closing_duration), "an export lacks a motion");
}

void check(const ParamsOptions &options) { check_valve(options); }

void check(const PlaceOptions &options) { EXPECT(!options.landmarks.empty(), "no file of landmarks"); }

void check(const PatientOptions &options) {
  EXPECT(!options.wall.empty() && !options.landmarks.empty() && !options.folder.empty(), "a patient lacks files");
  const auto &solvers = solver_names;
  EXPECT(std::find(solvers.begin(), solvers.end(), options.solver) != solvers.end(), "no solver");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size) {
  std::vector<std::string> words = {"riis"};
  // An argument ends at a 0 byte.
  std::string text(reinterpret_cast<const char *>(bytes), size);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    words.emplace_back(text.substr(begin, end - begin).c_str());
    begin = end + 1;
  }
  std::vector<char *> arguments;
  for (std::string &word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  try {
    if (const auto request = parse_command_line(static_cast<int>(words.size()), arguments.data()))
      std::visit([](const auto &options) { check(options); }, *request);
  } catch (const Refusal &refusal) {
    EXPECT(refusal.exit_code == exit_bad_data || refusal.exit_code == exit_wrong_usage, "exit code %d",
           refusal.exit_code);
    EXPECT(!refusal.text.empty(), "no text");
  }
  return 0;
}
