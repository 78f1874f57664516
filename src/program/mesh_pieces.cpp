// SPDX-License-Identifier: Apache-2.0
#include "program/mesh_pieces.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "common/array_view.hpp"
#include "program/outputs.hpp"
#include "program/ranks.hpp"
#include "program/text.hpp"

namespace riis::program {

MeshPieces::MeshPieces(const std::string &path) : path_(path) {
  riis_vtk_pieces *list = nullptr;
  check(riis_vtk_pieces_read(path.c_str(), &list));
  list_.reset(list);
  std::int64_t n = 0;
  const char *const *files = nullptr;
  check(riis_vtk_pieces_get_files(list, &n, &files));
  files_.assign(files, files + n);
}

std::vector<std::int64_t> MeshPieces::own() const {
  std::vector<std::int64_t> own;
  for (std::int64_t piece = ranks::rank(); piece < view(files_).size(); piece += ranks::n_ranks()) own.push_back(piece);
  return own;
}

MeshFile MeshPieces::read(std::int64_t piece) const {
  riis_vtk_mesh *mesh = nullptr;
  check(riis_vtk_pieces_read_mesh(list_.get(), piece, &mesh));
  return MeshFile(mesh);
}

void for_own_pieces(const MeshPieces &pieces, const std::function<void(std::int64_t)> &work) {
  try {
    for (const std::int64_t piece : pieces.own()) {
      work(piece);
      release_free_memory();
    }
  } catch (const Refusal &refusal) {
    ranks::agree(&refusal);
  }
}

void MeshPieces::finished(std::int64_t) const {}

bool is_in_pieces(const std::string &mesh) { return has_ending(mesh, ".pvtu"); }

// ---- Nodes ----

namespace {

std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

std::uint64_t hash_of(const double *point, std::uint64_t seed) {
  std::uint64_t hash = seed;
  for (int k = 0; k < 3; ++k) {
    const double x = point[k] + 0.0;  // -0 becomes 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    hash = mixed(hash ^ bits);
  }
  return hash;
}

}  // namespace

PieceNodes::PieceNodes(const riis_vtk_mesh *file, const std::string &path) {
  check(riis_vtk_mesh_get_nodes(file, &n_, nullptr, &xyz_));
  role_.resize(static_cast<std::size_t>(n_));
  riis_status status = riis_vtk_mesh_get_sharing(file, n_, role_.data(), nullptr, &counts_, sizeof counts_);
  if (status == RIIS_FILE_ERROR) throw Refusal{exit_bad_data, path + ": " + riis_last_error()};
  check(status);
  if (has_ids()) {
    ids_.resize(role_.size());
    check(riis_vtk_mesh_get_sharing(file, n_, role_.data(), ids_.data(), &counts_, sizeof counts_));
  }
  if (std::find(role_.begin(), role_.end(), RIIS_VTK_NODE_GHOST) == role_.end()) return;
  mask_.resize(role_.size());
  std::transform(role_.begin(), role_.end(), mask_.begin(),
                 [](std::uint8_t role) { return static_cast<std::uint8_t>(role != RIIS_VTK_NODE_GHOST); });
}

NodeKey PieceNodes::key(std::int64_t node) const {
  const std::uint64_t first = hash_of(point(node), 0x243f6a8885a308d3);
  if (has_ids()) return {static_cast<std::uint64_t>(id(node)), first};
  return {first, hash_of(point(node), 0x13198a2e03707344)};
}

// ---- Matching ----

namespace {

std::vector<SharedNode> in_one_list(std::vector<std::vector<SharedNode>> by_piece) {
  std::size_t n = 0;
  for (const auto &nodes : by_piece) n += nodes.size();
  std::vector<SharedNode> all;
  all.reserve(n);
  for (auto &nodes : by_piece) {
    all.insert(all.end(), nodes.begin(), nodes.end());
    nodes = {};
    release_free_memory();
  }
  return all;
}

template <class T>
void sort_unique(std::vector<T> &values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

MatchedNodes match_nodes(std::vector<std::vector<SharedNode>> by_piece, bool has_ids,
                         const std::vector<std::string> &files) {
  constexpr std::size_t few = 1 << 16;
  const auto n_ranks = static_cast<std::uint64_t>(ranks::n_ranks());
  // Global ids are dense, so they are mixed to share them out evenly.
  std::vector<SharedNode> nodes = ranks::exchange(in_one_list(std::move(by_piece)), [&](const SharedNode &node) {
    return static_cast<std::size_t>(mixed(node.key.a) % n_ranks);
  });
  std::sort(nodes.begin(), nodes.end(), [](const SharedNode &p, const SharedNode &q) {
    return std::tie(p.key, p.piece) < std::tie(q.key, q.piece);
  });
  MatchedNodes own;
  std::size_t n_kept = few;
  for (std::size_t begin = 0, end = 0; begin < nodes.size(); begin = end) {
    const SharedNode &first = nodes[begin];
    bool in_several = false;
    for (end = begin + 1; end < nodes.size() && nodes[end].key == first.key; ++end) {
      const SharedNode &before = nodes[end - 1], &node = nodes[end];
      in_several |= node.piece != before.piece;
      if (node.region < 0 || before.region < 0) continue;
      const PieceRegion p{before.piece, before.region}, q{node.piece, node.region};
      if (!(p == q) && (own.joined.empty() || own.joined.back() != std::pair(p, q))) own.joined.emplace_back(p, q);
    }
    if (has_ids && end < nodes.size() && nodes[end].key.a == first.key.a)
      throw Refusal{exit_bad_data, "the node with the global id " +
                                       std::to_string(static_cast<std::int64_t>(first.key.a)) + " is at one place in " +
                                       view(files)[first.piece] + " and at another in " +
                                       view(files)[nodes[end].piece]};
    ++own.n_nodes;
    own.n_in_several += in_several;
    if (own.joined.size() > 2 * n_kept) {
      sort_unique(own.joined);
      n_kept = std::max(few, own.joined.size());
    }
  }
  sort_unique(own.joined);
  MatchedNodes all;
  const std::vector<std::array<std::int64_t, 2>> counts{{own.n_nodes, own.n_in_several}};
  for (const auto &[n_nodes, n_in_several] : ranks::gather(counts)) {
    all.n_nodes += n_nodes;
    all.n_in_several += n_in_several;
  }
  struct Pair {
    PieceRegion p, q;
  };
  std::vector<Pair> pairs;
  for (const auto &[p, q] : own.joined) pairs.push_back({p, q});
  for (const Pair &pair : ranks::gather(pairs)) all.joined.emplace_back(pair.p, pair.q);
  sort_unique(all.joined);
  return all;
}

void LooseNodes::add(const PieceNodes &nodes) {
  for (std::int64_t i = 0; i < nodes.n(); ++i)
    if (nodes.is_loose(i)) keys_.push_back(nodes.key(i));
}

void LooseNodes::check(const MeshPieces &pieces) const {
  std::vector<NodeKey> keys = ranks::gather(keys_);
  sort_unique(keys);
  if (keys.empty()) return;
  std::int64_t n = 0;
  for_own_pieces(pieces, [&](std::int64_t piece) {
    const MeshFile file = pieces.read(piece);
    const PieceNodes nodes(file.get(), view(pieces.files())[piece]);
    for (std::int64_t i = 0; i < nodes.n(); ++i)
      n += nodes.is_inside(i) && std::binary_search(keys.begin(), keys.end(), nodes.key(i));
  });
  std::int64_t sum = 0;
  for (const std::int64_t part : ranks::gather(std::vector<std::int64_t>{n})) sum += part;
  if (sum > 0)
    throw Refusal{exit_bad_data, pieces.path() + ": " + std::to_string(sum) +
                                     " points are inside one piece, and another piece has them without a cell; "
                                     "write each piece with only the points of its own cells"};
}

void release_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

void NodeCounts::add(const PieceNodes &nodes, const riis_mark_list &list, std::size_t kind) {
  for (std::int64_t i = 0; i < list.n_nodes; ++i) {
    const std::int64_t node = list.node_id[i];
    n_inside_.at(kind) += nodes.is_inside(node);
    if (nodes.is_shared(node)) shared_.push_back({nodes.key(node), kind});
  }
}

std::vector<std::int64_t> NodeCounts::sums() const {
  const auto n_ranks = static_cast<std::uint64_t>(ranks::n_ranks());
  std::vector<SharedKind> shared = ranks::exchange(
      shared_, [&](const SharedKind &node) { return static_cast<std::size_t>(mixed(node.key.a) % n_ranks); });
  sort_unique(shared);
  std::vector<std::int64_t> own = n_inside_, sums(n_inside_.size());
  for (const SharedKind &node : shared) ++own.at(node.kind);
  const std::vector<std::int64_t> all = ranks::gather(own);
  for (std::size_t i = 0; i < all.size(); ++i) sums[i % sums.size()] += all[i];
  return sums;
}

}  // namespace riis::program
