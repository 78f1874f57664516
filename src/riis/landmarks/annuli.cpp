// SPDX-License-Identifier: Apache-2.0
// Landmarks of mitral and tricuspid valves: points along an annulus, and points that show the directions in its plane.
#include <riis/riis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/errors.hpp"
#include "common/elementary.hpp"
#include "geometry/curve.hpp"
#include "landmarks/annuli.hpp"
#include "landmarks/fit.hpp"
#include "landmarks/order.hpp"
#include "valve/atrioventricular.hpp"
#include "valve/mitral_annulus.hpp"

namespace riis {

double checked_flow(const Landmarks &landmarks, Vec3 normal, const char *whose) {
  const double along = dot(landmarks.flow, normal);
  constexpr double most_degrees = 75;
  if (std::abs(along) < sine_cosine_degrees(most_degrees).cosine)
    fail(RIIS_INVALID_ARGUMENT, "landmarks.flow is at ", rounded(arc_cosine(std::abs(along)) * 180 / pi, 3),
         " degrees to ", whose, " normal; it must be at most ", most_degrees);
  return along;
}

namespace {

// ---- The annulus ----

// Returns the point of the curve that is nearest to p. The curve may be closed.
template <std::size_t n>
Vec3 nearest_on(const std::array<Bezier, n> &curve, Vec3 p) {
  constexpr int n_samples = 12;
  double least = -1;
  const Bezier *span = nullptr;
  double t = 0;
  for (const Bezier &tried : curve)
    for (int i = 0; i <= n_samples; ++i) {
      const double at = static_cast<double>(i) / n_samples;
      const Vec3 d = evaluate(tried, at) - p;
      if (least >= 0 && dot(d, d) >= least) continue;
      least = dot(d, d), span = &tried, t = at;
    }
  // Finds, by Newton's method and within the span, where the derivative of the squared distance is 0.
  const auto index = static_cast<std::size_t>(span - curve.data());
  const auto refined = [&](const Bezier &on, double from, double &squared) {
    double at = from;
    for (int i = 0; i < 30; ++i) {
      const auto [first, second, third] = derivatives(on, at);
      (void)third;
      const Vec3 d = evaluate(on, at) - p;
      const double slope = dot(d, first), bend = dot(first, first) + dot(d, second);
      const double step = bend > 0 ? -slope / bend : (slope > 0 ? -0.05 : 0.05);
      const double moved = std::clamp(at + std::clamp(step, -0.1, 0.1), 0.0, 1.0);
      if (std::abs(moved - at) < 1e-15) break;
      at = moved;
    }
    const Vec3 on_curve = evaluate(on, at);
    squared = dot(on_curve - p, on_curve - p);
    return on_curve;
  };
  double squared = 0;
  Vec3 best = refined(*span, t, squared);
  // The nearest sample may be the joint of two spans, so both neighbouring spans are searched.
  const bool is_closed = curve.front().first() == curve.back().last();
  for (const bool is_next : {false, true}) {
    if (!is_closed && index == (is_next ? n - 1 : 0)) continue;
    double other_squared = 0;
    const Vec3 there = refined(curve[(index + (is_next ? 1 : n - 1)) % n], is_next ? 0 : 1, other_squared);
    if (other_squared < squared) squared = other_squared, best = there;
  }
  return best;
}

// Refuses an outline that crosses itself, seen along the normal. The outline's edges join the points in their order.
void check_outline(const Landmarks &landmarks, const std::vector<std::size_t> &ring, Vec3 x, Vec3 y) {
  struct Flat {
    double x, y;
  };
  std::vector<Flat> flat;
  for (const std::size_t i : ring) flat.push_back({dot(landmarks.at(i), x), dot(landmarks.at(i), y)});
  const auto turn = [](Flat a, Flat b, Flat c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); };
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // the two edges have a common point
      const Flat &a = flat[i], &b = flat[i + 1], &c = flat[j], &d = flat[(j + 1) % n];
      if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0)
        fail(RIIS_INVALID_ARGUMENT, "the annulus crosses itself: the line from landmark ", ring[i], " to landmark ",
             ring[i + 1], " crosses the line from landmark ", ring[j], " to landmark ", ring[(j + 1) % n],
             "; give the annulus points in their order around it");
    }
}

