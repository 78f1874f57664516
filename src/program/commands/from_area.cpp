// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "program/base/handles.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/commands/commands.hpp"
#include "program/input/opening_law.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {
namespace {

// The areas that the user wants, in the mesh's unit. Areas from a file also have times.
struct Areas {
  std::vector<double> times, areas;
};

Areas areas_of(const AreaOptions &options) {
  if (options.area) return {{}, {*options.area}};
  const auto is_good = [](double area) { return area >= 0; };
  TimedValues keys = read_keys(options.areas, {"area", "areas", is_good, "is below 0"});
  for (double &area : keys.values) area *= options.area_factor;
  return {std::move(keys.times), std::move(keys.values)};
}

struct Solution {
  std::vector<double> values, reached;
  riis_area_range range{};
};

std::string words_of(const AreaOptions &options) { return options.is_effective ? "effective area" : "area"; }

// Returns the text of a number with nine digits. With so many digits, the printed opening or size gives the same area again.
std::string exact(double number) { return printed("%.9g", number); }

std::string text_of_range(const AreaOptions &options, const riis_area_range &range) {
  return "from " + options.solve + " " + shown(range.from) + " to " + shown(range.to) + " the " + words_of(options) +
         " goes from " + exact(range.least) + " to " + exact(range.most);
}

// A search for a size opens the valve if the user gave no opening.
Valve valve_of(const AreaOptions &options) {
  Valve valve = make_valve(options);
  if (options.solve == "opening" || sets_opening(options)) return valve;
  if (why_closed(copy_of(valve), own_frame(options)).empty()) check(riis_valve_set_scalar(valve, "opening", 1));
  return valve;
}

class Search {
 public:
  explicit Search(const AreaOptions &options) : options_(options), valve_(valve_of(options)), own_(own_frame(options)) {
    search_.surface = &own_;
    if (options.from) search_.from = *options.from;
    if (options.to) search_.to = *options.to;
    search_.area = options.is_effective ? RIIS_AREA_EFFECTIVE : RIIS_AREA_GEOMETRIC;
  }
  Search(const Search &) = delete;
  Search &operator=(const Search &) = delete;

  const riis_valve *valve() const { return valve_; }

  // After a search for a closed valve's size, warns if the band closes the valve's gap. Without a half thickness the band is
  // unknown, so there is no warning.
  void judge_gap(const Solution &found) const {
    const bool is_size = options_.solve != "opening" && options_.solve != "scale";
    if (!is_size || !options_.has_half_thickness || opening_of(valve_) != 0) return;
    const Valve sized = copy_of(valve_);
    check(riis_valve_set_scalar(sized, options_.solve.c_str(), found.values[0]));
    warn_of_bridged_gap(options_, sized, "");
  }

  Solution solve(const Areas &wanted) const {
    Solution made;
    made.values.resize(wanted.areas.size());
    made.reached.resize(wanted.areas.size());
    const riis_status status = call(wanted.areas, &made);
    if (status == RIIS_INVALID_ARGUMENT && !options_.areas.empty()) refuse_row(wanted, riis_last_error());
    try {
      check(status, subject_of(options_));
    } catch (Refusal &refusal) {
      const bool is_of_closed =
          refusal.text.find(" does not change the ") != std::string::npos && opening_of(valve_) == 1;
      if (is_of_closed) refusal.text += "; the valve is open: --opening 0 closes it";
      throw;
    }
    return made;
  }

 private:
  riis_status call(const std::vector<double> &areas, Solution *made) const {
    return riis_find_by_area(valve_, options_.solve.c_str(), view(areas).size(), areas.data(), &search_,
                             made->values.data(), made->reached.data(), &made->range, sizeof made->range);
  }

  // Finds the first area in the file that the valve cannot reach, and refuses it. If the valve can reach all areas, refuses with
  // the library's reason.
  void refuse_row(const Areas &wanted, const std::string &reason) const {
    Solution all;
    if (call({}, &all) != RIIS_OK) throw Refusal{exit_wrong_usage, with_option_named(reason)};
    for (std::size_t i = 0; i < wanted.areas.size(); ++i)
      if (wanted.areas[i] < all.range.least || wanted.areas[i] > all.range.most)
        refuse_file(options_.areas, "the area " + shown(wanted.areas[i]) + " at time " + shown(wanted.times[i]) +
                                        " is out of reach: " + text_of_range(options_, all.range));
    refuse_file(options_.areas, reason);
  }

