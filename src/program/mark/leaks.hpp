// SPDX-License-Identifier: Apache-2.0
// In: a marked mesh. Out: the number of its edges that cross the surface between unmarked nodes, and a half thickness that
// closes these leaks.
#pragma once

#include <riis/riis_vtk.h>

#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "program/base/options.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// An edge between two nodes that may be in several pieces.
struct KeyedEdge {
  NodeKey p, q;  // p < q
  double length, distance, middle[3];

  bool operator<(const KeyedEdge &other) const { return std::tie(p, q) < std::tie(other.p, other.q); }
  bool operator==(const KeyedEdge &other) const { return p == other.p && q == other.q; }
};
KeyedEdge edge_between(NodeKey p, NodeKey q, double length);
// Returns the edges of all ranks in order, each once.
std::vector<KeyedEdge> gathered(const std::vector<KeyedEdge> &own);

// Returns the half thickness that the surface still needs if it has the given one, or nothing if it is closed.
using Left = std::function<std::optional<double>(double half_thickness)>;
// Returns a half thickness that closes the surface, or 0 if none is found. `valve` is null for a surface from a file.
double closing_half_thickness(const riis_valve *valve, double half_thickness, const Left &left);
// Makes the surface of a valve with another half thickness.
Surface with_half_thickness(const MarkOptions &options, const riis_valve *valve, double half_thickness);

// The leaks of one surface. The surface must be the same in each call.
class MeshLeaks {
 public:
  // `name` is the surface's name in the warning.
  MeshLeaks(const MarkOptions &options, const MeshPieces &mesh, const riis_surface *surface, const riis_valve *valve,
            std::string name);
  // Adds the leaks of a piece that was marked with this surface.
  void add(Piece &piece, riis_marks *marks);
  // Puts the leaks of all ranks into the report, and warns if there are some or if some are unknown. If two points are checked,
  // PassageCheck warns instead. The report has the marks, the surface and the numbers of volume cells.
  void judge(ValveReport &report);

 private:
  // Adds the leaks of a marking with a half thickness.
  void add(Piece &piece, const riis_surface *surface, riis_marks *marks, double half_thickness, bool is_complete,
           std::vector<KeyedEdge> &to) const;
  std::optional<double> left(double half_thickness) const;

  const MarkOptions &options_;
  const MeshPieces &mesh_;
  const riis_surface *surface_;
  const riis_valve *valve_;
  std::string name_;
  riis_surface_info info_;
  std::vector<Box> boxes_;  // by piece, empty for the pieces of other ranks
  std::vector<KeyedEdge> found_;
};

}  // namespace riis::program
