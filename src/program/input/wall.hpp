// SPDX-License-Identifier: Apache-2.0
// The inputs are --skirt and --wall. The results are the gap between a valve and a wall, and a skirt from a valve or a surface to
// the wall.
#pragma once

#include <riis/riis.h>

#include <string>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/options.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// Gives the valve the skirt that --skirt and --wall describe. Without --skirt, the function does nothing. Refusals that are not
// about the wall begin with `subject`. Refuses a wall if it is farther away than --skirt at one of the openings. Warns of holes
// in the wall.
void set_skirt(const ValveOptions &options, riis_valve *valve, const std::string &subject);

// The arrays of a surface from a file, including the skirt that --skirt and --wall describe.
class SkirtOfFile {
 public:
  // Without --skirt, the arrays have neither a skirt nor an attachment. With --wall, the vertices of the arrays must be those of
  // the closed valve. Refuses a wall that is farther away than --skirt. Warns of holes in the wall.
  SkirtOfFile(const ValveOptions &options, riis_surface_arrays arrays);
  const riis_surface_arrays &arrays() const { return arrays_; }
  // Refuses a wall that is farther away than --skirt at one of the times.
  void check_times(const riis_keyframes *keyframes, const std::vector<double> &times) const;

 private:
  const ValveOptions &options_;
  riis_surface_arrays arrays_;
  std::vector<double> lengths_;  // which arrays_ borrows
  Surface wall_;                 // null without --skirt and --wall
};
// If the library refuses the arrays, the refusal also says how a file names the attached vertices.
std::string with_attached_array(std::string text);

// Returns the length and the middle of the attached edges.
AttachedReport attached_edges_of(const riis_surface *surface);

// Reads a wall from the file of a surface or of a volume mesh. The boundary of a volume mesh is its wall.
SurfaceFile read_wall(const std::string &path);
// Makes the surface of --wall.
Surface wall_of(const ValveOptions &options);
// Measures the gap between a valve's surface and the wall that --wall names.
riis_gap gap_to_wall(const ValveOptions &options, const riis_surface *surface);

}  // namespace riis::program
