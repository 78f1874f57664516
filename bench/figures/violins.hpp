// SPDX-License-Identifier: Apache-2.0
// Distributions side by side on a logarithmic scale.
// In: values of several groups. Out: a picture.
#pragma once

#include <string>
#include <vector>

#include "figures/picture.hpp"

namespace riis::figures {

struct Violin {
  std::string label, group;  // neighbours of the same group have its name once
  Colour colour;
  double mark;                 // a value that a line is drawn at
  std::vector<double> values;  // ascending, shares, at least one
};

// Values are drawn from 1e-6 to 1, as per cent; what is less is drawn at the lower end.
Png violin_plot(const std::string &title, const std::vector<Violin> &violins);

}  // namespace riis::figures
