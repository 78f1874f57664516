// SPDX-License-Identifier: Apache-2.0
#include "program/states.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "common/array_view.hpp"
#include "program/crossings.hpp"
#include "program/handles.hpp"
#include "program/orifice.hpp"
#include "program/outputs.hpp"
#include "program/patch_sides.hpp"
#include "program/pictures.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"
#include "program/report.hpp"
#include "program/text.hpp"
#include "program/valve_file.hpp"
#include "program/valve_source.hpp"
#include "program/warnings.hpp"

namespace riis::program {

namespace {

// At the program's usual tolerance the triangles change the prosthesis' orifice by up to 0.3 %. At this tolerance the change is
// below 0.1 %, and 0.1 % for the aortic valve.
constexpr double fine_tolerance = 0.01;

riis_surface_options own_frame(const StatesOptions &options) {
  riis_surface_options own = options.surface_options;  // the scale is the command's only placement
  if (!options.has_tolerance) own.tolerance = fine_tolerance;
  return own;
}

struct Disc {
  std::string parameter{};  // the parameter's name, such as root_radius
  double radius = 0;
  PlanePoint centre{};  // the mean translation of the valve or of its cusps
};

bool ends_in_translation(const std::string &name) {
  const std::string ending = "translation";
  return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

// A valve with its surface.
class OpeningValve {
 public:
  explicit OpeningValve(const StatesOptions &options) : options_(options), valve_(make_valve(options)) {
    set_opening(0);
    const riis_surface_options own = own_frame(options);
    riis_surface *surface = nullptr;
    check(riis_surface_create(valve_.get(), &own, &surface), subject());
    surface_.reset(surface);
  }

  void open_to(double opening) {
    set_opening(opening);
    check(riis_surface_update(surface_.get(), valve_.get(), nullptr), subject());
  }

  std::string why_closed() { return program::why_closed(valve_.get(), own_frame(options_)); }

  // Returns the disc of the root or of a housing about the axis, or nothing if the valve has no such radius.
  std::optional<Disc> disc() const {
    Disc disc;
    std::size_t n_shifts = 0;
    for (const riis_parameter &parameter : parameters()) {
      const std::string name = parameter.name;
      if (name == "root_radius" || name == "radius") {
        disc.parameter = name;
        disc.radius = values_of(parameter)[0];
      }
      if (!ends_in_translation(name)) continue;
      const Point value = values_of(parameter);
      ++n_shifts;
      for (std::size_t k = 0; k < 2; ++k) disc.centre[k] += (value[k] - disc.centre[k]) / static_cast<double>(n_shifts);
    }
    return disc.parameter.empty() ? std::nullopt : std::optional(disc);
  }

  riis_triangles arrays() const { return triangles_of(surface_.get()); }

 private:
  std::vector<riis_parameter> parameters() const {
    int64_t n = 0;
    check(riis_valve_get_n_parameters(valve_.get(), &n));
    std::vector<riis_parameter> all(static_cast<std::size_t>(n));
    for (int64_t i = 0; i < n; ++i) check(riis_valve_get_parameter(valve_.get(), i, &view(all)[i], sizeof all[0]));
    return all;
  }
  // Returns the values in the unit of the surface.
  Point values_of(const riis_parameter &parameter) const {
    Point values{};
    check(riis_valve_get(valve_.get(), parameter.name, parameter.n_values, values.data()));
    for (double &value : values) value *= options_.surface_options.scale;
    return values;
  }

  std::string subject() const { return is_valve_file(options_.valve) ? options_.valve : ""; }
  void set_opening(double opening) { check(riis_valve_set_scalar(valve_.get(), "opening", opening)); }

  const StatesOptions &options_;
  Valve valve_;
  Surface surface_;
};

std::vector<std::string> names_of_leaflets(const StatesOptions &options,
                                           const std::map<std::int32_t, LeafletSize> &sizes) {
  const std::vector<const char *> known = leaflet_names(options);
  std::vector<std::string> names;
  for (const auto &[id, size] : sizes) {
    const auto at = static_cast<std::size_t>(id);
    names.push_back(at < known.size() ? known[at] : "leaflet " + std::to_string(id));
  }
  return names;
}

// Edges that meet in the closed valve are free if they separate when it opens.
std::set<std::int32_t> free_edges_of(OpeningValve &valve, bool can_open) {
  std::set<std::int32_t> free = free_edges(sides_of_patches(valve.arrays()));
  if (!can_open) return free;
  valve.open_to(1);
  free.merge(free_edges(sides_of_patches(valve.arrays())));
  return free;
}

// Rigid leaflets that turn keep all lengths.
bool is_rigid(const std::string &valve) { return valve == "bileaflet"; }

class Measures {
 public:
  Measures(const StatesOptions &options, OpeningValve &valve, bool can_open)
      : options_(options), valve_(valve), disc_(valve.disc()) {
    valve_.open_to(0);
    free_ = free_edges_of(valve_, can_open);
  }

  State at(double opening) {
    valve_.open_to(opening);
    const riis_triangles surface = valve_.arrays();
    const std::vector<PatchSides> patches = sides_of_patches(surface);
    State state{opening, {}, std::nullopt};
    for (const auto &[id, size] : sizes_of(surface, patches)) state.leaflets.push_back(size);
    if (const auto outline = outline_of(patches)) state.orifice = uncovered_area(*outline, projected(surface));
    return state;
  }

  // Returns the closed state's names, ids and disc, which all openings share.
  States frame() {
    valve_.open_to(0);
    const riis_triangles surface = valve_.arrays();
    const std::vector<PatchSides> patches = sides_of_patches(surface);
    const auto sizes = sizes_of(surface, patches);
    const auto outline = outline_of(patches);
    States states{{}, names_of_leaflets(options_, sizes), "", "", outline ? area_of(*outline) : 0, {}, ""};
    for (const auto &[id, size] : sizes) states.ids.push_back(id);
    for (const auto &[id, size] : sizes)
      if (size.edge == 0) states.why_no_edges = "a leaflet has no side v = 1 on its rim";
    if (is_rigid(options_.valve)) states.why_no_edges = "the leaflets are rigid";
    if (disc_) states.disc = "the disc of " + disc_->parameter + " " + shown(disc_->radius);
    if (!disc_ && outline) states.disc = "the outline of the attachment";
    return states;
  }

 private:
  std::map<std::int32_t, LeafletSize> sizes_of(const riis_triangles &surface,
                                               const std::vector<PatchSides> &patches) const {
    std::map<std::int32_t, LeafletSize> sizes;
    for (const auto &[id, area] : areas_of_leaflets(surface)) sizes[id] = {0, area};
    for (const PatchSides &patch : patches)
      if (free_.count(patch.patch_id) != 0) sizes[patch.leaflet_id].edge += line_length(patch.lines[side_v1]);
    return sizes;
  }

  std::optional<Outline> outline_of(const std::vector<PatchSides> &patches) const {
    return disc_ ? circle(disc_->radius, disc_->centre) : closed_outline(attachment(patches));
  }

  const StatesOptions &options_;
  OpeningValve &valve_;
  std::optional<Disc> disc_;
  std::set<std::int32_t> free_;
};

}  // namespace

States measure_states(const StatesOptions &options) {
  OpeningValve valve(options);
  const std::string why_closed = valve.why_closed();
  Measures measures(options, valve, why_closed.empty());
  States states = measures.frame();
  states.why_closed = why_closed;
  const std::size_t n = why_closed.empty() ? static_cast<std::size_t>(options.n_states) : 1;
  StepProgress progress("measuring the valve", n, options.quiet);
  for (std::size_t i = 0; i < n; ++i) {
    progress.begin(i);
    states.states.push_back(measures.at(n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 0));
    if (!states.states.back().orifice) states.disc.clear();
  }
  return states;
}

void run_states(const StatesOptions &options) {
  const OutputLocks locks = check_outputs(options);
  const States states = measure_states(options);
  check_shape(options, make_valve(options).get(), !options.params_open.empty());
  write_text(options.output, csv_of(states));
  if (options.quiet || options.output == "-") return;
  write_text("-", summary_of(states, options));
}

// ---- State table ----

namespace {

// A free edge may gain or lose this share of its closed length.
constexpr double fair_change = 0.1;
// Lengths and areas that differ by at most this share count as equal, since they differ by rounding.
constexpr double same = 1e-9;

using Value = std::function<double(const State &)>;

// Finds the states of the least and of the greatest value, and the first one of equal states.
struct Extremes {
  const State *least, *most;
};

Extremes extremes_of(const States &states, const Value &value) {
  const auto less = [&](const State &a, const State &b) { return value(a) < value(b); };
  const auto begin = states.states.begin(), end = states.states.end();
  return {&*std::min_element(begin, end, less), &*std::max_element(begin, end, less)};
}

// Returns a ratio or an area as readable text.
std::string rounded(double value) { return shown(std::round(value * 1e4) / 1e4); }

std::string at(const State &state) { return " at " + shown(state.opening); }

std::string ratios_of(const States &states, const Value &value) {
  const double closed = value(states.states.front());
  std::string text = shown(closed) + " when closed";
  if (states.states.size() == 1) return text;
  const auto [least, most] = extremes_of(states, value);
  if (value(*most) - value(*least) <= same * closed) return text + ", and at every opening";
  return text + ", times " + rounded(value(*least) / closed) + at(*least) + " to " + rounded(value(*most) / closed) +
         at(*most);
}

Value edge_of(std::size_t leaflet) {
  return [=](const State &state) { return state.leaflets[leaflet].edge; };
}

Value area_of_leaflet(std::size_t leaflet) {
  return [=](const State &state) { return state.leaflets[leaflet].area; };
}

// Collects the lines of the summary, with their texts aligned.
class Summary {
 public:
  explicit Summary(const States &states) {
    for (const std::string &name : states.names) width_ = std::max(width_, name.size() + 1);
  }
  void add(std::string label, const std::string &text) {
    label.resize(width_, ' ');
    text_ += label + text + "\n";
  }
  const std::string &text() const { return text_; }

