// SPDX-License-Identifier: Apache-2.0
// The names of the arrays in files. riis_vtk.h promises them.
#pragma once

#include <string>

#include <vtkFieldData.h>

namespace riis::vtk {

// The default of the prefix that set_marks puts before _marked, _distance and _leaflet.
inline constexpr const char *default_prefix = "riis";
inline constexpr const char *marked_array = "riis_marked";
inline constexpr const char *distance_array = "riis_distance";
inline constexpr const char *leaflet_array = "riis_leaflet";
inline constexpr const char *patch_array = "riis_patch";
inline constexpr const char *triangle_array = "riis_triangle";
inline constexpr const char *uv_array = "riis_uv";
inline constexpr const char *velocity_array = "riis_velocity";
inline constexpr const char *node_id_array = "riis_node_id";
inline constexpr const char *cell_id_array = "riis_cell_id";
// The field array in which VTK's filters put times.
inline constexpr const char *time_array = "TimeValue";

// Returns "; there are: a, b", for messages about an array that is missing.
inline std::string list_of_arrays(vtkFieldData *data) {
  std::string list;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    const char *name = data->GetAbstractArray(i)->GetName();
    list += (list.empty() ? "; there are: " : ", ") + std::string(name ? name : "one without a name");
  }
  return list.empty() ? "; there is none" : list;
}

}  // namespace riis::vtk
