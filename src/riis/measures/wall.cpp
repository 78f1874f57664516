// SPDX-License-Identifier: Apache-2.0
#include "measures/measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// A point from which a line leads outwards.
struct Start {
  Vec3 point, direction;
};

// Returns where the line point + t * direction meets a triangle. The test compares the signs of three volumes, one for each edge.
// For a common edge, two triangles have exactly opposite volumes, so the line cannot pass between the triangles.
std::optional<double> meets(const std::array<Vec3, 3> &corners, Vec3 point, Vec3 direction) {
  const auto [a, b, c] = corners;
  const Vec3 oa = a - point, ob = b - point, oc = c - point;
  const double of_a = dot(direction, cross(ob, oc)), of_b = dot(direction, cross(oc, oa)),
               of_c = dot(direction, cross(oa, ob));
  const bool is_positive = of_a >= 0 && of_b >= 0 && of_c >= 0, is_negative = of_a <= 0 && of_b <= 0 && of_c <= 0;
  const double sum = of_a + of_b + of_c;
  if ((!is_positive && !is_negative) || sum == 0) return std::nullopt;  // the line misses, or it lies in the plane
  return dot(direction, (of_a / sum) * oa + (of_b / sum) * ob + (of_c / sum) * oc);
}

std::vector<std::optional<double>> distances_along(const Wall &wall, const std::vector<Start> &starts, int n_threads) {
  std::vector<std::optional<double>> made(starts.size());
  parallel_for(view(starts).size(), n_threads, [&](std::int64_t i, int) {
    view(made)[i] = distance_along(wall, view(starts)[i].point, view(starts)[i].direction);
  });
  return made;
}

// Gives the skirt the same length on all sides that meet in a point. Without this, rounding could make these lengths differ.
void make_common(const std::vector<Vec3> &points, double tolerance, const std::vector<double *> &lengths) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size() && points[order[k]].x - points[order[i]].x <= tolerance; ++k)
      if (distance(points[order[i]], points[order[k]]) <= tolerance) *lengths[order[k]] = *lengths[order[i]];
}

}  // namespace

std::optional<double> distance_along(const Wall &wall, Vec3 point, Vec3 direction) {
  const Bounds &bounds = wall.scene.bounds();
  const double reach = 2 * (distance(bounds.lower, bounds.upper) + distance(point, bounds.lower));
  std::vector<std::int32_t> found;
  // The search begins with a short line, because the wall is usually near and a short line meets few triangles. If the line meets
  // no triangle, it is lengthened.
  for (double length = reach / 256;; length = std::min(4 * length, reach)) {
    std::optional<double> nearest;
    wall.scene.for_each_along(
        point - length * direction, point + length * direction, found, [&](std::int64_t triangle) {
          const std::optional<double> here = meets(wall.triangles.corners(triangle), point, direction);
          if (!here) return;
          const bool is_nearer = !nearest || std::abs(*here) < std::abs(*nearest) ||
                                 (std::abs(*here) == std::abs(*nearest) && *here > *nearest);
          if (is_nearer) nearest = here;
        });
    if (length >= reach || (nearest && std::abs(*nearest) <= length)) return nearest;
  }
}

