// SPDX-License-Identifier: Apache-2.0
// Landmarks of valves with three cusps: three commissures, three nadirs, and perhaps the point where the closed cusps meet.
#include <riis/riis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/errors.hpp"
#include "landmarks/fit.hpp"

namespace riis {
namespace {

constexpr std::size_t n_cusps = 3;
// This limit leaves room for the other landmarks, as a warp has at most 1000 landmarks.
constexpr std::size_t most_along_attachment = 900;
// The cusps are in the order of leaflet ids, which is counter-clockwise about the valve's axis z.
const char *const cusp_names[n_cusps] = {"right", "left", "non_coronary"};
constexpr std::size_t next(std::size_t cusp) { return (cusp + 1) % n_cusps; }

// The places of the landmarks on the valve.
struct Order {
  std::array<std::size_t, n_cusps> nadir;       // landmark of each cusp
  std::array<std::size_t, n_cusps> commissure;  // a landmark between a cusp and the next cusp
};

// Kinds whose three cusps are equal, with the names of their sizes.
struct EqualCusps {
  const char *kind, *radius, *commissure_radius, *height;
};
constexpr EqualCusps equal_cusps[] = {{"trileaflet", "root_radius", "leaflet_radius_out", "leaflet_height"},
                                      {"coapting", "root_radius", "commissure_radius", "commissure_height"}};

Vec3 turned(double radius, double degrees, double height) {
  const auto [sine, cosine] = sine_cosine_degrees(degrees);
  return {radius * cosine, radius * sine, height};
}

// ---- Which landmark is which ----

std::string words_for_cusp(std::int32_t leaflet_id) { return cusp_names[leaflet_id]; }

void check_leaflet_ids(const Landmarks &landmarks) {
  for (std::size_t i = 0; i < landmarks.list.size(); ++i) {
    const auto &[first, second] = landmarks.list[i].leaflet_ids;
    const bool is_commissure = landmarks.list[i].role == RIIS_LANDMARK_COMMISSURE;
    for (const std::int32_t id : {first, second})
      if (id < -1 || id > 2)
        fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, i), " is ", id,
             "; it must be 0 (right), 1 (left), 2 (non_coronary) or -1");
    if (is_commissure ? (first == -1) != (second == -1) || (first != -1 && first == second) : second != -1)
      fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, i), " is ", first, " and ", second,
           is_commissure ? "; a commissure has two different leaflets, or -1 and -1"
                         : "; only a commissure has two leaflets");
  }
}

// Returns whether this place agrees with the leaflets that the landmark names.
bool fits_nadir(const Landmark &landmark, std::size_t cusp) {
  return landmark.leaflet_ids[0] == -1 || landmark.leaflet_ids[0] == static_cast<std::int32_t>(cusp);
}
bool fits_commissure(const Landmark &landmark, std::size_t cusp) {
  const auto &[first, second] = landmark.leaflet_ids;
  const auto a = static_cast<std::int32_t>(cusp), b = static_cast<std::int32_t>(next(cusp));
  return first == -1 || (first == a && second == b) || (first == b && second == a);
}
bool fits(const Landmarks &landmarks, const Order &order) {
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp)
    if (!fits_nadir(landmarks.list[order.nadir[cusp]], cusp) ||
        !fits_commissure(landmarks.list[order.commissure[cusp]], cusp))
      return false;
  return true;
}

Order rotated(const Order &order, std::size_t by) {
  Order made{};
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    made.nadir[cusp] = order.nadir[(cusp + by) % n_cusps];
    made.commissure[cusp] = order.commissure[(cusp + by) % n_cusps];
  }
  return made;
}
// Returns the order for the opposite turn about the axis. Each commissure then follows the other of its two cusps.
Order mirrored(const Order &order) {
  return {{order.nadir[0], order.nadir[2], order.nadir[1]},
          {order.commissure[2], order.commissure[1], order.commissure[0]}};
}

