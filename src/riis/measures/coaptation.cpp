// SPDX-License-Identifier: Apache-2.0
#include "measures/measures.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "common/array_view.hpp"
#include "geometry/vec3.hpp"
#include "parallel/parallel_for.hpp"
#include "scene/triangle_scene.hpp"

namespace riis {
namespace {

// Returns the triangles of all leaflets except one leaflet and the omitted leaflets.
TriangleSet others(const TriangleSet &set, std::int32_t leaflet_id, const std::vector<std::int32_t> &omitted) {
  TriangleSet made;
  made.xyz = set.xyz;
  for (std::int64_t i = 0; i < set.n_triangles(); ++i) {
    const std::int32_t id = view(set.leaflet_id)[i];
    if (id == leaflet_id || std::find(omitted.begin(), omitted.end(), id) != omitted.end()) continue;
    made.vertex_id.insert(made.vertex_id.end(), set.vertex_id.begin() + 3 * i, set.vertex_id.begin() + 3 * i + 3);
    made.triangle_id.push_back(made.n_triangles());
    made.leaflet_id.push_back(id);
    made.patch_id.push_back(0);
  }
  return made;
}

// Measures the parts of one leaflet that are near the other leaflets. From one point to another, the distance from the other
// leaflets changes by at most the distance between the two points. The distance at the middle of a part therefore often tells
// whether the whole part is within reach. If it does not, the part is halved, unless it is already small. On a small part, the
// distance is approximated by a linear function. The radius of a small part is an eighth of the reach, but at least 1/2000 of the
// surface's extent. This lower limit bounds the work if the reach is tiny.
class Measuring {
 public:
  Measuring(const TriangleScene &scene, double reach, double extent)
      : scene_(scene), reach_(reach), small_(std::max(reach / 8, extent / 2000)) {}

  double area(Vec3 a, Vec3 b, Vec3 c) const {
    const Vec3 middle = (1.0 / 3) * (a + b + c);
    const double radius = std::max({distance(middle, a), distance(middle, b), distance(middle, c)});
    const double away = distance_from(middle, radius);
    if (away > reach_ + radius) return 0;
    const double whole = 0.5 * length(cross(b - a, c - a));
    if (away + radius <= reach_) return whole;
    if (radius <= small_)
      return whole * share_below({distance_from(a, radius) - reach_, distance_from(b, radius) - reach_,
                                  distance_from(c, radius) - reach_});
    // Halves the longest edge.
    const double ab = distance(a, b), bc = distance(b, c), ca = distance(c, a);
    if (ab >= bc && ab >= ca) return halves(c, a, b);
    return bc >= ca ? halves(a, b, c) : halves(b, c, a);
  }

  double length_of(Vec3 a, Vec3 b) const {
    const Vec3 middle = 0.5 * (a + b);
    const double whole = distance(a, b), radius = 0.5 * whole, away = distance_from(middle, radius);
    if (away > reach_ + radius) return 0;
    if (away + radius <= reach_) return whole;
    if (radius > small_) return length_of(a, middle) + length_of(middle, b);
    const double at_a = distance_from(a, radius) - reach_, at_b = distance_from(b, radius) - reach_;
    if (at_a <= 0 && at_b <= 0) return whole;
    if (at_a > 0 && at_b > 0) return 0;
    return whole * std::min(at_a, at_b) / (std::min(at_a, at_b) - std::max(at_a, at_b));
  }

 private:
  double halves(Vec3 tip, Vec3 from, Vec3 to) const {
    const Vec3 middle = 0.5 * (from + to);
    return area(tip, from, middle) + area(tip, middle, to);
  }

  // Returns the distance from p to the other leaflets. If this distance is large, returns only some value above reach + 2 *
  // radius.
  double distance_from(Vec3 p, double radius) const {
    const double limit = reach_ + 3 * radius;
    const ClosestTriangle closest = scene_.closest(p, limit);
    return closest.triangle < 0 ? limit : std::sqrt(closest.distance_sq);
  }

  // `at` has the values of a linear function at the corners of a triangle. Returns the fraction of the triangle's area in which
  // the function is at most 0.
  static double share_below(std::array<double, 3> at) {
    std::sort(at.begin(), at.end());
    if (at[2] <= 0) return 1;
    if (at[0] > 0) return 0;
    if (at[1] > 0) return at[0] * at[0] / ((at[1] - at[0]) * (at[2] - at[0]));
    return 1 - at[2] * at[2] / ((at[2] - at[0]) * (at[2] - at[1]));
  }

  const TriangleScene &scene_;
  double reach_;
  double small_;  // the radius of a small part
};

// Returns the diagonal of the box around a surface.
double extent_of(const TriangleSet &set) {
  Bounds box;
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) box.add(set.vertex(i));
  return 2 * length(box.half_extent());
}

}  // namespace

std::map<std::int32_t, Contact> contacts_of(const TriangleSet &set, const std::vector<EdgePart> &parts, double reach,
                                            std::int32_t wanted, const std::vector<std::int32_t> &omitted,
                                            int n_threads) {
  std::map<std::int32_t, std::vector<std::int64_t>> triangles;
  for (std::int64_t i = 0; i < set.n_triangles(); ++i) triangles[view(set.leaflet_id)[i]].push_back(i);
  const double extent = extent_of(set);
  std::map<std::int32_t, Contact> made;
  for (const auto &[leaflet_id, own] : triangles) {
    if (wanted != RIIS_ALL_LEAFLETS && leaflet_id != wanted) continue;
    Contact &contact = made[leaflet_id] = {0, 0};
    if (std::find(omitted.begin(), omitted.end(), leaflet_id) != omitted.end()) continue;
    const TriangleSet rest = others(set, leaflet_id, omitted);
    if (rest.n_triangles() == 0) continue;
    TriangleScene scene;
    scene.make(rest, n_threads);
    const Measuring measuring(scene, reach, extent);
    std::vector<double> areas(own.size());
    parallel_for(view(own).size(), n_threads, [&, &mine = own](std::int64_t i, int) {
      const auto [a, b, c] = set.corners(view(mine)[i]);
      view(areas)[i] = measuring.area(a, b, c);
    });
    for (const double area : areas) contact.area += area;  // in a fixed order, for any number of threads
    for (const EdgePart &part : parts)
      if (part.leaflet_id == leaflet_id) contact.edge += measuring.length_of(part.from, part.to);
  }
  return made;
}

}  // namespace riis
