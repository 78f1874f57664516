// SPDX-License-Identifier: Apache-2.0
// Limits a harness's memory. A single request for too much memory must fail by an exception or by NULL, as it does without a
// sanitizer. The address sanitizer's operator new would end the process instead.
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t largest = std::size_t{512} << 20;

void *allocated_or_null(std::size_t size) noexcept { return size <= largest ? std::malloc(size ? size : 1) : nullptr; }

void *allocated(std::size_t size) {
  void *const memory = allocated_or_null(size);
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

void *operator new(std::size_t size) { return allocated(size); }
void *operator new[](std::size_t size) { return allocated(size); }
void *operator new(std::size_t size, const std::nothrow_t &) noexcept { return allocated_or_null(size); }
void *operator new[](std::size_t size, const std::nothrow_t &) noexcept { return allocated_or_null(size); }
void operator delete(void *memory) noexcept { std::free(memory); }
void operator delete[](void *memory) noexcept { std::free(memory); }
void operator delete(void *memory, const std::nothrow_t &) noexcept { std::free(memory); }
void operator delete[](void *memory, const std::nothrow_t &) noexcept { std::free(memory); }
void operator delete(void *memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void *memory, std::size_t) noexcept { std::free(memory); }

extern "C" const char *__asan_default_options() {
  return "print_suppressions=0:allocator_may_return_null=1:max_allocation_size_mb=512:detect_stack_use_after_return=0";
}

// VTK's readers leak memory on files that they refuse. Such leaks are not faults of riis.
extern "C" const char *__lsan_default_suppressions() { return "leak:libvtk\n"; }
