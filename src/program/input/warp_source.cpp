// SPDX-License-Identifier: Apache-2.0
#include "program/input/warp_source.hpp"

#include <algorithm>

#include "common/array_view.hpp"
#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/opening_law.hpp"
#include "program/input/valve_file.hpp"

namespace riis::program {

namespace {

const std::vector<std::string> warp_keys = {"sources", "targets", "noise",         "coordinates",
                                            "times",   "period",  "interpolation", "open"};
const std::vector<std::string> open_keys = {"sources", "targets", "times", "period", "interpolation"};
const std::vector<std::string> coordinate_names = {"mesh", "valve"};

// Appends the coordinates of the points in a JSON array.
void add_points(const CaseValues &values, const char *key, const Json &list, std::vector<double> &xyz) {
  if (!list.is_array()) values.refuse(key, "it must be an array of points [x, y, z]");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto point = point_in(list[i]);
    if (!point) values.refuse(key, "point " + std::to_string(i) + ", " + list[i].dump() + ", is not [x, y, z]");
    xyz.insert(xyz.end(), point->begin(), point->end());
  }
}

// The landmarks are data of the case, so a refusal of landmarks names the case.
void check_landmarks(riis_status status, const std::string &subject) {
  if (status == RIIS_INVALID_ARGUMENT || status == RIIS_INVALID_PARAMETER)
    refuse_data(subject + ": " + riis_last_error());
  check(status);
}

}  // namespace

LandmarkPairs::LandmarkPairs(const CaseValues &values, double noise, const riis_surface_options *placement,
                             double factor)
    : subject_(values.subject()) {
  add_points(values, "sources", values.needed("sources"), sources_);
  n_landmarks_ = view(sources_).size() / 3;
  const Json &targets = values.needed("targets");
  if (values.has("times")) {
    times_ = values.numbers("times");
    period_ = values.above_zero("period").value_or(0);
    interpolation_ = static_cast<std::int32_t>(values.choice("interpolation", interpolation_names()));
    if (!targets.is_array() || targets.size() != times_.size())
      values.refuse("targets", "with \"times\" it must be an array of " + std::to_string(times_.size()) +
                                   " arrays of points, one for each time");
    for (const Json &frame : targets) add_points(values, "targets", frame, targets_);
  } else {
    for (const char *key : {"period", "interpolation"})
      if (values.has(key)) values.refuse(key, "it needs \"times\"");
    times_ = {0};
    add_points(values, "targets", targets, targets_);
  }
  const auto n_frames = static_cast<std::int64_t>(times_.size());
  if (view(targets_).size() != 3 * n_landmarks_ * n_frames)
    values.refuse("targets", "there are " + std::to_string(view(targets_).size() / 3) + " points for " +
                                 std::to_string(n_landmarks_ * n_frames) + " sources at all times");
  for (std::vector<double> *const list : {&sources_, &targets_})
    for (double &x : *list) x *= factor;
  const riis_points points = points_of(sources_);
  auto options = defaults<riis_warp_options>();
  options.noise = noise;
  options.placement = placement;
  check_landmarks(riis_warp_create(&points, &options, warp_.out()), subject_);
  at(times_.front());
}

const riis_warp *LandmarkPairs::at(double time) {
  auto frames = defaults<riis_keyframe_arrays>();
  frames.n_keys = view(times_).size();
  frames.n_vertices = n_landmarks_;
  frames.time = times_.data();
  frames.xyz = targets_.data();
  frames.period = period_;
  frames.interpolation = interpolation_;
  check_landmarks(riis_warp_set_targets_at(warp_, &frames, time), subject_);
  return warp_;
}

WarpSource::WarpSource(const std::string &path, const std::string &object, const Json &warp,
                       const riis_surface_options &placement, double factor) {
  const CaseValues closed(path, object, warp, warp_keys);
  subject_ = closed.subject();
  is_in_mesh_ = closed.choice("coordinates", coordinate_names) == 0;
  const riis_surface_options *placed = is_in_mesh_ ? &placement : nullptr;
  if (!placed) factor = 1;
  noise_ = factor * closed.at_least_zero("noise").value_or(0);
  pairs_.emplace_back(closed, noise_, placed, factor);
  if (!closed.has("open")) return;
  const std::string open = object.empty() ? "open" : object + ": open";
  pairs_.emplace_back(CaseValues(path, open, closed.needed("open"), open_keys), noise_, placed, factor);
}

namespace {

// Reads lines of the form SX,SY,SZ,TX,TY,TZ. Each line has a landmark on the valve and its place in the patient. Returns a JSON
// object that describes the warp.
Json json_of_csv(const std::string &path) {
  const CsvFile file = csv_of_text(path, text_of_file(path), {"noise", "coordinates"},
                                   "SX,SY,SZ,TX,TY,TZ: the place of a landmark on the valve, then in the patient", 6);
  Json warp = Json::object();
  warp["sources"] = warp["targets"] = Json::array();
  for (const auto &[name, value] : file.stated)
    warp[name] = name == "noise" ? Json(number_in_file(path, value, "noise")) : Json(value);
  for (const CsvFile::Row &row : file.rows) {
    const bool is_heading =
        &row == &file.rows.front() && std::none_of(row.cells.begin(), row.cells.end(), [](const std::string &cell) {
          return cell.find_first_of("0123456789") != std::string::npos;
        });
    if (is_heading) continue;
    Json source = Json::array(), target = Json::array();
    for (std::size_t k = 0; k < 6; ++k)
      (k < 3 ? source : target).push_back(number_in_file(path, row.cells[k], row.where));
    warp["sources"].push_back(source);
    warp["targets"].push_back(target);
  }
  return warp;
}

}  // namespace

WarpSource read_warp(const ValveOptions &options) {
  PlacedFile placed;
  if (!options.placed.empty())
    placed = read_placed(options.placed, parse_json_file(options.placed, "a placed valve"), options.unit);
  const bool is_placed = !placed.warp.is_null();
  if (options.warp.empty()) {
    if (!is_placed) return {};
    return {options.placed, "warp", placed.warp, options.surface_options, placed.factor};
  }
  if (is_placed) refuse_usage("--warp has no effect with --valve " + options.placed + ", which has a warp");
  const bool is_csv = has_ending(options.warp, ".csv");
  if (!is_csv && !has_ending(options.warp, ".json"))
    refuse_usage("--warp: " + options.warp + " must end in .json or .csv");
  return {options.warp, "", is_csv ? json_of_csv(options.warp) : parse_json_file(options.warp, "a warp"),
          options.surface_options};
}

bool WarpSource::moves() const {
  return std::any_of(pairs_.begin(), pairs_.end(), [](const LandmarkPairs &pairs) { return pairs.moves(); });
}

void WarpSource::apply(double time, riis_valve *valve) {
  if (pairs_.empty()) return;
  const riis_warp *closed = pairs_.front().at(time);
  const riis_warp *open = pairs_.size() > 1 ? pairs_.back().at(time) : nullptr;
  check_landmarks(riis_valve_set_warp(valve, closed, open), subject_);
}

}  // namespace riis::program
