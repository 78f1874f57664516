// SPDX-License-Identifier: Apache-2.0
#include "program/leaks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "program/handles.hpp"
#include "program/mesh_marking.hpp"
#include "program/moving_valve.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"
#include "program/text.hpp"
#include "program/warnings.hpp"

namespace riis::program {

Leaks leaks_of(const MarkedMesh &marked, const riis_mark_options &options, double longer_than,
               int64_t *n_cells_left_out) {
  riis_adjacency *handle = nullptr;
  check(riis_vtk_mesh_create_long_edges(marked.file, marked.surface, longer_than, options.n_threads, n_cells_left_out,
                                        &handle));
  const Adjacency adjacency(handle);
  riis_csr rows;
  check(riis_adjacency_get_csr(adjacency.get(), &rows, sizeof rows));
  check(riis_mesh_set_adjacency(marked.mesh, &rows));
  riis_leaks *leaks_handle = nullptr;
  check(riis_leaks_create(&leaks_handle));
  Leaks leaks(leaks_handle);
  const riis_status status = riis_find_leaks(marked.surface, marked.mesh, marked.result, &options, leaks.get());
  // The rows are destroyed soon, so the mesh must give them up. This call leaves the message of a failed search as it is.
  check(riis_mesh_set_adjacency(marked.mesh, nullptr));
  check(status);
  return leaks;
}

double longest_closed_edge(const MarkOptions &options, double half_thickness, bool is_complete) {
  return is_complete && options.surface_options.measure == RIIS_MEASURE_TRIANGLES ? 2 * half_thickness : 0;
}

Surface with_half_thickness(const MarkOptions &options, const riis_valve *valve, double half_thickness) {
  riis_surface_options surface_options = options.surface_options;
  surface_options.half_thickness = half_thickness;
  riis_surface *surface = nullptr;
  check(riis_surface_create(valve, &surface_options, &surface));
  return Surface(surface);
}

namespace {

// Marks the nodes again with another half thickness, and returns the leaks of the new marking.
Leaks leaks_with(const MarkOptions &options, const MarkedMesh &marked, double half_thickness) {
  const Surface surface = with_half_thickness(options, marked.valve, half_thickness);
  const Marks result = new_result();
  riis_mark_options mark_options = options.mark_options;
  mark_options.search = RIIS_SEARCH_AUTO;
  mark_options.distance_limit = RIIS_AUTO;
  check(riis_mark_nodes(surface.get(), marked.mesh, &mark_options, result.get()));
  return leaks_of({surface.get(), marked.valve, marked.file, marked.mesh, result.get(), ""}, mark_options,
                  longest_closed_edge(options, half_thickness, true), nullptr);
}

// Returns a half thickness that closes the surface, or 0 if none is found. Each candidate must be tried, because a valve's
// triangles depend on the half thickness. The triangles of a file do not.
double closing_half_thickness(const riis_valve *valve, double half_thickness, const Left &left) {
  constexpr int n_tries = 8;
  double wanted = rounded_up(half_thickness);
  if (!valve) return wanted;
  try {
    for (int i = 0; i < n_tries; ++i) {
      const std::optional<double> needed = left(wanted);
      if (!needed) return wanted;
      wanted = rounded_up(std::max(*needed, 1.01 * wanted));
    }
  } catch (const Refusal &) {
    // The warning is valid even without advice. There is no advice, for example, if a half thickness allows no surface, or if an
    // end of a passage lies in the thicker band.
  }
  return 0;
}

// --quiet does not silence this warning, because the valve lets flow through.
void warn_of_leaks(const MarkOptions &options, const LeakReport &report, const std::string &surface,
                   double half_thickness) {
  const riis_leak_list &leaks = report.found;
  const bool is_one = leaks.n_edges == 1;
  const std::string length = shown(leaks.longest_length);
  const std::string text =
      surface + " leaks: " +
      (is_one ? "1 edge of length " + length + " crosses it between two unmarked nodes"
              : grouped(leaks.n_edges) + " edges cross it between two unmarked nodes, the longest (" + length + ")") +
      " at " + place_text(options, leaks.longest_middle, leaks.longest_length);
  std::string advice = "; ";
  if (report.closing_half_thickness > 0)
    advice += "--half-thickness " + shortest(report.closing_half_thickness) + " closes " + (is_one ? "it; " : "them; ");
  warn({{Cause::leaks, text,
         advice + "edges of at most two half thicknesses (" + shortest(2 * half_thickness) + ") do not leak"}});
}

}  // namespace

double distance_between(const double *p, const double *q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

double rounded_up(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 2);
  for (int steps = 0;; ++steps) {
    char text[64];
    double rounded = 0;
    const char *end = std::to_chars(text, text + sizeof text, x + steps * unit, std::chars_format::general, 3).ptr;
    std::from_chars(text, end, rounded);
    if (rounded >= x) return rounded;
  }
}

void judge_leaks(const MarkOptions &options, const riis_valve *valve, const std::string &surface_name, const Left &left,
                 Report &report) {
  LeakReport &leaks = report.leaks;
  if (options.check_leaks) return;
  if (leaks.found.n_edges > 0) {
    if (report.marks.complete)
      leaks.closing_half_thickness = closing_half_thickness(valve, leaks.found.half_thickness, left);
    warn_of_leaks(options, leaks, surface_name, report.surface.half_thickness);
  }
  if (!leaks.has_all_edges())
    warn((leaks.found.n_edges > 0 ? "more leaks of " : "leaks of ") + surface_name +
         " are unknown: " + why_unknown(leaks, options.mesh));
}

void look_for_leaks(const MarkOptions &options, const MarkedMesh &marked, Report &report) {
  const Stage stage("looking for leaks", options.quiet);
  LeakReport &leaks = report.leaks;
  const double half_thickness = report.surface.half_thickness;
  const double longer_than = longest_closed_edge(options, half_thickness, report.marks.complete != 0);
  const Leaks found = leaks_of(marked, options.mark_options, longer_than, &leaks.n_cells_left_out);
  leaks.found = list_of(found.get());
  leaks.edges.assign(leaks.found.node_id, leaks.found.node_id + 2 * leaks.found.n_edges);
  leaks.found.node_id = nullptr;
  leaks.found.length = leaks.found.distance = nullptr;
  check(riis_vtk_mesh_get_volume_cells(marked.file, &leaks.n_volume_cells, nullptr));
  judge_leaks(
      options, marked.valve, marked.surface_name,
      [&](double wanted) {
        const Leaks handle = leaks_with(options, marked, wanted);
        const riis_leak_list left = list_of(handle.get());
        return left.n_edges == 0 ? std::nullopt : std::optional(left.half_thickness);
      },
      report);
  report.seconds.leaks = stage.seconds();
}

// ---- Passage check ----

namespace {

// Returns the point's numbers as the user wrote them.
std::string text_of(const double *point) {
  return shortest(point[0]) + " " + shortest(point[1]) + " " + shortest(point[2]);
}

// The nodes of a file, and the neighbours of each node.
class JoinedNodes {
 public:
  JoinedNodes(const MarkedMesh &marked, int32_t n_threads) : mesh_(marked.mesh), edges_(marked.file, n_threads) {
    check(riis_vtk_mesh_get_nodes(marked.file, &n_, nullptr, &xyz_));
    check(riis_mesh_set_adjacency(mesh_, edges_.rows()));
  }
  ~JoinedNodes() { riis_mesh_set_adjacency(mesh_, nullptr); }
  JoinedNodes(const JoinedNodes &) = delete;
  JoinedNodes &operator=(const JoinedNodes &) = delete;

