// SPDX-License-Identifier: Apache-2.0
// The mitral valve. The valve has an annulus, an anterior leaflet, and a posterior leaflet of three scallops. The leaflets can be
// closed, open or in between (paper, appendix "Parametric modeling of the mitral valve"; docs/theory/mitral.md).
#include <array>
#include <cmath>
#include <utility>

#include "base/errors.hpp"
#include "common/elementary.hpp"
#include "geometry/bulge.hpp"
#include "geometry/placement.hpp"
#include "valve/mitral_annulus.hpp"
#include "valve/patches.hpp"
#include "valve/valve.hpp"

namespace riis {
namespace {

// Positions in the list of specs below: first the paper's table, then `opening` (t in the paper) and `translation`.
// clang-format off
enum Parameter {
  anterior_ratio, AP_diameter, ALPM_diameter, ALPM_position_ratio, IT_distance, indent_depth, anterior_horn_height,
  posterior_horn_height, anterior_length, posteromedial_commissure_height, posterior_scallop_length1,
  posterior_scallop_length2, leaflet_arc_angle, leaflet_inward_angle, surface_angle, triangle_size_ratio, opening_,
  translation
};

void check_values(const ParameterValues &values);
PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening);

ValveKind make_kind() {
  constexpr double shortest = 1e-9, longest = 1e9;
  const char *length = "length", *degree = "degree", *number = "1";
  ValveKind kind{"mitral", {
    {"anterior_ratio", number, "share of the annulus that belongs to the anterior leaflet and its triangles",
     1, {0.41}, 0.05, 0.95},
    {"AP_diameter", length, "depth of the annulus, from the posterior to the anterior point", 1, {3.0}, shortest, longest},
    {"ALPM_diameter", length, "largest width of the annulus", 1, {4.0}, shortest, longest},
    {"ALPM_position_ratio", number, "position of the annulus' widest part, from 0 (posterior point) to 1 (anterior point)",
     1, {0.55}, 0.05, 0.95},
    {"IT_distance", length, "distance between the trigones, which is the width of the indent", 1, {2.5}, shortest, longest},
    {"indent_depth", length, "depth of the indent of the annulus at the anterior point", 1, {0.5}, 0, longest},
    {"anterior_horn_height", length, "height of the anterior point when closed", 1, {0.8}, -longest, longest},
    {"posterior_horn_height", length, "height of the posterior point when closed", 1, {0.6}, -longest, longest},
    {"anterior_length", length, "length of the anterior leaflet", 1, {2.12}, shortest, longest},
    {"posteromedial_commissure_height", length, "length of the leaflets at the commissures and the clefts",
     1, {0.8}, shortest, longest},
    {"posterior_scallop_length1", length, "length of each of the two side scallops when open", 1, {1.35}, shortest, longest},
    {"posterior_scallop_length2", length, "length of the middle scallop when open", 1, {1.35}, shortest, longest},
    {"leaflet_arc_angle", degree, "angle of the arc that the free edges follow", 1, {120}, 1, 300},
    {"leaflet_inward_angle", degree, "direction of the open leaflets: 0 is inwards, 90 is straight down", 1, {75}, 0, 180},
    {"surface_angle", degree,
     "angle at which a leaflet leaves the straight line from annulus to free edge; if above 0, the leaflet bulges outwards",
     1, {20}, -80, 80},
    {"triangle_size_ratio", number, "share of the annulus that belongs to each commissure's triangle", 1, {0.1}, 0.001, 0.45},
    opening_spec("from 0 (closed) to 1 (open)", 1),
    {"translation", length, "shift of the valve", 3, {0, 0, 1}, -longest, longest},
  }, opening_, true, check_values, make_patches, nullptr};
  kind.absent = {
    {"annulus", "its annulus is not round; set AP_diameter and ALPM_diameter"},
    {"stj", "it has no sinotubular junction"},
    {"effective_height", "only cusps have an effective height; anterior_length and posterior_scallop_length1 and 2 determine "
                         "the leaflets' height"},
  };
  return kind;
}
// clang-format on

// The half of the valve on the posteromedial side, x >= 0. The other half is its mirror image. The annulus runs from the
// posterior point, u = 0, to the anterior point, u = 1/2, counter-clockwise seen from +z.
struct HalfValve {
  std::array<Bezier, 3> annulus;
  Bezier anterior;        // free edge, from the posteromedial to the anterolateral commissure
  Bezier side_scallop;    // free edge, from the posteromedial commissure to the cleft
  Bezier middle_scallop;  // free edge, from this cleft to the cleft of the other half
  double u_commissure;    // u_pm in the paper
  double triangle_width;  // r_tr in the paper, in units of u
  double bulge;           // tan(surface_angle) / 2
  double cleft;           // parameter of the point where the closed anterior edge meets the cleft
};

Vec3 mirrored(Vec3 p) { return {-p.x, p.y, p.z}; }

// Passes the valve's parameters on to riis::half_annulus, below. The open annulus is flat.
std::array<Bezier, 3> half_annulus(const ParameterValues &values, bool flat) {
  const auto value = [&](Parameter parameter) { return values[parameter][0]; };
  return riis::half_annulus({value(AP_diameter), value(ALPM_diameter), value(ALPM_position_ratio), value(IT_distance),
                             value(indent_depth), flat ? 0 : value(anterior_horn_height),
                             flat ? 0 : value(posterior_horn_height)});
}

// The annulus, from which the leaflets hang. A(u) is a point of the annulus. N(u) is the tangent there, turned inwards by 90
// degrees in the plane z = 0.
class Annulus {
 public:
  explicit Annulus(const std::array<Bezier, 3> &half) : half_({half.begin(), half.end()}) {}

