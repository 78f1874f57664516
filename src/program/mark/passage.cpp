// SPDX-License-Identifier: Apache-2.0
#include "program/mark/leaks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/array_view.hpp"
#include "common/band.hpp"
#include "common/first_passage.hpp"
#include "program/base/handles.hpp"
#include "program/base/ranks.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {

namespace {

// Returns the coordinates of a point as the user wrote them.
std::string text_of(const double *point) { return numbers_text(point, 3, " "); }

// Refuses an end that is outside the mesh, and an end without a near node. If no node has a neighbour, `why_none` gives the
// reason.
void check_end(const MarkOptions &options, int end, const std::optional<PieceEnd> &nearest, const std::string &name,
               const Box &box, const std::string &why_none) {
  // A point inside a cell is at most one edge length away from a node of the cell. An end of the passage may be up to two edge
  // lengths away from a node.
  constexpr double edges_away = 2;
  const LeakCheck &asked = *options.check_leaks;
  const double *const point = asked.point(end);
  const auto refuse = [&](const std::string &why) {
    asked.refuse((end == 0 ? "FROM, " : "TO, ") + text_of(point) + ", " + why);
  };
  if (!nearest) refuse("has no node near it: " + (why_none.empty() ? "no edge joins two nodes of the mesh" : why_none));
  for (int k = 0; k < 3; ++k)
    if (point[k] < box.lower[k] || point[k] > box.upper[k])
      refuse("is outside the mesh, which goes from " + place_text(options, box.lower, nearest->longest_edge) + " to " +
             place_text(options, box.upper, nearest->longest_edge));
  if (nearest->distance > edges_away * nearest->longest_edge)
    refuse("is outside the mesh: the nearest node, " + name + ", is " + shown(nearest->distance) +
           " away, its longest edge " + shown(nearest->longest_edge));
}

// --quiet does not silence this warning, because the valve lets flow through.
// An open valve is meant to have a passage, so its warning has no advice.
void warn_of_passage(const MarkOptions &options, const PassageReport &report, const std::string &surface,
                     double opening, const std::string &unknown) {
  const LeakCheck &asked = *options.check_leaks;
  // If the band has an offset, the width of a passage is the half thickness that closes the passage.
  const bool has_offset = options.surface_options.offset != 0;
  const std::string ends = text_of(asked.point(0)) + " and " + text_of(asked.point(1));
  const riis_passage &found = report.found;
  if (report.is_unknown)
    warn("whether unmarked nodes join " + ends + " is unknown: " + unknown);
  else if (found.state == RIIS_PASSAGE_NONE)
    warn("nothing to seal: the mesh itself does not join " + ends);
  if (found.state != RIIS_PASSAGE_OPEN) return;
  const std::string state = opening > 0 ? "the valve is open, at opening " + shown(opening) : surface + " leaks";
  const std::string text = state + ": unmarked nodes join " + ends + "; the passage is ";
  if (report.is_end)
    warn(text + "wide everywhere: no place on it is nearer to " + surface + " than its end at " + report.place + ", " +
         (has_offset ? "which a half thickness of " + shown(found.distance) + " marks"
                     : shown(found.distance) + " from it") +
         ". Either the points are beside " + surface + ", or " + surface +
         " does not stand between the points: give points on both sides, farther away");
  else if (report.closing_half_thickness > 0 && opening == 0)
    warn({{Cause::leaks, text + "at " + report.place,
           ", and --half-thickness " + shortest(report.closing_half_thickness) +
               (report.closing_skirt > 0 ? " or --skirt " + shortest(report.closing_skirt) : "") + " closes it"}});
  else
    warn(text + "at " + report.place + ", " +
         (has_offset ? "and a half thickness of " + shown(found.distance) + " closes it"
                     : shown(found.distance) + " from the surface"));
}

// Finds the widest passage in a whole mesh, by a call of the library.
riis_passage passage_in(const Piece &piece, const MarkOptions &options, const riis_surface *surface,
                        const PieceEnd (&ends)[2]) {
  const riis_mark_options how = how_to_mark_again(options);
  auto sets = defaults<riis_passage_ends>();
  sets.n_from = sets.n_to = 1;
  sets.from = &ends[0].node;
  sets.to = &ends[1].node;
  riis_passage passage;
  const FileNodes::Lent lent(*piece.mesh);
  const riis_status status = riis_find_passage(surface, piece.mesh->mesh(), &sets, &how, &passage, sizeof passage);
  for (const auto &[argument, name] :
       {std::pair<std::string, const char *>{"ends.from[0]", "FROM"}, {"ends.to[0]", "TO"}}) {
    const std::string text = riis_last_error();
    if (status == RIIS_INVALID_ARGUMENT && text.rfind(argument, 0) == 0)
      options.check_leaks->refuse(name + text.substr(argument.size()));
  }
  check(status);
  return passage;
}

}  // namespace

