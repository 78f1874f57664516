// SPDX-License-Identifier: Apache-2.0
#include "program/output/report.hpp"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>

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

namespace {

std::ostringstream table_stream() {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  return out;
}

// Returns the beginning of a line in the table. The valve's name, `name`, may be "".
std::string line(std::string label, const std::string &name) {
  label.resize(10, ' ');
  return label + (name.empty() ? "" : name + ": ");
}

// Returns the beginning of a line in the table, for a valve at an opening. The opening is left out if it is also the opening of
// the marks.
std::string line(const std::string &label, const ValveReport &valve, const std::optional<double> &opening) {
  std::ostringstream state = table_stream();
  state << valve.name;
  if (opening) state << (valve.name.empty() ? "" : ", ") << "opening " << *opening;
  return line(label, state.str());
}

void add_surface(const ValveReport &valve, std::ostringstream &out) {
  out << line("surface", valve.name) << surface_title(valve) << ": " << counted(valve.surface.n_triangles, "triangle");
  if (valve.n_leaflets > 0) out << ", " << counted(valve.n_leaflets, "leaflet");
  out << ", area " << valve.surface.area;
  // Triangles without area are mentioned only for a surface from a file, which should have no such triangles. A valve has
  // triangles without area at every side of a patch that collapses to a point.
  if (!valve.opening && valve.surface.n_zero_area > 0)
    out << ", " << grouped(valve.surface.n_zero_area) << " without area left out";
  out << "\n";
  if (const auto &attached = valve.attached)
    out << line("skirt", valve.name) << "from " << counted(attached->n_edges, "open edge") << " of the length "
        << shown(attached->length) << " in all, around " << shown(attached->middle[0]) << " "
        << shown(attached->middle[1]) << " " << shown(attached->middle[2]) << "\n";
  if (valve.gap)
    out << line("skirt", valve.name) << "to the wall, " << valve.gap->least << " to " << valve.gap->most << " away, "
        << valve.gap->mean << " on average\n";
}

void add_marks(const ValveReport &valve, std::ostringstream &out) {
  out << line("marked", valve.name) << counted(valve.marks.n_marked, "node") << " within the half thickness "
      << valve.surface.half_thickness;
  if (valve.distance_limit > valve.surface.half_thickness) {
    out << ", " << grouped(valve.marks.n_within_limit) << " within " << valve.distance_limit;
  }
  out << "\n";
}

std::string from_to(const std::string &least, const std::string &most) {
  return least == most ? least : least + " to " + most;
}

// Adds the line of a series, with openings, marked nodes and speed.
void add_times(const ValveReport &valve, std::ostringstream &out) {
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
      << shown(most.largest_speed) << "\n";
}

void add_search(const ValveReport &valve, std::ostringstream &out) {
  const riis_mark_stats &marks = valve.marks;
  out << line("search", valve.name) << view(search_names)[marks.search] << ", " << counted(marks.n_threads, "thread");
  if (valve.distance != RIIS_MEASURE_TRIANGLES) out << ", distances by " << view(distance_names)[valve.distance];
  if (marks.n_unreached > 0) out << ", " << counted(marks.n_unreached, "node") << " not reached from a neighbour";
  out << "\n";
  if (!marks.complete)
    out << line("complete", valve.name)
        << "unknown, because this search misses nodes that are not connected to its start node\n";
}

void add_leaks(const ValveReport &valve, std::ostringstream &out) {
  const LeakReport &leaks = valve.leaks;
  const std::string unknown = why_unknown(leaks, "the mesh");
  out << line("leaks", valve.name);
  if (leaks.found.n_edges > 0)
    out << counted(leaks.found.n_edges, "edge") << " between unmarked nodes across the surface, length up to "
        << leaks.found.longest_length << (unknown.empty() ? "" : "; more are unknown: ") << unknown;
  else if (unknown.empty() && leaks.is_near)
    out << "none: no mesh edge between two unmarked nodes crosses the surface";
  else
    out << "unknown: " << (unknown.empty() ? "no node is marked" : unknown);
  out << "\n";
}

void add_outside(const ValveReport &valve, std::ostringstream &out) {
  constexpr double least_said = 0.0005;
  if (!valve.outside || valve.outside->share < least_said) return;
  out << line("outside", valve, valve.outside->opening) << outside_text(*valve.outside)
      << " is farther than the half thickness outside the mesh\n";
}

nlohmann::ordered_json json_of_outside(const OutsideReport &outside) {
  nlohmann::ordered_json json = {{"share", outside.share}, {"leaflets", nlohmann::ordered_json::array()}};
  if (outside.opening) json["opening"] = *outside.opening;
  for (const OutsideReport::Leaflet &leaflet : outside.leaflets)
    json["leaflets"].push_back({{"name", leaflet.name}, {"share", leaflet.share}});
  return json;
}

void add_crossings(const ValveReport &valve, std::ostringstream &out) {
  if (!valve.crossings) return;
  const CrossingReport &report = *valve.crossings;
  out << line("crossing", valve.name);
  if (report.found.n_pairs == 0) {
    out << "none: no triangles go through each other";
    if (report.n_openings > 0) out << " at " << counted(report.n_openings, "opening") << " from 0 to 1";
  } else {
    out << counted(report.found.n_pairs, "pair") << " of triangles go through each other";
    if (report.opening) out << " at opening " << *report.opening;
    out << ", along a length of " << report.found.total_length << ", up to " << report.found.deepest_depth << " deep";
  }
  out << "\n";
}

const char *state_name(int32_t state) {
  return state == RIIS_PASSAGE_OPEN ? "open" : state == RIIS_PASSAGE_CLOSED ? "closed" : "none";
}

// Returns the value for JSON, or null if there is no value.
nlohmann::ordered_json if_known(bool is_known, const nlohmann::ordered_json &value) {
  return is_known ? value : nlohmann::ordered_json();
}

nlohmann::ordered_json json_of_passage(const PassageReport &passage) {
  const riis_passage &found = passage.found;
  return {{"state", passage.is_unknown ? "unknown" : state_name(found.state)},
          {"node_id", found.node_id},
          {"distance", found.distance},
          {"point", found.point},
          {"closing_half_thickness", if_known(passage.closing.half_thickness > 0, passage.closing.half_thickness)}};
}

std::string after_blank(const std::string &unit) { return unit.empty() ? "" : " " + unit; }

// Adds the lines about the flow to the table. A measure that is not set has no line.
void add_flow(const ValveReport &valve, std::ostringstream &out) {
  const FlowReport &flow = valve.flow;
  if (flow.cells && flow.cells->n_edges > 0)
    out << line("across", valve.name) << flow.cells->mean << " mesh edges of mean length in the band, "
        << flow.cells->least << " to " << flow.cells->most << " by " << counted(flow.cells->n_edges, "edge") << "\n";
  if (flow.orifice)
    out << line("orifice", valve, flow.orifice_opening) << flow.orifice->area << " open, "
        << flow.orifice->effective_area << " effective: the band takes " << flow.orifice->rim_reach
        << " half thicknesses along a perimeter of " << flow.orifice->perimeter
        << (has_slits(*flow.orifice) ? slits_text : "")
        << (flow.orifice->outline == RIIS_OUTLINE_BOUNDARY ? "; the outline consists of the open edges" : "") << "\n";
  if (flow.first) {
    out << line("opens", valve.name);
    if (flow.first->state == RIIS_FIRST_PASSAGE_FOUND)
      out << "for the mesh at opening " << flow.first->opening << ", closed at " << flow.first->closed_opening;
    else if (flow.first->state == RIIS_FIRST_PASSAGE_ALWAYS)
      out << "always: even the closed valve leaves a passage open";
    else
      out << (flow.first->state == RIIS_FIRST_PASSAGE_NEVER
                  ? "never: no opening that was tried leaves a passage open"
                  : "unknown, because the mesh itself does not connect the points");
    out << "\n";
  }
  if (flow.leak_per_drop && flow.drop) {
    out << line("leak", valve.name) << *flow.leak_per_drop * *flow.drop << after_blank(flow.leak_unit)
        << " at the drop " << *flow.drop << after_blank(flow.drop_unit) << ", through an ideal closed valve";
    if (flow.closed_area) out << " of the area " << *flow.closed_area;
    out << "\n";
  }
}

// Adds the line with the units of R and K.
void add_resistance(const ValveReport &valve, std::ostringstream &out) {
  if (!valve.resistance) return;
  const ResistanceReport &of = *valve.resistance;
  out << line("R", valve.name) << of.R << after_blank(of.R_unit);
  if (of.R_unit.empty()) {
    out << (of.K_name.empty() ? "" : " and " + of.K_name)
        << " in the units of the mesh, whose unit of length is not known";
  } else if (!of.K_name.empty()) {
    out << "; " << of.K_name << " is in " << of.K_unit;
  }
  if (of.density) out << ", for the density " << *of.density << (of.R_unit.empty() ? "" : " kg/m3");
  out << "\n";
}

nlohmann::ordered_json json_of_first(const riis_first_passage &first) {
  static const char *const states[] = {"found", "always", "never", "none"};
  return {{"state", states[first.state]},  {"opening", first.opening},   {"closed_opening", first.closed_opening},
          {"node_id", first.node_id},      {"distance", first.distance}, {"point", first.point},
          {"n_openings", first.n_openings}};
}

const char *outline_name(int32_t outline) {
  static const char *const names[] = {"none", "disc", "attachment", "boundary"};
  return view(names)[outline];
}

void add_flow(const FlowReport &flow, nlohmann::ordered_json &json) {
  if (flow.orifice)
    json["orifice"] = {{"outline", outline_name(flow.orifice->outline)}, {"area", flow.orifice->area},
                       {"outline_area", flow.orifice->outline_area},     {"perimeter", flow.orifice->perimeter},
                       {"effective_area", flow.orifice->effective_area}, {"rim_reach", flow.orifice->rim_reach}};
  if (flow.cells)
    json["cells_across"] = {{"least", flow.cells->least},
                            {"mean", flow.cells->mean},
                            {"most", flow.cells->most},
                            {"mean_edge", flow.cells->mean_edge},
                            {"n_edges", flow.cells->n_edges}};
  if (flow.n_open_regions) json["n_open_regions"] = *flow.n_open_regions;
  if (flow.first) json["first_passage"] = json_of_first(*flow.first);
  if (flow.closed_area) json["closed_area"] = *flow.closed_area;
  if (flow.leak_per_drop) json["leak_per_drop"] = *flow.leak_per_drop;
  if (flow.leak_per_drop && flow.drop) {
    json["leak"] = *flow.leak_per_drop * *flow.drop;
    json["leak_unit"] = if_known(!flow.leak_unit.empty(), flow.leak_unit);
    json["drop_unit"] = if_known(!flow.drop_unit.empty(), flow.drop_unit);
  }
}

void add_resistance(const ResistanceReport &of, nlohmann::ordered_json &json) {
  json["resistance"] = of.R;
  json["resistance_unit"] = if_known(!of.R_unit.empty(), of.R_unit);
  if (of.K_name.empty()) return;
  json["K_unit"] = if_known(!of.K_unit.empty(), of.K_unit);
  if (of.density) json["density"] = *of.density;
}

using Stages = std::vector<std::pair<const char *, double>>;
Stages stages_of(const Seconds &s) {
  return {{"read", s.read},   {"surface", s.surface},     {"scene", s.scene},
          {"mesh", s.mesh},   {"adjacency", s.adjacency}, {"search", s.search},
          {"leaks", s.leaks}, {"write", s.write},         {"picture", s.picture}};
}

void add_seconds(const Seconds &seconds, std::ostringstream &out) {
  out << std::fixed << std::setprecision(3) << line("seconds", "");
  const char *before = "";
  for (const auto &[stage, taken] : stages_of(seconds)) out << std::exchange(before, ", ") << stage << " " << taken;
  out << "\n";
}

void add_step(const StepTimes &step, std::ostringstream &out) {
  out << std::setprecision(6) << line("step", "") << step.surface + step.marking << " s: surface " << step.surface
      << ", search " << step.marking << "; median of " << counted(step.n_steps, "step") << " of " << std::defaultfloat
      << opening_of_step << " in opening, search " << view(search_names)[step.search] << "\n";
}

}  // namespace

