// SPDX-License-Identifier: Apache-2.0
#include "program/uris_files.hpp"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "program/outputs.hpp"
#include "program/refusal.hpp"

namespace riis::program {
namespace {

namespace fs = std::filesystem;

std::string without_last_slashes(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

[[noreturn]] void refuse_folder(const std::string &option, const std::string &path, const std::string &reason) {
  throw Refusal{exit_bad_data, option + ": " + path + ": " + reason};
}

void check_writable(const std::string &option, const std::string &path, const std::string &folder) {
  if (access(folder.c_str(), W_OK | X_OK) == 0) return;
  refuse_folder(option, path,
                "the folder " + folder + " cannot be written to: " + std::generic_category().message(errno));
}

}  // namespace

void check_whole_folder(const std::string &given, const std::string &option) {
  const std::string path = without_last_slashes(given);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    const std::string parent = folder_of(path).string();
    if (!fs::is_directory(parent, error)) refuse_folder(option, path, "the folder " + parent + " does not exist");
    return check_writable(option, path, parent);
  }
  if (!fs::is_directory(status)) refuse_folder(option, path, "is a file, not a folder");
  const bool is_empty = fs::is_empty(path, error);
  if (error) refuse_folder(option, path, "cannot be read: " + error.message());
  if (!is_empty) refuse_folder(option, path, "the folder is not empty");
  check_writable(option, path, path);
}

WholeFolder::WholeFolder(const std::string &path, const std::string &option)
    : path_(without_last_slashes(path)), unfinished_(path_ + "/.riis-" + std::to_string(getpid()) + ".tmp") {
  check_whole_folder(path_, option);
  std::error_code error;
  was_made_ = fs::create_directory(path_, error);
  if (!error) fs::create_directory(unfinished_, error);
  if (!error) return;
  if (was_made_) fs::remove(path_, error);
  refuse_folder(option, path_, "cannot be made: " + error.message());
}

WholeFolder::~WholeFolder() {
  if (is_whole_) return;
  std::error_code error;
  for (const std::string &name : names_) fs::remove(path_ + "/" + name, error);
  fs::remove_all(unfinished_, error);
  if (was_made_) fs::remove(path_, error);
}

std::string WholeFolder::new_file(const std::string &name) {
  names_.push_back(name);
  return unfinished_ + "/" + name;
}

void WholeFolder::take_place() {
  for (const std::string &name : names_) {
    std::error_code error;
    fs::rename(unfinished_ + "/" + name, path_ + "/" + name, error);
    if (error) throw Refusal{exit_bad_data, path_ + "/" + name + ": cannot be written: " + error.message()};
  }
  std::error_code error;
  fs::remove(unfinished_, error);
  is_whole_ = true;
}

}  // namespace riis::program
