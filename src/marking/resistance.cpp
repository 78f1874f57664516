// SPDX-License-Identifier: Apache-2.0
#include "marking/resistance.hpp"

#include <algorithm>
#include <cmath>

#include "base/array_view.hpp"
#include "base/constants.hpp"
#include "base/errors.hpp"
#include "base/ranges.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {


// Returns K at a distance d: (R / eps) delta(d) with delta(d) = (1 + cos(pi d / eps)) / (2 eps), and 0 from eps on.
double coefficient_at(const Resistance &resistance, double distance) {
  const double eps = resistance.half_thickness;
  if (!(distance < eps)) return 0;
  return resistance.factor * (1 + std::cos(pi * (distance / eps))) / (2 * eps);
}

// Calls visit(i, K) for each node of a range with a resistance, in ascending order.
template <class Visit>
void for_each_resistance(const MarkResult &result, const Resistance &resistance, const Range &range,
                         const Visit &visit) {
  const NodeList &within = result.within;
  for (std::int64_t i = range.begin; i < range.end; ++i) {
    if (resistance.cuts_rim && view(result.fields_within.rim)[i]) continue;
    const double k = coefficient_at(resistance, view(within.distance)[i]);
    if (k > 0) visit(i, k);
  }
}

void require_field(const MarkResult &result, std::int32_t field, const char *field_name, const char *what) {
  if (!(result.fields & field))
    fail(RIIS_INVALID_ARGUMENT, what, " needs ", field_name,
         ", but the result was marked with options.fields = ", result.fields);
}

}  // namespace

Resistance checked_resistance(const riis_resistance &resistance, const MarkResult &result) {
  if (!result.was_marked) fail(RIIS_INVALID_ARGUMENT, "result was never marked with: call riis_mark_nodes first");
  check_range("resistance", "resistance", resistance.resistance, 0, 1e60);
  const double eps = resistance.half_thickness == RIIS_AUTO ? result.half_thickness : resistance.half_thickness;
  if (!(eps >= 1e-50 && eps <= result.distance_limit))
    fail(RIIS_INVALID_ARGUMENT, "resistance.half_thickness is ", eps,
         "; it must be from 1e-50 to the distance limit of ", "the marking, ", result.distance_limit);
  if (resistance.rim != RIIS_RIM_ROUND && resistance.rim != RIIS_RIM_CUT)
    fail(RIIS_INVALID_ARGUMENT, "resistance.rim is ", resistance.rim, "; it must be RIIS_RIM_ROUND or RIIS_RIM_CUT");
  check_reserved("resistance.reserved", resistance.reserved);
  const bool cuts_rim = resistance.rim == RIIS_RIM_CUT;
  if (cuts_rim) require_field(result, RIIS_FIELD_RIM, "RIIS_FIELD_RIM", "RIIS_RIM_CUT");
  return {resistance.resistance / eps, eps, cuts_rim};
}

void add_resistance(const MarkResult &result, const Resistance &resistance, double *coefficient, double *momentum) {
  if (momentum) require_field(result, RIIS_FIELD_VELOCITY, "RIIS_FIELD_VELOCITY", "momentum");
  const auto node_id = view(result.within.node_id);
  const double *velocity = result.fields_within.velocity.data();
  constexpr std::int64_t nodes_per_block = 4096, few = 16384;
  const int n_threads = result.n_threads.for_part(result.within.size(), few);
  parallel_for_ranges(result.within.size(), nodes_per_block, n_threads, [&](const Range &range, int) {
    for_each_resistance(result, resistance, range, [&](std::int64_t i, double k) {
      // Nodes are far apart in the caller's arrays: they are fetched while earlier nodes are computed.
      const std::int64_t ahead = node_id[std::min(i + 16, node_id.size() - 1)];
      if (coefficient) __builtin_prefetch(coefficient + ahead, 1);
      if (momentum) __builtin_prefetch(momentum + 3 * ahead, 1);
      const std::int64_t node = node_id[i];
      if (coefficient) coefficient[node] += k;
      if (momentum)
        for (int c = 0; c < 3; ++c) momentum[3 * node + c] += k * velocity[3 * i + c];
    });
  });
}

void add_reaction(const MarkResult &result, const Resistance &resistance, const double *velocity, const double *weight,
                  double *force) {
  const bool moves = (result.fields & RIIS_FIELD_VELOCITY) != 0;
  // One thread sums in the order of the nodes, so that the bits do not depend on the number of threads.
  for_each_resistance(result, resistance, {0, result.within.size()}, [&](std::int64_t i, double k) {
    const std::int64_t node = view(result.within.node_id)[i];
    for (int c = 0; c < 3; ++c) {
      const double surface_velocity = moves ? view(result.fields_within.velocity)[3 * i + c] : 0;
      force[c] += weight[node] * (k * (velocity[3 * node + c] - surface_velocity));
    }
  });
}

riis_band_sums band_sums(const MarkResult &result, double inner, double outer, const double *value,
                         const double *weight) {
  require_field(result, RIIS_FIELD_SIDE, "RIIS_FIELD_SIDE", "riis_mark_result_band_sums");
  require_field(result, RIIS_FIELD_RIM, "RIIS_FIELD_RIM", "riis_mark_result_band_sums");
  riis_band_sums sums{};
  const NodeList &within = result.within;
  const auto distance = view(within.distance);
  for (std::int64_t i = 0; i < within.size(); ++i) {
    const std::int32_t side = view(result.fields_within.side)[i];
    if (view(result.fields_within.rim)[i] || side == 0) continue;
    if (!(distance[i] >= inner && distance[i] <= outer)) continue;
    const std::int64_t node = view(within.node_id)[i];
    const std::size_t band = side < 0 ? 0 : 1;
    sums.sum[band] += weight[node] * value[node];
    sums.weight[band] += weight[node];
    ++sums.n_nodes[band];
  }
  return sums;
}

}  // namespace riis
