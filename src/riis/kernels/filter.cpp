// SPDX-License-Identifier: Apache-2.0
// The filter rules out pairs of nodes and triangles that cannot matter. The filter computes in single precision and is compiled
// for each instruction set.
#include "kernels/lanes.hpp"
#include "kernels/table.hpp"

namespace riis {
namespace {

struct Floats3 {
  Floats x, y, z;
};

RIIS_INLINE Floats3 all(const float *p) { return {Floats::all(p[0]), Floats::all(p[1]), Floats::all(p[2])}; }
RIIS_INLINE Floats dot(Floats3 a, Floats3 b) { return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z)); }
RIIS_INLINE Floats3 load(const float (*from)[16]) {
  return {Floats::load(from[0]), Floats::load(from[1]), Floats::load(from[2])};
}

// Returns the distance of x from the interval from..to.
RIIS_INLINE Floats outside(Floats x, Floats from, Floats to) {
  return greatest(greatest(from - x, x - to), Floats::all(0));
}

// The squares of a point's distances to sixteen triangles, and its heights over their planes.
struct ToGroup {
  Floats distance_sq, height;
};

// Measures the distances from a point to the triangles of a group. Up to rounding, every result is the distance to some point of
// the triangle. A point counts as inside the triangle only if it is farther than a margin from every edge. A point within the
// margin of an edge gets its distance to this edge, with an error of at most the margin.
RIIS_INLINE ToGroup measure_to_group(const TriangleGroup &group, Floats3 p, Floats margin) {
  const auto along = [&](const float(*axis)[16], const float *origin) RIIS_LAMBDA {
    const Floats3 unit = load(axis);
    return multiply_add(p.x, unit.x, multiply_add(p.y, unit.y, multiply_add(p.z, unit.z, Floats::load(origin))));
  };
  const Floats e = along(group.e, group.e_origin), f = along(group.f, group.f_origin),
               g = along(group.g, group.g_origin);
  const Floats past_ab = beyond(e, Floats::load(group.half_ab));
  Floats in_plane = multiply_add(past_ab, past_ab, f * f), inside = f;

  // Includes the distance to an edge. The arguments are the edge's direction, the coordinate of its middle along this direction,
  // the edge's coordinate across this direction, and its half length.
  const auto offer_edge = [&](Floats x, Floats y, const float *unit_x, const float *unit_y, const float *middle,
                              const float *side, const float *half) RIIS_LAMBDA {
    const Floats to_x = Floats::load(unit_x), to_y = Floats::load(unit_y);
    const Floats inside_edge = subtract_product(y, to_x, multiply_add(x, to_y, Floats::load(side)));
    const Floats past_edge =
        beyond(multiply_add(x, to_x, multiply_add(y, to_y, Floats::load(middle))), Floats::load(half));
    in_plane = least(in_plane, multiply_add(past_edge, past_edge, inside_edge * inside_edge));
    inside = least(inside, inside_edge);
  };
  offer_edge(e, f, group.ac_e, group.ac_f, group.ac_middle, group.ac_side, group.half_ac);
  // The triangle is on the right of ac but on the left of bc, so the two axes are exchanged.
  offer_edge(f, e, group.bc_f, group.bc_e, group.bc_middle, group.bc_side, group.half_bc);
  return {multiply_add(g, g, zero_where_at_least(inside, margin, in_plane)), g};
}

// The extents of 16 boxes along one axis, in the surface's frame.
struct Extents {
  Floats lower, upper;
};
RIIS_INLINE Extents placed(const FilterTask &task, const Boxes &boxes, int axis) {
  const Floats ratio = Floats::all(task.ratio), shift = Floats::all(task.shift[axis]);
  return {multiply_add(Floats::load(boxes.lower[axis]), ratio, shift),
          multiply_add(Floats::load(boxes.upper[axis]), ratio, shift)};
}

