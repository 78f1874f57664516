// SPDX-License-Identifier: Apache-2.0
#include "program/mark/marking.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "program/base/progress.hpp"
#include "program/base/ranks.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/output/marked_files.hpp"
#include "program/output/outputs.hpp"
#include "program/output/pictures.hpp"

namespace riis::program {
namespace {

// Refuses options that a run of these valves, times and pieces cannot follow.
void check_options(const Case &all) {
  const MarkOptions &options = all.options;
  const auto refuse_if = [](bool is_given, const std::string &why) {
    if (is_given) refuse_usage(why);
  };
  const auto needs_times = [&](bool is_given, const std::string &option) {
    refuse_if(is_given && !all.is_series(),
              option + " needs times: " + options.series.case_file + " has none, and --times is not given");
  };
  needs_times(!options.series.movie.empty(), "--movie");
  needs_times(!options.series.table.empty(), "--series-table");
  needs_times(options.series.all_cells && !options.at_cells, "--all-cells");
  if (options.first_passage) {
    refuse_if(!all.valves[0].options.surface.empty(),
              "--first-passage needs a valve, because a surface from a file does not open");
    refuse_if(all.valves.size() > 1,
              "--first-passage takes only one valve: with several valves, one valve may close the passage through "
              "another valve");
  }
  if (!is_in_pieces(options.mesh)) return;
  const std::string in_pieces = ", and " + options.mesh + " is read in pieces";
  refuse_if(!options.pictures.empty(), "--picture: a picture needs the whole mesh" + in_pieces);
  refuse_if(!options.series.movie.empty(), "--movie: a movie needs the whole mesh" + in_pieces);
  refuse_if(options.at_cells, "--cells: cells at the border of a piece have neighbours in another piece" + in_pieces);
  refuse_if(options.n_steps > 0, "--steps: steps are timed in the whole mesh" + in_pieces);
  refuse_if(options.mark_options.search == RIIS_SEARCH_PAPER,
            "--search paper: this search walks through the whole mesh" + in_pieces);
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
  FileNodes nodes(file, options.mesh);
  ValveSource source{options, copy_of(valve), nullptr, OpeningLaw(OpeningTable{{0, 1}, {0, 1}}, "")};
  source.subject = "--steps";
  double opening = opening_of(valve), change = opening_of_step;
  MovingValve moved(source, opening, true);  // the time is the opening
  std::vector<double> of_surface, of_marking;
  for (int i = 0; i < n_first_steps + options.n_steps; ++i) {
    if (opening + change > 1 || opening + change < 0) change = -change;
    opening = std::clamp(opening + change, 0.0, 1.0);
    const Stage step("", true);
    moved.move_to(opening);
    const double updated = step.seconds();
    moved.mark(nodes, 0);
    const double marked = step.seconds();
    if (i < n_first_steps) continue;
    of_surface.push_back(updated);
    of_marking.push_back(marked - updated);
  }
  return {options.n_steps, moved.stats().search, median(of_surface), median(of_marking)};
}

void write_stats(const MarkOptions &options, const Report &report) {
  if (!options.stats.empty()) write_text(options.stats, json_of(report));
}

// Marks the pieces of a mesh, and writes all files.
class MarkingRun : Marking {
 public:
  MarkingRun(Case &all, const MeshPieces &mesh)
      : Marking(all, mesh),
        files_(all, mesh),
        surfaces_(all.is_series() ? all.options.surface_output : "", ".vtp", times_.size()),
        table_(all.options.series.table, csv_head_of(report_), ""),
        seconds_(times_.size()) {}

