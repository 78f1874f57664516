// SPDX-License-Identifier: Apache-2.0
// A report has the results and the times of a run. It is written as JSON for programs, and as a short table for the user.
#pragma once

#include <riis/riis.h>

#include <optional>
#include <string>
#include <vector>

#include "program/base/options.hpp"

namespace riis::program {

// The change of the opening from one step of --steps to the next. The valve opens in 50 steps.
inline constexpr double opening_of_step = 0.02;

// The median times of a step, from all steps of --steps.
struct StepTimes {
  std::int32_t n_steps;
  std::int32_t search;      // RIIS_SEARCH_*
  double surface, marking;  // seconds
};

struct Seconds {
  double read = 0;     // reading files
  double surface = 0;  // making triangles
  double scene = 0;    // grouping the triangles, without Embree's tree
  double mesh = 0;     // checking the nodes
  double adjacency = 0;
  double search = 0;
  double leaks = 0;  // finding the edges, and the half thickness that closes the leaks
  double write = 0;  // writing files
  double picture = 0;
};

// Lengths that close leaks, for the user to type. A length is 0 if none was found or needed.
struct Closing {
  double half_thickness = 0;
  double skirt = 0;  // of a surface from a file
};

struct PassageReport {
  riis_passage found{};
  bool is_end = false;  // true if the position is an end of the path, so that the passage may be wider
  Closing closing{};
  std::string place{};      // the position, as text
  bool is_unknown = false;  // true if the passage is closed along the known edges, but unknown edges may open it
};

struct LeakReport {
  riis_leak_list found{};      // only its numbers are valid, not its pointers
  std::vector<int64_t> edges;  // (2, found.n_edges), for a whole mesh
  Closing closing{};
  int64_t n_volume_cells = 0;
  int64_t n_cells_left_out = 0;  // volume cells whose edges are not known

  bool has_all_edges() const { return n_volume_cells > 0 && n_cells_left_out == 0; }
};

// The measures of the valve and the mesh that matter for a flow.
struct FlowReport {
  std::optional<riis_orifice> orifice;      // set if the surface has an outline
  std::optional<double> orifice_opening;    // set if the orifice has another opening than the marks
  std::optional<riis_cells_across> cells;   // set if the mesh's edges are known
  std::optional<int64_t> n_open_regions;    // set if the mesh's edges are known
  std::optional<riis_first_passage> first;  // set if the first passage was looked for
  std::optional<double> closed_area;        // in the mesh; set for a closed valve in a mesh of one type of element
  std::optional<double> leak_per_drop;  // per Pa if the unit of the mesh is known; set if the user gave a resistance
};

// The shares of the leaflets' area that lie farther than the half thickness outside the mesh.
struct OutsideReport {
  struct Leaflet {
    std::string name;
    double share;
  };
  double share = 0;               // of the area of all leaflets
  std::vector<Leaflet> leaflets;  // with a share above 0
  std::optional<double> opening;  // set if it differs from the opening of the marks
};

// Returns a text such as "12.3 MB".
std::string bytes_text(double n);

// has_slits returns whether an orifice has an area but hardly a perimeter, because narrow slits count only in the area.
// slits_text is the text about slits.
bool has_slits(const riis_orifice &orifice);
inline constexpr const char *slits_text =
    ", where slits narrower than a fifth of the half thickness do not count: only the open area contains them";

struct CrossingReport {
  int n_openings = 0;             // number of openings checked, or 0 if only the given surface was checked
  std::optional<double> opening;  // the opening at which a crossing was found
  riis_crossing_list found{};     // only its numbers are valid, not its pointers
};

// A valve at a time of a series.
struct TimeReport {
  double time;
  std::optional<double> opening;  // not set for a surface from a file
  int64_t n_marked;
  double largest_speed;
};

// The attached edges from which the skirt of a surface from a file leads to the wall.
struct AttachedReport {
  std::int64_t n_edges;
  double length, middle[3];
};

// One valve of a run. In a series, the numbers belong to the valve's least opening.
struct ValveReport {
  double distance_limit() const {
    const double limit = options->mark_options.distance_limit;
    return limit > 0 ? limit : surface.half_thickness;
  }

  const MarkOptions *options = nullptr;  // of this valve; they must outlive the report
  std::string name;                      // the valve's name among several, or "" for the only one
  std::string surface_name;              // the valve's kind, or a file
  std::optional<double> opening;         // not set for a surface from a file
  std::optional<double> time;            // set for a surface that moves, without a series
  int64_t n_leaflets = 0;                // number of leaflets that --leaflets found in a file; 0 if it is not printed
  riis_surface_info surface{};
  std::optional<riis_gap> gap;             // set if a skirt reaches a wall
  std::optional<AttachedReport> attached;  // set if a surface from a file has a skirt
  riis_mark_stats marks{};
  LeakReport leaks;
  FlowReport flow;
  std::optional<OutsideReport> outside;     // set if the mesh has volume cells
  std::optional<CrossingReport> crossings;  // set if crossings were looked for
  std::vector<TimeReport> times;            // the steps of a series that are complete
};

struct Report {
  bool is_series() const { return !options->series.times.empty(); }
  bool has_mesh() const { return !options->mesh.empty(); }

  const MarkOptions *options = nullptr;  // of the run; they must outlive the report
  int64_t n_cells = 0;
  std::optional<int64_t> n_written;  // number of nodes in each file of a series, if they are only a part of the mesh
  std::vector<ValveReport> valves;
  std::optional<PassageReport> passage;  // set if two points are checked
  Seconds seconds;
  std::vector<std::string> written;  // paths of files
  std::optional<StepTimes> step;
};

// Returns a number as text with commas between thousands, such as "15,745".
std::string grouped(int64_t n);
// Returns a number with its noun in the singular or plural, such as "1 node".
std::string counted(int64_t n, const char *singular);
// Returns a text such as "mitral valve, opening 0.5".
std::string surface_title(const ValveReport &valve);
// Returns the reason why leaks are unknown, such as "MESH has no volume cells". Returns "" if all edges of the mesh are known.
std::string why_unknown(const LeakReport &leaks, const std::string &mesh);
std::string json_of(const Report &report);
std::string table_of(const Report &report);
// The table of a series has a line for each complete step. The columns are time, opening, n_marked, largest_speed and seconds. If
// there are several valves, each valve has columns that begin with its name, such as NAME_opening.
std::string csv_head_of(const Report &report);
// Returns the line of the last step. `seconds` is the time of its surfaces and marks.
std::string csv_line_of(const Report &report, double seconds);

}  // namespace riis::program
