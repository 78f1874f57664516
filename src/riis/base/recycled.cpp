// SPDX-License-Identifier: Apache-2.0
#include "base/recycled.hpp"

#include <pthread.h>

#include <array>
#include <atomic>
#include <mutex>
#include <thread>
#include <utility>

// A sanitizer has to see every allocation and release, so no memory is recycled under a sanitizer.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define RIIS_OWN_MEMORY
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define RIIS_OWN_MEMORY
#endif
#endif

namespace riis {

#if defined(RIIS_OWN_MEMORY)

void *take_memory(std::size_t n_bytes) { return ::operator new(n_bytes); }
void give_memory_back(void *memory, std::size_t) noexcept { ::operator delete(memory); }
void free_kept_memory() noexcept {}
KeepsMemory::KeepsMemory() noexcept = default;
KeepsMemory::~KeepsMemory() = default;

#else

namespace {

// Blocks have 2^k bytes, from 64 bytes to 4 MiB. The kept blocks of a size form a list: each holds the address of the next.
// Larger arrays are rare, so keeping their memory would cost more than allocating it again.
struct Block {
  Block *next;
};
constexpr int smallest_class = 6, largest_class = 22;
constexpr std::size_t largest_block = std::size_t{1} << largest_class;

// A thread first takes memory from its own pool, so threads seldom wait for each other. The thread that gives memory back may not
// be the thread that took it, so one pool can run empty while other pools fill up. A thread with an empty pool therefore looks
// into the other pools before it asks the system.
constexpr unsigned n_pools = 16;

// A lock that threads hold only for a few instructions, so a thread that finds it locked just tries again. Locking a mutex would
// take half of the time of an allocation.
class ShortLock {
 public:
  void lock() noexcept {
    while (is_held_.exchange(true, std::memory_order_acquire)) std::this_thread::yield();
  }
  void unlock() noexcept { is_held_.store(false, std::memory_order_release); }

 private:
  std::atomic<bool> is_held_{false};
};

struct alignas(64) Pool {
  ShortLock in_use;
  std::array<Block *, largest_class - smallest_class + 1> kept{};

  // Returns a kept block of this size class, or null if there is none.
  Block *take(std::size_t size) {
    const std::lock_guard<ShortLock> lock(in_use);
    Block *first = kept[size];
    if (first) kept[size] = first->next;
    return first;
  }
};

// The pools are initialised at compile time and never destroyed, so arrays in static objects may use them until the process ends.
std::array<Pool, n_pools> pools;
std::atomic<int> n_keepers{0};

unsigned own_pool() {
  static std::atomic<unsigned> n_threads{0};
  thread_local const unsigned own = n_threads.fetch_add(1, std::memory_order_relaxed) % n_pools;
  return own;
}

// A process may be forked while another thread holds a pool's lock. The child lacks that thread, so its lock would stay locked.
// Therefore the forking thread takes all locks first.
bool prepare_for_forks() noexcept {
  const auto unlock = [] {
    for (Pool &pool : pools) pool.in_use.unlock();
  };
  return pthread_atfork(
             [] {
               for (Pool &pool : pools) pool.in_use.lock();
             },
             unlock, unlock) == 0;
}

int size_class(std::size_t n_bytes) {
  int k = smallest_class;
  while ((std::size_t{1} << k) < n_bytes) ++k;
  return k;
}

}  // namespace

void *take_memory(std::size_t n_bytes) {
  if (n_bytes > largest_block) return ::operator new(n_bytes);
  const int k = size_class(n_bytes);
  if (n_keepers.load(std::memory_order_relaxed) > 0)
    for (unsigned i = 0, own = own_pool(); i < n_pools; ++i)
      if (Block *taken = pools[(own + i) % n_pools].take(static_cast<std::size_t>(k - smallest_class))) return taken;
  return ::operator new (std::size_t{1} << k);
}

void give_memory_back(void *memory, std::size_t n_bytes) noexcept {
  if (n_bytes <= largest_block) {
    Pool &to = pools[own_pool()];
    const std::lock_guard<ShortLock> lock(to.in_use);
    // n_keepers counts the objects that keep memory. The last keeper first lowers n_keepers to 0, and then empties the pools
    // under their locks. If n_keepers is above 0 here, the pool will be emptied later, and the block may be kept.
    if (n_keepers.load(std::memory_order_acquire) > 0) {
      Block *&first = to.kept[static_cast<std::size_t>(size_class(n_bytes) - smallest_class)];
      first = new (memory) Block{first};
      return;
    }
  }
  ::operator delete(memory);
}

void free_kept_memory() noexcept {
  for (Pool &pool : pools) {
    std::array<Block *, largest_class - smallest_class + 1> freed{};
    {
      const std::lock_guard<ShortLock> lock(pool.in_use);
      freed.swap(pool.kept);
    }
    for (Block *block : freed)
      while (block) ::operator delete(std::exchange(block, block->next));
  }
}

KeepsMemory::KeepsMemory() noexcept {
  static const bool is_ready_for_forks = prepare_for_forks();
  static_cast<void>(is_ready_for_forks);
  n_keepers.fetch_add(1, std::memory_order_acq_rel);
}

KeepsMemory::~KeepsMemory() {
  if (n_keepers.fetch_sub(1, std::memory_order_acq_rel) == 1) free_kept_memory();
}

#endif

}  // namespace riis
