// SPDX-License-Identifier: Apache-2.0
// In: a mesh, one file or several pieces. Out: the mesh's pieces, read one by one, and the nodes that a piece shares with other
// pieces. A mesh of one file is one piece. Each node has a key, and nodes of two pieces are the same node if their keys are
// equal.
#pragma once

#include <riis/riis_vtk.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/sets.hpp"
#include "program/base/handles.hpp"
#include "program/base/options.hpp"
#include "program/base/units.hpp"
#include "program/mark/mesh_marking.hpp"
#include "program/output/report.hpp"

namespace riis::program {

using PieceList = Handle<riis_vtk_pieces, riis_vtk_pieces_destroy>;

// Returns whether the path is that of a mesh in pieces.
bool is_in_pieces(const std::string &mesh);

struct Piece;

// A mesh. Each rank takes some of its pieces. A mesh of one file stays in memory until its piece is dropped.
class MeshPieces {
 public:
  // Reads the list of a .pvtu file. The options must outlive this object.
  explicit MeshPieces(const MarkOptions &options);
  virtual ~MeshPieces();
  MeshPieces(const MeshPieces &) = delete;
  MeshPieces &operator=(const MeshPieces &) = delete;

  const std::string &path() const { return options_.mesh; }
  const std::vector<std::string> &files() const { return files_; }
  bool is_whole() const { return is_whole_; }
  const std::string &cells_where() const { return options_.cells_where; }
  // Warns of domains that touch, if the user chose none of them. The function needs the pieces that this rank has read.
  void warn_of_regions() const;
  // Calls `work` with each of this rank's pieces, in ascending order, or only with those whose numbers `is_wanted` accepts. A
  // failure ends all ranks. Adds to the seconds of reading, unless they are NULL.
  void for_each_own(const std::function<void(Piece &)> &work, Seconds *seconds = nullptr,
                    const std::function<bool(std::int64_t)> &is_wanted = nullptr) const;

 protected:
  MeshPieces(const MarkOptions &options, std::vector<std::string> files)
      : options_(options), files_(std::move(files)) {}
  virtual MeshFile read(std::int64_t piece) const;
  // Called after the first work with a piece.
  virtual void finished(std::int64_t) const {}

 private:
  const MarkOptions &options_;
  bool is_whole_ = false;
  PieceList list_;
  std::vector<std::string> files_;
  mutable std::unique_ptr<Piece> held_;  // the piece of a whole mesh, once it is read
  mutable std::string regions_;          // about the first piece with domains that touch
};

using NodeKey = std::array<std::uint64_t, 2>;

// The nodes of one piece. In a whole mesh, all nodes are inside, and a key is the node's number. In a piece with global ids, a
// key is the id and a hash of the coordinates. Without, a key is a hash of 128 bits of the coordinates. The probability that two
// of a billion nodes have equal hashes is below 1e-20.
class PieceNodes {
 public:
  // `how` has the mesh of which the file is a piece.
  PieceNodes(const riis_vtk_mesh *file, const std::string &path, const MarkOptions &how, bool is_whole);

  std::int64_t n() const { return points_.n(); }
  NodePoints::Point point(std::int64_t node) const { return points_[node]; }
  NodeKey key(std::int64_t node) const;
  bool is_shared(std::int64_t node) const { return role(node) == RIIS_VTK_NODE_SHARED || is_loose(node); }
  bool is_loose(std::int64_t node) const { return role(node) == RIIS_VTK_NODE_LOOSE; }
  bool is_inside(std::int64_t node) const { return role(node) == RIIS_VTK_NODE_INSIDE; }
  bool is_ghost(std::int64_t node) const { return role(node) == RIIS_VTK_NODE_GHOST; }
  // Returns (n) with 0 for ghosts, or NULL if there are no ghosts.
  const std::uint8_t *mask() const { return mask_.empty() ? nullptr : mask_.data(); }
  const riis_vtk_sharing &counts() const { return counts_; }
  bool is_whole() const { return is_whole_; }
  // Ghosts do not count in the box and the moments.
  const Box &box() const { return box_; }
  const Moments &moments() const { return moments_; }
  bool has_ids() const { return counts_.has_global_ids != 0; }
  // Returns the global id, or the number in the piece if there are no global ids.
  std::int64_t id(std::int64_t node) const { return has_ids() ? ids_[static_cast<std::size_t>(node)] : node; }

 private:
  std::uint8_t role(std::int64_t node) const {
    return is_whole_ ? static_cast<std::uint8_t>(RIIS_VTK_NODE_INSIDE) : role_[static_cast<std::size_t>(node)];
  }

  void find_box_and_moments();

  bool is_whole_;
  NodePoints points_;
  Box box_ = empty_box();
  Moments moments_;
  std::vector<std::uint8_t> role_, mask_;
  std::vector<std::int64_t> ids_;
  riis_vtk_sharing counts_{};
};

// A piece in memory. Later members borrow from earlier ones.
struct Piece {
  Piece(std::int64_t its_number, std::string its_path, MeshFile its_file, const MarkOptions &how, bool is_whole);

