// SPDX-License-Identifier: Apache-2.0
#include "program/patient/flat_ends.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>

#include "common/elementary.hpp"
#include "common/flat_parts.hpp"
#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/output/outputs.hpp"
#include "program/output/report.hpp"

namespace riis::program {
namespace {

using FlatPart = flat_parts::Part;

// The largest number of flat parts that a refusal lists.
constexpr std::size_t most_listed = 6;

// Chooses the ends of the vessel among the flat parts of the wall.
class EndChoice {
 public:
  EndChoice(const std::string &path, const ClosedSurface &surface, const EndPoints &points)
      : path_(path), surface_(surface), finder_(surface.triangles, true), parts_(finder_.find(closed_holes())) {
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
    wall.triangles = surface_.triangles;
    wall.end_of.assign(wall.triangles.corners.size(), -1);
    wall.size = finder_.size();
    wall.area = finder_.whole_area();
    wall.volume = wall.triangles.volume();
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
  std::vector<FlatPart> closed_holes() {
    std::vector<FlatPart> parts;
    for (const ClosedHole &hole : surface_.holes) {
      std::vector<std::int64_t> triangles;
      for (std::int64_t i = 0; i < hole.n_triangles; ++i) triangles.push_back(hole.first + i);
      parts.push_back(finder_.closed_hole(std::move(triangles)));
    }
    return parts;
  }

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

  // Remarks on the largest flat part that counts as wall but may be an end. The parts are sorted by area, so this part is the
  // first that find_if finds.
  void remark_unclear(PatientWall &wall) const {
    const auto is_unclear = [&](const FlatPart &part) {
      return part.is_large && part.is_disc() && !part.is_facet &&
             part.area > flat_parts::small_share * wall.ends[0].area && !is_chosen(part);
    };
    const auto found = std::find_if(parts_.begin(), parts_.end(), is_unclear);
    if (found == parts_.end()) return;
    wall.remarks.push_back(path_ + ": the flat part at " + place(*found) + " with area " +
                           printed("%.3g", found->area) +
                           " is taken as wall; if it is an end, name all ends by --inlet=X,Y,Z --outlet=X,Y,Z");
  }

  // Takes the flat parts that are clearly ends, except for the parts that the user chose by points.
  void take_clear_ends(const std::string &name) {
    for (const FlatPart &part : parts_)
      if (part.is_clear() && !is_chosen(part)) chosen_.push_back({name, part});
  }

  // Chooses the flat part that is nearest to a point of the user.
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
      const bool is_end = part.n_rims == 1 && part.is_behind && part.mean_angle >= flat_parts::unclear_mean &&
                          part.area >= flat_parts::least_share * finder_.whole_area() && least <= part.radius();
      if (!is_end && found == nullptr) refuse_usage(text + ": no flat part of " + path_ + " is there; " + listed());
      if (!is_end) part = *found;
    }
    if (is_chosen(part)) refuse_usage(text + ": another point has already chosen the flat part at " + place(part));
    chosen_.push_back({name, part});
  }

  void check_number(const EndPoints &points) {
    if (!points.inlet && !points.outlets.empty()) {
      const std::size_t n = chosen_.size() - points.outlets.size();
      if (n != 1)
        refuse(std::to_string(n) +
               " flat parts are left for the inlet; also choose the inlet, by --inlet=X,Y,Z: " + listed());
    }
    if (chosen_.size() < 2) {
      const bool has_ring = std::any_of(parts_.begin(), parts_.end(),
                                        [](const FlatPart &part) { return part.is_sharp() && part.n_rims == 2; });
      refuse(
          (chosen_.empty() ? std::string("no flat end is clear")
                           : "only the flat end at " + place(chosen_[0].part) + " is clear") +
          ", but the blood needs two ends: " +
          (has_ring
               ? "a flat part is a ring, so this wall has a thickness: export the surface of the blood instead"
               : "cut the vessels flat, for example by Plane Cut in the Dynamic Modeler of 3D Slicer, or choose flat "
                 "parts by --inlet=X,Y,Z --outlet=X,Y,Z") +
          "; " + listed());
    }
  }

