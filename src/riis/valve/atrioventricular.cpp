// SPDX-License-Identifier: Apache-2.0
// The valves between atria and ventricles, whose leaflets hang from a saddle and lie side by side in a coaptation zone: the
// tricuspid valve, and a mitral valve (docs/theory/atrioventricular.md).
#include "valve/atrioventricular.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "geometry/placement.hpp"
#include "valve/bumps.hpp"
#include "valve/patches.hpp"
#include "valve/valve.hpp"

namespace riis {
namespace {

// A leaflet has `n_places` evenly spaced places along the annulus, from one commissure to the next. A meridian, a curve down the
// leaflet, begins at each place. A free edge consists of two cubics, and so does a coaptation line. Two joined cubics have seven
// control points, one for each place.
constexpr std::size_t n_places = 7, middle = 3, n_cells = n_places - 1;
template <class Value>
struct AtPlaces {
  std::array<Value, n_places> values{};

  Value &operator[](std::size_t place) { return view(values)[place]; }
  const Value &operator[](std::size_t place) const { return view(values)[place]; }
};
constexpr double u_of(std::size_t place) { return static_cast<double>(place) / n_cells; }

// The coaptation zone takes up at least the share `least_coaptation` of a leaflet's length. A leaflet that is too short for this
// zone does not reach its neighbours.
constexpr double least_coaptation = 0.05;
// A closed meridian's first inner control point lies below the annulus by `first_drop` times the drop from the annulus to the
// coaptation line.
constexpr double first_drop = 0.2;
// The heights of a closed free edge's control points, from the middle to a commissure. 0 is the height of the edge's middle, and
// 1 is the height of its end.
constexpr std::array<double, 4> edge_rise{0, 0, 0.6, 1};
// A bump lifts a meridian's first inner control point by only `lift_of_start` times the bump's lift.
constexpr double lift_of_start = 0.3;
// Next to a commissure, bumps lift a leaflet at most `most_lift_by_commissure` * commissure_length higher than they lift the
// commissure. A leaflet that rises more steeply would go through its neighbour, because leaflets lie close together there.
constexpr double most_lift_by_commissure = 0.5;
// If a leaflet is too short for its end, the end moves back in at most `most_steps` steps. The leaflet may then still be too
// short by `rounding` times its length.
constexpr int most_steps = 60;
constexpr double rounding = 1e-12, rounding_of_zone = 1e-6;
// A leaflet takes up at least the share `least_ratio` of the annulus. The way from the middle of a leaflet's part of the annulus
// to the meeting point is at least `least_way` times the annulus' depth.
constexpr double least_ratio = 0.05, least_way = 0.12;
// A commissure takes up at most the share `most_of_way` of the way from the annulus to the meeting point. The coaptation zone
// takes up at most the share `most_coaptation` of a leaflet's length.
constexpr double most_of_way = 0.8, most_coaptation = 0.7;
// The rates of the control points are computed as differences over the step `rate_step` of the opening. The rates only determine
// where vertices are dense.
constexpr double rate_step = 1e-4;

// The parameters that follow the leaflets' own sizes in the list of specs.
// clang-format off
enum Parameter : std::size_t {
  width, depth, flatness, saddle_height, flat_ratio, commissure_length, commissure_angle, commissure_coaptation, tenting_height,
  gap, belly, turn, open_angle, translation, opening_, skirt_length, first_bump
};
// clang-format on

// A kind has two or three leaflets. Each leaflet has a length. In a kind with three leaflets, the anterior leaflet also has a
// share of the annulus. The list of specs begins with these sizes.
class Sizes {
 public:
  Sizes(const ParameterValues &values, std::size_t n_leaflets) : n_leaflets_(n_leaflets), values_(values) {}

  static std::size_t position(Parameter parameter, std::size_t n_leaflets) { return 2 * n_leaflets - 2 + parameter; }
  std::size_t n_leaflets() const { return n_leaflets_; }
  const std::array<double, 3> &values_of(Parameter parameter) const {
    return values_[position(parameter, n_leaflets_)];
  }
  double of(Parameter parameter) const { return values_of(parameter)[0]; }
  double length(std::size_t leaflet) const { return values_[leaflet][0]; }
  Bumps bumps() const { return {values_, position(first_bump, n_leaflets_), n_leaflets_, BumpLift::yes}; }

  std::array<Bezier, 4> annulus() const {
    return saddle_annulus({of(width), of(depth), of(flatness), of(saddle_height),
                           n_leaflets_ == 2 ? FlatSide::at_positive_y : FlatSide::at_negative_y});
  }
  // Returns where along the annulus each leaflet starts and the last leaflet ends, in laps from the middle of the flat side.
  Vector<double> commissures() const {
    const double half = 0.5 * of(flat_ratio);
    if (n_leaflets_ == 2) return {-half, half, 1 - half};
    const double anterior = values_[3][0];
    return {-half - anterior, -half, half, 1 - half - anterior};
  }

