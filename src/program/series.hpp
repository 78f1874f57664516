// SPDX-License-Identifier: Apache-2.0
// A series in time. The mesh is read once. A first pass over the times finds the nodes near the region that the valves sweep. A
// second pass marks and writes.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "program/case.hpp"
#include "program/handles.hpp"
#include "program/moving_valve.hpp"
#include "program/refusal.hpp"
#include "program/report.hpp"
#include "program/series_files.hpp"
#include "program/warnings.hpp"

namespace riis::program {

// Returns exit_fine, or exit_none_marked if no node was marked at any time and the user did not allow that. Throws a Refusal.
ExitCode run_series(Case &all);

// In: valves that move through a mesh. Out: the nodes that are near a valve at some time, and the box that contains all motion.

struct Sweep {
  std::vector<std::int64_t> node_ids;  // the nodes within the distance limit at some time, ascending
  Box box;                             // the box around all surfaces at all times
  // For each valve, the values at the time when it marked most nodes.
  std::vector<std::int64_t> most_marked;
  std::vector<riis_surface_info> surface;
};

// `note` is called with the step and the valve after each marking. It may be empty.
Sweep sweep_of(std::vector<MovingValve> &valves, const std::vector<double> &times, const riis_mesh *mesh,
               std::int64_t n_nodes, bool quiet, const std::function<void(std::size_t, std::size_t)> &note = nullptr);

// Parts of a series. A series of a mesh in pieces shares them.

// Returns the names of the arrays of a series. If only a part of the mesh is written, the part also has an array of its nodes'
// ids in the whole mesh.
std::vector<std::string> names_of_series(const Case &all);
// Returns the cells around the nodes.
MeshFile part_of(const riis_vtk_mesh *file, const std::vector<std::int64_t> &node_ids);
// Returns the time before a step. For the first step, it is the first time minus the length of the next step.
double time_before(const Case &all, std::size_t step);
// Moves each valve to the time when it is least open. If there are several, moves it to the first.
void move_to_least_openings(const Case &all, std::vector<MovingValve> &valves);
// Moves each valve to the time when it is most open, and measures its orifice there, if the options have two points.
void measure_largest_orifices(const Case &all, std::vector<MovingValve> &valves, Report &report);
// Moves the valves to a step, marks the nodes, and sets the arrays in the part.
void set_series_arrays(const Case &all, std::vector<MovingValve> &valves, const riis_mesh *nodes, riis_vtk_mesh *part,
                       std::size_t step);
// Prints the summary at the end of a series. `foam_case` is the case of OpenFOAM that got fields, or "". `n_written` is the
// number of nodes in each file, or nothing if it is not printed.
void print_summary(const Case &all, const SeriesTable &table, const std::vector<const SeriesFiles *> &lists,
                   const std::string &foam_case, std::int64_t n_nodes, std::optional<std::int64_t> n_written,
                   Report &report);

}  // namespace riis::program
