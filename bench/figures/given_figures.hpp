// SPDX-License-Identifier: Apache-2.0
// Reads figures that another program drew for the same page, such as the plots of ./run bench.
// Input: a JSON file: {"figures": [{"title", "columns", "panels": [{"png", "caption"}, ...], "caption", "paper"}, ...],
// "left_out": [...]}. Texts are HTML. Paths of pictures are relative to the file's folder. "left_out" names the missing figures
// and the commands that make them.
// Output: the figures and these texts. Throws std::runtime_error with the file's name and the fault.
#pragma once

#include <string>
#include <vector>

#include "figures/page.hpp"

namespace riis::figures {

struct GivenFigures {
  std::vector<Figure> figures;
  std::vector<std::string> left_out;
};
GivenFigures read_figures(const std::string &path);

}  // namespace riis::figures
