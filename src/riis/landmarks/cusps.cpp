// SPDX-License-Identifier: Apache-2.0
// Landmarks of valves with two to four cusps: commissures, nadirs, and perhaps the point where the closed cusps meet.
#include <riis/riis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/errors.hpp"
#include "common/elementary.hpp"
#include "landmarks/fit.hpp"
#include "landmarks/order.hpp"
#include "valve/cusp_numbers.hpp"

namespace riis {
namespace {

// A warp has at most 1000 landmarks. The limit of 900 leaves room for landmarks that are not along the attachment.
constexpr std::size_t most_along_attachment = 900;
// The names of three cusps are in the order of the leaflet ids, counter-clockwise about the valve's axis z.
constexpr std::size_t n_of_three = 3;
const char *const names_of_three[n_of_three] = {"right", "left", "non_coronary"};

// Kinds whose cusps all begin on one circle at the root, and whose commissures all lie on another circle. The members are the
// names of the sizes.
struct CuspsOnCircles {
  const char *kind;
  std::size_t n_cusps;
  const char *radius, *commissure_radius, *height;
  bool has_sectors;  // each cusp has its own sector, and each commissure its own height
};
constexpr CuspsOnCircles cusps_on_circles[] = {
    {"trileaflet", 3, "root_radius", "leaflet_radius_out", "leaflet_height", false},
    {"bicuspid", 2, "root_radius", "commissure_radius", "commissure_height", true},
    {"coapting", 3, "root_radius", "commissure_radius", "commissure_height", true},
    {"quadricuspid", 4, "root_radius", "commissure_radius", "commissure_height", true}};

std::string of_cusp(std::size_t cusp, const char *name) { return "cusp_" + std::to_string(cusp) + "." + name; }
std::string height_of_commissure(std::size_t cusp) { return "commissure_" + std::to_string(cusp) + ".height"; }

Vec3 turned(double radius, double degrees, double height) {
  const auto [sine, cosine] = sine_cosine_degrees(degrees);
  return {radius * cosine, radius * sine, height};
}

LeafletsAround cusps_of(const char *kind, std::size_t n_cusps) {
  const bool needs_names = std::strcmp(kind, "aortic") == 0;
  LeafletsAround made{{},
                      "clockwise",
                      needs_names ? "which nadirs belong to the right, the left and the non_coronary cusp, because the "
                                    "cusps of an aortic valve differ"
                                  : nullptr};
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp)
    made.names.push_back(n_cusps == n_of_three ? names_of_three[cusp] : "cusp_" + std::to_string(cusp));
  return made;
}

struct CuspAxes {
  Order order;
  Vec3 axis, middle;  // the middle of the nadirs
  double height;

  std::size_t n_cusps() const { return order.nadir.size(); }
};

CuspAxes axes_of(const Landmarks &landmarks, const char *kind, std::size_t n_cusps) {
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
  for (const auto *list : {&nadirs, &commissures}) {
    check_apart(landmarks, *list, one_place);
    if (n_cusps > 2) check_not_collinear(landmarks, *list);
  }
  const LeafletsAround cusps = cusps_of(kind, n_cusps);
  check_leaflet_ids(landmarks, cusps);
  const auto is_named = [&](std::size_t i) { return landmarks.list[i].leaflet_ids[0] != -1; };
  if (std::none_of(all.begin(), all.end(), is_named))
    for (const std::size_t i : landmarks.with_role(RIIS_LANDMARK_ATTACHMENT))
      if (is_named(i))
        fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, i), " says ",
             cusps.names[static_cast<std::size_t>(landmarks.list[i].leaflet_ids[0])],
             ", but no name of a nadir or commissure says which cusp this is");

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
    fail(RIIS_INVALID_ARGUMENT, "landmarks.flow is at ", rounded(arc_cosine(std::max(-1.0, against)) * 180 / pi, 3),
         " degrees to the direction from the nadirs to the commissures, which must point downstream");
  return {order_around(landmarks, cusps, axis, middle), axis, middle, length(up)};
}

// ---- Models ----

