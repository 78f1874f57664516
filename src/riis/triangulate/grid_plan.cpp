// SPDX-License-Identifier: Apache-2.0
#include "triangulate/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "geometry/curve.hpp"
#include "motion/displacement.hpp"
#include "parallel/parallel_for.hpp"
#include "triangulate/grids.hpp"

namespace riis {
namespace {

// The parts of a curve may be halved at most `max_rounds` times. With more halvings, there would be more triangles than the
// library accepts.
constexpr int max_rounds = 24;

// To bound the offset O (geometry/bulge.hpp), the space between two lines is divided into at most this many parts.
constexpr int most_parts = 8;

// The errors of a patch of arcs between two lines of its grid.
struct ColumnErrors {
  double base, edge;  // errors of the chords of both curves
  double off_line;    // the largest deviation of O from a linear function, at the points between the lines
  double second;      // a bound on |O''|
  double largest, width;
  // Bounds the deviation of O from a linear function. O is evaluated at the ends of n parts.
  double offset(int n) const {
    const double step = width / n;
    return std::min(largest, off_line + 0.125 * step * step * second);
  }
};

// The lines of a plan on a patch of arcs, or on a skirt that continues this patch.
class PlannedArcs {
 public:
  PlannedArcs(const PatchSet &set, const Patch &patch, const PatchPlan &plan, double max_error)
      : set_(set),
        patch_(patch),
        max_error_(max_error),
        is_strip_(patch.skirt_of_arcs != no_patch),
        lines_(moved_with_joints(plan.u, plan.joints, joints_of(set, is_strip_ ? patch.v1 : patch.v0))),
        shares_(shares_for(plan.n_parts)),
        base_(set.curve_of(patch.v0), patch.v0.reversed, shares_),
        edge_(set.curve_of(patch.v1), patch.v1.reversed, shares_) {
    offsets_.reserve(shares_.size());
    if (is_strip_) offsets_.assign(shares_.size(), Vec3{0, 0, 0});
    for (std::size_t i = 0; i < shares_.size() && !is_strip_; ++i)
      offsets_.push_back(arc_offset(edge_.point(i) - base_.point(i), base_.tangent(i), patch.bulge));
  }

  Vector<ColumnErrors> errors() {
    Vector<ColumnErrors> made;
    made.reserve(at_.size());
    for (std::size_t i = 0; i + 1 < at_.size(); ++i) made.push_back(column(at_[i], at_[i + 1]));
    return made;
  }

  Polyline base_polyline(const Vector<ColumnErrors> &errors) const {
    return polyline(base_, set_.curve_of(patch_.v0), errors, &ColumnErrors::base);
  }
  Polyline edge_polyline(const Vector<ColumnErrors> &errors) const {
    return polyline(edge_, set_.curve_of(patch_.v1), errors, &ColumnErrors::edge);
  }

  // The offsets at both ends are taken from the sides, so that neighbouring patches have the same bits there.
  ArcLines arc_lines(const Vector<ColumnErrors> &errors, const Vector<int> &n_parts) const {
    ArcLines made;
    made.u_lines.reserve(lines_.size());
    made.offsets.reserve(lines_.size());
    made.errors.reserve(errors.size());
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      made.u_lines.push_back({lines_[i], lines_[i], lines_[i], true, true});
      made.offsets.push_back(offsets_[at_[i]]);
    }
    if (!is_strip_)
      made.offsets.front() = arc_offset(set_, patch_.u0), made.offsets.back() = arc_offset(set_, patch_.u1);
    for (std::size_t i = 0; i < errors.size(); ++i) made.errors.push_back(errors[i].offset(n_parts[i]));
    return made;
  }

