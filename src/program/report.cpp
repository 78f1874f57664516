// SPDX-License-Identifier: Apache-2.0
#include "program/report.hpp"

#include <iomanip>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/array_view.hpp"
#include "program/valve_file.hpp"

namespace riis::program {
namespace {

const char *search_name(int32_t search) {
  switch (search) {
    case RIIS_SEARCH_EXHAUSTIVE:
      return "exhaustive";
    case RIIS_SEARCH_NEIGHBOR:
      return "neighbor";
    case RIIS_SEARCH_PAPER:
      return "paper";
    case RIIS_SEARCH_CLUSTERS:
      return "clusters";
    default:
      return "unknown";
  }
}

const char *distance_name(int32_t distance) {
  switch (distance) {
    case RIIS_MEASURE_SAMPLING:
      return "sampling";
    case RIIS_MEASURE_MINIMIZATION:
      return "minimization";
    default:
      return "triangles";
  }
}

std::ostringstream table_stream() {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  return out;
}

void add_gap(const riis_gap &gap, std::ostringstream &out) {
  out << "skirt     to the wall, " << gap.least << " to " << gap.most << " away, " << gap.mean << " on average\n";
}

void add_marks(const Report &report, std::ostringstream &out) {
  const riis_mark_stats &marks = report.marks;
  out << "mesh      " << report.mesh_name << ": " << counted(marks.n_nodes, "node") << ", "
      << counted(report.n_cells, "cell") << "\n";
  out << "marked    " << counted(marks.n_marked, "node") << " within the half thickness "
      << report.surface.half_thickness;
  if (report.distance_limit > report.surface.half_thickness) {
    out << ", " << grouped(marks.n_within_limit) << " within " << report.distance_limit;
  }
  out << "\nsearch    " << search_name(marks.search) << ", " << counted(marks.n_threads, "thread");
  if (report.distance != RIIS_MEASURE_TRIANGLES) out << ", distances by " << distance_name(report.distance);
  if (marks.n_unreached > 0) out << ", " << counted(marks.n_unreached, "node") << " not reached from a neighbour";
  out << "\n";
  if (!marks.complete) out << "complete  unknown: the search misses nodes that are not connected to its start\n";
}

void add_leaks(const LeakReport &leaks, std::ostringstream &out) {
  const std::string unknown = why_unknown(leaks, "the mesh");
  out << "leaks     ";
  if (leaks.found.n_edges > 0)
    out << counted(leaks.found.n_edges, "edge") << " between unmarked nodes across the surface, length up to "
        << leaks.found.longest_length << (unknown.empty() ? "" : "; more are unknown: ") << unknown;
  else if (unknown.empty())
    out << "none: no edge crosses the surface between unmarked nodes";
  else
    out << "unknown: " << unknown;
  out << "\n";
}

void add_crossings(const CrossingReport &report, std::ostringstream &out) {
  out << "crossing  ";
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

nlohmann::ordered_json json_of_passage(const PassageReport &passage) {
  const riis_passage &found = passage.found;
  return {{"state", passage.is_unknown ? "unknown" : state_name(found.state)},
          {"node_id", found.node_id},
          {"distance", found.distance},
          {"point", found.point},
          {"closing_half_thickness", passage.closing_half_thickness > 0
                                         ? nlohmann::ordered_json(passage.closing_half_thickness)
                                         : nlohmann::ordered_json()}};
}

// Adds the lines about the flow to the table. A measure that is not set has no line. `name` names the valve, and `state` also its
// opening; both may be "".
void add_flow(const FlowReport &flow, std::ostringstream &out, const std::string &name = "",
              const std::string &state = "") {
  if (flow.cells && flow.cells->n_edges > 0)
    out << "across    " << name << flow.cells->mean << " mesh edges of mean length in the band, " << flow.cells->least
        << " to " << flow.cells->most << " by " << counted(flow.cells->n_edges, "edge") << "\n";
  if (flow.orifice)
    out << "orifice   " << state << flow.orifice->area << " open, " << flow.orifice->effective_area
        << " effective: the band takes " << flow.orifice->rim_reach << " half thicknesses along a perimeter of "
        << flow.orifice->perimeter
        << (flow.orifice->outline == RIIS_OUTLINE_BOUNDARY ? "; the outline is the longest open boundary" : "") << "\n";
  if (flow.first) {
    out << "opens     ";
    if (flow.first->state == RIIS_FIRST_PASSAGE_FOUND)
      out << "for the mesh at opening " << flow.first->opening << ", closed at " << flow.first->closed_opening;
    else if (flow.first->state == RIIS_FIRST_PASSAGE_ALWAYS)
      out << "always: the mesh has a passage at opening 0";
    else
      out << (flow.first->state == RIIS_FIRST_PASSAGE_NEVER ? "never: the mesh has no passage at any opening tried"
                                                            : "unknown: the mesh itself has no path");
    out << "\n";
  }
  if (flow.leak_per_drop && flow.drop)
    out << "leak      " << *flow.leak_per_drop * *flow.drop << " at the drop " << *flow.drop
        << ", through an ideal closed valve\n";
}

nlohmann::ordered_json json_of_first(const riis_first_passage &first) {
  static const char *const states[] = {"found", "always", "never", "none"};
  return {{"state", states[first.state]},  {"opening", first.opening},   {"closed_opening", first.closed_opening},
          {"node_id", first.node_id},      {"distance", first.distance}, {"point", first.point},
          {"n_openings", first.n_openings}};
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
  if (flow.leak_per_drop) json["leak_per_drop"] = *flow.leak_per_drop;
  if (flow.leak_per_drop && flow.drop) json["leak"] = *flow.leak_per_drop * *flow.drop;
}

void add_seconds(const Seconds &seconds, std::ostringstream &out) {
  out << std::fixed << std::setprecision(3) << "seconds   read " << seconds.read << ", surface " << seconds.surface
      << ", scene " << seconds.scene << ", mesh " << seconds.mesh << ", adjacency " << seconds.adjacency << ", search "
      << seconds.search << ", leaks " << seconds.leaks << ", write " << seconds.write << ", picture " << seconds.picture
      << "\n";
}

void add_step(const StepTimes &step, std::ostringstream &out) {
  out << std::setprecision(6) << "step      " << step.surface + step.marking << " s: surface " << step.surface
      << ", search " << step.marking << "; median of " << counted(step.n_steps, "step") << " of " << std::defaultfloat
      << opening_of_step << " in opening, search " << search_name(step.search) << "\n";
}

}  // namespace

std::string grouped(int64_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, ",");
  return digits;
}

const char *outline_name(int32_t outline) {
  static const char *const names[] = {"none", "disc", "attachment", "boundary"};
  return view(names)[outline];
}

std::string counted(int64_t n, const char *singular) { return grouped(n) + " " + singular + (n == 1 ? "" : "s"); }

std::string surface_title(const Report &report) {
  std::ostringstream out = table_stream();
  out << report.surface_name;
  if (report.opening) out << (is_valve_file(report.surface_name) ? "" : " valve") << ", opening " << *report.opening;
  if (report.time) out << ", time " << *report.time;
  return out.str();
}

std::string why_unknown(const LeakReport &leaks, const std::string &mesh) {
  if (leaks.has_all_edges()) return "";
  if (leaks.n_volume_cells == 0) return mesh + " has no volume cells";
  return "riis does not know the edges of " + grouped(leaks.n_cells_left_out) + " of " +
         counted(leaks.n_volume_cells, "volume cell") + " in " + mesh;
}

std::string line_of_passage(const LeakReport &leaks) {
  if (!leaks.passage) return "";
  const riis_passage &found = leaks.passage->found;
  std::ostringstream out = table_stream();
  out << "passage   " << (leaks.passage->is_unknown ? "unknown; along the known edges " : "");
  if (found.state == RIIS_PASSAGE_NONE)
    out << "none: the mesh itself does not join the two points";
  else
    out << (found.state == RIIS_PASSAGE_OPEN ? "open" : "closed") << ": at " << leaks.passage->place << ", "
        << found.distance << " from the surface" << (leaks.passage->is_end ? ", an end" : "");
  out << "\n";
  return out.str();
}

std::string lines_of_valve_flows(const Report &report) {
  std::ostringstream out = table_stream();
  for (const ValveFlow &valve : report.valve_flows) {
    std::ostringstream state = table_stream();
    state << valve.name;
    if (valve.opening) state << (valve.name.empty() ? "" : ", ") << "opening " << *valve.opening;
    if (!state.str().empty()) state << ": ";
    add_flow(valve.flow, out, valve.name + (valve.name.empty() ? "" : ": "), state.str());
  }
  return out.str();
}

std::string json_of(const Report &report) {
  const riis_mark_stats &marks = report.marks;
  const Seconds &seconds = report.seconds;
  const riis_leak_list &leaks = report.leaks.found;
  const bool are_unknown = leaks.n_edges == 0 && !report.leaks.has_all_edges();
  const auto if_known = [&](const nlohmann::ordered_json &value) {
    return are_unknown ? nlohmann::ordered_json() : value;
  };
  nlohmann::ordered_json json = {{"version", riis_version_string()}};
  json[report.opening ? "valve" : "surface"] = report.surface_name;
  if (report.opening) json["opening"] = *report.opening;
  if (report.time) json["time"] = *report.time;
  if (report.n_leaflets > 0) json["n_leaflets"] = report.n_leaflets;
  json.update({{"n_nodes", marks.n_nodes},
               {"n_cells", report.n_cells},
               {"n_marked", marks.n_marked},
               {"n_within_limit", marks.n_within_limit},
               {"n_triangles", report.surface.n_triangles},
               {"n_zero_area", report.surface.n_zero_area},
               {"area", report.surface.area},
               {"half_thickness", report.surface.half_thickness},
               {"distance_limit", report.distance_limit},
               {"search", search_name(marks.search)},
               {"distance", distance_name(report.distance)},
               {"threads", marks.n_threads},
               {"complete", marks.complete != 0},
               {"n_unreached", marks.n_unreached},
               {"n_leaking_edges", if_known(leaks.n_edges)},
               {"longest_leaking_edge", if_known(leaks.longest_length)},
               {"longest_leaking_edge_middle", if_known(leaks.longest_middle)},
               {"closing_half_thickness", report.leaks.closing_half_thickness > 0
                                              ? nlohmann::ordered_json(report.leaks.closing_half_thickness)
                                              : nlohmann::ordered_json()},
               {"n_volume_cells", report.leaks.n_volume_cells},
               {"n_cells_without_known_edges", report.leaks.n_cells_left_out},
               {"seconds",
                {{"read", seconds.read},
                 {"surface", seconds.surface},
                 {"scene", seconds.scene},
                 {"mesh", seconds.mesh},
                 {"adjacency", seconds.adjacency},
                 {"search", seconds.search},
                 {"leaks", seconds.leaks},
                 {"write", seconds.write},
                 {"picture", seconds.picture}}}});
  // The report has these values only if a mesh was marked. Otherwise they are removed.
  static const char *const of_marks[] = {"n_nodes",
                                         "n_cells",
                                         "n_marked",
                                         "n_within_limit",
                                         "distance_limit",
                                         "search",
                                         "distance",
                                         "threads",
                                         "complete",
                                         "n_unreached",
                                         "n_leaking_edges",
                                         "longest_leaking_edge",
                                         "longest_leaking_edge_middle",
                                         "closing_half_thickness",
                                         "n_volume_cells",
                                         "n_cells_without_known_edges"};
  if (report.mesh_name.empty())
    for (const char *key : of_marks) json.erase(key);
  if (report.gap)
    json["gap"] = {{"least", report.gap->least},   {"mean", report.gap->mean},
                   {"most", report.gap->most},     {"widest_point", report.gap->widest_point},
                   {"n_ends", report.gap->n_ends}, {"n_without_wall", report.gap->n_without_wall}};
  if (report.leaks.passage) json["passage"] = json_of_passage(*report.leaks.passage);
  add_flow(report.flow, json);
  if (report.step) {
    json["step"] = {{"n_steps", report.step->n_steps},
                    {"search", search_name(report.step->search)},
                    {"seconds_surface", report.step->surface},
                    {"seconds_search", report.step->marking}};
  }
  if (report.crossings) {
    const riis_crossing_list &found = report.crossings->found;
    json["crossings"] = {{"n_openings", report.crossings->n_openings},
                         {"n_pairs", found.n_pairs},
                         {"length", found.total_length},
                         {"depth", found.deepest_depth},
                         {"point", found.deepest_point},
                         {"leaflets", found.deepest_leaflet_id}};
    if (report.crossings->opening) json["crossings"]["opening"] = *report.crossings->opening;
  }
  return json.dump(2) + "\n";
}

std::string table_of(const Report &report) {
  std::ostringstream out = table_stream();
  out << "surface   " << surface_title(report) << ": " << counted(report.surface.n_triangles, "triangle");
  if (report.n_leaflets > 0) out << ", " << counted(report.n_leaflets, "leaflet");
  out << ", area " << report.surface.area;
  // Triangles without area are mentioned only for a surface from a file, which should have none. A valve has them at every
  // collapsed side.
  if (!report.opening && report.surface.n_zero_area > 0)
    out << ", " << grouped(report.surface.n_zero_area) << " without area left out";
  out << "\n";
  if (report.gap) add_gap(*report.gap, out);
  if (!report.mesh_name.empty()) {
    add_marks(report, out);
    add_leaks(report.leaks, out);
    out << line_of_passage(report.leaks);
    if (report.prints_flow) add_flow(report.flow, out);
  }
  if (report.crossings) add_crossings(*report.crossings, out);
  add_seconds(report.seconds, out);
  if (report.step) add_step(*report.step, out);
  for (const std::string &path : report.written) out << "written   " << path << "\n";
  return out.str();
}

}  // namespace riis::program
