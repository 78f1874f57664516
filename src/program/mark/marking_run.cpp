// SPDX-License-Identifier: Apache-2.0
#include "program/mark/marking.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "program/base/progress.hpp"
#include "program/base/ranks.hpp"
#include "program/input/case.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/mark/mesh_marking.hpp"
#include "program/output/marked_files.hpp"
#include "program/output/outputs.hpp"
#include "program/output/pictures.hpp"

namespace riis::program {
namespace {

// Refuses options that need the whole mesh in memory.
void check_options_of_pieces(const MarkOptions &options) {
  const auto refuse_if = [&](bool is_given, const std::string &option, const std::string &why) {
    if (is_given) refuse_usage(option + ": " + why + ", and " + options.mesh + " is read in pieces");
  };
  refuse_if(!options.pictures.empty(), "--picture", "a picture needs the whole mesh");
  refuse_if(!options.series.movie.empty(), "--movie", "a movie needs the whole mesh");
  refuse_if(options.at_cells, "--cells", "cells at the border of a piece have neighbours in another piece");
  refuse_if(options.n_steps > 0, "--steps", "steps are timed in the whole mesh");
  refuse_if(options.mark_options.search == RIIS_SEARCH_PAPER, "--search paper",
            "this search walks through the whole mesh");
}

// If there is no series, refuses the options that have an effect only in a series.
void check_one_time(const MarkOptions &options) {
  const SeriesOptions &series = options.series;
  const auto refuse_if = [&](bool is_given, const std::string &option) {
    if (is_given) refuse_usage(option + " needs times: " + series.case_file + " has none, and --times is not given");
  };
  refuse_if(!series.movie.empty(), "--movie");
  refuse_if(!series.table.empty(), "--series-table");
  refuse_if(series.all_cells && !options.at_cells, "--all-cells");
}

// Refuses --first-passage for several valves, and for a valve that cannot open.
void check_first_passage(const Case &all) {
  if (!all.options.first_passage) return;
  if (!all.valves[0].options.surface.empty())
    refuse_usage("--first-passage needs a valve, because a surface from a file does not open");
  if (all.valves.size() > 1)
    refuse_usage(
        "--first-passage takes one valve, because one of several valves may close the passage through another");
}

MeshFile part_of(const riis_vtk_mesh *file, const std::vector<std::int64_t> &node_ids) {
  return create<MeshFile>(riis_vtk_mesh_extract, file, view(node_ids).size(), node_ids.data());
}

MeshFile copy_of_mesh(const riis_vtk_mesh *file, std::int64_t n_nodes) {
  std::vector<std::int64_t> all(static_cast<std::size_t>(n_nodes));
  std::iota(all.begin(), all.end(), 0);
  return part_of(file, all);
}

// The first steps are not timed, because they sort the mesh's nodes and allocate memory that later steps use again.
constexpr int n_first_steps = 2;

// For --steps, measures how long a step of a moving valve takes. The mesh is prepared for many markings. The function moves the
// opening of a copy of the valve back and forth between 0 and 1, and marks the nodes of the file after each step. Throws a
// Refusal for a valve that cannot move.
StepTimes time_steps(const MarkOptions &options, const riis_valve *valve, const riis_vtk_mesh *file) {
  const Stage stage("timing " + std::to_string(options.n_steps) + " steps", options.quiet);
  const riis_mark_options &how = options.mark_options;
  FileNodes nodes(file, options.mesh);
  std::optional<FileNodes::Lent> lent;
  if (needs_adjacency(how.search)) {
    nodes.find_neighbors(how.n_threads);
    lent.emplace(nodes);
  }
  const Valve moved = copy_of(valve);
  const auto surface = create<Surface>(riis_surface_create, moved, &options.surface_options);
  const Marks result = new_result();
  std::vector<double> of_surface, of_marking;
  // The opening goes up to 1, then down to 0, and so on.
  double opening = opening_of(valve), change = opening_of_step;
  for (int i = 0; i < n_first_steps + options.n_steps; ++i) {
    if (opening + change > 1 || opening + change < 0) change = -change;
    opening = std::clamp(opening + change, 0.0, 1.0);
    const Stage step("", true);
    check(riis_valve_set_scalar(moved, "opening", opening), "--steps");
    check(riis_surface_update(surface, moved, nullptr), "--steps");
    const double updated = step.seconds();
    check(riis_mark_nodes(surface, nodes.mesh(), &how, result), options.mesh);
    const double marked = step.seconds();
    if (i < n_first_steps) continue;
    of_surface.push_back(updated);
    of_marking.push_back(marked - updated);
  }
  return {options.n_steps, stats_of(result).search, median(of_surface), median(of_marking)};
}

void write_stats(const MarkOptions &options, const Report &report) {
  if (!options.stats.empty()) write_text(options.stats, json_of(report));
}

// Marks the pieces of a mesh, and writes all files.
class MarkingRun {
 public:
  MarkingRun(Case &all, const MeshPieces &mesh)
      : all_(all),
        mesh_(mesh),
        marking_(all, mesh),
        times_(marking_.times()),
        valves_(marking_.valves()),
        report_(marking_.report()),
        files_(all, mesh),
        surfaces_(all.is_series() ? all.options.surface_output : "", ".vtp", times_.size()),
        seconds_(times_.size()) {}

