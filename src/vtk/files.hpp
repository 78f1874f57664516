// SPDX-License-Identifier: Apache-2.0
// Files before VTK sees them and after: endings, whether a file can be read at all, whether it is complete, and writing
// beside the final place.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace riis::vtk {

// The path's ending in lower case without the dot, "" if it has none.
std::string ending_of(const std::string &path);

// Fails unless the path is a regular, readable, non-empty file; VTK's own texts for these do not say why. Returns its
// size.
std::int64_t check_readable(const std::string &path);

// The last bytes of a file, at most n_bytes.
std::string tail_of(const std::string &path, std::int64_t n_bytes);

// A file's bytes, readable for the length of a scope.
class MappedFile {
 public:
  // size is what check_readable returned.
  MappedFile(const std::string &path, std::int64_t size);
  ~MappedFile();
  MappedFile(const MappedFile &) = delete;
  MappedFile &operator=(const MappedFile &) = delete;

  std::string_view bytes() const { return {static_cast<const char *>(bytes_), size_}; }

 private:
  std::size_t size_;
  void *bytes_;
};

// A file that is complete or not there: written under temporary(), a name in the same folder, and moved by commit().
// A file that it replaces leaves it its permissions. Without a commit the temporary file is removed and whatever stood
// in the final place is untouched.
class ReplacingFile {
 public:
  // Fails when the place cannot be written to: no such folder, no permission, not a regular file, a circle of links.
  explicit ReplacingFile(const std::string &path);
  ~ReplacingFile();
  ReplacingFile(const ReplacingFile &) = delete;
  ReplacingFile &operator=(const ReplacingFile &) = delete;

  const std::string &temporary() const { return temporary_; }
  // Writes the content, for those who have it in memory.
  void write(const unsigned char *bytes, std::int64_t n_bytes);
  // Fails unless the temporary file ends with the closing bytes, which a format writes last: a full disk stops a stream
  // early, and not every writer notices.
  void commit(const std::string &closing);

 private:
  std::string path_;   // as the caller gave it
  std::string place_;  // with links resolved: the file that a link points to is replaced or made, the link stays
  std::string temporary_;
};

}  // namespace riis::vtk
