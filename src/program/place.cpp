// SPDX-License-Identifier: Apache-2.0
#include "program/place.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "program/crossings.hpp"
#include "program/handles.hpp"
#include "program/landmark_file.hpp"
#include "program/mesh_reading.hpp"
#include "program/outputs.hpp"
#include "program/parameters.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"
#include "program/text.hpp"
#include "program/valve_file.hpp"
#include "program/valve_source.hpp"

namespace riis::program {
namespace {

struct Size {
  riis_parameter parameter;
  std::vector<double> values;
  double standard_error;
  int32_t state;
};

struct Placed {
  LandmarkFile landmarks;
  Valve valve;
  std::vector<Size> sizes;
  riis_placement placement;
  std::vector<double> residuals;
  double noise;  // stated, mesh units
};

std::string digits(double number, int n = 4) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", n, number);
  return text;
}

std::string joined_by(const std::vector<std::string> &parts, const char *between) {
  std::string text;
  for (const std::string &part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

std::string numbers_text(const double *numbers, std::size_t n, const char *between,
                         std::string (*as_text)(double) = shortest) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < n; ++i) parts.push_back(as_text(numbers[i]));
  return joined_by(parts, between);
}

// ---- The fit ----

std::size_t n_parameters(const riis_valve *valve) {
  int64_t n = 0;
  check(riis_valve_get_n_parameters(valve, &n));
  return static_cast<std::size_t>(n);
}

riis_parameter parameter_of(const riis_valve *valve, std::size_t i) {
  riis_parameter parameter{};
  check(riis_valve_get_parameter(valve, static_cast<int64_t>(i), &parameter, sizeof parameter));
  return parameter;
}

std::vector<double> all_values(const riis_valve *valve, const riis_parameter &parameter) {
  std::vector<double> values(static_cast<std::size_t>(parameter.n_values));
  check(riis_valve_get(valve, parameter.name, parameter.n_values, values.data()));
  return values;
}

// Returns the names of the parameters that the user set: by the landmarks' file or by --set. They keep these values.
std::string held_names(const std::vector<std::string> &settings, const LandmarkFile &landmarks,
                       const riis_valve *valve) {
  std::vector<std::string> set, held;
  for (const std::string &setting : settings) set.push_back(setting.substr(0, setting.find('=')));
  if (landmarks.parameters.is_object())
    for (const auto &[name, value] : landmarks.parameters.items()) {
      if (!value.is_object()) set.push_back(name);
      if (value.is_object())
        for (const auto &inner : value.items()) set.push_back(name + "." + inner.key());
    }
  for (std::size_t i = 0; i < n_parameters(valve); ++i) {
    const std::string name = parameter_of(valve, i).name;
    for (const std::string &given : set)
      if (name == given || (name.size() > given.size() && name.substr(name.size() - given.size() - 1) == "." + given)) {
        held.push_back(name);
        break;
      }
  }
  return joined_by(held, " ");
}

// Returns the library's message with the names of the file for landmarks, and the words of the file for fields.
std::string in_words_of_file(std::string text, const LandmarkFile &landmarks) {
  for (std::size_t i = 0; i < landmarks.names.size(); ++i) {
    const std::string number = "landmark " + std::to_string(i);
    for (std::size_t at = 0; (at = text.find(number, at)) != std::string::npos;) {
      std::size_t end = at + number.size();
      if (end < text.size() && text[end] >= '0' && text[end] <= '9') {
        ++at;
        continue;
      }
      if (text.compare(end, 2, " (") == 0) end = std::min(text.find(')', end) + 1, text.size());
      const std::string name = quoted(landmarks.names[i]);
      text.replace(at, end - at, name);
      at += name.size();
    }
  }
  const std::pair<std::string, std::string> fields[] = {
      {"landmarks.scale is " + shortest(factor_between(Unit::centimetre, landmarks.unit)) + " (" +
           words_of(landmarks.unit) + ")",
       std::string("the unit is ") + words_of(landmarks.unit)},
      {"landmarks.leaflet_id of ", "the name of "},
      {"landmarks.leaflet_id", "the names"},
      {"landmarks.flow", "flow"},
      {"landmarks.role has the ", "it has the "}};
  for (const auto &[field, words] : fields)
    if (text.rfind(field, 0) == 0) {
      text.replace(0, field.size(), words);
      break;
    }
  return text;
}

Placed place(const PlaceOptions &options) {
  Placed made{read_landmarks(options.landmarks), nullptr, {}, {}, {}, 0};
  LandmarkFile &landmarks = made.landmarks;
  if (options.unit) landmarks.convert(*options.unit);
  if (!options.axes.empty()) {
    const Axes axes = options.axes == "LPS" ? Axes::LPS : Axes::RAS;
    if (landmarks.axes == Axes::mesh)
      refuse_usage("--axes: " + options.landmarks + " states the axes mesh, so it is not known how to turn it");
    landmarks.convert(axes);
  }
  if (options.noise) landmarks.noise = *options.noise;
  if (options.flow) landmarks.flow = {(*options.flow)[0], (*options.flow)[1], (*options.flow)[2]};
  if (options.has_valve && !landmarks.valve.empty() && options.valve != landmarks.valve)
    refuse_usage("--valve: " + options.valve + " is not the valve of " + options.landmarks + ", which is " +
                 landmarks.valve);
  if (!options.has_valve && landmarks.valve.empty())
    refuse_usage("--valve is needed, because " + options.landmarks + " does not name the kind of valve");
  const std::string kind = options.has_valve ? options.valve : landmarks.valve;
  made.valve = make_kind(kind, options.has_valve ? "--valve" : options.landmarks);
  riis_valve *valve = made.valve.get();
  if (!options.params.empty()) set_from_json_file(valve, options.params);
  if (!landmarks.parameters.is_null()) set_from_json(valve, landmarks.parameters, options.landmarks + ": parameters");
  for (const std::string &setting : options.settings) set_from_text(valve, setting);
  const std::string held = held_names(options.settings, landmarks, valve);

  riis_landmarks given;
  check(riis_landmarks_init(&given, sizeof given));
  given.n_landmarks = static_cast<int64_t>(landmarks.names.size());
  given.x = landmarks.xyz.data();
  given.y = landmarks.xyz.data() + 1;
  given.z = landmarks.xyz.data() + 2;
  given.stride = 3;
  given.role = landmarks.roles.data();
  given.leaflet_id = landmarks.leaflet_ids.data();
  given.scale = factor_between(Unit::centimetre, landmarks.unit);
  if (landmarks.noise) given.noise = *landmarks.noise;
  if (landmarks.flow) std::copy(landmarks.flow->begin(), landmarks.flow->end(), given.flow);
  made.noise = landmarks.noise.value_or(0.03 * given.scale);
  const std::size_t n = n_parameters(valve);
  made.residuals.resize(landmarks.names.size());
  std::vector<double> errors(n);
  std::vector<int32_t> states(n);
  riis_placement_arrays arrays;
  check(riis_placement_arrays_init(&arrays, sizeof arrays));
  arrays.residual = made.residuals.data();
  arrays.standard_error = errors.data();
  arrays.size_state = states.data();
  const riis_status status = riis_place(valve, &given, held.c_str(), &arrays, &made.placement, sizeof made.placement);
  if (status == RIIS_INVALID_ARGUMENT || status == RIIS_INVALID_PARAMETER)
    throw Refusal{exit_bad_data, options.landmarks + ": " + in_words_of_file(riis_last_error(), landmarks)};
  check(status);
  for (std::size_t i = 0; i < n; ++i) {
    const riis_parameter parameter = parameter_of(valve, i);
    made.sizes.push_back({parameter, all_values(valve, parameter), errors[i], states[i]});
  }
  return made;
}

// ---- The mesh ----

// Returns the mean distance of the landmarks from their nearest nodes, after x and y are perhaps reversed and lengths multiplied.
double distance_from_nodes(const LandmarkFile &landmarks, int64_t n_nodes, const double *nodes, double sign,
                           double factor) {
  double sum = 0;
  const std::size_t n = landmarks.names.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double *at = landmarks.xyz.data() + 3 * i;
    const double p[3] = {sign * factor * at[0], sign * factor * at[1], factor * at[2]};
    double least = HUGE_VAL;
    for (int64_t node = 0; node < n_nodes; ++node) {
      const double *q = nodes + 3 * node;
      const double x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2];
      least = std::min(least, x * x + y * y + z * z);
    }
    sum += std::sqrt(least) / static_cast<double>(n);
  }
  return sum;
}

