// SPDX-License-Identifier: Apache-2.0
#include "program/marking_in_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "common/array_view.hpp"
#include "program/mesh_marking.hpp"
#include "program/outputs.hpp"
#include "program/progress.hpp"
#include "program/ranks.hpp"
#include "program/refusal.hpp"
#include "program/series_files.hpp"
#include "program/valve_source.hpp"

namespace riis::program {

void check_options_of_pieces(const MarkOptions &options) {
  const auto refuse = [&](const std::string &option, const std::string &why) {
    throw Refusal{exit_wrong_usage, option + ": " + why + ", and " + options.mesh + " is read in pieces"};
  };
  if (!options.pictures.empty()) refuse("--picture", "a picture needs the whole mesh");
  if (!options.series.movie.empty()) refuse("--movie", "a movie needs the whole mesh");
  if (options.at_cells) refuse("--cells", "cells at the border of a piece have neighbours in another piece");
  if (options.n_steps > 0) refuse("--steps", "steps are timed in the whole mesh");
  if (options.mark_options.search == RIIS_SEARCH_PAPER)
    refuse("--search paper", "this search walks through the whole mesh");
}

// ---- Counts ----

Box empty_box() {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {{far, far, far}, {-far, -far, -far}};
}

void grow(Box &box, const double *point) {
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = std::min(box.lower[k], point[k]);
    box.upper[k] = std::max(box.upper[k], point[k]);
  }
}

Box box_of(const PieceNodes &nodes) {
  Box box = empty_box();
  for (std::int64_t i = 0; i < nodes.n(); ++i)
    if (!nodes.is_ghost(i)) grow(box, nodes.point(i));
  return box;
}

void grow(Box &box, const Box &other) {
  grow(box, other.lower);
  grow(box, other.upper);
}

namespace {

// Lengths of edges.
struct Lengths {
  std::int64_t n = 0;
  double sum = 0, rounding = 0, shortest = std::numeric_limits<double>::infinity(), longest = 0;

