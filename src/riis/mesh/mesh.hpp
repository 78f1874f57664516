// SPDX-License-Identifier: Apache-2.0
// The caller's nodes and adjacency, which are checked and normally borrowed. A mesh also owns data that searches need: balls,
// clusters and blocks of edges. Each structure is made when it is first needed.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/made_once.hpp"
#include "geometry/strided.hpp"
#include "geometry/vec3.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/clusters.hpp"
#include "mesh/grid.hpp"
#include "parallel/threads.hpp"

namespace riis {

// The mesh's nodes in balls. A ball holds 32 nodes near each other, and a large ball holds 16 balls. The neighbour search can
// dismiss all nodes of a ball at once. The nodes of a mesh are put in order only once. When nodes move, the order stays, and only
// the balls are made again.
struct Ball {
  Vec3 centre;
  double radius;  // at least the distance from the centre to the farthest of its nodes
};

struct NodeBalls {
  static constexpr std::int64_t nodes_per_ball = 32, balls_per_large_ball = 16;

  std::vector<std::int64_t> order;  // all nodes, ball by ball
  std::vector<Ball> balls, large_balls;

  Range nodes_of(std::int64_t ball) const;  // positions in order
  Range balls_of(std::int64_t large_ball) const;
};

// Makes the order. This function and the next function fail with RIIS_INVALID_MESH for an unusable coordinate.
void sort_into_balls(const StridedPoints &nodes, const Bounds &bounds, int n_threads, NodeBalls &balls);

// Makes the balls and the large balls from the order.
void enclose(const StridedPoints &nodes, int n_threads, NodeBalls &balls);

// The edges of a mesh in blocks of 64 rows. For each block, the length of its longest edge and a box are stored. A search for
// long edges near the surface can skip most blocks as a whole.
struct EdgeBlocks {
  static constexpr std::int64_t rows_per_block = 64;

  struct Block {
    double longest = 0;  // the length of the longest edge in its rows
    Bounds bounds;       // the box around its edges
  };
  std::vector<Block> blocks;
  double longest = 0;  // the length of the mesh's longest edge
};

// Checks whether a mesh and a surface with a half thickness can have the same unit. The check needs only boxes that are already
// known. The check sends a warning to the caller's log function, once for each pair of a mesh and a surface.

// The surfaces that were reported as misfits for a mesh. Several threads may call both functions at once.
class WarnedSurfaces {
 public:
  // Records the number, which must not be 0. Returns true if the number is new. When the list is full, returns false even for a
  // new number.
  bool is_first(std::uint64_t surface_number);
  bool has(std::uint64_t surface_number) const;

 private:
  static constexpr std::size_t capacity = 8;
  std::array<std::atomic<std::uint64_t>, capacity> numbers_{};
};

struct Sizes {
  std::int64_t n_nodes;
  Bounds mesh, surface;
  double half_thickness;
};

// Makes only a few comparisons, however large the mesh is. Positions are not compared, because one process's part of a mesh may
// lie far from the surface.
void check_proportions(const Sizes &sizes, std::uint64_t surface_number, WarnedSurfaces &warned);

// The nodes of a mesh: points, or a grid.
struct MeshNodes {
  std::int64_t n = 0;    // the number of points, or of a grid's numbers
  StridedPoints points;  // none with a grid
  const Grid *grid = nullptr;

  MeshNodes(const StridedPoints &given) : n(given.n), points(given) {}  // NOLINT(google-explicit-constructor)
  explicit MeshNodes(const Grid &given) : n(given.n_numbers()), points{0, nullptr, nullptr, nullptr, 1}, grid(&given) {}
  std::int64_t n_nodes() const { return grid ? grid->all().n_nodes() : n; }
  // Returns node i. In a grid, a node with the number i must exist.
  Vec3 operator[](std::int64_t i) const { return grid ? (*grid)[i] : points[i]; }
  void prefetch(std::int64_t i) const {
    if (!grid) points.prefetch(i);
  }
  bool has_node(std::int64_t i) const { return !grid || grid->has_node(i); }
};

// Returns node i. Fails with RIIS_INVALID_MESH if the caller has changed a coordinate since it was checked.
inline Vec3 checked_node(const MeshNodes &nodes, std::int64_t i) {
  return nodes.grid ? (*nodes.grid)[i] : checked_point(nodes.points, i, "node", RIIS_INVALID_MESH);
}

class Mesh {
 public:
  Mesh(const StridedPoints &nodes, const Bounds &bounds) : nodes_(nodes), bounds_(bounds) {}

