// SPDX-License-Identifier: Apache-2.0
// The input is a marked mesh. The results are the number of mesh edges that cross the surface between unmarked nodes, and a half
// thickness that closes these leaks.
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
#include "program/base/area_samples.hpp"
#include "program/base/options.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/mark/moving_valve.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// An edge between two nodes. The two nodes may be in several pieces of the mesh.
struct KeyedEdge {
  NodeKey p, q;  // p < q
  double length, distance, middle[3];

  bool operator<(const KeyedEdge &other) const { return std::tie(p, q) < std::tie(other.p, other.q); }
  bool operator==(const KeyedEdge &other) const { return p == other.p && q == other.q; }
};
KeyedEdge edge_between(NodeKey p, NodeKey q, double length);
// Returns the edges of all ranks in ascending order, and each edge only once.
std::vector<KeyedEdge> gathered(const std::vector<KeyedEdge> &own);

// Returns the half thickness that the surface needs. Returns nothing if the given half thickness closes all leaks.
using Left = std::function<std::optional<double>(double half_thickness)>;
// Returns a half thickness that closes all leaks, or 0 if none was found. For a surface from a file, `valve` is null.
double closing_half_thickness(const riis_valve *valve, double half_thickness, const Left &left);
// Makes the surface of a valve with another half thickness.
Surface with_half_thickness(const MarkOptions &options, const riis_valve *valve, double half_thickness);

// Returns the length of a skirt that closes the leaks of a surface from a file, or 0 if no tried length closes them. The given
// half thickness closes the leaks, and is about as large as the gaps to the wall. `closes` tells whether a surface has no leak.
// Returns 0 for a parametric valve, and for a surface that has a skirt.
double closing_skirt(const MarkOptions &options, const riis_surface *surface, double half_thickness,
                     const std::function<bool(const riis_surface *)> &closes);

// The leaks of one surface. All calls must use the same surface.
class MeshLeaks {
 public:
  // In the warning, `name` names the surface.
  MeshLeaks(const MarkOptions &options, const MeshPieces &mesh, const riis_surface *surface, const riis_valve *valve,
            std::string name);
  // Adds the leaks of a piece. The piece must already be marked with the surface.
  void add(Piece &piece, riis_marks *marks);
  // Puts the leaks of all ranks into the report. Warns of leaks, and also if leaks are unknown. Leaves the warning to
  // PassageCheck if two points are checked. The report must already have the marks, the surface and the numbers of volume cells.
  void judge(ValveReport &report);

 private:
  // Adds the leaks of a marking with the given half thickness.
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

// The input is a mesh and two points. The result says whether unmarked nodes join the points, where the widest passage is, and
// which half thickness closes it.

// The end of a passage: the node that is nearest to a point of the user. Nodes without a neighbour do not count.
struct PieceEnd {
  NodeKey key;
  double point[3], distance, longest_edge;  // distance to the user's point
  std::int64_t piece, node, id;
};

// Checks whether unmarked nodes of all pieces join the two points of options.check_leaks. Without the two points, the check does
// nothing.
class PassageCheck {
 public:
  PassageCheck(const MarkOptions &options, const MeshPieces &mesh) : options_(options), mesh_(mesh) {}
  // Stores the nodes of the piece that are nearest to the two points. The neighbours of the piece's nodes must be known.
  void add(const Piece &piece);
  // Writes report.passage, and warns if the points are joined. If the surface is not that of one valve, `valve` is null. In the
  // warning, `name` names the surface. The report must already have the numbers of volume cells.
  void judge(const riis_surface *surface, const riis_valve *valve, const std::string &name, const MeshCounts &counts,
             Report &report);

 private:
  // Of the nodes of all pieces, returns the node nearest to an end. The longest edge at the node may be in another piece.
  std::optional<PieceEnd> nearest(int end, bool has_ids) const;
  PassageReport find(const riis_surface *surface) const;
  double longest_edge_at(const riis_passage &found, const MeshCounts &counts) const;
  // Finds the opening at which unmarked nodes first join the two ends. All pieces are read again for each opening.
  riis_first_passage first_of(const riis_valve *valve) const;

  const MarkOptions &options_;
  const MeshPieces &mesh_;
  std::vector<PieceEnd> found_ends_[2];  // the nearest node of each piece
  PieceEnd ends_[2] = {};
};

// The inputs are the marked pieces of a mesh. The results are measures of one valve's band for a flow: the number of mesh edges
// across the band, and the open regions that the band separates.
class BandMeasures {
 public:
  // Adds a piece, whose nodes' neighbours must be known. Returns the open region of each node.
  std::vector<std::int64_t> add(const Piece &piece, const riis_marks *marks, const riis_mark_options &options);
  // Writes the measures of all ranks into the report.
  void judge(const MatchedNodes &matched, double half_thickness, FlowReport &report) const;

 private:
  // The lengths of the edges that have a marked node. The sum is a long double. The mean therefore hardly depends on the division
  // into pieces.
  using Lengths = EdgeLengths<long double>;
  void add_lengths(const Piece &piece, const riis_mark_list &marked);

  std::optional<riis_cells_across> of_whole_;
  Lengths lengths_;                // of edges that no other piece has
  std::vector<KeyedEdge> shared_;  // edges between two shared nodes, which may be in several pieces
  std::int64_t n_regions_ = 0;
};

// The inputs are a surface and the pieces of a mesh. The result is the share of the leaflets' area that is farther than the half
// thickness from the mesh. Skirts and the housing of a bileaflet valve do not count, because they may reach beyond the wall.
class LeafletsOutside {
 public:
  // Takes the surface at the valve's present position.
  explicit LeafletsOutside(const MovingValve &valve);
  // Takes another surface of a valve with the given options.
  LeafletsOutside(const MarkOptions &options, const riis_surface *surface, std::optional<double> opening);
  void add(const Piece &piece);
  std::optional<double> opening() const { return opening_; }
  // Returns the share of the area that is outside all pieces of this rank so far.
  double share_so_far() const { return share_of(is_outside_); }
  // Returns the shares of the area that are outside the pieces of all ranks.
  OutsideReport report() const;

 private:
  double share_of(const std::vector<std::uint8_t> &is_outside) const;

  const MarkOptions &options_;
  riis_surface_info info_;
  std::optional<double> opening_;
  AreaSamples samples_;
  std::vector<std::uint8_t> is_outside_;  // of all pieces so far
};

// Warns if more than a small share of the leaflets is outside the mesh. Open leaflets may rightly lie against the wall and reach
// into it. The closed state, `closed`, therefore decides whether the valve is in a wrong place. A surface from a file has no
// `closed`. In the warning, `name` names the surface.
void warn_of_outside(const OutsideReport &report, const std::optional<OutsideReport> &closed, double half_thickness,
                     const std::string &name);
// Returns the share of the leaflets' area outside the mesh, and of single leaflets, such as "26 %" and "right 61 %".
std::string outside_text(const OutsideReport &report);

}  // namespace riis::program
