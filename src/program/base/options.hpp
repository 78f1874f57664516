// SPDX-License-Identifier: Apache-2.0
// The options of each command, as the user gave them. The program checks only the form of an option, and the library checks its
// value.
#pragma once

#include <riis/riis_vtk.h>
#include <riis/riis.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/base/quantities.hpp"
#include "program/base/refusal.hpp"
#include "program/base/units.hpp"

namespace riis::program {

// The options of a surface and its placement. Every command has some or all of these options.
struct ValveOptions {
  std::string valve = "aortic";            // a kind, or a .json file; unused if there is a surface
  std::string disease;                     // the name of a disease, whose kind is then `valve`; "": none
  std::string placed;                      // the file of a placed valve, whose kind is then `valve`; "": none
  std::string surface;                     // a file, or "" for the valve; one name for all if there are several files
  std::vector<std::string> surface_files;  // the files of the surface, one for each leaflet if there are several
  double frame_step = 1;                   // the time between frames of svMultiPhysics
  std::string leaflets;        // leaflets of the surface: "connected", the name of a cell array, or "" for riis_leaflet
  std::optional<double> time;  // the time of a surface that moves
  double period = 0;           // period of the surface's motion or of the cycle; 0 if there is none
  std::string params, params_open;    // JSON files; "": none
  std::vector<std::string> settings;  // NAME=VALUE, in the order of typing
  std::optional<double> opening;      // from 0 to 1
  std::optional<double> skirt;        // length of a skirt in the mesh's unit; with a wall, the longest to accept
  std::string wall;                   // a file with the wall that the skirt reaches; "": none
  std::string cells_where;            // NAME=VALUES: the cells of the mesh that count; "": all
  std::string warp;                   // a file of landmarks on the valve and in the patient; "": none
  riis_surface_options surface_options = defaults<riis_surface_options>();
  std::optional<Unit> unit, surface_unit;  // units of the mesh and of the surface's file; they give the scale
  std::optional<Unit> placed_unit;         // unit of the file of a placed valve
  bool takes_placed_unit = false;          // the user named no unit, so `unit` is that of the placed valve
  bool has_doubted_unit = false;  // the sizes contradict `unit`, so messages give the mesh's lengths without it
  // These members are true if the user gave the scale, the half thickness or the tolerance as a number. The reader of a case and
  // the checks of the command line set these members.
  bool has_scale = false, has_half_thickness = false, has_tolerance = false;
  std::int32_t n_threads = 0;  // 0: the library chooses by the amount of work
  bool quiet = false;
  bool strict = false;  // a warning changes the exit status
};

// The names of the searches, and of the ways to measure distances. A name's position in the list is the value of its constant
// RIIS_SEARCH_* or RIIS_MEASURE_*.
inline const std::vector<std::string> search_names = {"auto", "exhaustive", "neighbor", "paper", "clusters"};
inline const std::vector<std::string> distance_names = {"triangles", "sampling", "minimization"};

// The names of the views that pictures and movies accept. A name's position in the list is the value of its constant
// RIIS_VTK_VIEW_*.
inline const std::vector<std::string> view_names = {
    "side", "top", "oblique", "three", "valve-side", "valve-top", "valve-oblique", "valve-three", "valve-long"};

struct Picture {
  std::string path;
  std::int32_t view;
};

// The names of captions and panels. A name's position in the list is the value of its constant RIIS_VTK_CAPTIONS_* or
// RIIS_VTK_PANELS_*.
inline const std::vector<std::string> caption_names = {"all", "scale", "none"};
inline const std::vector<std::string> panel_names = {"both", "valve", "marks"};

struct PictureSize {
  std::int32_t width = 1600, height = 800;
  static constexpr std::int32_t least = 64, most = 8192;  // the range that riis_vtk accepts
};

// How the pictures and the movie of a run look.
struct PictureStyle {
  std::optional<PictureSize> size;                  // not set if the user gave none
  std::array<double, 4> background = {1, 1, 1, 1};  // red, green, blue and opacity
  std::int32_t captions = RIIS_VTK_CAPTIONS_ALL;
  std::int32_t panels = RIIS_VTK_PANELS_BOTH;
  std::string velocity;  // the array whose speed is drawn; "": none
};

// The options for a series in time, and for a case with several valves.
struct SeriesOptions {
  std::string case_file;      // "" if the command line describes the only valve
  std::vector<double> times;  // ascending; empty if there is no series
  std::string cycle;          // a file
  std::int32_t interpolation = RIIS_INTERPOLATION_LINEAR;
  std::string movie, table;  // "" if not wanted
  double frame_rate = 10;    // frames per second
  std::int32_t movie_view = RIIS_VTK_VIEW_OBLIQUE;
  bool all_cells = false;
};

// Two points that the valve should separate, and their texts for messages.
struct LeakCheck {
  const double *point(int end) const { return points.data() + 3 * end; }
  [[noreturn]] void refuse(const std::string &why) const { throw Refusal{exit_code, subject + ": " + why}; }

