// SPDX-License-Identifier: Apache-2.0
#include "program/series_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "common/xml_text.hpp"
#include "program/outputs.hpp"
#include "program/refusal.hpp"
#include "program/report.hpp"
#include "program/text.hpp"
#include "program/warnings.hpp"

namespace riis::program {

SeriesFiles::SeriesFiles(const std::string &pvd, const std::string &ending, std::size_t n_times)
    : pvd_(pvd), ending_(ending), n_digits_(std::max<std::size_t>(4, std::to_string(n_times - 1).size())) {
  const std::filesystem::path path(pvd);
  stem_ = path.stem().string();
  folder_ = (path.parent_path() / stem_).string();
}

void SeriesFiles::check_folder() const {
  std::error_code error;
  if (!std::filesystem::exists(folder_, error)) return;
  if (!std::filesystem::is_directory(folder_, error))
    throw Refusal{exit_bad_data, folder_ + ": the folder cannot be made: a file has its name"};
  if (access(folder_.c_str(), W_OK | X_OK) != 0) {
    throw Refusal{exit_bad_data,
                  folder_ + ": the folder cannot be written to: " + std::generic_category().message(errno)};
  }
}

void SeriesFiles::make_folder() const {
  check_folder();
  std::error_code error;
  std::filesystem::create_directory(folder_, error);
  if (error) throw Refusal{exit_bad_data, folder_ + ": the folder cannot be made: " + error.message()};
}

std::string SeriesFiles::path_of(std::size_t step, const std::string &part) const {
  const std::string digits = std::to_string(step);
  const std::string zeros(n_digits_ > digits.size() ? n_digits_ - digits.size() : 0, '0');
  return folder_ + "/" + stem_ + "_" + (part.empty() ? "" : part + "_") + zeros + digits + ending_;
}

void SeriesFiles::add(double time, std::size_t part_number, const std::string &path) {
  entries_.push_back({time, part_number, stem_ + "/" + std::filesystem::path(path).filename().string()});
}

void SeriesFiles::write_list() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n";
  for (const Entry &entry : entries_) {
    text += "    <DataSet timestep=\"" + shortest(entry.time) + "\" part=\"" + std::to_string(entry.part_number) +
            "\" file=\"" + in_xml(entry.name) + "\"/>\n";
  }
  write_text(pvd_, text + "  </Collection>\n</VTKFile>\n");
}

// ---- Series lists ----

SeriesLists::SeriesLists(std::function<void(bool)> write) : write_(std::move(write)), thread_([this] { follow(); }) {}

SeriesLists::~SeriesLists() { stop(); }

void SeriesLists::add(const std::function<void()> &note) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    note();
    has_news_ = true;
  }
  changed_.notify_one();
}

void SeriesLists::end() {
  stop();
  write_(true);
}

// After each writing, the thread pauses twenty times as long as the writing took. So lists take little of the run's time.
void SeriesLists::follow() {
  using Clock = std::chrono::steady_clock;
  constexpr Clock::duration longest_pause = std::chrono::milliseconds(500);
  std::unique_lock<std::mutex> lock(mutex_);
  try {
    for (;;) {
      changed_.wait(lock, [this] { return has_news_ || has_ended_; });
      if (has_ended_) return;
      has_news_ = false;
      const Clock::time_point begin = Clock::now();
      write_(false);
      const Clock::duration pause = std::min(20 * (Clock::now() - begin), longest_pause);
      if (changed_.wait_for(lock, pause, [this] { return has_ended_; })) return;
    }
  } catch (...) {
    failure_ = std::current_exception();
  }
}

void SeriesLists::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    has_ended_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

// ---- Series table ----

namespace {

std::string from_to(const std::string &least, const std::string &most) {
  return least == most ? least : least + " to " + most;
}

}  // namespace

void SeriesTable::Range::add(double value) {
  least = std::min(least, value);
  most = std::max(most, value);
}

SeriesTable::SeriesTable(const Case &all) : text_("time") {
  constexpr double far = std::numeric_limits<double>::infinity();
  for (std::size_t valve = 0; valve < all.valves.size(); ++valve) {
    const std::string part = all.part_of(valve), prefix = part.empty() ? "" : part + "_";
    const MarkOptions &options = all.valves[valve].options;
    text_ += "," + prefix + "opening," + prefix + "n_marked," + prefix + "largest_speed";
    const std::string name = part.empty() ? (options.surface.empty() ? options.valve : options.surface) : part;
    rows_.push_back({name, {far, -far}, {far, -far}, {far, -far}});
  }
  text_ += ",seconds\n";
}

void SeriesTable::add(double time, const std::vector<MovingValve> &valves, double seconds) {
  std::vector<int64_t> n_marked;
  for (const MovingValve &valve : valves) n_marked.push_back(valve.stats().n_marked);
  add(time, valves, n_marked, seconds);
}

void SeriesTable::add(double time, const std::vector<MovingValve> &valves, const std::vector<int64_t> &n_marked,
                      double seconds) {
  text_ += shortest(time);
  for (std::size_t i = 0; i < valves.size(); ++i) {
    const double opening = valves[i].opening(), speed = valves[i].largest_speed();
    text_ += "," + (valves[i].source().valve ? shortest(opening) : "") + "," + std::to_string(n_marked[i]) + "," +
             shortest(speed);
    if (valves[i].source().valve) rows_[i].opening.add(opening);
    rows_[i].n_marked.add(static_cast<double>(n_marked[i]));
    rows_[i].speed.add(speed);
  }
  text_ += "," + shortest(seconds) + "\n";
}

int64_t SeriesTable::most_marked() const {
  double most = 0;
  for (const Row &row : rows_) most = std::max(most, row.n_marked.most);
  return static_cast<int64_t>(most);
}

std::string SeriesTable::summary() const {
  std::string text;
  for (const Row &row : rows_) {
    // The line of a surface from a file shows no opening, because the surface has none.
    const bool has_opening = row.opening.least <= row.opening.most;
    text +=
        "valve     " + row.name + ": " +
        (has_opening ? "opening " + from_to(shown(row.opening.least), shown(row.opening.most)) + ", " : "") +
        from_to(grouped(static_cast<int64_t>(row.n_marked.least)), grouped(static_cast<int64_t>(row.n_marked.most))) +
        " nodes marked, largest speed " + shown(row.speed.most) + "\n";
  }
  return text;
}

}  // namespace riis::program
