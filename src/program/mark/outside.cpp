// SPDX-License-Identifier: Apache-2.0
#include "program/mark/outside.hpp"

#include <algorithm>
#include <map>

#include "common/array_view.hpp"
#include "program/base/handles.hpp"
#include "program/base/ranks.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {
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
