// SPDX-License-Identifier: Apache-2.0
// Arrays whose new elements have no value yet. resize() does not write them, so that a large array goes to memory once: when its
// owner fills it.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace riis {

// Takes its memory from another allocator.
template <class T, template <class> class Memory>
struct UnfilledAllocator : Memory<T> {
  static_assert(std::is_trivially_default_constructible_v<T>);
  template <class U>
  struct rebind {
    using other = UnfilledAllocator<U, Memory>;
  };

  template <class U>
  void construct(U *) noexcept {}  // the element starts its life without a value
  template <class U, class... Arguments>
  void construct(U *at, Arguments &&...arguments) {
    ::new (static_cast<void *>(at)) U(std::forward<Arguments>(arguments)...);
  }
};

// Every element must be written after resize().
template <class T>
using UnfilledVector = std::vector<T, UnfilledAllocator<T, std::allocator>>;

}  // namespace riis
