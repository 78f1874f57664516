// SPDX-License-Identifier: Apache-2.0
#include "program/marking_run.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "program/band.hpp"
#include "program/case_file.hpp"
#include "program/leaks.hpp"
#include "program/marked_files.hpp"
#include "program/mesh_marking.hpp"
#include "program/mesh_reading.hpp"
#include "program/moving_valve.hpp"
#include "program/outputs.hpp"
#include "program/passage.hpp"
#include "program/pictures.hpp"
#include "program/progress.hpp"
#include "program/ranks.hpp"
#include "program/warnings.hpp"

namespace riis::program {
namespace {

void refuse_option(const std::string &option, const std::string &why) { refuse_usage(option + ": " + why); }

// Refuses options that need the whole mesh at once.
void check_options_of_pieces(const MarkOptions &options) {
  const auto refuse_if = [&](bool is_given, const std::string &option, const std::string &why) {
    if (is_given) refuse_option(option, why + ", and " + options.mesh + " is read in pieces");
  };
  refuse_if(!options.pictures.empty(), "--picture", "a picture needs the whole mesh");
  refuse_if(!options.series.movie.empty(), "--movie", "a movie needs the whole mesh");
  refuse_if(options.at_cells, "--cells", "cells at the border of a piece have neighbours in another piece");
  refuse_if(options.n_steps > 0, "--steps", "steps are timed in the whole mesh");
  refuse_if(options.mark_options.search == RIIS_SEARCH_PAPER, "--search paper",
            "this search walks through the whole mesh");
}

// Refuses options that have an effect only in a series, if there is no series.
void check_one_time(const MarkOptions &options) {
  const SeriesOptions &series = options.series;
  const auto refuse_if = [&](bool is_given, const std::string &option) {
    if (is_given) refuse_usage(option + " needs times: " + series.case_file + " has none, and --times is not given");
  };
  refuse_if(!series.movie.empty(), "--movie");
  refuse_if(!series.table.empty(), "--series-table");
  refuse_if(series.all_cells && !options.at_cells, "--all-cells");
}

// Refuses --first-passage unless there is one valve that opens.
void check_first_passage(const Case &all) {
  if (!all.options.first_passage) return;
  if (!all.valves[0].options.surface.empty())
    refuse_usage("--first-passage needs a valve; a surface from a file does not open");
  if (all.valves.size() > 1)
    refuse_usage("--first-passage takes one valve, because each of several may close the way of another");
}

// Returns one surface of all valves at their present positions, or null for one valve. Refuses valves of different half
// thicknesses.
Surface joined_for_passage(const Case &all, const std::vector<MovingValve> &valves) {
  if (valves.size() == 1) return nullptr;
  const MovingValve &first = valves[0];
  riis_surface_options together;
  check(riis_surface_options_init(&together, sizeof together));
  together.half_thickness = info_of(first.surface()).half_thickness;
  for (const MovingValve &valve : valves) {
    const double half_thickness = info_of(valve.surface()).half_thickness;
    if (half_thickness != together.half_thickness)
      throw Refusal{all.options.check_leaks->exit_code,
                    all.options.check_leaks->subject + ": the valves must have one half thickness; that of " +
                        first.options().prefix + " is " + shown(together.half_thickness) + ", that of " +
                        valve.options().prefix + " " + shown(half_thickness)};
  }
  return joined_surface(valves, &together);
}

// Returns a text such as "12.3 MB".
std::string bytes_text(double n) {
  const char *const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  for (; n >= 1000 && unit < 5; ++unit) n /= 1000;
  char text[32];
  std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.3g %s", n, units[unit]);
  return text;
}

MeshFile part_of(const riis_vtk_mesh *file, const std::vector<std::int64_t> &node_ids) {
  riis_vtk_mesh *part = nullptr;
  check(riis_vtk_mesh_extract(file, view(node_ids).size(), node_ids.data(), &part));
  return MeshFile(part);
}

MeshFile copy_of(const riis_vtk_mesh *file, std::int64_t n_nodes) {
  std::vector<std::int64_t> all(static_cast<std::size_t>(n_nodes));
  std::iota(all.begin(), all.end(), 0);
  return part_of(file, all);
}

// Adds the numbers of a piece or a rank to those of others. The numbers of nodes are counted by NodeCounts.
void combine(riis_mark_stats &all, const riis_mark_stats &stats) {
  if (all.n_threads == 0) all.search = stats.search;
  all.complete = all.complete && stats.complete;
  all.n_unreached += stats.n_unreached;
  all.n_threads = std::max(all.n_threads, stats.n_threads);
}

riis_mark_stats no_stats() {
  riis_mark_stats none{};
  none.complete = 1;
  return none;
}

// What one valve needs of all pieces.
struct ValveSums {
  MeshLeaks leaks;
  riis_mark_stats marks = no_stats();
  BandMeasures band{};
  std::vector<std::vector<SharedNode>> shared{};  // by piece, with the open regions of this valve
};

void write_stats(const MarkOptions &options, const Report &report) {
  if (!options.stats.empty()) write_text(options.stats, json_of(report));
}

class MarkingRun {
 public:
  MarkingRun(Case &all, const MeshPieces &mesh)
      : all_(all),
        mesh_(mesh),
        valves_(moving_valves(all)),
        times_(all.times()),
        names_(names_of_arrays()),
        wants_measures_(options().measures || !options().stats.empty() || options().check_leaks),
        files_(all, mesh),
        surfaces_(all.is_series() ? options().surface_output : "", ".vtp", times_.size()),
        node_counts_((times_.size() + 1) * valves_.size()),
        most_steps_(valves_.size()),
        seconds_(times_.size()),
        passage_(valves_.size() == 1 ? valves_[0].options() : options(), mesh) {
    report_.times = options().series.times;
    report_.seconds = all.seconds;
    report_.prints_flow = options().measures || options().check_leaks;
    move_to_least_openings();
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      report_.valves.push_back(report_of(i));
      sums_.push_back({MeshLeaks(valves_[i].options(), mesh, valves_[i].surface(), valves_[i].source().valve.get(),
                                 all.surface_of(i))});
    }
  }

