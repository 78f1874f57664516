// SPDX-License-Identifier: Apache-2.0
#include "search/cluster_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <type_traits>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "geometry/point_triangle.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// For lengths above `large` in the surface's frame, single precision cannot distinguish the triangles.
constexpr double large = 0x1p20;

// If more than `most_groups` groups are near a leaf, querying each node is faster. This many groups are near a leaf only if the
// leaf is large and the triangles near it are small.
constexpr std::size_t most_groups = 4096;

// Maps the mesh's frame to the surface's frame.
struct Placing {
  double ratio;
  Vec3 shift;
  double largest_shift;

  Placing(const NodeFrame &nodes, const SurfaceFrame &frame)
      : ratio(frame.scale / nodes.scale),
        shift(frame.scale * (nodes.centre - frame.centre)),
        largest_shift(largest_coordinate(shift)) {}
};

#if defined(__SIZEOF_INT128__)
// A number for each triangle. If the squares of the distances are finite, these numbers have the order of is_closer. The first 64
// bits of the number are the bits of the square. Squares are never negative, so the order of their bits is the order of the
// squares. The last 64 bits are the triangle, or the largest number if there is no triangle.
__extension__ typedef unsigned __int128 Rank;
Rank rank_of(const ClosestTriangle &closest) {
  std::uint64_t square;
  std::memcpy(&square, &closest.distance_sq, sizeof square);
  return static_cast<Rank>(square) << 64 | static_cast<std::uint64_t>(closest.triangle);
}
ClosestTriangle of_rank(Rank rank) {
  const auto square = static_cast<std::uint64_t>(rank >> 64);
  ClosestTriangle closest{0, static_cast<std::int64_t>(rank)};
  std::memcpy(&closest.distance_sq, &square, sizeof square);
  return closest;
}
// The code has no branch, because the processor could not predict which triangle is closer.
ClosestTriangle closer_of(const ClosestTriangle &a, const ClosestTriangle &b) {
  return of_rank(std::min(rank_of(a), rank_of(b)));
}
#else
ClosestTriangle closer_of(const ClosestTriangle &a, const ClosestTriangle &b) {
  return is_closer(a.distance_sq, a.triangle, b) ? a : b;
}
#endif

// Nodes whose clusters are stored. GridClusters, which makes its clusters when they are needed, has the same functions.
class StoredClusters {
 public:
  typedef GridClusters::Room Room;  // is not used

  explicit StoredClusters(const Clusters &clusters) : clusters_(clusters) {}
  const Clusters &stored() const { return clusters_; }
  const NodeFrame &frame() const { return clusters_.frame; }
  std::int64_t n_clusters() const { return view(clusters_.clusters).size(); }
  const Boxes &region(std::int64_t region, Room *) const { return view(clusters_.regions)[region]; }
  const Boxes &cluster(std::int64_t cluster, Room *) const { return view(clusters_.clusters)[cluster]; }

 private:
  const Clusters &clusters_;
};

// One cluster while it is searched. Nodes are given by their positions in the cluster.
template <class Nodes>
class OpenCluster;

template <>
class OpenCluster<StoredClusters> {
 public:
  OpenCluster(const StoredClusters &nodes, std::int64_t cluster, std::uint32_t, GridClusters::Room *)
      : clusters_(nodes.stored()), first_leaf_(cluster * leaves_per_cluster) {}
  const Leaf &leaf(int i) const { return clusters_.leaves.get()[first_leaf_ + i]; }
  const LeafPoints &points(int i) const { return clusters_.points.get()[first_leaf_ + i]; }
  std::uint32_t lanes(int i) const {
    const int n = clusters_.n_nodes_of(first_leaf_ + i);
    return n == nodes_per_leaf ? 0xffffffffu : (1u << n) - 1;
  }
  // Returns the numbers of a leaf's nodes.
  const std::uint32_t *numbers(int i) const { return leaf(i).node; }
  void fill_points(int, std::uint32_t) const {}

 private:
  const Clusters &clusters_;
  std::int64_t first_leaf_;
};

template <>
class OpenCluster<GridClusters> {
 public:
  OpenCluster(const GridClusters &nodes, std::int64_t cluster, std::uint32_t near_leaves, GridClusters::Room *room)
      : nodes_(nodes), room_(*room) {
    nodes.open(cluster, near_leaves, *room);
  }
  const Leaf &leaf(int i) const { return room_.leaves[i]; }
  const LeafPoints &points(int i) const { return room_.points[i]; }
  std::uint32_t lanes(int i) const { return nodes_.lanes(i, room_); }
  GridClusters::Numbers numbers(int i) const { return nodes_.numbers(i, room_); }
  void fill_points(int i, std::uint32_t lanes) const { nodes_.fill_points(i, lanes, room_); }

