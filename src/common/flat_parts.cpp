// SPDX-License-Identifier: Apache-2.0
#include "common/flat_parts.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <set>
#include <tuple>

#include "common/sets.hpp"

namespace riis::flat_parts {
namespace {

// A triangle of a flat part is at most `flat_share` times the wall's size away from the part's plane. If the user points at the
// part, the limit is `pointed_share` times this size.
constexpr double flat_share = 5e-4, pointed_share = 5e-3;
// The largest angle between a triangle of a flat part and the part's plane, in degrees. Triangles with little height may lean
// more because of rounding.
constexpr double most_lean = 25;
// The least number of triangles of a flat part.
constexpr std::int64_t least_triangles = 4;
// The wall beside a flat part is measured in sectors. The sectors reach as far as `band_share` times the radius of a disc with
// the part's area.
constexpr double band_share = 0.5;
constexpr std::size_t n_sectors = 12;
// Two flat parts that touch are both unclear if their areas differ by a factor of less than `most_apart`. If the areas differ
// more, only the smaller part is unclear.
constexpr double most_apart = 10;
// A small part is an end only if its rim has at least `least_sides` sides. The wall must also be steep in a wider band, up to
// `wide_band_share` times the radius.
constexpr std::int64_t least_sides = 12;
constexpr double wide_band_share = 1.5;

using Sectors = std::array<Vector3, n_sectors>;

double degrees_between(const Vector3 &a, const Vector3 &b) {
  return 180 / pi * arc_tangent(norm(cross(a, b)), dot(a, b));
}

// `sums` has, for each sector, the sum of the wall's area vectors. Returns the mean and the least angle between these sums and
// the normal.
std::pair<double, double> angles_of(const Sectors &sums, const Vector3 &normal) {
  double n = 0, total = 0, smallest = 180;
  for (const Vector3 &sum : sums) {
    if (norm(sum) == 0) continue;
    const double angle = degrees_between(sum, normal);
    total += angle;
    smallest = std::min(smallest, angle);
    n += 1;
  }
  return {n > 0 ? total / n : 0, smallest};
}

// Connected edges form a line. Returns the number of lines.
std::int64_t n_lines(const std::vector<std::pair<std::int64_t, std::int64_t>> &edges) {
  std::vector<std::int64_t> ids;
  for (const auto &[a, b] : edges) ids.insert(ids.end(), {a, b});
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  const auto place = [&](std::int64_t id) { return std::lower_bound(ids.begin(), ids.end(), id) - ids.begin(); };
  DisjointSets sets(static_cast<std::int64_t>(ids.size()));
  std::int64_t n = static_cast<std::int64_t>(ids.size());
  for (const auto &[a, b] : edges) n -= sets.unite(place(a), place(b));
  return n;
}

void mark_facets(std::vector<Part> &parts) {
  double largest = 0;
  for (const Part &part : parts)
    if (part.is_clear()) largest = std::max(largest, part.area);
  for (Part &part : parts)
    part.is_facet = part.area < small_share * largest && (part.n_sides < least_sides || part.wide_angle < clear_mean);
}

}  // namespace

Finder::Finder(const Triangles &triangles, bool faces_outwards)
    : all_(triangles),
      faces_outwards_(faces_outwards),
      neighbours_(neighbours_of(all_)),
      size_(all_.size()),
      stamp_(all_.corners.size(), 0) {
  for (std::int64_t i = 0; i < all_.n(); ++i) {
    const Vector3 area = all_.area_of(i);
    areas_.push_back(norm(area));
    normals_.push_back(unit_vector(area));
    centres_.push_back(all_.centre_of(i));
    total_ += areas_.back();
  }
}

std::vector<Part> Finder::find(std::vector<Part> parts) {
  std::vector<char> is_known(all_.corners.size(), 0);
  for (const Part &part : parts)
    for (const std::int64_t i : part.triangles) view(is_known)[i] = 1;
  std::vector<std::int64_t> seeds(all_.corners.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) seeds[i] = static_cast<std::int64_t>(i);
  std::sort(seeds.begin(), seeds.end(), [&](std::int64_t a, std::int64_t b) {
    return view(areas_)[a] != view(areas_)[b] ? view(areas_)[a] > view(areas_)[b] : a < b;
  });
  for (const std::int64_t seed : seeds) {
    if (view(is_known)[seed] != 0 || view(areas_)[seed] == 0) continue;
    Part part = grown(seed, flat_share * size_);
    // A triangle of this part may also belong to another part, but is no longer a seed.
    for (const std::int64_t i : part.triangles) view(is_known)[i] = 1;
    if (!is_large(part)) continue;
    measure(part);
    if (part.mean_angle < unclear_mean || !part.is_behind) continue;
    add(std::move(part), parts);
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part &a, const Part &b) { return a.area > b.area; });
  mark_touching(parts);
  mark_facets(parts);
  return parts;
}