std::string grouped(int64_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, ",");
  return digits;
}

std::string counted(int64_t n, const char *singular) { return grouped(n) + " " + singular + (n == 1 ? "" : "s"); }

std::string surface_title(const ValveReport &valve) {
  std::ostringstream out = table_stream();
  out << valve.surface_name;
  if (valve.opening) out << (is_valve_file(valve.surface_name) ? "" : " valve") << ", opening " << *valve.opening;
  if (valve.time) out << ", time " << *valve.time;
  return out.str();
}

std::string why_unknown(const LeakReport &leaks, const std::string &mesh) {
  if (leaks.has_all_edges()) return "";
  if (leaks.n_volume_cells == 0) return mesh + " has no volume cells";
  return "riis does not know the edges of " + grouped(leaks.n_cells_left_out) + " of " +
         counted(leaks.n_volume_cells, "volume cell") + " in " + mesh;
}

std::string line_of_passage(const Report &report) {
  if (!report.passage) return "";
  const riis_passage &found = report.passage->found;
  std::ostringstream out = table_stream();
  out << line("passage", "") << (report.passage->is_unknown ? "unknown; along the known edges " : "");
  if (found.state == RIIS_PASSAGE_NONE)
    out << "none, because the mesh itself does not connect the two points";
  else
    out << (found.state == RIIS_PASSAGE_OPEN ? "open" : "closed") << ": at " << report.passage->place << ", "
        << found.distance << " from the surface" << (report.passage->is_end ? ", an end" : "");
  out << "\n";
  return out.str();
}

