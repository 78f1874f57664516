// SPDX-License-Identifier: Apache-2.0
#include "geometry/placement.hpp"

namespace riis {

Rotation rotation_about(Vec3 axis, double degrees) {
  const auto [s, c] = sine_cosine_degrees(degrees);
  const Vec3 n = (1.0 / length(axis)) * axis;
  const double k = 1.0 - c;  // Rodrigues' formula
  return {{c + k * n.x * n.x, k * n.x * n.y - s * n.z, k * n.x * n.z + s * n.y},
          {k * n.y * n.x + s * n.z, c + k * n.y * n.y, k * n.y * n.z - s * n.x},
          {k * n.z * n.x - s * n.y, k * n.z * n.y + s * n.x, c + k * n.z * n.z}};
}

Rotation rotation_xyz(Vec3 degrees) {
  const Rotation x = rotation_about({1, 0, 0}, degrees.x), y = rotation_about({0, 1, 0}, degrees.y),
                 z = rotation_about({0, 0, 1}, degrees.z);
  const auto turned = [&](Vec3 a) { return z * (y * (x * a)); };
  const Vec3 column_x = turned({1, 0, 0}), column_y = turned({0, 1, 0}), column_z = turned({0, 0, 1});
  return {
      {column_x.x, column_y.x, column_z.x}, {column_x.y, column_y.y, column_z.y}, {column_x.z, column_y.z, column_z.z}};
}

}  // namespace riis
