// SPDX-License-Identifier: Apache-2.0
#include "mesh/node_balls.hpp"

#include <algorithm>
#include <cmath>

#include "common/array_view.hpp"
#include "geometry/bounds.hpp"
#include "mesh/node_order.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

template <class Visit>
void for_each(std::int64_t n, int n_threads, const Visit &visit) {
  constexpr std::int64_t per_block = 4096;
  parallel_for_ranges(n, per_block, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) visit(i);
  });
}

// Returns the radius plus a few units of rounding of the coordinates, because a computed radius may be too small by that much.
double rounded_up(double radius, Vec3 centre) {
  return radius * (1 + 1e-15) + 1e-15 * (std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z));
}

// Returns a ball around the balls of a range. The new centre is the middle of the box around the given centres. A node counts as
// a ball of radius 0.
template <class BallAt>
Ball ball_around(const Range &range, const BallAt &ball_at) {
  Bounds box;
  for (std::int64_t i = range.begin; i < range.end; ++i) box.add(ball_at(i).centre);
  Ball ball{box.middle(), 0};
  for (std::int64_t i = range.begin; i < range.end; ++i) {
    const Ball inner = ball_at(i);
    ball.radius = std::max(ball.radius, distance(ball.centre, inner.centre) + inner.radius);
  }
  return {ball.centre, rounded_up(ball.radius, ball.centre)};
}

std::int64_t n_parts(std::int64_t n, std::int64_t size) { return (n + size - 1) / size; }

}  // namespace

Range NodeBalls::nodes_of(std::int64_t ball) const {
  return {ball * nodes_per_ball, std::min((ball + 1) * nodes_per_ball, view(order).size())};
}

Range NodeBalls::balls_of(std::int64_t large_ball) const {
  return {large_ball * balls_per_large_ball, std::min((large_ball + 1) * balls_per_large_ball, view(balls).size())};
}

void sort_into_balls(const StridedPoints &nodes, const Bounds &bounds, int n_threads, NodeBalls &balls) {
  NodeItems<std::int64_t> sorted = items_of<std::int64_t>(nodes, frame_around(bounds), n_threads), buffer;
  NodeSorter<std::int64_t>(sorted, buffer, Cuts::by_clusters, n_threads).sort();
  balls.order.resize(sorted.size());
  for_each(nodes.n, n_threads, [&](std::int64_t i) { view(balls.order)[i] = view(sorted)[i].node; });
}

void enclose(const StridedPoints &nodes, int n_threads, NodeBalls &balls) {
  resize(balls.balls, n_parts(view(balls.order).size(), NodeBalls::nodes_per_ball));
  resize(balls.large_balls, n_parts(view(balls.balls).size(), NodeBalls::balls_per_large_ball));
  for_each(view(balls.balls).size(), n_threads, [&](std::int64_t ball) {
    view(balls.balls)[ball] = ball_around(balls.nodes_of(ball), [&](std::int64_t at) {
      return Ball{node_at(nodes, view(balls.order)[at]), 0};
    });
  });
  for_each(view(balls.large_balls).size(), n_threads, [&](std::int64_t large_ball) {
    view(balls.large_balls)[large_ball] =
        ball_around(balls.balls_of(large_ball), [&](std::int64_t ball) { return view(balls.balls)[ball]; });
  });
}

}  // namespace riis
