// SPDX-License-Identifier: Apache-2.0
// In: the caller's picture options, of any release. Out: the options of this release, checked. A failure names the field and its
// value.
#pragma once

#include <riis/riis_vtk.h>

#include <cstdint>

namespace riis::vtk {

// Fails unless a release had a struct of this size.
void check_picture_options_size(std::int64_t size);
const riis_vtk_picture_options &default_picture_options();
// Returns the options with defaults for the fields that an older caller lacks, or all defaults if options is NULL.
riis_vtk_picture_options completed_picture_options(const riis_vtk_picture_options *options);
// argument is the caller's name for the value.
void check_view(std::int32_t view, const char *argument);
// Checks all fields but the view. The mesh may be NULL.
void check_picture_options(const riis_vtk_picture_options &options, const riis_vtk_mesh *mesh);

}  // namespace riis::vtk