 private:
  // Returns the shares of the lines and of the points between them. Stores the positions of the lines in at_.
  Vector<double> shares_for(const Vector<int> &n_parts) {
    Vector<double> shares;
    at_.reserve(lines_.size());
    shares.reserve(static_cast<std::size_t>(std::accumulate(n_parts.begin(), n_parts.end(), 1)));
    for (std::size_t i = 0; i + 1 < lines_.size(); ++i) {
      at_.push_back(shares.size());
      for (int k = 0; k < n_parts[i]; ++k)
        shares.push_back(lines_[i] + static_cast<double>(k) / n_parts[i] * (lines_[i + 1] - lines_[i]));
    }
    at_.push_back(shares.size());
    shares.push_back(1);
    return shares;
  }

  ColumnErrors column(std::size_t i, std::size_t j) {
    const double enough = arc_curve_share * max_error_;
    ColumnErrors made{base_.chord_error(i, j, enough), edge_.chord_error(i, j, enough), 0, 0, 0,
                      shares_[j] - shares_[i]};
    if (is_strip_) return made;
    const Vector<Bezier> &on_base = base_.between(i, j), &on_edge = edge_.between(i, j);
    const Curve &base = set_.curve_of(patch_.v0), &edge = set_.curve_of(patch_.v1);
    if (on_base.size() > 1 || on_edge.size() > 1) {
      // bound_offset is not valid if O' jumps. If O' may jump inside the range, Bulge::linear_error gives the bound instead.
      const Bulge bulge(along(set_, patch_.v0), along(set_, patch_.v1), patch_.bulge);
      made.off_line = made.largest =
          bulge.linear_error(bulge.place(shares_[i]), bulge.place(shares_[j]), offset_share * max_error_);
      return made;
    }
    const OffsetBounds bounds =
        bound_offset({on_base, on_edge, base.length(), edge.length(), made.width}, patch_.bulge);
    made.second = bounds.second, made.largest = bounds.largest;
    for (std::size_t k = i + 1; k < j; ++k) {
      const double share = static_cast<double>(k - i) / static_cast<double>(j - i);
      made.off_line = std::max(made.off_line, distance(offsets_[k], mix(offsets_[i], offsets_[j], share)));
    }
    return made;
  }

  Polyline polyline(const CurvePoints &points, const Curve &curve, const Vector<ColumnErrors> &errors,
                    double ColumnErrors::*error) const {
    Polyline made{{}, lines_, {}, curve.length()};
    made.points.reserve(at_.size());
    made.errors.reserve(errors.size());
    for (const std::size_t at : at_) made.points.push_back(points.point(at));
    for (const ColumnErrors &column : errors) made.errors.push_back(column.*error);
    return made;
  }

  const PatchSet &set_;
  const Patch &patch_;
  double max_error_;
  bool is_strip_;  // a skirt, whose side v1 is the base of the patch of arcs
  Vector<double> lines_;
  Vector<std::size_t> at_;
  Vector<double> shares_;
  CurvePoints base_, edge_;
  Vector<Vec3> offsets_;
};

// Returns a polyline that replaces a curve, with its vertices at the given shares.
Polyline polyline_at(const Curve &curve, const Vector<double> &shares, double enough) {
  CurvePoints points(curve, false, shares);
  Polyline made{{}, shares, {}, curve.length()};
  made.points.reserve(shares.size());
  made.errors.reserve(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    made.points.push_back(points.point(i));
    if (i > 0) made.errors.push_back(points.chord_error(i - 1, i, enough));
  }
  return made;
}

// Ascending positions, and a number `need` for each step between two neighbouring positions. For a segment inside the step, the
// square of its width times `need` bounds its error, as a share of the allowed error.
struct Needs {
  Vector<double> at, need;
};

// Chooses as few positions as possible, among them the first and the last. The error of each segment is at most the share `most`
// of the allowed error.
Vector<double> segments(const Needs &needs, double most) {
  Vector<double> made{needs.at.front()};
  for (std::size_t i = 0; i < needs.need.size();) {
    const double from = needs.at[i];
    double largest = needs.need[i];
    for (++i; i < needs.need.size(); ++i) {
      const double width = needs.at[i + 1] - from;
      largest = std::max(largest, needs.need[i]);
      if (!(width * width * largest <= most)) break;
    }
    made.push_back(needs.at[i]);
  }
  return made;
}

// Chooses as many positions as segments() does, but such that the errors of the segments are as equal as possible.
Vector<double> balanced_segments(const Needs &needs, double most) {
  Vector<double> made = segments(needs, most);
  double low = 0, high = most;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    Vector<double> tried = segments(needs, middle);
    const bool is_enough = tried.size() <= made.size();
    (is_enough ? high : low) = middle;
    if (is_enough) made = std::move(tried);
  }
  return made;
}

