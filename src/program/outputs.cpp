// SPDX-License-Identifier: Apache-2.0
#include "program/outputs.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <system_error>
#include <vector>

#include "program/interruption.hpp"
#include "program/movie.hpp"
#include "program/refusal.hpp"
#include "program/series_files.hpp"
#include "program/valve_file.hpp"

namespace riis::program {
namespace {

namespace fs = std::filesystem;

void check_ending(const std::string &path, const std::string &ending, const std::string &option) {
  if (!has_ending(path, ending)) throw Refusal{exit_wrong_usage, option + ": " + path + " must end in " + ending};
}

std::string system_text(int error) { return std::generic_category().message(error); }

[[noreturn]] void cannot_be_written(const std::string &path, const std::string &reason) {
  throw Refusal{exit_bad_data, path + ": cannot be written: " + reason};
}

// A device or a pipe is written into; any other file is replaced as a whole.
bool is_special(const std::string &path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_regular_file(path, error);
}

void check_place(const std::string &path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw Refusal{exit_bad_data, path + ": is a directory"};
  const fs::path folder = folder_of(place_of(path));
  if (!fs::is_directory(folder, error)) cannot_be_written(path, "the folder " + folder.string() + " does not exist");
  // A new file is written beside the old one and then takes its place.
  if (!is_special(path) && access(folder.c_str(), W_OK | X_OK) != 0) {
    cannot_be_written(path, "the folder " + folder.string() + ": " + system_text(errno));
  }
  if (fs::exists(path, error) && access(path.c_str(), W_OK) != 0) cannot_be_written(path, system_text(errno));
}

struct NamedFile {
  std::string option, path;
};

std::vector<NamedFile> inputs_of(const Options &options) {
  return {{"MESH", options.mesh},
          {"--surface", options.surface},
          {"--params", options.params},
          {"--params-open", options.params_open},
          {"--valve", is_valve_file(options.valve) ? options.valve : ""},
          {"--cycle", options.series.cycle},
          {"--case", options.series.case_file}};
}

std::vector<NamedFile> outputs_of(const Options &options) {
  std::vector<NamedFile> outputs = {{"--output", options.output}, {"--surface-output", options.surface_output}};
  for (const Picture &picture : options.pictures) outputs.push_back({"--picture", picture.path});
  if (options.stats != "-") outputs.push_back({"--stats", options.stats});
  outputs.push_back({"--movie", options.series.movie});
  outputs.push_back({"--series-table", options.series.table});
  if (options.states != "-") outputs.push_back({"--states", options.states});
  return outputs;
}

// Returns a text that all paths to a file share: its device and inode if it exists, otherwise its place.
std::string identity_of(const std::string &path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) return std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(path), error);
  return error ? path : place.string();
}

// The option that named a file, by the file's identity.
using KnownFiles = std::map<std::string, std::string>;

KnownFiles known_inputs(const Options &options, const std::vector<std::string> &more_inputs) {
  KnownFiles known;
  for (const NamedFile &input : inputs_of(options))
    if (!input.path.empty()) known.emplace(identity_of(input.path), input.option);
  const std::string option = options.series.case_file.empty() ? "--surface" : "--case";
  for (const std::string &path : more_inputs) known.emplace(identity_of(path), option);
  return known;
}

// A step's file must not replace an input. An input may stand in the folder under its own name, or be linked to from there.
void check_folder_of_steps(const std::string &option, const std::string &folder, const KnownFiles &inputs) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const auto input = inputs.find(identity_of(at->path().string()));
    if (input == inputs.end()) continue;
    throw Refusal{exit_wrong_usage,
                  option + ": the folder of its files, " + folder + ", holds the file of " + input->second};
  }
  if (error == std::errc::permission_denied)
    throw Refusal{exit_bad_data, folder + ": the folder cannot be read: " + error.message()};
}

void check_distinct(const Options &options, const std::vector<std::string> &more_inputs) {
  const KnownFiles inputs = known_inputs(options, more_inputs);
  KnownFiles outputs;
  for (const NamedFile &output : outputs_of(options)) {
    if (output.path.empty()) continue;
    const std::string identity = identity_of(output.path);
    const auto input = inputs.find(identity);
    const auto [other, is_new] = outputs.emplace(identity, output.option);
    if (input == inputs.end() && is_new) continue;
    throw Refusal{exit_wrong_usage,
                  output.option + ": " + output.path + " is also the file of " + (is_new ? input : other)->second};
  }
  if (options.series.times.empty()) return;
  for (const NamedFile &list : {NamedFile{"--output", options.output}, {"--surface-output", options.surface_output}})
    if (!list.path.empty()) check_folder_of_steps(list.option, SeriesFiles(list.path, "", 1).folder(), inputs);
}