 private:
  const GridClusters &nodes_;
  GridClusters::Room &room_;
};

template <class Nodes>
class ClusterSearch {
  static constexpr bool is_stored = std::is_same_v<Nodes, StoredClusters>;
  typedef OpenCluster<Nodes> Open;

 public:
  ClusterSearch(const NodeSearch &request, const Nodes &nodes, const Kernels &kernels, ClusterScratch &scratch,
                FoundNodes &found)
      : request_(request),
        scene_(request.surface.scene()),
        groups_(scene_.groups()),
        nodes_(nodes),
        placing_(nodes.frame(), groups_.frame),
        limit_(std::min(request.distance_limit * groups_.frame.scale, large)),
        kernels_(kernels),
        found_(found),
        own_(scratch) {
    task_.ratio = static_cast<float>(placing_.ratio);
    task_.shift[0] = static_cast<float>(placing_.shift.x);
    task_.shift[1] = static_cast<float>(placing_.shift.y);
    task_.shift[2] = static_cast<float>(placing_.shift.z);
    task_.groups = groups_.groups.data();
    task_.bounds = groups_.bounds.data();
    const double error = limits_within(limit_, task_.limits);
    if (request.listed) look_at_one_side(*request.listed, error);
    of_packs_ = task_;
    of_packs_.bounds = groups_.packs.data();
    const auto n_groups = view(groups_.groups).size();
    for (auto i = view(own_.all_groups).size(); i < n_groups; ++i)
      own_.all_groups.push_back(static_cast<std::int32_t>(i));
    found.prepare(request.n_threads, request.ties);
    own_.prepare(request.n_threads, !is_stored);
  }

  // Finds the clusters that may be near the surface. For each such cluster, lists the groups that may be near the cluster. For
  // each of these groups, sets the bits of those leaves of the cluster that may be near the group.
  void find_near_clusters() {
    std::int64_t n_near;
    if constexpr (is_stored) {
      list_near_regions();
      n_near = view(own_.near_regions).size();
    } else {
      n_near = nodes_.n_regions();  // all regions are near, because the grid's box is around the surface
    }
    constexpr std::int64_t few = 64;  // searching this many regions takes a few tenths of a millisecond
    const int n_ran = parallel_for(n_near, request_.n_threads.for_part(n_near, few), [&](std::int64_t i, int thread) {
      search_region(is_stored ? view(own_.near_regions)[i] : i, view(own_.threads)[thread]);
    });
    n_threads_ = std::max(n_threads_, n_ran);
  }

  void search_near_clusters() {
    std::vector<ClusterScratch::Item> &items = own_.items;
    items.clear();
    for (std::size_t thread = 0; thread < own_.threads.size(); ++thread)
      for (ClusterScratch::Item item : own_.threads[thread].items) {
        item.thread = static_cast<int>(thread);
        items.push_back(item);
      }
    constexpr std::int64_t few = 128;  // searching this many clusters takes about half a millisecond
    const auto n = view(items).size();
    const int n_ran = parallel_for(n, request_.n_threads.for_part(n, few), [&](std::int64_t i, int thread) {
      search_cluster(view(items)[i], view(own_.threads)[thread], thread, nullptr,
                     i + 1 < n ? leaves_ahead(view(items)[i + 1].cluster, view(items)[i + 1].near_leaves)
                               : LeavesAhead{nullptr, 0});
    });
    n_threads_ = std::max(n_threads_, n_ran);
  }

  // Searches with a limit that excludes few or no triangles. Each box of nodes has its own bound instead: the distance from a
  // point of the surface near the box (docs/theory/clusters.md, "Every distance").
  void search_every_cluster() {
    const auto n = nodes_.n_clusters();
    // If several threads share the clusters of a region, each thread has to compare the region with the groups.
    const std::int64_t per_block = n < 64 * request_.n_threads ? 1 : Clusters::clusters_per_region;
    constexpr std::int64_t few = 4;  // searching this many clusters takes about half a millisecond
    n_threads_ =
        parallel_for_ranges(n, per_block, request_.n_threads.for_part(n, few), [&](const Range &range, int thread) {
          for (std::int64_t cluster = range.begin; cluster < range.end; ++cluster)
            search_alone(cluster, view(own_.threads)[thread], thread);
        });
  }

  SearchReport report() {
    std::int64_t n_queries = 0;
    for (const auto &own : own_.threads) n_queries += own.n_queries;
    return {n_queries, n_threads_, true, 0};
  }

 private:
  // The extent of a box along one axis, in the surface's frame.
  struct Interval {
    float from, to;
  };
  Interval placed(const Clusters::Box &box, int axis) const {
    return {box.lower[axis] * task_.ratio + task_.shift[axis], box.upper[axis] * task_.ratio + task_.shift[axis]};
  }

