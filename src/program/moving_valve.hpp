// SPDX-License-Identifier: Apache-2.0
// One valve of a series: its surface at a time, with velocities or without, and its marks.
#pragma once

#include <riis/riis.h>
#include <riis/riis_vtk.h>

#include <cstdint>
#include <string>
#include <vector>

#include "program/case.hpp"
#include "program/handles.hpp"
#include "program/valve_source.hpp"

namespace riis::program {

class MovingValve {
 public:
  // Borrows the source, and makes the surface at the time.
  MovingValve(ValveSource &source, double time);

  // Moves the surface to a time. The second form also gives mean velocities since the earlier time.
  void move_to(double time);
  void move_to(double time, double since);
  // Marks with these RIIS_FIELD_*. Velocities need the second form of move_to as the last move.
  void mark(const riis_mesh *mesh, int32_t fields);

  const MarkOptions &options() const { return source_.options; }
  const ValveSource &source() const { return source_; }
  const riis_surface *surface() const { return surface_.get(); }
  riis_marks *result() const { return result_.get(); }
  double opening() const { return opening_; }  // 0 for a surface from a file
  double largest_speed() const;                // of a vertex
  riis_mark_stats stats() const;

 private:
  // For refusals.
  const std::string &subject() const { return source_.subject.empty() ? options().valve : source_.subject; }

  ValveSource &source_;
  Valve before_;
  Surface surface_;
  Marks result_;
  double opening_ = 0;
  bool is_at_rest_ = false, has_velocities_ = false;
};

// Looks for leaks of each valve at its last marked place, in all nodes of the file. Warns on stderr.
void look_for_leaks_of(const Case &all, const std::vector<MovingValve> &valves, riis_mesh *mesh,
                       const riis_vtk_mesh *file);

// Makes the valves of a case, at the first time of a series, and tries each one with its options.
std::vector<MovingValve> moving_valves(Case &all);

// In: the surfaces of several valves. Out: their triangles in one surface, with leaflets numbered on from valve to valve.

// Returns one more than the largest id.
int32_t n_leaflets_of(const riis_surface *surface);
// Returns each valve's first leaflet among the leaflets of all valves, and the number of all.
std::vector<int32_t> first_leaflets(const std::vector<MovingValve> &valves);
// options may be NULL, for the defaults.
Surface joined_surface(const std::vector<MovingValve> &valves, const riis_surface_options *options = nullptr);

}  // namespace riis::program
