// SPDX-License-Identifier: Apache-2.0
#include "program/output/report.hpp"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "common/array_view.hpp"
#include "common/vectors.hpp"
#include "program/base/options.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_file.hpp"
#include "program/mark/leaks.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {

std::string bytes_text(double n) {
  const char *const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  for (; n >= 1000 && unit < 5; ++unit) n /= 1000;
  return printed(unit == 0 ? "%.0f " : "%.3g ", n) + units[unit];
}

bool has_slits(const riis_orifice &orifice) {
  // An orifice counts as slits if a circle with a hundredth of its area has a longer perimeter.
  const bool has_no_rim = orifice.perimeter * orifice.perimeter < 4 * pi * 0.01 * orifice.area;
  return has_no_rim && orifice.area > 1e-3 * orifice.outline_area && orifice.effective_area < 0.5 * orifice.area;
}

std::string grouped(int64_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, ",");
  return digits;
}

std::string counted(int64_t n, const char *singular) { return grouped(n) + " " + singular + (n == 1 ? "" : "s"); }

std::string surface_title(const ValveReport &valve) {
  std::string title = valve.surface_name;
  if (valve.opening) title += (is_valve_file(title) ? "" : " valve") + printed(", opening %g", *valve.opening);
  return valve.time ? title + printed(", time %g", *valve.time) : title;
}

std::string why_unknown(const LeakReport &leaks, const std::string &mesh) {
  if (leaks.has_all_edges()) return "";
  if (leaks.n_volume_cells == 0) return mesh + " has no volume cells";
  return "riis does not know the edges of " + grouped(leaks.n_cells_left_out) + " of " +
         counted(leaks.n_volume_cells, "volume cell") + " in " + mesh;
}

