// SPDX-License-Identifier: Apache-2.0
// Distributions side by side on a logarithmic scale.
// In: values of several groups. Out: a picture.
#pragma once

#include <string>
#include <vector>

#include "figures/picture.hpp"

namespace riis::figures {

struct Violin {
  std::string label, group;  // neighbours of one group share its name
  Colour colour;
  double mark;                 // a line is drawn at this value
  std::vector<double> values;  // ascending, shares, at least one
};

// Values from 1e-6 to 1 are drawn as per cent. Smaller values are drawn at the lower end.
Png violin_plot(const std::string &title, const std::vector<Violin> &violins);

}  // namespace riis::figures