class CuspModel : public LandmarkModel {
 public:
  CuspModel(const Landmarks &landmarks, const CuspAxes &axes, Vec3 shift)
      : order_(axes.order), shift_(shift), coaptation_(landmarks.with_role(RIIS_LANDMARK_COAPTATION)) {}
  std::size_t n_equations() const override { return 3 * 2 * order_.nadir.size() + 2 * coaptation_.size(); }

 protected:
  void add(std::size_t landmark, const std::vector<Vec3> &local, Vec3 place, std::vector<Offset> &out) const {
    out.push_back({landmark, local[landmark] - shift_ - place});
  }
  // The closed cusps meet at a point with the coordinate x on the x axis. x differs from 0 only in valves with two cusps. The
  // height of this point differs much between people, so it says little about the sizes.
  void add_coaptation(const std::vector<Vec3> &local, double x, std::vector<Offset> &out) const {
    for (const std::size_t i : coaptation_) {
      const Vec3 p = local[i] - shift_;
      out.push_back({i, {p.x - x, p.y, 0}});
    }
  }

  Order order_;

 private:
  Vec3 shift_;
  std::vector<std::size_t> coaptation_;
};

// Returns the directions of the cusps' middles in degrees. Between the middles of two successive cusps, the direction grows by
// half the sum of their sectors.
std::vector<double> middles_of(const std::vector<double> &sectors) {
  std::vector<double> middles{0};
  for (std::size_t cusp = 1; cusp < sectors.size(); ++cusp)
    middles.push_back(middles.back() + 0.5 * (sectors[cusp - 1] + sectors[cusp]));
  return middles;
}

class CirclesModel : public CuspModel {
 public:
  enum Size { radius_, commissure_radius, n_common };
  using CuspModel::CuspModel;
  std::vector<LinearValue> sectors, heights;  // each cusp's sector, and the height of the commissure behind it
  double meeting_shift = 0;
  void offsets(const std::vector<double> &values, const std::vector<Vec3> &local,
               std::vector<Offset> &out) const override {
    std::vector<double> degrees;
    for (const LinearValue &sector : sectors) degrees.push_back(sector.at(values));
    const std::vector<double> middles = middles_of(degrees);
    out.clear();
    for (std::size_t cusp = 0; cusp < sectors.size(); ++cusp) {
      add(order_.nadir[cusp], local, turned(values[radius_], middles[cusp], 0), out);
      add(order_.commissure[cusp], local,
          turned(values[commissure_radius], middles[cusp] + 0.5 * degrees[cusp], heights[cusp].at(values)), out);
    }
    add_coaptation(local, meeting_shift * values[commissure_radius], out);
  }
};

// The cusps of the paper's valve. At a commissure, two neighbouring cusps end at the same angle but at different radii. The
// commissure lies between these two ends.
class AorticModel : public CuspModel {
 public:
  using CuspModel::CuspModel;
  enum Size { radius_, height_, end_radius, angle = end_radius + 3, n_sizes = angle + 2 };
  void offsets(const std::vector<double> &values, const std::vector<Vec3> &local,
               std::vector<Offset> &out) const override {
    const double R = values[radius_], h = values[height_], right = values[angle], left = values[angle + 1];
    const double half[n_of_three] = {right, left, 180 - right - left};
    const double at[n_of_three] = {0, right + left, -(right + half[2])};
    out.clear();
    for (std::size_t cusp = 0; cusp < n_of_three; ++cusp) {
      const std::size_t after = (cusp + 1) % n_of_three;
      add(order_.nadir[cusp], local, turned(R, at[cusp], 0), out);
      add(order_.commissure[cusp], local, turned(values[end_radius + cusp], at[cusp] + half[cusp], h), out);
      add(order_.commissure[cusp], local, turned(values[end_radius + after], at[after] - half[after], h), out);
    }
    add_coaptation(local, 0, out);
  }
};

// ---- Sizes ----

double mean_radius(const Landmarks &landmarks, const std::vector<std::size_t> &numbers, const CuspAxes &axes) {
  double sum = 0;
  for (const std::size_t i : numbers) {
    const Vec3 p = landmarks.at(i) - axes.middle;
    sum += length(p - dot(p, axes.axis) * axes.axis);
  }
  return sum / static_cast<double>(numbers.size());
}

