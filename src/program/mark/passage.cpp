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

[[noreturn]] void refuse_end(const MarkOptions &options, int end, const std::string &why) {
  const LeakCheck &asked = *options.check_leaks;
  asked.refuse((end == 0 ? "FROM, " : "TO, ") + numbers_text(asked.point(end), 3, " ") + ", " + why);
}

// --quiet does not silence this warning, because the valve lets flow through.
// An open valve is meant to have a passage, so its warning has no advice.
void warn_of_passage(const MarkOptions &options, const PassageReport &report, const std::string &surface,
                     double opening, const std::string &unknown) {
  // If the band has an offset, the width of a passage is the half thickness that closes the passage.
  const bool has_offset = options.surface_options.offset != 0;
  const std::string ends = numbers_text(options.check_leaks->point(0), 3, " ") + " and " +
                           numbers_text(options.check_leaks->point(1), 3, " ");
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
  else if (report.closing.half_thickness > 0 && opening == 0)
    warn({{Cause::leaks, text + "at " + report.place, ", and " + text_of(report.closing) + "it"}});
  else
    warn(text + "at " + report.place + ", " +
         (has_offset ? "and a half thickness of " + shown(found.distance) + " closes it"
                     : shown(found.distance) + " from the surface"));
}

PassageNode node_of(const Piece &piece, std::int64_t node, double distance) {
  return {piece.key(node), piece.number, node, piece.id(node), piece.point(node), distance};
}

// ---- The widest passage in pieces ----
//
// Each piece is reduced to the ways that join its shared nodes. A node's distance is the least half thickness that marks the
// node. If the band has no offset, the least half thickness is the node's distance from the surface. At first, all nodes beyond a
// limit are open, and their connected regions get labels. The nodes within the limit are then opened one by one, from far to
// near. If a node joins two sets, and each of the two has a shared node or an end, the node becomes a link. A link has the
// distance of its node. Regions of different pieces are joined if they have a common node. Links between regions are opened from
// far to near until the two ends are joined. If the two ends are joined before any link is opened, the limit was too small.

// A place in the mesh: a region of a piece beyond the limit, or a node within the limit. If the place is a node, its piece and
// its region are -1.
struct Place {
  PieceRegion region;
  NodeKey key;
  bool is_region() const { return region[0] >= 0; }
  bool operator<(const Place &other) const { return std::tie(region, key) < std::tie(other.region, other.key); }
};

// A node that joins two places. For an end of the passage, both places are the place of the end.
struct Link {
  Place p, q;
  PassageNode node;
};

// Reduces one piece to the ways between its shared nodes.
class PieceWays {
 public:
  PieceWays(const Piece &piece, const riis_mark_list &within, const Band &band, double limit)
      : piece_(piece), sets_(piece.n()) {
    const auto n = static_cast<std::size_t>(piece_.n());
    distance_.assign(n, std::numeric_limits<double>::infinity());
    for (std::int64_t i = 0; i < within.n_nodes; ++i) {
      const std::int64_t node = within.node_id[i];
      const double distance = band.marking_thickness(within.distance[i], within.height ? within.height[i] : 0);
      if (!(distance <= limit)) continue;
      view(distance_)[node] = distance;
      near_.push_back(node);
    }
    is_open_.resize(n);
    for (std::int64_t i = 0; i < piece_.n(); ++i)
      if (is_far(i)) open(i, [&](std::int64_t j) { sets_.unite(i, j); });
    region_.resize(n);
    terminal_.assign(n, -1);
    for (std::int64_t i = 0; i < piece_.n(); ++i) {
      view(region_)[i] = view(is_open_)[i] ? sets_.root(i) : -1;
      if (piece_.is_shared(i)) add_terminal(i);
    }
  }

  // Makes a node an end of the passage, and returns its place.
  Link end_at(std::int64_t node) {
    add_terminal(node);
    return {place_of(node), place_of(node), node_of(piece_, node, view(distance_)[node])};
  }

  void add_links(std::vector<Link> &links) {
    std::sort(near_.begin(), near_.end(), [&](std::int64_t a, std::int64_t b) {
      const double p = view(distance_)[a], q = view(distance_)[b];
      return p != q ? p > q : piece_.id(a) < piece_.id(b);
    });
    for (const std::int64_t node : near_) open(node, [&](std::int64_t other) { unite(node, other, links); });
  }

  // For each node, returns its region beyond the limit, or -1. A region has the number of its least node.
  const std::vector<std::int64_t> &regions() const { return region_; }

 private:
  bool is_far(std::int64_t node) const { return std::isinf(view(distance_)[node]); }

  void add_terminal(std::int64_t node) { view(terminal_)[is_far(node) ? sets_.root(node) : node] = node; }

  Place place_of(std::int64_t node) const {
    if (!is_far(node)) return {{-1, -1}, piece_.key(node)};
    return {{static_cast<std::int32_t>(piece_.number), static_cast<std::int32_t>(view(region_)[node])}, {0, 0}};
  }

