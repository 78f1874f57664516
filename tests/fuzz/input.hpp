// SPDX-License-Identifier: Apache-2.0
// Turns the fuzzer's bytes into choices and numbers. After the last byte every choice is 0, and choice 0 is always harmless.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace fuzz {

class Input {
 public:
  Input(const std::uint8_t *bytes, std::size_t size) : next_(bytes), end_(bytes + size) {}

  bool is_used_up() const { return next_ == end_; }

  int byte() { return next_ == end_ ? 0 : *next_++; }

  // Returns a choice from 0 to n - 1. n is at most 256.
  int below(int n) { return byte() % n; }

  bool one_in(int n) { return below(n) == n - 1; }

  // Chooses one of three handles. Most choices are the first handle, so that handles of the same slot are used together.
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

  // Returns any double: a small one, the limit of a range, or arbitrary bits.
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

  // Returns a coordinate, mostly on a coarse lattice, where points coincide and distances are equal.
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

  // Returns the value, or in one of 16 cases a wrong value.
  template <class T>
  T mostly(T value) {
    static const T wrong[] = {
        0, 1, 2, 3, 7, T(-1), T(-2), 16, std::numeric_limits<T>::max(), std::numeric_limits<T>::min()};
    return one_in(16) ? one_of(wrong) : value;
  }

 private:
  const std::uint8_t *next_, *end_;
};

// Returns the pointer, or in one of 32 cases NULL.
template <class T>
T *mostly(Input &in, T *pointer) {
  return in.one_in(32) ? nullptr : pointer;
}

// An array of 32-bit or 64-bit integers, in a buffer of exactly their size.
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

}  // namespace fuzz
