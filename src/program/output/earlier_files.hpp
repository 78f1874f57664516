// SPDX-License-Identifier: Apache-2.0
// The files that an earlier run left in the folder of a series. They would be taken for further steps of this run's series.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace riis::program {

// The line that begins the lists that riis writes. Only what such a list names was written by riis.
extern const std::string list_of_riis;

// The name STEM_PART_0012.vtu of a step's file, or STEM_0012.vtu.
struct StepName {
  std::string part, digits, ending;
};

class EarlierFiles {
 public:
  // Finds the files of steps in the folder STEM beside the list STEM.pvd that this run does not write. Refuses a file that looks
  // like a step of this series, unless a list of riis names it, and a file that another list names.
  EarlierFiles(const std::string &list, const std::function<bool(const StepName &)> &is_written);

  void remove() const;
  std::size_t n() const { return paths_.size(); }

 private:
  std::vector<std::string> paths_;
};

}  // namespace riis::program
