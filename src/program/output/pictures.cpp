// SPDX-License-Identifier: Apache-2.0
#include "program/output/pictures.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "program/base/handles.hpp"
#include "program/base/other_program.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/wall.hpp"
#include "program/mark/moving_valve.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {

namespace {

// Returns whether the valve is the aortic valve of the paper. The title of the picture then says that this valve does not close
// (docs/meshes.md).
bool is_papers_aortic_valve(const ValveOptions &options, const riis_valve *valve) {
  if (!valve || options.valve != "aortic") return false;
  // The two parameters of the open state have no effect at opening 0.
  return has_default_values(valve, {"open_radius_ratio", "commissure_expansion"});
}

// Returns the unit for the scale bar and the captions, or none if the unit is not known. Without --unit, the unit of the mesh
// follows from the scale of a valve's placement, because a valve's parameters are in centimetres. If two valves imply different
// units, the unit is not known.
std::optional<Unit> unit_of_mesh(const std::optional<Unit> &given, const std::vector<MovingValve> &valves) {
  if (given) return given;
  std::optional<Unit> told;
  for (const MovingValve &valve : valves) {
    if (!valve.options().surface.empty() || is_valve_file(valve.options().valve)) continue;
    const std::optional<Unit> reached = unit_reached(Unit::centimetre, valve.options().surface_options.scale);
    if (!reached || (told && *told != *reached)) return std::nullopt;
    told = reached;
  }
  return told;
}

void check_view(const std::string &option, std::int32_t view, std::size_t n_valves, const ValveOptions &valve) {
  if (view < RIIS_VTK_VIEW_VALVE_SIDE) return;
  const std::string name = option + " " + view_names[static_cast<std::size_t>(view)];
  const std::int32_t by_mesh = view == RIIS_VTK_VIEW_VALVE_LONG ? RIIS_VTK_VIEW_SIDE : view - RIIS_VTK_VIEW_VALVE_SIDE;
  const std::string advice = "; " + view_names[static_cast<std::size_t>(by_mesh)] + " looks by the mesh's axes";
  if (n_valves > 1)
    refuse_usage(name + ": there are " + std::to_string(n_valves) + " valves, each with axes of its own" + advice);
  if (!valve.surface.empty())
    refuse_usage(name + ": " + valve.surface + " has triangles, but no axes of a valve" + advice);
}

}  // namespace

void check_views(const MarkOptions &options, std::size_t n_valves, const ValveOptions &valve) {
  for (const Picture &picture : options.pictures) check_view("--view", picture.view, n_valves, valve);
  check_view("--movie-view", options.series.movie_view, n_valves, valve);
}

// ---- Pictures of a run ----

