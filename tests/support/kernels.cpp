// SPDX-License-Identifier: Apache-2.0
#include "kernels/kernels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "internals.h"
#include "kernels/table.hpp"
#include "scene/triangle_groups.hpp"

using namespace riis;

static_assert(portable_set == n_instruction_sets && n_kernel_sets == n_instruction_sets + 1);

struct kernel_group {
  TriangleGroup group;
  GroupBounds bounds;
};

namespace {

const Kernels &of(int set) {
#if defined(RIIS_PORTABLE_KERNELS)
  static const Kernels portable{filter_kernels_portable, decision_kernels_portable};
  if (set == portable_set) return portable;
#endif
  return kernels(static_cast<InstructionSet>(set));
}

// Makes the filter's input as cluster_search.cpp does.
struct Filter {
  std::vector<TriangleGroup> groups;
  std::vector<GroupBounds> bounds;
  std::vector<std::int32_t> near_groups, reversed_groups;
  std::vector<Leaf> lower_bounds;  // in a Leaf, because the kernel needs a Leaf's alignment
  Leaf leaf;
  FilterTask task;
  ClusterTask cluster;

  static constexpr int positions[kernel_leaves] = {3, 14};

  explicit Filter(const kernel_filter &filter) : lower_bounds(static_cast<std::size_t>(3 * filter.n_groups)) {
    for (int i = 0; i < filter.n_groups; ++i) {
      groups.push_back(filter.groups[i]->group);
      bounds.push_back(filter.groups[i]->bounds);
      for (int k = 0; k < bounds.back().n; ++k) bounds.back().triangle[k] = triangles_per_group * i + k;
      near_groups.push_back(i);
    }
    for (int i = 0; i < nodes_per_leaf; ++i) {
      const int node = std::min(i, filter.n_nodes - 1);
      leaf.x[i] = filter.nodes[3 * node], leaf.y[i] = filter.nodes[3 * node + 1],
      leaf.z[i] = filter.nodes[3 * node + 2];
      leaf.node[i] = static_cast<std::uint32_t>(node);
    }
    double shift = 0;
    for (int i = 0; i < 3; ++i) {
      shift = std::max(shift, std::abs(filter.shift[i]));
      task.shift[i] = static_cast<float>(filter.shift[i]);
    }
    double longest_edge = 0;
    for (const GroupBounds &group : bounds) longest_edge = std::max<double>(longest_edge, group.longest_edge);
    const auto limits_within = [&](double limit) -> FilterLimits {
      const double error = filter_error(filter.ratio, shift, limit, longest_edge), reach = limit + 2 * error;
      return {static_cast<float>(reach * reach), filter_tolerance(error, reach), static_cast<float>(0.5 * error)};
    };
    task.ratio = static_cast<float>(filter.ratio);
    task.limits = limits_within(filter.limit);
    task.groups = groups.data();
    task.bounds = bounds.data();
    reversed_groups.assign(near_groups.rbegin(), near_groups.rend());
    const std::int32_t *const groups_of_first = near_groups.data(), *const of_second = reversed_groups.data();
    const FilterLimits half = limits_within(0.5 * filter.limit);
    cluster.n_leaves = 4;
    cluster.leaf[0] = {&leaf, positions[0], filter.wanted[0], groups_of_first, filter.n_groups, task.limits, false, 0};
    cluster.leaf[1] = {&leaf, 7, 0, groups_of_first, filter.n_groups, task.limits, false, 0};
    cluster.leaf[2] = {&leaf, 8, UINT32_MAX, groups_of_first, 0, task.limits, false, 0};
    cluster.leaf[3] = {&leaf, positions[1], filter.wanted[1], of_second, filter.n_groups, half, false, 0};
    cluster.lower_bounds = lower_bounds.data()->x;
    cluster.ahead.n = 0;
    for (const float *axis : {leaf.x, leaf.y, leaf.z})
      cluster.ahead.line[cluster.ahead.n++] = reinterpret_cast<const char *>(axis);
  }
};

// Makes a box around every n_together nodes.
Boxes boxes_of(const kernel_filter &filter, int n_together) {
  Boxes boxes;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 16; ++k) {
      float &lower = boxes.lower[i][k], &upper = boxes.upper[i][k];
      lower = __builtin_inff(), upper = -__builtin_inff();
      for (int node = n_together * k; node < std::min(n_together * (k + 1), filter.n_nodes); ++node) {
        lower = std::min(lower, filter.nodes[3 * node + i]);
        upper = std::max(upper, filter.nodes[3 * node + i]);
      }
    }
  return boxes;
}

