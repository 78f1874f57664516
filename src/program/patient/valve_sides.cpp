// SPDX-License-Identifier: Apache-2.0
#include "program/patient/patient_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/array_view.hpp"
#include "common/vectors.hpp"
#include "program/base/handles.hpp"
#include "program/base/text.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/input/valve_source.hpp"
#include "program/input/wall.hpp"
#include "program/mark/moving_valve.hpp"

namespace riis::program {
namespace {

constexpr std::int32_t n_sides_openings = 11;
// The radii of the balls in millimetres. The largest radius for which there is room is used.
constexpr double ball_radii[] = {4, 3, 2, 1.5, 1};
// The places where a ball is tried, in millimetres: steps along the valve's axis, and along lines parallel to the axis.
constexpr int most_along = 150, ring_step = 3, n_rings = 5, n_of_ring = 8;

// Returns places on both sides of the centre, sorted by their distance from the centre. The places depend only on the placement.
// In two meshes of a patient, pressures are therefore read at the same places.
std::vector<double> places_by_distance(const Vector3 &centre, const Vector3 &flow, double millimetre) {
  struct Candidate {
    int along, ring, number;
    int squared() const { return along * along + ring * ring; }
  };
  std::vector<Candidate> places;
  for (int along = -most_along; along <= most_along; ++along)
    for (int ring = 0; ring <= n_rings; ++ring)
      for (int number = 0; number < (ring == 0 ? 1 : n_of_ring); ++number)
        places.push_back({along, ring_step * ring, number});
  std::stable_sort(places.begin(), places.end(), [](const Candidate &a, const Candidate &b) {
    return std::tuple(a.squared(), a.ring) < std::tuple(b.squared(), b.ring);
  });
  std::size_t least = 0;  // the axis of coordinates that is least along the flow
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(flow[k]) < std::abs(flow[least])) least = k;
  Vector3 across{};
  across[least] = 1;
  across = unit_vector(across - dot(across, flow) * flow);
  std::vector<double> xyz;
  for (const Candidate &place : places) {
    const Vector3 away = turned(across, flow, 360.0 / n_of_ring * place.number);
    const Vector3 point = centre + millimetre * (static_cast<double>(place.along) * flow + place.ring * away);
    xyz.insert(xyz.end(), point.begin(), point.end());
  }
  return xyz;
}

}  // namespace

ValveSides sides_of_valve(const std::string &mesh, const MarkOptions &marking, const std::vector<Boundary> &boundaries,
                          const std::array<double, 3> &centre, const std::array<double, 3> &flow, double millimetre) {
  const MeshFile file = read_mesh_file(mesh, "");
  FileNodes nodes(file, mesh);
  nodes.find_neighbors(marking.n_threads);
  const auto at = [&](std::int64_t node) { return nodes.point(node); };
  const std::vector<double> places = places_by_distance(centre, flow, millimetre);
  const auto place = [&](std::size_t i) {
    return Vector3{view(places)[3 * i], view(places)[3 * i + 1], view(places)[3 * i + 2]};
  };
  const Valve valve = make_valve(marking);
  std::vector<double> room = distances_to(wall_of(marking), places);
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
    const std::vector<double> from_valve = distances_to(surface, places);
    for (std::size_t i = 0; i < room.size(); ++i) room[i] = std::min(room[i], view(from_valve)[i] - half_thickness);
    if (opening > 0) continue;
    const riis_mark_options how = how_to_mark_again(marking);
    const Marks marks = marks_of(surface, nodes.mesh(), how);
    check(riis_label_open_regions(nodes.mesh(), marks, &how, nodes.n(), region.data(), nullptr));
  }

  const auto nearest_node = [&](const Vector3 &point) {
    const auto squared = [&](std::int64_t i) { return dot(at(i) - point, at(i) - point); };
    std::int64_t nearest = 0;
    for (std::int64_t i = 1; i < nodes.n(); ++i)
      if (squared(i) < squared(nearest)) nearest = i;
    return nearest;
  };
  // On each side of the valve, the first place with enough room becomes the middle of the ball. A ball beyond the extent of the
  // valve is outside the valve's jet. If the vessel is short, there may be room only beside the leaflets.
  ValveSides sides;
  std::int64_t before = -1, after = -1;  // the nodes at the middles
  const auto find = [&](double sign, double radius, double beyond, std::array<double, 3> &middle) {
    for (std::size_t i = 0; i < room.size(); ++i) {
      if (view(room)[i] < radius || sign * along_flow(place(i)) <= beyond) continue;
      // The wall is closed, so a place is in the blood if its distance to a node is smaller than its distance to the wall.
      const std::int64_t node = nearest_node(place(i));
      if (norm(at(node) - place(i)) >= radius || view(region)[node] < 0) continue;
      middle = place(i);
      return node;
    }
    return std::int64_t{-1};
  };
  for (const double radius : ball_radii) {
    sides.ball_radius = radius * millimetre;
    before = find(-1, sides.ball_radius, sides.ball_radius - first, sides.upstream);
    after = find(1, sides.ball_radius, sides.ball_radius + last, sides.downstream);
    if (before < 0) before = find(-1, sides.ball_radius, 0, sides.upstream);
    if (after < 0) after = find(1, sides.ball_radius, 0, sides.downstream);
    if (before >= 0 && after >= 0) break;
  }
  if (before < 0 || after < 0)
    refuse_data(mesh + ": there is no room for a ball with a radius of 1 mm between the valve and the end " +
                (before < 0 ? "before it" : "after it") +
                ", in which its pressure could be read: cut the vessel farther from the valve, or take a smaller "
                "--half-thickness");
  // Coordinates with few digits are easier to type.
  const auto rounded = [&](const Vector3 &point) {
    Vector3 made;
    for (std::size_t k = 0; k < 3; ++k)
      made[k] = *number_in(printed(millimetre < 0.01 ? "%.5f" : millimetre < 1 ? "%.3f" : "%.2f", point[k]));
    return made;
  };
  sides.upstream = rounded(sides.upstream);
  sides.downstream = rounded(sides.downstream);
  sides.are_apart = view(region)[before] != view(region)[after];
  if (!sides.are_apart) return sides;
  for (const Boundary &end : boundaries) {
    if (end.name == "wall") continue;
    const std::int64_t at_end = nearest_node(end.centre);
    if (view(region)[at_end] == view(region)[before]) sides.before.push_back(end.name);
    if (view(region)[at_end] == view(region)[after]) sides.after.push_back(end.name);
  }
  return sides;
}

}  // namespace riis::program