  // Returns whether all steps are complete. A signal stops a series.
  bool run() {
    if (options().mesh.empty()) {
      write_surface();
      draw(nullptr);
      return true;
    }
    if (!mesh_.is_whole()) begin_writing();
    mesh_.for_each_own(
        [&](Piece &piece) {
          if (UnbrokenWrite::has_signal()) return;
          measure(piece);
          // The warnings about a whole mesh come before its files are written, which may take long.
          if (mesh_.is_whole()) judge();
          write(piece);
        },
        &report_.seconds);
    return mesh_.is_whole() ? n_done_ == times_.size() : finish_pieces();
  }

  const Report &report() const { return report_; }
  std::size_t n_done() const { return n_done_; }
  bool has_marks() const {
    return std::any_of(n_marked_.begin(), n_marked_.end() - view(valves_).size(), [](std::int64_t n) { return n > 0; });
  }

 private:
  const MarkOptions &options() const { return all_.options; }
  bool is_series() const { return all_.is_series(); }
  // A single time has no time before it, and thus no velocities.
  bool has_velocities() const { return times_.size() > 1; }
  std::int32_t fields() const {
    if (!is_series()) return 0;
    return RIIS_FIELD_NORMAL | RIIS_FIELD_SIDE | (has_velocities() ? RIIS_FIELD_VELOCITY : 0);
  }

  std::vector<std::string> names_of_arrays() const {
    std::vector<std::string> names;
    for (const ValveSource &valve : all_.valves) {
      const std::vector<std::string> own = names_of_marks(valve.options.prefix, fields());
      names.insert(names.end(), own.begin(), own.end());
    }
    if (all_.has_resistance()) names.push_back(options().prefix + "_K");
    if (all_.has_resistance() && has_velocities()) names.push_back(options().prefix + "_K_u_surface");
    if (is_series() && !options().series.all_cells) names.emplace_back("riis_node_id");
    return names;
  }

  // Returns the report of a valve's surface at its present position.
  ValveReport report_of(std::size_t i) {
    const MovingValve &valve = valves_[i];
    const MarkOptions &own = valve.options();
    ValveReport report;
    report.name = all_.part_of(i);
    report.surface_name = own.surface.empty() ? own.valve : own.surface;
    report.opening = valve.opening();
    if (!is_series()) report.time = own.time;
    if (!own.leaflets.empty()) report.n_leaflets = count_leaflets(valve.surface());
    report.surface = info_of(valve.surface());
    if (valve.opening() && !own.wall.empty()) report.gap = gap_to_wall(own, valve.surface());
    report.crossings = valve.crossings;
    report_.seconds.surface += report.surface.seconds_triangles;
    report_.seconds.scene += report.surface.seconds_scene;
    return report;
  }

