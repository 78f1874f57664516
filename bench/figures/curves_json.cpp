// SPDX-License-Identifier: Apache-2.0
#include "figures/curves_json.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "figures/shapes.hpp"

namespace riis::figures {
namespace {

using nlohmann::json;

constexpr const char *cusp_names[3] = {"right", "left", "non_coronary"};

json json_of(Vec3 p) { return {p.x, p.y, p.z}; }

json json_of(const Bezier &piece) {
  json points = json::array();
  for (std::size_t i = 0; i <= static_cast<std::size_t>(piece.degree); ++i) points.push_back(json_of(piece.control[i]));
  return points;
}

json json_of(const Pieces &pieces) {
  json made = json::array();
  for (const Bezier &piece : pieces) made.push_back(json_of(piece));
  return made;
}

json parameters_of(const ValveKind &kind) {
  json made = json::array();
  for (const ParameterSpec &spec : kind.parameters) {
    const std::vector<double> values(spec.default_values.begin(), spec.default_values.begin() + spec.n_values);
    made.push_back({{"name", spec.name}, {"unit", spec.unit}, {"values", values}, {"description", spec.description}});
  }
  return made;
}

json json_of(const CuspCurves &curves) {
  return {{"leaflet", {json_of(curves.leaflet[0]), json_of(curves.leaflet[1])}},
          {"bending", {json_of(curves.bending[0]), json_of(curves.bending[1])}},
          {"sinus", {json_of(curves.sinus[0]), json_of(curves.sinus[1])}},
          {"symmetry", json_of(curves.symmetry)}};
}

// Returns the given patches in their own frames, before cusps are turned and moved.
PatchSet in_own_frames(PatchSet set) {
  for (Patch &patch : set.patches)
    for (PatchImage &image : patch.images) {
      image.rotation = no_rotation;
      image.translation = {0, 0, 0};
    }
  return set;
}

// Describes a valve that opens to the state given by its own parameters.
json openings() {
  Valve valve(find_valve_kind("aortic"));
  json states = json::array();
  for (const double opening : {0.0, 0.5, 1.0}) {
    valve.set("opening", 1, &opening);
    json cusps = json::array();
    for (std::int32_t cusp = 0; cusp < 3; ++cusp)
      cusps.push_back(json_of(cusp_curves(in_own_frames(valve.make_patches()), cusp)));
    states.push_back({{"opening", opening}, {"cusps", cusps}});
  }
  return states;
}

json aortic() {
  const Valve valve(find_valve_kind("aortic"));
  const PatchSet placed = valve.make_patches(), own = in_own_frames(placed);
  json cusps = json::array();
  for (std::int32_t cusp = 0; cusp < 3; ++cusp)
    cusps.push_back({{"name", cusp_names[cusp]},
                     {"own_frame", json_of(cusp_curves(own, cusp))},
                     {"placed", json_of(cusp_curves(placed, cusp))}});
  return {{"parameters", parameters_of(valve.kind())}, {"cusps", cusps}, {"openings", openings()}};
}

// Adds arcs from the annulus to the free edges on the half x >= 0, at fractions u of the annulus' length from its posterior
// point. "lines" has the ends of many arcs. "arcs" has the arcs between two patches.
void add_arcs(json &state, const PatchSet &set) {
  constexpr int n = 32;
  double whole = 0;
  for (const Patch &patch : set.patches) whole += 2 * set.curves[patch.v0.curve].length();
  const auto curve = [&](const Side &side) {
    return side.reversed ? set.curves[side.curve].reversed() : set.curves[side.curve];
  };
  double u = 0.5;  // patches go from the anterior to the posterior point
  for (const Patch &patch : set.patches) {
    const PatchImage &image = patch.images.front();
    const Curve base = curve(patch.v0), edge = curve(patch.v1);
    for (int i = 0; i <= n; ++i) {
      const double share = static_cast<double>(i) / n;
      state["lines"].push_back({{"u", u - share * base.length() / whole},
                                {"annulus", json_of(place(image, base.at(share)))},
                                {"edge", json_of(place(image, edge.at(share)))},
                                {"leaflet", image.leaflet_id}});
    }
    state["arcs"].push_back({{"u", u}, {"curve", json_of(placed(set, patch.u0, image))}});
    u -= base.length() / whole;
  }
  const Patch &last = set.patches.back();
  state["arcs"].push_back({{"u", u}, {"curve", json_of(placed(set, last.u1, last.images.front()))}});
}

json mitral() {
  Valve valve(find_valve_kind("mitral"));
  json states = json::array();
  for (const double opening : {0.0, 0.5, 1.0}) {
    valve.set("opening", 1, &opening);
    const PatchSet set = valve.make_patches();
    const MitralCurves curves = mitral_curves(set);
    json state = {{"opening", opening},
                  {"annulus", json_of(curves.annulus)},
                  {"anterior", json_of(curves.anterior)},
                  {"posterior", json_of(curves.posterior)}};
    add_arcs(state, set);
    states.push_back(state);
  }
  return {{"parameters", parameters_of(valve.kind())}, {"states", states}};
}

// Describes one cusp in its own frame, and all cusps in place: closed, and partly open.
json equal_cusps(const char *kind) {
  Valve valve(find_valve_kind(kind));
  json states = json::array();
  for (const double opening : {0.0, 0.5, 1.0}) {
    valve.set("opening", 1, &opening);
    const PatchSet placed = valve.make_patches();
    json cusps = json::array();
    for (std::int32_t cusp = 0; cusp < 3; ++cusp) cusps.push_back(json_of(cusp_curves(placed, cusp)));
    states.push_back({{"opening", opening},
                      {"own_frame", json_of(cusp_curves(in_own_frames(placed), RIIS_LEAFLET_RIGHT))},
                      {"cusps", cusps}});
  }
  return {{"parameters", parameters_of(valve.kind())}, {"states", states}};
}

// Lengths that are 0 by default have other values here, so that they are visible.
json bileaflet() {
  const std::pair<const char *, double> shown[] = {{"gap", 0.1}, {"hinge_height", 0.14}, {"ring_height", 1.4}};
  Valve valve(find_valve_kind("bileaflet"));
  json example = json::object(), states = json::array();
  for (const auto &[name, value] : shown) {
    valve.set(name, 1, &value);
    example[name] = value;
  }
  for (const double opening : {0.0, 0.5, 1.0}) {
    valve.set("opening", 1, &opening);
    const PatchSet set = valve.make_patches();
    json halves = json::array();
    for (const Patch &patch : set.patches)
      for (const PatchImage &image : patch.images)
        halves.push_back({{"leaflet", image.leaflet_id},
                          {"v0", json_of(placed(set, patch.v0, image))},
                          {"v1", json_of(placed(set, patch.v1, image))},
                          {"u0", json_of(placed(set, patch.u0, image))}});
    states.push_back({{"opening", opening}, {"halves", halves}});
  }
  return {{"parameters", parameters_of(valve.kind())}, {"example", example}, {"states", states}};
}

}  // namespace

void write_curves(const std::string &path) {
  std::ofstream out(path, std::ios::binary);
  out << json{{"aortic", aortic()},
              {"trileaflet", equal_cusps("trileaflet")},
              {"coapting", equal_cusps("coapting")},
              {"mitral", mitral()},
              {"bileaflet", bileaflet()}}
             .dump(1)
      << "\n";
  out.close();
  if (!out) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace riis::figures
