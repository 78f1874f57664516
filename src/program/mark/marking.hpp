// SPDX-License-Identifier: Apache-2.0
// The inputs are the valves and the times of a case, and the pieces of a mesh, one by one. The results are marks in the pieces,
// and the report about all of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/array_view.hpp"
#include "program/base/refusal.hpp"
#include "program/base/units.hpp"
#include "program/input/case.hpp"
#include "program/mark/leaks.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/mark/moving_valve.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// A run derives from this class, and writes the files.
class Marking {
 protected:
  // Makes the surfaces of the valves. The case and the mesh must outlive this object.
  Marking(Case &all, const MeshPieces &mesh);

  // Marks a piece with all valves at all times, and stores the numbers for the report. Without a series, the marks are stored as
  // arrays of the piece.
  void measure(Piece &piece);
  // Completes the report, except for the times and the files, and prints warnings. Before this call, all ranks must have measured
  // their pieces.
  void judge();
  // Moves the valves to a step of a series.
  void move_to_step(std::size_t step);
  // Moves the valves to a step, marks the nodes of a file, and sets its arrays.
  void mark_step(FileNodes &nodes, riis_vtk_mesh *file, std::size_t step);
  // The next two functions may be called after judge(). `n_marked` is the number of marked nodes in all pieces.
  std::int64_t n_marked(std::size_t step, std::size_t valve) const { return view(n_marked_)[marked_at(step, valve)]; }
  bool has_marks() const;
  const MarkOptions &options() const { return all_.options; }

  Case &all_;
  const MeshPieces &mesh_;
  std::vector<MovingValve> valves_;
  Report report_;
  const std::vector<double> times_;
  std::vector<std::int64_t> near_;  // in a series: the nodes of the last piece to which the valves came near
  Box swept_ = empty_box();         // around all surfaces at all times; set for a movie

 private:
  // The sums of one valve over all pieces.
  struct ValveSums {
    MeshLeaks leaks;
    riis_mark_stats marks{};
    std::size_t most_step = 0;  // the step with most marked nodes
    BandMeasures band{};
    std::vector<std::vector<SharedNode>> shared{};  // by piece, with the open regions of this valve
    std::vector<LeafletsOutside> outside{};         // at the least opening, and in a series at the largest
  };

  // Velocities need an earlier time, so a single time has no velocities.
  bool has_velocities() const { return times_.size() > 1; }
  std::int32_t fields() const;
  // Returns the report of a valve's surface at its present position.
  ValveReport report_of(std::size_t i);
  // The node counts have several kinds: marked nodes at each step, and nodes within the distance limit at the least opening.
  std::size_t marked_at(std::size_t step, std::size_t valve) const { return step * valves_.size() + valve; }
  std::size_t within_limit(std::size_t valve) const { return marked_at(times_.size(), valve); }
  LeafletsOutside outside_of(std::size_t i) const {
    return {valves_[i].options(), valves_[i].surface(), valves_[i].opening()};
  }

  void check_new_arrays(const riis_vtk_mesh *file) const;
  void find_neighbors_for_search(Piece &piece);
  void mark_at_all_times(Piece &piece);
  void set_arrays(riis_vtk_mesh *file) const;
  void report_marks(std::size_t i, std::int64_t n_nodes, const MeshCounts &counts);
  void warn_of_marks(std::int64_t n_nodes, const MeshCounts &counts);
  void report_outside(std::size_t i, const MeshCounts &counts);
  // For the valve at its present position, prints the number of marked nodes in each possible unit.
  void compare_units(std::size_t i, const std::vector<PossibleUnit> &units) const;
  void report_orifices();

  const bool wants_measures_;
  MeshCounts counts_;
  std::vector<NodeKey> loose_;
  NodeCounts node_counts_;
  std::vector<std::int64_t> n_marked_;  // by kind of node_counts_, once all pieces are marked
  std::vector<ValveSums> sums_;         // by valve
  PassageCheck passage_;
};

// riis mark, riis surface, riis check leaks and riis check crossings share the code below. A run works on all its valves, at all
// its times, in all its pieces. A whole mesh counts as one piece, a single state as one time, and a valve of the command line as
// a case with one valve. Without a mesh there are no pieces.
//     case -> surfaces -> pieces, read one by one -> marks, leaks, measures -> files -> report

// Reads the case or the valve of the options, marks the mesh, writes the files and prints the report. Returns exit_none_marked if
// no node was marked at any time, unless the user allowed this. Returns exit_warned if a check found a fault, and exit_fine
// otherwise. Throws a Refusal.
ExitCode run_mark(const MarkOptions &given);

// Marks a mesh that the caller has read. The function checks no options and prints no report. `all.options.mesh` must be the path
// of the mesh.
Report mark_case(Case &all, const MeshPieces &mesh);

}  // namespace riis::program
