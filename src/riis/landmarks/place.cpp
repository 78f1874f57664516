// SPDX-License-Identifier: Apache-2.0
#include <riis/riis.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "base/errors.hpp"
#include "common/elementary.hpp"
#include "landmarks/fit.hpp"
#include "valve/skirt.hpp"
#include "valve/warp.hpp"

namespace riis {

double value_of(const Valve &valve, const std::string &name) {
  double value = 0;
  valve.get(name, 1, &value);
  return value;
}

Vec3 vector_of(const Valve &valve, const char *name) {
  std::array<double, 3> values{};
  valve.get(name, 3, values.data());
  return vector_of(values);
}

KindOfLandmarks one_model(std::unique_ptr<LandmarkModel> model, std::vector<Pose> starts, const char *size_name) {
  KindOfLandmarks made{{}, std::move(starts), size_name};
  made.models.push_back(std::move(model));
  return made;
}

namespace {

KindOfLandmarks landmarks_of_kind(const Valve &valve, const Landmarks &landmarks, const IsHeld &is_held) {
  const std::string_view kind = valve.kind().name;
  for (const char *of_cusps : {"trileaflet", "bicuspid", "coapting", "quadricuspid", "aortic"})
    if (kind == of_cusps) return cusp_landmarks(valve, landmarks, is_held);
  if (kind == "mitral") return mitral_landmarks(valve, landmarks);
  if (kind == "mitral_coapting") return mitral_coapting_landmarks(valve, landmarks);
  if (kind == "tricuspid") return tricuspid_landmarks(valve, landmarks);
  if (kind == "bileaflet") return bileaflet_landmarks(valve, landmarks);
  fail(RIIS_INVALID_PARAMETER, "a valve of the kind ", kind, " has no landmarks");
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  constexpr std::string_view blanks = " ,\t\n";
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = text.find_first_not_of(blanks, end);
  }
  return words;
}

// For each parameter of the kind, returns whether the caller keeps the parameter fixed.
std::vector<bool> held_parameters(const Valve &valve, std::string_view held) {
  const auto &specs = valve.kind().parameters;
  std::vector<bool> is_held(specs.size());
  for (const std::string &name : words_of(held)) {
    const auto named = [&](const ParameterSpec &spec) { return spec.name == name; };
    const auto found = std::find_if(specs.begin(), specs.end(), named);
    if (found == specs.end()) {
      double unused[3];
      valve.get(name, 1, unused);  // the message says that the name is unknown or ambiguous
      fail(RIIS_INVALID_PARAMETER, "held names '", name, "', which is not a parameter of the ", valve.kind().name,
           " valve");
    }
    is_held[static_cast<std::size_t>(found - specs.begin())] = true;
  }
  return is_held;
}

bool grows(const ParameterSpec &spec, const std::array<double, 3> &values) {
  const std::string_view name = spec.name, length = spec.unit, shift = "translation", bump = "bump_";
  const bool is_shift = name.size() >= shift.size() && name.substr(name.size() - shift.size()) == shift;
  const bool is_flat_bump = name.substr(0, bump.size()) == bump && values[0] == 0;
  return length == "length" && !is_shift && !is_flat_bump;
}

// Returns the axis of a rotation, and its angle from 0 to 180 degrees.
std::pair<Vec3, double> axis_and_angle(const Rotation &r) {
  const Vec3 twice{r.row_z.y - r.row_y.z, r.row_x.z - r.row_z.x, r.row_y.x - r.row_x.y};
  const double trace = r.row_x.x + r.row_y.y + r.row_z.z, sine = length(twice);
  const double angle = arc_tangent(sine, trace - 1) * (180 / pi);
  if (sine > 1e-6) return {unit(twice), angle};
  if (trace > 1) return {{0, 0, 1}, 0};
  // For an angle of 180 degrees, every column of R + 1 is parallel to the axis or 0.
  const Vec3 columns[3] = {{r.row_x.x + 1, r.row_y.x, r.row_z.x},
                           {r.row_x.y, r.row_y.y + 1, r.row_z.y},
                           {r.row_x.z, r.row_y.z, r.row_z.z + 1}};
  Vec3 longest = columns[0];
  for (const Vec3 &column : columns)
    if (length(column) > length(longest)) longest = column;
  const Vec3 axis = unit(longest);
  return {dot(axis, twice) < 0 ? -axis : axis, angle};
}

// ---- Landmarks along the attachment ----

// A part of the closed valve's attachment.
struct AttachmentPart {
  Curve curve;
  PatchImage image;
  Vector<Vec3> points;  // at even shares
};
constexpr std::size_t n_part_steps = 64;

Vector<AttachmentPart> attachment_of(Valve valve) {
  const double zero = 0;
  valve.set("opening", 1, &zero);
  valve.set("skirt_length", 1, &zero);
  valve.set_warp(nullptr, nullptr);
  const PatchSet set = valve.make_patches();
  Vector<AttachmentPart> parts;
  for (const HeldSide &held : held_sides(set)) {
    const Curve curve = along(set, held.side);
    for (const PatchImage &image : set.patches[held.patch].images) {
      AttachmentPart part{curve, image, {}};
      for (std::size_t i = 0; i <= n_part_steps; ++i)
        part.points.push_back(place(image, curve.at(static_cast<double>(i) / n_part_steps)));
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

// A point of the attachment, and the unit tangent there.
struct OnAttachment {
  Vec3 point, tangent;
};

// Returns the point of the attachment whose image under the map is nearest to `wanted`. If the landmark names a cusp, only the
// attachment of this cusp is searched. Returns nothing if the cusp has no attachment, or if no distance is finite.
std::optional<OnAttachment> nearest_on(const Vector<AttachmentPart> &parts, const WarpMap &map, Vec3 wanted,
                                       std::int32_t leaflet_id) {
  double least = std::numeric_limits<double>::infinity(), at = 0;
  const AttachmentPart *nearest = nullptr;
  for (const AttachmentPart &part : parts) {
    if (leaflet_id >= 0 && part.image.leaflet_id != leaflet_id) continue;
    Vec3 from = map.value(part.points[0]);
    for (std::size_t i = 0; i < n_part_steps; ++i) {
      const Vec3 to = map.value(part.points[i + 1]), along = to - from;
      const double size = dot(along, along);
      const double t = size > 0 ? std::clamp(dot(wanted - from, along) / size, 0.0, 1.0) : 0;
      const double apart = distance(wanted, from + t * along);
      if (apart < least) {
        least = apart;
        nearest = &part;
        at = (static_cast<double>(i) + t) / n_part_steps;
      }
      from = to;
    }
  }
  if (!nearest) return std::nullopt;
  const Curve::PointAndTangent found = nearest->curve.with_tangent(at);
  return OnAttachment{place(nearest->image, found.point), place(turn_of(nearest->image), found.tangent)};
}

// Two landmarks count as one place if their distance is at most `one_place_share` of the valve's radius.
constexpr double one_place_share = 0.02;

// The pairs of points that make a warp. Of several landmarks in one place, only the first is kept.
struct WarpPairs {
  WarpPairs(const Landmarks &landmarks, const std::vector<Vec3> &local, double radius, bool with_attachment,
            const std::vector<Vec3> &places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (landmarks.list[i].repeated) continue;
      if (landmarks.list[i].role == RIIS_LANDMARK_ATTACHMENT && !with_attachment) continue;
      const auto is_near = [&](Vec3 other) { return distance(other, places[i]) <= one_place_share * radius; };
      if (std::any_of(sources.begin(), sources.end(), is_near)) continue;
      sources.push_back(places[i]), targets.push_back(local[i]), landmark.push_back(i);
    }
  }

  double distance_to_nearest(std::size_t i) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < sources.size(); ++k)
      if (k != i) least = std::min(least, distance(sources[i], sources[k]));
    return least;
  }

  Vector<Vec3> sources, targets;
  Vector<std::size_t> landmark;  // the numbers of the landmarks
};

// Slides the places along the attachment until the warp through all landmarks bends least (F. L. Bookstein 1997). This gives
// neighbouring places suitable distances, so that the warp does not fold between them.
void slide_along_attachment(const Vector<AttachmentPart> &parts, const Landmarks &landmarks,
                            const std::vector<Vec3> &local, double radius, std::vector<Vec3> &places) {
  constexpr int most_slides = 8;
  constexpr double most_of_gap = 0.3;  // the most that a place moves at once, as a share of the way to its neighbour
  for (int round = 0; round < most_slides; ++round) {
    const WarpPairs pairs(landmarks, local, radius, true, places);
    WarpLandmarks warp(pairs.sources, 0, "landmarks");
    if (warp.is_planar()) return;
    WarpMap map;
    WarpQuality quality{};
    warp.fit(pairs.targets, map, quality);
    const Vector<double> bending = warp.bending_matrix();
    struct Sliding {
      std::size_t pair;
      Vec3 tangent, mapped;  // the tangent of the attachment, and its image under the map
    };
    Vector<Sliding> sliding;
    for (std::size_t i = 0; i < pairs.sources.size(); ++i) {
      const Landmark &landmark = landmarks.list[pairs.landmark[i]];
      if (landmark.role != RIIS_LANDMARK_ATTACHMENT) continue;
      const auto here = nearest_on(parts, {}, pairs.sources[i], landmark.leaflet_ids[0]);
      if (here) sliding.push_back({i, here->tangent, map.at(pairs.sources[i]).along(here->tangent)});
    }
    // A move of a place changes the displacement to its landmark, and thus the bending. At the minimum, the derivatives of the
    // bending with respect to all moves are 0.
    const std::size_t n = sliding.size();
    std::vector<double> matrix(n * n), steps(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = sliding[i].pair;
      steps[i] = map.size * dot(sliding[i].mapped, Vec3{map.weight_x[at], map.weight_y[at], map.weight_z[at]});
      for (std::size_t k = 0; k < n; ++k)
        matrix[i * n + k] =
            bending[at * pairs.sources.size() + sliding[k].pair] * dot(sliding[i].mapped, sliding[k].mapped);
    }
    if (!solve_positive(std::move(matrix), steps)) return;
    double moved = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = sliding[i].pair, landmark = pairs.landmark[at];
      const double most = most_of_gap * pairs.distance_to_nearest(at);
      const Vec3 wanted = pairs.sources[at] + std::clamp(steps[i], -most, most) * sliding[i].tangent;
      const auto found = nearest_on(parts, {}, wanted, landmarks.list[landmark].leaflet_ids[0]);
      if (!found) continue;
      moved = std::max(moved, distance(found->point, places[landmark]));
      places[landmark] = found->point;
    }
    if (moved <= 1e-6 * radius) return;
  }
}

