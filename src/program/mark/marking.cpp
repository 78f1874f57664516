// SPDX-License-Identifier: Apache-2.0
#include "program/mark/marking.hpp"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "program/base/handles.hpp"
#include "program/base/progress.hpp"
#include "program/base/ranks.hpp"
#include "program/input/wall.hpp"
#include "program/svmultiphysics/uris_solver.hpp"

namespace riis::program {
namespace {

// Joins all valves, at their present positions, to one surface. Returns null for one valve. Refuses valves with different half
// thicknesses or offsets.
Surface joined_for_passage(const Case &all, const std::vector<MovingValve> &valves) {
  if (valves.size() == 1) return nullptr;
  const riis_surface_options together = with_band_of(valves[0].surface());
  for (const MovingValve &valve : valves) {
    const auto demand_equal = [&](const std::string &what, double of_first, double own) {
      if (own == of_first) return;
      all.options.check_leaks->refuse("the valves must have one " + what + "; that of " + valves[0].options().prefix +
                                      " is " + shown(of_first) + ", that of " + valve.options().prefix + " " +
                                      shown(own));
    };
    const riis_surface_options own = with_band_of(valve.surface());
    demand_equal("offset", together.offset, own.offset);
    demand_equal("half thickness", together.half_thickness, own.half_thickness);
  }
  return joined_surface(surfaces_of(valves), together);
}

// Adds the numbers of a piece or of a rank to the sums. The nodes are counted by NodeCounts.
void combine(riis_mark_stats &all, const riis_mark_stats &stats) {
  if (stats.n_threads == 0) return;  // a rank without pieces
  all.complete = (all.n_threads == 0 || all.complete) && stats.complete;
  if (all.n_threads == 0) all.search = stats.search;
  all.n_unreached += stats.n_unreached;
  all.n_threads = std::max(all.n_threads, stats.n_threads);
}

// Returns whether the closed area can be measured. The band must have no offset, and the valve must be closed or come from a
// file.
bool is_closed(const MovingValve &valve) {
  return valve.opening().value_or(0) == 0 && valve.options().surface_options.offset == 0;
}

void report_leak(const MovingValve &valve, FlowReport &flow) {
  const std::optional<double> &R = valve.options().resistance;
  if (!R || !(*R > 0)) return;
  auto how = defaults<riis_resistance>();
  how.R = *R;
  double leak = 0;
  check(riis_surface_get_leak(valve.surface(), &how, 1, &leak), "--resistance");
  if (flow.closed_area) leak = info_of(valve.surface()).half_thickness / *R * *flow.closed_area;
  // The leak is given per unit of pressure, which is Pa if the unit of the mesh is known.
  const std::optional<Unit> &unit = valve.options().unit;
  flow.leak_per_drop = unit ? leak * factor_from_si(a_pressure, *unit) : leak;
}

// Returns the surface of a valve at its present position, converted to another unit.
Surface surface_in_unit(const MovingValve &valve, const PossibleUnit &unit) {
  riis_surface_options how = valve.options().surface_options;
  const double factor = unit.scale / how.scale;
  how.scale = unit.scale;
  how.half_thickness = unit.half_thickness;
  for (double &shift : how.translation) shift *= unit.placement;
  if (valve.source().valve) return create<Surface>(riis_surface_create, valve.source().valve, &how);
  auto from_present = defaults<riis_surface_options>();
  from_present.scale = factor;
  from_present.half_thickness = unit.half_thickness;
  for (int k = 0; k < 3; ++k) from_present.translation[k] = how.translation[k] - factor * how.translation[k];
  return joined_surface({valve.surface()}, from_present);
}

// Moves each valve to the time with the least or the largest opening, as `order` says. Among times with equal openings, chooses
// the first time. Leaks are judged when a valve is least open, because an open valve is not meant to stop the flow.
template <class Order>
void move_to_first(const std::vector<double> &times, std::vector<MovingValve> &valves, Order order) {
  for (MovingValve &valve : valves) {
    const OpeningLaw &law = valve.source().law;
    valve.move_to(
        *std::min_element(times.begin(), times.end(), [&](double a, double b) { return order(law.at(a), law.at(b)); }));
  }
}

}  // namespace

Marking::Marking(Case &all, const MeshPieces &mesh)
    : all_(all),
      mesh_(mesh),
      valves_(moving_valves(all)),
      times_(all.times()),
      wants_measures_(options().measures || !options().stats.empty() || options().check_leaks),
      node_counts_((times_.size() + 1) * valves_.size()),
      passage_(valves_.size() == 1 ? valves_[0].options() : options(), mesh) {
  report_.options = &options();
  report_.seconds = all.seconds;
  move_to_first(times_, valves_, std::less<>());
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    if (valves_[i].opening() == 0.0)
      warn_of_bridged_gap(valves_[i].options(), valves_[i].source().valve, all_.part_of(i));
    report_.valves.push_back(report_of(i));
    sums_.push_back({MeshLeaks(valves_[i], mesh, all.surface_of(i))});
    if (report_.has_mesh()) sums_[i].outside.push_back(outside_of(i));
  }
  if (!report_.has_mesh()) return;
  // The leaflets of the closed valve or of the open valve may reach beyond the wall.
  move_to_first(times_, valves_, std::greater<>());
  for (std::size_t i = 0; i < valves_.size(); ++i)
    if (valves_[i].opening() != report_.valves[i].opening) sums_[i].outside.push_back(outside_of(i));
  move_to_first(times_, valves_, std::less<>());
}