// Returns a length for the fit. The fit begins with the value `start`. The expected value `grown` is the template's length times
// the ratio of the valves' sizes.
FittedSize length_size(const std::string &name, double start, double grown, double radius) {
  return {name, start, 1, 0.05 * radius, 10 * radius, grown, 0.3 * grown};
}

// `at` has the directions of the cusps' middles.
Pose start_of(const Landmarks &landmarks, const CuspAxes &axes, Vec3 shift, const std::vector<double> &at) {
  // Sums the directions of the nadirs, after each nadir was turned back to the place of cusp 0's nadir.
  const Rotation to = rotation_to(landmarks.at(axes.order.nadir[0]) - axes.middle, axes.axis), back = transposed(to);
  double x = 0, y = 0;
  for (std::size_t cusp = 0; cusp < at.size(); ++cusp) {
    const Vec3 p = rotation_about({0, 0, 1}, -at[cusp]) * (back * (landmarks.at(axes.order.nadir[cusp]) - axes.middle));
    x += p.x / length(p), y += p.y / length(p);
  }
  const Rotation rotation = to * rotation_about({0, 0, 1}, arc_tangent(y, x) * 180 / pi);
  return {rotation, axes.middle - rotation * shift};
}

// ---- Sectors, and heights of commissures ----

// Returns the angles between successive commissures of the landmarks.
std::vector<double> shown_sectors(const Landmarks &landmarks, const CuspAxes &axes) {
  const Rotation back = transposed(rotation_to(landmarks.at(axes.order.nadir[0]) - axes.middle, axes.axis));
  const auto direction = [&](std::size_t cusp) {
    const Vec3 p = back * (landmarks.at(axes.order.commissure[cusp]) - axes.middle);
    return arc_tangent(p.y, p.x) * 180 / pi;
  };
  std::vector<double> shown;
  for (std::size_t cusp = 0; cusp < axes.n_cusps(); ++cusp) {
    const double sector = direction(cusp) - direction((cusp + axes.n_cusps() - 1) % axes.n_cusps());
    shown.push_back(std::clamp(sector < 0 ? sector + 360 : sector, least_sector, most_sector));
  }
  return shown;
}

// The sizes of cusps on circles: their values in the template, and which of them the caller holds.
class CircleSizes {
 public:
  CircleSizes(const Valve &valve, const CuspsOnCircles &names, const Landmarks &landmarks, const CuspAxes &axes,
              const IsHeld &is_held)
      : valve_(valve),
        names_(names),
        landmarks_(landmarks),
        axes_(axes),
        is_held_(is_held),
        own_(names.n_cusps, 360.0 / static_cast<double>(names.n_cusps)) {
    if (!has_sectors()) return;
    double sum = 0;
    for (std::size_t cusp = 0; cusp < n(); ++cusp) sum += own_[cusp] = value_of(valve, of_cusp(cusp, "sector"));
    for (double &sector : own_) sector *= 360 / sum;
  }

  // Returns one entry for each model that will be tried: whether the model fits the sectors. If the caller holds all sectors,
  // they stay as in the template. If the caller holds only some sectors, the others are fitted. If the caller holds no sector,
  // one model fits the sectors, another model does not, and the landmarks decide between them.
  std::vector<bool> fits_sectors() const {
    if (!has_sectors()) return {false};
    const std::size_t n_held = count_held([](std::size_t cusp) { return of_cusp(cusp, "sector"); });
    if (n_held == 0) return {false, true};
    return {n_held < n()};
  }
  std::vector<bool> fits_heights() const {
    if (!has_sectors() || is_held_(names_.height)) return {false};
    if (count_held(height_of_commissure) == 0) return {false, true};
    return {true};
  }

