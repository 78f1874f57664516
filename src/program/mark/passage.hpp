// SPDX-License-Identifier: Apache-2.0
// In: a mesh and two points. Out: whether unmarked nodes join the points, the place of the widest passage, and a half thickness
// that closes it.
#pragma once

#include <riis/riis.h>

#include <optional>
#include <string>
#include <vector>

#include "program/base/options.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// Returns the check for the two points of --between.
LeakCheck leak_check_between(const std::vector<std::string> &points);

// The end of a passage: the node that is nearest to a point of the user's, among the nodes with a neighbour.
struct PieceEnd {
  NodeKey key;
  double point[3], distance, longest_edge;  // distance to the user's point
  std::int64_t piece, node, id;
};

struct FoundPassage {
  riis_passage found;
  bool is_end;  // whether the node is one of the ends
};
// Finds the widest passage in a mesh in pieces, as riis_find_passage does in a whole mesh.
FoundPassage find_passage(const MarkOptions &options, const MeshPieces &mesh, const riis_surface *surface,
                          const PieceEnd (&ends)[2]);

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
  // Returns the node of all pieces that is nearest to an end. Its longest edge may be in another piece.
  std::optional<PieceEnd> nearest(int end, bool has_ids) const;
  FoundPassage find(const riis_surface *surface) const;
  double longest_edge_at(const riis_passage &found, const MeshCounts &counts) const;
  // Finds the opening at which unmarked nodes first join the ends. Each opening reads all pieces.
  riis_first_passage first_of(const riis_valve *valve) const;

  const MarkOptions &options_;
  const MeshPieces &mesh_;
  std::vector<PieceEnd> found_ends_[2];  // the nearest node of each piece
  PieceEnd ends_[2] = {};
};

}  // namespace riis::program