 private:
  std::size_t n_leaflets_;
  const ParameterValues &values_;
};

Vec3 level(Vec3 p) { return {p.x, p.y, 0}; }
Vec3 unit(Vec3 p) { return (1 / length(p)) * p; }

// A place on the annulus, and the horizontal direction inwards.
struct Hinge {
  Vec3 point, inwards;

  // Returns the point at a distance from the hinge. The direction points inwards and down, at the given angle below the
  // horizontal.
  Vec3 hang(double distance, SineCosine angle) const {
    return point + distance * (angle.cosine * inwards - Vec3{0, 0, angle.sine});
  }
};

// The annulus and the places of the leaflets. The annulus is stored as two laps, one after the other, so that each leaflet's part
// of it is connected.
class Annulus {
 public:
  Annulus(const std::array<Bezier, 4> &lap, const Vector<double> &commissures) : laps_(two_laps(lap)) {
    const std::size_t n_leaflets = commissures.size() - 1;
    for (std::size_t leaflet = 0; leaflet < n_leaflets; ++leaflet) {
      leaflets_.emplace_back();
      for (std::size_t i = 0; i < n_places; ++i) {
        const double u = riis::blend(commissures[leaflet], commissures[leaflet + 1], u_of(i));
        const PointOnSpan where = laps_.on_span(0.5 * (u + 1));
        const auto [point, along] = laps_.with_tangent(where);
        leaflets_[leaflet][i] = {where, {point, 1 / hypotenuse(along.x, along.y) * Vec3{-along.y, along.x, 0}}};
      }
    }
    // Neighbouring leaflets share their commissure, even at the end of a lap.
    leaflets_.back()[n_cells].hinge = leaflets_.front()[0].hinge;
  }

  // Sets the point where all leaflets meet, seen along z. All commissures lead towards this point, which keeps neighbouring
  // leaflets on opposite sides of a plane.
  void set_meeting(Vec3 at) {
    meeting_ = at;
    for (AtPlaces<Place> &leaflet : leaflets_)
      for (Hinge *hinge : {&leaflet[0].hinge, &leaflet[n_cells].hinge}) hinge->inwards = unit(level(at - hinge->point));
  }
  Vec3 meeting() const { return meeting_; }

  const Hinge &hinge(std::size_t leaflet, std::size_t place) const { return leaflets_[leaflet][place].hinge; }
  Curve between_places(std::size_t leaflet, std::size_t place) const {
    const auto &from = leaflets_[leaflet][place], &to = leaflets_[leaflet][place + 1];
    return Curve(laps_.spans_between(from.where, to.where)).through(from.hinge.point, to.hinge.point);
  }

 private:
  struct Place {
    PointOnSpan where;
    Hinge hinge;
  };

  static Curve two_laps(const std::array<Bezier, 4> &lap) {
    Vector<Bezier> spans;
    for (int i = 0; i < 2; ++i) spans.insert(spans.end(), lap.begin(), lap.end());
    return Curve(std::move(spans));
  }

