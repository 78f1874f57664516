// SPDX-License-Identifier: Apache-2.0
#include "arrays/user_arrays.hpp"

#include <limits>
#include <utility>

#include "base/integer_array.hpp"
#include "base/log.hpp"
#include "common/array_view.hpp"

namespace riis {
namespace {

void check_vertices(const riis_surface_arrays &arrays) {
  check_bits("arrays.real_bits", arrays.real_bits);
  require(arrays.x, "arrays.x");
  require(arrays.y, "arrays.y");
  require(arrays.z, "arrays.z");
  if (arrays.stride < 1) fail(RIIS_INVALID_ARGUMENT, "arrays.stride is ", arrays.stride, "; it must be at least 1");
  if (arrays.stride > std::numeric_limits<std::int64_t>::max() / 8 / arrays.n_vertices)
    fail(RIIS_INVALID_ARGUMENT, "arrays.stride is ", arrays.stride, ": ", arrays.n_vertices,
         " vertices at this stride exceed what memory can hold");
  check_apart(arrays.n_vertices, {arrays.x, arrays.y, arrays.z}, arrays.stride, arrays.real_bits / 8,
              {"arrays.", {"x", "y", "z"}, "stride"});
}

void check_faces(const riis_surface_arrays &arrays) {
  require(arrays.vertex_ids, "arrays.vertex_ids");
  check_bits("arrays.id_bits", arrays.id_bits);
  check_base("arrays.index_base", arrays.index_base);
  if (arrays.corners_per_face != 3 && arrays.corners_per_face != 4)
    fail(RIIS_INVALID_ARGUMENT, "arrays.corners_per_face is ", arrays.corners_per_face, "; it must be 3 or 4");
  if (arrays.n_vertices < 1)
    fail(RIIS_INVALID_SURFACE, "arrays.n_vertices is ", arrays.n_vertices, "; it must be at least 1");
  if (arrays.n_vertices > std::numeric_limits<std::int32_t>::max())
    fail(RIIS_LIMIT_EXCEEDED, "arrays.n_vertices is ", arrays.n_vertices, "; it must be at most 2147483647");
  const std::int64_t max_faces = max_triangles / (arrays.corners_per_face - 2);
  if (arrays.n_faces < 1) fail(RIIS_INVALID_SURFACE, "arrays.n_faces is ", arrays.n_faces, "; it must be at least 1");
  if (arrays.n_faces > max_faces)
    fail(RIIS_LIMIT_EXCEEDED, "arrays.n_faces is ", arrays.n_faces, "; it must be at most ", max_faces);
}

UserSkirt skirt_from_arrays(const riis_surface_arrays &arrays, UserSkirt memory) {
  constexpr double longest = 1e50;
  if (!(arrays.skirt_length >= 0 && arrays.skirt_length <= longest))
    fail(RIIS_INVALID_ARGUMENT, "arrays.skirt_length is ", arrays.skirt_length, "; it must be from 0 to ", longest);
  if (arrays.skirt_lengths && arrays.skirt_length == 0)
    fail(RIIS_INVALID_ARGUMENT, "arrays.skirt_lengths is given, but arrays.skirt_length, the longest length, is 0");
  UserSkirt skirt = std::move(memory);
  skirt.length = arrays.skirt_length;
  skirt.edges.clear();
  skirt.attached.clear();
  skirt.lengths.clear();
  if (arrays.attached) skirt.attached.assign(arrays.attached, arrays.attached + arrays.n_vertices);
  if (arrays.skirt_lengths) skirt.lengths.assign(arrays.skirt_lengths, arrays.skirt_lengths + arrays.n_vertices);
  return skirt;
}

std::int64_t vertex_id_at(const riis_surface_arrays &arrays, std::int64_t i) {
  const std::int64_t number = IntegerArray{arrays.vertex_ids, arrays.id_bits == 64}[i];
  const std::int64_t base = arrays.index_base;
  if (number < base || number - base >= arrays.n_vertices)
    fail(RIIS_INVALID_SURFACE, "arrays.vertex_ids: corner ", i % arrays.corners_per_face, " of face ",
         i / arrays.corners_per_face, " is ", number, "; it must be from ", base, " to ", arrays.n_vertices - 1 + base,
         ", counting from arrays.index_base = ", base);
  return number - base;
}

Vec3 given(const riis_surface_arrays &arrays, std::int64_t vertex) {
  return with_points(arrays.n_vertices, {arrays.x, arrays.y, arrays.z}, arrays.stride, arrays.real_bits,
                     [&](const auto &points) { return points[vertex]; });
}

void place_vertices(const riis_surface_arrays &arrays, const Placement &placement, TriangleSet &set) {
  set.xyz.reserve(static_cast<std::size_t>(3 * arrays.n_vertices));
  for (std::int64_t i = 0; i < arrays.n_vertices; ++i) {
    const Vec3 p = given(arrays, i);
    const Vec3 placed = place(placement, p);
    const auto check = [&](const char *axis, double value, const char *when) {
      if (!is_usable(value))
        fail(RIIS_INVALID_SURFACE, axis, " of vertex ", i, when, " is ", value, "; it must be finite and at most ",
             max_coordinate, " in magnitude");
    };
    check("x", p.x, ""), check("y", p.y, ""), check("z", p.z, "");
    check("x", placed.x, ", placed,"), check("y", placed.y, ", placed,"), check("z", placed.z, ", placed,");
    set.xyz.insert(set.xyz.end(), {placed.x, placed.y, placed.z});
  }
}

void place_velocities(const riis_surface_arrays &arrays, const Placement &placement, TriangleSet &set) {
  if (!arrays.vx && !arrays.vy && !arrays.vz) return;
  require(arrays.vx, "arrays.vx");
  require(arrays.vy, "arrays.vy");
  require(arrays.vz, "arrays.vz");
  if (arrays.velocity_stride < 1)
    fail(RIIS_INVALID_ARGUMENT, "arrays.velocity_stride is ", arrays.velocity_stride, "; it must be at least 1");
  if (arrays.velocity_stride > std::numeric_limits<std::int64_t>::max() / 8 / arrays.n_vertices)
    fail(RIIS_INVALID_ARGUMENT, "arrays.velocity_stride is ", arrays.velocity_stride, ": the velocities of ",
         arrays.n_vertices, " vertices at this stride exceed what memory can hold");
  check_apart(arrays.n_vertices, {arrays.vx, arrays.vy, arrays.vz}, arrays.velocity_stride, arrays.real_bits / 8,
              {"arrays.", {"vx", "vy", "vz"}, "velocity_stride"});
  set.velocity.reserve(set.xyz.size());
  for (std::int64_t i = 0; i < arrays.n_vertices; ++i) {
    const Vec3 v = with_points(arrays.n_vertices, {arrays.vx, arrays.vy, arrays.vz}, arrays.velocity_stride,
                               arrays.real_bits, [&](const auto &velocities) { return velocities[i]; });
    const Vec3 placed = placement.scale * (placement.rotation * v);
    const auto check = [&](const char *axis, double value, const char *when) {
      if (!is_usable(value))
        fail(RIIS_INVALID_SURFACE, "velocity ", axis, " of vertex ", i, when, " is ", value,
             "; it must be finite and at most ", max_coordinate, " in magnitude");
    };
    check("x", v.x, ""), check("y", v.y, ""), check("z", v.z, "");
    check("x", placed.x, ", placed,"), check("y", placed.y, ", placed,"), check("z", placed.z, ", placed,");
    set.velocity.insert(set.velocity.end(), {placed.x, placed.y, placed.z});
  }
}

}  // namespace

UserFaces faces_from_arrays(const riis_surface_arrays &arrays, UserFaces memory) {
  check_faces(arrays);
  UserFaces faces = std::move(memory);
  faces.n_vertices = arrays.n_vertices;
  faces.corners_per_face = arrays.corners_per_face;
  faces.index_base = arrays.index_base;
  faces.skirt = skirt_from_arrays(arrays, std::move(faces.skirt));
  const std::int64_t n_ids = arrays.n_faces * arrays.corners_per_face;
  resize(faces.vertex_id, n_ids);
  resize(faces.leaflet_id, arrays.n_faces);
  for (std::int64_t i = 0; i < n_ids; ++i) view(faces.vertex_id)[i] = vertex_id_at(arrays, i);
  for (std::int64_t face = 0; face < arrays.n_faces; ++face) {
    const std::int32_t leaflet_id = arrays.leaflet_id ? arrays.leaflet_id[face] : 0;
    if (leaflet_id < 0)
      fail(RIIS_INVALID_SURFACE, "arrays.leaflet_id of face ", face, " is ", leaflet_id, "; it must be at least 0");
    view(faces.leaflet_id)[face] = leaflet_id;
  }
  return faces;
}

TriangleSet triangles_from_arrays(const UserFaces &faces, const riis_surface_arrays &arrays, const Placement &placement,
                                  bool skip_zero_area, bool flip_normals, TriangleSet memory) {
  if (arrays.n_vertices != faces.n_vertices)
    fail(RIIS_INVALID_ARGUMENT, "arrays.n_vertices is ", arrays.n_vertices, "; the surface's faces are for ",
         faces.n_vertices, " vertices");
  check_vertices(arrays);
  TriangleSet set = std::move(memory);
  set.clear();
  place_vertices(arrays, placement, set);
  place_velocities(arrays, placement, set);
  const std::int64_t corners = faces.corners_per_face, halves = corners - 2;
  const std::int64_t n_faces = view(faces.leaflet_id).size();
  const auto n_triangles = static_cast<std::size_t>(n_faces * halves);
  set.vertex_id.reserve(3 * n_triangles);
  set.triangle_id.reserve(n_triangles);
  set.leaflet_id.reserve(n_triangles);
  const auto id_at = [ids = view(faces.vertex_id)](std::int64_t i) { return ids[i]; };
  for (std::int64_t face = 0; face < n_faces; ++face) {
    for (std::int64_t half = 0; half < halves; ++half) {
      const std::int64_t a = id_at(face * corners);
      std::int64_t b = id_at(face * corners + half + 1);
      std::int64_t c = id_at(face * corners + half + 2);
      if (has_zero_area(set.vertex(a), set.vertex(b), set.vertex(c))) {
        if (!skip_zero_area)
          fail(RIIS_INVALID_SURFACE, "face ", face, " (vertices ", a + faces.index_base, ", ", b + faces.index_base,
               ", ", c + faces.index_base, corners == 4 ? ", one half of a quad" : "", ") has zero area",
               has_zero_area(given(arrays, a), given(arrays, b), given(arrays, c)) ? "" : " once it is placed");
        ++set.n_zero_area;
        continue;
      }
      if (flip_normals) std::swap(b, c);
      set.vertex_id.insert(set.vertex_id.end(), {a, b, c});
      set.triangle_id.push_back(face * halves + half);
      set.leaflet_id.push_back(view(faces.leaflet_id)[face]);
    }
  }
  set.patch_id.assign(set.triangle_id.size(), 0);
  if (set.n_triangles() == 0) fail(RIIS_INVALID_SURFACE, "none of the ", n_faces, " faces has any area");
  if (set.n_zero_area > 0)
    log_message(RIIS_LOG_WARNING, set.n_zero_area, " of ", n_faces * halves,
                " triangles have zero area and were left out");
  return set;
}

}  // namespace riis