  // Opens a node that is no ghost, and calls `join` for each open neighbour.
  template <class Join>
  void open(std::int64_t node, const Join &join) {
    if (piece_.is_ghost(node)) return;
    view(is_open_)[node] = 1;
    piece_.for_each_neighbor(node, [&](std::int64_t other) {
      if (view(is_open_)[other]) join(other);
    });
  }

  void unite(std::int64_t node, std::int64_t other, std::vector<Link> &links) {
    const std::int64_t p = view(terminal_)[sets_.root(node)], q = view(terminal_)[sets_.root(other)];
    if (!sets_.unite(node, other)) return;
    if (p >= 0 && q >= 0) links.push_back({place_of(p), place_of(q), node_of(piece_, node, view(distance_)[node])});
    view(terminal_)[sets_.root(node)] = p >= 0 ? p : q;
  }

  const Piece &piece_;
  DisjointSets sets_;
  std::vector<double> distance_;    // infinite beyond the limit
  std::vector<std::int64_t> near_;  // the nodes within the limit
  std::vector<std::uint8_t> is_open_;
  std::vector<std::int64_t> region_;    // the root of the node's region beyond the limit, or -1
  std::vector<std::int64_t> terminal_;  // of a set's root: a shared node or an end in the set, or -1
};

}  // namespace

std::optional<PassageReport> PassageCheck::find_within(const riis_surface *surface, double limit) const {
  const riis_surface_info info = info_of(surface);
  const Band band{limit, info.offset};
  const riis_mark_options how = how_to_mark_again(options_, band.reach());
  std::vector<Link> own_links, own_ends;
  std::vector<std::vector<SharedNode>> shared;
  int has_ids = 0;
  mesh_.for_each_own([&](Piece &piece) {
    if (piece.n() == 0) return;
    has_ids = piece.has_ids();
    piece.find_neighbors(how.n_threads);
    const Marks marks = marks_of(surface, piece.mesh(), how);
    PieceWays ways(piece, list_of(marks, RIIS_LIST_WITHIN_LIMIT), band, limit);
    for (const PassageEnd &end : ends_)
      if (end.piece == piece.number) own_ends.push_back(ways.end_at(end.node));
    shared.push_back(shared_nodes_of(piece, ways.regions()));
    ways.add_links(own_links);
  });
  const std::vector<Link> placed = ranks::gather(own_ends);
  const MatchedNodes matched = match_nodes(std::move(shared), ranks::sum(has_ids) > 0, mesh_.files());
  // From far to near. If distances are equal, the ids decide.
  std::vector<Link> links = ranks::gather(own_links);
  std::sort(links.begin(), links.end(), [](const Link &a, const Link &b) {
    return std::tie(b.node.distance, a.node.id, a.node.piece) < std::tie(a.node.distance, b.node.id, b.node.piece);
  });
  JoinedSets<Place> ways;
  for (const auto &[p, q] : matched.joined) ways.unite({p, {0, 0}}, {q, {0, 0}});
  const auto are_joined = [&] { return ways.are_joined(placed[0].p, placed[1].p); };
  const PassageNode *found = nullptr;
  if (are_joined()) {
    // Both ends are the same node, or a path of nodes beyond the limit joins the ends.
    if (placed[0].p.is_region()) return std::nullopt;
    found = &placed[0].node;
  }
  for (auto link = links.begin(); !found && link != links.end(); ++link) {
    ways.unite(link->p, link->q);
    if (are_joined()) found = &link->node;
  }
  PassageReport passage{{-1, 0, {0, 0, 0}, 0, RIIS_PASSAGE_NONE, 0}};
  if (!found) return passage;
  const bool is_open = found->distance > info.half_thickness;
  passage.found = {found->id, found->distance, {}, 0, is_open ? RIIS_PASSAGE_OPEN : RIIS_PASSAGE_CLOSED, 0};
  std::copy_n(found->point.data(), 3, passage.found.point);
  for (const PassageEnd &end : ends_) passage.is_end |= end.key == found->key;
  return passage;
}

PassageReport PassageCheck::find(const riis_surface *surface) const {
  check_ends_are_open(surface);
  if (mesh_.is_whole()) {
    const riis_mark_options how = how_to_mark_again(options_);
    auto sets = defaults<riis_passage_ends>();
    sets.n_from = sets.n_to = 1;
    sets.from = &ends_[0].node;
    sets.to = &ends_[1].node;
    PassageReport passage;
    mesh_.for_each_own([&](const Piece &piece) {
      check(riis_find_passage(surface, piece.mesh(), &sets, &how, &passage.found, sizeof passage.found));
    });
    for (const PassageEnd &end : ends_) passage.is_end |= end.node == passage.found.node_id;
    return passage;
  }
  // In pieces, the passage is found as riis_find_passage finds it. Its width has an upper limit: a band with the half thickness
  // `farthest` contains the two ends of every path.
  const riis_surface_info info = info_of(surface);
  Box around = box_of(info);
  for (const PassageEnd &end : ends_) around.grow(end.point.data());
  const double farthest = std::max(2 * around.largest_side() / (1 - std::abs(info.offset)), 2 * info.half_thickness);
  double growth = 2;
  for (double limit = 2 * info.half_thickness;; limit = std::min(limit * growth, farthest)) {
    if (const auto found = find_within(surface, limit)) return *found;
    growth *= growth;
  }
}