  // ---- Times ----

  // Moves each valve to the time at which its opening comes first in an order, and to the first such time if there are several.
  template <class Order>
  void move_to_first(Order order) {
    for (MovingValve &valve : valves_) {
      const OpeningLaw &law = valve.source().law;
      valve.move_to(*std::min_element(times_.begin(), times_.end(),
                                      [&](double a, double b) { return order(law.at(a), law.at(b)); }));
    }
  }
  // Leaks matter where a valve is least open. An open valve is not meant to stop the flow.
  void move_to_least_openings() { move_to_first(std::less<>()); }
  void move_to_step(std::size_t step) {
    const double time = times_[step];
    for (MovingValve &valve : valves_) {
      if (has_velocities())
        valve.move_to(time, step == 0 ? time - (times_[1] - time) : times_[step - 1]);
      else
        valve.move_to(time);
    }
  }

  // Kinds of node counts: the marked nodes at each step, then those within the limit at the least opening.
  std::size_t marked_at(std::size_t step, std::size_t valve) const { return step * valves_.size() + valve; }
  std::size_t within_limit(std::size_t valve) const { return marked_at(times_.size(), valve); }

  // ---- Marks of a piece ----

  void measure(Piece &piece) {
    counts_.add(piece);
    loose_.add(piece.nodes);
    if (!piece.mesh) return;
    check_new_arrays(options(), names_, piece.file.get());
    find_neighbors_for_search(piece);
    for (MovingValve &valve : valves_) valve.forget_marks();
    mark_at_all_times(piece);
    if (is_series()) mark_at_least_openings(*piece.mesh);
    const Stage stage("looking for leaks", options().quiet);
    // The neighbours are of use only if all edges of the piece are known.
    const riis_vtk_sharing &cells = piece.nodes.counts();
    const bool has_edges = cells.n_cells_left_out == 0 && (cells.n_volume_cells > 0 || !mesh_.is_whole());
    if (options().check_leaks || (wants_measures_ && has_edges))
      piece.mesh->find_neighbors(options().mark_options.n_threads);
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      ValveSums &sums = sums_[i];
      combine(sums.marks, valves_[i].stats());
      sums.leaks.add(piece, valves_[i].result());
      node_counts_.add(piece.nodes, list_of(valves_[i].result(), RIIS_LIST_WITHIN_LIMIT), within_limit(i));
      std::vector<std::int64_t> regions;
      if (wants_measures_ && has_edges) regions = sums.band.add(piece, valves_[i].result(), options().mark_options);
      if (i == 0 || !regions.empty()) sums.shared.push_back(shared_nodes_of(piece, regions));
    }
    passage_.add(piece);
    report_.seconds.leaks += stage.seconds();
    if (!is_series()) set_arrays(piece.file.get());
  }

  void find_neighbors_for_search(Piece &piece) {
    if (!needs_adjacency(options().mark_options.search)) return;
    const Stage stage("finding the nodes' neighbours", options().quiet);
    piece.mesh->find_neighbors(options().mark_options.n_threads);
    report_.seconds.adjacency += stage.seconds();
  }

  // Also notes the nodes near the motion, and the box that contains all of it.
  void mark_at_all_times(Piece &piece) {
    const Stage stage("marking", options().quiet || is_series());
    std::vector<std::uint8_t> is_near(is_series() ? static_cast<std::size_t>(piece.nodes.n()) : 0);
    std::optional<StepProgress> progress;
    if (is_series()) progress.emplace("finding the nodes near the sweep", times_.size(), options().quiet);
    for (std::size_t step = 0; step < times_.size(); ++step) {
      if (progress) progress->begin(step);
      for (std::size_t i = 0; i < valves_.size(); ++i) {
        valves_[i].move_to(times_[step]);
        valves_[i].mark(*piece.mesh, 0);
        node_counts_.add(piece.nodes, list_of(valves_[i].result(), RIIS_LIST_MARKED), marked_at(step, i));
        if (!is_series()) continue;
        const riis_mark_list within = list_of(valves_[i].result(), RIIS_LIST_WITHIN_LIMIT);
        for (std::int64_t k = 0; k < within.n_nodes; ++k) view(is_near)[within.node_id[k]] = 1;
        if (options().series.movie.empty()) continue;
        const riis_surface_info info = info_of(valves_[i].surface());
        swept_.grow(info.lower, info.upper);
      }
    }
    near_.clear();
    for (std::size_t node = 0; node < is_near.size(); ++node)
      if (is_near[node]) near_.push_back(static_cast<std::int64_t>(node));
    report_.seconds.search += stage.seconds();
  }

