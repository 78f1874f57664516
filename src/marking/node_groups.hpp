// SPDX-License-Identifier: Apache-2.0
// Nodes in groups of near ones, each in a ball: what a search can dismiss together. Made once for a mesh, by the order of the nodes
// along a space-filling curve; when nodes move the order stays and the balls are made again.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/strided.hpp"
#include "parallel/range.hpp"

namespace riis {

struct Ball {
  Vec3 centre;
  double radius;  // at least the distance of every node of it
};

struct NodeGroups {
  static constexpr std::int64_t group_size = 32, groups_per_supergroup = 16;

  std::vector<std::int64_t> order;  // all nodes; those of a group follow each other
  std::vector<Ball> groups, supergroups;

  Range nodes_of(std::int64_t group) const;  // positions in order
  Range groups_of(std::int64_t supergroup) const;
};

// Both fail with RIIS_INVALID_MESH for a coordinate that is not finite.
void sort_into_groups(const StridedPoints &nodes, int n_threads, NodeGroups &groups);

// Balls around the groups as they are.
void enclose(const StridedPoints &nodes, int n_threads, NodeGroups &groups);

}  // namespace riis
