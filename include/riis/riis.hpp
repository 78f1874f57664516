// SPDX-License-Identifier: Apache-2.0
//
// riis.hpp - riis.h for C++14 and later: handles that destroy themselves, errors as exceptions, structs with their defaults,
// spans.
//
// All calls are the functions of riis.h. Where a function takes a pointer to an object, pass a handle. Where it takes the address
// of such a pointer, pass the handle's out():
//
//   riis::Valve valve; riis::Surface surface; riis::Mesh mesh; riis::Marks marks;
//   riis::check(riis_valve_create("mitral", valve.out()));
//   auto options = riis::defaults<riis_surface_options>();
//   options.half_thickness = 0.1;
//   riis::check(riis_surface_create(valve, &options, surface.out()));
//   riis::check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, mesh.out()));
//   riis::check(riis_marks_create(marks.out()));
//   riis::check(riis_mark_nodes(surface, mesh, nullptr, marks));                    // once a time step
//   const auto marked = riis::get<riis_mark_list>(riis_marks_get_list, marks, RIIS_LIST_MARKED);
//   for (const std::int64_t node : riis::Span(marked.node_id, marked.n_nodes)) ...
//
// All code of this interface is in this header. The library itself has only a C interface, so it works with every
// compiler and standard library.
#ifndef RIIS_RIIS_HPP
#define RIIS_RIIS_HPP

#include <riis/riis.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace riis {
inline namespace interface_1 {

// The error of a call that the library refused or that failed. what() returns the message of riis_last_error().
class Error : public std::runtime_error {
 public:
  Error(riis_status status, const char *message) : std::runtime_error(message), status_(status) {}
  riis_status status() const noexcept { return status_; }  // never RIIS_OK

 private:
  riis_status status_;
};

// Throws an Error if the status is not RIIS_OK. Call check() in the thread that made the failed call.
inline void check(riis_status status) {
  if (status != RIIS_OK) throw Error(status, riis_last_error());
}

// A handle: the owner of one object of the library, or of none. A handle can be moved, but not copied.
template <class Object, void (*destroy)(Object **)>
class Handle {
 public:
  Handle() = default;
  Handle(std::nullptr_t) noexcept {}
  explicit Handle(Object *object) noexcept : object_(object) {}  // takes ownership of the object
  Handle(Handle &&other) noexcept : object_(other.release()) {}
  Handle &operator=(Handle &&other) noexcept {
    if (this != &other) reset(other.release());
    return *this;
  }
  ~Handle() { reset(); }

  operator Object *() const noexcept { return object_; }
  Object *get() const noexcept { return object_; }
  // Destroys the object, and returns the address of the pointer, now NULL, for a call that makes a new object.
  Object **out() noexcept {
    reset();
    return &object_;
  }
  void reset(Object *object = nullptr) noexcept {
    destroy(&object_);
    object_ = object;
  }
  // Returns the object, and owns it no longer. The caller must then destroy the object.
  Object *release() noexcept { return std::exchange(object_, nullptr); }

 private:
  Object *object_ = nullptr;
};

using Valve = Handle<riis_valve, riis_valve_destroy>;              // owns a riis_valve
using Surface = Handle<riis_surface, riis_surface_destroy>;        // owns a riis_surface
using Keyframes = Handle<riis_keyframes, riis_keyframes_destroy>;  // owns a riis_keyframes
using Warp = Handle<riis_warp, riis_warp_destroy>;                 // owns a riis_warp
using Mesh = Handle<riis_mesh, riis_mesh_destroy>;                 // owns a riis_mesh
using Adjacency = Handle<riis_adjacency, riis_adjacency_destroy>;  // owns a riis_adjacency
using Marks = Handle<riis_marks, riis_marks_destroy>;              // owns a riis_marks
using Leaks = Handle<riis_leaks, riis_leaks_destroy>;              // owns a riis_leaks
using Crossings = Handle<riis_crossings, riis_crossings_destroy>;  // owns a riis_crossings

namespace detail {
template <class Struct>
struct Init;
#define RIIS_INIT(name)                                                                    \
  template <>                                                                              \
  struct Init<name> {                                                                      \
    static riis_status call(name *to, std::int64_t size) { return name##_init(to, size); } \
  };
RIIS_INIT(riis_points)
RIIS_INIT(riis_patches)
RIIS_INIT(riis_surface_options)
RIIS_INIT(riis_warp_options)
RIIS_INIT(riis_landmarks)
RIIS_INIT(riis_placement_arrays)
RIIS_INIT(riis_surface_arrays)
RIIS_INIT(riis_keyframe_arrays)
RIIS_INIT(riis_crossing_options)
RIIS_INIT(riis_closest_options)
RIIS_INIT(riis_closest_arrays)
RIIS_INIT(riis_grid)
RIIS_INIT(riis_csr)
RIIS_INIT(riis_mesh_cells)
RIIS_INIT(riis_mesh_faces)
RIIS_INIT(riis_resistance)
RIIS_INIT(riis_mark_options)
RIIS_INIT(riis_dense_arrays)
RIIS_INIT(riis_resistance_arrays)
RIIS_INIT(riis_flow_arrays)
RIIS_INIT(riis_band)
RIIS_INIT(riis_passage_ends)
RIIS_INIT(riis_area_search)
RIIS_INIT(riis_first_passage_options)
RIIS_INIT(riis_reaction)
RIIS_INIT(riis_loads)
RIIS_INIT(riis_opening_table)
RIIS_INIT(riis_opening_times)
RIIS_INIT(riis_opening_switch)
RIIS_INIT(riis_opening_switch_state)
RIIS_INIT(riis_opening_angle)
RIIS_INIT(riis_opening_angle_state)
#undef RIIS_INIT
}  // namespace detail

// Returns a struct with its default values, for a call that reads it.
template <class Struct>
Struct defaults() {
  Struct made;
  check(detail::Init<Struct>::call(&made, sizeof made));
  return made;
}

// Calls a function that fills in a struct, and returns the struct, as in get<riis_surface_info>(riis_surface_get_info, surface).
template <class Struct, class Call, class... Arguments>
Struct get(const Call &call, const Arguments &...arguments) {
  Struct filled;
  check(call(arguments..., &filled, static_cast<std::int64_t>(sizeof filled)));
  return filled;
}

// A view of an array of the library or of the caller. A Span is like C++20's std::span, but with signed sizes, and owns nothing.
template <class T>
class Span {
 public:
  Span() = default;
  // If the library made no array, `data` is NULL, and the span is empty.
  Span(T *data, std::int64_t size) noexcept : data_(data), size_(data ? size : 0) {}

  T *data() const noexcept { return data_; }
  std::int64_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  T &operator[](std::int64_t i) const noexcept { return data_[i]; }
  T *begin() const noexcept { return data_; }
  T *end() const noexcept { return data_ + size_; }

 private:
  T *data_ = nullptr;
  std::int64_t size_ = 0;
};

}  // namespace interface_1
}  // namespace riis

#endif
