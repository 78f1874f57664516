// SPDX-License-Identifier: Apache-2.0
// In: a marked mesh. Out: the number of its edges that cross the surface between unmarked nodes, and a half thickness that
// closes these leaks.
#pragma once

#include <riis/riis_vtk.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "program/case.hpp"
#include "program/moving_valve.hpp"
#include "program/options.hpp"
#include "program/report.hpp"

namespace riis::program {

struct MarkedMesh {
  const riis_surface *surface;
  const riis_valve *valve;  // the valve of the surface; null for a surface from a file
  const riis_vtk_mesh *file;
  riis_mesh *mesh;  // the check for leaks removes its adjacency
  riis_marks *result;
  std::string surface_name = "the surface";  // the surface's name in the warning
};

// Finds the leaks among the edges that may leak. `longer_than` is passed to riis_vtk_mesh_create_long_edges.
Leaks leaks_of(const MarkedMesh &marked, const riis_mark_options &options, double longer_than,
               int64_t *n_cells_left_out);
// Returns that length for a marking. Short edges may also leak if marks may be missing, or if distances are not measured to the
// triangles.
double longest_closed_edge(const MarkOptions &options, double half_thickness, bool is_complete);

// Returns the half thickness that the surface still needs if it has the given one, or nothing if it is closed.
using Left = std::function<std::optional<double>(double half_thickness)>;
// Warns of the leaks in report.leaks, and sets the half thickness that closes them.
void judge_leaks(const MarkOptions &options, const riis_valve *valve, const std::string &surface_name, const Left &left,
                 Report &report);

double distance_between(const double *p, const double *q);

// Rounds up to three digits, so that the number also closes the leaks when the user types it as printed.
double rounded_up(double x);

// Writes report.leaks and report.seconds.leaks. Warns on stderr if the surface leaks or if leaks are unknown. If two points are
// checked, check_passage warns instead.
void look_for_leaks(const MarkOptions &options, const MarkedMesh &marked, Report &report);

// Writes report.flow, except for the first passage, if the options request measures or stats. Removes the mesh's adjacency.
void measure_flow(const MarkOptions &options, const MarkedMesh &marked, Report &report);

// In: a marked mesh and two points. Out: whether unmarked nodes join the points, the position of the passage, and a half
// thickness that closes it.

// The node that is nearest to an end, among the nodes that have a neighbour.
struct NearestNode {
  double distance, longest_edge;
  std::string name;
};
// Refuses an end that is outside the mesh or has no node near it. `name` is FROM or TO. `why_none` is the reason to give if no
// node has a neighbour.
void check_end(const MarkOptions &options, const char *name, const double *point,
               const std::optional<NearestNode> &nearest, const double *lower, const double *upper,
               const std::string &why_none);
// Completes the report of a passage, warns on stderr, and puts the report into report.leaks. `longest_edge` is that of the
// passage's node.
void judge_passage(const MarkOptions &options, const riis_valve *valve, const std::string &surface_name,
                   PassageReport passage, double longest_edge, const Left &left, Report &report);
// Makes the surface of a valve with another half thickness.
Surface with_half_thickness(const MarkOptions &options, const riis_valve *valve, double half_thickness);
// Writes the measures of report.flow that do not depend on the mesh.
void measure_surface(const MarkOptions &options, const riis_surface *surface, Report &report);

// Returns the check for the two points of --between.
LeakCheck leak_check_between(const std::vector<std::string> &points);

// Both functions write report.leaks.passage, and warn on stderr if the points are joined. They do nothing if the options have no
// points. They remove the mesh's adjacency.
void check_passage(const MarkOptions &options, const MarkedMesh &marked, Report &report);
// Returns the surface of all valves at their present positions, or null for one valve or if the options have no points. Refuses
// valves of different half thicknesses.
Surface joined_for_passage(const Case &all, const std::vector<MovingValve> &valves);
// Checks all valves together at their present positions. They must have the same half thickness.
void check_passage_of(const Case &all, const std::vector<MovingValve> &valves, riis_mesh *mesh,
                      const riis_vtk_mesh *file, Report &report);

// Both functions write into report.valve_flows if the options have two points.
// Measures the mesh edges across the band of each valve, in its last marking, if all edges are known. Removes the adjacency.
void measure_bands(const Case &all, const std::vector<MovingValve> &valves, riis_mesh *mesh, const riis_vtk_mesh *file,
                   Report &report);
// Measures the orifices of the valves at their present positions.
void measure_orifices(const Case &all, const std::vector<MovingValve> &valves, Report &report);

}  // namespace riis::program