bool near_boxes(const FilterTask &task, const Boxes &boxes, const int32_t *candidates, int32_t n_candidates,
                uint16_t *near) {
  const Floats reach_sq = Floats::all(task.limits.reach_sq);
  Extents box[3];
  for (int i = 0; i < 3; ++i) box[i] = placed(task, boxes, i);
  uint32_t found = 0;
  for (int32_t k = 0; k < n_candidates; ++k) {
    const GroupBounds &group = task.bounds[candidates[k]];
    Floats sum = Floats::all(0);
    for (int i = 0; i < 3; ++i) {
      const Floats gap =
          greatest(greatest(box[i].lower - Floats::all(group.upper[i]), Floats::all(group.lower[i]) - box[i].upper),
                   Floats::all(0));
      sum = multiply_add(gap, gap, sum);
    }
    const uint32_t is_near = bits_at_most(sum, reach_sq);
    near[k] = static_cast<uint16_t>(is_near);
    found |= is_near;
  }
  return found != 0;
}

// The half extent of a box along an axis is a sum over its half sides. Each half side is multiplied by the component of the axis
// along this side.
template <bool is_one_sided>
RIIS_INLINE bool near_rotated_boxes(const FilterTask &task, const Boxes &boxes, const int32_t *candidates,
                                    int32_t n_candidates, uint16_t *near) {
  const Floats reach_sq = Floats::all(task.limits.reach_sq), one_half = Floats::all(0.5f);
  Floats middle[3], half[3];
  float largest_shift = 0;
  for (int i = 0; i < 3; ++i) {
    const Extents extents = placed(task, boxes, i);
    middle[i] = one_half * (extents.lower + extents.upper);
    half[i] = one_half * (extents.upper - extents.lower);
    const float shift = __builtin_fabsf(task.shift[i]);
    largest_shift = shift > largest_shift ? shift : largest_shift;
  }
  const Floats rounding = Floats::all(0x1p-19f * (task.ratio + largest_shift + 1));  // docs/theory/clusters.md
  uint32_t found = 0, in_band = 0;
  for (int32_t k = 0; k < n_candidates; ++k) {
    const GroupBounds &group = task.bounds[candidates[k]];
    Floats sum = Floats::all(0), least_along_first = sum;
    for (int i = 0; i < 3; ++i) {
      const float *const axis = group.axis[i];
      Floats along = Floats::all(0), half_along = rounding;
      for (int j = 0; j < 3; ++j) {
        along = multiply_add(middle[j], Floats::all(axis[j]), along);
        half_along = multiply_add(half[j], Floats::all(__builtin_fabsf(axis[j])), half_along);
      }
      const Floats gap = outside(along, Floats::all(group.from[i]) - half_along, Floats::all(group.to[i]) + half_along);
      sum = multiply_add(gap, gap, sum);
      if (is_one_sided && i == 0) least_along_first = Floats::all(task.one_side.behind) * along - half_along;
    }
    near[k] = static_cast<uint16_t>(near[k] & bits_at_most(sum, reach_sq));
    found |= near[k];
    if constexpr (is_one_sided)
      in_band |= near[k] & bits_at_most(least_along_first, Floats::all(task.one_side.end_of_band[candidates[k]]));
  }
  if constexpr (is_one_sided) {
    for (int32_t k = 0; k < n_candidates; ++k) near[k] = static_cast<uint16_t>(near[k] & in_band);
    found = in_band;
  }
  return found != 0;
}

bool near_own_boxes(const FilterTask &task, const Boxes &boxes, const int32_t *candidates, int32_t n_candidates,
                    uint16_t *near) {
  return task.one_side.end_of_band ? near_rotated_boxes<true>(task, boxes, candidates, n_candidates, near)
                                   : near_rotated_boxes<false>(task, boxes, candidates, n_candidates, near);
}

