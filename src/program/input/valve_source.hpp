// SPDX-License-Identifier: Apache-2.0
// In: the description of a valve, from the command line or from a case. Out: the valve or the file with its surface, and the
// surface itself.
#pragma once

#include <string>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/options.hpp"
#include "program/input/opening_law.hpp"
#include "program/input/warp_source.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// One valve of a run.
struct ValveSource {
  MarkOptions options;  // as if this valve alone were on the command line
  Valve valve;          // null if the surface is in a file
  SurfaceFile file;     // null for a valve, and for a surface that moves
  OpeningLaw law{0.0};
  Keyframes keyframes{};        // the motion of a surface that moves
  bool has_open_state = false;  // whether the user chose an open state
  WarpSource warp{};            // empty unless the case warps the valve
  std::string subject{};        // begins refusals, such as "case.json: valve 0"; "" for the command line
};

// `subject` begins the refusal of an unknown kind.
Valve make_kind(const std::string &kind, const std::string &subject);
// `yes`: make_valve refuses a file of patches that cannot open far enough. `no`: such a file is refused only when the surface is
// made.
enum class OpeningCheck { no, yes };
// Makes the valve of --valve, --params and the options that belong to them. `moving` receives the warp. If it is NULL, a warp
// that moves is refused.
Valve make_valve(const ValveOptions &options, OpeningCheck opening = OpeningCheck::yes, WarpSource *moving = nullptr);
double opening_of(const riis_valve *valve);
// Gives the valve the skirt of --skirt and --wall. Does nothing without --skirt. `subject` begins refusals that are not about the
// wall.
void set_skirt(const ValveOptions &options, riis_valve *valve, const std::string &subject);
// Measures the gap between a valve's surface and the wall of --wall.
riis_gap gap_to_wall(const ValveOptions &options, const riis_surface *surface);
Valve copy_of(const riis_valve *valve);
// Returns the library's reason if the valve cannot open, or "" if it can. With these options, the valve must make a surface at
// opening 0. The call leaves the valve at opening 1.
std::string why_closed(riis_valve *valve, const riis_surface_options &how);

// Checks the status of reading a mesh. If riis_vtk cannot read the file, adds to the refusal a command that converts it.
void check_mesh_read(riis_status status, const std::string &path);
// Reads the surface of --surface, with its --leaflets.
SurfaceFile read_surface(const ValveOptions &options, Seconds &seconds);

// The velocities that a surface from a file gets.
enum class FileVelocity { none, zero };
Surface make_surface(const ValveSource &source, FileVelocity velocity);

int64_t count_leaflets(const riis_surface *surface);

// --surface FILE.pvd: the surface of a motion given by frames.

// Returns whether --surface is a motion, which ends in .pvd.
bool is_motion_file(const std::string &surface);

// The motion of --surface FILE.pvd, and the paths of the files with its frames.
struct KeyframeFiles {
  Keyframes keyframes;
  std::vector<std::string> files;
};
KeyframeFiles read_keyframes(const ValveOptions &options, Seconds &seconds);

// Returns the times of the frames.
std::vector<double> times_of_frames(const ValveOptions &options);

// Makes the surface at options.time, with velocities.
Surface surface_of_keyframes(const ValveOptions &options, const riis_keyframes *keyframes);

// In: a file in a format that the program does not read. Out: a command that converts it.

enum class Content { mesh, surface };

// Returns a hint such as "; gmsh converts it: gmsh -save in.msh -format vtk -o in.vtk". Returns "" for an ending that can be
// read or is unknown.
std::string conversion_hint(const std::string &path, Content wanted, const std::string &refusal);

}  // namespace riis::program