  const Curve &half() const { return half_; }
  Curve::PointAndTangent with_tangent(double u) const { return half_.with_tangent(2 * u); }
  // Returns U(u, x): the point at the distance x from the annulus, inwards and by an angle below the plane. (In the paper's
  // formula, N is multiplied by the angle. The angle would have no effect, because the z component of N is 0.)
  Vec3 below(double u, double x, SineCosine angle) const {
    const auto [A, T] = with_tangent(u);
    const double in_plane = hypotenuse(T.x, T.y);
    const Vec3 N = in_plane > 0 ? (1 / in_plane) * Vec3{-T.y, T.x, 0} : Vec3{0, 0, 0};
    return A + x * Vec3{angle.cosine * N.x, angle.cosine * N.y, -angle.sine};
  }

 private:
  Curve half_;
};

// Returns the cubic from `first` to `last` that passes through the tip at 1/2. This cubic is an affine image of the cubic that
// approximates a circular arc of the angle `arc_angle`. (The paper's matrix should give this curve, but has rank 3.)
Bezier free_edge(Vec3 first, Vec3 tip, Vec3 last, double arc_angle) {
  const auto [quarter_sine, quarter_cosine] = sine_cosine_degrees(0.25 * arc_angle);
  const auto [half_sine, half_cosine] = sine_cosine_degrees(0.5 * arc_angle);
  const double k = 4.0 / 3.0 * quarter_sine / quarter_cosine;
  const double along = 1 - k * half_cosine / half_sine;
  const Vec3 middle = 0.5 * (first + last), half_chord = 0.5 * (last - first), rise = (4.0 / 3.0) * (tip - middle);
  return Bezier::cubic(first, middle - along * half_chord + rise, middle + along * half_chord + rise, last);
}

// Returns the length of a free edge. Refuses an edge that is nearly a point, because such an edge bounds no leaflet.
double checked_length(const Bezier &edge, const char *which, const Bezier &annulus) {
  const double length = arc_length(edge);
  if (!(length >= 1e-6 * arc_length(annulus)))
    fail(RIIS_INVALID_PARAMETER, "the ", which, " free edge is ", length,
         " long, which is negligible beside the annulus: look at anterior_ratio, ALPM_diameter, the leaflets' lengths "
         "and "
         "leaflet_inward_angle");
  return length;
}

// Returns the parameter of the cleft. The cleft is on the closed anterior edge, a third of the edge's length from the
// commissure.
double cleft_parameter(const Bezier &closed_anterior, const Bezier &annulus) {
  const double whole = checked_length(closed_anterior, "closed", annulus);
  return parameter_at_length(closed_anterior, whole, whole / 3);
}

HalfValve half_valve(const ParameterValues &values, bool is_open) {
  const auto value = [&](Parameter parameter) { return values[parameter][0]; };
  const double arc_angle = value(leaflet_arc_angle), commissure_length = value(posteromedial_commissure_height);
  const auto [sine, cosine] = sine_cosine_degrees(value(surface_angle));
  HalfValve half;
  half.annulus = half_annulus(values, is_open);
  half.u_commissure = 0.5 - 0.5 * value(anterior_ratio);
  half.triangle_width = value(triangle_size_ratio);
  half.bulge = 0.5 * sine / cosine;

  const Annulus annulus(half.annulus);
  const double u_pm = half.u_commissure;
  // Closed leaflets end in the plane z = 0, although the annulus may be higher or lower at the commissures.
  const auto edge_point = [&](double u, double x) {
    Vec3 p = annulus.below(u, x, is_open ? sine_cosine_degrees(value(leaflet_inward_angle)) : SineCosine{0, 1});
    if (!is_open) p.z = 0;
    return p;
  };
  const Vec3 commissure = edge_point(u_pm, commissure_length);
  half.anterior = free_edge(commissure, edge_point(0.5, value(anterior_length)), mirrored(commissure), arc_angle);
  half.cleft = 0;
  if (is_open) {
    // Along the annulus, a cleft is a third of the way from the posterior point to the commissure. (The paper swaps the tips and
    // the ends of the side scallops.)
    const Vec3 cleft = edge_point(u_pm / 3, commissure_length);
    half.side_scallop =
        free_edge(commissure, edge_point(2 * u_pm / 3, value(posterior_scallop_length1)), cleft, arc_angle);
    half.middle_scallop = free_edge(cleft, edge_point(0, value(posterior_scallop_length2)), mirrored(cleft), arc_angle);
  } else {
    // The closed leaflets meet in one edge. Each of the three scallops takes up a third of this edge's length.
    half.cleft = cleft_parameter(half.anterior, half.annulus[0]);
    const auto [side, rest] = split(half.anterior, half.cleft);
    half.side_scallop = side;
    half.middle_scallop = split(rest, (1 - 2 * half.cleft) / (1 - half.cleft)).first;
  }
  return half;
}

HalfValve blend(const HalfValve &closed, const HalfValve &open, double opening) {
  HalfValve half;
  for (std::size_t i = 0; i < half.annulus.size(); ++i)
    half.annulus[i] = riis::blend(closed.annulus[i], open.annulus[i], opening);
  half.anterior = riis::blend(closed.anterior, open.anterior, opening);
  half.side_scallop = riis::blend(closed.side_scallop, open.side_scallop, opening);
  half.middle_scallop = riis::blend(closed.middle_scallop, open.middle_scallop, opening);
  half.u_commissure = riis::blend(closed.u_commissure, open.u_commissure, opening);
  half.triangle_width = riis::blend(closed.triangle_width, open.triangle_width, opening);
  half.bulge = riis::blend(closed.bulge, open.bulge, opening);
  half.cleft = riis::blend(closed.cleft, open.cleft, opening);
  return half;
}

// Compares lengths with the depth of the annulus.
void check_values(const ParameterValues &values) {
  const Vector<ParameterSpec> &specs = mitral_valve_kind().parameters;
  const Reference depth{"AP_diameter", values[AP_diameter][0]};
  const auto check = [&](Parameter parameter, double least, double most) {
    check_ratio(specs[parameter], values[parameter], depth, least, most);
  };
  check(ALPM_diameter, 0.2, 5);
  check(IT_distance, 0.05, 5);
  check(indent_depth, 0, 1);
  check(anterior_horn_height, 0, 2);
  check(posterior_horn_height, 0, 2);
  check(anterior_length, 0.01, 5);
  check(posteromedial_commissure_height, 0.01, 5);
  check(posterior_scallop_length1, 0.01, 5);
  check(posterior_scallop_length2, 0.01, 5);
  check(translation, 0, 100);
  const double ratio = values[anterior_ratio][0], triangle = values[triangle_size_ratio][0];
  if (!(ratio - 2 * triangle >= 0.02))
    fail(RIIS_INVALID_PARAMETER, "triangle_size_ratio is ", triangle,
         "; twice that must leave at least 0.02 of anterior_ratio, which is ", ratio);
}

// Cuts an edge at the plane of symmetry, and returns the first half.
Bezier up_to_symmetry_plane(const Bezier &edge, double middle) {
  Bezier half = split(edge, middle).first;
  half.control[3].x = 0;
  return half;
}

class Patches {
 public:
  Patches(const HalfValve &half, bool is_closed, Vec3 shift) : half_(half), annulus_(half.annulus), shift_(shift) {
    const auto [side_edge, rest] = split(half.anterior, half.cleft);
    const Bezier middle_edge = up_to_symmetry_plane(rest, (0.5 - half.cleft) / (1 - half.cleft));
    const std::size_t anterior_side = set_.add(side_edge).curve, anterior_middle = set_.add(middle_edge).curve;
    // Closed leaflets have one edge in common. This edge is stored once, so that it becomes one polyline.
    const std::size_t posterior_side = is_closed ? anterior_side : set_.add(half.side_scallop).curve;
    const std::size_t posterior_middle =
        is_closed ? anterior_middle : set_.add(up_to_symmetry_plane(half.middle_scallop, 0.5)).curve;
    const Side commissure = set_.add(Bezier::point(side_edge.first()));

    // u runs along the annulus. Outside of the triangle, the annulus is divided among the spans of the anterior edge in
    // proportion to their lengths.
    const double u_pm = half.u_commissure, u_triangle = u_pm + half.triangle_width;
    const double side_length = arc_length(side_edge), middle_length = arc_length(middle_edge);
    const double u_anterior_cleft = u_triangle + side_length / (side_length + middle_length) * (0.5 - u_triangle);
    begin_at(0.5, middle_edge.last());
    add_patch({anterior_middle, true}, u_anterior_cleft, middle_edge.first(), RIIS_LEAFLET_ANTERIOR, 2, 3);
    add_patch({anterior_side, true}, u_triangle, side_edge.first(), RIIS_LEAFLET_ANTERIOR, 1, 4);
    add_patch(commissure, u_pm, side_edge.first(), RIIS_LEAFLET_ANTERIOR, 0, 5);
    add_patch({posterior_side}, u_pm / 3, set_.curves[posterior_side].last(), RIIS_LEAFLET_POSTERIOR, 6, 9);
    add_patch({posterior_middle}, 0, set_.curves[posterior_middle].last(), RIIS_LEAFLET_POSTERIOR, 7, 8);
  }

