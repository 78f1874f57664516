// SPDX-License-Identifier: Apache-2.0
#include "search/band_nodes.hpp"

#include <algorithm>
#include <limits>

#include "common/array_view.hpp"
#include "kernels/kernels.hpp"
#include "parallel/parallel_for.hpp"
#include "search/eight_points.hpp"

namespace riis {
namespace {

// Removes nodes from one thread's list.
void keep_in_band(const SearchRequest &request, const Band &band, UnfilledVector<FoundNode> &list) {
  const Pseudonormals &normals = request.surface.pseudonormals();
  const Kernels &simd = kernels(request.instructions);
  const StridedPoints &nodes = request.mesh.nodes();
  const double *const corners = request.surface.scene().groups().corners.data();
  constexpr std::int64_t ahead = 4 * pairs_at_once;
  const auto found = view(list);
  const auto node_of = [&](std::int64_t i) { return static_cast<std::int64_t>(found[i].node); };
  std::int64_t n_kept = 0;
  for (std::int64_t first = 0; first < found.size(); first += pairs_at_once) {
    const std::int64_t n = std::min<std::int64_t>(pairs_at_once, found.size() - first);
    EightPoints eight;
    alignas(64) double distance[pairs_at_once], height[pairs_at_once];
    std::int32_t is_on_rim[pairs_at_once];
    for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) {
      const std::int64_t i = first + std::min(lane, n - 1);
      nodes.prefetch(node_of(std::min(i + ahead, found.size() - 1)));
      eight.set(lane, nodes[node_of(i)], found[i].triangle, corners);
      distance[lane] = found[i].distance;
    }
    simd.locate(eight.pairs, eight.on);
    eight.find_heights(normals, simd, distance, height, is_on_rim);
    for (std::int64_t lane = 0; lane < n; ++lane) {
      found[n_kept] = found[first + lane];
      n_kept += band.holds(distance[lane], height[lane]);
    }
  }
  list.resize(static_cast<std::size_t>(n_kept));
}

}  // namespace

void keep_in_band(const SearchRequest &request, const Band &band, FoundNodes &found) {
  request.surface.pseudonormals();
  const auto n_lists = view(found.by_thread).size();
  constexpr std::int64_t few = 4096;
  const int n_threads = request.n_threads.for_part(found.size(), few);
  parallel_for(n_lists, n_threads, [&](std::int64_t i, int) { keep_in_band(request, band, view(found.by_thread)[i]); });
}

NodePlaces::NodePlaces(const SearchRequest &request)
    : request_(request), normals_(request.surface.band().steps_aside() ? &request.surface.pseudonormals() : nullptr) {}

NodePlace NodePlaces::of(Vec3 p) const {
  return with_distances(request_.surface, request_.instructions, [&](const auto &distances) -> NodePlace {
    const ClosestTriangle closest = distances.closest(p, std::numeric_limits<double>::infinity());
    const double distance = std::sqrt(closest.distance_sq);
    if (!normals_) return {distance, 0, false};
    EightPoints eight;
    double distances_of_all[pairs_at_once], height[pairs_at_once];
    std::int32_t is_on_rim[pairs_at_once];
    for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) {
      eight.set(lane, p, closest.triangle, request_.surface.scene().groups().corners.data());
      distances_of_all[lane] = distance;
    }
    const Kernels &simd = kernels(request_.instructions);
    simd.locate(eight.pairs, eight.on);
    eight.find_heights(*normals_, simd, distances_of_all, height, is_on_rim);
    const int side = (height[0] > 0) - (height[0] < 0);
    return {request_.surface.band().marking_thickness(distance, height[0]), side, is_on_rim[0] != 0};
  });
}

}  // namespace riis