// Separates landmarks that have the same place. Landmarks may have the same place near a commissure at which the patient differs
// from the valve.
void separate_places(const Vector<AttachmentPart> &parts, const Landmarks &landmarks,
                     const std::vector<std::size_t> &along, const std::vector<Vec3> &local, double radius,
                     std::vector<Vec3> &places) {
  const double one_place = one_place_share * radius;
  for (const std::size_t i : along)
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double apart = distance(local[i], local[k]);
      if (k == i || landmarks.list[k].repeated || distance(places[i], places[k]) > one_place || apart <= one_place)
        continue;
      const std::int32_t leaflet_id = landmarks.list[i].leaflet_ids[0];
      const auto here = nearest_on(parts, {}, places[k], leaflet_id);
      if (!here) continue;
      const double side = dot(local[i] - local[k], here->tangent) < 0 ? -1 : 1;
      const auto moved =
          nearest_on(parts, {}, places[k] + side * std::min(apart, 2 * one_place) * here->tangent, leaflet_id);
      if (moved) places[i] = moved->point;
    }
}

// Finds the places of the landmarks along the attachment. First, a smoothed warp of all landmarks is made. Each place begins at
// the point of the attachment that this warp takes nearest to the landmark. Then the places slide. `places` has the places of the
// other landmarks. `local` has the landmarks in the valve's frame.
void place_on_attachment(const Valve &valve, const Landmarks &landmarks, const std::vector<Vec3> &local, double radius,
                         std::vector<Vec3> &places) {
  std::vector<std::size_t> along = landmarks.with_role(RIIS_LANDMARK_ATTACHMENT);
  const auto is_repeated = [&](std::size_t i) { return landmarks.list[i].repeated.has_value(); };
  along.erase(std::remove_if(along.begin(), along.end(), is_repeated), along.end());
  if (along.empty()) return;
  const Vector<AttachmentPart> parts = attachment_of(valve);
  constexpr int most_rounds = 10;
  for (int round = 0; round < most_rounds; ++round) {
    const WarpPairs pairs(landmarks, local, radius, round > 0, places);
    WarpMap map;
    WarpQuality quality{};
    WarpLandmarks(pairs.sources, landmarks.noise, "landmarks").fit(pairs.targets, map, quality);
    double moved = 0;
    for (const std::size_t i : along) {
      const auto found = nearest_on(parts, map, local[i], landmarks.list[i].leaflet_ids[0]);
      if (!found)
        fail(RIIS_INVALID_ARGUMENT, words_for(landmarks, i), " has no nearest point on the valve's attachment");
      moved = std::max(moved, distance(found->point, places[i]));
      places[i] = found->point;
    }
    if (moved <= 1e-6 * radius) break;
  }
  separate_places(parts, landmarks, along, local, radius, places);
  slide_along_attachment(parts, landmarks, local, radius, places);
  const double one_place = one_place_share * radius;
  for (const std::size_t i : along)
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double apart = distance(places[i], places[k]);
      if (k == i || landmarks.list[k].repeated || apart > one_place) continue;
      fail(RIIS_INVALID_ARGUMENT, words_for(landmarks, std::min(i, k)), " and ", words_for(landmarks, std::max(i, k)),
           " are in one place on the valve's attachment: ", rounded(landmarks.scale * apart, 3),
           " apart, but two landmarks must be more than ", rounded(landmarks.scale * one_place, 3),
           " apart; leave one of them out");
    }
}

