// SPDX-License-Identifier: Apache-2.0
#include "marking/resistance.hpp"

#include <algorithm>
#include <cmath>

#include "base/constants.hpp"
#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Returns K at a distance d: (R / eps) delta(d) with delta(d) = (1 + cos(pi d / eps)) / (2 eps), and 0 from eps on.
double coefficient_at(const Resistance &resistance, double distance) {
  const double eps = resistance.half_thickness;
  if (!(distance < eps)) return 0;
  return resistance.factor * (1 + std::cos(pi * (distance / eps))) / (2 * eps);
}

// Returns K at entry i of a list.
double coefficient_at(const Resistance &resistance, const ListedNodes &list, std::int64_t i) {
  if (resistance.cuts_rim && view(list.fields.rim)[i]) return 0;
  return coefficient_at(resistance, view(list.nodes.distance)[i]);
}

// Calls visit(i, K) for each node of a range with a resistance, in ascending order.
template <class Visit>
void for_each_resistance(const Marks &marks, const Resistance &resistance, const Range &range, const Visit &visit) {
  for (std::int64_t i = range.begin; i < range.end; ++i) {
    const double k = coefficient_at(resistance, marks.within, i);
    if (k > 0) visit(i, k);
  }
}

void require_field(const Marks &marks, std::int32_t field, const char *field_name, const char *what) {
  if (!(marks.data.fields & field))
    fail(RIIS_INVALID_ARGUMENT, what, " needs ", field_name,
         ", but the nodes were marked with options.fields = ", marks.data.given_fields);
}

// A block of the list that one thread takes at a time, and the length below which one thread takes all.
constexpr std::int64_t nodes_per_block = 4096, few_nodes = 16384;

}  // namespace

Resistance checked_resistance(const riis_resistance &resistance, const char *name, double half_thickness,
                              double distance_limit) {
  check_range(name, "R", resistance.R, 0, 1e60);
  const double eps = resistance.half_thickness == RIIS_AUTO ? half_thickness : resistance.half_thickness;
  if (!(eps >= 1e-50 && eps <= distance_limit))
    fail(RIIS_INVALID_ARGUMENT, name, ".half_thickness is ", eps,
         "; it must be from 1e-50 to the distance limit of the marking, ", distance_limit);
  if (resistance.rim != RIIS_RIM_ROUND && resistance.rim != RIIS_RIM_CUT)
    fail(RIIS_INVALID_ARGUMENT, name, ".rim is ", resistance.rim, "; it must be RIIS_RIM_ROUND or RIIS_RIM_CUT");
  if (resistance.reserved != 0)
    fail(RIIS_INVALID_ARGUMENT, name, ".reserved is ", resistance.reserved, "; it must be 0");
  return {resistance.R / eps, eps, resistance.rim == RIIS_RIM_CUT};
}

Resistance checked_resistance(const riis_resistance &resistance, const Marks &marks) {
  if (!marks.was_marked) fail(RIIS_INVALID_ARGUMENT, "marks are empty: call riis_mark_nodes with them first");
  const Resistance checked = checked_resistance(resistance, "resistance", marks.half_thickness, marks.distance_limit);
  if (checked.cuts_rim) require_field(marks, RIIS_FIELD_RIM, "RIIS_FIELD_RIM", "RIIS_RIM_CUT");
  return checked;
}

void list_resistance(const Resistance *resistance, const WantedData &data, const Threads &n_threads,
                     ListedNodes &list) {
  const std::int64_t n = list.nodes.size();
  resize(list.k, data.k ? n : 0);
  resize(list.k_u_surface, data.k_u_surface ? 3 * n : 0);
  if (!data.k) return;
  parallel_for_ranges(n, nodes_per_block, n_threads.for_part(n, few_nodes), [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      const double k = view(list.k)[i] = coefficient_at(*resistance, list, i);
      if (data.k_u_surface)
        for (std::int64_t at = 3 * i; at < 3 * i + 3; ++at)
          view(list.k_u_surface)[at] = k * view(list.fields.velocity)[at];
    }
  });
}

void add_resistance(const Marks &marks, const Resistance &resistance, const riis_resistance_arrays &to) {
  const bool adds_k_u = to.K_u_surface[0] != nullptr;
  if (adds_k_u) require_field(marks, RIIS_FIELD_VELOCITY, "RIIS_FIELD_VELOCITY", "arrays.K_u_surface");
  const auto node_id = view(marks.within.nodes.node_id);
  const double *velocity = marks.within.fields.velocity.data();
  // Components beside each other share a cache line.
  const int n_lines = adds_k_u && to.K_u_surface[1] == to.K_u_surface[0] + 1 ? 1 : 3;
  const int n_threads = marks.n_threads.for_part(node_id.size(), few_nodes);
  parallel_for_ranges(node_id.size(), nodes_per_block, n_threads, [&](const Range &range, int) {
    for_each_resistance(marks, resistance, range, [&](std::int64_t i, double k) {
      // Nodes are far apart in the caller's arrays: they are fetched while earlier nodes are computed.
      const std::int64_t ahead = node_id[std::min(i + 16, node_id.size() - 1)], node = node_id[i];
      if (to.K) {
        __builtin_prefetch(to.K + to.K_stride * ahead, 1);
        to.K[to.K_stride * node] += k;
      }
      if (!adds_k_u) return;
      for (int c = 0; c < n_lines; ++c) __builtin_prefetch(to.K_u_surface[c] + to.K_u_surface_stride * ahead, 1);
      for (int c = 0; c < 3; ++c) to.K_u_surface[c][to.K_u_surface_stride * node] += k * velocity[3 * i + c];
    });
  });
}

void add_reaction(const Marks &marks, const Resistance &resistance, const riis_flow_arrays &flow, double *force) {
  const bool moves = (marks.data.fields & RIIS_FIELD_VELOCITY) != 0;
  // One thread sums in the order of the nodes, so that the bits do not depend on the number of threads.
  for_each_resistance(marks, resistance, {0, marks.within.nodes.size()}, [&](std::int64_t i, double k) {
    const std::int64_t node = view(marks.within.nodes.node_id)[i];
    for (int c = 0; c < 3; ++c) {
      const double surface_velocity = moves ? view(marks.within.fields.velocity)[3 * i + c] : 0;
      force[c] += flow.weight[node] * (k * (flow.velocity[c][flow.velocity_stride * node] - surface_velocity));
    }
  });
}

riis_band_sums band_sums(const Marks &marks, const riis_band &band) {
  require_field(marks, RIIS_FIELD_SIDE, "RIIS_FIELD_SIDE", "riis_marks_get_band_sums");
  require_field(marks, RIIS_FIELD_RIM, "RIIS_FIELD_RIM", "riis_marks_get_band_sums");
  riis_band_sums sums{};
  const NodeList &within = marks.within.nodes;
  const auto distance = view(within.distance);
  for (std::int64_t i = 0; i < within.size(); ++i) {
    const std::int32_t side = view(marks.within.fields.side)[i];
    if (view(marks.within.fields.rim)[i] || side == 0) continue;
    if (!(distance[i] >= band.inner && distance[i] <= band.outer)) continue;
    const std::int64_t node = view(within.node_id)[i];
    const std::size_t at = side < 0 ? 0 : 1;
    sums.sum[at] += band.weight[node] * band.value[node];
    sums.weight[at] += band.weight[node];
    ++sums.n_nodes[at];
  }
  return sums;
}

}  // namespace riis
