// SPDX-License-Identifier: Apache-2.0
#include "search/closest_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <vector>

#include "common/array_view.hpp"
#include "geometry/point_triangle.hpp"
#include "mesh/clusters.hpp"
#include "mesh/node_order.hpp"
#include "parallel/parallel_for.hpp"
#include "search/cluster_search.hpp"
#include "search/eight_points.hpp"

namespace riis {
namespace {

// The number of points that are sorted together. A large batch takes 2 MB of memory. If consecutive points are near each other,
// small batches are better. Their leaves are as compact as those of large batches, and their points stay in the cache.
constexpr std::int64_t points_per_batch = 1 << 16, points_per_small_batch = 1 << 13;

constexpr std::int64_t points_per_block = 2048;

constexpr std::int64_t points_per_region = Clusters::clusters_per_region * nodes_per_cluster;

template <class Real>
class ClosestPoints {
 public:
  ClosestPoints(const ClosestPointsRequest &request, const StridedReals<Real> &points, const riis_closest_arrays &to)
      : request_(request),
        wanted_(request.wanted),
        surface_(request.surface),
        scene_(surface_.scene()),
        points_(points),
        is_limited_(std::isfinite(request.limit)),
        may_be_far_(is_any_beyond(far)),
        is_spread_(is_any_beyond(wide)),
        to_(to) {}

  void write() {
    // If memory runs out later, the points are queried one by one with Embree's tree. The tree is therefore built before anything
    // is written.
    scene_.build_tree();
    const int n_threads = request_.n_threads;
    if (!are_enough_for_clusters(wanted_.n, surface_)) {
      write_one_by_one({0, wanted_.n}, n_threads, [](Vec3) { return true; });
    } else if (wanted_.n >= n_threads * points_per_small_batch && follow_each_other()) {
      // Each thread works on its own batches. The number of batches is a multiple of the number of threads.
      const std::int64_t of_all = n_threads * points_per_small_batch;
      const std::int64_t n_batches = (wanted_.n + of_all - 1) / of_all * n_threads;
      std::vector<Batch> batches;
      resize(batches, n_threads);
      parallel_for_ranges(wanted_.n, (wanted_.n + n_batches - 1) / n_batches, n_threads,
                          [&](const Range &range, int thread) { write_batch(range, 1, view(batches)[thread]); });
    } else {
      Batch batch;
      for (std::int64_t begin = 0; begin < wanted_.n; begin += points_per_batch)
        write_batch({begin, std::min(begin + points_per_batch, wanted_.n)}, n_threads, batch);
    }
  }

 private:
  // `far` and `wide` are distances from the middle of the surface, as multiples of its half extent. For a point beyond `far`,
  // single precision cannot distinguish the triangles. Even one such point would make the frame of its batch useless for the
  // other points. If no point is beyond `wide`, all batches use the same frame.
  static constexpr double far = 0x1p10, wide = 0x1p4;

  double reach_of(Vec3 p) const { return largest_coordinate(scene_.groups().frame(p)); }
  bool is_any_beyond(double reach) const {
    return !(std::max(reach_of(wanted_.bounds.lower), reach_of(wanted_.bounds.upper)) <= reach);
  }
  bool is_far(Vec3 p) const { return may_be_far_ && !(reach_of(p) <= far); }

  // Returns whether consecutive points are near each other. This is decided by one small batch: its extent along some axis must
  // be at most half the extent of all points. The batch is taken from the middle of the list, because many meshes begin with the
  // nodes of their boundary. The function needs enough points for a small batch.
  bool follow_each_other() const {
    const std::int64_t begin = (wanted_.n - points_per_small_batch) / 2;
    Bounds bounds;
    for (std::int64_t k = begin; k < begin + points_per_small_batch; ++k) bounds.add(points_[wanted_.id(k)]);
    const Vec3 all = wanted_.bounds.half_extent(), own = bounds.half_extent();
    const auto is_short = [](double of_batch, double of_all) { return of_all > 0 && of_batch <= 0.5 * of_all; };
    return is_short(own.x, all.x) || is_short(own.y, all.y) || is_short(own.z, all.z);
  }

  struct alignas(64) OfThread {
    Clusters clusters;
    ClusterScratch scratch;
    FoundNodes found;
  };

