// SPDX-License-Identifier: Apache-2.0
#include "measures/leaflet_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "landmarks/fit.hpp"

namespace riis {

AlongAxis::AlongAxis(Vec3 axis, Vec3 origin, Vec3 sideways) : axis_(axis), origin_(origin) {
  Vec3 across = cross(axis, sideways);
  if (!(length(across) > 0.1 * length(sideways))) {
    const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
    across = cross(axis, x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  }
  y_axis_ = (1 / length(across)) * across;
  x_axis_ = cross(y_axis_, axis);
}

namespace {

// A part of an edge of the outline. In every direction from the centre to this part, no other edge is farther away. The part
// begins at the share `from` of the edge, ends at the share `to`, and runs counter-clockwise.
struct FarPart {
  std::size_t edge;
  double from, to;
};

double cross_of(const PlanePoint &a, const PlanePoint &b) { return a[0] * b[1] - a[1] * b[0]; }
double dot_of(const PlanePoint &a, const PlanePoint &b) { return a[0] * b[0] + a[1] * b[1]; }
PlanePoint difference(const PlanePoint &a, const PlanePoint &b) { return {a[0] - b[0], a[1] - b[1]}; }
PlanePoint between(const PlanePoint &a, const PlanePoint &b, double share) {
  return {(1 - share) * a[0] + share * b[0], (1 - share) * a[1] + share * b[1]};
}

// For each direction from (0, 0), finds the farthest edge. The directions are in counter-clockwise order.
class FarthestEdges {
 public:
  explicit FarthestEdges(const std::vector<PlaneSegment> &edges) : edges_(edges) {
    std::vector<Turn> turns;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const auto &[a, b] = edges[i];
      const double turning = cross_of(a, b);
      if (!(std::abs(turning) > 1e-14 * std::sqrt(dot_of(a, a) * dot_of(b, b)))) continue;  // seen end on
      const double at_a = arc_tangent(a[1], a[0]), at_b = arc_tangent(b[1], b[0]);
      turns.push_back(turning > 0 ? Turn{i, at_a, at_b} : Turn{i, at_b, at_a});
      for (const double angle : {at_a, at_b}) angles_.push_back(angle);
    }
    std::sort(angles_.begin(), angles_.end());
    angles_.erase(std::unique(angles_.begin(), angles_.end()), angles_.end());
    best_.assign(angles_.size(), {none, 0});
    for (std::size_t at = 0; at < angles_.size(); ++at) middles_.push_back(ray_at(angles_[at] + 0.5 * width(at)));
    for (const Turn &turn : turns) add(turn);
  }

  // Returns the parts, or nothing if there is a gap of more than half a turn without an edge.
  std::vector<FarPart> parts() const {
    std::vector<FarPart> made;
    double gap = 0, widest = 0;
    for (std::size_t k = 0; k < 2 * best_.size(); ++k) {  // twice round, because a gap may pass the first direction
      const std::size_t at = k % best_.size(), edge = best_[at].edge;
      gap = edge == none ? gap + width(at) : 0;
      widest = std::max(widest, gap);
      if (k >= best_.size() || edge == none) continue;
      const double from = share_at(edge, angles_[at]), to = share_at(edge, angles_[(at + 1) % angles_.size()]);
      if (!made.empty() && made.back().edge == edge && best_[at - 1].edge == edge)
        made.back().to = to;
      else
        made.push_back({edge, from, to});
    }
    if (!(widest < pi)) made.clear();
    return made;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Turn {
    std::size_t edge;
    double from, to;
  };
  struct Best {
    std::size_t edge;
    double distance;
  };

  static PlanePoint ray_at(double angle) {
    const auto [sine, cosine] = sine_cosine(angle);
    return {cosine, sine};
  }

  // Returns the angle between a direction and the next direction.
  double width(std::size_t at) const {
    return at + 1 < angles_.size() ? angles_[at + 1] - angles_[at] : angles_[0] + 2 * pi - angles_[at];
  }

  // Returns where the ray in a direction meets the edge, as a share of the edge from 0 to 1.
  double share_at(std::size_t edge, double angle) const {
    const auto &[a, b] = edges_[edge];
    if (arc_tangent(a[1], a[0]) == angle) return 0;
    if (arc_tangent(b[1], b[0]) == angle) return 1;
    return share_on(edge, ray_at(angle));
  }
  double share_on(std::size_t edge, const PlanePoint &ray) const {
    const auto &[a, b] = edges_[edge];
    const double of_a = cross_of(ray, a), of_b = cross_of(ray, b);
    return std::clamp(of_a / (of_a - of_b), 0.0, 1.0);
  }

  // An edge covers less than half a turn of directions, so a ray from the centre meets the edge only once.
  void add(const Turn &turn) {
    const auto place = [&](double angle) {
      return static_cast<std::size_t>(std::lower_bound(angles_.begin(), angles_.end(), angle) - angles_.begin());
    };
    const auto &[a, b] = edges_[turn.edge];
    for (std::size_t at = place(turn.from), end = place(turn.to); at != end; at = (at + 1) % angles_.size()) {
      const PlanePoint p = between(a, b, share_on(turn.edge, middles_[at]));
      const double distance = dot_of(p, p);
      if (best_[at].edge == none || distance > best_[at].distance) best_[at] = {turn.edge, distance};
    }
  }

  const std::vector<PlaneSegment> &edges_;
  std::vector<double> angles_;       // the directions of the ends of edges, ascending
  std::vector<PlanePoint> middles_;  // rays between a direction and the next one
  std::vector<Best> best_;           // the farthest edges on these rays
};

// The farthest edges of a boundary, seen along an axis.
struct SeenParts {
  AlongAxis seen;
  std::vector<PlaneSegment> edges;
  std::vector<FarPart> parts;
};

SeenParts parts_of(const LeafletBoundary &boundary, const AlongAxis &seen) {
  SeenParts made{seen, {}, {}};
  made.edges.reserve(boundary.edges.size());
  for (const BoundaryEdge &edge : boundary.edges) made.edges.push_back({seen(edge.from), seen(edge.to)});
  made.parts = FarthestEdges(made.edges).parts();
  return made;
}

// Returns the two ends of a part in the plane.
PlaneSegment ends_of(const SeenParts &from, const FarPart &part) {
  const auto &[a, b] = from.edges[part.edge];
  return {between(a, b, part.from), between(a, b, part.to)};
}

// Returns the centroid of a polygon around (0, 0).
PlanePoint centroid_of(const std::vector<PlanePoint> &corners) {
  double whole = 0;
  PlanePoint sum{0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlanePoint &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double area = 0.5 * cross_of(a, b);
    whole += area;
    for (std::size_t k = 0; k < 2; ++k) sum[k] += area * (a[k] + b[k]) / 3;
  }
  return {sum[0] / whole, sum[1] / whole};
}

std::vector<PlanePoint> corners_of(const SeenParts &from) {
  std::vector<PlanePoint> corners;
  for (const FarPart &part : from.parts)
    for (const PlanePoint &end : ends_of(from, part))
      if (corners.empty() || corners.back() != end) corners.push_back(end);
  return corners;
}

// Joins the farthest edges in space by straight lines, and returns the vector area of this closed line.
Vec3 vector_area(const LeafletBoundary &boundary, const SeenParts &from) {
  std::vector<Vec3> points;
  for (const FarPart &part : from.parts) {
    const BoundaryEdge &edge = view(boundary.edges)[static_cast<std::int64_t>(part.edge)];
    for (const double share : {part.from, part.to}) points.push_back(mix(edge.from, edge.to, share));
  }
  Vec3 area{0, 0, 0};
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    area = area + 0.5 * cross(points[i] - points[0], points[i + 1] - points[0]);
  return area;
}

double area_of_corners(const std::vector<PlanePoint> &corners) {
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    area += 0.5 * cross_of(corners[i], corners[(i + 1) % corners.size()]);
  return area;
}

// Returns the area of a polygon around (0, 0), divided by the area of a circle with the same perimeter.
double roundness_of(const std::vector<PlanePoint> &corners) {
  double whole = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlanePoint along = difference(corners[(i + 1) % corners.size()], corners[i]);
    whole += std::sqrt(dot_of(along, along));
  }
  return whole > 0 ? 4 * pi * area_of_corners(corners) / (whole * whole) : 0;
}

// A view along the vector area of the farthest edges, and the roundness of their outline: 1 for a circle.
struct FoundView {
  SeenParts parts;
  double roundness;
};

// Limits on the number of turns of the axis. From a good first axis, few turns suffice. More turns would do harm if a free edge
// is as far out as the attachment: each turn may then take one or the other as the farthest edge. A bad first axis needs many
// turns.
constexpr int few_turns = 4, many_turns = 40;

// Repeats two steps at most n_turns times: turns the axis to the vector area of the farthest edges, and moves the centre to the
// middle of their outline. `about`, of length 1, is the axis at the beginning. With `keeps_axis` only the centre moves.
std::optional<FoundView> view_from(const LeafletBoundary &boundary, Vec3 about, Vec3 sideways, Vec3 centre, int n_turns,
                                   bool keeps_axis = false) {
  constexpr double least_roundness = 0.01, still = 1e-10;
  for (int i = 0;; ++i) {
    SeenParts seen = parts_of(boundary, AlongAxis(about, centre, sideways));
    const std::vector<PlanePoint> corners = corners_of(seen);
    const double roundness = roundness_of(corners);
    const Vec3 area = vector_area(boundary, seen);
    const double size = length(area);
    if (!(roundness > least_roundness && size > 0)) return std::nullopt;
    const Vec3 axis = keeps_axis ? about : (1 / size) * area;
    const PlanePoint shift = centroid_of(corners);
    const bool is_still = distance(axis, about) < still && dot_of(shift, shift) < still * still * size;
    if (is_still || i == n_turns) return FoundView{std::move(seen), roundness};
    about = axis, centre = seen.seen.in_space(shift);
  }
}

// The centroid of the edges, and the directions of their spread, in ascending order of spread. Each direction has the length 1.
struct BoundarySpread {
  Vec3 centre;
  std::vector<Vec3> directions;
};

BoundarySpread spread_of(const LeafletBoundary &boundary) {
  double whole = 0;
  Vec3 centre{0, 0, 0};
  for (const auto &[a, b, piece] : boundary.edges) {
    const double size = distance(a, b);
    if (!(size > 0)) continue;
    whole += size;
    centre = mix(centre, mix(a, b, 0.5), size / whole);
  }
  std::vector<double> moments(9, 0);
  for (const auto &[a, b, piece] : boundary.edges) {
    const Vec3 from_centre = mix(a, b, 0.5) - centre;
    const std::array<double, 3> x{from_centre.x / whole, from_centre.y / whole, from_centre.z / whole};
    for (std::size_t i = 0; i < 9; ++i) moments[i] += distance(a, b) / whole * x[i / 3] * x[i % 3];
  }
  BoundarySpread made{centre, {}};
  const Eigen found = symmetric_eigen(moments, 3);
  for (std::size_t i = 0; i < 3; ++i)
    made.directions.push_back({found.vectors[3 * i], found.vectors[3 * i + 1], found.vectors[3 * i + 2]});
  return made;
}

// Returns the roundest view of edges. The direction in which the edges spread least is the first axis. Another direction is taken
// only if it leads to a clearly rounder outline. The triangles' normals determine only the sign of the axis, because triangles
// may be turned over.
std::optional<FoundView> best_view(const LeafletBoundary &boundary, const BoundarySpread &spread) {
  constexpr double favour = 1.15;
  std::optional<FoundView> best;
  for (const Vec3 direction : spread.directions) {
    const Vec3 about = dot(direction, boundary.normal) < 0 ? -direction : direction;
    const bool is_first = direction == spread.directions[0];
    std::optional<FoundView> other =
        view_from(boundary, about, {0, 0, 0}, spread.centre, is_first ? few_turns : many_turns);
    if (other && is_first) other->roundness *= favour;
    if (other && (!best || other->roundness > best->roundness)) best = std::move(other);
  }
  return best;
}

// The high points of a crown, where neighbouring pieces meet, and the lowest point of each piece. A crown is a closed line on
// which each piece forms a single run of edges, from one high point to the next.
struct Crown {
  std::vector<Vec3> highs, lows;
  double height;  // the least height of a high point above the lowest points of its two pieces
};

// Returns the crown of a closed line, or nothing if a piece has no run or several runs. The axis may point up or down.
std::optional<Crown> crown_of(const std::vector<BoundaryEdge> &line, Vec3 axis) {
  std::vector<std::size_t> begins;  // the first edges of the runs
  std::vector<std::int64_t> pieces;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i].piece != line[(i + line.size() - 1) % line.size()].piece)
      begins.push_back(i), pieces.push_back(line[i].piece);
  std::sort(pieces.begin(), pieces.end());
  if (begins.size() < 2 || std::adjacent_find(pieces.begin(), pieces.end()) != pieces.end()) return std::nullopt;
  Crown crown{{}, {}, std::numeric_limits<double>::infinity()};
  Vec3 above{0, 0, 0};  // from the line's middle to the middle of the high points
  for (const std::size_t begin : begins) {
    crown.highs.push_back(line[begin].from);
    above = above + (1 / static_cast<double>(begins.size())) * (line[begin].from - line[0].from);
  }
  for (const BoundaryEdge &edge : line)
    above = above - (1 / static_cast<double>(line.size())) * (edge.from - line[0].from);
  const Vec3 upwards = dot(above, axis) < 0 ? -axis : axis;
  for (std::size_t k = 0; k < begins.size(); ++k) {
    const std::size_t end = begins[(k + 1) % begins.size()];
    Vec3 low = line[begins[k]].from;
    for (std::size_t i = begins[k]; i != end; i = (i + 1) % line.size())
      if (dot(upwards, line[i].from) < dot(upwards, low)) low = line[i].from;
    crown.lows.push_back(low);
    for (const std::size_t high : {begins[k], end})
      crown.height = std::min(crown.height, dot(upwards, line[high].from - low));
  }
  return crown;
}