// The needs are computed on narrow steps. The bound for a wide segment is slightly larger than these needs predict. The lines are
// therefore chosen for only the share `most_of_allowed` of the allowed error.
constexpr double most_of_allowed = 0.9;
// The number of steps for the needs is `steps_per_segment` times the largest number of segments of a curve, but is kept between
// `least_steps` and `most_steps`.
constexpr int steps_per_segment = 4;
constexpr std::size_t least_steps = 64, most_steps = 4096;
// To save time, the needs are computed only at every `states_per_need`-th opening. The chosen lines are then checked at every
// opening.
constexpr std::size_t states_per_need = 4;

// Halves the steps between neighbouring values that are too large. `is_too_large` has an entry for each step.
Vector<double> halved(const Vector<double> &values, const Vector<bool> &is_too_large) {
  Vector<double> made;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    made.push_back(values[i]);
    if (is_too_large[i]) made.push_back(0.5 * (values[i] + values[i + 1]));
  }
  made.push_back(values.back());
  return made;
}

[[noreturn]] void fail_for(const Patch &patch, double max_error) {
  fail(RIIS_INVALID_PARAMETER, "no fixed triangulation of patch ", patch.images.front().patch_id, " is accurate to ",
       max_error, ", which is tolerance * half_thickness before scaling, at every opening");
}

class Planner {
 public:
  Planner(const Vector<PatchSet> &states, double max_error, double of_curves, const Vector<double> &tightness)
      : states_(states), set_(states.front()), max_error_(max_error), of_curves_(of_curves), tightness_(tightness) {}

  GridPlan plan() {
    for (const PatchSet &state : states_) check_precision(state, max_error_);
    plan_.shares.resize(set_.curves.size());
    plan_.patches.resize(set_.patches.size());
    for (std::size_t i = 0; i < set_.patches.size(); ++i)
      plan_.patches[i].has_arcs =
          std::any_of(states_.begin(), states_.end(), [&](const PatchSet &set) { return set.patches[i].bulge != 0; });
    // A skirt at a patch of arcs takes the patch's lines, so that both have the same vertices along their common side.
    for (std::size_t i = 0; i < set_.patches.size(); ++i)
      if (patch_of_strip(i) != no_patch) plan_.patches[i].has_arcs = plan_.patches[patch_of_strip(i)].has_arcs;
    plan_families();
    for (std::size_t i = 0; i < set_.patches.size(); ++i) {
      if (!plan_.patches[i].has_arcs)
        plan_sides(set_.patches[i]);
      else if (patch_of_strip(i) == no_patch)
        plan_arcs(i);
    }
    for (std::size_t i = 0; i < set_.patches.size(); ++i)
      if (plan_.patches[i].has_arcs && patch_of_strip(i) != no_patch)
        plan_.patches[i] = plan_.patches[patch_of_strip(i)];
    for (std::size_t i = 0; i < set_.patches.size(); ++i) count(i);
    return std::move(plan_);
  }

 private:
  double tightness(const Side &side) const { return tightness_[side.curve]; }

  std::size_t patch_of_strip(std::size_t patch) const { return set_.patches[patch].skirt_of_arcs; }
  Vector<std::size_t> strips_of(std::size_t patch) const {
    Vector<std::size_t> strips;
    for (std::size_t i = 0; i < set_.patches.size(); ++i)
      if (patch_of_strip(i) == patch) strips.push_back(i);
    return strips;
  }

