// SPDX-License-Identifier: Apache-2.0
#include "program/mark/leaks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "common/array_view.hpp"
#include "common/number_from_chars.hpp"
#include "program/base/handles.hpp"
#include "program/base/ranks.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/mesh_marking.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {

KeyedEdge edge_between(NodeKey p, NodeKey q, double length) {
  if (q < p) std::swap(p, q);
  return {p, q, length, 0, {0, 0, 0}};
}

std::vector<KeyedEdge> gathered(const std::vector<KeyedEdge> &own) {
  std::vector<KeyedEdge> all = ranks::gather(own);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Surface with_half_thickness(const MarkOptions &options, const riis_valve *valve, double half_thickness) {
  riis_surface_options surface_options = options.surface_options;
  surface_options.half_thickness = half_thickness;
  return create<Surface>(riis_surface_create, valve, &surface_options);
}

namespace {

// Rounds up to three digits. The printed number therefore also closes the leaks if the user types it.
double rounded_up(double x) {
  const double unit = power_of_ten(decimal_exponent(x) - 2);
  for (int steps = 0;; ++steps) {
    char text[64];
    double rounded = 0;
    const char *end = std::to_chars(text, text + sizeof text, x + steps * unit, std::chars_format::general, 3).ptr;
    number_from_chars(text, end, rounded);
    if (rounded >= x) return rounded;
  }
}

}  // namespace

// Each half thickness must be tried, because the triangles of a valve depend on the half thickness. The triangles of a file do
// not depend on the half thickness.
double closing_half_thickness(const riis_valve *valve, double half_thickness, const Left &left) {
  constexpr int n_tries = 8;
  double wanted = rounded_up(half_thickness);
  if (!valve) return wanted;
  try {
    for (int i = 0; i < n_tries; ++i) {
      const std::optional<double> needed = left(wanted);
      if (!needed) return wanted;
      wanted = rounded_up(std::max(*needed, 1.01 * wanted));
    }
  } catch (const Refusal &) {
    // A warning without advice is still valid. There is no advice if the half thickness allows no surface, or if the thicker band
    // contains an end of the passage.
  }
  return 0;
}

double closing_skirt(const MarkOptions &options, const riis_surface *surface, double half_thickness,
                     const std::function<bool(const riis_surface *)> &closes) {
  if (options.surface.empty() || options.skirt || half_thickness <= 0) return 0;
  JoinedTriangles triangles;
  triangles.add(triangles_of(surface), 0);
  riis_surface_arrays arrays = triangles.arrays();
  auto how = defaults<riis_surface_options>();
  how.half_thickness = info_of(surface).half_thickness;
  how.offset = info_of(surface).offset;
  for (const double factor : {1.0, 1.5, 2.0}) {
    arrays.skirt_length = rounded_up(factor * half_thickness);
    try {
      if (closes(create<Surface>(riis_surface_create_from_arrays, &arrays, &how))) return arrays.skirt_length;
    } catch (const Refusal &) {
      return 0;  // an unknown attachment, or a surface too small for such a skirt, gets no advice
    }
  }
  return 0;
}

namespace {

// Returns the numbers of a list of leaks. The list's pointers are null.
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

// --quiet does not silence this warning, because the valve lets flow through.
void warn_of_leaks(const MarkOptions &options, const LeakReport &report, const std::string &surface,
                   double half_thickness) {
  const riis_leak_list &leaks = report.found;
  const bool is_one = leaks.n_edges == 1;
  const std::string length = shown(leaks.longest_length);
  const std::string text =
      surface + " leaks: " +
      (is_one ? "1 edge of length " + length + " crosses it between two unmarked nodes"
              : grouped(leaks.n_edges) + " edges cross it between two unmarked nodes, the longest (" + length + ")") +
      " at " + place_text(options, leaks.longest_middle, leaks.longest_length);
  // If the band has an offset, shorter edges leak at sharp corners of a rim, and the shortest edges leak where a rim turns
  // sharply (docs/theory/marks.md, "Offset").
  const double offset = options.surface_options.offset, safe = 2 * std::sqrt((1 - offset) * (1 + offset));
  std::string advice = "; ";
  if (report.closing_half_thickness > 0)
    advice += "--half-thickness " + shortest(report.closing_half_thickness) +
              (report.closing_skirt > 0 ? " or --skirt " + shortest(report.closing_skirt) : "") + " closes " +
              (is_one ? "it; " : "them; ");
  advice += "edges of at most ";
  advice += offset == 0 ? "two half thicknesses (" + shortest(2 * half_thickness) + ") do not leak"
                        : shown(safe) + " half thicknesses (" + shown(safe * half_thickness) + ") seldom leak";
  warn({{Cause::leaks, text, advice}});
}

}  // namespace

MeshLeaks::MeshLeaks(const MarkOptions &options, const MeshPieces &mesh, const riis_surface *surface,
                     const riis_valve *valve, std::string name)
    : options_(options),
      mesh_(mesh),
      surface_(surface),
      valve_(valve),
      name_(std::move(name)),
      info_(info_of(surface)) {
  resize(boxes_, view(mesh.files()).size());
  std::fill(boxes_.begin(), boxes_.end(), empty_box());
}

void MeshLeaks::add(Piece &piece, riis_marks *marks) {
  view(boxes_)[piece.number] = piece.nodes.box();
  if (!piece.nodes.box().meets(box_of(info_))) return;
  add(piece, surface_, marks, info_.half_thickness, stats_of(marks).complete != 0, found_);
}

void MeshLeaks::add(Piece &piece, const riis_surface *surface, riis_marks *marks, double half_thickness,
                    bool is_complete, std::vector<KeyedEdge> &to) const {
  // Short edges may also leak if the search can miss nodes, or if distances are not measured to the triangles.
  const bool is_exact = is_complete && options_.surface_options.measure == RIIS_MEASURE_TRIANGLES;
  const std::int32_t n_threads = options_.mark_options.n_threads;
  Adjacency adjacency;
  if (!piece.mesh->is_grid())
    adjacency = create<Adjacency>(riis_vtk_mesh_create_long_edges, piece.file, surface,
                                  is_exact ? 2 * (1 - std::abs(info_.offset)) * half_thickness : 0, n_threads, nullptr);
  const FileNodes::Lent lent(*piece.mesh, adjacency ? get<riis_csr>(riis_adjacency_get_csr, adjacency) : riis_csr{});
  const auto leaks = create<Leaks>(riis_leaks_create);
  const riis_mark_options how = surface == surface_ ? options_.mark_options : how_to_mark_again(options_);
  check(riis_find_leaks(surface, piece.mesh->mesh(), marks, &how, leaks));
  const auto list = get<riis_leak_list>(riis_leaks_get_list, leaks);
  for (std::int64_t i = 0; i < list.n_edges; ++i) {
    const std::int64_t a = list.node_id[2 * i], b = list.node_id[2 * i + 1];
    KeyedEdge edge = edge_between(piece.nodes.key(a), piece.nodes.key(b), list.length[i]);
    edge.distance = list.distance[i];
    const NodePoints::Point p = piece.nodes.point(a), q = piece.nodes.point(b);
    for (std::size_t k = 0; k < 3; ++k) edge.middle[k] = 0.5 * (p[k] + q[k]);
    to.push_back(edge);
  }
}

void MeshLeaks::judge(ValveReport &report) {
  LeakReport &leaks = report.leaks;
  const std::vector<KeyedEdge> edges = gathered(found_);
  found_ = {};
  leaks.found = summary_of(edges);
  // In a whole mesh, the keys are the nodes' numbers.
  for (const KeyedEdge &edge : edges)
    if (mesh_.is_whole())
      for (const NodeKey &end : {edge.p, edge.q}) leaks.edges.push_back(static_cast<std::int64_t>(end[0]));
  if (options_.check_leaks) return;
  if (leaks.found.n_edges > 0) {
    if (report.marks.complete) {
      leaks.closing_half_thickness = closing_half_thickness(valve_, leaks.found.half_thickness, [&](double wanted) {
        return left(with_half_thickness(options_, valve_, wanted), wanted);
      });
      leaks.closing_skirt =
          closing_skirt(options_, surface_, leaks.closing_half_thickness,
                        [&](const riis_surface *surface) { return !left(surface, info_.half_thickness); });
    }
    warn_of_leaks(options_, leaks, name_, report.surface.half_thickness);
  }
  if (!leaks.has_all_edges())
    warn((leaks.found.n_edges > 0 ? "more leaks of " : "leaks of ") + name_ +
         " are unknown: " + why_unknown(leaks, options_.mesh));
}

// Marks the pieces near the surface a second time, with another half thickness.
std::optional<double> MeshLeaks::left(const riis_surface *surface, double half_thickness) const {
  const riis_surface_info info = info_of(surface);
  std::vector<KeyedEdge> found;
  const auto mark_again = [&](Piece &piece) {
    const Marks marks = marks_of(surface, piece.mesh->mesh(), how_to_mark_again(options_));
    add(piece, surface, marks, half_thickness, true, found);
  };
  mesh_.for_each_own(mark_again, nullptr,
                     [&](std::int64_t number) { return view(boxes_)[number].meets(box_of(info)); });
  const riis_leak_list left = summary_of(gathered(found));
  return left.n_edges == 0 ? std::nullopt : std::optional(left.half_thickness);
}

// ---- Band ----

std::vector<std::int64_t> BandMeasures::add(const Piece &piece, const riis_marks *marks,
                                            const riis_mark_options &options) {
  const FileNodes::Lent lent(*piece.mesh);
  riis_mesh *const mesh = piece.mesh->mesh();
  if (piece.nodes.is_whole())
    of_whole_ = get<riis_cells_across>(riis_marks_get_cells_across, marks, mesh);
  else
    add_lengths(piece, list_of(marks, RIIS_LIST_MARKED));
  std::vector<std::int64_t> regions(static_cast<std::size_t>(piece.nodes.n()));
  riis_mark_options how = options;
  how.node_mask = piece.nodes.mask();
  std::int64_t n_regions = 0;
  check(riis_label_open_regions(mesh, marks, &how, piece.nodes.n(), regions.data(), &n_regions));
  n_regions_ += n_regions;
  return regions;
}

void BandMeasures::add_lengths(const Piece &piece, const riis_mark_list &marked) {
  const PieceNodes &nodes = piece.nodes;
  std::vector<std::uint8_t> is_marked(static_cast<std::size_t>(nodes.n()));
  for (std::int64_t i = 0; i < marked.n_nodes; ++i) view(is_marked)[marked.node_id[i]] = 1;
  for (std::int64_t i = 0; i < nodes.n(); ++i) {
    if (nodes.is_ghost(i)) continue;
    piece.mesh->for_each_neighbor(i, [&](std::int64_t j) {
      if (j < i || nodes.is_ghost(j) || !(view(is_marked)[i] || view(is_marked)[j])) return;
      const double length = distance_between(nodes.point(i).data(), nodes.point(j).data());
      if (!(length > 0)) return;
      if (nodes.is_shared(i) && nodes.is_shared(j))
        shared_.push_back(edge_between(nodes.key(i), nodes.key(j), length));
      else
        lengths_.add(length);
    });
  }
}

void BandMeasures::judge(const MatchedNodes &matched, double half_thickness, FlowReport &report) const {
  Lengths all;
  for (const Lengths &lengths : ranks::gather(std::vector<Lengths>{lengths_})) all.add(lengths);
  for (const KeyedEdge &edge : gathered(shared_)) all.add(edge.length);
  report.cells = of_whole_.value_or(all.across(half_thickness));
  report.n_open_regions = ranks::sum(n_regions_) - matched.n_joins();
}

// ---- The leaflets outside the mesh ----

namespace {

std::string percent(double share) { return printed(share < 0.1 ? "%.2g %%" : "%.0f %%", 100 * share); }

}  // namespace

LeafletsOutside::LeafletsOutside(const MovingValve &valve)
    : LeafletsOutside(valve.options(), valve.surface(), valve.opening()) {}

LeafletsOutside::LeafletsOutside(const MarkOptions &options, const riis_surface *surface, std::optional<double> opening)
    : options_(options),
      info_(info_of(surface)),
      opening_(opening),
      samples_(area_samples(surface)),
      is_outside_(samples_.area.size(), 1) {}

void LeafletsOutside::add(const Piece &piece) {
  // If centres are marked, the box of the nodes is not used, because cells reach beyond the box of their centres.
  if (options_.at_cells || piece.nodes.box().meets(box_of(info_).widened(info_.half_thickness)))
    check(riis_vtk_mesh_find_outside(piece.file, view(is_outside_).size(), samples_.xyz.data(), info_.half_thickness,
                                     is_outside_.data()),
          piece.path);
}

double LeafletsOutside::share_of(const std::vector<std::uint8_t> &is_outside) const {
  double all = 0, outside = 0;
  for (std::size_t i = 0; i < is_outside.size(); ++i) {
    all += view(samples_.area)[i];
    if (view(is_outside)[i] != 0) outside += view(samples_.area)[i];
  }
  return all > 0 ? outside / all : 0;
}

OutsideReport LeafletsOutside::report() const {
  struct Area {
    double all = 0, outside = 0;
  };
  std::map<std::int32_t, Area> by_leaflet;
  const std::vector<std::uint8_t> of_ranks = ranks::gather(is_outside_);
  const std::size_t n = is_outside_.size();
  std::vector<std::uint8_t> is_outside(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t at = i; at < of_ranks.size(); at += n) is_outside[i] &= of_ranks[at];
    Area &area = by_leaflet[samples_.leaflet[i]];
    area.all += samples_.area[i];
    if (is_outside[i] != 0) area.outside += samples_.area[i];
  }
  OutsideReport made;
  made.share = share_of(is_outside);
  made.opening = opening_;
  for (const auto &[leaflet, area] : by_leaflet)
    if (area.outside > 0) made.leaflets.push_back({name_of_leaflet(options_, info_, leaflet), area.outside / area.all});
  return made;
}

std::string outside_text(const OutsideReport &report) {
  std::string text;
  for (const OutsideReport::Leaflet &leaflet : report.leaflets)
    text += (text.empty() ? "" : ", ") + leaflet.name + " " + percent(leaflet.share);
  return percent(report.share) + " of the leaflets' area (" + text + ")";
}

void warn_of_outside(const OutsideReport &report, const std::optional<OutsideReport> &closed, double half_thickness,
                     const std::string &name) {
  if (report.share <= most_outside) return;
  const std::string at = report.opening ? printed(" at opening %g", *report.opening) : "";
  const std::string what = ": " + outside_text(report) + " is farther than the half thickness " +
                           shown(half_thickness) + " outside the mesh";
  if (closed && closed->share <= most_outside)
    print_line(name + " reaches through the wall where it is open" + at + what +
               ", which has no nodes there. The closed valve stands inside the mesh");
  else
    warn({{Cause::outside, name + " stands through the wall" + at + what, ": move it, turn it or make it smaller"}});
}

}  // namespace riis::program
