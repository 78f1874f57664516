// SPDX-License-Identifier: Apache-2.0
// In: the faces of a surface from a file. Out: lines on stderr about faces that give other sides or areas than a user expects.
#pragma once

#include <riis/riis.h>

#include <string>

namespace riis::program {

// Warns of faces that are turned over against their neighbours, of equal faces, and of closed pieces such as thick leaflets.
// `name` begins the lines. The arrays are those of riis_vtk_surface_get_arrays. Corners at equal positions are one vertex.
void warn_of_faces(const std::string &name, const riis_surface_arrays &arrays);

}  // namespace riis::program