  // Returns whether all steps are complete. A signal stops a series.
  bool run() {
    MeshFile drawn;
    if (!options().mesh.empty()) {
      find_earlier();
      if (!mesh_.is_whole()) begin_writing();
      mesh_.for_each_own(
          [&](Piece &piece) {
            if (UnbrokenWrite::has_signal()) return;
            measure(piece);
            // Warnings about a whole mesh are printed before its files are written, because writing may take long.
            if (mesh_.is_whole()) judge();
            all_.is_series() ? write_steps(piece) : write(piece);
            if (mesh_.is_whole()) drawn = std::move(piece.file);
          },
          &report_.seconds);
      if (!mesh_.is_whole() && !finish_pieces()) return false;
    }
    const bool has_steps = all_.is_series() && !options().mesh.empty();
    if (!has_steps) write_surface();
    table_.finish();
    files_.report(report_);
    surfaces_.report(report_);
    if (!options().series.table.empty()) report_.written.push_back(options().series.table);
    if (!has_steps) draw(std::move(drawn));
    return !has_steps || n_done_ == times_.size();
  }

  using Marking::has_marks;
  const Report &report() const { return report_; }
  std::size_t n_done() const { return n_done_; }

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
    // In a series, a signal such as Ctrl-C takes effect at the end of a step. Even after a signal, the movie's frames are
    // therefore removed.
    if (all_.is_series()) unbroken_.emplace();
    if (ranks::is_first()) {
      files_.make_folder();
      surfaces_.make_folder();
    }
    ranks::agree();
  }

  void write(Piece &piece) {
    piece.release();
    if (options().n_steps > 0)
      report_.step = time_steps(valves_[0].options(), valves_[0].source().valve, piece.file.get());
    const Stage stage("writing", options().quiet);
    files_.write(piece.number, 0, piece.file.get());
    report_.seconds.write += stage.seconds();
  }

  void write_surface() {
    if (options().surface_output.empty()) return;
    const Stage stage("writing", options().quiet);
    const UnbrokenWrite unbroken;
    const Surface joined = valves_.size() > 1 ? joined_surface(surfaces_of(valves_)) : nullptr;
    if (ranks::is_first())
      check(riis_vtk_surface_write(joined ? joined : valves_[0].surface(), options().surface_output.c_str()));
    report_.written.push_back(options().surface_output);
    report_.seconds.write += stage.seconds();
  }

  // Draws the pictures of one time.
  void draw(MeshFile file) {
    if (!RunPictures::are_wanted(options())) return;
    try {
      RunPictures(all_, std::move(file), swept_).draw(0, valves_, report_);
    } catch (const Refusal &) {
      // The statistics are written even if a picture could not be drawn, because the marks are valid.
      write_stats(options(), report_);
      throw;
    }
  }

  // Writes the piece's file for each time. If no valve comes near a piece, the piece has no files.
  void write_steps(Piece &piece) {
    if (mesh_.is_whole())
      begin_writing();
    else if (!files_.is_wanted() || piece.n() == 0)
      return;
    const std::int64_t n_of_piece = piece.n();
    piece.release();
    MeshFile file = options().series.all_cells ? std::move(piece.file) : part_of(piece.file.get(), near_);
    std::optional<RunPictures> pictures;
    // Pictures use a separate mesh, because they show the whole mesh and store other arrays in it.
    if (RunPictures::are_wanted(options()))
      pictures.emplace(all_, piece.file ? std::move(piece.file) : copy_of_mesh(file.get(), n_of_piece), swept_);
    piece.file.reset();
    FileNodes nodes(file.get(), piece.path());
    if (mesh_.is_whole())
      announce(nodes, file.get(), n_of_piece);
    else if (nodes.n() == 0)
      return;
    StepProgress progress("writing", times_.size(), options().quiet);
    for (std::size_t step = 0; step < times_.size() && !UnbrokenWrite::has_signal(); ++step) {
      progress.begin(step);
      const Stage stage("", true);
      mark_step(nodes, file.get(), step);
      const double marking = stage.seconds();
      files_.write(piece.number, step, file.get());
      seconds_[step] += marking;
      report_.seconds.search += marking;
      report_.seconds.write += stage.seconds() - marking;
      if (mesh_.is_whole()) finish_step(step);
      if (pictures) pictures->draw(step, valves_, report_);
    }
    if (pictures && !UnbrokenWrite::has_signal()) pictures->encode(report_);
  }