int32_t select(const int32_t *numbers, const uint16_t *marks, int32_t n, int32_t bit, int32_t *to) {
  // Each step writes a whole register of 16 places. The register ends within the first n places, because no more numbers have
  // been written than read.
  int32_t n_selected = 0, k = 0;
  for (; k + 16 <= n; k += 16) {
    const uint32_t lanes = lanes_with_bit(marks + k, bit);
    compress(lanes, numbers + k, to + n_selected);
    n_selected += __builtin_popcount(lanes);
  }
  // The loop writes every number, but moves to the next place only after a number that is kept. This avoids a branch that the
  // processor could not predict.
  for (; k < n; ++k) {
    to[n_selected] = numbers[k];
    n_selected += marks[k] >> bit & 1;
  }
  return n_selected;
}

void nearest_groups(const FilterTask &task, const Boxes &boxes, const int32_t *candidates, int32_t n_candidates,
                    int32_t *nearest) {
  Floats middle[3];
  for (int i = 0; i < 3; ++i) {
    const Extents extents = placed(task, boxes, i);
    middle[i] = Floats::all(0.5f) * (extents.lower + extents.upper);
  }
  Floats least_sq = Floats::all(__builtin_inff()), at = Floats::all(0);
  for (int32_t k = 0; k < n_candidates; ++k) {
    const float *corner = task.bounds[candidates[k]].corner;
    Floats sum = Floats::all(0);
    for (int i = 0; i < 3; ++i) {
      const Floats difference = middle[i] - Floats::all(corner[i]);
      sum = multiply_add(difference, difference, sum);
    }
    // A surface has fewer than 2^24 groups, so single precision holds their positions exactly.
    at = choose(sum < least_sq, Floats::all(static_cast<float>(k)), at);
    least_sq = least(least_sq, sum);
  }
  alignas(64) float positions[16];
  at.store(positions);
  for (int i = 0; i < 16; ++i) nearest[i] = static_cast<int32_t>(positions[i]);
}

// For a place p, let f(p) be the squared distance from p to a group's box, minus the squared distance from p to the point. The
// function f is concave, and a sum with one term for each axis. The least f in a box is therefore the sum of the terms' least
// values. Each term is least at one of the two ends of the box along its axis.
void competing_groups(const FilterTask &task, const Boxes &boxes, const PointsOfBoxes &points,
                      const int32_t *candidates, int32_t n_candidates, uint16_t *competes) {
  const Floats zero = Floats::all(0), tolerance = Floats::load(points.tolerance);
  Extents box[3], to_point[3];  // to_point has the negative squares of the distances from the ends to the point
  for (int i = 0; i < 3; ++i) {
    box[i] = placed(task, boxes, i);
    const Floats x = Floats::load(points.xyz[i]), from_lower = box[i].lower - x, from_upper = box[i].upper - x;
    to_point[i] = {zero - from_lower * from_lower, zero - from_upper * from_upper};
  }
  for (int32_t k = 0; k < n_candidates; ++k) {
    const GroupBounds &group = task.bounds[candidates[k]];
    Floats sum = zero;
    for (int i = 0; i < 3; ++i) {
      const Floats lower = Floats::all(group.lower[i]), upper = Floats::all(group.upper[i]);
      const Floats at_lower = outside(box[i].lower, lower, upper), at_upper = outside(box[i].upper, lower, upper);
      sum = sum + least(multiply_add(at_lower, at_lower, to_point[i].lower),
                        multiply_add(at_upper, at_upper, to_point[i].upper));
    }
    competes[k] = static_cast<uint16_t>(bits_at_most(sum, tolerance));
  }
}

constexpr int halves = nodes_per_leaf / 16;

// The positions of nodes in a cluster: 0, 1, 2, ...
struct Positions {
  alignas(64) int32_t of_node[nodes_per_cluster] = {};
  constexpr Positions() {
    for (int i = 0; i < nodes_per_cluster; ++i) of_node[i] = i;
  }
};
constexpr Positions positions;

RIIS_INLINE uint32_t wanted_in_half(const LeafTask &leaf, int h) { return leaf.wanted >> 16 * h & 0xffff; }
RIIS_INLINE int32_t first_node_of(const LeafTask &leaf) { return leaf.position * nodes_per_leaf; }
RIIS_INLINE uint32_t leaf_of(int32_t node) { return static_cast<uint32_t>(node) / nodes_per_leaf; }

