// SPDX-License-Identifier: Apache-2.0
#include "cli/outputs.hpp"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "cli/refusal.hpp"

namespace riis::cli {
namespace {

namespace fs = std::filesystem;

void check_ending(const std::string &path, const std::string &ending, const std::string &option) {
  std::string found = fs::path(path).extension().string();
  for (char &c : found) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (found != ending) throw Refusal{exit_wrong_usage, option + ": " + path + " must end in " + ending};
}

void check_place(const std::string &path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw Refusal{exit_bad_data, path + ": is a directory"};
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  if (!fs::is_directory(folder, error)) {
    throw Refusal{exit_bad_data, path + ": cannot be written: the folder " + folder.string() + " does not exist"};
  }
  const bool exists = fs::exists(path, error);
  if (access((exists ? path : folder.string()).c_str(), W_OK) != 0) {
    throw Refusal{exit_bad_data, path + ": cannot be written: " + std::generic_category().message(errno)};
  }
}

}  // namespace

void check_outputs(const Options &options) {
  const auto check_file = [](const std::string &path, const char *ending, const char *option) {
    if (path.empty()) return;
    check_ending(path, ending, option);
    check_place(path);
  };
  check_file(options.output, ".vtu", "--output");
  check_file(options.surface_output, ".vtp", "--surface-output");
  for (const Picture &picture : options.pictures) check_file(picture.path, ".png", "--picture");
  if (!options.stats.empty() && options.stats != "-") check_place(options.stats);
}

void write_text(const std::string &path, const std::string &text) {
  if (path == "-") {
    if (!(std::cout << text << std::flush)) throw Refusal{exit_bad_data, "standard output: cannot be written"};
    return;
  }
  errno = 0;
  std::ofstream file(path);
  if (!(file << text << std::flush)) {
    throw Refusal{exit_bad_data, path + ": cannot be written: " + std::generic_category().message(errno)};
  }
}

}  // namespace riis::cli
