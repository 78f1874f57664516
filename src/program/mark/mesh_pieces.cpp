// SPDX-License-Identifier: Apache-2.0
#include "program/mark/mesh_pieces.hpp"

#include <algorithm>
#include <cstring>
#include <set>
#include <tuple>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "common/array_view.hpp"
#include "common/vectors.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {
namespace {

// Returns this process's free memory to the system. Without this call, the freed memory of large pieces would remain between the
// shared nodes.
void release_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

std::uint64_t hash_of(const FileNodes::Point &point, std::uint64_t seed) {
  std::uint64_t hash = seed;
  for (int k = 0; k < 3; ++k) {
    const double x = view(point)[k] + 0.0;  // -0 becomes 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    hash = mixed(hash ^ bits);
  }
  return hash;
}

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

// Distributes nodes among the ranks by `id`, the first part of a node's key. Global ids are dense, so a hash of the id chooses
// the rank, and the ranks get about equal numbers of nodes.
template <class Node, class Id>
std::vector<Node> shared_out(std::vector<Node> nodes, const Id &id) {
  const auto n_ranks = static_cast<std::uint64_t>(ranks::n_ranks());
  return ranks::exchange(std::move(nodes), [&](const Node &node) { return mixed(id(node)) % n_ranks; });
}

}  // namespace

