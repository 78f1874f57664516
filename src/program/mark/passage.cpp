// SPDX-License-Identifier: Apache-2.0
#include "program/mark/leaks.hpp"

#include <algorithm>
#include <utility>

#include "common/array_view.hpp"
#include "program/base/handles.hpp"
#include "program/base/ranks.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {

namespace {

// Returns the point's numbers as the user wrote them.
std::string text_of(const double *point) { return numbers_text(point, 3, " "); }

// Refuses an end that is outside the mesh or has no node near it. `why_none` is the reason to give if no node has a neighbour.
void check_end(const MarkOptions &options, int end, const std::optional<PieceEnd> &nearest, const std::string &name,
               const Box &box, const std::string &why_none) {
  // A point inside a cell is within one edge length of one of the cell's nodes. This limit allows two.
  constexpr double edges_away = 2;
  const LeakCheck &asked = *options.check_leaks;
  const double *const point = asked.point(end);
  const auto refuse = [&](const std::string &why) {
    throw Refusal{asked.exit_code,
                  asked.subject + ": " + (end == 0 ? "FROM" : "TO") + ", " + text_of(point) + ", " + why};
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
// An open valve is meant to have a passage, so there is no advice.
void warn_of_passage(const LeakCheck &asked, const PassageReport &report, const std::string &surface, double opening,
                     const std::string &unknown) {
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
         shown(found.distance) + " from it. Either the points are beside " + surface +
         ", or it does not stand in their way: give points on both sides of it, farther away");
  else if (report.closing_half_thickness > 0 && opening == 0)
    warn({{Cause::leaks, text + "at " + report.place,
           ", and --half-thickness " + shortest(report.closing_half_thickness) +
               (report.closing_skirt > 0 ? " or --skirt " + shortest(report.closing_skirt) : "") + " closes it"}});
  else
    warn(text + "at " + report.place + ", " + shown(found.distance) + " from the surface");
}

// Finds the widest passage by the library, which has the whole mesh.
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
      throw Refusal{options.check_leaks->exit_code,
                    options.check_leaks->subject + ": " + name + text.substr(argument.size())};
  }
  check(status);
  return passage;
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
      const double away = distance_between(nodes.point(i), asked);
      if (nodes.is_ghost(i) || (found >= 0 && !(away < least)) || piece.mesh->longest_edge(i) == 0) continue;
      found = i;
      least = away;
    }
    if (found < 0) continue;
    PieceEnd made{nodes.key(found), {0, 0, 0}, least,          piece.mesh->longest_edge(found),
                  piece.number,     found,     nodes.id(found)};
    std::copy_n(nodes.point(found), 3, made.point);
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

FoundPassage PassageCheck::find(const riis_surface *surface) const {
  if (!mesh_.is_whole()) return find_passage(options_, mesh_, surface, ends_);
  FoundPassage passage{};
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
  constexpr int n_coarse = 8;
  const Valve moved = copy_of(valve);
  const auto how = defaults<riis_first_passage_options>();
  riis_first_passage first{};
  const auto is_open_at = [&](double opening) {
    check(riis_valve_set_scalar(moved, "opening", opening), "--first-passage");
    const auto surface = create_for<Surface>("--first-passage", riis_surface_create, moved, &options_.surface_options);
    const riis_passage passage = find(surface).found;
    ++first.n_openings;
    const bool is_open = passage.state == RIIS_PASSAGE_OPEN;
    (is_open ? first.opening : first.closed_opening) = opening;
    if (is_open || opening == 0 || opening == 1) {
      first.node_id = passage.node_id;
      first.distance = passage.distance;
      std::copy_n(passage.point, 3, first.point);
    }
    first.state = passage.state == RIIS_PASSAGE_NONE ? RIIS_FIRST_PASSAGE_NONE : RIIS_FIRST_PASSAGE_FOUND;
    return is_open;
  };
  if (is_open_at(0)) {
    first.state = RIIS_FIRST_PASSAGE_ALWAYS;
    return first;
  }
  if (first.state == RIIS_FIRST_PASSAGE_NONE) return first;
  bool is_open = false;
  for (int i = 1; i <= n_coarse && !is_open; ++i) is_open = is_open_at(static_cast<double>(i) / n_coarse);
  if (!is_open) {
    first.state = RIIS_FIRST_PASSAGE_NEVER;
    first.opening = first.closed_opening;
    return first;
  }
  while (first.opening - first.closed_opening > how.tolerance) is_open_at(0.5 * (first.closed_opening + first.opening));
  return first;
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
  const FoundPassage found = find(surface);
  PassageReport passage;
  passage.found = found.found;
  passage.is_end = found.is_end;
  // Unknown edges cannot close an open path, but may make one where the known edges have none.
  passage.is_unknown = found.found.state != RIIS_PASSAGE_OPEN && !unknown.empty();
  if (found.found.state == RIIS_PASSAGE_OPEN && !passage.is_end && unknown.empty()) {
    passage.closing_half_thickness = closing_half_thickness(valve, found.found.distance, [&](double wanted) {
      const riis_passage left = find(with_half_thickness(options_, valve, wanted).get()).found;
      return left.state == RIIS_PASSAGE_CLOSED ? std::nullopt : std::optional(left.distance);
    });
    passage.closing_skirt =
        closing_skirt(options_, surface, passage.closing_half_thickness,
                      [&](const riis_surface *with) { return find(with).found.state == RIIS_PASSAGE_CLOSED; });
  }
  if (found.found.node_id >= 0)
    passage.place = place_text(options_, found.found.point, longest_edge_at(found.found, counts));
  warn_of_passage(*options_.check_leaks, passage, name, valve ? opening_of(valve) : 0, unknown);
  report.passage = passage;
  if (options_.first_passage && unknown.empty()) report.valves[0].flow.first = first_of(valve);
}

}  // namespace riis::program
