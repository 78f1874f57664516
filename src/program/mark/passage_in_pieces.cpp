// SPDX-License-Identifier: Apache-2.0
// Finds the widest passage in a mesh in pieces. Each piece is reduced to the ways between its shared nodes. All nodes beyond a
// limit are open at first, and their connected regions are labelled. Then the nearer nodes open one by one, from far to near. A
// node that joins two sets, each with a shared node or an end, is a link with the node's distance. Regions with a common node
// are joined. Links are then opened from far to near, until both ends are joined. If the ends are joined before any link
// opens, the limit was too small.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/array_view.hpp"
#include "program/base/ranks.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/mark/leaks.hpp"
#include "program/mark/mesh_marking.hpp"

namespace riis::program {
namespace {

// A region of a piece beyond the limit, or a node within the limit. A node's piece and region are -1.
struct Place {
  PieceRegion region;
  NodeKey key;
  bool is_region() const { return region.piece >= 0; }
  bool operator<(const Place &other) const { return std::tie(region, key) < std::tie(other.region, other.key); }
};

struct PassageNode {
  double distance, point[3];
  std::int64_t id, piece;
  NodeKey key;

  // Puts the farthest node first and, among equal distances, the lowest id first.
  bool operator<(const PassageNode &other) const {
    return distance != other.distance ? distance > other.distance
                                      : std::tie(id, piece) < std::tie(other.id, other.piece);
  }
};

struct Link {
  Place p, q;
  PassageNode node;
};

// The place of an end, and its node if it is within the limit.
struct PlacedEnd {
  std::int64_t end;
  Place place;
  PassageNode node;
};

// Reduces one piece.
class PieceWays {
 public:
  PieceWays(const Piece &piece, const riis_mark_list &within)
      : piece_(piece.number), nodes_(piece.nodes), edges_(*piece.mesh), sets_(nodes_.n()) {
    const PieceNodes &nodes = piece.nodes;
    resize(distance_, nodes.n());
    std::fill(distance_.begin(), distance_.end(), std::numeric_limits<double>::infinity());
    for (std::int64_t i = 0; i < within.n_nodes; ++i) view(distance_)[within.node_id[i]] = within.distance[i];
    resize(is_open_, nodes.n());
    for (std::int64_t i = 0; i < nodes.n(); ++i) view(is_open_)[i] = is_far(i) && !nodes.is_ghost(i);
    for (std::int64_t i = 0; i < nodes.n(); ++i) {
      if (!view(is_open_)[i]) continue;
      edges_.for_each_neighbor(i, [&](std::int64_t j) {
        if (j < i && view(is_open_)[j]) sets_.unite(i, j);
      });
    }
    resize(region_, nodes.n());
    resize(terminal_, nodes.n());
    std::fill(terminal_.begin(), terminal_.end(), -1);
    for (std::int64_t i = 0; i < nodes.n(); ++i) {
      view(region_)[i] = view(is_open_)[i] ? static_cast<std::int32_t>(sets_.root(i)) : -1;
      if (nodes.is_shared(i)) add_terminal(i);
    }
  }

  void add_terminal(std::int64_t node) {
    if (is_far(node))
      view(terminal_)[sets_.root(node)] = node;
    else
      view(terminal_)[node] = node;
  }

  Place place_of(std::int64_t node) const {
    if (is_far(node)) return {{static_cast<std::int32_t>(piece_), view(region_)[node]}, {0, 0}};
    return {{-1, -1}, nodes_.key(node)};
  }

  PassageNode passage_node(std::int64_t node) const {
    PassageNode made{view(distance_)[node], {0, 0, 0}, nodes_.id(node), piece_, nodes_.key(node)};
    std::copy_n(nodes_.point(node), 3, made.point);
    return made;
  }

  void add_links(const riis_mark_list &within, std::vector<Link> &links) {
    std::vector<std::int64_t> order(within.node_id, within.node_id + within.n_nodes);
    std::sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) {
      const double p = view(distance_)[a], q = view(distance_)[b];
      return p != q ? p > q : nodes_.id(a) < nodes_.id(b);
    });
    for (const std::int64_t node : order) {
      if (nodes_.is_ghost(node)) continue;
      view(is_open_)[node] = 1;
      edges_.for_each_neighbor(node, [&](std::int64_t other) {
        if (view(is_open_)[other]) unite(node, other, node, links);
      });
    }
  }

  // Returns the region beyond the limit of each node, or -1.
  std::vector<std::int64_t> regions() const { return {region_.begin(), region_.end()}; }

 private:
  bool is_far(std::int64_t node) const { return std::isinf(view(distance_)[node]); }

  void unite(std::int64_t a, std::int64_t b, std::int64_t node, std::vector<Link> &links) {
    const std::int64_t p = view(terminal_)[sets_.root(a)], q = view(terminal_)[sets_.root(b)];
    if (!sets_.unite(a, b)) return;
    if (p >= 0 && q >= 0) links.push_back({place_of(p), place_of(q), passage_node(node)});
    view(terminal_)[sets_.root(a)] = p >= 0 ? p : q;
  }