  Curve laps_;
  Vector<AtPlaces<Place>> leaflets_;
  Vec3 meeting_{0, 0, 0};
};

// The control points of a leaflet, as vectors from the hinges at their places.
struct Leaflet {
  AtPlaces<Vec3> edge, line;  // points of the free edge and of the coaptation line, which ends above the commissure
  AtPlaces<Vec3> start;       // the meridians' first inner control points
  AtPlaces<double> turn;      // the lengths of the meridians' end tangents
  AtPlaces<double> body;      // the lengths of the meridians down to the coaptation line
  AtPlaces<double> whole;     // the lengths of the meridians down to the free edge
  AtPlaces<double> lift;      // how far bumps lift the closed leaflet
};

// `q` has the control points of two cubics, which meet at the middle place. Returns the part of the cubics from each place to the
// next.
std::array<Bezier, n_cells> parts(const AtPlaces<Vec3> &q) {
  const auto [first, rest] = split(Bezier::cubic(q[0], q[1], q[2], q[3]), 1.0 / 3);
  const auto [fourth, rest_behind] = split(Bezier::cubic(q[3], q[4], q[5], q[6]), 1.0 / 3);
  const auto [second, third] = split(rest, 0.5);
  const auto [fifth, sixth] = split(rest_behind, 0.5);
  return {first, second, third, fourth, fifth, sixth};
}
AtPlaces<Vec3> on_parts(const std::array<Bezier, n_cells> &parts) {
  AtPlaces<Vec3> points;
  for (std::size_t i = 0; i < n_cells; ++i) points[i] = view(parts)[i].first();
  points[n_cells] = parts.back().last();
  return points;
}

// Returns the meridian of a moving leaflet. At the coaptation line, the meridian has the direction in which the coaptation zone
// continues.
Bezier meridian(Vec3 hinge, Vec3 start, double turn, Vec3 on_line, Vec3 on_edge) {
  return Bezier::cubic(hinge, hinge + start, on_line + turn * unit(on_line - on_edge), on_line);
}

// Returns the point at which all leaflets would overlap by the same length, seen along z.
Vec3 meeting_point(const Sizes &sizes, const Annulus &annulus) {
  const auto hinge = [&](std::size_t leaflet) { return level(annulus.hinge(leaflet, middle).point); };
  const double apart = distance(hinge(0), hinge(1));
  if (sizes.n_leaflets() == 2) return mix(hinge(0), hinge(1), 0.5 * (1 + (sizes.length(0) - sizes.length(1)) / apart));
  // Newton's method solves |H - M| + overlap = length for all three leaflets. H is a leaflet's middle hinge, and M is the meeting
  // point. Subtracting one equation from another removes the overlap.
  Vec3 at = 1.0 / 3 * (hinge(0) + hinge(1) + hinge(2));
  for (int step = 0; step < 30; ++step) {
    std::array<Vec3, 3> row{};
    std::array<double, 3> left{};
    for (std::size_t k = 0; k < 3; ++k) {
      view(row)[k] = unit(at - hinge(k));
      view(left)[k] = sizes.length(k) - distance(at, hinge(k));
    }
    const Vec3 a = row[0] - row[2], b = row[1] - row[2];
    const double c = left[0] - left[2], d = left[1] - left[2], determinant = a.x * b.y - a.y * b.x;
    const Vec3 by = 1 / determinant * Vec3{c * b.y - d * a.y, a.x * d - b.x * c, 0};
    at = at + by;
    if (!(length(by) > 1e-15 * apart)) break;
  }
  return at;
}

Annulus annulus_of(const Sizes &sizes) {
  Annulus annulus(sizes.annulus(), sizes.commissures());
  annulus.set_meeting(meeting_point(sizes, annulus));
  return annulus;
}

// Returns the point of a commissure at which a closed free edge ends. The coaptation line ends above this point.
Vec3 end_of_edge(const Sizes &sizes, const Hinge &hinge) {
  return hinge.hang(sizes.of(commissure_length), sine_cosine_degrees(sizes.of(commissure_angle)));
}

// The vectors from a closed meridian's ends to its inner control points.
struct EndTangents {
  Vec3 start, end;
};
EndTangents closed_tangents(const Sizes &sizes, Vec3 hinge, Vec3 on_line) {
  const double drop = hinge.z - on_line.z;
  return {sizes.of(belly) * level(on_line - hinge) - Vec3{0, 0, first_drop * drop}, {0, 0, sizes.of(turn) * drop}};
}
double closed_length(const Sizes &sizes, Vec3 hinge, Vec3 on_line) {
  const auto [start, end] = closed_tangents(sizes, hinge, on_line);
  return arc_length(Bezier::cubic(hinge, hinge + start, on_line + end, on_line));
}

// Closed leaflets lie side by side in vertical coaptation zones.
Leaflet closed_leaflet(const Sizes &sizes, const Annulus &annulus, std::size_t k, const Bumps &bumps) {
  const Vec3 hinge = annulus.hinge(k, middle).point, meeting = annulus.meeting();
  const Vec3 away = unit(level(hinge) - meeting);
  // Three leaflets meet along straight lines to the commissures. Two leaflets meet along a smile-shaped line, which is straight
  // in the middle.
  const auto along = [&](std::size_t end) -> Vec3 {
    if (sizes.n_leaflets() == 2) return end == 0 ? Vec3{away.y, -away.x, 0} : Vec3{-away.y, away.x, 0};
    return unit(level(end_of_edge(sizes, annulus.hinge(k, end))) - meeting);
  };
  // Each leaflet stays half the gap away from the lines along which leaflets meet.
  const double sine = std::min(length(cross(away, along(0))), length(cross(away, along(n_cells))));
  Vec3 on_line = meeting + 0.5 * sizes.of(gap) / sine * away - Vec3{0, 0, sizes.of(tenting_height)};
  const auto zone_below = [&] { return sizes.length(k) - closed_length(sizes, hinge, on_line); };
  for (int step = 0; step < most_steps && dot(level(hinge - on_line), away) > 0; ++step) {
    const double lacking = least_coaptation * sizes.length(k) - zone_below();
    if (!(lacking > rounding * sizes.length(k))) break;
    on_line = on_line + lacking * away;
  }
  const double zone = zone_below();
  AtPlaces<Vec3> line, edge;
  const double zone_of_commissure = sizes.of(commissure_coaptation) * sizes.of(commissure_length);
  for (const bool is_behind : {false, true}) {
    const auto place = [&](std::size_t i) { return is_behind ? middle + i : middle - i; };
    const Vec3 end = end_of_edge(sizes, annulus.hinge(k, place(3))), first = level(on_line), last = level(end);
    const Vec3 second = first + distance(first, last) / 3 * along(place(3));
    const std::array<Vec3, 4> plan{first, second, mix(second, last, 0.5), last};
    for (std::size_t i = 0; i < plan.size(); ++i) {
      const auto at_height = [&](double in_middle, double at_end) {
        return view(plan)[i] + Vec3{0, 0, riis::blend(in_middle, at_end, view(edge_rise)[i])};
      };
      line[place(i)] = at_height(on_line.z, end.z + zone_of_commissure);
      edge[place(i)] = at_height(on_line.z - zone, end.z);
    }
  }
  const AtPlaces<Vec3> points_of_line = on_parts(parts(line)), points_of_edge = on_parts(parts(edge));
  Leaflet made;
  for (std::size_t i = 0; i < n_places; ++i) {
    const Vec3 from = annulus.hinge(k, i).point, to = points_of_line[i];
    const auto [start, end] = closed_tangents(sizes, from, to);
    made.body[i] = closed_length(sizes, from, to);
    made.whole[i] = made.body[i] + distance(to, points_of_edge[i]);
    made.edge[i] = edge[i] - from;
    made.line[i] = line[i] - from;
    made.start[i] = start;
    made.turn[i] = end.z;
    made.lift[i] = bumps.at(k, u_of(i)).lift;
  }
  const double most = most_lift_by_commissure * sizes.of(commissure_length);
  for (const auto &[end, next] : {std::pair<std::size_t, std::size_t>(0, 1), {n_cells, n_cells - 1}})
    made.lift[next] = std::clamp(made.lift[next], made.lift[end] - most, made.lift[end] + most);
  return made;
}

// Open leaflets hang straight down from the annulus, with the lengths of the closed leaflets.
Leaflet open_leaflet(const Sizes &sizes, const Annulus &annulus, std::size_t k, const Leaflet &closed) {
  const SineCosine down = sine_cosine_degrees(sizes.of(open_angle));
  AtPlaces<Vec3> edge;
  for (std::size_t i = 0; i < n_places; ++i) edge[i] = annulus.hinge(k, i).hang(closed.whole[i], down);
  // Turns the control points beside the middle, so that the edge has no corner there.
  const Vec3 along = unit(edge[middle + 1] - edge[middle - 1]);
  edge[middle - 1] = edge[middle] - distance(edge[middle - 1], edge[middle]) * along;
  edge[middle + 1] = edge[middle] + distance(edge[middle + 1], edge[middle]) * along;
  Leaflet made = closed;
  for (std::size_t i = 0; i < n_places; ++i) {
    made.edge[i] = edge[i] - annulus.hinge(k, i).point;
    made.line[i] = closed.body[i] / closed.whole[i] * made.edge[i];
    made.start[i] = 1.0 / 3 * closed.body[i] * unit(made.line[i]);
    made.turn[i] = 1.0 / 3 * closed.body[i];
  }
  return made;
}

// A leaflet first turns about its hinges, and then becomes straight. Lengths therefore change later than angles. If both changed
// at the same pace, neighbouring leaflets would touch during the motion.
double behind(double share) { return share * share; }

// Swings a vector about its hinge: blends the vectors of the two states, and gives the result the blended length.
Vec3 swung(Vec3 from, Vec3 to, double share) {
  const Vec3 blended = riis::blend(from, to, share);
  const double size = length(blended);
  return size > 0 ? riis::blend(length(from), length(to), behind(share)) / size * blended : blended;
}

// Returns the length of the middle meridian, down to the free edge.
double middle_length(const Leaflet &leaflet) {
  const Vec3 on_line = leaflet.line[middle], on_edge = leaflet.edge[middle];
  return distance(on_line, on_edge) +
         arc_length(meridian({0, 0, 0}, leaflet.start[middle], leaflet.turn[middle], on_line, on_edge));
}

// Returns the leaflet after every place has moved by its share of the way from closed to open. Each control point swings about
// its hinge. After the swing, the leaflet is stretched until its middle has the right length. The stretch becomes smaller towards
// the commissures. Finally, bumps lift the leaflet. This lift is along z, so it does not change how far apart the leaflets are
// seen along z.
Leaflet moved(const Leaflet &closed, const Leaflet &open, const AtPlaces<double> &shares) {
  Leaflet made = closed;
  for (std::size_t i = 0; i < n_places; ++i) {
    const double share = shares[i];
    for (AtPlaces<Vec3> Leaflet::*points : {&Leaflet::edge, &Leaflet::line, &Leaflet::start})
      (made.*points)[i] = swung((closed.*points)[i], (open.*points)[i], share);
    made.turn[i] = riis::blend(closed.turn[i], open.turn[i], behind(share));
  }
  const double stretch = riis::blend(middle_length(closed), middle_length(open), shares[middle]) / middle_length(made);
  for (std::size_t i = 0; i < n_places; ++i) {
    const double here = 1 + (stretch - 1) * (1 - std::abs(2 * u_of(i) - 1));
    for (AtPlaces<Vec3> Leaflet::*points : {&Leaflet::edge, &Leaflet::line, &Leaflet::start})
      (made.*points)[i] = here * (made.*points)[i];
    made.turn[i] = here * made.turn[i];
    const double lift = (1 - shares[i]) * closed.lift[i];
    made.edge[i].z += lift;
    made.line[i].z += lift;
    made.start[i].z += lift_of_start * lift;
  }
  return made;
}

// The curves of a leaflet, from the commissure before it to the commissure after it.
struct LeafletCurves {
  std::array<Bezier, n_cells> line, edge;
  AtPlaces<Bezier> meridians, zone;  // down to the coaptation line, and from there to the free edge
};

LeafletCurves curves_of(const Leaflet &leaflet, const Annulus &annulus, std::size_t k) {
  AtPlaces<Vec3> line, edge;
  for (std::size_t i = 0; i < n_places; ++i) {
    line[i] = annulus.hinge(k, i).point + leaflet.line[i];
    edge[i] = annulus.hinge(k, i).point + leaflet.edge[i];
  }
  LeafletCurves made{parts(line), parts(edge), {}, {}};
  const AtPlaces<Vec3> on_line = on_parts(made.line), on_edge = on_parts(made.edge);
  for (std::size_t i = 0; i < n_places; ++i) {
    const Vec3 from = on_line[i], to = on_edge[i];
    made.meridians[i] = meridian(annulus.hinge(k, i).point, leaflet.start[i], leaflet.turn[i], from, to);
    made.zone[i] = Bezier::line(from, to);
  }
  return made;
}

// A valve between its closed state and its open state. The two states may have different sizes.
class Motion {
 public:
  Motion(const ValveState &closed, const ValveState &open, std::size_t n_leaflets)
      : closed_(closed.values, n_leaflets),
        open_(open.values, n_leaflets),
        has_one_state_(&closed == &open),
        annulus_when_closed_(annulus_of(closed_)) {
    const Annulus of_open = has_one_state_ ? annulus_when_closed_ : annulus_of(open_);
    const Bumps bumps = closed_.bumps(), bumps_when_open = open_.bumps();
    for (std::size_t k = 0; k < n_leaflets; ++k) {
      closed_leaflets_.push_back(closed_leaflet(closed_, annulus_when_closed_, k, bumps));
      const Leaflet of_open_sizes =
          has_one_state_ ? closed_leaflets_.back() : closed_leaflet(open_, of_open, k, bumps_when_open);
      open_leaflets_.push_back(open_leaflet(open_, of_open, k, of_open_sizes));
      local_.emplace_back();
      for (std::size_t i = 0; i < n_places; ++i)
        local_.back()[i] = {bumps.at(k, u_of(i)).closed, bumps_when_open.at(k, u_of(i)).open, 0};
    }
  }