  void list_near_regions() {
    const Bounds &bounds = scene_.bounds();
    const Vec3 lower = groups_.frame(bounds.lower), upper = groups_.frame(bounds.upper);
    const float surface_lower[3] = {round_down(lower.x), round_down(lower.y), round_down(lower.z)};
    const float surface_upper[3] = {round_up(upper.x), round_up(upper.y), round_up(upper.z)};
    const Clusters &clusters = nodes_.stored();
    const auto n_regions = view(clusters.regions).size();
    own_.near_regions.clear();
    own_.near_regions.reserve(static_cast<std::size_t>(n_regions));
    for (std::int64_t region = 0; region < n_regions; ++region) {
      const Clusters::Box &box = view(clusters.boxes)[region];
      float gap_sq = 0;
      for (int i = 0; i < 3; ++i) {
        const auto [from, to] = placed(box, i);
        const float gap = std::max({from - surface_upper[i], surface_lower[i] - to, 0.0f});
        gap_sq += gap * gap;
      }
      if (gap_sq <= task_.limits.reach_sq) own_.near_regions.push_back(region);
    }
  }

  // Appends the groups of all packs whose bit is set.
  void add_groups_of_packs(const std::vector<std::uint16_t> &bits, std::vector<std::int32_t> &to) const {
    for (std::int64_t pack = 0; pack < view(groups_.packs).size(); ++pack) {
      if (!view(bits)[pack]) continue;
      const Range of_pack = groups_.groups_of(pack);
      for (std::int64_t group = of_pack.begin; group < of_pack.end; ++group)
        to.push_back(static_cast<std::int32_t>(group));
    }
  }

  void search_region(std::int64_t region, ClusterScratch::Thread &own) {
    ++own.n_queries;
    own.candidates.clear();
    // The box of a group lies within the box of its pack, even after rounding. If a group is near a cluster, its pack is
    // therefore near also.
    own.bits.resize(groups_.packs.size());
    const Boxes &clusters = nodes_.region(region, own.room.get());
    if (!kernels_.near_boxes(of_packs_, clusters, own_.all_groups.data(),
                             static_cast<std::int32_t>(groups_.packs.size()), own.bits.data()))
      return;
    add_groups_of_packs(own.bits, own.candidates);
    own.bits.resize(own.candidates.size());
    if (!kernels_.near_boxes(task_, clusters, own.candidates.data(), static_cast<std::int32_t>(own.candidates.size()),
                             own.bits.data()))
      return;
    const std::int64_t first = region * Clusters::clusters_per_region;
    const std::int64_t end = std::min(first + Clusters::clusters_per_region, nodes_.n_clusters());
    for (std::int64_t cluster = first; cluster < end; ++cluster) add_cluster(cluster, cluster - first, own);
  }

  // Appends numbers[k] for each k whose bits[k] has the given bit. Returns how many numbers were appended.
  std::size_t add_marked(const std::int32_t *numbers, const std::uint16_t *bits, std::size_t n, std::int64_t bit,
                         std::vector<std::int32_t> &to) const {
    const std::size_t first = to.size();
    to.resize(first + n);
    const auto n_added = static_cast<std::size_t>(kernels_.select(numbers, bits, static_cast<std::int32_t>(n),
                                                                  static_cast<std::int32_t>(bit), to.data() + first));
    to.resize(first + n_added);
    return n_added;
  }

  static std::uint32_t near_leaves(const std::uint16_t *leaf_bits, std::size_t n) {
    std::uint32_t near = 0;
    for (std::size_t k = 0; k < n; ++k) near |= leaf_bits[k];
    return near;
  }