  std::vector<double> points;  // (3, 2)
  std::string subject;
  ExitCode exit_code = exit_wrong_usage;
};

// The options of riis mark. The commands riis surface and riis check use some of these options. riis surface has no mesh.
struct MarkOptions : ValveOptions {
  std::string mesh;  // "" if there is none
  std::vector<std::string>
      pieces;              // the files of a mesh in pieces; empty before its list is read, and for other meshes
  bool needs_mesh = true;  // whether a case must name a mesh
  bool at_cells = false;   // whether the centres of cells are marked
  riis_mark_options mark_options = defaults<riis_mark_options>();
  double far_distance = RIIS_FAR_DISTANCE;
  // The resistance R determines the array of K. For OpenFOAM, K is divided by the density. given_drop is the pressure drop for
  // the ideal leak.
  std::optional<Amount> given_resistance, given_drop, density;
  std::optional<std::string> chosen_K_unit;
  std::optional<double> resistance;           // R in the units of the mesh
  double K_factor = 1;                        // K in the file, divided by K in the units of the mesh
  std::string K_unit, K_u_surface_unit;       // in the file; "" if the unit of the mesh is not known
  std::string output, surface_output, stats;  // "" if not wanted
  std::string surface_output_option = "--surface-output";
  std::vector<Picture> pictures;
  PictureStyle style;
  std::int32_t n_steps = 0;     // number of steps to be timed
  std::string prefix = "riis";  // the prefix of the arrays in the output
  bool replace = false;         // whether to replace existing arrays with these names
  bool allow_none = false;
  bool check_crossing = false;
  std::optional<LeakCheck> check_leaks;
  bool demand_sealed = false;  // a leak changes the exit status
  bool first_passage = false;  // looks for the opening at which the points are first joined
  bool measures = false;       // takes the measures that matter for a flow, also without --stats
  SeriesOptions series;
};

// The options of riis size-field. Lengths have the mesh's unit.
struct SizeFieldOptions : MarkOptions {
  SizeFieldOptions() { needs_mesh = false; }

