// SPDX-License-Identifier: Apache-2.0
// Computes the numbers that svMultiPhysics would compute from exported leaflets in a mesh. The rules are those of the solver's
// sources (docs/export.md). The inputs are a mesh and the leaflets of a frame. The results are the solver's distances at nodes,
// the solver's delta at Gauss points, and the solver's bands.
#pragma once

#include <riis/riis_vtk.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/base/units.hpp"
#include "program/svmultiphysics/uris_leaflets.hpp"

namespace riis::program {

// The volume elements of svMultiPhysics, with their shape functions and the Gauss points that the solver uses.
// The input is VTK's type of a cell. The results are numbers at the points of the reference element.

// The values of all shape functions at a point, and their derivatives at this point.
struct ShapeFunctions {
  std::vector<double> values;                 // by node
  std::vector<std::array<double, 3>> slopes;  // by node, in the coordinates of the reference element
};

struct ReferencePoint {
  std::array<double, 3> at;
  double weight;
};

struct SolverElement {
  const char *name;
  std::uint8_t vtk_type;
  std::size_t n_nodes, n_corners;
  std::vector<std::array<double, 3>> node_places;  // in the coordinates of the reference element
  std::vector<ReferencePoint> gauss;
  std::vector<ShapeFunctions> at_gauss;
  // Points for integrals that are more exact than the solver's, with 4 points in each direction.
  std::vector<ReferencePoint> fine;
  std::vector<ShapeFunctions> at_fine;
};

// Returns the element for a VTK cell type, or NULL if svMultiPhysics does not have this element.
const SolverElement *solver_element_of(std::uint8_t vtk_type);
// Returns the names of all elements, for messages.
const char *solver_element_names();

// A mesh as the solver stores it. All volume elements of the mesh have one type.
struct SolverMesh {
  const SolverElement *element = nullptr;
  std::int64_t n_nodes = 0;
  std::vector<double> points;       // (3, n_nodes)
  std::vector<std::int64_t> nodes;  // (element->n_nodes, n_elements), in the solver's order
  std::vector<double> node_volume;  // (n_nodes): the integral of the node's shape function

  std::int64_t n_elements() const {
    return static_cast<std::int64_t>(nodes.size()) / static_cast<std::int64_t>(element->n_nodes);
  }
  const double *xyz() const { return points.data(); }
  Vector3 point(std::int64_t node) const { return {xyz()[3 * node], xyz()[3 * node + 1], xyz()[3 * node + 2]}; }
  const std::int64_t *nodes_of(std::int64_t e) const {
    return nodes.data() + e * static_cast<std::int64_t>(element->n_nodes);
  }
};

// Refuses a mesh that the solver would refuse. In messages, `path` is the name of the mesh. Lengths are multiplied by
// `to_solver`.
SolverMesh solver_mesh_of(const riis_vtk_mesh *file, const std::string &path, double to_solver);

// Returns the determinant of the map from the reference element at one point.
double determinant_at(const SolverMesh &mesh, std::int64_t e, const ShapeFunctions &functions);

// The distances of one frame.
struct SolverDistances {
  Box box = empty_box();  // the solver's
  std::int64_t n_in_box = 0;
  std::vector<double> to_leaflets;    // (n_nodes), signed: far nodes have the solver's large number
  std::vector<std::int64_t> nearest;  // (n_nodes): the triangle with the nearest middle, or -1 outside the box
};
// `xyz` has all vertices of the frame. For a closing valve, the sign also depends on the direction of forward flow. `margin`
// widens the solver's box on each side.
SolverDistances solver_distances(const SolverMesh &mesh, const UrisLeaflets &leaflets, const std::vector<double> &xyz,
                                 bool is_closing, double half_thickness, double margin = 0);

// Returns the solver's distance at a point of element e, interpolated between the absolute distances at the element's nodes.
// Quadratic shape functions have negative values at some points. At the border of the box, where some nodes have the solver's
// large number, an interpolated distance can therefore be negative. In the solver, a point with a negative distance is in the
// band.
double interpolated_distance(const SolverMesh &mesh, std::int64_t e, const ShapeFunctions &at,
                             const std::vector<double> &distances);
// Returns the solver's delta at a point of element e: K / R.
double solver_delta(const SolverMesh &mesh, std::int64_t e, const ShapeFunctions &at, const SolverDistances &distances,
                    double half_thickness);
// Returns (1 + cos(pi d / eps)) / (2 eps^2) for a distance d below eps, and 0 for larger distances.
double delta_of(double distance, double half_thickness);

// A band: the nodes whose signed distances lie in a range. The position of a node is measured along the direction of forward
// flow.
struct SolverBand {
  std::int64_t n_nodes = 0;
  double volume = 0, from = 0, to = 0;
};
SolverBand solver_band(const SolverMesh &mesh, const SolverDistances &distances, double from, double to,
                       const std::array<double, 3> &forward);

// The largest speeds in a frame, computed from the vertices of this frame and of the previous frame.
struct SolverSpeeds {
  double of_leaflets = 0;  // of the leaflets' vertices
  // The largest velocity that the solver gives to a node within the half thickness. The solver extrapolates the velocity in the
  // plane of the nearest triangle.
  double of_nodes = 0;
};
SolverSpeeds solver_speeds(const SolverMesh &mesh, const UrisLeaflets &leaflets, const SolverDistances &distances,
                           const std::vector<double> &xyz, const std::vector<double> &before, double time_step,
                           double half_thickness);

// Returns the leaflets' area in the solver's equations: the half thickness times the integral of delta.
double solver_area(const SolverMesh &mesh, const SolverDistances &distances, double half_thickness);
// Returns the area of the leaflets by the library's exact distances, at many points in each element. `near` has a distance for
// each node. An element is left out if all its nodes are farther from the leaflets than the half thickness plus the element's
// size. Distances may be too large by up to `error`.
double exact_area(const SolverMesh &mesh, const riis_surface *surface, const std::vector<double> &near,
                  double half_thickness, std::int32_t n_threads, bool at_solver_points, double error = 0);

// Returns the area of a closed valve in a mesh (docs/theory/measures.md, "Closed area"), in the mesh's unit squared. Returns
// nothing if the mesh has no volume elements, has several types of them, or has a type that exact_area does not know. The
// distances from the surface may be too large by up to `error`.
std::optional<double> closed_area_in(const riis_vtk_mesh *file, const riis_surface *surface, std::int32_t n_threads,
                                     double error);

// Returns the distance of each node from the surface. Distances beyond the limit become infinity.
std::vector<double> exact_distances(std::int64_t n_nodes, const double *xyz, const riis_surface *surface, double limit,
                                    std::int32_t n_threads);

}  // namespace riis::program
