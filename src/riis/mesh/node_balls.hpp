// SPDX-License-Identifier: Apache-2.0
// The mesh's nodes in balls. A ball holds 32 nodes near each other, and a large ball holds 16 balls. The neighbour search can
// dismiss all nodes of a ball at once. The order of the nodes is made once for a mesh. When nodes move, the order stays, and the
// balls are made again.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/strided.hpp"
#include "parallel/range.hpp"

namespace riis {

struct Ball {
  Vec3 centre;
  double radius;  // at least the distance from the centre to each of its nodes
};

struct NodeBalls {
  static constexpr std::int64_t nodes_per_ball = 32, balls_per_large_ball = 16;

  std::vector<std::int64_t> order;  // all nodes, ball by ball
  std::vector<Ball> balls, large_balls;

  Range nodes_of(std::int64_t ball) const;  // positions in order
  Range balls_of(std::int64_t large_ball) const;
};

// Makes the order. This function and the next fail with RIIS_INVALID_MESH for an unusable coordinate.
void sort_into_balls(const StridedPoints &nodes, const Bounds &bounds, int n_threads, NodeBalls &balls);

// Makes the balls and the large balls from the order.
void enclose(const StridedPoints &nodes, int n_threads, NodeBalls &balls);

}  // namespace riis
