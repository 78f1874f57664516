// SPDX-License-Identifier: Apache-2.0
// The patches of a valve, in the form in which the valve passes them to the surface. Patches refer to curves by their positions
// in a list, so several patches can share a curve.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "geometry/bulge.hpp"
#include "geometry/curve.hpp"
#include "geometry/placement.hpp"

namespace riis {

enum class Mirror { none, in_x, in_y };

inline constexpr std::size_t no_patch = static_cast<std::size_t>(-1);

// The placement of a patch. The patch may first be mirrored, and is then turned and moved. All images of a patch come from the
// same operations on the same points. To the last bit, a patch and its mirror image therefore meet in the mirror's plane.
struct PatchImage {
  Mirror mirror;
  Rotation rotation;
  Vec3 translation;
  std::int32_t leaflet_id;
  std::int32_t patch_id;
  bool is_turned_over = false;  // S_u x S_v points upstream, because the patch was made from a mirror image
};

// Returns whether the triangles of the placed patch are turned over, because its S_u x S_v points upstream.
inline bool points_upstream(const PatchImage &image) { return (image.mirror != Mirror::none) != image.is_turned_over; }

inline Vec3 place(const PatchImage &image, Vec3 p) {
  return image.rotation *
             Vec3{image.mirror == Mirror::in_x ? -p.x : p.x, image.mirror == Mirror::in_y ? -p.y : p.y, p.z} +
         image.translation;
}

// Returns the image without its translation. The result turns directions as the image turns points.
inline PatchImage turn_of(const PatchImage &image) { return {image.mirror, image.rotation, {0, 0, 0}, 0, 0}; }

// A curve as the side of a patch. The curve is given by its position in PatchSet::curves. The side runs along the curve from its
// first or from its last point.
struct Side {
  std::size_t curve;
  bool reversed = false;
};

// The side at which tissue or a stent holds a patch, or none.
enum class AttachedSide : std::uint8_t { none, v0, u1 };

// A line, given by a point and a direction. A skirt leads away from this line (valve/skirt.hpp). The direction is 0 if
// nothing determines it.
struct AxisLine {
  Vec3 centre, direction;
};

// A patch, given by its four sides. Each side is named after the parameter that is constant on it. A curve that two patches
// share is listed once. The curve therefore becomes one polyline, and the patches meet without cracks. S_u x S_v points
// downstream. The triangles of mirror images are turned over, so that their normals also point downstream.
struct Patch {
  Side v0, v1, u0, u1;
  Vector<PatchImage> images;
  // The factor of a patch of arcs, or 0 for a Coons patch. If the factor is not 0, the patch consists of arcs from v0 to v1
  // (geometry/bulge.hpp). Its sides u0 and u1 must then be arcs with the same factor.
  double bulge = 0;
  AttachedSide attached = AttachedSide::none;
  AxisLine axis = {{0, 0, 0},
                   {0, 0, 1}};  // the line from which a skirt of this patch leads away, before an image is placed
  bool is_skirt = false;
  // The patch of arcs that this skirt continues, or no_patch. The skirt lies at the side v0 of that patch, which is the skirt's
  // side v1.
  std::size_t skirt_of_arcs = no_patch;
};

// The points that two images have in common.
enum class SeamPlace : std::uint8_t { corner, side_v1, side_u1 };  // the corner is u = v = 1

// Two images, of one patch or of two patches, that have points in common. The image `image` takes its placed common points from
// the image `twin`, because two separate turns would round differently.
struct Seam {
  std::size_t patch, image, twin;
  SeamPlace place;
  std::size_t twin_patch = no_patch;  // no_patch: the same patch