Part Finder::closed_hole(std::vector<std::int64_t> triangles) {
  Part part;
  part.triangles = std::move(triangles);
  fit(part);
  part.was_open = true;
  measure(part);
  return part;
}

Part Finder::pointed_at(std::int64_t triangle) {
  Part part = grown(triangle, pointed_share * size_);
  measure(part);
  return part;
}

bool Finder::is_large(const Part &part) const {
  return part.area >= least_share * total_ && static_cast<std::int64_t>(part.triangles.size()) >= least_triangles;
}

// The plane's normal is the direction of the sum of the area vectors. This sum depends only on the rim, and is exact for a flat
// part. A least-squares plane would also depend on the corners inside the part.
void Finder::fit(Part &part) const {
  Vector3 area{}, centre{};
  part.area = 0;
  for (const std::int64_t i : part.triangles) {
    area = area + view(areas_)[i] * view(normals_)[i];
    centre = centre + view(areas_)[i] * view(centres_)[i];
    part.area += view(areas_)[i];
  }
  if (part.area > 0) part.plane = {unit_vector(area), 1 / part.area * centre};
}

bool Finder::is_in(const Plane &plane, std::int64_t triangle, double tolerance) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(std::abs(plane.distance_of(all_.corner(triangle, k))) <= tolerance)) return false;
  static const double least_cosine = sine_cosine_degrees(most_lean).cosine;
  return dot(view(normals_)[triangle], plane.normal) >= least_cosine || is_thin(triangle);
}

// Returns whether a triangle has so little height that its normal has no meaning.
bool Finder::is_thin(std::int64_t triangle) const {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, norm(all_.corner(triangle, (k + 1) % 3) - all_.corner(triangle, k)));
  return 2 * view(areas_)[triangle] <= 1e-6 * size_ * longest;
}

Part Finder::grown(std::int64_t seed, double tolerance) {
  Part part;
  part.triangles = {seed};
  fit(part);
  // At first, each new triangle moves the plane. The triangles are then collected anew in the moved plane, until their set stays
  // the same.
  Vector3 area = part.area * part.plane.normal, centre = part.area * part.plane.point;
  double sum = part.area;
  collect(seed, part, tolerance, [&](std::int64_t i) {
    area = area + view(areas_)[i] * view(normals_)[i];
    centre = centre + view(areas_)[i] * view(centres_)[i];
    sum += view(areas_)[i];
    if (sum > 0) part.plane = {unit_vector(area), 1 / sum * centre};
  });
  constexpr int most_rounds = 6;
  for (int round = 0; round < most_rounds; ++round) {
    fit(part);
    const std::size_t n = part.triangles.size();
    collect(seed, part, tolerance, [](std::int64_t) {});
    if (part.triangles.size() == n) break;
  }
  fill_gaps(part, tolerance);
  fit(part);
  return part;
}

template <class Visit>
void Finder::collect(std::int64_t seed, Part &part, double tolerance, const Visit &visit) {
  const int stamp = ++last_stamp_;
  std::vector<std::int64_t> &found = part.triangles;
  found = {seed};
  view(stamp_)[seed] = stamp;
  for (std::size_t next = 0; next < found.size(); ++next) {
    const Triangles::Corners beyond = view(neighbours_)[found[next]];
    for (const std::int64_t i : beyond) {
      if (i < 0 || view(stamp_)[i] == stamp || !is_in(part.plane, i, tolerance)) continue;
      view(stamp_)[i] = stamp;
      found.push_back(i);
      visit(i);
    }
  }
}

// Adds triangles that the part surrounds and that lean only because of rounding.
void Finder::fill_gaps(Part &part, double tolerance) {
  const int stamp = stamped(part);
  for (std::size_t next = 0; next < part.triangles.size(); ++next)
    for (const std::int64_t i : view(neighbours_)[part.triangles[next]]) {
      if (i < 0 || view(stamp_)[i] == stamp) continue;
      int n_within = 0;
      for (const std::int64_t other : view(neighbours_)[i]) n_within += other >= 0 && view(stamp_)[other] == stamp;
      bool is_near = n_within >= 2;
      for (std::size_t k = 0; k < 3 && is_near; ++k)
        is_near = std::abs(part.plane.distance_of(all_.corner(i, k))) <= tolerance;
      if (!is_near) continue;
      view(stamp_)[i] = stamp;
      part.triangles.push_back(i);
    }
}

