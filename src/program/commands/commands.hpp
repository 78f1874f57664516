// SPDX-License-Identifier: Apache-2.0
// The commands of the program. run.cpp calls them. They throw a Refusal.
#pragma once

#include "program/base/options.hpp"
#include "program/base/refusal.hpp"
#include "program/cli/command_line.hpp"

namespace riis::program {

// riis states. Measures free edges, leaflet areas, the orifice and the coaptation, writes the table, and prints the summary. A
// valve is measured at openings from 0 to 1, in its own frame. A surface from a file is measured as it is, or at the times of its
// frames.
void run_states(const StatesOptions &options);

// Returns the options of a surface that is measured in the valve's own frame. Only the scale places it. Without --tolerance, the
// triangles are finer than the triangles of riis mark.
riis_surface_options own_frame(const ValveOptions &options);

// riis from-area, the inverse of riis states. In: an area, or areas in time. Out: for an area, a summary with the opening or the
// size at which the orifice has it. For areas in time, a cycle of openings.
void run_from_area(const AreaOptions &options);

// riis place. In: landmarks of a patient. Prints the sizes and the placement of the valve as a report, as a file for every
// command, and as text for OpenFOAM, C and Fortran.
void run_place(const PlaceOptions &options);

// riis patient. In: a patient's wall and landmarks. Out: a folder with the placed valve, a mesh with named boundaries, marks that
// seal, a beat, pictures, a report, and perhaps a case of a solver.
ExitCode run_patient(const PatientOptions &options);

// riis export. Writes a valve's opening and closing to a folder as files for svMultiPhysics, and prints the block of the solver's
// input that names these files.
void export_uris(const ExportOptions &options);
// The files of an export, written. The block names the files in `named_folder`, the path of the folder for the solver.
struct UrisExport {
  std::string block;
  std::string failure;  // why the drop was not found; "" if it was found, or without a mesh
};
UrisExport write_uris(const ExportOptions &options, const std::string &named_folder);

// riis size-field. In: valves and their motion. Out: a grid of edge lengths that gmsh reads, small near the valves. The lengths
// follow from the distances of the grid's points to the valves at all times.
ExitCode run_size_field(const SizeFieldOptions &options);

// In: the user's request. Out: the files, and the report on stdout. Returns exit_fine, or exit_none_marked if no node was marked
// and the user did not allow that. Returns exit_warned if a check found its fault, or after a warning with --strict.
ExitCode run(const Request &request);

}  // namespace riis::program
