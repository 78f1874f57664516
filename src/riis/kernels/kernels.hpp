// SPDX-License-Identifier: Apache-2.0
// Computations with sixteen floats or eight doubles at a time are compiled once for each instruction set and chosen at
// run time. This header has plain data and functions: nothing here may become code that another file also has.
//
// filter_*: single precision, only to leave out pairs that cannot matter. All results are right to `error`
// (docs/theory.md, section 8). Coordinates are in the surface's frame: relative to its middle, scaled by a power of two
// to a half extent from 1/2 to 1.
// decide, locate: double precision, the decision kernel (geometry/point_triangle.hpp) to the last bit.
#pragma once

#include <stdint.h>

namespace riis {

constexpr int triangles_per_group = 16, nodes_per_leaf = 32, leaves_per_cluster = 16;
constexpr int groups_at_once = 8;
constexpr int nodes_per_cluster = nodes_per_leaf * leaves_per_cluster;

// Up to 16 neighbouring triangles, each in a frame of its own: the first corner a, and unit vectors e along a-b, f in its plane,
// and g across it. In (e, f) the first two corners are (0, 0) and (ab, 0). The third is ac along (ac_e, ac_f) from the first,
// and bc along (bc_e, bc_f) from the second; both directions have unit length. Lanes without a triangle repeat the first.
struct alignas(64) TriangleGroup {
  float a[3][triangles_per_group], e[3][triangles_per_group], f[3][triangles_per_group], g[3][triangles_per_group];
  float ab[triangles_per_group], ac[triangles_per_group], bc[triangles_per_group];
  float ac_e[triangles_per_group], ac_f[triangles_per_group], bc_e[triangles_per_group], bc_f[triangles_per_group];
};

// The coordinates of a group's corners: x, y and z of the first, the second and the third.
struct alignas(64) GroupCorners {
  double xyz[9][triangles_per_group];
};

// Coordinates relative to the surface are (x - centre) * scale.
struct SurfaceFrame {
  double centre[3], scale;
};

// The place of a group's triangles: a box along the axes, a box along the group's own axes, and one of the corners.
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

// Boxes along the axes of up to 16 things, in the mesh's frame. Lanes without a box are inside out.
struct alignas(64) Boxes {
  float lower[3][16], upper[3][16];
};

// Maps the mesh's frame to the surface's by x * ratio + shift, and holds the limits of the search there.
struct FilterTask {
  float ratio, shift[3];
  float reach_sq;   // square of the limit plus twice the error
  float tolerance;  // squares of equal distances differ by at most this
  float margin;     // a point counts as inside a triangle if it is inside by this
  const TriangleGroup *groups;
  const GroupBounds *bounds;
};

// One leaf and the groups that may be near it. It is filtered in pieces if there are more pairs than room.
struct LeafTask {
  const Leaf *leaf;
  int32_t first_node;    // its place in the cluster
  uint32_t wanted;       // a bit for each node
  int32_t *near_groups;  // in any order; the filter changes the order
  int32_t n_groups;
  float *lower_bounds;  // room for nodes_per_leaf * n_groups, aligned
  int32_t next_group;   // 0 at first; n_groups when done
  uint32_t rest;        // nodes that next_group still has to be compared with
  uint32_t found;       // nodes of the pairs added last, a bit for each node
  alignas(64) float best[nodes_per_leaf];
};

// Pairs of a node, by its place in the cluster, and a triangle. There is room for 16 more than are ever counted.
struct PairArrays {
  int32_t *node, *triangle;
};

// Eight pairs of a point, coordinate by coordinate, and a triangle. Lanes without a pair repeat another.
constexpr int pairs_at_once = 8;
struct alignas(64) PointsAndTriangles {
  double point[3][pairs_at_once];
  const double *corners[pairs_at_once];  // x, y, z of the first corner, then of the second and the third
};
// The closest points of these pairs, coordinate by coordinate.
struct alignas(64) PointsOnTriangles {
  double distance_sq[pairs_at_once];
  double point[3][pairs_at_once], barycentric[3][pairs_at_once];
  uint32_t at_border;  // a bit for each lane: whether one of its weights is 0
};

// Fields interpolate these numbers between the vertices of a triangle: the velocity, u and v, and three zeros.
struct alignas(64) VertexNumbers {
  double number[8];
};
constexpr int uv_in_numbers = 3;

// Eight triangles: the unit normal, twice the area, and the products of the two edges at the first and at the second corner.
struct alignas(64) TriangleMeasures {
  double normal[3][pairs_at_once], twice_area[pairs_at_once], product_at_a[pairs_at_once], product_at_b[pairs_at_once];
};

// The place of an image of a patch, then that of the whole surface: columns of matrices, with a zero behind each.
struct alignas(64) PlacedBy {
  double of_image[3][4], offset_of_image[4], rotation[3][4], translation[4], scale;
};

// The most keys that are ranked together: two leaves.
constexpr int32_t keys_at_once = 2 * nodes_per_leaf;

struct FilterKernels {
  // Writes a bit for each box within the reach of each candidate group. Returns false if no box is within any reach.
  bool (*near_boxes)(const FilterTask &task, const Boxes &boxes, const int32_t *candidates, int32_t n_candidates,
                     uint16_t *near);
  // Writes pairs of a node and a triangle, at most room, and returns their number. For every node within the limit, its closest
  // triangles are among the pairs. A call begins, or goes on where the last one stopped for lack of room. Room for 64 pairs is
  // enough to go on.
  int32_t (*filter_leaf)(const FilterTask &task, LeafTask &leaf, const PairArrays &pairs, int32_t room);
  // Computes squares of the distances, in single precision, of a point (in the surface's frame) to the triangles of a group.
  void (*group_distances)(const TriangleGroup &group, const float *point, float margin, float *distance_sq);
  // Counts for each key how many of the first n keys are less, n <= keys_at_once. If the keys differ, that count is the key's
  // place in ascending order. Both arrays are aligned to 64 bytes, and have room for keys_at_once.
  void (*rank)(const int32_t *key, int32_t n, int32_t *n_less);
};

struct DecisionKernels {
  // Copies the corners of n triangles (9 doubles each), given by the ids of vertices, and finds their least and greatest
  // coordinates, n > 0.
  void (*take_corners)(const double *vertices, const int64_t *vertex_id, int64_t n, double *corners, double *lower,
                       double *upper);
  // Checks up to eight triangles, given by the ids of vertices. Returns false if one may have no area, now or after its corners
  // move by up to an eighth of `shift`. The square of twice the area must exceed the sum of 4e-23 (|ab|^2 + |ac|^2)^2 and shift^2
  // (|ab|^2 + |ac|^2).
  bool (*have_area)(const double *vertices, const int64_t *vertex_id, int32_t n, double shift);
  // Places n points (3, n), with the bits of place(placement, place(image, p)).
  void (*place_points)(const PlacedBy &by, const double *points, int64_t n, double *placed);
  // Measures up to eight triangles, given by the ids of vertices. The normals have the bits of triangle_normal.
  void (*measure_triangles)(const double *vertices, const int64_t *vertex_id, int32_t n, TriangleMeasures &measures);
  // Takes the corners of up to 16 triangles, given by index, to the surface's frame.
  void (*frame_group)(const SurfaceFrame &frame, const double *corners, const int32_t *triangle, int32_t n,
                      GroupCorners &framed);
  // Makes the frames and the bounds of up to eight groups of triangles from their corners in the surface's frame.
  void (*make_groups)(const GroupCorners *corners, int32_t n, TriangleGroup *groups, GroupBounds *bounds);
  // Computes squares of the distances of pairs of a point (x, y, z) and a triangle (9 doubles), both given by index.
  // Writes up to n + 7 squares.
  void (*decide)(int32_t n, const int32_t *point, const int32_t *triangle, const double *points, const double *corners,
                 double *distance_sq);
  // Finds the closest points themselves, with the bits of closest_point_on_triangle.
  void (*locate)(const PointsAndTriangles &pairs, PointsOnTriangles &located);
  // Mixes the numbers of three vertices by the weights of each located point. `vertex` has the ids of each pair's vertices.
  void (*mix_at_vertices)(const VertexNumbers *numbers, const int64_t *const *vertex, const PointsOnTriangles &located,
                          VertexNumbers *mixed);
  // Finds the side of each point: +1, -1 or 0 by its height over the located point, along a normal given by coordinates.
  void (*find_sides)(const PointsAndTriangles &pairs, const PointsOnTriangles &located,
                     const double (&normal)[3][pairs_at_once], int32_t *side);
};

struct Kernels : FilterKernels, DecisionKernels {};

// Instruction sets in ascending order of preference.
enum class InstructionSet : int32_t { baseline = 0, avx2 = 1, avx512 = 2 };
constexpr int n_instruction_sets = 3;

// Returns true if this processor and its operating system have the instruction set, and the library was built with it.
bool has(InstructionSet set);
InstructionSet best_instruction_set();
const Kernels &kernels(InstructionSet set);

}  // namespace riis
