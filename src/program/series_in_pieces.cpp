// SPDX-License-Identifier: Apache-2.0
#include "program/series_in_pieces.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "program/leaks.hpp"
#include "program/marking_in_pieces.hpp"
#include "program/mesh_marking.hpp"
#include "program/moving_valve.hpp"
#include "program/outputs.hpp"
#include "program/progress.hpp"
#include "program/ranks.hpp"
#include "program/series.hpp"
#include "program/series_files.hpp"
#include "program/warnings.hpp"

namespace riis::program {
namespace {

// A file that a rank has written.
struct WrittenPart {
  std::int64_t step, piece;
  bool operator<(const WrittenPart &other) const { return std::tie(step, piece) < std::tie(other.step, other.piece); }
};

class SeriesInPieces {
 public:
  SeriesInPieces(Case &all, const MeshPieces &pieces)
      : all_(all),
        pieces_(pieces),
        valves_(moving_valves(all)),
        lists_(options().output, ".pvtu", times().size()),
        parts_(options().output, ".vtu", times().size()),
        surfaces_(options().surface_output, ".vtp", times().size()),
        table_(all),
        names_(names_of_series(all)),
        node_counts_(times().size() * valves_.size()),
        are_complete_(valves_.size(), 1),
        seconds_(times().size()),
        passage_(valves_.size() == 1 ? valves_[0].options() : all.options, pieces) {
    move_to_least_openings(all_, valves_);
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      const MovingValve &valve = valves_[i];
      const std::string part = all_.part_of(i);
      leaks_.push_back(std::make_unique<PieceLeaks>(valve.options(), pieces_, valve.surface(),
                                                    valve.source().valve.get(),
                                                    "the surface" + (part.empty() ? "" : " of " + part)));
    }
  }

  ExitCode run() {
    const UnbrokenWrite unbroken;  // a signal waits for the end of a step, so the lists are always written
    if (ranks::is_first())
      for (const SeriesFiles *files : {&lists_, &surfaces_})
        if (files->is_wanted()) files->make_folder();
    ranks::agree();
    for_own_pieces(pieces_, [&](std::int64_t piece) {
      if (!UnbrokenWrite::has_signal()) mark(piece);
      pieces_.finished(piece);
    });
    const std::vector<int> stopped = ranks::gather(std::vector<int>{UnbrokenWrite::has_signal() ? 1 : 0});
    const bool is_stopped = std::find(stopped.begin(), stopped.end(), 1) != stopped.end();
    Report report;
    const std::vector<std::int64_t> n_marked = node_counts_.sums();
    const MeshCounts counts = sum_of(counts_, pieces_);
    const MatchedNodes matched = match_nodes(std::move(shared_), counts.n_with_ids > 0, pieces_.files());
    const std::int64_t n_nodes = counts.n_nodes + matched.n_nodes;
    if (!is_stopped) loose_.check(pieces_);
    if (!is_stopped) judge(n_marked, n_nodes, counts, matched, report);
    write_lists(n_marked, is_stopped);
    if (is_stopped) {
      if (ranks::is_first()) std::fprintf(stderr, "riis: interrupted: not all pieces are written\n");
      return exit_fine;
    }
    print_summary(all_, table_, {&lists_, &surfaces_}, "", n_nodes, std::nullopt, report);
    return table_.most_marked() == 0 && !options().allow_none ? exit_none_marked : exit_fine;
  }

 private:
  const MarkOptions &options() const { return all_.options; }
  const std::vector<double> &times() const { return all_.options.series.times; }
  std::size_t kind_of(std::size_t step, std::size_t valve) const { return step * valves_.size() + valve; }