// Returns the landmarks in the order of their angles about the axis. Refuses commissures and nadirs that do not alternate.
Order turn_of(const Landmarks &landmarks, const std::vector<std::size_t> &nadirs,
              const std::vector<std::size_t> &commissures, Vec3 axis, Vec3 middle) {
  struct Seen {
    double angle;
    std::size_t landmark;
  };
  const Vec3 first = landmarks.at(nadirs[0]) - middle;
  const Rotation to = rotation_to(first, axis), back = transposed(to);
  std::vector<Seen> seen;
  for (const auto *list : {&nadirs, &commissures})
    for (const std::size_t i : *list) {
      const Vec3 p = back * (landmarks.at(i) - middle);
      const double angle = std::atan2(p.y, p.x);
      seen.push_back({i == nadirs[0] ? 0 : angle < 0 ? angle + 2 * pi : angle, i});
    }
  std::sort(seen.begin(), seen.end(), [](const Seen &a, const Seen &b) { return a.angle < b.angle; });
  Order order{};
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const std::size_t i = seen[k].landmark;
    const bool is_nadir = landmarks.list[i].role == RIIS_LANDMARK_NADIR;
    if (is_nadir != (k % 2 == 0))
      fail(RIIS_INVALID_ARGUMENT, words_for(landmarks, seen[k - 1].landmark), " and ", words_for(landmarks, i),
           " follow each other around the valve; commissures and nadirs must take turns");
    (is_nadir ? order.nadir : order.commissure)[k / 2] = i;
  }
  return order;
}

// Names the first landmark that does not fit the order.
[[noreturn]] void refuse_names(const Landmarks &landmarks, const Order &order) {
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const std::size_t n = order.nadir[cusp], c = order.commissure[cusp];
    if (!fits_nadir(landmarks.list[n], cusp))
      fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, n), " says ",
           words_for_cusp(landmarks.list[n].leaflet_ids[0]), ", but by the other landmarks' names it is of the ",
           cusp_names[cusp], " cusp");
    if (!fits_commissure(landmarks.list[c], cusp))
      fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, c), " says ",
           words_for_cusp(landmarks.list[c].leaflet_ids[0]), " and ", words_for_cusp(landmarks.list[c].leaflet_ids[1]),
           ", but it is between ", cusp_names[cusp], " and ", cusp_names[next(cusp)]);
  }
  fail(RIIS_INTERNAL_ERROR, "the names of the landmarks fit after all");
}

// Finds each landmark's place by the leaflets that it names. If no landmark names a leaflet, leaflet 0 is at the first nadir.
Order named_order(const Landmarks &landmarks, const Order &turn, bool needs_names) {
  std::size_t n_fitting = 0, fitting = 0;
  for (std::size_t by = n_cusps; by-- > 0;)
    if (fits(landmarks, rotated(turn, by))) {
      ++n_fitting;
      fitting = by;
    }
  if (n_fitting == 1 || (n_fitting > 1 && !needs_names)) return rotated(turn, fitting);
  if (n_fitting > 1)
    fail(
        RIIS_INVALID_ARGUMENT,
        "landmarks.leaflet_id does not say which nadir is of the right, the left and the non_coronary cusp: the aortic "
        "valve's cusps differ");
  for (std::size_t by = 0; by < n_cusps; ++by)
    if (fits(landmarks, mirrored(rotated(turn, by))))
      fail(RIIS_INVALID_ARGUMENT,
           "landmarks.leaflet_id: seen along the flow, right, left and non_coronary follow each other "
           "counter-clockwise, but they must follow clockwise: the landmarks or their names are mirrored");
  for (std::size_t by = 0; by < n_cusps; ++by)
    if (fits_nadir(landmarks.list[rotated(turn, by).nadir[0]], 0) &&
        landmarks.list[rotated(turn, by).nadir[0]].leaflet_ids[0] == 0)
      refuse_names(landmarks, rotated(turn, by));
  refuse_names(landmarks, turn);
}

struct CuspAxes {
  Order order;
  Vec3 axis, middle;  // the middle of the nadirs
  double height;
};

