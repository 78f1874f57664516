// SPDX-License-Identifier: Apache-2.0
#include "valve/user_patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/integer_array.hpp"
#include "common/array_view.hpp"
#include "valve/warp.hpp"

namespace riis {
namespace {

constexpr std::int64_t max_patches = 1'000'000, max_curves = 4'000'000;
constexpr double max_control = 1e30;
constexpr std::array<const char *, 4> side_names{"v = 0", "v = 1", "u = 0", "u = 1"};

void check_n(const char *field, std::int64_t n, std::int64_t most) {
  if (n < 1 || n > most) fail(RIIS_INVALID_ARGUMENT, "patches.", field, " is ", n, "; it must be from 1 to ", most);
}

Vector<Bezier> curves_of(const riis_patches &arrays) {
  const std::int32_t *degrees = require(arrays.degree, "patches.degree");
  const double *control = require(arrays.control, "patches.control");
  Vector<Bezier> curves;
  for (std::int64_t i = 0; i < arrays.n_curves; ++i) {
    const std::int32_t degree = degrees[i];
    if (degree < 1 || degree > 3)
      fail(RIIS_INVALID_PARAMETER, "degree of curve ", i, " is ", degree, "; it must be 1, 2 or 3");
    std::array<Vec3, 4> q{};
    for (std::int32_t k = 0; k <= degree; ++k, control += 3) {
      for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(control[axis]) <= max_control))
          fail(RIIS_INVALID_PARAMETER, "xyz"[axis], " of control point ", k, " of curve ", i, " is ", control[axis],
               "; it must be finite and at most ", max_control, " in magnitude");
      view(q)[k] = {control[0], control[1], control[2]};
    }
    curves.push_back(degree == 1   ? Bezier::line(q[0], q[1])
                     : degree == 2 ? Bezier::quadratic(q[0], q[1], q[2])
                                   : Bezier::cubic(q[0], q[1], q[2], q[3]));
  }
  return curves;
}

// Returns the diagonal of the box around all control points.
double size_of(const Vector<Bezier> &curves) {
  Bounds box;
  for (const Bezier &curve : curves)
    for (int k = 0; k <= curve.degree; ++k) box.add(view(curve.control)[k]);
  return distance(box.lower, box.upper);
}

class PatchReader {
 public:
  PatchReader(const riis_patches &arrays, const Vector<Bezier> &curves)
      : arrays_(arrays), curves_(curves), max_gap_(1e-9 * size_of(curves)) {}

  Patch read(std::int64_t patch) const {
    std::array<Side, 4> sides{};
    for (std::int64_t k = 0; k < 4; ++k) view(sides)[k] = side(patch, k);
    // Checks each corner, in which two sides meet.
    check_corner(patch, sides, 0, false, 2, false);
    check_corner(patch, sides, 0, true, 3, false);
    check_corner(patch, sides, 1, false, 2, true);
    check_corner(patch, sides, 1, true, 3, true);
    const std::int32_t leaflet_id = arrays_.leaflet_id ? arrays_.leaflet_id[patch] : 0;
    if (leaflet_id < 0)
      fail(RIIS_INVALID_PARAMETER, "leaflet_id of patch ", patch, " is ", leaflet_id, "; it must be at least 0");
    return {sides[0],
            sides[1],
            sides[2],
            sides[3],
            {{Mirror::none, no_rotation, {0, 0, 0}, leaflet_id, static_cast<std::int32_t>(patch)}},
            0,
            AttachedSide::v0};
  }

 private:
  Side side(std::int64_t patch, std::int64_t k) const {
    const std::int64_t at = 4 * patch + k;
    const std::int64_t given = arrays_.curve_id[at], curve = given - arrays_.index_base;
    if (curve < 0 || curve >= arrays_.n_curves)
      fail(RIIS_INVALID_PARAMETER, "side ", view(side_names)[k], " of patch ", patch, " is curve ", given,
           "; there are curves ", arrays_.index_base, " to ", arrays_.n_curves - 1 + arrays_.index_base);
    const std::int32_t reversed = arrays_.reversed ? arrays_.reversed[at] : 0;
    if (reversed != 0 && reversed != 1)
      fail(RIIS_INVALID_PARAMETER, "reversed of side ", view(side_names)[k], " of patch ", patch, " is ", reversed,
           "; it must be 0 or 1");
    return {static_cast<std::size_t>(curve), reversed == 1};
  }

  Vec3 end_of(const Side &side, bool last) const {
    const Bezier &curve = curves_[side.curve];
    return last != side.reversed ? curve.last() : curve.first();
  }

  void check_corner(std::int64_t patch, const std::array<Side, 4> &sides, std::size_t a, bool a_last, std::size_t b,
                    bool b_last) const {
    const Vec3 p = end_of(sides[a], a_last), q = end_of(sides[b], b_last);
    if (!(distance(p, q) <= max_gap_))
      fail(RIIS_INVALID_PARAMETER, "patch ", patch, " does not close: side ", side_names[a], " ",
           a_last ? "ends" : "begins", " in (", p.x, ", ", p.y, ", ", p.z, "), side ", side_names[b], " ",
           b_last ? "ends" : "begins", " in (", q.x, ", ", q.y, ", ", q.z,
           "); if a curve runs the other way, reverse it");
  }

  const riis_patches &arrays_;
  const Vector<Bezier> &curves_;
  double max_gap_;
};

PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening) {
  PatchSet set{{}, closed.patches.patches};
  for (std::size_t i = 0; i < closed.patches.curves.size(); ++i) {
    const Bezier &from = closed.patches.curves[i].spans().front(), &to = open.patches.curves[i].spans().front();
    set.curves.push_back(blend(from, to, opening));
    set.rates.push_back({rate(from, to)});
  }
  return set;
}

