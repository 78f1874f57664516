// SPDX-License-Identifier: Apache-2.0
#include "program/commands/commands.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/array_view.hpp"
#include "program/base/handles.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/valve_source.hpp"
#include "program/input/wall.hpp"
#include "program/mark/crossings.hpp"
#include "program/mark/moving_valve.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/outputs.hpp"
#include "program/output/report.hpp"

namespace riis::program {

namespace {

struct State {
  double opening;  // or the time
  std::vector<riis_leaflet> leaflets;
  std::optional<riis_orifice> orifice;
  std::optional<riis_coaptation> contact{};  // of all leaflets
};

struct States {
  std::vector<std::int32_t> ids;  // ids of the leaflets, ascending
  std::vector<std::string> names;
  std::string why_no_edges;   // "": the leaflets have free edges
  std::string disc;           // such as "the disc of root_radius 1.29"; "": the valve has no orifice
  double disc_area;           // outline_area of the closed state
  std::string reach;          // the distance that the band's rim reaches into the orifice, as text
  std::vector<State> states;  // ascending by opening; the first is closed
  std::string why_closed;     // the library's refusal of other openings; "" if the valve opens
  bool is_of_file = false;    // whether the states are of a surface from a file, by time

  bool has_edges() const { return why_no_edges.empty(); }
};

// A parametric valve in its own coordinates, or a surface from a file.
class Measured {
 public:
  explicit Measured(const StatesOptions &options) : options_(options) {
    Seconds seconds;
    static_cast<ValveOptions &>(source_.options) = options;
    if (options.surface.empty()) {
      source_.options.surface_options = own_frame(options);
      source_.valve = make_valve(options);
      source_.law = OpeningLaw(OpeningTable{{0, 1}, {0, 1}}, "");  // the opening equals the time
    } else if (is_motion(options)) {
      KeyframeFiles read = read_keyframes(options, seconds);
      places_ = std::move(read.times);
      source_.keyframes = std::move(read.keyframes);
    } else {
      source_.file = read_surface(options, seconds);
    }
    moving_.emplace(source_, places_.front(), !source_.file);
    if (!options.surface.empty() && !options.wall.empty() && !options.skirt) wall_ = wall_of(options);
    if (!source_.valve) return;
    why_closed_ = program::why_closed(source_.valve, own_frame(options));
    if (why_closed_.empty()) places_ = openings_from_0_to_1(options.n_states);
    move_to(0);
  }

  // Moves the surface to a state: to an opening of a valve, or to a time of a moving surface.
  void move_to(double place) { moving_->move_to(place); }
  const riis_valve *valve() const { return source_.valve; }  // null for a surface from a file
  const riis_surface *surface() const { return moving_->surface(); }
  const std::string &why_closed() const { return why_closed_; }
  // Returns the openings or the times of the table.
  const std::vector<double> &places() const { return places_; }

  std::vector<riis_leaflet> leaflets() const {
    int64_t n = 0;
    check(riis_surface_get_n_leaflets(surface(), &n));
    std::vector<riis_leaflet> made;
    for (int64_t i = 0; i < n; ++i) made.push_back(get<riis_leaflet>(riis_surface_get_leaflet, surface(), i));
    return made;
  }

  riis_orifice orifice() const {
    if (!wall_) return get<riis_orifice>(riis_surface_get_orifice, surface(), nullptr);
    riis_orifice made;
    check(riis_surface_get_orifice_in_wall(surface(), wall_, nullptr, &made, sizeof made), options_.wall);
    return made;
  }

  riis_coaptation contact() const {
    return get<riis_coaptation>(riis_surface_get_coaptation, surface(), RIIS_AUTO, RIIS_ALL_LEAFLETS);
  }

