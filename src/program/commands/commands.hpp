// SPDX-License-Identifier: Apache-2.0
// The commands of the program. run.cpp calls them.
//
// riis states measures free edges, leaflet areas, the orifice and the coaptation. A valve is measured at openings from 0 to
// 1, in its own frame. A surface from a file is measured as it is, or at the times of its frames.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/base/options.hpp"
#include "program/base/refusal.hpp"
#include "program/cli/command_line.hpp"

namespace riis::program {

struct LeafletSize {
  double edge;  // length of the free edge
  double area;
};

struct OrificeSize {
  double area, perimeter, effective_area;  // as in riis_orifice
};

struct ContactSize {
  double area, edge;  // as in riis_coaptation, of all leaflets
};

struct State {
  double opening;  // or the time
  std::vector<LeafletSize> leaflets;
  std::optional<OrificeSize> orifice;
  std::optional<ContactSize> contact{};
};

struct States {
  std::vector<std::int32_t> ids;  // ids of the leaflets, ascending
  std::vector<std::string> names;
  std::string why_no_edges;   // "": the leaflets have free edges
  std::string disc;           // such as "the disc of radius 1.1"; "": the valve has no orifice
  double disc_area;           // outline_area of the closed state
  std::string reach;          // the distance that the band's rim reaches into the orifice, as text
  std::vector<State> states;  // ascending by opening; the first is closed
  std::string why_closed;     // the library's refusal of other openings; "" if the valve opens
  bool is_of_file = false;    // whether the states are of a surface from a file, by time

  bool has_edges() const { return why_no_edges.empty(); }
};

// Measures the valve of the options at n_states openings, or only at 0 if the valve does not open.
States measure_states(const StatesOptions &options);

// Measures the states, writes the table, and prints the summary.
void run_states(const StatesOptions &options);

// In: the states of a valve. Out: the table as CSV, and a summary for people.

// The columns are opening, then NAME_edge, NAME_edge_ratio, NAME_area and NAME_area_ratio of each leaflet, then orifice_area,
// orifice_perimeter and effective_area.
// Ratios are relative to the closed state.
std::string csv_of(const States &states);

std::string summary_of(const States &states, const StatesOptions &options);

// riis place. In: landmarks of a patient. Out: the sizes and the placement of the valve, as a report, as a file that every
// command takes, and as text for OpenFOAM, C and Fortran.

void run_place(const PlaceOptions &options);

// riis size-field. In: valves and their motion. Out: a grid of edge lengths, small near the valves, as gmsh reads it.

// The largest number of points of the grid.
inline constexpr std::int64_t most_field_points = 20'000'000;

// Measures the distances of the grid's points to the valves at all times, and writes the edge lengths. Throws a Refusal.
ExitCode run_size_field(const SizeFieldOptions &options);

// In: the user's request. Out: the files, and the report on stdout. The stages of marking at one time are, in this order:
// surface, mesh, marks, files, pictures, report. series.hpp and case.hpp describe the stages of series and cases.

// Returns exit_fine, or exit_none_marked if no node was marked and the user did not allow that. With --strict, may return
// exit_warned. Throws a Refusal.
ExitCode run(const Request &request);

}  // namespace riis::program
