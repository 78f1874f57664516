// SPDX-License-Identifier: Apache-2.0
#include "pipeline/crossing_watch.hpp"

#include <algorithm>

#include "base/log.hpp"
#include "common/array_view.hpp"
#include "measures/crossings.hpp"

namespace riis {
namespace {

// Both depths are in half thicknesses. A pair counts if its depth is at least least_depth, the default of riis_find_crossings. A
// depth of least_deepest cannot come from rounding.
constexpr double least_depth = 1e-6, least_deepest = 1e-3;

// Returns the depth up to which triangles of leaflets may cross although the leaflets only touch (docs/theory.md, section 16).
double depth_of_contacts(const Valve &valve, const Surface &surface) {
  if (valve.kind().has_exact_contacts) return least_deepest * surface.half_thickness();
  return 2 * surface.triangles().error_bound;
}

// Logs a warning if leaflets cross deeper than leaflets that touch. Returns whether it did.
bool say(const Valve &valve, const Surface &surface, int n_threads) {
  const TriangleSet &set = surface.triangles();
  const Crossings pairs =
      find_crossings(set, surface.scene().groups(), least_depth * surface.half_thickness(), n_threads);
  const auto leaflet = [&](std::int64_t pair, int k) {
    return view(set.leaflet_id)[view(pairs.triangle)[2 * pair + k]];
  };
  // Hinges reach into recesses of the housing, and the model of the housing lacks these recesses. So crossings with the housing
  // do not count.
  const std::int32_t housing = valve.kind().housing;
  std::int64_t n = 0, deepest = -1;
  for (std::int64_t i = 0; i < view(pairs.depth).size(); ++i) {
    if (housing >= 0 && (leaflet(i, 0) == housing || leaflet(i, 1) == housing)) continue;
    ++n;
    if (deepest < 0 || view(pairs.depth)[i] > view(pairs.depth)[deepest]) deepest = i;
  }
  if (n == 0 || view(pairs.depth)[deepest] <= depth_of_contacts(valve, surface)) return false;
  constexpr int digits = 3;
  const auto at = [&](int k) { return rounded(view(pairs.point)[3 * deepest + k], digits + 1); };
  const std::int32_t one = leaflet(deepest, 0), other = leaflet(deepest, 1);
  const Message who = one == other ? Message("leaflet ", one, " goes through itself")
                                   : Message("leaflets ", one, " and ", other, " go through each other");
  log_message(RIIS_LOG_WARNING, who.text(), " at opening ", valve.opening(), ": ", n, n == 1 ? " pair" : " pairs",
              " of triangles, up to ", rounded(view(pairs.depth)[deepest], digits), " deep, at (", at(0), ", ", at(1),
              ", ", at(2), "); riis_find_crossings lists them, riis check crossings looks at all openings");
  return true;
}

}  // namespace

CrossingWatch::Shape &CrossingWatch::remembered(std::uint64_t digest) {
  const auto known =
      std::find_if(shapes_.begin(), shapes_.end(), [&](const Shape &shape) { return shape.digest == digest; });
  if (known != shapes_.end()) return *known;
  Shape &shape = shapes_[next_];
  next_ = (next_ + 1) % n_remembered;
  shape = {digest, 0, false};
  return shape;
}

void CrossingWatch::look(const Valve &valve, const Surface &surface, int n_threads) noexcept {
  if (!is_logging() || valve.has_default_shape()) return;
  Shape &shape = remembered(valve.shape_digest());
  unsigned range = 1;
  for (const double least : {0.0, 0.05, 1.0 / 3, 2.0 / 3})
    if (valve.opening() > least) range *= 2;
  if (shape.is_said || (shape.looked_at & range) != 0) return;
  shape.looked_at |= range;
  try {
    shape.is_said = say(valve, surface, n_threads);
  } catch (...) {
    // The search ran out of memory. This is no failure, because the caller did not request the search and the surface is good.
  }
}

}  // namespace riis
