// SPDX-License-Identifier: Apache-2.0
#include "valve/bumps.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.hpp"
#include "common/array_view.hpp"

namespace riis {
namespace {

constexpr double none = -1;

// The parameters of one bump. Only bumps with BumpLift::yes have the last parameter.
constexpr std::size_t n_parameters = 7;
std::size_t n_parameters_of(BumpLift lift) { return lift == BumpLift::yes ? n_parameters : n_parameters - 1; }

std::array<ParameterSpec, n_parameters> specs_of_one(std::size_t n_leaflets) {
  constexpr double longest = 1e9;
  const double last = static_cast<double>(n_leaflets) - 1;
  return {{
      {"leaflet", "1", "the leaflet on which the bump is, or -1 for none", 1, {none}, none, last},
      {"commissure", "1", "the commissure at which the bump is, or -1 for none", 1, {none}, none, last},
      {"u", "1", "position along the leaflet's free edge, from 0 to 1, counter-clockwise seen from +z", 1, {0.5}, 0, 1},
      {"width", "1", "half the width of the bump, as a fraction of the free edge", 1, {0.4}, 0.2, 10},
      {"closed", "1", "how far the leaflet is open at the bump while the valve is closed, from 0 to 1", 1, {0}, 0, 1},
      {"open", "1", "how far the leaflet is open at the bump while the valve is open, from 0 to 1", 1, {1}, 0, 1},
      {"lift",
       "length",
       "how much higher the bump lies in the closed valve than in a healthy valve",
       1,
       {0},
       -longest,
       longest},
  }};
}

// A smooth function that is 1 at the place of the bump, and 0 at distances of 1 and more.
double hat(double distance) {
  const double inside = std::max(0.0, 1 - distance * distance);
  return inside * inside;
}

void check_place(const char *what, std::size_t bump, double place) {
  if (place != std::floor(place))
    fail(RIIS_INVALID_PARAMETER, "bump_", bump, ".", what, " is ", place, "; it must be the whole number of a ", what,
         ", or -1 for none");
}

}  // namespace

std::size_t add_bump_specs(Vector<ParameterSpec> &specs, std::size_t n_leaflets, BumpLift lift) {
  const std::size_t first = specs.size();
  for (std::size_t bump = 0; bump < n_bumps; ++bump) {
    auto own = specs_of_one(n_leaflets);
    for (std::size_t i = 0; i < n_parameters_of(lift); ++i) {
      view(own)[i].name = "bump_" + std::to_string(bump) + "." + view(own)[i].name;
      specs.push_back(view(own)[i]);
    }
  }
  return first;
}

Bumps::Bumps(const ParameterValues &values, std::size_t first, std::size_t n_leaflets, BumpLift lift)
    : n_leaflets_(n_leaflets) {
  for (std::size_t i = 0; i < n_bumps; ++i) {
    const std::size_t at = first + i * n_parameters_of(lift);
    const auto value = [&](std::size_t parameter) { return values[at + parameter][0]; };
    Bump &bump = view(bumps_)[i];
    bump = {value(0), value(1), value(2), value(3), value(4), value(5), lift == BumpLift::yes ? value(6) : 0};
    check_place("leaflet", i, bump.leaflet);
    check_place("commissure", i, bump.commissure);
    if (bump.leaflet != none && bump.commissure != none)
      fail(RIIS_INVALID_PARAMETER, "bump_", i, ".leaflet is ", bump.leaflet, " and bump_", i, ".commissure is ",
           bump.commissure, "; a bump is at one place: set the other to -1");
  }
}

bool Bumps::any() const {
  return std::any_of(bumps_.begin(), bumps_.end(),
                     [](const Bump &bump) { return bump.leaflet != none || bump.commissure != none; });
}

double Bumps::Bump::weight(std::size_t of_leaflet, std::size_t n_leaflets, double at_u) const {
  const auto is = [](double place, std::size_t number) { return place == static_cast<double>(number); };
  if (is(leaflet, of_leaflet)) return at_u == 0 || at_u == 1 ? 0 : hat((at_u - u) / width);
  if (is(commissure, of_leaflet)) return hat((1 - at_u) / width);
  if (is(commissure, (of_leaflet + n_leaflets - 1) % n_leaflets)) return hat(at_u / width);
  return 0;
}

LocalOpening Bumps::at(std::size_t leaflet, double u) const {
  LocalOpening opening;
  for (const Bump &bump : bumps_) {
    const double weight = bump.weight(leaflet, n_leaflets_, u);
    opening.closed += weight * bump.closed;
    opening.open += weight * (bump.open - 1);
    opening.lift += weight * bump.lift;
  }
  opening.open = std::clamp(opening.open, 0.0, 1.0);
  opening.closed = std::clamp(opening.closed, 0.0, opening.open);
  return opening;
}

}  // namespace riis
