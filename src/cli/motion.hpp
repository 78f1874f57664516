// SPDX-License-Identifier: Apache-2.0
// --time: the surface of a motion by frames, at one time.
#pragma once

#include <string>

#include "cli/command_line.hpp"
#include "cli/handles.hpp"

namespace riis::cli {

// A --surface that ends in .pvd is a motion.
bool is_motion_file(const std::string &surface);

// Reads --time and --period. Fails if a motion lacks its time, and for either without a motion.
void parse_motion(const std::string &time, const std::string &period, Options &options);

// Reads the motion and makes its surface at options.time, with velocities.
struct MovedSurface {
  Surface surface;
  double seconds;  // for reading
};
MovedSurface surface_of_motion(const Options &options);

}  // namespace riis::cli