// Takes a leaf to the surface's frame. For every pair of a group and a node, computes the square of a lower bound on the
// distance. Lists each node that may be within reach, with the group that has the least bound. If only one side of the surface
// counts, a node is listed only if some group within reach can hold the node in the band.
template <bool is_one_sided>
RIIS_INLINE void begin_leaf(const FilterTask &task, LeafTask &leaf, ClusterTask &cluster, float *lower_bounds) {
  const int32_t first_node = first_node_of(leaf), n_before = cluster.n_listed;
  const float *const xyz[3] = {leaf.leaf->x, leaf.leaf->y, leaf.leaf->z};
  const Floats ratio = Floats::all(task.ratio);
  Floats3 p[halves];
  Floats least_bound[halves], first_group[halves], least_in_band[halves];
  for (int h = 0; h < halves; ++h) {
    const auto framed = [&](int axis) RIIS_LAMBDA {
      const Floats x = multiply_add(Floats::load(xyz[axis] + 16 * h), ratio, Floats::all(task.shift[axis]));
      x.store(cluster.xyz[axis] + first_node + 16 * h);
      return x;
    };
    p[h] = {framed(0), framed(1), framed(2)};
    least_bound[h] = least_in_band[h] = Floats::all(__builtin_inff());
    first_group[h] = Floats::all(0);
  }
  for (int32_t k = 0; k < leaf.n_groups; ++k) {
    const GroupBounds &group = task.bounds[leaf.near_groups[k]];
    // A surface has fewer than 2^24 groups, so single precision holds their numbers exactly.
    const Floats number = Floats::all(static_cast<float>(leaf.near_groups[k]));
    for (int h = 0; h < halves; ++h) {
      Floats sum = Floats::all(0), along_first = Floats::all(0);
      for (int axis = 0; axis < 3; ++axis) {
        const Floats along = dot(p[h], all(group.axis[axis]));
        const Floats gap = outside(along, Floats::all(group.from[axis]), Floats::all(group.to[axis]));
        sum = multiply_add(gap, gap, sum);
        if (axis == 0) along_first = along;
      }
      if constexpr (is_one_sided) {
        const Floats end = Floats::all(task.one_side.end_of_band[leaf.near_groups[k]]);
        const Floats::Mask is_out = Floats::all(task.one_side.behind) * along_first > end;
        least_in_band[h] = choose(is_out, least_in_band[h], least(least_in_band[h], sum));
      }
      sum.store(lower_bounds + nodes_per_leaf * k + 16 * h);
      first_group[h] = choose(sum < least_bound[h], number, first_group[h]);
      least_bound[h] = least(least_bound[h], sum);
    }
  }
  const Floats reach_sq = Floats::all(leaf.limits.reach_sq);
  if constexpr (is_one_sided) {
    uint32_t in_band = 0;
    for (int h = 0; h < halves; ++h) in_band |= bits_at_most(least_in_band[h], reach_sq) << 16 * h;
    leaf.wanted &= in_band;
  }
  for (int h = 0; h < halves; ++h) {
    const int32_t at = first_node + 16 * h;
    first_group[h].store(cluster.first_group + at);
    reach_sq.store(cluster.best + at);
    const uint32_t near = bits_at_most(least_bound[h], reach_sq) & wanted_in_half(leaf, h);
    int32_t groups[16];
    to_integers(first_group[h], groups);
    compress(near, positions.of_node + at, cluster.node + cluster.n_listed);
    compress(near, groups, cluster.group + cluster.n_listed);
    cluster.n_listed += __builtin_popcount(near);
  }
  cluster.limits[leaf.position] = leaf.limits;
  leaf.may_be_near = cluster.n_listed > n_before;
}

