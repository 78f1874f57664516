// SPDX-License-Identifier: Apache-2.0
// The band around a surface, with all rules for a band with an offset (docs/theory/marks.md, "Offset"). Two numbers follow from a
// node's distance and height: the half thickness that marks the node, and the node's distance from the middle of the band.
#pragma once

#include <cmath>
#include <limits>

namespace riis {

// The middle of the band lies offset * half_thickness beside the surface, along the normals. A node has a distance d >= 0 from
// the surface, and a height h. Off the rim, the height is the signed distance: d with the sign of the node's side. At a rim with
// the closest point p and the unit normal n, the height of the node x is n.(x - p). Without an offset no rule needs the height.
struct Band {
  double half_thickness = 0;
  double offset = 0;  // above -1 and below 1

  bool steps_aside() const { return offset != 0; }
  // Returns the same band with another half thickness.
  Band with(double other_half_thickness) const { return {other_half_thickness, offset}; }

  // Returns the largest distance that a node of the band can have. A node beyond this distance is never marked, in spite of
  // rounding.
  double reach() const { return reach_of(half_thickness); }
  // Returns a distance up to which all nodes are in the band.
  double sure_distance() const { return (1 - std::abs(offset)) * half_thickness; }

  // Returns the smallest half thickness at which a node is marked. Off the rim, this half thickness is h / (1 + offset) for h >=
  // 0, and -h / (1 - offset) for h < 0. At a rim, it is the root e of (1 - offset^2) e^2 + 2 offset h e - d^2 = 0, even if h is d
  // or -d.
  double marking_thickness(double distance, double height) const {
    if (!steps_aside() || !(distance > 0)) return distance;
    const double cosine = height / distance, along = offset * cosine;
    const double root = std::sqrt(1 - offset * offset * ((1 - cosine) * (1 + cosine)));
    // Neither of the two formulas below subtracts numbers of the same sign, so no digits are lost. For a node off the rim, `root`
    // is 1.
    const double made =
        root == 1 || along >= 0 ? distance / (along + root) : distance * (root - along) / ((1 - offset) * (1 + offset));
    double least = distance / reach_of(1);
    if (reach_of(least) < distance) least = std::nextafter(least, std::numeric_limits<double>::infinity());
    return made < least ? least : made;
  }
  bool holds(double distance, double height) const {
    // The sign of the left side of marking_thickness's equation, at the half thickness, decides without a square root. Near the
    // edge of the band, rounding could change this sign, so marking_thickness itself is computed there.
    constexpr double near_edge = 1e-6;
    const double e = half_thickness,
                 over = ((1 - offset) * (1 + offset) * e + 2 * offset * height) * e - distance * distance;
    if (std::abs(over) > near_edge * e * e) return over > 0;
    return marking_thickness(distance, height) <= half_thickness;
  }

  // Returns the signed distance of a node from the middle of the band, for a node off the rim.
  double height_over_middle(double height) const { return height - offset * half_thickness; }
  // Returns the distance of a node from the middle of the band. At a rim, this is the distance from p + offset half_thickness n.
  double distance_from_middle(double distance, double height) const {
    if (!steps_aside()) return distance;
    const double over = height_over_middle(height), beside_sq = (distance - height) * (distance + height);
    return beside_sq > 0 ? std::sqrt(over * over + beside_sq) : std::abs(over);
  }
  // Returns the rate of change of distance_from_middle. The inputs include the rates of the distance and of the height.
  // `from_middle` is above 0.
  double middle_rate(double distance, double from_middle, double distance_rate, double height_rate) const {
    return (distance * distance_rate - offset * half_thickness * height_rate) / from_middle;
  }

 private:
  double reach_of(double thickness) const { return (1 + std::abs(offset)) * thickness; }
};

}  // namespace riis
