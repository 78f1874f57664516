// SPDX-License-Identifier: Apache-2.0
#include "program/svmultiphysics/uris_export.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/opening_law.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {
namespace {

struct LawWithSpans {
  OpeningLaw law;
  TimeSpan opening, closing;
};

// The keys of a cycle. If the cycle has a period, the keys of two periods.
class Keys {
 public:
  explicit Keys(const OpeningTable &table) : table_(table) {}
  // Returns the number of keys, in two periods if there is a period. Two periods contain a span from any key to any other key.
  std::size_t size() const { return table_.times.size() * (table_.period > 0 ? 2 : 1); }
  double time(std::size_t i) const { return table_.times[i % n()] + (i < n() ? 0 : table_.period); }
  double opening(std::size_t i) const { return table_.openings[i % n()]; }

 private:
  std::size_t n() const { return table_.times.size(); }
  const OpeningTable &table_;
};

// Returns the first span from a key with the opening `from` to the next key with the opening `to`. The span starts at the last
// key with `from` before that key.
std::optional<TimeSpan> way_between(const Keys &keys, double from, double to) {
  std::optional<double> start;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys.opening(i) == from) start = keys.time(i);
    if (keys.opening(i) == to && start) return TimeSpan{*start, keys.time(i)};
  }
  return std::nullopt;
}

LawWithSpans law_of_cycle(const ExportOptions &options) {
  const OpeningTable table = read_cycle(options.cycle, options.period, options.interpolation);
  const OpeningLaw law(table, options.cycle);
  if (options.opening_span && options.closing_span) return {law, *options.opening_span, *options.closing_span};
  const auto [least, largest] = std::minmax_element(table.openings.begin(), table.openings.end());
  if (*least == *largest) refuse_data(options.cycle + ": the opening is " + shortest(*least) + " throughout");
  const Keys keys(table);
  const auto opening = options.opening_span ? options.opening_span : way_between(keys, *least, *largest);
  const auto closing = options.closing_span ? options.closing_span : way_between(keys, *largest, *least);
  const auto refuse = [&](const char *verb, const char *keys_that_lack, const char *option) {
    refuse_data(options.cycle + ": the valve does not " + verb + " there: no key of its " + keys_that_lack +
                "; --period or " + option + " may say more");
  };
  if (!opening) refuse("open", "largest opening follows one of the least", "--opening-span");
  if (!closing) refuse("close", "least opening follows one of the largest", "--closing-span");
  return {law, *opening, *closing};
}

// Returns the openings of the frames in a span.
std::vector<double> frames_of(const OpeningLaw &law, const TimeSpan &span, double step, const char *what) {
  const double length = span.stop - span.start;
  if (step > length * (1 + 1e-9)) {
    refuse_usage("--time-step: " + shortest(step) + " is longer than the " + what + ", " + shortest(length));
  }
  // If the step divides the span, the small subtractions keep rounding from adding a short step.
  const double n_steps = std::max(1.0, std::ceil(length / step * (1 - 1e-12) - 1e-9));
  if (n_steps >= static_cast<double>(most_times)) {
    refuse_usage("--time-step: " + shortest(step) + " makes " + shortest(n_steps + 1) + " frames of the " + what +
                 "; at most " + std::to_string(most_times) + " are written");
  }
  std::vector<double> openings;
  for (double i = 0; i < n_steps; ++i) openings.push_back(law.at(span.start + i * step));
  openings.push_back(law.at(span.stop));
  return openings;
}

LawWithSpans law_of_seconds(const ExportOptions &options) {
  auto times = defaults<riis_opening_times>();
  // The opening ends at time 0, and the closing starts at time 0. With this choice, the times of both ends of both ramps are
  // exact.
  times.opening_start = -*options.opening_duration;
  times.opening_duration = *options.opening_duration;
  times.closing_start = 0;
  times.closing_duration = *options.closing_duration;
  return {OpeningLaw(times, "--opening-seconds"), {times.opening_start, 0}, {0, times.closing_duration}};
}

void check_way(const std::vector<double> &openings, bool opens, const TimeSpan &span) {
  const double first = openings.front(), last = openings.back();
  if (opens ? last > first : last < first) return;
  refuse_usage(std::string(opens ? "--opening-span: " : "--closing-span: ") + shortest(span.start) + ":" +
               shortest(span.stop) + " takes the valve from opening " + shortest(first) + " to " + shortest(last));
}

void warn_of_jump(const char *from, double before, const char *to, double after) {
  if (std::abs(after - before) <= 1e-9) return;
  warn(std::string("the leaflets will jump: the ") + from + " ends at opening " + shortest(before) + ", the " + to +
       " begins at " + shortest(after));
}

}  // namespace

UrisMotion uris_motion_of(const ExportOptions &options) {
  const LawWithSpans motion = options.cycle.empty() ? law_of_seconds(options) : law_of_cycle(options);
  UrisMotion frames{frames_of(motion.law, motion.opening, options.time_step, "opening"),
                    frames_of(motion.law, motion.closing, options.time_step, "closing")};
  // A cycle tells the state at the beginning of the run.
  const double middle = (frames.opening.back() + frames.closing.back()) / 2;
  frames.starts_closed =
      options.starts.empty() ? options.cycle.empty() || motion.law.at(0) <= middle : options.starts == "closed";
  check_way(frames.opening, true, motion.opening);
  check_way(frames.closing, false, motion.closing);
  warn_of_jump("opening", frames.opening.back(), "closing", frames.closing.front());
  warn_of_jump("closing", frames.closing.back(), "opening", frames.opening.front());
  return frames;
}

}  // namespace riis::program
