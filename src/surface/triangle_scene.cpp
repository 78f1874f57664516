// SPDX-License-Identifier: Apache-2.0
#include "surface/triangle_scene.hpp"

#if defined(RIIS_EMBREE_4)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "api/errors.hpp"

namespace riis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void fail_embree(RTCError error, const char *what) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  fail(RIIS_INTERNAL_ERROR, "Embree failed to %s (error %d)", what, static_cast<int>(error));
}

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Release>;

// One device for all surfaces of the process, there as long as one of them is: creating one costs more than a small
// scene. The default configuration leaves threads to the caller's TBB settings.
std::shared_ptr<std::remove_pointer_t<RTCDevice>> shared_device() {
  static std::mutex mutex;
  static std::weak_ptr<std::remove_pointer_t<RTCDevice>> current;
  const std::lock_guard<std::mutex> lock(mutex);
  auto device = current.lock();
  if (!device) {
    const RTCDevice created = rtcNewDevice(nullptr);
    if (!created) fail_embree(rtcGetDeviceError(nullptr), "create a device");
    device.reset(created, Release{});
    current = device;
  }
  return device;
}

float round_down(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafterf(f, -std::numeric_limits<float>::infinity()) : f;
}
float round_up(double x) { return -round_down(-x); }

// Coordinates relative to the surface: (x - centre) * scale, scale a power of two that makes the surface's half extent
// from 1/2 to 1. Both operations are right to rounding of their result.
struct Frame {
  Vec3 centre;
  double scale;

  explicit Frame(const Bounds &bounds) {
    centre = 0.5 * bounds.lower + 0.5 * bounds.upper;
    const Vec3 extent = bounds.upper - bounds.lower;
    int exponent = 0;
    std::frexp(0.5 * std::max({extent.x, extent.y, extent.z}), &exponent);
    scale = std::ldexp(1.0, -exponent);
  }
  Vec3 operator()(Vec3 p) const { return scale * (p - centre); }
};

// Beyond this many half extents from the centre single precision separates nothing: all triangles are asked.
constexpr double far_away = 1e6;

// The radius, in the frame's units, that makes Embree visit every triangle whose distance from q, as the kernel computes it, is at
// most `distance`. Embree compares float sums of squares of the float point to outward-rounded boxes with the radius'
// square. With unit roundoff e = 2^-24 the point is off by at most sqrt(3) e max|q|; the subtractions, squares and sums are
// right to a factor 1 + 6 e, the radius' square to 1 + e. The factor 1 + 2^-20 = 1 + 16 e and 4 e max|q| cover these, with
// the rounding of this function itself; `rounding` covers the kernel's; 2^-60 keeps the radius' square a normal float.
float inflated_radius(double distance, Vec3 q, double rounding) {
  const double largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)});
  return round_up(distance * (1.0 + 0x1p-20) + largest * 0x1p-22 + rounding + 0x1p-60);
}

}  // namespace

struct TriangleScene::Implementation {
  std::vector<std::array<Vec3, 3>> triangles;  // their corners
  Frame frame;
  double rounding;  // the scene's rounding_ in the frame's units
  std::shared_ptr<std::remove_pointer_t<RTCDevice>> device;
  Scene scene;
};