  void mark(std::int64_t piece) {
    Seconds seconds;
    MeshFile file = read_piece(options(), pieces_, piece, seconds);
    const PieceNodes nodes(file.get(), view(pieces_.files())[piece]);
    counts_.add(file.get(), nodes);
    loose_.add(nodes);
    if (nodes.n() == 0) return;
    check_new_arrays(options(), names_, file.get());
    Sweep sweep;
    {
      const Mesh mesh = borrow_nodes(file.get(), view(pieces_.files())[piece]);
      const auto note = [&](std::size_t step, std::size_t valve) {
        node_counts_.add(nodes, list_of(valves_[valve].result(), RIIS_LIST_MARKED), kind_of(step, valve));
      };
      sweep = sweep_of(valves_, times(), mesh.get(), nodes.n(), options().quiet, note);
      look_for_leaks(piece, nodes, file.get(), mesh.get());
    }
    shared_.push_back(shared_nodes_of(piece, nodes, {}));
    if (!lists_.is_wanted()) return;
    if (!options().series.all_cells) file = part_of(file.get(), sweep.node_ids);
    write_part(piece, file.get());
  }

  void look_for_leaks(std::int64_t piece, const PieceNodes &nodes, const riis_vtk_mesh *file, riis_mesh *mesh) {
    move_to_least_openings(all_, valves_);
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      valves_[i].mark(mesh, 0);
      leaks_[i]->add(piece, nodes, file, mesh, valves_[i].result());
      if (!valves_[i].stats().complete) are_complete_[i] = 0;
    }
    if (options().check_leaks) passage_.add(piece, nodes, NodeEdges(file, options().mark_options.n_threads));
  }

  // Writes the part of a piece at each time. Pieces that the valves do not come near have no files.
  void write_part(std::int64_t piece, riis_vtk_mesh *part) {
    std::int64_t n = 0;
    check(riis_vtk_mesh_get_nodes(part, &n, nullptr, nullptr));
    if (n == 0) return;
    const Mesh nodes = borrow_nodes(part, view(pieces_.files())[piece]);
    for (std::size_t step = 0; step < times().size() && !UnbrokenWrite::has_signal(); ++step) {
      const Stage stage("", true);
      set_series_arrays(all_, valves_, nodes.get(), part, step);
      seconds_[step] += stage.seconds();
      const std::string path = path_of(step, piece);
      check(riis_vtk_mesh_write(part, path.c_str()));
      written_.push_back({static_cast<std::int64_t>(step), piece});
      if (sample_) continue;
      const char *const file = path.c_str();
      riis_vtk_pieces *list = nullptr;
      check(riis_vtk_pieces_create(part, 1, &file, &list));
      sample_.reset(list);
    }
  }

  std::string path_of(std::size_t step, std::int64_t piece) const {
    const std::string digits = std::to_string(piece);
    return parts_.path_of(step, "p" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits);
  }

