// SPDX-License-Identifier: Apache-2.0
// The inputs are a valve and the openings of its frames. The results are leaflets whose nodes and triangles are the same in all
// frames, and a face that enlarges the solver's box.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "common/triangles.hpp"
#include "program/base/handles.hpp"
#include "program/base/options.hpp"

namespace riis::program {

// Moving triangles, which are cut into smaller triangles. The cuts are the same at all times.

using Corners = Triangles::Corners;

inline Vector3 vertex_of(const std::vector<double> &xyz, std::int64_t vertex) {
  return {view(xyz)[3 * vertex], view(xyz)[3 * vertex + 1], view(xyz)[3 * vertex + 2]};
}
// Returns the normal of a triangle. The normal's length is twice the triangle's area.
inline Vector3 twice_area(const std::vector<double> &xyz, const Corners &corners) {
  const Vector3 a = vertex_of(xyz, corners[0]);
  return cross(vertex_of(xyz, corners[1]) - a, vertex_of(xyz, corners[2]) - a);
}

// Triangles whose corners are the given vertices and the middles of edges. The middle of an edge moves with the two ends of the
// edge.
class FinerTriangles {
 public:
  struct Triangle {
    Corners corners;
    std::int32_t leaflet;
  };

  FinerTriangles(std::int64_t n_given, std::vector<Triangle> triangles);

  const std::vector<Triangle> &triangles() const { return triangles_; }
  // Reverses the orientation of a triangle.
  void turn(std::size_t triangle) { std::swap(triangles_[triangle].corners[0], triangles_[triangle].corners[1]); }
  // Returns the length of the longest edge, as measured since the last cut.
  double longest_edge() const;

  // Appends the middles of the halved edges to the given vertices, xyz(3, n_given).
  void append_middles(std::vector<double> &xyz) const;
  // Measures all edges. `xyz` has all vertices at one of the times. The length of an edge is its largest length at any time.
  void measure(const std::vector<double> &xyz);
  // Halves every edge whose measured length exceeds `length`. Returns whether an edge was halved. Triangles with a common edge
  // also share the middle of the edge, so no gap opens between them.
  bool halve_longer(double length);

 private:
  struct Edge {
    std::int64_t a, b;  // a < b
    double length;      // the largest length measured so far
  };

  // Returns the number of the edge that begins at corner k of a triangle.
  std::int64_t edge_of(std::size_t triangle, std::size_t k) const { return triangle_edges_[triangle][k]; }
  void find_edges();

  std::int64_t n_given_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> middles_;  // the edge whose middle is vertex n_given_, n_given_ + 1, ...
  std::vector<Edge> edges_;
  std::vector<Corners> triangle_edges_;
};

// svMultiPhysics searches a mesh only in the box of the valve's nodes, widened by a tenth. The box of a flat valve is too thin.
// Such a box leaves out nodes that should be marked, and parts of the bands in which the solver measures pressures. The inputs
// are the triangles. The results are three additional triangles, which enlarge the box.

// Returns a power of two. Coordinates are rounded to multiples of this power. `largest` is the largest coordinate. The sum of
// three rounded coordinates is then exact, even in a box that is about ten times as large.
double uris_grid(double largest);

// Three triangles, one along each axis. The middle of each added triangle is also the middle of a triangle of the valve. In the
// solver, an added triangle is therefore never nearer than the triangle of the valve. Two corners of each added triangle lie
// outside the valve's box, one beyond each end.
class UrisBox {
 public:
  static constexpr std::int64_t n_nodes = 9;

  // For each axis, chooses a triangle of the valve that is near the middle of the box in the first and in the last frame. All
  // coordinates must be multiples of `grid`.
  UrisBox(std::vector<Corners> triangles, const std::vector<double> &first, const std::vector<double> &last,
          double half_thickness, double grid);

  // For each axis, appends the three corners of the added triangle to a frame.
  void append_nodes(std::vector<double> &xyz) const;

 private:
  std::vector<Corners> triangles_;
  double half_thickness_, grid_;
  std::array<std::size_t, 3> chosen_{};
};

// The openings of the frames. The solver plays the first list from the start of opening, and the second list from the start of
// closing, one frame in each time step.
struct UrisMotion {
  std::vector<double> opening, closing;
  bool starts_closed = true;
};

struct UrisLeaflet {
  std::string name;                 // usable as a file's name
  std::vector<std::int64_t> nodes;  // for each node, its vertex; ascending
  std::vector<Corners> triangles;   // corners as numbers of the leaflet's own nodes, from 0
};

// If the unit of the mesh is known, lengths are in cm, the unit of the solver.
class UrisLeaflets {
 public:
  // Computes all frames, and cuts the triangles as the options require.
  UrisLeaflets(const ExportOptions &options, const UrisMotion &motion);

  const riis_valve *valve() const { return valve_.get(); }
  // Returns the library's surface at the opening of the last call of vertices_at.
  const riis_surface *surface() const { return surface_.get(); }
  const std::vector<UrisLeaflet> &leaflets() const { return leaflets_; }
  // Returns all vertices at an opening, xyz(3, n). The coordinates are multiples of a power of two, so that the solver's sums of
  // coordinates have no rounding error.
  std::vector<double> vertices_at(double opening);
  // Returns the direction of forward flow: the mean normal of the leaflets in the first frame. The housing does not count.
  const std::array<double, 3> &forward() const { return forward_; }
  double half_thickness() const { return half_thickness_; }
  double longest_edge() const { return longest_edge_; }
  std::int64_t n_triangles() const;
  // Returns the number of triangles that were left out because they have no area in at least one frame.
  std::int64_t n_left_out() const { return n_left_out_; }

 private:
  void open_to(double opening);
  std::vector<FinerTriangles::Triangle> lasting_triangles(const UrisMotion &motion);
  void refine(const UrisMotion &motion, double largest_edge, double to_solver);
  void find_forward(double opening);
  void turn_ring(double opening);
  void part(const ExportOptions &options);
  void add_box(const UrisMotion &motion);

  std::string subject_;
  Valve valve_;
  Surface surface_;
  FinerTriangles net_;
  std::optional<UrisBox> box_;
  std::vector<UrisLeaflet> leaflets_;
  std::array<double, 3> forward_{};
  double half_thickness_ = 0, longest_edge_ = 0, grid_ = 0;
  std::int64_t housing_ = -1, n_left_out_ = 0;
  std::int32_t ring_ = ring_face;  // a UrisRing
};

}  // namespace riis::program