  // Gives the four curves of a Coons patch their vertices, and gives the patch its lines.
  void plan_sides(const Patch &patch) {
    for (const Side &side : {patch.v0, patch.v1, patch.u0, patch.u1})
      if (plan_.shares[side.curve].empty()) plan_.shares[side.curve] = vertices(patch, side);
    PatchPlan &plan = plan_.patches[static_cast<std::size_t>(&patch - set_.patches.data())];
    plan.lines = {lines(patch.v0, patch.v1), lines(patch.u0, patch.u1)};
  }

  // The curves at opposite sides of a Coons patch belong to one family. A family thus runs through a row of neighbouring patches.
  // The patches have few lines if the curves of a family have the same vertices. Each curve runs in the direction of the first
  // curve of its family, or against it.
  struct Family {
    Vector<std::size_t> curves;
    Vector<bool> runs_against;
  };

  Vector<Family> families() const {
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    struct Opposite {
      std::size_t curve;
      bool runs_against;
    };
    Vector<Vector<Opposite>> opposites(set_.curves.size());
    Vector<bool> is_side(set_.curves.size(), false);
    for (std::size_t i = 0; i < set_.patches.size(); ++i) {
      if (plan_.patches[i].has_arcs) continue;
      const Patch &patch = set_.patches[i];
      const auto join = [&](const Side &a, const Side &b) {
        is_side[a.curve] = is_side[b.curve] = true;
        if (is_collapsed(a) || is_collapsed(b)) return;
        opposites[a.curve].push_back({b.curve, a.reversed != b.reversed});
        opposites[b.curve].push_back({a.curve, a.reversed != b.reversed});
      };
      join(patch.v0, patch.v1);
      join(patch.u0, patch.u1);
    }
    Vector<Family> made;
    Vector<std::size_t> family_of(set_.curves.size(), none);
    for (std::size_t first = 0; first < set_.curves.size(); ++first) {
      if (!is_side[first] || family_of[first] != none) continue;
      family_of[first] = made.size();
      Family family{{first}, {false}};
      for (std::size_t k = 0; k < family.curves.size(); ++k)
        for (const Opposite &opposite : opposites[family.curves[k]])
          if (family_of[opposite.curve] == none) {
            family_of[opposite.curve] = made.size();
            family.runs_against.push_back(family.runs_against[k] != opposite.runs_against);
            family.curves.push_back(opposite.curve);
          }
      made.push_back(std::move(family));
    }
    return made;
  }

  bool is_collapsed(const Side &side) const {
    return std::none_of(states_.begin(), states_.end(),
                        [&](const PatchSet &set) { return set.curve_of(side).length() > 0; });
  }

  static Vector<double> turned(Vector<double> shares) {
    std::reverse(shares.begin(), shares.end());
    for (double &share : shares) share = 1 - share;
    return shares;
  }

  // Each curve first gets the lines that its family needs. Later, the function `vertices` adds lines where a curve has too few.
  void plan_families() {
    first_shares_.assign(set_.curves.size(), {0, 1});
    for (const Family &family : families()) {
      Vector<Needs> needs;
      std::size_t n_steps = least_steps;
      for (const std::size_t curve : family.curves)
        n_steps = std::max(n_steps, steps_per_segment * rough_number_of_segments(curve));
      if (n_steps > most_steps) continue;  // for such a small tolerance, all parts of the curves are halved instead
      while ((n_steps & (n_steps - 1)) != 0) n_steps += n_steps & -n_steps;
      for (std::size_t k = 0; k < family.curves.size(); ++k)
        needs.push_back(needs_of(family.curves[k], family.runs_against[k], n_steps));
      Needs all = needs.front();
      for (const Needs &of_curve : needs)
        for (std::size_t i = 0; i < n_steps; ++i) all.need[i] = std::max(all.need[i], of_curve.need[i]);
      const Vector<double> lines = balanced_segments(all, most_of_allowed);
      for (std::size_t k = 0; k < family.curves.size(); ++k) {
        Vector<double> own = segments(between_lines(needs[k], lines), most_of_allowed);
        first_shares_[family.curves[k]] = family.runs_against[k] ? turned(std::move(own)) : std::move(own);
      }
    }
  }

