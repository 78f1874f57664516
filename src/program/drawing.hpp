// SPDX-License-Identifier: Apache-2.0
// Pictures of a run: what stands over them, and drawing them.
#pragma once

#include <riis/riis_vtk.h>

#include <string>
#include <vector>

#include "program/command_line.hpp"
#include "program/report.hpp"

namespace riis::program {

// Returns the names of a valve's leaflets, or none for files, whose leaflets have numbers.
std::vector<const char *> leaflet_names(const Options &options);

// Returns a title such as "Mitral valve", or a file's name without folders.
std::string title_of_valve(const Options &options);

// A file has its name without folders as title. A kind of valve has its name with a capital, like the other captions.
std::string picture_title(const Options &options, const riis_valve *valve, const Report &report);

// Draws options.pictures. mesh and result may be NULL; leaks are shown with a result.
void draw_pictures(const Options &options, const std::string &title, const std::vector<const char *> &names,
                   const riis_surface *surface, const riis_vtk_mesh *mesh, const riis_marks *result, Report &report);

}  // namespace riis::program