// Refuses landmarks that are not at the mesh. If other axes or another unit would bring them to the mesh, the message says so.
void check_mesh(const PlaceOptions &options, const Placed &placed) {
  if (options.mesh.empty()) return;
  const LandmarkFile &landmarks = placed.landmarks;
  const MeshFile mesh = [&] {
    const Stage stage("reading " + options.mesh, options.quiet);
    return read_mesh_file(options.mesh);
  }();
  int64_t n_nodes = 0;
  const double *nodes = nullptr;
  check(riis_vtk_mesh_get_nodes(mesh.get(), &n_nodes, nullptr, &nodes));
  // Landmarks lie on the wall, so nodes of the mesh must be near. Landmarks a centimetre away belong to another place.
  const double near = factor_between(Unit::centimetre, landmarks.unit);
  const double apart = distance_from_nodes(landmarks, n_nodes, nodes, 1, 1);
  if (apart <= near) return;
  std::string text = options.landmarks + ": the landmarks are " + digits(apart, 3) + " " + name_of(landmarks.unit) +
                     " from the nodes of " + options.mesh + " on average";
  for (const Unit unit : {landmarks.unit, Unit::metre, Unit::centimetre, Unit::millimetre})
    for (const double sign : {1.0, -1.0}) {
      const double factor = factor_between(landmarks.unit, unit);
      const double other = distance_from_nodes(landmarks, n_nodes, nodes, sign, factor);
      if (other > factor * near) continue;
      std::vector<std::string> changes;
      if (unit != landmarks.unit) changes.push_back(std::string("in ") + words_of(unit));
      if (sign < 0) changes.emplace_back("with x and y reversed, as between LPS and RAS");
      text +=
          "; " + joined_by(changes, " and ") + ", they are " + digits(other, 3) + " " + name_of(unit) + " from them: ";
      if (unit != landmarks.unit) text += std::string("give --unit ") + name_of(unit) + (sign < 0 ? " and " : "");
      if (sign < 0) {
        const Axes is = landmarks.axes;
        text += is == Axes::mesh
                    ? "state the axes of the file"
                    : std::string("give --axes ") + (is == Axes::LPS ? "RAS" : "LPS") + ", the mesh's axes";
      }
      throw Refusal{exit_bad_data, text};
    }
  throw Refusal{exit_bad_data, text + ", which is more than 1 cm, in any unit and with the axes LPS and RAS"};
}

