// SPDX-License-Identifier: Apache-2.0
// The coapting valves. The two to four cusps of a coapting valve lie side by side in a coaptation zone. Their free edges keep
// their length while the valve opens (docs/theory/coapting.md).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "geometry/placement.hpp"
#include "valve/bumps.hpp"
#include "valve/coapting_half.hpp"
#include "valve/cusp.hpp"
#include "valve/cusp_numbers.hpp"
#include "valve/valve.hpp"

namespace riis {
namespace {

// The positions in the lists of specs below. After these parameters, the lists have those of all commissures, then of all cusps,
// then of the bumps.
// clang-format off
enum Parameter {
  root_radius, commissure_radius, commissure_height, effective_height, coaptation_height, gap, bottom_angle, belly, edge_rise,
  attachment_width, attachment_drop, open_radius_ratio, commissure_expansion, translation, opening, skirt_length, edge_stretch,
  n_of_valve
};
enum OfCommissure { height, fusion, n_of_commissure };
enum OfCusp { sector, own_effective_height, own_coaptation_height, own_open_radius_ratio, n_of_cusp };
// clang-format on

// Without sag, the open free edge must be shorter than `most_of_edge` times the closed free edge.
constexpr double most_of_edge = 0.998;
// While the valve opens, the height of the free edge above the root must stay at least `least_height` times root_radius.
constexpr double least_height = 0.05;
// Every set of values is checked for folds of the cusps at these openings. Folds occur only in the second half of the motion.
constexpr std::array<double, 4> openings_of_folds{0.6, 0.75, 0.9, 1};
// At the root, the leaflet must rise by at least `least_rise` times the rise of a leaflet without sag.
constexpr double least_rise = 0.05;
// If a cusp's rise, in the same unit, is less than `usual_rise`, its open edge leaves the commissures at a smaller slope. If the
// rise is at most usual_rise - rise_until_level, the edge leaves the commissures horizontally.
constexpr double usual_rise = 0.1, rise_until_level = 0.15;
// If a cusp would fold, its edge gets a smaller slope at the commissures. The height of this edge above the root must then stay
// at least `least_height_of_flat` times root_radius. In a lower leaflet, triangles would cross near the attachment.
constexpr double least_height_of_flat = 0.08;
// Fused commissures must leave an open orifice of at least `least_orifice` of the area inside the commissures.
constexpr double least_orifice = 0.06;
// The rates of the control points are computed as differences over the step `rate_step` of the opening. The rates only determine
// where vertices are dense.
constexpr double rate_step = 1e-4;

// The rules for sizes that the caller did not set.
using Rule = std::array<double, 3>;
Rule commissure_radius_rule(const ParameterValues &values) { return {values[root_radius][0]}; }
Rule commissure_height_rule(const ParameterValues &values) { return {1.4 * values[commissure_radius][0]}; }
// The line from the middle of a free edge to the commissure has a slope of 34 degrees, whose tangent is 0.6745.
Rule effective_height_rule(const ParameterValues &values) {
  const double h = values[commissure_height][0];
  return {std::max(h - 0.6745 * values[commissure_radius][0], 0.3 * h)};
}
// If the commissures are low, there is less room for the coaptation zone.
Rule coaptation_height_rule(const ParameterValues &values) {
  return {std::min(0.3 * values[commissure_radius][0], 0.6 * values[effective_height][0])};
}
Rule gap_rule(const ParameterValues &values) { return {0.016 * values[commissure_radius][0]}; }

template <std::size_t n_cusps>
void check_values(const ParameterValues &list);
template <std::size_t n_cusps>
PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening);

// Appends a parameter of one cusp or commissure. Until the caller sets the parameter, it has the value of the whole valve's
// parameter.
void add_own(Vector<ParameterSpec> &specs, const std::string &owner, const char *name, Parameter of_valve) {
  ParameterSpec own = specs[of_valve];
  own.rule = {of_valve == commissure_height ? "commissure_height" : name, nullptr, of_valve};
  own.name = owner + name;
  own.other = {nullptr, 0};
  specs.push_back(std::move(own));
}

// Lengths are in centimetres. docs/theory/coapting.md has the sources of the values.
// clang-format off
template <std::size_t n_cusps>
ValveKind make_kind(const char *name, double default_stretch) {
  constexpr double shortest = 1e-9, longest = 1e9;
  const char *length = "length", *degree = "degree", *number = "1";
  ValveKind kind = with_skirt({name, {
    {"root_radius", length, "radius of the root, where the cusps begin", 1, {1.25}, shortest, longest, {}, {"annulus", 2}},
    {"commissure_radius", length, "radius of the commissures", 1, {1.25}, shortest, longest,
     {"root_radius", commissure_radius_rule}, {"stj", 2}},
    {"commissure_height", length, "height of the commissures above the root", 1, {1.75}, shortest, longest,
     {"1.4 commissure_radius", commissure_height_rule}},
    {"effective_height", length, "height of the middle of the closed free edges above the root", 1, {1.75 - 0.6745 * 1.25},
     shortest, longest, {"commissure_height - 0.6745 commissure_radius, at least 0.3 commissure_height", effective_height_rule}},
    {"coaptation_height", length, "height of the coaptation zone in the middle of the closed valve", 1, {0.3 * 1.25}, shortest,
     longest, {"0.3 commissure_radius, at most 0.6 effective_height", coaptation_height_rule}},
    {"gap", length, "distance between closed cusps in the coaptation zone", 1, {0.016 * 1.25}, shortest, longest,
     {"0.016 commissure_radius", gap_rule}},
    {"bottom_angle", degree, "angle between the closed cusp and the plane of the root, at the root", 1, {20}, 0, 80},
    {"belly", number, "largest length of a closed cusp's tangent at the root, as a multiple of root_radius", 1, {0.5}, 0.05, 0.8},
    {"edge_rise", number, "height of the closed free edge's control point next to the commissure, as a share of the edge's rise",
     1, {0.3}, 0, 0.9},
    {"attachment_width", number, "length of the attachment's tangent at the root, as a multiple of root_radius",
     1, {0.6}, 0.1, 1.2},
    {"attachment_drop", number, "length of the attachment's tangent at a commissure, as a multiple of commissure_height",
     1, {0.5}, 0.1, 0.9},
    {"open_radius_ratio", number, "radius of the open free edge at the symmetry plane, as a multiple of commissure_radius",
     1, {0.85}, 0.3, 1.1},
    {"commissure_expansion", number, "how far the commissures move outwards during opening, as a multiple of commissure_radius",
     1, {0.05}, 0, 0.3},
    {"translation", length, "shift of the valve", 3, {0, 0, 0}, -longest, longest},
    opening_spec("from 0 (closed) to 1 (open)", 0),
  }, opening, true, check_values<n_cusps>, make_patches<n_cusps>, nullptr}, SkirtAxis::of_cusp);
  kind.has_exact_contacts = true;
  kind.is_seen_along_z = true;
  Vector<ParameterSpec> &specs = kind.parameters;
  specs.push_back({"edge_stretch", number, "how much longer the free edge is when open, as a share of its closed length", 1,
                   {default_stretch}, 0, 0.2});
  for (std::size_t k = 0; k < n_cusps; ++k) {
    const std::string owner = "commissure_" + std::to_string(k) + ".";
    add_own(specs, owner, "height", commissure_height);
    specs.push_back({owner + "fusion", number, "fused share of the line where the two cusps meet", 1, {0}, 0, 0.6});
  }
  for (std::size_t k = 0; k < n_cusps; ++k) {
    const std::string owner = "cusp_" + std::to_string(k) + ".";
    specs.push_back({owner + "sector", degree, "angle between the cusp's commissures; all sectors are scaled to a sum of 360", 1,
                     {360.0 / n_cusps}, 1, 360});
    add_own(specs, owner, "effective_height", effective_height);
    add_own(specs, owner, "coaptation_height", coaptation_height);
    add_own(specs, owner, "open_radius_ratio", open_radius_ratio);
  }
  if (n_cusps == 2)
    specs.push_back({"meeting_shift", number, "x of the point where closed cusps meet, as a multiple of commissure_radius",
                     1, {0}, -0.5, 0.5});
  add_bump_specs(specs, n_cusps, BumpLift::no);
  return kind;
}
// clang-format on

const ValveKind &kind_of(std::size_t n_cusps) {
  return n_cusps == 2 ? bicuspid_valve_kind() : n_cusps == 3 ? coapting_valve_kind() : quadricuspid_valve_kind();
}

// The parameters of a valve with this many cusps. Cusp k lies between the commissures k - 1 and k.
class ValveValues {
 public:
  ValveValues(const ParameterValues &values, std::size_t n_cusps)
      : values_(values),
        n_cusps_(n_cusps),
        bumps_(values, at_cusp(n_cusps, sector) + (n_cusps == 2 ? 1 : 0), n_cusps, BumpLift::no) {
    double sum = 0;
    for (std::size_t k = 0; k < n_cusps; ++k) sum += of_cusp(k, sector);
    for (std::size_t k = 0; k < n_cusps; ++k) sectors_.push_back(360 * of_cusp(k, sector) / sum);
  }

