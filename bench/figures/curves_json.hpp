// SPDX-License-Identifier: Apache-2.0
// Writes parameters and curves of the valves for parameters/draw.py, which draws the meaning of each parameter.
// Output: a JSON file with an object for each kind of valve. It has "parameters" and curves at the default parameters: "cusps"
// and "openings" of the aortic valve, "states" of the other valves. The bileaflet valve's "example" has the parameters that
// differ from the defaults. A Bézier curve is the list of its control points, a curve the list of its pieces.
#pragma once

#include <string>

namespace riis::figures {

// Throws std::runtime_error with the path if the file cannot be written.
void write_curves(const std::string &path);

}  // namespace riis::figures
