// SPDX-License-Identifier: Apache-2.0
// Calls of riis_valve_*.
#include <algorithm>
#include <cmath>
#include <string>

#include "api_state.hpp"

namespace fuzz {
namespace {

const char *const names[] = {"opening",
                             "root_radius",
                             "leaflet_height",
                             "bending_height",
                             "t3_leaflet",
                             "xq",
                             "zq",
                             "right.rotation",
                             "leaflet_angle",
                             "translation",
                             "left.translation",
                             "leaflet_power",
                             "non_coronary.bending_power",
                             "rotation",
                             "right.leaflet_radius_in",
                             "bending_radius_out",
                             "AP_diameter",
                             "ALPM_diameter",
                             "IT_distance",
                             "indent_depth",
                             "anterior_ratio",
                             "anterior_length",
                             "surface_angle",
                             "leaflet_arc_angle",
                             "leaflet_inward_angle",
                             "triangle_size_ratio",
                             "posterior_scallop_length1",
                             "anterior_horn_height",
                             "ALPM_position_ratio",
                             "posteromedial_commissure_height",
                             "open_radius_ratio",
                             "commissure_expansion",
                             "commissure_radius",
                             "coaptation_height",
                             "gap",
                             "annulus",
                             "stj",
                             "right.stj",
                             "effective_height",
                             "bogus",
                             "",
                             ".",
                             "right.",
                             "t0_leaflet",
                             "%s%n"};

// Returns the values of every parameter.
std::vector<double> values_of(const riis_valve *valve) {
  std::vector<double> all;
  std::int64_t n = -1;
  EXPECT_OK(riis_valve_get_n_parameters(valve, &n));
  EXPECT(n >= 1, "%lld parameters", static_cast<long long>(n));
  for (std::int64_t i = 0; i < n; ++i) {
    riis_parameter parameter;
    EXPECT_OK(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    double values[3] = {0, 0, 0};
    EXPECT_OK(riis_valve_get(valve, parameter.name, parameter.n_values, values));
    std::int32_t is_set = -1;
    EXPECT_OK(riis_valve_is_set(valve, parameter.name, &is_set));
    EXPECT(is_set == 0 || is_set == 1, "%s: is_set is %d", parameter.name, is_set);
    // A value that follows a rule may be out of range. The valve then cannot make a surface.
    for (std::int64_t k = 0; k < parameter.n_values && (is_set || !*parameter.rule); ++k)
      EXPECT(values[k] >= parameter.minimum && values[k] <= parameter.maximum, "%s is %g", parameter.name, values[k]);
    all.insert(all.end(), values, values + 3);
  }
  return all;
}

ValveSlot &slot_of(Input &in, State &state) { return state.valves[in.slot()]; }

void put(ValveSlot &slot, riis_valve *valve, double size) {
  if (!valve) return;
  riis_valve_destroy(&slot.handle);
  slot = {valve, size};
}

}  // namespace

void make_valve(Input &in, State &state) {
  static const char *const kinds[] = {"aortic",          "mitral",    "trileaflet", "coapting",     "mitral",
                                      "coapting",        "aortic",    "bicuspid",   "quadricuspid", "tricuspid",
                                      "mitral_coapting", "pulmonary", "",           nullptr};
  ValveSlot &slot = slot_of(in, state);
  const char *kind = in.one_of(kinds);
  put(slot, made_by<riis_valve>(in, [&](riis_valve **valve) { return riis_valve_create(kind, valve); }), 1);
}

void set_parameter(Input &in, State &state) {
  ValveSlot &slot = slot_of(in, state);
  const Given<riis_valve> valve = given(in, state, State::valve, slot.handle);
  const char *name = mostly(in, in.one_of(names));
  static const std::int64_t lengths[] = {1, 3, 1, 3, 0, 2, -1};
  const std::int64_t n = in.one_of(lengths);
  const std::vector<double> before = slot.handle ? values_of(slot.handle) : std::vector<double>{};
  std::vector<double> values(static_cast<std::size_t>(std::max<std::int64_t>(n, 1)));
  // A new value is near the old value, within the range, or arbitrary.
  for (double &value : values) value = in.number();
  riis_parameter parameter;
  if (slot.handle && in.one_in(2) &&
      riis_valve_get_parameter(slot.handle, in.below(24), &parameter, sizeof parameter) == RIIS_OK) {
    name = parameter.name;
    for (std::size_t k = 0; k < values.size() && k < 3; ++k)
      values[k] = parameter.default_values[k] * (0.75 + in.byte() / 512.0) + (in.one_in(4) ? values[k] : 0);
  }
  riis_status status;
  if (in.one_in(8))
    status = call(in, [&] { return riis_valve_unset(valve.handle, name); });
  else if (n == 1 && in.one_in(2))
    status = call(in, [&] { return riis_valve_set_scalar(valve.handle, name, values[0]); });
  else
    status = call(in, [&] { return riis_valve_set(valve.handle, name, n, mostly(in, values.data())); });
  if (!valve.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (slot.handle && status != RIIS_OK) {
    const std::vector<double> after = values_of(slot.handle);
    EXPECT(before == after, "a refused setting changed a parameter: %s", riis_last_error());
  }
}

// Places a valve by landmarks. The landmarks are those of a trileaflet valve, points on a circle, or any points. A refused call
// changes nothing.
void place_valve(Input &in, State &state) {
  ValveSlot &slot = slot_of(in, state);
  const Given<riis_valve> valve = given(in, state, State::valve, slot.handle);
  const int n = in.one_in(4) ? in.below(20) : 6;
  const bool is_ring = in.one_in(3);
  std::vector<double> xyz(3 * static_cast<std::size_t>(n) + 1);
  std::vector<std::int32_t> role(static_cast<std::size_t>(n) + 1), leaflet(2 * static_cast<std::size_t>(n) + 1, -1);
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / n, noise = in.byte() / 2560.0;
    xyz[3 * i] = std::cos(angle) + noise;
    xyz[3 * i + 1] = std::sin(angle);
    xyz[3 * i + 2] = is_ring || i % 2 == 0 ? noise : 1.3;
    role[i] = is_ring ? (i == 0 ? RIIS_LANDMARK_ANTERIOR_HORN : RIIS_LANDMARK_ANNULUS)
                      : (i % 2 == 0 ? RIIS_LANDMARK_NADIR : RIIS_LANDMARK_COMMISSURE);
    if (in.one_in(24)) role[i] = in.below(12) - 1;
    if (in.one_in(24)) xyz[3 * i + static_cast<std::size_t>(in.below(3))] = in.number();
    if (!is_ring && i % 2 == 0 && in.one_in(2)) leaflet[2 * i] = static_cast<std::int32_t>(i / 2);
    if (in.one_in(32)) leaflet[2 * i + 1] = in.below(5) - 1;
  }
  riis_landmarks landmarks = initialised(in, riis_landmarks_init);
  landmarks.n_landmarks = in.one_in(32) ? in.below(n + 1) - 1 : n;
  landmarks.x = mostly(in, xyz.data());
  landmarks.y = xyz.data() + 1;
  landmarks.z = xyz.data() + 2;
  landmarks.stride = 3;
  landmarks.role = mostly(in, role.data());
  landmarks.leaflet_id = in.one_in(2) ? leaflet.data() : nullptr;
  landmarks.scale = in.one_in(16) ? in.number() : 1;
  if (in.one_in(4)) landmarks.noise = in.number();
  if (in.one_in(2)) landmarks.flow[2] = in.one_in(4) ? in.number() : 1;
  std::vector<double> residual(static_cast<std::size_t>(n) + 1, -77.5);
  riis_placement_arrays arrays = initialised(in, riis_placement_arrays_init);
  arrays.residual = residual.data();
  const std::vector<double> before = slot.handle ? values_of(slot.handle) : std::vector<double>{};
  static const char *const held[] = {
      "", "", "", "leaflet_height", "root_radius, AP_diameter", "bogus", "leaflet_power"};
  riis_placement placement;
  const riis_status status = call(in, [&] {
    return riis_place(valve.handle, &landmarks, mostly(in, in.one_of(held)), &arrays, &placement,
                      in.mostly<std::int64_t>(sizeof placement));
  });
  if (status == RIIS_OK) {
    for (int i = 0; i < n; ++i)
      EXPECT(residual[static_cast<std::size_t>(i)] >= 0 || landmarks.n_landmarks < n, "residual %d", i);
    values_of(slot.handle);
  } else {
    EXPECT(residual[0] == -77.5, "a refused call wrote a residual");
    if (slot.handle)
      EXPECT(before == values_of(slot.handle), "a refused call changed a parameter: %s", riis_last_error());
  }
}

// Warps a valve by landmarks on a ring around it, or by any points. Reads the valve's patches, and then gives the valve a skirt
// to a wall.
void warp_valve(Input &in, State &state) {
  ValveSlot &slot = slot_of(in, state);
  const Given<riis_valve> valve = given(in, state, State::valve, slot.handle);
  const std::size_t n = in.one_in(4) ? static_cast<std::size_t>(in.below(12)) : 6;
  std::vector<double> from(3 * n + 1), to(3 * n + 1), mapped(3 * n + 1, -77.5);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n);
    const double at[] = {std::cos(angle), std::sin(angle), i % 2 == 0 ? 0.0 : 1.3};
    for (std::size_t k = 0; k < 3; ++k) {
      from[3 * i + k] = in.one_in(32) ? in.number() : at[k];
      to[3 * i + k] = in.one_in(32) ? in.number() : at[k] + in.byte() / 2560.0;
    }
  }
  riis_points points = initialised(in, riis_points_init);
  points.n_points = in.one_in(32) ? in.below(14) - 1 : static_cast<std::int64_t>(n);
  if (points.n_points > static_cast<std::int64_t>(n)) points.n_points = static_cast<std::int64_t>(n);
  points.stride = 3;
  const auto at = [&](const std::vector<double> &xyz) {
    points.x = mostly(in, xyz.data());
    points.y = xyz.data() + 1;
    points.z = xyz.data() + 2;
  };
  riis_warp_options options = initialised(in, riis_warp_options_init);
  if (in.one_in(4)) options.noise = in.number();
  at(from);
  riis_warp *warp = made_by<riis_warp>(in, [&](riis_warp **made) {
    return riis_warp_create(mostly(in, &points), in.one_in(2) ? &options : nullptr, made);
  });
  if (!warp) return;
  at(to);
  static_cast<void>(call(in, [&] { return riis_warp_set_targets(warp, mostly(in, &points)); }));
  riis_warp_info info;
  EXPECT_OK(riis_warp_get_info(warp, &info, sizeof info));
  EXPECT(info.least_determinant > 0 && info.rms_residual >= 0, "determinant %g", info.least_determinant);
  at(from);
  if (call(in, [&] { return riis_warp_map(warp, &points, mostly(in, mapped.data())); }) != RIIS_OK)
    EXPECT(mapped[0] == -77.5, "a refused map was written");
  riis_status status =
      call(in, [&] { return riis_valve_set_warp(valve.handle, mostly(in, warp), in.one_in(4) ? warp : nullptr); });
  if (!valve.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  riis_warp_destroy(&warp);
  EXPECT(warp == nullptr, "a destroyed warp is not NULL");
  riis_valve_patches patches;
  status =
      call(in, [&] { return riis_valve_get_patches(valve.handle, &patches, in.mostly<std::int64_t>(sizeof patches)); });
  if (status == RIIS_OK) EXPECT(patches.n_patches > 0 && patches.n_pieces >= patches.n_curves, "no patches");
  const Given<riis_surface> wall = given(in, state, State::surface, state.surfaces[in.slot()]);
  const double longest = in.number();
  static_cast<void>(
      call(in, [&] { return riis_valve_set_skirt_to_wall(valve.handle, wall.handle, longest, nullptr); }));
}

void read_parameters(Input &in, State &state) {
  ValveSlot &slot = slot_of(in, state);
  const Given<riis_valve> valve = given(in, state, State::valve, slot.handle);
  std::int64_t n = -9;
  riis_status status = call(in, [&] { return riis_valve_get_n_parameters(valve.handle, mostly(in, &n)); });
  EXPECT((status == RIIS_OK) == (n != -9), "%d, n = %lld", status, static_cast<long long>(n));

  const auto parameter = std::make_unique<riis_parameter>();
  std::memset(static_cast<void *>(parameter.get()), 0x5a, sizeof *parameter);
  const std::int64_t id = in.mostly<std::int64_t>(in.below(50) - 1), size = in.mostly<std::int64_t>(sizeof *parameter);
  status = call(in, [&] { return riis_valve_get_parameter(valve.handle, id, mostly(in, parameter.get()), size); });
  if (status != RIIS_OK)
    EXPECT(parameter->n_values == 0x5a5a5a5a5a5a5a5a, "a refused description was written");
  else
    EXPECT(id >= 0 && parameter->name[0] != '\0', "parameter %lld", static_cast<long long>(id));

  const std::int64_t n_values = in.mostly<std::int64_t>(in.one_in(2) ? 3 : 1);
  std::vector<double> values(3, -77.5);
  status =
      call(in, [&] { return riis_valve_get(valve.handle, mostly(in, in.one_of(names)), n_values, values.data()); });
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT(status == RIIS_OK && static_cast<std::int64_t>(k) < n_values ? values[k] != -77.5 : values[k] == -77.5,
           "status %d, value %zu is %g", status, k, values[k]);
}

void set_open_state(Input &in, State &state) {
  ValveSlot &slot = slot_of(in, state), &other = slot_of(in, state);
  const Given<riis_valve> valve = given(in, state, State::valve, slot.handle),
                          open = given(in, state, State::valve, other.handle);
  const riis_status status = call(in, [&] { return riis_valve_set_open_state(valve.handle, open.handle); });
  if (!valve.is_right || !open.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status == RIIS_OK) slot.size = std::max(slot.size, other.size);
  if (!in.one_in(2)) return;
  const double opening = in.byte() / 255.0;
  static_cast<void>(call(in, [&] { return riis_valve_set_scalar(slot.handle, "opening", opening); }));
}

namespace {

// Makes a strip of patches between two rails. Rungs are curves across the strip, and a rung at each end of a patch closes the
// patch's boundary.
struct Strip {
  std::vector<std::int32_t> degree, curve_id, reversed, leaflet_id;
  std::vector<double> control;