  static constexpr std::size_t at_commissure(std::size_t k, OfCommissure parameter) {
    return n_of_valve + k * n_of_commissure + parameter;
  }
  std::size_t at_cusp(std::size_t k, OfCusp parameter) const {
    return at_commissure(n_cusps_, height) + k * n_of_cusp + parameter;
  }

  std::size_t n_cusps() const { return n_cusps_; }
  double operator[](std::size_t parameter) const { return values_[parameter][0]; }
  double of_commissure(std::size_t k, OfCommissure parameter) const { return values_[at_commissure(k, parameter)][0]; }
  double of_cusp(std::size_t k, OfCusp parameter) const { return values_[at_cusp(k, parameter)][0]; }
  const Vector<double> &sectors() const { return sectors_; }
  double meeting_shift() const { return n_cusps_ == 2 ? values_[at_cusp(n_cusps_, sector)][0] : 0; }
  std::size_t before(std::size_t k) const { return (k + n_cusps_ - 1) % n_cusps_; }

  // Returns whether the cusps are images of one half, because all cusps and all commissures have the same sizes.
  bool has_equal_cusps() const {
    for (std::size_t k = 1; k < n_cusps_; ++k) {
      for (const OfCommissure parameter : {height, fusion})
        if (of_commissure(k, parameter) != of_commissure(0, parameter)) return false;
      for (const OfCusp parameter : {own_effective_height, own_coaptation_height, own_open_radius_ratio})
        if (of_cusp(k, parameter) != of_cusp(0, parameter)) return false;
      if (sectors_[k] != sectors_[0]) return false;
    }
    return meeting_shift() == 0;
  }
  bool has_equal_halves() const { return has_equal_cusps() && !bumps_.any(); }