  // Prints the estimated size of all files. The first step's file gives the estimate.
  void announce(FileNodes &nodes, riis_vtk_mesh *file, std::int64_t n_nodes_of_mesh) {
    if (!files_.has_list()) return;
    if (!options().series.all_cells) report_.n_written = nodes.n();
    if (options().quiet) return;
    mark_step(nodes, file, 0);
    std::int64_t n_bytes = 0;
    check(riis_vtk_mesh_get_file_size(file, &n_bytes));
    const auto n = static_cast<double>(times_.size());
    print_line("writing " + counted(view(times_).size(), "file") + " with " + grouped(nodes.n()) + " of " +
               grouped(n_nodes_of_mesh) + " nodes, " + bytes_text(n * static_cast<double>(n_bytes)) + " in all, to " +
               files_.folder());
  }

  // Writes the surfaces of a step, and lists its files. The valves must already be at this step.
  void finish_step(std::size_t step) {
    files_.add(step);
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      const std::string path = surfaces_.path_of(step, all_.part_of(i));
      if (surfaces_.is_wanted() && ranks::is_first()) check(riis_vtk_surface_write(valves_[i].surface(), path.c_str()));
      surfaces_.add(times_[step], i, path);
      report_.valves[i].times.push_back(
          {times_[step], valves_[i].opening(), n_marked(step, i), valves_[i].largest_speed()});
    }
    table_.add(csv_line_of(report_, seconds_[step]));
    ++n_done_;
  }

  // Judges the marks, and lists the files. All ranks must have written their pieces. Returns whether all pieces are written.
  bool finish_pieces() {
    const bool is_stopped = ranks::sum(UnbrokenWrite::has_signal()) > 0;
    if (!is_stopped) judge();
    const Stage stage("writing", options().quiet);
    files_.list_pieces();
    report_.seconds.write += stage.seconds();
    for (std::size_t step = 0; all_.is_series() && !is_stopped && step < times_.size(); ++step) {
      move_to_step(step);
      finish_step(step);
    }
    ranks::agree();
    return !is_stopped;
  }

  std::optional<UnbrokenWrite> unbroken_;  // lives until the summary is printed
  MarkedFiles files_;
  SeriesFiles surfaces_;         // of a series
  GrowingText table_;            // of a series
  std::vector<double> seconds_;  // of marking, by step
  std::size_t n_done_ = 0;       // number of complete steps
};

// Returns whether the checks prove that no flow passes the valves.
bool is_sealed(const Report &report) {
  if (report.passage) return report.passage->found.state == RIIS_PASSAGE_CLOSED && !report.passage->is_unknown;
  return std::all_of(report.valves.begin(), report.valves.end(), [](const ValveReport &valve) {
    return valve.leaks.found.n_edges == 0 && valve.leaks.has_all_edges() && valve.marks.n_marked > 0;
  });
}

// Returns whether a check found what it looks for, such as a leak.
bool has_fault(const MarkOptions &options, const Report &report) {
  const bool crosses = std::any_of(report.valves.begin(), report.valves.end(), [](const ValveReport &valve) {
    return valve.crossings && valve.crossings->found.n_pairs > 0;
  });
  return (options.check_crossing && crosses) || (options.demand_sealed && !is_sealed(report));
}

}  // namespace

Report mark_case(Case &all, const MeshPieces &mesh) {
  MarkingRun run(all, mesh);
  run.run();
  return run.report();
}

ExitCode run_mark(const MarkOptions &given) {
  // The movie's options are checked before the case is read, because reading a case with many files takes long.
  check_movie(given.series.movie);
  Case all = given.series.case_file.empty() ? case_of_command_line(given) : read_case(given);
  MarkOptions &options = all.options;
  check_options(all);
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
  if (!run.run()) {
    print_line("interrupted: " + std::to_string(run.n_done()) + " of " + std::to_string(all.times().size()) +
               " written");
    return exit_fine;  // the signal that was waiting then ends the process
  }
  write_stats(options, run.report());
  if (!options.quiet && options.stats != "-") write_text("-", take_notes() + table_of(run.report()));
  if (!options.mesh.empty() && !options.allow_none && !run.has_marks()) return exit_none_marked;
  return has_fault(options, run.report()) ? exit_warned : exit_fine;
}

}  // namespace riis::program