  PatchSet take() { return std::move(set_); }

 private:
  struct Arc {
    PointOnSpan where;  // on half the annulus
    Vec3 on_annulus;
    Side side;
  };

  // Returns the arc from the point u of the annulus to a point of the edge. This arc is a side of two neighbouring patches.
  Arc arc(double u, Vec3 on_edge) {
    const PointOnSpan where = annulus_.half().on_span(2 * u);
    const auto [on_annulus, along] = annulus_.half().with_tangent(where);
    Vec3 offset = arc_offset(on_edge - on_annulus, along, half_.bulge);
    if (u == 0 || u == 0.5) offset.x = 0;  // the plane of symmetry is x = 0 exactly
    return {where, on_annulus, set_.add(Bezier::quadratic(on_annulus, 0.5 * (on_annulus + on_edge) + offset, on_edge))};
  }

  void begin_at(double u, Vec3 on_edge) { last_arc_ = arc(u, on_edge); }

  // Patches run clockwise, and down from the anterior point. S_u x S_v therefore points into the ventricle, downstream. The minus
  // sign is needed because O points along (edge - annulus) x (the annulus' counter-clockwise direction).
  void add_patch(Side edge, double to_u, Vec3 on_edge, std::int32_t leaflet_id, std::int32_t patch_id,
                 std::int32_t mirrored_patch_id) {
    const Arc from = last_arc_, to = arc(to_u, on_edge);
    Vector<Bezier> spans = annulus_.half().spans_between(to.where, from.where);
    reverse(spans);
    const Side base = set_.add(Curve(std::move(spans)).through(from.on_annulus, to.on_annulus));
    set_.patches.push_back({base,
                            edge,
                            from.side,
                            to.side,
                            {{Mirror::none, no_rotation, shift_, leaflet_id, patch_id},
                             {Mirror::in_x, no_rotation, shift_, leaflet_id, mirrored_patch_id}},
                            -half_.bulge,
                            AttachedSide::v0});
    last_arc_ = to;
  }

