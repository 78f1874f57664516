// SPDX-License-Identifier: Apache-2.0
// In: a valve and the openings of its frames. Out: leaflets whose nodes and triangles stay the same in all frames, and a face
// that widens the box in which the solver looks.
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

// Triangles that move, and their cutting into smaller ones: the same cuts at all times.

using Corners = std::array<std::int64_t, 3>;

// Triangles over given vertices and over middles of edges. A middle follows its two ends wherever they move.
class FinerTriangles {
 public:
  struct Triangle {
    Corners corners;
    std::int32_t leaflet;
  };

  FinerTriangles(std::int64_t n_given, std::vector<Triangle> triangles);

  const std::vector<Triangle> &triangles() const { return triangles_; }
  // The longest of the edges as measured since the last cut.
  double longest_edge() const;

  // Appends the middles to the given vertices, xyz(3, n_given).
  void append_middles(std::vector<double> &xyz) const;
  // Measures all edges at one time, by all vertices. A length is the largest of all times.
  void measure(const std::vector<double> &xyz);
  // Halves every edge that was measured to be longer than this, once. Returns whether there was one. Triangles that share an edge
  // share its middle, so no gap opens between them.
  bool halve_longer(double length);

 private:
  struct Ends {
    std::int64_t a, b;  // ascending
  };
  struct Edge {
    Ends ends;
    double length;  // the largest measured
  };

  // Returns the number of the edge from corner k to the next.
  std::int64_t edge_of(std::size_t triangle, std::size_t k) const { return triangle_edges_[triangle][k]; }
  void find_edges();

  std::int64_t n_given_;
  std::vector<Triangle> triangles_;
  std::vector<Ends> middles_;  // of vertices n_given_, n_given_ + 1, ...
  std::vector<Edge> edges_;
  std::vector<Corners> triangle_edges_;
};

// svMultiPhysics looks at a mesh only in the box of the valve's nodes, widened by a tenth. A flat valve's box is too thin: it
// leaves out marks, and the bands in which the solver takes its pressures. In: the triangles. Out: three more,
// which widen the box.

// Returns the power of two to whose multiples coordinates are rounded; `largest` is the largest of them. Sums of three are then
// exact, even in a box some ten times larger.
double uris_grid(double largest);

// A triangle along each axis. Its middle is exactly that of a triangle of the valve, so the solver never finds it nearer. Its
// corners reach beyond the box at both ends.
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
  // Looks at all frames, and cuts the triangles as the options say.
  UrisLeaflets(const ExportOptions &options, const UrisMotion &motion);

  const riis_valve *valve() const { return valve_.get(); }
  const std::vector<UrisLeaflet> &leaflets() const { return leaflets_; }
  // Returns all vertices at an opening, xyz(3, n): multiples of a power of two, so that the solver's sums of them are exact.
  std::vector<double> vertices_at(double opening);
  // The mean normal of the leaflets, without a housing, in the first frame: forward flow.
  const std::array<double, 3> &forward() const { return forward_; }
  double half_thickness() const { return half_thickness_; }
  double longest_edge() const { return longest_edge_; }
  std::int64_t n_triangles() const;
  // Triangles that have an area in some frames only, and are left out.
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
