// SPDX-License-Identifier: Apache-2.0
#include "contest.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>

namespace bench {
namespace {

double milliseconds_of(const Contest::Work &work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Waits for at most a second until only the calling thread runs. After a loop, OpenMP's threads spin for some milliseconds, and
// would take processors from the next contender. The calling thread does not sleep. If it did, Linux would often wake a thread of
// the next loop on the caller's processor.
void wait_for_other_threads() {
  using std::chrono::steady_clock;
  constexpr double share = 0.1;  // the share of a processor that the other threads may use
  const auto seconds_since = [](steady_clock::time_point start) {
    return std::chrono::duration<double>(steady_clock::now() - start).count();
  };
  for (const auto start = steady_clock::now(); seconds_since(start) < 1;) {
    const std::clock_t used = std::clock();
    const auto from = steady_clock::now();
    while (seconds_since(from) < 1e-3) continue;
    if (static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC < (1 + share) * seconds_since(from)) return;
  }
}

double least_of(const std::vector<double> &values) { return *std::min_element(values.begin(), values.end()); }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

}  // namespace

void Contest::add(const std::string &name, int n_turns, Work work, Work before) {
  contenders_.push_back({name, n_turns, std::move(work), std::move(before)});
}

void Contest::run() {
  int most = 0;
  for (const Contender &contender : contenders_) {
    most = std::max(most, contender.n_turns);
    contender.before();  // an untimed turn, so that memory and caches settle
    contender.work();
  }
  for (int turn = 0; turn < most; ++turn)
    for (const Contender &contender : contenders_) {
      // If a contender has few turns, its turns are spread over the whole run.
      if (turn * contender.n_turns / most == (turn + 1) * contender.n_turns / most) continue;
      wait_for_other_threads();
      contender.before();
      times_[contender.name].push_back(milliseconds_of(contender.work));
    }
  contenders_.clear();
}

double Contest::least(const std::string &name) const { return least_of(times_.at(name)); }

double Contest::ratio(const std::string &above, const std::string &below) const {
  constexpr std::size_t n_parts = 5;
  const auto least_in = [](const std::vector<double> &times, std::size_t part) {
    const auto at = [&](std::size_t i) {
      return times.begin() + static_cast<std::ptrdiff_t>(i * times.size() / n_parts);
    };
    return *std::min_element(at(part), at(part + 1));
  };
  std::vector<double> ratios;
  for (std::size_t part = 0; part < n_parts; ++part)
    ratios.push_back(least_in(times_.at(above), part) / least_in(times_.at(below), part));
  return median(ratios);
}

std::string Contest::why_left_out(const std::string &name) const {
  const auto found = left_out_.find(name);
  return found == left_out_.end() ? "" : found->second;
}

void Contest::print() const {
  std::printf("| what | least, ms | median, ms | turns |\n|---|---|---|---|\n");
  for (const auto &[name, times] : times_)
    std::printf("| %s | %.3f | %.3f | %zu |\n", name.c_str(), least_of(times), median(times), times.size());
}

nlohmann::json Contest::json() const {
  nlohmann::json all;
  for (const auto &[name, times] : times_)
    all[name] = {{"least_ms", least_of(times)}, {"median_ms", median(times)}, {"turns", times.size()}};
  return all;
}

void Bars::add(const std::string &name, double value, Wanted wanted, double bar) {
  bars_.push_back({name, value, wanted, bar});
}

void Bars::add(const Contest &contest, const RatioBar &ratio) {
  for (const char *contender : {ratio.above, ratio.below})
    if (const std::string why = contest.why_left_out(contender); !why.empty()) {
      left_out_.push_back(std::string("Left out: ") + ratio.name + " (" + why + ").");
      return;
    }
  add(ratio.name, contest.ratio(ratio.above, ratio.below), ratio.wanted, ratio.bar);
}

void Bars::print() const {
  std::printf("| bar | value | wanted | |\n|---|---|---|---|\n");
  for (const Bar &bar : bars_)
    std::printf("| %s | %.2f | %s %g | %s |\n", bar.name.c_str(), bar.value,
                bar.wanted == Wanted::at_most ? "<=" : ">=", bar.bar, bar.is_met() ? "met" : "NOT met");
  if (!left_out_.empty()) std::printf("\n");
  for (const std::string &line : left_out_) std::printf("%s\n", line.c_str());
}

nlohmann::json Bars::json() const {
  nlohmann::json all = nlohmann::json::array();
  for (const Bar &bar : bars_)
    all.push_back({{"name", bar.name},
                   {"value", bar.value},
                   {"bar", bar.bar},
                   {"kind", bar.wanted == Wanted::at_most ? "at most" : "at least"},
                   {"met", bar.is_met()}});
  return all;
}

}  // namespace bench