  const HalfValve &half_;
  Annulus annulus_;
  Vec3 shift_;
  PatchSet set_;
  Arc last_arc_{};
};

PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening) {
  const HalfValve closed_half = half_valve(closed.values, false);
  HalfValve open_half = half_valve(open.values, true);
  open_half.cleft = &open == &closed ? closed_half.cleft : half_valve(open.values, false).cleft;
  const HalfValve half = blend(closed_half, open_half, opening);
  checked_length(half.anterior, "anterior", half.annulus[0]);
  checked_length(half.side_scallop, "side scallop's", half.annulus[0]);
  checked_length(half.middle_scallop, "middle scallop's", half.annulus[0]);
  const Vec3 shift = riis::blend(vector_of(closed.values[translation]), vector_of(open.values[translation]), opening);
  return Patches(half, opening == 0, shift).take();
}

}  // namespace

// The annulus has six points and tangents, and the half has points 0 to 3. For the x of the widest point, the paper prints
// IT_distance on one side. This file uses ALPM_diameter / 2, because the annulus must be symmetric.
std::array<Bezier, 3> half_annulus(const MitralAnnulus &annulus) {
  const double ap = annulus.AP_diameter, alpm = annulus.ALPM_diameter, position = annulus.ALPM_position_ratio,
               it = annulus.IT_distance, indent = annulus.indent_depth, anterior_height = annulus.anterior_horn_height,
               posterior_height = annulus.posterior_horn_height;
  const Vec3 P0{0, -0.5 * ap, posterior_height}, P1{0.5 * alpm, ap * (position - 0.5), 0},
      P2{0.5 * it, 0.5 * (ap + indent), 0.75 * anterior_height}, P3{0, 0.5 * ap, anterior_height};
  const Vec3 T0{0.5 * 0.55 * (ap * position + 0.5 * alpm), 0, 0}, T1{0, 0.55 * (0.5 * indent + ap * (1 - position)), 0},
      T2{-0.25 * it, 0, 0}, T3 = T2;
  return {Bezier::cubic(P0, P0 + T0, P1 - T1, P1), Bezier::cubic(P1, P1 + T1, P2 - T2, P2),
          Bezier::cubic(P2, P2 + T2, P3 - T3, P3)};
}

const ValveKind &mitral_valve_kind() {
  // The kind is made at its first use. It is never destroyed, so that it serves until the process ends.
  static const ValveKind &kind = *new ValveKind(with_skirt(make_kind(), SkirtAxis::vertical));
  return kind;
}

}  // namespace riis
