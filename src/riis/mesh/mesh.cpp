// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.hpp"
#include "base/log.hpp"
#include "common/array_view.hpp"
#include "geometry/vec3.hpp"
#include "mesh/node_order.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

EdgeBlocks::Block block_of(const MeshNodes &nodes, const Adjacency &adjacency, std::int64_t begin) {
  EdgeBlocks::Block made;
  const std::int64_t end = std::min(begin + EdgeBlocks::rows_per_block, nodes.n);
  for (std::int64_t i = begin; i < end; ++i) {
    const Vec3 p = checked_node(nodes, i);
    adjacency.for_each_neighbor(i, [&](std::int64_t j) {
      const Vec3 q = checked_node(nodes, j);
      made.longest = std::max(made.longest, distance(p, q));
      made.bounds.add(p);
      made.bounds.add(q);
    });
  }
  return made;
}

EdgeBlocks edge_blocks(const MeshNodes &nodes, const Adjacency &adjacency, int n_threads) {
  constexpr std::int64_t blocks_per_task = 64;
  EdgeBlocks made;
  const std::int64_t n_blocks = (nodes.n + EdgeBlocks::rows_per_block - 1) / EdgeBlocks::rows_per_block;
  resize(made.blocks, n_blocks);
  parallel_for_ranges(n_blocks, blocks_per_task, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i)
      view(made.blocks)[i] = block_of(nodes, adjacency, i * EdgeBlocks::rows_per_block);
  });
  for (const EdgeBlocks::Block &block : made.blocks) made.longest = std::max(made.longest, block.longest);
  return made;
}

}  // namespace

void Mesh::borrow_nodes(const StridedPoints &nodes, const Bounds &bounds) {
  set_nodes(nodes, bounds);
  own_xyz_ = {};
}

void Mesh::take_grid(std::unique_ptr<const Grid> grid) {
  set_nodes(MeshNodes(*grid), grid->bounds());
  own_grid_ = std::move(grid);
  own_xyz_ = {};
}

void Mesh::set_nodes(const MeshNodes &nodes, const Bounds &bounds) {
  if (nodes.n != nodes_.n || nodes.grid || nodes_.grid) {
    adjacency_.reset();
    balls_.forget().order.clear();
    clusters_.forget().n_nodes = 0;
    was_marked_.store(false, std::memory_order_relaxed);
  }
  nodes_ = nodes;
  if (!nodes.grid) own_grid_.reset();
  bounds_ = bounds;
  forget_places();
}

const NodeBalls &Mesh::balls(int n_threads) const {
  return balls_.get([&](NodeBalls &balls) {
    // If the nodes have moved, their order is kept. It stays useful as long as neighbouring nodes stay near each other.
    if (balls.order.empty()) sort_into_balls(points(), bounds_, n_threads, balls);
    enclose(points(), n_threads, balls);
  });
}

const Clusters &Mesh::clusters(int n_threads) const {
  return clusters_.get([&](Clusters &clusters) {
    if (clusters.n_nodes == 0)
      sort_into_clusters(points(), bounds_, n_threads, clusters);
    else
      place_clusters(points(), bounds_, n_threads, clusters);
    was_marked_.store(true, std::memory_order_relaxed);
  });
}

const EdgeBlocks &Mesh::edges(int n_threads) const {
  return edges_.get([&](EdgeBlocks &edges) { edges = edge_blocks(nodes_, *adjacency_, n_threads); });
}

namespace {

double largest_side(const Bounds &bounds) {
  const Vec3 extent = bounds.upper - bounds.lower;
  return std::max({extent.x, extent.y, extent.z});
}

// Returns a message about two sizes that do not fit together, or NULL if all sizes fit.
const char *misfit(double mesh, double surface, double half_thickness) {
  constexpr double most = 50;
  if (surface > most * mesh) return "the surface is more than 50 times as large as the mesh";
  if (mesh > most * surface) return "the mesh is more than 50 times as large as the surface";
  if (half_thickness > surface) return "the half thickness is larger than the surface";
  if (half_thickness > mesh) return "the half thickness is larger than the mesh";
  return nullptr;
}

}  // namespace

bool WarnedSurfaces::has(std::uint64_t surface_number) const {
  return std::any_of(numbers_.begin(), numbers_.end(), [&](const std::atomic<std::uint64_t> &number) {
    return number.load(std::memory_order_relaxed) == surface_number;
  });
}

bool WarnedSurfaces::is_first(std::uint64_t surface_number) {
  for (std::atomic<std::uint64_t> &number : numbers_) {
    std::uint64_t found = 0;
    if (number.compare_exchange_strong(found, surface_number, std::memory_order_relaxed)) return true;
    if (found == surface_number) return false;
  }
  return false;
}

void check_proportions(const Sizes &sizes, std::uint64_t surface_number, WarnedSurfaces &warned) {
  // Meshes with fewer nodes are not checked, because the box of a few nodes may have any size.
  constexpr std::int64_t fewest_nodes = 1000;
  if (sizes.n_nodes < fewest_nodes) return;
  const double mesh = largest_side(sizes.mesh), surface = largest_side(sizes.surface);
  const char *what = misfit(mesh, surface, sizes.half_thickness);
  if (!what || warned.has(surface_number) || !is_logging() || !warned.is_first(surface_number)) return;
  constexpr int digits = 6;
  log_message(RIIS_LOG_WARNING, what, ": largest sides of their boxes are ", rounded(mesh, digits), " (mesh of ",
              sizes.n_nodes, " nodes) and ", rounded(surface, digits), " (surface), the half thickness is ",
              rounded(sizes.half_thickness, digits),
              "; are all in one unit? See scale and half_thickness of riis_surface_options");
}

namespace {

template <class Visit>
void for_each(std::int64_t n, int n_threads, const Visit &visit) {
  constexpr std::int64_t per_block = 4096;
  parallel_for_ranges(n, per_block, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) visit(i);
  });
}

// Rounding of the coordinates may have made the computed radius slightly too small. Returns the radius plus this possible error.
double rounded_up(double radius, Vec3 centre) {
  return radius * (1 + 1e-15) + 1e-15 * (std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z));
}

// Returns a ball around the balls of a range. The new ball's centre is the middle of the box around the centres of the given
// balls. A node counts as a ball of radius 0.
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