namespace {

nlohmann::ordered_json json_of_seconds(const Seconds &seconds) {
  nlohmann::ordered_json json;
  for (const auto &[stage, taken] : stages_of(seconds)) json[stage] = taken;
  return json;
}

void add_marks(const ValveReport &valve, nlohmann::ordered_json &json) {
  const riis_mark_stats &marks = valve.marks;
  const LeakReport &leaks = valve.leaks;
  const bool are_known = leaks.found.n_edges > 0 || (leaks.has_all_edges() && leaks.is_near);
  json.update({{"distance_limit", valve.distance_limit},
               {"search", view(search_names)[marks.search]},
               {"distance", view(distance_names)[valve.distance]},
               {"threads", marks.n_threads},
               {"complete", marks.complete != 0},
               {"n_unreached", marks.n_unreached},
               {"n_leaking_edges", if_known(are_known, leaks.found.n_edges)},
               {"longest_leaking_edge", if_known(are_known, leaks.found.longest_length)},
               {"longest_leaking_edge_middle", if_known(are_known, leaks.found.longest_middle)},
               {"closing_half_thickness", if_known(leaks.closing.half_thickness > 0, leaks.closing.half_thickness)},
               {"n_volume_cells", leaks.n_volume_cells},
               {"n_cells_without_known_edges", leaks.n_cells_left_out},
               {"outside", valve.outside ? json_of_outside(*valve.outside) : nlohmann::ordered_json()}});
}

// Returns the JSON keys of a valve. For a single valve, the keys of the run are added.
nlohmann::ordered_json json_of_valve(const Report &report, const ValveReport &valve, bool is_only) {
  nlohmann::ordered_json json;
  if (is_only) json["version"] = riis_version_string();
  if (!valve.name.empty()) json["name"] = valve.name;
  json[valve.opening ? "valve" : "surface"] = valve.surface_name;
  if (valve.opening) json["opening"] = *valve.opening;
  if (valve.time) json["time"] = *valve.time;
  if (valve.n_leaflets > 0) json["n_leaflets"] = valve.n_leaflets;
  const bool has_mesh = !report.mesh_name.empty();
  if (has_mesh)
    json.update({{"n_nodes", valve.marks.n_nodes},
                 {"n_cells", report.n_cells},
                 {"n_marked", valve.marks.n_marked},
                 {"n_within_limit", valve.marks.n_within_limit}});
  json.update({{"n_triangles", valve.surface.n_triangles},
               {"n_zero_area", valve.surface.n_zero_area},
               {"area", valve.surface.area},
               {"half_thickness", valve.surface.half_thickness}});
  if (has_mesh) add_marks(valve, json);
  if (is_only) json["seconds"] = json_of_seconds(report.seconds);
  if (valve.attached)
    json["attached"] = {
        {"n_edges", valve.attached->n_edges}, {"length", valve.attached->length}, {"middle", valve.attached->middle}};
  if (valve.gap)
    json["gap"] = {{"least", valve.gap->least},   {"mean", valve.gap->mean},
                   {"most", valve.gap->most},     {"widest_point", valve.gap->widest_point},
                   {"n_ends", valve.gap->n_ends}, {"n_without_wall", valve.gap->n_without_wall}};
  if (is_only && report.passage) json["passage"] = json_of_passage(*report.passage);
  if (valve.resistance) add_resistance(*valve.resistance, json);
  add_flow(valve.flow, json);
  if (is_only && report.step) {
    json["step"] = {{"n_steps", report.step->n_steps},
                    {"search", view(search_names)[report.step->search]},
                    {"seconds_surface", report.step->surface},
                    {"seconds_search", report.step->marking}};
  }
  if (valve.crossings) {
    const riis_crossing_list &found = valve.crossings->found;
    json["crossings"] = {{"n_openings", valve.crossings->n_openings},
                         {"n_pairs", found.n_pairs},
                         {"length", found.total_length},
                         {"depth", found.deepest_depth},
                         {"point", found.deepest_point},
                         {"leaflets", found.deepest_leaflet_id}};
    if (valve.crossings->opening) json["crossings"]["opening"] = *valve.crossings->opening;
  }
  for (const TimeReport &time : valve.times) {
    nlohmann::ordered_json made = {{"time", time.time}};
    if (time.opening) made["opening"] = *time.opening;
    made.update({{"n_marked", time.n_marked}, {"largest_speed", time.largest_speed}});
    json["times"].push_back(made);
  }
  return json;
}

}  // namespace