void check_states(const ValveState &valve, const ValveState &other, const char *name) {
  const PatchSet &from = valve.patches, &to = other.patches;
  if (from.curves.size() != to.curves.size() || from.patches.size() != to.patches.size())
    fail(RIIS_INVALID_PARAMETER, name, " has ", to.curves.size(), " curves and ", to.patches.size(),
         " patches, the valve ", from.curves.size(), " and ", from.patches.size(),
         ": both must have as many curves and patches");
  for (std::size_t i = 0; i < from.curves.size(); ++i) {
    // A straight line is stored as a curve of degree 2. A curve may thus be a line in one state and a quadratic in the other.
    const int degree = from.curves[i].spans().front().degree, other_degree = to.curves[i].spans().front().degree;
    if (degree != other_degree)
      fail(RIIS_INVALID_PARAMETER, "curve ", i, " is cubic in ", other_degree == 3 ? name : "the valve",
           " only: the degree must be the same");
  }
  for (std::size_t i = 0; i < from.patches.size(); ++i) {
    const Patch &a = from.patches[i], &b = to.patches[i];
    const auto same = [](const Side &s, const Side &t) { return s.curve == t.curve && s.reversed == t.reversed; };
    if (!same(a.v0, b.v0) || !same(a.v1, b.v1) || !same(a.u0, b.u0) || !same(a.u1, b.u1))
      fail(RIIS_INVALID_PARAMETER, "patch ", i, " has other sides in ", name, " than in the valve");
  }
}

}  // namespace

PatchSet patches_from_arrays(const riis_patches &arrays) {
  check_n("n_curves", arrays.n_curves, max_curves);
  check_n("n_patches", arrays.n_patches, max_patches);
  require(arrays.curve_id, "patches.curve_id");
  check_base("patches.index_base", arrays.index_base);
  check_reserved("patches.reserved", arrays.reserved);
  const Vector<Bezier> curves = curves_of(arrays);
  PatchSet set{{curves.begin(), curves.end()}, {}};
  const PatchReader reader(arrays, curves);
  Vector<bool> is_used(curves.size());
  for (std::int64_t i = 0; i < arrays.n_patches; ++i) {
    set.patches.push_back(reader.read(i));
    const Patch &patch = set.patches.back();
    for (const Side &side : {patch.v0, patch.v1, patch.u0, patch.u1}) is_used[side.curve] = true;
  }
  const auto unused = std::find(is_used.begin(), is_used.end(), false);
  if (unused != is_used.end())
    fail(RIIS_INVALID_PARAMETER, "curve ", unused - is_used.begin(), " is a side of no patch");
  return set;
}

namespace {

ValveKind make_kind() {
  ValveKind kind{
      "patches",
      {opening_spec("from 0 (this state) to 1 (the open state); it must be 0 without riis_valve_set_open_state", 0)},
      0,
      false,
      nullptr,
      make_patches,
      check_states};
  for (const char *name : {"annulus", "stj", "effective_height"})
    kind.absent.push_back({name, "the control points of its curves determine its size"});
  return kind;
}

}  // namespace

const ValveKind &patches_valve_kind() {
  static const ValveKind &kind = *new ValveKind(with_skirt(make_kind(), SkirtAxis::boundary));
  return kind;
}

PatchArrays arrays_of(const PatchSet &set) {
  const PatchSet whole = without_images(set);
  PatchArrays made;
  made.first_span.push_back(0);
  for (const Curve &curve : whole.curves) {
    for (const Bezier &span : curve.spans()) {
      made.degree.push_back(span.degree);
      for (int i = 0; i <= span.degree; ++i) {
        const Vec3 q = view(span.control)[i];
        made.control.insert(made.control.end(), {q.x, q.y, q.z});
      }
    }
    made.first_span.push_back(view(made.degree).size());
  }
  for (const Patch &patch : whole.patches) {
    const PatchImage &image = patch.images.front();
    const bool is_exchanged = points_upstream(image);
    Side sides[4] = {patch.v0, patch.v1, patch.u0, patch.u1};
    std::int32_t attached = patch.attached == AttachedSide::v0 ? 0 : patch.attached == AttachedSide::u1 ? 3 : -1;
    if (is_exchanged) {
      std::swap(sides[2], sides[3]);
      sides[0].reversed = !sides[0].reversed;
      sides[1].reversed = !sides[1].reversed;
      if (attached == 3) attached = 2;
    }
    for (const Side &side : sides) {
      made.curve_id.push_back(static_cast<std::int32_t>(side.curve));
      made.reversed.push_back(side.reversed ? 1 : 0);
    }
    made.leaflet_id.push_back(image.leaflet_id);
    made.patch_id.push_back(image.patch_id);
    made.attached.push_back(attached);
    made.bulge.push_back(is_exchanged ? -patch.bulge : patch.bulge);
  }
  return made;
}

riis_valve_patches view_of(const PatchArrays &arrays) {
  const auto n_patches = view(arrays.leaflet_id).size();
  return {view(arrays.first_span).size() - 1,
          view(arrays.degree).size(),
          arrays.first_span.data(),
          arrays.degree.data(),
          arrays.control.data(),
          n_patches,
          arrays.curve_id.data(),
          arrays.reversed.data(),
          arrays.leaflet_id.data(),
          arrays.patch_id.data(),
          arrays.attached.data(),
          arrays.bulge.data()};
}

}  // namespace riis