// Adds the second moments of points about their mean, times a weight.
void add_moments(const std::vector<Vec3> &points, double weight, std::vector<double> &moments) {
  Vec3 mean{0, 0, 0};
  for (const Vec3 point : points) mean = mean + (1 / static_cast<double>(points.size())) * (point - points[0]);
  for (const Vec3 point : points) {
    const Vec3 from_mean = point - points[0] - mean;
    const std::array<double, 3> x{from_mean.x, from_mean.y, from_mean.z};
    for (std::size_t i = 0; i < 9; ++i) moments[i] += weight * x[i / 3] * x[i % 3];
  }
}

// Returns the axis of a line at which cusps are attached, or nothing if the line is no high crown. The axis is at right angles to
// the plane of the lowest points of the cusps. Two cusps have only two lowest points, so the high points also help to determine
// the plane. `axis` is the axis at the beginning, and `radius` is the radius of the line.
std::optional<Vec3> axis_of_crown(const std::vector<BoundaryEdge> &line, Vec3 axis, double radius) {
  constexpr double least_height = 0.5, weight_of_highs = 0.01, least_spread = 0.1, still = 1e-12;
  constexpr int most_turns = 10;
  for (int turn = 0; turn < most_turns; ++turn) {
    const std::optional<Crown> crown = crown_of(line, axis);
    if (!crown || !(crown->height > least_height * radius)) return std::nullopt;
    std::vector<double> moments(9, 0);
    add_moments(crown->lows, 1 / (radius * radius), moments);
    add_moments(crown->highs, weight_of_highs / (radius * radius), moments);
    const Eigen found = symmetric_eigen(moments, 3);
    if (!(found.values[1] > least_spread * weight_of_highs)) return std::nullopt;  // all points are on one line
    const Vec3 least{found.vectors[0], found.vectors[1], found.vectors[2]};
    const Vec3 turned = dot(least, axis) < 0 ? -least : least;
    if (distance(turned, axis) < still) break;
    axis = turned;
  }
  return axis;
}

