// SPDX-License-Identifier: Apache-2.0
// Rotations and the placement x -> scale * rotation * x + translation.
#pragma once

#include "common/elementary.hpp"
#include "geometry/vec3.hpp"

namespace riis {

struct Rotation {
  Vec3 row_x, row_y, row_z;
};

inline constexpr Rotation no_rotation{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

inline Vec3 operator*(const Rotation &rotation, Vec3 a) {
  return {dot(rotation.row_x, a), dot(rotation.row_y, a), dot(rotation.row_z, a)};
}

// The inverse of a rotation.
inline Rotation transposed(const Rotation &a) {
  return {{a.row_x.x, a.row_y.x, a.row_z.x}, {a.row_x.y, a.row_y.y, a.row_z.y}, {a.row_x.z, a.row_y.z, a.row_z.z}};
}

// Rotates by an angle in degrees about an axis of any length > 0. A viewer towards whom the axis points sees a counter-clockwise
// rotation. The result is exact for multiples of 90 degrees about a coordinate axis.
Rotation rotation_about(Vec3 axis, double degrees);

// Rotates by degrees about x, then about y, then about z. The paper states the rotation of a cusp in this form, as [x, y, z].
Rotation rotation_xyz(Vec3 degrees);

struct Placement {
  double scale;
  Rotation rotation;
  Vec3 translation;
};

inline Vec3 place(const Placement &placement, Vec3 a) {
  return placement.scale * (placement.rotation * a) + placement.translation;
}

}  // namespace riis