  // Returns how many segments a curve needs if it is bent everywhere as much as its control points allow.
  std::size_t rough_number_of_segments(std::size_t curve) const {
    double most = 1;
    for (std::size_t i = 0; i < states_.size(); i += states_per_need) {
      const Curve &here = states_[i].curves[curve];
      double bend = 0;
      for (const Bezier &span : here.spans()) bend = std::max(bend, flatness(span));
      const double of_state = static_cast<double>(here.spans().size()) * std::sqrt(bend / allowed(curve));
      most = std::max(most, of_state < 1e6 ? of_state : 1e6);
    }
    return static_cast<std::size_t>(std::ceil(most));
  }

  double allowed(std::size_t curve) const { return of_curves_ * max_error_ * tightness_[curve]; }

  // Finds the needs of a curve. Shares are counted along the first curve of the family.
  Needs needs_of(std::size_t curve, bool runs_against, std::size_t n_steps) const {
    Needs made;
    for (std::size_t i = 0; i <= n_steps; ++i) made.at.push_back(static_cast<double>(i) / static_cast<double>(n_steps));
    made.need.assign(n_steps, 0);
    for (std::size_t i = 0; i < states_.size(); i += states_per_need) {
      CurvePoints points(states_[i].curves[curve], runs_against, made.at);
      for (std::size_t k = 0; k < n_steps; ++k) {
        const double width = made.at[k + 1] - made.at[k];
        made.need[k] = std::max(made.need[k], points.chord_error(k, k + 1, 0) / (width * width * allowed(curve)));
      }
    }
    return made;
  }

  // Returns the needs for the wider steps between `lines`.
  static Needs between_lines(const Needs &needs, const Vector<double> &lines) {
    Needs made{lines, Vector<double>(lines.size() - 1, 0)};
    std::size_t step = 0;
    for (std::size_t k = 0; k < needs.need.size(); ++k) {
      while (needs.at[k] >= lines[step + 1]) ++step;
      made.need[step] = std::max(made.need[step], needs.need[k]);
    }
    return made;
  }

  Vector<double> vertices(const Patch &patch, const Side &side) const {
    const double enough = allowed(side.curve);
    Vector<double> shares = first_shares_[side.curve];
    for (int round = 0;; ++round) {
      Vector<bool> is_too_large(shares.size() - 1, false);
      for (const PatchSet &state : states_) {
        const Polyline polyline = polyline_at(state.curve_of(side), shares, enough);
        for (std::size_t i = 0; i < polyline.errors.size(); ++i)
          if (!(polyline.errors[i] <= enough)) is_too_large[i] = true;
      }
      if (std::find(is_too_large.begin(), is_too_large.end(), true) == is_too_large.end()) return shares;
      if (round == max_rounds) fail_for(patch, max_error_);
      shares = halved(shares, is_too_large);
      check_count(static_cast<double>(shares.size()), max_error_);
    }
  }

  // Returns the shares of the lines along a side, in the patch's parameter. A side that is collapsed at all openings has lines
  // only at its ends.
  Vector<double> shares_along(const Side &side) const {
    if (is_collapsed(side)) return {0, 1};
    const Vector<double> &shares = plan_.shares[side.curve];
    return side.reversed ? turned(shares) : shares;
  }

  // Merges the lines of two sides. All shares are binary fractions, so two shares are either equal to the last bit or far apart.
  Vector<GridLine> lines(const Side &a, const Side &b) const {
    const Vector<double> on_a = shares_along(a), on_b = shares_along(b);
    Vector<double> both;
    std::set_union(on_a.begin(), on_a.end(), on_b.begin(), on_b.end(), std::back_inserter(both));
    Vector<GridLine> made;
    const auto has = [](const Vector<double> &shares, double t) {
      return std::binary_search(shares.begin(), shares.end(), t);
    };
    for (const double t : both) made.push_back({t, t, t, has(on_a, t), has(on_b, t)});
    return made;
  }