  // Refuses holes in the wall that are not ends.
  void refuse_holes() const {
    for (const FlatPart &part : parts_)
      if (part.was_open && !is_chosen(part))
        refuse("the surface has a hole of " + counted(static_cast<std::int64_t>(part.triangles.size()), "edge") +
               " at " + place(part) + ": close it, for example by the filter Close Holes of MeshLab" +
               (part.is_large ? ", or make it an end by --outlet=" + place(part) : ""));
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
  flat_parts::Finder finder_;
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
  for (Vector3 &point : wall.triangles.points) point = factor * point;
  for (FlatEnd &end : wall.ends) {
    end.centre = factor * end.centre;
    end.area *= factor * factor;
  }
  wall.size *= factor;
  wall.area *= factor * factor;
  wall.volume *= factor * factor * factor;
}

namespace {

// Returns whether a point is inside the wall. Seen from a point inside, the triangles cover all directions.
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
        2 * arc_tangent(dot(to[0], cross(to[1], to[2])), far[0] * far[1] * far[2] + dot(to[0], to[1]) * far[2] +
                                                             dot(to[1], to[2]) * far[0] + dot(to[2], to[0]) * far[1]);
  }
  return angle > 2 * pi;
}

// Returns the first triangle on a ray that begins inside the wall, or -1.
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

// Starts at a triangle, follows the edges, and returns the first end that has no name yet.
std::int32_t first_end_from(const PatientWall &wall, std::int64_t from) {
  const Triangles &triangles = wall.triangles;
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
    if (!is_in_wall(wall.triangles, centre))
      refuse_data(
          wall.path + ": the valve's centre, " + point_text(centre, wall.size) +
          ", lies outside the wall; landmarks and wall may have different units or axes, or belong to two patients");
    const std::int64_t hit = first_wall_hit(wall.triangles, centre, -1 * unit_vector(flow));
    view(wall.ends)[hit < 0 ? 0 : first_end_from(wall, hit)].name = "inlet";
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
  const Triangles &triangles = wall.triangles;
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

// ---- Unit and axes ----

namespace {

// The largest mean distance of landmarks from their wall, in millimetres. Cusps and annuli are about 25 mm wide.
constexpr double at_wall = 5;
// Another unit or other axes are excluded if the landmarks would then be farther from the wall by this factor.
constexpr double clearly_farther = 2;

// The mean distance of a usual valve's landmarks from their middle, in centimetres. The range is narrower than a factor of ten,
// so that at most one unit fits.
constexpr double least_size = 0.4, largest_size = 3;

std::string mm_text(double length) { return printed("%.3g", length) + " mm"; }

Surface wall_surface_of(const PatientWall &wall) {
  const riis_surface_arrays arrays = arrays_of(wall.triangles);
  auto how = defaults<riis_surface_options>();
  how.zero_area = RIIS_ZERO_AREA_SKIP;
  return create_for<Surface>(wall.path, riis_surface_create_from_arrays, &arrays, &how);
}

// The place where the closed cusps meet is in the middle of the vessel, not at the wall.
bool is_at_wall(std::int32_t role) { return role != RIIS_LANDMARK_COAPTATION && role != RIIS_LANDMARK_HINGE; }

WallFrame frame_with(const riis_surface *wall, const LandmarkFile &given, Unit unit, const std::string &axes) {
  LandmarkFile landmarks = given;
  landmarks.convert(unit);
  if (axes != name_of(given.axes)) landmarks.convert(axes == "LPS" ? Axes::LPS : Axes::RAS);
  const std::vector<double> distance = distances_to(wall, landmarks.xyz);
  WallFrame frame{unit, axes, 0, 0, ""};
  double n = 0;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (!is_at_wall(landmarks.roles[i])) continue;
    const double here = factor_between(unit, Unit::millimetre) * distance[i];
    frame.away += here;
    ++n;
    if (here <= frame.worst) continue;
    frame.worst = here;
    frame.farthest = landmarks.names[i];
  }
  frame.away /= std::max(n, 1.0);
  return frame;
}

// Returns the options that choose a frame's unit and axes. Leaves out an option whose value is the same in the other frame.
std::string options_of(const WallFrame &frame, const WallFrame &other) {
  std::vector<std::string> options;
  if (frame.unit != other.unit) options.push_back(std::string("--wall-unit ") + name_of(frame.unit));
  if (frame.axes != other.axes) options.push_back("--axes " + frame.axes);
  return joined_by(options, " ");
}

// Tries all units and axes of the wall, and measures the distances of the landmarks from the wall. Returns the results, the
// nearest first.
std::vector<WallFrame> frames_of(const riis_surface *wall, const LandmarkFile &landmarks) {
  const std::string own = name_of(landmarks.axes);
  std::vector<WallFrame> all;
  for (const Unit tried : {Unit::millimetre, Unit::centimetre, Unit::metre})
    for (const std::string &turned : {own, std::string(own == "LPS" ? "RAS" : "LPS")})
      if (landmarks.axes != Axes::mesh || turned == own) all.push_back(frame_with(wall, landmarks, tried, turned));
  std::stable_sort(all.begin(), all.end(), [](const WallFrame &a, const WallFrame &b) { return a.away < b.away; });
  return all;
}

// Returns the mean distance of the landmarks from their middle, in centimetres.
double size_of(const LandmarkFile &landmarks) {
  const std::size_t n = landmarks.names.size();
  double middle[3] = {0, 0, 0}, sum = 0;
  for (std::size_t i = 0; i < 3 * n; ++i) middle[i % 3] += landmarks.xyz[i] / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double *const point = landmarks.xyz.data() + 3 * i;
    sum += hypotenuse(point[0] - middle[0], point[1] - middle[1], point[2] - middle[2]);
  }
  return factor_between(landmarks.unit, Unit::centimetre) * sum / static_cast<double>(n);
}

bool is_usual(double size) { return size >= least_size && size <= largest_size; }

// Returns how to change a file of landmarks so that it states another unit for the same numbers.
std::string cure_of_unit(const LandmarkFile &landmarks, Unit other) {
  const std::string &path = landmarks.path, name = name_of(other);
  if (has_ending(path, ".fcsv"))
    return "multiply its numbers by " + shortest(factor_between(other, Unit::millimetre)) +
           ", because an .fcsv file is always in mm";
  if (has_ending(path, ".csv")) return "write # unit = " + name + " in it";
  const std::string key = landmark_ending(path) == ".mrk.json" ? "coordinateUnits" : "unit";
  return "write " + quoted(key) + ": " + quoted(name) + " in it";
}

// Refuses landmarks whose file probably states a wrong unit. In another unit, these landmarks would have the size of a valve and
// would lie at the wall.
void check_stated_unit(const riis_surface *wall, const LandmarkFile &landmarks) {
  for (const Unit other : {Unit::millimetre, Unit::centimetre, Unit::metre}) {
    LandmarkFile relabelled = landmarks;
    relabelled.unit = other;
    if (other == landmarks.unit || !is_usual(size_of(relabelled))) continue;
    const WallFrame frame = frames_of(wall, relabelled)[0];
    if (frame.away > at_wall) continue;
    refuse_data(landmarks.path + ": its numbers are probably in " + name_of(other) + ", but it states " +
                name_of(landmarks.unit) + ": in " + name_of(other) +
                " the landmarks have the size of a valve, and are " + mm_text(frame.away) +
                " from the wall on average: " + cure_of_unit(landmarks, other));
  }
}

}  // namespace