  void mark_at_least_openings(FileNodes &nodes) {
    move_to_least_openings();
    for (MovingValve &valve : valves_) valve.mark(nodes, 0);
  }

  void set_arrays(riis_vtk_mesh *file) const {
    std::int64_t n_nodes = 0;
    check(riis_vtk_mesh_get_nodes(file, &n_nodes, nullptr, nullptr));
    ResistanceSum resistance(n_nodes,
                             has_velocities() ? ResistanceSum::WithVelocity::yes : ResistanceSum::WithVelocity::no);
    for (const MovingValve &valve : valves_) {
      set_marks(valve.options(), valve.result(), fields(), file);
      resistance.add(valve.options(), valve.result());
    }
    resistance.set_arrays(options().prefix, file);
  }

  // ---- Results of all pieces ----

  void judge() {
    const MeshCounts counts = sum_of(counts_, mesh_);
    std::vector<MatchedNodes> matched;
    for (ValveSums &sums : sums_)
      matched.push_back(match_nodes(std::move(sums.shared), counts.n_with_ids > 0, mesh_.files()));
    loose_.check(mesh_);
    const std::int64_t n_nodes = counts.n_nodes + matched[0].n_nodes;
    n_marked_ = node_counts_.sums();
    report_.mesh_name = options().mesh;
    report_.n_cells = counts.n_cells;
    for (std::size_t i = 0; i < valves_.size(); ++i) report_marks(i, n_nodes, counts);
    warn_of_apart(counts, matched[0], mesh_);
    warn_of_marks(n_nodes, counts);
    if (is_series()) move_to_least_openings();
    const Stage stage("looking for leaks", options().quiet);
    for (std::size_t i = 0; i < valves_.size(); ++i) sums_[i].leaks.judge(report_.valves[i]);
    for (std::size_t i = 0; wants_measures_ && i < valves_.size(); ++i) {
      ValveReport &valve = report_.valves[i];
      if (valve.leaks.has_all_edges()) sums_[i].band.judge(matched[i], valve.surface.half_thickness, valve.flow);
      report_leak(valves_[i], valve.flow);
    }
    if (options().check_leaks) {
      const Surface joined = joined_for_passage(all_, valves_);
      passage_.judge(joined ? joined.get() : valves_[0].surface(), joined ? nullptr : valves_[0].source().valve.get(),
                     joined ? "the surface of all valves" : "the surface", counts, report_);
    }
    report_orifices();
    report_.seconds.leaks += stage.seconds();
  }

  // Fills the report of a valve. The marks are those of its least opening.
  void report_marks(std::size_t i, std::int64_t n_nodes, const MeshCounts &counts) {
    ValveReport &report = report_.valves[i];
    const MovingValve &valve = valves_[i];
    riis_mark_stats &stats = report.marks = no_stats();
    for (const riis_mark_stats &of_rank : ranks::gather(std::vector<riis_mark_stats>{sums_[i].marks}))
      combine(stats, of_rank);
    stats.n_nodes = n_nodes;
    std::size_t least = 0, most = 0;
    for (std::size_t step = 0; step < times_.size(); ++step) {
      const OpeningLaw &law = valve.source().law;
      if (law.at(times_[step]) < law.at(times_[least])) least = step;
      if (n_marked_[marked_at(step, i)] > n_marked_[marked_at(most, i)]) most = step;
    }
    most_steps_[i] = most;
    stats.n_marked = n_marked_[marked_at(least, i)];
    stats.n_within_limit = n_marked_[within_limit(i)];
    const double limit = valve.options().mark_options.distance_limit;
    report.distance_limit = limit > 0 ? limit : report.surface.half_thickness;
    report.distance = valve.options().surface_options.measure;
    report.leaks.n_volume_cells = counts.n_volume_cells;
    report.leaks.n_cells_left_out = counts.n_cells_left_out;
  }

