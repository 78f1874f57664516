// SPDX-License-Identifier: Apache-2.0
// The names of the arrays in files, promised by riis_vtk.h.
#pragma once

namespace riis::vtk {

inline constexpr const char *marked_array = "riis_marked";
inline constexpr const char *distance_array = "riis_distance";
inline constexpr const char *leaflet_array = "riis_leaflet";
inline constexpr const char *patch_array = "riis_patch";
inline constexpr const char *triangle_array = "riis_triangle";
inline constexpr const char *uv_array = "riis_uv";

}  // namespace riis::vtk