  std::int64_t piece_;
  const PieceNodes &nodes_;
  const FileNodes &edges_;
  DisjointSets sets_;
  std::vector<double> distance_;  // infinite beyond the limit
  std::vector<std::uint8_t> is_open_;
  std::vector<std::int32_t> region_;    // the root of the node's region beyond the limit, or -1
  std::vector<std::int64_t> terminal_;  // of a set's root: a shared node or an end in the set, or -1
};

FoundPassage passage_at(const PassageNode &node, double half_thickness, const PieceEnd (&ends)[2]) {
  FoundPassage passage{{node.id, node.distance, {0, 0, 0}, 0, RIIS_PASSAGE_CLOSED, 0}, false};
  std::copy_n(node.point, 3, passage.found.point);
  if (node.distance > half_thickness) passage.found.state = RIIS_PASSAGE_OPEN;
  for (const PieceEnd &end : ends) passage.is_end |= end.key == node.key;
  return passage;
}

// Refuses an end in the band.
void check_end_is_open(const MarkOptions &options, const MeshPieces &mesh, const PieceEnd (&ends)[2],
                       const PlacedEnd &placed, double half_thickness) {
  if (placed.node.distance > half_thickness) return;
  const PieceEnd &end = ends[placed.end];
  throw Refusal{options.check_leaks->exit_code,
                options.check_leaks->subject + ": " + (placed.end == 0 ? "FROM" : "TO") + " is node " +
                    std::to_string(end.id) + " of " + view(mesh.files())[end.piece] +
                    ", in the band: its distance to the surface, " + shortest(placed.node.distance) +
                    ", is at most the half thickness, " + shortest(half_thickness)};
}

// Returns nothing if the passage is wider than the limit.
std::optional<FoundPassage> passage_within(const MarkOptions &options, const MeshPieces &mesh,
                                           const riis_surface *surface, const PieceEnd (&ends)[2], double limit,
                                           double half_thickness) {
  const riis_mark_options how = how_to_mark_again(options, limit);
  std::vector<Link> own_links;
  std::vector<PlacedEnd> own_ends;
  std::vector<std::vector<SharedNode>> shared;
  int has_ids = 0;
  mesh.for_each_own([&](Piece &piece) {
    if (!piece.mesh) return;
    has_ids = piece.nodes.has_ids();
    piece.mesh->find_neighbors(how.n_threads);
    const Marks marks = marks_of(surface, piece.mesh->mesh(), how);
    const riis_mark_list within = list_of(marks, RIIS_LIST_WITHIN_LIMIT);
    PieceWays ways(piece, within);
    for (int i = 0; i < 2; ++i) {
      if (ends[i].piece != piece.number) continue;
      ways.add_terminal(ends[i].node);
      own_ends.push_back({i, ways.place_of(ends[i].node), ways.passage_node(ends[i].node)});
    }
    shared.push_back(shared_nodes_of(piece, ways.regions()));
    ways.add_links(within, own_links);
  });
  std::vector<PlacedEnd> placed = ranks::gather(own_ends);
  std::sort(placed.begin(), placed.end(), [](const PlacedEnd &a, const PlacedEnd &b) { return a.end < b.end; });
  const MatchedNodes matched = match_nodes(std::move(shared), ranks::sum(has_ids) > 0, mesh.files());
  std::vector<Link> links = ranks::gather(own_links);
  std::sort(links.begin(), links.end(), [](const Link &a, const Link &b) { return a.node < b.node; });
  for (const PlacedEnd &end : placed) check_end_is_open(options, mesh, ends, end, half_thickness);
  JoinedSets<Place> ways;
  const auto are_joined = [&] { return ways.are_joined(placed[0].place, placed[1].place); };
  for (const auto &[p, q] : matched.joined) ways.unite({p, {0, 0}}, {q, {0, 0}});
  if (are_joined()) {
    // The ends are one node, or there is a way beyond the limit.
    if (placed[0].place.is_region()) return std::nullopt;
    return passage_at(placed[0].node, half_thickness, ends);
  }
  for (const Link &link : links) {
    ways.unite(link.p, link.q);
    if (are_joined()) return passage_at(link.node, half_thickness, ends);
  }
  return FoundPassage{{-1, 0, {0, 0, 0}, 0, RIIS_PASSAGE_NONE, 0}, false};
}

}  // namespace

FoundPassage find_passage(const MarkOptions &options, const MeshPieces &mesh, const riis_surface *surface,
                          const PieceEnd (&ends)[2]) {
  const riis_surface_info info = info_of(surface);
  if (info.offset != 0)
    throw Refusal{options.check_leaks->exit_code,
                  options.check_leaks->subject + ": a passage in a mesh in pieces needs the offset 0"};
  // A path comes at least as near to the surface as its ends, which are nearer than this.
  double farthest = 0;
  for (const PieceEnd &end : ends)
    for (int k = 0; k < 3; ++k)
      farthest = std::max({farthest, std::abs(end.point[k] - info.lower[k]), std::abs(end.point[k] - info.upper[k])});
  farthest = std::max(2 * farthest, 2 * info.half_thickness);
  double growth = 2;
  for (double limit = 2 * info.half_thickness;; limit = std::min(limit * growth, farthest)) {
    if (const auto found = passage_within(options, mesh, surface, ends, limit, info.half_thickness)) return *found;
    growth *= growth;
  }
}

}  // namespace riis::program
