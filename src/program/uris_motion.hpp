// SPDX-License-Identifier: Apache-2.0
// In: the way a valve opens and closes, and the solver's time step. Out: the openings of the frames that the solver plays.
#pragma once

#include <vector>

#include "program/options.hpp"

namespace riis::program {

// The solver plays the first list when the valve turns to open, the second when it turns to close, a frame in each time step.
struct UrisMotion {
  std::vector<double> opening, closing;
};

// Frames are a time step apart. The last one is that of the span's end, so the last step may be shorter.
UrisMotion uris_motion_of(const ExportOptions &options);

}  // namespace riis::program
