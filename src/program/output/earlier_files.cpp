// SPDX-License-Identifier: Apache-2.0
#include "program/output/earlier_files.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

#include "common/xml_text.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"

namespace riis::program {
namespace {

namespace fs = std::filesystem;

// Returns the values of all attributes "file" of a list, as they stand in the file.
std::set<std::string> files_named_in(const std::string &text) {
  static const std::string begin = " file=\"";
  std::set<std::string> names;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    names.insert(text.substr(at, text.find('"', at) - at));
  }
  return names;
}

std::optional<StepName> step_name_of(const std::string &stem, const fs::path &path) {
  constexpr std::size_t fewest_digits = 4;
  const std::string name = path.stem().string(), ending = path.extension().string();
  if (ending != ".vtu" && ending != ".vtp" && ending != ".pvtu") return std::nullopt;
  std::size_t digits = name.size();
  while (digits > 0 && std::isdigit(static_cast<unsigned char>(name[digits - 1])) != 0) --digits;
  if (name.size() - digits < fewest_digits || digits <= stem.size() || name[digits - 1] != '_' ||
      name.compare(0, stem.size() + 1, stem + "_") != 0)
    return std::nullopt;
  StepName made{"", name.substr(digits), ending};
  if (digits > stem.size() + 1) made.part = name.substr(stem.size() + 1, digits - stem.size() - 2);
  return made;
}

bool is_file(const fs::path &path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// Refuses to remove files that a list of another name has.
void check_other_lists(const fs::path &list, const std::set<std::string> &removed) {
  std::error_code error;
  const fs::path folder = list.has_parent_path() ? list.parent_path() : fs::path(".");
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const fs::path &other = at->path();
    if (other.extension() != ".pvd" || other.filename() == list.filename() || !is_file(other)) continue;
    for (const std::string &name : files_named_in(text_of_file(other.string())))
      if (removed.count(name) != 0)
        refuse_data(other.string() + " names " + name + ", a step of an earlier " + list.string() +
                    " that this run would remove: name another output");
  }
}

}  // namespace

const std::string list_of_riis =
    "<?xml version=\"1.0\"?>\n<!-- written by riis -->\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n";

bool StepName::is_of_piece() const {
  return part.size() >= 5 && part[0] == 'p' && part.find_first_not_of("0123456789", 1) == std::string::npos;
}

EarlierFiles::EarlierFiles(const std::string &list, const std::function<StepKind(const StepName &)> &kind_of) {
  const std::string stem = fs::path(list).stem().string();
  const fs::path folder = fs::path(list).parent_path() / stem;
  std::set<std::string> listed, removed, listed_digits;
  if (is_file(list)) {
    const std::string text = text_of_file(list);
    if (text.compare(0, list_of_riis.size(), list_of_riis) == 0) listed = files_named_in(text);
  }
  const auto in_list = [&](const fs::path &path) { return in_xml(stem + "/" + path.filename().string()); };
  for (const std::string &name : listed)
    if (const auto step = step_name_of(stem, fs::path(name).filename())) listed_digits.insert(step->digits);
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const fs::path &path = at->path();
    const auto step = step_name_of(stem, path.filename());
    const StepKind kind = step ? kind_of(*step) : StepKind::written;
    if (kind == StepKind::written) continue;
    const bool is_of_riis =
        listed.count(in_list(path)) != 0 || (step->is_of_piece() && listed_digits.count(step->digits) != 0);
    if (is_of_riis) {
      paths_.push_back(path.string());
      removed.insert(in_list(path));
    } else if (kind == StepKind::further) {
      refuse_data(path.string() + " would be taken for a step of " + list +
                  ", and no list of riis names it: remove it, or name another output");
    }
  }
  if (!removed.empty()) check_other_lists(list, removed);
}

void EarlierFiles::remove() const {
  for (const std::string &path : paths_) {
    std::error_code error;
    fs::remove(path, error);
    if (error) refuse_data(path + ": a file of an earlier run cannot be removed: " + error.message());
  }
}

}  // namespace riis::program
