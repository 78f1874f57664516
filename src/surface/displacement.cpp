// SPDX-License-Identifier: Apache-2.0
#include "surface/displacement.hpp"

#include <algorithm>
#include <cstddef>

#include "base/errors.hpp"

namespace riis {
namespace {

// A side of a patch at both states.
class MovedSide {
 public:
  MovedSide(const MovedPatch &moved, Side Patch::*side, const Polyline *polyline)
      : now_(moved.now.patches[moved.patch].*side),
        before_(moved.before.patches[moved.patch].*side),
        curve_now_(moved.now.curves[now_.curve]),
        curve_before_(moved.before.curves[before_.curve]),
        polyline_(polyline),
        is_at_rest_(now_.reversed == before_.reversed && are_equal(curve_now_, curve_before_)) {}

  bool is_at_rest() const { return is_at_rest_; }

  Vec3 displacement(double t) const { return is_at_rest_ ? Vec3{0, 0, 0} : now(t) - before(t); }

  Vec3 before(double t) const { return curve_before_.at(before_.reversed ? 1 - t : t); }
  Curve::Frame frame_before(double t) const {
    Curve::Frame frame = curve_before_.frame(before_.reversed ? 1 - t : t);
    if (before_.reversed) frame.tangent = -frame.tangent;
    return frame;
  }

 private:
  // A vertex of the polyline is a point of the curve that is already known.
  Vec3 now(double t) const {
    if (polyline_ && polyline_->length > 0) {
      const auto vertex = std::lower_bound(polyline_->t.begin(), polyline_->t.end(), t);
      if (vertex != polyline_->t.end() && *vertex == t)
        return polyline_->points[static_cast<std::size_t>(vertex - polyline_->t.begin())];
    }
    return curve_now_.at(now_.reversed ? 1 - t : t);
  }

  Side now_, before_;
  const Curve &curve_now_, &curve_before_;
  const Polyline *polyline_;
  bool is_at_rest_;
};

class ArcMotion {
 public:
  explicit ArcMotion(const MovedPatch &moved)
      : moved_(moved),
        bulge_before_(moved.before.patches[moved.patch].bulge),
        base_(moved, &Patch::v0, moved.sides.side_v0),
        edge_(moved, &Patch::v1, moved.sides.side_v1),
        is_at_rest_(base_.is_at_rest() && edge_.is_at_rest() && moved.now.patches[moved.patch].bulge == bulge_before_) {
  }

  Vector<Vec3> displacements(const GridLines &lines) const {
    Vector<Vec3> made;
    made.reserve(lines.u.size() * lines.v.size());
    Vector<Vec3> base, edge, offset;
    for (std::size_t i = 0; i < lines.u.size(); ++i) {
      base.push_back(base_.displacement(lines.u[i].t0));
      edge.push_back(edge_.displacement(lines.u[i].t1));
      offset.push_back(is_at_rest_ ? Vec3{0, 0, 0} : offset_now(i) - offset_before(lines.u, i));
    }
    for (const GridLine &line : lines.v)
      for (std::size_t i = 0; i < base.size(); ++i) {
        const double v = line.middle;
        made.push_back(mix(base[i], edge[i], v) + (2 * v * (1 - v)) * offset[i]);
      }
    return made;
  }

 private:
  Vec3 offset_now(std::size_t i) const { return moved_.offsets ? (*moved_.offsets)[i] : Vec3{0, 0, 0}; }

  Vec3 offset_before(const Vector<GridLine> &lines, std::size_t i) const {
    if (bulge_before_ == 0) return {0, 0, 0};
    // The neighbours have the same offsets at the ends.
    const Patch &before = moved_.before.patches[moved_.patch];
    if (i == 0) return arc_offset(moved_.before, before.u0);
    if (i + 1 == lines.size()) return arc_offset(moved_.before, before.u1);
    const double u = lines[i].middle;
    const Curve::Frame frame = base_.frame_before(u);
    return arc_offset(edge_.before(u) - frame.point, frame.tangent, bulge_before_);
  }

  const MovedPatch &moved_;
  double bulge_before_;
  MovedSide base_, edge_;
  bool is_at_rest_;
};

Vector<Vec3> coons_displacements(const MovedPatch &moved, const GridLines &lines) {
  const MovedSide v0(moved, &Patch::v0, moved.sides.side_v0), v1(moved, &Patch::v1, moved.sides.side_v1),
      u0(moved, &Patch::u0, moved.sides.side_u0), u1(moved, &Patch::u1, moved.sides.side_u1);
  SideVectors sides;
  for (const GridLine &line : lines.u) {
    sides.v0.push_back(v0.displacement(line.t0));
    sides.v1.push_back(v1.displacement(line.t1));
  }
  for (const GridLine &line : lines.v) {
    const bool is_inside = line.middle > 0 && line.middle < 1;
    sides.u0.push_back(is_inside ? u0.displacement(line.t0) : Vec3{0, 0, 0});
    sides.u1.push_back(is_inside ? u1.displacement(line.t1) : Vec3{0, 0, 0});
  }
  return coons_combination(middles(lines.u), middles(lines.v), sides);
}

}  // namespace

Vector<Vec3> displacements(const MovedPatch &moved, const GridLines &lines) {
  // A patch of arcs without a bulge is the Coons patch of its sides, whose label v is the same.
  const bool has_arcs = moved.now.patches[moved.patch].bulge != 0 || moved.before.patches[moved.patch].bulge != 0;
  return has_arcs ? ArcMotion(moved).displacements(lines) : coons_displacements(moved, lines);
}

ImageMotion::AffineMap ImageMotion::map_of(const PatchImage &image, const Placement &placement) {
  const PatchImage turn{image.mirror, image.rotation, {0, 0, 0}, 0, 0};
  const auto column = [&](Vec3 unit) { return placement.scale * (placement.rotation * place(turn, unit)); };
  const Vec3 x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
  return {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}, place(placement, image.translation)};
}

ImageMotion::ImageMotion(const PatchImage &now, const PatchImage &before, const Placement &placement_now,
                         const Motion &motion)
    : now_(map_of(now, placement_now)), difference_(now_), seconds_(motion.seconds) {
  const AffineMap then = map_of(before, motion.placement_before);
  difference_.linear.row_x = now_.linear.row_x - then.linear.row_x;
  difference_.linear.row_y = now_.linear.row_y - then.linear.row_y;
  difference_.linear.row_z = now_.linear.row_z - then.linear.row_z;
  difference_.offset = now_.offset - then.offset;
}

void check_same_build(const PatchSet &now, const PatchSet &before) {
  if (now.patches.size() != before.patches.size())
    fail(RIIS_INVALID_PARAMETER, "valve_before has ", before.patches.size(), " patches, valve has ", now.patches.size(),
         ": they must be two states of one valve");
  for (std::size_t i = 0; i < now.patches.size(); ++i) {
    const auto &images = now.patches[i].images, &images_before = before.patches[i].images;
    const bool is_same = std::equal(
        images.begin(), images.end(), images_before.begin(), images_before.end(),
        [](const PatchImage &a, const PatchImage &b) { return a.mirror == b.mirror && a.patch_id == b.patch_id; });
    if (!is_same)
      fail(RIIS_INVALID_PARAMETER, "patch ", i, " of valve_before is not patch ", i,
           " of valve: they must be two states of one valve");
  }
}

}  // namespace riis
