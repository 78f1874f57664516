// SPDX-License-Identifier: Apache-2.0
// The names of the arrays in files, promised by riis_vtk.h.
#pragma once

namespace riis::vtk {

// What set_marks puts before _marked, _distance and _leaflet, if it is told nothing else.
inline constexpr const char *default_prefix = "riis";
inline constexpr const char *marked_array = "riis_marked";
inline constexpr const char *distance_array = "riis_distance";
inline constexpr const char *leaflet_array = "riis_leaflet";
inline constexpr const char *patch_array = "riis_patch";
inline constexpr const char *triangle_array = "riis_triangle";
inline constexpr const char *uv_array = "riis_uv";

}  // namespace riis::vtk