  Annulus annulus(double opening) const {
    if (has_one_state_) return annulus_when_closed_;
    std::array<Bezier, 4> lap = closed_.annulus();
    Vector<double> commissures = closed_.commissures();
    const std::array<Bezier, 4> open_lap = open_.annulus();
    const Vector<double> open_commissures = open_.commissures();
    for (std::size_t i = 0; i < lap.size(); ++i) view(lap)[i] = riis::blend(view(lap)[i], view(open_lap)[i], opening);
    for (std::size_t i = 0; i < commissures.size(); ++i)
      commissures[i] = riis::blend(commissures[i], open_commissures[i], opening);
    return {lap, commissures};
  }

  Vector<LeafletCurves> leaflets(const Annulus &annulus, double opening) const {
    Vector<LeafletCurves> made;
    for (std::size_t k = 0; k < local_.size(); ++k) {
      AtPlaces<double> shares;
      for (std::size_t i = 0; i < n_places; ++i)
        shares[i] = riis::blend(local_[k][i].closed, local_[k][i].open, opening);
      made.push_back(curves_of(moved(closed_leaflets_[k], open_leaflets_[k], shares), annulus, k));
    }
    return made;
  }

  Vec3 shift(double opening) const {
    return riis::blend(vector_of(closed_.values_of(translation)), vector_of(open_.values_of(translation)), opening);
  }