  void add(double length) {
    ++n;
    add_to_sum(length);
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  void add(const Lengths &other) {
    n += other.n;
    add_to_sum(other.sum);
    rounding += other.rounding;
    shortest = std::min(shortest, other.shortest);
    longest = std::max(longest, other.longest);
  }
  double mean() const { return std::clamp((sum + rounding) / static_cast<double>(n), shortest, longest); }

 private:
  // Keeps the rounding of each addition, so the sum does not depend on the pieces.
  void add_to_sum(double x) {
    const double next = sum + x;
    rounding += std::abs(sum) >= std::abs(x) ? (sum - next) + x : (x - next) + sum;
    sum = next;
  }
};

KeyedEdge edge_between(NodeKey p, NodeKey q, double length) {
  if (q < p) std::swap(p, q);
  return {p, q, length, 0, {0, 0, 0}};
}

// Returns the edges of all ranks, each once.
std::vector<KeyedEdge> gathered(const std::vector<KeyedEdge> &own) {
  std::vector<KeyedEdge> all = ranks::gather(own);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void add_leaks(const riis_leak_list &list, const PieceNodes &nodes, std::vector<KeyedEdge> &to) {
  for (std::int64_t i = 0; i < list.n_edges; ++i) {
    const std::int64_t a = list.node_id[2 * i], b = list.node_id[2 * i + 1];
    KeyedEdge edge = edge_between(nodes.key(a), nodes.key(b), list.length[i]);
    edge.distance = list.distance[i];
    for (int k = 0; k < 3; ++k) edge.middle[k] = 0.5 * (nodes.point(a)[k] + nodes.point(b)[k]);
    to.push_back(edge);
  }
}

// Returns the numbers of a list of leaks. Its pointers are null.
riis_leak_list summary_of(const std::vector<KeyedEdge> &edges) {
  riis_leak_list list{};
  list.n_edges = view(edges).size();
  list.longest_node_id[0] = list.longest_node_id[1] = -1;
  for (const KeyedEdge &edge : edges) {
    list.half_thickness = std::max(list.half_thickness, edge.distance);
    if (edge.length <= list.longest_length) continue;
    list.longest_length = edge.length;
    std::copy_n(edge.middle, 3, list.longest_middle);
  }
  return list;
}

bool meets(const Box &box, const riis_surface_info &surface) {
  for (int k = 0; k < 3; ++k)
    if (box.upper[k] < surface.lower[k] || box.lower[k] > surface.upper[k]) return false;
  return true;
}

}  // namespace

void MeshCounts::add(const riis_vtk_mesh *file, const PieceNodes &nodes) {
  n_cells += nodes.counts().n_cells;
  n_volume_cells += nodes.counts().n_volume_cells;
  n_cells_left_out += nodes.counts().n_cells_left_out;
  if (nodes.n() == 0) return;
  ++n_with_nodes;
  n_with_ids += nodes.has_ids();
  for (std::int64_t i = 0; i < nodes.n(); ++i) n_nodes += nodes.is_inside(i);
  grow(box, box_of(nodes));
  double median = 0;
  check(riis_vtk_mesh_get_median_edge(file, &median));
  if (!(median > 0)) return;
  sum_of_edges += median * static_cast<double>(nodes.counts().n_cells);
  n_edge_cells += static_cast<double>(nodes.counts().n_cells);
}

MeshCounts sum_of(const MeshCounts &own, const MeshPieces &pieces) {
  MeshCounts all;
  for (const MeshCounts &counts : ranks::gather(std::vector<MeshCounts>{own})) {
    all.n_nodes += counts.n_nodes;
    all.n_cells += counts.n_cells;
    all.n_volume_cells += counts.n_volume_cells;
    all.n_cells_left_out += counts.n_cells_left_out;
    all.n_with_nodes += counts.n_with_nodes;
    all.n_with_ids += counts.n_with_ids;
    all.sum_of_edges += counts.sum_of_edges;
    all.n_edge_cells += counts.n_edge_cells;
    grow(all.box, counts.box);
  }
  if (all.n_with_nodes == 0) throw Refusal{exit_bad_data, pieces.path() + ": no piece holds points"};
  if (all.n_with_ids != 0 && all.n_with_ids != all.n_with_nodes)
    throw Refusal{exit_bad_data, pieces.path() + ": " + std::to_string(all.n_with_ids) + " of " +
                                     std::to_string(all.n_with_nodes) +
                                     " pieces have global ids; all or none must have them"};
  return all;
}

void warn_of_apart(const MeshCounts &counts, const MatchedNodes &matched, const MeshPieces &pieces) {
  if (counts.n_with_nodes < 2 || matched.n_in_several > 0 || counts.n_volume_cells == 0) return;
  warn("the pieces of " + pieces.path() +
       " share no node, so nothing passes from one to another: nodes are the same if their global ids or all their "
       "coordinates are equal");
}

// ---- Output ----

PieceOutput::PieceOutput(std::string path, std::int64_t n_pieces) : path_(std::move(path)) {
  if (path_.empty()) return;
  const SeriesFiles names(path_, ".vtu", static_cast<std::size_t>(n_pieces));
  if (ranks::is_first()) names.make_folder();
  ranks::agree();
  for (std::int64_t piece = 0; piece < n_pieces; ++piece)
    files_.push_back(names.path_of(static_cast<std::size_t>(piece), ""));
}

void PieceOutput::write(std::int64_t piece, const riis_vtk_mesh *mesh) {
  if (!is_wanted()) return;
  const UnbrokenWrite unbroken;
  check(riis_vtk_mesh_write(mesh, view(files_)[piece].c_str()));
  std::int64_t n_nodes = 0;
  check(riis_vtk_mesh_get_nodes(mesh, &n_nodes, nullptr, nullptr));
  if (has_arrays_ || n_nodes == 0) return;
  std::vector<const char *> names;
  for (const std::string &file : files_) names.push_back(file.c_str());
  riis_vtk_pieces *list = nullptr;
  check(riis_vtk_pieces_create(mesh, view(names).size(), names.data(), &list));
  list_.reset(list);
  has_arrays_ = true;
}

void PieceOutput::finish() {
  if (!is_wanted()) return;
  // The list names the arrays of a piece with nodes. The first rank that had such a piece writes the list.
  const std::vector<int> have_arrays = ranks::gather(std::vector<int>{has_arrays_});
  const auto writer = std::find(have_arrays.begin(), have_arrays.end(), 1) - have_arrays.begin();
  const UnbrokenWrite unbroken;
  if (writer == ranks::rank()) check(riis_vtk_pieces_write(list_.get(), path_.c_str()));
  ranks::agree();
}

// ---- Parts of a marking ----

MeshFile read_piece(const MarkOptions &options, const MeshPieces &pieces, std::int64_t piece, Seconds &seconds) {
  const Stage stage("reading " + view(pieces.files())[piece], options.quiet);
  MeshFile file = pieces.read(piece);
  seconds.read += stage.seconds();
  return file;
}

std::vector<SharedNode> shared_nodes_of(std::int64_t piece, const PieceNodes &nodes,
                                        const std::vector<std::int64_t> &regions) {
  std::vector<SharedNode> shared;
  std::int64_t n_shared = 0;
  for (std::int64_t i = 0; i < nodes.n(); ++i) n_shared += nodes.is_shared(i);
  shared.reserve(static_cast<std::size_t>(n_shared));
  for (std::int64_t i = 0; i < nodes.n(); ++i) {
    const std::int64_t region = regions.empty() ? -1 : view(regions)[i];
    if (nodes.is_shared(i))
      shared.push_back({nodes.key(i), static_cast<std::int32_t>(region), static_cast<std::int32_t>(piece)});
  }
  return shared;
}

Situation situation_in_pieces(const MarkOptions &options, const riis_surface_info &surface, std::int64_t n_nodes,
                              std::int64_t n_marked, const MeshCounts &counts) {
  Situation situation{
      options, n_nodes, n_marked, counts.box, {}, counts.median_edge(), surface.area, surface.half_thickness};
  std::copy_n(surface.lower, 3, situation.surface.lower);
  std::copy_n(surface.upper, 3, situation.surface.upper);
  return situation;
}

PieceLeaks::PieceLeaks(const MarkOptions &options, const MeshPieces &pieces, const riis_surface *surface,
                       const riis_valve *valve, std::string name)
    : options_(options), pieces_(pieces), surface_(surface), valve_(valve), name_(std::move(name)) {
  check(riis_surface_get_info(surface, &info_, sizeof info_));
  resize(boxes_, view(pieces.files()).size());
  std::fill(boxes_.begin(), boxes_.end(), empty_box());
}

void PieceLeaks::add(std::int64_t piece, const PieceNodes &nodes, const riis_vtk_mesh *file, riis_mesh *mesh,
                     riis_marks *marks) {
  view(boxes_)[piece] = box_of(nodes);
  if (!meets(view(boxes_)[piece], info_)) return;
  riis_mark_stats stats{};
  check(riis_marks_get_stats(marks, &stats, sizeof stats));
  const double longer_than = longest_closed_edge(options_, info_.half_thickness, stats.complete != 0);
  const Leaks leaks =
      leaks_of({surface_, valve_, file, mesh, marks, name_}, options_.mark_options, longer_than, nullptr);
  add_leaks(list_of(leaks.get()), nodes, found_);
}

void PieceLeaks::judge(Report &report) {
  report.leaks.found = summary_of(gathered(found_));
  found_ = {};
  judge_leaks(
      options_, valve_, name_,
      [&](double wanted) {
        const riis_leak_list left = leaks_with(wanted);
        return left.n_edges == 0 ? std::nullopt : std::optional(left.half_thickness);
      },
      report);
}

// Marks the pieces near the surface again with another half thickness, and returns the leaks of the new marking.
riis_leak_list PieceLeaks::leaks_with(double half_thickness) const {
  const Surface surface = with_half_thickness(options_, valve_, half_thickness);
  riis_surface_info info;
  check(riis_surface_get_info(surface.get(), &info, sizeof info));
  riis_mark_options how = options_.mark_options;
  how.search = RIIS_SEARCH_AUTO;
  how.distance_limit = RIIS_AUTO;
  std::vector<KeyedEdge> found;
  for_own_pieces(pieces_, [&](std::int64_t piece) {
    if (!meets(view(boxes_)[piece], info)) return;
    const MeshFile file = pieces_.read(piece);
    const PieceNodes nodes(file.get(), view(pieces_.files())[piece]);
    const Mesh mesh = borrow_nodes(file.get(), view(pieces_.files())[piece]);
    const Marks marks = new_result();
    check(riis_mark_nodes(surface.get(), mesh.get(), &how, marks.get()));
    const Leaks leaks = leaks_of({surface.get(), valve_, file.get(), mesh.get(), marks.get()}, how,
                                 longest_closed_edge(options_, half_thickness, true), nullptr);
    add_leaks(list_of(leaks.get()), nodes, found);
  });
  return summary_of(gathered(found));
}

void PassageCheck::add(std::int64_t piece, const PieceNodes &nodes, const NodeEdges &edges) {
  for (int end = 0; options_.check_leaks && end < 2; ++end) note(piece, nodes, edges, end);
}

void PassageCheck::note(std::int64_t piece, const PieceNodes &nodes, const NodeEdges &edges, int end) {
  const double *asked = end == 0 ? options_.check_leaks->from : options_.check_leaks->to;
  const auto longest_edge = [&](std::int64_t node) {
    double longest = 0;
    edges.for_each_neighbor(node, [&](std::int64_t other) {
      longest = std::max(longest, distance_between(nodes.point(node), nodes.point(other)));
    });
    return longest;
  };
  std::int64_t found = -1;
  double least = 0;
  for (std::int64_t i = 0; i < nodes.n(); ++i) {
    const double away = distance_between(nodes.point(i), asked);
    if (nodes.is_ghost(i) || (found >= 0 && !(away < least)) || longest_edge(i) == 0) continue;
    found = i;
    least = away;
  }
  if (found < 0) return;
  PieceEnd made{nodes.key(found), {0, 0, 0}, least, longest_edge(found), piece, found, nodes.id(found)};
  std::copy_n(nodes.point(found), 3, made.point);
  ends_[end].push_back(made);
}

// Returns the node nearest to an end among those of all pieces. Its longest edge may be in another piece.
std::optional<PieceEnd> PassageCheck::nearest(int end, bool has_ids) const {
  std::optional<PieceEnd> best;
  const std::vector<PieceEnd> all = ranks::gather(ends_[end]);
  const auto order = [&](const PieceEnd &node) {
    return std::tuple(node.distance, has_ids ? node.id : 0, node.piece, node.id);
  };
  for (const PieceEnd &node : all)
    if (!best || order(node) < order(*best)) best = node;
  for (const PieceEnd &node : all)
    if (best->key == node.key) best->longest_edge = std::max(best->longest_edge, node.longest_edge);
  return best;
}

namespace {

// Finds the first opening with a passage, as riis_find_first_passage does in a joined mesh. Each opening reads all pieces.
class FirstPassage {
 public:
  FirstPassage(const MarkOptions &options, const MeshPieces &pieces, const riis_valve *valve, const PieceEnd (&ends)[2])
      : options_(options), pieces_(pieces), valve_(copy_of(valve)), ends_(ends) {}

