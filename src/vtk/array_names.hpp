// SPDX-License-Identifier: Apache-2.0
// The names of the arrays in files. riis_vtk.h promises them.
#pragma once

namespace riis::vtk {

// The default of the prefix that set_marks puts before _marked, _distance and _leaflet.
inline constexpr const char *default_prefix = "riis";
inline constexpr const char *marked_array = "riis_marked";
inline constexpr const char *distance_array = "riis_distance";
inline constexpr const char *leaflet_array = "riis_leaflet";
inline constexpr const char *patch_array = "riis_patch";
inline constexpr const char *triangle_array = "riis_triangle";
inline constexpr const char *uv_array = "riis_uv";

}  // namespace riis::vtk
