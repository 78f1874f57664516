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
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {

KeyedEdge edge_between(NodeKey p, NodeKey q, double length) {
  if (q < p) std::swap(p, q);
  return {p, q, length, 0, {0, 0, 0}};
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

Closing closing_of(const MarkOptions &options, const riis_surface *surface, const riis_valve *valve, double needed,
                   const Left &left) {
  constexpr int n_tries = 8;
  double wanted = rounded_up(needed);
  Closing closing;
  try {
    // The triangles of a valve depend on the half thickness, so each half thickness must be tried.
    for (int i = 0; valve && i < n_tries && closing.half_thickness == 0; ++i) {
      riis_surface_options how = options.surface_options;
      how.half_thickness = wanted;
      const std::optional<double> more = left(create<Surface>(riis_surface_create, valve, &how));
      if (!more) closing.half_thickness = wanted;
      wanted = rounded_up(std::max(more.value_or(0), 1.01 * wanted));
    }
    if (valve) return closing;
    // The triangles of a file do not depend on the half thickness. A skirt is about as long as the gaps to the wall.
    closing.half_thickness = wanted;
    if (options.surface.empty() || options.skirt) return closing;
    for (const double factor : {1.0, 1.5, 2.0}) {
      const double skirt = rounded_up(factor * wanted);
      if (left(joined_surface({surface}, with_band_of(surface), skirt))) continue;
      closing.skirt = skirt;
      break;
    }
  } catch (const Refusal &) {
    // A warning without advice is still valid. There is no advice if the half thickness or the skirt allows no surface, or if the
    // thicker band contains an end of the passage.
  }
  return closing;
}

std::string text_of(const Closing &closing) {
  return "--half-thickness " + shortest(closing.half_thickness) +
         (closing.skirt > 0 ? " or --skirt " + shortest(closing.skirt) : "") + " closes ";
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
  if (report.closing.half_thickness > 0) advice += text_of(report.closing) + (is_one ? "it; " : "them; ");
  advice += "edges of at most ";
  advice += offset == 0 ? "two half thicknesses (" + shortest(2 * half_thickness) + ") do not leak"
                        : shown(safe) + " half thicknesses (" + shown(safe * half_thickness) + ") seldom leak";
  warn({{Cause::leaks, text, advice}});
}

}  // namespace

MeshLeaks::MeshLeaks(const MovingValve &valve, const MeshPieces &mesh, std::string name)
    : valve_(valve),
      options_(valve.options()),
      mesh_(mesh),
      name_(std::move(name)),
      info_(info_of(valve.surface())),
      boxes_(mesh.files().size(), empty_box()) {}

void MeshLeaks::add(Piece &piece, riis_marks *marks) {
  view(boxes_)[piece.number] = piece.box();
  if (!piece.box().meets(box_of(info_))) return;
  add(piece, valve_.surface(), marks, found_);
}

void MeshLeaks::add(Piece &piece, const riis_surface *surface, riis_marks *marks, std::vector<KeyedEdge> &to) const {
  // Short edges may also leak if the search can miss nodes, or if distances are not measured to the triangles.
  const bool is_exact = stats_of(marks).complete && options_.surface_options.measure == RIIS_MEASURE_TRIANGLES;
  const double half_thickness = info_of(surface).half_thickness;
  const std::int32_t n_threads = options_.mark_options.n_threads;
  Adjacency adjacency;
  if (!piece.is_grid())
    adjacency = create<Adjacency>(riis_vtk_mesh_create_long_edges, piece.file, surface,
                                  is_exact ? 2 * (1 - std::abs(info_.offset)) * half_thickness : 0, n_threads, nullptr);
  const riis_csr rows = adjacency ? get<riis_csr>(riis_adjacency_get_csr, adjacency) : riis_csr{};
  const auto leaks = create<Leaks>(riis_leaks_create);
  const riis_mark_options how = surface == valve_.surface() ? options_.mark_options : how_to_mark_again(options_);
  piece.lend_neighbors(&rows);
  const riis_status status = riis_find_leaks(surface, piece.mesh(), marks, &how, leaks);
  piece.lend_neighbors(nullptr);
  check(status);
  const auto list = get<riis_leak_list>(riis_leaks_get_list, leaks);
  for (std::int64_t i = 0; i < list.n_edges; ++i) {
    const std::int64_t a = list.node_id[2 * i], b = list.node_id[2 * i + 1];
    KeyedEdge edge = edge_between(piece.key(a), piece.key(b), list.length[i]);
    edge.distance = list.distance[i];
    const FileNodes::Point p = piece.point(a), q = piece.point(b);
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
    if (report.marks.complete)
      leaks.closing = closing_of(options_, valve_.surface(), valve_.source().valve, leaks.found.half_thickness,
                                 [&](const riis_surface *surface) { return left(surface); });
    warn_of_leaks(options_, leaks, name_, report.surface.half_thickness);
  }
  if (!leaks.has_all_edges())
    warn((leaks.found.n_edges > 0 ? "more leaks of " : "leaks of ") + name_ +
         " are unknown: " + why_unknown(leaks, options_.mesh));
}

// Marks the pieces near the surface a second time, with another surface.
std::optional<double> MeshLeaks::left(const riis_surface *surface) const {
  const riis_surface_info info = info_of(surface);
  std::vector<KeyedEdge> found;
  const auto mark_again = [&](Piece &piece) {
    const Marks marks = marks_of(surface, piece.mesh(), how_to_mark_again(options_));
    add(piece, surface, marks, found);
  };
  mesh_.for_each_own(mark_again, nullptr,
                     [&](std::int64_t number) { return view(boxes_)[number].meets(box_of(info)); });
  const riis_leak_list left = summary_of(gathered(found));
  return left.n_edges == 0 ? std::nullopt : std::optional(left.half_thickness);
}

// ---- Band ----

std::vector<std::int64_t> BandMeasures::add(const Piece &piece, const riis_marks *marks,
                                            const riis_mark_options &options) {
  riis_mesh *const mesh = piece.mesh();
  if (piece.is_whole())
    of_whole_ = get<riis_cells_across>(riis_marks_get_cells_across, marks, mesh);
  else
    add_lengths(piece, list_of(marks, RIIS_LIST_MARKED));
  std::vector<std::int64_t> regions(static_cast<std::size_t>(piece.n()));
  riis_mark_options how = options;
  how.node_mask = piece.mask();
  std::int64_t n_regions = 0;
  check(riis_label_open_regions(mesh, marks, &how, piece.n(), regions.data(), &n_regions));
  n_regions_ += n_regions;
  return regions;
}

void BandMeasures::add_lengths(const Piece &piece, const riis_mark_list &marked) {
  std::vector<std::uint8_t> is_marked(static_cast<std::size_t>(piece.n()));
  for (std::int64_t i = 0; i < marked.n_nodes; ++i) view(is_marked)[marked.node_id[i]] = 1;
  for (std::int64_t i = 0; i < piece.n(); ++i) {
    if (piece.is_ghost(i)) continue;
    piece.for_each_neighbor(i, [&](std::int64_t j) {
      if (j < i || piece.is_ghost(j) || !(view(is_marked)[i] || view(is_marked)[j])) return;
      const double length = distance_between(piece.point(i).data(), piece.point(j).data());
      if (!(length > 0)) return;
      if (piece.is_shared(i) && piece.is_shared(j))
        shared_.push_back(edge_between(piece.key(i), piece.key(j), length));
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

LeafletsOutside::LeafletsOutside(const MarkOptions &options, const riis_surface *surface, std::optional<double> opening)
    : options_(options),
      info_(info_of(surface)),
      opening_(opening),
      samples_(area_samples(surface)),
      is_outside_(samples_.area.size(), 1) {}

void LeafletsOutside::add(const Piece &piece) {
  // If centres are marked, the box of the nodes is not used, because cells reach beyond the box of their centres.
  if (options_.at_cells || piece.box().meets(box_of(info_).widened(info_.half_thickness)))
    check(riis_vtk_mesh_find_outside(piece.file, view(is_outside_).size(), samples_.xyz.data(), info_.half_thickness,
                                     is_outside_.data()),
          piece.path());
}

OutsideReport LeafletsOutside::report() const {
  struct Area {
    double all = 0, outside = 0;
  } whole;
  std::map<std::int32_t, Area> by_leaflet;
  const std::vector<std::uint8_t> of_ranks = ranks::gather(is_outside_);
  const std::size_t n = is_outside_.size();
  for (std::size_t i = 0; i < n; ++i) {
    bool is_outside = true;
    for (std::size_t at = i; at < of_ranks.size(); at += n) is_outside = is_outside && of_ranks[at] != 0;
    for (Area *const area : {&whole, &by_leaflet[samples_.leaflet[i]]}) {
      area->all += samples_.area[i];
      if (is_outside) area->outside += samples_.area[i];
    }
  }
  OutsideReport made{whole.all > 0 ? whole.outside / whole.all : 0, {}, opening_};
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
