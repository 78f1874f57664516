// SPDX-License-Identifier: Apache-2.0
#include "scene/triangle_scene.hpp"

#if defined(RIIS_EMBREE_4)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "base/errors.hpp"
#include "base/made_once.hpp"
#include "common/array_view.hpp"
#include "parallel/arena.hpp"

namespace riis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void fail_embree(RTCError error, const char *what) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  fail(RIIS_INTERNAL_ERROR, "Embree failed to ", what, " (error ", static_cast<int>(error), ")");
}

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Release>;

// Returns the one device of the process, which all surfaces share. Making a device takes longer than making a small scene. The
// device exists as long as any surface exists. The device's default configuration leaves the number of threads to the caller's
// TBB settings.
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

// A point more than `far_away` half extents from the centre is compared with all triangles, because single precision cannot
// distinguish the triangles at this distance.
constexpr double far_away = 1e6;

// Returns the radius, in the frame's units, that makes Embree visit every triangle whose computed distance from q is at most
// `distance`. Embree works in single precision. It compares the square of the radius with the squared distance from the rounded
// point to a box, which is rounded outwards. The unit roundoff is e = 2^-24. Rounding moves the point by at most sqrt(3) e
// max|q|. The subtractions, squares and sums together have a relative error of at most 6 e. The square of the radius has a
// relative error of at most e. The factor 1 + 2^-20 = 1 + 16 e and the term 4 e max|q| cover all these errors, and this
// function's own rounding. `rounding` covers the rounding of the decision kernel. The term 2^-60 keeps the square of the radius
// in the range of normal floats.
float inflated_radius(double distance, Vec3 q, double rounding) {
  const double largest = largest_coordinate(q);
  return round_up(distance * (1.0 + 0x1p-20) + largest * 0x1p-22 + rounding + 0x1p-60);
}

}  // namespace

struct TriangleScene::Implementation {
  TriangleGroups groups;
  double rounding = 0;  // TriangleScene::rounding_ in the frame's units
  int n_threads = 1;    // the number of threads that build the tree
  std::shared_ptr<std::remove_pointer_t<RTCDevice>> device = shared_device();
  MadeOnce<Scene> scene;
  Geometry geometry;
  bool tree_fits = false;  // whether the tree was last built over the same groups

  // Returns Embree's tree over the groups. Builds the tree if no query has built it since the groups were made.
  RTCScene tree() {
    return scene.get([this](Scene &made) { build(made); }).get();
  }

 private:
  void build(Scene &made);
};