// Refuses sizes that do not fit together. The message begins with the sizes that come from the landmarks, because all other sizes
// follow from these.
void check_sizes(const Valve &valve, const LandmarkModel &model) {
  try {
    valve.make_patches();
  } catch (const Error &error) {
    std::string given;
    const auto add = [&](const auto &size) {
      given += (given.empty() ? "" : ", ") + size.name + " " + Message(rounded(size.value, 4)).text();
    };
    for (const FittedSize &size : model.sizes)
      if (!size.held) add(size);
    for (const DerivedSize &size : model.derived) add(size);
    if (given.empty()) throw;
    fail(error.status, "the landmarks give ", given.c_str(), ", and then ", error.message.text());
  }
}

// Fits the models one after another. Returns the number and the fit of the first model that agrees with the landmarks.
std::pair<std::size_t, LandmarkFit> fit_models(const KindOfLandmarks &of_kind, const Landmarks &landmarks) {
  const std::size_t last = of_kind.models.size() - 1;
  LandmarkFit general = fit(*of_kind.models[last], landmarks, of_kind.starts);
  for (std::size_t i = 0; i < last; ++i) {
    LandmarkFit simple = fit(*of_kind.models[i], landmarks, of_kind.starts);
    if (is_as_good(simple, general, *of_kind.models[last], landmarks)) return {i, std::move(simple)};
  }
  return {last, std::move(general)};
}

}  // namespace