  // Returns the sizes of cusp k, for both of its sides. With has_equal_halves, returns one side, whose images make all cusps.
  CuspSizes sizes(std::size_t k, bool has_equal_halves) const;

 private:
  CuspSizes::Side side(std::size_t k, bool is_first) const {
    const std::size_t commissure = is_first ? k : before(k);
    CuspSizes::Side made{of_commissure(commissure, height), of_commissure(commissure, fusion), {}};
    for (std::size_t i = 0; i < made.local.size(); ++i) {
      const double from_middle = (1 - made.fusion) * static_cast<double>(i) / 6;
      view(made.local)[i] = bumps_.at(k, is_first ? 0.5 + from_middle : 0.5 - from_middle);
    }
    // A fused edge ends beside the commissure and moves with the commissure.
    made.local.back() = bumps_.at(k, is_first ? 1 : 0);
    return made;
  }

  const ParameterValues &values_;
  std::size_t n_cusps_;
  Bumps bumps_;
  Vector<double> sectors_;
};

CuspSizes ValveValues::sizes(std::size_t k, bool has_equal_halves) const {
  const auto value = [&](Parameter parameter) { return (*this)[parameter]; };
  CuspSizes made{half_sector(sectors_[k]),
                 value(root_radius),
                 value(commissure_radius),
                 of_cusp(k, own_effective_height),
                 of_cusp(k, own_coaptation_height),
                 value(gap),
                 value(bottom_angle),
                 value(belly),
                 value(edge_rise),
                 value(attachment_width),
                 value(attachment_drop),
                 of_cusp(k, own_open_radius_ratio),
                 value(commissure_expansion),
                 value(edge_stretch),
                 (k == 0 ? 1 : -1) * meeting_shift() * value(commissure_radius),
                 n_cusps_ == 3 && has_equal_cusps() && of_commissure(0, fusion) == 0,
                 {side(k, true)}};
  if (!has_equal_halves) made.sides.push_back(side(k, false));
  return made;
}

// The middle of the free edge is `depth` below the end of the first half. Returns whether the middle is less than `height` times
// root_radius above the root.
bool hangs_lower(const CuspNumbers &cusp, double depth, double height) {
  return !(cusp.front().edge_top - depth >= height * cusp.front().root_radius);
}

// Returns the parts of each half of a cusp.
Vector<Vector<HalfCusp>> halves_at(const CuspNumbers &cusp, double depth) {
  const double top = cusp.front().edge_top;
  Vector<Vector<HalfCusp>> halves;
  for (const HalfNumbers &half : cusp)
    halves.push_back(coapting_half(half, depth + (half.edge_top - top), top - depth));
  return halves;
}

Vector<Vector<HalfCusp>> halves_of(const CuspNumbers &cusp) {
  const double depth = edge_depth(cusp);
  if (hangs_lower(cusp, depth, least_height))
    fail(RIIS_INVALID_PARAMETER, "as the valve opens, its free edge hangs down to the height ",
         cusp.front().edge_top - depth, " above the root; it must stay at least ", least_height,
         " times root_radius, which is ", cusp.front().root_radius,
         ", above the root: look at commissure_height, effective_height, and those of the open state");
  return halves_at(cusp, depth);
}

double least_rise_of(const Vector<Vector<HalfCusp>> &halves) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector<HalfCusp> &half : halves) least = std::min(least, rise_at_root(half));
  return least;
}

