// SPDX-License-Identifier: Apache-2.0
// Writes the fuzzer's bytes to a file with a fixed name, in a folder that belongs to this process.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "expect.hpp"

namespace fuzz {

class ScratchFile {
 public:
  explicit ScratchFile(const std::string &name) {
    const char *folder = std::getenv("TMPDIR");
    std::string pattern = std::string(folder && *folder ? folder : "/tmp") + "/riis-fuzz-XXXXXX";
    EXPECT(mkdtemp(pattern.data()) != nullptr, "%s cannot be made", pattern.c_str());
    folder_ = pattern;
    open_file(pattern + "/" + name);
  }
  // Makes a file in the folder of `other`. The file `other` must live longer than this one.
  ScratchFile(const ScratchFile &other, const std::string &name) { open_file(other.folder_ + "/" + name); }
  ~ScratchFile() {
    close(file_);
    std::remove(path_.c_str());
    if (!folder_.empty()) rmdir(folder_.c_str());
  }
  ScratchFile(const ScratchFile &) = delete;
  ScratchFile &operator=(const ScratchFile &) = delete;

  void hold(const std::uint8_t *bytes, std::size_t size) const {
    EXPECT(pwrite(file_, bytes, size, 0) == static_cast<ssize_t>(size), "%s cannot be written", path_.c_str());
    EXPECT(ftruncate(file_, static_cast<off_t>(size)) == 0, "%s cannot be cut", path_.c_str());
  }

  const std::string &path() const { return path_; }

 private:
  void open_file(const std::string &path) {
    path_ = path;
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    EXPECT(file_ >= 0, "%s cannot be made", path_.c_str());
  }

  std::string folder_;  // the folder, if this file made it
  std::string path_;
  int file_ = -1;
};

}  // namespace fuzz
