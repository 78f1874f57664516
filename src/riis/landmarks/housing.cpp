// SPDX-License-Identifier: Apache-2.0
// Landmarks of the bileaflet valve: points along the housing's circle, and the ends of the hinges.
#include <riis/riis.h>

#include <cmath>

#include "base/errors.hpp"
#include "common/elementary.hpp"
#include "landmarks/annuli.hpp"
#include "landmarks/fit.hpp"

namespace riis {
namespace {

class HousingModel : public LandmarkModel {
 public:
  enum Size { radius_, offset, height };
  explicit HousingModel(const Landmarks &landmarks) {
    for (const Landmark &landmark : landmarks.list) roles_.push_back(landmark.role);
  }
  std::size_t n_equations() const override { return 2 * roles_.size(); }
  void offsets(const std::vector<double> &values, const std::vector<Vec3> &local,
               std::vector<Offset> &out) const override {
    out.clear();
    for (std::size_t i = 0; i < roles_.size(); ++i) {
      const Vec3 &p = local[i];
      const double r = hypotenuse(p.x, p.y), beyond = r > 0 ? 1 - values[radius_] / r : 0;
      if (roles_[i] == RIIS_LANDMARK_HINGE)
        out.push_back({i, {p.x - std::copysign(values[offset], p.x), 0, p.z - values[height]}});
      else
        out.push_back({i, {beyond * p.x, beyond * p.y, p.z}});
    }
  }

 private:
  std::vector<std::int32_t> roles_;
};

}  // namespace

KindOfLandmarks bileaflet_landmarks(const Valve &valve, const Landmarks &landmarks) {
  const char *kind = valve.kind().name;
  check_roles(landmarks, kind, {RIIS_LANDMARK_ANNULUS, RIIS_LANDMARK_HINGE});
  check_count(landmarks, kind, RIIS_LANDMARK_ANNULUS, 3, 0);
  check_count(landmarks, kind, RIIS_LANDMARK_HINGE, 2, 4);
  if (!landmarks.has_flow())
    fail(RIIS_INVALID_ARGUMENT,
         "landmarks.flow is 0 0 0: the ring and the hinges of the bileaflet valve do not show the direction of flow");
  const auto ring = landmarks.with_role(RIIS_LANDMARK_ANNULUS), hinges = landmarks.with_role(RIIS_LANDMARK_HINGE);
  check_spread(landmarks, ring, one_place);
  const Spread spread = spread_of(landmarks, ring), hinge_spread = spread_of(landmarks, hinges);
  const Vec3 normal = spread.direction[2], middle = landmarks.mean_of(ring);
  const Vec3 up = checked_flow(landmarks, normal, "the ring's") < 0 ? -normal : normal;
  double radius = 0;
  for (const std::size_t i : ring) {
    const Vec3 p = landmarks.at(i) - middle;
    radius += length(p - dot(p, up) * up) / static_cast<double>(ring.size());
  }
  // The hinges are parallel to the direction in which their ends are spread most.
  const Vec3 y = hinge_spread.direction[0];
  if (!(hinge_spread.deviation[0] > 0.2 * radius))
    fail(RIIS_INVALID_ARGUMENT, "the ends of the hinges are ", rounded(landmarks.scale * hinge_spread.deviation[0], 3),
         " from their middle, which does not show their direction; they must be more than ",
         rounded(landmarks.scale * 0.2 * radius, 3), " from it");
  if (std::abs(dot(y, up)) > 0.5)
    fail(RIIS_INVALID_ARGUMENT, "the hinges are at ", rounded(arc_cosine(std::abs(dot(y, up))) * 180 / pi, 3),
         " degrees to the ring's normal; they must be perpendicular to it, within 30 degrees");
  // If the landmarks show only one hinge, this hinge belongs to the leaflet at x > 0.
  const Vec3 hinge_middle = landmarks.mean_of(hinges) - middle;
  Vec3 x = cross(y, up);
  if (dot(x, hinge_middle) < 0) x = -x;
  const Rotation rotation = rotation_to(x, up), back = transposed(rotation);

  auto model = std::make_unique<HousingModel>(landmarks);
  const double grown = radius / value_of(valve, "radius");
  const double own_offset = grown * value_of(valve, "hinge_offset"),
               own_height = grown * value_of(valve, "hinge_height");
  double offset = 0, height = 0;
  for (const std::size_t i : hinges) {
    const Vec3 p = back * (landmarks.at(i) - middle);
    offset += std::abs(p.x) / static_cast<double>(hinges.size());
    height += p.z / static_cast<double>(hinges.size());
  }
  model->sizes = {{"radius", radius, 1, 0.3 * radius, 3 * radius, radius, 0.5 * radius},
                  {"hinge_offset", offset, 1, 0, 0.9 * radius, own_offset, 0.2 * radius},
                  {"hinge_height", height, 1, -3 * radius, 3 * radius, own_height, 0.3 * radius}};
  model->radius = radius;
  return one_model(std::move(model), {{rotation, middle}}, "radius");
}

}  // namespace riis
