// SPDX-License-Identifier: Apache-2.0
// Figures for the same page that another program has drawn, such as the plots of ./run bench.
// In: a JSON file: {"figures": [{"title", "columns", "panels": [{"png", "caption"}, ...], "caption", "paper"}, ...], "left_out":
// [...]}. Texts are HTML, and paths of pictures start from the file's folder. "left_out" names the missing figures and the way to
// get them. Out: the figures and these texts. Throws std::runtime_error that names the file and the fault.
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
