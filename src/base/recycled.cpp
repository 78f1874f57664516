// SPDX-License-Identifier: Apache-2.0
#include "base/recycled.hpp"

#include <array>
#include <mutex>
#include <utility>

namespace riis {
namespace {

// Blocks have 2^k bytes, from 64 bytes to 4 MiB. A block that is kept holds the address of the next one of its size. Larger
// arrays are rare, and their memory is worth more than the time to allocate it again.
struct Block {
  Block *next;
};
constexpr int smallest = 6, largest = 22;
constexpr std::size_t largest_block = std::size_t{1} << largest;

struct Pool {
  std::mutex mutex;
  std::array<Block *, largest - smallest + 1> kept{};
  int n_keepers = 0;
};

// It needs neither a constructor nor a destructor at run time, so arrays of other static objects may outlive everything.
Pool pool;

int size_class(std::size_t n_bytes) {
  int k = smallest;
  while ((std::size_t{1} << k) < n_bytes) ++k;
  return k;
}

}  // namespace

// A sanitizer that watches memory has to see each array come and go.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define RIIS_OWN_MEMORY
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define RIIS_OWN_MEMORY
#endif
#endif

#if defined(RIIS_OWN_MEMORY)

void *take_memory(std::size_t n_bytes) { return ::operator new(n_bytes); }
void give_memory_back(void *memory, std::size_t) noexcept { ::operator delete(memory); }
KeepsMemory::KeepsMemory() noexcept = default;
KeepsMemory::~KeepsMemory() = default;

#else

void *take_memory(std::size_t n_bytes) {
  if (n_bytes > largest_block) return ::operator new(n_bytes);
  const int k = size_class(n_bytes);
  {
    const std::lock_guard<std::mutex> lock(pool.mutex);
    Block *&first = pool.kept[static_cast<std::size_t>(k - smallest)];
    if (first) {
      Block *taken = first;
      first = taken->next;
      return taken;
    }
  }
  return ::operator new (std::size_t{1} << k);
}

void give_memory_back(void *memory, std::size_t n_bytes) noexcept {
  if (n_bytes <= largest_block) {
    const std::lock_guard<std::mutex> lock(pool.mutex);
    if (pool.n_keepers > 0) {
      Block *&first = pool.kept[static_cast<std::size_t>(size_class(n_bytes) - smallest)];
      first = new (memory) Block{first};
      return;
    }
  }
  ::operator delete(memory);
}

KeepsMemory::KeepsMemory() noexcept {
  const std::lock_guard<std::mutex> lock(pool.mutex);
  ++pool.n_keepers;
}

KeepsMemory::~KeepsMemory() {
  std::array<Block *, largest - smallest + 1> freed{};
  {
    const std::lock_guard<std::mutex> lock(pool.mutex);
    if (--pool.n_keepers == 0) freed.swap(pool.kept);
  }
  for (Block *block : freed)
    while (block) ::operator delete(std::exchange(block, block->next));
}

#endif

}  // namespace riis
