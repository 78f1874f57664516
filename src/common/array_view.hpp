// SPDX-License-Identifier: Apache-2.0
// Makes views of containers, and resizes containers, with counts and positions of type int64_t. The whole project uses this type.
// Counts and positions are never negative. The containers' own functions take std::size_t, so this file converts between the two
// types.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <type_traits>

namespace riis {

// A view of the elements of an array. The owner must keep the array while the view is used.
template <class T>
class ArrayView {
 public:
  constexpr ArrayView(T *data, std::int64_t size) : data_(data), size_(size) {}

  constexpr T &operator[](std::int64_t i) const {
#if defined(_GLIBCXX_ASSERTIONS)  // with this macro the standard containers check positions, and so does this view
    if (i < 0 || i >= size_) std::abort();
#endif
    return data_[i];
  }
  constexpr std::int64_t size() const { return size_; }
  constexpr T *begin() const { return data_; }
  constexpr T *end() const { return data_ + size_; }

 private:
  T *data_;
  std::int64_t size_;
};

// Makes a view of a std::vector, a std::array or a C array. Do not use the view after the container has moved its elements.
template <class Container>
constexpr auto view(Container &container) {
  return ArrayView<std::remove_pointer_t<decltype(std::data(container))>>(
      std::data(container), static_cast<std::int64_t>(std::size(container)));
}

template <class Container>
void resize(Container &container, std::int64_t n) {
  container.resize(static_cast<std::size_t>(n));
}

}  // namespace riis