// The least of a cusp's rises at the root, over all openings at which cusps may fold. Openings at which the edge hangs too low
// are left out.
struct RiseOnWay {
  double least = std::numeric_limits<double>::infinity();
  bool hangs_too_low = false;  // at one of these openings
};
RiseOnWay rise_on_way(const EndStates &states) {
  RiseOnWay rise;
  for (const double at : openings_of_folds) {
    const CuspNumbers cusp = blend(states.closed, states.open, at);
    const double depth = edge_depth(cusp);
    if (hangs_lower(cusp, depth, least_height))
      rise.hangs_too_low = true;
    else
      rise.least = std::min(rise.least, least_rise_of(halves_at(cusp, depth)));
  }
  return rise;
}

struct CuspMotion {
  EndStates states;
  enum class Fold { unknown, none, with_usual_edge } fold;
};

// Returns the states between which a cusp moves. A long open edge hangs deep. If such an edge leaves the commissures steeply, the
// leaflet folds beside its attachment. The slope at the commissures therefore becomes smaller as the cusp comes nearer to a fold.
// Three equal cusps keep their usual edge, so that this rule leaves their triangles unchanged to the last bit. Fused cusps also
// keep their usual edge, because the patches beside the fused part would become too narrow.
CuspMotion motion_of(const CuspSizes &closed, CuspSizes open) {
  EndStates usual = end_states(closed, open);
  const bool is_fused =
      std::any_of(open.sides.begin(), open.sides.end(), [](const CuspSizes::Side &side) { return side.fusion > 0; });
  if (open.keeps_ratio || is_fused) return {std::move(usual), CuspMotion::Fold::unknown};
  const auto [rise, hangs_too_low] = rise_on_way(usual);
  if (!(rise < usual_rise))
    return {std::move(usual), hangs_too_low ? CuspMotion::Fold::unknown : CuspMotion::Fold::none};
  open.open_sag *= std::max(0.0, 1 - (usual_rise - rise) / rise_until_level);
  return {end_states(closed, open), rise >= least_rise ? CuspMotion::Fold::unknown : CuspMotion::Fold::with_usual_edge};
}

// Returns the halves with the derivatives of their control points with respect to the opening. The derivatives are computed as
// differences.
Vector<MovingHalf> moving_halves(const CuspNumbers &closed, const CuspNumbers &open, double at) {
  const double from = std::max(at - rate_step, 0.0), to = std::min(at + rate_step, 1.0);
  const auto here = halves_of(blend(closed, open, at));
  const auto before = halves_of(blend(closed, open, from)), after = halves_of(blend(closed, open, to));
  Vector<MovingHalf> made;
  for (std::size_t side = 0; side < here.size(); ++side) {
    made.push_back({here[side], {}});
    for (std::size_t part = 0; part < here[side].size(); ++part)
      made.back().rates.push_back(rate(before[side][part], after[side][part], to - from));
  }
  return made;
}