// Lists pairs of a node of the leaf and a group, beginning with the group cluster.next_group. A pair is listed if the group may
// be as near to the node as the nearest triangle found so far. The node's first group is not listed again. Returns false if the
// list is full before the last group.
RIIS_INLINE bool list_others(const LeafTask &leaf, ClusterTask &cluster, const float *lower_bounds) {
  const int32_t first_node = first_node_of(leaf);
  Floats limit[halves], first_group[halves];
  for (int h = 0; h < halves; ++h) {
    limit[h] = Floats::load(cluster.best + first_node + 16 * h) + Floats::all(leaf.limits.tolerance);
    first_group[h] = Floats::load(cluster.first_group + first_node + 16 * h);
  }
  // Local variables replace members, because the compiler must assume that each store to the list may change a member.
  int32_t n = cluster.n_listed, k = cluster.next_group;
  for (; k < leaf.n_groups && n <= most_listed - nodes_per_leaf; ++k) {
    const int32_t group = leaf.near_groups[k];
    const Floats number = Floats::all(static_cast<float>(group));
    for (int h = 0; h < halves; ++h) {
      const Floats bound = Floats::load(lower_bounds + nodes_per_leaf * k + 16 * h);
      const uint32_t near =
          bits_at_most(bound, limit[h]) & bits_different(number, first_group[h]) & wanted_in_half(leaf, h);
      compress(near, positions.of_node + first_node + 16 * h, cluster.node + n);
      fill(group, cluster.group + n);
      n += __builtin_popcount(near);
    }
  }
  cluster.n_listed = n;
  cluster.next_group = k;
  return k == leaf.n_groups;
}

// Returns one bit for each triangle of a group. The bit is 1 if the point is in the triangle's band, which has an offset.
RIIS_INLINE uint32_t bits_in_band(const OneSide &one_side, int32_t group, const ToGroup &to) {
  if (one_side.end_of_band[group] == __builtin_inff()) return 0xffff;
  const Floats depth = Floats::all(one_side.behind) * to.height;
  const Floats sum = multiply_add(depth, Floats::all(one_side.twice_shift), to.distance_sq);
  const Floats excess = least(depth - Floats::all(one_side.least_depth), sum - Floats::all(one_side.least_sum));
  return bits_at_most(excess, Floats::all(0));
}

// Computes the distances of the listed nodes, beginning with the node `from`. Also prefetches the last n_lines lines of
// LinesAhead.
template <bool is_one_sided>
RIIS_INLINE void compare(const FilterTask &task, ClusterTask &cluster, int32_t from, int32_t n_lines) {
  constexpr int n = 4;
  const int32_t end = cluster.n_listed, n_batches = (end - from + n - 1) / n;
  const char *const *ahead = cluster.ahead.line + cluster.ahead.n, *const *const last = ahead - n_lines;
  const int32_t lines_per_batch = (n_lines + n_batches) / (n_batches + 1);
  const auto request_lines = [&] {
    for (int32_t i = 0; i < lines_per_batch && ahead > last; ++i) __builtin_prefetch(*--ahead);
  };
  cluster.ahead.n -= n_lines;
  request_lines();
  // The last batch repeats the last node.
  for (int i = 0; i < n - 1 && from < end; ++i) {
    cluster.node[end + i] = cluster.node[end - 1];
    cluster.group[end + i] = cluster.group[end - 1];
  }
  for (; from < end; from += n) {
    request_lines();
    Floats distances[n];
    uint32_t in_band[n];
    const FilterLimits *limits[n];
#pragma GCC unroll 4
    for (int i = 0; i < n; ++i) {
      const int32_t node = cluster.node[from + i];
      limits[i] = cluster.limits + leaf_of(node);
      const Floats3 p = {Floats::all(cluster.xyz[0][node]), Floats::all(cluster.xyz[1][node]),
                         Floats::all(cluster.xyz[2][node])};
      const ToGroup to = measure_to_group(task.groups[cluster.group[from + i]], p, Floats::all(limits[i]->margin));
      distances[i] = to.distance_sq;
      if constexpr (is_one_sided) in_band[i] = bits_in_band(task.one_side, cluster.group[from + i], to);
      count(&Counts::pairs, task.bounds[cluster.group[from + i]].n);
    }
    least_lanes(distances, cluster.nearest_sq + from);
#pragma GCC unroll 4
    for (int i = 0; i < n; ++i) {
      const float nearest_sq = cluster.nearest_sq[from + i];
      float &best = cluster.best[cluster.node[from + i]];
      best = nearest_sq < best ? nearest_sq : best;
      const uint32_t nearest = bits_at_most(distances[i], Floats::all(nearest_sq + limits[i]->tolerance));
      cluster.triangles[from + i] = static_cast<uint16_t>(nearest);
      if constexpr (is_one_sided) cluster.in_band[from + i] = static_cast<uint16_t>(nearest & in_band[i]);
    }
  }
}