 private:
  const StatesOptions &options_;
  ValveSource source_{MarkOptions(), nullptr, nullptr};
  std::optional<MovingValve> moving_;
  std::vector<double> places_ = {0};
  std::string why_closed_;
  Surface wall_;  // the wall that bounds the orifice of a surface from a file, or null
};

State state_at(Measured &valve, double place, bool has_contacts) {
  valve.move_to(place);
  State state{place, valve.leaflets(), valve.orifice()};
  if (state.orifice->outline == RIIS_OUTLINE_NONE) state.orifice.reset();
  if (has_contacts) state.contact = valve.contact();
  return state;
}

// Returns the names and the ids of the leaflets, and the disc of the closed state. All openings share these values.
States frame_of(const StatesOptions &options, const Measured &valve) {
  const bool is_valve = valve.valve() != nullptr;
  const riis_surface_info info = info_of(valve.surface());
  const riis_orifice orifice = valve.orifice();
  States states{{}, {}, "", "", orifice.outline_area, "", {}, ""};
  states.is_of_file = !is_valve;
  for (const riis_leaflet &leaflet : valve.leaflets()) {
    states.ids.push_back(leaflet.leaflet_id);
    states.names.push_back(name_of_leaflet(options, info, leaflet.leaflet_id));
    if (leaflet.free_edge == 0 && leaflet.leaflet_id != info.skirt_leaflet_id)
      states.why_no_edges =
          is_valve ? "the side v = 1 of a leaflet is not free" : "all open edges of a leaflet lie on the outline";
  }
  // A rigid leaflet only rotates, so its lengths do not change.
  if (info.housing_leaflet_id >= 0) states.why_no_edges = "the leaflets are rigid";
  if (orifice.outline == RIIS_OUTLINE_DISC) states.disc = "the disc of radius " + shown(orifice.radius);
  if (orifice.outline == RIIS_OUTLINE_ATTACHMENT) states.disc = "the outline of the attachment";
  if (orifice.outline == RIIS_OUTLINE_BOUNDARY) states.disc = "the outline of the open edges";
  if (orifice.outline == RIIS_OUTLINE_WALL) states.disc = "the longest open boundary of the wall";
  states.reach = shown(orifice.rim_reach) + " half thicknesses of " + shown(orifice.half_thickness);
  return states;
}

// Measures the valve at n_states openings. If the valve cannot open, measures it only at opening 0.
States measure_states(const StatesOptions &options) {
  Measured valve(options);
  States states = frame_of(options, valve);
  states.why_closed = valve.why_closed();
  const std::vector<double> &places = valve.places();
  const std::size_t n = places.size();
  StepProgress progress("measuring the valve", n, options.quiet);
  for (std::size_t i = 0; i < n; ++i) {
    progress.begin(i);
    states.states.push_back(state_at(valve, places[i], options.has_contacts));
    if (!states.states.back().orifice) states.disc.clear();
  }
  if (valve.valve()) check_shape(options, valve.valve(), !options.params_open.empty());
  return states;
}

// ---- State table ----

// The summary mentions a free edge if its length changes by more than this share.
constexpr double fair_change = 0.1;
// Lengths and areas count as equal if their difference can be due to rounding.
constexpr double same = 1e-9;

using StateValue = std::function<double(const State &)>;

// Finds the state with the least value, and the state with the greatest value. If several states have the extreme value, finds
// the first of these states.
struct Extremes {
  const State *least, *most;
};

Extremes extremes_of(const States &states, const StateValue &value) {
  const auto less = [&](const State &a, const State &b) { return value(a) < value(b); };
  const auto begin = states.states.begin(), end = states.states.end();
  return {&*std::min_element(begin, end, less), &*std::max_element(begin, end, less)};
}

// Returns a ratio or an area as text with few digits.
std::string rounded(double value) { return shown(std::round(value * 1e4) / 1e4); }

std::string at(const State &state) { return " at " + shown(state.opening); }

// Returns the opening or the time of the first state. For a valve, the first state is the closed state.
std::string at_first(const States &states) {
  if (states.is_of_file && states.states.size() == 1) return "";
  return at(states.states.front());
}

std::string ratios_of(const States &states, const StateValue &value) {
  const double closed = value(states.states.front());
  std::string text = shown(closed) + (states.is_of_file ? at_first(states) : " when closed");
  if (states.states.size() == 1) return text;
  const auto [least, most] = extremes_of(states, value);
  if (value(*most) - value(*least) <= same * closed)
    return text + (states.is_of_file ? ", and at every time" : ", and at every opening");
  return text + ", times " + rounded(value(*least) / closed) + at(*least) + " to " + rounded(value(*most) / closed) +
         at(*most);
}

StateValue size_of(std::size_t leaflet, double riis_leaflet::*size) {
  return [=](const State &state) { return state.leaflets[leaflet].*size; };
}

// Collects the lines of the summary, and aligns their texts.
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
    const bool has_edge = states.has_edges() && states.states.front().leaflets[i].free_edge > 0;
    if (has_edge) summary.add(states.names[i], "free edge " + ratios_of(states, size_of(i, &riis_leaflet::free_edge)));
    summary.add(has_edge ? "" : states.names[i], "area " + ratios_of(states, size_of(i, &riis_leaflet::area)));
  }
}

// Returns the orifice's area at the first state, and its largest area.
std::string text_of_area(const States &states, double riis_orifice::*area) {
  const StateValue value = [=](const State &state) { return (*state.orifice).*area; };
  std::string text = rounded(value(states.states.front())) + at_first(states);
  if (states.states.size() == 1) return text;
  const State *most = extremes_of(states, value).most;
  return text + ", largest " + rounded(value(*most)) + at(*most);
}

std::string text_of_orifice(const States &states) {
  if (states.disc.empty()) return "not measured, because no open edges surround an area";
  return text_of_area(states, &riis_orifice::area) + "; " + states.disc + " has " + rounded(states.disc_area);
}

std::string text_of_contact(const States &states) {
  const State *most = extremes_of(states, [](const State &state) { return state.contact->area; }).most;
  const riis_coaptation &first = *states.states.front().contact;
  std::string text = "area " + rounded(first.area) + ", free edge " + rounded(first.edge) + at_first(states);
  if (states.states.size() > 1) text += "; largest area " + rounded(most->contact->area) + at(*most);
  return text;
}