// ---- The widest passage in pieces ----
//
// Each piece is reduced to the ways that join its shared nodes. A node's distance is the least half thickness that marks the
// node. If the band has no offset, the least half thickness is the node's distance from the surface. At first, all nodes beyond a
// limit are open, and their connected regions get labels. The nodes within the limit are then opened one by one, from far to
// near. If a node joins two sets, and each of the two has a shared node or an end, the node becomes a link. A link has the
// distance of its node. Regions of different pieces are joined if they have a common node. Links between regions are opened from
// far to near until the two ends are joined. If the two ends are joined before any link is opened, the limit was too small.

namespace {

// A place in the mesh: a region of a piece beyond the limit, or a node within the limit. If the place is a node, its piece and
// its region are -1.
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

  // Sorts nodes from far to near. If distances are equal, sorts by the id.
  bool operator<(const PassageNode &other) const {
    return distance != other.distance ? distance > other.distance
                                      : std::tie(id, piece) < std::tie(other.id, other.piece);
  }
};

struct Link {
  Place p, q;
  PassageNode node;
};

// The place of an end of the passage in the mesh. For an end within the limit, the place is the node of the end.
struct PlacedEnd {
  std::int64_t end;
  Place place;
  PassageNode node;
};

// Reduces one piece to the ways between its shared nodes.
class PieceWays {
 public:
  PieceWays(const Piece &piece, const riis_mark_list &within, const Band &band, double limit)
      : piece_(piece.number), nodes_(piece.nodes), edges_(*piece.mesh), sets_(nodes_.n()) {
    const PieceNodes &nodes = piece.nodes;
    resize(distance_, nodes.n());
    std::fill(distance_.begin(), distance_.end(), std::numeric_limits<double>::infinity());
    for (std::int64_t i = 0; i < within.n_nodes; ++i) {
      const std::int64_t node = within.node_id[i];
      const double distance = band.marking_thickness(within.distance[i], within.height ? within.height[i] : 0);
      if (!(distance <= limit)) continue;
      view(distance_)[node] = distance;
      near_.push_back(node);
    }
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
    std::copy_n(nodes_.point(node).data(), 3, made.point);
    return made;
  }

  void add_links(std::vector<Link> &links) {
    std::sort(near_.begin(), near_.end(), [&](std::int64_t a, std::int64_t b) {
      const double p = view(distance_)[a], q = view(distance_)[b];
      return p != q ? p > q : nodes_.id(a) < nodes_.id(b);
    });
    for (const std::int64_t node : near_) {
      if (nodes_.is_ghost(node)) continue;
      view(is_open_)[node] = 1;
      edges_.for_each_neighbor(node, [&](std::int64_t other) {
        if (view(is_open_)[other]) unite(node, other, node, links);
      });
    }
  }

  // For each node, returns its region beyond the limit, or -1.
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
  std::vector<double> distance_;    // infinite beyond the limit
  std::vector<std::int64_t> near_;  // the nodes within the limit
  std::vector<std::uint8_t> is_open_;
  std::vector<std::int32_t> region_;    // the root of the node's region beyond the limit, or -1
  std::vector<std::int64_t> terminal_;  // of a set's root: a shared node or an end in the set, or -1
};

PassageReport passage_at(const PassageNode &node, double half_thickness, const PieceEnd (&ends)[2]) {
  PassageReport passage{{node.id, node.distance, {0, 0, 0}, 0, RIIS_PASSAGE_CLOSED, 0}};
  std::copy_n(node.point, 3, passage.found.point);
  if (node.distance > half_thickness) passage.found.state = RIIS_PASSAGE_OPEN;
  for (const PieceEnd &end : ends) passage.is_end |= end.key == node.key;
  return passage;
}

