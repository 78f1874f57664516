// SPDX-License-Identifier: Apache-2.0
// Locks on the program's outputs: of two runs that would replace one file, only the first goes on.
#pragma once

#include <string>
#include <vector>

namespace riis::program {

// Holds an empty file .riis-NAME.lock beside each output NAME, locked by flock. The kernel ends the lock with its process,
// however that ends. The file is removed when the object ends, and by SIGINT, SIGTERM and SIGHUP. A run that is killed leaves
// the file behind; the next run takes it over.
class OutputLocks {
 public:
  // Throws a Refusal if another run holds the lock of one of these files. The paths name no devices or pipes.
  explicit OutputLocks(const std::vector<std::string> &paths);
  ~OutputLocks();
  OutputLocks(OutputLocks &&other) noexcept = default;
  OutputLocks(const OutputLocks &) = delete;
  OutputLocks &operator=(const OutputLocks &) = delete;

 private:
  void release();

  std::vector<int> files_;  // empty once moved from
};

}  // namespace riis::program