// Refuses a cusp whose edge is too short to open or hangs too low, and a cusp that folds. The closed and the open state are
// checked, because one set of values defines both states.
void check_cusp(const ValveValues &values, std::size_t k) {
  const CuspSizes sizes = values.sizes(k, values.has_equal_halves());
  const CuspMotion motion = motion_of(sizes, sizes);
  const auto &[closed, open] = motion.states;
  // Equal cusps have no names in messages. Names are made only if a check fails.
  const bool is_half = closed.size() == 1;
  const auto name = [&](const char *of_equal, const char *before, std::size_t number, const char *behind) {
    return is_half ? std::string(of_equal) : before + std::to_string(number) + behind;
  };
  const double least_length = least_edge_length(open);
  double edge_length = 0;
  for (const HalfNumbers &half : open) edge_length += half.edge_length;
  if (!(least_length <= most_of_edge * edge_length))
    fail(RIIS_INVALID_PARAMETER, name("half an open free edge", "the open free edge of cusp ", k, "").c_str(),
         " is at least ", least_length, " long, but ", is_half ? "half a closed one" : "the closed one", " is ",
         edge_length,
         " long, too short to open so far: look at effective_height, commissure_height, open_radius_ratio, "
         "commissure_expansion");
  if (sizes.keeps_ratio && is_half) {
    // The middle of the edge is at least as far from a commissure as the symmetry plane is. The middle is therefore never lower
    // than `low`.
    const double away = sizes.sector.sine * sizes.commissure_radius;
    const double low = values.of_commissure(k, height) - std::sqrt(edge_length * edge_length - away * away);
    if (!(low >= least_height * sizes.root_radius))
      fail(RIIS_INVALID_PARAMETER, "half a free edge is ", edge_length, " long and may hang down to the height ", low,
           " above the root while the valve opens; it must stay at least ", least_height,
           " times root_radius, which is ", sizes.root_radius,
           ", above the root: look at commissure_height, effective_height");
  }
  if (motion.fold == CuspMotion::Fold::none) return;
  const bool would_fold = motion.fold == CuspMotion::Fold::with_usual_edge;
  for (const double at : openings_of_folds) {
    const CuspNumbers cusp = blend(closed, open, at);
    const double rise = least_rise_of(halves_of(cusp));
    if (rise >= least_rise && !(would_fold && hangs_lower(cusp, edge_depth(cusp), least_height_of_flat))) continue;
    fail(RIIS_INVALID_PARAMETER, name("a cusp", "cusp ", k, "").c_str(),
         " would fold beside its attachment at opening ", at,
         ", because its free edge hangs deep compared with its height: edge_rise is ", sizes.edge_rise, ", ",
         name("effective_height", "cusp_", k, ".effective_height").c_str(), " ", sizes.effective_height, ", ",
         name("commissure_height", "commissure_", k, ".height").c_str(), " ", values.of_commissure(k, height),
         "; higher values help");
  }
}

// Refuses fused commissures that leave no orifice.
void check_fusion(const ValveValues &values) {
  std::size_t largest = 0;
  for (std::size_t k = 1; k < values.n_cusps(); ++k)
    if (values.of_commissure(k, fusion) > values.of_commissure(largest, fusion)) largest = k;
  const double Rc = values[commissure_radius], least = least_orifice * pi * Rc * Rc;
  if (values.of_commissure(largest, fusion) == 0) return;
  double area = 0;
  for (std::size_t k = 0; k < values.n_cusps(); ++k) {
    const CuspSizes sizes = values.sizes(k, false);
    area += area_inside(motion_of(sizes, sizes).states.open);
  }
  if (!(area >= least))
    fail(RIIS_INVALID_PARAMETER, "commissure_", largest, ".fusion is ", values.of_commissure(largest, fusion),
         ", and the open valve has an orifice of only ", area, "; it must be at least ", least, ", ", least_orifice,
         " pi commissure_radius^2: less fusion or a larger open_radius_ratio helps");
}