// ---- Outputs ----

bool is_changed(const Size &size) {
  return std::string(size.parameter.name) != "opening" &&
         !std::equal(size.values.begin(), size.values.end(), size.parameter.default_values);
}

std::string json_of(const PlaceOptions &, const std::string &kind, const Placed &placed) {
  const riis_placement &at = placed.placement;
  Json root = Json::object();
  root["valve"] = kind;
  root["unit"] = name_of(placed.landmarks.unit);
  root["axes"] = name_of(placed.landmarks.axes);
  root["rotate"] = {at.rotation_axis[0], at.rotation_axis[1], at.rotation_axis[2], at.rotation_angle};
  root["translate"] = {at.translation[0], at.translation[1], at.translation[2]};
  Json parameters = Json::parse(json_template(placed.valve.get()));
  parameters.erase("opening");
  root["parameters"] = parameters;
  Json residuals = Json::object();
  for (std::size_t i = 0; i < placed.residuals.size(); ++i) {
    // A name may occur repeatedly, such as that of annulus points.
    std::string name = placed.landmarks.names[i];
    while (residuals.contains(name)) name += "'";
    residuals[name] = placed.residuals[i];
  }
  Json fit = Json::object();
  fit["rms"] = at.rms;
  fit["worst"] = at.worst;
  fit["noise"] = at.noise;
  fit["rotation_error"] = at.rotation_error;
  fit["position_error"] = at.position_error;
  Json errors = Json::object(), undetermined = Json::array(), tied = Json::array();
  for (const Size &size : placed.sizes) {
    if (size.state == RIIS_SIZE_DETERMINED || size.state == RIIS_SIZE_UNDETERMINED)
      errors[size.parameter.name] = size.standard_error;
    if (size.state == RIIS_SIZE_UNDETERMINED) undetermined.push_back(size.parameter.name);
    if (size.state == RIIS_SIZE_TIED) tied.push_back(size.parameter.name);
  }
  fit["standard_errors"] = errors;
  fit["undetermined"] = undetermined;
  fit["in_proportion"] = tied;
  fit["residuals"] = residuals;
  root["fit"] = fit;
  return root.dump(2) + "\n";
}