// Returns twice the area vector of a closed polygon.
Vec3 area_of(const Landmarks &landmarks, const std::vector<std::size_t> &ring) {
  const Vec3 middle = landmarks.mean_of(ring);
  Vec3 area{0, 0, 0};
  for (std::size_t k = 0; k < ring.size(); ++k)
    area = area + cross(landmarks.at(ring[k]) - middle, landmarks.at(ring[(k + 1) % ring.size()]) - middle);
  return area;
}

// The checked points of an annulus.
struct Outline {
  std::vector<std::size_t> ring;
  Vec3 middle, normal;
  double size;  // the largest standard deviation of the points
};

Outline outline_of(const Landmarks &landmarks) {
  const auto ring = landmarks.with_role(RIIS_LANDMARK_ANNULUS);
  check_spread(landmarks, ring, one_place);
  const Spread spread = spread_of(landmarks, ring);
  check_outline(landmarks, ring, spread.direction[0], spread.direction[1]);
  return {ring, landmarks.mean_of(ring), unit(area_of(landmarks, ring)), spread.deviation[0]};
}

// The points of an annulus in the coordinates of a valve, and the range of these coordinates.
struct TurnedOutline {
  std::vector<Vec3> points;
  Vec3 lower{0, 0, 0}, upper{0, 0, 0};  // z is not used
};

TurnedOutline turned_outline(const Landmarks &landmarks, const Outline &outline, const Rotation &back) {
  TurnedOutline made;
  for (const std::size_t i : outline.ring) {
    const Vec3 p = back * (landmarks.at(i) - outline.middle);
    made.points.push_back(p);
    made.lower = {std::min(made.lower.x, p.x), std::min(made.lower.y, p.y), 0};
    made.upper = {std::max(made.upper.x, p.x), std::max(made.upper.y, p.y), 0};
  }
  return made;
}

// Returns the direction from the annulus' middle to its anterior horn, seen along its normal.
Vec3 checked_forward(const Landmarks &landmarks, const Outline &outline, std::size_t horn) {
  const Vec3 to_horn = landmarks.at(horn) - outline.middle,
             forward = to_horn - dot(to_horn, outline.normal) * outline.normal;
  if (!(length(forward) > 0.3 * outline.size))
    fail(RIIS_INVALID_ARGUMENT, words_for(landmarks, horn), " is ", rounded(landmarks.scale * length(forward), 3),
         " from the annulus' middle, seen along its normal; it must be on the annulus");
  return forward;
}

// Returns the direction towards the atrium, found from the flow or the commissures. The vector is 0 if the landmarks show no
// direction.
Vec3 atrial_side(const Landmarks &landmarks, Vec3 normal, Vec3 forward) {
  const auto medial = landmarks.with_role(RIIS_LANDMARK_POSTEROMEDIAL),
             lateral = landmarks.with_role(RIIS_LANDMARK_ANTEROLATERAL);
  Vec3 found{0, 0, 0};
  if (landmarks.has_flow()) found = checked_flow(landmarks, normal, "the annulus'") > 0 ? -normal : normal;
  if (medial.empty() || lateral.empty()) return found;
  const double side = dot(cross(landmarks.at(medial[0]) - landmarks.at(lateral[0]), forward), normal);
  const Vec3 by_commissures = side > 0 ? normal : -normal;
  if (landmarks.has_flow() && dot(found, by_commissures) < 0)
    fail(RIIS_INVALID_ARGUMENT,
         "landmarks.flow contradicts the commissures, which show that this direction leads to the atrium. Seen along "
         "the flow with the anterior horn above, the posteromedial commissure must be on the right. The flow is "
         "reversed, or the landmarks or their names are mirrored");
  return by_commissures;
}

// Returns the part of a message that names the landmark with the largest residual.
std::string advice_for(const LandmarkFit &fit, const Landmarks &landmarks) {
  const auto worst = std::max_element(fit.residuals.begin(), fit.residuals.end());
  return std::string("the worst residual is ") + Message(rounded(landmarks.scale * *worst, 3)).text() + " at " +
         words_for(landmarks, static_cast<std::size_t>(worst - fit.residuals.begin())) +
         ": look for a landmark that is misplaced or misnamed";
}