namespace {

// Returns a title such as "Mitral valve", or a disease such as "Mitral clip". For a file, the title is the base name.
std::string title_of_valve(const ValveOptions &options) {
  const std::string name = options.surface.empty() ? options.valve : options.surface;
  if (!options.surface.empty() || is_valve_file(options.valve)) return name.substr(name.rfind('/') + 1);
  std::string title = options.disease.empty() ? name + " valve" : options.disease;
  title[0] = static_cast<char>(title[0] - 'a' + 'A');
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

// Returns the title of a picture. The title begins with the title of the valve. Titles of reports begin with the valve's name
// instead.
std::string picture_title(const ValveOptions &options, const riis_valve *valve, const ValveReport &report) {
  std::string title = surface_title(report);
  const bool is_kind = report.opening && !is_valve_file(report.surface_name);
  title.replace(0, report.surface_name.size() + (is_kind ? std::strlen(" valve") : 0), title_of_valve(options));
  if (is_papers_aortic_valve(options, valve)) title += " (the paper's, not closed)";
  return title;
}

// Returns the largest number of decimals of the times. All times of a movie are shown with this number of decimals, so that their
// texts have equal lengths.
int decimals_of(const std::vector<double> &times) {
  constexpr std::size_t most = 6;
  std::size_t n = 0;
  for (const double time : times) {
    const std::string text = shortest(time);
    const std::size_t point = text.find('.');
    if (point != std::string::npos) n = std::max(n, text.size() - point - 1);
  }
  return static_cast<int>(std::min(n, most));
}

std::string fixed(double number, int decimals) {
  return printed(("%." + std::to_string(decimals) + "f").c_str(), number);
}

// Returns a text about the orifice, such as ", orifice 2.10 cm2". Returns "" for a surface without an outline. Slits of a closed
// valve do not count as an orifice. If the unit of the mesh is known, areas are in cm2 and the half thickness is in mm, as is
// usual for heart valves.
std::string orifice_text(const riis_surface *surface, const std::optional<Unit> &unit) {
  const auto orifice = get<riis_orifice>(riis_surface_get_orifice, surface, nullptr);
  if (orifice.outline == RIIS_OUTLINE_NONE) return "";
  const double area = has_slits(orifice) ? orifice.effective_area : orifice.area;
  const double factor = unit ? factor_between(*unit, Unit::centimetre) : 1;
  return ", orifice " + (unit ? fixed(area * factor * factor, 2) + " cm2" : printed("%.3g", area));
}

// Returns a line break and the line of a title with the half thickness. Returns "" if the valves have different half thicknesses.
std::string half_thickness_line(const std::vector<MovingValve> &valves, const std::optional<Unit> &unit) {
  const double first = info_of(valves[0].surface()).half_thickness;
  for (const MovingValve &valve : valves)
    if (info_of(valve.surface()).half_thickness != first) return "";
  const double factor = unit ? factor_between(*unit, Unit::millimetre) : 1;
  return "\nhalf thickness " + printed("%.3g", first * factor) + (unit ? " mm" : "");
}

// The marks of all valves together. A node gets the leaflet of its nearest valve.
struct JoinedMarks {
  explicit JoinedMarks(std::size_t n) : marked(n, 0.0), distance(n, RIIS_FAR_DISTANCE), leaflet(n, -1.0) {}

  void add(const riis_marks *result, int64_t first_leaflet) {
    const riis_mark_list list = list_of(result, RIIS_LIST_MARKED);
    for (int64_t i = 0; i < list.n_nodes; ++i) {
      const int64_t node = list.node_id[i];
      if (view(distance)[node] <= list.distance[i]) continue;
      view(marked)[node] = 1;
      view(distance)[node] = list.distance[i];
      view(leaflet)[node] = static_cast<double>(first_leaflet + list.leaflet_id[i]);
    }
  }

  std::vector<double> marked, distance, leaflet;
};

// Returns the names of all leaflets. A leaflet without a name gets its number.
std::vector<std::string> leaflet_texts_of(const Case &all, const std::vector<MovingValve> &valves) {
  std::vector<std::string> texts;
  for (std::size_t valve = 0; valve < valves.size(); ++valve) {
    const std::string part = all.part_of(valve), prefix = part.empty() ? "" : part + " ";
    const riis_surface_info surface = info_of(valves[valve].surface());
    for (int32_t leaflet = 0; leaflet <= surface.largest_leaflet_id; ++leaflet)
      texts.push_back(prefix + name_of_leaflet(valves[valve].options(), surface, leaflet));
  }
  return texts;
}

}  // namespace

RunPictures::RunPictures(const Case &all, MeshFile mesh, const Box &box)
    : all_(all), mesh_(std::move(mesh)), box_(box) {
  if (all.is_series()) nodes_.emplace(mesh_, all.options.mesh);
  if (!all.options.series.movie.empty())
    movie_.emplace(all.options.series.movie, all.options.series.frame_rate, all.options.style.size.has_value());
  if (!mesh_ && !all.options.wall.empty()) wall_ = wall_of(all.options);
}

bool RunPictures::are_wanted(const MarkOptions &options) {
  return !options.pictures.empty() || !options.series.movie.empty();
}

// riis_vtk draws arrays by their default names. The output's arrays may have other names, but they are in another mesh, or
// already written to a file.
void RunPictures::set_marks_of(std::vector<MovingValve> &valves) {
  if (!mesh_) return;
  if (all_.is_series())
    for (MovingValve &valve : valves) valve.mark(*nodes_, 0);
  if (valves.size() == 1) {
    check(riis_vtk_mesh_set_marks(mesh_, valves[0].result(), all_.options.far_distance, nullptr));
    return;
  }
  const std::int64_t n = valves[0].stats().n_nodes;
  JoinedMarks marks(static_cast<std::size_t>(n));
  std::int64_t first_leaflet = 0;
  for (const MovingValve &valve : valves) {
    marks.add(valve.result(), first_leaflet);
    first_leaflet += info_of(valve.surface()).largest_leaflet_id + 1;
  }
  check(riis_vtk_mesh_set_point_array(mesh_, "riis_marked", n, 1, marks.marked.data()));
  check(riis_vtk_mesh_set_point_array(mesh_, "riis_distance", n, 1, marks.distance.data()));
  check(riis_vtk_mesh_set_point_array(mesh_, "riis_leaflet", n, 1, marks.leaflet.data()));
}

std::string RunPictures::title(std::size_t step, const std::vector<MovingValve> &valves, const Report &report) const {
  const MovingValve &first = valves[0];
  const std::optional<Unit> unit = unit_of_mesh(all_.options.unit, valves);
  const std::string second_line = half_thickness_line(valves, unit);
  if (valves.size() == 1 && !all_.is_series())
    return picture_title(first.options(), first.source().valve, report.valves[0]) +
           orifice_text(first.surface(), unit) + second_line;
  const std::vector<double> &times = all_.options.series.times;
  const std::string time = times.empty() ? "" : fixed(times[step], decimals_of(times));
  if (valves.size() > 1) {
    std::string text = time.empty() ? "" : "Time " + time + ": ";
    for (std::size_t valve = 0; valve < valves.size(); ++valve)
      text += (valve > 0 ? ", " : "") + all_.part_of(valve) +
              (valves[valve].opening() ? " " + fixed(*valves[valve].opening(), 2) : "");
    return text + second_line;
  }
  const std::string text = title_of_valve(first.options()) + ", time " + time;
  return (first.opening() ? text + ", opening " + fixed(*first.opening(), 2) : text) +
         orifice_text(first.surface(), unit) + second_line;
}

// Views by the axes of the valve exist only for a single valve. The placement of the first valve gives the axes.
riis_vtk_picture_options RunPictures::how(const std::vector<MovingValve> &valves) const {
  const riis_surface_options &placement = valves[0].options().surface_options;
  riis_vtk_picture_options how;
  check(riis_vtk_picture_options_init(&how, sizeof how));
  how.leaflet_names = leaflet_names_.data();
  how.n_leaflet_names = view(leaflet_names_).size();
  const std::optional<Unit> unit = unit_of_mesh(all_.options.unit, valves);
  how.unit = unit ? name_of(*unit) : nullptr;
  std::copy_n(placement.rotation_axis, 3, how.rotation_axis);
  how.rotation_angle = placement.rotation_angle;
  how.wall = wall_;
  const PictureStyle &style = all_.options.style;
  if (style.size) {
    how.width = style.size->width;
    how.height = style.size->height;
  }
  std::copy(style.background.begin(), style.background.end(), how.background);
  how.captions = style.captions;
  how.panels = style.panels;
  how.velocity = style.velocity.empty() ? nullptr : style.velocity.c_str();
  return how;
}

void RunPictures::draw_pictures(const std::vector<MovingValve> &valves, const std::string &title,
                                const riis_surface *surface, Report &report) {
  std::vector<int32_t> views;
  std::vector<const char *> paths;
  for (const Picture &picture : all_.options.pictures) {
    views.push_back(picture.view);
    paths.push_back(picture.path.c_str());
  }
  if (paths.empty()) return;
  const Stage stage(std::string("drawing ") + paths[0] + (paths.size() > 1 ? ", ..." : ""), all_.options.quiet);
  const UnbrokenWrite unbroken;
  riis_vtk_picture_options options = how(valves);
  options.title = title.c_str();
  // Draws the leaking edges of a single valve in red. If the edges of all cells are known and none leaks, the picture says that
  // there is no leak.
  static constexpr int64_t none = 0;
  const LeakReport &leaks = report.valves[0].leaks;
  if (valves.size() == 1 && mesh_ && !all_.is_series()) {
    options.n_leaking_edges = leaks.found.n_edges;
    options.leaking_edges = leaks.edges.empty() ? nullptr : leaks.edges.data();
    if (leaks.found.n_edges == 0 && leaks.has_all_edges()) options.leaking_edges = &none;
  }
  try {
    with_display(
        [&] { return riis_vtk_draw_views(surface, mesh_, &options, view(paths).size(), views.data(), paths.data()); });
  } catch (Refusal &refusal) {
    const std::string field = "options->velocity";
    if (refusal.text.rfind(field, 0) == 0) refusal.text.replace(0, field.size(), "--picture-velocity");
    throw;
  }
  report.written.insert(report.written.end(), paths.begin(), paths.end());
  report.seconds.picture = stage.seconds();
}

// If no display can be used, makes a virtual display and tries again.
void RunPictures::with_display(const std::function<riis_status()> &draw) {
  riis_status status = draw();
  if (status == RIIS_UNAVAILABLE && !display_) {
    display_.emplace();
    status = draw();
  }
  check(status);
}

riis_vtk_film *RunPictures::film(const std::vector<MovingValve> &valves) {
  if (film_) return film_;
  riis_vtk_picture_options options = how(valves);
  options.view = all_.options.series.movie_view;
  riis_vtk_film *film = nullptr;
  with_display([&] { return riis_vtk_film_create(mesh_, box_.lower, box_.upper, &options, &film); });
  film_ = Film(film);
  return film_;
}

void RunPictures::draw(std::size_t step, std::vector<MovingValve> &valves, Report &report) {
  if (step > 0 && !movie_) return;
  if (leaflet_names_.empty()) {
    leaflet_texts_ = leaflet_texts_of(all_, valves);
    for (const std::string &text : leaflet_texts_) leaflet_names_.push_back(text.c_str());
  }
  set_marks_of(valves);
  const Surface joined = valves.size() > 1 ? joined_surface(surfaces_of(valves)) : nullptr;
  const riis_surface *surface = joined ? joined : valves[0].surface();
  const std::string text = title(step, valves, report);
  if (step == 0) draw_pictures(valves, text, surface, report);
  if (movie_) check(riis_vtk_film_draw(film(valves), surface, text.c_str(), movie_->next_frame().c_str()));
}

void RunPictures::encode(Report &report) {
  if (!movie_) return;
  const Stage stage("making " + all_.options.series.movie, all_.options.quiet);
  movie_->encode();
  report.written.push_back(all_.options.series.movie);
}

// ---- Movie ----

namespace {

[[noreturn]] void refuse_movie(const std::string &path, const std::string &reason) {
  refuse_data(path + ": the movie cannot be made: " + reason);
}

// Returns the name of a frame's file. The name contains the number of the frame, in the form that ffmpeg reads.
std::string frame_name(std::size_t number) {
  char text[32];
  std::snprintf(text, sizeof text, "frame_%06zu.png", number);
  return text;
}

// Returns the pattern by which ffmpeg finds the frames. A % in the folder's name is doubled, because a single % has a meaning in
// the pattern.
std::string frame_pattern(const std::string &folder) {
  std::string pattern;
  for (const char c : folder) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  return pattern + "/frame_%06d.png";
}

std::vector<std::string> encoding_of(const std::string &path, bool has_size) {
  if (has_ending(path, ".gif")) {
    // The movie plays in a loop, and all its frames use one palette of colours. If the user gave no size, the movie is small.
    return {"-filter_complex",
            std::string(has_size ? "" : "scale='min(800,iw)':-2:flags=lanczos,") +
                "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=bayer:bayer_scale=5",
            "-loop",
            "0",
            "-f",
            "gif"};
  }
  // Every player can play a movie in H.264 with these options.
  return {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart", "-f", "mp4"};
}

}  // namespace

void check_movie(const std::string &path) {
  if (path.empty()) return;
  if (!has_ending(path, ".mp4") && !has_ending(path, ".gif"))
    refuse_usage("--movie: " + path + " must end in .mp4 or .gif");
  if (program_on_path("ffmpeg").empty())
    refuse_data("--movie needs the program ffmpeg, which is not on the PATH; on Debian the package ffmpeg has it");
}

std::string Movie::next_frame() { return folder_.path() + "/" + frame_name(n_frames_++); }

void Movie::encode() const {
  const UnbrokenWrite unbroken;
  const std::filesystem::path place = place_of(path_);
  const std::string temporary = (folder_of(place) / (".riis-" + std::to_string(getpid()) + "-movie.tmp")).string();
  std::vector<std::string> words = {
      program_on_path("ffmpeg"),    "-nostdin", "-loglevel", "error", "-y", "-framerate", shortest(frame_rate_), "-i",
      frame_pattern(folder_.path())};
  const std::vector<std::string> encoding = encoding_of(path_, has_size_);
  words.insert(words.end(), encoding.begin(), encoding.end());
  words.push_back(temporary);
  const ProgramEnd end = run_program(words);
  if (end.error != 0) refuse_data(words[0] + ": cannot be run: " + system_text(end.error));
  if (end.status == 0 && std::rename(temporary.c_str(), place.c_str()) == 0) return;
  const int error = errno;
  std::remove(temporary.c_str());
  // If the user presses Ctrl-C, the signal also reaches ffmpeg. If Ctrl-C ended ffmpeg, its failure needs no message.
  if (UnbrokenWrite::has_signal()) return;
  if (end.status == 0) refuse_movie(path_, system_text(error));
  refuse_movie(path_, "ffmpeg ends with status " + std::to_string(end.status) + ": " + end.last_message.substr(0, 200));
}

}  // namespace riis::program
