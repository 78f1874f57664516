// SPDX-License-Identifier: Apache-2.0
// The commands of the program, which run.cpp calls. A command throws a Refusal if it fails.
#pragma once

#include "program/base/options.hpp"
#include "program/base/refusal.hpp"
#include "program/cli/command_line.hpp"

namespace riis::program {

// riis states. Measures free edges, leaflet areas, the orifice and the coaptation, writes the table, and prints the summary. A
// valve is measured at openings from 0 to 1, in its own coordinates. A surface from a file is measured as it is. A moving surface
// is measured at the times of its frames.
void run_states(const StatesOptions &options);

// Returns the options of a surface that is measured in the valve's own coordinates. Only the scale of the placement is kept.
// Without --tolerance, the triangles are finer than those of riis mark.
riis_surface_options own_frame(const ValveOptions &options);

// riis from-area, the inverse of riis states. The input is an area, or areas in time. For one area, the result is a summary with
// the opening or the size that gives this area. For areas in time, the result is a cycle of openings.
void run_from_area(const AreaOptions &options);

// riis place. The inputs are landmarks of a patient. Prints the sizes and the placement of the valve: as a report, as a file that
// every command reads, and as text for OpenFOAM, C and Fortran.
void run_place(const PlaceOptions &options);

// riis patient. The input is a patient's wall and landmarks. The result is a folder with the placed valve, a mesh with named
// boundaries, marks without leaks, a beat, pictures and a report. A solver's case can be added.
ExitCode run_patient(const PatientOptions &options);

// riis export. Writes the opening and closing of a valve as files for svMultiPhysics. Prints the block of the solver's input that
// names the files.
void export_uris(const ExportOptions &options);
// The files of an export, after they are written. `named_folder` is the path of the folder as the solver will see it. In the
// printed block of the solver's input, the paths of the files begin with `named_folder`.
struct UrisExport {
  std::string block;
  std::string failure;  // why the drop was not found; "" if it was found, or without a mesh
};
UrisExport write_uris(const ExportOptions &options, const std::string &named_folder);

// riis size-field. The inputs are valves and their motion. The result is a grid of edge lengths that gmsh reads. The edges are
// short near the valves. The edge length at a point of the grid depends on the distance of the point from the valves. The least
// distance over all times counts.
ExitCode run_size_field(const SizeFieldOptions &options);

// The input is the user's request. The results are the files, and the report on stdout. Returns exit_none_marked if no node was
// marked, unless the user allowed this. Returns exit_warned if a check found a fault. With --strict, also returns exit_warned
// after a warning. Otherwise returns exit_fine.
ExitCode run(const Request &request);

}  // namespace riis::program