  const MeshNodes &nodes() const { return nodes_; }
  const StridedPoints &points() const { return nodes_.points; }
  // Returns the box around the nodes at the time when the caller last gave them.
  const Bounds &bounds() const { return bounds_; }
  const std::optional<Adjacency> &adjacency() const { return adjacency_; }

  // Call this function after the nodes have moved. Balls, clusters and edges are made again when they are next needed.
  void forget_places() {
    balls_.forget();
    clusters_.forget();
    edges_.forget();
  }

  // borrow_nodes and take_grid set new coordinates, of the same nodes or of other nodes. If the number of nodes changes, the
  // adjacency is removed.
  void borrow_nodes(const StridedPoints &nodes, const Bounds &bounds);
  void take_grid(std::unique_ptr<const Grid> grid);
  // Copies the nodes. After a failure the mesh keeps its old nodes.
  template <class Real>
  void copy_nodes(const StridedReals<Real> &nodes, const Bounds &bounds) {
    const auto n = static_cast<std::size_t>(3 * nodes.n);
    if (own_xyz_.capacity() < n) own_xyz_ = with_capacity(n);
    own_xyz_.resize(n);
    double *const xyz = own_xyz_.data();
    for (std::int64_t i = 0; i < nodes.n; ++i) {
      const Vec3 p = nodes[i];
      xyz[3 * i] = p.x, xyz[3 * i + 1] = p.y, xyz[3 * i + 2] = p.z;
    }
    if (nodes.n == 0) return set_nodes(StridedPoints{0, nullptr, nullptr, nullptr, 3}, bounds);
    set_nodes(StridedPoints{nodes.n, xyz, xyz + 1, xyz + 2, 3}, bounds);
  }
  void set_adjacency(const std::optional<Adjacency> &adjacency) {
    adjacency_ = adjacency;
    edges_.forget();
  }

  // Returns the nodes in balls. Several threads may call this function and the next two functions at once.
  const NodeBalls &balls(int n_threads) const;
  // Returns the nodes in clusters. The mesh must have at most max_clustered_nodes nodes.
  const Clusters &clusters(int n_threads) const;
  // Returns the edges in blocks of rows. The mesh must have an adjacency. Fails with RIIS_INVALID_MESH for an unusable
  // coordinate.
  const EdgeBlocks &edges(int n_threads) const;

  // Records that these nodes were marked. Returns whether clusters are worth making. They are if an earlier marking was recorded,
  // or if clusters already exist.
  bool record_marking() const { return was_marked_.exchange(true, std::memory_order_relaxed); }

  // Returns the surfaces whose sizes do not fit this mesh, and about which the caller was already warned.
  WarnedSurfaces &warned_surfaces() const { return warned_surfaces_; }

 private:
  static std::vector<double> with_capacity(std::size_t n) {
    std::vector<double> made;
    made.reserve(n);
    return made;
  }
  void set_nodes(const MeshNodes &nodes, const Bounds &bounds);

  MeshNodes nodes_;
  std::unique_ptr<const Grid> own_grid_;
  std::vector<double> own_xyz_;  // (3, n), used if the nodes are copied
  Bounds bounds_;
  std::optional<Adjacency> adjacency_;
  mutable MadeOnce<NodeBalls> balls_;
  mutable MadeOnce<Clusters> clusters_;
  mutable MadeOnce<EdgeBlocks> edges_;
  mutable std::atomic<bool> was_marked_{false};
  mutable WarnedSurfaces warned_surfaces_;
};

// Calls use(edges) with the edges of a mesh, which must have an adjacency or be a grid.
template <class Use>
auto with_edges(const Mesh &mesh, const Use &use) {
  return mesh.adjacency().has_value() ? use(*mesh.adjacency()) : use(GridEdges{*mesh.nodes().grid});
}

}  // namespace riis
