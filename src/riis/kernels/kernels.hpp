// SPDX-License-Identifier: Apache-2.0
// A kernel is a function that computes sixteen floats or eight doubles at a time. Kernels are compiled once for each instruction
// set, and one set is chosen at run time. This header has only plain data and declarations, because a function body would be
// compiled for several instruction sets under one name.
//
// FilterKernels compute in single precision, and only rule out pairs that cannot matter. Results are accurate to filter_error
// (docs/theory/clusters.md). Coordinates are in the surface's frame: relative to the surface's middle, and scaled by a power of
// two. The scale brings the surface's half extent between 1/2 and 1.
// DecisionKernels compute in double precision, with exactly the bits of the decision kernel (geometry/point_triangle.hpp).
#pragma once

#include <stdint.h>

namespace riis {

constexpr int triangles_per_group = 16, nodes_per_leaf = 32, leaves_per_cluster = 16;
constexpr int groups_at_once = 8;
constexpr int nodes_per_cluster = nodes_per_leaf * leaves_per_cluster;

// Up to 16 neighbouring triangles abc, each in its own frame. The frame's axes are unit vectors. e is along ab, f is in the
// triangle's plane at right angles to e, and g is at right angles to the plane. A point p has the coordinates p.e + e_origin, p.f
// + f_origin and p.g + g_origin, and the frame's origin is the middle of ab. In (e, f), the edge ac has the unit direction (ac_e,
// ac_f). A point (e, f) has the coordinate e ac_e + f ac_f + ac_middle along ac, which is 0 at the middle of ac. Its coordinate
// across ac is e ac_f - f ac_e + ac_side, which is positive on the triangle's side. Its coordinate across bc is f bc_e - e bc_f +
// bc_side. Lanes without a triangle repeat the first triangle, except that their g_origin is beyond_limits.
struct alignas(64) TriangleGroup {
  float e[3][triangles_per_group], f[3][triangles_per_group], g[3][triangles_per_group];
  float e_origin[triangles_per_group], f_origin[triangles_per_group], g_origin[triangles_per_group];
  float half_ab[triangles_per_group], half_ac[triangles_per_group], half_bc[triangles_per_group];
  float ac_e[triangles_per_group], ac_f[triangles_per_group], ac_middle[triangles_per_group],
      ac_side[triangles_per_group];
  float bc_e[triangles_per_group], bc_f[triangles_per_group], bc_middle[triangles_per_group],
      bc_side[triangles_per_group];
};
constexpr float beyond_limits = 0x1p40f;  // its square is finite, and above the square of any limit of a filter

// The coordinates of a group's corners: x, y and z of the first corners, then of the second corners, then of the third corners.
struct alignas(64) GroupCorners {
  double xyz[9][triangles_per_group];
};

// The frame of the surface or of the mesh. The frame takes a coordinate x to (x - centre) * scale.
struct PlainFrame {
  double centre[3], scale;
};

// Bounds of a group's triangles: a box along the coordinate axes, a box along the group's own axes, and one corner of a triangle.
struct GroupBounds {
  float lower[3], upper[3];
  float axis[3][3], from[3], to[3];
  float corner[3];
  float longest_edge;
  int32_t n;                              // the number of triangles
  int32_t triangle[triangles_per_group];  // the triangles' positions in the surface's set
};

// Nodes that are near each other, in the mesh's frame. Lanes without a node repeat the last node.
struct alignas(64) Leaf {
  float x[nodes_per_leaf], y[nodes_per_leaf], z[nodes_per_leaf];
  uint32_t node[nodes_per_leaf];
};

// The boxes of up to 16 leaves or clusters along the coordinate axes, in the mesh's frame. In lanes without a box, the
// lower bounds are above the upper bounds.
struct alignas(64) Boxes {
  float lower[3][16], upper[3][16];
};

// Limits of a filter, in the surface's frame.
struct FilterLimits {
  float reach_sq;   // (limit + 2 * error)^2
  float tolerance;  // the most by which the computed squares of two equal distances differ
  float margin;     // how far inside a triangle a point must be to count as inside
};

// A band with an offset leaves out nodes far behind the surface. "Behind" is the side away from the offset. All numbers are in
// the surface's frame (docs/theory/clusters.md, "One side").
struct OneSide {
  float behind;       // 1 or -1: the factor from a node's height over a triangle to its depth behind the triangle
  float twice_shift;  // twice the distance of the band's middle from the surface
  float least_depth;  // a node with less depth may be in front of the triangle
  float least_sum;    // a node is out of the band if distance^2 + twice_shift * depth exceeds this number
  // For each group, a limit along the group's first axis, multiplied by `behind`. A node beyond the limit is out of the band at
  // each triangle of the group. An infinite limit leaves out no node. The pointer is null if nodes on both sides are wanted.
  const float *end_of_band = nullptr;
};

// The filter's input for a whole search. A coordinate x in the mesh's frame is x * ratio + shift in the surface's frame.
struct FilterTask {
  float ratio, shift[3];
  FilterLimits limits;
  const TriangleGroup *groups;
  const GroupBounds *bounds;
  OneSide one_side;
};

// A point of the surface for each of 16 boxes. A group competes with the point if some place in the box may be nearer to the
// group than to the point.
struct alignas(64) PointsOfBoxes {
  float xyz[3][16];
  float tolerance[16];  // the most by which the computed squares of two equal distances differ, at any place in the box
};

// One leaf of a cluster, and the groups that may be near this leaf.
struct LeafTask {
  const Leaf *leaf;
  int32_t position;  // the number of the leaf in its cluster
  uint32_t wanted;   // a bit for each node that is searched
  const int32_t *near_groups;
  int32_t n_groups;
  FilterLimits limits;
  bool may_be_near;  // whether a wanted node may be near a group; begin_cluster sets it
  uint32_t found;    // after the last call of filter_cluster, a bit for each node that had pairs in any call
};

// Cache lines that the decision kernel will read later. The filter prefetches a few of these lines at a time, between its
// distances. If it prefetched all lines at once, they would fill the processor's queue, and other loads would have to wait.
struct LinesAhead {
  int32_t n;
  const char *line[256];
};

// Leaves of one cluster, which are filtered together. The filter makes a list of pairs of a node and a group, and then computes
// the distances of all pairs in the list. If the list or the caller's arrays are full, the filter continues in the next call.
constexpr int32_t most_listed = 2 * nodes_per_cluster;
struct ClusterTask {
  int32_t n_leaves;
  LeafTask leaf[leaves_per_cluster];
  float *lower_bounds;  // room for nodes_per_leaf bounds for each near group of each leaf, aligned
  LinesAhead ahead;     // filter_cluster empties it
  bool is_done;         // set by the last call of filter_cluster

