// SPDX-License-Identifier: Apache-2.0
// Figures that another program has drawn, ./run bench its plots, for the same page.
// In: a JSON file: {"figures": [{"title", "columns", "panels": [{"png", "caption"}, ...], "caption", "paper"}, ...]}, texts in HTML,
// pictures named from the file's folder. Out: the figures. Throws std::runtime_error that names the file and what is wrong.
#pragma once

#include <string>
#include <vector>

#include "figures/page.hpp"

namespace riis::figures {

std::vector<Figure> read_figures(const std::string &path);

}  // namespace riis::figures
