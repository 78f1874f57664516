// SPDX-License-Identifier: Apache-2.0
#include "obstacle/resistance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.hpp"
#include "base/sum.hpp"
#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "obstacle/nearest_edges.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Returns K at a distance d from the middle of the band. K is (R / eps) delta(d) with delta(d) = (1 + cos(pi d / eps)) / (2 eps).
// K is 0 for d >= eps.
double coefficient_at(const Resistance &resistance, double distance) {
  const double eps = resistance.band.half_thickness;
  if (!(distance < eps)) return 0;
  return resistance.factor * (1 + cosine_of_pi(distance / eps)) / (2 * eps);
}

// Returns the derivative of K with respect to the distance from the middle of the band. The derivative is a sine, which is 0 in
// the middle and at the edge of the band. The angle of the sine is measured from the nearer of these two places, because this
// loses fewer digits.
double slope_at(const Resistance &resistance, double distance) {
  const double eps = resistance.band.half_thickness;
  if (!(distance < eps)) return 0;
  const double sine = sine_of_pi(std::min(distance, eps - distance) / eps);
  return -(resistance.factor / (2 * eps)) * (pi / eps) * sine;
}

// A cut rim leaves out the nodes whose closest point is on the rim. Returns whether entry i of the list is such a node.
bool is_beyond_rim(const Resistance &resistance, const ListedNodes &list, std::int64_t i) {
  return resistance.cuts_rim && view(list.fields.rim)[i];
}

// Returns the distance from the middle of the band at entry i of a list. Outside the band this distance is at least the half
// thickness.
double distance_from_middle(const Band &band, const ListedNodes &list, std::int64_t i) {
  const double distance = view(list.nodes.distance)[i];
  if (!band.steps_aside()) return distance;
  const double height = view(list.fields.height)[i];
  // An unmarked node must have no resistance, even if rounding puts its computed distance from the middle slightly below the half
  // thickness.
  return band.holds(distance, height) ? band.distance_from_middle(distance, height) : band.half_thickness;
}

// Returns K at entry i of a list.
double coefficient_at(const Resistance &resistance, const ListedNodes &list, std::int64_t i) {
  return is_beyond_rim(resistance, list, i)
             ? 0
             : coefficient_at(resistance, distance_from_middle(resistance.band, list, i));
}

// Writes the derivatives of K at entry i of a list.
void write_gradients(const Resistance &resistance, std::int64_t n_directions, std::int64_t i, ListedNodes &list) {
  const double from_middle = distance_from_middle(resistance.band, list, i);
  const double slope = is_beyond_rim(resistance, list, i) ? 0 : slope_at(resistance, from_middle);
  for (std::int64_t at = n_directions * i; at < n_directions * (i + 1); ++at) {
    double rate = view(list.fields.distance_gradient)[at];
    if (resistance.band.steps_aside())
      rate = from_middle > 0 ? resistance.band.middle_rate(view(list.nodes.distance)[i], from_middle, rate,
                                                           view(list.fields.height_gradient)[at])
                             : 0;
    view(list.k_gradient)[at] = slope * rate;
  }
}

// Calls visit(i, K) for each entry i of the range whose K is above 0, in ascending order.
template <class Visit>
void for_each_resistance(const Marks &marks, const Resistance &resistance, const Range &range, const Visit &visit) {
  for (std::int64_t i = range.begin; i < range.end; ++i) {
    const double k = coefficient_at(resistance, marks.within, i);
    if (k > 0) visit(i, k);
  }
}

Vec3 vector_at(const UnfilledVector<double> &list, std::int64_t i) {
  return {view(list)[3 * i], view(list)[3 * i + 1], view(list)[3 * i + 2]};
}

// Calls visit(i, force) for each entry i whose K is above 0, in ascending order. The force is the flow's force on the surface.
template <class Visit>
void for_each_force(const Marks &marks, const Resistance &resistance, const riis_flow_arrays &flow,
                    const Visit &visit) {
  const bool moves = (marks.data.fields & RIIS_FIELD_VELOCITY) != 0;
  for_each_resistance(marks, resistance, {0, marks.within.nodes.size()}, [&](std::int64_t i, double k) {
    const std::int64_t node = view(marks.within.nodes.node_id)[i];
    const Vec3 surface_velocity = moves ? vector_at(marks.within.fields.velocity, i) : Vec3{0, 0, 0};
    const auto component = [&](int c, double of_surface) {
      return flow.weight[node] * (k * (flow.velocity[c][flow.velocity_stride * node] - of_surface));
    };
    visit(i,
          Vec3{component(0, surface_velocity.x), component(1, surface_velocity.y), component(2, surface_velocity.z)});
  });
}

