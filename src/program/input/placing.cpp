// SPDX-License-Identifier: Apache-2.0
#include "program/input/placing.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <utility>

#include "common/elementary.hpp"
#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/parameters.hpp"

namespace riis::program {
namespace {

std::string digits(double number, int n = 4) { return printed(("%." + std::to_string(n) + "g").c_str(), number); }

std::string option_name(Reader reader, const char *name) {
  return (reader == Reader::program ? "--" : "") + std::string(name);
}

std::string option_text(Reader reader, const char *name, const std::string &value) {
  return reader == Reader::program ? "--" + (name + (" " + value)) : name + ("='" + value + "'");
}

// Returns the names of the parameters whose values the options or the landmarks' file give. The library refuses a name that is
// not a parameter.
std::string held_names(std::vector<std::string> given, const LandmarkFile &landmarks, const riis_valve *valve) {
  if (landmarks.parameters.is_object())
    for (const auto &[name, value] : landmarks.parameters.items()) {
      if (!value.is_object()) given.push_back(name);
      if (value.is_object())
        for (const auto &inner : value.items()) given.push_back(name + "." + inner.key());
    }
  std::vector<std::string> held;
  for (const std::string &name : given) {
    const std::size_t n_before = held.size();
    for (const riis_parameter &parameter : all_parameters(valve)) {
      const std::string full = parameter.name;
      const bool is_part = full.size() > name.size() && full.substr(full.size() - name.size() - 1) == "." + name;
      if (full == name || is_part) held.push_back(full);
    }
    if (held.size() == n_before) held.push_back(name);
  }
  return joined_by(held, " ");
}

// Returns the library's message, in which landmarks and fields get the names that they have in the file.
std::string in_words_of_file(std::string text, const LandmarkFile &landmarks) {
  static const std::regex numbered("landmark ([0-9]+)( \\([^)]*\\))?");
  std::string named;
  for (std::smatch match; std::regex_search(text, match, numbered); text = match.suffix()) {
    const std::size_t i = std::stoul(match[1]);
    named += match.prefix().str() + (i < landmarks.names.size() ? quoted(landmarks.names[i]) : match.str());
  }
  text = named + text;
  const std::pair<std::string, std::string> fields[] = {
      {"landmarks.scale is " + shortest(factor_between(Unit::centimetre, landmarks.unit)) + " (" +
           words_of(landmarks.unit) + ")",
       std::string("the unit is ") + words_of(landmarks.unit)},
      {"landmarks.leaflet_id of ", "the name of "},
      {"landmarks.leaflet_id", "the names"},
      {"landmarks.role has the ", "it has the "},
      {"landmarks.", ""}};
  for (const auto &[field, words] : fields)
    if (text.rfind(field, 0) == 0) {
      text.replace(0, field.size(), words);
      break;
    }
  return text;
}

// Throws a Refusal if the library has refused the landmarks. The Refusal has the library's message.
void check_landmarks(riis_status status, const LandmarkFile &landmarks, Reader reader) {
  if (status == RIIS_OK) return;
  if (status != RIIS_INVALID_ARGUMENT && status != RIIS_INVALID_PARAMETER) return check(status);
  std::string text = in_words_of_file(riis_last_error(), landmarks);
  if (reader == Reader::program && text.rfind("the landmarks give ", 0) == 0)
    text += "; --set sets sizes that do not follow from landmarks, in centimetres";
  if (text.rfind("flow is 0 0 0", 0) == 0)
    text += reader == Reader::program ? ": state it by --flow X,Y,Z" : ": state it by flow=(x, y, z)";
  throw Refusal{exit_bad_data, landmarks.path + ": " + text, status};
}

// The error of measured distances from the valve, in centimetres.
constexpr double distance_error = 1e-4;

// Returns the distances of points from the closed valve. The valve's skirt is left out. If `closest` is given, it gets the
// valve's closest points, (3, n).
std::vector<double> distances_from(const riis_valve *valve, riis_surface_options where, const std::vector<double> &xyz,
                                   std::vector<double> *closest = nullptr) {
  const auto closed = create<Valve>(riis_valve_copy, valve);
  check(riis_valve_set_scalar(closed, "opening", 0));
  check(riis_valve_set_scalar(closed, "skirt_length", 0));
  where.tolerance = distance_error * where.scale / where.half_thickness;
  return distances_to(create<Surface>(riis_surface_create, closed, &where), xyz, closest);
}

// Returns the places on the valve that an exact warp takes to the landmarks. A commissure of the paper's valve lies between the
// ends of two cusps. Only a warp that starts at one of these ends takes the valve to the landmark.
std::vector<double> places_on_valve(const Placed &placed, const riis_valve *valve) {
  if (placed.kind != "aortic") return placed.places;
  std::vector<double> closest;
  const std::vector<double> distances = distances_from(valve, placed.where, placed.places, &closest);
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (distances[i] <= 2 * distance_error * placed.where.scale)
      std::copy_n(placed.places.data() + 3 * i, 3, closest.data() + 3 * i);  // exact, unlike a point on a triangle
  return closest;
}

// Finds the pairs of landmarks for the warp. Refuses two landmarks if no warp can take both of them to their places.
void pair_landmarks(Placed &placed, const riis_valve *valve, bool is_exact) {
  const LandmarkFile &landmarks = placed.landmarks;
  const auto apart = [](const std::vector<double> &xyz, std::size_t i, std::size_t k) {
    return hypotenuse(xyz[3 * i] - xyz[3 * k], xyz[3 * i + 1] - xyz[3 * k + 1], xyz[3 * i + 2] - xyz[3 * k + 2]);
  };
  const std::vector<double> places = is_exact ? places_on_valve(placed, valve) : placed.places;
  const double same_place = distance_error * placed.placement.scale;
  placed.sources.clear(), placed.targets.clear(), placed.paired_names.clear();
  for (std::size_t i = 0; i < landmarks.names.size(); ++i) {
    bool is_repeated = false;
    for (std::size_t k = 0; k < i; ++k) {
      const double on_valve = apart(places, i, k), in_patient = apart(landmarks.xyz, i, k);
      const bool is_one_source = on_valve <= 1e-6 * placed.placement.scale, is_one_target = in_patient <= same_place;
      is_repeated = is_repeated || (is_one_source && is_one_target);
      if (is_one_source == is_one_target || (!is_one_source && !is_exact)) continue;
      const std::string unit = std::string(" ") + name_of(landmarks.unit);
      const auto words = [&](bool is_one, double distance) {
        return is_one ? "in one place" : digits(distance, 3) + unit + " apart";
      };
      refuse_data(landmarks.path + ": " + quoted(landmarks.names[k]) + " and " + quoted(landmarks.names[i]) + " are " +
                  words(is_one_target, in_patient) + ", but on the valve they are " + words(is_one_source, on_valve) +
                  ", so no warp takes the valve to both landmarks: leave one of them out");
    }
    if (is_repeated) continue;
    const auto at = static_cast<std::ptrdiff_t>(3 * i);
    placed.sources.insert(placed.sources.end(), places.begin() + at, places.begin() + at + 3);
    placed.targets.insert(placed.targets.end(), landmarks.xyz.begin() + at, landmarks.xyz.begin() + at + 3);
    placed.paired_names.push_back(landmarks.names[i]);
  }
}

// Warps the valve to the landmarks. Refuses a warp if the valve folds at one of five openings.
Warp unfolded_warp(const Placed &placed, riis_valve *valve, double noise, Reader reader) {
  LandmarkFile landmarks = placed.landmarks;
  landmarks.names = placed.paired_names;
  const riis_points from = points_of(placed.sources), to = points_of(placed.targets);
  auto how = defaults<riis_warp_options>();
  how.placement = &placed.where;
  how.noise = noise;
  Warp warp;
  check_landmarks(riis_warp_create(&from, &how, warp.out()), landmarks, reader);
  check_landmarks(riis_warp_set_targets(warp, &to), landmarks, reader);
  check(riis_valve_set_warp(valve, warp, nullptr), option_name(reader, "warp"));
  const auto trial = create<Valve>(riis_valve_copy, valve);
  for (const double opening : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    check(riis_valve_set_scalar(trial, "opening", opening));
    Surface surface;
    check_landmarks(riis_surface_create(trial, &placed.where, surface.out()), landmarks, reader);
  }
  return warp;
}

// Returns advice for a warp that meets the landmarks but folds the valve. To give the advice, tries a warp that is smoothed by
// the landmarks' noise.
std::string cure_of_folds(const Placed &placed, const riis_valve *valve, Reader reader) {
  const std::string smoothed = option_text(reader, "warp", "smoothed"), look = "look for a misplaced landmark";
  if (!(placed.noise > 0))
    return "; the noise of the landmarks is 0: if the file states a larger noise, " + smoothed + " bends less";
  try {
    unfolded_warp(placed, create<Valve>(riis_valve_copy, valve), placed.noise, reader);
  } catch (const Refusal &) {
    return "; " + smoothed + " folds too: " + look;
  }
  return "; " + smoothed + " does not fold, and passes the landmarks within about their noise, but first " + look;
}

}  // namespace

void adapt(LandmarkFile &landmarks, const PlaceRequest &request) {
  const std::string axes = option_name(request.reader, "axes");
  if (request.unit) landmarks.convert(*request.unit);
  if (!request.axes.empty()) {
    if (request.axes != "LPS" && request.axes != "RAS")
      refuse_usage(axes + " is " + quoted(request.axes) + "; it must be LPS or RAS");
    if (landmarks.axes == Axes::mesh)
      refuse_usage(axes + ": " + landmarks.path + " states the axes mesh, so it cannot be turned into other axes");
    landmarks.convert(request.axes == "LPS" ? Axes::LPS : Axes::RAS);
  }
  if (request.noise) landmarks.noise = *request.noise;
  if (request.flow) landmarks.flow = {(*request.flow)[0], (*request.flow)[1], (*request.flow)[2]};
}

std::string kind_of(const LandmarkFile &landmarks, const std::string &given, Reader reader) {
  const std::string option = option_name(reader, "valve");
  if (given.empty() && landmarks.valve.empty())
    refuse_usage(option + " is needed, because " + landmarks.path + " does not name the kind of valve");
  if (!given.empty() && !landmarks.valve.empty() && given != landmarks.valve)
    refuse_usage(option + ": " + given + " is not the valve of " + landmarks.path + ", which is " + landmarks.valve);
  return given.empty() ? landmarks.valve : given;
}

namespace {

// Removes the landmarks of a role, and returns their number.
std::size_t leave_out(LandmarkFile &landmarks, std::int32_t role) {
  LandmarkFile kept = landmarks;
  kept.names.clear(), kept.xyz.clear(), kept.roles.clear(), kept.leaflet_ids.clear();
  for (std::size_t i = 0; i < landmarks.names.size(); ++i) {
    if (landmarks.roles[i] == role) continue;
    const auto at = landmarks.xyz.begin() + static_cast<std::ptrdiff_t>(3 * i);
    kept.names.push_back(landmarks.names[i]);
    kept.xyz.insert(kept.xyz.end(), at, at + 3);
    kept.roles.push_back(landmarks.roles[i]);
    const auto ids = landmarks.leaflet_ids.begin() + static_cast<std::ptrdiff_t>(2 * i);
    kept.leaflet_ids.insert(kept.leaflet_ids.end(), ids, ids + 2);
  }
  std::swap(landmarks, kept);
  return kept.names.size() - landmarks.names.size();
}

}  // namespace

Placed place_by_landmarks(const LandmarkFile &of_file, riis_valve *valve, const std::string &kind,
                          const std::vector<std::string> &held, Reader reader) {
  Placed made;
  made.landmarks = of_file;
  // Landmarks of a mitral valve serve both mitral kinds.
  if (kind == "mitral_coapting") made.n_trigones_left_out = leave_out(made.landmarks, RIIS_LANDMARK_TRIGONE);
  const LandmarkFile &landmarks = made.landmarks;
  made.kind = kind;
  auto given = defaults<riis_landmarks>();
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
  const std::size_t n = all_parameters(valve).size();
  made.residuals.resize(landmarks.names.size());
  made.places.resize(landmarks.xyz.size());
  std::vector<double> errors(n);
  std::vector<int32_t> states(n);
  auto arrays = defaults<riis_placement_arrays>();
  arrays.residual = made.residuals.data();
  arrays.standard_error = errors.data();
  arrays.size_state = states.data();
  arrays.place = made.places.data();
  check_landmarks(riis_place(valve, &given, held_names(held, landmarks, valve).c_str(), &arrays, &made.placement,
                             sizeof made.placement),
                  landmarks, reader);
  const riis_placement &at = made.placement;
  made.where.scale = at.scale;
  made.where.half_thickness = 0.1 * at.scale;
  std::copy_n(at.rotation_axis, 3, made.where.rotation_axis);
  made.where.rotation_angle = at.rotation_angle;
  std::copy_n(at.translation, 3, made.where.translation);
  const std::vector<riis_parameter> parameters = all_parameters(valve);
  for (const riis_parameter &parameter : parameters) {
    const std::size_t i = made.sizes.size();
    int32_t is_set = 0;
    check(riis_valve_is_set(valve, parameter.name, &is_set));
    const auto is_its_rule = [&](const riis_parameter &other) { return std::string(parameter.rule) == other.name; };
    const bool follows = is_set == 0 && std::any_of(parameters.begin(), parameters.end(), is_its_rule);
    made.sizes.push_back({parameter, values_of(valve, parameter), errors[i], states[i], follows});
  }
  return made;
}

Warp warp_to_landmarks(Placed &placed, riis_valve *valve, double noise, Reader reader) {
  pair_landmarks(placed, valve, noise == 0);
  Warp warp = [&] {
    try {
      return unfolded_warp(placed, valve, noise, reader);
    } catch (const Refusal &refusal) {
      if (noise > 0 || refusal.status != RIIS_INVALID_PARAMETER) throw;
      throw Refusal{refusal.exit_code, refusal.text + cure_of_folds(placed, valve, reader), refusal.status};
    }
  }();
  placed.is_warped = true;
  placed.warp_noise = noise;
  placed.still_off = distances_from(valve, placed.where, placed.landmarks.xyz);
  return warp;
}

// ---- The mesh ----

namespace {

// Returns the mean distance of the landmarks from their nearest nodes, after the axes and the unit are changed.
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

}  // namespace

void check_at_nodes(const LandmarkFile &landmarks, std::int64_t n_nodes, const double *nodes, const std::string &of,
                    Reader reader) {
  // Landmarks lie on the wall, so nodes of the mesh must be near them. Landmarks that are a centimetre away from all nodes
  // therefore do not fit the mesh.
  const double near = factor_between(Unit::centimetre, landmarks.unit);
  const double apart = distance_from_nodes(landmarks, n_nodes, nodes, 1, 1);
  if (apart <= near) return;
  std::string text = landmarks.path + ": the landmarks are " + digits(apart, 3) + " " + name_of(landmarks.unit) +
                     " from the nodes" + of + " on average";
  for (const Unit unit : {landmarks.unit, Unit::metre, Unit::centimetre, Unit::millimetre})
    for (const double sign : {1.0, -1.0}) {
      const double factor = factor_between(landmarks.unit, unit);
      const double other = distance_from_nodes(landmarks, n_nodes, nodes, sign, factor);
      if (other > factor * near) continue;
      std::vector<std::string> changes;
      if (unit != landmarks.unit) changes.push_back(std::string("in ") + words_of(unit));
      if (sign < 0) changes.emplace_back("with the signs of x and y reversed, as between LPS and RAS");
      text +=
          "; " + joined_by(changes, " and ") + ", they are " + digits(other, 3) + " " + name_of(unit) + " from them: ";
      std::vector<std::string> advice;
      if (unit != landmarks.unit)
        advice.push_back("give " + (landmarks.is_file ? option_text(reader, "unit", name_of(unit))
                                                      : std::string("the landmarks in ") + words_of(unit)));
      if (sign < 0 && landmarks.axes != Axes::mesh)
        advice.push_back("give " + option_text(reader, "axes", landmarks.axes == Axes::LPS ? "RAS" : "LPS") +
                         ", the mesh's axes");
      else if (sign < 0)
        advice.emplace_back(landmarks.is_file ? "state the axes of the file"
                                              : "rotate the landmarks by 180 degrees about z");
      text += joined_by(advice, " and ");
      refuse_data(text);
    }
  refuse_data(text + ", which is more than 1 cm, whatever the unit and the axes (LPS or RAS)");
}

// ---- Outputs ----

namespace {

Json json_of_points(const std::vector<double> &xyz) {
  Json points = Json::array();
  for (std::size_t i = 0; i < xyz.size(); i += 3) points.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
  return points;
}

Json parameters_of(const riis_valve *valve) {
  Json parameters = Json::parse(json_template(valve));
  parameters.erase("opening");
  return parameters;
}

std::string filled(const std::string &text, std::size_t width) {
  return text + std::string(std::max(width, text.size() + 1) - text.size(), ' ');
}

// Returns a distance from the valve as text. A distance that is smaller than the error of measured distances is shown as 0.
std::string distance_text(double distance, double centimetre) {
  return distance > distance_error * centimetre ? digits(distance, 3) : "0";
}

double root_mean_square(const std::vector<double> &values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

std::string placed_file_of(const Placed &placed, const riis_valve *valve) {
  const riis_placement &at = placed.placement;
  Json root = Json::object();
  root["valve"] = placed.kind;
  root["unit"] = name_of(placed.landmarks.unit);
  root["axes"] = name_of(placed.landmarks.axes);
  root["rotate"] = {at.rotation_axis[0], at.rotation_axis[1], at.rotation_axis[2], at.rotation_angle};
  root["translate"] = {at.translation[0], at.translation[1], at.translation[2]};
  root["parameters"] = parameters_of(valve);
  const auto by_name = [&](const std::vector<double> &values) {
    Json made = Json::object();
    for (std::size_t i = 0; i < values.size(); ++i) {
      // Several landmarks may have one name, for example points of the annulus.
      std::string name = placed.landmarks.names[i];
      while (made.contains(name)) name += "'";
      made[name] = values[i];
    }
    return made;
  };
  if (placed.is_warped) {
    Json warp = Json::object();
    warp["sources"] = json_of_points(placed.sources);
    warp["targets"] = json_of_points(placed.targets);
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
    if (size.state == RIIS_SIZE_TIED && !size.follows) tied.push_back(size.parameter.name);
  }
  fit["standard_errors"] = errors;
  fit["undetermined"] = undetermined;
  fit["in_proportion"] = tied;
  fit["residuals"] = by_name(placed.residuals);
  if (placed.is_warped) {
    fit["warped_rms"] = root_mean_square(placed.still_off);
    fit["warped_worst"] = *std::max_element(placed.still_off.begin(), placed.still_off.end());
    fit["warped_residuals"] = by_name(placed.still_off);
  }
  root["fit"] = fit;
  return root.dump(2) + "\n";
}

std::string with_parameters_of(const std::string &placed_file, const riis_valve *valve) {
  Json root = Json::parse(placed_file);
  root["parameters"] = parameters_of(valve);
  return root.dump(2) + "\n";
}

std::string place_report(const Placed &placed, Reader reader) {
  const LandmarkFile &landmarks = placed.landmarks;
  const riis_placement &at = placed.placement;
  const std::string unit = name_of(landmarks.unit);
  const bool is_mapping = reader == Reader::python && landmarks.path == "landmarks";
  std::string text = placed.kind + " valve from " + std::to_string(landmarks.names.size()) + " landmarks" +
                     (is_mapping ? "" : " of " + landmarks.path) + ", axes " + name_of(landmarks.axes) + ", noise " +
                     digits(placed.noise, 3) + " " + unit + "\n\n";
  std::size_t width = 16;
  for (const Size &size : placed.sizes) width = std::max(width, std::string(size.parameter.name).size() + 2);
  text += filled("parameter", width) + filled("value", 26) + filled("std. error", 12) + "from\n";
  std::vector<std::string> undetermined;
  for (const Size &size : placed.sizes) {
    if (size.state == RIIS_SIZE_KEPT || size.follows) continue;
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
          digits(at.noise, 2) + " " + unit + (at.noise > 1.05 * placed.noise ? ", which the residuals show" : "") +
          "\n";
  std::size_t name_width = 16;
  for (const std::string &name : landmarks.names) name_width = std::max(name_width, name.size() + 2);
  // Distances between valve and landmarks are printed in millimetres, whatever the landmarks' unit, because a person reads and
  // compares them.
  const double mm = factor_between(landmarks.unit, Unit::millimetre);
  const auto distance = [&](double in_unit) { return distance_text(mm * in_unit, mm * at.scale); };
  const std::string column = "residual mm";
  text += "\n" + filled("landmark", name_width) + (placed.is_warped ? filled(column, 16) + "warped mm" : column) + "\n";
  for (std::size_t i = 0; i < landmarks.names.size(); ++i) {
    const std::string residual = digits(mm * placed.residuals[i], 3);
    text += filled(landmarks.names[i], name_width) +
            (placed.is_warped ? filled(residual, 16) + distance(placed.still_off[i]) : residual) + "\n";
  }
  text += "rms " + digits(mm * at.rms, 3) + ", worst " + digits(mm * at.worst, 3) + " at " +
          landmarks.names[static_cast<std::size_t>(at.worst_landmark_id)] + "\n";
  const auto farthest = std::max_element(placed.still_off.begin(), placed.still_off.end());
  if (placed.is_warped)
    text += "warped, rms " + distance(root_mean_square(placed.still_off)) + ", worst " + distance(*farthest) + " at " +
            landmarks.names[static_cast<std::size_t>(farthest - placed.still_off.begin())] +
            (placed.warp_noise > 0 ? "; smoothed by the noise of " + digits(mm * placed.warp_noise, 3) + " mm" : "") +
            "\n";
  else if (placed.kind != "bileaflet" && at.worst > 3 * std::max(placed.noise, 1e-6 * at.scale))
    text += "The valve misses the landmarks. " + option_text(reader, "warp", "exact") +
            " takes the valve exactly to them, and " + option_text(reader, "warp", "smoothed") +
            " takes it to within about their noise.\n";
  if (at.n_as_annulus > 0)
    text += std::string(at.n_as_annulus == 1 ? "The trigone lies" : "The trigones lie") +
            " behind the anterior horn, where the valve has no trigones: " +
            (at.n_as_annulus == 1 ? "it counts as a point" : "they count as points") +
            " of the annulus, and IT_distance does not depend on trigones.\n";
  if (placed.n_trigones_left_out > 0)
    text += "The trigones are left out, because the " + placed.kind + " valve has none.\n";
  if (placed.kind == "aortic")
    text +=
        "The paper's aortic valve does not close at opening 0. For a valve that closes, choose the kind coapting or "
        "trileaflet with the same landmarks.\n";
  text += undetermined.empty()
              ? "\nThe landmarks determine all sizes that are fitted to them, so no more landmarks are needed.\n"
              : "\nThe landmarks do not determine " + joined_by(undetermined, ", ") +
                    ".\nThe table has guesses of these sizes, from the usual proportions of this kind of valve. The "
                    "error of a "
                    "guess may move the valve by more\nthan a fifteenth of the valve's radius. Add landmarks" +
                    (reader == Reader::program
                         ? ", or give known sizes in cm, for example by --set " + undetermined.front() + "=VALUE"
                         : ", or give known sizes") +
                    ".\n";
  return text;
}

}  // namespace riis::program