  // Warns of suspicious marks and of leaks, as run_series.
  void judge(const std::vector<std::int64_t> &n_marked, std::int64_t n_nodes, const MeshCounts &counts,
             const MatchedNodes &matched, Report &report) {
    warn_of_apart(counts, matched, pieces_);
    std::vector<Warning> warnings;
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      std::size_t most = 0;
      for (std::size_t step = 0; step < times().size(); ++step)
        if (n_marked[kind_of(step, i)] > n_marked[kind_of(most, i)]) most = step;
      valves_[i].move_to(times()[most]);
      riis_surface_info info;
      check(riis_surface_get_info(valves_[i].surface(), &info, sizeof info));
      auto warning =
          warning_of(situation_in_pieces(valves_[i].options(), info, n_nodes, n_marked[kind_of(most, i)], counts));
      if (!warning) continue;
      const std::string part = all_.part_of(i);
      warning->text.insert(0, part.empty() ? "" : part + ": ");
      warnings.push_back(*warning);
    }
    warn(warnings);
    move_to_least_openings(all_, valves_);
    report.leaks.n_volume_cells = counts.n_volume_cells;
    report.leaks.n_cells_left_out = counts.n_cells_left_out;
    const std::vector<std::int32_t> complete = ranks::gather(are_complete_);
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      report.marks.complete = 1;
      for (std::size_t k = i; k < complete.size(); k += valves_.size())
        report.marks.complete = report.marks.complete && complete[k];
      check(riis_surface_get_info(valves_[i].surface(), &report.surface, sizeof report.surface));
      leaks_[i]->judge(report);
    }
    const Surface joined = joined_for_passage(all_, valves_);
    check_passage(joined.get(), counts, report);
    measure_largest_orifices(all_, valves_, report);
  }

  void check_passage(const riis_surface *joined, const MeshCounts &counts, Report &report) {
    if (!options().check_leaks) return;
    const MovingValve &first = valves_[0];
    const riis_surface *const surface = joined ? joined : first.surface();
    check(riis_surface_get_info(surface, &report.surface, sizeof report.surface));
    passage_.judge(surface, joined ? nullptr : first.source().valve.get(),
                   joined ? "the surface of all valves" : "the surface", counts, report);
  }

  // Writes the surfaces and the lists, and fills the table.
  void write_lists(const std::vector<std::int64_t> &n_marked, bool is_stopped) {
    std::vector<WrittenPart> written = ranks::gather(written_);
    std::sort(written.begin(), written.end());
    const std::vector<int> have = ranks::gather(std::vector<int>{sample_ ? 1 : 0});
    const bool is_writer = std::find(have.begin(), have.end(), 1) - have.begin() == ranks::rank();
    auto next = written.begin();
    for (std::size_t step = 0; step < times().size(); ++step) {
      std::vector<std::string> files;
      for (; next != written.end() && next->step == static_cast<std::int64_t>(step); ++next)
        files.push_back(path_of(step, next->piece));
      if (!files.empty()) {
        const std::string path = lists_.path_of(step, "");
        if (is_writer) write_list(files, path);
        lists_.add(times()[step], 0, path);
      }
      if (is_stopped) continue;
      for (MovingValve &valve : valves_) valve.move_to(times()[step], time_before(all_, step));
      for (std::size_t valve = 0; surfaces_.is_wanted() && valve < valves_.size(); ++valve) {
        const std::string path = surfaces_.path_of(step, all_.part_of(valve));
        if (ranks::is_first()) check(riis_vtk_surface_write(valves_[valve].surface(), path.c_str()));
        surfaces_.add(times()[step], valve, path);
      }
      const auto *const begin = n_marked.data() + kind_of(step, 0);
      table_.add(times()[step], valves_, {begin, begin + valves_.size()}, seconds_[step]);
    }
    ranks::agree();
    for (const SeriesFiles *files : {&lists_, &surfaces_})
      if (files->n_written() > 0) files->write_list();
    if (!options().series.table.empty() && !is_stopped) write_text(options().series.table, table_.text());
  }

  void write_list(const std::vector<std::string> &files, const std::string &path) {
    std::vector<const char *> names;
    for (const std::string &file : files) names.push_back(file.c_str());
    check(riis_vtk_pieces_set_files(sample_.get(), view(names).size(), names.data()));
    check(riis_vtk_pieces_write(sample_.get(), path.c_str()));
  }

  Case &all_;
  const MeshPieces &pieces_;
  std::vector<MovingValve> valves_;
  SeriesFiles lists_, parts_, surfaces_;
  SeriesTable table_;
  std::vector<std::string> names_;
  MeshCounts counts_;
  LooseNodes loose_;
  NodeCounts node_counts_;                  // a kind for each valve at each time
  std::vector<std::int32_t> are_complete_;  // by valve
  std::vector<double> seconds_;             // by step
  std::vector<std::vector<SharedNode>> shared_;
  std::vector<std::unique_ptr<PieceLeaks>> leaks_;  // by valve
  PassageCheck passage_;
  std::vector<WrittenPart> written_;
  PieceList sample_;  // with the arrays of this rank's first file, if there is one
};

}  // namespace

ExitCode run_series_in_pieces(Case &all, const MeshPieces &pieces) { return SeriesInPieces(all, pieces).run(); }

}  // namespace riis::program
