// SPDX-License-Identifier: Apache-2.0
#include "program/output/marked_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <regex>
#include <set>
#include <system_error>

#include "common/array_view.hpp"
#include "common/xml_text.hpp"
#include "program/base/ranks.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {

namespace {

namespace fs = std::filesystem;

// The first line of the lists that riis writes. A file counts as written by riis only if a list with this first line names the
// file.
const std::string list_of_riis =
    "<?xml version=\"1.0\"?>\n<!-- written by riis -->\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n";

// Returns a number with leading zeros.
std::string padded(std::size_t number, std::size_t n_digits) {
  const std::string digits = std::to_string(number);
  return std::string(std::max(n_digits, digits.size()) - digits.size(), '0') + digits;
}

// The parts of the name of a step's file: STEM_PART_0012.vtu, or STEM_0012.vtu if the step has one file.
struct StepName {
  std::string part, digits, ending;
  bool is_of_piece;  // the part is the name of a piece of a mesh, such as p0012
};

// Returns the values of all attributes "file" of a list, without changes.
std::set<std::string> files_named_in(const std::string &text) {
  static const std::string begin = " file=\"";
  std::set<std::string> names;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    names.insert(text.substr(at, text.find('"', at) - at));
  }
  return names;
}

std::optional<StepName> step_name_of(const std::string &stem, const std::string &file) {
  static const std::regex form("_(?:(.*)_)?([0-9]{4,})(\\.vtu|\\.vtp|\\.pvtu)"), piece("p[0-9]{4,}");
  const std::string rest = file.rfind(stem + "_", 0) == 0 ? file.substr(stem.size()) : "";
  std::smatch found;
  if (!std::regex_match(rest, found, form)) return std::nullopt;
  return StepName{found[1], found[2], found[3], std::regex_match(found[1].str(), piece)};
}

bool is_file(const fs::path &path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// Refuses to remove files that another list names.
void check_other_lists(const fs::path &list, const std::set<std::string> &removed) {
  std::error_code error;
  for (fs::directory_iterator at(folder_of(list), error), end; !error && at != end; at.increment(error)) {
    const fs::path &other = at->path();
    if (other.extension() != ".pvd" || other.filename() == list.filename() || !is_file(other)) continue;
    for (const std::string &name : files_named_in(text_of_file(other.string())))
      if (removed.count(name) != 0)
        refuse_data(other.string() + " names " + name + ", a step of an earlier " + list.string() +
                    " that this run would remove: name another output");
  }
}

}  // namespace

void GrowingText::add(const std::string &line) {
  const std::size_t at = text_.size();
  text_ += line;
  if (path_.empty() || !can_be_replaced(path_)) return;
  if (at == n_head_) return write_text(path_, text_ + tail_);
  if (!ranks::is_first()) return;
  // One call replaces the old tail by the line and the new tail. If it fails, the old tail returns.
  const int file = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  const auto put = [&](const std::string &end) {
    ssize_t n = 1;
    std::size_t done = 0;
    for (; done < end.size() && n > 0; done += static_cast<std::size_t>(std::max<ssize_t>(n, 0)))
      n = pwrite(file, end.data() + done, end.size() - done, static_cast<off_t>(at + done));
    return done == end.size();
  };
  const bool is_written = file >= 0 && put(line + tail_);
  const int error = errno;
  if (!is_written && file >= 0 && put(tail_)) (void)!ftruncate(file, static_cast<off_t>(at + tail_.size()));
  if (file >= 0) close(file);
  if (!is_written) refuse_data(path_ + ": cannot be written: " + system_text(error));
}

void GrowingText::finish() const {
  if (!path_.empty() && !can_be_replaced(path_)) write_text(path_, text_ + tail_);
}

SeriesFiles::SeriesFiles(const std::string &pvd, const std::string &ending, std::size_t n_times)
    : pvd_(pvd),
      ending_(ending),
      n_times_(n_times),
      n_digits_(std::max<std::size_t>(4, std::to_string(n_times - 1).size())),
      list_(pvd, list_of_riis + "  <Collection>\n", "  </Collection>\n</VTKFile>\n") {
  const fs::path path(pvd);
  stem_ = path.stem().string();
  folder_ = (path.parent_path() / stem_).string();
}

void SeriesFiles::check_folder() const {
  std::error_code error;
  if (!fs::exists(folder_, error)) return;
  if (!fs::is_directory(folder_, error)) refuse_data(folder_ + ": the folder cannot be made: a file has its name");
  if (access(folder_.c_str(), W_OK | X_OK) != 0) {
    refuse_data(folder_ + ": the folder cannot be written to: " + system_text(errno));
  }
}

void SeriesFiles::find_earlier(const std::vector<std::string> &parts, bool has_pieces) {
  if (!is_wanted()) return;
  std::set<std::string> listed, removed, listed_digits;
  if (is_file(pvd_)) {
    const std::string text = text_of_file(pvd_);
    if (text.compare(0, list_of_riis.size(), list_of_riis) == 0) listed = files_named_in(text);
  }
  for (const std::string &name : listed)
    if (const auto step = step_name_of(stem_, fs::path(name).filename().string())) listed_digits.insert(step->digits);
  std::error_code error;
  for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    const std::string path = at->path().string(), name = at->path().filename().string();
    const auto step = step_name_of(stem_, name);
    if (!step) continue;
    const bool has_my_form = (has_pieces && step->ending == ".vtu" && step->is_of_piece) ||
                             (step->ending == ending_ && std::count(parts.begin(), parts.end(), step->part) > 0);
    const bool will_be_written =
        has_my_form && step->digits.size() == n_digits_ && step->digits <= padded(n_times_ - 1, n_digits_);
    if (will_be_written) continue;
    const std::string in_list = in_xml(stem_ + "/" + name);
    if (listed.count(in_list) != 0 || (step->is_of_piece && listed_digits.count(step->digits) != 0)) {
      earlier_.push_back(path);
      removed.insert(in_list);
    } else if (has_my_form) {
      refuse_data(path + " would be taken for a step of " + pvd_ +
                  ", but no list that riis wrote names it: remove it, or name another output");
    }
  }
  if (!removed.empty()) check_other_lists(pvd_, removed);
}

