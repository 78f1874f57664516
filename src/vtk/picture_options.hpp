// SPDX-License-Identifier: Apache-2.0
// In: the caller's picture options, of whatever release. Out: the options of this release, checked. A failure names the
// field and its value.
#pragma once

#include <riis/riis_vtk.h>

#include <cstdint>

namespace riis::vtk {

// Fails unless a release had a struct of this size.
void check_picture_options_size(std::int64_t size);
const riis_vtk_picture_options &default_picture_options();
// The defaults where options is NULL, and for the fields that an older caller does not have.
riis_vtk_picture_options completed_picture_options(const riis_vtk_picture_options *options);
// argument is how the caller names the value.
void check_view(std::int32_t view, const char *argument);
// All fields but the view. The mesh may be NULL.
void check_picture_options(const riis_vtk_picture_options &options, const riis_vtk_mesh *mesh);

}  // namespace riis::vtk
