// SPDX-License-Identifier: Apache-2.0
#include "program/sweep.hpp"

#include <algorithm>
#include <limits>

#include "common/array_view.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"

namespace riis::program {
namespace {

Box nowhere() {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {{far, far, far}, {-far, -far, -far}};
}

void grow(Box &box, const riis_surface_info &surface) {
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = std::min(box.lower[k], surface.lower[k]);
    box.upper[k] = std::max(box.upper[k], surface.upper[k]);
  }
}

void note_nodes(const riis_marks *result, std::vector<std::uint8_t> &is_near) {
  const riis_mark_list within = list_of(result, RIIS_LIST_WITHIN_LIMIT);
  for (int64_t i = 0; i < within.n_nodes; ++i) view(is_near)[within.node_id[i]] = 1;
}

void note_valve(const MovingValve &valve, std::size_t at, Sweep &sweep) {
  riis_surface_info info;
  check(riis_surface_get_info(valve.surface(), &info, sizeof info));
  grow(sweep.box, info);
  const std::int64_t n_marked = valve.stats().n_marked;
  if (n_marked <= sweep.most_marked[at]) return;
  sweep.most_marked[at] = n_marked;
  sweep.surface[at] = info;
}

}  // namespace

Sweep sweep_of(std::vector<MovingValve> &valves, const std::vector<double> &times, const riis_mesh *mesh,
               std::int64_t n_nodes, bool quiet) {
  Sweep sweep{
      {}, nowhere(), std::vector<std::int64_t>(valves.size(), -1), std::vector<riis_surface_info>(valves.size())};
  std::vector<std::uint8_t> is_near(static_cast<std::size_t>(n_nodes));
  StepProgress progress("finding the nodes near the sweep", times.size(), quiet);
  for (std::size_t step = 0; step < times.size(); ++step) {
    progress.begin(step);
    for (std::size_t at = 0; at < valves.size(); ++at) {
      valves[at].move_to(times[step]);
      valves[at].mark(mesh, 0);
      note_nodes(valves[at].result(), is_near);
      note_valve(valves[at], at, sweep);
    }
  }
  for (std::int64_t node = 0; node < n_nodes; ++node)
    if (view(is_near)[node]) sweep.node_ids.push_back(node);
  return sweep;
}

}  // namespace riis::program
