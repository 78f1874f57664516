// SPDX-License-Identifier: Apache-2.0
// One valve of a series: its surface at the present time, with or without velocities, and its marks.
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
  // Borrows the source, and makes the surface at the given time.
  MovingValve(ValveSource &source, double time);

  // Moves the surface to a time. The second form also computes mean velocities since the earlier time.
  void move_to(double time);
  void move_to(double time, double since);
  // Marks with `fields`, a sum of RIIS_FIELD_*. For velocities, the last move must have used the second form of move_to.
  void mark(const riis_mesh *mesh, int32_t fields);

  const MarkOptions &options() const { return source_.options; }
  const ValveSource &source() const { return source_; }
  const riis_surface *surface() const { return surface_.get(); }
  riis_marks *result() const { return result_.get(); }
  double opening() const { return opening_; }  // 0 for a surface from a file
  double largest_speed() const;                // the largest speed of a vertex
  riis_mark_stats stats() const;

 private:
  // Returns the name for refusals.
  const std::string &subject() const { return source_.subject.empty() ? options().valve : source_.subject; }

  ValveSource &source_;
  Valve before_;
  Surface surface_;
  Marks result_;
  double opening_ = 0;
  bool is_at_rest_ = false, has_velocities_ = false;
};

// Looks for leaks of each valve at its last marked position, among all nodes of the file. Warns on stderr.
void look_for_leaks_of(const Case &all, const std::vector<MovingValve> &valves, riis_mesh *mesh,
                       const riis_vtk_mesh *file);

// Makes the valves of a case. In a series, the valves are at the series' first time. Tries each valve's options on a single node,
// so that bad ones are refused early.
std::vector<MovingValve> moving_valves(Case &all);

// In: the surfaces of several valves. Out: one surface with the triangles of all. The numbers of a valve's leaflets follow those
// of the previous valve.

// Returns the largest leaflet id plus one.
int32_t n_leaflets_of(const riis_surface *surface);
// Returns the number of each valve's first leaflet among the leaflets of all valves. The last entry is the number of all
// leaflets.
std::vector<int32_t> first_leaflets(const std::vector<MovingValve> &valves);
// `options` may be NULL. Then the defaults apply.
Surface joined_surface(const std::vector<MovingValve> &valves, const riis_surface_options *options = nullptr);

}  // namespace riis::program
