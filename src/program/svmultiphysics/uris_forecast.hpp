// SPDX-License-Identifier: Apache-2.0
// The inputs are an export and the mesh of the solver's run. The result is a forecast of what svMultiPhysics will do with the
// export in this mesh. The forecast consists of lines for the solver's input and a table of frames.
#pragma once

#include <string>
#include <vector>

#include "program/base/options.hpp"
#include "program/svmultiphysics/uris_leaflets.hpp"
#include "program/svmultiphysics/uris_solver.hpp"

namespace riis::program {

struct UrisForecast {
  std::vector<std::string> lines;
  std::string table;    // CSV
  std::string failure;  // why the drop was not found; "" if it was found
};

// Refuses an export if its valve can never open or never close in this mesh. Warns of a drop that is too small.
UrisForecast forecast_of(const ExportOptions &options, const UrisMotion &motion, UrisLeaflets &leaflets);

// Finds the drop across a closed valve as svMultiPhysics computes it (docs/export.md). uris_flow.py solves the equations in a
// Python with NumPy and SciPy. The program contains the text of uris_flow.py.
// The input is the solver's delta in a mesh. The result is the ratio of the drop to (R / eps) u.
//
// The numbers of the solver's input on which the drop depends, in the solver's units.
struct SolverFluid {
  double resistance, density, viscosity, time_step;
};

struct ClosedDrop {
  bool is_separated = false;  // whether the leaflets separate the two sides in the mesh
  bool is_solved = false;     // whether the equations were solved to a part in a million
  double flow = 0;            // the flow for a drop of R / eps, which has the unit of an area
};

// Thrown if Python could not compute the flow. `reason` has the reason, such as "python3 lacks scipy".
struct NoFlow {
  std::string reason;
};

// Solves the solver's own discrete equations for a slow and steady flow near the closed valve. Velocity and pressure have shape
// functions of equal order, with the solver's stabilisation. The blood does not slip at the mesh's boundary. `near` has the exact
// distance of each node, or infinity. The region consists of the nodes up to the distance `reach`. `sides` has distances whose
// signs are correct as far as the distance `reach`, also outside the solver's box. If `quiet` is false, shows the progress of the
// solution on the terminal. Throws NoFlow.
ClosedDrop closed_drop(const SolverMesh &mesh, const SolverDistances &distances, const SolverDistances &sides,
                       const std::vector<double> &near, double reach, double half_thickness, const SolverFluid &fluid,
                       bool quiet);

}  // namespace riis::program
