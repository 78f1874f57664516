// SPDX-License-Identifier: Apache-2.0
#include "failing_memory.h"

#include <dlfcn.h>
#include <link.h>
#include <sys/types.h>
#include <unwind.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

#include "sanitized.h"

namespace {

// The addresses at which the executable or a library is mapped.
struct Object {
  std::uintptr_t begin = 0, end = 0;

  bool has(std::uintptr_t address) const { return address >= begin && address < end; }
};

// Returns the executable or library that contains the function of this name.
Object object_of(const char *function) {
  struct Sought {
    std::uintptr_t address;
    Object found;
  } sought{reinterpret_cast<std::uintptr_t>(dlsym(RTLD_DEFAULT, function)), {}};
  // The names of a static library cannot be looked up. Its functions are in the executable that also contains object_of.
  if (!sought.address) sought.address = reinterpret_cast<std::uintptr_t>(&object_of);
  dl_iterate_phdr(
      [](dl_phdr_info *info, std::size_t, void *data) {
        auto &wanted = *static_cast<Sought *>(data);
        Object object{~std::uintptr_t{0}, 0};
        for (int i = 0; i < info->dlpi_phnum; ++i) {
          const auto &header = info->dlpi_phdr[i];
          if (header.p_type != PT_LOAD) continue;
          const std::uintptr_t begin = info->dlpi_addr + header.p_vaddr;
          object = {std::min(object.begin, begin), std::max(object.end, begin + header.p_memsz)};
        }
        if (!object.has(wanted.address)) return 0;
        wanted.found = object;
        return 1;
      },
      &sought);
  if (!sought.found.end) std::abort();
  return sought.found;
}

enum class Owner : std::uint32_t { other, library, embree };

struct Objects {
  Object library = object_of("riis_mark_nodes"), embree = object_of("rtcCommitScene"),
         standard_library = object_of("_ZSt9terminatev");

  Owner owner(std::uintptr_t address) const {
    return library.has(address) ? Owner::library : embree.has(address) ? Owner::embree : Owner::other;
  }
};
std::atomic<const Objects *> objects{nullptr};  // null until the program starts; earlier allocations have no owner
alignas(Objects) char objects_place[sizeof(Objects)];
[[gnu::constructor]] void find_objects() { objects = new (objects_place) Objects; }

// Returns the owner of the first caller outside the C++ library. The C++ library allocates on behalf of its callers, for example
// in std::string.
Owner owner_behind_standard_library() {
  struct Walk {
    bool was_in_it = false;
    Owner owner = Owner::other;
  } walk;
  _Unwind_Backtrace(
      [](_Unwind_Context *context, void *data) {
        auto &w = *static_cast<Walk *>(data);
        const std::uintptr_t address = _Unwind_GetIP(context) - 1;
        const bool is_in_it = objects.load()->standard_library.has(address);
        if (w.was_in_it && !is_in_it) {
          w.owner = objects.load()->owner(address);
          return _URC_END_OF_STACK;
        }
        w.was_in_it = is_in_it;
        return _URC_NO_REASON;
      },
      &walk);
  return walk.owner;
}

Owner owner_of(void *return_address) {
  const Objects *const known = objects.load();
  if (!known) return Owner::other;
  const std::uintptr_t address = reinterpret_cast<std::uintptr_t>(return_address) - 1;
  return known->standard_library.has(address) ? owner_behind_standard_library() : known->owner(address);
}

std::atomic<int> failing{-1};  // the owner whose allocations fail, or -1
std::atomic<std::int64_t> n_left{0}, n_failed{0};
std::atomic<bool> fails_on{false};
std::atomic<const void *> calling_thread{nullptr};
std::atomic<std::int64_t> live_of_library{0}, live_of_embree{0}, live_bytes_of_embree{0};

// Returns an address that identifies this thread.
const void *this_thread() {
  thread_local char mark;
  return &mark;
}

// Counts an allocation by the tested owner. Returns true if this allocation must fail.
bool is_to_fail() {
  const std::int64_t left = n_left.fetch_sub(1);
  if (left > 1 || (left < 1 && !fails_on)) return false;
  ++n_failed;
  return true;
}

// This header stands before every object that operator new returns.
struct alignas(16) Header {
  std::uint32_t offset;  // the object's position in its block
  Owner owner;
};

void *allocate(std::size_t size, std::size_t alignment, void *return_address) noexcept {
  const Owner owner = owner_of(return_address);
  const int whose = failing;
  if (owner == Owner::library &&
      (whose == MEMORY_OF_LIBRARY || (whose == MEMORY_OF_WORKERS && this_thread() != calling_thread)) && is_to_fail())
    return nullptr;
  const std::size_t offset = std::max(alignment, sizeof(Header));
#if defined(IS_SANITIZED)
  constexpr std::size_t most = std::size_t{1} << 38;  // for larger requests the sanitizer would end the process
#else
  constexpr std::size_t most = PTRDIFF_MAX;
#endif
  if (size > most - 2 * offset) return nullptr;
  const std::size_t whole = (offset + std::max<std::size_t>(size, 1) + offset - 1) / offset * offset;
  auto *const block = static_cast<char *>(std::aligned_alloc(offset, whole));
  if (!block) return nullptr;
  if (owner == Owner::library) ++live_of_library;
  if (owner == Owner::embree) ++live_of_embree;
  new (block + offset - sizeof(Header)) Header{static_cast<std::uint32_t>(offset), owner};
  return block + offset;
}

void *allocate_or_throw(std::size_t size, std::size_t alignment, void *return_address) {
  void *const made = allocate(size, alignment, return_address);
  if (!made) throw std::bad_alloc();
  return made;
}

void release(void *object) noexcept {
  if (!object) return;
  auto *const at = static_cast<char *>(object);
  const Header header = *reinterpret_cast<const Header *>(at - sizeof(Header));
  if (header.owner == Owner::library) --live_of_library;
  if (header.owner == Owner::embree) --live_of_embree;
  std::free(at - header.offset);
}

constexpr std::size_t usual = alignof(std::max_align_t);

}  // namespace