namespace {

struct Query {
  const TriangleScene::Implementation *in;
  const Kernels *kernels;
  Vec3 p;          // the point itself
  Vec3 q;          // the point in the frame
  double largest;  // a bound of q's coordinates and of the distances that matter
  ClosestTriangle best;
  Ties *ties;  // or null
  bool is_out_of_memory;
};

// Queries one triangle. Returns true if the triangle is the closest so far. The function is not inlined, because inlining would
// make the loops over groups need too many registers.
template <bool keeps_ties>
__attribute__((noinline)) bool query_triangle(Query &query, std::int64_t triangle) {
  const double *c = query.in->groups.corners.data() + 9 * triangle;
  const double distance_sq =
      closest_point_on_triangle(query.p, {c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}).distance_sq;
  if (!is_closer(distance_sq, triangle, query.best)) {
    if constexpr (keeps_ties) query.ties->compare(0, query.best, {distance_sq, triangle});
    return false;
  }
  [[maybe_unused]] const ClosestTriangle before = query.best;
  query.best = {distance_sq, triangle};
  if constexpr (keeps_ties) query.ties->compare(0, query.best, before);
  return true;
}

// Queries a triangle in a callback from Embree. No exception may pass through Embree. The only possible exception is a lack of
// memory for the lists of ties.
template <bool keeps_ties>
bool query_in_embree(Query &query, std::int64_t triangle) {
  if constexpr (keeps_ties) {
    try {
      return query_triangle<true>(query, triangle);
    } catch (const std::bad_alloc &) {
      query.is_out_of_memory = true;
      return false;
    }
  }
  return query_triangle<false>(query, triangle);
}

void bounds_of_group(const RTCBoundsFunctionArguments *arguments) {
  const auto *in = static_cast<const TriangleScene::Implementation *>(arguments->geometryUserPtr);
  const GroupBounds &group = in->groups.bounds[arguments->primID];
  RTCBounds *bounds = arguments->bounds_o;
  bounds->lower_x = group.lower[0];
  bounds->lower_y = group.lower[1];
  bounds->lower_z = group.lower[2];
  bounds->upper_x = group.upper[0];
  bounds->upper_y = group.upper[1];
  bounds->upper_z = group.upper[2];
}

// Queries the triangles of a group. The filter rules out triangles whose distance exceeds the radius by more than the filter's
// error.
template <bool keeps_ties>
bool visit_group(RTCPointQueryFunctionArguments *arguments) {
  auto &query = *static_cast<Query *>(arguments->userPtr);
  const TriangleGroups &groups = query.in->groups;
  const GroupBounds &bounds = groups.bounds[arguments->primID];
  float distance_sq[triangles_per_group];
  // In the frame's units, the closest triangle is at most sqrt(3) (query.largest + 1) away. Up to the distance query.largest + 1,
  // the filter's error is at most half of `error`. Up to nearly twice that distance, the filter's error is at most `error`.
  const float error =
      filter_error(1, 0, query.largest + 1, groups.longest_edge) + static_cast<float>(4 * query.in->rounding);
  const float point[3] = {static_cast<float>(query.q.x), static_cast<float>(query.q.y), static_cast<float>(query.q.z)};
  query.kernels->group_distances(groups.groups[arguments->primID], point, error, distance_sq);
  const float reach = arguments->query->radius + 2 * error;
  bool is_closer = false;
  for (int i = 0; i < bounds.n; ++i)
    if (distance_sq[i] <= reach * reach)
      is_closer = query_in_embree<keeps_ties>(query, bounds.triangle[i]) || is_closer;
  if (!is_closer) return false;
  const double tolerance = keeps_ties ? query.ties->rule.of_leaflets : 0;
  const float radius = inflated_radius((std::sqrt(query.best.distance_sq) + tolerance) * groups.frame.scale, query.q,
                                       query.in->rounding);
  if (!(radius < arguments->query->radius)) return false;
  arguments->query->radius = radius;
  return true;
}

// Calls visit for the groups within a radius of a point, and perhaps for other groups.
void visit_groups(RTCScene tree, const float *point, float radius, RTCPointQueryFunction visit, void *user_data) {
  RTCPointQuery sphere{point[0], point[1], point[2], 0, radius};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(tree, &sphere, &context, visit, user_data);
}

struct Collected {
  std::vector<std::int32_t> &groups;
  bool is_out_of_memory;
};

// Collects a group that Embree found. No exception may pass through Embree, so a lack of memory is recorded instead.
bool add_group(RTCPointQueryFunctionArguments *arguments) {
  auto &collected = *static_cast<Collected *>(arguments->userPtr);
  try {
    collected.groups.push_back(static_cast<std::int32_t>(arguments->primID));
  } catch (const std::bad_alloc &) {
    collected.is_out_of_memory = true;
  }
  return false;
}

// Bounds the rounding of a distance. The kernel computes a point of the triangle. The error of this point's coordinates is a few
// units of rounding of the largest coordinate. The bound of 16 units is ample. The distance from a given point to the computed
// point has only a small relative error.
double rounding_of_distances(const Bounds &bounds) { return 0x1p-49 * bounds.largest_coordinate(); }

}  // namespace

