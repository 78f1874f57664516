// SPDX-License-Identifier: Apache-2.0
#include "marking/node_groups.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/bounds.hpp"
#include "parallel/concurrent_walk.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

constexpr std::int64_t per_block = 4096;

template <class Visit>
void for_each(std::int64_t n, int n_threads, const Visit &visit) {
  parallel_for_ranges(n, per_block, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) visit(i);
  });
}

Vec3 node_at(const StridedPoints &nodes, std::int64_t i) { return checked_point(nodes, i, "node", RIIS_INVALID_MESH); }

// Every third bit of 63, from the 21 bits of x: how Morton's order interleaves three coordinates.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

struct Key {
  std::uint64_t along_curve;
  std::int64_t node;
};

// A ball's radius is right to a few units of rounding of the coordinates.
double rounded_up(double radius, Vec3 centre) {
  return radius * (1 + 1e-15) + 1e-15 * (std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z));
}

}  // namespace

Range NodeGroups::nodes_of(std::int64_t group) const {
  return {group * group_size, std::min((group + 1) * group_size, static_cast<std::int64_t>(order.size()))};
}

Range NodeGroups::groups_of(std::int64_t supergroup) const {
  return {supergroup * groups_per_supergroup,
          std::min((supergroup + 1) * groups_per_supergroup, static_cast<std::int64_t>(groups.size()))};
}

void sort_into_groups(const StridedPoints &nodes, int n_threads, NodeGroups &groups) {
  Bounds box;
  for (std::int64_t i = 0; i < nodes.n; ++i) box.add(node_at(nodes, i));
  const Vec3 extent = box.half_extent();
  const double longest = std::max({extent.x, extent.y, extent.z});
  const auto cell = [&](double x, double lower) {
    const double share = longest > 0 ? (0.5 * x - 0.5 * lower) / longest : 0;
    return spread(static_cast<std::uint64_t>(std::clamp(share, 0.0, 1.0) * 0x1fffff));
  };
  std::vector<Key> keys(static_cast<std::size_t>(nodes.n));
  for_each(nodes.n, n_threads, [&](std::int64_t i) {
    const Vec3 p = nodes[i];
    keys[static_cast<std::size_t>(i)] = {
        cell(p.x, box.lower.x) | cell(p.y, box.lower.y) << 1 | cell(p.z, box.lower.z) << 2, i};
  });
  concurrent_sort(keys.begin(), keys.end(), n_threads, [](const Key &a, const Key &b) {
    return a.along_curve != b.along_curve ? a.along_curve < b.along_curve : a.node < b.node;
  });
  groups.order.resize(keys.size());
  for_each(nodes.n, n_threads,
           [&](std::int64_t i) { groups.order[static_cast<std::size_t>(i)] = keys[static_cast<std::size_t>(i)].node; });
}

void enclose(const StridedPoints &nodes, int n_threads, NodeGroups &groups) {
  const auto n_of = [](std::size_t n, std::int64_t size) {
    return (n + static_cast<std::size_t>(size) - 1) / static_cast<std::size_t>(size);
  };
  groups.groups.resize(n_of(groups.order.size(), NodeGroups::group_size));
  groups.supergroups.resize(n_of(groups.groups.size(), NodeGroups::groups_per_supergroup));
  const auto node = [&](std::int64_t at) { return node_at(nodes, groups.order[static_cast<std::size_t>(at)]); };
  for_each(static_cast<std::int64_t>(groups.groups.size()), n_threads, [&](std::int64_t group) {
    const Range range = groups.nodes_of(group);
    Bounds box;
    for (std::int64_t i = range.begin; i < range.end; ++i) box.add(node(i));
    Ball ball{box.middle(), 0};
    for (std::int64_t i = range.begin; i < range.end; ++i)
      ball.radius = std::max(ball.radius, distance(ball.centre, node(i)));
    groups.groups[static_cast<std::size_t>(group)] = {ball.centre, rounded_up(ball.radius, ball.centre)};
  });
  for_each(static_cast<std::int64_t>(groups.supergroups.size()), n_threads, [&](std::int64_t supergroup) {
    const Range range = groups.groups_of(supergroup);
    const auto ball_of = [&](std::int64_t group) { return groups.groups[static_cast<std::size_t>(group)]; };
    Bounds box;
    for (std::int64_t i = range.begin; i < range.end; ++i) box.add(ball_of(i).centre);
    Ball ball{box.middle(), 0};
    for (std::int64_t i = range.begin; i < range.end; ++i)
      ball.radius = std::max(ball.radius, distance(ball.centre, ball_of(i).centre) + ball_of(i).radius);
    groups.supergroups[static_cast<std::size_t>(supergroup)] = {ball.centre, rounded_up(ball.radius, ball.centre)};
  });
}

}  // namespace riis
