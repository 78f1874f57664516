// SPDX-License-Identifier: Apache-2.0
#include "program/states.hpp"

#include <map>
#include <set>

#include "common/array_view.hpp"
#include "program/advice.hpp"
#include "program/crossings.hpp"
#include "program/drawing.hpp"
#include "program/handles.hpp"
#include "program/orifice.hpp"
#include "program/outputs.hpp"
#include "program/patch_sides.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"
#include "program/state_table.hpp"
#include "program/valve_file.hpp"
#include "program/valve_source.hpp"

namespace riis::program {
namespace {

// At the program's usual tolerance the triangles change the prosthesis' orifice by up to 0.3 %. At this one they change it by
// less than 0.1 %, and the aortic valve's by 0.1 %.
constexpr double fine_tolerance = 0.01;

riis_surface_options own_frame(const Options &options) {
  riis_surface_options own = options.surface_options;  // placement by scale alone, as the options go with --states
  if (!options.has_tolerance) own.tolerance = fine_tolerance;
  return own;
}

struct Disc {
  std::string parameter{};  // its name, such as root_radius
  double radius = 0;
  PlanePoint centre{};  // the mean of the translations, of the valve or of its cusps
};

bool ends_in_translation(const std::string &name) {
  const std::string ending = "translation";
  return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

// A valve with its surface.
class OpeningValve {
 public:
  explicit OpeningValve(const Options &options) : options_(options), valve_(make_valve(options)) {
    set_opening(0);
    const riis_surface_options own = own_frame(options);
    riis_surface *surface = nullptr;
    check(riis_surface_create(valve_.get(), &own, &surface), subject());
    surface_.reset(surface);
  }

  void open_to(double opening) {
    set_opening(opening);
    check(riis_surface_update(surface_.get(), valve_.get(), nullptr), subject());
  }

  std::string why_closed() { return program::why_closed(valve_.get(), own_frame(options_)); }

  // The disc of the root, or of a housing, about the axis; none if the valve has no radius.
  std::optional<Disc> disc() const {
    Disc disc;
    std::size_t n_shifts = 0;
    for (const riis_parameter &parameter : parameters()) {
      const std::string name = parameter.name;
      if (name == "root_radius" || name == "radius") {
        disc.parameter = name;
        disc.radius = values_of(parameter)[0];
      }
      if (!ends_in_translation(name)) continue;
      const Point value = values_of(parameter);
      ++n_shifts;
      for (std::size_t k = 0; k < 2; ++k) disc.centre[k] += (value[k] - disc.centre[k]) / static_cast<double>(n_shifts);
    }
    return disc.parameter.empty() ? std::nullopt : std::optional(disc);
  }

  riis_triangles arrays() const { return triangles_of(surface_.get()); }

 private:
  std::vector<riis_parameter> parameters() const {
    int64_t n = 0;
    check(riis_valve_get_n_parameters(valve_.get(), &n));
    std::vector<riis_parameter> all(static_cast<std::size_t>(n));
    for (int64_t i = 0; i < n; ++i) check(riis_valve_get_parameter(valve_.get(), i, &view(all)[i], sizeof all[0]));
    return all;
  }
  // Returns the values in the unit of the surface.
  Point values_of(const riis_parameter &parameter) const {
    Point values{};
    check(riis_valve_get(valve_.get(), parameter.name, parameter.n_values, values.data()));
    for (double &value : values) value *= options_.surface_options.scale;
    return values;
  }

  std::string subject() const { return is_valve_file(options_.valve) ? options_.valve : ""; }
  void set_opening(double opening) { check(riis_valve_set_scalar(valve_.get(), "opening", opening)); }

  const Options &options_;
  Valve valve_;
  Surface surface_;
};

std::vector<std::string> names_of_leaflets(const Options &options, const std::map<std::int32_t, LeafletSize> &sizes) {
  const std::vector<const char *> known = leaflet_names(options);
  std::vector<std::string> names;
  for (const auto &[id, size] : sizes) {
    const auto at = static_cast<std::size_t>(id);
    names.push_back(at < known.size() ? known[at] : "leaflet " + std::to_string(id));
  }
  return names;
}

// Edges that meet when the valve is closed are free if they part when it opens.
std::set<std::int32_t> free_edges_of(OpeningValve &valve, bool can_open) {
  std::set<std::int32_t> free = free_edges(sides_of_patches(valve.arrays()));
  if (!can_open) return free;
  valve.open_to(1);
  free.merge(free_edges(sides_of_patches(valve.arrays())));
  return free;
}

// Leaflets that turn keep all lengths.
bool is_rigid(const std::string &valve) { return valve == "bileaflet"; }

class Measures {
 public:
  Measures(const Options &options, OpeningValve &valve, bool can_open)
      : options_(options), valve_(valve), disc_(valve.disc()) {
    valve_.open_to(0);
    free_ = free_edges_of(valve_, can_open);
  }

  State at(double opening) {
    valve_.open_to(opening);
    const riis_triangles surface = valve_.arrays();
    const std::vector<PatchSides> patches = sides_of_patches(surface);
    State state{opening, {}, std::nullopt};
    for (const auto &[id, size] : sizes_of(surface, patches)) state.leaflets.push_back(size);
    if (const auto outline = outline_of(patches)) state.orifice = uncovered_area(*outline, projected(surface));
    return state;
  }

  // Returns the closed state's names, ids and disc, which all openings share.
  States frame() {
    valve_.open_to(0);
    const riis_triangles surface = valve_.arrays();
    const std::vector<PatchSides> patches = sides_of_patches(surface);
    const auto sizes = sizes_of(surface, patches);
    const auto outline = outline_of(patches);
    States states{{}, names_of_leaflets(options_, sizes), "", "", outline ? area_of(*outline) : 0, {}, ""};
    for (const auto &[id, size] : sizes) states.ids.push_back(id);
    for (const auto &[id, size] : sizes)
      if (size.edge == 0) states.why_no_edges = "a leaflet has no side v = 1 on its rim";
    if (is_rigid(options_.valve)) states.why_no_edges = "the leaflets are rigid";
    if (disc_) states.disc = "the disc of " + disc_->parameter + " " + shown(disc_->radius);
    if (!disc_ && outline) states.disc = "the outline of the attachment";
    return states;
  }

 private:
  std::map<std::int32_t, LeafletSize> sizes_of(const riis_triangles &surface,
                                               const std::vector<PatchSides> &patches) const {
    std::map<std::int32_t, LeafletSize> sizes;
    for (const auto &[id, area] : areas_of_leaflets(surface)) sizes[id] = {0, area};
    for (const PatchSides &patch : patches)
      if (free_.count(patch.patch_id) != 0) sizes[patch.leaflet_id].edge += line_length(patch.lines[side_v1]);
    return sizes;
  }

  std::optional<Outline> outline_of(const std::vector<PatchSides> &patches) const {
    return disc_ ? circle(disc_->radius, disc_->centre) : closed_outline(attachment(patches));
  }

  const Options &options_;
  OpeningValve &valve_;
  std::optional<Disc> disc_;
  std::set<std::int32_t> free_;
};

}  // namespace

States measure_states(const Options &options) {
  OpeningValve valve(options);
  const std::string why_closed = valve.why_closed();
  Measures measures(options, valve, why_closed.empty());
  States states = measures.frame();
  states.why_closed = why_closed;
  const std::size_t n = why_closed.empty() ? static_cast<std::size_t>(options.n_states) : 1;
  StepProgress progress("measuring the valve", n, options.quiet);
  for (std::size_t i = 0; i < n; ++i) {
    progress.begin(i);
    states.states.push_back(measures.at(n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 0));
    if (!states.states.back().orifice) states.disc.clear();
  }
  return states;
}

void run_states(const Options &options) {
  const OutputLocks locks = check_outputs(options);
  const States states = measure_states(options);
  check_shape(options, make_valve(options).get(), !options.params_open.empty());
  write_text(options.states, csv_of(states));
  if (options.quiet || options.states == "-") return;
  write_text("-", summary_of(states, options));
}

}  // namespace riis::program
