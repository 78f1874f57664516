// SPDX-License-Identifier: Apache-2.0
#include "program/output/marked_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

#include "common/array_view.hpp"
#include "common/xml_text.hpp"
#include "program/base/ranks.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {

namespace {

// Returns a number with zeros before it.
std::string padded(std::size_t number, std::size_t n_digits) {
  const std::string digits = std::to_string(number);
  return std::string(std::max(n_digits, digits.size()) - digits.size(), '0') + digits;
}

}  // namespace

SeriesFiles::SeriesFiles(const std::string &pvd, const std::string &ending, std::size_t n_times)
    : pvd_(pvd),
      ending_(ending),
      n_times_(n_times),
      n_digits_(std::max<std::size_t>(4, std::to_string(n_times - 1).size())) {
  const std::filesystem::path path(pvd);
  stem_ = path.stem().string();
  folder_ = (path.parent_path() / stem_).string();
}

void SeriesFiles::check_folder() const {
  std::error_code error;
  if (!std::filesystem::exists(folder_, error)) return;
  if (!std::filesystem::is_directory(folder_, error))
    refuse_data(folder_ + ": the folder cannot be made: a file has its name");
  if (access(folder_.c_str(), W_OK | X_OK) != 0) {
    refuse_data(folder_ + ": the folder cannot be written to: " + system_text(errno));
  }
}

void SeriesFiles::find_earlier(const std::vector<std::string> &parts, bool has_pieces) {
  if (!is_wanted()) return;
  earlier_.emplace(pvd_, [&](const StepName &name) {
    const bool is_piece = has_pieces && name.ending == ".vtu" && name.is_of_piece();
    if (!is_piece && (name.ending != ending_ || std::find(parts.begin(), parts.end(), name.part) == parts.end()))
      return StepKind::other;
    const auto step = number_in(name.digits);
    const bool is_written = step && *step < static_cast<double>(n_times_) &&
                            name.digits == padded(static_cast<std::size_t>(*step), n_digits_);
    return is_written ? StepKind::written : StepKind::further;
  });
}

void SeriesFiles::make_folder() const {
  if (!is_wanted()) return;
  check_folder();
  std::error_code error;
  std::filesystem::create_directory(folder_, error);
  if (error) refuse_data(folder_ + ": the folder cannot be made: " + error.message());
  if (earlier_) earlier_->remove();
}

std::string SeriesFiles::path_of(std::size_t step, const std::string &part) const {
  return folder_ + "/" + stem_ + "_" + (part.empty() ? "" : part + "_") + padded(step, n_digits_) + ending_;
}

void SeriesFiles::add(double time, std::size_t part_number, const std::string &path) {
  entries_.push_back({time, part_number, stem_ + "/" + std::filesystem::path(path).filename().string()});
}

void SeriesFiles::write_list() const {
  if (entries_.empty()) return;
  std::string text = list_of_riis + "  <Collection>\n";
  for (const Entry &entry : entries_) {
    text += "    <DataSet timestep=\"" + shortest(entry.time) + "\" part=\"" + std::to_string(entry.part_number) +
            "\" file=\"" + in_xml(entry.name) + "\"/>\n";
  }
  write_text(pvd_, text + "  </Collection>\n</VTKFile>\n");
}

void SeriesFiles::report(Report &report) const {
  if (!is_wanted()) return;
  const std::int64_t n_removed = earlier_ ? static_cast<std::int64_t>(earlier_->n()) : 0;
  report.written.push_back(pvd_ + ", " + counted(view(entries_).size(), "file") + " in " + folder_ +
                           (n_removed > 0 ? "; " + counted(n_removed, "file") + " of an earlier run removed" : ""));
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

// ---- Marked files ----

MarkedFiles::MarkedFiles(const Case &all, const MeshPieces &mesh)
    : path_(all.options.output),
      times_(all.times()),
      is_series_(all.is_series()),
      is_whole_(mesh.is_whole()),
      is_foam_case_(is_series_ && program::is_foam_case(path_)),
      steps_(is_foam_case_ ? "" : path_, is_whole_ ? ".vtu" : ".pvtu",
             is_series_ ? times_.size() : mesh.files().size()),
      pieces_(path_, ".vtu", is_series_ ? times_.size() : mesh.files().size()) {}

void MarkedFiles::find_earlier() {
  if (has_list()) steps_.find_earlier({""}, !is_whole_);
}

void MarkedFiles::make_folder() const {
  if (is_series_ || !is_whole_) steps_.make_folder();
}

std::string MarkedFiles::path_of(std::int64_t piece, std::size_t step) const {
  if (is_foam_case_) return foam_time(path_, times_[step]);
  if (is_whole_) return is_series_ ? steps_.path_of(step, "") : path_;
  if (!is_series_) return pieces_.path_of(static_cast<std::size_t>(piece), "");
  return pieces_.path_of(step, "p" + padded(static_cast<std::size_t>(piece), 4));
}

void MarkedFiles::write(std::int64_t piece, std::size_t step, const riis_vtk_mesh *file) {
  if (!is_wanted()) return;
  const std::string path = path_of(piece, step);
  const UnbrokenWrite unbroken;
  check(riis_vtk_mesh_write(file, path.c_str()));
  if (is_whole_) return;
  written_.push_back({static_cast<std::int64_t>(step), piece});
  std::int64_t n_nodes = 0;
  check(riis_vtk_mesh_get_nodes(file, &n_nodes, nullptr, nullptr));
  if (sample_ || n_nodes == 0) return;
  const char *const name = path.c_str();
  sample_ = create<PieceList>(riis_vtk_pieces_create, file, 1, &name);
}

void MarkedFiles::add(std::size_t step) {
  if (has_list() && is_whole_) steps_.add(times_[step], 0, steps_.path_of(step, ""));
}

void MarkedFiles::list_pieces() {
  if (!is_wanted()) return;
  std::vector<Written> written = ranks::gather(written_);
  std::sort(written.begin(), written.end());
  // The lists name the arrays of a file with nodes. The first rank that has such a file writes the lists.
  const std::vector<int> have = ranks::gather(std::vector<int>{sample_ ? 1 : 0});
  const bool is_writer = std::find(have.begin(), have.end(), 1) - have.begin() == ranks::rank();
  const UnbrokenWrite unbroken;
  for (auto next = written.begin(); next != written.end();) {
    const auto step = static_cast<std::size_t>(next->step);
    std::vector<std::string> files;
    std::vector<const char *> names;
    for (; next != written.end() && static_cast<std::size_t>(next->step) == step; ++next)
      files.push_back(path_of(next->piece, step));
    for (const std::string &file : files) names.push_back(file.c_str());
    const std::string path = is_series_ ? steps_.path_of(step, "") : path_;
    if (is_writer) {
      check(riis_vtk_pieces_set_files(sample_, view(names).size(), names.data()));
      check(riis_vtk_pieces_write(sample_, path.c_str()));
    }
    if (is_series_) steps_.add(times_[step], 0, path);
  }
  ranks::agree();
}

void MarkedFiles::write_list() const { steps_.write_list(); }

void MarkedFiles::report(Report &report) const {
  if (is_foam_case_)
    report.written.push_back(path_ + ", fields of " + counted(view(times_).size(), "time"));
  else if (is_series_)
    steps_.report(report);
  else if (is_wanted())
    report.written.push_back(path_);
}

}  // namespace riis::program