  // Returns the joints at the first opening. The lines move with these joints. The result is empty if the number of joints of the
  // base changes with the opening, or if a joint is near an end.
  Vector<double> joints(std::size_t patch) const {
    constexpr double near_end = 0.01;
    const Vector<double> first = joints_of(set_, set_.patches[patch].v0);
    for (const PatchSet &state : states_) {
      const Vector<double> here = joints_of(state, state.patches[patch].v0);
      if (here.size() != first.size() || joints_of(state, state.patches[patch].v1).size() != 0) return {};
      if (!here.empty() && (here.front() < near_end || here.back() > 1 - near_end)) return {};
    }
    return first;
  }

  // Adds lines until base, edge and O are nearly linear between the lines at every opening. Then chooses, for O, the smallest
  // number of parts that suffices.
  void plan_arcs(std::size_t patch) {
    PatchPlan &plan = plan_.patches[patch];
    plan.joints = joints(patch);
    plan.u = first_arc_lines(patch, plan.joints);
    for (int round = 0;; ++round) {
      const Vector<int> wanted = parts_wanted(patch, plan);
      Vector<bool> is_too_large;
      for (const int n : wanted) is_too_large.push_back(n > most_parts);
      if (std::find(is_too_large.begin(), is_too_large.end(), true) == is_too_large.end()) {
        plan.n_parts = wanted;
        break;
      }
      if (round == max_rounds) fail_for(set_.patches[patch], max_error_);
      plan.u = halved(plan.u, is_too_large);
      check_count(static_cast<double>(plan.u.size()), max_error_);
    }
    double offset = 0;
    for (const PatchSet &state : states_) {
      PlannedArcs arcs(state, state.patches[patch], plan, max_error_);
      offset = std::max(offset, arcs.arc_lines({}, {}).largest_offset());
    }
    plan_.n_rows = std::max(plan_.n_rows, static_cast<std::size_t>(rows_for(offset, max_error_)));
  }

