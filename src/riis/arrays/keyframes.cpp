// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <limits>

#include "arrays/user_arrays.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "common/array_view.hpp"
#include "geometry/strided.hpp"

namespace riis {
namespace {

constexpr std::array<const char *, 3> axes{"x", "y", "z"};

}  // namespace

Keyframes::Keyframes(const riis_surface_arrays &arrays, const riis_keyframe_arrays &frames)
    : keys_("frames", frames.n_keys, frames.time, frames.period, frames.interpolation) {
  check_bits("frames.real_bits", frames.real_bits);
  require(frames.xyz, "frames.xyz");
  if (frames.n_vertices != arrays.n_vertices)
    fail(RIIS_INVALID_ARGUMENT, "frames.n_vertices is ", frames.n_vertices, "; arrays.n_vertices is ",
         arrays.n_vertices, ": all frames have the same vertices");
  if (frames.n_vertices < 1 || frames.n_vertices > std::numeric_limits<std::int32_t>::max())
    fail(RIIS_INVALID_SURFACE, "frames.n_vertices is ", frames.n_vertices, "; it must be from 1 to 2147483647");
  if (frames.n_keys > std::numeric_limits<std::int64_t>::max() / 24 / frames.n_vertices)
    fail(RIIS_LIMIT_EXCEEDED, frames.n_keys, " frames of ", frames.n_vertices,
         " vertices are more than memory can hold");
  const std::int64_t n = 3 * frames.n_vertices;
  const auto copy = [&](const auto *from) { xyz_.assign(from, from + frames.n_keys * n); };
  if (frames.real_bits == 32)
    copy(static_cast<const float *>(frames.xyz));
  else
    copy(static_cast<const double *>(frames.xyz));
  const double *const xyz = xyz_.data();
  for (std::int64_t key = 0; key < frames.n_keys; ++key)
    for (std::int64_t i = 0; i < n; ++i)
      if (!is_usable(xyz[key * n + i]))
        fail(RIIS_INVALID_SURFACE, view(axes)[i % 3], " of vertex ", i / 3, " in frame ", key, " is ", xyz[key * n + i],
             "; it must be finite and at most ", max_coordinate, " in magnitude");
  if (keys_.is_closed())
    for (std::int64_t i = 0; i < n; ++i)
      if (xyz[i] != xyz[(frames.n_keys - 1) * n + i])
        fail(RIIS_INVALID_SURFACE, "vertex ", i / 3, " in the last frame, one period after the first frame, has the ",
             view(axes)[i % 3], " ", xyz[(frames.n_keys - 1) * n + i], "; it must equal that of the first frame, ",
             xyz[i]);
  // Checks the faces once, with the vertices of the first frame.
  faces_ = faces_from_arrays(arrays);
  triangles_from_arrays(faces_, first_frame(), {1, no_rotation, {0, 0, 0}}, true, false);

  time_.assign(frames.time, frames.time + frames.n_keys);
  keys_ = {"frames", frames.n_keys, time_.data(), frames.period, frames.interpolation};
}

riis_surface_arrays Keyframes::first_frame() const {
  riis_surface_arrays first{};
  first.n_vertices = faces_.n_vertices;
  first.x = xyz_.data(), first.y = xyz_.data() + 1, first.z = xyz_.data() + 2;
  first.stride = 3;
  first.real_bits = 64;
  return first;
}

void Keyframes::at(double time, double dt, std::vector<double> &xyz, std::vector<double> &velocity) const {
  if (!(dt == 0 || (std::abs(dt) >= 1e-30 && std::abs(dt) <= 1e30)))
    fail(RIIS_INVALID_ARGUMENT, "dt is ", dt, "; it must be 0, or from 1e-30 to 1e+30 in magnitude");
  const KeyTimes::KeysAround now = keys_.around(time);
  if (dt != 0 && time - dt == time)
    fail(RIIS_INVALID_ARGUMENT, "dt is ", dt, ", which is too small to change time, ", time);
  const KeyTimes::KeysAround before = keys_.around(time - dt, "time - dt");
  const std::int64_t n = 3 * faces_.n_vertices;
  const auto value = [&](const KeyTimes::KeysAround &around, std::int64_t i) {
    std::array<double, 4> values;
    for (std::size_t k = 0; k < 4; ++k) values[k] = view(xyz_)[around.key[k] * n + i];
    return keys_.between(around, values);
  };
  resize(xyz, n);
  resize(velocity, n);
  for (std::int64_t i = 0; i < n; ++i) {
    const ValueAndRate made = value(now, i);
    view(xyz)[i] = made.value;
    view(velocity)[i] = dt == 0 ? made.rate : (made.value - value(before, i).value) / dt;
  }
}

}  // namespace riis