PlacedValve place_valve(const Valve &valve, const Landmarks &landmarks, std::string_view held) {
  const std::vector<bool> is_held = held_parameters(valve, held);
  check_unit(landmarks);
  const auto &specs = valve.kind().parameters;
  const auto position = [&](const std::string &name) {
    const auto named = [&](const ParameterSpec &spec) { return spec.name == name; };
    return static_cast<std::size_t>(std::find_if(specs.begin(), specs.end(), named) - specs.begin());
  };
  const auto is_held_name = [&](const std::string &name) { return static_cast<bool>(is_held[position(name)]); };
  KindOfLandmarks of_kind = landmarks_of_kind(valve, landmarks, is_held_name);
  for (const auto &model : of_kind.models)
    for (FittedSize &size : model->sizes)
      if (is_held_name(size.name) || size.held) {
        size.held = true;
        size.value = value_of(valve, size.name);
      }
  auto [chosen, fitted] = fit_models(of_kind, landmarks);
  const LandmarkModel &model = *of_kind.models[chosen];
  check_converged(fitted, landmarks);
  if (of_kind.check) of_kind.check(model, fitted, landmarks);

  PlacedValve placed{valve, landmarks.scale, {0, 0, 1}, 0, {0, 0, 0}, {}, {}, 0, fitted.rotation_error, 0, {}, {}};
  placed.n_as_annulus = of_kind.n_as_annulus;
  // First all lengths grow with the valve. After that, the fitted sizes take their values. Parameters that depend on several
  // sizes are set last.
  double size_now = value_of(valve, of_kind.size_name);
  for (const FittedSize &size : model.sizes)
    if (size.name == of_kind.size_name) size_now = size.value;
  const double grown = size_now / value_of(valve, of_kind.size_name);
  // Lengths that a rule of the valve computes from other lengths grow with these, so they are not set.
  for (std::size_t i = 0; i < specs.size(); ++i) {
    std::array<double, 3> values = valve.values()[i];
    if (!grows(specs[i], values) || (specs[i].rule.text && !valve.is_set(specs[i].name))) continue;
    for (double &value : values) value *= grown;
    placed.valve.set(specs[i].name, specs[i].n_values, values.data());
  }
  for (const FittedSize &size : model.sizes) placed.valve.set(size.name, 1, &size.value);
  for (const DerivedSize &size : model.derived) placed.valve.set(size.name, 1, &size.value);
  if (of_kind.finish) of_kind.finish(valve, placed.valve);

  placed.size_state.assign(specs.size(), RIIS_SIZE_KEPT);
  placed.standard_error.assign(specs.size(), 0);
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (is_held[i]) {
      placed.valve.set(specs[i].name, specs[i].n_values, valve.values()[i].data());
    } else if (grows(specs[i], valve.values()[i]) || valve.values()[i] != placed.valve.values()[i]) {
      placed.size_state[i] = RIIS_SIZE_TIED;
      placed.standard_error[i] = std::numeric_limits<double>::infinity();
    }
  }
  const auto tell = [&](const auto &size) {
    const std::size_t i = position(size.name);
    placed.size_state[i] = size.determined ? RIIS_SIZE_DETERMINED : RIIS_SIZE_UNDETERMINED;
    placed.standard_error[i] = size.standard_error;
  };
  for (const FittedSize &size : model.sizes)
    if (!size.held) tell(size);
  for (const DerivedSize &size : model.derived) tell(size);
  check_sizes(placed.valve, model);

  std::vector<Vec3> local;
  for (std::size_t i = 0; i < landmarks.list.size(); ++i)
    local.push_back(transposed(fitted.pose.rotation) * (landmarks.at(i) - fitted.pose.translation));
  place_on_attachment(placed.valve, landmarks, local, model.radius, fitted.places);
  for (const std::size_t i : landmarks.with_role(RIIS_LANDMARK_ATTACHMENT))
    fitted.residuals[i] = distance(local[i], fitted.places[i]);
  for (std::size_t i = 0; i < landmarks.list.size(); ++i)
    if (const std::optional<std::size_t> other = landmarks.list[i].repeated) {
      fitted.places[i] = fitted.places[*other];
      fitted.residuals[i] = fitted.residuals[*other];
    }

  const double scale = landmarks.scale;
  for (const Vec3 at : fitted.places)
    placed.places.push_back(scale * (fitted.pose.rotation * at + fitted.pose.translation) + landmarks.mean);
  placed.residuals = fitted.residuals;
  std::tie(placed.rotation_axis, placed.rotation_angle) = axis_and_angle(fitted.pose.rotation);
  placed.translation = scale * fitted.pose.translation + landmarks.mean;
  for (double &residual : placed.residuals) residual *= scale;
  placed.noise = scale * fitted.noise;
  placed.position_error = scale * fitted.position_error;
  return placed;
}

}  // namespace riis