template <bool is_one_sided>
void begin_leaves(const FilterTask &task, ClusterTask &cluster) {
  float *lower_bounds = cluster.lower_bounds;
  for (int32_t i = 0; i < cluster.n_leaves; ++i) {
    begin_leaf<is_one_sided>(task, cluster.leaf[i], cluster, lower_bounds);
    lower_bounds += nodes_per_leaf * cluster.leaf[i].n_groups;
  }
}

void begin_cluster(const FilterTask &task, ClusterTask &cluster) {
  cluster.n_listed = 0;
  cluster.next_leaf = -1;
  cluster.next_group = 0;
  cluster.next_listed = -1;
  cluster.is_done = false;
  task.one_side.end_of_band ? begin_leaves<true>(task, cluster) : begin_leaves<false>(task, cluster);
}

// Drops a node if it is outside the band of every triangle that may be the closest. Judges only nodes of the first n_leaves
// leaves, because the list has all groups near these nodes.
RIIS_INLINE void leave_out(ClusterTask &cluster, int32_t n_leaves) {
  uint32_t stays[leaves_per_cluster] = {};
  for (int32_t i = 0; i < cluster.n_listed; ++i) {
    const int32_t node = cluster.node[i];
    const uint32_t is_in_band = cluster.in_band[i] != 0, is_near = cluster.nearest_sq[i] <= cluster.limit[node];
    stays[leaf_of(node)] |= (is_in_band & is_near) << node % nodes_per_leaf;
  }
  for (int32_t i = 0; i < n_leaves; ++i) {
    LeafTask &leaf = cluster.leaf[i];
    const uint32_t in_band = leaf.found & stays[leaf.position];
    for (uint32_t rest = leaf.found & ~in_band; rest; rest &= rest - 1) {
      const int32_t node = first_node_of(leaf) + __builtin_ctz(rest);
      cluster.best[node] = leaf.limits.reach_sq;
      cluster.limit[node] = -1;
    }
    leaf.found = in_band;
  }
}

// Computes the nodes' distances to their first groups, unless an earlier call has done so. Then lists other groups until the list
// is full, and computes the distances to these groups.
template <bool is_one_sided>
RIIS_INLINE void compare_all(const FilterTask &task, ClusterTask &cluster) {
  const bool is_first = cluster.next_leaf < 0;
  if (is_first) {
    compare<is_one_sided>(task, cluster, 0, cluster.ahead.n / 2);
    cluster.next_leaf = 0;
  }
  const int32_t n_before = cluster.n_listed;
  const float *lower_bounds = cluster.lower_bounds;
  for (int32_t i = 0; i < cluster.n_leaves; ++i) {
    const LeafTask &leaf = cluster.leaf[i];
    if (i == cluster.next_leaf) {
      if (leaf.may_be_near && !list_others(leaf, cluster, lower_bounds)) break;
      ++cluster.next_leaf;
      cluster.next_group = 0;
    }
    lower_bounds += nodes_per_leaf * leaf.n_groups;
  }
  compare<is_one_sided>(task, cluster, n_before, cluster.ahead.n);
  for (int32_t i = 0; i < cluster.n_leaves; ++i) {
    LeafTask &leaf = cluster.leaf[i];
    const Floats reach_sq = Floats::all(leaf.limits.reach_sq), tolerance = Floats::all(leaf.limits.tolerance);
    leaf.found = 0;
    for (int h = 0; h < halves; ++h) {
      const int32_t at = first_node_of(leaf) + 16 * h;
      const Floats best = Floats::load(cluster.best + at), none = Floats::all(-1);
      const Floats limit = choose(best < reach_sq, best + tolerance, none);
      limit.store(cluster.limit + at);
      leaf.found |= bits_different(limit, none) << 16 * h;
    }
  }
  if constexpr (is_one_sided)
    if (is_first) leave_out(cluster, cluster.next_leaf);
}