Gap gap_of(const Attachment &attachment, const Wall &wall, int n_threads) {
  const std::int64_t n_edges = attachment.n_edges();
  if (n_edges == 0) fail(RIIS_INVALID_ARGUMENT, "surface has no attachment, so there is no gap to measure");
  std::vector<Start> starts;
  starts.reserve(static_cast<std::size_t>(2 * n_edges));
  for (std::int64_t i = 0; i < 2 * n_edges; ++i) {
    const double *p = attachment.edges.data() + 3 * i, *d = attachment.outwards.data() + 3 * i;
    starts.push_back({{p[0], p[1], p[2]}, {d[0], d[1], d[2]}});
    if (starts.back().direction == Vec3{0, 0, 0})
      fail(RIIS_INVALID_ARGUMENT, "the attachment of surface encloses no area, or reaches its axis at (", p[0], ", ",
           p[1], ", ", p[2], "), so its outward direction is not known");
  }
  const std::vector<std::optional<double>> found = distances_along(wall, starts, n_threads);
  Gap gap{{}, {0, 0, 0, {0, 0, 0}, 2 * n_edges, 0}};
  riis_gap &measures = gap.measures;
  bool is_first = true;
  double sum = 0, whole = 0;
  for (std::int64_t i = 0; i < 2 * n_edges; ++i) {
    const std::optional<double> &here = view(found)[i];
    gap.distance.push_back(here.value_or(RIIS_FAR_DISTANCE));
    if (!here) {
      ++measures.n_without_wall;
      continue;
    }
    const Vec3 p = view(starts)[i].point;
    const double weight = distance(view(starts)[i - i % 2].point, view(starts)[i - i % 2 + 1].point);
    sum += weight * *here, whole += weight;
    measures.least = is_first ? *here : std::min(measures.least, *here);
    if (is_first || *here > measures.most) {
      measures.most = *here;
      measures.widest_point[0] = p.x, measures.widest_point[1] = p.y, measures.widest_point[2] = p.z;
    }
    is_first = false;
  }
  if (whole > 0) measures.mean = sum / whole;
  return gap;
}

SkirtLengths lengths_to_wall(const PatchSet &set, const Placement &placement, const Wall &wall, double longest,
                             int n_threads) {
  const Vector<HeldSide> sides = held_sides(set);
  const double shortest = least_skirt_to_wall * attachment_radius(set, sides);
  std::vector<Start> starts;
  const SkirtDirections directions(set, sides);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Patch &patch = set.patches[sides[i].patch];
    const Curve curve = along(set, sides[i].side);
    for (const PatchImage &image : patch.images) {
      const PatchImage turn = turn_of(image);
      for (std::size_t k = 0; k <= n_skirt_parts; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(n_skirt_parts);
        const Vec3 p = curve.at(share);
        starts.push_back(
            {place(placement, place(image, p)), placement.rotation * place(turn, directions.at(i, share, p))});
      }
    }
  }
  const std::vector<std::optional<double>> found = distances_along(wall, starts, n_threads);
  const auto is_too_far = [&](const std::optional<double> &here) { return !here || *here > longest; };
  const auto n_too_far = std::count_if(found.begin(), found.end(), is_too_far);
  if (n_too_far > 0) {
    const auto first = static_cast<std::size_t>(std::find_if(found.begin(), found.end(), is_too_far) - found.begin());
    const Vec3 p = starts[first].point;
    constexpr int digits = 6;
    const Message how = found[first] ? Message("too far, at ", rounded(*found[first], digits)) : Message("missed");
    fail(RIIS_INVALID_ARGUMENT, "wall is not within longest, ", rounded(longest, digits), ", at ", n_too_far, " of ",
         found.size(), " points of the attachment; at the first, (", rounded(p.x, digits), ", ", rounded(p.y, digits),
         ", ", rounded(p.z, digits), "), it is ", how.text());
  }
  SkirtLengths lengths;
  std::vector<Vec3> ends;
  std::vector<double *> of_ends;
  const std::size_t n_points = n_skirt_parts + 1;
  for (std::size_t first = 0; first < found.size(); first += n_points) {
    lengths.emplace_back();
    for (std::size_t k = first; k < first + n_points; ++k)
      lengths.back().push_back(std::max(shortest, *found[k] / placement.scale));
  }
  for (std::size_t i = 0; i < lengths.size(); ++i)
    for (const std::size_t k : {std::size_t{0}, n_skirt_parts}) {
      ends.push_back(starts[n_points * i + k].point);
      of_ends.push_back(&lengths[i][k]);
    }
  make_common(ends, 1e-8 * placement.scale * attachment_radius(set, sides), of_ends);
  return lengths;
}

}  // namespace riis