CuspAxes axes_of(const Landmarks &landmarks, const char *kind, bool needs_names) {
  check_roles(landmarks, kind,
              {RIIS_LANDMARK_COMMISSURE, RIIS_LANDMARK_NADIR, RIIS_LANDMARK_COAPTATION, RIIS_LANDMARK_ATTACHMENT});
  check_count(landmarks, kind, RIIS_LANDMARK_COMMISSURE, n_cusps, n_cusps);
  check_count(landmarks, kind, RIIS_LANDMARK_NADIR, n_cusps, n_cusps);
  check_count(landmarks, kind, RIIS_LANDMARK_COAPTATION, 0, 1);
  if (landmarks.count(RIIS_LANDMARK_ATTACHMENT) > 0)
    check_count(landmarks, kind, RIIS_LANDMARK_ATTACHMENT, 0, most_along_attachment);
  const auto nadirs = landmarks.with_role(RIIS_LANDMARK_NADIR),
             commissures = landmarks.with_role(RIIS_LANDMARK_COMMISSURE);
  std::vector<std::size_t> all = nadirs;
  all.insert(all.end(), commissures.begin(), commissures.end());
  std::sort(all.begin(), all.end());
  constexpr double one_place = 0.02;
  check_spread(landmarks, all, one_place);
  check_spread(landmarks, nadirs, one_place);
  check_spread(landmarks, commissures, one_place);
  check_leaflet_ids(landmarks);
  const auto is_named = [&](std::size_t i) { return landmarks.list[i].leaflet_ids[0] != -1; };
  if (std::none_of(all.begin(), all.end(), is_named))
    for (const std::size_t i : landmarks.with_role(RIIS_LANDMARK_ATTACHMENT))
      if (is_named(i))
        fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, i), " says ",
             words_for_cusp(landmarks.list[i].leaflet_ids[0]),
             ", but no nadir and no commissure says which cusp that is");

  const Vec3 middle = landmarks.mean_of(nadirs), up = landmarks.mean_of(commissures) - middle;
  const double size = spread_of(landmarks, all).deviation[0];
  constexpr double least_height = 0.1;
  if (!(length(up) > least_height * size))
    fail(RIIS_INVALID_ARGUMENT, "the middle of the commissures is ", rounded(landmarks.scale * length(up), 3),
         " from the middle of the nadirs, which does not show the direction of flow: it must be more than ",
         rounded(landmarks.scale * least_height * size, 3));
  const Vec3 axis = unit(up);
  const double against = dot(axis, landmarks.flow);
  if (against < 0)
    fail(RIIS_INVALID_ARGUMENT, "landmarks.flow is at ", rounded(std::acos(std::max(-1.0, against)) * 180 / pi, 3),
         " degrees to the direction from the nadirs to the commissures, which must point downstream");
  return {named_order(landmarks, turn_of(landmarks, nadirs, commissures, axis, middle), needs_names), axis, middle,
          length(up)};
}

// ---- Models ----

class CuspModel : public LandmarkModel {
 public:
  CuspModel(const Landmarks &landmarks, const CuspAxes &axes, Vec3 shift)
      : order_(axes.order), shift_(shift), coaptation_(landmarks.with_role(RIIS_LANDMARK_COAPTATION)) {}
  std::size_t n_equations() const override { return 3 * 2 * n_cusps + 2 * coaptation_.size(); }

 protected:
  void add(std::size_t landmark, const std::vector<Vec3> &local, Vec3 place, std::vector<Offset> &out) const {
    out.push_back({landmark, local[landmark] - shift_ - place});
  }
  // The closed cusps meet on the axis. The height of this point varies between people so much that it says little about the
  // sizes.
  void add_coaptation(const std::vector<Vec3> &local, std::vector<Offset> &out) const {
    for (const std::size_t i : coaptation_) {
      const Vec3 p = local[i] - shift_;
      out.push_back({i, {p.x, p.y, 0}});
    }
  }

  Order order_;

 private:
  Vec3 shift_;
  std::vector<std::size_t> coaptation_;
};

