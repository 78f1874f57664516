// SPDX-License-Identifier: Apache-2.0
// A valve of a run has a surface at the present time, which may have velocities, and marks. Other functions mark by any surface,
// and join surfaces.
#pragma once

#include <riis/riis.h>
#include <riis/riis_vtk.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/base/handles.hpp"
#include "program/input/case.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/mesh_pieces.hpp"

namespace riis::program {

Marks new_result();
// Marks the nodes of a mesh by a surface.
Marks marks_of(const riis_surface *surface, riis_mesh *mesh, const riis_mark_options &how);
// Returns options for marks by a surface that the user did not choose. Any search is allowed, and distances go up to a limit.
riis_mark_options how_to_mark_again(const MarkOptions &options, double limit = RIIS_AUTO);

bool needs_adjacency(int32_t search);

// Adds the K of a valve with a resistance at every node, and K u_surface unless its array (3, n) is empty.
void add_resistance(const MarkOptions &options, const riis_marks *result, std::vector<double> &K,
                    std::vector<double> &K_u_surface);

class MovingValve {
 public:
  // Keeps a reference to the source, and makes the valve's surface at the given time. `moves` tells whether the valve will move
  // to other times and have velocities.
  MovingValve(ValveSource &source, double time, bool moves);

  // Moves the surface to a time. If an earlier time is given, the surface also gets its mean velocities since that time.
  void move_to(double time, std::optional<double> since = std::nullopt);
  // Marks the nodes and computes `fields`, a sum of constants RIIS_FIELD_*. Velocities are known only if the last call of move_to
  // had the argument `since`.
  void mark(FileNodes &nodes, int32_t fields);
  // Forgets the marks of the last call. With the old marks, a search in another mesh would begin at wrong nodes.
  void forget_marks() { result_ = new_result(); }

  const MarkOptions &options() const { return source_.options; }
  const ValveSource &source() const { return source_; }
  const riis_surface *surface() const { return surface_.get(); }
  riis_marks *result() const { return result_.get(); }
  std::optional<double> opening() const;  // nothing for a surface from a file
  double largest_speed() const;           // the largest speed of a vertex
  riis_mark_stats stats() const { return stats_of(result_); }

  std::optional<CrossingReport> crossings{};  // set if crossings were looked for

 private:
  // Gives the valve its opening and its warp at a time.
  void set_time(double time, riis_valve *valve);
  // Returns the name of the valve for refusals.
  const std::string &subject() const { return source_.subject.empty() ? options().valve : source_.subject; }

  ValveSource &source_;
  Valve before_;
  Surface surface_;
  Marks result_;
  double opening_ = 0;
  bool is_at_rest_ = false, has_velocities_ = false;
};

// Makes the valves of a case at the first time, and looks for crossings in their shapes. Tries each valve's options on a single
// node, so that bad options are refused early.
std::vector<MovingValve> moving_valves(Case &all);

// Adds the triangles of a surface.
void add_triangles(Triangles &all, const riis_triangles &more);
// Returns one surface with the triangles of all surfaces, and with a skirt if the length is not 0. The leaflets of each surface
// are numbered after the leaflets of the surfaces before it.
Surface joined_surface(const std::vector<const riis_surface *> &surfaces,
                       const riis_surface_options &how = defaults<riis_surface_options>(), double skirt_length = 0);
// Returns options with the half thickness and the offset of a surface.
riis_surface_options with_band_of(const riis_surface *surface);
// Returns the surfaces of valves at their present positions.
std::vector<const riis_surface *> surfaces_of(const std::vector<MovingValve> &valves);

}  // namespace riis::program
