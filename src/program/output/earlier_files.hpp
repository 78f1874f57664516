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

  bool is_of_piece() const;  // whether the part is that of a piece of a mesh, such as p0012
};

// What a file is for this run: it is written, it looks like a further step of the same series, or neither.
enum class StepKind { written, further, other };

class EarlierFiles {
 public:
  // Finds the files of steps in the folder STEM beside the list STEM.pvd that this run does not write, if that list is by riis
  // and names them. Refuses further steps that it does not name, and files that another list names.
  EarlierFiles(const std::string &list, const std::function<StepKind(const StepName &)> &kind_of);

  void remove() const;
  std::size_t n() const { return paths_.size(); }

 private:
  std::vector<std::string> paths_;
};

}  // namespace riis::program