void SeriesFiles::make_folder() const {
  if (!is_wanted()) return;
  check_folder();
  std::error_code error;
  fs::create_directory(folder_, error);
  if (error) refuse_data(folder_ + ": the folder cannot be made: " + error.message());
  for (const std::string &path : earlier_) {
    fs::remove(path, error);
    if (error) refuse_data(path + ": a file of an earlier run cannot be removed: " + error.message());
  }
}

std::string SeriesFiles::path_of(std::size_t step, const std::string &part, const std::string &ending) const {
  return folder_ + "/" + stem_ + "_" + (part.empty() ? "" : part + "_") + padded(step, n_digits_) + ending;
}

void SeriesFiles::add(double time, std::size_t part_number, const std::string &path) {
  if (!is_wanted()) return;
  list_.add("    <DataSet timestep=\"" + shortest(time) + "\" part=\"" + std::to_string(part_number) + "\" file=\"" +
            in_xml(stem_ + "/" + fs::path(path).filename().string()) + "\"/>\n");
  ++n_listed_;
}

void SeriesFiles::report(Report &report) const {
  if (!is_wanted()) return;
  const std::int64_t n_removed = view(earlier_).size();
  report.written.push_back(pvd_ + ", " + counted(n_listed_, "file") + " in " + folder_ +
                           (n_removed > 0 ? "; " + counted(n_removed, "file") + " of an earlier run removed" : ""));
}

// ---- Marked files ----

MarkedFiles::MarkedFiles(const Case &all, const MeshPieces &mesh)
    : all_(all),
      mesh_(mesh),
      path_(all.options.output),
      is_foam_case_(all.is_series() && program::is_foam_case(path_)),
      steps_(is_foam_case_ ? "" : path_, mesh.is_whole() ? ".vtu" : ".pvtu",
             all.is_series() ? all.times().size() : mesh.files().size()) {}

void MarkedFiles::find_earlier() {
  if (has_list()) steps_.find_earlier({""}, !mesh_.is_whole());
}

void MarkedFiles::make_folder() const {
  if (all_.is_series() || !mesh_.is_whole()) steps_.make_folder();
}

std::string MarkedFiles::path_of(std::int64_t piece, std::size_t step) const {
  if (is_foam_case_) return foam_time(path_, all_.options.series.times[step]);
  if (mesh_.is_whole()) return all_.is_series() ? steps_.path_of(step, "") : path_;
  const auto number = static_cast<std::size_t>(piece);
  return all_.is_series() ? steps_.path_of(step, "p" + padded(number, 4), ".vtu") : steps_.path_of(number, "", ".vtu");
}

void MarkedFiles::write(std::int64_t piece, std::size_t step, const riis_vtk_mesh *file) {
  if (!is_wanted()) return;
  const std::string path = path_of(piece, step);
  const UnbrokenWrite unbroken;
  check(riis_vtk_mesh_write(file, path.c_str()));
  if (mesh_.is_whole()) return;
  written_.push_back({static_cast<std::int64_t>(step), piece});
  std::int64_t n_nodes = 0;
  check(riis_vtk_mesh_get_nodes(file, &n_nodes, nullptr, nullptr));
  if (sample_ || n_nodes == 0) return;
  const char *const name = path.c_str();
  sample_ = create<PieceList>(riis_vtk_pieces_create, file, 1, &name);
}

void MarkedFiles::add(std::size_t step) {
  if (has_list() && mesh_.is_whole()) steps_.add(all_.options.series.times[step], 0, steps_.path_of(step, ""));
}

void MarkedFiles::list_pieces() {
  if (!is_wanted()) return;
  auto written = ranks::gather(written_);
  std::sort(written.begin(), written.end());
  // The lists of a mesh in pieces name the arrays of a file that has nodes. The first rank that has a file with nodes writes the
  // lists.
  const std::vector<int> have = ranks::gather(std::vector<int>{sample_ ? 1 : 0});
  const bool is_writer = std::find(have.begin(), have.end(), 1) - have.begin() == ranks::rank();
  const UnbrokenWrite unbroken;
  for (auto next = written.begin(); next != written.end();) {
    const std::int64_t step = (*next)[0];
    std::vector<std::string> files;
    std::vector<const char *> names;
    for (; next != written.end() && (*next)[0] == step; ++next)
      files.push_back(path_of((*next)[1], static_cast<std::size_t>(step)));
    for (const std::string &file : files) names.push_back(file.c_str());
    const std::string path = all_.is_series() ? steps_.path_of(static_cast<std::size_t>(step), "") : path_;
    if (is_writer) {
      check(riis_vtk_pieces_set_files(sample_, view(names).size(), names.data()));
      check(riis_vtk_pieces_write(sample_, path.c_str()));
    }
    if (all_.is_series()) steps_.add(view(all_.options.series.times)[step], 0, path);
  }
  ranks::agree();
}

void MarkedFiles::report(Report &report) const {
  if (is_foam_case_)
    report.written.push_back(path_ + ", fields of " + counted(view(all_.options.series.times).size(), "time"));
  else if (all_.is_series())
    steps_.report(report);
  else if (is_wanted())
    report.written.push_back(path_);
}

}  // namespace riis::program