// OpenFOAM's lengths are metres.
std::string foam_of(const std::string &kind, const Placed &placed) {
  const riis_placement &at = placed.placement;
  const double metres = factor_between(placed.landmarks.unit, Unit::metre);
  double translation[3];
  for (int k = 0; k < 3; ++k) translation[k] = metres * at.translation[k];
  std::string text = "valve\n{\n    kind            " + kind + ";\n";
  for (const Size &size : placed.sizes) {
    if (!is_changed(size)) continue;
    const std::string values = numbers_text(size.values.data(), size.values.size(), " ");
    text += "    " + std::string(size.parameter.name) + " " + (size.values.size() == 1 ? values : "(" + values + ")") +
            ";\n";
  }
  return text + "}\nplacement\n{\n    scale           0.01;\n    rotationAxis    (" +
         numbers_text(at.rotation_axis, 3, " ") + ");\n    rotationAngle   " + shortest(at.rotation_angle) +
         ";\n    translation     (" + numbers_text(translation, 3, " ") + ");\n}\n";
}

std::string c_of(const std::string &kind, const Placed &placed) {
  const riis_placement &at = placed.placement;
  std::string text = "riis_valve *valve = NULL;\nriis_surface *surface = NULL;\nriis_surface_options options;\n";
  text += "riis_valve_create(\"" + kind + "\", &valve);\n";
  for (const Size &size : placed.sizes) {
    if (!is_changed(size)) continue;
    const std::string values = numbers_text(size.values.data(), size.values.size(), ", ");
    text += size.values.size() == 1
                ? "riis_valve_set_scalar(valve, \"" + std::string(size.parameter.name) + "\", " + values + ");\n"
                : "riis_valve_set(valve, \"" + std::string(size.parameter.name) + "\", " +
                      std::to_string(size.values.size()) + ", (const double[]){" + values + "});\n";
  }
  text += "riis_surface_options_init(&options, sizeof options);\noptions.scale = " + shortest(at.scale) + ";\n";
  for (int k = 0; k < 3; ++k)
    text += "options.rotation_axis[" + std::to_string(k) + "] = " + shortest(at.rotation_axis[k]) + ";\n";
  text += "options.rotation_angle = " + shortest(at.rotation_angle) + ";\n";
  for (int k = 0; k < 3; ++k)
    text += "options.translation[" + std::to_string(k) + "] = " + shortest(at.translation[k]) + ";\n";
  return text + "riis_surface_create(valve, &options, &surface);\n";
}

// A double as Fortran writes it: 1.5d0.
std::string in_fortran(double number) {
  std::string text = shortest(number);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text + "d0";
  text[e] = 'd';
  return text;
}

std::string fortran_of(const std::string &kind, const Placed &placed) {
  const riis_placement &at = placed.placement;
  std::string text = "call valve%create('" + kind + "')\n";
  for (const Size &size : placed.sizes) {
    if (!is_changed(size)) continue;
    const std::string values = numbers_text(size.values.data(), size.values.size(), ", ", in_fortran);
    text += "call valve%set('" + std::string(size.parameter.name) + "', " +
            (size.values.size() == 1 ? values : "[" + values + "]") + ")\n";
  }
  return text + "call surface%create(valve, scale=" + in_fortran(at.scale) + ", &\n  rotation_axis=[" +
         numbers_text(at.rotation_axis, 3, ", ", in_fortran) +
         "], &\n  rotation_angle=" + in_fortran(at.rotation_angle) + ", &\n  translation=[" +
         numbers_text(at.translation, 3, ", ", in_fortran) + "])\n";
}

std::string filled(const std::string &text, std::size_t width) {
  return text + std::string(std::max(width, text.size()) - text.size(), ' ');
}

