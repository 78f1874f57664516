// SPDX-License-Identifier: Apache-2.0
#include "program/patient/valve_sides.hpp"

#include <algorithm>
#include <limits>

#include "common/array_view.hpp"
#include "common/vectors.hpp"
#include "program/base/handles.hpp"
#include "program/base/text.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/input/valve_source.hpp"
#include "program/input/wall.hpp"
#include "program/mark/mesh_marking.hpp"

namespace riis::program {
namespace {

constexpr std::int32_t n_sides_openings = 11;
// Radii of the balls in millimetres: the largest that there is room for is taken.
constexpr double ball_radii[] = {4, 3, 2, 1.5, 1};

}  // namespace

ValveSides sides_of_valve(const std::string &mesh, const MarkOptions &marking, const std::vector<Boundary> &boundaries,
                          const std::array<double, 3> &centre, const std::array<double, 3> &flow, double millimetre) {
  const MeshFile file = read_mesh_file(mesh, "");
  FileNodes nodes(file, mesh);
  nodes.find_neighbors(marking.n_threads);
  std::vector<double> xyz;
  for (std::int64_t i = 0; i < nodes.n(); ++i) {
    const NodePoints::Point point = nodes.point(i);
    xyz.insert(xyz.end(), point.begin(), point.end());
  }
  const auto at = [&](std::int64_t node) {
    return Vector3{view(xyz)[3 * node], view(xyz)[3 * node + 1], view(xyz)[3 * node + 2]};
  };

  const Valve valve = make_valve(marking);
  std::vector<double> away = distances_to(wall_of(marking), xyz);
  std::vector<std::int64_t> region(static_cast<std::size_t>(nodes.n()));
  const double half_thickness = marking.surface_options.half_thickness;
  const auto along_flow = [&](const Vector3 &point) { return dot(point - centre, flow); };
  double first = 0, last = 0;  // the extent of the valve along the flow, at all openings
  for (const double opening : openings_from_0_to_1(n_sides_openings)) {
    check(riis_valve_set_scalar(valve, "opening", opening));
    const auto surface = create<Surface>(riis_surface_create, valve, &marking.surface_options);
    const riis_triangles triangles = triangles_of(surface);
    for (std::int64_t i = 0; i < 3 * triangles.n_vertices; i += 3) {
      const double here = along_flow({triangles.xyz[i], triangles.xyz[i + 1], triangles.xyz[i + 2]});
      first = std::min(first, here);
      last = std::max(last, here);
    }
    const std::vector<double> from_valve = distances_to(surface, xyz);
    for (std::size_t i = 0; i < away.size(); ++i) away[i] = std::min(away[i], from_valve[i] - half_thickness);
    if (opening > 0) continue;
    const riis_mark_options how = how_to_mark_again(marking);
    const Marks marks = marks_of(surface, nodes.mesh(), how);
    const FileNodes::Lent lent(nodes);
    check(riis_label_open_regions(nodes.mesh(), marks, &how, nodes.n(), region.data(), nullptr));
  }

  // Of the nodes with room for a ball, the nearest to the annulus on each side is the middle of a ball. Balls beyond the valve's
  // extent are not in its jet. A short vessel has room only beside the leaflets.
  ValveSides sides;
  std::int64_t before = -1, after = -1;
  const auto nearest = [&](double sign, double radius, double beyond) {
    double least = std::numeric_limits<double>::infinity();
    std::int64_t found = -1;
    for (std::int64_t i = 0; i < nodes.n(); ++i) {
      const double far = norm(at(i) - centre);
      if (view(away)[i] < radius || view(region)[i] < 0 || sign * along_flow(at(i)) <= beyond || far >= least) continue;
      least = far;
      found = i;
    }
    return found;
  };
  for (const double radius : ball_radii) {
    sides.ball_radius = radius * millimetre;
    before = nearest(-1, sides.ball_radius, sides.ball_radius - first);
    after = nearest(1, sides.ball_radius, sides.ball_radius + last);
    if (before < 0) before = nearest(-1, sides.ball_radius, 0);
    if (after < 0) after = nearest(1, sides.ball_radius, 0);
    if (before >= 0 && after >= 0) break;
  }
  if (before < 0 || after < 0)
    refuse_data(mesh + ": there is no room for a ball with a radius of 1 mm between the valve and the end " +
                (before < 0 ? "before it" : "after it") +
                ", in which its pressure could be read: cut the vessel farther from the valve, or take a smaller "
                "--half-thickness");
  // Short numbers are easier to type.
  const auto rounded = [&](const Vector3 &point) {
    Vector3 made;
    for (std::size_t k = 0; k < 3; ++k)
      made[k] = *number_in(printed(millimetre < 0.01 ? "%.5f" : millimetre < 1 ? "%.3f" : "%.2f", point[k]));
    return made;
  };
  sides.upstream = rounded(at(before));
  sides.downstream = rounded(at(after));
  sides.are_apart = view(region)[before] != view(region)[after];
  if (!sides.are_apart) return sides;
  for (const Boundary &end : boundaries) {
    if (end.name == "wall") continue;
    std::int64_t at_end = 0;
    for (std::int64_t i = 0; i < nodes.n(); ++i)
      if (norm(at(i) - end.centre) < norm(at(at_end) - end.centre)) at_end = i;
    if (view(region)[at_end] == view(region)[before]) sides.before.push_back(end.name);
    if (view(region)[at_end] == view(region)[after]) sides.after.push_back(end.name);
  }
  return sides;
}

}  // namespace riis::program
