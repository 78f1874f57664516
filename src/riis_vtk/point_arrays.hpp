// SPDX-License-Identifier: Apache-2.0
// In: the result of a marking, or the caller's numbers. Out: point arrays of a grid, by the names that riis_vtk.h promises.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <string>

class vtkUnstructuredGrid;

namespace riis::vtk {

// prefix_marked, prefix_distance, prefix_leaflet.
void set_marks(vtkUnstructuredGrid *grid, const riis_marks *result, double far_distance, const std::string &prefix);

// An array for each of the fields, such as prefix_normal.
void set_fields(vtkUnstructuredGrid *grid, const riis_marks *result, std::int32_t fields, const std::string &prefix);

// values is (n_components, n_nodes).
void set_point_array(vtkUnstructuredGrid *grid, const std::string &name, std::int64_t n_nodes,
                     std::int64_t n_components, const double *values);

}  // namespace riis::vtk
