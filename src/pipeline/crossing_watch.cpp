// SPDX-License-Identifier: Apache-2.0
#include "pipeline/crossing_watch.hpp"

#include <algorithm>

#include "base/array_view.hpp"
#include "base/log.hpp"
#include "surface/crossings.hpp"

namespace riis {
namespace {

// In half thicknesses. Pairs count as riis_find_crossings has them by default. Leaflets that touch have triangles that cross by
// up to 1e-3, and leaflets that cross are deeper (docs/theory.md, section 16).
constexpr double least_depth = 1e-6, least_deepest = 1e-3;

void say(const Valve &valve, const Surface &surface, int n_threads) {
  const TriangleSet &set = surface.triangles();
  const double half_thickness = surface.half_thickness();
  const Crossings pairs = find_crossings(set, surface.scene().groups(), least_depth * half_thickness, n_threads);
  const auto deepest = std::max_element(pairs.depth.begin(), pairs.depth.end());
  if (deepest == pairs.depth.end() || *deepest <= least_deepest * half_thickness) return;
  const auto i = deepest - pairs.depth.begin();
  constexpr int digits = 3;
  const auto at = [&](int k) { return rounded(view(pairs.point)[3 * i + k], digits + 1); };
  const auto leaflet = [&](int k) { return view(set.leaflet_id)[view(pairs.triangle)[2 * i + k]]; };
  const std::int64_t n = view(pairs.depth).size();
  const bool is_one = leaflet(0) == leaflet(1);
  const Message who = is_one ? Message("leaflet ", leaflet(0), " goes through itself")
                             : Message("leaflets ", leaflet(0), " and ", leaflet(1), " go through each other");
  log_message(RIIS_LOG_WARNING, who.text(), " at opening ", valve.opening(), ": ", n, n == 1 ? " pair" : " pairs",
              " of triangles, up to ", rounded(*deepest, digits), " deep, at (", at(0), ", ", at(1), ", ", at(2),
              "); riis_find_crossings lists them, riis-mark --check-crossing looks at all openings");
}

}  // namespace

void CrossingWatch::look(const Valve &valve, const Surface &surface, int n_threads) noexcept {
  if (!is_logging() || valve.has_default_shape()) return;
  const std::uint64_t shape = valve.shape_digest();
  if (std::find(looked_at_.begin(), looked_at_.end(), shape) != looked_at_.end()) return;
  looked_at_[next_] = shape;
  next_ = (next_ + 1) % n_remembered;
  try {
    say(valve, surface, n_threads);
  } catch (...) {
    // The search lacks memory. The surface is there, and the caller has not requested the search.
  }
}

}  // namespace riis