std::string json_of(const Report &report) {
  if (report.valves.size() == 1) return json_of_valve(report, report.valves[0], true).dump(2) + "\n";
  nlohmann::ordered_json json = {{"version", riis_version_string()}, {"seconds", json_of_seconds(report.seconds)}};
  if (report.passage) json["passage"] = json_of_passage(*report.passage);
  for (const ValveReport &valve : report.valves) json["valves"].push_back(json_of_valve(report, valve, false));
  return json.dump(2) + "\n";
}

// In a series, each valve has a line about its times. Without a series, there are lines about the surface and the marks.
std::string table_of(const Report &report) {
  std::ostringstream out = table_stream();
  const bool is_series = !report.times.empty(), has_mesh = !report.mesh_name.empty();
  if (is_series)
    out << line("times", "") << counted(view(report.times).size(), "time") << " from " << shown(report.times.front())
        << " to " << shown(report.times.back()) << "\n";
  for (const ValveReport &valve : report.valves)
    if (!is_series) add_surface(valve, out);
  if (has_mesh) {
    out << line("mesh", "") << report.mesh_name << ": " << counted(report.valves[0].marks.n_nodes, "node") << ", "
        << counted(report.n_cells, "cell");
    if (report.n_written) out << "; " << counted(*report.n_written, "node") << " written";
    out << "\n";
    for (const ValveReport &valve : report.valves) {
      if (is_series)
        add_times(valve, out);
      else
        add_marks(valve, out);
      add_resistance(valve, out);
      add_search(valve, out);
    }
    for (const ValveReport &valve : report.valves) {
      add_outside(valve, out);
      add_leaks(valve, out);
    }
    out << line_of_passage(report);
    for (const ValveReport &valve : report.valves)
      if (report.prints_flow) add_flow(valve, out);
  }
  for (const ValveReport &valve : report.valves) add_crossings(valve, out);
  add_seconds(report.seconds, out);
  if (report.step) add_step(*report.step, out);
  for (const std::string &path : report.written) out << line("written", "") << path << "\n";
  return out.str();
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