int Finder::stamped(const Part &part) {
  const int stamp = ++last_stamp_;
  for (const std::int64_t i : part.triangles) view(stamp_)[i] = stamp;
  return stamp;
}

void Finder::measure(Part &part) {
  const int stamp = stamped(part);
  part.is_large = is_large(part);
  double perimeter = 0;
  std::vector<std::pair<std::int64_t, std::int64_t>> rim;
  using Reached = std::pair<double, std::int64_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  for (const std::int64_t i : part.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t beyond = view(neighbours_)[i][k];
      if (beyond >= 0 && view(stamp_)[beyond] == stamp) continue;
      perimeter += norm(all_.corner(i, (k + 1) % 3) - all_.corner(i, k));
      rim.emplace_back(view(all_.corners)[i][k], view(all_.corners)[i][(k + 1) % 3]);
      if (beyond >= 0) queue.emplace(0, beyond);
    }
  part.roundness = perimeter > 0 ? 4 * pi * part.area / (perimeter * perimeter) : 0;
  part.n_rims = n_lines(rim);
  part.n_sides = static_cast<std::int64_t>(rim.size());
  // Noise cancels in the sum of the area vectors of a sector.
  const Vector3 first =
      unit_vector(cross(part.plane.normal, std::abs(part.plane.normal[0]) < 0.6 ? Vector3{1, 0, 0} : Vector3{0, 1, 0}));
  const Vector3 second = cross(part.plane.normal, first);
  Sectors sums{}, wide_sums{};
  double depth = 0;
  const double reach = band_share * part.radius(), wide_reach = wide_band_share * part.radius();
  while (!queue.empty()) {
    const auto [distance, i] = queue.top();
    queue.pop();
    if (view(stamp_)[i] == stamp) continue;
    view(stamp_)[i] = stamp;
    const Vector3 off = view(centres_)[i] - part.plane.point;
    const double turn = arc_tangent(dot(off, second), dot(off, first)) / (2 * pi) + 0.5;
    const std::size_t sector = std::min(n_sectors - 1, static_cast<std::size_t>(turn * n_sectors));
    const Vector3 area = view(areas_)[i] * view(normals_)[i];
    wide_sums[sector] = wide_sums[sector] + area;
    if (distance <= reach) {
      sums[sector] = sums[sector] + area;
      depth -= view(areas_)[i] * dot(off, part.plane.normal);
    }
    for (const std::int64_t beyond : view(neighbours_)[i]) {
      if (beyond < 0) continue;
      const double further = distance + norm(view(centres_)[beyond] - view(centres_)[i]);
      if (view(stamp_)[beyond] != stamp && further <= wide_reach) queue.emplace(further, beyond);
    }
  }
  part.is_behind = depth > 0 || !faces_outwards_;
  std::tie(part.mean_angle, part.least_angle) = angles_of(sums, part.plane.normal);
  part.wide_angle = angles_of(wide_sums, part.plane.normal).first;
}

void Finder::add(Part part, std::vector<Part> &parts) {
  const int stamp = stamped(part);
  for (std::size_t i = 0; i < parts.size();) {
    double common = 0;
    for (const std::int64_t triangle : parts[i].triangles)
      if (view(stamp_)[triangle] == stamp) common += view(areas_)[triangle];
    if (common == 0) {
      ++i;
      continue;
    }
    if (parts[i].was_open || parts[i].area >= part.area) return;
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i));
  }
  parts.push_back(std::move(part));
}

void Finder::mark_touching(std::vector<Part> &parts) const {
  std::vector<std::set<std::int64_t>> vertices;
  for (const Part &part : parts) {
    vertices.emplace_back();
    for (const std::int64_t i : part.triangles)
      for (const std::int64_t id : view(all_.corners)[i]) vertices.back().insert(id);
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!parts[i].is_sharp() || !parts[j].is_sharp()) continue;
      const bool touches = std::any_of(vertices[i].begin(), vertices[i].end(),
                                       [&](std::int64_t id) { return vertices[j].count(id) > 0; });
      if (!touches) continue;
      // Part i, the smaller one of the two parts, may be a facet of the wall at the rim of part j.
      parts[i].is_touching = true;
      if (parts[j].area <= most_apart * parts[i].area) parts[j].is_touching = true;
    }
}

}  // namespace riis::flat_parts