  riis_first_passage find() {
    constexpr int n_coarse = 8;
    riis_first_passage_options how;
    check(riis_first_passage_options_init(&how, sizeof how));
    riis_passage passage = at(0);
    if (passage.state == RIIS_PASSAGE_NONE) return made(0, 0, passage, RIIS_FIRST_PASSAGE_NONE);
    if (passage.state == RIIS_PASSAGE_OPEN) return made(0, 0, passage, RIIS_FIRST_PASSAGE_ALWAYS);
    double closed = 0, open = 0;
    for (int i = 1; i <= n_coarse && passage.state != RIIS_PASSAGE_OPEN; ++i) {
      closed = open;
      open = static_cast<double>(i) / n_coarse;
      passage = at(open);
    }
    if (passage.state != RIIS_PASSAGE_OPEN) return made(1, 1, passage, RIIS_FIRST_PASSAGE_NEVER);
    while (open - closed > how.tolerance) {
      const double middle = 0.5 * (closed + open);
      const riis_passage tried = at(middle);
      (tried.state == RIIS_PASSAGE_OPEN ? open : closed) = middle;
      if (tried.state == RIIS_PASSAGE_OPEN) passage = tried;
    }
    return made(open, closed, passage, RIIS_FIRST_PASSAGE_FOUND);
  }