  // Returns whether all steps are complete. A signal stops a series.
  bool run() {
    if (all_.options.mesh.empty()) {
      write_surface();
      draw(nullptr);
      return true;
    }
    find_earlier();
    if (!mesh_.is_whole()) begin_writing();
    mesh_.for_each_own(
        [&](Piece &piece) {
          if (UnbrokenWrite::has_signal()) return;
          marking_.measure(piece);
          // Warnings about a whole mesh are printed before its files are written, because writing may take long.
          if (mesh_.is_whole()) marking_.judge();
          write(piece);
        },
        &report_.seconds);
    return mesh_.is_whole() ? n_done_ == times_.size() : finish_pieces();
  }

  const Report &report() const { return report_; }
  std::size_t n_done() const { return n_done_; }
  bool has_marks() const { return marking_.has_marks(); }

 private:
  // A bad output is refused before the marking.
  void find_earlier() {
    if (!all_.is_series()) return;
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < valves_.size(); ++i) parts.push_back(all_.part_of(i));
    files_.find_earlier();
    surfaces_.find_earlier(parts, false);
  }

  void begin_writing() {
    // In a series, a signal such as Ctrl-C takes effect at the end of a step. Even after a signal, the lists are therefore
    // written and the movie's frames are removed.
    if (all_.is_series()) unbroken_.emplace();
    if (ranks::is_first()) {
      files_.make_folder();
      surfaces_.make_folder();
    }
    ranks::agree();
  }

  void write(Piece &piece) {
    if (all_.is_series()) return write_steps(piece);
    if (piece.mesh) piece.mesh->forget_neighbors();
    if (all_.options.n_steps > 0)
      report_.step = time_steps(valves_[0].options(), valves_[0].source().valve, piece.file.get());
    if (mesh_.is_whole()) write_surface();
    const Stage stage("writing", all_.options.quiet);
    files_.write(piece.number, 0, piece.file.get());
    report_.seconds.write += stage.seconds();
    if (!mesh_.is_whole()) return;
    files_.report(report_);
    n_done_ = 1;
    draw(std::move(piece.file));
  }

  void write_surface() {
    if (all_.options.surface_output.empty()) return;
    const Stage stage("writing", all_.options.quiet);
    const UnbrokenWrite unbroken;
    const Surface joined = valves_.size() > 1 ? joined_surface(valves_) : nullptr;
    if (ranks::is_first())
      check(riis_vtk_surface_write(joined ? joined : valves_[0].surface(), all_.options.surface_output.c_str()));
    report_.written.push_back(all_.options.surface_output);
    report_.seconds.write += stage.seconds();
  }

  // Draws the pictures of one time.
  void draw(MeshFile file) {
    if (!RunPictures::are_wanted(all_.options)) return;
    try {
      RunPictures(all_, std::move(file), marking_.swept()).draw(0, valves_, report_);
    } catch (const Refusal &) {
      // The statistics are written even if a picture could not be drawn, because the marks are valid.
      write_stats(all_.options, report_);
      throw;
    }
  }

  // Writes the piece's file for each time. If no valve comes near a piece, the piece has no files.
  void write_steps(Piece &piece) {
    if (!mesh_.is_whole() && !(files_.is_wanted() && piece.mesh)) return;
    if (!unbroken_) unbroken_.emplace();
    const std::int64_t n_of_piece = piece.nodes.n();
    piece.mesh.reset();
    MeshFile file =
        all_.options.series.all_cells ? std::move(piece.file) : part_of(piece.file.get(), marking_.near_nodes());
    std::optional<RunPictures> pictures;
    // Pictures use a separate mesh, because they show the whole mesh and store other arrays in it.
    if (RunPictures::are_wanted(all_.options))
      pictures.emplace(all_, piece.file ? std::move(piece.file) : copy_of_mesh(file.get(), n_of_piece),
                       marking_.swept());
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
    StepProgress progress("writing", times_.size(), all_.options.quiet);
    for (std::size_t step = 0; step < times_.size() && !UnbrokenWrite::has_signal(); ++step) {
      progress.begin(step);
      const Stage stage("", true);
      marking_.mark_step(nodes, file, step);
      const double marking = stage.seconds();
      files_.write(piece, step, file);
      seconds_[step] += marking;
      report_.seconds.search += marking;
      report_.seconds.write += stage.seconds() - marking;
      if (mesh_.is_whole()) finish_step(step);
      if (pictures) pictures->draw(step, valves_, report_);
    }
  }