// Returns the angle between the axis of a fitted valve and the annulus' normal, in degrees.
double lean_of(const LandmarkFit &fit, Vec3 normal) {
  return arc_cosine(std::min(1.0, std::abs((transposed(fit.pose.rotation) * normal).z))) * 180 / pi;
}

// Refuses a fitted valve whose axis is oblique to the annulus.
void check_axis(const LandmarkFit &fit, Vec3 normal, const std::string &advice) {
  const double degrees = lean_of(fit, normal);
  constexpr double most_degrees = 20;
  if (degrees > most_degrees)
    fail(RIIS_INVALID_ARGUMENT, "the axis of the fitted valve is at ", rounded(degrees, 3),
         " degrees to the annulus' normal; it must be at most ", most_degrees, "; ", advice);
}

// ---- Mitral ----

Vec3 mirrored(Vec3 p) { return {-p.x, p.y, p.z}; }

class MitralModel : public LandmarkModel {
 public:
  enum Size { ap, alpm, position, it, indent, anterior, posterior, share };
  // The trigones of the modelled valve lie in front of the anterior horn. If the landmarks' trigones lie behind the horn, they
  // therefore count only as points of the annulus.
  MitralModel(const Landmarks &landmarks, Vec3 shift, bool has_trigones_behind) : shift_(shift) {
    for (const Landmark &landmark : landmarks.list) {
      const bool is_only_of_annulus = has_trigones_behind && landmark.role == RIIS_LANDMARK_TRIGONE;
      roles_.push_back(is_only_of_annulus ? RIIS_LANDMARK_ANNULUS : landmark.role);
    }
  }

  std::size_t n_equations() const override {
    std::size_t n = 0;
    for (const std::int32_t role : roles_) n += role == RIIS_LANDMARK_ANNULUS ? 2 : 3;
    return n;
  }

  void offsets(const std::vector<double> &values, const std::vector<Vec3> &local,
               std::vector<Offset> &out) const override {
    const std::array<Bezier, 3> half = half_annulus(
        {values[ap], values[alpm], values[position], values[it], values[indent], values[anterior], values[posterior]});
    const bool has_commissures = std::any_of(roles_.begin(), roles_.end(), [](std::int32_t role) {
      return role == RIIS_LANDMARK_POSTEROMEDIAL || role == RIIS_LANDMARK_ANTEROLATERAL;
    });
    const Vec3 commissure = has_commissures ? Curve({half.begin(), half.end()}).at(1 - values[share]) : Vec3{0, 0, 0};
    out.clear();
    for (std::size_t i = 0; i < roles_.size(); ++i) {
      const Vec3 p = local[i] - shift_, right{std::abs(p.x), p.y, p.z};
      const auto side = [&](Vec3 place) { return p.x < 0 ? mirrored(place) : place; };
      const auto place = [&]() -> Vec3 {
        switch (roles_[i]) {
          case RIIS_LANDMARK_ANTERIOR_HORN:
            return half[2].last();
          case RIIS_LANDMARK_POSTERIOR_HORN:
            return half[0].first();
          case RIIS_LANDMARK_TRIGONE:
            return side(half[1].last());
          case RIIS_LANDMARK_POSTEROMEDIAL:
            return commissure;
          case RIIS_LANDMARK_ANTEROLATERAL:
            return mirrored(commissure);
          default:
            return side(nearest_on(half, right));
        }
      };
      out.push_back({i, p - place()});
    }
  }

 private:
  Vec3 shift_;
  std::vector<std::int32_t> roles_;
};

// Refuses a fit if the heights of its horns do not show on which side of the annulus the atrium is.
void check_side(const LandmarkModel &fitted, const Landmarks &landmarks) {
  const FittedSize &anterior = fitted.sizes[MitralModel::anterior], &posterior = fitted.sizes[MitralModel::posterior];
  const double height = 0.5 * (anterior.value + posterior.value),
               error = 0.5 * (anterior.standard_error + posterior.standard_error);
  constexpr double sure = 3;
  if (height > sure * error) return;
  fail(RIIS_INVALID_ARGUMENT,
       "landmarks.flow is needed: without it only the horns of the annulus show the atrium's side, and they are ",
       rounded(landmarks.scale * height, 3), " nearer to the atrium than the sides, with a standard error of ",
       rounded(landmarks.scale * error, 3), "; the difference must be at least ", sure, " standard errors");
}

