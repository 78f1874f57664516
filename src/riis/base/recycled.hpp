// SPDX-License-Identifier: Apache-2.0
// Arrays whose memory is kept for later arrays. An update of a surface makes and drops about a thousand short arrays. In a time
// loop, the memory of these arrays comes from the previous update, not from the system.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace riis {

// Arrays whose resize() does not initialise new elements. A large array is therefore written only once, when its owner fills it.

// An allocator that takes its memory from the allocator `Memory`, and does not initialise new elements.
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

// Returns memory for n_bytes bytes, aligned for any fundamental type. Throws std::bad_alloc. Any thread may give the memory
// back.
void *take_memory(std::size_t n_bytes);
void give_memory_back(void *memory, std::size_t n_bytes) noexcept;

// Frees the memory that is kept now. Call this function after work that has taken much more memory than a time step.
void free_kept_memory() noexcept;

// Memory is kept while at least one object of this type exists. When the last such object is destroyed, the memory is freed.
class KeepsMemory {
 public:
  KeepsMemory() noexcept;
  ~KeepsMemory();
  KeepsMemory(const KeepsMemory &) = delete;
  KeepsMemory &operator=(const KeepsMemory &) = delete;
};

template <class T>
struct RecyclingAllocator {
  using value_type = T;
  using is_always_equal = std::true_type;

  RecyclingAllocator() = default;
  template <class U>
  RecyclingAllocator(const RecyclingAllocator<U> &) noexcept {
  }  // NOLINT(google-explicit-constructor): as std::allocator

  T *allocate(std::size_t n) {
    static_assert(alignof(T) <= alignof(std::max_align_t));
    if (n > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_alloc();
    return static_cast<T *>(take_memory(n * sizeof(T)));
  }
  void deallocate(T *memory, std::size_t n) noexcept { give_memory_back(memory, n * sizeof(T)); }

  template <class U>
  bool operator==(const RecyclingAllocator<U> &) const noexcept {
    return true;
  }
  template <class U>
  bool operator!=(const RecyclingAllocator<U> &) const noexcept {
    return false;
  }
};

template <class T>
using Vector = std::vector<T, RecyclingAllocator<T>>;

// After resize(), every new element must be written before it is read, as in an UnfilledVector.
template <class T>
using UnfilledShortVector = std::vector<T, UnfilledAllocator<T, RecyclingAllocator>>;

}  // namespace riis
