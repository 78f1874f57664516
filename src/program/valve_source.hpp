// SPDX-License-Identifier: Apache-2.0
// In: the description of a valve, from the command line or from a case. Out: the valve or the file with its surface, and the
// surface.
#pragma once

#include <string>
#include <vector>

#include "program/handles.hpp"
#include "program/opening_law.hpp"
#include "program/options.hpp"
#include "program/report.hpp"

namespace riis::program {

// One valve of a run.
struct ValveSource {
  MarkOptions options;  // as the command line of this valve alone would give them
  Valve valve;          // null if a file holds the surface
  SurfaceFile file;     // null for a valve, and for a surface that moves
  OpeningLaw law{0.0};
  Keyframes keyframes{};        // of a surface that moves
  bool has_open_state = false;  // that the user chose
  std::string subject{};        // goes before refusals, such as the place in a case; "" for the command line
};

// subject goes before the refusal of a kind.
Valve make_kind(const std::string &kind, const std::string &subject);
// Whether a file of patches that cannot open so far is refused here, in place of where its surface is made.
enum class OpeningCheck { no, yes };
// Makes the valve of --valve, --params and the options that go with them.
Valve make_valve(const ValveOptions &options, OpeningCheck opening = OpeningCheck::yes);
double opening_of(const riis_valve *valve);
Valve copy_of(const riis_valve *valve);
// Returns "" if the valve opens, or else why it has one state, as the library says it. The options are those of surfaces that
// the valve is fit for at 0. Leaves the opening at 1.
std::string why_closed(riis_valve *valve, const riis_surface_options &how);

// Adds to the component's refusal of a mesh the command that makes a readable file of it.
void check_mesh_read(riis_status status, const std::string &path);
// Reads the surface of --surface and --leaflets.
SurfaceFile read_surface(const ValveOptions &options, Seconds &seconds);

// Which velocities a surface from a file has.
enum class FileVelocity { none, zero };
Surface make_surface(const ValveSource &source, FileVelocity velocity);

int64_t count_leaflets(const riis_surface *surface);

// --surface FILE.pvd: the surface of a motion by frames.

// Tells whether --surface is a motion, which ends in .pvd.
bool is_motion_file(const std::string &surface);

// --surface FILE.pvd, and the files that hold its frames.
struct KeyframeFiles {
  Keyframes keyframes;
  std::vector<std::string> files;
};
KeyframeFiles read_keyframes(const ValveOptions &options, Seconds &seconds);

// Makes the surface at options.time, with velocities.
Surface surface_of_keyframes(const ValveOptions &options, const riis_keyframes *keyframes);

// In: a file that cannot be read as it is. Out: the command that makes a readable file of it.

enum class Content { mesh, surface };

// Such as "; gmsh converts it: gmsh -save in.msh -format vtk -o in.vtk". It is "" for an ending that can be read or is
// unknown.
std::string conversion_hint(const std::string &path, Content wanted);

}  // namespace riis::program
