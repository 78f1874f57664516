// SPDX-License-Identifier: Apache-2.0
#include "program/patient/flat_ends.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>

#include "common/array_view.hpp"
#include "common/sets.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/output/outputs.hpp"
#include "program/output/report.hpp"
#include "program/patient/wall_surface.hpp"

namespace riis::program {
namespace {

constexpr double half_turn = 3.14159265358979323846;

// Distances from the plane, as shares of the wall's size: within a flat part, and within a part that the user points at.
constexpr double flat_share = 5e-4, pointed_share = 5e-3;
// Triangles of a flat part may lean by this much against its plane, in degrees. Short heights lean more by rounding.
constexpr double most_lean = 25;
// A flat part below this share of the whole area is noise. Its triangles are at least so many.
constexpr double least_share = 3e-4;
constexpr std::int64_t least_triangles = 4;
// The wall beside a flat part is measured up to this share of the radius of a disc with the part's area, in sectors.
constexpr double band_share = 0.5;
constexpr std::size_t n_sectors = 12;
// The angle between a flat part and the wall beside it, in degrees: a tube that is cut has a mean angle of 90, also if it is cut
// obliquely. A part between the limits may be a cut, or a flat place of the wall.
constexpr double clear_mean = 55, clear_least = 20, unclear_mean = 30;
// Four half_turn times the area over the square of the perimeter: 1 for a disc, 0.6 for an ellipse thrice as long as wide.
constexpr double least_roundness = 0.25;
// Flat parts that touch make each other unclear if their areas differ by less than this factor. Else only the small one is.
constexpr double most_apart = 10;
// A flat part below this share of the largest end may be a facet of a coarse wall, or the end of a coronary artery. It is an
// end if its rim has so many sides, and if the wall is as steep up to this share of the radius.
constexpr double small_share = 0.05;
constexpr std::int64_t least_sides = 12;
constexpr double wide_band_share = 1.5;
// A refusal lists so many flat parts.
constexpr std::size_t most_listed = 6;

double degrees_between(const Vector3 &a, const Vector3 &b) {
  return 180 / half_turn * std::atan2(norm(cross(a, b)), dot(a, b));
}

// A plane through a point.
struct FlatPlane {
  Vector3 normal{}, point{};
  double distance_of(const Vector3 &of) const { return dot(of - point, normal); }
};

// A flat part of the surface.
struct FlatPart {
  std::vector<std::int64_t> triangles;
  FlatPlane plane;  // through the part's centre
  double area = 0;
  double mean_angle = 0, least_angle = 0;  // to the wall beside it, in degrees
  double wide_angle = 0;                   // the mean over the wider band
  double roundness = 0;
  std::int64_t n_rims = 0, n_sides = 0;  // lines of the rim, and their edges
  bool is_behind = false;                // the wall beside it lies on the side of the blood
  bool is_touching = false;              // another flat part begins at its rim
  bool is_large = false;                 // enough not to be noise
  bool is_facet = false;  // it is small beside the largest end, and hardly larger than the wall's triangles
  bool was_open = false;

  bool is_disc() const { return n_rims == 1 && is_behind && roundness >= least_roundness; }
  bool is_sharp() const { return mean_angle >= clear_mean && least_angle >= clear_least && is_behind; }
  bool is_clear() const { return is_large && is_disc() && is_sharp() && !is_touching && !is_facet; }
  double radius() const { return std::sqrt(area / half_turn); }
};

class EndFinder {
 public:
  explicit EndFinder(const ClosedSurface &surface)
      : surface_(surface),
        all_(surface.triangles),
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

