// SPDX-License-Identifier: Apache-2.0
#include "references.hpp"

#if defined(RIIS_EMBREE_4)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>

#include "handles.hpp"

namespace bench {
namespace {

struct Point {
  double x, y, z;
};

Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Returns the squared distance from a point to a triangle. The formula depends on the region of the triangle's plane into which
// the point projects (Christer Ericson, Real-Time Collision Detection, 5.1.5).
double distance_sq(Point p, const double *corners) {
  const Point a{corners[0], corners[1], corners[2]}, b{corners[3], corners[4], corners[5]},
      c{corners[6], corners[7], corners[8]};
  const Point ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  const auto from = [](Point r, Point u, double s, Point v, double t) {
    const Point d{r.x - s * u.x - t * v.x, r.y - s * u.y - t * v.y, r.z - s * u.z - t * v.z};
    return dot(d, d);
  };
  if (d1 <= 0 && d2 <= 0) return dot(ap, ap);
  const Point bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return dot(bp, bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return from(ap, ab, d1 / (d1 - d3), ac, 0);
  const Point cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return dot(cp, cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return from(ap, ab, 0, ac, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return from(bp, c - b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), ac, 0);
  const double inverse = 1 / (va + vb + vc);
  return from(ap, ab, vb * inverse, ac, vc * inverse);
}

Point at(const double *p) { return {p[0], p[1], p[2]}; }

}  // namespace

Triangles::Triangles(const riis_surface *surface) {
  const riis_triangles triangles = triangles_of(surface);
  for (std::int64_t i = 0; i < 3 * triangles.n_triangles; ++i) {
    const double *corner = triangles.xyz + 3 * triangles.vertex_id[i];
    corners.insert(corners.end(), corner, corner + 3);
  }
  leaflet_id.assign(triangles.leaflet_id, triangles.leaflet_id + triangles.n_triangles);
}

EveryTriangle::EveryTriangle(const Triangles &triangles) {
  for (std::int64_t i = 0; i < triangles.n(); ++i) {
    const double *corners = triangles.corners.data() + 9 * i;
    const Point a = at(corners), ab = at(corners + 3) - a, ac = at(corners + 6) - a, bc = ac - ab;
    const double ab_ab = dot(ab, ab), ab_ac = dot(ab, ac), ac_ac = dot(ac, ac);
    triangles_.push_back({{a.x, a.y, a.z},
                          {ab.x, ab.y, ab.z},
                          {ac.x, ac.y, ac.z},
                          ab_ab,
                          ab_ac,
                          ac_ac,
                          1 / ab_ab,
                          1 / ac_ac,
                          1 / dot(bc, bc),
                          1 / (ab_ab * ac_ac - ab_ac * ab_ac)});
  }
}

// Uses the regions of distance_sq.
double EveryTriangle::operator()(const double *p, double) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Prepared &t : triangles_) {
    const Point ap = at(p) - at(t.a), ab = at(t.ab), ac = at(t.ac);
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = d1 - t.ab_ab, d4 = d2 - t.ab_ac, d5 = d1 - t.ab_ac,
                 d6 = d2 - t.ac_ac;
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    double v = 0, w = 0;  // the closest point is a + v ab + w ac
    if (d1 <= 0 && d2 <= 0) {
    } else if (d3 >= 0 && d4 <= d3) {
      v = 1;
    } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
      v = d1 * t.by_ab;
    } else if (d6 >= 0 && d5 <= d6) {
      w = 1;
    } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
      w = d2 * t.by_ac;
    } else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
      w = (d4 - d3) * t.by_bc;
      v = 1 - w;
    } else {
      v = vb * t.by_area;
      w = vc * t.by_area;
    }
    const Point d{ap.x - v * ab.x - w * ac.x, ap.y - v * ab.y - w * ac.y, ap.z - v * ab.z - w * ac.z};
    least = std::min(least, dot(d, d));
  }
  return std::sqrt(least);
}