void TriangleScene::Implementation::build(Scene &made) {
  const auto check = [this](const char *what) {
    const RTCError error = rtcGetDeviceError(device.get());
    if (error != RTC_ERROR_NONE) fail_embree(error, what);
  };
  rtcGetDeviceError(device.get());  // clears an earlier Embree error of this thread
  if (!made) {
    Geometry of_groups(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
    check("create a geometry");
    rtcSetGeometryUserData(of_groups.get(), this);
    rtcSetGeometryBoundsFunction(of_groups.get(), bounds_of_group, nullptr);
    Scene of_geometry(rtcNewScene(device.get()));
    check("create a scene");
    rtcAttachGeometry(of_geometry.get(), of_groups.get());
    check("attach the geometry");
    made = std::move(of_geometry);
    geometry = std::move(of_groups);
  } else {
    // The scene of a moving surface is built often, and each build is used for few queries, so a quick build is better. If the
    // groups are unchanged, the tree is kept and gets new boxes.
    rtcSetSceneFlags(made.get(), RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(made.get(), RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryBuildQuality(geometry.get(), tree_fits ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_LOW);
  }
  tree_fits = false;  // false until the tree is complete
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(groups.groups.size()));
  rtcCommitGeometry(geometry.get());
  check("take the triangles");
  // Embree builds with TBB. Outside of an arena, TBB would use one thread for each processor.
  constexpr std::size_t few = 1024;  // with fewer groups, Embree itself builds on one thread
  Arena(groups.groups.size() < few ? 1 : n_threads).run([&] { rtcCommitScene(made.get()); });
  check("build the scene");
  tree_fits = true;
}

TriangleScene::TriangleScene() : implementation_(std::make_unique<Implementation>()) {}

void TriangleScene::make(const TriangleSet &set, int n_threads) {
  Implementation &in = *implementation_;
  in.groups.take_corners(set, n_threads);
  bounds_ = in.groups.of_all;
  rounding_ = rounding_of_distances(bounds_);
  const SurfaceFrame frame(bounds_);
  in.groups.make(set, frame, n_threads);
  in.rounding = rounding_ * frame.scale;

  in.n_threads = n_threads;
  in.tree_fits = in.tree_fits && in.groups.are_as_before;
  in.scene.forget();
}

void TriangleScene::build_tree() const { implementation_->tree(); }

TriangleScene::~TriangleScene() = default;

bool TriangleScene::may_be_within(Vec3 p, double limit) const {
  return std::sqrt(bounds_.distance_sq_to(p)) <= limit * (1 + 1e-12) + rounding_;
}

ClosestTriangle TriangleScene::closest(Vec3 p, double limit, InstructionSet instructions, Ties *ties) const {
  return ties ? find_closest<true>(p, limit, instructions, ties) : find_closest<false>(p, limit, instructions, nullptr);
}

template <bool keeps_ties>
ClosestTriangle TriangleScene::find_closest(Vec3 p, double limit, InstructionSet instructions, Ties *ties) const {
  const Implementation &in = *implementation_;
  const SurfaceFrame &frame = in.groups.frame;
  const Vec3 q = frame(p);
  const double largest = largest_coordinate(q);
  Query query{&in, &kernels(instructions), p, q, largest, {infinity, -1}, ties, false};
  if constexpr (keeps_ties) ties->candidates.clear();
  if (!(largest <= far_away)) {
    // In the frame's units, the coordinates of so distant a point may overflow. The point is farther away than the surface's
    // size, so with most limits the query ends here.
    if (!may_be_within(p, limit)) return {infinity, -1};
    const std::int64_t n = view(in.groups.corners).size() / 9;
    for (std::int64_t i = 0; i < n; ++i) query_triangle<keeps_ties>(query, i);
  } else {
    double reach = limit;
    if (!(reach * frame.scale < 4 * far_away)) {
      // A limit far above the surface's size would exclude nothing. The distance to the first triangle replaces such a limit.
      query_triangle<keeps_ties>(query, 0);
      reach = std::sqrt(query.best.distance_sq);
    }
    if constexpr (keeps_ties) reach += ties->rule.of_leaflets;
    query.largest += reach * frame.scale;
    const float point[3] = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
    visit_groups(implementation_->tree(), point, inflated_radius(reach * frame.scale, q, in.rounding),
                 visit_group<keeps_ties>, &query);
    if (keeps_ties && query.is_out_of_memory) throw std::bad_alloc();
  }
  if (query.best.triangle >= 0 && !(std::sqrt(query.best.distance_sq) <= limit)) return {infinity, -1};
  return query.best;
}

const TriangleGroups &TriangleScene::groups() const { return implementation_->groups; }

void TriangleScene::collect_groups(const float *point, float radius, std::vector<std::int32_t> &found) const {
  // The radius is increased to cover Embree's own rounding, as in inflated_radius.
  const float inflated =
      radius * (1 + 0x1p-20f) + 0x1p-22f * std::max({std::abs(point[0]), std::abs(point[1]), std::abs(point[2])});
  Collected collected{found, false};
  visit_groups(implementation_->tree(), point, inflated, add_group, &collected);
  if (collected.is_out_of_memory) throw std::bad_alloc();
}

void TriangleScene::collect_along(Vec3 a, Vec3 b, std::vector<std::int32_t> &found) const {
  Bounds segment;
  segment.add(a);
  segment.add(b);
  if (!overlap(segment, bounds_)) return;
  const TriangleGroups &all = implementation_->groups;
  const Vec3 from = all.frame(a), to = all.frame(b), middle = 0.5 * (from + to);
  const double radius = 0.5 * distance(from, to);
  const double largest = std::max(largest_coordinate(middle), radius);
  if (!(largest <= far_away)) {  // in the frame's units, such a segment may overflow
    for (std::size_t i = 0; i < all.bounds.size(); ++i) found.push_back(static_cast<std::int32_t>(i));
  } else {
    const float point[3] = {static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z)};
    collect_groups(point, round_up(radius + 0x1p-22 * largest), found);
  }
  // Coordinates are rounded when they are converted to the frame, but their order stays. Boxes with a common point therefore
  // still have a common point.
  Bounds framed;
  framed.add(from);
  framed.add(to);
  const auto is_beside = [&](std::int32_t group) {
    const GroupBounds &box = view(all.bounds)[group];
    return !overlap(framed, {{box.lower[0], box.lower[1], box.lower[2]}, {box.upper[0], box.upper[1], box.upper[2]}});
  };
  found.erase(std::remove_if(found.begin(), found.end(), is_beside), found.end());
}

}  // namespace riis