  std::unique_ptr<LandmarkModel> model(bool fits_sectors, bool fits_heights) const {
    auto made = std::make_unique<CirclesModel>(landmarks_, axes_, vector_of(valve_, "translation"));
    const double R = mean_radius(landmarks_, axes_.order.nadir, axes_),
                 Rc = mean_radius(landmarks_, axes_.order.commissure, axes_);
    made->radius = R;
    if (n() == 2) made->meeting_shift = value_of(valve_, "meeting_shift");
    const double grown = R / value_of(valve_, names_.radius);
    const auto add = [&](const std::string &name, double start) {
      made->sizes.push_back(length_size(name, start, grown * value_of(valve_, name), R));
      return made->sizes.size() - 1;
    };
    add(names_.radius, R);
    add(names_.commissure_radius, Rc);
    if (fits_heights)
      add_heights(*made, add);
    else
      add_height(*made, add);
    if (fits_sectors)
      add_sectors(*made, Rc);
    else
      for (const double sector : own_) made->sectors.push_back({sector, {}});
    return made;
  }

  std::vector<double> shown() const { return has_sectors() ? shown_sectors(landmarks_, axes_) : own_; }

 private:
  std::size_t n() const { return names_.n_cusps; }
  bool has_sectors() const { return names_.has_sectors; }
  template <class NameOf>
  std::size_t count_held(const NameOf &name_of) const {
    std::size_t n_held = 0;
    for (std::size_t cusp = 0; cusp < n(); ++cusp) n_held += is_held_(name_of(cusp)) ? 1 : 0;
    return n_held;
  }
  // Returns the height of a commissure as a multiple of commissure_height in the template.
  double ratio(std::size_t cusp) const {
    return has_sectors() ? value_of(valve_, height_of_commissure(cusp)) / value_of(valve_, names_.height) : 1;
  }

  // A single size sets the heights of all commissures, whose ratios stay as in the template.
  template <class Add>
  void add_height(CirclesModel &model, const Add &add) const {
    const std::size_t size = add(names_.height, axes_.height);
    for (std::size_t cusp = 0; cusp < n(); ++cusp) {
      const LinearValue height{0, {{size, ratio(cusp)}}};
      model.heights.push_back(height);
      if (has_sectors() && valve_.is_set(height_of_commissure(cusp)))
        model.derived.push_back({height_of_commissure(cusp), height});
    }
  }

  // Each commissure has its own height in the fit, and commissure_height is the mean of these heights.
  template <class Add>
  void add_heights(CirclesModel &model, const Add &add) const {
    DerivedSize mean{names_.height, {}};
    for (std::size_t cusp = 0; cusp < n(); ++cusp) {
      const std::size_t size = add(height_of_commissure(cusp), axes_.height);
      model.heights.push_back({0, {{size, 1}}});
      mean.of.terms.push_back({size, 1 / static_cast<double>(n())});
    }
    model.derived.push_back(mean);
  }

  // The last sector that is not held is 360 degrees minus the sum of all other sectors.
  void add_sectors(CirclesModel &model, double commissure_radius) const {
    const std::vector<double> shown = shown_sectors(landmarks_, axes_);
    const double reach = 0.5 * commissure_radius * (pi / 180);  // a sector grows on both sides of its cusp's middle
    std::size_t last = n() - 1;
    while (is_held_(of_cusp(last, "sector"))) --last;
    LinearValue left{360, {}};
    for (std::size_t cusp = 0; cusp < n(); ++cusp) {
      model.sectors.emplace_back();
      if (cusp == last) continue;
      model.sectors.back().terms = {{model.sizes.size(), 1}};
      left.terms.push_back({model.sizes.size(), -1});
      model.sizes.push_back({of_cusp(cusp, "sector"), shown[cusp], reach, least_sector, most_sector, own_[cusp], 30});
    }
    model.sectors[last] = left;
    model.derived.push_back({of_cusp(last, "sector"), left});
  }

  const Valve &valve_;
  const CuspsOnCircles &names_;
  const Landmarks &landmarks_;
  const CuspAxes &axes_;
  const IsHeld &is_held_;
  std::vector<double> own_;  // the template's sectors, whose sum is 360 degrees
};

// Sets a parameter in proportion to a measure of the valve. The ratio of the two is taken from the template, `own`.
void set_proportion(const Valve &own, Valve &valve, const std::string &name, double own_measure, double measure) {
  valve.set(name, 1, std::array{value_of(own, name) / own_measure * measure}.data());
}