  // The points of a batch that are searched over clusters, and their frame. The first point of the batch has the number 0.
  struct Batch {
    NodeItems<std::uint32_t> items, buffer;
    NodeFrame frame;
    std::vector<OfThread> threads;
  };

  // Queries and writes those points of a range for which is_asked(point) is true. The function allocates no memory.
  template <class IsAsked>
  void write_one_by_one(const Range &all, int n_threads, const IsAsked &is_asked) const {
    constexpr std::int64_t few = 512;  // a query takes longer than a point of a batch
    parallel_for_ranges(all.end - all.begin, few, n_threads, [&](const Range &range, int) {
      for (std::int64_t k = all.begin + range.begin; k < all.begin + range.end; ++k) {
        const std::int64_t i = wanted_.id(k);
        if (!wanted_.is_wanted(i)) continue;
        const Vec3 p = points_[i];
        if (!is_asked(p)) continue;
        const ClosestTriangle closest = scene_.closest(p, request_.limit);
        if (closest.triangle >= 0)
          write_closest(surface_, i, p, closest, to_);
        else
          write_far(i, request_.far_distance, to_);
      }
    });
  }

  // Writes the points of a range. If memory runs out, all points are queried one by one.
  void write_batch(const Range &range, int n_threads, Batch &batch) const {
    try {
      if (search(range, n_threads, batch)) return;
    } catch (const std::bad_alloc &) {
    }
    write_one_by_one(range, n_threads, [](Vec3) { return true; });
  }

  // Searches the points of a range over clusters, and writes them. If clusters cannot be used, returns false and writes nothing.
  // If memory runs out, some points may already be written.
  bool search(const Range &range, int n_threads, Batch &batch) const {
    Bounds bounds = wanted_.bounds;
    if (is_spread_) {
      bounds = {};
      for (const Block &block : visit_blocks(range, n_threads, [](std::int64_t, Vec3, std::int64_t) {}))
        bounds.add(block.bounds);
    }
    batch.frame = frame_around(bounds);
    const bool has_far = gather(range, n_threads, batch);
    if (!batch.items.empty() && !separates_in_single_precision(node_search(), batch.frame)) return false;
    NodeSorter<std::uint32_t>(batch.items, batch.buffer, Cuts::by_leaves, n_threads).sort();
    resize(batch.threads, n_threads);
    if (is_limited_)
      parallel_for_ranges(range.end - range.begin, points_per_block, n_threads, [&](const Range &block, int) {
        for (std::int64_t k = range.begin + block.begin; k < range.begin + block.end; ++k)
          if (const std::int64_t i = wanted_.id(k); wanted_.is_wanted(i)) write_far(i, request_.far_distance, to_);
      });
    // A thread fills, searches and writes the points of a region before it takes the next region, so that the points stay in its
    // cache.
    const std::int64_t n = view(batch.items).size();
    const std::int64_t share = n_threads == 1 ? n : n / (4 * n_threads);
    const std::int64_t per_part =
        std::clamp<std::int64_t>(share / nodes_per_cluster * nodes_per_cluster, nodes_per_cluster, points_per_region);
    parallel_for_ranges(n, per_part, n_threads,
                        [&](const Range &part, int thread) { search_part(range, part, batch, thread); });
    if (has_far) write_one_by_one(range, n_threads, [&](Vec3 p) { return is_far(p); });
    return true;
  }

  // Fills clusters with a part of the batch's items, searches the clusters, and writes the points.
  void search_part(const Range &range, const Range &part, Batch &batch, int thread) const {
    const auto id_of = [&](std::int64_t at) { return wanted_.id(range.begin + at); };
    const auto item_at = [&](std::int64_t at) -> const auto & { return view(batch.items)[part.begin + at]; };
    OfThread &own = view(batch.threads)[thread];
    own.clusters.frame = batch.frame;
    fill_clusters(
        part.end - part.begin, 1,
        [&](std::int64_t at) {
          const std::uint32_t number = item_at(at).node;
          return OrderedNode{number, points_[id_of(number)]};
        },
        [&](std::int64_t at) { points_.prefetch(id_of(item_at(at).node)); }, own.clusters);
    const NodeSearch search = node_search();
    search_clusters(search, own.clusters, kernels(search.instructions), own.scratch, own.found);
    write_found(view(own.found.by_thread)[0], id_of);
  }