WallFrame frame_of_wall(const PatientWall &wall, const LandmarkFile &landmarks, std::optional<Unit> unit,
                        const std::string &axes) {
  const Surface surface = wall_surface_of(wall);
  if (landmarks.axes == Axes::mesh && !axes.empty())
    refuse_usage("--axes: " + landmarks.path + " states the axes mesh, which are those of the wall: leave --axes out");
  const std::vector<WallFrame> all = frames_of(surface, landmarks);
  if (all[0].away > at_wall || !is_usual(size_of(landmarks))) check_stated_unit(surface, landmarks);
  std::vector<WallFrame> allowed;
  for (const WallFrame &frame : all)
    if ((!unit || *unit == frame.unit) && (axes.empty() || axes == frame.axes)) allowed.push_back(frame);
  const WallFrame &best = allowed[0];
  if (best.away > at_wall) {
    const std::string text =
        landmarks.path + ": the landmarks are " + mm_text(best.away) + " from the wall of " + wall.path + " on average";
    if (all[0].away <= at_wall)
      refuse_data(text + "; they are " + mm_text(all[0].away) + " from it with " + options_of(all[0], best));
    refuse_data(
        text + ", and farther away with other units and axes. Landmarks on their own wall are nearer than " +
        mm_text(at_wall) +
        ": do both files belong to the same patient and the same image, and is neither mirrored? Load both in 3D "
        "Slicer, and set the landmarks anew");
  }
  if (allowed.size() > 1 && allowed[1].away <= std::min(at_wall, clearly_farther * best.away))
    refuse_usage(wall.path + ": its " + (allowed[1].unit == best.unit ? "axes are" : "unit is") +
                 " not clear, because the landmarks are " + mm_text(best.away) + " from it with " +
                 options_of(best, allowed[1]) + ", and " + mm_text(allowed[1].away) + " with " +
                 options_of(allowed[1], best) + ": write one of them");
  return best;
}

}  // namespace riis::program