class EqualCuspModel : public CuspModel {
 public:
  using CuspModel::CuspModel;
  void offsets(const std::vector<double> &values, const std::vector<Vec3> &local,
               std::vector<Offset> &out) const override {
    const double R = values[0], Rc = values[1], h = values[2];
    out.clear();
    for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
      const double at = 120 * static_cast<double>(cusp);
      add(order_.nadir[cusp], local, turned(R, at, 0), out);
      add(order_.commissure[cusp], local, turned(Rc, at + 60, h), out);
    }
    add_coaptation(local, out);
  }
};

// The cusps of the paper's valve. Two neighbours end at the same angle but at different radii, so a commissure lies between two
// ends.
class AorticModel : public CuspModel {
 public:
  using CuspModel::CuspModel;
  enum Size { radius_, height_, end_radius, angle = end_radius + 3, n_sizes = angle + 2 };
  void offsets(const std::vector<double> &values, const std::vector<Vec3> &local,
               std::vector<Offset> &out) const override {
    const double R = values[radius_], h = values[height_], right = values[angle], left = values[angle + 1];
    const double half[n_cusps] = {right, left, 180 - right - left};
    const double at[n_cusps] = {0, right + left, -(right + half[2])};
    out.clear();
    for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
      const std::size_t after = next(cusp);
      add(order_.nadir[cusp], local, turned(R, at[cusp], 0), out);
      add(order_.commissure[cusp], local, turned(values[end_radius + cusp], at[cusp] + half[cusp], h), out);
      add(order_.commissure[cusp], local, turned(values[end_radius + after], at[after] - half[after], h), out);
    }
    add_coaptation(local, out);
  }
};

// ---- Sizes ----

double mean_radius(const Landmarks &landmarks, const std::array<std::size_t, n_cusps> &numbers, const CuspAxes &axes) {
  double sum = 0;
  for (const std::size_t i : numbers) {
    const Vec3 p = landmarks.at(i) - axes.middle;
    sum += length(p - dot(p, axes.axis) * axes.axis);
  }
  return sum / n_cusps;
}

// Returns a length for the fit, with `start` as its first value. Its expected value `grown` is the template's length times the
// ratio of the valves' sizes.
FittedSize length_size(const std::string &name, double start, double grown, double radius) {
  return {name, start, 1, 0.05 * radius, 10 * radius, grown, 0.3 * grown};
}

Pose start_of(const Landmarks &landmarks, const CuspAxes &axes, Vec3 shift, const std::array<double, n_cusps> &at) {
  // The mean of the nadirs' directions, each turned back to the direction of the right cusp.
  const Rotation to = rotation_to(landmarks.at(axes.order.nadir[0]) - axes.middle, axes.axis), back = transposed(to);
  double x = 0, y = 0;
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const Vec3 p = rotation_about({0, 0, 1}, -at[cusp]) * (back * (landmarks.at(axes.order.nadir[cusp]) - axes.middle));
    x += p.x / length(p), y += p.y / length(p);
  }
  const Rotation rotation = to * rotation_about({0, 0, 1}, std::atan2(y, x) * 180 / pi);
  return {rotation, axes.middle - rotation * shift};
}

// Sets a parameter so that its ratio to a measure of the valve equals the ratio in the template, `own`.
void set_proportion(const Valve &own, Valve &valve, const std::string &name, double own_measure, double measure) {
  valve.set(name, 1, std::array{value_of(own, name) / own_measure * measure}.data());
}

// Sizes that follow from others by a rule of the valve keep that rule.
void finish_trileaflet(const Valve &own, Valve &valve) {
  const auto middle_radius = [](const Valve &of) {
    return 0.5 * (value_of(of, "root_radius") + value_of(of, "leaflet_radius_out"));
  };
  if (own.is_set("bending_height"))
    set_proportion(own, valve, "bending_height", value_of(own, "leaflet_height"), value_of(valve, "leaflet_height"));
  if (own.is_set("bending_radius_out"))
    set_proportion(own, valve, "bending_radius_out", middle_radius(own), middle_radius(valve));
}