  std::string field;                   // the file of the grid; "-" is stdout
  double band_edge = 0.95;             // edge length in the band, in half thicknesses
  double growth = 0.3;                 // increase of the edge length per unit of distance from the band
  std::optional<double> largest_edge;  // default 4 half thicknesses
  std::optional<double> spacing;       // spacing of the grid; by default half of the half thickness
  std::int32_t n_openings = 41;        // number of openings of a valve
};

// The options of riis states.
struct StatesOptions : ValveOptions {
  std::string output;           // the file of the table; "-" is stdout
  std::int32_t n_states = 101;  // number of openings in the table
  bool has_contacts = false;    // whether the table has the coaptation
};

// The options of riis from-area. Areas are in the square of the mesh's unit of length.
struct AreaOptions : ValveOptions {
  std::optional<Amount> given_area;
  std::optional<double> area;            // the area of the valve, or nothing if a file has areas
  std::string areas;                     // a file of areas in time; "": none
  std::optional<std::string> area_unit;  // the unit of the areas in that file
  double area_factor = 1;                // factor from the areas in that file to the mesh's unit
  bool is_effective = false;             // the areas are effective areas
  std::string solve = "opening";         // "opening", "scale" or a parameter
  std::optional<double> from, to;        // the range of the search
  std::string output;                    // the file of the cycle; "-" is stdout, "": none
};

struct TimeSpan {
  double start, stop;
};

// How riis export passes the ring of a bileaflet valve to the solver: as a face beside the leaflets, or not at all. The ring does
// not become the solver's scaffold, because the solver would add the scaffold's K to the leaflets' K (docs/export.md).
enum UrisRing : std::int32_t { ring_face, no_ring };

// The options of riis export.
struct ExportOptions : ValveOptions {
  std::string folder;
  std::string mesh;  // the mesh of the solver's run, for a forecast; "": none
  double time_step = 0;
  // The forecast uses the density and the viscosity, which by default are those of blood.
  std::optional<Amount> given_resistance, given_density, given_viscosity;
  double resistance = 0, density = 0, viscosity = 0;  // in the solver's units, g, cm and s
  double to_solver = 1;  // the factor from the mesh's unit of length to the solver's, which is cm
  std::optional<double> opening_duration, closing_duration;  // used without a cycle
  std::string cycle;                                         // a file
  std::int32_t interpolation = RIIS_INTERPOLATION_LINEAR;
  std::optional<TimeSpan> opening_span, closing_span;  // spans of the cycle's time
  double largest_edge = 0;                             // 0: the library's own triangles
  std::string name;                                    // of the valve in the solver; "": from the folder
  std::string starts;                                  // "closed" or "open"; "": the state of the cycle at time 0
  std::int32_t ring = ring_face;                       // a UrisRing
};

// Whether riis place writes a warp to the landmarks. The landmarks have noise, so a smoothed warp need not meet them exactly.
enum LandmarkWarp : std::int32_t { no_warp, exact_warp, smoothed_warp };

// The options of riis place.
struct PlaceOptions : ValveOptions {
  std::string landmarks, mesh;                                // files; the mesh may be ""
  bool has_valve = false;                                     // whether the user named the kind
  std::string axes;                                           // of the mesh, or "" for the landmarks' axes
  std::int32_t warp_choice = 0;                               // a LandmarkWarp
  std::optional<double> noise;                                // noise in the unit of --unit or of the landmarks
  std::optional<std::vector<double>> flow;                    // in the mesh's axes
  std::string output, foam_output, c_output, fortran_output;  // "" if not wanted, "-" for stdout
};

// The options of riis patient. `wall` is the file of the wall. Points are in the wall's unit. Lengths without a unit are also in
// the wall's unit.
struct PatientOptions : ValveOptions {
  std::string landmarks, folder;             // a file, and the folder for the results
  bool has_valve = false;                    // whether the user named the kind
  std::string solver = "none";               // one of solver_names
  std::optional<Unit> wall_unit;             // of the wall's file; nothing: found from the landmarks
  std::string axes;                          // of the wall: "LPS" or "RAS"; "": found from the landmarks
  std::int32_t warp_choice = smoothed_warp;  // a LandmarkWarp
  std::optional<Amount> noise;               // of the landmarks
  std::optional<std::vector<double>> flow;   // in the wall's axes
  std::optional<std::vector<double>> inlet;  // a point near the flat end where the blood enters
  std::vector<std::vector<double>> outlets;  // points near the other ends
  std::optional<Amount> given_half_thickness, given_skirt, given_largest_edge, given_resistance;
  std::optional<double> band_edge;  // in half thicknesses
  std::optional<double> hold;       // the opening at which the case holds the valve; nothing: the blood moves the valve
  std::optional<double> heart_rate;  // beats a minute
  bool replace = false;              // whether to replace the files of an earlier run
};
inline const std::vector<std::string> solver_names = {"none", "openfoam", "svmultiphysics", "fenicsx"};

// The options of riis params.
struct ParamsOptions : ValveOptions {
  bool describe = false;  // print a table instead of JSON
};

// Returns the names of the constants RIIS_TRIANGULATION_*. A name's position in the list is the value of its constant.
const std::vector<std::string> &triangulation_names();

// Computes the scale from the units, and also the half thickness if the user gave none.
void apply_units(ValveOptions &options);

// Computes R, and the unit of K in the output, from the unit of the mesh. Refuses options that contradict the unit.
void apply_amounts(MarkOptions &options);

// Returns whether the user gave the valve's opening by --opening or --set.
bool sets_opening(const ValveOptions &options);

// Returns whether `name` is valid as the beginning of the names of arrays.
bool is_prefix(const std::string &name);

}  // namespace riis::program
