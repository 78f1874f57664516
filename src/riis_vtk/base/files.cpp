// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/base/files.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <vtkAbstractArray.h>
#include <vtkFieldData.h>

namespace riis::vtk {
namespace {

std::string system_text(int error) { return std::generic_category().message(error); }

// Follows links, and returns the path of the file to which they lead. This file need not exist.
std::string resolved(const std::string &path) {
  std::filesystem::path place = path;
  for (int n_links_left = 40; std::filesystem::is_symlink(place); --n_links_left) {
    if (n_links_left == 0) throw std::system_error(ELOOP, std::generic_category());
    place = place.parent_path() / std::filesystem::read_symlink(place);
  }
  return place.string();
}

// Creates an empty file with a new name in the folder of `place`, and returns its path. `replaced` describes the file at `place`,
// or is NULL if there is none. While the new file is still empty, it gets the permissions of the replaced file.
std::string create_beside(const std::string &place, const struct stat *replaced) {
  static int n_created = 0;
  const std::filesystem::path folder = std::filesystem::path(place).parent_path();
  for (;;) {
    const std::string name = ".riis-" + std::to_string(getpid()) + "-" + std::to_string(n_created++) + ".tmp";
    std::string path = (folder / name).string();  // returned without a copy, because a copy could fail and leave the
                                                  // file
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) {
      // The owner of the new file always gets permission to read and write, because the writer opens the file again. A file
      // system without permissions may refuse the call, but this does no harm.
      if (replaced) static_cast<void>(fchmod(file, (replaced->st_mode & 0777) | S_IRUSR | S_IWUSR));
      close(file);
      return path;
    }
    if (errno != EEXIST) throw std::system_error(errno, std::generic_category());
  }
}

// Waits until the data is on the disk, because some file systems report a failed write only then.
int synchronise(const std::string &path) {
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = fsync(file) == 0 ? 0 : errno;
  close(file);
  return error;
}

// Returns the last bytes of a file, at most n_bytes.
std::string tail_of(const std::string &path, std::int64_t n_bytes) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::int64_t size = file ? static_cast<std::int64_t>(file.tellg()) : 0;
  std::string tail(static_cast<std::size_t>(std::min(size, n_bytes)), '\0');
  file.seekg(size - static_cast<std::int64_t>(tail.size()));
  if (!file.read(tail.data(), static_cast<std::streamsize>(tail.size()))) tail.clear();
  return tail;
}

}  // namespace

std::string list_of_arrays(vtkFieldData *data) {
  std::string list;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    const char *name = data->GetAbstractArray(i)->GetName();
    list += (list.empty() ? "; there are: " : ", ") + std::string(name ? name : "one without a name");
  }
  return list.empty() ? "; there is none" : list;
}

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char &c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

std::string_view take_line(std::string_view &text) {
  const std::size_t length = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return line;
}

std::string_view take_word(std::string_view &text) {
  const auto begin = std::find_if_not(text.begin(), text.end(), is_blank);
  const auto end = std::find_if(begin, text.end(), is_blank);
  const std::string_view word =
      text.substr(static_cast<std::size_t>(begin - text.begin()), static_cast<std::size_t>(end - begin));
  text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  return word;
}

std::string ending_of(const std::string &path) {
  std::string ending = std::filesystem::path(path).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  return lower_case(ending);
}

namespace {

// The beginning of a pointer file of Git LFS. A pointer file is a small text file in place of a large file.
constexpr std::string_view lfs_pointer = "version https://git-lfs.github.com/spec/";
constexpr off_t largest_lfs_pointer = 1024;

}  // namespace

std::int64_t check_readable(const std::string &path) {
  struct stat status;
  if (stat(path.c_str(), &status) != 0) fail_file(path, "cannot be read: ", system_text(errno));
  if (S_ISDIR(status.st_mode)) fail_file(path, "is a directory");
  if (!S_ISREG(status.st_mode)) fail_file(path, "is not a regular file");
  if (access(path.c_str(), R_OK) != 0) fail_file(path, "cannot be read: ", system_text(errno));
  if (status.st_size == 0) fail_file(path, "is empty");
  if (status.st_size <= largest_lfs_pointer) {
    const MappedFile file(path, status.st_size);
    if (file.bytes().rfind(lfs_pointer, 0) == 0)
      fail_file(path, "is a pointer of Git LFS, not the file itself: git lfs pull fetches the file");
  }
  return status.st_size;
}

MappedFile::MappedFile(const std::string &path, std::int64_t size) : size_(static_cast<std::size_t>(size)) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  bytes_ = file < 0 ? MAP_FAILED : mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
  const int error = errno;
  if (file >= 0) close(file);
  if (bytes_ == MAP_FAILED) fail_file(path, "cannot be read: ", system_text(error));
}

MappedFile::~MappedFile() { munmap(bytes_, size_); }

ReplacingFile::ReplacingFile(const std::string &path) : path_(path) {
  struct stat status;
  const bool exists = stat(path.c_str(), &status) == 0;
  if (exists) {
    if (S_ISDIR(status.st_mode)) fail_file(path, "is a directory");
    if (!S_ISREG(status.st_mode)) fail_file(path, "is not a regular file");
    if (access(path.c_str(), W_OK) != 0) fail_file(path, "cannot be written: ", system_text(errno));
  }
  try {
    place_ = resolved(path);
    temporary_ = create_beside(place_, exists ? &status : nullptr);
  } catch (const std::system_error &error) {
    fail_file(path, "cannot be written: ", system_text(error.code().value()));
  }
}

ReplacingFile::~ReplacingFile() {
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void ReplacingFile::write(const unsigned char *bytes, std::int64_t n_bytes) {
  std::ofstream file(temporary_, std::ios::binary);
  file.write(reinterpret_cast<const char *>(bytes), n_bytes);
  if (!file.flush()) fail_file(path_, "cannot be written: ", system_text(errno));
}

void ReplacingFile::commit(const std::string &closing) {
  if (const int error = synchronise(temporary_)) fail_file(path_, "cannot be written: ", system_text(error));
  if (tail_of(temporary_, 64).find(closing) == std::string::npos) {
    fail_file(path_, "could not be written completely (is the disk full?)");
  }
  if (std::rename(temporary_.c_str(), place_.c_str()) != 0) {
    fail_file(path_, "cannot be written: ", system_text(errno));
  }
  temporary_.clear();
}

}  // namespace riis::vtk