 private:
  riis_passage at(double opening) {
    ++n_openings_;
    check(riis_valve_set_scalar(valve_.get(), "opening", opening), "--first-passage");
    riis_surface *made = nullptr;
    check(riis_surface_create(valve_.get(), &options_.surface_options, &made), "--first-passage");
    const Surface surface(made);
    return find_passage(options_, pieces_, made, ends_).found;
  }

  riis_first_passage made(double opening, double closed, const riis_passage &passage, std::int32_t state) const {
    riis_first_passage first{};
    first.opening = opening;
    first.closed_opening = closed;
    first.node_id = passage.node_id;
    first.distance = passage.distance;
    std::copy_n(passage.point, 3, first.point);
    first.n_openings = n_openings_;
    first.state = state;
    return first;
  }

  const MarkOptions &options_;
  const MeshPieces &pieces_;
  Valve valve_;
  const PieceEnd (&ends_)[2];
  std::int32_t n_openings_ = 0;
};

}  // namespace

void PassageCheck::judge(const riis_surface *surface, const riis_valve *valve, const std::string &name,
                         const MeshCounts &counts, Report &report) const {
  if (!options_.check_leaks) return;
  const Stage stage("looking for a passage", options_.quiet);
  PieceEnd ends[2];
  for (int end = 0; end < 2; ++end) {
    const std::optional<PieceEnd> found = nearest(end, counts.n_with_ids > 0);
    std::optional<NearestNode> node;
    if (found) {
      node = {found->distance, found->longest_edge, std::to_string(found->id)};
      if (counts.n_with_ids == 0) node->name += " of " + view(pieces_.files())[found->piece];
    }
    check_end(options_, end == 0 ? "FROM" : "TO", end == 0 ? options_.check_leaks->from : options_.check_leaks->to,
              node, counts.box.lower, counts.box.upper, why_unknown(report.leaks, options_.mesh));
    ends[end] = *found;
  }
  const PiecePassage found = find_passage(options_, pieces_, surface, ends);
  PassageReport passage;
  passage.found = found.found;
  passage.is_end = found.is_end;
  judge_passage(
      options_, valve, name, passage, counts.median_edge(),
      [&](double wanted) {
        const Surface thicker = with_half_thickness(options_, valve, wanted);
        const riis_passage left = find_passage(options_, pieces_, thicker.get(), ends).found;
        return left.state == RIIS_PASSAGE_CLOSED ? std::nullopt : std::optional(left.distance);
      },
      report);
  if (options_.first_passage && !valve)
    throw Refusal{exit_wrong_usage, "--first-passage needs a valve; a surface from a file does not open"};
  if (options_.first_passage && report.leaks.has_all_edges())
    report.flow.first = FirstPassage(options_, pieces_, valve, ends).find();
  report.seconds.leaks += stage.seconds();
}

// ---- Marking ----

namespace {

// The marking of a rank's pieces, and the sums over all ranks.
class PieceMarking {
 public:
  PieceMarking(const MarkOptions &options, const MeshPieces &pieces, const riis_surface *surface,
               const riis_valve *valve, const std::vector<std::string> &names, Report &report)
      : options_(options),
        pieces_(pieces),
        surface_(surface),
        names_(names),
        report_(report),
        wants_edges_(options.measures || !options.stats.empty() || options.check_leaks),
        output_(options.output, view(pieces.files()).size()),
        leaks_(options, pieces, surface, valve, "the surface"),
        passage_(options, pieces),
        valve_(valve) {}