std::string place_report(const std::string &kind, const PlaceOptions &options, const Placed &placed) {
  const LandmarkFile &landmarks = placed.landmarks;
  const riis_placement &at = placed.placement;
  const std::string unit = name_of(landmarks.unit);
  std::string text = kind + " valve from " + std::to_string(landmarks.names.size()) + " landmarks of " +
                     options.landmarks + ", axes " + name_of(landmarks.axes) + ", noise " + digits(placed.noise, 3) +
                     " " + unit + "\n\n";
  std::size_t width = 16;
  for (const Size &size : placed.sizes) width = std::max(width, std::string(size.parameter.name).size() + 2);
  text += filled("parameter", width) + filled("value", 26) + filled("std. error", 12) + "from\n";
  std::vector<std::string> undetermined;
  for (const Size &size : placed.sizes) {
    if (size.state == RIIS_SIZE_KEPT) continue;
    const bool is_fitted = size.state != RIIS_SIZE_TIED;
    const std::string of = std::string(size.parameter.unit) == "length"   ? " cm"
                           : std::string(size.parameter.unit) == "degree" ? " degrees"
                                                                          : "";
    const std::string values =
        numbers_text(size.values.data(), size.values.size(), " ", [](double number) { return digits(number); });
    text += filled(size.parameter.name, width) + filled(values + of, 26) +
            filled(is_fitted ? digits(size.standard_error, 2) : "-", 12) +
            (size.state == RIIS_SIZE_DETERMINED     ? "landmarks"
             : size.state == RIIS_SIZE_UNDETERMINED ? "landmarks and proportion: NOT DETERMINED"
                                                    : "proportion") +
            "\n";
    if (size.state == RIIS_SIZE_UNDETERMINED) undetermined.emplace_back(size.parameter.name);
  }
  const auto four_digits = [](double number) { return digits(number); };
  text += "\nplacement       scale " + shortest(at.scale) + ", rotation by " + digits(at.rotation_angle) +
          " degrees about " + numbers_text(at.rotation_axis, 3, " ", four_digits) + ", translation " +
          numbers_text(at.translation, 3, " ", four_digits) + " " + unit + "\nstd. errors     " +
          digits(at.rotation_error, 2) + " degrees, " + digits(at.position_error, 2) + " " + unit + ", by a noise of " +
          digits(at.noise, 2) + " " + unit + "\n";
  std::size_t name_width = 16;
  for (const std::string &name : landmarks.names) name_width = std::max(name_width, name.size() + 2);
  text += "\n" + filled("landmark", name_width) + "residual " + unit + "\n";
  for (std::size_t i = 0; i < landmarks.names.size(); ++i)
    text += filled(landmarks.names[i], name_width) + digits(placed.residuals[i], 3) + "\n";
  text += "rms " + digits(at.rms, 3) + ", worst " + digits(at.worst, 3) + " at " +
          landmarks.names[static_cast<std::size_t>(at.worst_landmark_id)] + "\n";
  text += undetermined.empty() ? "\nThe landmarks determine every size that they bear on.\n"
                               : "\nThe landmarks do not determine " + joined_by(undetermined, ", ") + ".\n";
  return text;
}

}  // namespace

void run_place(const PlaceOptions &options) {
  const OutputLocks locks = check_outputs(options);
  const Placed placed = place(options);
  const std::string kind = options.has_valve ? options.valve : placed.landmarks.valve;
  check_mesh(options, placed);
  ValveOptions shape = options;
  shape.valve = kind;
  const riis_placement &at = placed.placement;
  shape.surface_options.scale = at.scale;
  std::copy_n(at.rotation_axis, 3, shape.surface_options.rotation_axis);
  shape.surface_options.rotation_angle = at.rotation_angle;
  std::copy_n(at.translation, 3, shape.surface_options.translation);
  shape.unit = placed.landmarks.unit;
  check_shape(shape, placed.valve.get(), false);
  const std::pair<std::string, std::string> outputs[] = {{options.output, json_of(options, kind, placed)},
                                                         {options.foam_output, foam_of(kind, placed)},
                                                         {options.c_output, c_of(kind, placed)},
                                                         {options.fortran_output, fortran_of(kind, placed)}};
  bool uses_stdout = false;
  for (const auto &[path, text] : outputs) {
    if (path.empty()) continue;
    write_text(path, text);
    uses_stdout = uses_stdout || path == "-";
  }
  if (!options.quiet && !uses_stdout) write_text("-", take_notes() + place_report(kind, options, placed));
}

}  // namespace riis::program
