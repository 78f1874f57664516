// SPDX-License-Identifier: Apache-2.0
// Turns the fuzzer's bytes into choices, numbers and files. When all bytes are used up, every choice is 0, which is always
// harmless.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

// Ends the process if a harness finds a fault. The fuzzer then reports a crash and keeps the input.
#define EXPECT(condition, ...)                                                         \
  do {                                                                                 \
    if (!(condition)) {                                                                \
      std::fprintf(stderr, "%s:%d: expected: %s\n  ", __FILE__, __LINE__, #condition); \
      std::fprintf(stderr, __VA_ARGS__);                                               \
      std::fputc('\n', stderr);                                                        \
      std::abort();                                                                    \
    }                                                                                  \
  } while (0)

namespace fuzz {

class Input {
 public:
  Input(const std::uint8_t *bytes, std::size_t size) : next_(bytes), end_(bytes + size) {}

  bool is_used_up() const { return next_ == end_; }

  int byte() { return next_ == end_ ? 0 : *next_++; }

  // Returns a choice from 0 to n - 1. n is at most 256.
  int below(int n) { return byte() % n; }

  bool one_in(int n) { return below(n) == n - 1; }

  // Chooses one of three handles. The first handle is chosen most often, so that the first handles of several kinds are used
  // together.
  std::size_t slot() {
    const int k = byte();
    return static_cast<std::size_t>(k < 208 ? 0 : k % 3);
  }

  template <class T>
  T raw() {
    std::uint8_t bytes[sizeof(T)];
    for (std::uint8_t &b : bytes) b = static_cast<std::uint8_t>(byte());
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }

  template <class T, std::size_t n>
  T one_of(const T (&values)[n]) {
    return values[below(static_cast<int>(n))];
  }

  // Returns a double: a small number, the limit of a range, or arbitrary bits.
  double number() {
    static const double special[] = {
        0.0,     -0.0, 1.0,   -1.0,   std::nan(""), -std::nan(""), INFINITY, -INFINITY, DBL_MAX, 5e-324, DBL_MIN,
        -5e-324, 1e60, -1e60, 1.1e60, 1e-60,        9e-61,         1e30,     1.1e30,    1e50,    1e-50,  1e12,
        1e-12,   1e-6, 1e9,   1e-9,   0.05,         0.1,           0.5,      360,       1e6,     -1e50};
    const int k = byte();
    if (k < 128) return (k - 48) / 8.0;
    if (k < 224) return special[(k - 128) % 32];
    return raw<double>();
  }

  // Returns a coordinate. Most coordinates are on a coarse lattice, where points coincide and distances are equal.
  double place() {
    const int k = byte();
    if (k < 192) return (k - 96) / 32.0;
    if (k < 240) return (k - 216) / 16.0 + raw<std::int8_t>() / 4096.0;
    return number();
  }

  // Returns a coordinate that the library accepts.
  double sound_place() {
    const double x = place();
    return std::abs(x) <= 1e3 ? x : 1;
  }

  std::int32_t n_threads() {
    static const std::int32_t some[] = {1, 1, 1, 1, 1, 1,  1,    1,
                                        1, 1, 2, 3, 0, -1, 1025, std::numeric_limits<std::int32_t>::min()};
    return one_of(some);
  }

  // Returns the value. In one of 16 cases returns a wrong value.
  template <class T>
  T mostly(T value) {
    static const T wrong[] = {
        0, 1, 2, 3, 7, T(-1), T(-2), 16, std::numeric_limits<T>::max(), std::numeric_limits<T>::min()};
    return one_in(16) ? one_of(wrong) : value;
  }

 private:
  const std::uint8_t *next_, *end_;
};

// Returns the pointer. In one of 32 cases returns NULL.
template <class T>
T *mostly(Input &in, T *pointer) {
  return in.one_in(32) ? nullptr : pointer;
}

// An array of 32-bit or 64-bit integers, whose buffer has exactly the size of these integers.
class Integers {
 public:
  Integers(const std::vector<std::int64_t> &values, bool is_64_bits) : bytes_(values.size() * (is_64_bits ? 8 : 4)) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto narrow = static_cast<std::int32_t>(values[i]);
      if (is_64_bits)
        std::memcpy(bytes_.data() + 8 * i, &values[i], 8);
      else
        std::memcpy(bytes_.data() + 4 * i, &narrow, 4);
    }
  }
  const void *data() const { return bytes_.data(); }

 private:
  std::vector<unsigned char> bytes_;
};

// A file with a fixed name and the fuzzer's bytes. The file's folder belongs to this process.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string &name) {
    const char *folder = std::getenv("TMPDIR");
    std::string pattern = std::string(folder && *folder ? folder : "/tmp") + "/riis-fuzz-XXXXXX";
    EXPECT(mkdtemp(pattern.data()) != nullptr, "%s cannot be made", pattern.c_str());
    folder_ = pattern;
    open_file(pattern + "/" + name);
  }
  // Makes a file in the folder of `other`. `other` must outlive the new file.
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
