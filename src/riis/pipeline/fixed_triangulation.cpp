// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fixed_triangulation.hpp"

#include <utility>

#include "base/errors.hpp"
#include "base/recycled.hpp"

namespace riis {
namespace {

// The lines are chosen for this many openings, evenly spaced from 0 to 1.
constexpr int n_openings = 33;
// The chosen lines are then tested at n_between more openings between every two neighbouring openings. If the lines are too
// coarse at some of the tested openings, all lines are chosen again, now for these openings also. The test is repeated at most
// n_trials times.
constexpr int n_between = 7, n_trials = 4;
// A limit on the number of patches, because the choice keeps the patches of all these openings in memory.
constexpr std::size_t max_patches = 10'000;
// A warp may change after the triangles were planned, and the error with it. So the plan of a warped valve takes only this share
// of the allowed error.
constexpr double warped_share = 0.6;

PatchSet patches_at(Valve &valve, double opening) {
  valve.set("opening", 1, &opening);
  try {
    return valve.make_patches();
  } catch (const Error &error) {
    fail(error.status, "at the opening ", opening, ", for a fixed triangulation: ", error.message.text());
  }
}

TriangulationPlan plan_for(Valve valve, double max_error, int n_threads) {
  Vector<PatchSet> states;
  if (!valve.can_open()) {
    states.push_back(valve.make_patches());
    return plan_triangulation(states, max_error, n_threads);
  }
  const std::size_t n_patches = patches_at(valve, 0).patches.size();
  if (n_patches > max_patches)
    fail(RIIS_LIMIT_EXCEEDED, "the valve has ", n_patches, " patches; a fixed triangulation takes at most ",
         max_patches);
  constexpr int n_steps = (n_between + 1) * (n_openings - 1);
  const auto opening = [](int i) { return static_cast<double>(i) / n_steps; };
  for (int i = 0; i <= n_steps; i += n_between + 1) states.push_back(patches_at(valve, opening(i)));
  TriangulationPlan plan = plan_triangulation(states, max_error, n_threads);
  for (int trial = 0; trial < n_trials; ++trial) {
    const std::size_t n_states = states.size();
    for (int i = 0; i <= n_steps; ++i) {
      PatchSet state = patches_at(valve, opening(i));
      if (!is_within(state, plan, max_error)) states.push_back(std::move(state));
    }
    if (states.size() == n_states) break;
    plan = plan_triangulation(states, max_error, n_threads);
  }
  return plan;
}

}  // namespace

FixedTriangulation::FixedTriangulation(const Valve &valve, double max_error, int n_threads)
    : valve_(valve), plan_(plan_for(valve, valve.is_warped() ? warped_share * max_error : max_error, n_threads)) {
  free_kept_memory();
}

}  // namespace riis
