// SPDX-License-Identifier: Apache-2.0
// What is computed with sixteen floats or eight doubles at a time, compiled once for each instruction set and chosen at run time.
// Plain data and functions: nothing here may become code that another file has, too.
//
// filter_*: single precision, only to leave out what cannot matter: everything is right to `error` (docs/theory.md, section 8). In the
// surface's frame: relative to its middle, scaled by a power of two to a half extent from 1/2 to 1.
// decide: double precision, the decision kernel (geometry/point_triangle.hpp) to the last bit.
#pragma once

#include <stdint.h>

namespace riis {

constexpr int triangles_per_group = 16, nodes_per_leaf = 32, leaves_per_cluster = 16;
constexpr int nodes_per_cluster = nodes_per_leaf * leaves_per_cluster;

// Up to 16 neighbouring triangles, each in a frame of its own: the first corner a, unit vectors e along a-b, f in its plane, and g
// across it. In (e, f) the corners are (0, 0), (ab, 0) and from these ac along (ac_e, ac_f), bc along (bc_e, bc_f), of unit length.
// Lanes without a triangle repeat the first.
struct alignas(64) TriangleGroup {
  float a[3][triangles_per_group], e[3][triangles_per_group], f[3][triangles_per_group], g[3][triangles_per_group];
  float ab[triangles_per_group], ac[triangles_per_group], bc[triangles_per_group];
  float ac_e[triangles_per_group], ac_f[triangles_per_group], bc_e[triangles_per_group], bc_f[triangles_per_group];
};

// The coordinates of a group's corners: x, y and z of the first, the second and the third.
struct alignas(64) GroupCorners {
  double xyz[9][triangles_per_group];
};

// Where its triangles are: a box along the axes, a box along its own, and one of its corners.
struct GroupBounds {
  float lower[3], upper[3];
  float axis[3][3], from[3], to[3];
  float corner[3];
  float longest_edge;
  int32_t n;                              // triangles
  int32_t triangle[triangles_per_group];  // their positions in the surface's set
};

// Nodes that are near each other, in the mesh's frame. Lanes without a node repeat the last.
struct alignas(64) Leaf {
  float x[nodes_per_leaf], y[nodes_per_leaf], z[nodes_per_leaf];
  uint32_t node[nodes_per_leaf];
};

// Boxes along the axes of up to 16 things, in the mesh's frame. Lanes without one are inside out.
struct alignas(64) Boxes {
  float lower[3][16], upper[3][16];
};

// From the mesh's frame to the surface's: x * ratio + shift, and what the search asks for there.
struct FilterTask {
  float ratio, shift[3];
  float reach_sq;   // of the limit and the error
  float tolerance;  // squares of distances that differ by no more may be of equal distances
  float margin;     // a point is inside a triangle if it is inside by this
  const TriangleGroup *groups;
  const GroupBounds *bounds;
};

// One leaf and the groups it may be near to; filtered in pieces where there are more pairs than room.
struct LeafTask {
  const Leaf *leaf;
  int32_t first_node;    // its place in the cluster
  uint32_t wanted;       // a bit a node
  int32_t *near_groups;  // in any order; left in another
  int32_t n_groups;
  float *lower_bounds;  // room for nodes_per_leaf * n_groups, aligned
  int32_t next_group;   // 0 at first; n_groups when done
  uint32_t rest;        // nodes of it that are left
  uint32_t found;       // nodes that the pairs added last are of, a bit a node
  alignas(64) float best[nodes_per_leaf];
};

// Pairs of a node, by its place in the cluster, and a triangle; with room for 16 more than are ever counted.
struct PairArrays {
  int32_t *node, *triangle;
};

struct FilterKernels {
  // For every candidate group the boxes that it is within reach of: a bit a box. False if there is none at all.
  bool (*near_boxes)(const FilterTask &task, const Boxes &boxes, const int32_t *candidates, int32_t n_candidates,
                     uint16_t *near);
  // Writes pairs of a node and a triangle such that for every node within the limit its closest triangles are among them; returns how
  // many, at most room. Begins, or goes on where it stopped for want of room: 64 are enough to go on.
  int32_t (*filter_leaf)(const FilterTask &task, LeafTask &leaf, const PairArrays &pairs, int32_t room);
  // Squares of the distances, in single precision, of a point (in the surface's frame) to the triangles of a group.
  void (*group_distances)(const TriangleGroup &group, const float *point, float margin, float *distance_sq);
};

struct DecisionKernels {
  // The frames of triangles in the surface's frame, and where they are.
  void (*make_group)(const GroupCorners &corners, TriangleGroup &group, GroupBounds &bounds);
  // Squares of the distances of pairs of a point (x, y, z) and a triangle (9 doubles), both by index; n + 7 are written.
  void (*decide)(int32_t n, const int32_t *point, const int32_t *triangle, const double *points, const double *corners,
                 double *distance_sq);
};

struct Kernels : FilterKernels, DecisionKernels {};

// In the order of preference, the last one first.
enum class InstructionSet : int32_t { baseline = 0, avx2 = 1, avx512 = 2 };
constexpr int n_instruction_sets = 3;

// True if this processor, and its operating system, has it and the library was built with it.
bool has(InstructionSet set);
InstructionSet best_instruction_set();
const Kernels &kernels(InstructionSet set);

}  // namespace riis
