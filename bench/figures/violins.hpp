// SPDX-License-Identifier: Apache-2.0
// Draws distributions side by side on a logarithmic scale.
// Input: values of several groups. Output: a picture.
#pragma once

#include <string>
#include <vector>

#include "figures/picture.hpp"

namespace riis::figures {

struct Violin {
  std::string label, group;  // neighbours in one group have the same group name
  Colour colour;
  double mark;                 // a line is drawn at this value
  std::vector<double> values;  // in ascending order, as fractions; at least one
};

// Values from 1e-6 to 1 are labelled in per cent. Smaller values are drawn at the lower end.
Png violin_plot(const std::string &title, const std::vector<Violin> &violins);

}  // namespace riis::figures
