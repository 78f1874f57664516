// SPDX-License-Identifier: Apache-2.0
// Parameters and curves of both valves at the default parameters, for parameters/draw.py, which draws what each parameter measures.
// Out: a JSON file: {"aortic": {"parameters": [...], "cusps": [...], "openings": [...]}, "mitral": {"parameters": [...],
// "states": [...]}}. A Bézier curve is the list of its control points, a curve the list of its pieces.
#pragma once

#include <string>

namespace riis::figures {

// Throws std::runtime_error that names the path if the file cannot be written.
void write_curves(const std::string &path);

}  // namespace riis::figures