 private:
  Sizes closed_, open_;
  bool has_one_state_;
  Annulus annulus_when_closed_;
  Vector<Leaflet> closed_leaflets_, open_leaflets_;
  Vector<AtPlaces<LocalOpening>> local_;
};

// Patches run clockwise and down from the annulus, so S_u x S_v points into the ventricle, downstream.
PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening, std::size_t n_leaflets) {
  const Motion motion(closed, open, n_leaflets);
  const double from = std::max(opening - rate_step, 0.0), to = std::min(opening + rate_step, 1.0);
  const Annulus annulus = motion.annulus(opening);
  const auto now = motion.leaflets(annulus, opening), before = motion.leaflets(motion.annulus(from), from),
             after = motion.leaflets(motion.annulus(to), to);
  PatchSet set;
  const auto add = [&](std::size_t k, const auto &curve_in) {
    Bezier change = rate(curve_in(before[k]), curve_in(after[k]));
    for (Vec3 &q : change.control) q = 1 / (to - from) * q;
    set.rates.push_back({change});
    return set.add(curve_in(now[k]));
  };
  const auto add_across = [&](std::size_t k, std::size_t i) -> std::array<Side, 2> {
    return {add(k, [&](const LeafletCurves &of) { return of.meridians[i]; }),
            add(k, [&](const LeafletCurves &of) { return of.zone[i]; })};
  };
  const PatchImage image{Mirror::none, rotation_xyz({0, 0, 0}), motion.shift(opening), 0, 0};
  std::int32_t n_images = 0;
  const auto add_patch = [&](std::size_t k, Side v0, Side v1, Side u0, Side u1, AttachedSide attached) {
    PatchImage own = image;
    own.leaflet_id = static_cast<std::int32_t>(k);
    own.patch_id = n_images++;
    set.patches.push_back({{v0.curve, true}, {v1.curve, true}, u0, u1, {own}, 0, attached});
  };
  Vector<std::array<Side, 2>> commissures;  // neighbours share these curves
  for (std::size_t k = 0; k < n_leaflets; ++k) commissures.push_back(add_across(k, n_cells));
  for (std::size_t k = 0; k < n_leaflets; ++k) {
    std::array<Side, 2> last = commissures[(k + n_leaflets - 1) % n_leaflets];
    for (std::size_t i = 0; i < n_cells; ++i) {
      const std::array<Side, 2> next = i + 1 < n_cells ? add_across(k, i + 1) : commissures[k];
      const Side line = add(k, [&](const LeafletCurves &of) { return view(of.line)[i]; });
      const Side edge = add(k, [&](const LeafletCurves &of) { return view(of.edge)[i]; });
      const Curve base = annulus.between_places(k, i);
      set.rates.emplace_back(base.spans().size(), rate(base.spans().front(), base.spans().front()));
      add_patch(k, set.add(base), line, next[0], last[0], AttachedSide::v0);
      add_patch(k, line, edge, next[1], last[1], AttachedSide::none);
      last = next;
    }
  }
  return set;
}

// Refuses values that do not fit together. The message names the size that is out of proportion.
void check_values(const ParameterValues &values, const ValveKind &kind, std::size_t n_leaflets) {
  const Sizes sizes(values, n_leaflets);
  const auto name = [&](std::size_t position) { return kind.parameters[position].name.c_str(); };
  const auto name_of = [&](Parameter parameter) { return name(Sizes::position(parameter, n_leaflets)); };
  const Reference across{name_of(depth), sizes.of(depth)};
  const auto check = [&](std::size_t position, double least, double most) {
    check_ratio(kind.parameters[position], values[position], across, least, most);
  };
  for (std::size_t k = 0; k < n_leaflets; ++k) check(k, 0.1, 2);
  for (const auto &[parameter, least, most] : {std::tuple(width, 0.5, 2.0),
                                               {saddle_height, 0.0, 0.5},
                                               {commissure_length, 0.02, 1.0},
                                               {tenting_height, 0.0, 1.0},
                                               {gap, 0.0005, 0.1},
                                               {translation, 0.0, 100.0}})
    check(Sizes::position(parameter, n_leaflets), least, most);
  const Vector<double> commissures = sizes.commissures();
  for (std::size_t k = 0; k < n_leaflets; ++k)
    if (!(commissures[k + 1] - commissures[k] >= least_ratio))
      fail(RIIS_INVALID_PARAMETER, "the shares of the annulus leave ", commissures[k + 1] - commissures[k],
           " to one leaflet; it must be at least ", least_ratio, ": look at ", name_of(flat_ratio),
           " and anterior_ratio");
  const Annulus annulus = annulus_of(sizes);
  const Vec3 meeting = annulus.meeting();
  const Bumps bumps = sizes.bumps();
  for (std::size_t k = 0; k < n_leaflets; ++k) {
    const double to_meeting = distance(level(annulus.hinge(k, middle).point), meeting);
    if (!(to_meeting >= least_way * across.size && to_meeting <= (1 - least_way) * across.size))
      fail(RIIS_INVALID_PARAMETER, "the leaflets would meet at a distance of ", to_meeting,
           " from the middle of the annulus of the leaflet of ", name(k), "; it must be from ", least_way, " to ",
           1 - least_way, " times ", across.name, ", which is ", across.size, ": look at the leaflets' lengths");
    const double inwards = sizes.of(commissure_length) * sine_cosine_degrees(sizes.of(commissure_angle)).cosine,
                 room = distance(level(annulus.hinge(k, n_cells).point), meeting);
    if (!(inwards <= most_of_way * room))
      fail(RIIS_INVALID_PARAMETER, "commissure_length is ", sizes.of(commissure_length), "; inwards that is ", inwards,
           ", which must be at most ", most_of_way, " times the distance ", room,
           " from a commissure to the meeting point");
    const Leaflet leaflet = closed_leaflet(sizes, annulus, k, bumps);
    const double zone = sizes.length(k) - leaflet.body[middle];
    if (!(zone >= (1 - rounding_of_zone) * least_coaptation * sizes.length(k)))
      fail(RIIS_INVALID_PARAMETER, name(k), " is ", sizes.length(k),
           ", too short for its part of the annulus with tenting_height ", sizes.of(tenting_height));
    for (std::size_t i = 0; i < n_places; ++i) {
      if (!(leaflet.turn[i] > 0))
        fail(RIIS_INVALID_PARAMETER, "closed, the coaptation line would lie above the annulus: tenting_height is ",
             sizes.of(tenting_height), ", saddle_height ", sizes.of(saddle_height), ", commissure_coaptation ",
             sizes.of(commissure_coaptation), ", commissure_angle ", sizes.of(commissure_angle));
      const double lift = leaflet.lift[i];
      if (!(std::abs(lift) <= across.size))
        fail(RIIS_INVALID_PARAMETER, "bumps lift the leaflet of ", name(k), " by ", lift, "; that must be at most ",
             across.name, ", which is ", across.size);
    }
    if (!(zone <= most_coaptation * sizes.length(k)))
      fail(RIIS_INVALID_PARAMETER, name(k), " is ", sizes.length(k), ", of which ", zone,
           " would coapt; that must be at most ", most_coaptation,
           " of the length: the leaflets are too long for the annulus");
  }
}

// The sizes that differ between the kinds of valves. Lengths are in centimetres. The sources of the values are in
// docs/theory/atrioventricular.md.
struct KindSizes {
  Vector<ParameterSpec> of_leaflets;
  ParameterSpec width, depth, flat_ratio;
  double saddle_height, commissure_length, open_angle;
};

// clang-format off
template <std::size_t n_leaflets, const ValveKind &(*own_kind)()>
const ValveKind *new_kind(const char *name, KindSizes sizes) {
  constexpr double shortest = 1e-9, longest = 1e9;
  const char *length = "length", *degree = "degree", *number = "1";
  const Vector<ParameterSpec> common{
    sizes.width, sizes.depth,
    {"flatness", number, "shape of the annulus, from 0 (an ellipse) to 1 (the letter D)", 1, {1}, 0, 1},
    {"saddle_height", length, "height of the annulus from its lowest to its highest points",
     1, {sizes.saddle_height}, 0, longest},
    sizes.flat_ratio,
    {"commissure_length", length, "length of the leaflets at the commissures of the closed valve",
     1, {sizes.commissure_length}, shortest, longest},
    {"commissure_angle", degree, "direction of the closed commissures: 0 is inwards, 90 is straight down", 1, {70}, 20, 90},
    {"commissure_coaptation", number, "height of the coaptation zone at the commissures, as a multiple of commissure_length",
     1, {0.5}, 0.05, 0.8},
    {"tenting_height", length, "depth of the closed valve's coaptation below the mean height of the annulus",
     1, {0.4}, 0, longest},
    {"gap", length, "distance between closed leaflets in the middle of the coaptation zone", 1, {0.03}, shortest, longest},
    {"belly", number, "length of a closed leaflet's tangent at the annulus, as a multiple of the leaflet's horizontal reach",
     1, {0.55}, 0.1, 0.9},
    {"turn", number, "length of a closed leaflet's tangent at the coaptation line, as a multiple of the leaflet's drop",
     1, {0.5}, 0.1, 0.9},
    {"open_angle", degree, "direction of the open leaflets: 0 is inwards, 90 is straight down", 1, {sizes.open_angle}, 30, 90},
    {"translation", length, "shift of the valve", 3, {0, 0, 0}, -longest, longest},
    opening_spec("from 0 (closed) to 1 (open)", 0),
  };
  const std::size_t opening = sizes.of_leaflets.size() + opening_;
  Vector<ParameterSpec> specs = std::move(sizes.of_leaflets);
  specs.insert(specs.end(), common.begin(), common.end());
  auto *kind = new ValveKind(with_skirt({name, std::move(specs), opening, true,
    [](const ParameterValues &values) { check_values(values, own_kind(), n_leaflets); },
    [](const ValveState &closed, const ValveState &open, double at) { return make_patches(closed, open, at, n_leaflets); },
    nullptr}, SkirtAxis::vertical));
  kind->has_exact_contacts = true;
  add_bump_specs(kind->parameters, n_leaflets, BumpLift::yes);
  return kind;
}

ParameterSpec length_spec(const char *name, double value) {
  return {name, "length", "length of the leaflet's middle, from the annulus to the free edge", 1, {value}, 1e-9, 1e9};
}
ParameterSpec diameter_spec(const char *name, const char *description, double value) {
  return {name, "length", description, 1, {value}, 1e-9, 1e9};
}
ParameterSpec ratio_spec(const char *name, const char *description, double value) {
  return {name, "1", description, 1, {value}, 0.05, 0.9};
}
// clang-format on

}  // namespace