  // Returns the nearest node that has a neighbour. `name` and `why_none` are as in check_end.
  int64_t nearest(const MarkOptions &options, const char *name, const double *point,
                  const std::string &why_none) const {
    int64_t found = -1;
    double least = 0, lower[3], upper[3];
    for (int64_t i = 0; i < n_; ++i) {
      const double *p = xyz_ + 3 * i;
      for (int k = 0; k < 3; ++k) {
        lower[k] = i == 0 ? p[k] : std::min(lower[k], p[k]);
        upper[k] = i == 0 ? p[k] : std::max(upper[k], p[k]);
      }
      if (longest_edge(i) == 0) continue;
      const double away = distance_between(p, point);
      if (found < 0 || away < least) found = i, least = away;
    }
    std::optional<NearestNode> nearest;
    if (found >= 0) nearest = {least, longest_edge(found), std::to_string(found)};
    check_end(options, name, point, nearest, lower, upper, why_none);
    return found;
  }

  double longest_edge(int64_t node) const {
    double longest = 0;
    edges_.for_each_neighbor(
        node, [&](int64_t other) { longest = std::max(longest, distance_between(xyz_ + 3 * node, xyz_ + 3 * other)); });
    return longest;
  }

 private:
  riis_mesh *mesh_;
  NodeEdges edges_;
  int64_t n_ = 0;
  const double *xyz_ = nullptr;
};

struct Ends {
  int64_t from, to;
};

// Finds the opening at which unmarked nodes first join the ends.
riis_first_passage first_passage_of(const MarkOptions &options, const MarkedMesh &marked, const Ends &ends) {
  riis_passage_ends sets;
  riis_first_passage_options how;
  check(riis_passage_ends_init(&sets, sizeof sets));
  check(riis_first_passage_options_init(&how, sizeof how));
  sets.n_from = sets.n_to = 1;
  sets.from = &ends.from, sets.to = &ends.to;
  riis_mark_options marking = options.mark_options;
  marking.search = RIIS_SEARCH_AUTO;
  marking.distance_limit = RIIS_AUTO;
  how.surface = &options.surface_options;
  how.marking = &marking;
  riis_first_passage first;
  check(riis_find_first_passage(marked.valve, marked.mesh, &sets, &how, &first, sizeof first), "--first-passage");
  return first;
}

riis_passage passage_of(const LeakCheck &asked, const riis_surface *surface, const riis_mesh *mesh,
                        const riis_mark_options &options, Ends ends) {
  riis_mark_options how = options;
  how.search = RIIS_SEARCH_AUTO;
  how.distance_limit = RIIS_AUTO;
  riis_passage_ends sets;
  check(riis_passage_ends_init(&sets, sizeof sets));
  sets.n_from = sets.n_to = 1;
  sets.from = &ends.from;
  sets.to = &ends.to;
  riis_passage passage;
  const riis_status status = riis_find_passage(surface, mesh, &sets, &how, &passage, sizeof passage);
  for (const auto &[argument, name] :
       {std::pair<std::string, const char *>{"ends.from[0]", "FROM"}, {"ends.to[0]", "TO"}}) {
    const std::string text = riis_last_error();
    if (status == RIIS_INVALID_ARGUMENT && text.rfind(argument, 0) == 0)
      throw Refusal{asked.exit_code, asked.subject + ": " + name + text.substr(argument.size())};
  }
  check(status);
  return passage;
}

// --quiet does not silence this warning, because the valve lets flow through.
void warn_of_passage(const LeakCheck &asked, const PassageReport &report, const std::string &surface,
                     const std::string &unknown) {
  const std::string ends = text_of(asked.from) + " and " + text_of(asked.to);
  const riis_passage &found = report.found;
  if (report.is_unknown)
    warn("whether unmarked nodes join " + ends + " is unknown: " + unknown);
  else if (found.state == RIIS_PASSAGE_NONE)
    warn("nothing to seal: the mesh itself does not join " + ends);
  if (found.state != RIIS_PASSAGE_OPEN) return;
  const std::string text = surface + " leaks: unmarked nodes join " + ends + "; the passage is ";
  if (report.is_end)
    warn(text + "nearest to the surface at its end at " + report.place + ", " + shown(found.distance) +
         " from the surface");
  else if (report.closing_half_thickness > 0)
    warn({{Cause::leaks, text + "at " + report.place,
           ", and --half-thickness " + shortest(report.closing_half_thickness) + " closes it"}});
  else
    warn(text + "at " + report.place + ", " + shown(found.distance) + " from the surface");
}

}  // namespace

void check_end(const MarkOptions &options, const char *name, const double *point,
               const std::optional<NearestNode> &nearest, const double *lower, const double *upper,
               const std::string &why_none) {
  // A point inside a cell is at most one edge length away from one of the cell's nodes. This limit allows two.
  constexpr double edges_away = 2;
  const LeakCheck &asked = *options.check_leaks;
  const auto refuse = [&](const std::string &why) {
    throw Refusal{asked.exit_code, asked.subject + ": " + name + ", " + text_of(point) + ", " + why};
  };
  if (!nearest) refuse("has no node near it: " + (why_none.empty() ? "no edge joins two nodes of the mesh" : why_none));
  for (int k = 0; k < 3; ++k)
    if (point[k] < lower[k] || point[k] > upper[k])
      refuse("is outside the mesh, which goes from " + place_text(options, lower, nearest->longest_edge) + " to " +
             place_text(options, upper, nearest->longest_edge));
  if (nearest->distance > edges_away * nearest->longest_edge)
    refuse("is outside the mesh: the nearest node, " + nearest->name + ", is " + shown(nearest->distance) +
           " away, its longest edge " + shown(nearest->longest_edge));
}

namespace {

std::optional<riis_orifice> orifice_of(const riis_surface *surface) {
  riis_orifice orifice;
  check(riis_surface_get_orifice(surface, nullptr, &orifice, sizeof orifice));
  return orifice.outline == RIIS_OUTLINE_NONE ? std::nullopt : std::optional(orifice);
}

riis_cells_across cells_across_of(const riis_marks *marks, const riis_mesh *mesh) {
  riis_cells_across cells;
  check(riis_marks_get_cells_across(marks, mesh, &cells, sizeof cells));
  return cells;
}

}  // namespace

void measure_surface(const MarkOptions &options, const riis_surface *surface, Report &report) {
  FlowReport &flow = report.flow;
  report.prints_flow = options.measures;
  flow.orifice = orifice_of(surface);
  if (options.resistance && *options.resistance > 0) {
    riis_resistance how;
    check(riis_resistance_init(&how, sizeof how));
    how.R = *options.resistance;
    double leak = 0;
    check(riis_surface_get_leak(surface, &how, 1, &leak), "--resistance");
    flow.leak_per_drop = leak;
    flow.drop = options.drop;
  }
}

void measure_flow(const MarkOptions &options, const MarkedMesh &marked, Report &report) {
  if (!options.measures && options.stats.empty()) return;
  const Stage stage("measuring the band", options.quiet);
  measure_surface(options, marked.surface, report);
  FlowReport &flow = report.flow;
  if (report.leaks.has_all_edges()) {
    const JoinedNodes nodes(marked, options.mark_options.n_threads);
    flow.cells = cells_across_of(marked.result, marked.mesh);
    int64_t n_nodes = 0, n_regions = 0;
    check(riis_vtk_mesh_get_nodes(marked.file, &n_nodes, nullptr, nullptr));
    std::vector<int64_t> regions(static_cast<std::size_t>(n_nodes));
    check(riis_label_open_regions(marked.mesh, marked.result, &options.mark_options, n_nodes, regions.data(),
                                  &n_regions));
    flow.n_open_regions = n_regions;
  }
  report.seconds.leaks += stage.seconds();
}

LeakCheck leak_check_between(const std::vector<std::string> &points) {
  LeakCheck made;
  made.subject = "--between";
  const std::vector<double> from = parse_list(points[0], made.subject, 3, "X,Y,Z"),
                            to = parse_list(points[1], made.subject, 3, "X,Y,Z");
  std::copy_n(from.begin(), 3, made.from);
  std::copy_n(to.begin(), 3, made.to);
  return made;
}

void judge_passage(const MarkOptions &options, const riis_valve *valve, const std::string &surface_name,
                   PassageReport passage, double longest_edge, const Left &left, Report &report) {
  const riis_passage &found = passage.found;
  const std::string unknown = why_unknown(report.leaks, options.mesh);
  // Unknown edges cannot close an open path, but they may open a path where the known edges have none.
  passage.is_unknown = found.state != RIIS_PASSAGE_OPEN && !unknown.empty();
  if (found.state == RIIS_PASSAGE_OPEN && !passage.is_end && unknown.empty())
    passage.closing_half_thickness = closing_half_thickness(valve, found.distance, left);
  if (found.node_id >= 0) passage.place = place_text(options, found.point, longest_edge);
  warn_of_passage(*options.check_leaks, passage, surface_name, unknown);
  report.leaks.passage = passage;
}

void check_passage(const MarkOptions &options, const MarkedMesh &marked, Report &report) {
  if (!options.check_leaks) return;
  const Stage stage("looking for a passage", options.quiet);
  const LeakCheck &asked = *options.check_leaks;
  const JoinedNodes nodes(marked, options.mark_options.n_threads);
  LeakReport &leaks = report.leaks;
  check(riis_vtk_mesh_get_volume_cells(marked.file, &leaks.n_volume_cells, &leaks.n_cells_left_out));
  const std::string unknown = why_unknown(leaks, options.mesh);
  const Ends ends{nodes.nearest(options, "FROM", asked.from, unknown), nodes.nearest(options, "TO", asked.to, unknown)};
  PassageReport passage;
  passage.found = passage_of(asked, marked.surface, marked.mesh, options.mark_options, ends);
  passage.is_end = passage.found.node_id == ends.from || passage.found.node_id == ends.to;
  const double longest = passage.found.node_id >= 0 ? nodes.longest_edge(passage.found.node_id) : 0;
  judge_passage(
      options, marked.valve, marked.surface_name, passage, longest,
      [&](double wanted) {
        const Surface surface = with_half_thickness(options, marked.valve, wanted);
        const riis_passage left = passage_of(asked, surface.get(), marked.mesh, options.mark_options, ends);
        return left.state == RIIS_PASSAGE_CLOSED ? std::nullopt : std::optional(left.distance);
      },
      report);
  if (options.first_passage && !marked.valve)
    throw Refusal{exit_wrong_usage, "--first-passage needs a valve; a surface from a file does not open"};
  if (options.first_passage && unknown.empty()) report.flow.first = first_passage_of(options, marked, ends);
  report.seconds.leaks += stage.seconds();
}

Surface joined_for_passage(const Case &all, const std::vector<MovingValve> &valves) {
  if (!all.options.check_leaks || valves.size() == 1) return nullptr;
  const MovingValve &first = valves[0];
  riis_surface_options together;
  check(riis_surface_options_init(&together, sizeof together));
  for (const MovingValve &valve : valves) {
    riis_surface_info info;
    check(riis_surface_get_info(valve.surface(), &info, sizeof info));
    if (&valve == &first) together.half_thickness = info.half_thickness;
    if (info.half_thickness != together.half_thickness)
      throw Refusal{all.options.check_leaks->exit_code,
                    all.options.check_leaks->subject + ": the valves must have one half thickness; that of " +
                        first.options().prefix + " is " + shown(together.half_thickness) + ", that of " +
                        valve.options().prefix + " " + shown(info.half_thickness)};
  }
  return joined_surface(valves, &together);
}

void check_passage_of(const Case &all, const std::vector<MovingValve> &valves, riis_mesh *mesh,
                      const riis_vtk_mesh *file, Report &report) {
  if (!all.options.check_leaks) return;
  const MovingValve &first = valves[0];
  if (valves.size() == 1)
    return check_passage(first.options(),
                         {first.surface(), first.source().valve.get(), file, mesh, nullptr, "the surface"}, report);
  const Surface joined = joined_for_passage(all, valves);
  check_passage(all.options, {joined.get(), nullptr, file, mesh, nullptr, "the surface of all valves"}, report);
}

void measure_bands(const Case &all, const std::vector<MovingValve> &valves, riis_mesh *mesh, const riis_vtk_mesh *file,
                   Report &report) {
  if (!all.options.check_leaks || !report.leaks.has_all_edges()) return;
  report.valve_flows.resize(valves.size());
  const JoinedNodes nodes({valves[0].surface(), nullptr, file, mesh, nullptr}, all.options.mark_options.n_threads);
  for (std::size_t i = 0; i < valves.size(); ++i)
    report.valve_flows[i].flow.cells = cells_across_of(valves[i].result(), mesh);
}

void measure_orifices(const Case &all, const std::vector<MovingValve> &valves, Report &report) {
  if (!all.options.check_leaks) return;
  report.valve_flows.resize(valves.size());
  for (std::size_t i = 0; i < valves.size(); ++i) {
    ValveFlow &measured = report.valve_flows[i];
    measured.name = all.part_of(i);
    if (valves[i].source().valve) measured.opening = valves[i].opening();
    measured.flow.orifice = orifice_of(valves[i].surface());
  }
}

}  // namespace riis::program
