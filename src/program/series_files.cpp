// SPDX-License-Identifier: Apache-2.0
#include "program/series_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "program/numbers.hpp"
#include "program/outputs.hpp"
#include "program/refusal.hpp"
#include "program/xml_text.hpp"

namespace riis::program {
SeriesFiles::SeriesFiles(const std::string &pvd, const std::string &ending, std::size_t n_times)
    : pvd_(pvd), ending_(ending), n_digits_(std::max<std::size_t>(4, std::to_string(n_times - 1).size())) {
  const std::filesystem::path path(pvd);
  stem_ = path.stem().string();
  folder_ = (path.parent_path() / stem_).string();
}

void SeriesFiles::check_folder() const {
  std::error_code error;
  if (!std::filesystem::exists(folder_, error)) return;
  if (!std::filesystem::is_directory(folder_, error))
    throw Refusal{exit_bad_data, folder_ + ": the folder cannot be made: a file has its name"};
  if (access(folder_.c_str(), W_OK | X_OK) != 0) {
    throw Refusal{exit_bad_data,
                  folder_ + ": the folder cannot be written to: " + std::generic_category().message(errno)};
  }
}

void SeriesFiles::make_folder() const {
  check_folder();
  std::error_code error;
  std::filesystem::create_directory(folder_, error);
  if (error) throw Refusal{exit_bad_data, folder_ + ": the folder cannot be made: " + error.message()};
}

std::string SeriesFiles::path_of(std::size_t step, const std::string &part) const {
  const std::string digits = std::to_string(step);
  const std::string zeros(n_digits_ > digits.size() ? n_digits_ - digits.size() : 0, '0');
  return folder_ + "/" + stem_ + "_" + (part.empty() ? "" : part + "_") + zeros + digits + ending_;
}

void SeriesFiles::add(double time, std::size_t part_number, const std::string &path) {
  entries_.push_back({time, part_number, stem_ + "/" + std::filesystem::path(path).filename().string()});
}

void SeriesFiles::write_list() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n";
  for (const Entry &entry : entries_) {
    text += "    <DataSet timestep=\"" + shortest(entry.time) + "\" part=\"" + std::to_string(entry.part_number) +
            "\" file=\"" + in_xml(entry.name) + "\"/>\n";
  }
  write_text(pvd_, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace riis::program
