// SPDX-License-Identifier: Apache-2.0
#include "program/series_pictures.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <utility>

#include "common/array_view.hpp"
#include "program/drawing.hpp"
#include "program/joined_surface.hpp"
#include "program/mesh_marking.hpp"
#include "program/numbers.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"

namespace riis::program {
namespace {

// Returns the most digits behind the point that one of the times has. So the numbers of a movie do not jump.
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
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, number);
  return text;
}

// Marks of several valves in one: a node has the leaflet of its nearest valve.
struct JoinedMarks {
  explicit JoinedMarks(std::size_t n) : marked(n, 0.0), distance(n, RIIS_FAR_DISTANCE), leaflet(n, -1.0) {}

  void add(const riis_marks *result, int32_t first_leaflet) {
    const riis_mark_list list = list_of(result, RIIS_LIST_MARKED);
    for (int64_t i = 0; i < list.n_nodes; ++i) {
      const int64_t node = list.node_id[i];
      if (view(distance)[node] <= list.distance[i]) continue;
      view(marked)[node] = 1;
      view(distance)[node] = list.distance[i];
      view(leaflet)[node] = first_leaflet + list.leaflet_id[i];
    }
  }

  std::vector<double> marked, distance, leaflet;
};

// Returns the names of all leaflets, or their numbers if a valve's leaflets have no names.
std::vector<std::string> leaflet_texts_of(const Case &all, const std::vector<MovingValve> &valves) {
  std::vector<std::string> texts;
  for (std::size_t valve = 0; valve < valves.size(); ++valve) {
    const std::vector<const char *> names = leaflet_names(valves[valve].options());
    const std::string part = all.part_of(valve), prefix = part.empty() ? "" : part + " ";
    const int32_t n = n_leaflets_of(valves[valve].surface());
    for (int32_t leaflet = 0; leaflet < n; ++leaflet) {
      const bool named = leaflet < view(names).size();
      texts.push_back(prefix + (named ? view(names)[leaflet] : "leaflet " + std::to_string(leaflet)));
    }
  }
  return texts;
}

}  // namespace

SeriesPictures::SeriesPictures(const Case &all, MeshFile mesh, const Box &box)
    : all_(all), mesh_(std::move(mesh)), nodes_(borrow_nodes(mesh_.get(), all.options.mesh)), box_(box) {
  if (!all.options.series.movie.empty()) movie_.emplace(all.options.series.movie, all.options.series.frame_rate);
}

bool SeriesPictures::are_wanted(const Options &options) {
  return !options.pictures.empty() || !options.series.movie.empty();
}

void SeriesPictures::set_marks_of(std::vector<MovingValve> &valves) {
  int64_t n = 0;
  check(riis_vtk_mesh_get_nodes(mesh_.get(), &n, nullptr, nullptr));
  JoinedMarks marks(static_cast<std::size_t>(n));
  const std::vector<int32_t> first = first_leaflets(valves);
  for (std::size_t valve = 0; valve < valves.size(); ++valve) {
    valves[valve].mark(nodes_.get(), 0);
    marks.add(valves[valve].result(), first[valve]);
  }
  check(riis_vtk_mesh_set_point_array(mesh_.get(), "riis_marked", n, 1, marks.marked.data()));
  check(riis_vtk_mesh_set_point_array(mesh_.get(), "riis_distance", n, 1, marks.distance.data()));
  check(riis_vtk_mesh_set_point_array(mesh_.get(), "riis_leaflet", n, 1, marks.leaflet.data()));
}

std::string SeriesPictures::title(std::size_t step, const std::vector<MovingValve> &valves) const {
  const std::vector<double> &times = all_.options.series.times;
  const std::string time = times.empty() ? "" : fixed(times[step], decimals_of(times));
  if (valves.size() > 1) {
    std::string text = time.empty() ? "" : "Time " + time + ": ";
    for (std::size_t valve = 0; valve < valves.size(); ++valve)
      text += (valve > 0 ? ", " : "") + all_.part_of(valve) +
              (valves[valve].source().valve ? " " + fixed(valves[valve].opening(), 2) : "");
    return text;
  }
  std::string text = title_of_valve(valves[0].options());
  if (!time.empty()) text += ", time " + time;
  return valves[0].source().valve ? text + ", opening " + fixed(valves[0].opening(), 2) : text;
}

riis_vtk_film *SeriesPictures::film() {
  if (film_) return film_.get();
  riis_vtk_picture_options how;
  check(riis_vtk_picture_options_init(&how, sizeof how));
  how.view = all_.options.series.movie_view;
  how.leaflet_names = leaflet_names_.data();
  how.n_leaflet_names = view(leaflet_names_).size();
  how.unit = all_.options.unit ? name_of(*all_.options.unit) : nullptr;
  riis_vtk_film *film = nullptr;
  check(riis_vtk_film_create(mesh_.get(), box_.lower, box_.upper, &how, &film));
  film_.reset(film);
  return film;
}

void SeriesPictures::draw(std::size_t step, std::vector<MovingValve> &valves, Report &report) {
  if (step > 0 && !movie_) return;
  if (leaflet_names_.empty()) {
    leaflet_texts_ = leaflet_texts_of(all_, valves);
    for (const std::string &text : leaflet_texts_) leaflet_names_.push_back(text.c_str());
  }
  set_marks_of(valves);
  const Surface joined = valves.size() > 1 ? joined_surface(valves) : nullptr;
  const riis_surface *surface = joined ? joined.get() : valves[0].surface();
  const std::string text = title(step, valves);
  if (step == 0) draw_pictures(all_.options, text, leaflet_names_, surface, mesh_.get(), nullptr, report);
  if (movie_) check(riis_vtk_film_draw(film(), surface, text.c_str(), movie_->next_frame().c_str()));
}

void SeriesPictures::encode(Report &report) {
  if (!movie_) return;
  const Stage stage("making " + all_.options.series.movie, all_.options.quiet);
  movie_->encode();
  report.written.push_back(all_.options.series.movie);
}

}  // namespace riis::program