  // Warns of suspicious marks. Judges each valve at the time when it marks most nodes.
  void warn_of_marks(std::int64_t n_nodes, const MeshCounts &counts) {
    std::vector<Warning> warnings;
    bool are_complete = true;
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      are_complete = are_complete && report_.valves[i].marks.complete;
      valves_[i].move_to(times_[most_steps_[i]]);
      const riis_surface_info info = is_series() ? info_of(valves_[i].surface()) : report_.valves[i].surface;
      Situation situation{valves_[i].options(),
                          n_nodes,
                          n_marked_[marked_at(most_steps_[i], i)],
                          counts.box,
                          {},
                          counts.median_edge,
                          info.area,
                          info.half_thickness};
      std::copy_n(info.lower, 3, situation.surface.lower);
      std::copy_n(info.upper, 3, situation.surface.upper);
      auto warning = warning_of(situation);
      if (!warning) continue;
      const std::string part = all_.part_of(i);
      warning->text.insert(0, part.empty() ? "" : part + ": ");
      warnings.push_back(*warning);
    }
    if (!are_complete) warn_of_incomplete_marks();
    warn(warnings);
  }

  static void report_leak(const MovingValve &valve, FlowReport &flow) {
    const std::optional<double> &R = valve.options().resistance;
    if (!R || !(*R > 0)) return;
    riis_resistance how;
    check(riis_resistance_init(&how, sizeof how));
    how.R = *R;
    double leak = 0;
    check(riis_surface_get_leak(valve.surface(), &how, 1, &leak), "--resistance");
    flow.leak_per_drop = leak;
    flow.drop = valve.options().drop;
  }

  // Measures the orifices. In a series, each valve is measured where it is most open.
  void report_orifices() {
    if (!wants_measures_) return;
    if (is_series()) move_to_first(std::greater<>());
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      riis_orifice orifice;
      check(riis_surface_get_orifice(valves_[i].surface(), nullptr, &orifice, sizeof orifice));
      if (orifice.outline == RIIS_OUTLINE_NONE) continue;
      report_.valves[i].flow.orifice = orifice;
      if (is_series() || valves_.size() > 1) report_.valves[i].flow.orifice_opening = valves_[i].opening();
    }
  }

  // ---- Files ----

  void begin_writing() {
    // In a series, a signal such as Ctrl-C waits for the end of a step. So even then the lists are written and the movie's frames
    // are removed.
    if (is_series()) unbroken_.emplace();
    if (ranks::is_first()) {
      files_.make_folder();
      surfaces_.make_folder();
    }
    ranks::agree();
  }

  void write(Piece &piece) {
    if (is_series()) return write_steps(piece);
    if (piece.mesh) piece.mesh->forget_neighbors();
    if (options().n_steps > 0)
      report_.step = time_steps(valves_[0].options(), valves_[0].source().valve.get(), piece.file.get());
    if (mesh_.is_whole()) write_surface();
    const Stage stage("writing", options().quiet);
    files_.write(piece.number, 0, piece.file.get());
    report_.seconds.write += stage.seconds();
    if (!mesh_.is_whole()) return;
    files_.report(report_);
    n_done_ = 1;
    draw(std::move(piece.file));
  }

  void write_surface() {
    if (options().surface_output.empty()) return;
    const Stage stage("writing", options().quiet);
    const UnbrokenWrite unbroken;
    const Surface joined = valves_.size() > 1 ? joined_surface(valves_) : nullptr;
    if (ranks::is_first())
      check(riis_vtk_surface_write(joined ? joined.get() : valves_[0].surface(), options().surface_output.c_str()));
    report_.written.push_back(options().surface_output);
    report_.seconds.write += stage.seconds();
  }

  // Draws the pictures of one time.
  void draw(MeshFile file) {
    if (!RunPictures::are_wanted(options())) return;
    try {
      RunPictures(all_, std::move(file), swept_).draw(0, valves_, report_);
    } catch (const Refusal &) {
      // The statistics are written even if drawing failed, because the marks are valid.
      write_stats(options(), report_);
      throw;
    }
  }

  // Writes the part of a piece at each time. A piece that the valves do not come near has no files.
  void write_steps(Piece &piece) {
    if (!mesh_.is_whole() && !(files_.is_wanted() && piece.mesh)) return;
    if (!unbroken_) unbroken_.emplace();
    const std::int64_t n_of_piece = piece.nodes.n();
    piece.mesh.reset();
    MeshFile file = options().series.all_cells ? std::move(piece.file) : part_of(piece.file.get(), near_);
    std::optional<RunPictures> pictures;
    // Pictures get a mesh of their own, because they show the whole mesh and store other arrays in it.
    if (RunPictures::are_wanted(options()))
      pictures.emplace(all_, piece.file ? std::move(piece.file) : copy_of(file.get(), n_of_piece), swept_);
    piece.file.reset();
    FileNodes nodes(file.get(), piece.path);
    if (mesh_.is_whole()) {
      announce(nodes, file.get(), n_of_piece);
      begin_writing();
      lists_.emplace([this](bool is_last) { write_lists(is_last); });
    } else if (nodes.n() == 0) {
      return;
    }
    try {
      write_steps(piece.number, nodes, file.get(), pictures ? &*pictures : nullptr);
    } catch (...) {
      if (lists_) lists_->end();
      throw;
    }
    if (!mesh_.is_whole()) return;
    lists_->end();
    if (pictures && !UnbrokenWrite::has_signal()) pictures->encode(report_);
    report_files();
  }

  void write_steps(std::int64_t piece, FileNodes &nodes, riis_vtk_mesh *file, RunPictures *pictures) {
    StepProgress progress("writing", times_.size(), options().quiet);
    for (std::size_t step = 0; step < times_.size() && !UnbrokenWrite::has_signal(); ++step) {
      progress.begin(step);
      const Stage stage("", true);
      mark_step(nodes, file, step);
      seconds_[step] += stage.seconds();
      files_.write(piece, step, file);
      if (mesh_.is_whole()) finish_step(step);
      if (pictures) pictures->draw(step, valves_, report_);
    }
  }

  void mark_step(FileNodes &nodes, riis_vtk_mesh *file, std::size_t step) {
    move_to_step(step);
    for (MovingValve &valve : valves_) valve.mark(nodes, fields());
    set_arrays(file);
  }

  // Prints the estimated size of all files. The estimate comes from the first step's file.
  void announce(FileNodes &nodes, riis_vtk_mesh *file, std::int64_t n_nodes_of_mesh) {
    if (!files_.has_list()) return;
    if (!options().series.all_cells) report_.n_written = nodes.n();
    if (options().quiet) return;
    mark_step(nodes, file, 0);
    std::int64_t n_bytes = 0;
    check(riis_vtk_mesh_get_file_size(file, &n_bytes));
    const auto n = static_cast<double>(times_.size());
    std::fprintf(stderr, "riis: writing %s with %s of %s nodes, %s in all, to %s\n",
                 counted(view(times_).size(), "file").c_str(), grouped(nodes.n()).c_str(),
                 grouped(n_nodes_of_mesh).c_str(), bytes_text(n * static_cast<double>(n_bytes)).c_str(),
                 files_.folder().c_str());
  }

  // Writes the surfaces of a step, at which the valves are, and notes that the step is complete.
  void finish_step(std::size_t step) {
    for (std::size_t i = 0; surfaces_.is_wanted() && i < valves_.size(); ++i)
      if (ranks::is_first())
        check(riis_vtk_surface_write(valves_[i].surface(), surfaces_.path_of(step, all_.part_of(i)).c_str()));
    const auto note = [&] {
      files_.add(step);
      for (std::size_t i = 0; i < valves_.size(); ++i) {
        if (surfaces_.is_wanted()) surfaces_.add(times_[step], i, surfaces_.path_of(step, all_.part_of(i)));
        report_.valves[i].times.push_back(
            {times_[step], valves_[i].opening(), n_marked_[marked_at(step, i)], valves_[i].largest_speed()});
      }
      report_.seconds_of_steps.push_back(seconds_[step]);
    };
    if (lists_)
      lists_->add(note);
    else
      note();
    ++n_done_;
  }

  void write_lists(bool is_last) const {
    files_.write_list();
    surfaces_.write_list();
    const std::string &table = options().series.table;
    if (!table.empty() && (is_last || can_be_replaced(table))) write_text(table, csv_of(report_));
  }

  // Judges and lists the files, after all ranks have written their pieces. Returns whether all pieces are written.
  bool finish_pieces() {
    const std::vector<int> stopped = ranks::gather(std::vector<int>{UnbrokenWrite::has_signal() ? 1 : 0});
    const bool is_stopped = std::find(stopped.begin(), stopped.end(), 1) != stopped.end();
    if (!is_stopped) judge();
    const Stage stage("writing", options().quiet);
    files_.list_pieces();
    report_.seconds.write += stage.seconds();
    if (is_stopped) {
      files_.write_list();
      return false;
    }
    if (!is_series()) {
      write_surface();
      files_.report(report_);
      return true;
    }
    for (std::size_t step = 0; step < times_.size(); ++step) {
      move_to_step(step);
      finish_step(step);
    }
    ranks::agree();
    write_lists(true);
    report_files();
    return true;
  }

  void report_files() {
    files_.report(report_);
    surfaces_.report(report_);
    if (!options().series.table.empty()) report_.written.push_back(options().series.table);
  }

  Case &all_;
  const MeshPieces &mesh_;
  std::vector<MovingValve> valves_;
  Report report_;
  const std::vector<double> times_;
  const std::vector<std::string> names_;
  const bool wants_measures_;
  std::optional<UnbrokenWrite> unbroken_;  // lives until the summary is printed
  MarkedFiles files_;
  SeriesFiles surfaces_;  // of a series
  std::optional<SeriesLists> lists_;
  MeshCounts counts_;
  LooseNodes loose_;
  NodeCounts node_counts_;
  std::vector<std::int64_t> n_marked_;   // by kind of node_counts_, once all pieces are marked
  std::vector<std::size_t> most_steps_;  // by valve: the step with most marked nodes
  std::vector<double> seconds_;          // of marking, by step
  std::size_t n_done_ = 0;               // number of complete steps
  std::vector<std::int64_t> near_;       // the nodes of the present piece within the distance limit at some time
  Box swept_ = empty_box();              // the box around all surfaces at all times, for a movie
  std::vector<ValveSums> sums_;          // by valve
  PassageCheck passage_;
};