  std::size_t patch_of_twin() const { return twin_patch == no_patch ? patch : twin_patch; }
  bool has(double u, double v) const {
    return (v == 1 || place == SeamPlace::side_u1) && (u == 1 || place == SeamPlace::side_v1);
  }
};

// A curve of a warped valve follows the points of the original curve. These points are known at `n_material` evenly spaced shares
// of the original curve's length, ends included.
inline constexpr std::size_t n_material = 7;
constexpr double material_share(std::size_t k) { return static_cast<double>(k) / (n_material - 1); }

// The places to which the map takes points of a curve, and the corresponding points of the warped curve. The warped curve
// approximates the mapped curve at equal parameters.
struct MaterialPoints {
  std::array<Vec3, n_material> mapped;
  std::array<PointOnSpan, n_material> on_curve;
  std::array<Vec3, n_material> point;    // points of the warped curve
  std::array<double, n_material> share;  // the share of the warped curve's length up to each point

  // Returns the points in the order of the reversed curve, which has n_spans spans.
  MaterialPoints reversed(std::size_t n_spans) const {
    MaterialPoints made{};
    for (std::size_t k = 0; k < n_material; ++k) {
      const PointOnSpan &at = view(on_curve)[n_material - 1 - k];
      view(made.mapped)[k] = view(mapped)[n_material - 1 - k];
      view(made.on_curve)[k] = {n_spans - 1 - at.span, 1 - at.t};
      view(made.point)[k] = view(point)[n_material - 1 - k];
      view(made.share)[k] = 1 - view(share)[n_material - 1 - k];
    }
    return made;
  }
};

// The places to which the map takes points inside a warped patch. In a patch of arcs, these points are the middles of the arcs
// that begin at evenly spaced shares. In a Coons patch, they are the four points whose u and v are 1/3 or 2/3. The points with v
// = 1/3 come first.
struct MappedInside {
  bool of_arcs;
  std::array<Vec3, n_material> points;
};

// An end of the attached side of a patch.
struct AttachedEnd {
  std::size_t patch;
  bool is_last;
};
// Two ends of attached sides that are neighbours but are not joined, because they belong to different leaflets. Around the axis
// of the attachment, the side with the end `before` comes directly before the side with the end `after`. In some valves the skirt
// is turned at such ends only after a warp. These valves store by which angles, in radians, the skirt would be turned at both
// ends before the warp.
struct NeighbourEnds {
  AttachedEnd before, after;
  std::optional<std::array<double, 2>> turns_at_rest = {};
};

// The names of two states in a message: `state` is compared with `of`.
struct StateNames {
  const char *state, *of;
};

struct PatchSet {
  Vector<Curve> curves;
  Vector<Patch> patches;
  Vector<Seam> seams = {};  // at most one for each image
  // Bounds the Hausdorff distance of the patches from the valve's shape. The bound is not 0 if curves approximate arcs of
  // circles.
  double deviation = 0;
  // The derivatives of the spans' control points with respect to the opening. Empty if the valve does not blend control points.
  // The list ends before the curves of a skirt, which come last and have no derivatives.
  Vector<Vector<Bezier>> rates = {};
  // Only warped patches have this list. Each curve has an entry, except the lines between the sides of a skirt. On these lines,
  // the points at equal shares of the length always are the same material.
  Vector<std::optional<MaterialPoints>> material = {};
  // Only warped patches have this list. Its entries say to which places the map takes points inside each patch.
  Vector<MappedInside> mapped_inside = {};
  // Only valves whose skirts lead away from the axis of the attachment have this list. The patches of such valves have one image
  // each.
  Vector<NeighbourEnds> neighbour_ends = {};

  const Curve &curve_of(const Side &side) const { return curves[side.curve]; }
  // Adds a curve, and returns it as a side.
  Side add(const Curve &curve) {
    curves.push_back(curve);
    return {curves.size() - 1};
  }
};

// Returns the curve of a side, in the direction of the side.
inline Curve along(const PatchSet &set, const Side &side) {
  return side.reversed ? set.curve_of(side).reversed() : set.curve_of(side);
}

// Returns the offset O (geometry/bulge.hpp) on a side that is itself an arc. The two patches at such a side thus get the same
// bits.
inline Vec3 arc_offset(const PatchSet &set, const Side &side) { return arc_offset(set.curve_of(side).spans().front()); }

}  // namespace riis
