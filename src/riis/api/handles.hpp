// SPDX-License-Identifier: Apache-2.0
// The objects behind the public handles.
#pragma once

#include <riis/riis.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "arrays/user_arrays.hpp"
#include "base/errors.hpp"
#include "base/recycled.hpp"
#include "marks/marks.hpp"
#include "measures/measures.hpp"
#include "mesh/mesh.hpp"
#include "parallel/threads.hpp"
#include "pipeline/updatable_surface.hpp"
#include "scene/surface.hpp"
#include "seal/seal.hpp"
#include "valve/user_patches.hpp"
#include "valve/valve.hpp"
#include "valve/warp.hpp"

namespace riis {

// The first word of every handle holds its kind, which each call checks. Fortran passes all handles as one type, so a Fortran
// compiler does not notice two swapped handles.
enum class HandleKind : std::uint64_t {
  valve = 0x7269697376616c76,
  surface = 0x7269697373757266,
  mesh = 0x726969736d657368,
  adjacency = 0x7269697361646a63,
  marks = 0x7269697372736c74,
  keyframes = 0x726969736b657966,
  crossings = 0x7269697363726f73,
  leaks = 0x726969736c65616b,
  warp = 0x7269697377617270
};

// Returns whether a handle's first word holds a kind, whose first four letters are "riis". A destroyed handle's memory holds
// other values.
constexpr bool is_kind(HandleKind kind) noexcept { return static_cast<std::uint64_t>(kind) >> 32 == 0x72696973; }

// Counts the calls that use a handle at the moment. While one thread's call writes a handle, a call of another thread fails if it
// uses this handle. Without the check, the other call could crash (riis.h, "Threads"). Calls that only read are counted without a
// lock, so they never wait.
class Uses {
 public:
  // Returns false if a call of another thread excludes this call.
  bool begin(bool writes) noexcept {
    if (writes && is_written_.exchange(true)) return is_inherited();
    if (!writes) n_begun_.fetch_add(1);
    const bool is_free = writes ? is_unread() : is_readable();
    if (!is_free) end(writes);
    return is_free;
  }
  void end(bool wrote) noexcept {
    if (wrote)
      is_written_.store(false, std::memory_order_release);
    else
      n_ended_.fetch_add(1, std::memory_order_release);
  }
  bool is_readable() const noexcept { return !is_written_.load() || is_inherited(); }

 private:
  // Returns true in a child of fork(). The child lacks the parent's other threads, so calls that these threads have begun never
  // end in the child.
  bool is_inherited() const noexcept { return getpid() != maker_; }
  bool is_unread() const noexcept {
    const std::uint64_t n_ended = n_ended_.load(std::memory_order_acquire);
    return n_begun_.load() == n_ended || is_inherited();
  }
  const pid_t maker_ = getpid();
  std::atomic<std::uint64_t> n_begun_{0}, n_ended_{0};  // calls that only read
  std::atomic<bool> is_written_{false};
};

template <HandleKind the_kind>
struct Handle {
  static constexpr HandleKind own_kind = the_kind;
  HandleKind kind = own_kind;
  mutable Uses uses = {};
};

// The handles that a call uses until its end. The list also says which of them the call writes. A call may name a handle twice.
class UsesOfCall {
 public:
  UsesOfCall() noexcept : outer_(std::exchange(innermost(), this)) {}
  ~UsesOfCall() {
    for (const auto &[uses, writes] : used_)
      if (uses) uses->end(writes);
    innermost() = outer_;
  }
  UsesOfCall(const UsesOfCall &) = delete;
  UsesOfCall &operator=(const UsesOfCall &) = delete;
  static bool add(Uses &uses, bool writes) {
    if (!innermost()) return true;  // tests reach handles outside of a public call
    for (auto &[used, is_written] : innermost()->used_) {
      if (used == &uses) return true;
      if (used) continue;
      if (!uses.begin(writes)) return false;
      used = &uses, is_written = writes;
      return true;
    }
    fail(RIIS_INTERNAL_ERROR, "a call takes more handles than can be counted");
  }

