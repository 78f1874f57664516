// SPDX-License-Identifier: Apache-2.0
#include "program/drawing.hpp"

#include <algorithm>
#include <string_view>

#include "common/array_view.hpp"
#include "program/interruption.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"
#include "program/valve_file.hpp"

namespace riis::program {
namespace {

// Says whether the valve is the paper's aortic valve, which nobody should take for a closed one (docs/meshes.md).
bool is_papers_aortic_valve(const Options &options, const riis_valve *valve) {
  if (!valve || options.valve != "aortic") return false;
  int64_t n_parameters = 0;
  check(riis_valve_get_n_parameters(valve, &n_parameters));
  for (int64_t i = 0; i < n_parameters; ++i) {
    riis_parameter parameter;
    double values[3] = {0, 0, 0};
    check(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    check(riis_valve_get(valve, parameter.name, parameter.n_values, values));
    // The parameters of the open state do not matter at opening 0.
    const std::string_view name = parameter.name;
    if (name == "open_radius_ratio" || name == "commissure_expansion") continue;
    if (!std::equal(values, values + 3, parameter.default_values)) return false;
  }
  return true;
}

// Leaking edges are drawn red. A picture of a mesh without leaks says so if the edges of all cells are known.
void show_leaks(const LeakReport &leaks, riis_vtk_picture_options &how) {
  static constexpr int64_t none = 0;
  how.n_leaking_edges = leaks.found.n_edges;
  how.leaking_edges = leaks.edges.empty() ? nullptr : leaks.edges.data();
  if (how.n_leaking_edges == 0 && leaks.has_all_edges()) how.leaking_edges = &none;
}

}  // namespace

std::vector<const char *> leaflet_names(const Options &options) {
  if (!options.surface.empty()) return {};
  if (options.valve == "aortic" || options.valve == "trileaflet") return {"right", "left", "non-coronary"};
  if (options.valve == "bileaflet") return {"x > 0", "x < 0", "housing"};
  if (options.valve == "mitral") return {"anterior", "posterior"};
  return {};
}

std::string title_of_valve(const Options &options) {
  const std::string name = options.surface.empty() ? options.valve : options.surface;
  if (!options.surface.empty() || is_valve_file(options.valve)) return name.substr(name.rfind('/') + 1);
  std::string title = name + " valve";
  title[0] = static_cast<char>(title[0] - 'a' + 'A');
  return title;
}

std::string picture_title(const Options &options, const riis_valve *valve, const Report &report) {
  std::string title = surface_title(report);
  title.erase(0, report.surface_name.rfind('/') + 1);
  if (report.opening && !is_valve_file(report.surface_name)) title[0] = static_cast<char>(title[0] - 'a' + 'A');
  if (is_papers_aortic_valve(options, valve)) title += " (the paper's, not closed)";
  return title;
}

void draw_pictures(const Options &options, const std::string &title, const std::vector<const char *> &names,
                   const riis_surface *surface, const riis_vtk_mesh *mesh, const riis_marks *result, Report &report) {
  std::vector<int32_t> views;
  std::vector<const char *> paths;
  for (const Picture &picture : options.pictures) {
    views.push_back(picture.view);
    paths.push_back(picture.path.c_str());
  }
  const auto n_pictures = view(paths).size();
  if (n_pictures == 0) return;
  const Stage stage("drawing " + options.pictures[0].path + (n_pictures > 1 ? ", ..." : ""), options.quiet);
  const UnbrokenWrite unbroken;
  riis_vtk_picture_options how;
  check(riis_vtk_picture_options_init(&how, sizeof how));
  how.title = title.c_str();
  how.leaflet_names = names.data();
  how.n_leaflet_names = view(names).size();
  how.unit = options.unit ? name_of(*options.unit) : nullptr;
  if (result) show_leaks(report.leaks, how);
  check(riis_vtk_draw_views(surface, mesh, &how, n_pictures, views.data(), paths.data()));
  report.written.insert(report.written.end(), paths.begin(), paths.end());
  report.seconds.picture = stage.seconds();
}

}  // namespace riis::program
