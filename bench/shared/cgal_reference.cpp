// SPDX-License-Identifier: Apache-2.0
#include "cgal_reference.hpp"

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#if __has_include(<CGAL/AABB_traits_3.h>)  // in CGAL 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Iterator = std::vector<Triangle>::const_iterator;
#if __has_include(<CGAL/AABB_traits_3.h>)
using Traits = CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Iterator, CGAL::Tag_true>>;
#else
using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Iterator, CGAL::Tag_true>>;
#endif
using Tree = CGAL::AABB_tree<Traits>;

double distance_sq(const Point &p, const CGAL::Bbox_3 &box) {
  const double x = std::max({box.xmin() - p.x(), 0.0, p.x() - box.xmax()});
  const double y = std::max({box.ymin() - p.y(), 0.0, p.y() - box.ymax()});
  const double z = std::max({box.zmin() - p.z(), 0.0, p.z() - box.zmax()});
  return x * x + y * y + z * z;
}

// Tells CGAL's traversal which boxes to enter, and what to do with a triangle. Unlike CGAL's class for closest points, this class
// starts with a limit on the distance.
struct WithinLimit {
  double radius_sq;
  const Triangle *nearest = nullptr;

  bool go_further() const { return true; }
  bool do_intersect(const Point &p, const CGAL::AABB_node<Traits> &node) const {
    return distance_sq(p, node.bbox()) <= radius_sq;
  }
  void intersection(const Point &p, const Traits::Primitive &triangle) {
    const double sq = CGAL::squared_distance(p, triangle.datum());
    if (sq > radius_sq) return;
    radius_sq = sq;
    nearest = &*triangle.id();
  }
};

}  // namespace

struct CgalQuery::Implementation {
  std::vector<Triangle> triangles;
  Tree tree;
};

CgalQuery::CgalQuery(const Triangles &triangles) : implementation_(std::make_unique<Implementation>()) {
  for (std::int64_t i = 0; i < triangles.n(); ++i) {
    const double *c = triangles.corners.data() + 9 * i;
    implementation_->triangles.emplace_back(Point(c[0], c[1], c[2]), Point(c[3], c[4], c[5]), Point(c[6], c[7], c[8]));
  }
  implementation_->tree.insert(implementation_->triangles.cbegin(), implementation_->triangles.cend());
  implementation_->tree.build();
}
CgalQuery::~CgalQuery() = default;

void CgalQuery::distances(std::int64_t n_nodes, const double *xyz, double limit, int n_threads,
                          double *distance) const {
  const Tree &tree = implementation_->tree;
  const CGAL::Bbox_3 box = tree.bbox();
  const bool is_unlimited = std::isinf(limit);
  const Triangle *last = nullptr;  // the last node's triangle, if there is no limit
  // A thread takes a new chunk of nodes when its last chunk is done, because nodes near the valve take longer than other nodes.
#pragma omp parallel for num_threads(n_threads) firstprivate(last) schedule(dynamic, 4096)
  for (std::int64_t i = 0; i < n_nodes; ++i) {
    const Point p(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    WithinLimit within{limit * limit};
    if (is_unlimited && i % 4096) within = {CGAL::squared_distance(p, *last), last};
    if (distance_sq(p, box) <= within.radius_sq) tree.traversal(p, within);
    distance[i] = within.nearest ? std::sqrt(within.radius_sq) : std::numeric_limits<double>::infinity();
    last = within.nearest;
  }
}

}  // namespace bench