  // Returns a first choice of few lines, which usually suffices. Among these lines are lines at the joints.
  Vector<double> first_arc_lines(std::size_t patch, const Vector<double> &joints) const {
    const Patch &first = set_.patches[patch];
    Vector<double> ends{0};
    ends.insert(ends.end(), joints.begin(), joints.end());
    ends.push_back(1);
    const std::size_t n_steps =
        std::max(least_steps, steps_per_segment * std::max(rough_number_of_segments(first.v0.curve),
                                                           rough_number_of_segments(first.v1.curve)));
    if (n_steps > most_steps) return ends;
    PatchPlan fine;
    fine.joints = joints;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      for (std::size_t k = 0; k < n_steps; ++k)
        fine.u.push_back(ends[i] + static_cast<double>(k) / static_cast<double>(n_steps) * (ends[i + 1] - ends[i]));
    fine.u.push_back(1);
    fine.n_parts.assign(fine.u.size() - 1, 1);
    Vector<double> need(fine.n_parts.size(), 0);
    const double of_curves = of_arc_curves(first), of_offset = offset_share * max_error_;
    for (std::size_t s = 0; s < states_.size(); s += states_per_need) {
      const Vector<ColumnErrors> errors = PlannedArcs(states_[s], states_[s].patches[patch], fine, max_error_).errors();
      for (std::size_t k = 0; k < need.size(); ++k) {
        const double width = fine.u[k + 1] - fine.u[k];
        const double of_allowed =
            std::max(std::max(errors[k].base, errors[k].edge) / of_curves, errors[k].offset(1) / of_offset);
        need[k] = std::max(need[k], of_allowed / (width * width));
      }
    }
    Vector<double> lines{0};
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const auto from = static_cast<std::ptrdiff_t>(i * n_steps), to = from + static_cast<std::ptrdiff_t>(n_steps);
      const Needs between{{fine.u.begin() + from, fine.u.begin() + to + 1}, {need.begin() + from, need.begin() + to}};
      const Vector<double> chosen = balanced_segments(between, most_of_allowed);
      lines.insert(lines.end(), chosen.begin() + 1, chosen.end());
    }
    return lines;
  }

  double of_arc_curves(const Patch &patch) const {
    return (arc_curve_share + merge_share) * max_error_ * std::min(tightness(patch.v0), tightness(patch.v1));
  }

  // For every pair of neighbouring lines, returns the least number of parts that suffices at all openings. If no number up to
  // most_parts suffices, the result is larger than most_parts.
  Vector<int> parts_wanted(std::size_t patch, PatchPlan &plan) const {
    const Patch &first = set_.patches[patch];
    const double of_curves = of_arc_curves(first);
    const double of_offset = offset_share * max_error_;
    plan.n_parts.assign(plan.u.size() - 1, most_parts);
    Vector<int> wanted(plan.u.size() - 1, 1);
    const Vector<std::size_t> strips = strips_of(patch);
    for (const PatchSet &state : states_) {
      Vector<ColumnErrors> errors = PlannedArcs(state, state.patches[patch], plan, max_error_).errors();
      for (const std::size_t strip : strips) {
        const Vector<ColumnErrors> beside = PlannedArcs(state, state.patches[strip], plan, max_error_).errors();
        for (std::size_t i = 0; i < errors.size(); ++i) errors[i].base = std::max(errors[i].base, beside[i].base);
      }
      for (std::size_t i = 0; i < errors.size(); ++i) {
        const bool are_chords_near = std::max(errors[i].base, errors[i].edge) <= of_curves;
        while (wanted[i] <= most_parts && !(are_chords_near && errors[i].offset(wanted[i]) <= of_offset))
          wanted[i] *= 2;
      }
    }
    return wanted;
  }

  void count(std::size_t patch) {
    const PatchPlan &plan = plan_.patches[patch];
    const std::size_t n_u = plan.has_arcs ? plan.u.size() : plan.lines.u.size();
    const bool is_strip = patch_of_strip(patch) != no_patch;
    const std::size_t n_v = !plan.has_arcs ? plan.lines.v.size() : is_strip ? 1 : plan_.n_rows;
    const auto n_images = static_cast<double>(set_.patches[patch].images.size());
    check_count(n_triangles_ += 2 * static_cast<double>(n_u) * static_cast<double>(n_v) * n_images, max_error_);
  }

  const Vector<PatchSet> &states_;
  const PatchSet &set_;
  double max_error_, of_curves_;
  const Vector<double> &tightness_;
  Vector<Vector<double>> first_shares_;  // for each curve
  GridPlan plan_;
  double n_triangles_ = 0;
};

// Makes the grids of one opening on the plan's lines.
class PlannedGrids {
 public:
  PlannedGrids(const PatchSet &set, const GridPlan &plan, double max_error, int n_threads, bool keeps_lines)
      : set_(set), plan_(plan), max_error_(max_error), n_threads_(n_threads), keeps_lines_(keeps_lines) {}

  Vector<QuadGrid> make() {
    polylines_.resize(set_.curves.size());
    reversed_.resize(set_.curves.size());
    parallel_for(view(plan_.shares).size(), n_threads_, [&](std::int64_t i, int) {
      const Vector<double> &shares = view(plan_.shares)[i];
      if (shares.empty()) return;
      view(polylines_)[i] = polyline_at(view(set_.curves)[i], shares, curve_share * max_error_);
      view(reversed_)[i] = reversed(view(polylines_)[i]);
    });
    Vector<QuadGrid> grids(set_.patches.size());
    parallel_for(view(grids).size(), n_threads_, [&](std::int64_t i, int) {
      const auto patch = static_cast<std::size_t>(i);
      grids[patch] = plan_.patches[patch].has_arcs ? arcs(patch) : coons(patch);
    });
    return grids;
  }

