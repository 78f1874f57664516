// SPDX-License-Identifier: Apache-2.0
// The filter dismisses pairs of nodes and triangles that cannot matter. It computes in single precision and is compiled for each
// instruction set.
#include "kernels/lanes.hpp"
#include "kernels/table.hpp"

namespace riis {
namespace {

struct Floats3 {
  Floats x, y, z;
};

RIIS_INLINE Floats3 all(const float *p) { return {Floats::all(p[0]), Floats::all(p[1]), Floats::all(p[2])}; }
RIIS_INLINE Floats dot(Floats3 a, Floats3 b) { return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z)); }
RIIS_INLINE Floats3 operator-(Floats3 a, Floats3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
RIIS_INLINE Floats3 load(const float (*from)[16]) {
  return {Floats::load(from[0]), Floats::load(from[1]), Floats::load(from[2])};
}

// Returns the distance of x from the interval from..to.
RIIS_INLINE Floats outside(Floats x, Floats from, Floats to) {
  return greatest(greatest(from - x, x - to), Floats::all(0));
}

// Computes the squares of the distances of n points to sixteen triangles. The points are computed together, so that a triangle's
// numbers are loaded once. Every result is the distance to some point of the triangle, to rounding. A point counts as inside
// only if it is inside by a margin. A point inside by less gets the distance to the nearest edge, which differs by at most that
// margin. The function writes its results directly to memory. If it returned them, GCC would copy them in pieces, and later loads
// would wait for the pieces.
template <int n>
RIIS_INLINE void distances_to_group(const TriangleGroup &group, const Floats3 (&p)[n], Floats margin,
                                    Floats *distances) {
  const Floats zero = Floats::all(0);
  Floats e[n], f[n], g[n], in_plane[n];
  const auto beyond = [&](Floats along, Floats end) RIIS_LAMBDA { return along - least(greatest(along, zero), end); };
  {
    const Floats3 a = load(group.a), unit_e = load(group.e), unit_f = load(group.f), unit_g = load(group.g);
    for (int i = 0; i < n; ++i) {
      const Floats3 r = p[i] - a;
      e[i] = dot(r, unit_e);
      f[i] = dot(r, unit_f);
      g[i] = dot(r, unit_g);
    }
  }
  const Floats ab = Floats::load(group.ab), ac = Floats::load(group.ac), bc = Floats::load(group.bc);
  const Floats ac_e = Floats::load(group.ac_e), ac_f = Floats::load(group.ac_f);
  const Floats bc_e = Floats::load(group.bc_e), bc_f = Floats::load(group.bc_f);
  for (int i = 0; i < n; ++i) {
    const Floats past_ab = beyond(e[i], ab);
    in_plane[i] = multiply_add(past_ab, past_ab, f[i] * f[i]);

    const Floats inside_ac = subtract_product(f[i], ac_e, e[i] * ac_f);
    const Floats past_ac = beyond(multiply_add(e[i], ac_e, f[i] * ac_f), ac);
    in_plane[i] = least(in_plane[i], multiply_add(past_ac, past_ac, inside_ac * inside_ac));

    const Floats eb = e[i] - ab;
    const Floats inside_bc = subtract_product(eb, bc_f, f[i] * bc_e);
    const Floats past_bc = beyond(multiply_add(eb, bc_e, f[i] * bc_f), bc);
    in_plane[i] = least(in_plane[i], multiply_add(past_bc, past_bc, inside_bc * inside_bc));

    in_plane[i] = zero_where_at_least(least(least(f[i], inside_ac), inside_bc), margin, in_plane[i]);
    distances[i] = multiply_add(g[i], g[i], in_plane[i]);
  }
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
  const Floats reach_sq = Floats::all(task.reach_sq);
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

int32_t select(const int32_t *numbers, const uint16_t *marks, int32_t n, int32_t bit, int32_t *to) {
  // No more numbers are selected than were read, so even a whole register stays within the first n places.
  int32_t n_selected = 0, k = 0;
  for (; k + 16 <= n; k += 16) {
    const uint32_t lanes = lanes_with_bit(marks + k, bit);
    compress(lanes, numbers + k, to + n_selected);
    n_selected += __builtin_popcount(lanes);
  }
  // Writes every number, but moves on only after a number that is kept. This avoids a branch that the processor could not
  // predict.
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
    at = choose<float, FloatRegister, 16>(sum < least_sq, Floats::all(static_cast<float>(k)), at);
    least_sq = least(least_sq, sum);
  }
  alignas(64) float positions[16];
  at.store(positions);
  for (int i = 0; i < 16; ++i) nearest[i] = static_cast<int32_t>(positions[i]);
}

// The square of a place's distance from a box minus the square of its distance from a point is a concave function of the place.
// It is also a sum over the axes. So its least value in another box is the sum of the lesser values at both ends of each axis.
void competing_groups(const FilterTask &task, const Boxes &boxes, const PointsOfBoxes &points,
                      const int32_t *candidates, int32_t n_candidates, uint16_t *competes) {
  const Floats zero = Floats::all(0), tolerance = Floats::load(points.tolerance);
  Extents box[3], to_point[3];  // to_point has the negated squares of the distances from the ends to the point
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

// Computes squares of bounds for the nodes p of a leaf, in the surface's frame. For every group and every node, computes a lower
// bound on their distance. For every node, computes an upper bound on its distance to the surface: the distance to the nearest
// of the groups' corners.
RIIS_INLINE void begin_leaf(const FilterTask &task, LeafTask &leaf, const Floats3 *p) {
  Floats best[halves];
  for (int h = 0; h < halves; ++h) best[h] = Floats::all(task.reach_sq);
  for (int32_t k = 0; k < leaf.n_groups; ++k) {
    const GroupBounds &group = task.bounds[leaf.near_groups[k]];
    const Floats3 corner = all(group.corner);
    for (int h = 0; h < halves; ++h) {
      const Floats3 d = p[h] - corner;
      best[h] = least(best[h], dot(d, d));
      Floats sum = Floats::all(0);
      for (int i = 0; i < 3; ++i) {
        const Floats gap = outside(dot(p[h], all(group.axis[i])), Floats::all(group.from[i]), Floats::all(group.to[i]));
        sum = multiply_add(gap, gap, sum);
      }
      sum.store(leaf.lower_bounds + nodes_per_leaf * k + 16 * h);
    }
  }
  for (int h = 0; h < halves; ++h) best[h].store(leaf.best + 16 * h);
}

// Moves one group to the front: the group with the least sum of bounds to two of the leaf's nodes. So near triangles are found
// early, and groups farther away need no comparison.
RIIS_INLINE void nearest_first(const LeafTask &leaf) {
  int32_t nearest = 0;
  float least_sum = __builtin_inff();
  for (int32_t k = 0; k < leaf.n_groups; ++k) {
    const float *bounds = leaf.lower_bounds + nodes_per_leaf * k;
    const float sum = bounds[nodes_per_leaf / 3] + bounds[2 * nodes_per_leaf / 3];
    if (sum < least_sum) least_sum = sum, nearest = k;
  }
  if (nearest == 0) return;
  const int32_t group = leaf.near_groups[0];
  leaf.near_groups[0] = leaf.near_groups[nearest];
  leaf.near_groups[nearest] = group;
  for (int h = 0; h < halves; ++h) {
    float *a = leaf.lower_bounds + 16 * h, *b = leaf.lower_bounds + nodes_per_leaf * nearest + 16 * h;
    const Floats of_a = Floats::load(a);
    Floats::load(b).store(a);
    of_a.store(b);
  }
}

RIIS_INLINE uint32_t nodes_near(const FilterTask &task, const LeafTask &leaf, int32_t k) {
  uint32_t near = 0;
  for (int h = 0; h < halves; ++h) {
    const Floats limit = Floats::load(leaf.best + 16 * h) + Floats::all(task.tolerance);
    near |= bits_at_most(Floats::load(leaf.lower_bounds + nodes_per_leaf * k + 16 * h), limit) << 16 * h;
  }
  return near & leaf.wanted;
}

// A node and a group, with the triangles of the group that were close to the node when both were compared.
struct Close {
  float nearest_sq;
  int32_t group;  // position in the leaf's near_groups
  uint32_t triangles;
  int32_t lane;
};

// Compares a group with the next four nodes of `rest`, or with fewer if fewer are left. Appends the nodes that are close to some
// of the group's triangles, and returns the number of these nodes.
RIIS_INLINE int32_t compare(const FilterTask &task, LeafTask &leaf, const float (*xyz)[nodes_per_leaf], int32_t k,
                            uint32_t *rest, Close *found) {
  const GroupBounds &bounds = task.bounds[leaf.near_groups[k]];
  const TriangleGroup &group = task.groups[leaf.near_groups[k]];
  const uint32_t in_use = (1u << bounds.n) - 1;
  const Floats margin = Floats::all(task.margin);
  constexpr int n = 4, n_together = 2;
  int lanes[n];
  Floats distances[n];
#pragma GCC unroll 2
  for (int i = 0; i < n; i += n_together) {
    if (!*rest) {
      // This loop fills lanes that nobody reads. Without it, GCC would set their distances by memset and copy them in pieces,
      // which is slow.
#pragma GCC unroll 4
      for (int j = i; j < n; ++j) {
        lanes[j] = -1;
        for (int r = 0; r < Floats::n_registers; ++r) distances[j].part[r] = distances[0].part[r];
      }
      break;
    }
    Floats3 points[n_together];
    for (int j = 0; j < n_together; ++j) {
      const int lane = *rest ? __builtin_ctz(*rest) : lanes[i];
      lanes[i + j] = *rest ? lane : -1;
      *rest &= *rest - 1;
      points[j] = {Floats::all(xyz[0][lane]), Floats::all(xyz[1][lane]), Floats::all(xyz[2][lane])};
    }
    distances_to_group(group, points, margin, distances + i);
    count(&Counts::pairs, int64_t{n_together} * bounds.n);
  }
  float nearest[n];
  least_lanes(distances, nearest);
  int32_t n_found = 0;
  for (int i = 0; i < n && lanes[i] >= 0; ++i) {
    float &best = leaf.best[lanes[i]];
    best = nearest[i] < best ? nearest[i] : best;
    const uint32_t close = bits_at_most(distances[i], Floats::all(best + task.tolerance)) & in_use;
    found[n_found] = {nearest[i], k, close, lanes[i]};
    n_found += close != 0;
  }
  return n_found;
}

int32_t filter_leaf(const FilterTask &task, LeafTask &leaf, const PairArrays &pairs, int32_t room) {
  Floats3 p[halves];
  alignas(64) float xyz[3][nodes_per_leaf];
  const Floats ratio = Floats::all(task.ratio);
  for (int h = 0; h < halves; ++h) {
    p[h] = {multiply_add(Floats::load(leaf.leaf->x + 16 * h), ratio, Floats::all(task.shift[0])),
            multiply_add(Floats::load(leaf.leaf->y + 16 * h), ratio, Floats::all(task.shift[1])),
            multiply_add(Floats::load(leaf.leaf->z + 16 * h), ratio, Floats::all(task.shift[2]))};
    p[h].x.store(xyz[0] + 16 * h);
    p[h].y.store(xyz[1] + 16 * h);
    p[h].z.store(xyz[2] + 16 * h);
  }
  int32_t k = leaf.next_group;
  uint32_t rest = leaf.rest;
  if (k == 0 && rest == 0) {
    begin_leaf(task, leaf, p);
    nearest_first(leaf);
    rest = leaf.n_groups > 0 ? nodes_near(task, leaf, 0) : 0;
  }
  constexpr int32_t most_at_once = 4, most = 256;
  Close found[most];
  const int32_t room_for_found = room / triangles_per_group < most ? room / triangles_per_group : most;
  int32_t n_found = 0;
  while (k < leaf.n_groups) {
    while (rest && n_found + most_at_once <= room_for_found)
      n_found += compare(task, leaf, xyz, k, &rest, found + n_found);
    if (rest) break;
    if (++k < leaf.n_groups) rest = nodes_near(task, leaf, k);
  }
  leaf.next_group = k;
  leaf.rest = rest;
  // Drops pairs that counted as near only because a nearer triangle had not been found yet.
  int32_t n = 0;
  uint32_t nodes = 0;
  for (int32_t i = 0; i < n_found; ++i) {
    const Close &close = found[i];
    if (!(close.nearest_sq <= leaf.best[close.lane] + task.tolerance)) continue;
    fill(leaf.first_node + close.lane, pairs.node + n);
    compress(close.triangles, task.bounds[leaf.near_groups[close.group]].triangle, pairs.triangle + n);
    n += __builtin_popcount(close.triangles);
    nodes |= 1u << close.lane;
  }
  leaf.found = nodes;
  return n;
}

void group_distances(const TriangleGroup &group, const float *point, float margin, float *distance_sq) {
  const Floats3 points[1] = {all(point)};
  Floats distances[1];
  distances_to_group(group, points, Floats::all(margin), distances);
  alignas(64) float d[16];
  distances[0].store(d);
  for (int i = 0; i < 16; ++i) distance_sq[i] = d[i];
}

void rank(const int32_t *key, int32_t n, int32_t *n_less) {
  typedef IntRegister InMemory __attribute__((may_alias));
  const auto *const keys = reinterpret_cast<const InMemory *>(key);
  auto *const to = reinterpret_cast<InMemory *>(n_less);
  constexpr int n_registers = keys_at_once * static_cast<int>(sizeof *key) / register_bytes;
  constexpr int together = 4;  // registers that each loaded key is compared with at once
  for (int first = 0; first < n_registers; first += together) {
    IntRegister of[together], less[together] = {};
    for (int k = 0; k < together; ++k) of[k] = keys[first + k];
    for (int32_t i = 0; i < n; ++i)
      for (int k = 0; k < together; ++k) less[k] -= key[i] < of[k];
    for (int k = 0; k < together; ++k) to[first + k] = less[k];
  }
}

}  // namespace

const FilterKernels RIIS_KERNELS(filter_kernels) = {
    near_boxes, select, nearest_groups, competing_groups, filter_leaf, group_distances, rank};

}  // namespace riis