  const AreaOptions &options_;
  Valve valve_;
  riis_surface_options own_;
  riis_area_search search_ = defaults<riis_area_search>();
};

// Tells where the area stops growing or falling. Beyond such a turn, another opening or size can have the same area again.
void warn_of_turns(const AreaOptions &options, const riis_area_range &range) {
  if (range.n_turns == 0) return;
  std::vector<std::string> places;
  for (const double turn : range.turns)
    if (std::isfinite(turn)) places.push_back(shown(turn));
  const std::string taken = options.solve == "opening" ? "the least opening" : "the value nearest to the present one";
  warn("the " + words_of(options) + " grows in a part of the range and falls in another: it turns at " + options.solve +
       " " + joined_by(places, ", ") +
       (range.n_turns > static_cast<std::int64_t>(places.size()) ? " and further on" : "") +
       "; if there are several solutions, the command finds " + taken + ", and --from and --to lead to the others");
}

// A run warns if the relative error is above this limit. The area jumps where the adapted triangles change. Such a jump is below
// this limit, except for small areas.
constexpr double fair_error = 1e-4;

void warn_of_jumps(const Areas &wanted, const Solution &found) {
  double most = 0;
  for (std::size_t i = 0; i < wanted.areas.size(); ++i)
    if (wanted.areas[i] > 0) most = std::max(most, std::abs(found.reached[i] / wanted.areas[i] - 1));
  if (most > fair_error)
    warn("the relative error of an area is " + shown(most) +
         ", because the area jumps where the triangles change: see --triangulation fixed");
}

std::string summary_line(const std::string &label, const std::string &text) {
  return label + std::string(label.size() < 10 ? 10 - label.size() : 1, ' ') + text + "\n";
}

std::string text_of_cost(const riis_area_range &range) {
  const std::string refused = range.n_refused > 0 ? ", " + std::to_string(range.n_refused) + " of them refused" : "";
  return std::to_string(range.n_surfaces) + " surfaces in " + printed("%.2g", range.seconds) + " s" + refused;
}

std::string text_of_size(const AreaOptions &options, const riis_valve *valve, const Solution &found) {
  double opening = 0;
  check(riis_valve_get(valve, "opening", 1, &opening));
  const std::string where = options.solve == "opening" ? "" : ", at opening " + shown(opening);
  return summary_line("valve", options.valve + where) + summary_line(options.solve, exact(found.values[0])) +
         summary_line("reached", words_of(options) + " " + exact(found.reached[0])) +
         summary_line("range", text_of_range(options, found.range)) + summary_line("cost", text_of_cost(found.range));
}

// Between two keys the opening is a cubic, so its rate is a parabola. The opening therefore changes fastest at a key or at the
// parabola's vertex.
std::string text_of_rate(const OpeningLaw &law, std::vector<double> times, double period) {
  if (period > 0) times.push_back(times.front() + period);
  double fastest = 0, at = times.front();
  const auto look = [&](double time) {
    const double rate = law.rate_at(time);
    if (std::abs(rate) > fastest) fastest = std::abs(rate), at = time;
    return rate;
  };
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double length = times[i + 1] - times[i];
    const double first = look(times[i]), middle = look(times[i] + 0.5 * length), last = look(times[i + 1]);
    const double slope = 4 * middle - 3 * first - last, bend = 2 * (first - 2 * middle + last);
    const double vertex = -slope / (2 * bend);
    if (vertex > 0 && vertex < 1) look(times[i] + vertex * length);
  }
  return "fastest " + printed("%.3g", fastest) + " in a unit of time, at " + shown(at) + ", with --interpolation cubic";
}

void write_cycle(const AreaOptions &options, const Areas &wanted, const Solution &found) {
  const OpeningLaw law(OpeningTable{wanted.times, found.values, options.period, RIIS_INTERPOLATION_CUBIC},
                       options.areas);
  std::string text = "time,opening\n";
  for (std::size_t i = 0; i < wanted.times.size(); ++i)
    text += shortest(wanted.times[i]) + "," + shortest(found.values[i]) + "\n";
  write_text(options.output, text);
  if (options.quiet || options.output == "-") return;
  const auto [least, most] = std::minmax_element(found.values.begin(), found.values.end());
  write_text("-", summary_line("valve", options.valve) +
                      summary_line("cycle", counted(view(wanted.times).size(), "time") + " from " +
                                                shown(wanted.times.front()) + " to " + shown(wanted.times.back()) +
                                                ", openings from " + exact(*least) + " to " + exact(*most)) +
                      summary_line("rate", text_of_rate(law, wanted.times, options.period)) +
                      summary_line("range", text_of_range(options, found.range)) +
                      summary_line("cost", text_of_cost(found.range)) + summary_line("written", options.output));
}

}  // namespace

void run_from_area(const AreaOptions &options) {
  const OutputLocks locks = check_outputs(options);
  const Areas wanted = areas_of(options);
  const Search search(options);
  const Solution found = [&] {
    const Stage stage("searching for the " + options.solve, options.quiet);
    return search.solve(wanted);
  }();
  warn_of_turns(options, found.range);
  warn_of_jumps(wanted, found);
  search.judge_gap(found);
  if (!options.areas.empty()) return write_cycle(options, wanted, found);
  if (!options.quiet) write_text("-", text_of_size(options, search.valve(), found));
}

}  // namespace riis::program
