// SPDX-License-Identifier: Apache-2.0
#include "smooth_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "api/handles.hpp"
#include "valve/patches.hpp"

using namespace riis;

namespace {

// A curve whose parameter is the fraction of its length. Five-point Gauss quadrature computes the length up to 64 points of each
// span.
class MeasuredCurve {
 public:
  explicit MeasuredCurve(const Curve &curve) : spans_(curve.spans().begin(), curve.spans().end()) {
    for (const Bezier &span : spans_)
      for (int k = 0; k < n_cells; ++k) ends_.push_back((ends_.empty() ? 0 : ends_.back()) + length_of(span, k));
  }

  // Returns the point, and the unit vector along the curve.
  std::array<Vec3, 2> at(double share) const {
    const double total = ends_.back();
    if (!(total > 0)) return {spans_[0].control[0], Vec3{0, 0, 0}};
    const double behind = share * total;
    const auto cell = std::min<std::size_t>(
        static_cast<std::size_t>(std::lower_bound(ends_.begin(), ends_.end(), behind) - ends_.begin()),
        ends_.size() - 1);
    const Bezier &span = spans_[cell / n_cells];
    const double t0 = static_cast<double>(cell % n_cells) / n_cells, rest = behind - (cell == 0 ? 0 : ends_[cell - 1]);
    double t = t0 + rest / (ends_[cell] - (cell == 0 ? 0 : ends_[cell - 1])) / n_cells;
    for (int i = 0; i < 20; ++i) {
      const double off = part(span, t0, t) - rest, speed = length(tangent(span, t));
      if (!(speed > 0) || std::abs(off) < 1e-15 * total) break;
      t = std::clamp(t - off / speed, t0, t0 + 1.0 / n_cells);
    }
    const Vec3 along = tangent(span, t);
    return {point(span, t), length(along) > 0 ? (1 / length(along)) * along : along};
  }

 private:
  static constexpr int n_cells = 64;

  static Vec3 point(const Bezier &b, double t) {
    const double s = 1 - t;
    if (b.degree == 2) return s * s * b.control[0] + 2 * s * t * b.control[1] + t * t * b.control[2];
    return s * s * s * b.control[0] + 3 * s * s * t * b.control[1] + 3 * s * t * t * b.control[2] +
           t * t * t * b.control[3];
  }
  static Vec3 tangent(const Bezier &b, double t) {
    const double s = 1 - t;
    const auto d = [&](std::size_t i) { return b.control[i + 1] - b.control[i]; };
    if (b.degree == 2) return 2 * (s * d(0) + t * d(1));
    return 3 * (s * s * d(0) + 2 * s * t * d(1) + t * t * d(2));
  }
  static double part(const Bezier &b, double from, double to) {
    static const double x[5] = {0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640, -0.9061798459386640};
    static const double w[5] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                                0.2369268850561891};
    double sum = 0;
    for (int i = 0; i < 5; ++i) sum += w[i] * length(tangent(b, 0.5 * (from + to) + 0.5 * (to - from) * x[i]));
    return 0.5 * (to - from) * sum;
  }
  static double length_of(const Bezier &b, int cell) {
    return part(b, static_cast<double>(cell) / n_cells, static_cast<double>(cell + 1) / n_cells);
  }

  std::vector<Bezier> spans_;
  std::vector<double> ends_;
};

// A state of the valve, evaluated from the formulas of docs/theory.
class State {
 public:
  explicit State(PatchSet set) : set_(std::move(set)) {
    for (const Curve &curve : set_.curves) curves_.emplace_back(curve);
  }

  const PatchSet &set() const { return set_; }