void require_field(const Marks &marks, std::int32_t field, const char *field_name, const char *what) {
  if (!(marks.data.fields & field))
    fail(RIIS_INVALID_ARGUMENT, what, " needs ", field_name,
         ", but the nodes were marked with options.fields = ", marks.data.given_fields);
}

struct Wrench {
  std::array<Sum, 3> force, moment;

  void add(Vec3 more_force, Vec3 more_moment) {
    force[0].add(more_force.x), force[1].add(more_force.y), force[2].add(more_force.z);
    moment[0].add(more_moment.x), moment[1].add(more_moment.y), moment[2].add(more_moment.z);
  }
};

void add_sum(const std::array<Sum, 3> &sum, double *to) {
  for (std::size_t c = 0; c < 3; ++c) to[c] += sum[c].total();
}

// Adds the sums to the caller's arrays of shape (3, n). Each array may be null.
void add_sums(const Vector<Wrench> &sums, double *force, double *moment) {
  for (std::int64_t i = 0; i < view(sums).size(); ++i) {
    if (force) add_sum(view(sums)[i].force, force + 3 * i);
    if (moment) add_sum(view(sums)[i].moment, moment + 3 * i);
  }
}

// Compares n_leaflets with the leaflets of the surface, not with those of the marked nodes. A rank may have no node of the last
// leaflet, but all ranks must refuse a wrong n_leaflets.
void check_leaflets(const Marks &marks, const riis_reaction &to) {
  const std::int32_t last = marks.leaflet_ids.empty() ? -1 : marks.leaflet_ids.back();
  if (to.n_leaflets <= last)
    fail(RIIS_INVALID_ARGUMENT, "reaction.n_leaflets is ", to.n_leaflets, ", but the surface has the leaflet id ", last,
         "; n_leaflets must be larger");
}

// Refuses a surface that lacks the closest triangle of a node. An updated surface is accepted if its triangles have kept their
// ids and leaflets.
void check_closest_triangles(const Marks &marks, const TriangleSet &triangles, const TrianglePositions &positions) {
  const NodeList &nodes = marks.within.nodes;
  for (std::int64_t i = 0; i < nodes.size(); ++i) {
    const std::int64_t id = view(nodes.triangle_id)[i], at = positions.of(id);
    if (at < triangles.n_triangles() && view(triangles.triangle_id)[at] == id &&
        view(triangles.leaflet_id)[at] == view(nodes.leaflet_id)[i])
      continue;
    fail(RIIS_INVALID_ARGUMENT, "the closest triangle of node ", view(nodes.node_id)[i], " is ", id, " of leaflet ",
         view(nodes.leaflet_id)[i], ", which the surface lacks: mark the nodes again");
  }
}

Edges edges_of(const riis_reaction &reaction) {
  if (reaction.n_edges < 1) fail(RIIS_INVALID_ARGUMENT, "reaction.n_edges is 0; forces at edges need at least 1 edge");
  return checked_edges("reaction", reaction.n_edges, reaction.edges, reaction.edge_leaflet_id);
}

// Threads work on blocks of nodes_per_block nodes. A list of fewer than few_nodes nodes is handled by one thread.
constexpr std::int64_t nodes_per_block = 4096, few_nodes = 16384;
// The search for nearest edges has smaller limits, because each node takes ten times as long.
constexpr std::int64_t edge_nodes_per_block = 512, few_edge_nodes = 2048;

// For each node, finds the nearest edge, to which the force of the node is added. The entries of nodes without resistance have no
// meaning.
Vector<std::int64_t> nearest_edges(const Marks &marks, const Resistance &resistance, const Edges &edges) {
  const NearestEdges search(edges);
  for (const std::int32_t leaflet : marks.leaflet_ids)
    if (!search.has(leaflet))
      fail(RIIS_INVALID_ARGUMENT, "reaction.edge_leaflet_id has no edge of leaflet ", leaflet,
           ", which the surface has");
  const std::int64_t n = marks.within.nodes.size();
  Vector<std::int64_t> nearest;
  resize(nearest, n);
  parallel_for_ranges(
      n, edge_nodes_per_block, marks.n_threads.for_part(n, few_edge_nodes), [&](const Range &range, int) {
        for_each_resistance(marks, resistance, range, [&](std::int64_t i, double) {
          view(nearest)[i] = search.of(view(marks.within.nodes.leaflet_id)[i], vector_at(marks.within.fields.point, i));
        });
      });
  return nearest;
}

}  // namespace

