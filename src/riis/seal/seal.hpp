// SPDX-License-Identifier: Apache-2.0
// Three ways to find out whether marks seal a valve: leaks, open regions, and the widest passage.
#pragma once

#include <riis/riis.h>

#include <array>
#include <cstdint>
#include <vector>

#include "common/array_view.hpp"
#include "geometry/vec3.hpp"
#include "marks/marks.hpp"
#include "mesh/adjacency.hpp"
#include "search/search.hpp"

namespace riis {

// Leaks are edges of the mesh that cross the surface between two unmarked nodes. Flow can pass through the valve along these
// edges. The mesh must have an adjacency. The leaking edges are listed in ascending order.

// Edges between two unmarked nodes that cross the surface, in ascending order. The members are documented in riis_leak_list.
struct Leaks {
  std::vector<std::int64_t> node_id;  // (2, n)
  std::vector<double> length, distance;
  double half_thickness = 0;
  std::int64_t longest_node_id[2] = {-1, -1};
  double longest_length = 0;
  Vec3 longest_middle{0, 0, 0};
  double seconds = 0;
};

// Coordinates of a magnitude below this number count as 0, because products of such coordinates would be too small for doubles.
inline constexpr double negligible_coordinate = 1e-90;

// Returns whether the closed segment from a to b and the closed triangle have a point in common. Coordinates must be at most
// max_coordinate in magnitude, and the triangle must have an area (has_zero_area). The answer is exact, without a tolerance or
// rounding. A segment through the common edge of two triangles meets both triangles. The answer does not depend on the order of
// the ends or of the corners.
bool segment_meets_triangle(Vec3 a, Vec3 b, const std::array<Vec3, 3> &corners);

// Finds the leaks. Fails with RIIS_INVALID_MESH for an unusable coordinate. Does not use the request's distance limit.
Leaks find_leaks(const SearchRequest &request, const Marks &marks);

// Open regions are the connected components of the nodes that are open and not masked out. The label of a node is the lowest node
// of its region.

struct OpenNodes {
  const MeshNodes &nodes;
  const std::uint8_t *node_mask;               // or null
  const std::vector<std::int64_t> &closed_id;  // in any order
};

// Writes a label for each row of the edges, and returns the number of regions. The label of a node is the lowest node of its
// region. The label is OpenSets::closed for a node outside all regions, and for a number without a node. An edge may be listed in
// the rows of both its nodes, or in only one of these rows.
template <class Edges>
std::int64_t label_open_regions(const Edges &edges, const OpenNodes &open, int n_threads,
                                ArrayView<std::int64_t> label);

// Disjoint sets of nodes that several threads may unite at the same time, without locks. An array holds the parent of each node,
// which is always a node with a lower number. The root of a set is therefore its lowest node, in whatever order sets were united.
class OpenSets {
 public:
  static constexpr std::int64_t closed = -1;  // the parent of a node that is in no set

  // Borrows the array of parents. Each entry must be `closed`, the node itself, or a lower node of the same set.
  explicit OpenSets(ArrayView<std::int64_t> parent) : parent_(parent) {}

  bool is_open(std::int64_t node) const { return load(node) != closed; }
  // Makes a new set that consists of this node.
  void open(std::int64_t node) { parent_[node] = node; }

  // Returns the lowest node of the node's set. Also halves the path to the lowest node, which makes later calls faster.
  std::int64_t root(std::int64_t node) {
    for (;;) {
      std::int64_t parent = load(node);
      const std::int64_t above = load(parent);
      if (above == parent) return parent;
      replace(node, parent, above);  // may fail: another thread may have found a still lower parent
      node = above;
    }
  }

  // Makes the lowest node of the set the parent of the node, and returns the lowest node. Must not run while other threads unite
  // sets.
  std::int64_t flatten(std::int64_t node) {
    const std::int64_t lowest = root(node);
    __atomic_store_n(&parent_[node], lowest, __ATOMIC_RELAXED);
    return lowest;
  }

  void unite(std::int64_t a, std::int64_t b) {
    for (;;) {
      a = root(a);
      b = root(b);
      if (a == b) return;
      if (replace(a < b ? b : a, a < b ? b : a, a < b ? a : b)) return;
      // Meanwhile another thread has given the higher root a parent, so the loop tries again.
    }
  }

 private:
  // Relaxed atomic operations are enough here, because no other data depends on the parents. All other data are ordered by the
  // end of the parallel loop.
  std::int64_t load(std::int64_t node) const { return __atomic_load_n(&parent_[node], __ATOMIC_RELAXED); }
  bool replace(std::int64_t node, std::int64_t before, std::int64_t parent) {
    return __atomic_compare_exchange_n(&parent_[node], &before, parent, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  }

  ArrayView<std::int64_t> parent_;
};

// The widest passage is the path from one set of nodes to another that stays as far as possible from the surface. The result is
// the node of this path that is nearest to the surface, and the distance of this node.

// The two sets of nodes. Each set has at least one node, and no node of a set is masked out.
struct PassageEnds {
  ArrayView<const std::int64_t> from, to;
};

// Finds the widest passage. Fails with RIIS_INVALID_ARGUMENT if an end is within the half thickness, and with RIIS_INVALID_MESH
// for an unusable coordinate. Does not use the request's distance limit.
riis_passage find_passage(const SearchRequest &request, const PassageEnds &ends);

}  // namespace riis
