// SPDX-License-Identifier: Apache-2.0
// In: a valve's opening and closing, and the solver's time step. Out: the openings of the frames that the solver plays.
#pragma once

#include <vector>

#include "program/base/options.hpp"

namespace riis::program {

// The openings of the frames. The solver plays the first list when the valve begins to open, and the second when it begins to
// close. Each time step plays one frame.
struct UrisMotion {
  std::vector<double> opening, closing;
};

// Frames are one time step apart. The last frame is at the end of the span, so the last step may be shorter.
UrisMotion uris_motion_of(const ExportOptions &options);

}  // namespace riis::program
