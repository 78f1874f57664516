// SPDX-License-Identifier: Apache-2.0
// The files of a series: one for each time in a folder, and the .pvd file beside the folder that lists them with their times.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace riis::program {

// cycle.pvd stands for cycle.pvd, cycle/cycle_0000.vtu, cycle/cycle_0001.vtu, ...
class SeriesFiles {
 public:
  // ending is that of the files, such as ".vtu".
  SeriesFiles(const std::string &pvd, const std::string &ending, std::size_t n_times);

  const std::string &pvd() const { return pvd_; }
  const std::string &folder() const { return folder_; }
  bool is_wanted() const { return !pvd_.empty(); }
  // Refuses a folder that cannot be written to, or that is a file.
  void check_folder() const;
  // Makes the folder if it is not there.
  void make_folder() const;
  // Returns the path of a step's file. part, a valve's name or "", tells several files of one step apart.
  std::string path_of(std::size_t step, const std::string &part) const;
  // Notes a file that is whole.
  void add(double time, std::size_t part_number, const std::string &path);
  std::size_t n_written() const { return entries_.size(); }
  // Writes the list of the files that are there.
  void write_list() const;

 private:
  struct Entry {
    double time;
    std::size_t part_number;
    std::string name;  // as seen from the .pvd
  };
  std::string pvd_, folder_, stem_, ending_;
  std::size_t n_digits_;
  std::vector<Entry> entries_;
};

}  // namespace riis::program
