// SPDX-License-Identifier: Apache-2.0
#include "program/mark/crossings.hpp"

#include <string>

#include "program/base/handles.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {
namespace {

constexpr int n_openings = 101;

// Finds the crossings and returns their list. The arrays of the list are destroyed when this function returns.
riis_crossing_list crossings_of(const ValveOptions &options, const riis_surface *surface) {
  auto how = defaults<riis_crossing_options>();
  how.n_threads = options.n_threads;
  const auto crossings = create<Crossings>(riis_crossings_create);
  check(riis_find_crossings(surface, &how, crossings));
  auto found = get<riis_crossing_list>(riis_crossings_get_list, crossings);
  found.triangle_id = nullptr;
  found.point = found.depth = found.length = nullptr;
  return found;
}

// Returns options that measure distances to triangles. Crossings do not depend on how distances are measured, and distances to
// triangles are the fastest to prepare.
riis_surface_options by_triangles(const ValveOptions &options, std::int32_t triangulation) {
  riis_surface_options how = options.surface_options;
  how.triangulation = triangulation;
  how.measure = RIIS_MEASURE_TRIANGLES;
  how.measure_tolerance = RIIS_AUTO;
  return how;
}

bool can_open(const ValveOptions &options, riis_valve *valve) {
  return why_closed(valve, by_triangles(options, RIIS_TRIANGULATION_ADAPTED)).empty();
}

void sweep_openings(const ValveOptions &options, riis_valve *valve, CrossingReport &report) {
  check(riis_valve_set_scalar(valve, "opening", 0));
  const riis_surface_options how = by_triangles(options, options.surface_options.triangulation);
  const auto surface = create_for<Surface>(subject_of(options), riis_surface_create, valve, &how);
  StepProgress progress("looking for crossings", n_openings, options.quiet);
  for (const double opening : openings_from_0_to_1(n_openings)) {
    progress.begin(static_cast<std::size_t>(report.n_openings));
    check(riis_valve_set_scalar(valve, "opening", opening));
    check(riis_surface_update(surface, valve, nullptr), subject_of(options));
    ++report.n_openings;
    report.opening = opening;
    report.found = crossings_of(options, surface);
    if (report.found.n_pairs > 0) return;
  }
}

// --quiet does not silence this warning. A valve whose leaflets cross cannot exist, and the normals of its leaflets contradict
// each other.
void warn_of_crossings(const ValveOptions &options, const riis_surface_info &surface, const CrossingReport &report,
                       const std::string &part, const std::string &advice) {
  const riis_crossing_list &found = report.found;
  const std::string at = report.opening ? printed(" at opening %g", *report.opening) : "";
  const bool is_one_leaflet = found.deepest_leaflet_id[0] == found.deepest_leaflet_id[1];
  const std::string first = name_of_leaflet(options, surface, found.deepest_leaflet_id[0], ""),
                    second = name_of_leaflet(options, surface, found.deepest_leaflet_id[1], "");
  const std::string who =
      is_one_leaflet ? "leaflet " + first + " crosses itself" : "leaflets " + first + " and " + second + " cross";
  // place_text rounds a position by the length of an edge. The mean length of the triangles' intersections is about an edge's
  // length.
  warn((part.empty() ? "" : part + ": ") + who + at + ": " + counted(found.n_pairs, "pair") +
       " of triangles go through each other, along a length of " + shown(found.total_length) + "; the deepest is " +
       shown(found.deepest_depth) + " deep, at " +
       place_text(options, found.deepest_point, found.total_length / static_cast<double>(found.n_pairs)) + advice);
}

}  // namespace

CrossingReport look_for_crossings(const ValveOptions &options, const riis_valve *valve, const riis_surface *surface,
                                  const std::string &part) {
  const Stage stage("looking for crossings", options.quiet);
  CrossingReport crossings;
  const Valve copy = valve ? copy_of(valve) : nullptr;
  if (copy && !sets_opening(options) && can_open(options, copy)) {
    sweep_openings(options, copy, crossings);
  } else {
    if (valve) crossings.opening = opening_of(valve);
    crossings.found = crossings_of(options, surface);
  }
  if (crossings.found.n_pairs > 0) warn_of_crossings(options, info_of(surface), crossings, part, "");
  return crossings;
}

std::optional<CrossingReport> check_shape(const ValveOptions &options, const riis_valve *valve, bool has_open_state,
                                          const std::string &part) {
  if (!is_valve_file(options.valve) && !has_open_state && has_default_values(valve, {"opening"})) return std::nullopt;
  const Valve copy = copy_of(valve);
  // Hinges reach into recesses of the housing. The model of the housing has no recesses. Crossings of leaflets with the housing
  // therefore do not count.
  if (options.valve == "bileaflet") check(riis_valve_set_scalar(copy, "ring_height", 0));
  const riis_surface_options how = by_triangles(options, RIIS_TRIANGULATION_ADAPTED);
  CrossingReport report;
  for (const double opening : {0.0, 0.5, 1.0}) {
    const Surface surface = surface_at(copy, opening, how);
    if (!surface) continue;
    ++report.n_openings;
    report.opening = opening;
    const riis_crossing_list found = crossings_of(options, surface);
    const riis_surface_info info = info_of(surface);
    if (found.deepest_depth <= info.contact_depth) continue;
    report.found = found;
    warn_of_crossings(options, info, report, part,
                      "; change the sizes, and look at all openings by riis check crossings");
    return report;
  }
  return report.n_openings > 0 ? std::optional(report) : std::nullopt;
}

}  // namespace riis::program