// Returns the view of triangles from arrays. A closed line can be the attachment only if its outline is nearly as large and as
// round as the outline of all edges. Of several such lines, the roundest is taken. A line that follows the attachment of one
// leaflet and the free edge of another leaflet is oblique, and thus less round. The axis is the axis of the line's crown. If the
// line has no crown, the axis is its vector area.
std::optional<FoundView> view_of_arrays(const LeafletBoundary &boundary, const BoundarySpread &spread) {
  constexpr double least_roundness = 0.95;  // as a share of the outline's roundness
  std::optional<FoundView> of_all = best_view(boundary, spread);
  std::optional<FoundView> best;
  double most_round = of_all ? least_roundness * of_all->roundness : 0;
  for (const ClosedLine &line : boundary.perhaps_attached) {
    const LeafletBoundary held{line.edges, {}, {}, boundary.normal};
    if (held.edges.empty()) continue;
    const std::optional<FoundView> of_held = best_view(held, spread_of(held));
    if (!of_held) continue;
    const AlongAxis &seen = of_held->parts.seen;
    const std::optional<Vec3> crown = axis_of_crown(line.edges, seen.axis(), std::sqrt(line.area / pi));
    std::optional<FoundView> along =
        view_from(boundary, crown ? *crown : seen.axis(), {0, 0, 0}, seen.in_space({0, 0}), few_turns, true);
    if (!along) continue;
    const bool is_large = line.area > least_attached_share * area_of_corners(corners_of(along->parts));
    if (is_large && of_held->roundness > most_round) most_round = of_held->roundness, best = std::move(along);
  }
  return best ? best : of_all;
}