bool Marking::has_marks() const {
  return std::any_of(n_marked_.begin(), n_marked_.end() - view(valves_).size(), [](std::int64_t n) { return n > 0; });
}

std::int32_t Marking::fields() const {
  if (!all_.is_series()) return 0;
  return RIIS_FIELD_NORMAL | RIIS_FIELD_SIDE | (has_velocities() ? RIIS_FIELD_VELOCITY : 0);
}

// Refuses to replace an array of the mesh unless the user gave --replace.
void Marking::check_new_arrays(const riis_vtk_mesh *file) const {
  if (options().output.empty() || options().replace) return;
  const auto check_new = [&](const std::string &prefix, std::initializer_list<const char *> ends) {
    for (const char *const end : ends) {
      const std::string name = prefix + end;
      int32_t has = 0;
      check(riis_vtk_mesh_has_point_array(file, name.c_str(), &has));
      if (!has) continue;
      refuse_usage(options().mesh + " already has an array " + name +
                   ": write --replace to replace it, or --prefix NAME for other arrays beside it");
    }
  };
  for (const ValveSource &valve : all_.valves) {
    check_new(valve.options.prefix, {"_marked", "_distance", "_leaflet"});
    if (all_.is_series()) check_new(valve.options.prefix, {"_normal", "_side"});
    if (has_velocities()) check_new(valve.options.prefix, {"_velocity"});
  }
  if (all_.has_resistance()) check_new(options().prefix, {"_K"});
  if (all_.has_resistance() && has_velocities()) check_new(options().prefix, {"_K_u_surface"});
  if (all_.is_series() && !options().series.all_cells && options().cells_where.empty()) check_new("riis_node_id", {""});
}

ValveReport Marking::report_of(std::size_t i) {
  const MovingValve &valve = valves_[i];
  const MarkOptions &own = valve.options();
  ValveReport report;
  report.options = &own;
  report.name = all_.part_of(i);
  report.surface_name = own.surface.empty() ? own.valve : own.surface;
  report.opening = valve.opening();
  if (!all_.is_series()) report.time = own.time;
  report.surface = info_of(valve.surface());
  if (!own.leaflets.empty() || own.surface_files.size() > 1)
    report.n_leaflets = count_leaflets(valve.surface()) - (report.surface.skirt_leaflet_id >= 0 ? 1 : 0);
  if (own.skirt && !own.surface.empty()) report.attached = attached_edges_of(valve.surface());
  if (own.skirt && !own.wall.empty()) report.gap = gap_to_wall(own, valve.surface());
  report.crossings = valve.crossings;
  report_.seconds.surface += report.surface.seconds_triangles;
  report_.seconds.scene += report.surface.seconds_scene;
  return report;
}

// ---- Times ----

void Marking::move_to_step(std::size_t step) {
  const double time = times_[step];
  std::optional<double> since;
  if (has_velocities()) since = step == 0 ? time - (times_[1] - time) : times_[step - 1];
  for (MovingValve &valve : valves_) valve.move_to(time, since);
}

