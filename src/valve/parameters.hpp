// SPDX-License-Identifier: Apache-2.0
// Named parameters of a parametric valve: what they are called, what they may be, what they are.
// In: names and values as users write them. Out: checked values by position.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace riis {

struct ParameterSpec {
  std::string name;  // "root_radius", or "right.leaflet_angle" for a parameter of one leaflet
  const char *unit;
  const char *description;
  int n_values;  // 1 or 3
  std::array<double, 3> default_values;
  double minimum, maximum;
};

using ParameterValues = std::vector<std::array<double, 3>>;  // one entry a spec

struct PatchSet;

// What a kind of valve is: its parameters and the way from their values to patches.
struct ValveKind {
  const char *name;
  std::vector<ParameterSpec> parameters;
  PatchSet (*make_patches)(const ParameterValues &values);  // refuses values that do not go together
};

// The kind of that name; fails with RIIS_INVALID_PARAMETER naming the kinds there are.
const ValveKind &find_valve_kind(std::string_view name);

// A valve: a kind and its values. All functions fail with RIIS_INVALID_PARAMETER, naming the parameter and the value,
// and then leave the values as they were.
class Valve {
 public:
  explicit Valve(const ValveKind &kind);
  const ValveKind &kind() const { return *kind_; }
  const ParameterValues &values() const { return values_; }

  // A name without a leaflet sets the parameter of every leaflet that has one of that name.
  void set(std::string_view name, std::int64_t n_values, const double *new_values);
  void get(std::string_view name, std::int64_t n_values, double *out) const;

 private:
  const ValveKind *kind_;
  ParameterValues values_;
};

}  // namespace riis
