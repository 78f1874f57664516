// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>
#include <vector>

#include "common/array_view.hpp"
#include "common/xml_text.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/commands/commands.hpp"
#include "program/input/opening_law.hpp"
#include "program/input/valve_file.hpp"
#include "program/mark/crossings.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/outputs.hpp"
#include "program/output/report.hpp"
#include "program/svmultiphysics/uris_forecast.hpp"
#include "program/svmultiphysics/uris_leaflets.hpp"

namespace riis::program {

namespace {

// The longest edge, in half thicknesses, for which the solver's sum of delta is within 1 % of the exact sum (docs/export.md).
constexpr double fine_edges = 0.15;

namespace fs = std::filesystem;

// ---- The motion ----

struct LawWithSpans {
  OpeningLaw law;
  TimeSpan opening, closing;
};

// The keys of a cycle. A cycle with a period has the keys of two periods.
class Keys {
 public:
  explicit Keys(const OpeningTable &table) : table_(table) {}
  // Returns the number of keys. With a period, counts the keys of two periods, in which every key is followed by every other key.
  std::size_t size() const { return table_.times.size() * (table_.period > 0 ? 2 : 1); }
  double time(std::size_t i) const { return table_.times[i % n()] + (i < n() ? 0 : table_.period); }
  double opening(std::size_t i) const { return table_.openings[i % n()]; }