void write_report(const MarkOptions &options, const Report &report) {
  write_stats(options, report);
  if (!options.quiet && options.stats != "-") write_text("-", take_notes() + table_of(report));
}

}  // namespace

Report mark_case(Case &all, const MeshPieces &mesh) {
  MarkingRun run(all, mesh);
  run.run();
  return run.report();
}

namespace {

ExitCode run_case(Case &all) {
  MarkOptions &options = all.options;
  if (!all.is_series()) check_one_time(options);
  check_first_passage(all);
  if (is_in_pieces(options.mesh)) check_options_of_pieces(options);
  const MeshPieces mesh(options);
  std::optional<ranks::Alone> alone;  // only a mesh in pieces gives work to more than one rank
  if (mesh.is_whole()) {
    if (!ranks::is_first()) return exit_fine;
    alone.emplace();
  } else {
    options.pieces = mesh.files();
  }
  check_views(options, all.valves.size(), all.valves[0].options);
  const OutputLocks locks = check_outputs(options, all.files);
  read_surfaces(all);
  MarkingRun run(all, mesh);
  if (run.run()) {
    write_report(options, run.report());
  } else if (ranks::is_first()) {
    if (mesh.is_whole())
      std::fprintf(stderr, "riis: interrupted: %zu of %zu written\n", run.n_done(), all.times().size());
    else
      std::fprintf(stderr, "riis: interrupted: not all pieces are written\n");
  }
  return options.mesh.empty() || options.allow_none || run.has_marks() ? exit_fine : exit_none_marked;
}

}  // namespace

ExitCode run_mark(const MarkOptions &options) {
  // The movie is checked before the case is read, because a case may have many files.
  check_movie(options.series.movie);
  Case all = options.series.case_file.empty() ? case_of_command_line(options) : read_case(options);
  return run_case(all);
}

}  // namespace riis::program
