// SPDX-License-Identifier: Apache-2.0
// In: the path of a file with a surface. Out: its data set, with all cells checked, for faces_of; and the arrays for the core
// from its faces.
#pragma once

#include <riis/riis.h>

#include <string>

#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

#include "riis_vtk/faces.hpp"
#include "riis_vtk/vtk_errors.hpp"

namespace riis::vtk {

// Reads a .vtp, .vtu or .stl file.
vtkSmartPointer<vtkPointSet> read_surface_data(const std::string &path, const CaughtOutput &caught);

// Fills the caller's struct, which any release of riis.h may have compiled, with the arrays of the faces.
void give_arrays(const Faces &faces, riis_surface_arrays *arrays, std::int64_t struct_size);

}  // namespace riis::vtk