  static std::size_t n_marked(const std::uint16_t *bits, std::size_t n, std::int64_t bit) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < n; ++k) count += bits[k] >> bit & 1;
    return count;
  }

  void add_cluster(std::int64_t cluster, std::int64_t bit, ClusterScratch::Thread &own) {
    const std::size_t first = own.near_groups.size();
    const std::size_t n =
        add_marked(own.candidates.data(), own.bits.data(), own.candidates.size(), bit, own.near_groups);
    if (n == 0) return;
    own.leaf_bits.resize(first + n);
    const Boxes &leaves = nodes_.cluster(cluster, own.room.get());
    const std::int32_t *const near_groups = own.near_groups.data() + first;
    std::uint16_t *const leaf_bits = own.leaf_bits.data() + first;
    const auto n_near = static_cast<std::int32_t>(n);
    // If many groups are near a cluster, the groups are smaller than the cluster's leaves. The boxes along the groups' own axes
    // then exclude few clusters.
    constexpr std::size_t many = 32;
    if (kernels_.near_boxes(task_, leaves, near_groups, n_near, leaf_bits) &&
        (n > many || kernels_.near_own_boxes(task_, leaves, near_groups, n_near, leaf_bits))) {
      own.items.push_back({cluster, first, n, 0, near_leaves(leaf_bits, n)});
    } else {
      own.near_groups.resize(first);
      own.leaf_bits.resize(first);
    }
  }

  // Calls visit(address) for each cache line of an array.
  template <class Visit>
  static void for_each_line(const void *from, std::size_t size, const Visit &visit) {
    constexpr std::size_t line = 64;
    for (std::size_t at = 0; at < size; at += line) visit(static_cast<const char *>(from) + at);
  }

  // The leaves of the next cluster that will be filtered. The coordinates of these leaves are prefetched one leaf at a time (see
  // LinesAhead).
  struct LeavesAhead {
    const Leaf *first;
    std::uint32_t near;

    void request_one() {
      if (near == 0) return;
      for_each_line(first[__builtin_ctz(near)].x, 3 * sizeof(Leaf::x),
                    [](const char *line) { __builtin_prefetch(line); });
      near &= near - 1;
    }
  };
  // Returns the near leaves of a cluster. The leaves of a grid need no prefetch, because the thread that reads them has filled
  // them itself.
  LeavesAhead leaves_ahead(std::int64_t cluster, std::uint32_t near) const {
    if constexpr (is_stored)
      return {&nodes_.stored().leaves.get()[cluster * leaves_per_cluster], near};
    else
      return {nullptr, 0};
  }
  LeavesAhead every_leaf_ahead(std::int64_t cluster) const {
    if constexpr (is_stored) {
      if (cluster == nodes_.n_clusters()) return {nullptr, 0};
      const Range leaves = nodes_.stored().leaves_of(cluster);
      return leaves_ahead(cluster, (1u << (leaves.end - leaves.begin)) - 1);
    } else {
      return {nullptr, 0};
    }
  }

  // Pairs of a node of the cluster and a triangle, which the filter did not dismiss. The pairs are stored until double precision
  // decides between the triangles.
  struct Pairs {
    const Open &cluster;
    Ties *ties;  // or null
    LeavesAhead ahead;
    std::int32_t n = 0;
    std::uint32_t nodes[leaves_per_cluster] = {};  // for each leaf, a bit for each node that has or had pairs
  };

  // Computes the filter's limits for a distance limit in the surface's frame. Returns the filter's error.
  double limits_within(double limit, FilterLimits &limits) const {
    const double scale = groups_.frame.scale;
    // The first term is the filter's own error. The second term covers the rounding of the distances in double precision. The
    // third term covers ties, which may be slightly farther than the closest triangle.
    const double error = filter_error(placing_.ratio, placing_.largest_shift, limit, groups_.longest_edge) +
                         4 * scene_.rounding() * scale + request_.ties.of_leaflets * scale;
    limits.reach_sq = static_cast<float>((limit + 2 * error) * (limit + 2 * error));
    limits.tolerance = filter_tolerance(error, limit + 2 * error);
    limits.margin = static_cast<float>(0.5 * error);
    return error;
  }

  // Prepares the filter for a band with an offset. The filter then leaves out nodes far behind the surface
  // (docs/theory/clusters.md, "One side").
  void look_at_one_side(const Band &band, double error) {
    const double half_thickness = band.half_thickness * groups_.frame.scale;
    if (!(half_thickness <= large)) return;
    // Normals are less accurate than distances, so the limits have a margin.
    constexpr double margin = 0x1p-10;
    const double shift = std::abs(band.offset) * half_thickness, reach = limit_ + 2 * error;
    const double depth = error + margin * half_thickness;
    const double sum = (half_thickness + shift) * (half_thickness - shift) + margin * half_thickness * half_thickness +
                       2 * shift * error + task_.limits.tolerance;
    const int behind = band.offset > 0 ? -1 : 1;
    task_.one_side = {static_cast<float>(behind), static_cast<float>(2 * shift), round_up(depth), round_up(sum)};
    const auto n_groups = view(groups_.groups).size();
    resize(own_.ends_of_band, n_groups);
    for (std::int64_t i = 0; i < n_groups; ++i) {
      const TriangleGroup &group = view(groups_.groups)[i];
      const GroupBounds &bounds = view(groups_.bounds)[i];
      const double cosine = least_cosine(group, bounds);
      float &end = view(own_.ends_of_band)[i] = std::numeric_limits<float>::infinity();
      if (cosine < 0.5 || has_needle(group)) continue;
      const double sine = std::sqrt(1 - cosine * cosine), begin = behind < 0 ? -bounds.from[0] : bounds.to[0];
      const double by_depth = depth * cosine + sine * std::sqrt((reach - depth) * (reach + depth));
      const double by_sum = std::sqrt(shift * shift + sum) - shift * cosine;
      end = round_up(begin + std::max(by_depth, by_sum) + error);
    }
    task_.one_side.end_of_band = own_.ends_of_band.data();
  }

  // Returns whether a group has a triangle with so little height that the normal is inaccurate.
  static bool has_needle(const TriangleGroup &group) {
    constexpr float least_height = 1e-10f;
    bool has_one = false;
    for (int i = 0; i < triangles_per_group; ++i) {
      const float longest = std::max({group.half_ab[i], group.half_ac[i], group.half_bc[i]});
      const float half_area = group.half_ab[i] * group.half_ac[i] * std::abs(group.ac_f[i]);
      has_one = has_one || !(2 * half_area >= least_height * longest);
    }
    return has_one;
  }

  // Compares the normals of a group's triangles with the group's first axis. Returns a lower bound on the cosine of the angle
  // between a normal and this axis.
  static double least_cosine(const TriangleGroup &group, const GroupBounds &bounds) {
    const float(&axis)[3] = bounds.axis[0];
    float least = 1;
    for (int i = 0; i < triangles_per_group; ++i)
      least = std::min(least, group.g[0][i] * axis[0] + group.g[1][i] * axis[1] + group.g[2][i] * axis[2]);
    return static_cast<double>(least) - 0x1p-20;
  }

  // Finds the triangle of the group that is nearest to `to`, and returns the closest point on this triangle.
  Vec3 point_of_surface(std::int32_t group, Vec3 to) const {
    const float point[3] = {static_cast<float>(to.x), static_cast<float>(to.y), static_cast<float>(to.z)};
    float distance_sq[triangles_per_group];
    kernels_.group_distances(view(groups_.groups)[group], point, 0, distance_sq);
    const GroupBounds &bounds = view(groups_.bounds)[group];
    const auto nearest = std::min_element(distance_sq, distance_sq + bounds.n) - distance_sq;
    const double *c = groups_.corners.data() + 9 * std::int64_t{bounds.triangle[nearest]};
    const SurfaceFrame &frame = groups_.frame;
    return frame(closest_point_on_triangle(frame.centre + (1 / frame.scale) * to, {c[0], c[1], c[2]},
                                           {c[3], c[4], c[5]}, {c[6], c[7], c[8]})
                     .point);
  }

  // For each of 16 boxes, an upper bound on the distances of the nodes in the box, in the surface's frame.
  struct UpperBounds {
    double of_box[leaves_per_cluster];
  };

  // For each candidate group, sets the bits of the boxes that may have nodes whose closest triangle is in the group.
  UpperBounds compare(const Boxes &boxes, const std::int32_t *candidates, std::size_t n,
                      std::uint16_t *competes) const {
    std::int32_t nearest[leaves_per_cluster];
    const auto n_candidates = static_cast<std::int32_t>(n);
    kernels_.nearest_groups(task_, boxes, candidates, n_candidates, nearest);
    UpperBounds bounds;
    PointsOfBoxes points;
    for (int k = 0; k < leaves_per_cluster; ++k) {
      bounds.of_box[k] = 0;
      points.xyz[0][k] = points.xyz[1][k] = points.xyz[2][k] = points.tolerance[k] = 0;
      if (!(boxes.lower[0][k] <= boxes.upper[0][k])) continue;
      const auto end = [&](const float(&ends)[3][16]) {
        return placing_.ratio * Vec3{ends[0][k], ends[1][k], ends[2][k]} + placing_.shift;
      };
      const Vec3 lower = end(boxes.lower), upper = end(boxes.upper);
      const Vec3 point = point_of_surface(candidates[nearest[k]], 0.5 * (lower + upper));
      const auto farthest = [](double p, double from, double to) {
        return std::max(std::abs(p - from), std::abs(p - to));
      };
      const double to_farthest = length(Vec3{farthest(point.x, lower.x, upper.x), farthest(point.y, lower.y, upper.y),
                                             farthest(point.z, lower.z, upper.z)});
      bounds.of_box[k] = to_farthest + 0x1p-21 * (placing_.ratio + placing_.largest_shift + 6) +
                         2 * scene_.rounding() * groups_.frame.scale;
      FilterLimits limits;
      limits_within(bounds.of_box[k], limits);
      points.xyz[0][k] = static_cast<float>(point.x);
      points.xyz[1][k] = static_cast<float>(point.y);
      points.xyz[2][k] = static_cast<float>(point.z);
      points.tolerance[k] = limits.tolerance;
    }
    kernels_.competing_groups(task_, boxes, points, candidates, n_candidates, competes);
    return bounds;
  }

  void search_alone(std::int64_t cluster, ClusterScratch::Thread &own, int thread) {
    const std::int64_t region = cluster / Clusters::clusters_per_region;
    const std::size_t n_groups = groups_.groups.size();
    if (own.region != region) {
      own.bits.resize(n_groups);
      compare(nodes_.region(region, own.room.get()), own_.all_groups.data(), n_groups, own.bits.data());
      own.region = region;
    }
    const Boxes &leaves = nodes_.cluster(cluster, own.room.get());
    if (!(leaves.lower[0][0] <= leaves.upper[0][0])) return;  // a cluster beyond the end of a grid
    ++own.n_queries;
    own.near_groups.clear();
    const std::size_t n = add_marked(own_.all_groups.data(), own.bits.data(), n_groups,
                                     cluster % Clusters::clusters_per_region, own.near_groups);
    own.leaf_bits.resize(n);
    const UpperBounds bounds = compare(leaves, own.near_groups.data(), n, own.leaf_bits.data());
    if (limit_ < large) {
      own.bits_within.resize(n);
      kernels_.near_boxes(task_, leaves, own.near_groups.data(), static_cast<std::int32_t>(n), own.bits_within.data());
      for (std::size_t k = 0; k < n; ++k)
        own.leaf_bits[k] = static_cast<std::uint16_t>(own.leaf_bits[k] & own.bits_within[k]);
    }
    search_cluster({cluster, 0, n, thread, near_leaves(own.leaf_bits.data(), n)}, own, thread, &bounds,
                   every_leaf_ahead(cluster + 1));
  }

  // Queries the nodes of a leaf one by one.
  void query_nodes(const Open &cluster, int leaf, ClusterScratch::Thread &own, int thread) {
    const std::uint32_t lanes = cluster.lanes(leaf);
    cluster.fill_points(leaf, lanes);
    const double *const xyz = cluster.points(leaf).xyz;
    const auto numbers = cluster.numbers(leaf);
    for (std::uint32_t rest = lanes; rest; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      const std::int64_t node = found_.numbers.begin + numbers[lane];
      const Vec3 p{xyz[3 * lane], xyz[3 * lane + 1], xyz[3 * lane + 2]};
      if (request_.is_masked_out(node) || !scene_.may_be_within(p, request_.distance_limit)) continue;
      ++own.n_queries;
      const ClosestTriangle closest =
          scene_.closest(p, request_.distance_limit, request_.instructions, found_.ties_of(thread));
      if (closest.triangle >= 0) found_.add(thread, node, closest);
    }
  }

  void search_cluster(const ClusterScratch::Item &item, ClusterScratch::Thread &own, int thread,
                      const UpperBounds *bounds, const LeavesAhead &ahead) {
    const ClusterScratch::Thread &from = view(own_.threads)[item.thread];
    const std::int32_t *candidates = from.near_groups.data() + item.first;
    const std::uint16_t *leaf_bits = from.leaf_bits.data() + item.first;
    std::uint32_t near = item.near_leaves;
    const Open cluster(nodes_, item.cluster, near, own.room.get());
    if (bounds)
      for (std::uint32_t rest = near; rest; rest &= rest - 1) {
        const int bit = __builtin_ctz(rest);
        const bool has_many = item.n > most_groups && n_marked(leaf_bits, item.n, bit) > most_groups;
        if (is_separated(bounds->of_box[bit]) && !has_many) continue;
        query_nodes(cluster, bit, own, thread);
        near &= ~(1u << bit);
      }
    Pairs pairs{cluster, found_.ties_of(thread), ahead};
    ClusterTask &task = own.task;
    // The bounds of this many pairs of a leaf and a group take 8 kB, and thus stay in the processor's first cache.
    constexpr std::size_t many = 64;
    std::int32_t *const leaf_groups = own.room_for_groups(many + item.n);
    while (near) {
      task.n_leaves = 0;
      std::size_t n_listed = 0;
      for (; near && n_listed < many; near &= near - 1) {
        const int bit = __builtin_ctz(near);
        std::int32_t *const near_groups = leaf_groups + n_listed;
        const std::int32_t n_groups =
            kernels_.select(candidates, leaf_bits, static_cast<std::int32_t>(item.n), bit, near_groups);
        LeafTask &leaf = task.leaf[task.n_leaves++];
        leaf = leaf_task(cluster, bit, near_groups, n_groups);
        if (bounds) limits_within(std::min(bounds->of_box[bit], limit_), leaf.limits);
        n_listed += static_cast<std::size_t>(n_groups);
      }
      task.lower_bounds = own.room_for_bounds(n_listed);
      filter(own, pairs);
    }
    decide(own, pairs);
    while (pairs.ahead.near) pairs.ahead.request_one();
    // Every node with pairs is written, because this needs no branch. The loop moves to the next position only after a node
    // within the limit.
    UnfilledVector<FoundNode> &found = view(found_.by_thread)[thread];
    const std::size_t n_before = found.size();
    std::size_t n_paired = 0;
    for (const std::uint32_t nodes : pairs.nodes) n_paired += static_cast<std::size_t>(__builtin_popcount(nodes));
    found.resize(n_before + n_paired);
    FoundNode *next = found.data() + n_before;
    for (int i = 0; i < leaves_per_cluster; ++i) {
      const auto numbers = cluster.numbers(i);
      const ClosestTriangle *const of_nodes = own.closest.data() + nodes_per_leaf * i;
      for (std::uint32_t rest = pairs.nodes[i]; rest; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        const double distance = std::sqrt(of_nodes[lane].distance_sq);
        *next = FoundNode(numbers[lane], distance, of_nodes[lane].triangle);
        next += distance <= request_.distance_limit;
      }
    }
    found.resize(static_cast<std::size_t>(next - found.data()));
    if (pairs.ties) settle_ties(own, pairs);
  }

  // For the nodes within the limit, decides which candidates of the cluster are ties.
  __attribute__((noinline)) void settle_ties(const ClusterScratch::Thread &own, const Pairs &pairs) const {
    const auto closest_to = [&](std::int64_t node) -> auto & {
      const ClosestTriangle &closest = view(own.closest)[node];
      return std::sqrt(closest.distance_sq) <= request_.distance_limit ? closest : nothing;
    };
    pairs.ties->settle(closest_to, [&](std::int64_t node) -> std::int64_t {
      const auto at = static_cast<int>(node);
      return found_.numbers.begin + pairs.cluster.numbers(at / nodes_per_leaf)[at % nodes_per_leaf];
    });
  }

  // Returns false if the filter's error is so large that the filter would dismiss few triangles.
  bool is_separated(double limit) const {
    constexpr double useful = 0x1p-8;
    FilterLimits limits;
    return limits_within(std::min(limit, limit_), limits) <= useful;
  }

  LeafTask leaf_task(const Open &cluster, int position, const std::int32_t *near_groups, std::int32_t n_groups) const {
    std::uint32_t wanted = cluster.lanes(position);
    const auto numbers = cluster.numbers(position);
    if (request_.node_mask)
      for (std::uint32_t rest = wanted; rest; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        if (!request_.node_mask[found_.numbers.begin + numbers[lane]]) wanted &= ~(1u << lane);
      }
    return {&cluster.leaf(position), position, wanted, near_groups, n_groups, task_.limits, true, 0};
  }

  // Filters the leaves of own.task, and makes room in `closest` for their nodes.
  void filter(ClusterScratch::Thread &own, Pairs &pairs) {
    ClusterTask &task = own.task;
    kernels_.begin_cluster(task_, task);
    task.ahead.n = 0;
    static_assert(leaves_per_cluster * (sizeof(LeafPoints) + sizeof(Leaf::node)) <= 64 * std::size(LinesAhead{}.line));
    const auto request = [&](const void *from, std::size_t size) {
      for_each_line(from, size, [&](const char *line) { task.ahead.line[task.ahead.n++] = line; });
    };
    // Many leaves near the surface turn out to have no pairs. Points and node numbers are therefore prefetched only now.
    for (std::int32_t i = 0; i < task.n_leaves; ++i) {
      const LeafTask &leaf = task.leaf[i];
      if (!leaf.may_be_near) continue;
      if (is_stored) {
        request(&pairs.cluster.points(leaf.position), sizeof(LeafPoints));
        request(leaf.leaf->node, sizeof(Leaf::node));
      }
      std::fill_n(own.closest.begin() + leaf.position * nodes_per_leaf, nodes_per_leaf, nothing);
    }
    while (!task.is_done) {
      constexpr std::int32_t room = ClusterScratch::room_for_pairs, enough = 1024;
      if (room - pairs.n < enough) decide(own, pairs);
      pairs.n += kernels_.filter_cluster(
          task_, task, {own.pair_nodes.data() + pairs.n, own.pair_triangles.data() + pairs.n}, room - pairs.n);
      for (std::int32_t i = 0; i < task.n_leaves; ++i)
        pairs.cluster.fill_points(task.leaf[i].position, task.leaf[i].found);
    }
    for (std::int32_t i = 0; i < task.n_leaves; ++i) pairs.nodes[task.leaf[i].position] = task.leaf[i].found;
  }

  void decide(ClusterScratch::Thread &own, Pairs &pairs) {
    constexpr std::int32_t at_once = 16;  // the number of pairs that are decided between two prefetches
    for (std::int32_t i = 0; i < pairs.n; i += at_once) {
      pairs.ahead.request_one();
      kernels_.decide(std::min(at_once, pairs.n - i), own.pair_nodes.data() + i, own.pair_triangles.data() + i,
                      pairs.cluster.points(0).xyz, groups_.corners.data(), own.pair_decided.data() + i);
    }
    if (pairs.ties) {
      take_closest_and_ties(own, pairs);
    } else {
      take_closest(pairs.n, own.pair_nodes.data(), own.pair_triangles.data(), own.pair_decided.data(),
                   own.closest.data());
    }
    pairs.n = 0;
  }

  // For each pair, compares the triangle with the closest triangle that the node has so far.
  static void take_closest(std::int32_t n, const std::int32_t *node, const std::int32_t *triangle,
                           const double *decided, ClosestTriangle *closest) {
    for (std::int32_t i = 0; i < n; ++i) {
      ClosestTriangle &best = closest[node[i]];
      best = closer_of({decided[i], triangle[i]}, best);
    }
  }

  // This function is not inlined, because its code would take registers from a search without ties.
  __attribute__((noinline)) void take_closest_and_ties(ClusterScratch::Thread &own, const Pairs &pairs) const {
    for (std::int64_t i = 0; i < pairs.n; ++i) {
      const std::int32_t node = view(own.pair_nodes)[i];
      ClosestTriangle &best = view(own.closest)[node];
      const ClosestTriangle before = best, decided{view(own.pair_decided)[i], view(own.pair_triangles)[i]};
      const bool is_nearer = is_closer(decided.distance_sq, decided.triangle, before);
      if (is_nearer) best = decided;
      pairs.ties->compare(node, best, is_nearer ? before : decided);
    }
  }

  static constexpr ClosestTriangle nothing{std::numeric_limits<double>::infinity(), -1};

  const NodeSearch &request_;
  const TriangleScene &scene_;
  const TriangleGroups &groups_;
  const Nodes &nodes_;
  const Placing placing_;
  const double limit_;  // in the surface's frame; `large` if the limit is too large for single precision
  const Kernels &kernels_;
  FoundNodes &found_;
  ClusterScratch &own_;
  FilterTask task_, of_packs_;
  int n_threads_ = 1;
};

}  // namespace

