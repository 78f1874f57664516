// SPDX-License-Identifier: Apache-2.0
// What the two ways to frames share: files (frames.cpp) and displacements (displacements.cpp).
#pragma once

#include <string>
#include <vector>

#include "riis_vtk/frames.hpp"

namespace riis::vtk {

// Fails for a coordinate that riis.h does not take. `after` stands behind the point in the message.
void check_places(const std::string &path, const std::vector<double> &xyz, const std::string &after);

// Appends a frame. The times are those of all frames.
void add_frame(Frames &frames, const std::vector<double> &xyz);

}  // namespace riis::vtk
