// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fixed_triangulation.hpp"

#include <algorithm>
#include <iterator>

#include "base/errors.hpp"

namespace riis {
namespace {

// The lines are chosen at so many openings, evenly spaced from 0 to 1.
constexpr int n_openings = 33;
// They are tried at the openings half-way between these. Lines that fail there are chosen again with the openings at which they
// failed, at most so often.
constexpr int n_trials = 4;

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
  std::vector<PatchSet> states, between;
  for (int i = 0; i < n_openings; ++i) states.push_back(patches_at(valve, static_cast<double>(i) / (n_openings - 1)));
  for (int i = 0; i + 1 < n_openings; ++i) between.push_back(patches_at(valve, (i + 0.5) / (n_openings - 1)));
  TriangulationPlan plan = plan_triangulation(states, max_error, n_threads);
  for (int trial = 0; trial < n_trials; ++trial) {
    const auto failed = std::stable_partition(between.begin(), between.end(), [&](const PatchSet &state) {
      return is_within(state, plan, max_error);
    });
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