// ---- The ends ----

void PassageCheck::check_ends_are_open(const riis_surface *surface) const {
  const riis_surface_info info = info_of(surface);
  for (int end = 0; end < 2; ++end) {
    const double *const point = ends_[end].point.data();
    const auto mesh = create<Mesh>(riis_mesh_create, 1, point, point + 1, point + 2, 3);
    const Marks marks = marks_of(surface, mesh, how_to_mark_again(options_));
    const riis_mark_list marked = list_of(marks, RIIS_LIST_MARKED);
    if (marked.n_nodes == 0) continue;
    const double height = marked.height ? marked.height[0] : 0;
    refuse_end(options_, end,
               "is node " + names_[end] + ", in the band: " +
                   (info.offset == 0 ? "its distance to the surface, " : "the half thickness that marks it, ") +
                   shortest(Band{info.half_thickness, info.offset}.marking_thickness(marked.distance[0], height)) +
                   ", is at most the half thickness, " + shortest(info.half_thickness));
  }
}

void PassageCheck::add(const Piece &piece) {
  if (!options_.check_leaks) return;
  for (int end = 0; end < 2; ++end) {
    const double *const asked = options_.check_leaks->point(end);
    std::int64_t found = -1;
    double least = 0;
    for (std::int64_t i = 0; i < piece.n(); ++i) {
      const double away = distance_between(piece.point(i).data(), asked);
      if (piece.is_ghost(i) || (found >= 0 && !(away < least)) || piece.longest_edge(i) == 0) continue;
      found = i;
      least = away;
    }
    if (found >= 0) found_ends_[end].push_back({node_of(piece, found, least), piece.longest_edge(found)});
  }
}

void PassageCheck::find_end(int end, const MeshCounts &counts, const std::string &unknown) {
  // A point inside a cell is at most one edge length away from a node of the cell. An end of the passage may be up to two edge
  // lengths away from a node.
  constexpr double edges_away = 2;
  const bool has_ids = counts.n_with_ids > 0;
  const std::vector<PassageEnd> all = ranks::gather(found_ends_[end]);
  if (all.empty())
    refuse_end(options_, end,
               "has no node near it: " + (unknown.empty() ? "no edge joins two nodes of the mesh" : unknown));
  PassageEnd &best = ends_[end];
  const auto order = [&](const PassageEnd &node) {
    return std::tuple(node.distance, has_ids ? node.id : 0, node.piece, node.id);
  };
  best = *std::min_element(all.begin(), all.end(), [&](const auto &a, const auto &b) { return order(a) < order(b); });
  for (const PassageEnd &node : all)
    if (best.key == node.key) best.longest_edge = std::max(best.longest_edge, node.longest_edge);
  names_[end] = std::to_string(best.id);
  if (!has_ids && !mesh_.is_whole()) names_[end] += " of " + view(mesh_.files())[best.piece];
  const double *const point = options_.check_leaks->point(end);
  if (!counts.box.contains(point))
    refuse_end(options_, end,
               "is outside the mesh, which goes from " + place_text(options_, counts.box.lower, best.longest_edge) +
                   " to " + place_text(options_, counts.box.upper, best.longest_edge));
  if (best.distance > edges_away * best.longest_edge)
    refuse_end(options_, end,
               "is outside the mesh: the nearest node, " + names_[end] + ", is " + shown(best.distance) +
                   " away, its longest edge " + shown(best.longest_edge));
}

// ---- Results ----

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
  for (int end = 0; end < 2; ++end) find_end(end, counts, unknown);
  PassageReport passage = find(surface);
  const riis_passage &found = passage.found;
  // Unknown edges cannot close an open path, but they may make a path that the known edges do not have.
  passage.is_unknown = found.state != RIIS_PASSAGE_OPEN && !unknown.empty();
  if (found.state == RIIS_PASSAGE_OPEN && !passage.is_end && unknown.empty())
    passage.closing = closing_of(options_, surface, valve, found.distance, [&](const riis_surface *other) {
      const riis_passage left = find(other).found;
      return left.state == RIIS_PASSAGE_CLOSED ? std::nullopt : std::optional(left.distance);
    });
  if (found.node_id >= 0) passage.place = place_text(options_, found.point, counts.median_edge);
  warn_of_passage(options_, passage, name, valve ? opening_of(valve) : 0, unknown);
  report.passage = passage;
  if (options_.first_passage && unknown.empty()) report.valves[0].flow.first = first_of(valve);
}

}  // namespace riis::program