// The distance between the two horns of the landmarks, seen along the annulus' normal.
struct ShownDepth {
  double depth;
  bool has_posterior_horn;  // if false, the annulus point farthest from the anterior horn replaces it
};

// The heights of the two horns of an annulus above its sides, measured along its normal.
struct HornHeights {
  std::size_t anterior_landmark, posterior_landmark;
  double anterior, posterior;
  double usual_difference;  // the difference in the valve's proportions
  double depth;             // the distance between the horns
};

// Returns the part of a message that says why a fit contradicts the landmarks. If one horn is too high or the other too low, the
// annulus looks inclined. The fitted valve is then also inclined, and the largest residual may belong to a correct landmark.
std::string cause_of(const LandmarkFit &fit, const Landmarks &landmarks, Vec3 normal, const HornHeights &heights) {
  const double degrees = lean_of(fit, normal);
  const double by_heights =
      arc_tangent(std::abs(heights.anterior - heights.posterior - heights.usual_difference), heights.depth) * 180 / pi;
  constexpr double upright_degrees = 5;
  if (degrees < upright_degrees || by_heights < 0.5 * degrees) return advice_for(fit, landmarks);
  const auto words = [&](std::size_t landmark, double height) -> std::string {
    return Message(words_for(landmarks, landmark), " is ", rounded(landmarks.scale * std::abs(height), 3),
                   height < 0 ? " below" : " above")
        .text();
  };
  return Message("the horns' heights make the valve lean: ", words(heights.anterior_landmark, heights.anterior),
                 " and ", words(heights.posterior_landmark, heights.posterior),
                 " the annulus' sides, along the annulus' normal; look for a misplaced horn")
      .text();
}

// Refuses a fitted valve whose depth differs from the depth of the annulus.
void check_depth(const LandmarkModel &fitted, const Landmarks &landmarks, const ShownDepth &shown,
                 const std::string &advice) {
  const FittedSize &ap = fitted.sizes[MitralModel::ap];
  // The limit allows for noise, because noise changes the distance between the horns.
  const double most_apart = std::max(shown.depth / 12, 5 * landmarks.noise);
  if (ap.held || std::abs(ap.value - shown.depth) <= most_apart) return;
  fail(RIIS_INVALID_ARGUMENT, "AP_diameter of the fitted valve is ", rounded(landmarks.scale * ap.value, 3),
       shown.has_posterior_horn ? ", but the horns are " : ", but the annulus reaches ",
       rounded(landmarks.scale * shown.depth, 3),
       shown.has_posterior_horn ? " apart, seen along the annulus' normal"
                                : " behind the anterior horn, seen along its normal",
       "; the difference must be at most ", rounded(landmarks.scale * most_apart, 3), "; ", advice);
}

// Refuses a posterior horn or a trigone on the wrong side of the annulus. `y_of` returns a landmark's coordinate from back to
// front: 0 at the posterior point, and `depth` at the anterior horn.
template <class Place>
void check_sides(const Landmarks &landmarks, std::size_t horn, double depth, const Place &y_of) {
  const auto check = [&](std::int32_t role, bool is_anterior) {
    for (const std::size_t i : landmarks.with_role(role))
      if ((y_of(i) > 0.5 * depth) != is_anterior)
        fail(RIIS_INVALID_ARGUMENT, words_for(landmarks, i), " is ", rounded(landmarks.scale * (depth - y_of(i)), 3),
             " behind ", words_for(landmarks, horn), ", and the annulus reaches ", rounded(landmarks.scale * depth, 3),
             " behind it: it must be on the ", is_anterior ? "anterior" : "posterior",
             " side, or the anterior horn is in the wrong place");
  };
  check(RIIS_LANDMARK_POSTERIOR_HORN, false);
  check(RIIS_LANDMARK_TRIGONE, true);
}

}  // namespace

