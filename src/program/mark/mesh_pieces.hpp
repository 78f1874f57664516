// SPDX-License-Identifier: Apache-2.0
// The input is a mesh, in one file or in several pieces. The results are the mesh's pieces, which are read one by one, and the
// nodes that several pieces share. A mesh in one file counts as one piece. Each node has a key. Nodes of two pieces are the same
// node if their keys are equal.
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
#include <utility>
#include <vector>

#include "common/sets.hpp"
#include "program/base/handles.hpp"
#include "program/base/options.hpp"
#include "program/base/ranks.hpp"
#include "program/base/units.hpp"
#include "program/output/report.hpp"

namespace riis::program {

double distance_between(const double *p, const double *q);
// Returns the value in the middle, or the upper one of two such values.
double median(std::vector<double> values);

// The nodes of a mesh file as the library takes them, and the neighbours of each node. A rectilinear grid has only the
// coordinates along its axes, and the library computes its neighbours.
class FileNodes {
 public:
  using Point = std::array<double, 3>;

  // The file must outlive this object. Refusals call the file by `path`.
  FileNodes(const riis_vtk_mesh *file, std::string path);

  const std::string &path() const { return path_; }
  std::int64_t n() const { return n_; }
  riis_mesh *mesh() const { return mesh_.get(); }
  bool is_grid() const { return axes_.ni > 0; }
  Point point(std::int64_t node) const {
    if (xyz_) return {xyz_[3 * node], xyz_[3 * node + 1], xyz_[3 * node + 2]};
    const std::int64_t layer = node / axes_.ni;
    return {x_[0][node % axes_.ni], x_[1][layer % axes_.nj], x_[2][layer / axes_.nj]};
  }

  // Finds the neighbours of all nodes if they are not known yet, and gives them to the library's mesh.
  void find_neighbors(std::int32_t n_threads);
  // Frees the library's mesh and the neighbours.
  void release();
  // Gives the library's mesh other neighbours. With NULL, the mesh gets back the neighbours that it had before.
  void lend_neighbors(const riis_csr *rows);
  // Both functions below need the neighbours of the nodes.
  template <class Visit>
  void for_each_neighbor(std::int64_t node, const Visit &visit) const {
    if (is_grid()) {
      std::int64_t stride = 1;
      for (const std::int64_t n : {axes_.ni, axes_.nj, axes_.nk}) {
        const std::int64_t i = node / stride % n;
        if (i > 0) visit(node - stride);
        if (i + 1 < n) visit(node + stride);
        stride *= n;
      }
      return;
    }
    const auto *offsets = static_cast<const std::int64_t *>(rows_.offsets);
    for (std::int64_t k = offsets[node]; k < offsets[node + 1]; ++k)
      visit(rows_.column_bits == 64 ? static_cast<const std::int64_t *>(rows_.columns)[k]
                                    : static_cast<const std::int32_t *>(rows_.columns)[k]);
  }
  double longest_edge(std::int64_t node) const;

 private:
  const riis_vtk_mesh *file_;
  std::string path_;
  std::int64_t n_ = 0;
  const double *xyz_ = nullptr;  // NULL if there are axes
  riis_grid axes_;
  const double *x_[3];
  Adjacency neighbors_;
  riis_csr rows_{};
  Mesh mesh_;
};

using PieceList = Handle<riis_vtk_pieces, riis_vtk_pieces_destroy>;

// Returns whether the path names a mesh in pieces.
bool is_in_pieces(const std::string &mesh);

class Piece;

// A mesh whose pieces are distributed among the ranks. A mesh in one file is read once, and its only piece stays in memory.
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
  // If the user chose no domain, warns of domains that touch. The warning covers the pieces that this rank has read.
  void warn_of_regions() const;
  // Calls `work` with each of this rank's pieces in ascending order. With `is_wanted`, calls `work` only for the pieces whose
  // numbers `is_wanted` accepts. A failure ends the run on all ranks. Adds the time of reading to `seconds`, if this is not NULL.
  void for_each_own(const std::function<void(Piece &)> &work, Seconds *seconds = nullptr,
                    const std::function<bool(std::int64_t)> &is_wanted = nullptr) const;

 protected:
  MeshPieces(const MarkOptions &options, std::vector<std::string> files)
      : options_(options), files_(std::move(files)) {}
  virtual MeshFile read(std::int64_t piece) const;
  // The function is called after the first work with a piece.
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

// A piece in memory: its file, its nodes and their keys. In a whole mesh, all nodes are inside, and the key of a node is its
// number. If a piece has global ids, a key is the id and a hash of the coordinates. If a piece has no global ids, a key is a hash
// of the coordinates with 128 bits. The probability that two of a billion nodes have equal hashes is below 1e-20.
class Piece : public FileNodes {
 public:
  // `how` names the mesh to which the piece belongs. The nodes borrow from the file.
  Piece(std::int64_t number, MeshFile file, const std::string &path, const MarkOptions &how);