// Returns the factor by which the pieces must grow about their centroids until the first two neighbours meet. If a factor above
// 1.05 would be needed, the gaps are probably intended. The result then falls as the needed factor rises, and is 1 if that factor
// is at least 1.1. Where the outline is at less than 45 degrees to a ray from the centre, it follows the end of a piece, not its
// attachment. A ray through the gap between two neighbours may meet a third piece, which is nearer to the centre. The end of a
// piece is therefore joined to the end that is closest after the growth.
double growth_of(const LeafletBoundary &boundary, const SeenParts &from) {
  constexpr double most = 0.05, closeness = 0.15, widest_gap = 0.25;  // shares, and the tangent of an angle
  struct Run {
    std::int64_t piece;
    PlanePoint begin, end;
  };
  std::vector<Run> runs;
  const auto is_close = [&](const PlanePoint &a, const PlanePoint &b) {
    const PlanePoint apart = difference(a, b);
    return dot_of(apart, apart) < closeness * closeness * dot_of(a, a);
  };
  for (const FarPart &part : from.parts) {
    const auto [begin, end] = ends_of(from, part);
    const PlanePoint along = difference(end, begin), middle = between(begin, end, 0.5);
    if (!(cross_of(middle, along) > std::abs(dot_of(middle, along)))) continue;
    const std::int64_t piece = view(boundary.edges)[static_cast<std::int64_t>(part.edge)].piece;
    if (!runs.empty() && runs.back().piece == piece && is_close(runs.back().end, begin))
      runs.back().end = end;
    else
      runs.push_back({piece, begin, end});
  }
  const auto centroid = [&](const Run &of) { return from.seen(view(boundary.centroids)[of.piece]); };
  double least = 2 * most;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PlanePoint &p = runs[i].end;
    double closest = closeness * std::sqrt(dot_of(p, p)), wanted = 2 * most;
    for (std::size_t step = 1; step < runs.size(); ++step) {
      const Run &other = runs[(i + step) % runs.size()];
      const PlanePoint &q = other.begin, apart = difference(q, p), middle = between(p, q, 0.5);
      if (!(cross_of(p, q) <= widest_gap * dot_of(p, q))) break;
      if (runs[i].piece == other.piece) continue;
      const PlanePoint growth = difference(difference(q, centroid(other)), difference(p, centroid(runs[i])));
      const double gap = cross_of(middle, apart), reach = -cross_of(middle, growth);
      if (gap > 0 && !(reach > 0)) continue;
      const double share = gap > 0 ? gap / reach : 0;
      const PlanePoint left = {apart[0] + share * growth[0], apart[1] + share * growth[1]};
      const double distance = std::sqrt(dot_of(left, left));
      if (distance < closest) closest = distance, wanted = share;
    }
    least = std::min(least, wanted);
  }
  return 1 + (least > most ? 2 * most - least : least);
}

