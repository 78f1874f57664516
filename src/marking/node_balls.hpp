// SPDX-License-Identifier: Apache-2.0
// The mesh's nodes in balls of 32 near ones, and 16 balls to a larger one: the neighbour search dismisses the nodes of a ball together.
// Made once for a mesh. When nodes move their order stays, and the balls are made again.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/strided.hpp"
#include "parallel/range.hpp"

namespace riis {

struct Ball {
  Vec3 centre;
  double radius;  // at least the distance of each of its nodes
};

struct NodeBalls {
  static constexpr std::int64_t nodes_per_ball = 32, balls_per_large_ball = 16;

  std::vector<std::int64_t> order;  // all nodes, ball after ball
  std::vector<Ball> balls, large_balls;

  Range nodes_of(std::int64_t ball) const;  // positions in order
  Range balls_of(std::int64_t large_ball) const;
};

// Both fail with RIIS_INVALID_MESH for a coordinate that is not finite.
void sort_into_balls(const StridedPoints &nodes, int n_threads, NodeBalls &balls);

// Makes the balls of the order that there is.
void enclose(const StridedPoints &nodes, int n_threads, NodeBalls &balls);

}  // namespace riis