namespace {

using Json = nlohmann::ordered_json;

// Returns the beginning of a line in the table. The valve's name, `name`, may be "". The opening is left out if it is also the
// opening of the marks.
std::string line(std::string label, std::string name = "", const std::optional<double> &opening = std::nullopt) {
  if (opening) name += (name.empty() ? "" : ", ") + printed("opening %g", *opening);
  label.resize(10, ' ');
  return "\n" + label + name + (name.empty() ? "" : ": ");
}

// One valve's parts of the table, and its keys in JSON. In the table of several valves, each part has the lines of all valves.
struct Page {
  std::ostringstream surface, marks, search, outside, leaks, flow, crossings;
  Json json;
};

// Returns the value for JSON, or null if there is no value.
Json if_known(bool is_known, const Json &value) { return is_known ? value : Json(); }

void add_surface(const ValveReport &valve, Page &page) {
  const riis_surface_info &surface = valve.surface;
  std::ostream &out = page.surface << line("surface", valve.name);
  out << surface_title(valve) << ": " << counted(surface.n_triangles, "triangle");
  if (valve.n_leaflets > 0) out << ", " << counted(valve.n_leaflets, "leaflet");
  out << ", area " << surface.area;
  // Triangles without area are mentioned only for a surface from a file, which should have no such triangles. A valve has
  // triangles without area at every side of a patch that collapses to a point.
  if (!valve.opening && surface.n_zero_area > 0)
    out << ", " << grouped(surface.n_zero_area) << " without area left out";
  page.json.update({{"n_triangles", surface.n_triangles},
                    {"n_zero_area", surface.n_zero_area},
                    {"area", surface.area},
                    {"half_thickness", surface.half_thickness}});
}

void add_skirt(const ValveReport &valve, Page &page) {
  if (const auto &attached = valve.attached) {
    page.surface << line("skirt", valve.name) << "from " << counted(attached->n_edges, "open edge") << " of the length "
                 << shown(attached->length) << " in all, around " << numbers_text(attached->middle, 3, " ", shown);
    page.json["attached"] = {
        {"n_edges", attached->n_edges}, {"length", attached->length}, {"middle", attached->middle}};
  }
  if (const auto &gap = valve.gap) {
    page.surface << line("skirt", valve.name) << "to the wall, " << gap->least << " to " << gap->most << " away, "
                 << gap->mean << " on average";
    page.json["gap"] = {{"least", gap->least},   {"mean", gap->mean},
                        {"most", gap->most},     {"widest_point", gap->widest_point},
                        {"n_ends", gap->n_ends}, {"n_without_wall", gap->n_without_wall}};
  }
}

std::string from_to(const std::string &least, const std::string &most) {
  return least == most ? least : least + " to " + most;
}

// Adds the line of a series, with openings, marked nodes and speed.
void add_times(const ValveReport &valve, std::ostream &out) {
  TimeReport least = valve.times.front(), most = least;
  for (const TimeReport &time : valve.times) {
    least.opening = std::min(least.opening, time.opening);
    most.opening = std::max(most.opening, time.opening);
    least.n_marked = std::min(least.n_marked, time.n_marked);
    most.n_marked = std::max(most.n_marked, time.n_marked);
    most.largest_speed = std::max(most.largest_speed, time.largest_speed);
  }
  out << line("valve", valve.name.empty() ? valve.surface_name : valve.name);
  if (least.opening) out << "opening " << from_to(shown(*least.opening), shown(*most.opening)) << ", ";
  out << from_to(grouped(least.n_marked), grouped(most.n_marked)) << " nodes marked, largest speed "
      << shown(most.largest_speed);
}

void add_marks(const Report &report, const ValveReport &valve, Page &page) {
  const riis_mark_stats &marks = valve.marks;
  const double half_thickness = valve.surface.half_thickness;
  if (report.is_series()) {
    add_times(valve, page.marks);
  } else {
    std::ostream &out = page.marks << line("marked", valve.name);
    out << counted(marks.n_marked, "node") << " within the half thickness " << half_thickness;
    if (valve.distance_limit() > half_thickness)
      out << ", " << grouped(marks.n_within_limit) << " within " << valve.distance_limit();
  }
  page.json.update({{"n_nodes", marks.n_nodes},
                    {"n_cells", report.n_cells},
                    {"n_marked", marks.n_marked},
                    {"n_within_limit", marks.n_within_limit}});
}

void add_search(const ValveReport &valve, Page &page) {
  const riis_mark_stats &marks = valve.marks;
  const std::int32_t measure = valve.options->surface_options.measure;
  const std::string &distance = view(distance_names)[measure], &search = view(search_names)[marks.search];
  std::ostream &out = page.search << line("search", valve.name) << search << ", " << counted(marks.n_threads, "thread");
  if (measure != RIIS_MEASURE_TRIANGLES) out << ", distances by " << distance;
  if (marks.n_unreached > 0) out << ", " << counted(marks.n_unreached, "node") << " not reached from a neighbour";
  if (!marks.complete)
    page.search << line("complete", valve.name)
                << "unknown, because this search misses nodes that are not connected to its start node";
  page.json.update({{"distance_limit", valve.distance_limit()},
                    {"search", search},
                    {"distance", distance},
                    {"threads", marks.n_threads},
                    {"complete", marks.complete != 0},
                    {"n_unreached", marks.n_unreached}});
}

void add_leaks(const ValveReport &valve, Page &page) {
  const LeakReport &leaks = valve.leaks;
  const riis_leak_list &found = leaks.found;
  const std::string unknown = why_unknown(leaks, "the mesh");
  const bool is_known = found.n_edges > 0 || (unknown.empty() && valve.marks.n_marked > 0);
  std::ostream &out = page.leaks << line("leaks", valve.name);
  if (found.n_edges > 0)
    out << counted(found.n_edges, "edge") << " between unmarked nodes across the surface, length up to "
        << found.longest_length << (unknown.empty() ? "" : "; more are unknown: ") << unknown;
  else if (is_known)
    out << "none: no mesh edge between two unmarked nodes crosses the surface";
  else
    out << "unknown: " << (unknown.empty() ? "no node is marked" : unknown);
  page.json.update(
      {{"n_leaking_edges", if_known(is_known, found.n_edges)},
       {"longest_leaking_edge", if_known(is_known, found.longest_length)},
       {"longest_leaking_edge_middle", if_known(is_known, found.longest_middle)},
       {"closing_half_thickness", if_known(leaks.closing.half_thickness > 0, leaks.closing.half_thickness)},
       {"n_volume_cells", leaks.n_volume_cells},
       {"n_cells_without_known_edges", leaks.n_cells_left_out}});
}

void add_outside(const ValveReport &valve, Page &page) {
  constexpr double least_said = 0.0005;
  Json &json = page.json["outside"];
  if (!valve.outside) return;
  const OutsideReport &outside = *valve.outside;
  if (outside.share >= least_said)
    page.outside << line("outside", valve.name, outside.opening) << outside_text(outside)
                 << " is farther than the half thickness outside the mesh";
  json = {{"share", outside.share}, {"leaflets", Json::array()}};
  if (outside.opening) json["opening"] = *outside.opening;
  for (const OutsideReport::Leaflet &leaflet : outside.leaflets)
    json["leaflets"].push_back({{"name", leaflet.name}, {"share", leaflet.share}});
}

// Adds R and the units of R and K.
void add_resistance(const MarkOptions &of_run, const ValveReport &valve, Page &page) {
  const MarkOptions &own = *valve.options;
  if (!own.given_resistance) return;
  const double R = own.given_resistance->number;
  const bool has_K = !of_run.output.empty();
  // The name of OpenFOAM's field has no "riis_" at its beginning.
  const std::string K_name = own.density && of_run.prefix == "riis" ? "K" : of_run.prefix + "_K";
  std::ostream &out = page.marks << line("R", valve.name) << R << (own.unit ? std::string(" ") + a_resistance.si : "");
  if (!own.unit)
    out << (has_K ? " and " + K_name : "") << " in the units of the mesh, whose unit of length is not known";
  else if (has_K)
    out << "; " << K_name << " is in " << own.K_unit;
  page.json["resistance"] = R;
  page.json["resistance_unit"] = if_known(own.unit.has_value(), a_resistance.si);
  if (!has_K) return;
  page.json["K_unit"] = if_known(!own.K_unit.empty(), own.K_unit);
  if (!own.density) return;
  page.json["density"] = own.density->number;
  out << ", for the density " << own.density->number << (own.unit ? " kg/m3" : "");
}

void add_first_passage(const ValveReport &valve, Page &page) {
  static const char *const states[] = {"found", "always", "never", "none"};
  if (!valve.flow.first) return;
  const riis_first_passage &first = *valve.flow.first;
  std::ostream &out = page.flow << line("opens", valve.name);
  if (first.state == RIIS_FIRST_PASSAGE_FOUND)
    out << "for the mesh at opening " << first.opening << ", closed at " << first.closed_opening;
  else if (first.state == RIIS_FIRST_PASSAGE_ALWAYS)
    out << "always: even the closed valve leaves a passage open";
  else
    out << (first.state == RIIS_FIRST_PASSAGE_NEVER ? "never: no opening that was tried leaves a passage open"
                                                    : "unknown, because the mesh itself does not connect the points");
  page.json["first_passage"] = {
      {"state", view(states)[first.state]}, {"opening", first.opening},   {"closed_opening", first.closed_opening},
      {"node_id", first.node_id},           {"distance", first.distance}, {"point", first.point},
      {"n_openings", first.n_openings}};
}

// Adds the leak of an ideal closed valve, in all and per unit of pressure.
void add_ideal_leak(const ValveReport &valve, Page &page) {
  const FlowReport &flow = valve.flow;
  if (flow.closed_area) page.json["closed_area"] = *flow.closed_area;
  if (!flow.leak_per_drop) return;
  page.json["leak_per_drop"] = *flow.leak_per_drop;
  if (!valve.options->given_drop) return;
  const std::optional<Unit> &unit = valve.options->unit;
  const std::string leak_unit = unit ? unit_text(a_flow, *unit) : "", drop_unit = unit ? a_pressure.si : "";
  const char *const blank = unit ? " " : "";
  const double drop = valve.options->given_drop->number, leak = *flow.leak_per_drop * drop;
  std::ostream &out = page.flow << line("leak", valve.name) << leak << blank << leak_unit << " at the drop " << drop
                                << blank << drop_unit << ", through an ideal closed valve";
  if (flow.closed_area) out << " of the area " << *flow.closed_area;
  page.json["leak"] = leak;
  page.json["leak_unit"] = if_known(unit.has_value(), leak_unit);
  page.json["drop_unit"] = if_known(unit.has_value(), drop_unit);
}

// Adds the measures that matter for a flow. A measure that is not set has no line.
void add_flow(const ValveReport &valve, Page &page) {
  static const char *const outlines[] = {"none", "disc", "attachment", "boundary"};
  const FlowReport &flow = valve.flow;
  if (flow.cells && flow.cells->n_edges > 0)
    page.flow << line("across", valve.name) << flow.cells->mean << " mesh edges of mean length in the band, "
              << flow.cells->least << " to " << flow.cells->most << " by " << counted(flow.cells->n_edges, "edge");
  if (const auto &orifice = flow.orifice) {
    page.flow << line("orifice", valve.name, flow.orifice_opening) << orifice->area << " open, "
              << orifice->effective_area << " effective: the band takes " << orifice->rim_reach
              << " half thicknesses along a perimeter of " << orifice->perimeter
              << (has_slits(*orifice) ? slits_text : "")
              << (orifice->outline == RIIS_OUTLINE_BOUNDARY ? "; the outline consists of the open edges" : "");
    page.json["orifice"] = {{"outline", view(outlines)[orifice->outline]}, {"area", orifice->area},
                            {"outline_area", orifice->outline_area},       {"perimeter", orifice->perimeter},
                            {"effective_area", orifice->effective_area},   {"rim_reach", orifice->rim_reach}};
  }
  if (const auto &cells = flow.cells)
    page.json["cells_across"] = {{"least", cells->least},
                                 {"mean", cells->mean},
                                 {"most", cells->most},
                                 {"mean_edge", cells->mean_edge},
                                 {"n_edges", cells->n_edges}};
  if (flow.n_open_regions) page.json["n_open_regions"] = *flow.n_open_regions;
  add_first_passage(valve, page);
  add_ideal_leak(valve, page);
}

void add_crossings(const ValveReport &valve, Page &page) {
  if (!valve.crossings) return;
  const CrossingReport &report = *valve.crossings;
  const riis_crossing_list &found = report.found;
  std::ostream &out = page.crossings << line("crossing", valve.name);
  if (found.n_pairs == 0) {
    out << "none: no triangles go through each other";
    if (report.n_openings > 0) out << " at " << counted(report.n_openings, "opening") << " from 0 to 1";
  } else {
    out << counted(found.n_pairs, "pair") << " of triangles go through each other";
    if (report.opening) out << " at opening " << *report.opening;
    out << ", along a length of " << found.total_length << ", up to " << found.deepest_depth << " deep";
  }
  Json &json = page.json["crossings"];
  json = {{"n_openings", report.n_openings}, {"n_pairs", found.n_pairs},     {"length", found.total_length},
          {"depth", found.deepest_depth},    {"point", found.deepest_point}, {"leaflets", found.deepest_leaflet_id}};
  if (report.opening) json["opening"] = *report.opening;
}

Json json_of_passage(const PassageReport &passage) {
  const riis_passage &found = passage.found;
  const char *const state = found.state == RIIS_PASSAGE_OPEN     ? "open"
                            : found.state == RIIS_PASSAGE_CLOSED ? "closed"
                                                                 : "none";
  return {{"state", passage.is_unknown ? "unknown" : state},
          {"node_id", found.node_id},
          {"distance", found.distance},
          {"point", found.point},
          {"closing_half_thickness", if_known(passage.closing.half_thickness > 0, passage.closing.half_thickness)}};
}

void add_passage(const PassageReport &passage, std::ostream &out) {
  const riis_passage &found = passage.found;
  out << line("passage") << (passage.is_unknown ? "unknown; along the known edges " : "");
  if (found.state == RIIS_PASSAGE_NONE)
    out << "none, because the mesh itself does not connect the two points";
  else
    out << (found.state == RIIS_PASSAGE_OPEN ? "open" : "closed") << ": at " << passage.place << ", " << found.distance
        << " from the surface" << (passage.is_end ? ", an end" : "");
}

std::vector<std::pair<const char *, double>> stages_of(const Seconds &s) {
  return {{"read", s.read},   {"surface", s.surface},     {"scene", s.scene},
          {"mesh", s.mesh},   {"adjacency", s.adjacency}, {"search", s.search},
          {"leaks", s.leaks}, {"write", s.write},         {"picture", s.picture}};
}

Json json_of_seconds(const Seconds &seconds) {
  Json json;
  for (const auto &[stage, taken] : stages_of(seconds)) json[stage] = taken;
  return json;
}

// For a single valve, the keys of the run are added.
void add_valve(const Report &report, const ValveReport &valve, Page &page) {
  const bool is_only = report.valves.size() == 1;
  Json &json = page.json;
  if (is_only) json["version"] = riis_version_string();
  if (!valve.name.empty()) json["name"] = valve.name;
  json[valve.opening ? "valve" : "surface"] = valve.surface_name;
  if (valve.opening) json["opening"] = *valve.opening;
  if (valve.time) json["time"] = *valve.time;
  if (valve.n_leaflets > 0) json["n_leaflets"] = valve.n_leaflets;
  if (report.has_mesh()) add_marks(report, valve, page);
  add_surface(valve, page);
  if (report.has_mesh()) {
    add_search(valve, page);
    add_leaks(valve, page);
    add_outside(valve, page);
  }
  if (is_only) json["seconds"] = json_of_seconds(report.seconds);
  add_skirt(valve, page);
  if (is_only && report.passage) json["passage"] = json_of_passage(*report.passage);
  add_resistance(*report.options, valve, page);
  add_flow(valve, page);
  if (is_only && report.step)
    json["step"] = {{"n_steps", report.step->n_steps},
                    {"search", view(search_names)[report.step->search]},
                    {"seconds_surface", report.step->surface},
                    {"seconds_search", report.step->marking}};
  add_crossings(valve, page);
  for (const TimeReport &time : valve.times) {
    Json made = {{"time", time.time}};
    if (time.opening) made["opening"] = *time.opening;
    made.update({{"n_marked", time.n_marked}, {"largest_speed", time.largest_speed}});
    json["times"].push_back(made);
  }
}

std::vector<Page> pages_of(const Report &report) {
  std::vector<Page> pages(report.valves.size());
  for (std::size_t i = 0; i < pages.size(); ++i) add_valve(report, report.valves[i], pages[i]);
  return pages;
}

}  // namespace

