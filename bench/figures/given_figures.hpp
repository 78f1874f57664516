// SPDX-License-Identifier: Apache-2.0
// Figures that another program has drawn, ./run bench its plots, for the same page.
// In: a JSON file: {"figures": [{"title", "columns", "panels": [{"png", "caption"}, ...], "caption", "paper"}, ...], "left_out": [...]},
// texts in HTML, pictures named from the file's folder; "left_out" says which figures are not there and how to get them.
// Out: the figures and these texts. Throws std::runtime_error that names the file and what is wrong.
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