#define RIIS_CALLER __builtin_return_address(0)
void *operator new(std::size_t n) { return allocate_or_throw(n, usual, RIIS_CALLER); }
void *operator new[](std::size_t n) { return allocate_or_throw(n, usual, RIIS_CALLER); }
void *operator new(std::size_t n, std::align_val_t a) { return allocate_or_throw(n, std::size_t(a), RIIS_CALLER); }
void *operator new[](std::size_t n, std::align_val_t a) { return allocate_or_throw(n, std::size_t(a), RIIS_CALLER); }
void *operator new(std::size_t n, const std::nothrow_t &) noexcept { return allocate(n, usual, RIIS_CALLER); }
void *operator new[](std::size_t n, const std::nothrow_t &) noexcept { return allocate(n, usual, RIIS_CALLER); }
void *operator new(std::size_t n, std::align_val_t a, const std::nothrow_t &) noexcept {
  return allocate(n, std::size_t(a), RIIS_CALLER);
}
void *operator new[](std::size_t n, std::align_val_t a, const std::nothrow_t &) noexcept {
  return allocate(n, std::size_t(a), RIIS_CALLER);
}
void operator delete(void *p) noexcept { release(p); }
void operator delete[](void *p) noexcept { release(p); }
void operator delete(void *p, std::size_t) noexcept { release(p); }
void operator delete[](void *p, std::size_t) noexcept { release(p); }
void operator delete(void *p, std::align_val_t) noexcept { release(p); }
void operator delete[](void *p, std::align_val_t) noexcept { release(p); }
void operator delete(void *p, std::size_t, std::align_val_t) noexcept { release(p); }
void operator delete[](void *p, std::size_t, std::align_val_t) noexcept { release(p); }
void operator delete(void *p, const std::nothrow_t &) noexcept { release(p); }
void operator delete[](void *p, const std::nothrow_t &) noexcept { release(p); }
void operator delete(void *p, std::align_val_t, const std::nothrow_t &) noexcept { release(p); }
void operator delete[](void *p, std::align_val_t, const std::nothrow_t &) noexcept { release(p); }

extern "C" {

// Replaces Embree's function of this name. The function's declaration is the same in both versions of Embree, so neither header
// is needed.
void *rtcNewDevice(const char *config) {
  const auto find = [](const char *name) {
    void *const function = dlsym(RTLD_NEXT, name);
    if (!function) std::abort();
    return function;
  };
  using NewDevice = void *(*)(const char *);
  using Monitor = bool (*)(void *data, ssize_t bytes, bool post);
  using SetMonitor = void (*)(void *device, Monitor monitor, void *data);
  static const auto new_device = reinterpret_cast<NewDevice>(find("rtcNewDevice"));
  static const auto set_monitor = reinterpret_cast<SetMonitor>(find("rtcSetDeviceMemoryMonitorFunction"));
  void *const device = new_device(config);
  if (device)
    set_monitor(
        device,
        [](void *, ssize_t bytes, bool post) {
          const bool refused = bytes > 0 && failing == MEMORY_OF_EMBREE && is_to_fail();
          // Embree reports memory before or after it allocates the memory. A report after the allocation counts even if it is
          // refused, because the memory already exists.
          if (!refused || post) live_bytes_of_embree += bytes;
          return !refused;
        },
        nullptr);
  return device;
}

void memory_library_is_that_of(const char *function) {
  reinterpret_cast<Objects *>(objects_place)->library = object_of(function);
}

void memory_fail(int whose, std::int64_t n, int and_all_after) {
  calling_thread = this_thread();
  n_left = n;
  n_failed = 0;
  fails_on = and_all_after != 0;
  failing = whose;
}

std::int64_t memory_stop_failing(void) {
  failing = -1;
  return n_failed;
}

std::int64_t memory_live_of_library(void) { return live_of_library; }
std::int64_t memory_live_of_embree(void) { return live_of_embree; }
std::int64_t memory_live_bytes_of_embree(void) { return live_bytes_of_embree; }

#if defined(__GLIBC__) && !defined(IS_SANITIZED)

int memory_of_all_can_fail(void) { return 1; }

void *__libc_malloc(std::size_t size);
void *__libc_calloc(std::size_t n, std::size_t size);
void *__libc_realloc(void *p, std::size_t size);
void *__libc_memalign(std::size_t alignment, std::size_t size);

static bool all_fails() { return failing.load(std::memory_order_relaxed) == MEMORY_OF_ALL && is_to_fail(); }
static void *none() {
  errno = ENOMEM;
  return nullptr;
}

void *malloc(std::size_t size) noexcept { return all_fails() ? none() : __libc_malloc(size); }
void *calloc(std::size_t n, std::size_t size) noexcept { return all_fails() ? none() : __libc_calloc(n, size); }
void *realloc(void *p, std::size_t size) noexcept { return all_fails() ? none() : __libc_realloc(p, size); }
void *memalign(std::size_t alignment, std::size_t size) noexcept {
  return all_fails() ? none() : __libc_memalign(alignment, size);
}
void *aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return memalign(alignment, size); }
int posix_memalign(void **p, std::size_t alignment, std::size_t size) noexcept {
  void *const made = memalign(alignment, size);
  if (!made) return ENOMEM;
  *p = made;
  return 0;
}

#else

int memory_of_all_can_fail(void) { return 0; }

#endif
}