template <bool is_one_sided>
int32_t filter_nodes(const FilterTask &task, ClusterTask &cluster, const PairArrays &pairs, int32_t room) {
  if (cluster.next_listed < 0) {
    compare_all<is_one_sided>(task, cluster);
    cluster.next_listed = 0;
  }
  // Once the whole list is compared, this loop keeps those listed nodes whose group is still near. The loop writes every node,
  // but moves to the next place only after a node that is kept. This avoids a branch that the processor could not predict.
  const GroupBounds *const bounds = task.bounds;
  int32_t *const node_of_pair = pairs.node, *const triangle_of_pair = pairs.triangle;
  const int32_t n_listed = cluster.n_listed;
  int32_t n = 0, i = cluster.next_listed;
  for (; i < n_listed && n + triangles_per_group <= room; ++i) {
    const int32_t node = cluster.node[i];
    const uint32_t is_near = cluster.nearest_sq[i] <= cluster.limit[node];
    const uint32_t close = cluster.triangles[i] & (0 - is_near);
    fill(node, node_of_pair + n);
    compress(close, bounds[cluster.group[i]].triangle, triangle_of_pair + n);
    n += __builtin_popcount(close);
  }
  cluster.next_listed = i;
  if (i == n_listed) {
    cluster.is_done = cluster.next_leaf == cluster.n_leaves;
    cluster.next_listed = -1;
    cluster.n_listed = 0;
  }
  return n;
}

int32_t filter_cluster(const FilterTask &task, ClusterTask &cluster, const PairArrays &pairs, int32_t room) {
  return task.one_side.end_of_band ? filter_nodes<true>(task, cluster, pairs, room)
                                   : filter_nodes<false>(task, cluster, pairs, room);
}

void group_distances(const TriangleGroup &group, const float *point, float margin, float *distance_sq) {
  alignas(64) float d[16];
  measure_to_group(group, all(point), Floats::all(margin)).distance_sq.store(d);
  for (int i = 0; i < 16; ++i) distance_sq[i] = d[i];
}

void rank(const int32_t *key, int32_t n, int32_t *n_less) {
  typedef IntRegister InMemory __attribute__((may_alias));
  const auto *const keys = reinterpret_cast<const InMemory *>(key);
  auto *const to = reinterpret_cast<InMemory *>(n_less);
  constexpr int n_registers = keys_at_once * static_cast<int>(sizeof *key) / register_bytes;
  constexpr int together = 4;  // each loaded key is compared with this number of registers at once
  for (int first = 0; first < n_registers; first += together) {
    IntRegister of[together], less[together] = {};
    for (int k = 0; k < together; ++k) of[k] = keys[first + k];
    for (int32_t i = 0; i < n; ++i)
      for (int k = 0; k < together; ++k) less[k] -= key[i] < of[k];
    for (int k = 0; k < together; ++k) to[first + k] = less[k];
  }
}

}  // namespace

const FilterKernels RIIS_KERNELS(filter_kernels) = {near_boxes,     near_own_boxes,   select,
                                                    nearest_groups, competing_groups, begin_cluster,
                                                    filter_cluster, group_distances,  rank};

}  // namespace riis