void Marking::mark_step(FileNodes &nodes, riis_vtk_mesh *file, std::size_t step) {
  move_to_step(step);
  for (MovingValve &valve : valves_) valve.mark(nodes, fields());
  set_arrays(file);
}

// ---- Marks of a piece ----

void Marking::measure(Piece &piece) {
  counts_.add(piece);
  add_loose_nodes(piece, loose_);
  if (piece.n() == 0) return;
  check_new_arrays(piece.file.get());
  find_neighbors_for_search(piece);
  for (MovingValve &valve : valves_) valve.forget_marks();
  mark_at_all_times(piece);
  if (all_.is_series()) {
    move_to_first(times_, valves_, std::less<>());
    for (MovingValve &valve : valves_) valve.mark(piece, 0);
  }
  const Stage stage("looking for leaks", options().quiet);
  // The neighbours are used only if all edges of the piece are known.
  const riis_vtk_sharing &cells = piece.counts();
  const bool has_edges = cells.n_cells_left_out == 0 && (cells.n_volume_cells > 0 || !mesh_.is_whole());
  if (options().check_leaks || (wants_measures_ && has_edges)) piece.find_neighbors(options().mark_options.n_threads);
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    ValveSums &sums = sums_[i];
    combine(sums.marks, valves_[i].stats());
    sums.leaks.add(piece, valves_[i].result());
    for (LeafletsOutside &state : sums.outside) state.add(piece);
    node_counts_.add(piece, list_of(valves_[i].result(), RIIS_LIST_WITHIN_LIMIT), within_limit(i));
    std::vector<std::int64_t> regions;
    if (wants_measures_ && piece.is_whole() && is_closed(valves_[i])) {
      // Minimisation may end at a point that is not the nearest point, so its distances may be too large by any length.
      const bool is_exact = valves_[i].options().surface_options.measure != RIIS_MEASURE_MINIMIZATION;
      report_.valves[i].flow.closed_area =
          closed_area_in(piece.file.get(), valves_[i].surface(), options().mark_options.n_threads,
                         is_exact ? 0 : std::numeric_limits<double>::infinity());
    }
    if (wants_measures_ && has_edges) regions = sums.band.add(piece, valves_[i].result(), options().mark_options);
    if (i == 0 || !regions.empty()) sums.shared.push_back(shared_nodes_of(piece, regions));
  }
  passage_.add(piece);
  report_.seconds.leaks += stage.seconds();
  if (!all_.is_series() && (!options().output.empty() || !options().pictures.empty())) set_arrays(piece.file.get());
}

void Marking::find_neighbors_for_search(Piece &piece) {
  if (!needs_adjacency(options().mark_options.search)) return;
  if (piece.is_grid())
    refuse_usage(
        "--search: " + options().mesh +
        " is a grid, whose nodes are not stored, so this search cannot walk from node to node; leave --search out");
  const Stage stage("finding the nodes' neighbours", options().quiet);
  piece.find_neighbors(options().mark_options.n_threads);
  report_.seconds.adjacency += stage.seconds();
}

// In a series, also stores the nodes near the moving valve, and enlarges the box around the whole motion.
void Marking::mark_at_all_times(Piece &piece) {
  const Stage stage("marking", options().quiet || all_.is_series());
  std::vector<std::uint8_t> is_near(all_.is_series() ? static_cast<std::size_t>(piece.n()) : 0);
  std::optional<StepProgress> progress;
  if (all_.is_series()) progress.emplace("finding the nodes near the moving valve", times_.size(), options().quiet);
  for (std::size_t step = 0; step < times_.size(); ++step) {
    if (progress) progress->begin(step);
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      valves_[i].move_to(times_[step]);
      valves_[i].mark(piece, 0);
      node_counts_.add(piece, list_of(valves_[i].result(), RIIS_LIST_MARKED), marked_at(step, i));
      if (!all_.is_series()) continue;
      const riis_mark_list within = list_of(valves_[i].result(), RIIS_LIST_WITHIN_LIMIT);
      for (std::int64_t k = 0; k < within.n_nodes; ++k) view(is_near)[within.node_id[k]] = 1;
      if (!options().series.movie.empty()) swept_.grow(box_of(info_of(valves_[i].surface())));
    }
  }
  near_.clear();
  for (std::size_t node = 0; node < is_near.size(); ++node)
    if (is_near[node]) near_.push_back(static_cast<std::int64_t>(node));
  report_.seconds.search += stage.seconds();
}

