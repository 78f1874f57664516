// SPDX-License-Identifier: Apache-2.0
// The flat parts of a wall, at which vessels may have been cut. A flat part consists of connected triangles in one plane. The
// angle of the wall beside the part is also measured. The command riis patient chooses ends among the parts, and pictures leave
// the parts out.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/triangles.hpp"

namespace riis::flat_parts {

// A flat part with less than `least_share` of the whole area is noise.
inline constexpr double least_share = 3e-4;
// The angle between a flat part and the wall beside it, in degrees. A tube that is cut has a mean angle of 90, even if the cut is
// oblique. A part whose angle is between the limits for clear and unclear parts may be a cut, or a flat place of the wall.
inline constexpr double clear_mean = 55, clear_least = 20, unclear_mean = 30;
// The roundness of a part is four pi times its area, divided by the square of its perimeter. It is 1 for a disc, and 0.6 for an
// ellipse that is three times as long as wide.
inline constexpr double least_roundness = 0.25;
// A flat part with less than `small_share` of the largest end's area may be a facet of a coarse wall, or the end of a coronary
// artery.
inline constexpr double small_share = 0.05;

// A plane through a point.
struct Plane {
  Vector3 normal{}, point{};
  double distance_of(const Vector3 &of) const { return dot(of - point, normal); }
};

// A flat part of the surface.
struct Part {
  std::vector<std::int64_t> triangles;
  Plane plane;  // through the part's centre
  double area = 0;
  double mean_angle = 0, least_angle = 0;  // to the wall beside it, in degrees
  double wide_angle = 0;                   // the mean over the wider band
  double roundness = 0;
  std::int64_t n_rims = 0, n_sides = 0;  // lines of the rim, and their edges
  bool is_behind = false;                // the wall beside it lies on the side of the blood
  bool is_touching = false;              // another flat part begins at its rim
  bool is_large = false;                 // large enough not to be noise
  bool is_facet = false;  // it is small beside the largest end, and hardly larger than the wall's triangles
  bool was_open = false;

  bool is_disc() const { return n_rims == 1 && is_behind && roundness >= least_roundness; }
  bool is_sharp() const { return mean_angle >= clear_mean && least_angle >= clear_least && is_behind; }
  bool is_clear() const { return is_large && is_disc() && is_sharp() && !is_touching && !is_facet; }
  double radius() const { return std::sqrt(area / pi); }
};

// Finds flat parts. The triangles must not change while this object is used, and neighbouring triangles must face to the same
// side. The surface may be open.
class Finder {
 public:
  // `faces_outwards` is true if the triangles face outwards. If `faces_outwards` is false, the class assumes that the wall beside
  // a part lies behind the part.
  Finder(const Triangles &triangles, bool faces_outwards);

  // Returns the flat parts that may be ends, the largest first. The result includes `parts`, which are already known.
  std::vector<Part> find(std::vector<Part> parts);
  // Returns the flat part that consists of these triangles, which closed a hole.
  Part closed_hole(std::vector<std::int64_t> triangles);
  // Returns the flat part at a triangle to which the user points.
  Part pointed_at(std::int64_t triangle);

  double size() const { return size_; }
  double whole_area() const { return total_; }

 private:
  bool is_large(const Part &part) const;
  // Returns the connected triangles in the plane around the seed, which is a triangle. The plane is fitted to these triangles
  // again in every round.
  Part grown(std::int64_t seed, double tolerance);
  // Measures the rim and the angle to the wall beside it.
  void measure(Part &part);
  // Adds a part, unless most of its triangles belong to a larger part. Removes smaller parts whose triangles are mostly in the
  // new part.
  void add(Part part, std::vector<Part> &parts);

  void fit(Part &part) const;
  bool is_in(const Plane &plane, std::int64_t triangle, double tolerance) const;
  bool is_thin(std::int64_t triangle) const;
  template <class Visit>
  void collect(std::int64_t seed, Part &part, double tolerance, const Visit &visit);
  void fill_gaps(Part &part, double tolerance);
  int stamped(const Part &part);
  void mark_touching(std::vector<Part> &parts) const;

  const Triangles &all_;
  bool faces_outwards_;
  std::vector<Triangles::Corners> neighbours_;
  double size_ = 0, total_ = 0;
  std::vector<double> areas_;
  std::vector<Vector3> normals_, centres_;
  std::vector<int> stamp_;  // for each triangle, the number of the last walk that marked it
  int last_stamp_ = 0;
};

}  // namespace riis::flat_parts
