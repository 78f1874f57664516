// SPDX-License-Identifier: Apache-2.0
#include "program/case.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/array_view.hpp"
#include "program/leaks.hpp"
#include "program/marking_in_pieces.hpp"
#include "program/mesh_marking.hpp"
#include "program/mesh_reading.hpp"
#include "program/moving_valve.hpp"
#include "program/opening_law.hpp"
#include "program/outputs.hpp"
#include "program/pictures.hpp"
#include "program/progress.hpp"
#include "program/ranks.hpp"
#include "program/series.hpp"
#include "program/series_files.hpp"
#include "program/series_in_pieces.hpp"
#include "program/valve_source.hpp"
#include "program/warnings.hpp"

namespace riis::program {
namespace {

OpeningLaw law_of_command_line(const MarkOptions &options) {
  const SeriesOptions &series = options.series;
  OpeningTable table = read_cycle(series.cycle);
  table.period = options.period;
  table.interpolation = series.interpolation;
  return OpeningLaw(std::move(table), series.cycle);
}

// Refuses options that have an effect only in a series, if there is no series.
void check_one_time(const Case &all) {
  const SeriesOptions &series = all.options.series;
  const std::string why = " needs times: " + series.case_file + " has none, and --times is not given";
  const auto refuse = [&](const std::string &option) { throw Refusal{exit_wrong_usage, option + why}; };
  if (!series.movie.empty()) refuse("--movie");
  if (!series.table.empty()) refuse("--series-table");
  if (series.all_cells) refuse("--all-cells");
}

std::vector<std::string> names_of_case(const Case &all) {
  std::vector<std::string> names;
  for (const ValveSource &valve : all.valves) {
    const std::vector<std::string> own = names_of_marks(valve.options.prefix, 0);
    names.insert(names.end(), own.begin(), own.end());
  }
  if (all.has_resistance()) names.push_back(all.options.prefix + "_K");
  return names;
}

void write_case_surface(const MarkOptions &options, const std::vector<MovingValve> &valves, Report &report) {
  if (options.surface_output.empty()) return;
  const UnbrokenWrite unbroken;
  const Surface joined = valves.size() > 1 ? joined_surface(valves) : nullptr;
  if (ranks::is_first())
    check(riis_vtk_surface_write(joined ? joined.get() : valves[0].surface(), options.surface_output.c_str()));
  report.written.push_back(options.surface_output);
}

void write_case_files(const MarkOptions &options, const std::vector<MovingValve> &valves, const riis_vtk_mesh *file,
                      Report &report) {
  const Stage stage("writing", options.quiet);
  const UnbrokenWrite unbroken;
  if (!options.output.empty()) {
    check(riis_vtk_mesh_write(file, options.output.c_str()));
    report.written.push_back(options.output);
  }
  write_case_surface(options, valves, report);
}

// Prints a line for each valve and for each written file.
void print_case(const Case &all, const std::vector<MovingValve> &valves, int64_t n_nodes,
                const std::vector<int64_t> &n_marked, const Report &report) {
  if (all.options.quiet) return;
  std::string text = take_notes() + "mesh      " + all.options.mesh + ": " + counted(n_nodes, "node") + "\n";
  for (std::size_t i = 0; i < valves.size(); ++i) {
    const MovingValve &valve = valves[i];
    text += "valve     " + valve.options().prefix + ": " +
            (valve.source().valve ? "opening " + shown(valve.opening()) + ", " : "") + counted(n_marked[i], "node") +
            " marked\n";
  }
  text += line_of_passage(report.leaks) + lines_of_valve_flows(report);
  for (const std::string &path : report.written) text += "written   " + path + "\n";
  write_text("-", text);
}

// Marks all valves and sets their arrays in the mesh file. Returns the largest number of marked nodes of any valve.
int64_t mark_valves(const Case &all, std::vector<MovingValve> &valves, const riis_mesh *mesh, riis_vtk_mesh *file) {
  int64_t n_nodes = 0, most = 0;
  check(riis_vtk_mesh_get_nodes(file, &n_nodes, nullptr, nullptr));
  ResistanceSum resistance(n_nodes, ResistanceSum::WithVelocity::no);
  std::vector<Warning> warnings;
  for (MovingValve &valve : valves) {
    valve.mark(mesh, 0);
    set_marks(valve.options(), valve.result(), 0, file);
    resistance.add(valve.options(), valve.result());
    most = std::max(most, valve.stats().n_marked);
    riis_surface_info info;
    check(riis_surface_get_info(valve.surface(), &info, sizeof info));
    if (auto warning = warning_of(situation_of(valve.options(), info, valve.stats(), file))) {
      warning->text.insert(0, valve.options().prefix + ": ");
      warnings.push_back(*warning);
    }
  }
  warn(warnings);
  resistance.set_arrays(all.options.prefix, file);
  return most;
}

ExitCode run_one_time(Case &all) {
  const MarkOptions &options = all.options;
  std::vector<MovingValve> valves = moving_valves(all);
  Report report;
  MeshFile file = read_mesh(options, report.seconds);
  check_new_arrays(options, names_of_case(all), file.get());
  int64_t most_marked = 0;
  {
    const Mesh mesh = borrow_nodes(file.get(), options.mesh);
    most_marked = mark_valves(all, valves, mesh.get(), file.get());
    look_for_leaks_of(all, valves, mesh.get(), file.get());
    check_passage_of(all, valves, mesh.get(), file.get(), report);
    measure_bands(all, valves, mesh.get(), file.get(), report);
    measure_orifices(all, valves, report);
  }
  write_case_files(options, valves, file.get(), report);
  if (!options.pictures.empty()) SeriesPictures(all, std::move(file), {}).draw(0, valves, report);
  std::vector<int64_t> n_marked;
  for (const MovingValve &valve : valves) n_marked.push_back(valve.stats().n_marked);
  print_case(all, valves, valves[0].stats().n_nodes, n_marked, report);
  return most_marked == 0 && !options.allow_none ? exit_none_marked : exit_fine;
}

// As run_one_time, for a mesh in pieces.
ExitCode run_one_time_in_pieces(Case &all, const MeshPieces &pieces) {
  const MarkOptions &options = all.options;
  std::vector<MovingValve> valves = moving_valves(all);
  const std::vector<std::string> names = names_of_case(all);
  Report report;
  PieceOutput output(options.output, view(pieces.files()).size());
  PassageCheck passage(valves.size() == 1 ? valves[0].options() : options, pieces);
  std::vector<PieceLeaks> leaks;
  for (std::size_t i = 0; i < valves.size(); ++i) {
    const std::string part = all.part_of(i);
    leaks.emplace_back(valves[i].options(), pieces, valves[i].surface(), valves[i].source().valve.get(),
                       "the surface" + (part.empty() ? "" : " of " + part));
  }
  MeshCounts own;
  LooseNodes loose;
  NodeCounts marked(valves.size());
  std::vector<std::vector<SharedNode>> shared;
  std::vector<std::int32_t> complete(valves.size(), 1);
  for_own_pieces(pieces, [&](std::int64_t piece) {
    const std::string &path = view(pieces.files())[piece];
    const MeshFile file = read_piece(options, pieces, piece, report.seconds);
    const PieceNodes nodes(file.get(), path);
    own.add(file.get(), nodes);
    loose.add(nodes);
    if (nodes.n() > 0) {
      check_new_arrays(options, names, file.get());
      const Mesh mesh = borrow_nodes(file.get(), path);
      ResistanceSum resistance(nodes.n(), ResistanceSum::WithVelocity::no);
      for (std::size_t i = 0; i < valves.size(); ++i) {
        valves[i].mark(mesh.get(), 0);
        set_marks(valves[i].options(), valves[i].result(), 0, file.get());
        resistance.add(valves[i].options(), valves[i].result());
        marked.add(nodes, list_of(valves[i].result(), RIIS_LIST_MARKED), i);
        leaks[i].add(piece, nodes, file.get(), mesh.get(), valves[i].result());
        complete[i] = complete[i] && valves[i].stats().complete;
      }
      resistance.set_arrays(options.prefix, file.get());
      shared.push_back(shared_nodes_of(piece, nodes, {}));
      if (options.check_leaks) passage.add(piece, nodes, NodeEdges(file.get(), options.mark_options.n_threads));
    }
    output.write(piece, file.get());
    pieces.finished(piece);
  });
  const MeshCounts counts = sum_of(own, pieces);
  const MatchedNodes matched = match_nodes(std::move(shared), counts.n_with_ids > 0, pieces.files());
  loose.check(pieces);
  const std::vector<int64_t> n_marked = marked.sums();
  const int64_t n_nodes = counts.n_nodes + matched.n_nodes;
  warn_of_apart(counts, matched, pieces);
  std::vector<Warning> warnings;
  report.leaks.n_volume_cells = counts.n_volume_cells;
  report.leaks.n_cells_left_out = counts.n_cells_left_out;
  for (std::size_t i = 0; i < valves.size(); ++i) {
    riis_surface_info info;
    check(riis_surface_get_info(valves[i].surface(), &info, sizeof info));
    if (auto warning = warning_of(situation_in_pieces(valves[i].options(), info, n_nodes, n_marked[i], counts))) {
      warning->text.insert(0, valves[i].options().prefix + ": ");
      warnings.push_back(*warning);
    }
  }
  warn(warnings);
  const std::vector<std::int32_t> are_complete = ranks::gather(complete);
  for (std::size_t i = 0; i < valves.size(); ++i) {
    report.marks.complete = 1;
    for (std::size_t k = i; k < are_complete.size(); k += valves.size())
      report.marks.complete = report.marks.complete && are_complete[k];
    check(riis_surface_get_info(valves[i].surface(), &report.surface, sizeof report.surface));
    leaks[i].judge(report);
  }
  const Surface joined = joined_for_passage(all, valves);
  check(riis_surface_get_info(joined ? joined.get() : valves[0].surface(), &report.surface, sizeof report.surface));
  passage.judge(joined ? joined.get() : valves[0].surface(), joined ? nullptr : valves[0].source().valve.get(),
                joined ? "the surface of all valves" : "the surface", counts, report);
  measure_orifices(all, valves, report);
  output.finish();
  if (output.is_wanted()) report.written.push_back(options.output);
  write_case_surface(options, valves, report);
  print_case(all, valves, n_nodes, n_marked, report);
  return *std::max_element(n_marked.begin(), n_marked.end()) == 0 && !options.allow_none ? exit_none_marked : exit_fine;
}

}  // namespace

bool Case::has_resistance() const {
  return std::any_of(valves.begin(), valves.end(),
                     [](const ValveSource &valve) { return valve.options.resistance.has_value(); });
}

Case case_of_command_line(const MarkOptions &options) {
  Case all{options, {}, {}};
  ValveSource source{options, nullptr, nullptr};
  if (options.surface.empty()) {
    source.law = law_of_command_line(options);
    // make_valve refuses a file of patches if the valve cannot open as far as the law requires.
    source.options.opening = largest_opening(source.law, options.series.times);
    source.valve = make_valve(source.options, OpeningCheck::yes, &source.warp);
    source.has_open_state = !options.params_open.empty();
  } else {
    Seconds seconds;
    KeyframeFiles read = read_keyframes(options, seconds);
    check_no_output_is("a frame of --surface " + options.surface, read.files, options);
    source.keyframes = std::move(read.keyframes);
    all.files = std::move(read.files);
  }
  all.valves.push_back(std::move(source));
  return all;
}

ExitCode run_case(Case &all) {
  if (!all.is_series()) check_one_time(all);
  std::optional<MeshPieces> pieces;
  if (is_in_pieces(all.options.mesh)) {
    check_options_of_pieces(all.options);
    all.options.pieces = pieces.emplace(all.options.mesh).files();
  }
  if (!pieces && !ranks::is_first()) return exit_fine;  // only a mesh in pieces gives work to more than one rank
  check_views(all.options, all.valves.size(), all.valves[0].options);
  const OutputLocks locks = check_outputs(all.options, all.files);
  if (pieces) return all.is_series() ? run_series_in_pieces(all, *pieces) : run_one_time_in_pieces(all, *pieces);
  return all.is_series() ? run_series(all) : run_one_time(all);
}

}  // namespace riis::program