  // Returns the flat parts that may be ends, the largest first.
  std::vector<FlatPart> find() {
    std::vector<FlatPart> parts;
    for (const ClosedHole &hole : surface_.holes) parts.push_back(of_hole(hole));
    std::vector<char> is_known(all_.corners.size(), 0);
    for (const FlatPart &part : parts)
      for (const std::int64_t i : part.triangles) view(is_known)[i] = 1;
    std::vector<std::int64_t> seeds(all_.corners.size());
    for (std::size_t i = 0; i < seeds.size(); ++i) seeds[i] = static_cast<std::int64_t>(i);
    std::sort(seeds.begin(), seeds.end(), [&](std::int64_t a, std::int64_t b) {
      return view(areas_)[a] != view(areas_)[b] ? view(areas_)[a] > view(areas_)[b] : a < b;
    });
    for (const std::int64_t seed : seeds) {
      if (view(is_known)[seed] != 0 || view(areas_)[seed] == 0) continue;
      FlatPart part = grown(seed, flat_share * size_);
      // A triangle of a part is no seed of another part, but may belong to it.
      for (const std::int64_t i : part.triangles) view(is_known)[i] = 1;
      if (!is_large(part)) continue;
      measure(part);
      if (part.mean_angle < unclear_mean || !part.is_behind) continue;
      add(std::move(part), parts);
    }
    std::sort(parts.begin(), parts.end(), [](const FlatPart &a, const FlatPart &b) { return a.area > b.area; });
    mark_touching(parts);
    mark_facets(parts);
    return parts;
  }

  // Returns the flat part at a triangle that the user points at.
  FlatPart pointed_at(std::int64_t triangle) {
    FlatPart part = grown(triangle, pointed_share * size_);
    measure(part);
    return part;
  }

  const std::vector<Corners> &neighbours() const { return neighbours_; }
  double size() const { return size_; }
  double total() const { return total_; }

 private:
  FlatPart of_hole(const ClosedHole &hole) {
    FlatPart part;
    for (std::int64_t i = 0; i < hole.n_triangles; ++i) part.triangles.push_back(hole.first + i);
    fit(part);
    part.was_open = true;
    measure(part);
    return part;
  }

  bool is_large(const FlatPart &part) const {
    return part.area >= least_share * total_ && static_cast<std::int64_t>(part.triangles.size()) >= least_triangles;
  }

  // The sum of the area vectors follows the rim, and is exact for a flat part. A plane of least squares would follow the corners.
  void fit(FlatPart &part) const {
    Vector3 area{}, centre{};
    part.area = 0;
    for (const std::int64_t i : part.triangles) {
      area = area + view(areas_)[i] * view(normals_)[i];
      centre = centre + view(areas_)[i] * view(centres_)[i];
      part.area += view(areas_)[i];
    }
    if (part.area > 0) part.plane = {unit_vector(area), 1 / part.area * centre};
  }

  bool is_in(const FlatPlane &plane, std::int64_t i, double tolerance) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (!(std::abs(plane.distance_of(all_.corner(i, k))) <= tolerance)) return false;
    static const double least_cosine = std::cos(most_lean * half_turn / 180);
    return dot(view(normals_)[i], plane.normal) >= least_cosine || is_thin(i);
  }

  // The normal of a triangle with so little height says nothing.
  bool is_thin(std::int64_t i) const {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, norm(all_.corner(i, (k + 1) % 3) - all_.corner(i, k)));
    return 2 * view(areas_)[i] <= 1e-6 * size_ * longest;
  }

