// SPDX-License-Identifier: Apache-2.0
#include "marking/mesh.hpp"

#include <algorithm>
#include <atomic>

#include "api/errors.hpp"
#include "parallel/parallel_for.hpp"
#include "surface/triangle_set.hpp"

namespace riis {
namespace {

constexpr std::int64_t nodes_per_block = 65536;

// Number of the first unusable point, or n.
std::int64_t first_unusable(const StridedPoints &points) {
  std::atomic<std::int64_t> first{points.n};
  const std::int64_t n_blocks = (points.n + nodes_per_block - 1) / nodes_per_block;
  parallel_for(n_blocks, default_thread_count(), [&](std::int64_t block, int) {
    const std::int64_t begin = block * nodes_per_block, end = std::min(begin + nodes_per_block, points.n);
    for (std::int64_t i = begin; i < end; ++i) {
      if (is_usable(points[i], max_coordinate)) continue;
      for (std::int64_t seen = first.load(); i < seen && !first.compare_exchange_weak(seen, i);) {
      }
      return;
    }
  });
  return first;
}

}  // namespace

void check_points(const StridedPoints &points, const char *what, riis_status bad_coordinate) {
  require(points.x, "x");
  require(points.y, "y");
  require(points.z, "z");
  if (points.stride < 1)
    fail(RIIS_INVALID_ARGUMENT, "stride is %lld; it must be at least 1", static_cast<long long>(points.stride));
  const std::int64_t bad = first_unusable(points);
  if (bad == points.n) return;
  const Vec3 p = points[bad];
  const auto complain = [&](const char *axis, double value) {
    if (!(std::abs(value) <= max_coordinate))
      fail(bad_coordinate, "%s of %s %lld is %g; it must be finite and at most %g in magnitude", axis, what,
           static_cast<long long>(bad), value, max_coordinate);
  };
  complain("x", p.x);
  complain("y", p.y);
  complain("z", p.z);
}

Mesh make_mesh(const StridedPoints &nodes) {
  if (nodes.n < 1)
    fail(RIIS_INVALID_MESH, "n_nodes is %lld; a mesh has at least 1 node", static_cast<long long>(nodes.n));
  check_points(nodes, "node", RIIS_INVALID_MESH);
  return {nodes};
}

}  // namespace riis
