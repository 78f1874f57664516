// SPDX-License-Identifier: Apache-2.0
// riis export: writes a valve's opening and closing as files for svMultiPhysics, and prints the block of the solver's input that
// names these files.
#pragma once

#include <string>
#include <vector>

#include "program/base/options.hpp"

namespace riis::program {

// Writes the folder, and prints the block on stdout.
void export_uris(const ExportOptions &options);

// A folder that receives its files only when all of them are written. Until then the files are in a folder inside it whose name
// begins with a dot. If take_place() was not called, the destructor removes everything.
class WholeFolder {
 public:
  // Makes the folder, or uses an empty one. Throws a Refusal for a folder that is not empty, that cannot be made or that cannot
  // be written to. The Refusal names the option.
  WholeFolder(const std::string &path, const std::string &option);
  ~WholeFolder();
  WholeFolder(const WholeFolder &) = delete;
  WholeFolder &operator=(const WholeFolder &) = delete;

  // Returns the path at which the caller must write the file with this name. The name must be new.
  std::string new_file(const std::string &name);
  void take_place();

 private:
  std::string path_, unfinished_;
  bool was_made_ = false, is_whole_ = false;
  std::vector<std::string> names_;
};

// Throws a Refusal for a folder that WholeFolder would refuse. Changes nothing.
void check_whole_folder(const std::string &given, const std::string &option);

// The openings of the frames. The solver plays the first list when the valve begins to open, and the second when it begins to
// close. Each time step plays one frame.
struct UrisMotion {
  std::vector<double> opening, closing;
};

// Frames are one time step apart. The last frame is at the end of the span, so the last step may be shorter.
UrisMotion uris_motion_of(const ExportOptions &options);

}  // namespace riis::program
