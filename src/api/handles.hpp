// SPDX-License-Identifier: Apache-2.0
// What is behind the public handles.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <memory>

#include "api/errors.hpp"
#include "marking/mark_result.hpp"
#include "marking/mesh.hpp"
#include "surface/surface.hpp"
#include "valve/parameters.hpp"

namespace riis {

// The first word of every handle says what it is: Fortran passes all handles as the same type, and swaps them silently.
enum class HandleKind : std::uint64_t {
  valve = 0x7269697376616c76,
  surface = 0x7269697373757266,
  mesh = 0x726969736d657368,
  mark_result = 0x7269697372736c74
};

// A handle that is there and of its kind.
template <class Handle>
Handle *require_handle(Handle *handle, const char *argument) {
  require(handle, argument);
  if (handle->kind != Handle::own_kind) fail(RIIS_INVALID_ARGUMENT, "%s is a handle of another kind", argument);
  return handle;
}

// The body of a destroy function. A handle of another kind is left alone: losing it is better than freeing it as what it is
// not.
template <class Handle>
void destroy_handle(Handle **handle, const char *argument) noexcept {
  if (!handle || !*handle) return;
  if (guarded([&] { require_handle(*handle, argument); }) != RIIS_OK) return;
  delete *handle;
  *handle = nullptr;
}

}  // namespace riis

struct riis_valve {
  static constexpr riis::HandleKind own_kind = riis::HandleKind::valve;
  riis::HandleKind kind = own_kind;
  riis::Valve valve;
};

struct riis_surface {
  static constexpr riis::HandleKind own_kind = riis::HandleKind::surface;
  riis::HandleKind kind = own_kind;
  std::unique_ptr<const riis::Surface> surface;
  riis_surface_options options;  // as completed
  double seconds_triangles, seconds_scene;
};

struct riis_mesh {
  static constexpr riis::HandleKind own_kind = riis::HandleKind::mesh;
  riis::HandleKind kind = own_kind;
  riis::Mesh mesh;
};

struct riis_mark_result {
  static constexpr riis::HandleKind own_kind = riis::HandleKind::mark_result;
  riis::HandleKind kind = own_kind;
  riis::MarkResult result;
};

namespace riis {

inline const Surface &content_of(const riis_surface *surface) { return *require_handle(surface, "surface")->surface; }

}  // namespace riis