double distance_between(const double *p, const double *q) { return hypotenuse(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

FileNodes::FileNodes(const riis_vtk_mesh *file, std::string path)
    : file_(file), path_(std::move(path)), axes_(get<riis_grid>(riis_vtk_mesh_get_axes, file)) {
  check(riis_vtk_mesh_get_nodes(file, &n_, nullptr, is_grid() ? nullptr : &xyz_));
  std::size_t axis = 0;
  for (const void *const x : {axes_.x, axes_.y, axes_.z}) x_[axis++] = static_cast<const double *>(x);
  mesh_ = is_grid() ? create_for<Mesh>(path_, riis_mesh_create_grid, &axes_)
                    : create_for<Mesh>(path_, riis_mesh_create, n_, xyz_, xyz_ + 1, xyz_ + 2, 3);
}

void FileNodes::find_neighbors(std::int32_t n_threads) {
  if (neighbors_ || is_grid()) return;
  neighbors_ = create_for<Adjacency>(path_, riis_vtk_mesh_create_adjacency, file_, n_threads);
  rows_ = get<riis_csr>(riis_adjacency_get_csr, neighbors_);
  lend_neighbors(nullptr);
}

void FileNodes::release() {
  mesh_.reset();
  neighbors_.reset();
}

void FileNodes::lend_neighbors(const riis_csr *rows) {
  if (!is_grid()) check(riis_mesh_set_adjacency(mesh_, rows ? rows : neighbors_ ? &rows_ : nullptr), path_);
}

double FileNodes::longest_edge(std::int64_t node) const {
  double longest = 0;
  for_each_neighbor(node, [&](std::int64_t other) { longest = std::max(longest, norm(point(node) - point(other))); });
  return longest;
}

bool is_in_pieces(const std::string &mesh) { return has_ending(mesh, ".pvtu"); }

MeshPieces::MeshPieces(const MarkOptions &options) : options_(options), is_whole_(!is_in_pieces(options.mesh)) {
  if (is_whole_) {
    files_.push_back(options.mesh);
    return;
  }
  list_ = create<PieceList>(riis_vtk_pieces_read, path().c_str());
  std::int64_t n = 0;
  const char *const *files = nullptr;
  check(riis_vtk_pieces_get_files(list_, &n, &files));
  files_.assign(files, files + n);
}

MeshPieces::~MeshPieces() = default;

MeshFile MeshPieces::read(std::int64_t piece) const {
  MeshFile mesh =
      is_whole_ ? read_mesh_file(path(), cells_where()) : create<MeshFile>(riis_vtk_pieces_read_mesh, list_, piece);
  std::int64_t n_chosen = 0;  // a piece may have no cell of the chosen ones
  if (!is_whole_ && !cells_where().empty()) check(riis_vtk_mesh_choose_cells(mesh, cells_where().c_str(), &n_chosen));
  if (cells_where().empty() && regions_.empty()) regions_ = text_of_regions(path(), mesh.get());
  if (options_.at_cells) check(riis_vtk_mesh_use_centers(mesh), path());
  return mesh;
}

void MeshPieces::warn_of_regions() const {
  std::vector<char> own(regions_.begin(), regions_.end());
  if (!own.empty()) own.push_back('\n');
  const std::vector<char> all = ranks::gather(own);
  if (!all.empty()) warn(std::string(all.begin(), std::find(all.begin(), all.end(), '\n')));
}

void MeshPieces::for_each_own(const std::function<void(Piece &)> &work, Seconds *seconds,
                              const std::function<bool(std::int64_t)> &is_wanted) const {
  const auto read_piece = [&](std::int64_t number) {
    const std::string &file_path = view(files_)[number];
    const Stage stage("reading " + file_path, options_.quiet);
    MeshFile file = read(number);
    const double reading = stage.seconds();
    auto piece = std::make_unique<Piece>(number, std::move(file), file_path, options_);
    if (seconds) {
      seconds->read += reading;
      seconds->mesh += stage.seconds() - reading;
    }
    return piece;
  };
  try {
    for (std::int64_t number = ranks::rank(); number < view(files_).size(); number += ranks::n_ranks()) {
      if (is_wanted && !is_wanted(number)) continue;
      if (is_whole_) {
        if (!held_) held_ = read_piece(number);
        work(*held_);
        continue;
      }
      work(*read_piece(number));
      if (seconds) finished(number);
      release_free_memory();
    }
  } catch (const Refusal &refusal) {
    if (ranks::n_ranks() > 1) ranks::agree(&refusal);
    throw;
  }
}

// ---- Nodes ----

Piece::Piece(std::int64_t the_number, MeshFile the_file, const std::string &path, const MarkOptions &how)
    : FileNodes(the_file, path), number(the_number), file(std::move(the_file)), is_whole_(!is_in_pieces(how.mesh)) {
  check(riis_vtk_mesh_get_nodes(file, nullptr, &counts_.n_cells, nullptr));
  if (is_whole_) {
    // The neighbours of all centres are known.
    std::int64_t *const n_left_out = how.at_cells ? nullptr : &counts_.n_cells_left_out;
    check(riis_vtk_mesh_get_volume_cells(file, &counts_.n_volume_cells, n_left_out));
  } else {
    find_roles();
  }
  // Of a grid, two opposite nodes give the box, and the box gives the size.
  for (std::int64_t i = 0; i < n(); i += is_grid() ? std::max<std::int64_t>(n() - 1, 1) : 1) {
    if (is_ghost(i)) continue;
    const FileNodes::Point here = point(i);
    box_.grow(here.data());
    if (!is_grid()) moments_.add(here.data());
  }
}

void Piece::find_roles() {
  role_.resize(static_cast<std::size_t>(n()));
  const riis_status status = riis_vtk_mesh_get_sharing(file, n(), role_.data(), nullptr, &counts_, sizeof counts_);
  if (status == RIIS_FILE_ERROR) refuse_data(path() + ": " + riis_last_error());
  check(status);
  if (has_ids()) {
    ids_.resize(role_.size());
    check(riis_vtk_mesh_get_sharing(file, n(), role_.data(), ids_.data(), &counts_, sizeof counts_));
  }
  if (std::find(role_.begin(), role_.end(), RIIS_VTK_NODE_GHOST) == role_.end()) return;
  for (const std::uint8_t role : role_) mask_.push_back(role != RIIS_VTK_NODE_GHOST);
}

NodeKey Piece::key(std::int64_t node) const {
  if (is_whole_) return {static_cast<std::uint64_t>(node), 0};
  const std::uint64_t first = hash_of(point(node), 0x243f6a8885a308d3);
  if (has_ids()) return {static_cast<std::uint64_t>(id(node)), first};
  return {first, hash_of(point(node), 0x13198a2e03707344)};
}

// ---- Counts ----

void MeshCounts::add(const Piece &piece) {
  const riis_vtk_sharing &cells = piece.counts();
  const bool has_nodes = piece.n() > 0;
  MeshCounts own{
      0, cells.n_cells, cells.n_volume_cells, cells.n_cells_left_out, has_nodes, has_nodes && piece.has_ids(), 0,
      0, piece.box(),   piece.moments()};
  for (std::int64_t i = 0; i < piece.n(); ++i) own.n_nodes += piece.is_inside(i);
  if (has_nodes) check(riis_vtk_mesh_get_median_edge(piece.file, &own.median_edge));
  if (own.median_edge > 0) own.n_edge_cells = static_cast<double>(cells.n_cells);
  add(own);
}

void MeshCounts::add(const MeshCounts &other) {
  n_nodes += other.n_nodes;
  n_cells += other.n_cells;
  n_volume_cells += other.n_volume_cells;
  n_cells_left_out += other.n_cells_left_out;
  n_with_nodes += other.n_with_nodes;
  n_with_ids += other.n_with_ids;
  box.grow(other.box);
  moments.add(other.moments);
  if (other.n_edge_cells == 0) return;
  n_edge_cells += other.n_edge_cells;
  median_edge += (other.median_edge - median_edge) * (other.n_edge_cells / n_edge_cells);
}

MeshCounts sum_of(const MeshCounts &own, const MeshPieces &mesh) {
  MeshCounts all;
  for (const MeshCounts &counts : ranks::gather(std::vector<MeshCounts>{own})) all.add(counts);
  if (all.n_with_nodes == 0 && !mesh.cells_where().empty())
    refuse_usage("--cells-where: no cell of " + mesh.path() + " has " + mesh.cells_where());
  if (all.n_with_nodes == 0) refuse_data(mesh.path() + ": no piece holds points");
  if (all.n_with_ids != 0 && all.n_with_ids != all.n_with_nodes)
    refuse_data(mesh.path() + ": " + std::to_string(all.n_with_ids) + " of " + std::to_string(all.n_with_nodes) +
                " pieces have global ids; all or none must have them");
  return all;
}

// ---- Matching ----

std::vector<SharedNode> shared_nodes_of(const Piece &piece, const std::vector<std::int64_t> &regions) {
  std::vector<SharedNode> shared;
  if (piece.is_whole()) return shared;
  std::int64_t n_shared = 0;
  for (std::int64_t i = 0; i < piece.n(); ++i) n_shared += piece.is_shared(i);
  shared.reserve(static_cast<std::size_t>(n_shared));
  for (std::int64_t i = 0; i < piece.n(); ++i) {
    const std::int64_t region = regions.empty() ? -1 : view(regions)[i];
    if (piece.is_shared(i))
      shared.push_back({piece.key(i), {static_cast<std::int32_t>(piece.number), static_cast<std::int32_t>(region)}});
  }
  return shared;
}

MatchedNodes match_nodes(std::vector<std::vector<SharedNode>> by_piece, bool has_ids,
                         const std::vector<std::string> &files) {
  std::vector<SharedNode> nodes =
      shared_out(in_one_list(std::move(by_piece)), [](const SharedNode &node) { return node.key[0]; });
  std::sort(nodes.begin(), nodes.end(), [](const SharedNode &p, const SharedNode &q) {
    return std::tie(p.key, p.where) < std::tie(q.key, q.where);
  });
  std::int64_t n_nodes = 0, n_in_several = 0;
  std::set<JoinedRegions> joined;
  for (std::size_t begin = 0, end = 0; begin < nodes.size(); begin = end) {
    const SharedNode &first = nodes[begin];
    bool is_in_several = false;
    for (end = begin + 1; end < nodes.size() && nodes[end].key == first.key; ++end) {
      const PieceRegion &p = nodes[end - 1].where, &q = nodes[end].where;
      is_in_several |= p[0] != q[0];
      if (p[1] >= 0 && q[1] >= 0 && p != q) joined.insert({p, q});
    }
    if (has_ids && end < nodes.size() && nodes[end].key[0] == first.key[0])
      refuse_data(
          "the node with the global id " + std::to_string(static_cast<std::int64_t>(first.key[0])) +
          " is at one place in " + view(files)[first.where[0]] + " and at another in " +
          view(files)[nodes[end].where[0]] +
          "; on each rank, dolfinx writes the nodes of a function with other last digits: use VTKFile.write_mesh");
    ++n_nodes;
    n_in_several += is_in_several;
  }
  return {ranks::sum(n_nodes), ranks::sum(n_in_several), gathered(std::vector(joined.begin(), joined.end()))};
}

std::int64_t MatchedNodes::n_joins() const {
  JoinedSets<PieceRegion> sets;
  std::int64_t n = 0;
  for (const auto &[p, q] : joined) n += sets.unite(p, q);
  return n;
}

void add_loose_nodes(const Piece &piece, std::vector<NodeKey> &keys) {
  if (piece.is_whole()) return;
  for (std::int64_t i = 0; i < piece.n(); ++i)
    if (piece.is_loose(i)) keys.push_back(piece.key(i));
}

void check_loose_nodes(const std::vector<NodeKey> &own, const MeshPieces &mesh) {
  const std::vector<NodeKey> keys = gathered(own);
  if (keys.empty()) return;
  std::int64_t n = 0;
  mesh.for_each_own([&](const Piece &piece) {
    for (std::int64_t i = 0; i < piece.n(); ++i)
      n += piece.is_inside(i) && std::binary_search(keys.begin(), keys.end(), piece.key(i));
  });
  const std::int64_t sum = ranks::sum(n);
  if (sum > 0)
    refuse_data(mesh.path() + ": " + std::to_string(sum) +
                " points are inside one piece, and in another piece they have no cell; write each piece with only the "
                "points of its own cells");
}

void NodeCounts::add(const Piece &piece, const riis_mark_list &list, std::size_t kind) {
  for (std::int64_t i = 0; i < list.n_nodes; ++i) {
    const std::int64_t node = list.node_id[i];
    n_inside_.at(kind) += piece.is_inside(node);
    if (piece.is_shared(node)) shared_.push_back({kind, piece.key(node)[0], piece.key(node)[1]});
  }
}

std::vector<std::int64_t> NodeCounts::sums() const {
  std::vector<SharedKind> shared = shared_out(shared_, [](const SharedKind &node) { return node[1]; });
  sort_unique(shared);
  std::vector<std::int64_t> own = n_inside_, sums(n_inside_.size());
  for (const SharedKind &node : shared) ++own.at(node[0]);
  const std::vector<std::int64_t> all = ranks::gather(own);
  for (std::size_t i = 0; i < all.size(); ++i) sums[i % sums.size()] += all[i];
  return sums;
}

}  // namespace riis::program
