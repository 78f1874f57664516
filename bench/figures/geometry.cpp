// SPDX-License-Identifier: Apache-2.0
// Writes the geometry of valves: their curves, the sides of their patches, their quads and triangles. In the output, a Bézier
// curve is a list of control points, and a curve is a list of spans.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "figures/numbers.hpp"
#include "triangulate/grids.hpp"
#include "triangulate/triangulate.hpp"
#include "valve/valve.hpp"

namespace riis::figures {
namespace {

using nlohmann::json;

constexpr double half_thickness = 0.1;

struct NamedSide {
  const char *name;
  Side Patch::*side;
};
constexpr std::array<NamedSide, 4> sides = {
    {{"v0", &Patch::v0}, {"v1", &Patch::v1}, {"u0", &Patch::u0}, {"u1", &Patch::u1}}};

json json_of(Vec3 p) { return {p.x, p.y, p.z}; }

json json_of(const Bezier &piece) {
  json points = json::array();
  for (std::size_t i = 0; i <= static_cast<std::size_t>(piece.degree); ++i) points.push_back(json_of(piece.control[i]));
  return points;
}

json json_of(const PatchSet &set, const Side &side, const PatchImage &image) {
  json pieces = json::array();
  const Curve curve = along(set, side);
  for (Bezier piece : curve.spans()) {
    for (Vec3 &control : piece.control) control = place(image, control);
    pieces.push_back(json_of(piece));
  }
  return pieces;
}

// "lengths" has the length of each side. "own_frame" has the sides before the image is turned and moved. "ends_of_lines" has
// points of the sides v0 and v1, in equal steps of length along each side.
json json_of(const PatchSet &set, std::size_t patch_number, const PatchImage &image) {
  constexpr int n_lines = 32;
  const Patch &patch = set.patches[patch_number];
  PatchImage own = image;
  own.rotation = no_rotation;
  own.translation = {0, 0, 0};
  json made = {{"patch", patch_number}, {"leaflet", image.leaflet_id}};
  for (const auto &[name, side] : sides) {
    made["placed"][name] = json_of(set, patch.*side, image);
    made["own_frame"][name] = json_of(set, patch.*side, own);
    made["lengths"][name] = set.curve_of(patch.*side).length();
  }
  const Curve base = along(set, patch.v0), edge = along(set, patch.v1);
  for (int i = 0; i <= n_lines; ++i) {
    const double share = static_cast<double>(i) / n_lines;
    made["ends_of_lines"].push_back({json_of(place(image, base.at(share))), json_of(place(image, edge.at(share)))});
  }
  return made;
}

json images_of(const PatchSet &set) {
  json images = json::array();
  for (std::size_t i = 0; i < set.patches.size(); ++i)
    for (const PatchImage &image : set.patches[i].images) images.push_back(json_of(set, i, image));
  return images;
}

json parameters_of(const ValveKind &kind) {
  json made = json::array();
  for (const ParameterSpec &spec : kind.parameters) {
    const std::vector<double> values(spec.default_values.begin(), spec.default_values.begin() + spec.n_values);
    made.push_back({{"name", spec.name}, {"unit", spec.unit}, {"values", values}, {"description", spec.description}});
  }
  return made;
}

Valve valve_of(const std::string &kind, const json &settings) {
  Valve valve(find_valve_kind(kind));
  for (const auto &[name, value] : settings.items()) {
    const double number = value;
    valve.set(name, 1, &number);
  }
  return valve;
}

// "example" sets the parameters that differ from their defaults. If the default of a length is 0, "example" sets another value,
// so that the drawing shows the length.
json valve_at_openings(const std::string &kind, json example) {
  json states = json::array();
  for (const double opening : {0.0, 0.5, 1.0}) {
    json settings = example;
    settings["opening"] = opening;
    states.push_back({{"opening", opening}, {"images", images_of(valve_of(kind, settings).make_patches())}});
  }
  return {{"parameters", parameters_of(find_valve_kind(kind))}, {"example", std::move(example)}, {"states", states}};
}

// Returns a set with only the image that has the given patch_id.
PatchSet only(const PatchSet &set, int patch_id) {
  PatchSet made;
  made.curves = set.curves;
  for (const Patch &patch : set.patches)
    for (const PatchImage &image : patch.images)
      if (image.patch_id == patch_id) {
        made.patches = {patch};
        made.patches[0].images = {image};
      }
  return made;
}

// Returns the lines of a patch's grid, the points of its image, and the boundary points on the curves. The boundary points are
// the vertices of the curves' polylines. A side that is a point has one boundary point.
json json_of(const PatchSet &set, const Patch &patch, const QuadGrid &grid, const PatchImage &image, Numbers &numbers) {
  const std::size_t n_u = grid.u.size(), n_v = grid.v.size();
  std::vector<double> points;
  for (const Vec3 &own : grid.points) {
    const Vec3 p = place(image, own);
    points.insert(points.end(), {p.x, p.y, p.z});
  }
  const auto vertices = [&](const Side &side, const Vector<double> &t, const auto &point) {
    const Curve curve = along(set, side);
    std::vector<std::size_t> found;
    if (curve.length() == 0) return std::vector<std::size_t>{0};
    for (std::size_t i = 0; i < t.size(); ++i)
      if (distance(point(i), curve.at(t[i])) <= 1e-9) found.push_back(i);
    return found;
  };
  return {{"u", grid.u},
          {"v", grid.v},
          {"points", numbers.put(points)},
          {"on_curves",
           {{"v0", vertices(patch.v0, grid.u, [&](std::size_t i) { return grid.point(i, 0); })},
            {"v1", vertices(patch.v1, grid.u, [&](std::size_t i) { return grid.point(i, n_v - 1); })},
            {"u0", vertices(patch.u0, grid.v, [&](std::size_t j) { return grid.point(0, j); })},
            {"u1", vertices(patch.u1, grid.v, [&](std::size_t j) { return grid.point(n_u - 1, j); })}}}};
}

json json_of(const Bezier &curve, double flatness) { return {{"controls", json_of(curve)}, {"flatness", flatness}}; }

json polyline_of(const Curve &curve, double max_error) {
  const Flattened flat = flatten(curve, max_error);
  json points = json::array(), tangents = json::array();
  double measured = 0;
  for (std::size_t i = 0; i < flat.points.size(); ++i) {
    points.push_back(json_of(flat.points[i]));
    tangents.push_back(json_of(curve.with_tangent(flat.t[i]).tangent));
    for (int k = 0; i + 1 < flat.points.size() && k <= 50; ++k) {
      const double s = k / 50.0, t = std::min(1.0, (1 - s) * flat.t[i] + s * flat.t[i + 1]);
      measured = std::max(measured, distance(mix(flat.points[i], flat.points[i + 1], s), curve.at(t)));
    }
  }
  return {{"max_error", max_error}, {"points", points},
          {"tangents", tangents},   {"t", flat.t},
          {"measured", measured},   {"bound", *std::max_element(flat.errors.begin(), flat.errors.end())}};
}

}  // namespace

json model(const std::string &kind, double tolerance, const json &settings, std::optional<int> patch_id,
           Numbers &numbers) {
  PatchSet set = valve_of(kind, settings).make_patches();
  if (patch_id) set = only(set, *patch_id);
  const double max_error = tolerance * half_thickness;
  const Vector<QuadGrid> grids = make_grids(set, max_error);
  json images = json::array();
  for (std::size_t k = 0; k < grids.size(); ++k) {
    const QuadGrid &grid = grids[k];
    std::size_t n_halved = 0;
    for (std::size_t j = 0; j + 1 < grid.v.size(); ++j)
      for (std::size_t i = 0; i + 1 < grid.u.size(); ++i) {
        const Quad quad{grid.point(i, j), grid.point(i + 1, j), grid.point(i + 1, j + 1), grid.point(i, j + 1)};
        n_halved += split_error(quad) > max_error - grid.error(i, j);
      }
    for (const PatchImage &image : set.patches[k].images) {
      images.push_back(json_of(set, k, image));
      images.back()["patch_id"] = image.patch_id;
      images.back()["n_halved"] = n_halved;
      images.back()["grid"] = json_of(set, set.patches[k], grid, image, numbers);
    }
  }
  const TriangleSet triangles =
      triangulate_adapted(set, {max_error, {1, rotation_xyz({0, 0, 0}), {0, 0, 0}}, false, 1});
  return {{"images", images},
          {"triangles",
           {{"points", numbers.put(triangles.xyz)},
            {"uv", numbers.put(triangles.uv)},
            {"corners", numbers.put(triangles.vertex_id)},
            {"leaflet", numbers.put(triangles.leaflet_id)}}}};
}

json valves() {
  json all = json::object();
  for (const char *kind : {"aortic", "trileaflet", "coapting", "mitral"})
    all[kind] = valve_at_openings(kind, json::object());
  all["bileaflet"] = valve_at_openings("bileaflet", {{"gap", 0.1}, {"hinge_height", 0.14}, {"ring_height", 1.4}});
  return all;
}

json polylines() {
  const Bezier curve = Bezier::cubic({0, 0, 0}, {0.4, 2.5, 0}, {2.1, 2.9, 0}, {4.2, 0.3, 0});
  const double length = arc_length(curve), middle = parameter_at_length(curve, length, 0.5 * length);
  const auto [left, right] = split(curve, middle);
  json made = {{"curve", json_of(curve, flatness(curve))},
               {"left", json_of(left, flatness(left))},
               {"right", json_of(right, flatness(right))},
               {"length", length},
               {"middle", middle}};
  for (const double max_error : {0.3, 0.05, 0.01, 0.002})
    made["polylines"].push_back(polyline_of(Curve(curve), max_error));
  return made;
}

}  // namespace riis::figures
