// SPDX-License-Identifier: Apache-2.0
// Endings of files, checks that a file can be read and is complete, and writing beside the final place. VTK does the rest.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace riis::vtk {

// Returns the path's ending in lower case without the dot, or "" if it has none.
std::string ending_of(const std::string &path);

// Returns the file's size. Fails unless the path is a regular, readable, non-empty file: VTK's own messages do not say why.
std::int64_t check_readable(const std::string &path);

// Returns the last bytes of a file, at most n_bytes.
std::string tail_of(const std::string &path, std::int64_t n_bytes);

// A file's bytes, readable while this object lives.
class MappedFile {
 public:
  // size is the result of check_readable.
  MappedFile(const std::string &path, std::int64_t size);
  ~MappedFile();
  MappedFile(const MappedFile &) = delete;
  MappedFile &operator=(const MappedFile &) = delete;

  std::string_view bytes() const { return {static_cast<const char *>(bytes_), size_}; }

 private:
  std::size_t size_;
  void *bytes_;
};

// A file that is complete or not there. It is written under temporary(), a name in the same folder, and moved by commit(). It
// takes over the permissions of a file that it replaces. Without a commit the temporary file is removed and the final place is
// untouched.
class ReplacingFile {
 public:
  // Fails if the place cannot be written to: no such folder, no permission, not a regular file, or a circle of links.
  explicit ReplacingFile(const std::string &path);
  ~ReplacingFile();
  ReplacingFile(const ReplacingFile &) = delete;
  ReplacingFile &operator=(const ReplacingFile &) = delete;

  const std::string &temporary() const { return temporary_; }
  // Writes content that is in memory.
  void write(const unsigned char *bytes, std::int64_t n_bytes);
  // Fails unless the temporary file ends with the closing bytes, which a format writes last. A full disk stops a stream early,
  // and not every writer notices.
  void commit(const std::string &closing);

 private:
  std::string path_;   // as the caller gave it
  std::string place_;  // with links resolved: a link stays, and the file that it points to is replaced or made
  std::string temporary_;
};

}  // namespace riis::vtk
