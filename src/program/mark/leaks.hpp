// SPDX-License-Identifier: Apache-2.0
// In: a marked mesh. Out: the number of the mesh's edges that cross the surface between unmarked nodes, and a half thickness that
// closes these leaks.
#pragma once

#include <riis/riis.h>
#include <riis/riis_vtk.h>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "common/edge_lengths.hpp"
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

// Returns the half thickness that the surface needs, or nothing if the given half thickness closes the surface.
using Left = std::function<std::optional<double>(double half_thickness)>;
// Returns a half thickness that closes the surface, or 0 if none is found. `valve` is null for a surface from a file.
double closing_half_thickness(const riis_valve *valve, double half_thickness, const Left &left);
// Makes the surface of a valve with another half thickness.
Surface with_half_thickness(const MarkOptions &options, const riis_valve *valve, double half_thickness);

// Returns the length of a skirt that closes a surface from a file, or 0 if none of the tried lengths does. The given half
// thickness closes the surface, and is about as large as the gaps to the wall. `closes` tells whether a surface has no leak.
// Without a file or with a skirt, the call returns 0.
double closing_skirt(const MarkOptions &options, const riis_surface *surface, double half_thickness,
                     const std::function<bool(const riis_surface *)> &closes);

// The leaks of one surface. The surface must be the same in each call.
class MeshLeaks {
 public:
  // `name` is the surface's name in the warning.
  MeshLeaks(const MarkOptions &options, const MeshPieces &mesh, const riis_surface *surface, const riis_valve *valve,
            std::string name);
  // Adds the leaks of a piece that was marked with this surface.
  void add(Piece &piece, riis_marks *marks);
  // Puts the leaks of all ranks into the report, and warns of leaks, or if leaks are unknown. If two points are checked,
  // PassageCheck warns instead. The report has the marks, the surface and the numbers of volume cells.
  void judge(ValveReport &report);

 private:
  // Adds the leaks of a marking with a half thickness.
  void add(Piece &piece, const riis_surface *surface, riis_marks *marks, double half_thickness, bool is_complete,
           std::vector<KeyedEdge> &to) const;
  std::optional<double> left(const riis_surface *surface, double half_thickness) const;

  const MarkOptions &options_;
  const MeshPieces &mesh_;
  const riis_surface *surface_;
  const riis_valve *valve_;
  std::string name_;
  riis_surface_info info_;
  std::vector<Box> boxes_;  // by piece, empty for the pieces of other ranks
  std::vector<KeyedEdge> found_;
};

// In: a mesh and two points. Out: whether unmarked nodes join the points, the place of the widest passage, and a half thickness
// that closes it.

// The end of a passage: of the nodes with a neighbour, the nearest to a point of the user.
struct PieceEnd {
  NodeKey key;
  double point[3], distance, longest_edge;  // distance to the user's point
  std::int64_t piece, node, id;
};

// Whether unmarked nodes of all pieces join the two points of options.check_leaks. Without points, it does nothing.
class PassageCheck {
 public:
  PassageCheck(const MarkOptions &options, const MeshPieces &mesh) : options_(options), mesh_(mesh) {}
  // Notes the nodes of the piece that are nearest to the points. The piece has its neighbours.
  void add(const Piece &piece);
  // Writes report.passage, and warns if the points are joined. `valve` is null if the surface is not that of one valve. `name` is
  // the surface's name in the warning. The report has the numbers of volume cells.
  void judge(const riis_surface *surface, const riis_valve *valve, const std::string &name, const MeshCounts &counts,
             Report &report);

 private:
  // Returns the node of all pieces that is nearest to an end. The longest edge of this node may be in another piece.
  std::optional<PieceEnd> nearest(int end, bool has_ids) const;
  PassageReport find(const riis_surface *surface) const;
  double longest_edge_at(const riis_passage &found, const MeshCounts &counts) const;
  // Finds the opening at which unmarked nodes first join the ends. Each opening reads all pieces.
  riis_first_passage first_of(const riis_valve *valve) const;

  const MarkOptions &options_;
  const MeshPieces &mesh_;
  std::vector<PieceEnd> found_ends_[2];  // the nearest node of each piece
  PieceEnd ends_[2] = {};
};

// In: the marked pieces of a mesh. Out: measures of one valve's band for a flow: the mesh edges across it, and the open
// regions that it separates.
class BandMeasures {
 public:
  // Adds a piece, which has its neighbours. Returns the open region of each node.
  std::vector<std::int64_t> add(const Piece &piece, const riis_marks *marks, const riis_mark_options &options);
  // Writes the measures of all ranks into the report.
  void judge(const MatchedNodes &matched, double half_thickness, FlowReport &report) const;

 private:
  // Lengths of the edges with a marked node. The sum is long, so that the mean hardly depends on the pieces.
  using Lengths = EdgeLengths<long double>;
  void add_lengths(const Piece &piece, const riis_mark_list &marked);

  std::optional<riis_cells_across> of_whole_;
  Lengths lengths_;                // of edges that no other piece has
  std::vector<KeyedEdge> shared_;  // edges between two shared nodes, which may be in several pieces
  std::int64_t n_regions_ = 0;
};

}  // namespace riis::program