void Marking::set_arrays(riis_vtk_mesh *file) const {
  const std::int64_t n_nodes = valves_[0].stats().n_nodes;
  // K is the sum over all valves with a resistance. These valves have the same units.
  std::vector<double> K(all_.has_resistance() ? static_cast<std::size_t>(n_nodes) : 0);
  std::vector<double> K_u_surface(has_velocities() ? 3 * K.size() : 0);
  const MarkOptions *with_units = &options();
  for (const MovingValve &valve : valves_) {
    const MarkOptions &own = valve.options();
    check(riis_vtk_mesh_set_marks(file, valve.result(), own.far_distance, own.prefix.c_str()));
    check(riis_vtk_mesh_set_fields(file, valve.result(), fields(), own.prefix.c_str()));
    if (!own.resistance) continue;
    add_resistance(own, valve.result(), K, K_u_surface);
    with_units = &own;
  }
  const auto set = [&](const char *end, std::int64_t n_components, const std::vector<double> &values,
                       const std::string &unit) {
    const std::string name = options().prefix + end;
    if (values.empty()) return;
    check(riis_vtk_mesh_set_point_array(file, name.c_str(), n_nodes, n_components, values.data()));
    if (!unit.empty()) check(riis_vtk_mesh_set_unit(file, name.c_str(), unit.c_str()));
  };
  set("_K", 1, K, with_units->K_unit);
  set("_K_u_surface", 3, K_u_surface, with_units->K_u_surface_unit);
}

// ---- Results of all pieces ----

void Marking::judge() {
  const MeshCounts counts = sum_of(counts_, mesh_);
  std::vector<MatchedNodes> matched;
  for (ValveSums &sums : sums_)
    matched.push_back(match_nodes(std::move(sums.shared), counts.n_with_ids > 0, mesh_.files()));
  check_loose_nodes(loose_, mesh_);
  const std::int64_t n_nodes = counts.n_nodes + matched[0].n_nodes;
  n_marked_ = node_counts_.sums();
  report_.n_cells = counts.n_cells;
  for (std::size_t i = 0; i < valves_.size(); ++i) report_marks(i, n_nodes, counts);
  if (counts.n_with_nodes > 1 && matched[0].n_in_several == 0 && counts.n_volume_cells > 0)
    warn("the pieces of " + mesh_.path() +
         " share no node, so nothing passes from one to another: nodes are the same if their global ids or all their "
         "coordinates are equal");
  mesh_.warn_of_regions();
  warn_of_marks(n_nodes, counts);
  for (std::size_t i = 0; i < valves_.size(); ++i) report_outside(i, counts);
  move_to_first(times_, valves_, std::less<>());
  const Stage stage("looking for leaks", options().quiet);
  for (std::size_t i = 0; i < valves_.size(); ++i) sums_[i].leaks.judge(report_.valves[i]);
  for (std::size_t i = 0; wants_measures_ && i < valves_.size(); ++i) {
    ValveReport &valve = report_.valves[i];
    if (valve.leaks.has_all_edges()) sums_[i].band.judge(matched[i], valve.surface.half_thickness, valve.flow);
    report_leak(valves_[i], valve.flow);
  }
  if (options().check_leaks) {
    const Surface joined = joined_for_passage(all_, valves_);
    passage_.judge(joined ? joined : valves_[0].surface(), joined ? nullptr : valves_[0].source().valve.get(),
                   joined ? "the surface of all valves" : "the surface", counts, report_);
  }
  report_orifices();
  report_.seconds.leaks += stage.seconds();
}

// Fills the report of a valve. Its counts of marks belong to the valve's least opening.
void Marking::report_marks(std::size_t i, std::int64_t n_nodes, const MeshCounts &counts) {
  ValveReport &report = report_.valves[i];
  const MovingValve &valve = valves_[i];
  riis_mark_stats &stats = report.marks;
  for (const riis_mark_stats &of_rank : ranks::gather(std::vector<riis_mark_stats>{sums_[i].marks}))
    combine(stats, of_rank);
  stats.n_nodes = n_nodes;
  std::size_t least = 0, most = 0;
  for (std::size_t step = 0; step < times_.size(); ++step) {
    const OpeningLaw &law = valve.source().law;
    if (law.at(times_[step]) < law.at(times_[least])) least = step;
    if (n_marked_[marked_at(step, i)] > n_marked_[marked_at(most, i)]) most = step;
  }
  sums_[i].most_step = most;
  stats.n_marked = n_marked_[marked_at(least, i)];
  stats.n_within_limit = n_marked_[within_limit(i)];
  report.leaks.n_volume_cells = counts.n_volume_cells;
  report.leaks.n_cells_left_out = counts.n_cells_left_out;
}