  // A search of one thread.
  NodeSearch node_search() const { return {surface_, request_.limit, nullptr, 1, best_instruction_set()}; }

  // The points of a block that are searched over clusters.
  struct Block {
    std::int64_t n;
    bool has_far;  // whether the block also has points that are too far for single precision
    Bounds bounds;
  };

  // Calls visit(k, point, place) for the wanted points of a range. Leaves out far points, and points that are certainly beyond
  // the limit. The first point of the range has k = 0. Within a block, the visited points get consecutive places, which begin
  // with the block's first k.
  template <class Visit>
  std::array<Block, points_per_batch / points_per_block> visit_blocks(const Range &all, int n_threads,
                                                                      const Visit &visit) const {
    std::array<Block, points_per_batch / points_per_block> blocks;
    blocks.fill({0, false, {}});
    parallel_for_ranges(all.end - all.begin, points_per_block, n_threads, [&](const Range &range, int) {
      // Local copies stay in registers, even if `visit` writes to memory.
      const WantedPoints wanted = wanted_;
      const StridedReals<Real> points = points_;
      const bool is_checked = is_limited_ || is_spread_;
      Block made{0, false, {}};
      for (std::int64_t k = range.begin; k < range.end; ++k) {
        const std::int64_t i = wanted.id(all.begin + k);
        if (!wanted.is_wanted(i)) continue;
        const Vec3 p = points[i];
        if (is_checked) {
          if (is_limited_ && !scene_.may_be_within(p, request_.limit)) continue;
          if (is_far(p)) {
            made.has_far = true;
            continue;
          }
          made.bounds.add(p);
        }
        visit(k, p, range.begin + made.n++);
      }
      view(blocks)[range.begin / points_per_block] = made;
    });
    return blocks;
  }

  // Makes items from those points of a range that are searched over clusters. Returns whether there are also far points.
  bool gather(const Range &all, int n_threads, Batch &batch) const {
    const std::int64_t n = all.end - all.begin;
    resize(batch.items, n);
    NodeItem<std::uint32_t> *const items = batch.items.data();
    const auto blocks =
        visit_blocks(all, n_threads, [items, frame = batch.frame](std::int64_t k, Vec3 p, std::int64_t place) {
          frame.place_inner(p, items[place].x);
          items[place].node = static_cast<std::uint32_t>(k);
        });
    // Closes the gaps between the points of the blocks.
    std::int64_t n_items = 0;
    bool has_far = false;
    for (std::int64_t begin = 0; begin < n; begin += points_per_block) {
      const Block &block = view(blocks)[begin / points_per_block];
      if (n_items < begin) std::copy_n(items + begin, block.n, items + n_items);
      n_items += block.n;
      has_far = has_far || block.has_far;
    }
    resize(batch.items, n_items);
    return has_far;
  }

