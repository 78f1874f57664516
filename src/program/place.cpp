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
  double noise;                        // stated, mesh units
  std::vector<double> places;          // (3, n), of the landmarks on the valve
  riis_surface_options where;          // the placement
  std::optional<riis_warp_info> warp;  // without --warp there is none
  double warp_noise;                   // by which the warp is smoothed; 0: it meets the landmarks
  std::vector<double> still_off;       // distances of the landmarks from their places on the warped valve
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

// Refuses the landmarks with the library's message, if it refused them.
void check_landmarks(riis_status status, const PlaceOptions &options, const LandmarkFile &landmarks) {
  if (status != RIIS_INVALID_ARGUMENT && status != RIIS_INVALID_PARAMETER) return check(status);
  std::string text = in_words_of_file(riis_last_error(), landmarks);
  if (text.rfind("the landmarks give ", 0) == 0)
    text += "; --set gives sizes that landmarks do not tell, in centimetres";
  throw Refusal{exit_bad_data, options.landmarks + ": " + text};
}

riis_points points_of(const std::vector<double> &xyz) {
  riis_points points;
  check(riis_points_init(&points, sizeof points));
  points.n_points = static_cast<int64_t>(xyz.size() / 3);
  points.x = xyz.data();
  points.y = xyz.data() + 1;
  points.z = xyz.data() + 2;
  points.stride = 3;
  return points;
}

// Warps the valve to the landmarks. A warp that folds at one of five openings is refused. Other commands check each opening that
// they take.
void warp_to_landmarks(const PlaceOptions &options, Placed &made) {
  if (options.warp_choice == no_warp) return;
  const LandmarkFile &landmarks = made.landmarks;
  const riis_points places = points_of(made.places), targets = points_of(landmarks.xyz);
  riis_warp_options how;
  check(riis_warp_options_init(&how, sizeof how));
  how.placement = &made.where;
  how.noise = made.warp_noise = options.warp_choice == smoothed_warp ? made.noise : 0;
  riis_warp *handle = nullptr;
  check_landmarks(riis_warp_create(&places, &how, &handle), options, landmarks);
  const Warp warp(handle);
  check_landmarks(riis_warp_set_targets(warp.get(), &targets), options, landmarks);
  check(riis_valve_set_warp(made.valve.get(), warp.get(), nullptr), "--warp");
  riis_warp_info info;
  check(riis_warp_get_info(warp.get(), &info, sizeof info));
  made.warp = info;
  std::vector<double> mapped(made.places.size());
  check(riis_warp_map(warp.get(), &places, mapped.data()));
  for (std::size_t i = 0; i < mapped.size(); i += 3)
    made.still_off.push_back(std::hypot(mapped[i] - landmarks.xyz[i], mapped[i + 1] - landmarks.xyz[i + 1],
                                        mapped[i + 2] - landmarks.xyz[i + 2]));
  const Valve trial = copy_of(made.valve.get());
  for (const double opening : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    check(riis_valve_set_scalar(trial.get(), "opening", opening));
    riis_surface *surface = nullptr;
    const riis_status status = riis_surface_create(trial.get(), &made.where, &surface);
    const Surface owned(surface);
    check_landmarks(status, options, landmarks);
  }
}

