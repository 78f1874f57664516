// SPDX-License-Identifier: Apache-2.0
// Arrays whose resize() leaves new elements without a value. So a large array is written once, when its owner fills it, and
// not twice.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace riis {

// An allocator that takes its memory from the allocator `Memory` and leaves new elements without a value.
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

// After resize(), every new element must be written before it is read.
template <class T>
using UnfilledVector = std::vector<T, UnfilledAllocator<T, std::allocator>>;

}  // namespace riis