struct PointQuery::Implementation {
  const Triangles &triangles;
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);

  explicit Implementation(const Triangles &of) : triangles(of) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(triangles.n()));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  ~Implementation() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  static void bounds(const RTCBoundsFunctionArguments *arguments) {
    const double *c = static_cast<const Implementation *>(arguments->geometryUserPtr)->triangles.corners.data() +
                      9 * std::size_t{arguments->primID};
    constexpr double slack = 1e-6;  // a margin for the single precision of coordinates of some centimetres
    float lower[3], upper[3];
    for (int i = 0; i < 3; ++i) {
      lower[i] = static_cast<float>(std::min({c[i], c[3 + i], c[6 + i]}) - slack);
      upper[i] = static_cast<float>(std::max({c[i], c[3 + i], c[6 + i]}) + slack);
    }
    *arguments->bounds_o = {lower[0], lower[1], lower[2], 0, upper[0], upper[1], upper[2], 0};
  }

  struct Asked {
    const double *corners;
    Point p;
    double least_sq;
  };
  static bool visit(RTCPointQueryFunctionArguments *arguments) {
    Asked &asked = *static_cast<Asked *>(arguments->userPtr);
    const double sq = distance_sq(asked.p, asked.corners + 9 * std::size_t{arguments->primID});
    if (sq >= asked.least_sq) return false;
    asked.least_sq = sq;
    const auto radius = static_cast<float>(std::sqrt(sq) + 2e-6);
    if (radius >= arguments->query->radius) return false;
    arguments->query->radius = radius;
    return true;
  }
};

PointQuery::PointQuery(const Triangles &triangles) : implementation_(std::make_unique<Implementation>(triangles)) {}
PointQuery::~PointQuery() = default;

double PointQuery::operator()(const double *p, double limit) const {
  Implementation::Asked asked{implementation_->triangles.corners.data(), at(p),
                              std::numeric_limits<double>::infinity()};
  RTCPointQuery sphere;
  sphere.x = static_cast<float>(p[0]);
  sphere.y = static_cast<float>(p[1]);
  sphere.z = static_cast<float>(p[2]);
  sphere.time = 0;
  sphere.radius = static_cast<float>(limit + 2e-6);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(implementation_->scene, &sphere, &context, Implementation::visit, &asked);
  return std::sqrt(asked.least_sq);
}

void PaperSearch::begin_at(const Triangles &triangles) {
  starts_.clear();
  std::int32_t last = -1;
  for (std::int64_t i = 0; i < triangles.n(); ++i) {
    if (triangles.leaflet_id[static_cast<std::size_t>(i)] == last) continue;
    last = triangles.leaflet_id[static_cast<std::size_t>(i)];
    const Point corner = at(triangles.corners.data() + 9 * i);
    std::int64_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::int64_t node = 0; node < n_nodes_; ++node) {
      const Point d = at(xyz_ + 3 * node) - corner;
      if (dot(d, d) < least) least = dot(d, d), nearest = node;
    }
    starts_.push_back(nearest);
  }
}

template <class Distance>
std::int64_t PaperSearch::run(const Distance &distance, double half_thickness, int n_threads) {
  const auto *offsets = static_cast<const std::int64_t *>(rows_.offsets);
  const auto *columns = static_cast<const std::int32_t *>(rows_.columns);
  was_seen_.assign(static_cast<std::size_t>(n_nodes_), 0);
  std::vector<std::int64_t> level, next;
  for (const std::int64_t node : starts_)
    if (!was_seen_[static_cast<std::size_t>(node)])
      was_seen_[static_cast<std::size_t>(node)] = 1, level.push_back(node);
  std::vector<std::uint8_t> is_marked;
  std::int64_t n_marked = 0;
  n_asked_ = 0;
  while (!level.empty()) {
    const auto n = static_cast<std::int64_t>(level.size());
    is_marked.assign(level.size(), 0);
#pragma omp parallel for num_threads(n_threads) schedule(dynamic, 64) if (n_threads > 1)
    for (std::int64_t i = 0; i < n; ++i)
      is_marked[static_cast<std::size_t>(i)] =
          distance(xyz_ + 3 * level[static_cast<std::size_t>(i)], half_thickness) <= half_thickness;
    n_asked_ += n;
    next.clear();
    for (std::int64_t i = 0; i < n; ++i) {
      if (!is_marked[static_cast<std::size_t>(i)]) continue;
      ++n_marked;
      const std::int64_t node = level[static_cast<std::size_t>(i)];
      for (std::int64_t k = offsets[node]; k < offsets[node + 1]; ++k) {
        std::uint8_t &seen = was_seen_[static_cast<std::size_t>(columns[k])];
        if (!seen) seen = 1, next.push_back(columns[k]);
      }
    }
    std::swap(level, next);
  }
  return n_marked;
}

template std::int64_t PaperSearch::run(const EveryTriangle &, double, int);
template std::int64_t PaperSearch::run(const PointQuery &, double, int);

double pass_over_coordinates(std::int64_t n_nodes, const double *xyz, int n_threads) {
  double least = std::numeric_limits<double>::infinity();
#pragma omp parallel for num_threads(n_threads) schedule(static) reduction(min : least)
  for (std::int64_t i = 0; i < n_nodes; ++i) least = std::min(least, dot(at(xyz + 3 * i), at(xyz + 3 * i)));
  return least;
}

}  // namespace bench