// Lists the free edges whose length changes by more than a tenth, and the opening at which each change begins.
std::string text_of_changes(const States &states) {
  std::string text;
  for (std::size_t i = 0; i < states.names.size(); ++i) {
    const double closed = size_of(i, &riis_leaflet::free_edge)(states.states.front());
    const auto is_beyond = [&](const State &state) {
      return std::abs(state.leaflets[i].free_edge / closed - 1) > fair_change;
    };
    const auto n = std::count_if(states.states.begin(), states.states.end(), is_beyond);
    if (n == 0) continue;
    const auto first = std::find_if(states.states.begin(), states.states.end(), is_beyond);
    text += (text.empty() ? "" : ", ") + states.names[i] + " (" + counted(n, states.is_of_file ? "time" : "opening") +
            ", first " + shown(first->opening) + ")";
  }
  const std::string range =
      states.is_of_file ? "within 10 % of their first length" : "within 10 % of their closed length";
  return text.empty() ? "all " + range : "not " + range + ": " + text;
}

// Returns names of columns. Blanks and dashes in the names of leaflets become _. If a name has another special character, such as
// > in "x > 0", all leaflets are named by numbers.
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

std::string cells_of(const riis_leaflet &now, const riis_leaflet &closed, bool has_edges) {
  std::string text;
  if (has_edges)
    text += "," + shortest(now.free_edge) + "," + shortest(closed.free_edge > 0 ? now.free_edge / closed.free_edge : 1);
  return text + "," + shortest(now.area) + "," + shortest(now.area / closed.area);
}

// The columns are the opening, then NAME_edge, NAME_edge_ratio, NAME_area and NAME_area_ratio of each leaflet, then orifice_area,
// orifice_perimeter and effective_area. A ratio is the value divided by the value of the closed state.
std::string csv_of(const States &states) {
  std::string text = states.is_of_file ? "time" : "opening";
  for (const std::string &name : columns_of(states)) {
    const std::string column = "," + name;
    if (states.has_edges()) text += column + "_edge" + column + "_edge_ratio";
    text += column + "_area" + column + "_area_ratio";
  }
  if (!states.disc.empty()) text += ",orifice_area,orifice_perimeter,effective_area";
  if (states.states.front().contact) text += ",contact_area,contact_edge";
  text += "\n";
  for (const State &state : states.states) {
    text += shortest(state.opening);
    for (std::size_t i = 0; i < state.leaflets.size(); ++i)
      text += cells_of(state.leaflets[i], states.states.front().leaflets[i], states.has_edges());
    if (!states.disc.empty())
      text += "," + shortest(state.orifice->area) + "," + shortest(state.orifice->perimeter) + "," +
              shortest(state.orifice->effective_area);
    if (state.contact) text += "," + shortest(state.contact->area) + "," + shortest(state.contact->edge);
    text += "\n";
  }
  return text;
}

std::string summary_of(const States &states, const StatesOptions &options) {
  const bool can_open = states.why_closed.empty();
  Summary summary(states);
  const auto n = static_cast<std::int64_t>(states.states.size());
  if (states.is_of_file)
    summary.add("surface",
                options.surface + (n > 1 ? ": " + counted(n, "time") + " from " + shown(states.states.front().opening) +
                                               " to " + shown(states.states.back().opening)
                                         : ""));
  else
    summary.add("valve", options.valve + ": " +
                             (can_open ? counted(n, "opening") + " from 0 to 1"
                                       : "only opening 0, because the valve has no open state"));
  add_leaflets(states, summary);
  summary.add("orifice", text_of_orifice(states));
  if (!states.disc.empty())
    summary.add("effective", text_of_area(states, &riis_orifice::effective_area) + "; the band's rim takes " +
                                 states.reach +
                                 (std::any_of(states.states.begin(), states.states.end(),
                                              [](const State &state) { return has_slits(*state.orifice); })
                                      ? slits_text
                                      : ""));
  if (states.states.front().contact) summary.add("contact", text_of_contact(states));
  if (!states.has_edges()) summary.add("edges", "not measured: " + states.why_no_edges);
  if (states.has_edges() && can_open) summary.add("edges", text_of_changes(states));
  summary.add("written", options.output);
  return summary.text();
}

}  // namespace

riis_surface_options own_frame(const ValveOptions &options) {
  // The orifice of the triangles differs slightly from the orifice of the smooth valve. At the program's usual tolerance, the two
  // orifices of the prosthesis differ by up to 0.3 %. The tolerance chosen here reduces the difference to at most about 0.1 % for
  // the prosthesis and for the aortic valve.
  constexpr double fine_tolerance = 0.01;
  riis_surface_options own = options.surface_options;
  if (!options.has_tolerance) own.tolerance = fine_tolerance;
  return own;
}

void run_states(const StatesOptions &options) {
  const OutputLocks locks = check_outputs(options);
  const States states = measure_states(options);
  write_text(options.output, csv_of(states));
  if (!options.quiet && options.output != "-") write_text("-", summary_of(states, options));
}

}  // namespace riis::program