KindOfLandmarks mitral_landmarks(const Valve &valve, const Landmarks &landmarks) {
  const char *kind = valve.kind().name;
  check_roles(landmarks, kind,
              {RIIS_LANDMARK_ANNULUS, RIIS_LANDMARK_ANTERIOR_HORN, RIIS_LANDMARK_POSTERIOR_HORN, RIIS_LANDMARK_TRIGONE,
               RIIS_LANDMARK_POSTEROMEDIAL, RIIS_LANDMARK_ANTEROLATERAL});
  check_count(landmarks, kind, RIIS_LANDMARK_ANNULUS, 4, 0);
  check_count(landmarks, kind, RIIS_LANDMARK_ANTERIOR_HORN, 1, 1);
  check_count(landmarks, kind, RIIS_LANDMARK_POSTERIOR_HORN, 0, 1);
  check_count(landmarks, kind, RIIS_LANDMARK_TRIGONE, 0, 2);
  check_count(landmarks, kind, RIIS_LANDMARK_POSTEROMEDIAL, 0, 1);
  check_count(landmarks, kind, RIIS_LANDMARK_ANTEROLATERAL, 0, 1);
  const Outline outline = outline_of(landmarks);
  const Vec3 middle = outline.middle, normal = outline.normal;
  const std::size_t horn = landmarks.with_role(RIIS_LANDMARK_ANTERIOR_HORN)[0];
  const Vec3 to_horn = landmarks.at(horn) - middle, forward = checked_forward(landmarks, outline, horn);
  const Vec3 known = atrial_side(landmarks, normal, forward);
  const bool is_side_known = !(known == Vec3{0, 0, 0});
  const Vec3 up = is_side_known ? known : normal;
  const Rotation rotation = rotation_to(cross(forward, up), up), back = transposed(rotation);
  const auto [points, lower, upper] = turned_outline(landmarks, outline, back);
  const Vec3 widest = *std::max_element(points.begin(), points.end(),
                                        [](const Vec3 &a, const Vec3 &b) { return std::abs(a.x) < std::abs(b.x); });
  const double low_z = widest.z;
  const auto farthest =
      std::min_element(points.begin(), points.end(), [](const Vec3 &a, const Vec3 &b) { return a.y < b.y; });
  const double posterior_z = farthest->z;
  const Vec3 horn_there = back * to_horn;
  const double low_y = lower.y, depth = horn_there.y - low_y, width = upper.x - lower.x;
  const auto y_of = [&](std::size_t i) { return (back * (landmarks.at(i) - middle)).y - low_y; };
  check_sides(landmarks, horn, depth, y_of);
  const auto posterior_horns = landmarks.with_role(RIIS_LANDMARK_POSTERIOR_HORN),
             trigones = landmarks.with_role(RIIS_LANDMARK_TRIGONE);
  const bool has_posterior_horn = !posterior_horns.empty();
  const ShownDepth shown{has_posterior_horn ? depth - y_of(posterior_horns[0]) : depth, has_posterior_horn};
  const auto to_trigones = [&](double sum, std::size_t i) { return sum + y_of(i) - depth; };
  const bool are_behind = std::accumulate(trigones.begin(), trigones.end(), 0.0, to_trigones) < 0;

  const Vec3 by = vector_of(valve, "translation");
  auto model = std::make_unique<MitralModel>(landmarks, by, are_behind);
  const double grown = depth / value_of(valve, "AP_diameter"), largest = 5 * depth;
  const auto add = [&](const char *name, double start, double least, double most, double spread_share) {
    const double expected = grown * value_of(valve, name);
    model->sizes.push_back({name, start, 1, least, most, expected, spread_share * depth});
  };
  add("AP_diameter", depth, 0.3 * depth, 3 * depth, 0.5);
  add("ALPM_diameter", width, 0.3 * depth, largest, 0.3);
  const double position = value_of(valve, "ALPM_position_ratio");
  model->sizes.push_back(
      {"ALPM_position_ratio", std::clamp((widest.y - lower.y) / depth, 0.3, 0.8), depth, 0.06, 0.94, position, 0.1});
  add("IT_distance", grown * value_of(valve, "IT_distance"), 0.1 * depth, largest, 0.3);
  add("indent_depth", grown * value_of(valve, "indent_depth"), 0, 0.9 * depth, 0.3);
  add("anterior_horn_height", horn_there.z - low_z, -2 * depth, 2 * depth, 0.2);
  add("posterior_horn_height", posterior_z - low_z, -2 * depth, 2 * depth, 0.2);
  const bool has_commissures =
      landmarks.count(RIIS_LANDMARK_POSTEROMEDIAL) + landmarks.count(RIIS_LANDMARK_ANTEROLATERAL) > 0;
  const double share = value_of(valve, "anterior_ratio");
  model->sizes.push_back({"anterior_ratio", share, 1.5 * depth, 0.05, 0.95, share, 0.1});
  model->sizes.back().held = !has_commissures;
  model->radius = 0.5 * depth;
  // A change of the horns' heights moves the annulus in nearly the same way as a turn of the valve about x. The landmarks hardly
  // show which of these took place.
  model->differences = {{MitralModel::anterior, MitralModel::posterior, 0.05 * depth}};

  const Vec3 origin_there{0.5 * (lower.x + upper.x), lower.y + 0.5 * depth, low_z};
  KindOfLandmarks made = one_model(std::move(model), {}, "AP_diameter");
  made.n_as_annulus = are_behind ? static_cast<std::int32_t>(trigones.size()) : 0;
  made.starts.push_back({rotation, middle + rotation * (origin_there - by)});
  if (!is_side_known) {
    // The points of the annulus alone do not show on which side the atrium is. In a healthy annulus, however, the horns are
    // nearer to the atrium than the annulus' sides are.
    const bool is_turned = horn_there.z + posterior_z < 2 * low_z;
    if (is_turned) {
      const Rotation other = rotation * rotation_about({0, 1, 0}, 180);
      const Vec3 there{-origin_there.x, origin_there.y, -low_z};
      made.starts[0] = {other, middle + other * (there - by)};
      for (const std::size_t horn_size : {MitralModel::anterior, MitralModel::posterior})
        made.models[0]->sizes[horn_size].value *= -1;
    }
  }
  // With few noisy points, the fit may end in a wrong inclination. The fit therefore also starts from inclined poses.
  const Pose upright = made.starts[0];
  for (const double lean : {-10.0, 10.0})
    made.starts.push_back({upright.rotation * rotation_about({1, 0, 0}, lean), upright.translation});
  const std::size_t posterior =
      has_posterior_horn ? posterior_horns[0] : outline.ring[static_cast<std::size_t>(farthest - points.begin())];
  const HornHeights heights{
      horn,
      posterior,
      horn_there.z - low_z,
      (back * (landmarks.at(posterior) - middle)).z - low_z,
      grown * (value_of(valve, "anterior_horn_height") - value_of(valve, "posterior_horn_height")),
      depth};
  made.check = [=](const LandmarkModel &fitted, const LandmarkFit &fit, const Landmarks &given) {
    if (!is_side_known) check_side(fitted, given);
    const std::string cause = cause_of(fit, given, normal, heights);
    check_axis(fit, normal, cause);
    check_depth(fitted, given, shown, cause);
  };
  return made;
}