 private:
  std::size_t n() const { return table_.times.size(); }
  const OpeningTable &table_;
};

// Finds the first key with the opening `to` that follows a key with the opening `from`. Returns the span that ends at this key.
// The span begins at the last earlier key with the opening `from`.
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

// Returns the openings of the frames in a span of time.
std::vector<double> frames_of(const OpeningLaw &law, const TimeSpan &span, double step, const char *what) {
  const double length = span.stop - span.start;
  if (step > length * (1 + 1e-9)) {
    refuse_usage("--time-step: " + shortest(step) + " is longer than the " + what + ", " + shortest(length));
  }
  // If the step divides the span, rounding could add a short step. The small subtractions prevent this.
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
  // The opening motion ends at time 0, and the closing motion starts at time 0. The start and end times of both motions are then
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

// Two neighbouring frames are one time step apart. The last frame is at the end of the span, so the last step may be shorter.
UrisMotion uris_motion_of(const ExportOptions &options) {
  const LawWithSpans motion = options.cycle.empty() ? law_of_seconds(options) : law_of_cycle(options);
  UrisMotion frames{frames_of(motion.law, motion.opening, options.time_step, "opening"),
                    frames_of(motion.law, motion.closing, options.time_step, "closing")};
  // The cycle tells whether the valve is closed or open at the beginning of the run.
  const double middle = (frames.opening.back() + frames.closing.back()) / 2;
  frames.starts_closed =
      options.starts.empty() ? options.cycle.empty() || motion.law.at(0) <= middle : options.starts == "closed";
  check_way(frames.opening, true, motion.opening);
  check_way(frames.closing, false, motion.closing);
  warn_of_jump("opening", frames.opening.back(), "closing", frames.closing.front());
  warn_of_jump("closing", frames.closing.back(), "opening", frames.opening.front());
  return frames;
}

// ---- The folder ----

std::string without_last_slashes(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

[[noreturn]] void refuse_folder(const std::string &option, const std::string &path, const std::string &reason) {
  refuse_data(option + ": " + path + ": " + reason);
}

void check_writable(const std::string &option, const std::string &path, const std::string &folder) {
  if (access(folder.c_str(), W_OK | X_OK) == 0) return;
  refuse_folder(option, path, "the folder " + folder + " cannot be written to: " + system_text(errno));
}

// Refuses a folder that WholeFolder would also refuse, but changes nothing on the disc.
void check_whole_folder(const std::string &given, const std::string &option) {
  const std::string path = without_last_slashes(given);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    const std::string parent = folder_of(path).string();
    if (!fs::is_directory(parent, error)) refuse_folder(option, path, "the folder " + parent + " does not exist");
    return check_writable(option, path, parent);
  }
  if (!fs::is_directory(status)) refuse_folder(option, path, "is a file, not a folder");
  const bool is_empty = fs::is_empty(path, error);
  if (error) refuse_folder(option, path, "cannot be read: " + error.message());
  if (!is_empty) refuse_folder(option, path, "the folder is not empty");
  check_writable(option, path, path);
}

// A folder that receives its files only after all of them are written. While files are being written, they are in a hidden folder
// inside the folder.
class WholeFolder {
 public:
  // Makes a new folder, or uses an empty folder. A Refusal names the option.
  WholeFolder(const std::string &path, const std::string &option)
      : path_(without_last_slashes(path)), unfinished_(path_ + "/.riis-" + std::to_string(getpid()) + ".tmp") {
    check_whole_folder(path_, option);
    std::error_code error;
    was_made_ = fs::create_directory(path_, error);
    if (!error) fs::create_directory(unfinished_, error);
    if (!error) return;
    if (was_made_) fs::remove(path_, error);
    refuse_folder(option, path_, "cannot be made: " + error.message());
  }
  ~WholeFolder() {
    if (is_whole_) return;
    std::error_code error;
    for (const std::string &name : names_) fs::remove(path_ + "/" + name, error);
    fs::remove_all(unfinished_, error);
    if (was_made_) fs::remove(path_, error);
  }
  WholeFolder(const WholeFolder &) = delete;
  WholeFolder &operator=(const WholeFolder &) = delete;

  // Returns the path at which the caller must write a file with this name. The name must be new.
  std::string new_file(const std::string &name) {
    names_.push_back(name);
    return unfinished_ + "/" + name;
  }
  void take_place() {
    std::error_code error;
    for (const std::string &name : names_) {
      fs::rename(unfinished_ + "/" + name, path_ + "/" + name, error);
      if (error) refuse_data(path_ + "/" + name + ": cannot be written: " + error.message());
    }
    fs::remove(unfinished_, error);
    is_whole_ = true;
  }

 private:
  std::string path_, unfinished_;
  bool was_made_ = false, is_whole_ = false;
  std::vector<std::string> names_;
};

// A file that is written in parts, because a long motion does not fit in the memory.
class TextFile {
 public:
  explicit TextFile(std::string path) : path_(std::move(path)), file_(path_) { check_written(); }

  void add(const std::string &text) {
    file_ << text;
    check_written();
  }
  void close() {
    file_.close();
    check_written();
  }

 private:
  void check_written() {
    if (file_) return;
    refuse_data(path_ + ": cannot be written: " + system_text(errno));
  }

  std::string path_;
  std::ofstream file_;
};

void append_point(const std::vector<double> &xyz, std::int64_t vertex, std::string &text) {
  char digits[32];
  for (std::int64_t k = 0; k < 3; ++k) {
    // to_chars gives the shortest text from which the same double can be read.
    text.append(digits, std::to_chars(digits, digits + sizeof digits, view(xyz)[3 * vertex + k]).ptr);
    text += k < 2 ? ' ' : '\n';
  }
}

std::string text_of_points(const std::vector<double> &xyz, const UrisLeaflet &leaflet) {
  std::string text;
  for (const std::int64_t vertex : leaflet.nodes) append_point(xyz, vertex, text);
  return text;
}

std::string vtu_text(const std::vector<double> &xyz, const UrisLeaflet &leaflet) {
  const std::string n_nodes = std::to_string(leaflet.nodes.size()), n = std::to_string(leaflet.triangles.size());
  std::string connectivity, offsets, types;
  for (std::size_t i = 0; i < leaflet.triangles.size(); ++i) {
    const Corners &c = leaflet.triangles[i];
    connectivity += std::to_string(c[0]) + ' ' + std::to_string(c[1]) + ' ' + std::to_string(c[2]) + '\n';
    offsets += std::to_string(3 * (i + 1)) + '\n';
    types += "5\n";  // VTK_TRIANGLE
  }
  const auto array = [](const std::string &head, const std::string &numbers) {
    return "<DataArray " + head + " format=\"ascii\">\n" + numbers + "</DataArray>\n";
  };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
         "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
         n_nodes + "\" NumberOfCells=\"" + n + "\">\n<Points>\n" +
         array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", text_of_points(xyz, leaflet)) +
         "</Points>\n<Cells>\n" + array("type=\"Int64\" Name=\"connectivity\"", connectivity) +
         array("type=\"Int64\" Name=\"offsets\"", offsets) + array("type=\"UInt8\" Name=\"types\"", types) +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

// Stops the export after a frame if a signal is waiting. The message of the refusal is never printed, because the signal ends the
// process after the files are removed.
void stop_if_interrupted() {
  if (UnbrokenWrite::has_signal()) refuse_data("riis export: interrupted, and nothing is left");
}

void write_frames(UrisLeaflets &leaflets, const std::vector<double> &openings, const std::string &ending,
                  WholeFolder &folder, StepProgress &progress, std::size_t &step) {
  std::vector<const UrisLeaflet *> moving;
  std::vector<TextFile> files;
  for (const UrisLeaflet &leaflet : leaflets.leaflets()) {
    moving.push_back(&leaflet);
    files.emplace_back(folder.new_file(leaflet.name + ending));
    files.back().add(std::to_string(openings.size()) + ' ' + std::to_string(leaflet.nodes.size()) + '\n');
  }
  for (const double opening : openings) {
    progress.begin(step++);
    stop_if_interrupted();
    const std::vector<double> xyz = leaflets.vertices_at(opening);
    for (std::size_t i = 0; i < files.size(); ++i) files[i].add(text_of_points(xyz, *moving[i]));
  }
  for (TextFile &file : files) file.close();
}

// Prints the estimated size of all frames. The first frame's size gives the estimate. For a small export, nothing is printed.
void announce(const ExportOptions &options, const UrisMotion &motion, const UrisLeaflets &leaflets,
              const std::vector<double> &first) {
  constexpr double least_announced = 1e7;
  double of_frame = 0;
  for (const UrisLeaflet &leaflet : leaflets.leaflets())
    of_frame += static_cast<double>(text_of_points(first, leaflet).size());
  const double n_bytes = of_frame * static_cast<double>(motion.opening.size() + motion.closing.size());
  if (options.quiet || n_bytes < least_announced) return;
  print_line("writing " + counted(2 * view(leaflets.leaflets()).size(), "file") + " with " +
             counted(leaflets.n_triangles(), "triangle") + " of leaflets in " +
             counted(static_cast<std::int64_t>(motion.opening.size() + motion.closing.size()), "frame") + ", " +
             bytes_text(n_bytes) + " in all, to " + options.folder);
}

void write_export(const ExportOptions &options, const UrisMotion &motion, UrisLeaflets &leaflets,
                  const UrisForecast &forecast) {
  const UnbrokenWrite unbroken;
  WholeFolder folder(options.folder, "FOLDER");
  StepProgress progress("writing", motion.opening.size() + motion.closing.size(), options.quiet);
  const auto write_small = [&](const std::string &name, const std::string &text) {
    write_text(folder.new_file(name), text);
  };
  const std::vector<double> first = leaflets.vertices_at(motion.opening[0]);
  for (const UrisLeaflet &leaflet : leaflets.leaflets()) write_small(leaflet.name + ".vtu", vtu_text(first, leaflet));
  announce(options, motion, leaflets, first);
  std::string normal;
  append_point({leaflets.forward().begin(), leaflets.forward().end()}, 0, normal);
  write_small("normal.dat", normal);
  if (!forecast.table.empty()) write_small("forecast.csv", forecast.table);
  std::size_t step = 0;
  write_frames(leaflets, motion.opening, "_open.dat", folder, progress, step);
  write_frames(leaflets, motion.closing, "_close.dat", folder, progress, step);
  stop_if_interrupted();
  folder.take_place();
}

// Returns the text with only the characters that are allowed in a name. A dash is replaced, because two dashes in a row would end
// the comment in the XML file.
std::string as_name(std::string text) {
  for (char &c : text) c = c != '-' && is_prefix(std::string(1, c)) ? c : '_';
  return text;
}

// Returns the name of the valve in the solver's input. The solver also uses this name for arrays and files, so two valves in one
// run need different names. The path of the folder gives the name, because the valves of a run have different folders.
std::string block_name(const ExportOptions &options) {
  if (!options.name.empty()) return options.name;
  constexpr std::size_t longest = 64;
  fs::path path = fs::path(without_last_slashes(options.folder)).lexically_normal();
  if (path == "." || path == "..") path = fs::absolute(path).lexically_normal();
  std::string name = as_name(path.string());
  name.erase(0, name.find_first_not_of("_."));
  return name.size() <= longest ? name : name.substr(name.size() - longest);
}

std::string title_of(const ExportOptions &options) {
  return is_valve_file(options.valve) ? as_name(fs::path(options.valve).stem().string()) : options.valve;
}

// Returns the line of the block about units. Two dashes in a row would end the comment in the XML file.
std::string text_of_units(const ExportOptions &options) {
  if (!options.unit) return "the units are assumed to be g, cm and s, because no unit was given";
  const std::string units = "the units are g, cm and s, so R is in g/(cm s)";
  if (options.to_solver == 1) return units;
  return units + "\n     lengths were converted from " + name_of(*options.unit) + ": in its Add_mesh, the mesh in " +
         name_of(*options.unit) + " needs Mesh_scale_factor " + shortest(options.to_solver);
}

std::string mesh_block(const ExportOptions &options, const std::string &named_folder, const UrisMotion &motion,
                       const UrisLeaflets &leaflets, const UrisForecast &forecast) {
  const std::string folder = in_xml(named_folder) + (named_folder.back() == '/' ? "" : "/");
  const auto element = [](const std::string &name, const std::string &value) {
    return "<" + name + "> " + value + " </" + name + ">\n";
  };
  const auto frames = [](const std::vector<double> &openings) {
    return std::to_string(openings.size()) + " frames, from opening " + shortest(openings.front()) + " to " +
           shortest(openings.back());
  };
  const std::string half_thickness = shortest(leaflets.half_thickness());
  const double edges = leaflets.longest_edge() / leaflets.half_thickness();
  std::string text = "<!-- riis, " + title_of(options) + " valve\n     opening: " + frames(motion.opening) +
                     "\n     closing: " + frames(motion.closing) +
                     "\n     one frame is one time step: Time_step_size must be " + shortest(options.time_step) +
                     "\n     " + counted(leaflets.n_triangles(), "triangle") + ", the longest edge " +
                     shown(leaflets.longest_edge()) + ", " + shown(edges) + " half thicknesses" +
                     "\n     the face box widens the box in which svMultiPhysics looks for nodes near the valve; "
                     "Mesh_scale_factor of this block must stay 1" +
                     "\n     " + text_of_units(options);
  if (edges > fine_edges) {
    text +=
        "\n     svMultiPhysics measures distances to the middles of triangles; for errors below 1 %, export with "
        "largest-edge " +
        shown(fine_edges * leaflets.half_thickness() / options.to_solver) +
        (options.to_solver == 1 ? "" : std::string(" in ") + name_of(*options.unit));
  }
  if (!options.cycle.empty() && options.starts.empty())
    text += std::string("\n     at time 0 of the cycle the valve is ") + (motion.starts_closed ? "closed" : "open") +
            ", or nearer to this state";
  for (const std::string &line : forecast.lines) text += "\n     " + line;
  text += " -->\n";
  text += "<Add_URIS_mesh name=\"" + block_name(options) + "\">\n";
  for (const UrisLeaflet &leaflet : leaflets.leaflets()) {
    text += "  <Add_URIS_face name=\"" + leaflet.name + "\">\n";
    text += "    " + element("Face_file_path", folder + leaflet.name + ".vtu");
    text += "    " + element("Open_motion_file_path", folder + leaflet.name + "_open.dat");
    text += "    " + element("Close_motion_file_path", folder + leaflet.name + "_close.dat");
    text += "  </Add_URIS_face>\n";
  }
  text += "  " + element("Mesh_scale_factor", "1.0");
  text += "  " + element("Thickness", half_thickness);
  text += "  " + element("Closed_thickness", half_thickness);
  text += "  " + element("Resistance", shortest(options.resistance));
  text += "  " + element("Valve_starts_as_closed", motion.starts_closed ? "true" : "false");
  text += "  " + element("Invert_normal", "false");
  text += "  " + element("Include_URIS_velocity", "true");
  text += "  " + element("Positive_flow_normal_file_path", folder + "normal.dat");
  return text + "</Add_URIS_mesh>\n";
}

}  // namespace

UrisExport write_uris(const ExportOptions &options, const std::string &named_folder) {
  if (options.surface_options.offset != 0)
    refuse_usage("--offset: svMultiPhysics interpolates distances, so it cannot use an offset");
  check_whole_folder(options.folder, "FOLDER");
  const UrisMotion motion = uris_motion_of(options);
  std::optional<Stage> stage(std::in_place, "making the leaflets of all frames", options.quiet);
  UrisLeaflets leaflets(options, motion);
  stage.reset();
  if (leaflets.n_left_out() > 0) {
    warn(counted(leaflets.n_left_out(), "triangle") +
         " left out: the area is 0 in some frames, and svMultiPhysics would divide by 0");
  }
  check_shape(options, leaflets.valve(), !options.params_open.empty());
  const UrisForecast forecast = options.mesh.empty() ? UrisForecast{} : forecast_of(options, motion, leaflets);
  write_export(options, motion, leaflets, forecast);
  return {mesh_block(options, named_folder, motion, leaflets, forecast), forecast.failure};
}

void export_uris(const ExportOptions &options) {
  const UrisExport written = write_uris(options, options.folder);
  if (!options.quiet) write_text("-", written.block);
  if (!written.failure.empty()) refuse_data(written.failure);
}

}  // namespace riis::program