// Refuses an end of the passage that lies in the band.
void check_end_is_open(const MarkOptions &options, const MeshPieces &mesh, const PieceEnd (&ends)[2],
                       const PlacedEnd &placed, double half_thickness) {
  if (placed.node.distance > half_thickness) return;
  const PieceEnd &end = ends[placed.end];
  options.check_leaks->refuse(
      (placed.end == 0 ? "FROM is node " : "TO is node ") + std::to_string(end.id) + " of " +
      view(mesh.files())[end.piece] + ", in the band: " +
      (options.surface_options.offset == 0 ? "its distance to the surface, " : "the half thickness that marks it, ") +
      shortest(placed.node.distance) + ", is at most the half thickness, " + shortest(half_thickness));
}

// Returns nothing if the passage is wider than the given limit.
std::optional<PassageReport> passage_within(const MarkOptions &options, const MeshPieces &mesh,
                                            const riis_surface *surface, const Band &band, const PieceEnd (&ends)[2],
                                            double limit) {
  const riis_mark_options how = how_to_mark_again(options, band.with(limit).reach());
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
    PieceWays ways(piece, within, band, limit);
    for (int i = 0; i < 2; ++i) {
      if (ends[i].piece != piece.number) continue;
      ways.add_terminal(ends[i].node);
      own_ends.push_back({i, ways.place_of(ends[i].node), ways.passage_node(ends[i].node)});
    }
    shared.push_back(shared_nodes_of(piece, ways.regions()));
    ways.add_links(own_links);
  });
  std::vector<PlacedEnd> placed = ranks::gather(own_ends);
  std::sort(placed.begin(), placed.end(), [](const PlacedEnd &a, const PlacedEnd &b) { return a.end < b.end; });
  const MatchedNodes matched = match_nodes(std::move(shared), ranks::sum(has_ids) > 0, mesh.files());
  std::vector<Link> links = ranks::gather(own_links);
  std::sort(links.begin(), links.end(), [](const Link &a, const Link &b) { return a.node < b.node; });
  for (const PlacedEnd &end : placed) check_end_is_open(options, mesh, ends, end, band.half_thickness);
  JoinedSets<Place> ways;
  const auto are_joined = [&] { return ways.are_joined(placed[0].place, placed[1].place); };
  for (const auto &[p, q] : matched.joined) ways.unite({p, {0, 0}}, {q, {0, 0}});
  if (are_joined()) {
    // Both ends are the same node, or a path of nodes beyond the limit joins the ends.
    if (placed[0].place.is_region()) return std::nullopt;
    return passage_at(placed[0].node, band.half_thickness, ends);
  }
  for (const Link &link : links) {
    ways.unite(link.p, link.q);
    if (are_joined()) return passage_at(link.node, band.half_thickness, ends);
  }
  return PassageReport{{-1, 0, {0, 0, 0}, 0, RIIS_PASSAGE_NONE, 0}};
}

// Finds the widest passage in a mesh in pieces, as riis_find_passage does in a whole mesh.
PassageReport find_passage(const MarkOptions &options, const MeshPieces &mesh, const riis_surface *surface,
                           const PieceEnd (&ends)[2]) {
  const riis_surface_info info = info_of(surface);
  // An upper limit of the widths of passages: a band with this half thickness contains the two ends of every path.
  double farthest = 0;
  for (const PieceEnd &end : ends)
    for (int k = 0; k < 3; ++k)
      farthest = std::max({farthest, std::abs(end.point[k] - info.lower[k]), std::abs(end.point[k] - info.upper[k])});
  farthest = std::max(2 * farthest / (1 - std::abs(info.offset)), 2 * info.half_thickness);
  double growth = 2;
  for (double limit = 2 * info.half_thickness;; limit = std::min(limit * growth, farthest)) {
    if (const auto found = passage_within(options, mesh, surface, {info.half_thickness, info.offset}, ends, limit))
      return *found;
    growth *= growth;
  }
}

}  // namespace