  // Writes the points that were found. A found node is the point with the id id_of(node).
  template <class IdOf>
  void write_found(const UnfilledVector<FoundNode> &list, const IdOf &id_of) const {
    const TriangleSet &set = surface_.triangles();
    for (const FoundNode &found : list) {
      const std::int64_t i = id_of(static_cast<std::int64_t>(found.node));
      if (to_.distance) to_.distance[i] = found.distance;
      if (to_.triangle_id) to_.triangle_id[i] = view(set.triangle_id)[found.triangle];
      if (to_.leaflet_id) to_.leaflet_id[i] = view(set.leaflet_id)[found.triangle];
    }
    if (!to_.normal && !to_.point && !to_.barycentric && !to_.side) return;
    const double *const corners = scene_.groups().corners.data();
    const Kernels &simd = kernels(best_instruction_set());
    const bool is_located = to_.point || to_.barycentric || to_.side;
    // If there are fewer triangles than points, the normals of all triangles take less time than a normal for each point.
    const bool has_normals = to_.side || (to_.normal && wanted_.n > set.n_triangles());
    const Pseudonormals *const normals = has_normals ? &surface_.pseudonormals() : nullptr;
    for (std::int64_t first = 0; first < view(list).size(); first += pairs_at_once) {
      const std::int64_t n = std::min<std::int64_t>(pairs_at_once, view(list).size() - first);
      EightPoints eight;
      std::int64_t id[pairs_at_once];
      for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) {
        const FoundNode &found = view(list)[first + std::min(lane, n - 1)];
        id[lane] = id_of(static_cast<std::int64_t>(found.node));
        eight.set(lane, points_[id[lane]], found.triangle, corners);
      }
      if (is_located) simd.locate(eight.pairs, eight.on);
      const auto for_each_lane = [&](const auto *array, const auto &write) {
        for (std::int64_t lane = 0; array && lane < n; ++lane) write(id[lane], lane);
      };
      for_each_lane(to_.point, [&](std::int64_t i, std::int64_t lane) {
        EightPoints::put_lane(eight.on.point, lane, to_.point + 3 * i);
      });
      for_each_lane(to_.barycentric, [&](std::int64_t i, std::int64_t lane) {
        EightPoints::put_lane(eight.on.barycentric, lane, to_.barycentric + 3 * i);
      });
      for_each_lane(to_.normal, [&](std::int64_t i, std::int64_t lane) {
        const std::int64_t triangle = eight.triangle[lane];
        put_vector(to_.normal, i, normals ? normals->of_face(triangle) : triangle_normal(set.corners(triangle)));
      });
      if (!to_.side) continue;
      std::int32_t side[pairs_at_once];
      eight.find_sides(*normals, simd, side, nullptr);
      for_each_lane(to_.side, [&](std::int64_t i, std::int64_t lane) { to_.side[i] = side[lane]; });
    }
  }

  const ClosestPointsRequest &request_;
  const WantedPoints &wanted_;
  const Surface &surface_;
  const TriangleScene &scene_;
  const StridedReals<Real> &points_;
  const bool is_limited_, may_be_far_, is_spread_;
  const riis_closest_arrays &to_;
};

}  // namespace

void write_closest(const Surface &surface, std::int64_t i, Vec3 p, const ClosestTriangle &closest,
                   const riis_closest_arrays &to) {
  const TriangleSet &set = surface.triangles();
  if (to.distance) to.distance[i] = std::sqrt(closest.distance_sq);
  if (to.triangle_id) to.triangle_id[i] = view(set.triangle_id)[closest.triangle];
  if (to.leaflet_id) to.leaflet_id[i] = view(set.leaflet_id)[closest.triangle];
  const std::array<Vec3, 3> corners = set.corners(closest.triangle);
  if (to.normal) put_vector(to.normal, i, triangle_normal(corners));
  if (to.point || to.barycentric || to.side) {
    const PointOnTriangle on = closest_point_on_triangle(p, corners[0], corners[1], corners[2]);
    if (to.point) put_vector(to.point, i, on.point);
    if (to.barycentric) put_vector(to.barycentric, i, {on.barycentric[0], on.barycentric[1], on.barycentric[2]});
    if (to.side)
      to.side[i] = side_of(p - on.point, surface.pseudonormals().at(closest.triangle, on.barycentric).normal);
  }
}

void write_far(std::int64_t i, double far_distance, const riis_closest_arrays &to) {
  if (to.distance) to.distance[i] = far_distance;
  if (to.triangle_id) to.triangle_id[i] = -1;
  if (to.leaflet_id) to.leaflet_id[i] = -1;
  if (to.side) to.side[i] = 0;
  for (double *vectors : {to.normal, to.point, to.barycentric})
    if (vectors) put_vector(vectors, i, {0, 0, 0});
}

template <class Real>
void find_closest_points(const ClosestPointsRequest &request, const StridedReals<Real> &points,
                         const riis_closest_arrays &to) {
  if (request.wanted.n == 0) return;
  // Makes the pseudonormals before anything is written, so that the arrays stay unchanged if memory runs out here.
  if (to.side || (to.normal && request.wanted.n > request.surface.triangles().n_triangles()))
    request.surface.pseudonormals();
  ClosestPoints<Real>(request, points, to).write();
}

template void find_closest_points(const ClosestPointsRequest &, const StridedReals<double> &,
                                  const riis_closest_arrays &);
template void find_closest_points(const ClosestPointsRequest &, const StridedReals<float> &,
                                  const riis_closest_arrays &);

}  // namespace riis
