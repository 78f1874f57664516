// SPDX-License-Identifier: Apache-2.0
// riis export: writes a valve's opening and closing as files for svMultiPhysics, and prints the block of the solver's input that
// names these files.
#pragma once

#include <vector>

#include "program/base/options.hpp"

namespace riis::program {

// Writes the folder, and prints the block on stdout.
void export_uris(const ExportOptions &options);

// The openings of the frames. The solver plays the first list when the valve begins to open, and the second when it begins to
// close. Each time step plays one frame.
struct UrisMotion {
  std::vector<double> opening, closing;
  bool starts_closed = true;
};

// Frames are one time step apart. The last frame is at the end of the span, so the last step may be shorter.
UrisMotion uris_motion_of(const ExportOptions &options);

}  // namespace riis::program