namespace {

struct Query {
  const TriangleScene::Implementation *in;
  Vec3 p;  // the point as it is
  Vec3 q;  // and in the frame
  ClosestTriangle best;
};

// Asks one triangle; true if it is the closest so far.
bool ask(Query &query, std::int64_t triangle) {
  const auto &[a, b, c] = query.in->triangles[static_cast<std::size_t>(triangle)];
  const double distance_sq = closest_point_on_triangle(query.p, a, b, c).distance_sq;
  if (!is_closer(distance_sq, triangle, query.best)) return false;
  query.best = {distance_sq, triangle};
  return true;
}

void bounds_of_triangle(const RTCBoundsFunctionArguments *arguments) {
  const auto *in = static_cast<const TriangleScene::Implementation *>(arguments->geometryUserPtr);
  const std::array<Vec3, 3> &corners = in->triangles[arguments->primID];
  const Vec3 a = in->frame(corners[0]), b = in->frame(corners[1]), c = in->frame(corners[2]);
  RTCBounds *bounds = arguments->bounds_o;
  bounds->lower_x = round_down(std::min({a.x, b.x, c.x}));
  bounds->lower_y = round_down(std::min({a.y, b.y, c.y}));
  bounds->lower_z = round_down(std::min({a.z, b.z, c.z}));
  bounds->upper_x = round_up(std::max({a.x, b.x, c.x}));
  bounds->upper_y = round_up(std::max({a.y, b.y, c.y}));
  bounds->upper_z = round_up(std::max({a.z, b.z, c.z}));
}

bool visit_triangle(RTCPointQueryFunctionArguments *arguments) {
  auto &query = *static_cast<Query *>(arguments->userPtr);
  if (!ask(query, arguments->primID)) return false;
  const float radius =
      inflated_radius(std::sqrt(query.best.distance_sq) * query.in->frame.scale, query.q, query.in->rounding);
  if (!(radius < arguments->query->radius)) return false;
  arguments->query->radius = radius;
  return true;
}

Bounds bounds_of(const TriangleSet &set) {
  Bounds bounds{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const std::int64_t id : set.vertex_id) {
    const Vec3 p = set.vertex(id);
    bounds.lower = {std::min(bounds.lower.x, p.x), std::min(bounds.lower.y, p.y), std::min(bounds.lower.z, p.z)};
    bounds.upper = {std::max(bounds.upper.x, p.x), std::max(bounds.upper.y, p.y), std::max(bounds.upper.z, p.z)};
  }
  return bounds;
}

// The kernel computes a point of the triangle, each coordinate right to a few units of rounding of the largest coordinate,
// and from it a distance right to rounding of its own: 16 units cover the former with room.
double rounding_of_distances(const Bounds &bounds) {
  const Vec3 a = bounds.lower, b = bounds.upper;
  return 0x1p-49 * std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z), std::abs(b.x), std::abs(b.y), std::abs(b.z)});
}

}  // namespace

TriangleScene::TriangleScene(const TriangleSet &set)
    : bounds_(bounds_of(set)), rounding_(rounding_of_distances(bounds_)) {
  const Frame frame(bounds_);
  implementation_ =
      std::make_unique<Implementation>(Implementation{{}, frame, rounding_ * frame.scale, shared_device(), nullptr});
  Implementation &in = *implementation_;
  in.triangles.reserve(set.n_triangles());
  for (std::size_t i = 0; i < set.n_triangles(); ++i) in.triangles.push_back(set.corners(i));

  const RTCDevice device = in.device.get();
  const auto check = [device](const char *what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) fail_embree(error, what);
  };
  rtcGetDeviceError(device);  // forgets what an earlier failure of this thread may have left
  in.scene.reset(rtcNewScene(device));
  check("create a scene");
  const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  check("create a geometry");
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(in.triangles.size()));
  rtcSetGeometryUserData(geometry.get(), &in);
  rtcSetGeometryBoundsFunction(geometry.get(), bounds_of_triangle, nullptr);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(in.scene.get(), geometry.get());
  check("take the triangles");
  rtcCommitScene(in.scene.get());
  check("build the scene");
}

TriangleScene::~TriangleScene() = default;

bool TriangleScene::may_be_within(Vec3 p, double limit) const {
  const auto outside = [](double x, double lower, double upper) { return std::max({lower - x, x - upper, 0.0}); };
  const Vec3 &lower = bounds_.lower, &upper = bounds_.upper;
  const double distance =
      length(Vec3{outside(p.x, lower.x, upper.x), outside(p.y, lower.y, upper.y), outside(p.z, lower.z, upper.z)});
  return distance <= limit * (1 + 1e-12) + rounding_;
}

ClosestTriangle TriangleScene::closest(Vec3 p, double limit) const {
  const Implementation &in = *implementation_;
  Query query{&in, p, in.frame(p), {infinity, -1}};
  if (!(std::max({std::abs(query.q.x), std::abs(query.q.y), std::abs(query.q.z)}) <= far_away)) {
    // Also where the frame's units overflow. The surface is farther than its own size: most limits end here.
    if (!may_be_within(p, limit)) return {infinity, -1};
    for (std::size_t i = 0; i < in.triangles.size(); ++i) ask(query, static_cast<std::int64_t>(i));
  } else {
    double reach = limit;
    if (!(reach * in.frame.scale < 4 * far_away)) {
      // No limit that culls: some triangle's distance is one.
      ask(query, 0);
      reach = std::sqrt(query.best.distance_sq);
    }
    RTCPointQuery sphere;
    sphere.x = static_cast<float>(query.q.x);
    sphere.y = static_cast<float>(query.q.y);
    sphere.z = static_cast<float>(query.q.z);
    sphere.time = 0;
    sphere.radius = inflated_radius(reach * in.frame.scale, query.q, in.rounding);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(in.scene.get(), &sphere, &context, visit_triangle, &query);
  }
  if (query.best.triangle >= 0 && !(std::sqrt(query.best.distance_sq) <= limit)) return {infinity, -1};
  return query.best;
}

}  // namespace riis