// Returns the boundary of pieces that have grown about their centroids.
LeafletBoundary grown_by(double factor, const LeafletBoundary &boundary) {
  LeafletBoundary grown = boundary;
  for (BoundaryEdge &edge : grown.edges)
    for (Vec3 *const end : {&edge.from, &edge.to}) *end = mix(view(boundary.centroids)[edge.piece], *end, factor);
  return grown;
}

}  // namespace

std::optional<SeenOutline> outline_of_leaflets(const LeafletBoundary &boundary,
                                               const std::optional<ValveDirections> &valve) {
  if (boundary.edges.empty()) return std::nullopt;
  const BoundarySpread spread = spread_of(boundary);
  const std::optional<FoundView> found =
      valve ? view_from(boundary, valve->axis, valve->sideways, spread.centre, few_turns, valve->keeps_axis)
            : view_of_arrays(boundary, spread);
  if (!found) return std::nullopt;
  const SeenParts &parts = found->parts;
  const double growth = growth_of(boundary, parts);
  std::vector<PlanePoint> corners = corners_of(growth > 1 ? parts_of(grown_by(growth, boundary), parts.seen) : parts);
  if (corners.empty()) return std::nullopt;
  corners.push_back(corners.front());
  std::optional<Outline> outline = closed_outline({corners}, parts.seen.rounding());
  if (!outline) return std::nullopt;
  return SeenOutline{parts.seen, std::move(*outline)};
}

}  // namespace riis