std::string json_of(const Report &report) {
  const std::vector<Page> pages = pages_of(report);
  if (pages.size() == 1) return pages[0].json.dump(2) + "\n";
  Json json = {{"version", riis_version_string()}, {"seconds", json_of_seconds(report.seconds)}};
  if (report.passage) json["passage"] = json_of_passage(*report.passage);
  for (const Page &page : pages) json["valves"].push_back(page.json);
  return json.dump(2) + "\n";
}

// In a series, each valve has a line about its times. Without a series, there are lines about the surface and the marks.
std::string table_of(const Report &report) {
  const MarkOptions &options = *report.options;
  const std::vector<double> &times = options.series.times;
  const std::vector<Page> pages = pages_of(report);
  std::ostringstream out;
  const auto add = [&](std::initializer_list<std::ostringstream Page::*> parts) {
    for (const Page &page : pages)
      for (const auto part : parts) out << (page.*part).str();
  };
  if (times.empty())
    add({&Page::surface});
  else
    out << line("times") << counted(view(times).size(), "time") << " from " << shown(times.front()) << " to "
        << shown(times.back());
  if (report.has_mesh()) {
    out << line("mesh") << options.mesh << ": " << counted(report.valves[0].marks.n_nodes, "node") << ", "
        << counted(report.n_cells, "cell");
    if (report.n_written) out << "; " << counted(*report.n_written, "node") << " written";
    add({&Page::marks, &Page::search});
    add({&Page::outside, &Page::leaks});
    if (report.passage) add_passage(*report.passage, out);
    if (options.measures || options.check_leaks) add({&Page::flow});
  }
  add({&Page::crossings});
  std::string before = line("seconds");
  for (const auto &[stage, taken] : stages_of(report.seconds))
    out << std::exchange(before, ", ") << stage << printed(" %.3f", taken);
  if (const auto &step = report.step)
    out << line("step") << printed("%.6f s: surface ", step->surface + step->marking)
        << printed("%.6f, search ", step->surface) << printed("%.6f; median of ", step->marking)
        << counted(step->n_steps, "step") << " of " << opening_of_step << " in opening, search "
        << view(search_names)[step->search];
  for (const std::string &path : report.written) out << line("written") << path;
  return out.str().substr(1) + "\n";
}

std::string csv_head_of(const Report &report) {
  std::string text = "time";
  for (const ValveReport &valve : report.valves) {
    const std::string prefix = valve.name.empty() ? "" : valve.name + "_";
    text += "," + prefix + "opening," + prefix + "n_marked," + prefix + "largest_speed";
  }
  return text + ",seconds\n";
}

std::string csv_line_of(const Report &report, double seconds) {
  std::string text = shortest(report.valves[0].times.back().time);
  for (const ValveReport &valve : report.valves) {
    const TimeReport &time = valve.times.back();
    text += "," + (time.opening ? shortest(*time.opening) : "") + "," + std::to_string(time.n_marked) + "," +
            shortest(time.largest_speed);
  }
  return text + "," + shortest(seconds) + "\n";
}

}  // namespace riis::program
