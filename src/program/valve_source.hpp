// SPDX-License-Identifier: Apache-2.0
// In: the description of a valve, from the command line or from a case. Out: the valve, or the file with its surface, and the
// surface itself.
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
  Keyframes keyframes{};        // the motion of a surface that moves
  bool has_open_state = false;  // the user chose an open state
  std::string subject{};        // text before refusals, such as the place in a case; "" for the command line
};

// subject goes before the refusal of a kind.
Valve make_kind(const std::string &kind, const std::string &subject);
// yes: make_valve refuses a file of patches that cannot open that far. no: making the surface refuses it.
enum class OpeningCheck { no, yes };
// Makes the valve of --valve, --params and the options that go with them.
Valve make_valve(const ValveOptions &options, OpeningCheck opening = OpeningCheck::yes);
double opening_of(const riis_valve *valve);
Valve copy_of(const riis_valve *valve);
// Returns "" if the valve opens, or the library's reason for its single state. With these options the valve must make a surface
// at 0. The call leaves the opening at 1.
std::string why_closed(riis_valve *valve, const riis_surface_options &how);

// Adds a command to the component's refusal of a mesh. The command makes a readable file of the mesh.
void check_mesh_read(riis_status status, const std::string &path);
// Reads the surface of --surface and --leaflets.
SurfaceFile read_surface(const ValveOptions &options, Seconds &seconds);

// The velocities of a surface from a file.
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

// Returns a hint such as "; gmsh converts it: gmsh -save in.msh -format vtk -o in.vtk". The hint is "" for an ending that can
// be read or is unknown.
std::string conversion_hint(const std::string &path, Content wanted);

}  // namespace riis::program