Placed place(const PlaceOptions &options) {
  Placed made{read_landmarks(options.landmarks), nullptr, {}, {}, {}, 0, {}, {}, std::nullopt, 0, {}};
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
  made.places.resize(landmarks.xyz.size());
  std::vector<double> errors(n);
  std::vector<int32_t> states(n);
  riis_placement_arrays arrays;
  check(riis_placement_arrays_init(&arrays, sizeof arrays));
  arrays.residual = made.residuals.data();
  arrays.standard_error = errors.data();
  arrays.size_state = states.data();
  arrays.place = made.places.data();
  check_landmarks(riis_place(valve, &given, held.c_str(), &arrays, &made.placement, sizeof made.placement), options,
                  landmarks);
  const riis_placement &at = made.placement;
  check(riis_surface_options_init(&made.where, sizeof made.where));
  made.where.scale = at.scale;
  made.where.half_thickness = 0.1 * at.scale;
  std::copy_n(at.rotation_axis, 3, made.where.rotation_axis);
  made.where.rotation_angle = at.rotation_angle;
  std::copy_n(at.translation, 3, made.where.translation);
  warp_to_landmarks(options, made);
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

Json json_of_points(const std::vector<double> &xyz) {
  Json points = Json::array();
  for (std::size_t i = 0; i < xyz.size(); i += 3) points.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
  return points;
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
  const auto by_name = [&](const std::vector<double> &values) {
    Json made = Json::object();
    for (std::size_t i = 0; i < values.size(); ++i) {
      // A name may occur repeatedly, such as that of annulus points.
      std::string name = placed.landmarks.names[i];
      while (made.contains(name)) name += "'";
      made[name] = values[i];
    }
    return made;
  };
  if (placed.warp) {
    Json warp = Json::object();
    warp["sources"] = json_of_points(placed.places);
    warp["targets"] = json_of_points(placed.landmarks.xyz);
    warp["noise"] = placed.warp_noise;
    root["warp"] = warp;
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
  fit["residuals"] = by_name(placed.residuals);
  if (placed.warp) {
    fit["warped_rms"] = placed.warp->rms_residual;
    fit["warped_worst"] = placed.warp->largest_residual;
    fit["warped_residuals"] = by_name(placed.still_off);
  }
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
  text += "}\nplacement\n{\n    scale           0.01;\n    rotationAxis    (" + numbers_text(at.rotation_axis, 3, " ") +
          ");\n    rotationAngle   " + shortest(at.rotation_angle) + ";\n    translation     (" +
          numbers_text(translation, 3, " ") + ");\n}\n";
  if (!placed.warp) return text;
  const auto points = [&](const std::vector<double> &xyz) {
    std::string list;
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      const double point[3] = {metres * xyz[i], metres * xyz[i + 1], metres * xyz[i + 2]};
      list += "\n        (" + numbers_text(point, 3, " ") + ")";
    }
    return "\n    (" + list + "\n    );\n";
  };
  return text + "warp\n{\n    sources" + points(placed.places) + "    targets" + points(placed.landmarks.xyz) +
         "    noise           " + shortest(metres * placed.warp_noise) + ";\n}\n";
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
  if (placed.warp) {
    const std::string n = std::to_string(placed.places.size() / 3);
    const auto array = [&](const char *name, const std::vector<double> &xyz) {
      std::string made = std::string("const double ") + name + "[][3] = {";
      for (std::size_t i = 0; i < xyz.size(); i += 3)
        made += (i == 0 ? "\n  {" : ",\n  {") + numbers_text(xyz.data() + i, 3, ", ") + "}";
      return made + "};\n";
    };
    text += "/* The warp takes landmarks on the valve to the patient's landmarks. */\n" +
            array("on_valve", placed.places) + array("in_patient", placed.landmarks.xyz) +
            "riis_points sources, targets;\nriis_warp_options warp_options;\nriis_warp *warp = NULL;\n";
    for (const auto &[points, from] : {std::pair("sources", "on_valve"), std::pair("targets", "in_patient")}) {
      const std::string to = points;
      text += "riis_points_init(&" + to + ", sizeof " + to + ");\n" + to + ".n_points = " + n + ";\n" + to +
              ".stride = 3;\n";
      for (int k = 0; k < 3; ++k) text += to + "." + "xyz"[k] + " = &" + from + "[0][" + std::to_string(k) + "];\n";
    }
    text += "riis_warp_options_init(&warp_options, sizeof warp_options);\nwarp_options.noise = " +
            shortest(placed.warp_noise) + ";\nwarp_options.placement = &options;\n" +
            "riis_warp_create(&sources, &warp_options, &warp);\nriis_warp_set_targets(warp, &targets);\n" +
            "riis_valve_set_warp(valve, warp, NULL);\nriis_warp_destroy(&warp);\n";
  }
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
  const std::string where = "scale=" + in_fortran(at.scale) + ", &\n  rotation_axis=[" +
                            numbers_text(at.rotation_axis, 3, ", ", in_fortran) +
                            "], &\n  rotation_angle=" + in_fortran(at.rotation_angle) + ", &\n  translation=[" +
                            numbers_text(at.translation, 3, ", ", in_fortran) + "])\n";
  if (placed.warp) {
    const auto array = [](const std::vector<double> &xyz) {
      std::string made = "reshape([ &\n";
      for (std::size_t i = 0; i < xyz.size(); i += 3)
        made += "  " + numbers_text(xyz.data() + i, 3, ", ", in_fortran) + (i + 3 < xyz.size() ? ", &\n" : "");
      return made + "], [3, " + std::to_string(xyz.size() / 3) + "])";
    };
    text += "! The warp takes landmarks on the valve to the patient's landmarks.\ncall warp%create(" +
            array(placed.places) + ", &\n  noise=" + in_fortran(placed.warp_noise) + ", " + where +
            "call warp%set_targets(" + array(placed.landmarks.xyz) +
            ")\ncall valve%set_warp(warp)\ncall warp%destroy()\n";
  }
  return text + "call surface%create(valve, " + where;
}

std::string filled(const std::string &text, std::size_t width) {
  return text + std::string(std::max(width, text.size()) - text.size(), ' ');
}

// A length, or 0 if it is rounding.
std::string length_text(double length, double centimetre) {
  return length > 1e-9 * centimetre ? digits(length, 3) : "0";
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
  const std::string column = "residual " + unit;
  text += "\n" + filled("landmark", name_width) + (placed.warp ? filled(column, 16) + "warped " + unit : column) + "\n";
  for (std::size_t i = 0; i < landmarks.names.size(); ++i) {
    const std::string residual = digits(placed.residuals[i], 3);
    text += filled(landmarks.names[i], name_width) +
            (placed.warp ? filled(residual, 16) + length_text(placed.still_off[i], at.scale) : residual) + "\n";
  }
  const auto name_of_landmark = [&](int64_t i) { return landmarks.names[static_cast<std::size_t>(i)]; };
  text += "rms " + digits(at.rms, 3) + ", worst " + digits(at.worst, 3) + " at " +
          name_of_landmark(at.worst_landmark_id) + "\n";
  if (placed.warp)
    text += "warped, rms " + length_text(placed.warp->rms_residual, at.scale) + ", worst " +
            length_text(placed.warp->largest_residual, at.scale) + " at " +
            name_of_landmark(placed.warp->largest_landmark_id) +
            (placed.warp_noise > 0 ? "; smoothed by the noise of " + digits(placed.warp_noise, 3) + " " + unit : "") +
            "\n";
  else if (kind != "bileaflet" && at.worst > 3 * std::max(placed.noise, 1e-6 * at.scale))
    text += "The valve misses the landmarks. --warp exact takes it to them, --warp smoothed as near as their noise.\n";
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
  shape.surface_options = placed.where;
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
