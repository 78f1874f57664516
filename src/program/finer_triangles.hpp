// SPDX-License-Identifier: Apache-2.0
// Triangles that move, and their cutting into smaller ones: the same cuts at all times.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace riis::program {

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

}  // namespace riis::program
