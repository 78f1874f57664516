// SPDX-License-Identifier: Apache-2.0
#include "surface/keyframes.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "base/array_view.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "geometry/strided.hpp"
#include "surface/user_arrays.hpp"

namespace riis {
namespace {

constexpr std::array<const char *, 3> axes{"x", "y", "z"};

}  // namespace

Keyframes::Keyframes(const riis_surface_arrays &faces, const riis_keyframe_arrays &frames)
    : keys_("frames", frames.n_keys, frames.time, frames.period, frames.interpolation) {
  check_reserved("frames.reserved", frames.reserved);
  require(frames.xyz, "frames.xyz");
  if (frames.n_vertices != faces.n_vertices)
    fail(RIIS_INVALID_ARGUMENT, "frames.n_vertices is ", frames.n_vertices, "; the faces are of ", faces.n_vertices,
         " vertices: all frames have the same");
  if (frames.n_vertices < 1 || frames.n_vertices > std::numeric_limits<std::int32_t>::max())
    fail(RIIS_INVALID_SURFACE, "frames.n_vertices is ", frames.n_vertices, "; it must be from 1 to 2147483647");
  if (frames.n_keys > std::numeric_limits<std::int64_t>::max() / 24 / frames.n_vertices)
    fail(RIIS_LIMIT_EXCEEDED, frames.n_keys, " frames of ", frames.n_vertices,
         " vertices are more than memory can hold");
  const std::int64_t n = 3 * frames.n_vertices;
  for (std::int64_t key = 0; key < frames.n_keys; ++key)
    for (std::int64_t i = 0; i < n; ++i)
      if (!is_usable(frames.xyz[key * n + i]))
        fail(RIIS_INVALID_SURFACE, view(axes)[i % 3], " of vertex ", i / 3, " in frame ", key, " is ",
             frames.xyz[key * n + i], "; it must be finite and at most ", max_coordinate, " in magnitude");
  if (keys_.is_closed())
    for (std::int64_t i = 0; i < n; ++i)
      if (frames.xyz[i] != frames.xyz[(frames.n_keys - 1) * n + i])
        fail(RIIS_INVALID_SURFACE, "vertex ", i / 3, " in the last frame, a period after the first, has the ",
             view(axes)[i % 3], " ", frames.xyz[(frames.n_keys - 1) * n + i], "; it must be that of the first, ",
             frames.xyz[i]);
  // The faces are checked once, as a surface from the first frame.
  faces_ = faces_from_arrays(faces);
  riis_surface_arrays first = faces;
  first.x = frames.xyz, first.y = frames.xyz + 1, first.z = frames.xyz + 2;
  first.stride = 3;
  first.vx = first.vy = first.vz = nullptr;
  triangles_from_arrays(faces_, first, {1, no_rotation, {0, 0, 0}}, true, false);

  time_.assign(frames.time, frames.time + frames.n_keys);
  keys_ = {"frames", frames.n_keys, time_.data(), frames.period, frames.interpolation};
  xyz_.assign(frames.xyz, frames.xyz + frames.n_keys * n);
}

void Keyframes::at(double time, double since, std::vector<double> &xyz, std::vector<double> &velocity) const {
  const KeyTimes::Place now = keys_.place(time), before = keys_.place(since);
  const std::int64_t n = 3 * faces_.n_vertices;
  const auto value = [&](const KeyTimes::Place &place, std::int64_t i) {
    std::array<double, 4> values;
    for (std::size_t k = 0; k < 4; ++k) values[k] = view(xyz_)[place.key[k] * n + i];
    return keys_.between(place, values);
  };
  resize(xyz, n);
  resize(velocity, n);
  for (std::int64_t i = 0; i < n; ++i) {
    const ValueAndRate made = value(now, i);
    view(xyz)[i] = made.value;
    view(velocity)[i] = since == time ? made.rate : (made.value - value(before, i).value) / (time - since);
  }
}

}  // namespace riis
