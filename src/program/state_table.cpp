// SPDX-License-Identifier: Apache-2.0
#include "program/state_table.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "program/advice.hpp"
#include "program/numbers.hpp"
#include "program/report.hpp"

namespace riis::program {
namespace {

// A free edge may gain or lose this share of its closed length.
constexpr double fair_change = 0.1;
// Lengths and areas that differ by this share are the same but for rounding.
constexpr double same = 1e-9;

using Value = std::function<double(const State &)>;

// The states of the least and of the greatest value. Of equal states the first one counts.
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

// The lines of the summary, with texts below each other.
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

// The free edges that gain or lose more than a tenth, and where they begin to.
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

// The names in words of letters, digits and _, or numbers if a name has other characters, such as "x > 0".
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

std::string summary_of(const States &states, const Options &options) {
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
  summary.add("written", options.states);
  return summary.text();
}

}  // namespace riis::program