// The component refuses the same, but only when it draws, after all other work.
void check_display() {
  const char *display = std::getenv("DISPLAY");
  if (display && *display) return;
  throw Refusal{exit_bad_data,
                "a picture needs an X display: DISPLAY is not set; on a machine without one, run the program by: "
                "xvfb-run -a PROGRAM"};
}

// Returns the system's error, or 0 if there is none.
int write_through(const std::string &path, const char *mode, const std::string &text) {
  std::FILE *file = std::fopen(path.c_str(), mode);
  if (!file) return errno;
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
  const int error = written ? 0 : errno;
  return std::fclose(file) == 0 || error ? error : errno;
}

int replace_file(const std::string &path, const std::string &text) {
  const UnbrokenWrite unbroken;
  const fs::path place = place_of(path);
  const std::string temporary = (folder_of(place) / (".riis-" + std::to_string(getpid()) + "-text.tmp")).string();
  std::remove(temporary.c_str());  // a file of this name belongs to a process that has ended
  int error = write_through(temporary, "wx", text);
  if (!error && std::rename(temporary.c_str(), place.c_str()) != 0) error = errno;
  if (error) std::remove(temporary.c_str());
  return error;
}

}  // namespace

bool has_ending(const std::string &path, const std::string &ending) {
  std::string found = fs::path(path).extension().string();
  for (char &c : found) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return found == ending;
}

fs::path place_of(const std::string &path) {
  std::error_code error;
  const fs::path place = fs::canonical(path, error);
  return error ? fs::path(path) : place;
}

fs::path folder_of(const fs::path &place) { return place.has_parent_path() ? place.parent_path() : fs::path("."); }

OutputLocks check_outputs(const Options &options, const std::vector<std::string> &more_inputs) {
  check_distinct(options, more_inputs);
  const auto check_file = [](const std::string &path, const char *ending, const char *option) {
    if (path.empty()) return;
    check_ending(path, ending, option);
    check_place(path);
  };
  const bool is_series = !options.series.times.empty();
  check_file(options.output, is_series ? ".pvd" : ".vtu", "--output");
  check_file(options.surface_output, is_series ? ".pvd" : ".vtp", "--surface-output");
  for (const Picture &picture : options.pictures) check_file(picture.path, ".png", "--picture");
  if (!options.stats.empty() && options.stats != "-") check_place(options.stats);
  if (!options.series.table.empty()) check_place(options.series.table);
  if (!options.states.empty() && options.states != "-") check_place(options.states);
  for (const std::string &list : {options.output, options.surface_output})
    if (is_series && !list.empty()) SeriesFiles(list, "", 1).check_folder();
  check_movie(options.series.movie);
  if (!options.series.movie.empty()) check_place(options.series.movie);
  if (!options.pictures.empty() || !options.series.movie.empty()) check_display();
  std::vector<std::string> written;
  for (const NamedFile &output : outputs_of(options))
    if (!output.path.empty() && !is_special(output.path)) written.push_back(output.path);
  return OutputLocks(written);
}

void check_no_output_is(const std::string &what, const std::vector<std::string> &files, const Options &options) {
  std::set<std::string> identities;
  for (const std::string &file : files) identities.insert(identity_of(file));
  for (const NamedFile &output : outputs_of(options)) {
    if (!output.path.empty() && identities.count(identity_of(output.path)) != 0)
      throw Refusal{exit_wrong_usage, output.option + ": " + output.path + " is " + what};
  }
}

bool can_be_replaced(const std::string &path) { return path != "-" && !is_special(path); }

void write_text(const std::string &path, const std::string &text) {
  if (path == "-") {
    if (!(std::cout << text << std::flush)) throw Refusal{exit_bad_data, "standard output: cannot be written"};
    return;
  }
  if (const int error = is_special(path) ? write_through(path, "w", text) : replace_file(path, text)) {
    cannot_be_written(path, system_text(error));
  }
}

}  // namespace riis::program
