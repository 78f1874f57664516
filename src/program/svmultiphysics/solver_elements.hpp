// SPDX-License-Identifier: Apache-2.0
// The volume elements of svMultiPhysics: their shape functions, and the solver's own Gauss points.
// In: VTK's type of a cell. Out: numbers at the points of the reference element.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace riis::program {

// Values of all shape functions at one point, and their derivatives there.
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
  // The solver evaluates the gradients of some elements at its first Gauss point only.
  bool has_one_gradient;
  std::vector<ReferencePoint> gauss;
  std::vector<ShapeFunctions> at_gauss;
  // Points for integrals that are more exact than the solver's, 4 in each direction.
  std::vector<ReferencePoint> fine;
  std::vector<ShapeFunctions> at_fine;
};

// Returns the element for a VTK cell type, or NULL if svMultiPhysics lacks it.
const SolverElement *solver_element_of(std::uint8_t vtk_type);
// Returns the names of all elements, for messages.
const char *solver_element_names();

}  // namespace riis::program