// ---- Tricuspid, and mitral_coapting ----

namespace {

// Kinds whose annulus is a saddle, with the names of their sizes.
struct SaddleKind {
  const char *kind, *width, *depth, *flat_ratio;
  const char *anterior_ratio;  // null if the flat side belongs to the anterior leaflet
  FlatSide flat_side;
};
constexpr SaddleKind tricuspid{"tricuspid",    "AP_diameter",    "SL_diameter",
                               "septal_ratio", "anterior_ratio", FlatSide::at_negative_y};
constexpr SaddleKind mitral_coapting{"mitral_coapting", "ALPM_diameter", "AP_diameter",
                                     "anterior_ratio",  nullptr,         FlatSide::at_positive_y};

// The place of each landmark along the annulus, as a fraction of the whole way round from the middle of the flat side. A landmark
// without a value may be anywhere on the annulus.
using Laps = std::vector<std::optional<LinearValue>>;

class SaddleModel : public LandmarkModel {
 public:
  enum Size { width, depth, flatness, saddle_height, flat_ratio, anterior_ratio };
  SaddleModel(FlatSide flat_side, Laps laps, Vec3 shift)
      : flat_side_(flat_side), laps_(std::move(laps)), shift_(shift) {}

  std::size_t n_equations() const override {
    std::size_t n = 0;
    for (const auto &at : laps_) n += at ? 3 : 2;
    return n;
  }