void ClusterScratch::prepare(int n_threads, bool needs_room) {
  if (view(threads).size() < n_threads) resize(threads, n_threads);
  const auto make_room_for = [this](auto member) {
    make_room(
        threads, [member](Thread & thread) -> auto & { return thread.*member; });
  };
  make_room_for(&Thread::candidates);
  make_room_for(&Thread::bits);
  make_room_for(&Thread::items);
  make_room_for(&Thread::near_groups);
  make_room_for(&Thread::leaf_bits);
  make_room_for(&Thread::leaf_groups);
  make_room_for(&Thread::lower_bounds);
  for (Thread &thread : threads) {
    if (needs_room && !thread.room) thread.room.reset(new GridClusters::Room);
    thread.items.clear();
    thread.near_groups.clear();
    thread.leaf_bits.clear();
    // The arrays get more room than they need, because the kernels write whole registers.
    constexpr std::int64_t room = room_for_pairs + 16;
    resize(thread.pair_nodes, room);
    resize(thread.pair_triangles, room);
    resize(thread.pair_decided, room);
    resize(thread.closest, nodes_per_cluster);
    thread.n_queries = 0;
    thread.region = -1;
  }
}

bool separates_in_single_precision(const NodeSearch &request, const NodeFrame &nodes) {
  const Placing placing(nodes, request.surface.scene().groups().frame);
  return placing.ratio >= 0x1p-100 && placing.ratio <= large && placing.largest_shift <= large;
}

