// SPDX-License-Identifier: Apache-2.0
// riis-mark's command line: each line of the input is an argument. No file is opened. Parameters of --set are set.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "expect.hpp"
#include "program/command_line.hpp"
#include "program/handles.hpp"
#include "program/parameters.hpp"
#include "program/refusal.hpp"

namespace {

void check(const riis::program::Options &options) {
  EXPECT(!options.valve.empty() || !options.surface.empty(), "neither valve nor surface");
  EXPECT(!options.opening || (*options.opening >= 0 && *options.opening <= 1), "opening %g", *options.opening);
  for (const riis::program::Picture &picture : options.pictures)
    EXPECT(picture.view >= 0 && picture.view <= 2 && !picture.path.empty(), "view %d", picture.view);
  EXPECT(!options.surface_unit || options.unit, "a surface's unit without the mesh's");
  EXPECT(!options.unit || (options.surface_options.scale >= 1e-3 && options.surface_options.scale <= 1e3), "scale %g",
         options.surface_options.scale);
  EXPECT(!options.unit || options.surface_options.half_thickness > 0, "half thickness %g",
         options.surface_options.half_thickness);
  EXPECT(!options.prefix.empty() && options.prefix.find_first_of(" /\n\"<") == std::string::npos, "prefix %s",
         options.prefix.c_str());
  EXPECT(options.series.times.size() <= 100000, "%zu times", options.series.times.size());
  for (std::size_t i = 1; i < options.series.times.size(); ++i)
    EXPECT(options.series.times[i] > options.series.times[i - 1], "time %zu is not above the one before", i);
  const riis::program::UrisOptions &uris = options.uris;
  EXPECT(uris.folder.empty() || (uris.time_step && *uris.time_step > 0 && options.resistance),
         "an export lacks options");
  EXPECT(uris.folder.empty() || !options.series.cycle.empty() || (uris.opening_duration && uris.closing_duration),
         "an export lacks a motion");
  riis_valve *handle = nullptr;
  EXPECT(riis_valve_create(options.valve == "mitral" ? "mitral" : "aortic", &handle) == RIIS_OK, "%s",
         riis_last_error());
  const riis::program::Valve valve(handle);
  for (const std::string &setting : options.settings) riis::program::set_from_text(valve.get(), setting);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size) {
  std::vector<std::string> words = {"riis-mark"};
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
    if (const auto options = riis::program::parse_command_line(static_cast<int>(words.size()), arguments.data()))
      check(*options);
  } catch (const riis::program::Refusal &refusal) {
    EXPECT(refusal.exit_code == riis::program::exit_bad_data || refusal.exit_code == riis::program::exit_wrong_usage,
           "exit code %d", refusal.exit_code);
    EXPECT(!refusal.text.empty(), "no text");
  }
  return 0;
}
