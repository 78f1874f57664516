// SPDX-License-Identifier: Apache-2.0
#include "landmarks/place.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/constants.hpp"
#include "base/errors.hpp"
#include "landmarks/models.hpp"

namespace riis {

double value_of(const Valve &valve, const std::string &name, std::size_t component) {
  double values[3] = {0, 0, 0};
  for (const ParameterSpec &spec : valve.kind().parameters)
    if (spec.name == name) valve.get(name, spec.n_values, values);
  return values[component];
}

namespace {

KindOfLandmarks landmarks_of_kind(const Valve &valve, const Landmarks &landmarks) {
  const std::string_view kind = valve.kind().name;
  if (kind == "trileaflet" || kind == "coapting" || kind == "aortic") return cusp_landmarks(valve, landmarks);
  if (kind == "mitral") return mitral_landmarks(valve, landmarks);
  if (kind == "bileaflet") return bileaflet_landmarks(valve, landmarks);
  fail(RIIS_INVALID_PARAMETER, "a valve of the kind ", kind, " has no landmarks");
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  constexpr std::string_view blanks = " ,\t\n";
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = text.find_first_not_of(blanks, end);
  }
  return words;
}

// Returns, for each parameter of the kind, whether the caller holds it.
std::vector<bool> held_parameters(const Valve &valve, std::string_view held) {
  const auto &specs = valve.kind().parameters;
  std::vector<bool> is_held(specs.size());
  for (const std::string &name : words_of(held)) {
    const auto named = [&](const ParameterSpec &spec) { return spec.name == name; };
    const auto found = std::find_if(specs.begin(), specs.end(), named);
    if (found == specs.end()) {
      double unused[3];
      valve.get(name, 1, unused);  // the message is that of an unknown or ambiguous name
      fail(RIIS_INVALID_PARAMETER, "held names '", name, "', which is not a parameter of the ", valve.kind().name,
           " valve");
    }
    is_held[static_cast<std::size_t>(found - specs.begin())] = true;
  }
  return is_held;
}

bool grows(const ParameterSpec &spec) {
  const std::string_view name = spec.name, length = spec.unit, shift = "translation";
  const bool is_shift = name.size() >= shift.size() && name.substr(name.size() - shift.size()) == shift;
  return length == "length" && !is_shift;
}

// Returns the axis and the angle in degrees, 0 to 180.
std::pair<Vec3, double> axis_and_angle(const Rotation &r) {
  const Vec3 twice{r.row_z.y - r.row_y.z, r.row_x.z - r.row_z.x, r.row_y.x - r.row_x.y};
  const double trace = r.row_x.x + r.row_y.y + r.row_z.z, sine = length(twice);
  const double angle = std::atan2(sine, trace - 1) * (180 / pi);
  if (sine > 1e-6) return {unit(twice), angle};
  if (trace > 1) return {{0, 0, 1}, 0};
  // The angle is half a turn. Then each column of R + 1 that is not 0 has the direction of the axis.
  const Vec3 columns[3] = {{r.row_x.x + 1, r.row_y.x, r.row_z.x},
                           {r.row_x.y, r.row_y.y + 1, r.row_z.y},
                           {r.row_x.z, r.row_y.z, r.row_z.z + 1}};
  Vec3 longest = columns[0];
  for (const Vec3 &column : columns)
    if (length(column) > length(longest)) longest = column;
  const Vec3 axis = unit(longest);
  return {dot(axis, twice) < 0 ? -axis : axis, angle};
}

}  // namespace

PlacedValve place_valve(const Valve &valve, const Landmarks &landmarks, std::string_view held) {
  const std::vector<bool> is_held = held_parameters(valve, held);
  check_unit(landmarks);
  KindOfLandmarks of_kind = landmarks_of_kind(valve, landmarks);
  LandmarkModel &model = *of_kind.model;
  const auto &specs = valve.kind().parameters;
  const auto position = [&](const std::string &name) {
    const auto named = [&](const ParameterSpec &spec) { return spec.name == name; };
    return static_cast<std::size_t>(std::find_if(specs.begin(), specs.end(), named) - specs.begin());
  };
  for (FittedSize &size : model.sizes)
    if (is_held[position(size.name)] || size.held) {
      size.held = true;
      size.value = value_of(valve, size.name);
    }
  const LandmarkFit fitted = fit(model, landmarks, of_kind.starts);
  if (of_kind.check) of_kind.check(model, landmarks);

  PlacedValve placed{valve, landmarks.scale,       {0, 0, 1}, 0,  {0, 0, 0}, fitted.residuals,
                     0,     fitted.rotation_error, 0,         {}, {}};
  // First all lengths grow with the valve. Then the fitted sizes take their values. Last come the parameters that depend on
  // several sizes.
  double size_now = value_of(valve, of_kind.size_name);
  for (const FittedSize &size : model.sizes)
    if (size.name == of_kind.size_name) size_now = size.value;
  const double grown = size_now / value_of(valve, of_kind.size_name);
  // Lengths that follow from others by a rule of the valve grow with these.
  for (const ParameterSpec &spec : specs) {
    if (!grows(spec) || (spec.rule.value && !valve.is_set(spec.name))) continue;
    double values[3] = {0, 0, 0};
    valve.get(spec.name, spec.n_values, values);
    for (double &value : values) value *= grown;
    placed.valve.set(spec.name, spec.n_values, values);
  }
  for (const FittedSize &size : model.sizes) placed.valve.set(size.name, 1, &size.value);
  if (of_kind.finish) of_kind.finish(valve, placed.valve);

  placed.size_state.assign(specs.size(), RIIS_SIZE_KEPT);
  placed.standard_error.assign(specs.size(), 0);
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (is_held[i]) {
      placed.valve.set(specs[i].name, specs[i].n_values, valve.values()[i].data());
    } else if (grows(specs[i]) || valve.values()[i] != placed.valve.values()[i]) {
      placed.size_state[i] = RIIS_SIZE_TIED;
      placed.standard_error[i] = std::numeric_limits<double>::infinity();
    }
  }
  for (const FittedSize &size : model.sizes) {
    const std::size_t i = position(size.name);
    if (size.held) continue;
    placed.size_state[i] = size.determined ? RIIS_SIZE_DETERMINED : RIIS_SIZE_UNDETERMINED;
    placed.standard_error[i] = size.standard_error;
  }
  placed.valve.make_patches();  // refuses sizes that do not fit together

  const double scale = landmarks.scale;
  std::tie(placed.rotation_axis, placed.rotation_angle) = axis_and_angle(fitted.pose.rotation);
  placed.translation = scale * fitted.pose.translation + landmarks.mean;
  for (double &residual : placed.residuals) residual *= scale;
  placed.noise = scale * fitted.noise;
  placed.position_error = scale * fitted.position_error;
  return placed;
}

}  // namespace riis
