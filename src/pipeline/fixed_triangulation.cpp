// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fixed_triangulation.hpp"

#include <algorithm>
#include <iterator>

#include "base/errors.hpp"

namespace riis {
namespace {

// The lines are chosen at so many openings, evenly spaced from 0 to 1.
constexpr int n_openings = 33;
// They are tried at so many openings between each two of these. Lines that fail there are chosen again with the openings at which
// they failed, at most so often.
constexpr int n_between = 3, n_trials = 4;

PatchSet patches_at(Valve &valve, double opening) {
  valve.set("opening", 1, &opening);
  try {
    return valve.make_patches();
  } catch (const Error &error) {
    fail(error.status, "at the opening ", opening, ", for a fixed triangulation: ", error.message.text());
  }
}

TriangulationPlan plan_for(Valve valve, double max_error, int n_threads) {
  if (!valve.can_open()) return plan_triangulation({valve.make_patches()}, max_error, n_threads);
  Vector<PatchSet> states, between;
  constexpr int n_steps = (n_between + 1) * (n_openings - 1);
  for (int i = 0; i <= n_steps; ++i)
    (i % (n_between + 1) == 0 ? states : between).push_back(patches_at(valve, static_cast<double>(i) / n_steps));
  TriangulationPlan plan = plan_triangulation(states, max_error, n_threads);
  for (int trial = 0; trial < n_trials; ++trial) {
    const auto failed = std::stable_partition(between.begin(), between.end(),
                                              [&](const PatchSet &state) { return is_within(state, plan, max_error); });
    if (failed == between.end()) break;
    states.insert(states.end(), std::make_move_iterator(failed), std::make_move_iterator(between.end()));
    between.erase(failed, between.end());
    plan = plan_triangulation(states, max_error, n_threads);
  }
  return plan;
}

}  // namespace

FixedTriangulation::FixedTriangulation(const Valve &valve, double max_error, int n_threads)
    : valve_(valve), plan_(plan_for(valve, max_error, n_threads)) {}

}  // namespace riis