constexpr std::int32_t untouched = -77;

}  // namespace

extern "C" {

int kernels_there(int set) {
#if defined(RIIS_PORTABLE_KERNELS)
  if (set == portable_set) return 1;
#endif
  return has(static_cast<InstructionSet>(set));
}

int kernels_baseline_rounds_twice() {
#if defined(__FMA__) || defined(__aarch64__)
  return 0;
#else
  return 1;
#endif
}

const char *kernels_name(int set) {
  static const char *const names[] = {"baseline", "AVX2", "AVX-512", "portable"};
  return names[set];
}

void kernels_decide(int set, int32_t n, const int32_t *point, const int32_t *triangle, const double *points,
                    const double *corners, double *distance_sq) {
  of(set).decide(n, point, triangle, points, corners, distance_sq);
}

void kernels_locate(int set, int32_t n, const int32_t *point, const int32_t *triangle, const double *points,
                    const double *corners, double *distance_sq, double *closest, double *barycentric) {
  PointsAndTriangles pairs;
  PointsOnTriangles located;
  for (int i = 0; i < pairs_at_once; ++i) {
    const int pair = i < n ? i : 0;
    for (int c = 0; c < 3; ++c) pairs.point[c][i] = points[3 * point[pair] + c];
    pairs.corners[i] = corners + 9 * triangle[pair];
  }
  of(set).locate(pairs, located);
  for (int i = 0; i < n; ++i) {
    distance_sq[i] = located.distance_sq[i];
    for (int c = 0; c < 3; ++c) {
      closest[3 * i + c] = located.point[c][i];
      barycentric[3 * i + c] = located.barycentric[c][i];
    }
  }
}

void kernels_take_corners(int set, const double *vertices, const int64_t *vertex_id, int64_t n, double *corners,
                          double *lower, double *upper) {
  of(set).take_corners(vertices, vertex_id, n, corners, lower, upper);
}

void kernels_frame_group(int set, const double *centre, double scale, const double *corners, const int32_t *triangle,
                         int32_t n, double *framed) {
  GroupCorners of_group;
  of(set).frame_group({{centre[0], centre[1], centre[2]}, scale}, corners, triangle, n, of_group);
  std::memcpy(framed, of_group.xyz, sizeof of_group.xyz);
}

void kernels_frame_leaf(int set, const double *centre, double scale, const double *nodes, float *framed, float *lower,
                        float *upper) {
  Leaf leaf;
  of(set).frame_leaf({{centre[0], centre[1], centre[2]}, scale}, nodes, leaf, lower, upper);
  for (const float *axis : {leaf.x, leaf.y, leaf.z}) framed = std::copy_n(axis, nodes_per_leaf, framed);
}

void kernels_place_points(int set, const double *first, const double *second, double scale, int64_t n,
                          const double *points, double *placed) {
  PlacedBy by{};
  by.scale = scale;
  for (int k = 0; k < 3; ++k) {
    std::copy_n(first + 3 * k, 3, by.of_image[k]);
    std::copy_n(second + 3 * k, 3, by.rotation[k]);
  }
  std::copy_n(first + 9, 3, by.offset_of_image);
  std::copy_n(second + 9, 3, by.translation);
  of(set).place_points(by, points, n, placed);
}

int kernels_have_area(int set, const double *vertices, const int64_t *vertex_id, int32_t n, double shift) {
  return of(set).have_area(vertices, vertex_id, n, shift);
}

void kernels_sum_cubes(int set, int64_t n, const double *sources, const double *weights, const double *at,
                       double *sums) {
  const CubeSources of_cubes{{sources, sources + n, sources + 2 * n}, {weights, weights + n, weights + 2 * n}, n};
  CubeSums with, without{};
  of(set).sum_cubes_with_derivatives(of_cubes, at, with);
  of(set).sum_cubes(of_cubes, at, without);
  std::copy_n(with.value, 3, sums);
  std::copy_n(with.third_along[0], 9, sums + 3);
  std::copy_n(without.value, 3, sums + 12);
}

void kernels_mix_at_vertices(int set, int64_t n_vertices, const double *numbers, const int64_t *vertex_id,
                             const double *barycentric, double *mixed) {
  std::vector<VertexNumbers> at(static_cast<std::size_t>(n_vertices));
  for (VertexNumbers &vertex : at) {
    std::copy_n(numbers, 8, vertex.number);
    numbers += 8;
  }
  PointsOnTriangles located;
  const std::int64_t *vertex[pairs_at_once];
  for (int i = 0; i < pairs_at_once; ++i) {
    vertex[i] = vertex_id + 3 * i;
    for (int k = 0; k < 3; ++k) located.barycentric[k][i] = barycentric[3 * i + k];
  }
  VertexNumbers made[pairs_at_once];
  of(set).mix_at_vertices(at.data(), vertex, located, made);
  for (int i = 0; i < pairs_at_once; ++i) std::copy_n(made[i].number, 8, mixed + 8 * i);
}

void kernels_differentiate(int set, const double *points, const double *on, const double *barycentric,
                           const int64_t *vertex_id, int64_t n_vertices, int64_t n_directions, const double *rates,
                           int32_t n_points, double *derivatives) {
  PointsAndTriangles pairs;
  PointsOnTriangles located;
  const std::int64_t *vertex[pairs_at_once];
  alignas(64) double distance[pairs_at_once];
  for (int i = 0; i < pairs_at_once; ++i) {
    vertex[i] = vertex_id + 3 * i;
    for (int c = 0; c < 3; ++c) {
      pairs.point[c][i] = points[3 * i + c];
      located.point[c][i] = on[3 * i + c];
      located.barycentric[c][i] = barycentric[3 * i + c];
    }
    const auto away = [&](int c) { return points[3 * i + c] - on[3 * i + c]; };
    distance[i] = std::sqrt(away(0) * away(0) + away(1) * away(1) + away(2) * away(2));
  }
  std::vector<const double *> of_direction;
  for (std::int64_t i = 0; i < n_directions; ++i) of_direction.push_back(rates + 3 * n_vertices * i);
  of(set).differentiate(pairs, located, distance, vertex, of_direction.data(), n_directions, n_points, derivatives);
}

int32_t kernels_select(int set, const int32_t *numbers, const uint16_t *marks, int32_t n, int32_t bit, int32_t *to) {
  return of(set).select(numbers, marks, n, bit, to);
}

void kernels_rank(int set, const int32_t *key, int32_t n, int32_t *n_less) {
  alignas(64) std::int32_t aligned_key[keys_at_once], aligned_less[keys_at_once];
  std::copy(key, key + keys_at_once, aligned_key);
  of(set).rank(aligned_key, n, aligned_less);
  std::copy(aligned_less, aligned_less + keys_at_once, n_less);
}

void kernels_find_sides(int set, const double *points, const double *on, const double *normals, int32_t *side) {
  PointsAndTriangles pairs;
  PointsOnTriangles located;
  alignas(64) double normal[3][pairs_at_once];
  for (int i = 0; i < pairs_at_once; ++i)
    for (int c = 0; c < 3; ++c) {
      pairs.point[c][i] = points[3 * i + c];
      located.point[c][i] = on[3 * i + c];
      normal[c][i] = normals[3 * i + c];
    }
  of(set).find_sides(pairs, located, normal, side);
}

void kernels_measure_triangles(int set, const double *vertices, const int64_t *vertex_id, int32_t n, double *measures) {
  TriangleMeasures made;
  of(set).measure_triangles(vertices, vertex_id, n, made);
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < 3; ++c) measures[6 * i + c] = made.normal[c][i];
    measures[6 * i + 3] = made.twice_area[i];
    measures[6 * i + 4] = made.product_at_a[i];
    measures[6 * i + 5] = made.product_at_b[i];
  }
}

