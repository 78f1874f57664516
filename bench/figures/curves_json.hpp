// SPDX-License-Identifier: Apache-2.0
// Parameters and curves of the valves at the default parameters, for parameters/draw.py, which draws what each parameter measures.
// Out: a JSON file with an object for each kind. It has "parameters", and the curves: "cusps" and "openings" of the aortic valve,
// "states" of the others. A Bézier curve is the list of its control points, a curve the list of its pieces. The bileaflet valve's
// "example" has the parameters that are not the default ones.
#pragma once

#include <string>

namespace riis::figures {

// Throws std::runtime_error that names the path if the file cannot be written.
void write_curves(const std::string &path);

}  // namespace riis::figures