  void offsets(const std::vector<double> &values, const std::vector<Vec3> &local,
               std::vector<Offset> &out) const override {
    const std::array<Bezier, 4> lap =
        saddle_annulus({values[width], values[depth], values[flatness], values[saddle_height], flat_side_});
    const Curve curve({lap.begin(), lap.end()});
    out.clear();
    for (std::size_t i = 0; i < laps_.size(); ++i) {
      const Vec3 p = local[i] - shift_;
      const double at = laps_[i] ? laps_[i]->at(values) : 0;
      out.push_back({i, p - (laps_[i] ? curve.at(at - std::floor(at)) : nearest_on(lap, p))});
    }
  }

 private:
  FlatSide flat_side_;
  Laps laps_;
  Vec3 shift_;
};

// `forward` is the direction of y, and `up` is the direction of z.
KindOfLandmarks saddle_landmarks(const Valve &valve, const SaddleKind &names, const Landmarks &landmarks,
                                 const Outline &outline, Vec3 forward, Vec3 up, const Laps &laps) {
  const Rotation rotation = rotation_to(cross(forward, up), up);
  const TurnedOutline turned = turned_outline(landmarks, outline, transposed(rotation));
  const Vec3 by = vector_of(valve, "translation"), extent = turned.upper - turned.lower;
  const double depth = extent.y, grown = depth / value_of(valve, names.depth);
  auto model = std::make_unique<SaddleModel>(names.flat_side, laps, by);
  model->radius = 0.5 * depth;
  const double own_flatness = value_of(valve, "flatness"), saddle = grown * value_of(valve, "saddle_height");
  model->sizes = {{names.width, extent.x, 1, 0.3 * depth, 3 * depth, grown * value_of(valve, names.width), 0.3 * depth},
                  {names.depth, depth, 1, 0.3 * depth, 3 * depth, depth, 0.5 * depth},
                  {"flatness", own_flatness, 0.15 * depth, 0, 1, own_flatness, 0.5},
                  {"saddle_height", saddle, 0.5, 0, 0.5 * depth, saddle, 0.1 * depth}};
  const bool has_commissures =
      std::any_of(laps.begin(), laps.end(), [](const auto &at) { return at && !at->terms.empty(); });
  for (const char *name : {names.flat_ratio, names.anterior_ratio}) {
    if (!name) continue;
    const double share = value_of(valve, name), half_lap = 1.5 * depth;  // a leaflet grows at both of its ends
    model->sizes.push_back({name, share, half_lap, 0.05, 0.9, share, 0.1});
    model->sizes.back().held = !has_commissures;
  }
  const double flat_y = saddle_annulus({extent.x, depth, own_flatness, saddle, names.flat_side})[0].first().y;
  const Vec3 origin{0.5 * (turned.lower.x + turned.upper.x),
                    (names.flat_side == FlatSide::at_negative_y ? turned.lower.y : turned.upper.y) - flat_y, 0};
  KindOfLandmarks made =
      one_model(std::move(model), {{rotation, outline.middle + rotation * (origin - by)}}, names.depth);
  made.check = [normal = outline.normal](const LandmarkModel &, const LandmarkFit &fit, const Landmarks &given) {
    check_axis(fit, normal, advice_for(fit, given));
  };
  return made;
}

}  // namespace

