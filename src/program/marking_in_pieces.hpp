// SPDX-License-Identifier: Apache-2.0
// In: a mesh in pieces, and a surface. Out: marked pieces in files, and a report as for the joined mesh. Each rank reads, marks
// and writes its pieces one by one, and keeps only their shared nodes, leaks and counts. Then the ranks exchange these.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "program/leaks.hpp"
#include "program/mesh_marking.hpp"
#include "program/mesh_pieces.hpp"
#include "program/options.hpp"
#include "program/report.hpp"
#include "program/warnings.hpp"

namespace riis::program {

// Refuses options that need the whole mesh at once.
void check_options_of_pieces(const MarkOptions &options);

// A Box that contains nothing.
Box empty_box();
void grow(Box &box, const double *point);
void grow(Box &box, const Box &other);
Box box_of(const PieceNodes &nodes);

// The numbers of a part of a mesh, such as the pieces of a rank. Shared nodes are counted apart.
struct MeshCounts {
  std::int64_t n_nodes = 0, n_cells = 0, n_volume_cells = 0, n_cells_left_out = 0;
  std::int64_t n_with_nodes = 0, n_with_ids = 0;  // pieces
  double sum_of_edges = 0, n_edge_cells = 0;      // for the mean of the pieces' median edges
  Box box = empty_box();

  void add(const riis_vtk_mesh *file, const PieceNodes &nodes);
  double median_edge() const { return n_edge_cells > 0 ? sum_of_edges / n_edge_cells : 0; }
};
// Returns the sums over all ranks. Refuses a mesh without nodes, and global ids that only some pieces have.
MeshCounts sum_of(const MeshCounts &own, const MeshPieces &pieces);
// Warns if no piece shares a node with another.
void warn_of_apart(const MeshCounts &counts, const MatchedNodes &matched, const MeshPieces &pieces);

// Writes the pieces of a mesh, and last their list.
class PieceOutput {
 public:
  // `path` is that of the list, or "" if nothing is written. `n_pieces` is the number of pieces on all ranks.
  PieceOutput(std::string path, std::int64_t n_pieces);
  bool is_wanted() const { return !path_.empty(); }
  void write(std::int64_t piece, const riis_vtk_mesh *mesh);
  // Writes the list, after all ranks have written their pieces.
  void finish();

 private:
  std::string path_;
  std::vector<std::string> files_;
  PieceList list_;  // with the arrays of this rank's first piece that has nodes, if there is one
  bool has_arrays_ = false;
};

// Reads a piece, and adds to the seconds.
MeshFile read_piece(const MarkOptions &options, const MeshPieces &pieces, std::int64_t piece, Seconds &seconds);
// Returns the shared nodes of a piece. `regions` has the open region of each node, or is empty.
std::vector<SharedNode> shared_nodes_of(std::int64_t piece, const PieceNodes &nodes,
                                        const std::vector<std::int64_t> &regions);
Situation situation_in_pieces(const MarkOptions &options, const riis_surface_info &surface, std::int64_t n_nodes,
                              std::int64_t n_marked, const MeshCounts &counts);

// An edge between two nodes that may be in several pieces.
struct KeyedEdge {
  NodeKey p, q;  // p < q
  double length, distance, middle[3];

  bool operator<(const KeyedEdge &other) const { return std::tie(p, q) < std::tie(other.p, other.q); }
  bool operator==(const KeyedEdge &other) const { return p == other.p && q == other.q; }
};

// The leaks of one surface in all pieces. The surface must not move until judge was called.
class PieceLeaks {
 public:
  // `name` is the surface's name in the warning.
  PieceLeaks(const MarkOptions &options, const MeshPieces &pieces, const riis_surface *surface, const riis_valve *valve,
             std::string name);
  // Adds the leaks of a piece that was marked with this surface.
  void add(std::int64_t piece, const PieceNodes &nodes, const riis_vtk_mesh *file, riis_mesh *mesh, riis_marks *marks);
  // Puts the leaks of all ranks into report.leaks, and warns. The report has the surface and the numbers of volume cells.
  void judge(Report &report);

 private:
  riis_leak_list leaks_with(double half_thickness) const;

  const MarkOptions &options_;
  const MeshPieces &pieces_;
  const riis_surface *surface_;
  const riis_valve *valve_;
  std::string name_;
  riis_surface_info info_{};
  std::vector<Box> boxes_;  // by piece, empty for the pieces of other ranks
  std::vector<KeyedEdge> found_;
};

// The end of a passage in a mesh in pieces.
struct PieceEnd {
  NodeKey key;
  double point[3], distance, longest_edge;  // the node's distance to the point that the user gave
  std::int64_t piece, node, id;
};

// Whether unmarked nodes of all pieces join the two points of options.check_leaks.
class PassageCheck {
 public:
  PassageCheck(const MarkOptions &options, const MeshPieces &pieces) : options_(options), pieces_(pieces) {}
  // Notes the nodes of the piece that are nearest to the points.
  void add(std::int64_t piece, const PieceNodes &nodes, const NodeEdges &edges);
  // As program::check_passage. The report has the surface and the numbers of volume cells.
  void judge(const riis_surface *surface, const riis_valve *valve, const std::string &name, const MeshCounts &counts,
             Report &report) const;

 private:
  void note(std::int64_t piece, const PieceNodes &nodes, const NodeEdges &edges, int end);
  std::optional<PieceEnd> nearest(int end, bool has_ids) const;

  const MarkOptions &options_;
  const MeshPieces &pieces_;
  std::vector<PieceEnd> ends_[2];  // the nearest node of each piece
};

// Marks all pieces and writes them. Fills the report, except for the surface.
void mark_pieces(const MarkOptions &options, const MeshPieces &pieces, const riis_surface *surface,
                 const riis_valve *valve, const std::vector<std::string> &names_of_arrays, Report &report);

struct PiecePassage {
  riis_passage found;
  bool is_end;  // whether the node is one of the ends
};
// Finds the widest passage between two nodes, as riis_find_passage does in a joined mesh.
PiecePassage find_passage(const MarkOptions &options, const MeshPieces &pieces, const riis_surface *surface,
                          const PieceEnd (&ends)[2]);

}  // namespace riis::program
