// SPDX-License-Identifier: Apache-2.0
#include "marking/closest_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <vector>

#include "base/unfilled.hpp"
#include "common/array_view.hpp"
#include "geometry/point_triangle.hpp"
#include "marking/cluster_search.hpp"
#include "marking/eight_points.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// So many points are sorted together. They take about 8 MB.
constexpr std::int64_t points_per_batch = 1 << 16;

constexpr std::int64_t points_per_block = 2048;

// Those points of a batch that may be within the limit.
struct Batch {
  UnfilledVector<double> xyz;
  UnfilledVector<std::int64_t> ids;
  std::int64_t n = 0;
  bool has_far = false;  // whether the batch also has points that are too far for single precision
  Bounds bounds;
};

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
        to_(to) {}

  void write() {
    if (!are_enough_for_clusters(wanted_.n, surface_)) {
      write_one_by_one({0, wanted_.n}, [](Vec3) { return true; });
      return;
    }
    for (std::int64_t begin = 0; begin < wanted_.n; begin += points_per_batch) {
      const Range range{begin, std::min(begin + points_per_batch, wanted_.n)};
      try {
        if (search(range)) continue;
      } catch (const std::bad_alloc &) {
        if (begin == 0) throw;
      }
      write_one_by_one(range, [](Vec3) { return true; });
    }
  }

 private:
  // Returns whether single precision does not separate the triangles near p. One such point would make the batch's frame useless
  // for all other points.
  bool is_far(Vec3 p) const {
    constexpr double far = 0x1p10;  // about as many half extents of the surface
    const Vec3 q = scene_.groups().frame(p);
    return !(std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}) <= far);
  }

  // Queries and writes those points of a range for which is_asked(point) is true. This needs no memory.
  template <class IsAsked>
  void write_one_by_one(const Range &all, const IsAsked &is_asked) const {
    constexpr std::int64_t few = 512;  // a query takes longer than a point of a batch
    parallel_for_ranges(all.end - all.begin, few, request_.n_threads, [&](const Range &range, int) {
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

  // Searches the points of a range over clusters, and writes them. Returns false before it writes anything if clusters cannot be
  // used. Also writes nothing if memory runs out.
  bool search(const Range &range) {
    gather(range);
    if (batch_.n > 0) {
      const double *const xyz = batch_.xyz.data();
      sort_into_clusters({batch_.n, xyz, xyz + 1, xyz + 2, 3}, batch_.bounds, request_.n_threads, clusters_);
      const NodeSearch search{surface_, request_.limit, nullptr, request_.n_threads, best_instruction_set()};
      if (!separates_in_single_precision(search, clusters_)) return false;
      search_clusters(search, clusters_, kernels(search.instructions), scratch_, found_);
    } else {
      found_.prepare(request_.n_threads);
    }
    if (is_limited_)
      parallel_for_ranges(range.end - range.begin, points_per_block, request_.n_threads, [&](const Range &block, int) {
        for (std::int64_t k = range.begin + block.begin; k < range.begin + block.end; ++k)
          if (const std::int64_t i = wanted_.id(k); wanted_.is_wanted(i)) write_far(i, request_.far_distance, to_);
      });
    for (const std::vector<FoundNode> &list : found_.by_thread)
      parallel_for_ranges(view(list).size(), points_per_block, request_.n_threads,
                          [&](const Range &block, int) { write_found(list, block); });
    if (batch_.has_far) write_one_by_one(range, [&](Vec3 p) { return is_far(p); });
    return true;
  }

  // Copies the wanted points of a range that may be within the limit, except far ones.
  void gather(const Range &all) {
    const std::int64_t n = all.end - all.begin;
    resize(batch_.xyz, 3 * n);
    resize(batch_.ids, n);
    struct Block {
      std::int64_t n;
      bool has_far;
      Bounds bounds;
    };
    std::array<Block, points_per_batch / points_per_block> blocks;
    parallel_for_ranges(n, points_per_block, request_.n_threads, [&](const Range &range, int) {
      Block made{0, false, {}};
      for (std::int64_t k = range.begin; k < range.end; ++k) {
        const std::int64_t i = wanted_.id(all.begin + k);
        if (!wanted_.is_wanted(i)) continue;
        const Vec3 p = points_[i];
        if (is_limited_ && !scene_.may_be_within(p, request_.limit)) continue;
        if (is_far(p)) {
          made.has_far = true;
          continue;
        }
        put_vector(batch_.xyz.data(), range.begin + made.n, p);
        view(batch_.ids)[range.begin + made.n++] = i;
        made.bounds.add(p);
      }
      view(blocks)[range.begin / points_per_block] = made;
    });
    // Closes the gaps between the blocks.
    batch_.n = 0;
    batch_.has_far = false;
    batch_.bounds = {};
    for (std::int64_t begin = 0; begin < n; begin += points_per_block) {
      const Block &block = view(blocks)[begin / points_per_block];
      if (batch_.n < begin) {
        std::copy_n(batch_.xyz.data() + 3 * begin, 3 * block.n, batch_.xyz.data() + 3 * batch_.n);
        std::copy_n(batch_.ids.data() + begin, block.n, batch_.ids.data() + batch_.n);
      }
      batch_.n += block.n;
      batch_.has_far = batch_.has_far || block.has_far;
      batch_.bounds.add(block.bounds);
    }
  }

  void write_found(const std::vector<FoundNode> &list, const Range &range) const {
    const TriangleSet &set = surface_.triangles();
    const double *const corners = scene_.groups().corners.data();
    const Kernels &simd = kernels(best_instruction_set());
    const bool is_located = to_.point || to_.barycentric || to_.side;
    // With fewer triangles than points, making a normal for each triangle is cheaper than making one for each point.
    const bool has_normals = to_.side || (to_.normal && wanted_.n > set.n_triangles());
    const Pseudonormals *const normals = has_normals ? &surface_.pseudonormals() : nullptr;
    for (std::int64_t first = range.begin; first < range.end; first += pairs_at_once) {
      const std::int64_t n = std::min<std::int64_t>(pairs_at_once, range.end - first);
      EightPoints eight;
      std::int64_t id[pairs_at_once];
      for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) {
        const FoundNode &found = view(list)[first + std::min(lane, n - 1)];
        const auto at = static_cast<std::int64_t>(found.node);
        id[lane] = view(batch_.ids)[at];
        eight.set(lane, {batch_.xyz.data()[3 * at], batch_.xyz.data()[3 * at + 1], batch_.xyz.data()[3 * at + 2]},
                  found.triangle, corners);
      }
      if (is_located) simd.locate(eight.pairs, eight.on);
      const auto for_each_lane = [&](const auto *array, const auto &write) {
        for (std::int64_t lane = 0; array && lane < n; ++lane) write(id[lane], lane);
      };
      for_each_lane(to_.distance,
                    [&](std::int64_t i, std::int64_t lane) { to_.distance[i] = view(list)[first + lane].distance; });
      for_each_lane(to_.triangle_id, [&](std::int64_t i, std::int64_t lane) {
        to_.triangle_id[i] = view(set.triangle_id)[eight.triangle[lane]];
      });
      for_each_lane(to_.leaflet_id, [&](std::int64_t i, std::int64_t lane) {
        to_.leaflet_id[i] = view(set.leaflet_id)[eight.triangle[lane]];
      });
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
  const bool is_limited_;
  const riis_closest_arrays &to_;
  Batch batch_;
  Clusters clusters_;
  ClusterScratch scratch_;
  FoundNodes found_;
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
  // Makes the pseudonormals before anything is written. If memory runs out here or in the first batch, the arrays are unchanged.
  // If memory runs out later, the remaining points are queried one by one, which needs no memory.
  if (to.side || (to.normal && request.wanted.n > request.surface.triangles().n_triangles()))
    request.surface.pseudonormals();
  ClosestPoints<Real>(request, points, to).write();
}

template void find_closest_points(const ClosestPointsRequest &, const StridedReals<double> &,
                                  const riis_closest_arrays &);
template void find_closest_points(const ClosestPointsRequest &, const StridedReals<float> &,
                                  const riis_closest_arrays &);

}  // namespace riis