  // Prints the estimated size of all files. The first step's file gives the estimate.
  void announce(FileNodes &nodes, riis_vtk_mesh *file, std::int64_t n_nodes_of_mesh) {
    if (!files_.has_list()) return;
    if (!all_.options.series.all_cells) report_.n_written = nodes.n();
    if (all_.options.quiet) return;
    marking_.mark_step(nodes, file, 0);
    std::int64_t n_bytes = 0;
    check(riis_vtk_mesh_get_file_size(file, &n_bytes));
    const auto n = static_cast<double>(times_.size());
    print_line("writing " + counted(view(times_).size(), "file") + " with " + grouped(nodes.n()) + " of " +
               grouped(n_nodes_of_mesh) + " nodes, " + bytes_text(n * static_cast<double>(n_bytes)) + " in all, to " +
               files_.folder());
  }

  // Writes the surfaces of a step, and notes that the step is complete. The valves must already be at this step.
  void finish_step(std::size_t step) {
    for (std::size_t i = 0; surfaces_.is_wanted() && i < valves_.size(); ++i)
      if (ranks::is_first())
        check(riis_vtk_surface_write(valves_[i].surface(), surfaces_.path_of(step, all_.part_of(i)).c_str()));
    const auto note = [&] {
      files_.add(step);
      for (std::size_t i = 0; i < valves_.size(); ++i) {
        if (surfaces_.is_wanted()) surfaces_.add(times_[step], i, surfaces_.path_of(step, all_.part_of(i)));
        report_.valves[i].times.push_back(
            {times_[step], valves_[i].opening(), marking_.n_marked(step, i), valves_[i].largest_speed()});
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
    const std::string &table = all_.options.series.table;
    if (!table.empty() && (is_last || can_be_replaced(table))) write_text(table, csv_of(report_));
  }

  // Judges and lists the files. All ranks must have written their pieces. Returns whether all pieces are written.
  bool finish_pieces() {
    const bool is_stopped = ranks::sum(UnbrokenWrite::has_signal()) > 0;
    if (!is_stopped) marking_.judge();
    const Stage stage("writing", all_.options.quiet);
    files_.list_pieces();
    report_.seconds.write += stage.seconds();
    if (is_stopped) {
      files_.write_list();
      return false;
    }
    if (!all_.is_series()) {
      write_surface();
      report_files();
      return true;
    }
    for (std::size_t step = 0; step < times_.size(); ++step) {
      marking_.move_to_step(step);
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
    if (!all_.options.series.table.empty()) report_.written.push_back(all_.options.series.table);
  }

  Case &all_;
  const MeshPieces &mesh_;
  Marking marking_;
  const std::vector<double> &times_;
  std::vector<MovingValve> &valves_;
  Report &report_;
  std::optional<UnbrokenWrite> unbroken_;  // lives until the summary is printed
  MarkedFiles files_;
  SeriesFiles surfaces_;  // of a series
  std::optional<SeriesLists> lists_;
  std::vector<double> seconds_;  // of marking, by step
  std::size_t n_done_ = 0;       // number of complete steps
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

// Returns whether the checks prove that no flow passes the valves.
bool is_sealed(const Report &report) {
  if (report.passage) return report.passage->found.state == RIIS_PASSAGE_CLOSED && !report.passage->is_unknown;
  return std::all_of(report.valves.begin(), report.valves.end(), [](const ValveReport &valve) {
    return valve.leaks.found.n_edges == 0 && valve.leaks.has_all_edges() && valve.leaks.is_near;
  });
}

// Returns whether a check found what it looks for, such as a leak.
bool has_fault(const MarkOptions &options, const Report &report) {
  const bool crosses = std::any_of(report.valves.begin(), report.valves.end(), [](const ValveReport &valve) {
    return valve.crossings && valve.crossings->found.n_pairs > 0;
  });
  return (options.check_crossing && crosses) || (options.demand_sealed && !is_sealed(report));
}

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
  } else {
    print_line("interrupted: " + (mesh.is_whole() ? std::to_string(run.n_done()) + " of " +
                                                        std::to_string(all.times().size()) + " written"
                                                  : "not all pieces are written"));
  }
  if (!options.mesh.empty() && !options.allow_none && !run.has_marks()) return exit_none_marked;
  return has_fault(options, run.report()) ? exit_warned : exit_fine;
}

}  // namespace

ExitCode run_mark(const MarkOptions &options) {
  // The movie's options are checked before the case is read, because reading a case with many files takes long.
  check_movie(options.series.movie);
  Case all = options.series.case_file.empty() ? case_of_command_line(options) : read_case(options);
  return run_case(all);
}

}  // namespace riis::program
