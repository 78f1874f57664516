// SPDX-License-Identifier: Apache-2.0
// In: a valve and the openings of its frames. Out: leaflets with the same nodes and triangles in all frames, and a face that
// widens the solver's box.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "program/handles.hpp"
#include "program/options.hpp"
#include "program/uris_motion.hpp"

namespace riis::program {

// Moving triangles, which are cut into smaller ones. The cuts are the same at all times.

using Corners = std::array<std::int64_t, 3>;

// Triangles with given vertices and middles of edges as corners. A middle moves with the two ends of its edge.
class FinerTriangles {
 public:
  struct Triangle {
    Corners corners;
    std::int32_t leaflet;
  };

  FinerTriangles(std::int64_t n_given, std::vector<Triangle> triangles);

  const std::vector<Triangle> &triangles() const { return triangles_; }
  // Returns the length of the longest edge measured since the last cut.
  double longest_edge() const;

  // Appends the middles of edges to the given vertices, xyz(3, n_given).
  void append_middles(std::vector<double> &xyz) const;
  // Measures all edges, with all vertices at one time. The length of an edge is the largest of all times.
  void measure(const std::vector<double> &xyz);
  // Halves each edge once whose measured length is larger than the limit. Returns true if it halved any. Triangles that share
  // an edge share its middle, so no gap opens between them.
  bool halve_longer(double length);

 private:
  struct Ends {
    std::int64_t a, b;  // ascending
  };
  struct Edge {
    Ends ends;
    double length;  // the largest measured so far
  };

  // Returns the number of the edge from corner k to the next.
  std::int64_t edge_of(std::size_t triangle, std::size_t k) const { return triangle_edges_[triangle][k]; }
  void find_edges();

  std::int64_t n_given_;
  std::vector<Triangle> triangles_;
  std::vector<Ends> middles_;  // the edges of vertices n_given_, n_given_ + 1, ...
  std::vector<Edge> edges_;
  std::vector<Corners> triangle_edges_;
};

// svMultiPhysics looks at a mesh only in the box of the valve's nodes, widened by a tenth. A flat valve's box is too thin. It
// excludes nodes to mark, and the bands in which the solver measures pressures. In: the triangles. Out: three more, which widen
// the box.

// Returns a power of two. Coordinates are rounded to its multiples, and `largest` is the largest coordinate. Then sums of three
// coordinates are exact, even in a box about ten times larger.
double uris_grid(double largest);

// A triangle along each axis. A triangle of the valve has exactly the same middle, so the solver never finds the box's triangle
// nearer. Its corners reach beyond the box at both ends.
class UrisBox {
 public:
  static constexpr std::int64_t n_nodes = 9;

  // Chooses triangles of the valve that lie half way between the sides, in the first and the last frame. Coordinates are
  // multiples of grid.
  UrisBox(std::vector<Corners> triangles, const std::vector<double> &first, const std::vector<double> &last,
          double half_thickness, double grid);

  // Appends the three corners of each axis' triangle to a frame.
  void append_nodes(std::vector<double> &xyz) const;

 private:
  std::vector<Corners> triangles_;
  double half_thickness_, grid_;
  std::array<std::size_t, 3> chosen_{};
};

struct UrisLeaflet {
  std::string name;                 // fit for a file's name
  std::vector<std::int64_t> nodes;  // ascending: a node's vertex
  std::vector<Corners> triangles;   // by the leaflet's own nodes, from 0
  bool is_scaffold;                 // at rest, and on no side of the flow: a housing
};

class UrisLeaflets {
 public:
  // Uses all frames, and cuts the triangles as the options require.
  UrisLeaflets(const ExportOptions &options, const UrisMotion &motion);

  const riis_valve *valve() const { return valve_.get(); }
  const std::vector<UrisLeaflet> &leaflets() const { return leaflets_; }
  // Returns all vertices at an opening, xyz(3, n): multiples of a power of two, so that the solver's sums of them are exact.
  std::vector<double> vertices_at(double opening);
  // Returns the direction of forward flow: the mean normal of the leaflets in the first frame, without a housing.
  const std::array<double, 3> &forward() const { return forward_; }
  double half_thickness() const { return half_thickness_; }
  double longest_edge() const { return longest_edge_; }
  std::int64_t n_triangles() const;
  // Returns the number of triangles that are left out, because they have no area in some frame.
  std::int64_t n_left_out() const { return n_left_out_; }

 private:
  void open_to(double opening);
  std::vector<FinerTriangles::Triangle> lasting_triangles(const UrisMotion &motion);
  void refine(const UrisMotion &motion, double largest_edge);
  void find_forward(double opening);
  void part(const ExportOptions &options);
  void add_boxes(const UrisMotion &motion);

  std::string subject_;
  Valve valve_;
  Surface surface_;
  FinerTriangles net_;
  std::vector<UrisBox> boxes_;
  std::vector<UrisLeaflet> leaflets_;
  std::array<double, 3> forward_{};
  double half_thickness_ = 0, longest_edge_ = 0, grid_ = 0;
  std::int64_t housing_ = -1, n_left_out_ = 0;
};

}  // namespace riis::program
