// SPDX-License-Identifier: Apache-2.0
// The input is the description of a valve, from the command line or from a case. The results are the valve or the file of its
// surface, and the surface.
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

// A valve whose parameters may still be set.
class NewValve {
 public:
  // `valve` is a kind, or a file of patches. `subject` begins the refusal of an unknown kind.
  NewValve(const std::string &valve, const std::string &subject);
  operator riis_valve *() const { return valve_; }
  // Hands over the valve. Refuses an opening if the valve's file has no open state. The library would also refuse it, but would
  // advise another valve.
  Valve take();
  Valve take_unchecked() { return std::move(valve_); }

 private:
  std::string path_;  // "" for a kind
  Valve valve_;
  bool can_open_ = true;
};
// `subject` begins the refusal of an unknown kind.
Valve make_kind(const std::string &kind, const std::string &subject);
// `yes`: make_valve refuses a file of patches whose valve cannot open as far as needed. `no`: the file is refused later, when the
// surface is made.
enum class OpeningCheck { no, yes };
// Makes the valve of --valve, and applies --params and the other options of a valve. `moving` receives the warp. If `moving` is
// NULL, a warp that moves is refused.
Valve make_valve(const ValveOptions &options, OpeningCheck opening = OpeningCheck::yes, WarpSource *moving = nullptr);
// Returns the words with which refusals of a valve's shape begin: the path of the valve's file, or "" for a kind.
std::string subject_of(const ValveOptions &options);
double opening_of(const riis_valve *valve);
// Returns n openings from 0 to 1.
std::vector<double> openings_from_0_to_1(std::int32_t n);
Valve copy_of(const riis_valve *valve);
// Returns the surface at an opening that the program chose, or null if the valve cannot have this opening. After the call, the
// valve has the opening that was tried.
Surface surface_at(riis_valve *valve, double opening, const riis_surface_options &how);
// Returns the library's reason why the valve cannot open, or "" if it can. The valve must allow a surface at opening 0 with the
// options `how`. After the call, the valve has opening 1.
std::string why_closed(riis_valve *valve, const riis_surface_options &how);

enum class Content { mesh, surface };
// Checks the status of reading a file. If riis_vtk cannot read the file, the refusal also has a command that converts the file.
void check_read(riis_status status, const std::string &path, Content content);
// Takes the files of --surface. Several files make one valve, and each file is one leaflet. Refusals begin with `subject`.
void set_surface(ValveOptions &options, const std::vector<std::string> &files, const std::string &subject);
// If the surface has several files, returns their names as the names of the leaflets. For one file, returns no names.
std::vector<std::string> leaflets_of_files(const ValveOptions &options);
// Reads the surface of --surface with the leaflets of --leaflets.
SurfaceFile read_surface(const ValveOptions &options, Seconds &seconds);

// The velocities that a surface from a file gets.
enum class FileVelocity { none, zero };
// Makes the surface. A moving surface is taken at options.time, and it has velocities.
Surface make_surface(const ValveSource &source, FileVelocity velocity);

// Returns the name of a leaflet. A leaflet without a name is called by the given word and its number. If each leaflet has a file,
// the leaflet's name is the name of the file.
std::string name_of_leaflet(const ValveOptions &options, const riis_surface_info &surface, std::int32_t leaflet,
                            const char *word = "leaflet ");
// Returns the name of a kind's leaflet. The name consists of letters, digits and _.
std::string file_name_of_leaflet(const std::string &kind, std::int32_t leaflet);
int64_t count_leaflets(const riis_surface *surface);

// --surface FILE.pvd or FILE.dat: a surface whose motion is given by frames.

// Returns whether --surface gives a motion. The files of motions end in .pvd or .dat.
bool is_motion(const ValveOptions &options);

// The motion of --surface, the paths of its frames' files, and the times of the frames.
struct KeyframeFiles {
  Keyframes keyframes;
  std::vector<std::string> files;
  std::vector<double> times;
};
KeyframeFiles read_keyframes(const ValveOptions &options, Seconds &seconds);

// The input is a file in a format that the program does not read. The result is a command that converts the file.

// Returns a hint such as "; gmsh converts it: gmsh -save in.msh -format vtk -o in.vtk". Returns "" if the program reads files
// with this ending, or if the ending is unknown.
std::string conversion_hint(const std::string &path, Content wanted, const std::string &refusal);

}  // namespace riis::program
