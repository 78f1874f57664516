// SPDX-License-Identifier: Apache-2.0
#include "program/case.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "program/leaks.hpp"
#include "program/mesh_marking.hpp"
#include "program/moving_valve.hpp"
#include "program/opening_law.hpp"
#include "program/outputs.hpp"
#include "program/pictures.hpp"
#include "program/progress.hpp"
#include "program/series.hpp"
#include "program/series_files.hpp"
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

// Refuses options that have an effect only in a series.
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

void write_case_files(const MarkOptions &options, const std::vector<MovingValve> &valves, const riis_vtk_mesh *file,
                      Report &report) {
  const Stage stage("writing", options.quiet);
  const UnbrokenWrite unbroken;
  if (!options.output.empty()) {
    check(riis_vtk_mesh_write(file, options.output.c_str()));
    report.written.push_back(options.output);
  }
  if (!options.surface_output.empty()) {
    const Surface joined = valves.size() > 1 ? joined_surface(valves) : nullptr;
    check(riis_vtk_surface_write(joined ? joined.get() : valves[0].surface(), options.surface_output.c_str()));
    report.written.push_back(options.surface_output);
  }
}

// Prints a line for each valve and for each written file.
void print_case(const Case &all, const std::vector<MovingValve> &valves, const Report &report) {
  if (all.options.quiet) return;
  std::string text = "mesh      " + all.options.mesh + ": " + counted(valves[0].stats().n_nodes, "node") + "\n";
  for (const MovingValve &valve : valves) {
    text += "valve     " + valve.options().prefix + ": " +
            (valve.source().valve ? "opening " + shown(valve.opening()) + ", " : "") +
            counted(valve.stats().n_marked, "node") + " marked\n";
  }
  text += line_of_passage(report.leaks);
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
  }
  write_case_files(options, valves, file.get(), report);
  if (!options.pictures.empty()) SeriesPictures(all, std::move(file), {}).draw(0, valves, report);
  print_case(all, valves, report);
  return most_marked == 0 && !options.allow_none ? exit_none_marked : exit_fine;
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
  const OutputLocks locks = check_outputs(all.options, all.files);
  return all.is_series() ? run_series(all) : run_one_time(all);
}

}  // namespace riis::program