// Warns of suspicious marks. The state at which a valve marks the most nodes decides for each valve.
void Marking::warn_of_marks(std::int64_t n_nodes, const MeshCounts &counts) {
  std::vector<Warning> warnings;
  bool are_complete = true;
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    are_complete = are_complete && report_.valves[i].marks.complete;
    valves_[i].move_to(times_[sums_[i].most_step]);
    Situation situation(valves_[i].options(), info_of(valves_[i].surface()), counts);
    situation.n_nodes = n_nodes;
    situation.n_marked = n_marked_[marked_at(sums_[i].most_step, i)];
    auto warning = warning_of(situation);
    compare_units(i, units_left_open(situation));
    if (!warning) continue;
    if (warning->cause == Cause::units) all_.options.has_doubted_unit = all_.valves[i].options.has_doubted_unit = true;
    warning->text.insert(0, all_.before(i));
    warnings.push_back(*warning);
  }
  if (!are_complete)
    warn(
        "the marks may be incomplete: --search paper misses nodes that are not connected to its start node; --search "
        "neighbor finds these nodes");
  warn(warnings);
}

// Reports the state with the largest share outside the mesh. Warns only if at least a part of the valve is in the mesh.
void Marking::report_outside(std::size_t i, const MeshCounts &counts) {
  if (counts.n_volume_cells == 0) return;
  std::optional<OutsideReport> &report = report_.valves[i].outside;
  std::optional<OutsideReport> closed;
  for (const LeafletsOutside &state : sums_[i].outside) {
    const OutsideReport found = state.report();
    if (found.opening == 0.0) closed = found;
    if (!report || found.share > report->share) report = found;
  }
  // A valve that is open at all times may stand inside the mesh when it is closed. Some sizes allow no closed valve.
  const MovingValve &valve = valves_[i];
  if (report->share > most_outside && !closed && valve.source().valve) {
    const Valve copy = copy_of(valve.source().valve);
    if (const Surface surface = surface_at(copy, 0, valve.options().surface_options)) {
      LeafletsOutside state(valve.options(), surface, 0);
      mesh_.for_each_own([&](const Piece &piece) { state.add(piece); });
      closed = state.report();
    }
  }
  if (report->opening == report_.valves[i].opening) report->opening.reset();
  if (n_marked_[marked_at(sums_[i].most_step, i)] > 0)
    warn_of_outside(*report, closed, report_.valves[i].surface.half_thickness, all_.surface_of(i));
}

void Marking::compare_units(std::size_t i, const std::vector<PossibleUnit> &units) const {
  if (units.empty()) return;
  std::string text;
  for (const PossibleUnit &unit : units) {
    const Surface surface = surface_in_unit(valves_[i], unit);
    NodeCounts counts(1);
    mesh_.for_each_own([&](Piece &piece) {
      if (piece.n() == 0) return;
      const Marks marks = marks_of(surface, piece.mesh(), how_to_mark_again(options()));
      counts.add(piece, list_of(marks, RIIS_LIST_MARKED), 0);
    });
    text += (text.empty() ? "" : ", ") + unit.write + " marks " + counted(counts.sums()[0], "node");
  }
  print_line(all_.before(i) + "the unit is not sure: " + text);
}

// Measures the areas of the orifices. In a series, each valve is measured at its largest opening.
void Marking::report_orifices() {
  if (!wants_measures_) return;
  move_to_first(times_, valves_, std::greater<>());
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const auto orifice = get<riis_orifice>(riis_surface_get_orifice, valves_[i].surface(), nullptr);
    if (orifice.outline == RIIS_OUTLINE_NONE) continue;
    report_.valves[i].flow.orifice = orifice;
    if (all_.is_series() || valves_.size() > 1) report_.valves[i].flow.orifice_opening = valves_[i].opening();
  }
}

}  // namespace riis::program
