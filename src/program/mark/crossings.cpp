// SPDX-License-Identifier: Apache-2.0
#include "program/mark/crossings.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "program/base/handles.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/pictures.hpp"

namespace riis::program {
namespace {

constexpr int n_openings = 101;

// Finds the crossings and returns their list. The list's arrays are gone when this function returns.
riis_crossing_list crossings_of(const ValveOptions &options, const riis_surface *surface) {
  riis_crossing_options how;
  check(riis_crossing_options_init(&how, sizeof how));
  how.n_threads = options.n_threads;
  riis_crossings *handle = nullptr;
  check(riis_crossings_create(&handle));
  const Crossings crossings(handle);
  check(riis_find_crossings(surface, &how, handle));
  riis_crossing_list found;
  check(riis_crossings_get_list(handle, &found, sizeof found));
  found.triangle_id = nullptr;
  found.point = found.depth = found.length = nullptr;
  return found;
}

// Returns options that measure distances to triangles. Crossings do not depend on the method for distances, and this method is
// the fastest to prepare.
riis_surface_options by_triangles(const ValveOptions &options) {
  riis_surface_options how = options.surface_options;
  how.measure = RIIS_MEASURE_TRIANGLES;
  how.measure_tolerance = RIIS_AUTO;
  return how;
}

bool can_open(const ValveOptions &options, riis_valve *valve) {
  riis_surface_options how = by_triangles(options);
  how.triangulation = RIIS_TRIANGULATION_ADAPTED;
  return why_closed(valve, how).empty();
}

void sweep_openings(const ValveOptions &options, riis_valve *valve, CrossingReport &report) {
  check(riis_valve_set_scalar(valve, "opening", 0));
  const std::string subject = is_valve_file(options.valve) ? options.valve : "";
  const riis_surface_options how = by_triangles(options);
  riis_surface *handle = nullptr;
  check(riis_surface_create(valve, &how, &handle), subject);
  const Surface surface(handle);
  StepProgress progress("looking for crossings", n_openings, options.quiet);
  for (int i = 0; i < n_openings; ++i) {
    progress.begin(static_cast<std::size_t>(i));
    const double opening = static_cast<double>(i) / (n_openings - 1);
    check(riis_valve_set_scalar(valve, "opening", opening));
    check(riis_surface_update(surface.get(), valve, nullptr), subject);
    report.n_openings = i + 1;
    report.opening = opening;
    report.found = crossings_of(options, surface.get());
    if (report.found.n_pairs > 0) return;
  }
}

std::string leaflet_text(const ValveOptions &options, int32_t leaflet) {
  const std::vector<std::string> names = leaflet_names(options);
  const auto at = static_cast<std::size_t>(leaflet);
  return at < names.size() ? names[at] : std::to_string(leaflet);
}

// --quiet does not silence this warning, because such a valve cannot be built, and its normals contradict each other.
void warn_of_crossings(const ValveOptions &options, const CrossingReport &report, const std::string &part,
                       const std::string &advice) {
  const riis_crossing_list &found = report.found;
  std::string at;
  if (report.opening) {
    char text[32];
    std::snprintf(text, sizeof text, " at opening %g", *report.opening);
    at = text;
  }
  const bool is_one_leaflet = found.deepest_leaflet_id[0] == found.deepest_leaflet_id[1];
  const std::string first = leaflet_text(options, found.deepest_leaflet_id[0]);
  const std::string who =
      is_one_leaflet ? "leaflet " + first + " crosses itself"
                     : "leaflets " + first + " and " + leaflet_text(options, found.deepest_leaflet_id[1]) + " cross";
  // place_text rounds by an edge's length. The mean length of a pair's intersection serves, because it is about that of an edge.
  warn((part.empty() ? "" : part + ": ") + who + at + ": " + counted(found.n_pairs, "pair") +
       " of triangles go through each other, along a length of " + shown(found.total_length) + "; the deepest is " +
       shown(found.deepest_depth) + " deep, at " +
       place_text(options, found.deepest_point, found.total_length / static_cast<double>(found.n_pairs)) + advice);
}

bool has_default_values(const riis_valve *valve) {
  int64_t n = 0;
  check(riis_valve_get_n_parameters(valve, &n));
  for (int64_t i = 0; i < n; ++i) {
    riis_parameter parameter;
    double values[3];
    check(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    check(riis_valve_get(valve, parameter.name, parameter.n_values, values));
    if (std::string(parameter.name) != "opening" &&
        !std::equal(values, values + parameter.n_values, parameter.default_values))
      return false;
  }
  return true;
}

// Returns the depth up to which triangles of leaflets may cross although the leaflets only touch (docs/theory/crossings.md).
double depth_of_contacts(const ValveOptions &options, const riis_surface *surface) {
  riis_surface_info info;
  check(riis_surface_get_info(surface, &info, sizeof info));
  const bool has_cusps = options.valve == "aortic" || options.valve == "coapting" || options.valve == "trileaflet";
  return has_cusps ? 1e-3 * info.half_thickness : 2 * info.error_bound;
}

// Returns the surface at an opening, or null if the valve cannot have that opening. An impossible opening is no error here,
// because the user did not request it.
Surface surface_at(riis_valve *valve, double opening, const riis_surface_options &how) {
  check(riis_valve_set_scalar(valve, "opening", opening));
  riis_surface *surface = nullptr;
  const riis_status status = riis_surface_create(valve, &how, &surface);
  if (status != RIIS_INVALID_PARAMETER && status != RIIS_LIMIT_EXCEEDED) check(status);
  return Surface(surface);
}

}  // namespace

CrossingReport look_for_crossings(const ValveOptions &options, const riis_valve *valve, const riis_surface *surface,
                                  const std::string &part) {
  const Stage stage("looking for crossings", options.quiet);
  CrossingReport crossings;
  const Valve copy = valve ? copy_of(valve) : nullptr;
  if (copy && !sets_opening(options) && can_open(options, copy.get())) {
    sweep_openings(options, copy.get(), crossings);
  } else {
    if (valve) crossings.opening = opening_of(valve);
    crossings.found = crossings_of(options, surface);
  }
  if (crossings.found.n_pairs > 0) warn_of_crossings(options, crossings, part, "");
  return crossings;
}

std::optional<CrossingReport> check_shape(const ValveOptions &options, const riis_valve *valve, bool has_open_state,
                                          const std::string &part) {
  if (!is_valve_file(options.valve) && !has_open_state && has_default_values(valve)) return std::nullopt;
  const Valve copy = copy_of(valve);
  // Hinges reach into recesses of the housing, and the model of the housing lacks these recesses. So crossings with the housing
  // do not count.
  if (options.valve == "bileaflet") check(riis_valve_set_scalar(copy.get(), "ring_height", 0));
  riis_surface_options how = by_triangles(options);
  how.triangulation = RIIS_TRIANGULATION_ADAPTED;
  CrossingReport report;
  for (const double opening : {0.0, 0.5, 1.0}) {
    const Surface surface = surface_at(copy.get(), opening, how);
    if (!surface) continue;
    ++report.n_openings;
    report.opening = opening;
    const riis_crossing_list found = crossings_of(options, surface.get());
    if (found.deepest_depth <= depth_of_contacts(options, surface.get())) continue;
    report.found = found;
    warn_of_crossings(options, report, part, "; change the sizes, and look at all openings by riis check crossings");
    return report;
  }
  return report.n_openings > 0 ? std::optional(report) : std::nullopt;
}

}  // namespace riis::program