// Seen along z, the outline is an ellipse with a flat side. A larger `flatness` makes the flat side flatter, and moves it nearer
// to the middle.
std::array<Bezier, 4> saddle_annulus(const SaddleAnnulus &annulus) {
  constexpr double circle = 0.5523;  // length of the end tangents of a quarter of a circle, in radii
  const double sign = annulus.flat_side == FlatSide::at_positive_y ? 1 : -1, high = 0.5 * annulus.saddle_height;
  const double half = 0.5 * annulus.width, near = (0.5 - 0.12 * annulus.flatness) * annulus.depth,
               far = annulus.depth - near, reach = circle * half, flat_reach = (circle + 0.3 * annulus.flatness) * half;
  // The outline passes these points counter-clockwise. At each of these points, the tangent is along x or along y.
  const std::array<Vec3, 4> at{
      {{0, sign * near, high}, {-sign * half, 0, -high}, {0, -sign * far, high}, {sign * half, 0, -high}}};
  const std::array<Vec3, 4> along{{{-sign, 0, 0}, {0, -sign, 0}, {sign, 0, 0}, {0, sign, 0}}};
  const std::array<double, 4> out{flat_reach, circle * far, reach, circle * near},
      in{flat_reach, circle * near, reach, circle * far};
  std::array<Bezier, 4> made{};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    view(made)[i] = Bezier::cubic(view(at)[i], view(at)[i] + view(out)[i] * view(along)[i],
                                  view(at)[next] - view(in)[next] * view(along)[next], view(at)[next]);
  }
  return made;
}

