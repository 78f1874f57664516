// SPDX-License-Identifier: Apache-2.0
// riis export: a valve's opening and closing as files of svMultiPhysics, and the block of its input that names them.
#pragma once

#include <string>
#include <vector>

#include "program/options.hpp"

namespace riis::program {

// Writes the folder, and prints the block on stdout.
void export_uris(const ExportOptions &options);

// The folder of an export, which is complete or not there.

// A folder that gets its files when all of them are written. Until then the files are in a folder inside it, whose name begins
// with a dot. Without take_place() the destructor removes everything.
class WholeFolder {
 public:
  // Makes the folder, or takes an empty one. Throws a Refusal for any other folder, and for one that cannot be made or written
  // to. The Refusal names the option.
  WholeFolder(const std::string &path, const std::string &option);
  ~WholeFolder();
  WholeFolder(const WholeFolder &) = delete;
  WholeFolder &operator=(const WholeFolder &) = delete;

  // Returns the path at which the caller writes the file of this name. The file must be new.
  std::string new_file(const std::string &name);
  void take_place();

 private:
  std::string path_, unfinished_;
  bool was_made_ = false, is_whole_ = false;
  std::vector<std::string> names_;
};

// Throws a Refusal for a folder that WholeFolder would refuse, and changes nothing.
void check_whole_folder(const std::string &given, const std::string &option);

}  // namespace riis::program
