// SPDX-License-Identifier: Apache-2.0
// In: a surface from a file. Out: lines on stderr about triangles that give other sides or areas than a user expects.
#pragma once

#include <riis/riis.h>

#include <string>

namespace riis::program {

// Warns of triangles that are turned over against their neighbours, of equal triangles, and of closed pieces such as thick
// leaflets. `name` begins the lines. Corners at equal positions are one vertex.
void warn_of_faces(const std::string &name, const riis_surface *surface);

}  // namespace riis::program