KindOfLandmarks tricuspid_landmarks(const Valve &valve, const Landmarks &landmarks) {
  check_roles(landmarks, tricuspid.kind, {RIIS_LANDMARK_ANNULUS, RIIS_LANDMARK_COMMISSURE});
  check_count(landmarks, tricuspid.kind, RIIS_LANDMARK_ANNULUS, 4, 0);
  check_count(landmarks, tricuspid.kind, RIIS_LANDMARK_COMMISSURE, 3, 3);
  const Outline outline = outline_of(landmarks);
  check_spread(landmarks, landmarks.with_role(RIIS_LANDMARK_COMMISSURE), 0.02);
  const LeafletsAround leaflets{
      {"anterior", "septal", "posterior"},
      "counter-clockwise",
      "between which two leaflets each commissure lies: name the leaflets of two commissures"};
  check_leaflet_ids(landmarks, leaflets);
  // If the flow is unknown, the names of the leaflets show which side is the atrium.
  Vec3 up = outline.normal;
  const bool is_turned = landmarks.has_flow() ? checked_flow(landmarks, up, "the annulus'") > 0
                                              : !names_fit(landmarks, leaflets, up, outline.middle);
  if (is_turned) up = -up;
  const Order order = order_around(landmarks, leaflets, up, outline.middle);
  if (!landmarks.has_flow() && names_fit(landmarks, leaflets, -up, outline.middle))
    fail(RIIS_INVALID_ARGUMENT,
         "landmarks.flow is 0 0 0: one named commissure does not show the direction of flow; name two commissures");
  const auto at = [&](std::size_t k) { return landmarks.at(order.commissure[k]); };
  Laps laps(landmarks.list.size());
  laps[order.commissure[0]] = LinearValue{0, {{SaddleModel::flat_ratio, -0.5}}};
  laps[order.commissure[1]] = LinearValue{0, {{SaddleModel::flat_ratio, 0.5}}};
  laps[order.commissure[2]] = LinearValue{1, {{SaddleModel::flat_ratio, -0.5}, {SaddleModel::anterior_ratio, -1}}};
  // The septal leaflet is at -y, between the first two commissures.
  return saddle_landmarks(valve, tricuspid, landmarks, outline, at(2) - 0.5 * (at(0) + at(1)), up, laps);
}

KindOfLandmarks mitral_coapting_landmarks(const Valve &valve, const Landmarks &landmarks) {
  const char *kind = mitral_coapting.kind;
  check_roles(landmarks, kind,
              {RIIS_LANDMARK_ANNULUS, RIIS_LANDMARK_ANTERIOR_HORN, RIIS_LANDMARK_POSTERIOR_HORN,
               RIIS_LANDMARK_POSTEROMEDIAL, RIIS_LANDMARK_ANTEROLATERAL});
  check_count(landmarks, kind, RIIS_LANDMARK_ANNULUS, 4, 0);
  for (const std::int32_t role : {RIIS_LANDMARK_ANTERIOR_HORN, RIIS_LANDMARK_POSTERIOR_HORN,
                                  RIIS_LANDMARK_POSTEROMEDIAL, RIIS_LANDMARK_ANTEROLATERAL})
    check_count(landmarks, kind, role, 0, 1);
  const Outline outline = outline_of(landmarks);
  const auto horns = landmarks.with_role(RIIS_LANDMARK_ANTERIOR_HORN),
             medial = landmarks.with_role(RIIS_LANDMARK_POSTEROMEDIAL),
             lateral = landmarks.with_role(RIIS_LANDMARK_ANTEROLATERAL);
  const bool has_both = !medial.empty() && !lateral.empty();
  if (horns.empty() && !has_both)
    fail(RIIS_INVALID_ARGUMENT, "landmarks.role has the anterior_horn 0 times; the ", kind,
         " valve needs 1, or both commissures");
  if (!landmarks.has_flow() && (horns.empty() || !has_both))
    fail(RIIS_INVALID_ARGUMENT, "landmarks.flow is 0 0 0: without it, only the anterior horn and both commissures ",
         "together show the direction of flow of the ", kind, " valve");
  Vec3 forward{0, 0, 0}, up{0, 0, 0};
  if (horns.empty()) {
    up = checked_flow(landmarks, outline.normal, "the annulus'") > 0 ? -outline.normal : outline.normal;
    forward = cross(up, landmarks.at(medial[0]) - landmarks.at(lateral[0]));
  } else {
    forward = checked_forward(landmarks, outline, horns[0]);
    up = atrial_side(landmarks, outline.normal, forward);
  }
  Laps laps(landmarks.list.size());
  for (const std::size_t i : horns) laps[i] = LinearValue{0, {}};
  for (const std::size_t i : landmarks.with_role(RIIS_LANDMARK_POSTERIOR_HORN)) laps[i] = LinearValue{0.5, {}};
  for (const std::size_t i : lateral) laps[i] = LinearValue{0, {{SaddleModel::flat_ratio, 0.5}}};
  for (const std::size_t i : medial) laps[i] = LinearValue{0, {{SaddleModel::flat_ratio, -0.5}}};
  return saddle_landmarks(valve, mitral_coapting, landmarks, outline, forward, up, laps);
}

}  // namespace riis