// Each kind is made at its first use. It is never destroyed, so that it serves until the process ends.
const ValveKind &mitral_coapting_valve_kind() {
  static const ValveKind &kind = *new_kind<2, mitral_coapting_valve_kind>(
      "mitral_coapting",
      {{length_spec("anterior_length", 2.5), length_spec("posterior_length", 1.6)},
       diameter_spec("ALPM_diameter", "width of the annulus, from the anterolateral to the posteromedial side", 3.6),
       diameter_spec("AP_diameter", "depth of the annulus, from the posterior to the anterior point", 2.7),
       ratio_spec("anterior_ratio", "the anterior leaflet's share of the annulus", 0.41),
       0.6,
       0.8,
       79});
  return kind;
}

const ValveKind &tricuspid_valve_kind() {
  static const ValveKind &kind = *new_kind<3, tricuspid_valve_kind>(
      "tricuspid",
      {{length_spec("anterior_length", 2.5), length_spec("septal_length", 2.0), length_spec("posterior_length", 2.3),
        ratio_spec("anterior_ratio", "the anterior leaflet's share of the annulus", 0.36)},
       diameter_spec("AP_diameter", "width of the annulus, from the anterior to the posterior point", 3.8),
       diameter_spec("SL_diameter", "depth of the annulus, from the septal to the lateral point", 3.1),
       ratio_spec("septal_ratio", "the septal leaflet's share of the annulus", 0.34),
       0.4,
       1.2,
       75});
  return kind;
}

}  // namespace riis