  std::int64_t number;
  std::string path;
  MeshFile file;
  PieceNodes nodes;
  std::optional<FileNodes> mesh;  // not set for a piece without nodes
};

// The numbers of a part of a mesh, such as the pieces of a rank. Shared nodes are counted apart.
struct MeshCounts {
  std::int64_t n_nodes = 0, n_cells = 0, n_volume_cells = 0, n_cells_left_out = 0;
  std::int64_t n_with_nodes = 0, n_with_ids = 0;  // pieces
  double median_edge = 0, n_edge_cells = 0;       // the mean of the pieces' median edges, weighted by cells
  Box box = empty_box();
  Moments moments{};

  void add(const Piece &piece);
  void add(const MeshCounts &other);
};
// Returns the sums over all ranks. Refuses a mesh without nodes, and global ids that only some pieces have.
MeshCounts sum_of(const MeshCounts &own, const MeshPieces &mesh);

// Sets of things that join. At first each thing is a set.
template <class Thing>
class JoinedSets {
 public:
  // Unites the sets of two things, and returns whether the sets were different.
  bool unite(const Thing &a, const Thing &b) { return sets_.unite(number(a), number(b)); }
  bool are_joined(const Thing &a, const Thing &b) { return sets_.root(number(a)) == sets_.root(number(b)); }

 private:
  std::int64_t number(const Thing &thing) {
    const auto [place, is_new] = numbers_.emplace(thing, static_cast<std::int64_t>(numbers_.size()));
    if (is_new) sets_.add();
    return place->second;
  }

  std::map<Thing, std::int64_t> numbers_;
  DisjointSets sets_{0};
};

// A node that several pieces may have, in one of them.
struct SharedNode {
  NodeKey key;
  std::int32_t region;  // the node's open region, numbered within the piece, or -1
  std::int32_t piece;
};

// Returns the shared nodes of a piece. `regions` has the open region of each node, or is empty.
std::vector<SharedNode> shared_nodes_of(const Piece &piece, const std::vector<std::int64_t> &regions);

// An open region of a piece.
struct PieceRegion {
  std::int32_t piece, region;
  bool operator<(const PieceRegion &other) const {
    return std::tie(piece, region) < std::tie(other.piece, other.region);
  }
  bool operator==(const PieceRegion &other) const { return piece == other.piece && region == other.region; }
};

// Regions of two pieces with a common node.
using JoinedRegions = std::array<PieceRegion, 2>;

// The shared nodes of all pieces, each counted once.
struct MatchedNodes {
  std::int64_t n_nodes = 0, n_in_several = 0;  // all nodes, and the nodes that more than one piece has
  std::vector<JoinedRegions> joined{};

  // Returns how many regions are a part of another region.
  std::int64_t n_joins() const;
};

// Matches the nodes of all ranks. `has_ids` says whether keys have global ids. With ids, one id at two places is refused. `files`
// names the pieces.
MatchedNodes match_nodes(std::vector<std::vector<SharedNode>> by_piece, bool has_ids,
                         const std::vector<std::string> &files);

// Warns if no piece shares a node with another.
void warn_of_apart(const MeshCounts &counts, const MatchedNodes &matched, const MeshPieces &mesh);

// The nodes that no cell of their piece uses. Such nodes count if no other piece has them inside.
class LooseNodes {
 public:
  void add(const PieceNodes &nodes);
  // Refuses a mesh in which a loose node is inside another piece, because the node would count twice. Reads the pieces again if
  // there are loose nodes.
  void check(const MeshPieces &mesh) const;

 private:
  std::vector<NodeKey> keys_;
};

// Returns memory that is free in this process to the system. Without this call, large pieces' freed memory would stay between
// the shared nodes.
void release_free_memory();

// Counts nodes of several kinds, such as the marked nodes at each time. Nodes inside a piece are counted when the piece is
// added. Nodes that pieces share are counted at the end, each once.
class NodeCounts {
 public:
  explicit NodeCounts(std::size_t n_kinds) : n_inside_(n_kinds) {}
  void add(const PieceNodes &nodes, const riis_mark_list &list, std::size_t kind);
  // Returns the number of nodes of each kind in all pieces of all ranks. A node counts once for each kind.
  std::vector<std::int64_t> sums() const;

 private:
  struct SharedKind {
    NodeKey key;
    std::uint64_t kind;
    bool operator<(const SharedKind &other) const { return std::tie(kind, key) < std::tie(other.kind, other.key); }
    bool operator==(const SharedKind &other) const { return kind == other.kind && key == other.key; }
  };
  std::vector<std::int64_t> n_inside_;
  std::vector<SharedKind> shared_;
};

}  // namespace riis::program