Resistance checked_resistance(const riis_resistance &resistance, const char *name, const Band &band,
                              double distance_limit) {
  check_range(name, "R", resistance.R, 0, 1e60);
  // So small an R arises if a number in single precision is read as a double. The band would then have no resistance.
  if (resistance.R > 0 && resistance.R < 1e-300)
    fail(RIIS_INVALID_ARGUMENT, name, ".R is ", resistance.R,
         "; it must be 0, or from 1e-300 to 1e+60. Is it a REAL*4 or a float?");
  const double eps = resistance.half_thickness == RIIS_AUTO ? band.half_thickness : resistance.half_thickness;
  const Band own = band.with(eps);
  if (!(eps >= 1e-50 && own.reach() <= distance_limit)) {
    if (!band.steps_aside())
      fail(RIIS_INVALID_ARGUMENT, name, ".half_thickness is ", eps,
           "; it must be from 1e-50 to the distance limit of the marking, ", distance_limit);
    fail(RIIS_INVALID_ARGUMENT, name, ".half_thickness is ", eps, ", so with the offset ", band.offset,
         " its band reaches ", own.reach(),
         "; the half thickness must be at least 1e-50, and its band must be within "
         "the distance limit of the marking, ",
         distance_limit);
  }
  if (resistance.rim != RIIS_RIM_ROUND && resistance.rim != RIIS_RIM_CUT)
    fail(RIIS_INVALID_ARGUMENT, name, ".rim is ", resistance.rim, "; it must be RIIS_RIM_ROUND or RIIS_RIM_CUT");
  if (resistance.reserved != 0)
    fail(RIIS_INVALID_ARGUMENT, name, ".reserved is ", resistance.reserved, "; it must be 0");
  return {resistance.R / eps, own, resistance.rim == RIIS_RIM_CUT};
}

Resistance checked_resistance(const riis_resistance &resistance, const Marks &marks) {
  if (!marks.was_marked) fail(RIIS_INVALID_ARGUMENT, "marks are empty: first call riis_mark_nodes with these marks");
  const Resistance checked = checked_resistance(resistance, "resistance", marks.band, marks.distance_limit);
  if (checked.cuts_rim) require_field(marks, RIIS_FIELD_RIM, "RIIS_FIELD_RIM", "RIIS_RIM_CUT");
  return checked;
}

void list_resistance(const Resistance *resistance, const WantedData &data, const Threads &n_threads,
                     ListedNodes &list) {
  const std::int64_t n = list.nodes.size();
  resize(list.k, data.k ? n : 0);
  resize(list.k_u_surface, data.k_u_surface ? 3 * n : 0);
  resize(list.k_gradient, data.n_k_gradients() * n);
  if (!data.k) return;
  parallel_for_ranges(n, nodes_per_block, n_threads.for_part(n, few_nodes), [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      const double k = view(list.k)[i] = coefficient_at(*resistance, list, i);
      if (data.k_u_surface)
        for (std::int64_t at = 3 * i; at < 3 * i + 3; ++at)
          view(list.k_u_surface)[at] = k * view(list.fields.velocity)[at];
      if (data.n_directions > 0) write_gradients(*resistance, data.n_directions, i, list);
    }
  });
}