void check_sizes(const ValveValues &values, const ParameterValues &list) {
  const Vector<ParameterSpec> &specs = kind_of(values.n_cusps()).parameters;
  const auto check = [&](std::size_t parameter, std::size_t unit, double least, double most) {
    check_ratio(specs[parameter], list[parameter], {specs[unit].name.c_str(), values[unit]}, least, most);
  };
  const auto check_heights = [&](std::size_t commissure, std::size_t effective, std::size_t coaptation) {
    check(effective, commissure, 0.1, 0.97);
    check(coaptation, effective, 0.02, 0.9);
  };
  check(commissure_radius, root_radius, 0.5, 2);
  check(commissure_height, commissure_radius, 0.3, 5);
  check_heights(commissure_height, effective_height, coaptation_height);
  check(gap, commissure_radius, 0.002, 0.2);
  check(translation, root_radius, 0, 100);
  for (std::size_t k = 0; k < values.n_cusps(); ++k)
    check(ValveValues::at_commissure(k, height), commissure_radius, 0.3, 5);
  for (std::size_t k = 0; k < values.n_cusps(); ++k) {
    for (const std::size_t commissure : {values.before(k), k})
      check_heights(ValveValues::at_commissure(commissure, height), values.at_cusp(k, own_effective_height),
                    values.at_cusp(k, own_coaptation_height));
    const double degrees = values.sectors()[k];
    if (!(degrees >= least_sector && degrees <= most_sector))
      fail(RIIS_INVALID_PARAMETER, specs[values.at_cusp(k, sector)].name, " is ", values.of_cusp(k, sector),
           ", which is ", degrees, " degrees of a sum of 360; it must be from ", least_sector, " to ", most_sector,
           " degrees");
  }
}

template <std::size_t n_cusps>
void check_values(const ParameterValues &list) {
  const ValveValues values(list, n_cusps);
  check_sizes(values, list);
  const std::size_t n_different = values.has_equal_halves() ? 1 : n_cusps;
  for (std::size_t k = 0; k < n_different; ++k) check_cusp(values, k);
  check_fusion(values);
}

// An open state may have other sizes than the closed valve, but not other cusps.
void check_same_cusps(const ValveValues &closed, const ValveValues &open) {
  for (std::size_t k = 0; k < closed.n_cusps(); ++k) {
    if (closed.sectors()[k] != open.sectors()[k])
      fail(RIIS_INVALID_PARAMETER, "in the open state: the sector of cusp ", k, " is ", open.sectors()[k],
           " degrees, but ", closed.sectors()[k], " in the closed valve; both must be equal");
    if (closed.of_commissure(k, fusion) != open.of_commissure(k, fusion))
      fail(RIIS_INVALID_PARAMETER, "in the open state: commissure_", k, ".fusion is ", open.of_commissure(k, fusion),
           ", but ", closed.of_commissure(k, fusion), " in the closed valve; both must be equal");
  }
}

template <std::size_t n_cusps>
PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening) {
  const ValveValues from(closed.values, n_cusps), to(open.values, n_cusps);
  const Vec3 shift = riis::blend(vector_of(closed.values[translation]), vector_of(open.values[translation]), opening);
  check_same_cusps(from, to);
  const bool has_equal_halves = from.has_equal_halves() && to.has_equal_halves();
  const auto halves = [&](std::size_t k) {
    const auto [start, end] = motion_of(from.sizes(k, has_equal_halves), to.sizes(k, has_equal_halves)).states;
    return moving_halves(start, end, opening);
  };
  PatchSet set;
  if (has_equal_halves) {
    add_cusps(set, halves(0).front(), equal_places(n_cusps, shift));
    // The cusps meet only at the commissures. There the side u1 of the top patch is one point.
    sew_equal_cusps(set, top_patch(set) - 1, SeamPlace::corner);
    sew_equal_cusps(set, top_patch(set), SeamPlace::side_u1);
    return set;
  }
  Vector<UnequalCusp> cusps;
  double turn = 0;
  for (std::size_t k = 0; k < n_cusps; ++k) {
    if (k > 0) turn += (from.sectors()[k - 1] + from.sectors()[k]) / 2;
    Vector<MovingHalf> both = halves(k);
    cusps.push_back({turn, {std::move(both[0]), std::move(both[1])}});
  }
  add_unequal_cusps(set, cusps, shift);
  return set;
}

}  // namespace

// Each kind is made at its first use. It is never destroyed, so that it serves until the process ends.
const ValveKind &bicuspid_valve_kind() {
  static const ValveKind &kind = *new ValveKind(make_kind<2>("bicuspid", 0.1));
  return kind;
}
const ValveKind &coapting_valve_kind() {
  static const ValveKind &kind = *new ValveKind(make_kind<3>("coapting", 0));
  return kind;
}
const ValveKind &quadricuspid_valve_kind() {
  static const ValveKind &kind = *new ValveKind(make_kind<4>("quadricuspid", 0));
  return kind;
}

}  // namespace riis