  Vec3 at(const Patch &patch, const PatchImage &image, double u, double v) const {
    const auto on = [&](const Side &side, double t) { return curves_[side.curve].at(side.reversed ? 1 - t : t); };
    const Vec3 a = on(patch.v0, u)[0], l = on(patch.v1, u)[0];
    if (patch.bulge != 0) {
      Vec3 along = on(patch.v0, u)[1];
      if (patch.v0.reversed) along = -along;
      Vec3 offset = arc_offset(l - a, along, patch.bulge);
      if (u == 0) offset = arc_offset(set_, patch.u0);
      if (u == 1) offset = arc_offset(set_, patch.u1);
      return place(image, (1 - v) * a + v * l + 2 * v * (1 - v) * offset);
    }
    const Vec3 b = on(patch.u0, v)[0], r = on(patch.u1, v)[0];
    const Vec3 p00 = on(patch.v0, 0)[0], p10 = on(patch.v0, 1)[0], p01 = on(patch.v1, 0)[0], p11 = on(patch.v1, 1)[0];
    return place(image, (1 - v) * a + v * l + (1 - u) * b + u * r - (1 - u) * (1 - v) * p00 - u * (1 - v) * p10 -
                            (1 - u) * v * p01 - u * v * p11);
  }

 private:
  PatchSet set_;
  std::vector<MeasuredCurve> curves_;
};

}  // namespace

struct smooth_motion {
  State now, before;
  double seconds;

  struct Where {
    std::size_t patch, image;
  };
  Where where(int patch_id) const {
    for (std::size_t i = 0; i < now.set().patches.size(); ++i)
      for (std::size_t k = 0; k < now.set().patches[i].images.size(); ++k)
        if (now.set().patches[i].images[k].patch_id == patch_id) return {i, k};
    return {0, 0};
  }
  Vec3 point(const State &state, const Where &of, double u, double v) const {
    const Patch &patch = state.set().patches[of.patch];
    return state.at(patch, patch.images[of.image], u, v);
  }
  Vec3 velocity(const Where &of, double u, double v) const {
    return (1 / seconds) * (point(now, of, u, v) - point(before, of, u, v));
  }
};

smooth_motion *smooth_motion_create(const riis_valve *now, const riis_valve *before, double seconds) {
  return new smooth_motion{State(now->valve.make_patches()), State(before->valve.make_patches()), seconds};
}

void smooth_motion_destroy(smooth_motion *motion) { delete motion; }

void smooth_motion_places(const smooth_motion *motion, int patch_id, const double *uv, double *now, double *before) {
  const auto of = motion->where(patch_id);
  put_vector(now, 0, motion->point(motion->now, of, uv[0], uv[1]));
  put_vector(before, 0, motion->point(motion->before, of, uv[0], uv[1]));
}

double smooth_motion_nearest(const smooth_motion *motion, int patch_id, const double *uv, const double *point,
                             double *velocity) {
  const auto of = motion->where(patch_id);
  const Vec3 p{point[0], point[1], point[2]};
  double u = uv[0], v = uv[1];
  Vec3 at = motion->point(motion->now, of, u, v);
  double best = distance(at, p);
  constexpr double h = 1e-5;
  for (int i = 0; i < 12; ++i) {
    const double hu = u < 0.5 ? h : -h, hv = v < 0.5 ? h : -h;
    const Vec3 su = (1 / hu) * (motion->point(motion->now, of, u + hu, v) - at);
    const Vec3 sv = (1 / hv) * (motion->point(motion->now, of, u, v + hv) - at);
    const Vec3 r = p - at;
    const double a = dot(su, su), b = dot(su, sv), c = dot(sv, sv), d = dot(su, r), e = dot(sv, r), det = a * c - b * b;
    double du = 0, dv = 0;
    if (det > 1e-9 * a * c)
      du = (c * d - b * e) / det, dv = (a * e - b * d) / det;
    else if (c > a)
      dv = e / c;
    else if (a > 0)
      du = d / a;
    bool is_nearer = false;
    for (double share = 1; share > 1e-3 && !is_nearer; share *= 0.5) {
      const double nu = std::clamp(u + share * du, 0.0, 1.0), nv = std::clamp(v + share * dv, 0.0, 1.0);
      const Vec3 next = motion->point(motion->now, of, nu, nv);
      if (distance(next, p) < best * (1 - 1e-9)) {
        is_nearer = true;
        best = distance(next, p), at = next, u = nu, v = nv;
      }
    }
    if (!is_nearer) break;
  }
  put_vector(velocity, 0, motion->velocity(of, u, v));
  return best;
}
