// SPDX-License-Identifier: Apache-2.0
// A message is composed of words and numbers in memory of a fixed size. The message allocates nothing and depends on no locale.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace riis {

// A number that a message shows with n_digits significant digits. A plain double is shown with the fewest digits from which the
// same double can be read.
struct Rounded {
  double value;
  int n_digits;
};
inline Rounded rounded(double value, int n_digits) { return {value, n_digits}; }

inline constexpr std::size_t message_size = 512;

class Message {
 public:
  template <class... Parts>
  explicit Message(const Parts &...parts) noexcept {
    (add(parts), ...);
    text_[size_] = '\0';
  }

  const char *text() const { return text_; }

 private:
  // Adds words. Cuts off the part that does not fit.
  void add(std::string_view words) noexcept {
    const std::size_t n = std::min(words.size(), room());
    std::memcpy(text_ + size_, words.data(), n);
    size_ += n;
  }
  void add(const char *words) noexcept { add(std::string_view(words)); }
  void add(char letter) noexcept { add(std::string_view(&letter, 1)); }
  void add(double value) noexcept { add_number(value); }
  void add(const Rounded &number) noexcept { add_number(number.value, std::chars_format::general, number.n_digits); }
  template <class Integer>
  std::enable_if_t<std::is_integral_v<Integer>> add(Integer value) noexcept {
    static_assert(!std::is_same_v<Integer, bool>, "say what is true or false");
    add_number(value);
  }

  template <class... Number>
  void add_number(Number... number) noexcept {
    char digits[32];
    add(std::string_view(
        digits, static_cast<std::size_t>(std::to_chars(digits, digits + sizeof digits, number...).ptr - digits)));
  }

  std::size_t room() const { return message_size - 1 - size_; }

  char text_[message_size];
  std::size_t size_ = 0;
};

}  // namespace riis