  void run() {
    for_own_pieces(pieces_, [&](std::int64_t piece) {
      mark(piece);
      pieces_.finished(piece);
    });
    const MeshCounts counts = sum_of(counts_, pieces_);
    const MatchedNodes matched = match_nodes(std::move(shared_), counts.n_with_ids > 0, pieces_.files());
    loose_.check(pieces_);
    fill_report(counts, matched);
    warn_of_apart(counts, matched, pieces_);
    if (!report_.marks.complete) warn_of_incomplete_marks();
    const Situation situation =
        situation_in_pieces(options_, report_.surface, report_.marks.n_nodes, report_.marks.n_marked, counts);
    if (const auto warning = warning_of(situation)) warn({*warning});
    leaks_.judge(report_);
    if (wants_edges_) measure(matched);
    passage_.judge(surface_, valve_, "the surface", counts, report_);
    const Stage stage("writing", options_.quiet);
    output_.finish();
    if (output_.is_wanted()) report_.written.push_back(options_.output);
    report_.seconds.write += stage.seconds();
  }

 private:
  // Numbers that ranks add up or combine.
  struct Sums {
    std::int64_t n_unreached = 0, n_regions = 0;
    std::int32_t search = -1, n_threads = 0, complete = 1, reserved = 0;
    Lengths lengths;  // of edges that no other piece has
  };
  enum Kind { marked, within_limit, n_kinds };