// Sets the sizes that follow from other sizes. The ratios are taken from the template.
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
  const double turns[n_of_three] = {0, right + left, -(right + non_coronary)};
  valve.set("non_coronary.leaflet_angle", 1, &non_coronary);
  std::array<double, 3> shift{};
  own.get("right.translation", 3, shift.data());
  for (std::size_t cusp = 0; cusp < n_of_three; ++cusp) {
    const std::string of = std::string(names_of_three[cusp]) + ".";
    const auto middle_radius = [&](const Valve &valve_of) {
      return 0.5 * (value_of(valve_of, "root_radius") + value_of(valve_of, of + "leaflet_radius_out"));
    };
    const double angle = value_of(valve, of + "leaflet_angle");
    set_proportion(own, valve, of + "bending_angle", value_of(own, of + "leaflet_angle"), angle);
    set_proportion(own, valve, of + "bending_radius_out", middle_radius(own), middle_radius(valve));
    valve.set(of + "rotation", 3, std::array{0.0, 0.0, turns[cusp]}.data());
    valve.set(of + "translation", 3, shift.data());
    // Lowers the power until the free edge no longer bulges into the next cusp, beyond the plane of the commissure.
    const double x = value_of(valve, of + "leaflet_radius_out") * sine_cosine_degrees(angle).cosine;
    const double radius_in = value_of(valve, of + "leaflet_radius_in");
    if (x > radius_in && value_of(valve, of + "leaflet_power") > x / (x - radius_in))
      valve.set(of + "leaflet_power", 1, std::array{x / (x - radius_in)}.data());
  }
}

KindOfLandmarks aortic_landmarks(const Valve &valve, const Landmarks &landmarks) {
  const CuspAxes axes = axes_of(landmarks, "aortic", n_of_three);
  const double R = mean_radius(landmarks, axes.order.nadir, axes),
               Rc = mean_radius(landmarks, axes.order.commissure, axes);
  const Vec3 by = vector_of(valve, "right.translation");
  auto model = std::make_unique<AorticModel>(landmarks, axes, by);
  const double grown = R / value_of(valve, "root_radius");
  const auto add = [&](const std::string &name, double start) {
    model->sizes.push_back(length_size(name, start, grown * value_of(valve, name), R));
  };
  add("root_radius", R);
  add("leaflet_height", axes.height);
  for (const char *cusp : names_of_three) add(std::string(cusp) + ".leaflet_radius_out", Rc);
  for (const char *name : {"right.leaflet_angle", "left.leaflet_angle"})
    model->sizes.push_back({name, 60, Rc * (pi / 180), 25, 77.5, value_of(valve, name), 15});
  model->radius = R;
  KindOfLandmarks made = one_model(std::move(model), {start_of(landmarks, axes, by, {0, 120, 240})}, "root_radius");
  made.finish = finish_aortic;
  return made;
}

}  // namespace

KindOfLandmarks cusp_landmarks(const Valve &valve, const Landmarks &landmarks, const IsHeld &is_held) {
  const char *kind = valve.kind().name;
  if (std::strcmp(kind, "aortic") == 0) return aortic_landmarks(valve, landmarks);
  const auto *names = std::find_if(std::begin(cusps_on_circles), std::end(cusps_on_circles),
                                   [&](const CuspsOnCircles &cusps) { return std::strcmp(cusps.kind, kind) == 0; });
  const CuspAxes axes = axes_of(landmarks, kind, names->n_cusps);
  const CircleSizes sizes(valve, *names, landmarks, axes, is_held);
  KindOfLandmarks made{{}, {}, names->radius};
  for (const bool fits_sectors : sizes.fits_sectors())
    for (const bool fits_heights : sizes.fits_heights()) made.models.push_back(sizes.model(fits_sectors, fits_heights));
  made.starts = {start_of(landmarks, axes, vector_of(valve, "translation"), middles_of(sizes.shown()))};
  if (std::strcmp(kind, "trileaflet") == 0) made.finish = finish_trileaflet;
  return made;
}

}  // namespace riis
