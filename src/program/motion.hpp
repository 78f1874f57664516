// SPDX-License-Identifier: Apache-2.0
// --surface FILE.pvd: the surface of a motion by frames.
#pragma once

#include <string>
#include <vector>

#include "program/command_line.hpp"
#include "program/handles.hpp"
#include "program/report.hpp"

namespace riis::program {

// Tells whether --surface is a motion, which ends in .pvd.
bool is_motion_file(const std::string &surface);

// Reads --time and --period. Fails if a motion lacks its time, and for either without a motion.
void parse_motion(const std::string &time, const std::string &period, Options &options);

// --surface FILE.pvd, and the files that hold its frames.
struct KeyframeFiles {
  Keyframes keyframes;
  std::vector<std::string> files;
};
KeyframeFiles read_keyframes(const Options &options, Seconds &seconds);

// Makes the surface at options.time, with velocities.
Surface surface_of_keyframes(const Options &options, const riis_keyframes *keyframes);

}  // namespace riis::program