bool are_enough_for_clusters(std::int64_t n_nodes, const Surface &surface) {
  constexpr std::int64_t fewest = 64, groups_per_node = 8;
  return n_nodes >= std::max(fewest, view(surface.scene().groups().groups).size() / groups_per_node);
}

bool has_few_near(const NodeSearch &request) {
  const Bounds &bounds = request.surface.scene().bounds();
  const Vec3 extent = bounds.upper - bounds.lower;
  return request.distance_limit <= 0.2 * std::max({extent.x, extent.y, extent.z});
}

namespace {

template <class Nodes>
SearchReport search_nodes(const NodeSearch &request, const Nodes &nodes, const Kernels &kernels,
                          ClusterScratch &scratch, FoundNodes &found) {
  ClusterSearch<Nodes> search(request, nodes, kernels, scratch, found);
  if (has_few_near(request)) {
    search.find_near_clusters();
    search.search_near_clusters();
  } else {
    search.search_every_cluster();
  }
  return search.report();
}

}  // namespace

SearchReport search_clusters(const NodeSearch &request, const Clusters &clusters, const Kernels &kernels,
                             ClusterScratch &scratch, FoundNodes &found) {
  return search_nodes(request, StoredClusters(clusters), kernels, scratch, found);
}

SearchReport search_clusters(const NodeSearch &request, const GridClusters &clusters, const Kernels &kernels,
                             ClusterScratch &scratch, FoundNodes &found) {
  return search_nodes(request, clusters, kernels, scratch, found);
}

}  // namespace riis