void add_resistance(const Marks &marks, const Resistance &resistance, const riis_resistance_arrays &to) {
  const bool adds_k_u = to.K_u_surface[0] != nullptr;
  if (adds_k_u) require_field(marks, RIIS_FIELD_VELOCITY, "RIIS_FIELD_VELOCITY", "arrays.K_u_surface");
  const auto node_id = view(marks.within.nodes.node_id);
  const double *velocity = marks.within.fields.velocity.data();
  // If a node's three components are adjacent, one prefetch serves all of them.
  const int n_lines = adds_k_u && to.K_u_surface[1] == to.K_u_surface[0] + 1 ? 1 : 3;
  const int n_threads = marks.n_threads.for_part(node_id.size(), few_nodes);
  parallel_for_ranges(node_id.size(), nodes_per_block, n_threads, [&](const Range &range, int) {
    for_each_resistance(marks, resistance, range, [&](std::int64_t i, double k) {
      // The nodes lie far apart in the caller's arrays, so the entries of later nodes are prefetched.
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

void add_reaction(const Marks &marks, const Resistance &resistance, const riis_flow_arrays &flow,
                  const riis_reaction &to) {
  const bool wants_edges = to.edge_force || to.edge_moment, wants_leaflets = to.leaflet_force || to.leaflet_moment;
  const bool wants_points = wants_edges || to.moment || to.leaflet_moment;
  if (wants_points)
    require_field(marks, RIIS_FIELD_POINT, "RIIS_FIELD_POINT", "reaction with a moment or with forces on edges");
  if (wants_leaflets) check_leaflets(marks, to);
  const Edges edges = wants_edges ? edges_of(to) : Edges{};
  const Vector<std::int64_t> nearest = wants_edges ? nearest_edges(marks, resistance, edges) : Vector<std::int64_t>();
  Wrench whole;
  Vector<Wrench> of_leaflet(static_cast<std::size_t>(wants_leaflets ? to.n_leaflets : 0));
  Vector<Wrench> of_edge(static_cast<std::size_t>(edges.n));
  const Vec3 about{to.about[0], to.about[1], to.about[2]};
  // To get the same bits for any number of threads, a single thread adds the forces in the order of the nodes.
  for_each_force(marks, resistance, flow, [&](std::int64_t i, Vec3 force) {
    const Vec3 point = wants_points ? vector_at(marks.within.fields.point, i) : Vec3{0, 0, 0};
    const Vec3 moment = cross(point - about, force);
    whole.add(force, moment);
    if (wants_leaflets) view(of_leaflet)[view(marks.within.nodes.leaflet_id)[i]].add(force, moment);
    if (!wants_edges) return;
    const std::int64_t edge = view(nearest)[i];
    view(of_edge)[edge].add(force, cross(point - edges.middle(edge), force));
  });
  if (to.force) add_sum(whole.force, to.force);
  if (to.moment) add_sum(whole.moment, to.moment);
  add_sums(of_leaflet, to.leaflet_force, to.leaflet_moment);
  add_sums(of_edge, to.edge_force, to.edge_moment);
}

void add_vertex_reaction(const Marks &marks, const TriangleSet &triangles, const Resistance &resistance,
                         const riis_flow_arrays &flow, double *vertex_force) {
  require_field(marks, RIIS_FIELD_BARYCENTRIC, "RIIS_FIELD_BARYCENTRIC", "riis_marks_add_vertex_reaction");
  const TrianglePositions positions(triangles);
  check_closest_triangles(marks, triangles, positions);
  Vector<std::array<Sum, 3>> of_vertex(static_cast<std::size_t>(triangles.n_vertices()));
  for_each_force(marks, resistance, flow, [&](std::int64_t i, Vec3 force) {
    const std::int64_t triangle = positions.of(view(marks.within.nodes.triangle_id)[i]);
    for (std::int64_t corner = 0; corner < 3; ++corner) {
      const Vec3 share = view(marks.within.fields.barycentric)[3 * i + corner] * force;
      std::array<Sum, 3> &to = view(of_vertex)[view(triangles.vertex_id)[3 * triangle + corner]];
      to[0].add(share.x), to[1].add(share.y), to[2].add(share.z);
    }
  });
  for (std::int64_t i = 0; i < triangles.n_vertices(); ++i) add_sum(view(of_vertex)[i], vertex_force + 3 * i);
}

riis_band_sums band_sums(const Marks &marks, const riis_band &band) {
  require_field(marks, RIIS_FIELD_SIDE, "RIIS_FIELD_SIDE", "riis_marks_get_band_sums");
  require_field(marks, RIIS_FIELD_RIM, "RIIS_FIELD_RIM", "riis_marks_get_band_sums");
  riis_band_sums sums{};
  const NodeList &within = marks.within.nodes;
  for (std::int64_t i = 0; i < within.size(); ++i) {
    if (view(marks.within.fields.rim)[i]) continue;
    double distance = view(within.distance)[i], side = view(marks.within.fields.side)[i];
    if (marks.band.steps_aside()) {
      side = marks.band.height_over_middle(view(marks.within.fields.height)[i]);
      distance = std::abs(side);
    }
    if (side == 0 || !(distance >= band.inner && distance <= band.outer)) continue;
    const std::int64_t node = view(within.node_id)[i];
    const std::size_t at = side < 0 ? 0 : 1;
    sums.sum[at] += band.weight[node] * band.value[node];
    sums.weight[at] += band.weight[node];
    ++sums.n_nodes[at];
  }
  return sums;
}

}  // namespace riis