void finish_aortic(const Valve &own, Valve &valve) {
  set_proportion(own, valve, "bending_height", value_of(own, "leaflet_height"), value_of(valve, "leaflet_height"));
  const double right = value_of(valve, "right.leaflet_angle"), left = value_of(valve, "left.leaflet_angle"),
               non_coronary = 180 - right - left;
  const double turns[n_cusps] = {0, right + left, -(right + non_coronary)};
  valve.set("non_coronary.leaflet_angle", 1, &non_coronary);
  std::array<double, 3> shift{};
  own.get("right.translation", 3, shift.data());
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const std::string of = std::string(cusp_names[cusp]) + ".";
    const auto middle_radius = [&](const Valve &valve_of) {
      return 0.5 * (value_of(valve_of, "root_radius") + value_of(valve_of, of + "leaflet_radius_out"));
    };
    const double angle = value_of(valve, of + "leaflet_angle");
    set_proportion(own, valve, of + "bending_angle", value_of(own, of + "leaflet_angle"), angle);
    set_proportion(own, valve, of + "bending_radius_out", middle_radius(own), middle_radius(valve));
    valve.set(of + "rotation", 3, std::array{0.0, 0.0, turns[cusp]}.data());
    valve.set(of + "translation", 3, shift.data());
    // Lowers a power with which the free edge would bulge beyond the plane of its commissure into the next cusp.
    const double x = value_of(valve, of + "leaflet_radius_out") * sine_cosine_degrees(angle).cosine;
    const double radius_in = value_of(valve, of + "leaflet_radius_in");
    if (x > radius_in && value_of(valve, of + "leaflet_power") > x / (x - radius_in))
      valve.set(of + "leaflet_power", 1, std::array{x / (x - radius_in)}.data());
  }
}

}  // namespace

KindOfLandmarks cusp_landmarks(const Valve &valve, const Landmarks &landmarks) {
  const char *kind = valve.kind().name;
  const bool is_aortic = std::strcmp(kind, "aortic") == 0;
  const CuspAxes axes = axes_of(landmarks, kind, is_aortic);
  const double R = mean_radius(landmarks, axes.order.nadir, axes),
               Rc = mean_radius(landmarks, axes.order.commissure, axes), h = axes.height;
  KindOfLandmarks made{nullptr, {}, "root_radius", nullptr};
  if (is_aortic) {
    const Vec3 by = vector_of(valve, "right.translation");
    auto model = std::make_unique<AorticModel>(landmarks, axes, by);
    const double grown = R / value_of(valve, "root_radius");
    const auto add = [&](const std::string &name, double start) {
      model->sizes.push_back(length_size(name, start, grown * value_of(valve, name), R));
    };
    add("root_radius", R);
    add("leaflet_height", h);
    for (const char *cusp : cusp_names) add(std::string(cusp) + ".leaflet_radius_out", Rc);
    for (const char *name : {"right.leaflet_angle", "left.leaflet_angle"})
      model->sizes.push_back({name, 60, Rc * (pi / 180), 25, 77.5, value_of(valve, name), 15});
    made.model = std::move(model);
    made.starts = {start_of(landmarks, axes, by, {0, 120, 240})};
    made.finish = finish_aortic;
  } else {
    const auto *names = std::find_if(std::begin(equal_cusps), std::end(equal_cusps),
                                     [&](const EqualCusps &cusps) { return std::strcmp(cusps.kind, kind) == 0; });
    const Vec3 by = vector_of(valve, "translation");
    auto model = std::make_unique<EqualCuspModel>(landmarks, axes, by);
    const double grown = R / value_of(valve, names->radius);
    model->sizes = {length_size(names->radius, R, grown * value_of(valve, names->radius), R),
                    length_size(names->commissure_radius, Rc, grown * value_of(valve, names->commissure_radius), R),
                    length_size(names->height, h, grown * value_of(valve, names->height), R)};
    made.model = std::move(model);
    made.starts = {start_of(landmarks, axes, by, {0, 120, 240})};
    made.size_name = names->radius;
    if (std::strcmp(kind, "trileaflet") == 0) made.finish = finish_trileaflet;
  }
  made.model->radius = R;
  return made;
}

}  // namespace riis
