// SPDX-License-Identifier: Apache-2.0
// Makes random vessels and cuts their ends by planes. The known cuts are an oracle for flat ends. A function adds up tubes, and
// the wall is the surface on which this function is 0. Marching through tetrahedra makes the wall's triangles. Planes cut the
// wall, and caps close the cuts.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "program/patient/flat_ends.hpp"
#include "test_support.h"

namespace riis::tests {

using program::Corners;
using riis::Vector3;

enum class Cap { fan, rings, open };

// An end as it was cut.
struct CutEnd {
  Vector3 centre{};   // of the cap's area
  Vector3 outward{};  // of the plane
  double area = 0;
  std::int64_t n_triangles = 0;  // of the cap
};

struct CutVessels {
  Triangles triangles;  // facing outwards, the caps' triangles last; closed, except at an open end, which has no cap
  std::vector<CutEnd> ends;
  std::vector<Vector3> axes;  // points in the blood, half way from the middle to each end
  Vector3 middle{};
};

// Returns the triangles of the surface on which a function of places is 0. The function is below 0 inside the surface.
Triangles surface_of(const std::function<double(const Vector3 &)> &function, const Vector3 &lower, double side,
                     int n_cells);

// Cuts off the part beyond a plane, within a ball around a point of the plane. Closes the cut with a cap. Returns the cut end,
// which is measured even if it stays open.
CutEnd cut(Triangles &triangles, const Vector3 &point, const Vector3 &outward, double radius, Cap cap,
           random_source &random);

// Makes random vessels that meet in the middle, with radii of about 1. The vessels' ends lean by up to 40 degrees. The height of
// the wall's waves is a share of the radius.
CutVessels draw_vessels(random_source &random, int n_ends, double waves, Cap cap);

// Turns, scales and moves points.
struct Placement {
  std::array<Vector3, 3> axes{};
  double scale = 1;
  Vector3 offset{};
  Vector3 of(const Vector3 &point) const;       // a place
  Vector3 turned(const Vector3 &vector) const;  // a direction
};
Placement draw_placement(random_source &random, double scale, double far);

// The ways to orient the triangles of a file.
enum class Turned { none, all, some };
// Writes a binary .stl file with its triangles in random order. Points have single precision in the file.
void write_stl(const std::string &path, const Triangles &triangles, const Placement &placement, Turned turned,
               random_source &random);

// The number of the current trial, which failures print, and the number of failures.
inline std::string here;
inline int n_faults = 0;
void expect(bool is_right, const std::string &what);
void expect_near(double found, double expected, double tolerance, const std::string &what);

}  // namespace riis::tests
