// SPDX-License-Identifier: Apache-2.0
// Random vessels whose ends are cut by planes, as an oracle for flat ends: what was cut is known. The wall is where a function
// that adds up tubes is 0. It is made of triangles by marching through tetrahedra, cut by planes, and closed there.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "program/patient/wall_surface.hpp"
#include "test_support.h"

namespace riis::tests {

using program::Corners;
using program::Triangles;
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
  Triangles triangles;  // closed, outwards, the caps last. An open end has no cap
  std::vector<CutEnd> ends;
  std::vector<Vector3> axes;  // points in the blood, half way from the middle to each end
  Vector3 middle{};
};

// Returns the triangles of the surface on which a function of places is 0. It is below 0 inside.
Triangles surface_of(const std::function<double(const Vector3 &)> &function, const Vector3 &lower, double side,
                     int n_cells);

// Cuts off what lies beyond a plane within a ball around a point of the plane. Closes the cut with a cap. Returns the end, which
// is measured even if it stays open.
CutEnd cut(Triangles &triangles, const Vector3 &point, const Vector3 &outward, double radius, Cap cap,
           random_source &random);

// Draws vessels that meet in the middle, with radii of about 1 and ends that lean by up to 40 degrees. The height of the waves of
// the wall is a share of the radius.
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

// How the triangles of a file are turned.
enum class Turned { none, all, some };
// Writes a binary .stl file with its triangles in random order. Points have single precision there.
void write_stl(const std::string &path, const Triangles &triangles, const Placement &placement, Turned turned,
               random_source &random);

// The trial that runs, which expectations print, and the number of those that failed.
inline std::string here;
inline int n_faults = 0;
void expect(bool is_right, const std::string &what);
void expect_near(double found, double expected, double tolerance, const std::string &what);

}  // namespace riis::tests