kernel_group *kernels_group(int set, int n, const double *corners) {
  auto *group = new kernel_group{};
  group->bounds.n = n;
  GroupCorners of_group;
  for (int i = 0; i < triangles_per_group; ++i)
    for (int c = 0; c < 9; ++c) of_group.xyz[c][i] = corners[9 * (i < n ? i : 0) + c];
  of(set).make_groups(&of_group, 1, &group->group, &group->bounds);
  return group;
}

void kernels_group_free(kernel_group *group) { delete group; }

int kernels_groups_equal(const kernel_group *a, const kernel_group *b) {
  static_assert(sizeof(TriangleGroup) == 23 * triangles_per_group * sizeof(float), "no gaps between its fields");
  const GroupBounds &p = a->bounds, &q = b->bounds;
  return std::memcmp(&a->group, &b->group, sizeof a->group) == 0 && std::memcmp(&p, &q, sizeof p) == 0;
}

void kernels_group_distances(int set, const kernel_group *group, const float *point, double margin,
                             float *distance_sq) {
  of(set).group_distances(group->group, point, static_cast<float>(margin), distance_sq);
}

double kernels_error(double ratio, double shift, double reach, double longest_edge) {
  return filter_error(ratio, shift, reach, longest_edge);
}

int64_t kernels_filter(int set, const kernel_filter *filter, int32_t room, kernel_pair **pairs, int64_t *n_calls) {
  Filter of_filter(*filter);
  ClusterTask &cluster = of_filter.cluster;
  std::vector<kernel_pair> found;
  const auto size = static_cast<std::size_t>(room) + 16;
  std::uint32_t nodes[kernel_leaves] = {};
  of(set).begin_cluster(of_filter.task, cluster);
  bool is_right = true;
  for (*n_calls = 0; is_right && !cluster.is_done; ++*n_calls) {
    std::vector<std::int32_t> node(size + 16, untouched), triangle(size + 16, untouched);
    const std::int32_t n = of(set).filter_cluster(of_filter.task, cluster, {node.data(), triangle.data()}, room);
    is_right = n <= room && cluster.ahead.n == 0;
    for (std::size_t i = 0; is_right && i < static_cast<std::size_t>(n); ++i) {
      const int position = node[i] / nodes_per_leaf, lane = node[i] % nodes_per_leaf;
      const int leaf = position == Filter::positions[1];
      is_right = position == Filter::positions[leaf];
      nodes[leaf] |= 1u << lane;
      found.push_back({nodes_per_leaf * leaf + lane, triangle[i]});
    }
    for (std::size_t i = size; i < node.size(); ++i)
      is_right = is_right && node[i] == untouched && triangle[i] == untouched;
  }
  const std::uint32_t found_in[kernel_leaves] = {cluster.leaf[0].found, cluster.leaf[3].found};
  for (int i = 0; i < kernel_leaves; ++i) is_right = is_right && nodes[i] == found_in[i];
  if (!is_right) return -1;
  *pairs = static_cast<kernel_pair *>(std::malloc((found.size() + 1) * sizeof(kernel_pair)));
  std::copy(found.begin(), found.end(), *pairs);
  return static_cast<int64_t>(found.size());
}

void kernels_lower_bounds(int set, const kernel_filter *filter, float *lower_sq) {
  Filter of_filter(*filter);
  of(set).begin_cluster(of_filter.task, of_filter.cluster);
  std::copy_n(of_filter.cluster.lower_bounds, nodes_per_leaf * filter->n_groups, lower_sq);
}

int kernels_near_boxes(int set, const kernel_filter *filter, uint16_t *near) {
  const Filter of_filter(*filter);
  const Boxes boxes = boxes_of(*filter, 1);
  return of(set).near_boxes(of_filter.task, boxes, of_filter.near_groups.data(), filter->n_groups, near);
}

int kernels_near_own_boxes(int set, const kernel_filter *filter, uint16_t *near) {
  const Filter of_filter(*filter);
  const Boxes boxes = boxes_of(*filter, 2);
  return of(set).near_own_boxes(of_filter.task, boxes, of_filter.near_groups.data(), filter->n_groups, near);
}
}