  void mark(std::int64_t piece) {
    const MeshFile file = read_piece(options_, pieces_, piece, report_.seconds);
    const PieceNodes nodes(file.get(), view(pieces_.files())[piece]);
    counts_.add(file.get(), nodes);
    loose_.add(nodes);
    if (nodes.n() > 0) {
      check_new_arrays(options_, names_, file.get());
      MarkedFile marks = mark_file(options_, surface_, file.get(), report_.seconds);
      note(piece, file.get(), nodes, marks);
    }
    const Stage stage("writing", options_.quiet);
    output_.write(piece, file.get());
    report_.seconds.write += stage.seconds();
  }

  // Keeps the data of a piece that other pieces and the report need.
  void note(std::int64_t piece, const riis_vtk_mesh *file, const PieceNodes &nodes, MarkedFile &marks) {
    const Stage stage("looking for leaks", options_.quiet);
    leaks_.add(piece, nodes, file, marks.mesh.get(), marks.marks.get());
    node_counts_.add(nodes, list_of(marks.marks.get(), RIIS_LIST_MARKED), marked);
    node_counts_.add(nodes, list_of(marks.marks.get(), RIIS_LIST_WITHIN_LIMIT), within_limit);
    std::vector<std::int64_t> regions;
    if (wants_edges_) {
      const NodeEdges edges(file, options_.mark_options.n_threads);
      add_lengths(nodes, edges, list_of(marks.marks.get(), RIIS_LIST_MARKED));
      regions = regions_of(nodes, edges, marks);
      passage_.add(piece, nodes, edges);
    }
    sums_.n_unreached += marks.stats.n_unreached;
    sums_.complete = sums_.complete && marks.stats.complete;
    sums_.n_threads = std::max(sums_.n_threads, marks.stats.n_threads);
    if (sums_.search < 0) sums_.search = marks.stats.search;
    shared_.push_back(shared_nodes_of(piece, nodes, regions));
    report_.seconds.leaks += stage.seconds();
  }

  // Adds the lengths of the edges with a marked node. An edge between two shared nodes may be in several pieces.
  void add_lengths(const PieceNodes &nodes, const NodeEdges &edges, const riis_mark_list &list) {
    std::vector<std::uint8_t> is_marked(static_cast<std::size_t>(nodes.n()));
    for (std::int64_t i = 0; i < list.n_nodes; ++i) view(is_marked)[list.node_id[i]] = 1;
    for (std::int64_t i = 0; i < nodes.n(); ++i) {
      if (nodes.is_ghost(i)) continue;
      edges.for_each_neighbor(i, [&](std::int64_t j) {
        if (j < i || nodes.is_ghost(j) || !(view(is_marked)[i] || view(is_marked)[j])) return;
        const double *p = nodes.point(i), *q = nodes.point(j);
        const double length =
            std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]));
        if (!(length > 0)) return;
        if (nodes.is_shared(i) && nodes.is_shared(j))
          lengths_.push_back(edge_between(nodes.key(i), nodes.key(j), length));
        else
          sums_.lengths.add(length);
      });
    }
  }