void PassageCheck::add(const Piece &piece) {
  if (!options_.check_leaks) return;
  const PieceNodes &nodes = piece.nodes;
  for (int end = 0; end < 2; ++end) {
    const double *const asked = options_.check_leaks->point(end);
    std::int64_t found = -1;
    double least = 0;
    for (std::int64_t i = 0; i < nodes.n(); ++i) {
      const double away = distance_between(nodes.point(i).data(), asked);
      if (nodes.is_ghost(i) || (found >= 0 && !(away < least)) || piece.mesh->longest_edge(i) == 0) continue;
      found = i;
      least = away;
    }
    if (found < 0) continue;
    PieceEnd made{nodes.key(found), {0, 0, 0}, least,          piece.mesh->longest_edge(found),
                  piece.number,     found,     nodes.id(found)};
    std::copy_n(nodes.point(found).data(), 3, made.point);
    found_ends_[end].push_back(made);
  }
}

std::optional<PieceEnd> PassageCheck::nearest(int end, bool has_ids) const {
  std::optional<PieceEnd> best;
  const std::vector<PieceEnd> all = ranks::gather(found_ends_[end]);
  const auto order = [&](const PieceEnd &node) {
    return std::tuple(node.distance, has_ids ? node.id : 0, node.piece, node.id);
  };
  for (const PieceEnd &node : all)
    if (!best || order(node) < order(*best)) best = node;
  for (const PieceEnd &node : all)
    if (best->key == node.key) best->longest_edge = std::max(best->longest_edge, node.longest_edge);
  return best;
}

PassageReport PassageCheck::find(const riis_surface *surface) const {
  if (!mesh_.is_whole()) return find_passage(options_, mesh_, surface, ends_);
  PassageReport passage;
  mesh_.for_each_own([&](const Piece &piece) { passage.found = passage_in(piece, options_, surface, ends_); });
  for (const PieceEnd &end : ends_) passage.is_end |= end.node == passage.found.node_id;
  return passage;
}

double PassageCheck::longest_edge_at(const riis_passage &found, const MeshCounts &counts) const {
  double longest = counts.median_edge;
  if (mesh_.is_whole())
    mesh_.for_each_own([&](const Piece &piece) { longest = piece.mesh->longest_edge(found.node_id); });
  return longest;
}

riis_first_passage PassageCheck::first_of(const riis_valve *valve) const {
  const Valve moved = copy_of(valve);
  return first_passage(defaults<riis_first_passage_options>().tolerance, [&](double opening) {
    check(riis_valve_set_scalar(moved, "opening", opening), "--first-passage");
    return find(create_for<Surface>("--first-passage", riis_surface_create, moved, &options_.surface_options)).found;
  });
}

void PassageCheck::judge(const riis_surface *surface, const riis_valve *valve, const std::string &name,
                         const MeshCounts &counts, Report &report) {
  if (!options_.check_leaks) return;
  const std::string unknown = why_unknown(report.valves[0].leaks, options_.mesh);
  for (int end = 0; end < 2; ++end) {
    const std::optional<PieceEnd> found = nearest(end, counts.n_with_ids > 0);
    std::string node = found ? std::to_string(found->id) : "";
    if (found && counts.n_with_ids == 0 && !mesh_.is_whole()) node += " of " + view(mesh_.files())[found->piece];
    check_end(options_, end, found, node, counts.box, unknown);
    ends_[end] = *found;
  }
  PassageReport passage = find(surface);
  const riis_passage &found = passage.found;
  // Unknown edges cannot close an open path, but they may make a path that the known edges do not have.
  passage.is_unknown = found.state != RIIS_PASSAGE_OPEN && !unknown.empty();
  if (found.state == RIIS_PASSAGE_OPEN && !passage.is_end && unknown.empty()) {
    passage.closing_half_thickness = closing_half_thickness(valve, found.distance, [&](double wanted) {
      const riis_passage left = find(with_half_thickness(options_, valve, wanted).get()).found;
      return left.state == RIIS_PASSAGE_CLOSED ? std::nullopt : std::optional(left.distance);
    });
    passage.closing_skirt =
        closing_skirt(options_, surface, passage.closing_half_thickness,
                      [&](const riis_surface *with) { return find(with).found.state == RIIS_PASSAGE_CLOSED; });
  }
  if (found.node_id >= 0) passage.place = place_text(options_, found.point, longest_edge_at(found, counts));
  warn_of_passage(options_, passage, name, valve ? opening_of(valve) : 0, unknown);
  report.passage = passage;
  if (options_.first_passage && unknown.empty()) report.valves[0].flow.first = first_of(valve);
}

}  // namespace riis::program