 private:
  std::size_t width_ = 10;
  std::string text_;
};

void add_leaflets(const States &states, Summary &summary) {
  for (std::size_t i = 0; i < states.names.size(); ++i) {
    if (states.has_edges()) summary.add(states.names[i], "free edge " + ratios_of(states, edge_of(i)));
    summary.add(states.has_edges() ? "" : states.names[i], "area " + ratios_of(states, area_of_leaflet(i)));
  }
}

std::string text_of_orifice(const States &states) {
  if (states.disc.empty())
    return "not measured: the valve has no root_radius or radius, and its free sides v = 0 enclose no area along z";
  const Value value = [](const State &state) { return *state.orifice; };
  std::string text = rounded(value(states.states.front())) + " at 0";
  if (states.states.size() > 1) {
    const State *most = extremes_of(states, value).most;
    text += ", largest " + rounded(value(*most)) + at(*most);
  }
  return text + "; " + states.disc + " has " + rounded(states.disc_area);
}

// Lists the free edges that gain or lose more than a tenth, and the opening at which this begins.
std::string text_of_changes(const States &states) {
  std::string text;
  for (std::size_t i = 0; i < states.names.size(); ++i) {
    const double closed = edge_of(i)(states.states.front());
    const auto is_beyond = [&](const State &state) {
      return std::abs(state.leaflets[i].edge / closed - 1) > fair_change;
    };
    const auto n = std::count_if(states.states.begin(), states.states.end(), is_beyond);
    if (n == 0) continue;
    const auto first = std::find_if(states.states.begin(), states.states.end(), is_beyond);
    text += (text.empty() ? "" : ", ") + states.names[i] + " (" + counted(n, "opening") + ", first " +
            shown(first->opening) + ")";
  }
  const std::string range = "within 10 % of their closed length";
  return text.empty() ? "all " + range : "not " + range + ": " + text;
}

// Returns the names with letters, digits and _ only. Numbers replace them if a name has other characters, as "x > 0" has.
std::vector<std::string> columns_of(const States &states) {
  std::vector<std::string> columns = states.names;
  bool are_words = true;
  for (std::string &column : columns)
    for (char &c : column) {
      if (c == ' ' || c == '-') c = '_';
      are_words = are_words && (c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0);
    }
  for (std::size_t i = 0; i < columns.size() && !are_words; ++i)
    columns[i] = "leaflet_" + std::to_string(states.ids[i]);
  return columns;
}

std::string cells_of(const LeafletSize &now, const LeafletSize &closed, bool has_edges) {
  std::string text;
  if (has_edges) text += "," + shortest(now.edge) + "," + shortest(now.edge / closed.edge);
  return text + "," + shortest(now.area) + "," + shortest(now.area / closed.area);
}

}  // namespace

std::string csv_of(const States &states) {
  std::string text = "opening";
  for (const std::string &name : columns_of(states)) {
    const std::string column = "," + name;
    if (states.has_edges()) text += column + "_edge" + column + "_edge_ratio";
    text += column + "_area" + column + "_area_ratio";
  }
  if (!states.disc.empty()) text += ",orifice_area";
  text += "\n";
  for (const State &state : states.states) {
    text += shortest(state.opening);
    for (std::size_t i = 0; i < state.leaflets.size(); ++i)
      text += cells_of(state.leaflets[i], states.states.front().leaflets[i], states.has_edges());
    if (!states.disc.empty()) text += "," + shortest(*state.orifice);
    text += "\n";
  }
  return text;
}

std::string summary_of(const States &states, const StatesOptions &options) {
  const bool can_open = states.why_closed.empty();
  Summary summary(states);
  summary.add("valve",
              options.valve + ": " +
                  (can_open ? counted(static_cast<std::int64_t>(states.states.size()), "opening") + " from 0 to 1"
                            : "opening 0 alone, because it has no state to open to"));
  add_leaflets(states, summary);
  summary.add("orifice", text_of_orifice(states));
  if (!states.has_edges()) summary.add("edges", "not measured: " + states.why_no_edges);
  if (states.has_edges() && can_open) summary.add("edges", text_of_changes(states));
  summary.add("written", options.output);
  return summary.text();
}

}  // namespace riis::program
