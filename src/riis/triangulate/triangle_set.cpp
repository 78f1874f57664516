// SPDX-License-Identifier: Apache-2.0
#include "triangulate/triangle_set.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/kernels.hpp"

namespace riis {
namespace {

struct Centroid {
  float at[3];
  std::int32_t triangle;
};

// Splits the triangles again and again until each part is a group, each time across the longest side of the box around their
// centroids. In every part except the last, the number of triangles is a multiple of the group size.
template <class Visit>
void for_each_group(Centroid *centroids, std::int64_t n, const Visit &visit) {
  if (n <= triangles_per_group) {
    visit(centroids, static_cast<int>(n));
    return;
  }
  float lower[3], upper[3];
  for (int i = 0; i < 3; ++i) lower[i] = upper[i] = centroids[0].at[i];
  for (std::int64_t k = 1; k < n; ++k)
    for (int i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], centroids[k].at[i]);
      upper[i] = std::max(upper[i], centroids[k].at[i]);
    }
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (upper[i] - lower[i] > upper[axis] - lower[axis]) axis = i;
  const std::int64_t n_groups = (n + triangles_per_group - 1) / triangles_per_group;
  const std::int64_t n_left = (n_groups + 1) / 2 * triangles_per_group;
  std::nth_element(centroids, centroids + n_left, centroids + n, [axis](const Centroid &a, const Centroid &b) {
    return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.triangle < b.triangle;
  });
  for_each_group(centroids, n_left, visit);
  for_each_group(centroids + n_left, n - n_left, visit);
}

}  // namespace

TriangleSet without_skirt(const TriangleSet &set) {
  TriangleSet made = set;
  while (set.skirt >= 0 && !made.leaflet_id.empty() && made.leaflet_id.back() == set.skirt) {
    made.leaflet_id.pop_back();
    made.patch_id.pop_back();
    made.triangle_id.pop_back();
    made.vertex_id.resize(made.vertex_id.size() - 3);
  }
  made.skirt = -1;
  return made;
}

void group_by_place(const TriangleSet &set, std::int32_t begin, std::int32_t end, Grouping &grouping) {
  Vector<Centroid> centroids;
  centroids.reserve(static_cast<std::size_t>(end - begin));
  const Vec3 origin = set.corners(begin)[0];
  double largest = 0;
  for (std::int32_t i = begin; i < end; ++i)
    for (const Vec3 p : set.corners(i)) {
      const Vec3 q = p - origin;
      largest = std::max({largest, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    }
  // The scale keeps coordinates between -3 and 3 for any unit of length.
  const double scale = largest > 0 ? 1 / largest : 0;
  for (std::int32_t i = begin; i < end; ++i) {
    Vec3 sum{0, 0, 0};
    for (const Vec3 p : set.corners(i)) sum = sum + scale * (p - origin);
    centroids.push_back({{static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z)}, i});
  }
  for_each_group(centroids.data(), view(centroids).size(), [&](Centroid *members, int n) {
    std::sort(members, members + n, [](const Centroid &a, const Centroid &b) { return a.triangle < b.triangle; });
    for (int i = 0; i < n; ++i) grouping.order.push_back(members[i].triangle);
    grouping.end.push_back(static_cast<std::int32_t>(grouping.order.size()));
  });
}

void group_all_by_place(const TriangleSet &set, Grouping &grouping) {
  grouping.order.clear();
  grouping.end.clear();
  group_by_place(set, 0, static_cast<std::int32_t>(set.n_triangles()), grouping);
}

}  // namespace riis