 private:
  static UsesOfCall *&innermost() noexcept;  // the innermost call of this thread
  UsesOfCall *outer_;
  std::array<std::pair<Uses *, bool>, 4> used_{};
};

// Runs the body of a public function that takes handles.
template <class Body>
riis_status guarded_with_handles(Body &&body) noexcept {
  return riis::guarded([&] {
    const UsesOfCall uses;
    body();
  });
}

// Returns the handle. Fails if the handle is null or of another kind, or if a call of another thread excludes this call. A handle
// that is not const counts as written. Short calls pass is_counted = false, because many threads at once would wait for the
// count.
template <class AnyHandle>
AnyHandle *require_handle(AnyHandle *handle, const char *argument, bool is_counted = true) {
  require(handle, argument);
  if (handle->kind != AnyHandle::own_kind)
    fail(RIIS_INVALID_ARGUMENT, argument,
         is_kind(handle->kind) ? " is a handle of another kind" : " is no handle, or it was destroyed");
  if (is_counted ? !UsesOfCall::add(handle->uses, !std::is_const_v<AnyHandle>) : !handle->uses.is_readable())
    fail(RIIS_UNAVAILABLE, argument,
         " is in use by another thread: while a call writes a handle, no other thread may use it");
  return handle;
}

// The body of a create function that makes an empty object.
template <class AnyHandle>
riis_status create_handle(AnyHandle **handle, const char *argument) noexcept {
  return guarded([&] {
    require(handle, argument);
    *handle = new AnyHandle{};
  });
}

// The body of a destroy function. A handle of another kind, or one that another thread uses, is not destroyed: a leak is better
// than memory that is freed as the wrong type or too early.
template <class AnyHandle>
void destroy_handle(AnyHandle **handle, const char *argument) noexcept {
  if (!handle || !*handle) return;
  if (guarded_with_handles([&] { require_handle(*handle, argument); }) != RIIS_OK) return;
  delete *handle;
  *handle = nullptr;
}

}  // namespace riis

struct riis_valve : riis::Handle<riis::HandleKind::valve> {
  riis::Valve valve;
  riis::PatchArrays arrays = {};  // the arrays that the last riis_valve_get_patches returned
};

struct riis_warp : riis::Handle<riis::HandleKind::warp> {
  riis_warp(riis::WarpLandmarks made, const riis::Placement &placed) : landmarks(std::move(made)), placement(placed) {}
  riis::KeepsMemory keeps_memory;
  riis::WarpLandmarks landmarks;
  riis::Placement placement;  // takes the valve's coordinates to the caller's coordinates
  riis::WarpMap map, next_map;
  riis::WarpQuality quality{};
  riis::Vector<riis::Vec3> targets;
};

struct riis_surface : riis::Handle<riis::HandleKind::surface> {
  riis::KeepsArenas keeps_arenas;
  riis::KeepsMemory keeps_memory;
  riis::UpdatableSurface updatable;
  riis_surface_options options;  // the options of the last update; fields that an older caller lacked have defaults
  // Identifies the surface: no earlier surface had this number. An address cannot identify a surface, because a later surface may
  // get the same address.
  const std::uint64_t number = next_number();

 private:
  static std::uint64_t next_number() {
    static std::atomic<std::uint64_t> last{0};
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
  }
};

struct riis_keyframes : riis::Handle<riis::HandleKind::keyframes> {
  explicit riis_keyframes(riis::Keyframes made) : keyframes(std::move(made)) {}
  riis::Keyframes keyframes;
};

struct riis_mesh : riis::Handle<riis::HandleKind::mesh> {
  riis_mesh(const riis::StridedPoints &nodes, const riis::Bounds &bounds) : mesh(nodes, bounds) {}
  riis::KeepsArenas keeps_arenas;
  riis::Mesh mesh;
};

struct riis_adjacency : riis::Handle<riis::HandleKind::adjacency> {
  riis::OwnAdjacency adjacency;
};

struct riis_marks : riis::Handle<riis::HandleKind::marks> {
  riis::KeepsArenas keeps_arenas;
  riis::Marks marks;
};

struct riis_leaks : riis::Handle<riis::HandleKind::leaks> {
  riis::Leaks leaks;
};

struct riis_crossings : riis::Handle<riis::HandleKind::crossings> {
  riis::Crossings pairs;
  riis_crossing_list list{0, nullptr, nullptr, nullptr, nullptr, 0, 0, {0, 0, 0}, {-1, -1}, {-1, -1}, 0};
};

namespace riis {

inline const Surface &content_of(const riis_surface *surface, bool is_counted = true) {
  return require_handle(surface, "surface", is_counted)->updatable.surface();
}

}  // namespace riis
