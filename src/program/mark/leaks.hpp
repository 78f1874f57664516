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

// Returns the half thickness that a surface needs. Returns nothing if its own half thickness closes all leaks.
using Left = std::function<std::optional<double>(const riis_surface *)>;
// Returns lengths that close the leaks of a surface. The leaks need the half thickness `needed`. For a surface from a file,
// `valve` is null.
Closing closing_of(const MarkOptions &options, const riis_surface *surface, const riis_valve *valve, double needed,
                   const Left &left);
// Returns the beginning of an advice, such as "--half-thickness 0.2 or --skirt 0.4 closes ".
std::string text_of(const Closing &closing);

// The leaks of one surface. All calls must use the same surface.
class MeshLeaks {
 public:
  // In the warning, `name` names the surface.
  MeshLeaks(const MovingValve &valve, const MeshPieces &mesh, std::string name);
  // Adds the leaks of a piece. The piece must already be marked with the surface.
  void add(Piece &piece, riis_marks *marks);
  // Puts the leaks of all ranks into the report. Warns of leaks, and also if leaks are unknown. Leaves the warning to
  // PassageCheck if two points are checked. The report must already have the marks, the surface and the numbers of volume cells.
  void judge(ValveReport &report);

 private:
  // Adds the leaks of a marking with the given surface.
  void add(Piece &piece, const riis_surface *surface, riis_marks *marks, std::vector<KeyedEdge> &to) const;
  std::optional<double> left(const riis_surface *surface) const;

  const MovingValve &valve_;
  const MarkOptions &options_;
  const MeshPieces &mesh_;
  std::string name_;
  riis_surface_info info_;
  std::vector<Box> boxes_;  // by piece, empty for the pieces of other ranks
  std::vector<KeyedEdge> found_;
};

// The input is a mesh and two points. The result says whether unmarked nodes join the points, where the widest passage is, and
// which half thickness closes it.

// A node on the way from one end of a passage to the other.
struct PassageNode {
  NodeKey key;
  std::int64_t piece, node, id;
  FileNodes::Point point;
  double distance;  // of an end: to the user's point; of other nodes: the least half thickness that marks the node
};
// The end of a passage: the node that is nearest to a point of the user. Nodes without a neighbour do not count.
struct PassageEnd : PassageNode {
  double longest_edge;
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
  // Sets an end to the nearest node of all pieces. The longest edge at the node may be in another piece.
  void find_end(int end, const MeshCounts &counts, const std::string &unknown);
  // Refuses an end that lies in the band.
  void check_ends_are_open(const riis_surface *surface) const;
  PassageReport find(const riis_surface *surface) const;
  // Returns nothing if the passage is wider than the given limit.
  std::optional<PassageReport> find_within(const riis_surface *surface, double limit) const;
  // Finds the opening at which unmarked nodes first join the two ends. All pieces are read again for each opening.
  riis_first_passage first_of(const riis_valve *valve) const;

  const MarkOptions &options_;
  const MeshPieces &mesh_;
  std::vector<PassageEnd> found_ends_[2];  // the nearest node of each piece
  PassageEnd ends_[2] = {};
  std::string names_[2];  // of the ends
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
  // The surface may move after the call.
  LeafletsOutside(const MarkOptions &options, const riis_surface *surface, std::optional<double> opening);
  void add(const Piece &piece);
  // Returns the shares of the area that are outside the pieces of all ranks.
  OutsideReport report() const;

 private:
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