  NodeKey key(std::int64_t node) const;
  bool is_shared(std::int64_t node) const { return role(node) == RIIS_VTK_NODE_SHARED || is_loose(node); }
  bool is_loose(std::int64_t node) const { return role(node) == RIIS_VTK_NODE_LOOSE; }
  bool is_inside(std::int64_t node) const { return role(node) == RIIS_VTK_NODE_INSIDE; }
  bool is_ghost(std::int64_t node) const { return role(node) == RIIS_VTK_NODE_GHOST; }
  // Returns an array (n) with 0 for each ghost node, or NULL if there are no ghosts.
  const std::uint8_t *mask() const { return mask_.empty() ? nullptr : mask_.data(); }
  const riis_vtk_sharing &counts() const { return counts_; }
  bool is_whole() const { return is_whole_; }
  // The box and the moments leave out ghost nodes. A grid has no moments.
  const Box &box() const { return box_; }
  const Moments &moments() const { return moments_; }
  bool has_ids() const { return counts_.has_global_ids != 0; }
  // Returns the global id of a node. Without global ids, returns the node's number in the piece.
  std::int64_t id(std::int64_t node) const { return has_ids() ? ids_[static_cast<std::size_t>(node)] : node; }

  const std::int64_t number;
  MeshFile file;

 private:
  std::uint8_t role(std::int64_t node) const {
    return is_whole_ ? static_cast<std::uint8_t>(RIIS_VTK_NODE_INSIDE) : role_[static_cast<std::size_t>(node)];
  }
  void find_roles();

  const bool is_whole_;
  Box box_ = empty_box();
  Moments moments_;
  std::vector<std::uint8_t> role_, mask_;
  std::vector<std::int64_t> ids_;
  riis_vtk_sharing counts_{};
};

// The numbers of a part of a mesh, such as the pieces of one rank. Nodes that pieces share are counted separately.
struct MeshCounts {
  std::int64_t n_nodes = 0, n_cells = 0, n_volume_cells = 0, n_cells_left_out = 0;
  std::int64_t n_with_nodes = 0, n_with_ids = 0;  // pieces
  double median_edge = 0, n_edge_cells = 0;       // the mean of the pieces' median edges, weighted by cells
  Box box = empty_box();
  Moments moments{};

  void add(const Piece &piece);
  void add(const MeshCounts &other);
};
// Returns the sums over all ranks. Refuses a mesh without nodes, and a mesh in which only some pieces have global ids.
MeshCounts sum_of(const MeshCounts &own, const MeshPieces &mesh);

// Disjoint sets of things, which can be united. At the beginning, each thing is a set of its own.
template <class Thing>
class JoinedSets {
 public:
  // Unites the sets of two things. Returns whether the two sets were different.
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

template <class T>
void sort_unique(std::vector<T> &values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}
// Returns the elements of all ranks in ascending order, and each element only once.
template <class T>
std::vector<T> gathered(const std::vector<T> &own) {
  std::vector<T> all = ranks::gather(own);
  sort_unique(all);
  return all;
}

// An open region of a piece: the number of the piece, and the region's number within the piece.
using PieceRegion = std::array<std::int32_t, 2>;
// Two regions in two pieces that have a common node.
using JoinedRegions = std::array<PieceRegion, 2>;

// A node of one piece that other pieces may also have.
struct SharedNode {
  NodeKey key;
  PieceRegion where;  // the region is -1 if the node is in no open region
};

// Returns the shared nodes of a piece. `regions` has the open region of each node, or is empty.
std::vector<SharedNode> shared_nodes_of(const Piece &piece, const std::vector<std::int64_t> &regions);

// The shared nodes of all pieces, each counted once.
struct MatchedNodes {
  std::int64_t n_nodes = 0, n_in_several = 0;  // all nodes, and the nodes that more than one piece has
  std::vector<JoinedRegions> joined{};

  // Returns by how much the number of separate regions falls when regions are joined.
  std::int64_t n_joins() const;
};

// Finds equal nodes in the pieces of all ranks. `has_ids` says whether the keys contain global ids. A mesh with one global id at
// two places is refused. In messages, `files` are the names of the pieces.
MatchedNodes match_nodes(std::vector<std::vector<SharedNode>> by_piece, bool has_ids,
                         const std::vector<std::string> &files);

// Adds the keys of the loose nodes: the nodes that no cell of their piece uses. A loose node counts if it is inside no other
// piece.
void add_loose_nodes(const Piece &piece, std::vector<NodeKey> &keys);
// Refuses a mesh in which a loose node is inside another piece, because the node would be counted twice. The pieces are read
// again only if there are loose nodes.
void check_loose_nodes(const std::vector<NodeKey> &own, const MeshPieces &mesh);

// Counts nodes of several kinds, such as the marked nodes at each time. Nodes inside a piece are counted when the piece is added.
// Nodes that several pieces share are counted once, at the end.
class NodeCounts {
 public:
  explicit NodeCounts(std::size_t n_kinds) : n_inside_(n_kinds) {}
  void add(const Piece &piece, const riis_mark_list &list, std::size_t kind);
  // For each kind, returns the number of nodes in all pieces of all ranks. Each node counts at most once for a kind.
  std::vector<std::int64_t> sums() const;

 private:
  using SharedKind = std::array<std::uint64_t, 3>;  // the kind and the key of a shared node
  std::vector<std::int64_t> n_inside_;
  std::vector<SharedKind> shared_;
};

}  // namespace riis::program