  using Point = std::array<double, 3>;

  explicit Strip(Input &in) {
    const int n_patches = 1 + in.below(3);
    std::array<std::vector<Point>, 2> corner;
    for (auto &rail : corner)
      for (int i = 0; i <= n_patches; ++i) rail.push_back({in.place(), in.place(), in.place()});
    // The curves are rungs 0 to n, then the spans of the first rail, then those of the second.
    for (std::size_t i = 0; i < corner[0].size(); ++i) add(in, corner[0][i], corner[1][i]);
    for (const auto &rail : corner)
      for (std::size_t i = 0; i + 1 < rail.size(); ++i) add(in, rail[i], rail[i + 1]);
    for (int i = 0; i < n_patches; ++i) {
      for (const int curve : {n_patches + 1 + i, 2 * n_patches + 1 + i, i, i + 1}) {
        curve_id.push_back(curve);
        reversed.push_back(is_turned_[static_cast<std::size_t>(curve)] ? 1 : 0);
      }
      leaflet_id.push_back(in.below(4));
    }
  }

 private:
  void add(Input &in, Point from, Point to) {
    const bool is_turned = in.one_in(4);
    if (is_turned) std::swap(from, to);
    is_turned_.push_back(is_turned);
    degree.push_back(1 + in.below(3));
    control.insert(control.end(), from.begin(), from.end());
    for (int k = 1; k < degree.back(); ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        control.push_back(in.one_in(4) ? in.place() : from[axis] + (to[axis] - from[axis]) * in.below(3) / 2);
    control.insert(control.end(), to.begin(), to.end());
  }

  std::vector<bool> is_turned_;
};

template <class T>
void spoil(Input &in, std::vector<T> &values, T value) {
  if (!values.empty() && in.one_in(16)) values[static_cast<std::size_t>(in.byte()) % values.size()] = value;
}

}  // namespace

void make_valve_of_patches(Input &in, State &state) {
  ValveSlot &slot = slot_of(in, state);
  Strip strip(in);
  double largest = 0;
  for (const double q : strip.control) largest = std::isfinite(q) ? std::max(largest, std::abs(q)) : largest;
  riis_patches patches = initialised(in, riis_patches_init);
  patches.n_curves = static_cast<std::int64_t>(strip.degree.size());
  patches.n_patches = static_cast<std::int64_t>(strip.leaflet_id.size());
  patches.index_base = in.mostly(in.one_in(4) ? 1 : 0);
  for (std::int32_t &curve : strip.curve_id) curve += patches.index_base == 1 ? 1 : 0;
  // A degree may become smaller, so that fewer control points are read.
  if (in.one_in(16)) strip.degree[static_cast<std::size_t>(in.byte()) % strip.degree.size()] = in.below(3) - 1;
  if (in.one_in(32)) strip.degree.back() = in.raw<std::int32_t>() | 4;
  spoil(in, strip.curve_id, in.raw<std::int32_t>());
  spoil(in, strip.curve_id, in.below(8));
  spoil(in, strip.reversed, in.below(4) - 1);
  spoil(in, strip.leaflet_id, in.raw<std::int32_t>());
  spoil(in, strip.control, in.number());
  if (in.one_in(32)) patches.n_curves = in.below(static_cast<int>(patches.n_curves) + 1) - 1;
  if (in.one_in(32)) patches.n_patches = in.below(static_cast<int>(patches.n_patches) + 1) - 1;
  patches.degree = mostly(in, strip.degree.data());
  patches.control = mostly(in, strip.control.data());
  patches.curve_id = mostly(in, strip.curve_id.data());
  patches.reversed = mostly(in, strip.reversed.data());
  patches.leaflet_id = mostly(in, strip.leaflet_id.data());
  patches.reserved = in.one_in(64) ? 1 : 0;
  const riis_patches *const argument = mostly(in, &patches);
  for (const double q : strip.control) largest = std::isfinite(q) ? std::max(largest, std::abs(q)) : largest;
  put(slot,
      made_by<riis_valve>(in, [&](riis_valve **valve) { return riis_valve_create_from_patches(argument, valve); }),
      std::max(largest, 1e-300));
}

}  // namespace fuzz