  std::vector<std::int64_t> regions_of(const PieceNodes &nodes, const NodeEdges &edges, MarkedFile &marks) {
    riis_mesh *const mesh = marks.mesh.get();
    check(riis_mesh_set_adjacency(mesh, edges.rows()));
    std::vector<std::int64_t> regions(static_cast<std::size_t>(nodes.n()));
    riis_mark_options how = options_.mark_options;
    how.node_mask = nodes.mask();
    std::int64_t n_regions = 0;
    const riis_status status =
        riis_label_open_regions(mesh, marks.marks.get(), &how, nodes.n(), regions.data(), &n_regions);
    check(riis_mesh_set_adjacency(mesh, nullptr));  // this call changes no error message
    check(status);
    sums_.n_regions += n_regions;
    return regions;
  }

  void fill_report(const MeshCounts &counts, const MatchedNodes &matched) {
    riis_mark_stats &stats = report_.marks;
    stats = {};
    stats.complete = 1;
    stats.search = -1;
    for (const Sums &sums : ranks::gather(std::vector<Sums>{sums_})) {
      stats.n_unreached += sums.n_unreached;
      n_regions_ += sums.n_regions;
      stats.complete = stats.complete && sums.complete;
      stats.n_threads = std::max(stats.n_threads, sums.n_threads);
      if (stats.search < 0) stats.search = sums.search;
      all_lengths_.add(sums.lengths);
    }
    const std::vector<std::int64_t> of_kind = node_counts_.sums();
    stats.n_nodes = counts.n_nodes + matched.n_nodes;
    stats.n_marked = of_kind[marked];
    stats.n_within_limit = of_kind[within_limit];
    report_.n_cells = counts.n_cells;
    const double limit = options_.mark_options.distance_limit;
    report_.distance_limit = limit > 0 ? limit : report_.surface.half_thickness;
    report_.distance = options_.surface_options.measure;
    report_.mesh_name = options_.mesh;
    report_.leaks.n_volume_cells = counts.n_volume_cells;
    report_.leaks.n_cells_left_out = counts.n_cells_left_out;
  }

  void measure(const MatchedNodes &matched) {
    measure_surface(options_, surface_, report_);
    if (!report_.leaks.has_all_edges()) return;
    for (const KeyedEdge &edge : gathered(lengths_)) all_lengths_.add(edge.length);
    const Lengths &lengths = all_lengths_;
    const double eps = report_.surface.half_thickness;
    riis_cells_across cells{0, 0, 0, 0, 0, 0, eps, lengths.n};
    if (lengths.n > 0)
      cells = {2 * eps / lengths.longest,
               2 * eps / lengths.mean(),
               2 * eps / lengths.shortest,
               lengths.shortest,
               lengths.mean(),
               lengths.longest,
               eps,
               lengths.n};
    report_.flow.cells = cells;
    report_.flow.n_open_regions = n_regions_ - n_joins(matched.joined);
  }

  // Returns how many regions are a part of another region of the list.
  static std::int64_t n_joins(const std::vector<std::pair<PieceRegion, PieceRegion>> &joined) {
    std::set<PieceRegion> all;
    for (const auto &[p, q] : joined) all.insert({p, q});
    const std::vector<PieceRegion> regions(all.begin(), all.end());
    const auto at = [&](const PieceRegion &region) {
      return std::lower_bound(regions.begin(), regions.end(), region) - regions.begin();
    };
    DisjointSets sets(view(regions).size());
    std::int64_t n = 0;
    for (const auto &[p, q] : joined) n += sets.unite(at(p), at(q));
    return n;
  }

  const MarkOptions &options_;
  const MeshPieces &pieces_;
  const riis_surface *surface_;
  const std::vector<std::string> &names_;
  Report &report_;
  bool wants_edges_;
  PieceOutput output_;
  MeshCounts counts_;
  LooseNodes loose_;
  NodeCounts node_counts_{n_kinds};
  Sums sums_;
  Lengths all_lengths_;
  std::int64_t n_regions_ = 0;
  std::vector<std::vector<SharedNode>> shared_;
  std::vector<KeyedEdge> lengths_;
  PieceLeaks leaks_;
  PassageCheck passage_;
  const riis_valve *valve_;
};

}  // namespace

void mark_pieces(const MarkOptions &options, const MeshPieces &pieces, const riis_surface *surface,
                 const riis_valve *valve, const std::vector<std::string> &names_of_arrays, Report &report) {
  PieceMarking(options, pieces, surface, valve, names_of_arrays, report).run();
}

}  // namespace riis::program