  // Only the filter uses the following members. The arrays are longer than the lists in them, so that whole registers can be
  // stored. A node is given by its position in the cluster.
  int32_t next_leaf, next_group;
  int32_t n_listed, next_listed;
  int32_t node[most_listed + 16], group[most_listed + 16];
  float nearest_sq[most_listed + 16];       // the square of the node's distance to the group
  uint16_t triangles[most_listed + 16];     // the group's triangles at this distance, up to the tolerance
  uint16_t in_band[most_listed + 16];       // those of `triangles` that keep the node in the band
  FilterLimits limits[leaves_per_cluster];  // the limits of each leaf, by its position
  alignas(64) float xyz[3][nodes_per_cluster];
  float best[nodes_per_cluster];         // the least of reach_sq and of all computed squares of distances
  float limit[nodes_per_cluster];        // a group is near up to the root of this number; -1: no group is near
  float first_group[nodes_per_cluster];  // the group that the node was compared with first
};

// Pairs of a node and a triangle. A node is given by its position in the cluster. The arrays must have room for 16 more pairs
// than they contain.
struct PairArrays {
  int32_t *node, *triangle;
};

// Eight pairs of a point and a triangle. The points are stored coordinate by coordinate. Lanes without a pair repeat another
// pair.
constexpr int pairs_at_once = 8;
struct alignas(64) PointsAndTriangles {
  double point[3][pairs_at_once];
  const double *corners[pairs_at_once];  // x, y, z of the first corner, then of the second and the third
};
// The closest points of eight pairs, stored coordinate by coordinate.
struct alignas(64) PointsOnTriangles {
  double distance_sq[pairs_at_once];
  double point[3][pairs_at_once], barycentric[3][pairs_at_once];
  uint32_t at_border;  // a bit for each lane, set if one of the weights is 0
};

// The numbers at a vertex that are interpolated within a triangle: the velocity, then u and v, then three zeros.
struct alignas(64) VertexNumbers {
  double number[8];
};
constexpr int uv_in_numbers = 3;

// Data of eight triangles: the unit normal, twice the area, and two dot products. The first product is of the two edges at the
// first corner, and the second is of the two edges at the second corner.
struct alignas(64) TriangleMeasures {
  double normal[3][pairs_at_once], twice_area[pairs_at_once], product_at_a[pairs_at_once], product_at_b[pairs_at_once];
};

// The placement of an image of a patch, and then the placement of the whole surface. Matrices are stored by columns, and each
// column and vector ends with a zero.
struct alignas(64) PlacedBy {
  double of_image[3][4], offset_of_image[4], rotation[3][4], translation[4], scale;
};

// The centres of functions |r|^3, stored coordinate by coordinate, and the weights of these functions. The number n of centres is
// a multiple of 8. Lanes without a source have the weight 0.
struct CubeSources {
  const double *source[3], *weight[3];
  int64_t n;
};
// The sum of all terms weight |y - source|^3 at a point y, and one third of the derivatives of this sum with respect to y.
struct CubeSums {
  double value[3], third_along[3][3];
};

// The largest number of keys that one call ranks: the number of nodes in two leaves.
constexpr int32_t keys_at_once = 2 * nodes_per_leaf;

struct FilterKernels {
  // For each candidate group, sets the bits of the boxes that are within reach of the group. Returns false if no box is within
  // reach of any group.
  bool (*near_boxes)(const FilterTask &task, const Boxes &boxes, const int32_t *candidates, int32_t n_candidates,
                     uint16_t *near);
  // Takes the bits that near_boxes has written to `near`. Clears the bits of boxes that are out of reach of the group's box along
  // the group's own axes. If only one side of the surface counts, also clears all bits of a box that is out of every group's
  // band. Returns false if no bit is left. Lanes without a box have no bits.
  bool (*near_own_boxes)(const FilterTask &task, const Boxes &boxes, const int32_t *candidates, int32_t n_candidates,
                         uint16_t *near);
  // Copies, without gaps, those of the n numbers whose entry in `marks` has the given bit. Returns the number of copied numbers.
  // `to` must have room for n numbers.
  int32_t (*select)(const int32_t *numbers, const uint16_t *marks, int32_t n, int32_t bit, int32_t *to);
  // For each of 16 boxes, finds the candidate group whose corner is nearest to the middle of the box. Writes the group's position
  // among the candidates. n_candidates must be above 0.
  void (*nearest_groups)(const FilterTask &task, const Boxes &boxes, const int32_t *candidates, int32_t n_candidates,
                         int32_t *nearest);
  // For each candidate group, writes a bit for each box. The bit is set if some place in the box may be nearer to the group than
  // to the box's point.
  void (*competing_groups)(const FilterTask &task, const Boxes &boxes, const PointsOfBoxes &points,
                           const int32_t *candidates, int32_t n_candidates, uint16_t *competes);
  // Compares the nodes of a cluster with the boxes of groups.
  void (*begin_cluster)(const FilterTask &task, ClusterTask &cluster);
  // Compares the nodes with the triangles of groups that may be near. Writes at most `room` pairs of a node and a triangle, and
  // returns their number. The pairs include the closest triangles of every node within the limit. Each call continues where the
  // previous call stopped, until is_done is true. `room` must be at least triangles_per_group, or no call would make progress.
  int32_t (*filter_cluster)(const FilterTask &task, ClusterTask &cluster, const PairArrays &pairs, int32_t room);
  // Computes the squares of the distances of a point to the triangles of a group, in single precision. The point is in the
  // surface's frame.
  void (*group_distances)(const TriangleGroup &group, const float *point, float margin, float *distance_sq);
  // For each of n keys, counts the smaller keys. n is at most keys_at_once. If no two keys are equal, this count is the position
  // of the key in ascending order. The arrays `key` and `n_less` are aligned to 64 bytes and have room for keys_at_once.
  void (*rank)(const int32_t *key, int32_t n, int32_t *n_less);
};

struct DecisionKernels {
  // Copies the corners of n triangles, 9 doubles for each triangle, and finds the least and the greatest coordinates. Triangles
  // are given by the ids of their vertices, and n is above 0.
  void (*take_corners)(const double *vertices, const int64_t *vertex_id, int64_t n, double *corners, double *lower,
                       double *upper);
  // Checks up to eight triangles, given by the ids of their vertices. Returns true only if every triangle has an area, and keeps
  // an area if its corners move by up to an eighth of `shift`. For this, the square of twice the area must exceed 4e-23 (|ab|^2 +
  // |ac|^2)^2 + shift^2 (|ab|^2 + |ac|^2).
  bool (*have_area)(const double *vertices, const int64_t *vertex_id, int32_t n, double shift);
  // Moves n points (3, n) by two placements. The results have the same bits as place(placement, place(image, p)).
  void (*place_points)(const PlacedBy &by, const double *points, int64_t n, double *placed);
  // Measures up to eight triangles, given by the ids of their vertices. The normals have the same bits as triangle_normal.
  void (*measure_triangles)(const double *vertices, const int64_t *vertex_id, int32_t n, TriangleMeasures &measures);
  // Takes the corners of up to 16 triangles to the surface's frame. The triangles are given by index.
  void (*frame_group)(const PlainFrame &frame, const double *corners, const int32_t *triangle, int32_t n,
                      GroupCorners &framed);
  // Takes the nodes of a leaf (3, nodes_per_leaf) to the mesh's frame, in single precision, and finds the leaf's box. A
  // coordinate far outside the frame becomes 2 or -2, and NaN becomes -2.
  void (*frame_leaf)(const PlainFrame &frame, const double *xyz, Leaf &leaf, float *lower, float *upper);
  // Makes the frames and the bounds of up to eight groups of triangles from their corners in the surface's frame. Each
  // bounds[k].n must be set.
  void (*make_groups)(const GroupCorners *corners, int32_t n, TriangleGroup *groups, GroupBounds *bounds);
  // Computes the square of the distance for each of n pairs of a point and a triangle. Points and triangles are given by index.
  // The corners of a triangle are 9 doubles. The function may write up to 7 numbers after the n squares.
  void (*decide)(int32_t n, const int32_t *point, const int32_t *triangle, const double *points, const double *corners,
                 double *distance_sq);
  // Finds the closest points of the pairs, with the same bits as closest_point_on_triangle.
  void (*locate)(const PointsAndTriangles &pairs, PointsOnTriangles &located);
  // Interpolates the numbers of three vertices by the weights of each located point. `vertex` has the ids of each pair's three
  // vertices.
  void (*mix_at_vertices)(const VertexNumbers *numbers, const int64_t *const *vertex, const PointsOnTriangles &located,
                          VertexNumbers *mixed);
  // Computes how fast the distances of the first n_points points change when the triangles' vertices move. The number n_points is
  // above 0. The caller passes the distances that it has already computed, so that the kernel needs no square roots. `vertex` has
  // the ids of each pair's three vertices, and rates[i] has the rates of all vertices in direction i. The derivatives of one
  // point are stored one after another. If a distance is 0, its derivatives are 0.
  void (*differentiate)(const PointsAndTriangles &pairs, const PointsOnTriangles &located,
                        const double (&distance)[pairs_at_once], const int64_t *const *vertex,
                        const double *const *rates, int64_t n_directions, int32_t n_points, double *derivatives);
  // Finds the side of each point, +1, -1 or 0. The side is the sign of the point's height above the located point, measured along
  // the normal.
  void (*find_sides)(const PointsAndTriangles &pairs, const PointsOnTriangles &located,
                     const double (&normal)[3][pairs_at_once], int32_t *side);
  // Computes the sum of CubeSums at the point `at`. Only sum_cubes_with_derivatives writes the derivatives. All instruction sets
  // give the same bits.
  void (*sum_cubes)(const CubeSources &sources, const double *at, CubeSums &sums);
  void (*sum_cubes_with_derivatives)(const CubeSources &sources, const double *at, CubeSums &sums);
};

struct Kernels : FilterKernels, DecisionKernels {};

// Instruction sets, in ascending order of preference.
enum class InstructionSet : int32_t { baseline = 0, avx2 = 1, avx512 = 2 };
constexpr int n_instruction_sets = 3;

// Returns whether the instruction set can be used. The processor and the operating system must support it, and the library must
// contain code for it.
bool has(InstructionSet set);
InstructionSet best_instruction_set();
const Kernels &kernels(InstructionSet set);

}  // namespace riis