 private:
  const Polyline *polyline(const Side &side) const {
    return side.reversed ? &reversed_[side.curve] : &polylines_[side.curve];
  }

  QuadGrid coons(std::size_t i) const {
    const Patch &patch = set_.patches[i];
    const PatchSides sides{polyline(patch.v0), polyline(patch.v1), polyline(patch.u0), polyline(patch.u1)};
    const GridLines &lines = plan_.patches[i].lines;
    QuadGrid made = make_quad_grid(sides, lines);
    if (keeps_lines_) made.lines = lines;
    return made;
  }

  QuadGrid arcs(std::size_t i) const {
    const PatchPlan &plan = plan_.patches[i];
    PlannedArcs planned(set_, set_.patches[i], plan, max_error_);
    const Vector<ColumnErrors> errors = planned.errors();
    const Polyline base = planned.base_polyline(errors), edge = planned.edge_polyline(errors);
    const PatchSides sides{&base, &edge, nullptr, nullptr};
    const ArcLines lines = planned.arc_lines(errors, plan.n_parts);
    // The strips of a skirt meet along straight lines, which have no vertices between their ends.
    const std::size_t n_rows = set_.patches[i].skirt_of_arcs == no_patch ? plan_.n_rows : 1;
    QuadGrid made = make_arc_grid(sides, lines, n_rows);
    if (!keeps_lines_) return made;
    made.lines = lines_of_arc_grid(lines, made);
    made.lines.move_with_joints = !plan.joints.empty();
    return made;
  }

  const PatchSet &set_;
  const GridPlan &plan_;
  double max_error_;
  int n_threads_;
  bool keeps_lines_;
  Vector<Polyline> polylines_, reversed_;
};

}  // namespace

CurveNumbering::CurveNumbering(const PatchSet &set) : patches_(set.patches), n_curves_(set.curves.size()) {}

bool CurveNumbering::is_of(const PatchSet &set) const {
  const auto are_equal = [](const Side &a, const Side &b) { return a.curve == b.curve && a.reversed == b.reversed; };
  return set.curves.size() == n_curves_ && std::equal(patches_.begin(), patches_.end(), set.patches.begin(),
                                                      set.patches.end(), [&](const Patch &a, const Patch &b) {
                                                        return are_equal(a.v0, b.v0) && are_equal(a.v1, b.v1) &&
                                                               are_equal(a.u0, b.u0) && are_equal(a.u1, b.u1);
                                                      });
}

PatchSet CurveNumbering::renumbered(const PatchSet &set) const {
  PatchSet made{Vector<Curve>(n_curves_, set.curves.front()), set.patches, set.seams, set.deviation};
  made.mapped_inside = set.mapped_inside;
  if (!set.material.empty()) made.material.resize(n_curves_);
  for (std::size_t i = 0; i < patches_.size(); ++i)
    for (const auto side : {&Patch::v0, &Patch::v1, &Patch::u0, &Patch::u1}) {
      const Side &from = set.patches[i].*side, &to = patches_[i].*side;
      const Curve &curve = set.curves[from.curve];
      const bool is_turned = from.reversed != to.reversed;
      made.curves[to.curve] = is_turned ? curve.reversed() : curve;
      made.patches[i].*side = to;
      if (set.material.empty() || !set.material[from.curve]) continue;
      const MaterialPoints &points = *set.material[from.curve];
      made.material[to.curve] = is_turned ? points.reversed(curve.spans().size()) : points;
    }
  return made;
}

GridPlan plan_grids(const Vector<PatchSet> &states, double max_error, double of_curves,
                    const Vector<double> &tightness) {
  return Planner(states, max_error, of_curves, tightness).plan();
}

Vector<QuadGrid> make_grids(const PatchSet &set, const GridPlan &plan, double max_error, int n_threads,
                            bool keeps_lines) {
  return PlannedGrids(set, plan, max_error, n_threads, keeps_lines).make();
}

}  // namespace riis