  // Returns the connected triangles in the plane around the seed. The plane follows the triangles.
  FlatPart grown(std::int64_t seed, double tolerance) {
    FlatPart part;
    part.triangles = {seed};
    fit(part);
    // At first the plane moves with each triangle. Then the triangles are collected anew in the plane, until they stay.
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
  void collect(std::int64_t seed, FlatPart &part, double tolerance, const Visit &visit) {
    const int stamp = ++last_stamp_;
    std::vector<std::int64_t> &found = part.triangles;
    found = {seed};
    view(stamp_)[seed] = stamp;
    for (std::size_t next = 0; next < found.size(); ++next) {
      const Corners beyond = view(neighbours_)[found[next]];
      for (const std::int64_t i : beyond) {
        if (view(stamp_)[i] == stamp || !is_in(part.plane, i, tolerance)) continue;
        view(stamp_)[i] = stamp;
        found.push_back(i);
        visit(i);
      }
    }
  }

  // Adds triangles that the part surrounds and that lean only because of rounding.
  void fill_gaps(FlatPart &part, double tolerance) {
    const int stamp = stamped(part);
    for (std::size_t next = 0; next < part.triangles.size(); ++next)
      for (const std::int64_t i : view(neighbours_)[part.triangles[next]]) {
        if (view(stamp_)[i] == stamp) continue;
        int n_within = 0;
        for (const std::int64_t other : view(neighbours_)[i]) n_within += view(stamp_)[other] == stamp;
        bool is_near = n_within >= 2;
        for (std::size_t k = 0; k < 3 && is_near; ++k)
          is_near = std::abs(part.plane.distance_of(all_.corner(i, k))) <= tolerance;
        if (!is_near) continue;
        view(stamp_)[i] = stamp;
        part.triangles.push_back(i);
      }
  }

  int stamped(const FlatPart &part) {
    const int stamp = ++last_stamp_;
    for (const std::int64_t i : part.triangles) view(stamp_)[i] = stamp;
    return stamp;
  }

  // Measures the rim and the angle to the wall beside it.
  void measure(FlatPart &part) {
    const int stamp = stamped(part);
    part.is_large = is_large(part);
    double perimeter = 0;
    std::vector<std::pair<std::int64_t, std::int64_t>> rim;
    using Reached = std::pair<double, std::int64_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
    for (const std::int64_t i : part.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t beyond = view(neighbours_)[i][k];
        if (view(stamp_)[beyond] == stamp) continue;
        perimeter += norm(all_.corner(i, (k + 1) % 3) - all_.corner(i, k));
        rim.emplace_back(view(all_.corners)[i][k], view(all_.corners)[i][(k + 1) % 3]);
        queue.emplace(0, beyond);
      }
    part.roundness = perimeter > 0 ? 4 * half_turn * part.area / (perimeter * perimeter) : 0;
    part.n_rims = n_lines(rim);
    part.n_sides = static_cast<std::int64_t>(rim.size());
    // Noise cancels in the sum of the area vectors of a sector.
    const Vector3 first = unit_vector(
        cross(part.plane.normal, std::abs(part.plane.normal[0]) < 0.6 ? Vector3{1, 0, 0} : Vector3{0, 1, 0}));
    const Vector3 second = cross(part.plane.normal, first);
    std::array<Vector3, n_sectors> sums{}, wide_sums{};
    double depth = 0;
    const double reach = band_share * part.radius(), wide_reach = wide_band_share * part.radius();
    while (!queue.empty()) {
      const auto [distance, i] = queue.top();
      queue.pop();
      if (view(stamp_)[i] == stamp) continue;
      view(stamp_)[i] = stamp;
      const Vector3 off = view(centres_)[i] - part.plane.point;
      const double turn = std::atan2(dot(off, second), dot(off, first)) / (2 * half_turn) + 0.5;
      const std::size_t sector = std::min(n_sectors - 1, static_cast<std::size_t>(turn * n_sectors));
      const Vector3 area = view(areas_)[i] * view(normals_)[i];
      wide_sums[sector] = wide_sums[sector] + area;
      if (distance <= reach) {
        sums[sector] = sums[sector] + area;
        depth -= view(areas_)[i] * dot(off, part.plane.normal);
      }
      for (const std::int64_t beyond : view(neighbours_)[i]) {
        const double further = distance + norm(view(centres_)[beyond] - view(centres_)[i]);
        if (view(stamp_)[beyond] != stamp && further <= wide_reach) queue.emplace(further, beyond);
      }
    }
    part.is_behind = depth > 0;
    part.mean_angle = mean_angle_of(sums, part.plane.normal, &part.least_angle);
    part.wide_angle = mean_angle_of(wide_sums, part.plane.normal, nullptr);
  }

  static double mean_angle_of(const std::array<Vector3, n_sectors> &sums, const Vector3 &normal, double *least) {
    double n = 0, total = 0, smallest = 180;
    for (const Vector3 &sum : sums) {
      if (norm(sum) == 0) continue;
      const double angle = degrees_between(sum, normal);
      total += angle;
      smallest = std::min(smallest, angle);
      n += 1;
    }
    if (least != nullptr) *least = smallest;
    return n > 0 ? total / n : 0;
  }

  // Returns the number of lines that edges form.
  static std::int64_t n_lines(const std::vector<std::pair<std::int64_t, std::int64_t>> &edges) {
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

  // Adds a part, unless a larger one has most of its triangles. Removes smaller ones of which it has most.
  void add(FlatPart part, std::vector<FlatPart> &parts) {
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

  void mark_touching(std::vector<FlatPart> &parts) const {
    std::vector<std::set<std::int64_t>> vertices;
    for (const FlatPart &part : parts) {
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
        // A small part at the rim of an end is a facet of the wall there.
        parts[i].is_touching = true;
        if (parts[j].area <= most_apart * parts[i].area) parts[j].is_touching = true;
      }
  }

  static void mark_facets(std::vector<FlatPart> &parts) {
    double largest = 0;
    for (const FlatPart &part : parts)
      if (part.is_clear()) largest = std::max(largest, part.area);
    for (FlatPart &part : parts)
      part.is_facet = part.area < small_share * largest && (part.n_sides < least_sides || part.wide_angle < clear_mean);
  }

  const ClosedSurface &surface_;
  const Triangles &all_;
  std::vector<Corners> neighbours_;
  double size_ = 0, total_ = 0;
  std::vector<double> areas_;
  std::vector<Vector3> normals_, centres_;
  std::vector<int> stamp_;  // by which the last walk marked a triangle
  int last_stamp_ = 0;
};

// Chooses the ends among the flat parts.
class EndChoice {
 public:
  EndChoice(const std::string &path, const ClosedSurface &surface, const EndPoints &points)
      : path_(path), surface_(surface), finder_(surface), parts_(finder_.find()) {
    if (points.inlet) choose("--inlet", *points.inlet, "inlet");
    for (const Vector3 &outlet : points.outlets) choose("--outlet", outlet, name_of_outlet(n_outlets_++));
    if (points.outlets.empty())
      take_clear_ends("");
    else if (!points.inlet)
      take_clear_ends("inlet");
    check_number(points);
    refuse_holes();
  }

  PatientWall result() const {
    PatientWall wall;
    wall.path = path_;
    const Triangles &all = surface_.triangles;
    for (const Vector3 &point : all.points) wall.xyz.insert(wall.xyz.end(), point.begin(), point.end());
    for (const Corners &triangle : all.corners)
      wall.corners.insert(wall.corners.end(), triangle.begin(), triangle.end());
    wall.end_of.assign(all.corners.size(), -1);
    wall.size = finder_.size();
    wall.area = finder_.total();
    wall.volume = all.volume();
    wall.remarks = surface_.remarks;
    std::vector<Chosen> chosen = chosen_;
    std::sort(chosen.begin(), chosen.end(), [](const Chosen &a, const Chosen &b) { return a.part.area > b.part.area; });
    for (const auto &[name, part] : chosen) {
      for (const std::int64_t i : part.triangles) view(wall.end_of)[i] = static_cast<std::int32_t>(wall.ends.size());
      wall.ends.push_back({name, part.plane.point, part.plane.normal, part.area,
                           static_cast<std::int64_t>(part.triangles.size()), part.was_open});
      if (part.was_open)
        wall.remarks.push_back(path_ + ": the surface is open at " + place(part) +
                               ", and is closed there by a flat end");
    }
    remark_unclear(wall);
    return wall;
  }

 private:
  struct Chosen {
    std::string name;
    FlatPart part;
  };

  static std::string name_of_outlet(int before) {
    return before == 0 ? "outlet" : "outlet_" + std::to_string(before + 1);
  }
  std::string place(const FlatPart &part) const { return point_text(part.plane.point, finder_.size()); }

  bool is_chosen(const FlatPart &part) const {
    return std::any_of(chosen_.begin(), chosen_.end(), [&](const Chosen &other) { return overlap(other.part, part); });
  }
  static bool overlap(const FlatPart &a, const FlatPart &b) {
    const std::set<std::int64_t> of_a(a.triangles.begin(), a.triangles.end());
    return std::any_of(b.triangles.begin(), b.triangles.end(), [&](std::int64_t i) { return of_a.count(i) > 0; });
  }

  // Says which flat part would be the next end. The parts are sorted by area.
  void remark_unclear(PatientWall &wall) const {
    const auto is_unclear = [&](const FlatPart &part) {
      return part.is_large && part.is_disc() && !part.is_facet && part.area > small_share * wall.ends[0].area &&
             !is_chosen(part);
    };
    const auto found = std::find_if(parts_.begin(), parts_.end(), is_unclear);
    if (found == parts_.end()) return;
    wall.remarks.push_back(path_ + ": the flat part at " + place(*found) + " with area " +
                           printed("%.3g", found->area) +
                           " is taken as wall; if it is an end, name all ends by --inlet=X,Y,Z --outlet=X,Y,Z");
  }

  // Takes the clear ends that no point chose.
  void take_clear_ends(const std::string &name) {
    for (const FlatPart &part : parts_)
      if (part.is_clear() && !is_chosen(part)) chosen_.push_back({name, part});
  }

  // Chooses the flat part nearest to a point.
  void choose(const std::string &option, const Vector3 &point, const std::string &name) {
    const std::string text = option + "=" + point_text(point, finder_.size());
    std::int64_t nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::int64_t i = 0; i < surface_.triangles.n(); ++i) {
      const double distance = surface_.triangles.distance(i, point);
      if (distance < least) least = distance, nearest = i;
    }
    const FlatPart *found = nullptr;
    double shortest_way = std::numeric_limits<double>::infinity();
    for (const FlatPart &part : parts_) {
      double distance = std::numeric_limits<double>::infinity();
      for (const std::int64_t i : part.triangles) distance = std::min(distance, surface_.triangles.distance(i, point));
      if (distance <= part.radius() && distance < shortest_way) shortest_way = distance, found = &part;
    }
    FlatPart part;
    if (found != nullptr && shortest_way <= least) {
      part = *found;
    } else {
      part = finder_.pointed_at(nearest);
      const bool is_end = part.n_rims == 1 && part.is_behind && part.mean_angle >= unclear_mean &&
                          part.area >= least_share * finder_.total() && least <= part.radius();
      if (!is_end && found == nullptr) refuse_usage(text + ": no flat part of " + path_ + " is there; " + listed());
      if (!is_end) part = *found;
    }
    if (is_chosen(part)) refuse_usage(text + ": another point chose the flat part at " + place(part) + " before");
    chosen_.push_back({name, part});
  }

  void check_number(const EndPoints &points) {
    if (!points.inlet && !points.outlets.empty()) {
      const std::size_t n = chosen_.size() - points.outlets.size();
      if (n != 1)
        refuse(std::to_string(n) + " flat parts are left for the inlet; choose it also, by --inlet=X,Y,Z: " + listed());
    }
    if (chosen_.size() < 2) {
      const bool has_ring = std::any_of(parts_.begin(), parts_.end(),
                                        [](const FlatPart &part) { return part.is_sharp() && part.n_rims == 2; });
      refuse((chosen_.empty() ? std::string("no flat end is clear")
                              : "only the flat end at " + place(chosen_[0].part) + " is clear") +
             ", but blood needs two: " +
             (has_ring ? "a flat ring shows that this is a wall with its thickness, so export the surface of the blood"
                       : "cut the vessels flat, as by Plane Cut in the Dynamic Modeler of 3D Slicer, or choose flat "
                         "parts by --inlet=X,Y,Z --outlet=X,Y,Z") +
             "; " + listed());
    }
  }

  // Refuses holes that are not ends.
  void refuse_holes() const {
    for (const FlatPart &part : parts_)
      if (part.was_open && !is_chosen(part))
        refuse("the surface has a hole of " + counted(static_cast<std::int64_t>(part.triangles.size()), "edge") +
               " at " + place(part) +
               ": close it, as by the filter Close Holes of MeshLab, or make it an end by --outlet=" + place(part));
  }

  // Returns a list of the flat parts.
  std::string listed() const {
    if (parts_.empty()) return "the surface has no flat part that meets the wall at an angle";
    std::string text = "flat parts are";
    for (std::size_t i = 0; i < std::min(parts_.size(), most_listed); ++i)
      text += std::string(i == 0 ? " " : "; ") + place(parts_[i]) + " with area " + printed("%.3g", parts_[i].area) +
              " of " + counted(static_cast<std::int64_t>(parts_[i].triangles.size()), "triangle");
    if (parts_.size() > most_listed) text += "; and " + std::to_string(parts_.size() - most_listed) + " smaller ones";
    return text;
  }

  [[noreturn]] void refuse(const std::string &text) const { refuse_data(path_ + ": " + text); }

  const std::string &path_;
  const ClosedSurface &surface_;
  EndFinder finder_;
  std::vector<FlatPart> parts_;
  std::vector<Chosen> chosen_;
  int n_outlets_ = 0;
};

}  // namespace

PatientWall read_patient_wall(const std::string &path, const EndPoints &points) {
  const ClosedSurface surface = read_closed_surface(path);
  return EndChoice(path, surface, points).result();
}

void scale_wall(PatientWall &wall, double factor) {
  for (double &x : wall.xyz) x *= factor;
  for (FlatEnd &end : wall.ends) {
    end.centre = factor * end.centre;
    end.area *= factor * factor;
  }
  wall.size *= factor;
  wall.area *= factor * factor;
  wall.volume *= factor * factor * factor;
}

namespace {

Triangles triangles_in(const PatientWall &wall) {
  Triangles triangles;
  for (std::size_t i = 0; i < wall.xyz.size(); i += 3)
    triangles.points.push_back({wall.xyz[i], wall.xyz[i + 1], wall.xyz[i + 2]});
  for (std::size_t i = 0; i < wall.corners.size(); i += 3)
    triangles.corners.push_back({wall.corners[i], wall.corners[i + 1], wall.corners[i + 2]});
  return triangles;
}

// Returns whether the point lies inside: the triangles cover the whole sphere of directions.
bool is_in_wall(const Triangles &triangles, const Vector3 &point) {
  double angle = 0;
  for (std::int64_t i = 0; i < triangles.n(); ++i) {
    Vector3 to[3];
    double far[3];
    for (std::size_t k = 0; k < 3; ++k) {
      to[k] = triangles.corner(i, k) - point;
      far[k] = norm(to[k]);
    }
    angle +=
        2 * std::atan2(dot(to[0], cross(to[1], to[2])), far[0] * far[1] * far[2] + dot(to[0], to[1]) * far[2] +
                                                            dot(to[1], to[2]) * far[0] + dot(to[2], to[0]) * far[1]);
  }
  return angle > 2 * half_turn;
}

// Returns the first triangle on a ray from inside, or -1.
std::int64_t first_wall_hit(const Triangles &triangles, const Vector3 &from, const Vector3 &direction) {
  std::int64_t hit = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::int64_t i = 0; i < triangles.n(); ++i) {
    const Vector3 &a = triangles.corner(i, 0);
    const Vector3 u = triangles.corner(i, 1) - a, v = triangles.corner(i, 2) - a, p = cross(direction, v);
    const double determinant = dot(u, p);
    if (determinant == 0) continue;
    const Vector3 w = from - a, q = cross(w, u);
    const double s = dot(w, p) / determinant, t = dot(direction, q) / determinant, far = dot(v, q) / determinant;
    constexpr double beside = 1e-9;  // a ray through an edge hits one of its triangles
    if (s < -beside || t < -beside || s + t > 1 + beside || far <= 0 || far >= nearest) continue;
    nearest = far;
    hit = i;
  }
  return hit;
}

// Returns the end that is first on the way along the edges from a triangle, among those without a name.
std::int32_t first_end_from(const PatientWall &wall, const Triangles &triangles, std::int64_t from) {
  if (view(wall.end_of)[from] >= 0) return view(wall.end_of)[from];
  std::vector<std::vector<std::int64_t>> beside(triangles.points.size());
  std::vector<std::int32_t> end_at(triangles.points.size(), -1);
  for (std::int64_t i = 0; i < triangles.n(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t id = view(triangles.corners)[i][k], next = view(triangles.corners)[i][(k + 1) % 3];
      view(beside)[id].push_back(next);
      if (view(wall.end_of)[i] >= 0) view(end_at)[id] = view(wall.end_of)[i];
    }
  std::vector<double> way(triangles.points.size(), std::numeric_limits<double>::infinity());
  using Reached = std::pair<double, std::int64_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  for (const std::int64_t id : view(triangles.corners)[from]) {
    view(way)[id] = 0;
    queue.emplace(0, id);
  }
  while (!queue.empty()) {
    const auto [length, id] = queue.top();
    queue.pop();
    if (length > view(way)[id]) continue;
    if (view(end_at)[id] >= 0) return view(end_at)[id];
    for (const std::int64_t next : view(beside)[id]) {
      const double longer = length + norm(view(triangles.points)[next] - view(triangles.points)[id]);
      if (longer >= view(way)[next]) continue;
      view(way)[next] = longer;
      queue.emplace(longer, next);
    }
  }
  return -1;
}

}  // namespace

void name_ends(PatientWall &wall, const std::array<double, 3> &centre, const std::array<double, 3> &flow) {
  const auto has_name = [&](const std::string &name) {
    return std::any_of(wall.ends.begin(), wall.ends.end(), [&](const FlatEnd &end) { return end.name == name; });
  };
  if (!has_name("inlet")) {
    const Triangles triangles = triangles_in(wall);
    if (!is_in_wall(triangles, centre))
      refuse_data(
          wall.path + ": the valve's centre, " + point_text(centre, wall.size) +
          ", lies outside the wall; landmarks and wall may have different units or axes, or be of two patients");
    const std::int64_t hit = first_wall_hit(triangles, centre, -1 * unit_vector(flow));
    view(wall.ends)[hit < 0 ? 0 : first_end_from(wall, triangles, hit)].name = "inlet";
  }
  int n_outlets = 0;
  for (const FlatEnd &end : wall.ends) n_outlets += !end.name.empty() && end.name != "inlet";
  for (FlatEnd &end : wall.ends)
    if (end.name.empty()) {
      end.name = n_outlets == 0 ? "outlet" : "outlet_" + std::to_string(n_outlets + 1);
      ++n_outlets;
    }
}

void write_wall(const PatientWall &wall, const std::string &path) {
  const Triangles triangles = triangles_in(wall);
  std::string text("riis");
  text.resize(80, ' ');
  const auto add = [&](const auto &number) { text.append(reinterpret_cast<const char *>(&number), sizeof number); };
  add(static_cast<std::uint32_t>(triangles.n()));
  const auto add_vector = [&](const Vector3 &vector) {
    for (const double x : vector) add(static_cast<float>(x));
  };
  for (std::int64_t i = 0; i < triangles.n(); ++i) {
    add_vector(unit_vector(triangles.area_of(i)));
    for (std::size_t k = 0; k < 3; ++k) add_vector(triangles.corner(i, k));
    add(std::uint16_t{0});
  }
  write_text(path, text);
}

}  // namespace riis::program
